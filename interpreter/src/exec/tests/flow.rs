//! Expressions, parameters, variables and control blocks.

use super::{assert_end, clean, run, run_on, said, skipping};

/// Text of the single message.
#[track_caller]
fn says(program: &str, expected: &str) {
    let run = clean(&format!("{program}\nM30\n"));
    assert_eq!(run.messages(), [expected], "{program}");
}

#[test]
fn expressions() {
    assert_end("P1=5 X P1*2 F100", [10.0, 0.0, 0.0]);
    assert_end("X[-2*[3+4]] F100", [-14.0, 0.0, 0.0]);
    assert_end("X--40 F100", [40.0, 0.0, 0.0]);
    assert_end("P1=60 X SIN[P1/2] Y COS[P1] F100", [0.5, 0.5, 0.0]);
    assert_end("P1=20 P2=P1*2 X P2 F100", [40.0, 0.0, 0.0]);
    says("#MSG [\"%d %d %d\", 2**3**2, -2**2, 7 MOD 3]", "64 4 1");
    says("#MSG [\"%f\", ATAN2[1,-1] + ASIN[0.5] + ACOS[0] + ATAN[1]]", "300.000000");
    says("#MSG [\"%d %d %d\", 6&3, 6|3, 6^3]", "2 7 5");
    says("#MSG [\"%d %d %d %d\", 1&&0, 1||0, NOT[1], 1 XOR 1]", "0 1 0 0");
    says("#MSG [\"%f %f\", ROUND[2.5], INT[-2.7]]", "3.000000 -2.000000");
    says("#MSG [\"%s %d\", \"a\" + \"b\", LEN[\"abc\"]]", "ab 3");
    says("#MSG [\"%f\", 10/3]", "3.333333");
}

#[test]
fn faults_of_expressions() {
    assert_eq!(said("P2=LN[-1]"), ["20399"]);
    assert_eq!(said("P2=5 MOD 0"), ["20396"]);
    assert_eq!(said("P2=10**400"), ["K-0009"]);
    assert_eq!(said("V.L.A=1"), ["K-0012"]);
    assert_eq!(said("P1=V.G.FEDRATE"), ["K-0012"]);
}

#[test]
fn indirect_and_array_parameters() {
    assert_end("P1=2 P2=7 X PP1 F100", [7.0, 0.0, 0.0]);
    assert_end("P1=1 P6=4 X P[P1+5] F100", [4.0, 0.0, 0.0]);
    assert_end(
        "#VAR\nP7[3]\nV.P.T[2][3] = [1,2,3, \\\n4,5,6]\nV.L.N : UNS08 = 3\n#ENDVAR\nP7[2]=5\nX P7[2] Y V.P.T[1][0] Z V.L.N F100",
        [5.0, 4.0, 3.0],
    );
    let id =
        |text: &str| run(&format!("#VAR\nV.P.T[2]\nV.L.N : UNS08\n#ENDVAR\n{text}\nM30\n")).ids();
    assert_eq!(id("V.L.N=256"), ["20847"]);
    assert_eq!(id("V.L.N=255"), [""; 0]);
}

#[test]
fn system_variables() {
    says(
        "V.G.NP[1].V.X=10 G54\nX1 Y2 F500\n#MSG [\"%f %f %f\", V.A.ABS.X, V.A.ABS[1], V.A.ACS.ABS.X]",
        "1.000000 2.000000 11.000000",
    );
    says(
        "N40 F1234\n#MSG [\"%f %d %d\", V.G.FEEDRATE, V.G.FEEDRATE_MODE, V.G.BLOCK_NR]",
        "1234.000000 94 40",
    );
    says("G70\n#MSG [\"%d\", V.G.MASS_MM]", "1");
    says("#MSG [\"%f\", V.A.-SWE.X + V.A.+SWE.X]", "0.000000");
    says("G91 X3 F100\n#MSG [\"%f\", V.A.ACT_POS.X]", "3.000000");
    says("G02 X10 I5.1 F100\n#MSG [\"%f %f\", V.G.I, V.G.R]", "5.000000 5.000000");
}

