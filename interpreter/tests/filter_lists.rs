//! Axis filters as the manual lists them: their responses. Values, ranges and messages are rows of `lists/axis_filters.txt`.

use kontur_filters::iir::AxisFilter;
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
        let settings: Vec<String> =
            keys.iter().map(|key| format!("X.{}", key.replacen(' ', "=", 1))).collect();
        let (machine, found) = machine(&settings.iter().map(String::as_str).collect::<Vec<_>>());
        assert_eq!(found, [], "{lines}");
        machine.chains().0.swap_remove(0).additional.unwrap().filter.unwrap()
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

/// Two filters in their order.
#[test]
fn standard_filters_in_their_order() {
    let mut set = with("X.filter[0]", "enable=1 type=BANDSTOP order=2 fg_f0=21.5 guete=3");
    set.extend(with("X.filter[2]", "enable=1 type=TIME_DELAY order=1 time_constant=2500"));
    let (machine, _) = machine(&set.iter().map(String::as_str).collect::<Vec<_>>());
    let filters = &machine.chains().0[0].filters;
    assert!(filters.len() == 2 && (filters[1].delay_cycles() - 2.5).abs() < 1e-9);
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
