//! Tolerance monitoring (`AX_DEV`): the filtered setpoints of a plan, before it becomes final.
//!
//! A kernel `h_k` (weights positive, sum 1, mean delay `d`) cuts a corner: an axis whose velocity jumps by `dv` gets the
//! delay-aligned error `dv * M1`, `M1` half the mean absolute deviation of the kernel (TF5250 gives the task, the formula
//! is derived). Acceleration
//! near the corner and neighbouring corners add to it, so the closed form alone promises nothing.
//!
//! The promise is kept by trying: every plan is sampled on the cycle grid, filtered and measured against the contour,
//! exactly as the trace will be. Where it exceeds the tolerance, the speed of the corners (or curves) that cause it is
//! lowered by the closed form, and the window is planned again. A corner that is still too coarse at a full stop dwells
//! for as many cycles as needed, at most the length of the kernel, when nothing is left of the error. Kernels with
//! negative weights (windowed sinc) swing beyond the end even there, and no dwell helps; the blocks on both sides start
//! and stop with a lower acceleration, see [`crate::overshoot`].

use crate::axis::AxisVec;
use crate::contour::Contour;
use crate::overshoot::gentle;
use crate::queue::Queued;
use crate::timeline::{PathState, Reader, Timeline};
use kontur_filters::kernel::Kernel;
use kontur_filters::time::CycleTime;
use std::borrow::Cow;
use std::collections::VecDeque;
use std::sync::Arc;

/// Part of the tolerance kept in hand, in mm: two digits below the last one of a trace.
const MARGIN_MM: f64 = 2e-7;
/// Part of the tolerance by which a correction aims below it, so that the search ends.
const AIM: f64 = 0.003;
/// How far behind the kernel a block may have been left and still count as within reach, in cycles: nobody can tell
/// from a trace on which side of a sample a border lies.
const BORDER_CYCLES: f64 = 5.0;
/// Entries whose blocks begin closer together than this, in mm of path length, belong to the same block.
const SAME_START_MM: f64 = 1e-9;
/// Rounds of planning after which the causes of an excess stop and dwell for the whole kernel.
const ROUNDS_OF_SPEED: usize = 32;
/// Rounds of planning after which the tolerance is given up with a message.
const ROUNDS: usize = 60;

/// The filter kernels of the axes of a channel.
#[derive(Clone, Debug, Default)]
pub struct Kernels {
    axes: Vec<Option<Arc<Kernel>>>,
    /// A kernel with negative weights overshoots where the path starts and stops, straight blocks included.
    overshoot: bool,
    /// Not all axes have the same kernel.
    unequal: bool,
}

impl Kernels {
    /// One kernel per axis, `None` without one.
    pub fn new(axes: Vec<Option<Arc<Kernel>>>) -> Self {
        let mut taps = axes.iter().flatten().flat_map(|k| k.taps());
        let overshoot = taps.any(|tap| tap.weight < 0.0);
        let unequal = axes.windows(2).any(|pair| pair[0] != pair[1]);
        Self { axes, overshoot, unequal }
    }

    /// True if any axis has a kernel.
    pub fn any(&self) -> bool {
        self.axes.iter().any(Option::is_some)
    }

    /// Cycles until every axis is constant after the path has come to rest.
    pub fn length(&self) -> u32 {
        self.axes.iter().flatten().map(|k| k.length()).max().unwrap_or(0)
    }

    fn get(&self, i: usize) -> Option<&Kernel> {
        self.axes.get(i).and_then(|k| k.as_deref())
    }
}

/// A block whose tolerance could not be kept.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unkept {
    /// Number of the block.
    pub seq: u64,
    /// Deviation that is left in mm.
    pub deviation_mm: f64,
    /// Tolerance in mm.
    pub tolerance_mm: f64,
}

