//! Changes of a running axis: new parameters, or a new value for its present position.

use super::AxisControl;

impl AxisControl {
    /// Takes over the state of the axis that this one replaces, at the same position and under the same inputs.
    ///
    /// Parts with the same configuration keep their state; if the whole configuration is the same, nothing changes.
    /// Other parts begin at rest, a different plant at the position of the motor.
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
        // limits of the program stay in force
        self.range = before.range.clone();
        self.exact_stop.take_over(&before.exact_stop);
        self.tcp_mm_s = before.tcp_mm_s;
        self.diverged = before.diverged;
        self.moving = before.moving;
        self.open = before.open;
        self.held_mm = before.held_mm;
    }

    /// Shifts the coordinate of the present position by `by_mm`; nothing moves.
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

    /// Shifts the set position at rest by `by_mm`; the axis follows at the pace of its controller. The monitors of the
    /// set position see no motion.
    pub fn command(&mut self, by_mm: f64) {
        self.exact_stop.shift(by_mm);
        self.setpoint.shift(by_mm);
        self.set_mm += by_mm;
        self.still_cycles = 0;
    }
}
