//! Offsets, dimensions, units and frames.

use super::{assert_end, assert_near, clean, run, run_on};
use kontur_motion::block::Feed;

/// G51 (400180619): words of the face turning axis are diameters with G90, G91 or both as its list says; centres, radii and offsets
/// are not.
#[test]
fn diameters() {
    const ABSOLUTE: &str = "X.kenngr.durchm_prog_abs=1";
    const RELATIVE: &str = "X.kenngr.durchm_prog_rel=1";
    let ends = |settings: &[&str], text: &str| {
        let mut all = vec!["X.kenngr.achs_mode=65"];
        all.extend(settings);
        let run = run_on(&all, &format!("F1000 G18\n{text}\nM30\n"));
        (run.ids(), run.ends().into_iter().map(|e| [e[0], e[2]]).collect::<Vec<_>>())
    };
    let text = "X10\nG51\nX10 Z5\nX20\nG91 X4\nG90 G02 X40 Z11 R6\nG52 G01\nX40\nG92 X1\nG51 X40";
    let (ids, found) = ends(&[ABSOLUTE], text);
    assert_eq!(ids, [""; 0]);
    assert_eq!(
        found,
        [
            [10.0, 0.0],
            [5.0, 5.0],
            [10.0, 5.0],
            [14.0, 5.0],
            [20.0, 11.0],
            [40.0, 11.0],
            [21.0, 11.0]
        ]
    );
    let (_, found) = ends(&[ABSOLUTE, RELATIVE], text);
    assert_eq!(found[3], [12.0, 5.0]);
    let (_, found) = ends(&[RELATIVE], text);
    assert_eq!(found[..4], [[10.0, 0.0], [10.0, 5.0], [20.0, 5.0], [22.0, 5.0]]);
    // a line of 45 deg from the radius 5 to the diameter 30 goes 10 mm in both
    let (_, found) = ends(&[ABSOLUTE], "G17 X5\nG51\n#ANG=45 X30");
    assert_eq!(found[1][0], 15.0);
    assert_eq!(ends(&[], "G51 X10").0, ["K-0075"]);
    assert_eq!(ends(&[ABSOLUTE], "G19 G51").0.last().map(String::as_str), Some("20042"));
    assert_eq!(ends(&[ABSOLUTE], "G51\n#PSET X10").0, ["20610"]);
    assert_eq!(ends(&[ABSOLUTE, "channel.versch_im_durchm=1"], "G51").0, ["K-0019"]);
}

#[test]
fn zero_offsets() {
    assert_end("V.G.NP[1].V.X=10\nG90 G54 X0 F100", [10.0, 0.0, 0.0]);
    assert_end("V.G.NP[1].V.X=10\nG54\nG91 X0 F100", [0.0, 0.0, 0.0]);
    assert_end("V.G.NP[1].V.X=10\nV.G.NP[9].V.X=3\nG54 X1 F100\nG159=9 X1\n", [4.0, 0.0, 0.0]);
    // 1 leaves the offset of the axis out
    assert_end(
        "V.G.NP[2].V.X=7 V.G.NP[2].V.Y=8\nG160=2 X1 Y0\nG55 G01 X1 Y1 F100",
        [1.0, 9.0, 0.0],
    );
    assert_end("V.G.NP[1].V.X=10\nG54 X1 F100\nG53\nX2", [2.0, 0.0, 0.0]);
}

#[test]
fn g92_is_absolute_or_added() {
    assert_end("G92 X10 Y5\nG91 G92 X1\nG90 X0 Y0 F100", [11.0, 5.0, 0.0]);
    assert_end("G92 X10\nX1 F100\nG92 X0\nX1", [1.0, 0.0, 0.0]);
    // a block of its own moves nothing
    assert!(clean("G92 X10 Z30\nM30\n").blocks().is_empty());
}

#[test]
fn dimensions() {
    assert_end("G91 X5 F100\nX5\nG90 X3", [3.0, 0.0, 0.0]);
    assert_eq!(run("X1 G90 G91 F100\nM30\n").ids(), ["K-0008"]);
    assert_end("G91 X1 Y2 Z3 F100\nG90 Z10", [1.0, 2.0, 10.0]);
}

#[test]
fn inches_scale_lengths_and_feeds() {
    let run = clean("G70 G01 X1 F60\nG71 Y1\nM30\n");
    assert_near(&run.end, &[25.4, 1.0, 0.0]);
    assert_eq!(run.blocks()[0].feed, Feed::PathVelocity(25.4));
    // the feed keeps its velocity
    assert_eq!(run.blocks()[1].feed, Feed::PathVelocity(25.4));
}

