//! What a sharp corner costs where the tolerance is monitored (`AX_DEV`).
//!
//! Around a corner the set point of equal filters is `A u2 - B u1` away from it: `B` is the mean over the filter of the
//! distances before the corner, which falls with time, `A` that of the distances behind it, which rises. It comes
//! nearest to the corner about where both have the same value `M`, and misses it by `M |u2 - u1|`. A dwell `d` delays
//! `A`. With the times at which `B` has fallen and `A` without a dwell has risen to `m = tolerance / |u2 - u1|`,
//! the tolerance is kept if `d >= t_B - t_A`. Either no dwell is needed at the speed of the kink, or at a lower one,
//! or the path stops.
//!
//! A curve much shorter than the path within the filter is a corner with a dwell as long as it takes, which comes
//! nearer by its own distance from the corner. Where the curve is slowed down, its speed has to be kept as long as the
//! filter holds the curve, while a stop takes place at one point: such a curve counts as slower by the length of the
//! filter. Its dwell does not count for the sharp corner, as it is only a bound. Curves much longer than the path
//! within the filter keep the tolerance where `v^2 bend / 2` times the variance of the filter does.
//!
//! The planner does not use these speeds: it measures every plan.

use super::{Part, Side};
use crate::block::Block;
use crate::profile::Profile;
use crate::tolerance::Kernels;
use kontur_filters::kernel::Kernel;
use kontur_filters::time::CycleTime;

/// Halvings in the search for a time or a speed.
const HALVINGS: u32 = 12;

/// A filter that all axes share, and the tolerance in mm at a corner.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Monitored<'a> {
    kernel: &'a Kernel,
    /// Weights and delays in cycles.
    taps: &'a [(f64, f64)],
    cycle: CycleTime,
    tolerance_mm: f64,
}

/// The speed at the corner is only known to the planner.
#[derive(Clone, Copy, Debug)]
pub(crate) struct OnlyPlanned;

/// How a sharp corner is passed.
#[derive(Clone, Copy, Debug)]
pub(super) struct Passing {
    pub(super) v_mm_s: f64,
    pub(super) dwell_s: f64,
}

/// The way from a corner: the distance over time, on either side of it.
struct Departure {
    profile: Option<Profile>,
    v_mm_s: f64,
    before: bool,
}

impl Departure {
    /// As fast as the side permits from `v` on, up to the speed in its middle.
    fn new(side: &Side, v: f64) -> Self {
        let (slope, to) = (&side.slope, side.leg(v, side.v_mm_s, side.half_mm).0.max(v));
        let profile = if side.before {
            slope.plan(to, v, to, slope.down_distance(to, v))
        } else {
            slope.plan(v, to, to, slope.up_distance(v, to))
        };
        Self { profile: profile.ok(), v_mm_s: to, before: side.before }
    }

    fn at(&self, t: f64) -> f64 {
        let Some(profile) = &self.profile else { return self.v_mm_s * t.max(0.0) };
        let (whole, length) = (profile.duration(), profile.length());
        if t <= 0.0 {
            0.0
        } else if t >= whole {
            length + self.v_mm_s * (t - whole)
        } else if self.before {
            length - profile.at(whole - t).s_mm
        } else {
            profile.at(t).s_mm
        }
    }
}

impl<'a> Monitored<'a> {
    /// The tolerance at the corner between two blocks, if one applies.
    ///
    /// # Errors
    /// [`OnlyPlanned`] if the filters differ between the axes or overshoot.
    pub(crate) fn between(
        blocks: [&Block; 2],
        kernels: &'a Kernels,
        cycle: CycleTime,
    ) -> Result<Option<Self>, OnlyPlanned> {
        let tolerances = blocks.into_iter().filter_map(|b| b.tolerance.ax_dev_mm);
        match tolerances.reduce(f64::min).filter(|_| kernels.any()) {
            Some(tolerance_mm) => {
                Self::new(kernels, cycle, tolerance_mm).map(Some).ok_or(OnlyPlanned)
            }
            None => Ok(None),
        }
    }

    fn new(kernels: &'a Kernels, cycle: CycleTime, tolerance_mm: f64) -> Option<Self> {
        let (kernel, taps) = kernels.shared()?;
        Some(Self { kernel, taps, cycle, tolerance_mm })
    }

    /// Shortest dwell in s with which the set path passes a corner at `v` within a mean distance of `m` mm; negative if
    /// it could be faster.
    pub(super) fn dwell_s(&self, sides: &[Side; 2], v: f64, m: f64) -> f64 {
        let [before, behind] = sides.each_ref().map(|side| Departure::new(side, v));
        let t = self.cycle.seconds();
        let taps = || self.taps.iter().map(|(w, delay)| (w, delay * t));
        let before = |at: f64| taps().map(|(w, delay)| w * before.at(delay - at)).sum::<f64>();
        let behind = |at: f64| taps().map(|(w, delay)| w * behind.at(at - delay)).sum::<f64>();
        let reach = self.reach_s();
        let crossing = |is_past: &dyn Fn(f64) -> bool| {
            let (mut low, mut high) = (0.0, reach);
            for _ in 0..HALVINGS {
                let mid = 0.5 * (low + high);
                if is_past(mid) { high = mid } else { low = mid }
            }
            high
        };
        crossing(&|at| before(at) <= m) - crossing(&|at| behind(at) >= m)
    }

