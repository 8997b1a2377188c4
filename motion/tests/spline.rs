//! B-spline through short blocks: tolerance, smoothness, ends, ripple.

mod limits;
mod monitored;
mod ripple;
mod short_runs;
mod slaved;
mod unequal;

use crate::common::{
    Job, apart, at, axis, channel, circle, curvature, deviation, even, norm, peaks, tangent,
};
use kontur_filters::time::CycleTime;
use kontur_kit::{Pen, Random, environment};
use kontur_motion::axis::AxisDynamics;
use kontur_motion::block::SlopeKind::{Hsc, Trapez};
use kontur_motion::block::{Block, SlopeKind, SplineSettings};
use kontur_motion::planner::Setpoint;
use kontur_motion::spline::Splining;
use std::f64::consts::FRAC_PI_2;
use std::sync::Arc;

/// A machine with 3500 mm/s2 with ramps of 30 ms, 6 m/s2 at corners.
pub(crate) fn fast(axes: usize) -> Job {
    let axis = AxisDynamics { a_max_mm_s2: 6000.0, feed: even(3500.0, 0.03), ..axis(1.0) };
    Job { dynamics: channel(vec![axis; axes]), window: 400, ..Job::new(1.0, Hsc) }
}

/// A machine for runs of short blocks; HSC, or TRAPEZ with NO_OPT=0: without it every acceleration ends at a block boundary.
fn machine(kind: SlopeKind) -> Job {
    let mut job = Job { window: 400, ..Job::new(1.0, kind) };
    job.slope.optimised = true;
    job
}

/// Setpoints of the spline through points, within a tolerance.
pub(crate) fn driven(job: &Job, path_dev_mm: f64, points: &[Vec<f64>], feed: f64) -> Vec<Setpoint> {
    let settings = SplineSettings { path_dev_mm, ..SplineSettings::default() };
    job.run(&points[0], splined(job, settings, points, feed).into_iter())
}

pub(crate) fn splined(
    job: &Job,
    settings: SplineSettings,
    points: &[Vec<f64>],
    feed: f64,
) -> Vec<Block> {
    splined_and_sharp(job, settings, points, feed).0
}

/// With the numbers of the blocks that end in a corner that is passed faster without a spline.
fn splined_and_sharp(
    job: &Job,
    settings: SplineSettings,
    points: &[Vec<f64>],
    feed: f64,
) -> (Vec<Block>, Vec<u64>) {
    let mut stage = Splining::new(CycleTime::DEFAULT);
    let kernels = job.kernels(points[0].len());
    let mut out = Vec::new();
    for (ends, seq) in points.windows(2).zip(0..) {
        let block = Block { spline: Some(settings), ..job.line(seq, &ends[0], &ends[1], feed) };
        out.extend(stage.push(block, &kernels));
        assert!(out.last().map_or(0, |b| b.seq) + 791 > seq, "the buffer is bounded");
    }
    out.extend(stage.flush(&kernels));
    let mut numbers: Vec<u64> = out.iter().map(|b| b.seq).collect();
    assert!(numbers.is_sorted());
    numbers.dedup();
    assert_eq!(numbers, (0..points.len() as u64 - 1).collect::<Vec<_>>(), "every block survives");
    (out, stage.take_notices().iter().map(|n| n.seq).collect())
}

/// Largest gaps in position, tangent and curvature between neighbours; the latter two not at sharp corners, where the spline
/// ends.
fn gaps(blocks: &[Block], sharp: &[u64]) -> [f64; 3] {
    let mut worst = [0.0_f64; 3];
    for w in blocks.windows(2) {
        let (a, b) = (&w[0].path, &w[1].path);
        let l = a.length();
        worst[0] = worst[0].max(apart(a.end(), b.start()));
        if w[0].seq != w[1].seq && sharp.contains(&w[0].seq) {
            continue;
        }
        let (t, u) = (tangent(a, l), tangent(b, 0.0));
        worst[1] = worst[1].max(apart(&t, &u));
        let (t, u) = (curvature(a, l), curvature(b, 0.0));
        // parts of one edge lie on the same polynomials
        if w[0].seq != w[1].seq {
            worst[2] = worst[2].max(apart(&t, &u) / (1.0 + norm(&t)));
        }
    }
    worst
}

