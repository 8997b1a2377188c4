//! One run of a sweep: its row, with the requested amplitudes.

use super::columns;
use super::rows::{Outcome, Row};
use crate::args::{Amplitude, SweepArgs};
use crate::combinations::put;
use crate::interrupt::Running;
use crate::request::{OpenError, Opened, Request};
use crate::spectrum::{AmplitudeSpectrum, MOST_SAMPLES, without_drift};
use kontur_interpreter::job::{Run, Sink};
use kontur_interpreter::record::columns::Column;
use kontur_interpreter::record::{Asked, Rows};
use kontur_interpreter::summary::Collector;
use std::path::PathBuf;

/// Reasons for a missing row.
pub(super) enum Failure {
    Open(OpenError),
    Interrupted,
}

impl Failure {
    const fn usage(text: String) -> Self {
        Self::Open(OpenError::Usage(text))
    }
}

/// Collects the row of one run.
struct Collected<'a> {
    summary: Collector,
    cycle_s: f64,
    wanted: Vec<Wanted<'a>>,
}

/// Smallest number of waves in the recording from which on its drift is removed.
const WAVES: f64 = 2.5;

/// A column with a requested amplitude.
struct Wanted<'a> {
    amplitude: &'a Amplitude,
    column: Column,
    /// Values at some times.
    samples: Vec<f64>,
}

impl Sink for Collected<'_> {
    type Stop = Failure;

    fn reads(&self) -> Option<Asked> {
        let wanted = self.wanted.iter().map(|wanted| wanted.column.content.asked());
        Some(wanted.fold(Collector::asked(), Asked::and))
    }

    fn rows(&mut self, rows: &Rows<'_>) -> Result<(), Failure> {
        self.summary.add(rows);
        for Wanted { amplitude, column, samples } in &mut self.wanted {
            let part = rows.during(|k| amplitude.holds(k as f64 * self.cycle_s));
            if samples.len() + part.len() > MOST_SAMPLES {
                return Err(Failure::usage(format!(
                    "--amplitude {}: more than {MOST_SAMPLES} cycles; use {}@0..10 for a part",
                    amplitude.text, amplitude.text
                )));
            }
            column.content.extend(samples, &part, 1);
        }
        Ok(())
    }

    fn pause(&mut self, run: &mut Run) -> Result<(), Failure> {
        for message in run.take_diagnostics() {
            self.summary.message(&message);
        }
        if Running::is_interrupted() {
            return Err(Failure::Interrupted);
        }
        Ok(())
    }
}

/// Runs one combination; returns its row, and the files that were read.
pub(super) fn row(args: &SweepArgs, combination: &[usize]) -> Result<(Row, Vec<PathBuf>), Failure> {
    let mut request = args.simulation.request(&args.program);
    put(&args.vary, combination, &mut request);
    let outcome = one(args, &request)?;
    let row = columns::row(args, combination, &outcome).map_err(Failure::usage)?;
    Ok((row, outcome.reads))
}

/// One run.
fn one(args: &SweepArgs, request: &Request) -> Result<Outcome, Failure> {
    let Opened { mut run, reads } = request.open().map_err(Failure::Open)?;
    let facts = run.facts();
    let cycle_s = facts.cycle_s();
    let mut wanted = Vec::new();
    for amplitude in &args.amplitude {
        let column = amplitude.column(facts).map_err(Failure::usage)?;
        let highest_hz = 0.5 / cycle_s;
        if amplitude.band_hz.0 >= highest_hz {
            let text = &amplitude.text;
            return Err(Failure::usage(format!(
                "--amplitude {text}: a cycle of {cycle_s} s allows frequencies up to {highest_hz} Hz"
            )));
        }
        wanted.push(Wanted { amplitude, column, samples: Vec::new() });
    }
    let mut collected = Collected { summary: Collector::new(facts), cycle_s, wanted };
    run.to_end(&mut collected)?;
    let Collected { summary, wanted, .. } = collected;
    let amplitudes = wanted.iter().map(|Wanted { amplitude, samples, .. }| {
        let whole =
            amplitude.window_s.is_none_or(|(_, end)| summary.cycles() as f64 * cycle_s > end);
        // a line through fewer waves would follow them
        let waves = amplitude.band_hz.0 * samples.len() as f64 * cycle_s;
        let spectrum = if waves < WAVES {
            AmplitudeSpectrum::of(samples, cycle_s)
        } else {
            AmplitudeSpectrum::of(&without_drift(samples), cycle_s)
        };
        let peak = spectrum.peak(amplitude.band_hz).filter(|_| whole);
        peak.map_or(f64::NAN, |p| p[1])
    });
    let amplitudes = amplitudes.collect();
    Ok(Outcome { summary: summary.finish(&run.totals()), amplitudes, reads: reads.so_far() })
}
