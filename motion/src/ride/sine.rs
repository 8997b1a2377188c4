//! Rise, fall and their connection with sine-square ramps.
//!
//! A ramp has the shape of a sine square over the time that a constant jerk would take, and is never cut; the jerk is
//! therefore zero between any two ramps, and its peak is that of SIN2 (`pi/2 a/t`). The rise is built in steps of one
//! ramp each, with the largest acceleration from which the ramp down to zero still stays below every limit ahead. Rise
//! and fall are connected by the fastest third-order profile between a state before and one after, as close to each
//! other as the limits permit. Where none fits, or it would be very slow, both are planned again below a lower *hill*.
//!
//! Every connection is checked against every limit it passes.
//!
//! The speed is to be a continuous function of the limits: an acceleration, or the height of a hill, is found to rounding
//! and not from a row of trials, and what is compared has to differ by more than the tolerances of both sides. What
//! remains are decisions at thresholds that no form of a contour favours (how many steps a ramp takes, how far from the
//! crossing a connection begins).

mod crossing;
mod hill;
mod rise;

use super::{Block, Cell, SHORTEST_RAMP_S, joined, mirror, own, turned};
use crate::profile::Phase;
use crossing::lower_one;
use rise::Rise;

/// Steps per longest ramp.
const STEPS_PER_RAMP: f64 = 8.0;
/// Largest number of blocks, forward and backward, that a step is assumed to cover.
const REACH: usize = 64;

/// Relative difference of the times of both directions from which on one is faster: a contour that is its own mirror
/// image is driven in one of them.
const FASTER: f64 = 1e-7;

/// Reduces the jerk of every block to the smallest one within `reach_s`, as a ramp may extend over several blocks.
fn blocks(cells: &[Cell], ends: (f64, f64), reach_s: f64) -> Vec<Block> {
    let each = joined(own(cells), Some(ends));
    let mut out = each.clone();
    for (i, cell) in each.iter().enumerate() {
        let near = |k: &usize| each[k - 1].end <= cell.end + cell.v * reach_s;
        for k in (i + 1..each.len()).take(REACH).take_while(near) {
            for (far, j) in [(i, k), (k, i)] {
                for (mine, theirs) in out[far].jerks.iter_mut().zip(each[j].jerks) {
                    *mine = mine.min(theirs);
                }
            }
        }
    }
    out
}

/// The fastest speed found from `v0` to `v1`, with zero acceleration at both ends; `None` if there is none within the
/// limits.
pub(super) fn speed(cells: &[Cell], v0: f64, v1: f64) -> Option<Vec<Phase>> {
    let length = cells.last()?.end;
    let longest = cells.iter().flat_map(|c| c.rates.ramps).fold(SHORTEST_RAMP_S, f64::max);
    let dt = (longest / STEPS_PER_RAMP).max(SHORTEST_RAMP_S);
    let cells = &blocks(cells, (v0, v1), longest)[..];
    let mirrored = &mirror(cells)[..];
    let forward = Rise { cells, dt }.run(v0)?;
    let backward = Rise { cells: mirrored, dt }.run(v1)?;
    // joined from both ends, so that a reversed contour takes the same time
    let there = lower_one(cells, dt, forward.clone(), turned(&backward, length), v0);
    let back = lower_one(mirrored, dt, backward, turned(&forward, length), v1);
    let back = back.map(|out| turned(&out, length));
    let time = |list: &[Phase]| list.iter().map(|p| p.t).sum::<f64>();
    match (there, back) {
        (Some(there), Some(back)) if time(&back) < time(&there) * (1.0 - FASTER) => Some(back),
        (there, back) => there.or(back),
    }
}
