//! Polynomial contouring: the curve compared with its closed forms and its neighbours; modules `optimum`: times compared
//! with the least ones; `tolerance`: effects that a tolerance must not have.

mod along;
mod optimum;
mod runs;
mod tolerance;

use crate::common::{Job, apart, arc, at, axis, channel, curvature, line, norm, tangent};
use kontur_filters::time::CycleTime;
use kontur_motion::block::SlopeKind::Trapez;
use kontur_motion::block::{Block, ContourMode, ContourSettings, CurveJerk, Feed, Tolerance};
use kontur_motion::contouring::{Contouring, NoContour, Notice};
use kontur_motion::limits::{PathExtremes, PathSpeeds};
use kontur_motion::path::Path;
use kontur_motion::tolerance::Kernels;
use std::sync::Arc;

fn dev(path_dev_mm: f64) -> ContourSettings {
    ContourSettings { mode: ContourMode::Dev { path_dev_mm }, ..ContourSettings::default() }
}

/// Two lines of 100 mm that turn by `degrees`, the corner at the origin, in the plane from the x axis.
fn corner(degrees: f64) -> [Path; 2] {
    let (sin, cos) = libm::sincos(degrees.to_radians());
    [line(&[-100.0, 0.0], &[0.0, 0.0]), line(&[0.0, 0.0], &[100.0 * cos, 100.0 * sin])]
}

/// At 1 mm/s, at which no curve of these tests is slower than the feed rate, so that all of them are used.
fn contoured(
    job: &Job,
    settings: ContourSettings,
    paths: impl IntoIterator<Item = Path>,
) -> (Vec<Block>, Vec<Notice>) {
    contoured_at(1.0, job, settings, paths)
}

fn contoured_at(
    feed_mm_s: f64,
    job: &Job,
    settings: ContourSettings,
    paths: impl IntoIterator<Item = Path>,
) -> (Vec<Block>, Vec<Notice>) {
    let mut stage = Contouring::new(CycleTime::from_us(job.cycle_us).unwrap());
    let kernels = job.kernels(job.dynamics.axes.len());
    let mut out = Vec::new();
    for (path, seq) in paths.into_iter().zip(0..) {
        let block = Block { contour: Some(settings), ..job.block(seq, path, feed_mm_s) };
        out.extend(stage.push(block, &kernels));
    }
    out.extend(stage.flush());
    (out, stage.take_notices())
}

fn is_curve(block: &Block) -> bool {
    matches!(block.path, Path::Curve(_))
}

fn curves(blocks: &[Block]) -> Vec<&Block> {
    blocks.iter().filter(|b| is_curve(b)).collect()
}

/// Every block starts where the one before ends, with its direction and its curvature.
fn assert_smooth(blocks: &[Block]) {
    for w in blocks.windows(2) {
        let (a, b) = (&w[0].path, &w[1].path);
        assert!(apart(a.end(), b.start()) < 1e-12, "gap {}", apart(a.end(), b.start()));
        let l = a.length();
        assert!(apart(&tangent(a, l), &tangent(b, 0.0)) < 1e-9);
        assert!(apart(&curvature(a, l), &curvature(b, 0.0)) < 1e-7);
    }
}

/// Corner distance, curve length, largest curvature, sqrt(1000 / curvature) for a deviation of 1 mm; from the closed
/// form of the curve and its numerical integration.
#[test]
fn curve_between_two_lines() {
    let job = Job::new(1.0, Trapez);
    for (degrees, d, length, kappa, v) in [
        (30.0, 10.303209, 20.246846, 0.040386, 157.3571),
        (45.0, 6.968336, 13.396370, 0.096510, 101.7922),
        (60.0, 5.333333, 9.944651, 0.187500, 73.0297),
        (90.0, 3.771236, 6.454244, 0.562500, 42.1637),
        (120.0, 3.079201, 4.705465, 1.687500, 24.3432),
        (150.0, 2.760736, 3.729552, 7.834614, 11.2977),
    ] {
        let (blocks, notices) = contoured(&job, dev(1.0), corner(degrees));
        assert_eq!(notices.len(), 1, "only that nothing follows the last block");
        assert_eq!(notices[0], Notice { seq: 1, reason: NoContour::NothingFollows });
        assert_smooth(&blocks);
        let parts = curves(&blocks);
        let (first, last) = (parts[0], parts[parts.len() - 1]);
        assert!((norm(first.path.start()) - d).abs() < 1e-6, "{degrees}");
        assert!((norm(last.path.end()) - d).abs() < 1e-6);
        assert!(norm(&curvature(&first.path, 0.0)) < 1e-12);
        assert!(norm(&curvature(&last.path, last.path.length())) < 1e-12);
        let total: f64 = parts.iter().map(|b| b.path.length()).sum();
        assert!((total - length).abs() < 1e-6, "{degrees}: {total}");
        let (mut nearest, mut bend) = (f64::INFINITY, 0.0_f64);
        for b in &parts {
            for k in 0..=1000 {
                let s = b.path.length() * f64::from(k) / 1000.0;
                nearest = nearest.min(norm(&at(&b.path, s)));
                bend = bend.max(norm(&curvature(&b.path, s)));
            }
        }
        let halves = parts.iter().map(|b| b.seq).collect::<Vec<_>>();
        assert!(halves.is_sorted() && halves.contains(&0) && halves.contains(&1), "{halves:?}");
        let limit = parts.iter().find(|b| b.seq == 1).unwrap();
        assert!(
            (norm(limit.path.start()) - 1.0).abs() < 1e-9,
            "the block ends at the interim point"
        );
        assert!((nearest - 1.0).abs() < 1e-9, "{degrees}: {nearest}");
        assert!((bend - kappa).abs() < 1e-6 * kappa.max(1.0), "{degrees}: {bend}");
        assert!(((1000.0 / bend).sqrt() - v).abs() < 2e-4, "{degrees}");
    }
}

