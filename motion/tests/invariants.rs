//! Properties of every program: random contours, blocks and limits.

use crate::common::{Job, arc, axis, channel, even, line};
use kontur_kit::{Pen, Random, count};
use kontur_motion::axis::AxisDynamics;
use kontur_motion::block::SlopeKind::{Hsc, Sin2, Step, Trapez};
use kontur_motion::block::{Block, Feed, Slope};
use kontur_motion::path::Path;
use kontur_motion::planner::Setpoint;
use std::sync::Arc;

fn limits(r: &mut Random) -> AxisDynamics {
    let mut a = axis(if r.ratio() < 0.3 { 0.0 } else { r.log(0.05, 1.0) });
    let acc = r.log(200.0, 10_000.0);
    let ramp = r.log(0.001, 0.1);
    a.v_max_mm_s = r.log(50.0, 2000.0);
    a.tr_geom_s = r.log(0.001, 0.05);
    a.feed = even(acc, ramp);
    a.step_feed.acc_mm_s2 = [acc; 2];
    a.step_feed.dec_mm_s2 = [acc; 2];
    a
}

/// Lines between 1e-4 mm and 1 m, every fifth block an arc.
fn contour(r: &mut Random, count: usize) -> Vec<Path> {
    let mut pen = Pen::default();
    let smooth = r.ratio() < 0.5;
    let long = if r.ratio() < 0.3 { 1000.0 } else { 5.0 };
    (0..count)
        .map(|_| {
            pen.heading += if smooth { 0.2 * (r.ratio() - 0.5) } else { 6.0 * (r.ratio() - 0.5) };
            let from = pen.at;
            if r.ratio() < 0.2 {
                let (radius, sweep) = (r.log(0.05, 50.0), 4.0 * (r.ratio() - 0.5));
                let centre_mm = pen.turn(radius, sweep);
                arc(&from, &pen.at, centre_mm, sweep)
            } else {
                line(&from, &pen.go(r.log(1e-4, long)))
            }
        })
        .collect()
}

fn kinds() -> [Slope; 6] {
    [(Step, false), (Trapez, false), (Sin2, false), (Hsc, false), (Trapez, true), (Sin2, true)]
        .map(|(kind, optimised)| Slope { kind, optimised, constant_ramp_time: false })
}

fn job(dynamics: Vec<AxisDynamics>, slope: Slope) -> Job {
    let mut job = Job { dynamics: channel(dynamics), ..Job::new(1.0, slope.kind) };
    job.slope = slope;
    job
}

fn blocks(job: &Job, paths: &[Path], feed: f64) -> Vec<Block> {
    paths.iter().enumerate().map(|(i, p)| job.block(i as u64, p.clone(), feed)).collect()
}

fn run(job: &Job, paths: &[Path], feed: f64) -> Vec<Setpoint> {
    job.run(&[0.0, 0.0], blocks(job, paths, feed).into_iter())
}

/// Largest velocity and second difference of an axis over its limits, and the lowest path velocity.
fn load(job: &Job, out: &[Setpoint]) -> (f64, f64, f64) {
    let t = f64::from(job.cycle_us) * 1e-6;
    let p = |k: usize, i: usize| out[k.min(out.len() - 1)].position[i];
    let (mut v, mut a, mut low) = (0.0_f64, 0.0_f64, f64::INFINITY);
    for (k, now) in out.iter().enumerate() {
        low = low.min(now.v_mm_s);
        for (i, axis) in job.dynamics.axes.iter().enumerate() {
            v = v.max((p(k + 1, i) - p(k, i)).abs() / t / axis.v_max_mm_s);
            let d2 = (p(k + 2, i) - 2.0 * p(k + 1, i) + p(k, i)).abs() / (t * t);
            a = a.max(d2 / axis.feed.acc_mm_s2);
        }
    }
    (v, a, low)
}

/// Asserts that a run keeps the limits of the axes and ends where its last path does; returns the largest acceleration over its limit.
fn stays_within(job: &Job, out: &[Setpoint], last: &Path, name: &str) -> f64 {
    let (v, a, low) = load(job, out);
    assert!(v <= 1.0 + 1e-6 && a <= 3.0 && low >= 0.0, "{name}: {v} {a} {low}");
    assert_eq!(out[out.len() - 1].position[..], last.end()[..], "{name}");
    a
}

