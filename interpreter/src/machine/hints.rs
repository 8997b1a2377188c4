//! What the documents recommend and a list does differently: notes, never errors, once per machine.
//!
//! Only what a list states is judged; the vendor's defaults are not.

use super::axis::integer;
use super::{Axis, Machine, issues};
use crate::diag::{Condition, Diagnostic};

/// Global weight of the feedforward that is recommended (P-AXIS-00228 / P-AXIS-00229).
const WEIGHT_RATIO: (f64, f64) = (0.7, 1.0);
/// Settling time that is recommended in us (P-AXIS-00532).
const SETTLING_US: (f64, f64) = (10_000.0, 200_000.0);
/// The exact-stop window is to be at least this many times the lag at standstill (P-AXIS-00236).
const WINDOW_LAGS: f64 = 3.0;

/// Notes about every axis.
pub(super) fn check(machine: &Machine, diagnostics: &mut Vec<Diagnostic>) {
    for axis in machine.all_axes() {
        low_passes(axis, diagnostics);
        weight(axis, diagnostics);
        settling_time(axis, diagnostics);
        window(axis, diagnostics);
        gantry(axis, machine, diagnostics);
    }
}

fn listed(axis: &Axis, key: &str) -> bool {
    axis.parameters().setting(key).is_some()
}

/// BESSEL and BUTTERWORTH low-passes overshoot; from order 2 on they differ from CRIT_DAMPING.
///
/// Source: TF5200 axis filters.
fn low_passes(axis: &Axis, diagnostics: &mut Vec<Diagnostic>) {
    for index in 0..3 {
        let key = |name: &str| format!("filter[{index}].{name}");
        let whole = |name: &str| integer(axis.raw(&key(name)));
        let low_pass = !listed(axis, &key("type")) || whole("type") == Some(1);
        if !axis.flag(&key("enable")) || !low_pass || whole("order").is_none_or(|n| n < 2) {
            continue;
        }
        let (prototype, how) = match whole("prototype") {
            Some(2) => ("BUTTERWORTH", "considerably, the more the higher its order"),
            Some(3) => ("BESSEL", "slightly"),
            _ => continue,
        };
        let what = format!("{prototype} low-pass on the position overshoots {how}");
        let advice = "CRIT_DAMPING is recommended";
        diagnostics.push(issues::about(
            axis,
            Condition::ListAdvice,
            &key("prototype"),
            &what,
            advice,
        ));
    }
}

/// 0 is a weight of its own: no feedforward. Source: TF5200 feedforward control.
fn weight(axis: &Axis, diagnostics: &mut Vec<Diagnostic>) {
    let keys = ["vorsteuer.vs_v_faktor", "vorsteuer.vs_v_nenner"];
    let [Some(numerator), Some(denominator)] = keys.map(|key| axis.raw(key)) else { return };
    let ratio = numerator / denominator;
    let (low, high) = WEIGHT_RATIO;
    let recommended = ratio <= 0.0 || (low..=high).contains(&ratio);
    if keys.iter().any(|key| listed(axis, key)) && !recommended {
        let what = format!("global weight {ratio} of the feedforward");
        let advice = format!("{low} to {high} is recommended, above {high} the axis leads");
        diagnostics.push(issues::about(axis, Condition::ListAdvice, keys[0], &what, &advice));
    }
}

/// Source: TF5200 position monitoring.
fn settling_time(axis: &Axis, diagnostics: &mut Vec<Diagnostic>) {
    let key = "getriebe[0].position_settling_time";
    let Some(time_us) = axis.raw(key).filter(|us| listed(axis, key) && *us > 0.0) else { return };
    let (low, high) = SETTLING_US;
    if !(low..=high).contains(&time_us) {
        let what = format!("settling time {time_us} us");
        let advice = format!("{low} to {high} us are recommended");
        diagnostics.push(issues::about(axis, Condition::ListAdvice, key, &what, &advice));
    }
}

/// The lag that an axis may keep at standstill is the dead band of its controller.
///
/// Source: TF5200 position monitoring (three times the lag). Assumption: the lag at standstill; what friction adds to it
/// is in no list.
fn window(axis: &Axis, diagnostics: &mut Vec<Diagnostic>) {
    let key = "getriebe[0].window";
    let lag = axis.raw("getriebe[0].pos_control_deadband").unwrap_or_default();
    let window = axis.raw(key).unwrap_or_default();
    if window < WINDOW_LAGS * lag {
        let what = format!("exact-stop window {window}, lag at standstill up to {lag} (dead band)");
        let advice = format!("at least {WINDOW_LAGS} times the lag is recommended");
        diagnostics.push(issues::about(axis, Condition::ListAdvice, key, &what, &advice));
    }
}

/// Source: TF5200 Improved Position Control (gantry: scaling of master and slave normally identical).
fn gantry(axis: &Axis, machine: &Machine, diagnostics: &mut Vec<Diagnostic>) {
    const SCALINGS: [(&str, &str); 6] = [
        ("getriebe[0].wegaufz", "getriebe[0].wegaufn"),
        ("getriebe[0].multi_gain_z", "getriebe[0].multi_gain_n"),
        ("antr.v_reso_num", "antr.v_reso_denom"),
        ("antr.feed_const_num", "antr.feed_const_denom"),
        ("lr_hw[0].encoder_resolution_num", "lr_hw[0].encoder_resolution_denom"),
        ("lr_hw[1].encoder_resolution_num", "lr_hw[1].encoder_resolution_denom"),
    ];
    let Some(number) = axis.gantry_master() else { return };
    let Some(master) = machine.all_axes().find(|a| a.number() == number) else { return };
    for (numerator, denominator) in SCALINGS {
        let quotient = |axis: &Axis| Some(axis.raw(numerator)? / axis.raw(denominator)?);
        let (Some(own), Some(other)) = (quotient(axis), quotient(master)) else { continue };
        if (own - other).abs() > 1e-12 * other.abs() {
            let what = format!("scaling {own} of the gantry slave, {other} of {}", master.name());
            let advice = "the scaling of both is normally the same";
            diagnostics.push(issues::about(axis, Condition::ListAdvice, numerator, &what, advice));
        }
    }
}
