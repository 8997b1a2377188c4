//! Tool radius compensation.

use super::{assert_near, clean, run};
use kontur_motion::path::Path;

const TOOL: &str = "V.G.WZ[1].R=2\nD1 F100\n";

fn ends(text: &str) -> Vec<Vec<f64>> {
    clean(&format!("{TOOL}{text}\nM30\n")).ends()
}

#[test]
fn outer_corners_are_rounded() {
    // clockwise round a square, tool outside
    let e = ends("G41 X0 Y-10\nY0\nX10\nY-20\nG40 X0 Y-30");
    let expected = [
        [-2.0, -10.0],
        [-2.0, 0.0],
        [0.0, 2.0],
        [10.0, 2.0],
        [12.0, 0.0],
        [12.0, -20.0],
        [0.0, -30.0],
    ];
    assert_eq!(e.len(), expected.len(), "{e:?}");
    for (e, x) in e.iter().zip(expected) {
        assert_near(&e[..2], &x);
    }
}

#[test]
fn inner_corners_are_intersections() {
    let e = ends("G42 X0 Y-10\nY0\nX10\nY-20\nG40 X0 Y-30");
    let expected = [[2.0, -10.0], [2.0, -2.0], [8.0, -2.0], [8.0, -20.0], [0.0, -30.0]];
    assert_eq!(e.len(), expected.len(), "{e:?}");
    for (e, x) in e.iter().zip(expected) {
        assert_near(&e[..2], &x);
    }
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
    // inside a full circle
    let run = clean(&format!("{TOOL}G42 X10 Y0\nG02 I-10\nG40 G01 X0 Y0\nM30\n"));
    match &run.blocks()[1].path {
        Path::Arc(arc) => {
            assert!((arc.radius() - 8.0).abs() < 1e-9);
            assert!((arc.shape().sweep_rad + std::f64::consts::TAU).abs() < 1e-9);
        }
        other => panic!("no arc: {other:?}"),
    }
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
    let text = "V.G.WZ_AKT.R=2\nG01 Y10 F100 G41\nX20 Y25\nX40 G42\nX60 Y10\nX0 Y0 G40\nM30\n";
    let run = clean(text);
    let e = run.ends();
    assert_near(e.last().unwrap(), &[0.0, 0.0, 0.0]);
    // above the first element, then below the one behind G42
    let u = [0.8, 0.6];
    assert_near(&e[0][..2], &[-2.0 * u[1], 10.0 + 2.0 * u[0]]);
    assert_near(&e[1][..2], &[20.0 - 2.0 * u[1], 25.0 + 2.0 * u[0]]);
    assert_near(&e[2][..2], &[40.0 - 2.0 * u[1], 25.0 - 2.0 * u[0]]);
}

#[test]
fn contours_that_are_too_tight() {
    let id = |text: &str| run(&format!("{TOOL}{text}\nM30\n")).ids();
    assert_eq!(id("G42 X0 Y-10\nY0\nX1\nY-10\nG40 X5"), ["K-0115"]);
    assert_eq!(id("G42 Y-10\nY0\nG02 X2 I1\nG40 G01 Y-30"), ["90031"]);
    assert_eq!(id("G41 G02 X10 I5"), ["90008"]);
    assert_eq!(id("G41 X10\nG18\nX20"), ["20133"]);
    assert_eq!(id("G41 X10\nX20\n#FLUSH WAIT\nX30\nG40 Y5"), ["20651"]);
    assert_eq!(id("G41 X10 G42"), ["20114"]);
    assert_eq!(run("G41 X10 F100\nX20\nG40 X30\nM30\n").ids(), ["K-0114"]);
}

#[test]
fn mirroring_keeps_the_tool_on_its_side_of_the_programmed_contour() {
    let e = ends("G71 G21 G41 X10 Y0\nX20\nG40 X30");
    // the contour runs to -X, the tool stays above it
    assert_near(&e[0][..2], &[-10.0, 2.0]);
}
