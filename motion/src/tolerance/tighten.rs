//! Answers an excess with lower speeds, stops, dwells and accelerations for the next round.

use super::Trial;
use super::demands::{Demands, hurry, turns};
use super::findings::Findings;
use super::marks::Mark;
use super::view::View;
use crate::axis::AxisVec;
use crate::overshoot::gentle;
use crate::path::Path;
use crate::queue::{Queued, Stretch};
use kontur_filters::kernel::Kernel;
use std::sync::Arc;

/// Share of the tolerance by which a correction aims below it, so that the search ends.
const AIM: f64 = 0.003;

/// Smallest acceleration of a block, relative to the one that a single start or stop may use.
const LEAST_SHARE: f64 = 0.1;

/// Share of the kernel by which the smallest step of a dwell grows each time the dwell is extended: neighbours that
/// share an error otherwise shift it back and forth.
const GROWTH: f64 = 1.0 / 256.0;

/// Share of an excess from which on it counts as unchanged.
const WITHOUT_EFFECT: f64 = 0.9;

/// Share of the speed that remains in each round when everything within reach counts as a cause: few rounds are left.
const HASTE: f64 = 0.85;

impl View<'_> {
    /// Divides the blocks to blame that bend more in one place than in another, or whose axes with different delays are
    /// pulled apart more, and arcs at both ends, see [`ends_apart`]: the speed permitted at the worst place need not limit the
    /// whole block.
    pub(super) fn parts(&self, findings: &Findings) -> Vec<(usize, Vec<Arc<Queued>>)> {
        let Self { trial, marks, .. } = self;
        let blamed = marks.iter().filter_map(|mark| {
            let b = mark.block?;
            Some((b, &mark.queued, findings.block[b]?.1))
        });
        blamed
            .map(|(b, queued, tolerance)| {
                let reach = ends_apart(trial, queued, tolerance);
                let parts = reach.map(|reach_mm| queued.with_ends_apart(reach_mm));
                (b, parts.unwrap_or_else(|| queued.parts(stretches(trial, queued, tolerance))))
            })
            .filter(|(_, parts)| parts.len() > 1)
            .collect()
    }

    /// Tightens the demands on what is to blame; `all`: on everything within reach.
    pub(super) fn tighten(&self, findings: &Findings, all: bool, demands: &mut Demands) {
        let mut soften = vec![None; demands.feed.len()];
        for m in 0..self.marks.len() {
            self.tighten_corner(m, findings, all, demands, &mut soften);
        }
        for mark in &self.marks {
            if let Some(b) = mark.boundary {
                demands.cap[b] = demands.cap[b].min(findings.even_at[b]);
            }
            let Some(b) = mark.block else { continue };
            if let Some(excess) = findings.block[b] {
                if self.trial.kernels.overshoot {
                    note(&mut soften[b], excess);
                }
                self.slow_down(b, &mark.queued, excess, findings.even[b], all, demands);
            }
            if let Some(excess) = soften[b] {
                demands.acceleration[b] =
                    self.softened(b, &mark.queued, excess, all, demands.acceleration[b]);
            }
        }
    }

    /// Lowers the speed at the corner of a mark, or lengthens the rest there.
    fn tighten_corner(
        &self,
        m: usize,
        findings: &Findings,
        all: bool,
        demands: &mut Demands,
        soften: &mut [Option<(f64, f64)>],
    ) {
        let (trial, mark) = (self.trial, &self.marks[m]);
        let full = trial.kernels.length();
        let Some(b) = mark.boundary.filter(|b| findings.corner[*b] > 0.0) else { return };
        let excess = findings.corner[b];
        let before = m.checked_sub(1).map(|before| &self.marks[before]);
        let tolerances = [Some(mark), before].into_iter().flatten();
        let tolerances = tolerances.filter_map(|mark| mark.queued.block.tolerance.ax_dev_mm);
        let tolerance = tolerances.min_by(f64::total_cmp).unwrap_or(0.0);
        let swings = trial.kernels.overshoot
            && demands.stop[b]
                .is_some_and(|dwell| dwell == full || !self.rest_at(mark, dwell).keeps(full));
        if swings {
            // the remaining excess is the overshoot of the stop itself
            if b > 0 {
                note(&mut soften[b - 1], (excess, tolerance));
            }
            note(&mut soften[b], (excess, tolerance));
            // after many rounds the excess may be the overshoot of the final part, which decays
            if !all {
                return;
            }
        }
        if all {
            (demands.cap[b], demands.stop[b]) = (0.0, Some(full));
            return;
        }
        let resting = demands.stop[b].or((b == 0).then_some(0));
        if let Some(dwell) = resting {
            // in small steps, because neighbouring corners within reach share the error
            let most = (dwell + (full / 8).max(1)).min(full);
            let least = 1 + (GROWTH * f64::from(full) * f64::from(demands.repeats[b])) as u32;
            let needed = self.rest_at(mark, dwell).needed(dwell, most);
            demands.stop[b] = Some(needed.max(dwell + least).min(full));
            demands.repeats[b] += 1;
            return;
        }
        self.lower(b, mark, (excess, tolerance), demands);
    }

    /// Lowers the speed at the boundary of a mark that is passed without a stop, by an excess and its tolerance in mm.
    fn lower(&self, b: usize, mark: &Mark, (excess, tolerance): (f64, f64), demands: &mut Demands) {
        let trial = self.trial;
        let m1 =
            trial.kernels.get(mark.axis).map_or(1.0, Kernel::m1_cycles) * trial.cycle.seconds();
        let now = self.speed_at(b);
        // The steepest fall of the error with the speed. The effect of the last step would be a larger step, but
        // the accelerations to a much lower speed leave the contour, too (`du a M2 / 2`): each of several corners
        // within reach would then slow down the others.
        let slope = m1 * mark.jump;
        let stays = demands.tried[b].is_some_and(|e| excess > WITHOUT_EFFECT * e);
        demands.repeats[b] = if stays { demands.repeats[b] + 1 } else { 0 };
        demands.tried[b] = Some(excess);
        let step = (excess + AIM * tolerance) / slope;
        let lowered = now - step * f64::from(hurry(demands.repeats[b]));
        // at a harmless speed the accelerations next to the corner are the cause
        if lowered > (0.03 * now).max(harmless(trial, tolerance)) {
            demands.cap[b] = demands.cap[b].min(lowered);
        } else {
            (demands.cap[b], demands.stop[b]) = (0.0, Some(0));
            demands.repeats[b] = 0;
        }
    }

    /// Lowers the feed of a block to the even speed in mm/s found for it.
    fn slow_down(
        &self,
        b: usize,
        queued: &Queued,
        (excess, tolerance): (f64, f64),
        even: f64,
        all: bool,
        demands: &mut Demands,
    ) {
        let kernels = self.trial.kernels;
        // on a straight block with equal kernels only starts and stops leave the contour
        let starts_only = kernels.overshoot && !kernels.unequal;
        if queued.bend <= 0.0 && starts_only && !even.is_finite() {
            return;
        }
        let hasty = if all { HASTE * even } else { even };
        demands.feed[b] = demands.feed[b].min(hasty.max(harmless(self.trial, tolerance)));
        let (repeats, before) = demands.slower[b];
        let stays = excess > WITHOUT_EFFECT * before;
        demands.slower[b] = (if stays { repeats + 1 } else { 0 }, excess);
    }

    /// A lower share of the acceleration for a block whose starts and stops overshoot; `now`: the present one.
    fn softened(
        &self,
        b: usize,
        queued: &Queued,
        (excess, tolerance): (f64, f64),
        all: bool,
        now: f64,
    ) -> f64 {
        let haste = if all { 0.7 } else { 1.0 };
        let ratio = haste * 0.99 * tolerance / (tolerance + excess);
        let gentle = self.gentle_ratio(b, queued, tolerance);
        if now >= 1.0 {
            ratio.min(2.0 * gentle)
        } else {
            // a start and a stop that overlap may share the tolerance; a further reduction does not help
            (now * ratio.max(0.3)).max(now.min(LEAST_SHARE * gentle))
        }
    }

    /// Share of the acceleration with which a single start or stop on the block keeps the tolerance.
    fn gentle_ratio(&self, block: usize, queued: &Queued, tolerance: f64) -> f64 {
        let kernels = self.trial.kernels;
        let v = self.peak_of(block);
        let a = 0.5 * v * v / queued.slope.down_distance(v, 0.0);
        let axes = 0..queued.ends.tangent_in.len();
        let gentlest = axes
            .filter_map(|i| {
                let kernel = kernels.get(i).filter(|k| k.has_negative_taps())?;
                let share = if queued.bend > 0.0 { 1.0 } else { queued.ends.tangent_in[i].abs() };
                let seconds = self.trial.cycle.seconds();
                Some(gentle(kernel, seconds, (v, queued.length), a, tolerance / share.max(1e-9)))
            })
            .fold(a, f64::min);
        gentlest / a
    }
}

