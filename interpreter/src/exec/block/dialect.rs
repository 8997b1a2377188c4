//! Words with a different meaning in other controls, and their meaning in this dialect.

use super::collected::{Code, Words};
use crate::diag::{Condition, Id};
use crate::exec::fault::Fault;
use crate::exec::report::{Report, Subject};
use crate::syntax::ast::{Expr, ExprKind, GValue, Span};

/// Whether an error is one that a file of another control repeats in every line: unassigned G functions (20131) and parameters
/// without a value (20194), each separately, and O words (20191, 20192).
pub(in crate::exec) fn is_foreign_word(id: Id) -> bool {
    [
        Condition::GUnknown,
        Condition::OFormat,
        Condition::ONotImplemented,
        Condition::AssignmentExpected,
    ]
    .iter()
    .any(|condition| id == *condition)
}

/// Hint for a G number that is not assigned here.
pub(crate) fn unknown_g(number: u32) -> Option<&'static str> {
    Some(match number {
        28 | 30 => {
            "reference points of other controls do not exist here; use G74 for homing, G53 to cancel offsets"
        }
        43 | 44 | 49 => "tool length is selected with D here (D0 cancels it)",
        7 => {
            "G07 of other controls is diameter programming (G51 here) or cylindrical interpolation (#CYL here); neither is simulated"
        }
        64 => "contouring is programmed with G261 and #CONTOUR MODE here",
        15 | 16 => "polar coordinates of other controls do not exist here",
        50 => "#SCALE scales here",
        _ if is_call(number) => "subroutines are called with L, LL and L CYCLE here",
        500 => "G53 cancels the zero offsets here",
        505..=599 => "zero offsets are G54 to G59 and G159=number here",
        73 | 76 => "drilling cycles are L CYCLE calls here",
        _ => return None,
    })
}

/// Evidence that a program is written for this dialect.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(in crate::exec) struct Seen {
    /// G22, G23, G351, G70 or G71: G20 and G21 are then used in their meaning here.
    unit_or_mirror: bool,
    /// `#` commands, `$` statements or G numbers from 127 on.
    own: bool,
    other: Other,
}

/// Evidence that a program is written for another control.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Other {
    #[default]
    Nothing,
    /// An M function that sets a temperature in programs of 3D printers.
    Temperature,
    /// A block that begins with an O word: the number of a Fanuc program.
    ProgramNumber,
}

impl Seen {
    /// A statement that only this dialect has.
    pub(in crate::exec) fn own_statement(&mut self) {
        self.own = true;
    }

    /// K-0120 for G28, G29 and G30 unless the program is one of this dialect.
    pub(super) fn homing(self, number: u32, span: Span) -> Option<Box<Fault>> {
        let word = format!("G{number}");
        match number {
            28 | 29 if self.other == Other::Temperature && !self.own => {
                Some(printer(&word, "homes or levels after a temperature", span))
            }
            28 | 30 if !self.own => {
                let text = format!(
                    "`{word}` moves to a reference point: this is a program for a Fanuc control, LinuxCNC or a 3D printer, not for ISG and TwinCAT"
                );
                let hint = "G74 homes the axes here, G53 cancels zero offsets";
                Some(Fault::new(Condition::ForeignProgram, text, span).hint(hint))
            }
            _ => None,
        }
    }

    /// A block that begins with an O word, whose message is 20192.
    pub(in crate::exec) fn program_number(&mut self) {
        self.other = Other::ProgramNumber;
    }

    /// Whether the messages so far show a program of another control, so that its other blocks are not checked.
    pub(in crate::exec) fn ends_check(self) -> bool {
        self.other == Other::ProgramNumber
    }

    /// K-0120 for a block that only a 3D printer understands: G92 with the position of an extruder.
    pub(super) fn is_of_a_printer(&mut self, words: &Words<'_>, report: &mut Report) -> bool {
        if is_temperature(words) {
            self.other = Other::Temperature;
        }
        let ([g], [], Some((_, end))) = (&words.g[..], &words.axes[..], words.end_feed) else {
            return false;
        };
        if g.row.number != 92 || self.own {
            return false;
        }
        let span = Span::new(g.span.start as usize, end.end() as usize);
        report.note(printer("G92 E", "sets the position of an extruder", span));
        true
    }

