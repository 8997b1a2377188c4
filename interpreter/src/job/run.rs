//! A running program, and the one loop over its cycles.

use super::apart::{Apart, Work};
use super::{Changes, Facts, Stop, Totals};
use crate::diag::{Condition, Diagnostic};
use crate::record::CycleRecord;
use crate::sim::{Measuring, Messages, Samples, Simulation};
use crate::source::Sources;
use std::convert::Infallible;
use std::fmt;
use std::sync::Arc;

/// Takes the cycles of a run, in order. A closure that takes a [`CycleRecord`] is one.
pub trait Sink {
    /// Why it takes no more.
    type Stop;

    /// It looks at every cycle. Where it does not, cycles are not handed to it, and cost less: of many in a row the records are
    /// not written.
    fn reads(&self) -> bool {
        true
    }

    /// Takes a cycle.
    ///
    /// # Errors
    /// Ends the loop; the cycle counts as taken.
    fn cycle(&mut self, record: &CycleRecord) -> Result<(), Self::Stop>;

    /// Looks at the run between two stretches of at most [`Run::STRETCH`] cycles and at its end: the moment to take its
    /// messages, to look at a clock, or to stop it. Messages that are not taken wait.
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

    fn cycle(&mut self, record: &CycleRecord) -> Result<(), Infallible> {
        self(record);
        Ok(())
    }
}

