//! The syntax tree of one block: what was written, not what the machine would do.
//!
//! Every node carries a [`Span`] into the text of its block. Two trees that differ
//! in nothing but spans are not equal: `PartialEq` compares spans too.
//!
//! Case: letters of addresses, command words, keys and functions are stored in upper case. Names that the dialect
//! compares exactly (variables, macros, files, strings) and identifier values (`TYPE=HSC`, `NAME=a.nc`) are stored as
//! written; [`Ident::is`] compares them without case.

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

/// One word of a block.
#[derive(Clone, Debug, PartialEq)]
pub struct Word {
    /// What it is.
    pub kind: WordKind,
    /// Place, value included.
    pub span: Span,
}

/// Kind and contents of a word.
#[derive(Clone, Debug, PartialEq)]
pub enum WordKind {
    /// `G01`, `G131=50`, `G04 P1`, `G80[1,,3]`. Whether a G function takes a value is not known here.
    G {
        /// Number without leading zeros; `u32::MAX` if it does not fit.
        number: u32,
        /// Value or list.
        value: Option<Box<GValue>>,
    },
    /// `M30`, `M200=800`, `M@P6`.
    M(CodeNumber, Option<Box<Expr>>),
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
    /// `"NAME"` standing for words; still here only if the macro was not expanded before parsing.
    MacroUse(Box<str>),
    /// A `#` word that stands among DIN words: `#FRC=50`, `#CHR`, `#ANG=30`, `#PSET`, ...
    Hash(Box<HashWord>),
    /// Subroutine call.
    Call(Box<Call>),
    /// `$GOTO target`.
    Goto(Box<Label>),
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

/// Address of a word, in upper case.
#[derive(Clone, PartialEq, Eq)]
pub enum Name {
    /// One letter `A` to `Z` (ASCII code).
    Letter(u8),
    /// Several characters: `X1`, `AP`, `S2`.
    Long(Box<str>),
}

/// `A` to `Z`, so that a letter can be lent out as a string.
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
    /// Right side.
    pub value: Expr,
}

/// Definition of a macro.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MacroDefinition {
    /// Name, as written.
    pub name: Box<str>,
    /// Text, `\"` already turned into `"`.
    pub text: Box<str>,
}

/// A `#` word among DIN words.
#[derive(Clone, Debug, PartialEq)]
pub struct HashWord {
    /// Name without `#`, in upper case: `FRC CHR CHF RND ANG CANG ACHSE PSET PRESET ADD`.
    pub name: Box<str>,
    /// Value, if one is written.
    pub value: Option<Expr>,
}

/// Subroutine call.
#[derive(Clone, Debug, PartialEq)]
pub struct Call {
    /// `LL` is local, `L` global.
    pub local: bool,
    /// What is called.
    pub kind: CallKind,
}

/// What a call names.
#[derive(Clone, Debug, PartialEq)]
pub enum CallKind {
    /// `L file.nc`, `LL NAME`, `L "a b.nc"`: name or path as written, without quotes.
    Program(Ident),
    /// `L CYCLE [NAME=file @P1=..]`.
    Cycle(Group),
    /// `L SEQUENCE [NAME=.. N10 N50 REPEAT=2]`.
    Sequence(Group),
}

/// A name with its place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Ident {
    /// Text; see the module documentation for its case.
    pub text: Box<str>,
    /// Place.
    pub span: Span,
}

impl Ident {
    /// Compares without case.
    pub fn is(&self, other: &str) -> bool {
        self.text.eq_ignore_ascii_case(other)
    }

    /// Splits a name written together with a number, `ID455` or `REV1000.5`, into both.
    pub fn split_number(&self) -> Option<(&str, f64)> {
        let at = self.text.find(|c: char| c.is_ascii_digit() || c == '.')?;
        let (name, number) = self.text.split_at(at);
        let plain = number.bytes().all(|b| b.is_ascii_digit() || b == b'.');
        if name.is_empty() || !plain {
            return None;
        }
        number.parse().ok().map(|value| (name, value))
    }
}

