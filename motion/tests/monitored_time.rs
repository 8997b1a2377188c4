//! With `AX_DEV`, less restrictive settings never take longer.

use crate::common::{Job, axis, channel, contour};
use kontur_filters::time::CycleTime;
use kontur_filters::vib_guard::VibGuardSettings;
use kontur_kit::{Random, count, seed};
use kontur_motion::axis::{AxisDynamics, FeedSlope};
use kontur_motion::block::SlopeKind::{self, Hsc, Sin2, Trapez};
use kontur_motion::block::Tolerance;

const CYCLE_US: u32 = 1000;

/// Relative increase in time tolerated with a higher feed rate or a larger tolerance.
const BOUND: f64 = 0.01;

type Points = Vec<[f64; 3]>;

#[derive(Clone, Debug)]
struct Case {
    kind: SlopeKind,
    feed_mm_s: f64,
    acc_mm_s2: f64,
    ramp_s: f64,
    kink_weight: f64,
    guard: VibGuardSettings,
    tolerance: Tolerance,
    points: Points,
}

impl Case {
    fn new(r: &mut Random) -> Self {
        let guard = VibGuardSettings {
            mode: 1 + (4.0 * r.ratio()) as u8,
            freq_hz: r.log(10.0, 80.0),
            damping: 0.2 * r.ratio(),
        };
        Self {
            kind: r.pick(&[Hsc, Trapez, Sin2]),
            feed_mm_s: r.log(10.0, 100.0),
            acc_mm_s2: r.log(500.0, 5000.0),
            ramp_s: r.log(0.01, 0.08),
            kink_weight: r.log(1.0, 30.0),
            guard,
            tolerance: Tolerance { ax_dev_mm: Some(r.log(0.002, 0.05)), acc_fact: 1.0 },
            points: contour(r, 100),
        }
    }

    fn cycles(&self) -> usize {
        let feed = FeedSlope {
            acc_mm_s2: self.acc_mm_s2,
            dec_mm_s2: self.acc_mm_s2,
            ramps_s: [self.ramp_s; 4],
        };
        let axes = vec![AxisDynamics { feed, ..axis(self.kink_weight) }; 3];
        let mut job = Job {
            dynamics: channel(axes),
            cycle_us: CYCLE_US,
            window: 500,
            tolerance: self.tolerance,
            ..Job::new(1.0, self.kind)
        };
        job.kernel = Some(self.guard.kernel(CycleTime::from_us(CYCLE_US).unwrap()).unwrap());
        let points: Vec<&[f64]> = self.points.iter().map(|p| &p[..]).collect();
        job.drive(&points, &[self.feed_mm_s]).len() - 1
    }
}

/// Largest increase of a time over the shortest one before it, beyond one cycle per corner.
fn rises(case: &Case, harder: impl Fn(f64) -> Case) -> f64 {
    let corners = case.points.len() - 1;
    let mut best = case.cycles();
    let mut most = 0.0_f64;
    for step in 1..6 {
        let cycles = harder(f64::from(step)).cycles();
        most = most.max((cycles as f64 - (best + corners) as f64) / best as f64);
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
        let case = Case::new(&mut r);
        let faster =
            |x: f64| Case { feed_mm_s: case.feed_mm_s * libm::pow(1.6, x), ..case.clone() };
        let looser = |x: f64| {
            let ax_dev_mm = case.tolerance.ax_dev_mm.map(|mm| mm * libm::pow(1.3, x));
            Case { tolerance: Tolerance { ax_dev_mm, ..case.tolerance }, ..case.clone() }
        };
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
                let case = Case {
                    kind,
                    feed_mm_s: 10.0,
                    acc_mm_s2: 4000.0,
                    ramp_s: 0.018,
                    kink_weight: 11.0,
                    guard: VibGuardSettings { mode, freq_hz, damping: 0.04 },
                    tolerance: Tolerance { ax_dev_mm: Some(0.012), acc_fact: 1.0 },
                    points: points.clone(),
                };
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
    let case = Case {
        kind: Trapez,
        feed_mm_s: 85.516,
        acc_mm_s2: 4695.3,
        ramp_s: 0.024,
        kink_weight: 4.7,
        guard: VibGuardSettings { mode: 4, freq_hz: 17.211, damping: 0.023 },
        tolerance: Tolerance { ax_dev_mm: Some(0.007), acc_fact: 1.0 },
        points: vec![
            [0.0, 0.0, 0.0],
            [-14.6754, -5.5062, -1.2333],
            [-14.9406, -5.4449, -1.2742],
            [-20.0077, -5.1506, -1.9478],
            [-21.6876, -5.6454, -1.8057],
            [-29.8923, -3.3343, -3.4580],
            [-29.8326, -3.3053, -3.4451],
            [-29.8045, -4.1591, -3.3083],
            [-29.8852, -4.5249, -3.2363],
            [-29.9577, -4.4387, -3.2279],
            [-30.0175, -4.1902, -3.1920],
            [-21.2777, -1.8343, -1.6285],
            [-7.8871, -1.2411, -0.2678],
            [-7.5097, -1.0943, -0.2444],
            [-7.6105, -1.2908, -0.2242],
        ],
    };
    let twice = Tolerance { ax_dev_mm: Some(0.014), ..case.tolerance };
    let [cycles, loose] = [case.cycles(), Case { tolerance: twice, ..case }.cycles()];
    assert!(2 * cycles <= 3 * loose, "{cycles} cycles, {loose} with twice the tolerance");
}
