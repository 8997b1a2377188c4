//! Lag of a first-order drive with and without feedforward.

use super::profile::Profile;
use kontur_filters::control::plant::{PlantConfig, PlantModel};
use kontur_filters::control::scaling::TorqueFormat;
use kontur_filters::control::{
    AxisControl, AxisControlConfig, ControlOutput, FeedforwardConfig, FeedforwardMode as Mode,
};
use kontur_filters::time::CycleTime;

fn axis(kv_per_s: f64, ta_s: f64, feedforward: FeedforwardConfig) -> AxisControl {
    let mut config = AxisControlConfig::new(500.0, 1e6, 1e9);
    config.position.kv_per_s = kv_per_s;
    config.plant = PlantConfig {
        model: PlantModel::FirstOrder { time_constant_s: ta_s },
        ..PlantConfig::default()
    };
    config.feedforward = feedforward;
    config.additive_inputs.velocity = true;
    config.additive_inputs.torque = true;
    config.torque = fine();
    let (config, issues) = config.checked(CycleTime::DEFAULT);
    assert_eq!(issues, []);
    AxisControl::new(config, CycleTime::DEFAULT).unwrap()
}

/// A moved mass of 200 kg and a drive that takes a millionth of 10 kN.
fn fine() -> TorqueFormat {
    TorqueFormat { load: 200.0, reference: 1e5, scale_num: 1e9, ..TorqueFormat::default() }
}

fn fed(mode: Mode, ta_s: f64) -> FeedforwardConfig {
    FeedforwardConfig { mode, acceleration_quotient: ta_s * 1e6, ..FeedforwardConfig::default() }
}

/// 100 mm/s, 1000 mm/s2, 20000 mm/s3, constant speed for `hold_s`, mirrored braking.
fn move_profile(hold_s: f64) -> Profile {
    Profile::rest().ramp(100.0, 1000.0, 0.05).then(hold_s, 0.0).ramp(-100.0, 1000.0, 0.05)
}

/// Every cycle whose reference lies in the profile.
fn run(mut axis: AxisControl, profile: &Profile, gain: f64) -> Vec<ControlOutput> {
    let delay = axis.delay_cycles();
    let cycles = (profile.end_s() * 1e3) as usize + 400;
    let all = (0..cycles + delay).map(|k| axis.step(profile.at(k as f64 * 1e-3), gain, true));
    let kept: Vec<_> = all.skip(delay).collect();
    assert!(kept.iter().all(|o| !o.faulty));
    assert!((kept[100].reference_mm - profile.at(0.1)).abs() < 1e-12, "aligned with the reference");
    kept
}

/// Kv in 1/s, time constant of the drive in s, feedforward for it, and four figures with their resolution.
type LagRow<'a> = (f64, f64, &'a dyn Fn(f64) -> FeedforwardConfig, [(f64, f64); 4]);