#[test]
fn reading_the_actual_position_stops_first() {
    let run = clean("X1 F100\nP1=V.A.ACT_POS.X P2=P1+1\nX P2\nM30\n");
    assert_eq!(run.syncs(), [&super::Sync::ReadActual]);
    assert_eq!(run.end, [2.0, 0.0, 0.0]);
}

#[test]
fn branches() {
    let program = |p: &str| {
        format!(
            "P1={p}\n$IF P1==1\nX1 F100\n$ELSEIF P1==2\nX2 F100\n$IF 1\nY1\n$ENDIF\n$ELSE\nX3 F100\n$ENDIF\nZ1"
        )
    };
    assert_end(&program("1"), [1.0, 0.0, 1.0]);
    assert_end(&program("2"), [2.0, 1.0, 1.0]);
    assert_end(&program("3"), [3.0, 0.0, 1.0]);
    // only the taken branch is looked at
    assert_end("F100\n$IF 0\nX!!\n$ENDIF\nX1", [1.0, 0.0, 0.0]);
}

#[test]
fn switches() {
    let program = |value: &str| {
        format!(
            "F100\n$SWITCH {value}\n$CASE 1\nX1\n$BREAK\n$CASE 2\nX2\n$CASE 3\nY3\n$BREAK\n$DEFAULT\nZ9\n$ENDSWITCH"
        )
    };
    assert_end(&program("1.0004"), [1.0, 0.0, 0.0]);
    assert_end(&program("2"), [2.0, 3.0, 0.0]);
    assert_end(&program("3"), [0.0, 3.0, 0.0]);
    assert_end(&program("7"), [0.0, 0.0, 9.0]);
    assert_end("F100\n$SWITCH P1=INT[2.5]\n$CASE 2\nX P1\n$ENDSWITCH", [2.0, 0.0, 0.0]);
    assert_end("F100\n$SWITCH -1\n$CASE -1\nX5\n$ENDSWITCH", [5.0, 0.0, 0.0]);
}

#[test]
fn loops() {
    assert_end("P2=0\n$FOR P1=0,4,2\nP2=P2+1\n$ENDFOR\nX P2 F100", [3.0, 0.0, 0.0]);
    assert_end("P2=0\n$FOR P1=3,1,-1\nP2=P2+P1\n$ENDFOR\nX P2 F100", [6.0, 0.0, 0.0]);
    assert_end("P2=0\n$FOR P1=2,1,1\nP2=9\n$ENDFOR\nX P2 Y P1 F100", [0.0, 2.0, 0.0]);
    assert_end(
        "P1=0\n$WHILE P1<5\nP1=P1+1\n$IF P1==3\n$BREAK\n$ENDIF\n$ENDWHILE\nX P1 F100",
        [3.0, 0.0, 0.0],
    );
    assert_end(
        "P1=0 P2=0\n$WHILE P1<5\nP1=P1+1\n$IF P1==3\n$CONTINUE\n$ENDIF\nP2=P2+P1\n$ENDWHILE\nX P2 F100",
        [12.0, 0.0, 0.0],
    );
    assert_end("P1=0\n$DO\nP1=P1+1\n$ENDDO P1<4\nX P1 F100", [4.0, 0.0, 0.0]);
    assert_end("P1=0\n$DO\nP1=P1+1\n$IF P1==6\n$BREAK\n$ENDIF\n$ENDDO\nX P1 F100", [6.0, 0.0, 0.0]);
    assert_end("P1=0\n$REPEAT\nP1=P1+1\n$UNTIL P1>=4\nX P1 F100", [4.0, 0.0, 0.0]);
    assert_end(
        "P3=0\n$FOR P1=1,3,1\n$FOR P2=1,P1,1\nP3=P3+1\n$ENDFOR\n$ENDFOR\nX P3 F100",
        [6.0, 0.0, 0.0],
    );
    assert_end("V.P.I=0\n$FOR V.P.I=1,3,1\n$ENDFOR\nX V.P.I F100", [4.0, 0.0, 0.0]);
}

