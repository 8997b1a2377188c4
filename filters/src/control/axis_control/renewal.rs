//! Changes of a running axis: new parameters, or a new position for the place where it is.

use super::AxisControl;

impl AxisControl {
    /// Continues where another axis is whose place this one takes: in the same place and under the same inputs.
    ///
    /// Each part that is configured alike keeps its state; with the same configuration nothing changes at all. Others begin at
    /// rest, another plant where the motor is.
    pub fn take_over(&mut self, before: &Self) {
        self.start_with(before.set_mm, before.inputs);
        let (old, new) = (&before.config, &self.config);
        if old.plant == new.plant {
            self.plant = before.plant.clone();
        } else {
            self.plant.start(before.plant.measured().motor_mm);
        }
        if self.buffer.holds_like(&before.buffer) {
            self.buffer = before.buffer.clone();
        }
        if old.feedforward == new.feedforward {
            self.feedforward = before.feedforward.clone();
        }
        if old.position == new.position {
            self.limiter = before.limiter;
        }
        if old.ipc == new.ipc {
            self.ipc = before.ipc.clone();
        }
        if old.lag == new.lag {
            self.lag = before.lag.clone();
        }
        if old.setpoint == new.setpoint {
            self.setpoint = before.setpoint.clone();
        }
        self.exact_stop.take_over(&before.exact_stop);
        self.tcp_mm_s = before.tcp_mm_s;
        self.diverged = before.diverged;
        self.moving = before.moving;
        self.open = before.open;
        self.held_mm = before.held_mm;
    }

    /// The place where the axis is gets another position, `by_mm` further on: nothing moves.
    pub fn shift(&mut self, by_mm: f64) {
        self.buffer.shift(by_mm);
        self.plant.shift(by_mm);
        self.lag.shift(by_mm);
        self.exact_stop.shift(by_mm);
        self.setpoint.shift(by_mm);
        self.set_mm += by_mm;
        self.position_mm += by_mm;
        if let Some(held_mm) = &mut self.held_mm {
            *held_mm += by_mm;
        }
        self.still_cycles = 0;
    }

    /// The set position at rest becomes another one, `by_mm` further on, to which the axis moves as its controller lets it: what
    /// watches the set position does not see a motion.
    pub fn command(&mut self, by_mm: f64) {
        self.exact_stop.shift(by_mm);
        self.setpoint.shift(by_mm);
        self.set_mm += by_mm;
        self.still_cycles = 0;
    }
}
