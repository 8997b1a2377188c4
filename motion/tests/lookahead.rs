//! Look-ahead against worked numbers (TF5200 limits, closed forms of the slopes; computed independently).

use crate::common::{Job, axis, channel, even, machine};
use kontur_kit::{Random, count};
use kontur_motion::axis::AxisDynamics;
use kontur_motion::block::SlopeKind::{Hsc, Sin2, Step, Trapez};
use kontur_motion::cap::SpeedLimit;
use kontur_motion::planner::Setpoint;

const SQUARE: [&[f64]; 5] = [&[0.0, 0.0], &[1.0, 0.0], &[1.0, 1.0], &[0.0, 1.0], &[0.0, 0.0]];

/// Square of 1 mm at F4000: cycles from rest to rest and speed at the corners.
#[test]
fn square_takes_the_documented_number_of_cycles() {
    for (kind, cycle_us, weight, cycles) in [
        (Trapez, 1000, 0.0, 468),
        (Sin2, 1000, 0.0, 468),
        (Trapez, 1000, 0.1, 467),
        (Trapez, 1000, 1.0, 455),
        (Sin2, 1000, 1.0, 455),
        (Step, 1000, 0.0, 248),
        (Trapez, 2000, 0.0, 234),
        (Trapez, 2000, 1.0, 221),
        (Step, 2000, 1.0, 121),
    ] {
        let job = Job { cycle_us, ..Job::new(weight, kind) };
        let out = job.drive(&SQUARE, &[4000.0 / 60.0]);
        assert_eq!(out.len() - 1, cycles, "{kind:?} {cycle_us} us, weight {weight}");
        assert_eq!(out.last().unwrap().position[..], [0.0, 0.0]);
    }
}

fn collinear(lengths: &[f64]) -> Vec<[f64; 2]> {
    let mut x = 0.0;
    let mut points = vec![[0.0, 0.0]];
    for l in lengths {
        x += l;
        points.push([x, 0.0]);
    }
    points
}

fn cycles(job: &Job, lengths: &[f64], feeds: &[f64]) -> usize {
    let points = collinear(lengths);
    job.drive(&points, feeds).len() - 1
}

/// Five collinear blocks with a slow one in the middle: 0.414 s (STEP), 0.556692341 s (TRAPEZ).
#[test]
fn slow_block_between_fast_ones() {
    let (lengths, feeds) = ([10.0, 0.5, 0.5, 2.0, 10.0], [100.0, 100.0, 20.0, 100.0, 100.0]);
    assert_eq!(cycles(&Job::new(0.0, Step), &lengths, &feeds), 414);
    let job = Job { cycle_us: 100, ..Job::new(0.0, Trapez) };
    // blocks of equal feed are joined: 10 + 0.5 mm before, 2 + 10 mm after the slow block, so it is not slower than
    // the 0.556692341 s of separate blocks
    assert!(cycles(&job, &lengths, &feeds) <= 5567);
}

/// Twenty blocks of 0.5 mm at F6000 are one span: 0.256155281 s instead of 0.458220217 s.
#[test]
fn collinear_blocks_are_one_span() {
    let job = Job { cycle_us: 100, ..Job::new(0.0, Trapez) };
    assert_eq!(cycles(&job, &[0.5; 20], &[100.0]), 2562);
    assert_eq!(cycles(&Job::new(0.0, Step), &[0.5; 20], &[100.0]), 200);
}

/// The T3 and N3 profiles on the time grid: 116.960710 ms are 117 cycles.
#[test]
fn samples_of_a_short_block() {
    for (kind, at30) in [(Trapez, 0.089997076), (Sin2, 0.081004566)] {
        let out = Job::new(0.0, kind).drive(&[&[0.0, 0.0], &[1.0, 0.0]], &[4000.0 / 60.0]);
        assert_eq!(out.len() - 1, 117);
        assert!((out[30].position[0] - at30).abs() < 1e-8, "{kind:?}: {}", out[30].position[0]);
    }
}

/// Points on a circle, each turned by an angle in rad.
fn arc_points(radius: f64, turn: f64, count: u32) -> Vec<[f64; 2]> {
    let at = |i| libm::sincos(f64::from(i) * turn);
    (0..count).map(at).map(|(sin, cos)| [radius * cos, radius * sin]).collect()
}

/// Polygons of a circle: whatever the window ends with, the path continues after it without a rest.
#[test]
fn a_smooth_contour_never_rests() {
    for (radius, chord) in [(1.0, 0.02), (5.0, 0.1 / 3.0), (5.0, 0.1), (20.0, 0.05)] {
        let points = arc_points(radius, chord / radius, 700);
        for (kind, window, feed) in [
            (Hsc, 120, 200.0),
            (Hsc, 120, 80.0),
            (Hsc, 30, 200.0),
            (Trapez, 120, 200.0),
            (Trapez, 10, 50.0),
            (Sin2, 120, 200.0),
        ] {
            let dynamics = machine(2, 1.0, 3500.0, 0.03);
            let out = Job { dynamics, window, ..Job::new(1.0, kind) }.drive(&points, &[feed]);
            let rest = out[1..out.len() - 1].iter().find(|p| p.v_mm_s <= 0.0);
            assert!(rest.is_none(), "r {radius} {chord} {kind:?} {window} F{feed}: {rest:?}");
        }
    }
}

