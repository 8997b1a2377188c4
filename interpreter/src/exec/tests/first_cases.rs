//! The first cases of the language: inputs and what they must give.

use super::{EndReason, Sync, assert_end, checked, clean, places, run};

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
    // what says nothing in front of a subroutine is no main program
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
    // plane, unit and dimension first, then offsets, feed and weights, then the motion, wherever they stand
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

/// What a first case must give.
enum Expected {
    End([f64; 3]),
    Id(&'static str),
    Dwell(f64),
    Says(&'static str),
}

#[test]
fn the_list_of_first_cases() {
    use Expected::{Dwell, End, Id, Says};
    let table = "V.G.NP[1].V.X=10\n";
    for (text, expected) in [
        ("N30X100Y200F500", End([100.0, 200.0, 0.0])),
        ("G1 X10 (a (b) c) Y5 F100", End([10.0, 5.0, 0.0])),
        ("( N010 #SLOPE[TYPE=HSC]", End([0.0; 3])),
        ("#VIB GUARD ON [MODE=5]", Id("22062 1:16")),
        ("#FILTER ON [ORDER=5]\n#VIB GUARD ON", Id("22060 2:1")),
        ("G04 X2.5", Dwell(2.5)),
        ("G04 2.5", Dwell(2.5)),
        ("#TIME 2.5", Dwell(2.5)),
        ("G04 X2 Y3", Dwell(2.0)),
        ("G04 X2 Y3", Id("20685 1:8")),
        ("G01 X10", Id("20008 1:5")),
        ("X10 X20 F100", Id("20203 1:5")),
        ("G02 X10 I5 R5 F100", Id("21024 1:12")),
        (&format!("{table}G90 G54 X0 F100"), End([10.0, 0.0, 0.0])),
        (&format!("{table}G54 G91 X0 F100"), End([0.0; 3])),
        ("P1=5 X P1*2 F100", End([10.0, 0.0, 0.0])),
        ("X[-2*[3+4]] F100", End([-14.0, 0.0, 0.0])),
        ("P2=10/COS[90]", Id("20396 1:7")),
        ("P2=0\n$FOR P1=0,4,2\nP2=P2+1\n$ENDFOR\n#MSG [\"%d\", P2]", Says("3")),
        ("$SWITCH 1.0004\n$CASE 1\n#MSG [\"taken\"]\n$ENDSWITCH", Says("taken")),
        ("X--40 F100", End([40.0, 0.0, 0.0])),
        ("#FOO", Id("20509 1:1")),
        // 90-decisions: the slope's own number
        ("#SLOPE [TYPE=FOO]", Id("21629 1:9")),
        ("G7", Id("20131 1:1")),
        ("O100", Id("20191 1:1")),
        ("G21", Id("K-0101 1:1")),
        ("G21\nX5 F100", End([-5.0, 0.0, 0.0])),
        ("%L UP\nX1\n%MAIN\nF100 LL UP", End([1.0, 0.0, 0.0])),
    ] {
        let run = run(&format!("{text}\nM30\n"));
        match expected {
            End(end) => super::assert_near(&run.end, &end),
            Id(id) => {
                let found = places(&run.diagnostics);
                assert!(found.iter().any(|f| f == id), "{text}: {found:?}");
                // the check tells the same
                let found = places(&checked(&format!("{text}\nM30\n")));
                assert!(found.iter().any(|f| f == id), "{text}: {found:?}");
            }
            Dwell(seconds) => assert_eq!(run.syncs(), [&Sync::Dwell { seconds }], "{text}"),
            Says(message) => assert_eq!(run.messages(), [message], "{text}"),
        }
    }
    let weights = clean("G136 X80\nG137\nG135\nX1 F100\nM30\n");
    let last = weights.events().into_iter().rev().find_map(|e| match e {
        super::Event::Feedforward { on, weight_ratios } => Some((*on, weight_ratios[0])),
        _ => None,
    });
    assert_eq!(last, Some((true, 0.8)));
}
