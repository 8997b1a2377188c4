//! The first cases of the language: inputs and what they must give.

use super::{EndReason, assert_end, clean, run};

#[test]
fn words_and_comments() {
    assert_end("X--40 F100 ; remark", [40.0, 0.0, 0.0]);
    assert_end("g01 x1 \\\nN20 y2 f100", [1.0, 2.0, 0.0]);
}

#[test]
fn values_behind_g_functions() {
    let acc = |text: &str| {
        let run = clean(&format!("{text}\nG01 X1 F100\nM30\n"));
        run.blocks()[0].dynamics.axes[0].feed.acc_mm_s2
    };
    for text in ["G131 50", "G131=50", "G131 = 50"] {
        assert_eq!(acc(text), 1750.0);
    }
}

#[test]
fn programs_without_heads_and_ends() {
    let run = run("G01 X1 F100\n");
    assert_eq!((run.ids(), run.reason()), (vec!["K-0003".to_owned()], EndReason::Finished));
    assert_eq!(run.end, [1.0, 0.0, 0.0]);
    assert_end("%L UP\nX1\n%MAIN\nX2 F100", [2.0, 0.0, 0.0]);
    assert_end("%\nX2 F100", [2.0, 0.0, 0.0]);
    // what says nothing in front of a subroutine is not a main program
    for front in ["#COMMENT BEGIN\n%L X\nX9\n#COMMENT END", "(text)\n; more\n\n", "N10\nN20 (text)"]
    {
        assert_end(&format!("{front}\n%L UP\nX1\n%MAIN\nX2 F100"), [2.0, 0.0, 0.0]);
        assert_end(&format!("{front}\nX2 F100"), [2.0, 0.0, 0.0]);
    }
}

#[test]
fn line_ends_and_bytes_of_every_kind() {
    assert_end("X1 F100\rY2\r\nZ3", [1.0, 2.0, 3.0]);
    let bytes = b"\xEF\xBB\xBFX1 F100 (gr\xF6\xDFe)\nM30\n".to_vec();
    let sources = crate::source::MemorySources::new().with("main.nc", bytes);
    let run = super::run_with(sources, super::machine(&[]), super::Options::default());
    assert_eq!((run.ids().len(), run.end[0]), (0, 1.0));
}

#[test]
fn order_of_execution() {
    // plane, unit and dimension first, then offsets, feed and weights, then the motion, wherever they are written
    assert_end("X1 F100 G91\nX1 G91", [2.0, 0.0, 0.0]);
    assert_end("V.G.NP[1].V.X=5\nX1 F100 G54", [6.0, 0.0, 0.0]);
    assert_end("X1 G70 F100", [25.4, 0.0, 0.0]);
    assert_end("P1=1 X P1 P1=2 Y P1 F100", [1.0, 2.0, 0.0]);
    // the jump and the call come last
    assert_end("%L A\nX P1\n%MAIN\nF100 P1=3 Y1 LL A", [3.0, 1.0, 0.0]);
}

#[test]
fn the_start_state() {
    // G01, G17, G71, G90, G162, G165
    assert_end("X10 F100\nG02 X20 I5", [20.0, 0.0, 0.0]);
    let fed = super::run_with(
        crate::source::MemorySources::new().with("main.nc", "X10\nM30\n"),
        super::machine(&["channel.prog_start.feedrate=600"]),
        super::Options::default(),
    );
    assert!(fed.diagnostics.is_empty(), "{:?}", super::shown(&fed.diagnostics));
    let preset = super::run_with(
        crate::source::MemorySources::new().with("main.nc", "F100\nX1\nX1\nM30\n"),
        super::machine(&["channel.prog_start.g_gruppe[14].nr=91"]),
        super::Options::default(),
    );
    assert_eq!(preset.end[0], 2.0);
}

#[test]
fn the_list_of_first_cases() {
    assert_end("N30X100Y200F500", [100.0, 200.0, 0.0]);
    assert_end("G1 X10 (a (b) c) Y5 F100", [10.0, 5.0, 0.0]);
    assert_end("( N010 #SLOPE[TYPE=HSC]", [0.0; 3]);
}
