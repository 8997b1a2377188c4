//! What the program and the axis lists together make of the Vibration Guard, FIR and HSC filters.
//!
//! One rule for all keys: written now, else written last in this program, else the axis list. `AX_DEV` is the exception:
//! not written means off. A change of a kernel needs the path at rest; a change of tolerances does not.
//!
//! Source: TF5250 Vibration Guard, TF5200 FIR filter, TF5200 axis filters.
use super::step::{AxisShaping, ShapingSettings, ShapingSetup};
use crate::diag::{Condition, Diagnostic, Location};
use crate::machine::issues::{self, Origin};
use crate::machine::{Axis, Machine};
use kontur_filters::fir::{FirConfig, FirKind};
use kontur_filters::hsc::{HscConfig, HscKind};
use kontur_filters::kernel::Kernel;
use kontur_filters::time::CycleTime;
use kontur_filters::vib_guard::VibGuardSettings;
use kontur_motion::block::Tolerance;
use std::sync::Arc;

/// Keys of `#VIB GUARD` that persist.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct GuardKeys {
    pub(super) mode: Option<u8>,
    pub(super) freq_hz: Option<f64>,
    pub(super) damping: Option<f64>,
}

/// Keys of `#FILTER` that persist.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct FilterKeys {
    pub(super) order: Option<u32>,
    pub(super) order_time_us: Option<u32>,
    pub(super) share_ratio: Option<f64>,
    pub(super) fcut_hz: Option<f64>,
    pub(super) quality: Option<f64>,
}

/// Which of the two exclusive commands a program has used.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Family {
    VibGuard,
    Filter,
}

impl Family {
    pub(super) fn command(self) -> &'static str {
        match self {
            Self::VibGuard => "#VIB GUARD",
            Self::Filter => "#FILTER",
        }
    }
}

/// State of the shaping functions of a program.
#[derive(Clone, Debug, Default)]
pub(super) struct ShapingState {
    /// `None`: as the axis lists say.
    pub(super) guard_on: Option<bool>,
    pub(super) guard: GuardKeys,
    pub(super) fir_on: Option<bool>,
    pub(super) fir: FilterKeys,
    pub(super) hsc_on: bool,
    pub(super) hsc: FilterKeys,
    pub(super) ax_dev_mm: Option<f64>,
    /// Last `ACC_FACT` of this program.
    pub(super) acc_fact: Option<f64>,
    /// First use of one of the two command families.
    pub(super) used: Option<(Family, Location)>,
    /// What is in force.
    pub(super) setup: ShapingSetup,
}

/// A setup that was worked out, with everything there is to say about it.
#[derive(Debug, Default)]
pub(super) struct Worked {
    pub(super) setup: ShapingSetup,
    pub(super) diagnostics: Vec<Diagnostic>,
}

impl ShapingState {
    /// True if a kernel of any axis is active.
    pub(super) fn is_active(&self) -> bool {
        self.setup.axes.iter().any(|a| a.kernel.is_some())
    }

    /// Tolerance monitoring for the planner.
    pub(super) fn tolerance(&self) -> Tolerance {
        if !self.is_active() {
            return Tolerance::default();
        }
        Tolerance { ax_dev_mm: self.ax_dev_mm, acc_fact: self.acc_fact.unwrap_or(1.0) }
    }

    /// The setup that follows from lists and program.
    pub(super) fn work_out(&self, machine: &Machine) -> Worked {
        let mut worked = Worked::default();
        for axis in &machine.axes {
            let shaping = self.axis(axis, machine.cycle, &mut worked.diagnostics);
            worked.setup.axes.push(shaping);
        }
        worked.diagnostics.extend(unequal_delays(&worked.setup, machine));
        worked
    }

    fn axis(&self, axis: &Axis, cycle: CycleTime, found: &mut Vec<Diagnostic>) -> AxisShaping {
        let guard_on = self.guard_on.unwrap_or(axis.flag("vib_guard.active"));
        let fir = self.fir(axis);
        let fir_on = self.fir_on.unwrap_or(axis.flag("filter_fir.enable"));
        if let (Some(config), true) = (fir, fir_on) {
            if guard_on {
                let text = "the list switches the Vibration Guard on and a FIR filter is active: \
                            the Vibration Guard is off";
                let d = Diagnostic::new(Condition::ListFirAndGuard, with_axis(axis, text));
                found.push(d.axis(axis.number(), axis.name()));
            }
            let (kernel, issues) = config.design(cycle);
            found.extend(issues.iter().map(|i| issues::filter(axis, Origin::Program, i)));
            return shaped(ShapingSettings::Fir(config), kernel);
        }
        if let (Some(config), true) = (self.hsc(axis), self.hsc_on) {
            let (kernel, issues) = config.design(cycle);
            found.extend(issues.iter().map(|i| issues::filter(axis, Origin::Program, i)));
            return shaped(ShapingSettings::Hsc(config), kernel);
        }
        if guard_on {
            let settings = self.guard_settings(axis);
            match settings.kernel(cycle) {
                Ok(kernel) => return shaped(ShapingSettings::VibGuard(settings), Some(kernel)),
                Err(e) => found.push(issues::vib_guard(axis, Origin::Program, &e, cycle)),
            }
        }
        AxisShaping::default()
    }

    fn guard_settings(&self, axis: &Axis) -> VibGuardSettings {
        let list = listed_guard(axis);
        VibGuardSettings {
            mode: self.guard.mode.unwrap_or(list.mode),
            freq_hz: self.guard.freq_hz.unwrap_or(list.freq_hz),
            damping: self.guard.damping.unwrap_or(list.damping),
        }
    }

