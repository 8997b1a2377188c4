//! The channel: start values of a program and limits of the path.

pub(super) mod couplings;
pub(super) mod functions;
mod path;

use super::parameters::{Parameters, Setting};
use super::table::Indices;
use super::table::channel as of;
use super::table::param::{Optional, Param, Text, Whole, whole};
use couplings::{DefaultCoupling, default_couplings};
use functions::{Acknowledged, SpindleDurations, SpindleWaits};
use kontur_motion::block::{
    CurveJerk, SlopeKind, SplineSettings, TransitionJerkMode, VectorLimits,
};
use kontur_motion::realtime::OverrideMode;
use path::{feed_unit, look_ahead, slope, spline, vector, vector_time_s};
use std::collections::{BTreeMap, BTreeSet};

/// Number of blocks in the look-ahead of the planner (P-CHAN-00650 and 00653, or P-STUP-00070 and 00071).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LookAhead {
    /// Blocks, 10 to 10 000; default 120.
    pub blocks: u32,
}

/// Override of G00 (P-CHAN-00181).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum RapidOverride {
    /// One override for G00 and feed.
    #[default]
    NotUsed,
    /// The smaller of the two.
    Minimum,
    /// A separate override for G00.
    Active,
}

/// Handling of a message to the diagnosis receiver (P-CHAN-00518).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum DiagnosisMessages {
    /// It is written.
    #[default]
    Standard,
    /// It is discarded.
    Disabled,
    /// It is discarded with the warning 22194.
    Warning,
    /// It is discarded with the error 22195.
    Error,
}

/// Limits of arcs whose centre and end point do not match.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ArcCentre {
    /// G165: largest shift of the centre in mm (P-CHAN-00059), default 2.
    pub shift_mm: f64,
    /// G165: the same relative to the radius (P-CHAN-00060), default 0.05.
    pub shift_ratio: f64,
    /// G164: largest difference of start and end radius in mm (P-CHAN-00171), default 0.005.
    pub radius_difference_mm: f64,
    /// G164: the same relative to the radius (P-CHAN-00172), default 0.001.
    pub radius_difference_ratio: f64,
}

