//! Vibration Guard, FIR and HSC filters as they result from the program and the axis lists.
//!
//! The same rule applies to all keys: the value in the command, else the last value in this program, else that of the axis
//! list. `AX_DEV` is the exception: without it the monitoring is off. A change of a kernel requires the path at standstill; a
//! change of tolerances does not.
//!
//! Source: TF5250 Vibration Guard, TF5200 FIR filter, TF5200 axis filters.
use super::options::{ForcedGuard, GuardCommands};
use super::step::{AxisShaping, ShapingSettings, ShapingSetup};
use crate::diag::{Condition, Diagnostic, Location};
use crate::machine::issues;
use crate::machine::{Axis, KernelPreset, Machine};
use kontur_filters::fir::FirConfig;
use kontur_filters::hsc::HscConfig;
use kontur_filters::issue::FilterIssue;
use kontur_filters::kernel::Kernel;
use kontur_filters::time::CycleTime;
use kontur_filters::vib_guard::VibGuardSettings;
use kontur_motion::block::Tolerance;
use std::sync::Arc;

/// Modal keys of `#VIB GUARD`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct GuardKeys {
    pub(super) mode: Option<u8>,
    pub(super) freq_hz: Option<f64>,
    pub(super) damping: Option<f64>,
}

impl GuardKeys {
    /// Values of the program, completed by those of the list.
    pub(super) fn over(&self, listed: VibGuardSettings) -> VibGuardSettings {
        VibGuardSettings {
            mode: self.mode.unwrap_or(listed.mode),
            freq_hz: self.freq_hz.unwrap_or(listed.freq_hz),
            damping: self.damping.unwrap_or(listed.damping),
        }
    }
}

/// Modal keys of `#FILTER`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct FilterKeys {
    pub(super) order: Option<u32>,
    pub(super) order_time_us: Option<u32>,
    pub(super) share_ratio: Option<f64>,
    pub(super) fcut_hz: Option<f64>,
    pub(super) quality: Option<f64>,
}

/// The one of two exclusive commands that a program has used.
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
    /// `None`: as defined by the axis lists.
    pub(super) guard_on: Option<bool>,
    pub(super) guard: GuardKeys,
    /// Whether the guards of the lists have had their own values since an axis exchange.
    exchanged: bool,
    pub(super) fir_on: Option<bool>,
    pub(super) fir: FilterKeys,
    pub(super) hsc_on: bool,
    pub(super) hsc: FilterKeys,
    pub(super) ax_dev_mm: Option<f64>,
    /// Last `ACC_FACT` of this program.
    pub(super) acc_fact: Option<f64>,
    /// First use of one of the two command families.
    pub(super) used: Option<(Family, Location)>,
    /// The commands of the program for the guard.
    pub(super) commands: GuardCommands,
    /// The guard that replaces that of lists and program.
    forced: Option<ForcedGuard>,
    /// The active setup.
    pub(super) setup: ShapingSetup,
}

/// A computed setup, with its conditions.
#[derive(Debug, Default)]
pub(super) struct Worked {
    pub(super) setup: ShapingSetup,
    pub(super) diagnostics: Vec<Diagnostic>,
}

impl ShapingState {
    /// The state at program start.
    pub(super) fn new(forced: Option<ForcedGuard>) -> Self {
        let ax_dev_mm = forced.and_then(|f| f.ax_dev_mm);
        Self { ax_dev_mm, forced, ..Self::default() }
    }

    /// The kernel slot of an axis as defined by the lists, or as forced.
    pub(super) fn listed(&self, axis: &Axis, cycle: CycleTime) -> KernelPreset {
        let mut listed = axis.kernel_preset(cycle);
        if let Some(forced) = &self.forced {
            listed.vib_guard.active = forced.settings.is_some();
            listed.vib_guard.settings = forced.settings.unwrap_or(listed.vib_guard.settings);
        }
        listed
    }

    /// Tolerance in mm of a command of the Vibration Guard that sets this one, 0 for none.
    pub(super) fn guard_tolerance_mm(&self, named: Option<f64>) -> Option<f64> {
        named.or(self.forced.and_then(|f| f.ax_dev_mm)).filter(|mm| *mm > 0.0)
    }

    /// The keys of the program that act now.
    pub(super) fn guard_in_force(&self) -> GuardKeys {
        if self.exchanged { GuardKeys::default() } else { self.guard }
    }

    /// A command of the program for the guard.
    pub(super) fn command_guard(&mut self, keys: GuardKeys, on: Option<bool>) {
        (self.guard, self.exchanged) = (keys, false);
        self.guard_on = on.or(self.guard_on);
    }

