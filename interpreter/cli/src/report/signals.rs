//! Columns of the trace over time, and their spectra: one panel each, one curve per run.

use super::requests::requests;
use crate::args::ReportArgs;
use crate::chart::plot::Plot;
use crate::chart::scale::{Scale, around, of_column};
use crate::chart::view::{Line, Points, View, thinned};
use crate::console::Console;
use crate::error::{Error, Exit};
use crate::request::Opened;
use crate::run::{Shown, announce_lists, drive};
use crate::spectrum::{AmplitudeSpectrum, MOST_SAMPLES};
use crate::table::number;
use crate::target::{create_all, keep_apart};
use crate::trace::select;
use kontur_interpreter::job::Facts;
use kontur_interpreter::record::Rows;
use kontur_interpreter::record::columns::{Column, asked};
use kontur_interpreter::summary::Collector;
use std::io::{self, BufWriter, Write};
use std::path::Path;

/// Largest number of panels in a picture.
const MOST_SIGNALS: usize = 12;
/// Largest number of values of all runs and columns: 34 MB.
const MOST_VALUES: usize = 1 << 22;
/// The same with spectra, which have several lines per value.
const MOST_TRANSFORMED: usize = 1 << 21;
/// Lines with more points than this are drawn by the extremes of stretches.
const MOST_POINTS: usize = 20_000;

/// The selected columns of one run.
struct Recorded {
    label: String,
    cycle_s: f64,
    columns: Vec<Column>,
    /// Time of each sample in s.
    times: Vec<f64>,
    /// Samples of each column.
    samples: Vec<Vec<f64>>,
}

/// Runs everything and writes the picture (`.svg`) or its numbers (`.csv`), those of the spectra if there are any.
///
/// # Errors
/// [`Error`] if options, lists or files are wrong, or the output cannot be written.
pub(super) fn report(
    args: &ReportArgs,
    names: &str,
    output: &Path,
    console: &mut Console,
) -> Result<Exit, Error> {
    let is = |end: &str| output.extension().is_some_and(|e| e.eq_ignore_ascii_case(end));
    if !is("svg") && !is("csv") {
        let name = output.display();
        let text = format!("{name}: --signals writes a picture (.svg) or a table (.csv)");
        return Err(Error::Usage(text));
    }
    let (mut runs, mut aborted) = (Vec::<Recorded>::new(), false);
    for (program, values, request) in requests(args)? {
        // the headline contains the name of a single program
        let label = match (args.programs.len(), values.is_empty()) {
            (_, true) => program,
            (1, false) => values,
            (_, false) => format!("{program}, {values}"),
        };
        // the same run once more has a curve of its own
        let again = format!("{label} (");
        let same = |run: &&Recorded| run.label == label || run.label.starts_with(&again);
        let label = match runs.iter().filter(same).count() {
            0 => label,
            before => format!("{label} ({})", before + 1),
        };
        let opened = request.open().map_err(|e| announce_lists(e, console))?;
        let values = runs.iter().map(Recorded::values).sum();
        let (recorded, is_aborted) = record(args, names, label, values, opened, output, console)?;
        aborted |= is_aborted;
        runs.push(recorded);
    }
    // refused programs have nothing to show
    if runs.iter().any(|run| !run.times.is_empty()) {
        let to_error = |e| Error::io(output.display().to_string(), e);
        for mut target in create_all([output])? {
            let file = target.file().map_err(to_error)?;
            if is("csv") {
                write_numbers(args, &runs, file).map_err(to_error)?;
            } else {
                file.write_all(plot(args, &runs).draw().as_bytes()).map_err(to_error)?;
            }
            target.show().map_err(to_error)?;
        }
    }
    Ok(if aborted { Exit::Aborted } else { Exit::Finished })
}

