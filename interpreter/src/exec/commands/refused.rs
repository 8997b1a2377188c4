//! Refused commands: errors that the diagnosis manual defines for them are reported instead of the refusal.
//!
//! Source: TF5200 diagnosis, 21089 (253417867), 21157 (253613707), 21158 (253618059), 21235 (253879179), 21236 (253883531), 21349 (254314379),
//! 21410 (254562443), 21453 (254732171), 21872 (256368523), 22003 (480451723), 22128 and 22129 (real-time loops 791893515),
//! 22158 (real-time loops 793352331), 22181 (991397515).

use super::row::Call;
use crate::diag::Condition;
use crate::exec::block::choice::Compensation;
use crate::exec::decoder::Decoder;
use crate::exec::fault::Fault;
use crate::syntax::ast::{Command, Ident, Item, ItemKind, ItemValue};

/// IDs for a repeated key.
const KEY_TWICE: &[(&str, Condition)] = &[
    ("COLL", Condition::CollisionKeyTwice),
    ("FACE", Condition::FaceKeyTwice),
    ("IDENT", Condition::IdentKeyTwice),
    ("MCS TO WCS", Condition::ConversionTwice),
    ("MILLCONT", Condition::MillingContourKeyTwice),
    ("SINGLE STEP", Condition::SingleStepTwice),
    ("TGC", Condition::HeightKeyTwice),
    ("TOOL DEF", Condition::ToolKeyTwice),
    ("WCS TO MCS", Condition::ConversionTwice),
];

/// Reason why the command is not executed.
pub(super) fn refused(decoder: &mut Decoder, call: &Call<'_>) -> Box<Fault> {
    if call.command.groups.iter().any(|group| group.items.is_empty()) {
        let text = format!("{}: its brackets are empty", call.title());
        return Fault::new(Condition::EmptyBracket, text, call.span());
    }
    if let Some(fault) = keys_wrong(call) {
        return fault;
    }
    if matches!(call.name, "WCS TO MCS" | "MCS TO WCS")
        && decoder.geometry.coordinates.systems() > 0
    {
        let text = format!("{} in a coordinate system", call.title());
        return Fault::new(Condition::ConversionInSystem, text, call.span());
    }
    let defines = call.name == "RT CYCLE" && call.rest.iter().any(|word| word.is("DEF"));
    if defines && !keys(call.command).any(|key| key.is("ID")) {
        let text = "#RT CYCLE DEF without ID";
        return Fault::new(Condition::CycleWithoutId, text, call.span());
    }
    let reads = call.rest.iter().any(|word| word.is("RD"));
    if call.name == "IDENT"
        && let Some(syn) = call.rest.iter().find(|word| reads && word.is("SYN"))
    {
        let text = "#IDENT RD takes no SYN";
        return Fault::new(Condition::SynNotAllowed, text, syn.span);
    }
    if call.name == "COMMAND"
        && let Some(word) = call.rest.iter().find(|word| word.is("RD"))
    {
        let text = "#COMMAND RD: procedures of drives cannot be read";
        return Fault::new(Condition::CommandRead, text, word.span);
    }
    if call.name == "CAX"
        && let Some(fault) = not_of_main_spindle(decoder, call)
    {
        return fault;
    }
    if call.name == "GET WCS POSLIMIT"
        && let Some(fault) = direction_zero(decoder, call)
    {
        return fault;
    }
    real_time_loop(decoder, call).unwrap_or_else(|| Fault::unsupported(call.title(), call.span()))
}

/// 21175 for `#CAX [S2, C]` (253670283).
fn not_of_main_spindle(decoder: &Decoder, call: &Call<'_>) -> Option<Box<Fault>> {
    let items = &call.command.groups.first()?.items;
    let [Item { kind: ItemKind::Flag(name), .. }, _] = &items[..] else { return None };
    // the main spindle is the first one
    let spindle = decoder.motion.spindle_of_name(&name.text, &decoder.machine.channel)?;
    let is_other = spindle > 0;
    let text = format!("#CAX: {} is not the main spindle", name.text);
    is_other.then(|| Fault::new(Condition::RotaryAxisOfMainSpindle, text, name.span))
}

/// 21410 if VC1, VC2 and VC3 are all 0.
fn direction_zero(decoder: &Decoder, call: &Call<'_>) -> Option<Box<Fault>> {
    let components = numbers_of(decoder, call, ["VC1", "VC2", "VC3"]);
    let text = "#GET WCS POSLIMIT: the direction VC1, VC2, VC3 is 0";
    (components.len() == 3 && components.iter().all(|c| *c == 0.0))
        .then(|| Fault::new(Condition::DirectionZero, text, call.span()))
}

/// Values of the keys with these names, as far as they are numbers.
pub(super) fn numbers_of(decoder: &Decoder, call: &Call<'_>, names: [&str; 3]) -> Vec<f64> {
    let items = call.command.groups.iter().flat_map(|group| &group.items);
    let of_name = items.filter_map(|item| match &item.kind {
        ItemKind::Pair { key, value: ItemValue::Expr(value) }
            if names.iter().any(|name| key.is(name)) =>
        {
            decoder.number(value).ok()
        }
        _ => None,
    });
    of_name.collect()
}

/// Errors in the position of `#RT WHILE` or `#RT ENDWHILE`.
fn real_time_loop(decoder: &mut Decoder, call: &Call<'_>) -> Option<Box<Fault>> {
    let (begins, title, span) = (call.name == "RT WHILE", call.title(), call.span());
    if !begins && call.name != "RT ENDWHILE" {
        return None;
    }
    let before = std::mem::replace(&mut decoder.calls.real_time_loop, begins.then_some(span));
    let fault =
        |condition, what: &str| Some(Fault::new(condition, format!("{title} {what}"), span));
    if decoder.contour.akima.selected {
        let condition = if begins { Condition::LoopInSpline } else { Condition::LoopEndInSpline };
        return fault(condition, "in a spline (G151)");
    }
    if begins && decoder.modal.compensation != Compensation::Off {
        return fault(Condition::LoopWithCompensation, "with G41 or G42");
    }
    if !begins && before.is_none() {
        return fault(Condition::LoopEndWithoutLoop, "without #RT WHILE");
    }
    None
}

/// A repeated key, or two exclusive ones, in a command that is not simulated.
pub(super) fn keys_wrong(call: &Call<'_>) -> Option<Box<Fault>> {
    let (_, condition) = KEY_TWICE.iter().find(|(name, _)| *name == call.name)?;
    if let Some(key) = key_twice(call.command) {
        let text = format!("{}: {} twice", call.title(), key.text);
        return Some(Fault::new(*condition, text, key.span));
    }
    let written = |name: &str| keys(call.command).find(|key| key.is(name));
    let (Some(_), Some(second)) = (written("ENABLE"), written("DISABLE")) else { return None };
    let text = format!("{}: ENABLE and DISABLE cannot be combined", call.title());
    Some(Fault::new(*condition, text, second.span))
}

/// Names of the items in brackets.
fn keys(command: &Command) -> impl Iterator<Item = &Ident> {
    command.groups.iter().flat_map(|group| &group.items).filter_map(|item| match &item.kind {
        ItemKind::Pair { key, .. } | ItemKind::Flag(key) => Some(key),
        _ => None,
    })
}

fn key_twice(command: &Command) -> Option<&Ident> {
    let keys: Vec<&Ident> = keys(command).collect();
    let (_, second) =
        keys.iter().enumerate().find(|(i, key)| keys[..*i].iter().any(|k| k.is(&key.text)))?;
    Some(second)
}
