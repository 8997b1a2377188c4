//! One axis from its interpolated setpoint to its actual position, for cycles in a row.

use crate::machine::{AdditionalInterface, ChainSetup};
use crate::record::AxisRecord;
use kontur_filters::control::axis_control::{AxisControl, AxisInputs, ControlOutput};
use kontur_filters::control::fault::Faults;
use kontur_filters::control::plant::PlantError;
use kontur_filters::iir::AxisFilter;
use kontur_filters::kernel::{Kernel, SwitchWhileMoving};
use kontur_filters::ring::Ring;
use kontur_filters::shaping::{self, Origin, Shaping};
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

/// Where the records of one axis go, for cycles in a row.
pub(crate) struct Records<'a> {
    /// Number of the axis.
    pub(crate) axis: usize,
    /// That of the first cycle; where no one reads each of them, that of the last one.
    pub(crate) first: &'a mut AxisRecord,
    /// Those of the cycles after it, or none.
    pub(crate) later: &'a mut [Vec<AxisRecord>],
}

impl Records<'_> {
    fn are_all_read(&self) -> bool {
        !self.later.is_empty()
    }

    fn of(&mut self, i: usize) -> &mut AxisRecord {
        match i.checked_sub(1).and_then(|i| self.later.get_mut(i)) {
            Some(axes) => &mut axes[self.axis],
            None => self.first,
        }
    }

    /// The first ones are that of the cycle before them.
    fn repeat(&mut self, count: usize) {
        for axes in self.later.iter_mut().take(count.saturating_sub(1)) {
            axes[self.axis] = *self.first;
        }
    }
}

/// Where a chain is before a row of cycles that may have to be taken back.
#[derive(Debug)]
pub(crate) struct Mark {
    shaping: shaping::Mark,
    control: AxisControl,
    /// Set position, velocity and acceleration.
    derived: [f64; 3],
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

    /// It runs no more than one cycle at a time: it awaits a stop, or what is added to its position may change.
    pub(crate) fn goes_alone(&self) -> bool {
        let filtered = |a: &AdditionalInterface| a.filter.is_some();
        self.control.goes_alone() || self.additional.as_ref().is_some_and(filtered)
    }

    /// Marks where the chain is, in the place of an earlier mark: no row can be taken back any more than to here.
    pub(crate) fn mark(&self, mark: &mut Option<Mark>) {
        let mark = mark.get_or_insert_with(|| Mark {
            shaping: shaping::Mark::default(),
            control: self.control.clone(),
            derived: [0.0; 3],
        });
        self.shaping.mark(&mut mark.shaping);
        mark.control.clone_from(&self.control);
        mark.derived = [self.set, self.vel, self.acc];
    }

    /// Takes back the last row, if it is the only one since the mark.
    pub(crate) fn return_to(&mut self, mark: &Mark) {
        self.ipo.take_back(self.moved);
        self.shaping.return_to(&mark.shaping, self.moved);
        self.control.clone_from(&mark.control);
        [self.set, self.vel, self.acc] = mark.derived;
    }

    /// Cycles in a row with these interpolated setpoints, at most [`Ring::ROOM`]. The number up to the first one in which the
    /// monitors have raised something, see [`Self::faults`]: if it is not the last one, the row has to be
    /// [taken back](Self::return_to).
    pub(crate) fn run(
        &mut self,
        ipo: &[f64],
        gain: f64,
        jerk_limited: bool,
        set: &mut Vec<f64>,
        records: &mut Records<'_>,
    ) -> usize {
        let mut rested = 0;
        self.faulty = false;
        if self.rests_under(ipo[0], gain, jerk_limited) {
            rested = ipo.iter().take_while(|x| x.to_bits() == ipo[0].to_bits()).count();
            self.shaping.rest(rested);
            records.repeat(rested);
        }
        let ipo = &ipo[rested..];
        self.moved = ipo.len();
        let Some(last) = ipo.len().checked_sub(1) else { return rested };
        self.ipo.extend(ipo);
        set.clear();
        set.extend_from_slice(ipo);
        self.shaping.run(set);
        let additional_mm = self.additional_mm();
        self.control.set_inputs(AxisInputs { additional_mm, ..self.inputs });
        let shown_from = if records.are_all_read() { 0 } else { last };
        let Self { control, ipo: past, delay, cycle_s, .. } = self;
        let mut derived = Derived::new(set, [self.set, self.vel, self.acc], *cycle_s);
        let mut faulty = false;
        let count = control.run(set, gain, jerk_limited, shown_from, |i, out| {
            let [vel, acc, jerk] = derived.at(i);
            faulty |= out.faulty;
            let err = set[i] - aligned(past, *delay, (last - i) as u32);
            *records.of(rested + i) =
                recorded([ipo[i], set[i], vel, acc, jerk, err], additional_mm, &out);
        });
        let [vel, acc, _] = derived.at(last);
        (self.set, self.vel, self.acc) = (set[last], vel, acc);
        self.faulty = faulty;
        rested + count
    }

