//! Axis lists: Vibration Guard and Improved Position Control.

use super::param::parameters;
use super::raw::{Bound, Raw};
use super::row::{Correction, Default, DriveType, axis};
use crate::diag::Condition;
use kontur_filters::vib_guard::VibGuardSettings;

/// Modes of a stage (P-AXIS-00753).
const IPC_MODES: &[(&str, u32)] =
    &[("NOT_ACTIVE", 0), ("DIRECT", 1), ("INDIRECT", 2), ("SET_POINT", 3)];

parameters! {
    axis("P-AXIS-00568", "vib_guard.damping", Raw::Real64, "damping of the frequency to suppress")
        .range(Bound::At(0.0), Bound::At(1.0)).default(0.1).outside(Condition::GuardRange, Correction::Default).source("TF5250 Vibration Guard"), as DAMPING: Number;
    axis("P-AXIS-00571", "vib_guard.mode", Raw::Uns32, "modes 1-3 asymmetric, with increasing robustness; 4 symmetric")
        .range(Bound::At(1.0), Bound::At(4.0)).default(1.0).outside(Condition::GuardRange, Correction::Default).source("TF5250 Vibration Guard"), as MODE: Whole;
    axis("P-AXIS-00588", "vib_guard.active", Raw::Boolean, "Vibration Guard permanently on from program start")
        .default(0.0).source("TF5250 Vibration Guard"), as ACTIVE: Switch;
    axis("P-AXIS-00589", "vib_guard.freq", Raw::Real64, "natural frequency to suppress")
        .range(Bound::At(VibGuardSettings::MIN_FREQ_HZ), Bound::None).default(30.0).unit("Hz", "Hz").outside(Condition::GuardRange, Correction::Default).source("TF5250 Vibration Guard"), as FREQUENCY: Number;
    axis("P-AXIS-00750", "lr_param.improved_position_control.stage[i].filter[k].order", Raw::Uns32, "order of the band-pass")
        .range(Bound::At(1.0), Bound::At(3.0)).default(0.0).drives(&[DriveType::Sercos, DriveType::Profidrive, DriveType::Canopen]).at_setup().source("TF5200 Improved Position Control"), as IPC_ORDER: Whole;
    axis("P-AXIS-00751", "lr_param.improved_position_control.stage[i].filter[k].fg_f0", Raw::Real64, "damped frequency")
        .range(Bound::Beyond(0.0), Bound::At(500.0)).default(-1.0).unit("Hz", "Hz").drives(&[DriveType::Sercos, DriveType::Profidrive, DriveType::Canopen]).at_setup().source("TF5200 Improved Position Control"), as IPC_FREQUENCY: Number;
    axis("P-AXIS-00752", "lr_param.improved_position_control.stage[i].filter[k].q_factor", Raw::Real64, "Q = f0/bandwidth")
        .range(Bound::At(1.0), Bound::At(10.0)).default(-1.0).drives(&[DriveType::Sercos, DriveType::Profidrive, DriveType::Canopen]).at_setup().source("TF5200 Improved Position Control"), as IPC_QUALITY: Number;
    axis("P-AXIS-00753", "lr_param.improved_position_control.stage[i].mode", Raw::Names(IPC_MODES), "type of the stage: 0 NOT_ACTIVE, 1 DIRECT, 2 INDIRECT, 3 SET_POINT; i = 0..2")
        .range(Bound::At(0.0), Bound::At(3.0)).default(0.0).drives(&[DriveType::Sercos, DriveType::Profidrive, DriveType::Canopen]).at_setup().source("TF5200 Improved Position Control"), as IPC_MODE: Whole;
    axis("P-AXIS-00754", "lr_param.improved_position_control.stage[i].weight_fact_num", Raw::Uns32, "weight numerator; weight at most 7.0; <= 0 gives 70603")
        .range(Bound::At(1.0), Bound::None).default(1.0).drives(&[DriveType::Sercos, DriveType::Profidrive, DriveType::Canopen]).at_setup().source("TF5200 Improved Position Control"), as IPC_WEIGHT_NUM: Number;
    axis("P-AXIS-00755", "lr_param.improved_position_control.stage[i].weight_fact_denom", Raw::Uns32, "weight denominator; <= 0 gives 70604")
        .range(Bound::At(1.0), Bound::None).default(1.0).drives(&[DriveType::Sercos, DriveType::Profidrive, DriveType::Canopen]).at_setup().source("TF5200 Improved Position Control"), as IPC_WEIGHT_DENOM: Number;
    axis("P-AXIS-00756", "lr_param.improved_position_control.stage[i].filter[k].damping", Raw::Real64, "damping of the simulated oscillation (INDIRECT, SET_POINT)")
        .range(Bound::Beyond(0.0), Bound::Beyond(1.0)).default(-1.0).drives(&[DriveType::Sercos, DriveType::Profidrive, DriveType::Canopen]).at_setup().source("TF5200 Improved Position Control"), as IPC_FILTER_DAMPING: Number;
    axis("P-AXIS-00757", "lr_param.improved_position_control.v_add_max_fact", Raw::Uns16, "limit of the additive speed, share of P-AXIS-00212")
        .range(Bound::At(0.0), Bound::At(2000.0)).default(0.0).unit("0.1%", "0.1%").drives(&[DriveType::Sercos, DriveType::Profidrive, DriveType::Canopen]).at_setup().source("TF5200 Improved Position Control"), as IPC_SPEED_MAX: Number;
    axis("P-AXIS-00758", "lr_param.improved_position_control.enable", Raw::Boolean, "switches Improved Position Control")
        .default(0.0).drives(&[DriveType::Sercos, DriveType::Profidrive, DriveType::Canopen]).source("TF5200 Improved Position Control"), as IPC_ENABLE: Switch;
    axis("P-AXIS-00848", "", Raw::Uns32, "filter prototype, newer builds")
        .drives(&[DriveType::Sercos, DriveType::Profidrive, DriveType::Canopen]).source("TF5200 Improved Position Control");
    axis("P-AXIS-00849", "lr_param.improved_position_control.stage[i].filter[k].type", Raw::Word(&["NO_FILTER", "BANDPASS", "ALLPASS"]), "NO_FILTER BANDPASS ALLPASS, from V3.1.3132.0")
        .default_is(Default::PerIndex(&["BANDPASS", "NO_FILTER"])).drives(&[DriveType::Sercos, DriveType::Profidrive, DriveType::Canopen]).at_setup(), as IPC_TYPE: Text;
    axis("P-AXIS-00850", "lr_param.improved_position_control.stage[i].osc_damping", Raw::Real64, "replaces 00756 from V3.1.3132.0 (table prints the key without the dot)")
        .range(Bound::Beyond(0.0), Bound::Beyond(1.0)).default(-1.0).drives(&[DriveType::Sercos, DriveType::Profidrive, DriveType::Canopen]).at_setup(), as IPC_DAMPING: Number;
}
