//! Waiting, timers, files, macros, machine data, modal cycles.
//!
//! Source: TF5200 programming manual.

use super::axes::of_logical_number;
use super::drives::{Driven, driven};
use super::flush::may_flush;
use super::keys::arguments;
use super::range::between;
use super::row::{Call, Row};
use crate::diag::Condition;
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::options::Value;
use crate::exec::step::TimerAct;
use crate::exec::step::{Event, Sync};
use crate::machine::table::axis_key;
use crate::syntax::ast::{ExprKind, Ident, ItemKind, ItemValue};

/// Row of `#CHANNEL INIT`.
pub(super) const CHANNEL_INIT: Row = Row::run("CHANNEL INIT", channel_init)
    .form("#CHANNEL INIT [CMDPOS|ACTPOS AX=.. AXNR=..]")
    .meaning("sets the programmed position to the command or actual position; ACTPOS first waits for all exact-stop windows")
    .example("#CHANNEL INIT [CMDPOS]");

/// `#CHANNEL INIT [CMDPOS|ACTPOS AX=X AXNR=2]`; axes can also be given without `AX=`.
fn channel_init(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    may_flush(decoder, call)?;
    call.no_more_words()?;
    let Some(group) = call.command.groups.first() else {
        let text = "#CHANNEL INIT needs [CMDPOS] or [ACTPOS]";
        return Err(Fault::new(Condition::TokenUnknown, text, call.span()));
    };
    let mut actual = None;
    let mut axes = Vec::new();
    for item in &group.items {
        match &item.kind {
            ItemKind::Flag(word) if word.is("CMDPOS") || word.is("ACTPOS") => {
                if actual.replace(word.is("ACTPOS")).is_some() {
                    let text = "#CHANNEL INIT: write one of CMDPOS and ACTPOS, once";
                    return Err(Fault::new(Condition::ChannelInitTwice, text, item.span));
                }
            }
            ItemKind::Flag(word) => axes.push(decoder.names.in_command(word)?),
            ItemKind::Pair { key, value: ItemValue::Name(name) } if key.is("AX") => {
                axes.push(decoder.names.in_command(name)?);
            }
            ItemKind::Pair { key, value: ItemValue::Expr(expr) } if key.is("AXNR") => {
                let number = decoder.number(expr)?;
                axes.push(of_logical_number(decoder, number, expr.span)?);
            }
            ItemKind::Missing => {}
            ItemKind::Pair { .. } | ItemKind::Target { .. } | ItemKind::Value(_) => {
                return Err(Fault::new(
                    Condition::TokenUnknown,
                    "#CHANNEL INIT: an axis is expected",
                    item.span,
                ));
            }
        }
    }
    match actual {
        None => {
            let text = "#CHANNEL INIT needs CMDPOS or ACTPOS";
            Err(Fault::new(Condition::TokenUnknown, text, group.span))
        }
        Some(false) => take_command_positions(decoder, call),
        Some(true) => {
            decoder.take_actual_positions(&axes);
            Ok(())
        }
    }
}

/// `#CHANNEL INIT [CMDPOS]`, and `#SET DEC LR SOLL`, its older name (206703627): the program already uses setpoints.
pub(super) fn take_command_positions(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    call.no_more_words()?;
    decoder.sync(Sync::FlushWait);
    Ok(())
}

/// Row of `#TIME`.
pub(super) const TIME: Row = Row::run("TIME", time)
    .values()
    .form("#TIME t")
    .meaning("dwell of t seconds, as G04")
    .example("#TIME 2.5")
    .related(&["G04", "20751"]);

/// `#TIME t`.
fn time(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    call.no_more_words()?;
    match &call.command.arguments[..] {
        [expr] if call.command.groups.is_empty() => {
            let seconds = decoder.number(expr)?;
            decoder.dwell_for(seconds, Condition::TimeRange, expr.span)
        }
        _ => Err(Fault::new(Condition::TokenUnknown, "#TIME needs one time in s", call.span())),
    }
}

