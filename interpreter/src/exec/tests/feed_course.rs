//! Feed rates that change along a motion, against the formulas of the manual: G13 and G193 linear along the path, G293 linear
//! over time; G95 under G96 by the speed of the spindle.

use super::clean;
use kontur_motion::block::Feed;

/// Length, feed rate and end of each piece between two positions in X.
fn pieces(text: &str, from: f64, to: f64) -> Vec<(f64, f64, f64)> {
    let run = clean(text);
    let piece = |b: &&kontur_motion::block::Block| {
        let (a, z) = (b.path.start()[0], b.path.end()[0]);
        let Feed::PathVelocity(v) = b.feed else { panic!("{:?}", b.feed) };
        (a > from - 1e-9 && z < to + 1e-9 && z > a).then_some((z - a, v, z))
    };
    run.blocks().iter().filter_map(piece).collect()
}

/// The pieces follow `v` as a function of the distance from `from`, never faster and at most 1 % slower, and end at `to`.
fn follow(pieces: &[(f64, f64, f64)], from: f64, to: f64, v: impl Fn(f64) -> f64) {
    assert!(pieces.len() > 10);
    assert!((pieces.last().unwrap().2 - to).abs() < 1e-9);
    let mut begin = from;
    for (length, feed, end) in pieces {
        for x in [begin, end - 1e-9] {
            let exact = v(x - from);
            assert!(*feed <= exact + 1e-6, "{feed} above {exact} at {x}");
            assert!(*feed >= exact / 1.0101, "{feed} below {exact} at {x}");
        }
        assert!((end - length - begin).abs() < 1e-9, "a gap at {begin}");
        begin = *end;
    }
}

fn time(pieces: &[(f64, f64, f64)]) -> f64 {
    pieces.iter().map(|(length, v, _)| length / v).sum()
}

const CORNER: &str = "#SLOPE [TYPE=STEP]\nN10 G01 X10 F1000\nN20 #CORNER PARAM [DIST=10 UNIT=PERCENT FEED=50]\nN30 G13\nN40 X50\nN50 G12 Y10\nM30\n";

#[test]
fn the_feed_falls_in_front_of_a_corner() {
    let v = 1000.0 / 60.0;
    let all = pieces(CORNER, 10.0, 50.0);
    assert_eq!(all[0], (30.0, v, 40.0));
    follow(&all[1..], 40.0, 50.0, |s| v * (1.0 - 0.05 * s));
    assert!((all.last().unwrap().1 - 0.5 * v).abs() < 1e-9);
    // the integral of ds / v while v decreases to v/2 within 10 mm
    let exact = 10.0 / (0.5 * v) * std::f64::consts::LN_2;
    let whole = time(&all[1..]);
    assert!(whole >= exact && whole < 1.01 * exact, "{whole} {exact}");
    // the motions before G13 and after G12 are not divided
    let run = clean(CORNER);
    assert_eq!(run.blocks().len(), all.len() + 2);
    assert_eq!(run.end[..2], [50.0, 10.0]);
    // the older form and FWORD are equivalent
    for form in ["#SET CORNER PARAM [10, 1, 50]", "#CORNER PARAM [DIST=10 UNIT=FWORD FEED=500]"] {
        let same = CORNER.replace("#CORNER PARAM [DIST=10 UNIT=PERCENT FEED=50]", form);
        let same = pieces(&same, 10.0, 50.0);
        assert_eq!(same.len(), all.len(), "{form}");
        for (a, b) in same.iter().zip(&all) {
            assert!((a.0 - b.0).abs() < 1e-9 && (a.1 - b.1).abs() < 1e-9);
        }
    }
}

#[test]
fn a_motion_shorter_than_the_distance_begins_where_the_fall_has_come_to() {
    let v = 1000.0 / 60.0;
    let all = pieces(&CORNER.replace("X50", "X14"), 10.0, 14.0);
    // 4 mm before the corner the feed rate is 70 %
    follow(&all, 10.0, 14.0, |s| v * (0.7 - 0.05 * s));
}

/// With tool radius compensation the actual path applies: an inside corner is 5 mm nearer.
#[test]
fn the_distance_is_that_of_the_corrected_path() {
    let text = "#SLOPE [TYPE=STEP]\nV.G.WZ_AKT.R=5\nG01 X-10 Y0 F1000\n#CORNER PARAM [DIST=10 UNIT=PERCENT FEED=50]\nG41 X0\nG13\nX50\nG12 Y50\nG40 Y60\nM30\n";
    let v = 1000.0 / 60.0;
    let all = pieces(text, 0.0, 45.0);
    assert!((all[0].2 - 35.0).abs() < 1e-9, "{:?}", all[0]);
    follow(&all[1..], 35.0, 45.0, |s| v * (1.0 - 0.05 * s));
}

