//! `#ROTATION`, `#CS` and `#MCS`.
//!
//! Source: TF5200 programming manual, coordinate systems (208480907); P-CHAN-00394 (rotations ZYX); 20676, 20825, 21556.

use super::flush::may_flush;
use super::keys::arguments;
use super::row::{Call, Row};
use crate::diag::{Condition, ValueKind};
use crate::exec::block::choice::Compensation;
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::geometry::coordinates::SYSTEMS_MAX;
use crate::exec::geometry::frame::Frame;
use crate::exec::values::number::{LARGEST_MM, whole};
use crate::syntax::ast::{Group, ItemKind, ItemValue, Span};

arguments! {
    /// Keys of `#ROTATION`.
    struct RotationArguments {
        angle: Number "ANGLE", "deg", "default 0";
        centre_1: Number "CENTER1", "mm", "default 0; from the origin of the program";
        centre_2: Number "CENTER2", "mm", "default 0";
    }
}

/// `#ROTATION ON [ANGLE= CENTER1= CENTER2=]`, `OFF`.
pub(super) fn rotation(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    call.no_more_words()?;
    let keys = RotationArguments::read(decoder, &call.title(), call.command.groups.first())?;
    match call.command.on {
        Some(true) => {
            if keys.angle.is_none() {
                let text = "#ROTATION ON without ANGLE rotates by 0 deg";
                let note = Fault::new(Condition::Odd, text, call.span());
                decoder.report.note(note.hint("#ROTATION ON [ANGLE=30]"));
            }
            let unit = decoder.modal.unit_mm();
            let value = |key: Option<(f64, Span)>| key.map_or(0.0, |(x, _)| x);
            let centres = [keys.centre_1, keys.centre_2].into_iter().flatten();
            if let Some((x, span)) = centres.into_iter().find(|c| (c.0 * unit).abs() > LARGEST_MM) {
                let text = format!("the centre {x} of the rotation is outside the data format");
                return Err(Fault::new(Condition::RotationCentreTooLarge, text, span));
            }
            // offsets of the centre from the program origin; 0 if omitted
            let centre = [keys.centre_1, keys.centre_2].map(|key| Some(value(key) * unit));
            let main = decoder.modal.plane.main_axes();
            let deg = value(keys.angle);
            decoder.geometry.rotate_plane(
                &decoder.machine,
                [main[0], main[1]],
                deg,
                centre,
                call.span(),
            )
        }
        Some(false) => {
            call.no_bracket_beside("OFF")?;
            decoder.geometry.coordinates.set_rotation(None);
            Ok(())
        }
        None => Err(Fault::new(Condition::TokenUnknown, "#ROTATION needs ON or OFF", call.span())),
    }
}

/// Six values `[x, y, z, a, b, c]`; the last ones are optional, omitted ones are 0.
pub(super) fn system(decoder: &Decoder, group: &Group) -> Outcome<Frame> {
    let mut values = [0.0; 6];
    if group.items.len() > values.len() {
        return Err(Fault::new(
            Condition::CoordinateSystemSyntax,
            "up to six values: [x,y,z,a,b,c]",
            group.span,
        ));
    }
    for (value, item) in values.iter_mut().zip(&group.items) {
        match &item.kind {
            ItemKind::Missing => {}
            ItemKind::Value(ItemValue::Expr(expr)) => *value = decoder.number(expr)?,
            _ => {
                return Err(Fault::new(
                    Condition::CoordinateSystemSyntax,
                    "a value is expected",
                    item.span,
                ));
            }
        }
    }
    if let Some((angle, item)) =
        values.iter().zip(&group.items).skip(3).find(|(angle, _)| angle.abs() > 360.0)
    {
        let text = format!("the angle {angle} deg of a coordinate system is outside -360 to 360");
        return Err(Fault::new(Condition::SystemAngle, text, item.span).with(|d| {
            d.value(ValueKind::Wrong, *angle, "deg")
                .value(ValueKind::LowerLimit, -360.0, "deg")
                .value(ValueKind::UpperLimit, 360.0, "deg")
        }));
    }
    let unit = decoder.modal.unit_mm();
    let [x, y, z, a, b, c] = values;
    Ok(Frame::coordinate_system([x * unit, y * unit, z * unit], [a, b, c]))
}

