//! Keys in brackets: one description per command, used to read its arguments into a struct, to check and to explain them.

mod kind;

use super::range::Range;
use crate::diag::Condition;
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::options::Value;
use crate::exec::values::number::as_number;
use crate::suggest;
use crate::syntax::ast::{Expr, ExprKind, Group, Ident, Item, ItemKind, ItemValue, Span};

/// Title of the override of spindles in messages.
pub(in crate::exec) const SPINDLE_OVERRIDE: &str = "S[OVERRIDE]";

/// The arguments of a command: a struct with one field per key, and the description of the keys.
///
/// ```text
/// arguments! {
///     /// Keys of `#TIMER`.
///     struct TimerKeys {
///         id: Number "ID" in between(0.0, 127.0), "", "default 0";
///     }
/// }
/// ```
///
/// A row is the field, the kind of its value, the key, optionally the range (checked while reading, in the order of the
/// rows), the unit and a note. A field that begins with `_` is a key that is known and does nothing.
macro_rules! arguments {
    (
        $(#[$doc:meta])*
        $vis:vis struct $name:ident {
            $($field:ident: $kind:ident $key:literal $(in $range:expr)?, $unit:literal, $text:literal;)*
        }
    ) => {
        $(#[$doc])*
        #[derive(Debug)]
        $vis struct $name {
            $($vis $field: Option<<$crate::exec::commands::keys::$kind as $crate::exec::commands::keys::Argument>::Value>,)*
        }

        impl $name {
            /// Description of the keys.
            $vis const KEYS: &'static [$crate::exec::commands::keys::Key] = &[
                $($crate::exec::commands::keys::Key {
                    name: $key,
                    kind: <$crate::exec::commands::keys::$kind as $crate::exec::commands::keys::Argument>::KIND,
                    range: $crate::exec::commands::keys::optional([$($range)?]),
                    unit: $unit,
                    text: $text,
                },)*
            ];

            /// Reads the bracket. Unknown keys are 21220, a repeated key is 21887, a second bracket is 21692; they are reported
            /// and skipped.
            ///
            /// # Errors
            /// The first key with a number outside its range.
            $vis fn read(
                decoder: &mut $crate::exec::decoder::Decoder,
                title: &str,
                group: Option<&$crate::syntax::ast::Group>,
            ) -> $crate::exec::fault::Outcome<Self> {
                let found = $crate::exec::commands::keys::read_all(decoder, title, group, Self::KEYS)?;
                Ok(Self {
                    $($field: <$crate::exec::commands::keys::$kind as $crate::exec::commands::keys::Argument>::take(&found, $key),)*
                })
            }
        }
    };
}
pub(in crate::exec) use arguments;
pub(crate) use kind::KeyKind;
pub(in crate::exec) use kind::{Argument, Flag, MaybeNumber, Number, Scalar, Word};
use kind::{Found, Written};

/// A key of a command.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Key {
    /// Name as written.
    pub(crate) name: &'static str,
    /// Kind of its value.
    pub(crate) kind: KeyKind,
    /// Range of its number, `None`: unlimited, or checked by the command.
    pub(crate) range: Option<Range>,
    /// Unit, empty without one.
    pub(crate) unit: &'static str,
    /// Further notes: default, key of the list.
    pub(crate) text: &'static str,
}

impl std::fmt::Display for Key {
    /// `FREQ >= 1 Hz, default 30 (vib_guard.freq)`.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.name)?;
        if let Some(range) = &self.range {
            write!(f, " {}", range.short())?;
        }
        if !self.unit.is_empty() {
            write!(f, " {}", self.unit)?;
        }
        if !self.text.is_empty() {
            let separator = if self.range.is_some() || !self.unit.is_empty() { "," } else { "" };
            write!(f, "{separator} {}", self.text)?;
        }
        Ok(())
    }
}

/// The entry of an array that has one or none.
pub(in crate::exec) const fn optional<const N: usize>(ranges: [Range; N]) -> Option<Range> {
    if N == 0 { None } else { Some(ranges[0]) }
}

