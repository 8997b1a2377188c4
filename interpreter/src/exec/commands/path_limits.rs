//! Commands that limit the path: `#VECTOR LIMIT` and its older forms, `#TRANSVELMIN`, `#OVERRIDE`.
//!
//! Source: TF5200 programming manual.

use super::keys::arguments;
use super::range::above_zero;
use super::row::{Call, Row};
use crate::diag::Condition;
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::syntax::ast::{Command, Group, Ident, Item, ItemKind, ItemValue, Span};
use kontur_motion::block::VectorLimits;

arguments! {
    /// Keys of `#VECTOR LIMIT`; without a value the configured limit applies.
    struct VectorArguments {
        vel: MaybeNumber "VEL" in above_zero(), "mm/min (G70: inch/min)", "P-CHAN-00090";
        acc: MaybeNumber "ACC" in above_zero(), "mm/min2, mm/s2 by P-CHAN-00351", "P-CHAN-00002";
        dec: MaybeNumber "DEC" in above_zero(), "mm/min2, mm/s2 by P-CHAN-00351", "P-CHAN-00208";
        jerk: MaybeNumber "JERK" in above_zero(), "mm/s3", "";
        radial_acc: MaybeNumber "RADIAL_ACC" in above_zero(), "mm/min2, mm/s2 by P-CHAN-00351", "P-CHAN-00361";
        radial_jerk: MaybeNumber "RADIAL_JERK" in above_zero(), "mm/min3, mm/s3 by P-CHAN-00351", "";
        trans_acc: MaybeNumber "TRANS_ACC" in above_zero(), "mm/s2", "";
        feed: Flag "FEED", "", "for feed blocks only";
        rapid: Flag "RAPID", "", "for rapid blocks only";
    }
}

/// Acceleration of `#VECTOR LIMIT` in mm/s2 below which its unit is probably wrong.
const TINY_MM_S2: f64 = 10.0;

/// Row of `#VECTOR LIMIT`.
pub(super) const VECTOR_LIMIT: Row = Row::run("VECTOR LIMIT", vector_limit)
    .form("#VECTOR LIMIT ON [VEL=.. ACC=.. DEC=.. JERK=.. RADIAL_ACC=.. RADIAL_JERK=.. TRANS_ACC=.. FEED RAPID]   #VECTOR LIMIT ON ALL   #VECTOR LIMIT OFF")
    .meaning("limits speed and acceleration along the path")
    .keys(VectorArguments::KEYS)
    .note("a key without a value takes the configured limit")
    .example("#VECTOR LIMIT ON [ACC=1800000]")
    .related(&["P-CHAN-00002", "P-CHAN-00090", "P-CHAN-00208", "P-CHAN-00361", "P-CHAN-00351"]);

/// `#VECTOR LIMIT ON [..]`, `ON ALL`, `OFF [VEL]`, `OFF`. FEED or RAPID restrict the command to these blocks.
///
/// The unit of ACC, DEC, RADIAL_ACC and RADIAL_JERK is that of P-CHAN-00351, mm/min2 and mm/min3 by default.
///
/// Assumption: the meaning of FEED and RAPID follows from their names; without them, or with both, the command applies to all
/// blocks. JERK and TRANS_ACC, which P-CHAN-00351 does not name, are in mm/s3 and mm/s2. G70 applies to VEL as to the velocity
/// of `#TRANSVELMIN`, but not to accelerations and jerks, which have units in mm.
fn vector_limit(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    let Some(on) = call.command.on else {
        let text = "#VECTOR LIMIT needs ON or OFF";
        return Err(Fault::new(Condition::TokenUnknown, text, call.span()));
    };
    let listed = decoder.machine.channel.dynamics.vector;
    match &call.command.tail[..] {
        [] => {}
        [word] if word.is("ALL") => {
            call.no_bracket_beside(if on { "ON ALL" } else { "OFF ALL" })?;
            let vector = if on { listed } else { VectorLimits::default() };
            decoder.motion.limits.change_vector([true, true], |v| *v = vector);
            return Ok(());
        }
        [word, ..] => return Err(call.unexpected(word)),
    }
    let keys = VectorArguments::read(decoder, &call.title(), call.command.groups.first())?;
    let meant = match (call.name, [keys.feed.is_some(), keys.rapid.is_some()]) {
        ("VECTORACC", _) => [true, false],
        (_, [false, false]) => [true, true],
        (_, named) => named,
    };
    match (on, keys.limits_nothing()) {
        (false, true) => {
            decoder.motion.limits.change_vector(meant, |v| *v = VectorLimits::default());
        }
        (true, true) => {
            let text = "#VECTOR LIMIT ON limits nothing: a key or ALL is expected";
            return Err(Fault::new(Condition::TokenUnknown, text, call.span()));
        }
        (_, false) => {
            let change = keys.change(decoder, on);
            decoder.motion.limits.change_vector(meant, change);
        }
    }
    Ok(())
}

impl VectorArguments {
    fn limits_nothing(&self) -> bool {
        let Self { vel, acc, dec, jerk, radial_acc, radial_jerk, trans_acc, .. } = self;
        [vel, acc, dec, jerk, radial_acc, radial_jerk, trans_acc].iter().all(|key| key.is_none())
    }

