//! Writing to system variables.

use super::path::{Path, written};
use super::refused::unknown;
use super::{find, indices_fit, is_kinematic, kinematic};
use crate::diag::Condition;
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::geometry::coordinates::LAST_ZERO_GROUP;
use crate::exec::geometry::tools::Tool;
use crate::exec::geometry::tools::WEAR_UNIT;
use crate::exec::options::Value;
use crate::exec::program::state::Calls;
use crate::exec::report::{Report, Subject};
use crate::exec::values::number::{as_number, is_true, whole};
use crate::syntax::ast::{Segment, Span};
use std::sync::Arc;

/// Maximum number of kinematic parameters stored.
const KINEMATICS_MAX: usize = 10_000;

/// Writes a system variable; 20100 if it cannot be written.
pub(in crate::exec) fn write(
    d: &mut Decoder,
    segments: &[Segment],
    value: &Value,
    span: Span,
) -> Outcome<()> {
    if is_kinematic(segments) {
        return write_kinematic(d, segments, value, span);
    }
    if let Some(row) = find(segments) {
        indices_fit(row, segments, span)?;
    }
    let path = Path { segments, span };
    let names: Vec<String> = segments.iter().map(|s| s.name.to_ascii_uppercase()).collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let x = || as_number(value, span);
    match names[..] {
        ["G", "NP", "V", _] | ["G", "NP", "V"] => {
            let group = path.index(d, 1, LAST_ZERO_GROUP)?;
            let (axis, offset) = zero_offset(d, &path, x)?;
            d.geometry.coordinates.set_zero_entry(group, axis, offset);
        }
        ["G", "NP_AKT", "V", _] | ["G", "NP_AKT", "V"] => {
            let (axis, offset) = zero_offset(d, &path, x)?;
            d.geometry.coordinates.set_zero_offset(axis, offset);
        }
        ["G", "NP_DEFAULT"] => write_default_group(d, x()?, span)?,
        ["G", "CYCLE_CHANGES_MODAL"] => {
            let stay = is_true(x()?);
            (d.calls.cycle_changes_stay, d.calls.retain_cycle_changes) = (stay, stay);
        }
        ["G", name @ ("MAX_NC_BLOCKS_AHEAD" | "MAX_MOTION_BLOCKS_AHEAD")] => {
            let motions = usize::from(name == "MAX_MOTION_BLOCKS_AHEAD");
            d.calls.limit_blocks_ahead(motions, x()?, span, &mut d.report)?;
        }
        ["G", "WZ_AKT", "WEAR_CONST"] => {
            write_wear_constant(d, x()?, span)?;
        }
        // spindles have no M functions free for other purposes here (P-CHAN-00098)
        ["SPDL", "M_FCT_FREE"] => {
            if is_true(x()?) {
                return Err(Fault::unsupported("V.SPDL.M_FCT_FREE = 1", span));
            }
        }
        ["TLM", name @ ("TIME_FACT" | "DIST_FACT")] => write_tool_life(d, name, x()?, span)?,
        ["G", "RW"] => {
            d.motion.measuring.residual_path_mm = x()? * d.modal.unit_mm();
        }
        ["G", "WZR"] => {
            d.geometry.tools.active.radius_mm = x()?;
        }
        ["G", "WZL"] => write_tool_length(d, x()?),
        ["G", "WZ_AKT", ..] => write_active_tool(d, &path, &names[2..], x()?)?,
        ["G", "WZ", ..] => write_listed_tool(d, &path, &names[2..], value)?,
        _ if find(segments).is_some() => return Err(not_writable(segments, span)),
        _ => return Err(unknown(d, segments, span)),
    }
    Ok(())
}

/// 20100.
fn not_writable(segments: &[Segment], span: Span) -> Box<Fault> {
    let text = format!("V.{} may not be written", written(segments));
    Fault::new(Condition::VariableNotWritable, text, span)
}

/// Axis and offset in mm or deg of a zero offset.
fn zero_offset(
    d: &Decoder,
    path: &Path<'_>,
    value: impl FnOnce() -> Outcome<f64>,
) -> Outcome<(usize, f64)> {
    let axis = path.axis(d, 3)?;
    Ok((axis, value()? * d.modal.axis_unit(&d.machine.axes[axis])))
}

/// `V.G.WZ_AKT.WEAR_CONST`.
fn write_wear_constant(d: &mut Decoder, value: f64, span: Span) -> Outcome<()> {
    d.geometry.tools.active.wear_ratio = value * WEAR_UNIT;
    if d.motion.wear.on {
        d.motion.apply_wear(&d.geometry, &d.modal, &mut d.contour, span)?;
    }
    Ok(())
}

/// `V.G.WZL`.
fn write_tool_length(d: &mut Decoder, value: f64) {
    d.geometry.tools.active.length_mm = value;
    d.geometry.coordinates.tool_programmed();
    d.geometry.apply_tool(d.modal.plane.main_axes());
}

