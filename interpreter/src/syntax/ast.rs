//! The syntax tree of one block: the text as written, not its effect on the machine.
//!
//! Every node has a [`Span`] into the text of its block. `PartialEq` compares spans, too: trees that differ only in
//! their spans are not equal.
//!
//! Case: letters of addresses, command words, keys and functions are stored in upper case. Names that the dialect
//! compares exactly (variables, macros, files, strings) and identifier values (`TYPE=HSC`, `NAME=a.nc`) are stored as
//! written; [`Ident::is`] compares them without regard to case.
//!
//! Order of calls: created by [`Parser::block`](super::Parser::block), read when the block is decoded or printed.
//!
//! ```
//! use kontur_interpreter::source::RawBlock;
//! use kontur_interpreter::syntax::Parser;
//! use kontur_interpreter::syntax::ast::{BlockNumber, Body, WordKind};
//!
//! let (file, mut said) = ("part.nc".into(), Vec::new());
//! let block = Parser::new([]).block(&RawBlock::from_line("N10 G01 X5"), &file, &mut said);
//! assert_eq!(block.number, Some(BlockNumber::Literal(10)));
//! let Body::Words(words) = &block.body else { panic!("a block of words") };
//! assert!(matches!(words[0].kind, WordKind::G { number: 1, .. }));
//! assert!(matches!(words[1].kind, WordKind::Address { .. }));
//! ```

mod command;
mod control;
mod expr;
mod word;

pub use crate::source::Span;
pub use command::{Command, Group, Ident, Item, ItemKind, ItemValue};
pub use control::{Control, ControlKind, Declaration, ProgramHead};
pub use expr::{
    Binary, BinaryOp, Expr, ExprKind, Function, FunctionCall, ParameterIndex, Place, PlaceKind,
    Segment, Sign,
};
pub use word::{
    Assign, Bracket, Call, CallKind, CodeNumber, GValue, HashWord, MacroDefinition, Name, Return,
    ReturnLevel, Word, WordKind,
};

/// One block of an NC program.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Block {
    /// Skip level 1 to 10 (`/` alone is level 1).
    pub skip: Option<u8>,
    /// Block number (`N10`, `N[P1+5]`); also set for a label `N10:`.
    pub number: Option<BlockNumber>,
    /// Jump label at the beginning of the block.
    pub label: Option<Label>,
    /// Content of the block.
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

/// Target of `$GOTO`.
#[derive(Clone, Debug, PartialEq)]
pub struct Jump {
    /// Label, or the expression that yields it.
    pub kind: JumpKind,
    /// Place.
    pub span: Span,
}

/// The way the target of a jump is written.
#[derive(Clone, Debug, PartialEq)]
pub enum JumpKind {
    /// `N20`, `[NAME]`.
    Label(LabelKind),
    /// `NV.E.NUMBER`, `NP1`, `N[P1+10]`: the number of a label.
    Number(Box<Expr>),
    /// `V.E.NAME`: the text is the name of a label.
    Name(Box<Place>),
}

/// Jump label.
#[derive(Clone, Debug, PartialEq)]
pub struct Label {
    /// Kind.
    pub kind: LabelKind,
    /// Place.
    pub span: Span,
}

/// Kind of a jump label.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum LabelKind {
    /// `N10:`.
    Number(u64),
    /// `[NAME]`, in upper case: labels are not case-sensitive.
    Name(Box<str>),
}

/// Content of a block.
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
