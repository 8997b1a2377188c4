//! Issues of the configuration of the controller, including Improved Position Control and feedforward.

use super::about;
use crate::diag::{Condition, Diagnostic, Severity, ValueKind, rounded};
use crate::machine::Axis;
use crate::machine::table::param::{Number, Param, Place};
use crate::machine::table::{axis_drive, axis_general, axis_guard};
use crate::machine::transmission::has_rotary_motor;
use kontur_filters::{
    control::{
        Issue, fault::IpcParameter, feedforward::FeedforwardConfig, ipc::IpcStageConfig,
        plant::PlantConfig,
    },
    time::CycleTime,
};

/// The condition of the controller's configuration.
const fn control_condition(issue: &Issue) -> Condition {
    match issue {
        Issue::VelocityDelay { .. } => Condition::VelocityDelay,
        Issue::AccelerationDelay { .. } => Condition::AccelerationDelay,
        Issue::NoAdditiveVelocity => Condition::NoAdditiveVelocity,
        Issue::NoAdditiveTorque => Condition::NoAdditiveTorque,
        Issue::WithoutDelayNeedsVelocityOnly => Condition::WithoutDelayNeedsVelocityOnly,
        Issue::OutputWithoutActivation | Issue::ActiveAndDisabled => Condition::FeedforwardConflict,
        Issue::ImplausibleLoad { .. } => Condition::FeedforwardLoad,
        Issue::TorqueScaleDenominatorZero => Condition::TorqueScaleDenominator,
        Issue::NoTorqueScale => Condition::TorqueScale,
        Issue::SimulationDamping { .. } => Condition::SimulationDamping,
        Issue::DeadTime { .. } => Condition::DeadTime,
        Issue::IpcGantrySlave => Condition::IpcGantrySlave,
        Issue::IpcNumerator { .. } => Condition::IpcNumerator,
        Issue::IpcDenominator { .. } => Condition::IpcDenominator,
        Issue::IpcRange { .. } => Condition::IpcRange,
        Issue::IpcNoInput => Condition::IpcNoInput,
        Issue::IpcNoLimit => Condition::IpcNoLimit,
        Issue::IpcWeight { .. } => Condition::IpcWeight,
        Issue::IpcOverlap { .. } => Condition::IpcOverlap,
    }
}