    /// An axis exchange: a guard of the program is switched off, those of the lists continue with their own values (TF5250,
    /// axis exchange commands). The keys of the program stay for its next command. False if nothing changes.
    pub(super) fn exchange_axes(&mut self) -> bool {
        let of_guard = self.used.as_ref().is_some_and(|(family, _)| *family == Family::VibGuard);
        let changes = self.guard_on.take().is_some()
            || self.guard_in_force() != GuardKeys::default()
            || of_guard && self.ax_dev_mm.is_some();
        self.exchanged = true;
        if changes {
            self.ax_dev_mm = None;
        }
        changes
    }

    /// Settings of the guard, from the list and the program.
    fn guard_settings(&self, listed: VibGuardSettings) -> VibGuardSettings {
        let forced = self.forced.and_then(|f| f.settings);
        forced.unwrap_or_else(|| self.guard_in_force().over(listed))
    }

    /// The command of the program because of which a changed list acts neither now nor later: every value that has changed is
    /// written in the program. A value that the next ON will use is not overridden.
    pub(super) fn overrides(
        &self,
        before: &KernelPreset,
        after: &KernelPreset,
    ) -> Option<&'static str> {
        let guard = |listed: &KernelPreset| {
            let on = self.guard_on.unwrap_or(listed.vib_guard.active);
            (on, self.guard_in_force().over(listed.vib_guard.settings))
        };
        let fir = |listed: &KernelPreset| {
            listed.fir.map(|fir| (self.fir_on.unwrap_or(fir.enable), self.fir(fir.config)))
        };
        if before.vib_guard != after.vib_guard && guard(before) == guard(after) {
            Some(Family::VibGuard.command())
        } else if before.fir != after.fir && fir(before) == fir(after) {
            Some(Family::Filter.command())
        } else {
            None
        }
    }

    /// Whether the kernel of any axis is active.
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

    /// Activates the setup of the program start, and returns its conditions.
    ///
    /// Spindles are shaped by their lists only: the commands apply to the path axes of the channel.
    pub(super) fn start(&mut self, machine: &Machine) -> Vec<Diagnostic> {
        let (of_lists, mut found) = (Self::default(), Vec::new());
        let spindles = machine.spindles.iter();
        self.setup.spindles =
            spindles.map(|axis| of_lists.axis(axis, machine.cycle, &mut found)).collect();
        let Worked { setup, diagnostics } = self.work_out(machine);
        self.setup = setup;
        found.extend(diagnostics);
        found
    }

    /// The setup that results from lists and program.
    pub(super) fn work_out(&self, machine: &Machine) -> Worked {
        let mut worked = Worked::default();
        worked.setup.spindles.clone_from(&self.setup.spindles);
        for axis in &machine.axes {
            let shaping = self.axis(axis, machine.cycle, &mut worked.diagnostics);
            worked.setup.axes.push(shaping);
        }
        worked.diagnostics.extend(unequal_delays(&worked.setup, machine));
        if self.ax_dev_mm.is_some() && worked.setup.axes.iter().any(|a| a.kernel.is_some()) {
            worked.diagnostics.extend(unequal_bridges(machine));
        }
        worked
    }

    /// K-0156 for a slave of an axis coupling under `AX_DEV` whose kernel or standard filters differ from those of its master.
    pub(super) fn follower_not_covered(
        &self,
        (slave, master): (usize, usize),
        machine: &Machine,
    ) -> Option<Diagnostic> {
        self.tolerance().ax_dev_mm?;
        let kernel = |axis: usize| self.setup.axes.get(axis).map(|shaping| &shaping.kernel);
        let [slave_axis, master_axis] = [slave, master].map(|axis| &machine.axes[axis]);
        let alike = kernel(slave) == kernel(master)
            && slave_axis.has_standard_filters_of(master_axis, machine.cycle);
        (!alike).then(|| not_covered(slave_axis, master_axis))
    }

    fn axis(&self, axis: &Axis, cycle: CycleTime, found: &mut Vec<Diagnostic>) -> AxisShaping {
        let listed = self.listed(axis, cycle);
        let guard_on = self.guard_on.unwrap_or(listed.vib_guard.active);
        let fir = listed.fir.map(|fir| self.fir(fir.config));
        let fir_on = self.fir_on.unwrap_or(listed.fir.is_some_and(|fir| fir.enable));
        if fir.is_some() && guard_on {
            let text = "the list configures a FIR filter and switches the Vibration Guard on: \
                        the Vibration Guard is off";
            let d = Diagnostic::new(Condition::ListFirAndGuard, with_axis(axis, text));
            found.push(d.axis(axis.number(), axis.name()));
        }
        if let (Some(config), true) = (fir, fir_on) {
            if self.hsc_on && listed.hsc.is_some() {
                let text = "a FIR filter is active: the HSC filter is off";
                let d = Diagnostic::new(Condition::FirAndHsc, with_axis(axis, text));
                found.push(d.axis(axis.number(), axis.name()));
            }
            let (kernel, issues) = config.design(cycle);
            let listed = listed.fir.is_some_and(|fir| fir.enable && fir.config == config);
            found.extend(of_program(axis, listed, &issues));
            return shaped(ShapingSettings::Fir(config), kernel);
        }
        if let (Some(config), true) = (listed.hsc.map(|hsc| self.hsc(hsc)), self.hsc_on) {
            let (kernel, issues) = config.design(cycle);
            found.extend(of_program(axis, listed.hsc == Some(config), &issues));
            return shaped(ShapingSettings::Hsc(config), kernel);
        }
        if guard_on && fir.is_none() {
            let settings = self.guard_settings(listed.vib_guard.settings);
            match settings.kernel(cycle) {
                Ok(kernel) => return shaped(ShapingSettings::VibGuard(settings), Some(kernel)),
                Err(e) => found.push(issues::vib_guard(axis, false, &e, cycle)),
            }
        }
        AxisShaping::default()
    }

    fn fir(&self, listed: FirConfig) -> FirConfig {
        let mut config = listed;
        config.program_order(self.fir.order, self.fir.order_time_us);
        config.share_ratio = self.fir.share_ratio.unwrap_or(config.share_ratio);
        config.fcut_hz = self.fir.fcut_hz.unwrap_or(config.fcut_hz);
        config.quality = self.fir.quality.unwrap_or(config.quality);
        config
    }

    fn hsc(&self, listed: HscConfig) -> HscConfig {
        let mut config = listed;
        if let Some(order) = self.hsc.order {
            (config.order, config.time_constant_us) = (order, 0);
        } else if let Some(time_us) = self.hsc.order_time_us {
            (config.order, config.time_constant_us) = (0, time_us);
        }
        config.share_ratio = self.hsc.share_ratio.unwrap_or(config.share_ratio);
        config.f_hz = self.hsc.fcut_hz.unwrap_or(config.f_hz);
        config
    }
}

