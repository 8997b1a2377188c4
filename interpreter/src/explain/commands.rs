//! G functions and words in brackets, one row each; the texts of `#` commands are in their own rows.

use super::explanation::{Explanation, Kind};
use super::language::LANGUAGE;
use super::row::{Command, row};
use crate::exec::{commands, unknown_g, unsupported_function};

/// Source: TF5200 programming manual, TF5200 feedforward control, TF5200 FIR filter, TF5250 Vibration Guard.
#[rustfmt::skip]
const COMMANDS: &[Command] = &[
    row(&["INDP_SYN", "INDP_ASYN"], "X[INDP_SYN|INDP_ASYN G90|G91 G00|G01 FEED=..|TIME=..|FEED_MAX_WEIGHT=.. POS=.. SLOPE_TYPE=.. INCL_OFFSETS]",
        "moves one axis independently of the path on its own profile; with INDP_SYN the next block starts when the axis has arrived, with INDP_ASYN the motion continues over several blocks",
        "FEED in the unit of F; TIME in s from rest to rest; FEED_MAX_WEIGHT above 0 to 100 % of P-AXIS-00212; SLOPE_TYPE STEP, TRAPEZ, SIN2, default P-CHAN-00071",
        "offsets apply with INCL_OFFSETS only, weights of G130 to G133 and programmed override do not; override and feedhold of --input do. A path that moves the axis waits for it", "X[INDP_ASYN G90 G01 FEED=1000 POS=50]", &["21068", "#WAIT", "P-AXIS-00212", "P-AXIS-00491", "P-AXIS-00540", "P-CHAN-00071"]),
    row(&["OSC"], "X[OSC ON 1ST_POS=.. 2ND_POS=.. FEED=..|FREQ=..|TIME=..]   X[OSC OFF]",
        "an axis oscillates independently of the path and stops at its second position, at the latest when the program waits for it",
        "1ST_DELT, 2ND_DELT: dwells in s; FREQ in 1/s or TIME in s of an oscillation without its dwells; NBR_OSC: number of oscillations", "offsets apply with INCL_OFFSETS only, the programmed override does not; override and feedhold of --input do", "X[OSC ON 1ST_POS=-10 2ND_POS=10 FEED=1000]", &["INDP_SYN", "50593", "120470", "#WAIT"]),
    row(&["G00", "G0"], "G00 X.. Y..", "straight line in rapid traverse: at least one axis at its rapid speed", "", "", "G00 X10 Y20", &["P-AXIS-00209", "P-AXIS-00004", "P-AXIS-00200", "G129"]),
    row(&["G01", "G1"], "G01 X.. F..", "straight line at feed F", "", "without F: 20008", "G01 X10 F2000", &["20008", "P-CHAN-00099", "P-CHAN-00108"]),
    row(&["G02", "G03", "G2", "G3"], "G02 X.. Y.. I.. J..   G02 X.. Y.. R..", "arc in the plane, clockwise (G02) or counter-clockwise (G03)", "", "full circles require the centre, not R (20034)", "G02 X10 Y0 I5 J0 F1000", &["20034", "20036", "21024", "21758", "G161", "G164", "P-CHAN-00059", "P-CHAN-00171"]),
    row(&["G303"], "G303 X.. Y.. Z.. I.. J.. K..", "arc in space over an interim point", "I, J, K: the interim point in X, Y, Z, absolute under G90, from the start under G91", "the three points must not be collinear", "G303 I30 J75 K15 X60 Y0 Z0 F1000", &["21751", "G02"]),
    row(&["#ANG"], "#ANG=.. X..|Y..   #ANG=.. then #ANG=.. X.. Y..", "straight line given by its angle and one coordinate; two lines given by two angles and their end point", "angle in deg from the first main axis of the plane", "only in its own block", "G01 #ANG=60 X20 F1000", &["21892", "21895", "21904", "21910", "K-0127"]),
    row(&["G04", "G4"], "G04 t   G04 P.. X..   G04 S..", "dwell in seconds, or in revolutions of the main spindle", "", "", "G04 2.5", &["20752", "20013", "#TIME"]),
    row(&["G17", "G18", "G19"], "G17", "plane of arcs: first and second, third and first, second and third main axis", "", "", "G17", &[]),
    row(&["G33"], "G33 Z.. K.. [S.OFFSET=..]", "thread with a turning spindle: the path is synchronised with its zero mark", "I, J, K: pitch in mm/rev for X, Y, Z, without a sign, modal; S.OFFSET: angle in deg at which the thread starts", "waits until the spindle has reached its speed; an override changes the pitch and a feedhold damages the thread (K-0132); #TURN or G166 excludes the override; the pitch differs in the ramps at start and end", "G33 Z-40 K1.5", &["#TURN", "K-0122", "K-0124", "K-0132", "21540"]),
    row(&["G63"], "G63 Z.. F.. S..", "tapping: the spindle turns with the path, S / F turns per mm", "S negative: left-hand thread, or retraction", "the spindle must be stopped first (M05, M19); its limits reduce the path speed", "G63 Z-20 F300 S200", &["G331", "20007", "21000", "K-0123"]),
    row(&["G331", "G332"], "G331 Z.. K.. S..   G332 Z..", "tapping, and retraction with the spindle reversed", "I, J, K: pitch in mm/rev, negative for a left-hand thread; S in rev/min; both also apply to G332", "the spindle must be stopped first (M05, M19); its limits reduce the path speed", "G331 Z-20 K1.5 S200", &["G63", "20007", "K-0123"]),
    row(&["G196"], "G196 S..", "maximum spindle speed of constant cutting speed (G96)", "S in rev/min", "", "G196 S3000", &["G96"]),
    row(&["G96", "G97"], "G96 S..   G97", "constant cutting speed on, off", "S under G96 in m/min, with G97 in rev/min", "computed from the distance of the face turning axis (P-AXIS-00015) to 0; rapid blocks keep the speed; G95 follows the speed in steps of one hundredth", "G96 S100", &["20633", "20634", "20064", "P-AXIS-00015"]),
    row(&["G40", "G41", "G42"], "G41 X.. Y..", "tool radius compensation off, left of the contour, right of it", "", "the first line leads to the parallel path; outside corners by G25 or G26; the radius comes from D or V.G.WZ_AKT.R", "G01 G41 X10 Y0 D1 F1000", &["G05", "G25", "G237", "90008", "90017", "90019", "90031", "90038", "K-0115"]),
    row(&["G05"], "G05 G41 X.. Y..   G05 G40 X.. Y..", "the line that starts or ends tool radius compensation becomes an arc tangential to the parallel path", "", "with G40, G41 or G42, for this block only; the start position determines the direction of the arc", "G01 G05 G41 X10 Y0 D1 F1000", &["G41", "G138", "21316", "K-0115"]),
    row(&["G10", "G11"], "G11", "with tool radius compensation, F is the speed of the tool centre (G10) or, on arcs, of its point of contact with the contour (G11)", "", "arcs inserted by the compensation keep F (K-0111)", "G11", &["G41", "#TANGFEED"]),
    row(&["G12", "G13"], "G13", "corner deceleration off, on: over the last distance of every motion the feed decreases linearly along the path", "distance and feed: #CORNER PARAM", "only with the slope STEP; every end of a feed motion counts as a corner", "G12", &["#CORNER PARAM", "20794", "20795"]),
    row(&["G193", "G293"], "G193 X.. F..", "the feed changes from the previous F word to the F word of the block, linearly along the path (G193) or over time (G293)", "", "only with the slope STEP", "G193 X100 F400", &["20109", "#SLOPE"]),
    row(&["G25", "G26"], "G26", "outside corners of tool radius compensation: by lines, by arcs", "", "a program starts with G25", "G25", &["G41"]),
    row(&["G138", "G139", "G237", "G238", "G239"], "G237", "how tool radius compensation is selected and deselected: by a line to the parallel path (G138, G139), perpendicular to the contour (G237), at the inside corner of a closed contour (G238), by a line and deselected at the current tool position (G239)", "", "with G237 a contour can start and end with arcs; with G238 it can have at most 10,000 blocks", "G237", &["G41", "#TRC", "21317", "21318", "90127"]),
    row(&["G51", "G52"], "G51", "words of the face turning axis are diameters, radii", "", "the axis has the bit 0x40 of P-AXIS-00015; centres and radii of arcs are not diameters", "G52", &["20042", "P-AXIS-00058", "P-AXIS-00059"]),
    row(&["G150", "G151"], "G151", "Akima spline through the points of the following linear blocks off, on", "", "starts at the last point before it; stops, G00 and tool radius compensation are not allowed within it", "G150", &["#SPLINE", "#AKIMA TRANS"]),
    row(&["G167"], "G167 S1000", "spindle override 100 %", "no effect here: external overrides do not act on spindles", "", "G167", &["S"]),
    row(&["#ACHSE"], "G201 #ACHSE [X, Y]", "the axes of G200, G201 or G202 of the same block", "", "20037 without one of them, 20038 for G201 without axes", "G201 #ACHSE [X]", &["20037", "20038", "#MANUAL LIMITS"]),
    row(&["G74"], "G74 X1 Y2", "homing: the axes are treated as homed at their positions", "the numbers give the order", "", "G74 X1 Y2", &["K-0111"]),
    row(&["G100", "G106"], "G100 X.. Y.. F.. [G106]", "measuring run: a straight line that ends where the probe signals; with G106 it continues to its target",
        "", "the signal comes from --input: probe at a time, X_probe_mm at a position of an axis; V.A.MESS.X, V.A.MERF.X, V.A.MOFFS.X contain the measured values", "G100 X10 F500", &["#MEAS", "G101", "G310", "K-0133", "50052", "50059", "P-CHAN-00057", "P-AXIS-00118", "P-AXIS-00215"]),
    row(&["G107", "G108"], "G108   M97 G01 X.. Y.. F..   G107", "edge banding: in the next motion with an M function that is MNE_SNS in P-CHAN-00041 the path stops a distance (V.G.RW) after the probe signal, executes the function and continues; G107 switches it off",
        "", "the signal comes from --input: probe at a time, X_probe_mm at a position of an axis", "G108", &["G100", "K-0133", "20156", "50263", "50398", "50655", "P-AXIS-00098", "P-CHAN-00030", "P-CHAN-00041"]),
    row(&["G310"], "G310 G01 X.. F.. $GOTO[LABEL]", "measuring run of types 5 and 6: after a signal the program continues at the label, from the position of the axes", "", "", "G310 G01 X10 F500", &["G100", "#MEAS", "20956"]),
    row(&["G101", "G102"], "G101 X1 Y1   G102 X1", "adds measuring offsets (measured minus target) times a factor to the offsets, removes them", "", "takes effect with the next absolute word of the axis", "G102 X1", &["G100", "K-0134"]),
    row(&["G112"], "G112 X4   G112 S2", "changes to another gear stage: the parameters getriebe[i] with this number in the list of the axis or spindle",
        "the values are the numbers of the stages (P-AXIS-00135)", "the path stops; a spindle must be at rest; the functions that change the gear itself are M functions of the machine", "G112 S2", &["P-AXIS-00135", "P-AXIS-00079", "3210", "60285"]),
    row(&["G98", "G99"], "G98 X..   G99 X..", "negative, positive software limit of an axis until the end of the program", "", "", "G99 X500", &["21897", "P-AXIS-00177", "P-AXIS-00178"]),
    row(&["M06", "M6"], "M06", "tool change: calls the configured subroutine, otherwise an M function", "", "#FILE NAME [M6=\"file\"] selects another subroutine", "T5 M06", &["P-CHAN-00118"]),
    row(&["G60"], "G60", "exact stop at the end of this block", "", "the next block starts when every axis is in its window", "N10 G01 G60 X10 F1000", &["P-AXIS-00236", "P-AXIS-00532", "70082", "G360"]),
    row(&["G360", "G359"], "G360   G359", "exact stop at every block end on, off; modal", "", "", "G360", &["P-AXIS-00236", "70082"]),
    row(&["G61", "G261", "G260"], "G61   G261   G260", "contouring at the end of this block, on, off", "", "", "G261", &["#CONTOUR MODE", "120206"]),
    row(&["G70", "G71"], "G70", "inch, mm for linear axes", "", "tolerance words remain in mm under G70 unless P-CHAN-00439 is 1", "G70", &["P-CHAN-00054", "P-CHAN-00439"]),
    row(&["G90", "G91"], "G90", "absolute, incremental coordinates", "", "", "G91", &[]),
    row(&["G93", "G94", "G95", "G194"], "G94 F..", "F is the block time in seconds, feed per minute, feed per revolution, percent of the maximum path feed", "", "each type keeps its own F, but the time of G93 is needed again with every G93", "G94 F2000", &["P-CHAN-00108", "20121"]),
    row(&["G115", "G116", "G117"], "G116", "look-ahead off, every transition is a stop, complete look-ahead", "", "", "G117", &["20151", "P-STUP-00070"]),
    row(&["G127", "G128"], "G127 X..   G128=..", "weight of the maximum speed in percent, per axis or for all", "", "0 gives 0.001 mm/s; axes not named keep theirs", "G128=50", &["P-AXIS-00212"]),
    row(&["G129"], "G129=..", "percent of the rapid speed", "", "", "G129=50", &["P-AXIS-00209"]),
    row(&["G130", "G131"], "G130 X..   G131=..", "percent of the feed accelerations, per axis or for all", "", "relative to the list value, not to the previous weight; axes not named keep theirs (assumption: the pages can be read as 100 %); above P-AXIS-00292: 50130, and 120033 for the deceleration", "G131=80", &["50130", "120033", "P-AXIS-00292", "P-CHAN-00001"]),
    row(&["G132", "G133"], "G132 X..   G133=..", "percent of the feed ramp times, per axis or for all", "", "not below P-AXIS-00293", "G133=150", &["P-AXIS-00293", "P-CHAN-00073"]),
    row(&["G134"], "G134=..", "percent of the geometric ramp time", "", "", "G134=200", &["P-AXIS-00199"]),
    row(&["G230", "G231"], "G230 X..   G231=..", "percent of the rapid acceleration, per axis or for all", "", "", "G231=80", &["50130", "P-AXIS-00004"]),
    row(&["G233"], "G233=..", "percent of the rapid ramp time", "", "", "G233=150", &["120630", "P-AXIS-00200"]),
    row(&["G135", "G137"], "G135   G137", "feedforward of all axes of the channel on, off; modal, off at program start", "", "weights of G136 are kept. vorsteuer.default_active in a list switches it on permanently", "G135", &["G136", "P-AXIS-00223", "P-AXIS-00255", "P-AXIS-00256", "K-0022"]),
    row(&["G136"], "G136 X.. Y..", "weights of the feedforward in percent, axis by axis; modal", "0..100 %, 100 at program start; higher values are limited (K-0020), negative values refused (K-0021)", "axes not named keep their weight; the axis words of the block are weights, not positions. Spindles: S[G135 G136=80]", "G135 G136 X80 Y95", &["G135", "K-0020", "K-0021", "21738", "P-AXIS-00228"]),
    row(&["G161", "G162"], "G161   G162", "I, J, K absolute, relative to the start point", "", "", "G162", &["G02"]),
    row(&["G164", "G165"], "G164   G165", "centre correction of arcs off, on", "", "", "G165", &["21758", "P-CHAN-00059", "P-CHAN-00060", "P-CHAN-00171", "P-CHAN-00172"]),
    row(&["G166"], "G166", "override 100 % for this block, for the programmed override and the real-time inputs", "", "", "G01 G166 X10 F1000", &["#OVERRIDE"]),
    row(&["M02", "M30", "M2"], "M30", "end of the program, reached when every axis is in its exact-stop window", "", "the trace continues until then, or until 70082", "M30", &["K-0003", "70082", "K-0130"]),
    row(&["M00", "M01", "M0", "M1"], "M00", "programmed stop, optional stop: the path stops; here the program continues immediately", "", "", "M00", &[]),
    row(&["M03", "M04", "M05", "M3", "M4", "M5"], "M03 S..   S[M3 REV..]", "spindle clockwise, counter-clockwise, stop", "S, REV in rev/min, limited to P-AXIS-00212 (K-0131)", "the main spindle is that of P-CHAN-00051, addressed by P-CHAN-00053", "S1000 M3", &["M19", "K-0131", "P-CHAN-00051", "P-CHAN-00053"]),
    row(&["M19"], "M19 S.POS=..   S[M19 POS=.. REV=..]", "positions the spindle: in the direction of M3 or M4 in the same block, otherwise in the current direction of rotation, from rest by the shorter way", "POS in deg, modal, default 0; REV in rev/min, default: the S word, otherwise the limit of the spindle", "monitored like an exact stop, in degrees", "S[M19 POS=90 REV=100]", &["M03", "70082", "P-AXIS-00236", "P-AXIS-00532"]),
    row(&["M17", "M29"], "M17   M17 [MAIN|JUMPS=.. [LABEL]|N..]", "end of a subroutine; in brackets: the level to return to and the label or block there", "JUMPS: number of levels, from 1 up to the main program; beyond it K-0109", "JUMPS=1, after the call", "M17 [MAIN [END]]", &["K-0003", "K-0015"]),
];

