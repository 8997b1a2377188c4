//! Monitoring of the set positions after the axis filters: velocity, acceleration, jerk.
//!
//! Threshold = (1 + p/1000) x limit. An overshooting band-stop filter can trip it.
//!
//! Source: TF5200 axis parameters, P-AXIS-00439 to 00444; IDs 50118 and 50119 (velocity). No document gives the ID for
//! acceleration and jerk.

use crate::control::RANGE_MM;
use crate::control::fault::{Derivative, Fault, Faults};
use crate::time::CycleTime;

/// Permitted excess over the limit, 1 = 100 %.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Thresholds {
    /// Up to the warning.
    pub warn_ratio: f64,
    /// Up to the error.
    pub error_ratio: f64,
}

impl Thresholds {
    /// Never reached.
    pub const NEVER: Self = Self { warn_ratio: f64::INFINITY, error_ratio: f64::INFINITY };

    /// `None` if both are 0: monitoring off (acceleration and jerk only).
    fn watched(self) -> Option<Self> {
        (self.warn_ratio != 0.0 || self.error_ratio != 0.0).then_some(self)
    }
}

/// Limits and thresholds of one axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SetpointMonitorConfig {
    /// Largest velocity in mm/s (P-AXIS-00212), default 200.
    pub v_max_mm_s: f64,
    /// Largest acceleration in mm/s2 (P-AXIS-00008).
    pub a_max_mm_s2: f64,
    /// Largest jerk in mm/s3: largest acceleration / smallest ramp time (P-AXIS-00201).
    pub j_max_mm_s3: f64,
    /// Velocity (P-AXIS-00439, 00440), default 5 and 9 %; cannot be switched off.
    pub velocity: Thresholds,
    /// Acceleration (P-AXIS-00441, 00442), default 50 and 100 %.
    pub acceleration: Thresholds,
    /// Jerk (P-AXIS-00443, 00444), default off.
    pub jerk: Thresholds,
}

impl SetpointMonitorConfig {
    /// The vendor's thresholds for the limits of an axis.
    pub fn new(v_max_mm_s: f64, a_max_mm_s2: f64, j_max_mm_s3: f64) -> Self {
        Self {
            v_max_mm_s,
            a_max_mm_s2,
            j_max_mm_s3,
            velocity: Thresholds { warn_ratio: 0.05, error_ratio: 0.09 },
            acceleration: Thresholds { warn_ratio: 0.5, error_ratio: 1.0 },
            jerk: Thresholds { warn_ratio: 0.0, error_ratio: 0.0 },
        }
    }
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
enum Level {
    #[default]
    Good,
    Warning,
    Error,
}

/// Setpoint monitor with its state.
#[derive(Clone, Debug)]
pub struct SetpointMonitor {
    config: SetpointMonitorConfig,
    cycle_s: f64,
    past_mm: [f64; 3],
    levels: [Level; 3],
    /// Whether a level is above good.
    raised: bool,
    /// Magnitude of each difference of set positions in mm up to which its derivative certainly raises nothing.
    good_mm: [f64; 3],
}

/// Share of a threshold below which rounding cannot lead to an excess.
const CLEARLY: f64 = 1.0 - 1e-12;

/// Threshold of a limit. Sampled differences carry rounding noise, so a value at its threshold does not count as above
/// it.
fn threshold(ratio: f64, limit: f64) -> f64 {
    (1.0 + ratio) * limit * (1.0 + 1e-9)
}

impl SetpointMonitor {
    /// A monitor at rest.
    pub fn new(config: SetpointMonitorConfig, cycle: CycleTime) -> Self {
        let good = |limit: f64, thresholds: Option<Thresholds>| {
            thresholds.map_or(f64::INFINITY, |t| {
                threshold(t.warn_ratio, limit).min(threshold(t.error_ratio, limit))
            })
        };
        let t = cycle.seconds();
        let good_mm = [
            good(config.v_max_mm_s, Some(config.velocity)) * t * CLEARLY,
            good(config.a_max_mm_s2, config.acceleration.watched()) * (t * t) * CLEARLY,
            good(config.j_max_mm_s3, config.jerk.watched()) * (t * t * t) * CLEARLY,
        ];
        let (past_mm, levels) = ([0.0; 3], [Level::Good; 3]);
        Self { config, cycle_s: t, past_mm, levels, raised: false, good_mm }
    }

    /// Axis at rest at a position.
    pub fn start(&mut self, position_mm: f64) {
        self.past_mm = [position_mm; 3];
        (self.levels, self.raised) = ([Level::Good; 3], false);
    }

