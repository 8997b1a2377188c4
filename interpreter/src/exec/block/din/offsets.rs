//! Tool offsets, zero offsets, presets, mirrors, rotations and software limits of a block.

use crate::diag::{Condition, ValueKind};
use crate::exec::block::collected::{GWord, Words};
use crate::exec::block::groups::{self, Act, Group};
use crate::exec::block::modal::Compensation;
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::syntax::ast::Span;

fn zero_group(g: &GWord) -> Outcome<u32> {
    let value = g.value.unwrap_or_default();
    crate::exec::values::number::whole(value, 0, 999).ok_or_else(|| {
        let text = format!("zero-offset group {value} does not exist");
        Fault::new(Condition::Range, text, g.span)
    })
}

fn needs_axes(g: &GWord, words: &Words<'_>) -> Outcome<()> {
    if words.axes.is_empty() {
        let text = format!("G{} without axis words", g.row.number);
        return Err(Fault::new(Condition::AxisMissing, text, g.span));
    }
    Ok(())
}

impl Decoder {
    /// The G function that takes the axis words of the block as its arguments.
    pub(super) fn axis_functions(&mut self, words: &Words<'_>) -> Option<GWord> {
        let mut found: Option<GWord> = None;
        for g in words.g.iter().filter(|g| groups::takes_axes(g.row)) {
            if let Some(first) = found {
                let text = format!(
                    "G{} and G{} in one block: both need the axis words",
                    first.row.number, g.row.number
                );
                self.report.note(Fault::new(Condition::Syntax, text, g.span));
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
            self.report.note(Fault::new(Condition::Syntax, text, motion.span));
        }
        found
    }

    pub(super) fn tools_and_offsets(&mut self, words: &Words<'_>, takes_axes: Option<GWord>) {
        if let Some((number, span)) = words.tool {
            self.select_tool(number, span);
            if self.machine.channel.tool_data_with_tool && words.tool_data.is_none() {
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
                    self.mirror(first, second);
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
            Act::ZeroGroupAxes => self.zero_group_of_axes(&g, words),
            Act::Preset => self.preset(&g, words),
            Act::MirrorAxes => self.mirror_axes(&g, words),
            Act::Rotate => self.rotate(&g, words),
            Act::SoftwareLimits(positive) => self.software_limits(&g, words, positive),
            Act::MeasuringOffsets(takes_in) => self.measuring_offsets(takes_in, &g, words),
            _ => Ok(()),
        };
        self.report.keep(outcome);
    }

    /// `#PSET X10`, `#PRESET X0`, `#PRESET`: true if the axis words of the block belong to one of them.
    pub(super) fn position_presets(&mut self, words: &Words<'_>) -> bool {
        let named = |h: &str| words.hashes.iter().find(|(hash, _, _)| &*hash.name == h);
        let (sets, at) = match (named("PSET"), named("PRESET")) {
            (Some((_, _, at)), _) => (true, *at),
            (None, Some((_, _, at))) => (false, *at),
            (None, None) => return false,
        };
        if (0..self.machine.axes.len()).any(|axis| self.geometry.coordinates.mirrored(axis)) {
            let text = "#PSET and #PRESET do not go with mirroring";
            self.report.note(Fault::new(Condition::PresetWhileMirrored, text, at));
            return true;
        }
        let coordinates = &self.geometry.coordinates;
        let conflicts =
            coordinates.rotation().is_some() || self.modal.compensation != Compensation::Off;
        if conflicts {
            let text = "#PSET and #PRESET do not go with rotation or tool radius compensation";
            self.report.note(Fault::new(Condition::Syntax, text, at));
            return true;
        }
        if words.axes.iter().any(|(axis, _, _)| self.modal.diameter == Some(*axis)) {
            self.report
                .note(Fault::unsupported("#PSET and #PRESET of an axis with diameters (G51)", at));
            return true;
        }
        let beside = words.axes.iter().find(|(axis, _, _)| coordinates.main_index(*axis).is_none());
        if let Some((_, _, span)) = beside.filter(|_| coordinates.systems() > 0) {
            let what = "#PSET and #PRESET of an axis that is no main axis, in a coordinate system";
            self.report.note(Fault::unsupported(what, *span));
            return true;
        }
        for (axis, value, _) in &words.axes {
            let value = sets.then(|| value * self.axis_unit(*axis));
            self.geometry.coordinates.preset_position(*axis, value);
        }
        if words.axes.is_empty() && !sets {
            for axis in 0..self.machine.axes.len() {
                self.geometry.coordinates.preset_position(axis, None);
            }
        } else if words.axes.is_empty() {
            self.report.note(Fault::new(Condition::Syntax, "#PSET without axis words", at));
        }
        true
    }

    /// G74 takes the position presets of its axes back, without axes of all (207101835).
    pub(super) fn home(&mut self, words: &Words<'_>) {
        let named = |axis: usize| words.axes.iter().any(|(other, _, _)| *other == axis);
        for axis in 0..self.machine.axes.len() {
            if words.axes.is_empty() || named(axis) {
                self.geometry.coordinates.preset_position(axis, None);
            }
        }
    }

    /// G98, G99: until the end of the program.
    fn software_limits(&mut self, g: &GWord, words: &Words<'_>, positive: bool) -> Outcome<()> {
        needs_axes(g, words)?;
        for (axis, value, span) in &words.axes {
            let value_mm = value * self.axis_unit(*axis);
            match &mut self.geometry.limits_mm[*axis] {
                Some((_, high)) if positive => *high = value_mm,
                Some((low, _)) => *low = value_mm,
                None => {
                    let text = format!("axis {} has no software limits", self.names.name(*axis));
                    self.report.note(Fault::new(Condition::Ignored, text, *span));
                }
            }
        }
        Ok(())
    }

    fn zero_group_of_axes(&mut self, g: &GWord, words: &Words<'_>) -> Outcome<()> {
        needs_axes(g, words)?;
        let group = zero_group(g)?;
        // 0 takes the offset of the axis in, 1 leaves it out
        for (axis, value, _) in &words.axes {
            let masked = crate::exec::values::number::is_true(*value);
            self.geometry.coordinates.mask_zero_entry(group, *axis, masked);
        }
        Ok(())
    }

    /// G92: absolute with G90, added with G91.
    fn preset(&mut self, g: &GWord, words: &Words<'_>) -> Outcome<()> {
        needs_axes(g, words)?;
        for (axis, value, _) in &words.axes {
            let value_mm = value * self.axis_unit(*axis);
            let before =
                if self.modal.absolute { 0.0 } else { self.geometry.coordinates.preset(*axis) };
            self.geometry.coordinates.set_preset(*axis, before + value_mm);
        }
        Ok(())
    }

    fn mirror(&mut self, first: bool, second: bool) {
        self.modal.mirrored = [first, second];
        for (main, mirrored) in [(0, first), (1, second)] {
            if let Some(axis) = self.geometry.coordinates.main_axis(main) {
                self.geometry.coordinates.set_mirrored(axis, mirrored);
            }
        }
        if !first && !second {
            for axis in 0..self.machine.axes.len() {
                self.geometry.coordinates.set_mirrored(axis, false);
            }
        }
    }

    fn mirror_axes(&mut self, g: &GWord, words: &Words<'_>) -> Outcome<()> {
        needs_axes(g, words)?;
        for (axis, value, span) in &words.axes {
            let mirrored = match value {
                v if v.total_cmp(&1.0).is_eq() => false,
                v if v.total_cmp(&-1.0).is_eq() => true,
                _ => {
                    let text = format!("mirroring is switched by 1 and -1, not by {value}");
                    return Err(Fault::new(Condition::MirrorSwitch, text, *span)
                        .with(|d| d.value(ValueKind::Wrong, *value, "-")));
                }
            };
            self.geometry.coordinates.set_mirrored(*axis, mirrored);
        }
        Ok(())
    }

    fn rotate(&mut self, g: &GWord, words: &Words<'_>) -> Outcome<()> {
        let main = self.modal.plane.main_axes();
        let mut centre: [Option<f64>; 2] = [None; 2];
        for (axis, value, span) in &words.axes {
            match self.geometry.coordinates.main_index(*axis) {
                Some(m) if m == main[0] => centre[0] = Some(value * self.axis_unit(*axis)),
                Some(m) if m == main[1] => centre[1] = Some(value * self.axis_unit(*axis)),
                _ => {
                    let name = self.names.name(*axis).to_owned();
                    let text = format!("axis {name} is not in the plane of the rotation");
                    let number = self.machine.axes[*axis].number();
                    return Err(Fault::new(Condition::RotationAxis, text, *span)
                        .with(|d| d.axis(number, name).value(ValueKind::AxisNumber, number, "-")));
                }
            }
        }
        let deg = words.radius.map_or(0.0, |(deg, _)| deg);
        let plane = [main[0], main[1]];
        self.rotate_plane(plane, deg, centre, g.span)
    }

    /// G68, `#ROTATION`; refused where degrees and millimetres would mix.
    pub(in crate::exec) fn rotate_plane(
        &mut self,
        plane: [usize; 2],
        deg: f64,
        centre: [Option<f64>; 2],
        span: Span,
    ) -> Outcome<()> {
        let axis = |main: usize| self.geometry.coordinates.main_axis(main);
        let axes = plane.map(|main| axis(main).map(|axis| &self.machine.axes[axis]));
        if let [Some(first), Some(second)] = axes
            && (first.kind() != second.kind() || first.is_modulo() || second.is_modulo())
        {
            let what = format!("a rotation of the axes {} and {}", first.name(), second.name());
            return Err(Fault::unsupported(what, span).hint("only linear axes are turned"));
        }
        self.geometry.coordinates.rotate_about(plane, deg, centre, span)
    }
}
