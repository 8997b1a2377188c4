//! Axis exchange within the axes of the machine: `#PUT AX`, `#CALL AX`, `#SET AX`.
//!
//! An exchange assigns a name and a position among the main axes to an axis, or removes both. It switches off a Vibration Guard
//! activated by the program.
//!
//! Source: TF5200 programming manual, axis exchange; TF5250 Vibration Guard.

mod members;
mod taken;

use super::row::{Call, Row};
use super::shaping;
use crate::diag::{Condition, ValueKind};
use crate::exec::block::choice::Compensation;
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::step::Sync;
use crate::exec::values::number::whole;
use crate::syntax::ast::{ItemKind, Span};
use members::{default_feed_group, exchanged, full_feedforward, full_feedforward_of_all, release};
use taken::take_all;

/// Row of `#PUT AX`.
pub(super) const PUT_AX: Row = Row::run("PUT AX", put).several()
    .form("#PUT AX [name]")
    .example("#PUT AX [X]")
    .meaning("axis exchange: adds axes to the channel or releases them")
    .note(
        "switches off a Vibration Guard that the program has switched on, and resets the G136 weights of these axes to 100 %",
    )
    .related(&["20312", "21251", "21372", "#VIB GUARD"]);

/// `#PUT AX [X, ..]`, `#PUT AX ALL`: an axis that is not in the channel is accepted.
pub(super) fn put(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    let all = call.rest.iter().chain(&call.command.tail).any(|w| w.is("ALL"));
    let released = |item: &crate::syntax::ast::Item| match &item.kind {
        ItemKind::Flag(name) => decoder.names.of_name(&name.text),
        _ => None,
    };
    let named: Vec<usize> = if all {
        (0..decoder.machine.axes.len()).collect()
    } else {
        call.command.groups.iter().flat_map(|g| &g.items).filter_map(released).collect()
    };
    decoder.motion.couplings.moves_no_coupled(
        named.iter().copied(),
        &decoder.machine,
        Condition::CoupledAxisReleased,
        call.span(),
    )?;
    if beside_contour(decoder, &named) {
        may_exchange(decoder, call.span())?;
    } else {
        exchange(decoder, call.span())?;
    }
    keep_face_axis(decoder, |axis| named.contains(&axis), call.span())?;
    full_feedforward(decoder, &named);
    if all {
        decoder.names.release_all();
        for main in 0..3 {
            decoder.geometry.coordinates.set_main_axis(main, None);
        }
    } else if let Some(word) = call.rest.first() {
        return Err(call.unexpected(word));
    } else if call.command.groups.iter().all(|g| g.items.is_empty()) {
        let text = "#PUT AX releases nothing: no axis is named";
        let note = Fault::new(Condition::Odd, text, call.span());
        decoder.report.note(note.hint("#PUT AX [Z], or #PUT AX ALL"));
    }
    for item in call.command.groups.iter().flat_map(|g| &g.items) {
        let ItemKind::Flag(name) = &item.kind else {
            return Err(Fault::new(
                Condition::AxisNameUnknown,
                "an axis name is expected",
                item.span,
            ));
        };
        if let Some(axis) = decoder.names.of_name(&name.text) {
            release(decoder, axis);
        } else if !decoder.machine.axes.iter().any(|axis| name.is(axis.name())) {
            let text =
                format!("`{}` is not an axis of the channel: nothing is released", name.text);
            decoder.report.note(Fault::new(Condition::Ignored, text, item.span));
        }
    }
    exchanged(decoder);
    Ok(())
}

/// Row of `#CALL AX`.
pub(super) const CALL_AX: Row = Row::run("CALL AX", call).several()
    .form("#CALL AX [name,number,index]")
    .example("#CALL AX [X,1,0]")
    .meaning("axis exchange: adds axes to the channel or releases them")
    .note(
        "switches off a Vibration Guard that the program has switched on, and resets the G136 weights of these axes to 100 %",
    )
    .related(&["20312", "21251", "21372", "#VIB GUARD"]);

/// `#CALL AX [FAST] [name, number, index, options]..`.
pub(super) fn call(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    exchange(decoder, call.span())?;
    if let Some(word) = call.rest.iter().find(|w| !w.is("FAST")) {
        return Err(call.unexpected(word));
    }
    let before = main_axes(decoder);
    take_all(decoder, call)?;
    keep_face_axis(decoder, |axis| is_elsewhere(decoder, before, axis), call.span())
}

