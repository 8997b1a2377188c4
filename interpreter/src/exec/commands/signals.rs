//! Signals between channels: `#SIGNAL`, and the `#WAIT [ID=..]` that consumes them.
//!
//! There is only one channel: signals to itself or to all can be waited for, signals to others are discarded, and a wait for
//! another channel does not wait (K-0018).
//!
//! Source: TF5200 programming manual, sending signals, waiting for signals; 21344.

use super::row::{Call, Row};
use crate::diag::Condition;
use crate::exec::decoder::{Decoder, Signal};
use crate::exec::fault::{Fault, Outcome};
use crate::exec::options::Value;
use crate::exec::values::number::{as_number, whole};
use crate::syntax::ast::{
    ExprKind, Group, ItemKind, ItemValue, ParameterIndex, Place, PlaceKind, Span,
};

/// Number of the channel. Assumption: the simulated channel is the first one of the machine.
const OWN_CHANNEL: u32 = 1;

/// Maximum number of pending signals. Assumption: the vendor prints no number for 250001.
const MOST: usize = 1000;

/// Highest index of a signal parameter.
const PARAMETER_MAX: u32 = 11;

/// Row of `#SIGNAL`.
pub(super) const SIGNAL: Row = Row::run("SIGNAL", signal)
    .form("#SIGNAL [SYN] [ID=.. COUNT=.. P[i]=.. CH=..]   #SIGNAL REMOVE [ID=..]")
    .meaning("sends a signal to a channel, or to all channels without CH; #WAIT consumes it")
    .note("ID: number; COUNT: number of waits it ends; P[0] to P[11]: values passed to the waiting channel; CH: receiving channels")
    .example("#SIGNAL [ID=4711 P[0]=10.5]")
    .related(&["#WAIT", "K-0018"]);

/// Contents of the bracket of `#SIGNAL` and `#WAIT`.
#[derive(Default)]
struct Words<'c> {
    id: Option<u32>,
    count: Option<u32>,
    channels: Vec<u32>,
    parameters: Vec<(u32, &'c ItemValue, Span)>,
}

fn wrong(call: &Call<'_>, span: Span) -> Box<Fault> {
    let text = format!("{}: ID, COUNT, P[i], CH or AHEAD is expected", call.title());
    Fault::new(Condition::TokenUnknown, text, span)
}

/// 20998.
pub(super) fn no_bracket(call: &Call<'_>, span: Span) -> Box<Fault> {
    let text = format!("{}: SYN or a bracket is expected", call.title());
    Fault::new(Condition::SignalBracket, text, span)
}

impl<'c> Words<'c> {
    fn read(decoder: &Decoder, call: &Call<'_>, group: &'c Group) -> Outcome<Self> {
        let mut words = Self::default();
        for item in &group.items {
            match &item.kind {
                ItemKind::Missing => {}
                ItemKind::Flag(word) if word.is("AHEAD") => {}
                ItemKind::Flag(word) => {
                    // `ID4711`, `IDP100`
                    let (name, number) = match word.split_parameter() {
                        Some((name, place)) => {
                            (name, as_number(&decoder.read(&place)?, item.span)?)
                        }
                        None => word.split_number().ok_or_else(|| wrong(call, item.span))?,
                    };
                    words.key(call, name, number, item.span)?;
                }
                ItemKind::Pair { key, value: ItemValue::Expr(expr) } => {
                    words.key(call, &key.text, decoder.number(expr)?, item.span)?;
                }
                ItemKind::Target { place, value } => {
                    let index =
                        parameter_index(decoder, place).ok_or_else(|| wrong(call, item.span))?;
                    if words.parameters.iter().any(|(earlier, ..)| *earlier == index) {
                        let text = format!("{}: P[{index}] twice", call.title());
                        return Err(Fault::new(Condition::SignalParameterTwice, text, item.span));
                    }
                    words.parameters.push((index, value, item.span));
                }
                ItemKind::Pair { .. } | ItemKind::Value(_) => return Err(wrong(call, item.span)),
            }
        }
        Ok(words)
    }

    fn key(&mut self, call: &Call<'_>, name: &str, number: f64, span: Span) -> Outcome<()> {
        let known = ["ID", "COUNT", "CH"].into_iter().find(|k| name.eq_ignore_ascii_case(k));
        let least = u32::from(known != Some("ID"));
        let Some(known) = known else { return Err(wrong(call, span)) };
        let Some(value) = whole(number, least, u32::MAX) else {
            let text =
                format!("{}: {known}={number} is not a whole number from {least}", call.title());
            let condition = match known {
                "ID" if number < 0.0 => Condition::SignalNumber,
                "CH" => Condition::SignalChannel,
                _ => Condition::Range,
            };
            return Err(Fault::new(condition, text, span));
        };
        match known {
            "ID" if self.id.is_some() => {
                let text = format!("{}: ID given twice", call.title());
                return Err(Fault::new(Condition::SignalNumberTwice, text, span));
            }
            "ID" => self.id = Some(value),
            "COUNT" if self.count.is_some() => {
                let text = format!("{}: COUNT given twice", call.title());
                return Err(Fault::new(Condition::SignalCountTwice, text, span));
            }
            "COUNT" => self.count = Some(value),
            _ => self.channels.push(value),
        }
        Ok(())
    }
}

