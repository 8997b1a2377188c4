//! The machine: parameter lists in the vendor's format, their ranges, and the values that the simulation derives from
//! them.
//!
//! Lists hold integers in 0.1 um, us and 0.1 %; they are converted to mm, s and ratios in this module only.
//!
//! Order of calls: read the lists, apply the settings of the caller, and pass the resulting [`Machine`] to a
//! [`Job`](crate::job::Job).
//!
//! ```
//! use kontur_interpreter::machine::{Machine, Override};
//!
//! let soft = Override::parse("X.getriebe[0].kv=2000").unwrap();
//! let (machine, warnings) = Machine::builtin(&[soft]).unwrap();
//! assert_eq!((machine.axis("x").unwrap().number(), warnings.len()), (1, 0));
//! // vendor units stay outside: P-AXIS-00099 is in 0.01/s
//! assert_eq!(machine.chains().0[0].control.position.kv_per_s, 20.0);
//! ```

mod axis;
mod builtin;
mod chain;
mod channel;
mod external;
mod gears;
mod hints;
mod inert;
pub(crate) mod issues;
pub mod key;
mod kind;
mod levers;
mod link;
pub mod lists;
mod overrides;
mod parameters;
mod plausible;
pub mod project;
mod settled;
mod setup;
pub mod table;
mod tools;
mod transmission;
pub mod value;

pub use axis::Axis;
pub use channel::Channel;
pub(crate) use channel::DiagnosisMessages;
pub(crate) use channel::couplings::{DefaultCoupling, PAIRS_MAX};
pub(crate) use channel::functions::{Acknowledged, SpindleMoment, SpindleWaits};
pub(crate) use channel::path::ArcCentre;
pub(crate) use channel::running::RapidOverride;
pub(crate) use external::{ExternalKind, ExternalVariables};
pub(crate) use inert::instead_of;
pub use issues::filter_condition;
pub(crate) use issues::leaves_out;
pub use kind::AxisKind;
pub use levers::Lever;
pub use lists::ListFiles;
pub use overrides::Override;
pub use parameters::{Parameters, Setting};
pub use setup::{AdditionalInterface, ChainSetup, FirPreset, KernelPreset, VibGuardPreset};
pub(crate) use tools::INCH_MM;
pub(crate) use tools::{SpindleLimits, Tool, ToolKind, ZeroOffsets};

use kontur_filters::control::monitor::ExactStopConfig;
use kontur_filters::time::CycleTime;
use std::collections::BTreeMap;

/// A machine: one channel with its axes and spindles.
#[derive(Clone, Debug, PartialEq)]
pub struct Machine {
    /// Name of the folder of its lists.
    pub name: String,
    /// Cycle of the interpolator (`kontur.cycle_time_us`).
    pub cycle: CycleTime,
    /// Path axes in the order of the channel list.
    pub axes: Vec<Axis>,
    /// Spindles in the order of the channel list.
    pub spindles: Vec<Axis>,
    /// Gantry slaves: axis lists that no channel names and that name a master (P-AXIS-00070).
    pub(crate) gantry_slaves: Vec<Axis>,
    /// Channel.
    pub channel: Channel,
    /// Tools by the number of the D word (P-STUP-00010).
    pub(crate) tools: BTreeMap<u32, Tool>,
    /// Zero offsets (P-STUP-00011).
    pub(crate) zero_offsets: ZeroOffsets,
    /// External variables (P-STUP-00146).
    pub(crate) external: ExternalVariables,
}

/// Whether a position in mm (deg) is outside software limits. A position closer to a limit than half of the increment in
/// which both are given counts as being at it, for instance after a thousand incremental steps.
#[inline]
pub(crate) fn is_outside(position_mm: f64, (least_mm, most_mm): (f64, f64)) -> bool {
    const HALF_INCREMENT_MM: f64 = ExactStopConfig::HALF_INCREMENT_MM;
    !(least_mm - HALF_INCREMENT_MM..=most_mm + HALF_INCREMENT_MM).contains(&position_mm)
}

impl Machine {
    /// Axis, spindle or gantry slave with a name of the channel list, without regard to case.
    pub fn axis(&self, name: &str) -> Option<&Axis> {
        self.all_axes().find(|a| a.name().eq_ignore_ascii_case(name))
    }

    /// The software limits of a path axis in mm, if a position in mm is outside them and that is an error
    /// (P-AXIS-00177, P-AXIS-00178).
    pub fn limits_without(&self, axis: usize, mm: f64) -> Option<(f64, f64)> {
        let limits = self.axes.get(axis)?.software_limits_mm()?;
        let outside = is_outside(mm, limits) && !self.limits_only_warn(axis);
        outside.then_some(limits)
    }

    /// Whether a position of a path axis outside its software limits is only a warning.
    pub(crate) fn limits_only_warn(&self, axis: usize) -> bool {
        let masked = self.channel.limit_warnings.checked_shr(axis as u32).unwrap_or(0) & 1 == 1;
        masked || self.axes[axis].software_limits_only_warn()
    }

    /// Index of the path axis that is the master of a gantry slave; `None` for other axes.
    pub(crate) fn master_of(&self, axis: &Axis) -> Option<usize> {
        let number = axis.gantry_master()?;
        self.axes.iter().position(|a| a.number() == number)
    }

    /// The axis whose list configures the kernel slot of an axis (FIR filter, HSC filter, Vibration Guard): the master
    /// of a gantry slave, otherwise the axis itself.
    ///
    /// Source: `#VIB GUARD` and `#FILTER` act on the axes of the channel, and a slave takes the set positions of its master.
    pub fn shaped_as<'a>(&'a self, axis: &'a Axis) -> &'a Axis {
        self.master_of(axis).map_or(axis, |master| &self.axes[master])
    }

    /// Path axes, spindles, gantry slaves.
    pub fn all_axes(&self) -> impl Iterator<Item = &Axis> {
        self.axes.iter().chain(&self.spindles).chain(&self.gantry_slaves)
    }
}

#[cfg(test)]
mod tests;
