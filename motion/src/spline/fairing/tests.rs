//! Control points against closed forms, brute force, and relations between inputs.

use super::build::built;
use super::knots::{Spline, evened};
use super::row::{Chord, Row, Vertex, apart};
use super::*;
use crate::example::{ChannelDynamics, Feed};
use crate::path::{LinePath, Path};
use kontur_kit::Random;
use std::f64::consts::TAU;
use std::sync::Arc;

type Points = Vec<Vec<f64>>;

fn within(path_dev_mm: f64) -> SplineSettings {
    SplineSettings { path_dev_mm, ..SplineSettings::default() }
}

/// The blocks of a polygon, of which the first axes are in the feed group.
fn blocks(points: &Points, feed_axes: usize, settings: SplineSettings) -> Vec<Block> {
    let axes = points[0].len();
    let flags = (0..axes).map(|i| i < feed_axes).collect();
    let all = ChannelDynamics::new(vec![crate::example::axis(); axes]);
    let dynamics = Arc::new(ChannelDynamics { feed_axes: flags, ..all });
    let block = |(i, w): (usize, &[Vec<f64>])| {
        let [from, to] = [&w[0], &w[1]].map(|p| AxisVec::from_slice(p));
        let line = LinePath::new(from, to, &dynamics.feed_axes)?;
        let feed = Feed::PathVelocity(50.0);
        let block = Block::new(i as u64, Path::Line(line), feed, Arc::clone(&dynamics));
        Some(Block { spline: Some(settings), ..block })
    };
    points.windows(2).enumerate().filter_map(block).collect()
}

/// The legs that the stage outputs.
fn legs(blocks: Vec<Block>) -> Vec<Edge> {
    let mut stage = Fairing::default();
    let mut out = Vec::new();
    let mut keep = |o: Out| {
        if let Out::Edge(edge) = o {
            out.push(*edge);
        }
    };
    for block in blocks {
        stage.push(block).for_each(&mut keep);
        assert!(stage.vertices.len() <= CHUNK + 2 * MARGIN + 2, "the window is bounded");
        assert!(stage.stretches.len() <= (CHUNK + MARGIN + 2) * (PASSED + 1));
    }
    stage.flush().for_each(&mut keep);
    out
}

fn rounded(points: &Points, decimals: i32) -> Points {
    let scale = libm::pow(10.0, f64::from(decimals));
    points.iter().map(|p| p.iter().map(|x| libm::round(x * scale) / scale).collect()).collect()
}

/// Points of a curve with this arc length, in random chords around `chord`.
fn sampled(seed: u64, chord: f64, whole: f64, curve: impl Fn(f64) -> Vec<f64>) -> Points {
    let mut random = Random::from_state(seed);
    let next = |s: &f64| Some(s + chord * random.between(0.5, 1.5));
    std::iter::successors(Some(0.0), next).take_while(|s| *s < whole).map(curve).collect()
}

fn circle(r: f64) -> impl Fn(f64) -> Vec<f64> {
    move |s| vec![r * libm::cos(s / r), r * libm::sin(s / r)]
}

fn wave(s: f64) -> Vec<f64> {
    vec![s, 2.0 * libm::sin(0.5 * s), libm::cos(0.7 * s)]
}

fn row(points: &Points, settings: SplineSettings) -> Vec<Vertex> {
    let mut at = 0.0;
    let mut last = points[0].clone();
    let of = |p: &Vec<f64>| {
        let axes: Vec<usize> = (0..p.len()).collect();
        at += apart(&last, p, &axes);
        last.clone_from(p);
        let chord = Chord { settings, off: [0.0; 2] };
        Vertex { point: AxisVec::from_slice(p), at, chord, stays: false }
    };
    points.iter().map(of).collect()
}