/// Plain-text command: `#NAME WORDS [ON|OFF] [WORDS] [arguments | bracket groups]`.
#[derive(Clone, Debug, PartialEq)]
pub struct Command {
    /// Words up to `ON`/`OFF` or the first argument, in upper case: `["VIB", "GUARD"]`.
    pub words: Vec<Ident>,
    /// `ON` (true) or `OFF` (false) behind the words.
    pub on: Option<bool>,
    /// Words behind `ON`/`OFF`: `ALL` of `#CS OFF ALL`; in upper case.
    pub tail: Vec<Ident>,
    /// Values without bracket: `#TIME 2.5`, `#WAIT FOR V.E.A == 1`, `#DELETE V.P.A, V.P.B`.
    pub arguments: Vec<Expr>,
    /// Bracket groups: `#CS DEF[1][0,0,0]` has two.
    pub groups: Vec<Group>,
    /// Place.
    pub span: Span,
}

impl Command {
    /// True if the words up to `ON`/`OFF` are exactly these (`"CONTOUR MODE"`: one blank between two words).
    pub fn is(&self, name: &str) -> bool {
        let mut words = self.words.iter();
        name.split(' ').all(|part| words.next().is_some_and(|word| &*word.text == part))
            && words.next().is_none()
    }

    /// The words up to `ON`/`OFF` with one blank between two.
    pub fn name(&self) -> String {
        let mut name = String::new();
        for word in &self.words {
            if !name.is_empty() {
                name.push(' ');
            }
            name.push_str(&word.text);
        }
        name
    }
}

/// Contents of a bracket; commas, equals signs and `|` between items are decoration and left no trace.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Group {
    /// Items in written order.
    pub items: Vec<Item>,
    /// Place, brackets included.
    pub span: Span,
}

impl Group {
    /// The first value of a key (upper case).
    pub fn get(&self, key: &str) -> Option<&ItemValue> {
        self.items.iter().find_map(|item| match &item.kind {
            ItemKind::Pair { key: k, value } if &*k.text == key => Some(value),
            _ => None,
        })
    }

    /// True if the flag (upper case) is written.
    pub fn has(&self, flag: &str) -> bool {
        self.items.iter().any(|item| matches!(&item.kind, ItemKind::Flag(f) if f.is(flag)))
    }
}

/// One item of a bracket.
#[derive(Clone, Debug, PartialEq)]
pub struct Item {
    /// What it is.
    pub kind: ItemKind,
    /// Place.
    pub span: Span,
}

/// Kind of an item.
#[derive(Clone, Debug, PartialEq)]
pub enum ItemKind {
    /// A word alone: `DEV`, `BSPLINE`, `X`, `ID455`; as written.
    Flag(Ident),
    /// `KEY=value`, `KEY value`; `@P1=5` has the key `@P1`. The key is in upper case.
    Pair {
        /// Key.
        key: Ident,
        /// Value.
        value: ItemValue,
    },
    /// A value alone: `["text", P1]`, `[0,0,0]`.
    Value(ItemValue),
    /// Nothing between two commas.
    Missing,
}

/// Value of an item.
#[derive(Clone, Debug, PartialEq)]
pub enum ItemValue {
    /// Expression or string.
    Expr(Expr),
    /// Identifier: `TYPE=HSC`, `AX=Z`, `NAME=file.nc`; as written.
    Name(Ident),
    /// Nested list.
    List(Group),
}

/// Control statement.
#[derive(Clone, Debug, PartialEq)]
pub struct Control {
    /// Which.
    pub kind: ControlKind,
    /// Place.
    pub span: Span,
}

