//! Tool radius compensation.

use super::{Event, assert_near, clean, run, run_on, said};
use kontur_motion::block::Feed;
use kontur_motion::path::Path;
use std::f64::consts::PI;

const TOOL: &str = "V.G.WZ[1].R=2\nG26 D1 F100\n";

fn ends(text: &str) -> Vec<Vec<f64>> {
    clean(&format!("{TOOL}{text}\nM30\n")).ends()
}

#[track_caller]
fn assert_points(found: &[Vec<f64>], expected: &[[f64; 2]]) {
    assert_eq!(found.len(), expected.len(), "{found:?}");
    for (found, expected) in found.iter().zip(expected) {
        assert_near(&found[..2], expected);
    }
}

/// Clockwise round the left, upper and right side of a square, tool outside; radius 2.
const ROUND_A_SQUARE: &str = "G41 X0 Y-10\nY0\nX10\nY-20\nG40 X0 Y-30";
const OUTSIDE_OF_IT: [[f64; 2]; 7] =
    [[-2.0, -10.0], [-2.0, 0.0], [0.0, 2.0], [10.0, 2.0], [12.0, 0.0], [12.0, -20.0], [0.0, -30.0]];

#[test]
fn outer_corners_are_rounded() {
    assert_ends(ROUND_A_SQUARE, &OUTSIDE_OF_IT);
}

#[test]
fn inner_corners_are_intersections() {
    let expected = [[2.0, -10.0], [2.0, -2.0], [8.0, -2.0], [8.0, -20.0], [0.0, -30.0]];
    assert_ends("G42 X0 Y-10\nY0\nX10\nY-20\nG40 X0 Y-30", &expected);
}

#[test]
fn arcs_grow_and_shrink() {
    let run =
        clean(&format!("{TOOL}G41 X0 Y-10\nY0\nG02 X20 Y0 I10 J0\nG01 Y-10\nG40 X0 Y-30\nM30\n"));
    let radius = run.blocks().iter().find_map(|b| match &b.path {
        Path::Arc(arc) => Some(arc.radius()),
        _ => None,
    });
    assert!((radius.unwrap() - 12.0).abs() < 1e-9);
}

#[test]
fn other_axes_move_at_the_corner() {
    let e = ends("G41 X0 Y-10\nY0\nZ-5\nX10\nG40 Y-30");
    assert_near(&e[1], &[-2.0, 0.0, 0.0]);
    assert_near(&e[2], &[-2.0, 0.0, -5.0]);
    assert_near(&e[3], &[0.0, 2.0, -5.0]);
}

#[test]
fn a_change_of_side_crosses_the_contour() {
    // the vendor's example, radius 2
    let text = "V.G.WZ_AKT.R=2\nG26 G01 Y10 F100 G41\nX20 Y25\nX40 G42\nX60 Y10\nX0 Y0 G40\nM30\n";
    let run = clean(text);
    let e = run.ends();
    assert_near(e.last().unwrap(), &[0.0, 0.0, 0.0]);
    // above the first element, then below the one after G42
    let u = [0.8, 0.6];
    assert_near(&e[0][..2], &[-2.0 * u[1], 10.0 + 2.0 * u[0]]);
    assert_near(&e[1][..2], &[20.0 - 2.0 * u[1], 25.0 + 2.0 * u[0]]);
    assert_near(&e[2][..2], &[40.0 - 2.0 * u[1], 25.0 - 2.0 * u[0]]);
}

#[test]
fn mirroring_keeps_the_tool_on_its_side_of_the_programmed_contour() {
    let e = ends("G71 G21 G41 X10 Y0\nX20\nG40 X30");
    // the contour runs to -X, the tool stays above it
    assert_near(&e[0][..2], &[-10.0, 2.0]);
}

#[track_caller]
fn assert_ends(text: &str, expected: &[[f64; 2]]) {
    assert_points(&ends(text), expected);
}

