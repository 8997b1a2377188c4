//! State of motions from block to block.

pub(in crate::exec) mod areas;
pub(in crate::exec) mod coupling;
mod cutting;
mod limits;
pub(in crate::exec) mod measuring;
pub(in crate::exec) mod wear;

use self::areas::Areas;
use self::coupling::Couplings;
use self::cutting::Cutting;
use self::limits::{Beside, PathLimits};
use self::measuring::Measuring;
use self::wear::OnlineCompensation;
use super::overrides::Overrides;
use super::spindles::{self, Spindle};
use crate::diag::Condition;
use crate::exec::block::modal::{FeedWord, Modal};
use crate::exec::contour::{Contour, Corner};
use crate::exec::fault::{Fault, Outcome};
use crate::exec::geometry::coordinates::Target;
use crate::exec::step::{Event, SourceRef};
use crate::machine::{Acknowledged, Channel, Machine, SpindleMoment};
use crate::syntax::ast::Span;
use kontur_motion::axis::AxisVec;
use kontur_motion::block::{
    Block, ChannelDynamics, ContourSettings, Feed, Slope, SplineSettings, Tolerance,
};
use kontur_motion::path::Path;
use std::collections::BTreeSet;
use std::sync::Arc;

/// Feedforward of the path axes.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::exec) struct Feedforward {
    pub(in crate::exec) on: bool,
    pub(in crate::exec) weight_ratios: AxisVec,
}

impl Feedforward {
    /// The state as an event.
    pub(in crate::exec) fn event(&self) -> Event {
        Event::Feedforward { on: self.on, weight_ratios: self.weight_ratios.clone() }
    }
}

/// The way contouring is selected.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::exec) enum Contouring {
    /// G61, for the end of one block.
    Once,
    /// G261.
    Modal,
}

/// State that the motions own.
#[derive(Debug)]
pub(in crate::exec) struct MotionState {
    pub(in crate::exec) limits: PathLimits,
    pub(in crate::exec) overrides: Overrides,
    pub(in crate::exec) independent: Independent,
    pub(in crate::exec) couplings: Couplings,
    pub(in crate::exec) feedforward: Feedforward,
    pub(in crate::exec) spindles: Vec<Spindle>,
    pub(in crate::exec) threads: Threads,
    pub(in crate::exec) measuring: Measuring,
    pub(in crate::exec) contour_line: ContourLines,
    /// How the last motion block with contouring has selected it.
    pub(in crate::exec) contouring: Contouring,
    /// `#CORNER PARAM`.
    pub(in crate::exec) corner: Option<Corner>,
    /// F word before the current block.
    pub(in crate::exec) feed_before: Option<FeedWord>,
    /// G40 with G239: the tool is beside the contour, not at the programmed position.
    pub(in crate::exec) left_contour: bool,
    pub(in crate::exec) cutting: Cutting,
    /// `#OTC`.
    pub(in crate::exec) wear: OnlineCompensation,
    pub(in crate::exec) areas: Areas,
    /// `[LIFT_START ..]` that has not ended yet.
    pub(in crate::exec) lifts: bool,
    /// Axes in manual mode (G201).
    pub(in crate::exec) manual: Vec<bool>,
    /// S of the last G04: number of revolutions of the spindle.
    pub(in crate::exec) dwell_revolutions: f64,
    pub(super) technology: Technology,
}

impl MotionState {
    /// At program start; `counts_times`: the path waits for the declared durations of functions.
    pub(in crate::exec) fn new(machine: &Machine, counts_times: bool) -> Self {
        let n = machine.axes.len();
        Self {
            limits: PathLimits::new(machine),
            overrides: Overrides::new(n),
            independent: Independent::new(n),
            couplings: Couplings::of_lists(machine),
            feedforward: Feedforward {
                on: false,
                weight_ratios: AxisVec::from_slice(&vec![1.0; n]),
            },
            spindles: spindles::of_lists(machine),
            threads: Threads::new(&machine.channel),
            measuring: Measuring::new(&machine.channel, n),
            contour_line: ContourLines::default(),
            contouring: Contouring::Modal,
            corner: None,
            feed_before: None,
            left_contour: false,
            cutting: Cutting::default(),
            wear: OnlineCompensation::default(),
            areas: Areas::default(),
            lifts: false,
            manual: vec![false; n],
            dwell_revolutions: 0.0,
            technology: Technology::new(counts_times),
        }
    }

