//! Axis lists: modulo calculation, monitoring of the range, homing, gantries, collisions and spindles.

use super::param::parameters;
use super::raw::{Bound, Raw};
use super::row::{Default, axis};

parameters! {
    axis("P-AXIS-00043", "kenngr.coll_check_ax_nr", Raw::Uns32, "logical number of the axis from which this axis keeps the distance P-AXIS-00045, 0: none; not simulated")
        .default(0.0).axes("T").source("TF5200 axis collision monitoring 286694539");
    axis("P-AXIS-00044", "kenngr.coll_decelerate_chan", Raw::Boolean, "1: an error of one axis of a collision pair stops both channels; not simulated")
        .default(0.0).axes("T").source("TF5200 axis collision monitoring 286694539");
    axis("P-AXIS-00045", "kenngr.coll_offset", Raw::Uns32, "distance of P-AXIS-00043; not simulated")
        .default(0.0).unit("0.1um", "0.1um").axes("T").source("TF5200 axis parameters 117413899");
    axis("P-AXIS-00071", "kenngr.gantry_max_diff_reset_locked", Raw::Uns32, "difference of a gantry slave from its master at which the control stops until it is reset; not monitored")
        .unit("0.1um", "0.0001deg").axes("TR").source("TF5200 gantry operation 285747979");
    axis("P-AXIS-00072", "kenngr.gantry_max_diff_resetable", Raw::Uns32, "difference of a gantry slave from its master that the control can remove again; not monitored")
        .unit("0.1um", "0.0001deg").axes("TR").source("TF5200 gantry operation 285747979");
    axis("P-AXIS-00073", "kenngr.gantry_offset", Raw::Sgn32, "position of a gantry slave less that of its master; not simulated")
        .default(0.0).unit("0.1um", "0.0001deg").axes("TR").source("TF5200 axis parameters 117392395");
    axis("P-AXIS-00075", "kenngr.gantry_vb_korr", Raw::Uns32, "speed at which a gantry slave corrects its difference; no effect here, slaves have none at the start")
        .default(0.0).unit("um/s", "0.001deg/s").axes("TR").source("TF5200 axis parameters 117393931");
    axis("P-AXIS-00113", "kenngr.mess_neg_flanke", Raw::Boolean, "1: the probe signals at its falling edge; not simulated")
        .default(0.0).axes("TR").source("TF5200 axis parameters 117376011");
    axis("P-AXIS-00114", "kenngr.mess_offset", Raw::Uns32, "way that a measuring run of type 2 may continue beyond its target without a signal; not simulated")
        .default(0.0).unit("0.1um", "0.0001deg").axes("TR").source("TF5200 axis parameters 117323787");
    axis("P-AXIS-00120", "lr_param.mod_komp", Raw::Boolean, "compensation of the error of a modulo circle (P-AXIS-00124 every P-AXIS-00125 turns); not simulated")
        .default(0.0).axes("RS").source("TF5200 axis parameters 117204107");
    axis("P-AXIS-00124", "getriebe[i].modulo_fehler", Raw::Sgn16, "error of a modulo circle, see P-AXIS-00120; not simulated")
        .default(0.0).unit("increments", "increments").axes("RS").source("TF5200 axis parameters 117202571");
    axis("P-AXIS-00125", "getriebe[i].modulo_umdreh", Raw::Sgn16, "number of turns after which P-AXIS-00124 is corrected; not simulated")
        .default(0.0).axes("RS").source("TF5200 axis parameters 117201035");
    axis("P-AXIS-00152", "getriebe[i].pos_refpkt", Raw::Sgn32, "position of the axis after homing; no effect here, G74 leaves the position as it is (K-0111)")
        .default(0.0).unit("0.1um", "0.0001deg").source("TF5200 axis parameters 117242507");
    axis("P-AXIS-00159", "getriebe[i].reverse", Raw::Boolean, "the signs of the command and of the encoder of a spindle are reversed; no effect here, positions have the sign of the program")
        .default(0.0).axes("S").source("TF5200 axis parameters 117217931");
    axis("P-AXIS-00216", "getriebe[i].vb_min_null", Raw::Uns32, "speed below which a spindle counts as stopped for the PLC; read and ignored")
        .default(100.0).unit("0.001deg/s", "0.001deg/s").axes("S").source("TF5200 axis parameters 117216395");
    axis("P-AXIS-00217", "kenngr.vb_prozent", Raw::Uns16, "deviation of the actual speed, relative to the set one, within which a spindle counts as having reached it; 0: the default (110182)")
        .range(Bound::At(0.0), Bound::At(1000.0)).default(100.0).unit("0.1%", "0.1%").axes("S").source("TF5200 axis parameters 117211787"), as SPEED_BAND: Number;
    axis("P-AXIS-00220", "getriebe[i].vb_regelgrenze", Raw::Uns32, "speed above which a spindle leaves position control; not simulated")
        .default(200_000.0).unit("0.001deg/s", "0.001deg/s").axes("S").source("TF5200 axis parameters 117214859");
    axis("P-AXIS-00265", "antr.velocity_position_control_on", Raw::Sgn32, "speed above which a spindle leaves position control; not simulated")
        .range(Bound::At(0.0), Bound::None).default(2e9).unit("0.001deg/s", "0.001deg/s").axes("S").source("TF5200 axis parameters 117219467");
    axis("P-AXIS-00266", "antr.velocity_position_control_off", Raw::Sgn32, "speed at which M19 of a spindle above P-AXIS-00265 returns to position control; not simulated")
        .range(Bound::At(0.0), Bound::None).default(0.0).unit("0.001deg/s", "0.001deg/s").axes("S").source("TF5200 axis parameters 117221003");
    axis("P-AXIS-00277", "kenngr.prog_move_requires_homing", Raw::Boolean, "1: the axis does not move before homing; no effect here, every axis counts as homed")
        .default(0.0).source("TF5200 axis parameters 117251723");
    axis("P-AXIS-00328", "lr_param.distance_control_on", Raw::Boolean, "1: Z[DIST_CTRL ON] is permitted; no effect here, it is refused")
        .default(0.0).axes("TR").source("TF5200 axis parameters 117797003");
    axis("P-AXIS-00516", "kenngr.measure.signal", Raw::Text, "source of the signal of measuring runs; no effect here, it is that of the input file")
        .axes("TRS").source("TF5200 measurement 342092555");
    axis("P-AXIS-00517", "kenngr.measure.input", Raw::Uns08, "number of the probe input of a drive; no effect here, there is one probe")
        .axes("TRS").source("TF5200 measurement 342092555");
    axis("P-AXIS-00518", "kenngr.measure.edge", Raw::Word(&["POS", "NEG"]), "edge at which the probe signals, replaces P-AXIS-00113; NEG is not simulated")
        .default_is(Default::Text("POS")).axes("TRS").source("TF5200 axis parameters 117331467"), as PROBE_EDGE: Text;
    axis("P-AXIS-00557", "getriebe[i].modulo_calculation", Raw::Sgn08, "modulo calculation: -1 as in P-AXIS-00015, 0 off, 1 on (rotary axes)")
        .range(Bound::At(-1.0), Bound::At(1.0)).default(-1.0).axes("TR").source("TF5200 axis parameters 117205643"), as MODULO_CALCULATION: Number;
    axis("P-AXIS-00705", "kenngr.swe_check", Raw::Sgn08, "software limits: -1 for linear axes and rotary axes that are not modulo, 0 off, 1 on")
        .range(Bound::At(-1.0), Bound::At(1.0)).default(-1.0).axes("TR").source("TF5200 axis parameters 117316107"), as LIMIT_CHECK: Number;
    axis("P-AXIS-00767", "antr.sai_op_mode_change.v_velocity_control_on", Raw::Sgn32, "replaces P-AXIS-00265; not simulated")
        .range(Bound::At(0.0), Bound::None).default(2e9).unit("0.001deg/s", "0.001deg/s").axes("S").source("TF5200 axis parameters 795507339");
    axis("P-AXIS-00768", "antr.sai_op_mode_change.v_position_control_on", Raw::Sgn32, "replaces P-AXIS-00266; not simulated")
        .range(Bound::At(0.0), Bound::None).default(0.0).unit("0.001deg/s", "0.001deg/s").axes("S").source("TF5200 axis parameters 795511947");
    axis("P-AXIS-00838", "kenngr.vb_prozent_dyn_dz", Raw::Uns16, "deviation as in P-AXIS-00217 for speeds above P-AXIS-00840; not simulated")
        .range(Bound::At(0.0), Bound::At(1000.0)).default(0.0).unit("0.1%", "0.1%").axes("S").source("TF5200 axis parameters 1244716939");
}