/// Kind of a control statement.
#[derive(Clone, Debug, PartialEq)]
pub enum ControlKind {
    /// `$IF condition`, with `$GOTO target` on the same line the statement has no `$ENDIF`.
    If {
        /// Condition.
        condition: Expr,
        /// Target of `$IF condition $GOTO target`.
        goto: Option<Label>,
    },
    /// `$ELSEIF condition`.
    ElseIf(Expr),
    /// `$ELSE`.
    Else,
    /// `$ENDIF`.
    EndIf,
    /// `$SWITCH value`, `$SWITCH P1=value`.
    Switch {
        /// Assigned on the way.
        target: Option<Place>,
        /// Value.
        value: Expr,
    },
    /// `$CASE value`.
    Case(Expr),
    /// `$DEFAULT`.
    Default,
    /// `$ENDSWITCH`.
    EndSwitch,
    /// `$FOR counter = start, end, step`; the older form has no step.
    For {
        /// Counter.
        counter: Place,
        /// First value.
        start: Expr,
        /// Last value, included.
        end: Expr,
        /// Step.
        step: Option<Expr>,
    },
    /// `$ENDFOR`.
    EndFor,
    /// `$WHILE condition`.
    While(Expr),
    /// `$ENDWHILE`.
    EndWhile,
    /// `$DO`.
    Do,
    /// `$ENDDO`, `$ENDDO condition`.
    EndDo(Option<Expr>),
    /// `$REPEAT`.
    Repeat,
    /// `$UNTIL condition`.
    Until(Expr),
    /// `$BREAK`.
    Break,
    /// `$CONTINUE`.
    Continue,
}

/// Head of a program or local subroutine.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ProgramHead {
    /// `%L NAME`.
    pub local: bool,
    /// First word behind the head, as written; `% a remark` has the name `a`.
    pub name: Option<Ident>,
    /// Everything behind `%` or `%L`, without comment and blanks at the ends.
    pub text: Box<str>,
}

/// One line between `#VAR` and `#ENDVAR`.
#[derive(Clone, Debug, PartialEq)]
pub struct Declaration {
    /// What is declared; its subscripts are the sizes of the dimensions.
    pub place: Place,
    /// Type (`UNS32`, `STRING`), in upper case.
    pub type_name: Option<Ident>,
    /// `20` of `STRING[20]`.
    pub length: Option<Expr>,
    /// Start value; a list for arrays.
    pub value: Option<ItemValue>,
    /// Place of the declaration.
    pub span: Span,
}

/// Expression.
#[derive(Clone, Debug, PartialEq)]
pub struct Expr {
    /// What it is.
    pub kind: ExprKind,
    /// Place, outer brackets included.
    pub span: Span,
}

/// Kind of an expression. Brackets leave no trace; signs of literals are part of them (`-2**2` is (-2)**2 here).
#[derive(Clone, Debug, PartialEq)]
pub enum ExprKind {
    /// Decimal number, sign included.
    Number(f64),
    /// `TRUE`, `FALSE`.
    Bool(bool),
    /// `PI`.
    Pi,
    /// `"text"`, `\"` turned into `"`; may also be the use of a macro.
    Text(Box<str>),
    /// Parameter or variable.
    Place(Box<Place>),
    /// Minus before anything but a literal.
    Negate(Box<Expr>),
    /// Two operands.
    Binary(Box<Binary>),
    /// `SIN[30]`, `ATAN2[y, x]`.
    Call(Box<FunctionCall>),
}

/// Sign directly behind an address, outside of brackets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sign {
    /// `C+10`.
    Plus,
    /// `C-10`.
    Minus,
}

/// Binary operation.
#[derive(Clone, Debug, PartialEq)]
pub struct Binary {
    /// Operator.
    pub op: BinaryOp,
    /// Left operand.
    pub left: Expr,
    /// Right operand.
    pub right: Expr,
}

