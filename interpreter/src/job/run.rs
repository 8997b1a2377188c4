//! A running program, and the one loop over its cycles.

use super::apart::Apart;
use super::stretch::Stretch;
use super::{Changes, Facts, Stop, Totals};
use crate::diag::{Condition, Diagnostic};
use crate::record::{Asked, CycleRecord, Rows};
use crate::sim::{Measuring, Messages, Simulation, Work};
use crate::source::Sources;
use std::convert::Infallible;
use std::fmt;
use std::sync::Arc;

/// Takes the cycles of a run, in order, many at once. A closure that takes a [`CycleRecord`] is one: it sees them one at a time.
pub trait Sink {
    /// The reason why it stops the run.
    type Stop;

    /// What it reads of the axes, the same until the run ends: what nobody reads is not written. With `None` no cycle is handed
    /// to it.
    fn reads(&self) -> Option<Asked> {
        Some(Asked::ALL)
    }

    /// How many of the next cycles it takes at once: all of them, or those up to one at which it may stop. One is the least.
    fn takes(&self, cycles: &[CycleRecord]) -> usize {
        cycles.len()
    }

    /// Takes cycles.
    ///
    /// # Errors
    /// Ends the loop; the cycles count as taken.
    fn rows(&mut self, rows: &Rows<'_>) -> Result<(), Self::Stop>;

    /// Called between two stretches of at most [`Run::STRETCH`] cycles and at the end of the run, to take its messages,
    /// check a clock, or stop the run. Messages that are not taken are kept.
    ///
    /// # Errors
    /// Ends the loop.
    fn pause(&mut self, run: &mut Run) -> Result<(), Self::Stop> {
        let _ = run;
        Ok(())
    }
}

impl<F: FnMut(&CycleRecord)> Sink for F {
    type Stop = Infallible;

    fn rows(&mut self, rows: &Rows<'_>) -> Result<(), Infallible> {
        rows.each(|record| {
            self(record);
            Ok(())
        })
    }
}

/// A running program, or one that was refused before its first cycle.
pub struct Run {
    facts: Facts,
    simulation: Simulation,
    measuring: Measuring,
    /// Used while another thread measures.
    apart: Option<Apart>,
    /// Computed cycles that the sink takes.
    stretch: Stretch,
    /// The cycle taken last.
    shown: CycleRecord,
    sources: Arc<dyn Sources>,
    /// Messages of the lists and of the check, then those of the simulation.
    messages: Vec<Diagnostic>,
    raised: Messages,
    refused: bool,
    over: bool,
    /// Whether a program file has changed since it was started.
    changed: bool,
    stop: Stop,
}

impl fmt::Debug for Run {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Run")
            .field("program", &self.facts.program)
            .field("refused", &self.refused)
            .field("over", &self.over)
            .finish_non_exhaustive()
    }
}

impl Run {
    /// Cycles between two pauses of a [`Sink`].
    pub const STRETCH: u64 = 1024;

    pub(super) fn new(
        simulation: Simulation,
        sources: Arc<dyn Sources>,
        facts: Facts,
        messages: Vec<Diagnostic>,
        refused: bool,
        stop: Stop,
    ) -> Self {
        let shown = simulation.record().clone();
        Self {
            facts,
            simulation,
            measuring: Measuring::default(),
            apart: None,
            stretch: Stretch::default(),
            shown,
            sources,
            messages,
            raised: Messages::default(),
            refused,
            over: refused,
            changed: false,
            stop,
        }
    }

    /// Connects the real-time inputs, before the first cycle. Changes have to come in the order of time; an error among
    /// them ends the run, see [`Totals::input_failed`].
    #[must_use]
    pub fn with_inputs(mut self, changes: Changes) -> Self {
        if self.simulation.connect(changes) {
            // one of them may be an encoder error
            self.facts.axes.iter_mut().for_each(|axis| axis.apart.load = true);
        }
        self
    }

