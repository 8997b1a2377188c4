use super::{Mode, accepted, parse, parse_as, refused, shape};
use crate::diag::Severity;
use crate::source::{BlockReader, MemorySources, Sources};
use crate::syntax::Parser;
use crate::syntax::ast::{Body, ExprKind, ItemKind, ItemValue, LabelKind, Word, WordKind};
use std::sync::Arc;

fn words(line: &str) -> Vec<Word> {
    match accepted(line).body {
        Body::Words(words) => words,
        body => panic!("{line}: {body:?}"),
    }
}

/// Canonical spelling of an accepted line.
fn printed(line: &str) -> String {
    accepted(line).to_string()
}

#[test]
fn words_and_their_values() {
    for (line, expected) in [
        ("N30X100Y200F500", "N30 X=100 Y=200 F=500"),
        ("G1 X10 (a (b) c) Y5", "G1 X=10 Y=5"),
        ("( N010 #SLOPE[TYPE=HSC]", ""),
        ("g01 x.5 y5. z-0.25", "G1 X=0.5 Y=5 Z=-0.25"),
        ("G001 M03 M3", "G1 M3 M3"),
        ("C--40", "C=--40"),
        // the first sign of an address stays: it is the direction of a modulo axis
        ("X+5 Y-+-5 Z[-5]", "X=+5 Y=--5 Z=[-5]"),
        ("X 10 Y = 20", "X=10 Y=20"),
        ("X100+P10", "X=100 + P10"),
        ("XV.P.A", "X=V.P.A"),
        ("X SIN[P1*5]", "X=SIN[P1 * 5]"),
        ("X10 -5", "X=10 - 5"),
        ("X10 Y-5", "X=10 Y=-5"),
        ("G04 P1", "G4=P1"),
        ("RP2", "R=P2"),
        ("R=50 R3=5", "R=50 R3=5"),
        ("G131 50", "G131=50"),
        ("G131=50", "G131=50"),
        ("G129 = 50", "G129=50"),
        ("G01 P1=5 V.P.X=3", "G1 P1=5 V.P.X=3"),
        ("G80 [1, 2, , 4]", "G80[1, 2, , 4]"),
        ("G805[-45.785, 32.720, 2.620]", "G805[-45.785, 32.72, 2.62]"),
        ("G80 [0]", "G80[0]"),
        ("G131 [50*2]", "G131=50 * 2"),
        ("M200=800 M@P6 H5=2 MP1", "M200=800 M@P6 H5=2 MP1"),
        ("M6 T5", "M6 T=5"),
        ("S2=500 T=5", "S2=500 T=5"),
        ("X1=5 AP10 AP-3 X10", "X1=5 AP=10 AP=-3 X=10"),
        ("G2 X1 Y2 I1=1 J1=2", "G2 X=1 Y=2 I1=1 J1=2"),
        ("CP5 CX10", "C=P5 CX=10"),
        ("X1E5", "X=1 E=5"),
        ("P1=20 P2=40", "P1=20 P2=40"),
        ("PP1=5 PPP1=6 P[P1+5]=7", "PP1=5 PPP1=6 P[P1 + 5]=7"),
        ("P100[5]=1 P5[20][P1]=2", "P100[5]=1 P5[20][P1]=2"),
        ("P1=@P3 P2=@X", "P1=@P3 P2=@X"),
        ("X[-2*[3+4]]", "X=[-2 * [3 + 4]]"),
        ("V.E.Name.Member = \"text; (x)\"", "V.E.Name.Member=\"text; (x)\""),
        ("P1=V.A.-SWE.X P2=V.A.+SWE_MDS.X", "P1=V.A.-SWE.X P2=V.A.+SWE_MDS.X"),
        ("P1=V.P.A-V.P.B", "P1=V.P.A - V.P.B"),
        ("P1=V.G.NP[1].V.X P2=V.G.@P[2].VALID", "P1=V.G.NP[1].V.X P2=V.G.@P[2].VALID"),
        ("\"NAME\" = \"X\\\"1\"", "\"NAME\"=\"X\\\"1\""),
        ("G1 \"NAME\"", "G1 \"NAME\""),
        ("X10 #FRC=50 #CHR 2 #ANG=P1", "X=10 #FRC=50 #CHR=2 #ANG=P1"),
        ("#PSET X10", "#PSET X=10"),
        ("X1 $GOTO N20: ", "X=1 $GOTO N20"),
        ("$GOTO [end]", "$GOTO [END]"),
        ("LL SIDE", "LL SIDE"),
        ("G0 X1 L sub/a-1.nc", "G0 X=1 L sub/a-1.nc"),
        ("L \"a b.nc\"", "L \"a b.nc\""),
        ("L CYCLE [NAME=\"a b.nc\"]", "L CYCLE [NAME=\"a b.nc\"]"),
        ("L4712", "L 4712"),
        (
            "L Cycle [NAME=..\\CH_1.NC @P3=24000 MODAL_MOVE @P4=P1]",
            "L CYCLE [NAME=..\\CH_1.NC, @P3=24000, MODAL_MOVE, @P4=P1]",
        ),
        ("L SEQUENCE [NAME=a.nc N10 N50 REPEAT=2]", "L SEQUENCE [NAME=a.nc, N10, N50, REPEAT=2]"),
        ("S[M3 REV1000] S2[G135 G136=80]", "S[M3, REV1000] S2[G135, G136=80]"),
        ("S[P1*100]", "S=P1 * 100"),
        ("X[OVERRIDE FEED_FACT=50]", "X[OVERRIDE, FEED_FACT=50]"),
        ("Z[DIST_CTRL OFF NO_MOVE]", "Z[DIST_CTRL, OFF, NO_MOVE]"),
        ("O100", "O=100"),
    ] {
        assert_eq!(printed(line), expected, "{line}");
    }
}

