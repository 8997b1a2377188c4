//! Magnitude, phase and group delay over frequency.

use super::super::curve::Curve;
use super::answer::{Answer, cycle_text, labels, spread};
use crate::args::ResponseArgs;
use crate::chart::plot::Plot;
use crate::chart::scale::{Scale, around};
use crate::chart::view::{Line, Points, View};
use crate::error::Error;
use crate::table::{Cell, Table};
use kontur_filters::response::Angle;
use kontur_filters::time::CycleTime;

const STEPS: u32 = 800;
/// Lower end of the picture in dB.
const FLOOR_DB: f64 = -80.0;
/// Frequencies with a magnitude above this in dB count as passed.
const PASSING_DB: f64 = -12.0;
/// Magnitudes below this in dB count as zeros, whose phase is meaningless.
const ZERO_DB: f64 = -200.0;

#[derive(Clone, Copy, Debug)]
struct Sample {
    f_hz: f64,
    magnitude_db: f64,
    phase_deg: f64,
    delay_ms: f64,
}

pub(super) fn view(
    args: &ResponseArgs,
    curves: &[Curve],
    cycle: CycleTime,
) -> Result<Answer, Error> {
    let nyquist_hz = 0.5 / cycle.seconds();
    let range = args.range.unwrap_or((0.5_f64.min(0.001 * nyquist_hz), nyquist_hz));
    if range.1 > nyquist_hz {
        let text = format!(
            "--range: the maximum frequency is {nyquist_hz} Hz, half the sampling frequency"
        );
        return Err(Error::Usage(text));
    }
    let header = &["curve", "f_hz", "magnitude_db", "phase_deg", "group_delay_ms"];
    let mut table = Table::new(header);
    let mut lines = [Vec::new(), Vec::new(), Vec::new()];
    for (series, curve) in curves.iter().enumerate() {
        let samples = samples(curve, range, cycle);
        for s in &samples {
            table.push(vec![
                Cell::Word(curve.label.clone()),
                Cell::Number(s.f_hz, 6),
                Cell::Number(s.magnitude_db, 6),
                Cell::Number(s.phase_deg, 6),
                Cell::Number(s.delay_ms, 6),
            ]);
        }
        let values = [Sample::magnitude, Sample::phase, Sample::delay];
        for (lines, value) in lines.iter_mut().zip(values) {
            let points = samples.iter().map(|s| [s.f_hz, value(s)]).collect();
            lines.push(Line::series(series, points));
        }
    }
    let plot = Plot {
        title: "Frequency response".to_owned(),
        subtitle: format!("{}; dashed: -3 dB", cycle_text(cycle)),
        legend: labels(curves),
        columns: 1,
        row_height: 270.0,
        panels: panels(range, lines),
    };
    Ok(Answer { table, plot })
}

/// Magnitude, phase and group delay over the frequency.
fn panels(
    range: (f64, f64),
    [magnitude, phase, delay]: [Vec<Line<Points>>; 3],
) -> Vec<View<Points>> {
    let all = |lines: &[Line<Points>]| {
        lines.iter().flat_map(|l| &l.points).map(|p| p[1]).collect::<Vec<_>>()
    };
    let high = all(&magnitude).into_iter().filter(|v| v.is_finite()).fold(0.0, f64::max);
    let low = all(&magnitude).into_iter().filter(|v| v.is_finite()).fold(-3.0, f64::min);
    // close to a zero the group delay is unbounded; the picture shows it for the passed frequencies, and without any of them
    // for the middle nine tenths of the values
    let samples = magnitude.iter().zip(&delay).flat_map(|(m, d)| m.points.iter().zip(&d.points));
    let passing = samples.filter(|(m, _)| m[1] > PASSING_DB).map(|(_, d)| d[1]);
    let mut shown: Vec<f64> = passing.collect();
    if shown.is_empty() {
        shown = all(&delay).into_iter().filter(|v| v.is_finite()).collect();
        shown.sort_by(f64::total_cmp);
        let cut = shown.len() / 20;
        shown = shown[cut..shown.len() - cut].to_vec();
    }
    let shown = around(shown.into_iter().chain([0.0]), 0.1);
    let panel = |title: &str, label: &'static str, range_y, lines, levels| View {
        title: title.to_owned(),
        x: Scale::logarithmic("frequency in Hz", range),
        y: Scale::linear(label, range_y),
        lines,
        levels,
        ..View::default()
    };
    vec![
        panel(
            "Magnitude",
            "magnitude in dB",
            (low.max(FLOOR_DB) - 2.0, high + 3.0),
            magnitude,
            vec![-3.0103],
        ),
        panel("Phase", "phase in deg", around(all(&phase).into_iter(), 10.0), phase, Vec::new()),
        panel("Group delay", "group delay in ms", shown, delay, Vec::new()),
    ]
}
impl Sample {
    fn magnitude(&self) -> f64 {
        self.magnitude_db
    }

    fn phase(&self) -> f64 {
        self.phase_deg
    }

    fn delay(&self) -> f64 {
        self.delay_ms
    }
}

/// The curve with its phase continued beyond 180 degrees; the group delay gives the number of turns between two
/// frequencies.
fn samples(curve: &Curve, range: (f64, f64), cycle: CycleTime) -> Vec<Sample> {
    let mut samples: Vec<Sample> = Vec::new();
    let mut last: Option<Sample> = None;
    for f_hz in spread(range, STEPS) {
        let response = curve.shaping.response(Angle::of(f_hz, cycle));
        let magnitude_db = response.magnitude_db();
        let zero = magnitude_db < ZERO_DB;
        let delay_ms =
            if zero { f64::NAN } else { response.group_delay_cycles() * 1000.0 * cycle.seconds() };
        let principal = response.phase_deg();
        let expected = match last {
            Some(l) => {
                let mean_ms = f64::midpoint(l.delay_ms, delay_ms);
                l.phase_deg - 0.36 * mean_ms * (f_hz - l.f_hz)
            }
            // from 0 Hz up
            None => -0.36 * delay_ms * f_hz,
        };
        let turns = ((expected - principal) / 360.0).round();
        let phase_deg = if zero { f64::NAN } else { principal + 360.0 * turns };
        let sample = Sample { f_hz, magnitude_db, phase_deg, delay_ms };
        if !zero {
            last = Some(sample);
        }
        samples.push(sample);
    }
    anchor(&mut samples);
    samples
}

/// A filter that blocks slow signals has no phase at 0 Hz to start from; turns are added to bring the phase within 180
/// degrees of 0 where most of the signal passes.
fn anchor(samples: &mut [Sample]) {
    /// Ripple of a passband, at most.
    const RIPPLE_DB: f64 = 0.5;
    let Some(first) = samples.first().copied() else { return };
    let most = samples
        .iter()
        .fold(first, |most, s| if s.magnitude_db > most.magnitude_db { *s } else { most });
    if most.magnitude_db > first.magnitude_db + RIPPLE_DB {
        let turns = (most.phase_deg / 360.0).round();
        for sample in samples {
            sample.phase_deg -= 360.0 * turns;
        }
    }
}
