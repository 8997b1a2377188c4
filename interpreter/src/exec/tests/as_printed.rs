//! Programs and lists of the vendor's pages that ran otherwise before; the numbers are printed or follow from the page by hand.

use super::{Run, Step, Sync, assert_near, clean, run, run_on, said};
use kontur_motion::block::Feed;

/// Runs on settings without an error.
#[track_caller]
fn without_errors(settings: &[&str], text: &str) -> Run {
    let run = run_on(settings, &format!("{text}\nM30\n"));
    assert!(run.diagnostics.iter().all(|d| !d.is_error()), "{text}: {:?}", run.ids());
    run
}

/// P-ZERO-00001: G53 takes the zero offsets back unless its group is in use.
#[test]
fn g53_has_offsets_only_where_the_list_says_so() {
    let text = "V.G.NP[0].V.X=5\nV.G.NP[1].V.X=7\nG90 G54 G01 F100 X1\nG53 X10\nG159=0 X20";
    let x = |settings: &[&str]| -> Vec<f64> {
        without_errors(settings, text).ends().iter().map(|end| end[0]).collect()
    };
    assert_eq!(x(&[]), [8.0, 10.0, 20.0]);
    assert_eq!(x(&["zero.g53_verfuegbar=1"]), [8.0, 15.0, 25.0]);
}

/// P-CHAN-00397 with the numbers of page 1086442763: a main axis and one behind the three main axes.
#[test]
fn offsets_of_tracked_axes_belong_to_the_system_or_to_the_channel() {
    let text = "G90 G01 F1000 X0 Y0 Z0\nG92 Z100\n#CS ON [50,50,0,0,0,0]\nG92 X100 Z200\nX1 Z1\n\
        #CS ON [20,20,0,0,0,0]\nG92 X200 Z400\nX2 Z2\n#CS OFF\n#CS OFF\nX0 Z0";
    // Z is no main axis where the channel has two
    let ends = |settings: &[&str]| -> Vec<[f64; 2]> {
        let text = format!("#PUT AX [Z]\n#CALL AX [Z,3,3]\n{text}");
        let wide = ["Z.kenngr.swe_pos=10000000"];
        let ends = without_errors(&[settings, &wide].concat(), &text).ends();
        ends.iter().map(|end| [end[0], end[2]]).collect()
    };
    assert_eq!(ends(&[]), [[151.0, 301.0], [372.0, 702.0], [0.0, 100.0]]);
    let channel = "channel.coordinate_system.axes_offsets_layer_specific=0";
    assert_eq!(ends(&[channel]), [[151.0, 201.0], [372.0, 402.0], [0.0, 400.0]]);
}

