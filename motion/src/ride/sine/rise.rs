//! The rise: as fast as the blocks permit, without ever reducing the speed.

use super::super::{Block, SLACK, is_drop, is_level};
use crate::profile::{Phase, RampShape};

/// Number of steps per stretch, in addition to as many per block, beyond which a rise is refused as too slow.
const MOST_STEPS: usize = 20_000;
/// Bisection steps for the acceleration in a step.
const ROUNDS: u32 = 10;
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
                    if last || flat || here.v > limit * (1.0 + SLACK) {
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
            here = Phase::state(end.s, end.v, end.a.max(0.0));
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
        let (mut low, mut high) = (least, most);
        let mut best = None;
        for _ in 0..ROUNDS {
            let mid = 0.5 * (low + high);
            if safe(&to(mid, dt)) {
                low = mid;
                best = Some(mid);
            } else {
                high = mid;
            }
        }
        match best {
            // approaching the limit in ever smaller steps would never end
            Some(next) if a > 0.0 || next > 2e-3 * up * dt => Some(to(next, dt)),
            // the ramp down that was checked with the previous step
            _ if a <= 0.0 => None,
            _ => Some(to(0.0, a / down)),
        }
    }

    /// Whether a step, and the ramp to zero after it, stay below the limits ahead that are not below speed `v`; a limit
    /// below `v` cuts the rise.
    fn is_safe(&self, mut c: usize, step: &Phase, v: f64) -> bool {
        #[cfg(test)]
        crate::closed_forms::add();
        let end = step.end();
        if end.s >= self.cells[c].end || end.v > self.cells[c].v * (1.0 + SLACK) {
            loop {
                let cell = &self.cells[c];
                if end.s < cell.end {
                    if end.v > cell.v * (1.0 + SLACK) {
                        return false;
                    }
                    break;
                }
                if cell.is_exceeded(step) {
                    return false;
                }
                let Some(behind) = self.cells.get(c + 1) else { return true };
                let limit = cell.cap.min(behind.v);
                if end.v > limit {
                    let here = step.after(step.time_at(cell.end));
                    if here.v > limit * (1.0 + SLACK) {
                        return is_drop(limit, v);
                    }
                }
                if step.a.max(end.a) > behind.acc * (1.0 + SLACK) {
                    return false;
                }
                c += 1;
            }
        }
        if end.a <= 0.0 {
            return is_level(self.cells, c, end.s, end.v, v);
        }
        let [_, down, ..] = self.cells[c].jerks;
        self.lands(c, &end.ramp(RampShape::Sin2, -down, end.a / down), v)
    }

    /// Whether the last part of a ramp to zero acceleration stays below these limits.
    fn lands(&self, mut c: usize, phase: &Phase, v: f64) -> bool {
        let end = phase.end();
        loop {
            let cell = &self.cells[c];
            if end.s < cell.end {
                return end.v <= cell.v * (1.0 + SLACK) && is_level(self.cells, c, end.s, end.v, v);
            }
            if cell.is_exceeded(phase) {
                return false;
            }
            let Some(behind) = self.cells.get(c + 1) else { return true };
            let limit = cell.cap.min(behind.v);
            if end.v > limit || phase.a > behind.acc {
                let here = phase.after(phase.time_at(cell.end));
                if here.v > limit * (1.0 + SLACK) {
                    return is_drop(limit, v);
                }
                if here.a > behind.acc * (1.0 + SLACK) {
                    return false;
                }
            }
            c += 1;
        }
    }
}

impl Block {
    /// Whether a phase of a rise that continues after the block is too fast at its end.
    fn is_exceeded(&self, phase: &Phase) -> bool {
        let most = self.v * (1.0 + SLACK);
        phase.end().v > most && phase.after(phase.time_at(self.end)).v > most
    }
}
