//! Weights, feedforward, tools, rotation and tool radius compensation: words that change the motion of later blocks.

use super::choice::{Compensation, Selection};
use super::collected::{GWord, Placed, Words};
use super::groups::{Act, Group};
use super::modal::Modal;
use crate::diag::{Condition, ValueKind};
use crate::exec::contour::Contour;
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::geometry::coordinates::Coordinates;
use crate::exec::motion::state::{Function, MotionState};
use crate::exec::motion::weight::Weight;
use crate::exec::output::Output;
use crate::exec::report::{Report, Subject};
use crate::exec::step::Event;
use crate::machine::{Axis, Tool};
use crate::syntax::ast::Span;

/// A weight in percent as a ratio.
pub(in crate::exec) fn weight_ratio((percent, span): Placed) -> Outcome<f64> {
    if (0.0..=1e6).contains(&percent) {
        return Ok(percent / 100.0);
    }
    let text = format!("a weight of {percent} % is not allowed");
    Err(Fault::new(Condition::Range, text, span))
}

impl Modal {
    /// G138, G139, G237 to G239; 21317, 21318 for G238 during active compensation.
    pub(in crate::exec) fn select_compensation_by(
        &mut self,
        selection: Selection,
        g: &GWord,
        words: &Words<'_>,
    ) -> Outcome<()> {
        let selects = words.group(Group::Compensation).is_some();
        let active = self.compensation != Compensation::Off && !selects;
        let (old, inside) = (self.selection, Selection::InsideCorner);
        if active && old != selection && (old == inside || selection == inside) {
            let (condition, text) = if selection == inside {
                (Condition::InsideCornerActive, "G238 while tool radius compensation is active")
            } else {
                (Condition::SelectionActive, "the selection mode changes while G238 is in effect")
            };
            return Err(Fault::new(condition, text, g.span)
                .with(|d| d.value(ValueKind::Wrong, g.row.number, "-")));
        }
        self.selection = selection;
        Ok(())
    }
}

impl MotionState {
    /// G135, G137.
    pub(super) fn switch_feedforward(&mut self, on: bool, output: &mut Output<'_>, span: Span) {
        if self.feedforward.on == on {
            return;
        }
        if on && !output.machine.axes.iter().any(Axis::has_feedforward) {
            let text = "G135 has no effect: feedforward is not enabled for any axis of the channel (P-AXIS-00223)";
            let fault = Fault::new(Condition::ListNoEffect, text, span).hint(ENABLE_FEEDFORWARD);
            output.report.note_once(Subject::G(135), fault);
        }
        self.feedforward.on = on;
        output.contour.event(self.feedforward.event());
    }

    /// G40 with G239: the tool keeps its position, and the program continues from there.
    fn deselect_in_place(
        &mut self,
        coordinates: &mut Coordinates,
        contour: &mut Contour,
        report: &mut Report,
    ) {
        let (left, faults) = contour.deselect_in_place();
        for fault in faults {
            report.note(Box::new(fault));
        }
        let Some((plane, at)) = left else { return };
        let mut target = coordinates.target().clone();
        for (axis, x) in plane.into_iter().zip(at) {
            target[axis] = x + self.independent.way[axis];
        }
        coordinates.set_target(&target);
        self.follow_masters(coordinates);
        self.left_contour = true;
    }

    /// G136: weights of feedforward in percent, at most 100.
    pub(in crate::exec) fn feedforward_weights(
        &mut self,
        g: &GWord,
        words: &Words<'_>,
        output: &mut Output<'_>,
    ) -> Outcome<()> {
        if words.axes.is_empty() {
            return Err(Fault::new(Condition::Syntax, "G136 without axis words", g.span)
                .hint("write the weights of the axes in percent: G136 X100 Y100"));
        }
        if let Some((_, value, span)) = words.axes.iter().find(|(_, value, _)| *value < 0.0) {
            let text = format!("feedforward weight {value} % is negative");
            return Err(Fault::new(Condition::FeedforwardNegative, text, *span));
        }
        for (axis, value, span) in &words.axes {
            let percent = limited_weight(*value, *span, output.report);
            self.feedforward.weight_ratios[*axis] = percent / 100.0;
            // weight 0 is what such an axis has anyway
            if percent > 0.0 {
                note_without_feedforward("G136", &output.machine.axes[*axis], *span, output.report);
            }
        }
        output.contour.event(self.feedforward.event());
        Ok(())
    }
}

