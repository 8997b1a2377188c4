//! Axis lists: velocity, acceleration and ramp times.

use super::param::parameters;
use super::raw::{Bound, Raw};
use super::row::{Correction, Default, axis};
use crate::diag::Condition;

parameters! {
    axis("P-AXIS-00001", "getriebe[i].slope_profil.a_beschl", Raw::Uns32, "acceleration, non-linear slope, feed")
        .range(Bound::At(1.0), Bound::Of("P-AXIS-00008")).default(1000.0).unit("mm/s2", "deg/s2").below(Condition::FeedAccelerationZero, Correction::Default).axes("TR"), as FEED_ACC: Number;
    axis("P-AXIS-00002", "getriebe[i].slope_profil.a_brems", Raw::Uns32, "deceleration, non-linear slope, feed")
        .range(Bound::At(1.0), Bound::Of("P-AXIS-00008")).default(1000.0).unit("mm/s2", "deg/s2").below(Condition::FeedDecelerationZero, Correction::Default), as FEED_DEC: Number;
    axis("P-AXIS-00003", "getriebe[i].dynamik.a_emergency", Raw::Uns32, "braking in error stops; 0 = a_max")
        .range(Bound::At(1.0), Bound::Times(2.0, "P-AXIS-00008")).default(0.0).unit("mm/s2", "deg/s2").special(0.0), as EMERGENCY_DEC: Number;
    axis("P-AXIS-00004", "getriebe[i].slope_profil.a_grenz", Raw::Uns32, "acceleration and deceleration in rapid, non-linear slope")
        .range(Bound::At(1.0), Bound::Of("P-AXIS-00008")).default(1000.0).unit("mm/s2", "deg/s2"), as RAPID_ACC: Number;
    axis("P-AXIS-00005", "getriebe[i].lslope_profil.a_grenz_stufe_1", Raw::Uns32, "STEP slope in rapid, step 1")
        .range(Bound::At(1.0), Bound::Of("P-AXIS-00008")).default(1000.0).unit("mm/s2", "deg/s2"), as STEP_RAPID_ACC_1: Number;
    axis("P-AXIS-00006", "getriebe[i].lslope_profil.a_grenz_stufe_2", Raw::Uns32, "STEP slope in rapid, step 2")
        .range(Bound::At(1.0), Bound::Of("P-AXIS-00008")).default(1000.0).unit("mm/s2", "deg/s2"), as STEP_RAPID_ACC_2: Number;
    axis("P-AXIS-00008", "getriebe[i].dynamik.a_max", Raw::Uns32, "maximum axis acceleration")
        .range(Bound::At(1.0), Bound::At(100000000.0)).default(1000.0).unit("mm/s2", "deg/s2"), as ACC_MAX: Number;
    axis("P-AXIS-00011", "getriebe[i].lslope_profil.a_stufe_1", Raw::Uns32, "STEP slope, acceleration below the switching speed")
        .range(Bound::At(1.0), Bound::Of("P-AXIS-00008")).default(1000.0).unit("mm/s2", "deg/s2"), as STEP_ACC_1: Number;
    axis("P-AXIS-00012", "getriebe[i].lslope_profil.a_stufe_2", Raw::Uns32, "STEP slope, acceleration above the switching speed")
        .range(Bound::At(1.0), Bound::Of("P-AXIS-00008")).default(1000.0).unit("mm/s2", "deg/s2"), as STEP_ACC_2: Number;
    axis("P-AXIS-00013", "getriebe[i].dynamik.a_trans_weight", Raw::Uns32, "weight of the acceleration allowed at a block transition with a kink, non-linear slope only; 0 or absent = cycle time / ramp time")
        .range(Bound::At(1.0), Bound::At(1000.0)).default(0.0).unit("0.1%", "0.1%").special(0.0), as KINK_ACC_WEIGHT: Number;
    axis("P-AXIS-00024", "getriebe[i].lslope_profil.a_feedh", Raw::Uns32, "STEP feedhold deceleration; 0 = min(00005, 00006), only with P-CHAN-00097 = 1")
        .range(Bound::At(0.0), Bound::Of("P-AXIS-00008")).default(0.0).unit("mm/s2", "deg/s2"), as STEP_FEEDHOLD_DEC: Number;
    axis("P-AXIS-00053", "getriebe[i].slope_profil.a_feedh", Raw::Uns32, "feedhold deceleration, 0 = a_grenz, only with P-CHAN-00097 = 1")
        .range(Bound::At(1.0), Bound::Of("P-AXIS-00008")).default(0.0).unit("mm/s2", "deg/s2").special(0.0), as FEEDHOLD_DEC: Number;
    axis("P-AXIS-00081", "getriebe[i].slope_profil.tr_feedh", Raw::Uns32, "feedhold ramp time, 0 = tr_grenz, only with P-CHAN-00097 = 1")
        .range(Bound::Of("P-AXIS-00201"), Bound::None).default(0.0).unit("us", "us").special(0.0), as FEEDHOLD_RAMP: Number;
    axis("P-AXIS-00082", "handbetrieb.ipo.hb_proz_a_max", Raw::Uns16, "G201: share of the acceleration P-AXIS-00008 for manual mode; no effect here, nobody moves the axes by hand")
        .range(Bound::At(0.0), Bound::At(100.0)).default(30.0).unit("%", "%").axes("TR").source("TF5200 axis parameters 118141195");
    axis("P-AXIS-00083", "handbetrieb.ipo.hb_proz_v_max", Raw::Uns16, "G201: share of the speed P-AXIS-00212 for manual mode; no effect here, nobody moves the axes by hand")
        .range(Bound::At(0.0), Bound::At(100.0)).default(30.0).unit("%", "%").axes("TR").source("TF5200 axis parameters 118138123");
    axis("P-AXIS-00094", "handbetrieb.ipo.ipo_proz_a_max", Raw::Uns16, "G201: share of the acceleration P-AXIS-00008 that the path may use; 100 together with P-AXIS-00082")
        .range(Bound::At(0.0), Bound::At(100.0)).default(70.0).unit("%", "%").axes("TR").source("TF5200 axis parameters 118142731"), as PATH_ACC_SHARE: Number;
    axis("P-AXIS-00095", "handbetrieb.ipo.ipo_proz_v_max", Raw::Uns16, "G201: share of the speed P-AXIS-00212 that the path may use; 100 together with P-AXIS-00083")
        .range(Bound::At(0.0), Bound::At(100.0)).default(70.0).unit("%", "%").axes("TR").source("TF5200 axis parameters 118139659"), as PATH_SPEED_SHARE: Number;
    axis("P-AXIS-00154", "getriebe[i].dynamik.r_trans_weight", Raw::Uns32, "weight of the jerk allowed at tangential linear/circular transitions (needs P-CHAN-00009)")
        .range(Bound::At(0.0), Bound::At(1000.0)).default(1000.0).unit("0.1%", "0.1%"), as TANGENTIAL_JERK_WEIGHT: Number;
    axis("P-AXIS-00195", "getriebe[i].slope_profil.tr_beschl_ab", Raw::Uns32, "ramp time for reducing acceleration")
        .range(Bound::Of("P-AXIS-00201"), Bound::None).default(50000.0).unit("us", "us"), as RAMP_ACC_DOWN: Number;
    axis("P-AXIS-00196", "getriebe[i].slope_profil.tr_beschl_zu", Raw::Uns32, "ramp time for building up acceleration")
        .range(Bound::Of("P-AXIS-00201"), Bound::None).default(50000.0).unit("us", "us"), as RAMP_ACC_UP: Number;
    axis("P-AXIS-00197", "getriebe[i].slope_profil.tr_brems_ab", Raw::Uns32, "ramp time for reducing deceleration")
        .range(Bound::Of("P-AXIS-00201"), Bound::None).default(50000.0).unit("us", "us"), as RAMP_DEC_DOWN: Number;
    axis("P-AXIS-00198", "getriebe[i].slope_profil.tr_brems_zu", Raw::Uns32, "ramp time for building up deceleration")
        .range(Bound::Of("P-AXIS-00201"), Bound::None).default(50000.0).unit("us", "us"), as RAMP_DEC_UP: Number;
    axis("P-AXIS-00199", "getriebe[i].dynamik.tr_geom", Raw::Uns32, "geometric ramp time: limits the jerk that comes from the contour")
        .range(Bound::Of("P-AXIS-00201"), Bound::None).default(10000.0).unit("us", "us").below(Condition::GeometricRampTime, Correction::Limit), as GEOMETRIC_RAMP: Number;
    axis("P-AXIS-00200", "getriebe[i].slope_profil.tr_grenz", Raw::Uns32, "ramp time in rapid (replaces the four)")
        .range(Bound::Of("P-AXIS-00201"), Bound::None).default(10000.0).unit("us", "us"), as RAPID_RAMP: Number;
    axis("P-AXIS-00201", "getriebe[i].dynamik.tr_min", Raw::Uns32, "shortest ramp time = jerk limit of the axis")
        .range(Bound::At(0.0), Bound::None).default(10000.0).unit("us", "us").below(Condition::ShortestRampTime, Correction::Limit), as SHORTEST_RAMP: Number;
    axis("P-AXIS-00202", "getriebe[i].beschl_kennlinie.typ", Raw::Uns32, "spindle acceleration curve 0 none 1 hyperbola 2 polynomial 3 asynchronous drive")
        .range(Bound::At(0.0), Bound::At(3.0)).default(0.0).above(Condition::AccelerationCurve, Correction::Refuse).axes("S");
    axis("P-AXIS-00007", "getriebe[i].beschl_kennlinie.a_konst", Raw::Uns32, "acceleration below P-AXIS-00130, curves 1 and 2; not simulated")
        .default(0.0).unit("-", "deg/s2").axes("S");
    axis("P-AXIS-00010", "getriebe[i].beschl_kennlinie.a_min", Raw::Real64, "minimum acceleration of the curve; not simulated")
        .unit("-", "deg/s2").axes("S");
    axis("P-AXIS-00130", "getriebe[i].beschl_kennlinie.n_grenz", Raw::Uns32, "speed above which curves 1 and 2 decrease; not simulated")
        .default(0.0).unit("-", "0.001deg/s").axes("S");
    axis("P-AXIS-00240", "getriebe[i].beschl_kennlinie.a_max", Raw::Real64, "acceleration below P-AXIS-00241, curve 3; not simulated")
        .default(0.0).unit("-", "deg/s2").axes("S");
    axis("P-AXIS-00241", "getriebe[i].beschl_kennlinie.n1", Raw::Real64, "speed above which curve 3 decreases with 1/n; not simulated")
        .default(0.0).unit("-", "0.001deg/s").axes("S");
    axis("P-AXIS-00242", "getriebe[i].beschl_kennlinie.n2", Raw::Real64, "speed above which curve 3 decreases with 1/n2; not simulated")
        .default(0.0).unit("-", "0.001deg/s").axes("S");
    axis("P-AXIS-00208", "", Raw::Uns32, "not found in any public document; read and ignored");
    axis("P-AXIS-00209", "getriebe[i].vb_eilgang", Raw::Uns32, "rapid speed G00")
        .range(Bound::At(1.0), Bound::Of("P-AXIS-00212")).default(166666.0).unit("um/s", "0.001deg/s"), as RAPID_SPEED: Number;
    axis("P-AXIS-00211", "getriebe[i].lslope_profil.vb_grenz_stufe_1_2", Raw::Uns32, "STEP slope in rapid, switching speed")
        .range(Bound::At(1.0), Bound::Of("P-AXIS-00212")).default(100000.0).unit("um/s", "0.001deg/s"), as STEP_RAPID_CHANGE: Number;
    axis("P-AXIS-00212", "getriebe[i].dynamik.vb_max", Raw::Uns32, "maximum axis speed")
        .range(Bound::At(1.0), Bound::At(2000000000.0)).default(200000.0).unit("um/s", "0.001deg/s").below(Condition::AxisSpeedZero, Correction::Default), as SPEED_MAX: Number;
    axis("P-AXIS-00214", "getriebe[i].vb_max_red", Raw::Uns32, "reduced speed, not active in the simulation")
        .unit("um/s", "0.001deg/s");
    axis("P-AXIS-00221", "getriebe[i].lslope_profil.vb_stufe_1_2", Raw::Uns32, "STEP slope switching speed")
        .range(Bound::At(1.0), Bound::Of("P-AXIS-00212")).default(100000.0).unit("um/s", "0.001deg/s"), as STEP_CHANGE: Number;
    axis("P-AXIS-00270", "getriebe[i].slope_type", Raw::Uns16, "slope of homing, and of spindles before V2.11.2800; not of the path")
        .range(Bound::At(0.0), Bound::At(3.0)).default(0.0).above(Condition::SpindleSlopeType, Correction::Default);
    axis("P-AXIS-00280", "getriebe[i].lslope_profil.d_grenz_stufe_1", Raw::Uns32, "STEP deceleration in rapid, stage 1; 0 = P-AXIS-00005")
        .range(Bound::At(1.0), Bound::Of("P-AXIS-00008")).default(0.0).unit("mm/s2", "deg/s2").special(0.0), as STEP_RAPID_DEC_1: Number;
    axis("P-AXIS-00281", "getriebe[i].lslope_profil.d_grenz_stufe_2", Raw::Uns32, "STEP slope in rapid, deceleration step 2; 0 = P-AXIS-00006")
        .range(Bound::At(1.0), Bound::Of("P-AXIS-00008")).default(0.0).unit("mm/s2", "deg/s2").special(0.0), as STEP_RAPID_DEC_2: Number;
    axis("P-AXIS-00282", "getriebe[i].lslope_profil.d_stufe_1", Raw::Uns32, "STEP deceleration, stage 1; 0 = a_stufe_1")
        .range(Bound::At(1.0), Bound::Of("P-AXIS-00008")).default(0.0).unit("mm/s2", "deg/s2").special(0.0), as STEP_DEC_1: Number;
    axis("P-AXIS-00283", "getriebe[i].lslope_profil.d_stufe_2", Raw::Uns32, "STEP deceleration, stage 2; 0 = a_stufe_2")
        .range(Bound::At(1.0), Bound::Of("P-AXIS-00008")).default(0.0).unit("mm/s2", "deg/s2").special(0.0), as STEP_DEC_2: Number;
    axis("P-AXIS-00339", "getriebe[i].dynamik.j_trans_c0", Raw::Real64, "jerk at kinked transitions (P-CHAN-00117 = 2)")
        .range(Bound::At(0.0), Bound::None).default(0.0).unit("m/s3", "1000deg/s3").axes("TR"), as KINK_JERK: Number;
    axis("P-AXIS-00340", "getriebe[i].dynamik.j_trans_c1", Raw::Real64, "jerk at tangential transitions (P-CHAN-00117 = 2)")
        .range(Bound::At(0.0), Bound::None).default(0.0).unit("m/s3", "1000deg/s3").axes("TR"), as TANGENTIAL_JERK: Number;
    axis("P-AXIS-00292", "getriebe[i].dynamik.a_w_max", Raw::Uns32, "maximum acceleration under G130/G131 weighting")
        .range(Bound::GreatestOf(&["P-AXIS-00001", "P-AXIS-00002"]), Bound::Of("P-AXIS-00008")).default_is(Default::Of("P-AXIS-00008")).unit("mm/s2", "deg/s2").axes("TR"), as WEIGHTED_ACC_MAX: Number;
    axis("P-AXIS-00293", "getriebe[i].dynamik.tr_w_min", Raw::Uns32, "lower limit of the ramp time under G132/G133 (110406)")
        .range(Bound::Of("P-AXIS-00201"), Bound::LeastOf(&["P-AXIS-00195", "P-AXIS-00196", "P-AXIS-00197", "P-AXIS-00198"])).default(0.0).unit("us", "us").axes("TR").special(0.0).below(Condition::WeightedRampFloor, Correction::Limit), as WEIGHTED_RAMP_MIN: Number;
}
