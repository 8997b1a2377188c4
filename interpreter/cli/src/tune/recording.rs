//! Natural frequencies and damping from the recording of a decaying vibration.
//!
//! The spectrum names the frequencies. Around each of them the record is band-limited without a shift in time, and the
//! logarithmic decrement of its decay gives a first damping (P-AXIS-00568); a fit of all vibrations to the record itself
//! improves it.

use super::args::TuneArgs;
use super::fit;
use crate::Error;
use crate::console::Console;
use crate::table::{Table, number};
use crate::text::Text;
use kontur_filters::analysis::decay::Decay;
use realfft::RealFftPlanner;
use realfft::num_complex::Complex;
use std::fs::File;
use std::path::Path;

/// Shorter recordings hold no decay.
const LEAST_SAMPLES: usize = 64;
/// Longer ones are refused: two minutes at 4 kHz. Their spectra take 130 MB.
const MOST_SAMPLES: usize = 1 << 19;
/// Peaks lower than this share of the highest one are noise.
const LEAST_PEAK_RATIO: f64 = 0.15;
/// Peaks shown.
const MOST_PEAKS: usize = 5;
/// Two peaks are two only if the spectrum between them falls below this share of the lower one.
const VALLEY_RATIO: f64 = 0.5;
/// Sampling intervals may differ from their mean by this share.
const JITTER_RATIO: f64 = 0.01;

/// One natural frequency of a recording.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mode {
    /// Undamped natural frequency in Hz; the peak of the spectrum if no decay was found.
    pub freq_hz: f64,
    /// Damping ratio, if the record decays.
    pub damping: Option<f64>,
    /// Height of its peak, 1 for the highest one.
    pub peak_ratio: f64,
}

/// What recordings tell.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Measured {
    /// The strongest natural frequency of each recording in Hz.
    pub(super) freqs_hz: Vec<f64>,
    /// Mean of their dampings.
    pub(super) damping: Option<f64>,
    /// The weaker vibrations of all recordings.
    pub(super) others: Vec<Mode>,
}

/// The natural frequencies of the recordings.
///
/// # Errors
/// [`Error`] if a file cannot be read, has no such column, or holds no vibration.
pub(super) fn measured(args: &TuneArgs, console: &mut Console) -> Result<Measured, Error> {
    let mut table = Table::new(&["recording", "peak", "frequency", "damping", ""]);
    let (mut found, mut dampings) = (Measured::default(), Vec::new());
    for path in &args.recording {
        let (samples, rate_hz) = read(path, args.column.as_deref(), args.rate)?;
        let modes = modes(&samples, rate_hz);
        let Some(strongest) = modes.first() else {
            let text = format!("{}: no vibration stands out of its spectrum", path.display());
            return Err(Error::Usage(text));
        };
        found.freqs_hz.push(strongest.freq_hz);
        found.others.extend(&modes[1..]);
        dampings.extend(strongest.damping);
        for (i, mode) in modes.iter().enumerate() {
            table.push(vec![
                path.display().to_string(),
                format!("{} %", number(100.0 * mode.peak_ratio, 0)),
                format!("{} Hz", number(mode.freq_hz, 3)),
                mode.damping.map_or_else(|| "no decay".to_owned(), |z| number(z, 4)),
                if i == 0 { "used" } else { "other" }.to_owned(),
            ]);
        }
    }
    console.print(&format!("{}\n", table.text()))?;
    let mean = dampings.iter().sum::<f64>() / dampings.len() as f64;
    found.damping = (!dampings.is_empty()).then_some(mean);
    Ok(found)
}