#[test]
fn outer_corners_by_lines() {
    // up to a quarter turn the parallels are prolonged to their intersection
    let square = [[-2.0, -10.0], [-2.0, 2.0], [12.0, 2.0], [12.0, -20.0], [0.0, -30.0]];
    assert_ends("G25 G41 X0 Y-10\nY0\nX10\nY-20\nG40 X0 Y-30", &square);
    // an eighth of a turn: prolonged by r tan(22.5 degrees)
    let d = 2.0 * (2.0_f64.sqrt() - 1.0);
    let h = 2.0_f64.sqrt();
    let eighth = [[-2.0, -10.0], [-2.0, d], [10.0 - h, 10.0 + h], [10.0, 30.0]];
    assert_ends("G25 G41 X0 Y-10\nY0\nX10 Y10\nG40 Y30", &eighth);
    // beyond a quarter turn a line between points at the distance r: here back along the same line
    let back = [[-2.0, -10.0], [-2.0, 2.0], [2.0, 2.0], [2.0, -10.0], [30.0, -10.0]];
    assert_ends("G25 G41 X0 Y-10\nY0\nY-10\nG40 X30", &back);
    // to an arc: the line is prolonged, then the tangent of the arc
    let arc = [[-2.0, -10.0], [-2.0, 2.0], [0.0, 2.0], [12.0, -10.0], [30.0, -10.0]];
    assert_ends("G25 G41 X0 Y-10\nY0\nG02 X10 Y-10 J-10\nG01 G40 X30", &arc);
    // from arc to arc: two tangents
    let arcs = [[-22.0, -20.0], [0.0, 2.0], [2.0, 2.0], [2.0, 0.0], [20.0, -18.0], [40.0, -20.0]];
    let text = "G25 G41 X-20 Y-20\nG02 X0 Y0 I20\nG03 X20 Y-20 I20\nG01 G40 X40";
    assert_ends(text, &arcs);
}

#[test]
fn without_a_word_corners_are_lines() {
    let text = "V.G.WZ_AKT.R=2\nG41 X0 Y-10 F100\nY0\nX10\nG40 Y-20\nM30\n";
    let run = run(text);
    assert!(run.diagnostics.is_empty() && run.blocks().iter().all(|b| b.path.is_straight()));
    let run = run_on(&["channel.prog_start.g_gruppe[6].nr=26"], text);
    assert!(run.blocks().iter().any(|b| matches!(b.path, Path::Arc(_))));
    let run = run_on(&["channel.prog_start.g_gruppe[8].nr=51"], "M30\n");
    assert_eq!(
        (run.ids(), run.diagnostics[0].parameter),
        (vec!["K-0111".to_owned()], Some("P-CHAN-00063"))
    );
}

#[test]
fn perpendicular_selection() {
    // the vendor's example of G237: radius 5 to the right, the contour begins and ends with arcs
    let text = "G26 G00 X0 Y0 Z0 G17\nX10 Y10\nV.G.WZ_AKT.R=5\nG237\nG42\nG03 X60 Y60 J50 F1000\nG01 Y100\nG03 X10 Y150 J50\nG40\nG00 X0 Y0\nM30\n";
    let run = clean(text);
    // the corner to the second arc (centre 60, 150) is an inner one: line X65 meets the circle of radius 55
    let corner = 150.0 - (55.0_f64 * 55.0 - 25.0).sqrt();
    let expected = [
        [10.0, 10.0],
        [10.0, 5.0],
        [65.0, 60.0],
        [65.0, corner],
        [5.0, 150.0],
        [10.0, 150.0],
        [0.0, 0.0],
    ];
    let e = run.ends();
    assert_points(&e, &expected);
}

#[test]
fn compensation_in_a_tilted_plane() {
    // the square of outer corners, turned by 30 degrees about Y: X = x cos, Z = -x sin
    let e = ends(&format!("#CS ON [0,0,0,0,30,0]\n{ROUND_A_SQUARE}"));
    let (s, c) = (0.5, 0.75_f64.sqrt());
    assert_eq!(e.len(), OUTSIDE_OF_IT.len(), "{e:?}");
    for (e, [x, y]) in e.iter().zip(OUTSIDE_OF_IT) {
        assert_near(e, &[x * c, y, -x * s]);
    }
    let id = |text: &str| said(&format!("{TOOL}{text}"));
    assert_eq!(id("#CS ON [0,0,0,0,30,0]\nG41 X10\nX20\n#CS OFF\nX30"), ["20802"]);
    assert_eq!(id("G41 X10\nX20\n#CS ON [5,0,0,0,0,0]\nX30"), ["20802"]);
}

