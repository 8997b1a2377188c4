//! The rise: as fast as the blocks allow, never reducing the speed.

use super::{Block, SLACK, is_hill};
use crate::profile::Phase;

/// Steps per stretch beyond which it is refused, plus as many per block: a crawl is no ride.
const MOST_STEPS: usize = 20_000;
/// Rounds of bisection of the acceleration in a step.
const ROUNDS: u32 = 10;

/// The blocks and the duration of a step.
pub(super) struct Rise<'a> {
    pub(super) cells: &'a [Block],
    pub(super) dt: f64,
}

impl Rise<'_> {
    /// Phases from `v0` with acceleration zero to the end; cut where a limit drops. `None`: a crawl.
    pub(super) fn run(&self, v0: f64) -> Option<Vec<Phase>> {
        let cells = self.cells;
        let mut out = Vec::with_capacity(4 * cells.len());
        let (mut c, mut s, mut v, mut a) = (0, 0.0, v0, 0.0);
        while c < cells.len() {
            if out.len() > MOST_STEPS + 8 * cells.len() {
                return None;
            }
            let (dt, next) = self.step(c, s, v, a);
            let mut phase = Phase { s, v, a, j: (next - a) / dt, t: dt };
            if next <= 0.0 && a <= 0.0 {
                // as fast as allowed: to the end of the block
                if v <= 0.0 {
                    return None;
                }
                phase = Phase { j: 0.0, t: (cells[c].end - s) / v, ..phase };
            }
            let mut end = phase.end();
            let flat = phase.j == 0.0 && a <= 0.0;
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
                        end = Phase { s: cell.end, ..here };
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
            (s, v, a) = (end.s, end.v, end.a.max(0.0));
        }
        Some(out)
    }

    /// Duration of the next step and the largest acceleration at its end that leaves a way.
    fn step(&self, c: usize, s: f64, v: f64, a: f64) -> (f64, f64) {
        let Block { acc, jerks: [up, down, ..], .. } = self.cells[c];
        let least = (a - down * self.dt).max(0.0);
        let most = (a + up * self.dt).min(acc).max(least);
        if self.is_safe(c, s, v, a, most) {
            return (self.dt, most);
        }
        let (mut low, mut high) = (least, most);
        let mut best = None;
        for _ in 0..ROUNDS {
            let mid = 0.5 * (low + high);
            if self.is_safe(c, s, v, a, mid) {
                low = mid;
                best = Some(mid);
            } else {
                high = mid;
            }
        }
        match best {
            // a creep towards the limit would never end
            Some(next) if a > 0.0 || next > 2e-3 * up * self.dt => (self.dt, next),
            // the ramp down that the step before has been checked with
            _ => (if least > 0.0 { self.dt } else { a / down }, least),
        }
    }

    /// True if the step to acceleration `next`, and the ramp to zero behind it, stay below the limits ahead. A limit
    /// below the present speed cuts the rise and is none of its business.
    fn is_safe(&self, mut c: usize, s: f64, v: f64, a: f64, next: f64) -> bool {
        #[cfg(test)]
        crate::work::add();
        let (mut phase, mut next) = (Phase { s, v, a, j: 0.0, t: self.dt }, next);
        loop {
            phase.j = (next - phase.a) / self.dt;
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
                    let Some(behind) = self.cells.get(c + 1) else { return true };
                    let limit = cell.cap.min(behind.v);
                    if end.v > limit {
                        let here = phase.after(phase.time_at(cell.end));
                        if here.v > limit * (1.0 + SLACK) {
                            return is_drop(limit, v);
                        }
                    }
                    if phase.a.max(next) > behind.acc * (1.0 + SLACK) {
                        return false;
                    }
                    c += 1;
                }
            }
            if next <= 0.0 {
                return self.is_level(c, end.s, end.v, v);
            }
            let [_, down, ..] = self.cells[c].jerks;
            phase = Phase { t: self.dt, ..end };
            // the last part of the ramp is shorter than a step
            if next < down * self.dt {
                phase.t = next / down;
                phase.j = -down;
                return self.lands(c, &phase, v);
            }
            next -= down * self.dt;
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
            let Some(behind) = self.cells.get(c + 1) else { return true };
            let limit = cell.cap.min(behind.v);
            if end.v > limit && phase.after(phase.time_at(cell.end)).v > limit * (1.0 + SLACK) {
                return is_drop(limit, v);
            }
            c += 1;
        }
    }
}

/// True if a limit is below the present speed: the fall towards it is none of the rise's business.
fn is_drop(limit: f64, v: f64) -> bool {
    limit < v * (1.0 - 10.0 * SLACK)
}
