//! Axis filters, HSC filters and Vibration Guard as stated in the lists: the resulting values and the messages.

use kontur_filters::hsc::HscKind;
use kontur_filters::iir::AxisFilter;
use kontur_filters::kernel::Kernel;
use kontur_filters::response::Angle;
use kontur_filters::shaping::Shaping;
use kontur_filters::stage::Stage;
use kontur_filters::time::CycleTime;
use kontur_interpreter::diag::Diagnostic;
use kontur_interpreter::machine::lists;
use kontur_interpreter::machine::table::ListKind;
use kontur_interpreter::machine::{Machine, Override};

const MS: CycleTime = CycleTime::DEFAULT;

/// The built-in machine with settings, and all messages about it except recommendations (K-0078).
fn machine(settings: &[&str]) -> (Machine, Vec<Diagnostic>) {
    let settings: Vec<Override> = settings.iter().map(|s| Override::parse(s).unwrap()).collect();
    let (machine, mut found) = Machine::builtin(&settings).unwrap();
    found.extend(machine.chains().1);
    found.retain(|d| d.id.to_string() != "K-0078");
    (machine, found)
}

/// Settings `prefix.key=value` from `key=value ...`.
fn with(prefix: &str, entries: &str) -> Vec<String> {
    entries.split_whitespace().map(|entry| format!("{prefix}.{entry}")).collect()
}

/// The axis filters of X with one entry, and the IDs of the messages.
fn x(entries: &str) -> (Shaping, Vec<String>) {
    let settings = with("X.filter[0]", entries);
    let (machine, found) = machine(&settings.iter().map(String::as_str).collect::<Vec<_>>());
    assert!(found.iter().all(|d| d.axis.as_ref().unwrap().name == "X"), "{found:?}");
    let filters = machine.chains().0.swap_remove(0).filters;
    (Shaping::new(filters, 0.0), found.iter().map(|d| d.id.to_string()).collect())
}

/// The response to a ramp that ends.
fn ramp(shaping: &mut Shaping) -> Vec<f64> {
    (0..500).map(|n| shaping.step(0.1 * f64::from(n.min(100)))).collect()
}

fn db(shaping: &Shaping, f_hz: f64) -> f64 {
    shaping.response(Angle::of(f_hz, MS)).magnitude_db()
}

/// The kernel of the HSC filter of X, and the IDs of the messages.
fn hsc(entries: &str) -> (Option<Kernel>, Vec<String>) {
    let settings = with("X.filter[0]", &format!("prototype=HSC {entries}"));
    let (machine, found) = machine(&settings.iter().map(String::as_str).collect::<Vec<_>>());
    let preset = machine.axes[0].kernel_preset(MS);
    let kernel = preset.hsc.and_then(|hsc| hsc.design(MS).0);
    (kernel, found.iter().map(|d| d.id.to_string()).collect())
}

fn none() -> Vec<String> {
    Vec::new()
}

/// IDs of the messages on reading an axis list.
fn said(text: &str) -> Vec<Diagnostic> {
    let mut diagnostics = Vec::new();
    lists::read(ListKind::Axis, "x.lis", text.as_bytes(), &mut diagnostics);
    diagnostics
}

/// The listings of the manual for one axis.
/// Conformance: A031, A049, A055, A057, A059, A060.
#[test]
fn listings_of_the_axis_filter_manual() {
    let (shaping, ids) =
        x("enable=1 type=LOWPASS order=4 prototype=CRIT_DAMPING fg_f0=15 share_percent=100");
    assert_eq!(ids, none());
    assert!((shaping.delay_cycles() - 18.447).abs() < 5e-4);
    let (shaping, ids) = x(
        "enable=1 type=BANDSTOP order=2 prototype=BUTTERWORTH fg_f0=20 guete=4 share_percent=100",
    );
    assert_eq!(ids, none());
    assert!(db(&shaping, 20.0) < -120.0);
    let (shaping, ids) = x("enable=1 type=PT1 order=1 time_constant=10000 share_percent=100");
    assert_eq!(ids, none());
    assert!((db(&shaping, 15.9155) + 3.0103).abs() < 1e-3);
    let (shaping, ids) = x("enable=1 type=PT2 order=2 time_constant=5000 share_percent=100");
    assert_eq!(ids, none());
    assert!((db(&shaping, 31.831) + 6.0206).abs() < 1e-3);
    let (mut shaping, ids) = x("enable=1 type=TIME_DELAY order=1 time_constant=2000");
    assert_eq!(ids, none());
    assert_eq!(ramp(&mut shaping)[..5], [0.0, 0.0, 0.0, 0.1, 0.2]);
}

