//! Velocity limits compared with worked numbers: kinks (P-AXIS-00013), arcs, oblique lines.

#![expect(clippy::float_cmp, reason = "exact values are meant")]

use crate::common::{self, Job, axis, channel, even, line};
use kontur_filters::time::CycleTime;
use kontur_kit::{Random, count, seed};
use kontur_motion::axis::AxisDynamics;
use kontur_motion::block::SlopeKind::{Hsc, Sin2, Step, Trapez};
use kontur_motion::block::{Block, SlopeKind, TransitionJerkMode};
use kontur_motion::cap::SpeedLimit;
use kontur_motion::junction::{Ends, transition};
use kontur_motion::queue::Queued;
use std::f64::consts::PI;
use std::sync::Arc;

const CYCLE: CycleTime = CycleTime::DEFAULT;

/// Velocity in mm/min at the kink between a leg along X and one turned by `degrees`.
fn kink(weight: f64, cycle_us: u32, degrees: f64, kind: SlopeKind) -> f64 {
    let job = Job::new(weight, kind);
    let turned = [1.0 + libm::cos(degrees.to_radians()), libm::sin(degrees.to_radians())];
    let a = job.block(0, line(&[0.0, 0.0], &[1.0, 0.0]), 1e6);
    let b = job.block(1, line(&[1.0, 0.0], &turned), 1e6);
    let cycle = CycleTime::from_us(cycle_us).unwrap();
    transition(&a, &b, &Ends::of(&a), &Ends::of(&b), cycle, false).v_mm_s * 60.0
}

/// Table of kink velocities: a = 1000 mm/s2, ramps of 50 ms, first leg along X.
#[test]
fn kink_table() {
    let angles = [5.0, 15.0, 45.0, 90.0, 135.0];
    for (cycle_us, weight, row) in [
        (1000, 0.0, [13.768, 4.636, 1.697, 1.200, 0.703]),
        (1000, 0.1, [68.842, 23.182, 8.485, 6.000, 3.515]),
        (1000, 1.0, [688.423, 231.822, 84.853, 60.000, 35.147]),
        (2000, 0.0, [55.074, 18.546, 6.788, 4.800, 2.812]),
        (2000, 1.0, [1376.846, 463.644, 169.706, 120.000, 70.294]),
    ] {
        for (degrees, want) in angles.iter().zip(row) {
            let got = kink(weight, cycle_us, *degrees, Trapez);
            assert!(
                (got - want).abs() < 6e-4,
                "{cycle_us} us, weight {weight}, {degrees} deg: {got}"
            );
        }
    }
    assert_eq!(kink(1.0, 1000, 180.0, Trapez), 0.0);
    // STEP has no weight: the acceleration itself
    assert!((kink(0.0, 1000, 90.0, Step) - 60.0).abs() < 1e-9);
}

/// P-CHAN-00117 = 2: the jerk at the kink, capped at `a / T`.
#[test]
fn direct_jerk_at_kinks() {
    let mut job = Job::new(1.0, Trapez);
    let mut d = (*job.dynamics).clone();
    d.transition_jerk = TransitionJerkMode::DirectJerk;
    for (jerk, want) in [(100_000.0, 0.1), (1e9, 1.0)] {
        d.axes.iter_mut().for_each(|a| a.j_trans_kink_mm_s3 = jerk);
        job.dynamics = std::sync::Arc::new(d.clone());
        let a = job.block(0, line(&[0.0, 0.0], &[1.0, 0.0]), 1e6);
        let b = job.block(1, line(&[1.0, 0.0], &[1.0, 1.0]), 1e6);
        let v = transition(&a, &b, &Ends::of(&a), &Ends::of(&b), CYCLE, false).v_mm_s;
        assert!((v - want).abs() < 1e-12, "{jerk}: {v}");
    }
}

fn arc(job: &Job, radius: f64, sweep_rad: f64) -> Block {
    let end = [radius * (libm::cos(sweep_rad) - 1.0), radius * libm::sin(sweep_rad)];
    job.block(0, common::arc(&[0.0; 2], &end, [-radius, 0.0], sweep_rad), 1e6)
}

/// Full circles at a = 1000 mm/s2, tr_geom = 10 ms.
#[test]
fn circle_table() {
    let job = Job::new(1.0, Trapez);
    for (radius, want) in
        [(0.5, 22.361), (1.0, 31.623), (5.0, 70.711), (10.0, 100.0), (50.0, 223.607)]
    {
        let queued = Queued::new(arc(&job, radius, 2.0 * PI), CYCLE);
        assert!((queued.velocity.v_mm_s - want).abs() < 6e-4, "r {radius}: {:?}", queued.velocity);
        assert_eq!(queued.velocity.why, SpeedLimit::Curve);
    }
    // below r = a tr_geom^2 = 0.1 mm the geometric ramp time rules: v^3 / r^2 = a / tr_geom
    let queued = Queued::new(arc(&job, 0.05, 2.0 * PI), CYCLE);
    assert!((queued.velocity.v_mm_s - libm::cbrt(1e5 * 0.0025)).abs() < 1e-9);
}

