//! Exact stop of whole loops: time until the lag is inside the window.

use super::profile::Profile;
use kontur_filters::control::monitor::ExactStopConfig;
use kontur_filters::control::plant::PlantModel;
use kontur_filters::control::{
    AxisControl, AxisControlConfig, Fault, FeedforwardConfig, FeedforwardMode,
};
use kontur_filters::time::CycleTime;

fn axis(kv_per_s: f64, ta_s: f64, settling_s: f64) -> AxisControl {
    let mut config = AxisControlConfig::new(500.0, 1e9, 1e12);
    config.position.kv_per_s = kv_per_s;
    config.plant.model = PlantModel::FirstOrder { time_constant_s: ta_s };
    config.exact_stop = ExactStopConfig { settling_s: Some(settling_s), ..Default::default() };
    AxisControl::new(config, CycleTime::DEFAULT).unwrap()
}

/// 100 mm/s for two seconds, then an abrupt stop.
fn abrupt(k: u32) -> f64 {
    0.1 * f64::from(k.min(2000))
}

/// Whether the axis was too late in the window, without other faults.
fn is_late(faults: &[Fault]) -> bool {
    matches!(faults, [Fault::SettlingTimeout { .. }])
}

/// Cycles from the end of the set positions to the first one in the window; faults raised.
fn stop(mut axis: AxisControl, set: impl Fn(u32) -> f64, last: u32) -> (u32, Vec<Fault>) {
    let mut entered = None;
    let mut faults = Vec::new();
    for k in 0..last + 2000 {
        if k == last {
            axis.expect_stop(set(last));
        }
        let out = axis.step(set(k), 1.0, true);
        faults.extend(axis.faults().iter().copied());
        // the actual value of the cycle start
        if k >= last && (set(last) - out.act_mm).abs() <= 0.05 {
            entered.get_or_insert(k - last);
        }
    }
    assert!(axis.distance_mm().abs() <= 0.05);
    (entered.unwrap(), faults)
}

/// `ln(lag / window) / Kv` for a drive with negligible lag (Ta 10 us): 74 ms and 530 ms.
/// Conformance: P006.
#[test]
fn abrupt_stop_closed_form() {
    for (kv, lag_mm) in [(50.0, 2.0), (10.0, 10.0)] {
        let want_s = libm::log(lag_mm / 0.05) / kv;
        let (cycles, faults) = stop(axis(kv, 1e-5, 1.0), abrupt, 2000);
        // the controller works once per cycle: (1 - Kv T)^k instead of exp(-Kv k T)
        let sampled = libm::ceil(libm::log(0.05 / lag_mm) / libm::log1p(-kv * 1e-3));
        assert!((f64::from(cycles) - sampled).abs() <= 1.0, "Kv {kv}: {cycles}, {sampled}");
        assert!((f64::from(cycles) * 1e-3 - want_s).abs() < 0.006, "Kv {kv}: {cycles}, {want_s}");
        assert_eq!(faults, []);
    }
}

/// Kv 10/s: 200 ms are too short, 600 ms are not, whatever the drive contributes.
/// Conformance: P006, P007.
#[test]
fn time_limit_decides() {
    for ta in [1e-5, 0.005] {
        assert!(is_late(&stop(axis(10.0, ta, 0.2), abrupt, 2000).1));
        assert!(is_late(&stop(axis(10.0, ta, 0.4), abrupt, 2000).1));
        assert_eq!(stop(axis(10.0, ta, 0.6), abrupt, 2000).1, []);
    }
}

/// Effects that shorten the 530 ms: the lag of the drive, which moves the axis further (502 ms), and a braking phase,
/// which begins to reduce the lag of 10 mm before the stop: `a / Kv2 (1 - exp(-1))` = 6.32 mm then remain (484 ms).
#[test]
fn what_shortens_the_settling() {
    let (cycles, _) = stop(axis(10.0, 0.005, 1.0), abrupt, 2000);
    assert!((497..=507).contains(&cycles), "{cycles}");
    let braking =
        Profile::rest().ramp(100.0, 1000.0, 0.001).then(2.0, 0.0).ramp(-100.0, 1000.0, 0.001);
    let last = (braking.end_s() * 1e3).round() as u32;
    let (cycles, _) = stop(axis(10.0, 1e-5, 1.0), |k| braking.at(f64::from(k) * 1e-3), last);
    assert!((479..=489).contains(&cycles), "{cycles}");
}

/// With velocity feedforward the lag left by braking, a Ta / Kv = 0.1 mm, halves in about ln(2)/Kv = 14 ms.
#[test]
fn feedforward_settles_soon() {
    let mut config = AxisControlConfig::new(500.0, 1e9, 1e12);
    config.position.kv_per_s = 50.0;
    config.plant.model = PlantModel::FirstOrder { time_constant_s: 0.005 };
    config.feedforward =
        FeedforwardConfig { mode: FeedforwardMode::VEL, ..FeedforwardConfig::default() };
    config.exact_stop.settling_s = Some(0.030);
    let axis = AxisControl::new(config, CycleTime::DEFAULT).unwrap();
    let delay = axis.delay_cycles() as u32;
    let profile =
        Profile::rest().ramp(200.0, 1000.0, 0.001).then(0.5, 0.0).ramp(-200.0, 1000.0, 0.001);
    let last = (profile.end_s() * 1e3).round() as u32;
    let (cycles, faults) = stop(axis, |k| profile.at(f64::from(k) * 1e-3), last);
    let after_buffer = cycles - delay;
    assert!((12..=20).contains(&after_buffer), "{after_buffer}");
    assert_eq!(faults, []);
}

/// The window extends to both sides of the target: the same number of cycles from either direction.
/// Conformance: P008.
#[test]
fn both_sides_of_the_target() {
    for settling_s in [0.2, 1.0] {
        let forth = stop(axis(10.0, 0.005, settling_s), abrupt, 2000);
        let back = stop(axis(10.0, 0.005, settling_s), |k| -abrupt(k), 2000);
        assert_eq!((forth.0, is_late(&forth.1)), (back.0, is_late(&back.1)));
    }
}
