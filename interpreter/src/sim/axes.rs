//! One cycle through all axes: from the setpoints of path and spindles to the records.

use super::driver::Driver;
use super::spindle::Spindle;
use super::state::{Phase, Simulation};
use crate::exec::SourceRef;
use crate::record::{CycleRecord, PathRecord, Rest, RowBuffer};
use kontur_motion::ahead::Row;

impl Simulation {
    /// Block that the cycle belongs to. Waits for the remainder of a motion belong to its block, as long as no other
    /// block has had cycles since; a path that still rests after such cycles stays in the block that had them.
    fn block_of_cycle(&self) -> SourceRef {
        let is_over = self.blocks.shown != self.blocks.current || self.blocks.current.line == 0;
        match &self.phase {
            Phase::Waiting(wait) if is_over || wait.is_of_its_own_block() => self.blocks.waits_at,
            Phase::Running if self.is_held || self.blocks.left => self.blocks.shown,
            Phase::Stopping(stopping) => stopping.waited_at.unwrap_or(self.blocks.current),
            _ => self.blocks.current,
        }
    }

    /// Enters the blocks up to number `seq` at a path length, with all events in cycle `k` before the axes move.
    pub(super) fn enter_blocks(&mut self, seq: u64, s_mm: f64, k: u64) {
        while self.queue.underway.front().is_some_and(|u| u.seq <= seq) {
            if let Some(block) = self.queue.underway.pop_front() {
                let changed = &mut self.smoothing.changed;
                self.progress.begin(block.programmed, s_mm, changed);
                // the block began after the previous cycle
                self.time_begins(block.time_s, block.source, k.saturating_sub(1));
                (self.blocks.current, self.blocks.left) = (block.source, false);
                self.motion = block.motion;
                for (target, driver) in self.targets.iter_mut().zip(&self.chains.drivers) {
                    if let Driver::Path(p) = driver {
                        *target = block.target[*p] + self.independent.done_mm(*p);
                    }
                }
                self.jerk_limited = block.jerk_limited;
                for event in block.events {
                    self.act(event, k.saturating_sub(1));
                }
            }
        }
    }

    /// Passes the setpoint of the cycle through every axis and fills the record, together with up to `most` further
    /// cycles as far as nothing but the path moves, see [`super::batch`]. Requested columns of the axes go to `rows`.
    pub(super) fn through_the_axes(&mut self, most: usize, rows: Option<&mut RowBuffer>) {
        let (k, seq) = (self.planner.setpoint().k, self.planner.setpoint().seq);
        self.enter_blocks(seq, self.record.path.s_mm, k);
        self.take_inputs(k);
        self.watch_thread();
        self.watch_time();
        let alone = !self.independent.is_unused();
        if alone {
            self.independent.take_over(k);
        }
        let setpoint = self.planner.setpoint();
        let ds = setpoint.s_mm - self.record.path.s_mm;
        let mut positions = setpoint.position.clone();
        for (p, position) in positions.iter_mut().enumerate() {
            *position += if alone { self.independent.way_mm(p, k) } else { 0.0 };
        }
        if alone {
            self.independent.follow(&mut positions);
        }
        self.spindles.iter_mut().for_each(|s| s.cut(&positions));
        for (degrees, spindle) in self.spindle_deg.iter_mut().zip(&mut self.spindles) {
            *degrees = spindle.step(&positions, self.cycle);
        }
        if !self.wear.is_unused() {
            let axes = &self.machine.axes;
            let limit = |axis: usize| axes[axis].dynamics().a_max_mm_s2;
            let t = self.cycle.seconds();
            self.wear.step((&self.path_position, &positions), ds, limit, t);
            for (chain, driver) in self.chains.driven() {
                if let Driver::Path(p) = driver {
                    chain.set_wear(self.wear.offset_mm(p));
                }
            }
        }
        self.path_position.copy_from_slice(&positions);
        if alone {
            self.expect_independent_stops();
        }
        for (i, (chain, driver)) in self.chains.driven().enumerate() {
            if let Driver::Spindle(s) = driver
                && let Some(target_deg) = self.spindles[s].take_target()
            {
                chain.expect_stop(target_deg);
                self.blocks.stops_at[i] = self.blocks.current;
            }
        }
        self.run_chains(most, rows);
        self.end_cycle();
    }

    /// An independent axis is monitored from the end of its motion, whatever the path does. Source: TF5200 position
    /// monitoring: from when the axis is no longer interpolated.
    fn expect_independent_stops(&mut self) {
        for axis in 0..self.path_position.len() {
            let Some(source) = self.independent.take_ended(axis) else { continue };
            // an axis that a fault stops does not arrive anywhere
            if matches!(self.phase, Phase::Stopping(_)) {
                continue;
            }
            for (i, (chain, driver)) in self.chains.driven().enumerate() {
                if driver == Driver::Path(axis) {
                    chain.expect_stop(self.path_position[axis]);
                    self.blocks.stops_at[i] = source;
                }
            }
        }
    }

    /// The record is that of cycle `k`, in which nothing but the path and its block differ from the one before, apart from the
    /// axes.
    pub(super) fn pass(&mut self, k: u64, path: Row) {
        let at = if self.blocks.left { self.blocks.shown } else { self.blocks.current };
        let CycleRecord { path: record, .. } = &mut self.record;
        *record = PathRecord {
            s_mm: path.s_mm,
            v_mm_s: path.v_mm_s,
            a_mm_s2: path.a_mm_s2,
            j_mm_s3: path.j_mm_s3,
            limit: path.limit,
            motion: self.motion,
            ..*record
        };
        (self.record.k, self.record.file) = (k, at.file);
        (self.record.line, self.record.block) = (at.line, at.block);
    }

    /// Completes the record of a cycle whose axes have been computed.
    pub(super) fn end_cycle(&mut self) {
        for (record, target) in self.record.axes.iter_mut().zip(&self.targets) {
            record.target = *target;
        }
        let setpoint = self.planner.setpoint();
        self.record.k = setpoint.k;
        let rest = match &self.phase {
            Phase::Waiting(wait) => Some(wait.rest()),
            Phase::Running if self.is_held => Some(Rest::Held),
            _ => None,
        };
        let at = self.block_of_cycle();
        self.blocks.left |= matches!(self.phase, Phase::Waiting(_)) && at != self.blocks.current;
        self.blocks.shown = at;
        self.record.file = at.file;
        self.record.line = at.line;
        self.record.block = at.block;
        self.record.path = PathRecord {
            s_mm: setpoint.s_mm,
            v_mm_s: setpoint.v_mm_s,
            a_mm_s2: setpoint.a_mm_s2,
            j_mm_s3: setpoint.j_mm_s3,
            limit: setpoint.limit,
            motion: self.motion,
            spindle: self.tapping_spindle(),
            rest,
        };
        if !self.planner.reports_changes() {
            self.record.omit_deviation(self.path_position.len());
        }
        for unkept in self.planner.take_unkept() {
            self.unkept(&unkept);
        }
        if !self.batch.is_pending() {
            for (i, f) in std::mem::take(&mut self.batch.faults) {
                self.fault(i, &f);
            }
        }
    }

    /// The spindle that follows the path, by its index in the record.
    fn tapping_spindle(&self) -> Option<u8> {
        let spindle = self.spindles.iter().position(Spindle::follows)?;
        u8::try_from(self.chains.of_spindle(spindle)?).ok()
    }
}