    /// Words with another meaning in other dialects: reported once per program and word.
    pub(super) fn guard(&mut self, words: &Words<'_>, report: &mut Report) {
        let mirrors =
            self.unit_or_mirror || words.g.iter().any(|g| matches!(g.row.number, 70 | 71));
        for g in &words.g {
            match g.row.number {
                22 | 23 | 70 | 71 | 351 => self.unit_or_mirror = true,
                n if n >= 127 => self.own = true,
                _ => {}
            }
            let known =
                if matches!(g.row.number, 20 | 21) { self.unit_or_mirror } else { self.own };
            if let (false, Some(text)) = (known, g_function(g.row.number)) {
                let fault = Fault::new(Condition::Dialect, text, g.span);
                report.note_once(Subject::G(g.row.number), fault);
            }
        }
        if !self.own {
            for (subject, text, span) in beside_others(words, mirrors) {
                report.note_once(subject, Fault::new(Condition::Dialect, text, span));
            }
        }
        if let (false, Some((tool @ 100.0..1000.0, span))) = (self.own, words.tool)
            && span.len == 5
        {
            let text = format!(
                "T with a leading zero is tool {tool} in this dialect: it is not a tool and its offset in two figures each"
            );
            let hint = "write T1 D1 for tool 1 with its offset 1";
            report.note_once("T", Fault::new(Condition::Dialect, text, span).hint(hint));
        }
        // a negative one is a separate error
        let end_feed = words.end_feed.filter(|(value, _)| *value >= 0.0);
        if let (false, Some((value, span))) = (self.own, end_feed) {
            let joined = words.axes.iter().any(|(_, _, axis)| axis.end() == span.start);
            let text = if joined {
                format!(
                    "numbers cannot have an exponent in this dialect: E{value} is the feed at the end of the block"
                )
            } else {
                "E is the feed at the end of the block in this dialect, not an extruder axis"
                    .to_owned()
            };
            report.note_once("E", Fault::new(Condition::Dialect, text, span));
        }
    }
}

