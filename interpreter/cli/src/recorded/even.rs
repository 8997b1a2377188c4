//! Signals at equal steps: sampling times from printed ones, and missing samples.

use super::channel::Channel;
use crate::table::number;
use serde::Serialize;
use std::ops::Range;

/// Largest number of samples of one signal including filled-in ones: more than an hour at 4 kHz.
const MOST_SAMPLES: f64 = 16_777_216.0;
/// Steps up to this many sampling times count as single ones, to allow for rounding of the times.
const SINGLE: f64 = 1.5;
/// If more than one in this many steps is a gap, the times are rounded too coarsely to determine which samples are
/// missing.
const MOST_GAPS: usize = 3;
/// Permitted deviation of samples from equal steps, as a share of the sampling time: times are printed with a few
/// decimals.
pub(super) const JITTER_RATIO: f64 = 0.25;
/// A gap without samples. In JSON: the seconds after which it begins, and the number of missing samples.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(into = "(f64, usize)")]
pub(crate) struct DropOut {
    /// Time of the last sample before it in s, from the first time of the file.
    pub(crate) after_s: f64,
    /// Indices of the missing samples in the signal with equal steps.
    pub(crate) samples: Range<usize>,
}

impl From<DropOut> for (f64, usize) {
    fn from(d: DropOut) -> Self {
        (d.after_s, d.samples.len())
    }
}

/// Permitted difference between a given rate and that of the times, as a share.
const RATE_RATIO: f64 = 0.01;

/// A signal at equal steps.
#[derive(Clone, Debug)]
pub(crate) struct Even {
    /// The values, with missing ones interpolated linearly between their neighbours.
    pub(crate) values: Vec<f64>,
    /// Time of the first sample in s, from the first time of the file.
    pub(crate) begin_s: f64,
    /// Sampling time in s.
    pub(crate) step_s: f64,
    /// Gaps without samples.
    pub(crate) drop_outs: Vec<DropOut>,
}

impl Channel {
    /// The values at equal steps, according to the times of the file or the given rate.
    ///
    /// # Errors
    /// The reason: neither times nor a rate, a rate that differs from that of the times, times that do not increase in
    /// equal steps (beyond rounding), or gaps with more than [`MOST_SAMPLES`].
    pub(crate) fn even(&self, rate_hz: Option<f64>) -> Result<Even, String> {
        if self.times_s.is_empty() {
            let rate_hz = rate_hz
                .ok_or("no column t_s, time or t; give the samples per second with --rate")?;
            let (values, drop_outs) = (self.values.clone(), Vec::new());
            return Ok(Even { values, begin_s: 0.0, step_s: 1.0 / rate_hz, drop_outs });
        }
        let even = self.by_times()?;
        match rate_hz.filter(|given| (given * even.step_s - 1.0).abs() > RATE_RATIO) {
            Some(given) => Err(format!(
                "--rate {given} Hz contradicts its time column ({} Hz); remove one of the two",
                number(1.0 / even.step_s, 3)
            )),
            None => Ok(even),
        }
    }

    /// From the straight line through the times, which is more accurate than a printed step.
    fn by_times(&self) -> Result<Even, String> {
        let unequal = || "its times do not increase in equal steps".to_owned();
        let steps: Vec<f64> = self.times_s.windows(2).map(|w| w[1] - w[0]).collect();
        let rough = median(&steps).filter(|s| *s > 0.0).ok_or_else(unequal)?;
        let singles = || steps.iter().filter(|s| **s <= SINGLE * rough * (1.0 + 1e-9));
        let mean = singles().sum::<f64>() / singles().count() as f64;
        let (mut numbers, mut number, mut gaps) = (vec![0.0], 0.0, 0);
        for step in &steps {
            let count = (step / mean).round();
            if count < 1.0 || (step / mean - count).abs() > JITTER_RATIO {
                return Err(unequal());
            }
            gaps += usize::from(count > 1.0);
            number += count;
            if number >= MOST_SAMPLES {
                return Err("its times contain gaps of hours".to_owned());
            }
            numbers.push(number);
        }
        // 0, 1, 3, 4, 6 ms are steps of 1.5 ms without decimals rather than drop-outs
        if MOST_GAPS * gaps > steps.len() {
            return Err(unequal());
        }
        let (begin_s, step_s) = line(&numbers, &self.times_s);
        let beside = |(k, t): (&f64, &f64)| (t - begin_s - k * step_s).abs();
        if numbers.iter().zip(&self.times_s).any(|both| beside(both) > JITTER_RATIO * step_s) {
            return Err(unequal());
        }
        let (mut values, mut drop_outs) = (Vec::new(), Vec::new());
        for (i, value) in self.values.iter().enumerate() {
            if let Some(before) = values.last().copied() {
                let count = (numbers[i] - numbers[i - 1]) as usize;
                if count > 1 {
                    let samples = values.len()..values.len() + count - 1;
                    drop_outs.push(DropOut { after_s: self.times_s[i - 1], samples });
                }
                for k in 1..count {
                    values.push(before + (value - before) * k as f64 / count as f64);
                }
            }
            values.push(*value);
        }
        Ok(Even { values, begin_s, step_s, drop_outs })
    }
}

