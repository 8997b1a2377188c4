//! `#SET AX LINK`, `#AX LINK`, `#ENABLE AX LINK`, `#DISABLE AX LINK`: groups of axis couplings.
//!
//! The commands read and check groups; the couplings themselves are in [`crate::exec::motion`].
//!
//! Source: TF5200 programming manual, axis couplings (207120267, 207126155, 207133579), gantry operation (285670667);
//! 20461, 20475 to 20477, 21077, 21110, 21111 and 21281.

use super::row::{Call, Row};
use crate::diag::{Condition, ValueKind};
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::motion::state::coupling::Pair;
use crate::exec::values::number::whole;
use crate::machine::PAIRS_MAX;
use crate::syntax::ast::{Expr, Group, Ident, Item, ItemKind, ItemValue, Span};

/// Row of `#SET AX LINK`.
pub(super) const SET_AX_LINK: Row = Row::run("SET AX LINK", define)
    .form("#SET AX LINK [group, slave=master ..]")
    .meaning("defines a group of axis couplings")
    .note("[slave=master, -1, 1] mirrors; G with monitoring limits couples a gantry, whose actual positions are not monitored")
    .example("#SET AX LINK [1, C=X]")
    .related(&["#ENABLE AX LINK", "20475", "20476", "20477", "21077", "21110", "21111"]);

/// Row of `#ENABLE AX LINK`.
pub(super) const ENABLE_AX_LINK: Row = Row::run("ENABLE AX LINK", enable)
    .form("#ENABLE AX LINK [group]")
    .meaning("the slaves of a group follow their masters from their current positions; the path stops")
    .note("slaves must not be main axes (20467) and must not be programmed while coupled; the path observes their limits")
    .example("#ENABLE AX LINK [1]")
    .related(&["#SET AX LINK", "#DISABLE AX LINK", "20457", "20467", "20468", "20169", "20545", "21481"]);

/// Row of `#DISABLE AX LINK`.
pub(super) const DISABLE_AX_LINK: Row = Row::run("DISABLE AX LINK", disable)
    .form("#DISABLE AX LINK [group]")
    .meaning("switches off the couplings of a group, without a bracket those of the group switched on last; the path stops")
    .example("#DISABLE AX LINK [1]")
    .related(&["#ENABLE AX LINK"]);

/// Row of `#AX LINK`.
pub(super) const AX_LINK: Row = Row::run("AX LINK", link)
    .form("#AX LINK [group, slave=master ..]   #AX LINK NBR [group, number=number ..]   #AX LINK ON [group]   #AX LINK OFF [group]   #AX LINK OFF ALL")
    .meaning("#SET AX LINK, #ENABLE AX LINK and #DISABLE AX LINK in one command")
    .example("#AX LINK ON [1]")
    .related(&["#SET AX LINK", "#ENABLE AX LINK"]);

fn link(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    match call.command.on {
        Some(true) => enable(decoder, call),
        Some(false) => match &call.command.tail[..] {
            [all] if all.is("ALL") && call.command.groups.is_empty() => {
                decoder.switch_all_couplings_off(call.span())
            }
            _ => disable(decoder, call),
        },
        None => define(decoder, call),
    }
}

fn enable(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    call.no_more_words()?;
    let group = named_group(decoder, call)?;
    decoder.switch_couplings_on(group.unwrap_or(0), call.span())
}

fn disable(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    call.no_more_words()?;
    let group = named_group(decoder, call)?;
    decoder.switch_couplings_off(group, call.span())
}

/// `[group]`, if given.
fn named_group(decoder: &Decoder, call: &Call<'_>) -> Outcome<Option<u32>> {
    let Some(Group { items, span }) = call.command.groups.first() else { return Ok(None) };
    let [Item { kind: ItemKind::Value(ItemValue::Expr(number)), .. }] = &items[..] else {
        let text = format!("{} needs the number of a group", call.title());
        return Err(Fault::new(Condition::TokenUnknown, text, *span));
    };
    group_number(decoder, number, 0).map(Some)
}

/// Highest number of a group. Assumption: the 7 groups that a program can define (system parameters 877646603, 2.11) have the numbers
/// 1 to 7, since that of the channel list is 0.
const LAST_GROUP: u32 = 7;

