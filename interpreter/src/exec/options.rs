//! Options for the execution of a program.

use crate::diag::Location;
use kontur_filters::vib_guard::VibGuardSettings;
use std::collections::BTreeMap;
use std::fmt;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Active levels of `/` blocks: bit 0 is level 1, bit 9 level 10.
///
/// Source: TF5200 skipping of NC blocks.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SkipLevels(u16);

impl SkipLevels {
    /// No block is skipped.
    pub const NONE: Self = Self(0);
    /// Every `/` block is skipped.
    pub const ALL: Self = Self(0x3FF);

    /// Activates a level from 1 to 10; other values are ignored.
    #[must_use]
    pub const fn with(self, level: u8) -> Self {
        if level >= 1 && level <= 10 { Self(self.0 | 1 << (level - 1)) } else { self }
    }

    /// Whether blocks of this level are skipped.
    pub const fn contains(self, level: u8) -> bool {
        level >= 1 && level <= 10 && self.0 & 1 << (level - 1) != 0
    }
}

/// A value of the language.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// Numbers and truth values.
    Number(f64),
    /// A text.
    Text(Box<str>),
}

/// Access rights of an external variable.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Access {
    /// Reading and writing.
    #[default]
    ReadWrite,
    /// Reading; a write is 20100.
    ReadOnly,
    /// Writing; a read is 20097.
    WriteOnly,
}

/// An external variable `V.E.`.
#[derive(Clone, Debug, PartialEq)]
pub struct External {
    /// Value at program start.
    pub value: Value,
    /// Access rights.
    pub access: Access,
}

/// A Vibration Guard that replaces the one of lists and program, to try its effect on a program.
///
/// `OFF`, `ACC_FACT` and an `AX_DEV` of the program still apply; its MODE, FREQ and DAMPING do not.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ForcedGuard {
    /// On for every path axis from program start with these settings; `None`: off until the program switches it on.
    pub settings: Option<VibGuardSettings>,
    /// Tolerance in mm where the program does not set one: from program start, and in commands without `AX_DEV`.
    pub ax_dev_mm: Option<f64>,
}

/// Commands of a program for the Vibration Guard, in the order of execution.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct GuardCommands {
    /// The first one that switches it on.
    pub on: Option<Location>,
    /// The first one that switches it off.
    pub off: Option<Location>,
    /// The first one that names MODE, FREQ or DAMPING.
    pub settings: Option<Location>,
    /// The first one that names `AX_DEV`, and its value as written.
    pub ax_dev: Option<(Location, f64)>,
    /// The first one that switches it on without `AX_DEV`.
    pub on_without_ax_dev: Option<Location>,
}

/// Ends a check or a run from another thread; clones share their state.
///
/// Read before every block and every cycle that is planned, and while a plan is searched. A stopped run is aborted without a message, because the caller who
/// stops it knows the reason.
#[derive(Clone, Default)]
pub struct Stop(Arc<AtomicBool>);

impl Stop {
    /// Stops every run that has a clone.
    pub fn set(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// What stops it, for parts that do not know this type.
    pub(crate) fn flag(&self) -> Arc<AtomicBool> {
        Arc::clone(&self.0)
    }

    /// Whether it was stopped.
    pub(crate) fn is_set(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

impl fmt::Debug for Stop {
    /// Omits the state, which has no influence on the result.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Stop")
    }
}

impl PartialEq for Stop {
    /// Any two are equal: stopping does not change the result.
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

/// Options of an execution.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// Start positions in mm (deg) by axis name; axes not named start at 0.
    pub start: Vec<(String, f64)>,
    /// Skip levels.
    pub skip: SkipLevels,
    /// Blocks after which a program is stopped (K-0017), default 1e9.
    pub max_blocks: u64,
    /// Blocks without motion or dwell after which a program counts as endless (K-0017), default 1e7.
    pub max_blocks_at_rest: u64,
    /// Program time in s after which a run is stopped (K-0017), default unlimited; a check also ends there, based on the
    /// programmed feed rates and dwells.
    pub max_time_s: f64,
    /// Treats `#TRAFO ON` and related commands as identity, with a warning, instead of refusing them.
    pub identity_trafo: bool,
    /// Whether the path waits for durations of M, H, S and T functions declared in the lists (P-CHAN-00026, 00040, 00042 to 00048, 00072,
    /// 00080).
    pub techno_times: bool,
    /// External variables by their name after `V.E.`, as the PLC sets them: with the types of the machine's list, whatever
    /// the access rights it gives to programs.
    pub external: BTreeMap<String, External>,
    /// Vibration Guard that replaces that of lists and program.
    pub guard: Option<ForcedGuard>,
    /// Stops the run from outside.
    pub stop: Stop,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            start: Vec::new(),
            skip: SkipLevels::NONE,
            max_blocks: 1_000_000_000,
            max_blocks_at_rest: 10_000_000,
            max_time_s: f64::INFINITY,
            identity_trafo: false,
            techno_times: false,
            external: BTreeMap::new(),
            guard: None,
            stop: Stop::default(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::SkipLevels;

    #[test]
    fn levels_are_the_bits_of_the_vendors_mask() {
        let levels = SkipLevels::NONE.with(1).with(3).with(0).with(11);
        assert_eq!(
            (levels.contains(1), levels.contains(2), levels.contains(3)),
            (true, false, true)
        );
        assert!((1..=10).all(|level| SkipLevels::ALL.contains(level)));
    }
}