/// What the monitor asks of the next plan, one entry per boundary or block of the window.
#[derive(Clone, Debug)]
pub(crate) struct Demands {
    /// Velocity cap at each boundary.
    pub(crate) cap: Vec<f64>,
    /// Full stop at the boundary with this many cycles of dwell.
    pub(crate) stop: Vec<Option<u32>>,
    /// Velocity cap of each block.
    pub(crate) feed: Vec<f64>,
    /// Part of its acceleration that each block may use.
    acceleration: Vec<f64>,
    /// Speed and excess at each boundary when it was last found too fast.
    tried: Vec<Option<(f64, f64)>>,
}

impl Demands {
    pub(crate) fn none(blocks: usize) -> Self {
        Self {
            cap: vec![f64::INFINITY; blocks + 1],
            stop: vec![None; blocks + 1],
            feed: vec![f64::INFINITY; blocks],
            acceleration: vec![1.0; blocks],
            tried: vec![None; blocks + 1],
        }
    }

    /// The blocks with the acceleration that is left to them.
    pub(crate) fn soften<'a>(&self, window: &'a [Arc<Queued>]) -> Cow<'a, [Arc<Queued>]> {
        if self.acceleration.iter().all(|ratio| *ratio >= 1.0) {
            return Cow::Borrowed(window);
        }
        let soften = |(queued, ratio): (&Arc<Queued>, &f64)| {
            if *ratio >= 1.0 {
                return Arc::clone(queued);
            }
            let mut soft = Queued::clone(queued);
            soft.slope = soft.slope.scaled(*ratio);
            Arc::new(soft)
        };
        Cow::Owned(window.iter().zip(&self.acceleration).map(soften).collect())
    }
}

/// Raw setpoints of the last cycles, with the path length.
#[derive(Clone, Debug, Default)]
pub(crate) struct Monitor {
    history: VecDeque<(AxisVec, f64)>,
    length: usize,
}

/// A block entered in a plan.
struct Mark {
    cycles: f64,
    /// Index of the boundary in the window; `None` if it can no longer change.
    boundary: Option<usize>,
    /// Index of the block in the window; `None` if it is final.
    block: Option<usize>,
    queued: Arc<Queued>,
    /// Path length at the start of the block.
    s_mm: f64,
    /// Highest speed planned for it in mm/s.
    speed: f64,
    /// Largest jump of direction of an axis with a kernel, and that axis.
    jump: f64,
    axis: usize,
}

/// What exceeded the tolerance in one round.
struct Findings {
    /// Part of the largest cause from which on a cause is blamed.
    share: f64,
    /// Largest excess in mm blamed on each boundary.
    corner: Vec<f64>,
    /// Largest excess in mm and tolerance blamed on each block.
    curve: Vec<Option<(f64, f64)>>,
    worst: Option<Unkept>,
}

/// A plan under examination.
pub(crate) struct Trial<'a> {
    /// What is final and the plan behind it.
    pub(crate) timeline: &'a Timeline,
    /// Entries of the timeline that are final.
    pub(crate) placed: usize,
    pub(crate) window: &'a [Arc<Queued>],
    pub(crate) past: &'a Contour,
    pub(crate) kernels: &'a Kernels,
    pub(crate) cycle: CycleTime,
    /// Last cycle that was output.
    pub(crate) now: u64,
    /// The path is at rest where the plan starts: the start can wait.
    pub(crate) at_rest: bool,
}

impl Monitor {
    /// The path rests at `position`; the kernels reach `length` cycles back.
    pub(crate) fn rest(&mut self, position: &AxisVec, s_mm: f64, length: u32) {
        self.length = length as usize + 1;
        self.history = std::iter::repeat_n((position.clone(), s_mm), self.length).collect();
    }

    /// Takes the setpoint of a cycle.
    pub(crate) fn record(&mut self, position: &AxisVec, s_mm: f64) {
        if self.length > 1 {
            self.history.push_back((position.clone(), s_mm));
            if self.history.len() > self.length {
                self.history.pop_front();
            }
        }
    }

