//! What the filters and the controller say about their configuration, as diagnostics with axis, parameter and place.
//!
//! The text has the order quantity, value, limit, axis, parameter; then what becomes of it.

use super::Axis;
use super::axis::AxisKind;
use super::key::Key;
use super::setup::{IPC, has_rotary_motor};
use super::table::ListKind;
use crate::diag::{Diagnostic, Id, ValueKind};
use kontur_filters::{
    control::{
        ErrorId, Issue, fault::IpcParameter, feedforward::FeedforwardConfig, ipc::IpcStageConfig,
        plant::PlantConfig,
    },
    issue::{Effect, FilterIssue, IssueId, OwnId},
    time::CycleTime,
    vib_guard::{VibGuardError, VibGuardSettings},
};

/// A diagnostic about one parameter of an axis: what was found, what becomes of it.
pub(super) fn about(axis: &Axis, id: Id, key: &str, what: &str, effect: &str) -> Diagnostic {
    let row = Key::parse(key).and_then(|key| key.resolve(ListKind::Axis)).map(|(row, _)| row);
    let parameter = row.map(|row| row.id).filter(|id| !id.is_empty());
    let named = parameter.map_or_else(|| key.to_owned(), |id| format!("{key} ({id})"));
    let text = format!("{what}, axis {}, {named}: {effect}", axis.name());
    let mut diagnostic = Diagnostic::new(id, text).axis(axis.number(), axis.name());
    diagnostic.parameter = parameter;
    diagnostic.source = axis.parameters().setting(key).and_then(|setting| setting.at.clone());
    diagnostic
}

/// [`about`] with a number of the vendor's.
pub(super) fn vendor(axis: &Axis, id: u32, key: &str, what: &str, effect: &str) -> Diagnostic {
    about(axis, Id::Vendor(id), key, what, effect)
}

/// [`about`] with a number of kontur's own.
pub(super) fn kontur(axis: &Axis, id: u16, key: &str, what: &str, effect: &str) -> Diagnostic {
    about(axis, Id::Kontur(id), key, what, effect)
}

/// Number of a condition of the filters and of the Vibration Guard.
pub fn filter_id(id: IssueId) -> Id {
    match id {
        IssueId::Vendor(number) => Id::Vendor(number),
        IssueId::Own(own) => Id::Kontur(match own {
            OwnId::FilterRange => 33,
            OwnId::VibGuardRange => 34,
            OwnId::OrderCorrected => 36,
            OwnId::AllPassNotBessel => 37,
            OwnId::RemovesConstantPart => 38,
            OwnId::HscPrototype => 39,
            OwnId::HscOnSpindle => 40,
            OwnId::HscOnInterface => 41,
        }),
    }
}

/// Number of a condition of the controller.
pub fn control_id(id: ErrorId) -> Id {
    match id {
        ErrorId::Vendor(number) => Id::Vendor(number),
        ErrorId::Kontur(number) => Id::Kontur(number),
    }
}

