//! The speed over a stretch of blocks whose limits vary: along the limits where they change slowly, below them where
//! acceleration or jerk do not allow more.
//!
//! 1. *rise*: from the start, as fast as the blocks allow, never reducing the speed: in steps of constant jerk, each with
//!    the largest acceleration from which the ramp down to zero still stays below every limit ahead. Where a limit drops
//!    the speed is cut, its acceleration zero.
//! 2. *fall*: the same from the end, backwards.
//! 3. *join*: the lower one of both is the speed. Where it changes from rise to fall the acceleration would jump, so there
//!    the fastest third-order profile connects a state before with one behind, as close to each other as the limits
//!    allow. At a local minimum both are at the limit with zero acceleration and meet by themselves.
//!
//! Nothing is promised before it has been measured: every connection is checked against every limit it passes, and a
//! stretch for which no connection fits is refused; the caller then stops accelerating at its boundaries.

use crate::profile::{Chain, MotionState, Phase, Rates, ThirdOrderLimits, ThirdOrderProfile};

/// Steps per longest ramp.
const STEPS_PER_RAMP: f64 = 8.0;
/// Shortest step in s; ramps below it are taken as one step.
const SHORTEST_STEP_S: f64 = 1e-4;
/// Steps per stretch beyond which it is refused, plus as many per block: a crawl is no ride.
const MOST_STEPS: usize = 20_000;
/// Blocks ahead and behind that a step is thought to run through at most.
const REACH: usize = 64;
/// Rounds of bisection of the acceleration in a step.
const ROUNDS: u32 = 10;
/// Relative slack of a limit: rounding.
const SLACK: f64 = 1e-9;
/// Relative gain of speed from which on a hill between two equal limits at the ends of a block is driven.
const HILL: f64 = 0.005;
/// Relative excess of the rise over the fall from which on they cross: both may miss a limit they run along by less.
const CROSSING: f64 = 1e-3;
/// Widths, in phases on either side, at which a connection is tried.
const WIDTHS: [usize; 16] = [0, 1, 2, 3, 4, 6, 8, 11, 15, 20, 27, 36, 48, 64, 96, 128];

/// One block of a stretch.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cell {
    /// Path length at its end, from the start of the stretch.
    pub(crate) end: f64,
    /// Velocity limit inside.
    pub(crate) v: f64,
    /// Velocity limit at its end.
    pub(crate) cap: f64,
    /// Acceleration and ramps.
    pub(crate) rates: Rates,
}

/// Block of a stretch with the jerks that hold for a step that touches it.
#[derive(Clone, Copy, Debug)]
struct Block {
    end: f64,
    v: f64,
    cap: f64,
    acc: f64,
    dec: f64,
    /// Acceleration builds up, falls, deceleration builds up, falls.
    jerks: [f64; 4],
}

impl Block {
    fn least_jerk(&self) -> f64 {
        self.jerks.into_iter().fold(f64::INFINITY, f64::min)
    }
}

/// A step may run through several blocks: its jerk is the least one of them.
fn blocks(cells: &[Cell], dt: f64) -> Vec<Block> {
    let own = |r: &Rates| {
        let [t1, t2, t3, t4] = r.ramps.map(|t| t.max(dt));
        [r.acc / t1, r.acc / t2, r.dec / t3, r.dec / t4]
    };
    let mut out: Vec<Block> = cells
        .iter()
        .map(|c| {
            let Rates { acc, dec, .. } = c.rates;
            Block { end: c.end, v: c.v, cap: c.cap, acc, dec, jerks: own(&c.rates) }
        })
        .collect();
    for (i, cell) in cells.iter().enumerate() {
        // blocks that begin within a step behind the end of this one
        let near = |k: &usize| cells[k - 1].end <= cell.end + cell.v * dt;
        for k in (i + 1..cells.len()).take(REACH).take_while(near) {
            for (far, j) in [(i, k), (k, i)] {
                let jerks = own(&cells[j].rates);
                for (mine, theirs) in out[far].jerks.iter_mut().zip(jerks) {
                    *mine = mine.min(theirs);
                }
            }
        }
    }
    out
}

