//! Recognises programs of other controls by words that this dialect does not have: one message names the word and the
//! control, instead of one message per character that does not fit.
//!
//! Sources: the programming manuals of LinuxCNC (O words, named and numbered parameters, G5.2), of Fanuc controls (custom
//! macro B), of Heidenhain controls (Klartext) and of Sinumerik controls.

#[cfg(test)]
mod tests;

use super::ast::Span;
use super::problem::Problem;
use crate::diag::Condition;

/// A word of another control found in a block, and the control.
struct Found {
    at: usize,
    length: usize,
    control: &'static str,
    meaning: &'static str,
}

impl Found {
    /// The equivalent in this dialect, if a few words describe it.
    fn hint(&self, word: &str) -> Option<&'static str> {
        let upper = word.to_ascii_uppercase();
        Some(match upper.as_str() {
            "STOPRE" => "#FLUSH WAIT stops decoding here",
            "MSG" => "#MSG [\"text\"] is a message here",
            "ROT" | "AROT" => "#ROTATION and #CS rotate the coordinates here",
            "TRANS" | "ATRANS" => "G54 to G59, G92 and #CS shift the coordinates here",
            "SUPA" => "G53 cancels the zero offsets here",
            "TRAORI" => "transformations are #TRAFO ON here",
            "GOTOF" | "GOTOB" => "$GOTO N20 and $GOTO [NAME] jump here",
            "CYCLE800" => "#CS ON [x,y,z,a,b,c] rotates the plane here",
            _ if upper.ends_with("=IC") || upper.ends_with("=AC") => {
                "coordinates are X10: incremental after G91, absolute after G90"
            }
            _ if self.meaning == DIMENSION => "modulo axes are C+90 and C-90 here",
            _ if self.meaning == CALL => "L file and LL NAME call subroutines here",
            _ if self.meaning == DATA => "V.G.NP[1].V.X=.. sets a zero offset here",
            _ if self.meaning == ARITHMETIC => "parameters are P1 and V.P.NAME here",
            _ => return None,
        })
    }
}

/// The message for a block of another control, which did not parse. In `masked`, comments and texts are blank.
pub(super) fn recognise(masked: &str) -> Option<Problem> {
    if masked.starts_with("t_s,") {
        let span = Span::new(0, masked.trim_ascii_end().len());
        let text = "this is a table of values over time (a trace or an input file), not a program";
        let hint = "use kontur diff to compare traces, run --input to read inputs; report and check take programs";
        return Some(Problem::new(Condition::ForeignProgram, span, text).hint(hint));
    }
    let found = klartext(masked)
        .or_else(|| label(masked))
        .or_else(|| o_word(masked))
        .or_else(|| synchronous_action(masked))
        .or_else(|| decimal_m(masked))
        .or_else(|| sinumerik(masked))
        .or_else(|| arithmetic_parameter(masked))
        .or_else(|| subprogram(masked))
        .or_else(|| data_setting(masked))
        .or_else(|| homing(masked))
        .or_else(|| numbered_parameter(masked))
        .or_else(|| decimal_g(masked))?;
    let word = masked.get(found.at..found.at + found.length)?;
    let text = format!(
        "`{word}` is {}: this is a program for {}, not for ISG and TwinCAT",
        found.meaning, found.control
    );
    let span = Span::new(found.at, found.at + found.length);
    let problem = Problem::new(Condition::ForeignProgram, span, text);
    Some(match found.hint(word) {
        Some(hint) => problem.hint(hint),
        None => problem,
    })
}

const LINUXCNC: &str = "LinuxCNC";
const MACRO_B: &str = "a control with macro B (Fanuc) or LinuxCNC";
const HEIDENHAIN: &str = "a Heidenhain control";
const SINUMERIK: &str = "a Sinumerik control";
const FANUC: &str = "a Fanuc control";
const CALL: &str = "a call of a subprogram";
const DATA: &str = "a setting of offsets or tools";
const DIMENSION: &str = "a coordinate with its dimension";
const ARITHMETIC: &str = "an arithmetic parameter";

