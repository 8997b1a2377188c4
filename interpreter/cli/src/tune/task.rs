//! The modes to choose from for a vibration, each with its residual vibration, and the proposed command.

use super::vibration::Mode;
use crate::error::Exit;
use crate::table::{Table, number};
use kontur_filters::analysis::tuning::{Choice, VibrationBand};
use kontur_filters::time::CycleTime;
use kontur_filters::vib_guard::VibGuardSettings;

/// Input of the table of modes.
#[derive(Clone, Debug)]
pub(super) struct Task {
    /// Measured natural frequencies in Hz.
    pub(super) freqs_hz: Vec<f64>,
    /// Ranges of the real frequencies: lower and upper end of the confidence interval of each in Hz.
    pub(super) bands_hz: Vec<(f64, f64)>,
    /// Weaker vibrations of the recordings.
    pub(super) others: Vec<Mode>,
    pub(super) band: VibrationBand,
    /// A set frequency in Hz that is evaluated in addition to the best one.
    pub(super) at_hz: f64,
    pub(super) limit_ratio: f64,
    pub(super) feed_mm_min: f64,
    /// Tolerance in mm in the proposed command.
    pub(super) max_dev_mm: Option<f64>,
    pub(super) cycle: CycleTime,
}

/// One row of the table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Row {
    pub(super) choice: Choice,
    /// Whether the frequency was given rather than found.
    pub(super) given: bool,
}

/// The values of each choice, and the one to use.
#[derive(Clone, Debug)]
pub struct Answer {
    /// One row per choice: settings, residual vibration, contour error, delay; with a program also the results of a
    /// run.
    pub choices: Table,
    /// The command to use; `None` if no choice meets the request.
    pub command: Option<String>,
    /// Exit code of the command.
    pub exit: Exit,
}

/// The median; for an even number of values the mean of the two in the middle, 0 without any.
pub(super) fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let (low, high) = (sorted.len().saturating_sub(1) / 2, sorted.len() / 2);
    match (sorted.get(low), sorted.get(high)) {
        (Some(low), Some(high)) => f64::midpoint(*low, *high),
        _ => 0.0,
    }
}

/// The command that switches settings on.
pub(super) fn command(settings: &VibGuardSettings, rest: &str) -> String {
    let VibGuardSettings { mode, freq_hz, damping } = settings;
    format!("#VIB GUARD ON [MODE={mode} FREQ={freq_hz} DAMPING={damping}{rest}]")
}

impl Task {
    /// Every mode at its best frequency and at the given one; modes without a kernel are left out.
    pub(super) fn rows(&self) -> Vec<Row> {
        (1..=4).flat_map(|mode| self.of_mode(mode)).collect()
    }

    /// Why there is no row.
    pub(super) fn without_mode(&self) -> String {
        format!(
            "{} Hz: no mode of the Vibration Guard can be realised, its impulses would be less than the cycle of {} ms apart",
            self.at_hz,
            f64::from(self.cycle.us()) / 1000.0,
        )
    }

    pub(super) fn of_mode(&self, mode: u8) -> impl Iterator<Item = Row> {
        let best = self.band.best(mode, self.cycle);
        let settings = VibGuardSettings { mode, freq_hz: self.at_hz, damping: self.band.damping };
        let at = self.band.judge(settings, self.cycle);
        let at = at.filter(|at| {
            best.is_none_or(|best| (best.settings.freq_hz - at.settings.freq_hz).abs() > 1e-9)
        });
        let row = |given| move |choice| Row { choice, given };
        best.map(row(false)).into_iter().chain(at.map(row(true)))
    }

    pub(super) fn keeps(&self, choice: &Choice) -> bool {
        choice.worst_ratio <= self.limit_ratio
    }

    pub(super) fn corner_error_mm(&self, choice: &Choice) -> f64 {
        choice.corner_error_s * self.feed_mm_min / 60.0
    }

