//! Improved Position Control of one axis.

use crate::diag::{Condition, Diagnostic, Severity, ValueKind};
use crate::machine::table::param::{Number, Param};
use crate::machine::table::{axis_guard as of, own};
use crate::machine::{Axis, issues};
use kontur_filters::control::Issue;
use kontur_filters::control::fault::IpcParameter;
use kontur_filters::control::ipc::{
    IpcConfig, IpcFilterConfig, IpcFilterType, IpcMode, IpcStageConfig,
};
use kontur_filters::time::CycleTime;

/// Largest P-AXIS-00757.
const MOST_LIMIT: f64 = 2000.0;

/// The function as configured by the list.
pub(super) fn config(axis: &Axis) -> IpcConfig {
    IpcConfig {
        enable: axis.get(of::IPC_ENABLE),
        limit_ratio: axis.get(of::IPC_SPEED_MAX),
        delay_cycles: axis.get(own::IPC_DELAY) as usize,
        stages: (0..IpcConfig::MAX_STAGES as u32).map(|index| stage(axis, index)).collect(),
        gantry_slave: false,
    }
}

/// Reports values outside every configuration: undefined modes, and a limit above the range of P-AXIS-00757.
pub(super) fn out_of_range(axis: &Axis, cycle: CycleTime) -> Vec<Diagnostic> {
    let mut found = Vec::new();
    for stage in 0..IpcConfig::MAX_STAGES {
        let value = axis.listed(of::IPC_MODE.at(stage as u32));
        if !(0.0..=3.0).contains(&value) {
            let issue = Issue::IpcRange { stage, what: IpcParameter::Mode, value };
            found.push(issues::control(axis, &issue, cycle));
        }
    }
    for stage in 0..IpcConfig::MAX_STAGES as u32 {
        let [newer, older] = dampings(stage);
        let given = |param: Param<Number>| axis.set_by(param).and_then(|s| s.value.number());
        if let (Some(_), Some(older_value)) = (given(newer), given(older))
            && given(newer) != Some(older_value)
            && dampings(stage).iter().all(|param| given(*param) != Some(-1.0))
        {
            let what = format!("damping {older_value} of older builds");
            let effect = format!("no effect beside {}", newer.place());
            found.push(
                issues::about(axis, Condition::ListNoEffect, older, &what, &effect)
                    .hint("remove one of the two"),
            );
        }
    }
    let value = axis.listed(of::IPC_SPEED_MAX);
    if value > MOST_LIMIT {
        let what =
            format!("limit {value} of the additive speed, allowed: 0 to {MOST_LIMIT} (0.1 %)");
        let effect = "Improved Position Control is off for the axis";
        found.push(
            issues::about(axis, Condition::IpcRange, of::IPC_SPEED_MAX, &what, effect)
                .severity(Severity::Warning)
                .value(ValueKind::Wrong, value, "0.1%")
                .value(ValueKind::UpperLimit, MOST_LIMIT, "0.1%"),
        );
    }
    found
}

/// Where a stage has its damping: newer builds in the stage, older ones in the filter.
fn dampings(stage: u32) -> [Param<Number>; 2] {
    [of::IPC_DAMPING.at(stage), of::IPC_FILTER_DAMPING.at(stage)]
}

fn stage(axis: &Axis, index: u32) -> IpcStageConfig {
    let damping = dampings(index)
        .into_iter()
        .find(|param| axis.set_by(*param).is_some_and(|s| s.value.number() != Some(-1.0)));
    IpcStageConfig {
        mode: match axis.get(of::IPC_MODE.at(index)) {
            1 => IpcMode::Direct,
            2 => IpcMode::Indirect,
            3 => IpcMode::SetPoint,
            _ => IpcMode::NotActive,
        },
        weight_num: axis.get(of::IPC_WEIGHT_NUM.at(index)),
        weight_denom: axis.get(of::IPC_WEIGHT_DENOM.at(index)),
        filters: (0..2).filter_map(|k| filter(axis, index, k)).collect(),
        oscillator_damping: damping.map_or(-1.0, |param| axis.get(param)),
    }
}

/// Filter `k` of a stage; without a type filter 0 is the band-pass and filter 1 does not exist.
fn filter(axis: &Axis, stage: u32, k: u32) -> Option<IpcFilterConfig> {
    let typed = of::IPC_TYPE.at(stage).and(k);
    let text = axis.get(typed).filter(|_| k == 0 || axis.set_by(typed).is_some());
    let kind = match text.as_deref() {
        Some("BANDPASS") => IpcFilterType::BandPass,
        Some("ALLPASS") => IpcFilterType::AllPass,
        _ => return None,
    };
    Some(IpcFilterConfig {
        kind,
        order: axis.get(of::IPC_ORDER.at(stage).and(k)),
        frequency_hz: axis.get(of::IPC_FREQUENCY.at(stage).and(k)),
        quality: axis.get(of::IPC_QUALITY.at(stage).and(k)),
    })
}
