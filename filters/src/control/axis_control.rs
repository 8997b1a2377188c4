//! One axis downstream of its set position: the parts in their fixed order, once per cycle.
//!
//! 1. Actual values of the cycle start.
//! 2. Setpoint out of the buffer.
//! 3. Feedforward.
//! 4. Position controller.
//! 5. Improved Position Control.
//! 6. Speed limit.
//! 7. Monitors.
//! 8. The plant advances by one cycle.
//!
//! Configured once, started at a position, then one [`AxisControl::step`] per cycle:
//!
//! ```
//! use kontur_filters::control::axis_control::{AxisControl, AxisControlConfig, AxisInputs};
//! use kontur_filters::time::CycleTime;
//!
//! let (config, _) = AxisControlConfig::new(1000.0, 5000.0, 1e6).checked(CycleTime::DEFAULT);
//! let mut axis = AxisControl::new(config, CycleTime::DEFAULT).unwrap();
//! axis.start(0.0);
//! // 10 mm/s, until the lag of a proportional controller has settled
//! let seen = (1..3000).map(|k| axis.step(0.01 * f64::from(k), 0.0, true)).last().unwrap();
//! let kv_per_s = axis.config().position.kv_per_s;
//! assert!((seen.lag_mm - 10.0 / kv_per_s).abs() < 1e-3);
//! // a force from outside acts from the next step on
//! axis.set_inputs(AxisInputs { force_mm_s2: 500.0, ..AxisInputs::default() });
//! let pushed = (3000..6000).map(|k| axis.step(0.01 * f64::from(k), 0.0, true)).last().unwrap();
//! assert!(axis.faults().is_empty() && pushed.lag_mm.is_finite());
//! ```

mod config;
mod given;
mod renewal;

use super::{
    buffer::{Setpoint, SetpointBuffer},
    fault::{Fault, Faults},
    feedforward::{Feedforward, FeedforwardOutput},
    ipc::{Ipc, IpcConfig, IpcInput, IpcOutput},
    monitor::{ExactStopMonitor, LagMonitor, SetpointMonitor},
    plant::{Plant, PlantError, PlantInput},
    position::{PositionLoop, SpeedLimiter},
};
use crate::time::CycleTime;
pub use config::{AxisControlConfig, Encoder};
use given::Given;

/// External influences on an axis; none by default.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AxisInputs {
    /// Position of the additional interface after its filter in mm, added to the set position.
    ///
    /// The controller and its feedforward get the sum; the monitors of the set position and of the exact stop look at
    /// the programmed part (Assumption: the documents name the interface only).
    pub additional_mm: f64,
    /// External force (friction, process) as acceleration of the whole mass in mm/s2.
    pub force_mm_s2: f64,
    /// Error of the measuring system of the position loop in mm.
    pub encoder_offset_mm: f64,
}

/// Values in the drive's format, in counts unless the name says otherwise.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DriveValues {
    /// Speed command.
    pub command: f64,
    /// Velocity feedforward, conventional or additive.
    pub feedforward: f64,
    /// Additive speed of Improved Position Control.
    pub additive_speed: f64,
    /// Additive torque.
    pub torque: f64,
    /// The same in N m (N for a linear motor).
    pub torque_n_m: f64,
}

/// The observable state after a cycle.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ControlOutput {
    /// Input of the position controller, mm.
    pub reference_mm: f64,
    /// Actual position of the motor encoder at the start of the cycle, mm.
    pub act_mm: f64,
    /// Position of the load (direct encoder), mm.
    pub load_mm: f64,
    /// Reference - actual position, mm.
    pub lag_mm: f64,
    /// Largest lag that its monitor permits in mm, none while it is off.
    pub lag_limit_mm: Option<f64>,
    /// See [`ExactStopMonitor::settling_s`].
    pub settling_s: f64,
    /// Feedforward.
    pub feedforward: FeedforwardOutput,
    /// Speed command: controller, conventional feedforward and additive speed, limited, mm/s.
    pub command_mm_s: f64,
    /// Additive speed of Improved Position Control, mm/s.
    pub additive_speed_mm_s: f64,
    /// It is at its limit.
    pub additive_speed_limited: bool,
    /// Tool point, mm.
    pub tcp_mm: f64,
    /// Acceleration of the tool point (difference of its speed over the last cycle), mm/s2.
    pub tcp_acc_mm_s2: f64,
    /// Values in the drive's format.
    pub drive: DriveValues,
    /// The monitors raised something, see [`AxisControl::faults`].
    pub faulty: bool,
}

