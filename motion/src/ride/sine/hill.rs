//! One hill of the speed: up to a height at which the acceleration is zero, and down from it.
//!
//! A sine-square ramp has to be completed, so the rise may have no state from which the acceleration can still end
//! below the fall; a connection would then follow the lowest limit. Here rise and fall are planned again below a
//! height, the highest one at which they meet; the lower the height, the more room between them.

use super::super::{Block, CUT, mirror};
use super::rise::Rise;
use crate::profile::Phase;

/// Accuracy of the height, relative to it.
const PRECISION: f64 = 1e-10;
/// Largest number of heights: a halving every other time gets there.
const ROUNDS: u32 = 80;
/// Share of the interval of heights to which a step has to reduce it; otherwise it is halved next.
const ENOUGH: f64 = 0.6;
/// Relative difference of the speeds of rise and fall at their height, since a rise ends just below its limit.
const LEVEL: f64 = 0.02;

/// A part of a stretch with the states at its ends, both with zero acceleration.
pub(super) struct Hill<'a> {
    pub(super) cells: &'a [Block],
    pub(super) dt: f64,
    pub(super) from: Phase,
    pub(super) to: Phase,
}

/// A hill below some height, if there is one, and the distance in mm between the points at which rise and fall reach
/// it; NaN if one of them does not.
struct Try {
    phases: Option<Vec<Phase>>,
    room_mm: f64,
}

impl Hill<'_> {
    /// The phases from one end to the other; `None` if not even the lowest height fits. `between` connects two states.
    pub(super) fn highest(
        &self,
        between: impl Fn(&Phase, &Phase) -> Option<Vec<Phase>>,
    ) -> Option<Vec<Phase>> {
        let cells = self.part()?;
        let below = |height| self.below(&cells, height, &between);
        let mut low = self.from.v.max(self.to.v);
        let Try { phases, room_mm } = below(low);
        let mut best = phases?;
        let mut high = cells.iter().map(|c| c.v).fold(0.0, f64::max);
        let mut rooms = (room_mm, f64::NAN);
        let mut width = f64::INFINITY;
        for _ in 0..ROUNDS {
            if high - low <= PRECISION * high {
                break;
            }
            // where the room ends, as long as that halves the interval
            let falsi = low + (high - low) * rooms.0 / (rooms.0 - rooms.1);
            let halves = high - low <= ENOUGH * width;
            width = high - low;
            let edge = 0.1 * PRECISION * high;
            let next = if halves && rooms.1 < 0.0 { falsi } else { 0.5 * (low + high) };
            let next = next.clamp(low + edge, high - edge);
            let Try { phases, room_mm } = below(next);
            if let Some(found) = phases {
                (low, best, rooms.0) = (next, found, room_mm);
            } else {
                (high, rooms.1) = (next, room_mm);
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
    ) -> Try {
        let Some([(mut phases, top), (down, far)]) = self.sides(cells, height) else {
            return Try { phases: None, room_mm: f64::NAN };
        };
        let (start, length) = (self.from.s, self.to.s - self.from.s);
        let room_mm = far.s - top.s;
        let connection = (room_mm >= 0.0).then(|| between(&top, &far)).flatten();
        let phases = connection.map(|connection| {
            phases.extend(connection);
            phases.extend(down.iter().rev().map(|p| {
                let mut p = p.reversed(length);
                p.s += start;
                p
            }));
            phases
        });
        Try { phases, room_mm }
    }

    /// The rise below a height, at its place, and the fall, from its end, each with the state at the height.
    fn sides(&self, cells: &[Block], height: f64) -> Option<[(Vec<Phase>, Phase); 2]> {
        let cells: Vec<Block> = cells.iter().map(|c| Block { v: c.v.min(height), ..*c }).collect();
        let dt = self.dt;
        let up = Rise { cells: &cells, dt }.run(self.from.v)?;
        let down = Rise { cells: &mirror(&cells), dt }.run(self.to.v)?;
        let (mut up, top) = climb(up, self.from.v, height)?;
        let (down, far) = climb(down, self.to.v, height)?;
        for phase in &mut up {
            phase.s += self.from.s;
        }
        let top = Phase::state(top.s + self.from.s, top.v, 0.0);
        let far = Phase::state(self.to.s - far.s, far.v, 0.0);
        Some([(up, top), (down, far)])
    }
}

/// The phases of a rise from speed `v` up to where it stays at the height, and its state there; `None` if it does not
/// reach the height, or only after a limit that cuts it.
fn climb(mut rise: Vec<Phase>, mut v: f64, height: f64) -> Option<(Vec<Phase>, Phase)> {
    let stays = |p: &Phase| p.a.abs() <= 1e-9 && p.j.abs() <= 1e-9;
    let level = rise.iter().position(|p| stays(p) && p.v >= height * (1.0 - LEVEL))?;
    for phase in &rise[..=level] {
        if phase.v < v * (1.0 - CUT) {
            return None;
        }
        v = phase.end().v;
    }
    let top = Phase::state(rise[level].s, rise[level].v, 0.0);
    rise.truncate(level);
    Some((rise, top))
}
