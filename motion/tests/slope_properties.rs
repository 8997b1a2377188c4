//! Properties of the slopes for random input at extreme ratios, and an independent numerical integration.

use kontur_kit::Random;
use kontur_motion::profile::{Profile, RampShape, RampedLimits, SlopeLimits, StepAxis, StepLimits};

const CASES: u32 = 20_000;

/// Ramp time in s, sometimes 0.
fn ramp_s(random: &mut Random) -> f64 {
    if random.chance(0.15) { 0.0 } else { random.log(1e-6, 1.0) }
}

/// Limits with the largest acceleration and deceleration they allow.
struct Case {
    limits: SlopeLimits,
    acc: f64,
    dec: f64,
    ramped: bool,
}

fn case(random: &mut Random) -> Case {
    let (acc, dec) = (random.log(1.0, 1e6), random.log(1.0, 1e6));
    if random.chance(0.25) {
        let mut axes = Vec::new();
        for _ in 0..1 + u8::from(random.chance(0.5)) + 2 * u8::from(random.chance(0.5)) {
            axes.push(StepAxis {
                acc_mm_s2: [acc, random.log(1.0, 1e6)],
                dec_mm_s2: [dec, random.log(1.0, 1e6)],
                change_mm_s: random.log(1e-2, 1e4),
            });
        }
        let largest = |f: fn(&StepAxis) -> [f64; 2]| axes.iter().flat_map(f).fold(0.0, f64::max);
        let (acc, dec) = (largest(|x| x.acc_mm_s2), largest(|x| x.dec_mm_s2));
        let limits = SlopeLimits::Step(StepLimits::from_axes(&axes));
        return Case { limits, acc, dec, ramped: false };
    }
    let equal = ramp_s(random);
    let ramps = if random.chance(0.3) {
        [equal; 4]
    } else {
        [ramp_s(random), ramp_s(random), ramp_s(random), ramp_s(random)]
    };
    let shape = if random.chance(0.5) { RampShape::Trapez } else { RampShape::Sin2 };
    let limits = RampedLimits::new(shape, random.chance(0.3), acc, dec, ramps);
    Case { limits: SlopeLimits::Ramped(limits), acc, dec, ramped: true }
}

fn velocity(random: &mut Random) -> f64 {
    if random.chance(0.2) { 0.0 } else { random.log(1e-3, 1e4) }
}

fn check(case: &Case, profile: &Profile, [v0, ve, vf, length]: [f64; 4]) {
    let what = || format!("{:?} v0 {v0} ve {ve} vf {vf} length {length}: {profile:?}", case.limits);
    let duration = profile.duration();
    assert!(duration.is_finite() && duration >= 0.0, "{}", what());
    assert!(profile.phases().all(|p| p.0 >= 0.0), "{}", what());
    let total: f64 = profile.phases().map(|p| p.0).sum();
    assert!((total - duration).abs() <= 1e-14 * duration, "{}", what());

    let top = vf.max(v0).max(ve);
    let (start, end) = (profile.at(0.0), profile.at(duration));
    assert!(start.s_mm.abs() <= 1e-12 * length, "{}", what());
    assert!((end.s_mm - length).abs() <= 1e-12 * length, "{}", what());
    assert!((start.v_mm_s - v0).abs() <= 1e-13 * top, "{}", what());
    assert!((end.v_mm_s - ve).abs() <= 1e-13 * top, "{}", what());
    assert!(profile.peak() <= top * (1.0 + 1e-15), "{}", what());
    assert!(profile.peak() >= v0.max(ve), "{}", what());

    let mut before = start;
    let samples = 40;
    for i in 1..=samples {
        let t = duration * f64::from(i) / f64::from(samples);
        let now = profile.at(t);
        assert!(now.v_mm_s >= 0.0 && now.v_mm_s <= top * (1.0 + 1e-14), "{} at {t}", what());
        assert!(now.s_mm >= before.s_mm, "{} at {t}", what());
        assert!(now.a_mm_s2 <= case.acc * (1.0 + 2e-9), "{} at {t}", what());
        assert!(now.a_mm_s2 >= -case.dec * (1.0 + 2e-9), "{} at {t}", what());
        // distance between samples lies between those of the extreme velocities
        let ds = now.s_mm - before.s_mm;
        let dt = duration / f64::from(samples);
        assert!(ds <= dt * profile.peak() * (1.0 + 1e-9) + 1e-14 * length, "{} at {t}", what());
        let back = profile.at(profile.time_at(now.s_mm));
        assert!((back.s_mm - now.s_mm).abs() <= 1e-12 * length, "{} at {t}", what());
        before = now;
    }
}

