//! The promise of `AX_DEV`: in both directions, on the segments between the set points, over realistic contours.
//!
//! The test measures independently: set points from interpolated points and kernel taps, distances by brute force over
//! polylines. `COUNT=2000 SEED=7 cargo test --release -p kontur-motion --test all promise` tests more contours.

use crate::common::{Job, apart, deviation, machine, through};
use kontur_filters::kernel::Kernel;
use kontur_filters::time::CycleTime;
use kontur_filters::vib_guard::VibGuardSettings;
use kontur_kit::{Random, environment};
use kontur_motion::block::SlopeKind::{Hsc, Sin2, Trapez};
use kontur_motion::block::Tolerance;
use kontur_motion::planner::Setpoint;
use std::f64::consts::{PI, TAU};

type Point = [f64; 3];

/// Distance between the points of the contour that are examined, in tolerances.
const SPACING: f64 = 0.05;

/// A contour, the settings it is run with, and its feed rate.
#[derive(Debug)]
struct Case {
    job: Job,
    points: Vec<Point>,
    feed_mm_s: f64,
}

impl Case {
    /// Number of cycles, and [`both_ways`] of the run.
    fn drive(&self) -> (usize, [(f64, usize); 2]) {
        let out = self.job.drive(&self.points, &[self.feed_mm_s]);
        (out.len() - 1, of_run(&self.job, &self.points, &out))
    }
}

/// [`both_ways`] of a run.
pub(crate) fn of_run<P: AsRef<[f64]>>(
    job: &Job,
    points: &[P],
    out: &[Setpoint],
) -> [(f64, usize); 2] {
    let path: Vec<&[f64]> = out.iter().map(|p| &p.position[..]).collect();
    let mut seqs: Vec<usize> = out.iter().map(|p| p.seq as usize).collect();
    seqs[0] = 0;
    both_ways(job, points, &path, &seqs)
}

/// Largest deviation of the segments between set points from the contour, with its cycle, and largest deviation of the
/// contour from these segments, with its block; in this order.
pub(crate) fn both_ways<P: AsRef<[f64]>, Q: AsRef<[f64]>>(
    job: &Job,
    points: &[P],
    path: &[Q],
    seqs: &[usize],
) -> [(f64, usize); 2] {
    let set = through(path, &job.kernels);
    let reach = job.kernels.iter().map(|k| k.length() as usize).max().unwrap();
    let tolerance_mm = job.tolerance.ax_dev_mm.unwrap_or(0.01);
    let last = seqs.len() - 1;
    let block = |k: usize| seqs[k.min(last)];
    let mut leaves = (0.0_f64, 0);
    for k in 1..set.len() {
        // one block more or less at the limit of the reach can be the nearest one, with another component
        let lately = [0, 1, 2, 3]
            .map(|border| &points[block(k.saturating_sub(reach + border))..=block(k) + 1]);
        for sub in 1..=16 {
            let u = f64::from(sub) / 16.0;
            let p = between(&set[k - 1], &set[k], u);
            let near = lately
                .map(|blocks| deviation(&p, blocks))
                .into_iter()
                .fold(f64::INFINITY, f64::min);
            if near > leaves.0 {
                let new = near.min(deviation(&p, points));
                if new > leaves.0 {
                    leaves = (new, k);
                }
            }
        }
    }
    let mut misses = (0.0_f64, 0);
    let mut entered = 0;
    for (i, ends) in points.windows(2).enumerate() {
        let [from, to] = [ends[0].as_ref(), ends[1].as_ref()];
        while entered < last && block(entered) < i {
            entered += 1;
        }
        let mut left = entered;
        while left < last && block(left) <= i {
            left += 1;
        }
        // share of the block that the path has covered, in the cycles in which it is on the block or rests at one end
        let distance = apart(from, to);
        let square = distance * distance;
        let share = |k: usize| {
            let on = path[k].as_ref().iter().zip(from).zip(to);
            on.map(|((p, a), b)| (p - a) * (b - a)).sum::<f64>() / square
        };
        let rests = |k: usize, at: &[f64]| apart(path[k].as_ref(), at) < 1e-9;
        while entered > 0 && rests(entered - 1, from) {
            entered -= 1;
        }
        while left < last && rests(left, to) {
            left += 1;
        }
        let shares: Vec<f64> = (entered..left).map(share).collect();
        // dents of the set path are as short as its segments
        let parts = (square.sqrt() / (SPACING * tolerance_mm)).ceil().clamp(8.0, 256.0) as u32;
        for sub in 0..=parts {
            let u = f64::from(sub) / f64::from(parts);
            let p = between(from, to, u);
            // the filters hold a point from the cycle in which the path reaches it until one kernel length after the
            // path has left it
            let comes = entered + shares.partition_point(|s| *s < u - 1e-9);
            let goes = entered + shares.partition_point(|s| *s <= u + 1e-9);
            // one segment of the set path more or less at this limit can be the nearest one, with another component
            let windows = [0, 1, 2, 3].map(|border| (goes + reach + border).min(set.len()));
            let first = comes.saturating_sub(2);
            let new = windows
                .map(|until| deviation(&p, &set[first..until]))
                .into_iter()
                .fold(f64::INFINITY, f64::min);
            if new > misses.0 {
                misses = (new, i);
            }
        }
    }
    [leaves, misses]
}