/// Filtered values keep both ends and their order; equal steps stay equal, and the sum of squared differences of
/// steps shrinks.
#[test]
fn evened_knots() {
    let mut random = Random::from_state(5);
    for count in [2, 3, 5, 200] {
        let mut at = 0.0;
        let given: Vec<f64> = (0..count)
            .map(|_| {
                at += random.log(1e-3, 1.0);
                at
            })
            .collect();
        let mut out = given.clone();
        evened(&mut out);
        assert!(out[0].to_bits() == given[0].to_bits());
        assert!(out[count - 1].to_bits() == given[count - 1].to_bits());
        assert!(out.windows(2).all(|w| w[1] > w[0]));
        let rough = |t: &[f64]| {
            let second = |w: &[f64]| (w[2] - 2.0 * w[1] + w[0]) * (w[2] - 2.0 * w[1] + w[0]);
            t.windows(3).map(second).sum::<f64>()
        };
        assert!(count < 5 || rough(&out) < 0.5 * rough(&given));
        let mut equal: Vec<f64> = (0..count).map(|i| 0.25 * i as f64).collect();
        let want = equal.clone();
        evened(&mut equal);
        assert_eq!(equal, want);
    }
}

/// A cubic is reproduced: its control points are blossoms, `f(t[j-1], t[j], t[j+1])`.
#[test]
fn the_basis_reproduces_a_cubic() {
    let mut random = Random::from_state(8);
    let mut at = 0.0;
    let knots: Vec<f64> = (0..12)
        .map(|_| {
            at += random.between(0.1, 2.0);
            at
        })
        .collect();
    let blossom = |x: f64, y: f64, z: f64| {
        1.0 + 2.0 * (x + y + z) - 0.5 * (x * y + y * z + z * x) + 0.3 * x * y * z
    };
    let n = knots.len() - 1;
    let points = (0..=n)
        .map(|j| match j {
            0 => 0.0,
            _ if j == n => 0.0,
            _ => blossom(knots[j - 1], knots[j], knots[j + 1]),
        })
        .collect();
    let spline = Spline::new(&knots, &[points]);
    for j in 2..n - 2 {
        for u in [0.0, 0.3, 0.9] {
            let x = knots[j] + u * (knots[j + 1] - knots[j]);
            assert_eq!(spline.interval(0, x), j);
            let basis = spline.basis(j, x);
            assert!((basis.iter().sum::<f64>() - 1.0).abs() < 1e-12);
            assert!((spline.beyond(0, &basis, j, 0.0) - blossom(x, x, x)).abs() < 1e-9);
        }
        let want = -3.0 + 1.8 * knots[j];
        assert!((spline.second(0, j) - want).abs() < 1e-9);
    }
    let thirds = spline.third_factors(4);
    let c: Vec<f64> = (3..7).map(|j| blossom(knots[j - 1], knots[j], knots[j + 1])).collect();
    let third: f64 = thirds.iter().zip(&c).map(|(f, c)| f * c).sum();
    assert!((third - 1.8).abs() < 1e-9, "{third}");
}

