//! Natural frequencies and damping from recordings: selection of columns and times, and the common result of several
//! files.

use super::vibration::{Analysis, Estimate, Focus, Lasting, Mode, analyse};
use crate::args::TuneArgs;
use crate::console::Console;
use crate::error::Error;
use crate::recorded::{self, Even};
use crate::table::{Table, number};
use std::ops::Range;
use std::path::Path;

/// Shorter recordings cannot contain a decay.
const LEAST_SAMPLES: usize = 64;
/// Longer recordings are refused: two minutes at 4 kHz. Their spectra take 130 MB.
const MOST_SAMPLES: usize = 1 << 19;

/// Largest number of decimals of a half width.
const MOST_DECIMALS: f64 = 6.0;

/// One recording with its result.
#[derive(Clone, Debug)]
pub(super) struct Recording {
    /// File.
    pub(super) name: String,
    /// Samples at equal steps; missing ones are interpolated linearly.
    pub(super) samples: Vec<f64>,
    /// Ranges of missing samples.
    pub(super) missing: Vec<Range<usize>>,
    /// Samples per second.
    pub(super) rate_hz: f64,
    /// Result.
    pub(super) found: Analysis,
}

/// The common result of the recordings.
#[derive(Clone, Debug, Default)]
pub(super) struct Measured {
    /// The strongest vibration of each recording in Hz.
    pub(super) freqs: Vec<Estimate>,
    /// Mean of their dampings.
    pub(super) damping: Option<f64>,
    /// The weaker vibrations of all recordings.
    pub(super) others: Vec<Mode>,
    /// The recordings.
    pub(super) recordings: Vec<Recording>,
}

/// The natural frequencies of the recordings.
///
/// # Errors
/// [`Error`] if a file cannot be read, has no such column, or contains no decaying vibration.
pub(super) fn measured(args: &TuneArgs, console: &mut Console) -> Result<Measured, Error> {
    let mut table = Table::new(&["recording", "peak", "frequency Hz", "damping", ""]);
    let (mut all, mut notes, mut dampings) = (Measured::default(), String::new(), Vec::new());
    let mut silent = Vec::new();
    for path in &args.recording {
        let (recording, lost_s) = read(path, args)?;
        notes.push_str(&remarks(&recording, lost_s));
        let found = &recording.found;
        if let Some(strongest) = found.modes.first() {
            all.freqs.push(strongest.freq);
            dampings.push(strongest.damping);
            all.others.extend(&found.modes[1..]);
        } else {
            silent.push(recording.name.clone());
        }
        for (i, mode) in found.modes.iter().enumerate() {
            table.push(vec![
                recording.name.clone(),
                format!("{} %", number(100.0 * mode.peak_ratio, 0)),
                interval(mode.freq, 3),
                interval(mode.damping, 4),
                if i == 0 { "used" } else { "other" }.to_owned(),
            ]);
        }
        for lasting in &found.lasting {
            let what = match lasting {
                Lasting { hum: true, .. } => "mains hum, ignored".to_owned(),
                Lasting { loss, .. } if *loss > 0.0 => {
                    format!("decays by {} % only, ignored", number(100.0 * loss, 0))
                }
                Lasting { .. } => "does not decay, ignored".to_owned(),
            };
            table.push(vec![
                recording.name.clone(),
                String::new(),
                number(lasting.freq_hz, 3),
                String::new(),
                what,
            ]);
        }
        all.recordings.push(recording);
    }
    if !silent.is_empty() {
        console.print(&notes)?;
        let text = format!("{}: no decaying vibration found", silent.join(", "));
        return Err(Error::Usage(text));
    }
    notes.push_str(&together(&all.freqs, "frequency", "Hz", 3));
    notes.push_str(&together(&dampings, "damping", "", 4));
    console.print(&format!("{}{notes}\n", table.text()))?;
    let mean = dampings.iter().map(|d| d.value).sum::<f64>() / dampings.len() as f64;
    all.damping = (!dampings.is_empty()).then_some(mean);
    Ok(all)
}

/// `6.01 +- 0.02`: with at least these decimals, and with more of them if the half width has no digit otherwise. It
/// is rounded up: no measurement is exact.
pub(super) fn interval(e: Estimate, decimals: usize) -> String {
    let first_digit = -libm::log10(e.half_width).floor();
    let decimals = decimals.max((first_digit + 1.0).clamp(0.0, MOST_DECIMALS) as usize);
    let unit = libm::exp10(-(decimals as f64));
    let rounded_up = (e.half_width / unit).ceil().max(1.0) * unit;
    format!("{} +- {}", number(e.value, decimals), number(rounded_up, decimals))
}

/// Times of samples in s, with commas between them.
fn times(samples: impl Iterator<Item = usize>, rate_hz: f64) -> String {
    let times: Vec<_> = samples.map(|i| format!("{:.2} s", i as f64 / rate_hz)).collect();
    times.join(", ")
}

