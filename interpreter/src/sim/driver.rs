//! Where the setpoints of a chain come from.

use crate::exec::ShapingSetup;
use crate::machine::{Axis, Machine};
use kontur_filters::kernel::Kernel;
use std::sync::Arc;

/// Source of the setpoint of a chain.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Driver {
    /// Path axis; gantry slaves follow the path axis that is their master.
    Path(usize),
    Spindle(usize),
    /// A gantry slave whose master is not in the channel.
    Standing,
}

impl Driver {
    /// The kernel of a chain with this driver.
    pub(super) fn kernel(self, setup: &ShapingSetup) -> Option<&Arc<Kernel>> {
        let shaping = match self {
            Self::Path(p) => setup.axes.get(p),
            Self::Spindle(s) => setup.spindles.get(s),
            Self::Standing => None,
        };
        shaping.and_then(|shaping| shaping.kernel.as_ref())
    }
}

/// The driver of every chain, in the order of [`Machine::all_axes`].
pub(super) fn drivers(machine: &Machine) -> Vec<Driver> {
    let slave = |axis: &Axis| machine.master_of(axis).map_or(Driver::Standing, Driver::Path);
    let slaves = machine.gantry_slaves.iter().map(slave);
    let paths = (0..machine.axes.len()).map(Driver::Path);
    let spindles = (0..machine.spindles.len()).map(Driver::Spindle);
    paths.chain(spindles).chain(slaves).collect()
}
