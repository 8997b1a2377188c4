//! Axis lists: simulated drive, scaling to the format of a drive, feedforward.

use super::param::parameters;
use super::raw::{Bound, Raw};
use super::row::{Correction, DriveType, axis};
use crate::diag::Condition;

/// Kinds of feedforward (P-AXIS-00223).
const FEEDFORWARD_BITS: &[(&str, u32)] = &[
    ("NONE", 0),
    ("VEL", 0x1),
    ("ACC", 0x2),
    ("JERK", 0x4),
    ("ADD_VEL", 0x101),
    ("ADD_ACC", 0x202),
    ("ADD_JERK", 0x804),
];

parameters! {
    axis("P-AXIS-00050", "antr.simu.daempfung_n", Raw::Uns32, "damping of the simulated drive, denominator")
        .range(Bound::At(1.0), Bound::None).default(10.0).drives(&[DriveType::Simulation]), as SIMU_DAMPING_DENOM: Number;
    axis("P-AXIS-00051", "antr.simu.daempfung_z", Raw::Uns32, "damping of the simulated drive, numerator; 1 or more gives 80044")
        .range(Bound::At(1.0), Bound::None).default(6.0).drives(&[DriveType::Simulation]), as SIMU_DAMPING_NUM: Number;
    axis("P-AXIS-00061", "antr.simu.eigenfrequenz_n", Raw::Uns32, "natural angular frequency of the simulated drive, denominator")
        .range(Bound::At(1.0), Bound::None).default(1.0).unit("s", "s").drives(&[DriveType::Simulation]), as SIMU_FREQUENCY_DENOM: Number;
    axis("P-AXIS-00062", "antr.simu.eigenfrequenz_z", Raw::Uns32, "natural angular frequency of the simulated drive in 1/s, numerator")
        .range(Bound::At(1.0), Bound::None).default(100.0).unit("1", "1").drives(&[DriveType::Simulation]), as SIMU_FREQUENCY_NUM: Number;
    axis("P-AXIS-00065", "", Raw::Uns32, "coarsening of the position value of PROFIdrive drives (counterpart of 00405)")
        .drives(&[DriveType::Profidrive]).source("TF5200 feedforward control");
    axis("P-AXIS-00096", "antr.simu.ist_gleich_soll", Raw::Boolean, "actual = setpoint (one cycle of lag remains)")
        .default(0.0).drives(&[DriveType::Simulation]), as SIMU_FOLLOWS: Switch;
    axis("P-AXIS-00165", "vorsteuer.shift_time", Raw::Uns16, "feedforward output this many cycles before its setpoint")
        .range(Bound::At(0.0), Bound::At(4.0)).default(3.0).unit("cycles", "cycles").drives(&[DriveType::Profidrive]).source("TF5200 feedforward control"), as FF_SHIFT: Whole;
    axis("P-AXIS-00191", "antr.nbr_delay_cycles", Raw::Uns16, "cycles between command output and reading of the actual position, only for the lag")
        .range(Bound::At(0.0), Bound::At(10.0)).default(4.0).unit("cycles", "cycles").drives(&[DriveType::Sercos, DriveType::Canopen, DriveType::Kuka]), as LAG_DELAY: Whole;
    axis("P-AXIS-00194", "antr.simu.totzeit", Raw::Uns32, "dead time of the plant; more gives 110040")
        .range(Bound::At(0.0), Bound::At(5.0)).default(0.0).unit("cycles", "cycles").drives(&[DriveType::Simulation]).every_plant().above(Condition::DeadTime, Correction::Limit), as SIMU_DEAD_TIME: Whole;
    axis("P-AXIS-00205", "antr.v_reso_denom", Raw::Uns32, "speed scaling: distance travelled per time base when v_reso_num is output")
        .range(Bound::At(1.0), Bound::None).default(36.0).unit("um", "0.001deg").below(Condition::SpeedScaleDenominator, Correction::Refuse).source("TF5200 feedforward control"), as SPEED_PATH: Number;
    axis("P-AXIS-00206", "antr.v_reso_num", Raw::Uns32, "speed scaling: increments output for the distance v_reso_denom per time base")
        .range(Bound::At(0.0), Bound::None).default(1.0).unit("incr", "incr").source("TF5200 feedforward control"), as SPEED_INCREMENTS: Number;
    axis("P-AXIS-00207", "antr.v_time_base", Raw::Uns16, "0 per minute, 1 per second, 2 per sampling interval")
        .range(Bound::At(0.0), Bound::At(2.0)).default(0.0).drives(&[DriveType::Sercos]).above(Condition::TimeBaseUnknown, Correction::Refuse).source("TF5200 feedforward control"), as SPEED_TIME_BASE: Whole;
    axis("P-AXIS-00223", "vorsteuer.vorsteuerung", Raw::Flags(FEEDFORWARD_BITS), "what is fed forward and where it enters, names joined by |: NONE 0; VEL 0x1, ACC 0x2, JERK 0x4 at the output of the position controller; ADD_VEL 0x101 as additive velocity, ADD_ACC 0x202 and ADD_JERK 0x804 as additive torque or current of the drive")
        .default(0.0).source("TF5200 feedforward control"), as FEEDFORWARD: Whole;
    axis("P-AXIS-00225", "vorsteuer.vs_a_faktor", Raw::Sgn32, "Ta numerator (conventional); dimensionless weight in the additive variant; 0 is a valid weight")
        .range(Bound::At(0.0), Bound::None).default(1.0).unit("us", "us").source("TF5200 feedforward control"), as FF_ACC_NUM: Number;
    axis("P-AXIS-00226", "vorsteuer.vs_a_nenner", Raw::Sgn32, "Ta denominator; 0 gives 110381")
        .range(Bound::At(1.0), Bound::None).default(1.0).below(Condition::AccelerationDenominator, Correction::Value(1.0)).source("TF5200 feedforward control"), as FF_ACC_DENOM: Number;
    axis("P-AXIS-00228", "vorsteuer.vs_v_faktor", Raw::Sgn32, "global weight numerator; recommended weight 0.7..1; 0 is a valid weight")
        .range(Bound::At(0.0), Bound::None).default(1.0).source("TF5200 feedforward control"), as FF_WEIGHT_NUM: Number;
    axis("P-AXIS-00229", "vorsteuer.vs_v_nenner", Raw::Sgn32, "global weight denominator; 0 gives 110123")
        .range(Bound::At(1.0), Bound::None).default(1.0).below(Condition::FeedforwardDenominator, Correction::Value(1.0)).source("TF5200 feedforward control"), as FF_WEIGHT_DENOM: Number;
    axis("P-AXIS-00238", "antr.simu.zeitkonstante_n", Raw::Uns32, "sampling time of the simulated drive in s, denominator")
        .range(Bound::At(1.0), Bound::None).default(100.0).drives(&[DriveType::Simulation]), as SIMU_SAMPLING_DENOM: Number;
    axis("P-AXIS-00239", "antr.simu.zeitkonstante_z", Raw::Uns32, "sampling time of the simulated drive in s, numerator; should be the cycle")
        .range(Bound::At(1.0), Bound::None).default(1.0).unit("s", "s").drives(&[DriveType::Simulation]), as SIMU_SAMPLING_NUM: Number;
    axis("P-AXIS-00255", "vorsteuer.default_active", Raw::Boolean, "always fed forward, even under G137")
        .default(0.0).source("TF5200 feedforward control"), as FF_ALWAYS_ON: Switch;
    axis("P-AXIS-00256", "vorsteuer.global_disable", Raw::Boolean, "never fed forward, even under G135")
        .default(0.0), as FF_NEVER_ON: Switch;
    axis("P-AXIS-00325", "antr.torque_scale_num", Raw::Uns32, "value at which the motor gives nominal torque, numerator")
        .range(Bound::At(1.0), Bound::None).default(1.0).drives(&[DriveType::Sercos, DriveType::Lightbus, DriveType::Canopen]).source("TF5200 feedforward control"), as TORQUE_SCALE_NUM: Number;
    axis("P-AXIS-00326", "antr.torque_scale_denom", Raw::Uns32, "value at which the motor gives nominal torque, denominator; 0 switches the torque output off (110465)")
        .range(Bound::At(1.0), Bound::None).default(1.0).drives(&[DriveType::Sercos, DriveType::Lightbus, DriveType::Canopen]).below(Condition::TorqueScaleDenominator, Correction::Keep).source("TF5200 feedforward control"), as TORQUE_SCALE_DENOM: Number;
    axis("P-AXIS-00337", "vorsteuer.jerk_fact_num", Raw::Uns32, "jerk factor numerator")
        .range(Bound::At(0.0), Bound::None).default(1.0).source("TF5200 feedforward control"), as FF_JERK_NUM: Number;
    axis("P-AXIS-00338", "vorsteuer.jerk_fact_denom", Raw::Uns32, "jerk factor denominator; 0 gives 110473, 100")
        .range(Bound::At(1.0), Bound::None).default(100.0).below(Condition::JerkDenominator, Correction::Default).source("TF5200 feedforward control"), as FF_JERK_DENOM: Number;
    axis("P-AXIS-00362", "antr.feed_const_num", Raw::Uns32, "feed constant numerator; if 362 or 363 is not 1 the resolution follows from 92, 511/512, 362/363")
        .range(Bound::At(1.0), Bound::None).default(1.0).unit("0.1um", "0.1um").source("TF5200 feedforward control"), as FEED_CONSTANT_PATH: Number;
    axis("P-AXIS-00363", "antr.feed_const_denom", Raw::Uns32, "feed constant denominator; 0 gives 110472")
        .range(Bound::At(1.0), Bound::None).default(1.0).unit("rev", "rev").below(Condition::FeedConstantDenominator, Correction::Refuse).source("TF5200 feedforward control"), as FEED_CONSTANT_REVS: Number;
    axis("P-AXIS-00389", "vorsteuer.velocity_delay_time", Raw::Uns16, "delay of the additive velocity; too large gives 70349, 0")
        .range(Bound::None, Bound::BeyondCycles(6.0)).default(0.0).unit("us", "us").drives(&[DriveType::Sercos, DriveType::Profidrive, DriveType::Canopen]).above(Condition::VelocityDelay, Correction::Value(0.0)).source("TF5200 feedforward control"), as FF_SPEED_DELAY: Number;
    axis("P-AXIS-00390", "vorsteuer.acceleration_delay_time", Raw::Uns16, "delay of the additive torque; too large gives 70348, 0")
        .range(Bound::None, Bound::BeyondCycles(6.0)).default(0.0).unit("us", "us").drives(&[DriveType::Sercos, DriveType::Lightbus, DriveType::Profidrive, DriveType::Canopen]).above(Condition::AccelerationDelay, Correction::Value(0.0)).source("TF5200 feedforward control"), as FF_ACC_DELAY: Number;
    axis("P-AXIS-00391", "getriebe[i].load", Raw::Real64, "total inertia at the motor shaft (or moved mass)")
        .range(Bound::At(0.0), Bound::None).default(1e-06).unit("kg", "kg*m2").drives(&[DriveType::Sercos]).source("TF5200 feedforward control"), as LOAD: Number;
    axis("P-AXIS-00392", "antr.acc_reference_value", Raw::Real64, "stall (nominal) torque of the motor; one overview of the manual misprints the key as feed_const_denom")
        .range(Bound::At(0.0), Bound::None).default(1.0).unit("N", "Nm").drives(&[DriveType::Sercos, DriveType::Canopen]).source("TF5200 feedforward control"), as TORQUE_REFERENCE: Number;
    axis("P-AXIS-00405", "antr.encoder_coarsening_factor", Raw::Uns16, "low encoder bits dropped")
        .range(Bound::At(0.0), Bound::At(20.0)).default(0.0).drives(&[DriveType::Sercos, DriveType::Canopen]), as DROPPED_BITS: Whole;
    axis("P-AXIS-00513", "kenngr.delay_filter_only_position", Raw::Boolean, "1: the feedforward is computed from the setpoint before the delay filter (type 11, last of the axis filters, otherwise 110583), so that it leads; not simulated")
        .default(0.0).source("TF5200 axis parameters 117579275");
    axis("P-AXIS-00514", "vorsteuer.feedforward_v_add_num", Raw::Uns32, "velocity-only weight numerator")
        .range(Bound::At(1.0), Bound::None).default(1.0).below(Condition::FeedforwardNumerator, Correction::Value(1.0)).source("TF5200 feedforward control"), as FF_SPEED_NUM: Number;
    axis("P-AXIS-00515", "vorsteuer.feedforward_v_add_denom", Raw::Uns32, "velocity-only weight denominator; 0 gives 110122/110123, both set to 1")
        .range(Bound::At(1.0), Bound::None).default(1.0).below(Condition::FeedforwardDenominator, Correction::Value(1.0)), as FF_SPEED_DENOM: Number;
    axis("P-AXIS-00547", "vorsteuer.jerk_delay_time", Raw::Uns16, "delay of the jerk part; too large gives 70348, 0")
        .range(Bound::None, Bound::BeyondCycles(6.0)).default(0.0).unit("us", "us").drives(&[DriveType::Sercos, DriveType::Profidrive, DriveType::Canopen]).above(Condition::AccelerationDelay, Correction::Value(0.0)), as FF_JERK_DELAY: Number;
    axis("P-AXIS-00566", "vorsteuer.feedforward_without_delay", Raw::Boolean, "no 5-cycle buffer, velocity feedforward only (else 110624)")
        .default(0.0), as FF_WITHOUT_DELAY: Switch;
    axis("P-AXIS-00833", "antr.feed_forward_v_weighting", Raw::Sgn16, "weight of velocity feedforward inside the drive (1000 = 100 %), replaces 00766")
        .range(Bound::At(0.0), Bound::At(1200.0)).default(0.0).unit("0.1%", "0.1%");
    axis("", "antr.sercos.at[i].ident_nr", Raw::Uns32, "ident number of entry i of the drive telegram")
        .source("TF5200 feedforward control");
    axis("", "antr.sercos.mdt[i].ident_len", Raw::Uns32, "length of entry i of the master telegram")
        .unit("byte", "byte").source("TF5200 feedforward control");
    axis("", "antr.sercos.mdt[i].nc_ref", Raw::Text, "what entry i of the master telegram carries: S_0_0037 additive velocity, S_0_0080 additive torque")
        .source("TF5200 feedforward control"), as TELEGRAM: Text;
}
