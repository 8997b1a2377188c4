//! The time of a contour does not depend on irrelevant differences, and less restrictive settings never take longer.

use crate::common::{Job, axis, channel, contour};
use kontur_kit::{Random, count, seed};
use kontur_motion::axis::{AxisDynamics, FeedSlope};
use kontur_motion::block::SlopeKind::{self, Hsc, Trapez};

/// Cycle in us and s; kinks are weighted so that they may use the full velocity jump of 1 ms.
const CYCLE_US: u32 = 100;
const CYCLE_S: f64 = 1e-4;
const KINK_WEIGHT: f64 = 10.0;
/// Relative difference in time that is permitted for another form of the same contour.
const SAME: f64 = 1e-3;

type Points = Vec<[f64; 3]>;

fn machine(r: &mut Random) -> Vec<AxisDynamics> {
    let even = r.chance(0.5);
    let one = (r.log(500.0, 5000.0), r.log(0.01, 0.08));
    (0..3)
        .map(|_| {
            let (acc, ramp) = if even { one } else { (r.log(500.0, 5000.0), r.log(0.01, 0.08)) };
            let feed = FeedSlope { acc_mm_s2: acc, dec_mm_s2: acc, ramps_s: [ramp; 4] };
            AxisDynamics { feed, ..axis(KINK_WEIGHT) }
        })
        .collect()
}

struct Case {
    axes: Vec<AxisDynamics>,
    points: Points,
    feed: f64,
}

impl Case {
    fn new(r: &mut Random) -> Self {
        Self { axes: machine(r), points: contour(r, 150), feed: r.log(10.0, 300.0) }
    }

    fn time(&self, kind: SlopeKind, points: &Points, feed: f64, window: usize) -> f64 {
        let job = Job {
            dynamics: channel(self.axes.clone()),
            cycle_us: CYCLE_US,
            window,
            ..Job::new(KINK_WEIGHT, kind)
        };
        let points: Vec<&[f64]> = points.iter().map(|p| &p[..]).collect();
        (job.drive(&points, &[feed]).len() - 1) as f64 * CYCLE_S
    }
}

fn cases(default: usize) -> impl Iterator<Item = (usize, Case)> {
    let mut r = Random::from_state(20 + seed());
    (0..count(default)).map(move |n| (n, Case::new(&mut r)))
}

/// Reversed, mirrored, every line split in two, every point moved by up to 1e-9 mm.
#[test]
fn another_form_of_a_contour_takes_the_same_time() {
    let mut most = 0.0_f64;
    for (n, case) in cases(400) {
        let mut r = Random::from_state(n as u64);
        let each = |f: &mut dyn FnMut(&[f64; 3]) -> [f64; 3]| -> Points {
            case.points.iter().map(f).collect()
        };
        let mut split = vec![case.points[0]];
        for w in case.points.windows(2) {
            let u = r.between(0.1, 0.9);
            split.push([0, 1, 2].map(|i| w[0][i] + u * (w[1][i] - w[0][i])));
            split.push(w[1]);
        }
        let mut moved = |p: &[f64; 3]| p.map(|c| c + 1e-9 * r.between(-1.0, 1.0));
        let forms = [
            ("reversed", case.points.iter().rev().copied().collect()),
            ("mirrored", each(&mut |p| [-p[0], p[1], p[2]])),
            ("moved", each(&mut moved)),
            ("in two", split),
        ];
        for kind in [Hsc, Trapez] {
            let time = case.time(kind, &case.points, case.feed, 500);
            for (name, points) in &forms {
                let other = case.time(kind, points, case.feed, 500);
                let differs = ((other - time).abs() - 2.0 * CYCLE_S).max(0.0) / time;
                println!("{n} {kind:?} {name}: {time} s, {other} s");
                assert!(differs <= SAME, "{n} {kind:?} {name}: {other} s instead of {time} s");
                most = most.max(differs);
            }
        }
    }
    println!("at most {most:.5}");
}

/// Tolerated: one cycle per corner.
#[test]
fn a_higher_feed_or_more_look_ahead_is_never_slower() {
    let mut most = 0.0_f64;
    for (n, case) in cases(60) {
        let corners = (case.points.len() - 1) as f64 * CYCLE_S;
        for kind in [Hsc, Trapez] {
            let mut best = f64::INFINITY;
            for step in 0..6 {
                let feed = case.feed * libm::pow(1.6, f64::from(step));
                let time = case.time(kind, &case.points, feed, 500);
                println!("{n} {kind:?} feed {feed}: {time} s, {best} s with less");
                assert!(time <= best + corners, "{n} {kind:?} feed {feed}: {time} s, {best} s");
                most = most.max((time - best) / corners);
                best = best.min(time);
            }
            best = f64::INFINITY;
            for window in [10, 20, 40, 80, 160] {
                let time = case.time(kind, &case.points, case.feed, window);
                println!("{n} {kind:?} window {window}: {time} s, {best} s with less");
                assert!(time <= best + corners, "{n} {kind:?} window {window}: {time} s, {best} s");
                most = most.max((time - best) / corners);
                best = best.min(time);
            }
        }
    }
    println!("at most {most:.3} cycles per corner");
}
