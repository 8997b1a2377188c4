//! Random third-order problems with limits over six decades: always solved, target reached, limits kept, and replanning
//! on the way does not change the end.
//!
//! `KONTUR_CASES` raises the number of problems (1000000 before a release).

use kontur_kit::{Random, environment};
use kontur_motion::profile::{MotionState, ThirdOrderError, ThirdOrderLimits};

fn cases() -> u64 {
    environment("KONTUR_CASES", 20_000)
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
        // outside the limits: the brake has to act; if reversing is forbidden there may be no solution
        v0 = random.between(2.0 * l.v_min_mm_s, 2.0 * l.v_max_mm_s);
        // but close enough that braking alone does not pass through a multiple of all velocities
        let most = 2.0 * (l.jerk_mm_s3 * (l.v_max_mm_s - l.v_min_mm_s)).sqrt();
        a0 = random.between(2.0 * l.a_min_mm_s2, 2.0 * l.a_max_mm_s2).clamp(-most, most);
    }
    let (ve, ae) = if random.chance(at_rest) { (0.0, 0.0) } else { inside(random, &l) };
    // from nothing to a long cruise
    let time = (l.v_max_mm_s / l.a_max_mm_s2).max(l.a_max_mm_s2 / l.jerk_mm_s3);
    let distance = random.log(1e-6, 1e2) * l.v_max_mm_s * time;
    let p0 = random.between(-1.0, 1.0) * distance;
    let way = |v: f64, a: f64, l: &ThirdOrderLimits| stop(v, a, l);
    let backwards =
        ThirdOrderLimits { a_max_mm_s2: -l.a_min_mm_s2, a_min_mm_s2: -l.a_max_mm_s2, ..l };
    let pe = if l.v_min_mm_s == 0.0 {
        // reversing is forbidden: far enough to stop and start again
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

/// Length in which the motion comes to rest as soon as the acceleration and the jerk allow it.
fn stop(v: f64, a: f64, l: &ThirdOrderLimits) -> f64 {
    let jerk = l.jerk_mm_s3;
    let settled = v + a * a.abs() / (2.0 * jerk);
    let sign = if settled > 0.0 { -1.0 } else { 1.0 };
    let limit = if sign > 0.0 { l.a_max_mm_s2 } else { -l.a_min_mm_s2 };
    // with the sign of the change: acceleration up to a peak, constant, and down to zero
    let (gain, a0) = (-sign * v, sign * a);
    let peak = (gain + a0 * a0 / (2.0 * jerk)).max(0.0) * jerk;
    let peak = peak.sqrt().min(limit);
    let hold = (gain + a0 * a0 / (2.0 * jerk) - peak * peak / jerk).max(0.0) / peak.max(1e-300);
    let mut now = MotionState { p_mm: 0.0, v_mm_s: v, a_mm_s2: a };
    for (t, j) in [((peak - a0) / jerk, jerk), (hold, 0.0), (peak / jerk, -jerk)] {
        now = after(&now, t, sign * j);
    }
    now.p_mm
}

fn after(from: &MotionState, t: f64, j: f64) -> MotionState {
    MotionState {
        p_mm: from.p_mm + t * (from.v_mm_s + t * (from.a_mm_s2 / 2.0 + t * j / 6.0)),
        v_mm_s: from.v_mm_s + t * (from.a_mm_s2 + t * j / 2.0),
        a_mm_s2: from.a_mm_s2 + t * j,
    }
}

fn duration(phases: &[(f64, f64)]) -> f64 {
    phases.iter().map(|p| p.0).sum()
}

/// State at a time.
fn at(from: &MotionState, phases: &[(f64, f64)], mut t: f64) -> MotionState {
    let mut now = *from;
    let largest = from.a_mm_s2.abs();
    for &(dt, j) in phases {
        if t < dt {
            return after(&now, t, j);
        }
        now = after(&now, dt, j);
        // the residue of a ramp to zero is rounding, and would add up over a long cruise
        if now.a_mm_s2.abs() <= 1e-14 * largest.max(j.abs() * dt) {
            now.a_mm_s2 = 0.0;
        }
        t -= dt;
    }
    now
}

/// Integrates the phases: end state met and, after the brake, limits kept.
fn check(problem: &Problem, phases: &[(f64, f64)]) -> Result<(), String> {
    let Problem { start, target, limits: l } = problem;
    let (mut now, mut t, mut travelled, mut v_peak) = (*start, 0.0, 0.0, 0.0f64);
    // the brake: phases that begin with a state outside
    let mut braking = true;
    let mut entered = false;
    let v_size = l.v_max_mm_s.max(-l.v_min_mm_s).max(start.v_mm_s.abs());
    let v_slack = 1e-9 * v_size;
    let a_slack = 1e-9 * l.a_max_mm_s2.max(-l.a_min_mm_s2).max(start.a_mm_s2.abs());
    for &(dt, j) in phases {
        if j.abs() > l.jerk_mm_s3 * (1.0 + 1e-12) {
            return Err(format!("jerk {j}"));
        }
        let mut next = after(&now, dt, j);
        if next.a_mm_s2.abs() < 1e-5 * a_slack {
            next.a_mm_s2 = 0.0;
        }
        travelled += (next.p_mm - now.p_mm).abs();
        let settled = now.v_mm_s + now.a_mm_s2 * now.a_mm_s2.abs() / (2.0 * l.jerk_mm_s3);
        let inside = |v: f64| v <= l.v_max_mm_s + v_slack && v >= l.v_min_mm_s - v_slack;
        let outside =
            now.a_mm_s2 > l.a_max_mm_s2 + a_slack || now.a_mm_s2 < l.a_min_mm_s2 - a_slack;
        braking &= outside || !inside(now.v_mm_s) || !inside(settled);
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
    let mut random = Random::from_state(11);
    for i in 0..cases() {
        let p = problem(&mut random, 0.3);
        p.limits
            .fastest(&p.start, &p.target)
            .map_err(|error| error.to_string())
            .and_then(|phases| check(&p, &phases))
            .unwrap_or_else(|error| panic!("{i}: {error}: {p:?}"));
    }
}

#[test]
fn replanning_on_the_way_keeps_the_end() {
    let mut random = Random::from_state(12);
    for i in 0..cases() {
        let p = problem(&mut random, 0.5);
        let phases = p.limits.fastest(&p.start, &p.target).unwrap();
        let total = duration(&phases);
        for k in 1..5 {
            let t = total * (f64::from(k) + random.ratio()) / 6.0;
            let rest = p
                .limits
                .fastest(&at(&p.start, &phases, t), &p.target)
                .unwrap_or_else(|error| panic!("{i}: {error} at {t}: {p:?}"));
            let again = t + duration(&rest);
            assert!((again - total).abs() <= 1e-9 * total, "{i}: {again} at {t}: {p:?}");
        }
    }
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
    let fastest = |to: &MotionState, l: &ThirdOrderLimits| l.fastest(&rest, to);
    assert_eq!(fastest(&state(11.0, 0.0), &limits), Err(ThirdOrderError::Target));
    // decelerating at the limit: faster than allowed just before
    assert_eq!(fastest(&state(10.0, -50.0), &limits), Err(ThirdOrderError::Target));
    assert!(fastest(&state(10.0, 50.0), &limits).is_ok());
    assert_eq!(fastest(&state(f64::NAN, 0.0), &limits), Err(ThirdOrderError::State));
    let wrong = ThirdOrderLimits { jerk_mm_s3: 0.0, ..limits };
    assert_eq!(fastest(&rest, &wrong), Err(ThirdOrderError::Limits));
    assert!(fastest(&rest, &limits).unwrap().is_empty());
}
