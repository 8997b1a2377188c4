//! Measuring system of one axis, and the formats of its drive for speed and torque.

use crate::diag::{Condition, Diagnostic};
use crate::machine::kind::AxisKind;
use crate::machine::table::param::Place;
use crate::machine::table::{axis_control, axis_drive as of, own};
use crate::machine::transmission::{
    feed_constant, feed_constant_given, gear, has_rotary_motor, is_one,
};
use crate::machine::{Axis, issues};
use kontur_filters::control::Encoder;
use kontur_filters::control::scaling::{
    self, Motor, SpeedFormat, TimeBase, TorqueFormat, encoder_resolution,
};

/// Direct if the list configures a second measuring system or `kontur.lis` selects it.
pub(super) fn encoder(axis: &Axis) -> Encoder {
    let listed = [axis_control::ENCODER_NUM, axis_control::ENCODER_DENOM]
        .iter()
        .any(|param| axis.set_by(param.at(1)).is_some());
    if listed || axis.get(own::LOAD_ENCODER) { Encoder::Direct } else { Encoder::Motor }
}

/// Smallest step of the measuring system of the position loop in mm: P-AXIS-00422/00423 of a direct one, otherwise
/// `R = incr_per_rev i / f` if P-AXIS-00362 or P-AXIS-00363 is not 1, otherwise P-AXIS-00234/00233.
///
/// Assumption: an axis without measuring system parameters in its list reads without steps, so that a trace only shows
/// effects that the list configures.
pub(super) fn increment_mm(axis: &Axis) -> f64 {
    let quotient_of_set = |numerator: Place, denominator: Place| {
        let set = [numerator, denominator].iter().any(|place| axis.set_by(*place).is_some());
        let quotient = axis.listed(numerator) / axis.listed(denominator);
        if set { quotient } else { 0.0 }
    };
    let resolution = if encoder(axis) == Encoder::Direct {
        quotient_of_set(
            axis_control::ENCODER_NUM.at(1).place(),
            axis_control::ENCODER_DENOM.at(1).place(),
        )
    } else if feed_constant_given(axis) {
        let (feed, gear) = (feed_constant(axis), gear(axis));
        let increments = axis.listed(axis_control::INCREMENTS_PER_REV);
        encoder_resolution(increments, feed[0] / feed[1] / 1e4, gear[0] / gear[1])
    } else {
        quotient_of_set(
            axis_control::RESOLUTION_INCREMENTS.place(),
            axis_control::RESOLUTION_PATH.place(),
        )
    };
    scaling::increment_mm(resolution, axis.get(of::DROPPED_BITS))
}

/// Speed commands in increments per path and time.
pub(super) fn resolution(axis: &Axis) -> SpeedFormat {
    SpeedFormat::Resolution {
        increments: axis.listed(of::SPEED_INCREMENTS),
        path_um: axis.listed(of::SPEED_PATH),
        time_base: match axis.get(of::SPEED_TIME_BASE) {
            1 => TimeBase::Second,
            2 => TimeBase::Cycle,
            _ => TimeBase::Minute,
        },
    }
}

/// Torque of the motor in counts of its drive, with what the list says of it without effect.
///
/// Assumption: a rotary axis without feed constant turns by 360 degrees per revolution of the gear output.
pub(super) fn torque(axis: &Axis, diagnostics: &mut Vec<Diagnostic>) -> TorqueFormat {
    let (feed, gear) = (feed_constant(axis), gear(axis));
    let feed_given = feed_constant_given(axis);
    let motor = if has_rotary_motor(axis) {
        let turn = !feed_given && axis.kind() != AxisKind::Linear;
        Motor::Rotary {
            feed_mm: if turn { 360.0 } else { feed[0] / feed[1] / 1e4 },
            gear_ratio: gear[0] / gear[1],
        }
    } else {
        Motor::Linear
    };
    for param in [axis_control::RESOLUTION_INCREMENTS, axis_control::RESOLUTION_PATH] {
        let resolution = axis.listed(param);
        if feed_given && !is_one(resolution) {
            let what = format!("encoder resolution {resolution} in addition to a feed constant");
            diagnostics.push(
                issues::about(axis, Condition::ResolutionWithoutEffect, param, &what, "the feed constant takes precedence, the resolution has no effect")
                    .hint("older builds took the gear ratio from it: write gear_fact_num, gear_fact_denom"),
            );
        }
    }
    let param = axis_control::INCREMENTS_PER_REV;
    let increments = axis.listed(param);
    if !feed_given && (increments - 1024.0).abs() > 0.0 {
        let what = format!("{increments} increments per revolution without a feed constant");
        diagnostics.push(
            issues::about(axis, Condition::IncrementsWithoutEffect, param, &what, "no effect")
                .hint("set antr.feed_const_num and antr.feed_const_denom as well"),
        );
    }
    TorqueFormat {
        motor,
        load: axis.listed(of::LOAD),
        real_load: Some(axis.get(own::INERTIA)).filter(|x| *x > 0.0),
        reference: axis.listed(of::TORQUE_REFERENCE),
        scale_num: axis.listed(of::TORQUE_SCALE_NUM),
        scale_denom: axis.listed(of::TORQUE_SCALE_DENOM),
    }
}
