//! State of measuring runs.

use crate::diag::Severity;
use crate::exec::step::SourceRef;
use crate::machine::Channel;
use crate::syntax::ast::{Jump, Span};
use kontur_motion::axis::AxisVec;
use kontur_motion::block::Feed;

/// Measured values of an axis, in mm (deg).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(in crate::exec) struct Measured {
    /// In the coordinates of the program, with all offsets (`V.A.MESS`).
    pub(in crate::exec) value: f64,
    /// Position of the axis (`V.A.MEAS.ACS.VALUE`).
    pub(in crate::exec) axis: f64,
    /// In the coordinates of the program (`V.A.MEAS.PCS.VALUE`).
    pub(in crate::exec) program: f64,
    /// Distance from the target to the measured position (`V.A.MOFFS`); `None` before the first signal.
    pub(in crate::exec) offset: Option<f64>,
    /// Whether the signal came in the last run (`V.A.MERF`).
    pub(in crate::exec) signalled: bool,
}

/// A run in progress; the program waits for its end.
#[derive(Debug)]
pub(in crate::exec::motion) struct Pending {
    pub(in crate::exec::motion) axes: Vec<usize>,
    /// Programmed coordinates of the target.
    pub(in crate::exec::motion) target: AxisVec,
    /// Severity of the message if the signal is missing.
    pub(in crate::exec::motion) missing: Option<Severity>,
    pub(in crate::exec::motion) jump: Option<Jump>,
    pub(in crate::exec::motion) source: SourceRef,
    pub(in crate::exec::motion) span: Span,
}

/// State that measuring owns.
#[derive(Debug)]
pub(in crate::exec) struct Measuring {
    /// Measuring type, 1 to 7 (`#MEAS MODE`).
    pub(in crate::exec) kind: u32,
    /// `ERR_NO_SIGNAL`; `None`: as defined by the list and the type.
    pub(in crate::exec) missing_is_error: Option<bool>,
    /// G108: the next motion with an M function that waits for the signal belongs to edge banding.
    pub(in crate::exec) banding: bool,
    /// V.G.RW in mm.
    pub(in crate::exec) residual_path_mm: f64,
    /// Per axis.
    pub(in crate::exec) results: Vec<Measured>,
    /// Whether the current block is a run.
    pub(in crate::exec::motion) runs: bool,
    /// Speed of a run of type 2 during the run.
    pub(in crate::exec::motion) feed: Option<Feed>,
    pub(in crate::exec::motion) pending: Option<Box<Pending>>,
}

impl Measuring {
    pub(in crate::exec) fn new(channel: &Channel, axes: usize) -> Self {
        Self {
            kind: channel.measuring.kind,
            missing_is_error: None,
            banding: false,
            residual_path_mm: channel.banding.residual_path_mm,
            results: vec![Measured::default(); axes],
            runs: false,
            feed: None,
            pending: None,
        }
    }

    /// Whether the program waits for the end of a run.
    pub(in crate::exec) fn is_under_way(&self) -> bool {
        self.pending.is_some()
    }

    /// The branch after a signal (`G310 .. $GOTO`).
    pub(in crate::exec) fn jump(&mut self, label: Option<Jump>) {
        if let Some(pending) = &mut self.pending {
            pending.jump = label;
        }
    }
}
