//! `#MSG`, `#ADD` and `#ERROR`.
//!
//! Source: TF5200 programming manual; 21232 for an unknown format, 21710 (255759243).

use super::keys::arguments;
use super::range::between;
use super::row::{Call, Row};
use crate::diag::{Condition, Diagnostic, Severity, ValueKind};
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::options::Value;
use crate::exec::step::Event;
use crate::machine::DiagnosisMessages;
use crate::syntax::ast::{Expr, Group, HashWord, ItemKind, ItemValue, Span};

/// Receivers of a message.
const RECEIVERS: &[&str] = &["ISG_DIAG_BED", "HMI", "PLC", "DIAG", "EVENT_LOGGER"];

/// Modes and destinations; all of them write to the same log.
const MODES: &[&str] = &["SYN", "SYN_ACK", "ACK", "SAVE", "EXCLUSIVE", "CONTINUE", "INFO"];

/// Row of `#MSG`.
pub(super) const MSG: Row = Row::run("MSG", message)
    .several()
    .form("#MSG [\"text\", values]")
    .meaning("message of the program")
    .note("formats %s %S %d %D %f %F")
    .example("#MSG [\"part %d done\", P1]")
    .related(&["21232", "P-CHAN-00518"]);

/// `#MSG [SYN|..] [receiver] ["text", values]`.
fn message(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    let mut receiver = RECEIVERS[0].to_owned();
    let mut save = false;
    for (i, word) in call.rest.iter().enumerate() {
        if call.rest[..i].iter().any(|other| other.is(&word.text)) {
            let text = format!("#MSG: {} twice", word.text);
            return Err(Fault::new(Condition::MessageWordTwice, text, word.span));
        }
        if RECEIVERS.iter().any(|r| word.is(r)) {
            receiver = word.text.to_string();
        } else if !MODES.iter().any(|m| word.is(m)) {
            return Err(call.unexpected(word));
        }
        save |= word.is("SAVE");
    }
    let text = text_of(decoder, "#MSG", call.command.groups.last(), call.span())?;
    send(decoder, receiver, save, text, call.span())
}

/// `#ADD [receiver] ["text", values]` at the end of a block: the message of `#MSG SYN` after the actions of the block.
///
/// Source: TF5200 programming manual 207177099, tccncprogramming 15556955787.
pub(in crate::exec) fn addition(decoder: &mut Decoder, hash: &HashWord, span: Span) -> Outcome<()> {
    let mut receiver = RECEIVERS[0].to_owned();
    for word in hash.name.split(' ').skip(1) {
        if !RECEIVERS.contains(&word) {
            let text = format!("#ADD: unexpected `{word}`");
            return Err(Fault::new(Condition::TokenUnknown, text, span).hint(
                "only a receiver may precede the bracket, not a mode: the command acts as SYN",
            ));
        }
        word.clone_into(&mut receiver);
    }
    let text = text_of(decoder, "#ADD", hash.bracket.as_ref(), span)?;
    send(decoder, receiver, false, text, span)
}

/// The text in a bracket with its values.
fn text_of(decoder: &Decoder, title: &str, group: Option<&Group>, span: Span) -> Outcome<String> {
    let wrong =
        |text: &str, span| Fault::new(Condition::TokenUnknown, format!("{title}{text}"), span);
    let Some(group) = group else { return Err(wrong(" needs [\"text\"]", span)) };
    let mut items = Vec::new();
    for item in &group.items {
        match &item.kind {
            ItemKind::Value(ItemValue::Expr(expr)) => items.push(expr),
            ItemKind::Missing => {
                let text = format!("{title}: a value is expected after the comma");
                return Err(Fault::new(Condition::MessageValue, text, item.span));
            }
            _ => return Err(wrong(": a text or value is expected", item.span)),
        }
    }
    let Some((format, values)) = items.split_first() else {
        return Err(wrong(" needs a text", group.span));
    };
    let Value::Text(format_text) = decoder.value(format)? else {
        return Err(wrong(": the text comes first", format.span));
    };
    formatted(decoder, &format_text, format.span, values)
}

/// Outputs a message, unless the channel list discards it.
fn send(
    decoder: &mut Decoder,
    receiver: String,
    save: bool,
    text: String,
    span: Span,
) -> Outcome<()> {
    if receiver.eq_ignore_ascii_case(RECEIVERS[0]) && !save {
        let discarded = |condition| {
            let hint =
                "messages to ISG_DIAG_BED are discarded by the channel list; name another receiver";
            Fault::new(condition, format!("message discarded: {text}"), span).hint(hint)
        };
        match decoder.machine.channel.diagnosis_messages {
            DiagnosisMessages::Standard => {}
            DiagnosisMessages::Disabled => return Ok(()),
            DiagnosisMessages::Warning => {
                let fault = discarded(Condition::MessageSuppressed).warning();
                decoder.report.note(fault);
                return Ok(());
            }
            DiagnosisMessages::Error => {
                return Err(discarded(Condition::MessageForbidden));
            }
        }
    }
    let source = decoder.report.source;
    decoder.contour.event(Event::Message { receiver, text, save, source });
    Ok(())
}