/// On the axis that has the filter, and on no other; on linear and rotary axes and on spindles.
/// Conformance: A003, A013.
#[test]
fn a_filter_acts_on_its_axis() {
    let set =
        |axis: &str, more: &str| with(&format!("{axis}.filter[0]"), &format!("fg_f0=15 {more}"));
    let counts = |settings: &[String]| -> Vec<usize> {
        let (machine, found) = machine(&settings.iter().map(String::as_str).collect::<Vec<_>>());
        assert_eq!(found, []);
        machine.chains().0.iter().map(|chain| chain.filters.len()).collect()
    };
    assert_eq!(counts(&set("X", "enable=1 order=4")), [1, 0, 0, 0]);
    assert_eq!(counts(&set("S", "enable=1 order=4")), [0, 0, 0, 1]);
    assert_eq!(counts(&set("X", "enable=0 order=4")), [0; 4]);
    let mut rotary = set("Z", "enable=1 order=4");
    rotary.push("Z.kenngr.achs_typ=ACHSTYP_ROTATOR".to_owned());
    assert_eq!(counts(&rotary), [0, 0, 1, 0]);
}

/// The filter of the additional interface of X from `lr_param.add_interface` lines, the IDs of the messages on reading and on setting up,
/// and whether there is an interface.
fn additional(entries: &str) -> (Option<AxisFilter>, Vec<String>, bool) {
    let prefix = "X.lr_param.add_interface";
    let settings: Vec<String> =
        entries.split_whitespace().map(|e| format!("{prefix}.{e}")).collect();
    let (machine, found) = machine(&settings.iter().map(String::as_str).collect::<Vec<_>>());
    let interface = machine.chains().0.swap_remove(0).additional;
    let ids = found.iter().map(|d| d.id.to_string()).collect();
    let is_on = interface.is_some();
    (interface.and_then(|i| i.filter), ids, is_on)
}

/// The listings of the manual for the additional interface: they load as printed, also with `Lr_param`, and give the expected
/// frequencies: -3 dB of the low-pass at 8 Hz; edges of the band stop `17 (sqrt(1 + 1/4Q^2) +- 1/2Q)`, `Q` = 1.8; PT1 and PT2 at
/// their `1 / 2 pi tau`; the delay.
/// Conformance: A012, A032, A050, A057, A060, A065.
#[test]
fn listings_of_the_additional_interface() {
    let listing = |lines: &str| {
        let prefix = "lr_param.add_interface";
        let keys: Vec<String> =
            lines.split(';').map(|l| format!("{prefix}.{}", l.trim())).collect();
        let text = keys.join("\n");
        let text = text.replacen("lr_param", "Lr_param", 1);
        assert_eq!(said(&text), [], "{lines}");
        let entries: Vec<String> =
            lines.split(';').map(|l| l.trim().replacen(' ', "=", 1)).collect();
        let (filter, ids, _) = additional(&entries.join(" "));
        assert_eq!(ids, none(), "{lines}");
        filter.unwrap()
    };
    let db = |filter: &AxisFilter, f: f64| filter.response(Angle::of(f, MS)).magnitude_db();
    let common = "enable 1; filter[0].enable 1; filter[0].share_percent 100";
    let low = listing(&format!(
        "{common}; filter[0].order 3; filter[0].prototype BUTTERWORTH; filter[0].type LOWPASS; filter[0].fg_f0 8"
    ));
    assert!((db(&low, 8.0) + 3.0103).abs() < 1e-4);
    let stop = listing(&format!(
        "{common}; filter[0].order 3; filter[0].prototype BUTTERWORTH; filter[0].type BANDSTOP; filter[0].fg_f0 17; \
         filter[0].guete 1.8"
    ));
    assert!(db(&stop, 17.0) < -120.0);
    for edge in [12.920, 22.365] {
        assert!((db(&stop, edge) + 3.0103).abs() < 0.06, "{edge}: {}", db(&stop, edge));
    }
    let pt1 = listing(&format!(
        "{common}; filter[0].order 1; filter[0].type PT1; filter[0].time_constant 10000"
    ));
    assert!((db(&pt1, 15.9155) + 3.0103).abs() < 1e-3);
    let pt2 = listing(&format!(
        "{common}; filter[0].order 2; filter[0].type PT2; filter[0].time_constant 5000"
    ));
    assert!((db(&pt2, 31.831) + 6.0206).abs() < 1e-3);
    let mut delay = listing(&format!(
        "{common}; filter[0].order 1; filter[0].type TIME_DELAY; filter[0].time_constant 2000"
    ));
    let out: Vec<f64> = [1.0, 2.0, 3.0, 4.0].map(|x| delay.step(x)).to_vec();
    assert_eq!(out, [0.0, 0.0, 1.0, 2.0]);
    // one filter only
    let found = said("lr_param.add_interface.filter[1].order 1\n");
    assert_eq!(found[0].id.to_string(), "1001119");
}

