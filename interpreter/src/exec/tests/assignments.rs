//! `+=`, `-=`, `*=`, `/=`, and zero offsets of all axes at once.

use super::{checked, clean, ids, run};

/// End position of a program of rapid motions.
#[track_caller]
fn assert_end(text: &str, expected: [f64; 3]) {
    super::assert_end(&format!("G00\n{text}"), expected);
}

#[test]
fn a_value_is_changed_by_what_stands_on_the_right() {
    // the right side is worked out first: 3 * (1 + 1), not 3 * 1 + 1
    assert_end(
        "P1=3\nP1 += 2\nP2=P1\nP1*=1+1\nP3=P1\nP1-=4 P1 /= 3\nXP1 YP2 ZP3",
        [2.0, 5.0, 10.0],
    );
    assert_end(
        "#VAR\nV.L.T[2]=[1,2]\nV.P.N : UNS08 = 7\n#ENDVAR\nV.L.T[1]+=0.5\nV.P.N-=5\nXV.L.T[1] YV.P.N",
        [2.5, 2.0, 0.0],
    );
    let said = clean(
        "#VAR\nV.P.S : STRING[20] = \"one\"\n#ENDVAR\nV.P.S += \" two\"\n#MSG [\"%s\", V.P.S]\nM30\n",
    );
    assert_eq!(said.messages(), ["one two"]);
}

#[test]
fn a_division_by_zero_has_its_own_number() {
    // within the right side it is that of expressions
    assert_eq!(run("P1=3 P2=0\nP1 /= 1/P2\nM30\n").ids(), ["20396"]);
    assert_eq!(run("P1=3 P2=0\nP1 += 1/P2\nM30\n").ids(), ["20396"]);
}

#[test]
fn what_does_not_exist_is_not_changed() {
    for text in ["P7 += 1\nM30\n", "V.P.NEW += 1\nM30\n", "V.G.T_AKT += 1\nM30\n"] {
        assert!(!run(text).diagnostics.is_empty(), "{text}");
        assert_eq!(ids(&checked(text)).is_empty(), run(text).ids().is_empty(), "{text}");
    }
    assert!(!run("X += 1\nM30\n").diagnostics.is_empty());
    assert!(!run("P1 =+ = 1\nM30\n").diagnostics.is_empty());
}

#[test]
fn the_current_offset_holds_until_another_group_is_selected() {
    let text = "V.G.NP[1].V.X=10\nG54\nV.G.NP_AKT.V.X=200\nX1\n";
    assert_end(text, [201.0, 0.0, 0.0]);
    // the table keeps its value
    assert_end(&format!("{text}G53 X0\nG54 X1"), [11.0, 0.0, 0.0]);
    assert_end(
        &format!("{text}P1=V.G.NP[1].V.X P2=V.G.NP_AKT.V.X\nG53 XP1 YP2"),
        [10.0, 200.0, 0.0],
    );
    // machine coordinates put it aside
    assert_end(&format!("{text}#MCS ON\nX5\n#MCS OFF"), [5.0, 0.0, 0.0]);
    assert_end(&format!("{text}#MCS ON\nX5\n#MCS OFF\nX2"), [202.0, 0.0, 0.0]);
    // in inches
    assert_end("G70\nV.G.NP_AKT.V.X=1\nG71 X0", [25.4, 0.0, 0.0]);
}

#[test]
fn offsets_of_all_axes_are_set_at_once() {
    let text = "V.G.NP[1].V.X=1 V.G.NP[1].V.Y=2 V.G.NP[1].V.Z=3\nV.G.NP[2].ALL=V.G.NP[1].ALL*10\n";
    assert_end(&format!("{text}G55 X0 Y0 Z0"), [10.0, 20.0, 30.0]);
    assert_end(
        &format!("{text}G54\nV.G.NP_AKT.ALL += V.G.NP[2].ALL - 1\nX0 Y0 Z0"),
        [10.0, 21.0, 32.0],
    );
    assert_end(&format!("{text}V.G.NP[3].ALL = 4\nG56 X0 Y0 Z0"), [4.0, 4.0, 4.0]);
    // ALL is not a separate value
    assert!(!run("P1=V.G.NP[1].ALL\nM30\n").diagnostics.is_empty());
}