    /// Dynamics of the current block; a measuring run has those of rapid blocks, without weights of accelerations and ramp times,
    /// unless P-CHAN-00296 is 1 (895605131).
    pub(super) fn dynamics_of_block(
        &mut self,
        machine: &Machine,
        modal: &Modal,
        rapid: bool,
    ) -> Arc<ChannelDynamics> {
        if self.measuring.runs && !machine.channel.measuring.as_feed {
            let beside = Beside { couplings: &self.couplings, manual: &self.manual };
            return Arc::new(self.limits.measuring(machine, modal, beside));
        }
        self.dynamics(machine, modal, rapid)
    }

    /// Outputs the feedforward of a spindle of the machine.
    pub(in crate::exec) fn spindle_feedforward(&self, spindle: usize, contour: &mut Contour) {
        if let Some(event) = self.spindles[spindle].feedforward_event() {
            contour.event(event);
        }
    }

    /// The override of the axes that move.
    pub(super) fn override_of(&self, path: &Path, rapid: bool) -> f64 {
        let moves = |axis: &usize| {
            path.extent(*axis).is_none_or(|(low, high)| low.to_bits() != high.to_bits())
        };
        let moved = (0..self.limits.feed_axes().len()).filter(moves);
        self.overrides.ratio(rapid, moved)
    }

    /// Active dynamics in feed or rapid blocks.
    pub(super) fn dynamics(
        &mut self,
        machine: &Machine,
        modal: &Modal,
        rapid: bool,
    ) -> Arc<ChannelDynamics> {
        let beside = Beside { couplings: &self.couplings, manual: &self.manual };
        self.limits.dynamics(machine, modal, beside, rapid)
    }

    /// Names of the spindles: those of their lists, and P-CHAN-00053.
    pub(in crate::exec) fn spindle_names<'a>(
        &'a self,
        channel: &'a Channel,
    ) -> impl Iterator<Item = &'a str> {
        let main = std::iter::once(&*channel.spindles.main_name);
        self.spindles.iter().map(|s| &*s.name).chain(main)
    }

    /// The spindle with this name, in upper or lower case: the name of its list, and for the main spindle P-CHAN-00053.
    pub(in crate::exec) fn spindle_of_name(&self, name: &str, channel: &Channel) -> Option<usize> {
        let main = name.eq_ignore_ascii_case(&channel.spindles.main_name);
        let listed = self.spindles.iter().position(|s| s.name.eq_ignore_ascii_case(name));
        if main { Some(0) } else { listed }
    }
}

/// First of two contour lines, which is executed with the second one.
#[derive(Clone, Copy, Debug)]
pub(super) struct FirstLine {
    pub(super) angle_deg: f64,
    pub(super) span: Span,
    pub(super) source: SourceRef,
    /// It was refused; the second line is not judged without it.
    pub(super) refused: bool,
}

/// State of contour line programming.
#[derive(Clone, Debug, Default)]
pub(in crate::exec) struct ContourLines {
    /// First of two lines.
    pub(super) open: Option<FirstLine>,
    /// The coordinates that an angle (`#ANG`, `#CANG`) gives to the current block.
    pub(super) targets: Vec<Target>,
}

impl ContourLines {
    /// Whether a first line still lacks its second one.
    pub(in crate::exec) fn is_open(&self) -> bool {
        self.open.is_some()
    }

    /// 21909: the channel is not emptied between the two blocks of a contour line.
    pub(in crate::exec) fn may_flush(&self, what: &str, span: Span) -> Outcome<()> {
        if self.is_open() {
            let text = format!("{what} between the two blocks of a contour line (#ANG)");
            return Err(Fault::new(Condition::FlushInContourLine, text, span));
        }
        Ok(())
    }
}

/// Independent axes of a program.
#[derive(Clone, Debug)]
pub(in crate::exec) struct Independent {
    /// Distance that each axis has travelled independently, summed.
    pub(in crate::exec) way: AxisVec,
    /// Axes that may still be moving: INDP_ASYN without a wait so far.
    pub(super) open: Vec<usize>,
    /// INDP_SYN of the current block.
    pub(super) synchronous: Vec<usize>,
}

