//! Feedforward, position controller, monitors and drive formats of one axis.

use super::plant;
use crate::diag::{Condition, Diagnostic, Severity};
use crate::machine::axis::{AxisKind, integer};
use crate::machine::{Axis, issues};
use kontur_filters::control::{
    AxisControlConfig, Encoder, FeedforwardConfig, FeedforwardMode, PositionConfig, PositionLoop,
    feedforward::AdditiveInputs,
    monitor::{
        ExactStopConfig, LagMonitorConfig, LagMonitorType, SetpointMonitorConfig, Thresholds,
    },
    position::DynamicKv,
    scaling::{Motor, SpeedFormat, TimeBase, TorqueFormat},
};

/// Kind of drive (P-AXIS-00020), as far as it matters here.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Drive {
    /// 1 and 6: analogue speed command; 5: Lightbus, scaled alike (P-AXIS-00128, 00129).
    Conventional,
    /// 4: the vendor's simulation.
    Simulated,
    /// 3: `PROFIdrive`.
    Profidrive,
    /// Any other bus.
    Bus,
}

impl Drive {
    fn of(axis: &Axis) -> Self {
        match integer(axis.raw("kenngr.antr_typ")) {
            Some(1 | 5 | 6) => Self::Conventional,
            Some(3) => Self::Profidrive,
            Some(4) | None => Self::Simulated,
            Some(_) => Self::Bus,
        }
    }
}

/// Everything behind the set position but Improved Position Control, as the list states it.
pub(super) fn config(axis: &Axis, diagnostics: &mut Vec<Diagnostic>) -> AxisControlConfig {
    let limits = axis.dynamics();
    let j_max_mm_s3 = limits.a_max_mm_s2 / axis.tr_min_s();
    let drive = Drive::of(axis);
    let feedforward = feedforward(axis, drive, diagnostics);
    without_effect(axis, drive, diagnostics);
    let command_format = match drive {
        Drive::Conventional | Drive::Simulated => SpeedFormat::Gain(quotient(
            axis,
            "getriebe[0].multi_gain_z",
            "getriebe[0].multi_gain_n",
        )),
        Drive::Profidrive | Drive::Bus => resolution(axis),
    };
    AxisControlConfig {
        additive_inputs: additive_inputs(axis, drive, feedforward.mode, diagnostics),
        feedforward_format: if feedforward.mode.contains(FeedforwardMode::ADD_VEL) {
            resolution(axis)
        } else {
            command_format
        },
        feedforward,
        position: position(axis, limits.v_max_mm_s, diagnostics),
        encoder: encoder(axis),
        plant: plant::config(axis),
        lag: lag(axis, drive),
        exact_stop: exact_stop(axis),
        setpoint: setpoint(axis, limits.v_max_mm_s, limits.a_max_mm_s2, j_max_mm_s3),
        command_format,
        torque: torque(axis, diagnostics),
        ..AxisControlConfig::new(limits.v_max_mm_s, limits.a_max_mm_s2, j_max_mm_s3)
    }
}

/// Keys that say something about another gear stage or another kind of drive (K-0075).
fn without_effect(axis: &Axis, drive: Drive, diagnostics: &mut Vec<Diagnostic>) {
    let mut tell = |key: &str, what: &str, hint: &str| {
        let condition = Condition::ListNoEffect;
        diagnostics.push(issues::about(axis, condition, key, what, "no effect").hint(hint));
    };
    let of_gear = |key: &str| key.starts_with("getriebe[i]");
    let other = axis.parameters().settings().find(|([gear, _], s)| *gear > 0 && of_gear(s.row.key));
    if let Some(([gear, _], setting)) = other {
        let key =
            setting.row.key.replacen("[i]", &format!("[{gear}]"), 1).replacen("[j]", "[0]", 1);
        let what = format!("parameters of gear stage {gear}");
        tell(&key, &what, "gear stages are not changed: getriebe[0] is used");
    }
    let key = "vorsteuer.shift_time";
    // the default of the vendor's lists says nothing about another drive
    let said = axis.parameters().setting(key).and_then(|s| s.value.number());
    if drive != Drive::Profidrive && said.is_some_and(|x| x > 0.0 && (x - 3.0).abs() > 0.0) {
        tell(
            key,
            "time offset of the feedforward without PROFIdrive",
            "it holds for kenngr.antr_typ 3 only",
        );
    }
    if drive != Drive::Simulated {
        for input in ["additive.velocity", "additive.torque"] {
            if axis.own(input).is_some_and(|x| x > 0.0) {
                let key = format!("kontur.axis[{}].{input}", axis.number());
                let hint = "a bus drive has the inputs that antr.sercos.mdt[i].nc_ref names";
                tell(&key, "additive input of the simulated drive, for another drive", hint);
            }
        }
    }
}