/// `V.G.KIN[..]`: stored without effect.
fn write_kinematic(
    d: &mut Decoder,
    segments: &[Segment],
    value: &Value,
    span: Span,
) -> Outcome<()> {
    let name = kinematic(d, segments, span)?;
    let value = as_number(value, span)?;
    if d.values.kinematics.len() >= KINEMATICS_MAX && !d.values.kinematics.contains_key(&name) {
        let text = format!("more than {KINEMATICS_MAX} kinematic parameters");
        return Err(Fault::new(Condition::Range, text, span));
    }
    d.values.kinematics.insert(name, value);
    let text =
        "V.G.KIN: transformations are treated as the identity, their parameters have no effect";
    d.report.note_once("V.G.KIN", Fault::new(Condition::Fallback, text, span));
    Ok(())
}

/// `V.G.NP_DEFAULT` (206511627): the group of the next program start, stored without effect here.
fn write_default_group(d: &mut Decoder, group: f64, span: Span) -> Outcome<()> {
    let Some(number) = whole(group, 0, LAST_ZERO_GROUP) else {
        let text = format!("V.G.NP_DEFAULT = {group}, allowed: 0 to {LAST_ZERO_GROUP}");
        return Err(Fault::new(Condition::Range, text, span));
    };
    Arc::make_mut(&mut d.machine).zero_offsets.start_group = number;
    let text = "V.G.NP_DEFAULT: the group is that of the next program start, no effect in this run";
    d.report.note_once("V.G.NP_DEFAULT", Fault::new(Condition::Ignored, text, span));
    Ok(())
}

/// `V.TLM.TIME_FACT`, `V.TLM.DIST_FACT`: stored without effect.
fn write_tool_life(d: &mut Decoder, name: &str, weight: f64, span: Span) -> Outcome<()> {
    if weight < 0.0 {
        let text = format!("V.TLM.{name} = {weight}, allowed: values from 0");
        return Err(Fault::new(Condition::Range, text, span));
    }
    d.values.tool_life[usize::from(name == "DIST_FACT")] = weight;
    let text = "V.TLM: tool life is not counted, its weights have no effect";
    d.report.note_once("V.TLM", Fault::new(Condition::Ignored, text, span));
    Ok(())
}

/// `V.G.WZ_AKT`: the tool data in use; length and offsets act at once.
fn write_active_tool(d: &mut Decoder, path: &Path<'_>, names: &[&str], x: f64) -> Outcome<()> {
    let mut tool = d.geometry.tools.active.clone();
    write_tool(d, path, names, &mut tool, x)?;
    d.geometry.tools.active = tool;
    if matches!(names[0], "L" | "V") {
        d.geometry.coordinates.tool_programmed();
    }
    d.geometry.apply_tool(d.modal.plane.main_axes());
    Ok(())
}

/// `V.G.WZ[n]`: the tool table.
fn write_listed_tool(
    d: &mut Decoder,
    path: &Path<'_>,
    names: &[&str],
    value: &Value,
) -> Outcome<()> {
    let index = path.index(d, 1, u32::MAX)?;
    if d.geometry.tools.table.len() >= 10_000 && !d.geometry.tools.table.contains_key(&index) {
        let text = "the tool table holds at most 10000 tools";
        return Err(Fault::new(Condition::Range, text, path.span));
    }
    let mut tool = path.tool(d)?;
    write_tool(d, path, names, &mut tool, as_number(value, path.span)?)?;
    d.geometry.tools.table.insert(index, tool);
    Ok(())
}

fn write_tool(
    d: &Decoder,
    path: &Path<'_>,
    names: &[&str],
    tool: &mut Tool,
    x: f64,
) -> Outcome<()> {
    match *names {
        ["OK"] => tool.is_valid = x.abs() > 0.0,
        ["R"] => tool.radius_mm = x,
        ["L"] => tool.length_mm = x,
        ["SPDL_AX_NR"] => {
            let number = whole(x, 0, u32::from(u16::MAX)).ok_or_else(|| {
                let text = format!("{x} is not a logical axis number");
                Fault::new(Condition::Range, text, path.span)
            })?;
            tool.spindle = number;
        }
        ["V", _] | ["V"] => {
            tool.offsets_mm.insert(path.axis(d, 3)?, x);
        }
        ["P"] => {
            tool.parameters.insert(path.index(d, 2, 1000)?, x);
        }
        _ => return Err(unknown(d, path.segments, path.span)),
    }
    Ok(())
}

impl Calls {
    /// `V.G.MAX_NC_BLOCKS_AHEAD`, `V.G.MAX_MOTION_BLOCKS_AHEAD`: how far the decoder may be ahead of the motion.
    ///
    /// Source: TF5200 limiting the decoder block ahead, 301889163; 21575.
    fn limit_blocks_ahead(
        &mut self,
        which: usize,
        blocks: f64,
        span: Span,
        report: &mut Report,
    ) -> Outcome<()> {
        let Some(blocks) = whole(blocks, 0, u32::MAX) else {
            let text = format!("{blocks} blocks ahead, allowed: whole numbers from 0");
            return Err(Fault::new(Condition::Range, text, span));
        };
        if blocks > 0 && self.blocks_ahead[1 - which] > 0.0 {
            let text = "two limits for the blocks read ahead: the other one is active";
            return Err(Fault::new(Condition::BlocksAheadTwice, text, span));
        }
        self.blocks_ahead[which] = f64::from(blocks);
        if blocks > 0 {
            let text = "the number of blocks read ahead is not limited: the path is planned over all of them";
            report.note_once(Subject::BlocksAhead, Fault::new(Condition::Fallback, text, span));
        }
        Ok(())
    }
}