/// Largest component of the deviation of the spline from the polygon, and of a corner from the spline.
fn strays(blocks: &[Block], points: &[Vec<f64>]) -> (f64, f64) {
    let mut out = 0.0_f64;
    let mut samples = Vec::new();
    for b in blocks {
        for k in 0..=8 {
            let q = at(&b.path, b.path.length() * f64::from(k) / 8.0);
            out = out.max(deviation(&q, points));
            samples.push(q);
        }
    }
    (out, points.iter().map(|p| deviation(p, &samples)).fold(0.0, f64::max))
}

/// Lengths of edges in mm and the turns between them, both from a number of 0 to 1.
type Shape = (fn(f64) -> f64, fn(f64) -> f64);

/// Edges of 0.01 to 5 mm, any corner but a reversal.
const ROUGH: Shape = (
    |u| libm::exp(libm::log(0.01) + u * libm::log(500.0)),
    |u| 5.8 * (u - 0.5) * (u - 0.5) * (u - 0.5) * 4.0,
);

/// Edges of 0.1 to 5 mm that turn by at most 35 degrees.
const GENTLE: Shape = (|u| 0.1 * libm::pow(50.0, u), |u| 1.2 * (u - 0.5));

/// Edges of 0.6 to 1.2 mm that turn by at most 29 degrees, where a tolerance is slightly too small.
const EVEN: Shape = (|u| 0.6 * libm::pow(2.0, u), |u| u - 0.5);

/// Edges of 5 to 20 mm that turn by a right angle to either side.
const SQUARES: Shape = (|u| 5.0 * libm::pow(4.0, u), |u| FRAC_PI_2 * libm::copysign(1.0, u - 0.5));

fn polygon((edge, turn): Shape, seed: u64, count: usize) -> Vec<Vec<f64>> {
    let mut random = Random::from_state(seed);
    let mut pen = Pen::default();
    let mut points = vec![pen.at.to_vec()];
    for _ in 0..count {
        points.push(pen.go(edge(random.ratio())).to_vec());
        pen.heading += turn(random.ratio());
    }
    points
}

#[test]
fn the_tolerance_is_kept_and_the_curve_is_smooth() {
    let job = Job::new(1.0, Hsc);
    for seed in 0..24 {
        let points = polygon(if seed % 2 == 0 { ROUGH } else { EVEN }, seed, 60);
        for path_dev_mm in [0.001, 0.005, 0.02, 0.03, 0.04, 0.2] {
            let settings = SplineSettings { path_dev_mm, ..SplineSettings::default() };
            let (blocks, sharp) = splined_and_sharp(&job, settings, &points, 50.0);
            let (out, missed) = strays(&blocks, &points);
            assert!(out <= path_dev_mm * (1.0 + 1e-9), "{seed}: {out}");
            assert!(missed <= path_dev_mm * (1.0 + 1e-2) + 1e-9, "{seed}: {missed}");
            let [position, tangent, curvature] = gaps(&blocks, &sharp);
            assert!(position < 1e-11 && tangent < 1e-9, "{seed}: {position} {tangent}");
            assert!(curvature < 1e-6, "{seed}: {curvature}");
            // the ends are exact, with the direction of the polygon
            assert_eq!(blocks[0].path.start()[..], points[0][..]);
            let last = &blocks[blocks.len() - 1].path;
            assert_eq!(last.end()[..], points[points.len() - 1][..]);
        }
    }
}

