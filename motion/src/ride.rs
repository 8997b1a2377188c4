//! The speed over a stretch of blocks with varying limits: along the limits where they change slowly, below them where
//! acceleration or jerk require it.
//!
//! 1. *rise*: from the start, as fast as the blocks permit, without ever reducing the speed. Where a limit drops the
//!    speed is cut with zero acceleration, unless the rise was lowered before to pass the drop with an acceleration
//!    ([`climb`]).
//! 2. *fall*: the same from the end, backwards.
//! 3. The speed is the lower of the two. At the change from rise to fall the acceleration would jump, so the rise is
//!    left early enough to run into the fall with a falling acceleration ([`meet`]). At a local minimum both are at the
//!    limit with zero acceleration and meet without a connection.
//!
//! Constant jerk (TRAPEZ, HSC): every block uses its jerk and acceleration over its length. At a limit that is reached
//! the acceleration is zero, except where there is no room for that; a limit that is not reached has no effect.
//! Sine-square ramps (SIN2) cannot be cut at a limit; they are built in steps, see [`sine`].
//!
//! Limits of neighbouring blocks that differ by rounding are made equal first, see [`level`].
//!
//! A stretch whose rise and fall do not meet is refused; the caller then requires zero acceleration at its boundaries.

mod climb;
mod level;
mod meet;
mod sine;
#[cfg(test)]
mod tests;

use crate::profile::{MotionState, Phase, Profile, RampShape, Rates, ThirdOrderLimits};
use climb::{climb, climb_beyond};
use level::level;
use meet::{Follow, Known, Meet};

/// Shortest ramp in s.
const SHORTEST_RAMP_S: f64 = 1e-4;
/// Relative tolerance of a limit for rounding.
const SLACK: f64 = 1e-9;
/// Relative difference up to which limits of neighbouring blocks count as equal: rounding of their coordinates.
const ALIKE: f64 = 1e-6;
/// Relative drop of the speed from which on it is cut: more than twice the tolerance of a limit, less than two limits
/// differ ([`level`]).
const CUT: f64 = 30.0 * SLACK;
/// Speed in mm/s that counts as standstill.
const REST_MM_S: f64 = 1e-9;
/// Number of blocks at one limit with which a fall begins at least, where it is not computed as a whole.
const LEVEL_BLOCKS: usize = 3;
/// Relative gain of speed from which on a hill between two equal limits at the ends of a block is used.
const HILL: f64 = 0.005;
/// Ratios of the jerks of neighbouring blocks from which on zero acceleration at their boundary may be faster: only between
/// rows of similar blocks, or between all of them.
pub(crate) const JERK_STEPS: [f64; 2] = [2.0, 1.1];

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

/// Block of a stretch with its jerks.
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
    /// Whether neither its end nor the next block changes anything.
    fn goes_on_as(&self, next: &Self) -> bool {
        let same = |a: f64, b: f64| (a - b).abs() <= SLACK * a;
        self.cap >= self.v * (1.0 - SLACK)
            && same(self.v, next.v)
            && same(self.acc, next.acc)
            && same(self.dec, next.dec)
            && self.jerks.iter().zip(next.jerks).all(|(a, b)| same(*a, b))
    }

    fn least_jerk(&self) -> f64 {
        self.jerks.into_iter().fold(f64::INFINITY, f64::min)
    }
}

/// The blocks, each with its own jerk.
fn own(cells: &[Cell]) -> Vec<Block> {
    let block = |c: &Cell| {
        let Rates { acc, dec, ramps, .. } = c.rates;
        let [t1, t2, t3, t4] = ramps.map(|t| t.max(SHORTEST_RAMP_S));
        let jerks = [acc / t1, acc / t2, dec / t3, dec / t4];
        Block { end: c.end, v: c.v, cap: c.cap, acc, dec, jerks }
    };
    cells.iter().map(block).collect()
}

/// Combines blocks between which nothing changes, so that a line in two parts is treated as one. `ends`: the speeds at
/// both ends, which stay within the limits.
fn joined(mut blocks: Vec<Block>, ends: Option<(f64, f64)>) -> Vec<Block> {
    level(&mut blocks, ends);
    let mut out: Vec<Block> = Vec::with_capacity(blocks.len());
    for block in blocks {
        match out.last_mut().filter(|last| last.goes_on_as(&block)) {
            Some(last) => (last.end, last.cap) = (block.end, block.cap),
            None => out.push(block),
        }
    }
    out
}

