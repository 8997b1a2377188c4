//! Mirroring, rotation and coordinate systems carry a whole path along: arcs, helices, chamfers and compensation.

use super::{assert_near, clean, run, said};

/// Points of every motion of a program.
fn points(text: &str) -> Vec<[f64; 3]> {
    let run = clean(text);
    let mut points = Vec::new();
    for block in run.blocks() {
        for share in [0.0, 0.2, 0.5, 0.9, 1.0] {
            let mut q = [0.0; 3];
            block.path.position(share * block.path.length(), &mut q);
            points.push(q);
        }
    }
    points
}

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
        // the way to the origin of the frame may be a motion of its own
        let framed = &framed[framed.len() - plain.len()..];
        for (p, q) in plain.iter().zip(framed) {
            let expected = image(*p);
            let near = expected.iter().zip(q).all(|(a, b)| (a - b).abs() < 1e-9);
            assert!(near, "{frame}: {text}: {p:?} at {q:?} instead of {expected:?}");
        }
    }
}

/// `#MCS ON` (208517515): words are positions of the axes, whatever offsets, systems and mirroring there are; with `#MCS OFF` the
/// state before is back, offsets of the machine coordinates are forgotten.
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
    // the coordinates of the program are those of where the axes are
    let run = clean(&format!(
        "{all}#MCS ON\nX108 Y16 Z50\n#MCS OFF\nP1=V.A.ABS.X P2=V.A.ABS.Y P3=V.A.ABS.Z\nX0 Y0 Z0\nX P1 Y P2 Z P3\nM30\n"
    ));
    assert_near(&run.end, &[108.0, 16.0, 50.0]);
    // a tool change acts in the machine coordinates, or after them
    for (ex, inside) in [("", 19.0), ("EX TOOL", 9.0)] {
        let run =
            clean(&format!("V.G.WZ[2].L=10\n#MCS ON {ex}\nD2\nZ9 F1000\n#MCS OFF\nZ0\nM30\n"));
        let z: Vec<f64> = run.ends().iter().map(|e| e[2]).collect();
        assert_eq!(z, [inside, 10.0], "{ex}");
    }
    // mirroring and rotation too
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
    // a zero offset lies outside the frame
    assert_carried("V.G.NP[1].V.X=3\nV.G.NP[1].V.Z=2\nG54\n#CS ON [5,-6,7,25,-65,30]", |p| {
        let [x, y, z] = all(p);
        [x + 3.0, y, z + 2.0]
    });
}

/// Offsets programmed in a coordinate system (1086442763) lie in its axes, add to those below, and end with it; tool offsets belong
/// to no system.
#[test]
fn offsets_belong_to_their_system() {
    let end = |text: &str| {
        let table = "V.G.NP[1].V.X=100\nV.G.NP[2].V.X=7\nV.G.NP[2].V.Y=1\nV.G.WZ[1].L=30\n";
        clean(&format!("{table}F1000\n{text}\nM30\n")).end
    };
    let turned = "#CS ON [0,0,0,0,0,90]\n";
    // X of the system is Y of the machine
    assert_near(&end(&format!("{turned}G92 X5\nX1 Y2")), &[-2.0, 6.0, 0.0]);
    assert_near(&end(&format!("{turned}G55\nX1 Y2")), &[-3.0, 8.0, 0.0]);
    assert_near(&end(&format!("{turned}G55 G92 X5\nX1 Y2")), &[-3.0, 13.0, 0.0]);
    // what was active before stays, and lies in its own axes
    assert_near(&end(&format!("G54\n{turned}G55\nX1 Y2")), &[97.0, 8.0, 0.0]);
    assert_near(&end(&format!("G54\n{turned}G53\nX1 Y2")), &[98.0, 1.0, 0.0]);
    assert_near(&end(&format!("G92 Y3\n{turned}G91 G92 X5\nG90 X1 Y2")), &[-2.0, 9.0, 0.0]);
    // a system on a system with an offset: the second one is placed where the offset leads
    let second = "#CS ON [10,0,0,0,0,90]\n";
    assert_near(&end(&format!("{turned}G92 X5\n{second}X1 Y2")), &[-1.0, 13.0, 0.0]);
    assert_near(&end(&format!("{turned}G92 X5\n{second}G92 Y4\nX1 Y2")), &[-1.0, 9.0, 0.0]);
    // the end of a system takes its offsets along, and brings those below back
    let inside = format!("G54\n{turned}G55 G92 X5\nX1 Y2\n");
    assert_near(&end(&format!("{inside}#CS OFF\nX1 Y2")), &[101.0, 2.0, 0.0]);
    assert_near(&end(&format!("{inside}#CS OFF ALL\nX1 Y2")), &[101.0, 2.0, 0.0]);
    assert_near(&end(&format!("{inside}#CS OFF\n{turned}X1 Y2")), &[98.0, 1.0, 0.0]);
    assert_near(&end(&format!("{inside}#MCS ON\nX0 Y0\n#MCS OFF\nX1 Y2")), &[97.0, 13.0, 0.0]);
    // a new offset moves nothing, and increments know none
    assert_near(&end(&format!("{turned}X1 Y2\nG92 X5\nG91 X1")), &[-2.0, 2.0, 0.0]);
    assert_near(&end(&format!("{turned}X1 Y2\nG92 X5 Y5\nY3")), &[-8.0, 1.0, 0.0]);
    // written tables and the offset in use
    assert_near(&end(&format!("{turned}G55\nV.G.NP[2].V.X=20\nX1 Y2")), &[-3.0, 21.0, 0.0]);
    assert_near(&end(&format!("{turned}G55\nV.G.NP_AKT.V.X=20\nX1 Y2")), &[-3.0, 21.0, 0.0]);
    assert_near(&end(&format!("G54\n{turned}P1=V.G.NP_AKT.V.X\nX1 Y P1")), &[100.0, 1.0, 0.0]);
    assert_near(&end("#CS ON [0,0,0,90,0,0]\nG92 Z2\nD1 X1 Y2 Z3"), &[1.0, -5.0, 32.0]);
    // mirrored and turned coordinates of the program, as below all systems
    assert_near(&end(&format!("{turned}G71 G21 G92 X5\nX1 Y2")), &[-2.0, 4.0, 0.0]);
    assert_near(
        &end(&format!("{turned}#ROTATION ON [ANGLE=90]\nG92 X5\nX1 Y2")),
        &[-1.0, 3.0, 0.0],
    );
}