    /// Examines a plan. `None`: it keeps the tolerance. Otherwise the demands are tightened (`Ok`), or, after too many
    /// rounds, given up (`Err`); the largest excess comes back.
    pub(crate) fn examine(
        &self,
        trial: &Trial<'_>,
        round: usize,
        demands: &mut Demands,
    ) -> Option<Result<Unkept, Unkept>> {
        let marks = marks(trial);
        // after many rounds every corner and curve in reach counts as a cause
        let share = if round < ROUNDS_OF_SPEED { 0.5 } else { 0.0 };
        let findings = self.search(trial, &marks, share);
        let worst = findings.worst?;
        if round >= ROUNDS {
            return Some(Err(worst));
        }
        self.tighten(trial, &marks, &findings, round, demands);
        Some(Ok(worst))
    }

    fn position(&self, k: u64, reader: &mut Reader<'_>, trial: &Trial<'_>, state: &mut PathState) {
        if k > trial.now {
            reader.state(k, trial.cycle, state);
        } else {
            let back = (trial.now - k) as usize;
            let i = self.history.len().saturating_sub(1 + back);
            if let Some((position, s)) = self.history.get(i) {
                state.position.copy_from_slice(position);
                state.s = *s;
            }
        }
    }

    /// Measures every cycle whose kernel support holds a corner or a curve.
    fn search(&self, trial: &Trial<'_>, marks: &[Mark], share: f64) -> Findings {
        let reach = u64::from(trial.kernels.length());
        let mut findings = Findings {
            share,
            corner: vec![0.0; trial.window.len() + 1],
            curve: vec![None; trial.window.len()],
            worst: None,
        };
        let contour = contour(marks);
        let mut buffer = Buffer::new(trial);
        let mut next = trial.now + 1;
        for (m, mark) in marks.iter().enumerate() {
            let bent = mark.queued.bend > 0.0 || trial.kernels.unequal || trial.kernels.overshoot;
            if mark.jump <= 1e-9 && !bent {
                continue;
            }
            // the entry, what lies between, and the way out of the kernels' reach
            let entered = mark.cycles.ceil() as u64 + reach;
            let until = marks.get(m + 1).map_or_else(|| rest_tick(trial), |n| n.cycles);
            let left = (until.ceil() as u64).max(entered);
            let parts = if bent { [entered, left, left + reach] } else { [entered; 3] };
            next = next.max(mark.cycles.floor() as u64 + 1);
            for last in parts {
                let calm = !trial.kernels.unequal && !trial.kernels.overshoot;
                if next > last || (calm && quiet(trial, marks, next, last)) {
                    next = next.max(last + 1);
                    continue;
                }
                buffer.seek(self, trial, next);
                for k in next..=last {
                    buffer.step(self, trial, k);
                    Self::judge(trial, marks, &contour, k, &buffer, &mut findings);
                }
                next = last + 1;
            }
        }
        findings
    }

