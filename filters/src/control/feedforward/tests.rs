#![expect(clippy::float_cmp, reason = "exact values are what is tested")]

use super::*;

const T: CycleTime = CycleTime::DEFAULT;
const BOTH: AdditiveInputs = AdditiveInputs { velocity: true, torque: true };
const NONE: AdditiveInputs = AdditiveInputs { velocity: false, torque: false };
const KV: f64 = 50.0;

fn config(mode: FeedforwardMode) -> FeedforwardConfig {
    FeedforwardConfig { mode, ..FeedforwardConfig::default() }
}

/// Window of the cubic `v t + a t2/2 + j t3/6` with the sample at `t = 0` in its place.
fn window(v: f64, a: f64, j: f64) -> Window {
    let at = |k: f64| {
        let t = k * 1e-3;
        t * (v + t * (a / 2.0 + t * j / 6.0))
    };
    Window {
        positions_mm: [at(-2.0), at(-1.0), 0.0, at(1.0), at(2.0), at(3.0)],
        gain: 1.0,
        jerk_limited: true,
    }
}

/// Conformance: F049, F057, F072.
#[test]
fn flags_are_the_vendor_numbers() {
    assert_eq!(FeedforwardMode::from_bits(0x101), Some(FeedforwardMode::ADD_VEL));
    assert_eq!(FeedforwardMode::VEL | FeedforwardMode::ADD_VEL, FeedforwardMode::ADD_VEL);
    assert_eq!(FeedforwardMode::from_bits(0x202), Some(FeedforwardMode::ADD_ACC));
    assert_eq!(FeedforwardMode::from_bits(0x804), Some(FeedforwardMode::ADD_JERK));
    assert_eq!(
        FeedforwardMode::from_bits(0x007).unwrap(),
        FeedforwardMode::VEL | FeedforwardMode::ACC | FeedforwardMode::JERK
    );
    assert_eq!(FeedforwardMode::from_bits(0x1000), None);
}

/// Conformance: F006, F026, F078.
#[test]
fn switch_and_weight() {
    let c = config(FeedforwardMode::VEL);
    assert_eq!(c.gain(true, 0.8), 0.8);
    assert_eq!(c.gain(false, 0.8), 0.0);
    assert_eq!(c.gain(true, 1.5), 1.0, "a weight is at most 100 %");
    let always = FeedforwardConfig { default_active: true, ..c };
    assert_eq!(always.gain(false, 0.8), 0.8, "on under G137");
    assert_eq!(FeedforwardConfig { global_disable: true, ..always }.gain(true, 1.0), 0.0);
    assert_eq!(config(FeedforwardMode::empty()).gain(true, 1.0), 0.0);
}

/// Means over the coming cycle: v + aT/2 + jT2/6 for the velocity, a + jT/2 for the acceleration.
/// Conformance: F003, F005, F077.
#[test]
fn conventional_law() {
    use FeedforwardMode as M;
    let (v, a, j, t) = (80.0, 900.0, 20000.0, 1e-3);
    let c = FeedforwardConfig {
        global_ratio: 0.9,
        velocity_ratio: 0.8,
        acceleration_quotient: 5000.0,
        jerk_ratio: 0.5,
        ..FeedforwardConfig::default()
    };
    let speed = |mode| {
        let mut w = window(v, a, j);
        w.gain = 0.7;
        let c = FeedforwardConfig { mode, ..c };
        let out = Feedforward::new(c, T).step(&w, KV);
        assert_eq!((out.additive_speed_mm_s, out.additive_acc_mm_s2), (0.0, 0.0));
        out.speed_mm_s / (0.7 * 0.9)
    };
    let vel = 0.8 * (v + a * t / 2.0 + j * t * t / 6.0);
    let acc = 0.005 * (a + j * t / 2.0);
    let jerk = 0.5 * 0.005 / KV * j;
    for (mode, want) in [
        (M::VEL, vel),
        (M::ACC, acc),
        (M::JERK, jerk),
        (M::VEL | M::ACC | M::JERK, vel + acc + jerk),
    ] {
        assert!((speed(mode) - want).abs() < 1e-9, "{mode:?}: {} {want}", speed(mode));
    }
}

/// Conformance: F074.
#[test]
fn no_jerk_branch_on_a_step_slope() {
    let mut w = window(0.0, 0.0, 1000.0);
    w.jerk_limited = false;
    let c = FeedforwardConfig { acceleration_quotient: 5000.0, ..config(FeedforwardMode::JERK) };
    assert_eq!(Feedforward::new(c, T).step(&w, KV).speed_mm_s, 0.0);
    let c = config(FeedforwardMode::ADD_JERK);
    assert_eq!(Feedforward::new(c, T).step(&w, KV).additive_acc_mm_s2, 0.0);
}

