//! The cycle loop: program steps into the planner, setpoints through the axes, records out.
//!
//! A [`Simulation`] advances by as many cycles at a time as nothing else can affect, see `batch`; near events mostly by
//! a single one. The planner requests blocks only as far as its look-ahead reaches, so neither the program nor the
//! trace is ever held as a whole. Where the program needs the path at rest (exact stop, dwell, a new kernel), the
//! planner runs dry, the loop holds the position until the condition is met, and only then requests the next step of
//! the program.

mod act;
mod axes;
mod banding;
mod batch;
mod chain;
mod chains;
mod driver;
mod fault;
mod independent;
mod inputs;
mod messages;
mod out;
mod patience;
mod probe;
mod program;
mod reaction;
mod real_time;
mod smoothing;
mod spindle;
mod start;
mod state;
mod steps;
mod thread;
mod times;
mod totals;
mod wait;
mod wear;

pub use inputs::{Change, Changes, Signal};
pub(crate) use messages::Messages;
pub(crate) use out::{Measuring, Samples};
pub(crate) use start::impossible_axes;
pub(crate) use state::Simulation;
pub use thread::Work;
pub(crate) use thread::give;
pub use totals::{SettledStop, Stops, Totals};

use crate::record::{CycleRecord, RowBuffer};
use batch::MOST;
use chain::AxisChain;
use kontur_motion::cap::SpeedLimit;
use kontur_motion::planner::Next;
use spindle::Spindle;
use state::Phase;
use std::sync::Arc;
use wait::Parts;

/// A cycle of a path that waits at rest.
enum Waited {
    /// It waits in this cycle.
    Cycle,
    /// The condition is met.
    Over,
    /// It can never be met.
    InVain,
}

impl Simulation {
    /// Connects the real-time inputs, before the first cycle; false if they never change anything.
    ///
    /// Changes have to come in the order of time. An error among them ends the run, see [`Totals::input_failed`].
    pub(crate) fn connect(&mut self, changes: Changes) -> bool {
        if let Err(failure) = self.inputs.connect(changes) {
            self.input_fails(*failure);
        }
        !self.inputs.is_over()
    }

    /// Leaves out the deviation from the contour in the records: it is NaN until a block requires a tolerance.
    pub(crate) fn leave_out_deviation(&mut self) {
        self.planner.report_changes(false);
        let path_axes = self.path_axes();
        self.record.omit_deviation(path_axes);
    }

    /// Decodes the program on another thread from here on, if `start` can start one.
    pub(crate) fn decode_ahead(&mut self, start: impl FnOnce(Work) -> bool) {
        self.program.decode_ahead(start);
    }

    /// Names of the source files, in the order of [`CycleRecord::file`].
    pub(crate) fn files(&self) -> &[Arc<str>] {
        self.program.files()
    }

    /// Path axes, then spindles.
    pub(crate) fn chains(&self) -> &[AxisChain] {
        &self.chains.all
    }

    /// Messages since the last call, if there are any.
    pub(crate) fn take_messages(&mut self) -> Option<Messages> {
        (!self.messages.is_empty()).then(|| std::mem::take(&mut self.messages))
    }

    /// Whether [`Self::take_messages`] would return messages.
    fn has_messages(&self) -> bool {
        !self.messages.is_empty()
    }

    /// Number of path axes.
    pub(crate) fn path_axes(&self) -> usize {
        self.path_position.len()
    }

    /// Results that are not part of any record; complete when there are no more cycles.
    pub(crate) fn totals(&self) -> Totals {
        let (blocks, ideal_duration_s) =
            self.progress.up_to(self.record.path.s_mm, &self.smoothing.changed);
        Totals { blocks, ideal_duration_s, ..self.totals.clone() }
    }

    /// The cycle computed last, or the state at time zero; its deviation has not been measured yet.
    pub(crate) fn record(&self) -> &CycleRecord {
        &self.record
    }

    /// Whether the deviation from the contour is measured.
    pub(crate) fn is_measured(&self) -> bool {
        self.planner.reports_changes()
    }

