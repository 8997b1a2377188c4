//! What the filters and the controller say about their configuration, as diagnostics with axis, parameter and place.
//!
//! The text has the order quantity, value, limit, axis, parameter; then what becomes of it.

use super::Axis;
use super::axis::AxisKind;
use super::key::Key;
use super::setup::{IPC, has_rotary_motor};
use super::table::ListKind;
use crate::diag::{Condition, Diagnostic, Severity, ValueKind};
use kontur_filters::{
    control::{
        Issue, fault::IpcParameter, feedforward::FeedforwardConfig, ipc::IpcStageConfig,
        plant::PlantConfig,
    },
    issue::{Effect, FilterIssue},
    time::CycleTime,
    vib_guard::{VibGuardError, VibGuardSettings},
};

/// A diagnostic about one parameter of an axis: what was found, what becomes of it.
pub(super) fn about(
    axis: &Axis,
    condition: Condition,
    key: &str,
    what: &str,
    effect: &str,
) -> Diagnostic {
    let row = Key::parse(key).and_then(|key| key.resolve(ListKind::Axis)).map(|(row, _)| row);
    let parameter = row.map(|row| row.id).filter(|id| !id.is_empty());
    let named = parameter.map_or_else(|| key.to_owned(), |id| format!("{key} ({id})"));
    let text = format!("{what}, axis {}, {named}: {effect}", axis.name());
    let mut diagnostic = Diagnostic::new(condition, text).axis(axis.number(), axis.name());
    diagnostic.parameter = parameter;
    diagnostic.source = axis.parameters().setting(key).and_then(|setting| setting.at.clone());
    diagnostic
}

/// Whose words a setting of a filter or of the Vibration Guard is.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Origin<'a> {
    /// The axis list: keys that begin with `filter[1]`, `filter_fir`, `lr_param.add_interface.filter[0]`, `vib_guard`.
    List(&'a str),
    /// The program, perhaps together with the list.
    Program,
}

impl Origin<'_> {
    /// [`about`] for a setting; a program's place is known to who runs it.
    fn about(
        self,
        axis: &Axis,
        condition: Condition,
        name: &str,
        what: &str,
        effect: &str,
    ) -> Diagnostic {
        match self {
            Self::List(prefix) => about(axis, condition, &format!("{prefix}.{name}"), what, effect),
            Self::Program => {
                let text = format!("{what}, axis {}: {effect}", axis.name());
                Diagnostic::new(condition, text).axis(axis.number(), axis.name())
            }
        }
    }
}

/// The condition of a filter's settings.
pub const fn filter_condition(issue: &FilterIssue) -> Condition {
    match issue {
        FilterIssue::TypeNotPermitted { .. } => Condition::FilterType,
        FilterIssue::SecondHsc => Condition::SecondHsc,
        FilterIssue::HscNotFirst => Condition::HscNotFirst,
        FilterIssue::HscPrototype => Condition::FilterHscPrototype,
        FilterIssue::HscOnSpindle => Condition::FilterHscSpindle,
        FilterIssue::HscOnInterface => Condition::FilterHscInterface,
        FilterIssue::TimeConstant { .. } => Condition::FilterTime,
        FilterIssue::OrderTimeBelowCycle { .. } => Condition::FilterTimeBelowCycle,
        FilterIssue::OrderTooHigh { .. } => Condition::FilterOrderTooHigh,
        FilterIssue::OrderCorrected { .. } => Condition::FilterOrderFixed,
        FilterIssue::NoOrder => Condition::FilterWithoutOrder,
        FilterIssue::FrequencyTooLow { .. } => Condition::FilterFrequencyTooLow,
        FilterIssue::Frequency { .. } | FilterIssue::Quality { .. } | FilterIssue::Share { .. } => {
            Condition::FilterRange
        }
        FilterIssue::AllPassNotBessel => Condition::FilterAllPass,
        FilterIssue::RemovesConstantPart => Condition::FilterConstantPart,
    }
}

/// The condition of settings that give no Vibration Guard.
const fn guard_condition(error: &VibGuardError) -> Condition {
    match error {
        VibGuardError::Mode { .. } => Condition::GuardMode,
        VibGuardError::Frequency { .. } | VibGuardError::Damping { .. } => Condition::GuardRange,
        VibGuardError::NotRealisable { .. } => Condition::GuardNotRealisable,
    }
}

