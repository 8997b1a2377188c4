//! Dynamics and feed of the path at the start of a program, limits of arcs, the size of the look-ahead, and splines.

use crate::machine::parameters::Parameters;
use crate::machine::table::channel as of;
use crate::machine::table::channel_hsc as hsc;
use crate::machine::table::param::{Number, Param, whole};
use crate::machine::table::start_up as from;
use kontur_motion::block::{
    CurveJerk, SlopeKind, SplineSettings, TransitionJerkMode, VectorLimits,
};

/// Dynamics of the path: slope, weighted limits, transitions and `#VECTOR LIMIT`.
#[expect(clippy::struct_excessive_bools, reason = "each is a switch of the list")]
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct PathEntries {
    /// Slope at program start (P-CHAN-00071), default STEP.
    pub(crate) slope: SlopeKind,
    /// Constant ramp time instead of constant jerk (P-CHAN-00349).
    pub(crate) constant_ramp_time: bool,
    /// The ramp times weighted by G132 and G133 (P-CHAN-00073): 0 all, 1 to 4 one of `ramps_s`.
    pub(crate) ramp_selection: u32,
    /// The accelerations weighted by G130 and G131 (P-CHAN-00001): 0 both, 1 acceleration, 2 deceleration.
    pub(crate) acc_selection: u32,
    /// Limit the jerk at tangential transitions (P-CHAN-00009).
    pub(crate) limit_tangential_jerk: bool,
    /// Rule for the limits at transitions (P-CHAN-00117).
    pub(crate) transition_jerk: TransitionJerkMode,
    /// Extra limit between lines (P-CHAN-00245), 0 to 3.
    pub(crate) curvature_estimate: u8,
    /// The ramp time that limits the jerk on polynomials (P-CHAN-00110).
    pub(crate) curve_jerk: CurveJerk,
    /// Values of `#VECTOR LIMIT ON` until the program sets others (P-CHAN-00002, 00090, 00208, 00361).
    pub(crate) vector: VectorLimits,
    /// Unit of time in s of ACC, DEC, RADIAL_ACC and RADIAL_JERK in `#VECTOR LIMIT` (P-CHAN-00351): 60 or 1.
    pub(crate) vector_time_s: f64,
    /// The path acceleration limit also applies to the centripetal acceleration (P-CHAN-00350).
    pub(crate) vector_acc_on_arcs: bool,
    /// In coordinate systems the longest ramp time of the main axes applies (P-CHAN-00758).
    pub(crate) longest_ramp_in_systems: bool,
}

impl PathEntries {
    pub(super) fn of(p: &Parameters) -> Self {
        Self {
            slope: slope(p.get(of::SLOPE)),
            constant_ramp_time: p.get(of::CONSTANT_RAMP_TIME),
            ramp_selection: p.get(of::RAMP_SELECTION),
            acc_selection: p.get(of::ACC_SELECTION),
            limit_tangential_jerk: p.get(of::LIMIT_TANGENTIAL_JERK),
            transition_jerk: match p.get(of::TRANSITION_JERK) {
                0 => TransitionJerkMode::Coupled,
                1 => TransitionJerkMode::Independent,
                _ => TransitionJerkMode::DirectJerk,
            },
            curvature_estimate: u8::try_from(p.get(of::CURVATURE_ESTIMATE)).unwrap_or(3),
            curve_jerk: match p.get(of::CURVE_JERK) {
                0 => CurveJerk::Unlimited,
                2 => CurveJerk::Ramps,
                _ => CurveJerk::Geometric,
            },
            vector: vector(p),
            vector_time_s: vector_time_s(p),
            vector_acc_on_arcs: p.get(of::PATH_ACC_ON_ARCS),
            longest_ramp_in_systems: p.get(of::LONGEST_RAMP_IN_SYSTEMS),
        }
    }
}

/// F words.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct FeedEntries {
    /// Feed rate before the first F word in mm/s (P-CHAN-00099), `None` = F must be programmed (20008).
    pub(crate) start_mm_s: Option<f64>,
    /// Length unit of an F word in mm/min (P-CHAN-00108 = 100: 1; 0.1: 1000).
    pub(crate) unit_mm_min: f64,
    /// Cutting speeds under G70 are in ft/min (P-CHAN-00360), otherwise always in m/min.
    pub(crate) cuts_in_feet: bool,
    /// Members of the feed group (P-CHAN-00011), one flag per path axis.
    ///
    /// Source: TF5200 channel parameters; if no axis is marked: the main axes, the first three at program start.
    pub(crate) axes: Vec<bool>,
    /// Whether the list marks members of the feed group; otherwise the group follows the main axes in an axis exchange
    /// (149140491).
    pub(crate) lists_axes: bool,
}

