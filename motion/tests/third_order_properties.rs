//! Random third-order problems with limits over six decades: always solved, target reached, limits kept, and
//! replanning on the way does not change the end.
//!
//! `KONTUR_CASES` raises the number of problems (1000000 before a release).

mod common;

use common::random::Random;
use kontur_motion::profile::{MotionState, ThirdOrderError, ThirdOrderLimits, ThirdOrderProfile};

fn cases() -> u32 {
    std::env::var("KONTUR_CASES").ok().and_then(|text| text.parse().ok()).unwrap_or(20_000)
}

fn limits(random: &mut Random) -> ThirdOrderLimits {
    let (v, a) = (random.log(1e-2, 1e4), random.log(1.0, 1e6));
    let symmetric = random.chance(0.3);
    let forwards = random.chance(0.15);
    let lower = |random: &mut Random, upper: f64| {
        if symmetric { -upper } else { -upper * random.log(0.1, 10.0) }
    };
    ThirdOrderLimits {
        v_max_mm_s: v,
        v_min_mm_s: if forwards { 0.0 } else { lower(random, v) },
        a_max_mm_s2: a,
        a_min_mm_s2: lower(random, a),
        jerk_mm_s3: random.log(1e2, 1e8),
    }
}

/// A state inside the limits that can be reached and left inside them.
fn inside(random: &mut Random, l: &ThirdOrderLimits) -> (f64, f64) {
    let v = if random.chance(0.3) { 0.0 } else { random.between(l.v_min_mm_s, l.v_max_mm_s) };
    if random.chance(0.4) {
        return (v, 0.0);
    }
    let mut a = random.between(l.a_min_mm_s2, l.a_max_mm_s2);
    for _ in 0..60 {
        let change = a * a / (2.0 * l.jerk_mm_s3);
        if v + change <= l.v_max_mm_s && v - change >= l.v_min_mm_s {
            return (v, a);
        }
        a *= 0.5;
    }
    (v, 0.0)
}

#[derive(Debug)]
struct Problem {
    start: MotionState,
    target: MotionState,
    limits: ThirdOrderLimits,
}

fn problem(random: &mut Random, at_rest: f64) -> Problem {
    let l = limits(random);
    let (mut v0, mut a0) = inside(random, &l);
    if l.v_min_mm_s < 0.0 && random.chance(0.1) {
        // outside the limits: the brake has to act; without a way back it may have no solution
        v0 = random.between(2.0 * l.v_min_mm_s, 2.0 * l.v_max_mm_s);
        // but not so far that braking alone goes through a multiple of all velocities
        let most = 2.0 * (l.jerk_mm_s3 * (l.v_max_mm_s - l.v_min_mm_s)).sqrt();
        a0 = random.between(2.0 * l.a_min_mm_s2, 2.0 * l.a_max_mm_s2).clamp(-most, most);
    }
    let (ve, ae) = if random.chance(at_rest) { (0.0, 0.0) } else { inside(random, &l) };
    // from nothing to a long cruise
    let time = (l.v_max_mm_s / l.a_max_mm_s2).max(l.a_max_mm_s2 / l.jerk_mm_s3);
    let distance = random.log(1e-6, 1e2) * l.v_max_mm_s * time;
    let p0 = random.between(-1.0, 1.0) * distance;
    let way = |v: f64, a: f64, l: &ThirdOrderLimits| {
        let from = MotionState { p_mm: 0.0, v_mm_s: v, a_mm_s2: a };
        ThirdOrderProfile::to_velocity(&from, 0.0, l)
            .map_or(0.0, |stop| stop.at(f64::INFINITY).p_mm)
    };
    let backwards =
        ThirdOrderLimits { a_max_mm_s2: -l.a_min_mm_s2, a_min_mm_s2: -l.a_max_mm_s2, ..l };
    let pe = if l.v_min_mm_s == 0.0 {
        // there is no way back: far enough to stop and start again
        let room = way(v0, a0, &l).max(0.0) + way(ve, -ae, &backwards).max(0.0);
        p0 + room * (1.0 + 1e-9) + distance
    } else if random.chance(0.5) {
        p0 + distance
    } else {
        p0 - distance
    };
    Problem {
        start: MotionState { p_mm: p0, v_mm_s: v0, a_mm_s2: a0 },
        target: MotionState { p_mm: pe, v_mm_s: ve, a_mm_s2: ae },
        limits: l,
    }
}

fn after(from: &MotionState, t: f64, j: f64) -> MotionState {
    MotionState {
        p_mm: from.p_mm + t * (from.v_mm_s + t * (from.a_mm_s2 / 2.0 + t * j / 6.0)),
        v_mm_s: from.v_mm_s + t * (from.a_mm_s2 + t * j / 2.0),
        a_mm_s2: from.a_mm_s2 + t * j,
    }
}

