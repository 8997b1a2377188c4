//! The number of blocks that a program may execute.

use crate::exec::options::{Options, Stop};

/// Counts executed blocks, and ends a program that does not end by itself.
#[derive(Debug)]
pub(super) struct Budget {
    blocks: u64,
    /// Blocks since the last motion.
    at_rest: u64,
    max_blocks: u64,
    max_at_rest: u64,
    stop: Stop,
    /// Whether a limit ended the program early.
    is_used_up: bool,
}

/// Whether one more block may be executed.
#[derive(Debug)]
pub(super) enum Verdict {
    Continue,
    /// The program is stopped by its host.
    Stopped,
    /// A limit is exceeded; contains the reason.
    Endless(String),
}

impl Budget {
    pub(super) fn new(options: &Options) -> Self {
        Self {
            blocks: 0,
            at_rest: 0,
            max_blocks: options.max_blocks,
            max_at_rest: options.max_blocks_at_rest,
            stop: options.stop.clone(),
            is_used_up: false,
        }
    }

    /// Counts a block.
    pub(super) fn count(&mut self) -> Verdict {
        self.blocks += 1;
        self.at_rest += 1;
        if self.stop.is_set() {
            self.use_up();
            return Verdict::Stopped;
        }
        if self.blocks > self.max_blocks {
            Verdict::Endless(format!("more than {} blocks (--max-blocks)", self.max_blocks))
        } else if self.at_rest > self.max_at_rest {
            let n = self.max_at_rest;
            Verdict::Endless(format!("{n} blocks without motion: the program does not end"))
        } else {
            Verdict::Continue
        }
    }

    /// Restarts the count of blocks at rest, after a motion or dwell.
    pub(super) fn moved(&mut self) {
        self.at_rest = 0;
    }

    /// Blocks executed so far.
    pub(super) fn blocks(&self) -> u64 {
        self.blocks
    }

    /// A limit ends the program early.
    pub(super) fn use_up(&mut self) {
        self.is_used_up = true;
    }

    pub(super) fn is_used_up(&self) -> bool {
        self.is_used_up
    }
}