/// Remarks on how a recording was made.
fn of_recorder(recording: &Recording, lost_s: Option<f64>) -> Vec<String> {
    let Recording { missing, found, rate_hz, .. } = recording;
    let mut notes = Vec::new();
    if let Some(lost_s) = lost_s {
        notes.push(format!(
            "{} samples missing in {} places, the first after {lost_s:.3} s; ignored",
            missing.iter().map(ExactSizeIterator::len).sum::<usize>(),
            missing.len()
        ));
    }
    if found.clipped > 0 {
        notes.push(format!("{} samples at the limit of the recorder, ignored", found.clipped));
    }
    if !found.jumps.is_empty() {
        let jumps = times(found.jumps.iter().copied(), *rate_hz);
        notes.push(format!("its level jumps at {jumps}; the parts are evaluated one by one"));
    }
    if let Some(steps) = found.steps {
        notes.push(format!(
            "the recorder resolves its amplitude in {} steps only: what is below them is ignored, and the intervals are \
             too small; record it with a finer resolution",
            number(steps, 0)
        ));
    }
    notes
}

/// Remarks on one recording in addition to its vibrations.
fn remarks(recording: &Recording, lost_s: Option<f64>) -> String {
    let Recording { name, found, rate_hz, .. } = recording;
    let mut notes = of_recorder(recording, lost_s);
    if found.modes.first().is_some_and(|m| m.peak_ratio < 1.0) {
        notes.push(
            "the highest peak is that of a transient, not of a vibration: an excitation, a jump or a drift; select a \
             free decay with --window"
                .to_owned(),
        );
    }
    if found.decays.len() > 1 {
        let starts = times(found.decays.iter().map(|d| d.samples.start), *rate_hz);
        notes.push(format!("{} decays, from {starts}", found.decays.len()));
    }
    if let Some(misfit) = found.misfit {
        notes.push(format!(
            "the fit leaves {} times the white noise: no free decay, or coloured noise; the intervals are too \
             small, select a free decay with --window",
            number(misfit, 1)
        ));
    }
    let slow = found.lasting.iter().filter(|l| l.loss > 0.0 && !l.hum);
    if let Some(slow) = slow
        .filter(|l| l.amplitude > found.swing)
        .max_by(|a, b| a.amplitude.total_cmp(&b.amplitude))
    {
        notes.push(format!(
            "{} Hz swings more than the vibrations that were evaluated, but loses only {} % within the recording: \
             record it for longer",
            number(slow.freq_hz, 3),
            number(100.0 * slow.loss, 0)
        ));
    }
    if let Some((low, high)) = found.disagree {
        notes.push(format!("its decays differ: {} to {} Hz", number(low, 2), number(high, 2)));
    }
    notes.iter().map(|text| format!("note      {name}: {text}\n")).collect::<Vec<_>>().concat()
}

/// Statement on whether several recordings agree about a quantity.
fn together(found: &[Estimate], what: &str, unit: &str, decimals: usize) -> String {
    let (Some(low), Some(high)) = (
        found.iter().copied().reduce(|a, b| if b.value < a.value { b } else { a }),
        found.iter().copied().reduce(|a, b| if b.value > a.value { b } else { a }),
    ) else {
        return String::new();
    };
    if found.len() < 2 {
        return String::new();
    }
    let apart = high.value - low.value;
    let agree = apart <= 1.3 * libm::hypot(low.half_width, high.half_width);
    let [a, b] = [low, high].map(|e| number(e.value, decimals));
    let unit = if unit.is_empty() { String::new() } else { format!(" {unit}") };
    if agree {
        format!("agree     {what} {a} to {b}{unit}: the same within the accuracy\n")
    } else {
        format!(
            "disagree  {what} {a} to {b}{unit}: more than the accuracy allows, it depends on the position\n"
        )
    }
}