/// 20461 outside the range.
fn group_number(decoder: &Decoder, number: &Expr, least: u32) -> Outcome<u32> {
    let written = decoder.number(number)?;
    let most = LAST_GROUP;
    whole(written, least, most).ok_or_else(|| {
        let text = format!("coupling group {written} does not exist");
        Fault::new(Condition::CouplingGroupNumber, text, number.span).with(|d| {
            d.value(ValueKind::Wrong, written, "-").value(ValueKind::LowerLimit, least, "-").value(
                ValueKind::UpperLimit,
                most,
                "-",
            )
        })
    })
}

/// `[1, Y=X, [Z=X, G, 0.01, 0.25], [A=X, -1, 2]]`: the number of the group, then its pairs.
fn define(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    let by_number = match call.rest {
        [word] if call.name == "AX LINK" && word.is("NBR") => true,
        _ => {
            call.no_more_words()?;
            false
        }
    };
    let wrong = |span| {
        let text = format!("{} needs the number of a group and couplings", call.title());
        Fault::new(Condition::TokenUnknown, text, span).hint("write #SET AX LINK [1, C=X]")
    };
    let items = call.command.groups.first().map_or(&[][..], |group| &group.items);
    let [Item { kind: ItemKind::Value(ItemValue::Expr(number)), .. }, pairs @ ..] = items else {
        return Err(wrong(call.span()));
    };
    // group 0 is defined by the channel list
    let group = group_number(decoder, number, 1)?;
    if pairs.is_empty() {
        return Err(wrong(call.span()));
    }
    if let Some(more) = pairs.get(PAIRS_MAX as usize) {
        let text = format!("coupling group {group} has more than {PAIRS_MAX} pairs");
        return Err(Fault::new(Condition::CouplingPairs, text, more.span).with(|d| {
            let d = d.value(ValueKind::Wrong, pairs.len() as f64, "-");
            d.value(ValueKind::UpperLimit, f64::from(PAIRS_MAX), "-")
        }));
    }
    let mut known: Vec<Pair> = Vec::new();
    for item in pairs {
        let (slave, master) = if by_number {
            numbered_coupling(decoder, item)?.ok_or_else(|| wrong(item.span))?
        } else {
            let (slave, master) = coupling(item).ok_or_else(|| wrong(item.span))?;
            (axis(decoder, slave)?, axis(decoder, master)?)
        };
        let mut pair = Pair { slave, master, ratio: 1.0, is_gantry: false };
        fits(decoder, group, &known, (pair.slave, pair.master), item.span)?;
        if let ItemKind::Value(ItemValue::List(inner)) = &item.kind {
            match inner.items.get(1).map(|item| &item.kind) {
                Some(ItemKind::Flag(word)) if word.is("G") => pair.is_gantry = true,
                _ => pair.ratio = factor(decoder, &inner.items[1..])?,
            }
        }
        known.push(pair);
    }
    decoder.motion.couplings.define(group, known, call.span())
}

/// `Y=X`, or `[Y=X, ..]` with monitoring limits (G) or a ratio.
fn coupling(item: &Item) -> Option<(&Ident, &Ident)> {
    match &item.kind {
        ItemKind::Pair { key, value: ItemValue::Name(master) } => Some((key, master)),
        ItemKind::Value(ItemValue::List(group)) => coupling(group.items.first()?),
        _ => None,
    }
}

/// `8 = 2`, `[8 = 2, ..]`: the logical numbers of two axes.
///
/// Assumption: unlike on the control an axis must exist when the group is defined, not only when it is activated.
fn numbered_coupling(decoder: &Decoder, item: &Item) -> Outcome<Option<(usize, usize)>> {
    let (key, master) = match &item.kind {
        ItemKind::Pair { key, value: ItemValue::Expr(master) } => (key, master),
        ItemKind::Value(ItemValue::List(group)) => {
            let Some(first) = group.items.first() else { return Ok(None) };
            return numbered_coupling(decoder, first);
        }
        _ => return Ok(None),
    };
    let Ok(slave) = key.text.parse::<f64>() else { return Ok(None) };
    let axis = |number: f64, span: Span| {
        let numbered =
            |axis: &crate::machine::Axis| f64::from(axis.number()).total_cmp(&number).is_eq();
        decoder.machine.axes.iter().position(numbered).ok_or_else(|| {
            let text = format!("axis with the logical number {number} does not exist");
            Fault::new(Condition::AxisNumberUnknown, text, span)
                .with(|d| d.value(ValueKind::Wrong, number, "-"))
        })
    };
    Ok(Some((axis(slave, key.span)?, axis(decoder.number(master)?, master.span)?)))
}