/// One axis downstream of its set position.
#[derive(Clone, Debug)]
pub struct AxisControl {
    config: AxisControlConfig,
    cycle: CycleTime,
    cycle_s: f64,
    /// Of speed command and feedforward.
    counts_per_mm_s: (f64, f64),
    buffer: SetpointBuffer,
    feedforward: Feedforward,
    limiter: SpeedLimiter,
    ipc: Ipc,
    plant: Plant,
    lag: LagMonitor,
    exact_stop: ExactStopMonitor,
    setpoint: SetpointMonitor,
    set_mm: f64,
    tcp_mm_s: f64,
    /// Set position with the additional one.
    position_mm: f64,
    inputs: AxisInputs,
    faults: Faults,
    /// Following error in mm that belongs to no stable loop.
    unstable_mm: f64,
    diverged: bool,
    moving: bool,
    open: bool,
    /// Position at which a reaction holds the axis.
    held_mm: Option<f64>,
    /// Inputs of the last cycle, and for how many cycles they have been the same without changing anything.
    given: Given,
    still_cycles: u32,
}

impl AxisControl {
    /// Largest set position in mm: far beyond any machine, and small enough for every difference to stay finite.
    pub(crate) const RANGE_MM: f64 = 1e9;
    /// Still cycles after which everything that remembers a fixed number of cycles (buffer, delays of the feedforward, dead
    /// time, differences) holds equal values only.
    const REST_CYCLES: u32 = 32;
    /// Following errors beyond this multiple of the permitted or the theoretical lag belong to no stable loop.
    const DIVERGED: f64 = 10.0;

    /// An axis after its (checked) configuration, at rest at 0.
    ///
    /// # Errors
    /// [`PlantError`] if the plant is not physical.
    pub fn new(config: AxisControlConfig, cycle: CycleTime) -> Result<Self, PlantError> {
        let delay = config.delay_cycles.max(config.feedforward.delay_cycles());
        let theoretical_mm = config.position.v_max_mm_s / config.position.lowest_gain();
        let mut control = Self {
            buffer: SetpointBuffer::new(delay, config.feedforward.shift_cycles),
            feedforward: Feedforward::new(config.feedforward, cycle),
            limiter: SpeedLimiter::new(&config.position),
            ipc: Ipc::new(&config.ipc, config.position.v_max_mm_s, cycle),
            plant: Plant::new(&config.plant, cycle)?,
            lag: LagMonitor::new(config.lag, cycle),
            exact_stop: ExactStopMonitor::new(config.exact_stop, cycle),
            setpoint: SetpointMonitor::new(config.setpoint, cycle),
            counts_per_mm_s: (
                config.command_format.counts_per_mm_s(cycle.seconds()),
                config.feedforward_format.counts_per_mm_s(cycle.seconds()),
            ),
            unstable_mm: Self::DIVERGED * config.lag.lag_max_mm.max(theoretical_mm),
            config,
            cycle,
            cycle_s: cycle.seconds(),
            set_mm: 0.0,
            tcp_mm_s: 0.0,
            position_mm: 0.0,
            inputs: AxisInputs::default(),
            faults: Faults::default(),
            diverged: false,
            moving: false,
            open: false,
            held_mm: None,
            given: Given::default(),
            still_cycles: 0,
        };
        control.start(0.0);
        Ok(control)
    }

    /// Puts everything at rest at a position, without inputs from outside; no transient follows.
    pub fn start(&mut self, position_mm: f64) {
        self.start_with(position_mm, AxisInputs::default());
    }

    /// Puts everything at rest at a set position under lasting inputs; only a force has a transient.
    pub fn start_with(&mut self, set_mm: f64, inputs: AxisInputs) {
        let position_mm = set_mm + inputs.additional_mm;
        self.buffer.start(position_mm);
        self.feedforward.start();
        self.limiter = SpeedLimiter::new(&self.config.position);
        self.ipc.start();
        self.plant.start(position_mm - inputs.encoder_offset_mm);
        self.lag.start(position_mm);
        self.exact_stop.start(set_mm);
        self.setpoint.start(set_mm);
        self.set_mm = set_mm;
        self.position_mm = position_mm;
        self.tcp_mm_s = 0.0;
        self.inputs = inputs;
        self.diverged = false;
        self.moving = false;
        self.open = false;
        self.held_mm = None;
        self.faults.clear();
        self.still_cycles = 0;
    }

