//! The cycles of one axis: one at a time, or many in a row.

use super::AxisChain;
use super::shown::ShownControl;
use crate::machine::AdditionalInterface;
use crate::record::{AxisColumns, AxisRecord, Quantity};
use kontur_filters::control::axis_control::{
    AxisControl, AxisInputs, CalmCycles, ControlOutput, Show, Shown,
};
use kontur_filters::control::fault::Faults;
use kontur_filters::ring::Ring;
use kontur_filters::shaping;
use kontur_filters::stage::Stage;

/// State of a chain before a row of cycles that may have to be undone.
#[derive(Debug)]
pub(crate) struct Mark {
    shaping: shaping::Mark,
    control: AxisControl,
    /// Set position, velocity and acceleration.
    derived: [f64; 3],
}

impl AxisChain {
    /// The additional position of this cycle; 0 if the interface is off.
    fn additional_mm(&mut self) -> f64 {
        let x = self.inputs.additional_mm;
        let additional_mm = match &mut self.additional {
            None => 0.0,
            Some(AdditionalInterface { filter: None }) => x,
            Some(AdditionalInterface { filter: Some(filter) }) => filter.step(x),
        };
        additional_mm + self.wear_mm
    }

    /// Whether only single cycles are possible: a stop is awaited, or the additional position may change.
    pub(crate) fn goes_alone(&self) -> bool {
        let filtered = |a: &AdditionalInterface| a.filter.is_some();
        self.control.goes_alone() || self.additional.as_ref().is_some_and(filtered)
    }

    /// Saves the state of the chain, replacing an earlier mark; rows before it can no longer be undone.
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

    /// Undoes the last row, which must be the only one since the mark.
    pub(crate) fn return_to(&mut self, mark: &Mark) {
        self.ipo.take_back(self.moved);
        self.shaping.return_to(&mark.shaping, self.moved);
        self.control.clone_from(&mark.control);
        [self.set, self.vel, self.acc] = mark.derived;
    }

    /// Runs a row of cycles with these interpolated setpoints, at most [`Ring::ROOM`]. Returns the number of cycles up
    /// to the first one in which the monitors raised a fault, see [`Self::faults`]. If it is not the last one, the row
    /// has to be [undone](Self::return_to).
    ///
    /// Requested quantities of each cycle are written to the columns; the record of the last cycle replaces that of the
    /// previous one.
    pub(crate) fn run(
        &mut self,
        ipo: &[f64],
        gain: f64,
        jerk_limited: bool,
        set: &mut Vec<f64>,
        record: &mut AxisRecord,
        mut columns: AxisColumns<'_>,
    ) -> usize {
        let mut rested = 0;
        (self.faulty, self.act_step) = (false, 0.0);
        if self.rests_under(ipo[0], gain, jerk_limited) {
            rested = ipo.iter().take_while(|x| x.to_bits() == ipo[0].to_bits()).count();
            self.shaping.rest(rested);
            columns.fill(record, rested);
            columns.skip(rested);
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
        self.show(ipo, set, additional_mm, &mut columns);
        let Self { control, ipo: past, delay, cycle_s, .. } = self;
        let derived = Derived::new(set, [self.set, self.vel, self.acc], *cycle_s);
        let end = End { ipo, past, delay: *delay, derived, additional_mm, record };
        let shown = ShownControl::of(&mut columns, ipo.len());
        let shown_from = if shown.is_some() { 0 } else { last.saturating_sub(1) };
        let act = [end.record.act; 2];
        let mut seen = Seen { shown, end, act, last, faulty: false };
        let count = control.run(set, gain, jerk_limited, shown_from, &mut seen);
        let Seen { end, act, faulty, .. } = seen;
        let mut derived = end.derived;
        let [vel, acc, _] = derived.at(last);
        (self.set, self.vel, self.acc) = (set[last], vel, acc);
        self.act_step = act[1] - act[0];
        self.faulty = faulty;
        rested + count
    }

    /// Writes the requested columns of the quantities before the control.
    fn show(&self, ipo: &[f64], set: &[f64], additional_mm: f64, columns: &mut AxisColumns<'_>) {
        let n = ipo.len();
        for (quantity, values) in [(Quantity::Ipo, ipo), (Quantity::Set, set)] {
            if let Some(column) = columns.of(quantity) {
                column[..n].copy_from_slice(values);
            }
        }
        for (quantity, x) in
            [(Quantity::Add, additional_mm), (Quantity::Dev, 0.0), (Quantity::DevBothWays, 0.0)]
        {
            if let Some(column) = columns.of(quantity) {
                column[..n].fill(x);
            }
        }
        let derivatives = [Quantity::Vel, Quantity::Acc, Quantity::Jerk];
        if let Some([vel, acc, jerk]) = columns.together(derivatives, n) {
            differences(set, self.set, self.cycle_s, vel);
            differences(vel, self.vel, self.cycle_s, acc);
            differences(acc, self.acc, self.cycle_s, jerk);
        }
        if let Some(column) = columns.of(Quantity::Err) {
            let (whole, part) = self.delay;
            let newer = set.iter().zip(self.ipo.recent(n, whole));
            if part > 0.0 {
                let both = newer.zip(self.ipo.recent(n, whole + 1));
                for (err, ((set, newer), older)) in column.iter_mut().zip(both) {
                    *err = set - (newer + part * (older - newer));
                }
            } else {
                for (err, (set, newer)) in column.iter_mut().zip(newer) {
                    *err = set - newer;
                }
            }
        }
    }

    /// One cycle: the same as a row of one, at lower cost.
    pub(crate) fn step(
        &mut self,
        ipo: f64,
        gain: f64,
        jerk_limited: bool,
        record: &mut AxisRecord,
    ) {
        (self.faulty, self.act_step) = (false, 0.0);
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
        self.act_step = out.act_mm - record.act;
        let err = set - aligned(&self.ipo, self.delay, 0);
        *record = recorded([ipo, set, vel, acc, jerk, err], additional_mm, &out);
    }

    /// Faults that the monitors raised in the last cycle of [`Self::run`] or [`Self::step`], if any.
    pub(crate) fn faults(&self) -> Option<&Faults> {
        self.faulty.then(|| self.control.faults())
    }

    /// Whether a cycle with these values would leave the record of the last one unchanged.
    ///
    /// Sampled setpoints and differences have a shorter memory than the kernel and the rest of the control.
    fn rests_under(&self, ipo: f64, gain: f64, jerk_limited: bool) -> bool {
        // a moving axis fails here
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

/// What a row leaves of its cycles.
struct Seen<'a> {
    shown: Option<ShownControl<'a>>,
    end: End<'a>,
    /// Actual positions of the last two cycles.
    act: [f64; 2],
    last: usize,
    faulty: bool,
}

impl Show for &mut Seen<'_> {
    #[inline]
    fn cycle(&mut self, i: usize, cycle: &Shown<'_>) {
        if let Some(shown) = &mut self.shown {
            shown.put(i, cycle);
        }
        self.act = [self.act[1], cycle.act_mm];
        if i == self.last || cycle.faulty {
            self.faulty |= cycle.faulty;
            self.end.put(i, &cycle.output());
        }
    }

    fn calm(&mut self, first: usize, cycles: &CalmCycles<'_>) {
        if let Some(shown) = &mut self.shown {
            shown.put_calm(first, cycles);
        }
        let newest = cycles.len().saturating_sub(2);
        for [_, act_mm, ..] in cycles.positions_mm().skip(newest) {
            self.act = [self.act[1], act_mm];
        }
    }
}

/// The record of the last cycle of a row.
struct End<'a> {
    ipo: &'a [f64],
    /// Interpolated setpoints up to the last one of the row.
    past: &'a Ring,
    delay: (u32, f64),
    derived: Derived<'a>,
    additional_mm: f64,
    record: &'a mut AxisRecord,
}