/// Line to arc with P-CHAN-00009: the step of curvature, weights 0, 100 and 1000.
#[test]
fn tangential_transition_table() {
    for (radius, weight, want) in [
        (10.0, 0.0, 14.142),
        (10.0, 0.1, 31.623),
        (10.0, 1.0, 100.0),
        (1.0, 0.0, 4.472),
        (1.0, 0.1, 10.0),
        (1.0, 1.0, 31.623),
    ] {
        let mut a = axis(1.0);
        a.r_trans_ratio = weight;
        let mut d = (*channel(vec![a; 2])).clone();
        d.limit_tangential_jerk = true;
        d.transition_jerk = TransitionJerkMode::Independent;
        let job = Job { dynamics: std::sync::Arc::new(d), ..Job::new(1.0, Trapez) };
        let before = job.block(0, line(&[0.0, -5.0], &[0.0, 0.0]), 1e6);
        let behind = arc(&job, radius, PI);
        let v = transition(&before, &behind, &Ends::of(&before), &Ends::of(&behind), CYCLE, false);
        assert!((v.v_mm_s - want).abs() < 6e-4, "r {radius}, weight {weight}: {v:?}");
    }
}

/// Oblique lines: X 500 mm/s, 2000 mm/s2, 40 ms; Y 300 mm/s, 800 mm/s2, 100 ms.
#[test]
fn oblique_lines() {
    let with = |v, a, t| AxisDynamics { v_max_mm_s: v, feed: even(a, t), ..axis(1.0) };
    let dynamics = channel(vec![with(500.0, 2000.0, 0.04), with(300.0, 800.0, 0.1)]);
    let job = Job { dynamics, ..Job::new(1.0, Trapez) };
    for (end, velocity, duration) in
        [([30.0, 40.0], 375.0, 0.558257569495), ([96.0, 28.0], 520.8333333, 0.668916667)]
    {
        let fast = Queued::new(job.block(0, line(&[0.0, 0.0], &end), 1e6), CYCLE);
        assert!((fast.velocity.v_mm_s - velocity).abs() < 1e-6);
        let queued = Queued::new(job.block(0, line(&[0.0, 0.0], &end), 200.0), CYCLE);
        let profile = queued.slope.plan(0.0, 0.0, queued.velocity.v_mm_s, queued.length).unwrap();
        assert!((profile.duration() - duration).abs() < 1e-9, "{}", profile.duration());
    }
}

/// `#VECTOR LIMIT` JERK is the largest jerk of the path, in the middle of a sine-square ramp too.
#[test]
fn path_jerk_limit() {
    for kind in [Trapez, Sin2, Hsc] {
        let mut job = Job::new(1.0, kind);
        let mut dynamics = (*job.dynamics).clone();
        dynamics.vector.jerk_mm_s3 = Some(5000.0);
        job.dynamics = Arc::new(dynamics);
        let out = job.drive(&[&[0.0, 0.0], &[200.0, 0.0]], &[300.0]);
        let most = out.iter().map(|p| p.j_mm_s3.abs()).fold(0.0, f64::max);
        assert!(most <= 5000.0 * (1.0 + 1e-9) && most > 4990.0, "{kind:?}: {most}");
    }
}

/// Of two axes that move the same distance each keeps its acceleration and its jerk, in every slope, and one of the two jerks is used.
#[test]
fn axes_that_move_together_keep_the_limits_of_both() {
    let mut r = Random::new(seed());
    let mut random = || {
        let mut a = axis(1.0);
        a.feed.acc_mm_s2 = r.log(100.0, 10_000.0);
        a.feed.dec_mm_s2 = r.log(100.0, 10_000.0);
        a.feed.ramps_s = [(); 4].map(|()| r.log(0.001, 0.2));
        (a.rapid.acc_mm_s2, a.rapid.ramp_s) = (r.log(100.0, 10_000.0), r.log(0.001, 0.2));
        (a.feedhold.dec_mm_s2, a.feedhold.ramp_s) = (r.log(100.0, 10_000.0), r.log(0.001, 0.2));
        a
    };
    // acceleration and ramp time of every ramp
    let ramps = |a: &AxisDynamics| {
        let [t1, t2, t3, t4] = a.feed.ramps_s;
        let (acc, dec) = (a.feed.acc_mm_s2, a.feed.dec_mm_s2);
        let others =
            [(a.rapid.acc_mm_s2, a.rapid.ramp_s), (a.feedhold.dec_mm_s2, a.feedhold.ramp_s)];
        [(acc, t1), (acc, t2), (dec, t3), (dec, t4), others[0], others[1]]
    };
    for _ in 0..count(500) {
        let (a, b) = (random(), random());
        for both in [a.with(&b), b.with(&a)] {
            for (((acc, ramp), (acc_a, ramp_a)), (acc_b, ramp_b)) in
                ramps(&both).into_iter().zip(ramps(&a)).zip(ramps(&b))
            {
                assert_eq!(acc, acc_a.min(acc_b));
                let least = (acc_a / ramp_a).min(acc_b / ramp_b);
                assert!((acc / ramp / least - 1.0).abs() < 1e-12, "{a:?} {b:?}");
            }
        }
    }
}
