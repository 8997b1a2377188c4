//! The causes of a violation, and their demands on the next plan.
//!
//! Around the middle `s*` of what the filter of an axis holds, the path is a straight line plus its kinks and bends. A
//! kink at `s_b` with the change of direction `du` displaces the set point by `du E[(s - s_b)+]` (or `(s_b - s)+`
//! before the middle), with the mean `E` over the kernel: its *part* in the deviation (derived; exact for polygons). A
//! bend consists of many small kinks. A short filter may hold one set point before a corner and the next one after it,
//! and the segment between them cuts the corner: where a set point has no parts, those of the middle of its segment
//! count.
//!
//! One part that outweighs the others is an isolated corner: only its speed is lowered, down to a stop, to which a
//! dwell is then added. A bend next to a larger kink is slowed down only once the kink is no longer to blame. Similar
//! parts form a curve: they share one speed, that of the whole stretch between them, at which the stretch keeps the
//! tolerance when traversed at constant speed. Kinks further apart than the path travels at that speed while the filter
//! holds them are isolated again: it is faster to accelerate and brake between them. If a stretch exceeds the tolerance
//! at any speed, the starts and stops next to it are the cause (`du a M2 / 2`, whatever the speed): then the path
//! dwells at its ends.

use super::causes::{Case, Part};
use super::demands::{Demands, PATIENCE, hurry};
use super::even::{ALIKE, Evenly, aim, fastest};
use super::findings::Findings;
use super::marks::Mark;
use super::view::View;
use super::violation::{Record, Violation};
use crate::contour::SAME_START_MM;

/// Doublings from the first guess of a speed to the planned speed.
const DOUBLINGS: u32 = 4;
/// Ratio of two excesses up to which the second one is ignored.
const LITTLE_MORE: f64 = 1.05;
/// Smallest share of the planned speed that remains after one round.
const LEAST_OF_ROUND: f64 = 0.5;
/// Share of the planned speed from which on an even speed does not count as lower.
const ALMOST: f64 = 0.995;
/// Smallest factor by which one round reduces an even speed.
const MOST: f64 = 0.25;
/// Smallest even speed, as a share of the planned speed.
const LEAST: f64 = 2.5e-4;

/// Marks with a common speed: of their blocks, and (`kinks`) of their entries.
#[derive(Default)]
struct Shared {
    marks: Vec<usize>,
    kinks: Vec<usize>,
}

