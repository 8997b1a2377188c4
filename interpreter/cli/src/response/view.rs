//! The four views of curves: each gives a table and a picture.

mod corner;
mod frequency;
mod residual;
mod step;

use super::curve::Curve;
use crate::Error;
use crate::args::ResponseArgs;
use crate::chart::plot::Plot;
use crate::table::Table;
use kontur_filters::time::CycleTime;

/// A view: numbers and their picture.
#[derive(Debug)]
pub(super) struct Answer {
    pub(super) table: Table,
    pub(super) plot: Plot,
}

/// The view that the arguments ask for.
///
/// # Errors
/// [`Error::Usage`] if the view does not suit a curve.
pub(super) fn view(
    args: &ResponseArgs,
    curves: &[Curve],
    cycle: CycleTime,
) -> Result<Answer, Error> {
    if args.step {
        Ok(step::view(curves, cycle))
    } else if args.residual {
        residual::view(args, curves, cycle)
    } else if let Some(feed_mm_min) = args.corner {
        corner::view(curves, feed_mm_min, cycle)
    } else {
        frequency::view(args, curves, cycle)
    }
}

/// Cycle time in words.
fn cycle_text(cycle: CycleTime) -> String {
    format!("cycle {} ms", f64::from(cycle.us()) / 1000.0)
}

fn labels(curves: &[Curve]) -> Vec<String> {
    curves.iter().map(|curve| curve.label.clone()).collect()
}

/// Frequencies from `low` to `high`, evenly spread on a logarithmic scale, both ends included.
fn spread((low, high): (f64, f64), count: u32) -> impl Iterator<Item = f64> {
    let ratio = libm::log(high / low) / f64::from(count);
    (0..=count).map(move |i| if i == count { high } else { low * libm::exp(ratio * f64::from(i)) })
}