/// Axis-parallel corner: min(48.004, 66.153) mm/s with 1000 mm/s2 and a geometric ramp of 10 ms.
#[test]
fn speed_on_the_curve() {
    let job = Job::new(1.0, Trapez);
    let slowest = |settings: ContourSettings, job: &Job| -> f64 {
        let (blocks, _) = contoured(job, settings, corner(90.0));
        curves(&blocks)
            .iter()
            .map(|b| PathSpeeds::of(b, &PathExtremes::of(&b.path)))
            .map(|speeds| speeds.highest())
            .fold(f64::INFINITY, f64::min)
    };
    assert!((slowest(dev(1.0), &job) - 48.004).abs() < 5e-4);
    let (blocks, _) =
        contoured(&job, ContourSettings { constant_velocity: true, ..dev(1.0) }, corner(90.0));
    let parts = curves(&blocks);
    assert_eq!(parts.len(), 1, "CONST_VEL: one block, one speed");
    let x = PathExtremes::of(&parts[0].path);
    assert!((x.second[0] - 0.433952).abs() < 5e-7 && (x.second[1] - 0.433952).abs() < 5e-7);
    assert!((x.third[0] - 0.345424).abs() < 5e-7 && (x.third[1] - 0.345424).abs() < 5e-7);
    // a geometric ramp of 100 ms: (1000 / 0.1 / 0.345424)^(1/3); CHECK_JERK=2: ramps of 50 ms; 0: no jerk limit
    let mut slow = axis(1.0);
    slow.tr_geom_s = 0.1;
    let job = Job { dynamics: channel(vec![slow; 2]), ..Job::new(1.0, Trapez) };
    let jerk = |a: f64, t: f64| libm::cbrt(a / t / 0.345424);
    assert!((slowest(dev(1.0), &job) - jerk(1000.0, 0.1)).abs() < 1e-3);
    let checked = |check| ContourSettings { curve_jerk: Some(check), ..dev(1.0) };
    assert!((slowest(checked(CurveJerk::Ramps), &job) - jerk(1000.0, 0.05)).abs() < 1e-3);
    assert!((slowest(checked(CurveJerk::Unlimited), &job) - 48.004).abs() < 5e-4);
}

#[test]
fn distances_are_limited_to_half_of_what_may_go() {
    let job = Job::new(1.0, Trapez);
    let short = || [line(&[-4.0, 0.0], &[0.0, 0.0]), line(&[0.0, 0.0], &[0.0, 10.0])];
    let ends = |settings: ContourSettings| {
        let (blocks, _) = contoured(&job, settings, short());
        assert_smooth(&blocks);
        let parts = curves(&blocks);
        (-parts[0].path.start()[0], parts[parts.len() - 1].path.end()[1])
    };
    let dist = |pre_mm, post_mm| ContourSettings {
        mode: ContourMode::Dist { pre_mm, post_mm },
        ..ContourSettings::default()
    };
    // a deviation of 1 mm would need 3.77 mm: both distances are limited alike
    let close = |a: (f64, f64), b: (f64, f64)| {
        assert!((a.0 - b.0).abs() < 1e-12 && (a.1 - b.1).abs() < 1e-12, "{a:?} {b:?}");
    };
    close(ends(dev(1.0)), (2.0, 2.0));
    close(ends(ContourSettings { remain_ratio: 0.1, ..dev(1.0) }), (1.8, 1.8));
    close(ends(dist(1.0, 1.0)), (1.0, 1.0));
    close(ends(dist(3.0, 3.0)), (2.0, 2.0));
    // unequal ones: only the one that is too long
    close(ends(dist(3.0, 4.0)), (2.0, 4.0));
    close(ends(dist(0.5, 1.5)), (0.5, 1.5));
    let ptp = ContourMode::Ptp { path_dev_mm: Some(0.1), path_dist_mm: Some(1.0) };
    close(
        ends(ContourSettings { mode: ptp, ..ContourSettings::default() }),
        (0.8 * 2.0_f64.sqrt() / 3.0, 0.8 * 2.0_f64.sqrt() / 3.0),
    );
}

