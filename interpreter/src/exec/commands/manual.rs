//! Settings of manual mode: `#HANDWHEEL`, `#JOG`, `#MANUAL LIMITS`, their older forms `#SET HR`, `#SET TIP`, `#SET JOG`,
//! `#SET OFFSET`, and `#GET MANUAL OFFSETS`.
//!
//! The simulation has no handwheel: the settings are checked and have no effect (K-0100), and offsets of manual mode are 0.
//!
//! Source: TF5200 programming manual 206654731, 206668043, 206683659, 206697739, tccncprogramming 15556797579, 15556802699,
//! 15556807819, 15556811915; diagnosis, 20485 (251737995), 20486 (251742347), 20490 (251755403), 20491 (251759755), 20493
//! (251764107).

use super::axes::of_logical_number;
use super::flush::may_flush;
use super::row::{Call, Row};
use crate::diag::{Condition, ValueKind};
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::step::Sync;
use crate::syntax::ast::{Group, Ident, Item, ItemKind, ItemValue, Span};

/// Maximum number of stages of a setting.
const STAGES: usize = 3;

/// Row of `#HANDWHEEL`.
pub(super) const HANDWHEEL: Row = Row::run("HANDWHEEL", handwheel)
    .form("#HANDWHEEL [AX=X RES1=.. RES2=.. RES3=..]")
    .meaning("travel of an axis per handwheel revolution; checked, without effect")
    .example("#HANDWHEEL [AX=X RES1=0.1 RES2=0.5]")
    .related(&["G201", "K-0100"]);

/// Row of `#JOG`.
pub(super) const JOG: Row = Row::run("JOG", jog)
    .form("#JOG CONT [AX=X FEED1=..]   #JOG INCR [AX=X DIST1=.. FEED1=..]")
    .meaning("speeds and steps of up to three stages of jogging; checked, without effect")
    .example("#JOG CONT [AX=X FEED1=100]")
    .related(&["G201", "K-0100"]);

/// Row of `#MANUAL LIMITS`.
pub(super) const MANUAL_LIMITS: Row = Row::run("MANUAL LIMITS", manual_limits)
    .form("#MANUAL LIMITS [AX=X NEGATIVE=.. POSITIVE=..]")
    .meaning("travel limits of an axis in manual mode in both directions; checked, without effect")
    .example("#MANUAL LIMITS [AX=X NEGATIVE=-5 POSITIVE=5]")
    .related(&["G201", "K-0100"]);

/// Row of `#SET HR`, the older form of `#HANDWHEEL`.
pub(super) const SET_HR: Row = Row::run("SET HR", set_stages)
    .form("#SET HR [res, res, res] X")
    .meaning("older form of #HANDWHEEL")
    .example("#SET HR [0.1, 0.2, 0.5] X")
    .related(&["#HANDWHEEL"]);

/// Row of `#SET TIP`, the older form of `#JOG CONT`.
pub(super) const SET_TIP: Row = Row::run("SET TIP", set_stages)
    .form("#SET TIP [feed, feed, feed] X")
    .meaning("older form of #JOG CONT")
    .example("#SET TIP [1, 1.5, 2] X")
    .related(&["#JOG"]);

/// Row of `#SET JOG`, the older form of `#JOG INCR`.
pub(super) const SET_JOG: Row = Row::run("SET JOG", set_stages)
    .form("#SET JOG [[dist, feed], [dist, feed]] X")
    .meaning("older form of #JOG INCR")
    .example("#SET JOG [[0.1, 1], [0.2, 1.5]] X")
    .related(&["#JOG"]);

/// Row of `#SET OFFSET`, the older form of `#MANUAL LIMITS`.
pub(super) const SET_OFFSET: Row = Row::run("SET OFFSET", set_limits)
    .form("#SET OFFSET [negative, positive] X")
    .meaning("older form of #MANUAL LIMITS")
    .example("#SET OFFSET [-5, 5] X")
    .related(&["#MANUAL LIMITS"]);

