//! Zero-offset lists: index i is the group, 1 for G54 to 6 for G59, and the number of G159.

use super::param::parameters;
use super::raw::{Bound, Raw};
use super::row::{Correction, zero};
use crate::diag::Condition;

parameters! {
    zero("P-ZERO-00001", "g53_verfuegbar", Raw::Boolean, "1: G53 and G159=0 use group 0; 0: they cancel the zero offsets")
        .default(0.0), as G53_IN_USE: Switch;
    zero("P-ZERO-00002", "default_index", Raw::Uns16, "group that is active at program start; 0: none (G53)")
        .range(Bound::At(0.0), Bound::At(96.0)).default(0.0).above(Condition::ZeroOffsetDefault, Correction::Refuse), as DEFAULT_GROUP: Whole;
    zero("P-ZERO-00003", "np_grp[i].achse[j].versch", Raw::Sgn32, "zero offset of axis j of the channel in group i")
        .default(0.0).unit("0.1um", "0.0001deg"), as OFFSET: Number;
    zero("P-ZERO-00004", "np_grp[i].achse[j].inaktiv", Raw::Boolean, "1: group i does not include axis j, until G160=i includes it")
        .default(0.0).source("TF5200 zero offsets 103725579"), as EXCLUDED: Switch;
}
