//! Blocks end where the spline is nearest to their programmed points.

use super::*;
use kontur_motion::block::Feed;
use kontur_motion::tolerance::Kernels;

/// Kinks of up to 3 degrees between edges of 0.3 to 30 mm.
const LONG: Shape = (|u| 0.3 * libm::pow(100.0, u), |u| 0.1 * (u - 0.5));

/// Every fifth point is doubled at a distance of 0.5 to 2.5 um.
fn doubled(points: &[Vec<f64>], seed: u64) -> Vec<Vec<f64>> {
    let mut random = Random::from_state(seed);
    let mut out = Vec::new();
    for w in points.windows(2) {
        out.push(w[0].clone());
        if random.ratio() < 0.2 {
            let (h, step) = (apart(&w[0], &w[1]), 5e-4 + 2e-3 * random.ratio());
            out.push(w[0].iter().zip(&w[1]).map(|(p, q)| p + (q - p) * step / h).collect());
        }
    }
    out.extend(points.last().cloned());
    out
}

/// Distance in mm of the ends of blocks from their programmed points beyond that of the spline over both blocks there.
fn misplaced(blocks: &[Block], points: &[Vec<f64>]) -> f64 {
    let mut worst = 0.0_f64;
    let own: Vec<&[Block]> = blocks.chunk_by(|a, b| a.seq == b.seq).collect();
    for (pair, point) in own.windows(2).zip(&points[1..]) {
        let end = pair[0].last().map_or(f64::INFINITY, |b| apart(b.path.end(), point));
        let mut least = f64::INFINITY;
        for block in pair.iter().flat_map(|blocks| blocks.iter()) {
            let length = block.path.length();
            let distance = |s: f64| apart(&at(&block.path, s.clamp(0.0, length)), point);
            // samples, and more around the best one
            let (mut best, mut step) = (0.5 * length, 0.5 * length / 200.0);
            for _ in 0..3 {
                let places = (-200..=200).map(|k| best + step * f64::from(k));
                let nearer = |a: &f64, b: &f64| distance(*a).total_cmp(&distance(*b));
                best = places.min_by(nearer).unwrap_or(best).clamp(0.0, length);
                step /= 100.0;
            }
            least = least.min(distance(best));
        }
        worst = worst.max(end - least);
    }
    worst
}

#[test]
fn blocks_end_next_to_their_points() {
    let job = Job::new(1.0, Hsc);
    for seed in 0..40 {
        let shape = [LONG, GENTLE, ROUGH, EVEN][seed as usize % 4];
        let count = 2 + seed as usize % 7;
        let points = polygon(shape, seed, count);
        for points in [doubled(&points, seed), points] {
            for path_dev_mm in [0.0, 0.02, 0.2] {
                let settings = SplineSettings { path_dev_mm, ..SplineSettings::default() };
                let (blocks, sharp) = splined_and_sharp(&job, settings, &points, 50.0);
                let worst = misplaced(&blocks, &points);
                // points are passed over within 3 um
                assert!(worst < 3e-3, "{seed} {path_dev_mm}: {worst}");
                let [position, tangent, _] = gaps(&blocks, &sharp);
                assert!(position < 1e-11 && tangent < 1e-9, "{seed}: {position} {tangent}");
                for path in blocks.iter().map(|block| &block.path) {
                    let s = 1e-6 * path.length();
                    let near = at(path, s);
                    assert!(apart(path.start(), &near) < 1e-3, "{seed}: {:?}", path.start());
                }
            }
        }
    }
}

/// The end of a block moves into its neighbours: its duration remains.
#[test]
fn a_programmed_duration_is_kept() {
    let job = Job::new(1.0, Hsc);
    for seed in 0..20 {
        let points = doubled(&polygon(LONG, seed, 6), seed);
        let mut stage = Splining::new(CycleTime::DEFAULT);
        let mut out = Vec::new();
        for (ends, seq) in points.windows(2).zip(0..) {
            let (spline, feed) =
                (Some(SplineSettings::default()), Feed::Duration(1.0 + seq as f64));
            let block = Block { spline, feed, ..job.line(seq, &ends[0], &ends[1], 1.0) };
            out.extend(stage.push(block, &Kernels::default()));
        }
        out.extend(stage.flush(&Kernels::default()));
        for own in out.chunk_by(|a, b| a.seq == b.seq) {
            let seconds = |b: &Block| if let Feed::Duration(t) = b.feed { t } else { f64::NAN };
            let (sum, expected) = (own.iter().map(seconds).sum::<f64>(), 1.0 + own[0].seq as f64);
            assert!((sum - expected).abs() < 1e-12, "{seed} {}: {sum}", own[0].seq);
        }
    }
}
