//! Which points move, how far, and which stay.

use super::*;
use crate::example::{ChannelDynamics, Feed};
use std::f64::consts::{PI, TAU};

type Points = Vec<Vec<f64>>;

/// Axes, the first ones in the feed group.
fn dynamics(axes: usize, feed_axes: usize) -> Arc<ChannelDynamics> {
    let feed_axes = (0..axes).map(|i| i < feed_axes).collect();
    Arc::new(ChannelDynamics {
        feed_axes,
        ..ChannelDynamics::new(vec![crate::example::axis(); axes])
    })
}

/// The blocks of a polygon in all axes, each modified by `change`.
fn blocks(
    points: &[Vec<f64>],
    feed_axes: usize,
    settings: SplineSettings,
    change: impl Fn(usize, &mut Block),
) -> Vec<Block> {
    let dynamics = dynamics(points[0].len(), feed_axes);
    let block = |(i, w): (usize, &[Vec<f64>])| {
        let [from, to] = [&w[0], &w[1]].map(|p| AxisVec::from_slice(p));
        let line = LinePath::new(from, to, &dynamics.feed_axes)?;
        let feed = Feed::PathVelocity(50.0);
        let block = Block::new(i as u64, Path::Line(line), feed, Arc::clone(&dynamics));
        let mut block = Block { spline: Some(settings), ..block };
        change(i, &mut block);
        Some(block)
    };
    let out: Vec<Block> = points.windows(2).enumerate().filter_map(block).collect();
    assert_eq!(out.len() + 1, points.len(), "no two equal points");
    out
}

fn through(blocks: Vec<Block>) -> Vec<Block> {
    let mut stage = Fairing::default();
    let mut out = Vec::new();
    for block in blocks {
        out.extend(stage.push(block));
        assert!(stage.edges.len() <= CHUNK + MARGIN && stage.row.len() <= CHUNK + 2 * MARGIN + 1);
    }
    out.extend(stage.flush());
    out
}

fn ends(blocks: &[Block]) -> Points {
    let start = blocks[0].path.start().to_vec();
    std::iter::once(start).chain(blocks.iter().map(|b| b.path.end().to_vec())).collect()
}

fn within(path_dev_mm: f64) -> SplineSettings {
    SplineSettings { path_dev_mm, ..SplineSettings::default() }
}

/// Points of the faired polygon, after checking that it is connected and that all blocks come out.
fn faired(points: &[Vec<f64>], feed_axes: usize, settings: SplineSettings) -> Points {
    let out = through(blocks(points, feed_axes, settings, |_, _| {}));
    assert!(out.windows(2).all(|w| w[0].path.end() == w[1].path.start()));
    assert!(out.iter().enumerate().all(|(i, b)| b.seq == i as u64));
    assert_eq!(out.len() + 1, points.len());
    ends(&out)
}

fn apart(p: &[f64], q: &[f64]) -> f64 {
    p.iter().zip(q).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
}

fn largest_way(p: &[Vec<f64>], q: &[Vec<f64>]) -> f64 {
    p.iter().zip(q).map(|(p, q)| apart(p, q)).fold(0.0, f64::max)
}

fn rounded(points: &[Vec<f64>], decimals: i32) -> Points {
    let scale = libm::pow(10.0, f64::from(decimals));
    points.iter().map(|p| p.iter().map(|x| libm::round(x * scale) / scale).collect()).collect()
}

/// Points of a curve over `0..=1`, in steps of `chord` mm of the curve.
fn sampled(chord: f64, curve: impl Fn(f64) -> Vec<f64>) -> Points {
    let fine = 200_000;
    let (mut out, mut s) = (vec![curve(0.0)], 0.0);
    let mut last = curve(0.0);
    for k in 1..=fine {
        let p = curve(f64::from(k) / f64::from(fine));
        s += apart(&p, &last);
        last = p;
        if s >= chord {
            out.push(last.clone());
            s = 0.0;
        }
    }
    out
}

fn circle(r: f64) -> impl Fn(f64) -> Vec<f64> {
    move |u| vec![r * libm::cos(TAU * u), r * libm::sin(TAU * u)]
}

