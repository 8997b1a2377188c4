//! Blocks per second through smoothing, look-ahead and sampling: a wavy CAM contour of short straight blocks.

#[path = "../tests/common/mod.rs"]
mod common;

use common::{axis, channel};
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use kontur_filters::time::CycleTime;
use kontur_filters::vib_guard::VibGuardSettings;
use kontur_motion::axis::{AxisVec, FeedSlope};
use kontur_motion::block::{
    Block, ChannelDynamics, ContourMode, ContourSettings, Feed, Slope, SlopeKind, SplineSettings,
    Tolerance,
};
use kontur_motion::contouring::Contouring;
use kontur_motion::path::{LinePath, Path};
use kontur_motion::planner::{Next, Planner};
use kontur_motion::spline::Splining;
use kontur_motion::tolerance::Kernels;
use std::hint::black_box;
use std::sync::Arc;

/// The channel of a machine of 4 m/s2 with ramps of 20 ms.
fn dynamics() -> Arc<ChannelDynamics> {
    let mut axis = axis(1.0);
    axis.a_max_mm_s2 = 6000.0;
    axis.feed = FeedSlope { acc_mm_s2: 4000.0, dec_mm_s2: 4000.0, ramps_s: [0.02; 4] };
    (axis.step_feed.acc_mm_s2, axis.step_feed.dec_mm_s2) = ([4000.0; 2], [4000.0; 2]);
    channel(vec![axis; 3])
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
                    let feed = Feed::PathVelocity(100.0);
                    let block = Block::new(i as u64, Path::Line(line), feed, Arc::clone(&dynamics));
                    let slope = Slope { kind, ..Slope::default() };
                    let tolerance = Tolerance { ax_dev_mm, acc_fact: 1.0 };
                    planner.push(Block { slope, tolerance, ..block });
                }
                i += 1;
            }
            Ok(Next::Input) => planner.finish(),
            Ok(Next::Rest | Next::Stopped) | Err(_) => return planner.setpoint().k,
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

/// The straight blocks of the surface, the coordinates rounded to three decimals.
fn lines(count: usize) -> Vec<Block> {
    let dynamics = dynamics();
    let rounded =
        |i: usize| -> AxisVec { point(i).iter().map(|x| libm::round(x * 1e3) / 1e3).collect() };
    let block = |i: usize| {
        let line = LinePath::new(rounded(i), rounded(i + 1), &dynamics.feed_axes)?;
        let feed = Feed::PathVelocity(100.0);
        Some(Block::new(i as u64, Path::Line(line), feed, Arc::clone(&dynamics)))
    };
    (0..count).filter_map(block).collect()
}

fn smoothing(c: &mut Criterion) {
    let count = 2_000;
    let mut group = c.benchmark_group("smoothing");
    group.throughput(Throughput::Elements(count as u64));
    let spline = Some(SplineSettings { path_dev_mm: 0.02, ..SplineSettings::default() });
    let splined: Vec<Block> = lines(count).into_iter().map(|b| Block { spline, ..b }).collect();
    group.bench_function("BSPLINE", |b| {
        b.iter(|| {
            let mut stage = Splining::new(CycleTime::DEFAULT);
            for block in &splined {
                for out in stage.push(block.clone(), &Kernels::default()) {
                    black_box(out);
                }
            }
            for out in stage.flush(&Kernels::default()) {
                black_box(out);
            }
        });
    });
    let mode = ContourMode::Dev { path_dev_mm: 0.02 };
    let contour = Some(ContourSettings { mode, ..ContourSettings::default() });
    let rounded: Vec<Block> = lines(count).into_iter().map(|b| Block { contour, ..b }).collect();
    group.bench_function("G261", |b| {
        b.iter(|| {
            let mut stage = Contouring::new(CycleTime::DEFAULT);
            for block in &rounded {
                for out in stage.push(block.clone(), &Kernels::default()) {
                    black_box(out);
                }
            }
            for out in stage.flush() {
                black_box(out);
            }
        });
    });
    group.finish();
}

criterion_group!(benches, smoothing, blocks);
criterion_main!(benches);
