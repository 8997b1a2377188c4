//! Runs of blocks: short ones that are bridged, corners that cannot be contoured, words of the neighbours.

use super::*;

/// RELEVANT_PATH: short blocks between two long ones are bridged within PATH_DEV (TF5200, example of ID 120216).
#[test]
fn short_blocks_are_bridged() {
    let job = Job::new(1.0, Trapez);
    let points: [&[f64]; 4] = [&[0.0, 0.0], &[99.999, 0.001], &[100.0, 0.0], &[100.0, 100.0]];
    let paths = || points.windows(2).map(|w| line(w[0], w[1]));
    let (blocks, notices) =
        contoured(&job, ContourSettings { relevant_path_mm: 0.1, ..dev(1.0) }, paths());
    assert_smooth(&blocks);
    assert!(!curves(&blocks).is_empty());
    assert!(blocks.iter().all(|b| b.seq != 1));
    assert_eq!(notices.len(), 1);
    // without it the corner distance is half of 0.0014 mm: the manual prints 120216 for it
    let (blocks, notices) = contoured_at(0.1, &job, dev(1.0), paths());
    assert!(curves(&blocks).is_empty());
    assert!(notices[..2].iter().all(|n| n.reason == NoContour::BlockTooShort), "{notices:?}");
    // half of 0.0042 mm is a curve for a very low speed
    let points: [&[f64]; 4] = [&[0.0, 0.0], &[99.997, 0.003], &[100.0, 0.0], &[100.0, 100.0]];
    let paths = points.windows(2).map(|w| line(w[0], w[1]));
    let (blocks, _) = contoured_at(0.1, &job, dev(1.0), paths);
    assert_smooth(&blocks);
    assert!(norm(&tangent(&blocks[1].path, 0.0)) > 0.9);
    let start = curves(&blocks)[0].path.start().clone();
    assert!(apart(&start, &[99.997, 0.003]) < 0.003);
}

#[test]
fn what_cannot_be_contoured_says_so() {
    let job = Job::new(1.0, Trapez);
    let reason = |settings: ContourSettings, paths: Vec<Path>| {
        let count = paths.len();
        let (blocks, notices) = contoured(&job, settings, paths);
        assert_eq!(blocks.len(), count, "the corner stays");
        notices[0].reason
    };
    let right = || corner(90.0).to_vec();
    assert!(matches!(reason(dev(5e-5), right()), NoContour::DeviationTooSmall { .. }));
    let mode = ContourMode::Dist { pre_mm: 0.0, post_mm: 1.0 };
    let short = reason(ContourSettings { mode, ..dev(1.0) }, right());
    assert!(matches!(short, NoContour::DistanceTooSmall { .. }));
    // a needle next to a reversal would take seconds
    for angle_deg in [180.0, 179.999, 179.0] {
        assert_eq!(reason(dev(1.0), corner(angle_deg).to_vec()), NoContour::NotPossible);
    }
    let tiny = vec![line(&[0.0, 0.0], &[1e-4, 0.0]), line(&[1e-4, 0.0], &[1e-4, 1.0])];
    assert_eq!(reason(dev(1.0), tiny), NoContour::BlockTooShort);
    let bounded = ContourSettings { max_angle_deg: 60.0, ..dev(1.0) };
    assert!(matches!(
        reason(bounded, right()),
        NoContour::AngleAboveMaximum { angle_deg } if (angle_deg - 90.0).abs() < 1e-9
    ));
    // DIST_SOFT is contoured, but in another mode
    let mode = ContourMode::DistSoft { path_dist_mm: 2.0 };
    let (blocks, notices) = contoured(&job, ContourSettings { mode, ..dev(1.0) }, right());
    assert_eq!(notices[0].reason, NoContour::ModeReplaced);
    assert!((norm(curves(&blocks)[0].path.start()) - 2.0).abs() < 1e-12);
}

