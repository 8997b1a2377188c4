//! Commands that act on the contour and on path limits: `#CONTOUR MODE`, `#HSC`, `#VECTOR LIMIT`, `#TRANSVELMIN`,
//! `#OVERRIDE`.
//!
//! Source: TF5200 programming manual.

use super::keys::{flag, number};
use super::{Call, Key, Kind, arguments};
use crate::diag::ValueKind;
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome, own};
use kontur_motion::block::VectorLimits;

const fn maybe(name: &'static str) -> Key {
    Key { name, kind: Kind::MaybeNumber }
}

/// `#CONTOUR MODE [ON|OFF] [DEV .. ]`.
pub(super) fn contour_mode(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    /// Smallest `PATH_DEV` in mm: one increment of the language.
    const PATH_DEV_MIN_MM: f64 = 1e-4;
    const KEYS: &[Key] = &[
        flag("DEV"),
        flag("DIST"),
        flag("DIST_SOFT"),
        flag("DIST_MASTER"),
        flag("POS"),
        flag("PTP"),
        flag("AUTO_DEV"),
        maybe("AUTO_VEL"),
        number("PATH_DEV"),
        number("RELEVANT_PATH"),
        number("TRACK_DEV"),
        number("RELEVANT_TRACK"),
        number("REMAIN_PART"),
        maybe("CHECK_JERK"),
        number("MAX_ANGLE"),
        maybe("CONST_VEL"),
        number("PRE_DIST"),
        number("POST_DIST"),
        number("PATH_DIST"),
        number("TRACK_DIST"),
        maybe("MERGE"),
        number("SYM_DIST"),
        number("ACC_MAX"),
        number("ACC_MIN"),
        number("RAMP_TIME"),
        number("DIST_WEIGHT"),
        flag("PRE_ACTION"),
        flag("INTER_ACTION"),
        flag("POST_ACTION"),
    ];
    call.no_more_words()?;
    let keys = arguments(decoder, "#CONTOUR MODE", call.command.groups.first(), KEYS);
    if let Some((x, span)) = keys.number("PATH_DEV") {
        let mm = x * decoder.tolerance_unit_mm();
        if mm < PATH_DEV_MIN_MM {
            let text = format!("PATH_DEV={x} is below the minimum of {PATH_DEV_MIN_MM} mm");
            return Err(Fault::vendor(120129, text, span).with(|d| {
                d.value(ValueKind::Wrong, mm * 1e4, "0.1um").value(
                    ValueKind::LowerLimit,
                    1.0,
                    "0.1um",
                )
            }));
        }
    }
    for mode in ["DIST_SOFT", "DIST_MASTER", "POS", "PTP", "AUTO_VEL"] {
        if let Some(span) = keys.place(mode) {
            return Err(Fault::unsupported(format!("#CONTOUR MODE [{mode}]"), span));
        }
    }
    for action in ["PRE_ACTION", "POST_ACTION"] {
        if let Some(span) = keys.place(action) {
            let text = format!("{action}: functions act at the corner here");
            decoder.note_once(action, Fault::kontur(own::FALLBACK, text, span));
        }
    }
    match call.command.on {
        Some(true) => {
            decoder.modal.contouring = true;
            decoder.modal.exact_stop = false;
            decoder.contouring_fallback(call.span());
        }
        Some(false) => decoder.modal.contouring = false,
        None => {}
    }
    Ok(())
}

/// `#HSC [ON|OFF] [BSPLINE ..]`, `#HSC [..] [OPMODE= CONTERROR=]`.
pub(super) fn hsc(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    const KEYS: &[Key] = &[
        flag("BSPLINE"),
        number("PATH_DEV"),
        number("TRACK_DEV"),
        maybe("MERGE"),
        maybe("AUTO_OFF_PATH"),
        maybe("AUTO_OFF_TRACK"),
        maybe("AUTO_OFF_G00"),
        maybe("AUTO_OFF_G60"),
        number("MAX_PATH_LENGTH"),
        number("MAX_ANGLE"),
        number("OPMODE"),
        number("CONTERROR"),
    ];
    call.no_more_words()?;
    let keys = arguments(decoder, "#HSC", call.command.groups.first(), KEYS);
    keys.in_range("PATH_DEV", 0.0, f64::MAX, own::RANGE)?;
    keys.in_range("CONTERROR", 0.0, f64::MAX, own::RANGE)?;
    keys.in_range("OPMODE", 1.0, 2.0, own::RANGE)?;
    if call.command.on == Some(true) {
        let within = match keys.number("PATH_DEV").or(keys.number("CONTERROR")) {
            Some((x, _)) => format!("{x} mm"),
            None => "PATH_DEV".to_owned(),
        };
        let text = format!(
            "#HSC: short blocks are not smoothed, the polygon is driven as programmed (the control's path differs by at most {within})"
        );
        decoder.note_once("#HSC", Fault::kontur(own::FALLBACK, text, call.span()));
    }
    Ok(())
}

