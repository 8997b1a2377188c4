//! Ripple of the acceleration on circles of chords, with and without the spline.

use super::*;

/// Relative spread of the path speed away from start and stop.
fn ripple(out: &[Setpoint]) -> f64 {
    let middle = out[out.len() / 5..4 * out.len() / 5].iter().map(|s| s.v_mm_s);
    let high = middle.clone().fold(0.0, f64::max);
    (high - middle.fold(f64::INFINITY, f64::min)) / high
}

/// A polygonised circle of 10 mm: with the spline the speed is constant at half the admissible speed and, if the
/// look-ahead covers the braking distance, also at its limit; so it is with the smallest tolerance that leaves the spline as it
/// is, `h^2 / (6 r)`.
#[test]
fn ripple_on_a_circle_with_the_spline() {
    for kind in [Hsc, Trapez] {
        let job = machine(kind);
        for chord in [0.05, 0.1, 0.2, 0.5, 1.0, 2.0] {
            let points = circle(10.0, chord);
            for path_dev_mm in
                [SplineSettings::default().path_dev_mm, natural(chord) * (1.0 + 1e-3)]
            {
                for feed in [50.0, 100.0] {
                    let r = ripple(&driven(&job, path_dev_mm, &points, feed));
                    println!(
                        "{kind:?} chord {chord} {path_dev_mm} F {feed}: ripple {:.4} %",
                        100.0 * r
                    );
                    assert!(r < 0.01, "{kind:?} chord {chord} {path_dev_mm} F {feed}: {r}");
                }
            }
        }
    }
}

/// Deviation of the spline at the corners of a circle of 10 mm, all knots even: a sixth of an edge times the change of
/// direction.
fn natural(chord: f64) -> f64 {
    let n = libm::round(2.0 * std::f64::consts::PI * 10.0 / chord);
    let half = libm::sin(std::f64::consts::PI / n);
    20.0 * half * 2.0 * half / 6.0
}

/// Tolerances around `h^2 / (6 r)`, more than half of the sagitta, and below it: none is exceeded, in neither direction,
/// and a smaller one never shortens the run.
#[test]
fn a_small_tolerance_on_a_circle() {
    let job = machine(Hsc);
    for chord in [0.5, 2.0] {
        let points = circle(10.0, chord);
        let mut last = 0;
        for share in [2.0, 1.001, 0.999, 0.9, 0.75, 0.6, 0.5, 0.4, 0.3, 0.25, 0.201, 0.199, 0.1] {
            let path_dev_mm = natural(chord) * share;
            let settings = SplineSettings { path_dev_mm, ..SplineSettings::default() };
            let (blocks, sharp) = splined_and_sharp(&job, settings, &points, 300.0);
            let (out, missed) = strays(&blocks, &points);
            assert!(out <= path_dev_mm * (1.0 + 1e-9), "{chord} {share}: {out}");
            assert!(missed <= path_dev_mm * (1.0 + 1e-9), "{chord} {share}: {missed}");
            assert!(gaps(&blocks, &sharp)[2] < 1e-6);
            let cycles = job.run(&points[0], blocks.into_iter()).len();
            println!("chord {chord} share {share}: {cycles} cycles, {missed}");
            assert!(cycles >= last, "{chord} {share}: {cycles} after {last}");
            last = cycles;
        }
    }
}

/// The same with P-CHAN-00245 alone, up to chords of one cycle: the estimated curvature replaces the kinks.
#[test]
fn ripple_on_a_circle_with_estimated_curvature() {
    for kind in [Hsc, Trapez] {
        let mut job = machine(kind);
        Arc::make_mut(&mut job.dynamics).curvature_estimate = 3;
        for (chord, feed) in [(0.05, 50.0), (0.1, 50.0), (0.2, 50.0), (0.05, 500.0), (0.1, 500.0)] {
            let points = circle(10.0, chord);
            let r = ripple(&job.drive(&points, &[feed]));
            println!("{kind:?} chord {chord} F {feed}: ripple {:.4} %", 100.0 * r);
            assert!(r < 0.01, "{kind:?} chord {chord} F {feed}: {r}");
        }
    }
}
