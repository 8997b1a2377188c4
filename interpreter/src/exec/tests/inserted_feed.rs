//! The feed of what is inserted between two motions.

use super::{run, said};
use kontur_motion::block::Feed::{self, Duration, PathVelocity, Rapid, ShareOfMaximum};

fn feeds(text: &str) -> Vec<Feed> {
    run(&format!("{text}\nM30\n")).blocks().iter().map(|b| b.feed).collect()
}

fn rounded(head: &str, feed: &str, last: &str) -> Vec<Feed> {
    feeds(&format!("{head}\nG01 X20\nG302 I5 {feed}\n{last} Y20"))
}

/// TF5200 programming manual: `#FRC` in the unit of the F word.
#[test]
fn frc_counts_as_the_f_word_does() {
    let v = PathVelocity;
    assert_eq!(rounded("F600", "#FRC=300", "G01"), [v(10.0), v(5.0), v(10.0)]);
    // 0.5 mm/rev at 10 rev/s
    assert_eq!(rounded("M03 S600 G95 F1", "#FRC=0.5", "G01"), [v(10.0), v(5.0), v(10.0)]);
    let expected = [Duration(2.0), Duration(3.0), Duration(2.0)];
    assert_eq!(rounded("G93 F2", "#FRC=3", "G01"), expected);
    let expected = [0.1, 0.05, 0.1].map(ShareOfMaximum);
    assert_eq!(rounded("G194 F10", "#FRC=5", "G01"), expected);
    // also if the next motion is rapid
    assert_eq!(rounded("F600", "#FRC=300", "G00"), [v(10.0), v(5.0), Rapid]);
    assert_eq!(rounded("F600", "", "G00"), [v(10.0), Rapid, Rapid]);
    assert_eq!(said("F600\nG01 X20\nG302 I5 #FRC=0\nG01 Y20")[0], "K-0009");
}

/// G93: F is the time of the programmed motions; 20 mm in 2 s.
#[test]
fn an_inserted_element_has_no_time_of_its_own() {
    let v = PathVelocity(10.0);
    assert_eq!(rounded("G93 F2", "", "G01"), [Duration(2.0), v, Duration(2.0)]);
    let square = "V.G.WZ_AKT.R=1\nG26 G42 G01 F600 X10\nG93 F2\nY20\nX-10\nG94 G40 X0 Y-5";
    let around = feeds(square);
    assert_eq!(around[1..4], [Duration(2.0), v, Duration(2.0)]);
}

/// What compensation inserts, arcs and lines, has the feed of the motion before it, whatever follows.
#[test]
fn corners_of_compensation_keep_the_feed_in_front() {
    let around = |corners: &str, behind: &str| {
        feeds(&format!(
            "V.G.WZ_AKT.R=1\n{corners} G42 G01 F600 X10\nY20 F1200\n{behind} X-10\nG01 G40 X0 Y-5 F600"
        ))
    };
    for behind in ["F300", "G00", "G93 F7"] {
        let arc = around("G26", behind);
        assert_eq!(arc[1..3], [PathVelocity(20.0); 2], "{behind}");
        assert!(arc[3] != PathVelocity(20.0), "{behind}: {arc:?}");
    }
    // G93 before: 20 mm in 2 s, rapid after
    let text = "V.G.WZ_AKT.R=1\nG26 G42 G01 F600 X10\nG93 Y20 F2\nG00 X-10\nG01 G94 G40 X0 Y-5";
    assert_eq!(feeds(text)[1..4], [Duration(2.0), PathVelocity(10.0), Rapid]);
}
