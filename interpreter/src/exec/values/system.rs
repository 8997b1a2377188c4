//! System variables `V.A.`, `V.G.`, `V.SPDL.`, `V.SPDL_PROG.`: reading and writing.
//!
//! Positions are in the unit of the program (G70: inch). Source: TF5200 programming manual, V.A. and V.G.

use super::number::whole;
use crate::diag::{Condition, ValueKind};
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::geometry::tools::Tool;
use crate::exec::options::Value;
use crate::syntax::ast::{Segment, Span};

mod refused;
mod rows;
mod write;

use refused::unknown;
use rows::{ROWS, Row};
pub(in crate::exec) use write::write;

/// A variable as written, split into its parts.
struct Path<'a> {
    segments: &'a [Segment],
    span: Span,
}

/// Names followed by an index.
const INDEXED: [&str; 6] = ["NP", "WZ", "P", "MERR", "TIMER", "@P"];

impl Row {
    /// The name as used in programs, with X for an axis, S for a spindle and i for an index.
    fn title(&self) -> String {
        let segment = |name: &&str| match *name {
            "*" => "X".to_owned(),
            "s" => "S".to_owned(),
            name if INDEXED.contains(&name) => format!("{name}[i]"),
            name => name.to_owned(),
        };
        format!("V.{}", self.name.iter().map(segment).collect::<Vec<_>>().join("."))
    }
}

/// All variables with their meanings.
pub(crate) fn meanings() -> impl Iterator<Item = (String, &'static str)> {
    ROWS.iter().map(|row| (row.title(), row.meaning))
}

/// The variable named by a text such as `V.A.ABS.X` or `V.G.WZ[2].R`, with its meaning.
pub(crate) fn meaning_of(text: &str) -> Option<(String, &'static str)> {
    let upper = text.to_ascii_uppercase();
    let written: Vec<&str> = upper
        .strip_prefix("V.")?
        .split('.')
        .map(|segment| segment.split_once('[').map_or(segment, |(name, _)| name))
        .collect();
    let fits = |(pattern, s): (&&str, &&str)| matches!(*pattern, "*" | "s") || pattern == s;
    let is =
        |row: &&Row| row.name.len() == written.len() && row.name.iter().zip(&written).all(fits);
    // without its axis: V.A.ABS
    let is_without_axis = |row: &&Row| {
        row.name.split_last().is_some_and(|(last, front)| {
            *last == "*" && front.len() == written.len() && front.iter().zip(&written).all(fits)
        })
    };
    ROWS.iter()
        .find(is)
        .or_else(|| ROWS.iter().find(is_without_axis))
        .map(|row| (row.title(), row.meaning))
}

impl Path<'_> {
    /// A position of an axis in the unit of the program.
    fn position(
        &self,
        d: &Decoder,
        at: usize,
        f: impl Fn(&Decoder, usize) -> f64,
    ) -> Outcome<Value> {
        let axis = self.axis(d, at)?;
        Ok(Value::Number(f(d, axis) / d.modal.axis_unit(&d.machine.axes[axis])))
    }

    /// A coordinate of the program. Refused for a scaled axis, because the documents do not specify whether it is the
    /// coordinate before or after scaling.
    fn coordinate(
        &self,
        d: &Decoder,
        at: usize,
        f: impl Fn(&Decoder, usize) -> f64,
    ) -> Outcome<Value> {
        let axis = self.axis(d, at)?;
        if d.geometry.scale.changes(axis) {
            let name = written(self.segments);
            return Err(Fault::unsupported(format!("V.{name} with #SCALE"), self.span));
        }
        self.position(d, at, f)
    }

    /// Position of an axis with all offsets; 21784 for an axis that follows a master.
    fn axis_position(&self, d: &Decoder) -> Outcome<Value> {
        let axis = self.axis(d, 3)?;
        if d.motion.couplings.is_slave(axis) {
            let text = format!("axis {} follows a master", d.names.name(axis));
            return Err(Fault::new(Condition::AxisPositionOfSlave, text, self.span));
        }
        self.position(d, 3, |d, a| d.geometry.coordinates.target()[a])
    }

    /// Axis by its name in the segment `at`, or by the index after the segment before.
    fn axis(&self, d: &Decoder, at: usize) -> Outcome<usize> {
        if let Some(segment) = self.segments.get(at) {
            return d.names.of_name(&segment.name).ok_or_else(|| {
                let text = format!("unknown axis `{}`", segment.name);
                Fault::new(Condition::AxisIdentifier, text, self.span).hint(d.names.hint())
            });
        }
        let high = u32::try_from(d.machine.axes.len().saturating_sub(1)).unwrap_or(0);
        let index = self.index(d, at - 1, high)? as usize;
        Ok(index)
    }

    fn spindle(&self, d: &Decoder, at: usize) -> Outcome<usize> {
        let name = self.segments.get(at).map_or("", |s| &*s.name);
        d.motion.spindle_of_name(name, &d.machine.channel).ok_or_else(|| {
            let text = format!("unknown spindle `{name}`");
            Fault::new(Condition::AxisIdentifier, text, self.span)
        })
    }

    /// A value that exists only for the main spindle; 0 for any other.
    fn of_main_spindle(&self, d: &Decoder, value: f64) -> Outcome<Value> {
        Ok(Value::Number(if self.spindle(d, 2)? == 0 { value } else { 0.0 }))
    }

    /// Index after a segment.
    fn index(&self, d: &Decoder, at: usize, high: u32) -> Outcome<u32> {
        let subscripts = self.segments.get(at).map(|s| &s.subscripts[..]);
        match subscripts {
            Some([expr]) => {
                let x = d.number(expr)?;
                whole(x, 0, high).ok_or_else(|| {
                    let tool =
                        self.segments.get(1).is_some_and(|s| s.name.eq_ignore_ascii_case("WZ"));
                    let condition =
                        if tool { Condition::ToolIndex } else { Condition::VariableNumber };
                    let text = format!("the index is {x}, allowed: whole numbers 0 to {high}");
                    Fault::new(condition, text, expr.span).with(|d| {
                        d.value(ValueKind::Wrong, x, "-")
                            .value(ValueKind::LowerLimit, 0, "-")
                            .value(ValueKind::UpperLimit, high, "-")
                    })
                })
            }
            _ => Err(Fault::new(Condition::Syntax, "one index is expected", self.span)),
        }
    }

    fn tool(&self, d: &Decoder) -> Outcome<Tool> {
        let index = self.index(d, 1, u32::MAX)?;
        Ok(d.geometry.tools.table.get(&index).cloned().unwrap_or_default())
    }

    /// `V.G.@P[i].VALID`.
    fn passed(&self, d: &Decoder) -> Outcome<Value> {
        let name = format!("P{}", self.index(d, 1, 200)?);
        if let Some(passed) = d.values.variables.passed(&name) {
            Ok(Value::truth(passed))
        } else {
            let text = "V.G.@P[i].VALID only exists inside a cycle";
            Err(Fault::new(Condition::ParameterOutsideCycle, text, self.span))
        }
    }
}