#[test]
fn mirroring() {
    assert_end("G71 G21 X10 Y5 F100", [-10.0, 5.0, 0.0]);
    assert_end("G71 G22 X10 Y5 F100", [10.0, -5.0, 0.0]);
    assert_end("G71 G23 X10 Y5 F100", [-10.0, -5.0, 0.0]);
    assert_end("G71 G23 X10 Y5 F100\nG20 X10", [10.0, -5.0, 0.0]);
    assert_end("G351 Z-1\nX10 Z5 F100\nG91 Z1", [10.0, 0.0, -6.0]);
    // offsets are not mirrored
    assert_end("G71 V.G.NP[1].V.X=100 G54 G21\nX10 F100", [90.0, 0.0, 0.0]);
}

#[test]
fn rotation() {
    assert_end("#ROTATION ON [ANGLE=90 CENTER1=10 CENTER2=0]\nX20 Y0 F100", [10.0, 10.0, 0.0]);
    assert_end("G68 R90 X10 Y0\nX20 Y0 F100", [10.0, 10.0, 0.0]);
    assert_end("G68 R90 X0 Y0\nG91 X5 F100\nG69 X5", [5.0, 5.0, 0.0]);
    // a change of plane switches it off
    assert_eq!(run("G68 R90 X0 Y0\nG18\nG01 X10 F100\nM30\n").ids(), ["K-0109"]);
}

#[test]
fn coordinate_systems() {
    assert_end("#CS ON [10,20,30,0,0,90]\nX1 Y0 Z0 F100", [10.0, 21.0, 30.0]);
    assert_end("#CS DEF [2][10,0,0]\n#CS ON [2]\nX1 F100\n#CS OFF\nX1", [1.0, 0.0, 0.0]);
    assert_end("#CS ON [10,0,0]\n#CS ON [0,0,0,0,0,90]\nX1 Y0 F100", [10.0, 1.0, 0.0]);
    assert_end("#CS OFF ALL\n#MCS ON\n#TRAFO OFF\nX1 F100", [1.0, 0.0, 0.0]);
    // the offset lies outside the system
    assert_end("V.G.NP[1].V.X=100\nG54\n#CS ON [0,0,0,0,0,90]\nX1 Y0 F100", [100.0, 1.0, 0.0]);
    // selection of a system that was never defined (20821), numbers outside the range (20820)
    assert_eq!(run("#CS ON [3]\nM30\n").ids(), ["20821"]);
    assert_eq!(run("#CS ON\nM30\n").ids(), ["20821"]);
    assert_eq!(run("#CS DEF [0][1,2,3]\nM30\n").ids(), ["20820"]);
    // any number above 0, five systems at most (252660619)
    assert_end("#CS DEF [6][1,2,3]\n#CS DEF [70][4]\n#CS ON [6]\nX1 F100", [2.0, 0.0, 0.0]);
    let five = [10, 20, 30, 40, 50].map(|i| format!("#CS DEF [{i}][{i}]\n")).concat();
    assert!(clean(&format!("{five}#CS DEF [20][7]\nM30\n")).ids().is_empty());
    assert_eq!(run(&format!("{five}#CS DEF [6][1,2,3]\nM30\n")).ids(), ["21234"]);
    assert_eq!(run("#TRAFO ON\nM30\n").ids(), ["K-0019"]);
}

