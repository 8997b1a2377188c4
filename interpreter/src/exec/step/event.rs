//! Events: what acts at the begin of a step, without a motion of its own.

use super::{IndependentMotion, OscillatingMotion, SourceRef};
use crate::machine::SpindleLimits;
use kontur_motion::axis::{AxisDynamics, AxisVec};

/// An action at a point of the program that does not move the path.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Event {
    /// G135, G136, G137: the complete state, not the change.
    Feedforward {
        /// G135 (true) or G137.
        on: bool,
        /// Weight of each path axis, 0 to 1 (G136).
        weight_ratios: AxisVec,
    },
    /// G98, G99, or `#MACHINE DATA`: other software limits of an axis.
    SoftwareLimits {
        /// Index into `Machine::axes`.
        axis: usize,
        /// The limits in mm; `None`: not monitored.
        limits_mm: Option<(f64, f64)>,
    },
    /// `S[G135 G136=80]`: the complete state of one spindle.
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
    /// G112: another gear stage of a spindle at rest.
    SpindleDynamics {
        /// Index into `Machine::spindles`.
        spindle: usize,
        /// Limits of the stage.
        dynamics: Box<AxisDynamics>,
    },
    /// `S[GET_DYNAMIC_DATA]`, or a start from standstill: the limits of the tool apply to a spindle from now on.
    SpindleLimits {
        /// Index into `Machine::spindles`.
        spindle: usize,
        /// The limits; `None`: those of the list only.
        limits: Option<SpindleLimits>,
    },
    /// Tapping: a spindle at standstill is coupled to the motion of a path axis, from the next cycle on.
    SpindleFollows {
        /// Index into `Machine::spindles`.
        spindle: usize,
        /// The axis, and degrees per mm of its travel; `None`: ends the coupling, with the spindle at standstill.
        way: Option<(usize, f64)>,
    },
    /// G96, G97: from now on a spindle follows a constant cutting speed, or keeps its current speed.
    CuttingSpeed {
        /// Index into `Machine::spindles`.
        spindle: usize,
        /// The cutting speed; `None` ends it.
        cutting: Option<CuttingSpeed>,
    },
    /// M3, M4, M5, M19 with the speed or position of one spindle: the complete state.
    Spindle {
        /// Index into `Machine::spindles`.
        spindle: usize,
        /// Its commanded state.
        motion: SpindleMotion,
    },
    /// `X[INDP_SYN ..]`, `X[INDP_ASYN ..]`: an axis starts a separate motion, independently of the path.
    Independent {
        /// Path axis.
        axis: usize,
        /// Its motion.
        motion: IndependentMotion,
    },
    /// `X[OSC ON ..]`: an axis oscillates independently of the path until the program waits for it.
    Oscillation {
        /// Path axis.
        axis: usize,
        /// Its motion.
        motion: OscillatingMotion,
    },
    /// `#ENABLE AX LINK`: an axis follows another one from now on; both are at standstill.
    Couple {
        /// Path axis of the slave.
        slave: usize,
        /// Path axis of the master.
        master: usize,
        /// Travel of the slave per travel of the master.
        ratio: f64,
        /// Position of the master, in mm (deg).
        master_mm: f64,
    },
    /// `#OTC ON`, or OFF with `None`.
    Wear(Option<WearSetting>),
    /// The tool reaches the contour of G41 or G42 in these axes, on its left if true, or leaves it.
    Engaged(Option<([usize; 2], bool)>),
    /// Edge banding: the motion waits for the signal of the probe.
    Banding(BandingRun),
    /// `#DISABLE AX LINK`: the axis keeps its position.
    Uncouple {
        /// Path axis.
        slave: usize,
    },
    /// An M function without a predefined meaning.
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
    /// A function with a duration on the machine that is not included in the run; once per function.
    Uncounted {
        /// The function, with its duration if the lists declare one.
        function: String,
    },
    /// `#TIMER .. SYN`: takes effect at this point of the motion.
    Timer {
        /// Number.
        id: u32,
        /// The operation on it.
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
        /// The block of the command.
        source: SourceRef,
    },
}

/// G96: the cutting speed that the spindle maintains.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct CuttingSpeed {
    /// Face turning axis.
    pub axis: usize,
    /// Position of the axis in mm with its tool at the turning centre.
    pub centre_mm: f64,
    /// Cutting speed in mm/min, above 0.
    pub speed_mm_min: f64,
    /// Highest speed in rev/min.
    pub max_rpm: f64,
    /// In rapid blocks: position of the axis for which the speed is kept.
    pub held_mm: Option<f64>,
}

impl CuttingSpeed {
    /// Speed in rev/min at a distance from the turning centre.
    pub(crate) fn rpm(&self, radius_mm: f64) -> f64 {
        (self.speed_mm_min / (std::f64::consts::TAU * radius_mm.abs())).min(self.max_rpm)
    }
}

/// Commanded state of a spindle.
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
        /// Speed in rev/min, above 0; `None`: the maximum speed of the spindle.
        rpm: Option<f64>,
        /// Direction of the motion to the angle.
        approach: Approach,
    },
}

/// Direction of a spindle to an angle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Approach {
    /// The shorter way from standstill, the current direction of rotation otherwise.
    Free,
    /// M3 with M19.
    Clockwise,
    /// M4 with M19.
    CounterClockwise,
}

/// Edge banding in one motion: the path stops once after the signal of the probe and continues after the function.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct BandingRun {
    /// Distance from the position of the signal to the stop in mm, not negative.
    pub(crate) way_mm: f64,
    /// M function executed at the stop.
    pub(crate) number: u32,
    /// Its value.
    pub(crate) value: Option<f64>,
    /// Duration for which the path waits, in s.
    pub(crate) seconds: f64,
}

/// The dimension of a grinding wheel that wears.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum WornPart {
    /// The radius: the axes of the plane compensate it while the tool is at the contour.
    Radius,
    /// The length.
    Length {
        /// Path axis along the tool.
        axis: usize,
        /// Direction of the tool in this axis, 1 or -1.
        sign: f64,
    },
}

/// Active online tool compensation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct WearSetting {
    /// The dimension that wears.
    pub(crate) part: WornPart,
    /// D of the wheel.
    pub(crate) wheel: u32,
    /// Wear in mm per mm of travel.
    pub(crate) ratio: f64,
    /// Whether external wear is included (input `wear_mm`).
    pub(crate) from_outside: bool,
    /// Maximum external wear in mm (P-TOOL-00031).
    pub(crate) most_mm: f64,
    /// Share of the acceleration limit of the axes that is used to follow a change.
    pub(crate) acceleration_ratio: f64,
}

/// An operation on a timer that was executed during a motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct TimerCall {
    /// Number.
    pub id: u32,
    /// The operation.
    pub act: TimerAct,
    /// Program time in s.
    pub time_s: f64,
}

/// Operation on a timer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum TimerAct {
    /// Starts the timer.
    Start,
    /// Stops the timer.
    Stop,
    /// Copies its count to `V.G.TIMER`.
    Read,
    /// Stops it and sets it to 0; `V.G.TIMER` is unchanged.
    Clear,
}
