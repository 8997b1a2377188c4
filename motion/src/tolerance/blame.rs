//! What causes a violation, and what it demands of the next plan.
//!
//! Around the middle `s*` of what the filter of an axis holds, the path is a straight line plus its kinks and bends. A kink
//! at `s_b` with the change of direction `du` moves the set point aside by `du E[(s - s_b)+]` (or `(s_b - s)+` before the
//! middle), with the mean `E` over the kernel: its *part* in the deviation (derived; exact for polygons). A bend is many
//! small kinks. A short filter holds one set point before a corner and the next one after it, and the line between them cuts
//! the corner off: where a set point has no parts, those of the middle of its line count.
//!
//! One part that outweighs the others is an isolated corner: its speed alone is lowered, down to a rest, and then it waits.
//! A bend next to a larger kink is slowed down only once the kink is no longer to blame.
//! Parts alike are a curve: they share one speed, that of the whole stretch between them, and it is the speed at which the
//! same stretch, run through evenly, keeps the tolerance. Kinks further apart than the path runs at that speed while the
//! filter holds them are isolated again: between them it is faster to speed up and to brake. Where a stretch exceeds however slowly
//! it is run, the starts and stops next to it are the cause (`du a M2 / 2`, whatever the speed): then the path rests at its ends.

use super::demands::{Demands, PATIENCE, hurry};
use super::even::{ALIKE, Evenly, aim, fastest};
use super::findings::Findings;
use super::view::{Mark, View};
use super::violation::{Record, Violation};
use crate::axis::AxisVec;
use crate::contour::SAME_START_MM;

/// Points at which a bend is looked at.
const BEND_POINTS: u32 = 6;
/// Doublings from the least speed looked at to the one planned.
const DOUBLINGS: u32 = 4;
/// Ratio of two excesses up to which the second one is not looked at.
const LITTLE_MORE: f64 = 1.05;
/// Least part of the speed planned that one round leaves of it.
const LEAST_OF_ROUND: f64 = 0.5;
/// Part of the speed planned from which on an even speed is not below it.
const ALMOST: f64 = 0.995;
/// Largest reduction of an even speed in one round.
const MOST: f64 = 0.25;
/// Least part of the speed planned that an even speed can be.
const LEAST: f64 = 2.5e-4;

/// A kink or a bent block within reach.
struct Part {
    mark: usize,
    bend: bool,
    /// Share of the deviation in mm.
    size: f64,
    /// Path length.
    s: f64,
}

/// Marks whose blocks, and whose entries, share one speed.
#[derive(Default)]
struct Shared {
    marks: Vec<usize>,
    kinks: Vec<usize>,
}

