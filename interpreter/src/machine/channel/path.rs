//! Values of the path that several parameters make up: slope, feed unit, vector limits, look-ahead.

use super::LookAhead;
use crate::machine::parameters::Parameters;
use crate::machine::table::channel as of;
use crate::machine::table::param::{Number, Param};
use crate::machine::table::start_up as from;
use kontur_motion::block::{SlopeKind, VectorLimits};

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

/// Size of the look-ahead of channel 0; P-STUP-00071 acts only with the function `_CUSTOM`.
pub(super) fn look_ahead(start_up: &Parameters) -> LookAhead {
    let blocks = match start_up.get(from::LOOK_AHEAD).as_deref() {
        Some("FCT_LOOK_AHEAD_LOW") => 30,
        Some("FCT_LOOK_AHEAD_STANDARD") => 70,
        Some("FCT_LOOK_AHEAD_CUSTOM") => start_up.get(from::LOOK_AHEAD_BLOCKS),
        _ => 120,
    };
    LookAhead { blocks }
}
