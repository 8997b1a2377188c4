//! Lists of external variables: index i is the number of a variable or of a type.

use super::param::parameters;
use super::raw::{Bound, Raw};
use super::row::{Default, external};

parameters! {
    external("P-EXTV-00010", "number_used_variables", Raw::Uns16, "number of variables: those with a higher index are not available")
        .default(0.0).source("TF5200 external variables 112471947"), as COUNT: Whole;
    external("P-EXTV-00011", "check_overlapping_variables", Raw::Boolean, "checks the memory layout; no effect here");
    external("P-EXTV-00012", "auto_memory_mode", Raw::Boolean, "assigns addresses automatically; no effect here");
    external("P-EXTV-00013", "init", Raw::Code, "assignment to an external variable at start-up, such as V.E.A = 5; may occur several times")
        .source("TF5200 external variables 112479371").repeated(), as INIT: Text;
    external("P-EXTV-00022", "use_extended_string_var", Raw::Boolean, "1: texts of type STRING have up to 127 characters, 0: up to 20")
        .default(0.0).source("TF5200 external variables 112451979, 15424430859"), as LONG_TEXTS: Switch;
    external("P-EXTV-00001", "var[i].name", Raw::Text, "name after V.E., case-sensitive")
        .source("TF5200 external variables 112455051"), as NAME: Text;
    external("P-EXTV-00002", "var[i].byte_offset", Raw::Sgn32, "address of the variable")
        .default(-1.0);
    external("P-EXTV-00003", "var[i].type", Raw::Text, "BOOLEAN, SGN08, UNS08, SGN16, UNS16, SGN32, UNS32, REAL64, STRING, VSTRING; structures (struct[i]) are not simulated")
        .default_is(Default::Text("UNS32")).source("TF5200 external variables 112458123"), as KIND: Text;
    external("P-EXTV-00004", "var[i].scope", Raw::Word(&["CHANNEL", "GLOBAL"]), "visible in one channel or in all; no effect here, one channel is simulated")
        .default_is(Default::Text("CHANNEL"));
    external("P-EXTV-00005", "var[i].synchronisation", Raw::Boolean, "1: reading it stops the path and empties the channel; 0: it is read while the program is decoded")
        .default(1.0).source("TF5200 external variables 112461195, 1091998347"), as SYNCHRONOUS: Switch;
    external("P-EXTV-00006", "var[i].access_rights", Raw::Word(&["READ_WRITE", "READ_ONLY", "WRITE_ONLY"]), "what a program may do with the variable")
        .default_is(Default::Text("READ_WRITE")).source("TF5200 external variables 112462731"), as ACCESS: Text;
    external("P-EXTV-00007", "var[i].array_elements", Raw::Uns16, "number of elements of an array; 0: no array")
        .default(0.0).source("TF5200 external variables 112464267"), as ELEMENTS: Whole;
    external("P-EXTV-00008", "var[i].size", Raw::Uns32, "bytes of a text of type VSTRING with its end mark; no effect with other types")
        .range(Bound::At(1.0), Bound::At(800.0)).special(0.0).default(128.0), as SIZE: Whole;
    external("P-EXTV-00009", "var[i].create_hmi_interface", Raw::Boolean, "access for the user interface; no effect here");
    external("P-EXTV-00015", "struct[i].name", Raw::Text, "name of a type of structures; variables of this type are not simulated"), as STRUCTURE: Text;
    external("P-EXTV-00016", "struct[i].element[j].name", Raw::Text, "name of an element; not simulated");
    external("P-EXTV-00017", "struct[i].element[j].type", Raw::Text, "type of an element; not simulated");
    external("P-EXTV-00018", "struct[i].element[j].synchronisation", Raw::Text, "synchronisation of an element; not simulated");
    external("P-EXTV-00019", "struct[i].element[j].access_rights", Raw::Text, "access rights of an element; not simulated");
    external("P-EXTV-00020", "struct[i].element[j].array_elements", Raw::Uns16, "number of elements of an array in a structure; not simulated");
    external("P-EXTV-00021", "struct[i].element[j].size", Raw::Uns32, "bytes of an element of type VSTRING; not simulated");
}
