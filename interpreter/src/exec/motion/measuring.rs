//! Measuring runs: G100 and G310 move until the probe signals; G101 and G102 include the measured values in the offsets.
//!
//! A run is a straight motion from standstill to standstill. Where the probe signals, the simulation latches the actual
//! positions, brakes the path and discards the rest of it. The program continues from the position where the path stopped.
//!
//! Source: TF5200 programming manual, measuring functions (206164491, 206171147, 206177803, 206185227, 206191115,
//! 206197003, 206208011), settings for measuring (207084683, 207092107); functional description of measuring (342045451),
//! dynamics of a run (895605131).
//! Assumptions, where they are silent: the path stops before a run; a run without a signal keeps the measured values and sets
//! V.A.MERF to FALSE; types 3 to 6 treat a missing signal as type 1 does (P-CHAN-00176).

use super::state::measuring::{Measured, Measuring, Pending};
use crate::diag::{Condition, Severity, ValueKind};
use crate::exec::block::choice::{Compensation, PathMode};
use crate::exec::block::collected::{GWord, Words};
use crate::exec::block::groups::{Act, Group};
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::geometry::Geometry;
use crate::exec::geometry::coordinates::Coordinates;
use crate::exec::live::Live;
use crate::exec::motion::state::MotionState;
use crate::exec::names::AxisNames;
use crate::exec::report::Report;
use crate::exec::step::Sync;
use crate::machine::Machine;
use crate::syntax::ast::{Jump, Span};
use kontur_motion::block::Feed;

impl Measuring {
    /// What a missing signal is; `None`: not reported. `is_error`: an error by the channel list.
    fn missing_signal(&self, interrupts: bool, is_error: bool) -> Option<Severity> {
        let of_program = self.missing_is_error;
        if self.kind == 2 || of_program.unwrap_or(is_error) {
            Some(Severity::Error)
        } else if interrupts || self.kind == 7 || of_program.is_some() {
            // the program provides for it, or its signal is not that of the probe
            None
        } else {
            Some(Severity::Note)
        }
    }

    /// Functions that belong to other measuring types; `through`: with G106.
    fn type_fits(&self, g: &GWord, through: bool) -> Outcome<()> {
        let kind = self.kind;
        let of_kind = |condition, text| {
            Fault::new(condition, text, g.span).with(|d| d.value(ValueKind::Current, kind, "-"))
        };
        match (g.row.number, kind) {
            (100, 5 | 6) => {
                let text = format!("G100 with measuring type {kind}");
                return Err(of_kind(Condition::MeasuringTypeOfG100, text));
            }
            (310, 1..=4 | 7) => {
                let text = format!("G310 with measuring type {kind}");
                return Err(of_kind(Condition::MeasuringTypeOfG310, text));
            }
            _ => {}
        }
        if through && kind != 3 {
            let text = format!("G106 with measuring type {kind}");
            return Err(of_kind(Condition::MeasuringFunction, text));
        }
        Ok(())
    }

    /// The axes of a run: their number, and whether the lists let them measure.
    fn axes_measure(
        &self,
        g: &GWord,
        words: &Words<'_>,
        coordinates: &Coordinates,
        machine: &Machine,
        names: &AxisNames,
    ) -> Outcome<()> {
        let kind = self.kind;
        let most = match kind {
            2 => 1,
            4 => 3,
            _ => usize::MAX,
        };
        let is_main = |axis: usize| coordinates.main_index(axis).is_some();
        let other = words.axes.iter().find(|(axis, _, _)| kind == 4 && !is_main(*axis));
        if words.axes.len() > most || other.is_some() {
            let at = words.axes.get(most).or(other).map_or(g.span, |(_, _, at)| *at);
            let count = words.axes.len();
            let text = match other {
                Some((axis, _, _)) if count <= most => {
                    format!(
                        "axis {} with measuring type 4: only main axes are allowed",
                        names.name(*axis)
                    )
                }
                _ => format!("{count} axes with measuring type {kind}, maximum: {most}"),
            };
            return Err(Fault::new(Condition::MeasuringAxes, text, at).with(|d| {
                d.value(ValueKind::Current, count as f64, "-").value(
                    ValueKind::UpperLimit,
                    most as f64,
                    "-",
                )
            }));
        }
        for (axis, _, at) in &words.axes {
            if !machine.axes[*axis].measures() {
                let name = names.name(*axis).to_owned();
                let number = machine.axes[*axis].number();
                let text = format!("axis {name} does not take part in measuring runs");
                return Err(Fault::new(Condition::NoMeasuringAxis, text, *at)
                    .with(|d| d.axis(number, name).value(ValueKind::AxisNumber, number, "-")));
            }
        }
        let stop =
            |(axis, _, _): &&(usize, f64, Span)| machine.axes[*axis].fixed_stop_lag_mm().is_some();
        if kind == 7 && words.axes.iter().find(stop).is_none() {
            let text = "measuring type 7: none of the axes of the run looks for a fixed stop";
            let hint = "set kenngr.meas_signal_fixed_stop to 1 and a lag in kenngr.fixed_stop_pos_lag_limit";
            return Err(Fault::new(Condition::NoMeasuringAxis, text, g.span).hint(hint));
        }
        Ok(())
    }
}