/// A condition of the filter whose keys begin with `prefix`: `filter[1]`, `filter_fir`,
/// `lr_param.add_interface.filter[0]`.
pub fn filter(axis: &Axis, prefix: &str, issue: &FilterIssue) -> Diagnostic {
    let fir = prefix == "filter_fir";
    let key = |name: &str| {
        let name = match name {
            "share_percent" if fir => "share",
            "time_constant" if fir => "order_time",
            "fg_f0" if fir => "fcut",
            "guete" if fir => "quality",
            name => name,
        };
        format!("{prefix}.{name}")
    };
    let mut id = filter_id(issue.id());
    if axis.kind() == AxisKind::Spindle && id == Id::Vendor(50663) {
        id = Id::Vendor(60311);
    }
    let effect = match issue.effect() {
        Effect::Note => "the filter runs as configured",
        Effect::Corrected => "the filter runs with the corrected value",
        Effect::Off => "the filter is off",
    };
    let about = |name: &str, what: &str| about(axis, id, &key(name), what, effect);
    match *issue {
        FilterIssue::TypeNotPermitted { number } => about("type", &format!("filter type {number}, 1 to 12 without 7 and 9 exist"))
            .value(ValueKind::Wrong, number, "-"),
        FilterIssue::SecondHsc => about("prototype", "second HSC filter, an axis has one at most"),
        FilterIssue::HscNotFirst => about("prototype", "HSC filter that is not the first filter")
            .hint("write it as filter[0]"),
        FilterIssue::HscPrototype => {
            about("prototype", "HSC type without the prototype HSC, or the prototype HSC with another type")
                .hint("prototype HSC goes with type HSC_MEAN (8) or 12")
        }
        FilterIssue::HscOnSpindle => about("prototype", "HSC filter of a spindle"),
        FilterIssue::HscOnInterface => about("type", "HSC filter of the additional interface")
            .hint("the additional interface has the types LOWPASS to PT1, PT2 and TIME_DELAY"),
        FilterIssue::TimeConstant { time_constant_us, min_us, max_us } => about(
            "time_constant",
            &format!("filter time constant {time_constant_us} us, {min_us} to {max_us} us are allowed"),
        )
        .value(ValueKind::Wrong, time_constant_us, "us")
        .value(ValueKind::LowerLimit, min_us, "us")
        .value(ValueKind::UpperLimit, max_us, "us"),
        FilterIssue::OrderTimeBelowCycle { order_time_us, cycle_us } => about(
            "time_constant",
            &format!("time that gives the filter order {order_time_us} us, at least the cycle of {cycle_us} us"),
        )
        .value(ValueKind::Wrong, order_time_us, "us")
        .value(ValueKind::LowerLimit, cycle_us, "us"),
        FilterIssue::OrderTooHigh { order, used } => {
            about("order", &format!("filter order {order}, at most {used}"))
                .value(ValueKind::Wrong, order, "-")
                .value(ValueKind::Corrected, used, "-")
                .corrected(used)
        }
        FilterIssue::OrderCorrected { order, used } => {
            about("order", &format!("filter order {order}, the type has {used}"))
                .value(ValueKind::Wrong, order, "-")
                .value(ValueKind::Corrected, used, "-")
                .corrected(used)
        }
        FilterIssue::NoOrder => about("order", "filter order 0 and no time that gives one")
            .value(ValueKind::Wrong, 0.0, "-"),
        FilterIssue::FrequencyTooLow { f_hz, used_hz } => {
            about("fg_f0", &format!("filter frequency {f_hz} Hz, at least {used_hz} Hz"))
                .value(ValueKind::Wrong, f_hz, "Hz")
                .value(ValueKind::Corrected, used_hz, "Hz")
                .corrected(used_hz)
        }
        FilterIssue::Frequency { f_hz, min_hz, max_hz } => about(
            "fg_f0",
            &format!("filter frequency {f_hz} Hz, {min_hz} to below {max_hz} Hz are allowed"),
        )
        .value(ValueKind::Wrong, f_hz, "Hz")
        .value(ValueKind::LowerLimit, min_hz, "Hz")
        .value(ValueKind::UpperLimit, max_hz, "Hz"),
        FilterIssue::Quality { quality } => {
            let range = if fir { "above 0 to 1" } else { "1 to 10" };
            about("guete", &format!("filter quality {quality}, {range} is allowed"))
                .value(ValueKind::Wrong, quality, "-")
        }
        FilterIssue::Share { share_ratio } => {
            let percent = 100.0 * share_ratio;
            about("share_percent", &format!("filter share {percent} %, 0 to 100 % are allowed"))
                .value(ValueKind::Wrong, percent, "%")
        }
        FilterIssue::AllPassNotBessel => about("prototype", "all-pass that is not BESSEL")
            .hint("only the prototype BESSEL gives an all-pass with flat delay"),
        FilterIssue::RemovesConstantPart => about("type", "high-pass or band-pass on a position")
            .hint("it takes the constant part out: the axis only follows the motion relative to where it stood"),
    }
}

/// A condition of the Vibration Guard of the list.
pub fn vib_guard(axis: &Axis, error: &VibGuardError) -> Diagnostic {
    let id = filter_id(error.id());
    let effect = "the Vibration Guard is off";
    match *error {
        VibGuardError::Mode { mode } => {
            let what = format!("Vibration Guard mode {mode}, 1 to 4 are allowed");
            about(axis, id, "vib_guard.mode", &what, effect).value(
                ValueKind::Wrong,
                u32::from(mode),
                "-",
            )
        }
        VibGuardError::Frequency { freq_hz } => {
            let what = format!("Vibration Guard frequency {freq_hz} Hz, at least 1 Hz");
            about(axis, id, "vib_guard.freq", &what, effect).value(ValueKind::Wrong, freq_hz, "Hz")
        }
        VibGuardError::Damping { damping } => {
            let what = format!("Vibration Guard damping {damping}, 0 to 1 are allowed");
            about(axis, id, "vib_guard.damping", &what, effect).value(
                ValueKind::Wrong,
                damping,
                "-",
            )
        }
        VibGuardError::NotRealisable { freq_hz, damping } => {
            let max = VibGuardSettings::MAX_DAMPING;
            let what = format!(
                "Vibration Guard frequency {freq_hz} Hz with damping {damping}, half a damped period is at least \
                 one cycle and the damping at most {max}"
            );
            let key = if damping > max { "vib_guard.damping" } else { "vib_guard.freq" };
            about(axis, id, key, &what, effect).value(ValueKind::Wrong, freq_hz, "Hz").value(
                ValueKind::Wrong,
                damping,
                "-",
            )
        }
    }
}

