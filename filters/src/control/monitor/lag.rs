//! Following-error monitoring: permitted lag of types 1, 2 and 4.
//!
//! Source: TF5200 position lag monitoring, P-AXIS-00167 to 00172, 00176, 00191, 00488. The vendor has dropped type 3;
//! it and any other value switch the monitor off.

use crate::control::fault::Fault;
use crate::time::CycleTime;

/// Kind of monitoring (P-AXIS-00172), default off.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LagMonitorType {
    /// 0 and any other value.
    #[default]
    Off,
    /// 1: estimation filter on the commanded movement between `lag_min` and `lag_max`; ignores Kv.
    ///
    /// Assumption on the filter: `s = q (s + |dx|)`, `q = dynamics / 1024`; 1024 switches off, as documented.
    Standard,
    /// 2: the theoretical lag v/Kv times a factor, not below `lag_max` while moving; at rest `lag_min`.
    ///
    /// Assumption on the factor: `1024 / (1024 - dynamics)`, 1 at 0 and off at 1024; the manual shows its formula as a
    /// picture.
    Linear,
    /// 4: `lag_max` while moving, `lag_min` at rest; meant for full feedforward.
    VelocityIndependent,
}

/// Following-error monitoring of one axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LagMonitorConfig {
    /// Kind (P-AXIS-00172).
    pub kind: LagMonitorType,
    /// Filter constant or slope factor (P-AXIS-00167), up to 1024, default 1000; 1024 switches types 1 and 2 off.
    pub dynamics: f64,
    /// Largest permitted lag (types 1, 4), lower bound while moving (type 2), in mm (P-AXIS-00168), default 10.
    pub lag_max_mm: f64,
    /// Permitted lag at rest in mm (P-AXIS-00169), default 2; recommended five times the real one.
    pub lag_min_mm: f64,
    /// Shift of the limit curve in s (P-AXIS-00170), default 0.
    pub shift_s: f64,
    /// Time in s for which type 4 tolerates a lag above the limit (P-AXIS-00488), up to 0.25, default 0.
    pub tolerance_s: f64,
    /// Cycles between command and actual value (P-AXIS-00191), 0..=10. The vendor's default of 4 holds for digital
    /// drives; 0 for the simulated one.
    pub delay_cycles: usize,
    /// Compute the limit but raise nothing (P-AXIS-00176), default false.
    pub suppress: bool,
}

impl Default for LagMonitorConfig {
    fn default() -> Self {
        Self {
            kind: LagMonitorType::Off,
            dynamics: 1000.0,
            lag_max_mm: 10.0,
            lag_min_mm: 2.0,
            shift_s: 0.0,
            tolerance_s: 0.0,
            delay_cycles: 0,
            suppress: false,
        }
    }
}

/// Following-error monitor with its state.
#[derive(Clone, Debug)]
pub struct LagMonitor {
    config: LagMonitorConfig,
    cycle: CycleTime,
    /// Past references, newest first.
    past_mm: [f64; Self::MEMORY],
    /// Past commanded movements for the shift of the limit, a ring.
    steps_mm: Vec<f64>,
    next: usize,
    /// Cycles without commanded movement.
    still: usize,
    /// The last cycle changed nothing that further cycles without movement could still change.
    rests: bool,
    estimate_mm: f64,
    excess_cycles: u64,
    raised: bool,
    lag_mm: f64,
    limit_mm: Option<f64>,
}

impl LagMonitor {
    /// Largest delay of the actual value in cycles.
    pub(crate) const MAX_DELAY: usize = 10;
    /// Number of past references that are kept for the delay of the actual value.
    pub(crate) const MEMORY: usize = Self::MAX_DELAY + 2;
    /// Longest shift of the limit curve in cycles.
    const MAX_SHIFT: usize = 10_000;
    /// Relative excess over the limit that is attributed to rounding.
    const ROUNDING: f64 = 1e-9;
    /// Scale of P-AXIS-00167.
    const FULL: f64 = 1024.0;

    /// A monitor at rest.
    pub fn new(mut config: LagMonitorConfig, cycle: CycleTime) -> Self {
        config.delay_cycles = config.delay_cycles.min(Self::MAX_DELAY);
        let shift = (1..=Self::MAX_SHIFT)
            .take_while(|k| (*k as f64 - 0.5) * cycle.seconds() <= config.shift_s)
            .count();
        Self {
            config,
            cycle,
            past_mm: [0.0; Self::MEMORY],
            steps_mm: vec![0.0; shift + 1],
            next: 0,
            still: 0,
            rests: false,
            estimate_mm: 0.0,
            excess_cycles: 0,
            raised: false,
            lag_mm: 0.0,
            limit_mm: None,
        }
    }

    /// Axis at rest at a position.
    pub fn start(&mut self, position_mm: f64) {
        self.past_mm.fill(position_mm);
        self.steps_mm.fill(0.0);
        (self.still, self.rests) = (0, false);
        self.estimate_mm = 0.0;
        self.excess_cycles = 0;
        self.raised = false;
    }