impl FeedEntries {
    pub(super) fn of(p: &Parameters, mut axes: Vec<bool>) -> Self {
        let lists_axes = axes.contains(&true);
        if !lists_axes {
            axes.iter_mut().take(3).for_each(|feed| *feed = true);
        }
        Self {
            start_mm_s: Some(p.get(of::FEED)).filter(|f| *f > 0.0).map(|f| f / 60.0),
            unit_mm_min: feed_unit(p.get(of::FEED_UNIT)),
            cuts_in_feet: p.get(of::CUTTING_IN_FEET),
            axes,
            lists_axes,
        }
    }
}

/// Limits of arcs whose centre and end point do not match.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ArcCentre {
    /// G165: largest shift of the centre in mm (P-CHAN-00059), default 2.
    pub(crate) shift_mm: f64,
    /// G165: the same relative to the radius (P-CHAN-00060), default 0.05.
    pub(crate) shift_ratio: f64,
    /// G164: largest difference of start and end radius in mm (P-CHAN-00171), default 0.005.
    pub(crate) radius_difference_mm: f64,
    /// G164: the same relative to the radius (P-CHAN-00172), default 0.001.
    pub(crate) radius_difference_ratio: f64,
}

impl ArcCentre {
    pub(super) fn of(p: &Parameters) -> Self {
        Self {
            shift_mm: p.get(of::CENTRE_SHIFT),
            shift_ratio: p.get(of::CENTRE_SHIFT_RATIO),
            radius_difference_mm: p.get(of::RADIUS_DIFFERENCE),
            radius_difference_ratio: p.get(of::RADIUS_DIFFERENCE_RATIO),
        }
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
fn feed_unit(factor: f64) -> f64 {
    if factor > 0.0 { 100.0 / factor } else { 1.0 }
}

/// Unit of time of the path accelerations in s; the default is mm/min2 (P-CHAN-00351).
fn vector_time_s(p: &Parameters) -> f64 {
    if p.get(of::PATH_ACC_UNIT).as_deref() == Some("MM_S2") { 1.0 } else { 60.0 }
}

/// Start values of the path limits, in mm/s and mm/s2.
fn vector(p: &Parameters) -> VectorLimits {
    let t = vector_time_s(p);
    let acc = |param: Param<Number>| Some(p.get(param) / (t * t));
    VectorLimits {
        vel_mm_s: Some(p.get(of::PATH_SPEED) / 60.0),
        acc_mm_s2: acc(of::PATH_ACC),
        dec_mm_s2: acc(of::PATH_DEC),
        radial_acc_mm_s2: acc(of::PATH_RADIAL_ACC),
        ..VectorLimits::default()
    }
}

/// Number of blocks in the look-ahead of channel 0; the numbers of blocks act only with the function `_CUSTOM`.
///
/// Source: TF5200 channel parameters 828925963 and 829047947. Assumption: P-CHAN-00650 takes precedence over P-STUP-00070,
/// as a list of a channel does over one of the control.
pub(super) fn look_ahead(p: &Parameters, start_up: &Parameters) -> u32 {
    let listed = p.get(of::LOOK_AHEAD).and_then(whole);
    let (functions, blocks) = match listed {
        Some(functions) => (functions, p.get(of::LOOK_AHEAD_BLOCKS)),
        None => (start_up.get(from::LOOK_AHEAD), start_up.get(from::LOOK_AHEAD_BLOCKS)),
    };
    let has = |function: u32| functions & function != 0;
    match () {
        () if has(from::CUSTOM) => blocks,
        () if has(from::LOW) => 30,
        () if has(from::HIGH) => 190,
        () => 120,
    }
}

/// Settings of `#HSC [BSPLINE]` at program start (P-CHAN-00122 to 00130).
pub(super) fn spline(p: &Parameters) -> SplineSettings {
    let angle_deg = p.get(hsc::MAX_ANGLE) / 1e4;
    SplineSettings {
        path_dev_mm: p.get(hsc::PATH_DEVIATION),
        track_dev_deg: p.get(hsc::TRACK_DEVIATION),
        off_at_path_dev: p.get(hsc::OFF_AT_PATH_DEVIATION),
        off_at_track_dev: p.get(hsc::OFF_AT_TRACK_DEVIATION),
        off_at_rapid: p.get(hsc::OFF_AT_RAPID),
        max_length_mm: p.get(hsc::MAX_LENGTH),
        max_angle_deg: SplineSettings::angle_limit_deg(angle_deg),
    }
}
