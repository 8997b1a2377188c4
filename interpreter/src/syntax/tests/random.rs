use super::{accepted, by_grammar, parse, parse_as, shape};
use crate::diag::Condition;
use crate::syntax::ast::{Body, Span};
use crate::syntax::{Mode, Plain};
use kontur_kit::pieces;
use proptest::prelude::*;

/// Lines that are plain or almost plain.
fn nearly_plain() -> impl Strategy<Value = String> {
    let number =
        prop_oneof!["-?[0-9]{1,5}(\\.[0-9]{0,6})?", "[-+]?\\.?[0-9]{0,20}", "-?0?\\.[0-9]{1,17}",];
    let word = prop_oneof![
        4 => ("[XYZABCIJKRFUW]", number).prop_map(|(l, n)| format!("{l}{n}")),
        2 => ("[XYZABCIJKRFUSTW]", "(=| |\\t| ?= ?|\\(a\\)=?|-|= -|==)", "-?[0-9]{1,3}(\\.[0-9]{0,3})?")
            .prop_map(|(l, e, n)| format!("{l}{e}{n}")),
        2 => "[GgMmHh][0-9]{1,3}",
        2 => "\\([a-zX1;äö\\[\\]\" ]{0,6}(\\([a-z]\\))?\\)",
        2 => ("(|=|-|=-| |- )", sum()).prop_map(|(e, sum)| format!("X{e}{sum}")),
        1 => "[A-Z]{1,2}[0-9]{0,3}",
        1 => "[ \\t;(P=.:#$@\"\\[\\]%/*-]{1,2}",
        1 => "(SIN|MOD|OR|AND|P1|V\\.P\\.A|PI|TRUE|N5)",
    ];
    let gap = prop_oneof![4 => Just(" "), 1 => Just(""), 1 => Just("\t ")];
    ("(/[0-9]{0,2} ?)?(N[0-9]{1,6} ?:?|)", prop::collection::vec((word, gap), 0..7)).prop_map(
        |(head, words)| words.into_iter().fold(head, |line, (word, gap)| line + &word + gap),
    )
}

/// Sums in brackets, and texts that look like them.
fn sum() -> impl Strategy<Value = String> {
    let value = prop_oneof![
        6 => "-?[0-9]{1,3}(\\.[0-9]{0,3})?",
        3 => "[Pp][0-9]{1,3}",
        1 => "(P1\\[2\\]|PP1|PI|P1a|SIN\\[3\\]|V\\.P\\.A|--1|\\.5|M3|)",
    ];
    let leaf = value.prop_map(String::from);
    leaf.prop_recursive(3, 16, 4, |inner| {
        let operator = prop_oneof![
            8 => "[-+*/]",
            1 => "(\\*\\*|MOD| OR |==|,)",
            2 => " ?[-+*/] ?",
            1 => "\\(a\\)[-+*/]",
        ];
        (inner.clone(), prop::collection::vec((operator, inner), 0..4), any::<bool>()).prop_map(
            |(first, rest, bracket)| {
                let sum = rest.into_iter().fold(first, |sum, (op, value)| sum + &op + &value);
                if bracket { format!("[{sum}]") } else { sum }
            },
        )
    })
    .prop_map(|sum| format!("[{sum}]"))
}

/// Every kind of construct, to be damaged and to be printed.
const LINES: &[&str] = &[
    "/3 N[P1+2] G01 X[P20*COS[P21]] Y-5 F[1000*P1]",
    "N10 [A] P1=5 P[P2+1]=PP3 V.P.TAB[2][3]=-V.A.-SWE.X ** 2 MOD 3",
    "N20: G80 [1, 2, , 4] M200=800 M@P6 H5=2 X1=10 AP-5 S[M3 REV1000] $GOTO [END]",
    "#VIB GUARD ON [MODE=2 FREQ 40, DAMPING=[P1+2]*3 | A=[1,2,[3]] HSC \"t\"]",
    "#DELETE V.P.A, V.P.B",
    "#CALL AX FAST [X,1,,0][Y,2,1]",
    "#WAIT FOR [P1 + 1] * 2 == TRUE",
    "L CYCLE [NAME=a\\b.nc @P1=5 MODAL_MOVE @P2=\"x\"]",
    "LL CYCLE [NAME=\"a b.nc\" @P3=[1+2]*V.P.A[1]] ",
    "$IF P1==2 && NOT[P2] || [1|2]&3 $GOTO N20",
    "$FOR P1 = 1, V.P.RUNS, -[P2 - 1]",
    "$SWITCH P1=INT[2.5]",
    "\"NAME\" = \"X\\\"1 (a\" X1 #FRC=5 \"NAME\" LL UP",
    "%L SQUARE ; x",
];

