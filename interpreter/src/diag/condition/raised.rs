//! Conditions that kontur raises, one row each.

use super::row::{Reaction, Row};
use crate::diag::id::{
    Id::{Kontur, Vendor},
    Severity::{Error, Note, Warning},
};

/// Makes the conditions out of their rows. A row reads
///
/// ```text
/// Condition = Vendor 20008: SEVERITY REACTION REMEDY ROOT, "meaning", cause "..", hint "..", parameter "..";
/// Condition = Kontur 9 "K-RANGE": ...
/// ```
macro_rules! conditions {
    ($(
        $condition:ident = $space:ident $number:literal $($name:literal)?:
        $severity:ident $reaction:ident $remedy:literal $root:literal,
        $meaning:literal $(, cause $cause:literal)? $(, hint $hint:literal)? $(, parameter $parameter:literal)?;
    )*) => {
        /// A condition that is raised; its row says everything that is always true of it.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum Condition {
            $(
                // a block of text, since meanings hold brackets that would be links
                #[doc = concat!(stringify!($space), " ", stringify!($number), "\n\n```text\n", $meaning, "\n```")]
                $condition,
            )*
        }

        /// The rows in the order of the conditions.
        pub(super) const ROWS: &[Row] = &[
            $(Row {
                id: $space($number),
                name: first([$($name)?]),
                severity: $severity,
                reaction: Reaction::$reaction,
                remedy: $remedy,
                root: $root,
                meaning: $meaning,
                cause: first([$($cause)?]),
                hint: optional([$($hint)?]),
                parameter: optional([$($parameter)?]),
            },)*
        ];
    };
}

impl Condition {
    /// Everything that is always true of it.
    pub const fn row(self) -> &'static Row {
        &ROWS[self as usize]
    }
}