/// Stretches of a block with the speed that the tolerance permits on each: by curvature and, where the delays of the
/// axes differ, by direction.
fn stretches(trial: &Trial<'_>, queued: &Queued, tolerance: f64) -> Vec<Stretch> {
    let fastest = queued.velocity.v_mm_s;
    let mut out = Vec::new();
    let mut from = 0.0;
    for (end, bend) in queued.bends() {
        let speed = trial.kernels.speed_on_bend(bend, tolerance, trial.cycle).min(fastest);
        let parts = if trial.kernels.unequal { turns(bend, end - from) } else { 1 };
        for i in 1..=parts {
            let until = from + (end - from) * f64::from(i) / f64::from(parts);
            out.push(Stretch { end: until, bend, speed });
        }
        from = end;
    }
    if trial.kernels.unequal {
        let mut tangent = AxisVec::zeros(queued.ends.tangent_in.len());
        let mut at = |s: f64| {
            queued.block.path.tangent(queued.offset + s, &mut tangent);
            trial.kernels.speed_along(&tangent, tolerance, trial.cycle)
        };
        let mut before = at(0.0);
        for stretch in &mut out {
            let after = at(stretch.end);
            stretch.speed = stretch.speed.min(before).min(after);
            before = after;
        }
    }
    out
}

