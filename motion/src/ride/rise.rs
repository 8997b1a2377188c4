//! The rise: as fast as the blocks allow, never reducing the speed.

use super::{Block, SLACK, is_hill};
use crate::profile::{Phase, RampShape};

/// Steps per stretch beyond which it is refused, plus as many per block: a crawl is no ride.
const MOST_STEPS: usize = 20_000;
/// Rounds of bisection of the acceleration in a step.
const ROUNDS: u32 = 10;
/// Steps that a sine-square ramp up is tried over first.
const LONG_STEPS: [f64; 3] = [8.0, 4.0, 2.0];

/// The blocks, the duration of a step and the shape of the ramps.
pub(super) struct Rise<'a> {
    pub(super) cells: &'a [Block],
    pub(super) dt: f64,
    pub(super) shape: RampShape,
}

impl Rise<'_> {
    /// Phases from `v0` with acceleration zero to the end; cut where a limit drops. `None`: a crawl.
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
            // as fast as allowed: to the end of the block
            if flat && here.v <= 0.0 {
                return None;
            }
            let to_end = || here.ramp(self.shape, 0.0, (cells[c].end - here.s) / here.v);
            let mut phase = step.unwrap_or_else(to_end);
            let mut end = phase.end();
            loop {
                let cell = &cells[c];
                if end.s < cell.end && !flat {
                    break;
                }
                // the boundary is crossed: cut if it, or what follows, is slower
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

    /// The next step, to the largest acceleration that leaves a way; `None`: no more speed in this block.
    fn step(&self, c: usize, here: &Phase) -> Option<Phase> {
        let Block { acc, jerks: [up, down, ..], .. } = self.cells[c];
        let (a, dt) = (here.a, self.dt);
        let to = |next: f64, t: f64| here.ramp(self.shape, (next - a) / t, t);
        let safe = |phase: &Phase| self.is_safe(c, phase, here.v);
        if self.shape == RampShape::Sin2 {
            for steps in LONG_STEPS {
                let t = (steps * dt).min((acc - a) / up);
                let phase = to(a + up * t, t);
                if t > dt && safe(&phase) {
                    return Some(phase);
                }
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
            // a creep towards the limit would never end
            Some(next) if a > 0.0 || next > 2e-3 * up * dt => Some(to(next, dt)),
            // the ramp down that the step before has been checked with
            _ if a <= 0.0 => None,
            _ if least > 0.0 && self.shape == RampShape::Trapez => Some(to(least, dt)),
            _ => Some(to(0.0, a / down)),
        }
    }

    /// True if a step, and the ramp to zero behind it, stay below the limits ahead of speed `v`. A limit below `v` cuts
    /// the rise and is none of its business.
    fn is_safe(&self, mut c: usize, step: &Phase, v: f64) -> bool {
        #[cfg(test)]
        crate::work::add();
        let mut phase = *step;
        loop {
            let end = phase.end();
            if end.s >= self.cells[c].end || end.v > self.cells[c].v * (1.0 + SLACK) {
                loop {
                    let cell = &self.cells[c];
                    if end.s < cell.end {
                        if end.v > cell.v * (1.0 + SLACK) {
                            return false;
                        }
                        break;
                    }
                    if cell.is_exceeded(&phase) {
                        return false;
                    }
                    let Some(behind) = self.cells.get(c + 1) else { return true };
                    let limit = cell.cap.min(behind.v);
                    if end.v > limit {
                        let here = phase.after(phase.time_at(cell.end));
                        if here.v > limit * (1.0 + SLACK) {
                            return is_drop(limit, v);
                        }
                    }
                    if phase.a.max(end.a) > behind.acc * (1.0 + SLACK) {
                        return false;
                    }
                    c += 1;
                }
            }
            if end.a <= 0.0 {
                return self.is_level(c, end.s, end.v, v);
            }
            let [_, down, ..] = self.cells[c].jerks;
            let whole = end.a / down;
            // the last part of the ramp is shorter than a step; sine-square ramps are not cut
            if whole < self.dt || self.shape == RampShape::Sin2 {
                return self.lands(c, &end.ramp(self.shape, -down, whole), v);
            }
            phase = end.ramp(self.shape, -down, self.dt);
        }
    }

    /// True if a speed reached at `s` in block `c` may be kept up to its end, or be braked from there, or is cut.
    fn is_level(&self, c: usize, s: f64, reached: f64, v: f64) -> bool {
        let cell = &self.cells[c];
        let Some(behind) = self.cells.get(c + 1) else { return true };
        let limit = cell.cap.min(behind.v);
        if reached <= limit * (1.0 + SLACK) || is_drop(limit, v) {
            return true;
        }
        let whole = cell.end - c.checked_sub(1).map_or(0.0, |b| self.cells[b].end);
        let Block { acc, dec, jerks: [.., j3, j4], .. } = *cell;
        if !is_hill(whole, limit, acc.min(dec), cell.least_jerk()) {
            return false;
        }
        let ramps = dec / j3 + dec / j4;
        let loss = reached - limit;
        let full = 0.5 * dec * ramps;
        let time =
            if loss >= full { loss / dec + 0.5 * ramps } else { (loss / full).sqrt() * ramps };
        0.5 * (reached + limit) * time <= cell.end - s
    }

    /// The last part of a ramp to zero acceleration.
    fn lands(&self, mut c: usize, phase: &Phase, v: f64) -> bool {
        let end = phase.end();
        loop {
            let cell = &self.cells[c];
            if end.s < cell.end {
                return end.v <= cell.v * (1.0 + SLACK) && self.is_level(c, end.s, end.v, v);
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
    /// True if a phase of a rise that goes on behind the block is too fast at its end.
    fn is_exceeded(&self, phase: &Phase) -> bool {
        let most = self.v * (1.0 + SLACK);
        phase.end().v > most && phase.after(phase.time_at(self.end)).v > most
    }
}

/// True if a limit is below the present speed: the fall towards it is none of the rise's business.
fn is_drop(limit: f64, v: f64) -> bool {
    limit < v * (1.0 - 10.0 * SLACK)
}
