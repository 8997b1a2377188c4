//! `kontur.lis`: parameters beyond the vendor's lists. The index of `kontur.axis[i]` is the logical axis number.

use super::param::parameters;
use super::raw::{Bound, Raw};
use super::row::{Correction, Default, own};
use crate::diag::Condition;

/// Models of drive and mechanics.
const PLANTS: &[&str] = &["SIMU", "PT1", "TWO_MASS", "MODAL"];

parameters! {
    own("kontur.cycle_time_us", Raw::Uns32, "cycle time of the interpolator; there is no vendor parameter for it")
        .range(Bound::At(100.0), Bound::At(20000.0)).default(1000.0).unit("us", "us").outside(Condition::ListRange, Correction::Refuse), as CYCLE_TIME: Whole;
    own("kontur.axis[i].plant.model", Raw::Word(PLANTS), "drive and mechanics: SIMU the vendor's simulated drive, PT1 first order, TWO_MASS, MODAL rigid body with modes")
        .default_is(Default::Text("SIMU")), as PLANT_MODEL: Text;
    own("kontur.axis[i].plant.ta_us", Raw::Uns32, "PT1: time constant of the velocity loop")
        .range(Bound::At(1.0), Bound::None).default(5000.0).unit("us", "us").outside(Condition::ListRange, Correction::Refuse), as TIME_CONSTANT: Number;
    own("kontur.axis[i].plant.kp", Raw::Real64, "TWO_MASS, MODAL: gain of the velocity loop per unit of mass")
        .range(Bound::Beyond(0.0), Bound::None).default(200.0).unit("1/s", "1/s").outside(Condition::ListRange, Correction::Refuse), as SPEED_GAIN: Number;
    own("kontur.axis[i].plant.tn_us", Raw::Uns32, "TWO_MASS, MODAL: integral time of the velocity loop")
        .range(Bound::At(1.0), Bound::None).default(30000.0).unit("us", "us").outside(Condition::ListRange, Correction::Refuse), as SPEED_INTEGRAL: Number;
    own("kontur.axis[i].plant.ti_us", Raw::Uns32, "TWO_MASS, MODAL: time constant of the current loop")
        .range(Bound::At(1.0), Bound::None).default(500.0).unit("us", "us").outside(Condition::ListRange, Correction::Refuse), as CURRENT_TIME: Number;
    own("kontur.axis[i].plant.inertia", Raw::Real64, "inertia at the motor shaft, or moved mass of a linear motor, on which an additive torque actually acts; 0: value of the axis list (P-AXIS-00391)")
        .range(Bound::At(0.0), Bound::None).default(0.0).unit("kg m2 or kg", "kg m2").outside(Condition::ListRange, Correction::Refuse), as INERTIA: Number;
    own("kontur.axis[i].plant.mass_motor", Raw::Real64, "TWO_MASS: inertia on the motor side, relative to that on the load side; alone, its share of the whole, below 1")
        .range(Bound::Beyond(0.0), Bound::None).default(0.5).outside(Condition::ListRange, Correction::Refuse), as MASS_MOTOR: Number;
    own("kontur.axis[i].plant.mass_load", Raw::Real64, "TWO_MASS: inertia on the load side, relative to that on the motor side; alone, its share of the whole, below 1")
        .range(Bound::Beyond(0.0), Bound::None).default(0.5).outside(Condition::ListRange, Correction::Refuse), as MASS_LOAD: Number;
    own("kontur.axis[i].plant.f0", Raw::Real64, "TWO_MASS: natural frequency of the two free masses")
        .range(Bound::Beyond(0.0), Bound::None).default(50.0).unit("Hz", "Hz").outside(Condition::ListRange, Correction::Refuse), as RESONANCE: Number;
    own("kontur.axis[i].plant.damping", Raw::Real64, "TWO_MASS: damping of the natural frequency of the two free masses")
        .range(Bound::At(0.0), Bound::Beyond(1.0)).default(0.02).outside(Condition::ListRange, Correction::Refuse), as DAMPING: Number;
    own("kontur.axis[i].plant.mode[j].f0", Raw::Real64, "MODAL: natural frequency of mode j; a mode without a frequency does not exist")
        .range(Bound::Beyond(0.0), Bound::None).unit("Hz", "Hz").outside(Condition::ListRange, Correction::Refuse), as MODE_FREQUENCY: Optional;
    own("kontur.axis[i].plant.mode[j].damping", Raw::Real64, "MODAL: damping of mode j")
        .range(Bound::At(0.0), Bound::Beyond(1.0)).default(0.02).outside(Condition::ListRange, Correction::Refuse), as MODE_DAMPING: Number;
    own("kontur.axis[i].plant.mode[j].phi_motor", Raw::Real64, "MODAL: participation of mode j at the motor")
        .default(0.0), as MODE_MOTOR: Number;
    own("kontur.axis[i].plant.mode[j].phi_load", Raw::Real64, "MODAL: participation of mode j at the load encoder")
        .default(0.0), as MODE_LOAD: Number;
    own("kontur.axis[i].plant.mode[j].phi_tcp", Raw::Real64, "MODAL: participation of mode j at the tool point")
        .default(0.0), as MODE_TOOL: Number;
    own("kontur.axis[i].plant.mode[j].phi_dist", Raw::Real64, "MODAL: participation of mode j at the disturbance force")
        .default(0.0), as MODE_DISTURBANCE: Number;
    own("kontur.axis[i].plant.disturbance.amplitude", Raw::Real64, "amplitude of a disturbance force per unit of mass, sinusoidal, or constant with the frequency 0")
        .default(0.0).unit("mm/s2", "deg/s2"), as DISTURBANCE_AMPLITUDE: Number;
    own("kontur.axis[i].plant.disturbance.frequency", Raw::Real64, "frequency of the disturbance force, a sine that starts at 0 in the first computed cycle; 0: constant")
        .range(Bound::At(0.0), Bound::None).default(0.0).unit("Hz", "Hz").outside(Condition::ListRange, Correction::Refuse), as DISTURBANCE_FREQUENCY: Number;
    own("kontur.axis[i].plant.disturbance.full_speed", Raw::Real64, "load speed from which the disturbance has its full amplitude, proportional below; 0: always full")
        .range(Bound::At(0.0), Bound::None).default(0.0).unit("mm/s", "deg/s").outside(Condition::ListRange, Correction::Refuse), as DISTURBANCE_FULL_SPEED: Number;
    own("kontur.axis[i].load_encoder", Raw::Boolean, "the axis has a direct measuring system, which closes the position loop")
        .default(0.0), as LOAD_ENCODER: Switch;
    own("kontur.axis[i].additive.velocity", Raw::Boolean, "simulated drive: it has an additive velocity input")
        .default(0.0), as ADDITIVE_VELOCITY: Switch;
    own("kontur.axis[i].additive.torque", Raw::Boolean, "simulated drive: it has an additive torque input")
        .default(0.0), as ADDITIVE_TORQUE: Switch;
    own("kontur.axis[i].ipc.delay_cycles", Raw::Uns32, "cycles after which an additive speed of Improved Position Control acts")
        .range(Bound::At(0.0), Bound::At(5.0)).default(1.0).unit("cycles", "cycles").outside(Condition::ListRange, Correction::Refuse), as IPC_DELAY: Whole;
}
