//! The latest commands of the program to the spindles.

use crate::diag::{Condition, rounded};
use crate::exec::fault::Fault;
use crate::exec::report::{Report, Subject};
use crate::exec::step::{Approach, Event, SpindleMotion};
use crate::machine::{Acknowledged, Axis, Channel, Machine, SpindleLimits, SpindleWaits};
use crate::syntax::ast::Span;

/// Limits that take effect when a spindle starts.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(in crate::exec) enum Passed {
    /// None: the spindle keeps the active ones.
    #[default]
    Nothing,
    /// The limits of a tool.
    Tool(SpindleLimits),
    /// The limits of its list only.
    List,
}

/// State of one spindle.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::exec) struct Spindle {
    pub(in crate::exec) name: String,
    /// Index into the spindles of the machine; `None` for a spindle that no list configures.
    pub(in crate::exec) index: Option<usize>,
    /// Speed in rev/min (S word).
    pub(in crate::exec) rpm: f64,
    /// Programmed override of the speed (`S[OVERRIDE ..]`), 1 without one.
    pub(in crate::exec) override_ratio: f64,
    pub(in crate::exec) turning: Turning,
    /// Angle of M19 in deg: the modal value of POS.
    pub(in crate::exec) angle_deg: f64,
    /// Weight of the acceleration (G130), 1 without one.
    pub(in crate::exec) acceleration_ratio: f64,
    /// Whether M3 or M4 was its last command.
    pub(in crate::exec::motion) runs: bool,
    /// Active limits of its tool.
    pub(in crate::exec::motion) limits: Option<SpindleLimits>,
    /// Limits of a tool or of the list that take effect at its next start.
    pub(in crate::exec::motion) passed: Passed,
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
    Positioned(Approach),
}

impl Turning {
    /// The command given by M3, M4, M19 or M5.
    pub(in crate::exec) fn of(number: u32) -> Self {
        match number {
            3 => Self::Clockwise,
            4 => Self::CounterClockwise,
            19 => Self::Positioned(Approach::Free),
            _ => Self::Stopped,
        }
    }

    /// The M function of the command.
    pub(in crate::exec) fn number(self) -> u32 {
        match self {
            Self::Clockwise => 3,
            Self::CounterClockwise => 4,
            Self::Stopped => 5,
            Self::Positioned(_) => 19,
        }
    }

    /// M3 or M4 with M19: the direction of the positioning.
    pub(in crate::exec) fn with_direction(self, number: u32) -> Self {
        match (self, number) {
            (Self::Positioned(_), 3) => Self::Positioned(Approach::Clockwise),
            (Self::Positioned(_), 4) => Self::Positioned(Approach::CounterClockwise),
            _ => self,
        }
    }
}

impl Spindle {
    pub(in crate::exec) fn new(name: &str, index: Option<usize>) -> Self {
        Self {
            name: name.to_owned(),
            index,
            rpm: 0.0,
            override_ratio: 1.0,
            turning: Turning::Stopped,
            angle_deg: 0.0,
            acceleration_ratio: 1.0,
            runs: false,
            limits: None,
            passed: Passed::Nothing,
            feedforward: false,
            weight_ratio: 1.0,
        }
    }

    /// Speed in rev/min without its sign, times the programmed override.
    pub(in crate::exec) fn overridden_rpm(&self) -> f64 {
        self.rpm.abs() * self.override_ratio
    }

    /// Speed in rev/min, negative for M4.
    pub(in crate::exec) fn signed_rpm(&self) -> f64 {
        if self.turning == Turning::CounterClockwise { -self.rpm.abs() } else { self.rpm.abs() }
    }

    /// Whether an override changes the programmed speed.
    pub(in crate::exec) fn is_overridden(&self) -> bool {
        self.override_ratio.to_bits() != 1.0_f64.to_bits()
    }

    /// Its state of motion as an event; `None` if the machine does not have this spindle.
    pub(in crate::exec) fn motion_event(&self) -> Option<Event> {
        let rpm = self.overridden_rpm();
        let motion = match self.turning {
            Turning::Stopped => SpindleMotion::Stop,
            Turning::Clockwise => SpindleMotion::Clockwise { rpm },
            Turning::CounterClockwise => SpindleMotion::CounterClockwise { rpm },
            // Assumption: the programmed speed also applies to positioning; without one a spindle turns at its maximum speed
            Turning::Positioned(approach) => SpindleMotion::Position {
                deg: self.angle_deg,
                rpm: Some(rpm).filter(|r| *r > 0.0),
                approach,
            },
        };
        self.index.map(|spindle| Event::Spindle { spindle, motion })
    }