/// Number of a key in the units of the list; every key used has a default.
pub(super) fn raw(axis: &Axis, key: &str) -> f64 {
    let value = axis.raw(key);
    debug_assert!(value.is_some(), "{key} is no number with a default");
    value.unwrap_or_default()
}

/// The same in mm (deg), s and ratios.
pub(super) fn converted(axis: &Axis, key: &str) -> f64 {
    let value = axis.converted(key);
    debug_assert!(value.is_some(), "{key} is no number with a default");
    value.unwrap_or_default()
}

fn quotient(axis: &Axis, numerator: &str, denominator: &str) -> f64 {
    raw(axis, numerator) / raw(axis, denominator)
}

/// A whole number of cycles; loading has checked its range.
pub(super) fn cycles(value: Option<f64>) -> usize {
    integer(value).unwrap_or_default() as usize
}

fn feedforward(axis: &Axis, drive: Drive, diagnostics: &mut Vec<Diagnostic>) -> FeedforwardConfig {
    let key = "vorsteuer.vorsteuerung";
    let flags = integer(axis.raw(key)).unwrap_or_default();
    let mode = FeedforwardMode::from_bits_truncate((flags & 0xFFFF) as u16);
    let unknown = flags & !u32::from(mode.bits());
    if unknown != 0 {
        diagnostics.push(
            issues::about(
                axis,
                Condition::ListRange,
                key,
                &format!("feedforward {flags:#x}"),
                "bits that mean nothing are ignored",
            )
            .hint("VEL 0x1, ACC 0x2, JERK 0x4, ADD_VEL 0x101, ADD_ACC 0x202, ADD_JERK 0x804"),
        );
    }
    for (name, part, input) in [
        ("velocity_delay_time", FeedforwardMode::ADD_VEL, "ADD_VEL"),
        ("acceleration_delay_time", FeedforwardMode::ADD_ACC, "ADD_ACC"),
        ("jerk_delay_time", FeedforwardMode::ADD_JERK, "ADD_JERK"),
    ] {
        let key = format!("vorsteuer.{name}");
        let us = raw(axis, &key);
        if us > 0.0 && !mode.is_empty() && !mode.contains(part) {
            let what = format!("delay of {us} us without the additive feedforward {input}");
            diagnostics.push(
                issues::about(axis, Condition::ListNoEffect, &key, &what, "no effect").hint(
                    format!("only additive inputs are delayed: vorsteuer.vorsteuerung {input}"),
                ),
            );
        }
    }
    let weight =
        |n: &str, d: &str| quotient(axis, &format!("vorsteuer.{n}"), &format!("vorsteuer.{d}"));
    FeedforwardConfig {
        mode,
        global_ratio: weight("vs_v_faktor", "vs_v_nenner"),
        velocity_ratio: weight("feedforward_v_add_num", "feedforward_v_add_denom"),
        acceleration_quotient: weight("vs_a_faktor", "vs_a_nenner"),
        jerk_ratio: weight("jerk_fact_num", "jerk_fact_denom"),
        velocity_delay_s: converted(axis, "vorsteuer.velocity_delay_time"),
        acceleration_delay_s: converted(axis, "vorsteuer.acceleration_delay_time"),
        jerk_delay_s: converted(axis, "vorsteuer.jerk_delay_time"),
        default_active: axis.flag("vorsteuer.default_active"),
        global_disable: axis.flag("vorsteuer.global_disable"),
        without_delay: axis.flag("vorsteuer.feedforward_without_delay"),
        // P-AXIS-00165 holds for PROFIdrive only, whatever the default
        shift_cycles: if drive == Drive::Profidrive {
            cycles(axis.raw("vorsteuer.shift_time"))
        } else {
            0
        },
    }
}