/// Conformance: F001, F002, F004, F008, F010, F011, F046, F047, F048.
#[test]
fn lag_table() {
    // digits: three, two, one, none after the point
    let (m, c, d, u) = (5e-4, 5e-3, 5e-2, 5e-1);
    let none = |_| FeedforwardConfig::default();
    let vel = |ta| fed(Mode::VEL, ta);
    let both = |ta| fed(Mode::VEL | Mode::ACC, ta);
    let all = Mode::VEL | Mode::ACC | Mode::JERK;
    let jerk = |ta| FeedforwardConfig { jerk_ratio: 1.0, ..fed(all, ta) };
    let weighted = |ta| FeedforwardConfig { global_ratio: 0.9, ..fed(Mode::VEL, ta) };
    // Kv and Ta; lag in um and its printed resolution at constant speed (last cycle), at k = 99 (last sample of constant
    // acceleration), largest and smallest
    let rows: [LagRow<'_>; 11] = [
        (50.0, 0.005, &none, [(2000.0, m), (1190.7, d), (2000.0, d), (0.0, u)]),
        (50.0, 0.005, &vel, [(0.0, m), (99.25, c), (99.42, c), (-99.42, c)]),
        (50.0, 0.005, &both, [(0.0, m), (0.0, c), (0.03, c), (-0.03, c)]),
        // the figures 38.70 and -1.45 belong to the derivatives of the profile itself; third differences of its
        // samples spread each jump of the jerk over two cycles
        (50.0, 0.005, &jerk, [(0.0, m), (-1.45, 2.0 * c), (38.70, d), (-38.70, d)]),
        (50.0, 0.005, &weighted, [(200.0, m), (208.4, d), (240.9, d), (-40.9, d)]),
        (50.0, 0.002, &none, [(2000.0, m), (1136.6, d), (2000.0, d), (0.0, u)]),
        (50.0, 0.002, &vel, [(0.0, m), (39.13, c), (39.25, c), (-39.25, c)]),
        (50.0, 0.002, &both, [(0.0, m), (0.0, c), (0.03, c), (-0.03, c)]),
        (10.0, 0.005, &none, [(9999.0, d), (2309.2, d), (9999.0, d), (0.0, u)]),
        (10.0, 0.005, &vel, [(0.06, c), (255.6, d), (294.2, d), (-294.1, d)]),
        (10.0, 0.005, &both, [(0.0, m), (-0.04, c), (0.07, c), (-0.07, c)]),
    ];
    for (kv, ta, feedforward, columns) in rows {
        let hold = if kv == 10.0 { 0.8 } else { 0.4 };
        let out = run(axis(kv, ta, feedforward(ta)), &move_profile(hold), 1.0);
        let lag = |k: usize| out[k].lag_mm * 1e3;
        let last = cycles(0.15 + hold) - 1;
        let all = || out.iter().map(|o| o.lag_mm * 1e3);
        let got =
            [lag(last), lag(99), all().fold(f64::MIN, f64::max), all().fold(f64::MAX, f64::min)];
        for (column, (got, (want, digits))) in got.into_iter().zip(columns).enumerate() {
            let ok = (got - want).abs() <= digits;
            assert!(ok, "Kv {kv}, Ta {ta}, column {column}: {got:.4}, table {want}");
        }
    }
}

fn cycles(t: f64) -> usize {
    (t * 1e3).round() as usize
}

/// Lag in um over a run with constant-speed part of 0.4 s.
fn lags(feedforward: FeedforwardConfig, gain: f64) -> Vec<f64> {
    let out = run(axis(50.0, 0.005, feedforward), &move_profile(0.4), gain);
    out.iter().map(|o| o.lag_mm * 1e3).collect()
}

/// Lag at constant speed is `(1 - W wv g) v / Kv`.
/// Conformance: F001, F004, F007, F008, F012, F025.
#[test]
fn constant_speed_closed_form() {
    for (global_ratio, velocity_ratio, gain) in
        [(1.0, 1.0, 0.8), (0.7, 1.0, 1.0), (1.2, 1.0, 1.0), (0.9, 0.8, 0.5), (1.0, 1.0, 0.0)]
    {
        let c = FeedforwardConfig { global_ratio, velocity_ratio, ..fed(Mode::VEL, 0.005) };
        let want = (1.0 - global_ratio * velocity_ratio * gain) * 2000.0;
        let got = lags(c, gain)[cycles(0.55) - 1];
        assert!((got - want).abs() < 1e-3, "{global_ratio} {velocity_ratio} {gain}: {got} {want}");
    }
}

/// Constant acceleration long enough for everything else to decay leaves `a Ta / Kv`, or nothing with ACC.
/// Conformance: F002, F004, F010.
#[test]
fn constant_acceleration_closed_form() {
    let profile = Profile::rest().ramp(400.0, 1000.0, 0.05);
    for (mode, ta, want) in
        [(Mode::VEL, 0.005, 100.0), (Mode::VEL, 0.002, 40.0), (Mode::VEL | Mode::ACC, 0.005, 0.0)]
    {
        let out = run(axis(50.0, ta, fed(mode, ta)), &profile, 1.0);
        let got = out[cycles(0.38)].lag_mm * 1e3;
        assert!((got - want).abs() < 0.01, "{mode:?} {ta}: {got} {want}");
    }
}

/// The drive adds the same speed whether it comes through the controller or as additive velocity; an additive torque
/// of weight 1 is what a matched time constant gives.
#[test]
fn additive_variant_moves_the_axis_alike() {
    let conventional = lags(fed(Mode::VEL | Mode::ACC, 0.005), 1.0);
    let additive = FeedforwardConfig {
        mode: Mode::ADD_VEL | Mode::ADD_ACC,
        acceleration_quotient: 1.0,
        ..FeedforwardConfig::default()
    };
    for (a, b) in conventional.iter().zip(lags(additive, 1.0)) {
        assert!((a - b).abs() < 1e-6, "{a} {b}");
    }
}

