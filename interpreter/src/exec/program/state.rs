//! State of a program from block to block: its levels with their control blocks, its calls, its known block numbers.

use super::index::{EntryId, Index, Keyword, Labels};
use super::info::ProgramInfo;
use crate::exec::block::modal::Modal;
use crate::exec::options::Value;
use crate::exec::step::SourceRef;
use crate::machine::Channel;
use crate::source::Position;
use crate::syntax::ast::{Place, Span};
use std::collections::BTreeMap;
use std::sync::Arc;

/// One program level.
#[derive(Debug)]
pub(in crate::exec) struct Level {
    pub(in crate::exec::program) file: usize,
    pub(in crate::exec::program) section: usize,
    pub(in crate::exec::program) index: Arc<Index>,
    /// Next block.
    pub(in crate::exec::program) at: Position,
    pub(in crate::exec::program) end: u64,
    /// Position at which it begins again, and the number of passes left (REPEAT of `L SEQUENCE`).
    pub(in crate::exec::program) begin: Position,
    pub(in crate::exec::program) passes: u32,
    pub(in crate::exec::program) frames: Vec<Frame>,
    /// Modal state to be restored; present if the level is a cycle.
    pub(in crate::exec::program) cycle: Option<Box<BeforeCycle>>,
    /// Whether it is between `#VAR` and `#ENDVAR`.
    pub(in crate::exec::program) declarations: bool,
    /// Whether a line in it was no declaration: a missing `#ENDVAR` is reported once.
    pub(in crate::exec::program) undeclared: bool,
    /// Start of the present section between `#OPTIONAL EXECUTION ON` and `OFF`.
    pub(in crate::exec::program) optional: Option<(Position, Span)>,
    /// Whether a control block without an end covers the rest of the text.
    pub(in crate::exec::program) cut: bool,
    /// Offsets of the first and last block that jumps back may execute again.
    pub(in crate::exec::program) again: Option<(u64, u64)>,
    /// The block that called it; `None` for a program that no block called.
    pub(in crate::exec::program) caller: Option<SourceRef>,
    /// How the block that called it leaves its own level afterwards.
    pub(in crate::exec::program) then: Option<Closing>,
}

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

impl Level {
    /// Whether the block at a position may run more than once: it is in a loop or its head, or jumps lead back before
    /// it.
    pub(super) fn runs_again(&self, at: Position) -> bool {
        self.is_repeated(at)
            || self.index.at(at).is_some_and(|id| self.index.entry(id).keyword.is_loop())
    }

    /// The same for a block that is no control statement.
    pub(super) fn is_repeated(&self, at: Position) -> bool {
        self.frames.iter().any(|f| f.keyword.is_loop())
            || self.again.is_some_and(|(first, last)| (first..=last).contains(&at.offset))
    }
}

/// An open control block.
#[derive(Clone, Debug)]
pub(in crate::exec) struct Frame {
    pub(in crate::exec::program) open: EntryId,
    pub(in crate::exec::program) keyword: Keyword,
    /// Counter, last value and step of `$FOR`.
    pub(super) counter: Option<Arc<Counter>>,
}

/// Counter, last value and step of `$FOR`.
#[derive(Debug)]
pub(super) struct Counter {
    pub(super) place: Place,
    pub(super) end: f64,
    pub(super) step: f64,
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
