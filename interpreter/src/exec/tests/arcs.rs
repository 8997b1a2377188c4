//! Arcs and helices as paths of the axes.

use super::{assert_near, clean};
use kontur_motion::path::Path;
use std::f64::consts::PI;

#[test]
fn arcs_in_a_tilted_coordinate_system() {
    // rotated by 30 degrees about Y: X = x cos + z sin, Z = z cos - x sin
    let (s, c) = (0.5, 0.75_f64.sqrt());
    let at = |path: &Path, share: f64| {
        let mut q = [0.0; 3];
        path.position(share * path.length(), &mut q);
        q
    };
    let run = clean("#CS ON [1,2,3,0,30,0]\nG00 X0 Y0 Z0\nG02 X10 I5 F100\nM30\n");
    let path = &run.blocks()[1].path;
    assert!((path.length() - 5.0 * PI).abs() < 1e-9);
    assert_near(&at(path, 0.5), &[1.0 + 5.0 * c, 7.0, 3.0 - 5.0 * s]);
    assert_near(&run.end, &[1.0 + 10.0 * c, 2.0, 3.0 - 10.0 * s]);
    // by radius, with absolute centre, mirrored and as helices: the same midpoint
    let middle = |text: &str| {
        let run = clean(&format!("#CS ON [0,0,0,0,30,0]\n{text}\nM30\n"));
        at(&run.blocks().last().unwrap().path, 0.5)
    };
    assert_near(&middle("G02 X10 R5 F100"), &[5.0 * c, 5.0, -5.0 * s]);
    assert_near(&middle("G161 G02 X10 I5 J0 F100"), &[5.0 * c, 5.0, -5.0 * s]);
    assert_near(&middle("G03 X10 I5 F100"), &[5.0 * c, -5.0, -5.0 * s]);
    assert_near(&middle("G02 I5 F100"), &[10.0 * c, 0.0, -10.0 * s]);
    assert_near(&middle("G02 X10 Z4 I5 F100"), &[5.0 * c + 2.0 * s, 5.0, 2.0 * c - 5.0 * s]);
    // two and a half turns with pitch 4
    assert_near(&middle("G02 X10 Z10 I5 K4 F100"), &[5.0 * c + 5.0 * s, 5.0, 5.0 * c - 5.0 * s]);
    assert_near(&middle("G91 G02 X10 I5 F100"), &[5.0 * c, 5.0, -5.0 * s]);
    assert_near(&middle("G71 G21\nG02 X10 I5 F100"), &[-5.0 * c, 5.0, 5.0 * s]);
    assert_near(&middle("#ROTATION ON [ANGLE=90]\nG02 X10 I5 F100"), &[-5.0 * c, 5.0, 5.0 * s]);
    // in a plane that is not tilted, the arc is an arc of the axes
    let flat = clean("#CS ON [0,0,0,0,30,0]\nG18 G02 X10 I5 F100\nM30\n");
    assert!(matches!(flat.blocks()[0].path, Path::Arc(_)));
    // all three angles: R = Rz(20) Ry(30) Rx(40), the second column is the image of y
    let (sx, cx) = libm::sincos(40.0_f64.to_radians());
    let (sz, cz) = libm::sincos(20.0_f64.to_radians());
    let run = clean("#CS ON [0,0,0,40,30,20]\nG02 X10 I5 F100\nM30\n");
    let (x, y) = ([cz * c, sz * c, -s], [cz * s * sx - sz * cx, sz * s * sx + cz * cx, c * sx]);
    let expected: Vec<f64> = (0..3).map(|i| 5.0 * x[i] + 5.0 * y[i]).collect();
    assert_near(&at(&run.blocks()[0].path, 0.5), &expected);
}

/// The curve of `#CONTOUR MODE [POS]` reaches its interim point, which is outside the range of the adjacent lines. A check and
/// a run both report it, for the block that ends at the curve. With the limit beyond the curve, and in the other modes, nothing
/// is reported. The remainder of a long line after the curve is not part of it.
#[test]
fn a_curve_through_a_point_outside_the_limits() {
    let text = |mode: &str, behind: &str| {
        format!("G90 G01 F6000\n#CONTOUR MODE [{mode}]\nG261\nX9\nY10\nG260{behind}\nX0\nM30\n")
    };
    let at = |limit: u32| format!("X.kenngr.swe_pos={limit}");
    let pos = "POS PRE_DIST=3 POST_DIST=3 X12 Y1 Z0";
    let machine = super::machine(&[&at(100_000)]);
    let sources = crate::source::MemorySources::new().with("main.nc", text(pos, ""));
    let found = crate::exec::check(
        std::sync::Arc::new(sources),
        "main.nc",
        machine,
        crate::exec::options::Options::default(),
    );
    // both corners pass through the point
    assert_eq!(super::places(&found.diagnostics), ["21897 4:1", "21897 5:1"]);
}

/// 256490379: `#RND` in a motion applies to the corner at its end, as a separate block to the corner between its neighbours.
#[test]
fn a_rounding_in_a_motion_lies_at_its_end() {
    let ends = |text: &str| clean(&format!("G137 G90 G01 F1000 {text}\nM30\n")).ends();
    let own = ends("X50 Y0\nY50\n#RND=5\nX100");
    assert_eq!(ends("X50 Y0\nY50 #RND=5\nX100"), own);
    assert_eq!(own[1], [50.0, 45.0, 0.0]);
    assert_eq!(ends("X50\n#CHR=4\nY50"), ends("X50 #CHR=4\nY50"));
    assert_eq!(ends("X50\n#CHF=4\nY50"), ends("X50 #CHF=4\nY50"));
    // first example of the page: the corner is at the end of the line of 30 degrees
    let text = "G18 Z15 X2\n#ANG=30 #RND=3 Z25\nZ40 X30";
    let of_page = ends(text);
    assert_eq!(of_page.len(), 4);
    let corner = 2.0 + 10.0 * libm::tan(30.0_f64.to_radians());
    // the tangent length of a rounding is its radius times the tangent of half the change of direction
    let turn = libm::atan((30.0 - corner) / 15.0) - 30.0_f64.to_radians();
    let before = 3.0 * libm::tan(turn / 2.0);
    let [x, _, z] = of_page[1][..] else { unreachable!() };
    let way = libm::hypot(x - corner, z - 25.0);
    assert!((way - before).abs() < 1e-9, "{way} {before}");
}
