//! A row of the table.

use crate::diag::id::{Id, Severity};

/// The immediate reaction of the control.
///
/// Source: TF5200 diagnosis manual, reaction classes; the discriminant is the class as printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[repr(u8)]
pub enum Reaction {
    /// Class 1: none, the run continues.
    None = 1,
    /// Class 2: the program is aborted, prepared blocks are still executed.
    ProgramAbort = 2,
    /// Class 3: the job (loading a list) is aborted.
    JobAbort = 3,
    /// Class 4: feed hold for the whole axis group.
    FeedHold = 4,
    /// Class 5: the axis stops abruptly, the others of the group feed hold.
    AbruptStop = 5,
    /// Class 6: all axes stop abruptly.
    AllStop = 6,
    /// Class 7: the axis stops under control, the others feed hold.
    ControlledStop = 7,
    /// Class 8: the axis stops with the position loop opened, the others feed hold.
    OpenLoopStop = 8,
}

impl Reaction {
    /// Class as the manual prints it, 1 to 8.
    pub const fn class(self) -> u8 {
        self as u8
    }

    /// The reaction in words.
    pub const fn text(self) -> &'static str {
        match self {
            Self::None => "none, the run continues",
            Self::ProgramAbort => "the program is aborted, prepared blocks are still driven",
            Self::JobAbort => "the job (loading a list) is aborted",
            Self::FeedHold => "feed hold for the whole axis group",
            Self::AbruptStop => "the faulty axis stops abruptly, the others feed hold",
            Self::AllStop => "all axes stop abruptly",
            Self::ControlledStop => "the faulty axis stops under control, the others feed hold",
            Self::OpenLoopStop => {
                "the faulty axis stops with its position loop opened, the others feed hold"
            }
        }
    }
}

/// Properties of an ID.
#[derive(Clone, Copy, Debug)]
pub struct Row {
    /// The ID.
    pub id: Id,
    /// Short name of kontur's own conditions (`K-CHAR`), empty for vendor numbers.
    pub name: &'static str,
    /// Severity, unless a diagnostic sets another one.
    pub severity: Severity,
    /// The immediate reaction of the control.
    pub reaction: Reaction,
    /// Remedy class as printed on the vendor's pages.
    pub remedy: u8,
    /// Root type: 1 NC program, 2 parameter lists, 11 position controller, 0 none.
    pub root: u8,
    /// Meaning in a few words.
    pub meaning: &'static str,
    /// Cause or violated rule; empty if it follows from the meaning.
    pub cause: &'static str,
    /// What to do about it, unless the code that raises it has a better hint.
    pub hint: Option<&'static str>,
    /// Parameter concerned, if it is always the same one.
    pub parameter: Option<&'static str>,
    /// Remark for `explain`, such as where the documents disagree; empty if there is none.
    pub note: &'static str,
}

impl Row {
    /// How to bring the control back to operation. Source: TF5200 diagnosis manual, interface description.
    pub(crate) const fn remedy_text(&self) -> &'static str {
        match self.remedy {
            1 => "nothing to do, remedied internally",
            2 | 3 => "reset of the channel",
            4..=6 => "complete reset of the channel",
            7 => "restart of the control",
            8 => "restart after power-off",
            _ => "not documented",
        }
    }
}