    /// The configuration in use.
    pub const fn config(&self) -> &AxisControlConfig {
        &self.config
    }

    /// Delay of the position path in cycles.
    pub const fn delay_cycles(&self) -> usize {
        self.buffer.delay_cycles()
    }

    /// Following-error monitor, with lag and permitted lag of the last cycle.
    pub const fn lag_monitor(&self) -> &LagMonitor {
        &self.lag
    }

    /// [`ControlOutput::load_mm`] is [`ControlOutput::act_mm`] in every cycle, unless
    /// [`AxisInputs::encoder_offset_mm`] says otherwise: a rigid plant, read without steps.
    pub fn shows_load_twice(&self) -> bool {
        !self.plant.is_elastic() && self.config.increment_mm <= 0.0
    }

    /// The plant separates the tool point from the load.
    pub fn has_tool_point(&self) -> bool {
        self.plant.has_tool_point()
    }

    /// The path comes to a stop, for this axis at `target_mm`: the exact-stop timer starts when the set position
    /// gets there.
    pub fn expect_stop(&mut self, target_mm: f64) {
        self.still_cycles = 0;
        self.exact_stop.expect(target_mm);
    }

    /// Distance of the actual position from the newest set position in mm, signed.
    pub fn distance_mm(&self) -> f64 {
        self.position_mm - self.controlled_mm()
    }

    /// Exact-stop monitor.
    pub const fn exact_stop(&self) -> &ExactStopMonitor {
        &self.exact_stop
    }

    /// Keeps the axis where it is (reaction class 5): until the next start the controller gets the actual position of this
    /// moment, with its loop closed and without feedforward, whatever the set position does.
    pub fn halt(&mut self) {
        self.still_cycles = 0;
        let here = self.controlled_mm();
        self.held_mm.get_or_insert(here);
    }

    /// Opens the position loop until the next start: the drive gets the speed 0, whatever the set position does (reaction
    /// class 8). The monitors, which watch a closed loop, have nothing to say any more.
    pub fn open_loop(&mut self) {
        self.still_cycles = 0;
        self.open = true;
    }

    /// The motor is slower than `speed_mm_s`, or its plant is held after it diverged.
    pub fn stands(&self, speed_mm_s: f64) -> bool {
        self.diverged || self.plant.measured().motor_mm_s.abs() <= speed_mm_s
    }

    /// Sets the external influences from now on.
    #[inline]
    pub fn set_inputs(&mut self, inputs: AxisInputs) {
        self.inputs = inputs;
    }

    /// Takes new parameters of Improved Position Control.
    ///
    /// # Errors
    /// 70601 while the set position moves; the old parameters stay.
    pub fn change_ipc(&mut self, ipc: IpcConfig) -> Result<(), Fault> {
        self.ipc.change(&ipc, self.config.position.v_max_mm_s, self.cycle, self.moving)?;
        self.config.ipc = ipc;
        self.still_cycles = 0;
        Ok(())
    }

    /// Its monitors have to look at every cycle: a stop is awaited, or a set position is above a threshold.
    pub const fn goes_alone(&self) -> bool {
        !self.exact_stop.rests() || self.setpoint.is_raised()
    }

    /// What the monitors raised in the last cycle.
    pub const fn faults(&self) -> &Faults {
        &self.faults
    }

    /// The axis rests, and a cycle with these values would change nothing: it would give the output of the last one bit
    /// for bit, and may be left out.
    #[inline]
    pub fn rests_under(
        &self,
        set_mm: f64,
        gain: f64,
        jerk_limited: bool,
        inputs: &AxisInputs,
    ) -> bool {
        self.still_cycles >= Self::REST_CYCLES
            && self.given.set == set_mm.to_bits()
            && self.given.is_like(&Given::new(gain, jerk_limited, inputs))
    }

    /// Counts cycles that change nothing that has no fixed memory; `calm`: they are given the same, and nothing else is in motion.
    #[inline]
    fn count_still(&mut self, calm: bool) {
        // a plant that moves settles most cycles
        let still = calm
            && self.plant.rests()
            && self.lag.rests()
            && !self.limiter.is_active()
            && !self.diverged;
        self.still_cycles = if still { self.still_cycles.saturating_add(1) } else { 0 };
    }

    /// Position that the controller, the monitors and the exact stop see.
    fn controlled_mm(&self) -> f64 {
        let m = self.plant.measured();
        let true_mm = match self.config.encoder {
            Encoder::Motor => m.motor_mm,
            Encoder::Direct => m.load_mm,
        };
        self.read_mm(true_mm + self.inputs.encoder_offset_mm)
    }

