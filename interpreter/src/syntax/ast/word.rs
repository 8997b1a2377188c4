//! Words of a block: addresses, names, assignments and calls.

use super::{BinaryOp, Expr, Group, Ident, Jump, Place, Sign, Span};

/// One word of a block.
#[derive(Clone, Debug, PartialEq)]
pub struct Word {
    /// Kind.
    pub kind: WordKind,
    /// Place, value included.
    pub span: Span,
}

/// Kind and contents of a word.
#[derive(Clone, Debug, PartialEq)]
pub enum WordKind {
    /// `G01`, `G131=50`, `G04 P1`, `G80[1,,3]`. The parser does not know whether a G function takes a value.
    G {
        /// Number without leading zeros; `u32::MAX` if it does not fit.
        number: u32,
        /// Value or list.
        value: Option<Box<GValue>>,
    },
    /// `G[60 - 7]`, the expanded form of `G"NAME"`.
    ComputedG(Box<Expr>),
    /// `M30`, `M200=800`, `M@P6`.
    M(CodeNumber, Option<Box<Expr>>),
    /// `M17 [MAIN [END]]`, `M29 [JUMPS=2 N100]`.
    Return(Box<Return>),
    /// `H5`, `H5=2`.
    H(CodeNumber, Option<Box<Expr>>),
    /// Letter or name with a value: axes, `F`, `S`, `I J K`, `R`, `T`, `D`, `E`, `O`, ...
    Address {
        /// Address.
        name: Name,
        /// First sign of the value: the direction of rotation of a modulo axis.
        sign: Option<Sign>,
        /// Value, the first sign included.
        value: Expr,
    },
    /// Axis or spindle command: `X[OVERRIDE FEED_FACT=50]`, `S[M3 REV1000]`, `S2[G136=80]`.
    Bracket(Box<Bracket>),
    /// `P1=5`, `V.P.A[2]=3`, `V.E.NAME="text"`.
    Assign(Box<Assign>),
    /// `"NAME" = "text"`.
    MacroDefinition(Box<MacroDefinition>),
    /// `"NAME"` in place of words; present only if the macro was not expanded before parsing.
    MacroUse(Box<str>),
    /// A `#` word among DIN words: `#FRC=50`, `#CHR`, `#ANG=30`, `#PSET`, ...
    Hash(Box<HashWord>),
    /// Subroutine call.
    Call(Box<Call>),
    /// `$GOTO target`.
    Goto(Box<Jump>),
}

/// Value of a G function.
#[derive(Clone, Debug, PartialEq)]
pub enum GValue {
    /// `G131=50`, `G04 2.5`.
    Scalar(Expr),
    /// `G80 [1, 2, , 4]`: only for G80 to G89 and G800 to G899; an empty place is `None`.
    List(Vec<Option<Expr>>),
}

/// Number of an M or H function.
#[derive(Clone, Debug, PartialEq)]
pub enum CodeNumber {
    /// Digits; `u32::MAX` if they do not fit.
    Literal(u32),
    /// `M@P6`, `MP1`, `M[P1+1]`.
    Computed(Box<Expr>),
}

/// End of a subroutine that states where the program continues.
#[derive(Clone, Debug, PartialEq)]
pub struct Return {
    /// 17 or 29.
    pub number: u32,
    /// Level to return to.
    pub level: ReturnLevel,
    /// Target at that level; without it, the program continues after the call.
    pub target: Option<Jump>,
}

/// Level to return to.
#[derive(Clone, Debug, PartialEq)]
pub enum ReturnLevel {
    /// That of the call.
    Caller,
    /// `MAIN`: the main program.
    Main,
    /// `JUMPS=2`: this number of levels up.
    Jumps(Expr),
}

/// Address of a word, in upper case.
#[derive(Clone, PartialEq, Eq)]
pub enum Name {
    /// One letter `A` to `Z` (ASCII code).
    Letter(u8),
    /// Several characters: `X1`, `AP`, `S2`.
    Long(Box<str>),
}

/// `A` to `Z`, so that a letter can be borrowed as a string.
const LETTERS: &str = "ABCDEFGHIJKLMNOPQRSTUVWXYZ";

impl Name {
    /// The name of `text` in upper case.
    pub fn new(text: &str) -> Self {
        match text.as_bytes() {
            [letter] if letter.is_ascii_alphabetic() => Self::Letter(letter.to_ascii_uppercase()),
            _ => Self::Long(text.to_ascii_uppercase().into()),
        }
    }

    /// The letter of a one-letter name.
    pub fn letter(&self) -> Option<u8> {
        match self {
            Self::Letter(letter) => Some(*letter),
            Self::Long(_) => None,
        }
    }

    /// The name as text.
    pub fn as_str(&self) -> &str {
        match self {
            Self::Letter(letter) => {
                let i = usize::from(letter.wrapping_sub(b'A'));
                LETTERS.get(i..=i).unwrap_or("?")
            }
            Self::Long(text) => text,
        }
    }
}

impl std::fmt::Debug for Name {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.as_str())
    }
}

/// Axis or spindle command in brackets.
#[derive(Clone, Debug, PartialEq)]
pub struct Bracket {
    /// Axis or spindle.
    pub name: Name,
    /// Contents of the bracket.
    pub group: Group,
}

/// Assignment.
#[derive(Clone, Debug, PartialEq)]
pub struct Assign {
    /// Left side.
    pub target: Place,
    /// The operator of `+=`, `-=`, `*=` and `/=`.
    pub operator: Option<BinaryOp>,
    /// Right side.
    pub value: Expr,
}

/// Definition of a macro.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MacroDefinition {
    /// Name, as written.
    pub name: Box<str>,
    /// Text, with `\"` already replaced by `"`.
    pub text: Box<str>,
}

/// A `#` word among DIN words.
#[derive(Clone, Debug, PartialEq)]
pub struct HashWord {
    /// Name without `#`, in upper case: `FRC CHR CHF RND ANG CANG ACHSE PSET PRESET ADD`, `SUPPRESS OFFSETS`,
    /// `SCALE ON`, `AKIMA STARTVECTOR`.
    pub name: Box<str>,
    /// Value, if one is written.
    pub value: Option<Expr>,
    /// Bracket after it, if one is written: `#SUPPRESS OFFSETS [ZERO]`.
    pub bracket: Option<Group>,
}

/// Subroutine call.
#[derive(Clone, Debug, PartialEq)]
pub struct Call {
    /// `LL` is local, `L` global.
    pub local: bool,
    /// The subroutine called.
    pub kind: CallKind,
}

/// The way a subroutine is named in its call.
#[derive(Clone, Debug, PartialEq)]
pub enum CallKind {
    /// `L file.nc`, `LL NAME`, `L "a b.nc"`: name or path as written, without quotes.
    Program(Ident),
    /// `L V.E.NAME`, `LV.E.NAME`: a variable contains the name.
    Variable(Place),
    /// `L CYCLE [NAME=file @P1=..]`.
    Cycle(Group),
    /// `L SEQUENCE [NAME=.. N10 N50 REPEAT=2]`.
    Sequence(Group),
}
