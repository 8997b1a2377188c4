//! Axis lists: compensations and weightings of the control that are not simulated. If a list switches one on, a message
//! says so, see [`inert`](crate::machine); their other values are read and ignored.

use super::param::parameters;
use super::raw::{Bound, Raw};
use super::row::{DriveType, axis};

parameters! {
    axis("P-AXIS-00021", "lr_param.anwahl_losekomp", Raw::Uns16, "backlash compensation: 0 off, 1 last motion in the positive, 2 in the negative direction; not simulated")
        .range(Bound::At(0.0), Bound::At(2.0)).default(0.0);
    axis("P-AXIS-00047", "lr_param.crosscomp", Raw::Boolean, "cross compensation; not simulated")
        .default(0.0).axes("T");
    axis("P-AXIS-00103", "getriebe[i].lose", Raw::Sgn16, "backlash that P-AXIS-00021 compensates; not simulated")
        .default(0.0).unit("0.1um", "0.0001deg");
    axis("P-AXIS-00174", "lr_param.crosscomp2", Raw::Boolean, "plane compensation; not simulated")
        .default(0.0).axes("T");
    axis("P-AXIS-00175", "lr_param.ssfk", Raw::Boolean, "leadscrew error compensation; not simulated")
        .default(0.0).axes("TR");
    axis("P-AXIS-00230", "lr_hw[i].vz_istw", Raw::Boolean, "the sign of the encoder is reversed; read and ignored, positions have the sign of the program")
        .default(0.0);
    axis("P-AXIS-00231", "lr_hw[i].vz_stellgr", Raw::Boolean, "the sign of the command is reversed; not simulated")
        .default(0.0);
    axis("P-AXIS-00243", "lr_param.n_backlash_cyc", Raw::Uns16, "cycles over which a backlash is distributed; not simulated")
        .default(0.0).unit("cycles", "cycles");
    axis("P-AXIS-00271", "lr_param.temp_comp", Raw::Boolean, "temperature compensation; not simulated")
        .axes("TR");
    axis("P-AXIS-00431", "dynamic_weighting.enable", Raw::Boolean, "speed, acceleration and ramp time of rapid motions depend on their length; not simulated")
        .default(0.0).axes("TR");
    axis("P-AXIS-00432", "dynamic_weighting.param[i].path_limit", Raw::Uns32, "length up to which the weights of entry i apply; not simulated")
        .default(0.0).unit("0.1um", "0.0001deg").axes("TR");
    axis("P-AXIS-00433", "dynamic_weighting.param[i].velocity_fact", Raw::Uns32, "weight of the rapid speed; not simulated")
        .default(0.0).unit("0.1%", "0.1%").axes("TR");
    axis("P-AXIS-00434", "dynamic_weighting.param[i].acceleration_fact", Raw::Uns32, "weight of the rapid acceleration; not simulated")
        .default(0.0).unit("0.1%", "0.1%").axes("TR");
    axis("P-AXIS-00435", "dynamic_weighting.param[i].ramp_time_fact", Raw::Uns32, "weight of the rapid ramp time; not simulated")
        .default(0.0).unit("0.1%", "0.1%").axes("TR");
    axis("P-AXIS-00438", "kenngr.in_add_interface_filter_time", Raw::Uns32, "time constant of the older PT2 filter of the additional interface, 0 off; not simulated, P-AXIS-00742 replaces it")
        .default(0.0).unit("us", "us");
    axis("P-AXIS-00522", "lr_param.frict_comp", Raw::Boolean, "friction compensation; not simulated")
        .default(0.0).drives(&[DriveType::Sercos, DriveType::Canopen]).axes("TR");
    axis("P-AXIS-00789", "lr_param.crosstalk", Raw::Boolean, "crosstalk compensation; not simulated");
}
