//! Reads positions of the machine into variables: `#GET CMDPOS`, `#GET ACTPOS` and the older `#SET IPO SOLLPOS`.
//!
//! The path stops, then each variable is set to the position of its axis. Nothing else changes: neither the programmed position
//! nor `V.A.ABS`. Those of modulo axes are within their range. Assumption: positions are those of the axis, without zero offsets, coordinate systems and mirroring, as in
//! `V.A.ACT_POS`.
//!
//! Source: TF5200 programming manual, request command and actual positions; 20186, 20500.

use super::row::{Call, Row};
use crate::diag::{Condition, ValueKind};
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::options::Value;
use crate::exec::step::Sync;
use crate::syntax::ast::{ItemKind, ItemValue, Span};

/// Maximum number of assignments of one command. Assumption: one for each axis that a channel can have; the vendor prints no
/// number.
const MOST: usize = 32;

/// Row of `#GET CMDPOS`.
pub(super) const GET_CMDPOS: Row = Row::run("GET CMDPOS", command_positions).several().values()
    .form("#GET CMDPOS [variable=axis, ..]")
    .meaning("stops the path and writes the command positions of axes to P parameters and V.P, V.L, V.S variables")
    .note("positions of the axes, without offsets; #SET IPO SOLLPOS is the older name")
    .example("#GET CMDPOS [P1=X, V.P.POS=Z]")
    .related(&["#GET ACTPOS", "#CHANNEL INIT", "20186"]);

/// Row of `#SET IPO SOLLPOS`.
pub(super) const SET_IPO_SOLLPOS: Row =
    Row::run("SET IPO SOLLPOS", command_positions).several().values();

/// Row of `#GET ACTPOS`.
pub(super) const GET_ACTPOS: Row = Row::run("GET ACTPOS", actual_positions)
    .several()
    .values()
    .form("#GET ACTPOS [variable=axis, ..]")
    .meaning(
        "stops the path and writes the actual positions of axes to P parameters and V.P, V.L, V.S variables",
    )
    .note("positions of the axes, without offsets")
    .example("#GET ACTPOS [P1=X, V.P.POS=Z]")
    .related(&["#GET CMDPOS", "#CHANNEL INIT", "20186"]);

fn command_positions(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    super::flush::may_flush(decoder, call)?;
    decoder.sync(Sync::FlushWait);
    assign(decoder, call, |d, axis| d.geometry.coordinates.target()[axis])
}

/// The executor has waited for the actual positions before this block.
fn actual_positions(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    let actual = |d: &Decoder, axis: usize| {
        let known = d.live.feedback().actual_mm.get(axis).copied();
        known.unwrap_or_else(|| d.geometry.coordinates.target()[axis])
    };
    assign(decoder, call, actual)
}

fn wrong(call: &Call<'_>, span: Span) -> Box<Fault> {
    let text = format!("{}: variable=axis is expected, separated by commas", call.title());
    Fault::new(Condition::PositionRequest, text, span)
}

fn assign(
    decoder: &mut Decoder,
    call: &Call<'_>,
    position: impl Fn(&Decoder, usize) -> f64,
) -> Outcome<()> {
    if call.command.groups.is_empty() {
        return Err(wrong(call, call.span()));
    }
    call.no_more_words()?;
    let ([group], []) = (&call.command.groups[..], &call.command.arguments[..]) else {
        return Err(wrong(call, call.span()));
    };
    if group.items.is_empty() {
        return Err(wrong(call, group.span));
    }
    if group.items.len() > MOST {
        let text = format!("{}: more than {MOST} positions", call.title());
        return Err(Fault::new(Condition::PositionRequests, text, group.span)
            .with(|d| d.value(ValueKind::UpperLimit, MOST as f64, "-")));
    }
    for item in &group.items {
        let ItemKind::Target { place, value: ItemValue::Name(axis) } = &item.kind else {
            return Err(wrong(call, item.span));
        };
        let axis = decoder.names.in_command(axis)?;
        let of = &decoder.machine.axes[axis];
        let value = of.in_modulo_range(position(decoder, axis)) / decoder.modal.axis_unit(of);
        decoder.write(place, Value::Number(value), item.span)?;
    }
    Ok(())
}
