//! One axis from its interpolated setpoint to its actual position, one cycle at a time.

use crate::machine::{AdditionalInterface, ChainSetup};
use crate::record::AxisRecord;
use kontur_filters::control::axis_control::{AxisControl, AxisInputs};
use kontur_filters::control::fault::Faults;
use kontur_filters::control::plant::PlantError;
use kontur_filters::kernel::{Kernel, SwitchWhileMoving};
use kontur_filters::ring::Ring;
use kontur_filters::shaping::Shaping;
use kontur_filters::stage::Stage;
use kontur_filters::time::CycleTime;
use std::sync::Arc;

/// Speed of the motor in mm/s (deg/s) below which an axis counts as at rest.
const STANDSTILL_MM_S: f64 = 0.1;

/// What an axis lacks to be where a wait wants it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Remaining {
    /// Distance in mm (deg), signed.
    pub(crate) distance_mm: f64,
    /// Half width of the window in mm (deg).
    pub(crate) window_mm: f64,
    /// The filters have not settled (P-AXIS-00351); otherwise the actual position is outside its window.
    pub(crate) filters: bool,
}

impl Remaining {
    /// Distance beyond the window in mm (deg).
    pub(crate) fn excess_mm(&self) -> f64 {
        self.distance_mm.abs() - self.window_mm
    }
}

/// Shaping and control of one axis with what the trace derives from them.
#[derive(Debug)]
pub(crate) struct AxisChain {
    shaping: Shaping,
    control: AxisControl,
    additional: Option<AdditionalInterface>,
    inputs: AxisInputs,
    /// What online tool compensation adds after the filters.
    wear_mm: f64,
    filter_window_mm: f64,
    delay_cycles: f64,
    /// Whole cycles of the delay, and the rest.
    delay: (u32, f64),
    /// Interpolated setpoints as far back as the delay reaches.
    ipo: Ring,
    set: f64,
    vel: f64,
    acc: f64,
    cycle_s: f64,
}

impl AxisChain {
    /// A chain at rest at a set position, under inputs that last.
    pub(crate) fn new(
        setup: ChainSetup,
        x: f64,
        inputs: AxisInputs,
        cycle: CycleTime,
    ) -> Result<Self, PlantError> {
        let mut control = AxisControl::new(setup.control, cycle)?;
        let mut additional = setup.additional;
        let additional_mm = match &mut additional {
            None => 0.0,
            Some(AdditionalInterface { filter: None }) => inputs.additional_mm,
            Some(AdditionalInterface { filter: Some(filter) }) => {
                filter.settle(inputs.additional_mm);
                inputs.additional_mm
            }
        };
        control.start_with(x, AxisInputs { additional_mm, ..inputs });
        let mut chain = Self {
            shaping: Shaping::new(setup.filters, x),
            control,
            additional,
            inputs,
            wear_mm: 0.0,
            filter_window_mm: setup.filter_window_mm,
            delay_cycles: 0.0,
            delay: (0, 0.0),
            ipo: Ring::new(0, x),
            set: x,
            vel: 0.0,
            acc: 0.0,
            cycle_s: cycle.seconds(),
        };
        chain.align(x);
        Ok(chain)
    }

    /// This chain takes the place of another one. Filters and the filter of the additional interface continue where they are the
    /// same; others begin at rest where the set position is.
    pub(crate) fn take_over(&mut self, before: &Self, same_filters: bool, same_interface: bool) {
        if same_filters {
            self.shaping = before.shaping.clone();
            self.align(before.ipo.newest());
            self.ipo = before.ipo.clone();
        }
        if same_interface {
            self.additional.clone_from(&before.additional);
        }
        self.inputs = before.inputs;
        self.wear_mm = before.wear_mm;
        self.control.take_over(&before.control);
        (self.set, self.vel, self.acc) = (before.set, before.vel, before.acc);
    }

    /// The current place of the axis gets another position, `by_mm` further on.
    pub(crate) fn shift(&mut self, by_mm: f64) {
        self.set += by_mm;
        self.shaping.settle(self.set);
        self.align(self.set);
        self.control.shift(by_mm);
    }

