//! Recommendations for lists: notes that change nothing.

use super::*;

/// Notes of loading: axis, parameter and text of each.
fn advice(name: &str, set: &str) -> Vec<(String, &'static str, String)> {
    let set: Vec<&str> = set.split_whitespace().collect();
    let (machine, found) = load(name, &set, &Disk::default());
    let advice = |d: &&Diagnostic| d.id.to_string() == "K-0078";
    assert!(found.iter().filter(advice).all(|d| d.severity == Severity::Note), "{found:?}");
    // only once: not repeated when the chains are built
    assert_eq!(machine.chains().1.iter().filter(advice).count(), 0);
    found
        .iter()
        .filter(advice)
        .map(|d| (d.axis.as_ref().unwrap().name.clone(), d.parameter.unwrap(), d.text.clone()))
        .collect()
}

/// The recommendations of the documents, just inside and just outside the limit. Conformance: A027, A029, F009, P013, P014.
#[test]
fn recommendations_are_notes() {
    let low_pass = |rest: &str| {
        let entries = format!("enable=1 type=LOWPASS order=2 fg_f0=15 {rest}");
        let keys: Vec<String> =
            entries.split_whitespace().map(|e| format!("X.filter[0].{e}")).collect();
        keys.join(" ") + " "
    };
    for (set, parameter, value) in [
        (low_pass("prototype=BESSEL"), "P-AXIS-00153", "BESSEL"),
        (low_pass("prototype=BUTTERWORTH"), "P-AXIS-00153", "BUTTERWORTH"),
        ("X.vorsteuer.vs_v_faktor=11 X.vorsteuer.vs_v_nenner=10".into(), "P-AXIS-00228", "1.1"),
        ("X.vorsteuer.vs_v_faktor=69 X.vorsteuer.vs_v_nenner=100".into(), "P-AXIS-00228", "0.69"),
        ("X.getriebe[0].position_settling_time=9999".into(), "P-AXIS-00532", "9999"),
        ("X.getriebe[0].position_settling_time=200001".into(), "P-AXIS-00532", "200001"),
        ("X.getriebe[0].pos_control_deadband=34".into(), "P-AXIS-00236", "34"),
    ] {
        let found = advice("xyz", &set);
        assert_eq!(found.len(), 1, "{set}: {found:?}");
        assert_eq!((found[0].0.as_str(), found[0].1), ("X", parameter), "{set}");
        assert!(found[0].2.contains(value), "{found:?}");
    }
    for set in [
        low_pass("prototype=CRIT_DAMPING"),
        low_pass("prototype=BESSEL order=1"),
        low_pass("prototype=BUTTERWORTH enable=0"),
        low_pass("prototype=BUTTERWORTH type=BANDSTOP"),
        "X.vorsteuer.vs_v_faktor=7 X.vorsteuer.vs_v_nenner=10".into(),
        "X.vorsteuer.vs_v_faktor=0".into(),
        "X.getriebe[0].position_settling_time=10000".into(),
        "X.getriebe[0].position_settling_time=0".into(),
        "X.getriebe[0].position_settling_time=-1".into(),
        "X.getriebe[0].pos_control_deadband=33".into(),
    ] {
        assert_eq!(advice("xyz", &set), [], "{set}");
    }
    assert_eq!(advice("vendor_defaults", ""), []);
}

/// Master and slave of a gantry with unequal scalings. Conformance: I028.
#[test]
fn gantry_partners_are_scaled_alike() {
    assert_eq!(advice("gantry", ""), []);
    for (set, parameter) in [
        ("X2.getriebe[0].wegaufz=2", "P-AXIS-00234"),
        ("X2.antr.v_reso_num=3", "P-AXIS-00206"),
        ("X.antr.feed_const_num=100000", "P-AXIS-00362"),
    ] {
        let found = advice("gantry", set);
        assert_eq!(found.len(), 1, "{set}: {found:?}");
        assert_eq!((found[0].0.as_str(), found[0].1), ("X2", parameter), "{set}");
        assert!(found[0].2.contains('X'), "{found:?}");
    }
    let both = "X.getriebe[0].wegaufz=2 X2.getriebe[0].wegaufz=2";
    assert_eq!(advice("gantry", both), []);
}
