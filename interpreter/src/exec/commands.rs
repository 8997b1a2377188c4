//! Plain-text commands: one row each, found by their words; the longest row wins.
//!
//! A new command needs a file with its arguments, its row and its function, and the name of the row in [`ROWS`]. `explain`, the
//! search for misspelt names and the documentation use only the syntax, keys and meaning of the row.
//!
//! Source: TF5200 programming manual, list of commands.

mod areas;
mod axes;
mod compensation;
mod configuration;
mod contour;
mod corner;
mod couplings;
mod drives;
mod exceptions;
mod files;
mod flush;
mod frames;
mod hsc;
pub(in crate::exec) mod keys;
mod kinematics;
mod manual;
mod measuring;
mod messages;
mod misc;
mod path_limits;
mod positions;
pub(in crate::exec) mod range;
mod refused;
mod row;
mod shaping;
mod signals;
mod slope;
mod spindles;
mod splines;
mod system_stack;
mod tools;
mod turning;
mod wear;

use super::decoder::Decoder;
use super::fault::{Fault, Outcome};
use crate::diag::{Condition, condition};
use crate::suggest;
use crate::syntax::ast::{Command, Span};
pub(super) use messages::addition;
pub(crate) use row::Row;
use row::{Act, Call};

const fn run(name: &'static str, f: fn(&mut Decoder, &Call<'_>) -> Outcome<()>) -> Row {
    Row::run(name, f)
}

const fn ignored(name: &'static str) -> Row {
    Row::of(name, Act::Ignored("it has no effect here"))
}

const fn off_only(name: &'static str) -> Row {
    Row::of(name, Act::OffOnly)
}

const fn unsupported(name: &'static str) -> Row {
    Row::of(name, Act::Unsupported)
}

