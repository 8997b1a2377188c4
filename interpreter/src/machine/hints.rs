//! Deviations of a list from the recommendations of the documents: notes, never errors, once per machine.
//!
//! Only entries of a list are judged; the vendor's defaults are not.

use super::kind::mode;
use super::table::param::{Number, Param, Place};
use super::table::{axis_control, axis_drive, axis_dynamics, axis_filters, axis_general};
use super::{Axis, Machine, issues};
use crate::diag::{Condition, Diagnostic, rounded};

/// Recommended range of the global feedforward weight (P-AXIS-00228 / P-AXIS-00229).
const WEIGHT_RATIO: (f64, f64) = (0.7, 1.0);
/// Recommended settling time in us (P-AXIS-00532).
const SETTLING_US: (f64, f64) = (10_000.0, 200_000.0);
/// Recommended ratio of the exact-stop window to the lag at standstill, at least (P-AXIS-00236).
const WINDOW_LAGS: f64 = 3.0;
/// Smallest filter constant of the standard lag monitor (P-AXIS-00167, with P-AXIS-00172 = 1).
const LAG_DYNAMICS_MIN: f64 = 700.0;

/// Notes about every axis.
pub(super) fn check(machine: &Machine, diagnostics: &mut Vec<Diagnostic>) {
    for axis in machine.all_axes() {
        low_passes(axis, diagnostics);
        weight(axis, diagnostics);
        settling_time(axis, diagnostics);
        window(axis, diagnostics);
        lag_monitor(axis, diagnostics);
        gantry(axis, machine, diagnostics);
        unused_mode(axis, diagnostics);
    }
}

/// Bits of the axis mode that have no effect here.
///
/// Source: P-AXIS-00015 (TF5200 axis parameters, 117192331): 0x4 counts modulo for rotary axes and spindles, 0x400 for linear axes.
fn unused_mode(axis: &Axis, diagnostics: &mut Vec<Diagnostic>) {
    let modulo = if axis.is_linear() { 0 } else { mode::MODULO };
    let turning = mode::FACE_TURNING | mode::LONGITUDINAL_TURNING;
    let gantry = mode::GANTRY_MASTER | mode::GANTRY_SLAVE;
    let without = axis.mode_bits() & !(mode::LINEAR | modulo | turning | gantry);
    if listed(axis, axis_general::MODE) && without != 0 {
        let what = format!("axis mode with the bits {without:#x}");
        let effect = "these bits are not simulated";
        let place = axis_general::MODE;
        let about = issues::about(axis, Condition::ListNoEffect, place, &what, effect);
        diagnostics.push(about.hint("the trace may differ from that of the control"));
    }
}

fn listed(axis: &Axis, param: impl Into<Place>) -> bool {
    axis.set_by(param).is_some()
}

/// BESSEL and BUTTERWORTH low-passes overshoot; from order 2 on they differ from CRIT_DAMPING.
///
/// Source: TF5200 axis filters.
fn low_passes(axis: &Axis, diagnostics: &mut Vec<Diagnostic>) {
    for index in 0..3 {
        let kind = axis_filters::TYPE.at(index);
        let prototype = axis_filters::PROTOTYPE.at(index);
        let low_pass = !listed(axis, kind) || axis.get(kind) == 1;
        let on = axis.get(axis_filters::ENABLE.at(index));
        if !on || !low_pass || axis.get(axis_filters::ORDER.at(index)) < 2 {
            continue;
        }
        let (name, how) = match axis.get(prototype) {
            2 => ("BUTTERWORTH", "considerably, and more with a higher order"),
            3 => ("BESSEL", "slightly"),
            _ => continue,
        };
        let what = format!("the {name} low-pass on the position overshoots {how}");
        let advice = "CRIT_DAMPING is recommended";
        diagnostics.push(issues::about(axis, Condition::ListAdvice, prototype, &what, advice));
    }
}

/// 0 is a permitted weight that switches feedforward off. Source: TF5200 feedforward control.
fn weight(axis: &Axis, diagnostics: &mut Vec<Diagnostic>) {
    let weight = [axis_drive::FF_WEIGHT_NUM, axis_drive::FF_WEIGHT_DENOM];
    let ratio = axis.listed(weight[0]) / axis.listed(weight[1]);
    let (low, high) = WEIGHT_RATIO;
    let recommended = ratio <= 0.0 || (low..=high).contains(&ratio);
    if weight.iter().any(|param| listed(axis, *param)) && !recommended {
        let what = format!("global weight {} of the feedforward", rounded(ratio));
        let advice = format!("{low} to {high} is recommended, above {high} the axis leads");
        diagnostics.push(issues::about(axis, Condition::ListAdvice, weight[0], &what, &advice));
    }
}

/// Source: TF5200 position monitoring.
fn settling_time(axis: &Axis, diagnostics: &mut Vec<Diagnostic>) {
    let param = axis_control::SETTLING_TIME;
    let time_us = axis.listed(param);
    let (low, high) = SETTLING_US;
    if listed(axis, param) && time_us > 0.0 && !(low..=high).contains(&time_us) {
        let what = format!("settling time {time_us} us");
        let advice = format!("{low} to {high} us are recommended");
        diagnostics.push(issues::about(axis, Condition::ListAdvice, param, &what, &advice));
    }
}