/// Conformance: F015.
#[test]
fn additive_variant_weights_and_leaves_the_controller_alone() {
    let mode = FeedforwardMode::ADD_VEL | FeedforwardMode::ADD_ACC | FeedforwardMode::ADD_JERK;
    let c = FeedforwardConfig { acceleration_quotient: 1.2, jerk_ratio: 2.0, ..config(mode) };
    let out = Feedforward::new(c, T).step(&window(100.0, 1000.0, 0.0), KV);
    assert_eq!(out.speed_mm_s, 0.0);
    assert!((out.additive_speed_mm_s - 100.5).abs() < 1e-9);
    assert!((out.additive_acc_mm_s2 - 1200.0).abs() < 1e-6);
    // jerk factor times 1 ms
    let out = Feedforward::new(c, T).step(&window(0.0, -10.0, 20000.0), KV);
    assert!((out.additive_acc_mm_s2 - 2.0 * 1e-3 * 20000.0).abs() < 1e-3);
}

/// Conformance: F054.
#[test]
fn delays_interpolate_between_samples() {
    for (delay_s, shift) in
        [(0.0, 0.0), (150e-6, 0.15), (1e-3, 1.0), (2.5e-3, 2.5), (5.999e-3, 5.999)]
    {
        let c = FeedforwardConfig { velocity_delay_s: delay_s, ..config(FeedforwardMode::ADD_VEL) };
        let mut ff = Feedforward::new(c, T);
        for k in 0..20_u32 {
            let v = f64::from(k);
            let out = ff.step(&window(v, 0.0, 0.0), KV).additive_speed_mm_s;
            if k > 6 {
                assert!((out - (v - shift)).abs() < 1e-9, "{delay_s} s, cycle {k}: {out}");
            }
        }
    }
}

/// Conformance: F050, F055, F058, F065.
#[test]
fn corrections() {
    let mode = FeedforwardMode::ADD_VEL | FeedforwardMode::ADD_ACC | FeedforwardMode::ADD_JERK;
    let delayed = |s: f64| FeedforwardConfig {
        velocity_delay_s: s,
        acceleration_delay_s: s,
        jerk_delay_s: s,
        ..config(mode)
    };
    assert!(delayed(5.999e-3).checked(T, BOTH).1.is_empty());
    let (c, issues) = delayed(6e-3).checked(T, BOTH);
    assert!(matches!(
        issues[..],
        [
            Issue::VelocityDelay { .. },
            Issue::AccelerationDelay { jerk: false, .. },
            Issue::AccelerationDelay { jerk: true, .. }
        ]
    ));
    assert_eq!((c.velocity_delay_s, c.acceleration_delay_s, c.jerk_delay_s), (0.0, 0.0, 0.0));

    let (c, issues) = config(mode).checked(T, NONE);
    assert_eq!(issues, [Issue::NoAdditiveVelocity, Issue::NoAdditiveTorque]);
    assert!(c.mode.is_empty());
    let conventional = config(FeedforwardMode::VEL | FeedforwardMode::ACC);
    assert_eq!(conventional.checked(T, NONE), (conventional, vec![]));

    let stray = config(FeedforwardMode::from_bits(0x100 | 0x002).unwrap());
    let (c, issues) = stray.checked(T, BOTH);
    assert_eq!((c.mode, issues), (FeedforwardMode::ACC, vec![Issue::OutputWithoutActivation]));

    let short = FeedforwardConfig {
        without_delay: true,
        ..config(FeedforwardMode::VEL | FeedforwardMode::ACC)
    };
    let (c, issues) = short.checked(T, BOTH);
    assert_eq!(
        (c.mode, issues),
        (FeedforwardMode::VEL, vec![Issue::WithoutDelayNeedsVelocityOnly])
    );

    let both = FeedforwardConfig { default_active: true, global_disable: true, ..conventional };
    assert_eq!(both.checked(T, BOTH).1, [Issue::ActiveAndDisabled]);
}

#[test]
fn channel_takes_the_longest_delay() {
    let off = FeedforwardConfig::default();
    let on = FeedforwardConfig { mode: FeedforwardMode::VEL, ..off };
    let short = FeedforwardConfig { without_delay: true, ..on };
    assert_eq!(channel_delay_cycles([&off, &off]), 0);
    assert_eq!(channel_delay_cycles([&off, &on, &short]), 5);
    assert_eq!(channel_delay_cycles([&off, &short]), 1);
    assert_eq!(channel_delay_cycles([]), 0);
    assert_eq!(channel_delay_cycles([&on, &FeedforwardConfig { shift_cycles: 3, ..on }]), 8);
}
