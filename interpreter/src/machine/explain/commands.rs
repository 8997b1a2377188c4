//! Commands and G functions, one row each.

use super::{Explanation, Kind};

/// One command.
struct Command {
    /// Names it is asked for by, the first one is printed.
    names: &'static [&'static str],
    syntax: &'static str,
    meaning: &'static str,
    /// Keys with range and default.
    keys: &'static str,
    note: &'static str,
    example: &'static str,
    related: &'static [&'static str],
}

/// Reads a row as a table line.
const fn row(
    names: &'static [&'static str],
    syntax: &'static str,
    meaning: &'static str,
    keys: &'static str,
    note: &'static str,
    example: &'static str,
    related: &'static [&'static str],
) -> Command {
    Command { names, syntax, meaning, keys, note, example, related }
}

/// Source: TF5200 programming manual, TF5200 feedforward control, TF5200 FIR filter, TF5250 Vibration Guard.
#[rustfmt::skip]
const COMMANDS: &[Command] = &[
    row(&["#VIB GUARD"], "#VIB GUARD [ON|OFF] [MODE=.. FREQ=.. DAMPING=.. AX_DEV=.. ACC_FACT=..]",
        "shapes the set position of all axes of the channel so that one natural frequency of the machine is not excited; modal",
        "MODE 1..4, default 1 (list vib_guard.mode); FREQ >= 1 Hz, default 30 (vib_guard.freq); DAMPING 0..1, default 0.1 (vib_guard.damping); AX_DEV >= 0 mm, default 0 = no tolerance monitoring (no list key); ACC_FACT 1..10, default 1 (no list key); ON from program start: vib_guard.active",
        "independent of the FIR filter (#FILTER), which smooths a broad band: the two may not stand in one program (22060). AX_DEV missing in a command switches the tolerance monitoring off again, the other keys keep their last value. Without ON or OFF the values are stored",
        "#VIB GUARD ON [MODE=2 FREQ=40 AX_DEV=0.01]", &["22060", "22062", "50820", "P-AXIS-00588", "P-AXIS-00571", "P-AXIS-00589", "P-AXIS-00568", "P-AXIS-00013"]),
    row(&["#FILTER"], "#FILTER [ON|OFF] [ORDER=.. ORDER_TIME=.. SHARE=.. AX_DEV=.. FCUT=.. ACC_FACT=.. QUALITY=..]   #FILTER ON|OFF [HSC]",
        "switches the FIR filters of all axes of the channel; they smooth a broad band. With [HSC]: the older HSC filter prepared as filter[0] of the axis list; modal",
        "ORDER 0..200; ORDER_TIME in us; SHARE 0..100 %, default 100; AX_DEV >= 0 mm, default 0 = no monitoring; FCUT >= 1 Hz, default 30; ACC_FACT 1..10, default 1; QUALITY above 0 to 1, default 1",
        "needs a filter type in the axis list (filter_fir.type). Independent of the Vibration Guard (#VIB GUARD): not both in one program (22060). FIR filters are recommended instead of HSC filters from V3.1.3075.02 on",
        "#FILTER ON [ORDER=20 AX_DEV=0.001]", &["22060", "50989", "P-AXIS-00586", "P-AXIS-00587", "P-AXIS-00573", "#VIB GUARD"]),
    row(&["#SLOPE"], "#SLOPE [TYPE=STEP|TRAPEZ|SIN2|HSC NO_OPT=0|1]   #SLOPE DEFAULT",
        "shape of the acceleration; modal, reset at program start",
        "TYPE default prog_start.slope.profile; NO_OPT default 1; 0 matters with constant ramp times (P-CHAN-00349) alone: there the profile of each run of blocks is planned by itself, else across blocks",
        "", "#SLOPE [TYPE=SIN2]", &["21629", "P-CHAN-00071", "P-CHAN-00349"]),
    row(&["#SET SLOPE PROFIL"], "#SET SLOPE PROFIL [n]", "older form of #SLOPE: 0 STEP, 1 TRAPEZ, 2 SIN2, 3 HSC", "", "", "#SET SLOPE PROFIL [1]", &["#SLOPE", "P-CHAN-00071"]),
    row(&["#CONTOUR MODE"], "#CONTOUR MODE [ON|OFF] [DEV|DIST|DIST_SOFT|DIST_MASTER|POS|PTP keys]",
        "how corners are rounded by polynomials; ON also switches contouring on (G261), OFF off (G260)",
        "DEV: PATH_DEV, default 1 mm; TRACK_DEV deg, 0; DIST: PRE_DIST and POST_DIST, default 1 mm; POS: an interim point X Y Z besides (X2.7 or X=2.7); PTP: PATH_DEV, PATH_DIST; all: RELEVANT_PATH mm and RELEVANT_TRACK deg, 0, shorter blocks are skipped; REMAIN_PART 0..100 %, 0, part of a block that stays; MAX_ANGLE 0..180 deg; CONST_VEL; CHECK_JERK 0..3",
        "program start: DEV with PATH_DEV 1; a key that is not written keeps its value. DIST_SOFT and DIST_MASTER are rounded as PTP (K-0111)", "#CONTOUR MODE [DEV PATH_DEV=0.05]", &["G261", "120129", "120206", "120216", "P-CHAN-00439"]),
    row(&["#HSC"], "#HSC [ON|OFF] [BSPLINE keys]   #HSC [ON|OFF] [OPMODE=1 CONTERROR=..]", "puts a B-spline through short blocks; OPMODE=1 rounds corners within CONTERROR",
        "PATH_DEV default 0.2 mm; TRACK_DEV default 5 deg; 0: not monitored; MAX_PATH_LENGTH mm and MAX_ANGLE deg: longer blocks and sharper corners stay; AUTO_OFF_PATH, AUTO_OFF_TRACK, AUTO_OFF_G00: ends the spline; noise of rounded coordinates is taken out first, a tenth of the tolerances and 3 um at most; CONTERROR default 0.1 mm", "BSPLINE is the first key; MERGE has no effect", "#HSC ON [BSPLINE PATH_DEV=0.05]", &["120393", "120396"]),
    row(&["#VECTOR LIMIT"], "#VECTOR LIMIT ON [VEL=.. ACC=.. DEC=.. JERK=.. RADIAL_ACC=.. RADIAL_JERK=.. TRANS_ACC=.. FEED RAPID]   #VECTOR LIMIT ON ALL   #VECTOR LIMIT OFF",
        "limits speed and acceleration along the path", "a key without value takes the configured limit; FEED, RAPID: for these blocks alone", "", "#VECTOR LIMIT ON [ACC=2000]", &["P-CHAN-00002", "P-CHAN-00090", "P-CHAN-00208", "P-CHAN-00361", "P-CHAN-00351"]),
    row(&["#TRANSVELMIN"], "#TRANSVELMIN ON|OFF", "least speed at block transitions", "", "", "#TRANSVELMIN ON", &["P-AXIS-00013"]),
    row(&["#OVERRIDE"], "#OVERRIDE [FEED_FACT=.. RAPID_FACT=..]", "multiplies F and the rapid speed", "FEED_FACT, RAPID_FACT 0.1..200 %", "", "#OVERRIDE [FEED_FACT=50]", &["P-CHAN-00066", "P-CHAN-00181", "G166"]),
    row(&["INDP_SYN", "INDP_ASYN"], "X[INDP_SYN|INDP_ASYN G90|G91 G00|G01 FEED=..|TIME=..|FEED_MAX_WEIGHT=.. POS=.. SLOPE_TYPE=..]",
        "moves one axis beside the path on a profile of its own; with INDP_SYN the next block begins when it has arrived, with INDP_ASYN it goes on over several blocks",
        "FEED in the unit of F; TIME in s from rest to rest; FEED_MAX_WEIGHT above 0 to 100 % of P-AXIS-00212; SLOPE_TYPE STEP, TRAPEZ, SIN2, default P-CHAN-00071",
        "no offsets, no weights of G130 to G133, no override. A path that moves the axis waits for it", "X[INDP_ASYN G90 G01 FEED=1000 POS=50]", &["21068", "#WAIT", "P-AXIS-00212", "P-CHAN-00071"]),
    row(&["#WAIT"], "#WAIT INDP [X, Y]   #WAIT INDP ALL   #WAIT FOR condition", "the path stops until these independent axes have arrived; of conditions: tested once", "", "", "#WAIT INDP [X]", &["INDP_ASYN", "K-0018"]),
    row(&["#TIME"], "#TIME t", "dwell of t seconds, as G04", "", "", "#TIME 2.5", &["G04", "20752"]),
    row(&["#FLUSH"], "#FLUSH [CONTINUE|WAIT]", "stops at the end of the block before it; CONTINUE only if no more blocks are known", "", "", "#FLUSH WAIT", &[]),
    row(&["#CHANNEL INIT"], "#CHANNEL INIT [CMDPOS|ACTPOS]", "the programmed position becomes the command or actual position", "", "", "#CHANNEL INIT [CMDPOS]", &[]),
    row(&["#CALL AX", "#PUT AX", "#SET AX"], "#CALL AX [name,number,index]   #PUT AX [name]   #SET AX [..]",
        "axis exchange: takes axes into the channel or gives them back", "", "switches a Vibration Guard that the program has switched on off, and sets the weights of G136 of these axes to 100 %", "#CALL AX [X,1,0]", &["20312", "21251", "21372", "#VIB GUARD"]),
    row(&["#MSG"], "#MSG [\"text\", values]", "message of the program", "formats %s %S %d %D %f %F", "", "#MSG [\"part %d done\", P1]", &["21232", "P-CHAN-00518"]),
    row(&["#ERROR"], "#ERROR [ID=.. RC=..]", "message of the user with an ID of 1 to 1000", "RC 0 warning, 2 error (the program aborts), 7 fatal", "", "#ERROR [ID=455 RC=2]", &[]),
    row(&["G00", "G0"], "G00 X.. Y..", "straight line at rapid: at least one axis at its rapid speed", "", "", "G00 X10 Y20", &["P-AXIS-00209", "P-AXIS-00004", "P-AXIS-00200", "G129"]),
    row(&["G01", "G1"], "G01 X.. F..", "straight line at feed F", "", "without any F: 20008", "G01 X10 F2000", &["20008", "P-CHAN-00099", "P-CHAN-00108"]),
    row(&["G02", "G03", "G2", "G3"], "G02 X.. Y.. I.. J..   G02 X.. Y.. R..", "arc in the plane, clockwise (G02) or counter-clockwise (G03)", "", "full circles need the centre, not R (20034)", "G02 X10 Y0 I5 J0 F1000", &["20034", "20036", "21024", "21758", "G161", "G164", "P-CHAN-00059", "P-CHAN-00171"]),
    row(&["G04", "G4"], "G04 t   G04 P.. X..   G04 S..", "dwell in seconds, or in revolutions of the main spindle", "", "", "G04 2.5", &["20752", "20013", "#TIME"]),
    row(&["G17", "G18", "G19"], "G17", "plane of arcs: first and second, third and first, second and third main axis", "", "", "G17", &[]),
    row(&["G40", "G41", "G42"], "G41 X.. Y..", "tool radius compensation off, left of the contour, right of it", "", "the first line leads to the parallel; outer corners by G25 or G26; the radius comes from D or V.G.WZ_AKT.R", "G41 X10 Y0 D1", &["G25", "G237", "90008", "90031", "K-0115"]),
    row(&["G25", "G26"], "G26", "outer corners of tool radius compensation: by lines, by arcs", "", "a program starts with G26 here, on the control with G25", "G25", &["G41"]),
    row(&["G139", "G237"], "G237", "tool radius compensation is selected and deselected by a line to the parallel, or perpendicular to the contour", "", "with G237 a contour may begin and end with arcs", "G237", &["G41"]),
    row(&["G98", "G99"], "G98 X..   G99 X..", "negative, positive software limit of an axis until the end of the program", "", "", "G99 X500", &["21897", "P-AXIS-00177", "P-AXIS-00178"]),
    row(&["M06", "M6"], "M06", "tool change: the subroutine that is configured, else a function for the log", "", "#FILE NAME [M6=\"file\"] names another subroutine", "T5 M06", &["P-CHAN-00118"]),
    row(&["G60"], "G60", "exact stop at the end of this block", "", "the next block starts when every axis is in its window", "N10 G01 G60 X10 F1000", &["P-AXIS-00236", "P-AXIS-00532", "70082", "G360"]),
    row(&["G360", "G359"], "G360   G359", "exact stop at every block end on, off; modal", "", "", "G360", &["P-AXIS-00236", "70082"]),
    row(&["G61", "G261", "G260"], "G61   G261   G260", "contouring at this block's end, on, off", "", "", "G261", &["#CONTOUR MODE", "120206"]),
    row(&["G70", "G71"], "G70", "inch, mm for linear axes", "", "tolerance words stay mm under G70 unless P-CHAN-00439 is 1", "G70", &["P-CHAN-00054", "P-CHAN-00439"]),
    row(&["G90", "G91"], "G90", "absolute, incremental coordinates", "", "", "G91", &[]),
    row(&["G93", "G94", "G95", "G194"], "G94 F..", "F is: seconds for the block, feed per minute, feed per revolution, percent of the greatest path feed", "", "each kind keeps its own F", "G94 F2000", &["P-CHAN-00108", "20121"]),
    row(&["G115", "G116", "G117"], "G116", "look-ahead off, every transition is a stop, complete look-ahead", "", "", "G117", &["20151", "P-STUP-00070"]),
    row(&["G127", "G128"], "G127 X..   G128=..", "weight of the maximum speed in percent, per axis or for all", "", "", "G128=50", &["P-AXIS-00212"]),
    row(&["G129"], "G129=..", "percent of the rapid speed", "", "", "G129=50", &["P-AXIS-00209"]),
    row(&["G130", "G131"], "G130 X..   G131=..", "percent of the feed accelerations, per axis or for all", "", "of the list value, not of the weight before; above P-AXIS-00292: 50130", "G131=80", &["50130", "P-AXIS-00292", "P-CHAN-00001"]),
    row(&["G132", "G133"], "G132 X..   G133=..", "percent of the feed ramp times, per axis or for all", "", "not below P-AXIS-00293", "G133=150", &["P-AXIS-00293", "P-CHAN-00073"]),
    row(&["G134"], "G134=..", "percent of the geometric ramp time", "", "", "G134=200", &["P-AXIS-00199"]),
    row(&["G230", "G231"], "G230 X..   G231=..", "percent of the rapid acceleration, per axis or for all", "", "", "G231=80", &["50130", "P-AXIS-00004"]),
    row(&["G233"], "G233=..", "percent of the rapid ramp time", "", "", "G233=150", &["120630", "P-AXIS-00200"]),
    row(&["G135", "G137"], "G135   G137", "feedforward of all axes of the channel on, off; modal, off at program start", "", "weights of G136 stay. A list switches it on for good with vorsteuer.default_active", "G135", &["G136", "P-AXIS-00223", "P-AXIS-00255", "P-AXIS-00256", "K-0022"]),
    row(&["G136"], "G136 X.. Y..", "weights of the feedforward in percent, axis by axis; modal", "0..100 %, 100 at program start; more is limited (K-0020), below 0 refused (K-0021)", "axes that are not named keep their weight; the axis words of the block are weights, not positions. Spindles: S[G135 G136=80]", "G135 G136 X80 Y95", &["G135", "K-0020", "K-0021", "21738", "P-AXIS-00228"]),
    row(&["G161", "G162"], "G161   G162", "I, J, K absolute, relative to the start point", "", "", "G162", &["G02"]),
    row(&["G164", "G165"], "G164   G165", "centre correction of arcs off, on", "", "", "G165", &["21758", "P-CHAN-00059", "P-CHAN-00060", "P-CHAN-00171", "P-CHAN-00172"]),
    row(&["G166"], "G166", "override 100 % for this block, of the program and of the real-time inputs", "", "", "G01 G166 X10", &["#OVERRIDE"]),
    row(&["M02", "M30", "M2"], "M30", "end of the program: it has ended when every axis is in its exact-stop window", "", "the trace goes on until then, or until 70082", "M30", &["K-0003", "70082", "K-0130"]),
    row(&["M00", "M01", "M0", "M1"], "M00", "programmed stop, optional stop: the path stops; here the program goes on at once", "", "", "M00", &[]),
    row(&["M03", "M04", "M05", "M3", "M4", "M5"], "M03 S..   S[M3 REV..]", "spindle clockwise, counter-clockwise, stop", "S, REV in rev/min, limited to P-AXIS-00212 (K-0131)", "the main spindle is that of P-CHAN-00051, addressed by P-CHAN-00053", "S1000 M3", &["M19", "K-0131", "P-CHAN-00051", "P-CHAN-00053"]),
    row(&["M19"], "M19   S[M19 POS=.. REV=..]", "spindle to an angle, in positive direction", "POS in deg, default 0; REV in rev/min, default the S word, without one the limit of the spindle", "monitored like an exact stop, in degrees", "S[M19 POS=90 REV=100]", &["M03", "70082", "P-AXIS-00236", "P-AXIS-00532"]),
    row(&["M17", "M29"], "M17", "end of a subroutine", "", "", "M17", &["K-0003"]),
];