/// G functions, words and statements.
fn functions() -> impl Iterator<Item = &'static Command> {
    COMMANDS.iter().chain(LANGUAGE)
}

/// Names of all commands.
pub(super) fn names() -> impl Iterator<Item = String> {
    let functions = functions().flat_map(|c| c.names.iter().map(|name| (*name).to_owned()));
    commands::explained().map(|row| format!("#{}", row.name)).chain(functions)
}

/// Every command, then every function.
pub(super) fn all() -> impl Iterator<Item = Explanation> {
    commands::explained().map(of_row).chain(functions().map(Command::explained))
}

/// The command with a name; blanks and case do not matter, and text after the name is ignored (`#VIB GUARD ON`).
pub(super) fn find(thing: &str) -> Option<Explanation> {
    let words: Vec<String> = thing.split_whitespace().map(str::to_ascii_uppercase).collect();
    let wanted = words.join(" ");
    let wanted = wanted.split('[').next().unwrap_or_default().trim_end();
    let is_named = |name: &str| {
        wanted == name || wanted.strip_prefix(name).is_some_and(|rest| rest.starts_with(' '))
    };
    let function = |is: &dyn Fn(&str) -> bool| {
        functions().find(|c| c.names.iter().any(|name| is(name))).map(Command::explained)
    };
    // a refused command may begin with the name of another one: `#MCS TO WCS`, `#CS DEF ACT`
    let listed = wanted.strip_prefix('#').and_then(commands::state_of);
    let is_longer = |name: &str| listed.is_some_and(|(listed, _)| listed.len() + 1 > name.len());
    let whole = |name: &str| is_named(name) && !is_longer(name);
    // M8 and H12 have no entry of their own
    let letter = wanted.trim_end_matches(|c: char| c.is_ascii_digit());
    let numbered = |name: &str| matches!(letter, "M" | "H") && name == letter;
    if let Some(function) = function(&whole).or_else(|| function(&numbered)) {
        return Some(function);
    }
    // the longest name: `#CS DEF` is not `#CS`
    let named = commands::explained()
        .filter(|row| whole(&format!("#{}", row.name)))
        .max_by_key(|row| row.name.len());
    match (named, listed) {
        (Some(row), _) => Some(of_row(row)),
        (None, Some((name, _))) if name.contains(' ') => state(wanted),
        (None, _) => family(wanted).or_else(|| state(wanted)),
    }
}

