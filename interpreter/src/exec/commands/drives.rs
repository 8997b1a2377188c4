//! `#DRIVE WR SYN`, `#DRIVE WAIT SYN`: functions of drives, which the simulated drives do not have.
//!
//! Written values have no effect (K-0111). WAIT stops the path; the drive answers at once.
//!
//! Source: TF5200 programming manual 207630987, 207636491, 207643147. Assumptions: the path comes to rest for WAIT and for
//! `#DRIVE WAIT SYN` even if the drive has answered before; no page prints a number for a turning spindle.

use super::axes::{logical_number, of_logical_number};
use super::keys::arguments;
use super::range::{Range, between};
use super::row::{Call, Row};
use crate::diag::Condition;
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::step::Sync;
use crate::syntax::ast::Span;

/// A positive integer.
const POSITIVE: Range = between(1.0, u32::MAX as f64).whole();

arguments! {
    /// Keys of `#DRIVE WR SYN`.
    struct WriteArguments {
        axis: Word "AX", "", "axis or spindle";
        number: Number "AXNR", "", "logical number instead of AX";
        motor: Number "MOTOR" in POSITIVE, "", "motor of the amplifier";
        set: Number "PARAM_SET" in POSITIVE, "", "parameter set of the amplifier";
        key: Word "KEY", "", "name of the function";
        value: Number "VAL" in between(-2_147_483_648.0, 4_294_967_295.0).whole(), "", "value to be written";
        wait: Flag "WAIT", "", "the path stops until the drive has answered";
    }
}

arguments! {
    /// Keys of `#DRIVE WAIT SYN`.
    struct WaitArguments {
        axis: Word "AX", "", "axis or spindle";
        number: Number "AXNR", "", "logical number instead of AX";
        done: Flag "SWITCH_OK", "", "all functions written before are completed";
    }
}

/// Row of `#DRIVE`.
pub(super) const DRIVE: Row = Row::run("DRIVE", drive)
    .form("#DRIVE WR SYN [AX=.. KEY=.. VAL=.. MOTOR=.. PARAM_SET=.. WAIT]   #DRIVE WAIT SYN [AX=.. SWITCH_OK]")
    .meaning("writes a function of a drive and waits for it; the simulated drive keeps the values of its lists")
    .keys(WriteArguments::KEYS)
    .example("#DRIVE WR SYN [AX=X KEY=torque_limit VAL=400 WAIT]")
    .related(&["K-0111"]);

fn drive(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    let group = call.command.groups.first();
    match call.rest {
        [word, syn] if word.is("WR") && syn.is("SYN") => {
            let keys = WriteArguments::read(decoder, &call.title(), group)?;
            let driven = driven(decoder, call, keys.axis.as_ref(), keys.number)?;
            let missing = match (&keys.key, &keys.value) {
                (None, _) => Some("KEY"),
                (_, None) => Some("VAL"),
                _ => None,
            };
            if let Some(name) = missing {
                let text = format!("#DRIVE WR SYN needs {name}");
                return Err(Fault::new(Condition::TokenUnknown, text, call.span()));
            }
            let switched = keys.motor.or(keys.set);
            if let (Driven::Spindle(spindle), Some((_, at))) = (driven, switched)
                && decoder.motion.spindles[spindle].is_turning()
            {
                let text =
                    "#DRIVE: motor and parameter set cannot be switched while the spindle turns";
                return Err(Fault::new(Condition::Syntax, text, at).hint("write M5 before it"));
            }
            let text = "#DRIVE WR SYN: the simulated drive keeps the values of its lists";
            decoder.report.note_once("#DRIVE", Fault::new(Condition::Fallback, text, call.span()));
            if keys.wait.is_some() {
                decoder.sync(Sync::Halt);
            }
        }
        [word, syn] if word.is("WAIT") && syn.is("SYN") => {
            let keys = WaitArguments::read(decoder, &call.title(), group)?;
            driven(decoder, call, keys.axis.as_ref(), keys.number)?;
            if keys.done.is_none() {
                let text = "#DRIVE WAIT SYN needs SWITCH_OK";
                return Err(Fault::new(Condition::TokenUnknown, text, call.span()));
            }
            decoder.sync(Sync::Halt);
        }
        [word, ..] => return Err(call.unexpected(word)),
        [] => {
            let text = "#DRIVE needs WR SYN or WAIT SYN";
            return Err(Fault::new(Condition::TokenUnknown, text, call.span()));
        }
    }
    Ok(())
}

/// What `AX=` or `AXNR=` names: indices of the executor.
#[derive(Clone, Copy, Debug)]
pub(super) enum Driven {
    Axis(usize),
    Spindle(usize),
}

/// The named axis or spindle. 20797 if the name is unknown, 21372 if the number is.
pub(super) fn driven(
    decoder: &Decoder,
    call: &Call<'_>,
    name: Option<&(Box<str>, Span)>,
    number: Option<(f64, Span)>,
) -> Outcome<Driven> {
    match (name, number) {
        (Some((name, span)), None) => {
            if let Some(spindle) = decoder.motion.spindle_of_name(name, &decoder.machine.channel) {
                return Ok(Driven::Spindle(spindle));
            }
            decoder.names.of_name(name).map(Driven::Axis).ok_or_else(|| {
                let text = format!("unknown axis `{name}`");
                Fault::new(Condition::AxisNameUnknown, text, *span).hint(decoder.names.hint())
            })
        }
        (None, Some((number, span))) => {
            let wanted = logical_number(number, span)?;
            let spindle = |index: usize| decoder.machine.spindles[index].number() == wanted;
            match decoder.motion.spindles.iter().position(|s| s.index.is_some_and(spindle)) {
                Some(spindle) => Ok(Driven::Spindle(spindle)),
                None => of_logical_number(decoder, number, span).map(Driven::Axis),
            }
        }
        _ => {
            let text = format!("{} requires either AX or AXNR", call.title());
            Err(Fault::new(Condition::TokenUnknown, text, call.span()))
        }
    }
}