/// Binary operator, loosest first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum BinaryOp {
    /// `||`, `OR`.
    Or,
    /// `XOR`.
    Xor,
    /// `&&`, `AND`.
    And,
    /// `==`.
    Equal,
    /// `!=`.
    NotEqual,
    /// `<`.
    Less,
    /// `<=`.
    LessEqual,
    /// `>`.
    Greater,
    /// `>=`.
    GreaterEqual,
    /// `|`.
    BitOr,
    /// `^`.
    BitXor,
    /// `&`.
    BitAnd,
    /// `+`.
    Add,
    /// `-`.
    Subtract,
    /// `*`.
    Multiply,
    /// `/`.
    Divide,
    /// `MOD`.
    Modulo,
    /// `**`, left to right.
    Power,
}

/// Function call.
#[derive(Clone, Debug, PartialEq)]
pub struct FunctionCall {
    /// Function.
    pub function: Function,
    /// Arguments in written order; their number is not checked here.
    pub arguments: Vec<Expr>,
}

/// Declares [`Function`] with the names of the language.
macro_rules! functions {
    ($($variant:ident $name:literal,)*) => {
        /// Function of the expression language.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        #[allow(missing_docs, reason = "the names are the language's own")]
        pub enum Function { $($variant),* }

        impl Function {
            /// Every function.
            pub const ALL: &[Self] = &[$(Self::$variant),*];

            /// Name in upper case.
            pub fn name(self) -> &'static str {
                match self { $(Self::$variant => $name),* }
            }

            /// The function of a name in either case.
            pub fn from_name(name: &str) -> Option<Self> {
                Self::ALL.iter().copied().find(|f| f.name().eq_ignore_ascii_case(name))
            }
        }
    };
}

functions! {
    Abs "ABS", Sqr "SQR", Sqrt "SQRT", Exp "EXP", Ln "LN", DecExp "DEXP", Log "LOG",
    Sin "SIN", Cos "COS", Tan "TAN", Cot "COT", Asin "ASIN", Acos "ACOS", Atan "ATAN", Acot "ACOT", Atan2 "ATAN2",
    Int "INT", Fract "FRACT", Round "ROUND", Floor "FLOOR", Ceil "CEIL", Min "MIN", Max "MAX", Sign "SIGN",
    Inv "INV", Not "NOT", Exist "EXIST", SizeOf "SIZEOF", IsString "IS_STRING", IsNumber "IS_NUMBER",
    Left "LEFT", Mid "MID", Right "RIGHT", Len "LEN", Find "FIND", Delete "DELETE", Insert "INSERT",
    Replace "REPLACE", IntToStr "INT_TO_STR", RealToStr "REAL_TO_STR", StrToInt "STR_TO_INT",
    StrToReal "STR_TO_REAL",
}

/// Something that holds a value and may stand left of `=`.
#[derive(Clone, Debug, PartialEq)]
pub struct Place {
    /// Which.
    pub kind: PlaceKind,
    /// Place, subscripts included.
    pub span: Span,
}

/// Kind of a place.
#[derive(Clone, Debug, PartialEq)]
pub enum PlaceKind {
    /// `P1`, `PP1`, `P[P1+5]`, `P100[5][2]`.
    Parameter {
        /// Further `P` before the index: 1 for `PP1` = P\[P1\], 2 for `PPP1`.
        indirections: u32,
        /// Index.
        index: ParameterIndex,
        /// Subscripts of an array.
        subscripts: Vec<Expr>,
    },
    /// `V.P.TAB[2].X`: the parts behind `V.`.
    Variable(Vec<Segment>),
    /// `@P1`, `@X`, `@S`: name behind `@` in upper case.
    Cycle(Box<str>),
}

/// Index of a P parameter.
#[derive(Clone, Debug, PartialEq)]
pub enum ParameterIndex {
    /// Digits; `u32::MAX` if they do not fit.
    Literal(u32),
    /// `P[expr]`.
    Computed(Box<Expr>),
}

/// One part of the name of a variable.
#[derive(Clone, Debug, PartialEq)]
pub struct Segment {
    /// Name as written; may begin with a sign (`V.A.-SWE.X`).
    pub name: Box<str>,
    /// Subscripts behind the name.
    pub subscripts: Vec<Expr>,
}