/// `-1, 1` after a pair: its factor from numerator and denominator, 1 or -1.
///
/// Assumption: two pages disagree. 21111 (253496203: factors other than 1 and -1 become 1) is used instead of the description
/// of scaled couplings (285670667), because it describes the reaction of the control. A denominator of 0 counts as such a
/// factor.
fn factor(decoder: &mut Decoder, items: &[Item]) -> Outcome<f64> {
    let (numerator, rest) = match items {
        [] => return Ok(1.0),
        [Item { kind: ItemKind::Value(ItemValue::Expr(numerator)), .. }, rest @ ..] => {
            (numerator, rest)
        }
        [other, ..] => {
            let text = "a coupling may be followed by numerator and denominator, or by G";
            return Err(Fault::new(Condition::TokenUnknown, text, other.span));
        }
    };
    let above = decoder.number(numerator)?;
    if above == 0.0 {
        let text = "the numerator of the coupling factor is 0";
        return Err(Fault::new(Condition::CouplingNumeratorZero, text, numerator.span)
            .with(|d| d.value(ValueKind::Current, above, "-")));
    }
    let Some(Item { kind: ItemKind::Value(ItemValue::Expr(denominator)), .. }) = rest.first()
    else {
        let text = format!("the coupling factor has the numerator {above} but no denominator");
        return Err(Fault::new(Condition::CouplingDenominatorMissing, text, numerator.span)
            .with(|d| d.value(ValueKind::Current, above, "-")));
    };
    let below = decoder.number(denominator)?;
    if above.abs().to_bits() == below.abs().to_bits() {
        return Ok(above / below);
    }
    let text = format!("the coupling factor is {above}/{below}, allowed: 1 and -1");
    let fault = Fault::new(Condition::CouplingFactorInvalid, text, numerator.span);
    decoder.report.note(fault.with(|d| {
        let d = d.value(ValueKind::Current, above, "-").value(ValueKind::Current, below, "-");
        // a denominator of 0 gives no factor
        let factor = above / below;
        if factor.is_finite() { d.value(ValueKind::Wrong, factor, "-") } else { d }
    }));
    Ok(1.0)
}

fn axis(decoder: &Decoder, name: &Ident) -> Outcome<usize> {
    if decoder.motion.spindle_of_name(&name.text, &decoder.machine.channel).is_some() {
        return Err(Fault::unsupported("couplings of spindles", name.span));
    }
    decoder.names.of_name(&name.text).ok_or_else(|| {
        let text = format!("the channel has no axis {}", name.text);
        Fault::new(Condition::AxisNameUnknown, text, name.span)
    })
}

/// An axis follows one master only, which must not follow another axis.
fn fits(
    decoder: &Decoder,
    group: u32,
    known: &[Pair],
    (slave, master): (usize, usize),
    span: Span,
) -> Outcome<()> {
    let (condition, axis, text) = if slave == master {
        (Condition::MasterIsSlave, slave, "an axis cannot be coupled with itself")
    } else if known.iter().any(|pair| pair.slave == slave) {
        (Condition::SlaveTwice, slave, "an axis can follow only one master")
    } else if known.iter().any(|pair| pair.master == slave) {
        (Condition::CouplingChain, slave, "a master cannot follow another axis")
    } else if known.iter().any(|pair| pair.slave == master) {
        (Condition::CouplingChain, master, "a slave cannot be the master of another axis")
    } else {
        return Ok(());
    };
    let number = decoder.machine.axes[axis].number();
    let name = decoder.machine.axes[axis].name().to_owned();
    Err(Fault::new(condition, text, span)
        .with(|d| d.axis(number, name).value(ValueKind::Current, group, "-")))
}
