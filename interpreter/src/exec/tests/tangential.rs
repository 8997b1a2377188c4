//! Tangential selection and deselection of tool radius compensation (G05).
//!
//! Expected arcs from a circle with three conditions: it passes through both ends and touches the parallel, so that its radius
//! to the point of contact is perpendicular to the contour.

use super::{assert_near, clean};
use kontur_motion::path::{ArcPath, Path};

const TOOL: &str = "V.G.WZ[1].R=2\nG26 D1 F100\n";

fn paths(text: &str) -> Vec<Path> {
    clean(&format!("{TOOL}{text}\nM30\n")).blocks().iter().map(|b| b.path.clone()).collect()
}

#[track_caller]
fn arc(path: &Path) -> &ArcPath {
    match path {
        Path::Arc(arc) => arc,
        other => panic!("no arc: {other:?}"),
    }
}

#[test]
fn every_arc_touches_the_parallel() {
    // start points on all sides, contours in several directions, also an arc
    for (direction, contour) in [
        ([1.0, 0.0], "X20"),
        ([0.6, 0.8], "X12 Y16"),
        ([0.0, -1.0], "G02 X-10 Y-10 I-10 J0"),
        ([-1.0, 0.0], "G03 X0 Y-40 I0 J-20"),
    ] {
        for i in 0..24 {
            let angle = f64::from(i).mul_add(15.0, 3.7).to_radians();
            let (x, y) = (15.0 * libm::cos(angle), 15.0 * libm::sin(angle));
            let p = paths(&format!("X{x:.6} Y{y:.6}\nG41 G05 X0 Y0\n{contour}\nG01 G40 X50 Y50"));
            let approach = arc(&p[1]);
            let touch = [-2.0 * direction[1], 2.0 * direction[0]];
            let start = p[1].start();
            assert_near(&p[1].end()[..2], &touch);
            let centre = approach.shape().centre_mm;
            let r = [touch[0] - centre[0], touch[1] - centre[1]];
            // rotating about the centre, the tool moves along the contour
            let sense = approach.shape().sweep_rad.signum();
            let speed = [-r[1] * sense, r[0] * sense];
            let length = libm::hypot(speed[0], speed[1]);
            assert_near(&[speed[0] / length, speed[1] / length], &direction);
            let from = [start[0] - centre[0], start[1] - centre[1]];
            assert_near(&[libm::hypot(from[0], from[1])], &[length]);
        }
    }
}
