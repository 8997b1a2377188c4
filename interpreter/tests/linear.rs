//! The work for a block is proportional to its length, whatever brackets it contains.
//!
//! Work is the number of calls made by the state machine of the grammar, which pest can limit; the limit is global, so this file is a target
//! with a single test. Where a limit is reached the result changes.

#![expect(clippy::unwrap_used, reason = "a test that fails here has failed")]

use kontur_interpreter::diag::Diagnostic;
use kontur_interpreter::source::RawBlock;
use kontur_interpreter::syntax::Parser;
use kontur_interpreter::syntax::ast::Block;
use kontur_kit::pieces;
use proptest::prelude::*;
use proptest::test_runner::TestRunner;
use std::num::NonZeroUsize;
use std::sync::Arc;

/// Calls per character for all ways of reading a block. Most texts need between 120 and 240.
const CALLS: usize = 500;

/// How a block is read.
#[derive(Clone, Copy, Debug)]
enum Reading {
    Block,
    Declaration,
    Inactive,
}

fn read(text: &str, reading: Reading, calls: usize) -> (Block, Vec<Diagnostic>) {
    pest::set_call_limit(NonZeroUsize::new(calls));
    let parser = Parser::new(["X1", "AP"]);
    let (raw, file) = (RawBlock::from_line(text), Arc::from("a.nc"));
    let mut diagnostics = Vec::new();
    let block = match reading {
        Reading::Block => parser.block(&raw, &file, &mut diagnostics),
        Reading::Declaration => parser.declaration(&raw, &file, &mut diagnostics),
        Reading::Inactive => parser.inactive(&raw, &file, &mut diagnostics),
    };
    (block, diagnostics)
}

/// Eight times the work gives the same result.
fn is_linear(text: &str) -> Result<(), TestCaseError> {
    let calls = CALLS * (text.len() + 20);
    for reading in [Reading::Block, Reading::Declaration, Reading::Inactive] {
        let (block, diagnostics) = read(text, reading, calls);
        let (again, more) = read(text, reading, 8 * calls);
        let shown: String = text.chars().take(200).collect();
        prop_assert_eq!(format!("{diagnostics:?}"), format!("{more:?}"), "{:?} {}", reading, shown);
        prop_assert_eq!(block, again, "{:?} {}", reading, shown);
    }
    Ok(())
}

