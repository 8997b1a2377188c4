//! `kontur tune`: from what was measured at a machine to the settings that leave its vibration alone.
//!
//! Residual vibration is computed for the kernels of the cycle time, never looked up: the vendor's table of permitted
//! deviations normalises the set frequency by the real one, its worked example the other way round. Both stand in every
//! answer.
//!
//! ```
//! use clap::Parser as _;
//! use kontur::args::{Args, Command};
//! use kontur::console::Console;
//!
//! let words = ["kontur", "tune", "--freq", "32"];
//! let Command::Tune(args) = Args::try_parse_from(words)?.command else { unreachable!() };
//! let mut console = Console::new(std::io::sink(), std::io::sink());
//! let answer = kontur::tune::answer(&args, &mut console).unwrap();
//! assert!(answer.command.is_some_and(|command| command.contains("FREQ=32")));
//! # Ok::<(), clap::Error>(())
//! ```

mod combined;
mod order;
mod picture;
mod program;
mod recording;
pub mod vibration;

use crate::args::TuneArgs;
use crate::console::Console;
use crate::files::Lists;
use crate::table::{Cell, Table, number};
use crate::target::{keep_apart, write};
use crate::{Error, Exit};
use kontur_filters::analysis::tuning::{Choice, VibrationBand};
use kontur_filters::time::CycleTime;
use kontur_filters::vib_guard::VibGuardSettings;
use recording::Measured;
use std::path::PathBuf;
use vibration::{Estimate, Mode};

/// What the table of the modes is computed for.
#[derive(Clone, Debug)]
struct Task {
    /// Measured natural frequencies in Hz.
    freqs_hz: Vec<f64>,
    /// Where the real ones lie for sure: lower and upper end of the interval of each in Hz.
    bands_hz: Vec<(f64, f64)>,
    /// Weaker vibrations of the recordings.
    others: Vec<Mode>,
    band: VibrationBand,
    /// A set frequency in Hz that is judged beside the best one.
    at_hz: f64,
    limit_ratio: f64,
    feed_mm_min: f64,
    /// Tolerance in mm that the command to paste carries.
    max_dev_mm: Option<f64>,
    cycle: CycleTime,
}

/// One row of the table.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Row {
    choice: Choice,
    /// The frequency was given, not found.
    given: bool,
}

/// What is known about each choice, and the one to take.
#[derive(Clone, Debug)]
pub struct Answer {
    /// One row per choice: settings, residual vibration, contour error, delay; with a program what a run was like.
    pub choices: Table,
    /// The command to paste; none if no choice keeps what was asked for.
    pub command: Option<String>,
    /// How the command ends.
    pub exit: Exit,
}

/// Answers the question that the arguments ask.
///
/// # Errors
/// [`Error`] if lists or files are wrong, or if nothing can be said about them.
pub fn tune(args: &TuneArgs, console: &mut Console) -> Result<Exit, Error> {
    Ok(answer(args, console)?.exit)
}

