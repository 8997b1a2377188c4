//! Subroutines and macros that the list names, and what remains of the states and variables of a program.

use crate::machine::parameters::Parameters;
use crate::machine::table::channel as of;
use crate::machine::table::param::{Param, Text};
use std::collections::BTreeMap;

/// Subroutines of G80 to G89.
const CYCLE_PROGRAMS: [Param<Text>; 10] = [
    of::G80_PROGRAM,
    of::G81_PROGRAM,
    of::G82_PROGRAM,
    of::G83_PROGRAM,
    of::G84_PROGRAM,
    of::G85_PROGRAM,
    of::G86_PROGRAM,
    of::G87_PROGRAM,
    of::G88_PROGRAM,
    of::G89_PROGRAM,
];

/// Subroutines.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ProgramEntries {
    /// Subroutine called at the start of every program (P-CHAN-00119).
    pub(crate) start: Option<String>,
    /// Subroutine called before the end of every program (P-CHAN-00252).
    pub(crate) end: Option<String>,
    /// Subroutine called by M06 (P-CHAN-00118); `None`: M06 is an ordinary function.
    pub(crate) tool_change: Option<String>,
    /// Subroutine called by D words (P-CHAN-00429).
    pub(crate) tool_data: Option<String>,
    /// Subroutines called by G80 to G89 (P-CHAN-00160 to 00169) and G800 to G839 (P-CHAN-00187), by G number.
    pub(crate) g8x: BTreeMap<u32, String>,
    /// Cycles do not restore modal states at their end (P-CHAN-00210).
    pub(crate) cycle_changes_stay: bool,
}

impl ProgramEntries {
    pub(super) fn of(p: &Parameters) -> Self {
        let program = |param: Param<Text>| p.get(param).filter(|name| !name.is_empty());
        Self {
            start: program(of::START_PROGRAM),
            end: program(of::END_PROGRAM),
            tool_change: program(of::TOOL_CHANGE_PROGRAM),
            tool_data: program(of::TOOL_DATA_PROGRAM),
            g8x: (80..)
                .zip(CYCLE_PROGRAMS)
                .chain((0..40).map(|i| (800 + i, of::G800_PROGRAM.at(i))))
                .filter_map(|(g, param)| Some((g, p.get(param)?)))
                .filter(|(_, program)| program != "*")
                .collect(),
            cycle_changes_stay: p.get(of::CYCLE_CHANGES_STAY),
        }
    }
}

/// Macros.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct MacroEntries {
    /// Macros available in every program (P-CHAN-00085), with their NC code (P-CHAN-00062).
    pub(crate) listed: BTreeMap<Box<str>, Box<str>>,
    /// Maximum number of characters in the name of a macro (P-CHAN-00511).
    pub(crate) name_length: u32,
    /// Maximum number of characters in the text of a macro (P-CHAN-00512).
    pub(crate) text_length: u32,
}

impl MacroEntries {
    pub(super) fn of(p: &Parameters) -> Self {
        Self {
            listed: macros(p),
            name_length: p.get(of::MACRO_NAME_LENGTH),
            text_length: p.get(of::MACRO_TEXT_LENGTH),
        }
    }
}

/// The macros of the list that have both a name and a text.
fn macros(p: &Parameters) -> BTreeMap<Box<str>, Box<str>> {
    let both = |(i, name): (u32, String)| {
        let code = p.get(of::MACRO_CODE.at(i))?;
        Some((name.into(), code.replace("\\\"", "\"").into()))
    };
    p.array(of::MACRO_NAME).filter(|(_, name)| !name.is_empty()).filter_map(both).collect()
}

/// Variables of a program.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct VariableEntries {
    /// P parameters survive program start (P-CHAN-00067).
    pub(crate) keep_p_parameters: bool,
    /// Reading a `@P` parameter that was not passed creates it (P-CHAN-00463).
    pub(crate) creates_cycle_parameters: bool,
}

impl VariableEntries {
    pub(super) fn of(p: &Parameters) -> Self {
        Self {
            keep_p_parameters: p.get(of::KEEP_P_PARAMETERS),
            creates_cycle_parameters: p.get(of::CREATES_PARAMETERS),
        }
    }
}
