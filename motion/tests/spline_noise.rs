//! Rounded coordinates under the B-spline: speed, ripple, jerk, and the tolerance in both directions.

use crate::common::{circle, norm};
use crate::spline::{driven, fast, splined};
use kontur_kit::{Random, environment, from_polyline};
use kontur_motion::block::{Block, SplineSettings};
use kontur_motion::path::Path;
use kontur_motion::planner::Setpoint;

fn rounded(points: &[Vec<f64>], decimals: i32) -> Vec<Vec<f64>> {
    let scale = libm::pow(10.0, f64::from(decimals));
    points.iter().map(|p| p.iter().map(|x| libm::round(x * scale) / scale).collect()).collect()
}

struct Judged {
    cycles: usize,
    ripple: f64,
    jerk: f64,
}

fn judged(out: &[Setpoint]) -> Judged {
    let middle = &out[out.len() / 5..4 * out.len() / 5];
    let low = middle.iter().map(|s| s.v_mm_s).fold(f64::INFINITY, f64::min);
    let high = middle.iter().map(|s| s.v_mm_s).fold(0.0, f64::max);
    let mut jerk = 0.0_f64;
    for w in middle.windows(4) {
        for i in 0..w[0].position.len() {
            let p = |k: usize| w[k].position[i];
            jerk = jerk.max((p(3) - 3.0 * p(2) + 3.0 * p(1) - p(0)).abs() / 1e-9);
        }
    }
    Judged { cycles: out.len(), ripple: (high - low) / high, jerk }
}

/// Rounded to three or four decimals a circle runs as with full precision: at the full feed rate, without ripple, with
/// the same jerk.
#[test]
fn a_rounded_circle_runs_as_an_exact_one() {
    let job = fast(2);
    for chord in [0.01, 0.05, 0.1, 0.3] {
        let run = |points: &[Vec<f64>]| judged(&driven(&job, 0.05, points, 100.0));
        let exact = circle(10.0, chord);
        let want = run(&exact);
        for decimals in [3, 4] {
            let here = run(&rounded(&exact, decimals));
            let what = format!("chord {chord}, {decimals} decimals");
            assert!(here.ripple < 1e-3, "{what}: {}", here.ripple);
            assert!(here.cycles <= want.cycles + 2, "{what}: {} {}", here.cycles, want.cycles);
            assert!(here.jerk < 1.1 * want.jerk, "{what}: {} {}", here.jerk, want.jerk);
        }
    }
}

/// Circles of a few millimetres in chords of 0.01 and 0.02 mm, rounded to three decimals: with half a micron to smooth, the spline
/// took twice as long as with all decimals, longer than the polygon itself.
#[test]
fn small_circles_in_tiny_chords() {
    let job = fast(2);
    for radius in [0.5, 0.7, 1.0, 2.0] {
        for chord in [0.01, 0.02] {
            for path_dev_mm in [0.003, 0.01, 0.05] {
                let cycles =
                    |points: &[Vec<f64>]| driven(&job, path_dev_mm, points, 200.0).len() as f64;
                let exact = circle(radius, chord);
                let (want, here) = (cycles(&exact), cycles(&rounded(&exact, 3)));
                let most = if path_dev_mm < 0.01 { 1.25 } else { 1.05 };
                assert!(
                    here <= most * want,
                    "r {radius} chord {chord} {path_dev_mm}: {here} {want}"
                );
            }
        }
    }
}

/// A surface row with two rotary axes: rounding of all five coordinates costs no time.
#[test]
fn rounded_rotary_axes_cost_no_time() {
    let mut job = fast(5);
    let mut dynamics = (*job.dynamics).clone();
    dynamics.feed_axes = vec![true, true, true, false, false];
    job.dynamics = std::sync::Arc::new(dynamics);
    let exact: Vec<Vec<f64>> = (0..1500)
        .map(|k| 0.05 * f64::from(k))
        .map(|x| {
            let z = 2.0 * libm::sin(0.2 * x);
            vec![x, 0.1 * x, z, 20.0 * libm::cos(0.2 * x), 0.4 * x + 5.0 * libm::sin(0.1 * x)]
        })
        .collect();
    let path_dev_mm = SplineSettings::default().path_dev_mm;
    let run = |points: &[Vec<f64>]| judged(&driven(&job, path_dev_mm, points, 80.0));
    let (want, here) = (run(&exact), run(&rounded(&exact, 3)));
    assert!(here.cycles <= want.cycles + 3, "{} {}", here.cycles, want.cycles);
    assert!(here.jerk < 1.3 * want.jerk, "{} {}", here.jerk, want.jerk);
}

/// Smooth stretches, corners of any angle, tiny edges and long ones, with the noise of rounding.
fn contour(seed: u64, decimals: i32) -> Vec<Vec<f64>> {
    let mut random = Random::from_state(seed);
    let (mut heading, mut p) = (0.0_f64, [0.0, 0.0, 0.0]);
    let mut points = vec![p.to_vec()];
    for _ in 0..12 {
        let chord = random.log(0.008, 0.4);
        let bend = random.between(-0.4, 0.4) * chord.min(0.3);
        for _ in 0..(random.between(5.0, 90.0) as usize) {
            heading += bend;
            let step = if random.chance(0.05) { 0.002 } else { chord * random.between(0.3, 1.7) };
            let (sin, cos) = libm::sincos(heading);
            p = [p[0] + step * cos, p[1] + step * sin, p[2] + 0.1 * step];
            points.push(p.to_vec());
        }
        if random.chance(0.3) {
            p[0] += 3.0;
            points.push(p.to_vec());
        }
        heading += if random.chance(0.5) { random.between(-3.1, 3.1) } else { 0.0 };
    }
    let mut points = rounded(&points, decimals);
    points.dedup();
    points
}