/// Row of `#SET AX`.
pub(super) const SET_AX: Row = Row::run("SET AX", set).several()
    .form("#SET AX [name,number,index]")
    .example("#SET AX [X,1,0]")
    .meaning("axis exchange: adds axes to the channel or releases them")
    .note(
        "switches off a Vibration Guard that the program has switched on, and resets the G136 weights of these axes to 100 %",
    )
    .related(&["20312", "21251", "21372", "#VIB GUARD"]);

/// `#SET AX [name, number, index, options]..`: replaces the set of axes.
pub(super) fn set(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    exchange_all(decoder, call.span())?;
    if let Some(word) = call.rest.iter().find(|w| !w.is("FAST")) {
        return Err(call.unexpected(word));
    }
    let before = main_axes(decoder);
    full_feedforward_of_all(decoder);
    decoder.names.release_all();
    for main in 0..3 {
        decoder.geometry.coordinates.set_main_axis(main, None);
    }
    take_all(decoder, call)?;
    keep_face_axis(decoder, |axis| is_elsewhere(decoder, before, axis), call.span())
}

/// `#AX DEF DEFAULT`: the set of the channel list.
pub(super) fn define(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    exchange_all(decoder, call.span())?;
    let before = main_axes(decoder);
    match call.rest {
        [word] if word.is("DEFAULT") => {
            full_feedforward_of_all(decoder);
            for axis in 0..decoder.machine.axes.len() {
                let listed = decoder.machine.axes[axis].name().to_owned();
                decoder.names.rename(axis, Some(listed));
            }
            for main in 0..3 {
                let axis = (main < decoder.machine.axes.len()).then_some(main);
                decoder.geometry.coordinates.set_main_axis(main, axis);
            }
            exchanged(decoder);
        }
        _ => take_all(decoder, call)?,
    }
    keep_face_axis(decoder, |axis| is_elsewhere(decoder, before, axis), call.span())
}

/// The main axes.
fn main_axes(decoder: &Decoder) -> [Option<usize>; 3] {
    [0, 1, 2].map(|main| decoder.geometry.coordinates.main_axis(main))
}

/// Whether an axis that was one of these main axes is not the same one any more.
fn is_elsewhere(decoder: &Decoder, before: [Option<usize>; 3], axis: usize) -> bool {
    let place = |axes: [Option<usize>; 3]| axes.iter().position(|main| *main == Some(axis));
    place(before) != place(main_axes(decoder))
}

/// The face turning axis of G51 (20546) and of G96 (20641) stays the main axis that it is; `leaves`: whether an axis does not.
///
/// Source: TF5200 diagnosis 251825035, 252086155, about `#PUT AX`. Assumption: the other commands may not move it either.
fn keep_face_axis(decoder: &Decoder, leaves: impl Fn(usize) -> bool, span: Span) -> Outcome<()> {
    let of_diameters = (decoder.modal.diameter, "G51", Condition::FaceAxisReleased);
    let of_speed = (decoder.motion.cutting.axis(), "G96", Condition::CuttingAxisReleased);
    for (axis, function, condition) in [of_diameters, of_speed] {
        let Some(axis) = axis.filter(|axis| leaves(*axis)) else { continue };
        let text = format!("the face turning axis cannot be released under {function}");
        let listed = &decoder.machine.axes[axis];
        let (number, name) = (listed.number(), listed.name().to_owned());
        return Err(Fault::new(condition, text, span).with(|d| d.axis(number, name)));
    }
    Ok(())
}

/// `#FGROUP [X, Y]`: the axes to which the feed rate refers; without a bracket those of the channel list.
pub(super) fn feed_group(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    if call.rest.iter().any(|w| w.is("ROT") || w.is("WAXIS")) {
        return Err(Fault::unsupported("#FGROUP ROT and #FGROUP WAXIS", call.span()));
    }
    call.no_more_words()?;
    let mut members = vec![false; decoder.machine.axes.len()];
    let named = match call.command.groups.first() {
        Some(group) => decoder.names.all_in_command(std::slice::from_ref(group))?,
        None => Vec::new(),
    };
    if named.is_empty() {
        default_feed_group(decoder);
        if !decoder.machine.channel.feed.lists_axes {
            let text = "#FGROUP without axes, and none in the list: the main axes are used";
            decoder.report.note(Fault::new(Condition::FeedGroupDefault, text, call.span()));
        }
        return Ok(());
    }
    for axis in named {
        if std::mem::replace(&mut members[axis], true) {
            let text = format!("#FGROUP: {} twice", decoder.names.name(axis));
            return Err(Fault::new(Condition::FeedGroupTwice, text, call.span()));
        }
    }
    decoder.motion.limits.set_feed_axes(members, true);
    Ok(())
}

