//! Commands that act on the contour and on path limits: `#CONTOUR MODE`, `#HSC`, `#VECTOR LIMIT`, `#TRANSVELMIN`,
//! `#OVERRIDE`.
//!
//! Source: TF5200 programming manual.

use super::keys::{flag, number};
use super::{Call, Key, Kind, arguments};
use crate::diag::{Condition, ValueKind};
use crate::exec::contouring::{Contouring, Mode};
use crate::exec::decoder::Decoder;
use crate::exec::expr::is_true;
use crate::exec::fault::{Fault, Outcome};
use crate::syntax::ast::{Group, ItemKind, ItemValue};
use kontur_motion::block::{CurveJerk, VectorLimits};

const fn maybe(name: &'static str) -> Key {
    Key { name, kind: Kind::MaybeNumber }
}

/// Modes that take a word.
const MODES: &[(&str, Mode)] = &[
    ("DEV", Mode::Dev),
    ("AUTO_DEV", Mode::Dev),
    ("DIST", Mode::Dist),
    ("POS", Mode::Pos),
    ("PTP", Mode::Ptp),
    ("DIST_SOFT", Mode::DistSoft),
    ("DIST_MASTER", Mode::DistMaster),
];

/// `#CONTOUR MODE [ON|OFF] [DEV .. ]`: a key that is not written keeps its value.
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
    let unit = decoder.tolerance_unit_mm();
    let mut settings = decoder.contouring;
    let group = points(decoder, call.command.groups.first(), &mut settings)?;
    let keys = arguments(decoder, "#CONTOUR MODE", group.as_ref(), KEYS);
    if let Some(span) = keys.place("AUTO_VEL").or(keys.place("SYM_DIST")) {
        return Err(Fault::unsupported("#CONTOUR MODE [AUTO_VEL] and [SYM_DIST]", span));
    }
    if let Some((x, span)) = keys.number("PATH_DEV") {
        let mm = x * unit;
        if mm < PATH_DEV_MIN_MM {
            let text = format!("PATH_DEV={x} is below the minimum of {PATH_DEV_MIN_MM} mm");
            return Err(Fault::new(Condition::PathDevTooSmall, text, span).with(|d| {
                d.value(ValueKind::Wrong, mm * 1e4, "0.1um").value(
                    ValueKind::LowerLimit,
                    1.0,
                    "0.1um",
                )
            }));
        }
    }
    let mut modes = MODES.iter().filter(|(name, _)| keys.has(name));
    if let Some((first, mode)) = modes.next() {
        settings.mode = *mode;
        if let Some((second, _)) = modes.next() {
            let text = format!("#CONTOUR MODE: {first} and {second} are two modes");
            let at = keys.place(second).unwrap_or(call.span());
            return Err(Fault::new(Condition::DuplicateKey, text, at));
        }
    }
    // POS alone allows a distance of 0
    for key in ["PRE_DIST", "POST_DIST"] {
        if let Some((x, span)) = keys.number(key)
            && settings.mode != Mode::Pos
            && x * unit < PATH_DEV_MIN_MM
        {
            let text = format!("{key}={x} is below the minimum of {PATH_DEV_MIN_MM} mm");
            return Err(Fault::new(Condition::CornerDistanceTooSmall, text, span).with(|d| {
                d.value(ValueKind::Wrong, x * unit * 1e4, "0.1um").value(
                    ValueKind::LowerLimit,
                    1.0,
                    "0.1um",
                )
            }));
        }
    }
    let length = |name: &str, low: f64| {
        let x = keys.in_range(name, low, f64::MAX, Condition::Range)?;
        Ok::<Option<f64>, Box<Fault>>(x.map(|x| x * unit))
    };
    let set = |slot: &mut f64, new: Option<f64>| *slot = new.unwrap_or(*slot);
    set(&mut settings.path_dev_mm, length("PATH_DEV", 0.0)?);
    set(&mut settings.pre_mm, length("PRE_DIST", 0.0)?);
    set(&mut settings.post_mm, length("POST_DIST", 0.0)?);
    set(&mut settings.path_dist_mm, length("PATH_DIST", -1.0)?);
    let common = &mut settings.common;
    set(&mut common.relevant_path_mm, length("RELEVANT_PATH", 0.0)?);
    set(&mut common.track_dev_deg, keys.in_range("TRACK_DEV", 0.0, 1e6, Condition::Range)?);
    set(
        &mut common.relevant_track_deg,
        keys.in_range("RELEVANT_TRACK", 0.0, 1e6, Condition::Range)?,
    );
    let remain = keys.in_range("REMAIN_PART", 0.0, 100.0, Condition::Range)?;
    set(&mut common.remain_ratio, remain.map(|p| p / 100.0));
    set(&mut common.max_angle_deg, keys.in_range("MAX_ANGLE", 0.0, 180.0, Condition::Range)?);
    if keys.has("CONST_VEL") {
        common.constant_velocity = keys.number("CONST_VEL").is_none_or(|(x, _)| is_true(x));
    }
    if keys.has("CHECK_JERK") {
        let mode = keys.in_range("CHECK_JERK", 0.0, 3.0, Condition::Range)?.unwrap_or(1.0);
        common.curve_jerk = Some(match crate::exec::expr::whole(mode, 0, 3) {
            Some(0) => CurveJerk::Unlimited,
            Some(2) => CurveJerk::Ramps,
            _ => CurveJerk::Geometric,
        });
    }
    decoder.contouring = settings;
    for action in ["PRE_ACTION", "POST_ACTION"] {
        if let Some(span) = keys.place(action) {
            let text = format!("{action}: functions act at the corner here");
            decoder.note_once(action, Fault::new(Condition::Fallback, text, span));
        }
    }
    let soft = matches!(settings.mode, Mode::DistSoft | Mode::DistMaster);
    for key in ["MERGE", "TRACK_DIST", "ACC_MAX", "ACC_MIN", "RAMP_TIME", "DIST_WEIGHT"] {
        if let Some(span) = keys.place(key) {
            let text = format!("#CONTOUR MODE: {key} has no effect");
            decoder.note_once(key, Fault::new(Condition::Fallback, text, span));
        }
    }
    if soft {
        let text = "#CONTOUR MODE: the curve of this mode is not published, corners are rounded as with PTP";
        decoder.note_once("DIST_SOFT", Fault::new(Condition::Fallback, text, call.span()));
    }
    if let Some(on) = call.command.on {
        decoder.modal.contouring = on;
        decoder.modal.exact_stop &= !on;
    }
    Ok(())
}

