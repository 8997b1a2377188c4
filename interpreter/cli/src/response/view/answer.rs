//! The result of a view, and texts and frequencies that the views share.

use super::super::curve::Curve;
use crate::chart::plot::Plot;
use crate::table::Table;
use kontur_filters::time::CycleTime;

/// A view as numbers and picture.
#[derive(Debug)]
pub(in crate::response) struct Answer {
    pub(in crate::response) table: Table,
    pub(in crate::response) plot: Plot,
}

/// Cycle time as text.
pub(super) fn cycle_text(cycle: CycleTime) -> String {
    format!("cycle {} ms", f64::from(cycle.us()) / 1000.0)
}

pub(super) fn labels(curves: &[Curve]) -> Vec<String> {
    curves.iter().map(|curve| curve.label.clone()).collect()
}

/// Frequencies from `low` to `high`, evenly spread on a logarithmic scale, both ends included.
pub(super) fn spread((low, high): (f64, f64), count: u32) -> impl Iterator<Item = f64> {
    let ratio = libm::log(high / low) / f64::from(count);
    (0..=count).map(move |i| if i == count { high } else { low * libm::exp(ratio * f64::from(i)) })
}