/// The fastest speed found from `v0` to `v1`, acceleration zero at both ends; `None` if the limits leave no way.
pub(crate) fn ride(cells: &[Cell], v0: f64, v1: f64) -> Option<Chain> {
    let length = cells.last()?.end;
    let longest = cells.iter().flat_map(|c| c.rates.ramps).fold(0.0, f64::max);
    let dt = (longest / STEPS_PER_RAMP).max(SHORTEST_STEP_S);
    let cells = &blocks(cells, dt)[..];
    let mirrored = &mirror(cells)[..];
    let forward = Rise { cells, dt }.run(v0)?;
    let backward = Rise { cells: mirrored, dt }.run(v1)?;
    let turn = |list: &[Phase]| list.iter().rev().map(|p| reversed(p, length)).collect::<Vec<_>>();
    // joined from either end, so that a reversed contour takes the same time
    let there = join(cells, forward.clone(), turn(&backward), v0);
    let back = join(mirrored, backward, turn(&forward), v1).map(|out| turn(&out));
    let time = |list: &Vec<Phase>| list.iter().map(|p| p.t).sum::<f64>();
    let best = [there, back].into_iter().flatten().min_by(|a, b| time(a).total_cmp(&time(b)))?;
    Some(Chain::new(best, length))
}

fn join(cells: &[Block], rise: Vec<Phase>, fall: Vec<Phase>, v0: f64) -> Option<Vec<Phase>> {
    let mut join = Join { cells, rise, fall, out: Vec::new() };
    join.run(v0)?;
    Some(join.out)
}

/// The blocks seen from the end: braking becomes accelerating.
fn mirror(cells: &[Block]) -> Vec<Block> {
    let length = cells.last().map_or(0.0, |c| c.end);
    (0..cells.len())
        .rev()
        .map(|i| {
            let Block { v, acc, dec, jerks: [j1, j2, j3, j4], .. } = cells[i];
            let before = i.checked_sub(1).map(|b| cells[b]);
            Block {
                end: length - before.map_or(0.0, |b| b.end),
                v,
                cap: before.map_or(f64::INFINITY, |b| b.cap),
                acc: dec,
                dec: acc,
                jerks: [j4, j3, j2, j1],
            }
        })
        .collect()
}

/// A phase run backwards from the other end.
fn reversed(p: &Phase, length: f64) -> Phase {
    let end = p.end();
    Phase { s: length - end.s, v: end.v, a: -end.a, ..*p }
}

/// See the module, 1.
struct Rise<'a> {
    cells: &'a [Block],
    dt: f64,
}

impl Rise<'_> {
    fn run(&self, v0: f64) -> Option<Vec<Phase>> {
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

/// True if two states are the same up to rounding.
fn coincide(a: &Phase, b: &Phase) -> bool {
    (a.s - b.s).abs() <= 1e-12 * b.s
        && (a.v - b.v).abs() <= SLACK * b.v
        && (a.a - b.a).abs() <= 1e-6
}

/// True if between two ends passed at `v` with acceleration zero a speed-up and a slow-down are worth the name.
fn is_hill(length: f64, v: f64, acc: f64, jerk: f64) -> bool {
    let time = length / v;
    (jerk * time * time / 16.0).min(acc * time / 4.0) >= HILL * v
}

/// As [`is_hill`], for a block with these rates.
pub(crate) fn has_hill(length: f64, v: f64, rates: &Rates) -> bool {
    let Rates { acc, dec, ramps } = *rates;
    let least = acc.min(dec);
    is_hill(length, v, least, least / ramps.into_iter().fold(SHORTEST_STEP_S, f64::max))
}

/// True if a limit is below the present speed: the fall towards it is none of the rise's business.
fn is_drop(limit: f64, v: f64) -> bool {
    limit < v * (1.0 - 10.0 * SLACK)
}

/// See the module, 3.
struct Join<'a> {
    cells: &'a [Block],
    rise: Vec<Phase>,
    fall: Vec<Phase>,
    out: Vec<Phase>,
}

