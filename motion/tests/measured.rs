//! The measured deviation of the output against brute force: no point of a contour is missed by more than was measured.

use crate::common::{arc, at, axis, channel, line};
use kontur_filters::time::CycleTime;
use kontur_filters::vib_guard::VibGuardSettings;
use kontur_kit::{Random, from_polyline};
use kontur_motion::block::SlopeKind::{Hsc, Sin2, Step, Trapez};
use kontur_motion::block::{Block, Feed, Slope};
use kontur_motion::deviation::Meter;
use kontur_motion::path::Path;
use kontur_motion::planner::{Next, Planner};
use kontur_motion::tolerance::Kernels;
use std::sync::Arc;

/// Number of points of each block that are compared.
const POINTS: u32 = 200;

/// Components per axis of the shortest vector from a point to the lines between set points.
fn missed(point: &[f64], set: &[[f64; 2]]) -> [f64; 2] {
    let vector = from_polyline(point, set);
    [vector[0].abs(), vector[1].abs()]
}

/// A line or, for half of the paths, an arc.
fn path(r: &mut Random, from: [f64; 2], to: [f64; 2]) -> Path {
    if r.ratio() < 0.5 {
        return line(&from, &to);
    }
    let half = [0, 1].map(|i| 0.5 * (to[i] - from[i]));
    // half of the sweep, and the way from the middle of the chord to the centre as a multiple of half the chord
    let sweep_rad = r.between(0.2, 2.0) * r.pick(&[-1.0, 1.0]);
    let aside = 1.0 / libm::tan(0.5 * sweep_rad);
    let centre_mm = [from[0] + half[0] - aside * half[1], from[1] + half[1] + aside * half[0]];
    arc(&from, &to, centre_mm, sweep_rad)
}

/// Runs random lines and arcs with a filter, and returns per axis what was measured and what is missed of them.
fn run(r: &mut Random) -> ([f64; 2], [f64; 2]) {
    let cycle = CycleTime::from_us(r.pick(&[1000, 2000, 4000])).unwrap();
    let (mode, freq_hz) = (r.pick(&[1, 2, 3, 4]), r.log(12.0, 60.0));
    let kernel = VibGuardSettings { mode, freq_hz, damping: 0.0 }.kernel(cycle).unwrap();
    let dynamics = channel(vec![axis(1.0); 2]);
    let slope = Slope { kind: r.pick(&[Step, Trapez, Sin2, Hsc]), ..Slope::default() };
    let mut points = vec![[0.0; 2]];
    for _ in 0..4 {
        let (length, (sin, cos)) = (r.log(0.2, 5.0), libm::sincos(r.between(0.0, 6.3)));
        let at = points[points.len() - 1];
        points.push([at[0] + length * cos, at[1] + length * sin]);
    }
    let mut planner = Planner::new(cycle, 120, &points[0]);
    planner.report_changes(true);
    let reach = kernel.length() as usize;
    planner.set_kernels(Kernels::new(vec![Some(Arc::new(kernel.clone())); 2]), kernel.length());
    let feed = Feed::PathVelocity(r.log(10.0, 300.0));
    let paths: Vec<Path> = points.windows(2).map(|ends| path(r, ends[0], ends[1])).collect();
    for (path, seq) in paths.iter().zip(0..) {
        let path = path.clone();
        planner.push(Block { slope, ..Block::new(seq, path, feed, Arc::clone(&dynamics)) });
    }
    planner.finish();
    let (mut meter, mut measured) = (Meter::default(), [0.0_f64; 2]);
    let (mut path, mut ways, mut set) = (vec![points[0]], vec![0.0], vec![points[0]]);
    let mut rest = 0;
    while rest <= reach + 2 {
        if planner.advance().unwrap() == Next::Rest {
            planner.hold(kontur_motion::cap::SpeedLimit::Stop);
            rest += 1;
        }
        planner.take_changes().for_each(|change| meter.take(change));
        let at = planner.setpoint();
        path.push([at.position[0], at.position[1]]);
        ways.push(at.s_mm);
        let k = path.len() - 1;
        let now = [0, 1].map(|i| {
            let tap = |t: &kontur_filters::kernel::Tap| {
                t.weight * path[k.saturating_sub(t.delay as usize)][i]
            };
            kernel.taps().iter().map(tap).sum()
        });
        set.push(now);
        meter.filtered(at.k, &now, &at.position, &mut [0.0; 2]);
        for (most, found) in measured.iter_mut().zip(meter.excursion().unwrap()) {
            *most = most.max(found.abs());
        }
    }
    let (mut most, mut s) = ([0.0_f64; 2], 0.0);
    for path in &paths {
        for i in 0..=POINTS {
            let along = path.length() * f64::from(i) / f64::from(POINTS);
            let passed = ways.partition_point(|way| *way <= s + along + 1e-9) - 1;
            let held = &set[passed..set.len().min(passed + reach + 3)];
            let of_it = missed(&at(path, along), held);
            most = [0, 1].map(|i| most[i].max(of_it[i]));
        }
        s += path.length();
    }
    (measured, most)
}

/// Between two set points, too, and where the nearest one passes to another part of the set path.
#[test]
fn no_point_of_the_contour_is_missed_by_more_than_was_measured() {
    let mut r = Random::new(3);
    let mut worst = 0.0_f64;
    for _ in 0..300 {
        let (measured, most) = run(&mut r);
        for (measured, most) in measured.iter().zip(most) {
            worst = worst.max((most - 1e-5) / measured.max(1e-6));
        }
    }
    println!("missed by at most {worst:.4} of what was measured");
    assert!(worst <= 1.0005, "{worst}");
}