    /// Computes up to `most` cycles and returns their number: 0 when the program has ended or was stopped and the axes
    /// are at rest.
    ///
    /// Rows and points of the cycles are added to `rows` and `samples`, which must have room for them. They are left
    /// out if nobody reads the cycles (not `read`) and nothing is measured.
    pub(crate) fn next_cycles(
        &mut self,
        most: usize,
        read: bool,
        rows: &mut RowBuffer,
        samples: &mut Samples,
    ) -> usize {
        let most = most.min(MOST);
        if !self.begin_row(most, read, rows) {
            return 0;
        }
        if !read && !self.is_measured() {
            return 1 + self.take_computed(None);
        }
        let position = &self.planner.setpoint().position;
        self.add_points((self.record.k, 1), |axis| &position[axis..=axis], rows, samples);
        if !self.independent.is_unused() {
            self.take_out_ways(samples);
        }
        self.show(rows, samples);
        1 + self.take_computed(Some((rows, samples)))
    }

    /// Computes the next cycle, and the axes of up to `most` cycles including this one; see [`Self::next_cycles`].
    fn begin_row(&mut self, most: usize, read: bool, rows: &mut RowBuffer) -> bool {
        loop {
            match &mut self.phase {
                Phase::Done => return false,
                Phase::Start => {
                    self.phase = Phase::Running;
                    self.take_inputs(0);
                    for (axis, record) in self.record.axes.iter().enumerate() {
                        rows.axis_mut(axis).fill(record, 1);
                    }
                    return true;
                }
                Phase::Running => match self.planner.advance() {
                    Ok(Next::Setpoint) => {
                        self.look_for_hold();
                        break;
                    }
                    Ok(Next::Input) => self.pull(),
                    Ok(Next::Rest) => self.at_rest(),
                    Ok(Next::Stopped) => self.phase = Phase::Done,
                    Err(e) => self.fail(&format!("look-ahead: {e}")),
                },
                Phase::Waiting(_) => match self.wait() {
                    Waited::Cycle => break,
                    Waited::Over => self.go_on(),
                    Waited::InVain => return false,
                },
                Phase::Stopping(stopping) => {
                    let set_rests = self.planner.brake_is_over()
                        && !self.independent.any_moving()
                        && self.spindles.iter().all(Spindle::rests)
                        && self.chains.all.iter().all(AxisChain::settled);
                    let axes_stand = self.chains.all.iter().all(AxisChain::is_at_rest);
                    if stopping.is_over(set_rests, axes_stand, self.cycle) {
                        self.phase = Phase::Done;
                        return false;
                    }
                    self.planner.advance_braking();
                    break;
                }
            }
        }
        if self.is_out_of_time() {
            return false;
        }
        let rows = (read || self.is_measured()).then_some(rows);
        self.through_the_axes(most.saturating_sub(1), rows);
        self.watch_probe();
        self.watch_banding();
        true
    }

    /// Waits for one more cycle, unless what the path waits for has come or never will.
    fn wait(&mut self) -> Waited {
        let Phase::Waiting(wait) = &mut self.phase else { return Waited::Over };
        let k = self.planner.setpoint().k;
        let parts = Parts {
            chains: &self.chains,
            spindles: &self.spindles,
            independent: &self.independent,
            cycle: self.cycle,
        };
        // a held path does not begin a thread: it would miss the mark
        let bars = wait.mark().is_some_and(|m| self.inputs.bar(m.full_override));
        if !bars && wait.is_over(parts) {
            return Waited::Over;
        }
        if (bars || wait.is_held(&self.independent, k)) && self.inputs.is_over() {
            self.held_for_ever();
            return Waited::InVain;
        }
        if self.inputs.is_over()
            && let Some((chain, lacks)) = wait.hopeless(parts, self.cycle)
        {
            self.never_arrives(chain, lacks);
            return Waited::InVain;
        }
        wait.begin_cycle(parts, k);
        self.planner.hold(SpeedLimit::Stop);
        Waited::Cycle
    }

    /// Ends the run because of an internal error of kontur.
    pub(crate) fn fail(&mut self, text: &str) {
        self.messages.own.push(fault::internal(text));
        self.totals.aborted = true;
        self.phase = Phase::Done;
    }

    /// Ends the run where the program needs a cycle beyond its time limit; braking after a fault is not limited.
    fn is_out_of_time(&mut self) -> bool {
        let last = self.limit.cycles;
        if self.planner.setpoint().k <= last || matches!(self.phase, Phase::Stopping(_)) {
            return false;
        }
        let mut late = fault::out_of_time(last, self.limit.seconds, self.cycle);
        let waits = matches!(self.phase, Phase::Waiting(_));
        let block = if waits { self.blocks.waits_at } else { self.blocks.current };
        late.source = self.program.locate(block);
        self.messages.own.push(late);
        self.totals.aborted = true;
        self.phase = Phase::Done;
        true
    }
}
