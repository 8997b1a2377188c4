//! Values of the path that several parameters make up: slope, feed unit, vector limits, look-ahead, splines.

use super::LookAhead;
use crate::machine::parameters::Parameters;
use crate::machine::table::channel as of;
use crate::machine::table::channel_hsc as hsc;
use crate::machine::table::param::{Number, Param, whole};
use crate::machine::table::start_up as from;
use kontur_motion::block::{SlopeKind, SplineSettings, VectorLimits};

pub(super) fn slope(profile: u32) -> SlopeKind {
    match profile {
        1 => SlopeKind::Trapez,
        2 => SlopeKind::Sin2,
        3 => SlopeKind::Hsc,
        _ => SlopeKind::Step,
    }
}

/// P-CHAN-00108: 100 is mm/min, 0.1 is m/min, -1 the same as 100.
pub(super) fn feed_unit(factor: f64) -> f64 {
    if factor > 0.0 { 100.0 / factor } else { 1.0 }
}

/// Unit of time of the path accelerations in s; the default is mm/min2 (P-CHAN-00351).
pub(super) fn vector_time_s(p: &Parameters) -> f64 {
    if p.get(of::PATH_ACC_UNIT).as_deref() == Some("MM_S2") { 1.0 } else { 60.0 }
}

/// Start values of the path limits, in mm/s and mm/s2.
pub(super) fn vector(p: &Parameters) -> VectorLimits {
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

/// Size of the look-ahead of channel 0; the numbers of blocks act only with the function `_CUSTOM`.
///
/// Source: TF5200 channel parameters 828925963 and 829047947. Assumption: P-CHAN-00650 takes precedence over P-STUP-00070,
/// as a list of a channel does over one of the control.
pub(super) fn look_ahead(p: &Parameters, start_up: &Parameters) -> LookAhead {
    let listed = p.get(of::LOOK_AHEAD).and_then(whole);
    let (functions, blocks) = match listed {
        Some(functions) => (functions, p.get(of::LOOK_AHEAD_BLOCKS)),
        None => (start_up.get(from::LOOK_AHEAD), start_up.get(from::LOOK_AHEAD_BLOCKS)),
    };
    let has = |function: u32| functions & function != 0;
    let blocks = match () {
        () if has(from::CUSTOM) => blocks,
        () if has(from::LOW) => 30,
        () if has(from::HIGH) => 190,
        () => 120,
    };
    LookAhead { blocks }
}

/// Settings of `#HSC [BSPLINE]` at program start (P-CHAN-00122 to 00130).
///
/// Assumption: an angle of 0, the default of P-CHAN-00125, is no limit, as for the other limits; read literally it would end a
/// spline at every block. Rapid blocks end a spline unless the list states P-CHAN-00128.
pub(super) fn spline(p: &Parameters) -> SplineSettings {
    let angle_deg = p.get(hsc::MAX_ANGLE) / 1e4;
    SplineSettings {
        path_dev_mm: p.get(hsc::PATH_DEVIATION),
        track_dev_deg: p.get(hsc::TRACK_DEVIATION),
        off_at_path_dev: p.get(hsc::OFF_AT_PATH_DEVIATION),
        off_at_track_dev: p.get(hsc::OFF_AT_TRACK_DEVIATION),
        off_at_rapid: p.get(hsc::OFF_AT_RAPID).is_none_or(|on| on > 0.0),
        max_length_mm: p.get(hsc::MAX_LENGTH),
        max_angle_deg: if angle_deg > 0.0 { angle_deg.min(180.0) } else { 180.0 },
    }
}