/// Switches, defaults and forbidden values: the interface and its filter have a switch each, the filter needs an order; for PT1, PT2 and
/// `TIME_DELAY` any order switches on; HSC is refused; the defaults PT2 and 0 us are out of range.
/// Conformance: A089, A107, A109, A116.
#[test]
fn filter_of_the_additional_interface() {
    let on = "enable=1 filter[0].enable=1";
    let pt2 = "filter[0].time_constant=5000";
    // entries, ID, whether there is an interface, whether it has a filter
    let cases = [
        (String::new(), "", false, false),
        (format!("filter[0].enable=1 {pt2}"), "", false, false),
        (format!("enable=1 {pt2}"), "", true, false),
        (format!("{on} {pt2}"), "", true, true),
        (format!("{on} {pt2} filter[0].order=0"), "K-0075", true, false),
        (format!("{on} {pt2} filter[0].order=1"), "", true, true),
        (format!("{on} {pt2} filter[0].type=PT1"), "", true, true),
        (format!("{on} {pt2} filter[0].type=PT1 filter[0].order=7"), "", true, true),
        (format!("{on} {pt2} filter[0].type=TIME_DELAY filter[0].order=4"), "", true, true),
        (format!("{on} filter[0].type=LOWPASS filter[0].order=7"), "50911", true, true),
        (on.to_owned(), "50663", true, false),
        (format!("{on} filter[0].type=HSC_MEAN"), "K-0041", true, false),
        (format!("{on} filter[0].type=12"), "K-0041", true, false),
        (format!("{on} {pt2} filter[0].prototype=HSC"), "K-0041", true, false),
        (format!("{on} filter[0].type=HSC_SINE"), "110239", true, false),
        (format!("{on} filter[0].type=HSC_GAUSS"), "110239", true, false),
    ];
    for (entries, id, interface, filtered) in cases {
        let (filter, ids, is_on) = additional(&entries);
        assert_eq!(ids.join(" "), id, "{entries}");
        assert_eq!((is_on, filter.is_some()), (interface, filtered), "{entries}");
    }
}

/// A filter that the list switches on without giving an order is off (page 118178059), and a message says so; HSC needs no switch, and a
/// filter that is off needs no order.
#[test]
fn a_filter_without_order_is_named() {
    for kind in
        ["LOWPASS", "HIGHPASS", "BANDSTOP", "ALLPASS prototype=BESSEL", "PT1", "PT2", "TIME_DELAY"]
    {
        for order in ["", "order=0"] {
            let (mut chain, ids) = x(&format!("enable=1 type={kind} {order}"));
            assert_eq!(ids, ["K-0075"], "{kind}");
            let out = ramp(&mut chain);
            assert!(
                out.iter().zip(0..).all(|(y, n)| (y - 0.1 * f64::from(n.min(100))).abs() < 1e-12)
            );
        }
        assert_eq!(x(&format!("type={kind}")).1, none(), "{kind}");
    }
    assert!(!hsc("enable=1 type=8 order=0 time_constant=20000").1.contains(&"K-0075".to_owned()));
}