/// Samples and sampling rate of a CSV file.
fn read(path: &Path, column: Option<&str>, rate_hz: Option<f64>) -> Result<(Vec<f64>, f64), Error> {
    let name = path.display().to_string();
    let wrong = |text: String| Error::Usage(format!("{name}: {text}"));
    let io = |e: csv::Error| match e.into_kind() {
        csv::ErrorKind::Io(e) => Error::io(name.clone(), e),
        csv::ErrorKind::UnequalLengths { pos, expected_len, len } => {
            let line = pos.map_or_else(String::new, |pos| format!("line {}: ", pos.line()));
            wrong(format!("{line}{len} columns, the header has {expected_len}"))
        }
        csv::ErrorKind::Utf8 { pos, .. } => {
            let line = pos.map_or_else(String::new, |pos| format!("line {}: ", pos.line()));
            wrong(format!("{line}the text is not UTF-8"))
        }
        _ => wrong("no CSV table".to_owned()),
    };
    let file = File::open(path).and_then(Text::new).map_err(|e| Error::io(name.clone(), e))?;
    let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(file);
    let header: Vec<String> = reader.headers().map_err(io)?.iter().map(str::to_owned).collect();
    if let [one] = &header[..]
        && one.contains(';')
    {
        let text = "its columns are separated by `;`; commas and decimal points are expected";
        return Err(wrong(text.to_owned()));
    }
    let place = |wanted: &str| header.iter().position(|name| name.eq_ignore_ascii_case(wanted));
    let known = || format!("its columns are {}", header.join(", "));
    let value = match column {
        Some(wanted) => {
            place(wanted).ok_or_else(|| wrong(format!("no column `{wanted}`; {}", known())))?
        }
        None => header.len().checked_sub(1).ok_or_else(|| wrong("no columns".to_owned()))?,
    };
    let time = ["t_s", "time", "t"].iter().find_map(|name| place(name));
    let (mut samples, mut times) = (Vec::new(), Vec::new());
    for (row, record) in reader.records().enumerate() {
        let record = record.map_err(io)?;
        let number = |column: usize| {
            let cell = record.get(column).unwrap_or_default();
            cell.parse::<f64>().ok().filter(|v| v.is_finite()).ok_or_else(|| {
                wrong(format!("row {}, column {}: `{cell}` is no number", row + 2, header[column]))
            })
        };
        samples.push(number(value)?);
        if let (Some(time), None) = (time, rate_hz) {
            times.push(number(time)?);
        }
        if samples.len() > MOST_SAMPLES {
            return Err(wrong(format!("more than {MOST_SAMPLES} samples; cut out the decay")));
        }
    }
    if samples.len() < LEAST_SAMPLES {
        return Err(wrong(format!("{} samples, {LEAST_SAMPLES} at least", samples.len())));
    }
    let rate_hz = match rate_hz {
        Some(rate_hz) => rate_hz,
        None if times.is_empty() => {
            let text = format!(
                "no column t_s, time or t; --rate names the samples per second; {}",
                known()
            );
            return Err(wrong(text));
        }
        None => uniform_rate(&times).ok_or_else(|| {
            wrong(
                "its times do not rise in equal steps; --rate names the samples per second"
                    .to_owned(),
            )
        })?,
    };
    Ok((samples, rate_hz))
}

/// The rate of times in s in equal steps.
fn uniform_rate(times: &[f64]) -> Option<f64> {
    let step = (times.last()? - times.first()?) / (times.len() - 1) as f64;
    let equal = |pair: &[f64]| (pair[1] - pair[0] - step).abs() <= JITTER_RATIO * step;
    (step > 0.0 && times.windows(2).all(equal)).then(|| 1.0 / step)
}

/// The natural frequencies of a record, strongest first.
pub fn modes(samples: &[f64], rate_hz: f64) -> Vec<Mode> {
    let mean = samples.iter().sum::<f64>() / samples.len().max(1) as f64;
    let centred: Vec<f64> = samples.iter().map(|x| x - mean).collect();
    let spectrum = ComplexSpectrum::of(&centred, rate_hz);
    let peaks = spectrum.peaks(samples.len());
    let highest = peaks.first().map_or(1.0, |p| p.height);
    let mut modes: Vec<Mode> = Vec::new();
    for peak in &peaks {
        // the band reaches half way to the neighbours
        let others = || peaks.iter().map(|p| p.freq_hz);
        let below = others().filter(|f| *f < peak.freq_hz).fold(peak.freq_hz / 9.0, f64::max);
        let above = others().filter(|f| *f > peak.freq_hz).fold(peak.freq_hz * 9.0, f64::min);
        let band = [below, above].map(|f| (f * peak.freq_hz).sqrt());
        let decay = Decay::of(&spectrum.band(band, samples.len()), rate_hz);
        modes.push(Mode {
            freq_hz: decay.map_or(peak.freq_hz, |decay| decay.freq_hz),
            damping: decay.map(|decay| decay.damping),
            peak_ratio: peak.height / highest,
        });
    }
    let start: Vec<fit::Vibration> =
        modes.iter().filter_map(|m| Some((m.freq_hz, m.damping?))).collect();
    let decaying = modes.iter_mut().filter(|m| m.damping.is_some());
    for (mode, found) in decaying.zip(fit::refine(&centred, rate_hz, &start)) {
        if let Some((freq_hz, damping)) = found {
            (mode.freq_hz, mode.damping) = (freq_hz, Some(damping));
        }
    }
    modes
}

