//! Arcs oblique to the axes, compared with explicit rotations and with dense samples.

use kontur_kit::Random;
use kontur_motion::axis::AxisVec;
use kontur_motion::limits::PathExtremes;
use kontur_motion::path::{ArcPath, ArcShape, Path, Tilt, TiltedArc};
use std::f64::consts::{FRAC_PI_6, PI, TAU};

/// Turned by `rad` about the second axis: X = x cos + z sin, Z = z cos - x sin.
fn about_y(rad: f64, t_mm: [f64; 3]) -> Tilt {
    let (s, c) = libm::sincos(rad);
    Tilt { axes: [0, 1, 2], m: [[c, 0.0, s], [0.0, 1.0, 0.0], [-s, 0.0, c]], t_mm }
}

fn tilted(tilt: Tilt, start: [f64; 4], end: [f64; 4], centre: [f64; 2], sweep_rad: f64) -> Path {
    let (start, end) = (AxisVec::from_slice(&start), AxisVec::from_slice(&end));
    let shape = ArcShape { plane: [0, 1], centre_mm: centre, sweep_rad };
    let image = (tilt.position(&start), tilt.position(&end));
    let arc = ArcPath::new(start, end, shape, &[true, true, true, false]).unwrap();
    Path::Tilted(Box::new(TiltedArc::new(arc, tilt, image.0, image.1)))
}

fn at(path: &Path, s: f64) -> [f64; 4] {
    let mut q = [0.0; 4];
    path.position(s, &mut q);
    q
}

/// Lowest and highest positions.
fn extent(path: &Path) -> ([f64; 4], [f64; 4]) {
    let of = |axis| path.extent(axis).unwrap();
    (std::array::from_fn(|axis| of(axis).0), std::array::from_fn(|axis| of(axis).1))
}

fn assert_near(a: &[f64], b: &[f64], tolerance: f64) {
    assert!(a.iter().zip(b).all(|(x, y)| (x - y).abs() < tolerance), "{a:?} instead of {b:?}");
}

#[test]
fn a_half_circle_turned_by_thirty_degrees() {
    let tilt = about_y(FRAC_PI_6, [100.0, 0.0, -7.0]);
    let path = tilted(tilt, [0.0; 4], [10.0, 0.0, 0.0, 0.0], [5.0, 0.0], -PI);
    let (s, c) = (0.5, 0.75_f64.sqrt());
    assert!((path.length() - 5.0 * PI).abs() < 1e-12);
    assert_near(&at(&path, 2.5 * PI), &[100.0 + 5.0 * c, 5.0, -7.0 - 5.0 * s, 0.0], 1e-12);
    assert_near(&at(&path, path.length()), &[100.0 + 10.0 * c, 0.0, -7.0 - 10.0 * s, 0.0], 1e-12);
    let (low, high) = extent(&path);
    assert_near(&low, &[100.0, 0.0, -7.0 - 10.0 * s, 0.0], 1e-12);
    assert_near(&high, &[100.0 + 10.0 * c, 5.0, -7.0, 0.0], 1e-12);
}

#[test]
fn a_helix_turns_round_where_height_and_circle_cancel() {
    // X = r cos(angle) cos(b) + h angle / (2 pi) sin(b)
    let (r, h, b) = (5.0, 12.0, 0.4);
    let tilt = about_y(b, [0.0; 3]);
    let path = tilted(tilt, [r, 0.0, 0.0, 0.0], [r, 0.0, h, 9.0], [0.0, 0.0], TAU);
    assert!((path.length() - libm::hypot(TAU * r, h)).abs() < 1e-12);
    let x = |angle: f64| r * libm::cos(angle) * libm::cos(b) + h * angle / TAU * libm::sin(b);
    let first = libm::asin(h * libm::tan(b) / (TAU * r));
    let (low, high) = extent(&path);
    // it first turns back at `first`, then forward at half a turn less `first`
    assert!((low[0] - x(PI - first)).abs() < 1e-12, "{low:?}");
    assert!((high[0] - x(first).max(x(TAU))).abs() < 1e-12, "{high:?}");
    assert!((low[3], high[3]) == (0.0, 9.0));
    let half = at(&path, 0.5 * path.length());
    let (s, c) = libm::sincos(b);
    assert_near(&half, &[-r * c + 6.0 * s, 0.0, r * s + 6.0 * c, 4.5], 1e-12);
}

#[test]
fn derivatives_extremes_and_nearest_points_of_random_arcs() {
    let mut random = Random::from_state(11);
    let mut next = || random.ratio();
    for _ in 0..200 {
        let tilt = about_y(TAU * next(), [20.0 * next(), -3.0, 5.0]);
        let (r, from, sweep) = (1.0 + 20.0 * next(), TAU * next(), (next() - 0.5) * 30.0);
        let height = if next() < 0.5 { 0.0 } else { 30.0 * next() };
        let point = |a: f64, z: f64| [r * libm::cos(a), r * libm::sin(a), z, 0.0];
        let path =
            tilted(tilt, point(from, 1.0), point(from + sweep, 1.0 + height), [0.0; 2], sweep);
        let (low, high) = extent(&path);
        let extremes = PathExtremes::of(&path);
        let n = 4000;
        let (mut least, mut most) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        let (mut first, mut second) = ([0.0_f64; 3], [0.0_f64; 3]);
        for k in 0..=n {
            let s = path.length() * f64::from(k) / f64::from(n);
            let q = at(&path, s);
            let (mut t, mut c) = ([0.0; 4], [0.0; 4]);
            path.tangent(s, &mut t);
            path.curvature(s, &mut c);
            assert!((t[0] * t[0] + t[1] * t[1] + t[2] * t[2] - 1.0).abs() < 1e-9);
            for i in 0..3 {
                least[i] = least[i].min(q[i]);
                most[i] = most[i].max(q[i]);
                first[i] = first[i].max(t[i].abs());
                second[i] = second[i].max(c[i].abs());
            }
        }
        // a sample misses an extreme by at most curvature * half a step squared / 2
        let step = path.length() / f64::from(n);
        let missed = step * step / (8.0 * r) + 1e-9;
        for i in 0..3 {
            assert!(low[i] <= least[i] + 1e-9 && low[i] > least[i] - missed, "{i}");
            assert!(high[i] >= most[i] - 1e-9 && high[i] < most[i] + missed, "{i}");
            assert!(extremes.first[i] >= first[i] - 1e-9 && extremes.second[i] >= second[i] - 1e-9);
            if height == 0.0 {
                assert!(
                    extremes.first[i] < first[i] + 1e-4 && extremes.second[i] < second[i] + 1e-4
                );
            }
        }
        let s = path.length() * next();
        let found = path.nearest(&at(&path, s));
        assert_near(&at(&path, found), &at(&path, s), 1e-6);
    }
}