/// As [`tune`], with the numbers behind what is printed.
///
/// # Errors
/// As [`tune`].
pub fn answer(args: &TuneArgs, console: &mut Console) -> Result<Answer, Error> {
    let lists = Lists::default();
    let cycle = cycle(args, &lists, console)?;
    let inputs = args.recording.iter().chain(&args.program).cloned();
    let read: Vec<PathBuf> = lists.read_so_far().into_iter().chain(inputs).collect();
    keep_apart(&read, args.output.as_slice())?;
    if let Some(tolerance_mm) = args.order_for {
        return order::answer(tolerance_mm, args.feed, cycle, console);
    }
    let Measured { freqs, damping: measured_damping, others, recordings } =
        if args.recording.is_empty() {
            let exact = |value: &f64| Estimate { value: *value, half_width: 0.0 };
            Measured { freqs: args.freq.iter().map(exact).collect(), ..Measured::default() }
        } else {
            recording::measured(args, console)?
        };
    // what is judged is what stands in the command to paste
    let damping = args.damping.or(measured_damping.map(rounded));
    let damping = damping.unwrap_or(VibGuardSettings::default().damping);
    let bands_hz: Vec<(f64, f64)> =
        freqs.iter().map(|f| (f.value - f.half_width, f.value + f.half_width)).collect();
    let ends: Vec<f64> = bands_hz.iter().flat_map(|(low, high)| [*low, *high]).collect();
    // the proposal holds for the whole interval of every measured frequency
    let band = VibrationBand::of(&ends, damping)
        .ok_or_else(|| Error::Usage("no natural frequency to tune for".to_owned()))?;
    let freqs_hz: Vec<f64> = freqs.iter().map(|f| f.value).collect();
    let task = Task {
        bands_hz,
        at_hz: args.at.unwrap_or_else(|| (100.0 * median(&freqs_hz)).round() / 100.0),
        freqs_hz,
        others,
        band,
        limit_ratio: args.max_residual / 100.0,
        feed_mm_min: args.feed,
        max_dev_mm: args.max_dev,
        cycle,
    };
    let rows = task.rows();
    console.print(&task.text(&rows))?;
    let answer = match (&args.program, args.max_dev) {
        (Some(file), Some(max_dev_mm)) => program::answer(&task, args, file, max_dev_mm, console)?,
        _ => task.answer(&rows, console)?,
    };
    // last: what the program reads is known now
    if let Some(output) = &args.output {
        write(&[(output, picture::draw(&recordings).as_bytes())])?;
    }
    Ok(answer)
}

/// The cycle of the machine, if one is named, else that of the option.
fn cycle(args: &TuneArgs, lists: &Lists, console: &mut Console) -> Result<CycleTime, Error> {
    let loaded = args.simulation.request("").machine(lists);
    let (machine, messages) = loaded.map_err(|e| crate::run::announce_lists(e, console))?;
    // with a program the run repeats them
    if args.program.is_none() {
        for message in &messages {
            console.announce(message);
        }
    }
    Ok(machine.cycle)
}

fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let (low, high) = (sorted.len().saturating_sub(1) / 2, sorted.len() / 2);
    match (sorted.get(low), sorted.get(high)) {
        (Some(low), Some(high)) => f64::midpoint(*low, *high),
        _ => 0.0,
    }
}

/// The command that switches settings on.
fn command(settings: &VibGuardSettings, rest: &str) -> String {
    let VibGuardSettings { mode, freq_hz, damping } = settings;
    format!("#VIB GUARD ON [MODE={mode} FREQ={freq_hz} DAMPING={damping}{rest}]")
}

/// A damping ratio as it is written: nobody measures more digits.
fn rounded(damping: f64) -> f64 {
    (damping * 1e4).round() / 1e4
}

impl Task {
    /// Every mode at its best frequency and at the given one; modes without a kernel are left out.
    fn rows(&self) -> Vec<Row> {
        (1..=4).flat_map(|mode| self.of_mode(mode)).collect()
    }

    fn of_mode(&self, mode: u8) -> impl Iterator<Item = Row> {
        let best = self.band.best(mode, self.cycle);
        let settings = VibGuardSettings { mode, freq_hz: self.at_hz, damping: self.band.damping };
        let at = self.band.judge(settings, self.cycle);
        let at = at.filter(|at| {
            best.is_none_or(|best| (best.settings.freq_hz - at.settings.freq_hz).abs() > 1e-9)
        });
        let row = |given| move |choice| Row { choice, given };
        best.map(row(false)).into_iter().chain(at.map(row(true)))
    }

    /// The proposal and the numbers behind it.
    fn answer(&self, rows: &[Row], console: &mut Console) -> Result<Answer, Error> {
        console.print(&self.proposal(rows))?;
        let mut choices = Table::new(&[
            "mode",
            "freq_hz",
            "damping",
            "given",
            "residual_ratio",
            "contour_err_mm",
            "delay_s",
            "keeps",
        ]);
        for Row { choice, given } in rows {
            choices.push([
                Cell::from(u32::from(choice.settings.mode)),
                Cell::Given(choice.settings.freq_hz),
                Cell::Given(choice.settings.damping),
                Cell::from(u32::from(*given)),
                Cell::Given(choice.worst_ratio),
                Cell::Given(self.corner_error_mm(choice)),
                Cell::Given(choice.delay_cycles * self.cycle.seconds()),
                Cell::from(u32::from(self.keeps(choice))),
            ]);
        }
        let proposed =
            self.proposed(rows).map(|choice| command(&choice.settings, &self.tolerance()));
        Ok(Answer { choices, command: proposed, exit: Exit::Finished })
    }

