//! Error IDs with their places, the syntax check, and the example programs of the language chapter.

use super::{assert_near, checked, clean, places, run, said};

#[test]
fn words_that_are_only_ignored_warn_once() {
    let run = run("G08 X1 F100\nG08 X2\n#EXPL SYN\n#SCENE ON\n#CACHE CLEAR\nM30\n");
    assert_eq!(run.ids(), ["K-0100"; 4]);
    assert_eq!(run.end[0], 2.0);
}

/// A fraction where a whole number is expected is refused, not rounded silently; calculated numbers may be off by rounding.
#[test]
fn fractions_of_whole_numbers_are_refused() {
    for (text, id) in [
        ("#SIGNAL [ID=1.5]", "K-0009"),
        ("#WAIT [ID=1.5]", "K-0009"),
        ("P[1.5]=3", "20400"),
        ("P1=1.5\nPP1=3", "20400"),
        ("T1.5", "K-0009"),
        ("D1.5", "K-0009"),
        ("M[3.5]", "K-0009"),
        ("H[3.5]", "K-0009"),
        ("G159=1.5", "20582"),
        ("G160=1.5 X1", "20583"),
        ("#CS DEF[1.5][0,0,0,0,0,0]", "20820"),
        ("#TIMER START [ID=1.5]", "21167"),
        ("#ERROR [ID=1.5 RC=0]", "21296"),
        ("#ERROR [ID=5 RC=1.5]", "K-0009"),
        ("#FILTER ON [ORDER=3.5]", "K-0033"),
        ("#HSC ON [OPMODE=1.5]", "K-0009"),
        ("#CALL AX [X,1,0.5]", "K-0009"),
        ("#CONTOUR MODE [DEV CHECK_JERK=1.5]", "21296"),
        ("#SLOPE [TYPE=TRAPEZ NO_OPT=0.5]", "21296"),
        ("#TURN [THREAD_CHAIN=0.5]", "21296"),
    ] {
        assert_eq!(said(text), [id], "{text}");
    }
    for text in [
        "G115=1.5",
        "V.G.WZ[1.5].R=3",
        "V.G.NP[1.5].V.X=3",
        "P1=V.G.TIMER[1.5]",
        "#CALL AX [X,1.5,0]",
        "#SET SLOPE PROFIL[1.5]",
        "#VAR\nV.P.A[2.5]\n#ENDVAR",
        "#VAR\nV.P.A[3]=[1,2,3]\n#ENDVAR\nV.P.A[1.5]=3",
        "#VAR\nV.P.A : STRING[2.5]=\"ab\"\n#ENDVAR",
    ] {
        let run = super::run(&format!("{text}\nM30\n"));
        assert!(run.diagnostics.iter().any(crate::diag::Diagnostic::is_error), "{text}");
    }
    // 0.1 * 30 is not 3 in the last bit; a block number is rounded by the control
    clean("P[0.1*30]=3\nT[0.1*30]\nN[1.5] X1 F100\nM30\n");
}

/// A variable of whole numbers that gets a fraction: rounded, and said once for each variable.
#[test]
fn whole_number_variables_say_that_they_round() {
    let run = run(
        "#VAR\nV.P.A : UNS32 = 2.5\nV.P.B : SGN16\nV.P.C = 2.5\n#ENDVAR\nV.P.B=-1.5\nV.P.B=7/2\nV.P.B=4\nX V.P.A F100\nM30\n",
    );
    assert_eq!(run.ids(), ["K-0109"; 2]);
    assert_eq!(run.end[0], 3.0);
}

/// `#TOOL DATA` is the D word, `#TOOL PREP` the T word; `#TOOL REFRESH` takes what was written to the tool in use.
#[test]
fn tools_by_their_id() {
    let run = run(
        "V.G.WZ[5].L=12\n#TOOL PREP [5, , 0]\n#TOOL DATA [5]\nZ0 F100\n#TOOL REFRESH\nZ0\nM30\n",
    );
    assert_eq!(run.ids(), [""; 0]);
    assert_eq!(run.end[2], 12.0);
    for text in ["#TOOL DATA [5, 1]", "#TOOL PREP [5, \"SISTER\"]"] {
        assert_eq!(said(text), ["K-0019"], "{text}");
    }
    for text in ["#TOOL DATA", "#TOOL DATA []", "#TOOL REFRESH [1]x"] {
        assert!(!said(text).is_empty(), "{text}");
    }
}

