//! One axis from its interpolated setpoint to its actual position: its parts, its inputs and its state. For what it
//! does in a cycle see [`cycle`].

mod cycle;
mod shown;

pub(super) use cycle::Mark;

use crate::machine::{AdditionalInterface, ChainSetup};
use crate::record::AxisRecord;
use kontur_filters::control::axis_control::{AxisControl, AxisInputs};
use kontur_filters::control::plant::PlantError;
use kontur_filters::iir::AxisFilter;
use kontur_filters::kernel::{Kernel, SwitchWhileMoving};
use kontur_filters::ring::Ring;
use kontur_filters::shaping::{Origin, Shaping};
use kontur_filters::stage::Stage;
use kontur_filters::time::CycleTime;
use std::sync::Arc;

/// Speed of the motor in mm/s (deg/s) below which an axis counts as at rest.
const STANDSTILL_MM_S: f64 = 0.1;

/// Distance of an axis from what a wait requires.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Remaining {
    /// Distance in mm (deg), signed.
    pub(crate) distance_mm: f64,
    /// Half width of the window in mm (deg).
    pub(crate) window_mm: f64,
    /// Whether the filters have not settled (P-AXIS-00351); otherwise the actual position is outside its window.
    pub(crate) filters: bool,
}

impl Remaining {
    /// Distance beyond the window in mm (deg).
    pub(crate) fn excess_mm(&self) -> f64 {
        self.distance_mm.abs() - self.window_mm
    }
}

/// Shaping and control of one axis, with the quantities that the trace derives from them.
#[derive(Debug)]
pub(crate) struct AxisChain {
    shaping: Shaping,
    control: AxisControl,
    additional: Option<AdditionalInterface>,
    inputs: AxisInputs,
    /// Offset of online tool compensation, added after the filters.
    wear_mm: f64,
    filter_window_mm: f64,
    delay_cycles: f64,
    /// Delay in whole cycles, and its fraction.
    delay: (u32, f64),
    /// Interpolated setpoints as far back as the delay reaches.
    ipo: Ring,
    set: f64,
    vel: f64,
    acc: f64,
    /// Way of the actual position in the last cycle.
    act_step: f64,
    cycle_s: f64,
    /// Number of cycles in the last row in which it did not rest.
    moved: usize,
    /// Whether the monitors raised a fault in the last cycle.
    faulty: bool,
}

