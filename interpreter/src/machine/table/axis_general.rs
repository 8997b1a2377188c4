//! Axis lists: head, general data, limits of the range, monitors of the set position.

use super::param::parameters;
use super::raw::{Bound, Raw};
use super::row::{Correction, Default, DriveType, axis};
use crate::diag::Condition;

/// Axis types (P-AXIS-00018).
const AXIS_TYPES: &[(&str, u32)] =
    &[("ACHSTYP_TRANSLATOR", 1), ("ACHSTYP_ROTATOR", 2), ("ACHSTYP_SPINDEL", 4)];

parameters! {
    axis("P-AXIS-00014", "kenngr.abs_pos_gueltig", Raw::Boolean, "1: absolute measuring system, homing not required; no effect here, every axis is treated as homed")
        .default(0.0).drives(&[DriveType::Simulation, DriveType::Sercos, DriveType::Canopen]);
    axis("P-AXIS-00015", "kenngr.achs_mode", Raw::Uns32, "operating mode, sum of bits: linear 0x1, modulo 0x4, face turning axis 0x40, longitudinal turning axis 0x80, gantry master 0x10000, gantry slave 0x20000")
        .default(1.0), as MODE: Whole;
    axis("P-AXIS-00016", "kopf.achs_nr", Raw::Uns16, "logical axis number, unique in the whole system, 0 not allowed; the link between axis list and channel list; changed only by restart")
        .range(Bound::At(1.0), Bound::At(65534.0)).default(1.0).below(Condition::AxisNumberZero, Correction::Refuse), as NUMBER: Whole;
    axis("P-AXIS-00031", "kenngr.beweg_richt", Raw::Boolean, "the only direction of a spindle with P-AXIS-00224: 0 negative, 1 positive; not simulated")
        .default(0.0).axes("RS").source("TF5200 axis parameters 117210251");
    axis("P-AXIS-00224", "kenngr.vorz_richtung", Raw::Boolean, "1: the spindle only turns in one direction (P-AXIS-00031); not simulated")
        .default(0.0).axes("RS").source("TF5200 axis parameters 117208715");
    axis("P-AXIS-00018", "kenngr.achs_typ", Raw::Names(AXIS_TYPES), "ACHSTYP_TRANSLATOR 0x1, ACHSTYP_ROTATOR 0x2, ACHSTYP_SPINDEL 0x4")
        .default(1.0), as KIND: Whole;
    axis("P-AXIS-00020", "kenngr.antr_typ", Raw::Uns16, "drive: 1 conventional, 2 SERCOS, 3 PROFIdrive, 4 simulation, 5 Lightbus, 6 terminal, 7 RT Ethernet, 8 CANopen, 16 virtual, 32 CAN")
        .range(Bound::At(1.0), Bound::At(32.0)).default(4.0), as DRIVE: Whole;
    axis("P-AXIS-00070", "kenngr.gantry_ax_nr", Raw::Uns16, "gantry slave: logical number of its master")
        .range(Bound::At(1.0), Bound::None).default(0.0).axes("TR").special(0.0).source("TF5200 gantry"), as GANTRY_MASTER: Whole;
    axis("P-AXIS-00079", "kenngr.getriebe_stufe", Raw::Uns16, "number of the gear stage in force at start-up (P-AXIS-00135); G112 changes it")
        .range(Bound::At(1.0), Bound::None).default(1.0).below(Condition::GearStageZero, Correction::Default)
        .source("TF5200 axis parameters 117429259"), as GEAR_STAGE: Whole;
    axis("P-AXIS-00126", "getriebe[i].moduloo", Raw::Sgn32, "upper end of the range of a modulo axis")
        .default(3_600_000.0).unit("0.1um", "0.0001deg").axes("R")
        .source("TF5200 axis parameters 117197963"), as MODULO_UPPER: Number;
    axis("P-AXIS-00127", "getriebe[i].modulou", Raw::Sgn32, "lower end of the range of a modulo axis")
        .default(0.0).unit("0.1um", "0.0001deg").axes("R")
        .source("TF5200 axis parameters 117199499"), as MODULO_LOWER: Number;
    axis("P-AXIS-00135", "getriebe[i].nummer", Raw::Uns16, "number of a gear stage for G112; getriebe[0] has 1, the others cannot be selected without one")
        .special(0.0).range(Bound::At(1.0), Bound::None).source("TF5200 axis parameters 117585419"), as GEAR_NUMBER: Optional;
    axis("P-AXIS-00086", "", Raw::Uns32, "stroke of the probe; raise it for measuring moves, whose distance is shortened by the content of the feedforward buffer")
        .axes("TR").source("TF5200 feedforward control");
    axis("P-AXIS-00058", "kenngr.durchm_prog_abs", Raw::Boolean, "with G51 and G90, words of a face turning axis are diameters")
        .default(0.0).axes("T").source("TF5200 axis parameters"), as DIAMETER_ABSOLUTE: Switch;
    axis("P-AXIS-00059", "kenngr.durchm_prog_rel", Raw::Boolean, "with G51 and G91, words of a face turning axis are diameters")
        .default(0.0).axes("T").source("TF5200 axis parameters"), as DIAMETER_RELATIVE: Switch;
    axis("P-AXIS-00098", "kenngr.kasto_achse", Raw::Boolean, "1: the axis takes part in edge banding (G108)")
        .default(0.0).axes("TR").source("TF5200 axis parameters"), as BANDS: Switch;
    axis("P-AXIS-00118", "kenngr.messachse", Raw::Boolean, "1: the axis takes part in measuring runs (G100, G310)")
        .default(0.0).axes("TR").source("TF5200 axis parameters"), as MEASURES: Switch;
    axis("P-AXIS-00330", "kenngr.meas_signal_fixed_stop", Raw::Boolean, "1: measuring type 7 looks for a fixed stop with this axis")
        .default(0.0), as STOPS: Switch;
    axis("P-AXIS-00331", "kenngr.fixed_stop_pos_lag_limit", Raw::Uns32, "measuring type 7: lag above which the axis has reached its fixed stop; 0: never")
        .default(0.0).unit("0.1um", "0.0001deg"), as STOP_LAG: Number;
    axis("P-AXIS-00769", "antr.fixed_stop.detect.pos_lag_limit", Raw::Sgn32, "replaces P-AXIS-00331 if it is not negative")
        .default(-1.0).unit("0.1um", "0.0001deg"), as STOP_LAG_OF_DRIVE: Number;
    axis("P-AXIS-00774", "kenngr.measure.fixed_stop_detect.pos_lag_limit", Raw::Sgn32, "replaces P-AXIS-00769 if it is not negative")
        .default(-1.0).unit("0.1um", "0.0001deg"), as STOP_LAG_OF_RUN: Number;
    axis("P-AXIS-00215", "kenngr.vb_messen", Raw::Uns32, "speed of measuring runs of type 2")
        .range(Bound::At(1.0), Bound::None).default(16666.0).unit("um/s", "0.001deg/s").axes("TR").source("TF5200 axis parameters"), as MEASURING_SPEED: Number;
    axis("P-AXIS-00109", "kenngr.max_vb_override", Raw::Uns16, "maximum override of independent axes; not simulated for spindles")
        .range(Bound::At(1.0), Bound::At(2000.0)).default(1000.0).unit("0.1%", "0.1%").below(Condition::OverrideRange, Correction::Limit), as MOST_OVERRIDE: Number;
    axis("P-AXIS-00176", "kenngr.suppress_pos_lag_error", Raw::Boolean, "the lag is monitored and traced but raises no error; the documents do not print the prefix of the key: kenngr., lr_param., getriebe[0]. and no prefix are accepted")
        .default(0.0).axes("TR"), as LAG_SUPPRESSED: Switch;
    axis("P-AXIS-00177", "kenngr.swe_neg", Raw::Sgn32, "negative software limit for setpoints; actuals may pass it by swe_toleranz")
        .default(-100000000.0).unit("0.1um", "0.0001deg").axes("TR"), as LOWER_LIMIT: Number;
    axis("P-AXIS-00178", "kenngr.swe_pos", Raw::Sgn32, "positive software limit")
        .default(100000000.0).unit("0.1um", "0.0001deg").axes("TR"), as UPPER_LIMIT: Number;
    axis("P-AXIS-00179", "kenngr.swe_toleranz", Raw::Uns32, "actual positions may be beyond a software limit by this (70021, 70022)")
        .range(Bound::At(0.0), Bound::None).default(1000.0).unit("0.1um", "0.0001deg").drives(&[DriveType::Simulation, DriveType::Conventional, DriveType::Terminal, DriveType::Lightbus, DriveType::Profidrive]).axes("TR"), as LIMIT_TOLERANCE: Number;
    axis("P-AXIS-00297", "kopf.log_achs_name", Raw::Text, "default (alias) name of the axis"), as NAME: Text;
    axis("P-AXIS-00439", "kenngr.dyn_monitoring_v_warn", Raw::Uns32, "warning when setpoint speed > vb_max by this (50119)")
        .range(Bound::At(0.0), Bound::None).default(50.0).unit("0.1%", "0.1%"), as SPEED_WARNING: Number;
    axis("P-AXIS-00440", "kenngr.dyn_monitoring_v_err", Raw::Uns32, "error when setpoint speed > vb_max by this (50118); raise it when band-stop filters overshoot")
        .range(Bound::At(0.0), Bound::None).default(90.0).unit("0.1%", "0.1%"), as SPEED_ERROR: Number;
    axis("P-AXIS-00441", "kenngr.dyn_monitoring_a_warn", Raw::Uns32, "warning when setpoint acceleration > a_max by this")
        .range(Bound::At(0.0), Bound::None).default(500.0).unit("0.1%", "0.1%"), as ACC_WARNING: Number;
    axis("P-AXIS-00442", "kenngr.dyn_monitoring_a_err", Raw::Uns32, "error when setpoint acceleration > a_max by this; 441 = 442 = 0 switches both off")
        .range(Bound::At(0.0), Bound::None).default(1000.0).unit("0.1%", "0.1%"), as ACC_ERROR: Number;
    axis("P-AXIS-00443", "kenngr.dyn_monitoring_j_warn", Raw::Uns32, "jerk warning, reference a_max/tr_min")
        .range(Bound::At(0.0), Bound::None).default(0.0).unit("0.1%", "0.1%"), as JERK_WARNING: Number;
    axis("P-AXIS-00444", "kenngr.dyn_monitoring_j_err", Raw::Uns32, "jerk error; 443 = 444 = 0 off")
        .range(Bound::At(0.0), Bound::None).default(0.0).unit("0.1%", "0.1%"), as JERK_ERROR: Number;
    axis("P-AXIS-00474", "kenngr.check_spindle_speed_in_tool_range", Raw::Boolean, "1: a speed outside P-TOOL-00013 to P-TOOL-00014 is an error (60312), 0: it is limited")
        .default(0.0).axes("S").source("TF5200 axis parameters 117225611"), as TOOL_SPEED_CHECKED: Switch;
    axis("P-AXIS-00491", "kenngr.indp_override_mode", Raw::Uns16, "override of independent axes: 0 channel override, 1 the smaller of channel and axis override, 2 axis override; the axis override is always 100 %")
        .range(Bound::At(0.0), Bound::At(2.0)).default(0.0).axes("TR").source("TF5200 axis parameters"), as INDEPENDENT_OVERRIDE: Whole;
    axis("P-AXIS-00540", "kenngr.indp_feedhold_mode", Raw::Uns16, "feedhold of independent axes: 0 by channel and axis, 1 by the axis only, which is never active here")
        .range(Bound::At(0.0), Bound::At(1.0)).default(0.0).axes("TR").source("TF5200 axis parameters"), as INDEPENDENT_FEEDHOLD: Switch;
    axis("P-AXIS-00556", "kenngr.feedhold_deceleration_mode", Raw::Word(&["DEFAULT_DECELERATION", "FEEDHOLD_DECELERATION", "MIN_TOOL_ACC_FEEDHOLD_DECELERATION"]), "deceleration of independent axes and spindles under feedhold; the others are not simulated")
        .default_is(Default::Text("DEFAULT_DECELERATION")).axes("TRS").source("TF5200 axis parameters 358850187");
    axis("P-AXIS-00520", "lr_param.check_pos_command_limit", Raw::Boolean, "monitor setpoints against the positive limit in the controller every cycle (70195)")
        .default(0.0).axes("T");
    axis("P-AXIS-00521", "", Raw::Boolean, "monitor setpoints against the negative limit in the controller every cycle")
        .default(0.0).axes("T");
    axis("P-AXIS-00554", "kenngr.swe_behaviour", Raw::Word(&["ERROR", "ERROR_LR", "WARNING"]), "ERROR | ERROR_LR (warning in preparation, error in controller) | WARNING")
        .default_is(Default::Text("ERROR")).axes("TR"), as LIMIT_BEHAVIOUR: Text;
    axis("P-AXIS-00627", "error_filter[i].reason", Raw::Text, "IDs or texts an error filter matches, i = 0..3");
}
