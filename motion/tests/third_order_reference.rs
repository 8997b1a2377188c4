//! Durations against the reference table made with Ruckig 0.19.4 (community version), and against a port of it on
//! random problems.

use kontur_kit::Random;
use kontur_motion::profile::{MotionState, ThirdOrderLimits};
use rsruckig::prelude::*;

fn state(p_mm: f64, v_mm_s: f64, a_mm_s2: f64) -> MotionState {
    MotionState { p_mm, v_mm_s, a_mm_s2 }
}

/// Integrates phase by phase: the end, and the lowest and highest velocity on the way.
fn integrate(from: &MotionState, phases: &[(f64, f64)]) -> (MotionState, f64, f64) {
    let MotionState { p_mm: mut p, v_mm_s: mut v, a_mm_s2: mut a } = *from;
    let (mut low, mut high) = (v, v);
    for (t, j) in phases {
        if a * (a + j * t) < 0.0 {
            let turn = v - a * a / (2.0 * j);
            (low, high) = (low.min(turn), high.max(turn));
        }
        p += v * t + a * t * t / 2.0 + j * t * t * t / 6.0;
        v += a * t + j * t * t / 2.0;
        a += j * t;
        (low, high) = (low.min(v), high.max(v));
    }
    (state(p, v, a), low, high)
}

#[test]
fn durations_and_end_states_of_the_reference() {
    let text = include_str!("data/ruckig_reference.csv");
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let mut rows = 0;
    for record in reader.records() {
        let record = record.unwrap();
        let id = &record[0];
        let number = |i: usize| record[i].parse::<f64>().unwrap();
        let start = state(number(1), number(2), number(3));
        let target = state(number(4), number(5), number(6));
        let limits = ThirdOrderLimits {
            v_max_mm_s: number(7),
            v_min_mm_s: number(8),
            a_max_mm_s2: number(9),
            a_min_mm_s2: number(10),
            jerk_mm_s3: number(11),
        };
        // the rest of the table prescribes a duration, which motions of a path do not have
        if !record[12].is_empty() {
            continue;
        }
        let phases =
            limits.fastest(&start, &target).unwrap_or_else(|error| panic!("{id}: {error}"));
        // R26 starts at its target; the reference leaves it and returns after 0.2 s
        let duration = if id == "R26" { 0.0 } else { number(13) };
        let own: f64 = phases.iter().map(|p| p.0).sum();
        assert!((own - duration).abs() < 1e-9, "{id}: {phases:?}");
        let (end, low, high) = integrate(&start, &phases);
        assert!((end.p_mm - target.p_mm).abs() < 1e-10, "{id}: {end:?}");
        assert!((end.v_mm_s - target.v_mm_s).abs() < 1e-9, "{id}: {end:?}");
        assert!((end.a_mm_s2 - target.a_mm_s2).abs() < 1e-7, "{id}: {end:?}");
        if id != "R26" {
            assert!((high - number(14)).abs() < 1e-8, "{id}: {high}");
            assert!((low - number(15)).abs() < 1e-8, "{id}: {low}");
        }
        rows += 1;
    }
    assert_eq!(rows, 32);
}

#[test]
fn durations_of_an_independent_implementation() {
    let mut random = Random::from_state(5);
    let mut between = |lo: f64, hi: f64| random.between(lo, hi);
    let mut compared = 0;
    for i in 0..20_000 {
        // jerk 1 and velocities of order 1: the reference works with absolute tolerances
        let limits = ThirdOrderLimits {
            v_max_mm_s: between(0.2, 2.0),
            v_min_mm_s: -between(0.2, 2.0),
            a_max_mm_s2: between(0.1, 2.0),
            a_min_mm_s2: -between(0.1, 2.0),
            jerk_mm_s3: 1.0,
        };
        let (moving, accelerated) = (i % 3 > 0, i % 3 > 1);
        let mut random_state = |moving: bool, accelerated: bool| MotionState {
            p_mm: between(-5.0, 5.0),
            v_mm_s: if moving { between(limits.v_min_mm_s, limits.v_max_mm_s) } else { 0.0 },
            a_mm_s2: if accelerated {
                between(limits.a_min_mm_s2, limits.a_max_mm_s2)
            } else {
                0.0
            },
        };
        let (start, target) = (random_state(true, i % 2 > 0), random_state(moving, accelerated));
        let mut input = InputParameter::<1>::new(None);
        input.current_position = daov_stack![start.p_mm];
        input.current_velocity = daov_stack![start.v_mm_s];
        input.current_acceleration = daov_stack![start.a_mm_s2];
        input.target_position = daov_stack![target.p_mm];
        input.target_velocity = daov_stack![target.v_mm_s];
        input.target_acceleration = daov_stack![target.a_mm_s2];
        input.max_velocity = daov_stack![limits.v_max_mm_s];
        input.min_velocity = Some(daov_stack![limits.v_min_mm_s]);
        input.max_acceleration = daov_stack![limits.a_max_mm_s2];
        input.min_acceleration = Some(daov_stack![limits.a_min_mm_s2]);
        input.max_jerk = daov_stack![1.0];
        let mut reference = Ruckig::<1, ThrowErrorHandler>::new(None, 0.001);
        let mut trajectory = Trajectory::new(None);
        let solved = reference.calculate(&input, &mut trajectory);
        let own = limits.fastest(&start, &target);
        // targets that cannot be reached inside the limits are refused by both
        if let (Ok(_), Ok(own)) = (solved, own) {
            let (own, reference) =
                (own.iter().map(|p| p.0).sum::<f64>(), trajectory.get_duration());
            assert!((own - reference).abs() < 1e-7, "{i}: {own} {reference} {start:?} {target:?}");
            compared += 1;
        }
    }
    assert!(compared > 17_000, "{compared}");
}