/// A condition found while the controller was configured.
pub fn control(axis: &Axis, issue: &Issue, cycle: CycleTime) -> Diagnostic {
    let id = control_id(issue.id());
    let about = |key: &str, what: &str, effect: &str| about(axis, id, key, what, effect);
    let stage_key = |stage: usize, name: &str| format!("{IPC}.stage[{stage}].{name}");
    let mode = "vorsteuer.vorsteuerung";
    let ipc_off = "Improved Position Control is off for the axis";
    match *issue {
        Issue::VelocityDelay { delay_s } => {
            delay(axis, id, "vorsteuer.velocity_delay_time", "velocity", delay_s, cycle)
        }
        Issue::AccelerationDelay { delay_s, jerk: false } => {
            delay(axis, id, "vorsteuer.acceleration_delay_time", "acceleration", delay_s, cycle)
        }
        Issue::AccelerationDelay { delay_s, jerk: true } => {
            delay(axis, id, "vorsteuer.jerk_delay_time", "jerk", delay_s, cycle)
        }
        Issue::NoAdditiveVelocity => about(
            mode,
            "additive velocity feedforward, the drive has no such input",
            "the velocity part is off",
        )
        .hint("name S_0_0037 in antr.sercos.mdt[i].nc_ref; simulated drive: kontur.axis[n].additive.velocity 1"),
        Issue::NoAdditiveTorque => about(
            mode,
            "additive torque feedforward, the drive has no such input",
            "the acceleration and jerk parts are off",
        )
        .hint("name S_0_0080 in antr.sercos.mdt[i].nc_ref; simulated drive: kontur.axis[n].additive.torque 1"),
        Issue::WithoutDelayNeedsVelocityOnly => about(
            mode,
            "acceleration or jerk feedforward without the delay of 5 cycles",
            "only the velocity part is on",
        ),
        Issue::OutputWithoutActivation => about(
            mode,
            "output bit of the feedforward without its activation bit",
            "no effect",
        )
        .hint("0x101, 0x202 and 0x804 are the additive parts with both bits"),
        Issue::ActiveAndDisabled => about(
            "vorsteuer.global_disable",
            "feedforward always on (P-AXIS-00255) and never on (P-AXIS-00256)",
            "it is off",
        ),
        Issue::ImplausibleLoad { torque, reference } => {
            let unit = if has_rotary_motor(axis) { "N m" } else { "N" };
            about(
                "getriebe[0].load",
                &format!("torque at the largest acceleration {torque} {unit}, ten times the reference is {}", 10.0 * reference),
                "used as it is",
            )
            .value(ValueKind::Current, torque, unit)
            .value(ValueKind::Limit, 10.0 * reference, unit)
            .hint("check the unit of the load: kg m2 at the motor shaft, or kg of a linear motor; 1 kg cm2 is 1e-4 kg m2")
        }
        Issue::TorqueScaleDenominatorZero => {
            about("antr.torque_scale_denom", "torque scale denominator 0", "no torque output")
                .value(ValueKind::Wrong, 0.0, "-")
        }
        Issue::NoTorqueScale => {
            let reference = "antr.acc_reference_value";
            let zero = axis.raw(reference).is_none_or(|x| x <= 0.0);
            let (key, what) = if zero {
                (reference, "reference torque 0")
            } else {
                ("antr.torque_scale_num", "torque scale numerator 0")
            };
            about(key, what, "no torque output").value(ValueKind::Wrong, 0.0, "-")
        }
        Issue::SimulationDamping { damping_ratio } => about(
            "antr.simu.daempfung_z",
            &format!("damping {damping_ratio} of the simulated drive, below 1"),
            "0.999 is used",
        )
        .value(ValueKind::Wrong, damping_ratio, "-")
        .corrected(0.999),
        Issue::DeadTime { cycles } => {
            let max = PlantConfig::MAX_DEAD_TIME as f64;
            about(
                "antr.simu.totzeit",
                &format!("dead time {cycles} cycles of the simulated drive, at most {max}"),
                &format!("{max} is used"),
            )
            .value(ValueKind::Wrong, cycles, "cycles")
            .value(ValueKind::UpperLimit, max, "cycles")
            .corrected(max)
        }
        Issue::IpcGantrySlave => about(
            &format!("{IPC}.enable"),
            "Improved Position Control switched on in a gantry slave",
            "the parameters of the master apply",
        ),
        Issue::IpcNumerator { stage, value } => about(
            &stage_key(stage, "weight_fact_num"),
            &format!("weight numerator {value}, it must be above 0"),
            ipc_off,
        )
        .value(ValueKind::Wrong, value, "-"),
        Issue::IpcDenominator { stage, value } => about(
            &stage_key(stage, "weight_fact_denom"),
            &format!("weight denominator {value}, it must be above 0"),
            ipc_off,
        )
        .value(ValueKind::Wrong, value, "-"),
        Issue::IpcRange { stage, what, value } => ipc_range(axis, id, stage, what, value, cycle),
        Issue::IpcNoLimit => about(
            &format!("{IPC}.v_add_max_fact"),
            "Improved Position Control with the limit 0 of its additive speed",
            "no effect",
        ),
        Issue::IpcWeight { stage, weight } => {
            let max = IpcStageConfig::MAX_WEIGHT;
            about(
                &stage_key(stage, "weight_fact_num"),
                &format!("weight {weight}, at most {max}"),
                &format!("{max} is used"),
            )
            .value(ValueKind::Wrong, weight, "-")
            .value(ValueKind::UpperLimit, max, "-")
            .corrected(max)
        }
        Issue::IpcOverlap { stages: (first, second) } => about(
            &stage_key(second, "filter[0].fg_f0"),
            &format!("pass band of stage {second} that overlaps with that of stage {first}"),
            "they influence each other",
        ),
        _ => about(mode, "configuration of the controller", "see the ID"),
    }
}

