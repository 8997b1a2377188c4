use super::recognise;
use crate::diag::Location;
use kontur_kit::pieces;
use std::sync::Arc;

fn said(block: &str) -> Option<String> {
    let location = Location {
        file: Arc::from("p.nc"),
        line: 1,
        column: 1,
        offset: 0,
        length: 1,
        block: None,
        text: Arc::from(block),
    };
    recognise(block).map(|problem| problem.diagnostic(location).text)
}

#[test]
fn words_of_other_controls_are_named_whole() {
    for (block, word, control) in [
        ("#<depth> = 5", "`#<depth>`", "LinuxCNC"),
        ("G1 X[#<_x> + 5]", "`#<_x>`", "LinuxCNC"),
        ("o1000 sub", "`o1000 sub`", "LinuxCNC"),
        ("N5 O<bore> CALL [1]", "`O<bore> CALL`", "LinuxCNC"),
        ("#100=5", "`#100`", "macro B"),
        ("N10 IF [#1 EQ 2] GOTO 20", "`#1`", "macro B"),
        ("X#[#1+2]", "`#[`", "macro B"),
        ("G5.2 X1 P1", "`G5.2`", "Fanuc"),
        ("N10 G90G54.1 P1", "`G54.1`", "Fanuc"),
        ("0 BEGIN PGM PLATE MM", "`BEGIN PGM`", "Heidenhain"),
        ("12 TOOL CALL 3 Z S2000", "`TOOL CALL`", "Heidenhain"),
        ("N10 PROC BORE(REAL DEPTH)", "`PROC`", "Sinumerik"),
        ("DEF REAL DEPTH", "`DEF`", "Sinumerik"),
        ("N5 STOPRE", "`STOPRE`", "Sinumerik"),
        ("G0 G90 SUPA Z0 D0", "`SUPA`", "Sinumerik"),
        ("ROT RPL=45", "`ROT`", "Sinumerik"),
        ("G1 X=IC    ", "`X=IC`", "Sinumerik"),
        ("C=ACP", "`C=ACP`", "Sinumerik"),
        ("R1=R2+5", "`R2`", "Sinumerik"),
        ("X=R5", "`R5`", "Sinumerik"),
        ("N10 M98 P1000 L2", "`M98 P1000`", "Fanuc"),
        ("12 L X+10 Y+5 R0 FMAX M3", "`L`", "Heidenhain"),
        ("13 CC X+0 Y+0", "`CC`", "Heidenhain"),
        ("LBL 1", "`LBL`", "Heidenhain"),
        ("L P7 CALL LBL 1", "`LBL`", "Heidenhain"),
        ("N10 M862.3 P    ", "`M862.3`", "3D printer"),
        ("N5 WHEN TRUE DO $AA=1", "`WHEN`", "Sinumerik"),
    ] {
        let text = said(block).unwrap_or_default();
        assert!(text.contains(word) && text.contains(control), "{block}: {text}");
    }
}

#[test]
fn mistakes_in_this_dialect_are_not_taken_for_another_one() {
    let blocks = "N10 X1 { ¦ G1 X1.5 Y ¦ #SLOPE [TYPE= ¦ # SLOPE ¦ O1000 X ¦ X1.2.3 ¦ V.G.G1.5 =  ¦ TOOL 1 ¦ DEFAULT 5 ¦ TRANSX 1 ¦ é#é ¦ P3=RP2
P2=R1 ] ¦ V.P.ROT 5 ¦ [ROT ¦ M98 X ¦ LBL X ¦ WHEN X ¦ M8. X";
    for block in pieces(blocks) {
        assert_eq!(said(block), None, "{block}");
    }
}