/// A right angle between long edges: the deviation is used, the spline is on the polygon elsewhere.
#[test]
fn a_coarse_corner_uses_the_tolerance() {
    let job = Job::new(1.0, Hsc);
    let points = [vec![0.0, 0.0], vec![30.0, 0.0], vec![30.0, 30.0]];
    let blocks = splined(&job, SplineSettings::default(), &points, 50.0);
    let second = blocks.iter().position(|b| b.seq == 1).unwrap();
    let corner = blocks[second].path.start();
    assert!((apart(corner, &points[1]) - 0.2).abs() < 1e-12);
    let samples = blocks[..second]
        .iter()
        .flat_map(|b| (0..=20).map(|k| at(&b.path, b.path.length() * f64::from(k) / 20.0)));
    // two control points of 6 PATH_DEV / |du| are all that the corner takes of the edge
    let taken = 2.0 * 6.0 * 0.2 / 2.0_f64.sqrt();
    for q in samples.filter(|q| q[0] < 30.0 - taken) {
        assert!(q[1].abs() < 1e-12, "{q:?}");
    }
}

/// The bend of a refined corner slows down the corner, but not the edges: it is not slower than a stop at the corner.
#[test]
fn a_coarse_corner_does_not_slow_down_its_edges() {
    for kind in [Trapez, Hsc] {
        let job = Job::new(1.0, kind);
        let points = [vec![0.0, 0.0], vec![50.0, 0.0], vec![50.0, 50.0]];
        let leg = |i: usize| job.drive(&points[i..=i + 1], &[50.0]).len();
        let stopping = leg(0) + leg(1);
        for path_dev_mm in [0.001, 0.02, 0.2] {
            let splined = driven(&job, path_dev_mm, &points, 50.0).len();
            // each part of the corner takes its full ramps
            assert!(
                splined <= stopping + stopping / 100,
                "{kind:?} {path_dev_mm}: {splined} of {stopping} cycles"
            );
        }
    }
}

/// A corner just short of a reversal stays a corner: it is not slower than without the spline.
#[test]
fn a_needle_stays_a_corner() {
    let job = Job::new(1.0, Hsc);
    let points = [vec![0.0, 0.0], vec![10.0, 0.0], vec![0.0, 1e-4]];
    let plain = job.drive(&points, &[50.0]).len();
    let settings = SplineSettings { path_dev_mm: 0.1, ..SplineSettings::default() };
    let blocks = splined(&job, settings, &points, 50.0);
    assert!(blocks.iter().all(|b| b.path.is_straight()));
    assert_eq!(job.run(&points[0], blocks.into_iter()).len(), plain);
}

#[test]
fn where_the_spline_ends() {
    let job = Job::new(1.0, Hsc);
    let points = [vec![0.0, 0.0], vec![1.0, 0.0], vec![2.0, 0.1], vec![2.2, 1.0], vec![2.3, 2.0]];
    let kink = |settings: SplineSettings| gaps(&splined(&job, settings, &points, 50.0), &[])[1];
    assert!(kink(SplineSettings::default()) < 1e-9);
    let base = SplineSettings::default();
    assert!(kink(SplineSettings { max_angle_deg: 60.0, ..base }) > 0.5);
    assert!(kink(SplineSettings { max_angle_deg: 80.0, ..base }) < 1e-9);
    assert!(kink(SplineSettings { off_at_path_dev: true, path_dev_mm: 0.05, ..base }) > 0.5);
    // a long block stays a line
    let blocks = splined(&job, SplineSettings { max_length_mm: 0.95, ..base }, &points, 50.0);
    assert!(blocks[0].path.is_straight() && blocks[1].path.is_straight());
}