    /// The delay changed: the setpoints that it reaches back to are those of the present standstill.
    fn align(&mut self, x: f64) {
        self.delay_cycles = self.shaping.delay_cycles();
        let whole = self.delay_cycles.floor();
        self.delay = (whole as u32, self.delay_cycles - whole);
        self.ipo = Ring::new(self.delay_cycles.ceil() as u32, x);
    }

    /// Takes the kernel of FIR, HSC or Vibration Guard.
    ///
    /// # Errors
    /// [`SwitchWhileMoving`] unless [`Self::ready_for`].
    pub(crate) fn set_kernel(
        &mut self,
        kernel: Option<Arc<Kernel>>,
    ) -> Result<(), SwitchWhileMoving> {
        self.shaping.set_kernel(kernel)?;
        self.align(self.ipo.newest());
        Ok(())
    }

    /// The kernel can be replaced without a jump.
    pub(crate) fn ready_for(&self, kernel: Option<&Kernel>) -> bool {
        self.shaping.ready_for(kernel)
    }

    /// The set position has arrived at the interpolated one.
    pub(crate) fn settled(&self) -> bool {
        self.shaping.settled(self.filter_window_mm)
    }

    /// The kernel holds nothing any more that it still lets go.
    pub(crate) fn flushed(&self) -> bool {
        self.shaping.flushed()
    }

    /// What the filters lack to have arrived.
    pub(crate) fn unsettled(&self) -> Option<Remaining> {
        let distance_mm = self.ipo.newest() - self.set;
        let window_mm = self.filter_window_mm;
        (!self.settled()).then_some(Remaining { distance_mm, window_mm, filters: true })
    }

    /// What the actual position lacks to be inside the exact-stop window (P-AXIS-00236).
    pub(crate) fn out_of_position(&self) -> Option<Remaining> {
        let distance_mm = self.control.distance_mm();
        let window_mm = self.control.exact_stop().config().window_mm;
        let remaining = Remaining { distance_mm, window_mm, filters: false };
        (remaining.excess_mm() > 0.0).then_some(remaining)
    }

    /// The set position is at the target of a stop, the actual one not yet inside the window.
    pub(crate) fn settles(&self) -> bool {
        self.control.exact_stop().settles()
    }

    /// No stop is awaited.
    pub(crate) fn arrived(&self) -> bool {
        self.control.exact_stop().rests()
    }

    /// Time limit of the exact stop in s, none if it is not monitored.
    pub(crate) fn settling_limit_s(&self) -> Option<f64> {
        self.control.exact_stop().config().settling_s
    }

    /// Keeps the axis where it is: reaction class 5.
    pub(crate) fn halt(&mut self) {
        self.control.halt();
    }

    /// Opens the position loop: reaction class 8.
    pub(crate) fn open_loop(&mut self) {
        self.control.open_loop();
    }

    /// The axis itself is at rest, not only its set position.
    pub(crate) fn stands(&self) -> bool {
        self.control.stands(STANDSTILL_MM_S)
    }

    /// The path comes to rest with this axis at `target_mm`: the exact-stop timer is armed.
    pub(crate) fn expect_stop(&mut self, target_mm: f64) {
        self.control.expect_stop(target_mm);
    }

    /// Gain of feedforward in the state of G135, G136.
    pub(crate) fn feedforward_gain(&self, on: bool, weight_ratio: f64) -> f64 {
        self.control.config().feedforward.gain(on, weight_ratio)
    }

    /// Mean delay of the shaping in cycles.
    pub(crate) fn delay_cycles(&self) -> f64 {
        self.delay_cycles
    }

    /// Cycles over which a setpoint acts on the set position, for the reach of the contour.
    pub(crate) fn reach_cycles(&self) -> u32 {
        let tail = (4.0 * (self.delay_cycles - self.shaping.kernel().delay_cycles())).ceil();
        self.shaping.flush_cycles() + tail.max(0.0) as u32
    }

    /// The load is where the actual position says, as long as nothing from outside disturbs the encoder.
    pub(crate) fn shows_load_twice(&self) -> bool {
        self.control.shows_load_twice()
    }

    /// Tool point separate from the load.
    pub(crate) fn has_tool_point(&self) -> bool {
        self.control.has_tool_point()
    }

    /// Set position of the last cycle.
    pub(crate) fn set_mm(&self) -> f64 {
        self.set
    }