    fn judge(
        trial: &Trial<'_>,
        marks: &[Mark],
        contour: &Contour,
        k: u64,
        buffer: &Buffer<'_>,
        findings: &mut Findings,
    ) {
        let reach = f64::from(trial.kernels.length());
        let (from, to) = (k as f64 - reach, k as f64);
        let Some(tolerance) = contour
            .between(from, to)
            .filter_map(|p| p.queued.block.tolerance.ax_dev_mm)
            .min_by(f64::total_cmp)
        else {
            return;
        };
        let deviation = contour.worst_component(&buffer.set, from, to, BORDER_CYCLES);
        let excess = deviation - (tolerance - MARGIN_MM.min(0.1 * tolerance));
        if excess <= 0.0 {
            return;
        }
        let first = marks.partition_point(|m| m.cycles <= from).saturating_sub(1);
        let last = marks.partition_point(|m| m.cycles <= to);
        let support = &marks[first..last];
        if findings.worst.is_none_or(|w| w.deviation_mm < deviation) {
            let seq = support.last().map_or(0, |m| m.queued.block.seq);
            findings.worst = Some(Unkept { seq, deviation_mm: deviation, tolerance_mm: tolerance });
        }
        // shares of the error by geometry: a corner with both its legs in the kernel's reach, the sagitta of a curve
        let (oldest, newest) = buffer.stretch();
        let share = |i: usize| -> (f64, f64) {
            let m = &support[i];
            let end = support.get(i + 1).map_or(newest, |next| next.s_mm.min(newest));
            let inside = (end - m.s_mm.max(oldest)).max(0.0);
            let legs = (m.s_mm - oldest).min(newest - m.s_mm).max(0.0);
            (0.5 * m.jump * legs, 0.125 * m.queued.bend * inside * inside)
        };
        let largest = (0..support.len()).map(share).fold(0.0_f64, |x, (a, b)| x.max(a).max(b));
        let mut blamed = false;
        for (i, m) in support.iter().enumerate() {
            let (corner, curve) = share(i);
            if let Some(b) =
                m.boundary.filter(|_| corner > 0.0 && corner >= findings.share * largest)
            {
                findings.corner[b] = findings.corner[b].max(excess);
                blamed = true;
            }
            if let Some(b) = m.block.filter(|_| curve > 0.0 && curve >= findings.share * largest) {
                note(&mut findings.curve[b], excess, tolerance);
                blamed = true;
            }
        }
        // a cause in front of a stop is final already, but what follows the stop can wait for the filters
        let waits = (0..support.len()).any(|i| support[i].boundary == Some(0) && i > 0)
            && (0..support.len()).any(|i| {
                let (corner, curve) = share(i);
                support[i].block.is_none() && corner.max(curve) >= findings.share * largest
            });
        if waits {
            findings.corner[0] = findings.corner[0].max(excess);
            blamed = true;
        }
        // kernels that differ between the axes, or a cause that is final already: slow down what still can be
        if !blamed {
            for m in support {
                if let Some(b) = m.block {
                    note(&mut findings.curve[b], excess, tolerance);
                }
            }
        }
    }

    fn tighten(
        &self,
        trial: &Trial<'_>,
        marks: &[Mark],
        findings: &Findings,
        round: usize,
        demands: &mut Demands,
    ) {
        let full = trial.kernels.length();
        let mut soften = vec![None; trial.window.len()];
        for mark in marks {
            let Some(b) = mark.boundary else { continue };
            let excess = findings.corner[b];
            if excess <= 0.0 {
                continue;
            }
            let swings = trial.kernels.overshoot
                && demands.stop[b].is_some_and(|dwell| {
                    dwell == full || !self.full_dwell_keeps(trial, marks, mark, dwell)
                });
            if swings {
                // what is left is the overshoot of the stop itself
                let tolerance = mark.queued.block.tolerance.ax_dev_mm.unwrap_or(0.0);
                if b > 0 {
                    note(&mut soften[b - 1], excess, tolerance);
                }
                note(&mut soften[b], excess, tolerance);
                continue;
            }
            if round >= ROUNDS_OF_SPEED {
                (demands.cap[b], demands.stop[b]) = (0.0, Some(full));
                continue;
            }
            let resting = demands.stop[b].or((b == 0).then_some(0));
            if let Some(dwell) = resting {
                // in small steps, because neighbouring corners within reach share the error
                let needed = self.needed_dwell(trial, marks, mark, dwell);
                let step = (full / 8).max(1);
                demands.stop[b] = Some(needed.min(dwell + step).max(dwell + 1).min(full));
                continue;
            }
            let m1 =
                trial.kernels.get(mark.axis).map_or(1.0, Kernel::m1_cycles) * trial.cycle.seconds();
            let now = speed_at(trial, b);
            // the closed form is the steepest the error can fall with the speed; what the last step showed is better
            let steepest = m1 * mark.jump;
            let slope = demands.tried[b].map_or(steepest, |(v, e)| {
                let seen = (e - excess) / (v - now);
                if seen.is_finite() { seen } else { steepest }.clamp(0.25 * steepest, steepest)
            });
            demands.tried[b] = Some((now, excess));
            let tolerance = mark.queued.block.tolerance.ax_dev_mm.unwrap_or(0.0);
            let lowered = now - (excess + AIM * tolerance) / slope;
            if lowered > 0.03 * now {
                demands.cap[b] = demands.cap[b].min(lowered);
            } else {
                (demands.cap[b], demands.stop[b]) = (0.0, Some(0));
            }
        }
        for mark in marks {
            let Some(b) = mark.block else { continue };
            let queued = &trial.window[b];
            let haste = if round < ROUNDS_OF_SPEED { 1.0 } else { 0.7 };
            if let Some((excess, tolerance)) = findings.curve[b] {
                let left = tolerance / (tolerance + excess);
                if trial.kernels.overshoot {
                    note(&mut soften[b], excess, tolerance);
                }
                // on a straight block with equal kernels only starts and stops leave the contour
                if queued.bend > 0.0 || trial.kernels.unequal || !trial.kernels.overshoot {
                    // the deviation on a curve grows with the square of the speed
                    let ratio = haste * 0.999 * left.sqrt();
                    let floor = slowest(trial, queued, tolerance);
                    let now = demands.feed[b].min(queued.velocity.0).min(mark.speed);
                    demands.feed[b] = (now * ratio.max(0.3)).max(floor.min(now));
                }
            }
            if let Some((excess, tolerance)) = soften[b] {
                let now = demands.acceleration[b];
                let mut ratio = haste * 0.99 * tolerance / (tolerance + excess);
                if now >= 1.0 {
                    ratio = ratio.min(2.0 * gentle_ratio(trial, mark, queued, tolerance));
                } else {
                    ratio = ratio.max(0.3);
                }
                demands.acceleration[b] = now * ratio;
            }
        }
    }