/// The words at the beginning of Klartext blocks, after a number without a letter.
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
    const SINGLE: [&str; 12] =
        ["L", "CC", "C", "CR", "CT", "LP", "CP", "RND", "CHF", "LBL", "APPR", "DEP"];
    let numbered = masked.trim_ascii_start();
    let rest = numbered.trim_start_matches(|c: char| c.is_ascii_digit()).trim_ascii_start();
    let mut words = rest.split_ascii_whitespace();
    let first = words.next()?;
    let is_numbered = rest.len() < numbered.len();
    if is_numbered && SINGLE.iter().any(|word| word.eq_ignore_ascii_case(first)) {
        let at = masked.len() - rest.len();
        let (control, meaning) = (HEIDENHAIN, "a statement in Klartext");
        return Some(Found { at, length: first.len(), control, meaning });
    }
    let second = words.next()?;
    STATEMENTS
        .iter()
        .find(|(a, b)| a.eq_ignore_ascii_case(first) && b.eq_ignore_ascii_case(second))?;
    let at = masked.len() - rest.len();
    let length = rest.find(second)? + second.len();
    Some(Found { at, length, control: HEIDENHAIN, meaning: "a statement in Klartext" })
}

/// `LBL 1`, `CALL LBL 1`: labels of Klartext without a number before them.
fn label(masked: &str) -> Option<Found> {
    let words = |(at, word): &(usize, &str)| {
        word.eq_ignore_ascii_case("LBL")
            && masked[at + word.len()..]
                .trim_ascii_start()
                .starts_with(|c: char| c.is_ascii_digit())
    };
    let mut at = 0;
    let places = masked.split(' ').map(|word| {
        let place = (at, word);
        at += word.len() + 1;
        place
    });
    let (at, word) = { places }.find(words)?;
    let (control, meaning) = (HEIDENHAIN, "a label in Klartext");
    Some(Found { at, length: word.len(), control, meaning })
}

/// `M862.3`: M numbers of this dialect are integers.
fn decimal_m(masked: &str) -> Option<Found> {
    let (at, rest) = content(masked);
    let number = rest.strip_prefix(['M', 'm'])?;
    let whole = number.bytes().take_while(u8::is_ascii_digit).count();
    let tenths = number[whole..].strip_prefix('.')?;
    let tenths = tenths.bytes().take_while(u8::is_ascii_digit).count();
    (whole > 0 && tenths > 0).then_some(Found {
        at,
        length: 2 + whole + tenths,
        control: "a 3D printer",
        meaning: "an M function with a decimal point",
    })
}