/// A condition of a filter's settings, with its values.
pub(crate) fn filter(axis: &Axis, origin: Origin<'_>, issue: &FilterIssue) -> Diagnostic {
    let fir = matches!(origin, Origin::List("filter_fir"));
    let condition = match filter_condition(issue) {
        // spindles have a number of their own for the same
        Condition::FilterTime if axis.kind() == AxisKind::Spindle => Condition::SpindleFilterTime,
        condition => condition,
    };
    let effect = issue.effect();
    let becomes = match effect {
        Effect::Note => "the filter runs as configured",
        Effect::Corrected => "the filter runs with the corrected value",
        Effect::Off => "the filter is off",
    };
    let what = issue.to_string();
    let about = |name: &str| origin.about(axis, condition, name, &what, becomes);
    let diagnostic = match *issue {
        FilterIssue::TypeNotPermitted { number } => {
            about("type").value(ValueKind::Wrong, number, "-")
        }
        FilterIssue::SecondHsc
        | FilterIssue::HscNotFirst
        | FilterIssue::HscPrototype
        | FilterIssue::HscOnSpindle
        | FilterIssue::AllPassNotBessel => about("prototype"),
        FilterIssue::HscOnInterface | FilterIssue::RemovesConstantPart => about("type"),
        FilterIssue::TimeConstant { time_constant_us, min_us, max_us } => about("time_constant")
            .value(ValueKind::Wrong, time_constant_us, "us")
            .value(ValueKind::LowerLimit, min_us, "us")
            .value(ValueKind::UpperLimit, max_us, "us"),
        FilterIssue::OrderTimeBelowCycle { order_time_us, cycle_us } => {
            about(if fir { "order_time" } else { "time_constant" })
                .value(ValueKind::Wrong, order_time_us, "us")
                .value(ValueKind::LowerLimit, cycle_us, "us")
        }
        FilterIssue::OrderTooHigh { order, used } | FilterIssue::OrderCorrected { order, used } => {
            about("order")
                .value(ValueKind::Wrong, order, "-")
                .value(ValueKind::Corrected, used, "-")
                .corrected(used)
        }
        FilterIssue::NoOrder => about("order").value(ValueKind::Wrong, 0.0, "-"),
        FilterIssue::FrequencyTooLow { f_hz, used_hz } => about("fg_f0")
            .value(ValueKind::Wrong, f_hz, "Hz")
            .value(ValueKind::Corrected, used_hz, "Hz")
            .corrected(used_hz),
        FilterIssue::Frequency { f_hz, min_hz, max_hz } => {
            about(if fir { "fcut" } else { "fg_f0" })
                .value(ValueKind::Wrong, f_hz, "Hz")
                .value(ValueKind::LowerLimit, min_hz, "Hz")
                .value(ValueKind::UpperLimit, max_hz, "Hz")
        }
        FilterIssue::Quality { quality, .. } => {
            about(if fir { "quality" } else { "guete" }).value(ValueKind::Wrong, quality, "-")
        }
        FilterIssue::Share { share_ratio } => about(if fir { "share" } else { "share_percent" })
            .value(ValueKind::Wrong, 100.0 * share_ratio, "%"),
    };
    match (origin, effect) {
        (Origin::Program, Effect::Note) => diagnostic.severity(Severity::Note),
        // of a list, as the documents say: that part is off, the run goes on
        (Origin::Program, Effect::Corrected) | (Origin::List(_), Effect::Off) => {
            diagnostic.severity(Severity::Warning)
        }
        (Origin::Program, Effect::Off) | (Origin::List(_), _) => diagnostic,
    }
}

/// A filter, or Improved Position Control, that a list describes and that is off because it cannot be built.
pub fn leaves_out(diagnostic: &Diagnostic) -> bool {
    [
        Condition::FilterType,
        Condition::SecondHsc,
        Condition::HscNotFirst,
        Condition::FilterHscPrototype,
        Condition::FilterHscSpindle,
        Condition::FilterHscInterface,
        Condition::FilterTime,
        Condition::SpindleFilterTime,
        Condition::FilterTimeBelowCycle,
        Condition::FilterWithoutOrder,
        Condition::FilterRange,
        Condition::GuardNotRealisable,
        Condition::IpcRange,
        Condition::IpcNumerator,
        Condition::IpcDenominator,
        Condition::IpcNoInput,
    ]
    .iter()
    .any(|condition| diagnostic.id == *condition)
}