#[test]
fn errors_stand_at_the_block_that_does_not_fit() {
    let places = |text: &str| super::places(&run(&format!("{TOOL}{text}\nM30\n")).diagnostics);
    // the arc of line 5 is too small, which is known at line 6
    assert_eq!(places("G42 Y-10\nY0\nG02 X2 I1\nG40 G01 Y-30"), ["90017 5:1"]);
    assert_eq!(places("G42 X0 Y-10\nY0\nX1\nY-10\nG40 X5"), ["K-0115 5:1"]);
}

#[test]
fn full_circles_inside_and_outside() {
    let circle = |text: &str| {
        let run = clean(&format!("{TOOL}{text}\nM30\n"));
        let arcs = run.blocks().into_iter().filter_map(|b| match &b.path {
            Path::Arc(arc) => Some((arc.radius(), arc.shape().sweep_rad)),
            _ => None,
        });
        arcs.collect::<Vec<_>>()
    };
    let turn = std::f64::consts::TAU;
    for (text, radius, sweep) in [
        ("G41 X10 Y0\nG03 I-10\nG40 G01 X0", 8.0, turn),
        ("G42 X10 Y0\nG02 I-10\nG40 G01 X0", 8.0, -turn),
        ("G42 X10 Y0\nG03 I-10\nG40 G01 X30", 12.0, turn),
        ("G41 X10 Y0\nG02 I-10\nG40 G01 X30", 12.0, -turn),
    ] {
        let found = circle(text);
        assert_eq!(found.len(), 1, "{found:?}");
        assert!((found[0].0 - radius).abs() < 1e-9 && (found[0].1 - sweep).abs() < 1e-9);
    }
}

#[test]
fn bottlenecks_between_elements_that_are_far_apart_are_told() {
    // a pocket after a neck from X20 to X20 + width, which a tool of radius 2 passes down and up again
    let slot = |width: f64| {
        let right = 20.0 + width;
        format!(
            "{TOOL}G41 X-5 Y20\nX20\nY12\nX15\nY4\nX{}\nY12\nX{right}\nY20\nX50\nG40 Y30\nM30\n",
            right + 5.0
        )
    };
    let run = run(&slot(3.0));
    assert_eq!(run.ids(), ["K-0119"], "{:?}", super::shown(&run.diagnostics));
    let told = &run.diagnostics[0];
    assert!(!told.is_error() && told.text.contains("line 10") && told.text.contains("1.0000 mm"));
    assert_eq!(told.source.as_ref().map(|s| s.line), Some(5));
    assert!(super::run(&slot(5.0)).diagnostics.is_empty());
}

#[test]
fn contouring_may_be_switched_between_compensated_blocks() {
    let text = "G42 X0 Y-10\nY0\nG261\nX10\n#CONTOUR MODE OFF\nY-20\nG40 X0 Y-30";
    let run = clean(&format!("{TOOL}{text}\nM30\n"));
    let rounds: Vec<_> = run.blocks().iter().map(|b| b.contour.is_some()).collect();
    assert_eq!(rounds, [false, false, true, false, false]);
    // the path is that without contouring
    assert_eq!(run.ends(), ends("G42 X0 Y-10\nY0\nX10\nY-20\nG40 X0 Y-30"));
}

/// The star of the page on inside corner selection (207798283): eight lines round the origin, radius 10 inside of it. Each tip is
/// entered at the distance r / sin(half of its angle), each notch at r / sin(half of the outer one) from the corner.
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
    // from a line through (0, 100) and (20, 20) the point (0, y) is (100 - y) * 20 / |(20, 80)| away
    let tip = 100.0 - 10.0 * 6800.0_f64.sqrt() / 20.0;
    let e = run.ends();
    assert_near(&e[0][..2], &[0.0, tip]);
    assert_near(&e[e.len() - 2][..2], &[0.0, tip]);
    assert_near(&e[e.len() - 1], &[0.0, 0.0, 0.0]);
    // nowhere nearer to the contour than the radius, and at it on every side
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

