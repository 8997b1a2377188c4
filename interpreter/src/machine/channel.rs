//! The channel: start values of a program and limits of the path.

use super::axis::integer;
use super::parameters::Parameters;
use kontur_motion::block::{CurveJerk, SlopeKind, TransitionJerkMode, VectorLimits};
use std::collections::BTreeMap;

/// How many blocks the planner looks ahead (P-STUP-00070, P-STUP-00071).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LookAhead {
    /// Blocks, 10 to 10 000; default 120.
    pub blocks: u32,
}

/// What the override multiplies (P-CHAN-00066).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum OverrideMode {
    /// 0: the smaller of programmed and possible speed.
    #[default]
    Result,
    /// 1: the programmed speed.
    Programmed,
    /// 2: as 0, but as 1 while a function reduces the speed.
    ProgrammedWhileReduced,
}

/// Override of G00 (P-CHAN-00181).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum RapidOverride {
    /// One override for G00 and feed.
    #[default]
    NotUsed,
    /// The smaller of the two.
    Minimum,
    /// Its own.
    Active,
}

/// What becomes of a message to the diagnosis receiver (P-CHAN-00518).
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

/// Limits of arcs whose centre and end do not fit.
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
    /// Which ramp times G132 and G133 weight (P-CHAN-00073): 0 all, 1 to 4 one of `ramps_s`.
    pub ramp_selection: u32,
    /// Which accelerations G130 and G131 weight (P-CHAN-00001): 0 both, 1 acceleration, 2 deceleration.
    pub acc_selection: u32,
    /// Feed before the first F word in mm/s (P-CHAN-00099), `None` = F must be programmed (20008).
    pub feed_mm_s: Option<f64>,
    /// Length unit of an F word in mm/min (P-CHAN-00108 = 100: 1; 0.1: 1000).
    pub feed_unit_mm_min: f64,
    /// Members of the feed group (P-CHAN-00011), one flag per path axis.
    ///
    /// Source: TF5200 channel parameters; no axis marked: the first three.
    pub feed_axes: Vec<bool>,
    /// Limit the jerk at tangential transitions (P-CHAN-00009).
    pub limit_tangential_jerk: bool,
    /// Rule for the limits at transitions (P-CHAN-00117).
    pub transition_jerk: TransitionJerkMode,
    /// Extra limit between lines (P-CHAN-00245), 0 to 3.
    pub curvature_estimate: u8,
    /// Which ramp time bounds the jerk on polynomials (P-CHAN-00110).
    pub curve_jerk: CurveJerk,
    /// Values of `#VECTOR LIMIT ON` before the program gives others (P-CHAN-00002, 00090, 00208, 00361).
    pub vector: VectorLimits,
    /// The path acceleration limit also bounds arcs (P-CHAN-00350).
    pub vector_acc_on_arcs: bool,
    /// Limits of arcs whose centre and end do not fit.
    pub arc_centre: ArcCentre,
    /// Look-ahead.
    pub look_ahead: LookAhead,
    /// Programs start in inch (P-CHAN-00054).
    pub inch: bool,
    /// Tolerance words are inch under G70 (P-CHAN-00439).
    pub contouring_consider_inch: bool,
    /// Implicit G60 after G00 (P-CHAN-00235).
    pub exact_stop_after_g00: bool,
    /// Feed hold uses its own parameters (P-CHAN-00097).
    pub own_feed_hold: bool,
    /// Several G90 and G91 in a block, each acting from its place on (P-CHAN-00116).
    pub several_dimensions: bool,
    /// P parameters survive program start (P-CHAN-00067).
    pub keep_p_parameters: bool,
    /// What the override multiplies (P-CHAN-00066).
    pub override_mode: OverrideMode,
    /// Override in G00 (P-CHAN-00181).
    pub rapid_override: RapidOverride,
    /// Start values of G groups (P-CHAN-00063): group and G number; a preset of group 21 (feedforward) has no effect.
    pub g_groups: BTreeMap<u32, u32>,
    /// Durations of M functions in s (P-CHAN-00040).
    pub m_durations_s: BTreeMap<u32, f64>,
    /// Durations of H functions in s (P-CHAN-00026).
    pub h_durations_s: BTreeMap<u32, f64>,
    /// Subroutines called by G80 to G89 (P-CHAN-00160 to 00169), by G number.
    pub g8x_programs: BTreeMap<u32, String>,
    /// Messages to the diagnosis receiver (P-CHAN-00518).
    pub diagnosis_messages: DiagnosisMessages,
    /// Subroutine called at the start of every program (P-CHAN-00119).
    pub start_program: Option<String>,
    /// Subroutine called before the end of every program (P-CHAN-00252).
    pub end_program: Option<String>,
    /// Subroutine called by M06 (P-CHAN-00118); `None`: M06 is a function like any other.
    pub tool_change_program: Option<String>,
    /// Logical number of the main spindle (P-CHAN-00051), `None`: the first one.
    pub main_spindle: Option<u32>,
    /// Name that addresses the main spindle in the NC program (P-CHAN-00053).
    pub main_spindle_name: String,
    parameters: Parameters,
    start_up: Parameters,
}