    /// Least dwell at a stop that keeps the tolerance as far as this corner is concerned, by bisection.
    fn needed_dwell(&self, trial: &Trial<'_>, marks: &[Mark], mark: &Mark, dwell: u32) -> u32 {
        let contour = contour(marks);
        let (mut low, mut high) = (dwell, trial.kernels.length());
        while high - low > 1 {
            let mid = low + (high - low) / 2;
            if self.keeps(trial, &contour, mark, dwell, mid) { high = mid } else { low = mid }
        }
        high
    }

    /// True if the corner keeps the tolerance once it dwells for the whole kernel.
    fn full_dwell_keeps(&self, trial: &Trial<'_>, marks: &[Mark], mark: &Mark, dwell: u32) -> bool {
        self.keeps(trial, &contour(marks), mark, dwell, trial.kernels.length())
    }

    /// True if `cycles` of dwell in place of `dwell` keep the tolerance at a stop.
    fn keeps(
        &self,
        trial: &Trial<'_>,
        contour: &Contour,
        mark: &Mark,
        dwell: u32,
        cycles: u32,
    ) -> bool {
        let start = mark.cycles.round() as u64;
        let rest = start.saturating_sub(u64::from(dwell));
        let full = trial.kernels.length();
        let tolerance = mark.queued.block.tolerance.ax_dev_mm.unwrap_or(f64::INFINITY);
        let (from, to) = (rest as f64 - f64::from(full), start as f64 + f64::from(full));
        let mut buffer = Buffer::new(trial);
        buffer.fill(self, trial, rest);
        let mut vector = AxisVec::zeros(buffer.set.len());
        (rest..=rest + u64::from(cycles + full)).all(|k| {
            // before the rest as planned, behind it as planned after the present dwell
            let behind = k.saturating_sub(rest + u64::from(cycles));
            buffer.step(self, trial, if behind > 0 { start + behind } else { k.min(rest) });
            contour.deviation(&buffer.set, from, to, &mut vector);
            vector.iter().all(|c| c.abs() <= tolerance - MARGIN_MM.min(0.1 * tolerance))
        })
    }
}

