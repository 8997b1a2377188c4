//! Improved Position Control of one axis.

use super::control::{converted, cycles, raw};
use crate::machine::Axis;
use crate::machine::axis::integer;
use kontur_filters::control::ipc::{
    IpcConfig, IpcFilterConfig, IpcFilterType, IpcMode, IpcStageConfig,
};

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