/// Replaces `%d`, `%f`, `%s` by the values in order, as `printf` does (207145355).
fn formatted(decoder: &Decoder, format: &str, at: Span, values: &[&Expr]) -> Outcome<String> {
    let mut text = String::new();
    let mut values = values.iter();
    let mut chars = format.chars();
    while let Some(c) = chars.next() {
        if c != '%' {
            text.push(c);
            continue;
        }
        let mut form = Form::default();
        let letter = loop {
            match chars.next() {
                Some(c) if form.takes(c) => {}
                other => break other,
            }
        };
        if letter == Some('%') {
            text.push('%');
            continue;
        }
        let Some(letter @ ('d' | 'D' | 'f' | 'F' | 's' | 'S')) = letter else {
            let shown = letter.map_or(String::new(), String::from);
            let message = format!("unknown format %{shown}");
            let hint = "use %s, %d or %f; %% is a percent sign";
            return Err(Fault::new(Condition::MessageFormat, message, at).hint(hint));
        };
        let Some(expr) = values.next() else {
            let message = format!("no value for %{letter}");
            return Err(Fault::new(Condition::MessageCount, message, at));
        };
        text.push_str(&form.of(&decoder.value(expr)?, letter));
    }
    if let Some(left) = values.next() {
        let text = "a value without a format specifier in the text";
        return Err(Fault::new(Condition::MessageCount, text, left.span));
    }
    Ok(text)
}

/// Flags, width and precision between `%` and its letter.
#[derive(Default)]
struct Form {
    left: bool,
    sign: bool,
    zeros: bool,
    width: usize,
    precision: Option<usize>,
}

impl Form {
    /// Maximum number of characters of a value.
    const WIDEST: usize = 200;

    /// Processes a character; false for the letter of the format.
    fn takes(&mut self, c: char) -> bool {
        let digit = c.to_digit(10).map(|d| d as usize);
        match (c, digit, &mut self.precision) {
            ('.', _, None) => self.precision = Some(0),
            ('-', _, _) => self.left = true,
            ('+', _, _) => self.sign = true,
            ('0', _, None) if self.width == 0 => self.zeros = true,
            (_, Some(d), Some(slot)) => *slot = (10 * *slot + d).min(Self::WIDEST),
            (_, Some(d), None) => self.width = (10 * self.width + d).min(Self::WIDEST),
            _ => return false,
        }
        true
    }

    fn of(&self, value: &Value, letter: char) -> String {
        let text = match (value, letter.to_ascii_lowercase()) {
            (Value::Text(text), _) => match self.precision {
                Some(most) => text.chars().take(most).collect(),
                None => text.to_string(),
            },
            (Value::Number(x), 'd') => format!("{:.0}", x.round() + 0.0),
            (Value::Number(x), 'f') => format!("{x:.*}", self.precision.unwrap_or(6).min(17)),
            (Value::Number(x), _) => x.to_string(),
        };
        let is_number = matches!(value, Value::Number(_));
        let text = if self.sign && is_number && !text.starts_with('-') {
            format!("+{text}")
        } else {
            text
        };
        let missing = self.width.saturating_sub(text.chars().count());
        if self.left {
            return text + &" ".repeat(missing);
        }
        if self.zeros && is_number {
            let sign = text.len() - text.trim_start_matches(['+', '-']).len();
            return format!("{}{}{}", &text[..sign], "0".repeat(missing), &text[sign..]);
        }
        " ".repeat(missing) + &text
    }
}

arguments! {
    /// Keys of `#ERROR`.
    struct ErrorArguments {
        id: Number "ID" in between(1.0, 1000.0).whole(), "", "number of the message";
        rc: Number "RC", "", "0 warning, 2 error (the program aborts), 7 fatal; default 2";
        mid: Number "MID" in between(0.0, 65535.0).whole(), "", "selects one of several messages with this ID";
        pv1: Scalar "PV1", "", "a value, or a text of up to 23 characters";
        pv2: Scalar "PV2", "", "a value, or a text of up to 23 characters";
        pv3: Scalar "PV3", "", "a value, or a text of up to 23 characters";
        pv4: Scalar "PV4", "", "a value, or a text of up to 23 characters";
        pv5: Scalar "PV5", "", "a value, or a text of up to 23 characters";
        piv1: Number "PIV1", "", "a whole number";
        piv2: Number "PIV2", "", "a whole number";
        piv3: Number "PIV3", "", "a whole number";
        piv4: Number "PIV4", "", "a whole number";
        piv5: Number "PIV5", "", "a whole number";
        pm1: Number "PM1" in between(0.0, 21.0).whole(), "", "meaning of PV1: 0 none, 1 limit, 2 current, 3 wrong, 4 expected, 5 corrected value, ..";
        pm2: Number "PM2" in between(0.0, 21.0).whole(), "", "meaning of PV2: 0 none, 1 limit, 2 current, 3 wrong, 4 expected, 5 corrected value, ..";
        pm3: Number "PM3" in between(0.0, 21.0).whole(), "", "meaning of PV3: 0 none, 1 limit, 2 current, 3 wrong, 4 expected, 5 corrected value, ..";
        pm4: Number "PM4" in between(0.0, 21.0).whole(), "", "meaning of PV4: 0 none, 1 limit, 2 current, 3 wrong, 4 expected, 5 corrected value, ..";
        pm5: Number "PM5" in between(0.0, 21.0).whole(), "", "meaning of PV5: 0 none, 1 limit, 2 current, 3 wrong, 4 expected, 5 corrected value, ..";
    }
}