/// Takes the coordinates of an interim point out of the bracket; the rest is keys.
fn points(
    decoder: &Decoder,
    group: Option<&Group>,
    settings: &mut Contouring,
) -> Outcome<Option<Group>> {
    let Some(group) = group else { return Ok(None) };
    let mut rest = Group { items: Vec::new(), span: group.span };
    for item in &group.items {
        let main_axis = |name: &str| decoder.axis_of_name(name).filter(|axis| *axis < 3);
        let point = match &item.kind {
            ItemKind::Pair { key, value: ItemValue::Expr(expr) } => match main_axis(&key.text) {
                Some(axis) => Some((axis, decoder.number(expr)?)),
                None => None,
            },
            // `X2.7`
            ItemKind::Flag(word) => word
                .split_number()
                .and_then(|(name, number)| main_axis(name).map(|axis| (axis, number))),
            _ => None,
        };
        let Some((axis, value)) = point else {
            rest.items.push(item.clone());
            continue;
        };
        if !decoder.coordinates.frame().is_identity() {
            let what = "an interim point of #CONTOUR MODE in a frame";
            return Err(Fault::unsupported(what, item.span));
        }
        let value = value * decoder.axis_unit(axis);
        settings.point_mm[axis] = Some(value + decoder.coordinates.active_offset(axis));
    }
    Ok(Some(rest))
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
    let unit = decoder.tolerance_unit_mm();
    let keys = arguments(decoder, "#HSC", call.command.groups.first(), KEYS);
    let mut hsc = decoder.hsc;
    if let Some((mode, span)) = keys.number("OPMODE") {
        match crate::exec::expr::whole(mode, 1, 2) {
            Some(1) => hsc.rounds_corners = true,
            Some(_) => return Err(Fault::unsupported("#HSC [OPMODE=2]", span)),
            None => {
                let text = format!("OPMODE={mode}, allowed are 1 and 2");
                return Err(Fault::new(Condition::Range, text, span));
            }
        }
    }
    if keys.has("BSPLINE") {
        hsc.rounds_corners = false;
    }
    let set = |slot: &mut f64, new: Option<f64>| *slot = new.unwrap_or(*slot);
    let length = |name: &str| {
        let x = keys.in_range(name, 0.0, f64::MAX, Condition::Range)?;
        Ok::<Option<f64>, Box<Fault>>(x.map(|x| x * unit))
    };
    set(&mut hsc.spline.path_dev_mm, length("PATH_DEV")?);
    set(&mut hsc.spline.track_dev_deg, keys.in_range("TRACK_DEV", 0.0, 1e6, Condition::Range)?);
    set(&mut hsc.spline.max_length_mm, length("MAX_PATH_LENGTH")?);
    set(&mut hsc.spline.max_angle_deg, keys.in_range("MAX_ANGLE", 0.0, 180.0, Condition::Range)?);
    set(&mut hsc.contour_error_mm, length("CONTERROR")?);
    let switch = |name: &str, slot: &mut bool| {
        if keys.has(name) {
            *slot = keys.number(name).is_none_or(|(x, _)| is_true(x));
        }
    };
    switch("AUTO_OFF_PATH", &mut hsc.spline.off_at_path_dev);
    switch("AUTO_OFF_TRACK", &mut hsc.spline.off_at_track_dev);
    switch("AUTO_OFF_G00", &mut hsc.spline.off_at_rapid);
    if let Some(span) = keys.place("MERGE") {
        let text = "#HSC: MERGE has no effect";
        decoder.note_once("HSC MERGE", Fault::new(Condition::Fallback, text, span));
    }
    hsc.on = call.command.on.unwrap_or(hsc.on);
    decoder.hsc = hsc;
    Ok(())
}

