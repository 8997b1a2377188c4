//! Random programs: for any text the executor ends, with a step and without a panic.

use super::{Options, machine, run_with};
use crate::exec::check;
use crate::source::MemorySources;
use kontur_kit::{Random, pieces};

/// Words, commands and statements, valid and invalid ones.
pub(super) const PIECES: &str = r#"X1 ¦ Y-2.5 ¦ Z[P1*2] ¦ G00 ¦ G01 ¦ G02 ¦ G03 I5 ¦ R10 ¦ F100 ¦ G90 ¦ G91 ¦ G41 ¦ G42 ¦ G40 ¦ D1 ¦ G54 ¦ G92 X1
G21 ¦ G23 ¦ G68 R30 ¦ G69 ¦ G301 I1 ¦ G302 I1 ¦ G60 ¦ G261 ¦ G260 ¦ G04 1 ¦ M3 S100 ¦ M30 ¦ M17 ¦ P1=1
P1=P1+1 ¦ P2=P1/P3 ¦ V.P.A=P1 ¦ V.L.B=2 ¦ X V.A.ABS.X ¦ X V.A.ACT_POS.X ¦ T1 ¦ "M"="X5" ¦ "M" ¦ S[G135]
X[OVERRIDE FEED_FACT=50] ¦ LL SUB ¦ LL SELF ¦ L other.nc ¦ L CYCLE [NAME=c.nc @P1=1] ¦ $GOTO N5 ¦ K3 Z9
#CHR=1 ¦ #PSET X3 ¦ #SUPPRESS OFFSETS ¦ G18 ¦ G131=50 ¦ G95 ¦ E50 ¦ Q4"#;

pub(super) const LINES: &str = r#"$IF P1 < 3 ¦ $ELSEIF P1 ¦ $ELSE ¦ $ENDIF ¦ $FOR P1=1,3,1 ¦ $ENDFOR ¦ $WHILE P1<5 ¦ $ENDWHILE ¦ $DO
$ENDDO P1<4 ¦ $REPEAT ¦ $UNTIL P1>2 ¦ $SWITCH P1 ¦ $CASE 1 ¦ $DEFAULT ¦ $ENDSWITCH ¦ $BREAK ¦ $CONTINUE
#VIB GUARD ON [MODE=2 FREQ=40 AX_DEV=0.01] ¦ #VIB GUARD OFF ¦ #FILTER ON ¦ #FLUSH WAIT ¦ #SLOPE [TYPE=STEP]
#CS ON [1,2,3,0,0,90] ¦ #CS OFF ALL ¦ #SCALE ON X2 Y2 ¦ #SCALE X0.5 Z3 ¦ #SCALE OFF
S[OVERRIDE SPEED_FACT=50] ¦ #ROTATION ON [ANGLE=30] ¦ #ROTATION OFF ¦ #CONTOUR MODE ON ¦ #HSC ON [BSPLINE]
#VAR ¦ V.L.B : UNS32 = 1 ¦ #ENDVAR ¦ #COMMENT BEGIN ¦ #COMMENT END ¦ #IF P1 ¦ #ELSE ¦ #ENDIF ¦ #PUT AX [X]
#CALL AX [X,1,0] ¦ #FGROUP [X,Y] ¦ #MSG ["%d", P1] ¦ #DELETE P1 ¦ % text ¦ %L LATE ¦ N5: X1 ¦ [LABEL] Y1
#CHANNEL INIT [ACTPOS] ¦ G100 X1 F100 ¦ G310 G01 Y5 F100 $GOTO N10 ¦ #MEAS MODE [5] ¦ G101 X2 Y-1 ¦ G102
G11 G41 ¦ Y[OSC ON 1ST_POS=1 2ND_POS=2 FEED=100] ¦ Y[OSC OFF] ¦ #TIME 0.5
#MACHINE DATA [AX=X AXPARAM="getriebe[0].kv 3000"] ¦ /2 X7 ¦ ( ¦ #FOO [ ¦ $FOO"#;

fn program(random: &mut Random) -> String {
    let (words, lines) = (pieces(PIECES), pieces(LINES));
    let mut text = String::from("%L SUB\nG91 X1\nM17\n%L SELF\nLL SELF\n%MAIN\n");
    for _ in 0..random.below(30) {
        if random.below(3) == 0 {
            text.push_str(random.pick(&lines));
        } else {
            for _ in 0..=random.below(4) {
                text.push_str(random.pick(&words));
                text.push(' ');
            }
        }
        text.push('\n');
    }
    text
}

#[test]
fn random_programs_end() {
    let machine = machine(&[]);
    let mut random = Random::new(1);
    for _ in 0..400 {
        let text = program(&mut random);
        let sources = MemorySources::new().with("main.nc", text).with("c.nc", "X @P1\nG91\n");
        let options = Options { max_blocks: 2000, max_blocks_at_rest: 500, ..Options::default() };
        let shared = std::sync::Arc::new(sources.clone());
        let _ = check(shared, "main.nc", std::sync::Arc::clone(&machine), options.clone());
        let run = run_with(sources, std::sync::Arc::clone(&machine), options);
        assert!(run.end.iter().all(|x| x.is_finite()));
        // motions are continuous
        for pair in run.blocks().windows(2) {
            let (end, start) = (pair[0].path.end(), pair[1].path.start());
            let gap = end.iter().zip(start.iter()).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(
                gap < 1e-9 || run.diagnostics.iter().any(|d| d.id.to_string() == "K-0017"),
                "{gap}"
            );
        }
    }
}
