//! State of a program and the execution of one block.
//!
//! The decoder knows blocks, not files: where the next block comes from is the business of the executor.

use super::block::dialect::Seen;
use super::block::modal::{Corners, FeedType, FeedWord, Modal, PathMode, Plane, Selection};
use super::contour::Contour;
use super::fault::Fault;
use super::geometry::coordinates::Coordinates;
use super::geometry::tools::Tools;
use super::geometry::{Geometry, LastArc};
use super::motion::dynamics::{Weights, channel_dynamics};
use super::motion::overrides::Overrides;
use super::motion::spindles::Spindle;
use super::motion::state::measuring::Measuring;
use super::motion::state::{
    ContourLines, Feedforward, Independent, MotionState, Straight, Technology, Threads,
};
use super::options::Options;
use super::program::state::Calls;
use super::shaping::{ShapingState, Worked};
use super::step::{Event, Feedback, SourceRef, Sync};
use super::values::Values;
use super::values::timers::Timers;
use super::values::variables::Variables;
use crate::diag::{Condition, Diagnostic, Location};
use crate::machine::{Axis, AxisKind, Machine};
use crate::syntax::ast::{Group, Ident, ItemKind, Span};
use kontur_motion::axis::AxisVec;
use kontur_motion::block::{ChannelDynamics, VectorLimits};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// Names of the axes in the program.
#[derive(Debug)]
pub(super) struct AxisNames {
    /// `None` for an axis that was given away.
    pub(super) axes: Vec<Option<String>>,
    /// Letters of one-letter axes.
    letters: [Option<u8>; 26],
    /// Parsed blocks are out of date.
    pub(super) changed: bool,
}

/// Messages about the program, each with its block.
#[derive(Debug, Default)]
pub(super) struct Report {
    /// Place of the block in work.
    pub(super) source: SourceRef,
    /// Its first line, for conditions that name an earlier place.
    pub(super) location: Option<Location>,
    /// Conditions of the block in work.
    faults: Vec<Fault>,
    /// Conditions without a place in a block.
    pub(super) unplaced: Vec<Diagnostic>,
    said: BTreeSet<String>,
}

/// A signal that has been sent.
#[derive(Debug)]
pub(super) struct Signal {
    pub(super) id: u32,
    /// Sent to everybody; else to this channel itself.
    pub(super) broadcast: bool,
    /// Waits that it still serves, `None` without limit.
    pub(super) count: Option<u32>,
    pub(super) parameters: Vec<(u32, f64)>,
}

/// State of a running program: what the rooms own, and what all of them read.
#[derive(Debug)]
pub(super) struct Decoder {
    pub(super) machine: Arc<Machine>,
    pub(super) identity_trafo: bool,
    pub(super) technology: Technology,
    pub(super) feedback: Feedback,
    pub(super) names: AxisNames,
    pub(super) report: Report,
    pub(super) modal: Modal,
    pub(super) dialect: Seen,
    pub(super) values: Values,
    pub(super) geometry: Geometry,
    pub(super) contour: Contour,
    pub(super) motion: MotionState,
    pub(super) shaping: ShapingState,
    pub(super) calls: Calls,
    /// Signals that have not been used up.
    pub(super) signals: Vec<Signal>,
    /// Syntax check: blocks with errors are carried out as far as possible.
    pub(super) checking: bool,
    /// A motion of the block in work went out.
    pub(super) moved: bool,
    /// What the plain motions of a row share.
    pub(super) straight: Option<Box<Straight>>,
}