/// Contours of G238 that the restrictions of the page (207803403) forbid.
#[test]
fn what_inside_corner_selection_does_not_allow() {
    let square = "G01 X0 Y0\nX20\nY20\nX0\nY0";
    let id = |text: &str| said(&format!("{TOOL}G00 X5 Y5\n{text}"));
    assert_eq!(id(&format!("G238 G41 {square}\nG40 X5 Y5")), [""; 0]);
    // seen from outside of the square the corner is not an inner one
    assert_eq!(id(&format!("G238 G42 {square}\nG40 X5 Y5")), ["K-0115"]);
    assert_eq!(id("G238 G41 G01 X0 Y0\nX20\nY20\nG40 X5 Y5"), ["K-0115"]);
    assert_eq!(id("G238 G41 G01 X0 Y0\nG02 I5\nG40 G01 X5 Y5"), ["K-0115"]);
    assert_eq!(id("G238 G41 G02 X0 Y0 I-2.5 J-2.5"), ["90008"]);
    assert_eq!(id(&format!("G238 G41 {square}\nG40 G02 X5 Y5 I2.5 J2.5")), ["90008"]);
    assert_eq!(id("G238 G41 G01 X0 Y0\nX20\nG42 Y20\nX0 Y0\nG40 X5 Y5"), ["K-0115"]);
}

/// A motion of another axis and a rest inside a contour of G238 keep their places.
#[test]
fn rests_and_other_axes_inside_a_closed_contour() {
    let e = ends("G00 X5 Y5\nG238 G41 G01 X0 Y0\nZ-3\nX20\nG04 0.1\nY20\nX0\nY0\nZ0\nG40 X5 Y5");
    let expected = [
        [5.0, 5.0, 0.0],
        [2.0, 2.0, 0.0],
        [2.0, 2.0, -3.0],
        [18.0, 2.0, -3.0],
        [18.0, 18.0, -3.0],
        [2.0, 18.0, -3.0],
        [2.0, 2.0, -3.0],
        [2.0, 2.0, 0.0],
        [5.0, 5.0, 0.0],
    ];
    assert_eq!(e.len(), expected.len(), "{e:?}");
    for (e, x) in e.iter().zip(expected) {
        assert_near(e, &x);
    }
}

/// G239 (207810059): the tool goes to the parallel at once and stays there after G40; a coordinate that is not programmed then is
/// that of the tool.
#[test]
fn deselection_without_a_block() {
    let text = |end: &str| {
        format!(
            "G0 X0 Y0 Z0 F1000\nG239\nV.G.WZ_AKT.R = 10\nG41 G01 X30 Y20\nG01 X60\nG01 X90\nG01 X120\nG40\n{end}\nM30\n"
        )
    };
    let parallel = [[30.0, 30.0], [60.0, 30.0], [90.0, 30.0], [120.0, 30.0]];
    for (end, after) in [
        ("G00 X150 Y0", &[[150.0, 0.0]][..]),
        ("G00 X150\nG00 X200", &[[150.0, 30.0], [200.0, 30.0]]),
        ("G91 G00 X30\nG90", &[[150.0, 30.0]]),
    ] {
        let run = clean(&text(end));
        let expected: Vec<[f64; 2]> = parallel.iter().chain(after).copied().collect();
        assert_points(&run.ends(), &expected);
    }
    assert_eq!(run(&text("G02 X150 Y0 I15 J0")).ids(), ["90008"]);
    clean(&text("G01 X150 Y0\nX160\nG02 X170 I5"));
    // with an offset and mirrored the program counts from the tool all the same
    let run = clean(
        "G92 X100\nG239\nV.G.WZ_AKT.R = 10\nG41 G01 X30 Y20 F1000\nX60\nG40\nP1=V.A.ABS.X P2=V.A.ABS.Y\nX[P1+1] Y[P2]\nM30\n",
    );
    assert_near(&run.ends().last().unwrap()[..2], &[161.0, 30.0]);
}

/// G138: straight to the point above the beginning of the contour, as G239.
#[test]
fn direct_selection() {
    assert_ends(&format!("G138\n{ROUND_A_SQUARE}"), &OUTSIDE_OF_IT);
}

/// Options at their values of the program start change nothing, others are named.
#[test]
fn options_of_compensation() {
    for (text, id) in [
        ("#TRC [KERF_MASKING=0 TANGENTIAL_LIMIT=3 ONLINE=0 SPLIT_OFF]", None),
        ("#TRC [SPLIT AX=X PRE DIST_SEG1=5 FEED_SEG1=100]", Some("K-0019")),
        ("#TRC [REVERSE=0.5]", Some("21296")),
        ("#TRC [REVERSE=1 STRETCH_FACTOR=9 GEN_CIR_BLOCK_IN_CORNER=0]", None),
        ("#TRC [STRETCH_FACTOR=0.5]", Some("22007")),
        ("#TRC [GEN_CIR_BLOCK_IN_CORNER=1]", Some("K-0019")),
        ("#TRC [REVRSE=1]", Some("21220")),
        ("#TRC", Some("21220")),
        ("G236", Some("K-0019")),
        ("G05", Some("K-0115")),
    ] {
        assert_eq!(said(text), id.into_iter().collect::<Vec<_>>(), "{text}");
    }
}

