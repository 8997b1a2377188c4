//! What the executor passes to the simulation: motions, rests and events, in the order of the program.

use crate::exec::values::timers::TimerAct;
use crate::machine::SpindleLimits;
use kontur_filters::fir::FirConfig;
use kontur_filters::hsc::HscConfig;
use kontur_filters::kernel::Kernel;
use kontur_filters::time::CycleTime;
use kontur_filters::vib_guard::VibGuardSettings;
use kontur_motion::axis::AxisVec;
use kontur_motion::block::{Block, SlopeKind};
use kontur_motion::independent::IndependentSpeed;
use std::sync::Arc;

/// Place of a block in the programs that take part in a run.
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
        /// They act in the first cycle of the motion, without a stop.
        events: Vec<Event>,
    },
    /// The path comes to rest after everything before; then the simulation acts or waits as required and asks for the
    /// next step.
    Sync {
        /// What happens at rest.
        what: Sync,
        /// Where it was programmed.
        source: SourceRef,
        /// They act when the path has come to rest, before any waiting.
        events: Vec<Event>,
    },
    /// End of the program; no step follows.
    End {
        /// Why.
        reason: EndReason,
        /// The block that ended it.
        source: SourceRef,
        /// They act at the end of the last motion.
        events: Vec<Event>,
    },
}

impl Step {
    /// True if the program goes forward in time by it. A loop of steps that do not would run for ever.
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

/// What happens while the path is at rest.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Sync {
    /// G60, G360: waiting until every axis is in its window (P-AXIS-00236).
    ExactStop {
        /// Those that are on their way alone too (P-CHAN-00297 = 1).
        alone: bool,
    },
    /// A stop at the end of the block before and nothing else (`#FLUSH`, G115 and similar).
    Stop,
    /// G04, `#TIME`: waiting so long, in s.
    Dwell {
        /// Time in s, not negative.
        seconds: f64,
    },
    /// M, H and S functions whose durations the lists declare and the user wants to be counted: waiting so long.
    Technology {
        /// Time in s, above 0.
        seconds: f64,
    },
    /// `#FLUSH WAIT`, `#CHANNEL INIT [CMDPOS]`: waiting until the axes have arrived.
    FlushWait,
    /// `INDP_SYN`, `#WAIT INDP`: waiting until the set positions of these independent axes have arrived.
    Independent {
        /// Path axes, in channel order.
        axes: Vec<usize>,
    },
    /// Threads: waiting until a spindle is at rest, or passes its mark; in the latter case the path then goes with it.
    Spindle {
        /// Index into `Machine::spindles`.
        spindle: usize,
        /// What is waited for.
        state: SpindleState,
    },
    /// The end of a measuring run: the motion before it ends where the probe signals.
    Measured {
        /// The signal does not stop the path (G106).
        through: bool,
        /// Path axes whose lag is the signal instead of the probe (measuring type 7).
        stops: Vec<usize>,
    },
    /// The end of G33.
    ThreadEnd,
    /// M00, M01; headless the program continues at once.
    ProgramStop {
        /// M01.
        optional: bool,
    },
    /// Settings of the axis filters or the Vibration Guard changed: flush the kernels, then swap them.
    Shaping(Box<ShapingSetup>),
    /// The next call of [`Executor::next`](super::Executor::next) needs actual positions of the machine at rest.
    ReadActual,
    /// The same with every axis in its window first (P-AXIS-00236): `#CHANNEL INIT [ACTPOS]`.
    TakeActual,
    /// An axis in its window gets another set position.
    SetPosition {
        /// Path axis.
        axis: usize,
        /// New position less the present one in mm (deg).
        offset_mm: f64,
        /// The axis follows (`#CHANNEL INIT [ACTPOS]`); otherwise it does not move, its place has another position from now on
        /// (`X[SET_POSITION ..]`).
        moves: bool,
    },
    /// `#MACHINE DATA`: a parameter of an axis list has changed in [`Executor::machine`](super::Executor::machine).
    MachineData {
        /// Logical axis number.
        axis: u32,
    },
}

/// Why a program ended.
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
    /// One entry per path axis; its gantry slaves are shaped like it.
    pub axes: Vec<AxisShaping>,
    /// One entry per spindle: what its list says, from the start of the program to its end.
    pub spindles: Vec<AxisShaping>,
}

/// Kernel of one axis.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct AxisShaping {
    /// What the kernel is made from.
    pub settings: ShapingSettings,
    /// The kernel; `None` changes nothing.
    pub kernel: Option<Arc<Kernel>>,
}

/// Which of the functions that exclude each other fills the kernel slot of an axis.
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

