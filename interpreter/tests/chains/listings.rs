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

/// Settings of `xyz` and the one message that each gives on loading or conversion, once, with its parameter.
/// Conformance: F062, F080, F082, F086, F088.
#[test]
#[rustfmt::skip]
fn corrections_name_axis_parameter_and_place() {
    let stage = stage_of_x();
    let ipc = "X.lr_param.improved_position_control";
    let torque = "X.vorsteuer.vorsteuerung=ADD_ACC kontur.axis[1].additive.torque=1";
    let filter = "X.filter[0].enable=1 X.filter[0].order=2";
    let s = str::to_owned;
    let cases = [
        ("70348", "P-AXIS-00390", s("X.vorsteuer.acceleration_delay_time=6000")),
        ("70348", "P-AXIS-00547", s("X.vorsteuer.jerk_delay_time=6000")),
        ("70349", "P-AXIS-00389", s("X.vorsteuer.velocity_delay_time=6000")),
        ("110465", "P-AXIS-00326", format!("{torque} X.antr.torque_scale_denom=0")),
        ("110473", "P-AXIS-00338", s("X.vorsteuer.jerk_fact_denom=0")),
        ("110579", "P-AXIS-00512", s("X.getriebe[0].gear_fact_denom=0")),
        ("110624", "P-AXIS-00223", s("X.vorsteuer.vorsteuerung=3 *.vorsteuer.feedforward_without_delay=1 S.vorsteuer.feedforward_without_delay=1")),
        ("80044", "P-AXIS-00051", s("X.antr.simu.daempfung_z=10 kontur.axis[1].plant.model=SIMU")),
        ("110040", "P-AXIS-00194", s("X.antr.simu.totzeit=6")),
        ("50663", "P-AXIS-00357", format!("{filter} X.filter[0].type=11")),
        ("60311", "P-AXIS-00357", s("S.filter[1].enable=1 S.filter[1].order=1 S.filter[1].type=11")),
        ("110239", "P-AXIS-00204", s("X.filter[0].type=7")),
        ("110239", "P-AXIS-00204", s("X.filter[1].type=HSC_GAUSS")),
        ("110500", "P-AXIS-00153", s("X.filter[0].prototype=HSC X.filter[1].prototype=HSC")),
        ("110501", "P-AXIS-00153", s("X.filter[1].prototype=HSC")),
        ("110361", "P-AXIS-00067", format!("{filter} X.filter[0].fg_f0=0")),
        ("50911", "P-AXIS-00140", s("X.filter[2].enable=1 X.filter[2].order=7")),
        ("K-0033", "P-AXIS-00080", format!("{filter} X.filter[0].type=BANDSTOP X.filter[0].guete=11")),
        ("K-0033", "P-AXIS-00164", format!("{filter} X.filter[0].share_percent=101")),
        ("K-0036", "P-AXIS-00140", s("X.filter[0].enable=1 X.filter[0].order=1 X.filter[0].type=PT2")),
        ("K-0037", "P-AXIS-00153", format!("{filter} X.filter[0].type=ALLPASS")),
        ("K-0038", "P-AXIS-00204", format!("{filter} X.filter[0].type=HIGHPASS")),
        ("K-0039", "P-AXIS-00153", s("X.filter[0].prototype=HSC X.filter[0].type=LOWPASS")),
        ("K-0040", "P-AXIS-00153", s("S.filter[0].prototype=HSC")),
        ("50989", "P-AXIS-00587", s("X.filter_fir.type=1 X.filter_fir.enable=1")),
        ("50910", "P-AXIS-00591", s("X.filter_fir.type=1 X.filter_fir.enable=1 X.filter_fir.order_time=999")),
        ("50820", "P-AXIS-00589", s("X.vib_guard.active=1 X.vib_guard.freq=600")),
        ("K-0023", "P-AXIS-00223", s("X.vorsteuer.vorsteuerung=0x100")),
        ("70350", "P-AXIS-00223", s("X.vorsteuer.vorsteuerung=ADD_VEL")),
        ("70351", "P-AXIS-00223", s("X.vorsteuer.vorsteuerung=ADD_ACC")),
        ("K-0062", "P-AXIS-00392", format!("{torque} X.antr.acc_reference_value=0")),
        ("K-0065", "P-AXIS-00092", s("X.getriebe[0].incr_per_rev=4096")),
        ("70603", "P-AXIS-00754", format!("{stage} {ipc}.stage[0].weight_fact_num=0")),
        ("70604", "P-AXIS-00755", format!("{stage} {ipc}.stage[0].weight_fact_denom=0")),
        ("K-0025", "P-AXIS-00750", format!("{stage} {ipc}.stage[0].filter[0].order=4")),
        ("K-0025", "P-AXIS-00751", format!("{stage} {ipc}.stage[0].filter[0].fg_f0=500.5")),
        ("K-0025", "P-AXIS-00756", format!("{stage} {ipc}.stage[0].mode=2 {ipc}.stage[0].filter.damping=1")),
        ("K-0026", "P-AXIS-00757", format!("{stage} {ipc}.v_add_max_fact=0")),
        ("K-0027", "P-AXIS-00754", format!("{stage} {ipc}.stage[0].weight_fact_num=8")),
    ];
    // a value that was not written has no place: it is the default that does not fit
    let unwritten = ["K-0037", "50989", "50663", "60311"];
    for (id, parameter, settings) in cases {
        let settings: Vec<&str> = settings.split_whitespace().collect();
        let (machine, mut found) = load("xyz", &settings, &Disk::default());
        found.extend(machine.chains().1);
        assert_eq!(ids(&found), [id], "{settings:?}: {found:?}");
        let found = &found[0];
        assert_eq!(found.parameter, Some(parameter), "{found:?}");
        assert_eq!(found.axis.as_ref().unwrap().name, settings[0][..1], "{found:?}");
        match &found.source {
            Some(at) => assert!(settings.contains(&&*at.text), "{settings:?}: {at:?}"),
            None => assert!(unwritten.contains(&id), "{found:?}"),
        }
    }
}
