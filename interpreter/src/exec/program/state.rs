//! State of a program from block to block: its levels with their control blocks, its calls, its known numbers.

use super::index::{EntryId, Index, Keyword, Labels};
use super::info::ProgramInfo;
use crate::exec::block::modal::Modal;
use crate::exec::options::Value;
use crate::machine::Channel;
use crate::source::Position;
use crate::syntax::ast::{Place, Span};
use std::collections::BTreeMap;
use std::sync::Arc;

/// One program level.
#[derive(Debug)]
pub(in crate::exec) struct Level {
    pub(in crate::exec) file: usize,
    pub(in crate::exec) section: usize,
    pub(in crate::exec) index: Arc<Index>,
    /// Next block.
    pub(in crate::exec) at: Position,
    pub(in crate::exec) end: u64,
    /// Where it begins again, and how often (REPEAT of `L SEQUENCE`).
    pub(in crate::exec) begin: Position,
    pub(in crate::exec) passes: u32,
    pub(in crate::exec) frames: Vec<Frame>,
    /// Modal state to return to: the level is a cycle.
    pub(in crate::exec) cycle: Option<Box<BeforeCycle>>,
    /// Between `#VAR` and `#ENDVAR`.
    pub(in crate::exec) declarations: bool,
    /// Between `#OPTIONAL EXECUTION ON` and `OFF`: where it began.
    pub(in crate::exec) optional: Option<(Position, Span)>,
    /// A control block without its end took the rest of the text.
    pub(in crate::exec) cut: bool,
    /// First and last block that jumps back lead through again, by their offsets.
    pub(in crate::exec) again: Option<(u64, u64)>,
    /// What the block that called it does after it.
    pub(in crate::exec) then: Option<Closing>,
}

/// What a call names: a file, and a program in it.
#[derive(Clone, Copy, Debug)]
pub(in crate::exec) struct Target {
    pub(super) file: usize,
    pub(super) section: usize,
}

/// How a block leaves its level.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::exec) enum Closing {
    /// M17, M29.
    Return,
    /// M02, M30.
    End,
}

impl Level {
    /// A block at a place of it may run more than once: it is in a loop, also as its head, or jumps lead back.
    pub(super) fn runs_again(&self, at: Position) -> bool {
        self.frames.iter().any(|f| f.keyword.is_loop())
            || self.again.is_some_and(|(first, last)| (first..=last).contains(&at.offset))
            || self.index.at(at).is_some_and(|id| self.index.entry(id).keyword.is_loop())
    }
}

/// An open control block.
#[derive(Clone, Debug)]
pub(in crate::exec) struct Frame {
    pub(in crate::exec) open: EntryId,
    pub(in crate::exec) keyword: Keyword,
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
    /// Zero-offset group, and whether G159 selected it.
    pub(super) zero_group: (u32, bool),
    /// G135.
    pub(super) feedforward: bool,
    /// G151.
    pub(super) spline: bool,
    /// The same of the cycle around.
    pub(super) retains: bool,
}

/// What calls own: subroutines that words call, and what is called after every block.
#[derive(Debug, Default)]
pub(in crate::exec) struct Calls {
    pub(in crate::exec) info: ProgramInfo,
    /// Macros and their texts.
    pub(in crate::exec) macros: BTreeMap<Box<str>, Box<str>>,
    /// The table of macros has changed: parsed blocks are out of date.
    pub(in crate::exec) macros_changed: bool,
    /// Subroutines of G80 to G89 and G800 to G839.
    pub(in crate::exec) cycle_files: BTreeMap<u32, String>,
    /// Subroutine of M06.
    pub(in crate::exec) tool_change_file: Option<String>,
    /// Subroutine of D words.
    pub(in crate::exec) tool_data_file: Option<String>,
    /// Cycle that is called after every motion or block.
    pub(in crate::exec) modal_cycle: Option<ModalCycle>,
    /// `V.G.CYCLE_CHANGES_MODAL`, P-CHAN-00210: cycles give nothing back.
    pub(in crate::exec) cycle_changes_stay: bool,
    /// `V.G.MAX_NC_BLOCKS_AHEAD` and `V.G.MAX_MOTION_BLOCKS_AHEAD`, 0 without a limit.
    pub(in crate::exec) blocks_ahead: [f64; 2],
    /// `#RETAIN CYCLE CHANGES`, or what cycles do: the cycle in work gives nothing back.
    pub(in crate::exec) retain_cycle_changes: bool,
    /// What `#SAVE CONFIG` has saved in this run.
    pub(in crate::exec) saved: SavedConfiguration,
    /// `#RT WHILE` without its end so far.
    pub(in crate::exec) real_time_loop: Option<Span>,
    /// `#FILE EXIST`.
    pub(in crate::exec) searched: Searched,
}

/// What `#SAVE CONFIG` has saved: a run begins without what earlier programs left.
#[derive(Clone, Copy, Debug, Default)]
pub(in crate::exec) struct SavedConfiguration {
    /// The axes of the channel.
    pub(in crate::exec) axes: bool,
    /// The axis couplings that are switched on.
    pub(in crate::exec) couplings: bool,
}

impl Calls {
    /// At program start, with the macros and subroutines of the channel list.
    pub(in crate::exec) fn new(channel: &Channel) -> Self {
        Self {
            macros: channel.macros.clone(),
            cycle_files: channel.g8x_programs.clone(),
            tool_change_file: channel.tool_change_program.clone(),
            tool_data_file: channel.tool_data_program.clone(),
            cycle_changes_stay: channel.cycle_changes_stay,
            ..Self::default()
        }
    }
}

/// What `#FILE EXIST` searches and has found.
#[derive(Debug, Default)]
pub(in crate::exec) struct Searched {
    /// Name that the block in work searches, and its place.
    pub(in crate::exec) wanted: Option<(Box<str>, Span)>,
    /// Path with `\\` between folders, relative to the folder of the program that has searched if it lies below it.
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

/// Values of a cycle by the name after `@`.
pub(super) type Passed = BTreeMap<Box<str>, Value>;

/// A cycle that follows every motion or block.
#[derive(Clone, Debug)]
pub(in crate::exec) struct ModalCycle {
    pub(super) target: Target,
    /// The place of its name in the call.
    pub(super) named: Span,
    pub(super) passed: Passed,
    /// After every block, not only after motions.
    pub(super) every_block: bool,
}

/// Block numbers of the programs that sequences or returns asked for, by file and section.
#[derive(Debug, Default)]
pub(in crate::exec) struct Sequences {
    pub(super) known: BTreeMap<(usize, usize), Numbers>,
}

/// Block numbers of a program.
#[derive(Debug, Default)]
pub(super) struct Numbers {
    /// The first block of each.
    pub(super) first: Labels,
    /// Line of a second block with the same number.
    pub(super) twice: BTreeMap<u64, u32>,
}