/// Exact stop, speed words and tolerances of the neighbours.
#[test]
fn words_of_the_neighbours() {
    let job = Job::new(1.0, Trapez);
    let [a, b] = corner(90.0);
    let mut stage = Contouring::new(CycleTime::DEFAULT);
    let tolerance = |ax_dev_mm| Tolerance { ax_dev_mm, acc_fact: 1.0 };
    let first = Block {
        contour: Some(dev(1.0)),
        feed: Feed::Duration(2.0),
        tolerance: tolerance(Some(0.02)),
        ..job.block(4, a.clone(), 0.0)
    };
    let second = Block {
        feed_ratio: 0.5,
        tolerance: tolerance(Some(0.01)),
        ..job.block(5, b.clone(), 60.0)
    };
    let mut out: Vec<Block> = stage.push(first, &Kernels::default()).collect();
    out.extend(stage.push(second, &Kernels::default()));
    out.extend(stage.flush());
    assert!(stage.take_notices().is_empty(), "the last block does not ask for contouring");
    assert_eq!(out[0].feed, Feed::PathVelocity(50.0), "G93: the speed of the whole block");
    // each half of the curve has the feed rate of its block
    let mut feeds: Vec<_> = curves(&out).iter().map(|c| (c.feed, c.feed_ratio)).collect();
    feeds.dedup();
    assert_eq!(feeds, [(Feed::PathVelocity(50.0), 1.0), (Feed::PathVelocity(60.0), 0.5)]);
    for curve in curves(&out) {
        assert_eq!(curve.tolerance.ax_dev_mm, Some(0.01));
        assert!(curve.contour.is_none());
    }
    // E: speed at the end of the block, which is inside the curve
    let e = Block {
        contour: Some(dev(1.0)),
        end_velocity_mm_s: Some(5.0),
        ..job.block(0, a.clone(), 60.0)
    };
    let mut out: Vec<Block> = stage.push(e, &Kernels::default()).collect();
    out.extend(stage.push(job.block(1, b.clone(), 60.0), &Kernels::default()));
    assert!(curves(&out).iter().all(|c| c.feed == Feed::PathVelocity(5.0)));
    out.extend(stage.flush());
    // a block without the word keeps its corner
    let plain: Vec<Block> = stage.push(job.block(0, a, 60.0), &Kernels::default()).collect();
    assert_eq!(
        stage.push(job.block(1, b, 60.0), &Kernels::default()).count(),
        1,
        "it is final at once"
    );
    assert!(!is_curve(&plain[0]) && apart(plain[0].path.end(), &[0.0, 0.0]) < 1e-15);
}

/// Slaved axes are rounded with the same polynomial; TRACK_DEV bounds them.
#[test]
fn slaved_axes() {
    let mut dynamics = (*channel(vec![axis(1.0); 3])).clone();
    dynamics.feed_axes = vec![true, true, false];
    let job = Job { dynamics: Arc::new(dynamics), ..Job::new(1.0, Trapez) };
    let path = |from: &[f64], to: &[f64]| job.line(0, from, to, 1.0).path;
    let paths = || {
        [path(&[-20.0, 0.0, 0.0], &[0.0, 0.0, 40.0]), path(&[0.0, 0.0, 40.0], &[0.0, 20.0, 0.0])]
    };
    let (blocks, _) = contoured(&job, dev(1.0), paths());
    assert_smooth(&blocks);
    // C turns from +2 to -2 deg/mm: its deviation is 3/16 d * 4
    let (blocks, _) = contoured(&job, ContourSettings { track_dev_deg: 0.3, ..dev(1.0) }, paths());
    assert_smooth(&blocks);
    let d = -curves(&blocks)[0].path.start()[0];
    assert!((d - 0.4).abs() < 1e-9, "{d}");
    // one block without feed axes: no curve
    let (_, notices) = contoured(
        &job,
        dev(1.0),
        [path(&[-20.0, 0.0, 0.0], &[0.0; 3]), path(&[0.0; 3], &[0.0, 0.0, 90.0])],
    );
    assert_eq!(notices[0].reason, NoContour::NotPossible);
}
