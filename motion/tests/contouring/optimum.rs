//! Machine time over contoured corners compared with the jerk-limited optimum on the same curves.
//!
//! `data/contoured.csv` is made by `reference/contoured.py`, by convex programming on its own form of the curve; it
//! shares no code with the planner.

use super::*;
use crate::optimum::{CYCLE_US, Row, table};
use kontur_motion::block::SlopeKind::{self, Hsc};

/// Machine time over the least one; `None` if a corner keeps its kink, which is faster there than its curve.
fn ratio(row: &Row, kind: SlopeKind) -> Option<f64> {
    let job =
        Job { dynamics: channel(row.axes.clone()), cycle_us: CYCLE_US, ..Job::new(1.0, kind) };
    let paths = row.points.windows(2).map(|ends| line(&ends[0], &ends[1]));
    let (blocks, _) = contoured_at(row.feeds[0], &job, dev(row.path_dev_mm), paths);
    let kinks = blocks.windows(2).any(|w| {
        let [a, b] = [&w[0].path, &w[1].path];
        apart(&tangent(a, a.length()), &tangent(b, 0.0)) > 1e-6
    });
    let cycles = job.run(&row.points[0], blocks.into_iter()).len() - 1;
    (!kinks).then(|| row.ratio(cycles))
}

#[test]
fn contoured_corners_are_close_to_the_optimum() {
    let rows = table(include_str!("../data/contoured.csv"), 1.0);
    // between two curves the optimum enters and leaves more slowly than the curves permit, with acceleration left; the
    // planner passes only single boundaries that way
    let (most, typical) = (1.06, 1.025);
    for kind in [Hsc, Trapez] {
        let mut ratios = Vec::new();
        for row in &rows {
            let Some(ratio) = ratio(row, kind) else { continue };
            println!("{kind:?} {ratio:.4} {}", row.name);
            assert!(ratio > 0.995, "{} {kind:?}: {ratio} of the optimum", row.name);
            ratios.push((ratio, &row.name));
        }
        assert!(2 * ratios.len() > rows.len(), "{} of {}", ratios.len(), rows.len());
        ratios.sort_by(|a, b| a.0.total_cmp(&b.0));
        let (median, last) = (ratios[ratios.len() / 2].0, ratios[ratios.len() - 1]);
        println!("{kind:?}: median {median:.4}, at most {:.4}", last.0);
        assert!(last.0 <= most, "{} {kind:?}: {} times the optimum", last.1, last.0);
        assert!(median <= typical, "{kind:?}: {median}");
    }
}
