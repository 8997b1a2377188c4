//! Under `AX_DEV` the time of a contour does not depend on irrelevant differences.
//!
//! `COUNT=200 SEED=7 cargo test --release -p kontur-motion --test all same_time_kept -- --nocapture` tests more
//! contours and prints the differences between their forms.

use crate::common::{Job, axis, channel, contour};
use kontur_filters::kernel::Kernel;
use kontur_filters::time::CycleTime;
use kontur_filters::vib_guard::VibGuardSettings;
use kontur_kit::{Random, environment};
use kontur_motion::axis::{AxisDynamics, FeedSlope};
use kontur_motion::block::SlopeKind::{self, Hsc, Sin2, Step, Trapez};
use kontur_motion::block::Tolerance;

const CYCLE_US: u32 = 500;
const CYCLE_S: f64 = 5e-4;

type Points = Vec<[f64; 3]>;

#[derive(Debug)]
struct Case {
    points: Points,
    axes: AxisDynamics,
    kind: SlopeKind,
    feed_mm_s: f64,
    guard: VibGuardSettings,
    tolerance_mm: f64,
}

impl Case {
    fn new(r: &mut Random) -> Self {
        let acc = r.log(1000.0, 8000.0);
        let ramps_s = [r.log(0.005, 0.05); 4];
        let feed = FeedSlope { acc_mm_s2: acc, dec_mm_s2: acc, ramps_s };
        Self {
            points: contour(r, 100),
            axes: AxisDynamics { feed, ..axis(1.0) },
            kind: r.pick(&[Step, Trapez, Sin2, Hsc]),
            feed_mm_s: r.log(8.0, 330.0),
            guard: VibGuardSettings {
                mode: r.pick(&[1, 2, 3, 4]),
                freq_hz: r.log(10.0, 100.0),
                damping: r.pick(&[0.0, 0.1, 0.3]),
            },
            tolerance_mm: r.log(2e-3, 0.2),
        }
    }

    /// Filter with the frequency in shares of that of the case.
    fn filter(&self, freq: f64) -> Kernel {
        let cycle = CycleTime::from_us(CYCLE_US).unwrap();
        let guard = VibGuardSettings { freq_hz: freq * self.guard.freq_hz, ..self.guard };
        guard.kernel(cycle).unwrap()
    }

    /// Time in s.
    fn time(&self, points: &Points, filter: Kernel, tolerance: f64) -> f64 {
        self.time_after(0, points, filter, tolerance)
    }

    /// Time in s of a motion that begins after some cycles.
    fn time_after(
        &self,
        rest_cycles: usize,
        points: &Points,
        filter: Kernel,
        tolerance: f64,
    ) -> f64 {
        let ax_dev_mm = Some(tolerance * self.tolerance_mm);
        let job = Job {
            dynamics: channel(vec![self.axes; 3]),
            cycle_us: CYCLE_US,
            kernel: Some(filter),
            tolerance: Tolerance { ax_dev_mm, acc_fact: 1.0 },
            window: 500,
            rest_cycles,
            ..Job::new(1.0, self.kind)
        };
        let points: Vec<&[f64]> = points.iter().map(|p| &p[..]).collect();
        (job.drive(&points, &[self.feed_mm_s]).len() - 1) as f64 * CYCLE_S
    }
}

/// Other forms of the same contour, and neighbouring settings; the largest relative difference in time permitted for
/// each, and from how many cycles per corner on it counts. The differences come from the choice of the blocks that are
/// slowed down.
const FORMS: [(&str, f64, f64); 7] = [
    ("begun later", 1e-9, 0.0),
    ("mirrored", 1e-3, 0.0),
    ("moved by 1e-9 mm", 1e-3, 0.0),
    ("every line in two", 1e-3, 0.0),
    ("reversed", 1e-3, 1.0),
    ("FREQ 1 % higher", 0.035, 0.0),
    ("AX_DEV 1 % larger", 0.03, 0.0),
];
/// Rounding of both times to cycles.
const ROUNDED_CYCLES: f64 = 2.0;

/// Times of the forms in s.
fn forms(case: &Case, r: &mut Random) -> [f64; 7] {
    let points = &case.points;
    let each =
        |f: &mut dyn FnMut(&[f64; 3]) -> [f64; 3]| -> Points { points.iter().map(f).collect() };
    let mut split = vec![points[0]];
    for w in points.windows(2) {
        let u = r.between(0.1, 0.9);
        split.push([0, 1, 2].map(|i| w[0][i] + u * (w[1][i] - w[0][i])));
        split.push(w[1]);
    }
    let same = || case.filter(1.0);
    [
        case.time_after(1 + r.below(9000), points, same(), 1.0),
        case.time(&each(&mut |p| [-p[0], p[1], p[2]]), same(), 1.0),
        case.time(&each(&mut |p| p.map(|c| c + 1e-9 * r.between(-1.0, 1.0))), same(), 1.0),
        case.time(&split, same(), 1.0),
        // backwards in time, the contour passes a filter whose response is reversed
        case.time(&points.iter().rev().copied().collect(), same().reversed(), 1.0),
        case.time(points, case.filter(1.01), 1.0),
        case.time(points, same(), 1.01),
    ]
}

#[test]
fn another_form_of_a_contour_takes_the_same_time() {
    let mut r = Random::from_state(environment("SEED", 5));
    let mut all: [Vec<f64>; 7] = Default::default();
    for n in 0..environment("COUNT", 40) {
        let case = Case::new(&mut r);
        let corners = (case.points.len() - 2) as f64;
        let time = case.time(&case.points, case.filter(1.0), 1.0);
        let others = forms(&case, &mut Random::from_state(n));
        for (((name, most, per_corner), other), found) in FORMS.iter().zip(others).zip(&mut all) {
            let free = (ROUNDED_CYCLES + per_corner * corners) * CYCLE_S;
            let differs = ((other - time).abs() - free).max(0.0) / time;
            assert!(differs <= *most, "{n} {name}: {other} s instead of {time} s\n{case:?}");
            found.push(differs);
        }
    }
    for ((name, ..), found) in FORMS.iter().zip(&mut all) {
        found.sort_by(f64::total_cmp);
        let at = |share: f64| found[((found.len() - 1) as f64 * share) as usize];
        let over = found.iter().filter(|differs| **differs > 1e-3).count();
        println!(
            "{name}: 90 % {:.5} 99 % {:.5} most {:.5}, {over} of {} above 0.1 %",
            at(0.9),
            at(0.99),
            at(1.0),
            found.len()
        );
    }
}

/// Contour 126 of seed 7: with the filter of the case it exceeds the tolerance in one place, with a frequency 1 % higher
/// in none.
#[test]
fn one_excess_does_not_slow_down_the_whole_contour() {
    let mut r = Random::from_state(7);
    let case = (0..=126).map(|_| Case::new(&mut r)).last().unwrap();
    let time = |freq: f64| case.time(&case.points, case.filter(freq), 1.0);
    let (with, without) = (time(1.0), time(1.01));
    assert!(with <= 1.01 * without, "{with} s instead of {without} s");
}
