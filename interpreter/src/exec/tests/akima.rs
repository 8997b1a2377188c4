//! Akima splines.

use super::{assert_near, clean};
use kontur_motion::block::Block;

const SPLINE: &str =
    "G01 X20 Y0 F1000\n#AKIMA TRANS[START=USER END=AUTO]\n#AKIMA STARTVECTOR X1 Y1 Z0\n";
const POINTS: &str = "G01 X40 Y20\nX60\nY0\nX80\nY10\n";

/// Direction of a block at one of its ends.
fn direction(block: &Block, end: bool) -> Vec<f64> {
    let mut direction = block.path.start().clone();
    block.path.tangent(if end { block.path.length() } else { 0.0 }, &mut direction);
    direction.to_vec()
}

fn unit(v: [f64; 2]) -> [f64; 2] {
    let length = libm::hypot(v[0], v[1]);
    [v[0] / length, v[1] / length]
}

/// The first program of the page (1255466635): the curve passes through its points, with slope 1 at the start, and with the
/// derivatives computed from the chords in between.
#[test]
fn the_example_with_a_start_tangent() {
    let run = clean(&format!("{SPLINE}G151\n{POINTS}G150\nX70\nM30\n"));
    let blocks = run.blocks();
    let ends = run.ends();
    let expected = [
        [20.0, 0.0],
        [40.0, 20.0],
        [60.0, 20.0],
        [60.0, 0.0],
        [80.0, 0.0],
        [80.0, 10.0],
        [70.0, 10.0],
    ];
    assert_eq!(ends.len(), expected.len());
    for (end, want) in ends.iter().zip(expected) {
        assert_near(&end[..2], &want);
    }
    let straight: Vec<bool> = blocks.iter().map(|b| b.path.is_straight()).collect();
    assert_eq!(straight, [true, false, false, false, false, false, true]);
    assert_near(&direction(blocks[1], false)[..2], &[0.5_f64.sqrt(); 2]);
    // no corner between the blocks of the spline
    for pair in blocks[1..6].windows(2) {
        assert_near(&direction(pair[0], true), &direction(pair[1], false));
    }
    // chords (h, h), (1, 0), (0, -1), (1, 0), (0, 1) with h = 1 / sqrt 2: at (60, 20) the weights of X are |1 - 0| and 1 - h,
    // those of Y |0 + 1| and h
    let h = 0.5_f64.sqrt();
    let at_60_20 = unit([1.0 / (2.0 - h), -h / (1.0 + h)]);
    assert_near(&direction(blocks[2], true)[..2], &at_60_20);
    // at (60, 0): X from (0, -1) and (1, 0) between (1, 0) and (0, 1): both weights 1; Y likewise
    assert_near(&direction(blocks[3], true)[..2], &unit([0.5, -0.5]));
    // the end: the chord after (1, 0), (0, 1) is extrapolated to (-1, 2) and (-2, 3); all of them change alike
    assert_near(&direction(blocks[5], true)[..2], &unit([-0.5, 1.5]));
    // the alternative commands
    for words in [("#SPLINE ON\n", "#SPLINE OFF\n"), ("#SPLINE TYPE AKIMA\nG151 ", "G150 ")] {
        let other = clean(&format!("{SPLINE}{}{POINTS}{}X70\nM30\n", words.0, words.1));
        assert_eq!(other.ends(), ends);
        assert_eq!(direction(other.blocks()[3], true), direction(blocks[3], true));
    }
}

/// TANGENTIAL uses the directions of the motions before and after; an arc between points always does.
#[test]
fn tangential_transitions() {
    let text = |ends: &str| {
        format!(
            "F1000\n#AKIMA TRANS [{ends}]\nX10\nG151\nX20 Y10\nX30 Y20\nX50 Y20\nG150\nX50 Y0\nM30\n"
        )
    };
    let both = clean(&text("START=TANGENTIAL END=TANGENTIAL"));
    let blocks = both.blocks();
    assert_near(&direction(blocks[1], false), &[1.0, 0.0, 0.0]);
    assert_near(&direction(blocks[3], true), &[0.0, -1.0, 0.0]);
    let none = clean(&text("START=AUTO"));
    assert!((direction(none.blocks()[1], false)[1] - 0.5).abs() < 0.3);
    // an end tangent of the program
    let user = clean(
        "F1000\n#AKIMA TRANS [END=USER]\n#AKIMA ENDVECTOR X-1\nX10\nG151\nX20 Y10\nX30 Y20\nX50 Y20\nG150\nM30\n",
    );
    assert!(direction(user.blocks()[3], true)[0] < 0.0);
    let arc = clean(
        "F1000\nG151\nX10 Y0\nX20 Y5\nG02 X30 Y-5 I0 J-10\nG01 X35 Y-20\nX40 Y-20\nG150\nM30\n",
    );
    let blocks = arc.blocks();
    assert_near(&direction(blocks[1], true), &direction(blocks[2], false));
    assert_near(&direction(blocks[2], true), &direction(blocks[3], false));
    // also where the arc is the first motion, or several follow each other
    let arcs = clean(
        "F1000\nG151\nG02 X10 Y-10 I0 J-10\nG02 X0 Y-20 I-10\nG01 X-12 Y-20\nX-20 Y-25\nG150\nM30\n",
    );
    assert_near(&direction(arcs.blocks()[2], false), &[-1.0, 0.0, 0.0]);
}