/// Spectrum of a record with its phases, with zeros behind it so that filtering does not wrap around.
struct ComplexSpectrum {
    values: Vec<Complex<f64>>,
    /// Samples transformed.
    length: usize,
    step_hz: f64,
}

struct Peak {
    freq_hz: f64,
    height: f64,
}

impl ComplexSpectrum {
    fn of(samples: &[f64], rate_hz: f64) -> Self {
        let length = (4 * samples.len()).next_power_of_two();
        let mut padded = samples.to_vec();
        padded.resize(length, 0.0);
        let transform = RealFftPlanner::new().plan_fft_forward(length);
        let mut values = transform.make_output_vec();
        // both buffers have the lengths that the plan asks for
        let done = transform.process(&mut padded, &mut values);
        debug_assert!(done.is_ok());
        Self { values, length, step_hz: rate_hz / length as f64 }
    }

    /// Peaks that stand out, highest first. Below two periods per record nothing is a vibration.
    fn peaks(&self, samples: usize) -> Vec<Peak> {
        let height = |i: usize| libm::hypot(self.values[i].re, self.values[i].im);
        let first = (2 * self.length / samples.max(1)).max(1);
        let mut tops: Vec<usize> = (first..self.values.len().saturating_sub(1))
            .filter(|&i| height(i) > height(i - 1) && height(i) >= height(i + 1))
            .collect();
        tops.sort_by(|a, b| height(*b).total_cmp(&height(*a)));
        let floor = tops.first().map_or(0.0, |&i| LEAST_PEAK_RATIO * height(i));
        let mut found: Vec<usize> = Vec::new();
        for top in tops {
            if found.len() == MOST_PEAKS || height(top) <= floor {
                break;
            }
            let apart = found.iter().all(|&other| {
                let valley = (top.min(other)..top.max(other)).map(height).fold(f64::MAX, f64::min);
                // the side lobes of a short record lie within some of its resolution
                let far = top.abs_diff(other) > 4 * self.length / samples.max(1);
                far && valley < VALLEY_RATIO * height(top)
            });
            if apart {
                found.push(top);
            }
        }
        let peak = |i: usize| {
            let [a, b, c] = [i - 1, i, i + 1].map(|i| libm::log(height(i).max(f64::MIN_POSITIVE)));
            let shift = 0.5 * (a - c) / (a - 2.0 * b + c);
            let shift = if shift.abs() < 1.0 { shift } else { 0.0 };
            Peak { freq_hz: (i as f64 + shift) * self.step_hz, height: height(i) }
        };
        found.into_iter().map(peak).collect()
    }

    /// The record between two frequencies, without a shift in time.
    fn band(&self, [low, high]: [f64; 2], samples: usize) -> Vec<f64> {
        let weight = |f_hz: f64| {
            // raised cosines over the logarithm of the frequency keep the ringing of the band short
            let edge = |octaves: f64| {
                0.5 - 0.5 * libm::cos(std::f64::consts::PI * octaves.clamp(0.0, 1.0))
            };
            let octaves = |ratio: f64| libm::log2(ratio.max(f64::MIN_POSITIVE));
            edge(octaves(f_hz / low) + 0.5)
                * edge(octaves(high / f_hz.max(f64::MIN_POSITIVE)) + 0.5)
        };
        let mut values: Vec<Complex<f64>> = self
            .values
            .iter()
            .enumerate()
            .map(|(i, v)| *v * weight(i as f64 * self.step_hz))
            .collect();
        // the inverse of a real record needs real ends
        if let Some(last) = values.last_mut() {
            last.im = 0.0;
        }
        values[0].im = 0.0;
        let transform = RealFftPlanner::new().plan_fft_inverse(self.length);
        let mut record = transform.make_output_vec();
        let done = transform.process(&mut values, &mut record);
        debug_assert!(done.is_ok());
        record.truncate(samples);
        record
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use kontur_filters::analysis::decay::damping_of_decrement;
    use std::f64::consts::PI;

    /// Decaying vibrations after a blow at 0.1 s, with a constant offset and noise.
    fn record(modes: &[(f64, f64, f64)], noise: f64, rate_hz: f64, seconds: f64) -> Vec<f64> {
        let mut state = 1_u64;
        let mut random = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
        };
        (0..100_000)
            .map(|i| f64::from(i) / rate_hz)
            .take_while(|t| *t < seconds)
            .map(|t| t - 0.1)
            .map(|t| {
                let sum: f64 = modes
                    .iter()
                    .filter(|_| t >= 0.0)
                    .map(|&(f, z, a)| {
                        let w = 2.0 * PI * f;
                        a * libm::exp(-z * w * t) * libm::sin(w * (1.0 - z * z).sqrt() * t)
                    })
                    .sum();
                0.3 + sum + noise * random()
            })
            .collect()
    }

