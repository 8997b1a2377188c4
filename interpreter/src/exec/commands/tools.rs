//! Tools by their ID: `#TOOL DATA`, `#TOOL PREP`, `#TOOL REFRESH`; the axis of the tool length: `#TLAX`.
//!
//! Source: TF5200 programming manual, using tool ID, refreshing tool data, axis-specific assignment of tool length compensation
//! (304765835). Assumption: with `-` the length is subtracted along the axis; the length is applied to another axis with the
//! next absolute word, as for a change of the tool.

use super::row::{Call, Row};
use crate::diag::Condition;
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::options::Value;
use crate::syntax::ast::{Item, ItemKind, ItemValue, Span};

/// Row of `#TOOL DATA`.
pub(super) const TOOL_DATA: Row = Row::run("TOOL DATA", tool_data)
    .form("#TOOL DATA [basic, sister, variant]")
    .meaning("selects tool data, like the D word; sister and variant must be 0 or omitted")
    .example("#TOOL DATA [5]")
    .related(&["#TOOL PREP", "#TOOL REFRESH"]);

/// Row of `#TOOL PREP`.
pub(super) const TOOL_PREP: Row = Row::run("TOOL PREP", tool_prep)
    .form("#TOOL PREP [basic, sister, variant]")
    .meaning("selects a tool, like the T word; sister and variant must be 0 or omitted")
    .example("#TOOL PREP [5]")
    .related(&["#TOOL DATA"]);

/// Row of `#TOOL REFRESH`.
pub(super) const TOOL_REFRESH: Row = Row::run("TOOL REFRESH", refresh)
    .bare()
    .form("#TOOL REFRESH")
    .meaning("applies the data of the active tool again, e.g. after an axis exchange")
    .example("#TOOL REFRESH")
    .related(&["#TOOL DATA"]);

/// Row of `#TLAX`.
pub(super) const TLAX: Row = Row::run("TLAX", length_axis)
    .form("#TLAX [axis+]   #TLAX [axis-]   #TLAX DEFAULT")
    .meaning("the length of the tool acts along a main axis of this name in every plane; DEFAULT: along the third axis of the plane")
    .example("#TLAX [Z+]")
    .related(&["#TOOL REFRESH"]);

fn tool_data(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    let (number, span) = basic_number(decoder, call)?;
    decoder.select_tool_data(number, span);
    Ok(())
}

fn tool_prep(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    let (number, span) = basic_number(decoder, call)?;
    decoder.select_tool(number, span);
    Ok(())
}

fn refresh(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    call.no_more_words()?;
    decoder.geometry.coordinates.tool_programmed();
    decoder.geometry.apply_tool(decoder.modal.plane.main_axes());
    decoder.motion.apply_wear(&decoder.geometry, &decoder.modal, &mut decoder.contour, call.span())
}

fn length_axis(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    if let Some(word) = call.command.tail.first() {
        return Err(call.unexpected(word));
    }
    if call.command.on.is_some() {
        return Err(no_length_axis(decoder, call.span()));
    }
    let axis = match (call.rest, &call.command.groups[..]) {
        ([word], []) if word.is("DEFAULT") => None,
        ([], [group]) => {
            let [Item { kind: ItemKind::Flag(word), .. }] = &group.items[..] else {
                return Err(no_length_axis(decoder, group.span));
            };
            let name = word.text.trim_end_matches(['+', '-']);
            let axis = decoder.names.of_name(name);
            let axis = axis.filter(|axis| decoder.geometry.coordinates.main_index(*axis).is_some());
            let axis = axis.filter(|_| name.len() + 1 == word.text.len());
            let sign = if word.text.ends_with('-') { -1.0 } else { 1.0 };
            Some((axis.ok_or_else(|| no_length_axis(decoder, word.span))?, sign))
        }
        ([word, ..], _) => return Err(call.unexpected(word)),
        _ => return Err(no_length_axis(decoder, call.span())),
    };
    decoder.geometry.tools.length_axis = axis;
    decoder.geometry.apply_tool(decoder.modal.plane.main_axes());
    decoder.motion.apply_wear(&decoder.geometry, &decoder.modal, &mut decoder.contour, call.span())
}

fn no_length_axis(decoder: &Decoder, span: Span) -> Box<Fault> {
    let text = "#TLAX needs a main axis and its direction, or DEFAULT";
    Fault::new(Condition::TokenUnknown, text, span).hint(decoder.names.hint())
}

/// The number of the basic tool.
fn basic_number(decoder: &Decoder, call: &Call<'_>) -> Outcome<(f64, Span)> {
    call.no_more_words()?;
    let wrong = |span| {
        let text = format!("{} needs the number of a tool in brackets", call.title());
        Fault::new(Condition::TokenUnknown, text, span)
    };
    let [group] = &call.command.groups[..] else { return Err(wrong(call.span())) };
    let Some((basic, others)) = group.items.split_first() else { return Err(wrong(group.span)) };
    for item in others {
        if !is_zero(decoder, item)? {
            let what = format!("{} with sister tools and variants", call.title());
            return Err(Fault::unsupported(what, item.span));
        }
    }
    match &basic.kind {
        ItemKind::Value(ItemValue::Expr(expr)) => {
            let number = decoder.number(expr)?;
            if !(0.0..=f64::from(i32::MAX)).contains(&number) {
                let text =
                    format!("{}: the number {number} is outside the data format", call.title());
                return Err(Fault::new(Condition::ToolIdFormat, text, expr.span));
            }
            Ok((number, expr.span))
        }
        _ => Err(wrong(basic.span)),
    }
}

/// Omitted or 0.
fn is_zero(decoder: &Decoder, item: &Item) -> Outcome<bool> {
    Ok(match &item.kind {
        ItemKind::Missing => true,
        ItemKind::Value(ItemValue::Expr(expr)) => {
            matches!(decoder.value(expr)?, Value::Number(x) if x.abs() <= 0.0)
        }
        _ => false,
    })
}