    /// A position as the measuring system of the position loop reads it.
    ///
    /// Assumption: the nearest increment, counted from the machine's zero; homing takes any constant part out.
    fn read_mm(&self, mm: f64) -> f64 {
        let step_mm = self.config.increment_mm;
        if step_mm > 0.0 { (mm / step_mm).round() * step_mm } else { mm }
    }

    /// One cycle: set position after filters or Vibration Guard, feedforward gain of this motion
    /// ([`gain`](super::feedforward::FeedforwardConfig::gain); 0 when off) and whether its slope is jerk-limited.
    ///
    /// A set position beyond [`AxisControl::RANGE_MM`] (or not a number) counts as standing still.
    pub fn step(&mut self, set_mm: f64, gain: f64, jerk_limited: bool) -> ControlOutput {
        let mut output = ControlOutput::default();
        self.run(&[set_mm], gain, jerk_limited, 0, |_, seen| output = seen);
        output
    }

    /// Cycles in a row under the same inputs, gain and slope, each as [`Self::step`], at least one. The number up to the first one
    /// in which the monitors raise something or may: if it is not the last one, parts of the axis are beyond it, and it has to be
    /// put back to where it was.
    ///
    /// `show` gets the output of the cycles from number `shown_from` on, and of one with a fault.
    #[inline] // the output is large: used where it is made
    pub fn run(
        &mut self,
        set_mm: &[f64],
        gain: f64,
        jerk_limited: bool,
        shown_from: usize,
        mut show: impl FnMut(usize, ControlOutput),
    ) -> usize {
        self.faults.clear();
        let inputs = self.inputs;
        let mut given = Given::new(gain, jerk_limited, &inputs);
        let same = given.is_like(&self.given);
        let calm = self.ipc.is_off() && !self.diverged && self.exact_stop.rests();
        let set_by_set = !self.exact_stop.rests();
        let count = match set_mm.len() {
            0 => return 0,
            1 => 1,
            _ if set_by_set => 1,
            most => most.min(self.setpoint.quiet(set_mm) + 1),
        };
        self.setpoint.pass(&set_mm[..count - 1]);
        let (cycle_s, encoder) = (self.cycle_s, self.config.encoder);
        for (i, set_mm) in set_mm[..count].iter().copied().enumerate() {
            let last = i + 1 == count;
            let before = std::mem::replace(&mut given.set, set_mm.to_bits());
            let before = if i == 0 { self.given.set } else { before };
            let set_mm = if set_mm.abs() <= Self::RANGE_MM { set_mm } else { self.set_mm };
            let position_mm = set_mm + inputs.additional_mm;
            self.moving = (position_mm - self.position_mm).abs() > 0.0;
            (self.set_mm, self.position_mm) = (set_mm, position_mm);
            let measured = *self.plant.measured();
            let actual_mm = self.controlled_mm();

            self.buffer.push(Setpoint { position_mm, gain, jerk_limited });
            let (reference_mm, reference_step_mm) = match self.held_mm {
                Some(held_mm) => (held_mm, 0.0),
                None => (self.buffer.reference_mm(), self.buffer.reference_step_mm()),
            };
            let position = &self.config.position;
            let kv = position.gain_at(reference_step_mm / cycle_s);
            let error_mm =
                position.error_mm(reference_mm - actual_mm, reference_step_mm.abs() <= 0.0);
            let mut feedforward = if self.buffer.is_without_gain() && self.feedforward.needs_gain()
            {
                FeedforwardOutput::default()
            } else {
                self.feedforward.step(&self.buffer.window(), kv)
            };
            if self.held_mm.is_some() {
                feedforward = FeedforwardOutput::default();
            }
            let mut wanted = kv * error_mm + feedforward.speed_mm_s;
            let mut additive = self.ipc.step(&IpcInput {
                motor_mm_s: measured.motor_mm_s,
                direct_mm_s: (encoder == Encoder::Direct).then_some(measured.load_mm_s),
                command_mm_s: wanted,
            });
            if self.open {
                feedforward = FeedforwardOutput::default();
                wanted = 0.0;
                additive = IpcOutput::default();
            }
            let (command_mm_s, speed_fault) = self.limiter.step(wanted + additive.speed_mm_s);

            if last {
                self.setpoint.step(set_mm, &mut self.faults);
            }
            self.faults.push(speed_fault);
            if last || self.lag.needs_every_cycle() || i + LagMonitor::MEMORY >= count {
                self.faults.push(self.lag.step(reference_mm, actual_mm, kv));
            }
            if set_by_set {
                let late = self.exact_stop.step(set_mm, actual_mm - inputs.additional_mm);
                // an axis that a reaction holds does not arrive; the reaction has been reported already
                self.faults.push(late.filter(|_| self.held_mm.is_none()));
            }
            let unstable = self.advance(
                PlantInput {
                    speed_mm_s: self.felt_mm_s(command_mm_s, feedforward.additive_speed_mm_s),
                    acc_mm_s2: self.felt_mm_s2(feedforward.additive_acc_mm_s2),
                    force_mm_s2: inputs.force_mm_s2,
                    reference_mm,
                },
                reference_mm - actual_mm,
            );
            self.faults.push(unstable);
            if self.open {
                self.faults.clear();
            }
            let faulty = !self.faults.is_empty();
            let as_before = before == given.set && (same || i > 0);
            self.count_still(as_before && calm && !faulty);

            let tcp_before_mm_s = std::mem::replace(&mut self.tcp_mm_s, measured.tcp_mm_s);
            if faulty || i >= shown_from || last {
                let shown_mm = match encoder {
                    Encoder::Motor => actual_mm,
                    Encoder::Direct => measured.motor_mm,
                };
                let output = ControlOutput {
                    reference_mm,
                    act_mm: shown_mm,
                    load_mm: match encoder {
                        Encoder::Motor => measured.load_mm,
                        Encoder::Direct => actual_mm,
                    },
                    lag_mm: reference_mm - actual_mm,
                    lag_limit_mm: self.lag.limit_mm(),
                    settling_s: self.exact_stop.settling_s(),
                    feedforward,
                    command_mm_s,
                    additive_speed_mm_s: additive.speed_mm_s,
                    additive_speed_limited: additive.limited,
                    tcp_mm: measured.tcp_mm,
                    tcp_acc_mm_s2: (measured.tcp_mm_s - tcp_before_mm_s) / cycle_s,
                    drive: self.drive_values(command_mm_s, &feedforward, additive.speed_mm_s),
                    faulty,
                };
                show(i, output);
            }
            if faulty {
                self.given = given;
                return i + 1;
            }
        }
        if !set_by_set {
            self.exact_stop.pass(&set_mm[..count]);
        }
        self.given = given;
        count
    }