fn ellipse(u: f64) -> Vec<f64> {
    vec![10.0 * libm::cos(TAU * u), 4.0 * libm::sin(TAU * u)]
}

fn spiral(u: f64) -> Vec<f64> {
    let (r, a) = (1.0 + 3.0 * u, 4.0 * PI * u);
    vec![r * libm::cos(a), r * libm::sin(a), 0.5 * u]
}

fn wave(u: f64) -> Vec<f64> {
    vec![20.0 * u, 2.0 * libm::sin(10.0 * u), libm::cos(14.0 * u), 30.0 * libm::sin(8.0 * u)]
}

/// Largest third difference of the points, in mm.
fn roughest(points: &[Vec<f64>]) -> f64 {
    let third = |w: &[Vec<f64>]| {
        let d = |i: usize| w[3][i] - 3.0 * w[2][i] + 3.0 * w[1][i] - w[0][i];
        (0..w[0].len()).map(|i| d(i) * d(i)).sum::<f64>().sqrt()
    };
    points.windows(4).map(third).fold(0.0, f64::max)
}

/// A hundredth of the smallest tolerance that does not affect the spline is more than the displacement of smooth
/// points.
#[test]
fn points_of_smooth_curves_stay() {
    for chord in [0.02, 0.05, 0.1, 0.3, 0.9] {
        for r in [0.5, 1.0, 3.0, 10.0, 200.0] {
            if chord > 0.3 * r {
                continue;
            }
            let points = sampled(chord, circle(r));
            let natural = chord * chord / (6.0 * r);
            let way = largest_way(&points, &faired(&points, 2, within(0.2)));
            assert!(way <= 0.01 * natural.max(0.01), "r {r} chord {chord}: {way} of {natural}");
        }
        for curve in [ellipse, spiral, wave] {
            let points = sampled(chord, curve);
            if points[0].len() == 4 && chord > 0.3 {
                continue;
            }
            let way = largest_way(&points, &faired(&points, 3.min(points[0].len()), within(0.2)));
            let natural = chord * chord / (6.0 * 1.6);
            assert!(way <= 0.01 * natural.max(0.01), "chord {chord}: {way} of {natural}");
        }
    }
}

#[test]
fn straight_lines_stay_exactly_straight() {
    let steps = [0.01, 0.3, 0.02, 0.07, 0.5, 0.011, 0.9, 0.05];
    let mut at = 0.0;
    let along: Vec<f64> = (0..900)
        .map(|i| {
            at += steps[i % steps.len()];
            at
        })
        .collect();
    // along an axis, rounded: the other axes do not move at all
    let points: Points = along.iter().map(|s| vec![*s, 5.123, -7.0]).collect();
    for p in [points.clone(), rounded(&points, 3)] {
        let out = faired(&p, 3, within(0.05));
        assert!(out.iter().all(|q| q[1].to_bits() == 5.123_f64.to_bits()));
        assert!(out.iter().all(|q| q[2].to_bits() == (-7.0_f64).to_bits()));
    }
    // at an angle
    let points: Points = along.iter().map(|s| vec![0.6 * s, 0.8 * s, 0.1 * s]).collect();
    assert!(largest_way(&points, &faired(&points, 3, within(0.05))) < 1e-12);
}

/// Rounding disappears: a fiftieth of its third differences remains, and the points are nearer to the curve.
#[test]
fn rounding_goes() {
    for (decimals, grain) in [(3, 1e-3), (4, 1e-4)] {
        for chord in [0.02, 0.05, 0.1] {
            for r in [3.0, 10.0] {
                let exact = sampled(chord, circle(r));
                let points = rounded(&exact, decimals);
                let out = faired(&points, 2, within(0.05));
                assert!(largest_way(&points, &out) <= 3.0 * grain);
                // both ends stay at their rounded position, and the transition takes some points
                let (from, to) = (points.len() / 4, 3 * points.len() / 4);
                let [before, left] = [&points, &out].map(|p| roughest(&p[from..to]));
                let own = chord * chord * chord / (r * r);
                assert!(left <= 1.1 * own + 0.02 * before, "{chord} {r}: {left} of {before}");
                let way = largest_way(&points[from..to], &out[from..to]);
                assert!(way <= 1.6 * grain, "{chord} {r} {decimals}: {way}");
                let beside = |p: &Points| {
                    let square = |p: &Vec<f64>| {
                        let off = libm::hypot(p[0], p[1]) - r;
                        off * off
                    };
                    p[from..to].iter().map(square).sum::<f64>().sqrt()
                };
                // the spline itself makes the circle smaller by l^6 / r^5
                let smaller = libm::pow(0.4, 6.0) / libm::pow(r, 5.0);
                let smaller = smaller * ((to - from) as f64).sqrt();
                assert!(beside(&out) < 0.5 * beside(&points) + smaller, "{chord} {r} {decimals}");
            }
        }
    }
}