    pub(in crate::exec) fn feedforward_event(&self) -> Option<Event> {
        let (on, weight_ratio) = (self.feedforward, self.weight_ratio);
        self.index.map(|spindle| Event::SpindleFeedforward { spindle, on, weight_ratio })
    }

    pub(in crate::exec) fn acceleration_event(&self) -> Option<Event> {
        let ratio = self.acceleration_ratio;
        self.index.map(|spindle| Event::SpindleAcceleration { spindle, ratio })
    }

    pub(in crate::exec) fn is_turning(&self) -> bool {
        matches!(self.turning, Turning::Clockwise | Turning::CounterClockwise)
    }

    /// Its list; `None` for a spindle that no list configures.
    pub(in crate::exec) fn listed<'m>(&self, machine: &'m Machine) -> Option<&'m Axis> {
        self.index.and_then(|i| machine.spindles.get(i))
    }

    /// What the path waits for after functions of the spindle.
    pub(in crate::exec) fn waits(&self, channel: &Channel) -> SpindleWaits {
        self.index.and_then(|i| channel.functions.spindle_waits.get(i)).copied().unwrap_or_default()
    }

    /// Whether its S word takes effect after the motion of its block (MNS_SNS).
    pub(in crate::exec) fn speeds_up_late(&self, channel: &Channel) -> bool {
        self.waits(channel).speed == Some(Acknowledged::AfterMotion)
    }

    /// Maximum speed in rev/min (P-AXIS-00212); infinite for a spindle without a list.
    pub(in crate::exec) fn most_rpm(&self, machine: &Machine) -> f64 {
        self.listed(machine).map_or(f64::INFINITY, |s| s.dynamics().v_max_mm_s / 6.0)
    }

    /// Reports a speed above the maximum of the spindle (K-0131).
    pub(in crate::exec) fn check_speed(&self, machine: &Machine, report: &mut Report, span: Span) {
        let (rpm, most) = (self.overridden_rpm(), self.most_rpm(machine));
        if rpm > most {
            let text = format!(
                "spindle speed {} rev/min of {} is above its limit (P-AXIS-00212): {} rev/min are used",
                rounded(rpm),
                self.name,
                rounded(most)
            );
            report.note(Fault::new(Condition::SpindleLimit, text, span));
        }
    }

    /// Reports a spindle that does not turn although it is commanded to.
    pub(in crate::exec) fn warn(&self, report: &mut Report, span: Span) {
        if self.index.is_none() {
            let text = "the machine has no spindle: speeds are stored without effect";
            report.note_once(Subject::Spindle, Fault::new(Condition::Ignored, text, span));
        } else if self.is_turning() && self.rpm == 0.0 && !report.failed() {
            let text = "M03 and M04 have no effect at speed 0 before an S word";
            report.note_once("S", Fault::new(Condition::Odd, text, span));
        } else if matches!(self.turning, Turning::Positioned(_)) && self.rpm == 0.0 {
            // TF5200 programming manual, M19 (208038923, 208198923): a speed above 0 must be set
            let text = "M19 requires a spindle speed on the control; here the spindle positions at its maximum speed";
            let fault = Fault::new(Condition::Odd, text, span).hint("write S or REV before it");
            report.note_once(Subject::M(19), fault.warning());
        }
    }
}

/// The spindles of the lists at program start, the main spindle first; a single spindle without a list if there are none.
pub(super) fn of_lists(machine: &Machine) -> Vec<Spindle> {
    let named = machine.spindles.iter().enumerate();
    let mut spindles: Vec<Spindle> = named.map(|(i, s)| Spindle::new(s.name(), Some(i))).collect();
    if spindles.is_empty() {
        spindles.push(Spindle::new("S", None));
    }
    let main = listed_main(&spindles, machine);
    spindles.swap(0, main);
    if spindles[0].index.is_some() {
        spindles[0].turning = Turning::of(machine.channel.functions.spindle_at_start);
    }
    spindles
}

/// Index of the spindle selected by P-CHAN-00051, otherwise of the first one of the lists.
pub(in crate::exec) fn listed_main(spindles: &[Spindle], machine: &Machine) -> usize {
    let number = machine.channel.spindles.main;
    let listed = number.and_then(|main| machine.spindles.iter().position(|s| s.number() == main));
    spindles.iter().position(|s| s.index == Some(listed.unwrap_or(0))).unwrap_or(0)
}