impl View<'_> {
    /// Finds who is to blame for a violation; `all`: everything that can still be changed.
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
        // a point of the line between two set points: the filters held one cycle more for the first of them
        let oldest = v.cycle.saturating_sub(length + 1);
        let first = marks.partition_point(|m| m.cycles <= oldest as f64).saturating_sub(1);
        // the set path turns off after the point of it that comes nearest to what is missed
        let newest = v.cycle + u64::from(v.missed.is_some());
        let until = |k: u64| marks.partition_point(|m| m.cycles <= k as f64);
        let mut last = until(newest);
        // what comes nearest may be final, but as long as the filters hold the point the set path can come nearer still
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
        // a slow run over the same blocks would repeat the same demand again and again
        // where a straight line is divided does not matter
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
        // the filters hold the set point on one side of a corner, and the line to it comes from the other side
        if !parts.iter().any(|p| free(p) && p.size > 0.0) {
            let line = [v.cycle.saturating_sub(1), v.cycle];
            parts = self.parts_of(v, &line, record, (first, last));
        }
        // far from the contour, the nearest point is not the middle of what the filters hold; then no part, or not even the sum
        // of all parts, may point in the direction of the deviation
        if !parts.iter().any(|p| free(p) && p.size > 0.0)
            || parts.iter().map(|p| p.size).sum::<f64>() <= 0.0
        {
            for part in &mut parts {
                part.size = part.size.abs();
            }
        }
        // a corner missed because the path did not wait there long enough: nothing is beyond it yet
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
        // a bend next to a larger kink has to wait until the kink is settled: it may be a long arc, which would remain slow
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
        // where the path rests already it can wait longer, and between two rests a lower speed is no help
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
        // what lies between the likes shares their speed
        for pair in alike.windows(2) {
            if (pair[1].s - pair[0].s).abs() <= apart && !(rests(pair[0]) && rests(pair[1])) {
                shared.marks.extend(pair[0].mark..pair[1].mark);
            }
        }
        if !blamed || all {
            // a cause before a stop is final already, but what follows the stop can wait for the filters
            let fixed = |p: &&Part| marks[p.mark].block.is_none();
            let before = parts.iter().filter(fixed).map(|p| p.size).fold(0.0, f64::max);
            let waits = (all || before > 0.0)
                && marks[first..last].iter().any(|m| m.boundary == Some(0))
                && demands.stop[0].is_none_or(|dwell| u64::from(dwell) < length);
            if waits {
                findings.corner[0] = findings.corner[0].max(excess);
            }
            if !waits || all {
                // after a long rest the filters hold nothing of the block before it
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

    /// Where the delays differ, a straight block has a part in the deviation, too, the larger the faster it is: those that are
    /// faster than the even speed are to blame before those that are not.
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

    /// Highest speed in mm/s on the block of a mark while the filters hold a violation; 0 where it is final.
    fn present(&self, m: usize, v: &Violation, record: &Record, demands: &Demands) -> f64 {
        let mark = &self.marks[m];
        let asked = mark.block.map_or(0.0, |b| demands.feed[b]);
        self.fastest(v, record, mark.s_mm, mark.s_mm + mark.queued.length).min(asked)
    }

    /// Asks for one speed on a stretch: the even one, or less if that is not below what is planned.
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
            // the path rests while the filters swing: no speed is the cause
            f64::INFINITY
        } else if even < ALMOST * present {
            // a plan that is far too fast says little about who is to blame in a slower one
            even.max(LEAST_OF_ROUND * present)
        } else {
            // where the speed is even already, or a change of speed is the cause
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

    /// Highest speed in mm/s between two path lengths while the filters hold a violation.
    fn fastest(&self, v: &Violation, record: &Record, from: f64, to: f64) -> f64 {
        let length = u64::from(self.trial.kernels.length());
        let cycles = v.cycle.saturating_sub(length)..v.cycle;
        let inside = cycles.filter(|k| record.s(k + 1) >= from && record.s(*k) <= to);
        let steps = inside.map(|k| record.s(k + 1) - record.s(k));
        steps.fold(0.0, f64::max) / self.trial.cycle.seconds()
    }

    /// Parts in a deviation that push the way it points, in order of the path: of the set point of a cycle, or of the middle
    /// of the line between two.
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

    /// Speed in mm/s at which the stretch of a violation, run through evenly, keeps the tolerance; at most the highest one
    /// planned there.
    fn even_speed(&self, v: &Violation, record: &Record, demands: &Demands) -> f64 {
        let Self { trial, marks, .. } = self;
        let fastest_planned = self.fastest(v, record, f64::NEG_INFINITY, f64::INFINITY);
        let longest = trial.kernels.longest();
        let Some(kernel) = trial.kernels.get(v.axis).or(longest) else { return fastest_planned };
        let at = |delay: u32| record.s(v.cycle.saturating_sub(u64::from(delay)));
        let middle: f64 = kernel.taps().iter().map(|t| t.weight * at(t.delay)).sum();
        // a run through a corner says nothing where the path rests there until the filters have let go of it
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
            let deviation = match &v.missed {
                Some((point, s)) => evenly.misses(point, *s, speed),
                None => evenly.leaves(middle, speed),
            };
            deviation <= aim
        })
    }
}