/// Row of `#WAIT`.
pub(super) const WAIT: Row = Row::run("WAIT", wait).several().values()
    .form("#WAIT INDP [X, Y]   #WAIT INDP ALL   #WAIT FOR condition   #WAIT [SYN] [ID=.. P[i]=variable CH=..]")
    .meaning("stops the path until these independent axes have arrived; tests a condition once; consumes a signal")
    .example("#WAIT INDP [X]")
    .related(&["INDP_ASYN", "#SIGNAL", "K-0018"]);

/// `#WAIT INDP ..` waits for independent axes. Without other channels a condition is tested once, and a signal either was sent
/// or never will be.
fn wait(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    if let [word, more @ ..] = call.rest
        && word.is("INDP")
    {
        let all = match (more, &call.command.tail[..]) {
            ([], []) => false,
            ([all], []) | ([], [all]) if all.is("ALL") => true,
            ([other, ..], _) | ([], [other, ..]) => return Err(call.unexpected(other)),
        };
        return decoder.wait_for_independent(all, &call.command.groups, call.span());
    }
    if let Some(word) = call.rest.first().filter(|word| !word.is("SYN") && !word.is("FOR")) {
        return Err(super::signals::no_bracket(call, word.span));
    }
    if let ([] | [_], [group]) = (call.rest, &call.command.groups[..])
        && call.rest.iter().all(|word| word.is("SYN"))
        && super::signals::wait_for_signal(decoder, call, group)?
    {
        return Ok(());
    }
    match (call.rest, &call.command.arguments[..]) {
        ([word], [condition]) if word.is("FOR") => {
            // decoding waits, not the path: a condition that is met stops nothing (207058059)
            if decoder.condition(condition)? {
                return Ok(());
            }
            let text = "the condition is false and cannot become true in the simulation";
            let fault = Fault::new(Condition::Wait, text, condition.span);
            Err(fault.with(|d| d.severity(crate::diag::Severity::Error)))
        }
        ([word, ..], _) if word.is("FOR") => {
            let text = "#WAIT FOR needs one condition";
            let hint = "write an expression after it: #WAIT FOR V.E.READY";
            Err(Fault::new(Condition::TokenUnknown, text, call.span()).hint(hint))
        }
        _ => {
            decoder.sync(Sync::FlushWait);
            let text = format!("{} does not wait: no event to wait for", call.title());
            decoder.report.note_once("#WAIT", Fault::new(Condition::Wait, text, call.span()));
            Ok(())
        }
    }
}

arguments! {
    /// Keys of `#TIMER`.
    struct TimerArguments {
        id: Number "ID" in between(0.0, 127.0).whole().or(Condition::TimerNumber), "", "default 0";
    }
}

/// Row of `#TIMER`.
pub(super) const TIMER: Row = Row::run("TIMER", timer)
    .form("#TIMER START|STOP|READ|CLEAR [SYN] [ID=i]")
    .meaning("starts or stops a timer, copies its count in ms to V.G.TIMER[i], or clears it")
    .keys(TimerArguments::KEYS)
    .note("without SYN the timer runs with the decoder, which is ahead of the motion; READ SYN stops the path")
    .example("#TIMER START SYN [ID=3]");

/// Operation of `#TIMER`.
const TIMER_ACTS: &[(&str, TimerAct)] = &[
    ("START", TimerAct::Start),
    ("STOP", TimerAct::Stop),
    ("READ", TimerAct::Read),
    ("CLEAR", TimerAct::Clear),
];

