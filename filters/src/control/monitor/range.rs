//! Monitoring of the actual positions: they must lie within the software limits, widened by a tolerance for slight
//! overshoot.
//!
//! Source: TF5200 axis parameters, P-AXIS-00177 to 00179; software limit switches (IDs 70021 and 70022).

use crate::control::fault::Fault;

/// Excess in mm that is attributed to rounding: an axis approaches its target from either side to the last digits. Limits
/// are written in steps a hundred times as large.
const ROUNDING_MM: f64 = 1e-6;

/// Range monitor with its state.
#[derive(Clone, Debug)]
pub struct RangeMonitor {
    range_mm: Option<(f64, f64)>,
    beyond: bool,
}

impl RangeMonitor {
    /// A monitor with the permitted range in mm, tolerance included; `None` switches it off.
    pub const fn new(range_mm: Option<(f64, f64)>) -> Self {
        Self { range_mm, beyond: false }
    }

    /// Starts at an actual position.
    ///
    /// Assumption: outside the range an axis is monitored from its first position inside on. The documents only say
    /// that the path preparation reports a start outside; a limit that the program narrows in motion would otherwise
    /// be passed by the lag of the axis.
    pub fn start(&mut self, position_mm: f64) {
        self.beyond = self.limit_passed(position_mm).is_some();
    }

    /// The actual positions in mm, from the first to the last one, that raise nothing; `None` while the axis is beyond them.
    pub(crate) fn inside_mm(&self) -> Option<(f64, f64)> {
        let (low, high) = self.range_mm.unwrap_or((f64::NEG_INFINITY, f64::INFINITY));
        (!self.beyond).then_some((low - ROUNDING_MM, high + ROUNDING_MM))
    }

    fn limit_passed(&self, actual_mm: f64) -> Option<f64> {
        let (low, high) = self.range_mm?;
        match actual_mm {
            x if x > high + ROUNDING_MM => Some(high),
            x if x < low - ROUNDING_MM => Some(low),
            _ => None,
        }
    }

    /// One cycle: a fault when the actual position leaves the range.
    #[inline]
    pub fn step(&mut self, actual_mm: f64) -> Option<Fault> {
        let passed = self.limit_passed(actual_mm);
        let before = std::mem::replace(&mut self.beyond, passed.is_some());
        passed.filter(|_| !before).map(|limit_mm| Fault::BeyondLimit { actual_mm, limit_mm })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_way_out_of_the_range_is_reported_once() {
        let mut monitor = RangeMonitor::new(Some((-10.0, 20.0)));
        monitor.start(0.0);
        let positions = [0.0, 20.0 + 1e-9, 20.1, 21.0, 19.0, 20.2, -10.0, -10.5, -11.0];
        let faults: Vec<_> = positions.iter().map(|x| monitor.step(*x)).collect();
        let fault = |actual_mm, limit_mm| Some(Fault::BeyondLimit { actual_mm, limit_mm });
        let out = [(2, 20.1, 20.0), (5, 20.2, 20.0), (7, -10.5, -10.0)];
        let mut expected = vec![None; positions.len()];
        for (i, actual, limit) in out {
            expected[i] = fault(actual, limit);
        }
        assert_eq!(faults, expected);
    }

    #[test]
    fn an_axis_that_starts_outside_comes_in_without_a_fault() {
        let mut monitor = RangeMonitor::new(Some((1.0, 2.0)));
        monitor.start(0.0);
        assert_eq!([0.0, 0.5, 1.5].map(|x| monitor.step(x)), [None; 3]);
        assert!(monitor.step(0.9).is_some());
    }

    #[test]
    fn without_a_range_nothing_is_monitored() {
        let mut monitor = RangeMonitor::new(None);
        monitor.start(0.0);
        assert_eq!([1e9, -1e9].map(|x| monitor.step(x)), [None; 2]);
    }
}
