//! The limits of the path: weights of the program, feed group and vector limits, and the dynamics that follow from them.

use super::coupling::Couplings;
use crate::exec::block::modal::Modal;
use crate::exec::motion::dynamics::{Cut, Weights, channel_dynamics};
use crate::exec::motion::weight::Weight;
use crate::machine::Machine;
use kontur_motion::axis::AxisDynamics;
use kontur_motion::block::{ChannelDynamics, VectorLimits};
use std::sync::Arc;

/// What else limits the axes of the path: slaves, and manual mode.
#[derive(Clone, Copy)]
pub(super) struct Beside<'a> {
    pub(super) couplings: &'a Couplings,
    /// Axes in manual mode (G201).
    pub(super) manual: &'a [bool],
}

/// See the module; every change rebuilds the dynamics.
#[derive(Debug)]
pub(in crate::exec) struct PathLimits {
    weights: Weights,
    /// Members of the feed group (`#FGROUP`).
    feed_axes: Vec<bool>,
    /// Whether they were set by `#FGROUP [..]`.
    feed_axes_named: bool,
    /// Active `#VECTOR LIMIT` in feed and in rapid blocks.
    vector: [VectorLimits; 2],
    /// Main axes of coordinate systems, whose longest ramp time applies (P-CHAN-00758).
    longest_ramps_of: [Option<usize>; 3],
    /// Dynamics in feed and in rapid blocks; reused while the limits do not change.
    dynamics: [Option<Arc<ChannelDynamics>>; 2],
}

impl PathLimits {
    /// Those of the channel list, without weights.
    pub(super) fn new(machine: &Machine) -> Self {
        Self {
            weights: Weights::new(machine.axes.len()),
            feed_axes: machine.channel.feed.axes.clone(),
            feed_axes_named: false,
            vector: [VectorLimits::default(); 2],
            longest_ramps_of: [None; 3],
            dynamics: [None, None],
        }
    }

    /// Called after a change of anything else that determines the dynamics.
    pub(in crate::exec) fn changed(&mut self) {
        self.dynamics = [None, None];
    }

    /// Members of the feed group.
    pub(in crate::exec) fn feed_axes(&self) -> &[bool] {
        &self.feed_axes
    }

    /// Whether `#FGROUP [..]` set them.
    pub(in crate::exec) fn feed_axes_named(&self) -> bool {
        self.feed_axes_named
    }

    /// Replaces the feed group; `named`: by `#FGROUP [..]`.
    pub(in crate::exec) fn set_feed_axes(&mut self, axes: Vec<bool>, named: bool) {
        (self.feed_axes, self.feed_axes_named) = (axes, named);
        self.changed();
    }

    /// Sets a weight, 1.0 = 100 %, of an axis or of all.
    pub(in crate::exec) fn set_weight(&mut self, what: Weight, axis: Option<usize>, ratio: f64) {
        self.weights.set(what, axis, ratio);
        self.changed();
    }

    /// Changes the vector limits of feed blocks, of rapid blocks, or of both.
    pub(in crate::exec) fn change_vector(
        &mut self,
        meant: [bool; 2],
        change: impl Fn(&mut VectorLimits),
    ) {
        for (vector, _) in self.vector.iter_mut().zip(meant).filter(|(_, meant)| *meant) {
            change(vector);
        }
        self.changed();
    }

    /// The longest ramp time of these axes applies.
    pub(in crate::exec) fn use_longest_ramps_of(&mut self, axes: [Option<usize>; 3]) {
        if self.longest_ramps_of != axes {
            self.longest_ramps_of = axes;
            self.changed();
        }
    }

    /// Active dynamics in feed or rapid blocks; rebuilt after a change.
    pub(super) fn dynamics(
        &mut self,
        machine: &Machine,
        modal: &Modal,
        beside: Beside<'_>,
        rapid: bool,
    ) -> Arc<ChannelDynamics> {
        let mode = usize::from(rapid && self.vector[0] != self.vector[1]);
        if let Some(dynamics) = &self.dynamics[mode] {
            return Arc::clone(dynamics);
        }
        let dynamics = self.build(machine, modal, beside, &self.weights, self.vector[mode]);
        let dynamics = Arc::new(dynamics);
        self.dynamics[mode] = Some(Arc::clone(&dynamics));
        dynamics
    }

    /// Dynamics of a measuring run: those of rapid blocks, without weights of accelerations and ramp times.
    pub(super) fn measuring(
        &self,
        machine: &Machine,
        modal: &Modal,
        beside: Beside<'_>,
    ) -> ChannelDynamics {
        let weights = self.weights.of_velocities();
        let mut dynamics = self.build(machine, modal, beside, &weights, self.vector[0]);
        dynamics.axes.iter_mut().for_each(AxisDynamics::use_rapid);
        dynamics
    }

    fn build(
        &self,
        machine: &Machine,
        modal: &Modal,
        Beside { couplings, manual }: Beside<'_>,
        weights: &Weights,
        vector: VectorLimits,
    ) -> ChannelDynamics {
        let (mut dynamics, _) = channel_dynamics(machine, weights, modal, vector);
        dynamics.feed_axes.clone_from(&self.feed_axes);
        dynamics.longest_ramps_of = self.longest_ramps_of;
        let axes = machine.axes.iter().zip(&mut dynamics.axes).zip(manual);
        for ((axis, limits), _) in axes.filter(|(_, manual)| **manual) {
            axis.limit_beside_manual_mode(limits);
        }
        couplings.limit(&mut dynamics.axes);
        dynamics
    }

    /// Axes whose limits differ from those that their weights request, and why.
    pub(in crate::exec) fn cuts(&self, machine: &Machine, modal: &Modal) -> Vec<(usize, Cut)> {
        channel_dynamics(machine, &self.weights, modal, self.vector[0]).1
    }
}
