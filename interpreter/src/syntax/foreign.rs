//! Programs of other controls, recognised by words that this dialect cannot have: one message names the word and the
//! control, instead of one for every character that does not fit.
//!
//! Sources: the programming manuals of LinuxCNC (O words, named and numbered parameters, G5.2), of Fanuc controls (custom
//! macro B), of Heidenhain controls (Klartext) and of Sinumerik controls.

use super::ast::Span;
use super::problem::Problem;
use crate::diag::Condition;

/// What a block of another control shows: the word and the control.
struct Found {
    at: usize,
    length: usize,
    control: &'static str,
    meaning: &'static str,
}

/// The message for a block of another control. `masked` is the block without comments and texts; it did not parse.
pub(super) fn recognise(masked: &str) -> Option<Problem> {
    if masked.starts_with("t_s,") {
        let span = Span::new(0, masked.trim_ascii_end().len());
        let text = "this is a table over time, a trace or a file of inputs, not a program";
        let hint =
            "kontur diff compares traces, run --input reads inputs, report and check take programs";
        return Some(Problem::new(Condition::ForeignProgram, span, text).hint(hint));
    }
    let found = klartext(masked)
        .or_else(|| o_word(masked))
        .or_else(|| sinumerik(masked))
        .or_else(|| numbered_parameter(masked))
        .or_else(|| decimal_g(masked))?;
    let word = masked.get(found.at..found.at + found.length)?;
    let text = format!(
        "`{word}` is {}: this is a program for {}, not for ISG and TwinCAT",
        found.meaning, found.control
    );
    let span = Span::new(found.at, found.at + found.length);
    Some(Problem::new(Condition::ForeignProgram, span, text))
}

const LINUXCNC: &str = "LinuxCNC";
const MACRO_B: &str = "a control with macro B (Fanuc) or LinuxCNC";
const HEIDENHAIN: &str = "a Heidenhain control";
const SINUMERIK: &str = "a Sinumerik control";

/// Two words with which Klartext blocks begin, after a number without letter.
fn klartext(masked: &str) -> Option<Found> {
    const STATEMENTS: [(&str, &str); 9] = [
        ("BEGIN", "PGM"),
        ("END", "PGM"),
        ("BLK", "FORM"),
        ("TOOL", "CALL"),
        ("TOOL", "DEF"),
        ("CYCL", "DEF"),
        ("CYCL", "CALL"),
        ("CALL", "LBL"),
        ("CALL", "PGM"),
    ];
    let numbered = masked.trim_ascii_start();
    let rest = numbered.trim_start_matches(|c: char| c.is_ascii_digit()).trim_ascii_start();
    let mut words = rest.split_ascii_whitespace();
    let (first, second) = (words.next()?, words.next()?);
    STATEMENTS
        .iter()
        .find(|(a, b)| a.eq_ignore_ascii_case(first) && b.eq_ignore_ascii_case(second))?;
    let at = masked.len() - rest.len();
    let length = rest.find(second)? + second.len();
    Some(Found { at, length, control: HEIDENHAIN, meaning: "a statement in Klartext" })
}

/// `o100 sub`, `o<name> call`.
fn o_word(masked: &str) -> Option<Found> {
    const KEYWORDS: [&str; 15] = [
        "SUB",
        "ENDSUB",
        "CALL",
        "RETURN",
        "IF",
        "ELSEIF",
        "ELSE",
        "ENDIF",
        "WHILE",
        "ENDWHILE",
        "DO",
        "REPEAT",
        "ENDREPEAT",
        "BREAK",
        "CONTINUE",
    ];
    let (at, rest) = content(masked);
    let behind = rest.strip_prefix(['O', 'o'])?;
    let name = match behind.strip_prefix('<') {
        Some(named) => named.find('>')? + 2,
        None => behind.bytes().take_while(u8::is_ascii_digit).count(),
    };
    let keyword = behind.get(name..)?.trim_ascii_start();
    let length = keyword.bytes().take_while(u8::is_ascii_alphabetic).count();
    let known = KEYWORDS.iter().any(|k| k.eq_ignore_ascii_case(&keyword[..length]));
    let length = rest.len() - keyword.len() + length;
    (name > 0 && known).then_some(Found { at, length, control: LINUXCNC, meaning: "an O word" })
}

