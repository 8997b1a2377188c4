//! The general third-order profile compared with `rsruckig`, a port of Ruckig, on the same random problems.

use criterion::{Criterion, criterion_group, criterion_main};
use kontur_kit::Random;
use kontur_motion::profile::{MotionState, ThirdOrderLimits};
use rsruckig::prelude::*;
use std::hint::black_box;

struct Problem {
    start: MotionState,
    target: MotionState,
    limits: ThirdOrderLimits,
    input: InputParameter<1>,
}

/// Problems with symmetric limits; `at_rest` ends (and starts) without acceleration, the target at rest.
fn problems(at_rest: bool) -> Vec<Problem> {
    let mut r = Random::from_state(7);
    let mut all = Vec::new();
    while all.len() < 1000 {
        let limits = ThirdOrderLimits {
            v_max_mm_s: 100.0,
            v_min_mm_s: -100.0,
            a_max_mm_s2: 1000.0,
            a_min_mm_s2: -1000.0,
            jerk_mm_s3: 20_000.0,
        };
        let mut state = |moving: bool, accelerated: bool| MotionState {
            p_mm: r.between(-30.0, 30.0),
            v_mm_s: if moving { r.between(-70.0, 70.0) } else { 0.0 },
            a_mm_s2: if accelerated { r.between(-900.0, 900.0) } else { 0.0 },
        };
        let start = state(true, !at_rest);
        let target = state(!at_rest, !at_rest);
        let mut input = InputParameter::new(None);
        input.current_position = daov_stack![start.p_mm];
        input.current_velocity = daov_stack![start.v_mm_s];
        input.current_acceleration = daov_stack![start.a_mm_s2];
        input.target_position = daov_stack![target.p_mm];
        input.target_velocity = daov_stack![target.v_mm_s];
        input.target_acceleration = daov_stack![target.a_mm_s2];
        input.max_velocity = daov_stack![100.0];
        input.max_acceleration = daov_stack![1000.0];
        input.max_jerk = daov_stack![20_000.0];
        // the duration is compared as well: a benchmark of different answers would mean nothing
        let Ok(own) = limits.fastest(&start, &target) else { continue };
        let mut other = Ruckig::<1, IgnoreErrorHandler>::new(None, 0.001);
        let mut trajectory = Trajectory::new(None);
        if other.calculate(&input, &mut trajectory).is_err() {
            continue;
        }
        assert!(
            (own.iter().map(|p| p.0).sum::<f64>() - trajectory.get_duration()).abs() < 1e-8,
            "{start:?} {target:?}"
        );
        all.push(Problem { start, target, limits, input });
    }
    all
}

fn benches(c: &mut Criterion) {
    for (name, at_rest) in [("to_rest", true), ("any_state", false)] {
        let problems = problems(at_rest);
        let mut next = problems.iter().cycle();
        c.bench_function(&format!("{name}/own"), |b| {
            b.iter(|| {
                let Some(p) = next.next() else { return };
                let _ = black_box(p.limits.fastest(&p.start, &p.target));
            });
        });
        let mut next = problems.iter().cycle();
        let mut ruckig = Ruckig::<1, IgnoreErrorHandler>::new(None, 0.001);
        let mut trajectory = Trajectory::new(None);
        c.bench_function(&format!("{name}/rsruckig"), |b| {
            b.iter(|| {
                let Some(p) = next.next() else { return };
                let _ = black_box(ruckig.calculate(&p.input, &mut trajectory));
            });
        });
    }
}

criterion_group!(third_order, benches);
criterion_main!(third_order);