/// The channel with its start values.
#[derive(Clone, Debug, PartialEq)]
#[expect(clippy::struct_excessive_bools, reason = "one switch per parameter of the list")]
pub struct Channel {
    /// Slope at program start (P-CHAN-00071), default STEP.
    pub slope: SlopeKind,
    /// Constant ramp time instead of constant jerk (P-CHAN-00349).
    pub constant_ramp_time: bool,
    /// The ramp times weighted by G132 and G133 (P-CHAN-00073): 0 all, 1 to 4 one of `ramps_s`.
    pub ramp_selection: u32,
    /// The accelerations weighted by G130 and G131 (P-CHAN-00001): 0 both, 1 acceleration, 2 deceleration.
    pub acc_selection: u32,
    /// Feed rate before the first F word in mm/s (P-CHAN-00099), `None` = F must be programmed (20008).
    pub feed_mm_s: Option<f64>,
    /// Length unit of an F word in mm/min (P-CHAN-00108 = 100: 1; 0.1: 1000).
    pub feed_unit_mm_min: f64,
    /// Members of the feed group (P-CHAN-00011), one flag per path axis.
    ///
    /// Source: TF5200 channel parameters; if no axis is marked: the main axes, the first three at program start.
    pub feed_axes: Vec<bool>,
    /// Whether the list marks members of the feed group; otherwise the group follows the main axes in an axis exchange
    /// (149140491).
    pub lists_feed_axes: bool,
    /// Limit the jerk at tangential transitions (P-CHAN-00009).
    pub limit_tangential_jerk: bool,
    /// Rule for the limits at transitions (P-CHAN-00117).
    pub transition_jerk: TransitionJerkMode,
    /// Extra limit between lines (P-CHAN-00245), 0 to 3.
    pub curvature_estimate: u8,
    /// The ramp time that limits the jerk on polynomials (P-CHAN-00110).
    pub curve_jerk: CurveJerk,
    /// Values of `#VECTOR LIMIT ON` until the program sets others (P-CHAN-00002, 00090, 00208, 00361).
    pub vector: VectorLimits,
    /// Unit of time in s of ACC, DEC, RADIAL_ACC and RADIAL_JERK in `#VECTOR LIMIT` (P-CHAN-00351): 60 or 1.
    pub vector_time_s: f64,
    /// The path acceleration limit also applies to arcs (P-CHAN-00350).
    pub vector_acc_on_arcs: bool,
    /// Limits of arcs whose centre and end point do not match.
    pub arc_centre: ArcCentre,
    /// Axes of the channel, one bit each, whose positions outside the software limits are a warning (P-CHAN-00147).
    pub limit_warnings: u32,
    /// Look-ahead.
    pub look_ahead: LookAhead,
    /// Settings of `#HSC [BSPLINE]` at program start (P-CHAN-00122 to 00130).
    pub spline: SplineSettings,
    /// Shortest length and smallest radius in mm of a tool that D accepts (P-CHAN-00156, P-CHAN-00157); 0: any.
    pub(crate) least_tool_mm: [f64; 2],
    /// Programs start in inch (P-CHAN-00054).
    pub inch: bool,
    /// Tolerance words are inch under G70 (P-CHAN-00439).
    pub contouring_consider_inch: bool,
    /// Implicit G60 after G00 (P-CHAN-00235).
    pub exact_stop_after_g00: bool,
    /// Feedhold uses separate parameters (P-CHAN-00097).
    pub own_feed_hold: bool,
    /// Several G90 and G91 in a block, each effective from its position on (P-CHAN-00116).
    pub several_dimensions: bool,
    /// Several words of an axis in a motion block (P-CHAN-00148, with P-CHAN-00116).
    pub several_words: bool,
    /// Absolute words of modulo axes always take the shortest way (P-CHAN-00346).
    pub shortest_way: bool,
    /// Cycles do not restore modal states at their end (P-CHAN-00210).
    pub cycle_changes_stay: bool,
    /// Chamfers and roundings are not available (P-CHAN-00273).
    pub no_chamfers: bool,
    /// I, J and K of arcs are modal (P-CHAN-00159).
    pub modal_centres: bool,
    /// Edge banding skips the rest of the block after its M function (P-CHAN-00149).
    pub banding_rejects_rest: bool,
    /// The path waits for all independent axes in a block, not only for those that it moves (P-CHAN-00451).
    pub joins_named: bool,
    /// Reading a `@P` parameter that was not passed creates it (P-CHAN-00463).
    pub creates_cycle_parameters: bool,
    /// Offsets of axes that are not main axes belong to their coordinate system (P-CHAN-00397).
    pub offsets_in_systems: bool,
    /// The offsets of a tool are moved with its D word (P-CHAN-00100).
    pub tool_offsets_at_once: bool,
    /// The limits of the axis lists bound those of G98 and G99 (P-CHAN-00498).
    pub limits_bounded: bool,
    /// Maximum number of characters in the name of a macro (P-CHAN-00511).
    pub macro_name_length: u32,
    /// Maximum number of characters in the text of a macro (P-CHAN-00512).
    pub macro_text_length: u32,
    /// P parameters survive program start (P-CHAN-00067).
    pub keep_p_parameters: bool,
    /// The velocity that the override multiplies (P-CHAN-00066).
    pub override_mode: OverrideMode,
    /// Override in G00 (P-CHAN-00181).
    pub rapid_override: RapidOverride,
    /// Largest ratio of the external override (P-CHAN-00056), if the list states it.
    ///
    /// Assumption: without an entry nothing is limited, although the vendor's default is 1: the inputs of a run may
    /// contain an override above 100 %, and a message names the default.
    pub most_override: Option<f64>,
    /// Start values of G groups (P-CHAN-00063): group and G number; a preset of group 21 (feedforward) has no effect.
    pub g_groups: BTreeMap<u32, u32>,
    /// Durations of M functions in s (P-CHAN-00040).
    pub m_durations_s: BTreeMap<u32, f64>,
    /// Axes and spindles to which M functions go (P-CHAN-00039).
    pub m_outputs: BTreeMap<u32, Box<str>>,
    /// When the path waits for M functions, where the list says so (P-CHAN-00041).
    pub m_waits: BTreeMap<u32, Acknowledged>,
    /// When the path waits for H functions, if the list states it (P-CHAN-00027).
    pub h_waits: BTreeMap<u32, Acknowledged>,
    /// M functions that wait for the signal of edge banding (P-CHAN-00041 with MNE_SNS).
    pub m_at_signal: BTreeSet<u32>,
    /// Durations of H functions in s (P-CHAN-00026).
    pub h_durations_s: BTreeMap<u32, f64>,
    /// Durations of the functions of each spindle in s, in the order of the list.
    pub spindle_durations_s: Vec<SpindleDurations>,
    /// The functions of each spindle for which the path waits, in the order of the list.
    pub spindle_waits: Vec<SpindleWaits>,
    /// Spindles that the PLC turns (P-CHAN-00069).
    pub plc_spindles: Vec<bool>,
    /// Macros available in every program (P-CHAN-00085), with their NC code (P-CHAN-00062).
    pub macros: BTreeMap<Box<str>, Box<str>>,
    /// Subroutines called by G80 to G89 (P-CHAN-00160 to 00169) and G800 to G839 (P-CHAN-00187), by G number.
    pub g8x_programs: BTreeMap<u32, String>,
    /// Offsets of a face turning axis are diameters (P-CHAN-00091).
    pub offsets_in_diameters: bool,
    /// T also selects the tool data of its number (P-CHAN-00014).
    pub tool_data_with_tool: bool,
    /// `#WAIT INDP` waits for the windows of all axes (P-CHAN-00297 = 2).
    pub joins_in_windows: bool,
    /// G60 and G360 also wait for independent axes (P-CHAN-00297 = 1).
    pub stops_join: bool,
    /// Measuring type at program start, 1 to 7 (P-CHAN-00057).
    pub measuring_type: u32,
    /// Measuring type 1: a run without a probe signal is an error (P-CHAN-00176).
    pub missing_signal_is_error: bool,
    /// Way after the signal in edge banding in mm (P-CHAN-00030).
    pub residual_path_mm: f64,
    /// Edge banding extends over several blocks (P-CHAN-00029).
    pub banding_over_blocks: bool,
    /// The override has no effect on G33 (P-CHAN-00836).
    pub thread_ignores_override: bool,
    /// Consecutive blocks of G33 are one thread (P-CHAN-00837).
    pub thread_chain: bool,
    /// Messages to the diagnosis receiver (P-CHAN-00518).
    pub diagnosis_messages: DiagnosisMessages,
    /// Subroutine called at the start of every program (P-CHAN-00119).
    pub start_program: Option<String>,
    /// Subroutine called before the end of every program (P-CHAN-00252).
    pub end_program: Option<String>,
    /// Subroutine called by M06 (P-CHAN-00118); `None`: M06 is an ordinary function.
    pub tool_change_program: Option<String>,
    /// Subroutine called by D words (P-CHAN-00429).
    pub tool_data_program: Option<String>,
    /// Logical number of the main spindle (P-CHAN-00051), `None`: the first one.
    pub main_spindle: Option<u32>,
    /// Name that addresses the main spindle in the NC program (P-CHAN-00053).
    pub main_spindle_name: String,
    /// Coupling group 0 as defined by the list (P-CHAN-00037, P-CHAN-00038).
    pub default_couplings: Vec<DefaultCoupling>,
    parameters: Parameters,
    start_up: Parameters,
}

