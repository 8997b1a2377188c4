//! `tune -o picture.svg`: the recording with the findings.

use super::recording::{Recording, interval};
use crate::chart::plot::Plot;
use crate::chart::scale::{Scale, around};
use crate::chart::view::{Line, Points, View, thinned};
use crate::spectrum::AmplitudeSpectrum;

/// Largest number of points of a curve; longer ones are reduced to their extremes.
const MOST_POINTS: usize = 4000;

/// Every recording over time and its spectrum below, with the fitted decays over both.
pub(super) fn draw(recordings: &[Recording]) -> String {
    let mut panels = Vec::new();
    for recording in recordings {
        panels.push(over_time(recording));
        panels.push(spectrum(recording));
    }
    let found = recordings.iter().flat_map(|r| &r.found.modes);
    let list: Vec<String> = found
        .map(|m| format!("{} Hz, damping {}", interval(m.freq, 3), interval(m.damping, 4)))
        .collect();
    let plot = Plot {
        title: "Recorded vibration and result of the evaluation".to_owned(),
        subtitle: list.join("; "),
        legend: vec!["recording".to_owned(), "fit: decays, drift, hum".to_owned()],
        columns: 1,
        row_height: 300.0,
        panels,
    };
    plot.draw()
}

fn over_time(recording: &Recording) -> View<Points> {
    let Recording { name, samples, missing, rate_hz, found } = recording;
    let at = |i: usize| [i as f64 / rate_hz, samples[i]];
    let starts = std::iter::once(0).chain(missing.iter().map(|m| m.end));
    let ends = missing.iter().map(|m| m.start).chain(std::iter::once(samples.len()));
    let mut lines: Vec<_> = starts
        .zip(ends)
        .map(|(start, end)| Line::series(0, thinned((start..end).map(at), MOST_POINTS)))
        .collect();
    for decay in &found.decays {
        let at = |(i, x): (usize, &f64)| {
            let middle = 0.5 * (decay.stride as f64 - 1.0);
            [(decay.samples.start as f64 + (i * decay.stride) as f64 + middle) / rate_hz, *x]
        };
        lines.push(Line::series(1, thinned(decay.curve.iter().enumerate().map(at), MOST_POINTS)));
    }
    let end = samples.len() as f64 / rate_hz;
    View {
        title: name.clone(),
        x: Scale::linear("time in s", (0.0, end)),
        y: Scale::linear("recorded value", around(samples.iter().copied(), 1e-9)),
        lines,
        ..View::default()
    }
}

fn spectrum(recording: &Recording) -> View<Points> {
    let Recording { samples, missing, rate_hz, found, .. } = recording;
    let range = found.decays.first().map_or(0..samples.len(), |d| d.samples.clone());
    let highest = found.modes.iter().map(|m| m.freq.value).fold(0.0, f64::max);
    let lasting = found.lasting.iter().map(|l| l.freq_hz).fold(0.0, f64::max);
    let top = (4.0 * highest).max(1.2 * lasting).max(10.0).min(0.5 * rate_hz);
    let of = |x: &[f64], step_s: f64| -> Vec<[f64; 2]> {
        AmplitudeSpectrum::of(x, step_s).lines((0.0, top)).collect()
    };
    let is_bridged = missing.iter().any(|m| m.start < range.end && m.end > range.start);
    let bridged = if is_bridged { ", missing samples interpolated linearly" } else { "" };
    let mut lines = vec![Line::series(0, of(&samples[range], 1.0 / rate_hz))];
    if let Some(decay) = found.decays.first() {
        let points = of(&decay.curve, decay.stride as f64 / rate_hz);
        lines.push(Line::series(1, points));
    }
    let heights = lines.iter().flat_map(|l| &l.points).map(|p| p[1]);
    View {
        title: format!("spectrum of the strongest decay{bridged}"),
        x: Scale::linear("frequency in Hz", (0.0, top)),
        y: Scale::linear(
            "amplitude of the recorded value",
            (0.0, 1.05 * heights.fold(1e-12, f64::max)),
        ),
        lines: lines
            .into_iter()
            .map(|l| Line { points: thinned(l.points.into_iter(), MOST_POINTS), ..l })
            .collect(),
        ..View::default()
    }
}
