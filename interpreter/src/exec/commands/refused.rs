//! Commands that are refused: what the diagnosis manual calls a mistake in them is said in place of the refusal.
//!
//! Source: TF5200 diagnosis, 21089 (253417867), 21235 (253879179), 21236 (253883531), 21349 (254314379), 21453 (254732171),
//! 21872 (256368523), 22003 (480451723).

use super::row::Call;
use crate::diag::Condition;
use crate::exec::decoder::Decoder;
use crate::exec::fault::Fault;
use crate::syntax::ast::{Command, Ident, ItemKind};

/// Numbers of a key that is written twice.
const KEY_TWICE: &[(&str, Condition)] = &[
    ("FACE", Condition::FaceKeyTwice),
    ("IDENT", Condition::IdentKeyTwice),
    ("MCS TO WCS", Condition::ConversionTwice),
    ("TGC", Condition::HeightKeyTwice),
    ("TOOL DEF", Condition::ToolKeyTwice),
    ("WCS TO MCS", Condition::ConversionTwice),
];

/// Why the command is not carried out.
pub(super) fn refused(decoder: &Decoder, call: &Call<'_>) -> Box<Fault> {
    if call.command.groups.iter().any(|group| group.items.is_empty()) {
        let text = format!("{}: there is nothing in its brackets", call.title());
        return Fault::new(Condition::EmptyBracket, text, call.span());
    }
    if let Some((_, condition)) = KEY_TWICE.iter().find(|(name, _)| *name == call.name)
        && let Some(key) = key_twice(call.command)
    {
        let text = format!("{}: {} twice", call.title(), key.text);
        return Fault::new(*condition, text, key.span);
    }
    if matches!(call.name, "WCS TO MCS" | "MCS TO WCS")
        && decoder.geometry.coordinates.systems() > 0
    {
        let text = format!("{} in a coordinate system", call.title());
        return Fault::new(Condition::ConversionInSystem, text, call.span());
    }
    let defines = call.name == "RT CYCLE" && call.rest.iter().any(|word| word.is("DEF"));
    if defines && !keys(call.command).any(|key| key.is("ID")) {
        let text = "#RT CYCLE DEF without ID";
        return Fault::new(Condition::CycleWithoutId, text, call.span());
    }
    Fault::unsupported(call.title(), call.span())
}

/// Names of the items in brackets.
fn keys(command: &Command) -> impl Iterator<Item = &Ident> {
    command.groups.iter().flat_map(|group| &group.items).filter_map(|item| match &item.kind {
        ItemKind::Pair { key, .. } | ItemKind::Flag(key) => Some(key),
        _ => None,
    })
}

fn key_twice(command: &Command) -> Option<&Ident> {
    let keys: Vec<&Ident> = keys(command).collect();
    let (_, second) =
        keys.iter().enumerate().find(|(i, key)| keys[..*i].iter().any(|k| k.is(&key.text)))?;
    Some(second)
}