    /// Following error of the last cycle in mm, with the delay of the actual value taken into account.
    pub const fn lag_mm(&self) -> f64 {
        self.lag_mm
    }

    /// Permitted lag of the last cycle in mm, `None` while the monitor is off.
    pub const fn limit_mm(&self) -> Option<f64> {
        self.limit_mm
    }

    /// Whether further cycles change nothing as long as reference, actual position and gain stay the same.
    pub(crate) const fn rests(&self) -> bool {
        self.rests
    }

    /// Shifts the coordinate of the present position by `by_mm`.
    pub(crate) fn shift(&mut self, by_mm: f64) {
        for past_mm in &mut self.past_mm {
            *past_mm += by_mm;
        }
        (self.still, self.rests) = (0, false);
    }

    /// Whether every cycle matters (the monitor is on). Otherwise only as many of the last ones as it
    /// [remembers](Self::MEMORY).
    #[inline]
    pub(crate) fn needs_every_cycle(&self) -> bool {
        self.config.kind != LagMonitorType::Off
    }

    /// Takes the reference of a cycle in mm; the last cycle of a row is a [step](Self::step).
    #[inline]
    pub(crate) fn remember(&mut self, reference_mm: f64) {
        for i in (0..=self.config.delay_cycles).rev() {
            self.past_mm[i + 1] = self.past_mm[i];
        }
        self.past_mm[0] = reference_mm;
    }

    /// One cycle: reference and actual position in mm, gain of the position controller in 1/s.
    #[inline]
    pub fn step(&mut self, reference_mm: f64, actual_mm: f64, kv_per_s: f64) -> Option<Fault> {
        self.remember(reference_mm);
        let commanded = self.past_mm[self.config.delay_cycles];
        self.lag_mm = commanded - actual_mm;
        if self.config.kind == LagMonitorType::Off {
            self.rests = true;
            return None;
        }
        self.watch(commanded, kv_per_s)
    }

    /// Compares the lag of this cycle with the permitted one.
    fn watch(&mut self, commanded: f64, kv_per_s: f64) -> Option<Fault> {
        let delay = self.config.delay_cycles;
        let newest = (commanded - self.past_mm[delay + 1]).abs();
        self.still = if newest > 0.0 { 0 } else { self.still.saturating_add(1) };
        let estimate = self.estimate_mm;
        let step = self.shifted(newest);
        self.limit_mm = self.limit(step, kv_per_s);
        self.rests = self.still > self.steps_mm.len()
            && self.estimate_mm.to_bits() == estimate.to_bits()
            && !self.limit_mm.is_some_and(|limit_mm| self.exceeds(limit_mm));
        let Some(limit_mm) = self.limit_mm.filter(|limit_mm| self.exceeds(*limit_mm)) else {
            self.excess_cycles = 0;
            self.raised = false;
            return None;
        };
        self.excess_cycles += 1;
        let tolerated = self.config.kind == LagMonitorType::VelocityIndependent
            && self.cycle.time_of(self.excess_cycles - 1) < self.config.tolerance_s - 1e-9;
        if tolerated || self.config.suppress || self.raised {
            return None;
        }
        self.raised = true;
        Some(Fault::FollowingError { lag_mm: self.lag_mm, limit_mm })
    }

    /// Whether the lag exceeds a limit by more than rounding; at constant speed it approaches `v / kv` to the last
    /// digits.
    fn exceeds(&self, limit_mm: f64) -> bool {
        self.lag_mm.abs() > limit_mm * (1.0 + Self::ROUNDING)
    }

    /// Commanded movement per cycle, `shift_s` ago.
    fn shifted(&mut self, step_mm: f64) -> f64 {
        self.steps_mm[self.next] = step_mm;
        self.next = (self.next + 1) % self.steps_mm.len();
        self.steps_mm[self.next]
    }

