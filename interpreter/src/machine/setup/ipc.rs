//! Improved Position Control of one axis.

use crate::machine::Axis;
use crate::machine::table::{axis_guard as of, kontur};
use kontur_filters::control::ipc::{
    IpcConfig, IpcFilterConfig, IpcFilterType, IpcMode, IpcStageConfig,
};

/// The function as the list states it.
pub(super) fn config(axis: &Axis) -> IpcConfig {
    IpcConfig {
        enable: axis.get(of::IPC_ENABLE),
        limit_ratio: axis.get(of::IPC_SPEED_MAX),
        delay_cycles: axis.get(kontur::IPC_DELAY) as usize,
        stages: (0..IpcConfig::MAX_STAGES as u32).map(|index| stage(axis, index)).collect(),
        gantry_slave: false,
    }
}

fn stage(axis: &Axis, index: u32) -> IpcStageConfig {
    // older builds have the damping in the filter, newer ones in the stage
    let damping = [of::IPC_DAMPING.at(index), of::IPC_FILTER_DAMPING.at(index)]
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
