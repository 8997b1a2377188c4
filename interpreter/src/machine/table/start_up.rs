//! Start-up lists.

use super::param::parameters;
use super::row::{Bound, Default, Raw, stup};

parameters! {
    stup("P-STUP-00001", "kanal_anzahl", Raw::Sgn16, "number of channels")
        .range(Bound::At(1.0), Bound::At(12.0)).default(0.0), as CHANNEL_COUNT: Optional;
    stup("P-STUP-00007", "konfiguration", Raw::Text, "name of the topology");
    stup("P-STUP-00008", "listen", Raw::Word(&["ASCII", "BINAER"]), "ASCII or BINAER")
        .default_is(Default::Text("ASCII")), as LIST_FORMAT: Text;
    stup("P-STUP-00009", "sda_mds[i]", Raw::Text, "channel list of channel i, i = 0..11"), as CHANNEL_LIST: Text;
    stup("P-STUP-00010", "werkz_data[i]", Raw::Text, "tool list of channel i, i = 0..11"), as TOOL_LIST: Text;
    stup("P-STUP-00011", "nullp_data[i]", Raw::Text, "zero offset list of channel i, i = 0..11"), as ZERO_LIST: Text;
    stup("P-STUP-00014", "zahl_mds", Raw::Uns16, "number of axis lists")
        .range(Bound::At(0.0), Bound::At(32.0)), as AXIS_LIST_COUNT: Optional;
    stup("P-STUP-00015", "achs_mds[i]", Raw::Text, "axis list, i = 0..31; more files than zahl_mds are ignored, a missing file aborts start-up"), as AXIS_LIST: Text;
    stup("P-STUP-00018", "pfad[i].prg[j]", Raw::Text, "NC program path");
    stup("P-STUP-00019", "pfad[i].log_nr[j]", Raw::Uns32, "logical path number");
    stup("P-STUP-00020", "pfad[i].typ[j]", Raw::Uns32, "path type");
    stup("P-STUP-00021", "pfad[i].prioritaet[j]", Raw::Uns32, "search priority");
    stup("P-STUP-00034", "default_sda_mds", Raw::Text, "list of defaults for all channels"), as CHANNEL_DEFAULTS: Text;
    stup("P-STUP-00035", "default_achs_mds", Raw::Text, "list of defaults for all axes"), as AXIS_DEFAULTS: Text;
    stup("P-STUP-00070", "configuration.channel[i].interpolator.function", Raw::Word(&["FCT_LOOK_AHEAD_LOW", "FCT_LOOK_AHEAD_STANDARD", "FCT_LOOK_AHEAD_HIGH", "FCT_LOOK_AHEAD_CUSTOM"]), "look-ahead size FCT_LOOK_AHEAD_LOW/_STANDARD/_HIGH/_CUSTOM, see 20")
        .default_is(Default::Text("FCT_LOOK_AHEAD_HIGH")), as LOOK_AHEAD: Text;
    stup("P-STUP-00071", "configuration.channel[i].interpolator.number_blocks_lah", Raw::Uns32, "blocks of look-ahead with _CUSTOM, see 20")
        .range(Bound::At(10.0), Bound::At(10000.0)).default(120.0), as LOOK_AHEAD_BLOCKS: Whole;
    stup("P-STUP-00022", "online_prod_time_opt", Raw::Boolean, "shortens the vendor's own machining time simulation; read and ignored")
        .default(0.0);
}
