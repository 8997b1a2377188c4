//! `tune -o picture.svg`: the recording with what was seen in it.

use super::recording::Recording;
use crate::report::plot::{Diagram, Line, Plot, Scale, around};
use crate::spectrum::AmplitudeSpectrum;
use crate::table::number;

/// Points of a curve; longer ones are thinned out to their extremes.
const MOST_POINTS: usize = 4000;

/// Smallest and largest value of every stretch, so that no swing is lost.
fn thinned(points: impl ExactSizeIterator<Item = [f64; 2]>) -> Vec<[f64; 2]> {
    let stretch = points.len().div_ceil(MOST_POINTS / 2).max(1);
    if stretch == 1 {
        return points.collect();
    }
    let all: Vec<[f64; 2]> = points.collect();
    let extremes = |part: &[[f64; 2]]| {
        let low = part.iter().copied().reduce(|a, b| if b[1] < a[1] { b } else { a });
        let high = part.iter().copied().reduce(|a, b| if b[1] > a[1] { b } else { a });
        let mut pair: Vec<[f64; 2]> = low.into_iter().chain(high).collect();
        pair.sort_by(|a, b| a[0].total_cmp(&b[0]));
        pair
    };
    all.chunks(stretch).flat_map(extremes).collect()
}

/// Every recording over time and its spectrum below, with the fitted decays over both.
pub(super) fn draw(recordings: &[Recording]) -> String {
    let mut panels = Vec::new();
    for recording in recordings {
        panels.push(over_time(recording));
        panels.push(spectrum(recording));
    }
    let found = recordings.iter().flat_map(|r| &r.found.modes);
    let list: Vec<String> = found
        .map(|m| {
            format!(
                "{} +- {} Hz, damping {} +- {}",
                number(m.freq.value, 3),
                number(m.freq.half_width, 3),
                number(m.damping.value, 4),
                number(m.damping.half_width, 4)
            )
        })
        .collect();
    let plot = Plot {
        title: "Recorded vibration and what was seen in it".to_owned(),
        subtitle: list.join("; "),
        legend: vec!["recording".to_owned(), "fit: decays, drift, hum".to_owned()],
        columns: 1,
        row_height: 300.0,
        panels,
    };
    plot.draw()
}

fn over_time(recording: &Recording) -> Diagram {
    let Recording { name, samples, rate_hz, found } = recording;
    let at = |(i, x): (usize, &f64)| [i as f64 / rate_hz, *x];
    let mut lines =
        vec![Line { series: Some(0), points: thinned(samples.iter().enumerate().map(at)) }];
    for decay in &found.decays {
        let at = |(i, x): (usize, &f64)| {
            let middle = 0.5 * (decay.stride as f64 - 1.0);
            [(decay.samples.start as f64 + (i * decay.stride) as f64 + middle) / rate_hz, *x]
        };
        lines.push(Line {
            series: Some(1),
            points: thinned(decay.curve.iter().enumerate().map(at)),
        });
    }
    let end = samples.len() as f64 / rate_hz;
    Diagram {
        title: name.clone(),
        x: Scale::linear("s", (0.0, end)),
        y: Scale::linear("recorded", around(samples.iter().copied(), 1e-9)),
        equal: false,
        lines,
        levels: Vec::new(),
    }
}

fn spectrum(recording: &Recording) -> Diagram {
    let Recording { samples, rate_hz, found, .. } = recording;
    let range = found.decays.first().map_or(0..samples.len(), |d| d.samples.clone());
    let range = range.start..range.end.min(range.start + crate::spectrum::MOST_SAMPLES);
    let highest = found.modes.iter().map(|m| m.freq.value).fold(0.0, f64::max);
    let lasting = found.lasting.iter().map(|l| l.freq_hz).fold(0.0, f64::max);
    let top = (4.0 * highest).max(1.2 * lasting).max(10.0).min(0.5 * rate_hz);
    let of = |x: &[f64], step_s: f64| -> Vec<[f64; 2]> {
        AmplitudeSpectrum::of(x, step_s).lines((0.0, top)).collect()
    };
    let mut lines = vec![Line { series: Some(0), points: of(&samples[range], 1.0 / rate_hz) }];
    if let Some(decay) = found.decays.first() {
        let points = of(&decay.curve, decay.stride as f64 / rate_hz);
        lines.push(Line { series: Some(1), points });
    }
    let heights = lines.iter().flat_map(|l| &l.points).map(|p| p[1]);
    Diagram {
        title: "spectrum of the strongest decay".to_owned(),
        x: Scale::linear("Hz", (0.0, top)),
        y: Scale::linear("amplitude", (0.0, 1.05 * heights.fold(1e-12, f64::max))),
        equal: false,
        lines: lines
            .into_iter()
            .map(|l| Line { points: thinned(l.points.into_iter()), ..l })
            .collect(),
        levels: Vec::new(),
    }
}