/// Integrates the phases: end state met and, after the brake, limits kept.
fn check(problem: &Problem, profile: &ThirdOrderProfile) -> Result<(), String> {
    let Problem { start, target, limits: l } = problem;
    let (mut now, mut t, mut travelled, mut v_peak) = (*start, 0.0, 0.0, 0.0f64);
    let mut entered = false;
    let v_size = l.v_max_mm_s.max(-l.v_min_mm_s).max(start.v_mm_s.abs());
    let v_slack = 1e-9 * v_size;
    let a_slack = 1e-9 * l.a_max_mm_s2.max(-l.a_min_mm_s2).max(start.a_mm_s2.abs());
    for (dt, j) in profile.phases() {
        if j.abs() > l.jerk_mm_s3 * (1.0 + 1e-12) {
            return Err(format!("jerk {j}"));
        }
        let mut next = after(&now, dt, j);
        if next.a_mm_s2.abs() < 1e-5 * a_slack {
            next.a_mm_s2 = 0.0;
        }
        travelled += (next.p_mm - now.p_mm).abs();
        let braking = t < profile.brake_duration() * (1.0 - 1e-12);
        v_peak = v_peak.max(now.v_mm_s.abs());
        // a brake may have to end before the velocity is inside, or it would overshoot the other limit
        entered |= !braking && now.v_mm_s <= l.v_max_mm_s && now.v_mm_s >= l.v_min_mm_s;
        let extreme = now.v_mm_s - now.a_mm_s2 * now.a_mm_s2 / (2.0 * j);
        let turns = now.a_mm_s2 * next.a_mm_s2 < 0.0;
        for v in [now.v_mm_s, next.v_mm_s, if turns { extreme } else { now.v_mm_s }] {
            if entered && (v > l.v_max_mm_s + v_slack || v < l.v_min_mm_s - v_slack) {
                return Err(format!("velocity {v} at {t}"));
            }
        }
        for a in [now.a_mm_s2, next.a_mm_s2] {
            if !braking && (a > l.a_max_mm_s2 + a_slack || a < l.a_min_mm_s2 - a_slack) {
                return Err(format!("acceleration {a} at {t}"));
            }
        }
        now = next;
        t += dt;
    }
    let near = (now.p_mm - target.p_mm).abs() <= 1e-9 * travelled + 1e-14 * v_peak * t
        && (now.v_mm_s - target.v_mm_s).abs() <= v_slack
        && (now.a_mm_s2 - target.a_mm_s2).abs() <= a_slack;
    if near { Ok(()) } else { Err(format!("ends in {now:?}")) }
}

#[test]
fn fastest_is_always_found_and_inside_limits() {
    let mut random = Random(11);
    for i in 0..cases() {
        let p = problem(&mut random, 0.3);
        ThirdOrderProfile::fastest(&p.start, &p.target, &p.limits)
            .map_err(|error| error.to_string())
            .and_then(|profile| check(&p, &profile))
            .unwrap_or_else(|error| panic!("{i}: {error}: {p:?}"));
    }
}

#[test]
fn replanning_on_the_way_keeps_the_end() {
    let mut random = Random(12);
    for i in 0..cases() {
        let p = problem(&mut random, 0.5);
        let profile = ThirdOrderProfile::fastest(&p.start, &p.target, &p.limits).unwrap();
        let total = profile.duration();
        for k in 1..5 {
            let t = total * (f64::from(k) + random.next()) / 6.0;
            let rest = ThirdOrderProfile::fastest(&profile.at(t), &p.target, &p.limits)
                .unwrap_or_else(|error| panic!("{i}: {error} at {t}: {p:?}"));
            let again = t + rest.duration();
            assert!((again - total).abs() <= 1e-9 * total, "{i}: {again} at {t}: {p:?}");
        }
    }
}

#[test]
fn given_durations_are_met() {
    let mut random = Random(13);
    let (mut found, mut blocked) = (0, 0);
    for i in 0..cases() / 4 {
        let p = problem(&mut random, 0.3);
        let shortest = ThirdOrderProfile::fastest(&p.start, &p.target, &p.limits).unwrap();
        let duration = shortest.duration() * (1.0 + random.log(1e-6, 1e2));
        match ThirdOrderProfile::with_duration(&p.start, &p.target, &p.limits, duration) {
            Ok(profile) => {
                found += 1;
                check(&p, &profile).unwrap_or_else(|error| panic!("{i}: {error}: {p:?}"));
                let got = profile.duration();
                assert!((got - duration).abs() <= 1e-12 * duration, "{i}: {got}: {p:?}");
            }
            Err(ThirdOrderError::Blocked { .. }) => {
                blocked += 1;
                // whoever ends at rest can wait there
                let Problem { target, .. } = &p;
                assert!(target.v_mm_s != 0.0 || target.a_mm_s2 != 0.0, "{i}: {duration} s: {p:?}");
            }
            Err(error) => panic!("{i}: {error}: {p:?}"),
        }
        let early = shortest.duration() * 0.999;
        let refused = ThirdOrderProfile::with_duration(&p.start, &p.target, &p.limits, early);
        assert!(matches!(refused, Err(ThirdOrderError::TooShort { .. })), "{i}: {p:?}");
    }
    assert!(blocked * 50 < found, "{blocked} of {found}");
}