/// A point on a segment.
fn between(a: &[f64], b: &[f64], share: f64) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a + share * (b - a)).collect()
}

/// Duration of the contour at one constant speed, the best one up to `feed` that keeps the tolerance. Bisection gives
/// the speed to one percent.
fn best_even_time(Case { job, points, feed_mm_s }: &Case) -> f64 {
    let lengths: Vec<f64> = points.windows(2).map(|w| apart(&w[0], &w[1])).collect();
    let length: f64 = lengths.iter().sum();
    let cycle_s = 1e-6 * f64::from(job.cycle_us);
    let keeps = |v: f64| {
        let n = (length / (v * cycle_s)).ceil() as usize;
        let (mut i, mut before) = (0, 0.0);
        let (mut path, mut seqs) = (Vec::new(), Vec::new());
        for k in 0..=n {
            let s = (v * cycle_s * k as f64).min(length);
            while i + 1 < lengths.len() && s > before + lengths[i] {
                before += lengths[i];
                i += 1;
            }
            let u = ((s - before) / lengths[i]).clamp(0.0, 1.0);
            path.push(between(&points[i], &points[i + 1], u));
            seqs.push(i);
        }
        let most = job.tolerance.ax_dev_mm.unwrap();
        both_ways(job, points, &path, &seqs).iter().all(|found| found.0 <= most)
    };
    let (mut low, mut high) = (1e-3 * feed_mm_s, *feed_mm_s);
    if keeps(high) {
        return length / high;
    }
    // ten halvings of the logarithm of a thousand leave less than one percent
    for _ in 0..10 {
        let mid = (low * high).sqrt();
        if keeps(mid) { low = mid } else { high = mid }
    }
    length / low
}

fn polygon_circle(radius: f64, chord: f64, turns: f64) -> Vec<Point> {
    let n = (TAU * turns * radius / chord).ceil().max(3.0) as usize;
    (0..=n)
        .map(|i| {
            let a = TAU * turns * i as f64 / n as f64;
            [radius * libm::sin(a), radius * (1.0 - libm::cos(a)), 0.0]
        })
        .collect()
}

fn kernel(mode: u8, freq_hz: f64, damping: f64, cycle_us: u32) -> Kernel {
    let cycle = CycleTime::from_us(cycle_us).unwrap();
    // a slow cycle has no kernel for a high frequency
    let kernel = |freq_hz: f64| VibGuardSettings { mode, freq_hz, damping }.kernel(cycle);
    kernel(freq_hz).or_else(|_| kernel(10.0)).unwrap()
}

fn rounded(x: f64) -> f64 {
    (x * 1e4).round() / 1e4
}