/// The text of a column that may be left out.
const fn first<const N: usize>(texts: [&'static str; N]) -> &'static str {
    if N == 0 { "" } else { texts[0] }
}

/// The same for columns whose absence means something.
const fn optional<const N: usize>(texts: [&'static str; N]) -> Option<&'static str> {
    if N == 0 { None } else { Some(texts[0]) }
}

conditions! {
    ListIndexRange = Vendor 1030: Error JobAbort 7 2, "index in the start-up list beyond its array", cause "achs_mds[230]", hint "axis lists have the indices 0 to 31 here, channel lists 0 to 11";
    AxisMissing = Vendor 20003: Warning None 1 1, "G function needs an axis", cause "e.g. G160=2 without axis", hint "the function acts on the axes in its block: G160=2 X1";
    SpindleSpeedZero = Vendor 20007: Error ProgramAbort 3 1, "spindle speed 0", cause "G63 with S0", hint "program the speed before: S1000 M3";
    FeedZero = Vendor 20008: Error ProgramAbort 3 1, "feed is 0 in a motion block", cause "first G01/G02/G03 without F (P-CHAN-00099 = 0)", hint "write F in this block or before it";
    CoordinateTooLarge = Vendor 20011: Error ProgramAbort 3 1, "coordinate outside the data format", cause "X94967596", hint "coordinates reach up to 214748.3647 mm or deg";
    InsertionWithoutSize = Vendor 20012: Error ProgramAbort 3 1, "chamfer or rounding without size", cause "I missing or 0 at G301/G302", hint "write the size: G301 I2; it holds for the following ones too";
    DwellTwoTimes = Vendor 20013: Error ProgramAbort 3 1, "G04 in both forms at once", cause "G04 2 X3", hint "leave one of the two times out";
    DwellWrongAxis = Vendor 20014: Error ProgramAbort 3 1, "G04 names a wrong axis", cause "only the first main axis", hint "write G04 2.5, or the time after the first main axis";
    DiameterNegative = Vendor 20019: Error ProgramAbort 3 1, "negative or mirrored coordinate with diameter programming", cause "G51 X-30, G51 with G21", hint "diameters count from the turning centre and have no sign: switch the mirroring off, or write G52";
    CentreTooLarge = Vendor 20020: Error ProgramAbort 3 1, "I, J, K outside the data format", cause "G02 I94967596", hint "centres reach up to 214748.3647 mm";
    TappingWithoutWay = Vendor 20032: Error ProgramAbort 3 1, "tapping without a way", cause "G63 Z0 at Z0", hint "write a depth that differs from the present position";
    FullCircleWithRadius = Vendor 20034: Error ProgramAbort 3 1, "full circle with R", cause "end = start with radius", hint "write the centre with I, J, K, without R";
    ArcRadiusZero = Vendor 20036: Error ProgramAbort 3 1, "circle radius 0", cause "G164, centre missing or end = start", hint "is I, J or K missing?";
    AxesWithoutManual = Vendor 20037: Error ProgramAbort 3 1, "#ACHSE without G200, G201 or G202", hint "write G201 #ACHSE[X]";
    ManualWithoutAxis = Vendor 20038: Error ProgramAbort 3 1, "G201 without an axis", hint "write G201 X1 or G201 #ACHSE[X]";
    NoFaceTurningAxis = Vendor 20042: Error ProgramAbort 3 1, "no face turning axis in the plane of G51", hint "set the bit 0x40 of P-AXIS-00015 for exactly one axis of the plane", parameter "P-AXIS-00015";
    CentreTooFar = Vendor 20054: Error ProgramAbort 3 1, "centre of an arc by its radius outside the data format", cause "G02 X1 R1000000", hint "coordinates of the centre reach up to 214748.3647 mm: a line is as good";
    ToolRadiusTwice = Vendor 20083: Error ProgramAbort 3 1, "tool radius written beside a D word", cause "D1 V.G.WZ_AKT.R=3", hint "write the radius in a later block";
    VariableNotReadable = Vendor 20097: Error ProgramAbort 3 1, "variable may not be read", hint "its access rights allow writing only";
    VariableNotWritable = Vendor 20100: Error ProgramAbort 3 1, "variable may not be written", hint "assign to a P parameter or to a variable of the classes V.P, V.L, V.S";
    BlockNumberBehindWords = Vendor 20105: Error ProgramAbort 3 1, "second block number in one block", cause "N20 X10 N30", hint "leave one of the two out";
    GNumberTooLarge = Vendor 20107: Error ProgramAbort 3 1, "G number outside the data format", hint "G functions have numbers up to 9999";
    TwoMotionModes = Vendor 20108: Error ProgramAbort 3 1, "two motion modes in one block", cause "G01 … G00", hint "one of G00, G01, G02, G03, G04 per block";
    TwoFeedInterpolations = Vendor 20109: Error ProgramAbort 3 1, "two of G08/G193/G293", hint "one of G08, G193, G293 per block";
    TwoCompensationFeeds = Vendor 20110: Error ProgramAbort 3 1, "two of G10/G11", hint "one of G10, G11 per block";
    TwoMirrors = Vendor 20112: Error ProgramAbort 3 1, "two mirror functions", hint "one of G20 to G23, G351 per block";
    TwoCorners = Vendor 20113: Error ProgramAbort 3 1, "two of G25, G26", hint "leave one of the two out";
    TwoCompensations = Vendor 20114: Error ProgramAbort 3 1, "two of G40/G41/G42", hint "one of G40, G41, G42 per block";
    TwoDiameters = Vendor 20115: Error ProgramAbort 3 1, "two of G51/G52", hint "one of G51, G52 per block";
    TwoZeroOffsets = Vendor 20116: Error ProgramAbort 3 1, "two zero offsets G53-G59, G159", hint "one of G53 to G59, G159 per block";
    TwoTransitions = Vendor 20117: Error ProgramAbort 3 1, "two block transitions G60/G61/G260/G261/G359/G360", hint "one of G60, G61, G260, G261, G359, G360 per block";
    TwoUnits = Vendor 20118: Error ProgramAbort 3 1, "two of G70/G71", hint "one of G70, G71 per block";
    TwoFeedTypes = Vendor 20121: Error ProgramAbort 3 1, "two of G93/G94/G95/G194", hint "one of G93, G94, G95, G194 per block";
    TwoSpeedModes = Vendor 20122: Error ProgramAbort 3 1, "two of G96/G97/G196", hint "one of G96, G97, G196 per block";
    TwoMeasurings = Vendor 20123: Error ProgramAbort 3 1, "two measuring functions G100-G108", hint "one of G100 to G108 per block";
    TwoLookAheads = Vendor 20124: Error ProgramAbort 3 1, "two of G115/G116/G117", hint "one of G115, G116, G117 per block";
    TwoCompensationSelections = Vendor 20126: Error ProgramAbort 3 1, "two selection modes of tool radius compensation", cause "G138, G139, G236 to G239", hint "one of G138, G139, G236 to G239 per block";
    TwoCentreTypes = Vendor 20127: Error ProgramAbort 3 1, "two of G161/G162", hint "one of G161, G162 per block";
    TwoCentreCorrections = Vendor 20128: Error ProgramAbort 3 1, "two of G164/G165", hint "one of G164, G165 per block";
    TwoManuals = Vendor 20129: Error ProgramAbort 3 1, "two of G200-G202", hint "one of G200, G201, G202 per block";
    TwoInsertions = Vendor 20130: Error ProgramAbort 3 1, "two of G301/G302", hint "one of G301, G302 per block";
    GUnknown = Vendor 20131: Error ProgramAbort 3 1, "unknown G function", hint "the number is not assigned in this dialect: kontur explain G<number> describes those that are";
    PlaneWithCompensation = Vendor 20133: Error ProgramAbort 3 1, "plane selection with active tool radius compensation", hint "switch the compensation off with G40 before G17, G18, G19";
    CompensationWithoutAxis = Vendor 20136: Error ProgramAbort 3 1, "tool radius compensation without a main axis of its plane", cause "#PUT AX [X] and then G41", hint "the first two main axes of the plane have to be in the channel";
    MeasuringTypeOfG100 = Vendor 20138: Error ProgramAbort 3 1, "G100 does not fit the measuring type", cause "types 5 and 6 measure with G310", hint "select another type by #MEAS MODE [1]", parameter "P-CHAN-00057";
    LookAheadRange = Vendor 20151: Error ProgramAbort 3 1, "G115 value outside 0…14", hint "G116 stops at every transition, G117 is the complete look-ahead";
    SpindleMTwice = Vendor 20155: Error ProgramAbort 3 1, "M function of a spindle twice", cause "S[M3 M4]", hint "leave one of the two out";
    TwoSignalFunctions = Vendor 20156: Error ProgramAbort 3 1, "two M functions in a block that wait for the signal of edge banding", cause "P-CHAN-00041 is MNE_SNS for both", hint "write one of them in a separate block", parameter "P-CHAN-00041";
    MNumberTooLarge = Vendor 20160: Error ProgramAbort 3 1, "number of an M function outside the data format", cause "M1001", hint "M functions have numbers up to 1000";
    ToolNumberTooLarge = Vendor 20166: Error ProgramAbort 3 1, "tool number outside the data format", cause "T2147483648", hint "tool numbers are whole, from 0 to 2147483647";
    ToolWhileCoupled = Vendor 20169: Error ProgramAbort 3 1, "tool data changed while axes are coupled", cause "D2 after #ENABLE AX LINK [1]", hint "write #DISABLE AX LINK before the D word";
    ToolDataTwice = Vendor 20170: Error ProgramAbort 3 1, "D twice in one block", hint "leave one of the two out";
    FeedTwice = Vendor 20175: Error ProgramAbort 3 1, "F twice in one block", hint "the feed holds for the whole block: leave one F out";
    SpindleUnknown = Vendor 20180: Error ProgramAbort 3 1, "unknown name of a spindle", cause "SPDL=1000", hint "spindle names are in the channel list; those of several characters need =", parameter "P-CHAN-00007";
    SpindleTwice = Vendor 20181: Error ProgramAbort 3 1, "spindle twice in one block", cause "S1000 X100 S1500", hint "leave one of the two speeds out";
    PositionRequest = Vendor 20186: Error ProgramAbort 3 1, "syntax after #GET CMDPOS, #GET ACTPOS or #SET IPO SOLLPOS", cause "[P1=X P2=Y], [P1 X]", hint "write [variable=axis, variable=axis]: #GET CMDPOS [P1=X, V.P.POS=Y]";
    RadiusIndexFormat = Vendor 20187: Error ProgramAbort 3 1, "index of the radius outside the data format", cause "R-1=10", hint "write R=.. or R1=..";
    RadiusIndex = Vendor 20188: Error ProgramAbort 3 1, "index of the radius is not 1", cause "R2=10", hint "write R=.. or R1=..";
    ONotImplemented = Vendor 20191: Error ProgramAbort 3 1, "O word not implemented";
    PercentInProgram = Vendor 20193: Error ProgramAbort 3 1, "% inside a main program", cause "% text as a remark, %L after the main program", hint "remarks begin with ; or (; local subroutines come before the main program";
    AssignmentExpected = Vendor 20194: Error ProgramAbort 3 1, "assignment operator missing or unknown", cause "V.G.X without =", hint "write = between the parameter and its value";
    ToolIndex = Vendor 20197: Error ProgramAbort 3 1, "index of a variable outside the data format", cause "V.G.WZ[-1].L", hint "indices begin at 0";
    AxisOrCommandExpected = Vendor 20200: Error ProgramAbort 3 1, "axis name or command expected", cause "axis not in the channel, or letter not X Y Z A B C U V W Q", hint "the axes of the channel are in the channel list";
    AxisTwice = Vendor 20203: Error ProgramAbort 3 1, "axis twice in one block", cause "X10 Y20 X10", hint "write the second target in a separate block";
    CentreTwice = Vendor 20205: Error ProgramAbort 3 1, "I, J or K twice", hint "leave one of the two out";
    ControlNotAlone = Vendor 20206: Error ProgramAbort 3 1, "control statement is not alone in its block", cause "$FOR P10=0,20,1 G01 X10", hint "move the words to another block";
    CommandNotAlone = Vendor 20207: Error ProgramAbort 3 1, "# command must be alone in its block", cause "exceptions #ADD, #SUPPRESS OFFSETS", hint "move it to a separate block";
    ControlNesting = Vendor 20211: Error ProgramAbort 3 1, "control statements nested too deeply", hint "move an inner part into a subroutine";
    IfTrailing = Vendor 20212: Error ProgramAbort 3 1, "trailing words after $IF", cause "$IF P1==1 X100", hint "only the condition may follow $IF, and $GOTO after it; move the words to the next block";
    ElseWithoutIf = Vendor 20214: Error ProgramAbort 3 1, "$ELSE without $IF", hint "write $IF before it, or is there one $ENDIF too many?";
    ElseNotAlone = Vendor 20215: Error ProgramAbort 3 1, "$ELSE is not alone in its block", hint "move the words to the block after $ELSE";
    ElseIfWithoutIf = Vendor 20216: Error ProgramAbort 3 1, "$ELSEIF without $IF", hint "write $IF before it, or is there one $ENDIF too many?";
    ElseIfTrailing = Vendor 20217: Error ProgramAbort 3 1, "trailing words after $ELSEIF", hint "only the condition may follow $ELSEIF; move the words to the next block";
    EndIfWithoutIf = Vendor 20218: Error ProgramAbort 3 1, "$ENDIF without $IF", hint "write $IF before it, or is there one $ENDIF too many?";
    EndIfNotAlone = Vendor 20219: Error ProgramAbort 3 1, "$ENDIF is not alone in its block", hint "move the words to the block after $ENDIF";
    SwitchTrailing = Vendor 20220: Error ProgramAbort 3 1, "trailing words after $SWITCH", cause "$SWITCH P1 X100", hint "only the value may follow $SWITCH; move the words to another block";
    CaseWithoutSwitch = Vendor 20221: Error ProgramAbort 3 1, "$CASE without $SWITCH", hint "write $SWITCH before it, or is there one $ENDSWITCH too many?";
    CaseTrailing = Vendor 20222: Error ProgramAbort 3 1, "trailing words after $CASE", cause "$CASE 5 X100", hint "only the value may follow $CASE; move the words to the next block";
    DefaultWithoutSwitch = Vendor 20223: Error ProgramAbort 3 1, "$DEFAULT without $SWITCH", hint "write $SWITCH before it, or is there one $ENDSWITCH too many?";
    DefaultNotAlone = Vendor 20224: Error ProgramAbort 3 1, "$DEFAULT is not alone in its block", hint "move the words to the block after $DEFAULT";
    EndSwitchWithoutSwitch = Vendor 20225: Error ProgramAbort 3 1, "$ENDSWITCH without $SWITCH", hint "write $SWITCH before it, or is there one $ENDSWITCH too many?";
    ForCounter = Vendor 20227: Error ProgramAbort 3 1, "$FOR counter is wrong", hint "the counter is a P parameter or a variable that may be written: $FOR P1=0,4,1";
    ForWithoutEquals = Vendor 20228: Error ProgramAbort 3 1, "$FOR without = after its counter", cause "$FOR P1,100,10", hint "the first value follows the counter: $FOR P1=0,100,10";
    ForWithoutComma = Vendor 20229: Error ProgramAbort 3 1, "$FOR without a comma between its values", cause "$FOR P1=1 10,1", hint "first value, last value and step are separated by commas: $FOR P1=1,10,1";
    EndForWithoutFor = Vendor 20232: Error ProgramAbort 3 1, "$ENDFOR without $FOR", hint "write $FOR before it, or is there one $ENDFOR too many?";
    EndForNotAlone = Vendor 20233: Error ProgramAbort 3 1, "$ENDFOR is not alone in its block", hint "move the words to the block after $ENDFOR";
    WhileTrailing = Vendor 20235: Error ProgramAbort 3 1, "trailing words after $WHILE", cause "$WHILE P1>0 X100", hint "only the condition may follow $WHILE; move the words to the next block";
    EndWhileWithoutWhile = Vendor 20237: Error ProgramAbort 3 1, "$ENDWHILE without $WHILE", hint "write $WHILE before it, or is there one $ENDWHILE too many?";
    EndWhileNotAlone = Vendor 20238: Error ProgramAbort 3 1, "$ENDWHILE is not alone in its block", hint "move the words to the block after $ENDWHILE";
    DoNotAlone = Vendor 20239: Error ProgramAbort 3 1, "$DO is not alone in its block", hint "move the words to the block after $DO";
    EndDoTrailing = Vendor 20241: Error ProgramAbort 3 1, "trailing words after $ENDDO", cause "$ENDDO P2>=10 X100", hint "only the condition may follow $ENDDO; move the words to the next block";
    BreakNotAlone = Vendor 20242: Error ProgramAbort 3 1, "$BREAK is not alone in its block", hint "move the words to the block before $BREAK";
    BreakOutside = Vendor 20243: Error ProgramAbort 3 1, "$BREAK outside of loops and $SWITCH", hint "$BREAK leaves the innermost loop or $SWITCH; $GOTO leaves other blocks";
    ContinueOutside = Vendor 20244: Error ProgramAbort 3 1, "$CONTINUE outside of loops", hint "$CONTINUE starts the next pass of the innermost loop";
    ContinueNotAlone = Vendor 20245: Error ProgramAbort 3 1, "$CONTINUE is not alone in its block", hint "move the words to the block before $CONTINUE";
    LineTooLong = Vendor 20301: Error ProgramAbort 3 1, "line too long", cause "over 4096 characters", hint "split it, and move long comments to separate lines";
    AxisNumberUnknown = Vendor 20312: Error ProgramAbort 3 1, "logical axis number unknown", cause "axis exchange", hint "the logical axis numbers are in the axis lists (kopf.achs_nr)";
    InsertionWithoutMotion = Vendor 20351: Warning None 1 1, "no motion before a chamfer or rounding", cause "G301/G302 belong between two motion blocks", hint "write a motion before it";
    InsertionFlushed = Vendor 20352: Warning None 1 1, "flush inside chamfer/rounding, nothing inserted", hint "write the flush before the insertion or after the motion that follows it";
    SubroutineNesting = Vendor 20360: Error ProgramAbort 3 1, "global subroutines nested too deeply", hint "does a subroutine call itself?";
    OpenControlAtEnd = Vendor 20375: Warning None 1 1, "open control blocks at program end", cause "$IF true, no $ENDIF", hint "write the closing statement before the end of the program";
    BracketNesting = Vendor 20386: Error ProgramAbort 3 1, "brackets of an expression nested too deeply", hint "a parameter can hold a part of a long expression";
    FunctionBracket = Vendor 20387: Error ProgramAbort 3 1, "function without an opening bracket", cause "P2=SIN45]", hint "the argument of a function goes in brackets: SIN[45]";
    DivisionByZero = Vendor 20396: Error ProgramAbort 3 1, "division by zero in expression", hint "test the divisor with $IF before; SIN, COS and TAN are exactly 0 at multiples of 90 and 180 degrees";
    Logarithm = Vendor 20399: Error ProgramAbort 3 1, "logarithm of a value ≤ 0", hint "logarithms exist for values above 0";
    ParameterNumber = Vendor 20400: Error ProgramAbort 3 1, "number of a P parameter is 0, negative or too large", cause "P0=10", hint "P parameters have numbers from 1 on";
    RadiusName = Vendor 20402: Error ProgramAbort 3 1, "unknown radius name", hint "write R=..";
    VariableNumber = Vendor 20403: Error ProgramAbort 3 1, "number of a variable is negative or too large", cause "V.G.NP[-1].V[0]", hint "write an index of the variable's range";
    SpindleNameTwice = Vendor 20419: Error JobAbort 1 2, "two spindles of the channel list have one name", hint "give every spindle a name of its own", parameter "P-CHAN-00007";
    PathAxisNumberTwice = Vendor 20423: Error JobAbort 1 2, "two path axes of the channel list have one logical number", cause "gruppe[0].achse[1].log_achs_nr 1 beside achse[0]", hint "give every axis a number of its own, that of its axis list", parameter "P-CHAN-00035";
    PathAxisNameTwice = Vendor 20424: Error JobAbort 1 2, "two path axes of the channel list have one name", hint "give every axis a name of its own", parameter "P-CHAN-00006";
    PathAxisName = Vendor 20425: Warning None 1 2, "axis name of the channel list too long or with a wrong first letter, replaced", cause "gruppe[0].achse[0].bezeichnung K", hint "axis names begin with X, Y, Z, A, B, C, U, V, W or Q and have up to 16 characters", parameter "P-CHAN-00006";
    SpindleIsPathAxis = Vendor 20426: Error JobAbort 1 2, "a spindle and a path axis of the channel list have one logical number", hint "give every axis and spindle a number of its own", parameter "P-CHAN-00036";
    CentreShiftZero = Vendor 20435: Warning None 1 2, "largest centre shift of arcs is 0, set to its default", cause "mittelpkt_diff 0", hint "write a value above 0", parameter "P-CHAN-00059";
    CentreFactorZero = Vendor 20436: Warning None 1 2, "relative centre shift 0, the default is used", cause "mittelpkt_faktor 0", hint "write the largest shift in 0.1 % of the radius", parameter "P-CHAN-00060";
    DefaultCouplingNumber = Vendor 20438: Warning None 1 2, "default coupling group with the logical axis number 0, the pair is left out", cause "synchro_data.koppel_gruppe[0].paar[0] without a master", hint "name master and slave by their logical axis numbers", parameter "P-CHAN-00037";
    DefaultCouplingItself = Vendor 20440: Warning None 1 2, "default coupling group that couples an axis with itself, the pair is left out", hint "master and slave are different axes", parameter "P-CHAN-00037";
    DefaultCouplingSlaveTwice = Vendor 20441: Warning None 1 2, "default coupling group with one slave in two pairs, the second one is left out", hint "a slave has one master", parameter "P-CHAN-00038";
    DefaultCouplingChain = Vendor 20442: Warning None 1 2, "default coupling group with an axis that is master and slave, the second pair is left out", hint "a master is no slave of another pair", parameter "P-CHAN-00037";
    WordsBehindCommand = Vendor 20450: Error ProgramAbort 3 1, "words after a # command", cause "exceptions #ACHSE, #PSET, #PRESET", hint "move it to a separate block";
    CouplingWithCompensation = Vendor 20457: Error ProgramAbort 3 1, "coupling switched while tool radius compensation is active", cause "#ENABLE AX LINK [1] after G41", hint "switch couplings before G41 or after G40";
    CouplingGroupNumber = Vendor 20461: Error ProgramAbort 3 1, "number of a coupling group out of range", cause "#SET AX LINK [100000, Y=X]", hint "groups have the numbers 1 to 65535; 0 is that of the channel list";
    SlaveIsMainAxis = Vendor 20467: Error ProgramAbort 3 1, "slave of a coupling is a main axis", cause "#ENABLE AX LINK [1] after #SET AX LINK [1, Y=X]", hint "slaves are axes with the index 3 or above: #CALL AX [C,3,3] gives an axis such a place";
    CoupledTypes = Vendor 20468: Error ProgramAbort 3 1, "coupled axes of different types", cause "a linear axis and a rotary one", hint "couple axes of the same type (P-AXIS-00018)";
    CoupledModes = Vendor 20469: Error ProgramAbort 3 1, "coupled axes of different modes", cause "a modulo axis and one that is not", hint "couple axes of the same mode (P-AXIS-00015)";
    CouplingGroupActive = Vendor 20472: Error ProgramAbort 3 1, "coupling group changed while it is switched on", cause "#SET AX LINK [1, ..] after #ENABLE AX LINK [1]", hint "write #DISABLE AX LINK before it";
    MasterIsSlave = Vendor 20475: Error ProgramAbort 3 1, "axis coupled with itself", cause "#SET AX LINK [1, X=X]", hint "write another axis after the =";
    SlaveTwice = Vendor 20476: Error ProgramAbort 3 1, "axis is a slave twice", cause "#SET AX LINK [1, C=X, C=Y]", hint "leave one of the two couplings out";
    CouplingChain = Vendor 20477: Error ProgramAbort 3 1, "axis is master and slave", cause "#SET AX LINK [1, B=X, C=B]", hint "couple both slaves with the first master";
    EmptyBracket = Vendor 20480: Error ProgramAbort 3 1, "nothing in the brackets of a command", cause "#SET TIP [ ] X", hint "write its values into the brackets";
    JogStages = Vendor 20490: Error ProgramAbort 3 1, "too many values after #SET TIP", cause "#SET TIP [1, 2, 3, 4] X", hint "write at most three speeds";
    PositionRequests = Vendor 20500: Error ProgramAbort 3 1, "too many values in #GET CMDPOS, #GET ACTPOS or #SET IPO SOLLPOS", hint "write the rest into a second command";
    CommandUnknown = Vendor 20509: Error ProgramAbort 3 1, "unknown # command", hint "kontur explain '#NAME' describes the commands that exist";
    ExchangeMode = Vendor 20521: Error ProgramAbort 3 1, "axis exchange: offset mode unknown", hint "offset modes are CMDPOS, ACTPOS, OFFSETS, NO_OFFSETS, ALL";
    ExchangeName = Vendor 20524: Error ProgramAbort 3 1, "axis exchange: axis name wrong", hint "axis names begin with X, Y, Z, A, B, C, U, V, W or Q and have up to 16 characters";
    ExchangeWhileTapping = Vendor 20535: Error ProgramAbort 3 1, "axis exchange during tapping", cause "G63 Z10 F1000 S100, then #SET AX [X,1,0]", hint "write G01 or G00 before it";
    CoupledAxisReleased = Vendor 20545: Error ProgramAbort 3 1, "coupled axis released", cause "#PUT AX [X] after #ENABLE AX LINK [1]", hint "write #DISABLE AX LINK before it";
    FaceAxisReleased = Vendor 20546: Error ProgramAbort 1 1, "face turning axis released while diameters are programmed", cause "#PUT AX [X] under G51", hint "write G52 first";
    CommentBeginNotAlone = Vendor 20566: Error ProgramAbort 3 1, "#COMMENT BEGIN is not alone in its block", hint "move the words to the next block";
    CommentEndNotAlone = Vendor 20569: Error ProgramAbort 3 1, "#COMMENT END is not alone in its block", hint "move the words to the next block";
    DividedByZero = Vendor 20574: Error ProgramAbort 3 1, "division by zero with /=", cause "P1 /= P2 with P2=0", hint "test the divisor with $IF before";
    ZeroGroupFormat = Vendor 20582: Error ProgramAbort 3 1, "group of G159 outside the data format", cause "G159=-1", hint "groups are whole numbers from 0";
    MaskedGroupFormat = Vendor 20583: Error ProgramAbort 3 1, "group of G160 outside the data format", cause "G160=-1 X1", hint "groups are whole numbers from 0";
    MaskedGroup = Vendor 20584: Error ProgramAbort 3 1, "group of G160 is not in the table of zero offsets", cause "G160=500 X1", hint "groups are 0 to 96";
    ZeroOffsetDefault = Vendor 20585: Error ProgramAbort 6 2, "default zero offset outside the groups", cause "default_index 200", hint "groups are 0 to 96", parameter "P-ZERO-00002";
    ConditionalNotFirst = Vendor 20593: Error ProgramAbort 3 1, "#IF/#ELSE/#ENDIF not first in the block", hint "only a skip mark may precede it";
    PresetTooLarge = Vendor 20604: Error ProgramAbort 3 1, "position of #PSET outside the data format", cause "#PSET X94967296", hint "coordinates reach up to 214748.3647 mm or deg";
    PresetWhileMirrored = Vendor 20612: Error ProgramAbort 3 1, "#PSET or #PRESET with active mirroring", cause "G21, then #PSET X200", hint "write G20 before it";
    MacroNameLength = Vendor 20614: Error ProgramAbort 3 1, "name of a macro too long", cause "P-CHAN-00511, 30 characters by default", hint "shorten the name", parameter "P-CHAN-00511";
    CuttingSpeedLimited = Vendor 20633: Warning None 1 1, "too near to the turning centre for G96: spindle speed limited", cause "G96 at X0", hint "select G96 further out, or raise G196";
    TappingPerRevolution = Vendor 20635: Error ProgramAbort 3 1, "tapping with feed per revolution", cause "G63 under G95", hint "write G94 before it";
    TappingCuttingSpeed = Vendor 20636: Error ProgramAbort 3 1, "tapping with constant cutting speed", cause "G63 under G96", hint "write G97 before it";
    TappingWithSpeedLimit = Vendor 20637: Error ProgramAbort 3 1, "tapping and G196 in one block", hint "write G196 in another block";
    PositioningWithMaximum = Vendor 20643: Error ProgramAbort 3 1, "M19 in a block with G196", cause "G196 S2000 M19", hint "write M19 in a separate block";
    FlushWithCompensation = Vendor 20651: Error ProgramAbort 3 1, "channel flush with active tool radius compensation", hint "switch the compensation off with G40 first";
    FunctionInSystem = Vendor 20663: Error ProgramAbort 3 1, "G function that is not allowed in a coordinate system", cause "#CS ON, then G98 X-500", hint "write it before #CS ON or after #CS OFF";
    LengthWithCompensation = Vendor 20671: Error ProgramAbort 3 1, "tool length compensation selected while tool radius compensation is active", cause "#TLC ON between G41 or G42 and G40", hint "write #TLC ON before G41 or after G40";
    CoordinateSystemSyntax = Vendor 20675: Error ProgramAbort 3 1, "syntax error in #CS ON[...]", hint "#CS ON [x,y,z,a,b,c], #CS ON [number], #CS DEF [number][x,y,z,a,b,c], #CS OFF [ALL]";
    SystemAngle = Vendor 20676: Error ProgramAbort 3 1, "angle of a coordinate system outside -360 to 360 deg", cause "#CS ON [0,0,0,0,0,450]", hint "subtract full turns from the angle";
    ExchangeInSystem = Vendor 20684: Error ProgramAbort 3 1, "axis exchange while a coordinate system is active", cause "#CS ON [..] and then #PUT AX [X]", hint "write #CS OFF before it";
    DwellOtherAxes = Vendor 20685: Warning None 1 1, "G04 with further axes", hint "the time follows the first main axis; write the motion in a separate block";
    KinematicsWhileActive = Vendor 20687: Error ProgramAbort 3 1, "kinematics changed under an active transformation", cause "#KIN ID under #TRAFO ON", hint "write #TRAFO OFF before #KIN ID";
    InsertionsWithoutMotion = Vendor 20701: Warning None 1 1, "two of G301/G302 without motion between them", hint "leave one of the two out";
    PresetOffsetTooLarge = Vendor 20711: Error ProgramAbort 3 1, "offset of #PSET outside the data format", cause "#PSET X-214748 where the axis is at 100", hint "offsets reach up to 214748.3647 mm or deg";
    MessageCount = Vendor 20721: Error ProgramAbort 3 1, "#MSG: number of values and of formats differ", cause "#MSG [\"%d %d\", 1]", hint "write one value for each format";
    MessageValue = Vendor 20726: Error ProgramAbort 3 1, "#MSG: value missing after a comma", cause "#MSG [\"%d\", ]", hint "write one value for each format";
    MacroNesting = Vendor 20734: Error ProgramAbort 3 1, "nesting stack exhausted", hint "does the macro use itself?";
    ToolTwice = Vendor 20738: Error ProgramAbort 3 1, "D and V.G.WZ_AKT in one block", hint "write one of the two in a separate block";
    ToolOffsetTwice = Vendor 20739: Error ProgramAbort 3 1, "D and an offset V.G.WZ_AKT.V in one block", hint "write one of the two in a separate block";
    SplineParameter = Vendor 20746: Error ProgramAbort 3 1, "parameter of a spline outside the data format", cause "#AKIMA STARTVECTOR X1e30", hint "write the direction with components of ordinary size";
    TimeRange = Vendor 20751: Error ProgramAbort 3 1, "time of #TIME out of range", hint "the time is in seconds";
    DwellRange = Vendor 20752: Error ProgramAbort 3 1, "dwell time out of range", hint "the time is in seconds";
    MTwice = Vendor 20765: Error ProgramAbort 3 1, "M function twice in one block", cause "M10 M10", hint "leave one of the two out";
    HTwice = Vendor 20766: Error ProgramAbort 3 1, "H function twice in one block", cause "H10 H10", hint "leave one of the two out";
    MeasuringFunction = Vendor 20772: Error ProgramAbort 3 1, "G function does not fit the measuring type", cause "G106 without type 3", hint "select the type of the function by #MEAS MODE [3]", parameter "P-CHAN-00057";
    TwoSplines = Vendor 20792: Error ProgramAbort 3 1, "two of G150/G151", cause "G150 G151", hint "one of G150, G151 per block";
    TwoCornerDecelerations = Vendor 20794: Error ProgramAbort 3 1, "two of G12, G13", hint "leave one of the two out";
    NoCornerParameters = Vendor 20795: Error ProgramAbort 3 1, "corner deceleration without parameters", cause "G13 before #CORNER PARAM", hint "write #CORNER PARAM [DIST=.. UNIT=PERCENT FEED=..] before it";
    AxisNameUnknown = Vendor 20797: Error ProgramAbort 3 1, "unknown axis designation in a command", hint "write the name of an axis of the channel";
    InsertionTooLarge = Vendor 20800: Error ProgramAbort 3 1, "size of a chamfer or rounding outside the data format", cause "G301 I94967296", hint "sizes reach up to 214748.3647 mm";
    SystemWithCompensation = Vendor 20802: Error ProgramAbort 3 1, "change of the coordinate system while tool radius compensation is active", cause "#MCS ON between G41 and G40", hint "write G40 first";
    CoordinateSystemNumber = Vendor 20820: Error ProgramAbort 3 1, "number of a coordinate system not allowed", cause "#CS ON [0][..]; a sixth system", hint "five systems are stored at most, with numbers above 0";
    NoCoordinateSystem = Vendor 20821: Error ProgramAbort 3 1, "coordinate system not defined", cause "#CS ON without values", hint "write #CS DEF [number][x,y,z,a,b,c] before it";
    ActiveSystemDefined = Vendor 20825: Error ProgramAbort 3 1, "active coordinate system defined anew", cause "#CS ON [1][..] while system 1 is active", hint "write #CS OFF before it, or take another number";
    LabelTwice = Vendor 20836: Error ProgramAbort 3 1, "label defined twice", hint "give one of the two another name";
    LabelTooLarge = Vendor 20838: Error ProgramAbort 3 1, "label number outside the data format", cause "$GOTO N99999999999", hint "label numbers are at most 4294967295";
    GotoTarget = Vendor 20839: Error ProgramAbort 3 1, "$GOTO is not followed by a label", hint "write $GOTO N20 or $GOTO [NAME]";
    BlockNumberTwice = Vendor 20841: Error ProgramAbort 3 1, "block number twice in one block", cause "N100 N100: X1", hint "leave one of the two out; N100: is number and label";
    DwellTwice = Vendor 20844: Error ProgramAbort 3 1, "dwell time twice in one block", cause "G04 2 G04 3", hint "leave one of the two out";
    OverrideSwitchTwice = Vendor 20846: Error ProgramAbort 3 1, "G166 twice in one block", hint "leave one of the two out";
    ValueOutOfType = Vendor 20847: Error ProgramAbort 3 1, "value outside the range of its variable", cause "256 written to a UNS08", hint "declare the variable with a wider type, or check the value before it is written";
    SpindlePositionTwice = Vendor 20851: Error ProgramAbort 3 1, "spindle position twice in one block", cause "S[M19 POS45 POS90]", hint "leave one of the positions";
    MirrorSwitch = Vendor 20860: Error ProgramAbort 3 1, "mirroring is switched by 1 and -1 only", cause "G351 X2", hint "-1 mirrors the axis, 1 does not";
    ToolIdFormat = Vendor 20863: Error ProgramAbort 3 1, "ID of a tool outside the data format", cause "#TOOL DATA [-1]", hint "IDs are whole numbers from 0 to 2147483647";
    ExistArgument = Vendor 20868: Error ProgramAbort 3 1, "EXIST without the name of a parameter or variable", hint "write EXIST[P1] or EXIST[V.P.NAME]";
    CommandAxisUnknown = Vendor 20875: Error ProgramAbort 3 1, "unknown axis in #FACE or #CYL", cause "#CYL [X, J] on a machine without an axis J", hint "name axes of the channel";
    SpindleAxisComma = Vendor 20880: Error ProgramAbort 3 1, "comma missing in #CAX", cause "#CAX[S C]", hint "#CAX[S,C]";
    DeclarationCharacter = Vendor 20904: Error ProgramAbort 3 1, "wrong character in the declaration of a variable or parameter", cause "V.L.TAB[2]=[1;2]", hint "write V.P.NAME : TYPE = value; values of arrays are separated by commas";
    VariableIndex = Vendor 20906: Error ProgramAbort 3 1, "index outside an array variable", hint "indices begin at 0; SIZEOF[V.P.NAME] is the size";
    VariableType = Vendor 20908: Error ProgramAbort 3 1, "variable type cannot be declared", hint "types are BOOLEAN, SGN08, UNS08, SGN16, UNS16, SGN32, UNS32, REAL64, STRING[n]";
    VariableExists = Vendor 20909: Error ProgramAbort 3 1, "variable exists already", cause "two #VAR of one name", hint "leave the second #VAR out, or remove the variable by #DELETE before it";
    SizeOfArgument = Vendor 20916: Error ProgramAbort 3 1, "SIZEOF without a variable or parameter", cause "P1=SIZEOF[5]", hint "write the name of an array, without an index: SIZEOF[V.P.NAME]";
    DimensionTooLarge = Vendor 20917: Error ProgramAbort 3 1, "size of an array outside the data format", hint "all arrays together hold up to 4 million elements";
    NoSuchDimension = Vendor 20918: Error ProgramAbort 3 1, "SIZEOF of a dimension that the array does not have", hint "SIZEOF[P20, 1] is the first dimension";
    ParameterExists = Vendor 20919: Error ProgramAbort 3 1, "parameter exists already", cause "two #VAR of one array", hint "leave the second declaration out, or remove the parameter by #DELETE before it";
    ArrayNotDeclared = Vendor 20921: Error ProgramAbort 3 1, "P array not declared", hint "declare it between #VAR and #ENDVAR";
    ParameterUnknown = Vendor 20925: Error ProgramAbort 3 1, "unknown parameter", cause "read before it was written, or with other dimensions than declared", hint "assign a value before it is read: P1=5";
    DeletedNotOwn = Vendor 20931: Error ProgramAbort 3 1, "#DELETE of a variable that the program has not defined", cause "#DELETE V.A.ABS.X", hint "only P parameters and V.P, V.L, V.S, V.CYC can be deleted";
    DeletedUnknown = Vendor 20932: Error ProgramAbort 3 1, "variable to be deleted does not exist", cause "#DELETE V.P.NAME", hint "EXIST[V.P.NAME] checks whether it exists";
    MeasuringArc = Vendor 20954: Error ProgramAbort 3 1, "arc as a measuring run", cause "G02 or G03 with G100 or G310", hint "measuring runs are straight";
    MeasuringTypeOfG310 = Vendor 20956: Error ProgramAbort 3 1, "G310 does not fit the measuring type", cause "G310 measures with types 5 and 6", hint "select one of them by #MEAS MODE [5]", parameter "P-CHAN-00057";
    TangentialRadius = Vendor 20962: Error ProgramAbort 3 1, "least radius of #TANGFEED outside the data format", cause "#TANGFEED [RMIN=-5]", hint "a radius is 0 or more";
    DimensionTooSmall = Vendor 20966: Error ProgramAbort 3 1, "size of an array below 1", hint "write 1 or more";
    SpindleName = Vendor 20971: Warning None 1 2, "spindle name of the channel list that does not begin with S, S is used", cause "spindel[0].bezeichnung C", hint "names of spindles begin with S", parameter "P-CHAN-00007";
    ArrayOutsideDeclaration = Vendor 20972: Error ProgramAbort 3 1, "values of an array outside #VAR and #ENDVAR", cause "V.P.A[3]=[1,2,3]", hint "declare the array between #VAR and #ENDVAR";
    TooManyDimensions = Vendor 20974: Error ProgramAbort 3 1, "too many dimensions of an array", hint "arrays have up to 4 dimensions";
    TwoDecelerations = Vendor 20977: Error ProgramAbort 3 1, "two of G09/G900/G901", hint "one of G09, G900, G901 per block";
    SuppressWithIncremental = Vendor 20985: Error ProgramAbort 3 1, "#SUPPRESS OFFSETS with G91", hint "write G90 before it";
    SpindleSpeedNegative = Vendor 20991: Error ProgramAbort 3 1, "negative spindle speed in a spindle bracket", hint "M3 and M4 set the direction, REV and SPEED are positive";
    SignalNumber = Vendor 20995: Error ProgramAbort 3 1, "negative number of a signal", cause "#SIGNAL [ID=-1]", hint "numbers of signals are 0 or above";
    TappingSpindleFunction = Vendor 21000: Error ProgramAbort 3 1, "spindle function while G63 is active", cause "M3, M4, M5 or M19 in the block of G63 or after it", hint "write G00 or G01 before it: G63 is modal";
    SizeOfSystemVariable = Vendor 21023: Error ProgramAbort 3 1, "SIZEOF of a variable of the control", cause "SIZEOF[V.G.WZ_AKT.V[1]]", hint "SIZEOF takes arrays of the program: P, V.P, V.L, V.S";
    CentreAndRadius = Vendor 21024: Error ProgramAbort 3 1, "centre and radius both given", hint "leave R out, or I, J and K";
    SpindleSpeedTwice = Vendor 21036: Error ProgramAbort 3 1, "spindle speed twice in one block", cause "S[M3 REV100 REV200]", hint "leave one of the two out";
    NotMainSpindle = Vendor 21044: Error ProgramAbort 3 1, "DIN words of a spindle that is not the main spindle", cause "S2=100 M3", hint "write S2[REV100 M3]";
    MainSpindleName = Vendor 21045: Error JobAbort 1 2, "the name of the main spindle is that of another spindle", cause "main_spindle_name S2 beside spindel[1].bezeichnung S2", hint "give the main spindle a name that no other spindle has", parameter "P-CHAN-00053";
    IndependentSyntax = Vendor 21068: Error ProgramAbort 3 1, "syntax of an independent axis";
    CouplingNumeratorZero = Vendor 21077: Error ProgramAbort 3 1, "numerator of a coupling factor is 0", cause "#SET AX LINK [1, [Y=X, 0, 1]]", hint "write the factor as two numbers that are not 0: [Y=X, -1, 1] mirrors";
    CouplingDenominatorMissing = Vendor 21110: Error ProgramAbort 3 1, "denominator of a coupling factor missing", cause "#SET AX LINK [1, [Y=X, -1]]", hint "write numerator and denominator: [Y=X, -1, 1]";
    CouplingFactorInvalid = Vendor 21111: Warning None 1 1, "coupling factor is neither 1 nor -1", cause "#SET AX LINK [1, [Y=X, 1, 2]]", hint "the control couples with the factor 1: write [Y=X, 1, 1] or, mirrored, [Y=X, -1, 1]";
    RotationCentreTooLarge = Vendor 21147: Error ProgramAbort 3 1, "centre of a contour rotation outside the data format", cause "#ROTATION ON [ANGLE=30 CENTER1=99999999]", hint "centres reach up to 214748.3647 mm";
    TimerNumber = Vendor 21167: Error ProgramAbort 3 1, "number of a timer outside 0 to 127", hint "timers have the numbers 0 to 127";
    LabelBehindWords = Vendor 21187: Error ProgramAbort 3 1, "label after words of its block", cause "N10 X100 [NAME] Y200", hint "a label comes first in its block: N10 [NAME] X100 Y200";
    ArrayWithoutIndex = Vendor 21216: Error ProgramAbort 3 1, "index of an array is missing", cause "P1 = V.P.TAB", hint "write V.P.TAB[0]";
    VariableClass = Vendor 21218: Error ProgramAbort 3 1, "variable type not available", cause "V.L.", hint "V.P, V.L, V.S and V.CYC can be declared";
    TokenUnknown = Vendor 21220: Error ProgramAbort 3 1, "unknown or incomplete token in a # command", cause "misspelt or misplaced keyword", hint "kontur explain '#NAME' shows how the command is written";
    MessageFormat = Vendor 21232: Error ProgramAbort 3 1, "unknown format in #MSG", cause "only %s %S %d %D %f %F", hint "formats are %s, %d and %f";
    OscillationCount = Vendor 21237: Error ProgramAbort 3 1, "number of oscillations outside the data format", cause "NBR_OSC=0", hint "write a whole number from 1";
    PathAxisIsSpindle = Vendor 21238: Error JobAbort 7 2, "path axis of the channel list whose axis list is that of a spindle", hint "name the spindle under spindel[i], or change the axis type", parameter "P-CHAN-00035";
    ArcFunctionRange = Vendor 21241: Error ProgramAbort 3 1, "argument of ASIN or ACOS outside -1 to 1", cause "P1=ASIN[2]", hint "sine and cosine lie between -1 and 1";
    ExchangeComma = Vendor 21251: Error ProgramAbort 3 1, "axis exchange: comma missing", hint "write [name, number, index]";
    ExchangeNumber = Vendor 21252: Error ProgramAbort 3 1, "axis exchange: axis number wrong", hint "write [name, number, index]";
    ExchangeNumberRange = Vendor 21253: Error ProgramAbort 3 1, "axis exchange: axis number outside the data format", hint "the logical axis numbers are in the axis lists (kopf.achs_nr)";
    ExchangeIndexRange = Vendor 21254: Error ProgramAbort 3 1, "axis exchange: index outside the data format", cause "#CALL AX [X,1,99]", hint "the index is the place of the axis in the channel";
    ExchangeNameTwice = Vendor 21256: Error ProgramAbort 3 1, "axis exchange: name of an axis twice", cause "#SET AX [X,1,0][X,2,1]", hint "give every axis of the channel a name of its own";
    ExchangeIndexTwice = Vendor 21257: Error ProgramAbort 3 1, "axis exchange: index twice", cause "#CALL AX [X,1,0][Y,2,0]", hint "give every axis its own index";
    ExchangeNumberTwice = Vendor 21258: Error ProgramAbort 3 1, "axis exchange: axis number twice", cause "#CALL AX [X,1,0][Y,1,1]", hint "name every axis once";
    ExchangeIndexTaken = Vendor 21260: Error ProgramAbort 3 1, "axis exchange: the axis index is in use", cause "#CALL AX [Z,3,0] while X is the axis 0", hint "take a free index, or release the other axis with #PUT AX first";
    CouplingPairs = Vendor 21281: Error ProgramAbort 3 1, "too many pairs in a coupling group", cause "#SET AX LINK with 16 pairs", hint "divide them into several groups: a group has at most 15 pairs";
    SlaveIsActiveSlave = Vendor 21283: Error ProgramAbort 3 1, "slave is a slave in another coupling group that is switched on", hint "switch the other group off, or leave the pair out";
    SlaveIsActiveMaster = Vendor 21284: Error ProgramAbort 3 1, "slave is a master in another coupling group that is switched on", hint "switch the other group off, or leave the pair out";
    MasterIsActiveSlave = Vendor 21285: Error ProgramAbort 3 1, "master is a slave in another coupling group that is switched on", hint "switch the other group off, or leave the pair out";
    KeyRange = Vendor 21296: Error ProgramAbort 3 1, "value of a keyword outside its range", cause "#CONTOUR MODE [REMAIN_PART=300]", hint "the message names the range";
    AxisFunctionMissing = Vendor 21301: Error ProgramAbort 3 1, "bracket of an axis that does not begin with its function", cause "X[POS=10 INDP_SYN ..]", hint "the function comes first: INDP_SYN, INDP_ASYN, OSC, OVERRIDE, SET_POSITION, M or H functions";
    PercentInSubroutine = Vendor 21313: Error ProgramAbort 3 1, "% inside a global subroutine", hint "remarks begin with ; or (; no block may precede %NAME";
    TangentialInsideCorner = Vendor 21316: Warning None 1 1, "G05 with the inside corner selection G238, ignored", hint "leave G05 out";
    InsideCornerActive = Vendor 21317: Error ProgramAbort 3 1, "G238 while tool radius compensation is active", hint "write G238 before G41 or G42";
    SelectionActive = Vendor 21318: Error ProgramAbort 3 1, "change of the way of selection within that of G238", cause "G139 between G41 and G40", hint "write G40 first";
    SynchronousParameters = Vendor 21344: Error ProgramAbort 3 1, "#WAIT SYN with parameters of a signal", cause "#WAIT SYN [ID=1 P[0]=P5]", hint "leave SYN out: parameters are read without synchronisation";
    CycleKeyTwice = Vendor 21379: Error ProgramAbort 3 1, "keyword twice in L CYCLE[...]", hint "leave one of the two out";
    CycleWhileModal = Vendor 21381: Error ProgramAbort 3 1, "cycle called while a modal cycle is active", hint "write #DISABLE MODAL CYCLE before the call";
    CycleParameterOutside = Vendor 21382: Error ProgramAbort 3 1, "cycle parameter outside of a cycle", cause "@P1=10 in a main program", hint "a cycle gets its parameters by L CYCLE [NAME=.. @P1=10]";
    CycleAxisOutside = Vendor 21383: Error ProgramAbort 3 1, "axis of a cycle outside of a cycle", cause "@X=10 in a main program", hint "@X, @Y and @Z are words of cycles; write the axis";
    CycleCentreOutside = Vendor 21384: Error ProgramAbort 3 1, "centre of a cycle outside of a cycle", cause "@I=100 in a main program", hint "@I, @J and @K are words of cycles; write I, J, K";
    CycleSpindleOutside = Vendor 21385: Error ProgramAbort 3 1, "spindle of a cycle outside of a cycle", cause "@S=1000 in a main program", hint "@S is a word of cycles; write the spindle";
    ConditionalOpen = Vendor 21387: Error ProgramAbort 3 1, "#IF without #ENDIF", hint "write #ENDIF before the end of the program";
    WearWithoutWheel = Vendor 21391: Error ProgramAbort 3 1, "#OTC ON without a grinding tool", cause "tool data of another type are selected", hint "wz[i].typ of the tool list is 2 for grinding tools", parameter "P-TOOL-00001";
    WordsWithoutDimensions = Vendor 21404: Warning None 1 2, "several words of an axis without several G90 and G91, switched off", cause "multi_axes_in_block 1 with multi_dimension_in_block 0", hint "set both, or none", parameter "P-CHAN-00148";
    WaitWithoutSyn = Vendor 21413: Error ProgramAbort 3 1, "WAIT of #MACHINE DATA without SYN", hint "write #MACHINE DATA SYN [.. WAIT] or leave WAIT out";
    OverrideKeyTwice = Vendor 21420: Error ProgramAbort 3 1, "keyword twice in #OVERRIDE", hint "leave one of the two out";
    MixedTypes = Vendor 21457: Error ProgramAbort 3 1, "a text and a number in one operation", cause "\"Peter\" + 23", hint "INT_TO_STR[23] makes a text of a number";
    TextOperator = Vendor 21458: Error ProgramAbort 3 1, "operator not defined for texts", hint "texts are joined by + and compared by == and !=";
    TextExpected = Vendor 21460: Error ProgramAbort 3 1, "a text is expected", cause "a number written to a STRING", hint "INT_TO_STR and REAL_TO_STR make texts of numbers";
    NumberExpected = Vendor 21461: Error ProgramAbort 3 1, "a number is expected, not a text", cause "a text written to a number", hint "STR_TO_INT and STR_TO_REAL make numbers of texts";
    TextTooLong = Vendor 21462: Error ProgramAbort 3 1, "text too long for its variable", hint "declare it with a longer STRING[n], up to 126";
    DigitExpected = Vendor 21464: Error ProgramAbort 3 1, "text that is not a number", cause "STR_TO_INT[\"abc\"]", hint "the text holds digits";
    DigitsTooMany = Vendor 21465: Error ProgramAbort 3 1, "a text with too many digits for a number", cause "STR_TO_INT[\"99999999999999\"]", hint "STR_TO_REAL takes longer numbers than STR_TO_INT";
    RepeatNotAlone = Vendor 21468: Error ProgramAbort 3 1, "$REPEAT is not alone in its block", hint "move the words to the block after $REPEAT";
    UntilTrailing = Vendor 21470: Error ProgramAbort 3 1, "trailing words after $UNTIL", cause "$UNTIL P2>20 X100", hint "only the condition may follow $UNTIL; move the words to the next block";
    TooFewArguments = Vendor 21471: Error ProgramAbort 3 1, "too few arguments of a function", cause "LEFT[\"Hello\"]", hint "kontur explain NAME shows the arguments";
    TextCount = Vendor 21472: Error ProgramAbort 3 1, "count of characters out of range", cause "LEFT[\"Hello\", 100000]", hint "write a count from 0 to the length of a text";
    JumpIntoLoop = Vendor 21480: Error ProgramAbort 3 1, "jump into a loop", hint "jumps lead out of loops and within them; put the label before the loop";
    CoupledAxisAlone = Vendor 21481: Error ProgramAbort 3 1, "coupled axis as an independent axis", cause "X[INDP_ASYN ..] after #ENABLE AX LINK [1]", hint "write #DISABLE AX LINK before it";
    OpenIfLocal = Vendor 21500: Error ProgramAbort 3 1, "open $IF in a local subroutine", cause "the branch is not taken", hint "write $ENDIF before the end of the subroutine";
    OpenIfMain = Vendor 21501: Error ProgramAbort 3 1, "open $IF in the main program", cause "the branch is not taken", hint "write $ENDIF before the end of the program";
    OpenIfGlobal = Vendor 21502: Error ProgramAbort 3 1, "open $IF in a global subroutine", cause "the branch is not taken", hint "write $ENDIF before the end of the subroutine";
    TimerTwice = Vendor 21537: Error ProgramAbort 3 1, "word twice in #TIMER", cause "#TIMER START STOP, #TIMER START [ID=1 ID=2]", hint "one of START, STOP, READ and CLEAR, and one ID";
    ThreadOffsetTwice = Vendor 21540: Error ProgramAbort 3 1, "offset angle of a thread twice in one block", hint "leave one of the two out";
    BehindCall = Vendor 21542: Error ProgramAbort 3 1, "NC command after a subroutine or cycle call", cause "LL SUB Z300", hint "write it before the call or in the next block";
    ParameterOutsideCycle = Vendor 21544: Error ProgramAbort 3 1, "V.G.@P[i].VALID outside a cycle", hint "ask for it inside the cycle";
    TextPosition = Vendor 21545: Error ProgramAbort 3 1, "position outside the text of a text function", cause "DELETE[\"Hello world!\", 7, 100]: the text comes first, then the count, then the position", hint "positions count from 1 to LEN[..], for INSERT from 0";
    SignalParameter = Vendor 21549: Error ProgramAbort 3 1, "signal without the parameter that #WAIT reads", hint "give P[i] in the #SIGNAL";
    CompensationModulo = Vendor 21555: Error ProgramAbort 3 1, "tool radius compensation with a modulo axis", cause "G41 while a main axis of the plane counts modulo 360 degrees (P-AXIS-00015)", hint "take another plane, or an axis that does not count modulo";
    SystemOfModuloAxis = Vendor 21556: Error ProgramAbort 3 1, "coordinate system over a modulo axis", cause "#CS ON while a main axis counts modulo 360 degrees (P-AXIS-00015)", hint "only axes that do not count modulo are main axes of a coordinate system";
    SystemNameInUse = Vendor 21599: Error ProgramAbort 3 1, "name of a coordinate system already in use", cause "#CS ADD [WCS][..] twice", hint "choose another name, or change the system by #CS SET";
    SystemNameUnknown = Vendor 21601: Error ProgramAbort 3 1, "name of a coordinate system unknown", cause "#CS SELECT [WCS] without #CS ADD [WCS]..", hint "is the name right? Case counts";
    SlopeType = Vendor 21629: Error ProgramAbort 3 1, "unknown identifier in #SLOPE[TYPE=..]", hint "types are STEP, TRAPEZ, SIN2, HSC";
    NegativeLimitBelowList = Vendor 21648: Warning None 1 1, "negative software limit below that of the axis list, limited", cause "G98 with P-CHAN-00498 = 1", hint "P-AXIS-00177 is the lowest limit", parameter "P-CHAN-00498";
    NegativeLimitTooHigh = Vendor 21649: Error ProgramAbort 3 1, "negative software limit not below the positive one", cause "G98 X600 with the positive limit 500", hint "raise the positive limit first, with G99";
    PositiveLimitAboveList = Vendor 21650: Warning None 1 1, "positive software limit above that of the axis list, limited", cause "G99 with P-CHAN-00498 = 1", hint "P-AXIS-00178 is the highest limit", parameter "P-CHAN-00498";
    SequenceTwice = Vendor 21696: Error ProgramAbort 3 1, "key of L SEQUENCE twice, or keys that do not go together", cause "L SEQUENCE [N10 N20 N30]", hint "L SEQUENCE [NAME=.. N10 N50]";
    InsertionsOff = Vendor 21718: Error ProgramAbort 3 1, "chamfer or rounding although the channel list switches them off", cause "disable_chamfers_roundings 1", hint "set P-CHAN-00273 to 0", parameter "P-CHAN-00273";
    SpindleCommandsExclude = Vendor 21736: Error ProgramAbort 3 1, "words of a spindle bracket that exclude each other", cause "S[G136=80 G130=60]", hint "write feedforward and G130 in separate brackets";
    SpindleFeedforwardTwice = Vendor 21738: Error ProgramAbort 3 1, "G136 twice in one spindle sequence", hint "leave one of the two out";
    ArcRadiiDiffer = Vendor 21758: Error ProgramAbort 3 1, "circle radii differ too much", cause "G164; limits P-CHAN-00171/172", hint "G165 moves the centre so that it fits; check I, J and the end point", parameter "P-CHAN-00171";
    NoArray = Vendor 21768: Error ProgramAbort 3 1, "index of a variable that is no array", cause "V.P.A[1] after V.P.A = 5", hint "declare it between #VAR and #ENDVAR: V.P.A[size]";
    SpindleToken = Vendor 21867: Error ProgramAbort 3 1, "unknown token in spindle programming", hint "M3, M4, M5, M19, REV=, SPEED=, POS=, G135, G136=, G137 belong in a spindle bracket";
    PositiveLimitTooLow = Vendor 21878: Error ProgramAbort 3 1, "positive software limit not above the negative one", cause "G99 X-600 with the negative limit -500", hint "lower the negative limit first, with G98";
    ContourLineParallel = Vendor 21892: Error ProgramAbort 3 1, "equal or opposite angles of two contour lines", cause "#ANG=60, then #ANG=60 X30 Y40", hint "the second line needs another angle";
    ContourLineTwice = Vendor 21895: Error ProgramAbort 3 1, "angle of a contour line with two coordinates", cause "#ANG=45 X20 Y25", hint "leave one of the two coordinates out";
    OutsideMotionRange = Vendor 21897: Error ProgramAbort 3 1, "position outside the motion range", hint "kenngr.swe_neg and kenngr.swe_pos of the axis list (P-AXIS-00177, P-AXIS-00178) set the limits", parameter "P-AXIS-00177";
    ContourLineOpen = Vendor 21904: Error ProgramAbort 3 1, "contour line not completely defined", cause "#ANG=30 without a coordinate, and no #ANG in the next block", hint "write one coordinate, or #ANG and both coordinates into the next block";
    FlushInContourLine = Vendor 21909: Error ProgramAbort 3 1, "flush between the two blocks of a contour line", cause "#ANG=30, #FLUSH, #ANG=80 X30 Y40", hint "write #FLUSH before the first or behind the second of the two blocks";
    ContourLineRelative = Vendor 21910: Error ProgramAbort 3 1, "second of two contour lines in relative coordinates", hint "write G90 into its block";
    ContourLinesOff = Vendor 21932: Error ProgramAbort 3 1, "#ANG, #CHR, #CHF or #RND although the channel list switches them off", cause "disable_chamfers_roundings 1", hint "set P-CHAN-00273 to 0", parameter "P-CHAN-00273";
    AxisIdentifier = Vendor 21947: Error ProgramAbort 3 1, "unknown axis identifier", hint "write the name of an axis or spindle of the channel";
    ChannelInitTwice = Vendor 21972: Error ProgramAbort 3 1, "#CHANNEL INIT with two kinds of positions", cause "#CHANNEL INIT [CMDPOS CMDPOS]", hint "write one of CMDPOS and ACTPOS, once";
    StretchFactor = Vendor 22007: Warning None 1 1, "STRETCH_FACTOR outside its range", cause "#TRC [STRETCH_FACTOR=10]", hint "1 to 9 tool radii are possible";
    SeveralCalls = Vendor 22008: Error ProgramAbort 3 1, "several implicit calls at one block end", hint "write the second call in a separate block";
    FilterAndGuard = Vendor 22060: Error ProgramAbort 3 1, "#FILTER and #VIB GUARD in one program", cause "the two may not be mixed", hint "use one of the two in a program; the OFF forms count too";
    GuardMode = Vendor 22062: Error ProgramAbort 3 1, "Vibration Guard mode not allowed", cause "MODE outside 1…4", hint "modes are 1 to 4";
    FilterMode = Vendor 22068: Error ProgramAbort 3 1, "invalid MODE in #FILTER", hint "keys are HSC, ORDER, ORDER_TIME, SHARE, AX_DEV, FCUT, ACC_FACT, QUALITY";
    CallCharacter = Vendor 22151: Error ProgramAbort 3 1, "wrong character in an implicit call", cause "G80 [..]", hint "separate the values with commas: G80 [1, 2, , 4]";
    RotationAxis = Vendor 22156: Error ProgramAbort 3 1, "axis outside the plane of a contour rotation", cause "G68 with the third main axis", hint "the centre of the rotation is given by the two axes of the plane";
    TwoRampWeights = Vendor 22180: Error ProgramAbort 3 1, "two weights of ramp times in one block", cause "G132 X70 G133=100", hint "write them in separate blocks";
    TwoVelocityWeights = Vendor 22182: Error ProgramAbort 3 1, "two weights of the highest speed in one block", cause "G127 X70 G128=100", hint "write them in separate blocks";
    MessageSuppressed = Vendor 22194: Warning None 1 1, "#MSG to the diagnosis receiver is suppressed, warning", cause "P-CHAN-00518", parameter "P-CHAN-00518";
    MessageForbidden = Vendor 22195: Error ProgramAbort 3 1, "#MSG to the diagnosis receiver is suppressed, error", cause "P-CHAN-00518", parameter "P-CHAN-00518";
    CircleAngleAndEnd = Vendor 22253: Error ProgramAbort 3 1, "#CANG together with an end point", cause "G02 X10 I5 #CANG=90", hint "an arc ends at its angle or at its end point: delete one of them";
    MacroLengthArgument = Vendor 22254: Error ProgramAbort 3 1, "MACRO_LENGTH without the name of a macro", cause "MACRO_LENGTH[NAME]", hint "write the name in quotes: MACRO_LENGTH[\"NAME\"]";
    MacroContentArgument = Vendor 22275: Error ProgramAbort 3 1, "MACRO_CONTENT without the name of a macro", cause "MACRO_CONTENT[NAME]", hint "write the name in quotes: MACRO_CONTENT[\"NAME\"]";
    MacroContentFailed = Vendor 22276: Error ProgramAbort 3 1, "macro of MACRO_CONTENT that cannot be resolved", cause "no macro of that name, macros nested too deeply, a text that is too long", hint "define the macro before: \"NAME\" = \"text\"";
    ProbeActuated = Vendor 50052: Error FeedHold 6 1, "the probe is actuated before the measuring run", hint "clear the probe first: the input `probe` is 1 where the run begins";
    NoMeasuringAxis = Vendor 50059: Error FeedHold 6 1, "axis that does not take part in measuring runs", cause "kenngr.messachse 0", hint "set kenngr.messachse to 1", parameter "P-AXIS-00118";
    MeasuringAxes = Vendor 50061: Error FeedHold 6 1, "more axes in a measuring run than its type allows", cause "type 2 has one axis, type 4 the three main axes", hint "select another type by #MEAS MODE [1]", parameter "P-CHAN-00057";
    SpeedError = Vendor 50118: Error FeedHold 6 0, "axis speed above the limit", cause "> vb_max·(1+P-AXIS-00440/1000), default +9 %", hint "lower the feed, or a filter overshoots: CRIT_DAMPING and BESSEL hardly do";
    SpeedWarning = Vendor 50119: Warning None 1 0, "axis speed above the warning level", cause "P-AXIS-00439, +5 %", hint "lower the feed, or a filter overshoots: CRIT_DAMPING and BESSEL hardly do";
    DynamicsLimited = Vendor 50130: Warning None 1 0, "dynamics limited", cause "weighting G130-G133, G231, G233 beyond the limit", hint "lower the weight, or raise what the axis list allows (P-AXIS-00008 for accelerations)";
    CuttingSpeedZero = Vendor 50182: Error ProgramAbort 6 1, "cutting speed 0", cause "G96 S0", hint "S is the cutting speed in m/min under G96";
    AccelerationCurve = Vendor 50254: Error AllStop 7 2, "unknown acceleration curve of a spindle", cause "beschl_kennlinie.typ 7", hint "0 none, 1 hyperbola, 2 polynomial, 3 asynchronous drive", parameter "P-AXIS-00202";
    MovedWithoutBanding = Vendor 50263: Error FeedHold 6 1, "moved main axis that does not take part in edge banding", cause "kenngr.kasto_achse 0", hint "set kenngr.kasto_achse to 1", parameter "P-AXIS-00098";
    NoBandingAxis = Vendor 50398: Error FeedHold 6 1, "no axis for edge banding", cause "kenngr.kasto_achse is 0 for all main axes", hint "set kenngr.kasto_achse to 1 for the axes of the plane", parameter "P-AXIS-00098";
    OscillationLimited = Vendor 50487: Warning None 1 0, "oscillation slower than programmed", cause "FREQ, TIME or FEED beyond what velocity and acceleration of the axis allow", hint "lower FREQ or FEED, or bring the reversal positions closer together", parameter "P-AXIS-00212";
    SpindleStandsInThread = Vendor 50499: Error AllStop 6 0, "spindle speed 0 with G33", cause "G33 before M3 and S", hint "write S1000 M3 before it";
    OscillationFeed = Vendor 50593: Error AbruptStop 6 1, "oscillation without a feed", cause "X[OSC ON ..] with FEED=0, or without FEED, FREQ and TIME", hint "X[OSC ON 1ST_POS=-10 2ND_POS=10 FEED=1000]";
    BandingPath = Vendor 50655: Error FeedHold 6 1, "not enough path for the way after the signal of edge banding", cause "the block ends before, or the path is too fast to stop that soon", hint "lengthen the block, lower F, or raise V.G.RW", parameter "P-CHAN-00030";
    FilterTime = Vendor 50663: Error JobAbort 7 0, "filter time constant not allowed", cause "P-AXIS-00357: PT1 and PT2 at least one cycle, delay below 6 cycles", hint "raise or lower filter[i].time_constant (P-AXIS-00357)";
    GuardNotRealisable = Vendor 50820: Error FeedHold 6 0, "frequency and damping do not fit Vibration Guard", cause "frequency too high or damping too large for T", hint "use a smaller cycle, less damping or a higher frequency (the manual's advice); kontur tune proposes both";
    FilterTimeBelowCycle = Vendor 50910: Warning None 1 0, "order_time/time_constant below the cycle time", hint "the filter gets at least one cycle: raise the time, or give ORDER";
    FilterOrderTooHigh = Vendor 50911: Warning None 1 0, "filter order too high", hint "lower the order";
    FilterWithoutOrder = Vendor 50989: Warning ProgramAbort 3 0, "FIR filter without order", cause "#FILTER ON, P-AXIS-00587 = 0", hint "give ORDER or ORDER_TIME, or P-AXIS-00587 in the axis list";
    SpindleSpeedError = Vendor 60101: Error AllStop 6 0, "spindle speed limit exceeded", cause "+9 %", hint "lower the speed, or a filter overshoots: CRIT_DAMPING and BESSEL hardly do";
    SpindleSpeedWarning = Vendor 60102: Warning None 1 0, "spindle speed above the warning level", cause "+5 %", hint "lower the speed, or a filter overshoots: CRIT_DAMPING and BESSEL hardly do";
    SpindleSpeedZeroAtFeed = Vendor 60132: Error AllStop 6 0, "spindle speed 0 while feed per revolution is active", hint "program the speed before: S1000 M3";
    SpindleStoppedInThread = Vendor 60154: Error AllStop 6 0, "G33 while the spindle stands", cause "S1000 and G33 without M3", hint "write M3 or M4 before it";
    SpindleSlopeType = Vendor 60226: Warning None 1 0, "slope type of a spindle invalid", cause "P-AXIS-00270", hint "getriebe[i].slope_type is 0 to 3 (P-AXIS-00270)";
    SpindleFilterTime = Vendor 60311: Error JobAbort 7 0, "filter time constant (spindle)", cause "as 50663", hint "raise or lower filter[i].time_constant (P-AXIS-00357)";
    FollowingError = Vendor 70020: Error OpenLoopStop 6 11, "following error too large", cause "limits 00167…00172, 00191", hint "raise slep_max, use feedforward (G135), or lower the feed", parameter "P-AXIS-00172";
    SettlingTimeout = Vendor 70082: Error AbruptStop 6 11, "exact-stop window not reached in time", cause "00236, 00532", hint "raise position_settling_time (P-AXIS-00532) or window, or the gain kv", parameter "P-AXIS-00236";
    AxisWithoutPositionControl = Vendor 70345: Error AbruptStop 7 11, "axis without position control that is not a spindle", cause "P-AXIS-00320", hint "antr.operation_mode CNC_POSITION_CONTROL or DRIVE_DEFAULT for axes of the path";
    AccelerationDelay = Vendor 70348: Warning None 1 11, "acceleration (or jerk) feedforward delay too large, set to 0", cause "P-AXIS-00390, P-AXIS-00547", hint "the delay is below 6 cycles (P-AXIS-00390, P-AXIS-00547)";
    VelocityDelay = Vendor 70349: Warning None 1 11, "velocity feedforward delay too large, set to 0", cause "P-AXIS-00389", hint "the delay is below 6 cycles (P-AXIS-00389)";
    NoAdditiveVelocity = Vendor 70350: Warning None 1 11, "additive velocity not in the process data", cause "P-AXIS-00223 ADD_VEL", hint "name S_0_0037 in antr.sercos.mdt[i].nc_ref";
    NoAdditiveTorque = Vendor 70351: Warning None 1 11, "additive torque not in the process data", cause "P-AXIS-00223 ADD_ACC", hint "name S_0_0080 in antr.sercos.mdt[i].nc_ref";
    ControllerSpeed = Vendor 70382: Error ControlledStop 6 11, "axis speed above the limit in the controller", cause "00407 (default 100 % over vb_max; 0 = off)", hint "lower the gain kv or the feed, or raise lr_param.dyn_monitoring_v_err; 0 switches the monitor off", parameter "P-AXIS-00407";
    IpcGantrySlave = Vendor 70600: Warning None 7 11, "Improved Position Control enabled in a gantry slave", cause "P-AXIS-00758", hint "write the parameters into the list of the master";
    IpcChangedMoving = Vendor 70601: Error ControlledStop 6 11, "IPC parameters changed while moving", hint "change them at standstill";
    IpcNumerator = Vendor 70603: Warning None 1 11, "weight numerator of Improved Position Control is not above 0", cause "P-AXIS-00754", hint "write a value above 0 (P-AXIS-00754)";
    IpcDenominator = Vendor 70604: Warning None 1 11, "weight denominator of Improved Position Control is not above 0", cause "P-AXIS-00755", hint "write a value above 0 (P-AXIS-00755)";
    SimulationDamping = Vendor 80044: Warning None 1 11, "damping of the simulated drive ≥ 1", cause "00051/00050", hint "write daempfung_z below daempfung_n (P-AXIS-00051, P-AXIS-00050)";
    CompensationInArc = Vendor 90008: Error ProgramAbort 6 1, "tool radius compensation selected in a circular block", cause "a linear block must follow G41 and G42", hint "write a linear block after G41 and G42";
    ToolTooLarge = Vendor 90017: Error ProgramAbort 6 1, "tool radius not below the radius of an arc of the contour", hint "use a smaller tool, or a larger radius of the contour";
    ToolBetweenArcs = Vendor 90031: Error ProgramAbort 6 1, "tool radius compensation: tool too large for the corner between two arcs", hint "use a smaller tool, or larger radii of the contour";
    RadiusChangeInArc = Vendor 90047: Error ProgramAbort 6 1, "tool radius changes in front of an arc", cause "D or V.G.WZ_AKT.R within G41, then G02", hint "write a line in front of the arc";
    FlushAfterCompensation = Vendor 90050: Error ProgramAbort 3 1, "channel flush between G40 and the motion that leads away from the contour", cause "G40, then #FLUSH", hint "write a straight motion with G40 or behind it";
    InsideCornerRadius = Vendor 90127: Error ProgramAbort 3 1, "change of the tool radius within the contour of G238", hint "change the tool before G41 or after G40";
    WearSelectedInArc = Vendor 90183: Error ProgramAbort 3 1, "compensation that begins with an arc during online tool compensation", cause "#OTC ON, then G41 with an arc (G237)", hint "begin with a line, or write #OTC OFF before it";
    SpaceArcAfterCompensation = Vendor 90193: Error ProgramAbort 3 1, "arc in space behind G40", cause "G40, then G303", hint "write a straight motion with G40 or behind it";
    DeadTime = Vendor 110040: Warning None 1 2, "dead time of the simulated drive above the maximum, limited to 5", cause "P-AXIS-00194", hint "write 0 to 5 cycles";
    AxisSpeedZero = Vendor 110079: Warning None 1 2, "maximum axis speed is 0, default used", cause "P-AXIS-00212", hint "write the maximum speed of the axis";
    ShortestRampTime = Vendor 110083: Warning None 1 2, "shortest ramp time below its limit, limited", cause "P-AXIS-00201";
    ResolutionPath = Vendor 110086: Warning None 1 2, "encoder resolution (path) is 0, set to 1", cause "P-AXIS-00233", hint "write 1 or more";
    WindowZero = Vendor 110087: Warning None 1 2, "position window 0, the default is used", hint "write the window of exact stops in 0.1 um", parameter "P-AXIS-00236";
    FeedAccelerationZero = Vendor 110100: Warning None 1 2, "acceleration 0, the default is used", hint "write the acceleration of the feed in mm/s2", parameter "P-AXIS-00001";
    FeedDecelerationZero = Vendor 110102: Warning None 1 2, "deceleration 0, the default is used", hint "write the deceleration of the feed in mm/s2", parameter "P-AXIS-00002";
    SoftwareLimitRange = Vendor 110110: Warning None 1 2, "software limits leave no range, corrected", cause "P-AXIS-00177, P-AXIS-00178", hint "write kenngr.swe_neg below kenngr.swe_pos";
    OverrideRange = Vendor 110111: Warning None 1 2, "largest override below the smallest one, limited", cause "P-AXIS-00109", hint "write 1 to 2000 (0.1 %)";
    FeedforwardNumerator = Vendor 110122: Warning None 1 2, "weight numerator of the velocity feedforward is 0, set to 1", cause "P-AXIS-00514; printed for P-AXIS-00228 too", hint "write 1 or more";
    FeedforwardDenominator = Vendor 110123: Warning None 1 2, "weight denominator of the feedforward is 0, set to 1", cause "P-AXIS-00229, P-AXIS-00515", hint "write 1 or more; a numerator of 0 gives the weight 0";
    GainZero = Vendor 110150: Warning None 1 2, "gain of the position controller is 0, default used", cause "P-AXIS-00099", hint "write 1 or more, in 0.01/s";
    FilterType = Vendor 110239: Error JobAbort 7 2, "unknown filter type, filter off", cause "P-AXIS-00204", hint "types are LOWPASS, HIGHPASS, BANDPASS, BANDSTOP, ALLPASS, PT1, TIME_DELAY, PT2, HSC_MEAN";
    GeometricRampTime = Vendor 110276: Warning None 1 2, "geometric ramp time below the shortest ramp time, limited", hint "raise P-AXIS-00199, or lower P-AXIS-00201", parameter "P-AXIS-00199";
    SpindleWithoutType = Vendor 110304: Error ProgramAbort 7 2, "spindle of the channel list whose axis list is not that of a spindle", hint "kenngr.achs_typ ACHSTYP_SPINDEL makes an axis a spindle", parameter "P-AXIS-00018";
    SpindleMode = Vendor 110352: Warning None 1 2, "axis mode of a spindle that is not modulo, modulo is used", cause "kenngr.achs_mode 1 in the list of a spindle", hint "spindles count modulo: 4", parameter "P-AXIS-00015";
    AxisMode = Vendor 110353: Warning None 1 2, "unknown axis mode, corrected", cause "kenngr.achs_mode 8", hint "the mode has one of 1 linear, 2 optimised positioning, 4 modulo", parameter "P-AXIS-00015";
    FilterFrequencyTooLow = Vendor 110361: Warning None 1 2, "filter frequency below the lowest possible one, lowest frequency used", cause "P-AXIS-00067", hint "write a frequency above it, and below half the sampling rate";
    AccelerationDenominator = Vendor 110381: Warning None 1 2, "denominator of the acceleration feedforward is 0, set to 1", cause "P-AXIS-00226", hint "write 1 or more; a numerator of 0 switches the part off";
    ResolutionIncrements = Vendor 110386: Warning None 1 2, "encoder resolution (increments) is 0, set to 1", cause "P-AXIS-00234", hint "write 1 or more";
    WeightedRampFloor = Vendor 110406: Warning None 1 2, "floor of weighted ramp times below the shortest ramp time, corrected", cause "P-AXIS-00293", hint "write 0, or a time between tr_min and the ramp times";
    TorqueScaleDenominator = Vendor 110465: Warning None 1 2, "denominator of the torque scaling is 0, no torque output", cause "P-AXIS-00326", hint "write the value at which the motor gives its nominal torque";
    FeedConstantDenominator = Vendor 110472: Error JobAbort 7 2, "denominator of the feed constant is 0", cause "P-AXIS-00363", hint "write the revolutions of the feed constant, 1 or more";
    JerkDenominator = Vendor 110473: Warning None 1 2, "denominator of the jerk feedforward is 0, set to 100", cause "P-AXIS-00338", hint "write 1 or more";
    SecondHsc = Vendor 110500: Warning None 1 2, "more than one HSC filter on an axis, the wrong one is off", cause "P-AXIS-00153", hint "leave one HSC filter";
    HscNotFirst = Vendor 110501: Warning None 1 2, "HSC filter is not filter[0], filter off", cause "P-AXIS-00153", hint "write it as filter[0]";
    DeadBand = Vendor 110528: Warning None 1 2, "dead band of the position controller above the window, limited", cause "P-AXIS-00395, P-AXIS-00236", hint "write a dead band up to getriebe[i].window";
    GearRatio = Vendor 110579: Warning None 1 2, "gear ratio: output revolutions are 0, set to 1", cause "P-AXIS-00512", hint "write 1 or more";
    AxisNumberZero = Vendor 110597: Error JobAbort 7 2, "list for axis number 0, not loaded", cause "P-AXIS-00016", hint "kopf.achs_nr is 1 or more";
    WithoutDelayNeedsVelocityOnly = Vendor 110624: Warning None 1 2, "feedforward without delay together with acceleration or jerk, these are switched off", cause "P-AXIS-00566, P-AXIS-00223", hint "allow velocity feedforward only (P-AXIS-00223 VEL), or drop feedforward_without_delay";
    WeightMode = Vendor 120020: Error ProgramAbort 6 0, "unknown mode of the weights of ramp times", cause "#SET SLOPE PROFIL [1,7,0]", hint "0 all, 1 to 4 one of the ramp times";
    FirstStageZero = Vendor 120028: Warning None 1 2, "acceleration of stage 1 weighted to 0, limited to the minimum", cause "G131=0, G130 X0", hint "write a weight above 0", parameter "P-AXIS-00011";
    SecondStageZero = Vendor 120030: Warning None 1 2, "acceleration of stage 2 weighted to 0, limited to the minimum", cause "G131=0, G130 X0", hint "write a weight above 0", parameter "P-AXIS-00012";
    AccelerationZero = Vendor 120032: Warning None 1 2, "acceleration weighted to 0, limited to the minimum", cause "G131=0, G130 X0", hint "write a weight above 0", parameter "P-AXIS-00001";
    DecelerationZero = Vendor 120034: Warning None 1 2, "deceleration weighted to 0, limited to the minimum", cause "G131=0, G130 X0", hint "write a weight above 0", parameter "P-AXIS-00002";
    SplineTransition = Vendor 120097: Error ProgramAbort 6 0, "unknown transition of an Akima spline", cause "#SET ASPLINE MODE [9, 1]", hint "1 automatic, 2 tangential, 3 by a vector";
    SplineEndTangent = Vendor 120100: Error ProgramAbort 6 0, "target tangent of an Akima spline without direction", cause "#AKIMA ENDVECTOR X0 Y0", hint "write a component other than 0";
    FlushInSpline = Vendor 120102: Error ProgramAbort 3 0, "flush while a spline is active", cause "#FLUSH WAIT after #HSC ON [BSPLINE]", hint "write #HSC OFF before it";
    SplineWithoutMotion = Vendor 120112: Error ProgramAbort 6 0, "no motion before a spline with a tangential start", cause "#AKIMA TRANS [START=TANGENTIAL] before the first motion", hint "write a motion before G151, or START=AUTO";
    PathDevTooSmall = Vendor 120129: Error ProgramAbort 3 0, "PATH_DEV below the minimum", hint "write 0.0001 mm or more";
    CornerDistanceTooSmall = Vendor 120131: Error ProgramAbort 3 0, "corner distance below the minimum", hint "write 0.0001 mm or more";
    CuttingSpeedNegative = Vendor 120167: Error ProgramAbort 6 1, "cutting speed not above 0", cause "G96 S-5", hint "S is the cutting speed in m/min under G96";
    CuttingSpeedMax = Vendor 120169: Error ProgramAbort 3 1, "highest spindle speed of G196 not above 0", hint "G196 S2500";
    FaceTurningAxis = Vendor 120170: Error ProgramAbort 6 1, "G96 without exactly one face turning axis in the plane", cause "G96 S100, P-AXIS-00015 without the bit 0x40", hint "set the bit 0x40 of P-AXIS-00015 for it", parameter "P-AXIS-00015";
    SlopeWeighting = Vendor 120178: Error ProgramAbort 6 0, "unknown ramp-time weighting mode", cause "P-CHAN-00073", hint "0 all, 1 to 4 one of the ramp times", parameter "P-CHAN-00073";
    SplineWithoutMainAxis = Vendor 120180: Error ProgramAbort 6 0, "a point of a spline moves no main axis", cause "G151 with tracking axes alone", hint "move tracking axes together with main axes";
    ContouringAtEnd = Vendor 120206: Warning None 1 0, "program ends with contouring on", hint "write G260 or #CONTOUR MODE OFF before the end";
    ContouringNotPossible = Vendor 120207: Error ProgramAbort 3 0, "contouring not possible (measurement, feed group, corner)", hint "exclude the corner with G260";
    BlockTooShort = Vendor 120216: Warning None 1 0, "block too short for contouring", hint "lower PATH_DEV or the corner distances, or join the short blocks";
    SplineWithContouring = Vendor 120255: Error ProgramAbort 3 0, "spline together with contouring or #HSC", cause "G151 under G261", hint "write G260 or #HSC OFF before G151";
    CouplingWithContouring = Vendor 120333: Error ProgramAbort 3 0, "axis coupling switched while contouring is active", cause "#ENABLE AX LINK under G261", hint "write G260 before it";
    SplineInSurface = Vendor 120370: Error ProgramAbort 3 0, "spline selected while free-form surface mode is active", cause "G151 after #HSC ON [BSPLINE]", hint "write #HSC OFF before G151";
    FeedGroupOfArc = Vendor 120462: Warning None 1 1, "feed group does not fit an arc", cause "#FGROUP [X] and G02 in the plane X, Y", hint "#FGROUP names all axes of the arc, or none of the main axes";
    NoOscillation = Vendor 120470: Error ProgramAbort 6 1, "oscillation without a distance", cause "X[OSC ON 1ST_POS=50 2ND_POS=50 ..]", hint "the reversal positions 1ST_POS and 2ND_POS differ";
    ContouringFeedGroup = Vendor 120566: Error ProgramAbort 6 1, "contouring although the feed axes are not the main axes", cause "G261 with #FGROUP [X,Y]", hint "contouring needs the default feed axes: write #FGROUP, or G260", parameter "P-CHAN-00011";
    ContouringGroupChanged = Vendor 120567: Error ProgramAbort 6 1, "feed axes change behind a contoured block", cause "G61, then #FGROUP", hint "switch contouring off before the feed group changes";
    MeasuringWithContouring = Vendor 120652: Error ProgramAbort 6 0, "measuring run while contouring is on", cause "G261 before G100", hint "write G260 before the run";
    SoftContouringActive = Vendor 120698: Error ProgramAbort 6 1, "contouring mode changed to or from DIST_SOFT while contouring is active", cause "#CONTOUR MODE [DIST_SOFT] under G261 of another mode", hint "write G260 before #CONTOUR MODE and G261 after it";
    ListKeyUnknown = Vendor 1001119: Warning None 1 2, "unknown element in a parameter list", cause "element ignored", hint "kontur explain KEY describes a key; --strict refuses unknown ones";
    ListNumber = Vendor 1001138: Warning None 1 2, "bad number format or value outside the type's range", cause "value limited to min/max, or 0 if not a number; loading continues", hint "numbers are written 10, -10, 1.5 or 0x101";
    InvalidCharacter = Kontur 1 "K-CHAR": Error ProgramAbort 3 0, "invalid character", hint "characters outside the dialect are allowed only in comments and strings";
    Syntax = Kontur 2 "K-SYNTAX": Error ProgramAbort 3 0, "block does not parse", hint "kontur explain shows how words and commands are written";
    NoEnd = Kontur 3 "K-NOEND": Warning None 1 0, "no M02/M30/M29 before the end of the file", hint "write M30";
    TextBehindEnd = Kontur 4 "K-TRAILING": Note None 1 0, "text after the end of the program", cause "M30, then more blocks", hint "move M30 to the end, or delete what comes after it";
    Nesting = Kontur 6 "K-NESTING": Error ProgramAbort 3 0, "nesting of calls, or the structure of a program, beyond the limit", hint "does a subroutine call itself? A parameter can hold a part of a long expression";
    DuplicateKey = Kontur 7 "K-DUPKEY": Error ProgramAbort 3 0, "key twice in one command (no vendor ID known)", hint "leave one of the two out";
    DuplicateGroup = Kontur 8 "K-DUPGROUP": Error ProgramAbort 3 0, "two functions of one group (no vendor ID known)", hint "write the second one in a separate block";
    Range = Kontur 9 "K-RANGE": Error ProgramAbort 3 0, "value outside the range of a command key", hint "write a value within the range";
    RadiusTooSmall = Kontur 10 "K-RADIUS-TOO-SMALL": Error ProgramAbort 3 0, "R smaller than half the chord", hint "check the end point and R; the smallest arc is the half circle over the chord";
    Sqrt = Kontur 11 "K-SQRT": Error ProgramAbort 3 0, "root of a negative number", hint "test the value with $IF first";
    Undefined = Kontur 12 "K-UNDEF": Error ProgramAbort 3 0, "variable or parameter not defined", hint "assign a value before it is read";
    NoFile = Kontur 13 "K-NOFILE": Error ProgramAbort 3 0, "file cannot be opened", hint "check the name; --path adds folders";
    NoSubroutine = Kontur 14 "K-NOSUB": Error ProgramAbort 3 0, "subroutine not found", hint "local subroutines begin with %L NAME";
    Label = Kontur 15 "K-LABEL": Error ProgramAbort 3 0, "jump label not found", hint "labels are N50: and [NAME] at the beginning of a block of the same program";
    LabelInto = Kontur 16 "K-LABEL-INTO": Error ProgramAbort 3 0, "jump into a control block", hint "jumps lead out of control blocks, not into them";
    Endless = Kontur 17 "K-ENDLESS": Error ProgramAbort 3 0, "iteration limit reached", hint "does a condition never become true?";
    Wait = Kontur 18 "K-WAIT": Warning None 1 0, "wait condition that nothing simulated can fulfil", hint "nothing outside the program is simulated";
    Unsupported = Kontur 19 "K-UNSUPPORTED": Error ProgramAbort 3 0, "legal command that is not simulated", hint "it would change the path: program the motion without it";
    FeedforwardLimit = Kontur 20 "K-G136-LIMIT": Warning None 1 0, "weight above 100 %, limited", hint "100 % feeds the whole value forward";
    FeedforwardNegative = Kontur 21 "K-G136-NEGATIVE": Error ProgramAbort 3 0, "negative weight", hint "weights are 0 to 100 %";
    FeedforwardSwitchedMoving = Kontur 22 "K-FF-SWITCH-MOVING": Warning None 1 0, "feedforward switched or weighted while an axis moves", cause "the path moves, an axis moves alone, or its filters still output motion", hint "switch it at standstill, with filters after #FLUSH WAIT: the setpoint of the controller jumps by the lag";
    FeedforwardConflict = Kontur 23 "K-FF-CONFLICT": Warning None 1 0, "default_active and global_disable both set; output bit without activation bit", hint "choose one of the two";
    FeedforwardLoad = Kontur 24 "K-FF-LOAD": Warning None 1 0, "torque at a_max more than 10 × reference torque: check the unit of `load`", hint "check the unit of the load";
    IpcRange = Kontur 25 "K-IPC-RANGE": Error ProgramAbort 3 0, "IPC order, f0, Q, damping or mode out of range: IPC off for the axis", hint "write a value within the range";
    IpcNoLimit = Kontur 26 "K-IPC-NOLIMIT": Warning None 1 0, "IPC enabled with v_add_max_fact 0: no effect", hint "write v_add_max_fact, the largest additive speed";
    IpcWeight = Kontur 27 "K-IPC-WEIGHT": Warning None 1 0, "weight above 7.0, limited", hint "write a weight up to 7.0";
    ListDuplicate = Kontur 28 "K-LIST-DUP": Warning None 1 0, "key twice in a list, last wins", hint "leave one of the two out";
    ListIndex = Kontur 29 "K-LIST-INDEX": Warning None 1 0, "empty index read as 0", hint "write the index: [0]";
    ListString = Kontur 30 "K-LIST-STRING": Warning None 1 0, "second word after an unquoted string dropped", hint "put a text with blanks in double quotes, start a comment with (";
    ListLink = Kontur 31 "K-LIST-LINK": Error ProgramAbort 3 0, "log_achs_nr without axis list, or number used twice", hint "every axis of the channel list needs one axis list with its kopf.achs_nr";
    SimulationSampling = Kontur 32 "K-SIMU-SAMPLE": Warning None 1 0, "sampling time of the simulated drive differs from the cycle", hint "write the cycle time, or leave the sampling time out";
    FilterRange = Kontur 33 "K-FILTER-RANGE": Error ProgramAbort 3 0, "filter order, Q, share or frequency out of range, filter off", hint "kontur explain '#FILTER' lists the ranges of its keys";
    GuardRange = Kontur 34 "K-VIB-RANGE": Error ProgramAbort 3 0, "Vibration Guard FREQ, DAMPING, AX_DEV or ACC_FACT out of range", hint "kontur explain '#VIB GUARD' lists the ranges of its keys";
    Unstable = Kontur 35 "K-UNSTABLE": Error AllStop 6 0, "simulated plant diverged (lag beyond ±10 × slep_max or not finite), run stopped", hint "lower the gain kv or the weights of Improved Position Control", parameter "P-AXIS-00099";
    FilterOrderFixed = Kontur 36 "K-FILTER-ORDER": Warning None 1 2, "order of a filter whose type has a fixed one, corrected", cause "P-AXIS-00140: PT1 has the order 1, PT2 the order 2", hint "leave the order out";
    FilterAllPass = Kontur 37 "K-FILTER-ALLPASS": Warning None 1 2, "all-pass that is not BESSEL", cause "only BESSEL gives a flat group delay", hint "only the prototype BESSEL gives an all-pass with flat delay";
    FilterConstantPart = Kontur 38 "K-FILTER-CONSTANT": Warning None 1 2, "high-pass or band-pass on a position", cause "the filter removes the constant part of the position", hint "it removes the constant part: the axis only follows motion relative to its first position";
    FilterHscPrototype = Kontur 39 "K-FILTER-HSC": Warning None 1 2, "HSC type without the prototype HSC, or the reverse, filter off", cause "P-AXIS-00153, P-AXIS-00204", hint "prototype HSC goes with type HSC_MEAN (8) or 12";
    FilterHscSpindle = Kontur 40 "K-FILTER-HSC-SPINDLE": Warning None 1 2, "HSC filter of a spindle, off", cause "HSC filters exist for path axes only", hint "use another filter for the spindle";
    FilterHscInterface = Kontur 41 "K-FILTER-HSC-ADD": Warning None 1 2, "HSC filter of the additional interface, off", cause "P-AXIS-00738: the additional interface has standard filters only", hint "the additional interface has the types LOWPASS to PT1, PT2 and TIME_DELAY";
    SetpointWarning = Kontur 60 "K-SETPOINT-WARNING": Warning None 1 11, "acceleration or jerk of the set position above the warning level", cause "P-AXIS-00441, P-AXIS-00443; the vendor's ID is not known", hint "lower the dynamics, or raise the threshold if a filter overshoots";
    SetpointError = Kontur 61 "K-SETPOINT-ERROR": Error FeedHold 6 11, "acceleration or jerk of the set position above the limit", cause "P-AXIS-00442, P-AXIS-00444; the vendor's ID is not known", hint "lower the dynamics, or raise the threshold if a filter overshoots";
    TorqueScale = Kontur 62 "K-FF-SCALE": Warning None 1 2, "reference torque or torque scale 0, no torque output", cause "P-AXIS-00392, P-AXIS-00325", hint "write P-AXIS-00392 and P-AXIS-00325";
    IpcOverlap = Kontur 63 "K-IPC-OVERLAP": Warning None 1 2, "pass bands of two stages of Improved Position Control overlap", cause "their dampings influence each other", hint "raise the quality or move the frequencies apart";
    ResolutionWithoutEffect = Kontur 64 "K-FF-RESOLUTION": Warning None 1 2, "encoder resolution in addition to a feed constant, without effect", cause "P-AXIS-00233, P-AXIS-00234 are 1 where P-AXIS-00362, P-AXIS-00363 are used", hint "set P-AXIS-00233 and P-AXIS-00234 to 1";
    IncrementsWithoutEffect = Kontur 65 "K-FF-INCREMENTS": Warning None 1 2, "increments per revolution without a feed constant, without effect", cause "P-AXIS-00092 needs P-AXIS-00362, P-AXIS-00363 and P-AXIS-00511, P-AXIS-00512", hint "write P-AXIS-00362, P-AXIS-00363 and P-AXIS-00511, P-AXIS-00512";
    IpcNoInput = Kontur 66 "K-IPC-LOOP": Warning None 1 2, "Improved Position Control without a way into the position loop, off for the axis", cause "a drive that closes the loop needs the additive velocity in its process data; P-AXIS-00320", hint "name S_0_0037 in antr.sercos.mdt[i].nc_ref, or antr.operation_mode CNC_POSITION_CONTROL";
    ListRange = Kontur 70 "K-LIST-RANGE": Warning None 1 2, "list parameter outside its range, corrected", cause "the vendor's ID for this parameter is not known", hint "kontur explain gives the range of the parameter";
    ListEntry = Kontur 71 "K-LIST-ENTRY": Warning None 1 2, "line of a list that is not an entry, ignored", cause "no key or no value", hint "an entry is a key, at least one blank and a value; comments start with #";
    ListEnd = Kontur 72 "K-LIST-END": Note None 1 2, "end mark in a list, the rest is not read", cause "a line with END or Ende only";
    Setting = Kontur 73 "K-SETTING": Error JobAbort 3 0, "setting names no axis, parameter or value", cause "--set TARGET.key=value", hint "write AXIS.key=value, channel.key=value or kontur.key=value";
    ListCount = Kontur 74 "K-LIST-COUNT": Warning None 1 2, "more entries than the list's own count, ignored", cause "zahl_mds, achs_anzahl, spdl_anzahl", hint "raise the count, or remove the entries", parameter "P-STUP-00014";
    ListNoEffect = Kontur 75 "K-LIST-NOEFFECT": Warning None 1 2, "list value without effect", cause "kontur does not simulate what the value switches on, or the program overrides it: the text says which", hint "vorsteuer.default_active (P-AXIS-00255) in the axis list keeps feedforward on";
    InputFile = Kontur 76 "K-INPUT": Error JobAbort 3 0, "file of real-time inputs wrong or not readable", cause "--input FILE: CSV with the columns t_s and signals, times rising";
    InputNoEffect = Kontur 77 "K-INPUT-NOEFFECT": Warning None 1 0, "real-time input without effect", cause "the message says what is off in the machine";
    ListAdvice = Kontur 78 "K-LIST-ADVICE": Note None 1 2, "list value outside what the documents recommend", cause "a recommendation: nothing is changed";
    PositionLoop = Kontur 79 "K-LOOP": Note None 1 2, "position loop not simulated as the list says", cause "P-AXIS-00320: loop in the drive, or none", hint "set kv (P-AXIS-00099) to the gain of the loop it replaces";
    AxDevNotKept = Kontur 80 "K-AX-DEV": Error ProgramAbort 3 0, "tolerance AX_DEV could not be kept", cause "neither a lower speed nor a stop keeps it", hint "give the axes the same filter, or allow more AX_DEV";
    Message = Kontur 81 "K-MSG": Note None 1 1, "message of the program (#MSG)";
    Internal = Kontur 82 "K-INTERNAL": Error AllStop 8 0, "internal error of kontur", hint "this is a fault in kontur itself: please report it with the program and the machine lists";
    Held = Kontur 83 "K-HELD": Error ProgramAbort 3 0, "path held indefinitely by feedhold or override 0, run stopped", cause "no later time stamp of the inputs releases it";
    Ignored = Kontur 100 "K-IGNORED": Warning None 1 1, "word without effect here, ignored", cause "it has no influence on set positions, or its function is not simulated", hint "the result is the same without it";
    Dialect = Kontur 101 "K-DIALECT": Warning None 1 1, "word with another meaning in other dialects", cause "e.g. G21 mirrors here; metric is G71", hint "was the file written for another control?";
    GuardExchanged = Kontur 102 "K-GUARD-EXCHANGED": Warning None 1 1, "axis exchange switched the Vibration Guard of the program off", cause "program it again", hint "program #VIB GUARD ON again after it";
    GuardStored = Kontur 103 "K-GUARD-STORED": Note None 1 1, "values of #VIB GUARD stored while it is off", cause "they act with the next #VIB GUARD ON";
    ListFirAndGuard = Kontur 104 "K-LIST-FIR-GUARD": Error ProgramAbort 3 1, "FIR filter and Vibration Guard active in one axis", cause "P-AXIS-00586 and P-AXIS-00588; the Vibration Guard of the axis is off", hint "leave one of the two out of the list";
    FilterWithListGuard = Kontur 105 "K-FILTER-LIST-GUARD": Error ProgramAbort 3 1, "#FILTER while a list activates the Vibration Guard", cause "P-AXIS-00588", hint "set vib_guard.active to 0, or use #VIB GUARD";
    GuardWithListFilter = Kontur 106 "K-GUARD-LIST-FILTER": Error ProgramAbort 3 1, "#VIB GUARD while a list configures a filter type", cause "P-AXIS-00586, P-AXIS-00153", hint "leave the filter type out of the list, or use #FILTER";
    AccFactIgnored = Kontur 107 "K-ACC-FACT": Warning None 1 1, "ACC_FACT without effect", cause "it needs a valid P-AXIS-00013", hint "write getriebe[i].dynamik.a_trans_weight (P-AXIS-00013)", parameter "P-AXIS-00013";
    SpindleFeedforward = Kontur 108 "K-SPINDLE-FF": Error ProgramAbort 3 1, "feedforward together with other commands of a spindle", cause "S[G135 M3 REV1000]", hint "write S[G135] in a separate bracket";
    Odd = Kontur 109 "K-ODD": Note None 1 1, "legal but unusual, worth a look", hint "check whether this is intended";
    ExternalCreated = Kontur 110 "K-EXTERNAL": Warning None 1 1, "external variable created by its first write", cause "V.E. variables are configured with --external", hint "is the name right?";
    Fallback = Kontur 111 "K-FALLBACK": Warning None 1 1, "function replaced by a simpler one", cause "the message says which", hint "the message states what the path does instead";
    UnequalKernels = Kontur 112 "K-ASYNCHRONOUS": Warning None 1 1, "axes of one group are shaped with different delays", cause "settings of filters or Vibration Guard differ", hint "give all axes of the path the same settings";
    NoTool = Kontur 114 "K-NO-TOOL": Warning None 1 1, "tool data missing", cause "D without data: length and radius are 0", hint "V.G.WZ[n].L and V.G.WZ[n].R set length and radius";
    Compensation = Kontur 115 "K-COMPENSATION": Error ProgramAbort 3 1, "tool radius compensation not possible", cause "contour too tight for the tool, or a word that does not go with it", hint "use a smaller tool, or open the contour";
    TooMany = Kontur 116 "K-TOO-MANY": Note None 1 1, "more errors than are reported";
    ArcCentre = Kontur 117 "K-ARC-CENTRE": Error ProgramAbort 3 1, "start, end and centre of an arc do not fit", cause "G165; P-CHAN-00059, P-CHAN-00060", hint "G161 makes I, J, K absolute, G162 relative to the start point", parameter "P-CHAN-00059";
    Unreached = Kontur 118 "K-UNREACHED": Warning None 3 1, "syntax error in a part of the program that does not run", cause "branch not taken, block jumped over, subroutine not called";
    Bottleneck = Kontur 119 "K-BOTTLENECK": Warning None 3 1, "a compensated tool cuts its own contour at a bottleneck", cause "gap narrower than the tool, loop over several blocks";
    ForeignProgram = Kontur 120 "K-FOREIGN": Error ProgramAbort 3 0, "word of another control's language", cause "#<name>, #100, o100 sub, G5.2, BEGIN PGM", hint "write the program out again with a post-processor for ISG or TwinCAT; parameters are P1 and V.P.NAME here";
    MacroBracket = Kontur 121 "K-MACRO-BRACKET": Error ProgramAbort 3 1, "half a pair of brackets in a macro (no vendor ID known)", cause "\"A\" = \"COS[\"", hint "the text of a macro holds whole levels of brackets: \"A\" = \"COS[90]\"";
    ThreadSpeed = Kontur 122 "K-THREAD-SPEED": Error ProgramAbort 3 1, "thread faster than the axes (no vendor ID known)", cause "pitch times spindle speed above P-AXIS-00212", hint "lower the spindle speed";
    SpindleTurns = Kontur 123 "K-SPINDLE-TURNS": Error ProgramAbort 3 1, "tapping with a turning spindle (no vendor ID known)", cause "M03 before G63, or before or in the block of G331", hint "stop the spindle with M05, or position it with M19, in an earlier block";
    ThreadPitch = Kontur 124 "K-THREAD-PITCH": Error ProgramAbort 3 1, "thread without a pitch (no vendor ID known)", cause "G33 Z-50 without K", hint "I, J, K are the pitches of X, Y, Z in mm/rev; G33 has no sign";
    ArcPoints = Kontur 126 "K-ARC-POINTS": Error ProgramAbort 3 1, "three points of G303 that define no arc (no vendor ID known)", cause "points on a line, or the same point twice", hint "I, J, K lie between start and target, off the line between them";
    ContourLineMissed = Kontur 127 "K-CONTOUR-LINE": Error ProgramAbort 3 1, "end of a contour line that cannot be reached at its angle (no vendor ID known)", cause "#ANG=90 X20, or the other direction", hint "the angle counts from the first main axis of the plane, counter-clockwise";
    Standstill = Kontur 130 "K-STANDSTILL": Error ProgramAbort 3 11, "an axis will never arrive where the program waits for it", cause "its loop rests or oscillates outside the window, and no remaining input can move it", hint "raise the window or the gain kv, or take the force away";
    SpindleLimit = Kontur 131 "K-SPINDLE-LIMIT": Warning None 1 1, "spindle speed above the limit of the spindle, limited", cause "S word or REV above P-AXIS-00212", hint "the limit is getriebe[0].dynamik.vb_max of the spindle", parameter "P-AXIS-00212";
    ThreadBroken = Kontur 132 "K-THREAD-BROKEN": Warning None 1 1, "thread whose pitch is not kept", cause "feedhold or override during G33, also a programmed one", hint "#TURN [THREAD_CUT_IGNORE_OV=1] or G166 keep the override out of threads; give a feedhold another time", parameter "P-CHAN-00836";
    NoProbeSignal = Kontur 133 "K-NO-SIGNAL": Error ProgramAbort 3 1, "measuring run without a signal of the probe (no vendor ID known)", cause "type 2, or P-CHAN-00176 or ERR_NO_SIGNAL=1 with the others", hint "--input gives the signal: `probe` at a time, `X_probe_mm` at a position of an axis", parameter "P-CHAN-00176";
    NotMeasured = Kontur 134 "K-NOT-MEASURED": Error ProgramAbort 3 1, "measuring offset of an axis that has not been measured (no vendor ID known)", cause "G101 without a signal in a G100 before it", hint "V.A.MERF.X shows whether the probe signalled";
    MeasuringWay = Kontur 135 "K-MEASURING-WAY": Error ProgramAbort 3 1, "measuring run without travel (no vendor ID known)", cause "G100 X10 where the axis is at 10", hint "the target must lie beyond the surface to be measured";
    SlaveProgrammed = Kontur 136 "K-SLAVE": Error ProgramAbort 3 1, "motion of an axis that follows a master (no vendor ID known)", cause "C10 after #ENABLE AX LINK [1] with C=X", hint "move the master, or write #DISABLE AX LINK before it";
    CouplingGroupUndefined = Kontur 137 "K-NO-GROUP": Error ProgramAbort 3 1, "coupling group that is not defined (no vendor ID known)", cause "#ENABLE AX LINK [2] without #SET AX LINK [2, ..]", hint "write #SET AX LINK [group, slave=master] before it; group 0, that of the channel list, is not read";
    WearLimited = Kontur 138 "K-WEAR-LIMITED": Warning None 1 1, "wear from outside beyond what the tool allows, limited", cause "wear_mm of --input above P-TOOL-00031", hint "raise wz[i].grinding_max_infeed of the tool list", parameter "P-TOOL-00031";
    PathAccelerationTiny = Kontur 139 "K-VECTOR-UNIT": Warning None 1 1, "acceleration of #VECTOR LIMIT below 10 mm/s2", cause "ACC, DEC and RADIAL_ACC count in mm/min2 by default (P-CHAN-00351)", hint "1800000 mm/min2 are 500 mm/s2; vector.acc_dec_unit MM_S2 makes the unit mm/s2", parameter "P-CHAN-00351";
    ProjectRead = Kontur 140 "K-PROJECT": Note None 1 2, "lists taken out of a TwinCAT project", cause "-m names a .tsproj, an .xti, or a folder with them";
    ProjectWrong = Kontur 141 "K-PROJECT-WRONG": Error JobAbort 3 0, "TwinCAT project that is not XML or contains no CNC", cause "-m names a .tsproj, an .xti, or a folder with them", hint "name the project that has the axes and the channel of the CNC, or a folder with its exported .xti files";
    OverrideLimited = Kontur 142 "K-OVERRIDE": Warning None 1 0, "override above the largest one of the channel", cause "P-CHAN-00056, by default 100 %; kontur limits only where the channel list gives it", hint "write max_vb_override in the channel list, in 0.1 %: 1500 allows 150 %", parameter "P-CHAN-00056";
    OscillationEnded = Kontur 143 "K-OSC-ENDED": Warning None 1 0, "a block that needs all axes at rest ends an oscillation", cause "#FLUSH WAIT, #VIB GUARD, #FILTER, #WAIT FOR, an axis exchange or #GET CMDPOS while an axis oscillates", hint "move it before X[OSC ON ..], or program X[OSC ON ..] again after it";
    MacroControl = Kontur 144 "K-MACRO-CONTROL": Error ProgramAbort 3 1, "control statement in a macro (no vendor ID known)", cause "\"M\" = \"$BREAK\"; #IF, #ELSE, #COMMENT BEGIN or % from a macro", hint "write the statement out, only its condition may be a macro: $IF \"A\" > 1";
    Unpaired = Kontur 145 "K-UNPAIRED": Error ProgramAbort 3 1, "#COMMENT BEGIN without #COMMENT END, or the reverse (no vendor ID known)", cause "a #COMMENT BEGIN hides everything up to #COMMENT END; comments do not nest", hint "write the missing one; an end without a beginning is left out";
    CornerFaster = Kontur 146 "K-CORNER-FASTER": Note None 1 0, "corner not rounded: the curve would take longer than the corner", cause "a small PATH_DEV or corner distance at a sharp corner, or short blocks, at a high feed", hint "a larger tolerance or a lower feed makes the curve faster, with #CONTOUR MODE also CHECK_JERK=0";
}
