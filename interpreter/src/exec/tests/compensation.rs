//! Tool radius compensation.

use super::{assert_near, clean, run};
use kontur_motion::block::Feed;
use kontur_motion::path::Path;
use std::f64::consts::PI;

/// The star of the page on inside corner selection (207798283): eight lines around the origin, with radius 10 inside it. The path
/// passes each tip at the distance r / sin(half of its angle) from the corner, each notch at r / sin(half of the outer angle).
#[test]
fn inside_corner_selection() {
    const STAR: [[f64; 2]; 8] = [
        [0.0, 100.0],
        [-20.0, 20.0],
        [-100.0, 0.0],
        [-20.0, -20.0],
        [0.0, -100.0],
        [20.0, -20.0],
        [100.0, 0.0],
        [20.0, 20.0],
    ];
    let blocks: Vec<String> = STAR[1..].iter().map(|[x, y]| format!("X{x} Y{y}")).collect();
    let blocks = blocks.join("\n");
    let text = format!(
        "G17 G00 X0 Y0 Z0 G90\nF10000\nG238\nV.G.WZR = 10\nG41\nG01 X0 Y100\n{blocks}\nG01 X0 Y100\nG40\nG00 X0 Y0\nM30\n"
    );
    let run = clean(&text);
    // the distance of the point (0, y) from the line through (0, 100) and (20, 20) is (100 - y) * 20 / |(20, 80)|
    let tip = 100.0 - 10.0 * 6800.0_f64.sqrt() / 20.0;
    let e = run.ends();
    assert_near(&e[0][..2], &[0.0, tip]);
    assert_near(&e[e.len() - 2][..2], &[0.0, tip]);
    assert_near(&e[e.len() - 1], &[0.0, 0.0, 0.0]);
    // never nearer to the contour than the radius, and at this distance on every side
    for (from, to) in STAR.iter().zip(STAR.iter().cycle().skip(1)) {
        let away = |p: &[f64]| {
            let (d, r) = ([to[0] - from[0], to[1] - from[1]], [p[0] - from[0], p[1] - from[1]]);
            let t = ((d[0] * r[0] + d[1] * r[1]) / (d[0] * d[0] + d[1] * d[1])).clamp(0.0, 1.0);
            libm::hypot(r[0] - t * d[0], r[1] - t * d[1])
        };
        let nearest = e[..e.len() - 1].iter().map(|p| away(p)).fold(f64::MAX, f64::min);
        assert!((nearest - 10.0).abs() < 1e-9, "{nearest}");
    }
}

/// G11: F applies to the contour on arcs: the centre of a tool of 5 mm inside an arc of 10 mm moves at 5/10 of it. An arc below
/// RMIN keeps F. Based on 207065483 of the programming manual.
#[test]
fn feed_of_the_engagement() {
    let feeds = |before: &str| {
        let text = format!(
            "V.G.WZR=5\n{before}G41 G01 X0 Y20 F600\nX20 Y20\nG03 X40 R10\nG01 Y40\nG02 X44 R2\nG01 Y20\nG40 G10 X60\nM30\n"
        );
        let run = run(&text);
        assert!(run.ids().iter().all(|id| id == "K-0111"), "{:?}", run.ids());
        let arcs = |b: &kontur_motion::block::Block| match &b.path {
            Path::Arc(arc) => Some((arc.radius(), b.feed)),
            _ => None,
        };
        run.blocks().into_iter().filter_map(arcs).collect::<Vec<_>>()
    };
    let of = |feeds: &[(f64, Feed)], radius: f64| {
        let arc = feeds.iter().find(|(r, _)| (r - radius).abs() < 1e-9).unwrap();
        match arc.1 {
            Feed::PathVelocity(v) => v,
            other => panic!("{other:?}"),
        }
    };
    let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-9, "{a} instead of {b}");
    let plain = feeds("G25\n");
    near(of(&plain, 5.0), 10.0);
    near(of(&plain, 7.0), 10.0);
    let adapted = feeds("G25 G11\n");
    near(of(&adapted, 5.0), 5.0);
    near(of(&adapted, 7.0), 35.0);
    let limited = feeds("#TANGFEED [RMIN=3]\nG25 G11\n");
    near(of(&limited, 5.0), 5.0);
    near(of(&limited, 7.0), 10.0);
}

/// An acute outer corner of 120 deg: the parallels intersect at tan(60 deg) = 1.732 radii, within a factor of 2.
#[test]
fn lines_of_acute_corners_stretch() {
    let corner = |factor: &str| {
        let (x, y) = (10.0 + 20.0 * libm::cos(-2.0 * PI / 3.0), 20.0 * libm::sin(-2.0 * PI / 3.0));
        let text = format!("G25 {factor}\nX-5 Y0\nG41 X0 Y0\nX10\nX{x:.12} Y{y:.12}\nG40 X0 Y-50");
        let ends = clean(&format!("V.G.WZ[1].R=2\nD1 F100\n{text}\nM30\n")).ends();
        ends[2..ends.len() - 2].iter().map(|p| [p[0], p[1]]).collect::<Vec<_>>()
    };
    let w = [libm::cos(-2.0 * PI / 3.0), libm::sin(-2.0 * PI / 3.0)];
    // the start of the second parallel
    let after = [10.0 - 2.0 * w[1], 2.0 * w[0]];
    let stretched =
        |n: f64| [[10.0 + 2.0 * n, 2.0], [after[0] - 2.0 * n * w[0], after[1] - 2.0 * n * w[1]]];
    let same = |found: Vec<[f64; 2]>, expected: &[[f64; 2]]| {
        assert_eq!(found.len(), expected.len(), "{found:?}");
        for (a, b) in found.iter().zip(expected) {
            assert_near(a, b);
        }
    };
    same(corner(""), &stretched(1.0));
    same(corner("\n#TRC [STRETCH_FACTOR=1.5]"), &stretched(1.5));
    let tip = [[10.0 + 2.0 * libm::sqrt(3.0), 2.0]];
    for factor in ["2", "3", "9"] {
        same(corner(&format!("\n#TRC [STRETCH_FACTOR={factor}]")), &tip);
    }
    same(corner("\n#TRC [STRETCH_FACTOR=9]\n#TRC [STRETCH_FACTOR=1]"), &stretched(1.0));
}
