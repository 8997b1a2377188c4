//! Words, control statements and the G functions of offsets, frames and insertions.

use super::commands::{Command, row};

/// Source: TF5200 programming manual.
#[rustfmt::skip]
pub(super) const LANGUAGE: &[Command] = &[
    row(&["F"], "F..", "feed: its unit is that of G93, G94, G95 or G194", "G94: mm/min (G70: inch/min), times P-CHAN-00108", "holds until the next one; each feed type keeps its own", "G01 X10 F2000", &["G94", "20008", "P-CHAN-00099", "P-CHAN-00108"]),
    row(&["E"], "E..", "feed at the end of the block", "in the unit of F, with G94 alone, not above F", "", "G01 X10 F2000 E500", &["F", "G94"]),
    row(&["S"], "S..   S[..]", "speed of the main spindle in rev/min; in brackets several words of a spindle", "", "", "M03 S1200", &["M03", "M19", "G96"]),
    row(&["T"], "T..", "tool for the next change", "", "", "T5 M06", &["M06", "D"]),
    row(&["D"], "D..", "tool data: length, radius and offsets of axes; D0 takes them away", "", "the length acts with the next absolute word of its axis", "D1", &["G41", "K-0114", "V.G"]),
    row(&["R"], "G02 X.. Y.. R..", "radius of an arc: above 0 the shorter one, below 0 the longer one; with G301 and G302 see there", "mm (G70: inch)", "", "G02 X10 Y10 R10", &["G02", "20034"]),
    row(&["I", "J", "K"], "G02 X.. Y.. I.. J..", "centre of an arc in X, Y, Z, from its start (G162) or absolute (G161); pitch of threads", "mm (G70: inch)", "", "G02 X20 I10", &["G02", "G161", "G33"]),
    row(&["N"], "N10 ..", "number of a block; N10: is a label for $GOTO", "", "", "N10 G01 X10", &["$GOTO"]),
    row(&["L", "LL", "L CYCLE"], "L name   LL name   L CYCLE [NAME=name @P1=..]", "calls a global subroutine, a local one (%L), or a cycle with parameters", "", "a cycle keeps its G functions and variables for itself (P-CHAN-00210)", "LL DRILL", &["M17", "M29", "P-CHAN-00210"]),
    row(&["G09"], "G09", "braking to a lower feed ends at the end of this block", "", "", "N10 G09 X10", &["G900"]),
    row(&["G08"], "G08", "a higher feed is reached at the start of its block", "", "ignored here (K-0100)", "G08", &["K-0100"]),
    row(&["G20", "G21", "G22", "G23"], "G21", "mirroring off, of the first main axis, of the second, of both", "", "not metric or inch: those are G71 and G70", "G21", &["G70", "G351", "K-0101"]),
    row(&["G351"], "G351 X1 Y-1", "mirroring of the axes named: -1 on, 1 off", "", "", "G351 X-1", &["G20", "20860"]),
    row(&["G53", "G54", "G55", "G56", "G57", "G58", "G59"], "G54", "zero offsets off, groups 1 to 6", "values of the zero-offset list or V.G.NP[i].V.X", "acts with the next absolute word of an axis", "G54", &["G159", "G92", "#SUPPRESS OFFSETS"]),
    row(&["G159"], "G159=n", "zero offset of group n", "", "", "G159=7", &["G54"]),
    row(&["G160"], "G160=n X1 Y1", "zero offset of group n for the axes named", "", "without axes: 20003", "G160=2 X1", &["G54", "20003"]),
    row(&["G68", "G69"], "G68 R.. X.. Y..   G69", "rotation of the contour in the plane on, off", "R: angle in deg; X, Y: centre", "", "G68 R30 X0 Y0", &["#ROTATION", "#CS", "22156"]),
    row(&["G80", "G81", "G82", "G83", "G84", "G85", "G86", "G87", "G88", "G89"], "G81", "calls the subroutine that the channel list names", "", "the words of the block are its parameters", "G81", &["P-CHAN-00160"]),
    row(&["G92"], "G92 X.. Y..", "reference point offset: moves the origin of the axes named", "", "acts with the next absolute word of an axis", "G92 X10 Y20", &["#PSET", "G54"]),
    row(&["G163"], "G163=..", "radius of the arcs that follow, in place of R", "", "", "G163=10", &["G02"]),
    row(&["G66"], "G66", "ends of the blocks within a cycle", "", "runs without its effect (K-0111)", "G66", &["K-0111"]),
    row(&["G333", "G334", "G338", "G339"], "G333   G334=..", "weights of the acceleration and the ramp times of a feedhold", "", "run without their effect (K-0111)", "G334=50", &["K-0111", "P-CHAN-00097"]),
    row(&["G140"], "G140", "contour masking off", "", "G141 is refused", "G140", &["K-0019"]),
    row(&["G200", "G201", "G202"], "G201 #ACHSE [X]", "manual mode beside the program", "", "refused here", "G202", &["K-0019"]),
    row(&["G301", "G302", "#CHR", "#CHF", "#RND", "#FRC"], "G301 I..   G302 I..   #CHR..  #CHF..  #RND..  [#FRC..]", "chamfer or rounding between this motion and the next one in the plane", "I, #CHR: distance of the ends from the corner; #CHF: length of the chamfer; #RND: radius; #FRC: feed within it, in the unit of F", "", "G302 I5 #FRC=300", &["F"]),
    row(&["G900", "G901"], "G900   G901", "braking to a lower feed ends at the end of the faster block, or begins there", "", "no effect with HSC (K-0100)", "G901", &["G09"]),
    row(&["$IF", "$ELSEIF", "$ELSE", "$ENDIF"], "$IF condition .. $ELSEIF condition .. $ELSE .. $ENDIF", "branches", "", "", "$IF V.L.N == 1", &["$SWITCH"]),
    row(&["$SWITCH", "$CASE", "$DEFAULT", "$ENDSWITCH"], "$SWITCH value .. $CASE value .. $BREAK .. $DEFAULT .. $ENDSWITCH", "branches by a value", "", "", "$SWITCH P1", &["$IF"]),
    row(&["$FOR", "$ENDFOR"], "$FOR P1=1, 10, 1 .. $ENDFOR", "loop over a count: start, end, step", "", "", "$FOR P1=0, 4, 1", &["$WHILE", "$BREAK"]),
    row(&["$WHILE", "$ENDWHILE", "$DO", "$ENDDO", "$REPEAT", "$UNTIL"], "$WHILE condition .. $ENDWHILE", "loops with a condition at their head ($WHILE) or their foot ($DO, $REPEAT)", "", "", "$WHILE P1 < 5", &["$FOR", "$BREAK"]),
    row(&["$BREAK", "$CONTINUE"], "$BREAK   $CONTINUE", "leaves a loop, begins its next pass", "", "", "$BREAK", &["$FOR"]),
    row(&["$GOTO"], "$GOTO N10   $GOTO [LABEL]", "continues at a label of the same level", "", "not into a loop (21480)", "$GOTO [END]", &["N", "21480"]),
    row(&["P", "V.P", "V.L", "V.S", "V.E", "V.A", "V.G", "V.CYC"], "P1   V.P.NAME   V.L.NAME   V.A.ABS.X   V.G.WZ[1].R", "variables: numbered parameters, of program (V.P), level (V.L), start (V.S), cycle (V.CYC) and outside (V.E), of axes (V.A) and of the channel (V.G)", "", "#VAR .. #ENDVAR declares V.P, V.L and V.S", "P1 = V.A.ABS.X + 5", &["#VAR", "K-0110"]),
    row(&["SQRT", "SIN", "COS", "TAN", "ASIN", "ACOS", "ATAN", "ABS", "EXP", "LN", "INT", "FRACT", "ROUND", "FLOOR", "CEIL", "MIN", "MAX", "SIGN", "MOD"], "SQRT[..]   SIN[..]   7 MOD 4", "functions of expressions; angles in deg", "", "", "P1 = SQRT[2]", &["P"]),
];
