//! `#VIB GUARD` and `#FILTER`.
//!
//! Source: TF5250 Vibration Guard; TF5200 FIR filter and axis filters (HSC).

use super::keys::{flag, number};
use super::{Arguments, Call, Key, arguments};
use crate::diag::{Condition, ValueKind};
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::shaping::{Family, FilterKeys, GuardKeys};
use crate::machine::issues;
use crate::syntax::ast::Span;
use kontur_filters::fir::MAX_ORDER;
use kontur_filters::vib_guard::VibGuardSettings;

impl Decoder {
    /// 22060: the two commands exclude each other in a program.
    fn use_family(&mut self, family: Family, span: Span) -> Outcome<()> {
        match &self.shaping.used {
            Some((first, place)) if *first != family => {
                let text = format!(
                    "{} and {} in one program: {} stands in line {} of {}",
                    first.command(),
                    family.command(),
                    first.command(),
                    place.line,
                    place.file
                );
                let lines = (place.line, self.source.line);
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
                if let Some(place) = self.location.clone() {
                    self.shaping.used = Some((family, place));
                }
            }
        }
        self.list_conflict(family, span)
    }

    /// Conflicts of a command with the axis lists.
    fn list_conflict(&mut self, family: Family, span: Span) -> Outcome<()> {
        let cycle = self.machine.cycle;
        let conflict = self.machine.axes.iter().find(|axis| {
            let listed = axis.kernel_preset(cycle);
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
                "P-AXIS-00588",
            ),
            Family::VibGuard => (
                Condition::GuardWithListFilter,
                "the list configures a filter type",
                "P-AXIS-00586",
            ),
        };
        let text = format!("{}: axis {}: {what}", family.command(), axis.name());
        let (number, name) = (axis.number(), axis.name().to_owned());
        Err(Fault::new(id, text, span).with(|d| d.axis(number, name).parameter(parameter)))
    }

    /// `AX_DEV` and `ACC_FACT`, common to both commands.
    fn tolerances(&mut self, keys: &Arguments, condition: Condition) -> Outcome<()> {
        let ax_dev = keys.in_range("AX_DEV", 0.0, f64::MAX, condition)?;
        let acc_fact = keys.in_range("ACC_FACT", 1.0, 10.0, condition)?;
        self.shaping.ax_dev_mm = ax_dev.filter(|x| *x > 0.0).map(|x| x * self.tolerance_unit_mm());
        if acc_fact.is_some() {
            self.shaping.acc_fact = acc_fact;
        }
        if let Some((x, span)) = keys.number("ACC_FACT").filter(|(x, _)| *x > 1.0) {
            let without: Vec<String> = self
                .machine
                .axes
                .iter()
                .filter(|a| a.dynamics().a_trans_ratio <= 0.0)
                .map(|a| a.name().to_owned())
                .collect();
            if !without.is_empty() {
                let text = format!(
                    "ACC_FACT={x} has no effect on the axes {}: it needs a valid P-AXIS-00013",
                    without.join(", ")
                );
                let fault = Fault::new(Condition::AccFactIgnored, text, span);
                self.note(fault.with(|d| d.parameter("P-AXIS-00013")));
            }
        }
        Ok(())
    }
}

/// `#VIB GUARD [ON|OFF] [MODE= FREQ= DAMPING= AX_DEV= ACC_FACT=]`.
pub(super) fn vib_guard(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    const KEYS: &[Key] =
        &[number("MODE"), number("FREQ"), number("DAMPING"), number("AX_DEV"), number("ACC_FACT")];
    call.no_more_words()?;
    decoder.use_family(Family::VibGuard, call.span())?;
    let keys = arguments(decoder, "#VIB GUARD", call.command.groups.first(), KEYS);
    let mut programmed = decoder.shaping.guard;
    if let Some((x, span)) = keys.number("MODE") {
        programmed.mode = Some(mode(x, span)?);
    }
    if let Some(freq_hz) =
        keys.in_range("FREQ", VibGuardSettings::MIN_FREQ_HZ, f64::MAX, Condition::GuardRange)?
    {
        programmed.freq_hz = Some(freq_hz);
    }
    if let Some(damping) = keys.in_range("DAMPING", 0.0, 1.0, Condition::GuardRange)? {
        programmed.damping = Some(damping);
    }
    decoder.tolerances(&keys, Condition::GuardRange)?;
    decoder.shaping.guard = programmed;
    if let Some(on) = call.command.on {
        decoder.shaping.guard_on = Some(on);
    } else {
        let cycle = decoder.machine.cycle;
        let on = |a: &crate::machine::Axis| {
            decoder.shaping.guard_on.unwrap_or(a.kernel_preset(cycle).vib_guard.active)
        };
        if !decoder.machine.axes.iter().any(on) {
            realisable(decoder, programmed, call.span())?;
            let text =
                "the Vibration Guard is off: the values are stored for the next #VIB GUARD ON";
            decoder.note(Fault::new(Condition::GuardStored, text, call.span()));
        }
    }
    decoder.update_shaping(call.span());
    Ok(())
}

