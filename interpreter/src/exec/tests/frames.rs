//! Mirroring, rotation and coordinate systems transform the complete path: arcs, helices, chamfers and compensation.

use super::{assert_near, clean, points, said};

const PROGRAMS: &[&str] = &[
    "X5 Y2\nG02 X15 Y2 I5\nG03 X15 Y12 R5 Z4\nG02 I3 J1\nG161 G03 X10 Y20 Z9 I12.5 J16 K2\n",
    "X10\nG301 I2\nY10\nG302 I1\nG02 X20 Y10 I5 J-5\nG301\nG01 Y-5\nZ-5\nX0",
    "V.G.WZ_AKT.R=2\nG26 G41 X0 Y-10\nY0\nX10\nG02 X20 Y-10 J-10\nG01 Z3\nG03 X30 Y-20 I10\nG01 Y-30\nX5\nG40 X0 Y-40",
    "V.G.WZ_AKT.R=1.5\nG25 G42 X0 Y-10\nY0\nX10\nG02 X20 Y-10 J-10\nG03 X30 Y-20 I10\nG01 Y-5\nX45\nG40 X50 Y-40",
    "V.G.WZ_AKT.R=2\nG237 G26 G42 G03 X20 Y20 J20\nG01 X-20\nG40 X0 Y0",
];

#[track_caller]
fn assert_carried(frame: &str, image: impl Fn([f64; 3]) -> [f64; 3]) {
    for text in PROGRAMS {
        let plain = points(&format!("F1000 G00 X0 Y0 Z0\nG01 {text}\nM30\n"));
        let framed = points(&format!("{frame}\nF1000 G00 X0 Y0 Z0\nG01 {text}\nM30\n"));
        // the motion to the origin of the frame may be a separate one
        let framed = &framed[framed.len() - plain.len()..];
        for (p, q) in plain.iter().zip(framed) {
            let expected = image(*p);
            let near = expected.iter().zip(q).all(|(a, b)| (a - b).abs() < 1e-9);
            assert!(near, "{frame}: {text}: {p:?} at {q:?} instead of {expected:?}");
        }
    }
}

/// `#MCS ON` (208517515): words are positions of the axes, regardless of offsets, systems and mirroring. `#MCS OFF` restores
/// the previous state; offsets in machine coordinates are discarded.
#[test]
fn machine_coordinates() {
    let all = "V.G.NP[1].V.X=100\nV.G.NP[1].V.Z=7\nV.G.WZ[1].L=30\nG54 D1 G92 Y5\n#CS ON [10,0,0,0,0,90]\nX1 Y2 Z3 F1000\n";
    let before = clean(&format!("{all}M30\n")).end;
    assert_near(&before, &[100.0 + 10.0 - 2.0, 5.0 + 1.0, 7.0 + 30.0 + 3.0]);
    let text =
        format!("{all}#MCS ON\nX11 Y12 Z13\nG91 X1\nG90 G92 X200\nX1\n#MCS OFF\nX1 Y2 Z3\nM30\n");
    let run = clean(&text);
    let e = run.ends();
    assert_near(&e[1], &[11.0, 12.0, 13.0]);
    assert_near(&e[2], &[12.0, 12.0, 13.0]);
    assert_near(&e[3], &[201.0, 12.0, 13.0]);
    assert_near(&e[4], &before);
    // program coordinates are those of the current axis positions
    let run = clean(&format!(
        "{all}#MCS ON\nX108 Y16 Z50\n#MCS OFF\nP1=V.A.ABS.X P2=V.A.ABS.Y P3=V.A.ABS.Z\nX0 Y0 Z0\nX P1 Y P2 Z P3\nM30\n"
    ));
    assert_near(&run.end, &[108.0, 16.0, 50.0]);
    // a tool change takes effect in machine coordinates, or after them
    for (ex, inside) in [("", 19.0), ("EX TOOL", 9.0)] {
        let run =
            clean(&format!("V.G.WZ[2].L=10\n#MCS ON {ex}\nD2\nZ9 F1000\n#MCS OFF\nZ0\nM30\n"));
        let z: Vec<f64> = run.ends().iter().map(|e| e[2]).collect();
        assert_eq!(z, [inside, 10.0], "{ex}");
    }
    // also mirroring and rotation
    let e =
        clean("G71 G21 G68 R30\nX10 Y10 F1000\n#MCS ON\nX5 Y5\n#MCS OFF\nX10 Y10\nM30\n").ends();
    assert_near(&e[1][..2], &[5.0, 5.0]);
    assert_near(&e[2], &e[0]);
    for text in ["#MCS ON\n#CS ON [1,0,0,0,0,0]", "V.G.WZ_AKT.R=1\nG41 X10 F100\nX20\n#MCS ON"] {
        assert!(said(text).iter().any(|id| ["K-0019", "20802"].contains(&id.as_str())), "{text}");
    }
}

#[test]
fn mirroring() {
    assert_carried("G71 G21", |[x, y, z]| [-x, y, z]);
    assert_carried("G71 G22", |[x, y, z]| [x, -y, z]);
    assert_carried("G71 G23", |[x, y, z]| [-x, -y, z]);
}

#[test]
fn rotation_in_the_plane() {
    let (s, c) = libm::sincos(37.0_f64.to_radians());
    let turned = |[x, y, z]: [f64; 3]| [c * x - s * y, s * x + c * y, z];
    assert_carried("#ROTATION ON [ANGLE=37]", turned);
    assert_carried("G68 R37 X0 Y0", turned);
    // mirrored after the rotation
    assert_carried("G71 G21\n#ROTATION ON [ANGLE=37]", |p| {
        let [x, y, z] = turned(p);
        [-x, y, z]
    });
}

#[test]
fn coordinate_systems_turned_in_space() {
    let deg = |d: f64| libm::sincos(d.to_radians());
    let about_x = |(s, c): (f64, f64), [x, y, z]: [f64; 3]| [x, c * y - s * z, s * y + c * z];
    let about_y = |(s, c): (f64, f64), [x, y, z]: [f64; 3]| [c * x + s * z, y, c * z - s * x];
    let about_z = |(s, c): (f64, f64), [x, y, z]: [f64; 3]| [c * x - s * y, s * x + c * y, z];
    let shifted = |[x, y, z]: [f64; 3]| [x + 5.0, y - 6.0, z + 7.0];
    assert_carried("#CS ON [5,-6,7,0,0,30]", |p| shifted(about_z(deg(30.0), p)));
    assert_carried("#CS ON [5,-6,7,25,0,0]", |p| shifted(about_x(deg(25.0), p)));
    assert_carried("#CS ON [5,-6,7,0,-65,0]", |p| shifted(about_y(deg(-65.0), p)));
    let all = |p| shifted(about_z(deg(30.0), about_y(deg(-65.0), about_x(deg(25.0), p))));
    assert_carried("#CS ON [5,-6,7,25,-65,30]", all);
    assert_carried("#CS ON [5,-6,7,25,-65,30]\nG71 G21", |[x, y, z]| all([-x, y, z]));
    assert_carried("#CS ON [5,-6,7,25,-65,0]\n#CS ON [0,0,0,10,0,40]", |p| {
        let inner = about_z(deg(40.0), about_x(deg(10.0), p));
        shifted(about_y(deg(-65.0), about_x(deg(25.0), inner)))
    });
    // a zero offset is outside the frame
    assert_carried("V.G.NP[1].V.X=3\nV.G.NP[1].V.Z=2\nG54\n#CS ON [5,-6,7,25,-65,30]", |p| {
        let [x, y, z] = all(p);
        [x + 3.0, y, z + 2.0]
    });
}