#[test]
fn heads_of_blocks() {
    for (line, skip, expected) in [
        ("/N100 X1", Some(1), "/1 N100 X=1"),
        ("/5 N100 X1", Some(5), "/5 N100 X=1"),
        ("/10", Some(10), "/10"),
        ("N10: X1", None, "N10: X=1"),
        ("[START] X1", None, "[START] X=1"),
        ("[start point]", None, "[START POINT]"),
        ("N[P1+5] X1", None, "N[P1 + 5] X=1"),
        ("N100", None, "N100"),
        ("  \t", None, ""),
    ] {
        let block = accepted(line);
        assert_eq!((block.skip, block.to_string().as_str()), (skip, expected), "{line}");
    }
    let label = accepted("N10:").label.unwrap();
    assert_eq!(label.kind, LabelKind::Number(10));
}

#[test]
fn program_heads() {
    for (line, local, name, text) in [
        ("%L SQUARE ; remark", true, Some("SQUARE"), "SQUARE"),
        ("%LSQUARE", false, Some("LSQUARE"), "LSQUARE"),
        ("%MAIN", false, Some("MAIN"), "MAIN"),
        ("% name (x)", false, Some("name"), "name"),
        ("% tool 5, \"x\"", false, Some("tool"), "tool 5, \"x\""),
        ("%L", false, Some("L"), "L"),
        ("%", false, None, ""),
    ] {
        let Body::ProgramHead(head) = accepted(line).body else { panic!("{line}") };
        let found = (head.local, head.name.as_ref().map(|n| &*n.text), &*head.text);
        assert_eq!(found, (local, name, text), "{line}");
    }
}

