//! Cycles in a row: where nothing but the path moves, the axes are computed one after the other over many cycles.
//!
//! Most cycles of a program follow from what is already planned: no event of a block, no input, no wait lies between them, and
//! no axis asks what another one does. Their setpoints are read as columns ([`Ahead`]), and each chain runs over its own column
//! before the next one starts: its code and its state stay in the processor, and of what it gives only those columns are written
//! that somebody reads. Then the cycles are taken together: path and blocks are in the row of each what they would have been alone,
//! and all that remains in the simulation is the last one. A single cycle is a step of the chain, which does what a row of one does.
//!
//! A fault ends the row with the cycle that raised it. Chains that are already beyond that cycle are restored to their
//! state before the row and run again up to it.
//!
//! Cycles are computed singly while something that changes from cycle to cycle acts on the axes or depends on them:
//! waits, feedhold at rest, independent axes, threads, probes, wear, spindles that position or follow the path, exact
//! stops.

use super::SettledStop;
use super::driver::Driver;
use super::out::Samples;
use super::spindle::Spindle;
use super::state::{Phase, Simulation, Underway};
use crate::record::{AxisColumns, RowBuffer};
use kontur_filters::control::fault::Faults;
use kontur_filters::ring::Ring;

/// Largest number of cycles in a row: their columns stay in the first-level cache.
pub(super) const MOST: usize = Ring::ROOM;
/// The same if columns are written, as there are many of them.
const MOST_READ: usize = 64;

/// Rows with fewer cycles than this after the present one are not worthwhile; after a fault no more than these are
/// tried.
const FEW: usize = 8;

/// Largest number of single cycles before rows are tried again.
const MOST_PATIENCE: u64 = 32;

impl Simulation {
    /// Takes the cycles that have been computed, and completes their rows if there are any; the number of cycles.
    pub(super) fn take_computed(
        &mut self,
        mut shown: Option<(&mut RowBuffer, &mut Samples)>,
    ) -> usize {
        let count = std::mem::take(&mut self.batch.computed);
        let Some(last) = count.checked_sub(1) else { return 0 };
        let k = self.planner.setpoint().k + 1;
        if let Some((rows, into)) = &mut shown {
            let positions = |axis: usize| &self.batch.ahead.positions(axis)[..count];
            self.add_points((k, count), positions, rows, into);
        }
        let mut s_mm = self.record.path.s_mm;
        for i in 0..count {
            let row = self.batch.ahead.row(i);
            self.enter_blocks(row.seq, s_mm, k + i as u64);
            s_mm = row.s_mm;
            if i < last
                && let Some((rows, into)) = &mut shown
            {
                self.pass(k + i as u64, row);
                self.show(rows, into);
            }
        }
        self.planner.take(&self.batch.ahead, last);
        for (now, x) in self.path_position.iter_mut().zip(self.planner.setpoint().position.iter()) {
            *now = x + 0.0;
        }
        self.end_cycle();
        if let Some((rows, into)) = shown {
            self.show(rows, into);
        }
        count
    }

    /// Number of cycles after this one, up to `most`, in which nothing but the path acts on the axes.
    fn count_ahead(&mut self, most: usize) -> usize {
        let k = self.planner.setpoint().k;
        if most < FEW || k < self.batch.single_before || !self.is_left_alone() {
            return 0;
        }
        // do not read in vain: with an event in every block that would be most of the reading
        let changes =
            |block: &&Underway| !block.events.is_empty() || block.jerk_limited != self.jerk_limited;
        let before = self.queue.underway.iter().find(changes).map_or(u64::MAX, |block| block.seq);
        self.planner.look_ahead(most, before, &mut self.batch.ahead);
        let waits_for_input = |later: usize| {
            let next = k + 1 + later as u64;
            next > self.limit.cycles || self.inputs.is_due(self.cycle.time_of(next), self.cycle)
        };
        let read = self.batch.ahead.len();
        let count = (0..read).find(|later| waits_for_input(*later)).unwrap_or(read);
        if count < FEW {
            // after repeated failures it is tried less often
            self.batch.patience = (2 * self.batch.patience).clamp(1, MOST_PATIENCE);
            self.batch.single_before = k + 1 + (count as u64).max(self.batch.patience);
            return 0;
        }
        self.batch.patience = 0;
        count
    }

    /// Whether nothing acts on the axes or depends on them, apart from events of the next cycles.
    fn is_left_alone(&self) -> bool {
        let turns = |spindle: &Spindle| spindle.turns_freely();
        matches!(self.phase, Phase::Running)
            && !self.is_held
            && self.thread.is_none()
            && self.probing.is_none()
            && self.banding.is_none()
            && self.independent.is_unused()
            && self.wear.is_unused()
            && self.spindles.iter().all(turns)
            && self.chains.run_freely()
    }

