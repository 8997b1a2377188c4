//! The lower of rise and fall, with a connection where one changes to the other.

use super::super::{Block, CUT, SLACK};
use super::STEPS_PER_RAMP;
use super::hill::Hill;
use crate::profile::{FLAT_MM_S2, MotionState, Phase, RampShape, ThirdOrderLimits};

/// Relative excess of the rise over the fall from which on they cross; both may miss a limit that they follow by less.
const CROSSING: f64 = 1e-3;
/// Relative excess over a limit that a connection may have: it begins and ends at speeds that keep a limit up to
/// [`SLACK`], and is planned for half of this excess.
const OVER: f64 = 4.0 * SLACK;
/// Widths, in phases on either side, with which a connection is tried.
const WIDTHS: [usize; 16] = [0, 1, 2, 3, 4, 6, 8, 11, 15, 20, 27, 36, 48, 64, 96, 128];
/// Widths above this one are tried on both sides or on one side alone: connections of other widths are not faster in
/// random contours, and a search without success takes all of them.
const WIDE: usize = 8;
/// Shares of the jerk that are tried if there is no connection with the full jerk: a sine-square ramp shorter than one
/// of the rise is ahead of it at first.
const GENTLER: [f64; 4] = [0.7, 0.5, 0.35, 0.25];
/// Rounds in which the length of a connection with sine-square ramps is adjusted.
const ROUNDS: u32 = 12;
/// Length in mm by which a connection may miss its end, as rounding.
const MISS_MM: f64 = 1e-11;

/// The speed from `v0` along rise and fall; `None` if no connection fits.
pub(super) fn lower_one(
    cells: &[Block],
    dt: f64,
    rise: Vec<Phase>,
    fall: Vec<Phase>,
    v0: f64,
) -> Option<Vec<Phase>> {
    let mut join = Join { cells, rise, fall, out: Vec::new(), dt, base: 0 };
    join.run(v0)?;
    Some(join.out)
}

/// Number of output phases that are kept before a connection, its phases, and where it ends on the fall.
type Connection = (usize, Vec<Phase>, usize);

/// Limits of a connection.
#[derive(Clone, Copy)]
struct Way {
    /// Whether it may reach the highest limit of the blocks it passes; otherwise it stays below the lowest one.
    free: bool,
    /// Share of the jerk.
    jerk: f64,
}

struct Join<'a> {
    cells: &'a [Block],
    rise: Vec<Phase>,
    fall: Vec<Phase>,
    out: Vec<Phase>,
    dt: f64,
    /// Number of phases output up to the last point at which both are cut.
    base: usize,
}

