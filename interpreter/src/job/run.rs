//! A program under way, and the one loop over its cycles.

use super::{Changes, Facts, Stop, Totals};
use crate::diag::{Condition, Diagnostic};
use crate::record::CycleRecord;
use crate::sim::Simulation;
use crate::source::Sources;
use std::convert::Infallible;
use std::fmt;
use std::sync::Arc;

/// Takes the cycles of a run, in order. A closure that takes a [`CycleRecord`] is one.
pub trait Sink {
    /// Why it takes no more.
    type Stop;

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
    sources: Arc<dyn Sources>,
    messages: Vec<Diagnostic>,
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
        let over = refused;
        Self { facts, simulation, sources, messages, refused, over, changed: false, stop }
    }

    /// Connects the real-time inputs, before the first cycle. Changes come in the order of time; an error among them ends
    /// the run, [`Totals::input_failed`] says so.
    #[must_use]
    pub fn with_inputs(mut self, changes: Changes) -> Self {
        self.simulation.connect(changes);
        self
    }

    /// For records of which nobody reads the deviation from the contour ([`AxisRecord::dev`], [`AxisRecord::dev_both_ways`],
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

    /// What stays the same during the run.
    pub const fn facts(&self) -> &Facts {
        &self.facts
    }

    /// The cycle computed last; before the first one the state at time zero.
    pub fn record(&self) -> &CycleRecord {
        self.simulation.record()
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

    /// Computes up to so many cycles, for callers that compare runs row by row or show them while they continue. A run that was
    /// stopped ([`Stop`]) has no more.
    ///
    /// # Errors
    /// What the sink stops with.
    pub fn advance<S: Sink>(&mut self, cycles: u64, sink: &mut S) -> Result<(), S::Stop> {
        self.over |= self.stop.is_set();
        for _ in 0..cycles {
            if self.over {
                break;
            }
            if self.simulation.next_cycle().is_none() {
                self.over = true;
                self.look_for_changes();
                break;
            }
            self.facts.files.update(self.simulation.files());
            sink.cycle(self.simulation.record())?;
        }
        Ok(())
    }

    /// A program that was changed while it ran, also after what was read of it, is another one than the cycles show.
    fn look_for_changes(&mut self) {
        if let Some((name, e)) = self.sources.changed() {
            let text = format!("{name}: {e}");
            self.messages.extend(self.simulation.take_diagnostics());
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
            found.extend(self.simulation.take_diagnostics());
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