/// `#TIMER START|STOP|READ|CLEAR [SYN] [ID=i]`.
fn timer(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    let group = call.command.groups.first();
    let ids = group.into_iter().flat_map(|group| &group.items);
    let ids = ids.filter(|item| matches!(&item.kind, ItemKind::Pair { key, .. } if key.is("ID")));
    let acts = call.rest.iter().filter(|word| TIMER_ACTS.iter().any(|(name, _)| word.is(name)));
    if ids.count() > 1 || acts.count() > 1 {
        let text = "#TIMER: write one action and one ID";
        return Err(Fault::new(Condition::TimerTwice, text, call.span()));
    }
    let keys = TimerArguments::read(decoder, &call.title(), group)?;
    let id =
        keys.id.and_then(|(id, _)| crate::exec::values::number::whole(id, 0, 127)).unwrap_or(0);
    let (word, synchronous) = match call.rest {
        [word] => (word, false),
        [word, mode] if mode.is("SYN") => (word, true),
        [_, other, ..] => return Err(call.unexpected(other)),
        [] => {
            let text = "#TIMER needs START, STOP, READ or CLEAR";
            return Err(Fault::new(Condition::TokenUnknown, text, call.span()));
        }
    };
    let Some((_, act)) = TIMER_ACTS.iter().copied().find(|(name, _)| word.is(name)) else {
        return Err(call.unexpected(word));
    };
    if !synchronous {
        decoder.live.timer(id, act);
        return Ok(());
    }
    decoder.contour.event(Event::Timer { id, act });
    if act == TimerAct::Read {
        decoder.sync(Sync::Halt);
    }
    Ok(())
}

/// `#DELETE V.., V..`.
pub(super) fn delete(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    if call.command.arguments.is_empty() {
        return Err(Fault::new(Condition::TokenUnknown, "#DELETE needs variables", call.span()));
    }
    for expr in &call.command.arguments {
        let ExprKind::Place(place) = &expr.kind else {
            return Err(Fault::new(
                Condition::TokenUnknown,
                "#DELETE: a variable is expected",
                expr.span,
            ));
        };
        let outcome = decoder.delete(place);
        decoder.report.keep(outcome);
    }
    Ok(())
}

/// `#INIT MACRO TAB`: the macros of the channel list are kept.
pub(super) fn init_macros(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    call.no_more_words()?;
    decoder.calls.macros.clone_from(&decoder.machine.channel.macros.listed);
    decoder.calls.macros_changed = true;
    Ok(())
}

/// A file name, as a word or a text.
fn name_in(decoder: &Decoder, value: &ItemValue) -> Outcome<String> {
    let at = match value {
        ItemValue::Name(name) => return Ok(name.text.to_string()),
        ItemValue::Expr(expr) => match decoder.value(expr)? {
            Value::Text(text) => return Ok(text.to_string()),
            Value::Number(_) => expr.span,
        },
        ItemValue::List(group) => group.span,
    };
    Err(Fault::new(Condition::TokenUnknown, "a file name is expected", at))
}

/// `#FILE NAME [G80="x.nc" M6="z.nc" D="d.nc" MSG="y"]`.
pub(super) fn file_name(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    call.no_more_words()?;
    let mut written: Vec<&Ident> = Vec::new();
    for item in call.command.groups.iter().flat_map(|g| &g.items) {
        let ItemKind::Pair { key, value } = &item.kind else {
            if matches!(item.kind, ItemKind::Missing) {
                continue;
            }
            return Err(Fault::new(
                Condition::TokenUnknown,
                "#FILE NAME: KEY=\"file\" is expected",
                item.span,
            ));
        };
        if written.iter().any(|earlier| earlier.is(&key.text)) {
            let text = format!("#FILE NAME: {} twice", key.text);
            return Err(Fault::new(Condition::FileNameTwice, text, key.span));
        }
        written.push(key);
        let file = name_in(decoder, value)?;
        let number = key.text.strip_prefix('G').and_then(|n| n.parse().ok());
        // an empty text restores the default of the lists: no program (P-CHAN-00118)
        let file = Some(file).filter(|file| !file.trim_ascii().is_empty());
        match number {
            Some(n) if crate::exec::block::groups::is_cycle_call(n) => {
                match file {
                    Some(file) => decoder.calls.cycle_files.insert(n, file),
                    None => decoder.calls.cycle_files.remove(&n),
                };
            }
            _ if key.is("M6") || key.is("M06") => decoder.calls.tool_change_file = file,
            _ if key.is("D") => decoder.calls.tool_data_file = file,
            // messages are written to the log, whatever the name of their file
            _ if key.is("MSG") => {}
            _ => {
                let text = format!("#FILE NAME: unknown key {}", key.text);
                return Err(Fault::new(Condition::TokenUnknown, text, key.span));
            }
        }
    }
    Ok(())
}

