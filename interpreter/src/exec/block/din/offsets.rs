//! Tool offsets, zero offsets, presets, mirrors, rotations and software limits of a block.

use crate::diag::{Condition, ValueKind};
use crate::exec::block::choice::PathMode;
use crate::exec::block::collected::{GWord, Words};
use crate::exec::block::groups::{self, Act, Group};
use crate::exec::block::modal::Modal;
use crate::exec::contour::Contour;
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::geometry::Geometry;
use crate::exec::geometry::coordinates::LAST_ZERO_GROUP;
use crate::exec::motion::state::coupling::Couplings;
use crate::exec::names::AxisNames;
use crate::exec::report::Report;
use crate::exec::step::Event;
use crate::exec::values::number::whole;
use crate::machine::Machine;
use crate::syntax::ast::Span;
use kontur_motion::axis::AxisVec;

/// The group selected by G159 and G160.
///
/// Source: TF5200 diagnosis 250915467 (20149), 251890315, 251894667 (20582, 20583), 251899019 (20584).
fn zero_group(g: &GWord) -> Outcome<u32> {
    let by_axes = g.row.act == Act::ZeroGroupAxes;
    let value = g.value.unwrap_or_default();
    let wrong = |condition, text: String| {
        Fault::new(condition, text, g.span).with(|d| d.value(ValueKind::Wrong, value, "-"))
    };
    let group = whole(value, 0, 999).ok_or_else(|| {
        let condition =
            if by_axes { Condition::MaskedGroupFormat } else { Condition::ZeroGroupFormat };
        wrong(condition, format!("zero-offset group {value} is outside the data format"))
    })?;
    if group > LAST_ZERO_GROUP {
        let condition = if by_axes { Condition::MaskedGroup } else { Condition::ZeroGroup };
        let text =
            format!("zero-offset group {group} does not exist, the last one is {LAST_ZERO_GROUP}");
        return Err(wrong(condition, text));
    }
    Ok(group)
}

fn needs_axes(g: &GWord, words: &Words<'_>) -> Outcome<()> {
    if words.axes.is_empty() {
        let text = format!("G{} without axis words", g.row.number);
        return Err(Fault::new(Condition::AxisMissing, text, g.span));
    }
    Ok(())
}

impl Geometry {
    fn zero_group_of_axes(&mut self, g: &GWord, words: &Words<'_>) -> Outcome<()> {
        needs_axes(g, words)?;
        let group = zero_group(g)?;
        // 0 includes the offset of the axis, 1 excludes it
        for (axis, value, _) in &words.axes {
            let masked = crate::exec::values::number::is_true(*value);
            self.coordinates.mask_zero_entry(group, *axis, masked);
        }
        Ok(())
    }

    fn mirror_axes(&mut self, g: &GWord, words: &Words<'_>) -> Outcome<()> {
        needs_axes(g, words)?;
        for (axis, value, span) in &words.axes {
            let mirrored = match value {
                v if v.total_cmp(&1.0).is_eq() => false,
                v if v.total_cmp(&-1.0).is_eq() => true,
                _ => {
                    let text = format!("mirroring is switched with 1 and -1, not with {value}");
                    return Err(Fault::new(Condition::MirrorSwitch, text, *span)
                        .with(|d| d.value(ValueKind::Wrong, *value, "-")));
                }
            };
            self.coordinates.set_mirrored(*axis, mirrored);
        }
        Ok(())
    }

    /// G20 to G23: mirrors the first and the second main axis.
    fn mirror(&mut self, first: bool, second: bool) {
        for (main, mirrored) in [(0, first), (1, second)] {
            if let Some(axis) = self.coordinates.main_axis(main) {
                self.coordinates.set_mirrored(axis, mirrored);
            }
        }
        if !first && !second {
            for axis in 0..self.coordinates.target().len() {
                self.coordinates.set_mirrored(axis, false);
            }
        }
    }

    /// G74 cancels the position presets of its axes, without axes those of all (207101835); 20137 (250902411).
    pub(super) fn home(
        &mut self,
        g: &GWord,
        words: &Words<'_>,
        couplings: &Couplings,
    ) -> Outcome<()> {
        if !couplings.are_off() {
            let text = "G74 while a coupling group is switched on";
            return Err(Fault::new(Condition::HomingWithCouplings, text, g.span));
        }
        // Assumption: 252647563 prints no limits; these are those of other orders (UNS16)
        if let Some((_, order, at)) =
            words.axes.iter().find(|(_, order, _)| whole(*order, 0, u32::from(u16::MAX)).is_none())
        {
            let text = format!("G74: the order {order} is not a whole number from 0 to 65535");
            return Err(Fault::new(Condition::HomingOrder, text, *at)
                .with(|d| d.value(ValueKind::Wrong, *order, "-")));
        }
        // page 208164107
        if let Some(m) = words.m.iter().find(|m| matches!(m.number, 3..=5 | 19 | 40..=45)) {
            let text = format!("M{:02} in the block of G74", m.number);
            return Err(Fault::new(Condition::SpindleCommandsExclude, text, m.span)
                .hint("write the function of the spindle in a separate block"));
        }
        let named = |axis: usize| words.axes.iter().any(|(other, _, _)| *other == axis);
        for axis in 0..self.coordinates.target().len() {
            if words.axes.is_empty() || named(axis) {
                self.coordinates.preset_position(axis, None);
            }
        }
        Ok(())
    }