/// Something that acts at a moment of the program without moving the path.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Event {
    /// G135, G136, G137: the whole state, not the change.
    Feedforward {
        /// G135 (true) or G137.
        on: bool,
        /// Weight of each path axis, 0 to 1 (G136).
        weight_ratios: AxisVec,
    },
    /// `S[G135 G136=80]`: the whole state of one spindle.
    SpindleFeedforward {
        /// Index into `Machine::spindles`.
        spindle: usize,
        /// On or off.
        on: bool,
        /// Weight, 0 to 1.
        weight_ratio: f64,
    },
    /// `S[G130=70]`: weight of the acceleration of one spindle.
    SpindleAcceleration {
        /// Index into `Machine::spindles`.
        spindle: usize,
        /// Weight, above 0; 1 is the acceleration of the list.
        ratio: f64,
    },
    /// `S[GET_DYNAMIC_DATA]`, or a start from rest: the tool of a spindle limits it from now on.
    SpindleLimits {
        /// Index into `Machine::spindles`.
        spindle: usize,
        /// The limits; `None`: those of the list alone.
        limits: Option<SpindleLimits>,
    },
    /// Tapping: a spindle at rest turns with the way of a path axis, from the next cycle on.
    SpindleFollows {
        /// Index into `Machine::spindles`.
        spindle: usize,
        /// The axis, and degrees for a mm of its way; `None`: the spindle is at rest again.
        way: Option<(usize, f64)>,
    },
    /// G96, G97: the speed of a spindle keeps a cutting speed from now on, or stays as it is.
    CuttingSpeed {
        /// Index into `Machine::spindles`.
        spindle: usize,
        /// How fast; `None` ends it.
        cutting: Option<CuttingSpeed>,
    },
    /// M3, M4, M5, M19 with the speed or position of one spindle: the whole state.
    Spindle {
        /// Index into `Machine::spindles`.
        spindle: usize,
        /// What it does.
        motion: SpindleMotion,
    },
    /// `X[INDP_SYN ..]`, `X[INDP_ASYN ..]`: an axis starts a separate motion, independently of the path.
    Independent {
        /// Path axis.
        axis: usize,
        /// What it does.
        motion: IndependentMotion,
    },
    /// `X[OSC ON ..]`: an axis oscillates independently of the path until the program waits for it.
    Oscillation {
        /// Path axis.
        axis: usize,
        /// What it does.
        motion: OscillatingMotion,
    },
    /// `#ENABLE AX LINK`: an axis follows another one from here on; both are at rest.
    Couple {
        /// Path axis that follows.
        slave: usize,
        /// Path axis that is followed.
        master: usize,
        /// Way of the slave for a way of the master.
        ratio: f64,
        /// Where the master is, in mm (deg).
        master_mm: f64,
    },
    /// `#OTC ON`, or OFF with `None`.
    Wear(Option<WearSetting>),
    /// The tool comes to the contour of G41 or G42 in these axes, to its left if true, or leaves it.
    Engaged(Option<([usize; 2], bool)>),
    /// Edge banding: the motion waits for the signal of the probe.
    Banding(BandingRun),
    /// `#DISABLE AX LINK`: the axis stays where it is.
    Uncouple {
        /// Path axis.
        slave: usize,
    },
    /// An M function without a meaning here.
    MFunction {
        /// Number, 0 to 65535.
        number: u32,
        /// `M200=800`.
        value: Option<f64>,
    },
    /// An H function.
    HFunction {
        /// Number, 0 to 65535.
        number: u32,
        /// `H5=2`.
        value: Option<f64>,
    },
    /// T: tool selected.
    Tool {
        /// Pocket or tool number.
        number: u32,
    },
    /// A function that takes a time on the machine which is not part of the run; once for each function.
    Uncounted {
        /// The function, with its duration if the lists declare one.
        function: String,
    },
    /// `#TIMER .. SYN`: at this moment of the motion.
    Timer {
        /// Number.
        id: u32,
        /// What happens to it.
        act: TimerAct,
    },
    /// `#MSG`: text for the log.
    Message {
        /// Receiver as written, `ISG_DIAG_BED` if none was.
        receiver: String,
        /// Formatted text.
        text: String,
        /// `#MSG SAVE`: also for the message file.
        save: bool,
        /// The block that says it.
        source: SourceRef,
    },
}

/// G96: a cutting speed that the spindle keeps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct CuttingSpeed {
    /// Face turning axis.
    pub axis: usize,
    /// Position of the axis in mm where its tool is at the turning centre.
    pub centre_mm: f64,
    /// Cutting speed in mm/min, above 0.
    pub speed_mm_min: f64,
    /// Highest speed in rev/min.
    pub max_rpm: f64,
    /// In rapid blocks: position of the axis whose speed is kept.
    pub held_mm: Option<f64>,
}

