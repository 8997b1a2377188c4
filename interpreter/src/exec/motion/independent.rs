//! Independent axes: `X[INDP_SYN G90 G01 FEED=1000 POS=50]`, `X[INDP_ASYN ..]`, `#WAIT INDP [X, Y]`.
//!
//! An independent axis leaves the path and moves with its own profile, from standstill to standstill. The path is planned
//! without that motion: its coordinates of the axis are shifted by the distances that the axis has travelled independently
//! ([`Independent::way`]), so that they stay continuous. The simulation adds the shift to the path.
//!
//! Source: TF5200 programming manual, independent axes (208612235); 21068, 21071. Assumption: INCL_OFFSETS has no effect on an
//! increment (G91), and an increment of a modulo axis is not replaced by the shortest way.

mod words;

use super::state::Function;
use crate::diag::Condition;
use crate::exec::block::collected::Words as BlockWords;
use crate::exec::block::modal::Modal;
use crate::exec::contour::Contour;
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::geometry::coordinates::Coordinates;
use crate::exec::geometry::{Geometry, modulo};
use crate::exec::motion::state::{Independent, MotionState};
use crate::exec::names::AxisNames;
use crate::exec::output::{Output, output};
use crate::exec::step::{Event, IndependentMotion, Sync};
use crate::machine::{Axis, Channel};
use crate::syntax::ast::{Group, Item, Span};
use kontur_filters::time::CycleTime;
use kontur_motion::axis::AxisDynamics;
use kontur_motion::block::SlopeKind;
use kontur_motion::independent::{IndependentMove, IndependentSpeed};
use kontur_motion::path::Path;
use words::{Words, wrong};

impl Geometry {
    /// Offset of an independent position of an axis: that of the program with INCL_OFFSETS, written at `at`, otherwise 0.
    pub(super) fn included_offset(
        &self,
        axis: usize,
        function: &str,
        at: Option<Span>,
        names: &AxisNames,
    ) -> Outcome<f64> {
        match at {
            Some(at) if !self.coordinates.frame().is_identity() => {
                let name = names.name(axis);
                let what =
                    format!("{name}[{function}] with INCL_OFFSETS in a rotated or mirrored system");
                Err(Fault::unsupported(what, at))
            }
            Some(_) => Ok(self.coordinates.active_offset(axis)),
            None => Ok(0.0),
        }
    }

    /// 21071 for a main axis that the active coordinate systems turn, or that a transformation moves.
    ///
    /// An axis that keeps its direction may move independently, under a transformation the third main axis alone
    /// (253361291, 208635787, oscillation 15314437259).
    pub(super) fn moves_untransformed(
        &self,
        axis: usize,
        names: &AxisNames,
        span: Span,
    ) -> Outcome<()> {
        let Some(main) = self.coordinates.main_index(axis) else { return Ok(()) };
        let is_free = !self.transformation_on || main == 2;
        if is_free && self.coordinates.keeps_direction(main) {
            return Ok(());
        }
        let (number, name) = (names.number(axis), names.name(axis).to_owned());
        let text = format!("{name} takes part in a transformation: it cannot move independently");
        Err(Fault::new(Condition::IndependentInTransformation, text, span)
            .with(|d| d.axis(number, name)))
    }
}

impl Independent {
    /// Axes of a block with INDP_SYN: the next block begins when all of them have arrived.
    pub(in crate::exec) fn take_synchronous(&mut self) -> Vec<usize> {
        std::mem::take(&mut self.synchronous)
    }

    /// Axes that may still be moving independently and that a path moves, too: it waits for them.
    pub(in crate::exec) fn moved_by(&self, path: &Path) -> Vec<usize> {
        if self.open.is_empty() {
            return Vec::new();
        }
        let plane = match path {
            Path::Arc(arc) => arc.shape().plane.to_vec(),
            Path::Tilted(tilted) => tilted.tilt().axes.to_vec(),
            Path::Line(_) | Path::Curve(_) => Vec::new(),
        };
        let moves = |axis: &usize| {
            path.start()[*axis].to_bits() != path.end()[*axis].to_bits() || plane.contains(axis)
        };
        self.open.iter().copied().filter(moves).collect()
    }