impl Join<'_> {
    fn run(&mut self, v0: f64) -> Option<()> {
        let length = self.cells.last()?.end;
        // the block in which the rise gets above the fall next; inside a block between two limits both may bulge
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
            // on the rise up to where it does
            let quiet = c.checked_sub(1).map_or(0.0, |c| self.cells[c].end) * (1.0 - 1e-12);
            while let Some(next) = self.rise.get(r) {
                let end = next.end();
                let crosses = || {
                    c < self.cells.len()
                        && end.v > speed_at(&self.fall, end.s, length) * (1.0 + SLACK)
                };
                if end.s > quiet && crosses() {
                    break;
                }
                self.out.push(*next);
                r += 1;
            }
            let here = self.out.last().map_or(start(v0), Phase::end);
            let (to, cut) = self.connect(here, v0)?;
            // on the fall, until it is cut
            self.out.extend_from_slice(&self.fall[to..cut]);
            if cut == self.fall.len() {
                return Some(());
            }
            // both are cut at the same place
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

    /// Replaces the end of what has been put out by a connection to the fall; returns the phases of the fall behind it
    /// up to where it is cut.
    fn connect(&mut self, here: Phase, v0: f64) -> Option<(usize, usize)> {
        let slack = 1e-12 * self.cells.last()?.end;
        let ahead = self.fall.partition_point(|p| p.s <= here.s + slack).max(1);
        let is_cut = |k: usize| {
            let (before, behind) = (self.fall[k - 1].end(), &self.fall[k]);
            behind.v > before.v * (1.0 + SLACK) + 1e-12
        };
        let cut = (ahead..self.fall.len()).find(|k| is_cut(*k)).unwrap_or(self.fall.len());
        // as close as possible, both sides alike first
        for width in WIDTHS {
            let other = WIDTHS.into_iter().take_while(|w| *w < width);
            let pairs = [(width, width)].into_iter();
            for (back, ahead_by) in pairs.chain(other.flat_map(|w| [(w, width), (width, w)])) {
                if back > self.out.len() && back > 1 && self.out.len() < back / 2 {
                    continue;
                }
                let keep = self.out.len() - back.min(self.out.len());
                let from = match self.out.get(keep) {
                    Some(p) => Phase { t: 0.0, j: 0.0, ..*p },
                    None => self.out.last().map_or(start(v0), Phase::end),
                };
                let to = (ahead + ahead_by).min(cut);
                let target = if to < cut { self.fall[to] } else { self.fall[cut - 1].end() };
                let phases = if coincide(&from, &target) {
                    Some(Vec::new())
                } else {
                    let free = self.between(&from, &target, true);
                    free.or_else(|| self.between(&from, &target, false))
                };
                if let Some(phases) = phases {
                    self.out.truncate(keep);
                    self.out.extend(phases);
                    return Some((to, cut));
                }
            }
        }
        None
    }

    /// The fastest third-order profile between two states, if it keeps every limit; `free`: up to the highest limit of
    /// the blocks it passes, else not above the lowest one.
    fn between(&self, from: &Phase, to: &Phase, free: bool) -> Option<Vec<Phase>> {
        #[cfg(test)]
        crate::work::add();
        if to.s <= from.s {
            return None;
        }
        let first = self.cells.partition_point(|c| c.end <= from.s).min(self.cells.len() - 1);
        let last = self.cells.partition_point(|c| c.end < to.s).min(self.cells.len() - 1);
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
        if !free {
            let flat = |v: f64, a: f64| v + 0.5 * a.max(0.0) * a / jerk;
            v = lowest.max(flat(from.v, from.a)).max(flat(to.v, -to.a));
        }
        let limits = ThirdOrderLimits {
            v_max_mm_s: v * (1.0 + SLACK),
            v_min_mm_s: 0.0,
            a_max_mm_s2: acc.max(from.a).max(to.a) * (1.0 + 1e-12),
            a_min_mm_s2: -dec.max(-from.a).max(-to.a) * (1.0 + 1e-12),
            jerk_mm_s3: jerk,
        };
        let state = |p: &Phase| MotionState { p_mm: p.s, v_mm_s: p.v, a_mm_s2: p.a };
        let profile = ThirdOrderProfile::fastest(&state(from), &state(to), &limits);
        let profile = profile.ok()?;
        let mut at = *from;
        let mut phases = Vec::with_capacity(7);
        for (t, j) in profile.phases() {
            let phase = Phase { t, j, ..at };
            phases.push(phase);
            at = phase.end();
        }
        let mut c = first;
        for phase in &phases {
            let end = phase.end();
            if end.v < 0.0 && end.v < -1e-9 {
                return None;
            }
            // the highest speed in every block it passes, and at the boundaries
            let mut part = *phase;
            loop {
                let cell = &self.cells[c];
                let inside = end.s < cell.end || c == last;
                let t = if inside { part.t } else { part.time_at(cell.end) };
                let piece = Phase { t, ..part };
                let (a0, a1) = (piece.a, piece.end().a);
                if piece.peak() > cell.v * (1.0 + SLACK)
                    || a0.max(a1) > cell.acc * (1.0 + 1e-6)
                    || a0.min(a1) < -cell.dec * (1.0 + 1e-6)
                {
                    return None;
                }
                if inside {
                    break;
                }
                let here = piece.end();
                if here.v > cell.cap * (1.0 + SLACK) {
                    return None;
                }
                part = Phase { t: part.t - t, j: part.j, ..here };
                c += 1;
            }
        }
        Some(phases)
    }
}