/// Row of `#MANUAL`.
pub(super) const MANUAL: Row = Row::run("MANUAL", manual)
    .form("#MANUAL [ORI_MODE=..]")
    .meaning(
        "mode of orientation axes in manual mode; without effect, as axes are not moved by hand",
    )
    .example("#MANUAL [ORI_MODE=1]")
    .related(&["G201", "22385"]);

/// Row of `#GET MANUAL OFFSETS`.
pub(super) const GET_MANUAL_OFFSETS: Row = Row::run("GET MANUAL OFFSETS", get_offsets)
    .bare()
    .form("#GET MANUAL OFFSETS")
    .meaning(
        "writes the offsets of manual mode to V.A.MANUAL_OFFSETS: 0, as axes are not moved by hand",
    )
    .example("#GET MANUAL OFFSETS")
    .related(&["G201"]);

/// Row of `#GET IPO OFFSET`, the older form of `#GET MANUAL OFFSETS`.
pub(super) const GET_IPO_OFFSET: Row = Row::run("GET IPO OFFSET", get_offsets)
    .bare()
    .form("#GET IPO OFFSET")
    .meaning("older form of #GET MANUAL OFFSETS, for V.A.SOFFS")
    .example("#GET IPO OFFSET")
    .related(&["#GET MANUAL OFFSETS"]);

/// `#HANDWHEEL [AX=X RES1=..]`.
fn handwheel(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    call.no_more_words()?;
    let written = numbers(decoder, call, &["RES"], STAGES)?;
    needs(call, &written, &["RES1"])?;
    without_effect(decoder, call);
    Ok(())
}

/// `#JOG CONT [AX=X FEED1=..]`, `#JOG INCR [AX=X DIST1=.. FEED1=..]`.
fn jog(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    let increments = match call.rest {
        [word] if word.is("CONT") => false,
        [word] if word.is("INCR") => true,
        [word, ..] => return Err(call.unexpected(word)),
        [] => {
            let text = "#JOG needs CONT or INCR";
            return Err(Fault::new(Condition::TokenUnknown, text, call.span()));
        }
    };
    let (names, of_feed): (&[&str], _) = if increments {
        (&["DIST", "FEED"], Condition::JogFeed)
    } else {
        (&["FEED"], Condition::JogFeedContinuous)
    };
    let written = numbers(decoder, call, names, STAGES)?;
    for (key, value, span) in &written {
        let condition = if key.starts_with("DIST") { Condition::JogStep } else { of_feed };
        has_sign(call, (key, *value, *span), condition, *value >= 0.0)?;
    }
    needs(call, &written, &["FEED1"])?;
    for stage in 1..=STAGES {
        let has = |name: &str| written.iter().any(|(key, ..)| *key == format!("{name}{stage}"));
        if increments && has("DIST") != has("FEED") {
            let text = format!("#JOG INCR: DIST{stage} and FEED{stage} belong together");
            return Err(Fault::new(Condition::TokenUnknown, text, call.span()));
        }
    }
    without_effect(decoder, call);
    Ok(())
}

/// `#MANUAL [ORI_MODE=..]`. Source: TF5200 diagnosis, 22385 (1256561291).
fn manual(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    call.no_more_words()?;
    if decoder.motion.manual.contains(&true) {
        let text = "#MANUAL while manual mode is active (G201)";
        return Err(Fault::new(Condition::ManualWhileActive, text, call.span()));
    }
    without_effect(decoder, call);
    Ok(())
}

/// `#MANUAL LIMITS [AX=X NEGATIVE=.. POSITIVE=..]`.
fn manual_limits(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    call.no_more_words()?;
    let written = numbers(decoder, call, &["NEGATIVE", "POSITIVE"], 0)?;
    for (key, value, span) in &written {
        let right = key == "POSITIVE" || *value <= 0.0;
        has_sign(call, (key, *value, *span), Condition::ManualLimit, right)?;
    }
    if written.is_empty() {
        let text = "#MANUAL LIMITS needs NEGATIVE or POSITIVE";
        return Err(Fault::new(Condition::TokenUnknown, text, call.span()));
    }
    without_effect(decoder, call);
    Ok(())
}