#[test]
fn feasible_plans_end_where_and_how_they_should() {
    let mut random = Random::from_state(1);
    let (mut planned, mut refused) = (0, 0);
    for _ in 0..CASES {
        let case = case(&mut random);
        let length = random.log(1e-6, 1e4);
        let v0 = velocity(&mut random);
        let ve = if random.chance(0.1) { v0 } else { velocity(&mut random) };
        let vf = v0.max(ve).max(random.log(1e-3, 1e4));
        let needed =
            case.limits.up_distance(v0, v0.max(ve)) + case.limits.down_distance(v0, v0.min(ve));
        match case.limits.plan(v0, ve, vf, length) {
            Ok(profile) => {
                planned += 1;
                assert!(needed <= length * (1.0 + 1e-8));
                check(&case, &profile, [v0, ve, vf, length]);
            }
            Err(error) => {
                refused += 1;
                assert!(needed > length && (error.needed_mm - needed).abs() <= 1e-9 * needed);
            }
        }
    }
    assert!(planned > CASES / 4 && refused > CASES / 10, "{planned} {refused}");
}

#[test]
fn reachable_velocities_are_feasible_and_largest() {
    let mut random = Random::from_state(2);
    for _ in 0..CASES {
        let case = case(&mut random);
        let length = random.log(1e-6, 1e4);
        let v = velocity(&mut random);
        let up = case.limits.reach_up(v, length);
        let down = case.limits.reach_down(v, length);
        let what = || format!("{:?} v {v} length {length} up {up} down {down}", case.limits);
        assert!(up >= v && down >= v && up.is_finite() && down.is_finite(), "{}", what());
        let faster = |w: f64| (w * (1.0 + 1e-12)).next_up();
        assert!(case.limits.up_distance(v, faster(up)) >= length * (1.0 - 1e-11), "{}", what());
        assert!(case.limits.down_distance(faster(down), v) >= length * (1.0 - 1e-11), "{}", what());
        if up > 0.0 {
            check(&case, &case.limits.plan(v, up, up, length).unwrap(), [v, up, up, length]);
        }
        if down > 0.0 {
            check(
                &case,
                &case.limits.plan(down, v, down, length).unwrap(),
                [down, v, down, length],
            );
        }
    }
}

#[test]
fn distances_grow_with_the_peak_and_reach_with_the_length() {
    let mut random = Random::from_state(3);
    for _ in 0..CASES {
        let case = case(&mut random);
        let v0 = velocity(&mut random);
        let v1 = v0 + random.log(1e-3, 1e4);
        let v2 = v1 * (1.0 + random.log(1e-9, 1.0));
        let l = &case.limits;
        assert!(l.up_distance(v0, v1) < l.up_distance(v0, v2));
        assert!(l.down_distance(v1, v0) < l.down_distance(v2, v0));
        // equal with constant ramp time below the plateau
        assert!(l.up_time(v0, v1) <= l.up_time(v0, v2));
        assert!(l.down_time(v1, v0) <= l.down_time(v2, v0));
        assert!(!case.ramped || l.up_distance(v0, v0).abs() < f64::MIN_POSITIVE);
        let length = random.log(1e-6, 1e4);
        let longer = length * (1.0 + random.log(1e-9, 1.0));
        assert!(l.reach_up(v0, length) <= l.reach_up(v0, longer));
        assert!(l.reach_down(v0, length) <= l.reach_down(v0, longer));
    }
}

