//! Arcs and helices as paths of the axes.

use super::{assert_end, assert_near, clean, run_on, said};
use kontur_motion::path::{ArcPath, Path};
use std::f64::consts::{PI, TAU};

#[track_caller]
fn arc(text: &str) -> ArcPath {
    let run = clean(&format!("{text}\nM30\n"));
    match run.blocks().last().map(|b| b.path.clone()) {
        Some(Path::Arc(arc)) => arc,
        other => panic!("no arc: {other:?}"),
    }
}

#[track_caller]
fn assert_arc(text: &str, centre: [f64; 2], sweep_rad: f64) {
    let arc = arc(text);
    let near = |a: f64, b: f64| (a - b).abs() < 1e-6;
    let c = arc.shape().centre_mm;
    assert!(near(c[0], centre[0]) && near(c[1], centre[1]), "{c:?} instead of {centre:?}");
    assert!(
        near(arc.shape().sweep_rad, sweep_rad),
        "{} instead of {sweep_rad}",
        arc.shape().sweep_rad
    );
}

#[test]
fn centre_relative_and_absolute() {
    assert_arc("G02 X10 Y0 I5 J0.2 F100", [5.0, 0.2], -(PI + 2.0 * libm::atan(0.04)));
    assert_arc("G00 X10\nG161 G03 X-10 I0 J0 F100", [0.0, 0.0], PI);
    assert_arc("G00 X10\nG91 G03 X-20 I-10 F100", [0.0, 0.0], PI);
    // G165 moves the centre to the bisector
    assert_arc("G02 X10 Y0 I5.1 J0 F100", [5.0, 0.0], -PI);
}

#[test]
fn full_circles_need_no_end_point() {
    assert_arc("G02 I5 F100", [5.0, 0.0], -TAU);
    assert_arc("G03 J5 F100", [0.0, 5.0], TAU);
    assert_arc("G03 X0 Y0 J5 F100", [0.0, 5.0], TAU);
}

#[test]
fn the_radius_is_modal() {
    let h = 8.660254;
    assert_arc("G02 X10 R10 F100", [5.0, -h], -PI / 3.0);
    assert_arc("G02 X10 R-10 F100", [5.0, h], -5.0 * PI / 3.0);
    assert_arc("G03 X10 R=10 F100", [5.0, h], PI / 3.0);
    assert_arc("G03 X10 R10 F100\nX20", [15.0, h], PI / 3.0);
    assert_arc("G163=10 G03 X10 F100", [5.0, h], PI / 3.0);
    assert_arc("R10\nG03 X10 F100", [5.0, h], PI / 3.0);
}

#[test]
fn planes_keep_the_sense_of_rotation() {
    let of = |text: &str| arc(text);
    let zx = of("G18 G00 Z10\nG03 Z0 X10 K-10 F100");
    assert_eq!(zx.shape().plane, [2, 0]);
    assert!((zx.shape().sweep_rad - PI / 2.0).abs() < 1e-12);
    let yz = of("G19 G00 Y10\nG02 Y0 Z-10 J-10 F100");
    assert_eq!(yz.shape().plane, [1, 2]);
    assert!((yz.shape().sweep_rad + PI / 2.0).abs() < 1e-12);
}

#[test]
fn helices() {
    // the vendor's example of a helix of one turn
    let run = clean("N10 G17 G90 X-10 Y0 Z0 F500 G161\nN20 G03 I0 J0 Z20\nM30\n");
    assert_near(&run.end, &[-10.0, 0.0, 20.0]);
    let length = run.blocks()[1].path.length();
    assert!((length - libm::hypot(TAU * 10.0, 20.0)).abs() < 1e-9);
    // pitch 4 mm, 20 mm high: five turns
    assert_arc("G00 X-10\nG161 G03 I0 J0 K4 Z20 F100", [0.0, 0.0], 5.0 * TAU);
    assert_arc("G00 X-10\nG161 G02 X10 I0 J0 K4 Z10 F100", [0.0, 0.0], -5.0 * PI);
}

