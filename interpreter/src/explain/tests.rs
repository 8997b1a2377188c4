use super::*;
use crate::machine::lists;

fn fact(e: &Explanation, name: &str) -> String {
    e.facts.iter().find(|(n, _)| *n == name).map(|(_, fact)| fact.clone()).unwrap_or_default()
}

#[test]
fn every_parameter_and_message_is_explained() {
    for row in table::rows() {
        for thing in [row.id, row.key].into_iter().filter(|s| !s.is_empty()) {
            let e = explain(thing).unwrap();
            assert_eq!(e.kind, Kind::Parameter, "{thing}");
            assert_eq!(e.meaning, row.meaning, "{thing}");
        }
    }
    for entry in condition::rows() {
        let e = explain(&entry.id.to_string()).unwrap();
        assert_eq!(e.kind, Kind::Message);
        for thing in &e.related {
            assert!(explain(thing).is_ok(), "{} -> {thing}", entry.id);
        }
    }
}

/// Words, statements, and commands that begin with the same word.
#[test]
fn the_language_is_explained() {
    for thing in
        "F E S T D L $IF $FOR $WHILE $GOTO $SWITCH V.P V.A SQRT #CHR #FRC #RND #CS #SET #MEAS"
            .split_whitespace()
    {
        let e = explain(thing).unwrap();
        assert_eq!(e.kind, Kind::Command, "{thing}");
    }
    // every function and operator of the grammar, and the form that states its number of values
    for thing in "SQRT SQR EXP DEXP LN LOG SIN COS TAN COT ASIN ACOS ATAN ACOT ATAN2 ABS SIGN INT FRACT ROUND FLOOR CEIL MIN MAX \
                  MOD AND OR XOR NOT INV PI LEN LEFT RIGHT MID FIND INSERT DELETE REPLACE ORD INT_TO_STR REAL_TO_STR STR_TO_INT \
                  STR_TO_REAL IS_STRING IS_NUMBER EXIST SIZEOF MACRO_CONTENT MACRO_LENGTH"
        .split_whitespace()
    {
        let e = explain(thing).unwrap_or_else(|_| panic!("{thing}"));
        assert_eq!(e.kind, Kind::Command, "{thing}");
    }
    let systems = explain("#CS").unwrap();
    for name in ["CS ADD", "CS DEF", "CS ON"] {
        assert!(systems.facts.iter().any(|(other, _)| *other == name), "{systems:?}");
    }
}

/// Words of other controls, variables without their axis, and what is written before a block.
#[test]
fn related_things_are_explained() {
    for (thing, part) in
        [("V.A.ABS", "without offsets"), ("#ACHSE", "G201"), ("G28", "G74"), ("/", "skip")]
    {
        let e = explain(thing).unwrap_or_else(|_| panic!("{thing}"));
        assert!(e.to_string().contains(part), "{thing}: {e}");
    }
    assert!(explain("V.A").is_ok_and(|e| e.kind == Kind::Command));
}

#[test]
fn parameters_of_the_function_manuals_are_known() {
    // every parameter named in the manuals of axis filters, Improved Position Control, feedforward, position
    // monitoring and Vibration Guard
    let axis = "00001 00013 00015 00065 00067 00080 00092 00128 00129 00140 00151 00153 00164 00165 00204 00205 \
                00206 00207 00212 00223 00225 00226 00228 00229 00233 00234 00236 00255 00319 00325 00326 00337 \
                00338 00357 00362 00363 00389 00390 00391 00392 00405 00440 00511 00512 00513 00514 00515 00532 \
                00568 00571 00588 00589 00735 00736 00737 00738 00739 00740 00741 00742 00750 00751 00752 00753 \
                00754 00755 00756 00757 00758";
    for number in axis.split_whitespace() {
        assert!(explain(&format!("P-AXIS-{number}")).is_ok(), "{number}");
    }
    for thing in ["P-CHAN-00036", "P-CHAN-00071", "P-CHAN-00439"] {
        assert!(explain(thing).is_ok(), "{thing}");
    }
    for id in [
        "22060", "70082", "70348", "70349", "70350", "70351", "70600", "110465", "110473", "110579",
    ] {
        assert!(explain(id).is_ok() && explain(&format!("P-ERR-{id}")).is_ok(), "{id}");
    }
}

#[test]
fn examples_of_parameters_load_without_a_message() {
    for row in table::rows().filter(|r| !r.key.is_empty()) {
        let example = explain(row.key).unwrap().example.unwrap();
        let mut diagnostics = Vec::new();
        let list = lists::read(row.list, "example", example.as_bytes(), &mut diagnostics);
        assert_eq!(diagnostics, [], "{example}");
        assert_eq!(list.entries.len(), 1, "{example}");
    }
}

/// Whatever the spelling of a word; what the pages contain is compared with the manuals in `tests/explain.rs`.
#[test]
fn commands_and_words() {
    assert_eq!(fact(&explain("p-axis-00223").unwrap(), "default"), "NONE");
    let e = explain("getriebe[0].gear_fact_denom").unwrap();
    assert_eq!(e.title, "P-AXIS-00512  getriebe[i].gear_fact_denom");
    assert!(fact(&e, "default") == "1" && fact(&e, "reaction").contains("110579"));
    assert_eq!(explain("70082").unwrap().related, ["P-AXIS-00236", "P-AXIS-00532"]);
    let guard = explain("#vib  guard on [MODE=2]").unwrap();
    assert_eq!(guard.kind, Kind::Command);
    assert!(guard.facts[1].1.contains("vib_guard.freq"));
    assert_eq!(explain("G136").unwrap().example.as_deref(), Some("G135 G136 X80 Y95"));
    assert_eq!(fact(&explain("active position").unwrap(), "column"), "X_ipo_mm");
    assert_eq!(explain("S_0_0037").unwrap().kind, Kind::Word);
    for name in commands::names() {
        for thing in explain(&name).unwrap().related {
            assert!(explain(&thing).is_ok(), "{name} -> {thing}");
        }
    }
}

#[test]
fn unknown_things_get_suggestions() {
    assert_eq!(explain("vorsteuer.jerk_fact_nmu").unwrap_err()[0], "vorsteuer.jerk_fact_num");
    assert_eq!(explain("#VIB GARD").unwrap_err(), ["#VIB GUARD"]);
    assert!(explain("kv").unwrap_err().contains(&"getriebe[i].kv".to_owned()));
    assert!(explain("nothing like this").unwrap_err().is_empty());
    assert!(explain("").is_err());
    // a number that is in no document
    assert!(explain("22061").is_err());
}

/// Every value in a trace or in the times of a run is explained, and so are the terms that the explanation refers to.
#[test]
fn limits_and_rests_are_explained() {
    use crate::record::{Rest, SpeedLimit};
    let limits = SpeedLimit::ALL.iter().map(|l| l.name());
    let others = ["v_limit", "axis_v", "axis_a", "slope"];
    for thing in limits.chain(Rest::ALL.iter().map(|r| r.name())).chain(others) {
        let e = explain(thing).unwrap_or_else(|_| panic!("{thing}"));
        assert_eq!(e.kind, Kind::Word, "{thing}");
        for other in &e.related {
            assert!(explain(other).is_ok(), "{thing} -> {other}");
        }
        let ids = e.facts.iter().flat_map(|(_, fact)| fact.split([' ', ',', ';']));
        for id in ids.filter(|w| w.starts_with("P-")) {
            assert!(explain(id).is_ok(), "{thing} -> {id}");
        }
    }
}
