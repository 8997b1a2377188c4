//! `#VIB GUARD` and `#FILTER`.
//!
//! Source: TF5250 Vibration Guard; TF5200 FIR filter and axis filters (HSC).

use super::keys::arguments;
use super::range::{above_zero_to, at_least, between};
use super::row::{Call, Row};
use crate::diag::{Condition, ValueKind};
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::report::Report;
use crate::exec::shaping::ShapingState;
use crate::exec::shaping::{Family, FilterKeys, GuardKeys};
use crate::machine::issues;
use crate::machine::table::{axis_filters, axis_guard};
use crate::machine::{Axis, Machine};
use crate::syntax::ast::Span;
use kontur_filters::fir::MAX_ORDER;
use kontur_filters::vib_guard::VibGuardSettings;

impl ShapingState {
    /// 22060: a program must use only one of the two commands.
    fn use_family(
        &mut self,
        family: Family,
        machine: &Machine,
        report: &Report,
        span: Span,
    ) -> Outcome<()> {
        match &self.used {
            Some((first, place)) if *first != family => {
                let text = format!(
                    "{} and {} in one program: {} is on line {} of {}",
                    first.command(),
                    family.command(),
                    first.command(),
                    place.line,
                    place.file
                );
                let lines = (place.line, report.source.line);
                return Err(Fault::new(Condition::FilterAndGuard, text, span).with(|d| {
                    d.value(ValueKind::Identification, lines.0, "line").value(
                        ValueKind::Identification,
                        lines.1,
                        "line",
                    )
                }));
            }
            Some(_) => {}
            None => {
                if let Some(place) = report.location.clone() {
                    self.used = Some((family, place));
                }
            }
        }
        self.list_conflict(family, machine, span)
    }

    /// Conflicts of a command with the axis lists.
    fn list_conflict(&self, family: Family, machine: &Machine, span: Span) -> Outcome<()> {
        let cycle = machine.cycle;
        let conflict = machine.axes.iter().find(|axis| {
            let listed = self.listed(axis, cycle);
            match family {
                Family::Filter => listed.vib_guard.active,
                Family::VibGuard => listed.fir.is_some() || listed.hsc.is_some(),
            }
        });
        let Some(axis) = conflict else { return Ok(()) };
        let (id, what, parameter) = match family {
            Family::Filter => (
                Condition::FilterWithListGuard,
                "the list switches the Vibration Guard on",
                axis_guard::ACTIVE.place(),
            ),
            Family::VibGuard => (
                Condition::GuardWithListFilter,
                "the list configures a filter type",
                axis_filters::FIR_TYPE.place(),
            ),
        };
        let text = format!("{}: axis {}: {what}", family.command(), axis.name());
        let (number, name) = (axis.number(), axis.name().to_owned());
        Err(Fault::new(id, text, span).with(|d| d.axis(number, name).parameter(parameter)))
    }

    /// `AX_DEV` and `ACC_FACT`, common to both commands.
    fn set_tolerances(&mut self, family: Family, ax_dev_mm: Option<f64>, acc_fact: Option<f64>) {
        self.ax_dev_mm = match family {
            Family::VibGuard => self.guard_tolerance_mm(ax_dev_mm),
            Family::Filter => ax_dev_mm.filter(|mm| *mm > 0.0),
        };
        self.acc_fact = acc_fact.or(self.acc_fact);
    }
}

arguments! {
    /// Keys of `#VIB GUARD`.
    struct GuardArguments {
        mode: Number "MODE", "", "1..4, default 1 (list vib_guard.mode)";
        freq: Number "FREQ" in at_least(VibGuardSettings::MIN_FREQ_HZ).or(Condition::GuardRange), "Hz", "default 30 (vib_guard.freq)";
        damping: Number "DAMPING" in between(0.0, 1.0).or(Condition::GuardRange), "", "default 0.1 (vib_guard.damping)";
        ax_dev: Number "AX_DEV" in at_least(0.0).or(Condition::GuardRange), "mm", "default 0 = no tolerance monitoring (no list key)";
        acc_fact: Number "ACC_FACT" in between(1.0, 10.0).or(Condition::GuardRange), "", "default 1 (no list key)";
    }
}