/// Additive inputs: of the simulated drive by kontur's switches, of a bus drive by what its telegram carries.
///
/// The manual's listing for torque prints `S_0_0037` again; lists copied from it are accepted with a note (70351).
fn additive_inputs(
    axis: &Axis,
    drive: Drive,
    mode: FeedforwardMode,
    diagnostics: &mut Vec<Diagnostic>,
) -> AdditiveInputs {
    if drive == Drive::Simulated {
        let on = |key: &str| axis.own(key).is_some_and(|x| x > 0.0);
        return AdditiveInputs { velocity: on("additive.velocity"), torque: on("additive.torque") };
    }
    let key = "antr.sercos.mdt[i].nc_ref";
    let named = |name: &str| {
        axis.parameters().settings().find(|(_, setting)| {
            setting.row.key == key
                && setting.value.text().is_some_and(|text| text.eq_ignore_ascii_case(name))
        })
    };
    let (velocity, torque) = (named("S_0_0037"), named("S_0_0080"));
    let uses_torque = mode.intersects(FeedforwardMode::ADD_ACC - FeedforwardMode::ACC)
        || mode.intersects(FeedforwardMode::ADD_JERK - FeedforwardMode::JERK);
    let copied = torque.is_none() && uses_torque && !mode.contains(FeedforwardMode::ADD_VEL);
    if let Some(([entry, _], _)) = velocity.filter(|_| copied) {
        let key = format!("antr.sercos.mdt[{entry}].nc_ref");
        let (what, effect) = ("additive input S_0_0037", "taken for the additive torque");
        diagnostics.push(
            issues::about(axis, Condition::NoAdditiveTorque, &key, what, effect)
                .severity(Severity::Note)
                .hint("the additive torque is S_0_0080; the manual's listing prints S_0_0037"),
        );
    }
    AdditiveInputs {
        velocity: velocity.is_some(),
        torque: torque.is_some() || (copied && velocity.is_some()),
    }
}

/// Where the position loop is closed (P-AXIS-00320).
///
/// A simulated or analogue drive takes speed commands only. Assumption: the list names no telegram of set positions
/// (PROFIdrive, CANopen), so `operation_mode` decides for them as the manual says it does for SERCOS, and
/// `DRIVE_DEFAULT` means what the commissioning manual prints as the usual case of each bus.
fn position_loop(axis: &Axis, diagnostics: &mut Vec<Diagnostic>) -> PositionLoop {
    let key = "antr.operation_mode";
    let mode = axis.text(key).unwrap_or_default();
    if mode.starts_with("OPEN_POSITION_LOOP") {
        let effect = "the loop stays closed";
        diagnostics.push(if axis.kind() == AxisKind::Spindle {
            let what = format!("{mode}, a spindle without position control");
            issues::about(axis, Condition::PositionLoop, key, &what, effect)
                .severity(Severity::Warning)
        } else {
            let what = format!("{mode}, which only spindles can have");
            issues::about(axis, Condition::AxisWithoutPositionControl, key, &what, effect)
        });
    }
    if !matches!(integer(axis.raw("kenngr.antr_typ")), Some(2 | 3 | 8))
        || mode == "CNC_POSITION_CONTROL"
    {
        return PositionLoop::Cnc;
    }
    if !mode.starts_with("OPEN_POSITION_LOOP") {
        let what = "position loop closed in the drive";
        let effect = "simulated with the law of the control and its gain kv (P-AXIS-00099)";
        diagnostics.push(issues::about(axis, Condition::PositionLoop, key, what, effect).hint(
            "set kv to the gain of the drive; CNC_POSITION_CONTROL closes the loop in the control",
        ));
    }
    PositionLoop::Drive
}

