//! The axes that `#CALL AX` and `#SET AX` take into the channel: names, numbers, places.

use super::members::{exchanged, full_feedforward};
use crate::diag::{Condition, ValueKind};
use crate::exec::commands::row::Call;
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::syntax::ast::{Group, Item, ItemKind, ItemValue, Span};

/// Options after name, number and index of an axis.
const OPTIONS: &[&str] = &["CMDPOS", "ACTPOS", "OFFSETS", "NO_OFFSETS", "ALL"];

/// Positions of an axis in the channel.
const PLACES: u32 = 32;

/// Names and indices already used in the brackets of one command.
#[derive(Default)]
struct Taken {
    indices: Vec<u32>,
    numbers: Vec<u32>,
}

impl Taken {
    /// 21257, 21258: an index or an axis may be named only once.
    fn add(&mut self, index: u32, number: u32, at: [Span; 2]) -> Outcome<()> {
        if self.numbers.contains(&number) {
            let text = format!("axis number {number} twice in one axis exchange");
            return Err(Fault::new(Condition::ExchangeNumberTwice, text, at[0])
                .with(|d| d.value(ValueKind::AxisNumber, number, "-")));
        }
        if self.indices.contains(&index) {
            let text = format!("axis index {index} twice in one axis exchange");
            return Err(Fault::new(Condition::ExchangeIndexTwice, text, at[1])
                .with(|d| d.value(ValueKind::Wrong, index, "-")));
        }
        self.indices.push(index);
        self.numbers.push(number);
        Ok(())
    }
}

pub(super) fn take_all(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    let mut taken = Taken::default();
    if call.command.groups.is_empty() {
        let text = format!("{} needs [name, number, index]", call.title());
        return Err(Fault::new(Condition::TokenUnknown, text, call.span()));
    }
    for group in &call.command.groups {
        // `[[X,1,0][Y,2,1]]` and `[X,1,0][Y,2,1]`
        let nested: Vec<&Group> = group
            .items
            .iter()
            .filter_map(|item| match &item.kind {
                ItemKind::Value(ItemValue::List(inner)) => Some(inner),
                _ => None,
            })
            .collect();
        if nested.is_empty() {
            take(decoder, group, &mut taken)?;
        }
        for inner in nested {
            take(decoder, inner, &mut taken)?;
        }
    }
    exchanged(decoder);
    Ok(())
}

fn number(
    decoder: &Decoder,
    item: Option<&Item>,
    missing: (Condition, &str),
    at: Span,
) -> Outcome<f64> {
    match item.map(|i| &i.kind) {
        Some(ItemKind::Value(ItemValue::Expr(expr))) => decoder.number(expr),
        _ => Err(Fault::new(missing.0, missing.1, item.map_or(at, |i| i.span))),
    }
}

/// The name of an axis exchange in capitals, and its place.
fn name_of(group: &Group) -> Outcome<(String, Span)> {
    let items = &group.items;
    let name = match items.first().map(|i| (&i.kind, i.span)) {
        Some((ItemKind::Flag(name), _)) => name.clone(),
        // `[X 1 2]`: missing commas
        Some((ItemKind::Pair { .. }, span)) => {
            return Err(Fault::new(
                Condition::ExchangeComma,
                "a comma is missing after the axis name",
                span,
            ));
        }
        _ => {
            return Err(Fault::new(
                Condition::AxisNameUnknown,
                "an axis name is expected",
                group.span,
            ));
        }
    };
    let letters = name.text.to_ascii_uppercase();
    let first = letters.as_bytes().first().copied().unwrap_or(b' ');
    if letters.len() > 16 || !b"XYZABCUVWQ".contains(&first) {
        let text = format!("`{}` is not an axis name", name.text);
        return Err(Fault::new(Condition::ExchangeName, text, name.span));
    }
    Ok((letters, name.span))
}

/// The logical number and the index of an axis exchange, whose options are checked.
fn numbers_of(decoder: &Decoder, group: &Group) -> Outcome<(u32, u32)> {
    let items = &group.items;
    let at = |i: usize| items.get(i).map_or(group.span, |item| item.span);
    let logical = number(
        decoder,
        items.get(1),
        (Condition::ExchangeComma, "the logical axis number is missing"),
        group.span,
    )?;
    let index = number(
        decoder,
        items.get(2),
        (Condition::ExchangeNumber, "the axis index is missing"),
        group.span,
    )?;
    let Some(logical) = crate::exec::values::number::whole(logical, 1, 65535) else {
        let text = format!("logical axis number {logical} is not in 1 to 65535");
        return Err(Fault::new(Condition::ExchangeNumberRange, text, at(1)));
    };
    let Some(index) = crate::exec::values::number::whole(index, 0, PLACES - 1) else {
        let text = format!("axis index {index} is not a whole number from 0 to {}", PLACES - 1);
        let whole = index.fract() == 0.0;
        let condition = if whole { Condition::ExchangeIndexRange } else { Condition::Range };
        return Err(Fault::new(condition, text, at(2)));
    };
    for item in items.iter().skip(3) {
        match &item.kind {
            ItemKind::Flag(word) if OPTIONS.iter().any(|o| word.is(o)) => {}
            ItemKind::Missing => {}
            _ => {
                let text = "unknown offset mode of an axis exchange";
                return Err(Fault::new(Condition::ExchangeMode, text, item.span));
            }
        }
    }
    Ok((logical, index))
}

/// `[name, number, index, options]`.
fn take(decoder: &mut Decoder, group: &Group, taken: &mut Taken) -> Outcome<()> {
    let items = &group.items;
    let (letters, named) = name_of(group)?;
    let (logical, index) = numbers_of(decoder, group)?;
    let at = |i: usize| items.get(i).map_or(group.span, |item| item.span);
    let Some(axis) = decoder.machine.axes.iter().position(|a| a.number() == logical) else {
        let text = format!("no axis of the channel has the logical number {logical}");
        let hint = "only axes named in the channel list at start-up exist; other lists are not simulated (K-0075)";
        return Err(Fault::new(Condition::AxisNumberUnknown, text, at(1)).hint(hint));
    };
    taken.add(index, logical, [at(1), at(2)])?;
    decoder.motion.couplings.moves_no_coupled(
        std::iter::once(axis),
        &decoder.machine,
        Condition::CoupledAxisSorted,
        at(0),
    )?;
    if let Some(other) = decoder.names.of_name(&letters).filter(|other| *other != axis) {
        // the manual has an ID for two names within the command, and another one for an axis that is already in the channel
        let condition = if taken.numbers.contains(&decoder.machine.axes[other].number()) {
            Condition::ExchangeNameTwice
        } else {
            Condition::ExchangeNameTaken
        };
        let text = format!("two axes of the channel would have the name {letters}");
        return Err(Fault::new(condition, text, named));
    }
    let main = index as usize;
    if index < 3 && decoder.geometry.coordinates.main_axis(main).is_some_and(|other| other != axis)
    {
        let text = format!("the axis index {index} belongs to another axis of the channel");
        return Err(Fault::new(Condition::ExchangeIndexTaken, text, at(2))
            .with(|d| d.value(ValueKind::Wrong, index, "-")));
    }
    decoder.names.rename(axis, Some(letters));
    if index < 3 {
        decoder.geometry.coordinates.set_main_axis(main, Some(axis));
    }
    full_feedforward(decoder, &[axis]);
    Ok(())
}
