//! Position monitoring: the axis must be inside the exact-stop window in time.
//!
//! Source: TF5200 position monitoring. The timer starts (t1) in the cycle in which the set position, after all
//! filters, has reached the target of the stop and the path is no longer interpolated; it ends (t2) when the actual position is inside the window.
//!
//! A window of 0 means half an increment: the vendor compares whole increments, and an actual position that is off by
//! less than half an increment counts as the same one.

use crate::control::fault::Fault;
use crate::time::CycleTime;

/// Window and time of the exact stop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExactStopConfig {
    /// Half width of the window in mm (P-AXIS-00236), default 0.05, at least half an increment; recommended: three times
    /// the lag at rest.
    pub window_mm: f64,
    /// Time in s to reach it (P-AXIS-00532, if negative P-AXIS-00151), default 1; `None`: not monitored (value 0).
    /// Recommended 0.010 to 0.200.
    pub settling_s: Option<f64>,
    /// Distance in mm below which a set position has reached its target, because recursive filters only approach it
    /// (P-AXIS-00351); at least half an increment.
    pub reached_mm: f64,
}

impl ExactStopConfig {
    /// Half of the vendor's position increment of 0.1 um (0.0001 deg).
    pub const HALF_INCREMENT_MM: f64 = 0.5e-4;
}

