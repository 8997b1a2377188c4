//! The four views of curves: each gives a table and a picture.

mod answer;
mod corner;
mod frequency;
mod residual;
mod step;

use super::curve::Curve;
use crate::args::ResponseArgs;
use crate::error::Error;
use kontur_filters::time::CycleTime;

pub(super) use answer::Answer;

/// The view selected by the arguments.
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