/// The fastest speed found from `v0` with acceleration `a0` (constant jerk only) to `v1` with zero acceleration; `None`
/// if there is none within the limits.
pub(crate) fn ride(cells: &[Cell], (v0, a0): (f64, f64), v1: f64) -> Option<Profile> {
    let last = cells.last()?;
    let length = last.end;
    if last.rates.shape == RampShape::Sin2 {
        let speed = if a0.abs() > 0.0 { None } else { sine::speed(cells, v0, v1) };
        return speed.map(|speed| Profile::over(speed, length));
    }
    let cells = &joined(own(cells), Some((v0, v1)))[..];
    let mirrored = &mirror(cells)[..];
    let along = |fall: &[Phase], known: &Known| {
        let fall = &turned(fall, length)[..];
        // beyond the last crossing the speed is that of the fall
        let mut follow = Follow::new(cells, fall);
        let crossed = |phase: &Phase, _, _| follow.has_crossed_for_good(phase);
        let rise = climb_beyond(cells, (v0, a0), crossed)?;
        Meet { cells, rise: &rise, fall, v1, known }.speed()
    };
    let (fall, known) = fall_from_level(mirrored, v1, (v0, a0))?;
    let mut speed = along(&fall, &known);
    if known.is_left() {
        speed = along(&climb(mirrored, v1, 0.0)?, &Known::whole());
    }
    Some(Profile::over(speed?, length))
}

/// The fall, mirrored, as far back as it has to be known: where it has come to the one limit of all blocks before, a rise that begins
/// within that limit is not above it.
fn fall_from_level(
    mirrored: &[Block],
    v1: f64,
    (v0, a0): (f64, f64),
) -> Option<(Vec<Phase>, Known)> {
    let mut fastest = vec![0.0_f64; mirrored.len() + 1];
    for (c, block) in mirrored.iter().enumerate().rev() {
        fastest[c] = fastest[c + 1].max(block.v);
    }
    let mut level = 0;
    let fall = climb_beyond(mirrored, (v1, 0.0), |_, c, v| {
        level += usize::from(a0 <= 0.0 && v0 <= v && fastest[c] <= v);
        level > LEVEL_BLOCKS
    })?;
    let length = mirrored.last()?.end;
    let known = match fall.last() {
        Some(first) if level > LEVEL_BLOCKS => Known::behind(length - first.s),
        _ => Known::whole(),
    };
    Some((fall, known))
}

/// Whether a ride connects rise and fall with less jerk than the limits permit: with sine-square ramps, for which the
/// smallest of the four jerks is used.
pub(crate) fn connects_gently(cells: &[Cell]) -> bool {
    let lopsided = |block: &Block| {
        let least = block.least_jerk();
        block.jerks.iter().any(|jerk| *jerk > least * (1.0 + SLACK))
    };
    has_sine_ramps(cells) && own(cells).iter().any(lopsided)
}

/// The cells whose jerk differs by this ratio or more from that of the cell before. A ride with sine-square ramps uses the
/// smaller jerk on both sides of the boundary ([`sine`]), so a tiny block would slow down the whole of a long one next
/// to it.
pub(crate) fn jerk_steps(cells: &[Cell], ratio: f64) -> Vec<usize> {
    if !has_sine_ramps(cells) {
        return Vec::new();
    }
    let jerks: Vec<f64> = own(cells).iter().map(Block::least_jerk).collect();
    let steps = jerks.windows(2).zip(1..);
    let steps = steps.filter(|(j, _)| j[0].max(j[1]) > ratio * j[0].min(j[1]));
    steps.map(|(_, after)| after).collect()
}

fn has_sine_ramps(cells: &[Cell]) -> bool {
    cells.last().is_some_and(|cell| cell.rates.shape == RampShape::Sin2)
}

/// One block, or several between which nothing changes, with a single jerk.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Alone {
    block: Block,
}

impl Alone {
    /// `None` if the limits change on the way, or the ramps differ or are those of SIN2.
    pub(crate) fn of(cells: &[Cell]) -> Option<Self> {
        let block = match joined(own(cells), None)[..] {
            [block] if cells[0].rates.shape == RampShape::Trapez => block,
            _ => return None,
        };
        let jerk = block.jerks[0];
        block.jerks.iter().all(|j| (j - jerk).abs() <= SLACK * jerk).then_some(Self { block })
    }