/// The length in mm at either end of an arc within which the blocks beside it act, if the rest of it is at least as long: a speed
/// that they require does not limit all of it. `None` for other blocks, for parts of arcs, and where every change of speed takes
/// full ramp times.
fn ends_apart(trial: &Trial<'_>, queued: &Queued, tolerance: f64) -> Option<f64> {
    let is_whole = !queued.goes_on && queued.offset <= 0.0;
    let is_arc = matches!(queued.block.path, Path::Arc(_) | Path::Tilted(_))
        && !queued.block.slope.keeps_ramp_times();
    let on_bend = trial.kernels.speed_on_bend(queued.bend, tolerance, trial.cycle);
    let v = on_bend.min(queued.velocity.v_mm_s);
    let held_mm = v * f64::from(trial.kernels.length()) * trial.cycle.seconds();
    // what leaves the contour before or after the block is due to as much again
    let reach_mm = if queued.block.tolerance.ax_dev_mm.is_some() { held_mm } else { 2.0 * held_mm };
    let fits = reach_mm > 0.0 && 2.0 * reach_mm + held_mm <= queued.length;
    (is_whole && is_arc && !trial.kernels.unequal && fits).then_some(reach_mm)
}

/// Speed in mm/s at which the tolerance cannot be exceeded: the path within the filters is then shorter than the
/// tolerance, and the set point is a mean over it. Slower blocks are not to blame.
fn harmless(trial: &Trial<'_>, tolerance: f64) -> f64 {
    let gain = |k: &Kernel| k.taps().iter().map(|t| t.weight.abs()).sum::<f64>();
    let gain = trial.kernels.axes.iter().flatten().map(|k| gain(k)).fold(1.0, f64::max);
    let held_s = f64::from(trial.kernels.length().max(1)) * trial.cycle.seconds();
    0.5 * tolerance / (gain * held_s)
}

/// Keeps the larger excess.
fn note(slot: &mut Option<(f64, f64)>, (excess, tolerance): (f64, f64)) {
    if slot.is_none_or(|(e, _)| e < excess) {
        *slot = Some((excess, tolerance));
    }
}
