//! The time on a curve compared with what its limits at every point permit.

use super::contoured_at;
use crate::common::{Job, curvature, line, machine, tangent};
use kontur_kit::{largest, second_order_time};
use kontur_motion::block::SlopeKind::{Hsc, Trapez};
use kontur_motion::block::{Block, ContourMode, ContourSettings, CurveJerk};

const ACC_MM_S2: f64 = 1000.0;
const CYCLE_US: u32 = 100;
/// Intervals per block.
const GRID: u32 = 2000;

/// Least time in s from rest to rest at a feed rate, without a jerk limit: `v^2 |q''| <= a` and `|q'| a_path <= a` for
/// each axis at every point, forwards and backwards over a grid.
fn least_s(blocks: &[Block], feed: f64) -> f64 {
    let (mut steps, mut squares, mut rates) = (Vec::new(), Vec::new(), Vec::new());
    for block in blocks {
        let step = block.path.length() / f64::from(GRID);
        for k in 0..GRID {
            let s = step * (f64::from(k) + 0.5);
            let bend = largest(&curvature(&block.path, s));
            steps.push(step);
            squares.push((ACC_MM_S2 / bend.max(1e-9)).min(feed * feed));
            rates.push(ACC_MM_S2 / largest(&tangent(&block.path, s)));
        }
    }
    let inner = squares.windows(2).map(|pair| f64::min(pair[0], pair[1]));
    let mut limit: Vec<f64> = std::iter::once(0.0).chain(inner).chain([0.0]).collect();
    second_order_time(&mut limit, &rates, &steps)
}

/// Curves that are all of the path, with ramps that hardly matter: nothing but the limits of the curve counts.
#[test]
fn a_curve_is_as_fast_as_each_of_its_points_permits() {
    let ramp = 0.0005;
    let dynamics = machine(2, 1.0, ACC_MM_S2, ramp);
    let mut most = 0.0_f64;
    for kind in [Hsc, Trapez] {
        for degrees in [30.0_f64, 60.0, 90.0, 120.0, 150.0] {
            for size in [0.5, 2.0, 10.0] {
                let job =
                    Job { dynamics: dynamics.clone(), cycle_us: CYCLE_US, ..Job::new(1.0, kind) };
                let (sin, cos) = libm::sincos(degrees.to_radians());
                let paths = [
                    line(&[-2.0 * size, 0.0], &[0.0, 0.0]),
                    line(&[0.0, 0.0], &[2.0 * size * cos, 2.0 * size * sin]),
                ];
                let mode = ContourMode::Dist { pre_mm: size, post_mm: size };
                let settings = ContourSettings {
                    mode,
                    curve_jerk: Some(CurveJerk::Unlimited),
                    ..ContourSettings::default()
                };
                let (blocks, _) = contoured_at(300.0, &job, settings, paths);
                assert!(blocks.len() > 2, "{kind:?} {degrees} {size}: contoured");
                let least = least_s(&blocks, 300.0);
                let out = job.run(&[-2.0 * size, 0.0], blocks.into_iter());
                let time = (out.len() - 1) as f64 * f64::from(CYCLE_US) * 1e-6;
                // rounding to a cycle, and the ramps at both ends and on both sides of the middle
                let ratio = (time - 1e-6 * f64::from(CYCLE_US) - 4.0 * ramp) / least;
                println!("{kind:?} {degrees} deg {size} mm: {ratio:.4}");
                assert!(ratio <= 1.035, "{kind:?} {degrees} deg {size} mm: {ratio}");
                most = most.max(ratio);
            }
        }
    }
    println!("at most {most:.4} of the least time");
}