/// Speed of a list of phases at `s`, before a cut there.
fn speed_at(list: &[Phase], s: f64, length: f64) -> f64 {
    let s = s - 1e-12 * length;
    let i = list.partition_point(|p| p.s <= s).saturating_sub(1);
    list.get(i).map_or(f64::INFINITY, |p| p.after(p.time_at(s)).v)
}

fn start(v: f64) -> Phase {
    Phase { s: 0.0, v, a: 0.0, j: 0.0, t: 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::profile::SpanProfile;

    fn random(seed: &mut u64) -> f64 {
        *seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (*seed >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Blocks with limits that vary slowly, with noise, dips and blocks of other lengths.
    fn cells(seed: u64, ramp: f64) -> Vec<Cell> {
        let mut seed = seed;
        let r = &mut seed;
        let (waves, depth, noise) = (0.1 + random(r), 60.0 * random(r), 0.2 * random(r));
        let mut end = 0.0;
        (0..150)
            .map(|i| {
                end += if random(r) < 0.05 { 5.0 * random(r) + 0.01 } else { 0.2 };
                let smooth = 80.0 + depth * libm::sin(waves * end);
                let cap = smooth * (1.0 - noise * random(r));
                let ramps = [ramp, ramp, ramp, ramp];
                let acc = 3000.0 + 1000.0 * libm::sin(0.3 * end);
                let cap = if i == 149 { f64::INFINITY } else { cap };
                Cell { end, v: 150.0, cap, rates: Rates { acc, dec: acc, ramps } }
            })
            .collect()
    }

    /// Every phase is continuous and keeps velocity, acceleration and jerk of the blocks it lies in.
    #[test]
    fn a_ride_keeps_every_limit() {
        let mut found = 0;
        for seed in 0..60 {
            for ramp in [0.02, 0.005] {
                let cells = cells(seed, ramp);
                let Some(chain) = ride(&cells, 0.0, 0.0) else { continue };
                found += 1;
                let length = cells[cells.len() - 1].end;
                let profile = SpanProfile::from_chain(chain);
                let n = 10_000;
                let dt = profile.duration() / f64::from(n);
                let mut before = profile.at(0.0);
                assert!(before.v_mm_s.abs() < 1e-12);
                for k in 1..=n {
                    let now = profile.at(dt * f64::from(k));
                    let i = cells.partition_point(|c| c.end < now.s_mm).min(cells.len() - 1);
                    let near = &cells[i.saturating_sub(1)..(i + 2).min(cells.len())];
                    let most = |f: &dyn Fn(&Cell) -> f64| near.iter().map(f).fold(0.0, f64::max);
                    let acc = most(&|c| c.rates.acc);
                    let jerk = most(&|c| c.rates.acc / ramp);
                    assert!(now.v_mm_s <= 150.0 * (1.0 + 1e-8), "{seed}: {now:?}");
                    assert!(now.a_mm_s2.abs() <= acc * 1.01, "{seed}: {now:?} {acc}");
                    assert!(now.j_mm_s3.abs() <= jerk * (1.0 + 1e-6), "{seed}: {now:?} {jerk}");
                    let da = (now.a_mm_s2 - before.a_mm_s2).abs();
                    assert!(da <= jerk * dt * 1.01 + 1e-3, "{seed}: jump {before:?} {now:?}");
                    let dv = now.v_mm_s - before.v_mm_s;
                    let mean = 0.5 * (now.a_mm_s2 + before.a_mm_s2);
                    assert!((dv - mean * dt).abs() <= jerk * dt * dt + 2e-4, "{seed}: {now:?}");
                    before = now;
                }
                assert!((before.s_mm - length).abs() < 1e-9 && before.v_mm_s.abs() < 1e-6);
                for cell in &cells {
                    let v = profile.at(profile.time_at(cell.end)).v_mm_s;
                    assert!(v <= cell.cap * (1.0 + 2e-6), "{seed}: {v} {cell:?}");
                }
            }
        }
        assert!(found > 90, "{found} of 120");
    }
}