/// `#SET HR [..] X`, `#SET TIP [..] X`, `#SET JOG [[..], [..]] X`.
fn set_stages(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    let (axis, items) = older_form(decoder, call)?;
    if let Some(fourth) = items.get(STAGES) {
        // 20490 is printed for #SET TIP; the other two have the same number of stages
        let text = format!("{} has more than {STAGES} stages", call.title());
        return Err(Fault::new(Condition::JogStages, text, fourth.span));
    }
    for item in items {
        match (&item.kind, call.name) {
            (kind, "SET JOG") => {
                let pair = match kind {
                    ItemKind::Value(ItemValue::List(pair)) => &pair.items[..],
                    _ => &[],
                };
                let [distance, feed] = pair else {
                    let text = "#SET JOG: a stage is [distance, feed]";
                    return Err(Fault::new(Condition::TokenUnknown, text, item.span));
                };
                for (item, name, condition) in
                    [(distance, "distance", Condition::JogStep), (feed, "feed", Condition::JogFeed)]
                {
                    let value = one_number(decoder, call, item)?;
                    has_sign(call, (name, value, item.span), condition, value >= 0.0)?;
                }
            }
            (_, "SET TIP") => {
                let value = one_number(decoder, call, item)?;
                let condition = Condition::JogFeedContinuous;
                has_sign(call, ("feed", value, item.span), condition, value >= 0.0)?;
            }
            _ => {
                one_number(decoder, call, item)?;
            }
        }
    }
    only_in_normal_mode(decoder, call, axis)?;
    without_effect(decoder, call);
    Ok(())
}

/// `#SET OFFSET [negative, positive] X`.
fn set_limits(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    let (axis, items) = older_form(decoder, call)?;
    let [negative, positive] = items else {
        let text = "#SET OFFSET needs the negative and the positive limit";
        return Err(Fault::new(Condition::TokenUnknown, text, call.span()));
    };
    let value = one_number(decoder, call, negative)?;
    one_number(decoder, call, positive)?;
    let condition = Condition::ManualLimit;
    has_sign(call, ("limit", value, negative.span), condition, value <= 0.0)?;
    only_in_normal_mode(decoder, call, axis)?;
    without_effect(decoder, call);
    Ok(())
}

/// `#GET MANUAL OFFSETS`, `#GET IPO OFFSET`: the decoder waits for the interpolator.
///
/// Assumption: the path stops, as for `#GET CMDPOS`; the page states that the values are requested and supplied.
fn get_offsets(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    may_flush(decoder, call)?;
    call.no_more_words()?;
    decoder.sync(Sync::FlushWait);
    Ok(())
}

/// The axis after the bracket, and the contents of the bracket.
fn older_form<'c>(decoder: &Decoder, call: &'c Call<'_>) -> Outcome<(usize, &'c [Item])> {
    let empty = |group: &&Group| group.items.is_empty();
    if let Some(group) = call.command.groups.first().filter(empty) {
        let text = format!("{}: its brackets are empty", call.title());
        return Err(Fault::new(Condition::EmptyBracket, text, group.span));
    }
    match (call.rest, &call.command.tail[..], call.command.groups.first()) {
        ([], [axis], Some(group)) => Ok((decoder.names.in_command(axis)?, &group.items)),
        ([word, ..], ..) => Err(call.unexpected(word)),
        _ => {
            let text =
                format!("{} requires its values in brackets, followed by its axis", call.title());
            Err(Fault::new(Condition::TokenUnknown, text, call.span()))
        }
    }
}

