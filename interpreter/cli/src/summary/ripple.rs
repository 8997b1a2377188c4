//! Ripple of the path speed: how far the speed dips while the path is under way.

use kontur_interpreter::record::CycleRecord;
use serde::Serialize;

/// Speeds closer together than this share of the larger one are equal: below it lies the rounding of the profiles.
const SAME: f64 = 1e-9;

/// The deepest dip of the path speed on the way from one rest to the next.
///
/// Counted from the first to the last local maximum of the speed, so neither the start nor the stop is a dip.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SpeedRipple {
    /// `(v_max - v_min) / v_max`, 0 to 1.
    pub ratio: f64,
    /// Highest path velocity on that way in mm/s.
    pub v_max_mm_s: f64,
    /// Lowest path velocity between two local maxima in mm/s.
    pub v_min_mm_s: f64,
    /// Program time of the dip in seconds.
    pub time_s: f64,
    /// Line of the file at the dip.
    pub line: u32,
}

/// A speed with its cycle and line.
#[derive(Clone, Copy, Debug, Default)]
struct Sample {
    v: f64,
    k: u64,
    line: u32,
}

/// Collects the ripple, record by record.
#[derive(Clone, Debug, Default)]
pub(super) struct Collector {
    last: Sample,
    /// Highest speed since the last rest.
    peak: f64,
    /// The speed has fallen since the last rest.
    fallen: bool,
    /// Lowest speed between two local maxima since the last rest.
    dip: Option<Sample>,
    /// The deepest so far, with the highest speed of its way.
    worst: Option<(Sample, f64)>,
}

fn depth(dip: f64, peak: f64) -> f64 {
    (peak - dip) / peak
}

impl Collector {
    pub(super) fn add(&mut self, record: &CycleRecord) {
        let now = Sample { v: record.path.v_mm_s, k: record.k, line: record.line };
        if now.v <= 0.0 {
            self.rest();
        } else {
            let slack = SAME * now.v.max(self.last.v);
            if now.v < self.last.v - slack {
                self.fallen = true;
            } else if now.v > self.last.v + slack
                && self.fallen
                && self.dip.is_none_or(|d| self.last.v < d.v)
            {
                self.dip = Some(self.last);
            }
            self.peak = self.peak.max(now.v);
        }
        self.last = now;
    }

    fn rest(&mut self) {
        if let Some(dip) = self.dip.take()
            && self.worst.is_none_or(|(w, peak)| depth(dip.v, self.peak) > depth(w.v, peak))
        {
            self.worst = Some((dip, self.peak));
        }
        (self.peak, self.fallen) = (0.0, false);
    }

    /// The ripple; `None` if the speed never dipped.
    pub(super) fn finish(mut self, cycle_us: u32) -> Option<SpeedRipple> {
        self.rest();
        self.worst.map(|(dip, v_max_mm_s)| SpeedRipple {
            ratio: depth(dip.v, v_max_mm_s),
            v_max_mm_s,
            v_min_mm_s: dip.v,
            time_s: dip.k as f64 * f64::from(cycle_us) / 1e6,
            line: dip.line,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use kontur_interpreter::record::PathRecord;

    fn of(speeds: &[f64]) -> Option<SpeedRipple> {
        let mut collector = Collector::default();
        for (k, v) in speeds.iter().enumerate() {
            let path = PathRecord { v_mm_s: *v, ..PathRecord::default() };
            let record =
                CycleRecord { k: k as u64, line: k as u32, path, ..CycleRecord::default() };
            collector.add(&record);
        }
        collector.finish(1000)
    }

    #[test]
    fn start_and_stop_are_no_ripple() {
        assert_eq!(of(&[0.0, 0.0]), None);
        assert_eq!(of(&[0.0, 5.0, 10.0, 10.0, 5.0, 0.0, 0.0, 4.0, 2.0]), None);
    }

    #[test]
    fn the_deepest_dip_between_two_maxima() {
        let speeds = [0.0, 5.0, 10.0, 9.0, 10.0, 4.0, 0.0, 8.0, 6.0, 3.0, 6.0, 5.0, 7.0, 0.0];
        let ripple = of(&speeds);
        let want =
            SpeedRipple { ratio: 0.625, v_max_mm_s: 8.0, v_min_mm_s: 3.0, time_s: 0.009, line: 9 };
        assert_eq!(ripple, Some(want));
        // still under way at the end
        assert_eq!(of(&[0.0, 8.0, 6.0, 8.0]).map(|r| r.ratio), Some(0.25));
    }
}