/// P-CHAN-00100: the length of a tool moves with the next absolute word, or with D.
#[test]
fn tool_offsets_move_at_once_where_the_list_says_so() {
    let text = "V.G.WZ[1].L=7\nV.G.WZ[1].V.Y=3\nG90 G01 F100 X1\nD1\nG91 X1\nG90 X5 D0";
    let ends = |settings: &[&str]| without_errors(settings, text).ends();
    assert_eq!(ends(&[]), [[1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [5.0, 0.0, 0.0]]);
    assert_eq!(
        ends(&["channel.move_tool_offsets_directly=1"]),
        [[1.0, 0.0, 0.0], [1.0, 3.0, 7.0], [2.0, 3.0, 7.0], [5.0, 0.0, 0.0]]
    );
    let arc = "V.G.WZ[1].L=7\nG90 G02 F100 X10 I5\nD1";
    let run = run_on(&["channel.move_tool_offsets_directly=1"], &format!("{arc}\nM30\n"));
    assert_eq!(run.ids(), ["K-0019"]);
}

/// 206811147: what is inserted behind a block with E has E as its feed.
#[test]
fn inserted_elements_have_the_end_feed_of_the_block_in_front() {
    let feeds = |text: &str| -> Vec<Feed> {
        without_errors(&[], &format!("G137 G90 G01 F6000 {text}"))
            .blocks()
            .iter()
            .map(|block| block.feed)
            .collect()
    };
    let (f, e) = (Feed::PathVelocity(100.0), Feed::PathVelocity(10.0));
    assert_eq!(feeds("X50 E600\nG302 I10\nY50"), [f, e, f]);
    assert_eq!(feeds("X50 E600\nG301 I10\nY50"), [f, e, f]);
    assert_eq!(feeds("X50 E600\n#RND=10\n#FRC=300\nY50 E1200")[1], e);
    let compensated = "\nV.G.WZ_AKT.R=10\nG26 G41 X10 Y0\nX50 E600\nY-50\nG40 X70";
    assert_eq!(feeds(compensated), [f, f, e, f, f]);
    // the E word of the block behind stays at its end
    let run = without_errors(&[], "G137 G90 G01 F6000 X50\nG302 I10\nY50 E600\nY60");
    let ends: Vec<_> = run.blocks().iter().map(|block| block.end_velocity_mm_s).collect();
    assert_eq!(ends, [None, None, Some(10.0), None]);
}

/// 206014219: the radius as a value.
#[test]
fn the_radius_is_a_value() {
    let run = clean("R1=5\nP2=R1\nP5=[[SIN[R1*6]+P2]/2]\nG01 F100 XP2 Y[R1+1] ZP5\nM30\n");
    assert_near(&run.end, &[5.0, 6.0, 2.75]);
    // in the unit that is active
    assert_near(&clean("G70 R1=1\nG71\nG01 F100 XR1\nM30\n").end, &[25.4, 0.0, 0.0]);
    assert_eq!(said("P2=R1"), ["K-0012"]);
    assert_near(&clean("G90 F100 G03 R1 = 5 X10\nM30\n").end, &[10.0, 0.0, 0.0]);
    // still a word of arcs
    assert_near(&clean("G90 G02 F100 X10 R1=5\nM30\n").end, &[10.0, 0.0, 0.0]);
}

/// Text and length of a macro (1097005579, 1152060811, 1147344395).
#[test]
fn texts_of_macros_are_values() {
    let run = run("\"A\" = \"X1 \\\"B\\\" Y2\"\n\"B\" = \"Z3\"\nV.P.T = MACRO_CONTENT[\"A\"]\n\
        P1 = MACRO_LENGTH[\"A\"]\n#MSG [\"%s %d\", V.P.T, P1]\nG01 F100 \"A\"\nM30\n");
    assert_eq!(run.messages(), ["X1 Z3 Y2 8"]);
    assert_near(&run.end, &[1.0, 2.0, 3.0]);
}

/// 208407691: blanks at the ends of names, and between a letter and its macro.
#[test]
fn blanks_around_macros_do_not_count() {
    let run =
        run("\" S1 \" = \" 5*2 \"\n\"S2\" = \"M \\\"S1\\\" \\\"S3 \\\"\"\n\"S3\" = \"X5 F1000\"\n\
        \" S2 \"\nG \"S4\"\nM30\n");
    let functions: Vec<_> = run
        .events()
        .into_iter()
        .filter_map(|event| match event {
            super::Event::MFunction { number, .. } => Some(*number),
            _ => None,
        })
        .collect();
    assert_eq!((functions, run.end[0]), (vec![10], 5.0));
}

/// 256490379: `#RND` in a motion is the corner at its end, as a block of its own that between its neighbours.
#[test]
fn roundings_in_a_motion_are_behind_it() {
    let ends = |text: &str| clean(&format!("G137 G90 G01 F1000 {text}\nM30\n")).ends();
    let own = ends("X50 Y0\nY50\n#RND=5\nX100");
    assert_eq!(ends("X50 Y0\nY50 #RND=5\nX100"), own);
    assert_eq!(own[1], [50.0, 45.0, 0.0]);
    assert_eq!(ends("X50\n#CHR=4\nY50"), ends("X50 #CHR=4\nY50"));
    assert_eq!(ends("X50\n#CHF=4\nY50"), ends("X50 #CHF=4\nY50"));
    // the page's first example: the corner is where the line of 30 degrees ends
    let text = "G18 Z15 X2\n#ANG=30 #RND=3 Z25\nZ40 X30";
    let of_page = ends(text);
    assert_eq!(of_page.len(), 4);
    let corner = 2.0 + 10.0 * libm::tan(30.0_f64.to_radians());
    // the tangents of a rounding are as long as its radius times the tangent of half the turn
    let turn = libm::atan((30.0 - corner) / 15.0) - 30.0_f64.to_radians();
    let before = 3.0 * libm::tan(turn / 2.0);
    let [x, _, z] = of_page[1][..] else { unreachable!() };
    let way = libm::hypot(x - corner, z - 25.0);
    assert!((way - before).abs() < 1e-9, "{way} {before}");
}

/// 206151179, 206157835: G98 and G99 count from the present limits under G91; positive above negative.
#[test]
fn software_limits_of_the_program() {
    let settings = ["X.kenngr.swe_neg=-1000000", "X.kenngr.swe_pos=1000000"];
    let ids = |text: &str| run_on(&settings, &format!("G90 G01 F1000\n{text}\nM30\n")).ids();
    assert_eq!(ids("G99 G91 X-10\nG90 X90"), [""; 0]);
    assert_eq!(ids("G99 G91 X-10\nG90 X90.1"), ["21897"]);
    assert_eq!(ids("G98 G91 X10\nG98 G91 X10\nG90 X-80"), [""; 0]);
    assert_eq!(ids("G98 G91 X10\nG98 G91 X10\nG90 X-80.1"), ["21897"]);
    // wider than the list, where P-CHAN-00498 does not forbid it
    assert_eq!(ids("G99 X200\nX150"), [""; 0]);
    let bounded = [settings[0], settings[1], "channel.range_check_prog_soft_limits=1"];
    let run = run_on(&bounded, "G90 G01 F1000\nG99 X200\nX100\nX100.1\nM30\n");
    assert_eq!(run.ids(), ["21650", "21897"]);
}

/// 207072907: `#SUPPRESS OFFSETS` leaves coordinate systems, rotation and mirroring in force.
#[test]
fn offsets_are_suppressed_within_systems() {
    let ends = |text: &str| clean(&format!("G90 G01 F1000 {text}\nM30\n")).ends();
    let last = |text: &str| ends(text).last().cloned().unwrap();
    let below = "V.G.NP[1].V.X=11\nG54\nG92 Y3\nX0 Y0\n";
    let (s, c) = (0.5, 0.75_f64.sqrt());
    // everything but the system, whose origin is at X10 Y20
    let system = format!("{below}#CS ON [10,20,0,0,0,30]\nG92 X100\n#SUPPRESS OFFSETS X5 Y0");
    assert_near(&last(&system), &[10.0 + 5.0 * c, 20.0 + 5.0 * s, 0.0]);
    // without the offsets G92 alone: the zero offset moves the system
    let additive =
        format!("{below}#CS ON [10,20,0,0,0,30]\nG92 X100\n#SUPPRESS OFFSETS [ADD_ZERO] X5 Y0");
    assert_near(&last(&additive), &[21.0 + 5.0 * c, 20.0 + 5.0 * s, 0.0]);
    // the program goes on with all offsets: X5 of the system lies 100 mm further
    let next = format!("{system}\nX5 Y0");
    assert_near(&last(&next), &[21.0 + 105.0 * c, 23.0 + 105.0 * s, 0.0]);
    // mirroring
    assert_near(
        &last("\nG351 X-1\nV.G.NP[1].V.X=11\nG54\n#SUPPRESS OFFSETS X5"),
        &[-5.0, 0.0, 0.0],
    );
    // one axis of a turned system moves along its own direction
    let one = "\n#ROTATION ON [ANGLE=30]\nG92 X50\n#SUPPRESS OFFSETS X5 Y7\n#SUPPRESS OFFSETS X6";
    assert_near(&last(one), &[6.0 * c - 7.0 * s, 6.0 * s + 7.0 * c, 0.0]);
}

/// M and H functions 286059787: with MVS_SVS the path waits for the spindle before the motion of the block, with MVS_SNS after it.
#[test]
fn the_path_waits_for_spindles_where_the_list_says_so() {
    let order = |settings: &[&str]| -> String {
        let run = without_errors(settings, "S1000 M3 G01 F1000 X100\nX0 M5");
        let mark = |step: &Step| match step {
            Step::Motion { .. } => 'X',
            Step::Sync { what: Sync::Spindle { .. }, .. } => 'S',
            Step::Sync { .. } => '-',
            Step::End { .. } => '.',
        };
        run.steps.iter().map(mark).collect()
    };
    assert_eq!(order(&[]), "XX.");
    assert_eq!(order(&["channel.spindel[0].m3_synch=MVS_SVS"]), "SXX.");
    assert_eq!(order(&["channel.spindel[0].m3_synch=MVS_SNS"]), "XSX.");
    assert_eq!(order(&["channel.spindel[0].m5_synch=MNS_SNS"]), "XXS.");
    assert_eq!(order(&["channel.spindel[0].m3_synch=MOS"]), "XX.");
}

/// The pages print no ID for a text of a macro beyond P-CHAN-00512, 80 characters by default: it runs with a warning.
#[test]
fn long_texts_of_macros_run() {
    let long = format!("X5 ({})", "a".repeat(80));
    let run = run(&format!("G01 F1000\n\"M\"=\"{long}\"\n\"M\"\nM30\n"));
    assert_eq!(run.ids(), ["K-0009"]);
    assert_near(run.ends().last().unwrap(), &[5.0, 0.0, 0.0]);
}