/// A contour of one of the realistic kinds.
fn contour(r: &mut Random, kind: usize) -> (&'static str, Vec<Point>) {
    let (name, points): (_, Vec<Point>) = match kind {
        0 => ("circle", {
            let radius = r.log(0.5, 20.0);
            polygon_circle(
                radius,
                (r.log(0.02, 2.0)).min(radius).max(radius / 60.0),
                r.between(0.3, 1.2),
            )
        }),
        1 => ("spiral", {
            let (step, chord) = (r.log(0.05, 1.0), r.log(0.05, 0.5));
            let mut a: f64 = 0.5;
            let mut out = Vec::new();
            while out.len() < 120 {
                let radius = 0.2 + step * a / TAU;
                out.push([radius * libm::cos(a), radius * libm::sin(a), 0.01 * a]);
                a += (chord / radius).min(0.6);
            }
            out
        }),
        2 => ("trochoid", {
            let (radius, feed) = (r.log(0.3, 5.0), r.between(0.02, 0.3));
            let n = 20 + (r.ratio() * 40.0) as usize;
            (0..2 * n)
                .map(|i| {
                    let a = TAU * i as f64 / n as f64;
                    [radius * libm::sin(a) + feed * radius * a, radius * libm::cos(a), 0.0]
                })
                .collect()
        }),
        3 => ("walk", {
            let scale = r.log(0.05, 5.0);
            let mut p = [0.0; 3];
            (0..3 + (r.ratio() * 12.0) as usize)
                .map(|_| {
                    let here = p;
                    for c in &mut p {
                        *c += scale * r.between(-1.0, 1.0);
                    }
                    here
                })
                .collect()
        }),
        4 => ("reversals", {
            let (a, scale) = (r.between(0.0, PI), r.log(0.1, 10.0));
            (0..3 + (r.ratio() * 8.0) as usize)
                .map(|i| {
                    let s = scale * r.between(0.2, 1.0) * if i % 2 == 0 { 1.0 } else { -1.0 };
                    [s * libm::cos(a), s * libm::sin(a), 0.0]
                })
                .collect()
        }),
        5 => ("stairs", {
            let step = r.log(0.01, 1.0);
            (0..40).map(|i| [step * f64::from((i + 1) / 2), step * f64::from(i / 2), 0.0]).collect()
        }),
        6 => ("acute", {
            let (width, height) = (r.log(0.01, 0.5), r.log(0.2, 5.0));
            (0..20)
                .map(|i| [width * f64::from(i), if i % 2 == 0 { 0.0 } else { height }, 0.0])
                .collect()
        }),
        _ => ("surface", {
            let (chord, amplitude) = (r.log(0.05, 0.5), r.log(0.1, 2.0));
            let wave = r.log(2.0, 20.0);
            (0..150)
                .map(|i| {
                    let x = chord * f64::from(i);
                    [x, 0.3 * libm::sin(0.7 * x), amplitude * libm::sin(TAU * x / wave)]
                })
                .collect()
        }),
    };
    let mut points: Vec<Point> = points.into_iter().map(|p| p.map(rounded)).collect();
    points.dedup();
    (name, points)
}

fn random_case(r: &mut Random, kind: usize) -> (&'static str, Case) {
    let (name, points) = contour(r, kind);
    let cycle_us = [500, 1000, 2000, 4000][(r.ratio() * 4.0) as usize];
    let (mode, freq) = (1 + (r.ratio() * 4.0) as u8, r.log(8.0, 120.0));
    let damping = 0.3 * r.ratio();
    let mut kernels = vec![kernel(mode, freq, damping, cycle_us)];
    if r.ratio() < 0.2 {
        let mut other =
            || kernel(1 + r.below(4) as u8, freq * r.between(0.7, 1.4), damping, cycle_us);
        kernels = (0..3).map(|_| other()).collect();
    }
    let kind = [Trapez, Sin2, Hsc][(r.ratio() * 3.0) as usize];
    let (feed_mm_s, tolerance_mm) = (r.log(8.0, 330.0), r.log(2e-3, 0.2));
    let dynamics = machine(3, 1.0, r.log(1000.0, 8000.0), r.log(0.005, 0.05));
    let tolerance = Tolerance { ax_dev_mm: Some(tolerance_mm), acc_fact: 1.0 };
    let job = Job { dynamics, cycle_us, tolerance, kernels, ..Job::new(1.0, kind) };
    (name, Case { job, points, feed_mm_s })
}

