//! `AX_DEV`: the filtered setpoints leave the contour at most by the tolerance, without wasting time.
//!
//! The deviation is measured independently, from setpoints, kernel taps and the corners of the program.

use crate::common::{self, Job, deviation, filtered, points};
use crate::promise::of_run;
use kontur_filters::fir::{FirConfig, FirKind};
use kontur_filters::time::CycleTime;
use kontur_motion::block::SlopeKind::{Hsc, Sin2, Step, Trapez};
use kontur_motion::block::Tolerance;
use kontur_motion::deviation::{Meter, Unkept};
use kontur_motion::planner::{Next, Planner};

const SQUARE: &str = "0 0; 1 0; 1 1; 0 1; 0 0";

/// Largest deviation of a run from the contour, in either direction, and the number of cycles.
fn worst(job: &Job, points: &[Vec<f64>], feed: f64) -> (f64, usize) {
    let out = job.drive(points, &[feed]);
    let [leaves, misses] = of_run(job, points, &out);
    (leaves.0.max(misses.0), out.len() - 1)
}

#[test]
fn square_keeps_the_tolerance_in_every_mode() {
    for mode in 1..=4 {
        for freq in [20.0, 40.0, 80.0] {
            for cycle_us in [500, 1000, 2000] {
                for kind in [Trapez, Sin2, Hsc, Step] {
                    let job = Job { cycle_us, ..Job::new(1.0, kind) };
                    let job = job.guarded(mode, freq, 0.1, Some(0.01));
                    let (dev, cycles) = worst(&job, &points(SQUARE), F4000);
                    println!(
                        "mode {mode} {freq} Hz {cycle_us} us {kind:?}: {dev:.7} {}",
                        cycles as f64 * f64::from(cycle_us) * 1e-6
                    );
                    assert!(dev <= 0.01, "mode {mode} {freq} Hz {cycle_us} us {kind:?}: {dev}");
                }
            }
        }
    }
}

/// The square and ten typical programs: flat and sharp corners, short blocks, three axes, reversals.
const PROGRAMS: &str = "square: 0 0; 1 0; 1 1; 0 1; 0 0
right angle: 0 0; 4 0; 4 4
flat corners: 0 0; 3 0; 6 0.4; 9 1.6; 12 3.6
sharp corners: 0 0; 5 0; 1 1; 6 2; 2 3
there and back: 0 0; 3 1; 0 0; -2 1; 0 0
stairs: 0 0; 1.2 0; 1.2 1.2; 2.4 1.2; 2.4 2.4; 3.6 2.4; 3.6 3.6
in space: 0 0 0; 3 0 1; 3 2 0; 0 3 2; 1 0 0
star: 0 3; 1.763 -2.427; -2.853 0.927; 2.853 0.927; -1.763 -2.427; 0 3
octagon: 2 0; 1.414 1.414; 0 2; -1.414 1.414; -2 0; -1.414 -1.414; 0 -2; 1.414 -1.414; 2 0
long and short: 0 0; 8 0; 8 0.5; 0 0.5; 0 1; 8 1
zigzag: 0 0; 1.5 0.8; 3 1.6; 4.5 0; 6 0.8; 7.5 1.6; 9 0; 10.5 0.8; 12 1.6";

fn contours() -> impl Iterator<Item = (&'static str, Vec<Vec<f64>>)> {
    PROGRAMS.lines().map(|line| line.split_once(": ").unwrap()).map(|(name, at)| (name, points(at)))
}

const F4000: f64 = 4000.0 / 60.0;

/// A machine with sufficient acceleration for the corners: 3000 mm/s2.
pub(crate) fn machine(axes: usize, ramp_s: f64) -> Job {
    let dynamics = common::machine(axes, 1.0, 3000.0, ramp_s);
    Job { dynamics, ..Job::new(1.0, Trapez) }
}

/// Smallest number of cycles with the same speed at all corners that keeps the tolerance, by brute force; up to the
/// speed at which a single right angle exceeds it three times.
fn best_uniform(job: &Job, points: &[Vec<f64>], feed: f64, tol: f64) -> Option<usize> {
    const SPEEDS: u32 = 90;
    let kernel = &job.kernels[0];
    let m1_s = kernel.m1_cycles() * f64::from(job.cycle_us) * 1e-6;
    let drive = |v: f64| {
        let blocks: Vec<_> = points
            .windows(2)
            .enumerate()
            .map(|(i, w)| {
                let mut block = job.line(i as u64, &w[0], &w[1], feed);
                block.end_velocity_mm_s = Some(v);
                block.tolerance = Tolerance::default();
                block
            })
            .collect();
        let out = job.run(&points[0], blocks.into_iter());
        let keeps = filtered(&out, &job.kernels).iter().all(|p| deviation(p, points) <= tol);
        keeps.then_some(out.len() - 1)
    };
    let step = 3.0 * tol / m1_s / f64::from(SPEEDS);
    (0..=SPEEDS).filter_map(|i| drive(step * f64::from(i))).min()
}

/// The square and the ten programs take at most 5 % longer than with the best uniform corner speed.
#[test]
fn no_slower_than_the_best_uniform_corner_speed() {
    let mut compared = 0;
    for (name, points) in contours() {
        for (mode, freq, tol, ramp_s) in [
            (1, 40.0, 0.01, 0.02),
            (2, 60.0, 0.01, 0.05),
            (3, 80.0, 0.01, 0.02),
            (4, 30.0, 0.05, 0.05),
        ] {
            let job = machine(points[0].len(), ramp_s).guarded(mode, freq, 0.1, Some(tol));
            let (dev, cycles) = worst(&job, &points, F4000);
            assert!(dev <= tol, "{name}: {dev}");
            let best = best_uniform(&job, &points, F4000, tol);
            println!("{name} mode {mode} {freq} Hz: {cycles} cycles, uniform {best:?}");
            if let Some(best) = best {
                compared += 1;
                assert!(cycles as f64 <= 1.05 * best as f64, "{name}: {cycles} against {best}");
            }
        }
    }
    assert!(compared >= 33, "{compared} of 44 can be kept with a uniform speed");
}

