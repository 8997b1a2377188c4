//! Axis filters and the kernel slot of one axis.

use super::control::{converted, raw};
use crate::diag::{Condition, Diagnostic};
use crate::machine::Axis;
use crate::machine::axis::{AxisKind, integer};
use crate::machine::issues::{self, Origin};
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

/// The additional interface of an axis (`lr_param.add_interface`): a position from outside that is added behind the axis
/// filters.
#[derive(Clone, Debug)]
pub struct AdditionalInterface {
    /// Filter that the position passes, if it is on.
    pub filter: Option<AxisFilter>,
}

/// What the list says about the kernel slot of an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KernelPreset {
    /// Vibration Guard.
    pub vib_guard: VibGuardPreset,
    /// FIR filter; `None` if it has no type (P-AXIS-00586).
    pub fir: Option<FirPreset>,
    /// HSC filter that `#FILTER ON [HSC]` makes effective (`filter[0]`).
    pub hsc: Option<HscConfig>,
}

/// The standard filters of an axis, designed, and its HSC filter.
pub(super) fn cascade(axis: &Axis, cycle: CycleTime, diagnostics: &mut Vec<Diagnostic>) -> Cascade {
    let mut entries = Vec::new();
    for index in 0..3 {
        entries.push(entry(axis, &format!("filter[{index}]"), diagnostics));
    }
    let cascade = Cascade::design(&entries, axis.kind() == AxisKind::Spindle, cycle);
    diagnostics.extend(cascade.issues.iter().map(|(index, issue)| {
        issues::filter(axis, Origin::List(&format!("filter[{index}]")), issue)
    }));
    cascade
}

/// Keys of the filter of the additional interface.
const ADDITIONAL: &str = "lr_param.add_interface.filter[0]";

/// The additional interface of an axis, `None` if the list leaves it off.
pub(super) fn additional(
    axis: &Axis,
    cycle: CycleTime,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<AdditionalInterface> {
    if !axis.flag("lr_param.add_interface.enable") {
        return None;
    }
    let (filter, issues) = entry(axis, ADDITIONAL, diagnostics).additional(cycle);
    diagnostics
        .extend(issues.iter().map(|issue| issues::filter(axis, Origin::List(ADDITIONAL), issue)));
    Some(AdditionalInterface { filter })
}

/// The filter whose keys begin with `prefix`; what no entry of the list can mean leaves it off.
fn entry(axis: &Axis, prefix: &str, diagnostics: &mut Vec<Diagnostic>) -> FilterEntry {
    let key = |name: &str| format!("{prefix}.{name}");
    let mut enable = axis.flag(&key("enable"));
    // `filter[i]` without a type is no low-pass: with the prototype HSC it means the mean
    let value = match axis.parameters().setting(&key("type")) {
        None if prefix != ADDITIONAL => None,
        _ => axis.raw(&key("type")),
    };
    let number = integer(value);
    let listed_type = match number.map(ListedType::from_number) {
        None => None,
        Some(Ok(listed)) => Some(listed),
        Some(Err(issue)) => {
            diagnostics.push(issues::filter(axis, Origin::List(prefix), &issue));
            enable = false;
            None
        }
    };
    let default = FilterEntry::default();
    let wrong_type = number.is_some() && listed_type.is_none();
    let number = integer(axis.raw(&key("prototype"))).unwrap_or_default();
    let prototype = match ListedPrototype::from_number(number) {
        Some(ListedPrototype::Hsc) if wrong_type => default.prototype,
        Some(prototype) => prototype,
        None => {
            let what = format!("prototype {number} of a filter");
            diagnostics.push(
                issues::about(axis, Condition::ListRange, &key("prototype"), &what, "filter off")
                    .hint("CRIT_DAMPING 1, BUTTERWORTH 2, BESSEL 3, HSC 5; 4 is not assigned"),
            );
            enable = false;
            default.prototype
        }
    };
    FilterEntry {
        enable,
        listed_type,
        prototype,
        order: integer(axis.raw(&key("order"))).unwrap_or_default(),
        f_hz: raw(axis, &key("fg_f0")),
        q: raw(axis, &key("guete")),
        share_ratio: converted(axis, &key("share_percent")),
        time_constant_us: integer(axis.raw(&key("time_constant"))).unwrap_or_default(),
    }
}

/// The kernel slot as the list states it.
pub(super) fn preset(axis: &Axis, cycle: CycleTime) -> KernelPreset {
    let mode = integer(axis.raw("vib_guard.mode")).and_then(|mode| u8::try_from(mode).ok());
    KernelPreset {
        vib_guard: VibGuardPreset {
            active: axis.flag("vib_guard.active"),
            settings: VibGuardSettings {
                mode: mode.unwrap_or_default(),
                freq_hz: raw(axis, "vib_guard.freq"),
                damping: raw(axis, "vib_guard.damping"),
            },
        },
        fir: fir(axis),
        hsc: cascade(axis, cycle, &mut Vec::new()).hsc,
    }
}

fn fir(axis: &Axis) -> Option<FirPreset> {
    let kind = match integer(axis.raw("filter_fir.type")) {
        Some(1) => FirKind::MovingAverage,
        Some(2) => FirKind::Gauss,
        Some(3) => FirKind::WindowedSinc,
        Some(4) => FirKind::TimeDelay,
        _ => return None,
    };
    let config = FirConfig {
        kind,
        order: integer(axis.raw("filter_fir.order")).unwrap_or_default(),
        order_time_us: integer(axis.raw("filter_fir.order_time")).unwrap_or_default(),
        share_ratio: converted(axis, "filter_fir.share"),
        fcut_hz: raw(axis, "filter_fir.fcut"),
        quality: raw(axis, "filter_fir.quality"),
    };
    Some(FirPreset { enable: axis.flag("filter_fir.enable"), config })
}

/// What is wrong with the kernels that are on from program start, and with the HSC filter.
pub(super) fn check_kernels(axis: &Axis, cycle: CycleTime, diagnostics: &mut Vec<Diagnostic>) {
    let preset = preset(axis, cycle);
    let number = raw(axis, "filter_fir.type");
    if number > 4.0 {
        let what = format!("type {number} of the FIR filter, 0 to 4 exist");
        diagnostics.push(issues::about(
            axis,
            Condition::ListRange,
            "filter_fir.type",
            &what,
            "no FIR filter",
        ));
    }
    let fir = preset.fir.filter(|fir| fir.enable).map(|fir| fir.config.design(cycle).1);
    let hsc = preset.hsc.map(|hsc| hsc.design(cycle).1);
    for (prefix, found) in [("filter_fir", fir), ("filter[0]", hsc)] {
        let found = found.unwrap_or_default();
        diagnostics
            .extend(found.iter().map(|issue| issues::filter(axis, Origin::List(prefix), issue)));
    }
    if preset.vib_guard.active
        && let Err(error) = preset.vib_guard.settings.kernel(cycle)
    {
        diagnostics.push(issues::vib_guard(axis, Origin::List("vib_guard"), &error, cycle));
    }
}
