//! The course of the speed over one entry of the timeline.

use crate::profile::{SpanProfile, SpeedChange, State};

/// A planned span, or a change of speed out of a moving state.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Course {
    Span(SpanProfile),
    Change(SpeedChange),
}

impl Course {
    /// Duration in s.
    pub(crate) fn duration(&self) -> f64 {
        match self {
            Self::Span(p) => p.duration(),
            Self::Change(c) => c.duration(),
        }
    }

    /// Length in mm.
    pub(crate) fn length(&self) -> f64 {
        match self {
            Self::Span(p) => p.length(),
            Self::Change(c) => c.length(),
        }
    }

    /// Highest velocity in mm/s.
    pub(crate) fn peak(&self) -> f64 {
        match self {
            Self::Span(p) => p.peak(),
            Self::Change(c) => c.peak(),
        }
    }

    /// State at time `t` in s since the start.
    pub(crate) fn at(&self, t: f64) -> State {
        match self {
            Self::Span(p) => p.at(t),
            Self::Change(c) => c.at(t),
        }
    }

    /// State at the end.
    pub(crate) fn end(&self) -> State {
        self.at(self.duration())
    }

    /// Acceleration in mm/s2 with which the path goes on behind the end.
    pub(crate) fn left_with(&self) -> f64 {
        match self {
            Self::Span(p) => p.left_with(),
            Self::Change(_) => 0.0,
        }
    }

    /// Time in s at which path length `s_mm` is reached.
    pub(crate) fn time_at(&self, s_mm: f64) -> f64 {
        match self {
            Self::Span(p) => p.time_at(s_mm),
            Self::Change(c) => c.time_at(s_mm),
        }
    }
}
