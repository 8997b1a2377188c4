//! The output of the executor to the simulation: motions, stops and events, in program order.

mod decoded;
mod event;
mod line;

pub(crate) use decoded::{Decoded, Opened, Rare};
pub(crate) use event::{
    Approach, BandingRun, CuttingSpeed, Event, SpindleMotion, TimerAct, TimerCall, WearSetting,
    WornPart,
};
use kontur_filters::fir::FirConfig;
use kontur_filters::hsc::HscConfig;
use kontur_filters::kernel::Kernel;
use kontur_filters::time::CycleTime;
use kontur_filters::vib_guard::VibGuardSettings;
use kontur_motion::axis::AxisVec;
use kontur_motion::block::{Block, SlopeKind};
use kontur_motion::independent::IndependentSpeed;
pub(crate) use line::Ahead;
pub(in crate::exec) use line::{Line, line};
use std::sync::Arc;

/// Position of a block in the programs of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SourceRef {
    /// Index into [`Executor::files`](super::Executor::files).
    pub file: u32,
    /// Line in that file, from 1; 0 before the first block.
    pub line: u32,
    /// Bytes of the file before that line.
    pub offset: u64,
    /// N number of the block, if it has one.
    pub block: Option<u64>,
}

/// One step of the program.
#[derive(Clone, Debug)]
pub(crate) enum Step {
    /// A motion for the planner.
    Motion {
        /// The motion.
        block: Box<Block>,
        /// Where it was programmed.
        source: SourceRef,
        /// They occur in the first cycle of the motion, without a stop.
        events: Vec<Event>,
    },
    /// The path stops after all previous motions; then the simulation acts or waits as required and requests the next step.
    Sync {
        /// The action at standstill.
        what: Sync,
        /// Where it was programmed.
        source: SourceRef,
        /// They occur when the path has stopped, before any waiting.
        events: Vec<Event>,
    },
    /// End of the program; no step follows.
    End {
        /// The reason.
        reason: EndReason,
        /// The block that ended it.
        source: SourceRef,
        /// They occur at the end of the last motion.
        events: Vec<Event>,
    },
}

impl Step {
    /// Whether the step advances the program time. A loop of steps that do not would never end.
    pub(crate) fn takes_time(&self, cycle: CycleTime) -> bool {
        match self {
            Self::Motion { .. } => true,
            Self::End { .. } => false,
            Self::Sync { what, .. } => match what {
                Sync::Dwell { seconds } | Sync::Technology { seconds } => {
                    (seconds / cycle.seconds()).round() >= 1.0
                }
                Sync::Independent { .. }
                | Sync::Spindle { .. }
                | Sync::Measured { .. }
                | Sync::ThreadEnd => true,
                Sync::ExactStop { .. }
                | Sync::Stop
                | Sync::Halt
                | Sync::FlushWait
                | Sync::ProgramStop { .. }
                | Sync::Shaping(_)
                | Sync::ReadActual
                | Sync::TakeActual
                | Sync::SetPosition { .. }
                | Sync::MachineData { .. } => false,
            },
        }
    }
}

/// Actions while the path is at standstill.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Sync {
    /// G60, G360: waits until every axis is in its window (P-AXIS-00236).
    ExactStop {
        /// Whether this includes axes in independent motion (P-CHAN-00297 = 1).
        alone: bool,
    },
    /// Only a stop at the end of the previous block, which the program asks for (`#FLUSH`, a measuring run).
    Stop,
    /// Such a stop where the program does not ask for it (OSC ON, `#TIMER READ SYN`).
    Halt,
    /// G04, `#TIME`: dwell, in s.
    Dwell {
        /// Time in s, not negative.
        seconds: f64,
    },
    /// M, H, S and T functions with durations declared in the lists, if the user includes them: waits for this time.
    Technology {
        /// Time in s, above 0.
        seconds: f64,
    },
    /// `#FLUSH WAIT`, `#CHANNEL INIT [CMDPOS]`, reading an external variable: waits until the axes have arrived.
    FlushWait,
    /// `INDP_SYN`, `#WAIT INDP`: waits until the setpoints of these independent axes have arrived.
    Independent {
        /// Path axes, in channel order.
        axes: Vec<usize>,
    },
    /// Threads: waits until a spindle is at standstill, or passes its zero mark; in the latter case the path then follows it.
    Spindle {
        /// Index into `Machine::spindles`.
        spindle: usize,
        /// The condition to wait for.
        state: SpindleState,
    },
    /// The end of a measuring run: the preceding motion ends where the probe signals.
    Measured {
        /// Whether the path continues after the signal (G106).
        through: bool,
        /// Path axes with a following error that replaces the probe as signal (measuring type 7).
        stops: Vec<usize>,
    },
    /// The end of G33.
    ThreadEnd,
    /// M00, M01; without an operator the program continues at once.
    ProgramStop {
        /// M01.
        optional: bool,
    },
    /// Settings of the axis filters or the Vibration Guard have changed: the kernels are run out, then replaced.
    Shaping(Box<ShapingSetup>),
    /// The next call of [`Executor::next`](super::Executor::next) requires actual positions of the machine at standstill.
    ReadActual,
    /// As before, after every axis has settled in its window (P-AXIS-00236): `#CHANNEL INIT [ACTPOS]`.
    TakeActual,
    /// An axis in its window is assigned another setpoint.
    SetPosition {
        /// Path axis.
        axis: usize,
        /// New position minus the current one in mm (deg).
        offset_mm: f64,
        /// Whether the axis follows (`#CHANNEL INIT [ACTPOS]`); otherwise it does not move, and its current position is
        /// redefined (`X[SET_POSITION ..]`).
        moves: bool,
    },
    /// `#MACHINE DATA`: a parameter of an axis list has changed in [`Executor::machine`](super::Executor::machine).
    MachineData {
        /// Logical axis number.
        axis: u32,
    },
}

