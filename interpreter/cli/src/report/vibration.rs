//! Response of an elastic machine to the set positions: spectrum of the commanded acceleration, and deflection of a
//! mass on a spring.

use super::drawn::Drawn;
use super::shown::{Shown, Source, name, span, style};
use crate::chart::scale::Scale;
use crate::chart::view::{Line, Mark, Points, View, thinned};
use crate::spectrum::AmplitudeSpectrum;
use kontur_filters::analysis::spring::SpringMass;
use kontur_filters::time::CycleTime;
use kontur_filters::vib_guard::VibGuardSettings;

/// Points of a spectrum or a deflection; longer ones are reduced to their extremes.
const MOST_POINTS: usize = 4000;
/// Lowest upper limit of a spectrum in Hz, and the multiple of the highest guard frequency that it covers.
const TOP_HZ: f64 = 100.0;
const TOP_RATIO: f64 = 4.0;
/// Accelerations in mm/s2 (deg/s2) below this are rounding: the page gets three decimals of them.
const LEAST: f64 = 0.0005;
/// The model if there is no guard to take its values from: a machine with low stiffness.
const USUAL: VibGuardSettings = VibGuardSettings { mode: 1, freq_hz: 20.0, damping: 0.02 };

/// The frequency and damping of the model of an axis: those of its first guard, or of any. Several runs are runs of one machine.
pub(super) fn model(runs: &[Drawn], axis: usize) -> VibGuardSettings {
    let all = || runs.iter().flat_map(|r| &r.guards);
    let own = all().find(|(i, _)| *i == axis);
    own.or(all().next()).map_or(USUAL, |(_, settings)| *settings)
}

/// Spectrum and deflection of the axes that move.
pub(super) fn views(runs: &[Drawn]) -> Vec<Shown> {
    let moving: Vec<Moving> = runs
        .iter()
        .enumerate()
        .flat_map(|(run, r)| {
            let all = r.recording.accelerations.iter().enumerate();
            all.filter(|(_, a)| a.iter().any(|a| a.abs() >= LEAST))
                .map(move |(axis, _)| (run, axis))
        })
        .collect();
    if moving.is_empty() {
        return Vec::new();
    }
    let open = runs.iter().any(|r| !r.guards.is_empty());
    let note = part(runs);
    vec![
        Shown { kind: "spectrum", open, note: note.clone(), view: spectra(runs, &moving) },
        Shown { kind: "spring", open, note, view: residuals(runs, &moving) },
    ]
}

/// Number of a run and of an axis in it that moves.
type Moving = (usize, usize);

/// The units of the axes, each once.
fn units(runs: &[Drawn], moving: &[Moving], end: &str) -> String {
    let mut units: Vec<String> = Vec::new();
    for (run, axis) in moving {
        let unit = format!("{}{end}", runs[*run].recording.facts.axes[*axis].unit());
        if !units.contains(&unit) {
            units.push(unit);
        }
    }
    units.join(", ")
}

fn axis_name(runs: &[Drawn], (run, axis): Moving) -> String {
    name(runs, run, &runs[run].recording.facts.axes[axis].name)
}

/// Spectra of the commanded accelerations.
fn spectra(runs: &[Drawn], moving: &[Moving]) -> View<Source> {
    let highest = runs.iter().flat_map(|r| &r.guards).map(|g| g.1.freq_hz).fold(0.0, f64::max);
    let nyquist_hz = |r: &Drawn| 0.5 / r.recording.facts.cycle_s();
    let top_hz =
        runs.iter().map(nyquist_hz).fold(0.0, f64::max).min(TOP_HZ.max(TOP_RATIO * highest));
    let mut peak = 1e-9_f64;
    let mut lines = Vec::new();
    for &(run, axis) in moving {
        let r = &runs[run].recording;
        let spectrum = AmplitudeSpectrum::of(&r.accelerations[axis], r.facts.cycle_s());
        let all: Points = spectrum.lines((0.0, top_hz)).collect();
        let points = thinned(all.into_iter(), MOST_POINTS);
        peak = points.iter().map(|p| p[1]).fold(peak, f64::max);
        lines.push(Line {
            name: axis_name(runs, (run, axis)),
            style: style(runs, run, Some(axis)),
            points: Source::Given { run, axis, points },
        });
    }
    let unit = units(runs, moving, "/s\u{b2}");
    View {
        title: "Spectrum of commanded acceleration".to_owned(),
        x: Scale::linear("frequency in Hz", (0.0, top_hz)),
        y: Scale::linear(format!("amplitude in {unit}"), (0.0, 1.12 * peak)),
        lines,
        marks: guard_marks(runs),
        ..View::default()
    }
}