/// The bound is at least the distance at every parameter, found by dense sampling, and not far above the largest.
#[test]
fn the_certificate_is_a_bound() {
    let groups = [vec![0, 1, 2], vec![]];
    for seed in 0..20 {
        let points = rounded(&sampled(seed, 0.02 + 0.02 * seed as f64, 20.0, wave), 3);
        let vertices = row(&points, within(0.05));
        let view = Row { vertices: &vertices, groups: &groups };
        let out = built(&view);
        for chain in out.chains() {
            let nodes = &out.nodes[chain.start..=chain.end];
            let knots: Vec<f64> = nodes.iter().map(|n| n.knot).collect();
            let of_axis = |axis: usize| nodes.iter().map(|n| n.point[axis]).collect();
            let spline = Spline::new(&knots, &(0..3).map(of_axis).collect::<Vec<Vec<f64>>>());
            let (a, b) = (nodes[0].place.0, nodes[nodes.len() - 1].place.0);
            let at: Vec<f64> = vertices[a..=b].iter().map(|v| v.at).collect();
            let by_axis: Vec<Vec<f64>> =
                (0..3).map(|k| points[a..=b].iter().map(|p| p[k]).collect()).collect();
            let views: Vec<&[f64]> = by_axis.iter().map(|p| &p[..]).collect();
            let bounds = certificate::bounds(&spline, &at, &views);
            let mut largest = 0.0_f64;
            for (i, bound) in bounds.iter().enumerate() {
                for k in 0..=40 {
                    let u = f64::from(k) / 40.0;
                    let x = at[i] + u * (at[i + 1] - at[i]);
                    let j = spline.interval(0, x);
                    let basis = spline.basis(j, x);
                    let off = (0..3).map(|axis| {
                        let p = views[axis];
                        spline.beyond(axis, &basis, j, p[i] + u * (p[i + 1] - p[i]))
                    });
                    let off = off.map(|d| d * d).sum::<f64>().sqrt();
                    assert!(off <= bound + 1e-12, "{seed} edge {i}: {off} {bound}");
                    largest = largest.max(off);
                }
            }
            let most = bounds.iter().copied().fold(0.0, f64::max);
            assert!(most <= 0.05 && most < 2.0 * largest + 1e-3, "{seed}: {most} {largest}");
        }
    }
}

/// A run fitted in windows has the control points of the same run fitted as a whole: to 20 nm.
#[test]
fn windows_change_nothing() {
    for (decimals, most) in [(12, 2e-5), (3, 2e-5)] {
        for (seed, chord) in [(1, 0.02), (2, 0.05), (3, 0.1)] {
            let points = rounded(&sampled(seed, chord, 1500.0 * chord, circle(10.0)), decimals);
            let settings = within(0.01);
            let mut stage = Fairing { groups: [vec![0, 1], vec![]], ..Fairing::default() };
            // without windows
            let mut whole = Vec::new();
            let start = points[0].clone();
            stage.start(AxisVec::from_slice(&start));
            for block in blocks(&points, 2, settings) {
                let Some(chord) = stage.chord(&block) else { panic!("a spline") };
                stage.push_vertex(block, chord);
            }
            stage.end_run();
            for out in stage.ready.drain(..) {
                if let Out::Edge(edge) = out {
                    whole.push(*edge);
                }
            }
            let windows = legs(blocks(&points, 2, settings));
            assert!(whole.len() > 3 * CHUNK && whole.len() == windows.len());
            for (i, (a, b)) in whole.iter().zip(&windows).enumerate() {
                let off = apart(a.block.path.end(), b.block.path.end(), &[0, 1]);
                assert!(off < most, "chord {chord}, {decimals} decimals, {i}: {off}");
            }
        }
    }
}

/// Whatever the input: legs are connected, the parts of every block are in order and complete, and corners are
/// programmed points.
#[test]
fn every_block_is_output_once() {
    for seed in 0..60 {
        let mut random = Random::from_state(seed);
        let (mut p, mut heading) = ([0.0, 0.0], 0.0_f64);
        let mut points = vec![p.to_vec()];
        for _ in 0..900 {
            let chord = if random.chance(0.1) { 1e-3 } else { random.log(2e-3, 2.0) };
            heading += if random.chance(0.05) { random.between(-3.0, 3.0) } else { 0.02 };
            let (sin, cos) = libm::sincos(heading);
            p = [p[0] + chord * cos, p[1] + chord * sin];
            points.push(p.to_vec());
        }
        let mut points = rounded(&points, 3);
        points.dedup();
        let count = points.len() as u64 - 1;
        let out = legs(blocks(&points, 2, within(random.log(1e-3, 0.2))));
        let mut next = 0;
        let mut share = 0.0;
        for w in out.windows(2) {
            assert_eq!(w[0].block.path.end(), w[1].block.path.start());
        }
        for edge in &out {
            let mut until = 0.0;
            for part in &edge.parts {
                assert_eq!(part.block.seq, next, "{seed}");
                assert!(part.until > until && part.share > 0.0, "{seed}: {part:?}");
                until = part.until;
                share += part.share;
                if part.last {
                    assert!((share - 1.0).abs() < 1e-9);
                    (next, share) = (next + 1, 0.0);
                }
            }
            assert!((until - 1.0).abs() < 1e-12);
            if edge.corner.programmed {
                let here = edge.block.path.start();
                assert!(points.iter().any(|p| p[..] == here[..]), "{seed}");
            }
        }
        assert_eq!(next, count, "{seed}");
    }
}