/// A file, its selected part and result, and the time in s after which the first samples are missing.
fn read(path: &Path, args: &TuneArgs) -> Result<(Recording, Option<f64>), Error> {
    let name = path.display().to_string();
    let wrong = |text: String| Error::Usage(format!("{name}: {text}"));
    let channels = recorded::read(path)?;
    let known = || {
        let names: Vec<&str> = channels.iter().map(|c| c.name.as_str()).collect();
        format!("its columns are {}", names.join(", "))
    };
    let channel = match &args.column {
        Some(wanted) => recorded::find(&channels, wanted)
            .ok_or_else(|| wrong(format!("no column `{wanted}`; {}", known())))?,
        None => channels.last().ok_or_else(|| wrong("no columns".to_owned()))?,
    };
    let Even { values: samples, begin_s, step_s, drop_outs } =
        channel.even(args.rate).map_err(|e| wrong(format!("{e}; {}", known())))?;
    let rate_hz = 1.0 / step_s;
    let missing: Vec<_> = drop_outs.iter().map(|d| d.samples.clone()).collect();
    let wrong = |text: String| Error::Usage(format!("{name}: {text}"));
    let count = samples.len() - missing.iter().map(ExactSizeIterator::len).sum::<usize>();
    if count < LEAST_SAMPLES || samples.len() > MOST_SAMPLES {
        let text = format!("{count} samples, allowed: {LEAST_SAMPLES} to {MOST_SAMPLES}");
        return Err(wrong(text));
    }
    let whole = Focus::default();
    let focus = Focus {
        range_hz: args.range.unwrap_or(whole.range_hz),
        window_s: args.window.unwrap_or(whole.window_s),
    };
    let found = analyse(&samples, &missing, rate_hz, &focus);
    let lost_s = drop_outs.first().map(|d| d.after_s - begin_s);
    Ok((Recording { name, samples, missing, rate_hz, found }, lost_s))
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::Parser;

    #[derive(Parser)]
    struct Line {
        #[command(flatten)]
        tune: TuneArgs,
    }

    fn read_with(text: &str, words: &[&str]) -> Result<Recording, Error> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.csv");
        std::fs::write(&path, text).unwrap();
        let file = path.display().to_string();
        let start = ["tune", "--recording", &file];
        let line = start.iter().chain(words).map(|w| (*w).to_owned());
        read(&path, &Line::try_parse_from(line).unwrap().tune).map(|r| r.0)
    }

    fn rows(times: impl Fn(u32) -> f64) -> String {
        let rows: Vec<String> = (0..100).map(|i| format!("{},{i},1", times(i))).collect();
        format!("t_s,a,b\n{}\n", rows.join("\n"))
    }

    #[test]
    fn columns_and_rates() {
        let text = rows(|i| f64::from(i) / 500.0);
        let got = read_with(&text, &["--column", "a"]).unwrap();
        assert!(
            (got.rate_hz - 500.0).abs() < 1e-9 && got.samples[7].to_bits() == 7.0_f64.to_bits()
        );
        assert!(read_with(&text, &["--column", "a", "--rate", "500"]).is_ok());
        let message = |r: Result<Recording, Error>| r.unwrap_err().to_string();
        let other = message(read_with(&text, &["--column", "a", "--rate", "1000"]));
        assert!(other.contains("contradicts") && other.contains("500.000 Hz"), "{other}");
        assert!(message(read_with(&text, &["--column", "x"])).contains("a, b"));
        assert!(message(read_with(&text.replace("t_s", "x"), &[])).contains("--rate"));
        assert!(message(read_with("a\n1\n2\n", &["--rate", "100"])).contains("64 to"));
        let bent = rows(|i| f64::from(i) / 500.0 + if i > 50 { 0.0009 } else { 0.0 });
        assert!(message(read_with(&bent, &["--column", "a"])).contains("equal steps"));
        let word = text.replace("0.002,1,", "0.002,one,");
        assert!(message(read_with(&word, &["--column", "a"])).contains("row 3, column a"));
        assert!(matches!(recorded::read(Path::new("no.csv")), Err(Error::Io { .. })));
    }

    /// A jump of the level and a coarse recorder are told, and nothing of a good recording.
    #[test]
    fn remarks_on_the_recorder() {
        let notes = |step: f64, jump: f64| {
            let value = |i: i32| {
                let t = f64::from(i) * 1e-3;
                let x = libm::exp(-3.8 * t) * libm::sin(125.6 * t);
                let x = (x / step).round() * step;
                x + if i < 1000 { 0.0 } else { jump }
            };
            let rows: Vec<String> =
                (0..2500).map(|i| format!("{:.3},{:.6}", f64::from(i) * 1e-3, value(i))).collect();
            let recording = read_with(&format!("t_s,a\n{}\n", rows.join("\n")), &[]).unwrap();
            remarks(&recording, None)
        };
        assert_eq!(notes(1e-6, 0.0), "");
        assert!(notes(1e-6, 2.0).contains("jumps at 1.00 s"), "{}", notes(1e-6, 2.0));
        assert!(notes(0.1, 0.0).contains("in 9 steps") || notes(0.1, 0.0).contains("in 10 steps"));
    }

    /// A half width is not printed as zero, and never too small.
    #[test]
    fn half_widths_have_digits() {
        let text = |value, half_width| interval(Estimate { value, half_width }, 3);
        assert_eq!(text(12.294, 0.044), "12.294 +- 0.044");
        assert_eq!(text(12.294, 0.000_41), "12.29400 +- 0.00041");
        assert_eq!(text(12.294, 1.7), "12.294 +- 1.700");
        assert_eq!(text(12.294, 0.012_01), "12.294 +- 0.013");
        assert_eq!(text(12.294, 1e-14), "12.294000 +- 0.000001");
        assert_eq!(text(12.294, 0.0), "12.294000 +- 0.000001");
    }

    #[test]
    fn agreement_is_reported() {
        let e = |value, half_width| Estimate { value, half_width };
        let same = together(&[e(6.0, 0.02), e(6.01, 0.02)], "frequency", "Hz", 2);
        assert!(same.starts_with("agree"), "{same}");
        let apart = together(&[e(6.0, 0.02), e(6.9, 0.02), e(5.4, 0.02)], "frequency", "Hz", 2);
        assert!(apart.starts_with("disagree  frequency 5.40 to 6.90 Hz"), "{apart}");
    }
}