#[test]
fn braking_to_a_crawl_can_take_longer_than_braking_to_rest() {
    // 1000 mm/s2, 50 ms: from 100 mm/s to 0 in 7.5 mm; to 20 mm/s in 4.8 mm plus both ramps' share 3 mm
    let limits =
        SlopeLimits::Ramped(RampedLimits::new(RampShape::Trapez, false, 1e3, 1e3, [0.05; 4]));
    assert!((limits.down_distance(100.0, 0.0) - 7.5).abs() < 1e-12);
    assert!((limits.down_distance(100.0, 20.0) - 7.8).abs() < 1e-12);
    assert!(limits.reach_down(20.0, 7.5) < 100.0);
    assert!((limits.reach_down(0.0, 7.5) - 100.0).abs() < 1e-12);
}

/// Acceleration by the definition of the ramps, from segment durations and plateaus alone.
fn acceleration(shape: RampShape, segments: &[f64], up: f64, down: f64, mut t: f64) -> f64 {
    let rise = |x: f64| match shape {
        RampShape::Trapez => x,
        RampShape::Sin2 => {
            let sin = libm::sin(0.5 * std::f64::consts::PI * x);
            sin * sin
        }
    };
    for (i, duration) in segments.iter().enumerate() {
        if t < *duration {
            let x = t / duration;
            return match i {
                0 => up * rise(x),
                1 => up,
                2 => up * rise(1.0 - x),
                3 => 0.0,
                4 => -down * rise(x),
                5 => -down,
                _ => -down * rise(1.0 - x),
            };
        }
        t -= duration;
    }
    0.0
}

#[test]
fn states_agree_with_numerical_integration() {
    let mut random = Random::from_state(4);
    let mut integrated = 0;
    for _ in 0..60 {
        let shape = if random.chance(0.5) { RampShape::Trapez } else { RampShape::Sin2 };
        let constant = random.chance(0.4);
        let (acc, dec) = (random.log(300.0, 3000.0), random.log(300.0, 3000.0));
        let mut ramp = || random.log(0.01, 0.1);
        let ramps = [ramp(), ramp(), ramp(), ramp()];
        let limits = SlopeLimits::Ramped(RampedLimits::new(shape, constant, acc, dec, ramps));
        let (v0, ve) = (random.ratio() * 30.0, random.ratio() * 30.0);
        let length = random.log(0.5, 50.0);
        // too short to get from one speed to the other
        let Ok(profile) = limits.plan(v0, ve, 120.0, length) else { continue };
        integrated += 1;
        let segments: Vec<f64> = profile.phases().map(|p| p.0).collect();
        // the plateau follows from the gain of velocity and the segment times
        let plateau = |gain: f64, t: &[f64]| {
            let time = 0.5 * (t[0] + t[2]) + t[1];
            if time > 0.0 { gain / time } else { 0.0 }
        };
        let up = plateau(profile.peak() - v0, &segments[0..3]);
        let down = plateau(profile.peak() - ve, &segments[4..7]);
        assert!(up <= acc * (1.0 + 1e-12) && down <= dec * (1.0 + 1e-12));

        let steps = 200_000;
        let dt = profile.duration() / f64::from(steps);
        let (mut s, mut v) = (0.0, v0);
        for i in 0..steps {
            let a = acceleration(shape, &segments, up, down, (f64::from(i) + 0.5) * dt);
            s += dt * (v + 0.5 * a * dt);
            v += a * dt;
            if i % 2000 == 1999 {
                let state = profile.at(f64::from(i + 1) * dt);
                assert!((state.s_mm - s).abs() < 1e-7, "{profile:?} {s} {state:?}");
                assert!((state.v_mm_s - v).abs() < 1e-5, "{profile:?} {v} {state:?}");
            }
        }
        assert!((s - length).abs() < 1e-7 && (v - ve).abs() < 1e-5);
    }
    assert!(integrated > 30, "{integrated} of 60");
}