/// `WHEN $AA_IM[X] > 1 DO ..`: synchronous actions.
fn synchronous_action(masked: &str) -> Option<Found> {
    const CONDITIONS: [&str; 4] = ["WHEN", "WHENEVER", "FROM", "EVERY"];
    let (at, rest) = content(masked);
    let mut words = rest.split_ascii_whitespace();
    let first = words.next()?;
    CONDITIONS.iter().find(|word| word.eq_ignore_ascii_case(first))?;
    words.find(|word| word.eq_ignore_ascii_case("DO"))?;
    let (control, meaning) = (SINUMERIK, "a synchronous action");
    Some(Found { at, length: first.len(), control, meaning })
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

/// `G5.2`, `G54.1`: G numbers of this dialect are integers.
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

/// Words of the Sinumerik language, as separate words outside brackets, and its dimensions `X=IC(10)`.
fn sinumerik(masked: &str) -> Option<Found> {
    const WORDS: [&str; 31] = [
        "PROC",
        "ENDPROC",
        "DEF",
        "EXTERN",
        "GOTOF",
        "GOTOB",
        "MCALL",
        "TRAORI",
        "TRAFOOF",
        "TRANS",
        "ATRANS",
        "ROT",
        "AROT",
        "ROTS",
        "MIRROR",
        "AMIRROR",
        "SUPA",
        "STOPRE",
        "MSG",
        "SETMS",
        "WAITP",
        "WAITM",
        "WORKPIECE",
        "COMPCAD",
        "COMPCURV",
        "COMPON",
        "COMPOF",
        "FFWON",
        "FFWOF",
        "BRISK",
        "CYCLE800",
    ];
    const DIMENSIONS: [&str; 5] = ["IC", "AC", "DC", "ACP", "ACN"];
    outside_brackets(masked).find_map(|(at, word)| {
        let is = |known: &&str| known.eq_ignore_ascii_case(word);
        let before = masked[..at].chars().next_back();
        match before {
            Some('=') if DIMENSIONS.iter().any(is) => {
                let name = last_word(&masked[..at - 1]).len();
                Some(Found {
                    at: at - 1 - name,
                    length: name + 1 + word.len(),
                    control: SINUMERIK,
                    meaning: DIMENSION,
                })
            }
            None | Some(' ' | '\t') if WORDS.iter().any(is) => {
                Some(Found { at, length: word.len(), control: SINUMERIK, meaning: "a keyword" })
            }
            _ => None,
        }
    })
}

/// `R5` as a value: in this dialect only R1 is one, the radius.
fn arithmetic_parameter(masked: &str) -> Option<Found> {
    words(masked).find_map(|(at, word)| {
        let index = word.strip_prefix(['R', 'r'])?;
        let calculates = masked[..at].trim_ascii_end().ends_with(['=', '+', '-', '*', '/', '[']);
        let is_one = !index.is_empty() && index.bytes().all(|b| b.is_ascii_digit());
        (calculates && is_one && index != "1").then_some(Found {
            at,
            length: word.len(),
            control: SINUMERIK,
            meaning: ARITHMETIC,
        })
    })
}

/// `M98 P1000`.
fn subprogram(masked: &str) -> Option<Found> {
    let mut last = (0, "");
    words(masked).find_map(|(at, word)| {
        let (before, m) = std::mem::replace(&mut last, (at, word));
        let program = word.strip_prefix(['P', 'p'])?;
        let is_number = program.starts_with(|c: char| c.is_ascii_digit());
        (m.eq_ignore_ascii_case("M98") && is_number).then_some(Found {
            at: before,
            length: at + word.len() - before,
            control: FANUC,
            meaning: CALL,
        })
    })
}

/// `G10 L2 P1 X0`: values of a table.
fn data_setting(masked: &str) -> Option<Found> {
    let mut words = words(masked).skip_while(|(_, word)| !word.eq_ignore_ascii_case("G10"));
    let (at, _) = words.next()?;
    let (table, word) = words.next()?;
    let number = word.strip_prefix(['L', 'l'])?;
    let is_number = !number.is_empty() && number.bytes().all(|b| b.is_ascii_digit());
    is_number.then_some(Found {
        at,
        length: table + word.len() - at,
        control: "a Fanuc control or LinuxCNC",
        meaning: DATA,
    })
}

/// `G28 W`: homing in a block that does not parse. Others are recognised where G functions are looked up.
fn homing(masked: &str) -> Option<Found> {
    let is_homing = |(_, word): &(usize, &str)| {
        ["G28", "G29", "G30"].iter().any(|known| known.eq_ignore_ascii_case(word))
    };
    let (at, word) = words(masked).find(is_homing)?;
    let control = "a 3D printer, a Fanuc control or LinuxCNC";
    Some(Found { at, length: word.len(), control, meaning: "homing or levelling" })
}

/// Runs of letters, digits and points, with their positions.
pub(super) fn words(masked: &str) -> impl Iterator<Item = (usize, &str)> {
    runs(masked).map(|(at, word, _)| (at, word))
}

/// The runs outside brackets.
fn outside_brackets(masked: &str) -> impl Iterator<Item = (usize, &str)> {
    runs(masked).filter(|(_, _, depth)| *depth == 0).map(|(at, word, _)| (at, word))
}

/// The letters, digits and points at the end.
fn last_word(text: &str) -> &str {
    &text[text
        .trim_end_matches(|c: char| c.is_ascii_alphanumeric() || matches!(c, '_' | '.'))
        .len()..]
}

fn runs(masked: &str) -> impl Iterator<Item = (usize, &str, usize)> {
    let is_part = |b: u8| b.is_ascii_alphanumeric() || matches!(b, b'_' | b'.');
    let bytes = masked.as_bytes();
    let (mut i, mut depth) = (0, 0_usize);
    std::iter::from_fn(move || {
        while i < bytes.len() {
            match bytes[i] {
                b'[' => depth += 1,
                b']' => depth = depth.saturating_sub(1),
                byte if is_part(byte) => {
                    let start = i;
                    i += bytes[i..].iter().take_while(|b| is_part(**b)).count();
                    return Some((start, &masked[start..i], depth));
                }
                _ => {}
            }
            i += 1;
        }
        None
    })
}

/// Position and text of the block after its number.
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
