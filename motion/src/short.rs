//! Kinks that fall into the same cycle (blocks shorter than `v T`): together they are one jump of the axis velocity.
//!
//! Over the length `d` of a run of lines between two of its kinks the direction of axis `i` changes by `U_i`. As long as
//! the path needs more than a cycle for it (`v <= d / T`) every kink counts for itself, else `v U_i` is bounded like a
//! single jump. On a fine chord polygon that is the limit of the circle, `v^2 / r <= w a` (derived).

use crate::corner::admissible_jump;
use crate::limit::SpeedLimit;
use crate::lookahead::Cap;
use crate::queue::Queued;
use kontur_filters::time::CycleTime;
use std::collections::VecDeque;
use std::sync::Arc;

/// Kinks that are looked at one by one; a run with more of them in a cycle is taken as a curve.
const KINKS: usize = 64;

/// Lowers the caps in front of the newest block and of those before it. `caps[i]` stands before block `i`.
pub(crate) fn lower_caps(
    queue: &VecDeque<Arc<Queued>>,
    caps: &mut VecDeque<Cap>,
    cycle: CycleTime,
    kernel_active: bool,
) {
    let newest = queue.len() - 1;
    let to = &queue[newest];
    let mut distance = 0.0;
    for back in 1..=KINKS {
        let Some(first) = newest.checked_sub(back).filter(|f| *f > 0) else { return };
        let (from, inner) = (&queue[first - 1], &queue[first]);
        if ![from, inner, to].iter().all(|q| q.block.path.is_straight()) {
            return;
        }
        distance += inner.length;
        let apart = distance / cycle.seconds();
        // an override may come later
        let fastest = to.speeds.fastest().min(inner.speeds.fastest());
        let fastest = fastest.min(caps[newest].0).min(caps[first].0);
        if apart >= fastest {
            return;
        }
        let mut together = f64::INFINITY;
        for i in 0..from.ends.tangent_out.len() {
            let turn = (to.ends.tangent_in[i] - from.ends.tangent_out[i]).abs();
            if turn > 0.0 {
                let jump = admissible_jump(&from.block, &to.block, i, cycle, kernel_active);
                together = together.min(jump / turn);
            }
        }
        let v = if back == KINKS { (together * apart).sqrt() } else { together }.max(apart);
        for boundary in [first, newest] {
            if v < caps[boundary].0 {
                caps[boundary] = (v, SpeedLimit::Curve);
            }
        }
    }
}