impl Default for ExactStopConfig {
    fn default() -> Self {
        Self { window_mm: 0.05, settling_s: Some(1.0), reached_mm: Self::HALF_INCREMENT_MM }
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum State {
    /// No stop expected, or the last one is complete.
    Idle,
    /// The set position is on its way to the target.
    Approaching { target_mm: f64 },
    /// The set position is at the target.
    Settling { target_mm: f64 },
}

/// Timer of the exact stop.
#[derive(Clone, Debug)]
pub struct ExactStopMonitor {
    config: ExactStopConfig,
    cycle: CycleTime,
    state: State,
    rest_mm: f64,
    last_mm: f64,
    moved: bool,
    /// Cycles from t1 until now or until t2.
    cycles: u64,
}

impl ExactStopMonitor {
    /// A set position that changes by less than this, in mm, counts as unmoved.
    const MOVED_MM: f64 = ExactStopConfig::HALF_INCREMENT_MM;

    /// A monitor at rest.
    pub fn new(config: ExactStopConfig, cycle: CycleTime) -> Self {
        Self {
            config,
            cycle,
            state: State::Idle,
            rest_mm: 0.0,
            last_mm: 0.0,
            moved: false,
            cycles: 0,
        }
    }

    /// Window and time in use.
    pub const fn config(&self) -> &ExactStopConfig {
        &self.config
    }

    /// Time in s since t1 while the axis settles, then t2 - t1 of the last stop; 0 before the first one.
    pub fn settling_s(&self) -> f64 {
        // called in every cycle, mostly before the first stop
        if self.cycles == 0 { 0.0 } else { self.cycle.time_of(self.cycles) }
    }

    /// Whether no stop is awaited.
    pub const fn rests(&self) -> bool {
        matches!(self.state, State::Idle)
    }

    /// Whether the set position is at the target of a stop and the actual position not yet inside the window.
    pub const fn settles(&self) -> bool {
        matches!(self.state, State::Settling { .. })
    }

    /// Axis at rest at a position.
    pub fn start(&mut self, position_mm: f64) {
        (self.rest_mm, self.last_mm) = (position_mm, position_mm);
        (self.state, self.moved, self.cycles) = (State::Idle, false, 0);
    }

    /// Takes over the stop that another monitor awaits; window and time stay those of this one.
    pub(crate) fn take_over(&mut self, before: &Self) {
        let (config, cycle) = (self.config, self.cycle);
        *self = Self { config, cycle, ..before.clone() };
    }

    /// Shifts the coordinate of the present position by `by_mm`.
    pub(crate) fn shift(&mut self, by_mm: f64) {
        self.rest_mm += by_mm;
        self.last_mm += by_mm;
        if let State::Approaching { target_mm } | State::Settling { target_mm } = &mut self.state {
            *target_mm += by_mm;
        }
    }

    /// Announces a stop of the path, for this axis at `target_mm`; to be called no later than right after the cycle in
    /// which the set position got there. An axis that has not moved since its last stop and need not move has no new
    /// stop. One that still settles at this target keeps its time, since a dwell after an exact stop is not another
    /// stop.
    pub fn expect(&mut self, target_mm: f64) {
        if (target_mm - self.last_mm).abs() > self.config.reached_mm {
            self.state = State::Approaching { target_mm };
        } else if self.moved && !self.settles() {
            self.begin(target_mm);
        }
    }

    /// Processes many cycles while no stop is awaited, see [`Self::rests`].
    pub(crate) fn pass(&mut self, set_mm: &[f64]) {
        let Some(last_mm) = set_mm.last() else { return };
        self.last_mm = *last_mm;
        let away = |set_mm: &f64| (set_mm - self.rest_mm).abs() > Self::MOVED_MM;
        self.moved = self.moved || set_mm.iter().any(away);
    }

    /// One cycle: set position after the filters, actual position at the start of the cycle.
    #[inline]
    pub fn step(&mut self, set_mm: f64, actual_mm: f64) -> Option<Fault> {
        self.last_mm = set_mm;
        self.moved |= (set_mm - self.rest_mm).abs() > Self::MOVED_MM;
        let reached_mm = self.config.reached_mm;
        let at = |target_mm: f64| (set_mm - target_mm).abs() <= reached_mm;
        match self.state {
            State::Idle => None,
            State::Approaching { target_mm } => {
                if at(target_mm) {
                    self.begin(target_mm);
                }
                None
            }
            State::Settling { target_mm } if !at(target_mm) => {
                self.state = State::Approaching { target_mm };
                None
            }
            State::Settling { target_mm } => self.settle(target_mm, actual_mm),
        }
    }

    /// Starts the timer (t1).
    fn begin(&mut self, target_mm: f64) {
        (self.state, self.cycles) = (State::Settling { target_mm }, 0);
    }

    fn settle(&mut self, target_mm: f64, actual_mm: f64) -> Option<Fault> {
        self.cycles += 1;
        let lag_mm = target_mm - actual_mm;
        let window_mm = self.config.window_mm;
        let late = self.config.settling_s.filter(|t| self.settling_s() >= *t - 1e-9);
        if lag_mm.abs() <= window_mm {
            self.finish(target_mm);
            None
        } else if let Some(time_s) = late {
            self.finish(target_mm);
            Some(Fault::SettlingTimeout { lag_mm, window_mm, time_s })
        } else {
            None
        }
    }

    fn finish(&mut self, target_mm: f64) {
        self.state = State::Idle;
        self.rest_mm = target_mm;
        self.moved = false;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn monitor(settling_s: Option<f64>) -> ExactStopMonitor {
        let config = ExactStopConfig { settling_s, ..ExactStopConfig::default() };
        let mut m = ExactStopMonitor::new(config, CycleTime::DEFAULT);
        m.start(0.0);
        m
    }

    /// Moves the set position to 1 mm and gives the cycle (after t1) in which a fault appears.
    fn fault_after(
        m: &mut ExactStopMonitor,
        actual_mm: impl Fn(u32) -> f64,
    ) -> Option<(u32, Fault)> {
        (1..10).for_each(|k| assert_eq!(m.step(0.1 * f64::from(k), 0.0), None));
        m.expect(1.0);
        (0..2000).find_map(|k| m.step(1.0, actual_mm(k)).map(|f| (k, f)))
    }

    /// Conformance: P005.
    #[test]
    fn raises_in_the_cycle_the_time_is_over() {
        let (k, fault) = fault_after(&mut monitor(Some(0.2)), |_| 0.94).unwrap();
        assert_eq!(k, 200, "first cycle with (k - k1) T >= t3");
        let Fault::SettlingTimeout { lag_mm, window_mm, time_s } = fault else { panic!() };
        assert!((lag_mm - 0.06).abs() < 1e-12);
        assert_eq!((window_mm, time_s), (0.05, 0.2));
    }

    /// Conformance: P006, P019.
    #[test]
    fn inside_in_time_ends_the_monitoring_of_this_stop() {
        let inside_then_out = |k| if (150..160).contains(&k) { 0.96 } else { 0.5 };
        assert_eq!(fault_after(&mut monitor(Some(0.2)), inside_then_out), None);
        assert_eq!(fault_after(&mut monitor(None), |_| 0.0), None, "0 switches the monitor off");
        assert!(fault_after(&mut monitor(Some(0.149)), inside_then_out).is_some());
    }

    /// Announced before the last step or right after it: the same cycle.
    #[test]
    fn a_stop_reported_after_the_last_step() {
        let mut m = monitor(Some(0.2));
        (1..=10).for_each(|k| assert_eq!(m.step(0.1 * f64::from(k), 0.0), None));
        m.expect(1.0);
        assert_eq!((1..2000).find(|_| m.step(1.0, 0.94).is_some()), Some(200));
    }

    /// A stop expected again while the axis settles, as by a dwell or a block without motion, keeps its t1.
    #[test]
    fn a_stop_reported_again_keeps_its_time() {
        let mut m = monitor(Some(0.2));
        (1..10).for_each(|k| assert_eq!(m.step(0.1 * f64::from(k), 0.0), None));
        m.expect(1.0);
        // at the target in cycle 0, inside the window in cycle 43
        (0..=43).for_each(|k| {
            assert_eq!(m.step(1.0, if k < 43 { 0.9 } else { 0.96 }), None);
            m.expect(1.0);
        });
        assert!(m.rests() && (m.settling_s() - 0.043).abs() < 1e-12, "{}", m.settling_s());
    }

    #[test]
    fn an_axis_that_stands_has_no_stop() {
        let mut m = monitor(Some(0.01));
        m.expect(0.0);
        assert!((0..100).all(|_| m.step(0.0, 1.0).is_none()));
        // no fault after its own stop while others move
        assert!(fault_after(&mut m, |_| 1.0).is_none());
        m.expect(1.0);
        assert!((0..100).all(|_| m.step(1.0, 5.0).is_none()));
    }

    /// Conformance: P017.
    #[test]
    fn without_a_stop_of_the_path_no_timer() {
        let mut m = monitor(Some(0.001));
        assert!((0..100_u32).all(|k| m.step(f64::from(k), 0.0).is_none()));
        // passing through an expected target does not count
        m.expect(100.0);
        assert!((100..200_u32).all(|k| m.step(f64::from(k), 0.0).is_none()));
    }
}
