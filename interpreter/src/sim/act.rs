//! Effects of the events of a block on the running machine: kernels, feedforward, machine data.

use super::chain::AxisChain;
use super::chains::Chains;
use super::driver::Driver;
use super::messages::MESSAGES_MAX;
use super::state::Simulation;
use crate::diag::{Condition, Diagnostic};
use crate::exec::{Event, ShapingSetup, TimerCall};
use crate::machine::{Axis, ChainSetup, Machine};
use kontur_filters::control::AxisControlConfig;
use kontur_motion::profile::Infeasible;
use kontur_motion::tolerance::Kernels;
use std::sync::Arc;

/// Jumps of a speed command in mm/s (deg/s) up to this value are those of filters at the end of their motion.
const LEAST_JUMP_MM_S: f64 = 1e-3;

impl Simulation {
    /// Executes an event in cycle `k`.
    pub(super) fn act(&mut self, event: Event, k: u64) {
        match event {
            Event::Independent { axis, motion } => {
                let dynamics = self.machine.axes[axis].dynamics();
                let started = self.independent.start(axis, k, motion, &dynamics, self.cycle);
                self.check_started(started);
            }
            Event::Oscillation { axis, motion } => {
                let dynamics = self.machine.axes[axis].dynamics();
                let started = self.independent.oscillate(axis, k, &motion, &dynamics, self.cycle);
                self.check_started(started);
            }
            Event::Couple { slave, master, ratio, master_mm } => {
                self.independent.couple(slave, master, ratio, master_mm);
                self.totals.followers.insert(slave);
            }
            Event::Uncouple { slave } => self.independent.uncouple(slave),
            Event::Wear(setting) => {
                self.wear.set(setting, self.path_axes());
                self.take_wear(k);
            }
            Event::Banding(run) => self.begin_banding(run),
            Event::Engaged(engaged) => self.wear.engage(engaged),
            Event::Feedforward { on, weight_ratios } => self.feedforward(on, &weight_ratios),
            Event::SpindleFeedforward { spindle, on, weight_ratio } => {
                self.chains.spindle_feedforward(spindle, on, weight_ratio);
            }
            Event::SoftwareLimits { axis, limits_mm } => self.limit_axis(axis, limits_mm),
            Event::Timer { id, act } => {
                let time_s = self.cycle.time_of(k);
                self.program.timer(TimerCall { id, act, time_s });
            }
            Event::Spindle { spindle, .. }
            | Event::SpindleFollows { spindle, .. }
            | Event::CuttingSpeed { spindle, .. }
            | Event::SpindleAcceleration { spindle, .. }
            | Event::SpindleDynamics { spindle, .. }
            | Event::SpindleLimits { spindle, .. } => self.act_on_spindle(spindle, event),
            other => self.note(other),
        }
    }

    fn check_started(&mut self, started: Result<(), Infeasible>) {
        if let Err(e) = started {
            self.messages.own.push(super::fault::internal(&format!("look-ahead: {e}")));
        }
    }

    fn act_on_spindle(&mut self, spindle: usize, event: Event) {
        let Some(spindle) = self.spindles.get_mut(spindle) else { return };
        match event {
            Event::Spindle { motion, .. } => {
                spindle.command(motion);
                spindle.cut(&self.path_position);
            }
            Event::SpindleFollows { way, .. } => spindle.follow(way, &self.path_position),
            Event::CuttingSpeed { cutting, .. } => {
                spindle.keep_cutting_speed(cutting);
                spindle.cut(&self.path_position);
            }
            Event::SpindleAcceleration { ratio, .. } => spindle.weigh_acceleration(ratio),
            Event::SpindleDynamics { dynamics, .. } => spindle.set_dynamics(&dynamics),
            Event::SpindleLimits { limits, .. } => spindle.limit(limits),
            _ => {}
        }
    }

    /// Counts an event that moves nothing, or outputs its message.
    fn note(&mut self, event: Event) {
        let block = match &event {
            Event::Message { source, .. } => Some(*source),
            _ => None,
        };
        let time_s = self.cycle.time_of(self.planner.setpoint().k);
        let Some(mut message) = self.totals.note(event, time_s) else { return };
        if self.messages.own.len() >= MESSAGES_MAX {
            self.messages.unshown += 1;
            return;
        }
        message.source = block.and_then(|block| self.program.locate(block));
        self.messages.own.push(message);
    }

    /// Applies the external wear; K-0138 if it exceeds what the tool permits.
    pub(super) fn take_wear(&mut self, k: u64) {
        let wear_mm = self.inputs.wear_mm;
        if self.wear.take_outside(wear_mm) && self.inputs.reports_wear_limit() {
            let text = format!("wear_mm {wear_mm} exceeds the limit of the tool, limited");
            let mut d = Diagnostic::new(Condition::WearLimited, text);
            (d.cycle, d.time_s) = (Some(k), Some(self.cycle.time_of(k)));
            self.messages.own.push(d);
        }
    }

