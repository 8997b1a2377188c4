//! The native half of the Python module `kontur`: thin functions over the library; the interface that Python shows is written in Python.
//!
//! Options are the words of the command line, so that each has the same meaning and the same errors in both.

mod answers;
mod arguments;
mod columns;
mod errors;
mod interrupt;
mod simulation;

use pyo3::prelude::*;

/// The native half of `kontur`.
#[pymodule]
mod _kontur {
    #[pymodule_export]
    const NO_DIFFERENCE: &str = kontur::sweep::NO_DIFFERENCE;
    #[pymodule_export]
    const WITHOUT_EFFECT: &str = kontur::sweep::WITHOUT_EFFECT;
    #[pymodule_export]
    use super::answers::{SweepPlan, check, explain, response, tune};
    #[pymodule_export]
    use super::simulation::Simulation;
}