impl Independent {
    pub(in crate::exec) fn new(axes: usize) -> Self {
        Self { way: AxisVec::zeros(axes), open: Vec::new(), synchronous: Vec::new() }
    }

    /// Position of the axes without their independent travel.
    pub(super) fn on_path(&self, mut position: AxisVec) -> AxisVec {
        for (x, way) in position.iter_mut().zip(self.way.iter()) {
            *x -= way;
        }
        position
    }

    /// Whether no axis has moved independently so far.
    pub(in crate::exec) fn is_unused(&self) -> bool {
        self.open.is_empty() && self.way.iter().all(|way| way.to_bits() == 0)
    }

    /// Called when the path has stopped and every axis has arrived.
    pub(in crate::exec) fn all_arrived(&mut self) {
        self.open.clear();
    }
}

/// State shared by consecutive motions.
#[derive(Debug)]
pub(in crate::exec) struct Straight {
    pub(super) feed: Feed,
    pub(super) feed_ratio: f64,
    pub(super) slope: Slope,
    pub(super) dynamics: Arc<ChannelDynamics>,
    pub(super) tolerance: Tolerance,
    pub(super) contour: Option<ContourSettings>,
    pub(super) spline: Option<SplineSettings>,
    pub(super) plane: [usize; 2],
    /// See [`Coordinates::active_offsets`](crate::exec::geometry::coordinates::Coordinates::active_offsets).
    pub(super) offsets: AxisVec,
}

/// A function that the machine executes during the motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(in crate::exec) enum Function {
    M(u32),
    H(u32),
    Tool,
    /// M03, M04, M05, M19 of a spindle of the machine.
    Spindle {
        spindle: usize,
        m: u32,
    },
    /// S word of a spindle of the machine.
    Speed {
        spindle: usize,
    },
}

/// Durations of the functions of the current block.
#[derive(Debug, Default)]
pub(in crate::exec) struct Technology {
    /// Whether the path waits for declared durations.
    pub(super) counted: bool,
    /// Functions to wait for: time in s, and whether before or after the motion.
    pub(super) pending: Vec<(f64, Acknowledged, Function)>,
    /// Spindles that the path still has to wait for.
    pub(super) spindles: Vec<(usize, SpindleMoment)>,
    pub(super) named: BTreeSet<Function>,
}

impl Technology {
    pub(in crate::exec) fn new(counted: bool) -> Self {
        Self { counted, ..Self::default() }
    }
}

/// State of thread cutting.
#[derive(Clone, Debug, Default)]
pub(in crate::exec) struct Threads {
    /// Pitches in mm by main axis (I, J, K); signed for G331.
    pub(super) pitch_mm: [Option<f64>; 3],
    /// Speed of the last tapping in rev/min, signed.
    pub(super) tapping_rpm: Option<f64>,
    /// Whether the path follows the rotating spindle.
    pub(in crate::exec::motion) cutting: bool,
    /// The previous block of a chain.
    pub(super) last: Option<Box<Block>>,
    /// The spindle of the previous block of G33 and its speed in rev/min, negative for M4.
    pub(super) turned: Option<(usize, f64)>,
    /// The pitch of that block in mm.
    pub(super) cut_mm: f64,
    /// State of `#TURN`.
    pub(in crate::exec) turning: TurningModes,
}

/// How blocks of G33 are chained, and the effect of the override on them.
#[derive(Clone, Copy, Debug, Default)]
pub(in crate::exec) struct TurningModes {
    /// Consecutive blocks are one thread (P-CHAN-00837).
    pub(in crate::exec) chain: bool,
    /// The override has no effect (P-CHAN-00836).
    pub(in crate::exec) ignore_override: bool,
}

impl TurningModes {
    /// G33 keeps its pitch under an override.
    pub(super) const fn full_override(self) -> bool {
        self.ignore_override || self.chain
    }
}

impl Threads {
    /// The setting of the channel list.
    pub(in crate::exec) fn new(channel: &Channel) -> Self {
        let turning = TurningModes {
            chain: channel.threads.chain,
            ignore_override: channel.threads.ignore_override,
        };
        Self { turning, ..Self::default() }
    }

    /// An S word: signed in tapping; otherwise it ends the speed of tapping.
    pub(in crate::exec) fn speed(&mut self, tapping_rpm: Option<f64>) {
        self.tapping_rpm = tapping_rpm;
    }
}