impl Geometry {
    /// G101: adds measuring offsets times their factors to the offsets; G102: removes them again, for all axes if it names
    /// none.
    pub(in crate::exec) fn measuring_offsets(
        &mut self,
        takes_in: bool,
        g: &GWord,
        words: &Words<'_>,
        measuring: &Measuring,
        names: &AxisNames,
    ) -> Outcome<()> {
        if !takes_in {
            let all = words.axes.is_empty();
            for axis in 0..self.coordinates.target().len() {
                if all || words.axes.iter().any(|(a, _, _)| *a == axis) {
                    self.coordinates.set_measuring_offset(axis, 0.0);
                }
            }
            return Ok(());
        }
        if words.axes.is_empty() {
            let text = format!("G{} without axis words", g.row.number);
            return Err(Fault::new(Condition::AxisMissing, text, g.span));
        }
        for (axis, factor, at) in &words.axes {
            let Some(offset) = measuring.results[*axis].offset else {
                let text = format!("axis {} has not been measured", names.name(*axis));
                return Err(Fault::new(Condition::NotMeasured, text, *at));
            };
            let coordinates = &mut self.coordinates;
            if coordinates.is_turned(*axis) {
                let text = format!("G101 of {} in a turned coordinate system", names.name(*axis));
                return Err(Fault::unsupported(text, *at));
            }
            // an offset is added to programmed positions (342045451), so that mirroring acts on it as on them
            let sign = if coordinates.mirrored(*axis) { -1.0 } else { 1.0 };
            coordinates.set_measuring_offset(*axis, sign * factor * offset);
        }
        Ok(())
    }
}

impl MotionState {
    /// End of a run: reads the measured values and the positions of the axes. Returns the label of G310 if the probe has
    /// signalled.
    pub(in crate::exec) fn end_of_measuring(
        &mut self,
        live: &mut Live,
        coordinates: &mut Coordinates,
        report: &mut Report,
    ) -> Option<Jump> {
        let pending = self.measuring.pending.take()?;
        let Pending { axes, target, missing, jump, source, span } = *pending;
        // a check has no probe: the surface is assumed at the target
        let (signal, rest) = match live.take_measured() {
            Some(probed) => (probed.signal_mm, Some(probed.rest_mm)),
            None => (Some(coordinates.target().clone()), None),
        };
        if let Some(signal) = &signal {
            coordinates.set_target(signal);
            for axis in &axes {
                let program = coordinates.programmed(*axis);
                self.measuring.results[*axis] = Measured {
                    value: program + coordinates.applied_offset(*axis),
                    axis: signal[*axis],
                    program,
                    offset: Some(program - target[*axis]),
                    signalled: true,
                };
            }
        } else {
            for axis in &axes {
                self.measuring.results[*axis].signalled = false;
            }
            if let Some(severity) = missing {
                let text = "the probe has not signalled on the way to the target";
                let fault = Fault::new(Condition::NoProbeSignal, text, span);
                report.note(fault.with(|d| d.severity(severity)).in_block(source));
            }
        }
        if let Some(rest) = rest {
            coordinates.set_target(&rest);
        }
        self.follow_masters(coordinates);
        jump.filter(|_| signal.is_some())
    }
}