/// G11: F is the speed of the contour on arcs, at the centre of a tool of 5 mm that is 5/10 inside an arc of 10 mm; an arc
/// below RMIN keeps F. After 207065483 of the programming manual.
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

/// An acute outer corner of 120 deg: the parallels meet at tan(60 deg) = 1.732 radii, which a factor of 2 reaches.
#[test]
fn lines_of_acute_corners_stretch() {
    let corner = |factor: &str| {
        let (x, y) = (10.0 + 20.0 * libm::cos(-2.0 * PI / 3.0), 20.0 * libm::sin(-2.0 * PI / 3.0));
        let text = format!("G25 {factor}\nX-5 Y0\nG41 X0 Y0\nX10\nX{x:.12} Y{y:.12}\nG40 X0 Y-50");
        let ends = clean(&format!("V.G.WZ[1].R=2\nD1 F100\n{text}\nM30\n")).ends();
        ends[2..ends.len() - 2].iter().map(|p| [p[0], p[1]]).collect::<Vec<_>>()
    };
    let w = [libm::cos(-2.0 * PI / 3.0), libm::sin(-2.0 * PI / 3.0)];
    // the beginning of the second parallel
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

/// There and back on the same side of a slot: the tool turns round where it is.
#[test]
fn a_contour_that_runs_back_changes_its_side_in_place() {
    let there_and_back = "X-5 Y0\nG41 X0 Y0\nX20\nG42 X0\nG40 X-10 Y5";
    assert_points(
        &ends(&format!("#TRC [REVERSE=1]\n{there_and_back}")),
        &[[-5.0, 0.0], [0.0, 2.0], [20.0, 2.0], [0.0, 2.0], [-10.0, 5.0]],
    );
    // as if the side had been left and selected anew: the line back leads across
    let across = ends(there_and_back);
    assert_eq!(across, ends(&format!("#TRC [REVERSE=1]\n#TRC [REVERSE=0]\n{there_and_back}")));
    assert_ne!(across[3][1], 2.0);
    // arcs: the same circle in the other direction
    let run = clean(&format!(
        "{TOOL}#TRC [REVERSE=1]\nG41 X10 Y0\nG03 X0 Y10 I-10 J0\nG42 G02 X10 Y0 I0 J-10\nG40 G01 X30 Y0\nM30\n"
    ));
    let radii: Vec<f64> = run
        .blocks()
        .iter()
        .filter_map(|b| match &b.path {
            Path::Arc(arc) => Some(arc.radius()),
            _ => None,
        })
        .collect();
    assert_near(&radii, &[8.0, 8.0]);
    assert_points(&run.ends(), &[[8.0, 0.0], [0.0, 8.0], [8.0, 0.0], [30.0, 0.0]]);
    // a corner is not a reversal: the usual change of side
    let corner = "X-5 Y0\nG41 X0 Y0\nX20\nG42 X5 Y10\nX-20\nG40 Y30";
    assert_eq!(ends(corner), ends(&format!("#TRC [REVERSE=1]\n{corner}")));
}

#[test]
fn events_of_a_motion_of_which_nothing_is_left_happen() {
    // the approach ends where the tool is, and so does the way back
    let text =
        "V.G.WZ_AKT.R=2\nG26 G138 F100 X2 Y0\nG42 X0 Y0 M77\nY20\nG40 X2 M78\nX50 M79\nM30\n";
    let run = clean(text);
    assert_points(&run.ends(), &[[2.0, 0.0], [2.0, 20.0], [50.0, 20.0]]);
    let numbers: Vec<u32> = run
        .events()
        .into_iter()
        .filter_map(|event| match event {
            Event::MFunction { number, .. } => Some(*number),
            _ => None,
        })
        .collect();
    assert_eq!(numbers, [77, 78, 79]);
    // also where nothing follows
    let run = clean("V.G.WZ_AKT.R=2\nG26 G138 F100 X2 Y0\nG42 X0 Y0\nY20\nG40 X2 M78\nM30\n");
    assert!(run.events().iter().any(|e| matches!(e, Event::MFunction { number: 78, .. })));
}
