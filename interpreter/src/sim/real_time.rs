//! Effects of the inputs of a run on the path and on all independent motions: override, feedhold, and a hold without
//! end.

use super::fault;
use super::inputs::SpeedChange;
use super::state::{Phase, Probing, Simulation};
use crate::diag::Diagnostic;
use kontur_motion::independent::Steering;
use kontur_motion::realtime::FeedholdBraking;

impl Simulation {
    /// Applies the inputs that are due in cycle `k`: to the axes at once, to the path after the cycle.
    pub(super) fn take_inputs(&mut self, k: u64) {
        let time_s = self.cycle.time_of(k);
        match self.inputs.take_due(time_s, &self.machine, &mut self.messages.own) {
            Ok(false) => return,
            Ok(true) => {}
            Err(failure) => self.input_fails(*failure),
        }
        for (chain, inputs) in self.chains.all.iter_mut().zip(&self.inputs.axes) {
            chain.set_inputs(*inputs);
        }
        self.steer_independent();
        self.take_wear(k);
        let channel = &self.machine.channel;
        self.planner.set_override(self.inputs.ratios(channel.overrides.rapid));
        self.hold_path();
    }

    /// Brakes the path because of feedhold or the probe signal, or lets it continue.
    pub(super) fn hold_path(&mut self) {
        let channel = &self.machine.channel;
        let probed = self.probing.as_ref().is_some_and(Probing::holds);
        let braking = if probed && channel.measuring.brakes_as_rapid {
            FeedholdBraking::Rapid
        } else if channel.overrides.own_feed_hold {
            FeedholdBraking::Own
        } else {
            FeedholdBraking::Active
        };
        self.planner.feedhold(self.inputs.feedhold || probed, braking);
    }

    /// K-0132, for each thread once for a feedhold and once for an override: the path does not follow the spindle.
    pub(super) fn watch_thread(&mut self) {
        let Some(thread) = &mut self.thread else { return };
        let Some(why) = self.inputs.changes_speed(thread.full_override) else { return };
        let told = match why {
            SpeedChange::Feedhold => &mut thread.held,
            SpeedChange::Override(_) => &mut thread.scaled,
        };
        if matches!(self.phase, Phase::Running) && !std::mem::replace(told, true) {
            let at = self.blocks.current;
            let mut d = fault::thread_broken(why, self.planner.setpoint().k, self.cycle);
            d.source = self.program.locate(at);
            self.messages.own.push(d);
        }
    }

    pub(super) fn input_fails(&mut self, failure: Diagnostic) {
        self.messages.own.push(failure);
        (self.totals.aborted, self.totals.input_failed) = (true, true);
        self.phase = Phase::Done;
    }

    /// Notes whether feedhold or override 0 keeps the path at rest in this cycle; a permanent hold ends the run.
    pub(super) fn look_for_hold(&mut self) {
        self.is_held = false;
        let setpoint = self.planner.setpoint();
        let at_rest = setpoint.s_mm.to_bits() == self.record.path.s_mm.to_bits();
        if !at_rest || !self.planner.is_held() {
            return;
        }
        if self.drop_rest_of_run() {
            return;
        }
        self.is_held = true;
        if self.inputs.is_over() {
            self.held_for_ever();
        }
    }

    /// K-0083: the path can never be released.
    pub(super) fn held_for_ever(&mut self) {
        let k = self.planner.setpoint().k;
        self.messages.own.push(fault::held(k, self.cycle, self.inputs.feedhold));
        self.totals.aborted = true;
        self.phase = Phase::Done;
    }

    /// Passes override and feedhold to the axes that move, or will move, independently of the path.
    fn steer_independent(&mut self) {
        let channel = &self.machine.channel;
        let ratios = self.inputs.ratios(channel.overrides.rapid);
        for (p, axis) in self.machine.axes.iter().enumerate() {
            let ratios = axis.independent_ratios(ratios);
            let held = self.inputs.feedhold && axis.holds_independent();
            let steering = Steering { ratios, mode: channel.overrides.mode, held };
            self.independent.steer(p, steering);
        }
    }
}