    /// What the keys change, in mm and s; accelerations that are tiny in them are noted.
    fn change(&self, decoder: &mut Decoder, on: bool) -> impl Fn(&mut VectorLimits) + use<> {
        let listed = decoder.machine.channel.dynamics.vector;
        let t = decoder.machine.channel.dynamics.vector_time_s;
        let per_time2 = (t * t).recip();
        for (key, name) in [(self.acc, "ACC"), (self.dec, "DEC"), (self.radial_acc, "RADIAL_ACC")] {
            let Some((Some(x), span)) = key else { continue };
            let acc_mm_s2 = x * per_time2;
            if acc_mm_s2 < TINY_MM_S2 && t > 1.0 {
                let text = format!("{name}={x} mm/min2 is {acc_mm_s2:.3} mm/s2");
                decoder.report.note(Fault::new(Condition::PathAccelerationTiny, text, span));
            }
        }
        let value = |key: Option<(Option<f64>, Span)>, scale: f64, listed: Option<f64>| {
            let (x, _) = key?;
            Some(if on { x.map(|x| x * scale).or(listed) } else { None })
        };
        let vel = value(self.vel, decoder.modal.unit_mm() / 60.0, listed.vel_mm_s);
        let acc = value(self.acc, per_time2, listed.acc_mm_s2);
        let dec = value(self.dec, per_time2, listed.dec_mm_s2);
        let jerk = value(self.jerk, 1.0, listed.jerk_mm_s3);
        let radial_acc = value(self.radial_acc, per_time2, listed.radial_acc_mm_s2);
        let radial_jerk = value(self.radial_jerk, per_time2 / t, listed.radial_jerk_mm_s3);
        let trans_acc = value(self.trans_acc, 1.0, listed.trans_acc_mm_s2);
        move |v| {
            v.vel_mm_s = vel.unwrap_or(v.vel_mm_s);
            v.acc_mm_s2 = acc.unwrap_or(v.acc_mm_s2);
            v.dec_mm_s2 = dec.unwrap_or(v.dec_mm_s2);
            v.jerk_mm_s3 = jerk.unwrap_or(v.jerk_mm_s3);
            v.radial_acc_mm_s2 = radial_acc.unwrap_or(v.radial_acc_mm_s2);
            v.radial_jerk_mm_s3 = radial_jerk.unwrap_or(v.radial_jerk_mm_s3);
            v.trans_acc_mm_s2 = trans_acc.unwrap_or(v.trans_acc_mm_s2);
        }
    }
}

/// Row of `#VECTORVEL`.
pub(super) const VECTORVEL: Row = Row::run("VECTORVEL", vector_of_one)
    .form("#VECTORVEL ON [v]   #VECTORVEL [v] ON   #VECTORVEL OFF")
    .meaning("older form of #VECTOR LIMIT ON [VEL=v]; without v the configured limit")
    .example("#VECTORVEL ON [5000]")
    .related(&["#VECTOR LIMIT", "P-CHAN-00090"]);

/// Row of `#VECTORACC`.
pub(super) const VECTORACC: Row = Row::run("VECTORACC", vector_of_one)
    .form("#VECTORACC ON [a]   #VECTORACC [a] ON   #VECTORACC OFF")
    .meaning("older form of #VECTOR LIMIT ON [ACC=a FEED]; without a the configured limit")
    .example("#VECTORACC ON [2700000]")
    .related(&["#VECTOR LIMIT", "P-CHAN-00002"]);

/// `#VECTORVEL`, `#VECTORACC` (HSC 15427960971): equivalent to `#VECTOR LIMIT` with one key; `#VECTORACC` limits feed blocks
/// only (15425556619).
fn vector_of_one(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    call.no_more_words()?;
    let key = if call.name == "VECTORVEL" { "VEL" } else { "ACC" };
    let kind = match call.command.groups.first().map(|group| &group.items[..]) {
        None => ItemKind::Flag(Ident { text: key.into(), span: call.span() }),
        Some([Item { kind: ItemKind::Value(value), span }]) => {
            let key = Ident { text: key.into(), span: *span };
            ItemKind::Pair { key, value: value.clone() }
        }
        Some(_) => {
            let text = format!("{} takes one value", call.title());
            return Err(Fault::new(Condition::TokenUnknown, text, call.span()));
        }
    };
    let group = Group { items: vec![Item { kind, span: call.span() }], span: call.span() };
    let command = Command { groups: vec![group], ..call.command.clone() };
    vector_limit(decoder, &Call { command: &command, name: call.name, rest: call.rest })
}

/// Row of `#TRANSVELMIN`.
pub(super) const TRANSVELMIN: Row = Row::run("TRANSVELMIN", transition_velocity)
    .values()
    .form("#TRANSVELMIN ON|OFF")
    .meaning("lowest speed at block transitions")
    .example("#TRANSVELMIN ON")
    .related(&["P-AXIS-00013"]);

/// `#TRANSVELMIN ON [v]`, `OFF`: lower bound of the velocity at corners in mm/min.
fn transition_velocity(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
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
        let text = format!("#TRANSVELMIN: {value} is not a velocity");
        return Err(Fault::new(Condition::Range, text, call.span()));
    }
    decoder.modal.commanded.transition_min_mm_s = value * decoder.modal.unit_mm() / 60.0;
    decoder.motion.limits.changed();
    Ok(())
}

/// Row of `#OVERRIDE`.
pub(super) const OVERRIDE: Row = Row::run("OVERRIDE", path_override)
    .form("#OVERRIDE [FEED_FACT=.. RAPID_FACT=..]")
    .meaning("multiplies F and the rapid speed")
    .keys(crate::exec::block::brackets::OverrideArguments::KEYS)
    .example("#OVERRIDE [FEED_FACT=50]")
    .related(&["P-CHAN-00066", "P-CHAN-00181", "G166"]);

/// `#OVERRIDE [FEED_FACT= RAPID_FACT=]`.
fn path_override(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    call.no_more_words()?;
    decoder.set_overrides(None, call.command.groups.first(), "#OVERRIDE", call.span())
}