/// `#VECTOR LIMIT ON [..]`, `ON ALL`, `OFF [VEL]`, `OFF`. FEED or RAPID restrict what is said to these blocks.
///
/// Assumption: the meaning of FEED and RAPID, from their names; without them, or with both, all blocks are meant.
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
        return Err(Fault::new(Condition::TokenUnknown, text, call.span()));
    };
    let listed = decoder.machine.channel.vector;
    match &call.command.tail[..] {
        [] => {}
        [word] if word.is("ALL") => {
            decoder.vector = [if on { listed } else { VectorLimits::default() }; 2];
            decoder.dynamics_changed();
            return Ok(());
        }
        [word, ..] => return Err(call.unexpected(word)),
    }
    let keys = arguments(decoder, "#VECTOR LIMIT", call.command.groups.first(), KEYS);
    let named = [keys.has("FEED"), keys.has("RAPID")];
    let meant = if named == [false, false] { [true, true] } else { named };
    let limits = keys.count() - named.iter().filter(|n| **n).count();
    if !on && limits == 0 {
        for (vector, _) in decoder.vector.iter_mut().zip(meant).filter(|(_, meant)| *meant) {
            *vector = VectorLimits::default();
        }
        decoder.dynamics_changed();
        return Ok(());
    }
    let unit = decoder.unit_mm();
    // VEL in mm/min, the others in mm/s2 and mm/s3
    let value = |name: &str, scale: f64, listed: Option<f64>| -> Outcome<Option<Option<f64>>> {
        if !on {
            return Ok(keys.has(name).then_some(None));
        }
        match keys.in_range(name, f64::MIN_POSITIVE, f64::MAX, Condition::Range)? {
            Some(x) => Ok(Some(Some(x * scale))),
            None => Ok(keys.has(name).then_some(listed)),
        }
    };
    let vel = value("VEL", unit / 60.0, listed.vel_mm_s)?;
    let acc = value("ACC", unit, listed.acc_mm_s2)?;
    let dec = value("DEC", unit, listed.dec_mm_s2)?;
    let jerk = value("JERK", unit, listed.jerk_mm_s3)?;
    let radial_acc = value("RADIAL_ACC", unit, listed.radial_acc_mm_s2)?;
    let radial_jerk = value("RADIAL_JERK", unit, listed.radial_jerk_mm_s3)?;
    let trans_acc = value("TRANS_ACC", unit, listed.trans_acc_mm_s2)?;
    for (v, _) in decoder.vector.iter_mut().zip(meant).filter(|(_, meant)| *meant) {
        v.vel_mm_s = vel.unwrap_or(v.vel_mm_s);
        v.acc_mm_s2 = acc.unwrap_or(v.acc_mm_s2);
        v.dec_mm_s2 = dec.unwrap_or(v.dec_mm_s2);
        v.jerk_mm_s3 = jerk.unwrap_or(v.jerk_mm_s3);
        v.radial_acc_mm_s2 = radial_acc.unwrap_or(v.radial_acc_mm_s2);
        v.radial_jerk_mm_s3 = radial_jerk.unwrap_or(v.radial_jerk_mm_s3);
        v.trans_acc_mm_s2 = trans_acc.unwrap_or(v.trans_acc_mm_s2);
    }
    decoder.dynamics_changed();
    Ok(())
}

/// `#TRANSVELMIN ON [v]`, `OFF`: lower bound of the velocity at kinks in mm/min.
pub(super) fn transition_velocity(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    let value = match (call.command.on, &call.command.arguments[..], call.command.groups.first()) {
        (Some(false), _, _) | (Some(true), [], None) => 0.0,
        (Some(true), [expr], _) => decoder.number(expr)?,
        (Some(true), [], Some(group)) => match &group.items[..] {
            [] => 0.0,
            [item] => match &item.kind {
                ItemKind::Value(ItemValue::Expr(expr))
                | ItemKind::Pair { value: ItemValue::Expr(expr), .. } => decoder.number(expr)?,
                _ => {
                    return Err(Fault::new(
                        Condition::TokenUnknown,
                        "a velocity is expected",
                        item.span,
                    ));
                }
            },
            _ => {
                return Err(Fault::new(
                    Condition::TokenUnknown,
                    "one velocity is expected",
                    group.span,
                ));
            }
        },
        _ => {
            return Err(Fault::new(
                Condition::TokenUnknown,
                "#TRANSVELMIN needs ON or OFF",
                call.span(),
            ));
        }
    };
    if !(0.0..=1e9).contains(&value) {
        let text = format!("#TRANSVELMIN: {value} is no velocity");
        return Err(Fault::new(Condition::Range, text, call.span()));
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