/// Assumption: the gain depends on speed if its two values differ; the manual names no switch.
fn position(axis: &Axis, v_max_mm_s: f64, diagnostics: &mut Vec<Diagnostic>) -> PositionConfig {
    let dynamic = |key: &str| converted(axis, &format!("getriebe[0].dyn_kv.{key}"));
    let dynamic_kv = DynamicKv {
        v1_mm_s: dynamic("v1"),
        kv1_per_s: dynamic("kv1"),
        v2_mm_s: dynamic("v2"),
        kv2_per_s: dynamic("kv2"),
    };
    PositionConfig {
        kv_per_s: axis.kv_1_s(),
        dynamic_kv: Some(dynamic_kv).filter(|d| (d.kv1_per_s - d.kv2_per_s).abs() > 0.0),
        v_max_mm_s,
        v_excess_ratio: converted(axis, "lr_param.dyn_monitoring_v_err"),
        dead_band_mm: converted(axis, "getriebe[0].pos_control_deadband"),
        closed_in: position_loop(axis, diagnostics),
    }
}

/// Direct if the list configures a second measuring system or `kontur.lis` says so.
fn encoder(axis: &Axis) -> Encoder {
    let keys = ["lr_hw[1].encoder_resolution_num", "lr_hw[1].encoder_resolution_denom"];
    let listed = keys.iter().any(|key| axis.parameters().setting(key).is_some());
    if listed || axis.own("load_encoder").is_some_and(|x| x > 0.0) {
        Encoder::Direct
    } else {
        Encoder::Motor
    }
}

fn lag(axis: &Axis, drive: Drive) -> LagMonitorConfig {
    // P-AXIS-00191: the default holds for digital drives
    let delay_key = "antr.nbr_delay_cycles";
    let digital = matches!(drive, Drive::Bus | Drive::Profidrive);
    let delay = digital || axis.parameters().setting(delay_key).is_some();
    let number = |key: &str| converted(axis, &format!("getriebe[0].{key}"));
    LagMonitorConfig {
        kind: match integer(axis.raw("getriebe[0].slep_ueberw_typ")) {
            Some(1) => LagMonitorType::Standard,
            Some(2) => LagMonitorType::Linear,
            Some(4) => LagMonitorType::VelocityIndependent,
            _ => LagMonitorType::Off,
        },
        dynamics: number("slep_dyn"),
        lag_max_mm: number("slep_max"),
        lag_min_mm: number("slep_min"),
        shift_s: number("slep_time_const"),
        tolerance_s: number("pos_lag_mon_error_delay_time"),
        delay_cycles: if delay { cycles(axis.raw(delay_key)) } else { 0 },
        suppress: axis.flag("kenngr.suppress_pos_lag_error"),
    }
}

/// P-AXIS-00532 rules; below 0 the older P-AXIS-00151 does. 0 of either switches off.
fn exact_stop(axis: &Axis) -> ExactStopConfig {
    let time_s = converted(axis, "getriebe[0].position_settling_time");
    let time_s =
        if time_s < 0.0 { converted(axis, "getriebe[0].pos_einschw_zeit") } else { time_s };
    ExactStopConfig { window_mm: axis.window_mm(), settling_s: Some(time_s).filter(|t| *t > 0.0) }
}

