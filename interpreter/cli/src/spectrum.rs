//! Amplitudes of the vibrations in a recorded signal.

use realfft::RealFftPlanner;

/// Longest recording in samples: four minutes at 1 ms, and 60 MB during the transformation.
pub(crate) const MOST_SAMPLES: usize = 1 << 18;
/// Lines per resolution of the recording, so that a peak between two lines keeps its height.
const PADDING: usize = 8;

/// Single-sided amplitude spectrum under a Hann window: a sine of amplitude 1 over the whole recording has the height
/// 1; the mean of the windowed recording is removed first.
#[derive(Clone, Debug)]
pub(crate) struct AmplitudeSpectrum {
    step_hz: f64,
    amplitudes: Vec<f64>,
}

impl AmplitudeSpectrum {
    /// The spectrum of samples taken every `cycle_s` seconds.
    pub(crate) fn of(samples: &[f64], cycle_s: f64) -> Self {
        let n = samples.len().max(1);
        let window =
            |i: usize| 0.5 - 0.5 * libm::cos(std::f64::consts::TAU * (i as f64 + 0.5) / n as f64);
        // weighted by the window, so that incomplete waves leave no offset
        let mean =
            samples.iter().enumerate().map(|(i, x)| x * window(i)).sum::<f64>() / (0.5 * n as f64);
        let length = (PADDING * n).next_power_of_two();
        let mut padded: Vec<f64> =
            samples.iter().enumerate().map(|(i, x)| (x - mean) * window(i)).collect();
        padded.resize(length, 0.0);
        let transform = RealFftPlanner::new().plan_fft_forward(length);
        let mut values = transform.make_output_vec();
        // both buffers have the lengths required by the plan
        let done = transform.process(&mut padded, &mut values);
        debug_assert!(done.is_ok());
        let scale = 2.0 / (0.5 * n as f64);
        let amplitudes = values.iter().map(|v| scale * libm::hypot(v.re, v.im)).collect();
        Self { step_hz: 1.0 / (cycle_s * length as f64), amplitudes }
    }

    /// Frequency in Hz and amplitude of every line between two frequencies, at least of one next to them.
    pub(crate) fn lines(&self, (low_hz, high_hz): (f64, f64)) -> impl Iterator<Item = [f64; 2]> {
        let line = |(i, a): (usize, &f64)| [i as f64 * self.step_hz, *a];
        let all = self.amplitudes.iter().enumerate().map(line);
        let half = 0.5 * self.step_hz;
        all.skip_while(move |l| l[0] < low_hz - half).take_while(move |l| l[0] <= high_hz + half)
    }

    /// The highest line between two frequencies: frequency in Hz and amplitude.
    pub(crate) fn peak(&self, band_hz: (f64, f64)) -> Option<[f64; 2]> {
        self.lines(band_hz).max_by(|a, b| a[1].total_cmp(&b[1]))
    }
}

/// The samples without their drift: the slope of the straight line through them, weighted by a Hann window so that
/// incomplete waves have little influence on it.
pub(crate) fn without_drift(samples: &[f64]) -> Vec<f64> {
    let n = samples.len() as f64;
    let place = |i: usize| (i as f64 + 0.5) / n - 0.5;
    let (mut moment, mut spread) = (0.0, 0.0);
    for (i, x) in samples.iter().enumerate() {
        let weighted = place(i) * (1.0 + libm::cos(std::f64::consts::TAU * place(i)));
        moment += weighted * x;
        spread += weighted * place(i);
    }
    // a single sample has no slope
    let slope = if spread > 0.0 { moment / spread } else { 0.0 };
    samples.iter().enumerate().map(|(i, x)| x - slope * place(i)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sines_keep_their_amplitudes() {
        let wave =
            |f_hz: f64, k: u32| libm::sin(std::f64::consts::TAU * f_hz * 1e-3 * f64::from(k));
        let samples: Vec<f64> =
            (0..1178).map(|k| 4.0 + 0.81 * wave(53.1, k) + 0.02 * wave(11.0, k)).collect();
        let spectrum = AmplitudeSpectrum::of(&samples, 1e-3);
        let [f, a] = spectrum.peak((50.0, 56.0)).unwrap();
        assert!((f - 53.1).abs() < 0.1 && (a - 0.81).abs() < 1e-3, "{f} {a}");
        let [f, a] = spectrum.peak((9.5, 12.5)).unwrap();
        assert!((f - 11.0).abs() < 0.1 && (a - 0.02).abs() < 1e-3, "{f} {a}");
        // the mean is not a vibration, and an empty spectrum has no peaks
        assert!(spectrum.peak((0.0, 5.0)).unwrap()[1] < 1e-3);
        assert!(spectrum.peak((200.0, 300.0)).unwrap()[1] < 1e-4);
        assert_eq!(spectrum.peak((600.0, 700.0)), None);
        // a band between two lines
        let [_, a] = spectrum.peak((53.1, 53.101)).unwrap();
        assert!((a - 0.81).abs() < 5e-3, "{a}");
    }

    #[test]
    fn drift_is_no_vibration() {
        let sample = |k: u32| {
            let t = 1e-3 * f64::from(k);
            0.01 * libm::sin(std::f64::consts::TAU * 17.3 * t) + 3.0 + 7.0 * t
        };
        let spectrum =
            AmplitudeSpectrum::of(&without_drift(&(0..800).map(sample).collect::<Vec<_>>()), 1e-3);
        let [f, a] = spectrum.peak((2.0, 100.0)).unwrap();
        assert!((f - 17.3).abs() < 0.1 && (a - 0.01).abs() < 1e-4, "{f} {a}");
        assert!(spectrum.peak((0.0, 12.0)).unwrap()[1] < 2e-4);
    }
}