/// A condition found while the controller was configured.
pub(crate) fn control(axis: &Axis, issue: &Issue, cycle: CycleTime) -> Diagnostic {
    let condition = control_condition(issue);
    let about =
        |place: Place, what: &str, effect: &str| about(axis, condition, place, what, effect);
    let mode = axis_drive::FEEDFORWARD.place();
    let ipc_off = "Improved Position Control is off for the axis";
    match *issue {
        Issue::VelocityDelay { delay_s } => {
            delay(axis, condition, axis_drive::FF_SPEED_DELAY, "velocity", delay_s, cycle)
        }
        Issue::AccelerationDelay { delay_s, jerk: false } => {
            delay(axis, condition, axis_drive::FF_ACC_DELAY, "acceleration", delay_s, cycle)
        }
        Issue::AccelerationDelay { delay_s, jerk: true } => {
            delay(axis, condition, axis_drive::FF_JERK_DELAY, "jerk", delay_s, cycle)
        }
        Issue::NoAdditiveVelocity => about(
            mode,
            "additive velocity feedforward, but the drive has no such input",
            "velocity feedforward is off",
        )
        .hint(additive_hint(axis, "S_0_0037", "velocity")),
        Issue::NoAdditiveTorque => about(
            mode,
            "additive torque feedforward, but the drive has no such input",
            "acceleration and jerk feedforward are off",
        )
        .hint(additive_hint(axis, "S_0_0080", "torque")),
        Issue::WithoutDelayNeedsVelocityOnly => about(
            mode,
            "acceleration or jerk feedforward without the delay of 5 cycles",
            "only velocity feedforward is on",
        ),
        Issue::OutputWithoutActivation => about(
            mode,
            "output bit of the feedforward without its activation bit",
            "no effect",
        )
        .hint("use 0x101, 0x202 and 0x804, the additive forms with both bits"),
        Issue::ActiveAndDisabled => about(
            axis_drive::FF_NEVER_ON.place(),
            "feedforward both always on (P-AXIS-00255) and never on (P-AXIS-00256)",
            "feedforward is off",
        ),
        Issue::ImplausibleLoad { torque, reference } => {
            let unit = if has_rotary_motor(axis) { "N m" } else { "N" };
            about(
                axis_drive::LOAD.place(),
                &format!(
                    "torque at maximum acceleration {} {unit}, ten times the reference torque is {}",
                    rounded(torque),
                    rounded(10.0 * reference)
                ),
                "used as it is",
            )
            .value(ValueKind::Current, torque, unit)
            .value(ValueKind::Limit, 10.0 * reference, unit)
            .hint("check the unit of `load`: kg m2 at the motor shaft, or kg for a linear motor; 1 kg cm2 is 1e-4 kg m2")
        }
        Issue::TorqueScaleDenominatorZero => {
            about(axis_drive::TORQUE_SCALE_DENOM.place(), "torque scale denominator 0", "no torque output")
                .value(ValueKind::Wrong, 0.0, "-")
        }
        Issue::NoTorqueScale => {
            let reference = axis_drive::TORQUE_REFERENCE;
            let (param, what) = if axis.listed(reference) <= 0.0 {
                (reference, "reference torque 0")
            } else {
                (axis_drive::TORQUE_SCALE_NUM, "torque scale numerator 0")
            };
            about(param.place(), what, "no torque output").value(ValueKind::Wrong, 0.0, "-")
        }
        Issue::SimulationDamping { damping_ratio } => about(
            axis_drive::SIMU_DAMPING_NUM.place(),
            &format!("damping {damping_ratio} of the simulated drive, must be below 1"),
            "0.999 is used",
        )
        .value(ValueKind::Wrong, damping_ratio, "-")
        .corrected(0.999),
        Issue::DeadTime { cycles } => {
            let max = PlantConfig::MAX_DEAD_TIME as f64;
            about(
                axis_drive::SIMU_DEAD_TIME.place(),
                &format!("dead time {cycles} cycles of the simulated drive, maximum: {max}"),
                &format!("{max} is used"),
            )
            .value(ValueKind::Wrong, cycles, "cycles")
            .value(ValueKind::UpperLimit, max, "cycles")
            .corrected(max)
        }
        Issue::IpcGantrySlave => about(
            axis_guard::IPC_ENABLE.place(),
            "Improved Position Control switched on in a gantry slave",
            "the parameters of the master apply",
        ),
        Issue::IpcNumerator { stage, value } => about(
            axis_guard::IPC_WEIGHT_NUM.at(stage as u32).place(),
            &format!("weight numerator {value}, must be greater than 0"),
            ipc_off,
        )
        .value(ValueKind::Wrong, value, "-"),
        Issue::IpcDenominator { stage, value } => about(
            axis_guard::IPC_WEIGHT_DENOM.at(stage as u32).place(),
            &format!("weight denominator {value}, must be greater than 0"),
            ipc_off,
        )
        .value(ValueKind::Wrong, value, "-"),
        Issue::IpcRange { stage, what, value } => ipc_range(axis, condition, stage, what, value, cycle),
        Issue::IpcNoInput => about(
            axis_guard::IPC_ENABLE.place(),
            "Improved Position Control while the drive closes the position loop (P-AXIS-00320) without an input for additive velocity",
            ipc_off,
        )
        .hint("enter S_0_0037 in antr.sercos.mdt[i].nc_ref, or set antr.operation_mode to CNC_POSITION_CONTROL"),
        Issue::IpcNoLimit => about(
            axis_guard::IPC_SPEED_MAX.place(),
            "Improved Position Control with an additive speed limit of 0",
            "no effect",
        ),
        Issue::IpcWeight { stage, weight } => {
            let max = IpcStageConfig::MAX_WEIGHT;
            about(
                axis_guard::IPC_WEIGHT_NUM.at(stage as u32).place(),
                &format!("weight {weight}, maximum: {max}"),
                &format!("{max} is used"),
            )
            .value(ValueKind::Wrong, weight, "-")
            .value(ValueKind::UpperLimit, max, "-")
            .corrected(max)
        }
        Issue::IpcOverlap { stages: (first, second) } => about(
            axis_guard::IPC_FREQUENCY.at(second as u32).place(),
            &format!("pass band of stage {second} overlaps with stage {first}"),
            "the stages affect each other",
        ),
    }
}