    /// P-CHAN-00451 = 1: a block that names an axis in independent motion waits for it, even if the block does not move it.
    pub(super) fn named_in(&self, words: &BlockWords<'_>, channel: &Channel) -> Vec<usize> {
        let named = |axis: &usize| words.axes.iter().any(|(word, _, _)| word == axis);
        let joins = channel.independent.joins_named;
        self.open.iter().copied().filter(|axis| joins && named(axis)).collect()
    }

    /// K-0150 for a main axis in independent motion when a coordinate system or a transformation is selected: it has to
    /// end before (208635787).
    pub(in crate::exec) fn none_independent(
        &self,
        title: &str,
        coordinates: &Coordinates,
        names: &AxisNames,
        span: Span,
    ) -> Outcome<()> {
        let is_main = |axis: &&usize| coordinates.main_index(**axis).is_some();
        let Some(&axis) = self.open.iter().find(is_main) else { return Ok(()) };
        let (number, name) = (names.number(axis), names.name(axis).to_owned());
        let text = format!("{title} while {name} moves independently or oscillates");
        Err(Fault::new(Condition::IndependentBeforeSystem, text, span)
            .with(|d| d.axis(number, name)))
    }
}

impl MotionState {
    /// A function of the bracket of an independent axis.
    fn independent_function(&mut self, function: Event, output: &mut Output<'_>) {
        let timed = match function {
            Event::MFunction { number, .. } => Some(Function::M(number)),
            Event::HFunction { number, .. } => Some(Function::H(number)),
            _ => None,
        };
        if let Some(timed) = timed {
            self.takes_time(timed, &output.machine.channel, output.contour);
        }
        output.contour.event(function);
    }

    /// 120697 for a positioning axis within a spline, K-0154 for one while polynomial contouring is active (208606347).
    pub(super) fn moves_outside_curves(
        &self,
        axis: usize,
        modal: &Modal,
        contour: &Contour,
        names: &AxisNames,
        span: Span,
    ) -> Outcome<()> {
        let condition = if contour.akima.selected || contour.hsc.spline().is_some() {
            Condition::IndependentInSpline
        } else if self.is_contouring(modal, contour) {
            Condition::IndependentInContouring
        } else {
            return Ok(());
        };
        let (number, name) = (names.number(axis), names.name(axis).to_owned());
        let place = match condition {
            Condition::IndependentInSpline => "within a spline",
            _ => "while contouring is active",
        };
        let text = format!("{name} cannot move independently {place}");
        Err(Fault::new(condition, text, span).with(|d| d.axis(number, name)))
    }
}