/// Row of `#VIB GUARD`.
pub(super) const VIB_GUARD: Row = Row::run("VIB GUARD", vib_guard)
    .form("#VIB GUARD [ON|OFF] [MODE=.. FREQ=.. DAMPING=.. AX_DEV=.. ACC_FACT=..]")
    .meaning(
        "shapes the set position of all axes of the channel so that one natural frequency of the machine is not excited; modal",
    )
    .keys(GuardArguments::KEYS)
    .note(
        "independent of the FIR filter (#FILTER), which smooths a broad band: the two cannot be used in one program (22060). vib_guard.active switches it on from program start. A command without AX_DEV switches the tolerance monitoring off, the other keys keep their last value. Without ON or OFF the values are stored",
    )
    .example("#VIB GUARD ON [MODE=2 FREQ=40 AX_DEV=0.01]")
    .related(&["22060", "22062", "50820", "P-AXIS-00588", "P-AXIS-00571", "P-AXIS-00589", "P-AXIS-00568", "P-AXIS-00013"]);

/// `#VIB GUARD [ON|OFF] [MODE= FREQ= DAMPING= AX_DEV= ACC_FACT=]`.
fn vib_guard(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    call.no_more_words()?;
    decoder.shaping.use_family(Family::VibGuard, &decoder.machine, &decoder.report, call.span())?;
    let keys = GuardArguments::read(decoder, &call.title(), call.command.groups.first())?;
    note_command(decoder, &keys, call.command.on);
    let mut programmed = decoder.shaping.guard;
    if let Some((x, span)) = keys.mode {
        programmed.mode = Some(mode(x, span)?);
    }
    programmed.freq_hz = keys.freq.map(|(x, _)| x).or(programmed.freq_hz);
    programmed.damping = keys.damping.map(|(x, _)| x).or(programmed.damping);
    tolerances(decoder, Family::VibGuard, keys.ax_dev, keys.acc_fact);
    decoder.shaping.command_guard(programmed, call.command.on);
    // OFF without a bracket has no settings to store
    let given = call.command.groups.first().is_some_and(|group| !group.items.is_empty());
    let stores = given || call.command.on.is_none();
    if stores && !guard_is_on(decoder) {
        stored_for_later(decoder, programmed, keys.ax_dev.is_some(), call.span())?;
    }
    decoder.update_shaping(call.span());
    Ok(())
}

/// Whether the guard of any axis is on, by program or list.
pub(super) fn guard_is_on(decoder: &Decoder) -> bool {
    let cycle = decoder.machine.cycle;
    let listed = |axis| decoder.shaping.listed(axis, cycle).vib_guard.active;
    decoder.shaping.guard_on.unwrap_or_else(|| decoder.machine.axes.iter().any(listed))
}

/// Settings given while the guard is off: they must be realisable (50820), and a message reports that they are stored.
fn stored_for_later(
    decoder: &mut Decoder,
    programmed: GuardKeys,
    tolerance: bool,
    span: Span,
) -> Outcome<()> {
    realisable(decoder, programmed, span)?;
    let mut text =
        "the Vibration Guard is off: the values are stored for the next #VIB GUARD ON".to_owned();
    if tolerance {
        text.push_str(", but AX_DEV only applies in the command that switches it on");
    }
    decoder.report.note(Fault::new(Condition::GuardStored, text, span));
    Ok(())
}

/// Records the first command of each kind, for the case that a guard is forced on the program.
fn note_command(decoder: &mut Decoder, keys: &GuardArguments, on: Option<bool>) {
    let Some(place) = &decoder.report.location else { return };
    let commands = &mut decoder.shaping.commands;
    match on {
        Some(true) => _ = commands.on.get_or_insert_with(|| place.clone()),
        Some(false) => _ = commands.off.get_or_insert_with(|| place.clone()),
        None => {}
    }
    if keys.mode.is_some() || keys.freq.is_some() || keys.damping.is_some() {
        commands.settings.get_or_insert_with(|| place.clone());
    }
    if let Some((value, _)) = keys.ax_dev {
        commands.ax_dev.get_or_insert_with(|| (place.clone(), value));
    } else if on == Some(true) {
        commands.on_without_ax_dev.get_or_insert_with(|| place.clone());
    }
}