impl Channel {
    pub(super) fn new(parameters: Parameters, start_up: Parameters, feed_axes: Vec<bool>) -> Self {
        let p = &parameters;
        let program = |key: &str| p.text(key).filter(|name| !name.is_empty());
        let choice = |key: &str| integer(p.number(key)).unwrap_or_default();
        let table = |array: &str, last: &str| -> BTreeMap<u32, f64> {
            let rows = p.settings().filter(|(_, s)| s.row.key == format!("{array}[i]{last}"));
            rows.filter_map(|(i, s)| Some((i[0], s.value.number()?))).collect()
        };
        let seconds = |array| table(array, "").into_iter().map(|(i, us)| (i, us / 1e6)).collect();
        Self {
            slope: slope(choice("prog_start.slope.profile")),
            constant_ramp_time: p.flag("prog_start.slope.mode_ramp_time"),
            ramp_selection: choice("prog_start.slope.ramp_time"),
            acc_selection: choice("prog_start.slope.acceleration"),
            feed_mm_s: p.number("prog_start.feedrate").filter(|f| *f > 0.0).map(|f| f / 60.0),
            feed_unit_mm_min: feed_unit(p.number("prog_start.feedrate_factor")),
            feed_axes,
            limit_tangential_jerk: p.flag("corr_v_trans_jerk"),
            transition_jerk: match choice("mode_trans_jerk") {
                0 => TransitionJerkMode::Coupled,
                1 => TransitionJerkMode::Independent,
                _ => TransitionJerkMode::DirectJerk,
            },
            curvature_estimate: u8::try_from(choice("trans_limit_with_curvature")).unwrap_or(3),
            curve_jerk: match choice("check_jerk_on_poly_path") {
                0 => CurveJerk::Unlimited,
                2 => CurveJerk::Ramps,
                _ => CurveJerk::Geometric,
            },
            vector: vector(p),
            vector_acc_on_arcs: p.flag("vector.cir_radial_acc_limit"),
            arc_centre: ArcCentre {
                shift_mm: p.converted("mittelpkt_diff").unwrap_or_default(),
                shift_ratio: p.converted("mittelpkt_faktor").unwrap_or_default(),
                radius_difference_mm: p.converted("max_radius_diff_circle").unwrap_or_default(),
                radius_difference_ratio: p
                    .converted("max_proz_radius_diff_circle")
                    .unwrap_or_default(),
            },
            look_ahead: look_ahead(&start_up),
            inch: p.flag("mass_einh"),
            contouring_consider_inch: p.flag("contouring_consider_inch"),
            exact_stop_after_g00: p.flag("exact_stop_after_g00"),
            own_feed_hold: p.flag("use_drive_curr_limit"),
            several_dimensions: p.flag("multi_dimension_in_block"),
            keep_p_parameters: p.flag("p_param_haltend"),
            override_mode: match choice("override_weight_prog_feed") {
                0 => OverrideMode::Result,
                1 => OverrideMode::Programmed,
                _ => OverrideMode::ProgrammedWhileReduced,
            },
            rapid_override: match p.text("g00_override_mode").as_deref() {
                Some("MINIMUM_OF_G0_G1") => RapidOverride::Minimum,
                Some("ACTIVE") => RapidOverride::Active,
                _ => RapidOverride::NotUsed,
            },
            g_groups: table("prog_start.g_gruppe", ".nr")
                .into_iter()
                .filter_map(|(group, g)| Some((group, integer(Some(g))?)))
                .collect(),
            m_durations_s: seconds("m_prozess_zeit"),
            h_durations_s: seconds("h_prozess_zeit"),
            g8x_programs: (80..90)
                .filter_map(|g| Some((g, p.text(&format!("g{g}_prog_file"))?)))
                .collect(),
            diagnosis_messages: match p.text("configuration.decoder.msg_to_default").as_deref() {
                Some("DISABLED") => DiagnosisMessages::Disabled,
                Some("WARNING") => DiagnosisMessages::Warning,
                Some("ERROR") => DiagnosisMessages::Error,
                _ => DiagnosisMessages::Standard,
            },
            start_program: program("start_init_prog_file"),
            end_program: program("final_prog_file"),
            tool_change_program: program("m6_prog_file"),
            main_spindle: Some(choice("main_spindle_ax_nr")).filter(|n| *n != 0),
            main_spindle_name: p.text("main_spindle_name").unwrap_or_default(),
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

    /// Number of a key in the units of the list, see [`Parameters::number`].
    pub fn raw(&self, key: &str) -> Option<f64> {
        self.parameters.number(key)
    }

    /// Text of a key.
    pub fn text(&self, key: &str) -> Option<String> {
        self.parameters.text(key)
    }

    /// Duration in s of a function of the spindle in place `i` of the channel list: `m3`, `m4`, `m5`, `m19` or `s`
    /// (P-CHAN-00044, 00046, 00048, 00042, 00080); 0 if the list names none.
    pub fn spindle_duration_s(&self, i: usize, function: &str) -> f64 {
        self.parameters
            .converted(&format!("spindel[{i}].{function}_prozess_zeit"))
            .unwrap_or_default()
    }
}

fn slope(profile: u32) -> SlopeKind {
    match profile {
        1 => SlopeKind::Trapez,
        2 => SlopeKind::Sin2,
        3 => SlopeKind::Hsc,
        _ => SlopeKind::Step,
    }
}

/// P-CHAN-00108: 100 is mm/min, 0.1 is m/min, -1 the same as 100.
fn feed_unit(factor: Option<f64>) -> f64 {
    match factor {
        Some(factor) if factor > 0.0 => 100.0 / factor,
        _ => 1.0,
    }
}

/// Start values of the path limits, in mm/s and mm/s2.
///
/// Assumption: without P-CHAN-00351 the accelerations are mm/min2, the unit of the older builds; their default of 1e8
/// is 27.8 m/s2 then.
fn vector(p: &Parameters) -> VectorLimits {
    let per_second = p.text("vector.acc_dec_unit").as_deref() == Some("MM_S2");
    let acc = |key| p.number(key).map(|a| if per_second { a } else { a / 3600.0 });
    VectorLimits {
        vel_mm_s: p.number("vector.velocity").map(|v| v / 60.0),
        acc_mm_s2: acc("vector.acceleration"),
        dec_mm_s2: acc("vector.deceleration"),
        radial_acc_mm_s2: acc("vector.radial_acceleration"),
        ..VectorLimits::default()
    }
}

/// Size of the look-ahead of channel 0; P-STUP-00071 acts only with the function `_CUSTOM`.
fn look_ahead(start_up: &Parameters) -> LookAhead {
    let interpolator = "configuration.channel[0].interpolator";
    let blocks = match start_up.text(&format!("{interpolator}.function")).as_deref() {
        Some("FCT_LOOK_AHEAD_LOW") => 30,
        Some("FCT_LOOK_AHEAD_STANDARD") => 70,
        Some("FCT_LOOK_AHEAD_CUSTOM") => {
            integer(start_up.number(&format!("{interpolator}.number_blocks_lah"))).unwrap_or(120)
        }
        _ => 120,
    };
    LookAhead { blocks }
}
