//! Which cycles of a plan have to be measured.
//!
//! Only those can leave the contour whose filters hold kinks or bends of the path. Bounds pass over most of these too, all of
//! them derived from the sum in [`super`], weights positive and the same for all axes:
//! - kinks, cycle by cycle: the path lengths that the filter holds lie at most as far beyond a kink as the highest speed
//!   leads from there, so an axis is aside by at most the change of its direction, times that speed, times the mean time
//!   beyond ([`Beyond`]), summed over the kinks. Along a curve of chords run through evenly that is what it is aside by;
//! - bends, stretch by stretch: by their variance;
//! - both, roughly: the sum of all changes of direction within reach, times the speed, times the first moment.
//!
//! The bounds hold for the vector to a point of the contour that moves along it without a gap, so they bound what the set
//! path misses, too.

use super::measure::{Record, Violation};
use super::view::View;
use super::{Kernels, Unkept};
use crate::timeline::{PathState, Reader};
use kontur_filters::kernel::Kernel;

/// Cycles measured in one go, so that long stretches need little memory.
const CHUNK: u64 = 8192;
/// Share by which the way of one cycle may differ from that of another on a stretch of constant speed.
const EVEN: f64 = 1e-7;
/// Part of the tolerance up to which a bound excuses cycles from being measured.
const CERTAIN: f64 = 0.9;

/// Mean time, in cycles, for which a filter is beyond a moment, on the side where that is less.
pub(super) struct Beyond {
    /// At whole cycles in front of the newest one: behind the moment, and before it.
    means: Vec<[f64; 2]>,
}

impl Beyond {
    pub(super) fn new(kernels: &Kernels) -> Self {
        let length = kernels.length();
        let mean = |x: u32| {
            let part = |f: fn(f64) -> f64| {
                let taps = kernels.longest().map_or(&[][..], Kernel::taps);
                taps.iter().map(|t| t.weight * f(f64::from(x) - f64::from(t.delay))).sum()
            };
            [part(|d| d.max(0.0)), part(|d| (-d).max(0.0))]
        };
        Self { means: (0..=length + 1).map(mean).collect() }
    }

    /// For a moment `x` cycles before the newest one; the line to the set point before counts. Linear between whole cycles,
    /// as the means are.
    fn at(&self, x: f64) -> f64 {
        let mean = |x: f64, side: usize| {
            let i = (x as usize).min(self.means.len() - 2);
            let (a, b) = (self.means[i][side], self.means[i + 1][side]);
            a + (x - i as f64) * (b - a)
        };
        mean(x, 0).min(mean((x - 1.0).max(0.0), 1) + (1.0 - x).max(0.0))
    }
}