impl Join<'_> {
    fn run(&mut self, v0: f64) -> Option<()> {
        let length = self.cells.last()?.end;
        // the block in which the rise next exceeds the fall; inside a block between two limits both may bulge
        let (mut r, mut c) = (0, 0);
        for _ in 0..=4 * self.cells.len() {
            while let Some(cell) = self.cells.get(c) {
                let rise = speed_at(&self.rise, cell.end, length);
                let limit = cell.cap.min(self.cells.get(c + 1).map_or(f64::INFINITY, |n| n.v));
                let fall = speed_at(&self.fall, cell.end, length);
                if rise > fall * (1.0 + CROSSING) || rise > limit * (1.0 + 2.0 * SLACK) {
                    break;
                }
                c += 1;
            }
            // follow the rise up to that point
            let quiet = c.checked_sub(1).map_or(0.0, |c| self.cells[c].end) * (1.0 - 1e-12);
            while let Some(next) = self.rise.get(r) {
                let end = next.end();
                let crosses = || {
                    c < self.cells.len()
                        && end.v > speed_at(&self.fall, end.s, length) * (1.0 + CUT)
                };
                if end.s > quiet && crosses() {
                    break;
                }
                self.out.push(*next);
                r += 1;
            }
            let here = self.out.last().map_or(Phase::state(0.0, v0, 0.0), Phase::end);
            let (to, cut) = self.connect(here, v0)?;
            // follow the fall until it is cut
            self.out.extend_from_slice(&self.fall[to..cut]);
            self.base = self.out.len();
            if cut == self.fall.len() {
                return Some(());
            }
            // both have to be cut at the same point
            let at = self.fall[cut - 1].end();
            r = self.rise.partition_point(|p| p.s < at.s - 1e-12 * length);
            c = self.cells.partition_point(|cell| cell.end <= at.s + 1e-12 * length);
            let next = self.rise.get(r)?;
            if (next.v - at.v).abs() > 1e-6 * at.v + 1e-9 || next.a > 1e-6 {
                return None;
            }
        }
        None
    }

    /// Replaces the end of the output by a connection to the fall; returns the range of phases of the fall after it, up
    /// to its cut.
    fn connect(&mut self, here: Phase, v0: f64) -> Option<(usize, usize)> {
        let slack = 1e-12 * self.cells.last()?.end;
        let ahead = self.fall.partition_point(|p| p.s <= here.s + slack).max(1);
        let is_cut = |k: usize| {
            let (before, behind) = (self.fall[k - 1].end(), &self.fall[k]);
            behind.v > before.v * (1.0 + CUT) + 1e-12
        };
        let cut = (ahead..self.fall.len()).find(|k| is_cut(*k)).unwrap_or(self.fall.len());
        let loss = |(keep, phases, to): &Connection| {
            time(phases) - time(&self.out[*keep..]) - time(&self.fall[ahead..*to])
        };
        let closest = |way: Way| self.closest(ahead, cut, v0, way);
        let first = closest(Way { free: true, jerk: 1.0 });
        // it rounds off the peak, which costs less than the longest ramp
        let is_good = |found: &Connection| loss(found) <= STEPS_PER_RAMP * self.dt;
        let best = if first.as_ref().is_some_and(is_good) {
            first
        } else {
            [first, self.hill(cut, v0)]
                .into_iter()
                .flatten()
                .min_by(|a, b| loss(a).total_cmp(&loss(b)))
                .or_else(|| GENTLER.into_iter().find_map(|jerk| closest(Way { free: true, jerk })))
                .or_else(|| closest(Way { free: false, jerk: 1.0 }))
        };
        let (keep, phases, to) = best?;
        self.out.truncate(keep);
        self.out.extend(phases);
        Some((to, cut))
    }

    /// The closest possible connection, symmetric widths first.
    fn closest(&self, ahead: usize, cut: usize, v0: f64, way: Way) -> Option<Connection> {
        for width in WIDTHS {
            let less = WIDTHS.into_iter().take_while(|w| *w < width);
            let other = less.filter(|w| width <= WIDE || *w == 0);
            let pairs = [(width, width)].into_iter();
            for (back, ahead_by) in pairs.chain(other.flat_map(|w| [(w, width), (width, w)])) {
                if back > self.out.len() && back > 1 && self.out.len() < back / 2 {
                    continue;
                }
                let keep = self.out.len() - back.min(self.out.len());
                let from = match self.out.get(keep) {
                    Some(p) => Phase::state(p.s, p.v, p.a),
                    None => self.out.last().map_or(Phase::state(0.0, v0, 0.0), Phase::end),
                };
                let to = (ahead + ahead_by).min(cut);
                let target = if to < cut { self.fall[to] } else { self.fall[cut - 1].end() };
                if let Some(phases) = self.between(&from, &target, way) {
                    return Some((keep, phases, to));
                }
            }
        }
        None
    }

    /// As [`Self::closest`], with the hill from the last cut to the next one planned again.
    fn hill(&self, cut: usize, v0: f64) -> Option<Connection> {
        let last = self.base.checked_sub(1).and_then(|last| self.out.get(last));
        let hill = Hill {
            cells: self.cells,
            dt: self.dt,
            from: last.map_or(Phase::state(0.0, v0, 0.0), Phase::end),
            to: self.fall[cut - 1].end(),
        };
        let between = |from: &Phase, to: &Phase| {
            [true, false]
                .into_iter()
                .find_map(|free| self.between(from, to, Way { free, jerk: 1.0 }))
        };
        Some((self.base, hill.highest(between)?, cut))
    }

    /// The fastest third-order profile between two states, if it is within every limit.
    fn between(&self, from: &Phase, to: &Phase, way: Way) -> Option<Vec<Phase>> {
        #[cfg(test)]
        crate::closed_forms::add();
        if coincide(from, to) {
            return Some(Vec::new());
        }
        if to.s <= from.s {
            return None;
        }
        let first = self.cells.partition_point(|c| c.end <= from.s).min(self.cells.len() - 1);
        let last = self.cells.partition_point(|c| c.end < to.s).min(self.cells.len() - 1);
        let limits = self.limits((from, to), (first, last), way);
        let phases = Self::fastest(from, to, &limits).or_else(|| even(from, to))?;
        self.keeps(&phases, (first, last)).then_some(phases)
    }

    /// The limits of the blocks `first..=last` that hold for all of them, and for both states.
    fn limits(
        &self,
        (from, to): (&Phase, &Phase),
        (first, last): (usize, usize),
        way: Way,
    ) -> ThirdOrderLimits {
        let (mut acc, mut dec, mut jerk, mut v) =
            (f64::INFINITY, f64::INFINITY, f64::INFINITY, 0.0_f64);
        let mut lowest = f64::INFINITY;
        for (i, cell) in self.cells[first..=last].iter().enumerate() {
            lowest =
                lowest.min(cell.v).min(if first + i < last { cell.cap } else { f64::INFINITY });
            acc = acc.min(cell.acc);
            dec = dec.min(cell.dec);
            jerk = jerk.min(cell.least_jerk());
            v = v.max(cell.v);
        }
        jerk *= way.jerk;
        if !way.free {
            let flat = |v: f64, a: f64| v + 0.5 * a.max(0.0) * a / jerk;
            v = lowest.max(flat(from.v, from.a)).max(flat(to.v, -to.a));
        }
        ThirdOrderLimits {
            v_max_mm_s: v * (1.0 + 0.5 * OVER),
            v_min_mm_s: 0.0,
            a_max_mm_s2: acc.max(from.a).max(to.a) * (1.0 + 1e-12),
            a_min_mm_s2: -dec.max(-from.a).max(-to.a) * (1.0 + 1e-12),
            jerk_mm_s3: jerk,
        }
    }

    /// Whether phases keep the limits of the blocks `first..=last` that they pass.
    fn keeps(&self, phases: &[Phase], (first, last): (usize, usize)) -> bool {
        let mut c = first;
        for phase in phases {
            let end = phase.end();
            if phase.lowest() < -1e-9 {
                return false;
            }
            // compare the highest speed in every block it passes, and the speeds at the boundaries
            let mut part = *phase;
            loop {
                let cell = &self.cells[c];
                let inside = end.s < cell.end || c == last;
                let t = if inside { part.t } else { part.time_at(cell.end) };
                let piece = part.until(t);
                let (a0, a1) = (piece.a, piece.end().a);
                if piece.peak() > cell.v * (1.0 + OVER)
                    || a0.max(a1) > cell.acc * (1.0 + 1e-6)
                    || a0.min(a1) < -cell.dec * (1.0 + 1e-6)
                {
                    return false;
                }
                if inside {
                    break;
                }
                if piece.end().v > cell.cap * (1.0 + OVER) {
                    return false;
                }
                part = part.rest(t);
                c += 1;
            }
        }
        true
    }

    /// The fastest third-order profile between two states.
    ///
    /// With sine-square ramps in place of its ramps it reaches the same speed over a different length, so it is planned
    /// for a length that compensates for the difference.
    fn fastest(from: &Phase, to: &Phase, limits: &ThirdOrderLimits) -> Option<Vec<Phase>> {
        let state = |p: &Phase| MotionState { p_mm: p.s, v_mm_s: p.v, a_mm_s2: p.a };
        let mut target = state(to);
        for _ in 0..ROUNDS {
            let mut at = *from;
            let mut phases = Vec::with_capacity(7);
            for (t, j) in limits.fastest(&state(from), &target).ok()? {
                let phase = at.ramp(RampShape::Sin2, j, t);
                phases.push(phase);
                at = phase.end();
            }
            let miss = at.s - to.s;
            if miss.abs() <= MISS_MM {
                return Some(phases);
            }
            target.p_mm -= miss;
        }
        None
    }
}

fn time(phases: &[Phase]) -> f64 {
    phases.iter().map(|p| p.t).sum()
}

/// Whether two states are equal up to rounding.
fn coincide(a: &Phase, b: &Phase) -> bool {
    (a.s - b.s).abs() <= 1e-12 * b.s && (a.v - b.v).abs() <= CUT * b.v && (a.a - b.a).abs() <= 1e-6
}

/// A constant speed between two states with equal speeds up to rounding.
fn even(from: &Phase, to: &Phase) -> Option<Vec<Phase>> {
    let is_flat = from.a.abs().max(to.a.abs()) <= FLAT_MM_S2;
    let is_same = (from.v - to.v).abs() <= OVER * to.v;
    (is_flat && is_same).then(|| vec![from.ramp(RampShape::Sin2, 0.0, (to.s - from.s) / from.v)])
}

/// Speed of a list of phases at `s`, before a cut there.
fn speed_at(list: &[Phase], s: f64, length: f64) -> f64 {
    let s = s - 1e-12 * length;
    let i = list.partition_point(|p| p.s <= s).saturating_sub(1);
    list.get(i).map_or(f64::INFINITY, |p| p.after(p.time_at(s)).v)
}