/// Contents of brackets, and texts for which one of two ways of reading fails.
const TOKENS: &str = r#"[ ¦ [ ¦ [ ¦ [ ¦ [ ¦ ] ¦ ] ¦ A  ¦ A ¦   ¦ P ¦ P1 ¦ P1[ ¦ PP ¦ V.P.A ¦ V.P.A[ ¦ V. ¦ SIN[ ¦ MAX[1, ¦ MAX
1 ¦ - ¦ + ¦ = ¦ A= ¦ A=[ ¦ @P1=[ ¦ @ ¦ @A ¦ , ¦ | ¦ .5 ¦ X2.7 ¦ "t" ¦ " ¦ \" ¦ ! ¦ ! ¦ TRUE ¦ PI[ ¦ MOD
 OR  ¦ -[ ¦ 1-[ ¦ A -[ ¦ A[ ¦ A [ ¦ P[ ¦ S[A  ¦ X1= ¦ L CYCLE [ ¦ NAME= ¦ G80[ ¦ G1  ¦ M[ ¦ #FRC=
$GOTO [ ¦ N[ ¦ AP ¦ a.nc"#;

/// Beginnings of blocks.
const HEADS: &str = r#" ¦ G01 X ¦ G01 X[ ¦ #MSG  ¦ #MSG [ ¦ #VIB GUARD ON  ¦ #FOO [SIN[ ¦ L CYCLE [NAME=a @P1= ¦ S[M3  ¦ V.P.A=
V.P.A : REAL[3] = [ ¦ $IF  ¦ $FOR P1= ¦ G80 [ ¦ N[ ¦ "A"= ¦ P[ ¦ #FRC  ¦ M ¦ /1 N5: X ¦ ["#;

/// Text of a few tokens repeated, nested a few levels or over the whole length of a block, with some text after it.
fn text() -> impl Strategy<Value = String> {
    let token = || prop::sample::select(pieces(TOKENS));
    (
        prop::sample::select(pieces(HEADS)),
        prop::collection::vec(token(), 1..5),
        1..64_usize,
        prop::collection::vec(token(), 0..6),
        prop_oneof![Just(1_usize), 1..400_usize],
        prop::collection::vec(token(), 0..4),
    )
        .prop_map(|(head, nested, depth, middle, times, last)| {
            let part = nested.concat().repeat(depth) + &middle.concat();
            let closed = "]".repeat(part.matches('[').count());
            let unit = format!("{part}{}", if last.len() % 2 == 0 { &closed } else { "" });
            let mut text = head.to_owned();
            for _ in 0..times {
                if text.len() + unit.len() > 4_000 {
                    break;
                }
                text += &unit;
            }
            text + &last.concat()
        })
}

#[test]
fn brackets_cost_work_in_proportion_to_their_length() {
    let nested = [
        ("G01 X", "[A"),
        ("#MSG ", "[P["),
        ("#VIB GUARD ON ", "[A "),
        ("#FOO ", "[SIN["),
        ("#VAR V.P.A=", "[MAX[1,"),
        ("V.P.A=", "[MAX[1,"),
        ("L CYCLE [NAME=a @P1=", "[P["),
        ("#A ", "[A -"),
        ("#A ", "[1-"),
        ("#A ", "[V.P.A"),
        ("#A ", "V.P.A.5["),
        ("#A ", "[A=-"),
        ("#MSG ", "[P1A="),
        ("#A ", "[X P1A="),
        ("#A ", "[B=P1A="),
        ("#A ", "[[1,2],"),
        ("G01 X[", "A P1=["),
        ("#A [", "V.P.A=["),
        ("L CYCLE [NAME=a ", "@P1=["),
    ];
    for (head, level) in nested {
        let depth = 60 / level.matches('[').count();
        let open = level.repeat(depth);
        let close = "]".repeat(open.matches('[').count());
        for text in [
            format!("{head}{open}"),
            format!("{head}{open}{close}"),
            format!("{head}{open}1{close}"),
            format!("{head}{open}.5|A "),
        ] {
            is_linear(&text).unwrap();
        }
    }
    let flat = [
        "\\\"", "\"\\\"", "-", "[]", "[1]", "[A]", "P[1]", "A ", "(", "[P1]=", "X[A]", "X", "X!",
        "P ", "V.P.A@", "V.P[1].", "V.P.-",
    ];
    for unit in flat {
        is_linear(&format!("#A [{}", unit.repeat(4000 / unit.len()))).unwrap();
        is_linear(&unit.repeat(4000 / unit.len())).unwrap();
    }
    // a row of names is skipped as one, however long it is
    for names in [1, 20, 100, 400, 900] {
        let row = "AP".repeat(names) + "[";
        is_linear(&row.repeat(3_900 / row.len())).unwrap();
    }
    // so is a variable whose last bracket stays open
    for part in ["V.P.A@A", "V.P[1].", "V.P[1]@A", "@AV.P.-A"] {
        is_linear(&format!("V.P.A=@A{}V.P.A[", part.repeat(3_900 / part.len()))).unwrap();
    }
    let mut runner = TestRunner::new(ProptestConfig::with_cases(3000));
    runner.run(&text(), |text| is_linear(&text)).unwrap();
    no_two_tokens_double_the_work_with_every_level();
}

/// Every two tokens, nested without an end: reading a bracket twice doubles the work with every level.
fn no_two_tokens_double_the_work_with_every_level() {
    let tokens = pieces(TOKENS);
    for head in ["", "G01 X[", "#A [", "L CYCLE [NAME=a "] {
        for first in &tokens {
            for second in &tokens {
                is_linear(&format!("{head}{}", format!("{first}{second}").repeat(16))).unwrap();
            }
        }
    }
}