/// A line with a slope of 1 in 2500, rounded: steps of 1 um, 50 points apart.
#[test]
fn rounding_that_is_rare_goes() {
    let points: Points =
        (0..2000).map(|i| f64::from(i) * 0.05).map(|x| vec![x, x / 2500.0]).collect();
    let out = faired(&rounded(&points, 3), 2, within(0.05));
    assert!(roughest(&out) < 0.02e-3, "{}", roughest(&out));
    // apart from the ends, which stay
    assert!(largest_way(&points[60..1940], &out[60..1940]) < 0.6e-3);
}

/// Noise far above the limit: no displacement exceeds a tenth of the tolerances, and the tolerances shrink by the
/// displacement.
#[test]
fn the_room_is_kept_and_taken_off() {
    for (path_dev_mm, track_dev_deg) in [(0.2, 5.0), (0.01, 0.01), (0.002, 0.3), (0.0, 0.0)] {
        let points = rounded(&sampled(0.06, wave), 2);
        let settings = SplineSettings { path_dev_mm, track_dev_deg, ..SplineSettings::default() };
        let out = through(blocks(&points, 3, settings, |_, _| {}));
        let moved = ends(&out);
        let size = |i: usize, axes: std::ops::Range<usize>| {
            apart(&points[i][axes.clone()], &moved[i][axes])
        };
        let most = |dev: f64| if dev > 0.0 { MOST.min(SHARE * dev) } else { MOST };
        let mut largest = [0.0_f64; 2];
        for i in 0..points.len() {
            let sizes = [size(i, 0..3), size(i, 3..4)];
            assert!(sizes[0] <= most(path_dev_mm) * (1.0 + 1e-9), "{sizes:?}");
            assert!(sizes[1] <= most(track_dev_deg) * (1.0 + 1e-9), "{sizes:?}");
            largest = std::array::from_fn(|k| largest[k].max(sizes[k]));
        }
        assert!(largest[0] > 0.5 * most(path_dev_mm).min(most(track_dev_deg) / 40.0));
        for (i, block) in out.iter().enumerate().skip(1) {
            let Some(left) = block.spline else { panic!("a spline") };
            let sizes = (i - 1..i + 2).map(|k| size(k, 0..3)).fold(0.0, f64::max);
            let tracks = (i - 1..i + 2).map(|k| size(k, 3..4)).fold(0.0, f64::max);
            if path_dev_mm > 0.0 {
                assert!(left.path_dev_mm > 0.0 && left.path_dev_mm <= path_dev_mm - sizes + 1e-12);
                assert!(left.track_dev_deg > 0.0);
                assert!(left.track_dev_deg <= track_dev_deg - tracks + 1e-12);
            } else {
                assert_eq!(left, settings, "0 is not monitored");
            }
        }
    }
}