/// `#CS ADD` to `#CS DEL`: what the pages do not print.
#[test]
fn stack_of_systems() {
    let ids = |text: &str| run(&format!("F100\n{text}\nM30\n")).ids();
    let stack = "#CS ADD [A1B][0,0,0,0,0,90]\n#CS ADD [B][10]\n";
    let end = |text: &str| clean(&format!("F100\n{stack}{text}\nM30\n")).end;
    // offsets belong to a system and stay while it is active
    assert_near(&end("#CS SELECT [A1B]\nG92 X1\n#CS SELECT [B]\nX1"), &[0.0, 12.0, 0.0]);
    assert_near(&end("#CS SELECT [B]\nG92 X1\n#CS SELECT [A1B]\nX1"), &[0.0, 1.0, 0.0]);
    assert_near(&end("#CS SELECT [A1B]\nG92 X1\n#CS SET [A1B][5]\nX1 Y2"), &[7.0, 2.0, 0.0]);
    // nothing moves by itself, and increments begin where the axes are
    assert_near(&end("X3 Y4\n#CS SELECT [B]\nG91 X1"), &[3.0, 5.0, 0.0]);
    assert_near(
        &end("X3 Y4\n#CS SELECT [B]\n#CS SET [B][5,6]\nG91 X1\n#CS DEL ALL\nX1"),
        &[4.0, 5.0, 0.0],
    );
    // inactive ones change and go without effect; a deleted name is free again
    assert_near(&end("#CS SELECT [A1B]\n#CS SET [B][70]\n#CS DEL\nX1"), &[0.0, 1.0, 0.0]);
    assert_near(&end("#CS DEL\n#CS ADD [B][,20]\n#CS SELECT [B]\nX1 Y0"), &[-20.0, 1.0, 0.0]);
    assert_near(&end("#CS SELECT [B]\n#MCS ON\nX1 Y1\n#MCS OFF\nX1 Y0"), &[0.0, 11.0, 0.0]);
    let five =
        ["N0S", "N1S", "N2S", "N3S", "N4S"].map(|name| format!("#CS ADD [{name}][1]\n")).concat();
    assert_eq!(ids(&five), [""; 0]);
    assert_near(&clean(&format!("{five}#CS SELECT [N4S]\nG00 X0\nM30\n")).end, &[5.0, 0.0, 0.0]);
    assert_eq!(ids(&format!("{five}#CS ADD [SIX][1]")), ["21234"]);
    for (text, id) in [
        ("#CS SELECT [B]", "21601"),
        ("#CS SET [B][1]", "21601"),
        ("#CS DEL", "20821"),
        ("#CS ADD [MCS][1]", "20675"),
        ("#CS ADD [NINECHARS][1]", "20675"),
        ("#CS ADD [B]", "20675"),
        ("#CS ADD [B][1,2,3,4,5,6,7]", "20675"),
        ("#CS ADD [B][1]\n#CS SELECT", "20675"),
        ("#CS ADD [B][1]\n#CS SELECT [b]", "21601"),
        ("#CS ADD [B][1]\n#CS DEL [B]", "21220"),
        ("#CS ADD [B][1]\n#CS ON [1,2,3]\n#CS SELECT [B]", "K-0019"),
        ("#CS ADD [B][1]\n#CS SELECT [B]\n#CS ON [1,2,3]", "K-0019"),
        ("#CS ADD [B][1]\n#CS SELECT [B]\n#CS OFF", "K-0019"),
        ("#CS ADD [B][1]\n#MCS ON\n#CS SELECT [B]", "K-0019"),
        ("#CS ADD [B][1]\nV.G.WZR=1 G41 X1\n#CS SELECT [B]\nG40 X2", "20802"),
    ] {
        assert_eq!(ids(text).first().map(String::as_str), Some(id), "{text}");
    }
    assert_eq!(ids("#CS DEL ALL"), [""; 0]);
}

