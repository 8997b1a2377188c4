//! Improved Position Control of one axis.

use super::control::{converted, cycles, raw};
use crate::diag::{Condition, Diagnostic, Severity, ValueKind};
use crate::machine::axis::integer;
use crate::machine::{Axis, issues};
use kontur_filters::control::Issue;
use kontur_filters::control::fault::IpcParameter;
use kontur_filters::control::ipc::{
    IpcConfig, IpcFilterConfig, IpcFilterType, IpcMode, IpcStageConfig,
};
use kontur_filters::time::CycleTime;

/// Largest P-AXIS-00757.
const MOST_LIMIT: f64 = 2000.0;
/// Keys of the function begin with this.
pub(in crate::machine) const PREFIX: &str = "lr_param.improved_position_control";

/// The function as the list states it.
pub(super) fn config(axis: &Axis) -> IpcConfig {
    IpcConfig {
        enable: axis.flag(&format!("{PREFIX}.enable")),
        limit_ratio: converted(axis, &format!("{PREFIX}.v_add_max_fact")),
        delay_cycles: cycles(axis.own("ipc.delay_cycles")),
        stages: (0..IpcConfig::MAX_STAGES).map(|index| stage(axis, index)).collect(),
        gantry_slave: false,
    }
}

/// What no configuration can hold: modes that do not exist, and a limit above the range of P-AXIS-00757.
pub(super) fn out_of_range(axis: &Axis, cycle: CycleTime) -> Vec<Diagnostic> {
    let mut found = Vec::new();
    for stage in 0..IpcConfig::MAX_STAGES {
        let value = raw(axis, &format!("{PREFIX}.stage[{stage}].mode"));
        if !(0.0..=3.0).contains(&value) {
            let issue = Issue::IpcRange { stage, what: IpcParameter::Mode, value };
            found.push(issues::control(axis, &issue, cycle));
        }
    }
    let key = format!("{PREFIX}.v_add_max_fact");
    let value = raw(axis, &key);
    if value > MOST_LIMIT {
        let what = format!("limit {value} of the additive speed, 0 to {MOST_LIMIT} (0.1 %)");
        let effect = "Improved Position Control is off for the axis";
        found.push(
            issues::about(axis, Condition::IpcRange, &key, &what, effect)
                .severity(Severity::Warning)
                .value(ValueKind::Wrong, value, "0.1%")
                .value(ValueKind::UpperLimit, MOST_LIMIT, "0.1%"),
        );
    }
    found
}

fn stage(axis: &Axis, index: usize) -> IpcStageConfig {
    let key = |name: &str| format!("{PREFIX}.stage[{index}].{name}");
    // older builds have the damping in the filter, newer ones in the stage
    let damping = [key("osc_damping"), key("filter[0].damping")];
    let damping = damping
        .iter()
        .find(|key| axis.parameters().setting(key).is_some_and(|s| s.value.number() != Some(-1.0)));
    IpcStageConfig {
        mode: match integer(axis.raw(&key("mode"))) {
            Some(1) => IpcMode::Direct,
            Some(2) => IpcMode::Indirect,
            Some(3) => IpcMode::SetPoint,
            _ => IpcMode::NotActive,
        },
        weight_num: raw(axis, &key("weight_fact_num")),
        weight_denom: raw(axis, &key("weight_fact_denom")),
        filters: (0..2).filter_map(|k| filter(axis, &key(&format!("filter[{k}]")), k)).collect(),
        oscillator_damping: damping.map_or(-1.0, |key| raw(axis, key)),
    }
}

/// Filter `k` of a stage; without a type filter 0 is the band-pass and filter 1 does not exist.
fn filter(axis: &Axis, prefix: &str, k: u32) -> Option<IpcFilterConfig> {
    let typed = format!("{prefix}.type");
    let text = axis.text(&typed).filter(|_| k == 0 || axis.parameters().setting(&typed).is_some());
    let kind = match text.as_deref() {
        Some("BANDPASS") => IpcFilterType::BandPass,
        Some("ALLPASS") => IpcFilterType::AllPass,
        _ => return None,
    };
    Some(IpcFilterConfig {
        kind,
        order: integer(axis.raw(&format!("{prefix}.order"))).unwrap_or_default(),
        frequency_hz: raw(axis, &format!("{prefix}.fg_f0")),
        quality: raw(axis, &format!("{prefix}.q_factor")),
    })
}