/// Names of all commands.
pub(super) fn names() -> impl Iterator<Item = &'static str> {
    COMMANDS.iter().flat_map(|c| c.names.iter().copied())
}

/// The command with a name; blanks and case do not count, what follows the name is ignored (`#VIB GUARD ON`).
pub(super) fn find(thing: &str) -> Option<Explanation> {
    let words: Vec<String> = thing.split_whitespace().map(str::to_ascii_uppercase).collect();
    let wanted = words.join(" ");
    let wanted = wanted.split('[').next().unwrap_or_default().trim_end();
    let command = COMMANDS.iter().find(|c| {
        c.names.iter().any(|name| {
            wanted == *name || wanted.strip_prefix(name).is_some_and(|rest| rest.starts_with(' '))
        })
    })?;
    let text = |s: &'static str| (!s.is_empty()).then(|| s.to_owned());
    let mut facts = vec![("form", command.syntax.to_owned())];
    facts.extend(text(command.keys).map(|keys| ("keys", keys)));
    Some(Explanation {
        kind: Kind::Command,
        title: command.names.join(", "),
        meaning: command.meaning.to_owned(),
        facts,
        notes: text(command.note).into_iter().collect(),
        example: text(command.example),
        related: command.related.iter().map(|s| (*s).to_owned()).collect(),
    })
}
