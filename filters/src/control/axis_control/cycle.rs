//! One cycle of an axis, or many in a row: from the set position to the drive, the monitors and the plant.

use super::given::Given;
use super::shown::{Seen, Show, Shown};
use super::{AxisControl, ControlOutput, Encoder};
use crate::control::RANGE_MM;
use crate::control::{
    buffer::Setpoint,
    fault::Fault,
    feedforward::FeedforwardOutput,
    ipc::{IpcInput, IpcOutput},
    monitor::LagMonitor,
    plant::{FewStates, InAxis, Measured, PlantInput, PlantOfRow},
    position::PositionLoop,
};

/// Cycles of an axis under the same inputs, gain and slope.
pub(super) struct Row<'a> {
    pub(super) set_mm: &'a [f64],
    gain: f64,
    pub(super) jerk_limited: bool,
    /// The first cycle whose output is shown.
    pub(super) shown_from: usize,
}

impl AxisControl {
    /// Position that the controller, the monitors and the exact stop see.
    pub(super) fn controlled_mm(&self) -> f64 {
        self.seen_mm(self.plant.measured())
    }

    /// The same for these actual values.
    #[inline]
    fn seen_mm(&self, measured: &Measured) -> f64 {
        let true_mm = match self.config.encoder {
            Encoder::Motor => measured.motor_mm,
            Encoder::Direct => measured.load_mm,
        };
        self.read_mm(true_mm + self.inputs.encoder_offset_mm)
    }

    /// A position as the measuring system of the position loop reads it.
    ///
    /// Assumption: the nearest increment, counted from the machine's zero; homing removes any constant part.
    pub(super) fn read_mm(&self, mm: f64) -> f64 {
        let step_mm = self.config.increment_mm;
        if step_mm > 0.0 { (mm / step_mm).round() * step_mm } else { mm }
    }