#[test]
fn commands_in_all_their_spellings() {
    for (line, expected) in [
        ("#FILTER ON[HSC]", "#FILTER ON [HSC]"),
        ("#SLOPE[TYPE=HSC]", "#SLOPE [TYPE=HSC]"),
        (
            "#vib guard on [mode 2,FREQ 40, AX_DEV=0.01]",
            "#VIB GUARD ON [MODE=2, FREQ=40, AX_DEV=0.01]",
        ),
        (
            "#HSC [BSPLINE PATH_DEV 0.2 TRACK_DEV 0.2]",
            "#HSC [BSPLINE, PATH_DEV=0.2, TRACK_DEV=0.2]",
        ),
        ("#CONTOUR MODE [DEV | PATH_DEV =P1*2]", "#CONTOUR MODE [DEV, PATH_DEV=P1 * 2]"),
        ("#X [A=1|2 | B=3]", "#X [A=1 | 2, B=3]"),
        ("#SET SLOPE PROFIL[3]", "#SET SLOPE PROFIL [3]"),
        ("#VECTOR LIMIT ON ALL", "#VECTOR LIMIT ON ALL"),
        ("#VECTOR LIMIT OFF [VEL]", "#VECTOR LIMIT OFF [VEL]"),
        ("#CS DEF[1][0,0,0,0,0,-5]", "#CS DEF [1] [0, 0, 0, 0, 0, -5]"),
        ("#CS OFF ALL", "#CS OFF ALL"),
        ("#TIME 2.5", "#TIME 2.5"),
        ("#TIME P1", "#TIME P1"),
        ("#WAIT FOR V.E.A == TRUE", "#WAIT FOR V.E.A == TRUE"),
        ("#DELETE V.P.A, V.P.B[2]", "#DELETE V.P.A, V.P.B[2]"),
        ("#INIT V.E.", "#INIT V.E."),
        (
            "#MSG SAVE EXCLUSIVE [\"%f\", V.A.ABS.X, P1]",
            "#MSG SAVE EXCLUSIVE [\"%f\", V.A.ABS.X, P1]",
        ),
        ("#ERROR [ID455 RC2 PV1=5]", "#ERROR [ID455, RC2, PV1=5]"),
        ("#CONTOUR MODE [POS X2.7 Y.5 Z-1]", "#CONTOUR MODE [POS, X2.7, Y=0.5, Z=-1]"),
        ("#CALL AX FAST [X,1,0][Y,2,1,CMDPOS]", "#CALL AX FAST [X, 1, 0] [Y, 2, 1, CMDPOS]"),
        ("#PUT AX [X, , Y]", "#PUT AX [X, , Y]"),
        ("#FILE NAME[ G80=\"x.nc\" ]", "#FILE NAME [G80=\"x.nc\"]"),
        ("#FILE EXIST [\"x\"]", "#FILE EXIST [\"x\"]"),
        ("#MACHINE DATA SYN [AX=Z AXPARAM=V.E.x]", "#MACHINE DATA SYN [AX=Z, AXPARAM=V.E.x]"),
        (
            "#ROTATION ON [ANGLE=30 CENTER1=5 CENTER2 P1]",
            "#ROTATION ON [ANGLE=30, CENTER1=5, CENTER2=P1]",
        ),
        ("#A [K=[1,2,[3,4]] L [P1+1]*2]", "#A [K=[1, 2, [3, 4]], L=[P1 + 1] * 2]"),
        ("#SUPPRESS OFFSETS", "#SUPPRESS OFFSETS"),
        ("N10 #VAR", "N10 #VAR"),
        ("#COMMENT BEGIN", "#COMMENT BEGIN"),
        ("# COMMENT  BEGIN", "#COMMENT BEGIN"),
        ("N10 #\tSLOPE [TYPE=STEP]", "N10 #SLOPE [TYPE=STEP]"),
        ("#IF P1 == 2", "#IF P1 == 2"),
    ] {
        assert_eq!(printed(line), expected, "{line}");
    }
}