impl Decoder {
    /// Sets a weight; 50130, 120033, 120037 or 120038 if it exceeds the limits of the lists, 120028, 120030, 120032 or 120034
    /// if an acceleration would become 0.
    pub(in crate::exec) fn set_weight(
        &mut self,
        weight: Weight,
        axis: Option<usize>,
        ratio: f64,
        span: Span,
    ) {
        let before = self.motion.limits.cuts(&self.machine, &self.modal);
        self.motion.limits.set_weight(weight, axis, ratio);
        for (axis, cut) in self.motion.limits.cuts(&self.machine, &self.modal) {
            // the same result of an earlier word was reported there
            let earlier =
                (ratio - 1.0).abs() < 1e-12 || cut.weight().is_some_and(|cause| cause != weight);
            if earlier && before.contains(&(axis, cut)) {
                continue;
            }
            let zero = cut.is_zero();
            let name = self.names.name(axis).to_owned();
            let number = self.machine.axes[axis].number();
            let ramp = matches!(weight, Weight::Ramp | Weight::RapidRamp);
            let low = ramp || ratio < 1.0;
            let is = if low { "is below" } else { "exceeds" };
            let percent = ratio * 100.0;
            let text = if zero {
                format!(
                    "axis {name}: the acceleration is 0 at {percent} % and limited to the minimum"
                )
            } else {
                format!(
                    "axis {name}: the weight of {percent} % {is} the limit of the axis list, it is limited"
                )
            };
            let fault = Fault::new(cut.condition(), text, span)
                .with(|d| d.axis(number, name).value(ValueKind::AxisNumber, number, "-"));
            let hint = "raise the weight, or lower the minimum ramp time in the axis list (P-AXIS-00293, P-AXIS-00201 for rapid)";
            self.report.note(match (ramp, low) {
                (true, _) => fault.hint(hint),
                (false, true) if !zero => fault.hint("raise the weight"),
                _ => fault,
            });
        }
    }

    /// G127, G130, G132, G230.
    pub(in crate::exec) fn weights_of_axes(
        &mut self,
        g: &GWord,
        weight: Weight,
        words: &Words<'_>,
    ) -> Outcome<()> {
        if words.axes.is_empty() {
            let text = format!("G{} without axis words", g.row.number);
            return Err(Fault::new(Condition::AxisMissing, text, g.span));
        }
        for (axis, value, span) in &words.axes {
            let ratio = weight_ratio((*value, *span))?;
            self.set_weight(weight, Some(*axis), ratio, *span);
        }
        Ok(())
    }

    /// T. With P-CHAN-00106 the channel is flushed before it. Assumption: by `#FLUSH WAIT`, as before D; the page of the parameter is
    /// not public, that of P-CHAN-00271 (149002251) only names it.
    pub(in crate::exec) fn select_tool(&mut self, number: f64, span: Span) {
        /// Source: TF5200 diagnosis 250967691, 20166.
        const HIGHEST: u32 = i32::MAX.unsigned_abs();
        if self.machine.channel.offsets.flush_before_tool {
            let outcome = self.flush_before("T with P-CHAN-00106", span);
            self.report.keep(outcome);
        }
        if number > f64::from(HIGHEST) {
            let text = format!("T{number} is above {HIGHEST}");
            self.report.note(Fault::new(Condition::ToolNumberTooLarge, text, span));
        } else if let Some(number) = crate::exec::values::number::whole(number, 0, HIGHEST) {
            self.geometry.tools.tool = number;
            self.contour.event(Event::Tool { number });
            self.motion.takes_time(Function::Tool, &self.machine.channel, &mut self.contour);
        } else {
            let text = format!("T{number} is not a tool number");
            self.report.note(Fault::new(Condition::Range, text, span));
        }
    }

    /// D: tool data; the length applies along the third main axis of the plane. With P-CHAN-00271 the channel is flushed before it.
    pub(in crate::exec) fn select_tool_data(&mut self, number: f64, span: Span) {
        if self.machine.channel.offsets.flush_before_tool_data {
            let outcome = self.flush_before("D with P-CHAN-00271", span);
            self.report.keep(outcome);
        }
        if self.report.keep(self.motion.couplings.keep_tool(span)).is_none() {
            return;
        }
        let Some(number) = crate::exec::values::number::whole(number, 0, u32::MAX) else {
            let text = format!("D{number} is not a number of tool data");
            self.report.note(Fault::new(Condition::Range, text, span));
            return;
        };
        self.geometry.tools.data = number;
        let listed = self.geometry.tools.table.get(&number);
        self.geometry.tools.active = if let Some(tool) = listed.filter(|tool| tool.is_valid) {
            tool.clone()
        } else {
            if number != 0 {
                let what =
                    if listed.is_some() { "are not valid (P-TOOL-00005)" } else { "do not exist" };
                let text = format!("tool data D{number} {what}: length and radius are 0");
                let hint = "set length and radius in a tool list (werkz_data[0] of the start-up list) or with V.G.WZ[n].L and V.G.WZ[n].R";
                self.report.note_once("D", Fault::new(Condition::NoTool, text, span).hint(hint));
            }
            crate::exec::geometry::tools::Tool::default()
        };
        if number != 0 {
            let least = self.machine.channel.least_tool_mm;
            let outcome = is_large_enough(&self.geometry.tools.active, least, number, span);
            self.report.keep(outcome);
        }
        self.geometry.coordinates.tool_programmed();
        self.geometry.apply_tool(self.modal.plane.main_axes());
        let passed = self.motion.pass_tool_limits(
            &self.geometry.tools,
            &self.machine,
            &mut self.report,
            span,
        );
        self.report.keep(passed);
        if self.modal.compensation != Compensation::Off {
            let outcome = self.geometry.compensates_tool(span);
            self.report.keep(outcome);
        }
        let applied = self.motion.apply_wear(&self.geometry, &self.modal, &mut self.contour, span);
        self.motion.wear.on &= self.report.keep(applied).is_some();
    }