fn delay(axis: &Axis, id: Id, key: &str, part: &str, delay_s: f64, cycle: CycleTime) -> Diagnostic {
    let (delay_us, limit_us) =
        (1e6 * delay_s, f64::from(cycle.us()) * FeedforwardConfig::MAX_DELAY_CYCLES as f64);
    let what = format!("delay of the {part} feedforward {delay_us} us, below {limit_us} us");
    about(axis, id, key, &what, "0 is used")
        .value(ValueKind::Wrong, delay_us, "us")
        .value(ValueKind::UpperLimit, limit_us, "us")
        .corrected(0.0)
}

/// K-0025 with the key that states the value.
fn ipc_range(
    axis: &Axis,
    id: Id,
    stage: usize,
    what: IpcParameter,
    value: f64,
    cycle: CycleTime,
) -> Diagnostic {
    let key = |name: &str| format!("{IPC}.stage[{stage}].{name}");
    // the first filter that has the value, so that the second one of a stage is named too
    let of_filter = |name: &str| {
        let keys = [key(&format!("filter[0].{name}")), key(&format!("filter[1].{name}"))];
        let found = keys.iter().find(|key| axis.raw(key).is_some_and(|x| (x - value).abs() <= 0.0));
        found.unwrap_or(&keys[0]).clone()
    };
    let (key, name, range, unit) = match what {
        IpcParameter::Order => (of_filter("order"), "order", "1 to 3".to_owned(), "-"),
        IpcParameter::Frequency => {
            let max = (0.5 / cycle.seconds()).min(500.0);
            (
                of_filter("fg_f0"),
                "frequency",
                format!("above 0, at most {max} Hz, below half the sampling rate"),
                "Hz",
            )
        }
        IpcParameter::Quality => (of_filter("q_factor"), "quality", "1 to 10".to_owned(), "-"),
        IpcParameter::Damping => {
            let newer = key("osc_damping");
            let used = axis.parameters().setting(&newer).is_some();
            let key = if used { newer } else { key("filter[0].damping") };
            (key, "damping of the oscillator", "above 0 and below 1".to_owned(), "-")
        }
        IpcParameter::BandPass => {
            (key("filter[0].type"), "filters", "at least one band-pass".to_owned(), "-")
        }
    };
    let of = if unit == "-" { String::new() } else { format!(" {unit}") };
    let text = format!("{name} {value}{of} of stage {stage}, {range}");
    about(axis, id, &key, &text, "Improved Position Control is off for the axis").value(
        ValueKind::Wrong,
        value,
        unit,
    )
}
