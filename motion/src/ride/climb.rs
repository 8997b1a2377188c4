//! The rise with constant jerk: its ramps begin and end exactly where the limits require, each block with its jerk.
//!
//! From a state the acceleration grows, or stays at its limit, as long as the ramp down to zero after it stays below
//! every limit ahead. The last such moment is found by bisection, in whose steps the ramp is only followed where the
//! outcome is not known ([`moment`]); from there the ramp down is followed to the limit that it touches, where the
//! next rise starts.

mod moment;

use super::{Block, SLACK, is_drop, is_level};
use crate::profile::{Phase, RampShape};

/// Number of phases per block, and in addition to that, beyond which a rise is refused.
const MOST_PHASES: [usize; 2] = [12, 20_000];
/// Bisection steps for the time of a phase.
const ROUNDS: u32 = 40;
/// Duration in s below which a phase is dropped as rounding.
const WORTH_S: f64 = 1e-7;

/// Number of phases of the rise that are searched backwards for a point from which a limit can be passed.
const MOST_BACK: usize = 64;

/// The limit ahead that a ramp down to zero touches.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Touch {
    /// The velocity inside a block: the acceleration has to reach zero.
    Inside,
    /// Velocity or acceleration at the end of this block.
    End(usize),
}

/// A rise being built.
pub(super) struct Climb<'a> {
    cells: &'a [Block],
    out: Vec<Phase>,
    /// Block of the present state.
    c: usize,
    here: Phase,
    /// Number of phases output up to the last point at which the speed was cut.
    base: usize,
    /// The least limit of the end of each block and of those after it.
    least: Vec<f64>,
}

/// Phases from `v0` with acceleration `a0` to the end, cut where a limit drops. `None` if the speed gets too low.
pub(super) fn climb(cells: &[Block], v0: f64, a0: f64) -> Option<Vec<Phase>> {
    climb_beyond(cells, (v0, a0), |_, _, _| false)
}

/// As [`climb`], up to a phase that is `beyond` what is needed: it receives the last phase, and the block and the speed after it. The
/// phases up to there are those of the whole rise.
pub(super) fn climb_beyond(
    cells: &[Block],
    (v0, a0): (f64, f64),
    mut beyond: impl FnMut(&Phase, usize, f64) -> bool,
) -> Option<Vec<Phase>> {
    let (out, here) = (Vec::with_capacity(4 * cells.len()), Phase::state(0.0, v0, a0));
    let mut climb = Climb { cells, out, c: 0, here, base: 0, least: least_ahead(cells) };
    climb.settle()?;
    while climb.c < cells.len() {
        if climb.out.len() > MOST_PHASES[0] * cells.len() + MOST_PHASES[1] {
            return None;
        }
        // a limit ahead lowers the rise from here on at most: this speed passes it without acceleration
        let is_final = climb.here.a == 0.0 && climb.here.v <= climb.least[climb.c];
        let last = climb.out.last().filter(|_| is_final);
        if last.is_some_and(|phase| beyond(phase, climb.c, climb.here.v)) {
            break;
        }
        climb.step()?;
    }
    Some(climb.out)
}

/// The least limit of the end of each block and of those after it.
fn least_ahead(cells: &[Block]) -> Vec<f64> {
    let mut least = vec![f64::INFINITY; cells.len()];
    for c in (1..cells.len()).rev() {
        least[c - 1] = least[c].min(cells[c - 1].cap).min(cells[c].v);
    }
    least
}

