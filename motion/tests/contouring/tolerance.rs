//! Effects that a larger tolerance of contouring must not have, and the tolerance of the axes on curves.

use super::{contoured_at, dev};
use crate::common::{Job, at, deviation, filtered, line, peaks};
use kontur_kit::{Pen, Random, environment};
use kontur_motion::block::ContourSettings;
use kontur_motion::block::SlopeKind::{Hsc, Sin2, Step, Trapez};

/// Setpoints of a contoured polygon, and the peaks of their differences.
fn driven(
    job: &Job,
    settings: ContourSettings,
    points: &[[f64; 2]],
    feed: f64,
) -> (usize, f64, f64) {
    let paths = points.windows(2).map(|ends| line(&ends[0], &ends[1]));
    let (blocks, _) = contoured_at(feed, job, settings, paths);
    peaks(&job.run(&points[0], blocks.into_iter()), job.cycle_us)
}

/// No axis is loaded beyond what the curve (`a`, `a / tr_geom`) and the change of path speed (`a`, `a / t`) may use together, and a larger
/// tolerance costs no time. Times of random contours: `contour_time`.
#[test]
fn a_larger_tolerance_loads_no_axis_more() {
    let shapes: [&[[f64; 2]]; 3] = [
        &[[0.0, 0.0], [30.0, 0.0], [30.0, 30.0], [0.0, 30.0], [0.0, 0.0]],
        &[[0.0, 0.0], [20.0, 0.0], [3.0, 5.0], [25.0, 9.0], [40.0, 3.0]],
        &[[0.0, 0.0], [5.0, 1.0], [10.0, 0.0], [15.0, 3.0], [15.0, 8.0], [8.0, 12.0]],
    ];
    for kind in [Trapez, Sin2, Hsc, Step] {
        let step = kind == Step;
        let (acc, jerk) = if step { (2000.0, 2e6) } else { (1500.0, 100_000.0 + 20_000.0 * 1.571) };
        for points in shapes {
            let mut job = Job::new(0.0, kind);
            job.slope.optimised = !step;
            let mut last = driven(&job, dev(0.001), points, 100.0);
            for eps in [0.01, 0.05, 0.2, 1.0] {
                let now = driven(&job, dev(eps), points, 100.0);
                assert!(now.0 <= last.0, "{kind:?} {eps}: {now:?} after {last:?}");
                assert!(now.1 <= last.1.max(acc), "{kind:?} {eps}: {now:?} after {last:?}");
                assert!(now.2 <= last.2.max(jerk), "{kind:?} {eps}: {now:?} after {last:?}");
                last = now;
            }
        }
    }
}

/// `AX_DEV` applies on curves as on arcs: the filtered setpoints stay within it of the contoured path.
#[test]
fn tolerance_monitoring_on_curves() {
    let points = [[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0], [0.0, 20.0]];
    for kind in [Trapez, Hsc] {
        let mut worst = [0.0; 2];
        for (tolerance, worst) in [None, Some(0.01)].into_iter().zip(&mut worst) {
            let job = Job::new(1.0, kind).guarded(2, 20.0, 0.05, tolerance);
            let paths = points.windows(2).map(|ends| line(&ends[0], &ends[1]));
            let (blocks, _) = contoured_at(1000.0, &job, dev(1.0), paths);
            let mut polygon = Vec::new();
            for b in &blocks {
                let l = b.path.length();
                polygon.extend((0..400).map(|k| at(&b.path, l * f64::from(k) / 400.0)));
            }
            polygon.push(blocks[blocks.len() - 1].path.end().to_vec());
            let out = job.run(&points[0], blocks.into_iter());
            let set = filtered(&out, &job.kernels);
            *worst = set.iter().step_by(5).map(|p| deviation(p, &polygon)).fold(0.0, f64::max);
        }
        assert!(worst[0] > 0.02, "{kind:?}: the filter cuts the curves: {worst:?}");
        assert!(worst[1] <= 0.01 + 1e-4, "{kind:?}: {worst:?}");
    }
}

/// Under `AX_DEV` a stop at a corner may take less time than any curve within the tolerance: rounded polygons take no longer
/// than sharp ones.
#[test]
fn rounding_costs_no_time_under_ax_dev() {
    let count = environment("COUNT", 4);
    let mut random = Random::from_state(17);
    for program in 0..count {
        let mut pen = Pen::default();
        let edge = 0.3 * libm::pow(50.0, random.ratio());
        let mut points = vec![pen.at];
        for _ in 0..3 {
            points.push(pen.go(edge * (0.4 + 1.2 * random.ratio())));
            let turn = 20.0 + 140.0 * random.ratio();
            let turn = if random.ratio() < 0.5 { -turn } else { turn }.to_radians();
            // in every other pair of programs corners are cut off by an edge that the curve bridges
            if program % 4 > 1 {
                pen.heading += 0.5 * turn;
                points.push(pen.go(0.03));
                pen.heading += 0.5 * turn;
            } else {
                pen.heading += turn;
            }
        }
        for (mode, freq_hz, ax_dev_mm) in [(2, 40.0, 0.01), (3, 20.0, 0.003), (1, 15.0, 0.02)] {
            let job = Job::new(1.0, if program % 2 == 0 { Hsc } else { Trapez });
            let mut job = job.guarded(mode, freq_hz, 0.1, Some(ax_dev_mm));
            job.slope.optimised = true;
            let sharp = ContourSettings { max_angle_deg: 0.0, ..dev(1.0) };
            let sharp = driven(&job, sharp, &points, 60.0).0;
            for eps in [0.01, 0.1] {
                let settings = ContourSettings { relevant_path_mm: 0.05, ..dev(eps) };
                let round = driven(&job, settings, &points, 60.0).0;
                let most = sharp + sharp / 200 + 2;
                assert!(round <= most, "{program} mode {mode} {eps}: {round} of {sharp} cycles");
            }
        }
    }
}