impl View<'_> {
    /// Attributes a violation to its causes; `all`: to everything that can still be changed.
    pub(super) fn blame(
        &self,
        v: &Violation,
        record: &Record,
        all: bool,
        demands: &Demands,
        findings: &mut Findings,
    ) {
        let Some(case) = self.case(v, record, demands) else { return };
        if self.is_known(&case, findings) {
            return;
        }
        let parts = self.causes(&case);
        let even = self.even_speed(&case);
        let (mut shared, blamed) = self.select(&case, &parts, even, findings);
        if !blamed || all {
            self.blame_the_rest(&case, &parts, all, &mut shared, findings);
        }
        if self.trial.kernels.unequal {
            self.turn_to_the_faster(&mut shared, &case, even);
        }
        self.share(&shared, &case, even, findings);
    }

    /// Whether the last violation of this kind had the same causes and was hardly smaller: in a slow run over the same blocks the same
    /// demand would be repeated many times. Where a straight line is divided does not matter.
    fn is_known(&self, case: &Case<'_>, findings: &mut Findings) -> bool {
        let Case { v, first, last, .. } = *case;
        let marks = &self.marks;
        let mut causes = (first..last)
            .filter(|m| *m > first && marks[*m].is_kink() || marks[*m].queued.bend > 0.0);
        let place = causes.next().map_or((0, 0), |m| (m, causes.next_back().unwrap_or(m)));
        let (told, excess) = (&mut findings.last[usize::from(v.missed.is_some())], v.excess());
        if told.is_some_and(|(at, most)| at == place && excess <= LITTLE_MORE * most) {
            return true;
        }
        *told = Some((place, excess));
        false
    }

    /// Notes the isolated corners among the largest parts, and returns the marks that share a speed, and whether there is anything to
    /// blame.
    fn select(
        &self,
        case: &Case<'_>,
        parts: &[Part],
        even: f64,
        findings: &mut Findings,
    ) -> (Shared, bool) {
        let (marks, stop) = (&self.marks, &case.demands.stop);
        let free = || parts.iter().filter(|p| self.is_free(p, case.demands));
        let largest = free().map(|p| p.size).fold(0.0, f64::max);
        let sharpest = free().filter(|p| !p.bend).map(|p| p.size).fold(0.0, f64::max);
        // a bend next to a larger kink is left alone until the kink is settled: it may be a long arc, which would stay
        // slow
        let counts = |p: &&Part| {
            p.size > 0.0 && p.size >= ALIKE * largest && !(p.bend && p.size <= sharpest)
        };
        let alike: Vec<&Part> = free().filter(counts).collect();
        let apart = even * f64::from(self.trial.kernels.length()) * self.trial.cycle.seconds();
        let isolated = |i: usize| -> bool {
            let p = alike[i];
            let near = |q: &&Part| (p.s - q.s).abs() <= apart;
            !p.bend
                && i.checked_sub(1).is_none_or(|b| !near(&alike[b]))
                && alike.get(i + 1).is_none_or(|q| !near(q))
        };
        // where the path already stops it can dwell longer, and between two stops a lower speed does not help
        let rests = |p: &Part| !p.bend && marks[p.mark].boundary.is_some_and(|b| stop[b].is_some());
        let mut shared = Shared::default();
        let mut blamed = false;
        for (i, part) in alike.iter().enumerate() {
            let m = &marks[part.mark];
            let Some(b) = (if part.bend { m.block } else { m.boundary }) else { continue };
            blamed = true;
            if part.bend {
                shared.marks.push(part.mark);
            } else if isolated(i) || rests(part) {
                findings.corner[b] = findings.corner[b].max(case.v.excess());
            } else {
                shared.kinks.push(part.mark);
            }
        }
        // the blocks between similar parts share their speed
        for pair in alike.windows(2) {
            if (pair[1].s - pair[0].s).abs() <= apart && !(rests(pair[0]) && rests(pair[1])) {
                shared.marks.extend(pair[0].mark..pair[1].mark);
            }
        }
        (shared, blamed)
    }

    /// A cause before a stop is already final, but the blocks after the stop can wait until the filters have let it pass. If they do
    /// not, or `all` is to blame, every block that the filters hold shares a speed.
    fn blame_the_rest(
        &self,
        case: &Case<'_>,
        parts: &[Part],
        all: bool,
        shared: &mut Shared,
        findings: &mut Findings,
    ) {
        let Case { v, record, demands, first, last } = *case;
        let marks = &self.marks;
        let fixed = |p: &&Part| marks[p.mark].block.is_none();
        let before = parts.iter().filter(fixed).map(|p| p.size).fold(0.0, f64::max);
        let waits = (all || before > 0.0)
            && marks[first..last].iter().any(|m| m.boundary == Some(0))
            && demands.stop[0].is_none_or(|dwell| dwell < self.trial.kernels.length());
        if waits {
            findings.corner[0] = findings.corner[0].max(v.excess());
        }
        if !waits || all {
            // after a long dwell the filters hold nothing of the block before it
            let held = record.s(self.oldest(v));
            let is_left =
                |m: &usize| marks.get(m + 1).is_some_and(|next| next.s_mm <= held + SAME_START_MM);
            shared.marks.extend((first..last).filter(|m| !is_left(m)));
        }
    }

    /// Where the delays differ, a straight block contributes to the deviation, too, in proportion to its speed: blocks
    /// faster than the even speed are to blame before the others.
    fn turn_to_the_faster(&self, shared: &mut Shared, case: &Case<'_>, even: f64) {
        let faster = |m: &usize| self.present(*m, case) > even / ALMOST;
        if !shared.marks.is_empty() && !shared.marks.iter().any(faster) {
            let faster: Vec<usize> = (case.first..case.last).filter(faster).collect();
            if !faster.is_empty() {
                *shared = Shared { marks: faster, kinks: Vec::new() };
            }
        }
    }

    /// Highest speed in mm/s on the block of a mark within the filters at a violation; 0 if it is final.
    fn present(&self, m: usize, case: &Case<'_>) -> f64 {
        let mark = &self.marks[m];
        let asked = mark.block.map_or(0.0, |b| case.demands.feed[b]);
        self.fastest(case, mark.s_mm, mark.s_mm + mark.queued.length).min(asked)
    }

    /// Demands one speed for a stretch: the even speed, or a lower one if that is not below the planned speed.
    fn share(&self, shared: &Shared, case: &Case<'_>, even: f64, findings: &mut Findings) {
        let Case { v, demands, .. } = *case;
        let marks = &self.marks;
        let at = |m: &usize, length: f64, asked: f64| {
            let s = marks[*m].s_mm;
            self.fastest(case, s, s + length).min(asked)
        };
        let blocks = shared.marks.iter().map(|m| {
            let asked = marks[*m].block.map_or(f64::INFINITY, |b| demands.feed[b]);
            at(m, marks[*m].queued.length, asked)
        });
        let kinks = shared.kinks.iter().map(|m| {
            let asked = marks[*m].boundary.map_or(f64::INFINITY, |b| demands.cap[b]);
            at(m, 0.0, asked)
        });
        let present = blocks.chain(kinks).fold(0.0, f64::max);
        let speed = if present <= 0.0 {
            // the path rests while the filters overshoot: the speed is not the cause
            f64::INFINITY
        } else if even < ALMOST * present {
            // a plan that is far too fast says little about the causes in a slower one
            even.max(LEAST_OF_ROUND * present)
        } else {
            // the speed is already even, or a change of speed is the cause
            let blocks = || shared.marks.iter().filter_map(|m| marks[*m].block);
            let repeats = blocks().map(|b| demands.slower[b].0).max().unwrap_or(0);
            if repeats >= PATIENCE {
                // starts and stops around the stretch are the cause, and these need not be slow
                let ends = [blocks().min(), blocks().max().map(|b| b + 1)];
                for b in ends.into_iter().flatten() {
                    findings.corner[b] = findings.corner[b].max(v.excess());
                }
            }
            let steps = hurry(repeats);
            let step = (aim(v.tolerance_mm) / v.deviation_mm).sqrt().min(0.995);
            present * libm::pow(step, f64::from(steps)).max(MOST)
        };
        for m in &shared.marks {
            if let Some(b) = marks[*m].block {
                findings.evenly(b, speed, v);
            }
        }
        for b in shared.kinks.iter().filter_map(|m| marks[*m].boundary) {
            findings.even_at[b] = findings.even_at[b].min(speed);
        }
    }

    /// Highest speed in mm/s between two path lengths within the filters at a violation.
    fn fastest(&self, case: &Case<'_>, from: f64, to: f64) -> f64 {
        let Case { v, record, .. } = *case;
        let length = u64::from(self.trial.kernels.length());
        let cycles = v.cycle.saturating_sub(length)..v.cycle;
        let inside = cycles.filter(|k| record.s(k + 1) >= from && record.s(*k) <= to);
        let steps = inside.map(|k| record.s(k + 1) - record.s(k));
        steps.fold(0.0, f64::max) / self.trial.cycle.seconds()
    }

    /// Speed in mm/s at which the stretch of a violation keeps the tolerance when traversed at constant speed; at most
    /// the highest one planned there.
    fn even_speed(&self, case: &Case<'_>) -> f64 {
        let Self { trial, marks, .. } = self;
        let Case { v, record, demands, .. } = *case;
        let fastest_planned = self.fastest(case, f64::NEG_INFINITY, f64::INFINITY);
        let longest = trial.kernels.longest();
        let Some(kernel) = trial.kernels.get(v.axis).or(longest) else { return fastest_planned };
        let at = |delay: u32| record.s(v.cycle.saturating_sub(u64::from(delay)));
        let middle: f64 = kernel.taps().iter().map(|t| t.weight * at(t.delay)).sum();
        // a run through a corner is not comparable if the path dwells there until the corner has left the filters
        let full = trial.kernels.length();
        let long = |m: &&Mark| {
            m.boundary.is_some_and(|b| demands.stop[b].is_some_and(|dwell| dwell >= full))
        };
        let rests = || marks.iter().filter(long).map(|m| m.s_mm);
        let (oldest, newest) = (at(full) + SAME_START_MM, at(0) - SAME_START_MM);
        let between = (
            rests().filter(|s| *s <= oldest).fold(f64::NEG_INFINITY, f64::max),
            rests().filter(|s| *s >= newest).fold(f64::INFINITY, f64::min),
        );
        let (contour, kernels, cycle) = (&self.contour, trial.kernels, trial.cycle);
        let evenly = Evenly { contour, kernels, cycle, between };
        let aim = aim(v.tolerance_mm);
        let least = LEAST * fastest_planned;
        fastest(fastest_planned / f64::from(1 << DOUBLINGS), least, fastest_planned, |speed| {
            match &v.missed {
                Some((point, s)) => evenly.misses(point, *s, speed) <= aim,
                None => evenly.stays(middle, speed, aim),
            }
        })
    }
}