fn mode(x: f64, span: Span) -> Outcome<u8> {
    let whole = crate::exec::expr::whole(x, 1, 4).filter(|m| (f64::from(*m) - x).abs() < 1e-9);
    whole.and_then(|m| u8::try_from(m).ok()).ok_or_else(|| {
        let text = format!("Vibration Guard mode {x} does not exist, allowed are 1 to 4");
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

/// `#FILTER [ON|OFF] [[HSC] ORDER= ORDER_TIME= SHARE= AX_DEV= FCUT= ACC_FACT= QUALITY=]`.
pub(super) fn filter(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    const KEYS: &[Key] = &[
        flag("HSC"),
        number("MODE"),
        number("ORDER"),
        number("ORDER_TIME"),
        number("SHARE"),
        number("AX_DEV"),
        number("FCUT"),
        number("ACC_FACT"),
        number("QUALITY"),
    ];
    call.no_more_words()?;
    decoder.use_family(Family::Filter, call.span())?;
    let keys = arguments(decoder, "#FILTER", call.command.groups.first(), KEYS);
    if let Some((x, span)) = keys.number("MODE") {
        let text = format!("#FILTER has no MODE ({x})");
        return Err(Fault::new(Condition::FilterMode, text, span)
            .with(|d| d.value(ValueKind::Wrong, x, "-")));
    }
    let hsc = keys.has("HSC");
    let mut stored = if hsc { decoder.shaping.hsc } else { decoder.shaping.fir };
    filter_keys(&keys, &mut stored)?;
    decoder.tolerances(&keys, Condition::FilterRange)?;
    let cycle = decoder.machine.cycle;
    let configured = decoder.machine.axes.iter().any(|axis| {
        let listed = axis.kernel_preset(cycle);
        if hsc { listed.hsc.is_some() } else { listed.fir.is_some() }
    });
    if !configured {
        let (what, parameter) =
            if hsc { ("an HSC filter", "P-AXIS-00153") } else { ("a filter type", "P-AXIS-00586") };
        let text = format!("{}: no axis list configures {what}: no effect", call.title());
        let fault = Fault::new(Condition::Odd, text, call.span()).warning();
        decoder.note_once(parameter, fault.with(|d| d.parameter(parameter)));
    }
    if hsc {
        decoder.shaping.hsc = stored;
        decoder.shaping.hsc_on = call.command.on.unwrap_or(decoder.shaping.hsc_on);
    } else {
        decoder.shaping.fir = stored;
        decoder.shaping.fir_on = call.command.on.or(decoder.shaping.fir_on);
    }
    decoder.update_shaping(call.span());
    Ok(())
}

fn filter_keys(keys: &Arguments, stored: &mut FilterKeys) -> Outcome<()> {
    /// Longest time that gives an order.
    const TIME_MAX_US: f64 = 1e8;
    let order_max = f64::from(u16::MAX).max(f64::from(MAX_ORDER));
    let order = keys.in_range("ORDER", 0.0, order_max, Condition::FilterRange)?;
    let time = keys.in_range("ORDER_TIME", 0.0, TIME_MAX_US, Condition::FilterRange)?;
    let share = keys.in_range("SHARE", 0.0, 100.0, Condition::FilterRange)?;
    let fcut = keys.in_range("FCUT", 1.0, f64::MAX, Condition::FilterRange)?;
    let quality = keys.in_range("QUALITY", f64::MIN_POSITIVE, 1.0, Condition::FilterRange)?;
    let whole = |x: Option<f64>| x.and_then(|x| crate::exec::expr::whole(x, 0, u32::MAX));
    if order.is_some() || time.is_some() {
        // the newer of the two rules; both in one command: the order
        (stored.order, stored.order_time_us) = (whole(order), whole(time));
    }
    stored.share_ratio = share.map(|p| p / 100.0).or(stored.share_ratio);
    stored.fcut_hz = fcut.or(stored.fcut_hz);
    stored.quality = quality.or(stored.quality);
    Ok(())
}
