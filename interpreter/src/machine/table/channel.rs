//! Channel lists.

use super::param::parameters;
use super::raw::{Bound, Raw};
use super::row::{Correction, Default, chan};
use super::start_up::FUNCTIONS;
use crate::diag::Condition;

/// Kinds of synchronisation with the PLC (P-CHAN-00041).
pub(crate) const SYNCHRONISATION: &[(&str, u32)] = &[
    ("NOT_VALID", 0x0),
    ("NO_SYNCH", 0x0),
    ("MOS", 0x1),
    ("MVS_SVS", 0x2),
    ("MVS_SNS", 0x4),
    ("MNS_SNS", 0x8),
    ("MNE_SNS", 0x20),
    ("MVS_SLM", 0x4000),
    ("MVS_SLP", 0x8000),
    ("PLC_INFO", 0x2_0000),
    ("BWD_SYNCH", 0x40_0000),
    ("FWD_SYNCH", 0x80_0000),
    ("MEP_SVS", 0x100_0000),
    ("MET_SVS", 0x200_0000),
    ("FAW_SYNCH", 0x1000_0000),
    // the documents do not print their numbers; they need no acknowledgement, like MOS
    ("MOS_TS", 0x1),
    ("MEP_MOS", 0x1),
    ("MET_MOS", 0x1),
];

/// MOS: nothing is acknowledged.
pub(crate) const WITHOUT_ACKNOWLEDGEMENT: u32 = 0x1;

/// Bits of [`SYNCHRONISATION`] for which the path waits before the motion of the block: MVS_SVS.
pub(crate) const BEFORE_MOTION: u32 = 0x2;

/// MVS_SNS: called before the motion, waited for after it.
pub(crate) const DURING_MOTION: u32 = 0x4;

/// MNS_SNS: called and waited for after the motion.
pub(crate) const BEHIND_MOTION: u32 = 0x8;

/// MNE_SNS: called by the signal of edge banding.
pub(crate) const AT_SIGNAL: u32 = 0x20;

/// Kinds with which the path of the control waits elsewhere, and where.
pub(crate) const ELSEWHERE: [(u32, &str, &str); 5] = [
    (AT_SIGNAL, "MNE_SNS", "after the signal of edge banding"),
    (
        0x4000,
        "MVS_SLM",
        "before the next G01, G02 or G03 block for what is left, or not at all up to the end of the program",
    ),
    (
        0x8000,
        "MVS_SLP",
        "at the next #EXPL SYN for what is left, or not at all up to the end of the program",
    ),
    (0x100_0000, "MEP_SVS", "for what is left, since it gets the function early (m_pre_outp)"),
    (0x200_0000, "MET_SVS", "for what is left, since it gets the function early (m_pre_outp)"),
];

/// Overrides of rapid blocks (P-CHAN-00181).
const RAPID_OVERRIDES: &[(&str, u32)] =
    &[("NOT_USED", 0), ("MINIMUM_OF_G0_G1", 1), ("ACTIVE", 2), ("ACTIVE_EXTENDED", 3)];

