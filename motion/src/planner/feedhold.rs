//! Slope under a feedhold.

use crate::block::Block;
use crate::limits::{PathExtremes, weakest};
use crate::profile::SlopeLimits;
use crate::queue::Queued;
use crate::realtime::FeedholdBraking;
use kontur_filters::time::CycleTime;

/// Slope of a block with the braking of a feedhold.
pub(super) fn feedhold_slope(
    queued: &Queued,
    braking: FeedholdBraking,
    cycle: CycleTime,
) -> SlopeLimits {
    if braking == FeedholdBraking::Active {
        return queued.slope.clone();
    }
    let block: &Block = &queued.block;
    let share = PathExtremes::of(&block.path).first;
    let axes = &block.dynamics.axes;
    let limit = block.dynamics.vector;
    let vector_dec = limit.dec_mm_s2.unwrap_or(f64::INFINITY);
    if matches!(queued.slope, SlopeLimits::Step(_)) {
        let dec = weakest(axes, &share, |a| a.feedhold.step_dec_mm_s2).min(vector_dec);
        return queued.slope.with_braking(dec, 0.0);
    }
    let dec = weakest(axes, &share, |a| a.feedhold.dec_mm_s2).min(vector_dec);
    let jerk = weakest(axes, &share, |a| {
        let ramp = a.feedhold.ramp_s;
        if ramp < cycle.seconds() { f64::INFINITY } else { a.feedhold.dec_mm_s2 / ramp }
    });
    queued.slope.with_braking(dec, dec / jerk.min(limit.jerk_mm_s3.unwrap_or(f64::INFINITY)))
}
