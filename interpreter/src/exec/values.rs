//! Values of expressions: numbers, texts, functions, variables and readable states of the control.
//!
//! Owns the variables and timers. It reads the state that system variables show, and changes no other state, except through the
//! few writable system variables.

pub(super) mod every_axis;
pub(super) mod expr;
pub(super) mod functions;
pub(super) mod number;
pub(super) mod system;
pub(super) mod timers;
pub(super) mod variables;

use super::options::External;
use std::collections::BTreeMap;
use timers::Timers;
use variables::scopes::Variables;

/// State that the values own.
#[derive(Debug)]
pub(super) struct Values {
    pub(super) variables: Variables,
    /// `V.G.KIN..` under `--identity-trafo`, by their names with indices: accepted without effect.
    pub(super) kinematics: BTreeMap<String, f64>,
    pub(super) timers: Timers,
    /// `V.TLM.TIME_FACT` and `V.TLM.DIST_FACT`: stored without effect. Source: TF5200 programming manual, 208584843.
    pub(super) tool_life: [f64; 2],
}

impl Values {
    /// At program start.
    pub(super) fn new(external: BTreeMap<String, External>) -> Self {
        let variables = Variables::new(external);
        Self {
            variables,
            kinematics: BTreeMap::new(),
            timers: Timers::default(),
            tool_life: [1.0; 2],
        }
    }
}