    /// Damping to 5 %, with noise of 2.5 % of the swing. Conformance: I034.
    #[test]
    fn one_mode_with_noise() {
        for (f, z) in [(6.0, 0.05), (6.9, 0.1), (40.0, 0.02), (23.0, 0.15), (11.0, 0.01)] {
            let found = modes(&record(&[(f, z, 2.0)], 0.05, 2000.0, 4.0), 2000.0);
            let first = found[0];
            assert!((first.freq_hz / f - 1.0).abs() < 0.005, "{f} {z}: {found:?}");
            assert!((first.damping.unwrap() / z - 1.0).abs() < 0.05, "{f} {z}: {found:?}");
        }
    }

    /// Successive maxima in the ratio 2 are a damping of 0.1097. Conformance: V064.
    #[test]
    fn maxima_that_halve() {
        let damping = 1.0 / libm::hypot(1.0, 2.0 * PI / std::f64::consts::LN_2);
        assert!((damping - 0.1097).abs() < 5e-5);
        assert!((damping_of_decrement(std::f64::consts::LN_2) - damping).abs() < 1e-15);
        // e^(-d) per period by the maxima themselves, whatever the formula says
        let period_s = 0.1;
        let decay = std::f64::consts::LN_2 / period_s;
        let samples: Vec<f64> = (0..2000)
            .map(|i| f64::from(i) * 1e-3)
            .map(|t| libm::exp(-decay * t) * libm::cos(2.0 * PI * t / period_s))
            .collect();
        let found = modes(&samples, 1000.0)[0];
        assert!((found.damping.unwrap() / damping - 1.0).abs() < 0.05, "{found:?}");
        let undamped_hz = 10.0 / (1.0 - damping * damping).sqrt();
        assert!((found.freq_hz / undamped_hz - 1.0).abs() < 0.005, "{found:?}");
    }

    #[test]
    fn two_modes() {
        let found =
            modes(&record(&[(8.0, 0.03, 2.0), (35.0, 0.02, 1.0)], 0.02, 1000.0, 5.0), 1000.0);
        assert_eq!(found.len(), 2, "{found:?}");
        for (mode, (f, z)) in found.iter().zip([(8.0, 0.03), (35.0, 0.02)]) {
            assert!((mode.freq_hz / f - 1.0).abs() < 0.01, "{found:?}");
            assert!((mode.damping.unwrap() / z - 1.0).abs() < 0.05, "{found:?}");
        }
        assert!(found[1].peak_ratio < 1.0);
    }

    #[test]
    fn what_is_no_vibration() {
        assert!(modes(&[1.0; 500], 1000.0).is_empty());
        assert!(modes(&[0.0; 64], 1000.0).is_empty());
    }

    #[test]
    fn files() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.csv");
        let row = |i: u32| format!("{}, {}, 1\n", f64::from(i) / 500.0, i % 7);
        let text = format!("t_s, a, b\n{}", (0..200).map(row).collect::<String>());
        std::fs::write(&path, &text).unwrap();
        let (samples, rate_hz) = read(&path, Some("A"), None).unwrap();
        assert_eq!(samples.len(), 200);
        assert!((samples[8] - 1.0).abs() < 1e-12);
        assert!((rate_hz - 500.0).abs() < 1e-6);
        assert!((read(&path, None, Some(100.0)).unwrap().1 - 100.0).abs() < 1e-12);
        let message = |e: Error| e.to_string();
        assert!(message(read(&path, Some("c"), None).unwrap_err()).contains("t_s, a, b"));
        std::fs::write(&path, "a\n1\n2\n").unwrap();
        assert!(message(read(&path, None, None).unwrap_err()).contains("64 at least"));
        std::fs::write(&path, text.replace("t_s", "x")).unwrap();
        assert!(message(read(&path, None, None).unwrap_err()).contains("--rate"));
        std::fs::write(&path, text.replace("0.002,", "0.0035,")).unwrap();
        assert!(message(read(&path, Some("a"), None).unwrap_err()).contains("equal steps"));
        std::fs::write(&path, text.replace("0.002, 1", "0.002, one")).unwrap();
        assert!(message(read(&path, Some("a"), None).unwrap_err()).contains("row 3, column a"));
        assert!(matches!(read(&folder.path().join("no.csv"), None, None), Err(Error::Io { .. })));
    }
}