#[test]
fn position_presets_and_suppressed_offsets() {
    // the vendor's examples
    assert_end("X50 Y10 F100\n#PSET X20 Y20\nX10\n#PRESET X10\nX30\n#PRESET\n", [30.0, 10.0, 0.0]);
    assert_end("X50 F100\n#PSET X20\nX10", [40.0, 0.0, 0.0]);
    let offsets = "V.G.NP[1].V.X=11\nV.G.NP[1].V.Y=22\nG54\nG92 X10 Y20\nX100 Y150 F100\n";
    assert_end(offsets, [121.0, 192.0, 0.0]);
    assert_end(&format!("{offsets}#SUPPRESS OFFSETS X50 Y100"), [50.0, 100.0, 0.0]);
    // kinds: 11 of G54, 10 of G92, 5 of #PSET, 7 of the tool, as far as they are not suppressed
    let all = "V.G.NP[1].V.X=11 V.G.WZ[1].V.X=7\nF100 G54 G92 X10\nX0\n#PSET X-5\nD1\nX0\n";
    for (kinds, left) in [
        ("", 0.0),
        ("[ZERO]", 22.0),
        ("[ADD_ZERO]", 23.0),
        ("[PSET]", 28.0),
        ("[TOOL]", 26.0),
        ("[MEASURE CLAMP MANUAL]", 33.0),
        ("[zero tool]", 15.0),
        ("[ZERO ADD_ZERO PSET CLAMP TOOL MEASURE MANUAL]", 0.0),
    ] {
        let text = format!("{all}#SUPPRESS OFFSETS {kinds} X50 Y1");
        assert_end(&text, [50.0 + left, 1.0, 0.0]);
        // the offsets act again, and the program knows where it is
        assert_end(&format!("{text}\nG91 X1\nP1=V.A.ABS.X\nG90 X P1"), [51.0 + left, 1.0, 0.0]);
    }
    for wrong in ["[]", "[CS]", "[ZERO=1]", "[1]"] {
        assert_eq!(run(&format!("#SUPPRESS OFFSETS {wrong} X1 F100\nM30\n")).ids(), ["21220"]);
    }
}

#[test]
fn the_feed_group() {
    let run = clean("#FGROUP [X]\nG01 X3 Y4 F100\n#FGROUP\nX6 Y8\nM30\n");
    let lengths: Vec<f64> = run.blocks().iter().map(|b| b.path.length()).collect();
    assert_near(&lengths, &[3.0, 5.0]);
}

/// 120462 (264750475): F of an arc counts along all of its axes, or along other axes alone, which is refused.
#[test]
fn the_feed_group_of_an_arc() {
    let ids = |group: &str| {
        let text = format!("F1000 #FGROUP {group}\nG02 X10 I5\nG03 X0 I-5\nM30\n");
        run(&text.replace("F1000 ", "F1000\n")).ids()
    };
    for group in ["", "[X,Y]", "[X,Y,Z]"] {
        assert_eq!(ids(group), [""; 0], "{group}");
    }
    for group in ["[X]", "[Y,Z]", "[Z]"] {
        assert_eq!(ids(group), ["120462"], "{group}");
    }
    let text = "#SET AX [X,1,0][Y,2,1][C,3,3]\nF1000\n#FGROUP [C]\nG02 X10 I5\nM30\n";
    assert_eq!(run(text).ids(), ["K-0019"]);
}

#[test]
fn tool_length_acts_on_the_third_main_axis() {
    assert_end("V.G.WZ[2].L=50 V.G.WZ[2].R=5\nD2 Z10 F100\nX1", [1.0, 0.0, 60.0]);
    assert_end("V.G.WZ[2].L=50\nD2 Z10 F100\nD0 Z10", [0.0, 0.0, 10.0]);
    assert_eq!(run("D3 Z1 F100\nM30\n").ids(), ["K-0114"]);
}

/// The length goes to the third axis of another plane (304765835), with the next absolute word; so does the plane that a cycle
/// gives back. Between `#MCS ON` and `#MCS OFF` only a tool acts that is programmed there.
#[test]
fn tool_length_follows_the_plane() {
    let tool = "V.G.WZ[2].L=50 V.G.WZ[2].R=5\nF100 D2 X0 Y0 Z0\n";
    assert_end(&format!("{tool}G18 X1 Y1 Z1"), [1.0, 51.0, 1.0]);
    assert_end(&format!("{tool}G18\nG91 X1 Y1 Z1"), [1.0, 1.0, 51.0]);
    assert_end(&format!("{tool}G19 X1 Y1 Z1\nG17 X1"), [1.0, 1.0, 1.0]);
    let cycle = format!("%L C\nG18 X1 Y1 Z1\nM17\n%MAIN\n{tool}LL CYCLE [NAME=C]\n");
    assert_end(&cycle, [1.0, 51.0, 1.0]);
    assert_end(&format!("{cycle}X2 Y2 Z2"), [2.0, 2.0, 52.0]);
    let machine = format!("{tool}#MCS ON\nX1 Y1 Z1\n");
    assert_end(&format!("{machine}G18 X2 Y2 Z2"), [2.0, 2.0, 2.0]);
    assert_end(&format!("{machine}V.G.WZ_AKT.R=3 X2 Z2"), [2.0, 1.0, 2.0]);
    assert_end(&format!("{machine}D2 Z2\nG18 Y2"), [1.0, 52.0, 52.0]);
    assert_end(&format!("{machine}G18\n#MCS OFF\nX2 Y2 Z2"), [2.0, 52.0, 2.0]);
}

