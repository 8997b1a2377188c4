//! Measures a plan: where it exceeds the tolerance, and what causes it.

use super::tighten::on_a_bend;
use super::view::{Buffer, Mark, View};
use super::{BORDER_CYCLES, Demands, MARGIN_MM, Unkept};
use crate::timeline::{PathState, Reader};
use kontur_filters::kernel::Kernel;

/// Part of the tolerance that a corner has to use up to be slowed down in place of the curves beside it: less than that
/// the curves give up easier.
const LEAST_PART: f64 = 0.25;

/// What exceeded the tolerance in one round.
pub(super) struct Findings {
    /// Part of the largest cause from which on a cause is blamed.
    pub(super) share: f64,
    /// Largest excess in mm blamed on each boundary.
    pub(super) corner: Vec<f64>,
    /// Largest excess in mm and tolerance blamed on each block.
    pub(super) curve: Vec<Option<(f64, f64)>>,
    pub(super) worst: Option<Unkept>,
}

impl View<'_> {
    /// Measures every cycle whose kernel support holds a corner or a curve.
    pub(super) fn search(&self, share: f64, demands: &Demands) -> Findings {
        let Self { trial, marks, .. } = self;
        let reach = u64::from(trial.kernels.length());
        let mut findings = Findings {
            share,
            corner: vec![0.0; trial.window.len() + 1],
            curve: vec![None; trial.window.len()],
            worst: None,
        };
        let mut buffer = Buffer::new(self);
        let mut reader = trial.timeline.reader();
        let calm = !trial.kernels.unequal && !trial.kernels.overshoot;
        let mut next = trial.now + 1;
        for (m, mark) in marks.iter().enumerate() {
            let bent = mark.queued.bend > 0.0 || trial.kernels.unequal || trial.kernels.overshoot;
            if mark.jump <= 1e-9 && !bent {
                continue;
            }
            // the entry, what lies between, and the way out of the kernels' reach
            let entered = mark.cycles.ceil() as u64 + reach;
            let until = marks.get(m + 1).map_or_else(|| self.rest(), |n| n.cycles);
            let left = (until.ceil() as u64).max(entered);
            let parts = if bent { [entered, left, left + reach] } else { [entered; 3] };
            next = next.max(mark.cycles.floor() as u64 + 1);
            for last in parts {
                while next <= last {
                    let until = last.min(next + reach);
                    if calm && self.quiet(next, until, &mut reader) {
                        next = until + 1;
                        continue;
                    }
                    buffer.seek(next);
                    for k in next..=until {
                        buffer.step(k);
                        self.judge(k, &buffer, demands, &mut findings);
                    }
                    next = until + 1;
                }
            }
        }
        findings
    }

    fn judge(&self, k: u64, buffer: &Buffer<'_>, demands: &Demands, findings: &mut Findings) {
        let Self { trial, marks, contour, .. } = self;
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
        // shares of the error by geometry: a corner with its shorter leg in the kernel's reach, and a curve as many small
        // corners; over the whole reach that is the sagitta
        let (oldest, newest) = buffer.stretch();
        let leg = |s: f64| (s - oldest).min(newest - s).max(0.0);
        let share = |i: usize| -> (f64, f64) {
            let m = &support[i];
            let (mut from, mut turn) = (m.s_mm, 0.0);
            for (end, bend) in m.queued.bends() {
                let to = m.s_mm + end;
                turn += bend * legs(from, to, (oldest, newest));
                from = to;
            }
            (0.5 * m.jump * leg(m.s_mm), 0.5 * turn)
        };
        let largest = (0..support.len()).map(share).fold(0.0_f64, |x, (a, b)| x.max(a).max(b));
        let mut blamed = false;
        // a corner that is alone to blame is slowed down alone, not the curve beside it
        let alone = |m: &Mark| {
            m.boundary.is_some_and(|b| self.is_alone_to_blame(m, b, support, demands, excess))
        };
        for b in support.iter().filter(|m| alone(m)).filter_map(|m| m.boundary) {
            findings.corner[b] = findings.corner[b].max(excess);
            blamed = true;
        }
        let others = if blamed { &[] } else { support };
        for (i, m) in others.iter().enumerate() {
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

    /// True if a corner next to curves that keep the tolerance by themselves explains an excess, by the closed forms, or
    /// if it rests already but does not dwell for the whole kernel.
    fn is_alone_to_blame(
        &self,
        corner: &Mark,
        boundary: usize,
        support: &[Mark],
        demands: &Demands,
        excess: f64,
    ) -> bool {
        let Self { trial, .. } = self;
        let tolerance = corner.queued.block.tolerance.ax_dev_mm.unwrap_or(f64::INFINITY);
        let curves = || support.iter().filter(|m| m.queued.bend > 0.0);
        let calm = |m: &Mark| {
            let speed = m.speed.min(m.block.map_or(f64::INFINITY, |b| demands.feed[b]));
            speed <= on_a_bend(trial, m.queued.bend, tolerance)
        };
        if boundary == 0 || curves().next().is_none() || !curves().all(calm) {
            return false;
        }
        if let Some(dwell) = demands.stop[boundary] {
            return dwell < trial.kernels.length();
        }
        let m1 = trial.kernels.get(corner.axis).map_or(0.0, Kernel::m1_cycles);
        let own = m1 * trial.cycle.seconds() * corner.jump * self.speed_at(boundary);
        own >= excess.max(LEAST_PART * tolerance)
    }

    /// True if no set point of the cycles `first..=last` can leave the contour by half the tolerance.
    ///
    /// A set point is a mean of points of the path with positive weights (not so with kernels that overshoot). Expanded
    /// around their mean path length the linear part lies on the path, and what is left of an axis is at most `bend / 2`
    /// times the variance of the path length, itself at most a quarter of the stretch squared (derived).
    fn quiet(&self, first: u64, last: u64, reader: &mut Reader<'_>) -> bool {
        let Self { trial, marks, .. } = self;
        let length = u64::from(trial.kernels.length());
        let reach = length as f64;
        let begin =
            marks.partition_point(|m| m.cycles <= first as f64 - reach - 1.0).saturating_sub(1);
        let end = marks.partition_point(|m| m.cycles <= last as f64);
        let support = &marks[begin..end];
        if support.iter().skip(1).any(|m| m.jump > 1e-9) {
            return false;
        }
        let mut state = PathState::at_rest(marks[begin].queued.block.path.start());
        let [from, to] = [first.saturating_sub(length + 1), last].map(|k| {
            self.state(k, reader, &mut state);
            state.s
        });
        let (mut bend, mut speed, mut tolerance) = (0.0_f64, 0.0_f64, f64::INFINITY);
        for m in support {
            bend = bend.max(m.queued.bend_between(from - m.s_mm, to - m.s_mm));
            speed = speed.max(m.speed);
            tolerance = tolerance.min(m.queued.block.tolerance.ax_dev_mm.unwrap_or(f64::INFINITY));
        }
        let stretch = (speed * trial.cycle.seconds() * reach).min(to - from);
        let axes = trial.kernels.axes.len() as f64;
        axes.sqrt() * bend * stretch * stretch / 8.0 < 0.5 * tolerance
    }
}

/// Integral over `from..=to` of the distance to the nearer end of a stretch, inside of it.
fn legs(from: f64, to: f64, (oldest, newest): (f64, f64)) -> f64 {
    let half = 0.5 * (newest - oldest);
    let below = |s: f64| {
        let x = (s - oldest).clamp(0.0, 2.0 * half);
        if x <= half {
            0.5 * x * x
        } else {
            half * half - 0.5 * (2.0 * half - x) * (2.0 * half - x)
        }
    };
    below(to) - below(from)
}

/// Keeps the larger excess.
pub(super) fn note(slot: &mut Option<(f64, f64)>, excess: f64, tolerance: f64) {
    if slot.is_none_or(|(e, _)| e < excess) {
        *slot = Some((excess, tolerance));
    }
}