/// The lag that can remain at standstill is the dead band of the controller.
///
/// Source: TF5200 position monitoring (three times the lag). Assumption: the lag at standstill; the contribution of
/// friction is not part of any list.
fn window(axis: &Axis, diagnostics: &mut Vec<Diagnostic>) {
    let param = axis_control::WINDOW;
    let lag = axis.listed(axis_control::DEAD_BAND);
    let window = axis.listed(param);
    if window < WINDOW_LAGS * lag {
        let what = format!("exact-stop window {window}, lag at standstill up to {lag} (dead band)");
        let advice = format!("at least {WINDOW_LAGS} times the lag is recommended");
        diagnostics.push(issues::about(axis, Condition::ListAdvice, param, &what, &advice));
    }
}

/// The standard monitor estimates the lag with a filter and keeps the estimate between two limits.
///
/// Source: P-AXIS-00167 to P-AXIS-00169 (TF5200 axis parameters).
fn lag_monitor(axis: &Axis, diagnostics: &mut Vec<Diagnostic>) {
    let mut note = |param: Param<Number>, what: &str, advice: &str| {
        diagnostics.push(issues::about(axis, Condition::ListAdvice, param, what, advice));
    };
    let standard = axis.get(axis_control::LAG_MONITOR) == 1;
    let dynamics = axis.listed(axis_control::LAG_DYNAMICS);
    if standard && dynamics < LAG_DYNAMICS_MIN {
        let what = format!("filter constant {dynamics} of the standard lag monitor");
        let advice = format!("its range is {LAG_DYNAMICS_MIN} to 1024");
        note(axis_control::LAG_DYNAMICS, &what, &advice);
    }
    let [least, most] = [axis_control::LAG_MIN, axis_control::LAG_MAX].map(|p| axis.listed(p));
    if standard && most < least {
        let what = format!("maximum lag {most} below the limit at standstill {least}");
        note(axis_control::LAG_MAX, &what, "the limit at standstill applies at every speed");
    }
}

/// Source: TF5200 Improved Position Control (gantry: scaling of master and slave normally identical).
fn gantry(axis: &Axis, machine: &Machine, diagnostics: &mut Vec<Diagnostic>) {
    const SCALINGS: [[Place; 2]; 6] = [
        pair(axis_control::RESOLUTION_INCREMENTS, axis_control::RESOLUTION_PATH),
        pair(axis_control::COMMAND_GAIN_NUM, axis_control::COMMAND_GAIN_DENOM),
        pair(axis_drive::SPEED_INCREMENTS, axis_drive::SPEED_PATH),
        pair(axis_drive::FEED_CONSTANT_PATH, axis_drive::FEED_CONSTANT_REVS),
        encoder(0),
        encoder(1),
    ];
    const fn pair(numerator: Param<Number>, denominator: Param<Number>) -> [Place; 2] {
        [numerator.place(), denominator.place()]
    }
    const fn encoder(index: u32) -> [Place; 2] {
        [axis_control::ENCODER_NUM.at(index).place(), axis_control::ENCODER_DENOM.at(index).place()]
    }
    let Some(number) = axis.gantry_master() else { return };
    let Some(master) = machine.all_axes().find(|a| a.number() == number) else { return };
    racks(axis, master, diagnostics);
    for [numerator, denominator] in SCALINGS {
        let quotient = |axis: &Axis| {
            let number = |place| axis.parameters().listed(place);
            Some(number(numerator)? / number(denominator)?)
        };
        let (Some(own), Some(other)) = (quotient(axis), quotient(master)) else { continue };
        if (own - other).abs() > 1e-12 * other.abs() {
            let what = format!("scaling {own} of the gantry slave, {other} of {}", master.name());
            let advice = "both normally have the same scaling";
            diagnostics.push(issues::about(axis, Condition::ListAdvice, numerator, &what, advice));
        }
    }
}

/// Feedforward that only one side of a bridge has, and limits of the slave, which are never checked.
///
/// Source: TF5200 gantry operation, page 285697291: dynamics that have to be the same. Assumption: a slave has the
/// software limits of its master (according to the documents it takes its set positions).
fn racks(slave: &Axis, master: &Axis, diagnostics: &mut Vec<Diagnostic>) {
    let speed_mm_s = master.dynamics().v_max_mm_s;
    let lags = |on: bool| {
        (slave.lag_s(speed_mm_s, on, 1.0) - master.lag_s(speed_mm_s, on, 1.0)).abs() > 1e-9
    };
    if lags(true) && !lags(false) {
        let place = axis_drive::FEEDFORWARD;
        let what =
            format!("the feedforward of the gantry slave differs from that of {}", master.name());
        let advice = "under G135 the gantry racks by the difference of the lags";
        diagnostics.push(issues::about(slave, Condition::ListAdvice, place, &what, advice));
    }
    for param in [axis_dynamics::ACC_MAX, axis_dynamics::EMERGENCY_DEC] {
        let [own, other] = [slave, master].map(|axis| axis.get(param));
        if (own - other).abs() > 0.0 {
            let what =
                format!("{own} mm/s2 of the gantry slave, {other} mm/s2 of {}", master.name());
            let advice = "the control uses the value of the master, kontur the value of each axis";
            diagnostics.push(issues::about(slave, Condition::ListAdvice, param, &what, advice));
        }
    }
    for limit in [axis_general::LOWER_LIMIT, axis_general::UPPER_LIMIT] {
        if listed(slave, limit) && (slave.get(limit) - master.get(limit)).abs() > 0.0 {
            let what = format!("software limit {} of the gantry slave", slave.listed(limit));
            let advice = format!("not monitored, the limits of {} apply", master.name());
            diagnostics.push(issues::about(slave, Condition::ListAdvice, limit, &what, &advice));
        }
    }
}