#[test]
fn decoration_leaves_no_trace() {
    for group in [
        &["#FILTER ON[HSC]", "#FILTER ON [HSC]", "#filter   on\t[ HSC ]"][..],
        &[
            "#VIB GUARD ON [MODE=2 FREQ=40 AX_DEV=0.01]",
            "#VIB GUARD ON [MODE 2,FREQ 40, AX_DEV=0.01]",
            "#VIB GUARD ON[MODE =2, FREQ= 40,AX_DEV .01,]",
        ],
        &["G131 50", "G131=50", "G131 = 50", "G131=[50]", "G131 +50"],
        &["G1X5", "G01 X 5", "g1x=5.", "G1 X[5]"],
        &["G1 X--5", "G1 X-[-5]"],
        &["P1=1||2", "P1=1 OR 2"],
        &["P1=1&&P2", "P1=1 and P2"],
    ] {
        let first = shape(&accepted(group[0]));
        for line in group {
            let found = shape(&accepted(line));
            // The lengths of the lines differ: only block spans and the like do, which `shape` drops.
            assert_eq!(found, first, "{line}");
        }
    }
}

#[test]
fn control_statements() {
    for (line, expected) in [
        ("$IF P1==2", "$IF P1 == 2"),
        ("N290   $IF V.E.X != 7 $GOTO N20", "N290 $IF V.E.X != 7 $GOTO N20"),
        ("$IF true $GOTO [A]", "$IF TRUE $GOTO [A]"),
        ("$IF[P1>5]", "$IF P1 > 5"),
        ("$ELSEIF P1", "$ELSEIF P1"),
        ("$else", "$ELSE"),
        ("$ENDIF", "$ENDIF"),
        ("$SWITCH P1=INT[P2]", "$SWITCH P1=INT[P2]"),
        ("$SWITCH 1.0004", "$SWITCH 1.0004"),
        ("$CASE -1", "$CASE -1"),
        ("$DEFAULT", "$DEFAULT"),
        ("$ENDSWITCH", "$ENDSWITCH"),
        ("$FOR P1 = 1, V.P.RUNS, 1", "$FOR P1 = 1, V.P.RUNS, 1"),
        ("$FOR V.P.I=0,4,-2", "$FOR V.P.I = 0, 4, -2"),
        ("$FOR P1=0, 4", "$FOR P1 = 0, 4"),
        ("$ENDFOR", "$ENDFOR"),
        ("$WHILE EXIST[V.P.A]", "$WHILE EXIST[V.P.A]"),
        ("$ENDWHILE", "$ENDWHILE"),
        ("$DO", "$DO"),
        ("$ENDDO", "$ENDDO"),
        ("$ENDDO P1<3", "$ENDDO P1 < 3"),
        ("$REPEAT", "$REPEAT"),
        ("$UNTIL P1", "$UNTIL P1"),
        ("/ $BREAK", "/1 $BREAK"),
        ("$CONTINUE", "$CONTINUE"),
    ] {
        assert_eq!(printed(line), expected, "{line}");
    }
}

#[test]
fn precedence() {
    for (text, expected) in [
        ("1+2*3", "1 + 2 * 3"),
        ("[1+2]*3", "[1 + 2] * 3"),
        ("2**3**2", "2 ** 3 ** 2"),
        ("2**[3**2]", "2 ** [3 ** 2]"),
        ("-2**2", "-2 ** 2"),
        ("-[2**2]", "-[2 ** 2]"),
        ("1-[2-3]", "1 - [2 - 3]"),
        ("10 MOD 3/2", "10 MOD 3 / 2"),
        ("1<2 && 3>2 || P1==1 XOR 0", "1 < 2 && 3 > 2 || P1 == 1 XOR 0"),
        ("1|2^3&4+5", "1 | 2 ^ 3 & 4 + 5"),
        ("[1|2]&3", "[1 | 2] & 3"),
        ("ATAN2[1,-1]+abs[-P1]", "ATAN2[1, -1] + ABS[-P1]"),
        ("PI*2", "PI * 2"),
    ] {
        assert_eq!(printed(&format!("P9={text}")), format!("P9={expected}"));
    }
    // Left to right, and the literal's sign binds tightest: (2**3)**2, (-2)**2.
    let value = |line| match words(line).remove(0).kind {
        WordKind::Assign(assign) => assign.value,
        kind => panic!("{kind:?}"),
    };
    let ExprKind::Binary(power) = value("P1=2**3**2").kind else { panic!() };
    assert!(matches!(power.left.kind, ExprKind::Binary(_)));
    let ExprKind::Binary(power) = value("P1=-2**2").kind else { panic!() };
    assert_eq!(power.left.kind, ExprKind::Number(-2.0));
}