fn mode(x: f64, span: Span) -> Outcome<u8> {
    let whole = crate::exec::values::number::whole(x, 1, 4);
    whole.and_then(|m| u8::try_from(m).ok()).ok_or_else(|| {
        let text = format!("Vibration Guard mode {x} does not exist, allowed: 1 to 4");
        Fault::new(Condition::GuardMode, text, span).with(|d| {
            d.value(ValueKind::Wrong, x, "-").value(ValueKind::LowerLimit, 1.0, "-").value(
                ValueKind::UpperLimit,
                4.0,
                "-",
            )
        })
    })
}

/// 50820 for settings that are stored while the guard is off.
fn realisable(decoder: &Decoder, programmed: GuardKeys, span: Span) -> Outcome<()> {
    let settings = programmed.over(VibGuardSettings::default());
    let cycle = decoder.machine.cycle;
    match (settings.kernel(cycle), decoder.machine.axes.first()) {
        (Err(e), Some(axis)) => Err(Fault::of(issues::vib_guard(axis, false, &e, cycle), span)),
        _ => Ok(()),
    }
}

/// Maximum order in a program; the filters correct an order that is too high for their type (50911).
const ORDER_MAX: f64 = {
    let most = MAX_ORDER as f64;
    if most > u16::MAX as f64 { most } else { u16::MAX as f64 }
};

arguments! {
    /// Keys of `#FILTER`.
    struct FilterArguments {
        hsc: Flag "HSC", "", "the HSC filter of the axis list";
        mode: Number "MODE", "", "does not exist here (22068)";
        order: Number "ORDER" in between(0.0, ORDER_MAX).whole().or(Condition::FilterRange), "", "values up to 200 are used";
        order_time: Number "ORDER_TIME" in between(0.0, 1e8).whole().or(Condition::FilterRange), "us", "";
        share: Number "SHARE" in between(0.0, 100.0).or(Condition::FilterRange), "%", "default 100";
        ax_dev: Number "AX_DEV" in at_least(0.0).or(Condition::FilterRange), "mm", "default 0 = no monitoring";
        fcut: Number "FCUT" in at_least(1.0).or(Condition::FilterRange), "Hz", "default 30";
        acc_fact: Number "ACC_FACT" in between(1.0, 10.0).or(Condition::FilterRange), "", "default 1";
        quality: Number "QUALITY" in above_zero_to(1.0).or(Condition::FilterRange), "", "default 1";
    }
}

/// Row of `#FILTER`.
pub(super) const FILTER: Row = Row::run("FILTER", filter)
    .form("#FILTER [ON|OFF] [ORDER=.. ORDER_TIME=.. SHARE=.. AX_DEV=.. FCUT=.. ACC_FACT=.. QUALITY=..]   #FILTER ON|OFF [HSC]")
    .meaning(
        "switches the FIR filters of all axes of the channel; they smooth a broad band. With [HSC]: the older HSC filter prepared as filter[0] of the axis list; modal",
    )
    .keys(FilterArguments::KEYS)
    .note(
        "requires a filter type in the axis list (filter_fir.type). Independent of the Vibration Guard (#VIB GUARD): the two cannot be used in one program (22060). FIR filters are recommended instead of HSC filters from V3.1.3075.02 on",
    )
    .example("#FILTER ON [ORDER=20 AX_DEV=0.001]")
    .related(&["22060", "50989", "P-AXIS-00586", "P-AXIS-00587", "P-AXIS-00573", "#VIB GUARD"]);

