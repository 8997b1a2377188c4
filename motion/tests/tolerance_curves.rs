//! `AX_DEV` on one curve whose curvature grows along it: the speed permitted at the sharpest place does not limit the
//! whole curve.

use crate::common::{Job, deviation, filtered};
use kontur_filters::time::CycleTime;
use kontur_filters::vib_guard::VibGuardSettings;
use kontur_motion::axis::AxisVec;
use kontur_motion::block::SlopeKind::{Hsc, Sin2, Trapez};
use kontur_motion::block::Tolerance;
use kontur_motion::path::{Path, PolyPath};

const TOLERANCE_MM: f64 = 0.01;
/// `x = WIDTH u`, `y = HEIGHT u^5`.
const WIDTH: f64 = 40.0;
const HEIGHT: f64 = 20.0;
const PIECES: u32 = 8;

/// The curve in pieces.
fn curve() -> PolyPath {
    let [start, end] = [[0.0, 0.0], [WIDTH, HEIGHT]].map(|p| AxisVec::from_slice(&p));
    let share = 1.0 / f64::from(PIECES);
    let piece = |i: u32| {
        let from = share * f64::from(i);
        // (from + share t)^5 by powers of t
        let binomials = [1.0, 5.0, 10.0, 10.0, 5.0, 1.0];
        let power =
            |k: usize| binomials[k] * libm::pow(from, 5.0 - k as f64) * libm::pow(share, k as f64);
        let x = [WIDTH * from, WIDTH * share, 0.0, 0.0, 0.0, 0.0];
        let y = [0, 1, 2, 3, 4, 5].map(|k| HEIGHT * power(k));
        [x, y].into_iter().collect()
    };
    PolyPath::new(start, end, (0..PIECES).map(piece).collect(), &[]).unwrap()
}

/// Largest `|q''|` of an axis in 1/mm and the length in mm, from a fine polygon.
fn bend_and_length() -> (f64, f64) {
    let n = 200_000;
    let (mut bend, mut length) = (0.0_f64, 0.0);
    for i in 0..n {
        let u = (f64::from(i) + 0.5) / f64::from(n);
        let (dy, ddy) = (5.0 * HEIGHT * libm::pow(u, 4.0), 20.0 * HEIGHT * libm::pow(u, 3.0));
        let rate = libm::hypot(WIDTH, dy);
        // for a plane curve: the curvature times the normal
        let curvature = WIDTH * ddy / libm::pow(rate, 3.0);
        bend = bend.max(curvature * (WIDTH / rate).max(dy / rate));
        length += rate / f64::from(n);
    }
    (bend, length)
}

/// At the even speed that the sharpest place permits (`v^2 bend / 2` times the variance of the kernel), the curve would
/// take much longer than it does.
#[test]
fn only_the_sharp_part_of_a_curve_is_slow() {
    let cycle = CycleTime::from_us(1000).unwrap();
    let kernel = VibGuardSettings { mode: 2, freq_hz: 12.0, damping: 0.1 }.kernel(cycle).unwrap();
    let mean = kernel.delay_cycles();
    let variance: f64 = kernel
        .taps()
        .iter()
        .map(|t| t.weight * (f64::from(t.delay) - mean) * (f64::from(t.delay) - mean))
        .sum::<f64>()
        * cycle.seconds()
        * cycle.seconds();
    let (bend, length) = bend_and_length();
    let allowed = (2.0 * TOLERANCE_MM / (bend * variance)).sqrt();
    let polygon: Vec<[f64; 2]> = (0..=1000)
        .map(|i| f64::from(i) / 1000.0)
        .map(|u| [WIDTH * u, HEIGHT * libm::pow(u, 5.0)])
        .collect();
    for kind in [Hsc, Trapez, Sin2] {
        let mut job = Job::new(1.0, kind);
        job.tolerance = Tolerance { ax_dev_mm: Some(TOLERANCE_MM), acc_fact: 1.0 };
        job.kernels = vec![kernel.clone()];
        let block = job.block(0, Path::Curve(Box::new(curve())), 200.0);
        let out = job.run(&[0.0, 0.0], std::iter::once(block));
        let seconds = cycle.time_of(out.len() as u64 - 1);
        let whole = length / allowed;
        assert!(seconds < 0.9 * whole, "{kind:?}: {seconds} s, at one speed {whole} s");
        for (k, point) in filtered(&out, &job.kernels).iter().enumerate() {
            let dev = deviation(point, &polygon);
            assert!(dev <= TOLERANCE_MM + 2e-5, "{kind:?}: {dev} mm in cycle {k}");
        }
    }
}
