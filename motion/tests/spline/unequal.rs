//! Chords of unequal length: the spline takes the time of the contour that they come from.

use super::*;
use crate::common::arc;

const RADIUS_MM: f64 = 10.0;
const FEED_MM_S: f64 = 100.0;

fn machine() -> Job {
    Job { window: 1000, ..fast(2) }
}

/// Points of a circle after these chords, rounded, without repetitions.
fn circle_in(decimals: i32, count: usize, mut chord: impl FnMut(usize) -> f64) -> Vec<Vec<f64>> {
    let scale = libm::pow(10.0, f64::from(decimals));
    let mut angle = 0.0;
    let mut points: Vec<Vec<f64>> = (0..count)
        .map(|i| {
            angle += if i > 0 { chord(i) / RADIUS_MM } else { 0.0 };
            let (sin, cos) = libm::sincos(angle);
            [cos, sin].map(|x| libm::round(RADIUS_MM * x * scale) / scale).to_vec()
        })
        .collect();
    points.dedup();
    points
}

/// Cycles of the arc from the first to the last of these points, in this number of equal G02 blocks: each has its own
/// limits, so that several take less time than one.
fn arc_cycles(job: &Job, points: &[Vec<f64>], parts: u16) -> usize {
    let angle = |w: &[Vec<f64>]| {
        let cross = w[0][0] * w[1][1] - w[0][1] * w[1][0];
        libm::atan2(cross, w[0][0] * w[1][0] + w[0][1] * w[1][1])
    };
    let sweep_rad = points.windows(2).map(angle).sum::<f64>() / f64::from(parts);
    let at = |part: u16| {
        let (sin, cos) = libm::sincos(f64::from(part) * sweep_rad);
        let [x, y] = [points[0][0], points[0][1]];
        [x * cos - y * sin, x * sin + y * cos]
    };
    let blocks = (0..parts).map(|part| {
        let arc = arc(&at(part), &at(part + 1), [0.0; 2], sweep_rad);
        job.block(u64::from(part), arc, FEED_MM_S)
    });
    job.run(&points[0], blocks).len()
}

fn is_as_the_arc(points: &[Vec<f64>], path_dev_mm: f64, what: &str) {
    let job = machine();
    let settings = SplineSettings { path_dev_mm, ..SplineSettings::default() };
    let blocks = splined(&job, settings, points, FEED_MM_S);
    // every block has its own part; its end may move along the path by 1 um
    for b in &blocks {
        let edge = &points[b.seq as usize..b.seq as usize + 2];
        for k in 0..=8 {
            let q = at(&b.path, b.path.length() * f64::from(k) / 8.0);
            let off = deviation(&q, edge);
            assert!(off <= path_dev_mm + 1e-3, "{what} {path_dev_mm} block {}: {off}", b.seq);
        }
    }
    let cycles = job.run(&points[0], blocks.into_iter()).len();
    let [most, least] = [1, 100].map(|parts| arc_cycles(&job, points, parts));
    assert!(cycles <= most + 2 + most / 200, "{what} {path_dev_mm}: {cycles} of {most}");
    assert!(cycles + 2 + least / 200 >= least, "{what} {path_dev_mm}: {cycles} of {least}");
}

#[test]
fn random_chords_take_the_time_of_the_arc() {
    for (low, high) in [(0.04, 0.06), (0.02, 0.1), (0.1, 0.3), (0.002, 0.1)] {
        for decimals in [3, 5] {
            let mut random = Random::from_state(17);
            let count = (45.0 / (low + high)) as usize;
            let points = circle_in(decimals, count, |_| random.between(low, high));
            for path_dev_mm in [0.005, 0.01, 0.05] {
                let what = format!("chords {low} to {high}, {decimals} decimals");
                is_as_the_arc(&points, path_dev_mm, &what);
            }
        }
    }
}

#[test]
fn alternating_chords_take_the_time_of_the_arc() {
    for (short, long) in [(0.045, 0.055), (0.04, 0.06), (0.002, 0.1), (0.1, 0.2)] {
        let count = (50.0 / (short + long)) as usize;
        let points = circle_in(5, count, |i| if i % 2 == 0 { short } else { long });
        is_as_the_arc(&points, 0.01, &format!("chords {short} and {long}"));
    }
}

/// A second point 1 um beside every tenth one, in any direction: forwards, backwards, to both sides.
#[test]
fn doubled_points_take_the_time_of_the_arc() {
    for direction in 0..8 {
        let (sin, cos) = libm::sincos(f64::from(direction) * std::f64::consts::FRAC_PI_4);
        let mut points = circle_in(5, 500, |_| 0.05);
        for i in (5..495).step_by(10).rev() {
            // along the circle and across it
            let p = &points[i];
            let [across, along] = [[p[0], p[1]], [-p[1], p[0]]].map(|u| u.map(|x| 1e-4 * x));
            let near = (0..2).map(|k| p[k] + cos * along[k] + sin * across[k]).collect();
            points.insert(i + 1, near);
        }
        is_as_the_arc(&points, 0.01, &format!("direction {direction}"));
    }
}