#[test]
fn what_is_refused_and_where() {
    for (line, expected) in [
        ("X", &[("K-0002", 2)][..]),
        ("X Y10", &[("K-0002", 3)]),
        ("G1 X[1+*2] Y5", &[("K-0002", 8)]),
        ("X[1+2", &[("K-0002", 6)]),
        ("X1.2.3", &[("K-0002", 5)]),
        ("G91.1", &[("K-0120", 1)]),
        ("G", &[("K-0002", 1)]),
        ("M 30", &[("K-0002", 1)]),
        ("X1 FOO BAR", &[("K-0002", 4), ("K-0002", 8)]),
        ("P1", &[("20194", 1)]),
        ("#MSG [\"a]", &[("21220", 7)]),
        ("L CYCLE [NAME=x", &[("21220", 16)]),
        ("X SIN[30] COS[30]", &[("K-0002", 11)]),
        ("X1 $IF P1", &[("20206", 4)]),
        ("$FOR P1=1,9,1 X1", &[("20206", 15)]),
        ("$FOR P1 1,9,1", &[("20228", 9)]),
        ("$FOR P1=1 9,1", &[("20229", 11)]),
        ("$IF P1 X1", &[("20212", 8)]),
        ("$IF P1==", &[("K-0002", 9)]),
        ("$IF P1==FOO", &[("K-0002", 9)]),
        ("$SWITCH P1 X1", &[("20220", 12)]),
        ("$CASE 5 X1", &[("20222", 9)]),
        ("$DEFAULT X1", &[("20224", 10)]),
        ("$WHILE P1 X1", &[("20235", 11)]),
        ("$ENDWHILE X1", &[("20238", 11)]),
        ("$DO X1", &[("20239", 5)]),
        ("$ENDDO P1 X1", &[("20241", 11)]),
        ("$REPEAT X1", &[("21468", 9)]),
        ("$UNTIL P1 X1", &[("21470", 11)]),
        ("$BREAK X1", &[("20242", 8)]),
        ("$CONTINUE X1", &[("20245", 11)]),
        ("$GOTO 5", &[("20839", 7)]),
        ("P2=SIN45]", &[("20387", 4)]),
        ("P2=ATAN2 5,4]", &[("20387", 4)]),
        ("N100 N100: X1", &[("20841", 6)]),
        ("X10 Y Z[1+] G1", &[("K-0002", 7), ("K-0002", 11)]),
        ("X1äY2", &[("K-0001", 3)]),
        ("X1 { Y2 }", &[("K-0001", 4), ("K-0001", 9)]),
        ("X1 \"abc", &[("K-0002", 4)]),
        ("#SLOPE [TYPE=", &[("21220", 14)]),
        ("#VIB GUARD ON [MODE==2]", &[("21220", 20)]),
        ("#HSC [BSPLINE] X10", &[("20450", 16)]),
        ("X10 #FLUSH", &[("20207", 5)]),
        ("# 5", &[("K-0002", 1)]),
        ("$IF P1 = 5", &[("K-0002", 8)]),
        ("$FOO", &[("K-0002", 1)]),
        ("$FOR COUNT=1,2,1", &[("20227", 6)]),
        ("$ENDFOR X1", &[("20233", 9)]),
        ("X1 $ENDFOR", &[("20233", 4)]),
        ("$ELSE X1", &[("20215", 7)]),
        ("$ELSEIF P1 X5", &[("20217", 12)]),
        ("$ENDIF 5", &[("20219", 8)]),
        ("$IF 1<2<3", &[("K-0002", 8)]),
        ("#COMMENT BEGIN X", &[("20566", 1)]),
        ("#COMMENT END [1]", &[("20569", 1)]),
        ("N10 #IF P1", &[("20593", 5)]),
        ("G80 [12 !]", &[("22151", 9)]),
        ("/11 X1", &[("K-0002", 1)]),
        ("/0 X1", &[("K-0002", 1)]),
        ("V.G.X", &[("20194", 1)]),
        ("X10 \\ Y5", &[("K-0002", 5)]),
    ] {
        let found = refused(line);
        let found: Vec<(&str, u32)> = found.iter().map(|(id, at)| (id.as_str(), *at)).collect();
        let (_, diagnostics) = parse(line);
        let texts: Vec<&str> = diagnostics.iter().map(|d| d.text.as_str()).collect();
        assert_eq!(found, expected, "{line}: {texts:?}");
    }
}

