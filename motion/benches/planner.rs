//! Blocks per second through look-ahead and sampling: a wavy CAM contour of short straight blocks.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use kontur_filters::time::CycleTime;
use kontur_filters::vib_guard::VibGuardSettings;
use kontur_motion::axis::{AxisDynamics, AxisVec, FeedSlope, FeedholdSlope, RapidSlope, StepSlope};
use kontur_motion::block::{
    Block, ChannelDynamics, CurveJerk, Feed, Slope, SlopeKind, Tolerance, TransitionJerkMode,
    VectorLimits,
};
use kontur_motion::path::{LinePath, Path};
use kontur_motion::planner::{Next, Planner};
use kontur_motion::tolerance::Kernels;
use std::hint::black_box;
use std::sync::Arc;

fn dynamics() -> Arc<ChannelDynamics> {
    let step = StepSlope { acc_mm_s2: [4000.0; 2], dec_mm_s2: [4000.0; 2], change_mm_s: 100.0 };
    let axis = AxisDynamics {
        v_max_mm_s: 1000.0,
        v_rapid_mm_s: 1000.0,
        a_max_mm_s2: 6000.0,
        a_emergency_mm_s2: 6000.0,
        tr_geom_s: 0.01,
        feed: FeedSlope { acc_mm_s2: 4000.0, dec_mm_s2: 4000.0, ramps_s: [0.02; 4] },
        rapid: RapidSlope { acc_mm_s2: 5000.0, ramp_s: 0.02 },
        feedhold: FeedholdSlope { step_dec_mm_s2: 5000.0, dec_mm_s2: 5000.0, ramp_s: 0.02 },
        step_feed: step,
        step_rapid: step,
        a_trans_ratio: 1.0,
        r_trans_ratio: 1.0,
        j_trans_kink_mm_s3: 0.0,
        j_trans_tangential_mm_s3: 0.0,
    };
    Arc::new(ChannelDynamics {
        axes: vec![axis; 3],
        feed_axes: vec![true; 3],
        limit_tangential_jerk: false,
        transition_jerk: TransitionJerkMode::Coupled,
        curvature_estimate: 0,
        curve_jerk: CurveJerk::Geometric,
        vector: VectorLimits::default(),
        vector_acc_on_arcs: false,
        transition_velocity_min_mm_s: 0.0,
        stop_at_transitions: false,
    })
}

/// Points of a wavy surface, rows of 50 mm in steps of 0.2 mm.
fn point(i: usize) -> AxisVec {
    let (row, column) = (i / 250, i % 250);
    let along = if row % 2 == 0 { column } else { 249 - column } as f64 * 0.2;
    let across = row as f64 * 0.3;
    let z = 2.0 * libm::sin(along * 0.3) * libm::cos(across * 0.2);
    AxisVec::from_slice(&[along, across, z])
}

/// Plans and samples `count` blocks, optionally with a guard of mode 2, 40 Hz and a tolerance; returns the cycles.
fn drive(count: usize, kind: SlopeKind, ax_dev_mm: Option<f64>) -> u64 {
    let dynamics = dynamics();
    let mut planner = Planner::new(CycleTime::DEFAULT, 120, &point(0));
    if ax_dev_mm.is_some() {
        let settings = VibGuardSettings { mode: 2, freq_hz: 40.0, damping: 0.1 };
        let kernel = settings.kernel(CycleTime::DEFAULT).ok().map(Arc::new);
        planner.set_kernels(Kernels::new(vec![kernel; 3]), 0);
    }
    let mut i = 0;
    loop {
        match planner.advance() {
            Ok(Next::Setpoint) => {
                black_box(planner.setpoint());
            }
            Ok(Next::Input) if i < count => {
                if let Some(line) = LinePath::new(point(i), point(i + 1), &dynamics.feed_axes) {
                    planner.push(Block {
                        seq: i as u64,
                        path: Path::Line(line),
                        feed: Feed::PathVelocity(100.0),
                        feed_ratio: 1.0,
                        full_override: false,
                        end_velocity_mm_s: None,
                        slope: Slope { kind, ..Slope::default() },
                        dynamics: Arc::clone(&dynamics),
                        tolerance: Tolerance { ax_dev_mm, acc_fact: 1.0 },
                        contour: None,
                        spline: None,
                    });
                }
                i += 1;
            }
            Ok(Next::Input) => planner.finish(),
            Ok(Next::Rest) | Err(_) => return planner.setpoint().k,
        }
    }
}

fn blocks(c: &mut Criterion) {
    let mut group = c.benchmark_group("planner");
    for kind in [SlopeKind::Step, SlopeKind::Trapez, SlopeKind::Hsc] {
        for count in [1_000, 20_000] {
            group.throughput(Throughput::Elements(count as u64));
            group.sample_size(10);
            group.bench_with_input(
                BenchmarkId::new(format!("{kind:?}"), count),
                &count,
                |b, &count| b.iter(|| drive(count, kind, None)),
            );
        }
    }
    group.throughput(Throughput::Elements(5_000));
    group.bench_function("Trapez with AX_DEV/5000", |b| {
        b.iter(|| drive(5_000, SlopeKind::Trapez, Some(0.01)));
    });
    group.finish();
}

criterion_group!(benches, blocks);
criterion_main!(benches);