    pub(super) fn feedforward(&mut self, on: bool, weights: &[f64]) {
        let mut largest: Option<(usize, f64)> = None;
        let Chains { all, drivers, gains, .. } = &mut self.chains;
        for (i, chain) in all.iter().enumerate() {
            if let Driver::Path(p) = drivers[i] {
                let weight = weights.get(p).copied().unwrap_or(1.0);
                let gain = chain.feedforward_gain(on, weight);
                let step = std::mem::replace(&mut gains[i], gain) - gain;
                // the record is that of the previous cycle, whose speed may come from a last step
                let jump = |(i, step): (usize, f64)| (step * self.record.axes[i].vel).abs();
                let moves = self.record.path.v_mm_s > 0.0
                    || self.independent.is_moving(p)
                    || !chain.settled();
                if moves && jump((i, step)) > largest.map_or(LEAST_JUMP_MM_S, jump) {
                    largest = Some((i, step));
                }
            }
        }
        if let Some((chain, step)) = largest {
            self.switched_while_moving(chain, step);
        }
    }

    /// Replaces the kernels of the path axes and their gantry slaves, which must be flushed. Those of spindles never
    /// change.
    pub(super) fn swap_kernels(&mut self, setup: &ShapingSetup) {
        for i in 0..self.chains.len() {
            if !matches!(self.chains.drivers[i], Driver::Spindle(_)) {
                self.set_kernel(i, setup);
            }
        }
        let kernels = Kernels::new(setup.axes.iter().map(|a| a.kernel.clone()).collect());
        let path = &self.chains.all[..self.path_axes()];
        let reach = path.iter().map(AxisChain::reach_cycles).max().unwrap_or(0);
        self.planner.set_kernels(kernels, reach);
        self.totals.shaped(setup);
        for (delay, chain) in self.totals.filter_delay_cycles.iter_mut().zip(&self.chains.all) {
            *delay = delay.max(chain.delay_cycles());
        }
    }

    /// Sets the kernel of a setup in a chain at rest.
    pub(super) fn set_kernel(&mut self, i: usize, setup: &ShapingSetup) {
        if !self.chains.set_kernel(i, setup) {
            self.messages.own.push(super::fault::switch_while_moving());
        }
    }

    /// `#MACHINE DATA`: replaces the chains whose configuration has changed. There may be more than that of the axis:
    /// feedforward of one axis delays all of them, and gantry slaves take parameters from their master.
    pub(super) fn machine_data(&mut self) {
        let known = std::mem::replace(&mut self.machine, Arc::clone(self.program.machine()));
        let ((before, _), (setups, _)) = (known.chains(), self.machine.chains());
        for (i, (old, new)) in before.iter().zip(setups).enumerate() {
            if *old != new {
                let gear = |machine: &Machine| machine.all_axes().nth(i).map(Axis::gear);
                let shifted = gear(&known) != gear(&self.machine);
                self.replace(i, old, &new, shifted);
            }
        }
        let setup = self.program.shaping().clone();
        self.swap_kernels(&setup);
    }

    /// Replaces the chain of an axis, at the position of the axis and with the active kernel; `shifted`: to another gear
    /// stage.
    fn replace(&mut self, i: usize, old: &ChainSetup, new: &ChainSetup, shifted: bool) {
        let before = &self.chains.all[i];
        match AxisChain::new(new.clone(), before.set_mm(), self.inputs.axes[i], self.cycle) {
            Ok(mut chain) => {
                chain.take_over(before, old, new);
                self.chains.all[i] = chain;
                // a gear stage changes in position, or at the standstill of a spindle
                if !shifted {
                    self.control_changed(i, &old.control, &new.control);
                }
            }
            Err(e) => self.messages.own.push(super::fault::plant(&e, &self.machine, i)),
        }
    }

    /// K-0022 if gains change while the axis is still on its way to its set position.
    fn control_changed(&mut self, i: usize, old: &AxisControlConfig, new: &AxisControlConfig) {
        let axis = &self.record.axes[i];
        let kv = |config: &AxisControlConfig| config.position.gain_at(axis.vel.abs());
        let of_gain = (kv(new) - kv(old)) * axis.lag;
        let of_feedforward = if old.feedforward == new.feedforward { 0.0 } else { axis.ff };
        let of_ipc = if old.ipc == new.ipc { 0.0 } else { axis.vadd };
        if [of_gain, of_feedforward, of_ipc].iter().any(|jump| jump.abs() > LEAST_JUMP_MM_S) {
            self.changed_while_lagging(i);
        }
    }

    /// Monitors the actual positions of an axis with other software limits.
    ///
    /// Assumption: limits of the program hold for the gantry slaves of the axis as well, whose set positions are the same.
    fn limit_axis(&mut self, axis: usize, limits_mm: Option<(f64, f64)>) {
        let listed = self.machine.axes[axis].software_limits_mm() == limits_mm;
        let sides = self.machine.all_axes().zip(self.chains.driven()).enumerate();
        for (i, (side, (chain, driver))) in sides {
            if driver == Driver::Path(axis) {
                let own = listed && i != axis;
                let limits_mm = if own { side.software_limits_mm() } else { limits_mm };
                chain.limit_range(limits_mm.map(|limits_mm| side.actual_range_mm(limits_mm)));
            }
        }
    }

    /// Gives the axis and its gantry slaves new set positions. Those of the path do not change.
    pub(super) fn set_position(&mut self, axis: usize, offset_mm: f64, moves: bool) {
        self.chains.of_axis(axis).for_each(|chain| chain.shift(offset_mm, moves));
        self.independent.shift(axis, offset_mm);
        self.path_position[axis] += offset_mm;
    }
}