/// `#VECTOR LIMIT ON [..]`, `ON ALL`, `OFF [VEL]`, `OFF`.
pub(super) fn vector_limit(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    const KEYS: &[Key] = &[
        maybe("VEL"),
        maybe("ACC"),
        maybe("DEC"),
        maybe("JERK"),
        maybe("RADIAL_ACC"),
        maybe("RADIAL_JERK"),
        maybe("TRANS_ACC"),
        flag("FEED"),
        flag("RAPID"),
    ];
    let Some(on) = call.command.on else {
        let text = "#VECTOR LIMIT needs ON or OFF";
        return Err(Fault::vendor(21220, text, call.span()));
    };
    let listed = decoder.machine.channel.vector;
    match &call.command.tail[..] {
        [] => {}
        [word] if word.is("ALL") => {
            decoder.vector = if on { listed } else { VectorLimits::default() };
            decoder.dynamics_changed();
            return Ok(());
        }
        [word, ..] => return Err(call.unexpected(word)),
    }
    let keys = arguments(decoder, "#VECTOR LIMIT", call.command.groups.first(), KEYS);
    for half in ["FEED", "RAPID"] {
        if let Some(span) = keys.place(half) {
            let text = format!(
                "#VECTOR LIMIT: the limits act in feed and rapid blocks, {half} is ignored"
            );
            decoder.note_once("vector half", Fault::kontur(own::FALLBACK, text, span));
        }
    }
    if !on && call.command.groups.is_empty() {
        decoder.vector = VectorLimits::default();
        decoder.dynamics_changed();
        return Ok(());
    }
    let unit = decoder.unit_mm();
    // VEL in mm/min, the others in mm/s2 and mm/s3
    let value = |name: &str, scale: f64, listed: Option<f64>| -> Outcome<Option<Option<f64>>> {
        if !on {
            return Ok(keys.has(name).then_some(None));
        }
        match keys.in_range(name, f64::MIN_POSITIVE, f64::MAX, own::RANGE)? {
            Some(x) => Ok(Some(Some(x * scale))),
            None => Ok(keys.has(name).then_some(listed)),
        }
    };
    let mut v = decoder.vector;
    let set = |slot: &mut Option<f64>, new: Option<Option<f64>>| {
        if let Some(new) = new {
            *slot = new;
        }
    };
    set(&mut v.vel_mm_s, value("VEL", unit / 60.0, listed.vel_mm_s)?);
    set(&mut v.acc_mm_s2, value("ACC", unit, listed.acc_mm_s2)?);
    set(&mut v.dec_mm_s2, value("DEC", unit, listed.dec_mm_s2)?);
    set(&mut v.jerk_mm_s3, value("JERK", unit, listed.jerk_mm_s3)?);
    set(&mut v.radial_acc_mm_s2, value("RADIAL_ACC", unit, listed.radial_acc_mm_s2)?);
    set(&mut v.radial_jerk_mm_s3, value("RADIAL_JERK", unit, listed.radial_jerk_mm_s3)?);
    set(&mut v.trans_acc_mm_s2, value("TRANS_ACC", unit, listed.trans_acc_mm_s2)?);
    decoder.vector = v;
    decoder.dynamics_changed();
    Ok(())
}

/// `#TRANSVELMIN ON [v]`, `OFF`: lower bound of the velocity at kinks in mm/min.
pub(super) fn transition_velocity(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    let value = match (call.command.on, &call.command.arguments[..], call.command.groups.first()) {
        (Some(false), _, _) | (Some(true), [], None) => 0.0,
        (Some(true), [expr], _) => decoder.number(expr)?,
        (Some(true), [], Some(group)) => {
            use crate::syntax::ast::{ItemKind, ItemValue};
            match &group.items[..] {
                [] => 0.0,
                [item] => match &item.kind {
                    ItemKind::Value(ItemValue::Expr(expr))
                    | ItemKind::Pair { value: ItemValue::Expr(expr), .. } => {
                        decoder.number(expr)?
                    }
                    _ => return Err(Fault::vendor(21220, "a velocity is expected", item.span)),
                },
                _ => return Err(Fault::vendor(21220, "one velocity is expected", group.span)),
            }
        }
        _ => return Err(Fault::vendor(21220, "#TRANSVELMIN needs ON or OFF", call.span())),
    };
    if !(0.0..=1e9).contains(&value) {
        let text = format!("#TRANSVELMIN: {value} is no velocity");
        return Err(Fault::kontur(own::RANGE, text, call.span()));
    }
    decoder.modal.transition_min_mm_s = value * decoder.unit_mm() / 60.0;
    decoder.dynamics_changed();
    Ok(())
}

/// `#OVERRIDE [FEED_FACT= RAPID_FACT=]`.
pub(super) fn path_override(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    call.no_more_words()?;
    decoder.set_overrides(None, call.command.groups.first(), "#OVERRIDE", call.span())
}