#[test]
fn tool_length_has_an_axis_of_its_own() {
    let tool = "V.G.WZL=50\nF100 X0 Y0 Z0\n";
    assert_end(&format!("{tool}#TLAX [Z+]\nG18 X1 Y1 Z1"), [1.0, 1.0, 51.0]);
    assert_end(&format!("#TLAX [X-]\n{tool}G91 X1\nG90 Y1"), [-49.0, 1.0, 0.0]);
    assert_end(&format!("{tool}#TLAX [Y+]\nX1 Y1 Z1\n#TLAX DEFAULT\nX1 Y1 Z1"), [1.0, 1.0, 51.0]);
    for wrong in ["#TLAX", "#TLAX [Z]", "#TLAX [Q+]", "#TLAX [S+]", "#TLAX [1]", "#TLAX [Z+, X+]"] {
        assert_eq!(run(&format!("{wrong}\nM30\n")).ids().len(), 1, "{wrong}");
    }
    assert_eq!(run("#TLAX OFF [Z+]\nM30\n").ids().len(), 1);
    assert_eq!(run("V.G.WZL=5\nP1=V.G.WZL X P1 F100\nM30\n").end[0], 5.0);
}

#[test]
fn axis_exchange_renames_axes() {
    assert_end("#PUT AX [X, Z]\n#CALL AX [Q, 1, 0]\nQ5 Y1 F100", [5.0, 1.0, 0.0]);
    assert_eq!(run("#PUT AX [X]\nX1 F100\nM30\n").ids(), ["20200"]);
    assert_eq!(run("#CALL AX [1X, 1, 0]\nM30\n").reason(), super::EndReason::Aborted);
}

#[test]
fn software_limits_are_checked() {
    let run = run("G01 X501 F100\nM30\n");
    assert_eq!(super::places(&run.diagnostics), ["21897 1:5"]);
    assert!(run.blocks().is_empty());
}

#[test]
fn several_dimensions_in_a_block_act_from_their_place_on() {
    // P-CHAN-00116: the examples of the vendor's page
    let several = ["channel.multi_dimension_in_block=1"];
    let text = "X1 Y1 Z1 F100\nG90 X10 Y20 G91 Z30\nX15 G90 Y25 Z15\nG91 X10 G90 Z30 G91 Y5\nX20 Z30 G90 Y40\nG90 G91 Z30\nX0 Y0\nM30\n";
    let run = run_on(&several, text);
    assert!(run.diagnostics.is_empty(), "{:?}", super::shown(&run.diagnostics));
    let expected = [
        [1.0, 1.0, 1.0],
        [10.0, 20.0, 31.0],
        [25.0, 25.0, 15.0],
        [35.0, 30.0, 30.0],
        [55.0, 40.0, 60.0],
        [55.0, 40.0, 90.0],
    ];
    // the last block moves nothing: G91 has stayed
    assert_eq!(run.ends(), expected);
    // turned by 90 degrees: X is absolute, Y an increment
    let text = "#ROTATION ON [ANGLE=90]\nX5 Y1 F100\nG90 X10 G91 Y2\nM30\n";
    let run = run_on(&several, text);
    super::assert_near(&run.end, &[-3.0, 10.0, 0.0]);
    assert_eq!(super::run("G90 X1 G91 Y1 F100\nM30\n").ids(), ["K-0008"]);
}

/// Source: TF5200 programming manual, "Modulo programming in absolute coordinates", from 0 degrees.
/// The examples of the manual: 200 degrees from 0 by -160, -200 by +160, whatever sign comes first.
#[test]
fn modulo_axes_go_the_shortest_way_with_the_channel_list() {
    let modulo = [
        "Z.kenngr.achs_typ=ACHSTYP_ROTATOR",
        "Z.kenngr.achs_mode=0x4",
        "channel.enable_mod_axis_always_shortest_way=1",
    ];
    for (word, deg) in [
        ("Z200", -160.0),
        ("Z+200", -160.0),
        ("Z-200", 160.0),
        ("Z--200", -160.0),
        ("Z+-200", 160.0),
        ("G91 Z+200", 200.0),
        ("G91 Z-200", -200.0),
    ] {
        let run = run_on(&modulo, &format!("G01 {word} F1000\nM30\n"));
        assert!(run.ids().is_empty(), "{word}: {:?}", run.ids());
        assert_eq!(run.end[2], deg, "{word}");
    }
}