/// No axis is faster than its limit, and its acceleration stays within what the path, its curvature and a kink may use
/// together, each of them up to the limit of the axis.
#[test]
fn velocity_and_acceleration_of_the_axes() {
    let mut r = Random::from_state(1);
    let mut worst = 0.0_f64;
    for program in 0..60 {
        let paths = contour(&mut r, 60);
        let axes = vec![limits(&mut r), limits(&mut r)];
        let feed = r.log(5.0, 1000.0);
        for slope in kinds() {
            let job = job(axes.clone(), slope);
            let out = run(&job, &paths, feed);
            let name = format!("{program} {slope:?}");
            worst = worst.max(stays_within(&job, &out, &paths[paths.len() - 1], &name));
        }
    }
    println!("largest acceleration: {worst:.3} of the limit");
}

/// The same with feed rates that change from block to block, without and with G901, which never costs time; cut at any
/// place as well.
#[test]
fn changes_of_feed_with_and_without_late_braking() {
    let count = count(6);
    let mut r = Random::from_state(6);
    for program in 0..count {
        let paths = contour(&mut r, 60);
        let axes = vec![limits(&mut r), limits(&mut r)];
        let feed = r.log(5.0, 1000.0);
        let feeds: Vec<f64> = (0..7).map(|_| feed * r.log(0.05, 1.0)).collect();
        let cut = 1 + (r.ratio() * 59.0) as usize;
        for slope in kinds() {
            let job = job(axes.clone(), slope);
            let mut cycles = usize::MAX;
            for (late, count) in [(false, 60), (true, 60), (true, cut)] {
                let mut blocks = blocks(&job, &paths[..count], feed);
                for (i, block) in blocks.iter_mut().enumerate() {
                    block.feed = Feed::PathVelocity(feeds[i % 7]);
                    block.late_braking = late;
                }
                let out = job.run(&[0.0, 0.0], blocks.into_iter());
                let name = format!("{program} {slope:?} {late} {count}");
                stays_within(&job, &out, &paths[count - 1], &name);
                assert!(out.len() <= cycles.saturating_add(1), "{name}: {} {cycles}", out.len());
                cycles = cycles.min(out.len());
            }
        }
    }
}

/// On straight lines without kinks only the slope matters: its acceleration and its jerk.
#[test]
fn acceleration_and_jerk_without_kinks() {
    let mut r = Random::from_state(2);
    for program in 0..40 {
        let (mut x, mut points) = (0.0, vec![[0.0, 0.0]]);
        for _ in 0..80 {
            x += r.log(1e-4, 20.0);
            points.push([x, 0.5 * x]);
        }
        let feeds: Vec<f64> = (0..7).map(|_| r.log(5.0, 500.0)).collect();
        let a = limits(&mut r);
        for slope in kinds().into_iter().filter(|s| s.kind != Step) {
            let job = job(vec![a; 2], slope);
            let out = job.drive(&points, &feeds);
            let acc = a.feed.acc_mm_s2;
            // in the middle of a sine-square ramp it is pi/2 times the mean
            let peak = if slope.kind == Sin2 { std::f64::consts::FRAC_PI_2 } else { 1.0 };
            let jerk = peak * acc / a.feed.ramps_s[0];
            for w in out.windows(2) {
                let u = [1.0, 0.5].map(|c| c / 1.25_f64.sqrt());
                let axis = u[0] * w[1].a_mm_s2.abs();
                assert!(axis <= acc * (1.0 + 1e-6), "{program} {slope:?}: {axis} of {acc}");
                let step = u[0] * (w[1].a_mm_s2 - w[0].a_mm_s2).abs() / 1e-3;
                assert!(step <= jerk * (1.0 + 1e-6), "{program} {slope:?}: {step} of {jerk}");
            }
        }
    }
}

/// The path can be left at the end of any block: later blocks are not needed to keep the limits.
#[test]
fn a_program_may_be_cut_anywhere() {
    let mut r = Random::from_state(3);
    for program in 0..6 {
        let paths = contour(&mut r, 30);
        let axes = vec![limits(&mut r), limits(&mut r)];
        let feed = r.log(20.0, 500.0);
        for slope in kinds() {
            let job = job(axes.clone(), slope);
            for cut in 1..=paths.len() {
                let out = run(&job, &paths[..cut], feed);
                stays_within(&job, &out, &paths[cut - 1], &format!("{program} {cut}"));
            }
        }
    }
}

/// With symmetric limits a contour takes the same time in both directions.
#[test]
fn a_reversed_contour_takes_the_same_time() {
    let mut r = Random::from_state(4);
    for program in 0..20 {
        let mut at = [0.0, 0.0];
        let mut points = vec![at];
        for _ in 0..40 {
            at = [at[0] + r.log(0.01, 5.0), at[1] + 4.0 * (r.ratio() - 0.5)];
            points.push(at);
        }
        let axes = vec![limits(&mut r), limits(&mut r)];
        let feed = r.log(20.0, 500.0);
        let back: Vec<_> = points.iter().rev().copied().collect();
        for slope in kinds() {
            let job = job(axes.clone(), slope);
            let cycles = [&points, &back].map(|p| job.drive(p, &[feed]).len());
            let apart = cycles[0].abs_diff(cycles[1]);
            // planned in steps along varying limits: the grid of the steps starts at the other end
            let allowed =
                if slope.kind == Hsc || slope.optimised { cycles[0] / 500 + 1 } else { 1 };
            assert!(apart <= allowed, "{program} {slope:?}: {cycles:?}");
        }
    }
}