/// A line with some characters deleted, doubled or replaced.
fn damaged() -> impl Strategy<Value = String> {
    let change = (any::<prop::sample::Index>(), 0..4_u8, any::<char>());
    (prop::sample::select(LINES), prop::collection::vec(change, 0..4)).prop_map(
        |(line, changes)| {
            let mut chars: Vec<char> = line.chars().collect();
            for (index, kind, other) in changes {
                if chars.is_empty() {
                    break;
                }
                let at = index.index(chars.len());
                match kind {
                    0 => {
                        chars.remove(at);
                    }
                    1 => chars.truncate(at),
                    2 => chars.insert(at, chars[at]),
                    _ => chars[at] = other,
                }
            }
            chars.into_iter().collect()
        },
    )
}

/// Checks that the spans of a block are in the order of the text.
fn check_spans(line: &str) -> Result<(), TestCaseError> {
    let (block, diagnostics) = parse(line);
    let inside = |span: Span| {
        let (start, end) = (span.start as usize, span.end() as usize);
        start <= end && line.get(start..end).is_some()
    };
    prop_assert!(inside(block.span), "{line}");
    if let Body::Words(words) = &block.body {
        for word in words {
            prop_assert!(inside(word.span) && word.span.len > 0, "{line}: {word:?}");
        }
        for pair in words.windows(2) {
            prop_assert!(pair[0].span.end() <= pair[1].span.start, "{line}: {pair:?}");
        }
    }
    for diagnostic in diagnostics {
        let place = diagnostic.source.unwrap();
        prop_assert!(place.offset <= line.len() as u64);
        prop_assert!(place.column as usize <= line.chars().count() + 1);
    }
    Ok(())
}

/// print(parse(x)) parses to the same tree, and prints the same text.
fn check_print(line: &str, mode: Mode) -> Result<(), TestCaseError> {
    let (block, diagnostics) = parse_as(line, mode);
    if diagnostics.is_empty() {
        let printed = block.to_string();
        let (again, diagnostics) = parse_as(&printed, mode);
        prop_assert!(diagnostics.is_empty(), "{line}\n{printed}\n{diagnostics:?}");
        prop_assert_eq!(shape(&again), shape(&block), "{}\n{}", line, printed);
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn the_byte_loop_gives_the_tree_of_the_grammar(line in nearly_plain()) {
        let mut block = Plain::default();
        if block.recognize(line.as_bytes()).is_some() {
            let (expected, problems) = by_grammar(&line);
            prop_assert_eq!(problems, usize::from(block.frame.open_remark.is_some()), "{}", line);
            prop_assert_eq!(block.tree(), expected, "{}", line);
        }
    }

    #[test]
    fn damaged_lines_keep_spans_and_printing_in_order(line in damaged()) {
        check_spans(&line)?;
        check_print(&line, Mode::Block)?;
        check_print(&line, Mode::Inactive)?;
        check_print(&line, Mode::Declaration)?;
    }

    #[test]
    fn nearly_plain_lines_keep_spans_and_printing_in_order(line in nearly_plain()) {
        check_spans(&line)?;
        check_print(&line, Mode::Block)?;
    }

    #[test]
    fn garbage_never_panics(line in "\\PC{0,80}|[\\x00-\\x7f]{0,80}|[XP\\[\\]\"#$V.@,=+*(;0-9 -]{0,60}") {
        check_spans(&line)?;
        check_print(&line, Mode::Block)?;
        check_print(&line, Mode::Inactive)?;
        check_print(&line, Mode::Declaration)?;
    }
}

/// A cycle call with a mistake in its brackets is not a word of an axis `LCYCLE`, with or without a blank, and causes
/// the same message.
#[test]
fn a_damaged_cycle_call_stays_a_call() {
    for call in ["L CYCLE [", "L CYCLE[", "LCYCLE [", "LCYCLE[", "LLCYCLE [", "CYCLE ["] {
        let line = format!("{call}NAME=a.nc@P1=5 MODAL_MOVE @P2=\"x\"]");
        let (_, diagnostics) = parse_as(&line, Mode::Block);
        assert!(!diagnostics.is_empty(), "{line}");
        if call != "CYCLE [" {
            assert_eq!(diagnostics[0].id, Condition::TokenUnknown, "{line}");
        }
    }
}

#[test]
fn usual_lines_of_cam_programs_are_plain() {
    let lines = "N10 G1 X1.5 Y-2.25 Z0.000 ¦ G01X100.Y.5F2000 ¦ X1 ¦ N100 ¦ G2 X10 Y0 I5 J0 M8 S1200 T5 ¦ N5 X1 ; remark ( ¦  ; remark
N10: X1 (remark (in remark)) Y2 ¦ (remark) ¦ (before) N20 (between) X1(behind) ¦ N30 ( open ; X1 ¦ N30 X1 Y2 (open (in it) ; Z1
X[P1 + 2*[3 - P2]] Y[-5.5/2] Z[7] ¦ G01 X=1.5 Y = -2 F=1000 H5 ¦ X 1.5 Y -[P1+2] S=1000 M3 ¦ /N10 X1 ¦ /2 X(depth) =5 ¦ ";
    for line in pieces(lines) {
        let mut block = Plain::default();
        assert!(block.recognize(line.as_bytes()).is_some(), "{line}");
        assert_eq!(block.tree(), by_grammar(line).0, "{line}");
    }
    accepted("X1");
}