/// `[id]`.
fn id_of(decoder: &Decoder, group: &Group) -> Outcome<u32> {
    match &group.items[..] {
        [item] => match &item.kind {
            ItemKind::Value(ItemValue::Expr(expr)) => {
                let number = decoder.number(expr)?;
                whole(number, 1, u32::MAX).ok_or_else(|| {
                    let text = format!("the number {number} of a coordinate system");
                    Fault::new(Condition::CoordinateSystemNumber, text, expr.span).with(|d| {
                        d.value(ValueKind::Wrong, number, "-").value(
                            ValueKind::LowerLimit,
                            1.0,
                            "-",
                        )
                    })
                })
            }
            _ => Err(Fault::new(
                Condition::CoordinateSystemSyntax,
                "a number is expected",
                item.span,
            )),
        },
        _ => {
            Err(Fault::new(Condition::CoordinateSystemSyntax, "one number is expected", group.span))
        }
    }
}

/// A stored system with its number; 20821 if there is none.
fn stored(decoder: &Decoder, id: u32, span: Span) -> Outcome<(Frame, Option<u32>)> {
    let frame = decoder.geometry.coordinates.stored_system(id).ok_or_else(|| {
        let text = format!("coordinate system {id} is not defined");
        Fault::new(Condition::NoCoordinateSystem, text, span)
            .with(|d| d.value(ValueKind::Wrong, f64::from(id), "-"))
    })?;
    Ok((frame, Some(id)))
}

/// Millimetres and degrees must not mix: a system rotates linear axes among themselves, and rotary axes among themselves.
pub(super) fn turns_alike(decoder: &Decoder, call: &Call<'_>, frame: &Frame) -> Outcome<()> {
    let main = |i: usize| decoder.geometry.coordinates.main_axis(i);
    let kind = |i: usize| main(i).map(|axis| decoder.machine.axes[axis].kind());
    for (i, j) in [(0, 1), (0, 2), (1, 2)] {
        let turned = frame.m[i][j].abs() > 0.0 || frame.m[j][i].abs() > 0.0;
        if turned && main(i).is_some() && main(j).is_some() && kind(i) != kind(j) {
            let what = format!("{} rotates a rotary axis and a linear axis", call.title());
            return Err(Fault::unsupported(what, call.span()));
        }
    }
    Ok(())
}

/// K-0150: no main axis may move independently.
pub(super) fn no_independent_axis(decoder: &Decoder, call: &Call<'_>) -> Outcome<()> {
    let Decoder { motion, geometry, names, .. } = decoder;
    let title = call.title();
    motion.independent.none_independent(&title, &geometry.coordinates, names, call.span())
}

/// 21556: a main axis of a coordinate system must not be a modulo axis.
pub(super) fn no_modulo_axes(decoder: &Decoder, call: &Call<'_>) -> Outcome<()> {
    let axes = (0..3).filter_map(|main| decoder.geometry.coordinates.main_axis(main));
    let mut modulo = axes.map(|axis| &decoder.machine.axes[axis]).filter(|axis| axis.is_modulo());
    let Some(axis) = modulo.next() else { return Ok(()) };
    let name = axis.name().to_owned();
    let text = format!("{}: the main axis {name} is a modulo axis", call.title());
    Err(Fault::new(Condition::SystemOfModuloAxis, text, call.span())
        .with(|d| d.axis(axis.number(), name)))
}

/// `#CS ON [..]`, `#CS ON [id]`, `#CS OFF`, `#CS OFF ALL`.
pub(super) fn coordinate_system(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    if decoder.geometry.coordinates.is_machine() {
        return Err(Fault::unsupported("#CS between #MCS ON and #MCS OFF", call.span()));
    }
    no_compensation(decoder, call)?;
    if decoder.geometry.coordinates.stack().active() > 0 {
        let what = format!("{} while a system of #CS SELECT is active", call.title());
        return Err(
            Fault::unsupported(what, call.span()).hint("use #CS DEL ALL to delete the stack")
        );
    }
    if let Some(word) = call.rest.first() {
        if word.is("MODE") {
            return Err(Fault::unsupported("#CS MODE", call.span()));
        }
        return Err(call.unexpected(word));
    }
    may_flush(decoder, call)?;
    let command = call.command;
    match (command.on, &command.tail[..], &command.groups[..]) {
        (Some(false), [], []) => {
            decoder.geometry.coordinates.pop_system();
            Ok(())
        }
        (Some(false), [word], _) if word.is("ALL") => {
            call.no_bracket_beside("OFF ALL")?;
            decoder.geometry.coordinates.clear_systems();
            Ok(())
        }
        (Some(true), [], groups) => {
            if decoder.geometry.coordinates.systems() >= SYSTEMS_MAX {
                let text = format!("more than {SYSTEMS_MAX} coordinate systems are active");
                return Err(Fault::new(Condition::Range, text, call.span()));
            }
            let (frame, number) = system_of(decoder, call, groups)?;
            no_modulo_axes(decoder, call)?;
            turns_alike(decoder, call, &frame)?;
            no_independent_axis(decoder, call)?;
            decoder.geometry.coordinates.push_system(frame, number);
            Ok(())
        }
        (_, [word, ..], _) => Err(call.unexpected(word)),
        (Some(false), ..) => call.no_bracket_beside("OFF"),
        _ => Err(Fault::new(Condition::CoordinateSystemSyntax, "#CS needs ON or OFF", call.span())),
    }
}