/// Up to three filters in series. Conformance: A011.
#[test]
fn three_filters_in_series() {
    let mut settings = Vec::new();
    for (i, f) in [15, 40, 80].into_iter().enumerate() {
        let prefix = format!("X.filter[{i}]");
        settings.extend(with(&prefix, &format!("enable=1 order=2 type=LOWPASS fg_f0={f}")));
    }
    let (machine, found) = machine(&settings.iter().map(String::as_str).collect::<Vec<_>>());
    assert_eq!(found, []);
    let chain = Shaping::new(machine.chains().0.swap_remove(0).filters, 0.0);
    let one = |f: u32| x(&format!("enable=1 order=2 type=LOWPASS fg_f0={f}")).0;
    for f in [5.0, 15.0, 60.0, 200.0] {
        let product: f64 = [15, 40, 80].map(|fg| db(&one(fg), f)).iter().sum();
        assert!((db(&chain, f) - product).abs() < 1e-9, "{f} Hz");
    }
    let found = said("filter[3].enable 1\n");
    assert_eq!(found[0].id.to_string(), "1001119");
}

/// Ranges and the reaction to each. Conformance: A053, A056, A063, A068, A075, A091, A092, A094, A095, A098, A099, A101.
#[test]
fn ranges_of_axis_filters() {
    // entries, ID, whether a filter remains
    let cases = [
        ("type=ALLPASS order=2", "K-0037", true),
        ("type=ALLPASS order=2 prototype=BESSEL", "", true),
        ("type=PT1 order=1", "", true),
        ("type=PT1 order=3", "50911", true),
        ("type=TIME_DELAY order=1 time_constant=5999", "", true),
        ("type=TIME_DELAY order=1 time_constant=6000", "50663", false),
        ("type=TIME_DELAY order=1", "50663", false),
        ("type=HSC_MEAN order=2", "K-0039", false),
        ("order=2 fg_f0=499.9", "", true),
        ("order=2 fg_f0=500", "K-0033", false),
        ("order=2 fg_f0=0", "110361", true),
        ("type=BANDSTOP order=2 guete=0.9", "K-0033", false),
        ("type=BANDSTOP order=2 guete=10.1", "K-0033", false),
        ("type=BANDSTOP order=2 guete=1", "", true),
        ("type=BANDSTOP order=2 guete=10", "", true),
        ("order=6", "", true),
        ("order=7", "50911", true),
        ("type=BANDSTOP order=3", "", true),
        ("type=BANDSTOP order=4", "50911", true),
        ("order=2 share_percent=101", "K-0033", false),
        ("type=7 order=2", "110239", false),
        ("type=9 order=2", "110239", false),
        ("type=13 order=2", "110239", false),
        ("type=PT1 order=1 time_constant=999", "50663", false),
        ("type=PT1 order=1 time_constant=1000", "", true),
    ];
    for (entries, id, runs) in cases {
        let (shaping, ids) = x(&format!("enable=1 {entries}"));
        assert_eq!(ids.join(" "), id, "{entries}");
        assert_eq!(shaping.delay_cycles() > 0.0, runs, "{entries}");
    }
    // a corrected order is the highest permitted one, a corrected frequency the lowest
    let same = |a: &str, b: &str| {
        let (mut a, mut b) = (x(&format!("enable=1 {a}")).0, x(&format!("enable=1 {b}")).0);
        ramp(&mut a) == ramp(&mut b)
    };
    assert!(same("order=7", "order=6") && !same("order=6", "order=5"));
    assert!(same("type=PT1 order=3", "type=PT1 order=1"));
    assert!(same("order=2 fg_f0=0", "order=2 fg_f0=0.01"));
    // names and numbers
    assert!(same("order=2 prototype=2", "order=2 prototype=BUTTERWORTH"));
    assert!(same("order=2 type=4", "order=2 type=BANDSTOP") && !same("order=2", "order=2 type=4"));
}

