//! Axis filters and the kernel slot of one axis.

use crate::diag::{Condition, Diagnostic};
use crate::machine::Axis;
use crate::machine::issues;
use crate::machine::kind::AxisKind;
use crate::machine::table::axis_filters as of;
use crate::machine::table::axis_guard;
use crate::machine::table::param::Place;
use kontur_filters::{
    cascade::{Cascade, FilterEntry, ListedPrototype, ListedType},
    fir::{FirConfig, FirKind},
    hsc::HscConfig,
    iir::AxisFilter,
    time::CycleTime,
    vib_guard::VibGuardSettings,
};

/// `vib_guard.*` of the list.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VibGuardPreset {
    /// On from program start (P-AXIS-00588).
    pub active: bool,
    /// Mode, frequency and damping.
    pub settings: VibGuardSettings,
}

/// `filter_fir.*` of the list.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FirPreset {
    /// On from program start (P-AXIS-00573).
    pub enable: bool,
    /// The filter.
    pub config: FirConfig,
}

/// The additional interface of an axis (`lr_param.add_interface`): an external position that is added after the axis
/// filters.
#[derive(Clone, Debug, PartialEq)]
pub struct AdditionalInterface {
    /// Filter for the position, if it is on.
    pub filter: Option<AxisFilter>,
}

/// The kernel slot of an axis as configured by the list.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KernelPreset {
    /// Vibration Guard.
    pub vib_guard: VibGuardPreset,
    /// FIR filter; `None` if it has no type (P-AXIS-00586).
    pub fir: Option<FirPreset>,
    /// HSC filter that `#FILTER ON [HSC]` switches on (`filter[0]`).
    pub hsc: Option<HscConfig>,
}

/// The standard filters of an axis, designed, and its HSC filter.
pub(super) fn cascade(axis: &Axis, cycle: CycleTime, diagnostics: &mut Vec<Diagnostic>) -> Cascade {
    let keys = [of::standard(0), of::standard(1), of::standard(2)];
    // `filter[i]` without a type is not a low-pass: with the prototype HSC it means the mean
    let entries: Vec<FilterEntry> =
        keys.iter().map(|k| entry(axis, k, axis.set_by(k.kind).is_some(), diagnostics)).collect();
    let cascade = Cascade::design(&entries, axis.kind() == AxisKind::Spindle, cycle);
    for (index, issue) in &cascade.issues {
        diagnostics.push(issues::filter(axis, keys.get(*index), issue));
    }
    cascade
}