#[test]
fn messages_say_what_was_expected() {
    for (line, expected) in [
        ("X", "the block ends too early, expected a value"),
        ("X[1+*2]", "unexpected `*`, expected a value"),
        ("#SLOPE [TYPE=", "the block ends too early, expected a value"),
        ("#SLOPE [TYPE= ", "the block ends too early, expected a value"),
        ("#A [B=[1,2]+3]", "a list in brackets has no value to calculate with"),
    ] {
        let (_, diagnostics) = parse(line);
        assert!(diagnostics[0].text.starts_with(expected), "{line}: {}", diagnostics[0].text);
    }
}

#[test]
fn the_rest_of_a_block_with_errors_is_used() {
    for (line, expected) in [
        ("N5 G1 X Y10 Z[1+*2] F5", "N5 G1 Y=10 F=5"),
        ("N5 X1ä Y2", "N5 X=1 Y=2"),
        ("N5 5=3 P1=5", "N5 P1=5"),
        ("N7 $IF = 5", "N7"),
        ("N7 #SLOPE [TYPE=", "N7"),
    ] {
        let (block, diagnostics) = parse(line);
        assert!(!diagnostics.is_empty(), "{line}");
        assert_eq!(block.to_string(), expected, "{line}");
        assert!(diagnostics.iter().all(|d| d.source.as_ref().is_some_and(|s| s.block.is_some())));
    }
}

#[test]
fn declarations() {
    for (line, expected) in [
        ("  V.P.COUNT : UNS32 = 4", "V.P.COUNT : UNS32 = 4"),
        ("V.L.TOL=0.01", "V.L.TOL = 0.01"),
        ("V.P.TAB[2][3] = [1,2,3,4,5,6]", "V.P.TAB[2][3] = [1, 2, 3, 4, 5, 6]"),
        ("V.L.NAME:string[20] = \"corner\"", "V.L.NAME : STRING[20] = \"corner\""),
        ("P7[10]", "P7[10]"),
        ("N10 V.S.SPEED", "N10 V.S.SPEED"),
        ("#ENDVAR", "#ENDVAR"),
    ] {
        let (block, diagnostics) = parse_as(line, Mode::Declaration);
        assert!(diagnostics.is_empty(), "{line}: {diagnostics:?}");
        assert_eq!(block.to_string(), expected, "{line}");
    }
    assert!(!parse_as("X10", Mode::Declaration).1.is_empty());
}

