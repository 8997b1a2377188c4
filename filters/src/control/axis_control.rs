//! One axis downstream of its set position: its parts in their fixed order, once per cycle.
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
//! Configure it once, start it at a position, then call [`AxisControl::step`] once per cycle:
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

mod calm;
mod config;
mod cycle;
mod given;
mod renewal;
mod shown;

use super::{
    buffer::SetpointBuffer,
    fault::{Fault, Faults},
    feedforward::{Feedforward, FeedforwardOutput},
    ipc::{Ipc, IpcConfig},
    monitor::{ExactStopMonitor, LagMonitor, RangeMonitor, SetpointMonitor},
    plant::{Plant, PlantError},
    position::SpeedLimiter,
};
use crate::time::CycleTime;
pub use config::{AxisControlConfig, Encoder};
pub use given::AxisInputs;
use given::Given;
use shown::CalmCycle;
pub use shown::{CalmCycles, Show, Shown};
use std::sync::Arc;

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
    /// Additive torque in N m (N for a linear motor).
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
    /// Permitted lag in mm, `None` while its monitor is off.
    pub lag_limit_mm: Option<f64>,
    /// See [`ExactStopMonitor::settling_s`].
    pub settling_s: f64,
    /// Output of the feedforward.
    pub feedforward: FeedforwardOutput,
    /// Speed command in mm/s: controller, conventional feedforward and additive speed, limited.
    pub command_mm_s: f64,
    /// Additive speed of Improved Position Control, mm/s.
    pub additive_speed_mm_s: f64,
    /// Whether the additive speed is at its limit.
    pub additive_speed_limited: bool,
    /// Tool point, mm.
    pub tcp_mm: f64,
    /// Acceleration of the tool point (difference of its speed over the last cycle), mm/s2.
    pub tcp_acc_mm_s2: f64,
    /// Values in the drive's format.
    pub drive: DriveValues,
    /// Whether the monitors raised a fault, see [`AxisControl::faults`].
    pub faulty: bool,
}

/// One axis downstream of its set position.
#[derive(Clone, Debug)]
pub struct AxisControl {
    /// Shared with the saved states of the axis.
    config: Arc<AxisControlConfig>,
    cycle: CycleTime,
    cycle_s: f64,
    /// Scale of the speed command and of the feedforward.
    counts_per_mm_s: (f64, f64),
    buffer: SetpointBuffer,
    feedforward: Feedforward,
    limiter: SpeedLimiter,
    ipc: Ipc,
    plant: Plant,
    lag: LagMonitor,
    exact_stop: ExactStopMonitor,
    setpoint: SetpointMonitor,
    range: RangeMonitor,
    set_mm: f64,
    tcp_mm_s: f64,
    /// Set position including the additional one, mm.
    position_mm: f64,
    inputs: AxisInputs,
    faults: Faults,
    /// Following error in mm above which the loop counts as unstable.
    unstable_mm: f64,
    diverged: bool,
    moving: bool,
    open: bool,
    /// Position in mm at which a reaction holds the axis.
    held_mm: Option<f64>,
    /// Inputs of the last cycle, and the number of cycles in which they have been the same without any effect.
    given: Given,
    still_cycles: u32,
    /// Memory for the calm cycles of a row.
    calm: Vec<CalmCycle>,
}

impl AxisControl {
    /// Cycles at standstill after which everything with a fixed memory (buffer, delays of the feedforward, dead time,
    /// differences) holds equal values only.
    const REST_CYCLES: u32 = 32;
    /// A following error beyond this multiple of the permitted or the theoretical lag means an unstable loop.
    const DIVERGED: f64 = 10.0;

    /// An axis with the given (checked) configuration, at rest at 0.
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
            range: RangeMonitor::new(config.range_mm),
            counts_per_mm_s: (
                config.command_format.counts_per_mm_s(cycle.seconds()),
                config.feedforward_format.counts_per_mm_s(cycle.seconds()),
            ),
            unstable_mm: Self::DIVERGED * config.lag.lag_max_mm.max(theoretical_mm),
            config: Arc::new(config),
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
            calm: Vec::new(),
        };
        control.start(0.0);
        Ok(control)
    }

    /// Puts all parts at rest at a position, without external inputs; no transient follows.
    pub fn start(&mut self, position_mm: f64) {
        self.start_with(position_mm, AxisInputs::default());
    }

    /// Puts all parts at rest at a set position under constant inputs; only a force causes a transient.
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
        self.range.start(position_mm);
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
    pub fn config(&self) -> &AxisControlConfig {
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

    /// Whether [`ControlOutput::load_mm`] equals [`ControlOutput::act_mm`] in every cycle unless
    /// [`AxisInputs::encoder_offset_mm`] is set: true for a rigid plant whose encoder has no increments.
    pub fn shows_load_twice(&self) -> bool {
        !self.plant.is_elastic() && self.config.increment_mm <= 0.0
    }

    /// Whether the plant separates the tool point from the load.
    pub fn has_tool_point(&self) -> bool {
        self.plant.has_tool_point()
    }

    /// Replaces the permitted range of the actual positions in mm, tolerance included; `None`: not monitored.
    pub fn limit_range(&mut self, range_mm: Option<(f64, f64)>) {
        self.range = RangeMonitor::new(range_mm);
        self.range.start(self.controlled_mm());
        self.still_cycles = 0;
    }

    /// Announces a stop of the path, for this axis at `target_mm`: the exact-stop timer starts when the set position
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

    /// Holds the axis where it is (reaction class 5): until the next start the controller gets the present actual
    /// position, with its loop closed and without feedforward, whatever the set position does.
    pub fn halt(&mut self) {
        self.still_cycles = 0;
        let here = self.controlled_mm();
        self.held_mm.get_or_insert(here);
    }

    /// Opens the position loop until the next start: the drive gets the speed 0, whatever the set position does
    /// (reaction class 8). The monitors observe a closed loop, so they raise nothing any more.
    pub fn open_loop(&mut self) {
        self.still_cycles = 0;
        self.open = true;
    }

    /// Whether the motor is slower than `speed_mm_s`, or the plant is held after it diverged.
    pub fn is_at_rest(&self, speed_mm_s: f64) -> bool {
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
        Arc::make_mut(&mut self.config).ipc = ipc;
        self.still_cycles = 0;
        Ok(())
    }

    /// Whether the monitors have to see every cycle: a stop is awaited, or a set position is above a threshold.
    pub const fn goes_alone(&self) -> bool {
        !self.exact_stop.rests() || self.setpoint.is_raised()
    }

    /// What the monitors raised in the last cycle.
    pub const fn faults(&self) -> &Faults {
        &self.faults
    }

    /// Whether the axis rests and a cycle with these values would change nothing. Such a cycle repeats the last output
    /// bit for bit and may be left out.
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

    /// Counts the cycles in which nothing without a fixed memory changes; `rests`: the inputs are the same, and plant and
    /// everything else that is not asked here rest.
    #[inline]
    fn count_still(&mut self, rests: bool) {
        let still = rests && self.lag.rests() && !self.limiter.is_active() && !self.diverged;
        self.still_cycles = if still { self.still_cycles.saturating_add(1) } else { 0 };
    }
}