    /// Leaves out the deviation from the contour ([`AxisRecord::dev`], [`AxisRecord::dev_both_ways`],
    /// [`CycleRecord::contour_err_mm`]), a third of the work of a run: the values are NaN until a block requires
    /// `AX_DEV`.
    ///
    /// [`AxisRecord::dev`]: crate::record::AxisRecord::dev
    /// [`AxisRecord::dev_both_ways`]: crate::record::AxisRecord::dev_both_ways
    #[must_use]
    pub fn without_deviation(mut self) -> Self {
        self.simulation.leave_out_deviation();
        self.shown.clone_from(self.simulation.record());
        self
    }

    /// Leaves out [`AxisRecord::dev_both_ways`]: from the first cycle on it is NaN until a block requires `AX_DEV`. The
    /// deviation of the set points alone costs a third.
    ///
    /// [`AxisRecord::dev_both_ways`]: crate::record::AxisRecord::dev_both_ways
    #[must_use]
    pub fn without_both_ways(mut self) -> Self {
        self.measuring.set_points_only();
        self
    }

    /// What stays the same during the run.
    pub const fn facts(&self) -> &Facts {
        &self.facts
    }

    /// The cycle taken last; before the first one the state at time zero.
    pub const fn record(&self) -> &CycleRecord {
        &self.shown
    }

    /// Whether there are no more cycles.
    pub const fn is_over(&self) -> bool {
        self.over
    }

    /// Computes all remaining cycles.
    ///
    /// # Errors
    /// The reason why the sink stops.
    pub fn to_end<S: Sink>(&mut self, sink: &mut S) -> Result<(), S::Stop> {
        loop {
            let taken = self.advance(Self::STRETCH, sink);
            let paused = sink.pause(self);
            taken?;
            paused?;
            if self.over {
                return Ok(());
            }
        }
    }

