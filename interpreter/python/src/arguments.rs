//! Options as words of the command line.

use crate::errors::usage;
use clap::{Args, Parser};
use kontur::args::SimulationArgs;
use pyo3::prelude::*;
use std::path::PathBuf;

/// A program and the options of its simulation.
#[derive(Debug, Parser)]
#[command(name = "kontur", no_binary_name = true)]
pub(crate) struct ProgramArgs {
    pub(crate) program: PathBuf,
    #[command(flatten)]
    pub(crate) simulation: SimulationArgs,
}

/// Arguments of a command as a complete line.
#[derive(Debug, Parser)]
#[command(name = "kontur", no_binary_name = true)]
struct Line<A: Args> {
    #[command(flatten)]
    args: A,
}

pub(crate) fn program(py: Python<'_>, words: Vec<String>) -> PyResult<ProgramArgs> {
    ProgramArgs::try_parse_from(words).map_err(|e| wrong(py, &e))
}

pub(crate) fn of_command<A: Args>(py: Python<'_>, words: Vec<String>) -> PyResult<A> {
    Line::<A>::try_parse_from(words).map(|line| line.args).map_err(|e| wrong(py, &e))
}

/// The message of clap, without the help for a shell.
fn wrong(py: Python<'_>, e: &clap::Error) -> PyErr {
    let text = e.to_string();
    let text = text.split("\n\nUsage:").next().unwrap_or_default();
    let text = text.split("\n\nFor more").next().unwrap_or_default();
    usage(py, text.trim_start_matches("error: ").trim_end())
}
