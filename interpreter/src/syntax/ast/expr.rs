//! Expressions, and the places that contain values.

use super::Span;

/// Expression.
#[derive(Clone, Debug, PartialEq)]
pub struct Expr {
    /// Kind.
    pub kind: ExprKind,
    /// Place, outer brackets included.
    pub span: Span,
}

/// Kind of an expression. Brackets are not kept; signs of literals are part of them (`-2**2` is (-2)**2 here).
#[derive(Clone, Debug, PartialEq)]
pub enum ExprKind {
    /// Decimal number, sign included.
    Number(f64),
    /// `TRUE`, `FALSE`.
    Bool(bool),
    /// `PI`.
    Pi,
    /// `R1`, the last radius programmed.
    Radius,
    /// `"text"`, with `\"` replaced by `"`; may also be the use of a macro.
    Text(Box<str>),
    /// `M80` in `EXIST[M80]`.
    MFunction(u32),
    /// `H80` in `EXIST[H80]`.
    HFunction(u32),
    /// Parameter or variable.
    Place(Box<Place>),
    /// Minus before an operand that is not a literal.
    Negate(Box<Expr>),
    /// Two operands.
    Binary(Box<Binary>),
    /// `SIN[30]`, `ATAN2[y, x]`.
    Call(Box<FunctionCall>),
}

/// Sign directly after an address, outside brackets.
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

/// Binary operator, in increasing order of precedence.
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

/// Declares [`Function`] with the names of the functions in the language.
macro_rules! functions {
    ($($variant:ident $name:literal,)*) => {
        /// Function of the expression language.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum Function {
            $(
                #[doc = concat!("`", $name, "`.")]
                $variant,
            )*
        }

        impl Function {
            /// All functions.
            pub const ALL: &[Self] = &[$(Self::$variant),*];

            /// Name in upper case.
            pub fn name(self) -> &'static str {
                match self { $(Self::$variant => $name),* }
            }

            /// The function with this name, in upper or lower case.
            pub(crate) fn from_name(name: &str) -> Option<Self> {
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
    Left "LEFT", Mid "MID", Right "RIGHT", Len "LEN", Ord "ORD", Find "FIND", Delete "DELETE", Insert "INSERT",
    Replace "REPLACE", IntToStr "INT_TO_STR", RealToStr "REAL_TO_STR", StrToInt "STR_TO_INT",
    StrToReal "STR_TO_REAL", MacroLength "MACRO_LENGTH", MacroContent "MACRO_CONTENT",
}

/// Parameter or variable; may be on the left of `=`.
#[derive(Clone, Debug, PartialEq)]
pub struct Place {
    /// Kind.
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
    /// `V.P.TAB[2].X`: the parts after `V.`.
    Variable(Vec<Segment>),
    /// `@P1`, `@X`, `@S`: name after `@` in upper case.
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
    /// Subscripts after the name.
    pub subscripts: Vec<Expr>,
}