#[test]
fn equal_ramps_give_sin2_the_times_of_trapez() {
    let mut random = Random::from_state(5);
    let mut compared = 0;
    for _ in 0..2000 {
        let (acc, dec) = (random.log(10.0, 1e5), random.log(10.0, 1e5));
        let (t, u) = (ramp_s(&mut random), ramp_s(&mut random));
        let constant = random.chance(0.3);
        let make =
            |shape| SlopeLimits::Ramped(RampedLimits::new(shape, constant, acc, dec, [t, t, u, u]));
        let (trapez, sin2) = (make(RampShape::Trapez), make(RampShape::Sin2));
        let (v0, ve) = (velocity(&mut random), velocity(&mut random));
        let length = random.log(1e-3, 1e3);
        let (Ok(a), Ok(b)) = (trapez.plan(v0, ve, 1e4, length), sin2.plan(v0, ve, 1e4, length))
        else {
            continue;
        };
        compared += 1;
        assert!((a.peak() - b.peak()).abs() <= 1e-12 * a.peak());
        assert!((a.duration() - b.duration()).abs() <= 1e-12 * a.duration());
        for (x, y) in a.phases().zip(b.phases()) {
            assert!((x.0 - y.0).abs() <= 1e-11 * a.duration(), "{a:?} {b:?}");
        }
    }
    assert!(compared > 200, "{compared} of 2000");
}

#[test]
fn nothing_to_do_and_nothing_allowed() {
    let limits =
        SlopeLimits::Ramped(RampedLimits::new(RampShape::Trapez, false, 1e3, 1e3, [0.05; 4]));
    let empty = limits.plan(10.0, 10.0, 50.0, 0.0).unwrap();
    assert!(empty.duration().abs() < f64::MIN_POSITIVE);
    assert!(limits.plan(0.0, 0.0, 0.0, 1.0).unwrap_err().needed_mm.is_infinite());
    assert!(limits.plan(10.0, 0.0, 50.0, 0.0).is_err());
    assert!(limits.plan(f64::NAN, 0.0, 50.0, 1.0).is_err());
    assert!(limits.plan(0.0, 0.0, 50.0, f64::NAN).is_err());
}

/// The feed from end to end: uniform motion, s = v t, also in its parts.
#[test]
fn a_speed_that_stays_is_uniform_motion() {
    let mut random = Random::new(29);
    for _ in 0..CASES {
        let case = case(&mut random);
        let (v, length) = (random.log(1e-3, 1e4), random.log(1e-6, 1e4));
        let slower = v * random.ratio();
        let profile = case.limits.plan(v, v, slower, length).unwrap();
        let what = || format!("{:?} v {v} length {length}: {profile:?}", case.limits);
        assert!(
            (profile.duration() - length / v).abs() <= 1e-15 * profile.duration(),
            "{}",
            what()
        );
        assert!((profile.peak() - v).abs() <= 0.0, "{}", what());
        for _ in 0..4 {
            let t = random.ratio() * profile.duration();
            let state = profile.at(t);
            assert!((state.s_mm - v * t).abs() <= 1e-15 * length, "{}", what());
            assert!((state.v_mm_s - v).abs() <= 0.0, "{}", what());
            assert!(state.a_mm_s2.abs() + state.j_mm_s3.abs() <= 0.0, "{}", what());
            assert!((profile.time_at(v * t) - t).abs() <= 4e-15 * profile.duration(), "{}", what());
        }
        let ends = [profile.at(-1.0), profile.at(2.0 * profile.duration())].map(|s| s.s_mm);
        assert!((ends[0]).abs() <= 0.0 && (ends[1] - length).abs() <= 0.0, "{}", what());
    }
}
