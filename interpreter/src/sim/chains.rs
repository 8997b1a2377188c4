//! The chains of all axes, with what drives each of them.

use super::chain::AxisChain;
use super::driver::{Driver, drivers};
use super::fault;
use crate::diag::{Diagnostic, Reaction};
use crate::exec::ShapingSetup;
use crate::machine::{ChainSetup, Machine};
use kontur_filters::control::axis_control::AxisInputs;

/// Path axes, spindles, gantry slaves, in the order of [`Machine::all_axes`].
#[derive(Debug)]
pub(in crate::sim) struct Chains {
    pub(in crate::sim) all: Vec<AxisChain>,
    pub(in crate::sim) drivers: Vec<Driver>,
    /// Feedforward gain of every chain.
    pub(in crate::sim) gains: Vec<f64>,
    /// Position in mm or deg at which a fault has stopped each axis.
    frozen: Vec<Option<f64>>,
}

impl Chains {
    /// The chain of every axis, at the position where its driver starts.
    ///
    /// # Errors
    /// A diagnostic, if the plant of an axis is not physical.
    pub(super) fn new(
        start: &[f64],
        setups: Vec<ChainSetup>,
        machine: &Machine,
    ) -> Result<Self, Vec<Diagnostic>> {
        let drivers = drivers(machine);
        let chain = |(i, setup): (usize, _)| {
            let x = match drivers.get(i) {
                Some(Driver::Path(p)) => start.get(*p).copied().unwrap_or(0.0),
                _ => 0.0,
            };
            let chain = AxisChain::new(setup, x, AxisInputs::default(), machine.cycle);
            chain.map_err(|e| vec![fault::plant(&e, machine, i)])
        };
        let all: Vec<AxisChain> =
            setups.into_iter().enumerate().map(chain).collect::<Result<_, _>>()?;
        let (gains, frozen) = (vec![0.0; all.len()], vec![None; all.len()]);
        Ok(Self { all, drivers, gains, frozen })
    }

    /// Number of chains.
    pub(super) fn len(&self) -> usize {
        self.all.len()
    }

    /// The chains with their drivers.
    pub(super) fn driven(&mut self) -> impl Iterator<Item = (&mut AxisChain, Driver)> {
        self.all.iter_mut().zip(self.drivers.iter().copied())
    }

    /// A path axis and its gantry slaves.
    pub(super) fn of_axis(&mut self, axis: usize) -> impl Iterator<Item = &mut AxisChain> {
        self.driven().filter(move |(_, d)| *d == Driver::Path(axis)).map(|(chain, _)| chain)
    }

    /// Index of the chain of a spindle.
    pub(super) fn of_spindle(&self, spindle: usize) -> Option<usize> {
        self.drivers.iter().position(|driver| *driver == Driver::Spindle(spindle))
    }

    /// Position at which a fault has stopped an axis.
    pub(super) fn frozen(&self, i: usize) -> Option<f64> {
        self.frozen[i]
    }

    /// Whether no axis stands or is stopped by a fault, and none moves on its own.
    pub(super) fn run_freely(&self) -> bool {
        let runs = |(chain, driver): (&AxisChain, &Driver)| {
            !chain.goes_alone() && *driver != Driver::Standing
        };
        self.frozen.iter().all(Option::is_none) && self.all.iter().zip(&self.drivers).all(runs)
    }

    /// Switches the feedforward of a spindle.
    pub(super) fn spindle_feedforward(&mut self, spindle: usize, on: bool, weight: f64) {
        if let Some(i) = self.of_spindle(spindle) {
            self.gains[i] = self.all[i].feedforward_gain(on, weight);
        }
    }

    /// The chains that a reaction stops with one of them: both sides of a gantry bridge stop alike.
    pub(super) fn stopped_with(&self, chain: usize, reaction: Reaction) -> Vec<usize> {
        let driver = self.drivers[chain];
        let together = |i: &usize| {
            *i == chain || matches!(driver, Driver::Path(_)) && self.drivers[*i] == driver
        };
        match reaction {
            Reaction::AbruptStop | Reaction::OpenLoopStop => {
                (0..self.len()).filter(together).collect()
            }
            Reaction::AllStop => (0..self.len()).collect(),
            // the path brakes; there is no other reaction of the axis
            Reaction::None
            | Reaction::ProgramAbort
            | Reaction::JobAbort
            | Reaction::FeedHold
            | Reaction::ControlledStop => Vec::new(),
        }
    }

    /// Stops an axis at a position, unless it is stopped.
    pub(super) fn freeze(&mut self, i: usize, here: f64, reaction: Reaction) {
        self.frozen[i].get_or_insert(here);
        match reaction {
            Reaction::OpenLoopStop => self.all[i].open_loop(),
            Reaction::AbruptStop => self.all[i].halt(),
            Reaction::None
            | Reaction::ProgramAbort
            | Reaction::JobAbort
            | Reaction::FeedHold
            | Reaction::ControlledStop
            | Reaction::AllStop => {}
        }
    }

    /// Sets the kernel of a setup in a chain at rest; whether it was at rest.
    pub(super) fn set_kernel(&mut self, i: usize, setup: &ShapingSetup) -> bool {
        let kernel = self.drivers[i].kernel(setup).cloned();
        self.all[i].set_kernel(kernel).is_ok()
    }
}