#[test]
fn jumps() {
    assert_end("F100\n$GOTO N20\nX1\nN20: Y2", [0.0, 2.0, 0.0]);
    assert_end("F100 P1=0\n[Again] P1=P1+1\n$IF P1<3 $GOTO [AGAIN]\nX P1", [3.0, 0.0, 0.0]);
    assert_end(
        "F100\n$FOR P1=1,9,1\n$IF P1==4\n$GOTO [OUT]\n$ENDIF\n$ENDFOR\n[OUT] X P1",
        [4.0, 0.0, 0.0],
    );
    assert_end("F100\nX1 $GOTO N5\nX2\nN5: Y1", [1.0, 1.0, 0.0]);
    for (open, close) in [
        ("$FOR P1=1,2,1", "$ENDFOR"),
        ("$WHILE 0", "$ENDWHILE"),
        ("$DO", "$ENDDO 0"),
        ("$REPEAT", "$UNTIL 1"),
    ] {
        let text = format!("$GOTO [IN]\n{open}\n[IN] X1\n{close}\nM30\n");
        assert_eq!(run(&text).ids(), ["21480"], "{open}");
    }
    // a loop around an $IF counts as well
    let text = "$GOTO [IN]\n$WHILE 1\n$IF 1\n[IN] X1\n$ENDIF\n$BREAK\n$ENDWHILE\nM30\n";
    assert_eq!(run(text).ids(), ["21480"]);
}

#[test]
fn block_numbers_and_labels() {
    // TF5200 programming manual, block numbers and contouring examples: `N[P1*100]`, `NP123 XP1`; diagnosis 21187: the
    // name may come before the number or after it
    says("P123=7.5\nNP123 X P123 F100\n#MSG [\"%d\", V.G.BLOCK_NR]", "8");
    assert_end("F100\n$GOTO [A]\nX9\n[A] N10 Y1", [0.0, 1.0, 0.0]);
    assert_end("F100\n$GOTO [A]\nX9\nN10 [A] Y1", [0.0, 1.0, 0.0]);
    assert_end("F100 P1=0\n$IF 0\nNP1 $IF 1\nX9\n$ENDIF\n$ENDIF\nY1", [0.0, 1.0, 0.0]);
}

#[test]
fn several_assignments_share_a_block() {
    assert_end(
        "V.P.A=1 V.P.B=V.P.A+1 V.S.C=V.P.B*2\nX V.P.A Y V.P.B Z V.S.C F100",
        [1.0, 2.0, 4.0],
    );
}

#[test]
fn jumps_into_branches() {
    // the branch entered is the one that counts: neither the condition nor $ELSE is looked at
    let into = |label: &str| {
        clean(&format!(
            "F100\n$GOTO [{label}]\nX9\n$IF 0\nX1\n[A] Y1\n$ELSEIF 0\nX2\n[B] Y2\n$ELSE\nX3\n[C] Y3\n$ENDIF\nZ1\nM30\n"
        ))
        .end
    };
    assert_eq!(into("A"), [0.0, 1.0, 1.0]);
    assert_eq!(into("B"), [0.0, 2.0, 1.0]);
    assert_eq!(into("C"), [0.0, 3.0, 1.0]);
    // two levels deep, and from one branch into another of the same $IF
    assert_end(
        "F100\n$GOTO N5\n$IF 0\n$IF 0\nN5: X1\n$ELSE\nX9\n$ENDIF\nY1\n$ELSE\nX9\n$ENDIF\nZ1",
        [1.0, 1.0, 1.0],
    );
    assert_end("F100\n$IF 1\nX1\n$GOTO [E]\nX9\n$ELSE\nX9\n[E] Y1\n$ENDIF\nZ1", [1.0, 1.0, 1.0]);
    // back into a branch that was left: a loop by hand
    assert_end(
        "F100 P1=0\n$IF 1\n[AGAIN] P1=P1+1\n$ENDIF\n$IF P1<4 $GOTO [AGAIN]\nX P1",
        [4.0, 0.0, 0.0],
    );
}