/// `#FILTER [ON|OFF] [[HSC] ORDER= ORDER_TIME= SHARE= AX_DEV= FCUT= ACC_FACT= QUALITY=]`.
fn filter(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    call.no_more_words()?;
    decoder.shaping.use_family(Family::Filter, &decoder.machine, &decoder.report, call.span())?;
    let keys = FilterArguments::read(decoder, &call.title(), call.command.groups.first())?;
    if let Some((x, span)) = keys.mode {
        let text = format!("#FILTER has no MODE ({x})");
        return Err(Fault::new(Condition::FilterMode, text, span)
            .with(|d| d.value(ValueKind::Wrong, x, "-")));
    }
    let hsc = keys.hsc.is_some();
    let mut stored = if hsc { decoder.shaping.hsc } else { decoder.shaping.fir };
    filter_keys(&keys, &mut stored);
    tolerances(decoder, Family::Filter, keys.ax_dev, keys.acc_fact);
    let cycle = decoder.machine.cycle;
    let configured = decoder.machine.axes.iter().any(|axis| {
        let listed = axis.kernel_preset(cycle);
        if hsc { listed.hsc.is_some() } else { listed.fir.is_some() }
    });
    if !configured {
        let (what, parameter) = if hsc {
            ("an HSC filter", axis_filters::PROTOTYPE)
        } else {
            ("a filter type", axis_filters::FIR_TYPE)
        };
        let text =
            format!("{}: {what} is not configured in any axis list: no effect", call.title());
        let fault = Fault::new(Condition::Odd, text, call.span()).warning();
        decoder.report.note_once(parameter.place().row.key, fault.with(|d| d.parameter(parameter)));
    }
    if hsc {
        decoder.shaping.hsc = stored;
        decoder.shaping.hsc_on = call.command.on.unwrap_or(decoder.shaping.hsc_on);
    } else {
        decoder.shaping.fir = stored;
        decoder.shaping.fir_on = call.command.on.or(decoder.shaping.fir_on);
    }
    if configured && call.command.on.is_none() && !filter_is_on(decoder, hsc) {
        let text = "the filter is off: the values are stored for the next #FILTER ON";
        decoder.report.note(Fault::new(Condition::GuardStored, text, call.span()));
    }
    decoder.update_shaping(call.span());
    Ok(())
}

/// Whether the HSC filter, or the FIR filter of any axis, is on, by program or list.
fn filter_is_on(decoder: &Decoder, hsc: bool) -> bool {
    let cycle = decoder.machine.cycle;
    let listed = |axis| decoder.shaping.listed(axis, cycle).fir.is_some_and(|fir| fir.enable);
    if hsc {
        decoder.shaping.hsc_on
    } else {
        decoder.shaping.fir_on.unwrap_or_else(|| decoder.machine.axes.iter().any(listed))
    }
}

fn filter_keys(keys: &FilterArguments, stored: &mut FilterKeys) {
    let number = |key: Option<(f64, Span)>| key.map(|(x, _)| x);
    let whole = |key| number(key).and_then(|x| crate::exec::values::number::whole(x, 0, u32::MAX));
    if keys.order.is_some() || keys.order_time.is_some() {
        // the later of the two settings applies; if one command has both, the order
        (stored.order, stored.order_time_us) = (whole(keys.order), whole(keys.order_time));
    }
    stored.share_ratio = number(keys.share).map(|p| p / 100.0).or(stored.share_ratio);
    stored.fcut_hz = number(keys.fcut).or(stored.fcut_hz);
    stored.quality = number(keys.quality).or(stored.quality);
}

/// The warning about an `ACC_FACT` above 1 without effect on axes of the machine.
fn acc_fact_fits(machine: &Machine, acc_fact: Option<(f64, Span)>) -> Option<Box<Fault>> {
    let (x, span) = acc_fact.filter(|(x, _)| *x > 1.0)?;
    let without: Vec<&str> =
        machine.axes.iter().filter(|a| a.dynamics().a_trans_ratio <= 0.0).map(Axis::name).collect();
    if without.is_empty() {
        return None;
    }
    let text = format!(
        "ACC_FACT={x} has no effect on the axes {}: it needs a valid P-AXIS-00013",
        without.join(", ")
    );
    Some(Fault::new(Condition::AccFactIgnored, text, span))
}

/// `AX_DEV` and `ACC_FACT`, common to both commands.
fn tolerances(
    decoder: &mut Decoder,
    family: Family,
    ax_dev: Option<(f64, Span)>,
    acc_fact: Option<(f64, Span)>,
) {
    let unit_mm = decoder.modal.tolerance_unit_mm(&decoder.machine.channel);
    let ratio = acc_fact.map(|(x, _)| x);
    decoder.shaping.set_tolerances(family, ax_dev.map(|(x, _)| x * unit_mm), ratio);
    if let Some(fault) = acc_fact_fits(&decoder.machine, acc_fact) {
        decoder.report.note(fault);
    }
}
