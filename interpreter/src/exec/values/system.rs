//! System variables `V.A.`, `V.G.`, `V.SPDL.`, `V.SPDL_PROG.`: reading and writing.
//!
//! Positions are in the unit of the program (G70: inch). Source: TF5200 programming manual, V.A. and V.G.

use crate::diag::Condition;
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::options::Value;
use crate::syntax::ast::{Segment, Span};

mod path;
mod refused;
mod rows;
mod write;

use path::Path;
use refused::unknown;
use rows::{ROWS, Row};
pub(in crate::exec) use write::write;

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
