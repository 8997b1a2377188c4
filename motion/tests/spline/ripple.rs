//! Ripple of the acceleration on circles of chords, with and without the spline.

use super::*;

/// Relative spread of the path speed away from start and stop.
fn ripple(out: &[Setpoint]) -> f64 {
    let middle = &out[out.len() / 5..4 * out.len() / 5];
    let (mut low, mut high) = (f64::INFINITY, 0.0_f64);
    for s in middle {
        low = low.min(s.v_mm_s);
        high = high.max(s.v_mm_s);
    }
    (high - low) / high
}

/// A polygonised circle of 10 mm: with the spline the speed is constant at half the admissible speed and, if the
/// look-ahead covers the braking distance, also at its limit. TRAPEZ with NO_OPT=0; without it every acceleration ends
/// at a block boundary, and the speed is not constant at the limit.
#[test]
fn ripple_on_a_circle_with_the_spline() {
    for kind in [Hsc, Trapez] {
        // 120 chords of 0.05 mm are shorter than the braking distance from 100 mm/s (7.5 mm)
        let mut job = Job { window: 400, ..Job::new(1.0, kind) };
        job.slope.optimised = kind == Trapez;
        for chord in [0.05, 0.1, 0.2, 0.5, 1.0, 2.0] {
            let points = circle(10.0, chord);
            for feed in [50.0, 100.0] {
                let blocks = splined(&job, SplineSettings::default(), &points, feed);
                let out = job.run(&points[0], blocks.into_iter());
                let r = ripple(&out);
                println!("{kind:?} chord {chord} F {feed}: ripple {:.4} %", 100.0 * r);
                assert!(r < 0.01, "{kind:?} chord {chord} F {feed}: {r}");
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

/// The same with the smallest tolerance that leaves the spline as it is, `h^2 / (6 r)`.
#[test]
fn ripple_on_a_circle_with_the_least_tolerance() {
    let mut job = Job { window: 400, ..Job::new(1.0, Hsc) };
    job.slope.optimised = true;
    for chord in [0.05, 0.2, 0.5, 1.0, 2.0] {
        let points = circle(10.0, chord);
        let path_dev_mm = natural(chord) * (1.0 + 1e-3);
        let settings = SplineSettings { path_dev_mm, ..SplineSettings::default() };
        for feed in [50.0, 100.0] {
            let blocks = splined(&job, settings, &points, feed);
            let r = ripple(&job.run(&points[0], blocks.into_iter()));
            println!("chord {chord} F {feed}: ripple {:.4} %", 100.0 * r);
            assert!(r < 0.01, "chord {chord} F {feed}: {r}");
        }
    }
}

/// Tolerances around `h^2 / (6 r)`, more than half of the sagitta, and below it: none is exceeded, in neither direction,
/// and a smaller one never shortens the run.
#[test]
fn a_small_tolerance_on_a_circle() {
    let mut job = Job { window: 400, ..Job::new(1.0, Hsc) };
    job.slope.optimised = true;
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
        let mut dynamics: ChannelDynamics = (*channel(vec![axis(1.0); 2])).clone();
        dynamics.curvature_estimate = 3;
        let mut job = Job { dynamics: Arc::new(dynamics), window: 400, ..Job::new(1.0, kind) };
        job.slope.optimised = kind == Trapez;
        for (chord, feed) in [(0.05, 50.0), (0.1, 50.0), (0.2, 50.0), (0.05, 500.0), (0.1, 500.0)] {
            let points = circle(10.0, chord);
            let r = ripple(&job.drive(&points, &[feed]));
            println!("{kind:?} chord {chord} F {feed}: ripple {:.4} %", 100.0 * r);
            assert!(r < 0.01, "{kind:?} chord {chord} F {feed}: {r}");
        }
    }
}