/// A corner between lines of short blocks: the rise after the corner is planned in one window and continues in the
/// next. A hundred times the look-ahead is not faster, so the look-ahead is not a limit, and no setpoint of a rise
/// states it as the reason.
#[test]
fn a_rise_that_goes_on_in_the_next_window_keeps_its_reason() {
    let mut points: Vec<[f64; 2]> = (0..=60).map(|i| [0.0, 0.2 * f64::from(i)]).collect();
    points.extend((1..=120).map(|i| [0.2 * f64::from(i), 12.0]));
    for kind in [Trapez, Hsc] {
        for window in 10..40 {
            let [short, long] = [window, 100 * window].map(|window| {
                let job = Job { window, ..Job::new(1.0, kind) };
                job.drive(&points, &[20.0])
            });
            assert_eq!(short.len(), long.len(), "{kind:?} {window}");
            for (near, far) in short.iter().zip(&long) {
                let rises = near.a_mm_s2 > 1e-6;
                assert!(!rises || near.limit == far.limit, "{kind:?} {window}: {near:?} {far:?}");
            }
        }
    }
}

/// P-CHAN-00349 = 1 is a mode of TRAPEZ and SIN2: a move of 1 mm with ramps of 50 ms takes 0.2 s there and 0.116960710
/// s at constant jerk (T3c and T3 of the worked examples); HSC and G00 ignore it.
#[test]
fn constant_ramp_times_belong_to_trapez_and_sin2() {
    for (kind, cycles) in [(Trapez, 200), (Sin2, 200), (Hsc, 117)] {
        let mut job = Job::new(1.0, kind);
        job.slope.constant_ramp_time = true;
        let out = job.drive(&[&[0.0, 0.0], &[1.0, 0.0]], &[66.666_667]);
        assert_eq!(out.len() - 1, cycles, "{kind:?}");
    }
}

/// Blocks of 0.01 to 10 mm in slowly turning directions, axes with very different accelerations and ramps: a contour
/// takes no longer than its blocks one by one, each from rest to rest.
#[test]
fn a_contour_takes_no_longer_than_its_blocks_with_a_rest_after_each() {
    for seed in 0..count(40) {
        let mut r = Random::from_state(seed as u64);
        let limits = |acc, ramp| AxisDynamics { feed: even(acc, ramp), ..axis(1.0) };
        let axes = vec![limits(3500.0, 0.03), limits(2000.0, 0.05), limits(800.0, 0.08)];
        let dynamics = channel(axes);
        let mut heading = [r.between(-1.0, 1.0), r.between(-1.0, 1.0), r.between(-1.0, 1.0)];
        let mut points = vec![[0.0; 3]];
        for _ in 0..3 + r.below(12) {
            heading = heading.map(|h| h + r.between(-0.2, 0.2));
            let norm = heading.iter().map(|h| h * h).sum::<f64>().sqrt();
            let length = [0.01, 0.03, 0.1, 0.5, 3.0, 10.0][r.below(6)];
            let at = points[points.len() - 1];
            points.push([0, 1, 2].map(|i: usize| at[i] + length * heading[i] / norm));
        }
        if seed == 0 {
            // the slow axis moves only in the tiny blocks
            points = vec![[0.0; 3], [0.02, 0.0, 0.005], [9.0, 0.0, 0.005], [9.02, 0.0, 0.0]];
        }
        for kind in [Trapez, Sin2, Hsc] {
            let dynamics = dynamics.clone();
            let job = Job { dynamics, cycle_us: 100, ..Job::new(1.0, kind) };
            let cycles = |points: &[[f64; 3]]| job.drive(points, &[150.0]).len() - 1;
            let alone: usize = points.windows(2).map(cycles).sum();
            assert!(cycles(&points) <= alone, "{seed} {kind:?}: {} {alone}", cycles(&points));
        }
    }
}

/// A circle of chords, known as a whole: between the rise from its start and the fall to its end the reason for the
/// speed is a limit along it, not the stop at an end.
#[test]
fn what_holds_the_speed_inside_a_contour_is_named_there() {
    let points = arc_points(10.0, std::f64::consts::TAU / 300.0, 301);
    for kind in [Hsc, Trapez] {
        let dynamics = machine(2, 1.0, 3500.0, 0.03);
        let out = Job { dynamics, window: 1000, ..Job::new(1.0, kind) }.drive(&points, &[200.0]);
        let first_fall = out.iter().position(|p| p.a_mm_s2 < -1.0).unwrap();
        let last_rise = out.iter().rposition(|p| p.a_mm_s2 > 1.0).unwrap();
        assert!(first_fall + 50 < last_rise, "{kind:?}: {first_fall} {last_rise}");
        let at_stop = |p: &&Setpoint| p.limit == SpeedLimit::Stop;
        let inside = out[first_fall..=last_rise].iter().find(at_stop);
        assert!(inside.is_none(), "{kind:?}: {inside:?}");
        assert!(out[1..first_fall].iter().any(|p| at_stop(&p)));
        assert!(out[last_rise..].iter().any(|p| at_stop(&p)));
    }
}