/// The additional interface of an axis, `None` if the list leaves it off.
pub(super) fn additional(
    axis: &Axis,
    cycle: CycleTime,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<AdditionalInterface> {
    if !axis.has_additional_interface() {
        return None;
    }
    let (filter, issues) = entry(axis, &of::ADDITIONAL_FILTER, true, diagnostics).additional(cycle);
    diagnostics.extend(
        issues.iter().map(|issue| issues::filter(axis, Some(&of::ADDITIONAL_FILTER), issue)),
    );
    Some(AdditionalInterface { filter })
}

/// One filter of the list, with a type if it is `typed`; off if its entry is meaningless.
fn entry(
    axis: &Axis,
    keys: &of::FilterParameters,
    typed: bool,
    diagnostics: &mut Vec<Diagnostic>,
) -> FilterEntry {
    let mut enable = axis.get(keys.enable);
    let listed_type = match typed.then(|| ListedType::from_number(axis.get(keys.kind))) {
        None => None,
        Some(Ok(listed)) => Some(listed),
        Some(Err(issue)) => {
            diagnostics.push(issues::filter(axis, Some(keys), &issue));
            enable = false;
            None
        }
    };
    let default = FilterEntry::default();
    let wrong_type = typed && listed_type.is_none();
    let number = axis.get(keys.prototype);
    let prototype = match ListedPrototype::from_number(number) {
        Some(ListedPrototype::Hsc) if wrong_type => default.prototype,
        Some(prototype) => prototype,
        None => {
            let what = format!("prototype {number} of a filter");
            diagnostics.push(
                issues::about(axis, Condition::ListRange, keys.prototype, &what, "filter off")
                    .hint("write 1 (CRIT_DAMPING), 2 (BUTTERWORTH), 3 (BESSEL) or 5 (HSC)"),
            );
            enable = false;
            default.prototype
        }
    };
    let order = axis.get(keys.order);
    let is_hsc =
        prototype == ListedPrototype::Hsc || matches!(listed_type, Some(ListedType::Hsc(_)));
    if enable && order == 0 && !is_hsc {
        let place = [keys.order.place(), keys.enable.place()];
        let place = place[usize::from(axis.set_by(keys.order).is_none())];
        let (what, effect) = ("filter switched on with order 0", "the filter is off");
        diagnostics.push(
            issues::about(axis, Condition::ListNoEffect, place, what, effect)
                .hint("write an order greater than 0: 1 for PT1, 2 for PT2, any for TIME_DELAY"),
        );
    }
    FilterEntry {
        enable,
        listed_type,
        prototype,
        order,
        f_hz: axis.get(keys.frequency),
        q: axis.get(keys.quality),
        share_ratio: axis.get(keys.share),
        time_constant_us: axis.get(keys.time),
    }
}

/// The kernel slot as configured by the list.
pub(super) fn preset(axis: &Axis, cycle: CycleTime) -> KernelPreset {
    KernelPreset {
        vib_guard: VibGuardPreset {
            active: axis.get(axis_guard::ACTIVE),
            settings: VibGuardSettings {
                mode: u8::try_from(axis.get(axis_guard::MODE)).unwrap_or(u8::MAX),
                freq_hz: axis.get(axis_guard::FREQUENCY),
                damping: axis.get(axis_guard::DAMPING),
            },
        },
        fir: fir(axis),
        hsc: cascade(axis, cycle, &mut Vec::new()).hsc,
    }
}

fn fir(axis: &Axis) -> Option<FirPreset> {
    let kind = match axis.get(of::FIR_FILTER.kind) {
        1 => FirKind::MovingAverage,
        2 => FirKind::Gauss,
        3 => FirKind::WindowedSinc,
        4 => FirKind::TimeDelay,
        _ => return None,
    };
    let config = FirConfig {
        kind,
        order: axis.get(of::FIR_FILTER.order),
        order_time_us: axis.get(of::FIR_FILTER.time),
        share_ratio: axis.get(of::FIR_FILTER.share),
        fcut_hz: axis.get(of::FIR_FILTER.frequency),
        quality: axis.get(of::FIR_FILTER.quality),
    };
    Some(FirPreset { enable: axis.get(of::FIR_FILTER.enable), config })
}

/// Reports errors of the kernels that are on from program start, and of the HSC filter.
pub(super) fn check_kernels(axis: &Axis, cycle: CycleTime, diagnostics: &mut Vec<Diagnostic>) {
    let preset = preset(axis, cycle);
    check_fir_kind(axis, diagnostics);
    let fir = preset.fir.filter(|fir| fir.enable).map(|fir| fir.config.design(cycle).1);
    let hsc = preset.hsc.map(|hsc| hsc.design(cycle).1);
    for (keys, found) in [(of::FIR_FILTER, fir), (of::standard(0), hsc)] {
        let found = found.unwrap_or_default();
        diagnostics.extend(found.iter().map(|issue| issues::filter(axis, Some(&keys), issue)));
    }
    if preset.vib_guard.active
        && let Err(error) = preset.vib_guard.settings.kernel(cycle)
    {
        diagnostics.push(issues::vib_guard(axis, true, &error, cycle));
    }
}

/// Reports an undefined type of FIR filter (P-AXIS-00586).
pub(super) fn check_fir_kind(axis: &Axis, diagnostics: &mut Vec<Diagnostic>) {
    let number = axis.get(of::FIR_FILTER.kind);
    if number > 4 {
        let what = format!("type {number} of the FIR filter, allowed: 0 to 4");
        let place = of::FIR_FILTER.kind;
        diagnostics.push(issues::about(axis, Condition::ListRange, place, &what, "no FIR filter"));
    }
}

/// Reports kernels in the list of a gantry slave that its master does not have: they have no effect.
pub(super) fn check_slave(
    slave: &Axis,
    master: &Axis,
    cycle: CycleTime,
    diagnostics: &mut Vec<Diagnostic>,
) {
    let (own, of_master) = (preset(slave, cycle), preset(master, cycle));
    let effect = format!("no effect, the slave is shaped like its master {}", master.name());
    let mut say = |param: Place, what: &str| {
        diagnostics.push(
            issues::about(slave, Condition::ListNoEffect, param, what, &effect)
                .hint("write it in the list of the master"),
        );
    };
    if own.vib_guard.active && own.vib_guard != of_master.vib_guard {
        say(axis_guard::ACTIVE.place(), "Vibration Guard of a gantry slave");
    }
    if own.fir.is_some_and(|fir| fir.enable) && own.fir != of_master.fir {
        say(of::FIR_FILTER.enable.place(), "FIR filter of a gantry slave");
    }
    if own.hsc.is_some() && own.hsc != of_master.hsc {
        say(of::standard(0).prototype.place(), "HSC filter of a gantry slave");
    }
}
