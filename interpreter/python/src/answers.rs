//! Requests with an immediate answer: check, explain, response, tune; and the runs of a sweep.

use crate::arguments;
use crate::errors::{self, Said, said};
use crate::interrupt::interruptible;
use kontur::args::ResponseArgs;
use kontur::args::SweepArgs;
use kontur::args::TuneArgs;
use kontur::console::Console;
use kontur::sweep::Plan;
use kontur::table::{Cell, Table};
use kontur_interpreter::job::Stop;
use numpy::IntoPyArray as _;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::io::{self, Write};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// All diagnostics of a program.
#[pyfunction]
pub(crate) fn check(py: Python<'_>, words: Vec<String>) -> PyResult<Vec<Said>> {
    let mut args = arguments::program(py, words)?;
    let stop = Stop::default();
    args.simulation.stop = stop.clone();
    let checked = interruptible(py, &stop, || args.simulation.request(&args.program).check())?;
    Ok(said(&checked.map_err(|e| errors::open(py, e))?.diagnostics))
}

/// The explanation of an ID, a parameter or a command.
#[pyfunction]
pub(crate) fn explain(py: Python<'_>, thing: &str) -> PyResult<String> {
    kontur::explain::text(thing).map_err(|e| errors::command(py, &e, ""))
}

/// Output of a command.
#[derive(Clone, Default)]
struct Text(Arc<Mutex<Vec<u8>>>);

impl Write for Text {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.lock().write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

impl Text {
    fn lock(&self) -> MutexGuard<'_, Vec<u8>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn take(&self) -> String {
        String::from_utf8_lossy(&std::mem::take(&mut *self.lock())).into_owned()
    }
}

/// Runs a command and returns its stdout and stderr.
struct Spoken<T> {
    answer: Result<T, kontur::Error>,
    out: String,
    err: String,
}

fn speak<T>(command: impl FnOnce(&mut Console) -> Result<T, kontur::Error>) -> Spoken<T> {
    let (out, err) = (Text::default(), Text::default());
    let mut console = Console::new(out.clone(), err.clone());
    console.speak(kontur::args::MessageForm::Json);
    let answer = command(&mut console);
    Spoken { answer, out: out.take(), err: err.take() }
}

/// Columns by name: an array of numbers, or a list of words.
fn columns<'py>(py: Python<'py>, table: &Table) -> PyResult<Bound<'py, PyDict>> {
    let all = PyDict::new(py);
    for (i, name) in table.header().iter().enumerate() {
        let cells = || table.rows().iter().map(|row| &row[i]);
        let numbers: Option<Vec<f64>> = cells().map(Cell::number).collect();
        match numbers {
            Some(numbers) => all.set_item(name, numbers.into_pyarray(py))?,
            None => all.set_item(name, cells().map(Cell::text).collect::<Vec<_>>())?,
        }
    }
    Ok(all)
}

/// The table of a response, and the messages about it.
#[pyfunction]
pub(crate) fn response(
    py: Python<'_>,
    words: Vec<String>,
) -> PyResult<(Bound<'_, PyDict>, String)> {
    let args: ResponseArgs = arguments::of_command(py, words)?;
    let spoken = interruptible(py, &Stop::default(), || {
        speak(|console| kontur::response::table(&args, console))
    })?;
    let table = spoken.answer.map_err(|e| errors::command(py, &e, &spoken.err))?;
    Ok((columns(py, &table)?, spoken.err))
}

/// Choices, the command to paste, and both outputs of the command line.
#[pyfunction]
pub(crate) fn tune(
    py: Python<'_>,
    words: Vec<String>,
) -> PyResult<(Bound<'_, PyDict>, Option<String>, String, String)> {
    let mut args: TuneArgs = arguments::of_command(py, words)?;
    let stop = Stop::default();
    args.simulation.stop = stop.clone();
    let spoken =
        interruptible(py, &stop, || speak(|console| kontur::tune::answer(&args, console)))?;
    let answer = spoken.answer.map_err(|e| errors::command(py, &e, &spoken.err))?;
    Ok((columns(py, &answer.choices)?, answer.command, spoken.out, spoken.err))
}

/// A number or a word.
#[derive(FromPyObject, IntoPyObject)]
pub(crate) enum Value {
    Number(f64),
    Word(String),
}

/// All runs of a sweep, one by one.
#[pyclass(module = "kontur._kontur", frozen)]
pub(crate) struct SweepPlan {
    plan: Plan,
    stop: Stop,
}

#[pymethods]
impl SweepPlan {
    #[new]
    fn new(py: Python<'_>, words: Vec<String>) -> PyResult<Self> {
        let mut args: SweepArgs = arguments::of_command(py, words)?;
        let stop = Stop::default();
        args.simulation.stop = stop.clone();
        let plan = Plan::new(args).map_err(|e| errors::command(py, &e, ""))?;
        Ok(Self { plan, stop })
    }

    fn __len__(&self) -> usize {
        self.plan.len()
    }

    /// Names of the varied parameters.
    fn keys(&self) -> Vec<String> {
        self.plan.keys().map(str::to_owned).collect()
    }

    /// The row of a run under its header.
    fn row(&self, py: Python<'_>, number: usize) -> PyResult<(Vec<String>, Vec<Value>)> {
        let row = interruptible(py, &self.stop, || self.plan.row(number))?;
        let (header, cells) = row.map_err(|e| errors::open(py, e))?;
        let value = |cell: &Cell| match cell.number() {
            Some(x) => Value::Number(x),
            None => Value::Word(cell.text()),
        };
        Ok((header, cells.iter().map(value).collect()))
    }

    /// Keys of the parameters that make no difference to any row; `rows` are all of them, in their order.
    fn without_effect(&self, rows: Vec<Vec<Value>>) -> Vec<String> {
        let cell = |value| match value {
            Value::Number(x) => Cell::Given(x),
            Value::Word(word) => Cell::Word(word),
        };
        let rows: Vec<Vec<Cell>> =
            rows.into_iter().map(|row| row.into_iter().map(cell).collect()).collect();
        self.plan.without_effect(&rows).into_iter().map(str::to_owned).collect()
    }

    /// Stops the runs in other threads.
    fn stop(&self) {
        self.stop.set();
    }
}
