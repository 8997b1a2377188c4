//! Error IDs with their places, the syntax check, and the example programs of the language chapter.

use super::{assert_near, checked, clean, places, run, shown};

#[test]
fn smallest_programs_for_each_id() {
    for (text, expected) in [
        ("G01 X10", "20008 1:5"),
        ("F100 X10 Y20 X10", "20203 1:14"),
        ("G99999", "20107 1:1"),
        ("G7", "20131 1:1"),
        ("O100", "20191 1:1"),
        ("R3=5", "20402 1:1"),
        ("Q10 F100", "20200 1:1"),
        ("G01 X1 G00 F100", "20108 1:8"),
        ("G70 G71", "20118 1:5"),
        ("G54 G55", "20116 1:5"),
        ("G161 G162", "20127 1:6"),
        ("G162 G162", "20127 1:6"),
        ("G164 G165", "20128 1:6"),
        ("G301 I1 G302", "20130 1:9"),
        ("G115=3 G117", "20124 1:8"),
        ("G115=15", "20151 1:1"),
        ("G02 X5 I1 I2 F100", "20205 1:11"),
        ("G160=2", "20003 1:1"),
        ("#FOO", "20509 1:1"),
        ("#PUT AX [1]", "20797 1:10"),
        ("X[FOO]", "K-0019 1:3"),
        ("M70000", "K-0009 1:1"),
        ("G33 Z10 K1", "K-0019 1:1"),
        ("#CYL ON", "K-0019 1:1"),
        ("#JOG CONT", "K-0019 1:1"),
        ("#COMMENT BEGIN X1\n#COMMENT END", "20566 1:16"),
        ("#COMMENT BEGIN\nN1 #COMMENT END X1", "20569 2:17"),
        ("$FOR COUNT=1,2,1\n$ENDFOR", "20227 1:6"),
        ("#VIB GUARD [MODE=1 MODE=2]", "K-0007 1:20"),
        ("L SEQUENCE [NAME=a N10 N20]", "K-0019 1:1"),
        ("LL NOTHING", "K-0014 1:4"),
    ] {
        let found = places(&run(&format!("{text}\nM30\n")).diagnostics);
        assert_eq!(found.first().map(String::as_str), Some(expected), "{text}: {found:?}");
    }
}

#[test]
fn words_that_are_only_ignored_warn_once() {
    let run = run("G08 X1 F100\nG08 X2\n#TOOL DATA\n#LAH [1]\n#INIT V.E.\n#TLC ON\nM30\n");
    assert_eq!(run.ids(), ["K-0100"; 5]);
    assert_eq!(run.end[0], 2.0);
}

#[test]
fn the_dialect_guard() {
    let run = run("G17 G21 G90\nX10 F100\nG21 X5\nM30\n");
    assert_eq!(run.ids(), ["K-0101"]);
    assert_eq!(run.end[0], -5.0);
    assert!(clean("G71 G21\nM30\n").diagnostics.is_empty());
    for (text, id) in [("M98 P1=5", "K-0101"), ("G43 Z1 F100", "20131"), ("G28", "20131")] {
        assert_eq!(super::run(&format!("{text}\nM30\n")).ids()[0], id, "{text}");
    }
}

#[test]
fn the_check_reports_ten_mistakes_in_one_run() {
    let text = "G01 X10\nF100\nG7\n#FOO\nX1 X2\nP1=P2\nG02 X9 I5 R5\nLL NO\n#VIB GUARD ON [MODE=9]\nG70 G71\nR3=5\nG01 X1\nM30\n";
    let found = places(&checked(text));
    let expected = [
        "20008 1:5",
        "20131 3:1",
        "20509 4:1",
        "20203 5:4",
        "K-0012 6:4",
        "21024 7:11",
        "K-0014 8:4",
        "22062 9:16",
        "20118 10:5",
        "20402 11:1",
    ];
    assert_eq!(found, expected);
}

#[test]
fn the_check_stops_after_twenty_errors() {
    let text: Vec<String> = (0..40).map(|i| format!("N{i} #FOO")).collect();
    let text = text.join("\n");
    let found = checked(&text);
    assert_eq!(found.iter().filter(|d| d.is_error()).count(), 20);
    assert_eq!(found.last().map(|d| d.id.to_string()).as_deref(), Some("K-0116"));
}

