//! Diagnostics as text and as JSON.
//!
//! The text form is that of a compiler: severity, ID and message, the source line with carets, then values, reaction
//! and hint. A diagnostic of the running machine has a time instead of a source line.
//!
//! Order of calls: rendering is the last step of a diagnostic; it keeps no state.
//!
//! ```
//! use kontur_interpreter::diag::{Condition, Diagnostic, render};
//!
//! let said = Diagnostic::new(Condition::FeedZero, "feed is 0");
//! assert!(render::all(&[said.clone()]).starts_with("error[20008]: feed is 0"));
//! assert!(render::json(&said).starts_with('{'));
//! // what is quoted moves no cursor
//! assert_eq!(render::printable("a\u{1b}[2J"), "a\u{fffd}[2J");
//! ```

use crate::diag::{Datum, Diagnostic, Location, Severity, ValueKind, condition, rounded};
use annotate_snippets::{AnnotationKind, Group, Level, Message, Origin, Renderer, Snippet};

/// One JSON object on one line.
pub fn json(d: &Diagnostic) -> String {
    serde_json::to_string(d).unwrap_or_default()
}

/// The readable form of several diagnostics, without colours, each ending with a line end.
pub fn all(diagnostics: &[Diagnostic]) -> String {
    diagnostics.iter().map(|d| text(d, false) + "\n").collect()
}

/// The readable form, with colours for a terminal.
pub fn text(d: &Diagnostic, colours: bool) -> String {
    let level = match d.severity {
        Severity::Error => Level::ERROR,
        Severity::Warning => Level::WARNING,
        Severity::Note => Level::NOTE,
    };
    let head = level.primary_title(printable(&d.text)).id(d.id.to_string());
    let mut group = Group::with_title(head);
    if let Some(place) = &d.source {
        group = if place.text.is_empty() {
            group.element(
                Origin::path(place.file.to_string())
                    .line(index(place.line))
                    .char_column(index(place.column)),
            )
        } else {
            group.element(snippet(place))
        };
    }
    for note in notes(d) {
        group = group.element(note);
    }
    if let Some(hint) = &d.hint {
        group = group.element(Level::HELP.message(printable(hint)));
    }
    let renderer = if colours { Renderer::styled() } else { Renderer::plain() };
    renderer.render(&[group])
}

fn snippet(place: &Location) -> Snippet<'static, annotate_snippets::Annotation<'static>> {
    let text: String = place.text.to_string();
    let byte = |chars: usize| text.char_indices().nth(chars).map_or(text.len(), |(i, _)| i);
    let first = index(place.column).saturating_sub(1);
    let (start, end) = (byte(first), byte(first + index(place.length).max(1)));
    Snippet::source(text)
        .line_start(index(place.line))
        .path(place.file.to_string())
        .annotation(AnnotationKind::Primary.span(start..end))
}

fn notes(d: &Diagnostic) -> Vec<Message<'static>> {
    let note = |text: String| Level::NOTE.message(text);
    let mut notes = Vec::new();
    let mut place = Vec::new();
    if let Some(cycle) = d.cycle {
        let time = d.time_s.map_or_else(String::new, |t| format!(" (t = {t:.6} s)"));
        place.push(format!("at cycle {cycle}{time}"));
    } else if let Some(t) = d.time_s {
        place.push(format!("at t = {t:.6} s"));
    }
    if let Some(block) = d.source.as_ref().and_then(|s| s.block) {
        place.push(format!("block N{block}"));
    }
    if let Some(axis) = &d.axis {
        place.push(format!("axis {} ({})", axis.number, axis.name));
    }
    if let Some(parameter) = d.parameter {
        place.push(parameter.to_owned());
    }
    if !place.is_empty() {
        notes.push(note(place.join(", ")));
    }
    for call in &d.calls {
        let block = call.block.map_or_else(String::new, |number| format!(", block N{number}"));
        notes.push(note(format!("called at {}:{}{block}", call.file, call.line)));
    }
    if !d.values.is_empty() {
        let values: Vec<String> =
            d.values.iter().map(|v| value(v.kind, &v.value, v.unit)).collect();
        notes.push(note(values.join(", ")));
    }
    if let Some(corrected) = &d.correction {
        notes.push(note(format!("corrected to {}", datum(corrected, "-"))));
    }
    let row = condition::row(d.id);
    // a warning that is treated as an error here ends the operation of its caller, which its row does not cover
    if d.severity == Severity::Error
        && (row.severity == Severity::Error || row.reaction != condition::Reaction::None)
    {
        notes.push(note(format!(
            "reaction {}: {}; remedy {}: {}",
            row.reaction.class(),
            row.reaction.text(),
            row.remedy,
            row.remedy_text()
        )));
    }
    notes
}