/// True if no set point of the cycles `first..=last` can leave the contour by half the tolerance.
///
/// A set point is a mean of points of the path with positive weights (not so with kernels that overshoot). Expanded
/// around their mean path length the linear part lies on the path, and what is left of an axis is at most `bend / 2`
/// times the variance of the path length, itself at most a quarter of the stretch squared (derived).
fn quiet(trial: &Trial<'_>, marks: &[Mark], first: u64, last: u64) -> bool {
    let reach = f64::from(trial.kernels.length());
    let begin = marks.partition_point(|m| m.cycles <= first as f64 - reach - 1.0).saturating_sub(1);
    let end = marks.partition_point(|m| m.cycles <= last as f64);
    let (mut bend, mut speed, mut tolerance) = (0.0_f64, 0.0_f64, f64::INFINITY);
    for (i, m) in marks[begin..end].iter().enumerate() {
        if i > 0 && m.jump > 1e-9 {
            return false;
        }
        bend = bend.max(m.queued.bend);
        speed = speed.max(m.speed);
        tolerance = tolerance.min(m.queued.block.tolerance.ax_dev_mm.unwrap_or(f64::INFINITY));
    }
    let stretch = speed * trial.cycle.seconds() * reach;
    let axes = trial.kernels.axes.len() as f64;
    axes.sqrt() * bend * stretch * stretch / 8.0 < 0.5 * tolerance
}

/// A fiftieth of the speed at which a curve alone uses up the tolerance: slower is never needed.
fn slowest(trial: &Trial<'_>, queued: &Queued, tolerance: f64) -> f64 {
    let variance = (0..queued.ends.tangent_in.len())
        .filter_map(|i| trial.kernels.get(i))
        .map(Kernel::variance_cycles2)
        .fold(0.0, f64::max);
    let t = trial.cycle.seconds();
    let bend = queued.bend.max(1e-6);
    0.02 * (2.0 * tolerance / (variance * t * t * bend)).sqrt()
}

/// Part of the acceleration with which a lone start or stop on the block keeps the tolerance.
fn gentle_ratio(trial: &Trial<'_>, mark: &Mark, queued: &Queued, tolerance: f64) -> f64 {
    let v = mark.speed;
    let a = 0.5 * v * v / queued.slope.down_distance(v, 0.0);
    let axes = 0..queued.ends.tangent_in.len();
    let gentlest = axes
        .filter_map(|i| {
            let kernel = trial.kernels.get(i).filter(|k| k.has_negative_taps())?;
            let share = if queued.bend > 0.0 { 1.0 } else { queued.ends.tangent_in[i].abs() };
            let seconds = trial.cycle.seconds();
            Some(gentle(kernel, seconds, (v, queued.length), a, tolerance / share.max(1e-9)))
        })
        .fold(a, f64::min);
    gentlest / a
}

fn note(slot: &mut Option<(f64, f64)>, excess: f64, tolerance: f64) {
    if slot.is_none_or(|(e, _)| e < excess) {
        *slot = Some((excess, tolerance));
    }
}

fn rest_tick(trial: &Trial<'_>) -> f64 {
    trial.timeline.entries().last().map_or(trial.now as f64, |e| e.end.cycles(trial.cycle))
}

/// Planned speed at a boundary of the window.
fn speed_at(trial: &Trial<'_>, boundary: usize) -> f64 {
    let mut index = 0;
    for e in trial.timeline.entries().skip(trial.placed) {
        if boundary < index + e.blocks.len() {
            let s = if boundary == index { 0.0 } else { e.blocks[boundary - index - 1].1 };
            return e.profile.at(e.profile.time_at(s)).v_mm_s;
        }
        index += e.blocks.len();
    }
    0.0
}

fn contour(marks: &[Mark]) -> Contour {
    let mut contour = Contour::default();
    for m in marks {
        contour.enter(m.cycles, m.s_mm, Arc::clone(&m.queued));
    }
    contour
}