    /// Shifts the coordinate of the present position by `by_mm`.
    pub(crate) fn shift(&mut self, by_mm: f64) {
        for past_mm in &mut self.past_mm {
            *past_mm += by_mm;
        }
    }

    /// Whether a level is above good.
    pub(crate) const fn is_raised(&self) -> bool {
        self.raised
    }

    /// Number of leading cycles that certainly raise nothing.
    pub(crate) fn quiet(&self, set_mm: &[f64]) -> usize {
        if self.raised {
            return 0;
        }
        let [v, a, j] = self.good_mm;
        // the last one of four successive set positions
        let good = |w: &[f64]| {
            let (d1, d2, d3) = (w[3] - w[2], w[2] - w[1], w[1] - w[0]);
            (d1.abs() <= v)
                & ((d1 - d2).abs() <= a)
                & ((d1 - 2.0 * d2 + d3).abs() <= j)
                & (w[3].abs() <= RANGE_MM)
        };
        let [p1, p2, p3] = self.past_mm;
        let first = set_mm.len().min(3);
        let mut early = [p3, p2, p1, 0.0, 0.0, 0.0];
        early[3..3 + first].copy_from_slice(&set_mm[..first]);
        if let Some(loud) = early[..3 + first].windows(4).position(|w| !good(w)) {
            return loud;
        }
        let mut later = set_mm.windows(4);
        // asked without branches, several at a time; most rows are good as a whole
        if later.clone().fold(true, |all, w| all & good(w)) {
            return set_mm.len();
        }
        later.position(|w| !good(w)).map_or(set_mm.len(), |loud| first + loud)
    }

    /// Processes cycles that certainly raise nothing.
    pub(crate) fn pass(&mut self, set_mm: &[f64]) {
        for set_mm in &set_mm[set_mm.len().saturating_sub(3)..] {
            self.past_mm = [*set_mm, self.past_mm[0], self.past_mm[1]];
        }
    }

    /// One cycle: a fault for every derivative whose level rises.
    #[inline]
    pub(crate) fn step(&mut self, set_mm: f64, faults: &mut Faults) {
        let [p1, p2, p3] = self.past_mm;
        let (d1, d2, d3) = (set_mm - p1, p1 - p2, p2 - p3);
        self.past_mm = [set_mm, p1, p2];
        let differences = [d1, d1 - d2, d1 - 2.0 * d2 + d3];
        let good = differences.iter().zip(&self.good_mm).all(|(mm, good)| mm.abs() <= *good);
        if !good || self.raised {
            self.judge(differences, faults);
        }
    }

