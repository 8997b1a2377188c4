//! Feedforward and position controller of one axis.

use super::formats::{encoder, increment_mm, resolution, torque};
use super::{monitors, plant};
use crate::diag::{Condition, Diagnostic, Severity};
use crate::machine::kind::AxisKind;
use crate::machine::table::param::{Number, Param, Place};
use crate::machine::table::{Row, axis_control, axis_drive as of, axis_general, own};
use crate::machine::{Axis, gears, issues};
use kontur_filters::control::{
    AxisControlConfig, FeedforwardConfig, FeedforwardMode, PositionConfig, PositionLoop,
    feedforward::AdditiveInputs, position::DynamicKv, scaling::SpeedFormat,
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
        match axis.get(axis_general::DRIVE) {
            1 | 5 | 6 => Self::Conventional,
            3 => Self::Profidrive,
            4 => Self::Simulated,
            _ => Self::Bus,
        }
    }
}

/// Everything downstream of the set position except Improved Position Control, as configured by the list.
pub(super) fn config(axis: &Axis, diagnostics: &mut Vec<Diagnostic>) -> AxisControlConfig {
    let limits = axis.dynamics();
    let j_max_mm_s3 = limits.a_max_mm_s2 / axis.tr_min_s();
    let drive = Drive::of(axis);
    let feedforward = feedforward(axis, drive, diagnostics);
    without_effect(axis, drive, diagnostics);
    masses(axis, diagnostics);
    let command_format = match drive {
        Drive::Conventional | Drive::Simulated => SpeedFormat::Gain(quotient(
            axis,
            axis_control::COMMAND_GAIN_NUM,
            axis_control::COMMAND_GAIN_DENOM,
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
        increment_mm: increment_mm(axis),
        plant: plant::config(axis),
        lag: monitors::lag(axis, matches!(drive, Drive::Bus | Drive::Profidrive)),
        exact_stop: monitors::exact_stop(axis),
        setpoint: monitors::setpoint(axis, limits.v_max_mm_s, limits.a_max_mm_s2, j_max_mm_s3),
        range_mm: axis.software_limits_mm().map(|limits_mm| axis.actual_range_mm(limits_mm)),
        command_format,
        torque: torque(axis, diagnostics),
        ..AxisControlConfig::new(limits.v_max_mm_s, limits.a_max_mm_s2, j_max_mm_s3)
    }
}

/// Reports keys that belong to another gear stage or another kind of drive (K-0075).
fn without_effect(axis: &Axis, drive: Drive, diagnostics: &mut Vec<Diagnostic>) {
    let mut tell = |place: Place, what: &str, hint: &str| {
        let condition = Condition::ListNoEffect;
        diagnostics.push(issues::about(axis, condition, place, what, "no effect").hint(hint));
    };
    let stages = gears::stages(axis.parameters());
    let mut settings = axis.parameters().settings();
    let number = axis_general::GEAR_NUMBER.place().row;
    let other = settings.find(|([stage, _], s)| {
        gears::is_of_gear(s.row) && !stages.contains(stage) && s.row.key != number.key
    });
    if let Some((indices, setting)) = other {
        let what = format!("parameters of getriebe[{}], which has no number", indices[0]);
        let hint =
            format!("write getriebe[{}].nummer, so that G112 can select the stage", indices[0]);
        tell(Place { row: setting.row, indices }, &what, &hint);
    }
    if let Some((place, reader)) = plant::of_another_model(axis) {
        let hint = format!("only used by {reader} in kontur.axis[i].plant.model");
        tell(place, "parameter of another model of drive and mechanics", &hint);
    }
    if let Some((indices, setting)) = plant::of_the_simulated_drive(axis) {
        let hint =
            "only used by SIMU in kontur.axis[i].plant.model; the model of kontur.lis replaces it";
        tell(Place { row: setting.row, indices }, "parameter of the simulated drive", hint);
    }
    let of_motor = |row: &Row| {
        [axis_control::ENCODER_NUM, axis_control::ENCODER_DENOM]
            .iter()
            .any(|p| p.at(0).place().row.key == row.key)
    };
    let other = axis
        .parameters()
        .settings()
        .find(|([i, _], s)| *i != 1 && of_motor(s.row) && s.is_changed());
    if let Some((indices, setting)) = other {
        let hint = "lr_hw[1] is the direct measuring system; the motor encoder has \
            getriebe[0].wegaufz and wegaufn, or getriebe[0].incr_per_rev";
        tell(Place { row: setting.row, indices }, "resolution of the motor encoder", hint);
    }
    // the default in the vendor's lists does not indicate another drive
    let said = axis.set_by(of::FF_SHIFT).and_then(|s| s.value.number());
    if drive != Drive::Profidrive && said.is_some_and(|x| x > 0.0 && (x - 3.0).abs() > 0.0) {
        tell(
            of::FF_SHIFT.place(),
            "time offset of the feedforward without PROFIdrive",
            "it only applies to kenngr.antr_typ 3",
        );
    }
    if drive != Drive::Simulated {
        for input in [own::ADDITIVE_VELOCITY, own::ADDITIVE_TORQUE] {
            if axis.get(input) {
                let hint = "a bus drive has the inputs named in antr.sercos.mdt[i].nc_ref";
                let what = "additive input of the simulated drive, for another drive";
                tell(input.at(axis.number()).place(), what, hint);
            }
        }
    }
}

/// Reports a mass of TWO_MASS that is no share of the whole.
fn masses(axis: &Axis, diagnostics: &mut Vec<Diagnostic>) {
    let Some(place) = plant::no_share(axis) else { return };
    let what = "a mass alone is a share of the whole, below 1";
    let about = issues::about(axis, Condition::ListRange, place, what, "equal masses are used");
    diagnostics.push(about.hint("write mass_motor and mass_load, of which the ratio counts"));
}

/// Quotient of two parameters in the units of the list.
fn quotient(axis: &Axis, numerator: Param<Number>, denominator: Param<Number>) -> f64 {
    axis.listed(numerator) / axis.listed(denominator)
}

fn feedforward(axis: &Axis, drive: Drive, diagnostics: &mut Vec<Diagnostic>) -> FeedforwardConfig {
    let flags = axis.get(of::FEEDFORWARD);
    let mode = FeedforwardMode::from_bits_truncate((flags & 0xFFFF) as u16);
    let unknown = flags & !u32::from(mode.bits());
    if unknown != 0 {
        diagnostics.push(
            issues::about(
                axis,
                Condition::ListRange,
                of::FEEDFORWARD,
                &format!("feedforward {flags:#x}"),
                "bits without a meaning are ignored",
            )
            .hint("VEL 0x1, ACC 0x2, JERK 0x4, ADD_VEL 0x101, ADD_ACC 0x202, ADD_JERK 0x804"),
        );
    }
    for (delay, part, input) in [
        (of::FF_SPEED_DELAY, FeedforwardMode::ADD_VEL, "ADD_VEL"),
        (of::FF_ACC_DELAY, FeedforwardMode::ADD_ACC, "ADD_ACC"),
        (of::FF_JERK_DELAY, FeedforwardMode::ADD_JERK, "ADD_JERK"),
    ] {
        let us = axis.listed(delay);
        if us > 0.0 && !mode.is_empty() && !mode.contains(part) {
            let what = format!("delay of {us} us without the additive feedforward {input}");
            diagnostics.push(
                issues::about(axis, Condition::ListNoEffect, delay, &what, "no effect").hint(
                    format!("only additive inputs are delayed: vorsteuer.vorsteuerung {input}"),
                ),
            );
        }
    }
    if mode.is_empty() && axis.get(of::FF_ALWAYS_ON) {
        let (place, what) = (of::FF_ALWAYS_ON, "feedforward always on, but none is configured");
        let about =
            issues::about(axis, Condition::ListNoEffect, place, what, "no effect until one is");
        diagnostics.push(about.hint("vorsteuer.vorsteuerung VEL (P-AXIS-00223) configures it"));
    }
    FeedforwardConfig {
        mode,
        global_ratio: quotient(axis, of::FF_WEIGHT_NUM, of::FF_WEIGHT_DENOM),
        velocity_ratio: quotient(axis, of::FF_SPEED_NUM, of::FF_SPEED_DENOM),
        acceleration_quotient: quotient(axis, of::FF_ACC_NUM, of::FF_ACC_DENOM),
        jerk_ratio: quotient(axis, of::FF_JERK_NUM, of::FF_JERK_DENOM),
        velocity_delay_s: axis.get(of::FF_SPEED_DELAY),
        acceleration_delay_s: axis.get(of::FF_ACC_DELAY),
        jerk_delay_s: axis.get(of::FF_JERK_DELAY),
        default_active: axis.get(of::FF_ALWAYS_ON),
        global_disable: axis.get(of::FF_NEVER_ON),
        without_delay: axis.get(of::FF_WITHOUT_DELAY),
        // P-AXIS-00165 applies to PROFIdrive only, whatever the default
        shift_cycles: if drive == Drive::Profidrive { axis.get(of::FF_SHIFT) as usize } else { 0 },
    }
}

/// Additive inputs: for the simulated drive by kontur's switches, for a bus drive by the content of its telegram.
///
/// The manual's listing for torque prints `S_0_0037` again; lists copied from it are accepted with a note (70351).
fn additive_inputs(
    axis: &Axis,
    drive: Drive,
    mode: FeedforwardMode,
    diagnostics: &mut Vec<Diagnostic>,
) -> AdditiveInputs {
    if drive == Drive::Simulated {
        return AdditiveInputs {
            velocity: axis.get(own::ADDITIVE_VELOCITY),
            torque: axis.get(own::ADDITIVE_TORQUE),
        };
    }
    let named = |name: &str| {
        axis.parameters().settings().find(|(_, setting)| {
            setting.row.key == of::TELEGRAM.place().row.key
                && setting.value.text().is_some_and(|text| text.eq_ignore_ascii_case(name))
        })
    };
    let (velocity, torque) = (named("S_0_0037"), named("S_0_0080"));
    let uses_torque = mode.intersects(FeedforwardMode::ADD_ACC - FeedforwardMode::ACC)
        || mode.intersects(FeedforwardMode::ADD_JERK - FeedforwardMode::JERK);
    let copied = torque.is_none() && uses_torque && !mode.contains(FeedforwardMode::ADD_VEL);
    if let Some(([entry, _], _)) = velocity.filter(|_| copied) {
        let telegram = of::TELEGRAM.at(entry);
        let (what, effect) = ("additive input S_0_0037", "used as the additive torque");
        diagnostics.push(
            issues::about(axis, Condition::NoAdditiveTorque, telegram, what, effect)
                .severity(Severity::Note)
                .hint("the additive torque is S_0_0080; the manual's listing prints S_0_0037"),
        );
    }
    AdditiveInputs {
        velocity: velocity.is_some(),
        torque: torque.is_some() || (copied && velocity.is_some()),
    }
}

/// The place where the position loop is closed (P-AXIS-00320).
///
/// A simulated or analogue drive only accepts speed commands. Assumption: the list describes no telegram of set
/// positions (PROFIdrive, CANopen), so `operation_mode` decides for them as the manual says it does for SERCOS, and
/// `DRIVE_DEFAULT` means what the commissioning manual prints as the usual case of each bus.
fn position_loop(axis: &Axis, diagnostics: &mut Vec<Diagnostic>) -> PositionLoop {
    let param = axis_control::OPERATION_MODE;
    let mode = axis.get(param).unwrap_or_default();
    if mode.starts_with("OPEN_POSITION_LOOP") {
        let effect = "the loop stays closed";
        diagnostics.push(if axis.kind() == AxisKind::Spindle {
            let what = format!("{mode}, a spindle without position control");
            issues::about(axis, Condition::PositionLoop, param, &what, effect)
                .severity(Severity::Warning)
        } else {
            let what = format!("{mode}, which only spindles can have");
            issues::about(axis, Condition::AxisWithoutPositionControl, param, &what, effect)
        });
    }
    if !matches!(axis.get(axis_general::DRIVE), 2 | 3 | 8) || mode == "CNC_POSITION_CONTROL" {
        return PositionLoop::Cnc;
    }
    if !mode.starts_with("OPEN_POSITION_LOOP") {
        let what = "position loop closed in the drive";
        let effect = "simulated with the law of the control and its gain kv (P-AXIS-00099)";
        diagnostics.push(issues::about(axis, Condition::PositionLoop, param, what, effect).hint(
            "set kv to the gain of the drive, or use CNC_POSITION_CONTROL to close the loop in the control",
        ));
    }
    PositionLoop::Drive
}

fn position(axis: &Axis, v_max_mm_s: f64, diagnostics: &mut Vec<Diagnostic>) -> PositionConfig {
    let closed_in = position_loop(axis, diagnostics);
    PositionConfig {
        kv_per_s: axis.kv_1_s(),
        dynamic_kv: dynamic_kv(axis, closed_in, diagnostics),
        v_max_mm_s,
        // switched off for gantry slaves (117763467)
        v_excess_ratio: match axis.gantry_master() {
            Some(_) => 0.0,
            None => axis.get(axis_control::SPEED_EXCESS),
        },
        dead_band_mm: axis.get(axis_control::DEAD_BAND),
        closed_in,
    }
}

/// The speed-dependent gain, `None` unless P-AXIS-00244 switches it on.
///
/// Source: TF5200 axis parameters, pages 117792395 and 117789195: SERCOS and CANopen drives have it only while the
/// control closes the loop. Assumption: values without the switch, which do not occur in lists of the engineering tool,
/// are a mistake; with the switch at 0 they are merely prepared.
fn dynamic_kv(
    axis: &Axis,
    closed_in: PositionLoop,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<DynamicKv> {
    let switch = axis_control::GAIN_BY_SPEED;
    let values = [
        axis_control::GAIN_1,
        axis_control::GAIN_SPEED_1,
        axis_control::GAIN_2,
        axis_control::GAIN_SPEED_2,
    ];
    let mut without_effect = |place: Place, what: &str, hint: &str| {
        let effect = "the gain kv (P-AXIS-00099) is used";
        diagnostics
            .push(issues::about(axis, Condition::ListNoEffect, place, what, effect).hint(hint));
    };
    if !axis.get(switch) {
        let written = values.iter().find(|value| axis.set_by(**value).is_some());
        if let Some(value) = written.filter(|_| axis.set_by(switch).is_none()) {
            without_effect(
                value.place(),
                "dynamic kv configured but not switched on",
                "set getriebe[0].dyn_kv.dyn_kv_active to 1 to switch it on, or to 0 to leave it off intentionally",
            );
        }
        return None;
    }
    if closed_in == PositionLoop::Drive && matches!(axis.get(axis_general::DRIVE), 2 | 8) {
        without_effect(
            switch.place(),
            "dynamic kv for a drive that closes the position loop",
            "use CNC_POSITION_CONTROL (P-AXIS-00320) to close the loop in the control",
        );
        return None;
    }
    let [kv1_per_s, v1_mm_s, kv2_per_s, v2_mm_s] = values.map(|value| axis.get(value));
    Some(DynamicKv { v1_mm_s, kv1_per_s, v2_mm_s, kv2_per_s })
}