#[test]
fn the_feed_is_interpolated_over_path_and_time() {
    let text = "#SLOPE [TYPE=STEP]\nN10 G01 X50 F1000\nN20 G193 X90 F400\nN30 X100 F400\nM30\n";
    let (v, w): (f64, f64) = (1000.0 / 60.0, 400.0 / 60.0);
    for (text, exact) in [
        (text.to_owned(), 40.0 / (v - w) * libm::log(v / w)),
        (text.replace("G193", "G293"), 80.0 / (v + w)),
    ] {
        let all = pieces(&text, 50.0, 90.0);
        let over_path = text.contains("G193");
        follow(&all, 50.0, 90.0, |s| {
            let share = s / 40.0;
            if over_path { v + (w - v) * share } else { (v * v + (w * w - v * v) * share).sqrt() }
        });
        let whole = time(&all);
        assert!(whole >= exact && whole < 1.01 * exact, "{text}: {whole} {exact}");
    }
    // also increasing
    let up = text.replace("F400", "F2000");
    follow(&pieces(&up, 50.0, 90.0), 50.0, 90.0, |s| v * (1.0 + s / 40.0));
}

/// The unit of length has no effect on a path of rotary axes alone: F is in deg/min there, and so are E and the F word from
/// which G193 and G293 start.
#[test]
fn inches_do_not_scale_the_feed_of_rotary_axes() {
    let speeds = |unit: &str, axis: &str, rest: &str| {
        let text = format!("{unit}\n#SLOPE [TYPE=STEP]\nG91 G01 {axis}9 F600\n{rest}\nM30\n")
            .replace("AXIS", axis);
        let run = super::run_on(&["Z.kenngr.achs_typ=2"], &text);
        assert!(run.ids().is_empty(), "{:?}", run.ids());
        let of = |b: &&kontur_motion::block::Block| (b.feed, b.end_velocity_mm_s);
        run.blocks().iter().map(of).collect::<Vec<_>>()
    };
    for rest in ["G193 AXIS9 F300", "G293 AXIS9 F300", "AXIS9 E60"] {
        assert_eq!(speeds("G70", "Z", rest), speeds("G71", "Z", rest), "{rest}");
        // a linear axis moves 25.4 times as fast
        for ((inch, end), (mm, end_mm)) in
            speeds("G70", "X", rest).into_iter().zip(speeds("G71", "X", rest))
        {
            let (Feed::PathVelocity(inch), Feed::PathVelocity(mm)) = (inch, mm) else {
                panic!("{inch:?} {mm:?}")
            };
            assert!((inch - 25.4 * mm).abs() < 1e-9 * inch, "{rest}: {inch} {mm}");
            let ends = end.zip(end_mm).is_none_or(|(a, b)| (a - 25.4 * b).abs() < 1e-9 * a);
            assert!(ends && end.is_some() == end_mm.is_some(), "{rest}");
        }
    }
}

/// G95 under G96: along lines and arcs the feed rate is way times speed, n = v / (2 pi x), up to half a step of one percent;
/// the pieces join, and a rounding between two motions follows the speed as well.
#[test]
fn the_feed_per_revolution_follows_the_cutting_speed() {
    let head = "G18 G00 X40 Z0\nM3 G96 S100\nG95 F0.2\n";
    for motion in [
        "G01 X20 Z-5",
        "G91 G01 Z-5 X-25",
        "G02 X30 Z-10 R10",
        "G03 X30 Z-10 R10",
        "G02 X40 Z0 I-6 K8",
        "G01 X20 Z-5 #RND 2\nX20 Z-20",
        "G01 X20 Z-5 #CHR 2\nX20 Z-20",
        "G92 X10\nG01 X20 Z-5",
        "G351 X-1\nG01 X-20 Z-5",
        "X[SET_POSITION POS=30]\nG01 X20 Z-5",
    ] {
        let run = super::run_on(&["X.kenngr.achs_mode=0x41"], &format!("{head}{motion}\nM30\n"));
        assert!(run.ids().is_empty(), "{motion}: {:?}", run.ids());
        let blocks = &run.blocks()[1..];
        assert!(blocks.len() > 20, "{motion}: {}", blocks.len());
        let mut at = vec![0.0; blocks[0].path.start().len()];
        // the path does not contain the position that is set
        let shift = if motion.contains("POS=30") { -10.0 } else { 0.0 };
        for (i, block) in blocks.iter().enumerate() {
            let Feed::PathVelocity(v) = block.feed else { panic!("{:?}", block.feed) };
            for share in 0..=8 {
                block.path.position(block.path.length() * f64::from(share) / 8.0, &mut at);
                let rpm = 100_000.0 / (std::f64::consts::TAU * (at[0] + shift).abs());
                let ratio = v / (0.2 * rpm / 60.0);
                assert!((ratio - 1.0).abs() < 0.00501, "{motion}: {ratio} at {at:?}");
            }
            if let Some(next) = blocks.get(i + 1) {
                let (end, start) = (block.path.end(), next.path.start());
                assert!(end.iter().zip(start.iter()).all(|(a, b)| (a - b).abs() < 1e-9));
            }
        }
    }
}