/// A block between two curves that use up both halves disappears; the path stays continuous.
#[test]
fn a_block_may_be_used_up() {
    let job = Job::new(1.0, Trapez);
    let points: [&[f64]; 5] =
        [&[0.0, 0.0], &[10.0, 0.0], &[10.0, 1.0], &[20.0, 1.0], &[20.0, 20.0]];
    let (blocks, _) = contoured(&job, dev(5.0), points.windows(2).map(|w| line(w[0], w[1])));
    assert_smooth(&blocks);
    assert!(blocks.iter().all(|b| b.seq != 1 || is_curve(b)));
    assert_eq!(blocks[0].path.start()[..], [0.0, 0.0]);
    assert_eq!(blocks[blocks.len() - 1].path.end()[..], [20.0, 20.0]);
}

#[test]
fn arcs_as_neighbours() {
    let job = Job::new(1.0, Trapez);
    let right = std::f64::consts::FRAC_PI_2;
    // a line into a quarter circle with a corner of 90 deg, then another quarter, sharp again, then a line
    let paths = || {
        [
            line(&[-20.0, 0.0], &[0.0, 0.0]),
            arc(&[0.0, 0.0], &[10.0, 10.0], [10.0, 0.0], -right),
            arc(&[10.0, 10.0], &[20.0, 20.0], [10.0, 20.0], right),
            line(&[20.0, 20.0], &[20.0, 0.0]),
        ]
    };
    // the second and third meet tangentially: that corner stays
    for eps in [0.01, 0.1, 0.5] {
        let (blocks, notices) = contoured(&job, dev(eps), paths());
        assert_eq!(
            notices.iter().map(|n| n.reason).collect::<Vec<_>>(),
            [NoContour::NotPossible, NoContour::NothingFollows],
            "the last corner reverses"
        );
        let parts = curves(&blocks);
        let near = |p: &[f64]| {
            let to = |path: &Path| apart(&at(path, path.nearest(p)), p);
            paths().iter().map(to).fold(f64::INFINITY, f64::min)
        };
        let mut cut = f64::INFINITY;
        for b in &parts {
            for k in 0..=200 {
                let p = at(&b.path, b.path.length() * f64::from(k) / 200.0);
                assert!(near(&p) <= eps * (1.0 + 1e-9));
                cut = cut.min(norm(&p));
            }
        }
        assert!((cut - eps).abs() < 0.02 * eps, "the tolerance is used: {cut}");
        assert_smooth(&blocks[..=parts.len() + 1]);
    }
    // arc to arc with a corner
    let (blocks, _) = contoured(
        &job,
        dev(0.2),
        [
            arc(&[0.0, 0.0], &[10.0, 10.0], [10.0, 0.0], -right),
            arc(&[10.0, 10.0], &[20.0, 20.0], [20.0, 10.0], -right),
        ],
    );
    assert!(!curves(&blocks).is_empty());
    assert_smooth(&blocks);
}

/// POS: through the interim point, also without leaving the first block before its end.
#[test]
fn interim_point() {
    let job = Job::new(1.0, Trapez);
    for (pre_mm, post_mm) in [(3.0, 3.0), (2.0, 4.0), (0.0, 3.0)] {
        let point_mm = [Some(0.5), Some(-0.25), None];
        let mode = ContourMode::Pos { pre_mm, post_mm, point_mm };
        let settings = ContourSettings { mode, ..ContourSettings::default() };
        let (blocks, _) = contoured(&job, settings, corner(90.0));
        assert_smooth(&blocks);
        let nearest = curves(&blocks)
            .iter()
            .map(|b| apart(&at(&b.path, b.path.nearest(&[0.5, -0.25])), &[0.5, -0.25]))
            .fold(f64::INFINITY, f64::min);
        assert!(nearest < 1e-9, "{nearest}");
    }
}