/// Subroutines of G80 to G89.
const CYCLE_PROGRAMS: [Param<Text>; 10] = [
    of::G80_PROGRAM,
    of::G81_PROGRAM,
    of::G82_PROGRAM,
    of::G83_PROGRAM,
    of::G84_PROGRAM,
    of::G85_PROGRAM,
    of::G86_PROGRAM,
    of::G87_PROGRAM,
    of::G88_PROGRAM,
    of::G89_PROGRAM,
];

/// Number of spindles in a channel list.
const SPINDLES: u32 = 16;

impl Channel {
    pub(super) fn new(
        parameters: Parameters,
        start_up: Parameters,
        mut feed_axes: Vec<bool>,
    ) -> Self {
        let lists_feed_axes = feed_axes.contains(&true);
        if !lists_feed_axes {
            feed_axes.iter_mut().take(3).for_each(|feed| *feed = true);
        }
        let p = &parameters;
        let program = |param: Param<Text>| p.get(param).filter(|name| !name.is_empty());
        let choice = |param: Param<Whole>| p.get(param);
        let table = |array: Param<Optional>| -> BTreeMap<u32, f64> {
            let listed = p.settings().filter(|(_, s)| s.row.key == array.place().row.key);
            listed.filter_map(|(i, _)| Some((i[0], p.get(array.at(i[0]))?))).collect()
        };
        let waits = |array: Param<Optional>| -> BTreeMap<u32, Acknowledged> {
            let kinds = table(array).into_iter();
            kinds.filter_map(|(i, bits)| Some((i, Acknowledged::of(whole(bits)?)))).collect()
        };
        Self {
            slope: slope(choice(of::SLOPE)),
            constant_ramp_time: p.get(of::CONSTANT_RAMP_TIME),
            ramp_selection: choice(of::RAMP_SELECTION),
            acc_selection: choice(of::ACC_SELECTION),
            feed_mm_s: Some(p.get(of::FEED)).filter(|f| *f > 0.0).map(|f| f / 60.0),
            feed_unit_mm_min: feed_unit(p.get(of::FEED_UNIT)),
            feed_axes,
            lists_feed_axes,
            limit_tangential_jerk: p.get(of::LIMIT_TANGENTIAL_JERK),
            transition_jerk: match choice(of::TRANSITION_JERK) {
                0 => TransitionJerkMode::Coupled,
                1 => TransitionJerkMode::Independent,
                _ => TransitionJerkMode::DirectJerk,
            },
            curvature_estimate: u8::try_from(choice(of::CURVATURE_ESTIMATE)).unwrap_or(3),
            curve_jerk: match choice(of::CURVE_JERK) {
                0 => CurveJerk::Unlimited,
                2 => CurveJerk::Ramps,
                _ => CurveJerk::Geometric,
            },
            limit_warnings: choice(of::LIMIT_WARNINGS),
            vector: vector(p),
            vector_time_s: vector_time_s(p),
            vector_acc_on_arcs: p.get(of::PATH_ACC_ON_ARCS),
            arc_centre: ArcCentre {
                shift_mm: p.get(of::CENTRE_SHIFT),
                shift_ratio: p.get(of::CENTRE_SHIFT_RATIO),
                radius_difference_mm: p.get(of::RADIUS_DIFFERENCE),
                radius_difference_ratio: p.get(of::RADIUS_DIFFERENCE_RATIO),
            },
            look_ahead: look_ahead(p, &start_up),
            spline: spline(p),
            least_tool_mm: [p.get(of::MIN_TOOL_LENGTH), p.get(of::MIN_TOOL_RADIUS)],
            inch: p.get(of::INCH),
            contouring_consider_inch: p.get(of::CONTOURING_INCH),
            exact_stop_after_g00: p.get(of::EXACT_STOP_AFTER_G00),
            own_feed_hold: p.get(of::OWN_FEEDHOLD),
            several_dimensions: p.get(of::SEVERAL_DIMENSIONS),
            several_words: p.get(of::SEVERAL_DIMENSIONS) && p.get(of::SEVERAL_WORDS),
            shortest_way: p.get(of::SHORTEST_WAY),
            cycle_changes_stay: p.get(of::CYCLE_CHANGES_STAY),
            no_chamfers: p.get(of::NO_CHAMFERS),
            modal_centres: p.get(of::MODAL_CENTRES),
            banding_rejects_rest: p.get(of::BANDING_REJECTS_REST),
            joins_named: choice(of::JOINS_NAMED) == 1,
            creates_cycle_parameters: p.get(of::CREATES_PARAMETERS),
            offsets_in_systems: p.get(of::OFFSETS_IN_SYSTEMS),
            tool_offsets_at_once: p.get(of::TOOL_OFFSETS_AT_ONCE),
            limits_bounded: p.get(of::LIMITS_BOUNDED),
            macro_name_length: p.get(of::MACRO_NAME_LENGTH),
            macro_text_length: p.get(of::MACRO_TEXT_LENGTH),
            keep_p_parameters: p.get(of::KEEP_P_PARAMETERS),
            override_mode: match choice(of::OVERRIDE_MODE) {
                0 => OverrideMode::OfReached,
                1 => OverrideMode::OfProgrammed,
                _ => OverrideMode::OfProgrammedWhileReduced,
            },
            rapid_override: match choice(of::RAPID_OVERRIDE) {
                0 => RapidOverride::NotUsed,
                1 => RapidOverride::Minimum,
                _ => RapidOverride::Active,
            },
            most_override: p.set_by(of::MOST_OVERRIDE).map(|_| p.get(of::MOST_OVERRIDE)),
            g_groups: table(of::G_GROUP)
                .into_iter()
                .filter_map(|(group, g)| Some((group, whole(g)?)))
                .collect(),
            m_durations_s: table(of::M_DURATION),
            m_outputs: texts(p, of::M_OUTPUT),
            m_waits: waits(of::M_SYNCHRONISATION),
            h_waits: waits(of::H_SYNCHRONISATION),
            m_at_signal: table(of::M_SYNCHRONISATION)
                .into_iter()
                .filter_map(|(m, kind)| (whole(kind)? & of::AT_SIGNAL != 0).then_some(m))
                .collect(),
            h_durations_s: table(of::H_DURATION),
            spindle_durations_s: (0..SPINDLES).map(|i| SpindleDurations::of(p, i)).collect(),
            plc_spindles: (0..SPINDLES).map(|i| p.get(of::PLC_SPINDLE.at(i))).collect(),
            spindle_waits: (0..SPINDLES).map(|i| SpindleWaits::of(p, i)).collect(),
            macros: macros(p),
            g8x_programs: (80..)
                .zip(CYCLE_PROGRAMS)
                .chain((0..40).map(|i| (800 + i, of::G800_PROGRAM.at(i))))
                .filter_map(|(g, param)| Some((g, p.get(param)?)))
                .filter(|(_, program)| program != "*")
                .collect(),
            offsets_in_diameters: p.get(of::OFFSETS_IN_DIAMETERS),
            tool_data_with_tool: p.get(of::TOOL_DATA_WITH_TOOL),
            joins_in_windows: p.get(of::INDEPENDENT_STOP) == 2,
            stops_join: p.get(of::INDEPENDENT_STOP) == 1,
            measuring_type: p.get(of::MEASURING_TYPE),
            missing_signal_is_error: p.get(of::MISSING_SIGNAL_IS_ERROR),
            residual_path_mm: p.get(of::RESIDUAL_PATH),
            banding_over_blocks: p.get(of::BANDING_OVER_BLOCKS),
            thread_ignores_override: p.get(of::THREAD_IGNORES_OVERRIDE),
            thread_chain: p.get(of::THREAD_CHAIN),
            diagnosis_messages: match p.get(of::DIAGNOSIS_MESSAGES).as_deref() {
                Some("DISABLED") => DiagnosisMessages::Disabled,
                Some("WARNING") => DiagnosisMessages::Warning,
                Some("ERROR") => DiagnosisMessages::Error,
                _ => DiagnosisMessages::Standard,
            },
            start_program: program(of::START_PROGRAM),
            end_program: program(of::END_PROGRAM),
            tool_change_program: program(of::TOOL_CHANGE_PROGRAM),
            tool_data_program: program(of::TOOL_DATA_PROGRAM),
            main_spindle: Some(choice(of::MAIN_SPINDLE)).filter(|n| *n != 0),
            // a different first letter is replaced (20971)
            main_spindle_name: p
                .get(of::MAIN_SPINDLE_NAME)
                .filter(|name| name.starts_with(['S', 's']))
                .unwrap_or_else(|| "S".to_owned()),
            default_couplings: default_couplings(p).0,
            parameters,
            start_up,
        }
    }

    /// All parameters of the channel list.
    pub fn parameters(&self) -> &Parameters {
        &self.parameters
    }

    /// All parameters of the start-up list.
    pub fn start_up(&self) -> &Parameters {
        &self.start_up
    }
}

/// The macros of the list that have both a name and a text.
/// The entries of an array of texts.
fn texts(p: &Parameters, array: Param<Text>) -> BTreeMap<u32, Box<str>> {
    let listed = p.settings().filter(|(_, s)| s.row.key == array.place().row.key);
    let named = listed.filter_map(|(i, s)| Some((i[0], s.value.text()?.into())));
    named.filter(|(_, name): &(u32, Box<str>)| !name.is_empty()).collect()
}

fn macros(p: &Parameters) -> BTreeMap<Box<str>, Box<str>> {
    let named = p.settings().filter(|(_, s)| s.row.key == of::MACRO_NAME.place().row.key);
    let both = |(i, setting): (Indices, &Setting)| {
        let name = setting.value.text().filter(|name| !name.is_empty())?;
        let code = p.get(of::MACRO_CODE.at(i[0]))?;
        Some((name.into(), code.replace("\\\"", "\"").into()))
    };
    named.filter_map(both).collect()
}