/// A weight belongs to the motion for which it was programmed, so it passes the buffer with its setpoint.
#[test]
fn weight_travels_through_the_buffer() {
    let mut axis = axis(50.0, 0.005, fed(Mode::VEL, 0.005));
    let profile = move_profile(0.4);
    for k in 0..400_u32 {
        let gain = if k < 300 { 0.0 } else { 1.0 };
        let out = axis.step(profile.at(f64::from(k) * 1e-3), gain, true);
        assert_eq!(
            out.feedforward.speed_mm_s != 0.0,
            k >= 304,
            "cycle {k}: the speed that leads to setpoint 300"
        );
    }
}

/// Values in the drive's format at 100 mm/s and 1 m/s2, the examples of the feedforward manual.
/// Conformance: F052, F064, F066, I023.
#[test]
fn drive_formats() {
    use kontur_filters::control::scaling::{Motor, SpeedFormat, TimeBase};
    let mut config = AxisControlConfig::new(500.0, 1e6, 1e9);
    config.position.kv_per_s = 50.0;
    config.plant.model = PlantModel::FirstOrder { time_constant_s: 0.005 };
    config.feedforward =
        FeedforwardConfig { acceleration_quotient: 1.2, ..fed(Mode::VEL | Mode::ADD_ACC, 0.0) };
    config.feedforward.acceleration_quotient = 1.2;
    config.additive_inputs.torque = true;
    config.feedforward_format = SpeedFormat::Resolution {
        increments: 10_000.0,
        path_um: 10_000.0,
        time_base: TimeBase::Minute,
    };
    config.torque = TorqueFormat {
        motor: Motor::Rotary { feed_mm: 5.0, gear_ratio: 3.0 },
        load: 0.48e-4,
        real_load: None,
        reference: 0.45,
        scale_num: 500.0,
        scale_denom: 1.0,
    };
    let out = run(AxisControl::new(config, CycleTime::DEFAULT).unwrap(), &move_profile(0.4), 1.0);
    let (accelerating, constant) = (&out[75].drive, &out[cycles(0.5)].drive);
    assert!((accelerating.torque - 241.27).abs() < 5e-3, "{}", accelerating.torque);
    assert!((accelerating.torque_n_m - 1.2 * 0.18096).abs() < 1e-5);
    assert!((constant.feedforward - 6_000_000.0).abs() < 0.01);
    assert!((constant.command - 12_000.0).abs() < 0.01, "6 m/min");
    assert!(constant.torque.abs() < 1e-4);
}

/// Lag in um of a loop with velocity and torque feedforward, integrated in steps of 10 us: position controller and
/// feedforward once per cycle, the torque in whole counts acting on the real mass.
fn own_simulation(profile: &Profile, counts_per_n: f64, believed: f64, real: f64) -> Vec<f64> {
    let (kv, ta, t, fine) = (50.0, 0.005, 1e-3, 100);
    let at = |k: i32| profile.at(f64::from(k.max(0)) * t);
    let (mut x, mut v) = (0.0, 0.0);
    (0..600)
        .map(|k| {
            let lag = at(k) - x;
            let u = kv * lag + (at(k + 1) - at(k)) / t;
            let speed =
                |k: i32| ((at(k - 2) - at(k + 2)) - 8.0 * (at(k - 1) - at(k + 1))) / (12.0 * t);
            let newton = believed * (speed(k + 1) - speed(k)) / t / 1e3;
            let a = (newton * counts_per_n).round() / counts_per_n / real * 1e3;
            for _ in 0..fine {
                let h = t / f64::from(fine);
                // midpoint
                let vm = v + 0.5 * h * ((u - v) / ta + a);
                x += h * vm;
                v += h * ((u - vm) / ta + a);
            }
            lag * 1e3
        })
        .collect()
}