/// A program that runs, or that was refused before its first cycle.
pub struct Run {
    facts: Facts,
    simulation: Simulation,
    measuring: Measuring,
    samples: Samples,
    /// While another thread measures.
    apart: Option<Apart>,
    sources: Arc<dyn Sources>,
    /// Messages of the lists and of the check; then those of the simulation.
    messages: Vec<Diagnostic>,
    raised: Messages,
    refused: bool,
    over: bool,
    /// A program is no longer what was run.
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
        Self {
            facts,
            simulation,
            measuring: Measuring::default(),
            samples: Samples::default(),
            apart: None,
            sources,
            messages,
            raised: Messages::default(),
            refused,
            over: refused,
            changed: false,
            stop,
        }
    }

    /// Connects the real-time inputs, before the first cycle. Changes come in the order of time; an error among them ends
    /// the run, [`Totals::input_failed`] says so.
    #[must_use]
    pub fn with_inputs(mut self, changes: Changes) -> Self {
        if self.simulation.connect(changes) {
            // one of them may be an error of an encoder
            self.facts.axes.iter_mut().for_each(|axis| axis.apart.load = true);
        }
        self
    }

    /// For records whose deviation from the contour is not read ([`AxisRecord::dev`], [`AxisRecord::dev_both_ways`],
    /// [`CycleRecord::contour_err_mm`]): they hold not a number (NaN) in its place, until a block demands `AX_DEV`. Measuring
    /// it is a third of the work of a run.
    ///
    /// [`AxisRecord::dev`]: crate::record::AxisRecord::dev
    /// [`AxisRecord::dev_both_ways`]: crate::record::AxisRecord::dev_both_ways
    #[must_use]
    pub fn without_deviation(mut self) -> Self {
        self.simulation.leave_out_deviation();
        self
    }

    /// For records whose [`AxisRecord::dev_both_ways`] is not read: from the first cycle on it is not a number (NaN) until a
    /// block demands `AX_DEV`. The deviation of the set points alone costs a third.
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

    /// The cycle computed last; before the first one the state at time zero.
    pub fn record(&self) -> &CycleRecord {
        self.apart.as_ref().map_or_else(|| self.simulation.record(), Apart::record)
    }

    /// True if there are no more cycles.
    pub const fn is_over(&self) -> bool {
        self.over
    }

    /// Computes all cycles that are left.
    ///
    /// # Errors
    /// What the sink stops with.
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

    /// The same on two threads: a second one measures the cycles against the contour. Cycles and messages are the same, bit by
    /// bit.
    ///
    /// `start` starts a thread with a name; where it cannot, the work is done here.
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
    /// What the sink stops with; such a run has no more cycles.
    pub fn to_end_on_threads<S: Sink>(
        &mut self,
        start: impl FnOnce(&'static str, Work) -> bool,
        sink: &mut S,
    ) -> Result<(), S::Stop> {
        if !self.over && self.simulation.is_measured() {
            let record = self.simulation.record();
            self.apart = Apart::begin(record, &mut self.measuring, start);
        }
        let ended = self.to_end(sink);
        if let Some(apart) = self.apart.take() {
            self.over = true;
            self.simulation.record_mut().clone_from(apart.record());
        }
        ended
    }

    /// Computes up to so many cycles, for callers that compare runs row by row or show them while they continue. A run that was
    /// stopped ([`Stop`]) has no more.
    ///
    /// # Errors
    /// What the sink stops with.
    pub fn advance<S: Sink>(&mut self, cycles: u64, sink: &mut S) -> Result<(), S::Stop> {
        self.over |= self.stop.is_set();
        let mut left = cycles;
        while left > 0 && !self.over {
            let reads = sink.reads();
            let count = if reads { u64::from(self.next_cycle()) } else { self.skip(left) };
            if count == 0 {
                self.over = true;
                self.look_for_changes();
                break;
            }
            left -= count;
            if reads {
                sink.cycle(self.record())?;
            }
        }
        Ok(())
    }

    /// Advances by up to `most` cycles that are not read; the number of them, 0 if there are no more.
    fn skip(&mut self, most: u64) -> u64 {
        // what is measured is measured cycle by cycle
        if self.apart.is_some() || self.simulation.is_measured() {
            return u64::from(self.next_cycle());
        }
        let count = self.simulation.next_cycles(most);
        self.raised.absorb(self.simulation.take_messages());
        if count > 0 {
            self.measure();
        }
        self.facts.files.update(self.simulation.files());
        count
    }

    /// Measures the cycle computed last, on this thread.
    fn measure(&mut self) {
        let Self { simulation, measuring, samples, raised, .. } = self;
        if simulation.is_measured() {
            samples.clear();
            simulation.sample(samples);
            measuring.measure(samples);
            samples.fill(0, simulation.record_mut());
            simulation.exceeded(samples, 0).into_iter().for_each(|d| raised.push(d));
        }
    }

    /// Advances to the next cycle, with the messages up to it; false if there are no more.
    fn next_cycle(&mut self) -> bool {
        let Self { simulation, raised, .. } = self;
        let computed = if let Some(apart) = &mut self.apart {
            apart.next_cycle(simulation, raised)
        } else {
            let computed = simulation.next_cycle();
            raised.absorb(simulation.take_messages());
            if computed {
                self.measure();
            }
            computed
        };
        self.facts.files.update(self.simulation.files());
        computed
    }

    /// A program that was changed while it ran, also after what was read of it, is another one than the cycles show.
    fn look_for_changes(&mut self) {
        if let Some((name, e)) = self.sources.changed() {
            let text = format!("{name}: {e}");
            self.messages.extend(self.raised.take());
            // the reader may have met it already
            if self.messages.iter().all(|d| d.text != text) {
                let hint = "the trace does not belong to the program as it is now: run it again";
                self.messages.push(Diagnostic::new(Condition::NoFile, text).hint(hint));
            }
            self.changed = true;
        }
    }

    /// The diagnostics raised since the last call: those of the lists first, then in the order of raising.
    pub fn take_diagnostics(&mut self) -> Vec<Diagnostic> {
        let mut found = std::mem::take(&mut self.messages);
        // of a refused program the check has said everything
        if !self.refused {
            found.extend(self.raised.take());
        }
        found
    }

    /// What no record holds; complete when there are no more cycles.
    pub fn totals(&self) -> Totals {
        let totals = self.simulation.totals();
        let aborted = self.refused || self.changed || self.stop.is_set() || totals.aborted;
        Totals { aborted, input_failed: self.changed || totals.input_failed, ..totals }
    }
}
