//! One hill of the speed: up to a height at which the acceleration is zero, and down from it.
//!
//! A sine-square ramp has to be completed, so the rise may have no state from which the acceleration can still end
//! below the fall; a connection would then follow the lowest limit. Here rise and fall are planned again below a
//! height, the highest one at which they meet; the lower the height, the more room between them.

use super::super::{Block, SLACK, mirror};
use super::rise::Rise;
use crate::profile::Phase;

/// Bisection steps for the height.
const ROUNDS: u32 = 12;
/// Relative difference of the speeds of rise and fall at their height, since a rise ends just below its limit.
const LEVEL: f64 = 0.02;

/// A part of a stretch with the states at its ends, both with zero acceleration.
pub(super) struct Hill<'a> {
    pub(super) cells: &'a [Block],
    pub(super) dt: f64,
    pub(super) from: Phase,
    pub(super) to: Phase,
}

impl Hill<'_> {
    /// The phases from one end to the other; `None` if not even the lowest height fits. `between` connects two states.
    pub(super) fn highest(
        &self,
        between: impl Fn(&Phase, &Phase) -> Option<Vec<Phase>>,
    ) -> Option<Vec<Phase>> {
        let cells = self.part()?;
        let mut low = self.from.v.max(self.to.v);
        let mut best = self.below(&cells, low, &between)?;
        let mut high = cells.iter().map(|c| c.v).fold(0.0, f64::max);
        for _ in 0..ROUNDS {
            let mid = 0.5 * (low + high);
            if let Some(found) = self.below(&cells, mid, &between) {
                (low, best) = (mid, found);
            } else {
                high = mid;
            }
        }
        Some(best)
    }

    /// The blocks between the ends, as a separate stretch.
    fn part(&self) -> Option<Vec<Block>> {
        let (start, end) = (self.from.s, self.to.s);
        let first = self.cells.partition_point(|c| c.end <= start * (1.0 + 1e-12));
        let last = self.cells.partition_point(|c| c.end < end * (1.0 - 1e-12));
        let cells = self.cells.get(first..=last)?;
        let mut out: Vec<Block> =
            cells.iter().map(|c| Block { end: c.end - start, ..*c }).collect();
        let behind = out.last_mut()?;
        (behind.end, behind.cap) = (end - start, f64::INFINITY);
        Some(out)
    }

    /// The hill below a height.
    fn below(
        &self,
        cells: &[Block],
        height: f64,
        between: impl Fn(&Phase, &Phase) -> Option<Vec<Phase>>,
    ) -> Option<Vec<Phase>> {
        let (start, length) = (self.from.s, self.to.s - self.from.s);
        let cells: Vec<Block> = cells.iter().map(|c| Block { v: c.v.min(height), ..*c }).collect();
        let dt = self.dt;
        let up = Rise { cells: &cells, dt }.run(self.from.v)?;
        let down = Rise { cells: &mirror(&cells), dt }.run(self.to.v)?;
        let (mut out, top) = climb(up, self.from.v, height)?;
        let (down, far) = climb(down, self.to.v, height)?;
        for phase in &mut out {
            phase.s += start;
        }
        let top = Phase::state(top.s + start, top.v, 0.0);
        let far = Phase::state(self.to.s - far.s, far.v, 0.0);
        if far.s < top.s {
            return None;
        }
        out.extend(between(&top, &far)?);
        out.extend(down.iter().rev().map(|p| {
            let mut p = p.reversed(length);
            p.s += start;
            p
        }));
        Some(out)
    }
}

/// The phases of a rise from speed `v` up to where it stays at the height, and its state there; `None` if it does not
/// reach the height, or only after a limit that cuts it.
fn climb(mut rise: Vec<Phase>, mut v: f64, height: f64) -> Option<(Vec<Phase>, Phase)> {
    let stays = |p: &Phase| p.a.abs() <= 1e-9 && p.j.abs() <= 1e-9;
    let level = rise.iter().position(|p| stays(p) && p.v >= height * (1.0 - LEVEL))?;
    for phase in &rise[..=level] {
        if phase.v < v * (1.0 - SLACK) {
            return None;
        }
        v = phase.end().v;
    }
    let top = Phase::state(rise[level].s, rise[level].v, 0.0);
    rise.truncate(level);
    Some((rise, top))
}
