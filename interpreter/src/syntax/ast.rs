//! The syntax tree of one block: what was written, not what the machine would do.
//!
//! Every node carries a [`Span`] into the text of its block. Two trees that differ
//! in nothing but spans are not equal: `PartialEq` compares spans too.
//!
//! Case: letters of addresses, command words, keys and functions are stored in upper case. Names that the dialect
//! compares exactly (variables, macros, files, strings) and identifier values (`TYPE=HSC`, `NAME=a.nc`) are stored as
//! written; [`Ident::is`] compares them without case.

mod command;
mod control;
mod expr;
mod word;

pub use command::{Command, Group, Ident, Item, ItemKind, ItemValue};
pub use control::{Control, ControlKind, Declaration, ProgramHead};
pub use expr::{
    Binary, BinaryOp, Expr, ExprKind, Function, FunctionCall, ParameterIndex, Place, PlaceKind,
    Segment,
};
pub use word::{
    Assign, Bracket, Call, CallKind, CodeNumber, GValue, HashWord, MacroDefinition, Name, Word,
    WordKind,
};

/// A piece of the text of a block, in bytes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Span {
    /// Offset of the first byte from the start of the block's text.
    pub start: u32,
    /// Length in bytes; 0 marks a place between two bytes.
    pub len: u32,
}

impl Span {
    /// The span from `start` up to, but not including, `end` (bytes of the block's text).
    pub fn new(start: usize, end: usize) -> Self {
        let clamp = |v: usize| u32::try_from(v).unwrap_or(u32::MAX);
        Self { start: clamp(start), len: clamp(end.saturating_sub(start)) }
    }

    /// First byte behind the span.
    pub fn end(self) -> u32 {
        self.start.saturating_add(self.len)
    }

    /// The smallest span that holds both.
    #[must_use]
    pub fn to(self, other: Self) -> Self {
        let start = self.start.min(other.start);
        Self { start, len: self.end().max(other.end()) - start }
    }
}

/// One block of an NC program.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Block {
    /// Skip level 1 to 10 (`/` alone is level 1).
    pub skip: Option<u8>,
    /// Block number (`N10`, `N[P1+5]`); also set for a label `N10:`.
    pub number: Option<BlockNumber>,
    /// Jump label at the beginning of the block.
    pub label: Option<Label>,
    /// The rest.
    pub body: Body,
    /// The whole block without blanks and comments at its ends.
    pub span: Span,
}

/// Block number as written.
#[derive(Clone, Debug, PartialEq)]
pub enum BlockNumber {
    /// Digits.
    Literal(u64),
    /// `N[expr]`; to be rounded to an integer.
    Computed(Box<Expr>),
}

/// Jump label, or the target of a jump.
#[derive(Clone, Debug, PartialEq)]
pub struct Label {
    /// Which.
    pub kind: LabelKind,
    /// Place.
    pub span: Span,
}

/// Kind of a jump label.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum LabelKind {
    /// `N10:`; as a target also `N10`.
    Number(u64),
    /// `[NAME]`, in upper case: labels have no case.
    Name(Box<str>),
}

/// What a block consists of.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Body {
    /// Nothing, or comments only.
    #[default]
    Empty,
    /// DIN words, assignments, macros, calls (`L`, `LL`) and `$GOTO`, in written order.
    Words(Vec<Word>),
    /// A plain-text command (`#...`).
    Command(Box<Command>),
    /// A control statement (`$...`).
    Control(Box<Control>),
    /// A program head (`%...`).
    ProgramHead(Box<ProgramHead>),
    /// Declarations; only between `#VAR` and `#ENDVAR`.
    Declarations(Vec<Declaration>),
}