/// What the manual knows and nothing here carries out is not supported, never unknown.
#[test]
fn what_the_manual_knows_is_never_unknown() {
    for text in [
        "#CS DEF ACT [1]",
        "#INFO",
        "#GANTRY ON ALL",
        "#RT CYCLE [ID=1]",
        "#MEAS PREPARE",
        "#MEAS [AX=X EDGE=POS]",
        "#SPLINE TYPE BSPLINE",
        "#SET SPLINETYPE BSPLINE",
        "#TOOL LIFE READ",
        "#SET TIP [1.0, 1.5, 2.0] X",
        "#RT WHILE",
        "#VOLCOMP ON",
        "Z[OSC ON ZERO_POS=1 EXCUR=2 FEED=100 SHORT]",
        "X[LIFT 1]",
        "X[MC_MoveAbsolute Position=5]",
        "S[SYNC]",
        "S[G131=50]",
        "S[CALLAX]",
        "G236",
    ] {
        assert_eq!(said(text), ["K-0019"], "{text}");
    }
    assert_eq!(super::run("G74 X1 Y2 S1\nX5 F100\nM30\n").ids(), ["K-0111"]);
    clean("S[G167 REV1000 M3]\nS[M5]\nM30\n");
}

/// What may change path, position, speed or spindle is refused, or the message says what happens in its place.
#[test]
fn what_may_change_the_motion_is_not_ignored() {
    for text in [
        "#LAH [1]",
        "#FF ON",
        "#INIT V.E.",
        "#DRIVE [AX=X]",
        "#IDENT WR SYN [AX=X]",
        "#COMMAND WR SYN [AX=X]",
        "G112 X4 Y8",
        "G112 S2",
        "G141",
    ] {
        assert_eq!(said(text), ["K-0019"], "{text}");
    }
    for text in ["G66", "G115=3", "G333 X80", "G334=80"] {
        assert_eq!(said(text), ["K-0111"], "{text}");
    }
}

#[test]
fn the_dialect_guard() {
    let run = run("G17 G21 G90\nX10 F100\nG21 X5\nM30\n");
    assert_eq!(run.ids(), ["K-0101"]);
    assert_eq!(run.end[0], -5.0);
    assert!(clean("G71 G21\nM30\n").diagnostics.is_empty());
    for text in ["M104 S200\nG28", "M190 S60\nX1 F100\nG29", "G92 E0"] {
        assert_eq!(said(text), ["K-0120"], "{text}");
    }
    // a spindle speed beside an M function of the machine
    assert!(clean("M104 S200\nG01 X1 F100\nM30\n").diagnostics.is_empty());
}

/// What a macro makes of a block is said of that block, not of the one before it.
#[test]
fn a_macro_that_cannot_be_used_names_its_block() {
    let found = run("N10 \"A\" = \"COS[\"\nN20 X\"A\" F100\nM30\n").diagnostics;
    assert_eq!(places(&found), ["K-0121 2:6"]);
    assert_eq!(found[0].source.as_ref().and_then(|at| at.block), Some(20));
}

#[test]
fn the_check_stops_after_twenty_errors() {
    let text: Vec<String> = (0..40).map(|i| format!("N{i} #FOO")).collect();
    let text = text.join("\n");
    let found = checked(&text);
    assert_eq!(found.iter().filter(|d| d.is_error()).count(), 20);
    assert_eq!(found.last().map(|d| d.id.to_string()).as_deref(), Some("K-0116"));
}

/// Looking for the command that was meant took 20 us in each of half a million passes.
#[test]
fn the_check_stops_where_a_loop_repeats_an_error() {
    let found = checked("$WHILE 1\n#FOO\n$ENDWHILE\nM30\n");
    assert_eq!(places(&found)[0].split(' ').next_back(), Some("2:1"));
    assert_eq!(found.len(), 2);
    assert!(found[1].text.contains("10000 times"), "{}", found[1].text);
    // a warning may come as often as the program wants it
    let warned = "P1=0\n$WHILE P1<20000\nP1=P1+1\nG301 I1\n$ENDWHILE\n#FOO\nM30\n";
    assert_eq!(checked(warned).len(), 2);
}

#[test]
fn the_check_moves_nothing_and_ends() {
    assert!(checked("P1=0\n$WHILE P1<3\nP1=P1+1\nX P1 F100\n$ENDWHILE\n#TIME 5\nM30\n").is_empty());
    // a condition with a fault counts as false
    assert_eq!(
        places(&checked("$WHILE P9\nX1\n$ENDWHILE\n$DO\n$ENDDO P9\nM30\n")),
        ["20925 1:8", "20925 5:8"]
    );
}

