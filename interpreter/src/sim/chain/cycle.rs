//! The cycles of one axis: one at a time, or many in a row.

use super::AxisChain;
use crate::machine::AdditionalInterface;
use crate::record::AxisRecord;
use kontur_filters::control::axis_control::{AxisControl, AxisInputs, ControlOutput};
use kontur_filters::control::fault::Faults;
use kontur_filters::ring::Ring;
use kontur_filters::shaping;
use kontur_filters::stage::Stage;

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

impl AxisChain {
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
