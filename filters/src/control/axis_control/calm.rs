//! Calm cycles: those of a moving axis on which nothing acts but its position controller, and of which no monitor has anything to
//! say. Almost all cycles of a program are like that.
//!
//! A row asks once which parts of the axis are off, and what its cycles change is kept in registers up to the end of the row. A
//! cycle that turns out not to be calm is left, before anything of it has happened, to the way of all other cycles, which gives the
//! same bits.

use super::AxisControl;
use super::cycle::Row;
use super::shown::{CalmCycle, CalmCycles, Show};
use crate::control::{
    buffer::SetpointBuffer, monitor::LagMonitor, plant::Apart, position::PositionLoop,
};

/// The input of the position controller in the cycles of a row.
struct References<'a> {
    /// What the buffer holds before the row, and by how many cycles it delays.
    waiting_mm: [f64; SetpointBuffer::CAPACITY],
    delay: usize,
    set_mm: &'a [f64],
    additional_mm: f64,
}

impl References<'_> {
    /// That of cycle `i`.
    #[inline]
    fn mm(&self, i: usize) -> f64 {
        match i.checked_sub(self.delay) {
            Some(i) => self.set_mm[i] + self.additional_mm,
            None => self.waiting_mm[i % SetpointBuffer::CAPACITY],
        }
    }
}

/// The bounds within which a cycle is calm.
struct Bounds {
    /// Following errors in mm.
    lag_mm: f64,
    /// Following error in mm below which an axis whose reference rests gets no command.
    suppressed_mm: f64,
    /// Speed command in mm/s.
    command_mm_s: f64,
    /// Actual positions in mm, from the first to the last one.
    range_mm: (f64, f64),
}

impl AxisControl {
    /// The bounds of calm cycles of a plain axis. `None` if there are none, because actual positions are rounded, the gain changes, or
    /// a monitor needs every cycle.
    fn bounds(&self) -> Option<Bounds> {
        let config = &self.config;
        let calm = config.position.dynamic_kv.is_none()
            && config.increment_mm <= 0.0
            && !self.lag.needs_every_cycle()
            && !self.limiter.is_active()
            && !self.diverged;
        self.range.inside_mm().filter(|_| calm).map(|range_mm| Bounds {
            lag_mm: self.unstable_mm,
            suppressed_mm: config.position.suppressed_mm(),
            command_mm_s: self.limiter.lets_by_mm_s(),
            range_mm,
        })
    }

    /// Steps a plain axis by the first cycles of a row, except the last one, as far as they are calm; their number.
    #[inline] // the output is large: used where it is made
    pub(super) fn calm_cycles<const N: usize>(
        &mut self,
        row: &Row<'_>,
        apart: &mut Apart<N>,
        show: &mut impl Show,
    ) -> usize {
        let (inputs, kv_per_s) = (self.inputs, self.config.position.kv_per_s);
        let Some(bounds) = self.bounds() else { return 0 };
        let Some(mut plant) = apart.rigid_row(inputs.force_mm_s2) else { return 0 };
        let (format, cycle_s) = (self.config.command_format, self.cycle_s);
        let in_drive = self.config.position.closed_in == PositionLoop::Drive;
        // without an additive speed
        let felt = |mm_s: f64| (if in_drive { mm_s } else { format.sent(mm_s, cycle_s) }) + 0.0;
        let references = References {
            waiting_mm: self.buffer.waiting_mm(),
            delay: self.buffer.delay_cycles(),
            set_mm: row.set_mm,
            additional_mm: inputs.additional_mm,
        };
        let (mut set_before, mut reference_before_mm) =
            (self.given.set, self.buffer.reference_mm());
        let mut tcp_mm_s = self.tcp_mm_s;
        let mut count = 0;
        let (mut cycles, mut before_mm_s) = (std::mem::take(&mut self.calm), tcp_mm_s);
        let most = row.set_mm.len() - 1;
        for (i, set_mm) in row.set_mm[..most].iter().enumerate() {
            let (motor_mm, motor_mm_s) = (plant.motor_mm, plant.motor_mm_s);
            let actual_mm = motor_mm + inputs.encoder_offset_mm;
            let reference_mm = references.mm(i);
            let lag_mm = reference_mm - actual_mm;
            // without feedforward and additive speed, which turns -0 into 0
            let command_mm_s = kv_per_s * lag_mm + 0.0;
            let moves = (reference_mm - reference_before_mm).abs() > 0.0;
            // rest begins where set position and speed stay the same: it is counted, because an axis at rest is not computed at all
            let goes_on =
                set_mm.to_bits() != set_before || motor_mm_s.to_bits() != tcp_mm_s.to_bits();
            let calm = goes_on
                && lag_mm.abs() <= bounds.lag_mm
                && (lag_mm.abs() >= bounds.suppressed_mm || moves)
                && command_mm_s.abs() <= bounds.command_mm_s
                && actual_mm >= bounds.range_mm.0
                && actual_mm <= bounds.range_mm.1;
            if !calm || !plant.advance(felt(command_mm_s)) {
                break;
            }
            if i <= row.shown_from {
                before_mm_s = tcp_mm_s;
            }
            if i >= row.shown_from {
                cycles.push(CalmCycle {
                    reference_mm,
                    actual_mm,
                    motor_mm,
                    motor_mm_s,
                    command_mm_s,
                });
            }
            (set_before, reference_before_mm) = (set_mm.to_bits(), reference_mm);
            tcp_mm_s = motor_mm_s;
            count = i + 1;
        }
        if !cycles.is_empty() {
            show.calm(row.shown_from, &CalmCycles { axis: self, cycles: &cycles, before_mm_s });
            cycles.clear();
        }
        self.calm = cycles;
        if count > 0 {
            apart.take(&plant, count);
            self.pass(row, &references, count, tcp_mm_s);
        }
        count
    }

    /// Takes the first cycles of a row, which were calm; `tcp_mm_s` is the speed of the tool point at the start of the last one.
    fn pass(&mut self, row: &Row<'_>, references: &References<'_>, count: usize, tcp_mm_s: f64) {
        let last = count - 1;
        let (set_mm, additional_mm) = (row.set_mm, references.additional_mm);
        let position_mm = |set_mm: &f64| set_mm + additional_mm;
        let before_mm = last.checked_sub(1).map_or(self.position_mm, |i| position_mm(&set_mm[i]));
        (self.set_mm, self.position_mm) = (set_mm[last], position_mm(&set_mm[last]));
        self.moving = (self.position_mm - before_mm).abs() > 0.0;
        self.buffer.pass(set_mm[..count].iter().map(position_mm), row.jerk_limited);
        // of those before the last ones of the row nothing is remembered
        let from = set_mm.len().saturating_sub(LagMonitor::MEMORY).min(count);
        for i in from..count {
            self.lag.remember(references.mm(i));
        }
        self.given.set = set_mm[last].to_bits();
        (self.tcp_mm_s, self.still_cycles) = (tcp_mm_s, 0);
    }
}
