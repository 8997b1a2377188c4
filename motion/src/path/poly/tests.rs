use super::*;
use kontur_kit::Random;

/// `x = 3 u`, `y = u^2 - u^5`, slaved `z = 7 u^3`.
fn sample() -> PolyPath {
    let x = [10.0, 3.0, 0.0, 0.0, 0.0, 0.0];
    let y = [5.0, 0.0, 1.0, 0.0, 0.0, -1.0];
    let z = [1.0, 0.0, 0.0, 7.0, 0.0, 0.0];
    PolyPath::new(
        AxisVec::from_slice(&[10.0, 5.0, 1.0]),
        AxisVec::from_slice(&[13.0, 5.0, 8.0]),
        vec![PolyPiece::from_slice(&[x, y, z])],
        &[true, true, false],
    )
    .unwrap()
}

/// Simpson with 200 000 intervals, error far below 1e-12.
fn simpson(path: &PolyPath, to: f64) -> f64 {
    let n = 200_000;
    let h = to / f64::from(n);
    let f = |k: i32| path.rate(0, h * f64::from(k));
    let inner: f64 = (1..n).map(|k| f(k) * if k % 2 == 1 { 4.0 } else { 2.0 }).sum();
    h / 3.0 * (f(0) + inner + f(n))
}

#[test]
fn length_and_position_agree_with_a_fine_integration() {
    let path = sample();
    assert!((path.length() - simpson(&path, 1.0)).abs() < 1e-11);
    let mut q = [0.0; 3];
    for u in [0.1, 0.35, 0.5, 0.77, 0.99] {
        path.position(simpson(&path, u), &mut q);
        assert!((q[0] - 10.0 - 3.0 * u).abs() < 1e-9, "{u}: {q:?}");
        assert!((q[2] - 1.0 - 7.0 * u * u * u).abs() < 1e-9);
    }
}

#[test]
fn derivatives_agree_with_differences() {
    let path = sample();
    let h = 1e-4;
    let third = |s: f64| {
        let (piece, x) = path.locate(s);
        path.derivatives(piece, x).third
    };
    for s in [0.3, 1.1, 2.0, 2.9] {
        let (mut t, mut c) = ([0.0; 3], [0.0; 3]);
        path.tangent(s, &mut t);
        path.curvature(s, &mut c);
        let at = |s: f64, f: &dyn Fn(f64, &mut [f64])| {
            let mut q = [0.0; 3];
            f(s, &mut q);
            q
        };
        let position = |s: f64, q: &mut [f64]| path.position(s, q);
        let tangent = |s: f64, q: &mut [f64]| path.tangent(s, q);
        let curvature = |s: f64, q: &mut [f64]| path.curvature(s, q);
        for i in 0..3 {
            let d = |f: &dyn Fn(f64, &mut [f64])| (at(s + h, f)[i] - at(s - h, f)[i]) / (2.0 * h);
            assert!((d(&position) - t[i]).abs() < 1e-6);
            assert!((d(&tangent) - c[i]).abs() < 1e-6);
            assert!((d(&curvature) - third(s)[i]).abs() < 1e-5 * (1.0 + third(s)[i].abs()));
        }
        assert!((libm::hypot(t[0], t[1]) - 1.0).abs() < 1e-14, "feed axes have unit speed");
    }
}

#[test]
fn ends_are_exact_and_the_nearest_point_is_found() {
    let path = sample();
    let mut q = [0.0; 3];
    path.position(0.0, &mut q);
    assert_eq!(q[..], path.start()[..]);
    path.position(path.length(), &mut q);
    assert_eq!(q[..], path.end()[..]);
    for k in 0..=1000 {
        let s = path.length() * f64::from(k) / 1000.0;
        path.position(s, &mut q);
        assert!((path.nearest(&q) - s).abs() < 1e-9, "{s}");
        let mut nearest = [0.0; 3];
        path.nearest_point(&q, &mut nearest);
        let apart = nearest.iter().zip(&q).fold(0.0, |d: f64, (n, q)| d.max((n - q).abs()));
        assert!(apart < 1e-9, "{s}");
        if k == 0 || k == 1000 {
            assert_eq!(nearest.map(f64::to_bits), q.map(f64::to_bits), "ends are exact");
        }
    }
}

/// Random curves of several pieces: none of 20,000 points is nearer than the one found, from any point of view; every
/// point of a sub-interval is within its radius, and [`PolyPath::near`] is close to the exact point.
#[test]
fn nothing_is_nearer_than_the_nearest_point() {
    let mut random = Random::from_state(7);
    for _ in 0..30 {
        let mut at = [0.0; 2];
        let pieces: Vec<PolyPiece> = (0..4)
            .map(|_| {
                let axes = at.map(|start| {
                    let mut c = [0.0; 6].map(|_: f64| 4.0 * random.between(-1.0, 1.0));
                    c[0] = start;
                    c
                });
                at = [0, 1].map(|i| axes[i].iter().sum());
                PolyPiece::from_slice(&axes)
            })
            .collect();
        let path = PolyPath::through(pieces, &[true, true]).unwrap();
        let mut q = AxisVec::zeros(2);
        let points: Vec<[f64; 2]> = (0..20_000)
            .map(|k| {
                path.position(path.length() * f64::from(k) / 19_999.0, &mut q);
                [q[0], q[1]]
            })
            .collect();
        for (point, k) in points.iter().zip(0..) {
            path.near(path.length() * f64::from(k) / 19_999.0, &mut q);
            let apart = libm::hypot(q[0] - point[0], q[1] - point[1]);
            assert!(apart <= 1e-7 * path.length(), "{apart} of {}", path.length());
        }
        for cell in path.cells.iter() {
            path.point(cell.piece, cell.middle(), &mut q);
            let middle = q.clone();
            for k in 0..=50 {
                path.point(
                    cell.piece,
                    cell.from + (cell.to - cell.from) * f64::from(k) / 50.0,
                    &mut q,
                );
                let far = libm::hypot(q[0] - middle[0], q[1] - middle[1]);
                assert!(far <= cell.radius + 1e-12, "{far} > {}", cell.radius);
            }
        }
        for _ in 0..20 {
            let from = [15.0 * random.between(-1.0, 1.0), 15.0 * random.between(-1.0, 1.0)];
            path.nearest_point(&from, &mut q);
            let found = libm::hypot(q[0] - from[0], q[1] - from[1]);
            let least = points
                .iter()
                .map(|p| libm::hypot(p[0] - from[0], p[1] - from[1]))
                .fold(f64::INFINITY, f64::min);
            assert!(found <= least + 1e-6, "{found} from {from:?}, {least} along the curve");
        }
    }
}

