//! Listings of the feedforward manual on the axis X of `xyz`, and the corrections with their places.

use super::*;

/// The axis X of `xyz` on a SERCOS drive with lines of the feedforward manual in its list.
fn with_listing(listing: &str) -> (AxisControlConfig, Vec<Diagnostic>, Vec<Diagnostic>) {
    let added = Disk("xyz/x.lis", format!("\nkenngr.antr_typ 2\n{listing}"));
    let (machine, loading) = load("xyz", &[], &added);
    let (chains, found) = told(&machine);
    (chains[0].control.clone(), loading, found)
}

const VELOCITY_INPUT: &str = "antr.sercos.at[0].ident_nr 37\nantr.sercos.mdt[0].ident_len 4\n\
                              antr.sercos.mdt[0].nc_ref S_0_0037\n";

/// TF5200 feedforward control 4.1: 10 mm per revolution, drive unit 1e-4 rpm; without and with a gear of 3.
/// Conformance: F049, F050, F051, F052, F053, F056.
#[test]
fn velocity_listing_of_the_manual() {
    let listing = |path| {
        format!(
            "vorsteuer.vorsteuerung 0x101 #0x001: Activation velocity feedforward\n\
             vorsteuer.velocity_delay_time 150 # Delay velocity feedforward\n\
             antr.v_time_base 0 #Timebase per minute\nantr.v_reso_num 10000 #Output value to drive\n\
             antr.v_reso_denom {path} #Resulting axis velocity in um/ v_time_base\n"
        )
    };
    for (path, counts) in [("10000", 6_000_000.0), ("3333", 18_001_800.0)] {
        let (c, loading, found) = with_listing(&(listing(path) + VELOCITY_INPUT));
        assert_eq!((loading, found), (vec![], vec![]));
        assert_eq!(c.feedforward.mode, FeedforwardMode::ADD_VEL);
        near(c.feedforward.velocity_delay_s, 150e-6);
        let drive = c.feedforward_format.counts_per_mm_s(1e-3) * 100.0;
        assert!((drive - counts).abs() < 0.5, "{drive}");
    }
    // without the value in the telegram this part is off
    let (c, _, found) = with_listing(&listing("3333"));
    assert_eq!(ids(&found), ["70350"]);
    assert!(c.feedforward.mode.is_empty());
}

/// TF5200 feedforward control 4.2: 5 mm per revolution, gear of 3, 0.48 kg cm2, 0.45 N m, factor 500, weight 12/10.
/// Conformance: F057, F058, F059, F061, F063, F064, F066, F067.
#[test]
fn torque_listing_of_the_manual() {
    let listing = "vorsteuer.vorsteuerung 0x202 #0x002: Activation acceleration feedforward\n\
                   antr.feed_const_num 50000 #feedconstant 5mm per revolution\nantr.feed_const_denom 1\n\
                   getriebe[0].incr_per_rev 1048576 #2**20 increments per motor revolution\n\
                   getriebe[0].gear_fact_num 3\ngetriebe[0].gear_fact_denom 1\n\
                   antr.acc_reference_value 0.45 #stall torque in Nm\nantr.torque_scale_num 500\n\
                   antr.torque_scale_denom 1\nvorsteuer.acceleration_delay_time 150\n\
                   vorsteuer.vs_a_faktor 12\nvorsteuer.vs_a_nenner 10\n";
    let load = |load: &str| format!("{listing}getriebe[0].load {load}\n");
    let telegram = "antr.sercos.mdt[0].nc_ref S_0_0080\n";
    let (c, loading, found) = with_listing(&(load("4.8e-5") + telegram));
    assert_eq!((loading, found), (vec![], vec![]));
    assert_eq!(c.feedforward.mode, FeedforwardMode::ADD_ACC);
    near(c.feedforward.acceleration_delay_s, 150e-6);
    let torque = c.torque.torque(1000.0);
    assert!((torque - 0.18096).abs() < 5e-6, "{torque}");
    let counts = c.torque.counts(torque);
    assert!((counts - 201.06).abs() < 5e-3, "{counts}");
    let weighted = counts * c.feedforward.acceleration_quotient;
    assert!((weighted - 241.27).abs() < 5e-3, "{weighted}");
    // the printed load means kg cm2
    let (_, _, found) = with_listing(&(load("0.48") + telegram));
    assert_eq!(ids(&found), ["K-0024"]);
    assert_eq!(found[0].parameter, Some("P-AXIS-00391"));
    // the listing repeats S_0_0037 and is accepted
    let (c, _, found) = with_listing(&(load("4.8e-5") + VELOCITY_INPUT));
    assert_eq!(ids(&found), ["70351"]);
    assert_eq!(found[0].severity, Severity::Note);
    assert_eq!(c.feedforward.mode, FeedforwardMode::ADD_ACC);
    let (c, _, found) = with_listing(&load("4.8e-5"));
    assert_eq!(ids(&found), ["70351"]);
    assert_eq!(found[0].severity, Severity::Warning);
    assert!(c.feedforward.mode.is_empty());
    // the last page of the document writes the gear ratio with the keys of older builds
    let old = "getriebe[].incr_per_rev 1048576\ngetriebe[].wegaufz 3 #gearbox ratio\n\
               getriebe[].wegaufn 1\nantr.feed_const_num 50000\nantr.feed_const_denom 1 #\n";
    let (_, loading, found) = with_listing(old);
    assert_eq!(ids(&loading), ["K-0029"; 3]);
    assert_eq!(ids(&found), ["K-0064"]);
    assert_eq!(found[0].parameter, Some("P-AXIS-00234"));
}