/// Collinear points on an axis: the other axes do not move at all, and nothing is a corner but the ends.
#[test]
fn straight_lines_stay_exactly_straight() {
    let along = sampled(3, 0.05, 30.0, |s| vec![s, 5.123, -7.0]);
    for points in [along.clone(), rounded(&along, 3)] {
        let out = legs(blocks(&points, 3, within(0.05)));
        assert!(out.iter().skip(1).all(|edge| !edge.corner.programmed));
        for edge in &out {
            let end = edge.block.path.end();
            assert!(end[1].to_bits() == 5.123_f64.to_bits());
            assert!(end[2].to_bits() == (-7.0_f64).to_bits());
        }
    }
}

/// Rounding disappears: the third derivative of the control points of a rounded circle is that of the exact circle.
#[test]
fn rounding_goes() {
    let third = |legs: &[Edge]| {
        let mut knots = vec![0.0];
        for edge in legs {
            knots.push(knots[knots.len() - 1] + edge.interval);
        }
        let frame = Spline::new(&knots, &[]);
        let of = |j: usize| {
            let factors = frame.third_factors(j);
            let third = |axis: usize| {
                let c = (0..4).map(|k| legs[j - 1 + k].block.path.start()[axis]);
                factors.iter().zip(c).map(|(f, c)| f * c).sum::<f64>()
            };
            libm::hypot(third(0), third(1))
        };
        (legs.len() / 4..3 * legs.len() / 4).map(of).fold(0.0, f64::max)
    };
    for (chord, r) in [(0.05, 3.0), (0.05, 10.0), (0.1, 10.0), (0.3, 10.0)] {
        let equal = (0..=(TAU * r / chord) as usize).map(|i| circle(r)(i as f64 * chord)).collect();
        let exact = third(&legs(blocks(&equal, 2, within(0.05))));
        assert!((exact * r * r - 1.0).abs() < 0.01, "{exact}");
        let here = third(&legs(blocks(&rounded(&equal, 3), 2, within(0.05))));
        assert!((here * r * r - 1.0).abs() < 0.1, "chord {chord} r {r}: {}", here * r * r);
    }
}

/// Points that are no further apart than a share of the tolerance are passed over, their blocks are not; the last one
/// is the end of the run in any case.
#[test]
fn close_points_are_passed_over() {
    let line: Points = (0..200).map(|i| vec![0.1 * f64::from(i), 0.0]).collect();
    for [x, y] in [[1e-3, 0.0], [-1e-3, 0.0], [0.0, 1e-3], [-1e-3, 1e-3]] {
        let mut points = line.clone();
        for i in (10..200).step_by(10).rev() {
            let near = vec![points[i][0] + x, points[i][1] + y];
            points.insert(i + 1, near);
        }
        let last = points[points.len() - 1].clone();
        points.push(vec![last[0] + x, last[1] + y]);
        let out = legs(blocks(&points, 2, within(0.01)));
        assert!(out.iter().skip(1).all(|edge| !edge.corner.programmed));
        assert!(out.len() <= line.len());
        let end = out[out.len() - 1].block.path.end();
        assert_eq!(end[..], points[points.len() - 1][..]);
        let ended = out.iter().flat_map(|e| &e.parts).filter(|part| part.last).count();
        assert_eq!(ended, points.len() - 1);
    }
    // a run of nothing but such blocks is not a spline
    let tiny: Points = (0..4).map(|i| vec![2e-4 * f64::from(i), 0.0]).collect();
    assert!(legs(blocks(&tiny, 2, within(0.01))).is_empty());
}