    /// G92: absolute with G90, incremental with G91.
    fn preset(
        &mut self,
        g: &GWord,
        words: &Words<'_>,
        machine: &Machine,
        modal: &Modal,
    ) -> Outcome<()> {
        needs_axes(g, words)?;
        for (axis, value, _) in &words.axes {
            let value_mm = value * modal.axis_unit(&machine.axes[*axis]);
            let before = if modal.absolute { 0.0 } else { self.coordinates.preset(*axis) };
            self.coordinates.set_preset(*axis, before + value_mm);
        }
        Ok(())
    }

    fn rotate(
        &mut self,
        g: &GWord,
        words: &Words<'_>,
        machine: &Machine,
        modal: &Modal,
        names: &AxisNames,
    ) -> Outcome<()> {
        let main = modal.plane.main_axes();
        let mut centre: [Option<f64>; 2] = [None; 2];
        for (axis, value, span) in &words.axes {
            match self.coordinates.main_index(*axis) {
                Some(m) if m == main[0] => {
                    centre[0] = Some(value * modal.axis_unit(&machine.axes[*axis]));
                }
                Some(m) if m == main[1] => {
                    centre[1] = Some(value * modal.axis_unit(&machine.axes[*axis]));
                }
                _ => {
                    let name = names.name(*axis).to_owned();
                    let text = format!("axis {name} is not in the plane of the rotation");
                    let number = machine.axes[*axis].number();
                    return Err(Fault::new(Condition::RotationAxis, text, *span)
                        .with(|d| d.axis(number, name).value(ValueKind::AxisNumber, number, "-")));
                }
            }
        }
        let deg = words.radius.map_or(0.0, |(deg, _)| deg);
        let plane = [main[0], main[1]];
        self.rotate_plane(machine, plane, deg, centre, g.span)
    }

    /// Other software limits of an axis from here on, for set positions and, with the next step, for actual ones.
    pub(in crate::exec) fn limit_axis(
        &mut self,
        axis: usize,
        limits_mm: Option<(f64, f64)>,
        contour: &mut Contour,
    ) {
        self.limits_mm[axis] = limits_mm;
        contour.event(Event::SoftwareLimits { axis, limits_mm });
    }

    /// P-CHAN-00100 = 1: axes whose tool offset a D word changes move in its block, as if their coordinate were programmed absolutely.
    ///
    /// Source: TF5200 channel parameters 149123467. Assumption: an axis with its own word in the block follows that; arcs, threads
    /// and functions that take the axis words are refused.
    pub(super) fn tool_moves(
        &self,
        before: &AxisVec,
        words: &mut Words<'_>,
        takes_axes: Option<GWord>,
        machine: &Machine,
        modal: &Modal,
    ) -> Outcome<()> {
        let with_tool = words.tool.filter(|_| machine.channel.offsets.tool_data_with_tool);
        let Some((_, span)) = words.tool_data.or(with_tool) else { return Ok(()) };
        let now = self.coordinates.tool();
        let changed = (0..now.len()).filter(|axis| now[*axis].to_bits() != before[*axis].to_bits());
        let moved: Vec<usize> = changed
            .filter(|axis| words.axes.iter().all(|(programmed, _, _)| programmed != axis))
            .collect();
        if moved.is_empty() {
            return Ok(());
        }
        let straight = matches!(modal.path_mode(words), PathMode::Rapid | PathMode::Linear);
        if takes_axes.is_some() || !straight {
            let what = "D with offsets moved at once (P-CHAN-00100) in a block other than a straight motion";
            return Err(Fault::unsupported(what, span));
        }
        if words.dimensions.is_empty() {
            words.dimensions.push((0, modal.absolute));
        }
        words.dimensions.push((words.axes.len(), true));
        for axis in moved {
            let value = self.coordinates.programmed(axis)
                / self.coordinate_unit(axis, true, machine, modal);
            words.axes.push((axis, value, span));
        }
        Ok(())
    }
}