/// Commands and G functions with nothing to explain except their state.
fn state(wanted: &str) -> Option<Explanation> {
    let (title, state) = if let Some(name) = wanted.strip_prefix('#') {
        let (name, state) = commands::state_of(name)?;
        (format!("#{name}"), format!("command of the control; here: {state}"))
    } else {
        let number: u32 = wanted.strip_prefix('G')?.parse().ok()?;
        let state = match unsupported_function(number) {
            Some(what) => format!("{what}; refused: not simulated"),
            None => format!("not a function of this dialect (20131): {}", unknown_g(number)?),
        };
        (format!("G{number}"), state)
    };
    Some(Explanation {
        kind: Kind::Command,
        title,
        meaning: state,
        facts: Vec::new(),
        notes: Vec::new(),
        example: None,
        related: Vec::new(),
    })
}

/// Commands that begin with the same word: `#CS` is `#CS DEF`, `#CS ON` and so on.
fn family(wanted: &str) -> Option<Explanation> {
    let first = wanted.strip_prefix('#')?;
    let rows: Vec<&commands::Row> = commands::explained()
        .filter(|row| row.name.strip_prefix(first).is_some_and(|rest| rest.starts_with(' ')))
        .collect();
    let others = functions().flat_map(|c| c.names.iter().map(move |name| (*name, c.meaning)));
    let others = others
        .filter(|(name, _)| name.strip_prefix(wanted).is_some_and(|rest| rest.starts_with(' ')));
    let others: Vec<(&str, &str)> = others.collect();
    let rows = rows.iter().map(|row| (row.name, row.meaning));
    let facts: Vec<(&'static str, String)> = rows
        .chain(others)
        .map(|(name, meaning)| (name.trim_start_matches('#'), meaning.to_owned()))
        .collect();
    (!facts.is_empty()).then(|| Explanation {
        kind: Kind::Command,
        title: wanted.to_owned(),
        meaning: "several commands start with this word".to_owned(),
        related: facts.iter().map(|(name, _)| format!("#{name}")).collect(),
        facts,
        notes: Vec::new(),
        example: None,
    })
}

fn of_row(row: &commands::Row) -> Explanation {
    let keys: Vec<String> = row.keys.iter().map(ToString::to_string).collect();
    explained(
        format!("#{}", row.name),
        [row.form, row.meaning, row.note, row.example],
        keys.join("; "),
        row.related,
    )
}

/// Largest number of names that a title lists.
const MOST_IN_TITLE: usize = 20;

impl Command {
    fn explained(&self) -> Explanation {
        let title = match self.names {
            [first, .., last] if self.names.len() > MOST_IN_TITLE => format!("{first} .. {last}"),
            names => names.join(", "),
        };
        explained(
            title,
            [self.syntax, self.meaning, self.note, self.example],
            self.keys.to_owned(),
            self.related,
        )
    }
}

fn explained(
    title: String,
    [form, meaning, note, example]: [&'static str; 4],
    keys: String,
    related: &[&'static str],
) -> Explanation {
    let text = |s: &'static str| (!s.is_empty()).then(|| s.to_owned());
    let mut facts = vec![("form", form.to_owned())];
    if !keys.is_empty() {
        facts.push(("keys", keys));
    }
    Explanation {
        kind: Kind::Command,
        title,
        meaning: meaning.to_owned(),
        facts,
        notes: text(note).into_iter().collect(),
        example: text(example),
        related: related.iter().map(|s| (*s).to_owned()).collect(),
    }
}
