//! Slope under a feedhold and at a probe signal.
//!
//! The limits of `#VECTOR LIMIT` act on the deceleration of the active slope only: to keep them from lengthening the way to
//! the stop, the manual recommends the parameters of the feedhold (P-CHAN-00097 = 1; dynamic parameters 248629515).

use crate::axis::{AxisDynamics, FeedholdSlope};
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
    let own = braking == FeedholdBraking::Own;
    if matches!(queued.slope, SlopeLimits::Step(_)) {
        let of_axis = |a: &AxisDynamics| {
            let [below, above] = a.step_rapid.dec_mm_s2;
            if own { a.feedhold.step_dec_mm_s2 } else { below.min(above) }
        };
        let dec = weakest(axes, &share, of_axis);
        return queued.slope.with_braking(dec, 0.0);
    }
    let of_axis = |a: &AxisDynamics| {
        let FeedholdSlope { dec_mm_s2, ramp_s, .. } = a.feedhold;
        if own { (dec_mm_s2, ramp_s) } else { (a.rapid.acc_mm_s2, a.rapid.ramp_s) }
    };
    let dec = weakest(axes, &share, |a| of_axis(a).0);
    let jerk = weakest(axes, &share, |a| {
        let (dec, ramp) = of_axis(a);
        if ramp < cycle.seconds() { f64::INFINITY } else { dec / ramp }
    });
    queued.slope.with_braking(dec, dec / jerk)
}
