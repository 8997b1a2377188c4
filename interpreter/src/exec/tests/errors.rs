//! Error IDs with their places, the syntax check, and the example programs of the language chapter.

use super::{assert_near, checked, clean, places, run};

#[test]
fn words_that_are_only_ignored_warn_once() {
    let run = run("G08 X1 F100\nG08 X2\n#TOOL DATA\n#LAH [1]\nM30\n");
    assert_eq!(run.ids(), ["K-0100", "K-0100", "K-0100"]);
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