impl CuttingSpeed {
    /// Speed in rev/min at a distance from the turning centre.
    pub(crate) fn rpm(&self, radius_mm: f64) -> f64 {
        (self.speed_mm_min / (std::f64::consts::TAU * radius_mm.abs())).min(self.max_rpm)
    }
}

/// What a wait for a spindle waits for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum SpindleState {
    /// It is at rest.
    Rest,
    /// It has its commanded speed or position.
    Reached,
    /// It turns with its speed, and in this cycle through this angle in deg.
    Mark {
        /// Angle.
        deg: f64,
        /// The override does not act on the thread.
        full_override: bool,
    },
}

/// Motion of an independent axis from rest to rest.
///
/// The motions of the path do not contain it: their coordinates of the axis are less by the ways of its independent
/// motions so far.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct IndependentMotion {
    /// Where the axis is, in mm (deg).
    pub from_mm: f64,
    /// Target in mm (deg).
    pub to_mm: f64,
    /// How fast.
    pub speed: IndependentSpeed,
    /// Shape of the acceleration.
    pub slope: SlopeKind,
    /// Its block.
    pub source: SourceRef,
}

/// Motion of an oscillating axis; it always ends at its second position.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct OscillatingMotion {
    /// Where the axis is, in mm (deg).
    pub from_mm: f64,
    /// First and second reversal position in mm (deg), different ones.
    pub reversal_mm: [f64; 2],
    /// Rest at each of them in s.
    pub rest_s: [f64; 2],
    /// How fast; a time is that of one way.
    pub speed: IndependentSpeed,
    /// Shape of the acceleration.
    pub slope: SlopeKind,
    /// Number of oscillations; `None`: until the program waits for the axis.
    pub count: Option<u32>,
    /// Its block.
    pub source: SourceRef,
}

/// What a spindle does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum SpindleMotion {
    /// M3: clockwise.
    Clockwise {
        /// Speed in rev/min, not negative.
        rpm: f64,
    },
    /// M4: counter-clockwise.
    CounterClockwise {
        /// Speed in rev/min, not negative.
        rpm: f64,
    },
    /// M5.
    Stop,
    /// M19.
    Position {
        /// Angle in deg.
        deg: f64,
        /// Speed in rev/min, above 0; none: as fast as the spindle can.
        rpm: Option<f64>,
        /// Which way round.
        approach: Approach,
    },
}

/// The way of a spindle to an angle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Approach {
    /// The shorter way from rest, the direction of rotation of a spindle that turns.
    Free,
    /// M3 with M19.
    Clockwise,
    /// M4 with M19.
    CounterClockwise,
}

/// What the simulation knows when it asks for the next step.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Feedback {
    /// Actual position of each path axis in mm (deg), in channel order; used after [`Sync::ReadActual`].
    pub actual_mm: AxisVec,
    /// Lag of each path axis in its position loop in mm (deg); used after [`Sync::TakeActual`].
    pub lag_mm: AxisVec,
    /// Program time in s.
    pub time_s: f64,
    /// What a measuring run has found, after [`Sync::Measured`].
    pub measured: Option<Box<Probed>>,
}

/// The end of a measuring run, in mm (deg).
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Probed {
    /// Actual position of each path axis where the probe has signalled; `None` if it has not.
    pub signal_mm: Option<AxisVec>,
    /// Where the axes have come to rest, as set positions.
    pub rest_mm: AxisVec,
}

/// Edge banding in one motion: the path stops once after the signal of the probe and continues after the function.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct BandingRun {
    /// Way from the place of the signal to the stop in mm, not negative.
    pub(crate) way_mm: f64,
    /// M function that is called at the stop.
    pub(crate) number: u32,
    /// Its value.
    pub(crate) value: Option<f64>,
    /// How long the path waits for it, in s.
    pub(crate) seconds: f64,
}

/// What wears of a grinding wheel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum WornPart {
    /// The radius: the axes of the plane follow, while the tool is at the contour.
    Radius,
    /// The length.
    Length {
        /// Path axis perpendicular to the plane.
        axis: usize,
    },
}

/// Online tool compensation in force.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct WearSetting {
    /// What wears.
    pub(crate) part: WornPart,
    /// Wear in mm for a mm of way.
    pub(crate) ratio: f64,
    /// Wear from outside counts (input `wear_mm`).
    pub(crate) from_outside: bool,
    /// Most wear from outside in mm (P-TOOL-00031).
    pub(crate) most_mm: f64,
    /// Share of the acceleration limit of the axes with which they follow a change.
    pub(crate) acceleration_ratio: f64,
}