/// As [`exchange`], for a command that arranges all axes anew: none of them may be coupled (21312).
fn exchange_all(decoder: &mut Decoder, span: Span) -> Outcome<()> {
    let axes = 0..decoder.machine.axes.len();
    let condition = Condition::CoupledAxisSorted;
    decoder.motion.couplings.moves_no_coupled(axes, &decoder.machine, condition, span)?;
    exchange(decoder, span)
}

/// Whether these axes may be released on a compensated contour, which continues without a stop: none belongs to its plane
/// (exception list of commands with active TRC, 524821515). A Vibration Guard of the program would have to be switched off at
/// rest.
fn beside_contour(decoder: &Decoder, axes: &[usize]) -> bool {
    let [first, second, _] = decoder.modal.plane.main_axes();
    let plane = [first, second].map(|main| decoder.geometry.coordinates.main_axis(main));
    decoder.modal.compensation != Compensation::Off
        && decoder.shaping.guard_on.is_none()
        && axes.iter().all(|axis| !plane.contains(&Some(*axis)))
}

/// An axis exchange is possible here.
///
/// # Errors
/// 20535 under G63, 20684 while a coordinate system is active, 20683 while a kinematic transformation is.
fn may_exchange(decoder: &Decoder, span: Span) -> Outcome<()> {
    if decoder.modal.path.is_tapping() {
        let text = "an axis exchange during tapping";
        return Err(Fault::new(Condition::ExchangeWhileTapping, text, span));
    }
    if decoder.geometry.coordinates.systems() > 0 {
        let text = "an axis exchange while a coordinate system is active";
        return Err(Fault::new(Condition::ExchangeInSystem, text, span));
    }
    if decoder.geometry.transformation_on {
        let text = "an axis exchange while a kinematic transformation is active";
        return Err(Fault::new(Condition::ExchangeInTransformation, text, span));
    }
    Ok(())
}

/// The path stops; a Vibration Guard of the program is switched off. Errors of [`may_exchange`].
fn exchange(decoder: &mut Decoder, span: Span) -> Outcome<()> {
    may_exchange(decoder, span)?;
    decoder.sync(Sync::FlushWait);
    let (was_on, programmed) = (shaping::guard_is_on(decoder), decoder.shaping.guard_on);
    if decoder.shaping.exchange_axes() {
        if was_on {
            let text = match programmed {
                Some(_) => "the axis exchange switches the Vibration Guard of the program off",
                None => {
                    "after the axis exchange the Vibration Guard has the values of the axis lists, without AX_DEV"
                }
            };
            let hint = "program #VIB GUARD ON again after it";
            decoder.report.note(Fault::new(Condition::GuardExchanged, text, span).hint(hint));
        }
        decoder.update_shaping(span);
    }
    Ok(())
}

/// A logical axis number (P-AXIS-00016); 21567 outside its range (diagnosis 255232651).
pub(super) fn logical_number(number: f64, span: Span) -> Outcome<u32> {
    const LAST: u32 = 65_534;
    whole(number, 1, LAST).ok_or_else(|| {
        let text = format!("logical axis number {number}, allowed: 1 to {LAST}");
        Fault::new(Condition::LogicalNumber, text, span).with(|d| {
            d.value(ValueKind::Wrong, number, "-").value(ValueKind::LowerLimit, 1, "-").value(
                ValueKind::UpperLimit,
                LAST,
                "-",
            )
        })
    })
}

/// `AXNR=`: the axis of the channel with a logical number; 21372 if there is none (254401419).
pub(super) fn of_logical_number(decoder: &Decoder, number: f64, span: Span) -> Outcome<usize> {
    let number = logical_number(number, span)?;
    let axis = decoder.machine.axes.iter().position(|axis| axis.number() == number);
    axis.ok_or_else(|| {
        let text = format!("no axis of the channel has the logical number {number}");
        Fault::new(Condition::LogicalNumberUnknown, text, span)
            .with(|d| d.value(ValueKind::Wrong, number, "-"))
    })
}