impl AxisChain {
    /// A chain at rest at a set position, under constant inputs.
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
            act_step: 0.0,
            cycle_s: cycle.seconds(),
            moved: 0,
            faulty: false,
        };
        chain.align(x);
        Ok(chain)
    }

    /// Takes over the state of the chain that this one replaces; `old` and `new` are their setups. Unchanged parts
    /// continue: the kernel, each filter, and the filter of the additional interface; other filters begin at rest.
    pub(crate) fn take_over(&mut self, before: &Self, old: &ChainSetup, new: &ChainSetup) {
        self.shaping = before.shaping.clone();
        if old.filters == new.filters {
            self.align(before.ipo.newest());
            self.ipo = before.ipo.clone();
        } else {
            let origins = origins(&old.filters, &new.filters);
            self.shaping.change_filters(new.filters.clone(), &origins);
            self.align(before.ipo.newest());
        }
        if old.additional == new.additional {
            self.additional.clone_from(&before.additional);
        }
        self.inputs = before.inputs;
        self.wear_mm = before.wear_mm;
        self.control.take_over(&before.control);
        (self.set, self.vel, self.acc) = (before.set, before.vel, before.acc);
    }

    /// Replaces the permitted range of the actual positions in mm; `None`: not monitored.
    pub(crate) fn limit_range(&mut self, range_mm: Option<(f64, f64)>) {
        self.control.limit_range(range_mm);
    }

    /// Shifts the set position at rest by `by_mm`; the axis either `moves` there, or its present position gets the new
    /// coordinate.
    pub(crate) fn shift(&mut self, by_mm: f64, moves: bool) {
        self.set += by_mm;
        self.shaping.shift(by_mm);
        self.align(self.shaping.input());
        if moves {
            self.control.command(by_mm);
        } else {
            self.control.shift(by_mm);
        }
    }

    /// Adjusts to a changed delay: the setpoints within its reach are those of the present standstill.
    fn align(&mut self, x: f64) {
        self.delay_cycles = self.shaping.delay_cycles();
        let whole = self.delay_cycles.floor();
        self.delay = (whole as u32, self.delay_cycles - whole);
        self.ipo = Ring::new(self.delay_cycles.ceil() as u32, x);
    }

    /// Sets the kernel of FIR, HSC or Vibration Guard.
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

    /// Whether the kernel can be replaced without a jump.
    pub(crate) fn ready_for(&self, kernel: Option<&Kernel>) -> bool {
        self.shaping.ready_for(kernel)
    }

    /// Whether the set position has arrived at the interpolated one.
    pub(crate) fn settled(&self) -> bool {
        self.shaping.settled(self.filter_window_mm)
    }

    /// Whether the kernel has output everything it held.
    pub(crate) fn flushed(&self) -> bool {
        self.shaping.flushed()
    }

    /// Distance of the filters from having arrived.
    pub(crate) fn unsettled(&self) -> Option<Remaining> {
        let distance_mm = self.ipo.newest() - self.set;
        let window_mm = self.filter_window_mm;
        (!self.settled()).then_some(Remaining { distance_mm, window_mm, filters: true })
    }

    /// Distance of the actual position from the exact-stop window (P-AXIS-00236), if it is outside.
    pub(crate) fn out_of_position(&self) -> Option<Remaining> {
        let distance_mm = self.control.distance_mm();
        let window_mm = self.control.exact_stop().config().window_mm;
        let remaining = Remaining { distance_mm, window_mm, filters: false };
        (remaining.excess_mm() > 0.0).then_some(remaining)
    }

    /// Actual speed in the last cycle in mm/s (deg/s).
    pub(crate) fn actual_speed(&self) -> f64 {
        self.act_step / self.cycle_s
    }

    /// Whether the set position is at the target of a stop and the actual position not yet inside the window.
    pub(crate) fn settles(&self) -> bool {
        self.control.exact_stop().settles()
    }

    /// Whether no stop is awaited.
    pub(crate) fn arrived(&self) -> bool {
        self.control.exact_stop().rests()
    }

    /// Time limit of the exact stop in s, `None` if it is not monitored.
    pub(crate) fn settling_limit_s(&self) -> Option<f64> {
        self.control.exact_stop().config().settling_s
    }

    /// Holds the axis where it is: reaction class 5.
    pub(crate) fn halt(&mut self) {
        self.control.halt();
    }

    /// Opens the position loop: reaction class 8.
    pub(crate) fn open_loop(&mut self) {
        self.control.open_loop();
    }

    /// Whether the axis is at rest, not only its set position.
    pub(crate) fn is_at_rest(&self) -> bool {
        self.control.is_at_rest(STANDSTILL_MM_S)
    }

    /// Announces a stop of the path with this axis at `target_mm`, which arms the exact-stop timer.
    pub(crate) fn expect_stop(&mut self, target_mm: f64) {
        self.control.expect_stop(target_mm);
    }

    /// Feedforward gain for the state of G135, G136.
    pub(crate) fn feedforward_gain(&self, on: bool, weight_ratio: f64) -> f64 {
        self.control.config().feedforward.gain(on, weight_ratio)
    }

    /// Mean delay of the shaping in cycles.
    pub(crate) fn delay_cycles(&self) -> f64 {
        self.delay_cycles
    }

    /// Number of cycles over which a setpoint acts on the set position, for the reach of the contour.
    pub(crate) fn reach_cycles(&self) -> u32 {
        let tail = (4.0 * (self.delay_cycles - self.shaping.kernel().delay_cycles())).ceil();
        self.shaping.flush_cycles() + tail.max(0.0) as u32
    }

    /// Whether the load position equals the actual position as long as the encoder is not disturbed externally.
    pub(crate) fn shows_load_twice(&self) -> bool {
        self.control.shows_load_twice()
    }

    /// Whether the tool point is separate from the load.
    pub(crate) fn has_tool_point(&self) -> bool {
        self.control.has_tool_point()
    }

    /// Set position of the last cycle.
    pub(crate) fn set_mm(&self) -> f64 {
        self.set
    }

    /// The record at the start of the trace, before time advances.
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

    /// Sets the external inputs from now on; the additional position is the one before its filter.
    pub(crate) fn set_inputs(&mut self, inputs: AxisInputs) {
        self.inputs = inputs;
    }

    /// Sets the offset of online tool compensation from the next cycle on.
    pub(crate) fn set_wear(&mut self, wear_mm: f64) {
        self.wear_mm = wear_mm;
    }
}

/// Origin of each of the new filters. Filters that are changed, added or removed are those between the unchanged ones
/// at the beginning and at the end.
fn origins(old: &[AxisFilter], new: &[AxisFilter]) -> Vec<Origin> {
    let front = old.iter().zip(new).take_while(|(a, b)| a == b).count();
    let most = old.len().min(new.len()) - front;
    let back =
        old.iter().rev().zip(new.iter().rev()).take(most).take_while(|(a, b)| a == b).count();
    let first_at_end = new.len() - back;
    let origin = |i: usize| match i {
        i if i < front => Origin::Same(i),
        i if i >= first_at_end => Origin::Same(i + old.len() - new.len()),
        i if old.len() == new.len() => Origin::Changed(i),
        _ => Origin::New,
    };
    (0..new.len()).map(origin).collect()
}