    /// Jerk in mm/s3.
    pub(crate) fn jerk(&self) -> f64 {
        self.block.jerks[0]
    }

    /// Acceleration and deceleration in mm/s2.
    pub(crate) fn rates(&self) -> [f64; 2] {
        [self.block.acc, self.block.dec]
    }

    /// The fastest speed from one velocity and acceleration to another; `None` if there is none within the limits.
    pub(crate) fn fastest(&self, (v0, a0): (f64, f64), (v1, a1): (f64, f64)) -> Option<Profile> {
        #[cfg(test)]
        crate::closed_forms::add();
        let Block { end, v, acc, dec, .. } = self.block;
        let limits = ThirdOrderLimits {
            v_max_mm_s: v.max(v0).max(v1),
            v_min_mm_s: 0.0,
            a_max_mm_s2: acc.max(a0).max(a1) * (1.0 + SLACK),
            a_min_mm_s2: -dec.max(-a0).max(-a1) * (1.0 + SLACK),
            jerk_mm_s3: self.jerk(),
        };
        let state = |p_mm: f64, v_mm_s: f64, a_mm_s2: f64| MotionState { p_mm, v_mm_s, a_mm_s2 };
        let found = limits.fastest(&state(0.0, v0, a0), &state(end, v1, a1)).ok()?;
        let mut at = Phase::state(0.0, v0, a0);
        let phases = found.into_iter().map(|(t, j)| {
            let phase = at.ramp(RampShape::Trapez, j, t);
            at = phase.end();
            phase
        });
        let phases: Vec<Phase> = phases.collect();
        // a start too steep for the path ahead exceeds this limit
        let keeps = |p: &Phase| p.lowest() >= -REST_MM_S && p.peak() <= v * (1.0 + 2.0 * SLACK);
        phases.iter().all(keeps).then(|| Profile::over(phases, end))
    }
}

/// Phases reversed, from the other end.
fn turned(list: &[Phase], length: f64) -> Vec<Phase> {
    list.iter().rev().map(|p| p.reversed(length)).collect()
}

/// The blocks seen from the end, with acceleration and deceleration exchanged.
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

/// Whether accelerating and braking between two ends that are passed at `v` with zero acceleration gains enough.
fn is_hill(length: f64, v: f64, acc: f64, jerk: f64) -> bool {
    let time = length / v;
    (jerk * time * time / 16.0).min(acc * time / 4.0) >= HILL * v
}

/// Whether a limit is below the present speed: the braking towards it is not part of the rise.
fn is_drop(limit: f64, v: f64) -> bool {
    limit < v * (1.0 - ALIKE)
}

/// Whether a speed reached at `s` in block `c` can be held up to the end of the block, or reduced in time, or is cut
/// there; `v` is the speed at which the rise to it began.
fn is_level(cells: &[Block], c: usize, s: f64, reached: f64, v: f64) -> bool {
    let cell = &cells[c];
    let Some(behind) = cells.get(c + 1) else { return true };
    let limit = cell.cap.min(behind.v);
    if reached <= limit * (1.0 + 2.0 * SLACK) || is_drop(limit, v) {
        return true;
    }
    let whole = cell.end - c.checked_sub(1).map_or(0.0, |b| cells[b].end);
    let Block { acc, dec, jerks: [.., j3, j4], .. } = *cell;
    if !is_hill(whole, limit, acc.min(dec), cell.least_jerk()) {
        return false;
    }
    let ramps = dec / j3 + dec / j4;
    let loss = reached - limit;
    let full = 0.5 * dec * ramps;
    let time = if loss >= full { loss / dec + 0.5 * ramps } else { (loss / full).sqrt() * ramps };
    0.5 * (reached + limit) * time <= cell.end - s
}

/// As [`is_hill`], for a block with these rates.
pub(crate) fn has_hill(length: f64, v: f64, rates: &Rates) -> bool {
    let Rates { acc, dec, ramps, .. } = *rates;
    let least = acc.min(dec);
    is_hill(length, v, least, least / ramps.into_iter().fold(SHORTEST_RAMP_S, f64::max))
}