    /// One cycle: what a row of one does, without what rows cost.
    pub(crate) fn step(
        &mut self,
        ipo: f64,
        gain: f64,
        jerk_limited: bool,
        record: &mut AxisRecord,
    ) {
        self.faulty = false;
        if self.rests_under(ipo, gain, jerk_limited) {
            self.shaping.rest(1);
            return;
        }
        self.ipo.push(ipo);
        let set = self.shaping.step(ipo);
        let vel = (set - self.set) / self.cycle_s;
        let acc = (vel - self.vel) / self.cycle_s;
        let jerk = (acc - self.acc) / self.cycle_s;
        (self.set, self.vel, self.acc) = (set, vel, acc);
        let additional_mm = self.additional_mm();
        self.control.set_inputs(AxisInputs { additional_mm, ..self.inputs });
        let out = self.control.step(set, gain, jerk_limited);
        self.faulty = out.faulty;
        let err = set - aligned(&self.ipo, self.delay, 0);
        *record = recorded([ipo, set, vel, acc, jerk, err], additional_mm, &out);
    }

    /// What the monitors have raised in the last cycle of [`Self::run`] or [`Self::step`], if anything.
    pub(crate) fn faults(&self) -> Option<&Faults> {
        self.faulty.then(|| self.control.faults())
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
}

/// The record of a cycle: interpolated setpoint, set position, its three derivatives, `err`, and what the control has made of it.
#[inline]
fn recorded(
    [ipo, set, vel, acc, jerk, err]: [f64; 6],
    additional_mm: f64,
    out: &ControlOutput,
) -> AxisRecord {
    AxisRecord {
        ipo,
        set,
        vel,
        acc,
        jerk,
        err,
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
        lag_limit: out.lag_limit_mm.unwrap_or(0.0),
        add: additional_mm,
        settling_s: out.settling_s,
        tcp: out.tcp_mm,
        tcp_acc: out.tcp_acc_mm_s2,
        // of the block, not of the axis
        target: 0.0,
        cmd_drive: out.drive.command,
        vff_drive: out.drive.feedforward,
        vadd_drive: out.drive.additive_speed,
        torque_drive: out.drive.torque,
        torque_n_m: out.drive.torque_n_m,
    }
}

/// Interpolated setpoint of the moment that the mean delay points to, `ago` cycles before the newest, linear between two samples.
fn aligned(ipo: &Ring, (whole, part): (u32, f64), ago: u32) -> f64 {
    let newer = ipo.past(whole + ago);
    if part > 0.0 { newer + part * (ipo.past(whole + 1 + ago) - newer) } else { newer }
}

/// Derivatives of set positions, asked for in rising order.
struct Derived<'a> {
    set: &'a [f64],
    cycle_s: f64,
    /// The first cycle not asked for yet; in the one before it set position, velocity, acceleration and jerk.
    next: usize,
    before_mm: f64,
    now: [f64; 3],
}

impl<'a> Derived<'a> {
    /// With set position, velocity and acceleration in the cycle before.
    fn new(set: &'a [f64], [before_mm, vel, acc]: [f64; 3], cycle_s: f64) -> Self {
        Self { set, cycle_s, next: 0, before_mm, now: [vel, acc, 0.0] }
    }

    /// Velocity, acceleration and jerk in cycle `i`: differences, of which the third reaches three cycles back.
    fn at(&mut self, i: usize) -> [f64; 3] {
        let from = self.next.max(i.saturating_sub(2));
        if from > self.next {
            self.before_mm = self.set[from - 1];
        }
        for set in &self.set[from..=i] {
            let [vel, acc, _] = self.now;
            let now = (set - self.before_mm) / self.cycle_s;
            let change = (now - vel) / self.cycle_s;
            self.now = [now, change, (change - acc) / self.cycle_s];
            self.before_mm = *set;
        }
        self.next = i + 1;
        self.now
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
