//! The rise: as fast as the blocks permit, without ever reducing the speed.

use super::super::{Block, SLACK, is_drop, is_level};
use crate::profile::roots::enclosed_root;
use crate::profile::{FLAT_MM_S2, Phase, RampShape};

/// Number of steps per stretch, in addition to as many per block, beyond which a rise is refused as too slow.
const MOST_STEPS: usize = 20_000;
/// Accuracy of the acceleration after a step, relative to the interval in which it is searched.
const PRECISION: f64 = 1e-10;
/// Least gain of acceleration, relative to the largest one in a step, for which the ramp down is put off.
const LEAST_RISE: f64 = 2e-3;
/// Numbers of steps over which a sine-square ramp up is tried first.
const LONG_STEPS: [f64; 3] = [8.0, 4.0, 2.0];

/// The blocks, the duration of a step and the shape of the ramps.
pub(super) struct Rise<'a> {
    pub(super) cells: &'a [Block],
    pub(super) dt: f64,
}

impl Rise<'_> {
    /// Phases from `v0` with zero acceleration to the end, cut where a limit drops. `None` if the speed gets too low.
    pub(super) fn run(&self, v0: f64) -> Option<Vec<Phase>> {
        let cells = self.cells;
        let mut out = Vec::with_capacity(4 * cells.len());
        let (mut c, mut here) = (0, Phase::state(0.0, v0, 0.0));
        while c < cells.len() {
            if out.len() > MOST_STEPS + 8 * cells.len() {
                return None;
            }
            let step = self.step(c, &here);
            let flat = step.is_none();
            // as fast as permitted: to the end of the block
            if flat && here.v <= 0.0 {
                return None;
            }
            let to_end = || here.ramp(RampShape::Sin2, 0.0, (cells[c].end - here.s) / here.v);
            let mut phase = step.unwrap_or_else(to_end);
            let mut end = phase.end();
            loop {
                let cell = &cells[c];
                if end.s < cell.end && !flat {
                    break;
                }
                // the boundary is crossed: cut if it, or the next block, is slower
                let limit = cell.cap.min(cells.get(c + 1).map_or(f64::INFINITY, |n| n.v));
                let last = c + 1 == cells.len();
                if last || flat || end.v > limit || phase.v > limit {
                    let t = if flat { phase.t } else { phase.time_at(cell.end) };
                    let here = phase.after(t);
                    if last || flat || here.v > limit * (1.0 + 2.0 * SLACK) {
                        phase.t = t;
                        end = Phase::state(cell.end, here.v, here.a);
                        if here.v > limit {
                            (end.v, end.a) = (limit, 0.0);
                        }
                        c += 1;
                        break;
                    }
                }
                c += 1;
            }
            if phase.t > 0.0 {
                out.push(phase);
            }
            // after a ramp down to zero rounding remains
            let a = if end.a > FLAT_MM_S2 { end.a } else { 0.0 };
            here = Phase::state(end.s, end.v, a);
        }
        Some(out)
    }

    /// The next step, to the largest acceleration after which the limits can be kept; `None` if the speed cannot rise
    /// any more in this block.
    fn step(&self, c: usize, here: &Phase) -> Option<Phase> {
        let Block { acc, jerks: [up, down, ..], .. } = self.cells[c];
        let (a, dt) = (here.a, self.dt);
        let to = |next: f64, t: f64| here.ramp(RampShape::Sin2, (next - a) / t, t);
        let safe = |phase: &Phase| self.is_safe(c, phase, here.v);
        for steps in LONG_STEPS {
            let t = (steps * dt).min((acc - a) / up);
            let phase = to(a + up * t, t);
            if t > dt && safe(&phase) {
                return Some(phase);
            }
        }
        let least = (a - down * dt).max(0.0);
        let most = (a + up * dt).min(acc).max(least);
        if safe(&to(most, dt)) {
            return (most > 0.0 || a > 0.0).then(|| to(most, dt));
        }
        // approaching the limit in ever smaller steps would never end
        let first = least + LEAST_RISE * up * dt;
        if first >= most || !safe(&to(first, dt)) {
            // the ramp down that was checked with the previous step
            return (a > 0.0).then(|| to(0.0, a / down));
        }
        let room = |next| {
            let room = self.room(c, &to(next, dt), here.v);
            // a limit that is just reached is kept
            if room == 0.0 { f64::MIN_POSITIVE } else { room }
        };
        let (low, high) = ((first, room(first)), (most, room(most)));
        let (next, _) = enclosed_root(low, high, PRECISION, room);
        Some(to(next, dt))
    }

    /// Whether a step, and the ramp to zero after it, stay below the limits ahead that are not below speed `v`; a limit
    /// below `v` cuts the rise.
    fn is_safe(&self, c: usize, step: &Phase, v: f64) -> bool {
        self.room(c, step, v) >= 0.0
    }

    /// Room in mm/s that a step, and the ramp to zero after it, leave below the limits ahead that are not below speed
    /// `v`; a limit below `v` cuts the rise. Negative if one of them is exceeded.
    fn room(&self, mut c: usize, step: &Phase, v: f64) -> f64 {
        #[cfg(test)]
        crate::closed_forms::add();
        let end = step.end();
        let mut room = end.v;
        if end.s >= self.cells[c].end || end.v > self.cells[c].most() {
            loop {
                let cell = &self.cells[c];
                if end.s < cell.end {
                    room = room.min(cell.most() - end.v);
                    if room < 0.0 {
                        return room;
                    }
                    break;
                }
                room = room.min(cell.room_at_end(step));
                if room < 0.0 {
                    return room;
                }
                let Some(behind) = self.cells.get(c + 1) else { return room };
                let limit = cell.cap.min(behind.v);
                if end.v > limit {
                    let here = step.after(step.time_at(cell.end));
                    let left = limit * (1.0 + SLACK) - here.v;
                    if left < 0.0 {
                        return if is_drop(limit, v) { room } else { left };
                    }
                    room = room.min(left);
                }
                let excess = step.a.max(end.a) - behind.acc * (1.0 + SLACK);
                if excess > 0.0 {
                    return -excess * self.dt;
                }
                c += 1;
            }
        }
        let [_, down, ..] = self.cells[c].jerks;
        let ramp = end.ramp(RampShape::Sin2, -down, end.a.max(0.0) / down);
        room.min(self.landing(c, &ramp, v))
    }

    /// As [`Self::room`], for the last part of a ramp to zero acceleration.
    fn landing(&self, mut c: usize, ramp: &Phase, v: f64) -> f64 {
        let end = ramp.end();
        let mut room = end.v;
        loop {
            let cell = &self.cells[c];
            if end.s < cell.end {
                let left = cell.most() - end.v;
                let level = left < 0.0 || is_level(self.cells, c, end.s, end.v, v);
                return room.min(if level { left } else { -end.v });
            }
            room = room.min(cell.room_at_end(ramp));
            if room < 0.0 {
                return room;
            }
            let Some(behind) = self.cells.get(c + 1) else { return room };
            let limit = cell.cap.min(behind.v);
            if end.v > limit || ramp.a > behind.acc {
                let here = ramp.after(ramp.time_at(cell.end));
                let left = limit * (1.0 + SLACK) - here.v;
                if left < 0.0 {
                    return if is_drop(limit, v) { room } else { left };
                }
                room = room.min(left);
                let excess = here.a - behind.acc * (1.0 + SLACK);
                if excess > 0.0 {
                    return -excess * self.dt;
                }
            }
            c += 1;
        }
    }
}

impl Block {
    /// The largest speed inside.
    fn most(&self) -> f64 {
        self.v * (1.0 + SLACK)
    }

    /// Room in mm/s below the largest speed at the end, for a phase of a rise that continues after the block, or less.
    fn room_at_end(&self, phase: &Phase) -> f64 {
        let left = self.most() - phase.end().v;
        if left >= 0.0 { left } else { self.most() - phase.after(phase.time_at(self.end)).v }
    }
}
