//! Inner loop of the look-ahead: reachable velocities and plans of one span.

use criterion::{Criterion, criterion_group, criterion_main};
use kontur_kit::Random;
use kontur_motion::profile::{RampShape, RampedLimits, SlopeLimits, StepAxis, StepLimits};
use std::hint::black_box;

/// Lengths and velocities of a program of short blocks, in a fixed pseudo-random order.
fn spans() -> Vec<[f64; 4]> {
    let mut r = Random::from_state(1);
    (0..1000).map(|_| [0.05 + 5.0 * r.ratio(), 60.0 * r.ratio(), 60.0 * r.ratio(), 100.0]).collect()
}

fn benches(c: &mut Criterion) {
    let ramped = |constant, ramps| {
        SlopeLimits::Ramped(RampedLimits::new(RampShape::Trapez, constant, 1000.0, 900.0, ramps))
    };
    let axis = StepAxis { acc_mm_s2: [1000.0, 800.0], dec_mm_s2: [900.0; 2], change_mm_s: 50.0 };
    let cases = [
        ("trapez", ramped(false, [0.05; 4])),
        ("trapez_unequal", ramped(false, [0.04, 0.06, 0.03, 0.07])),
        ("trapez_constant_ramp_time", ramped(true, [0.05; 4])),
        ("step", SlopeLimits::Step(StepLimits::from_axes(&[axis]))),
    ];
    let spans = spans();
    for (name, limits) in &cases {
        let mut next = spans.iter().cycle();
        c.bench_function(&format!("{name}/reach_up"), |b| {
            b.iter(|| {
                let [length, v0, ..] = next.next().copied().unwrap_or_default();
                black_box(limits.reach_up(black_box(v0), black_box(length)))
            });
        });
        // only spans whose boundary velocities fit, as the look-ahead guarantees
        let fitting: Vec<_> =
            spans.iter().filter(|[l, v0, ve, vf]| limits.plan(*v0, *ve, *vf, *l).is_ok()).collect();
        let mut next = fitting.iter().cycle();
        c.bench_function(&format!("{name}/plan"), |b| {
            b.iter(|| {
                let [length, v0, ve, vf] = next.next().map_or([0.0; 4], |span| **span);
                black_box(limits.plan(black_box(v0), black_box(ve), vf, black_box(length)).is_ok())
            });
        });
        let profile = limits.plan(0.0, 0.0, 100.0, 10.0);
        let Ok(profile) = profile else { continue };
        let mut t = 0.0;
        c.bench_function(&format!("{name}/at"), |b| {
            b.iter(|| {
                t = if t > 0.25 { 0.0 } else { t + 0.001 };
                black_box(profile.at(black_box(t)))
            });
        });
    }
}

criterion_group!(slope, benches);
criterion_main!(slope);
