//! Start-up lists.

use super::param::parameters;
use super::raw::{Bound, Raw};
use super::row::{Default, stup};

/// Names of [`LOOK_AHEAD`] for the size of the look-ahead.
pub(in crate::machine) const LOW: u32 = 0x2;
/// As [`LOW`].
pub(in crate::machine) const HIGH: u32 = 0x8;
/// As [`LOW`].
pub(in crate::machine) const CUSTOM: u32 = 0x10;
/// The function that shortens machining times; not simulated.
pub(in crate::machine) const OPTIMISED: u32 = 0x20;

/// Functions of the interpolator. The documents print names only.
pub(super) const FUNCTIONS: &[(&str, u32)] = &[
    ("FCT_IPO_DEFAULT", 0x1),
    ("FCT_LOOK_AHEAD_LOW", LOW),
    ("FCT_LOOK_AHEAD_STANDARD", 0x4),
    ("FCT_LOOK_AHEAD_HIGH", HIGH),
    ("FCT_LOOK_AHEAD_CUSTOM", CUSTOM),
    ("FCT_LOOK_AHEAD_OPT", OPTIMISED),
    ("FCT_SYNC", 0x40),
    ("FCT_LIFT_UP_TIME", 0x80),
    ("FCT_SHIFT_NCBL", 0x100),
    ("FCT_CALC_STATE_AT_T", 0x200),
];

parameters! {
    stup("P-STUP-00001", "kanal_anzahl", Raw::Sgn16, "number of channels")
        .range(Bound::At(1.0), Bound::At(12.0)).default(0.0), as CHANNEL_COUNT: Optional;
    stup("P-STUP-00007", "konfiguration", Raw::Text, "name of the topology");
    stup("P-STUP-00008", "listen", Raw::Word(&["ASCII", "BINAER"]), "ASCII or BINAER")
        .default_is(Default::Text("ASCII")), as LIST_FORMAT: Text;
    stup("P-STUP-00009", "sda_mds[i]", Raw::Text, "channel list of channel i, i = 0..11"), as CHANNEL_LIST: Text;
    stup("P-STUP-00010", "werkz_data[i]", Raw::Text, "tool list of channel i, i = 0..11"), as TOOL_LIST: Text;
    stup("P-STUP-00011", "nullp_data[i]", Raw::Text, "zero offset list of channel i, i = 0..11"), as ZERO_LIST: Text;
    stup("P-STUP-00146", "ve_var[i]", Raw::Text, "list of external variables of channel i, i = 0..11")
        .source("TF5200 start-up list 123614347"), as EXTERNAL_LIST: Text;
    stup("P-STUP-00038", "ext_var[i]", Raw::Text, "list of external variables of channel i in older builds, i = 0..11; without effect if ve_var[i] is given")
        .source("start-up list 15280811403"), as OLD_EXTERNAL_LIST: Text;
    stup("P-STUP-00014", "zahl_mds", Raw::Uns16, "number of axis lists")
        .range(Bound::At(0.0), Bound::At(32.0)), as AXIS_LIST_COUNT: Optional;
    stup("P-STUP-00015", "achs_mds[i]", Raw::Text, "axis list, i = 0..31; more files than zahl_mds are ignored, a missing file aborts start-up"), as AXIS_LIST: Text;
    stup("P-STUP-00018", "pfad[i].prg[j]", Raw::Text, "NC program path");
    stup("P-STUP-00019", "pfad[i].log_nr[j]", Raw::Uns32, "logical path number");
    stup("P-STUP-00020", "pfad[i].typ[j]", Raw::Uns32, "path type");
    stup("P-STUP-00021", "pfad[i].prioritaet[j]", Raw::Uns32, "search priority");
    stup("P-STUP-00034", "default_sda_mds", Raw::Text, "list of defaults for all channels"), as CHANNEL_DEFAULTS: Text;
    stup("P-STUP-00035", "default_achs_mds", Raw::Text, "list of defaults for all axes"), as AXIS_DEFAULTS: Text;
    stup("P-STUP-00070", "configuration.channel[i].interpolator.function", Raw::Flags(FUNCTIONS), "functions of the interpolator, joined by |; size of the look-ahead in blocks: FCT_LOOK_AHEAD_LOW 30, _STANDARD 120 (FCT_IPO_DEFAULT), _HIGH 190, _CUSTOM as P-STUP-00071")
        .default(1.0).source("TF5200 channel parameters 828925963"), as LOOK_AHEAD: Whole;
    stup("P-STUP-00071", "configuration.channel[i].interpolator.number_blocks_lah", Raw::Uns32, "blocks of look-ahead with FCT_LOOK_AHEAD_CUSTOM")
        .range(Bound::At(10.0), Bound::At(10000.0)).default(120.0), as LOOK_AHEAD_BLOCKS: Whole;
    stup("P-STUP-00075", "configuration.channel[i].interpolator.blocks_per_call", Raw::Uns32, "blocks of look-ahead per cycle; not simulated")
        .range(Bound::At(1.0), Bound::None).default(200.0).source("TF5200 start-up list 4953866351133073931");
    stup("P-STUP-00022", "online_prod_time_opt", Raw::Boolean, "shortens the vendor's own machining time simulation; read and ignored")
        .default(0.0);
}