/// The system that the brackets of `#CS ON` define or name, with its number; one with both is stored.
fn system_of(
    decoder: &mut Decoder,
    call: &Call<'_>,
    groups: &[Group],
) -> Outcome<(Frame, Option<u32>)> {
    match groups {
        [] => stored(decoder, decoder.geometry.last_system, call.span()),
        // a single value is the number of a stored system
        [group] if group.items.len() == 1 => {
            let id = id_of(decoder, group)?;
            stored(decoder, id, group.span)
        }
        [group] => Ok((system(decoder, group)?, None)),
        [id, group] => {
            let id = id_of(decoder, id)?;
            let frame = system(decoder, group)?;
            store(decoder, id, frame, call.span())?;
            Ok((frame, Some(id)))
        }
        _ => {
            let text = "too many brackets";
            Err(Fault::new(Condition::CoordinateSystemSyntax, text, call.span()))
        }
    }
}

fn store(decoder: &mut Decoder, id: u32, frame: Frame, span: Span) -> Outcome<()> {
    if decoder.geometry.coordinates.is_system_active(id) {
        let text = format!("coordinate system {id} is active and cannot be redefined");
        return Err(Fault::new(Condition::ActiveSystemDefined, text, span)
            .with(|d| d.value(ValueKind::Wrong, f64::from(id), "-")));
    }
    let known = decoder.geometry.coordinates.stored_system(id).is_some();
    if !known && decoder.geometry.coordinates.stored_systems() >= SYSTEMS_MAX {
        let text = format!("more than {SYSTEMS_MAX} coordinate systems are stored");
        return Err(Fault::new(Condition::SystemsTooMany, text, span));
    }
    decoder.geometry.coordinates.store_system(id, frame);
    decoder.geometry.last_system = id;
    Ok(())
}

/// `#CS DEF [id][x,y,z,a,b,c]`.
pub(super) fn define_system(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    call.no_more_words()?;
    match &call.command.groups[..] {
        [group] => {
            let frame = system(decoder, group)?;
            // the next free number
            let coordinates = &decoder.geometry.coordinates;
            let is_taken = |id: &u32| coordinates.stored_system(*id).is_some();
            let id = (1..=SYSTEMS_MAX as u32).find(|id| !is_taken(id));
            store(decoder, id.unwrap_or(u32::MAX), frame, call.span())
        }
        [id, group] => {
            let id = id_of(decoder, id)?;
            let frame = system(decoder, group)?;
            store(decoder, id, frame, call.span())
        }
        _ => Err(Fault::new(
            Condition::CoordinateSystemSyntax,
            "#CS DEF needs [id][x,y,z,a,b,c]",
            call.span(),
        )),
    }
}

/// 20802 for a change of the coordinate system between G41 or G42 and G40.
pub(super) fn no_compensation(decoder: &Decoder, call: &Call<'_>) -> Outcome<()> {
    if decoder.modal.compensation == Compensation::Off {
        return Ok(());
    }
    let text = format!("{} while tool radius compensation is active", call.title());
    Err(Fault::new(Condition::SystemWithCompensation, text, call.span()))
}

/// Row of `#MCS`.
pub(super) const MCS: Row = Row::run("MCS", machine_coordinates).bare()
    .form("#MCS ON   #MCS ON EX TOOL   #MCS OFF")
    .meaning("suspends coordinate systems, rotation, mirroring and all offsets: axis words are axis positions; OFF restores them")
    .note("EX TOOL: a tool change in between takes effect only at OFF")
    .example("#MCS ON")
    .related(&["20802"]);

/// `#MCS ON`, `#MCS ON EX TOOL`, `#MCS OFF`.
fn machine_coordinates(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    if let Some(word) = call.rest.first() {
        return Err(call.unexpected(word));
    }
    let without_tools = match &call.command.tail[..] {
        [] => false,
        [ex, tool] if ex.is("EX") && tool.is("TOOL") => true,
        [word, ..] => return Err(call.unexpected(word)),
    };
    let Some(on) = call.command.on else {
        let text = "#MCS needs ON or OFF";
        return Err(Fault::new(Condition::TokenUnknown, text, call.span()));
    };
    no_compensation(decoder, call)?;
    if on {
        decoder.geometry.coordinates.enter_machine(without_tools);
    } else if decoder.geometry.coordinates.leave_machine() {
        decoder.geometry.apply_tool(decoder.modal.plane.main_axes());
    }
    Ok(())
}