/// How to give the drive of an axis an additive input, and which ones it has.
fn additive_hint(axis: &Axis, ident: &str, input: &str) -> String {
    let simulated = axis.get(axis_general::DRIVE) == 4;
    if simulated {
        let n = axis.number();
        return format!(
            "set kontur.axis[{n}].additive.{input} to 1 to give the simulated drive (type 4) this input"
        );
    }
    let telegram = axis_drive::TELEGRAM.place().row;
    let named = axis.parameters().settings().filter(|(_, s)| s.row.key == telegram.key);
    let names: Vec<&str> = named.filter_map(|(_, s)| s.value.text()).collect();
    let present = if names.is_empty() { "nothing".to_owned() } else { names.join(", ") };
    format!("enter {ident} in antr.sercos.mdt[i].nc_ref; the telegram contains {present}")
}

fn delay(
    axis: &Axis,
    condition: Condition,
    param: Param<Number>,
    part: &str,
    delay_s: f64,
    cycle: CycleTime,
) -> Diagnostic {
    let (delay_us, limit_us) =
        (1e6 * delay_s, f64::from(cycle.us()) * FeedforwardConfig::MAX_DELAY_CYCLES as f64);
    let what =
        format!("delay of the {part} feedforward {delay_us} us, must be below {limit_us} us");
    about(axis, condition, param, &what, "0 is used")
        .value(ValueKind::Wrong, delay_us, "us")
        .value(ValueKind::UpperLimit, limit_us, "us")
        .corrected(0.0)
}

/// K-0025 with the key that states the value.
fn ipc_range(
    axis: &Axis,
    condition: Condition,
    stage: usize,
    what: IpcParameter,
    value: f64,
    cycle: CycleTime,
) -> Diagnostic {
    let stage_index = stage as u32;
    // the first filter with the value, so that the second one of a stage is named as well
    let of_filter = |first: Place| {
        let second = Place { indices: [first.indices[0], 1], ..first };
        let has = |place: &Place| {
            axis.parameters().listed(*place).is_some_and(|x| (x - value).abs() <= 0.0)
        };
        if !has(&first) && has(&second) { second } else { first }
    };
    let (place, name, range, unit) = match what {
        IpcParameter::Order => {
            let place = of_filter(axis_guard::IPC_ORDER.at(stage_index).place());
            (place, "order", "1 to 3".to_owned(), "-")
        }
        IpcParameter::Frequency => {
            let max = (0.5 / cycle.seconds()).min(500.0);
            (
                of_filter(axis_guard::IPC_FREQUENCY.at(stage_index).place()),
                "frequency",
                format!("above 0, at most {max} Hz, below half the sampling rate"),
                "Hz",
            )
        }
        IpcParameter::Quality => {
            let place = of_filter(axis_guard::IPC_QUALITY.at(stage_index).place());
            (place, "quality", "1 to 10".to_owned(), "-")
        }
        IpcParameter::Damping => {
            let newer = axis_guard::IPC_DAMPING.at(stage_index);
            let older = axis_guard::IPC_FILTER_DAMPING.at(stage_index);
            let used = if axis.set_by(newer).is_some() { newer } else { older };
            let range = "above 0 and below 1".to_owned();
            (used.place(), "damping of the oscillator", range, "-")
        }
        IpcParameter::Mode => {
            (axis_guard::IPC_MODE.at(stage_index).place(), "mode", "0 to 3".to_owned(), "-")
        }
        IpcParameter::BandPass => {
            let place = axis_guard::IPC_TYPE.at(stage_index).place();
            (place, "filters", "at least one band-pass".to_owned(), "-")
        }
    };
    let of = if unit == "-" { String::new() } else { format!(" {unit}") };
    let text = format!("{name} {value}{of} of stage {stage}, {range}");
    about(axis, condition, place, &text, "Improved Position Control is off for the axis")
        .severity(Severity::Warning)
        .value(ValueKind::Wrong, value, unit)
}