/// Points of the path over every programmed edge, `n + 1` of each.
fn traced(blocks: &[Block], edges: usize, n: usize) -> Vec<Vec<Vec<f64>>> {
    let mut of_edge: Vec<Vec<&Path>> = vec![Vec::new(); edges];
    for b in blocks {
        of_edge[b.seq as usize].push(&b.path);
    }
    let points = |parts: &Vec<&Path>| -> Vec<Vec<f64>> {
        let whole: f64 = parts.iter().map(|p| p.length()).sum();
        let mut q = parts[0].start().to_vec();
        let at = |k: usize| {
            let mut s = whole * k as f64 / n as f64;
            let mut i = 0;
            while i + 1 < parts.len() && s > parts[i].length() {
                s -= parts[i].length();
                i += 1;
            }
            parts[i].position(s, &mut q);
            q.clone()
        };
        (0..=n).map(at).collect()
    };
    of_edge.iter().map(points).collect()
}

/// Fairing and spline together stay within `PATH_DEV`: every point of the path is that close to the programmed edges
/// around it, and every programmed point to the path. `COUNT` raises the number of contours.
#[test]
fn the_whole_stays_within_the_tolerance() {
    let job = fast(3);
    let count = environment("COUNT", 8);
    let mut used = 0.0_f64;
    for seed in 0..count {
        let points = contour(seed, if seed % 2 == 0 { 3 } else { 2 });
        for path_dev_mm in [0.0005, 0.003, 0.01, 0.03, 0.2] {
            let settings = SplineSettings { path_dev_mm, ..SplineSettings::default() };
            let blocks = splined(&job, settings, &points, 50.0);
            let path = traced(&blocks, points.len() - 1, 12);
            for i in 0..path.len() {
                let around = i.saturating_sub(2)..(i + 3).min(path.len());
                let edges = &points[around.start..=around.end];
                for q in &path[i] {
                    let off = norm(&from_polyline(q, edges));
                    used = used.max(off / path_dev_mm);
                    assert!(off <= path_dev_mm + 1e-9, "{seed} {path_dev_mm} edge {i}: {off}");
                }
                let there: Vec<Vec<f64>> = path[around].concat();
                for k in 0..=4 {
                    let u = f64::from(k) / 4.0;
                    let p: Vec<f64> = points[i]
                        .iter()
                        .zip(&points[i + 1])
                        .map(|(a, b)| a + u * (b - a))
                        .collect();
                    let off = norm(&from_polyline(&p, &there));
                    // twelve chords of the path replace it
                    assert!(
                        off <= 1.01 * path_dev_mm + 1e-9,
                        "{seed} {path_dev_mm} edge {i}: {off}"
                    );
                }
            }
        }
    }
    println!("of the tolerance at most {used:.4}");
    assert!(used > 0.9);
}

/// The mirrored or permuted contour gives the mirrored or permuted path, and the reversed one almost: of points that are
/// close together it passes over the other one, and where a corner takes the same time with and without the spline, to
/// a hundredth, it may be decided differently.
#[test]
fn the_path_is_the_same_seen_otherwise() {
    let job = fast(3);
    let settings = SplineSettings { path_dev_mm: 0.02, ..SplineSettings::default() };
    for seed in 20..26 {
        let points = contour(seed, 3);
        let edges = points.len() - 1;
        let path = |p: &[Vec<f64>]| traced(&splined(&job, settings, p, 50.0), edges, 6);
        let want = path(&points);
        let same = |got: &[Vec<Vec<f64>>], what: &str| {
            for (i, (p, q)) in want.iter().zip(got).enumerate() {
                for (p, q) in p.iter().zip(q) {
                    let off = p.iter().zip(q).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
                    let most = if what == "reversed" { 0.5 * settings.path_dev_mm } else { 1e-6 };
                    assert!(off < most, "{seed} {what} edge {i}: {off}");
                }
            }
        };
        let each = |p: &[Vec<f64>], f: &dyn Fn(&[f64]) -> Vec<f64>| -> Vec<Vec<f64>> {
            p.iter().map(|p| f(p)).collect()
        };
        let mut reversed = path(&points.iter().rev().cloned().collect::<Vec<_>>());
        reversed.reverse();
        for edge in &mut reversed {
            edge.reverse();
        }
        same(&reversed, "reversed");
        let mirror = |p: &[f64]| vec![-p[0], p[1], p[2]];
        let back = path(&each(&points, &mirror));
        same(&back.iter().map(|e| each(e, &mirror)).collect::<Vec<_>>(), "mirrored");
        let (there, back) =
            (|p: &[f64]| vec![p[2], p[0], p[1]], |p: &[f64]| vec![p[1], p[2], p[0]]);
        let permuted = path(&each(&points, &there));
        same(&permuted.iter().map(|e| each(e, &back)).collect::<Vec<_>>(), "permuted");
    }
}