fn setpoint(
    axis: &Axis,
    v_max_mm_s: f64,
    a_max_mm_s2: f64,
    j_max_mm_s3: f64,
) -> SetpointMonitorConfig {
    let thresholds = |letter: char| Thresholds {
        warn_ratio: converted(axis, &format!("kenngr.dyn_monitoring_{letter}_warn")),
        error_ratio: converted(axis, &format!("kenngr.dyn_monitoring_{letter}_err")),
    };
    SetpointMonitorConfig {
        v_max_mm_s,
        a_max_mm_s2,
        j_max_mm_s3,
        velocity: thresholds('v'),
        acceleration: thresholds('a'),
        jerk: thresholds('j'),
    }
}

fn resolution(axis: &Axis) -> SpeedFormat {
    SpeedFormat::Resolution {
        increments: raw(axis, "antr.v_reso_num"),
        path_um: raw(axis, "antr.v_reso_denom"),
        time_base: match integer(axis.raw("antr.v_time_base")) {
            Some(1) => TimeBase::Second,
            Some(2) => TimeBase::Cycle,
            _ => TimeBase::Minute,
        },
    }
}

fn one(x: f64) -> bool {
    (x - 1.0).abs() <= 0.0
}

/// Feed constant: path in 0.1 um and the revolutions of the gear output for it.
fn feed_constant(axis: &Axis) -> [f64; 2] {
    ["antr.feed_const_num", "antr.feed_const_denom"].map(|key| raw(axis, key))
}

/// Gear ratio: revolutions of input and output.
fn gear(axis: &Axis) -> [f64; 2] {
    ["getriebe[0].gear_fact_num", "getriebe[0].gear_fact_denom"].map(|key| raw(axis, key))
}

/// Motor-side scaling (a feed constant or gear ratio other than 1) means a rotary motor, otherwise the motor of a linear
/// axis is linear.
pub(in crate::machine) fn has_rotary_motor(axis: &Axis) -> bool {
    axis.kind() != AxisKind::Linear || !feed_constant(axis).into_iter().chain(gear(axis)).all(one)
}

/// Assumption: a rotary axis without feed constant turns by 360 degrees per revolution of the gear output.
fn torque(axis: &Axis, diagnostics: &mut Vec<Diagnostic>) -> TorqueFormat {
    let (feed, gear) = (feed_constant(axis), gear(axis));
    let feed_given = !feed.into_iter().all(one);
    let motor = if has_rotary_motor(axis) {
        let turn = !feed_given && axis.kind() != AxisKind::Linear;
        Motor::Rotary {
            feed_mm: if turn { 360.0 } else { feed[0] / feed[1] / 1e4 },
            gear_ratio: gear[0] / gear[1],
        }
    } else {
        Motor::Linear
    };
    for key in ["getriebe[0].wegaufz", "getriebe[0].wegaufn"] {
        if feed_given && !one(raw(axis, key)) {
            let what = format!("encoder resolution {} beside a feed constant", raw(axis, key));
            diagnostics.push(
                issues::about(axis, Condition::ResolutionWithoutEffect, key, &what, "the feed constant rules, it has no effect")
                    .hint("older builds took the gear ratio from it: write gear_fact_num, gear_fact_denom"),
            );
        }
    }
    let key = "getriebe[0].incr_per_rev";
    let increments = raw(axis, key);
    if !feed_given && (increments - 1024.0).abs() > 0.0 {
        let what = format!("{increments} increments per revolution without a feed constant");
        diagnostics.push(
            issues::about(axis, Condition::IncrementsWithoutEffect, key, &what, "no effect")
                .hint("set antr.feed_const_num and antr.feed_const_denom as well"),
        );
    }
    TorqueFormat {
        motor,
        load: raw(axis, "getriebe[0].load"),
        real_load: axis.own("plant.inertia").filter(|x| *x > 0.0),
        reference: raw(axis, "antr.acc_reference_value"),
        scale_num: raw(axis, "antr.torque_scale_num"),
        scale_denom: raw(axis, "antr.torque_scale_denom"),
    }
}
