//! Kinks within the same cycle (blocks shorter than `v T`): together they act as a single jump of the axis velocity.
//!
//! Over the length `d` of a run of lines between two of its kinks the direction of axis `i` changes by `U_i`. As long
//! as the path takes longer than a cycle for it (`v <= d / T`) every kink counts separately; otherwise `v U_i` is
//! limited like a single jump. On a fine chord polygon this is the limit of the circle, `v^2 / r <= w a` (derived).

use super::Segment;
use crate::cap::{Cap, SpeedLimit};
use crate::junction::{Jumps, TANGENT};
use crate::queue::Queued;
use kontur_filters::time::CycleTime;
use std::collections::VecDeque;

/// Largest number of kinks that are examined one by one; a run with more of them in a cycle is treated as a curve.
const KINKS: usize = 64;
/// Largest number of blocks examined for them: most may continue straight.
const BLOCKS: usize = 1024;

/// Lowers the caps at the starts of the newest segment and of those before it.
pub(super) fn lower_caps(segments: &mut VecDeque<Segment>, cycle: CycleTime, kernel_active: bool) {
    let newest = segments.len() - 1;
    if newest == 0 || !is_kink(&segments[newest - 1].queued, &segments[newest].queued) {
        return;
    }
    let (mut distance, mut kinks) = (0.0, 0);
    for first in (1..newest).rev().take(BLOCKS) {
        let queued = |i: usize| &segments[i].queued;
        let (from, inner) = (queued(first - 1), queued(first));
        let (before_last, to) = (queued(newest - 1), queued(newest));
        if ![from, inner, to].iter().all(|q| q.block.path.is_straight()) {
            return;
        }
        distance += inner.length;
        let apart = distance / cycle.seconds();
        // the override may still be raised later
        let fastest = to.fastest_behind(before_last).min(inner.fastest_behind(from));
        let fastest = fastest.min(segments[newest].cap.v_mm_s).min(segments[first].cap.v_mm_s);
        if apart >= fastest {
            return;
        }
        if !is_kink(from, inner) {
            continue;
        }
        kinks += 1;
        let mut together = f64::INFINITY;
        let jumps = Jumps::between(&from.block, &to.block, cycle, kernel_active);
        for i in 0..from.ends.tangent_out.len() {
            let turn = (to.ends.tangent_in[i] - from.ends.tangent_out[i]).abs();
            if turn > 0.0 {
                together = together.min(jumps.of(i) / turn);
            }
        }
        let v = if kinks == KINKS { (together * apart).sqrt() } else { together }.max(apart);
        for boundary in [first, newest] {
            let cap = &mut segments[boundary].cap;
            *cap = cap.lower(Cap::new(v, SpeedLimit::Curve));
        }
        if kinks == KINKS {
            return;
        }
    }
}

/// Whether the direction changes between two blocks.
fn is_kink(from: &Queued, to: &Queued) -> bool {
    from.ends
        .tangent_out
        .iter()
        .zip(to.ends.tangent_in.iter())
        .any(|(a, b)| (a - b).abs() > TANGENT)
}
