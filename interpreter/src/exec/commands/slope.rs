//! `#SLOPE`, `#SET SLOPE PROFIL`.
//!
//! Source: TF5200 programming manual; 21629 for an unknown type.

use super::keys::arguments;
use super::range::between;
use super::row::{Call, Row};
use crate::diag::{Condition, ValueKind};
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::motion::slope::{slope_of_number, slope_type};
use crate::exec::values::number::whole;
use crate::syntax::ast::{Item, ItemKind, ItemValue};

fn default(decoder: &mut Decoder) {
    decoder.modal.commanded.slope.kind = decoder.machine.channel.dynamics.slope;
    decoder.modal.commanded.slope.optimised = false;
    // the effect of the weights at the start of the program, too (P-CHAN-00001, P-CHAN-00073)
    set_old(decoder, true);
}

fn set_old(decoder: &mut Decoder, old: bool) {
    if decoder.modal.commanded.old_slope != old {
        decoder.modal.commanded.old_slope = old;
        decoder.motion.limits.changed();
    }
}

arguments! {
    /// Keys of `#SLOPE`.
    struct SlopeArguments {
        kind: Word "TYPE", "", "STEP, TRAPEZ, SIN2 or HSC; default prog_start.slope.profile";
        no_opt: Number "NO_OPT" in between(0.0, 1.0).whole(), "", "default 1; 0 matters only with constant ramp times (P-CHAN-00349): there the profile of each run of blocks is planned separately, otherwise across blocks";
    }
}

/// Row of `#SLOPE`.
pub(super) const SLOPE: Row = Row::run("SLOPE", slope)
    .form("#SLOPE [TYPE=STEP|TRAPEZ|SIN2|HSC NO_OPT=0|1]   #SLOPE DEFAULT")
    .meaning("shape of the acceleration; modal, reset at program start")
    .keys(SlopeArguments::KEYS)
    .example("#SLOPE [TYPE=SIN2]")
    .related(&["21629", "P-CHAN-00071", "P-CHAN-00349"]);

/// `#SLOPE [TYPE=.. NO_OPT=..]`, `#SLOPE DEFAULT`.
fn slope(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    match call.rest {
        [] => {}
        [word] if word.is("DEFAULT") => {
            call.no_bracket_beside("DEFAULT")?;
            default(decoder);
            return Ok(());
        }
        [word, ..] => return Err(call.unexpected(word)),
    }
    if call.command.groups.iter().all(|group| group.items.is_empty()) {
        let text = "#SLOPE needs [TYPE=..] or DEFAULT";
        return Err(Fault::new(Condition::TokenUnknown, text, call.span()));
    }
    let keys = SlopeArguments::read(decoder, &call.title(), call.command.groups.first())?;
    if let Some((name, span)) = keys.kind {
        let Some(kind) = slope_type(&name) else {
            let text = format!("unknown slope type {name}");
            return Err(
                Fault::new(Condition::SlopeType, text, span).hint("use STEP, TRAPEZ, SIN2 or HSC")
            );
        };
        decoder.modal.commanded.slope.kind = kind;
    }
    if let Some((x, span)) = keys.no_opt {
        let slope = &mut decoder.modal.commanded.slope;
        slope.optimised = x < 0.5;
        if slope.optimised && !slope.keeps_ramp_times() {
            let text = "NO_OPT=0 changes nothing: without constant ramp times (P-CHAN-00349) the \
                profile uses the whole jerk with NO_OPT=1, too";
            decoder.report.note_once("NO_OPT", Fault::new(Condition::Fallback, text, span));
        }
    }
    set_old(decoder, false);
    Ok(())
}

/// Row of `#SET SLOPE PROFIL`.
pub(super) const SET_SLOPE_PROFIL: Row = Row::run("SET SLOPE PROFIL", set_slope_profile)
    .form("#SET SLOPE PROFIL [n]")
    .meaning("older form of #SLOPE: 0 STEP, 1 TRAPEZ, 2 SIN2, 3 HSC")
    .example("#SET SLOPE PROFIL [1]")
    .related(&["#SLOPE", "P-CHAN-00071", "P-CHAN-00001", "P-CHAN-00073", "120020"]);

/// `#SET SLOPE PROFIL [n]`; without a number as `#SLOPE DEFAULT`.
///
/// Further numbers select the ramp times and accelerations to which the weights apply (120020). Their order is not documented,
/// so only 0, all of them, is accepted.
fn set_slope_profile(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    call.no_more_words()?;
    let Some(group) = call.command.groups.first() else {
        default(decoder);
        return Ok(());
    };
    let [item, modes @ ..] = &group.items[..] else {
        let text = "a number is expected: 0 to 3";
        return Err(Fault::new(Condition::TokenUnknown, text, group.span));
    };
    if let Some(item) = modes.get(2) {
        let text = "up to three numbers are expected: the profile and two weighting modes";
        return Err(Fault::new(Condition::TokenUnknown, text, item.span));
    }
    let value = number(decoder, item)?;
    let Some(kind) = whole(value, 0, 3).and_then(slope_of_number) else {
        let text = format!("slope profile {value} does not exist");
        return Err(Fault::new(Condition::Range, text, item.span)
            .with(|d| {
                d.value(ValueKind::Wrong, value, "-").value(ValueKind::LowerLimit, 0.0, "-").value(
                    ValueKind::UpperLimit,
                    3.0,
                    "-",
                )
            })
            .hint("write 0 (STEP), 1 (TRAPEZ), 2 (SIN2) or 3 (HSC)"));
    };
    for item in modes {
        let mode = number(decoder, item)?;
        match whole(mode, 0, 4) {
            Some(0) => {}
            Some(_) => {
                let what =
                    "a weight that acts on single ramp times or accelerations, set in the program,";
                return Err(Fault::unsupported(what, item.span)
                    .hint("set it with P-CHAN-00073 and P-CHAN-00001 in the channel list"));
            }
            None => {
                let text = format!("mode {mode} of the weights does not exist");
                return Err(Fault::new(Condition::WeightMode, text, item.span)
                    .with(|d| d.value(ValueKind::Current, mode, "-")));
            }
        }
    }
    decoder.modal.commanded.slope.kind = kind;
    set_old(decoder, true);
    Ok(())
}

fn number(decoder: &Decoder, item: &Item) -> Outcome<f64> {
    match &item.kind {
        ItemKind::Value(ItemValue::Expr(expr)) => decoder.number(expr),
        _ => Err(Fault::new(Condition::TokenUnknown, "a number is expected", item.span)),
    }
}