impl Decoder {
    /// The state at the start of a program.
    pub(super) fn new(machine: Arc<Machine>, options: Options, start: &AxisVec) -> Self {
        let n = machine.axes.len();
        let mut spindles: Vec<Spindle> = machine
            .spindles
            .iter()
            .enumerate()
            .map(|(i, s)| Spindle::new(s.name(), Some(i)))
            .collect();
        if spindles.is_empty() {
            spindles.push(Spindle::new("S", None));
        }
        let axis_names: Vec<_> = machine.axes.iter().map(|a| Some(a.name().to_owned())).collect();
        let forced = options.guard.is_some();
        let mut decoder = Self {
            identity_trafo: options.identity_trafo,
            technology: Technology::new(options.techno_times),
            feedback: Feedback::default(),
            names: AxisNames { axes: axis_names, letters: [None; 26], changed: false },
            report: Report::default(),
            modal: Modal::start(machine.channel.slope, machine.channel.constant_ramp_time),
            dialect: Seen::default(),
            values: Values {
                variables: Variables::new(options.external),
                kinematics: BTreeMap::new(),
                timers: Timers::default(),
            },
            geometry: Geometry {
                coordinates: Coordinates::new(start),
                limits_mm: machine.axes.iter().map(Axis::software_limits_mm).collect(),
                last_arc: LastArc::default(),
                last_system: 1,
                transformation_on: false,
                tools: Tools { table: machine.tools.clone(), ..Tools::default() },
            },
            contour: Contour::default(),
            motion: MotionState {
                weights: Weights::new(n),
                feed_axes: machine.channel.feed_axes.clone(),
                vector: [VectorLimits::default(); 2],
                dynamics: [None, None],
                overrides: Overrides::new(n),
                independent: Independent::new(n),
                feedforward: Feedforward {
                    on: false,
                    weight_ratios: AxisVec::from_slice(&vec![1.0; n]),
                },
                spindles,
                threads: Threads::new(&machine.channel),
                measuring: Measuring::new(&machine.channel, n),
                contour_line: ContourLines::default(),
                corner: None,
                feed_before: None,
                left_contour: false,
                cutting_speed: None,
                cutting_waits: false,
                cutting_rpm_max: None,
            },
            shaping: ShapingState::new(options.guard),
            calls: Calls {
                cycle_files: machine.channel.g8x_programs.clone(),
                tool_change_file: machine.channel.tool_change_program.clone(),
                ..Calls::default()
            },
            signals: Vec::new(),
            checking: false,
            moved: false,
            straight: None,
            machine,
        };
        let offsets = &decoder.machine.zero_offsets;
        for ((group, axis), value) in &offsets.entries {
            if *axis < n {
                decoder.geometry.coordinates.set_zero_entry(*group, *axis, *value);
            }
        }
        decoder.geometry.coordinates.select_zero_group(offsets.start_group);
        let main = decoder.listed_main_spindle();
        decoder.motion.spindles.swap(0, main);
        decoder.axis_names_changed();
        decoder.presets();
        let Worked { setup, diagnostics } = decoder.shaping.work_out(&decoder.machine);
        decoder.shaping.setup = setup;
        // what is wrong with single filters of the lists is reported, with its place, when the chains are set up
        let of_several = [Condition::ListFirAndGuard, Condition::UnequalKernels];
        let of_forced =
            [Condition::GuardMode, Condition::GuardRange, Condition::GuardNotRealisable];
        let told = |d: &Diagnostic| {
            let known = |conditions: &[Condition]| conditions.iter().any(|c| d.id == *c);
            known(&of_several) || (forced && known(&of_forced))
        };
        decoder.report.unplaced.extend(diagnostics.into_iter().filter(told));
        decoder
    }

    /// Start values of the channel list (P-CHAN-00054, 00063, 00099).
    fn presets(&mut self) {
        let machine = Arc::clone(&self.machine);
        let channel = &machine.channel;
        self.modal.inch = channel.inch;
        if let Some(v) = channel.feed_mm_s {
            let value = v * 60.0 / channel.feed_unit_mm_min;
            let per_minute = FeedType::PerMinute as usize;
            self.modal.feeds[per_minute] = Some(FeedWord { value, inch: false });
        }
        for (group, g) in &channel.g_groups {
            match (group, g) {
                (0, 0) => self.modal.path = PathMode::Rapid,
                (0, 2) => self.modal.path = PathMode::Clockwise,
                (0, 3) => self.modal.path = PathMode::CounterClockwise,
                (4, 18) => self.modal.plane = Plane::Zx,
                (4, 19) => self.modal.plane = Plane::Yz,
                (6, 25) => self.modal.corners = Corners::Straight,
                (6, 26) => self.modal.corners = Corners::Round,
                (12, 70) => self.modal.inch = true,
                (12, 71) => self.modal.inch = false,
                (14, 91) => self.modal.absolute = false,
                (22, 138) => self.modal.selection = Selection::Direct,
                (22, 237) => self.modal.selection = Selection::Perpendicular,
                (22, 238) => self.modal.selection = Selection::InsideCorner,
                (22, 239) => self.modal.selection = Selection::WithoutBlock,
                (23, 161) => self.modal.centre_absolute = true,
                (25, 164) => self.modal.centre_correction = false,
                // start values of the language; feedforward has a warning of its own
                (0, 1)
                | (4, 17)
                | (8, 52)
                | (14, 90)
                | (22, 139)
                | (23, 162)
                | (25, 165)
                | (32, 140)
                | (21, _) => {}
                (group, g) => {
                    let text = format!("prog_start.g_gruppe[{group}].nr {g} is not simulated");
                    let d = Diagnostic::new(Condition::Fallback, text).parameter("P-CHAN-00063");
                    self.report.unplaced.push(d);
                }
            }
        }
    }