impl Climb<'_> {
    /// Ends a deceleration at the start; `None` if it comes to rest before that.
    fn settle(&mut self) -> Option<()> {
        while let Some(cell) = self.cells.get(self.c).filter(|_| self.here.a < 0.0) {
            let here = self.here;
            let up = cell.jerks[3];
            let mut ramp = here.ramp(RampShape::Trapez, up, -here.a / up);
            if ramp.lowest() < 0.0 {
                return None;
            }
            let whole = ramp.end().s >= cell.end;
            if whole {
                ramp.t = ramp.time_at(cell.end);
            }
            let end = ramp.end();
            self.out.push(ramp);
            self.here = Phase::state(end.s, end.v, if whole { end.a } else { 0.0 });
            if whole {
                self.here.s = cell.end;
                self.c += 1;
                let next = self.cells.get(self.c).map_or(f64::INFINITY, |n| n.v);
                let limit = cell.cap.min(next);
                if end.v > limit * (1.0 + SLACK) {
                    self.here = Phase::state(cell.end, limit, 0.0);
                    self.base = self.out.len();
                }
            }
        }
        Some(())
    }

    /// The next piece of the rise.
    fn step(&mut self) -> Option<()> {
        let cells = self.cells;
        let (c, here) = (self.c, self.here);
        let cell = &cells[c];
        let v_ref = here.v;
        let left = cell.end - here.s;
        let mut phase = if here.a < cell.acc * (1.0 - SLACK) {
            here.ramp(RampShape::Trapez, cell.jerks[0], (cell.acc - here.a) / cell.jerks[0])
        } else {
            let t = 2.0 * left / (here.v + (here.v * here.v + 2.0 * here.a * left).sqrt());
            here.ramp(RampShape::Trapez, 0.0, t)
        };
        if phase.j == 0.0 || phase.end().s >= cell.end {
            phase.t = if phase.j == 0.0 { phase.t } else { phase.time_at(cell.end) };
            match self.enter(c, &phase.end(), v_ref) {
                Ok(()) => {
                    self.take(phase, true);
                    return Some(());
                }
                Err(touch) => return self.bend(&phase, touch, v_ref),
            }
        }
        match self.lands(c, phase.end(), v_ref) {
            Ok(()) => {
                self.take(phase, false);
                Some(())
            }
            Err(touch) => self.bend(&phase, touch, v_ref),
        }
    }

    /// Outputs a phase; `whole`: it ends at the end of the block.
    fn take(&mut self, phase: Phase, whole: bool) {
        let end = phase.end();
        self.here = Phase::state(end.s, end.v, end.a.max(0.0));
        if phase.t > 0.0 {
            self.out.push(phase);
        }
        if whole {
            let cell = &self.cells[self.c];
            self.here.s = cell.end;
            self.c += 1;
            let Some(next) = self.cells.get(self.c) else { return };
            let limit = cell.cap.min(next.v);
            if self.here.v > limit * (1.0 + SLACK) && !self.lower(self.c - 1, limit) {
                self.here.a = 0.0;
                self.base = self.out.len();
            }
            self.here.v = self.here.v.min(limit);
            self.here.a = self.here.a.min(next.acc);
        }
    }

    /// Leaves the rise early enough to pass the end of block `k`, which it would exceed, at the limit and with the
    /// acceleration that remains there. False, and unchanged, if none remains: the fall from the limit then leaves room
    /// above it.
    fn lower(&mut self, k: usize, limit: f64) -> bool {
        // a ramp down to zero acceleration never reduces the speed, so that most phases need not be followed
        let may = |from: &Phase| from.v <= limit * (1.0 + SLACK);
        let Some(i) = (self.base..self.out.len()).rev().take(MOST_BACK).find(|i| {
            let from = &self.out[*i];
            may(from) && self.passes(from, k).v <= limit
        }) else {
            return false;
        };
        let phase = self.out[i];
        let (mut low, mut high) = (0.0, phase.t);
        for _ in 0..ROUNDS {
            let mid = 0.5 * (low + high);
            if self.passes(&phase.after(mid), k).v <= limit { low = mid } else { high = mid }
        }
        let there = self.passes(&phase.after(low), k);
        if there.a <= 0.0 {
            return false;
        }
        self.out.truncate(i);
        if low > 0.0 {
            self.out.push(phase.until(low));
        }
        let mut at = phase.after(low);
        for c in self.block_at(at.s)..=k {
            let (ramp, flat) = self.ramp_in(c, &at);
            at = flat.end();
            self.out.extend([ramp, flat].into_iter().filter(|p| p.t > 0.0));
        }
        self.here = Phase::state(self.cells[k].end, at.v, at.a);
        true
    }

    fn block_at(&self, s: f64) -> usize {
        self.cells.partition_point(|c| c.end <= s)
    }

    /// The state at the end of block `k` on a ramp down to zero from a state.
    fn passes(&self, from: &Phase, k: usize) -> Phase {
        let mut at = Phase::state(from.s, from.v, from.a);
        for c in self.block_at(at.s)..=k {
            at = self.ramp_in(c, &at).1.end();
        }
        at
    }

    /// A ramp down to zero and the phase after it, up to the end of block `c`.
    fn ramp_in(&self, c: usize, at: &Phase) -> (Phase, Phase) {
        let cell = &self.cells[c];
        let down = cell.jerks[1];
        let mut ramp = at.ramp(RampShape::Trapez, -down, at.a.max(0.0) / down);
        let end = ramp.end();
        if end.s >= cell.end {
            ramp.t = ramp.time_at(cell.end);
            let end = ramp.end();
            return (ramp, Phase::state(cell.end, end.v, end.a));
        }
        let flat = Phase::state(end.s, end.v, 0.0).ramp(
            RampShape::Trapez,
            0.0,
            (cell.end - end.s) / end.v,
        );
        (ramp, flat)
    }

    /// The part of a phase after which the limits can still be kept, and then the ramp down to the limit that it
    /// touches.
    fn bend(&mut self, phase: &Phase, mut touch: Touch, v_ref: f64) -> Option<()> {
        let (mut low, mut high) = (0.0, phase.t);
        let (within, beyond) = self.around(phase, touch, v_ref);
        for _ in 0..ROUNDS {
            if high - low <= 1e-3 * WORTH_S {
                break;
            }
            let mid = 0.5 * (low + high);
            if mid <= within {
                low = mid;
            } else if mid >= beyond {
                high = mid;
            } else {
                match self.lands(self.c, phase.after(mid), v_ref) {
                    Ok(()) => low = mid,
                    Err(other) => (high, touch) = (mid, other),
                }
            }
        }
        if low > WORTH_S {
            self.take(phase.until(low), false);
        }
        let until = match touch {
            Touch::Inside => usize::MAX,
            Touch::End(c) => c,
        };
        // ramp down to the point of contact
        loop {
            let (c, here) = (self.c, self.here);
            if here.a <= 0.0 {
                break;
            }
            let Some(cell) = self.cells.get(c) else { return Some(()) };
            let down = cell.jerks[1];
            let mut ramp = here.ramp(RampShape::Trapez, -down, here.a / down);
            let whole = ramp.end().s >= cell.end;
            if whole {
                ramp.t = ramp.time_at(cell.end);
            }
            self.take(ramp, whole);
            if !whole {
                self.here.a = 0.0;
            } else if c >= until {
                return Some(());
            }
        }
        // as fast as permitted: to the end of the block
        let Some(cell) = self.cells.get(self.c) else { return Some(()) };
        if low <= WORTH_S || until != usize::MAX || self.here.v >= cell.v * (1.0 - SLACK) {
            if self.here.v <= 0.0 {
                return None;
            }
            let flat = self.here.ramp(
                RampShape::Trapez,
                0.0,
                ((cell.end - self.here.s) / self.here.v).max(0.0),
            );
            self.take(flat, true);
        }
        Some(())
    }

    /// The limit touched by a ramp down to zero that begins at the end of block `c`.
    fn enter(&self, c: usize, end: &Phase, v_ref: f64) -> Result<(), Touch> {
        let cell = &self.cells[c];
        if self.crosses(c, end, v_ref)? {
            self.lands(c + 1, Phase::state(cell.end, end.v, end.a), v_ref)
        } else {
            Ok(())
        }
    }

    /// The limit touched by a ramp with the state `end` at the end of block `c`; true if it continues into the next
    /// block.
    fn crosses(&self, c: usize, end: &Phase, v_ref: f64) -> Result<bool, Touch> {
        let cell = &self.cells[c];
        if end.v > cell.v * (1.0 + SLACK) {
            return Err(Touch::Inside);
        }
        let Some(next) = self.cells.get(c + 1) else { return Ok(false) };
        let limit = cell.cap.min(next.v);
        if end.v > limit * (1.0 + SLACK) {
            return if is_drop(limit, v_ref) { Ok(false) } else { Err(Touch::End(c)) };
        }
        if end.a > next.acc * (1.0 + SLACK) {
            return Err(Touch::End(c));
        }
        Ok(true)
    }

    /// The limit touched by a ramp down to zero that begins at a state in block `c`.
    fn lands(&self, mut c: usize, mut at: Phase, v_ref: f64) -> Result<(), Touch> {
        #[cfg(test)]
        crate::closed_forms::add();
        loop {
            let cell = &self.cells[c];
            let down = cell.jerks[1];
            let ramp = at.ramp(RampShape::Trapez, -down, at.a.max(0.0) / down);
            let end = ramp.end();
            if end.s < cell.end {
                if end.v > cell.v * (1.0 + SLACK) {
                    return Err(Touch::Inside);
                }
                let level = is_level(self.cells, c, end.s, end.v, v_ref);
                return if level { Ok(()) } else { Err(Touch::End(c)) };
            }
            let end = ramp.after(ramp.time_at(cell.end));
            if !self.crosses(c, &end, v_ref)? {
                return Ok(());
            }
            (c, at) = (c + 1, Phase::state(cell.end, end.v, end.a));
        }
    }
}
