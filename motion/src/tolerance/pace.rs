//! How fast a stretch that shares a violation may run.
//!
//! Its even speed is known from the contour alone ([`super::even`]). Where the plan is hardly faster than that and exceeds
//! nevertheless, starts and stops have a part in it: then the plan itself, played back more slowly, shows how much of its speed
//! has to go.

use super::blame::{Findings, Shared};
use super::even::{Evenly, aim, fastest};
use super::measure::{Record, Violation};
use super::tighten::{PATIENCE, hurry};
use super::view::{Mark, View};
use super::{Demands, Trial};
use crate::contour::SAME_START_MM;

/// Doublings from the least speed looked at to the one planned.
const DOUBLINGS: u32 = 4;
/// Least part of the speed planned that one round leaves of it.
const LEAST_OF_ROUND: f64 = 0.5;
/// Least part of a speed, if it is no higher than the even one, that one round leaves of it.
const MOST: f64 = 0.25;
/// Largest part of it that is left.
const LEAST_STEP: f64 = 0.995;
/// Least part of the speed planned that an even speed can be.
const LEAST: f64 = 2.5e-4;
/// Deviation in tolerances from which on a plan says little about a slower one.
const FAR: f64 = 1.5;
/// Least part of the fastest speed of a stretch to which its slower parts are held.
const LEAST_OF_FASTEST: f64 = 0.9;

/// What is asked of a stretch.
enum Pace {
    /// One speed in mm/s.
    Even(f64),
    /// A part of what is planned, whose highest speed in mm/s is `fastest`.
    Part { ratio: f64, fastest: f64 },
}

impl Pace {
    /// Speed in mm/s asked where `planned` is planned; 0 if the path does not come there in time.
    fn of(&self, planned: f64) -> f64 {
        match *self {
            Self::Even(speed) => speed,
            Self::Part { ratio, fastest } if planned <= 0.0 => ratio * fastest,
            // what crawls is not to blame
            Self::Part { ratio, fastest } => ratio * planned.max(LEAST_OF_FASTEST * fastest),
        }
    }
}

impl View<'_> {
    /// Asks for a speed on a stretch: the even one, or a part of what is planned if that is no faster.
    pub(super) fn share(
        &self,
        shared: &Shared,
        even: f64,
        v: &Violation,
        record: &Record,
        demands: &Demands,
        findings: &mut Findings,
    ) {
        let marks = &self.marks;
        let at = |m: usize, length: f64, asked: f64| {
            let s = marks[m].s_mm;
            self.fastest(v, record, s, s + length).min(asked)
        };
        let along = |m: &usize| {
            let asked = marks[*m].block.map_or(f64::INFINITY, |b| demands.feed[b]);
            at(*m, marks[*m].queued.length, asked)
        };
        let into = |m: &usize| {
            let asked = marks[*m].boundary.map_or(f64::INFINITY, |b| demands.cap[b]);
            at(*m, 0.0, asked)
        };
        let blocks: Vec<f64> = shared.marks.iter().map(along).collect();
        let kinks: Vec<f64> = shared.kinks.iter().map(into).collect();
        let present = blocks.iter().chain(&kinks).copied().fold(0.0, f64::max);
        let pace = if present <= 0.0 {
            // the path rests while the filters swing: no speed is the cause
            Pace::Even(f64::INFINITY)
        } else if even < LEAST_STEP * present {
            // a plan that is far too fast says little about who is to blame in a slower one
            Pace::Even(even.max(LEAST_OF_ROUND * present))
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
            let step = self.slower(v, record).min(LEAST_STEP);
            let ratio = libm::pow(step, f64::from(hurry(repeats))).max(MOST);
            Pace::Part { ratio, fastest: present }
        };
        for (m, planned) in shared.marks.iter().zip(blocks) {
            if let Some(b) = marks[*m].block {
                findings.evenly(b, pace.of(planned), v);
            }
        }
        for (m, planned) in shared.kinks.iter().zip(kinks) {
            if let Some(b) = marks[*m].boundary {
                findings.even_at[b] = findings.even_at[b].min(pace.of(planned));
            }
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

    /// Part of the planned speed at which a violation keeps the tolerance, if everything within reach runs slower by it. The
    /// deviation falls with the speed at kinks and with its square on bends; the power in between is that of the plan itself,
    /// played back more slowly.
    fn slower(&self, v: &Violation, record: &Record) -> f64 {
        let wanted = aim(v.tolerance_mm) / v.deviation_mm;
        let guess = wanted.sqrt();
        if v.deviation_mm > FAR * v.tolerance_mm {
            return guess;
        }
        let trial = self.trial;
        let evenly = self.evenly((f64::NEG_INFINITY, f64::INFINITY));
        let at = |ratio: f64| {
            if let Some((point, s)) = &v.missed {
                let moment = record.leaves(*s) as f64;
                evenly.misses_along(point, |cycles| record.s_at(moment + ratio * cycles))
            } else {
                let moment = v.cycle as f64 - trial.kernels.delay;
                evenly.leaves_along(|cycles| record.s_at(moment + ratio * cycles))
            }
        };
        let power = libm::log(at(guess) / at(1.0)) / libm::log(guess);
        if power.is_finite() { libm::pow(wanted, 1.0 / power.clamp(1.0, 2.0)) } else { guess }
    }

    fn evenly(&self, between: (f64, f64)) -> Evenly<'_> {
        let Trial { kernels, cycle, .. } = *self.trial;
        Evenly { contour: &self.contour, kernels, cycle, between }
    }

    /// Speed in mm/s at which the stretch of a violation, run through evenly, keeps the tolerance; at most the highest one
    /// planned there.
    pub(super) fn even_speed(&self, v: &Violation, record: &Record, demands: &Demands) -> f64 {
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
        let evenly = self.evenly(between);
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