    /// G40, G41, G42.
    ///
    /// # Errors
    /// 20136 and 21555 for a plane that lacks one of its axes, or contains a modulo axis.
    pub(in crate::exec) fn compensation(&mut self, side: Compensation, span: Span) -> Outcome<()> {
        if side != Compensation::Off {
            self.geometry.plane_has_axes(self.modal.plane.main_axes(), &self.machine, span)?;
            self.geometry.compensates_tool(span)?;
        }
        if side != Compensation::Off && self.geometry.tools.active.radius_mm == 0.0 {
            let text = "the tool has the radius 0: the path is the programmed contour";
            let hint =
                "select tool data with D, or set the radius with V.G.WZ[n].R or V.G.WZ_AKT.R";
            self.report
                .note_once(Subject::G(41), Fault::new(Condition::NoTool, text, span).hint(hint));
        }
        let leaves = side == Compensation::Off && self.modal.compensation != Compensation::Off;
        if leaves && self.modal.selection == Selection::WithoutBlock {
            self.motion.deselect_in_place(
                &mut self.geometry.coordinates,
                &mut self.contour,
                &mut self.report,
            );
        }
        self.modal.compensation = side;
        self.contour.deselect(side == Compensation::Off);
        Ok(())
    }
}

/// A feedforward weight, above 100 % with K-0020.
pub(in crate::exec) fn limited_weight(percent: f64, span: Span, report: &mut Report) -> f64 {
    if percent > 100.0 {
        let text = format!("feedforward weight {percent} % is above 100 %, limited");
        report
            .note(Fault::new(Condition::FeedforwardLimit, text, span).with(|d| d.corrected(100.0)));
    }
    percent.min(100.0)
}

const ENABLE_FEEDFORWARD: &str = "set vorsteuer.vorsteuerung to VEL in the axis list to enable it";

/// K-0075, once per axis and word, for feedforward of an axis or spindle without any (P-AXIS-00223).
pub(in crate::exec) fn note_without_feedforward(
    word: &str,
    axis: &Axis,
    span: Span,
    report: &mut Report,
) {
    if axis.has_feedforward() {
        return;
    }
    let (name, subject) = (axis.name(), format!("{word} {}", axis.name()));
    let text =
        format!("{word} has no effect on {name}: its feedforward is not enabled (P-AXIS-00223)");
    let fault = Fault::new(Condition::ListNoEffect, text, span).hint(ENABLE_FEEDFORWARD);
    report.note_once(subject.as_str(), fault);
}

/// 21426, 21427: the active tool, in mm, is shorter or thinner than the channel list demands (P-CHAN-00156, P-CHAN-00157).
///
/// Assumption: the error ends the program, like the other errors of tool data; no document prints its reaction.
fn is_large_enough(
    tool: &Tool,
    [length, radius]: [f64; 2],
    number: u32,
    span: Span,
) -> Outcome<()> {
    for (condition, what, value, least) in [
        (Condition::ToolTooShort, "length", tool.length_mm, length),
        (Condition::ToolTooThin, "radius", tool.radius_mm, radius),
    ] {
        if least > 0.0 && value < least {
            let text = format!("{what} {value} mm of tool data D{number}, at least {least} mm");
            return Err(Fault::new(condition, text, span).with(|d| {
                d.value(ValueKind::Wrong, value, "mm").value(ValueKind::LowerLimit, least, "mm")
            }));
        }
    }
    Ok(())
}

/// Whether the motion that starts or ends compensation may become an arc (G05); `selection`: the modal kind of selection.
pub(super) fn permits_tangential(
    g: &GWord,
    words: &Words<'_>,
    selection: Selection,
) -> Outcome<()> {
    let Some(side) = words.group(Group::Compensation) else {
        let text = "G05 without G40, G41 or G42 in its block";
        return Err(Fault::new(Condition::Compensation, text, g.span)
            .hint("write G05 in the block of the word that it belongs to"));
    };
    let selection = match words.group(Group::CompensationSelection).map(|g| g.row.act) {
        Some(Act::Selection(selection)) => selection,
        _ => selection,
    };
    if side.row.number == 40 && selection == Selection::WithoutBlock {
        let what = "G05 with G40 of G239, which leaves the tool where it is";
        return Err(Fault::unsupported(what, g.span));
    }
    Ok(())
}