#[test]
fn conditional_interpretation_and_comment_blocks() {
    assert_end("F100\n#IF 0\nX!!\n#ELSE\nX2\n#ENDIF\nY1", [2.0, 1.0, 0.0]);
    assert_end("F100\n#IF 1\nX1\n#ELSE\nX!!\n#ENDIF\nY1", [1.0, 1.0, 0.0]);
    assert_end("F100\n#COMMENT BEGIN\nX9 ???\n#COMMENT END\nY1", [0.0, 1.0, 0.0]);
}

#[test]
fn skipped_blocks() {
    let text = "F100\n/X1\n/2 Y1\n/10 N5 Z1\nM30\n";
    assert_eq!(skipping(text, &[]).end, [1.0, 1.0, 1.0]);
    assert_eq!(skipping(text, &[1]).end, [0.0, 1.0, 1.0]);
    assert_eq!(skipping(text, &[2, 10]).end, [1.0, 0.0, 0.0]);
}

#[test]
fn a_million_passes() {
    let run = clean(
        "P1=0 P2=0\n$WHILE P1<1000000\nP1=P1+1\n$IF P1 MOD 3 == 0\nP2=P2+1\n$ENDIF\n$ENDWHILE\nX P2/1000 F100\nM30\n",
    );
    assert!((run.end[0] - 333.333).abs() < 1e-12);
}

/// A jump back parses nothing again: the second million passes cost what `$WHILE` costs, and give the same.
#[test]
fn jumps_back_are_loops() {
    let body = "P1=P1+1\n$IF P1 MOD 3 == 0\nP2=P2+1\n$ENDIF\n";
    let end = "X P2/1000 F100\nM30\n";
    let by_while = clean(&format!("P1=0 P2=0\n$WHILE P1<100000\n{body}$ENDWHILE\n{end}"));
    let by_goto = clean(&format!("P1=0 P2=0\nN10:\n{body}$IF P1<100000 $GOTO N10\n{end}"));
    assert_eq!(by_goto.end, by_while.end);
    // two loops that overlap, and one inside another
    let crossed = clean(
        "P1=0 P2=0\n[A] P1=P1+1\n[B] P2=P2+1\n$IF P1<20 $GOTO [A]\n$IF P2<100 $GOTO [B]\nX P1 Y P2 F100\nM30\n",
    );
    assert_eq!(crossed.end[..2], [20.0, 100.0]);
    // what a loop declares again is read again
    let macros = clean("P1=0\n\"M\" = \"1\"\n[A] P2=P2+\"M\" P1=P1+1\n\"M\" = \"10\"\n$IF P1<4 $GOTO [A]\nX P2 F100\nM30\n".replace("P1=0\n", "P1=0 P2=0\n").as_str());
    assert!((macros.end[0] - 31.0).abs() < 1e-12);
}

/// Functions and messages are handed over a thousand at a time, and a loop of them is one without motion.
#[test]
fn events_without_motion_are_handed_over_and_the_loop_is_stopped() {
    use super::{Options, machine, run_with};
    use crate::exec::step::Step;
    use crate::source::MemorySources;
    for block in ["M8", "#MSG [\"x\"]"] {
        let options = Options { max_blocks_at_rest: 50_000, ..Options::default() };
        let text = format!("$WHILE 1\n{block}\n$ENDWHILE\nM30\n");
        let run = run_with(MemorySources::new().with("main.nc", text), machine(&[]), options);
        assert_eq!(run.ids(), ["K-0017"], "{block}");
        let events = |step: &Step| match step {
            Step::Motion { events, .. } | Step::Sync { events, .. } | Step::End { events, .. } => {
                events.len()
            }
        };
        assert!(run.steps.len() > 10, "{block}");
        assert!(run.steps.iter().all(|step| events(step) <= 1000), "{block}");
    }
}