/// Why an axis has no Vibration Guard, with the values.
pub(crate) fn vib_guard(
    axis: &Axis,
    origin: Origin<'_>,
    error: &VibGuardError,
    cycle: CycleTime,
) -> Diagnostic {
    let condition = guard_condition(error);
    let becomes = "the Vibration Guard is off";
    let what = error.to_string();
    let about = |name: &str| origin.about(axis, condition, name, &what, becomes);
    match *error {
        VibGuardError::Mode { mode } => about("mode").value(ValueKind::Wrong, u32::from(mode), "-"),
        VibGuardError::Frequency { freq_hz } => {
            about("freq").value(ValueKind::Wrong, freq_hz, "Hz")
        }
        VibGuardError::Damping { damping } => {
            about("damping").value(ValueKind::Wrong, damping, "-")
        }
        VibGuardError::NotRealisable { freq_hz, damping } => {
            about(if damping > VibGuardSettings::MAX_DAMPING { "damping" } else { "freq" })
                .value(ValueKind::Wrong, freq_hz, "Hz")
                .value(ValueKind::Wrong, damping, "-")
                .value(ValueKind::Limit, cycle.us(), "us")
        }
    }
}

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
    let about = |key: &str, what: &str, effect: &str| about(axis, condition, key, what, effect);
    let stage_key = |stage: usize, name: &str| format!("{IPC}.stage[{stage}].{name}");
    let mode = "vorsteuer.vorsteuerung";
    let ipc_off = "Improved Position Control is off for the axis";
    match *issue {
        Issue::VelocityDelay { delay_s } => {
            delay(axis, condition, "vorsteuer.velocity_delay_time", "velocity", delay_s, cycle)
        }
        Issue::AccelerationDelay { delay_s, jerk: false } => {
            delay(axis, condition, "vorsteuer.acceleration_delay_time", "acceleration", delay_s, cycle)
        }
        Issue::AccelerationDelay { delay_s, jerk: true } => {
            delay(axis, condition, "vorsteuer.jerk_delay_time", "jerk", delay_s, cycle)
        }
        Issue::NoAdditiveVelocity => about(
            mode,
            "additive velocity feedforward, the drive has no such input",
            "the velocity part is off",
        )
        .hint(additive_hint(axis, "S_0_0037", "velocity")),
        Issue::NoAdditiveTorque => about(
            mode,
            "additive torque feedforward, the drive has no such input",
            "the acceleration and jerk parts are off",
        )
        .hint(additive_hint(axis, "S_0_0080", "torque")),
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
        Issue::IpcRange { stage, what, value } => ipc_range(axis, condition, stage, what, value, cycle),
        Issue::IpcNoInput => about(
            &format!("{IPC}.enable"),
            "Improved Position Control while the drive closes the position loop (P-AXIS-00320) and takes no additive \
             velocity",
            ipc_off,
        )
        .hint("name S_0_0037 in antr.sercos.mdt[i].nc_ref, or antr.operation_mode CNC_POSITION_CONTROL"),
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
    }
}

/// How the drive of an axis gets an additive input, and which ones it has.
fn additive_hint(axis: &Axis, ident: &str, input: &str) -> String {
    let simulated = axis.raw("kenngr.antr_typ").is_none_or(|x| (x - 4.0).abs() <= 0.0);
    if simulated {
        let n = axis.number();
        return format!(
            "the simulated drive (type 4) gets the input by kontur.axis[{n}].additive.{input} 1"
        );
    }
    let named =
        axis.parameters().settings().filter(|(_, s)| s.row.key == "antr.sercos.mdt[i].nc_ref");
    let names: Vec<&str> = named.filter_map(|(_, s)| s.value.text()).collect();
    let present = if names.is_empty() { "nothing".to_owned() } else { names.join(", ") };
    format!("name {ident} in antr.sercos.mdt[i].nc_ref; the telegram carries {present}")
}

fn delay(
    axis: &Axis,
    condition: Condition,
    key: &str,
    part: &str,
    delay_s: f64,
    cycle: CycleTime,
) -> Diagnostic {
    let (delay_us, limit_us) =
        (1e6 * delay_s, f64::from(cycle.us()) * FeedforwardConfig::MAX_DELAY_CYCLES as f64);
    let what = format!("delay of the {part} feedforward {delay_us} us, below {limit_us} us");
    about(axis, condition, key, &what, "0 is used")
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
        IpcParameter::Mode => (key("mode"), "mode", "0 to 3".to_owned(), "-"),
        IpcParameter::BandPass => {
            (key("filter[0].type"), "filters", "at least one band-pass".to_owned(), "-")
        }
    };
    let of = if unit == "-" { String::new() } else { format!(" {unit}") };
    let text = format!("{name} {value}{of} of stage {stage}, {range}");
    about(axis, condition, &key, &text, "Improved Position Control is off for the axis")
        .severity(Severity::Warning)
        .value(ValueKind::Wrong, value, unit)
}