/// The torque acts on the real inertia: a list value that is wrong by half leaves half of the lag, a value of 0 all of
/// it, and coarse counts are visible.
#[test]
fn a_wrong_inertia_shows_as_lag() {
    let profile = move_profile(0.4);
    let additive = |torque: TorqueFormat| {
        let feedforward = FeedforwardConfig {
            mode: Mode::VEL | Mode::ADD_ACC,
            acceleration_quotient: 1.0,
            ..FeedforwardConfig::default()
        };
        let mut config = axis(50.0, 0.005, feedforward).config().clone();
        config.torque = torque;
        let (config, _) = config.checked(CycleTime::DEFAULT);
        run(AxisControl::new(config, CycleTime::DEFAULT).unwrap(), &profile, 1.0)
    };
    for (load, scale_num, constant_um) in [
        (200.0, 1e9, 0.0),
        (100.0, 1e9, 50.0),
        (300.0, 1e9, -50.0),
        (1.0, 1e9, 99.5),
        (200.0, 7000.0, f64::NAN),
    ] {
        let format = TorqueFormat { load, real_load: Some(200.0), scale_num, ..fine() };
        let out = additive(format);
        let own = own_simulation(&profile, scale_num / 1e5, load, 200.0);
        for (k, (out, own)) in out.iter().zip(&own).enumerate() {
            let is = out.lag_mm * 1e3;
            assert!((is - own).abs() < 0.02, "{load} kg, cycle {k}: {is} {own}");
        }
        // 100 um, a Ta / Kv, remains without any torque
        let at = out[99].lag_mm * 1e3;
        assert!(constant_um.is_nan() || (at - constant_um).abs() < 1.0, "{load} kg: {at}");
    }
    let none = additive(TorqueFormat { scale_denom: 0.0, ..fine() });
    let plain = run(axis(50.0, 0.005, fed(Mode::VEL, 0.005)), &profile, 1.0);
    for (a, b) in none.iter().zip(&plain) {
        assert!((a.lag_mm - b.lag_mm).abs() < 1e-12, "a scale of 0: no torque");
    }
}

/// Feedforward switched on for a motion from rest is complete from its first difference on, as if it had always been
/// on. STEP slope, velocity and acceleration.
#[test]
fn switched_on_before_a_step_motion() {
    // 20 ms at rest, 1000 mm/s2 at once, constant speed
    let x = |k: u32| {
        let t = (f64::from(k) * 1e-3 - 0.02).max(0.0);
        if t < 0.1 { 500.0 * t * t } else { 100.0 * t - 5.0 }
    };
    let lag = |on_from: u32| -> Vec<f64> {
        let mut axis = axis(50.0, 0.005, fed(Mode::VEL | Mode::ACC, 0.005));
        (0..200)
            .map(|k| {
                let gain = if k >= on_from { 1.0 } else { 0.0 };
                axis.step(x(k), gain, false).lag_mm
            })
            .collect()
    };
    let first = (0..200_u32).find(|k| x(*k) > 0.0).unwrap();
    let (always, switched) = (lag(0), lag(first));
    for (a, b) in always.iter().zip(&switched) {
        assert_eq!(a.to_bits(), b.to_bits());
    }
    assert!(always.iter().all(|lag| lag.abs() < 1e-3), "less than 1 um");
}

/// Switching feedforward off does not empty its delay: the last values are still output five cycles later, also with
/// the longest delay of the channel, with which the gain of the whole buffer is 0 before that.
#[test]
fn a_delay_outlasts_the_gain() {
    let outputs = |velocity_delay_s: f64| {
        let feedforward =
            FeedforwardConfig { mode: Mode::ADD_VEL, velocity_delay_s, ..Default::default() };
        let mut config = AxisControlConfig::new(500.0, 1e6, 1e9);
        config.delay_cycles = 13;
        config.feedforward = feedforward;
        config.additive_inputs.velocity = true;
        let mut axis = AxisControl::new(config, CycleTime::DEFAULT).unwrap();
        let gain = |k: usize| if k < 60 { 1.0 } else { 0.0 };
        let step = |k: usize| axis.step(0.1 * k as f64, gain(k), true);
        (0..120).map(step).map(|o| o.feedforward.additive_speed_mm_s).collect::<Vec<_>>()
    };
    let (plain, delayed) = (outputs(0.0), outputs(5e-3));
    assert!(plain.iter().any(|v| (v - 100.0).abs() < 1e-9) && plain[119].abs() < 1e-9);
    for k in 5..120 {
        assert!((delayed[k] - plain[k - 5]).abs() < 1e-9, "{k}: {} {}", delayed[k], plain[k - 5]);
    }
}