#[test]
fn macros() {
    assert_end(
        "\"GO\" = \"X5 Y\"\n\"LEN\" = \"3*2\"\nG01 \"GO\"7 Z[\"LEN\"] F100",
        [5.0, 7.0, 6.0],
    );
    assert_eq!(run("\"A\" = \"\\\"A\\\"\"\n\"A\"\nM30\n").ids()[0], "20734");
}

/// Macros of the channel list (149215627, with its examples) hold in every program, also behind #INIT MACRO TAB.
#[test]
fn macros_of_the_channel_list() {
    let list = [
        "channel.makro_def[4].symbol=CALC_P5",
        "channel.makro_def[4].nc_code=P5 = P2 + 3",
        "channel.makro_def[6].symbol=RELPOS1",
        "channel.makro_def[6].nc_code=G01 G91 X10 Y20 F100",
        "channel.makro_def[15].symbol=ABWAHL",
        "channel.makro_def[15].nc_code=60 - 7",
        "channel.makro_def[18].symbol=NPV_ABWAHL",
        "channel.makro_def[18].nc_code=G\\\"ABWAHL\\\"",
        "channel.makro_def[19].symbol=WITHOUT_TEXT",
    ];
    let text = "P2=4\n\"CALC_P5\"\n\"RELPOS1\" Z P5\n\"RELPOS1\" = \"X1\"\n\"RELPOS1\"
#INIT MAKRO TAB\n\"RELPOS1\"\nV.G.NP[1].V.X=100\nG54\n\"NPV_ABWAHL\"\nG90 Y2 X1\nM30\n";
    let run = run_on(&list, text);
    assert_eq!(run.ids(), [""; 0]);
    let ends = [[10.0, 20.0, 7.0], [11.0, 20.0, 7.0], [21.0, 40.0, 7.0], [1.0, 2.0, 7.0]];
    assert_eq!(run.ends(), ends);
    assert_eq!(run_on(&list, "\"WITHOUT_TEXT\"\nM30\n").ids(), ["K-0012"]);
}

/// A macro as the number of a function is one value, in programs too.
#[test]
fn macros_as_numbers_of_functions() {
    assert_end("\"N\" = \"100 - 9\"\nG01 F100 X1\nG\"N\" X1\nX1", [3.0, 0.0, 0.0]);
    assert_eq!(said("\"N\" = \"60 - 7.5\"\nG\"N\""), ["K-0009"]);
    assert_eq!(said("\"N\" = \"1000 - 1\"\nG\"N\""), ["20131"]);
    let run = super::clean("\"N\" = \"5 * 2\"\nM\"N\" H\"N\"\nM30\n");
    let called = |e: &&crate::exec::step::Event| {
        matches!(
            e,
            crate::exec::step::Event::MFunction { number: 10, .. }
                | crate::exec::step::Event::HFunction { number: 10, .. }
        )
    };
    assert_eq!(run.events().into_iter().filter(called).count(), 2);
}

/// $ENDDO is FALSE below 0.5 and $UNTIL TRUE above 0.5 (206946827): negative values went on, and ended.
#[test]
fn negative_conditions_of_loops() {
    assert_end("P1=2 P2=0\n$DO\nP1=P1-3 P2=P2+1\n$ENDDO P1\nG01 X P2 F100", [1.0, 0.0, 0.0]);
    assert_end("P2=0\n$REPEAT\nP2=P2+1\n$UNTIL P2-3\nG01 X P2 F100", [4.0, 0.0, 0.0]);
    assert_end("P2=0\n$REPEAT\nP2=P2+0.25\n$UNTIL P2\nG01 X P2 F100", [0.75, 0.0, 0.0]);
    assert_end("P2=0\n$DO\nP2=P2+1\n$ENDDO 2.5-P2\nG01 X P2 F100", [3.0, 0.0, 0.0]);
}

