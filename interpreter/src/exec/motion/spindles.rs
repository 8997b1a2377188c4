//! What the program last told the spindles.

use crate::exec::step::{Event, SpindleMotion};

/// State of one spindle.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::exec) struct Spindle {
    pub(in crate::exec) name: String,
    /// Index into the spindles of the machine; `None` for a spindle that no list configures.
    pub(in crate::exec) index: Option<usize>,
    /// Speed in rev/min (S word).
    pub(in crate::exec) rpm: f64,
    pub(in crate::exec) turning: Turning,
    pub(in crate::exec) feedforward: bool,
    /// Weight of feedforward, 0 to 1.
    pub(in crate::exec) weight_ratio: f64,
}

/// M3, M4, M5, M19.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::exec) enum Turning {
    Stopped,
    Clockwise,
    CounterClockwise,
    Positioned { deg: f64 },
}

impl Turning {
    /// What M3, M4, M19 (with its angle in deg, 0 without one) or M5 asks for.
    pub(in crate::exec) fn of(number: u32, deg: Option<f64>) -> Self {
        match number {
            3 => Self::Clockwise,
            4 => Self::CounterClockwise,
            19 => Self::Positioned { deg: deg.unwrap_or(0.0) },
            _ => Self::Stopped,
        }
    }
}

impl Spindle {
    pub(in crate::exec) fn new(name: &str, index: Option<usize>) -> Self {
        Self {
            name: name.to_owned(),
            index,
            rpm: 0.0,
            turning: Turning::Stopped,
            feedforward: false,
            weight_ratio: 1.0,
        }
    }

    /// Its state of motion as an event; `None` if the machine has no such spindle.
    pub(in crate::exec) fn motion_event(&self) -> Option<Event> {
        let rpm = self.rpm.abs();
        let motion = match self.turning {
            Turning::Stopped => SpindleMotion::Stop,
            Turning::Clockwise => SpindleMotion::Clockwise { rpm },
            Turning::CounterClockwise => SpindleMotion::CounterClockwise { rpm },
            // Assumption: the programmed speed holds for positioning too; a spindle without one goes as fast as it can
            Turning::Positioned { deg } => {
                SpindleMotion::Position { deg, rpm: Some(rpm).filter(|r| *r > 0.0) }
            }
        };
        self.index.map(|spindle| Event::Spindle { spindle, motion })
    }

    pub(in crate::exec) fn feedforward_event(&self) -> Option<Event> {
        let (on, weight_ratio) = (self.feedforward, self.weight_ratio);
        self.index.map(|spindle| Event::SpindleFeedforward { spindle, on, weight_ratio })
    }

    pub(in crate::exec) fn is_turning(&self) -> bool {
        matches!(self.turning, Turning::Clockwise | Turning::CounterClockwise)
    }
}