/// Runs a program and keeps the values that are shown, beside the number of `values` of the runs before it; whether the run was
/// aborted.
fn record(
    args: &ReportArgs,
    names: &str,
    label: String,
    values: usize,
    Opened { mut run, reads }: Opened,
    output: &Path,
    console: &mut Console,
) -> Result<(Recorded, bool), Error> {
    keep_apart(&reads.so_far(), &[output.to_owned()])?;
    let mut summary = Collector::new(run.facts());
    let mut recorded = Recorded::new(label, names, run.facts())?;
    let (most_values, most_samples) = if args.spectrum.is_some() {
        (MOST_TRANSFORMED, MOST_SAMPLES)
    } else {
        (MOST_VALUES, MOST_VALUES)
    };
    let most = most_samples.min((most_values - values.min(most_values)) / recorded.columns.len());
    let asked = asked(&recorded.columns);
    let take = |rows: &Rows<'_>| {
        let t_s = |k: u64| k as f64 * recorded.cycle_s;
        let is_shown = |k| args.window.is_none_or(|(from, to)| (from..to).contains(&t_s(k)));
        let shown = rows.during(is_shown);
        if recorded.times.len() + shown.len() > most {
            let text = format!(
                "--signals: more than {most_samples} cycles, or {most_values} values in total; use --window to show a part"
            );
            return Err(Error::Usage(text));
        }
        recorded.times.extend(shown.cycles().iter().map(|cycle| t_s(cycle.k)));
        for (samples, column) in recorded.samples.iter_mut().zip(&recorded.columns) {
            column.content.extend(samples, &shown, 1);
        }
        Ok(())
    };
    drive(&mut run, Shown::ALONE, console, Some(&mut summary), Some((asked, take)))?;
    // including the subroutines that the run reached
    keep_apart(&reads.so_far(), &[output.to_owned()])?;
    if recorded.times.is_empty() && summary.cycles() > 0 {
        let end_s = summary.cycles().saturating_sub(1) as f64 * recorded.cycle_s;
        let text = format!("--window: the run of {} ends at {end_s:.3} s", recorded.label);
        return Err(Error::Usage(text));
    }
    let highest_hz = 0.5 / recorded.cycle_s;
    if args.spectrum.is_some_and(|(_, high_hz)| high_hz > highest_hz * (1.0 + 1e-9)) {
        let text = format!(
            "--spectrum: a cycle of {} s allows frequencies up to {highest_hz} Hz",
            recorded.cycle_s
        );
        return Err(Error::Usage(text));
    }
    Ok((recorded, run.totals().aborted))
}

impl Recorded {
    fn new(label: String, names: &str, facts: &Facts) -> Result<Self, Error> {
        let mut columns = select(names, facts)?;
        // time, line, block and words are not curves
        columns.retain(|c| c.group != "time" && c.decimals > 0);
        // in the order of the request
        let words: Vec<&str> = names.split(',').map(str::trim).collect();
        columns.sort_by_key(|c| words.iter().position(|w| *w == c.name || *w == c.group));
        if columns.is_empty() || columns.len() > MOST_SIGNALS {
            let text = format!(
                "--signals: {} columns of measured values, allowed: 1 to {MOST_SIGNALS}",
                columns.len()
            );
            return Err(Error::Usage(text));
        }
        Ok(Self {
            label,
            cycle_s: f64::from(facts.cycle_us) / 1e6,
            samples: vec![Vec::new(); columns.len()],
            times: Vec::new(),
            columns,
        })
    }

    fn values(&self) -> usize {
        self.times.len() * self.columns.len()
    }

    fn spectrum(&self, column: usize) -> AmplitudeSpectrum {
        AmplitudeSpectrum::of(&self.samples[column], self.cycle_s)
    }
}