    /// The same on several threads: one decodes the program ahead of the machine, and another one measures the cycles
    /// against the contour. Cycles and messages are the same bit for bit.
    ///
    /// `start` starts a thread with a name; if it fails, the work is done on this thread.
    ///
    /// ```
    /// use kontur_interpreter::job::{Job, MachineLists};
    /// use kontur_interpreter::record::CycleRecord;
    /// use kontur_interpreter::source::MemorySources;
    /// use std::thread::Builder;
    ///
    /// let (machine, _) = MachineLists::default().load().unwrap();
    /// let sources = MemorySources::new().with("part.nc", "G01 X10 F1000\nM30\n");
    /// let mut run = Job::new(machine, sources, "part.nc").start().unwrap();
    /// let mut x_mm = Vec::new();
    /// let Ok(()) = run.to_end_on_threads(
    ///     |name, work| Builder::new().name(name.to_owned()).spawn(work).is_ok(),
    ///     &mut |record: &CycleRecord| x_mm.push(record.axes[0].set),
    /// );
    /// assert_eq!(x_mm.last(), Some(&10.0));
    /// ```
    ///
    /// # Errors
    /// The reason why the sink stops; the run then has no more cycles.
    pub fn to_end_on_threads<S: Sink>(
        &mut self,
        mut start: impl FnMut(&'static str, Work) -> bool,
        sink: &mut S,
    ) -> Result<(), S::Stop> {
        if !self.over {
            self.simulation.decode_ahead(|work| start("program", work));
            if self.simulation.is_measured() {
                let asked = sink.reads();
                let start = |work| start("deviation", work);
                self.apart = Apart::begin(asked, &mut self.measuring, start);
            }
        }
        let ended = self.to_end(sink);
        self.over |= self.apart.take().is_some();
        ended
    }

    /// Computes up to `cycles` cycles, for callers that compare runs row by row or show them while they continue. A
    /// stopped run ([`Stop`]) has no more cycles.
    ///
    /// # Errors
    /// The reason why the sink stops.
    pub fn advance<S: Sink>(&mut self, cycles: u64, sink: &mut S) -> Result<(), S::Stop> {
        self.over |= self.stop.is_set();
        let mut left = cycles;
        while left > 0 && !self.over {
            let most = usize::try_from(left).unwrap_or(usize::MAX);
            if self.stretch.is_over() && !self.next_stretch(most, sink.reads()) {
                self.over = true;
                self.look_for_changes();
                break;
            }
            let before = self.stretch.taken;
            let taken = self.hand_over(most, sink);
            left -= (self.stretch.taken - before) as u64;
            self.hear();
            taken?;
        }
        Ok(())
    }

    /// Computes up to `most` cycles and measures them; false if there are no more.
    fn next_stretch(&mut self, most: usize, asked: Option<Asked>) -> bool {
        let Self { simulation, stretch, .. } = self;
        if let Some(apart) = &mut self.apart {
            apart.next_stretch(stretch, simulation);
        } else {
            stretch.compute(simulation, most, asked);
            self.measuring.measure(&mut stretch.samples);
            stretch.fill();
        }
        self.facts.files.update(self.simulation.files());
        if self.stretch.count == 0 {
            self.hear();
        }
        self.stretch.count > 0
    }

    /// Passes up to `most` of the computed cycles to a sink.
    fn hand_over<S: Sink>(&mut self, most: usize, sink: &mut S) -> Result<(), S::Stop> {
        let Self { stretch: Stretch { rows, count, taken, last, .. }, shown, .. } = self;
        let (first, mut end) = (*taken, (*count).min(taken.saturating_add(most)));
        let reads = sink.reads().is_some();
        if reads {
            let cycles = rows.part(first..end).cycles();
            end = first + sink.takes(cycles).clamp(1, cycles.len());
        }
        *taken = end;
        if end == *count {
            shown.clone_from(last);
        } else if let Some(before) = end.checked_sub(1).filter(|before| *before < rows.len()) {
            rows.part(before..end).read(0, shown);
        }
        if reads { sink.rows(&rows.part(first..end)) } else { Ok(()) }
    }

    /// Takes the messages up to the last cycle that was taken.
    fn hear(&mut self) {
        let Self { simulation, stretch, raised, .. } = self;
        let Stretch { samples, messages, taken, .. } = stretch;
        let said = samples.said_at().unwrap_or(usize::MAX);
        let exceeded = samples.exceeded_after().filter(|after| after <= taken);
        if exceeded.is_some_and(|after| after <= said) {
            raised.extend(simulation.exceeded(samples));
        }
        if stretch.taken == stretch.count {
            raised.absorb(messages.take());
        }
        if exceeded.is_some_and(|after| after > said) {
            raised.extend(simulation.exceeded(samples));
        }
    }

    /// Reports a program that was changed during the run, even after the part that was read: the cycles no longer
    /// belong to it.
    fn look_for_changes(&mut self) {
        if let Some((name, e)) = self.sources.changed() {
            let text = format!("{name}: {e}");
            self.messages.extend(self.raised.take());
            // the reader may already have noticed it
            if self.messages.iter().all(|d| d.text != text) {
                let hint = "the program has changed since the trace was recorded: run it again";
                self.messages.push(Diagnostic::new(Condition::NoFile, text).hint(hint));
            }
            self.changed = true;
        }
    }

    /// The diagnostics raised since the last call: those of the lists first, then in the order of raising.
    pub fn take_diagnostics(&mut self) -> Vec<Diagnostic> {
        let mut found = std::mem::take(&mut self.messages);
        // the check has reported everything about a refused program
        if !self.refused {
            found.extend(self.raised.take());
        }
        found
    }

    /// Results that are not part of any record; complete when there are no more cycles.
    pub fn totals(&self) -> Totals {
        let totals = self.simulation.totals();
        let aborted = self.refused || self.changed || self.stop.is_set() || totals.aborted;
        Totals { aborted, input_failed: self.changed || totals.input_failed, ..totals }
    }
}
