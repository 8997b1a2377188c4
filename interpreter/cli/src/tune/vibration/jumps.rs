//! Jumps of the level of a recording: a sensor that was set to zero, an amplifier that changed its range, a load that
//! was put down. Nothing vibrates at a jump, but its edge contains all frequencies, and the drift of the whole
//! recording does not remove it. The parts on both sides are evaluated one by one, each with its own level.

use std::f64::consts::TAU;
use std::ops::Range;

/// Numbers of samples on either side over which the edge of a jump is averaged: steep ones beside a vibration, small
/// ones in noise.
const WIDTHS: [usize; 4] = [1, 2, 4, 8];
/// Distance on either side, as a multiple of the width, within which no other edge is nearly as high.
const BESIDE: usize = 10;
/// Height of a jump as a multiple of the other edges beside it.
const HEIGHT: f64 = 2.5;
/// Time in s on either side over which the level is taken.
const LEVEL_S: f64 = 0.5;
/// Number of samples that a level needs.
const LEAST_SAMPLES: usize = 32;
/// Height in steps of the recorder from which on an edge is more than its rounding.
const LEAST_STEPS: f64 = 2.5;
/// Difference between the height of an edge and that of the levels, as a share, by which it still is a jump. At a blow
/// the levels are equal.
const SAME: f64 = 0.3;

/// An edge of a recording.
#[derive(Clone, Copy, Debug)]
struct Edge {
    /// First sample on the new level.
    at: usize,
    /// Samples on either side that may belong to the edge.
    width: usize,
    height: f64,
}

/// The parts of a recording between the jumps of its level; the edges belong to none of them. The recorder resolves
/// `step`.
pub(super) fn between(samples: &[f64], rate_hz: f64, step: f64) -> Vec<Range<usize>> {
    let mut edges: Vec<Edge> =
        WIDTHS.iter().flat_map(|width| edges(samples, rate_hz, *width)).collect();
    edges.retain(|edge| edge.height.abs() > LEAST_STEPS * step);
    edges.sort_by(|a, b| b.height.abs().total_cmp(&a.height.abs()));
    let mut jumps: Vec<Edge> = Vec::new();
    for edge in edges {
        let near = BESIDE * WIDTHS[WIDTHS.len() - 1];
        if jumps.iter().all(|jump| jump.at.abs_diff(edge.at) > near) {
            jumps.push(edge);
        }
    }
    jumps.sort_by_key(|jump| jump.at);
    let starts = std::iter::once(0).chain(jumps.iter().map(|j| j.at + j.width - 1));
    let ends = jumps.iter().map(|j| j.at + 1 - j.width).chain([samples.len()]);
    starts.zip(ends).filter(|(start, end)| start < end).map(|(start, end)| start..end).collect()
}

/// The edges of one width that are jumps.
fn edges(samples: &[f64], rate_hz: f64, width: usize) -> Vec<Edge> {
    let n = samples.len();
    if n < 2 * width {
        return Vec::new();
    }
    let mut sums = vec![0.0; n + 1];
    for (i, x) in samples.iter().enumerate() {
        sums[i + 1] = sums[i] + (x - samples[0]);
    }
    // mean of the next samples above that of the ones before; 0 where there are too few
    let inside = width..=n - width;
    let height = |i: usize| {
        let step = sums[i + width] - 2.0 * sums[i] + sums[i - width];
        step / width as f64
    };
    let heights: Vec<f64> =
        (0..=n).map(|i| if inside.contains(&i) { height(i) } else { 0.0 }).collect();
    let highest = |range: Range<usize>| heights[range].iter().fold(0.0, |a: f64, h| a.max(h.abs()));
    let far = BESIDE * width;
    let window = (LEVEL_S * rate_hz) as usize;
    let drift = drift(samples, window);
    let is_jump = |at: &usize| {
        let h = heights[*at];
        let beside = || {
            let before = highest(at.saturating_sub(far)..(at + 1).saturating_sub(width));
            before.max(highest((at + width).min(n)..(at + far).min(n) + 1))
        };
        if h.abs() <= HEIGHT * beside() {
            return false;
        }
        let before = level(&samples[(at + 1 - width).saturating_sub(window)..at + 1 - width]);
        let after = level(&samples[at + width - 1..(at + width - 1 + window).min(n)]);
        let (Some((before, from)), Some((after, to))) = (before, after) else { return false };
        let apart = (2 * width - 2) as f64 + 0.5 * (from + to);
        (after - before - drift * apart - h).abs() < SAME * h.abs()
    };
    let with_edges_beside = 2 * width..(n + 1).saturating_sub(2 * width);
    with_edges_beside.filter(is_jump).map(|at| Edge { at, width, height: heights[at] }).collect()
}

/// Drift per sample: the median of the differences over a window, which a jump does not change.
fn drift(samples: &[f64], window: usize) -> f64 {
    let mut steps: Vec<f64> =
        samples.iter().zip(samples.iter().skip(window)).map(|(a, b)| b - a).collect();
    if window == 0 || steps.is_empty() {
        return 0.0;
    }
    let middle = steps.len() / 2;
    *steps.select_nth_unstable_by(middle, f64::total_cmp).1 / window as f64
}

/// The level of enough samples, and their number: their mean under a Hann window, in which vibrations vanish.
fn level(samples: &[f64]) -> Option<(f64, f64)> {
    let n = samples.len() as f64;
    let weight = |i: usize| 1.0 - libm::cos(TAU * (i as f64 + 0.5) / n);
    let sum = || samples.iter().enumerate().map(|(i, x)| weight(i) * x).sum::<f64>();
    (samples.len() >= LEAST_SAMPLES).then(|| (sum() / n, n))
}