#[test]
fn mirroring_and_rotation_carry_arcs_along() {
    assert_arc("G71 G21\nG02 X10 I5 F100", [-5.0, 0.0], PI);
    let arc = arc("#ROTATION ON [ANGLE=90]\nG02 X10 I5 F100");
    assert_near(&arc.shape().centre_mm, &[0.0, 5.0]);
    assert!((arc.shape().sweep_rad + PI).abs() < 1e-12);
    assert_end("#ROTATION ON [ANGLE=90]\nG02 X10 I5 F100", [0.0, 10.0, 0.0]);
    // turned by 90 degrees about X the plane X Y becomes X Z
    let run = clean("#CS ON [0,0,0,90,0,0]\nG03 X10 I5 F100\nM30\n");
    match &run.blocks()[0].path {
        Path::Arc(arc) => {
            assert_eq!((arc.shape().plane, arc.shape().sweep_rad < 0.0), ([2, 0], true));
        }
        other => panic!("no arc: {other:?}"),
    }
}

#[test]
fn arcs_in_a_tilted_coordinate_system() {
    // turned by 30 degrees about Y: X = x cos + z sin, Z = z cos - x sin
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
    // by radius, with absolute centre, mirrored and as helices: the same point half way
    let middle = |text: &str| {
        let run = clean(&format!("#CS ON [0,0,0,0,30,0]\n{text}\nM30\n"));
        at(&run.blocks().last().unwrap().path, 0.5)
    };
    assert_near(&middle("G02 X10 R5 F100"), &[5.0 * c, 5.0, -5.0 * s]);
    assert_near(&middle("G161 G02 X10 I5 J0 F100"), &[5.0 * c, 5.0, -5.0 * s]);
    assert_near(&middle("G03 X10 I5 F100"), &[5.0 * c, -5.0, -5.0 * s]);
    assert_near(&middle("G02 I5 F100"), &[10.0 * c, 0.0, -10.0 * s]);
    assert_near(&middle("G02 X10 Z4 I5 F100"), &[5.0 * c + 2.0 * s, 5.0, 2.0 * c - 5.0 * s]);
    // two turns and a half of pitch 4
    assert_near(&middle("G02 X10 Z10 I5 K4 F100"), &[5.0 * c + 5.0 * s, 5.0, 5.0 * c - 5.0 * s]);
    assert_near(&middle("G91 G02 X10 I5 F100"), &[5.0 * c, 5.0, -5.0 * s]);
    assert_near(&middle("G71 G21\nG02 X10 I5 F100"), &[-5.0 * c, 5.0, 5.0 * s]);
    assert_near(&middle("#ROTATION ON [ANGLE=90]\nG02 X10 I5 F100"), &[-5.0 * c, 5.0, 5.0 * s]);
    // in the plane that stays flat, the arc is an arc of the axes
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

#[test]
fn software_limits_hold_along_arcs() {
    // the upper half circle reaches Y 10, the lower one Y -10
    let high = ["Y.kenngr.swe_pos=95000", "Y.kenngr.swe_neg=-100500"];
    let run = run_on(&high, "G00 X10\nG03 X-10 I-10 F100\nM30\n");
    assert_eq!(super::places(&run.diagnostics), ["21897 2:1"]);
    assert!(run.diagnostics[0].text.contains("highest position 10"), "{:?}", run.diagnostics);
    assert!(run_on(&high, "G00 X10\nG02 X-10 I-10 F100\nM30\n").diagnostics.is_empty());
    // a quarter that does not reach the top, and helices
    assert!(run_on(&high, "G00 X10\nG03 X8 Y6 I-10 F100\nM30\n").diagnostics.is_empty());
    assert_eq!(run_on(&high, "G00 X10\nG03 Z5 I-10 K1 F100\nM30\n").ids(), ["21897"]);
    // turned by 30 degrees about X the top of the half circle lies at Y 10 cos 30 = 8.66
    let turned = "#CS ON [0,0,0,30,0,0]\nG00 X10\nG03 X-10 I-10 F100\nM30\n";
    assert!(run_on(&high, turned).diagnostics.is_empty());
    assert_eq!(run_on(&["Y.kenngr.swe_pos=86000"], turned).ids(), ["21897"]);
    // with compensation the centre of the tool counts: radius 10 - 2 inside, 10 + 2 outside
    let inside = "V.G.WZ_AKT.R=2\nG26 G41 G01 X10 Y0 F100\nG03 X-10 I-10\nG40 G01 X0\nM30\n";
    assert!(run_on(&high, inside).diagnostics.is_empty());
    let outside = inside.replace("G41", "G42");
    assert_eq!(super::places(&run_on(&high, &outside).diagnostics), ["21897 3:1"]);
}

/// The end of an arc by its angle is where the compass puts it; an arc with that end point is the same path.
#[test]
fn arcs_by_centre_and_angle() {
    assert_arc("G02 I10 #CANG=90 F100", [10.0, 0.0], -PI / 2.0);
    let end = |text: &str| Path::Arc(arc(text)).end().clone();
    assert_eq!(end("G02 I10 #CANG=90 F100")[..2], [10.0, 10.0]);
    assert_eq!(end("G03 I10 #CANG=90 F100")[..2], [10.0, -10.0]);
    assert_arc("G01 X5 F100\nG161 G03 I0 J0 #CANG=270", [0.0, 0.0], 1.5 * PI);
    assert_arc("G03 I-4 J3 #CANG=360 F100", [-4.0, 3.0], TAU);
    // in the plane ZX, with a way along Y
    let helix = end("G18 G02 K10 Y3 #CANG=60 F100");
    for (found, wanted) in helix.iter().zip([75.0_f64.sqrt(), 3.0, 5.0]) {
        assert!((found - wanted).abs() < 1e-9, "{helix:?}");
    }
    for (text, id) in [
        ("G02 I10 #CANG=0 F100", "K-0009"),
        ("G02 I10 #CANG=400 F100", "K-0009"),
        ("G02 #CANG=90 R5 F100", "20036"),
        ("G01 X1 #CANG=90 F100", "K-0002"),
    ] {
        assert_eq!(said(text), [id], "{text}");
    }
}

/// The curve of `#CONTOUR MODE [POS]` reaches its interim point, which lies beyond what the lines around it reach: in a check and
/// in a run, for the block at whose end it is; with the limit beyond the curve, and in the other modes, nothing is said. The
/// rest of a long line after the curve is no part of it.
#[test]
fn a_curve_through_a_point_outside_the_limits() {
    let text = |mode: &str, behind: &str| {
        format!("G90 G01 F6000\n#CONTOUR MODE [{mode}]\nG261\nX9\nY10\nG260{behind}\nX0\nM30\n")
    };
    let at = |limit: u32| format!("X.kenngr.swe_pos={limit}");
    let pos = "POS PRE_DIST=3 POST_DIST=3 X12 Y1 Z0";
    for behind in ["", "\nY20", "\nG04 1", "\nZ1\nM0"] {
        let said = |limit: u32| run_on(&[&at(limit)], &text(pos, behind));
        assert_eq!(super::places(&said(100_000).diagnostics)[0], "21897 4:1", "{behind}");
        assert_eq!(said(119_999).ids()[0], "21897", "{behind}");
        assert!(said(130_000).ids().is_empty(), "{behind}: {:?}", said(130_000).diagnostics);
    }
    for mode in ["DEV PATH_DEV=1", "DIST PRE_DIST=3 POST_DIST=3"] {
        assert!(run_on(&[&at(90_000)], &text(mode, "")).ids().is_empty(), "{mode}");
    }
    let machine = super::machine(&[&at(100_000)]);
    let sources = crate::source::MemorySources::new().with("main.nc", text(pos, ""));
    let found = crate::exec::check(
        std::sync::Arc::new(sources),
        "main.nc",
        machine,
        crate::exec::options::Options::default(),
    );
    // both corners lead through the point
    assert_eq!(super::places(&found.diagnostics), ["21897 4:1", "21897 5:1"]);
}
