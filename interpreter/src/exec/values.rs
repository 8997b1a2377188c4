//! Values of expressions: numbers, texts, functions, variables and the readable state of the control.
//!
//! Owns the variables. Reads the state shown by system variables, and changes it only through the few system
//! variables that may be written.

pub(super) mod every_axis;
pub(super) mod expr;
pub(super) mod functions;
pub(super) mod number;
pub(super) mod system;
pub(super) mod timers;
pub(super) mod variables;

use crate::machine::ExternalVariables;
use std::collections::BTreeMap;
use variables::scopes::Variables;

/// State owned by this module.
#[derive(Debug)]
pub(super) struct Values {
    pub(super) variables: Variables,
    /// `V.G.KIN..` under `--identity-trafo`, by their names with indices; stored without effect.
    kinematics: BTreeMap<String, f64>,
    /// `V.TLM.TIME_FACT` and `V.TLM.DIST_FACT`; stored without effect. Source: TF5200 programming manual, 208584843.
    tool_life: [f64; 2],
}

impl Values {
    /// State at program start.
    pub(super) fn new(external: &ExternalVariables) -> Self {
        let variables = Variables::new(external);
        Self { variables, kinematics: BTreeMap::new(), tool_life: [1.0; 2] }
    }
}