parameters! {
    chan("P-CHAN-00001", "prog_start.slope.acceleration", Raw::Sgn16, "which accelerations G130 and G131 weight: 0 all, 1 a_beschl, 2 a_brems")
        .range(Bound::At(0.0), Bound::At(2.0)).default(0.0), as ACC_SELECTION: Whole;
    chan("P-CHAN-00002", "vector.acceleration", Raw::Real64, "path acceleration limit, unit by P-CHAN-00351, after #VECTOR LIMIT ON")
        .range(Bound::Beyond(0.0), Bound::None).default(100000000.0).unit("mm/min2 or mm/s2", "mm/min2 or mm/s2").outside(Condition::ListRange, Correction::Default), as PATH_ACC: Number;
    chan("P-CHAN-00003", "gruppe[i].achs_anzahl", Raw::Uns16, "axes in the group")
        .range(Bound::At(0.0), Bound::At(32.0)).default(0.0), as AXIS_COUNT: Whole;
    chan("P-CHAN-00004", "spindel[i].autom_range", Raw::Boolean, "the gear of a spindle follows from its S word; not simulated")
        .default(0.0).source("TF5200 channel parameters 147959819");
    chan("P-CHAN-00005", "gruppe[i].bezeichnung", Raw::Text, "name of the group");
    chan("P-CHAN-00006", "gruppe[i].achse[j].bezeichnung", Raw::Text, "axis name in the NC program; first letter A B C U V W X Y Z Q, then letters, digits (and _), unique"), as AXIS_NAME: Text;
    chan("P-CHAN-00007", "spindel[i].bezeichnung", Raw::Text, "spindle name"), as SPINDLE_NAME: Text;
    chan("P-CHAN-00009", "corr_v_trans_jerk", Raw::Boolean, "limit the jerk at tangential transitions")
        .default(0.0), as LIMIT_TANGENTIAL_JERK: Switch;
    chan("P-CHAN-00011", "gruppe[i].achse[j].default_feed_axis", Raw::Boolean, "member of the feed group; none given: the main axes")
        .default(0.0), as FEED_AXIS: Switch;
    chan("P-CHAN-00012", "speed_limit_look_ahead.dist_from_corner", Raw::Real64, "velocity look-ahead for the PLC: distance after the corner; read and ignored");
    chan("P-CHAN-00019", "syn_chk.errors_total", Raw::Uns16, "syntax check: stop after this many errors (old key syn_chk.fehler_gesamt); no effect here, a check reports up to 20")
        .range(Bound::At(0.0), Bound::At(65535.0)).default(0.0);
    chan("P-CHAN-00020", "syn_chk.errors_per_block", Raw::Uns16, "errors per line before going to the next (old key syn_chk.fehler_pro_zeile); no effect here")
        .range(Bound::At(0.0), Bound::At(65535.0)).default(0.0);
    chan("P-CHAN-00023", "grp_anzahl", Raw::Uns16, "number of axis groups, always 1")
        .range(Bound::At(0.0), Bound::At(1.0)).default(1.0);
    chan("P-CHAN-00028", "syn_chk.interaktiv", Raw::Uns16, "0 automatic, 1 step by step; newer key name not seen; no effect here")
        .range(Bound::At(0.0), Bound::At(1.0));
    chan("P-CHAN-00035", "gruppe[i].achse[j].log_achs_nr", Raw::Uns16, "logical axis number: links the name to the axis list with the same kopf.achs_nr; 0 not allowed, unique")
        .range(Bound::At(0.0), Bound::At(65535.0)), as AXIS_NUMBER: Whole;
    chan("P-CHAN-00036", "spindel[i].log_achs_nr", Raw::Uns16, "logical axis number of the spindle")
        .range(Bound::At(1.0), Bound::At(65535.0)), as SPINDLE_NUMBER: Whole;
    chan("P-CHAN-00037", "synchro_data.koppel_gruppe[i].paar[j].log_achs_nr_master", Raw::Uns16, "logical number of the master of pair j of coupling group 0, which #ENABLE AX LINK [0] switches on")
        .default(0.0), as COUPLING_MASTER: Whole;
    chan("P-CHAN-00038", "synchro_data.koppel_gruppe[i].paar[j].log_achs_nr_slave", Raw::Uns16, "logical number of its slave")
        .default(0.0), as COUPLING_SLAVE: Whole;
    chan("P-CHAN-00054", "mass_einh", Raw::Uns08, "0 mm, 1 inch for all linear axes")
        .range(Bound::At(0.0), Bound::At(1.0)).default(0.0), as INCH: Switch;
    chan("P-CHAN-00030", "kasto_residual_path", Raw::Sgn32, "edge banding: distance after the probe signal")
        .range(Bound::At(0.0), Bound::None).default(0.0).unit("0.1um", "0.1um").source("TF5200 channel parameters"), as RESIDUAL_PATH: Number;
    chan("P-CHAN-00029", "kasto_multi_block", Raw::Boolean, "edge banding: 1 over several blocks, to G107 (not supported with G108)")
        .default(0.0).source("TF5200 channel parameters"), as BANDING_OVER_BLOCKS: Switch;
    chan("P-CHAN-00039", "m_default_outp_ax_name[i]", Raw::Text, "axis or spindle to which M function i is output; motion is not affected, but the axis cannot move independently in the block of the function")
        .source("TF5200 M and H functions 286205579"), as M_OUTPUT: Text;
    chan("P-CHAN-00025", "h_default_outp_ax_name[i]", Raw::Text, "axis or spindle to which H function i is output; read and ignored, motion is not affected")
        .source("TF5200 M and H functions 286205579");
    chan("P-CHAN-00041", "m_synch[i]", Raw::Flags(SYNCHRONISATION), "when M function i is output to the PLC and acknowledged; MNE_SNS is for G108; with --techno-times MVS_SVS waits before the motion, MVS_SNS for the rest at its end, MNS_SNS after it, MOS and NO_SYNCH never, MVS_SLM, MVS_SLP, MEP_SVS, MET_SVS and MNE_SNS without G108 before the motion, unlike the control (K-0111); otherwise all are acknowledged at once here")
        .source("TF5200 channel parameters"), as M_SYNCHRONISATION: Optional;
    chan("P-CHAN-00027", "h_synch[i]", Raw::Flags(SYNCHRONISATION), "when H function i is output to the PLC and acknowledged; with --techno-times MVS_SVS waits before the motion, MVS_SNS for the rest at its end, MNS_SNS after it, MOS and NO_SYNCH never; otherwise all are acknowledged at once here")
        .source("TF5200 channel parameters"), as H_SYNCHRONISATION: Optional;
    chan("P-CHAN-00069", "spindel[i].plc_control", Raw::Boolean, "the PLC controls the spindle: its bracket only takes M3, M4, M5, M19, REV and POS; simulated as a spindle of the control")
        .default(0.0).source("TF5200 channel parameters"), as PLC_SPINDLE: Switch;
    chan("P-CHAN-00045", "spindel[i].m3_synch", Raw::Flags(SYNCHRONISATION), "when M3 acts and is acknowledged: MVS_SVS before the motion, which waits until the spindle has reached the commanded state, MVS_SNS before the motion and waited for after it, MNS_SNS after the motion and waited for; others before the motion and not waited for")
        .source("TF5200 channel parameters"), as SPINDLE_M3_SYNCHRONISATION: Optional;
    chan("P-CHAN-00047", "spindel[i].m4_synch", Raw::Flags(SYNCHRONISATION), "when M4 acts and is acknowledged: MVS_SVS before the motion, which waits until the spindle has reached the commanded state, MVS_SNS before the motion and waited for after it, MNS_SNS after the motion and waited for; others before the motion and not waited for")
        .source("TF5200 channel parameters"), as SPINDLE_M4_SYNCHRONISATION: Optional;
    chan("P-CHAN-00049", "spindel[i].m5_synch", Raw::Flags(SYNCHRONISATION), "when M5 acts and is acknowledged: MVS_SVS before the motion, which waits until the spindle has reached the commanded state, MVS_SNS before the motion and waited for after it, MNS_SNS after the motion and waited for; others before the motion and not waited for; without it M5 acts after the motion")
        .source("TF5200 channel parameters"), as SPINDLE_M5_SYNCHRONISATION: Optional;
    chan("P-CHAN-00043", "spindel[i].m19_synch", Raw::Flags(SYNCHRONISATION), "when M19 acts and is acknowledged: MVS_SVS before the motion, which waits until the spindle has reached the commanded state, MVS_SNS before the motion and waited for after it, MNS_SNS after the motion and waited for; others before the motion and not waited for")
        .source("TF5200 channel parameters"), as SPINDLE_M19_SYNCHRONISATION: Optional;
    chan("P-CHAN-00081", "spindel[i].s_synch", Raw::Flags(SYNCHRONISATION), "when the S word acts and is acknowledged: MVS_SVS before the motion, which waits until the spindle has reached the commanded state, MVS_SNS before the motion and waited for after it, MNS_SNS after the motion and waited for; others before the motion and not waited for")
        .source("TF5200 channel parameters"), as SPINDLE_SPEED_SYNCHRONISATION: Optional;
    chan("P-CHAN-00070", "m_pre_outp[i]", Raw::Uns32, "distance (0.1 um, MEP) or time (us, MET) by which M function i is output early; read and ignored, motion is not affected")
        .default(0.0).source("TF5200 channel parameters");
    chan("P-CHAN-00107", "h_pre_outp[i]", Raw::Uns32, "distance (0.1 um, MEP) or time (us, MET) by which H function i is output early; read and ignored, motion is not affected")
        .default(0.0).source("TF5200 channel parameters");
    chan("P-CHAN-00397", "coordinate_system.axes_offsets_layer_specific", Raw::Boolean, "offsets of axes that are not main axes: 1 belong to the coordinate system in which they are programmed, 0 to the channel")
        .default(1.0).source("TF5200 channel parameters"), as OFFSETS_IN_SYSTEMS: Switch;
    chan("P-CHAN-00100", "move_tool_offsets_directly", Raw::Boolean, "0: a new tool moves an axis with its next absolute word, 1: at once with D")
        .default(0.0).source("TF5200 channel parameters"), as TOOL_OFFSETS_AT_ONCE: Switch;
    chan("P-CHAN-00346", "enable_mod_axis_always_shortest_way", Raw::Boolean, "1: absolute words of modulo axes always take the shortest way, their first sign belongs to the position")
        .default(0.0).source("TF5200 channel parameters"), as SHORTEST_WAY: Switch;
    chan("P-CHAN-00057", "messtyp", Raw::Uns16, "measuring type at program start, see #MEAS; no document prints a default, here 1")
        .range(Bound::At(1.0), Bound::At(7.0)).default(1.0).source("TF5200 channel parameters"), as MEASURING_TYPE: Whole;
    chan("P-CHAN-00176", "meas_error_no_signal", Raw::Boolean, "measuring type 1: with 1, a measuring run without a probe signal is an error")
        .default(0.0).source("TF5200 channel parameters"), as MISSING_SIGNAL_IS_ERROR: Switch;
    chan("P-CHAN-00296", "meas_use_std_dynamic", Raw::Boolean, "measuring runs: 0 with the accelerations and ramp times of rapid blocks and without weights, 1 with those of feed blocks")
        .default(0.0).source("TF5200 channel parameters"), as MEASURES_AS_FEED: Switch;
    chan("P-CHAN-00214", "meas_deceleration_mode", Raw::Uns16, "braking at the probe signal: 0 as feedhold does (P-CHAN-00097), 1 with the deceleration of rapid blocks")
        .range(Bound::At(0.0), Bound::At(1.0)).default(0.0).source("TF5200 channel parameters"), as PROBE_BRAKING: Whole;
    chan("P-CHAN-00056", "max_vb_override", Raw::Uns16, "maximum override of --input; only limits if given in the list")
        .range(Bound::At(0.0), Bound::At(2000.0)).default(1000.0).unit("0.1%", "0.1%").above(Condition::MostOverride, Correction::Limit).source("TF5200 channel parameters"), as MOST_OVERRIDE: Number;
    chan("P-CHAN-00059", "mittelpkt_diff", Raw::Uns32, "G165: maximum centre shift, absolute")
        .range(Bound::Beyond(0.0), Bound::None).default(20000.0).unit("0.0001mm", "0.0001mm").below(Condition::CentreShiftZero, Correction::Default).source("TF5200 programming"), as CENTRE_SHIFT: Number;
    chan("P-CHAN-00060", "mittelpkt_faktor", Raw::Uns16, "G165: maximum centre shift relative to the radius")
        .range(Bound::At(1.0), Bound::None).below(Condition::CentreFactorZero, Correction::Default).default(50.0).unit("0.1%", "0.1%"), as CENTRE_SHIFT_RATIO: Number;
    chan("P-CHAN-00062", "makro_def[i].nc_code", Raw::Code, "NC code of a macro available in every program, to the end of the line; \\\"NAME\\\" in it uses another one")
        .source("TF5200 channel parameters"), as MACRO_CODE: Text;
    chan("P-CHAN-00063", "prog_start.g_gruppe[i].nr", Raw::Sgn16, "start value of G group i (0..37), -1: built-in start value; a preset 135 of group 21 has no effect, see P-AXIS-00255")
        .range(Bound::At(-1.0), Bound::None).default(-1.0), as G_GROUP: Optional;
    chan("P-CHAN-00064", "prog_start.m_gruppe[i].nr", Raw::Sgn16, "spindle function at program start (i = 0): 3, 4 or 5 for M3, M4, M5, -1: M5; the spindle turns from the first S word on")
        .range(Bound::At(3.0), Bound::At(5.0)).default(-1.0).special(-1.0).outside(Condition::ListRange, Correction::Default).source("TF5200 channel parameters 149293835"), as M_GROUP: Whole;
    chan("P-CHAN-00033", "prog_start.late_sync_ready", Raw::Boolean, "1: the end of the program waits for functions with late synchronisation (MVS_SLM, MVS_SLP); no effect here, --techno-times waits for them in their own block")
        .default(0.0).source("TF5200 channel parameters 149306123");
    chan("P-CHAN-00066", "override_weight_prog_feed", Raw::Uns16, "what a real-time override multiplies: 0 the velocity that feed, axes and curves allow, 1 the programmed feed, 2 as 0, but as 1 under a velocity of #VECTOR LIMIT; speeds at corners of the path are not changed; #OVERRIDE multiplies the programmed feed")
        .range(Bound::At(0.0), Bound::At(2.0)).default(0.0), as OVERRIDE_MODE: Whole;
    chan("P-CHAN-00067", "p_param_haltend", Raw::Boolean, "P parameters keep their values at program start; no effect here, a run starts without parameters")
        .default(0.0), as KEEP_P_PARAMETERS: Switch;
    chan("P-CHAN-00071", "prog_start.slope.profile", Raw::Sgn16, "slope at program start: 0 STEP, 1 TRAPEZ, 2 SIN2, 3 HSC")
        .range(Bound::At(0.0), Bound::At(3.0)).default(0.0).outside(Condition::ListRange, Correction::Default), as SLOPE: Whole;
    chan("P-CHAN-00073", "prog_start.slope.ramp_time", Raw::Sgn16, "which ramp times G132/G133 weight: 0 all, 1 acc up, 2 acc down, 3 dec up, 4 dec down")
        .range(Bound::At(0.0), Bound::At(4.0)).default(0.0).above(Condition::SlopeWeighting, Correction::Refuse).below(Condition::SlopeWeighting, Correction::Refuse), as RAMP_SELECTION: Whole;
    chan("P-CHAN-00085", "makro_def[i].symbol", Raw::Text, "name of a macro available in every program, see P-CHAN-00062")
        .source("TF5200 channel parameters"), as MACRO_NAME: Text;
    chan("P-CHAN-00090", "vector.velocity", Raw::Real64, "path speed limit")
        .range(Bound::Beyond(0.0), Bound::None).default(2000000000.0).unit("mm/min", "mm/min").outside(Condition::ListRange, Correction::Default), as PATH_SPEED: Number;
    chan("P-CHAN-00091", "versch_im_durchm", Raw::Boolean, "offsets of a face turning axis are diameters; 1 is not supported with G51")
        .default(0.0).source("TF5200 channel parameters"), as OFFSETS_IN_DIAMETERS: Switch;
    chan("P-CHAN-00097", "use_drive_curr_limit", Raw::Boolean, "feedhold uses its own parameters")
        .default(0.0), as OWN_FEEDHOLD: Switch;
    chan("P-CHAN-00099", "prog_start.feedrate", Raw::Real64, "F at program start; 0 means F must be programmed (20008)")
        .range(Bound::At(0.0), Bound::None).default(0.0).unit("mm/min", "mm/min").outside(Condition::ListRange, Correction::Default), as FEED: Number;
    chan("P-CHAN-00108", "prog_start.feedrate_factor", Raw::Real64, "unit of the F word: 100 mm/min, 0.1 m/min; -1 also means 100, any other value gives a warning and becomes 100")
        .range(Bound::At(0.1), Bound::At(100.0)).default(100.0).special(-1.0).outside(Condition::ListRange, Correction::Default), as FEED_UNIT: Number;
    chan("P-CHAN-00110", "check_jerk_on_poly_path", Raw::Uns32, "jerk check in polynomials: 0 none, 1 by tr_geom (P-AXIS-00199), 2 by the longest ramp time of the slope (P-AXIS-00195 to 00198), 3 as 1 here")
        .range(Bound::At(0.0), Bound::At(3.0)).default(1.0), as CURVE_JERK: Whole;
    chan("P-CHAN-00116", "multi_dimension_in_block", Raw::Boolean, "several G90/G91 per block, each effective from its position")
        .default(0.0), as SEVERAL_DIMENSIONS: Switch;
    chan("P-CHAN-00148", "multi_axes_in_block", Raw::Boolean, "1: with P-CHAN-00116, an axis may have several words in a motion block; incremental ones add up, an absolute one replaces those before it")
        .default(0.0).source("TF5200 channel parameters"), as SEVERAL_WORDS: Switch;
    chan("P-CHAN-00149", "kasto_reject_rest_block", Raw::Boolean, "1: edge banding (G108) skips the rest of the block after its M function; refused")
        .default(0.0).source("TF5200 channel parameters 149014539"), as BANDING_REJECTS_REST: Switch;
    chan("P-CHAN-00117", "mode_trans_jerk", Raw::Uns32, "0: 00013 not below 00154, 1: independent weights, 2: P-AXIS-00339/340 act")
        .range(Bound::At(0.0), Bound::At(2.0)).default(0.0), as TRANSITION_JERK: Whole;
    chan("P-CHAN-00118", "m6_prog_file", Raw::Text, "global subroutine called by M06"), as TOOL_CHANGE_PROGRAM: Text;
    chan("P-CHAN-00119", "start_init_prog_file", Raw::Text, "global subroutine called at program start"), as START_PROGRAM: Text;
    chan("P-CHAN-00141", "jerk_monitoring_mode", Raw::Uns32, "how the jerk check uses the speed of the polynomial parameter; jerk is checked as with 1 here")
        .range(Bound::At(0.0), Bound::At(2.0)).default(1.0);
    chan("P-CHAN-00147", "soft_limit_warning_axes", Raw::Uns32, "bit mask of channel axes with a warning instead of an error at setpoint limits")
        .default(0.0), as LIMIT_WARNINGS: Whole;
    chan("P-CHAN-00159", "modal_i_j_k_for_circle", Raw::Boolean, "1: I, J and K of arcs are modal")
        .default(0.0).source("TF5200 channel parameters 149414539"), as MODAL_CENTRES: Switch;
    chan("P-CHAN-00160", "g80_prog_file", Raw::Text, "global subroutine called by G80"), as G80_PROGRAM: Text;
    chan("P-CHAN-00171", "max_radius_diff_circle", Raw::Uns32, "G164: limit of the radius difference (21758)")
        .default(50.0).unit("0.1um", "0.1um"), as RADIUS_DIFFERENCE: Number;
    chan("P-CHAN-00172", "max_proz_radius_diff_circle", Raw::Uns32, "G164: limit of the radius difference relative to the radius; printed default 0.1")
        .default(1.0).unit("0.1%", "0.1%"), as RADIUS_DIFFERENCE_RATIO: Number;
    chan("P-CHAN-00181", "g00_override_mode", Raw::Names(RAPID_OVERRIDES), "override in G00: 0 NOT_USED the feed override, 1 MINIMUM_OF_G0_G1 the smaller of both, 2 ACTIVE the rapid override, 3 ACTIVE_EXTENDED as 2, also in measuring runs and homing, which is not simulated (K-0075): they have the feed override")
        .range(Bound::At(0.0), Bound::At(3.0)).default(0.0), as RAPID_OVERRIDE: Whole;
    chan("P-CHAN-00187", "g800_prog_file[i]", Raw::Text, "global subroutines called by G800 to G839")
        .source("TF5200 channel parameters 149419147"), as G800_PROGRAM: Text;
    chan("P-CHAN-00190", "dynamic_weighting_active", Raw::Uns32, "limits depend on the length of a motion: 0 never, 1 in G00, 2 in G01, 3 in both; not simulated")
        .range(Bound::At(0.0), Bound::At(3.0)).default(0.0);
    chan("P-CHAN-00230", "curve_dynamic_weighting_active", Raw::Boolean, "limits depend on the radius of an arc; not simulated")
        .default(0.0);
    chan("P-CHAN-00208", "vector.deceleration", Raw::Real64, "path deceleration limit")
        .range(Bound::Beyond(0.0), Bound::None).default(100000000.0).unit("mm/min2 or mm/s2", "mm/min2 or mm/s2").outside(Condition::ListRange, Correction::Default), as PATH_DEC: Number;
    chan("P-CHAN-00210", "cycle_changes_modal", Raw::Boolean, "1: G functions, centres and feed of a cycle remain active after its end")
        .default(0.0), as CYCLE_CHANGES_STAY: Switch;
    chan("P-CHAN-00235", "exact_stop_after_g00", Raw::Boolean, "implicit G60 after G00")
        .default(0.0), as EXACT_STOP_AFTER_G00: Switch;
    chan("P-CHAN-00245", "trans_limit_with_curvature", Raw::Uns32, "extra limit between lines from the curvature estimated there: 0 none, 1 by the acceleration, 2 by the acceleration and tr_geom, 3 as 1, but the same in every direction")
        .range(Bound::At(0.0), Bound::At(3.0)).default(0.0), as CURVATURE_ESTIMATE: Whole;
    chan("P-CHAN-00252", "final_prog_file", Raw::Text, "subroutine at program end"), as END_PROGRAM: Text;
    chan("P-CHAN-00259", "opt_contour_mode", Raw::Uns32, "smoother curvature at arcs in DEV contouring; arcs are rounded as with 0 here")
        .range(Bound::At(0.0), Bound::At(2.0)).default(0.0);
    chan("P-CHAN-00261", "multi_path_configuration", Raw::Boolean, "1: two paths in one block, separated by a colon; not simulated")
        .default(0.0).source("TF5263 extended interpolation 1097158155");
    chan("P-CHAN-00273", "disable_chamfers_roundings", Raw::Boolean, "1: no chamfers and roundings (G301, G302: 21718; #ANG, #CHR, #CHF, #RND: 21932)")
        .default(0.0).source("TF5200 channel parameters"), as NO_CHAMFERS: Switch;
    chan("P-CHAN-00297", "mode_exact_stop_indp_axis", Raw::Uns16, "0: #WAIT INDP waits for set positions; 1: G60 also waits until independent axes are in their windows; 2: #WAIT INDP waits for the windows of all axes")
        .range(Bound::At(0.0), Bound::At(2.0)).default(0.0), as INDEPENDENT_STOP: Whole;
    chan("P-CHAN-00349", "prog_start.slope.mode_ramp_time", Raw::Boolean, "TRAPEZ and SIN2, not G00: 0 constant jerk, 1 constant ramp time")
        .default(0.0), as CONSTANT_RAMP_TIME: Switch;
    chan("P-CHAN-00350", "vector.cir_radial_acc_limit", Raw::Boolean, "1: P-CHAN-00002 also limits the centripetal acceleration on arcs")
        .default(0.0), as PATH_ACC_ON_ARCS: Switch;
    chan("P-CHAN-00351", "vector.acc_dec_unit", Raw::Word(&["MM_S2", "MM_M2"]), "unit of the accelerations vector.* and of ACC, DEC, RADIAL_ACC and RADIAL_JERK of #VECTOR LIMIT: MM_M2 mm/min2, MM_S2 mm/s2")
        .default_is(Default::Text("MM_M2")), as PATH_ACC_UNIT: Text;
    chan("P-CHAN-00360", "enable_unit_feet_cut_speed", Raw::Boolean, "1: the cutting speed of G96 is in feet per minute under G70")
        .default(0.0).source("TF5200 channel parameters 270415883"), as CUTTING_IN_FEET: Switch;
    chan("P-CHAN-00361", "vector.radial_acceleration", Raw::Real64, "v2/r limit on curves")
        .range(Bound::Beyond(0.0), Bound::None).default(100000000.0).unit("mm/min2 or mm/s2", "mm/min2 or mm/s2").outside(Condition::ListRange, Correction::Default), as PATH_RADIAL_ACC: Number;
    chan("P-CHAN-00429", "d_prog_file", Raw::Text, "global subroutine called by D words")
        .source("TF5200 channel parameters 405038859"), as TOOL_DATA_PROGRAM: Text;
    chan("P-CHAN-00439", "contouring_consider_inch", Raw::Boolean, "with G70 the tolerance words (AX_DEV, PATH_DEV) are inch")
        .default(0.0), as CONTOURING_INCH: Switch;
    chan("P-CHAN-00451", "mode_implicite_sync_indp_asyn_axis", Raw::Uns16, "the path waits for an independent axis (INDP_ASYN) or ends its oscillation: 0 when the path moves the axis, 1 when a block names it")
        .range(Bound::At(0.0), Bound::At(1.0)).default(0.0).source("TF5200 channel parameters 502430091"), as JOINS_NAMED: Whole;
    chan("P-CHAN-00463", "create_cycle_param_on_read", Raw::Boolean, "reading a @P parameter that was not passed to its cycle: 1 creates it with the value 0, 0 is an error (20394)")
        .default(1.0).source("TF5200 channel parameters 818650763"), as CREATES_PARAMETERS: Switch;
    chan("P-CHAN-00498", "range_check_prog_soft_limits", Raw::Boolean, "1: G98 and G99 stay within the software limits of the axis list")
        .default(0.0).source("TF5200 channel parameters"), as LIMITS_BOUNDED: Switch;
    chan("P-CHAN-00511", "configuration.decoder.macro_symbol_len", Raw::Uns16, "maximum number of characters in the name of a macro (20614)")
        .range(Bound::Beyond(0.0), Bound::At(128.0)).default(30.0).source("TF5200 channel parameters"), as MACRO_NAME_LENGTH: Whole;
    chan("P-CHAN-00512", "configuration.decoder.macro_nc_code_len", Raw::Uns16, "maximum number of characters in the text of a macro")
        .range(Bound::Beyond(0.0), Bound::At(1024.0)).default(80.0).source("TF5200 channel parameters"), as MACRO_TEXT_LENGTH: Whole;
    chan("P-CHAN-00518", "configuration.decoder.msg_to_default", Raw::Word(&["STANDARD", "DISABLED", "WARNING", "ERROR"]), "#MSG to the diagnosis receiver: STANDARD, DISABLED, WARNING (22194), ERROR (22195)")
        .default_is(Default::Text("STANDARD")), as DIAGNOSIS_MESSAGES: Text;
    chan("P-CHAN-00013", "speed_limit_look_ahead.dist_to_corner", Raw::Real64, "velocity look-ahead for the PLC: distance before the corner; read and ignored");
    chan("P-CHAN-00017", "speed_limit_look_ahead.f_enable", Raw::Boolean, "velocity look-ahead for the PLC; read and ignored");
    chan("P-CHAN-00018", "speed_limit_look_ahead.f_time", Raw::Real64, "velocity look-ahead for the PLC: time; read and ignored");
    chan("P-CHAN-00010", "default_ax_name_of_spindle", Raw::Text, "axis name of a spindle that runs as a path axis; no effect here, S[CALLAX] is refused");
    chan("P-CHAN-00026", "h_prozess_zeit[i]", Raw::Uns32, "duration of H function i, counted with --techno-times")
        .default(0.0).unit("us", "us"), as H_DURATION: Optional;
    chan("P-CHAN-00040", "m_prozess_zeit[i]", Raw::Uns32, "duration of M function i, counted with --techno-times")
        .default(0.0).unit("us", "us"), as M_DURATION: Optional;
    chan("P-CHAN-00042", "spindel[i].m19_prozess_zeit", Raw::Uns32, "duration of M19, counted with --techno-times")
        .default(0.0).unit("us", "us"), as SPINDLE_M19_DURATION: Optional;
    chan("P-CHAN-00044", "spindel[i].m3_prozess_zeit", Raw::Uns32, "duration of M3, counted with --techno-times")
        .default(0.0).unit("us", "us"), as SPINDLE_M3_DURATION: Optional;
    chan("P-CHAN-00046", "spindel[i].m4_prozess_zeit", Raw::Uns32, "duration of M4, counted with --techno-times")
        .default(0.0).unit("us", "us"), as SPINDLE_M4_DURATION: Optional;
    chan("P-CHAN-00048", "spindel[i].m5_prozess_zeit", Raw::Uns32, "duration of M5, counted with --techno-times")
        .default(0.0).unit("us", "us"), as SPINDLE_M5_DURATION: Optional;
    chan("P-CHAN-00051", "main_spindle_ax_nr", Raw::Uns16, "logical axis number of the main spindle; 0: the first spindle")
        .default(0.0), as MAIN_SPINDLE: Whole;
    chan("P-CHAN-00052", "main_spindle_gear_change", Raw::Boolean, "M40 to M45 change the gear of the main spindle; not simulated")
        .default(0.0).source("TF5200 programming manual 208055307");
    chan("P-CHAN-00053", "main_spindle_name", Raw::Text, "name that addresses the main spindle in the NC program")
        .default_is(Default::Text("S")).source("TF5200 channel parameters"), as MAIN_SPINDLE_NAME: Text;
    chan("P-CHAN-00080", "spindel[i].s_prozess_zeit", Raw::Uns32, "duration of an S word, counted with --techno-times")
        .default(0.0).unit("us", "us"), as SPINDLE_SPEED_DURATION: Optional;
    chan("P-CHAN-00072", "tool.prozess_zeit", Raw::Uns32, "duration of a tool request (T), counted with --techno-times")
        .default(0.0).unit("us", "us").source("TF5200 channel parameters 148965259"), as TOOL_DURATION: Optional;
    chan("P-CHAN-00082", "spdl_anzahl", Raw::Uns16, "number of spindles of the channel")
        .range(Bound::None, Bound::At(16.0)).default(0.0), as SPINDLE_COUNT: Whole;
    chan("P-CHAN-00014", "einrechnen_mit_t", Raw::Boolean, "T also selects the tool data with its number, like T5 D5")
        .default(0.0).source("TF5200 tool data"), as TOOL_DATA_WITH_TOOL: Switch;
    chan("P-CHAN-00106", "t_with_implicit_flush", Raw::Boolean, "1: T and #TOOL PREP first wait as #FLUSH WAIT does")
        .default(0.0).source("TF5200 channel parameters 149002251"), as FLUSH_BEFORE_TOOL: Switch;
    chan("P-CHAN-00154", "ax_exchange_with_implicit_flush", Raw::Boolean, "1: #CALL AX, #SET AX and #AX DEF first wait as #FLUSH WAIT does; no effect here, every axis exchange waits")
        .default(0.0).source("TF5200 channel parameters 149411467");
    chan("P-CHAN-00271", "flush.d_cmd", Raw::Word(&["D", "FAW_D", "D_FAW"]), "FAW_D: D and #TOOL DATA first wait as #FLUSH WAIT does; D_FAW is not available on the control either")
        .default_is(Default::Text("D")).source("TF5200 channel parameters 149002251"), as FLUSH_OF_TOOL_DATA: Text;
    chan("P-CHAN-00321", "block_filter_tolerance", Raw::Real64, "deviation up to which short blocks are merged; not simulated")
        .default(0.0).source("TF5200 channel parameters 149692939");
    chan("P-CHAN-00220", "edge_machining.enable", Raw::Boolean, "1: reduced feed before and after sharp corners and a wait in them from program start; not simulated")
        .default(0.0).source("TF5200 channel parameters 149479179");
    chan("P-CHAN-00221", "edge_machining.angle_limit", Raw::Uns32, "edge machining: limit of the angle between two blocks; read and ignored")
        .default(0.0).unit("0.0001deg", "0.0001deg").source("TF5200 channel parameters 149486091");
    chan("P-CHAN-00222", "edge_machining.pre_dist", Raw::Uns32, "edge machining: distance before the corner; read and ignored")
        .default(0.0).unit("0.1um", "0.1um").source("TF5200 channel parameters 149487627");
    chan("P-CHAN-00223", "edge_machining.pre_feed", Raw::Uns32, "edge machining: feed rate before the corner; read and ignored")
        .default(0.0).unit("um/s", "um/s").source("TF5200 channel parameters 149489163");
    chan("P-CHAN-00224", "edge_machining.wait_time", Raw::Uns32, "edge machining: wait in the corner; read and ignored")
        .default(0.0).unit("us", "us").source("TF5200 channel parameters 149479179");
    chan("P-CHAN-00225", "edge_machining.post_dist", Raw::Uns32, "edge machining: distance after the corner; read and ignored")
        .default(0.0).unit("0.1um", "0.1um").source("TF5200 channel parameters 149492235");
    chan("P-CHAN-00226", "edge_machining.post_feed", Raw::Uns32, "edge machining: feed rate after the corner; read and ignored")
        .default(0.0).unit("um/s", "um/s").source("TF5200 channel parameters 149493771");
    chan("P-CHAN-00016", "ext_wzv_vorhanden", Raw::Boolean, "1: the tool data come from an external tool management; not simulated")
        .default(0.0).source("TF5200 channel parameters 147959819");
    chan("P-CHAN-00836", "thread_cutting.ignore_override", Raw::Boolean, "G33: 0 the override acts and changes the pitch, 1 it does not act")
        .default(0.0).source("TF5200 channel parameters"), as THREAD_IGNORES_OVERRIDE: Switch;
    chan("P-CHAN-00758", "backward_compatibility.axis_spline_ramp_time", Raw::Boolean, "ramp time of a motion in a coordinate system (#CS): 1 the longest one of the main axes that move, 0 by the jerk of the axes and their share of the motion, as without a system")
        .default(1.0).source("TF5200 channel parameters 1011140491"), as LONGEST_RAMP_IN_SYSTEMS: Switch;
    chan("P-CHAN-00837", "thread_cutting.thread_chain", Raw::Boolean, "consecutive blocks of G33: 0 each is a separate thread, 1 one thread without a stop")
        .default(0.0).source("TF5200 channel parameters"), as THREAD_CHAIN: Switch;
    chan("P-CHAN-00161", "g81_prog_file", Raw::Text, "global subroutine called by G81"), as G81_PROGRAM: Text;
    chan("P-CHAN-00162", "g82_prog_file", Raw::Text, "global subroutine called by G82"), as G82_PROGRAM: Text;
    chan("P-CHAN-00163", "g83_prog_file", Raw::Text, "global subroutine called by G83"), as G83_PROGRAM: Text;
    chan("P-CHAN-00164", "g84_prog_file", Raw::Text, "global subroutine called by G84"), as G84_PROGRAM: Text;
    chan("P-CHAN-00165", "g85_prog_file", Raw::Text, "global subroutine called by G85"), as G85_PROGRAM: Text;
    chan("P-CHAN-00166", "g86_prog_file", Raw::Text, "global subroutine called by G86"), as G86_PROGRAM: Text;
    chan("P-CHAN-00167", "g87_prog_file", Raw::Text, "global subroutine called by G87"), as G87_PROGRAM: Text;
    chan("P-CHAN-00168", "g88_prog_file", Raw::Text, "global subroutine called by G88"), as G88_PROGRAM: Text;
    chan("P-CHAN-00169", "g89_prog_file", Raw::Text, "global subroutine called by G89"), as G89_PROGRAM: Text;
    chan("P-CHAN-00032", "kinematik_id", Raw::Uns16, "kinematics of #TRAFO at program start; no effect here, #TRAFO is refused or has no kinematics")
        .default(0.0).source("TF5200 channel parameters 149237131");
    chan("P-CHAN-00079", "rund_mass_einh", Raw::Uns08, "unit of words of rotary axes: 0 degree, 1 gon (400 a turn); not simulated")
        .range(Bound::At(0.0), Bound::At(1.0)).default(0.0).source("TF5200 channel parameters 148980747");
    chan("P-CHAN-00092", "wrk_im_kanal_vorhanden", Raw::Boolean, "1: the channel has tool radius compensation; no effect here, it always has")
        .default(0.0).source("TF5200 channel parameters 149218699");
    chan("P-CHAN-00104", "synchro_data.restore_coupling_after_reset", Raw::Boolean, "1: couplings are active again after a reset; no effect here, a run is one program")
        .default(0.0).source("TF5200 gantry operation 285758987");
    chan("P-CHAN-00105", "synchro_data.preserve_coupling_after_prog_end", Raw::Boolean, "1: couplings of the program before are active again; no effect here, a run is one program")
        .default(0.0).source("TF5200 gantry operation 285758987");
    chan("P-CHAN-00120", "soft_limit_tolerance", Raw::Boolean, "1: axes that a program does not move may be beyond a software limit by P-AXIS-00179; not simulated")
        .default(0.0).source("TF5200 channel parameters 149357707");
    chan("P-CHAN-00156", "tool.minimum_length", Raw::Uns32, "shortest tool that D accepts (21426); 0: any")
        .default(0.0).unit("0.1um", "0.1um").source("TF5200 channel parameters 148966795"), as MIN_TOOL_LENGTH: Number;
    chan("P-CHAN-00157", "tool.minimum_radius", Raw::Uns32, "smallest radius of a tool that D accepts (21427); 0: any")
        .default(0.0).unit("0.1um", "0.1um").source("TF5200 channel parameters 148968331"), as MIN_TOOL_RADIUS: Number;
    chan("P-CHAN-00219", "implicit_contour_masking", Raw::Boolean, "1: contour violations without G141 are found by contour masking; not simulated")
        .default(0.0).source("TF5200 channel parameters 149221771");
    chan("P-CHAN-00262", "trafo[i].id", Raw::Uns16, "kinematics of transformation i; no effect here, #TRAFO, #CYL and #FACE are refused or have no kinematics")
        .default(0.0).source("TF5200 channel parameters 149247371");
    chan("P-CHAN-00263", "trafo[i].param[j]", Raw::Real64, "offset j of transformation i, see P-CHAN-00262; no effect here")
        .default(0.0).unit("0.1um", "0.1um").source("TF5200 channel parameters 149248907");
    chan("P-CHAN-00284", "trc_circular_kerf_masking", Raw::Boolean, "0: KERF_MASKING of #TRC takes the older method; no effect here, it is refused")
        .default(1.0).source("TF5200 channel parameters 149223307");
    chan("P-CHAN-00650", "configuration.interpolator.function", Raw::Flags(FUNCTIONS), "as P-STUP-00070, which it replaces")
        .source("TF5200 channel parameters 828925963"), as LOOK_AHEAD: Optional;
    chan("P-CHAN-00653", "configuration.interpolator.number_blocks_lah", Raw::Uns32, "blocks of look-ahead with FCT_LOOK_AHEAD_CUSTOM of P-CHAN-00650")
        .range(Bound::At(10.0), Bound::At(10000.0)).default(120.0).source("TF5200 channel parameters 829047947"), as LOOK_AHEAD_BLOCKS: Whole;
    chan("P-CHAN-00654", "configuration.interpolator.blocks_per_call", Raw::Uns32, "blocks of look-ahead per cycle; not simulated")
        .range(Bound::At(1.0), Bound::None).default(200.0).source("TF5200 channel parameters 829080715");
    chan("P-CHAN-00761", "tapping.use_actual_position", Raw::Boolean, "1: the axes of G63 follow the actual position of the spindle; not simulated")
        .default(0.0).source("TF5200 turning functions 400206731");
    chan("P-CHAN-00762", "tapping.n_cycles", Raw::Uns16, "cycles of the filter of P-CHAN-00761; not simulated")
        .range(Bound::At(0.0), Bound::At(20.0)).default(0.0).source("TF5200 turning functions 400206731");
    chan("P-CHAN-00834", "thread_cutting.use_actual_speed", Raw::Boolean, "1: the axes of G33 follow the actual position of the spindle; not simulated")
        .default(0.0).source("TF5200 channel parameters 1116195083");
    chan("P-CHAN-00835", "thread_cutting.n_cycles", Raw::Uns16, "cycles of the filter of P-CHAN-00834; not simulated")
        .range(Bound::At(0.0), Bound::At(25.0)).default(0.0).source("TF5200 channel parameters 1116199691");
}