    /// Adds a condition of the block in work.
    pub(super) fn note(&mut self, fault: Box<Fault>) {
        self.report.faults.push(*fault);
    }

    /// Adds a condition unless one with this key was added before in this program.
    pub(super) fn note_once(&mut self, key: &str, fault: Box<Fault>) {
        if self.report.said.insert(key.to_owned()) {
            self.report.faults.push(*fault);
        }
    }

    /// Forgets that something was said.
    pub(super) fn unsay(&mut self, key: &str) {
        self.report.said.remove(key);
    }

    pub(super) fn take_faults(&mut self) -> Vec<Fault> {
        std::mem::take(&mut self.report.faults)
    }

    /// Adds to the condition noted last.
    pub(super) fn amend(&mut self, f: impl FnOnce(Diagnostic) -> Diagnostic) {
        if let Some(fault) = self.report.faults.pop() {
            let diagnostic = f(fault.diagnostic);
            self.report.faults.push(Fault { diagnostic, ..fault });
        }
    }

    /// True if the block in work has an error.
    pub(super) fn failed(&self) -> bool {
        self.report.faults.iter().any(Fault::is_error)
    }

    /// Takes over an outcome: a fault becomes a condition of the block.
    pub(super) fn keep<T>(&mut self, outcome: Result<T, Box<Fault>>) -> Option<T> {
        match outcome {
            Ok(value) => Some(value),
            Err(fault) => {
                self.report.faults.push(*fault);
                None
            }
        }
    }

    /// An event that acts with the next step.
    pub(super) fn event(&mut self, event: Event) {
        self.contour.event(event);
    }

    /// A step at rest; left out if the block has an error, unless only the syntax is checked.
    pub(super) fn sync(&mut self, what: Sync) {
        if self.failed() && !self.checking {
            return;
        }
        if what != Sync::ThreadEnd {
            self.end_thread();
        }
        if matches!(what, Sync::FlushWait) {
            self.motion.independent.all_arrived();
        }
        let faults = self.contour.sync(what, self.report.source);
        self.report.faults.extend(faults);
        let outside = self.limits_of_compensated();
        self.report.faults.extend(outside);
    }

    /// Names of axes have changed.
    pub(super) fn names_changed(&mut self) {
        self.axis_names_changed();
        self.names.changed = true;
    }

    /// Axes take over where they really are; all of them if none is named.
    pub(super) fn take_actual_positions(&mut self, axes: &[usize]) {
        let mut target = self.geometry.coordinates.target().clone();
        for (axis, position) in target.iter_mut().enumerate() {
            if axes.is_empty() || axes.contains(&axis) {
                *position = self.feedback.actual_mm.get(axis).copied().unwrap_or(*position);
            }
        }
        self.geometry.coordinates.set_target(&target);
    }

    /// `#MACHINE DATA`: one value of an axis list.
    pub(super) fn set_machine_data(
        &mut self,
        axis: usize,
        key: &str,
        value: &str,
        span: Span,
    ) -> Result<(), Box<Fault>> {
        let machine = Arc::make_mut(&mut self.machine);
        if let Err(reason) = machine.axes[axis].set(key, value) {
            let text = format!("axis {}: {reason}", machine.axes[axis].name());
            return Err(Fault::new(Condition::TokenUnknown, text, span));
        }
        let number = machine.axes[axis].number();
        self.dynamics_changed();
        self.sync(Sync::MachineData { axis: number });
        self.update_shaping(span);
        Ok(())
    }

    /// Dynamics in force in feed or rapid blocks; rebuilt when something changed.
    pub(super) fn dynamics(&mut self, rapid: bool) -> Arc<ChannelDynamics> {
        let mode = usize::from(rapid && self.motion.vector[0] != self.motion.vector[1]);
        if let Some(dynamics) = &self.motion.dynamics[mode] {
            return Arc::clone(dynamics);
        }
        let (mut dynamics, _) = channel_dynamics(
            &self.machine,
            &self.motion.weights,
            &self.modal,
            self.motion.vector[mode],
        );
        dynamics.feed_axes.clone_from(&self.motion.feed_axes);
        let dynamics = Arc::new(dynamics);
        self.motion.dynamics[mode] = Some(Arc::clone(&dynamics));
        dynamics
    }

    /// Something the dynamics are made from has changed.
    pub(super) fn dynamics_changed(&mut self) {
        self.motion.dynamics = [None, None];
    }

    /// Names have changed.
    pub(super) fn axis_names_changed(&mut self) {
        self.names.letters = [None; 26];
        for (i, name) in self.names.axes.iter().enumerate() {
            if let Some([letter @ b'A'..=b'Z']) = name.as_deref().map(str::as_bytes) {
                self.names.letters[usize::from(letter - b'A')] = u8::try_from(i).ok();
            }
        }
    }

