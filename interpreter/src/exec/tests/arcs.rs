//! Curves through points outside the limits, and roundings at the end of a motion.

use super::clean;

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
    let (found, _) = crate::exec::check(
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
