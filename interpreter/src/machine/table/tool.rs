//! Tool lists: the data that D selects. Index i is the number of the D word.

use super::param::parameters;
use super::raw::{Bound, Raw};
use super::row::tool;

parameters! {
    tool("P-TOOL-00001", "wz[i].typ", Raw::Uns16, "0 milling, 1 turning, 2 grinding, 3 wire; #OTC needs 2")
        .range(Bound::At(0.0), Bound::At(3.0)).default(0.0), as KIND: Whole;
    tool("P-TOOL-00003", "wz[i].laenge", Raw::Sgn32, "length of the tool")
        .default(0.0).unit("0.1um", "0.1um"), as LENGTH: Number;
    tool("P-TOOL-00004", "wz[i].radius", Raw::Sgn32, "radius of the tool")
        .default(0.0).unit("0.1um", "0.1um"), as RADIUS: Number;
    tool("P-TOOL-00005", "wz[i].gueltig", Raw::Boolean, "1: D can select these data")
        .default(0.0), as VALID: Switch;
    tool("P-TOOL-00006", "wz[i].ax_versatz[j]", Raw::Sgn32, "offset of axis j of the channel")
        .default(0.0).unit("0.1um", "0.1um"), as OFFSET: Number;
    tool("P-TOOL-00007", "wz[i].param[j]", Raw::Real64, "free parameter, V.G.WZ[i].P[j]")
        .default(0.0), as PARAMETER: Number;
    tool("P-TOOL-00008", "wz[i].mass_einheit", Raw::Uns16, "unit of length, radius and offsets: 0 0.1 um, 1 0.0001 inch")
        .range(Bound::At(0.0), Bound::At(1.0)).default(0.0), as INCH: Switch;
    tool("P-TOOL-00009", "wz[i].kinematic.param[j]", Raw::Real64, "offset j of the tool in a transformation; no effect here, #TRAFO is refused or has no kinematics")
        .default(0.0).unit("0.1um", "0.1um");
    tool("P-TOOL-00010", "wz[i].tool_fixed", Raw::Boolean, "1: the offsets P-TOOL-00006 are those of the machine axes in a coordinate system, too; as with 1 here, with 0 this is reported (K-0111)")
        .default(0.0).source("TF5200 tool data 104787339"), as FIXED: Switch;
    tool("P-TOOL-00011", "wz[i].kin_id", Raw::Uns16, "kinematics of the tool; no effect here, #TRAFO is refused or has no kinematics")
        .default(0.0).source("TF5200 tool data 104788875");
    tool("P-TOOL-00012", "wz[i].log_ax_nr_spdl", Raw::Uns16, "logical number of the spindle that P-TOOL-00013 to 00015 limit, 0: none")
        .default(0.0).source("TF5200 spindle 287679371"), as SPINDLE: Whole;
    tool("P-TOOL-00013", "wz[i].vb_min", Raw::Real64, "minimum speed of the spindle with this tool, while it turns")
        .default(0.0).unit("0.001deg/s", "0.001deg/s").source("TF5200 spindle 287679371"), as SPINDLE_MIN: Number;
    tool("P-TOOL-00014", "wz[i].vb_max", Raw::Real64, "maximum speed of the spindle with this tool")
        .default(1.0).unit("0.001deg/s", "0.001deg/s").source("TF5200 tool data 125214603"), as SPINDLE_MAX: Number;
    tool("P-TOOL-00015", "wz[i].a_max", Raw::Real64, "maximum acceleration of the spindle with this tool")
        .default(1.0).unit("deg/s2", "deg/s2").source("TF5200 tool data 104795019"), as SPINDLE_ACC: Number;
    tool("P-TOOL-00020", "wz[i].path[j].radius", Raw::Sgn32, "radius of the tool on path j of a channel with two paths (P-CHAN-00261); not simulated")
        .default(0.0).unit("0.1um", "0.1um").source("TF5200 tool data 104847371");
    tool("P-TOOL-00030", "wz[i].grinding_wear_const", Raw::Real64, "wear of a grinding wheel per distance, in 0.1 um per metre (#OTC)")
        .range(Bound::At(0.0), Bound::At(1e9)).default(0.0), as WEAR: Number;
    tool("P-TOOL-00031", "wz[i].grinding_max_infeed", Raw::Real64, "maximum external wear accepted by #OTC, positive or negative")
        .default(0.0).unit("0.1um", "0.1um"), as INFEED: Number;
    tool("P-TOOL-00138", "wz[i].grinding_disc_tilt_angle", Raw::Real64, "angle between the axis of a grinding wheel and the third main axis; values other than 0 are refused with #OTC")
        .range(Bound::At(-450_000.0), Bound::At(450_000.0)).default(0.0).unit("0.0001deg", "0.0001deg"), as TILT: Number;
}
