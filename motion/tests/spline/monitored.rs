//! Corners of a spline under `AX_DEV`.

use super::*;

/// Straight lines in chords of 0.1 to 0.6 mm, with corners of 30 to 140 degrees between them.
fn lines(seed: u64) -> Vec<Vec<f64>> {
    let mut random = Random::from_state(seed);
    let mut pen = Pen::default();
    let mut points = vec![pen.at.to_vec()];
    for _ in 0..3 {
        let chord = 0.1 + 0.5 * random.ratio();
        for _ in 0..5 + (6.0 * random.ratio()) as usize {
            points.push(pen.go(chord).to_vec());
        }
        let side = if random.ratio() < 0.5 { -1.0 } else { 1.0 };
        pen.heading += side * (30.0 + 110.0 * random.ratio()).to_radians();
    }
    points
}

fn guarded(kind: SlopeKind, (mode, freq_hz): (u8, f64), ax_dev_mm: Option<f64>) -> Job {
    let mut job = Job::new(1.0, kind).guarded(mode, freq_hz, 0.1, ax_dev_mm);
    job.slope.optimised = kind == Trapez;
    job
}

/// The spline through these points takes no longer than the polygon, at whose corners the path may stop until the filters
/// have settled.
fn costs_no_time(name: &str, job: &Job, points: &[Vec<f64>], tolerances_mm: [f64; 2]) {
    let sharp = job.drive(points, &[50.0]).len();
    for path_dev_mm in tolerances_mm {
        let round = driven(job, path_dev_mm, points, 50.0).len();
        let most = sharp + sharp / 200 + 1;
        assert!(round <= most, "{name} {path_dev_mm}: {round} of {sharp} cycles");
    }
}

#[test]
fn rounding_costs_no_time_under_ax_dev() {
    let count = environment("COUNT", 2);
    for (kind, freq_hz, ax_dev_mm) in [(Hsc, 40.0, 0.01), (Trapez, 25.0, 0.005)] {
        let job = guarded(kind, (2, freq_hz), Some(ax_dev_mm));
        for seed in 300..300 + count {
            costs_no_time(&format!("{kind:?} {seed}"), &job, &lines(seed), [0.01, 0.1]);
        }
    }
}

/// The same at single corners between edges of equal length, from nearly straight to nearly reversed.
#[test]
fn rounding_a_single_corner_costs_no_time_under_ax_dev() {
    for (guard, ax_dev_mm) in [((3, 25.0), 0.002), ((2, 40.0), 0.01), ((1, 15.0), 0.02)] {
        let job = guarded(Hsc, guard, Some(ax_dev_mm));
        for (edge, degrees) in [(3.0, 8.0), (3.0, 45.0), (12.0, 14.0), (12.0, 90.0), (12.0, 140.0)]
        {
            let (sin, cos) = libm::sincos(f64::to_radians(degrees));
            let points =
                [[0.0, 0.0], [edge, 0.0], [edge + edge * cos, edge * sin]].map(|p| p.to_vec());
            let name = format!("{guard:?} {edge} {degrees}");
            costs_no_time(&name, &job, &points, [0.02, 0.1]);
        }
    }
}

/// A tolerance that no corner could exceed changes nothing.
#[test]
fn a_large_ax_dev_keeps_every_curve() {
    for shape in [ROUGH, GENTLE, EVEN, SQUARES] {
        for seed in 0..5 {
            let points = polygon(shape, seed, 60);
            let settings = SplineSettings { path_dev_mm: 0.05, ..SplineSettings::default() };
            let blocks = |ax_dev_mm: Option<f64>| {
                let job = guarded(Hsc, (2, 40.0), ax_dev_mm);
                let blocks = splined(&job, settings, &points, 50.0);
                blocks.iter().map(|b| (b.seq, b.path.length().to_bits())).collect::<Vec<_>>()
            };
            assert!(blocks(None) == blocks(Some(100.0)), "{seed}");
        }
    }
}
