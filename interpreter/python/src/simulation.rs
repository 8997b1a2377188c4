//! A program under way.

use crate::arguments;
use crate::columns::Columns;
use crate::errors::{self, Said, said};
use crate::interrupt::interruptible;
use kontur_interpreter::diag::Diagnostic;
use kontur_interpreter::job::{Run, Sink, Stop};
use kontur_interpreter::record::columns::select;
use kontur_interpreter::record::{Asked, CycleRecord, Rows};
use kontur_interpreter::summary::{self, Collector, Summary};
use pyo3::exceptions::PyMemoryError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::sync::{Mutex, PoisonError};

/// A program under way.
///
/// Python shares objects between threads, and a run can only be sent from one to another. The lock is never waited for:
/// every method borrows the object for itself, and a second thread gets an exception.
#[pyclass(module = "kontur._kontur")]
pub(crate) struct Simulation(Mutex<State>);

struct State {
    run: Run,
    stop: Stop,
    decimate: u64,
    columns: Columns,
    summary: Collector,
    /// Those that the summary keeps no longer are dropped here too.
    messages: Vec<Diagnostic>,
}

/// Messages beyond these are counted by the summary.
const MOST_MESSAGES: usize = 1000;

/// Where a stretch ends, at the latest with the run.
#[derive(Clone, Copy, Debug, Default)]
struct Until {
    /// In the first cycle of this line of the program.
    line: Option<u32>,
    /// In the first cycle that is not earlier.
    k: Option<u64>,
}

enum Ended {
    Reached,
    Full,
}

struct Gather<'a> {
    until: Until,
    /// File and line of the last cycle.
    last: (u32, u32),
    decimate: u64,
    columns: &'a mut Columns,
    /// The rows go to the columns.
    keeps: bool,
    summary: &'a mut Collector,
    messages: &'a mut Vec<Diagnostic>,
}

impl Gather<'_> {
    /// Number of the first cycle at which the stretch ends.
    fn end(&self, cycles: &[CycleRecord]) -> Option<usize> {
        let mut last = self.last;
        cycles.iter().position(|cycle| {
            let before = std::mem::replace(&mut last, (cycle.file, cycle.line));
            // file 0 is the program itself
            let entered = self.until.line.is_some_and(|line| last == (0, line) && before != last);
            entered || self.until.k.is_some_and(|k| cycle.k >= k)
        })
    }
}

impl Sink for Gather<'_> {
    type Stop = Ended;

    fn reads(&self) -> Option<Asked> {
        Some(self.columns.asked().and(Collector::asked()))
    }

    fn takes(&self, cycles: &[CycleRecord]) -> usize {
        let end = self.end(cycles).map_or(cycles.len(), |end| end + 1);
        end.min(self.columns.room())
    }

    fn rows(&mut self, rows: &Rows<'_>) -> Result<(), Ended> {
        self.summary.add(rows);
        let decimate = usize::try_from(self.decimate).unwrap_or(usize::MAX);
        if self.keeps {
            self.columns.extend(&rows.from_multiple_of(self.decimate), decimate);
        }
        let reached = self.end(rows.cycles()).is_some();
        if let Some(last) = rows.cycles().last() {
            self.last = (last.file, last.line);
        }
        match reached {
            true => Err(Ended::Reached),
            false if self.keeps && self.columns.room() == 0 => Err(Ended::Full),
            false => Ok(()),
        }
    }

    fn pause(&mut self, run: &mut Run) -> Result<(), Ended> {
        keep(run, self.summary, self.messages);
        Ok(())
    }
}

fn keep(run: &mut Run, summary: &mut Collector, messages: &mut Vec<Diagnostic>) {
    for message in run.take_diagnostics() {
        summary.message(&message);
        if messages.len() < MOST_MESSAGES {
            messages.push(message);
        }
    }
}

impl Simulation {
    fn state(&mut self) -> &mut State {
        self.0.get_mut().unwrap_or_else(PoisonError::into_inner)
    }
}

impl State {
    fn keep(&mut self) {
        keep(&mut self.run, &mut self.summary, &mut self.messages);
    }

