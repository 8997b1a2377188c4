//! Tool data: written by the program (`V.G.WZ[i]`), selected by D.
//!
//! Assumption: without data a tool has neither length nor radius; selecting it warns once.

use std::collections::BTreeMap;

/// One tool.
#[derive(Clone, Debug, Default, PartialEq)]
pub(in crate::exec) struct Tool {
    pub(in crate::exec) radius_mm: f64,
    pub(in crate::exec) length_mm: f64,
    /// Offsets by axis index.
    pub(in crate::exec) offsets_mm: BTreeMap<usize, f64>,
    /// Free parameters `P[i]`.
    pub(in crate::exec) parameters: BTreeMap<u32, f64>,
}

/// Tool table and what is selected.
#[derive(Clone, Debug, Default, PartialEq)]
pub(in crate::exec) struct Tools {
    pub(in crate::exec) table: BTreeMap<u32, Tool>,
    /// T.
    pub(in crate::exec) tool: u32,
    /// D.
    pub(in crate::exec) data: u32,
    /// Data in use: a copy, so that `V.G.WZ_AKT` can be written.
    pub(in crate::exec) active: Tool,
}
