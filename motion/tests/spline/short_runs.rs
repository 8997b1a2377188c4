//! Runs of few blocks, which are planned as a whole: the fastest spline within the tolerance is used.

use super::*;
use kontur_motion::tolerance::Kernels;

/// 2 to 12 edges of 0.2 to 8 mm.
fn few_edges(random: &mut Random) -> Vec<Vec<f64>> {
    let spread = random.pick(&[0.2, 0.6, 1.5]);
    let mut pen = Pen { heading: random.between(-3.0, 3.0), ..Pen::default() };
    let mut points = vec![pen.at.to_vec()];
    for _ in 0..2 + random.below(11) {
        points.push(pen.go(random.log(0.2, 8.0)).to_vec());
        pen.heading += spread * random.normal();
    }
    points
}

fn cycles(job: &Job, points: &[Vec<f64>], path_dev_mm: f64, feed: f64) -> usize {
    driven(job, path_dev_mm, points, feed).len()
}

/// From rest to rest the sharp polygon is one of the candidates: no spline is slower, up to the thousandth that a
/// closer spline has to save and to one cycle. `COUNT` raises the number of polygons.
#[test]
fn a_short_spline_is_not_slower_than_its_polygon() {
    let mut random = Random::from_state(31);
    for i in 0..environment("COUNT", 24) {
        let job = machine(if i % 2 == 0 { Hsc } else { Trapez });
        let points = few_edges(&mut random);
        let feed = random.pick(&[25.0, 100.0, 250.0]);
        let sharp = job.drive(&points, &[feed]).len();
        for path_dev_mm in [0.005, 0.03, 0.2, 1.0] {
            let round = cycles(&job, &points, path_dev_mm, feed);
            assert!(round <= sharp + sharp / 500 + 1, "{i} {path_dev_mm}: {round} of {sharp}");
        }
    }
}

/// The run of the issue that asks for this: the spline with all of the tolerance took 154, 186, 173, 129 and 173 cycles.
#[test]
fn a_larger_tolerance_is_not_slower_between_edges_of_unequal_length() {
    let job = machine(Hsc);
    let points = [[0.0, 0.0], [2.0, 0.0], [2.5, 0.1], [7.0, 0.1]].map(|p| p.to_vec());
    let times = [0.05, 0.08, 0.1, 0.15, 0.2].map(|d| cycles(&job, &points, d, 100.0));
    assert!(times.windows(2).all(|t| t[1] <= t[0] + t[0] / 100), "{times:?}");
}

/// Of any two tolerances the larger one is hardly ever slower: the series of limits is the same for both, and only the
/// smaller tolerance itself need not be one of them. With the whole tolerance, every fifth polygon took more than 2 %
/// longer with one of these.
#[test]
fn a_larger_tolerance_is_rarely_slower_on_a_short_run() {
    let mut random = Random::from_state(5);
    let count = environment("COUNT", 40);
    let job = machine(Hsc);
    let mut slower = 0;
    for _ in 0..count {
        let points = few_edges(&mut random);
        let feed = random.pick(&[25.0, 100.0, 250.0]);
        let mut least = usize::MAX;
        let mut is_slower = false;
        for i in 0..12 {
            let path_dev_mm = 0.005 * libm::pow(1.5, f64::from(i) + random.ratio());
            let now = cycles(&job, &points, path_dev_mm, feed);
            is_slower |= now > least.saturating_add(least / 50 + 1);
            least = least.min(now);
        }
        slower += u64::from(is_slower);
    }
    assert!(slower * 12 <= count, "{slower} of {count}");
}

/// The block before a run that does not rest there counts, and so does the one behind it: with them the spline is not
/// slower than the polygon.
#[test]
fn a_short_spline_between_other_blocks() {
    let mut random = Random::from_state(77);
    for i in 0..24 {
        let job = machine(Hsc);
        let points = few_edges(&mut random);
        let feed = random.pick(&[25.0, 100.0, 250.0]);
        let settings = SplineSettings { path_dev_mm: 0.1, ..SplineSettings::default() };
        let lines = points.windows(2).zip(0..);
        let lines: Vec<Block> =
            lines.map(|(ends, seq)| job.line(seq, &ends[0], &ends[1], feed)).collect();
        let (first, last) = (1.min(lines.len() - 1), lines.len() - 1);
        let (mut stage, kernels) = (Splining::new(CycleTime::DEFAULT), Kernels::default());
        let mut out: Vec<Block> = lines[..first].to_vec();
        stage.begin_behind(&lines[first - 1]);
        for block in &lines[first..last] {
            out.extend(stage.push(Block { spline: Some(settings), ..block.clone() }, &kernels));
        }
        out.extend(stage.push(lines[last].clone(), &kernels));
        out.extend(stage.flush(&kernels));
        let sharp = job.run(&points[0], lines.into_iter()).len();
        let round = job.run(&points[0], out.into_iter()).len();
        assert!(round <= sharp + sharp / 500 + 1, "{i}: {round} of {sharp}");
    }
}