#[test]
fn the_check_moves_nothing_and_ends() {
    assert!(checked("P1=0\n$WHILE P1<3\nP1=P1+1\nX P1 F100\n$ENDWHILE\n#TIME 5\nM30\n").is_empty());
    // a condition with a fault counts as false
    assert_eq!(
        places(&checked("$WHILE P9\nX1\n$ENDWHILE\n$DO\n$ENDDO P9\nM30\n")),
        ["K-0012 1:8", "K-0012 5:8"]
    );
}

#[test]
fn an_error_stops_before_its_block_moves() {
    let run = run("G01 X1 F100\nX2 G7\nX3\nM30\n");
    assert_eq!(run.ends(), [[1.0, 0.0, 0.0]]);
    assert_eq!(run.reason(), super::EndReason::Aborted);
}

#[test]
fn many_brackets_and_long_expressions() {
    let deep = format!("X{}1{} F100\nM30\n", "[".repeat(10_000), "]".repeat(10_000));
    assert_eq!(run(&deep).reason(), super::EndReason::Aborted);
    let long = format!("P1=1{}\nM30\n", "+1".repeat(1900));
    let run = run(&long);
    assert!(
        run.diagnostics.is_empty() || run.reason() == super::EndReason::Aborted,
        "{:?}",
        shown(&run.diagnostics)
    );
}

/// The program of the language chapter that uses most words.
#[test]
fn squares() {
    let text = include_str!("../../../tests/data/squares.nc");
    let run = run(text);
    let bad: Vec<_> = run.diagnostics.iter().filter(|d| d.is_error()).collect();
    assert!(bad.is_empty(), "{bad:?}");
    assert_near(&run.end, &[0.0, 0.0, 5.0]);
    let ends = run.ends();
    // per pass: Z0, (0,20), (20,20), (20,0), (0,0) on the arc
    let pass: Vec<&Vec<f64>> = ends[1..6].iter().collect();
    assert_near(pass[0], &[0.0, 0.0, 0.0]);
    assert_near(pass[1], &[0.0, 20.0, 0.0]);
    assert_near(pass[2], &[20.0, 20.0, 0.0]);
    assert_near(pass[3], &[20.0, 0.0, 0.0]);
    assert_near(pass[4], &[0.0, 0.0, 0.0]);
    let length = run.blocks()[5].path.length();
    assert!((length - 21.891830).abs() < 1e-6);
    assert_eq!(
        run.messages(),
        [
            "run 1 of 3, F = 1000.000000",
            "run 2 of 3, F = 2000.000000",
            "run 3 of 3, F = 3000.000000"
        ]
    );
}

#[test]
fn what_does_not_run_is_checked_for_its_syntax() {
    // block numbers and control statements as errors, the rest as warnings; #IF and #COMMENT are left alone
    let text = "$IF 0\nX!\n$IF (\nX1\n$ENDIF\n$ELSE\nX1 F100\n$ENDIF\n$FOR P1=2,1,1\nG01 X[1\n$ENDFOR\n$SWITCH 1\n$CASE 2\n#VAR\nV.P.A : UNS32 = 5\n V.P.B :: 4\n#ENDVAR\n$ENDSWITCH\n$GOTO N7\nY?\nN7: X2\n#IF 0\nX!\n#ENDIF\n#COMMENT BEGIN\nX!\n#COMMENT END\nM30\nX!\n";
    let found = checked(text);
    let lines: Vec<_> = found
        .iter()
        .map(|d| (d.id.to_string(), d.source.as_ref().map_or(0, |s| s.line), d.is_error()))
        .collect();
    let mut unreached: Vec<_> =
        lines.iter().filter(|(id, _, _)| id == "K-0118").map(|(_, l, _)| *l).collect();
    unreached.dedup();
    assert_eq!(unreached, [2, 10, 16, 20], "{lines:?}");
    assert!(
        lines.iter().any(|(id, line, error)| id != "K-0118" && *line == 3 && *error),
        "{lines:?}"
    );
    assert_eq!(lines.iter().filter(|(_, _, error)| *error).count(), 1, "{lines:?}");
    // a subroutine that nobody calls
    let found = checked("%L A\nX!\n%MAIN\nX1 F100\nM30\n");
    assert!(places(&found)[0].starts_with("K-0118 2:") && !found.iter().any(|d| d.is_error()));
    // taken in one pass, left out in another: looked at once
    let text = "$FOR P1=1,2,1\n$IF P1==1\nX P1 F100\n$ELSE\nY1\n$ENDIF\n$ENDFOR\nM30\n";
    assert!(checked(text).is_empty());
}