#[test]
fn velocities_are_reached_with_zero_acceleration() {
    let mut random = Random(14);
    for i in 0..cases() {
        let mut p = problem(&mut random, 0.0);
        let v = random.between(p.limits.v_min_mm_s, p.limits.v_max_mm_s);
        let profile = ThirdOrderProfile::to_velocity(&p.start, v, &p.limits).unwrap();
        let end = profile.at(profile.duration());
        assert!(
            (end.v_mm_s - v).abs() < f64::MIN_POSITIVE && end.a_mm_s2.abs() < f64::MIN_POSITIVE
        );
        // velocity limits do not apply here
        p.target = end;
        p.limits.v_max_mm_s = 1e12;
        p.limits.v_min_mm_s = -1e12;
        check(&p, &profile).unwrap_or_else(|error| panic!("{i}: {error}: {p:?}"));
        // one bump of acceleration is the fastest: replanning half way ends at the same time
        let half = 0.5 * profile.duration();
        let rest = ThirdOrderProfile::to_velocity(&profile.at(half), v, &p.limits).unwrap();
        let again = half + rest.duration();
        // a rounding of the velocity on the last ramp takes a correction of its own
        let size = p.start.v_mm_s.abs().max(v.abs());
        let correction = (f64::EPSILON * size / p.limits.jerk_mm_s3).sqrt();
        let slack = 1e-9 * profile.duration() + 10.0 * correction;
        assert!((again - profile.duration()).abs() <= slack, "{i}: {again}: {p:?} {profile:?}");
    }
}

#[test]
fn feedhold_from_constant_velocity() {
    let limits = ThirdOrderLimits {
        v_max_mm_s: 100.0,
        v_min_mm_s: 0.0,
        a_max_mm_s2: 1000.0,
        a_min_mm_s2: -1000.0,
        jerk_mm_s3: 20_000.0,
    };
    let start = MotionState { p_mm: 3.0, v_mm_s: 100.0, a_mm_s2: 0.0 };
    let stop = ThirdOrderProfile::to_velocity(&start, 0.0, &limits).unwrap();
    // 100 mm/s at 1000 mm/s2 plus one ramp of 50 ms; half the speed on average
    assert!((stop.duration() - 0.15).abs() < 1e-15);
    assert!((stop.at(1.0).p_mm - 10.5).abs() < 1e-13);
    // while still accelerating: the ramp down to zero adds 25 mm/s in 50 ms
    let start = MotionState { p_mm: 0.0, v_mm_s: 50.0, a_mm_s2: 1000.0 };
    let stop = ThirdOrderProfile::to_velocity(&start, 0.0, &limits).unwrap();
    let end = stop.duration();
    assert!((end - (0.05 + 0.075 + 0.05)).abs() < 1e-15, "{end}");
    let (low, high) = stop.velocity_range();
    assert!(low.abs() < 1e-12 && (high - 75.0).abs() < 1e-12);
}

#[test]
fn senseless_requests_are_refused() {
    let limits = ThirdOrderLimits {
        v_max_mm_s: 10.0,
        v_min_mm_s: -10.0,
        a_max_mm_s2: 100.0,
        a_min_mm_s2: -100.0,
        jerk_mm_s3: 1000.0,
    };
    let rest = MotionState::default();
    let state = |v_mm_s, a_mm_s2| MotionState { p_mm: 1.0, v_mm_s, a_mm_s2 };
    let fastest = |to: &MotionState, l: &ThirdOrderLimits| ThirdOrderProfile::fastest(&rest, to, l);
    assert_eq!(fastest(&state(11.0, 0.0), &limits), Err(ThirdOrderError::Target));
    // decelerating at the limit: faster than allowed just before
    assert_eq!(fastest(&state(10.0, -50.0), &limits), Err(ThirdOrderError::Target));
    assert!(fastest(&state(10.0, 50.0), &limits).is_ok());
    assert_eq!(fastest(&state(f64::NAN, 0.0), &limits), Err(ThirdOrderError::State));
    let wrong = ThirdOrderLimits { jerk_mm_s3: 0.0, ..limits };
    assert_eq!(fastest(&rest, &wrong), Err(ThirdOrderError::Limits));
    let still = fastest(&rest, &limits).unwrap();
    assert!(still.duration() <= 0.0);
    let wait = ThirdOrderProfile::with_duration(&rest, &rest, &limits, 2.0).unwrap();
    assert!((wait.duration() - 2.0).abs() < 1e-15);
    let nan = ThirdOrderProfile::with_duration(&rest, &state(0.0, 0.0), &limits, f64::NAN);
    assert!(matches!(nan, Err(ThirdOrderError::TooShort { .. })));
}