impl Decoder {
    /// `X[INDP_SYN ..]`, `X[INDP_ASYN ..]`; `rest`: the text after the first word.
    pub(in crate::exec) fn independent_axis(
        &mut self,
        axis: usize,
        synchronous: bool,
        rest: &[Item],
        span: Span,
    ) -> Outcome<()> {
        self.motion.couplings.moves_not_coupled(axis, &self.machine, span)?;
        self.motion.areas.moves_unwatched(axis, &self.names, span)?;
        self.motion.moves_outside_curves(axis, &self.modal, &self.contour, &self.names, span)?;
        let mut words = Words::read(self, axis, rest)?;
        for function in std::mem::take(&mut words.functions) {
            self.motion.independent_function(function, output!(self));
        }
        let Some((position, at)) = words.position else {
            if rest.is_empty() || words.speed.is_some() || words.rapid.is_some() {
                return Err(wrong("the target POS of the independent axis is missing", span));
            }
            return Ok(());
        };
        self.geometry.moves_untransformed(axis, &self.names, span)?;
        let speed = words.speed_of_motion(span)?;
        if self.motion.independent.open.contains(&axis) {
            self.join(vec![axis]);
        }
        let start = self.geometry.coordinates.target().clone();
        let way = self.geometry.scaled_mm(axis, position, &self.machine, &self.modal);
        let offset_mm = self.geometry.included_offset(axis, "INDP", words.offsets, &self.names)?;
        let relative = words.relative.unwrap_or(!self.modal.absolute);
        let listed = &self.machine.axes[axis];
        let target = target_of(listed, start[axis], way, (!relative).then_some(offset_mm));
        self.geometry.coordinates.place(axis, target);
        let limits = self.geometry.limits(&self.motion, &self.names, &self.machine);
        limits.check_target(axis, target, &mut self.report, at);
        let slope = words.slope.unwrap_or(self.machine.channel.dynamics.slope);
        if let IndependentSpeed::Time(time_s) = speed {
            let dynamics = &self.motion.dynamics(&self.machine, &self.modal, false).axes[axis];
            let ends = [start[axis], target];
            if let Some(least_s) = longer_than(time_s, ends, slope, dynamics, self.machine.cycle) {
                let text = format!(
                    "the independent axis cannot move in TIME={time_s} s: its limits require {least_s:.6} s"
                );
                self.report.note(Fault::new(Condition::Odd, text, span).warning());
            }
        }
        self.motion.independent.way[axis] += target - start[axis];
        let source = self.report.source;
        let motion =
            IndependentMotion { from_mm: start[axis], to_mm: target, speed, slope, source };
        self.contour.event(Event::Independent { axis, motion });
        let list = if synchronous {
            &mut self.motion.independent.synchronous
        } else {
            &mut self.motion.independent.open
        };
        list.push(axis);
        Ok(())
    }

    /// Stops the path until these axes have arrived, if there are any.
    pub(in crate::exec) fn join(&mut self, axes: Vec<usize>) {
        if axes.is_empty() {
            return;
        }
        self.motion.independent.open.retain(|axis| !axes.contains(axis));
        self.sync(Sync::Independent { axes });
    }

    /// `#WAIT INDP [X, Y]`, `#WAIT INDP ALL`.
    ///
    /// Waits for the setpoints; with P-CHAN-00297 = 2 for those of all axes, and for their windows.
    pub(in crate::exec) fn wait_for_independent(
        &mut self,
        all: bool,
        groups: &[Group],
        span: Span,
    ) -> Outcome<()> {
        let mut axes = self.names.all_in_command(groups)?;
        if all {
            axes = (0..self.machine.axes.len()).collect();
        } else if axes.is_empty() {
            let text = "#WAIT INDP needs [axes] or ALL";
            return Err(Fault::new(Condition::TokenUnknown, text, span));
        }
        let in_windows = self.machine.channel.independent.joins_in_windows;
        if in_windows {
            axes = (0..self.machine.axes.len()).collect();
        }
        self.join(axes);
        if in_windows {
            self.sync(Sync::ExactStop { alone: false });
        }
        Ok(())
    }
}

/// Where an axis at `start` moves independently: by `way`, or to the coordinate `way` with its offset.
fn target_of(axis: &Axis, start: f64, way: f64, offset: Option<f64>) -> f64 {
    match offset {
        None => start + way,
        // always the shortest way (208606347)
        Some(offset) if axis.is_modulo() => {
            modulo::unwrapped(way + offset, None, start, axis.modulo_deg())
        }
        Some(offset) => way + offset,
    }
}

/// Time in s from rest to rest that the limits of an axis require, in whole cycles, if it is longer than the programmed one.
pub(super) fn longer_than(
    time_s: f64,
    [from_mm, to_mm]: [f64; 2],
    slope: SlopeKind,
    dynamics: &AxisDynamics,
    cycle: CycleTime,
) -> Option<f64> {
    let speed = IndependentSpeed::Time(time_s);
    // the time is above 0
    let way = IndependentMove::new(from_mm, to_mm, speed, slope, dynamics, cycle).ok()?;
    Some(cycle.time_of(way.cycles())).filter(|least_s| *least_s > time_s + cycle.seconds())
}