    fn keeps(&self, choice: &Choice) -> bool {
        choice.worst_ratio <= self.limit_ratio
    }

    fn corner_error_mm(&self, choice: &Choice) -> f64 {
        choice.corner_error_s * self.feed_mm_min / 60.0
    }

    /// What was measured, what was assumed, and both tables.
    fn text(&self, rows: &[Row]) -> String {
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
    fn residuals(&self, rows: &[Row]) -> String {
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
    fn vibration(mode: &Mode) -> (f64, f64) {
        (mode.freq.value, mode.damping.value)
    }

    /// Share of a vibration of this frequency in Hz and damping that a choice leaves.
    fn left_of(&self, choice: &Choice, (real_hz, damping): (f64, f64)) -> Option<f64> {
        let band = VibrationBand { low_hz: real_hz, high_hz: real_hz, damping };
        Some(band.judge(choice.settings, self.cycle)?.worst_ratio)
    }

    /// Weaker vibrations of which a choice leaves more than the limit of the strongest one.
    fn beside(&self, choice: &Choice) -> String {
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

    /// The mode with the least contour error among those that keep the limit, at its best frequency.
    fn proposed(&self, rows: &[Row]) -> Option<Choice> {
        let best = rows.iter().filter(|row| !row.given).map(|row| row.choice);
        best.filter(|choice| self.keeps(choice))
            .reduce(|a, b| if b.corner_error_s < a.corner_error_s { b } else { a })
    }

    fn tolerance(&self) -> String {
        self.max_dev_mm.map_or_else(String::new, |mm| format!(" AX_DEV={mm}"))
    }

    fn proposal(&self, rows: &[Row]) -> String {
        match self.proposed(rows) {
            Some(choice) => format!(
                "\nproposal  {}\n          the least contour error among the modes that keep {} %; {}\n{}",
                command(&choice.settings, &self.tolerance()),
                100.0 * self.limit_ratio,
                match self.max_dev_mm {
                    Some(mm) => format!("AX_DEV keeps the axes within {mm} mm of the contour"),
                    None => "AX_DEV=.. in the same brackets bounds it".to_owned(),
                },
                self.beside(&choice)
            ),
            None => combined::answer(self).unwrap_or_else(|| {
                format!(
                    "\nproposal  none: no mode keeps {} % over {} to {} Hz; settings per position or a larger \
                     --max-residual are what is left\n",
                    100.0 * self.limit_ratio,
                    number(self.band.low_hz, 2),
                    number(self.band.high_hz, 2)
                )
            }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn task(freqs_hz: &[f64]) -> Task {
        Task {
            bands_hz: freqs_hz.iter().map(|f| (*f, *f)).collect(),
            at_hz: median(freqs_hz),
            freqs_hz: freqs_hz.to_vec(),
            others: Vec::new(),
            band: VibrationBand::of(freqs_hz, 0.1).unwrap(),
            limit_ratio: 0.05,
            feed_mm_min: 4000.0,
            max_dev_mm: None,
            cycle: CycleTime::DEFAULT,
        }
    }

    #[test]
    fn medians() {
        for (values, want) in
            [(&[6.9, 6.0, 5.4][..], 6.0), (&[4.0, 1.0, 2.0, 3.0], 2.5), (&[7.0], 7.0)]
        {
            assert!((median(values) - want).abs() < 1e-12, "{values:?}");
        }
    }

    /// Conformance: V018, V019, V020, V021.
    #[test]
    fn the_vendors_example_gives_mode_2() {
        let task = task(&[6.9, 6.0, 5.4]);
        let rows = task.rows();
        assert_eq!(rows.len(), 8);
        assert_eq!(task.proposed(&rows).unwrap().settings.mode, 2);
        let text = task.text(&rows);
        // residuals of FREQ = 6 at 6.9, 6.0 and 5.4 Hz and both ways to state the deviation
        for row in ["+15.0", "-10.0", "-13.0", "+11.1"] {
            assert!(text.contains(row), "{row}: {text}");
        }
        let residual = |mode: &str| {
            let lines = text.lines().skip_while(|l| !l.contains("f_real 6.9 Hz"));
            let row = lines.filter(|l| l.starts_with(mode)).find(|l| l.contains(" 6 ")).unwrap();
            let numbers = row.split_whitespace().filter_map(|w| w.parse::<f64>().ok());
            let numbers: Vec<f64> = numbers.skip(2).collect();
            [numbers[0], numbers[2]]
        };
        for (mode, want) in
            [("1", [19.3, 13.5]), ("2", [3.7, 1.8]), ("3", [0.7, 0.2]), ("4", [6.6, 4.0])]
        {
            let is = residual(mode);
            assert!(
                (is[0] - want[0]).abs() < 0.06 && (is[1] - want[1]).abs() < 0.06,
                "{mode} {is:?}"
            );
        }
        assert!(task.proposal(&rows).contains("#VIB GUARD ON [MODE=2 FREQ="));
        let bounded = Task { max_dev_mm: Some(0.01), ..task };
        assert!(bounded.proposal(&rows).contains(" DAMPING=0.1 AX_DEV=0.01]\n"));
    }

    /// 4 and 16 Hz: no mode keeps 5 % of both. Guard and band stop together, judged by their steady responses here:
    /// the product of both magnitudes bounds what is left.
    #[test]
    fn two_far_vibrations_get_a_combined_answer() {
        let task = task(&[4.0, 16.0]);
        let rows = task.rows();
        assert_eq!(task.proposed(&rows), None);
        let text = task.proposal(&rows);
        assert!(
            text.contains("#VIB GUARD ON [MODE=") && text.contains("filter[0].enable 1"),
            "{text}"
        );
        let left: Vec<f64> = text
            .split(" leave ")
            .nth(1)
            .unwrap()
            .split_whitespace()
            .filter_map(|w| w.parse().ok())
            .take(2)
            .collect();
        assert!(left.iter().all(|l| *l <= 5.0), "{text}");
        assert!(!text.contains("none"));
    }

    /// The interval of a measured frequency widens what the proposal has to hold.
    #[test]
    fn the_accuracy_of_the_measurement_is_a_margin() {
        let exact = task(&[6.0]);
        let mut blurred = task(&[6.0]);
        blurred.band = VibrationBand::of(&[5.1, 6.9], 0.1).unwrap();
        let [a, b] = [&exact, &blurred].map(|t| t.proposed(&t.rows()).unwrap());
        assert!(b.corner_error_s > a.corner_error_s);
        assert!(
            blurred.keeps(&b)
                && blurred
                    .band
                    .judge(a.settings, blurred.cycle)
                    .is_some_and(|c| !blurred.keeps(&c))
        );
    }

    /// Half of a vibration of the other frequency is far more than 5 % of the strongest one; a tenth as strong it is not.
    #[test]
    fn a_second_vibration_that_stays_is_told() {
        let other = |peak_ratio| {
            let e = |value| Estimate { value, half_width: 0.0 };
            Mode { freq: e(31.0), damping: e(0.1), peak_ratio }
        };
        let with = |peak_ratio| Task { others: vec![other(peak_ratio)], ..task(&[20.0]) };
        let said = with(0.5).proposal(&with(0.5).rows());
        assert!(said.contains("warning   31.00 Hz, 50 % as strong"), "{said}");
        assert!(said.contains("--freq 20.00,31.00 tunes"), "{said}");
        assert!(!with(0.05).proposal(&with(0.05).rows()).contains("warning"));
        assert!(with(0.5).text(&with(0.5).rows()).contains("other 31 Hz"));
    }

    #[test]
    fn corner_errors_are_those_of_the_document() {
        // 40 Hz at F4000, from the closed forms: 0.204, 0.236, 0.299, 0.204 mm; the grid changes them by 2 %
        let task = task(&[40.0]);
        for (row, want) in task.rows().iter().zip([0.20425, 0.23623, 0.29886, 0.20425]) {
            let is = task.corner_error_mm(&row.choice);
            assert!((is / want - 1.0).abs() < 0.02, "{is} {want}");
        }
    }
}