/// 20825: the same number twice was two systems, one within the other; a definition without a number takes a free one (208480907).
#[test]
fn active_systems_are_not_defined_anew() {
    let ids = |text: &str| said(text).first().cloned().unwrap_or_default();
    let on = "#CS ON [1][1,2,3,0,0,0]\nG00 X0 Y0 Z0\n";
    assert_eq!(ids(&format!("{on}#CS ON [1][10,20,30]")), "20825");
    assert_eq!(ids(&format!("{on}#CS DEF [1][10,20,30]")), "20825");
    assert_eq!(ids(&format!("{on}#MCS ON\n#CS DEF [1][10,20,30]")), "20825");
    assert_eq!(ids("#CS DEF [1][1,2]\n#CS ON [1]\n#CS DEF [1][10,20,30]"), "20825");
    let end = |text: &str| clean(&format!("{text}\nG00 X0 Y0 Z0\nM30\n")).end;
    assert_near(&end(&format!("{on}#CS OFF\n#CS ON [1][10,20,30]")), &[10.0, 20.0, 30.0]);
    assert_near(&end(&format!("{on}#CS ON [2][10,20,30]")), &[11.0, 22.0, 33.0]);
    assert_near(&end("#CS DEF [1]\n#CS DEF [2]\n#CS ON [1]"), &[1.0, 0.0, 0.0]);
}

/// 21556, and refused where no page names a number: a turn of millimetres into degrees went to the axes as it was.
#[test]
fn rotary_axes_are_not_turned_into_linear_ones() {
    let ids =
        |settings: &[&str], text: &str| super::run_on(settings, &format!("{text}\nM30\n")).ids();
    let rotary = "Z.kenngr.achs_typ=ACHSTYP_ROTATOR";
    let modulo = [rotary, "Z.kenngr.achs_mode=0x4"];
    assert_eq!(ids(&modulo, "#CS ON [1,2,3]"), ["21556"]);
    assert_eq!(ids(&modulo, "#CS ADD [A][1,2,3]\n#CS SELECT [A]"), ["21556"]);
    assert_eq!(ids(&modulo, "G18\n#ROTATION ON [ANGLE=30]"), ["K-0019"]);
    assert_eq!(ids(&modulo, "G18\nG68 R30"), ["K-0019"]);
    assert_eq!(ids(&modulo, "G68 R30\n#ROTATION ON [ANGLE=30]"), [""; 0]);
    assert_eq!(ids(&modulo, "G18 G41"), ["21555"]);
    assert_eq!(ids(&[rotary], "#CS ON [1,2,3,30]"), ["K-0019"]);
    assert_eq!(ids(&[rotary], "#CS ADD [A][1,2,3,0,30]"), ["K-0019"]);
    assert_eq!(ids(&[rotary], "#CS ON [1,2,3,0,0,30]"), [""; 0]);
}

/// #PSET lies in the axes of its coordinate system and ends with it (1086442763).
#[test]
fn position_presets_in_systems() {
    let end = |text: &str| clean(&format!("F1000 G01\n{text}\nM30\n")).end;
    // X of the system is Y of the machine, 10 mm beside its origin
    let on = "#CS ON [10,0,0,0,0,90]\nX5 Y0\n";
    assert_near(&end(&format!("{on}#PSET X1\nX2")), &[10.0, 6.0, 0.0]);
    assert_near(&end(&format!("{on}#PSET X1 Y2\nX2 Y2")), &[10.0, 6.0, 0.0]);
    assert_near(&end(&format!("{on}#PSET X1\n#PSET X7\nG91 X1\nG90 X8")), &[10.0, 6.0, 0.0]);
    assert_near(&end(&format!("{on}#PSET X1\n#PRESET X0\nX2")), &[10.0, 2.0, 0.0]);
    assert_near(&end(&format!("{on}#PSET X1\n#CS OFF\nX0 Y0")), &[0.0, 0.0, 0.0]);
    // offsets below stay, and a system within counts from them
    assert_near(&end("X3\n#PSET X0\n#CS ON [10,0]\nX0\n#PSET X100\nX101"), &[14.0, 0.0, 0.0]);
    assert_eq!(said("#SET AX [X,1,0][Y,2,1][C,3,3]\n#CS ON [1,2]\n#PSET C1"), ["K-0019"]);
}