    /// Runs every chain through this cycle and up to `most` further ones; their columns go to `rows`, unless nobody
    /// reads them.
    pub(super) fn run_chains(&mut self, most: usize, mut rows: Option<&mut RowBuffer>) {
        let most = if rows.is_some() { most.min(MOST_READ - 1) } else { most };
        self.batch.tried = (2 * self.batch.tried).clamp(FEW, MOST);
        let later = self.count_ahead(most.min(self.batch.tried));
        let mut count = 1 + later;
        self.turn_spindles(count);
        if count > 1 {
            self.batch.marks.resize_with(self.chains.len(), || None);
            self.batch.records_before.clone_from(&self.record.axes);
        }
        let mut faulty = false;
        for i in 0..self.chains.len() {
            if count > 1 {
                self.chains.all[i].mark(&mut self.batch.marks[i]);
            }
            let settles = self.chains.all[i].settles();
            let done = self.run_chain(i, count, rows.as_deref_mut());
            faulty |= self.chains.all[i].faults().is_some();
            if settles && self.chains.all[i].arrived() && self.chains.all[i].faults().is_none() {
                self.settled(i);
            }
            if done < count {
                (count, self.batch.tried) = (done, 0);
                for other in 0..=i {
                    if let Some(mark) = &self.batch.marks[other] {
                        self.chains.all[other].return_to(mark);
                    }
                    self.record.axes[other] = self.batch.records_before[other];
                    self.run_chain(other, count, rows.as_deref_mut());
                }
                self.spindles.clone_from(&self.batch.spindles_before);
                self.turn_spindles(count);
            }
        }
        if faulty {
            for (i, chain) in self.chains.all.iter().enumerate() {
                let found = chain.faults().into_iter().flat_map(Faults::iter);
                self.batch.faults.extend(found.map(|f| (i, *f)));
            }
        }
        self.batch.computed = count - 1;
    }

    /// Whether the actual position of a chain is inside the window of its stop.
    fn settled(&mut self, axis: usize) {
        let (source, settling_s) = (self.blocks.stops_at[axis], self.record.axes[axis].settling_s);
        let k = self.planner.setpoint().k;
        self.totals.stops.add(SettledStop { axis, source, k, settling_s });
    }

    /// Runs one chain through this cycle and the following computed ones, up to `count` cycles; returns their number.
    fn run_chain(&mut self, i: usize, count: usize, rows: Option<&mut RowBuffer>) -> usize {
        let (frozen, driver, gain) =
            (self.chains.frozen(i), self.chains.drivers[i], self.chains.gains[i]);
        let (chain, record) = (&mut self.chains.all[i], &mut self.record.axes[i]);
        let mut columns = rows.map_or(AxisColumns::none(), |rows| rows.axis_mut(i));
        if count == 1 {
            let ipo = match (frozen, driver) {
                (Some(x), _) => x,
                (None, Driver::Path(p)) => self.path_position[p],
                (None, Driver::Spindle(s)) => self.batch.spindle_deg[s][0],
                (None, Driver::Standing) => chain.set_mm(),
            };
            chain.step(ipo, gain, self.jerk_limited, record);
            columns.fill(record, 1);
            return 1;
        }
        let ipo = &mut self.batch.ipo;
        ipo.clear();
        match driver {
            Driver::Path(p) => {
                ipo.push(self.path_position[p]);
                let ahead = &self.batch.ahead.positions(p)[..count - 1];
                // as in a step, which adds the ways of independent axes: 0 here
                ipo.extend(ahead.iter().map(|x| x + 0.0));
            }
            Driver::Spindle(s) => ipo.extend_from_slice(&self.batch.spindle_deg[s][..count]),
            // single cycles only
            Driver::Standing => {}
        }
        let set = &mut self.batch.set;
        chain.run(ipo, gain, self.jerk_limited, set, record, columns)
    }

    /// Turns the spindles through the following cycles, up to `count` cycles.
    fn turn_spindles(&mut self, count: usize) {
        let Self { batch, spindles, spindle_deg, cycle, .. } = self;
        if count > 1 {
            batch.spindles_before.clone_from(spindles);
        }
        batch.spindle_deg.resize_with(spindles.len(), Vec::new);
        for ((column, spindle), now) in batch.spindle_deg.iter_mut().zip(spindles).zip(spindle_deg)
        {
            column.clear();
            column.push(*now);
            spindle.turn(count - 1, *cycle, column);
        }
    }
}