impl End<'_> {
    /// Fills the record with cycle `i`.
    #[inline(never)]
    fn put(&mut self, i: usize, out: &ControlOutput) {
        let [vel, acc, jerk] = self.derived.at(i);
        let set = self.derived.set[i];
        let later = self.ipo.len() - 1 - i;
        let err = set - aligned(self.past, self.delay, later as u32);
        let of_cycle = [self.ipo[i], set, vel, acc, jerk, err];
        *self.record = recorded(of_cycle, self.additional_mm, out);
    }
}

/// Differences of successive values per second; `before` is the value in the cycle before the first.
fn differences(of: &[f64], before: f64, cycle_s: f64, out: &mut [f64]) {
    let [first, others @ ..] = out else { return };
    *first = (of[0] - before) / cycle_s;
    for (out, pair) in others.iter_mut().zip(of.windows(2)) {
        *out = (pair[1] - pair[0]) / cycle_s;
    }
}

/// The record of a cycle: interpolated setpoint, set position with its three derivatives, `err`, and the output of the
/// control.
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
        // set by the block, not by the axis
        target: 0.0,
        cmd_drive: out.drive.command,
        vff_drive: out.drive.feedforward,
        vadd_drive: out.drive.additive_speed,
        torque_drive: out.drive.torque,
        torque_n_m: out.drive.torque_n_m,
    }
}

/// Interpolated setpoint at the time given by the mean delay, `ago` cycles before the newest, linear between two
/// samples.
fn aligned(ipo: &Ring, (whole, part): (u32, f64), ago: u32) -> f64 {
    let newer = ipo.past(whole + ago);
    if part > 0.0 { newer + part * (ipo.past(whole + 1 + ago) - newer) } else { newer }
}

/// Derivatives of set positions, read in increasing order.
struct Derived<'a> {
    set: &'a [f64],
    cycle_s: f64,
    /// The first cycle that has not been read; the values of the cycle before it follow.
    next: usize,
    before_mm: f64,
    now: [f64; 3],
}

impl<'a> Derived<'a> {
    /// Starts with set position, velocity and acceleration in the previous cycle.
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