#[test]
fn no_sample_exceeds_the_extremes() {
    let path = sample();
    let bends: Vec<(f64, f64)> = path.bends().collect();
    assert_eq!(bends[bends.len() - 1].0.to_bits(), path.length().to_bits());
    for k in 0..=10_000 {
        let s = path.length() * f64::from(k) / 10_000.0;
        let (piece, x) = path.locate(s);
        let d = path.derivatives(piece, x);
        let bend = bends[bends.partition_point(|b| b.0 < s)].1;
        for i in 0..3 {
            assert!(d.second[i].abs() <= bend * (1.0 + 1e-9), "{s}");
            for (value, limit) in [&d.first, &d.second, &d.third].iter().zip(path.extremes()) {
                assert!(value[i].abs() <= limit[i] * (1.0 + 1e-12) + 1e-15);
            }
        }
    }
}

/// Random quintics in several pieces: no dense sample is outside the extent, and one comes as close to it as the
/// spacing of the samples permits; a parabola by its closed form.
#[test]
fn the_extent_of_an_axis_holds_every_sample() {
    let parabola = [0.0, 4.0, -4.0, 0.0, 0.0, 0.0];
    let straight = [0.0, 2.0, 0.0, 0.0, 0.0, 0.0];
    let pieces = vec![PolyPiece::from_slice(&[parabola, straight])];
    let path = PolyPath::through(pieces, &[true, true]).unwrap();
    let (low, high) = path.extent(0);
    assert!(low == 0.0 && (high - 1.0).abs() < 1e-9, "{low} {high}");
    assert_eq!(path.extent(1), (0.0, 2.0));

    let mut r = kontur_kit::Random::new(7);
    for _ in 0..50 {
        let mut from = [0.0; 2];
        let pieces: Vec<PolyPiece> = (0..3)
            .map(|_| {
                let axes = from.map(|start| {
                    let mut c = [0.0; 6].map(|_: f64| r.between(-10.0, 10.0));
                    c[0] = start;
                    c
                });
                from = axes.map(|c| c.iter().sum());
                PolyPiece::from_slice(&axes)
            })
            .collect();
        let path = PolyPath::through(pieces.clone(), &[true, true]).unwrap();
        for axis in 0..2 {
            let (low, high) = path.extent(axis);
            let n = 2000;
            let samples = pieces.iter().flat_map(|piece| {
                (0..=n).map(move |k| piece::point(piece, f64::from(k) / f64::from(n))[axis])
            });
            let (least, most) =
                samples.fold((f64::MAX, f64::MIN), |(a, b), x| (x.min(a), x.max(b)));
            // a second derivative of up to 2200 over half the spacing
            let miss = 0.125 * 2200.0 / f64::from(n * n);
            assert!(low <= least + 2e-9 && least - low < miss, "{low} {least}");
            assert!(high >= most - 2e-9 && high - most < miss, "{high} {most}");
        }
    }
}

/// The cusp of the curve (t^2, t^3), whose length from it is ((4 + 9 t^2)^(3/2) - 8) / 27: the speed of the parameter is 0 there.
#[test]
fn positions_beside_a_cusp_have_their_length() {
    let toward = [[1.0, -2.0, 1.0, 0.0, 0.0, 0.0], [-1.0, 3.0, -3.0, 1.0, 0.0, 0.0]];
    let away = [[0.0, 0.0, 1.0, 0.0, 0.0, 0.0], [0.0, 0.0, 0.0, 1.0, 0.0, 0.0]];
    let pieces = [toward, away].map(|axes| PolyPiece::from_slice(&axes)).to_vec();
    let path = PolyPath::through(pieces, &[true, true]).unwrap();
    let from_cusp = |t: f64| (libm::pow(4.0 + 9.0 * t * t, 1.5) - 8.0) / 27.0;
    assert!((path.length() - 2.0 * from_cusp(1.0)).abs() < 1e-12);
    let mut q = [0.0; 2];
    for exponent in 0..=60 {
        let t = libm::pow(10.0, -0.1 * f64::from(exponent));
        for side in [-1.0, 1.0] {
            let s = from_cusp(1.0) + side * from_cusp(t);
            path.position(s, &mut q);
            let off = libm::hypot(q[0] - t * t, q[1] - side * t * t * t);
            assert!(off < 1e-12, "{t}: {off}");
            path.near(s, &mut q);
            let off = libm::hypot(q[0] - t * t, q[1] - side * t * t * t);
            assert!(off < 1e-7 * path.length(), "{t}: {off}");
        }
    }
}
