//! Tool data: written by the program (`V.G.WZ[i]`), selected by D.
//!
//! Assumption: without data a tool has neither length nor radius; selecting it warns once.

use std::collections::BTreeMap;

/// One tool.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Tool {
    pub(super) radius_mm: f64,
    pub(super) length_mm: f64,
    /// Offsets by axis index.
    pub(super) offsets_mm: BTreeMap<usize, f64>,
    /// Free parameters `P[i]`.
    pub(super) parameters: BTreeMap<u32, f64>,
}

/// Tool table and what is selected.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Tools {
    pub(super) table: BTreeMap<u32, Tool>,
    /// T.
    pub(super) tool: u32,
    /// D.
    pub(super) data: u32,
    /// Data in use: a copy, so that `V.G.WZ_AKT` can be written.
    pub(super) active: Tool,
}