/// The row of a variable. A last `*` may be missing, if an index follows the segment before.
fn find(segments: &[Segment]) -> Option<&'static Row> {
    ROWS.iter().find(|row| {
        let open = |pattern: &str| matches!(pattern, "*" | "s");
        let indexed = row.name.len() == segments.len() + 1
            && row.name.last() == Some(&"*")
            && segments.last().is_some_and(|s| s.subscripts.len() == 1);
        (row.name.len() == segments.len() || indexed)
            && row
                .name
                .iter()
                .zip(segments)
                .all(|(pattern, s)| open(pattern) || s.name.eq_ignore_ascii_case(pattern))
    })
}

fn written(segments: &[Segment]) -> String {
    segments.iter().map(|s| &*s.name).collect::<Vec<_>>().join(".")
}

/// Reads a system variable.
pub(in crate::exec) fn read(d: &Decoder, segments: &[Segment], span: Span) -> Outcome<Value> {
    if is_kinematic(segments) {
        let name = kinematic(d, segments, span)?;
        return Ok(Value::Number(d.values.kinematics.get(&name).copied().unwrap_or(0.0)));
    }
    match find(segments) {
        Some(row) => {
            indices_fit(row, segments, span)?;
            (row.read)(d, &Path { segments, span })
        }
        None => Err(unknown(d, segments, span)),
    }
}

/// 21768 for an index that the variable does not have; the last name may be replaced by the index of an axis.
fn indices_fit(row: &Row, segments: &[Segment], span: Span) -> Outcome<()> {
    let by_index = row.name.len() > segments.len();
    let takes = |i: usize| INDEXED.contains(&row.name[i]) || by_index && i + 1 == segments.len();
    let wrong = (0..segments.len()).find(|i| !segments[*i].subscripts.is_empty() && !takes(*i));
    match wrong {
        Some(i) => {
            let text = format!("{}: {} does not take an index", row.title(), segments[i].name);
            Err(Fault::new(Condition::NoArray, text, span).hint("remove the index"))
        }
        None => Ok(()),
    }
}

/// Whether it is `V.G.KIN..`: parameters of kinematic transformations.
fn is_kinematic(segments: &[Segment]) -> bool {
    let is =
        |i: usize, name: &str| segments.get(i).is_some_and(|s| s.name.eq_ignore_ascii_case(name));
    is(0, "G") && is(1, "KIN")
}

/// Name of a kinematic parameter with its indices; refused unless transformations are treated as the identity.
fn kinematic(d: &Decoder, segments: &[Segment], span: Span) -> Outcome<String> {
    if !d.identity_trafo {
        let hint = "--identity-trafo treats transformations as the identity, their parameters have no effect";
        return Err(Fault::unsupported("variable V.G.KIN", span).hint(hint));
    }
    let mut parts = Vec::new();
    for segment in segments {
        parts.push(segment.name.to_ascii_uppercase());
        for subscript in &segment.subscripts {
            parts.push(format!("[{}]", d.number(subscript)?));
        }
    }
    Ok(parts.join("."))
}

/// Whether reading this variable requires the machine at rest and its actual positions.
pub(in crate::exec) fn needs_actual(segments: &[Segment]) -> bool {
    let is =
        |i: usize, name: &str| segments.get(i).is_some_and(|s| s.name.eq_ignore_ascii_case(name));
    is(0, "A") && (is(1, "ACT_POS") || segments.get(1).is_some_and(|s| is_compensation(&s.name)))
}

/// Whether it is `V.A.LEAD_COMP_ACTIVE` or a similar variable, whose page states that reading it flushes the channel.
fn is_compensation(name: &str) -> bool {
    let name = name.to_ascii_uppercase();
    name.ends_with("_COMP_INIT") || name.ends_with("_COMP_ACTIVE")
}

/// Whether it is `V.G.WZ_AKT`, `V.G.WZL` or `V.G.WZR`: the tool data in use.
pub(in crate::exec) fn is_active_tool(segments: &[Segment]) -> bool {
    let is =
        |i: usize, name: &str| segments.get(i).is_some_and(|s| s.name.eq_ignore_ascii_case(name));
    is(0, "G") && ["WZ_AKT", "WZL", "WZR"].iter().any(|name| is(1, name))
}