    /// Advances the plant unless it diverged; then it is held where it was last finite.
    #[inline]
    fn advance(&mut self, input: PlantInput, lag_mm: f64) -> Option<Fault> {
        if self.diverged {
            return None;
        }
        let limit_mm = self.unstable_mm;
        if lag_mm.abs() <= limit_mm && self.plant.advance(input) {
            return None;
        }
        self.diverged = true;
        Some(Fault::Unstable { lag_mm, limit_mm })
    }

    /// Speed that the drive follows: what it was sent in its format.
    ///
    /// A drive that closes the position loop itself makes its own command.
    #[inline]
    fn felt_mm_s(&self, command: f64, additive: f64) -> f64 {
        let (c, cycle_s) = (&self.config, self.cycle_s);
        let command = match c.position.closed_in {
            PositionLoop::Cnc => c.command_format.sent(command, cycle_s),
            PositionLoop::Drive => command,
        };
        command
            + if additive.abs() > 0.0 { c.feedforward_format.sent(additive, cycle_s) } else { 0.0 }
    }

    /// Acceleration that an additive torque gives the axis.
    #[inline]
    fn felt_mm_s2(&self, wanted: f64) -> f64 {
        let torque = &self.config.torque;
        if wanted.abs() > 0.0 { torque.acceleration(torque.torque(wanted)) } else { 0.0 }
    }

    #[inline]
    fn drive_values(&self, command: f64, ff: &FeedforwardOutput, additive: f64) -> DriveValues {
        let (command_scale, ff_scale) = self.counts_per_mm_s;
        let mut values = DriveValues {
            command: command * command_scale,
            feedforward: (ff.speed_mm_s + ff.additive_speed_mm_s) * ff_scale,
            additive_speed: additive * command_scale,
            ..DriveValues::default()
        };
        if ff.additive_acc_mm_s2.abs() > 0.0 {
            values.torque_n_m = self.config.torque.torque(ff.additive_acc_mm_s2);
            values.torque = self.config.torque.counts(values.torque_n_m);
        }
        values
    }
}