/// The index of `P[3]`, `P3`.
fn parameter_index(decoder: &Decoder, place: &Place) -> Option<u32> {
    let PlaceKind::Parameter { indirections: 0, index, subscripts } = &place.kind else {
        return None;
    };
    if !subscripts.is_empty() {
        return None;
    }
    let number = match index {
        ParameterIndex::Literal(number) => f64::from(*number),
        ParameterIndex::Computed(expr) => decoder.number(expr).ok()?,
    };
    whole(number, 0, PARAMETER_MAX)
}

fn signal(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    let remove = match call.rest {
        [] => false,
        [word] if word.is("SYN") => false,
        [word] if word.is("REMOVE") => true,
        [word, ..] => return Err(no_bracket(call, word.span)),
    };
    let [group] = &call.command.groups[..] else { return Err(no_bracket(call, call.span())) };
    let words = Words::read(decoder, call, group)?;
    let Some(id) = words.id else {
        let text = format!("{} needs ID", call.title());
        return Err(Fault::new(Condition::TokenUnknown, text, group.span));
    };
    if remove {
        decoder.signals.retain(|signal| signal.id != id);
        return Ok(());
    }
    let mut parameters = Vec::new();
    for (index, value, span) in &words.parameters {
        let ItemValue::Expr(expr) = value else { return Err(wrong(call, *span)) };
        parameters.push((*index, decoder.number(expr)?));
    }
    let broadcast = words.channels.is_empty();
    if !broadcast && !words.channels.contains(&OWN_CHANNEL) {
        return Ok(());
    }
    // a broadcast without COUNT remains: a newer one replaces it
    if broadcast && words.count.is_none() {
        decoder.signals.retain(|s| s.id != id || !s.broadcast || s.count.is_some());
    }
    if decoder.signals.len() >= MOST {
        let text = format!(
            "{}: {MOST} signals are pending without a block waiting for them",
            call.title()
        );
        return Err(Fault::new(Condition::Range, text, call.span()));
    }
    let count = words.count.or((!broadcast).then_some(1));
    decoder.signals.push(Signal { id, broadcast, count, parameters });
    Ok(())
}

/// `#WAIT [ID=.. P[0]=V.P.A CH=..]`: returns false if no such signal was sent.
pub(super) fn wait_for_signal(
    decoder: &mut Decoder,
    call: &Call<'_>,
    group: &Group,
) -> Outcome<bool> {
    let words = Words::read(decoder, call, group)?;
    let Some(id) = words.id else {
        let text = format!("{} needs ID", call.title());
        return Err(Fault::new(Condition::TokenUnknown, text, group.span));
    };
    if let (Some(mode), Some((_, _, span))) = (call.rest.first(), words.parameters.first())
        && mode.is("SYN")
    {
        let text = "#WAIT SYN cannot read signal parameters";
        return Err(Fault::new(Condition::SynchronousParameters, text, *span));
    }
    let broadcast = words.channels.is_empty();
    if !broadcast && words.channels.iter().any(|channel| *channel != OWN_CHANNEL) {
        return Ok(false);
    }
    let fits = |s: &Signal| s.id == id && s.broadcast == broadcast;
    let Some(place) = decoder.signals.iter().position(fits) else { return Ok(false) };
    let signal = &mut decoder.signals[place];
    let parameters = signal.parameters.clone();
    if let Some(count) = &mut signal.count {
        *count -= 1;
        if *count == 0 {
            decoder.signals.remove(place);
        }
    }
    for (index, target, span) in &words.parameters {
        let ItemValue::Expr(expr) = target else { return Err(wrong(call, *span)) };
        let ExprKind::Place(target) = &expr.kind else {
            let text = "#WAIT: a signal parameter must be assigned to a variable: P[0]=V.P.NAME";
            return Err(Fault::new(Condition::TokenUnknown, text, *span));
        };
        let Some((_, value)) = parameters.iter().rev().find(|(i, _)| i == index) else {
            let text = format!("#WAIT: the signal {id} has no parameter P[{index}]");
            return Err(Fault::new(Condition::SignalParameter, text, *span));
        };
        decoder.write(target, Value::Number(*value), *span)?;
    }
    Ok(true)
}