    fn fir(&self, axis: &Axis) -> Option<FirConfig> {
        let mut config = listed_fir(axis)?;
        config.program_order(self.fir.order, self.fir.order_time_us);
        config.share_ratio = self.fir.share_ratio.unwrap_or(config.share_ratio);
        config.fcut_hz = self.fir.fcut_hz.unwrap_or(config.fcut_hz);
        config.quality = self.fir.quality.unwrap_or(config.quality);
        Some(config)
    }

    fn hsc(&self, axis: &Axis) -> Option<HscConfig> {
        let mut config = listed_hsc(axis)?;
        if let Some(order) = self.hsc.order {
            (config.order, config.time_constant_us) = (order, 0);
        } else if let Some(time_us) = self.hsc.order_time_us {
            (config.order, config.time_constant_us) = (0, time_us);
        }
        config.share_ratio = self.hsc.share_ratio.unwrap_or(config.share_ratio);
        config.f_hz = self.hsc.fcut_hz.unwrap_or(config.f_hz);
        Some(config)
    }
}

fn shaped(settings: ShapingSettings, kernel: Option<Kernel>) -> AxisShaping {
    match kernel {
        Some(kernel) => AxisShaping { settings, kernel: Some(Arc::new(kernel)) },
        None => AxisShaping::default(),
    }
}

/// Number of a list as an integer; lists are checked when they are loaded.
fn integer(axis: &Axis, key: &str) -> u32 {
    let x = axis.raw(key).unwrap_or_default();
    super::expr::whole(x, 0, u32::MAX).unwrap_or_default()
}

/// Vibration Guard of an axis list.
pub(super) fn listed_guard(axis: &Axis) -> VibGuardSettings {
    let default = VibGuardSettings::default();
    VibGuardSettings {
        mode: u8::try_from(integer(axis, "vib_guard.mode")).unwrap_or(default.mode),
        freq_hz: axis.raw("vib_guard.freq").unwrap_or(default.freq_hz),
        damping: axis.raw("vib_guard.damping").unwrap_or(default.damping),
    }
}

/// FIR filter of an axis list; `None` without a type (P-AXIS-00586).
pub(super) fn listed_fir(axis: &Axis) -> Option<FirConfig> {
    let kind = match integer(axis, "filter_fir.type") {
        1 => FirKind::MovingAverage,
        2 => FirKind::Gauss,
        3 => FirKind::WindowedSinc,
        4 => FirKind::TimeDelay,
        _ => return None,
    };
    let default = FirConfig::new(kind);
    Some(FirConfig {
        kind,
        order: integer(axis, "filter_fir.order"),
        order_time_us: integer(axis, "filter_fir.order_time"),
        share_ratio: axis.raw("filter_fir.share").map_or(default.share_ratio, |p| p / 100.0),
        fcut_hz: axis.raw("filter_fir.fcut").unwrap_or(default.fcut_hz),
        quality: axis.raw("filter_fir.quality").unwrap_or(default.quality),
    })
}

/// HSC filter of an axis list: entry 0 with the prototype HSC.
pub(super) fn listed_hsc(axis: &Axis) -> Option<HscConfig> {
    /// Number of the prototype HSC (P-AXIS-00153).
    const HSC: u32 = 5;
    if integer(axis, "filter[0].prototype") != HSC {
        return None;
    }
    // P-AXIS-00204: 8 mean, 12 NoVib; the default of an HSC filter is 8
    let kind = match axis.parameters().setting("filter[0].type") {
        None => HscKind::Mean,
        Some(_) => match integer(axis, "filter[0].type") {
            8 => HscKind::Mean,
            12 => HscKind::NoVib,
            _ => return None,
        },
    };
    Some(HscConfig {
        kind,
        order: integer(axis, "filter[0].order"),
        time_constant_us: integer(axis, "filter[0].time_constant"),
        f_hz: axis.raw("filter[0].fg_f0").unwrap_or(30.0),
        share_ratio: axis.raw("filter[0].share_percent").map_or(1.0, |p| p / 100.0),
    })
}

fn with_axis(axis: &Axis, text: &str) -> String {
    format!("axis {}: {text}", axis.name())
}

/// Axes of one group whose kernels and standard filters together delay them differently run asynchronously.
fn unequal_delays(setup: &ShapingSetup, machine: &Machine) -> Option<Diagnostic> {
    let kernel = |a: &AxisShaping| a.kernel.as_ref().map_or(0.0, |k| k.delay_cycles());
    let delays: Vec<f64> = setup
        .axes
        .iter()
        .zip(&machine.axes)
        .map(|(a, axis)| kernel(a) + axis.standard_filter_delay_cycles(machine.cycle))
        .collect();
    let low = delays.iter().copied().fold(f64::INFINITY, f64::min);
    let high = delays.iter().copied().fold(0.0, f64::max);
    if high - low < 1e-6 || delays.is_empty() {
        return None;
    }
    let ms = f64::from(machine.cycle.us()) / 1e3;
    let list: Vec<String> = machine
        .axes
        .iter()
        .zip(&delays)
        .map(|(a, d)| format!("{} {:.3} ms", a.name(), d * ms))
        .collect();
    let text = format!(
        "axes of one group are shaped with different delays and run asynchronously: {}",
        list.join(", ")
    );
    Some(Diagnostic::new(Condition::UnequalKernels, text))
}