impl Decoder {
    pub(super) fn tools_and_offsets(&mut self, words: &Words<'_>, takes_axes: Option<GWord>) {
        if let Some((number, span)) = words.tool {
            self.select_tool(number, span);
            if self.machine.channel.offsets.tool_data_with_tool && words.tool_data.is_none() {
                self.select_tool_data(number, span);
            }
        }
        if let Some((number, span)) = words.tool_data {
            self.select_tool_data(number, span);
        }
        for g in &words.g {
            let outcome = match g.row.act {
                Act::ZeroGroup(group) => {
                    self.geometry.coordinates.select_zero_group(group, false);
                    Ok(())
                }
                Act::ZeroGroupValue => zero_group(g).map(|group| {
                    self.geometry.coordinates.select_zero_group(group, true);
                }),
                Act::Mirror(first, second) => {
                    self.modal.mirrored = [first, second];
                    self.geometry.mirror(first, second);
                    Ok(())
                }
                Act::RotateOff => {
                    self.geometry.coordinates.set_rotation(None);
                    Ok(())
                }
                _ => Ok(()),
            };
            self.report.keep(outcome);
        }
        let Some(g) = takes_axes else { return };
        let outcome = match g.row.act {
            Act::ZeroGroupAxes => self.geometry.zero_group_of_axes(&g, words),
            Act::Preset => self.geometry.preset(&g, words, &self.machine, &self.modal),
            Act::MirrorAxes => {
                words.must_be_alone(&g, &mut self.report);
                self.geometry.mirror_axes(&g, words)
            }
            Act::Rotate => self.geometry.rotate(&g, words, &self.machine, &self.modal, &self.names),
            Act::SoftwareLimits(positive) => self.software_limits(&g, words, positive),
            Act::MeasuringOffsets(takes_in) => self.geometry.measuring_offsets(
                takes_in,
                &g,
                words,
                &self.motion.measuring,
                &self.names,
            ),
            _ => Ok(()),
        };
        self.report.keep(outcome);
    }

    /// G98, G99: active until the end of the program.
    fn software_limits(&mut self, g: &GWord, words: &Words<'_>, positive: bool) -> Outcome<()> {
        needs_axes(g, words)?;
        if self.geometry.coordinates.systems() > 0 {
            let text =
                format!("G{} in a coordinate system: the limits apply to axes", g.row.number);
            return Err(Fault::new(Condition::FunctionInSystem, text, g.span));
        }
        if self.geometry.transformation_on {
            let text = format!("G{} under a kinematic transformation", g.row.number);
            return Err(Fault::new(Condition::FunctionInTransformation, text, g.span));
        }
        for (i, (axis, value, span)) in words.axes.iter().enumerate() {
            let absolute = words.is_absolute(i, self.modal.absolute);
            let value_mm = value * self.modal.axis_unit(&self.machine.axes[*axis]);
            let outcome = self.software_limit(*axis, positive, value_mm, absolute, *span);
            self.report.keep(outcome);
        }
        Ok(())
    }

    /// A limit of an axis, with G91 relative to the current one. It must stay on its side of the other limit, and with
    /// P-CHAN-00498 = 1 also within the limits of the list.
    ///
    /// Source: TF5200 programming manual 206151179, 206157835; software limits 91641995, 91643531; channel parameters 1049532043.
    fn software_limit(
        &mut self,
        axis: usize,
        positive: bool,
        value_mm: f64,
        absolute: bool,
        span: Span,
    ) -> Outcome<()> {
        let name = self.names.name(axis).to_owned();
        let Some((low, high)) = self.geometry.limits_mm[axis] else {
            let text = format!("axis {name} has no software limits");
            return Err(Fault::new(Condition::Ignored, text, span));
        };
        let before = if positive { high } else { low };
        let mut limit = if absolute { value_mm } else { before + value_mm };
        let listed = self.machine.axes[axis].software_limits_mm();
        if let (Some((lowest, highest)), true) =
            (listed, self.machine.channel.offsets.limits_bounded)
        {
            let bound = if positive { limit.min(highest) } else { limit.max(lowest) };
            if bound.to_bits() != limit.to_bits() {
                let text = format!(
                    "the limit {limit} of axis {name} is beyond the limit of its list: {bound}"
                );
                let condition = if positive {
                    Condition::PositiveLimitAboveList
                } else {
                    Condition::NegativeLimitBelowList
                };
                self.report.note(Fault::new(condition, text, span));
                limit = bound;
            }
        }
        let (low, high) = if positive { (low, limit) } else { (limit, high) };
        if low >= high {
            let text = format!("axis {name}: the limits {low} and {high} leave no travel");
            let condition = if positive {
                Condition::PositiveLimitTooLow
            } else {
                Condition::NegativeLimitTooHigh
            };
            return Err(Fault::new(condition, text, span));
        }
        self.geometry.limit_axis(axis, Some((low, high)), &mut self.contour);
        Ok(())
    }
}

/// The G function with the axis words of the block as its arguments.
pub(super) fn axis_functions(words: &Words<'_>, report: &mut Report) -> Option<GWord> {
    let mut found: Option<GWord> = None;
    for g in words.g.iter().filter(|g| groups::takes_axes(g.row)) {
        if let Some(first) = found {
            let text = format!(
                "G{} and G{} in one block: both require the axis words",
                first.row.number, g.row.number
            );
            report.note(
                Fault::new(Condition::Syntax, text, g.span)
                    .hint("write the second one with its axis words in a separate block"),
            );
        } else {
            found = Some(*g);
        }
    }
    let motion = words.group(Group::Path).filter(|g| matches!(g.row.act, Act::Path(_)));
    if let (Some(g), Some(motion), false) = (found, motion, words.axes.is_empty()) {
        let text = format!(
            "G{:02} with G{}: the axis words are arguments of G{}, not targets",
            motion.row.number, g.row.number, g.row.number
        );
        let hint = format!("write G{} with its axis words in a separate block", g.row.number);
        report.note(Fault::new(Condition::Syntax, text, motion.span).hint(hint));
    }
    found
}
