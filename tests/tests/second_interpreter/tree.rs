//! A program as a tree: the form of the random programs, written as text by `text` and executed by `model`.

/// Functions of one value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Function {
    Sin,
    Cos,
    Abs,
    Sqrt,
    Int,
    Round,
    Floor,
    Minus,
}

/// Operators, and the functions of two values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Operator {
    Add,
    Subtract,
    Times,
    Divide,
    Mod,
    Power,
    Less,
    Greater,
    AtMost,
    Equal,
    And,
    Or,
    Min,
    Max,
    Angle,
}

#[derive(Clone, Debug)]
pub enum Expr {
    Number(f64),
    /// `P3`, `V.P.A`, `V.L.B`, `@P2`, and system variables as they are written.
    Name(String),
    /// `V.P.TABLE[index]`, `P100[index]`.
    Element(String, Box<Expr>),
    /// `PP3`, the parameter whose number a parameter holds.
    Indirect(u32),
    Of(Function, Box<Expr>),
    Both(Operator, Box<Expr>, Box<Expr>),
}

/// A coordinate word: `0` to `2` for X, Y and Z.
#[derive(Clone, Debug)]
pub struct Word {
    pub axis: usize,
    pub value: Expr,
}

/// A motion block. The contents of `absolute`, `plane` and `group` are programmed in the same block.
#[derive(Clone, Debug, Default)]
pub struct Motion {
    pub number: usize,
    /// G00 to G03; `None` is the modal one.
    pub path: Option<u32>,
    pub absolute: Option<bool>,
    pub plane: Option<u32>,
    pub group: Option<u32>,
    pub words: Vec<Word>,
    pub centre: Vec<(char, f64)>,
    pub radius: Option<f64>,
    /// `#ANG`: one coordinate of the plane follows from the other one.
    pub angle: Option<f64>,
}

/// The element inserted between two motions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Insert {
    /// G301: distance of its ends from the corner.
    Chamfer,
    /// `#CHF`: the length of the chamfer itself.
    ChamferLength,
    /// G302.
    Rounding,
}

/// How the tool approaches a contour and leaves it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Way {
    /// G139: with the line before the contour and the line after it.
    Lines,
    /// G237: perpendicular to the contour; the lines are those of the program.
    Perpendicular,
    /// G239: like G139, but the tool stays at the end, and the program continues from there.
    Stays,
}

/// A contour under tool radius compensation.
#[derive(Clone, Debug)]
pub struct Contour {
    pub way: Way,
    /// G41.
    pub left: bool,
    /// G26 instead of G25.
    pub by_arcs: bool,
    pub radius: f64,
    /// Another radius from this element on; the element is a line, which leads to that radius.
    pub change: Option<(usize, f64)>,
    /// G41 or G42, and G40, are in the blocks of the motions.
    pub in_block: bool,
    pub approach: Motion,
    pub elements: Vec<Motion>,
    pub exit: Motion,
}

#[derive(Clone, Debug)]
pub enum Statement {
    Assign(Expr, Expr),
    /// `#VAR` of a V.L or V.CYC variable.
    Local(String, Expr),
    /// `#VAR` of an array.
    Array(String, Vec<f64>),
    Move(Motion),
    Compensated(Contour),
    /// G151, motions, G150.
    Spline(Vec<Motion>),
    /// Two motions with a chamfer or a rounding of a size.
    Corner(Insert, f64, [Motion; 2]),
    /// Two contour lines by two angles and the end of the second one.
    TwoAngles([f64; 2], [Motion; 2]),
    /// `#SUPPRESS OFFSETS`, as a line.
    Suppressed(Motion),
    /// Words that are written as they are and change one thing.
    Plane(u32),
    Absolute(bool),
    AbsoluteCentres(bool),
    /// G163: the radius of arcs that state none.
    Radius(f64),
    /// G53 to G59 (0 to 6), G159 above.
    Group(u32),
    /// `V.G.NP[group].V.X=`.
    Table(u32, usize, Expr),
    /// G92.
    Preset(Vec<Word>),
    /// `#PSET`.
    PositionPreset(Vec<Word>),
    /// `#PRESET` of all axes.
    PresetOff,
    /// Data of a tool: number, radius, length, offsets of the axes.
    ToolData(u32, f64, f64, [f64; 3]),
    /// D.
    Tool(u32),
    /// G20 to G23.
    Mirror(u32),
    /// G351: axis and sign.
    MirrorAxis(usize, bool),
    /// `#ROTATION ON [..]`, or G68 with `true`.
    Rotation(bool, f64, [f64; 2]),
    /// `#ROTATION OFF`, or G69 with `true`.
    RotationOff(bool),
    System([f64; 6]),
    /// `#CS DEF` of a number and its selection.
    StoredSystem(u32, [f64; 6]),
    SystemOff(bool),
    /// `#CS ADD` of systems, of which the lower ones are selected.
    Stack(Vec<[f64; 6]>, usize),
    /// `#CS DEL ALL`, or as often as there are systems.
    StackOff(usize, bool),
    /// `#MCS ON` to `#MCS OFF`.
    Machine(Vec<Statement>),
    /// `#SCALE ON` with factors of axes, or `#SCALE` with them and `#SCALE ON`, to `#SCALE OFF`.
    Scaled(bool, Vec<(usize, f64)>, Vec<Statement>),
    /// Conditions with their branches, and the `$ELSE` branch.
    If(Vec<(Expr, Vec<Statement>)>, Option<Vec<Statement>>),
    /// Counter, first and last value, step.
    For(String, [Expr; 3], Vec<Statement>),
    While(Expr, Vec<Statement>),
    /// `$DO` to `$ENDDO` repeats while the condition holds.
    Do(Vec<Statement>, Expr),
    /// `$REPEAT` to `$UNTIL` repeats until it holds.
    Repeat(Vec<Statement>, Expr),
    /// Value; cases, `true` with `$BREAK`; default.
    Switch(Expr, Vec<(Expr, Vec<Statement>, bool)>, Vec<Statement>),
    Break,
    Continue,
    /// `$IF .. $GOTO N..` over some statements to a block number.
    Skip(Expr, usize, Vec<Statement>),
    /// Statements from a block number on, and `$IF .. $GOTO N..` back to it.
    Again(usize, Vec<Statement>, Expr),
    /// A local or a global subroutine by its number.
    Call(usize),
    /// A cycle with its parameters.
    Cycle(usize, Vec<Expr>),
}

/// How a subroutine is called.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    Local,
    Global,
    LocalCycle,
    GlobalCycle,
}

#[derive(Clone, Debug)]
pub struct Subroutine {
    pub kind: Kind,
    pub body: Vec<Statement>,
}

#[derive(Clone, Debug)]
pub struct Program {
    pub subroutines: Vec<Subroutine>,
    pub main: Vec<Statement>,
}