/// All rows. Commands in the manual's overview of additional functions that kontur does not execute are refused by name.
#[rustfmt::skip]
const ROWS: &[Row] = &[
    // acceleration profile
    slope::SLOPE,
    slope::SET_SLOPE_PROFIL,
    // smoothing of setpoints
    shaping::VIB_GUARD,
    shaping::FILTER,
    // contour
    contour::CONTOUR_MODE,
    hsc::HSC,
    path_limits::VECTOR_LIMIT,
    path_limits::VECTORVEL,
    path_limits::VECTORACC,
    path_limits::TRANSVELMIN,
    path_limits::OVERRIDE,
    // waiting and synchronisation
    flush::FLUSH,
    misc::CHANNEL_INIT,
    run("SET DEC LR SOLL", misc::take_command_positions).bare(),
    positions::GET_CMDPOS,
    positions::GET_ACTPOS,
    positions::SET_IPO_SOLLPOS,
    misc::TIME,
    misc::WAIT,
    misc::TIMER,
    signals::SIGNAL,
    // messages
    messages::MSG,
    messages::ERROR,
    // variables, files, macros
    run("DELETE", misc::delete).values(),
    run("INIT MACRO TAB", misc::init_macros).bare(),
    run("INIT MAKRO TAB", misc::init_macros).bare(),
    run("FILE NAME", misc::file_name).several(),
    run("FILENAME", misc::file_name).several(),
    files::FILE_EXIST,
    unsupported("FILE RENAME"),
    unsupported("FILE DELETE"),
    misc::MACHINE_DATA,
    // axis exchange
    axes::PUT_AX,
    axes::CALL_AX,
    axes::SET_AX,
    run("AX REQUEST", axes::call).several(),
    run("AX RELEASE", axes::put).several(),
    run("AX DEF", axes::define).several(),
    couplings::AX_LINK,
    couplings::SET_AX_LINK,
    couplings::ENABLE_AX_LINK,
    unsupported("GANTRY"),
    unsupported("GEAR LINK"),
    unsupported("KIN TCP DEF"),
    // frames
    run("ROTATION", frames::rotation),
    run("CS", frames::coordinate_system).several(),
    system_stack::ADD,
    system_stack::SELECT,
    system_stack::SET,
    system_stack::DELETE,
    run("CS DEF", frames::define_system).several(),
    frames::MCS,
    run("FGROUP", axes::feed_group),
    off_only("ACS"),
    off_only("BCS"),
    off_only("ECS"),
    off_only("TRACK CS"),
    // kinematics
    run("TRAFO", kinematics::transformation).several().values(),
    run("RTCP", kinematics::transformation).several().values(),
    run("KIN ID", kinematics::transformation).several().values(),
    run("ORI MODE", kinematics::transformation).several().values(),
    run("PTP", kinematics::transformation).several().values(),
    run("CYL", kinematics::kinematic).several().values(),
    run("TLC", kinematics::kinematic).several().values(),
    run("FACE", kinematics::kinematic).several().values(),
    off_only("CAX"),
    off_only("CAXTRACK"),
    compensation::TANGFEED,
    compensation::SET_TANGFEED,
    turning::TURN,
    off_only("NIBBLE"),
    off_only("PUNCH"),
    off_only("DYNAMIC WEIGHT"),
    off_only("DYN_WEIGHT"),
    off_only("DIST CTRL"),
    wear::OTC,
    off_only("LIFT"),
    unsupported("ACHSTAUSCH"),
    splines::AKIMA_TRANS,
    unsupported("AKIMA"),
    unsupported("AX LOCK"),
    unsupported("AX UNLOCK"),
    unsupported("BSPLINE"),
    off_only("CHANNEL INTERFACE"),
    unsupported("CHANNEL SET"),
    off_only("COLL"),
    unsupported("CONTOUR BEGIN"),
    unsupported("CONTOUR END"),
    corner::CORNER_PARAM,
    corner::SET_CORNER_PARAM,
    unsupported("CS DEF ACT"),
    off_only("CS MODE"),
    unsupported("DEL DIST2GO"),
    couplings::DISABLE_AX_LINK,
    off_only("EDGE MACHINING"),
    off_only("EDM"),
    unsupported("ESCAPE PATH"),
    off_only("FREE TOOL CHANGE"),
    manual::GET_MANUAL_OFFSETS,
    manual::GET_IPO_OFFSET,
    manual::SET_OFFSET,
    manual::SET_HR,
    unsupported("INFO"),
    unsupported("GET WCS POSLIMIT"),
    unsupported("LIMIT"),
    unsupported("LOCK"),
    manual::MANUAL,
    manual::MANUAL_LIMITS,
    unsupported("MCS TO WCS"),
    measuring::MEAS,
    measuring::MEAS_MODE,
    measuring::MEAS_DEFAULT,
    areas::CONTROL_AREA_BEGIN,
    areas::CONTROL_AREA_START,
    areas::CONTROL_AREA_END,
    areas::CONTROL_AREA_CLEAR,
    areas::CONTROL_AREA,
    unsupported("MEAS PREPARE"),
    unsupported("MICROJOINT"),
    unsupported("MILLCONT"),
    off_only("SEGMENTATION"),
    manual::SET_JOG,
    unsupported("MIRROR"),
    unsupported("PATTERN"),
    unsupported("AT"),
    unsupported("SYNC IN"),
    unsupported("SYNC OUT"),
    manual::SET_TIP,
    splines::SPLINE,
    splines::SPLINE_TYPE,
    splines::SET_SPLINE,
    splines::SET_SPLINETYPE,
    splines::SET_ASPLINE_MODE,
    unsupported("START"),
    unsupported("TRANSFORM"),
    unsupported("STROKE DEF"),
    off_only("TGC"),
    compensation::TRC,
    unsupported("UNLOCK"),
    unsupported("WCS TO MCS"),
    unsupported("RT CYCLE"),
    unsupported("RT WHILE"),
    unsupported("RT ENDWHILE"),
    unsupported("VOLCOMP"),
    manual::JOG,
    manual::HANDWHEEL,
    // parameters and procedures of drives
    unsupported("IDENT"),
    unsupported("COMMAND"),
    drives::DRIVE,
    unsupported("INIT V.E."),
    unsupported("FF"),
    unsupported("LAH"),
    // spindles
    spindles::MAIN_SPINDLE,
    // cycles
    run("DISABLE MODAL CYCLE", misc::disable_modal_cycle).bare(),
    run("RETAIN CYCLE CHANGES", misc::retain_cycle_changes).bare(),
    // no influence on setpoints
    ignored("SINGLE STEP"),
    ignored("BLOCKSEARCH"),
    tools::TLAX,
    tools::TOOL_DATA,
    tools::TOOL_PREP,
    tools::TOOL_REFRESH,
    unsupported("TOOL"),
    unsupported("TOOL DEF"),
    unsupported("TOOL ORI CS"),
    ignored("TOOL LIFE DEF"),
    ignored("TOOL LIFE READ"),
    ignored("TOOL LIFE REMOVE"),
    ignored("EXPL SYN"),
    configuration::LOAD_CONFIG,
    configuration::SAVE_CONFIG,
    configuration::CLEAR_CONFIG,
    ignored("CACHE"),
    ignored("DISTANCE PROG START"),
    ignored("DIST TO GO"),
    ignored("EXPORT VE"),
    ignored("OPTIONAL EXECUTION"),
    ignored("BACKWARD"),
    ignored("DIAGNOSIS"),
    ignored("SCENE"),
];

/// All rows with an explanation.
pub(crate) fn explained() -> impl Iterator<Item = &'static Row> {
    ROWS.iter().filter(|row| !row.form.is_empty())
}

