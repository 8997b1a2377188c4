//! `#SET AX LINK`, `#AX LINK`: groups of axis couplings.
//!
//! A definition moves nothing and is checked; a group that is switched on would move its slaves and is refused.
//!
//! Source: TF5200 programming manual, axis couplings (207120267, 207126155, 207133579), gantry operation (285670667);
//! 20475 to 20477, 21077, 21110 and 21111.

use super::row::{Call, Row};
use crate::diag::{Condition, ValueKind};
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::values::number::whole;
use crate::syntax::ast::{Ident, Item, ItemKind, ItemValue, Span};

/// Row of `#SET AX LINK`.
pub(super) const SET_AX_LINK: Row = Row::run("SET AX LINK", define)
    .form("#SET AX LINK [group, slave=master ..]")
    .meaning("defines a group of axis couplings")
    .note("the definition is checked; switching on a group is not supported")
    .example("#SET AX LINK [1, Y=X]")
    .related(&["20475", "20476", "20477", "21077", "21110", "21111"]);

/// Row of `#AX LINK`.
pub(super) const AX_LINK: Row = Row::run("AX LINK", link)
    .form("#AX LINK [group, slave=master ..]|OFF")
    .meaning("as #SET AX LINK; OFF: no group is switched on")
    .example("#AX LINK [1, Y=X]")
    .related(&["#SET AX LINK"]);

/// Row of `#DISABLE AX LINK`.
pub(super) const DISABLE_AX_LINK: Row = Row::run("DISABLE AX LINK", |_, _| Ok(()))
    .form("#DISABLE AX LINK [group]")
    .meaning("older form of #AX LINK OFF")
    .example("#DISABLE AX LINK [1]")
    .related(&["#AX LINK"]);

fn link(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    match call.command.on {
        Some(true) => Err(Fault::unsupported("#AX LINK ON", call.span())),
        // none can be on
        Some(false) => Ok(()),
        None => define(decoder, call),
    }
}

/// `[1, Y=X, [Z=X, G, 0.01, 0.25], [A=X, -1, 2]]`: the number of the group, then its pairs.
fn define(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    if call.rest.first().is_some_and(|word| word.is("NBR")) {
        return Err(Fault::unsupported("#AX LINK NBR", call.span()));
    }
    call.no_more_words()?;
    let wrong = |span| {
        let text = format!("{} needs the number of a group and couplings", call.title());
        Fault::new(Condition::TokenUnknown, text, span).hint("write #SET AX LINK [1, Y=X]")
    };
    let items = call.command.groups.first().map_or(&[][..], |group| &group.items);
    let [Item { kind: ItemKind::Value(ItemValue::Expr(number)), .. }, pairs @ ..] = items else {
        return Err(wrong(call.span()));
    };
    // group 0 is that of the channel list
    let written = decoder.number(number)?;
    let number = whole(written, 1, u32::from(u16::MAX)).ok_or_else(|| {
        let text = format!("there is no coupling group {written}");
        Fault::new(Condition::CouplingGroupNumber, text, number.span)
    })?;
    if pairs.is_empty() {
        return Err(wrong(call.span()));
    }
    let mut known: Vec<(usize, usize)> = Vec::new();
    for item in pairs {
        let (slave, master) = coupling(item).ok_or_else(|| wrong(item.span))?;
        let pair = (axis(decoder, slave)?, axis(decoder, master)?);
        fits(decoder, number, &known, pair, item.span)?;
        known.push(pair);
        if let ItemKind::Value(ItemValue::List(group)) = &item.kind {
            factor(decoder, &group.items[1..])?;
        }
    }
    Ok(())
}

/// `Y=X`, or `[Y=X, ..]` with monitoring limits (G) or a ratio.
fn coupling(item: &Item) -> Option<(&Ident, &Ident)> {
    match &item.kind {
        ItemKind::Pair { key, value: ItemValue::Name(master) } => Some((key, master)),
        ItemKind::Value(ItemValue::List(group)) => coupling(group.items.first()?),
        _ => None,
    }
}

/// `-1, 2` behind a pair: numerator and denominator of its factor. Behind G stand monitoring limits instead.
///
/// Assumption: of two pages that disagree, 21111 (253496203: factors other than 1 and -1 become 1) holds and not the
/// description of scaled couplings (285670667), since it says what the control does. A denominator of 0 is such a factor.
fn factor(decoder: &mut Decoder, items: &[Item]) -> Outcome<()> {
    let [Item { kind: ItemKind::Value(ItemValue::Expr(numerator)), .. }, rest @ ..] = items else {
        return Ok(());
    };
    let above = decoder.number(numerator)?;
    if above == 0.0 {
        let text = "the numerator of the coupling factor is 0";
        return Err(Fault::new(Condition::CouplingNumeratorZero, text, numerator.span)
            .with(|d| d.value(ValueKind::Current, above, "-")));
    }
    let Some(Item { kind: ItemKind::Value(ItemValue::Expr(denominator)), .. }) = rest.first()
    else {
        let text = format!("the coupling factor has the numerator {above} and no denominator");
        return Err(Fault::new(Condition::CouplingDenominatorMissing, text, numerator.span)
            .with(|d| d.value(ValueKind::Current, above, "-")));
    };
    let below = decoder.number(denominator)?;
    if above.abs().to_bits() != below.abs().to_bits() {
        let text = format!("the coupling factor is {above}/{below}, allowed are 1 and -1");
        let fault = Fault::new(Condition::CouplingFactorInvalid, text, numerator.span);
        decoder.report.note(fault.with(|d| {
            let d = d.value(ValueKind::Current, above, "-").value(ValueKind::Current, below, "-");
            // of the denominator 0 there is no factor
            let factor = above / below;
            if factor.is_finite() { d.value(ValueKind::Wrong, factor, "-") } else { d }
        }));
    }
    Ok(())
}

fn axis(decoder: &Decoder, name: &Ident) -> Outcome<usize> {
    decoder.names.of_name(&name.text).ok_or_else(|| {
        let text = format!("the channel has no axis {}", name.text);
        Fault::new(Condition::AxisNameUnknown, text, name.span)
    })
}

/// An axis follows one master, which follows no other axis.
fn fits(
    decoder: &Decoder,
    group: u32,
    known: &[(usize, usize)],
    (slave, master): (usize, usize),
    span: Span,
) -> Outcome<()> {
    let (condition, axis, text) = if slave == master {
        (Condition::MasterIsSlave, slave, "an axis cannot be coupled with itself")
    } else if known.iter().any(|(other, _)| *other == slave) {
        (Condition::SlaveTwice, slave, "an axis follows one master only")
    } else if known.iter().any(|(_, other)| *other == slave) {
        (Condition::CouplingChain, slave, "a master cannot follow another axis")
    } else if known.iter().any(|(other, _)| *other == master) {
        (Condition::CouplingChain, master, "a slave cannot be the master of another axis")
    } else {
        return Ok(());
    };
    let number = decoder.machine.axes[axis].number();
    let name = decoder.machine.axes[axis].name().to_owned();
    Err(Fault::new(condition, text, span)
        .with(|d| d.axis(number, name).value(ValueKind::Current, group, "-")))
}