impl Decoder {
    /// G100, G310.
    pub(super) fn measuring_run(
        &mut self,
        g: &GWord,
        words: &Words<'_>,
        span: Span,
    ) -> Outcome<()> {
        let interrupts = g.row.number == 310;
        let through = words.has(Act::MeasureThrough);
        let kind = self.motion.measuring.kind;
        self.measuring_fits(g, words, through)?;
        self.end_thread();
        self.sync(Sync::Stop);
        let modal = self.modal.path;
        if !interrupts {
            self.modal.path = PathMode::Linear;
        }
        if kind == 2
            && let Some((axis, _, _)) = words.axes.first()
        {
            let speed = self.machine.axes[*axis].measuring_speed_mm_s();
            self.motion.measuring.feed = Some(Feed::PathVelocity(speed));
        }
        self.motion.measuring.runs = true;
        let outcome = self.motion(words, false, span);
        self.modal.path = modal;
        self.motion.measuring.runs = false;
        self.motion.measuring.feed = None;
        outcome?;
        if self.report.failed() && !self.checking {
            return Ok(());
        }
        // after a run a check does not know where the axes are
        let assumed = self.checking && self.motion.measuring.results.iter().any(|r| r.signalled);
        if !self.moved && !assumed {
            let text = format!("G{}: the axes are already at the target", g.row.number);
            return Err(Fault::new(Condition::MeasuringWay, text, g.span));
        }
        // a fixed stop is detected by the following error of an axis of the run
        let axes = words.axes.iter().map(|(axis, _, _)| *axis);
        let stops = if kind == 7 { axes.collect() } else { Vec::new() };
        self.sync(Sync::Measured { through, stops });
        let coordinates = &self.geometry.coordinates;
        let axes = 0..self.machine.axes.len();
        let of_list = self.machine.channel.measuring.missing_signal_is_error;
        let missing = self.motion.measuring.missing_signal(interrupts, of_list);
        self.motion.measuring.pending = Some(Box::new(Pending {
            axes: words.axes.iter().map(|(axis, _, _)| *axis).collect(),
            target: axes.map(|axis| coordinates.programmed(axis)).collect(),
            missing,
            jump: None,
            source: self.report.source,
            span: g.span,
        }));
        Ok(())
    }

    /// Functions that cannot be combined with a run, or with its type.
    fn measuring_fits(&mut self, g: &GWord, words: &Words<'_>, through: bool) -> Outcome<()> {
        self.motion.measuring.type_fits(g, through)?;
        match words.group(Group::Path).map(|g| g.row.act) {
            Some(Act::Path(PathMode::Clockwise | PathMode::CounterClockwise)) => {
                let text = format!("G{} with an arc", g.row.number);
                return Err(Fault::new(Condition::MeasuringArc, text, g.span));
            }
            Some(Act::Path(PathMode::Linear | PathMode::Rapid)) | None => {}
            Some(_) => {
                let text = format!("G{} with another kind of motion", g.row.number);
                return Err(Fault::new(Condition::DuplicateGroup, text, g.span));
            }
        }
        let modal_arc = !matches!(self.modal.path, PathMode::Linear | PathMode::Rapid);
        if g.row.number == 310 && modal_arc {
            let text = "G310 after arcs without G00 or G01";
            return Err(Fault::new(Condition::MeasuringArc, text, g.span));
        }
        if words.axes.is_empty() {
            let text = format!("G{} without axis words", g.row.number);
            return Err(Fault::new(Condition::MeasuringWay, text, g.span));
        }
        self.motion.measuring.axes_measure(
            g,
            words,
            &self.geometry.coordinates,
            &self.machine,
            &self.names,
        )?;
        if self.modal.compensation != Compensation::Off {
            let text = "a measuring run while tool radius compensation is active";
            return Err(Fault::new(Condition::MeasuringCompensated, text, g.span));
        }
        if self.modal.contouring || words.has(Act::ContourOnce) {
            let text = "a measuring run while contouring is active";
            return Err(Fault::new(Condition::MeasuringWithContouring, text, g.span)
                .hint("write G260 before it and G261 after it"));
        }
        if self.contour.akima.selected {
            return Err(Fault::unsupported("measuring in a spline", g.span));
        }
        Ok(())
    }
}
