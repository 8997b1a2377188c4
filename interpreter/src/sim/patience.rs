//! Detects waits for axes that cannot end: the loop is at rest, or oscillates without decaying.
//!
//! The loop is linear and its input is constant. A settling distance decreases by at least the share `P / tau` in a
//! period `P`. The slowest loop that a list can describe (kv = 0.01/s) has `tau` = 100 s, so a change of less than a
//! thousandth means a standstill, unless the change increases: then a slow filter has only just begun to move. A slow
//! filter also passes its turning point slowly, with a change that decreases for a few periods; a change that is not zero
//! is therefore observed for longer. A decaying vibration loses more than a thousandth of its amplitude in one of ten
//! periods.

use kontur_filters::time::CycleTime;

/// Shortest and longest period in s for detecting a standstill.
const PERIOD_S: (f64, f64) = (0.2, 1.0);
/// Period in s over which vibrations are compared; machines do not vibrate at less than 1 Hz.
const SWING_S: f64 = 1.0;
/// Relative change in a period below which the distance counts as constant.
const CHANGE: f64 = 1e-3;
/// Relative change in a period that is rounding.
const NOTHING: f64 = 1e-9;
/// Number of periods with a small change after which it counts as a standstill: one second and a quarter before its turning
/// point a filter of 0.01 Hz, the lowest of the list (P-AXIS-00067), changes by a thousandth in the shortest period.
const STILL: u32 = 10;
/// Number of periods without a smaller amplitude after which a vibration counts as permanent.
const SWINGS: u32 = 10;

/// Distances of one period.
#[derive(Clone, Copy, Debug)]
struct Period {
    cycles: u64,
    low_mm: f64,
    high_mm: f64,
}

impl Period {
    const EMPTY: Self = Self { cycles: 0, low_mm: f64::INFINITY, high_mm: f64::NEG_INFINITY };

    /// Adds one cycle; returns the range of the distances at the end of the period.
    fn add(&mut self, distance_mm: f64, length_s: f64, cycle: CycleTime) -> Option<(f64, f64)> {
        self.cycles += 1;
        self.low_mm = self.low_mm.min(distance_mm);
        self.high_mm = self.high_mm.max(distance_mm);
        let Self { low_mm, high_mm, .. } = *self;
        let over = cycle.time_of(self.cycles) >= length_s;
        over.then(|| {
            *self = Self::EMPTY;
            (low_mm, high_mm)
        })
    }
}

/// Observations of an axis that does not arrive.
#[derive(Clone, Copy, Debug)]
pub(super) struct Patience {
    still: Period,
    /// Way in the previous period.
    way_mm: f64,
    stills: u32,
    swing: Period,
    /// Range in the previous period of the vibration.
    before_mm: (f64, f64),
    swings: u32,
}

impl Default for Patience {
    fn default() -> Self {
        let (still, swing) = (Period::EMPTY, Period::EMPTY);
        let before_mm = (f64::INFINITY, f64::NEG_INFINITY);
        Self { still, way_mm: 0.0, stills: 0, swing, before_mm, swings: 0 }
    }
}

impl Patience {
    /// One cycle at a distance from the required position (signed); true when the axis will not get there. A standstill
    /// is observed over the settling time, or 1 s without one; ten times as long if the axis still creeps.
    pub(super) fn is_over(
        &mut self,
        distance_mm: f64,
        settling_s: Option<f64>,
        cycle: CycleTime,
    ) -> bool {
        let length_s = settling_s.unwrap_or(PERIOD_S.1).clamp(PERIOD_S.0, PERIOD_S.1);
        let peak = |(low, high): (f64, f64)| low.abs().max(high.abs());
        if let Some(range) = self.swing.add(distance_mm, SWING_S, cycle) {
            // a motion in one direction leaves the range of the previous period
            let returns = range.0 < self.before_mm.1 && range.1 > self.before_mm.0;
            let lasts = peak(range) >= (1.0 - CHANGE) * peak(self.before_mm);
            self.swings = if returns && lasts { self.swings + 1 } else { 0 };
            self.before_mm = range;
        }
        let still = self.still.add(distance_mm, length_s, cycle).is_some_and(|range| {
            let way_mm = range.1 - range.0;
            let before_mm = std::mem::replace(&mut self.way_mm, way_mm);
            let is_small = way_mm <= CHANGE * peak(range) && way_mm <= before_mm;
            self.stills = if is_small { self.stills + 1 } else { 0 };
            is_small && (way_mm <= NOTHING * peak(range) || self.stills >= STILL)
        });
        still || self.swings >= SWINGS
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Number of cycles until the wait is given up, at most 100 s.
    fn ends(settling_s: Option<f64>, distance_mm: impl Fn(f64) -> f64) -> Option<u32> {
        let mut patience = Patience::default();
        (0..100_000_u32).find(|k| {
            patience.is_over(distance_mm(f64::from(*k) * 1e-3), settling_s, CycleTime::DEFAULT)
        })
    }

    #[test]
    fn standing_still_is_seen_within_a_settling_time() {
        assert_eq!(ends(Some(0.3), |_| 0.02), Some(299));
        assert_eq!(ends(None, |_| -0.02), Some(999));
        // settles at 0.02 mm with 20 ms: at rest after about 0.2 s
        let settles = |t: f64| 0.02 + 2.0 * libm::exp(-t / 0.02);
        let k = ends(Some(0.2), settles).unwrap();
        assert!((399..800).contains(&k), "{k}");
    }

    #[test]
    fn what_still_settles_is_waited_for() {
        // an accelerating motion, like the start of a filter of higher order; the lowest gain of a list; vibrations
        // with a damping down to 0.001
        assert_eq!(ends(Some(0.2), |t| 2.0 - libm::pow(t / 100.0, 3.0)), None);
        assert_eq!(ends(Some(0.2), |t| 2.0 * libm::exp(-t / 100.0)), None);
        // the turning points of filters of 0.02 and 0.01 Hz
        for tau in [8.0, 16.0] {
            let turns = |t: f64| 2.0 * (0.3 + t / tau) * libm::exp(-t / tau);
            assert_eq!(ends(Some(0.2), turns), None);
            assert_eq!(ends(None, turns), None);
        }
        for (f, d) in [(1.0, 0.001), (11.0, 0.02), (53.0, 0.001)] {
            let w = std::f64::consts::TAU * f;
            let swings = |t: f64| 0.5 * libm::exp(-d * w * t) * libm::cos(w * t);
            // below a micrometre it has arrived
            let arrived = libm::log(500.0) / (d * w) * 1e3;
            let k = ends(Some(0.2), swings).map_or(f64::INFINITY, f64::from);
            assert!(k > arrived, "{f} Hz: {k} {arrived}");
        }
    }

    #[test]
    fn a_lasting_vibration_is_hopeless() {
        let k = ends(Some(0.2), |t| 0.1 + 0.05 * libm::sin(300.0 * t)).unwrap();
        assert!(k < 12_000, "{k}");
    }
}