/// A tolerance just above the deviation of a program without one does not change a bit of the result.
#[test]
fn a_tolerance_that_is_kept_anyway_changes_nothing() {
    for (name, points) in contours() {
        for (mode, freq) in [(1, 40.0), (2, 60.0), (3, 20.0), (4, 30.0)] {
            let drive = |ax_dev| {
                let job = machine(points[0].len(), 0.03).guarded(mode, freq, 0.1, ax_dev);
                let out = job.drive(&points, &[F4000]);
                let bits: Vec<[u64; 4]> = out
                    .iter()
                    .map(|s| [s.s_mm, s.v_mm_s, s.a_mm_s2, s.j_mm_s3].map(f64::to_bits))
                    .collect();
                let places: Vec<Vec<u64>> =
                    out.iter().map(|s| s.position.iter().map(|x| x.to_bits()).collect()).collect();
                (bits, places)
            };
            let job = machine(points[0].len(), 0.03).guarded(mode, freq, 0.1, None);
            let free = worst(&job, &points, F4000).0;
            assert!(free > 1e-3, "{name}: {free}");
            let plain = drive(None);
            // 6 % more, because any candidate for the shortest vector counts
            assert_eq!(drive(Some(1.06 * free)), plain, "{name} mode {mode} {freq} Hz");
            assert_ne!(drive(Some(0.9 * free)), plain, "{name} mode {mode} {freq} Hz");
        }
    }
}

/// A windowed sinc overshoots at every start and stop, on a straight line as well, and more where the path turns back.
#[test]
fn negative_weights_keep_the_tolerance_too() {
    let cycle = CycleTime::from_us(2000).unwrap();
    for contour in ["0 0; 5 1", "0 0; 10 0; -3 0; -3 0.015", SQUARE] {
        let points = points(contour);
        for (order, fcut_hz) in [(40, 100.0), (73, 13.6), (148, 32.3)] {
            for tol in [0.0014, 0.01] {
                let fir = FirConfig { order, fcut_hz, ..FirConfig::new(FirKind::WindowedSinc) };
                let mut job = machine(2, 0.01);
                job.cycle_us = 2000;
                job.kernels = vec![fir.design(cycle).0.unwrap()];
                let (free, _) = worst(&job, &points, F4000);
                job.tolerance = Tolerance { ax_dev_mm: Some(tol), acc_fact: 1.0 };
                let (dev, cycles) = worst(&job, &points, F4000);
                println!("{contour} order {order} {fcut_hz} Hz: free {free}, kept {dev}, {cycles}");
                assert!(dev <= tol, "{contour} order {order} {fcut_hz} Hz: {dev} > {tol}");
            }
        }
    }
}

/// The report for set points that are displaced, on a contour of straight lines with a tolerance of 0.01 mm.
fn told_of_output(points: &[[f64; 2]], moved: impl Fn([f64; 2]) -> [f64; 2]) -> Vec<Unkept> {
    let job = Job::new(1.0, Trapez).guarded(1, 40.0, 0.1, Some(0.01));
    let cycle = CycleTime::from_us(job.cycle_us).unwrap();
    let mut planner = Planner::new(cycle, job.window, &[0.0; 2]);
    planner.set_kernels(job.kernels(2), 0);
    for (seq, ends) in (7..).zip(points.windows(2)) {
        planner.push(job.line(seq, &ends[0], &ends[1], 50.0));
    }
    planner.finish();
    let (mut meter, mut told) = (Meter::default(), Vec::new());
    while planner.advance().unwrap() == Next::Setpoint {
        planner.take_changes().for_each(|change| meter.take(change));
        let at = planner.setpoint();
        let set = moved([at.position[0], at.position[1]]);
        meter.filtered(at.k, &set, &at.position, &mut [0.0; 2]);
        told.extend(meter.take_exceeded());
    }
    meter.end();
    told.extend(meter.take_exceeded());
    assert!(planner.take_unkept().is_empty());
    told
}

/// The output is judged by the actual result of the filters: set points beside a straight line.
#[test]
fn an_excess_that_the_plan_does_not_see_is_told_once() {
    let aside = |mm: f64| told_of_output(&[[0.0; 2], [20.0, 0.0]], |p| [p[0], mm]);
    assert_eq!(aside(0.0099), []);
    let told = aside(0.0125);
    let [excess] = told[..] else { panic!("{told:?}") };
    assert_eq!((excess.seq, excess.tolerance_mm), (7, 0.01));
    assert!((excess.deviation_mm - 0.0125).abs() < 1e-12, "{excess:?}");
}

/// Set points that turn back before the tip of a needle are always on the contour: only the tip is missed.
#[test]
fn a_corner_that_the_output_never_reaches_is_told() {
    let back = |x: f64| told_of_output(&[[0.0; 2], [10.0, 0.0], [0.0; 2]], |p| [p[0].min(x), p[1]]);
    assert_eq!(back(9.9901), []);
    let told = back(9.97);
    let [excess] = told[..] else { panic!("{told:?}") };
    kontur_kit::near(excess.tolerance_mm, 0.01, 0.0);
    kontur_kit::near(excess.deviation_mm, 0.03, 1e-12);
}