/// Condition of a repeated key: that of the command, that of all commands, or K-DUPKEY in a bracket of an axis.
///
/// Source: TF5200 diagnosis, 21388 (254466699), 21887 (256433803).
fn key_twice(title: &str) -> Condition {
    match title {
        "#OVERRIDE" => Condition::OverrideKeyTwice,
        SPINDLE_OVERRIDE => Condition::SpindleOverrideKeyTwice,
        title if title.starts_with("#TIMER") => Condition::TimerTwice,
        title if title.starts_with("#OTC") => Condition::WearKeyTwice,
        title if title.starts_with('#') => Condition::CommandKeyTwice,
        _ => Condition::DuplicateKey,
    }
}

/// Reads and checks the keys of a bracket.
pub(in crate::exec) fn read_all(
    decoder: &mut Decoder,
    title: &str,
    group: Option<&Group>,
    keys: &[Key],
) -> Outcome<Found> {
    let mut found = Found::default();
    let items: &[Item] = group.map_or(&[], |g| &g.items);
    let mut at = 0;
    while let Some(item) = items.get(at) {
        if let Some(before) = items[..at].last()
            && let Some((intended, fault)) = decimal_comma(before, item)
        {
            // a value of 0 may switch off what the fraction does not; a whole one is good enough to go on with
            if intended < 1.0 {
                found.correct(before.span, intended);
            }
            decoder.report.note(fault);
            at += 1;
            continue;
        }
        at += 1;
        // `TYPE HSC`: missing equals sign
        let pair = pair_of_words(item, items.get(at), keys);
        at += usize::from(pair.is_some());
        let item = pair.as_ref().unwrap_or(item);
        match read(decoder, title, item, keys) {
            Ok(None) => {}
            Ok(Some((name, _))) if found.get(name).is_some() => {
                let text = format!("{title}: {name} given twice");
                decoder.report.note(Fault::new(key_twice(title), text, item.span));
            }
            Ok(Some((name, written))) => found.push(name, written, item.span),
            Err(fault) => decoder.report.note(fault),
        }
    }
    for Key { name, range, .. } in keys {
        if let (Some(range), Some((Written::Number(x), span))) = (range, found.get(name))
            && !range.contains(*x)
        {
            let text = format!("{name}={x}, allowed: {}", range.allowed());
            // the general ID of commands (254101131); brackets of axes have none
            let condition = match range.condition {
                Condition::Range if title.starts_with('#') => Condition::KeyRange,
                condition => condition,
            };
            return Err(Fault::new(condition, text, *span));
        }
    }
    Ok(found)
}

/// `PATH_DEV=0,01`: a number with a decimal comma is read as a pair and a value without a key. The intended number, and
/// the fault.
fn decimal_comma(before: &Item, item: &Item) -> Option<(f64, Box<Fault>)> {
    let ItemKind::Pair { key, value: ItemValue::Expr(Expr { kind: ExprKind::Number(whole), .. }) } =
        &before.kind
    else {
        return None;
    };
    let ItemKind::Value(ItemValue::Expr(Expr { kind: ExprKind::Number(digits), .. })) = &item.kind
    else {
        return None;
    };
    let comma = before.span.start + before.span.len;
    let adjacent = item.span.start == comma + 1;
    if !adjacent || *digits < 0.0 || digits.fract() != 0.0 {
        return None;
    }
    let places = item.span.len as usize;
    let written = format!("{whole}.{digits:0places$}");
    let at = Span { start: comma, len: 1 };
    let fault = Fault::new(Condition::Syntax, "a number with a decimal comma", at)
        .hint(format!("write {}={written}", key.text));
    Some((written.parse().ok()?, fault))
}

/// Joins a key and the word after it to one item.
fn pair_of_words(item: &Item, next: Option<&Item>, keys: &[Key]) -> Option<Item> {
    let (ItemKind::Flag(key), ItemKind::Flag(word)) = (&item.kind, &next?.kind) else {
        return None;
    };
    keys.iter().find(|k| key.is(k.name) && k.kind == KeyKind::Word)?;
    let value = ItemValue::Name(word.clone());
    Some(Item { kind: ItemKind::Pair { key: key.clone(), value }, span: item.span.to(word.span) })
}