/// What a stop means for a corner before it that would be rounded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum AtCorner {
    /// The path waits where the block ends, also within the curve (475113099).
    Waits,
    /// The program does not ask for the stop, and the corner is lost.
    Lost,
    /// The corner is kept, as with commands that empty the channel (207042443).
    Kept,
}

impl Sync {
    pub(crate) fn at_corner(&self) -> AtCorner {
        match self {
            Self::Dwell { seconds } if *seconds > 0.0 => AtCorner::Waits,
            Self::Technology { .. }
            | Self::ProgramStop { .. }
            | Self::Spindle { state: SpindleState::Rest | SpindleState::Reached, .. } => {
                AtCorner::Waits
            }
            Self::Halt
            | Self::Independent { .. }
            | Self::Shaping(_)
            | Self::ReadActual
            | Self::TakeActual
            | Self::SetPosition { .. }
            | Self::Spindle { state: SpindleState::Mark { .. }, .. }
            | Self::MachineData { .. } => AtCorner::Lost,
            // an exact stop without a motion is a dwell of no time
            Self::Dwell { .. }
            | Self::ExactStop { .. }
            | Self::Stop
            | Self::FlushWait
            | Self::Measured { .. }
            | Self::ThreadEnd => AtCorner::Kept,
        }
    }
}

/// Reason for the end of a program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum EndReason {
    /// M02, M30 or the end of the text.
    Finished,
    /// An error; [`Executor::take_diagnostics`](super::Executor::take_diagnostics) returns it.
    Aborted,
}

/// Kernels of path axes and spindles, in channel order.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct ShapingSetup {
    /// One entry per path axis; its gantry slaves use the same kernel.
    pub axes: Vec<AxisShaping>,
    /// One entry per spindle: defined by its list, constant throughout the program.
    pub spindles: Vec<AxisShaping>,
}

/// Kernel of one axis.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct AxisShaping {
    /// The parameters of the kernel.
    pub settings: ShapingSettings,
    /// The kernel; `None` leaves the setpoints unchanged.
    pub kernel: Option<Arc<Kernel>>,
}

/// The one of the mutually exclusive functions that occupies the kernel slot of an axis.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) enum ShapingSettings {
    /// None.
    #[default]
    Off,
    /// Vibration Guard.
    VibGuard(VibGuardSettings),
    /// FIR filter.
    Fir(FirConfig),
    /// HSC filter (older form).
    Hsc(HscConfig),
}

/// The condition that ends a wait for a spindle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum SpindleState {
    /// It is at standstill.
    Rest,
    /// It has reached its commanded speed or position.
    Reached,
    /// It rotates at its speed, and passes this angle in deg in this cycle.
    Mark {
        /// Angle.
        deg: f64,
        /// Whether the override has no effect on the thread.
        full_override: bool,
        /// The filters of the axes must have settled before, so that the thread does not begin later than the mark because of
        /// what came before it (`AX_DEV`).
        settled: bool,
    },
}

/// Motion of an independent axis from standstill to standstill.
///
/// The motions of the path do not contain it: their coordinates of the axis are reduced by the travel of its independent
/// motions so far.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct IndependentMotion {
    /// Start position, in mm (deg).
    pub from_mm: f64,
    /// Target in mm (deg).
    pub to_mm: f64,
    /// Its speed.
    pub speed: IndependentSpeed,
    /// Acceleration profile.
    pub slope: SlopeKind,
    /// Its block.
    pub source: SourceRef,
}

/// Motion of an oscillating axis; it always ends at its second position.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct OscillatingMotion {
    /// Start position, in mm (deg).
    pub from_mm: f64,
    /// First and second reversal position in mm (deg), not equal.
    pub reversal_mm: [f64; 2],
    /// Dwell at each of them in s.
    pub rest_s: [f64; 2],
    /// Its speed; a time is that of one stroke.
    pub speed: IndependentSpeed,
    /// Acceleration profile.
    pub slope: SlopeKind,
    /// Number of oscillations; `None`: until the program waits for the axis.
    pub count: Option<u32>,
    /// Its block.
    pub source: SourceRef,
}

/// News of the machine for the program.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Told {
    /// The state when the next step is requested; without it, the last one remains valid.
    pub feedback: Option<Feedback>,
    /// Operations of `#TIMER .. SYN` since the last news.
    pub timers: Vec<TimerCall>,
}

impl From<Feedback> for Told {
    fn from(feedback: Feedback) -> Self {
        Self { feedback: Some(feedback), timers: Vec::new() }
    }
}

/// State of the simulation when it requests the next step.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Feedback {
    /// Actual position of each path axis in mm (deg), in channel order; used after [`Sync::ReadActual`].
    pub actual_mm: AxisVec,
    /// Following error of each path axis in its position loop in mm (deg); used after [`Sync::TakeActual`].
    pub lag_mm: AxisVec,
    /// Program time in s.
    pub time_s: f64,
    /// Result of a measuring run, after [`Sync::Measured`].
    pub measured: Option<Box<Probed>>,
}

/// The end of a measuring run, in mm (deg).
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Probed {
    /// Actual position of each path axis where the probe has signalled; `None` if it has not.
    pub signal_mm: Option<AxisVec>,
    /// Setpoints of the axes after the stop.
    pub rest_mm: AxisVec,
}
