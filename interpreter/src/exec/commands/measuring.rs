//! `#MEAS`: the type of measuring runs, and the reaction to a missing signal.
//!
//! Source: TF5200 programming manual, switching of the measuring type (207084683), extended programming (207092107).

use super::keys::arguments;
use super::range::between;
use super::row::{Call, Row};
use crate::diag::Condition;
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::motion::state::measuring::Measuring;
use crate::exec::values::number::is_true;
use crate::syntax::ast::{ItemKind, ItemValue};

arguments! {
    /// Keys of `#MEAS`.
    struct MeasArguments {
        kind: Number "TYPE" in between(1.0, 7.0).whole(), "", "1: several axes, 2: one axis at P-AXIS-00215, 3: with G106 up to the target, 4: main axes, 5 and 6: G310";
        err_no_signal: Number "ERR_NO_SIGNAL" in between(0.0, 1.0).whole(), "", "1: a run without a signal is an error (P-CHAN-00176)";
        simu_offset: Number "SIMU_OFFSET", "mm", "not supported, the signal comes from --input";
        trigger: Flag "TRIGGER", "", "not supported (edge banding)";
        ax: Word "AX", "", "settings of one axis are not supported: there is one probe";
        axnr: Number "AXNR", "", "the same by the logical axis number";
        signal: Word "SIGNAL", "", "of AX";
        edge: Word "EDGE", "", "of AX";
        input: Number "INPUT", "", "of AX";
        g107: Flag "G107", "", "of AX";
        g108: Flag "G108", "", "of AX";
    }
}

/// Row of `#MEAS`.
pub(super) const MEAS: Row = Row::run("MEAS", settings)
    .form("#MEAS [TYPE=1 ERR_NO_SIGNAL=0|1]")
    .meaning("type of measuring runs (G100, G310), and whether a missing probe signal is an error")
    .keys(MeasArguments::KEYS)
    .example("#MEAS [TYPE=3 ERR_NO_SIGNAL=1]")
    .related(&["G100", "G310", "K-0133", "P-CHAN-00057", "P-CHAN-00176"]);

fn settings(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    call.no_more_words()?;
    let group = call.command.groups.first();
    if group.is_none_or(|g| g.items.is_empty()) {
        let text = "#MEAS requires its settings in brackets";
        return Err(Fault::new(Condition::TokenUnknown, text, call.span()));
    }
    let keys = MeasArguments::read(decoder, &call.title(), group)?;
    let numbers = [("SIMU_OFFSET", keys.simu_offset), ("AXNR", keys.axnr), ("INPUT", keys.input)];
    let numbers = numbers.map(|(name, key)| key.map(|(_, span)| (name, span)));
    let words = [("AX", &keys.ax), ("SIGNAL", &keys.signal), ("EDGE", &keys.edge)];
    let words = words.map(|(name, key)| key.as_ref().map(|(_, span)| (name, *span)));
    let flags = [("TRIGGER", keys.trigger), ("G107", keys.g107), ("G108", keys.g108)];
    let flags = flags.map(|(name, key)| key.map(|span| (name, span)));
    let others = numbers.into_iter().chain(words).chain(flags);
    if let Some((name, span)) = others.flatten().next() {
        return Err(Fault::unsupported(format!("#MEAS [{name}]"), span));
    }
    if let Some((kind, _)) = keys.kind {
        decoder.motion.measuring.kind = kind as u32;
    }
    if let Some((is_error, _)) = keys.err_no_signal {
        decoder.motion.measuring.missing_is_error = Some(is_true(is_error));
    }
    Ok(())
}

/// Row of `#MEAS MODE`.
pub(super) const MEAS_MODE: Row = Row::run("MEAS MODE", mode)
    .form("#MEAS MODE [type]")
    .meaning("type of measuring runs, 1 to 7; without a type, the type of the list (P-CHAN-00057)")
    .example("#MEAS MODE [3]")
    .related(&["#MEAS", "P-CHAN-00057"]);

fn mode(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    call.no_more_words()?;
    let items = call.command.groups.first().map_or(&[][..], |g| &g.items[..]);
    decoder.motion.measuring.kind = match items {
        [] => decoder.machine.channel.measuring.kind,
        [item] => {
            let ItemKind::Value(ItemValue::Expr(expr)) = &item.kind else {
                let text = "#MEAS MODE needs a number";
                return Err(Fault::new(Condition::TokenUnknown, text, item.span));
            };
            decoder.whole(expr, "the measuring type", 1, 7)?
        }
        [_, second, ..] => {
            let text = "#MEAS MODE takes one number";
            return Err(Fault::new(Condition::TokenUnknown, text, second.span));
        }
    };
    Ok(())
}

/// Row of `#MEAS DEFAULT`.
pub(super) const MEAS_DEFAULT: Row = Row::run("MEAS DEFAULT", defaults)
    .bare()
    .form("#MEAS DEFAULT")
    .meaning("measuring as configured in the lists")
    .example("#MEAS DEFAULT")
    .related(&["#MEAS"]);

fn defaults(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    call.no_more_words()?;
    let listed = Measuring::new(&decoder.machine.channel, 0);
    let measuring = &mut decoder.motion.measuring;
    (measuring.kind, measuring.missing_is_error) = (listed.kind, listed.missing_is_error);
    Ok(())
}