/// `#100`, `#<name>`, `#[#1+2]`: a command of this dialect has a letter after `#`.
fn numbered_parameter(masked: &str) -> Option<Found> {
    masked.match_indices('#').find_map(|(at, _)| {
        let rest = &masked[at + 1..];
        match rest.as_bytes().first()? {
            b'<' => {
                let length = rest.find('>')? + 2;
                Some(Found { at, length, control: LINUXCNC, meaning: "a named parameter" })
            }
            b'0'..=b'9' => {
                let length = 1 + rest.bytes().take_while(u8::is_ascii_digit).count();
                Some(Found { at, length, control: MACRO_B, meaning: "a numbered parameter" })
            }
            b'[' => {
                Some(Found { at, length: 2, control: MACRO_B, meaning: "a computed parameter" })
            }
            _ => None,
        }
    })
}

/// `G5.2`, `G54.1`: G numbers of this dialect are whole.
fn decimal_g(masked: &str) -> Option<Found> {
    masked.match_indices(['G', 'g']).find_map(|(at, _)| {
        let word = masked[..at].chars().next_back();
        let digits = |text: &str| text.bytes().take_while(u8::is_ascii_digit).count();
        let rest = &masked[at + 1..];
        let whole = digits(rest);
        let tenths = rest[whole..].strip_prefix('.').map_or(0, digits);
        let begins = word.is_none_or(|c| !c.is_ascii_alphabetic() && c != '_' && c != '.');
        (begins && whole > 0 && tenths > 0).then_some(Found {
            at,
            length: 2 + whole + tenths,
            control: "LinuxCNC or a Fanuc control",
            meaning: "a G function with a decimal point",
        })
    })
}

/// Keywords of the Sinumerik language at the beginning of a block.
fn sinumerik(masked: &str) -> Option<Found> {
    const WORDS: [&str; 12] = [
        "PROC", "ENDPROC", "DEF", "EXTERN", "GOTOF", "GOTOB", "MCALL", "TRAORI", "TRANS", "ATRANS",
        "CYCLE800", "SUPA",
    ];
    let (at, rest) = content(masked);
    let length = rest.bytes().take_while(u8::is_ascii_alphanumeric).count();
    WORDS.iter().find(|w| w.eq_ignore_ascii_case(&rest[..length]))?;
    Some(Found { at, length, control: SINUMERIK, meaning: "a keyword" })
}

/// Where the block continues after its number.
fn content(masked: &str) -> (usize, &str) {
    let rest = masked.trim_ascii_start();
    let rest = match rest.strip_prefix(['N', 'n']) {
        Some(number) if number.starts_with(|c: char| c.is_ascii_digit()) => {
            number.trim_start_matches(|c: char| c.is_ascii_digit()).trim_ascii_start()
        }
        _ => rest,
    };
    (masked.len() - rest.len(), rest)
}

#[cfg(test)]
mod tests {
    use super::recognise;
    use crate::diag::Location;
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
        ] {
            let text = said(block).unwrap_or_default();
            assert!(text.contains(word) && text.contains(control), "{block}: {text}");
        }
    }

    #[test]
    fn mistakes_in_this_dialect_are_not_taken_for_another_one() {
        for block in [
            "N10 X1 {",
            "G1 X1.5 Y",
            "#SLOPE [TYPE=",
            "# SLOPE",
            "O1000 X",
            "X1.2.3",
            "V.G.G1.5 = ",
            "TOOL 1",
            "DEFAULT 5",
            "TRANSX 1",
            "é#é",
        ] {
            assert_eq!(said(block), None, "{block}");
        }
    }
}
