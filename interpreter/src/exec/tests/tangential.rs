//! Tangential selection and deselection of tool radius compensation (G05).
//!
//! Expected arcs by the circle through three conditions: it holds both ends and touches the parallel, so that its
//! radius to the touching point is perpendicular to the contour.

use super::{assert_near, clean, places, run};
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

/// Ends, centre and swept angle in degrees.
#[track_caller]
fn assert_arc(path: &Path, from: [f64; 2], to: [f64; 2], centre: [f64; 2], sweep_deg: f64) {
    let arc = arc(path);
    assert_near(&path.start()[..2], &from);
    assert_near(&path.end()[..2], &to);
    assert_near(&arc.shape().centre_mm, &centre);
    assert_near(&[arc.shape().sweep_rad.to_degrees()], &[sweep_deg]);
}

#[test]
fn a_quarter_leads_to_the_contour_and_away_from_it() {
    // the parallel of the line from X0 to X20 lies at Y2; a quarter of radius 8 reaches it at X0 from X-8 Y10
    let p = paths("X-8 Y10\nG41 G05 G01 X0 Y0\nX20\nG05 G40 X28 Y10");
    assert_eq!(p.len(), 4);
    assert_arc(&p[1], [-8.0, 10.0], [0.0, 2.0], [0.0, 10.0], 90.0);
    assert_near(&p[2].end()[..2], &[20.0, 2.0]);
    assert_arc(&p[3], [20.0, 2.0], [28.0, 10.0], [20.0, 10.0], 90.0);
    // G42 mirrors it, G138 and G139 are alike
    let p = paths("G138 X-8 Y-10\nG42 G05 G01 X0 Y0\nX20\nG40 G05 X28 Y-10");
    assert_arc(&p[1], [-8.0, -10.0], [0.0, -2.0], [0.0, -10.0], -90.0);
    assert_arc(&p[3], [20.0, -2.0], [28.0, -10.0], [20.0, -10.0], -90.0);
}

#[test]
fn the_place_of_the_start_decides_the_sense() {
    // from below the parallel the arc turns the other way: the tool comes from the contour's side
    let p = paths("X-8 Y-6\nG41 G05 X0 Y0\nX20\nG40 X30 Y10");
    assert_arc(&p[1], [-8.0, -6.0], [0.0, 2.0], [0.0, -6.0], -90.0);
    // from ahead of the point it is more than half a turn
    let p = paths("X8 Y10\nG41 G05 X0 Y0\nX20\nG40 X30 Y10");
    assert_arc(&p[1], [8.0, 10.0], [0.0, 2.0], [0.0, 10.0], 270.0);
}

#[test]
fn every_arc_touches_the_parallel() {
    // starting points all around, contours in several directions, also an arc
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
            // turning about the centre, the tool moves along the contour
            let sense = approach.shape().sweep_rad.signum();
            let speed = [-r[1] * sense, r[0] * sense];
            let length = libm::hypot(speed[0], speed[1]);
            assert_near(&[speed[0] / length, speed[1] / length], &direction);
            let from = [start[0] - centre[0], start[1] - centre[1]];
            assert_near(&[libm::hypot(from[0], from[1])], &[length]);
        }
    }
}

#[test]
fn a_start_on_the_parallel_leads_straight_on() {
    let p = paths("X-8 Y2\nG41 G05 X0 Y0\nX20\nG40 G05 X28 Y2");
    assert!(p[1].is_straight() && p[3].is_straight());
    assert_near(&p[1].end()[..2], &[0.0, 2.0]);
    assert_near(&p[3].end()[..2], &[28.0, 2.0]);
    let faults = run(&format!("{TOOL}X8 Y2\nG41 G05 X0 Y0\nX20\nM30\n"));
    assert_eq!(places(&faults.diagnostics), ["K-0115 4:1"]);
}

#[test]
fn other_axes_and_blocks_between() {
    // the word acts with the next motion in the plane, other axes move along
    let p = paths("X-8 Y10\nG41 G05\nZ5\nX0 Y0 Z1\nX20\nG40 G05\nZ3\nX28 Y10 Z7");
    assert_eq!(p.len(), 6);
    assert_arc(&p[2], [-8.0, 10.0], [0.0, 2.0], [0.0, 10.0], 90.0);
    assert_near(&[p[2].start()[2], p[2].end()[2]], &[5.0, 1.0]);
    assert_arc(&p[5], [20.0, 2.0], [28.0, 10.0], [20.0, 10.0], 90.0);
    assert_near(&[p[5].start()[2], p[5].end()[2]], &[3.0, 7.0]);
    // it is not modal
    let p = paths("X-8 Y10\nG41 G05 X0 Y0\nX20\nG40 X28 Y10\nG41 X0 Y0\nX20\nG40 X28 Y10");
    assert!(p[3].is_straight() && p[4].is_straight() && p[6].is_straight());
    // without compensation there is nothing to leave
    assert!(paths("G40 G05 X5 Y5\nG41 X20 Y0\nX30\nG40 Y5").iter().all(Path::is_straight));
}

#[test]
fn what_does_not_go_with_it_is_refused() {
    for (text, place) in [
        ("G05 X5", "K-0115 3:1"),
        ("G237 G41 G05 X5\nY5", "K-0019 3:1"),
        ("G239 G41 X5\nY5\nG05 G40 X9", "K-0019 5:1"),
        ("G41 X5\nY5\nG41 G05 Y9\nG40 X0", "K-0019 5:1"),
        ("G41 X5\nY5\nG42 G05 Y9\nG40 X0", "K-0019 5:1"),
        ("G41 G05 G02 X5 R9\nG40 G01 X0", "90008 3:1"),
        ("G41 G05 X5\nG40 X0", "K-0115 3:1"),
    ] {
        let found = places(&run(&format!("{TOOL}{text}\nM30\n")).diagnostics);
        assert!(found.contains(&place.to_owned()), "{text}: {found:?}");
    }
}