fn read(
    decoder: &Decoder,
    title: &str,
    item: &Item,
    keys: &[Key],
) -> Outcome<Option<(&'static str, Written)>> {
    match &item.kind {
        ItemKind::Missing => Ok(None),
        ItemKind::Flag(ident) => alone(decoder, title, ident, item.span, keys).map(Some),
        ItemKind::Pair { key: ident, value } => {
            let Some(key) = keys.iter().find(|k| ident.is(k.name)) else {
                return Err(unknown(title, ident, keys));
            };
            let written = match (key.kind, value) {
                (KeyKind::Number | KeyKind::MaybeNumber, ItemValue::Expr(e)) => {
                    Written::Number(decoder.number(e)?)
                }
                (KeyKind::Scalar, ItemValue::Expr(e)) => match decoder.value(e)? {
                    Value::Number(x) => Written::Number(x),
                    Value::Text(text) => Written::Word(text),
                },
                (KeyKind::Word, ItemValue::Name(word)) => Written::Word(word.text.clone()),
                (KeyKind::Word, ItemValue::Expr(e)) => Written::Word(text(decoder, e)?),
                _ => return Err(incomplete(title, key, item.span)),
            };
            Ok(Some((key.name, written)))
        }
        ItemKind::Value(ItemValue::List(_)) => {
            let text = format!("{title}: a second opening bracket");
            Err(Fault::new(Condition::BracketTwice, text, item.span))
        }
        ItemKind::Value(_) | ItemKind::Target { .. } => {
            let text = format!("{title}: a value without a key");
            Err(Fault::new(Condition::TokenUnknown, text, item.span).hint(known(keys)))
        }
    }
}

/// A word without `=`: a key without a value, or with a number or parameter written right after it.
fn alone(
    decoder: &Decoder,
    title: &str,
    ident: &Ident,
    at: Span,
    keys: &[Key],
) -> Outcome<(&'static str, Written)> {
    if let Some(key) = keys.iter().find(|k| ident.is(k.name)) {
        return match key.kind {
            KeyKind::Flag | KeyKind::MaybeNumber => Ok((key.name, Written::Nothing)),
            KeyKind::Number | KeyKind::Word | KeyKind::Scalar => Err(incomplete(title, key, at)),
        };
    }
    // `ID455`: a key and its number without separator
    if let Some((name, number)) = ident.split_number() {
        let key = keys.iter().find(|k| k.name.eq_ignore_ascii_case(name));
        if let Some(key) = key.filter(|k| k.kind.takes_number()) {
            return Ok((key.name, Written::Number(number)));
        }
    }
    // `IDP100`: a key and a parameter without separator
    if let Some((name, place)) = ident.split_parameter() {
        let key = keys.iter().find(|k| k.name.eq_ignore_ascii_case(name));
        if let Some(key) = key.filter(|k| k.kind.takes_number()) {
            let number = as_number(&decoder.read(&place)?, at)?;
            return Ok((key.name, Written::Number(number)));
        }
    }
    Err(unknown(title, ident, keys))
}

fn text(decoder: &Decoder, expr: &Expr) -> Outcome<Box<str>> {
    Ok(match decoder.value(expr)? {
        Value::Text(text) => text,
        Value::Number(x) => x.to_string().into(),
    })
}

fn known(keys: &[Key]) -> String {
    let names: Vec<&str> = keys.iter().map(|k| k.name).collect();
    format!("use the keys {}", names.join(", "))
}

fn unknown(title: &str, ident: &Ident, keys: &[Key]) -> Box<Fault> {
    let fault = Fault::new(
        Condition::TokenUnknown,
        format!("{title}: unknown key `{}`", ident.text),
        ident.span,
    );
    match suggest::nearest(&ident.text, keys.iter().map(|k| k.name)) {
        Some(near) => fault.hint(format!("did you mean `{near}`?")),
        None => fault.hint(known(keys)),
    }
}

fn incomplete(title: &str, key: &Key, span: Span) -> Box<Fault> {
    let what = match key.kind {
        KeyKind::Number => "needs a number",
        KeyKind::MaybeNumber => "takes a number or no value",
        KeyKind::Word => "needs a word",
        KeyKind::Scalar => "requires a number or a text",
        KeyKind::Flag => "does not take a value",
    };
    Fault::new(Condition::TokenUnknown, format!("{title}: {} {what}", key.name), span)
}
