//! Axis lists: position controller, position and lag monitoring, measuring systems.

use super::param::parameters;
use super::raw::{Bound, Raw};
use super::row::{Correction, Default, DriveType, axis};
use crate::diag::Condition;

/// Names of P-AXIS-00320.
const OPERATION_MODES: &[&str] = &[
    "DRIVE_DEFAULT",
    "DRIVE_POSITION_CONTROL",
    "CNC_POSITION_CONTROL",
    "DSC_POSITION_CONTROL",
    "OPEN_POSITION_LOOP_MODE",
    "OPEN_POSITION_LOOP_POS_FEEDBACK",
    "OPEN_POSITION_LOOP_VEL_FEEDBACK",
    "OPEN_POSITION_LOOP_NO_FEEDBACK",
];

parameters! {
    axis("P-AXIS-00092", "getriebe[i].incr_per_rev", Raw::Uns32, "encoder increments per motor revolution")
        .range(Bound::At(0.0), Bound::None).default(1024.0).unit("incr/rev", "incr/rev").source("TF5200 feedforward control"), as INCREMENTS_PER_REV: Number;
    axis("P-AXIS-00099", "getriebe[i].kv", Raw::Uns32, "gain of the P position controller in the CNC (1000 = 10/s); 0 gives 110150")
        .range(Bound::At(1.0), Bound::None).default(1000.0).unit("0.01/s", "0.01/s").below(Condition::GainZero, Correction::Default), as GAIN: Number;
    axis("P-AXIS-00128", "getriebe[i].multi_gain_n", Raw::Uns32, "output at 1 m/min (1000 deg/min), denominator")
        .range(Bound::At(1.0), Bound::None).default(1.0).drives(&[DriveType::Simulation, DriveType::Conventional, DriveType::Terminal, DriveType::Lightbus, DriveType::Profidrive]).source("TF5200 Improved Position Control"), as COMMAND_GAIN_DENOM: Number;
    axis("P-AXIS-00129", "getriebe[i].multi_gain_z", Raw::Uns32, "output at 1 m/min (1000 deg/min), numerator")
        .range(Bound::At(1.0), Bound::None).default(2000.0).unit("bit", "bit").drives(&[DriveType::Simulation, DriveType::Conventional, DriveType::Terminal, DriveType::Lightbus, DriveType::Profidrive]).source("TF5200 Improved Position Control"), as COMMAND_GAIN_NUM: Number;
    axis("P-AXIS-00151", "getriebe[i].pos_einschw_zeit", Raw::Uns32, "older time limit, 0 off; the older manual gives ms")
        .range(Bound::At(0.0), Bound::At(4294967.0)).default(1000000.0).unit("us", "us"), as SETTLING_TIME_OLD: Number;
    axis("P-AXIS-00166", "getriebe[i].slep_abw", Raw::Uns32, "remaining deviation of the discontinued type 3; no effect")
        .range(Bound::At(0.0), Bound::At(1024.0)).default(512.0);
    axis("P-AXIS-00167", "getriebe[i].slep_dyn", Raw::Sgn16, "filter constant or slope factor; 1024 = off")
        .range(Bound::At(0.0), Bound::At(1024.0)).default(1000.0), as LAG_DYNAMICS: Number;
    axis("P-AXIS-00168", "getriebe[i].slep_max", Raw::Sgn32, "maximum lag (type 1, 4) / lower bound while moving (type 2); default in the older manual 5000000")
        .range(Bound::At(0.0), Bound::None).default(100000.0).unit("0.1um", "0.0001deg"), as LAG_MAX: Number;
    axis("P-AXIS-00169", "getriebe[i].slep_min", Raw::Sgn32, "limit at standstill / lower bound (type 1)")
        .range(Bound::At(1.0), Bound::None).default(20000.0).unit("0.1um", "0.0001deg"), as LAG_MIN: Number;
    axis("P-AXIS-00170", "getriebe[i].slep_time_const", Raw::Uns32, "time shift of the limit curve")
        .range(Bound::At(0.0), Bound::None).default(0.0).unit("us", "us"), as LAG_SHIFT: Number;
    axis("P-AXIS-00172", "getriebe[i].slep_ueberw_typ", Raw::Uns32, "lag monitoring: 1 standard, 2 linear, 4 speed-independent, else off")
        .range(Bound::At(0.0), Bound::None).default(0.0), as LAG_MONITOR: Whole;
    axis("P-AXIS-00233", "getriebe[i].wegaufn", Raw::Uns32, "encoder resolution, path (denominator); 0 gives 110086")
        .range(Bound::At(1.0), Bound::None).default(1.0).unit("0.1um", "0.0001deg").below(Condition::ResolutionPath, Correction::Value(1.0)), as RESOLUTION_PATH: Number;
    axis("P-AXIS-00234", "getriebe[i].wegaufz", Raw::Uns32, "encoder resolution, increments (numerator); 0 gives 110386")
        .range(Bound::At(1.0), Bound::None).default(1.0).unit("incr", "incr").below(Condition::ResolutionIncrements, Correction::Value(1.0)), as RESOLUTION_INCREMENTS: Number;
    axis("P-AXIS-00236", "getriebe[i].window", Raw::Sgn32, "exact-stop window, also for G60")
        .range(Bound::At(1.0), Bound::None).default(500.0).unit("0.1um", "0.0001deg").below(Condition::WindowZero, Correction::Default).source("TF5200 position monitoring"), as WINDOW: Number;
    axis("P-AXIS-00244", "getriebe[i].dyn_kv.dyn_kv_active", Raw::Boolean, "dynamic kv: the gain depends on the speed (P-AXIS-00245 to 00248) instead of P-AXIS-00099")
        .default(0.0).drives(&[DriveType::Simulation, DriveType::Conventional, DriveType::Terminal, DriveType::Lightbus, DriveType::Profidrive]), as GAIN_BY_SPEED: Switch;
    axis("P-AXIS-00245", "getriebe[i].dyn_kv.kv1", Raw::Uns32, "dynamic kv: gain at v1")
        .range(Bound::At(1.0), Bound::None).default(1000.0).unit("0.01/s", "0.01/s").drives(&[DriveType::Simulation, DriveType::Conventional, DriveType::Terminal, DriveType::Lightbus, DriveType::Profidrive]), as GAIN_1: Number;
    axis("P-AXIS-00246", "getriebe[i].dyn_kv.v1", Raw::Uns32, "dynamic kv: lower speed")
        .range(Bound::At(0.0), Bound::None).default(1000.0).unit("um/s", "0.001deg/s").drives(&[DriveType::Simulation, DriveType::Conventional, DriveType::Terminal, DriveType::Lightbus, DriveType::Profidrive]), as GAIN_SPEED_1: Number;
    axis("P-AXIS-00247", "getriebe[i].dyn_kv.kv2", Raw::Uns32, "dynamic kv: gain at v2")
        .range(Bound::At(1.0), Bound::None).default(1000.0).unit("0.01/s", "0.01/s").drives(&[DriveType::Simulation, DriveType::Conventional, DriveType::Terminal, DriveType::Lightbus, DriveType::Profidrive]), as GAIN_2: Number;
    axis("P-AXIS-00248", "getriebe[i].dyn_kv.v2", Raw::Uns32, "dynamic kv: upper speed (AXIS prints the key kv2 by mistake)")
        .range(Bound::BeyondOf("P-AXIS-00246"), Bound::None).default(2000.0).unit("um/s", "0.001deg/s").drives(&[DriveType::Simulation, DriveType::Conventional, DriveType::Terminal, DriveType::Lightbus, DriveType::Profidrive]), as GAIN_SPEED_2: Number;
    axis("P-AXIS-00320", "antr.operation_mode", Raw::Word(OPERATION_MODES), "where the position loop is closed")
        .default_is(Default::Text("DRIVE_DEFAULT")).drives(&[DriveType::Sercos]).source("TwinCAT 3 CNC axis commissioning"), as OPERATION_MODE: Text;
    axis("P-AXIS-00395", "getriebe[i].pos_control_deadband", Raw::Uns32, "lag below which an axis at rest gets no speed command")
        .range(Bound::None, Bound::Of("P-AXIS-00236")).default(0.0).unit("0.1um", "0.0001deg").above(Condition::DeadBand, Correction::Limit).source("TF5200 diagnosis"), as DEAD_BAND: Number;
    axis("P-AXIS-00407", "lr_param.dyn_monitoring_v_err", Raw::Uns32, "speed excess allowed in the controller (70382); 0 = off")
        .range(Bound::At(0.0), Bound::None).default(1000.0).unit("0.1%", "0.1%"), as SPEED_EXCESS: Number;
    axis("P-AXIS-00422", "lr_hw[i].encoder_resolution_num", Raw::Uns32, "resolution of the direct measuring system (i = 1), increments")
        .range(Bound::At(1.0), Bound::None).default(1.0).unit("incr", "incr"), as ENCODER_NUM: Optional;
    axis("P-AXIS-00423", "lr_hw[i].encoder_resolution_denom", Raw::Uns32, "resolution of the direct measuring system (i = 1), path")
        .range(Bound::At(1.0), Bound::None).default(1.0).unit("0.1um", "0.0001deg"), as ENCODER_DENOM: Optional;
    axis("P-AXIS-00488", "getriebe[i].pos_lag_mon_error_delay_time", Raw::Uns32, "delay of 70020 in type 4")
        .range(Bound::At(0.0), Bound::At(250000.0)).default(0.0).unit("us", "us"), as LAG_TOLERANCE: Number;
    axis("P-AXIS-00511", "getriebe[i].gear_fact_num", Raw::Uns32, "gear ratio, input revolutions")
        .range(Bound::At(1.0), Bound::None).default(1.0).source("TF5200 feedforward control"), as GEAR_IN: Number;
    axis("P-AXIS-00512", "getriebe[i].gear_fact_denom", Raw::Uns32, "gear ratio, output revolutions; 0 gives 110579 (one page of the diagnosis manual prints 110580)")
        .range(Bound::At(1.0), Bound::None).default(1.0).below(Condition::GearRatio, Correction::Value(1.0)).source("TF5200 feedforward control"), as GEAR_OUT: Number;
    axis("P-AXIS-00532", "getriebe[i].position_settling_time", Raw::Sgn32, "time limit to reach the window; 0 off, < 0 use P-AXIS-00151")
        .default(-1.0).unit("us", "us").source("TF5200 position monitoring"), as SETTLING_TIME: Number;
}
