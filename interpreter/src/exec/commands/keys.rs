//! Keys of the brackets: read once, checked against the keys that a command knows.

use crate::diag::Condition;
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::suggest;
use crate::syntax::ast::{Expr, Group, Ident, Item, ItemKind, ItemValue, Span};

/// What stands behind a key.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::exec) enum Kind {
    Number,
    /// A number, or nothing.
    MaybeNumber,
    /// An identifier.
    Word,
    /// Nothing.
    Flag,
    /// A text or identifier.
    Text,
}

/// A key that a command knows.
#[derive(Clone, Copy, Debug)]
pub(in crate::exec) struct Key {
    pub(in crate::exec) name: &'static str,
    pub(in crate::exec) kind: Kind,
}

/// A key with a number.
pub(in crate::exec) const fn number(name: &'static str) -> Key {
    Key { name, kind: Kind::Number }
}

/// A key without a value.
pub(in crate::exec) const fn flag(name: &'static str) -> Key {
    Key { name, kind: Kind::Flag }
}

/// Value of a key.
#[derive(Clone, Debug, PartialEq)]
enum Found {
    Number(f64),
    Word(Box<str>),
    Nothing,
}

/// The keys that are written.
#[derive(Debug, Default)]
pub(in crate::exec) struct Arguments {
    found: Vec<(&'static str, Found, Span)>,
}

impl Arguments {
    /// Number and place of a key.
    pub(in crate::exec) fn number(&self, name: &str) -> Option<(f64, Span)> {
        self.found.iter().find_map(|(n, found, span)| match found {
            Found::Number(x) if *n == name => Some((*x, *span)),
            _ => None,
        })
    }

    /// Word and place of a key.
    pub(in crate::exec) fn word(&self, name: &str) -> Option<(&str, Span)> {
        self.found.iter().find_map(|(n, found, span)| match found {
            Found::Word(word) if *n == name => Some((&**word, *span)),
            _ => None,
        })
    }

    /// Place of a key, with or without value.
    pub(in crate::exec) fn place(&self, name: &str) -> Option<Span> {
        self.found.iter().find(|(n, _, _)| *n == name).map(|(_, _, span)| *span)
    }

    /// How many keys are written.
    pub(in crate::exec) fn count(&self) -> usize {
        self.found.len()
    }

    /// True if the key is written.
    pub(in crate::exec) fn has(&self, name: &str) -> bool {
        self.place(name).is_some()
    }

    /// A number within a range; outside it is K-RANGE, or the ID given.
    pub(in crate::exec) fn in_range(
        &self,
        name: &str,
        low: f64,
        high: f64,
        condition: Condition,
    ) -> Outcome<Option<f64>> {
        match self.number(name) {
            Some((x, span)) if !(low..=high).contains(&x) => {
                // the least positive number stands for an open end
                let open = low.to_bits() == f64::MIN_POSITIVE.to_bits();
                let range = match (open, high < f64::MAX) {
                    (true, false) => "values above 0".to_owned(),
                    (true, true) => format!("values above 0, up to {high}"),
                    (false, false) => format!("{low} upwards"),
                    (false, true) => format!("{low} to {high}"),
                };
                let text = format!("{name}={x}, allowed are {range}");
                Err(Fault::new(condition, text, span))
            }
            found => Ok(found.map(|(x, _)| x)),
        }
    }
}

/// Reads the keys of a bracket. Unknown ones are 21220, a key twice is K-DUPKEY; both are reported and left out.
pub(in crate::exec) fn arguments(
    decoder: &mut Decoder,
    title: &str,
    group: Option<&Group>,
    keys: &[Key],
) -> Arguments {
    let mut arguments = Arguments::default();
    let items: &[Item] = group.map_or(&[], |g| &g.items);
    let mut at = 0;
    while let Some(item) = items.get(at) {
        at += 1;
        // `TYPE HSC`: the equals sign is missing
        let pair = pair_of_words(item, items.get(at), keys);
        at += usize::from(pair.is_some());
        let item = pair.as_ref().unwrap_or(item);
        match read(decoder, title, item, keys) {
            Ok(None) => {}
            Ok(Some((name, _))) if arguments.has(name) => {
                let text = format!("{title}: {name} twice, the second one is left out");
                decoder.note(Fault::new(Condition::DuplicateKey, text, item.span));
            }
            Ok(Some((name, found))) => arguments.found.push((name, found, item.span)),
            Err(fault) => decoder.note(fault),
        }
    }
    arguments
}

/// A key for a word and a word behind it as one item.
fn pair_of_words(item: &Item, next: Option<&Item>, keys: &[Key]) -> Option<Item> {
    let (ItemKind::Flag(key), ItemKind::Flag(word)) = (&item.kind, &next?.kind) else {
        return None;
    };
    keys.iter().find(|k| key.is(k.name) && matches!(k.kind, Kind::Word | Kind::Text))?;
    let value = ItemValue::Name(word.clone());
    Some(Item { kind: ItemKind::Pair { key: key.clone(), value }, span: item.span.to(word.span) })
}

fn read(
    decoder: &Decoder,
    title: &str,
    item: &Item,
    keys: &[Key],
) -> Outcome<Option<(&'static str, Found)>> {
    match &item.kind {
        ItemKind::Missing => Ok(None),
        ItemKind::Flag(ident) => {
            if let Some(key) = keys.iter().find(|k| ident.is(k.name)) {
                return match key.kind {
                    Kind::Flag | Kind::MaybeNumber => Ok(Some((key.name, Found::Nothing))),
                    _ => Err(incomplete(title, key, item.span)),
                };
            }
            // `ID455`: a key and its number written together
            if let Some((name, number)) = ident.split_number() {
                let key = keys.iter().find(|k| k.name.eq_ignore_ascii_case(name));
                if let Some(key) =
                    key.filter(|k| matches!(k.kind, Kind::Number | Kind::MaybeNumber))
                {
                    return Ok(Some((key.name, Found::Number(number))));
                }
            }
            Err(unknown(title, ident, keys))
        }
        ItemKind::Pair { key: ident, value } => {
            let Some(key) = keys.iter().find(|k| ident.is(k.name)) else {
                return Err(unknown(title, ident, keys));
            };
            let found = match (key.kind, value) {
                (Kind::Number | Kind::MaybeNumber, ItemValue::Expr(e)) => {
                    Found::Number(decoder.number(e)?)
                }
                (Kind::Word | Kind::Text, ItemValue::Name(word)) => Found::Word(word.text.clone()),
                (Kind::Text | Kind::Word, ItemValue::Expr(e)) => Found::Word(text(decoder, e)?),
                _ => return Err(incomplete(title, key, item.span)),
            };
            Ok(Some((key.name, found)))
        }
        ItemKind::Value(_) => {
            let text = format!("{title}: a value without a key");
            Err(Fault::new(Condition::TokenUnknown, text, item.span).hint(known(keys)))
        }
    }
}

fn text(decoder: &Decoder, expr: &Expr) -> Outcome<Box<str>> {
    Ok(match decoder.value(expr)? {
        crate::exec::options::Value::Text(text) => text,
        crate::exec::options::Value::Number(x) => x.to_string().into(),
    })
}

fn known(keys: &[Key]) -> String {
    let names: Vec<&str> = keys.iter().map(|k| k.name).collect();
    format!("keys are {}", names.join(", "))
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
        Kind::Number => "needs a number",
        Kind::MaybeNumber => "takes a number or nothing",
        Kind::Word | Kind::Text => "needs a word",
        Kind::Flag => "takes no value",
    };
    Fault::new(Condition::TokenUnknown, format!("{title}: {} {what}", key.name), span)
}