fn plot(args: &ReportArgs, runs: &[Recorded]) -> Plot {
    let columns = runs.first().map(|r| r.columns.as_slice()).unwrap_or_default();
    let times = || runs.iter().flat_map(|r| r.times.first().into_iter().chain(r.times.last()));
    let mut panels = Vec::new();
    for (i, column) in columns.iter().enumerate() {
        let over_time = |r: &Recorded| {
            let points =
                |s: &Vec<f64>| thinned(r.times.iter().zip(s).map(|(t, y)| [*t, *y]), MOST_POINTS);
            r.samples.get(i).map(points)
        };
        let time = (
            times().copied().fold(f64::INFINITY, f64::min),
            times().copied().fold(f64::NEG_INFINITY, f64::max),
        );
        panels.push(panel(column, &column.name, "time in s", time, runs, over_time));
        if let Some(band) = args.spectrum {
            let over_frequency = |r: &Recorded| {
                let lines = || r.spectrum(i).lines(band).collect::<Points>();
                (i < r.samples.len()).then(|| thinned(lines().into_iter(), MOST_POINTS))
            };
            let title = format!("Amplitude of {}", column.name);
            panels.push(panel(column, &title, "frequency in Hz", band, runs, over_frequency));
        }
    }
    let few = args.spectrum.is_none() && panels.len() > 3;
    Plot {
        title: args
            .programs
            .iter()
            .map(|p| p.display().to_string())
            .collect::<Vec<_>>()
            .join("  \u{b7}  "),
        subtitle: subtitle(args),
        legend: runs.iter().map(|r| r.label.clone()).collect(),
        columns: if few { 2 } else { 1 },
        row_height: 300.0,
        panels,
    }
}

/// Description of the runs and, if a single parameter is varied, of that parameter.
fn subtitle(args: &ReportArgs) -> String {
    let window = args.window.map(|(from, to)| format!("from {from} s to {to} s"));
    let varied = if let [one] = &args.vary[..] { one.meaning() } else { None };
    window.into_iter().chain(varied).collect::<Vec<_>>().join("  \u{b7}  ")
}

fn panel(
    column: &Column,
    title: &str,
    x_label: &'static str,
    x: (f64, f64),
    runs: &[Recorded],
    points: impl Fn(&Recorded) -> Option<Vec<[f64; 2]>>,
) -> View<Points> {
    let line = |(series, r)| Some(Line::series(series, points(r)?));
    let lines: Vec<Line<Points>> = runs.iter().enumerate().filter_map(line).collect();
    let y = around(lines.iter().flat_map(|l| &l.points).map(|p| p[1]).chain([0.0]), 1e-6);
    View {
        title: title.to_owned(),
        x: Scale::linear(x_label, x),
        y: Scale::linear(of_column(&column.name), y),
        lines,
        ..View::default()
    }
}

/// Writes the numbers of the picture as CSV: the spectra if there are any, otherwise the curves over time. This is done
/// row by row, since a table would take several times the memory of the samples.
fn write_numbers(args: &ReportArgs, runs: &[Recorded], to: impl Write) -> io::Result<()> {
    let columns = runs.first().map(|r| r.columns.as_slice()).unwrap_or_default();
    let first = if args.spectrum.is_some() { "f_hz" } else { "t_s" };
    let mut file = csv::Writer::from_writer(BufWriter::new(to));
    file.write_record(["curve", first].into_iter().chain(columns.iter().map(|c| &*c.name)))?;
    for r in runs {
        let mut row = |x: f64, values: &mut dyn Iterator<Item = String>| {
            file.write_record([r.label.clone(), number(x, 6)].into_iter().chain(values))
        };
        let Some(band) = args.spectrum else {
            for (k, t) in r.times.iter().enumerate() {
                let value = |(s, c): (&Vec<f64>, &Column)| number(s[k], usize::from(c.decimals));
                row(*t, &mut r.samples.iter().zip(columns).map(value))?;
            }
            continue;
        };
        let amplitudes: Vec<Vec<f64>> = (0..r.samples.len())
            .map(|i| r.spectrum(i).lines(band).map(|[_, a]| a).collect())
            .collect();
        for (line, [f_hz, _]) in r.spectrum(0).lines(band).enumerate() {
            row(f_hz, &mut amplitudes.iter().map(|a| number(a[line], 9)))?;
        }
    }
    file.flush()
}