arguments! {
    /// Keys of `#MACHINE DATA`.
    struct MachineDataArguments {
        axis: Word "AX", "", "the axis";
        number: Number "AXNR", "", "logical number instead of AX";
        parameter: Word "AXPARAM", "", "key and value as in the axis list";
        wait: Flag "WAIT", "", "with SYN: the program waits; here it always waits";
    }
}

/// Row of `#MACHINE DATA`.
pub(super) const MACHINE_DATA: Row = Row::run("MACHINE DATA", machine_data)
    .form("#MACHINE DATA [SYN] [AX=..|AXNR=.. AXPARAM=\"key value\"|P-AXIS-nnnnn.i=.. WAIT]")
    .meaning("changes a parameter of an axis list from this block on; the path stops")
    .keys(MachineDataArguments::KEYS)
    .example("#MACHINE DATA [AX=Z AXPARAM=\"getriebe[0].kv 3000\"]");

/// `#MACHINE DATA [SYN] [AX=Z AXPARAM="key value"]`, `#MACHINE DATA [AX=Z P-AXIS-00212.1=50000]`.
///
/// Assumption: the index after the ID is the first one of the key, which counts gear stages in most of them; every parameter can be
/// named by its ID, not only those on the page (207492747).
fn machine_data(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    if let Some(word) = call.rest.iter().find(|w| !w.is("SYN")) {
        return Err(call.unexpected(word));
    }
    let mut group = call.command.groups.first().cloned();
    let mut by_id = Vec::new();
    if let Some(group) = &mut group {
        group.items.retain(|item| match &item.kind {
            ItemKind::Pair { key, value } if key.text.starts_with("P-") => {
                by_id.push((key.clone(), value.clone()));
                false
            }
            _ => true,
        });
    }
    let keys = MachineDataArguments::read(decoder, &call.title(), group.as_ref())?;
    if let (Some(span), []) = (keys.wait, call.rest) {
        let text = "WAIT of #MACHINE DATA needs SYN";
        return Err(Fault::new(Condition::WaitWithoutSyn, text, span));
    }
    let axis = match driven(decoder, call, keys.axis.as_ref(), keys.number)? {
        Driven::Axis(axis) => axis,
        Driven::Spindle(_) => {
            return Err(Fault::unsupported("#MACHINE DATA of a spindle", call.span()));
        }
    };
    if by_id.is_empty() && keys.parameter.is_none() {
        let text = "#MACHINE DATA needs AXPARAM or the ID of a parameter";
        return Err(Fault::new(Condition::TokenUnknown, text, call.span()));
    }
    for (id, value) in by_id {
        let ItemValue::Expr(value) = value else {
            let text = format!("{}: a number is expected", id.text);
            return Err(Fault::new(Condition::TokenUnknown, text, id.span));
        };
        let value = decoder.number(&value)?.to_string();
        let key = axis_key(&id.text).ok_or_else(|| {
            let text = format!("`{}` is not a parameter of an axis", id.text);
            Fault::new(Condition::TokenUnknown, text, id.span)
        })?;
        decoder.set_machine_data(axis, &key, &value, id.span)?;
    }
    if let Some((parameter, span)) = keys.parameter {
        let (key, value) = parameter.trim().split_once(char::is_whitespace).ok_or_else(|| {
            Fault::new(Condition::TokenUnknown, "AXPARAM: `key value` is expected", span)
        })?;
        decoder.set_machine_data(axis, key, value.trim(), span)?;
    }
    Ok(())
}

/// `#DISABLE MODAL CYCLE`.
pub(super) fn disable_modal_cycle(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    call.no_more_words()?;
    decoder.calls.modal_cycle = None;
    Ok(())
}

/// `#RETAIN CYCLE CHANGES`.
pub(super) fn retain_cycle_changes(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    call.no_more_words()?;
    decoder.calls.retain_cycle_changes = true;
    Ok(())
}
