//! Tool data: from the tool list, or written by the program (`V.G.WZ[i]`); selected by D.
//!
//! Assumption: without data a tool has neither length nor radius; selecting it warns once.

pub(in crate::exec) use crate::machine::Tool;
use std::collections::BTreeMap;

/// mm of wear per mm of travel for one unit of WEAR_CONST: 0.1 um per metre.
pub(in crate::exec) const WEAR_UNIT: f64 = 1e-7;

/// Tool table and selection.
#[derive(Clone, Debug, Default, PartialEq)]
pub(in crate::exec) struct Tools {
    pub(in crate::exec) table: BTreeMap<u32, Tool>,
    /// T.
    pub(in crate::exec) tool: u32,
    /// D.
    pub(in crate::exec) data: u32,
    /// Active data: a copy, so that `V.G.WZ_AKT` can be written.
    pub(in crate::exec) active: Tool,
    /// `#TLAX`: axis of the tool length with its direction, 1 or -1; otherwise the third axis of the plane.
    pub(in crate::exec) length_axis: Option<(usize, f64)>,
}