/// Rows of short blocks with other accelerations than their neighbours: along a straight line the way back takes the same
/// time, and no row takes the speed from another one, so that the whole takes no longer than with a stop between them.
#[test]
fn a_weak_row_does_not_slow_a_strong_one() {
    let mut r = Random::from_state(6);
    for program in 0..25 {
        let axes = vec![limits(&mut r), limits(&mut r)];
        let feed = r.log(100.0, 2000.0);
        let mut x = 0.0;
        let rows: Vec<Vec<(f64, [f64; 2])>> = (0..2 + r.below(4))
            .map(|row| {
                // ratios of the acceleration; neighbours differ, but less than the rows
                let ratios = if row % 2 == 0 { [0.1, 0.11, 0.12] } else { [0.8, 0.9, 1.0] };
                let blocks = 1 + r.below(60);
                let length = r.log(0.01, 1.0);
                (0..blocks)
                    .map(|_| {
                        let from = x;
                        x += length * r.between(0.5, 1.0);
                        (r.pick(&ratios), [from, x])
                    })
                    .collect()
            })
            .collect();
        let all: Vec<(f64, [f64; 2])> = rows.iter().flatten().copied().collect();
        let back: Vec<_> =
            all.iter().rev().map(|(ratio, [from, to])| (*ratio, [*to, *from])).collect();
        for slope in kinds() {
            let cycles = |blocks: &[(f64, [f64; 2])]| {
                let job = Job { window: 1000, ..job(axes.clone(), slope) };
                let block = |(seq, (ratio, ends)): (u64, &(f64, [f64; 2]))| {
                    let [from, to] = ends.map(|x| [x, 0.0]);
                    let mut block = job.line(seq, &from, &to, feed);
                    for axis in &mut Arc::make_mut(&mut block.dynamics).axes {
                        axis.feed.acc_mm_s2 *= ratio;
                        axis.feed.dec_mm_s2 *= ratio;
                        axis.step_feed.acc_mm_s2 = axis.step_feed.acc_mm_s2.map(|a| a * ratio);
                        axis.step_feed.dec_mm_s2 = axis.step_feed.dec_mm_s2.map(|a| a * ratio);
                    }
                    block
                };
                let start = [blocks[0].1[0], 0.0];
                job.run(&start, (0..).zip(blocks).map(block)).len()
            };
            let (there, back) = (cycles(&all), cycles(&back));
            let allowed = if slope.kind == Hsc || slope.optimised { there / 500 + 1 } else { 1 };
            assert!(there.abs_diff(back) <= allowed, "{program} {slope:?}: {there} {back}");
            let with_stops: usize = rows.iter().map(|row| cycles(row)).sum();
            assert!(there <= with_stops, "{program} {slope:?}: {there} of {with_stops}");
        }
    }
}

/// More look-ahead never costs time, and a second run changes no bit.
#[test]
fn more_lookahead_and_a_second_run() {
    let mut r = Random::from_state(5);
    for program in 0..15 {
        let paths = contour(&mut r, 150);
        let axes = vec![limits(&mut r), limits(&mut r)];
        let feed = r.log(20.0, 500.0);
        for slope in kinds() {
            let mut last = usize::MAX;
            for window in [10, 30, 120, 1000] {
                let job = Job { window, ..job(axes.clone(), slope) };
                let out = run(&job, &paths, feed);
                let n = out.len();
                assert!(n <= last.saturating_add(last / 500 + 1), "{program} {slope:?} {window}");
                last = n;
                if window == 30 {
                    let again = run(&job, &paths, feed);
                    assert_eq!(n, again.len());
                    let same = |(a, b): (&Setpoint, &Setpoint)| {
                        a.position
                            .iter()
                            .zip(b.position.iter())
                            .all(|(p, q)| p.to_bits() == q.to_bits())
                    };
                    assert!(out.iter().zip(&again).all(same), "{program} {slope:?}");
                }
            }
        }
    }
}

/// With a short window the knots of one plan are not those of the next; these programs lead to a plan that cannot be
/// reached from the speed that is already final, and continue with the previous one.
#[test]
fn a_final_speed_is_never_too_high() {
    let mut r = Random::from_state(77);
    for program in 0..364 {
        let paths = contour(&mut r, 120);
        let axes = vec![limits(&mut r), limits(&mut r)];
        let feed = r.log(20.0, 1000.0);
        if [167, 203, 363].contains(&program) {
            let job = Job { window: 10, ..job(axes, kinds()[5]) };
            let out = run(&job, &paths, feed);
            stays_within(&job, &out, &paths[119], &program.to_string());
        }
    }
}