#[test]
fn an_error_stops_before_its_block_moves() {
    let run = run("G01 X1 F100\nX2 G7\nX3\nM30\n");
    assert_eq!(run.ends(), [[1.0, 0.0, 0.0]]);
    assert_eq!(run.reason(), super::EndReason::Aborted);
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
    assert!(places(&found)[0].starts_with("K-0118 2:") && found.iter().all(|d| !d.is_error()));
    // taken in one pass, left out in another: looked at once
    let text = "$FOR P1=1,2,1\n$IF P1==1\nX P1 F100\n$ELSE\nY1\n$ENDIF\n$ENDFOR\nM30\n";
    assert!(checked(text).is_empty());
}

/// Access rights of external variables: 20097 and 20100.
#[test]
fn external_variables_keep_their_rights() {
    use crate::exec::{Access, External, Options, Value};
    let variable = |access| External { value: Value::Number(2.0), access };
    let external = [("R", Access::ReadOnly), ("W", Access::WriteOnly), ("B", Access::ReadWrite)];
    let external = external.map(|(name, access)| (name.to_owned(), variable(access)));
    let places = |text: &str| {
        let options = Options { external: external.clone().into(), ..Options::default() };
        let sources = crate::source::MemorySources::new().with("main.nc", text.to_owned());
        places(&super::run_with(sources, super::machine(&[]), options).diagnostics)
    };
    assert_eq!(places("V.E.W=1\nV.E.B=V.E.R\nX V.E.B F100\nM30\n"), [""; 0]);
    assert_eq!(places("X V.E.W F100\nM30\n"), ["20097 1:3"]);
    assert_eq!(places("V.E.R=1\nM30\n"), ["20100 1:1"]);
}

/// A number written to its key at once, as the manual writes interim points.
#[test]
fn keys_with_their_numbers() {
    let point = |text: &str| {
        let run = clean(&format!("#CONTOUR MODE [POS {text}]\nG61 X10 F100\nY10\nM30\n"));
        let mode = run.blocks()[0].contour.map(|c| c.mode);
        format!("{mode:?}")
    };
    assert!(point("X9.7 Y.3").contains("9.7"));
    for text in ["X9.7 Y0.3", "X9.7 Y=0.3", "X 9.7 Y 0.3"] {
        assert_eq!(point(text), point("X=9.7 Y=0.3"), "{text}");
    }
    assert_eq!(run("#CONTOUR MODE [POS Q9.7]\nM30\n").ids(), ["21220"]);
    let unit = |text: &str| clean(&format!("{text}\nG61 X10 F100\nM30\n")).blocks()[0].contour;
    assert_eq!(unit("#CONTOUR MODE [DEV PATH_DEV0.5]"), unit("#CONTOUR MODE [DEV PATH_DEV=0.5]"));
}

/// It would be an arc, if it had an end.
#[test]
fn a_radius_without_an_end_point_is_told() {
    let kept = run("G02 F100 R5\nX10\nM30\n");
    assert_eq!(places(&kept.diagnostics), ["K-0109 1:10"]);
    assert_near(&kept.end, &[10.0, 0.0, 0.0]);
    assert!(matches!(kept.blocks()[0].path, kontur_motion::path::Path::Arc(_)));
}

/// Definitions of axis couplings move nothing and are checked as 20461, 20475 to 20477, 21077, 21110 and 21111 print it.
#[test]
fn definitions_of_couplings_are_checked() {
    for text in [
        "#SET AX LINK [1, Y=X, Z=X]",
        "#SET AX LINK [1, [Y = X, G, 0.01, 0.25]]",
        "#AX LINK [2, [Y = X, -1, 1], Z=X]",
        "#AX LINK [3, [Y = X, 2, -2], [Z=X, 5, 5]]",
        "#AX LINK NBR [2, 2 = 1, 3 = 1]",
        "#AX LINK NBR [2,[2 = 1,G]]",
        "#AX LINK OFF",
        "#AX LINK OFF ALL",
        "#DISABLE AX LINK [1]",
    ] {
        super::clean(&format!("{text}\nM30\n"));
    }
    for (text, id) in [
        ("[1, Z=X, Z=Y, Y=X]", "20476"),
        ("[1, Y=X, Z=Y]", "20477"),
        ("[1, Z=Y, Y=X]", "20477"),
        ("[1, Y=Q]", "20797"),
        ("[1, [Y=X, 1, 0]]", "21111"),
        ("[1, [Y=X, -1, 2]]", "21111"),
        ("[1, [Y=X, 3, 2]]", "21111"),
        ("[0, Y=X]", "20461"),
        ("[65536, Y=X]", "20461"),
        ("[1]", "21220"),
        ("[1, 5]", "21220"),
        ("", "21220"),
    ] {
        assert_eq!(said(&format!("#SET AX LINK {text}")), [id], "{text}");
    }
    for (text, id) in [
        ("[1, Y=X]", "21220"),
        ("[1, 2=2]", "20475"),
        ("[1, 2=1, 2=3]", "20476"),
        ("[1, 9=1]", "20312"),
        ("[1, 2=1.5]", "20312"),
    ] {
        assert_eq!(said(&format!("#AX LINK NBR {text}")), [id], "{text}");
    }
}