/// `IDP100`: a key and a parameter written together (207431819).
#[test]
fn keys_with_parameters() {
    assert_end(
        "P100=814 P1=0\n#SIGNAL [IDP100 P[0]=7 CH1]\n#WAIT [ID814 P[0]=P1 CH1]\nX P1 F100 G01",
        [7.0, 0.0, 0.0],
    );
    assert_eq!(said("P1=3\n#TIMER START [IDP1]\n#TIMER READ [ID=P1]"), [""; 0]);
    assert_eq!(said("#TIMER START [IDP1]"), ["20925"]);
    assert_eq!(said("P1=3\n#TIMER START [IDQ1]"), ["21220"]);
}

/// Commands under their older names (5252766831026775947, 15427960971).
#[test]
fn older_commands() {
    let speed = |text: &str| {
        let run = super::clean(&format!("{text}\nG01 X100 F60000\nM30\n"));
        let dynamics = run.blocks()[0].dynamics.clone();
        (dynamics.vector.vel_mm_s, dynamics.vector.acc_mm_s2)
    };
    for (old, new) in [
        ("#VECTORVEL [5000] ON", "#VECTOR LIMIT ON [VEL=5000]"),
        ("#VECTORVEL ON", "#VECTOR LIMIT ON [VEL]"),
        ("#VECTORACC ON[2700000]", "#VECTOR LIMIT ON [ACC=2700000]"),
        (
            "#VECTORVEL ON [50]\n#VECTORACC ON [2700000]\n#VECTORVEL OFF",
            "#VECTOR LIMIT ON [ACC=2700000]",
        ),
    ] {
        assert_eq!(speed(old), speed(new), "{old}");
        assert_ne!(speed(old), speed(""), "{old}");
    }
    assert_eq!(said("#SET DEC LR SOLL\n#INIT MAKRO TAB"), [""; 0]);
    assert_eq!(said("#GET IPO OFFSET"), ["K-0019"]);
    assert_eq!(said("#VIB GUARD [MODE=2] ON").first().map(String::as_str), Some("K-0002"));
    assert_eq!(said("#VECTORVEL ON [1, 2]"), ["21220"]);
}

#[test]
fn parameters_of_earlier_programs_do_not_exist() {
    // P-CHAN-00067: every run is the first program
    let run = run_on(&["channel.p_param_haltend=1"], "X P1 F100\nM30\n");
    assert_eq!(run.ids(), ["20925"]);
    assert!(run.diagnostics[0].hint.as_deref().is_some_and(|h| h.contains("P-CHAN-00067")));
}

/// `$GOTO NV.E.NUMBER`, `$GOTO V.E.NAME` (parametric jump call, 206921739) and `N[..]`, `NP1`.
#[test]
fn jumps_are_told_by_values() {
    for jump in ["NV.P.NUM", "NP1", "N[P1-5+5]"] {
        let run = super::clean(&format!(
            "#VAR\nV.P.NUM = 60\n#ENDVAR\nP1=60\nG01 F1000\n$GOTO {jump}\nX5\nN60: Y7\nM30\n"
        ));
        assert_eq!(run.end[..2], [0.0, 7.0], "{jump}");
    }
    // in a condition, and rounded as the number of a block is
    let run = super::clean("P1=60.3\nG01 F1000\n$IF P1 > 0 $GOTO NP1\nX5\nN60: Y7\nM30\n");
    assert_eq!(run.end[..2], [0.0, 7.0]);
    let by_name = "V.E.NAME = \" ende \"\nG01 F1000\n$GOTO V.E.NAME\nX5\n[ENDE] Y7\nM30\n";
    let run = super::run(by_name);
    assert_eq!((run.ids(), &run.end[..2]), (vec!["K-0110".to_owned()], &[0.0, 7.0][..]));
    assert_eq!(super::run("P1=7\n$GOTO NP1\nM30\n").ids(), ["K-0015"]);
    assert_eq!(super::run("P1=-7\n$GOTO NP1\nM30\n").ids(), ["K-0015"]);
    assert_eq!(super::run("V.E.NAME = 7\n$GOTO V.E.NAME\nM30\n").ids(), ["K-0110", "K-0002"]);
    assert_eq!(super::run("$GOTO V.P.NAME\nM30\n").ids(), ["20839"]);
}