/// The numbers of a bracket with `AX=` or `AXNR=`; `names` are the keys, with their numbers of stages if they have any.
fn numbers(
    decoder: &Decoder,
    call: &Call<'_>,
    names: &[&str],
    stages: usize,
) -> Outcome<Vec<(String, f64, Span)>> {
    // without a number it is the first stage (251737995)
    let known = |key: &Ident| {
        names.iter().find_map(|name| match stages {
            0 => key.is(name).then(|| (*name).to_owned()),
            _ if key.is(name) => Some(format!("{name}1")),
            _ => (1..=stages).map(|n| format!("{name}{n}")).find(|numbered| key.is(numbered)),
        })
    };
    let mut axis = None;
    let mut found: Vec<(String, f64, Span)> = Vec::new();
    for item in call.command.groups.iter().flat_map(|group| &group.items) {
        let twice = match &item.kind {
            ItemKind::Missing => false,
            ItemKind::Pair { key, value: ItemValue::Name(name) } if key.is("AX") => {
                axis.replace(decoder.names.in_command(name)?).is_some()
            }
            ItemKind::Pair { key, value: ItemValue::Expr(expr) } if key.is("AXNR") => {
                let number = decoder.number(expr)?;
                axis.replace(of_logical_number(decoder, number, expr.span)?).is_some()
            }
            ItemKind::Pair { key, value: ItemValue::Expr(expr) } if known(key).is_some() => {
                let key = known(key).unwrap_or_default();
                let twice = found.iter().any(|(other, ..)| *other == key);
                found.push((key, decoder.number(expr)?, item.span));
                twice
            }
            _ => {
                let text = format!("{}: unknown key", call.title());
                return Err(Fault::new(Condition::TokenUnknown, text, item.span));
            }
        };
        if twice {
            let text = format!("{}: key given twice", call.title());
            return Err(Fault::new(Condition::CommandKeyTwice, text, item.span));
        }
    }
    let Some(axis) = axis else {
        let text = format!("{} needs AX= or AXNR=", call.title());
        return Err(Fault::new(Condition::TokenUnknown, text, call.span()));
    };
    only_in_normal_mode(decoder, call, axis)?;
    Ok(found)
}

fn needs(call: &Call<'_>, written: &[(String, f64, Span)], keys: &[&str]) -> Outcome<()> {
    match keys.iter().find(|key| !written.iter().any(|(other, ..)| other == *key)) {
        Some(key) => {
            let text = format!("{} needs {key}", call.title());
            Err(Fault::new(Condition::TokenUnknown, text, call.span()))
        }
        None => Ok(()),
    }
}

fn one_number(decoder: &Decoder, call: &Call<'_>, item: &Item) -> Outcome<f64> {
    let ItemKind::Value(ItemValue::Expr(expr)) = &item.kind else {
        let text = format!("{}: a number is expected", call.title());
        return Err(Fault::new(Condition::TokenUnknown, text, item.span));
    };
    decoder.number(expr)
}

fn has_sign(
    call: &Call<'_>,
    (key, value, span): (&str, f64, Span),
    condition: Condition,
    is_right: bool,
) -> Outcome<()> {
    if is_right {
        return Ok(());
    }
    let text = format!("{}: {key}={value} has the wrong sign", call.title());
    Err(Fault::new(condition, text, span).with(|d| d.value(ValueKind::Wrong, value, "-")))
}

/// Settings are made under G202 (tccncprogramming 15556802699). Assumption: this also applies to the newer forms, because their
/// examples activate G202 before; the pages print no ID.
fn only_in_normal_mode(decoder: &Decoder, call: &Call<'_>, axis: usize) -> Outcome<()> {
    if !decoder.motion.manual[axis] {
        return Ok(());
    }
    let text = format!("{} while G201 of {} is active", call.title(), decoder.names.name(axis));
    Err(Fault::new(Condition::Syntax, text, call.span()).hint("write G202 before it"))
}

fn without_effect(decoder: &mut Decoder, call: &Call<'_>) {
    let text = format!("{}: axes are not moved by hand here", call.title());
    decoder.report.note_once(call.name, Fault::new(Condition::Ignored, text, call.span()));
}