/// What a command would not look at is no part of it: a second bracket was dropped with everything in it.
#[test]
fn brackets_and_values_that_a_command_does_not_take() {
    for text in [
        "#VIB GUARD ON [MODE=2] [FREQ=30]",
        "#VIB GUARD ON 2",
        "#ROTATION ON [ANGLE=30] [CENTER1=5]",
        "#ROTATION ON 30",
        "#HSC ON [BSPLINE] [PATH_DEV=0.1]",
        "#CONTOUR MODE [DEV] [PATH_DEV=0.1]",
        "#SLOPE [TYPE=TRAPEZ] [TYPE=STEP]",
        "#OVERRIDE [FEED_FACT=50] [RAPID_FACT=3]",
        "#VECTOR LIMIT ON [VEL=100] [ACC=3]",
        "#FILTER ON [HSC] [ORDER=2]",
        "#FGROUP [X] [Y]",
        "#MEAS [TYPE=1] [ERR_NO_SIGNAL=0]",
        "#MCS ON [EX TOOL]",
        "#FLUSH WAIT [1]",
        "#SPLINE ON [1]",
        "#TANGFEED 3",
    ] {
        assert_eq!(said(text).first().map(String::as_str), Some("21220"), "{text}");
    }
    for text in [
        "#CALL AX FAST [X,1,0][Y,2,1]",
        "#CS ON [1][1,2,3,0,0,0]\n#CS OFF",
        "#TIME 0.1",
        "#TIME [0.1]",
        "#WAIT FOR 1",
        "#DELETE P1",
    ] {
        let said = said(&format!("P1=1\n{text}"));
        assert!(!said.contains(&"21220".to_owned()), "{text}: {said:?}");
    }
}

/// Two axes of one name moved the second one, silently (21256). Other exchanges that are wrong are programs of the suite.
#[test]
fn axis_exchanges_are_checked() {
    for (text, id) in [
        ("#SET AX [X,1,0][X,2,1]", "21256"),
        ("#PUT AX [Z]\n#CALL AX [X,3,2]", "21261"),
        ("#CS ADD [A][1]\n#CS SELECT [A]\n#SET AX [X,1,0]", "20684"),
    ] {
        let run = super::run(&format!("{text}\nM30\n"));
        assert_eq!(run.ids().last().map(String::as_str), Some(id), "{text}");
    }
    for text in [
        "#CALL AX [X,1,0]",
        "#PUT AX [X]\n#CALL AX [X,1,0]",
        "#PUT AX [X][Y]\n#CALL AX [X,2,0][Y,1,1]",
        "#SET AX [Y,1,0][X,2,1]",
        "#CS ON [1,2]\n#CS OFF\n#PUT AX [X]",
    ] {
        super::clean(&format!("{text}\nM30\n"));
    }
}

/// Numbers that the pages of the mistakes print, beyond those of the suite: 20721, 20995.
#[test]
fn numbers_of_single_mistakes() {
    for (text, id) in [
        ("#MSG [\"%D %D\", 1]", "20721"),
        ("#MSG [\"%D\", 1, 2]", "20721"),
        ("#MSG [\"%D\", ]", "20726"),
        ("#WAIT [ID=-1]", "20995"),
    ] {
        let run = super::run(&format!("{text}\nM30\n"));
        assert!(run.ids().iter().any(|found| found == id), "{text}: {:?}", run.ids());
    }
    super::clean("#MSG SAVE CONTINUE [\"text\"]\nM30\n");
}