impl View<'_> {
    /// Measures the plan in some cycles, ranges in order, and hands every stretch's worst violations, at most one for half a
    /// kernel, to `found`; returns the worst of all.
    pub(super) fn search(
        &self,
        among: &[(u64, u64)],
        mut found: impl FnMut(&Violation, &Record),
    ) -> Option<Unkept> {
        let reach = u64::from(self.trial.kernels.length());
        let mut worst: Option<Unkept> = None;
        let mut reader = Reader::new(self.trial.timeline, self.trial.plan);
        let mut active: Vec<(u64, u64)> = Vec::new();
        let calm = self.calm();
        for m in 0..self.marks.len() {
            let Some(held) = self.held(m) else { continue };
            // what is missed is looked for when the filters have let it go
            let inside = within_of(among, (held.0, held.1 + reach as f64 + 2.0));
            if inside.is_empty() || self.is_quiet(held) {
                continue;
            }
            if self.marks[m].queued.bend <= 0.0 && calm {
                active.extend(inside);
                continue;
            }
            // of a bent block only where it bends, of a straight one only where its speed changes
            for (from, to) in inside {
                let mut k = from;
                while k <= to {
                    let until = to.min(k + reach.max(8));
                    let passed_over = if calm {
                        self.straightens(k.saturating_sub(reach + 2), until, &mut reader)
                    } else {
                        k > from
                            && self.is_steady(
                                m,
                                k.saturating_sub(2 * reach + 4),
                                until,
                                &mut reader,
                            )
                    };
                    if !passed_over {
                        active.push((k, until));
                    }
                    k = until + 1;
                }
            }
        }
        let mut stretches = joined(active, reach);
        if calm {
            let beyond = Beyond::new(self.trial.kernels);
            stretches = stretches.into_iter().flat_map(|s| self.uncertain(s, &beyond)).collect();
        }
        for (mut from, to) in stretches {
            while from <= to {
                let until = to.min(from + CHUNK);
                self.measure(from, until, &mut found, &mut worst);
                from = until + 1;
            }
        }
        worst
    }

    /// Cycles of a stretch that the bound for kinks does not excuse, with those in which the filters let go what they hold.
    fn uncertain(&self, (from, to): (u64, u64), beyond: &Beyond) -> Vec<(u64, u64)> {
        let Self { trial, marks, .. } = self;
        let axes = trial.kernels.axes.len();
        let length = u64::from(trial.kernels.length());
        let reach = length as f64 + 2.0;
        let first = marks.partition_point(|m| m.cycles <= from as f64 - reach);
        let last = marks.partition_point(|m| m.cycles <= to as f64);
        let around = &marks[first.saturating_sub(1)..last];
        let tolerances = around.iter().filter_map(|m| m.queued.block.tolerance.ax_dev_mm);
        let tolerance = tolerances.fold(f64::INFINITY, f64::min);
        let mut aside = vec![0.0; (to - from + 1) as usize * axes];
        let numbers = |begin: f64, end: f64| {
            let clip = |k: f64| (k.max(0.0) as u64).clamp(from, to + 1) - from;
            clip(begin.ceil()) as usize..clip(end.floor() + 1.0) as usize
        };
        for m in first.max(1)..last {
            if !marks[m].is_kink() {
                continue;
            }
            let passed = marks[m].cycles;
            let before = marks[..m].iter().enumerate().rev();
            let speed = before
                .take_while(|(i, _)| marks[i + 1].cycles >= passed - reach)
                .map(|(_, m)| m.speed)
                .chain(
                    marks[m..].iter().take_while(|m| m.cycles <= passed + reach).map(|m| m.speed),
                )
                .fold(0.0, f64::max);
            let way = speed * trial.cycle.seconds();
            for k in numbers(passed, passed + reach) {
                let part = way * beyond.at((from + k as u64) as f64 - passed);
                for i in 0..axes {
                    aside[k * axes + i] += part * self.turn(m, i).abs();
                }
            }
        }
        // bends are bounded elsewhere
        for m in first.saturating_sub(1)..last {
            if marks[m].queued.bend > 0.0 {
                let until = marks.get(m + 1).map_or_else(|| self.rest(), |next| next.cycles);
                for k in numbers(marks[m].cycles, until + reach) {
                    aside[k * axes] = f64::INFINITY;
                }
            }
        }
        let limit = CERTAIN * tolerance;
        let loud = aside.chunks(axes).enumerate().filter_map(|(k, parts)| {
            let square: f64 = parts.iter().map(|c| c * c).sum();
            let k = from + k as u64;
            (square > limit * limit).then_some((k, (k + length + 2).min(to)))
        });
        joined(loud.collect(), length)
    }

    /// Moments between which the filters hold the entry of a mark's block, or the block itself if that can leave the contour;
    /// `None` where neither can.
    fn held(&self, m: usize) -> Option<(f64, f64)> {
        let Self { trial, marks, .. } = self;
        let kernels = trial.kernels;
        let (mark, reach) = (&marks[m], f64::from(kernels.length()));
        let restless = kernels.unequal || kernels.overshoot;
        let lasts = restless || mark.queued.bend > 0.0;
        if !lasts && !mark.is_kink() {
            return None;
        }
        let until = if lasts {
            marks.get(m + 1).map_or_else(|| self.rest(), |next| next.cycles)
        } else {
            mark.cycles
        };
        Some((mark.cycles, until + reach + 2.0))
    }

    /// The kernels are equal and pull nothing beyond an end: only kinks and bends leave the contour.
    fn calm(&self) -> bool {
        !self.trial.kernels.unequal && !self.trial.kernels.overshoot
    }

    /// True if no set point of the cycles `first..=last` can leave the contour by the tolerance: expanded around their
    /// mean path length the linear part of the path points lies on the path, and what is left of an axis is at most
    /// `bend / 2` times their variance, itself at most a quarter of the stretch squared (derived).
    fn straightens(&self, first: u64, last: u64, reader: &mut Reader<'_>) -> bool {
        let Self { trial, marks, .. } = self;
        let begin = marks.partition_point(|m| m.cycles <= first as f64 - 1.0).saturating_sub(1);
        let end = marks.partition_point(|m| m.cycles <= last as f64);
        if (begin + 1..end).any(|m| marks[m].is_kink()) {
            return false;
        }
        let mut state = PathState::at_rest(&marks[begin].point);
        let [from, to] = [first, last].map(|k| {
            self.state(k, reader, &mut state);
            state.s
        });
        let (mut bend, mut tolerance) = (0.0_f64, f64::INFINITY);
        for m in &marks[begin..end] {
            bend = bend.max(m.queued.bend_between(from - m.s_mm, to - m.s_mm));
            tolerance = tolerance.min(m.queued.block.tolerance.ax_dev_mm.unwrap_or(f64::INFINITY));
        }
        let axes = trial.kernels.axes.len() as f64;
        axes.sqrt() * bend * (to - from) * (to - from) / 8.0 <= 0.5 * tolerance
    }

    /// True if the path runs evenly along the straight block of mark `m` in the cycles `first..=last`: the set points that
    /// depend on nothing else are aside by the same vector. A speed that rises and falls at most once has the same value at
    /// both ends, and as its mean, only if it is constant.
    fn is_steady(&self, m: usize, first: u64, last: u64, reader: &mut Reader<'_>) -> bool {
        let Self { trial, marks, .. } = self;
        let ends = marks.get(m + 1).map_or_else(|| self.rest(), |next| next.cycles);
        let inside = marks[m].cycles <= first as f64 && last as f64 <= ends;
        if !inside || !marks[m].queued.block.path.is_straight() {
            return false;
        }
        let mut state = PathState::at_rest(&marks[m].point);
        let [from, to] = [first, last].map(|k| {
            self.state(k, reader, &mut state);
            state.s
        });
        let step = (to - from) / (last - first) as f64;
        let steps = [first, first + (last - first) / 2, last - 1].map(|k| {
            self.state(k, reader, &mut state);
            let s = state.s;
            self.state(k + 1, reader, &mut state);
            state.s - s
        });
        steps.iter().all(|other| (other - step).abs() <= EVEN * step + 1e-9 * trial.cycle.seconds())
    }

    /// True if the changes of direction that the filters hold between two moments are too small to exceed the tolerance.
    fn is_quiet(&self, (from, to): (f64, f64)) -> bool {
        let Self { trial, marks, .. } = self;
        if !self.calm() {
            return false;
        }
        let from = from - f64::from(trial.kernels.length()) - 2.0;
        let first = marks.partition_point(|m| m.cycles <= from).saturating_sub(1);
        let last = marks.partition_point(|m| m.cycles <= to);
        let reach = f64::from(trial.kernels.length()) + 2.0;
        let seconds = trial.cycle.seconds();
        let mut tolerance = f64::INFINITY;
        let mut speed = 0.0_f64;
        for m in &marks[first..last] {
            tolerance = tolerance.min(m.queued.block.tolerance.ax_dev_mm.unwrap_or(f64::INFINITY));
            speed = speed.max(m.speed);
        }
        if tolerance.is_infinite() {
            return true;
        }
        (0..trial.kernels.axes.len()).all(|i| {
            let m1 = trial.kernels.get(i).map_or(0.0, Kernel::m1_cycles) + 0.25;
            let turn: f64 = (first..last)
                .map(|m| {
                    let kink = if m > first { self.turn(m, i).abs() } else { 0.0 };
                    let q = &marks[m].queued;
                    kink + q.bend * q.length.min(2.0 * speed * reach * seconds)
                })
                .sum();
            turn * speed * m1 * seconds <= CERTAIN * tolerance
        })
    }
}