/// Blocks that are within reach already, then those of the plan.
fn marks(trial: &Trial<'_>) -> Vec<Mark> {
    let reach = f64::from(trial.kernels.length());
    let mut out: Vec<Mark> = Vec::with_capacity(trial.window.len() + 8);
    let mut add = |cycles: f64, queued: &Arc<Queued>, block: Option<usize>, s: f64, speed: f64| {
        let (mut jump, mut axis) = (0.0, 0);
        // the rest of a block goes on without a corner
        let start = s - queued.offset;
        let goes_on = |m: &Mark| (m.s_mm - m.queued.offset - start).abs() < SAME_START_MM;
        if let Some(before) = out.last().filter(|m| !goes_on(m)) {
            let (a, b) = (&before.queued.ends.tangent_out, &queued.ends.tangent_in);
            for i in 0..a.len() {
                let du = (b[i] - a[i]).abs();
                if du > jump && trial.kernels.get(i).is_some() {
                    (jump, axis) = (du, i);
                }
            }
        }
        let axis = if jump > 0.0 { axis } else { widest(trial.kernels) };
        // at the start of the path itself only a wait is possible
        let boundary = block.filter(|b| *b > 0 || trial.at_rest);
        let queued = Arc::clone(queued);
        out.push(Mark { cycles, boundary, block, queued, s_mm: s, speed, jump, axis });
    };
    let now = trial.now as f64;
    for passed in trial.past.between(now - reach - BORDER_CYCLES - 1.0, f64::INFINITY) {
        let queued = &passed.queued;
        add(passed.cycles, queued, None, passed.s_mm, queued.velocity.0);
    }
    let mut index = 0;
    for entry in trial.timeline.entries().skip(trial.placed) {
        for (cycles, s, queued) in entry.entries(trial.cycle) {
            add(cycles, queued, Some(index), s, entry.profile.peak());
            index += 1;
        }
    }
    out
}

/// Axis with the longest kernel.
fn widest(kernels: &Kernels) -> usize {
    let length = |i: &usize| kernels.get(*i).map_or(0, Kernel::length);
    (0..kernels.axes.len()).max_by_key(length).unwrap_or(0)
}

/// Raw positions in reach of the kernels, and the set point they give.
struct Buffer<'a> {
    reader: Reader<'a>,
    kernels: &'a Kernels,
    ring: Vec<AxisVec>,
    s_mm: Vec<f64>,
    head: usize,
    state: PathState,
    set: AxisVec,
    /// The cycle behind the last one taken.
    next: Option<u64>,
}

impl<'a> Buffer<'a> {
    fn new(trial: &Trial<'a>) -> Self {
        let n = trial.window.first().map_or(0, |q| q.block.path.start().len());
        let zero = AxisVec::zeros(n);
        let size = trial.kernels.length() as usize + 1;
        Self {
            reader: trial.timeline.reader(),
            kernels: trial.kernels,
            ring: vec![zero.clone(); size],
            s_mm: vec![0.0; size],
            head: 0,
            state: PathState { position: zero.clone(), ..PathState::default() },
            set: zero,
            next: None,
        }
    }

    /// Makes `first` the next cycle to take.
    fn seek(&mut self, monitor: &Monitor, trial: &Trial<'_>, first: u64) {
        if self.next != Some(first) {
            self.fill(monitor, trial, first);
        }
    }

    /// Loads the cycles before `first`.
    fn fill(&mut self, monitor: &Monitor, trial: &Trial<'_>, first: u64) {
        for back in (1..self.ring.len() as u64).rev() {
            self.take(monitor, trial, first.saturating_sub(back));
        }
    }

    fn take(&mut self, monitor: &Monitor, trial: &Trial<'_>, k: u64) {
        monitor.position(k, &mut self.reader, trial, &mut self.state);
        self.head = (self.head + 1) % self.ring.len();
        self.ring[self.head].copy_from_slice(&self.state.position);
        self.s_mm[self.head] = self.state.s;
        self.next = Some(k + 1);
    }

    /// Takes cycle `k` and filters.
    fn step(&mut self, monitor: &Monitor, trial: &Trial<'_>, k: u64) {
        self.take(monitor, trial, k);
        let size = self.ring.len();
        for i in 0..self.set.len() {
            let x = self.ring[self.head][i];
            self.set[i] = match self.kernels.get(i) {
                None => x,
                Some(kernel) => {
                    let mut y = 0.0;
                    for tap in kernel.taps() {
                        let at = (self.head + size - tap.delay as usize) % size;
                        y += tap.weight * (self.ring[at][i] - x);
                    }
                    x + y
                }
            };
        }
    }

    /// Path lengths of the oldest and the newest setpoint in reach.
    fn stretch(&self) -> (f64, f64) {
        (self.s_mm[(self.head + 1) % self.s_mm.len()], self.s_mm[self.head])
    }
}
