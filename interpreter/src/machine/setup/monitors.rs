//! Monitors of one axis: lag, exact stop, set positions.

use crate::machine::Axis;
use crate::machine::table::param::{Number, Param};
use crate::machine::table::{axis_control, axis_drive, axis_general};
use kontur_filters::control::monitor::{
    ExactStopConfig, LagMonitorConfig, LagMonitorType, SetpointMonitorConfig, Thresholds,
};

/// The lag monitor; the default of its delay (P-AXIS-00191) applies to digital drives.
pub(super) fn lag(axis: &Axis, digital: bool) -> LagMonitorConfig {
    let delay = digital || axis.set_by(axis_drive::LAG_DELAY).is_some();
    LagMonitorConfig {
        kind: match axis.get(axis_control::LAG_MONITOR) {
            1 => LagMonitorType::Standard,
            2 => LagMonitorType::Linear,
            4 => LagMonitorType::VelocityIndependent,
            _ => LagMonitorType::Off,
        },
        dynamics: axis.get(axis_control::LAG_DYNAMICS),
        lag_max_mm: axis.get(axis_control::LAG_MAX),
        lag_min_mm: axis.get(axis_control::LAG_MIN),
        shift_s: axis.get(axis_control::LAG_SHIFT),
        tolerance_s: axis.get(axis_control::LAG_TOLERANCE),
        delay_cycles: if delay { axis.get(axis_drive::LAG_DELAY) as usize } else { 0 },
        suppress: axis.get(axis_general::LAG_SUPPRESSED),
    }
}

/// P-AXIS-00532 applies, or the older P-AXIS-00151 if it is negative. 0 switches the monitor off.
pub(super) fn exact_stop(axis: &Axis) -> ExactStopConfig {
    let time_s = axis.get(axis_control::SETTLING_TIME);
    let time_s = if time_s < 0.0 { axis.get(axis_control::SETTLING_TIME_OLD) } else { time_s };
    let least = ExactStopConfig::default();
    ExactStopConfig {
        window_mm: axis.window_mm(),
        settling_s: Some(time_s).filter(|t| *t > 0.0),
        reached_mm: axis.filter_window_mm().max(least.reached_mm),
    }
}

/// The monitor of the set positions for these limits.
///
/// Assumption: of a gantry slave nothing is monitored. The page places the monitor in the interpolator (117562251), and
/// the interpolator does not know the slave of a static gantry (285764875).
pub(super) fn setpoint(
    axis: &Axis,
    v_max_mm_s: f64,
    a_max_mm_s2: f64,
    j_max_mm_s3: f64,
) -> SetpointMonitorConfig {
    let thresholds = |warning: Param<Number>, error: Param<Number>| {
        if axis.gantry_master().is_some() {
            return Thresholds::NEVER;
        }
        Thresholds { warn_ratio: axis.get(warning), error_ratio: axis.get(error) }
    };
    SetpointMonitorConfig {
        v_max_mm_s,
        a_max_mm_s2,
        j_max_mm_s3,
        velocity: thresholds(axis_general::SPEED_WARNING, axis_general::SPEED_ERROR),
        acceleration: thresholds(axis_general::ACC_WARNING, axis_general::ACC_ERROR),
        jerk: thresholds(axis_general::JERK_WARNING, axis_general::JERK_ERROR),
    }
}
