//! One segment of an Akima spline: the cubic between two points, and whether it has a cusp.

use crate::exec::contour::motion::{Driven, Motion};
use crate::exec::fault::{Fault, Outcome};
use kontur_motion::axis::AxisVec;
use kontur_motion::path::{Coefficients, Path, PolyPath, PolyPiece};

/// Smallest speed of the parameter, relative to a straight line. Below it the curve has a cusp sharper than the positions of a
/// trace can show.
const CUSP: f64 = 1e-5;

/// Samples of a segment for the search for a cusp.
const SAMPLES: u32 = 64;
/// Ternary search steps around the slowest sample, down to the resolution of the parameter.
const THIRDS: u32 = 80;

/// A complete segment.
#[derive(Debug)]
pub(in crate::exec::contour) struct Curve {
    motion: Box<Motion>,
    /// Lowest and highest position of each axis.
    extents_mm: Vec<(f64, f64)>,
}

impl Curve {
    /// Range for the check against the software limits, and the motion.
    pub(in crate::exec::contour) fn parts(self) -> (Driven, Box<Motion>) {
        let Self { motion, extents_mm } = self;
        (Driven { extents_mm, source: motion.source, span: motion.span }, motion)
    }
}

/// Length and slope of the chord of a motion.
pub(super) fn chord(motion: &Motion) -> (f64, AxisVec) {
    let path = &motion.block.path;
    let way: AxisVec =
        path.start().iter().zip(path.end().iter()).map(|(from, to)| to - from).collect();
    let feed = &motion.block.dynamics.feed_axes;
    let of = |counts: &dyn Fn(usize) -> bool| {
        let ways = way.iter().enumerate().filter(|(i, _)| counts(*i));
        ways.map(|(_, w)| w * w).sum::<f64>().sqrt()
    };
    let over_feed = of(&|i| feed.get(i).copied().unwrap_or(true));
    let length = if over_feed > 0.0 { over_feed } else { of(&|_| true) };
    let slope = way.iter().map(|w| w / length).collect();
    (length, slope)
}

/// The motion on the cubic between its ends with these derivatives.
pub(super) fn curved(mut motion: Box<Motion>, from: &[f64], to: &[f64]) -> Outcome<Curve> {
    let (length, _) = chord(&motion);
    let path = &motion.block.path;
    let (start, end) = (path.start().clone(), path.end().clone());
    let piece: PolyPiece = (0..start.len())
        .map(|i| {
            let (way, a, b) = (end[i] - start[i], length * from[i], length * to[i]);
            [start[i], a, 3.0 * way - 2.0 * a - b, a + b - 2.0 * way, 0.0, 0.0]
        })
        .collect();
    let feed = &motion.block.dynamics.feed_axes;
    let moves = |i: usize| feed.get(i).copied().unwrap_or(true);
    let measured = (0..start.len()).any(|i| moves(i) && start[i].to_bits() != end[i].to_bits());
    let norm = |part: &dyn Fn(&Coefficients) -> f64| {
        let axes = piece.iter().enumerate().filter(|(i, _)| !measured || moves(*i));
        axes.map(|(_, c)| part(c) * part(c)).sum::<f64>().sqrt()
    };
    let pace = |x: f64| norm(&|c| c[1] + x * (2.0 * c[2] + x * 3.0 * c[3]));
    // the second derivative is largest at one end
    let slope = norm(&|c| (2.0 * c[2]).abs().max((2.0 * c[2] + 6.0 * c[3]).abs()));
    let cusp = || Fault::unsupported("a spline with a cusp", motion.span).in_block(motion.source);
    if falls_below(pace, CUSP * length, slope) {
        return Err(cusp());
    }
    let path = PolyPath::new(start, end, vec![piece], feed).ok_or_else(cusp)?;
    let extents_mm = (0..path.start().len()).map(|axis| path.extent(axis)).collect();
    motion.block.path = Path::Curve(Box::new(path));
    (motion.block.contour, motion.block.spline) = (None, None);
    Ok(Curve { motion, extents_mm })
}

/// Whether a function falls below a limit between 0 and 1, if its slope is at most `slope`. A cusp is narrow and lies between
/// samples. The search is restricted to samples from which the limit can be reached, in the valley of the lowest one.
fn falls_below(f: impl Fn(f64) -> f64, limit: f64, slope: f64) -> bool {
    let at = |k: u32| f64::from(k) / f64::from(SAMPLES);
    let values: Vec<f64> = (0..=SAMPLES).map(|k| f(at(k))).collect();
    let near = limit + slope / f64::from(SAMPLES);
    let valley = |k: u32| {
        let here = values[k as usize];
        let around = [k.checked_sub(1), Some(k + 1)].into_iter().flatten();
        here <= near && around.filter_map(|n| values.get(n as usize)).all(|value| here <= *value)
    };
    let lowest = |k: u32| {
        let (mut low, mut high) = (at(k.saturating_sub(1)), at((k + 1).min(SAMPLES)));
        for _ in 0..THIRDS {
            let third = (high - low) / 3.0;
            if f(low + third) <= f(high - third) { high -= third } else { low += third }
        }
        f(0.5 * (low + high)).min(values[k as usize])
    };
    (0..=SAMPLES).filter(|k| valley(*k)).any(|k| lowest(k) < limit)
}

#[cfg(test)]
mod tests {
    use super::falls_below;
    use proptest::prelude::*;

    proptest! {
        /// Dips of known depth at any place, wide or far narrower than the sample spacing, are found, and shallower ones are
        /// not.
        #[test]
        fn a_dip_is_found_wherever_it_lies(
            at in 0.0..=1.0_f64, slope in 0.01..10.0_f64, depth in -9.0..-1.0_f64
        ) {
            let depth = libm::pow(10.0, depth);
            let f = |x: f64| libm::hypot(slope * (x - at), depth);
            prop_assert!(falls_below(f, depth * 1.01 + 1e-12, slope));
            prop_assert!(!falls_below(f, depth * 0.99, slope));
        }
    }
}
