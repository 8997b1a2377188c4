//! One axis from its interpolated setpoint to its actual position: what it consists of, what acts on it, and how it is. What it does
//! in a cycle is in [`cycle`].

mod cycle;

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
    /// Cycles of the last row in which it did not rest.
    moved: usize,
    /// The monitors have raised something in the last cycle.
    faulty: bool,
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
            moved: 0,
            faulty: false,
        };
        chain.align(x);
        Ok(chain)
    }

    /// This chain, of `new`, takes the place of another one, of `old`. What is the same continues: the kernel, each filter, and
    /// the filter of the additional interface; other filters begin at rest.
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

    /// The set position at rest becomes another one, `by_mm` further on; the axis `moves` there, or its present place gets that
    /// position.
    pub(crate) fn shift(&mut self, by_mm: f64, moves: bool) {
        self.set += by_mm;
        self.shaping.settle(self.set);
        self.align(self.set);
        if moves {
            self.control.command(by_mm);
        } else {
            self.control.shift(by_mm);
        }
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

    /// The kernel no longer holds anything that it has still to let go.
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

    /// What acts from outside, from now on; the additional position before its filter.
    pub(crate) fn set_inputs(&mut self, inputs: AxisInputs) {
        self.inputs = inputs;
    }

    /// The offset of online tool compensation from the next cycle on.
    pub(crate) fn set_wear(&mut self, wear_mm: f64) {
        self.wear_mm = wear_mm;
    }
}

/// What each of the new filters was before. One that is changed, added or taken away lies between those that are the same at the
/// beginning and at the end.
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