/// The longest command name at the start of a text, with one sentence on whether the command is executed, ignored or refused.
pub(crate) fn state_of(text: &str) -> Option<(&'static str, &'static str)> {
    let named = ROWS.iter().filter(|row| {
        text.strip_prefix(row.name).is_some_and(|rest| rest.is_empty() || rest.starts_with(' '))
    });
    let row = named.max_by_key(|row| row.name.len())?;
    let state = match row.act {
        Act::Run(_) => "kontur check reports which parts are executed",
        Act::Ignored(why) => why,
        Act::OffOnly => {
            "OFF is accepted; ON is refused: not simulated, and the result would be wrong without it"
        }
        Act::Unsupported => "refused: not simulated, and the result would be wrong without it",
    };
    Some((row.name, state))
}

/// The row of a command and the number of words of its name.
fn find(command: &Command) -> Option<(&'static Row, usize)> {
    ROWS.iter()
        .filter_map(|row| {
            let mut words = command.words.iter();
            let all = row.name.split(' ').all(|n| words.next().is_some_and(|w| w.is(n)));
            all.then(|| (row, row.name.split(' ').count()))
        })
        .max_by_key(|(_, count)| *count)
}

/// Name of a command up to its second word, for messages.
fn unknown(command: &Command) -> Box<Fault> {
    let name = command.name();
    let span = match command.words.last() {
        Some(last) => Span::new(command.span.start as usize, last.span.end() as usize),
        None => command.span,
    };
    let fault = Fault::new(Condition::CommandUnknown, format!("unknown command #{name}"), span);
    let near = suggest::nearest(&name, ROWS.iter().map(|row| row.name)).map(str::to_owned);
    match near.or_else(|| without_blanks(&name)).or_else(|| begun(&name)) {
        Some(near) => fault.hint(format!("did you mean `#{near}`?")),
        None => fault,
    }
}

/// `FLUSH WAIT` for `FLUSHWAIT` and `FLUSH_WAIT`.
fn without_blanks(name: &str) -> Option<String> {
    let joined = |text: &str| text.replace([' ', '_'], "").to_ascii_uppercase();
    let written = joined(name);
    let rows = ROWS.iter().map(|row| row.name).filter(|row| row.len() > 3);
    let row = rows.filter(|row| written.starts_with(&joined(row))).max_by_key(|row| row.len())?;
    let rest = &written[joined(row).len()..];
    Some(if rest.is_empty() { row.to_owned() } else { format!("{row} {rest}") })
}

/// `CONTOUR MODE` for `CONTOUR ON`: a command with the same first word.
fn begun(name: &str) -> Option<String> {
    let first = name.split(' ').next()?.to_ascii_uppercase();
    let mut rows = ROWS
        .iter()
        .map(|row| row.name)
        .filter(|row| row.strip_prefix(first.as_str()).is_some_and(|rest| rest.starts_with(' ')));
    rows.next().filter(|_| !first.is_empty()).map(str::to_owned)
}

/// Whether the manual has this command.
pub(super) fn is_known(command: &Command) -> bool {
    find(command).is_some()
}

/// Executes a plain-text command.
pub(super) fn execute(decoder: &mut Decoder, command: &Command) -> Outcome<()> {
    decoder.dialect.own_statement();
    let Some((row, count)) = find(command) else { return Err(unknown(command)) };
    let call = Call { command, name: row.name, rest: &command.words[count..] };
    if !command.behind.is_empty() {
        // reported with the form of the block
        return Ok(());
    }
    if let (Some(value), Some(false)) = (command.arguments.first(), command.on) {
        let text = format!("{}: a value after OFF", call.title());
        return Err(Fault::new(Condition::WordsBehindCommand, text, value.span));
    }
    exceptions::fits_compensation(decoder, &call)?;
    match row.act {
        Act::Run(f) => row.takes(command).and_then(|()| f(decoder, &call)).map_err(|fault| {
            // the expected syntax is more helpful than a reference
            let general = condition::row(Condition::TokenUnknown.id()).hint;
            let unhinted = fault.diagnostic.id == Condition::TokenUnknown.id()
                && fault.diagnostic.hint.as_deref() == general;
            if unhinted && !row.form.is_empty() {
                fault.hint(format!("write {}", row.form))
            } else {
                fault
            }
        }),
        Act::OffOnly if command.on == Some(false) => Ok(()),
        Act::OffOnly | Act::Unsupported => Err(refused::refused(decoder, &call)),
        Act::Ignored(text) => {
            if let Some(fault) = refused::keys_wrong(&call) {
                return Err(fault);
            }
            let text = format!("{}: {text}", call.title());
            decoder.report.note_once(row.name, Fault::new(Condition::Ignored, text, call.span()));
            Ok(())
        }
    }
}
