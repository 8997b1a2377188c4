//! With `AX_DEV`, less restrictive settings never take longer.

use crate::common::{contour, points};
use crate::same_time::{Case, Points, dynamics};
use kontur_filters::vib_guard::VibGuardSettings;
use kontur_kit::{Random, count, seed};
use kontur_motion::block::SlopeKind::{Hsc, Sin2, Trapez};

/// Relative increase in time tolerated with a higher feed rate or a larger tolerance.
const BOUND: f64 = 0.01;

/// A monitored contour of equal axes, in cycles of 1 ms; `guard` with `AX_DEV` in mm.
fn case(guard: (VibGuardSettings, f64), axis: (f64, f64, f64), points: Points) -> Case {
    let (weight, acc_mm_s2, ramp_s) = axis;
    Case {
        points,
        axes: vec![dynamics(weight, acc_mm_s2, ramp_s); 3],
        kind: Trapez,
        feed_mm_s: 10.0,
        window: 500,
        cycle_us: 1000,
        guard: Some(guard),
        backwards: false,
        rest_cycles: 0,
    }
}

fn random(r: &mut Random) -> Case {
    let (mode, freq_hz) = (r.pick(&[1, 2, 3, 4]), r.log(10.0, 80.0));
    let guard = VibGuardSettings { mode, freq_hz, damping: r.between(0.0, 0.2) };
    let (kind, feed_mm_s) = (r.pick(&[Hsc, Trapez, Sin2]), r.log(10.0, 100.0));
    let (acc_mm_s2, ramp_s) = (r.log(500.0, 5000.0), r.log(0.01, 0.08));
    let axis = (r.log(1.0, 30.0), acc_mm_s2, ramp_s);
    let tolerance_mm = r.log(0.002, 0.05);
    Case { kind, feed_mm_s, ..case((guard, tolerance_mm), axis, contour(r, 100)) }
}

/// Largest increase of a time over the shortest one before it, beyond one cycle per corner.
fn rises(case: &Case, harder: impl Fn(f64) -> Case) -> f64 {
    let corners = (case.points.len() - 1) as f64;
    let mut best = case.cycles();
    let mut most = 0.0_f64;
    for step in 1..6 {
        let cycles = harder(f64::from(step)).cycles();
        most = most.max((cycles - best - corners) / best);
        best = best.min(cycles);
    }
    most
}

/// The bound is wider than desired, because the search for the blocks to slow down is not an optimum. With other seeds
/// a higher feed rate costs up to 1.4 %, and a larger tolerance 2.1 % (`SEED=5`). `COUNT=200 SEED=7` tests more
/// contours; the results are printed.
#[test]
fn more_feed_or_tolerance() {
    let mut r = Random::from_state(seed());
    for n in 0..count(40) {
        let case = random(&mut r);
        let faster =
            |x: f64| Case { feed_mm_s: case.feed_mm_s * libm::pow(1.6, x), ..case.clone() };
        let looser = |x: f64| case.with(1.0, libm::pow(1.3, x));
        let found = [rises(&case, faster), rises(&case, looser)];
        println!("{n}: {found:.4?}");
        assert!(found.iter().all(|rise| *rise <= BOUND), "{n}: {found:.4?} {case:?}");
    }
}

/// Chords of circles, whose kinks are within reach of each other at one feed rate and not at another: a higher feed
/// rate hardly results in a slower plan (0 is the aim; it was 72 %).
#[test]
fn chords_at_rising_feeds() {
    for (radius, chord) in [(0.6, 0.3), (3.0, 0.5), (10.0, 0.2), (20.0, 1.5)] {
        let count = (5.0 * radius / chord) as usize;
        let turn = |i: usize| chord / radius * i as f64;
        let points: Points = (0..=count)
            .map(|i| [radius * libm::sin(turn(i)), radius * (1.0 - libm::cos(turn(i))), 0.0])
            .collect();
        for (mode, freq_hz) in [(1, 53.0), (2, 20.0), (3, 35.0), (4, 15.0)] {
            for kind in [Hsc, Trapez, Sin2] {
                let guard = VibGuardSettings { mode, freq_hz, damping: 0.04 };
                let case =
                    Case { kind, ..case((guard, 0.012), (11.0, 4000.0, 0.018), points.clone()) };
                let faster = |x: f64| Case { feed_mm_s: 10.0 * libm::pow(1.6, x), ..case.clone() };
                let rise = rises(&case, faster);
                assert!(rise <= 0.03, "r {radius} {mode} {kind:?}: {rise:.4}");
            }
        }
    }
}

/// A long line, a block of 0.07 mm and a sharp corner after it: the corner between them was missed because the dwell
/// there was too short, and for this reason the line was driven at 3 mm/s.
#[test]
fn a_rest_that_is_too_short_slows_no_line_down() {
    let points = points(
        "0 0 0; -14.6754 -5.5062 -1.2333; -14.9406 -5.4449 -1.2742; -20.0077 -5.1506 -1.9478; -21.6876 -5.6454 -1.8057; \
         -29.8923 -3.3343 -3.4580; -29.8326 -3.3053 -3.4451; -29.8045 -4.1591 -3.3083; -29.8852 -4.5249 -3.2363; \
         -29.9577 -4.4387 -3.2279; -30.0175 -4.1902 -3.1920; -21.2777 -1.8343 -1.6285; -7.8871 -1.2411 -0.2678; \
         -7.5097 -1.0943 -0.2444; -7.6105 -1.2908 -0.2242",
    );
    let points = points.iter().map(|p| [p[0], p[1], p[2]]).collect();
    let guard = VibGuardSettings { mode: 4, freq_hz: 17.211, damping: 0.023 };
    let case = case((guard, 0.007), (4.7, 4695.3, 0.024), points);
    let case = Case { feed_mm_s: 85.516, ..case };
    let [cycles, loose] = [case.cycles(), case.with(1.0, 2.0).cycles()];
    assert!(cycles <= 1.5 * loose, "{cycles} cycles, {loose} with twice the tolerance");
}
