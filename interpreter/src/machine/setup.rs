//! From the parameters of a machine to the configuration of each axis downstream of the planner.
//!
//! Ranges are checked while the lists are loaded; problems that only result from several values (a filter that cannot
//! be designed, feedforward to an input that the drive does not have) are found here.

mod control;
mod filters;
mod formats;
mod ipc;
mod monitors;
mod plant;

pub use filters::{AdditionalInterface, FirPreset, KernelPreset, VibGuardPreset};

use super::table::axis_drive;
use super::{Axis, Machine, issues};
use crate::diag::{Condition, Diagnostic};
use kontur_filters::{
    control::{AxisControlConfig, IpcConfig, Issue, feedforward::channel_delay_cycles},
    iir::AxisFilter,
    stage::Stage,
    time::CycleTime,
};

/// Configuration of the chain of one axis.
#[derive(Clone, Debug, PartialEq)]
pub struct ChainSetup {
    /// Standard filters that are on, in order (`filter[i]`).
    pub filters: Vec<AxisFilter>,
    /// Additional interface, `None` if it is off.
    pub additional: Option<AdditionalInterface>,
    /// Everything downstream of the set position, corrected; the delay is that of the whole channel.
    pub control: AxisControlConfig,
    /// Difference of input and output below which the filters count as settled, in mm (P-AXIS-00351).
    pub filter_window_mm: f64,
}

impl Machine {
    /// The chains of the path axes, then of the spindles, then of the gantry slaves (the order of
    /// [`all_axes`](Self::all_axes)), and their diagnostics.
    ///
    /// A gantry slave has its own standard filters and controller; FIR filter, HSC filter and Vibration Guard are those
    /// of its master ([`shaped_as`](Self::shaped_as)), and so is Improved Position Control. All chains get the longest
    /// delay that any axis needs, so that they stay synchronous; spindles too, because threads couple them to the path.
    ///
    /// Diagnostics, always with axis and parameter: 110239, 110500, 110501, 50663 (spindles 60311), 50910, 50911,
    /// 50989, 110361, K-0033, K-0036 to K-0041 (filters); 50820 (Vibration Guard of the list); 70350, 70351, K-0023,
    /// K-0024, K-0062, K-0064, K-0065 (feedforward); 70600, 70603, 70604, K-0025 to K-0027, K-0063, K-0066 (Improved
    /// Position Control); K-0070 (meaningless numbers); K-0075 (kernels in the list of a gantry slave, feedforward
    /// without delay together with an axis with delay).
    pub fn chains(&self) -> (Vec<ChainSetup>, Vec<Diagnostic>) {
        let mut diagnostics = Vec::new();
        let mut chains: Vec<ChainSetup> =
            self.all_axes().map(|axis| self.chain(axis, &mut diagnostics)).collect();
        let delay = channel_delay_cycles(chains.iter().map(|chain| &chain.control.feedforward));
        self.shared_delay(&chains, delay, &mut diagnostics);
        for chain in &mut chains {
            chain.control.delay_cycles = delay;
        }
        (chains, diagnostics)
    }

    /// Reports axes that are configured without the long buffer but get it because of another axis.
    fn shared_delay(&self, chains: &[ChainSetup], delay: usize, diagnostics: &mut Vec<Diagnostic>) {
        let own = |chain: &ChainSetup| chain.control.feedforward.delay_cycles();
        let axes = || self.all_axes().zip(chains);
        let Some((longest, _)) = axes().find(|(_, chain)| own(chain) == delay) else { return };
        let param = axis_drive::FF_WITHOUT_DELAY;
        for (axis, _) in axes().filter(|(a, chain)| a.get(param) && own(chain) < delay) {
            let effect = format!(
                "no effect: {} requires a buffer of {delay} cycles, and all axes of a channel use the longest buffer",
                longest.name()
            );
            let what = "feedforward without delay";
            let about = issues::about(axis, Condition::ListNoEffect, param, what, &effect);
            let hint = "set it for every axis and spindle with feedforward (P-AXIS-00223)";
            diagnostics.push(about.hint(hint));
        }
    }