/// Points along a chain of edges, `step` mm apart; every edge turns by the same angle.
fn fine(edge: f64, degrees: f64, edges: usize, step: f64) -> Vec<[f64; 2]> {
    let per_edge = libm::round(edge / step) as usize;
    let (mut at, mut out) = ([0.0, 0.0], vec![[0.0, 0.0]]);
    for k in 0..edges {
        let (sin, cos) = libm::sincos(degrees.to_radians() * k as f64);
        for i in 1..=per_edge {
            let l = edge * i as f64 / per_edge as f64;
            out.push([at[0] + l * cos, at[1] + l * sin]);
        }
        at = out[out.len() - 1];
    }
    out
}

/// Blocks of 1e-4 mm at 60 m/min and 10 m/s2, of which ten thousand could pass in a cycle. The path and its kinks
/// together use at most twice the acceleration of an axis: the path acceleration and the jump of one cycle.
#[test]
fn limits_hold_at_extreme_ratios() {
    let step = 1e-4;
    let shapes = [
        ("line", fine(0.5, 0.0, 1, step)),
        ("circle of 0.05 mm", fine(step, 0.114_591_559, 3142, step)),
        ("square", fine(0.1, 90.0, 4, step)),
        ("kinks of 30 degrees", fine(0.01, 30.0, 24, step)),
        ("zigzag", (0..2000).map(|k| [step * f64::from(k), step * f64::from(k % 2)]).collect()),
    ];
    let mut a = axis(1.0);
    a.a_max_mm_s2 = 10_000.0;
    a.feed = even(10_000.0, 0.005);
    a.step_feed.acc_mm_s2 = [10_000.0; 2];
    a.step_feed.dec_mm_s2 = [10_000.0; 2];
    for (name, points) in shapes {
        for slope in kinds() {
            for window in [120, 2000] {
                let job = Job { window, ..job(vec![a; 2], slope) };
                let out = job.drive(&points, &[1000.0]);
                let (v, acc, low) = load(&job, &out);
                println!("{name} {slope:?} {window}: {} cycles, {acc:.3}", out.len());
                assert!(v <= 1.0 + 1e-6 && acc <= 2.0 + 1e-6 && low >= 0.0, "{name} {slope:?}");
                assert_eq!(out[out.len() - 1].position[..], points[points.len() - 1][..]);
            }
        }
    }
}

/// With constant ramp times (P-CHAN-00349 = 1) a polygon of short chords is passed at least at the speed of its kinks, at which a
/// path with constant jerk is slowest; a higher feed never makes it slower, and the axes keep their limits.
#[test]
fn constant_ramp_times_on_short_blocks() {
    let mut r = Random::from_state(9);
    for program in 0..count(20) {
        let turn = r.log(0.002, 0.3);
        let length = r.log(0.01, 0.5);
        let mut pen = Pen::default();
        let paths: Vec<Path> = (0..150)
            .map(|i| {
                let from = pen.at;
                pen.heading = if i % 2 == 0 { turn } else { -turn };
                line(&from, &pen.go(length * (0.5 + r.ratio())))
            })
            .collect();
        let way_mm: f64 = paths.iter().map(Path::length).sum();
        for kind in [Trapez, Sin2] {
            let slope = |constant_ramp_time| Slope { kind, optimised: false, constant_ramp_time };
            let [constant, jerk] =
                [true, false].map(|on| job(vec![axis(0.03), axis(0.03)], slope(on)));
            let mut before = usize::MAX;
            for feed in [20.0, 60.0, 200.0, 600.0] {
                let out = run(&constant, &paths, feed);
                let (v, a, _) = load(&constant, &out);
                assert!(v <= 1.0 + 1e-6 && a <= 3.0, "{program} {kind:?} {feed}: {v} {a}");
                let cycles = out.len();
                let slower = cycles > before.saturating_add(before / 100 + 2);
                assert!(!slower, "{program} {kind:?}: {cycles} at {feed}, less took {before}");
                before = cycles;
                let fastest = run(&jerk, &paths, feed);
                let middle = &fastest[fastest.len() / 4..fastest.len() * 3 / 4];
                let least = middle.iter().map(|s| s.v_mm_s).fold(f64::INFINITY, f64::min);
                let most = 1000.0 * way_mm / least + 200.0;
                assert!(cycles as f64 <= most, "{program} {kind:?} {feed}: {cycles}, {most}");
            }
        }
    }
}