/// Slaved axes share the spline; `TRACK_DEV` bounds them.
#[test]
fn slaved_axes() {
    let mut dynamics = (*channel(vec![axis(1.0); 3])).clone();
    dynamics.feed_axes = vec![true, true, false];
    let job = Job { dynamics: Arc::new(dynamics), ..Job::new(1.0, Hsc) };
    let points: Vec<Vec<f64>> = (0..40)
        .map(|k| {
            let x = f64::from(k);
            vec![x, libm::sin(0.3 * x), if k % 10 < 5 { 3.0 * x } else { 100.0 - x }]
        })
        .collect();
    for track_dev_deg in [0.5, 0.05] {
        let settings = SplineSettings { track_dev_deg, ..SplineSettings::default() };
        let (blocks, sharp) = splined_and_sharp(&job, settings, &points, 50.0);
        // the programmed angle at the same place of the polygon in X
        for b in &blocks {
            for k in 0..=10 {
                let q = at(&b.path, b.path.length() * f64::from(k) / 10.0);
                let i = (q[0].floor() as usize).min(points.len() - 2);
                let want = points[i][2] + (q[0] - points[i][0]) * (points[i + 1][2] - points[i][2]);
                assert!((q[2] - want).abs() <= 1.001 * track_dev_deg, "{} {want}", q[2]);
            }
        }
        assert!(gaps(&blocks, &sharp)[1] < 1e-8);
    }
}

/// A larger `PATH_DEV` does not lengthen the run by more than the 3 % that judging each corner separately may cost, and
/// no axis is loaded beyond what the shape of the curve (`a`, `a / tr_geom`) and the change of path speed (`a`, `a /
/// t`) may use together. `COUNT` raises the number of polygons.
#[test]
fn a_larger_tolerance_costs_nothing() {
    let count = environment("COUNT", 2);
    for kind in [Hsc, Trapez] {
        let job = machine(kind);
        for shape in [ROUGH, GENTLE, EVEN] {
            for seed in 0..count {
                let points = polygon(shape, seed, 60);
                let mut last = usize::MAX;
                for path_dev_mm in [1e-4, 1e-3, 0.01, 0.05, 0.2] {
                    let (cycles, acc, jerk) =
                        peaks(&driven(&job, path_dev_mm, &points, 100.0), job.cycle_us);
                    let what = format!("{kind:?} {seed} {path_dev_mm}: {cycles} {acc} {jerk}");
                    println!("{what}");
                    assert!(cycles - cycles / 33 <= last, "{what} after {last}");
                    assert!(acc <= 2000.0 * (1.0 + 1e-6), "{what}");
                    last = cycles;
                }
            }
        }
    }
}

/// Where the path stops at every transition (G116), the edges stay straight.
#[test]
fn stops_at_transitions_leave_the_polygon() {
    let mut dynamics = (*channel(vec![axis(1.0); 2])).clone();
    dynamics.stop_at_transitions = true;
    let job = Job { dynamics: Arc::new(dynamics), ..Job::new(1.0, Hsc) };
    let points = polygon(ROUGH, 7, 40);
    for path_dev_mm in [0.0, 0.001, 0.2] {
        let settings = SplineSettings { path_dev_mm, ..SplineSettings::default() };
        let blocks = splined(&job, settings, &points, 50.0);
        let edges = blocks.iter().zip(&points).zip(&points[1..]);
        assert!(edges.into_iter().all(|((block, from), to)| {
            block.path.is_straight()
                && block.path.start()[..] == from[..]
                && block.path.end()[..] == to[..]
        }));
    }
}

/// A spline takes at most 1 % longer than its polygon, as each corner is judged separately. `COUNT` raises the number
/// of polygons.
#[test]
fn a_spline_takes_no_longer_than_its_polygon() {
    let count = environment("COUNT", 3);
    for kind in [Hsc, Trapez] {
        let job = machine(kind);
        for shape in [ROUGH, GENTLE, EVEN, SQUARES] {
            for seed in 100..100 + count {
                let points = polygon(shape, seed, 60);
                let sharp = job.drive(&points, &[100.0]).len();
                for path_dev_mm in [1e-3, 0.01, 0.05, 0.2] {
                    let round = driven(&job, path_dev_mm, &points, 100.0).len();
                    let what = format!("{kind:?} {seed} {path_dev_mm}: {round} of {sharp} cycles");
                    println!("{what}");
                    assert!(round - round / 100 <= sharp, "{what}");
                }
            }
        }
    }
}