/// Prints its results; `VERBOSE=1` prints every contour, `ONLY=17` tests that one alone, `EVEN=1` prints the time of
/// the best even speed.
///
/// Conformance: V055.
#[test]
fn random_contours_are_kept_both_ways() {
    let (count, seed) = (environment("COUNT", 48), environment("SEED", 1));
    let mut failed = 0;
    let mut most = [0.0_f64; 8];
    for n in 0..count {
        if environment("ONLY", n) != n {
            continue;
        }
        let mut r = Random::from_state(seed * 1_000_003 + n);
        r.ratio();
        let kind = (n % 8) as usize;
        let (name, case) = random_case(&mut r, kind);
        let (cycles, [leaves, misses]) = case.drive();
        let Case { job, points, feed_mm_s } = &case;
        let tol = job.tolerance.ax_dev_mm.unwrap();
        let used = leaves.0.max(misses.0) / tol;
        most[kind] = most[kind].max(used);
        let bad = used > 1.0 + 1e-9 / tol;
        if bad || environment("VERBOSE", 0) > 0 {
            let time = 1e-6 * f64::from(job.cycle_us) * cycles as f64;
            println!(
                "{n} {name} {:?} {} us, {} blocks, F {feed_mm_s:.1}, {} kernels of {} taps: leaves {:.3} in cycle {}, misses {:.3} in block {} of {tol:.4}; {time:.3} s",
                job.slope.kind,
                job.cycle_us,
                points.len() - 1,
                job.kernels.len(),
                job.kernels[0].length(),
                leaves.0 / tol,
                leaves.1,
                misses.0 / tol,
                misses.1,
            );
            if environment("EVEN", 0) > 0 && used > 0.5 {
                println!("    against the best even speed {:.3}", time / best_even_time(&case));
            }
        }
        failed += usize::from(bad);
    }
    println!("largest use of the tolerance by kind: {most:.3?}");
    assert_eq!(failed, 0, "of {count}");
}

/// The largest distance of these contours from the set path is between the points of a cycle, where the nearest set
/// point passes to another part of the path. With a slow cycle and unequal filters the path of one cycle is many
/// tolerances long, and a dent can lie between two points of the contour that are missed by far less.
#[test]
fn dents_between_the_points_of_a_cycle() {
    for (seed, n) in [(5, 74), (5, 290), (5, 345), (9, 156), (9, 201), (11, 176)] {
        let mut r = Random::from_state(seed * 1_000_003 + n);
        r.ratio();
        let (name, case) = random_case(&mut r, (n % 8) as usize);
        let tolerance_mm = case.job.tolerance.ax_dev_mm.unwrap();
        for (most, at) in case.drive().1 {
            assert!(most <= tolerance_mm + 1e-9, "{name} {seed} {n}: {most} at {at}");
        }
    }
}

/// Chords of which two to four are held by the filters at once: neither isolated corners nor a smooth curve. A plan is
/// at most 5 % slower than the best even speed with one start and stop (it was up to 12 %, because each corner slowed
/// down by too much made the next one leave the contour).
#[test]
fn chords_against_the_best_even_speed() {
    for (radius, count, (mode, freq_hz, damping), tolerance_mm) in [
        (2.0, 60.0, (2, 40.0, 0.0), 0.01),
        (10.0, 150.0, (4, 80.0, 0.1), 0.003),
        (10.0, 150.0, (2, 40.0, 0.0), 0.01),
        (50.0, 200.0, (3, 15.0, 0.05), 0.02),
    ] {
        for kind in [Hsc, Trapez, Sin2] {
            let job = Job { dynamics: machine(3, 1.0, 3500.0, 0.03), ..Job::new(1.0, kind) };
            let case = Case {
                job: job.guarded(mode, freq_hz, damping, Some(tolerance_mm)),
                points: polygon_circle(radius, TAU * radius / count, 1.0),
                feed_mm_s: 300.0,
            };
            let time = 1e-3 * case.drive().0 as f64;
            let even = best_even_time(&case);
            // a jerk-limited start and stop take this much longer than the same way at the final speed
            let ends = TAU * radius / even / 3500.0 + 0.03;
            assert!(time <= 1.05 * (even + ends), "{kind:?} {radius}: {time} s, {even} s even");
        }
    }
}