    /// Diagnostics of the chain of an axis, without the kernels, which depend on the settings of the program.
    pub(crate) fn chain_issues(&self, axis: usize) -> Vec<Diagnostic> {
        let mut diagnostics = Vec::new();
        let axis = &self.axes[axis];
        filters::check_fir_kind(axis, &mut diagnostics);
        self.unshaped(axis, &mut diagnostics);
        diagnostics
    }

    fn chain(&self, axis: &Axis, diagnostics: &mut Vec<Diagnostic>) -> ChainSetup {
        match self.master_of(axis) {
            Some(master) => {
                filters::check_slave(axis, &self.axes[master], self.cycle, diagnostics);
            }
            None => filters::check_kernels(axis, self.cycle, diagnostics),
        }
        self.unshaped(axis, diagnostics)
    }

    /// The chain, without checking the kernels.
    fn unshaped(&self, axis: &Axis, diagnostics: &mut Vec<Diagnostic>) -> ChainSetup {
        let cascade = filters::cascade(axis, self.cycle, diagnostics);
        let mut config = control::config(axis, diagnostics);
        config.ipc = self.ipc(axis, diagnostics);
        let (control, found) = config.checked(self.cycle);
        // a denominator of 0 was reported on loading, whether or not torque is output
        let new = |issue: &&Issue| !matches!(issue, Issue::TorqueScaleDenominatorZero);
        diagnostics
            .extend(found.iter().filter(new).map(|issue| issues::control(axis, issue, self.cycle)));
        ChainSetup {
            filters: cascade.filters,
            additional: filters::additional(axis, self.cycle, diagnostics),
            control,
            filter_window_mm: axis.filter_window_mm(),
        }
    }

    /// Improved Position Control of an axis; for a gantry slave that of its master, off if there is none.
    fn ipc(&self, axis: &Axis, diagnostics: &mut Vec<Diagnostic>) -> IpcConfig {
        let mut own = ipc::config(axis);
        if own.enable {
            let found = ipc::out_of_range(axis, self.cycle);
            own.enable = found.is_empty();
            diagnostics.extend(found);
        }
        let Some(master) = axis.gantry_master() else { return own };
        if own.enable {
            diagnostics.push(issues::control(axis, &Issue::IpcGantrySlave, self.cycle));
        }
        let master = self.all_axes().find(|other| other.number() == master);
        master.map(ipc::config).unwrap_or_default()
    }
}

impl Axis {
    /// The kernel slot as configured by the list: FIR filter, HSC filter and Vibration Guard.
    ///
    /// [`Machine::chains`] reports its errors.
    pub fn kernel_preset(&self, cycle: CycleTime) -> KernelPreset {
        filters::preset(self, cycle)
    }

    /// Time in s by which the actual position lags the set position at a constant speed in mm/s, with feedforward in
    /// this state of G135 and G136: the part of the speed that is not fed forward, divided by the gain kv.
    pub(crate) fn lag_s(&self, speed_mm_s: f64, feedforward_on: bool, weight_ratio: f64) -> f64 {
        let config = control::config(self, &mut Vec::new());
        let fed = config.feedforward.velocity_share(feedforward_on, weight_ratio);
        (1.0 - fed) / config.position.gain_at(speed_mm_s)
    }

    /// Whether the lists of two axes switch the same standard filters on.
    pub(crate) fn has_standard_filters_of(&self, other: &Self, cycle: CycleTime) -> bool {
        let [own, others] =
            [self, other].map(|axis| filters::cascade(axis, cycle, &mut Vec::new()).filters);
        own == others
    }

    /// Mean delay of the standard filters that the list switches on, in cycles.
    pub(crate) fn standard_filter_delay_cycles(&self, cycle: CycleTime) -> f64 {
        let cascade = filters::cascade(self, cycle, &mut Vec::new());
        cascade.filters.iter().map(Stage::delay_cycles).sum()
    }
}