    fn limit(&mut self, step_mm: f64, kv_per_s: f64) -> Option<f64> {
        let c = &self.config;
        let moving = step_mm > 0.0;
        match c.kind {
            LagMonitorType::Off => None,
            LagMonitorType::Standard => {
                let q = c.dynamics / Self::FULL;
                if q >= 1.0 {
                    return None;
                }
                self.estimate_mm = q * (self.estimate_mm + step_mm);
                Some(self.estimate_mm.min(c.lag_max_mm).max(c.lag_min_mm))
            }
            LagMonitorType::Linear if c.dynamics >= Self::FULL => None,
            LagMonitorType::Linear if moving => {
                let theoretical = step_mm / self.cycle.seconds() / kv_per_s;
                Some((theoretical * Self::FULL / (Self::FULL - c.dynamics)).max(c.lag_max_mm))
            }
            LagMonitorType::VelocityIndependent if moving => Some(c.lag_max_mm),
            LagMonitorType::Linear | LagMonitorType::VelocityIndependent => Some(c.lag_min_mm),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn monitor(config: LagMonitorConfig) -> LagMonitor {
        let mut m = LagMonitor::new(config, CycleTime::DEFAULT);
        m.start(0.0);
        m
    }

    /// 0.1 mm per cycle (100 mm/s) for 3000 cycles with a constant lag: the limit at the end and the first fault.
    fn drive(m: &mut LagMonitor, lag_mm: f64) -> (Option<f64>, Option<(u32, Fault)>) {
        let mut first = None;
        for k in 1..=3000_u32 {
            let x = 0.1 * f64::from(k);
            if let Some(f) = m.step(x, x - lag_mm, 50.0) {
                first.get_or_insert((k, f));
            }
        }
        (m.limit_mm(), first)
    }

    /// `x - (x - 2)` exceeds 2 by rounding in some cycles, which is not a fault; one more increment is.
    #[test]
    fn a_lag_at_its_limit_does_not_exceed_it() {
        for kind in [LagMonitorType::VelocityIndependent, LagMonitorType::Linear] {
            let c = LagMonitorConfig { kind, lag_max_mm: 2.0, dynamics: 0.0, ..Default::default() };
            assert_eq!(drive(&mut monitor(c), 2.0).1, None, "{kind:?}");
            assert!(drive(&mut monitor(c), 2.0001).1.is_some(), "{kind:?}");
        }
    }

    #[test]
    fn standard_estimates_from_the_movement() {
        let c = LagMonitorConfig {
            kind: LagMonitorType::Standard,
            dynamics: 1000.0,
            ..Default::default()
        };
        // constant speed gives |dx| q / (1 - q)
        let want = 0.1 * 1000.0 / 24.0;
        let (limit, fault) = drive(&mut monitor(c), 1.9);
        assert!((limit.unwrap() - want).abs() < 1e-9, "{limit:?} {want}");
        assert_eq!(fault, None);
        let (_, fault) = drive(&mut monitor(c), want + 0.01);
        let (k, fault) = fault.unwrap();
        assert_eq!(k, 1, "at the start the limit is that at rest");
        assert!(matches!(fault, Fault::FollowingError { .. }));
        let off = LagMonitorConfig { dynamics: 1024.0, ..c };
        assert_eq!(drive(&mut monitor(off), 100.0), (None, None));
        let low = LagMonitorConfig { lag_max_mm: 3.0, ..c };
        assert_eq!(drive(&mut monitor(low), 0.0).0, Some(3.0));
    }

    #[test]
    fn linear_follows_the_theoretical_lag() {
        let c = LagMonitorConfig {
            kind: LagMonitorType::Linear,
            dynamics: 512.0,
            lag_max_mm: 0.5,
            lag_min_mm: 0.1,
            ..Default::default()
        };
        // v/Kv = 2 mm, factor 2
        let (limit, fault) = drive(&mut monitor(c), 3.9);
        assert!((limit.unwrap() - 4.0).abs() < 1e-9);
        assert_eq!(fault, None);
        assert_eq!(drive(&mut monitor(c), 4.1).1.map(|f| f.0), Some(1));
        let mut m = monitor(c);
        drive(&mut m, 0.0);
        assert!(m.step(300.0, 299.8, 50.0).is_some(), "at rest 0.1 mm");
        assert_eq!(m.limit_mm(), Some(0.1));
    }

    #[test]
    fn velocity_independent_tolerates_for_a_time() {
        let c = LagMonitorConfig {
            kind: LagMonitorType::VelocityIndependent,
            tolerance_s: 0.005,
            ..Default::default()
        };
        assert_eq!(drive(&mut monitor(c), 9.9), (Some(10.0), None));
        assert_eq!(drive(&mut monitor(c), 10.1).1.map(|f| f.0), Some(6));
        assert_eq!(
            drive(&mut monitor(LagMonitorConfig { suppress: true, ..c }), 10.1),
            (Some(10.0), None)
        );
        assert_eq!(
            drive(&mut monitor(LagMonitorConfig::default()), 1e6),
            (None, None),
            "off by default"
        );
    }

    #[test]
    fn delay_of_the_actual_value_is_taken_out() {
        let c = LagMonitorConfig {
            kind: LagMonitorType::VelocityIndependent,
            delay_cycles: 4,
            ..Default::default()
        };
        let mut m = monitor(c);
        drive(&mut m, 0.4);
        assert!(m.lag_mm().abs() < 1e-9, "four cycles of 0.1 mm: {}", m.lag_mm());
    }

    #[test]
    fn shift_holds_the_limit_after_the_movement() {
        let c = LagMonitorConfig {
            kind: LagMonitorType::VelocityIndependent,
            shift_s: 0.020,
            ..Default::default()
        };
        let mut m = monitor(c);
        drive(&mut m, 0.0);
        let held = (0..100).take_while(|_| m.step(300.0, 295.0, 50.0).is_none()).count();
        assert_eq!(held, 20);
    }
}