/// A prototype number that is not assigned; names and numbers of the others. Conformance: A002, A097.
#[test]
fn prototypes_of_a_list() {
    let (mut off, ids) = x("enable=1 order=2 prototype=4");
    assert_eq!(ids, ["K-0070"]);
    assert_eq!(ramp(&mut off), ramp(&mut Shaping::new(vec![], 0.0)), "filter off");
    let step = |prototype: &str| {
        let (mut shaping, ids) = x(&format!("enable=1 order=2 prototype={prototype}"));
        assert_eq!(ids, none());
        ramp(&mut shaping)
    };
    for (number, name) in [("1", "CRIT_DAMPING"), ("2", "BUTTERWORTH"), ("3", "BESSEL")] {
        assert_eq!(step(number), step(name));
    }
    assert_ne!(step("1"), step("2"));
    assert_ne!(step("2"), step("3"));
    assert_eq!(ramp(&mut x("enable=1 order=2").0), step("CRIT_DAMPING"), "the default");
}

/// Signal share: 50 % leaves half of what the filter removes, 0 % all of it. Conformance: A098.
#[test]
fn share_of_a_list() {
    let (shaping, _) = x("enable=1 order=6 prototype=BUTTERWORTH share_percent=50");
    assert!((db(&shaping, 450.0) + 6.02).abs() < 0.01);
    let (mut all, _) = x("enable=1 order=6 share_percent=0");
    let input: Vec<f64> = ramp(&mut Shaping::new(vec![], 0.0));
    assert_eq!(ramp(&mut all), input);
}

/// HSC: one per axis, the first filter, not on spindles. Conformance: A007, A069, A070, A100.
#[test]
fn where_hsc_is_allowed() {
    let of = |settings: &[&str]| {
        let (machine, found) = machine(settings);
        let hsc = |axis: &str| machine.axis(axis).unwrap().kernel_preset(MS).hsc;
        let said: Vec<String> =
            found.iter().map(|d| format!("{} {}", d.axis.as_ref().unwrap().name, d.id)).collect();
        (hsc("X").map(|hsc| hsc.kind), hsc("S").is_some(), said)
    };
    let mean = Some(HscKind::Mean);
    let first = ["X.filter[0].prototype=HSC", "X.filter[0].order=10"];
    assert_eq!(of(&first), (mean, false, none()));
    let second = [first[0], first[1], "X.filter[1].prototype=HSC", "X.filter[1].order=10"];
    assert_eq!(of(&second), (mean, false, vec!["X 110500".to_owned()]));
    let not_first = ["X.filter[1].prototype=HSC", "X.filter[1].order=10"];
    assert_eq!(of(&not_first), (None, false, vec!["X 110501".to_owned()]));
    let spindle = ["S.filter[0].prototype=HSC", "S.filter[0].type=HSC_MEAN", "S.filter[0].order=9"];
    assert_eq!(of(&spindle), (None, false, vec!["S K-0040".to_owned()]));
}

/// Order or time constant of the HSC filters. Conformance: A075, A088, A095, A102, A103, A104.
#[test]
fn order_of_hsc() {
    let length = |entries: &str| {
        let (kernel, ids) = hsc(entries);
        (kernel.map(|kernel| kernel.length()), ids)
    };
    assert_eq!(length("type=8 order=0 time_constant=20000"), (Some(20), none()));
    assert_eq!(length("type=8 order=10 time_constant=20000"), (Some(10), none()));
    assert_eq!(length("type=8 order=0 time_constant=500"), (None, vec!["50910".to_owned()]));
    assert_eq!(length("type=8 order=10 time_constant=500"), (Some(10), none()));
    // the default of 10 ms
    assert_eq!(length("type=8"), (Some(10), none()));
    assert!((hsc("type=8").0.unwrap().delay_cycles() - 5.0).abs() < 1e-12);
    assert_eq!(length("type=8 order=200"), (Some(200), none()));
    assert_eq!(length("type=8 order=201"), (Some(200), vec!["50911".to_owned()]));
    // NoVib computes its order, both keys only switch on
    let no_vib = length("type=12 order=1");
    assert_eq!(no_vib, (Some(34), none()));
    assert_eq!(length("type=12 order=0 time_constant=10000"), no_vib);
    assert_eq!(length("type=LOWPASS order=2"), (None, vec!["K-0039".to_owned()]));
}