    /// The same for a cycle that may raise something.
    #[cold]
    fn judge(&mut self, differences: [f64; 3], faults: &mut Faults) {
        let t = self.cycle_s;
        let values = [differences[0] / t, differences[1] / (t * t), differences[2] / (t * t * t)];
        let c = self.config;
        let watched = [
            (Derivative::Velocity, values[0], c.v_max_mm_s, Some(c.velocity)),
            (Derivative::Acceleration, values[1], c.a_max_mm_s2, c.acceleration.watched()),
            (Derivative::Jerk, values[2], c.j_max_mm_s3, c.jerk.watched()),
        ];
        for (i, (what, value, limit, thresholds)) in watched.into_iter().enumerate() {
            let Some(thresholds) = thresholds else { continue };
            let value = value.abs();
            let above = |ratio: f64| value > threshold(ratio, limit);
            let level = match (above(thresholds.error_ratio), above(thresholds.warn_ratio)) {
                (true, _) => Level::Error,
                (false, true) => Level::Warning,
                (false, false) => Level::Good,
            };
            let before = std::mem::replace(&mut self.levels[i], level);
            faults.push(match level {
                Level::Error if before < level => {
                    let limit = (1.0 + thresholds.error_ratio) * limit;
                    Some(Fault::SetpointError { what, value, limit })
                }
                Level::Warning if before < level => {
                    let limit = (1.0 + thresholds.warn_ratio) * limit;
                    Some(Fault::SetpointWarning { what, value, limit })
                }
                _ => None,
            });
        }
        self.raised = self.levels != [Level::Good; 3];
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is watched, and whether it is an error, of every fault of each step.
    fn faults(config: SetpointMonitorConfig, steps_mm: &[f64]) -> Vec<Vec<(Derivative, bool)>> {
        let mut m = SetpointMonitor::new(config, CycleTime::DEFAULT);
        m.start(5.0);
        let mut x = 5.0;
        steps_mm
            .iter()
            .map(|d| {
                x += d;
                let mut faults = Faults::default();
                m.step(x, &mut faults);
                faults
                    .iter()
                    .map(|fault| match *fault {
                        Fault::SetpointWarning { what, value, limit } => {
                            assert!(value > limit, "{fault:?}");
                            (what, false)
                        }
                        Fault::SetpointError { what, value, limit } => {
                            assert!(value > limit, "{fault:?}");
                            (what, true)
                        }
                        _ => panic!("{fault:?}"),
                    })
                    .collect()
            })
            .collect()
    }

    #[test]
    fn velocity_warns_at_five_percent_and_stops_at_nine() {
        let config = SetpointMonitorConfig::new(200.0, 1e12, 1e18);
        let v = [0.200, 0.2099, 0.2101, 0.2105, 0.2181, 0.2185, 0.2, 0.2101];
        let got = faults(config, &v);
        let (warning, error) =
            (vec![(Derivative::Velocity, false)], vec![(Derivative::Velocity, true)]);
        let none = vec![];
        assert_eq!(
            got,
            [&none, &none, &warning, &none, &error, &none, &none, &warning].map(Clone::clone)
        );
        assert_eq!(faults(config, &[-0.25]), [error], "either direction");
    }

    /// Speeds a few of the smallest steps around a threshold, in cycles of any length: a fault if and only if the
    /// quotient is above it.
    #[test]
    fn a_threshold_is_met_to_the_last_bit() {
        for (limit, us) in [(200.0, 1000), (0.3, 250), (1e5 / 3.0, 125), (17.7, 2000)] {
            let cycle = CycleTime::from_us(us).unwrap();
            let config = SetpointMonitorConfig::new(limit, 1e18, 1e18);
            let above = threshold(config.velocity.warn_ratio, limit);
            let mut step_mm = above * cycle.seconds();
            for _ in 0..8 {
                step_mm = step_mm.next_down();
            }
            for _ in 0..16 {
                step_mm = step_mm.next_up();
                for step_mm in [step_mm, step_mm * (1.0 - 1e-12), step_mm * (1.0 - 3e-12)] {
                    let mut m = SetpointMonitor::new(config, cycle);
                    let mut faults = Faults::default();
                    m.start(0.0);
                    m.step(step_mm, &mut faults);
                    assert_eq!(!faults.is_empty(), step_mm / cycle.seconds() > above, "{step_mm}");
                }
            }
        }
    }

    /// 5 and 9 % above 200 mm/s.
    #[test]
    fn the_limit_of_a_fault_is_its_threshold() {
        let mut m =
            SetpointMonitor::new(SetpointMonitorConfig::new(200.0, 1e12, 1e18), CycleTime::DEFAULT);
        for (step_mm, want) in [(0.2105, 210.0), (0.2185, 218.0)] {
            m.start(0.0);
            let mut faults = Faults::default();
            m.step(step_mm, &mut faults);
            let limits = faults.iter().map(|fault| match *fault {
                Fault::SetpointWarning { limit, .. } | Fault::SetpointError { limit, .. } => limit,
                _ => panic!("{fault:?}"),
            });
            let limits: Vec<_> = limits.collect();
            assert!(matches!(limits[..], [limit] if (limit - want).abs() < 1e-9), "{limits:?}");
        }
    }

    #[test]
    fn acceleration_and_jerk() {
        let config = SetpointMonitorConfig::new(1e9, 1000.0, 1e5);
        // 0.0016 mm in one cycle from rest: 1600 mm/s2 and 1.6e6 mm/s3, jerk is off
        assert_eq!(faults(config, &[0.0014]), [vec![]]);
        assert_eq!(faults(config, &[0.0016]), [vec![(Derivative::Acceleration, false)]]);
        assert_eq!(faults(config, &[0.0021]), [vec![(Derivative::Acceleration, true)]]);
        let off = Thresholds { warn_ratio: 0.0, error_ratio: 0.0 };
        let jerk = Thresholds { warn_ratio: 0.0, error_ratio: 1.0 };
        let config = SetpointMonitorConfig { acceleration: off, jerk, ..config };
        assert_eq!(faults(config, &[0.00009, 0.00018]), [vec![], vec![]]);
        assert_eq!(faults(config, &[0.00011]), [vec![(Derivative::Jerk, false)]]);
        assert_eq!(faults(config, &[0.00021]), [vec![(Derivative::Jerk, true)]]);
    }
}
