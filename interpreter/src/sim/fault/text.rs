//! Texts, conditions and limits of the faults of a controller.

use crate::diag::{Condition, rounded};
use crate::machine::table::axis_general as of;
use crate::machine::table::param::{Number, Param};
use kontur_filters::control::fault::{Derivative, Fault};

/// A value and its limit, with as many digits as it takes to tell them apart.
pub(in crate::sim) fn distinct(value: f64, limit: f64) -> (String, String) {
    let rough = (rounded(value), rounded(limit));
    if rough.0 != rough.1 {
        return rough;
    }
    let fine = |decimals: usize| (format!("{value:.decimals$}"), format!("{limit:.decimals$}"));
    (3..=12).map(fine).find(|(value, limit)| value != limit).unwrap_or(rough)
}

/// Value and limit of a fault, in the unit of the axis, `mm` or `deg`.
pub(in crate::sim) fn text(fault: &Fault, unit: &'static str) -> String {
    let r = rounded;
    let speed = per_s(unit, 1);
    match *fault {
        Fault::FollowingError { lag_mm, limit_mm } => {
            let (lag, limit) = distinct(lag_mm, limit_mm);
            format!("following error {lag} {unit} exceeds {limit} {unit}")
        }
        Fault::BeyondLimit { actual_mm, limit_mm } => {
            let (actual, limit) = distinct(actual_mm, limit_mm);
            format!(
                "actual position {actual} {unit} beyond the software limit with its tolerance, {limit} {unit}"
            )
        }
        Fault::SettlingTimeout { lag_mm, window_mm, time_s } => format!(
            "distance {} {unit} to the target after {} s is outside the exact-stop window of {} {unit}",
            r(lag_mm),
            r(time_s),
            r(window_mm)
        ),
        Fault::ControllerSpeed { speed_mm_s, limit_mm_s } => {
            let (value, limit) = distinct(speed_mm_s, limit_mm_s);
            format!("speed command {value} {speed} exceeds {limit} {speed}")
        }
        Fault::SetpointWarning { what, value, limit }
        | Fault::SetpointError { what, value, limit } => {
            let unit = per_s(unit, order(what));
            let quantity = what.name();
            let (value, limit) = distinct(value, limit);
            format!("{quantity} of the set position {value} {unit} exceeds {limit} {unit}")
        }
        Fault::Unstable { lag_mm, limit_mm } => format!(
            "following error {} {unit} beyond {} {unit}: the simulated axis is unstable",
            r(lag_mm),
            r(limit_mm)
        ),
        Fault::Swings { limit_mm_s } => format!(
            "at rest the additive speed of Improved Position Control keeps swinging between its limits of {} {}: the loop is unstable",
            r(limit_mm_s),
            per_s(unit, 1)
        ),
        Fault::IpcChangedMoving => {
            "parameters of Improved Position Control changed while the axis moves".to_owned()
        }
    }
}

/// Order of a derivative of the position.
pub(in crate::sim) const fn order(what: Derivative) -> usize {
    match what {
        Derivative::Velocity => 1,
        Derivative::Acceleration => 2,
        Derivative::Jerk => 3,
    }
}

/// Unit of a derivative of a position in `mm` or `deg`.
pub(in crate::sim) fn per_s(unit: &str, order: usize) -> &'static str {
    const LINEAR: [&str; 4] = ["mm", "mm/s", "mm/s2", "mm/s3"];
    const ROTARY: [&str; 4] = ["deg", "deg/s", "deg/s2", "deg/s3"];
    if unit == "deg" { ROTARY[order] } else { LINEAR[order] }
}

/// The condition of a fault; spindles have separate numbers for their speed.
pub(in crate::sim) const fn condition(fault: &Fault, spindle: bool) -> Condition {
    match fault {
        Fault::FollowingError { .. } => Condition::FollowingError,
        Fault::BeyondLimit { actual_mm, limit_mm } => {
            if *actual_mm > *limit_mm {
                Condition::ActualAbovePositiveLimit
            } else {
                Condition::ActualBelowNegativeLimit
            }
        }
        Fault::SettlingTimeout { .. } => Condition::SettlingTimeout,
        Fault::ControllerSpeed { .. } => Condition::ControllerSpeed,
        Fault::SetpointWarning { what: Derivative::Velocity, .. } if spindle => {
            Condition::SpindleSpeedWarning
        }
        Fault::SetpointError { what: Derivative::Velocity, .. } if spindle => {
            Condition::SpindleSpeedError
        }
        Fault::SetpointWarning { what: Derivative::Velocity, .. } => Condition::SpeedWarning,
        Fault::SetpointError { what: Derivative::Velocity, .. } => Condition::SpeedError,
        Fault::SetpointWarning { what: Derivative::Acceleration | Derivative::Jerk, .. } => {
            Condition::SetpointWarning
        }
        Fault::SetpointError { what: Derivative::Acceleration | Derivative::Jerk, .. } => {
            Condition::SetpointError
        }
        Fault::IpcChangedMoving => Condition::IpcChangedMoving,
        Fault::Unstable { .. } | Fault::Swings { .. } => Condition::Unstable,
    }
}

/// Parameters of the warning and of the error.
pub(in crate::sim) const fn thresholds(what: Derivative) -> (Param<Number>, Param<Number>) {
    match what {
        Derivative::Velocity => (of::SPEED_WARNING, of::SPEED_ERROR),
        Derivative::Acceleration => (of::ACC_WARNING, of::ACC_ERROR),
        Derivative::Jerk => (of::JERK_WARNING, of::JERK_ERROR),
    }
}

#[cfg(test)]
mod tests {
    use super::distinct;

    #[test]
    fn a_value_and_its_limit_are_told_apart() {
        let pair = |value, limit| {
            let (value, limit) = distinct(value, limit);
            format!("{value} {limit}")
        };
        assert_eq!(pair(108.0, 105.0), "108 105");
        assert_eq!(pair(105.001, 105.0), "105.001 105.000");
        assert_eq!(pair(105.000_000_4, 105.0), "105.0000004 105.0000000");
        assert_eq!(pair(105.0, 105.0), "105 105");
    }
}
