//! Variables refused individually with a reason, and names that are in no list.

use super::path::written;
use super::rows::ROWS;
use crate::diag::Condition;
use crate::exec::decoder::Decoder;
use crate::exec::fault::Fault;
use crate::suggest;
use crate::syntax::ast::{Segment, Span};

/// Classes of variables that are refused as a whole, with the reason.
const CLASSES: &[(&str, &str)] = &[
    (
        "TOOL",
        "tool IDs are not available, as tool management is not simulated; use V.G.T_AKT and V.G.D_AKT for the T and D words",
    ),
    ("TLM", "the weights of tool life are V.TLM.TIME_FACT and V.TLM.DIST_FACT"),
    ("RTG", "real-time cycles (#RT CYCLE) are not simulated"),
    ("RTA", "real-time cycles (#RT CYCLE) are not simulated"),
    ("I", "these variables are not documented"),
];

/// Variables of functions that are not simulated, with the reason. Source: TF5200 volumetric compensation; outputs of M
/// and H functions before their place (148946059); number of the commanding channel of a job manager (1139945739);
/// block type (tccncprogramming 15557116555); ADS access (312808843).
const OTHERS: &[(&str, &str, &str)] = &[
    ("A", "RETRACT_ACS_POS", "tools are not retracted after a fault"),
    ("A", "WCS", "the documentation does not state the coordinate system of this variable"),
    ("G", "VOLCOMP", "volumetric compensation is not simulated"),
    ("G", "M_FCT", "outputs ahead of their position are not simulated"),
    ("G", "H_FCT", "outputs ahead of their position are not simulated"),
    ("G", "IP_NR", "the job manager is not simulated"),
    ("G", "PROG_SA", "the numbers of the block types are not documented"),
];

/// Tool data that is not used here. Source: TF5200 external tool management 318262795; online tool compensation
/// 213748491, whose wear is known only to the simulation.
const OTHER_TOOL_DATA: &[&str] = &[
    "KIN_ID",
    "KIN_PARAM",
    "SISTER",
    "SISTER_VALID",
    "SRK_ID",
    "SUB_TYPE",
    "S_MAX_ACC",
    "S_MAX_SPEED",
    "S_MIN_SPEED",
    "TOOL_FIXED",
    "VARIANT",
    "VARIANT_VALID",
    "WEAR",
    "WEAR_RADIUS",
    "WEAR_RADIUS_CONT",
];

pub(super) fn unknown(d: &Decoder, segments: &[Segment], span: Span) -> Box<Fault> {
    let name = written(segments);
    let class = segments.first().map_or("", |s| &*s.name).to_ascii_uppercase();
    if let Some((_, why)) = CLASSES.iter().find(|(refused, _)| *refused == class) {
        return Fault::unsupported(format!("V.{name}"), span).hint(*why);
    }
    let names: Vec<String> = segments.iter().map(|s| s.name.to_ascii_uppercase()).collect();
    if let [class, name, ..] = &names[..]
        && let Some((_, _, why)) = OTHERS.iter().find(|(c, n, _)| c == class && n == name)
    {
        return Fault::unsupported(format!("V.{class}.{name}"), span).hint(*why);
    }
    if let [class, tool, name, ..] = &names[..]
        && class == "G"
        && matches!(tool.as_str(), "WZ" | "WZ_AKT")
        && OTHER_TOOL_DATA.contains(&name.as_str())
    {
        return Fault::unsupported(format!("variable V.G.{tool}.{name}"), span);
    }
    let axis = d.names.in_channel().next().unwrap_or("X");
    let names: Vec<String> =
        ROWS.iter().map(|row| row.name.join(".").replace('*', axis).replace(".s", ".S")).collect();
    let fault = Fault::new(Condition::Undefined, format!("unknown variable V.{name}"), span);
    // an incomplete name, or one without its axis
    let begun = || names.iter().filter(|known| known.starts_with(&name.to_ascii_uppercase()));
    let near = suggest::nearest(&name, names.iter().map(String::as_str));
    match near.or_else(|| begun().min_by_key(|known| known.len()).map(String::as_str)) {
        Some(near) => fault.hint(format!("did you mean `V.{near}`?")),
        None => fault.hint("declare program variables V.P.NAME and V.L.NAME with #VAR"),
    }
}