/// Deflections of vibrations that the axes excite.
fn residuals(runs: &[Drawn], moving: &[Moving]) -> View<Source> {
    let line = |(run, axis): &Moving| Line {
        name: axis_name(runs, (*run, *axis)),
        style: style(runs, *run, Some(*axis)).wide(1.4),
        points: Source::Spring { run: *run, axis: *axis },
    };
    let most = moving.iter().map(|(run, axis)| most_and_left(runs, *run, *axis).0);
    let most = most.fold(1e-9, f64::max);
    let label = format!("deflection in {}", units(runs, moving, ""));
    View {
        title: residual_title(runs, moving.iter().copied()),
        x: Scale::linear("time in s", span(runs)),
        y: Scale::linear(label, (-1.1 * most, 1.1 * most)),
        lines: moving.iter().map(line).collect(),
        ..View::default()
    }
}

/// The frequencies of the guards, each once, with their axes.
fn guard_marks(runs: &[Drawn]) -> Vec<Mark> {
    let mut found: Vec<(f64, Vec<&str>)> = Vec::new();
    for r in runs {
        for (axis, settings) in &r.guards {
            let Some(axis) = r.recording.facts.axes.get(*axis) else { continue };
            match found.iter_mut().find(|(at, _)| at.to_bits() == settings.freq_hz.to_bits()) {
                Some((_, axes)) if axes.contains(&axis.name.as_str()) => {}
                Some((_, axes)) => axes.push(&axis.name),
                None => found.push((settings.freq_hz, vec![&axis.name])),
            }
        }
    }
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    found
        .into_iter()
        .map(|(at, axes)| Mark { at, name: format!("guard {} {at} Hz", axes.join(" ")) })
        .collect()
}

/// The model of a picture, and its residual vibration when the axes are at rest.
fn residual_title(runs: &[Drawn], moving: impl Iterator<Item = (usize, usize)>) -> String {
    let mut said: Vec<String> = Vec::new();
    let mut model_said: Vec<String> = Vec::new();
    for (run, axis) in moving {
        let VibGuardSettings { freq_hz, damping, .. } = model(runs, axis);
        let text = format!("{freq_hz} Hz, damping {damping}");
        if !model_said.contains(&text) {
            model_said.push(text);
        }
        let (_, left) = most_and_left(runs, run, axis);
        let axis = &runs[run].recording.facts.axes[axis];
        said.push(format!("{} {left:.5} {}", axis.name, axis.unit()));
    }
    // with several runs the curves show it
    let left = if runs.len() > 1 {
        String::new()
    } else {
        format!("; left at the end: {}", said.join(", "))
    };
    format!("Mass on a spring of {}{left}", model_said.join(" and "))
}

/// The deflection of the model of an axis over time in s.
pub(super) fn deflection(runs: &[Drawn], run: usize, axis: usize) -> Points {
    let recording = &runs[run].recording;
    let cycle_s = recording.facts.cycle_s();
    let first = recording.buckets.first().map_or(0, |b| b.k);
    let samples = &recording.accelerations[axis];
    let Some(mut spring) = spring(runs, run, axis) else { return Vec::new() };
    let points = samples.iter().zip(first..).map(|(a, k)| [k as f64 * cycle_s, spring.step(*a)]);
    thinned(points.collect::<Points>().into_iter(), MOST_POINTS)
}

/// The largest deflection, and the amplitude after the last acceleration of the axis.
fn most_and_left(runs: &[Drawn], run: usize, axis: usize) -> (f64, f64) {
    let samples = &runs[run].recording.accelerations[axis];
    let Some(mut spring) = spring(runs, run, axis) else { return (0.0, 0.0) };
    let (mut most, mut left): (f64, f64) = (0.0, 0.0);
    for a in samples {
        most = most.max(spring.step(*a).abs());
        if a.abs() >= LEAST {
            left = spring.amplitude();
        }
    }
    (most, left)
}

fn spring(runs: &[Drawn], run: usize, axis: usize) -> Option<SpringMass> {
    let VibGuardSettings { freq_hz, damping, .. } = model(runs, axis);
    SpringMass::new(freq_hz, damping, CycleTime::from_us(runs[run].recording.facts.cycle_us)?)
}

/// The part of the runs that is shown, if it is not the whole.
fn part(runs: &[Drawn]) -> String {
    let kept = runs.iter().map(|r| (r.recording.most_samples, r.recording.cycles()));
    let cut = kept.filter(|(most, cycles)| *cycles > *most as u64).map(|(most, _)| most);
    cut.min().map_or_else(String::new, |most| {
        format!("The first {most} cycles; use --window for another part of the run.")
    })
}