/// Row of `#ERROR`.
pub(super) const ERROR: Row = Row::run("ERROR", error)
    .form("#ERROR [ID=.. RC=..]")
    .meaning("user message with an ID from 1 to 1000")
    .keys(ErrorArguments::KEYS)
    .example("#ERROR [ID=455 RC=2]");

/// Maximum length of a text as a value (207457163).
const TEXT_MAX: usize = 23;

/// Default meaning of a value.
const CURRENT: u32 = 2;

/// Meaning of a number in PM1 to PM5 for its value; `None`: the value is ignored.
///
/// Source: TF5200 diagnosis 249247371, error management 207457163.
fn kind_of(meaning: u32) -> Option<ValueKind> {
    Some(match meaning {
        0 => return None,
        1 => ValueKind::Limit,
        3 => ValueKind::Wrong,
        4 => ValueKind::Expected,
        5 => ValueKind::Corrected,
        6 => ValueKind::AxisNumber,
        // state, transition, status
        9 | 10 | 15 => ValueKind::State,
        // types, senders, classes, instances and numbers
        7 | 8 | 11..=14 | 16 | 17 => ValueKind::Identification,
        18 => ValueKind::LowerLimit,
        19 => ValueKind::UpperLimit,
        20 => ValueKind::StartValue,
        21 => ValueKind::TargetValue,
        _ => ValueKind::Current,
    })
}

/// `#ERROR [ID=1..1000 RC=0|2|7 MID= PV1..5= PM1..5= PIV..=]`.
fn error(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    call.no_more_words()?;
    let keys = ErrorArguments::read(decoder, &call.title(), call.command.groups.first())?;
    let Some((id, _)) = keys.id else {
        return Err(Fault::new(Condition::TokenUnknown, "#ERROR needs ID", call.span()));
    };
    let id = crate::exec::values::number::whole(id, 1, 1000).unwrap_or(1);
    let rc = keys.rc.map_or(2.0, |(rc, _)| rc);
    let severity = match crate::exec::values::number::whole(rc, 0, 7) {
        Some(0) => Severity::Warning,
        Some(2 | 7) => Severity::Error,
        _ => {
            let text = format!("#ERROR: RC={rc}, allowed: 0, 2 and 7");
            return Err(Fault::new(Condition::Range, text, call.span()));
        }
    };
    let mut diagnostic = Diagnostic::programmed(id, "message of the program").severity(severity);
    diagnostic.multiple_id = keys.mid.map_or(0, |(mid, _)| mid as u32);
    let meanings = [keys.pm1, keys.pm2, keys.pm3, keys.pm4, keys.pm5];
    let values = [keys.pv1, keys.pv2, keys.pv3, keys.pv4, keys.pv5];
    let integers = [keys.piv1, keys.piv2, keys.piv3, keys.piv4, keys.piv5];
    let integers = integers.map(|x| (x.map(|(x, span)| (Value::Number(x), span)), None));
    for (value, meaning) in values.into_iter().zip(meanings).chain(integers) {
        let meaning = meaning.map_or(CURRENT, |(meaning, _)| meaning as u32);
        let Some((value, span)) = value else { continue };
        if let Value::Text(text) = &value
            && text.chars().count() > TEXT_MAX
        {
            let text =
                format!("a text of {} characters, maximum: {TEXT_MAX}", text.chars().count());
            return Err(Fault::new(Condition::Range, text, span));
        }
        diagnostic = match (kind_of(meaning), value) {
            (None, _) => diagnostic,
            (Some(kind), Value::Number(x)) => diagnostic.value(kind, x, "-"),
            (Some(kind), Value::Text(text)) => diagnostic.value(kind, text.to_string(), "-"),
        };
    }
    let fault = Fault::of(diagnostic, call.span());
    if severity == Severity::Error {
        Err(fault)
    } else {
        decoder.report.note(fault);
        Ok(())
    }
}