fn shaped(settings: ShapingSettings, kernel: Option<Kernel>) -> AxisShaping {
    match kernel {
        Some(kernel) => AxisShaping { settings, kernel: Some(Arc::new(kernel)) },
        None => AxisShaping::default(),
    }
}

/// The conditions of a filter that the program switches on, except for warnings that were said with the lists: `listed`, the
/// program uses the settings of a list that was checked.
fn of_program(axis: &Axis, listed: bool, issues: &[FilterIssue]) -> Vec<Diagnostic> {
    let found = issues.iter().map(|issue| issues::filter(axis, None, issue));
    found.filter(|diagnostic| !listed || diagnostic.is_error()).collect()
}

fn with_axis(axis: &Axis, text: &str) -> String {
    format!("axis {}: {text}", axis.name())
}

/// K-0156.
fn not_covered(slave: &Axis, master: &Axis) -> Diagnostic {
    let text = format!(
        "AX_DEV does not cover axis {}, which follows {} with other filters: how far it leaves the path is not examined",
        slave.name(),
        master.name()
    );
    Diagnostic::new(Condition::FollowerNotCovered, text).axis(slave.number(), slave.name())
}

/// K-0156 for gantry slaves: they have the kernel of their master and their own standard filters.
fn unequal_bridges(machine: &Machine) -> impl Iterator<Item = Diagnostic> {
    machine.gantry_slaves.iter().filter_map(|slave| {
        let master = machine.axes.get(machine.master_of(slave)?)?;
        let alike = slave.has_standard_filters_of(master, machine.cycle);
        (!alike).then(|| not_covered(slave, master))
    })
}

/// Axes of one group are asynchronous if the total delays of their kernels and standard filters differ. Gantry slaves have the
/// kernel of their master and their own filters.
fn unequal_delays(setup: &ShapingSetup, machine: &Machine) -> Option<Diagnostic> {
    let slaves =
        machine.gantry_slaves.iter().filter_map(|slave| Some((machine.master_of(slave)?, slave)));
    let axes = machine.axes.iter().enumerate().chain(slaves);
    let delays: Vec<(&Axis, f64)> = axes
        .map(|(shaped_as, axis)| {
            let kernel = setup.axes[shaped_as].kernel.as_ref().map_or(0.0, |k| k.delay_cycles());
            (axis, kernel + axis.standard_filter_delay_cycles(machine.cycle))
        })
        .collect();
    let low = delays.iter().map(|(_, d)| *d).fold(f64::INFINITY, f64::min);
    let high = delays.iter().map(|(_, d)| *d).fold(0.0, f64::max);
    let ms = f64::from(machine.cycle.us()) / 1e3;
    // printed with three digits
    if (high - low) * ms < 1e-3 || delays.is_empty() {
        return None;
    }
    let list: Vec<String> =
        delays.iter().map(|(a, d)| format!("{} {:.3} ms", a.name(), d * ms)).collect();
    let text = format!(
        "axes of one group are shaped with different delays and run asynchronously: {}",
        list.join(", ")
    );
    Some(Diagnostic::new(Condition::UnequalKernels, text))
}