fn value(kind: ValueKind, data: &Datum, unit: &str) -> String {
    let name = match kind {
        ValueKind::Limit => "limit",
        ValueKind::Current => "current value",
        ValueKind::Wrong => "wrong value",
        ValueKind::Expected => "expected value",
        ValueKind::Corrected => "corrected value",
        ValueKind::AxisNumber => "axis number",
        ValueKind::LowerLimit => "lower limit",
        ValueKind::UpperLimit => "upper limit",
        ValueKind::StartValue => "start value",
        ValueKind::TargetValue => "target value",
        ValueKind::Identification => "number",
        ValueKind::State => "state",
    };
    format!("{name} {}", datum(data, unit))
}

/// A value with its unit; the vendor's increments are converted to mm and deg.
fn datum(data: &Datum, unit: &str) -> String {
    match (data, unit) {
        (Datum::Text(t), _) => printable(t),
        (Datum::Number(v), "0.1um") => format!("{:.4} mm", v / 1e4),
        (Datum::Number(v), "1e-4deg" | "0.0001deg") => format!("{:.4} deg", v / 1e4),
        (Datum::Number(v), "" | "-") => number(*v),
        (Datum::Number(v), unit) => format!("{} {unit}", number(*v)),
    }
}

/// Whole numbers as they are (counts, lines, increments), others rounded; the JSON form has every digit.
fn number(v: f64) -> String {
    if v.fract().abs() > 0.0 { rounded(v) } else { v.to_string() }
}

/// Replaces characters that would move the cursor of a terminal, since a user's file may contain anything.
pub fn printable(text: &str) -> String {
    text.chars().map(|c| if c.is_control() && c != '\n' { '\u{FFFD}' } else { c }).collect()
}

fn index(n: u32) -> usize {
    usize::try_from(n).unwrap_or(usize::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diag::{Condition, ValueKind};

    fn place(text: &str, column: u32, length: u32) -> Location {
        Location {
            file: "part.nc".into(),
            line: 4,
            column,
            offset: 61,
            length,
            block: Some(40),
            text: text.into(),
        }
    }

    #[test]
    fn source_line_with_caret() {
        let d = Diagnostic::new(Condition::GUnknown, "unknown G function")
            .at(place("N40 G01 G777 X25 Y-3 F1500", 9, 4))
            .value(ValueKind::Current, 777.0, "-")
            .hint("G0 to G3 are motions");
        let text = text(&d, false);
        let expected = "\
error[20131]: unknown G function
 --> part.nc:4:9
  |
4 | N40 G01 G777 X25 Y-3 F1500
  |         ^^^^
  |
  = note: block N40
  = note: current value 777
  = note: reaction 2: the program is aborted, prepared blocks are still driven; remedy 3: reset of the channel
  = help: G0 to G3 are motions";
        assert_eq!(text, expected);
    }

    #[test]
    fn columns_count_characters() {
        let d = Diagnostic::new(Condition::InvalidCharacter, "invalid character").at(place(
            "(Öl) §1",
            6,
            1,
        ));
        let text = text(&d, false);
        assert!(text.contains("4 | (Öl) §1\n  |      ^\n"), "{text}");
    }

    #[test]
    fn running_machine_and_vendor_units() {
        let mut d = Diagnostic::new(
            Condition::SettlingTimeout,
            "axis Y not in the exact-stop window in time",
        )
        .axis(2, "Y")
        .value(ValueKind::Current, 1210.0, "0.1um")
        .value(ValueKind::Limit, 500.0, "0.1um");
        d.cycle = Some(1834);
        d.time_s = Some(1.834);
        d = d.value(ValueKind::Current, 0.475_431_558_039_517_2, "mm");
        let text = text(&d, false);
        assert!(text.contains("current value 0.47543 mm"), "{text}");
        assert!(text.starts_with("error[70082]: axis Y not in"), "{text}");
        assert!(text.contains("at cycle 1834 (t = 1.834000 s), axis 2 (Y)"), "{text}");
        assert!(text.contains("current value 0.1210 mm, limit 0.0500 mm"), "{text}");
    }

    #[test]
    fn strange_places_do_not_panic() {
        for (line, column, length) in
            [("", 1, 1), ("X", 9, 3), ("X", 0, 0), ("\tX1\u{1b}[2J", 2, 200), ("日本", 2, 1)]
        {
            let d =
                Diagnostic::new(Condition::Syntax, "a\u{7}b\nc").at(place(line, column, length));
            assert!(!text(&d, true).contains("\u{1b}[2J"), "{line:?}");
            assert!(!text(&d, false).is_empty());
        }
    }

    #[test]
    fn json_is_one_line() {
        let d = Diagnostic::new(Condition::Undefined, "a\nb").at(place("X", 1, 1));
        let json = json(&d);
        assert_eq!(json.lines().count(), 1);
        let value: serde_json::Value = serde_json::from_str(&json).unwrap();
        assert_eq!(value["kontur_id"], "K-0012");
        assert_eq!(value["id"], serde_json::Value::Null);
        assert_eq!(value["source"]["line"], 4);
    }
}