    /// Axis of a letter.
    pub(super) fn axis_of_letter(&self, letter: u8) -> Option<usize> {
        let i = usize::from(letter.wrapping_sub(b'A'));
        self.names.letters.get(i).copied().flatten().map(usize::from)
    }

    /// Axis of a name in either case.
    pub(super) fn axis_of_name(&self, name: &str) -> Option<usize> {
        self.names
            .axes
            .iter()
            .position(|n| n.as_deref().is_some_and(|n| n.eq_ignore_ascii_case(name)))
    }

    /// Axis of a name in a `#` command; 20797 if there is none.
    pub(super) fn axis_in_command(&self, name: &Ident) -> Result<usize, Box<Fault>> {
        self.axis_of_name(&name.text).ok_or_else(|| {
            let text = format!("unknown axis `{}`", name.text);
            Fault::new(Condition::AxisNameUnknown, text, name.span).hint(self.axis_hint())
        })
    }

    /// The axes named in groups of a command.
    pub(super) fn axes_in_command(&self, groups: &[Group]) -> Result<Vec<usize>, Box<Fault>> {
        let mut axes = Vec::new();
        for item in groups.iter().flat_map(|group| &group.items) {
            match &item.kind {
                ItemKind::Flag(name) => axes.push(self.axis_in_command(name)?),
                ItemKind::Missing => {}
                _ => {
                    let text = "an axis name is expected";
                    return Err(Fault::new(Condition::AxisNameUnknown, text, item.span));
                }
            }
        }
        Ok(axes)
    }

    /// Which axes there are.
    pub(super) fn axis_hint(&self) -> String {
        let names: Vec<&str> = self.names.axes.iter().filter_map(|n| n.as_deref()).collect();
        format!("axes of the channel: {}", names.join(", "))
    }

    pub(super) fn axis_name(&self, axis: usize) -> &str {
        self.names.axes[axis].as_deref().unwrap_or("?")
    }

    pub(super) fn is_linear(&self, axis: usize) -> bool {
        self.machine.axes[axis].kind() == AxisKind::Linear
    }

    /// Millimetres per unit of length in the program.
    pub(super) fn unit_mm(&self) -> f64 {
        if self.modal.inch { 25.4 } else { 1.0 }
    }

    /// Factor from programmed values of an axis to mm (deg).
    pub(super) fn axis_unit(&self, axis: usize) -> f64 {
        if self.modal.inch && self.is_linear(axis) { 25.4 } else { 1.0 }
    }

    /// Unit of tolerance words in mm (P-CHAN-00439).
    pub(super) fn tolerance_unit_mm(&self) -> f64 {
        if self.machine.channel.contouring_consider_inch { self.unit_mm() } else { 1.0 }
    }

    /// Where the spindle of P-CHAN-00051 stands among the spindles, or else the first one of the lists.
    pub(super) fn listed_main_spindle(&self) -> usize {
        let listed = self
            .machine
            .channel
            .main_spindle
            .and_then(|main| self.machine.spindles.iter().position(|s| s.number() == main));
        let is = |spindle: &Spindle| spindle.index == Some(listed.unwrap_or(0));
        self.motion.spindles.iter().position(is).unwrap_or(0)
    }

    /// Spindle of a name in either case: that of its list, and for the main spindle P-CHAN-00053.
    pub(super) fn spindle_of_name(&self, name: &str) -> Option<usize> {
        let main = name.eq_ignore_ascii_case(&self.machine.channel.main_spindle_name);
        let listed = self.motion.spindles.iter().position(|s| s.name.eq_ignore_ascii_case(name));
        if main { Some(0) } else { listed }
    }

    /// Names of several characters that the parser has to know.
    pub(super) fn long_names(&self) -> Vec<String> {
        let axes = self.names.axes.iter().flatten().cloned();
        let main = [self.machine.channel.main_spindle_name.clone()];
        axes.chain(self.motion.spindles.iter().map(|s| s.name.clone()))
            .chain(main)
            .filter(|n| n.len() > 1)
            .collect()
    }

    /// Works the shaping out anew; a changed kernel needs the path at rest.
    pub(super) fn update_shaping(&mut self, span: Span) {
        let Worked { setup, diagnostics } = self.shaping.work_out(&self.machine);
        for diagnostic in diagnostics {
            self.note(Fault::of(diagnostic, span));
        }
        if setup != self.shaping.setup {
            self.shaping.setup = setup.clone();
            self.sync(Sync::Shaping(Box::new(setup)));
        }
    }
}