    /// How the planner passes a corner with the largest change `turn` of a component of the direction, at most at
    /// `most` mm/s.
    pub(super) fn sharp(&self, sides: &[Side; 2], turn: f64, most: f64) -> Passing {
        let m = self.tolerance_mm / turn;
        let dwell_s = |v: f64| self.dwell_s(sides, v, m);
        if dwell_s(most) <= 0.0 {
            return Passing { v_mm_s: most, dwell_s: 0.0 };
        }
        let at_rest = dwell_s(0.0);
        if at_rest > 0.0 {
            return Passing { v_mm_s: 0.0, dwell_s: at_rest };
        }
        let (mut low, mut high) = (0.0, most);
        for _ in 0..HALVINGS {
            let mid = 0.5 * (low + high);
            if dwell_s(mid) <= 0.0 { low = mid } else { high = mid }
        }
        Passing { v_mm_s: low, dwell_s: 0.0 }
    }

    /// Highest speed in mm/s at which a curve that bends by at most `bend` 1/mm keeps the tolerance.
    fn on_a_bend(&self, bend: f64) -> f64 {
        let t = self.cycle.seconds();
        let spread_s2 = self.kernel.variance_cycles2() * t * t;
        (2.0 * self.tolerance_mm / (spread_s2 * bend.max(1e-9))).sqrt()
    }

    /// The parts of a curve, which comes within `off_mm` of a corner, at speeds that keep the tolerance: as a corner, if the
    /// filter holds all of it, or by their bends; `share`: of the filter, see [`Passage::corner_share`](super::Passage).
    pub(super) fn limited(&self, parts: &[Part], turn: f64, off_mm: f64, share: f64) -> Vec<Part> {
        let m1_s = self.kernel.m1_cycles() * self.cycle.seconds();
        let as_corner = (self.tolerance_mm + off_mm) / (m1_s * turn);
        let held_s: f64 =
            parts.iter().map(|part| part.length_mm / part.v_mm_s.min(as_corner)).sum();
        let as_corner = if held_s < share * self.reach_s() { as_corner } else { 0.0 };
        let of = |part: &Part| {
            let v_mm_s = part.v_mm_s.min(self.on_a_bend(part.bend).max(as_corner));
            Part { v_mm_s, ..*part }
        };
        parts.iter().map(of).collect()
    }

    /// Whether a curve as a whole takes as long as a stop at the corner would have to.
    pub(super) fn passes(&self, sides: &[Side; 2], parts: &[Part], turn: f64, off_mm: f64) -> bool {
        let slowest = super::slowest(parts);
        let needed_s = self.dwell_s(sides, slowest, (self.tolerance_mm + off_mm) / turn);
        parts.iter().map(|part| part.length_mm).sum::<f64>() / slowest >= needed_s
    }

    /// How long the filter holds what has been passed, in s: a speed that the tolerance demands is kept before and
    /// after the curve as well.
    pub(super) fn reach_s(&self) -> f64 {
        f64::from(self.kernel.length()) * self.cycle.seconds()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::profile::{RampShape, RampedLimits, SlopeLimits};
    use kontur_filters::kernel::Tap;
    use std::sync::Arc;

    /// Weight 1 / (n + 1) over n cycles: a moving average.
    fn average(n: u32) -> Kernels {
        let weight = 1.0 / f64::from(n + 1);
        let taps = (0..=n).map(|delay| Tap { delay, weight });
        Kernels::new(vec![Some(Arc::new(Kernel::from_taps(taps).unwrap())); 2])
    }

    fn sides(v_mm_s: f64) -> [Side; 2] {
        let limits = RampedLimits::new(RampShape::Trapez, false, 1000.0, 1000.0, [0.05; 4]);
        let slope = SlopeLimits::Ramped(limits);
        [true, false].map(|before| Side {
            slope: slope.clone(),
            v_mm_s,
            half_mm: 10.0,
            before,
            across: true,
        })
    }

    /// Without ramps, a moving average over `L` leaves `B(t) = v (L - t)^2 / 2 L` before the corner and
    /// `A(t) = v t^2 / 2 L` behind it: both are `m` with a dwell of `L - 2 sqrt(2 L m / v)`. The taps
    /// are reduced to 24, 20 ms each.
    #[test]
    fn dwell_after_a_moving_average() {
        let cycle = CycleTime::from_us(1000).unwrap();
        let kernels = average(480);
        let monitored = Monitored::new(&kernels, cycle, 0.01).unwrap();
        for v in [5.0, 20.0, 100.0] {
            for m in [1e-3, 0.01, 0.1, 0.5] {
                let dwell = monitored.dwell_s(&sides(v), v, m);
                let expected = 0.48 - 2.0 * f64::sqrt(2.0 * 0.48 * m / v);
                assert!((dwell - expected).abs() < 0.02, "{v} {m}: {dwell} {expected}");
            }
        }
    }

    /// The speed that needs no dwell at constant speed is that of the first moment: `m / M1`, for the average
    /// `M1 = L / 8`.
    #[test]
    fn speed_without_a_dwell() {
        let cycle = CycleTime::from_us(1000).unwrap();
        let kernels = average(480);
        let monitored = Monitored::new(&kernels, cycle, 0.01).unwrap();
        for turn in [0.1, 0.5, 1.4] {
            let v = 0.01 / turn / (0.48 / 8.0);
            let passing = |v: f64| monitored.sharp(&sides(v), turn, v);
            assert!(passing(0.95 * v).v_mm_s >= 0.95 * v, "{turn}");
            assert!(passing(1.05 * v).v_mm_s < 1.05 * v, "{turn}");
        }
    }
}