/// The median of the values, the upper one of two.
pub(super) fn median(values: &[f64]) -> Option<f64> {
    let mut values = values.to_vec();
    let middle = values.len() / 2;
    (!values.is_empty()).then(|| *values.select_nth_unstable_by(middle, f64::total_cmp).1)
}

/// Intercept and slope of the least-squares line through `y` over `x`.
fn line(x: &[f64], y: &[f64]) -> (f64, f64) {
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    let (x0, y0) = (mean(x), mean(y));
    let squares: f64 = x.iter().map(|x| (x - x0) * (x - x0)).sum();
    let products: f64 = x.iter().zip(y).map(|(x, y)| (x - x0) * (y - y0)).sum();
    let slope = products / squares;
    (y0 - slope * x0, slope)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::recorded::parse;

    #[test]
    fn drop_outs_are_named_and_bridged() {
        let channel = &parse("t_s,a\n0,0\n0.001,1\n0.004,4\n0.005,5\n").unwrap()[0];
        let even = channel.even(None).unwrap();
        assert!((even.step_s - 0.001).abs() < 1e-12);
        assert_eq!(even.drop_outs, [DropOut { after_s: 0.001, samples: 2..4 }]);
        for (i, x) in even.values.iter().enumerate() {
            assert!((x - i as f64).abs() < 1e-9);
        }
    }

    /// Gaps are filled up to a bound: a short file must not require memory for days of samples.
    #[test]
    fn gaps_of_hours_are_not_filled() {
        let even = |hours: u32| {
            let row = |h: u32| format!("{0},1\n{0}.001,1\n{0}.002,1\n", 3600 * h);
            let rows: Vec<String> = (0..hours).map(row).collect();
            parse(&format!("t_s,a\n{}", rows.concat())).unwrap()[0].even(None)
        };
        assert!(even(4).is_ok());
        assert!(even(30).is_err());
    }

    /// Times of equal steps printed with few decimals give the step to a fraction of its rounding; if the rounding
    /// exceeds a quarter of a step, they are refused.
    #[test]
    fn rounded_times() {
        for (step, decimals) in [(1.0 / 3000.0, 4), (0.0025, 3), (1.0 / 7.0, 2), (0.001, 3)] {
            let row = |i: u32| format!("{:.decimals$},{i}\n", f64::from(i) * step);
            for missing in [0..0, 40..47] {
                let rows: String = (0..200).filter(|i| !missing.contains(i)).map(row).collect();
                let even = parse(&format!("t_s,a\n{rows}")).unwrap()[0].even(None).unwrap();
                let rounding = 0.5 * libm::pow(10.0, -(decimals as f64));
                assert!((even.step_s - step).abs() < rounding / 100.0, "{step}: {}", even.step_s);
                assert!(even.begin_s.abs() < rounding);
                assert_eq!(even.drop_outs.len(), usize::from(!missing.is_empty()));
                assert_eq!(even.values.len(), 200);
                assert!(even.values.iter().enumerate().all(|(i, x)| (x - i as f64).abs() < 1e-9));
            }
        }
        let coarse: Vec<String> =
            (0..200).map(|i| format!("{:.3},{i}\n", f64::from(i) * 0.0015)).collect();
        let coarse = coarse.concat();
        assert!(parse(&format!("t_s,a\n{coarse}")).unwrap()[0].even(None).is_err());
    }
}