#[test]
fn a_branch_not_taken_is_hardly_looked_at() {
    for (line, expected) in [
        ("N10 X[[ }{", "N10"),
        ("N10: garbage", "N10:"),
        ("$ENDIF", "$ENDIF"),
        ("N5 $IF P1", "N5 $IF P1"),
        ("$GOTO [x", ""),
        ("#FOO [", ""),
    ] {
        let (block, diagnostics) = parse_as(line, Mode::Inactive);
        assert!(diagnostics.is_empty(), "{line}: {diagnostics:?}");
        assert_eq!(block.to_string(), expected, "{line}");
    }
    assert!(!parse_as("$IF P1=", Mode::Inactive).1.is_empty());
}

#[test]
fn too_deep_and_too_long() {
    let ids = |line: &str| {
        let mut ids: Vec<String> = refused(line).into_iter().map(|(id, _)| id).collect();
        ids.dedup();
        ids
    };
    assert_eq!(ids(&format!("X{}1{}", "[".repeat(1900), "]".repeat(1900))), ["20386"]);
    assert_eq!(ids(&"[".repeat(10_000)), ["20301"]);
    assert_eq!(ids(&format!("X1{}", "+1".repeat(1500))), ["K-0006"]);
    assert_eq!(ids(&format!("X{}", "-".repeat(3000))), ["K-0002"]);
    assert_eq!(ids(&format!("X{}5", "-".repeat(3000))), [""; 0]);
    assert_eq!(ids(&"X".repeat(3000)), ["K-0002"]);
    assert_eq!(ids(&format!("X{}", "SIN[".repeat(900))), ["20386"]);
    assert_eq!(ids(&format!("{}(", "(".repeat(3900))), [""; 0]);
    assert_eq!(ids(&format!("; {}", "x".repeat(4050))), ["20301"]);
    assert!(!parse(&format!("; {}", "x".repeat(4050))).1[0].is_error());
    assert!(parse(&format!("; {}", "x".repeat(5000))).1[0].is_error());
}

#[test]
fn items_keep_their_kind() {
    let Body::Command(command) = accepted("#E [ID455 NAME=a.nc A [1,2] \"t\" K P1]").body else {
        panic!()
    };
    let items = &command.groups[0].items;
    assert!(matches!(&items[0].kind, ItemKind::Flag(f) if f.split_number() == Some(("ID", 455.0))));
    assert!(
        matches!(command.groups[0].get("NAME"), Some(ItemValue::Name(n)) if &*n.text == "a.nc")
    );
    assert!(matches!(command.groups[0].get("A"), Some(ItemValue::List(l)) if l.items.len() == 2));
    assert!(matches!(&items[3].kind, ItemKind::Value(ItemValue::Expr(_))));
    assert!(command.is("E") && command.groups[0].has("id455"));
}

#[test]
fn notes_and_warnings() {
    let found = |line: &str| {
        let (_, diagnostics) = parse(line);
        diagnostics.iter().map(|d| (d.id.to_string(), d.severity)).collect::<Vec<_>>()
    };
    assert_eq!(found("#A [B=1 | C=2]"), [("K-0002".to_owned(), Severity::Note)]);
    assert_eq!(found("% Größe"), [("K-0001".to_owned(), Severity::Warning)]);
}

#[test]
fn errors_in_continued_lines_name_the_line() {
    let source = MemorySources::new().with("a.nc", "\r\nX1 \\\r\n N20 Y[1+*2]\r\n#A [B \\\n C]");
    let mut reader = BlockReader::new(source.open("a.nc", None).unwrap());
    let mut diagnostics = Vec::new();
    let parser = Parser::default();
    while let Some(raw) = reader.next_block().unwrap() {
        parser.block(&raw, &Arc::from("a.nc"), &mut diagnostics);
    }
    let place = diagnostics[0].source.as_ref().unwrap();
    assert_eq!((place.line, place.column, &*place.text), (3, 10, " N20 Y[1+*2]"));
    assert_eq!(diagnostics[1].severity, Severity::Note);
    assert_eq!(diagnostics.len(), 2);
}