    /// The run, and what takes its next cycles.
    fn gather(&mut self, until: Until, keeps: bool) -> (&mut Run, Gather<'_>) {
        let Self { run, decimate, columns, summary, messages, .. } = self;
        let (last, decimate) = ((run.record().file, run.record().line), *decimate);
        (run, Gather { until, last, decimate, columns, keeps, summary, messages })
    }

    fn finished(&self) -> Summary {
        self.summary.clone().finish(&self.run.totals())
    }
}

#[pymethods]
impl Simulation {
    #[new]
    fn new(py: Python<'_>, words: Vec<String>, signals: &str, decimate: u64) -> PyResult<Self> {
        let mut args = arguments::program(py, words)?;
        let stop = Stop::default();
        args.simulation.stop = stop.clone();
        let opened = interruptible(py, &stop, || args.simulation.request(&args.program).open())?;
        let mut run = opened.map_err(|e| errors::open(py, e))?.run;
        let facts = run.facts();
        let columns =
            select(signals, facts).map_err(|e| errors::usage(py, &format!("signals: {e}")))?;
        let columns = Columns::new(columns, facts);
        let mut summary = Collector::new(facts);
        let mut messages = Vec::new();
        if run.is_over() {
            keep(&mut run, &mut summary, &mut messages);
        }
        Ok(Self(Mutex::new(State { run, stop, decimate, columns, summary, messages })))
    }

    /// Computes cycles up to a line, a time, or the end.
    #[pyo3(signature = (line=None, time_s=None))]
    fn advance(&mut self, py: Python<'_>, line: Option<u32>, time_s: Option<f64>) -> PyResult<()> {
        let state = self.state();
        let stop = state.stop.clone();
        let cycle_s = state.run.facts().cycle_s();
        // a hair below: a time is written in decimals
        let k = time_s.map(|t| (t / cycle_s - 1e-6).ceil().max(0.0) as u64);
        if k.is_some_and(|k| state.summary.cycles() > 0 && state.run.record().k >= k) {
            return Ok(());
        }
        let (run, mut gather) = state.gather(Until { line, k }, true);
        match interruptible(py, &stop, || run.to_end(&mut gather))? {
            Ok(()) | Err(Ended::Reached) => Ok(()),
            Err(Ended::Full) => Err(PyMemoryError::new_err(
                "more than 2 GiB of columns: select signals, decimate, or continue in parts with run_until",
            )),
        }
    }

    /// Computes one cycle: its columns, or nothing after the last one.
    fn next_cycle<'py>(&mut self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyDict>>> {
        let state = self.state();
        loop {
            let before = state.summary.cycles();
            let (run, mut gather) = state.gather(Until::default(), false);
            // it ends with the cycle
            let (Ok(()) | Err(_)) = run.advance(1, &mut gather);
            let taken = state.summary.cycles() > before;
            let k = state.run.record().k;
            if !taken || k.is_multiple_of(Run::STRETCH) {
                state.keep();
            }
            if !taken {
                return Ok(None);
            }
            if k.is_multiple_of(state.decimate) {
                return state.columns.cycle(py, state.run.record(), state.run.facts()).map(Some);
            }
        }
    }

    /// The rows of `advance` since the last call.
    fn take<'py>(&mut self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let State { columns, run, .. } = self.state();
        columns.take(py, run.facts())
    }

    /// Name and unit of every column.
    fn units(&mut self) -> Vec<(String, String)> {
        self.state().columns.units()
    }

    /// The summary so far as JSON and as text.
    fn summary(&mut self) -> (String, String) {
        let summary = self.state().finished();
        (summary.json(), summary.text())
    }

    /// Messages so far.
    fn messages(&mut self) -> Vec<Said> {
        let state = self.state();
        state.keep();
        said(&state.messages)
    }

    /// There are no more cycles.
    fn is_over(&mut self) -> bool {
        self.state().run.is_over()
    }

    /// Refused, or stopped by an error.
    fn is_aborted(&mut self) -> bool {
        self.state().finished().state == summary::State::Aborted
    }
}
