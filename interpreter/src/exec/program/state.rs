//! State of a program from block to block: its calls, its known block numbers.

use super::index::Labels;
use super::info::ProgramInfo;
use crate::exec::block::modal::Modal;
use crate::exec::options::Value;
use crate::machine::Channel;
use crate::syntax::ast::Span;
use std::collections::BTreeMap;

/// Target of a call: a file, and a program in it.
#[derive(Clone, Copy, Debug)]
pub(in crate::exec) struct Target {
    pub(super) file: usize,
    pub(super) section: usize,
}

/// The way a block leaves its level.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::exec) enum Closing {
    /// M17, M29.
    Return,
    /// M02, M30.
    End,
}

/// State before a cycle.
#[derive(Clone, Debug)]
pub(in crate::exec) struct BeforeCycle {
    pub(super) modal: Modal,
    pub(super) systems: usize,
    /// Zero-offset group, and whether it was selected by G159.
    pub(super) zero_group: (u32, bool),
    /// G135.
    pub(super) feedforward: bool,
    /// G151.
    pub(super) spline: bool,
    /// The same for the enclosing cycle.
    pub(super) retains: bool,
}

/// State of calls: the subroutines called by words, and those called after every block.
#[derive(Debug, Default)]
pub(in crate::exec) struct Calls {
    pub(in crate::exec) info: ProgramInfo,
    /// Macros and their texts.
    pub(in crate::exec) macros: BTreeMap<Box<str>, Box<str>>,
    /// Whether the table of macros has changed, so that parsed blocks are out of date.
    pub(in crate::exec) macros_changed: bool,
    /// Subroutines of G80 to G89 and G800 to G839.
    pub(in crate::exec) cycle_files: BTreeMap<u32, String>,
    /// Subroutine of M06.
    pub(in crate::exec) tool_change_file: Option<String>,
    /// Subroutine of D words.
    pub(in crate::exec) tool_data_file: Option<String>,
    /// Cycle called after every motion or block.
    pub(in crate::exec) modal_cycle: Option<ModalCycle>,
    /// `V.G.CYCLE_CHANGES_MODAL`, P-CHAN-00210: cycles do not restore anything.
    pub(in crate::exec) cycle_changes_stay: bool,
    /// `V.G.MAX_NC_BLOCKS_AHEAD` and `V.G.MAX_MOTION_BLOCKS_AHEAD`; 0: unlimited.
    pub(in crate::exec) blocks_ahead: [f64; 2],
    /// `#RETAIN CYCLE CHANGES`, or the rule for all cycles: the current cycle does not restore anything.
    pub(in crate::exec) retain_cycle_changes: bool,
    /// Configuration saved by `#SAVE CONFIG` in this run.
    pub(in crate::exec) saved: SavedConfiguration,
    /// Open `#RT WHILE`.
    pub(in crate::exec) real_time_loop: Option<Span>,
    /// `#FILE EXIST`.
    pub(in crate::exec) searched: Searched,
}

/// Configuration saved by `#SAVE CONFIG`: a run does not take over that of earlier programs.
#[derive(Clone, Copy, Debug, Default)]
pub(in crate::exec) struct SavedConfiguration {
    /// The axes of the channel.
    pub(in crate::exec) axes: bool,
    /// The axis couplings that are switched on.
    pub(in crate::exec) couplings: bool,
}

impl Calls {
    /// State at program start, with the macros and subroutines of the channel list.
    pub(in crate::exec) fn new(channel: &Channel) -> Self {
        Self {
            macros: channel.macros.listed.clone(),
            cycle_files: channel.programs.g8x.clone(),
            tool_change_file: channel.programs.tool_change.clone(),
            tool_data_file: channel.programs.tool_data.clone(),
            cycle_changes_stay: channel.programs.cycle_changes_stay,
            ..Self::default()
        }
    }
}

/// Search and result of `#FILE EXIST`.
#[derive(Debug, Default)]
pub(in crate::exec) struct Searched {
    /// Name searched by the current block, and its position.
    pub(in crate::exec) wanted: Option<(Box<str>, Span)>,
    /// Path with `\\` between folders, relative to the folder of the searching program if it lies below that folder.
    pub(in crate::exec) found: Option<Box<str>>,
}

impl Searched {
    /// `V.G.FILE_EXIST_PATH_NAME`.
    pub(in crate::exec) fn path(&self) -> &str {
        self.found.as_deref().unwrap_or("")
    }

    /// `V.G.FILE_EXIST_DIRECTORY`.
    pub(in crate::exec) fn folder(&self) -> &str {
        match self.path().rfind('\\') {
            Some(last) => &self.path()[..=last],
            None if self.found.is_some() => ".\\",
            None => "",
        }
    }
}

/// Values passed to a cycle, by the name after `@`.
pub(super) type Passed = BTreeMap<Box<str>, Value>;

/// A cycle called after every motion or block.
#[derive(Clone, Debug)]
pub(in crate::exec) struct ModalCycle {
    pub(super) target: Target,
    /// Position of its name in the call.
    pub(super) named: Span,
    pub(super) passed: Passed,
    /// Whether it is called after every block, not only after motions.
    pub(super) every_block: bool,
}

/// Block numbers of the programs needed for sequences or returns, by file and section.
#[derive(Debug, Default)]
pub(in crate::exec) struct Sequences {
    pub(super) known: BTreeMap<(usize, usize), Numbers>,
}

/// Block numbers of a program.
#[derive(Debug, Default)]
pub(super) struct Numbers {
    /// The first block with each number.
    pub(super) first: Labels,
    /// Line of a second block with the same number.
    pub(super) twice: BTreeMap<u64, u32>,
}