/// Corners of 40 degrees, reversals, ends, ends of long edges, and points between blocks of different conditions.
#[test]
fn what_stays() {
    let mut points = vec![vec![0.0, 0.0]];
    let mut fixed = vec![0];
    let mut heading = 0.3_f64;
    for (count, turn) in
        [(40, 0.7), (25, -1.2), (60, PI), (30, 3.1), (50, 0.0), (1, 0.0), (70, 0.0)]
    {
        let step = if count == 1 { 1.3 } else { 0.08 };
        for _ in 0..count {
            heading += 0.004;
            let last = &points[points.len() - 1];
            let (sin, cos) = libm::sincos(heading);
            points.push(vec![last[0] + step * cos, last[1] + step * sin]);
        }
        fixed.push(points.len() - 1);
        heading += turn;
    }
    let points = rounded(&points, 3);
    let out = faired(&points, 2, within(0.1));
    for i in &fixed {
        assert_eq!(points[*i], out[*i], "{i}");
    }
    let moves = points.iter().zip(&out).filter(|(p, q)| p != q).count();
    assert!(moves + 2 * fixed.len() > points.len(), "the others move: {moves}");

    let changes: [fn(&mut Block); 7] = [
        |b| b.spline = Some(within(0.11)),
        |b| b.spline = None,
        |b| b.slope.optimised = true,
        |b| b.tolerance.ax_dev_mm = Some(0.01),
        |b| b.feed = Feed::Rapid,
        |b| b.full_override = true,
        |b| b.dynamics = dynamics(2, 1),
    ];
    let points = rounded(&sampled(0.07, circle(8.0)), 3);
    for (n, change) in changes.into_iter().enumerate() {
        let given = blocks(&points, 2, within(0.1), |i, b| {
            if i >= 100 {
                change(b);
            }
        });
        let out = ends(&through(given));
        assert_eq!(points[100], out[100], "change {n}");
        assert_ne!(points[50], out[50], "change {n}");
    }
    let end_speed = |i: usize, b: &mut Block| b.end_velocity_mm_s = (i == 99).then_some(10.0);
    let out = ends(&through(blocks(&points, 2, within(0.1), end_speed)));
    assert_eq!(points[100], out[100]);
    // a new feed rate is not a different condition
    let given =
        blocks(&points, 2, within(0.1), |i, b| b.feed = Feed::PathVelocity(50.0 + i as f64));
    assert_eq!(ends(&through(given)), faired(&points, 2, within(0.1)));
}

/// The same contour in other representations: reversed, mirrored, with other axes, and divided at other points.
#[test]
fn the_way_of_looking_at_it_changes_nothing() {
    let points = rounded(&sampled(0.011, wave), 3);
    assert!(points.len() > 3 * CHUNK);
    let settings = within(0.05);
    let want = faired(&points, 4, settings);
    let same = |p: &Points, what: &str| {
        let off = largest_way(&want, p);
        assert!(off < 1e-6, "{what}: {off}");
    };
    let reversed: Points = points.iter().rev().cloned().collect();
    same(&faired(&reversed, 4, settings).into_iter().rev().collect(), "reversed");
    let mirror = |p: &Points| p.iter().map(|p| vec![-p[0], p[1], -p[2], p[3]]).collect::<Points>();
    same(&mirror(&faired(&mirror(&points), 4, settings)), "mirrored");
    let permute = |p: &Points| p.iter().map(|p| vec![p[3], p[2], p[1], p[0]]).collect::<Points>();
    same(&permute(&faired(&permute(&points), 4, settings)), "permuted");
    let shifted = faired(&points[150..], 4, settings);
    let off = largest_way(&want[550..], &shifted[400..]);
    assert!(off < 1e-6, "other chunks: {off}");
}

/// Edges of the size of the noise neither vanish nor reverse.
#[test]
fn the_shortest_edges_keep_their_order() {
    let mut points = rounded(&sampled(0.1, circle(10.0)), 3);
    for k in (0..12).rev() {
        let at = 40 * k + 7;
        let mut near = points[at].clone();
        near[k % 2] += if k % 3 == 0 { 1e-3 } else { -1e-3 };
        points.insert(at + 1, near);
    }
    let out = faired(&points, 2, within(0.05));
    for i in 1..out.len() - 2 {
        let d = |a: usize, b: usize| [out[b][0] - out[a][0], out[b][1] - out[a][1]];
        let (edge, chord) = (d(i, i + 1), d(i - 1, i + 2));
        let old = [points[i + 1][0] - points[i][0], points[i + 1][1] - points[i][1]];
        let moved = points[i] != out[i] || points[i + 1] != out[i + 1];
        let along = edge[0] * chord[0] + edge[1] * chord[1];
        let scale = libm::hypot(old[0], old[1]) * libm::hypot(chord[0], chord[1]);
        assert!(!moved || along > 0.2 * scale, "{i}: {along} {scale}");
    }
}