/// Small arcs in chords that turn by 20 to 37 degrees, between lines, are not rows of corners: the spline has about the
/// curvature of the arc, where it had several times of it at each corner.
#[test]
fn coarse_chords_of_a_small_arc_are_no_corners() {
    let job = machine();
    for (radius, turn) in [(1.0, 0.36_f64), (0.75, 0.43), (1.0, 0.5), (0.6, 0.65)] {
        let chord = 2.0 * radius * libm::sin(0.5 * turn);
        let mut pen = Pen::default();
        let mut points = vec![pen.at.to_vec()];
        let lengths = std::iter::once(5.0).chain(std::iter::repeat_n(chord, 6)).chain([5.0]);
        for (k, length) in lengths.enumerate() {
            points.push(pen.go(length).map(|x| libm::round(1000.0 * x) / 1000.0).to_vec());
            pen.heading += if k == 0 || k == 6 { 0.5 * turn } else { turn };
        }
        let settings = SplineSettings { path_dev_mm: 0.1, ..SplineSettings::default() };
        let blocks = splined(&job, settings, &points, FEED_MM_S);
        // over the arc without its first and last chord
        let arc = blocks.iter().filter(|b| (2..=5).contains(&b.seq));
        let bend = |b: &Block| {
            let at = |k: u32| b.path.length() * f64::from(k) / 8.0;
            let of = |k| curvature(&b.path, at(k));
            (0..=8).map(|k| norm(&of(k))).fold(0.0, f64::max)
        };
        let most = arc.map(bend).fold(0.0, f64::max) * radius;
        println!("radius {radius} turn {turn}: {most} times the curvature of the arc");
        assert!(most < 1.5, "radius {radius} turn {turn}: {most}");
        let (out, missed) = strays(&blocks, &points);
        assert!(out <= 0.1 && missed <= 0.1, "{out} {missed}");
    }
}

/// Two to four corners between lines of 10 mm: a larger tolerance costs at most a fortieth, whether they are corners or points of a
/// small arc.
#[test]
fn chamfers_in_a_larger_tolerance() {
    let job = machine();
    for (corners, turn_deg) in [(2, 24.0), (2, 38.0), (3, 24.0), (3, 38.0), (4, 30.0)] {
        for chord in [0.05, 0.1, 0.14, 0.2, 0.25, 0.35, 0.5, 1.0] {
            let mut pen = Pen::default();
            let mut points = vec![pen.at.to_vec()];
            for i in 0..=corners {
                points.push(pen.go(if i == 0 || i == corners { 10.0 } else { chord }).to_vec());
                pen.heading += f64::to_radians(turn_deg);
            }
            let [small, large] =
                [0.02, 0.1].map(|path_dev_mm| driven(&job, path_dev_mm, &points, FEED_MM_S).len());
            let what = format!("{corners} of {turn_deg} deg, {chord} mm: {large}, {small}");
            println!("{what}");
            assert!(large <= small + small / 40, "{what}");
        }
    }
}

/// A slot: behind an arc in short chords a long line, its middle straight.
#[test]
fn a_line_behind_an_arc_stays_straight() {
    let job = machine();
    let mut points = circle_in(4, 400, |_| 0.05);
    let [p, q] = [&points[points.len() - 2], &points[points.len() - 1]].map(Clone::clone);
    let end = [20.0, 0.0].map(|along| along / apart(&p, &q));
    points.push(vec![q[0] + end[0] * (q[0] - p[0]), q[1] + end[0] * (q[1] - p[1])]);
    let settings = SplineSettings { path_dev_mm: 0.01, ..SplineSettings::default() };
    let (blocks, sharp) = splined_and_sharp(&job, settings, &points, FEED_MM_S);
    assert!(sharp.is_empty());
    let last = blocks.iter().filter(|b| b.seq as usize + 2 == points.len());
    let line = &points[points.len() - 2..];
    let (mut straight, mut worst, mut most) = (0.0, 0.0_f64, 0.0_f64);
    for b in last {
        let l = b.path.length();
        for k in 0..=200 {
            let along = l * f64::from(k) / 200.0;
            let s = at(&b.path, along);
            if apart(&s, &line[0]) > 6.0 {
                worst = worst.max(deviation(&s, line));
                let bend = curvature(&b.path, along);
                most = most.max(norm(&bend));
                straight += l / 200.0;
            }
        }
    }
    assert!(straight > 13.0, "{straight}");
    // the fit ends on the line, to what it smooths there
    assert!(worst < 5e-4 && most < 1e-4, "{worst} mm, {most} 1/mm");
    assert!(strays(&blocks, &points).0 <= 0.01);
}

/// A contour and its reverse take the same time.
#[test]
fn the_reverse_takes_the_same_time() {
    let job = machine();
    for seed in 0..6 {
        let mut random = Random::from_state(seed);
        let points = circle_in(3, 600, |_| random.between(0.01, 0.15));
        let time = |points: &[Vec<f64>]| driven(&job, 0.01, points, FEED_MM_S).len();
        let reversed: Vec<Vec<f64>> = points.iter().rev().cloned().collect();
        assert!(time(&points).abs_diff(time(&reversed)) <= 2);
    }
}