    /// One cycle without motion of time: what the trace shows at the start.
    pub(crate) fn at_start(&self) -> AxisRecord {
        let x = self.set;
        AxisRecord {
            ipo: x,
            set: x,
            reference: x,
            act: x,
            load: x,
            tcp: x,
            ..AxisRecord::default()
        }
    }

    /// What acts from outside, from now on; the additional position in front of its filter.
    pub(crate) fn set_inputs(&mut self, inputs: AxisInputs) {
        self.inputs = inputs;
    }

    /// The additional position of this cycle; nothing if the interface is off.
    fn additional_mm(&mut self) -> f64 {
        let x = self.inputs.additional_mm;
        let additional_mm = match &mut self.additional {
            None => 0.0,
            Some(AdditionalInterface { filter: None }) => x,
            Some(AdditionalInterface { filter: Some(filter) }) => filter.step(x),
        };
        additional_mm + self.wear_mm
    }

    /// The offset of online tool compensation from the next cycle on.
    pub(crate) fn set_wear(&mut self, wear_mm: f64) {
        self.wear_mm = wear_mm;
    }

    /// One cycle: fills the record and returns what the monitors have raised, if anything.
    pub(crate) fn step(
        &mut self,
        ipo: f64,
        gain: f64,
        jerk_limited: bool,
        record: &mut AxisRecord,
    ) -> Option<&Faults> {
        if self.rests_under(ipo, gain, jerk_limited) {
            self.shaping.rest();
            return None;
        }
        self.ipo.push(ipo);
        let set = self.shaping.step(ipo);
        let t = self.cycle_s;
        let vel = (set - self.set) / t;
        let acc = (vel - self.vel) / t;
        let jerk = (acc - self.acc) / t;
        (self.set, self.vel, self.acc) = (set, vel, acc);
        let additional_mm = self.additional_mm();
        self.control.set_inputs(AxisInputs { additional_mm, ..self.inputs });
        let out = self.control.step(set, gain, jerk_limited);
        *record = AxisRecord {
            ipo,
            set,
            vel,
            acc,
            jerk,
            err: set - self.aligned(),
            dev: 0.0,
            dev_both_ways: 0.0,
            ff: out.feedforward.speed_mm_s + out.feedforward.additive_speed_mm_s,
            cmd: out.command_mm_s,
            vadd: out.additive_speed_mm_s,
            vadd_limited: f64::from(u8::from(out.additive_speed_limited)),
            reference: out.reference_mm,
            act: out.act_mm,
            load: out.load_mm,
            lag: out.lag_mm,
            lag_limit: self.control.lag_monitor().limit_mm().unwrap_or(0.0),
            add: additional_mm,
            settling_s: self.control.exact_stop().settling_s(),
            tcp: out.tcp_mm,
            tcp_acc: out.tcp_acc_mm_s2,
            target: record.target,
            cmd_drive: out.drive.command,
            vff_drive: out.drive.feedforward,
            vadd_drive: out.drive.additive_speed,
            torque_drive: out.drive.torque,
            torque_n_m: out.drive.torque_n_m,
        };
        out.faulty.then(|| self.control.faults())
    }

    /// A cycle with these values would leave the record of the last one as it is.
    ///
    /// Sampled setpoints and differences are shorter than what the kernel remembers and the rest of the control.
    fn rests_under(&self, ipo: f64, gain: f64, jerk_limited: bool) -> bool {
        // an axis that moves fails here
        if !self.shaping.rests_under(ipo) {
            return false;
        }
        let additional_mm = match &self.additional {
            None => 0.0,
            Some(AdditionalInterface { filter: None }) => self.inputs.additional_mm,
            Some(AdditionalInterface { filter: Some(_) }) => return false,
        };
        let inputs = AxisInputs { additional_mm: additional_mm + self.wear_mm, ..self.inputs };
        self.control.rests_under(self.set, gain, jerk_limited, &inputs)
    }

    /// Interpolated setpoint of the moment that the mean delay points to, linear between two samples.
    fn aligned(&self) -> f64 {
        let (whole, part) = self.delay;
        let newer = self.ipo.past(whole);
        if part > 0.0 { newer + part * (self.ipo.past(whole + 1) - newer) } else { newer }
    }
}
