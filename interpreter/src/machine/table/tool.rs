//! Tool lists: the data that D selects. Index i is the number of the D word.

use super::param::parameters;
use super::row::{Bound, Raw, tool};

parameters! {
    tool("P-TOOL-00003", "wz[i].laenge", Raw::Sgn32, "length of the tool")
        .default(0.0).unit("0.1um", "0.1um"), as LENGTH: Number;
    tool("P-TOOL-00004", "wz[i].radius", Raw::Sgn32, "radius of the tool")
        .default(0.0).unit("0.1um", "0.1um"), as RADIUS: Number;
    tool("P-TOOL-00005", "wz[i].gueltig", Raw::Boolean, "1: D may select these data")
        .default(0.0), as VALID: Switch;
    tool("P-TOOL-00006", "wz[i].ax_versatz[j]", Raw::Sgn32, "offset of axis j of the channel")
        .default(0.0).unit("0.1um", "0.1um"), as OFFSET: Number;
    tool("P-TOOL-00007", "wz[i].param[j]", Raw::Real64, "free parameter, V.G.WZ[i].P[j]")
        .default(0.0), as PARAMETER: Number;
    tool("P-TOOL-00008", "wz[i].mass_einheit", Raw::Uns16, "unit of length, radius and offsets: 0 0.1 um, 1 0.0001 inch")
        .range(Bound::At(0.0), Bound::At(1.0)).default(0.0), as INCH: Switch;
}
