//! Positions into variables, and what the diagnosis manual prints about them.

use super::{Sync, clean, said};

/// The manual's example: the positions drive the axes again.
#[test]
fn command_positions_into_variables() {
    let run = clean(
        "X10 Y20 Z30 F100\n#VAR\nV.P.POS1=0\n#ENDVAR\n#GET CMDPOS [P1 = X, P2 = Y, V.P.POS1 = Z]\n\
         X0 Y0 Z0\nG01 XP1 YP2\nG01 ZV.P.POS1\nM30\n",
    );
    assert_eq!(run.syncs(), [&Sync::FlushWait]);
    assert_eq!(run.end, [10.0, 20.0, 30.0]);
    let run = clean("X10 F100\n#SET IPO SOLLPOS [P1=X]\nY[P1+1]\nM30\n");
    assert_eq!(run.end, [10.0, 11.0, 0.0]);
    // of the axis, in the unit of the program: 25.4 mm are one inch, an offset does not count
    let run = clean("V.G.NP[1].V.X=5\nX20.4 F100 G54\nG70\n#GET CMDPOS [P1=X]\nG71 Y[P1]\nM30\n");
    assert_eq!(run.end, [25.4, 1.0, 0.0]);
}

/// Actual positions: the path rests before the block.
#[test]
fn actual_positions_into_variables() {
    let run = clean("X3 F100\n#GET ACTPOS [P1=X]\nY[P1]\nM30\n");
    assert_eq!(run.syncs(), [&Sync::ReadActual]);
    assert_eq!(run.end, [3.0, 3.0, 0.0]);
}

/// The wrong forms that the diagnosis manual prints (20186), and an axis that does not exist.
#[test]
fn wrong_requests() {
    for (text, id) in [
        ("#GET CMDPOS [V.L.POS1 X]", "20186"),
        ("#GET CMDPOS [X]", "20186"),
        ("#GET CMDPOS", "20186"),
        ("#GET ACTPOS []", "20186"),
        ("#GET CMDPOS [P1=Q]", "20797"),
    ] {
        let found = said(text);
        assert!(found.iter().any(|f| f == id), "{text}: {found:?}");
    }
    let many: Vec<String> = (1..=33).map(|i| format!("P{i}=X")).collect();
    assert_eq!(said(&format!("#GET CMDPOS [{}]", many.join(", "))), ["20500"]);
}

#[test]
fn wrong_main_spindles() {
    for text in ["#MAIN SPINDLE [S2, S]", "#MAIN SPINDLE 2"] {
        assert_eq!(said(text), ["21220"], "{text}");
    }
    for text in ["#MAIN SPINDLE [S7]", "#MAIN SPINDLE [7]"] {
        assert_eq!(said(text), ["21306"], "{text}");
    }
}