/// The parts of a range of moments, in whole cycles, that lie in one of some ranges of cycles.
fn within_of(among: &[(u64, u64)], (from, to): (f64, f64)) -> Vec<(u64, u64)> {
    let (from, to) = (from.floor().max(0.0) as u64, to.ceil() as u64);
    let first = among.partition_point(|range| range.1 < from);
    let inside = among[first..].iter().take_while(|range| range.0 <= to);
    inside.map(|range| (range.0.max(from), range.1.min(to))).collect()
}

/// Ranges of cycles in order; those less than `reach` apart are one.
pub(super) fn joined(mut ranges: Vec<(u64, u64)>, reach: u64) -> Vec<(u64, u64)> {
    ranges.sort_unstable();
    let mut out: Vec<(u64, u64)> = Vec::new();
    for (from, to) in ranges {
        match out.last_mut().filter(|last| from <= last.1.saturating_add(reach)) {
            Some(last) => last.1 = last.1.max(to),
            None => out.push((from, to)),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use kontur_filters::kernel::Tap;
    use std::sync::Arc;

    /// A path that comes along x and turns off to y in `passed`, at any speeds up to 1 in a cycle: no point of the line
    /// between two filtered points is further from the path's mean point than the bound, and at full speed it comes near.
    #[test]
    fn no_set_point_is_further_aside_than_the_bound() {
        let mut seed = 7_u64;
        let mut random = || {
            seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (seed >> 11) as f64 / (1_u64 << 53) as f64
        };
        let mut closest = 0.0_f64;
        for round in 0..400 {
            let taps: Vec<Tap> = (0..2 + (4.0 * random()) as u32)
                .map(|_| Tap { delay: (30.0 * random()) as u32, weight: 0.1 + random() })
                .collect();
            let kernel = Kernel::from_taps(taps).unwrap_or_else(Kernel::identity);
            let kernels = Kernels::new(vec![Some(Arc::new(kernel.clone())); 2]);
            let beyond = Beyond::new(&kernels);
            let slowest = if round % 2 == 0 { 1.0 } else { random() };
            let mut s = vec![-60.0];
            for _ in 0..160 {
                s.push(s[s.len() - 1] + slowest + (1.0 - slowest) * random());
            }
            let Some(first) = s.iter().position(|s| *s > 0.0) else { continue };
            let passed = first as f64 - s[first] / (s[first] - s[first - 1]);
            for k in 40..s.len() {
                let at = |k: usize| {
                    let mean = |f: &dyn Fn(f64) -> f64| -> f64 {
                        kernel.taps().iter().map(|t| t.weight * f(s[k - t.delay as usize])).sum()
                    };
                    [mean(&|s| s.min(0.0)), mean(&|s| s.max(0.0)), mean(&|s| s)]
                };
                let (a, b) = (at(k - 1), at(k));
                for part in 0..=8 {
                    let u = f64::from(part) / 8.0;
                    let [x, y, middle] = [0, 1, 2].map(|i| a[i] + u * (b[i] - a[i]));
                    let aside = [x - middle.min(0.0), y - middle.max(0.0)];
                    // both axes turn by 1, in opposite directions of the path
                    let most = aside.iter().fold(0.0_f64, |m, c| m.max(c.abs()));
                    let x = k as f64 - passed;
                    let inside = (0.0..=f64::from(kernel.length()) + 2.0).contains(&x);
                    let bound = if inside { beyond.at(x) } else { 0.0 };
                    assert!(most <= bound + 1e-9, "{round} {k}: {most} of {bound}");
                    if bound > 0.5 && slowest >= 1.0 {
                        closest = closest.max(most / bound);
                    }
                }
            }
        }
        assert!(closest > 0.9, "{closest}");
    }
}