    /// Measurements, assumptions, and both tables.
    pub(super) fn text(&self, rows: &[Row]) -> String {
        let list = |values: &[f64]| {
            values
                .iter()
                .map(|f| format!("{}", (f * 1e3).round() / 1e3))
                .collect::<Vec<_>>()
                .join(", ")
        };
        let mut out = format!(
            "measured  {} Hz, damping {}\n\
             margin    {} to {} Hz with the accuracy of the measurement\n\
             assumed   cycle {} ms; 90 degree corner at F{} without slowing down; residual at most {} %\n\n",
            list(&self.freqs_hz),
            self.band.damping,
            number(self.band.low_hz, 3),
            number(self.band.high_hz, 3),
            f64::from(self.cycle.us()) / 1000.0,
            self.feed_mm_min,
            100.0 * self.limit_ratio,
        );
        let mut table = Table::new(&[
            "mode",
            "f_set Hz",
            "",
            "real/set - 1",
            "set/real - 1",
            "worst residual",
            "contour error",
            "delay",
            "command",
        ]);
        for Row { choice, given } in rows {
            let set = choice.settings.freq_hz;
            let span =
                |a: f64, b: f64| format!("{:+.1} {:+.1} %", 100.0 * (a - 1.0), 100.0 * (b - 1.0));
            table.push(vec![
                choice.settings.mode.to_string(),
                format!("{set}"),
                if *given { "given" } else { "best" }.to_owned(),
                span(self.band.low_hz / set, self.band.high_hz / set),
                span(set / self.band.high_hz, set / self.band.low_hz),
                format!(
                    "{} %{}",
                    number(100.0 * choice.worst_ratio, 2),
                    if self.keeps(choice) { "  " } else { " !" }
                ),
                format!("{} mm", number(self.corner_error_mm(choice), 5)),
                format!("{} ms", number(choice.delay_cycles * 1000.0 * self.cycle.seconds(), 2)),
                command(&choice.settings, ""),
            ]);
        }
        out.push_str(&table.text());
        out.push('\n');
        out.push_str(&self.residuals(rows));
        out
    }

    /// Residual vibration at each measured frequency.
    pub(super) fn residuals(&self, rows: &[Row]) -> String {
        let mut header = vec!["mode".to_owned(), "f_set Hz".to_owned()];
        let rounded = |f: f64| (f * 1e3).round() / 1e3;
        header.extend(self.freqs_hz.iter().map(|f| format!("f_real {} Hz", rounded(*f))));
        header.extend(self.others.iter().map(|m| format!("other {} Hz", rounded(m.freq.value))));
        let header: Vec<&str> = header.iter().map(String::as_str).collect();
        let mut table = Table::new(&header);
        for Row { choice, .. } in rows {
            let mut row =
                vec![choice.settings.mode.to_string(), format!("{}", choice.settings.freq_hz)];
            let real = self.freqs_hz.iter().map(|f| (*f, self.band.damping));
            let all = real.chain(self.others.iter().map(Self::vibration));
            row.extend(all.map(|real| {
                let left = self.left_of(choice, real);
                left.map_or_else(String::new, |left| format!("{} %", number(100.0 * left, 2)))
            }));
            table.push(row);
        }
        table.text()
    }

    /// Frequency in Hz and damping of a weaker vibration.
    pub(super) fn vibration(mode: &Mode) -> (f64, f64) {
        (mode.freq.value, mode.damping.value)
    }

    /// Residual share of a vibration of this frequency in Hz and damping under a choice.
    pub(super) fn left_of(&self, choice: &Choice, (real_hz, damping): (f64, f64)) -> Option<f64> {
        let band = VibrationBand { low_hz: real_hz, high_hz: real_hz, damping };
        Some(band.judge(choice.settings, self.cycle)?.worst_ratio)
    }

    /// Weaker vibrations whose residual under a choice exceeds the limit for the strongest one.
    pub(super) fn beside(&self, choice: &Choice) -> String {
        let loud = |m: &&Mode| {
            self.left_of(choice, Self::vibration(m))
                .is_some_and(|left| left * m.peak_ratio > self.limit_ratio)
        };
        let line = |mode: &Mode| {
            let left = self.left_of(choice, Self::vibration(mode)).unwrap_or(1.0);
            let all = self.freqs_hz.iter().chain([&mode.freq.value]).map(|f| number(*f, 2));
            format!(
                "warning   {} Hz, {} % as strong, keeps {} % of its vibration; --freq {} tunes for both\n",
                number(mode.freq.value, 2),
                number(100.0 * mode.peak_ratio, 0),
                number(100.0 * left, 0),
                all.collect::<Vec<_>>().join(",")
            )
        };
        self.others.iter().filter(loud).map(line).collect::<Vec<_>>().concat()
    }

    /// The mode with the smallest contour error of those within the limit, at its best frequency.
    pub(super) fn proposed(&self, rows: &[Row]) -> Option<Choice> {
        let best = rows.iter().filter(|row| !row.given).map(|row| row.choice);
        best.filter(|choice| self.keeps(choice))
            .reduce(|a, b| if b.corner_error_s < a.corner_error_s { b } else { a })
    }

    pub(super) fn tolerance(&self) -> String {
        self.max_dev_mm.map_or_else(String::new, |mm| format!(" AX_DEV={mm}"))
    }
}
