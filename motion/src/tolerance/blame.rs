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

use super::demands::{Demands, PATIENCE, hurry};
use super::even::{ALIKE, Evenly, aim, fastest};
use super::findings::Findings;
use super::marks::Mark;
use super::view::View;
use super::violation::{Record, Violation};
use crate::axis::AxisVec;
use crate::contour::SAME_START_MM;

/// Number of points at which a bend is evaluated.
const BEND_POINTS: u32 = 6;
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

/// A kink or a bent block within reach.
struct Part {
    mark: usize,
    bend: bool,
    /// Contribution to the deviation in mm.
    size: f64,
    /// Path length.
    s: f64,
}

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
        let Self { trial, marks, .. } = self;
        let length = u64::from(trial.kernels.length());
        // a point of the segment between two set points: for the first of them, the filters reach one cycle further
        // back
        let oldest = v.cycle.saturating_sub(length + 1);
        let first = marks.partition_point(|m| m.cycles <= oldest as f64).saturating_sub(1);
        // the set path turns off after its point nearest to the missed one
        let newest = v.cycle + u64::from(v.missed.is_some());
        let until = |k: u64| marks.partition_point(|m| m.cycles <= k as f64);
        let mut last = until(newest);
        // the nearest point may be final, but while the filters hold the missed point the set path can still come
        // closer
        let is_final = |m: &Mark| m.boundary.is_none() && m.block.is_none();
        if let Some((_, s)) = &v.missed
            && marks[..last].iter().all(is_final)
        {
            last = until(record.leaves(*s) + length + 1);
        }
        if first >= last {
            return;
        }
        let excess = v.excess();
        // in a slow run over the same blocks the same demand would be repeated many times; where a straight line is
        // divided does not matter
        let mut causes = (first..last)
            .filter(|m| *m > first && marks[*m].is_kink() || marks[*m].queued.bend > 0.0);
        let place = causes.next().map_or((0, 0), |m| (m, causes.next_back().unwrap_or(m)));
        let told = &mut findings.last[usize::from(v.missed.is_some())];
        if told.is_some_and(|(at, most)| at == place && excess <= LITTLE_MORE * most) {
            return;
        }
        *told = Some((place, excess));
        let mut parts = self.parts_of(v, &[v.cycle], record, (first, last));
        let free = |p: &Part| {
            let m = &marks[p.mark];
            if p.bend {
                m.block.is_some()
            } else {
                m.boundary
                    .is_some_and(|b| demands.stop[b].is_none_or(|dwell| u64::from(dwell) < length))
            }
        };
        // the filters hold the set point on one side of a corner, and the segment to it comes from the other side
        if !parts.iter().any(|p| free(p) && p.size > 0.0) {
            let line = [v.cycle.saturating_sub(1), v.cycle];
            parts = self.parts_of(v, &line, record, (first, last));
        }
        // far from the contour, the nearest point is not the middle of what the filters hold; then no part, or not even
        // the sum of all parts, may point in the direction of the deviation
        if !parts.iter().any(|p| free(p) && p.size > 0.0)
            || parts.iter().map(|p| p.size).sum::<f64>() <= 0.0
        {
            for part in &mut parts {
                part.size = part.size.abs();
            }
        }
        // a corner missed because the dwell there was too short: the filters hold nothing beyond it yet
        if let Some((_, missed)) = &v.missed
            && !parts.iter().any(|p| free(p) && p.size > 0.0)
        {
            let away = |p: &&mut Part| (p.s - missed).abs();
            let kinks = parts.iter_mut().filter(|p| free(p) && !p.bend);
            if let Some(part) = kinks.min_by(|a, b| away(a).total_cmp(&away(b))) {
                part.size = v.deviation_mm;
            }
        }
        let largest = parts.iter().filter(|p| free(p)).map(|p| p.size).fold(0.0, f64::max);
        let kinks = parts.iter().filter(|p| free(p) && !p.bend).map(|p| p.size);
        let sharpest = kinks.fold(0.0, f64::max);
        // a bend next to a larger kink is left alone until the kink is settled: it may be a long arc, which would stay
        // slow
        let counts = |p: &&Part| {
            free(p) && p.size > 0.0 && p.size >= ALIKE * largest && !(p.bend && p.size <= sharpest)
        };
        let alike: Vec<&Part> = parts.iter().filter(counts).collect();
        let even = self.even_speed(v, record, demands);
        let apart = even * length as f64 * trial.cycle.seconds();
        let isolated = |i: usize| -> bool {
            let p = alike[i];
            let near = |q: &&Part| (p.s - q.s).abs() <= apart;
            !p.bend
                && i.checked_sub(1).is_none_or(|b| !near(&alike[b]))
                && alike.get(i + 1).is_none_or(|q| !near(q))
        };
        // where the path already stops it can dwell longer, and between two stops a lower speed does not help
        let rests =
            |p: &Part| !p.bend && marks[p.mark].boundary.is_some_and(|b| demands.stop[b].is_some());
        let mut shared = Shared::default();
        let mut blamed = false;
        for (i, part) in alike.iter().enumerate() {
            let m = &marks[part.mark];
            let Some(b) = (if part.bend { m.block } else { m.boundary }) else { continue };
            blamed = true;
            if part.bend {
                shared.marks.push(part.mark);
            } else if isolated(i) || rests(part) {
                findings.corner[b] = findings.corner[b].max(excess);
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
        if !blamed || all {
            // a cause before a stop is already final, but the blocks after the stop can wait until the filters have let
            // it pass
            let fixed = |p: &&Part| marks[p.mark].block.is_none();
            let before = parts.iter().filter(fixed).map(|p| p.size).fold(0.0, f64::max);
            let waits = (all || before > 0.0)
                && marks[first..last].iter().any(|m| m.boundary == Some(0))
                && demands.stop[0].is_none_or(|dwell| u64::from(dwell) < length);
            if waits {
                findings.corner[0] = findings.corner[0].max(excess);
            }
            if !waits || all {
                // after a long dwell the filters hold nothing of the block before it
                let held = record.s(oldest);
                let is_left = |m: &usize| {
                    marks.get(m + 1).is_some_and(|next| next.s_mm <= held + SAME_START_MM)
                };
                shared.marks.extend((first..last).filter(|m| !is_left(m)));
            }
        }
        if trial.kernels.unequal {
            self.turn_to_the_faster(&mut shared, (first, last), even, v, record, demands);
        }
        self.share(&shared, even, v, record, demands, findings);
    }

    /// Where the delays differ, a straight block contributes to the deviation, too, in proportion to its speed: blocks
    /// faster than the even speed are to blame before the others.
    fn turn_to_the_faster(
        &self,
        shared: &mut Shared,
        (first, last): (usize, usize),
        even: f64,
        v: &Violation,
        record: &Record,
        demands: &Demands,
    ) {
        let faster = |m: &usize| self.present(*m, v, record, demands) > even / ALMOST;
        if !shared.marks.is_empty() && !shared.marks.iter().any(faster) {
            let faster: Vec<usize> = (first..last).filter(faster).collect();
            if !faster.is_empty() {
                *shared = Shared { marks: faster, kinks: Vec::new() };
            }
        }
    }

    /// Highest speed in mm/s on the block of a mark within the filters at a violation; 0 if it is final.
    fn present(&self, m: usize, v: &Violation, record: &Record, demands: &Demands) -> f64 {
        let mark = &self.marks[m];
        let asked = mark.block.map_or(0.0, |b| demands.feed[b]);
        self.fastest(v, record, mark.s_mm, mark.s_mm + mark.queued.length).min(asked)
    }

    /// Demands one speed for a stretch: the even speed, or a lower one if that is not below the planned speed.
    fn share(
        &self,
        shared: &Shared,
        even: f64,
        v: &Violation,
        record: &Record,
        demands: &Demands,
        findings: &mut Findings,
    ) {
        let marks = &self.marks;
        let at = |m: &usize, length: f64, asked: f64| {
            let s = marks[*m].s_mm;
            self.fastest(v, record, s, s + length).min(asked)
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
    fn fastest(&self, v: &Violation, record: &Record, from: f64, to: f64) -> f64 {
        let length = u64::from(self.trial.kernels.length());
        let cycles = v.cycle.saturating_sub(length)..v.cycle;
        let inside = cycles.filter(|k| record.s(k + 1) >= from && record.s(*k) <= to);
        let steps = inside.map(|k| record.s(k + 1) - record.s(k));
        steps.fold(0.0, f64::max) / self.trial.cycle.seconds()
    }

    /// Parts in a deviation, positive in its direction, in the order of the path: for the set point of a cycle, or for
    /// the middle of the segment between two.
    fn parts_of(
        &self,
        v: &Violation,
        cycles: &[u64],
        record: &Record,
        (first, last): (usize, usize),
    ) -> Vec<Part> {
        let Self { trial, marks, .. } = self;
        let Some(kernel) = trial.kernels.get(v.axis).or_else(|| trial.kernels.longest()) else {
            return Vec::new();
        };
        let at = |delay: u32| record.s(v.cycle.saturating_sub(u64::from(delay)));
        let mean = |weighed: &dyn Fn(f64, f64) -> f64| -> f64 {
            let of = |cycle: &u64| -> f64 {
                let held = |delay: u32| record.s(cycle.saturating_sub(u64::from(delay)));
                kernel.taps().iter().map(|t| weighed(t.weight, held(t.delay))).sum()
            };
            cycles.iter().map(of).sum::<f64>() / cycles.len() as f64
        };
        let middle = mean(&|weight, s| weight * s);
        let weight = |s: f64| {
            mean(&|weight, held| {
                let d = held - s;
                weight.abs() * if s >= middle { d.max(0.0) } else { (-d).max(0.0) }
            })
        };
        let (oldest, newest) = (at(kernel.length()), at(0));
        let length = v.vector.iter().map(|c| c * c).sum::<f64>().sqrt();
        let toward: AxisVec = v.vector.iter().map(|c| c / length).collect();
        let mut curvature = AxisVec::zeros(marks[first].point().len());
        let mut parts = Vec::new();
        for (m, mark) in marks.iter().enumerate().take(last).skip(first) {
            if m > first && mark.is_kink() {
                let size = self.turn(m, &toward) * weight(mark.s_mm);
                parts.push(Part { mark: m, bend: false, size, s: mark.s_mm });
            }
            if mark.queued.bend > 0.0 {
                let from = oldest.max(mark.s_mm);
                let to = newest.min(mark.s_mm + mark.queued.length);
                let step = (to - from) / f64::from(BEND_POINTS);
                let mut size = 0.0;
                for i in 0..BEND_POINTS {
                    let s = from + (f64::from(i) + 0.5) * step;
                    mark.queued
                        .block
                        .path
                        .curvature(mark.queued.offset + s - mark.s_mm, &mut curvature);
                    let pull: f64 = curvature.iter().zip(toward.iter()).map(|(c, u)| c * u).sum();
                    size += pull * weight(s) * step;
                }
                if step > 0.0 {
                    parts.push(Part { mark: m, bend: true, size, s: middle.clamp(from, to) });
                }
            }
        }
        parts
    }

    /// Speed in mm/s at which the stretch of a violation keeps the tolerance when traversed at constant speed; at most
    /// the highest one planned there.
    fn even_speed(&self, v: &Violation, record: &Record, demands: &Demands) -> f64 {
        let Self { trial, marks, .. } = self;
        let fastest_planned = self.fastest(v, record, f64::NEG_INFINITY, f64::INFINITY);
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