#[test]
fn modulo_axes_turn_in_the_direction_of_the_first_sign() {
    let modulo = ["Z.kenngr.achs_typ=ACHSTYP_ROTATOR", "Z.kenngr.achs_mode=0x4"];
    let on = |text: &str| run_on(&modulo, text);
    let end = |program: &str| {
        let run = on(&format!("{program}\nM30\n"));
        assert!(run.ids().is_empty(), "{program}: {:?}", run.ids());
        run.end[2]
    };
    for (word, deg) in [
        ("Z+200", 200.0),
        ("Z-200", -160.0),
        ("Z+-200", 160.0),
        ("Z+[-200]", 160.0),
        ("Z--200", -200.0),
        ("Z-[-200]", -200.0),
        ("Z200", -160.0),
        ("Z[+200]", -160.0),
        ("Z[-200]", 160.0),
        ("Z = -200", -160.0),
        ("P1=10 Z+P1", 10.0),
        ("P1=-350 Z-P1", -350.0),
        ("Z+450", 90.0),
        ("G91 Z-200", -200.0),
        ("G91 Z400", 400.0),
    ] {
        assert_near(&[end(&format!("G01 F100 {word}"))], &[deg]);
    }
    // never more than one revolution, and none to where the axis is
    assert_near(&[end("G01 F100 G91 Z3600\nG90 Z+0")], &[3600.0]);
    assert_near(&[end("G01 F100 Z350\nZ10")], &[10.0]);
    assert_near(&[end("V.G.NP[1].V.Z=20\nG54 G01 F100 Z-350")], &[-350.0]);
    let sum = on("P1=5\nG01 F100 Z-P1+3\nM30\n");
    assert_eq!(sum.ids(), ["K-0002"]);
    // a linear axis reads every sign as a sign
    assert_end("P1=5 G01 F100 Z-P1+3", [0.0, 0.0, -2.0]);
    assert_end("G01 F100 Z--200", [0.0, 0.0, 200.0]);
}

/// A tool list and a list of zero offsets give what D, V.G.WZ, G54 and the start of the program use.
#[test]
fn data_of_lists() {
    let settings = [
        "tool.wz[5].laenge=600000",
        "tool.wz[5].radius=200000",
        "tool.wz[5].ax_versatz[0]=15000",
        "tool.wz[5].gueltig=1",
        "tool.wz[8].laenge=10000",
        "zero.np_grp[1].achse[0].versch=100000",
        "zero.np_grp[2].achse[1].versch=-55000",
        "zero.default_index=2",
    ];
    let run = |text: &str| run_on(&settings, text);
    // group 2 at the start, group 1 by G54, length on Z and the offset of X by D
    assert_eq!(run("X0 Y0 Z0 F100\nM30\n").end, [0.0, -5.5, 0.0]);
    assert_eq!(run("G54 X0 Y0 Z0 F100\nM30\n").end, [10.0, 0.0, 0.0]);
    assert_eq!(run("G53 D5\nX0 Y0 Z0 F100\nM30\n").end, [1.5, 0.0, 60.0]);
    assert_eq!(run("G53 D5\nX0 Z0 F100\nD0\nX0 Z0\nM30\n").end, [0.0, 0.0, 0.0]);
    let told = run(
        "#MSG [\"%f %f %d %d %d\", V.G.WZ[5].L, V.G.WZ[5].R, V.G.WZ[5].OK, V.G.WZ[8].OK, V.G.WZ[9].OK]\nM30\n",
    );
    assert_eq!(told.messages(), ["60.000000 20.000000 1 0 0"]);
    // data that are not valid are as good as none, until the program says otherwise
    let wrong = run("G53 D8 X0 Z0 F100\nM30\n");
    assert_eq!((wrong.ids(), wrong.end), (vec!["K-0114".to_owned()], vec![0.0; 3]));
    assert_eq!(run("V.G.WZ[8].OK=1\nG53 D8 X0 Z0 F100\nM30\n").end, [0.0, 0.0, 1.0]);
    assert_eq!(run("#MSG [\"%d\", V.G.NP_DEFAULT]\nM30\n").messages(), ["2"]);
}