/// Words that mean something else beside the other words of their block, as programs of other controls have them:
/// `G23 G40` (stored limits), `G98 R2` (where a drilling cycle returns to) and `M29 S1000` (rigid tapping).
///
/// `mirrors`: G70, G71 or mirroring has shown that G22 and G23 are meant as they are here.
fn beside_others<'w>(
    words: &'w Words<'_>,
    mirrors: bool,
) -> impl Iterator<Item = (Subject, &'static str, Span)> + 'w {
    let cancels = !mirrors && words.g.iter().any(|g| g.row.number == 40);
    let of_g = words.g.iter().filter_map(move |g| {
        let number = g.row.number;
        let text = match number {
            22 if cancels => "G22 mirrors about X in this dialect (Y changes sign), it does not switch stored limits on",
            23 if cancels => "G23 mirrors about X and Y in this dialect, it does not switch stored limits off",
            98 | 99 if words.radius.is_some() => {
                "G98 and G99 set software limits in this dialect; they do not belong to a drilling cycle"
            }
            _ => return None,
        };
        Some((Subject::G(number), text, g.span))
    });
    let turns = words.speeds.iter().any(|(_, speed, _)| *speed > 0.0);
    let turns = turns && !words.m.iter().any(|m| m.number == 5);
    let tapping = words.m.iter().filter(move |m| m.number == 29 && turns);
    let text = "M29 ends a program in this dialect; G63 and G331 tap";
    of_g.chain(tapping.map(move |m| (Subject::M(29), text, m.span)))
}

/// Whether a block sets a temperature of a 3D printer: `M104 S200`, `M109`, `M140`, `M190`. Such a block is also valid in this
/// dialect, so it proves nothing by itself.
fn is_temperature(words: &Words<'_>) -> bool {
    let code = matches!(words.m[..], [Code { number: 104 | 109 | 140 | 190, .. }]);
    code && words.speeds.len() == 1 && words.axes.is_empty() && words.g.is_empty()
}

/// K-0120 for a word of 3D printers.
pub(in crate::exec) fn printer(word: &str, meaning: &str, span: Span) -> Box<Fault> {
    let text = format!(
        "`{word}` {meaning}: this is a program for a 3D printer (Marlin, Klipper), not for ISG and TwinCAT"
    );
    Fault::new(Condition::ForeignProgram, text, span)
}

/// K-0120 for a name with a value that occurs in Sinumerik programs only: `CYCLE81(..)`, `CR=5`. A number that follows
/// without `=` is part of the word.
pub(in crate::exec) fn sinumerik(name: &str, value: &Expr, span: Span) -> Option<Box<Fault>> {
    let (meaning, hint) = match name.to_ascii_uppercase().as_str() {
        "CYCLE" | "HOLES" | "POCKET" | "SLOT" | "LONGHOLE" => {
            ("a cycle", "cycles are files here: L CYCLE [NAME=\"file\" @P1=..]")
        }
        "CR" => ("the radius of an arc", "write R: G02 X10 R5"),
        "RPL" => ("an angle of rotation", "#ROTATION [ANGLE=..] rotates the plane here"),
        _ => return None,
    };
    let number = match value.kind {
        ExprKind::Number(number) => number.to_string(),
        _ => String::new(),
    };
    let joined = name.len() + number.len() == span.len as usize;
    let number = if joined { &*number } else { "" };
    let text = format!(
        "`{name}{number}` is {meaning}: this is a program for a Sinumerik control, not for ISG and TwinCAT"
    );
    Some(Fault::new(Condition::ForeignProgram, text, span).hint(hint))
}

/// K-0120 for `G5 P10000` and `G8 P1`: high-speed modes of Fanuc controls.
pub(in crate::exec) fn high_speed(number: u32, value: &GValue, span: Span) -> Option<Box<Fault>> {
    let GValue::Scalar(expr) = value else { return None };
    let is_parameter = matches!(&expr.kind, ExprKind::Place(_));
    let text = format!(
        "`G{number} P` is a high-speed mode: this is a program for a Fanuc control, not for ISG and TwinCAT"
    );
    (matches!(number, 5 | 8) && is_parameter).then(|| {
        let hint = "#CONTOUR MODE and #HSC smooth the path here";
        Fault::new(Condition::ForeignProgram, text, span).hint(hint)
    })
}

/// Whether it is a subroutine call of another control, in which the words are arguments.
pub(in crate::exec) fn is_call(number: u32) -> bool {
    (65..=67).contains(&number)
}

/// Meaning here of a G function that has another meaning in other dialects.
pub(in crate::exec) fn g_function(number: u32) -> Option<&'static str> {
    Some(match number {
        20 => "G20 switches mirroring off in this dialect; inch is G70",
        21 => "G21 mirrors about Y in this dialect (X changes sign); metric is G71",
        61 => {
            "G61 rounds the corner at the end of the block in this dialect; an exact stop is G60 or G360"
        }
        93 => {
            "F is the time of the block in seconds after G93 in this dialect, not its inverse per minute"
        }
        _ => return None,
    })
}

/// Hint for a letter that is not an address here.
pub(in crate::exec) fn letter(letter: u8) -> &'static str {
    match letter {
        b'M' => "M needs a number",
        b'P' => "assign a parameter with =: P1=5",
        _ => "valid words are G M H T D F E S I J K R L N, the axes, P.. = and V... =",
    }
}

/// M functions of other controls.
pub(in crate::exec) fn m_function(number: u32) -> Option<&'static str> {
    match number {
        98 => Some("M98 does not call a subroutine here: use L file or LL NAME"),
        99 => Some("M99 does not end a subroutine here: use M17 or M29"),
        _ => None,
    }
}