    /// Steps the axis by one cycle: set position after filters or Vibration Guard, feedforward gain of this motion
    /// ([`gain`](crate::control::feedforward::FeedforwardConfig::gain); 0 when off) and whether its slope is
    /// jerk-limited.
    ///
    /// A set position beyond [`RANGE_MM`] (or not a number) counts as standstill.
    #[inline] // the output is large: used where it is made
    pub fn step(&mut self, set_mm: f64, gain: f64, jerk_limited: bool) -> ControlOutput {
        let mut output = ControlOutput::default();
        self.run(&[set_mm], gain, jerk_limited, 0, |_: usize, shown: &Shown<'_>| {
            output = shown.output();
        });
        output
    }

    /// Steps the axis by many cycles under the same inputs, gain and slope, each as [`Self::step`], at least one.
    /// Returns the number of cycles up to the first one in which the monitors raise a fault or may do so. If it is not
    /// the last one, some parts of the axis are already ahead of it, and the axis has to be restored to its earlier
    /// state.
    ///
    /// `show` receives the cycles from number `shown_from` on, and of a cycle with a fault.
    #[inline] // the output is large: used where it is made
    pub fn run(
        &mut self,
        set_mm: &[f64],
        gain: f64,
        jerk_limited: bool,
        shown_from: usize,
        mut show: impl Show,
    ) -> usize {
        self.faults.clear();
        let set_by_set = !self.exact_stop.rests();
        let count = match set_mm.len() {
            0 => return 0,
            1 => 1,
            _ if set_by_set => 1,
            most => most.min(self.setpoint.quiet(set_mm) + 1),
        };
        self.setpoint.pass(&set_mm[..count - 1]);
        let row = Row { set_mm: &set_mm[..count], gain, jerk_limited, shown_from };
        if count == 1 || !self.is_plain(gain) {
            return self.cycles::<false, _>(&row, 0, InAxis, &mut show).0;
        }
        match self.plant.few_states() {
            None => self.cycles::<true, _>(&row, 0, InAxis, &mut show).0,
            Some(FewStates::Two(mut plant)) => {
                let calm = self.calm_cycles(&row, &mut plant, &mut show);
                let (count, plant) = self.cycles::<true, _>(&row, calm, plant, &mut show);
                self.plant.put_back(FewStates::Two(plant));
                count
            }
            Some(FewStates::Three(mut plant)) => {
                let calm = self.calm_cycles(&row, &mut plant, &mut show);
                let (count, plant) = self.cycles::<true, _>(&row, calm, plant, &mut show);
                self.plant.put_back(FewStates::Three(plant));
                count
            }
        }
    }

    /// Whether only the controller acts on the plant: no feedforward, no additive speed, no stop that is awaited.
    fn is_plain(&self, gain: f64) -> bool {
        let no_feedforward = self.buffer.is_without_gain() && self.feedforward.needs_gain();
        no_feedforward
            && gain.to_bits() == 0
            && self.ipc.is_off()
            && self.exact_stop.rests()
            && self.held_mm.is_none()
            && !self.open
    }

    /// Steps the axis by the cycles of a row from number `first` on, up to the first one with a fault; the number of cycles,
    /// those before included. With `PLAIN` the axis [is so](Self::is_plain), and parts that are off are not asked in every cycle.
    #[inline] // the output is large: used where it is made
    fn cycles<const PLAIN: bool, P: PlantOfRow>(
        &mut self,
        row: &Row<'_>,
        first: usize,
        mut plant: P,
        show: &mut impl Show,
    ) -> (usize, P) {
        let Row { gain, jerk_limited, shown_from, .. } = *row;
        let count = row.set_mm.len();
        let (inputs, cycle_s, position) = (self.inputs, self.cycle_s, self.config.position);
        let encoder = self.config.encoder;
        let mut given = Given::new(gain, jerk_limited, &inputs);
        let same = given.is_like(&self.given);
        given.set = self.given.set;
        let set_by_set = !PLAIN && !self.exact_stop.rests();
        let calm = self.ipc.is_off() && !self.diverged && !set_by_set;
        for (i, set_mm) in row.set_mm.iter().copied().enumerate().skip(first) {
            let last = i + 1 == count;
            let before = std::mem::replace(&mut given.set, set_mm.to_bits());
            let set_mm = if set_mm.abs() <= RANGE_MM { set_mm } else { self.set_mm };
            let position_mm = set_mm + inputs.additional_mm;
            self.moving = (position_mm - self.position_mm).abs() > 0.0;
            (self.set_mm, self.position_mm) = (set_mm, position_mm);
            let measured = *plant.measured(&self.plant);
            let actual_mm = self.seen_mm(&measured);

            let last_reference_mm = self.buffer.reference_mm();
            self.buffer.push(Setpoint { position_mm, gain, jerk_limited });
            let mut reference_mm = self.buffer.reference_mm();
            let mut reference_step_mm = reference_mm - last_reference_mm;
            if !PLAIN && let Some(held_mm) = self.held_mm {
                (reference_mm, reference_step_mm) = (held_mm, 0.0);
            }
            let kv = position.gain_at(reference_step_mm / cycle_s);
            let error_mm =
                position.error_mm(reference_mm - actual_mm, reference_step_mm.abs() <= 0.0);
            let mut feedforward =
                if PLAIN { FeedforwardOutput::default() } else { self.fed_forward(kv) };
            let mut wanted = kv * error_mm + feedforward.speed_mm_s;
            let mut additive = IpcOutput::default();
            if !PLAIN {
                additive = self.ipc.step(&IpcInput {
                    motor_mm_s: measured.motor_mm_s,
                    direct_mm_s: (encoder == Encoder::Direct).then_some(measured.load_mm_s),
                    command_mm_s: wanted,
                });
                if self.open {
                    (feedforward, additive) = Default::default();
                    wanted = 0.0;
                }
            }
            let (command_mm_s, speed_fault) = self.limiter.step(wanted + additive.speed_mm_s);

            if last {
                self.setpoint.step(set_mm, &mut self.faults);
            }
            self.faults.push(speed_fault);
            if last || self.lag.needs_every_cycle() || i + LagMonitor::MEMORY >= count {
                self.faults.push(self.lag.step(reference_mm, actual_mm, kv));
            }
            self.faults.push(self.range.step(actual_mm));
            if set_by_set {
                let late = self.exact_stop.step(set_mm, actual_mm - inputs.additional_mm);
                // an axis that a reaction holds does not arrive; the reaction has been reported already
                self.faults.push(late.filter(|_| self.held_mm.is_none()));
            }
            if !PLAIN && !self.ipc.is_off() {
                let driven = reference_step_mm.abs() > 0.0 || i == 0 && !same;
                self.faults.push(self.ipc.swings(&additive, driven));
            }
            let unstable = self.advance(
                &mut plant,
                PlantInput {
                    speed_mm_s: self.felt_mm_s(command_mm_s, feedforward.additive_speed_mm_s),
                    acc_mm_s2: self.felt_mm_s2(feedforward.additive_acc_mm_s2),
                    force_mm_s2: inputs.force_mm_s2,
                    reference_mm,
                },
                reference_mm - actual_mm,
            );
            self.faults.push(unstable);
            if !PLAIN && self.open {
                self.faults.clear();
            }
            let faulty = !self.faults.is_empty();
            let as_before = before == given.set && (same || i > 0);
            // a moving plant rules out most cycles at once
            let rests = plant.rests(&self.plant) && as_before && calm && !faulty;
            self.count_still(rests);

            let tcp_before_mm_s = std::mem::replace(&mut self.tcp_mm_s, measured.tcp_mm_s);
            if faulty || i >= shown_from || last {
                let seen = Seen {
                    reference_mm,
                    actual_mm,
                    measured,
                    tcp_before_mm_s,
                    feedforward,
                    command_mm_s,
                    additive,
                    faulty,
                };
                show.cycle(i, &Shown::of(self, &seen));
            }
            if faulty {
                self.given = given;
                return (i + 1, plant);
            }
        }
        if !set_by_set {
            self.exact_stop.pass(row.set_mm);
        }
        self.given = given;
        (count, plant)
    }

    /// Output of the feedforward in this cycle.
    #[inline]
    fn fed_forward(&mut self, kv_per_s: f64) -> FeedforwardOutput {
        if self.buffer.is_without_gain() && self.feedforward.needs_gain() {
            return FeedforwardOutput::default();
        }
        let output = self.feedforward.step(&self.buffer.window(), kv_per_s);
        if self.held_mm.is_some() { FeedforwardOutput::default() } else { output }
    }

    /// Advances the plant unless it has diverged; a diverged plant is held at its last finite position.
    #[inline]
    fn advance(
        &mut self,
        plant: &mut impl PlantOfRow,
        input: PlantInput,
        lag_mm: f64,
    ) -> Option<Fault> {
        if self.diverged {
            return None;
        }
        let limit_mm = self.unstable_mm;
        if lag_mm.abs() <= limit_mm && plant.advance(&mut self.plant, input) {
            return None;
        }
        self.diverged = true;
        Some(Fault::Unstable { lag_mm, limit_mm })
    }

    /// Speed that the drive follows: the value it was sent, in its format.
    ///
    /// A drive that closes the position loop itself generates its own command.
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
}
