//! Override and feedhold: closed forms, and properties over random programs with events at random cycles.

#![expect(clippy::float_cmp, reason = "exact values are meant")]

mod random;

use crate::common::events::{Event, drive};
use crate::common::{Job, arc, axis, channel, deviation};
use kontur_filters::time::CycleTime;
use kontur_kit::{Random, environment};
use kontur_motion::block::SlopeKind::{Hsc, Sin2, Step, Trapez};
use kontur_motion::block::{Feed, SlopeKind};
use kontur_motion::planner::{Planner, Setpoint};
use kontur_motion::profile::Infeasible;
use kontur_motion::realtime::FeedholdBraking;

use FeedholdBraking::{Active, Own};
use random::Case;

/// One straight line of 100 mm at 100 mm/s.
fn straight(job: &Job, events: &[(u64, Event)]) -> Vec<Setpoint> {
    drive(job, &[0.0, 0.0], vec![job.line(0, &[0.0, 0.0], &[100.0, 0.0], 100.0)], events).unwrap()
}

/// Way in mm from `v` and the deceleration `d` to `target` with zero acceleration, at 1000 mm/s2 with ramps of 50 ms;
/// infinite where reducing the deceleration at once already leads below.
fn braking_way(v: f64, d: f64, target: f64) -> f64 {
    const D: f64 = 1000.0;
    const J: f64 = D / 0.05;
    let fall = v - target;
    let peak = (J * fall + 0.5 * d * d).sqrt().min(D);
    if peak < d {
        return f64::INFINITY;
    }
    let plateau = fall - (peak * peak - d * d) / (2.0 * J) - peak * peak / (2.0 * J);
    let phases = [((peak - d) / J, J), (plateau / peak, 0.0), (peak / J, -J)];
    let (mut s, mut v, mut d) = (0.0, v, d);
    for (t, j) in phases {
        s += v * t - d * t * t / 2.0 - j * t * t * t / 6.0;
        v -= d * t + j * t * t / 2.0;
        d += j * t;
    }
    s
}

/// A line of 30 mm that ends with E 20 mm/s, braked from 100, and an override in any cycle of the braking: the end is
/// passed with at most the larger one of both E speeds, and with TRAPEZ exactly with a higher one where the way is long
/// enough for it.
#[test]
fn an_override_while_the_path_brakes_to_an_end_velocity() {
    const E: f64 = 20.0;
    for kind in [Step, Trapez, Sin2, Hsc] {
        let job = Job::new(0.0, kind);
        let run = |events: &[(u64, Event)]| {
            let points = [[0.0, 0.0], [30.0, 0.0], [60.0, 0.0]];
            let lines = points.windows(2).zip(0..);
            let mut blocks: Vec<_> =
                lines.map(|(ends, i)| job.line(i, &ends[0], &ends[1], 100.0)).collect();
            blocks[0].end_velocity_mm_s = Some(E);
            drive(&job, &[0.0, 0.0], blocks, events).unwrap()
        };
        let at_end = |out: &[Setpoint]| {
            let i = out.iter().position(|p| p.position[0] >= 30.0).unwrap();
            out[i - 1].v_mm_s.min(out[i].v_mm_s)
        };
        // within one cycle of full acceleration
        let slack = 1.0;
        let free = run(&[]);
        assert!((at_end(&free) - E).abs() <= slack, "{kind:?} {}", at_end(&free));
        let brakes = |k: &usize| free[*k].position[0] < 29.99 && free[*k].a_mm_s2 < 0.0;
        let mut reached = 0;
        for k in (1..free.len()).filter(brakes).step_by(3) {
            for ratio in [2.0, 1.5, 0.9, 0.5, 0.1] {
                let out = run(&[(k as u64, Event::Override(ratio))]);
                let v = at_end(&out);
                assert!(v <= E * f64::max(ratio, 1.0) + slack, "{kind:?} {k} {ratio}: {v}");
                let now = &free[k];
                let way = braking_way(now.v_mm_s, -now.a_mm_s2, E * ratio);
                if kind == Trapez && ratio > 1.0 && way < 30.0 - now.position[0] {
                    reached += 1;
                    assert!((v - E * ratio).abs() <= slack, "{k} {ratio}: {v}");
                }
            }
        }
        assert!(kind != Trapez || reached > 20, "{reached}");
    }
}

/// Braking from 100 mm/s: `v^2 / 2a + v t / 2`.
#[test]
fn feedhold_distances() {
    for (kind, braking, distance, time) in [
        (Step, Active, 5.0, 0.1),
        (Trapez, Active, 7.5, 0.15),
        (Sin2, Active, 7.5, 0.15),
        (Step, Own, 2.5, 0.05),
        (Trapez, Own, 3.5, 0.07),
    ] {
        let events = [(500, Event::Hold(braking)), (1000, Event::Release)];
        let out = straight(&Job::new(0.0, kind), &events);
        let stop = 500 + (time / 1e-3_f64).round() as usize;
        let at = out[500].position[0] + distance;
        assert!(out[stop - 2].v_mm_s > 0.0);
        for p in &out[stop..=1000] {
            assert!((p.position[0] - at).abs() < 1e-9, "{kind:?} {braking:?} {}", p.position[0]);
            assert_eq!(p.v_mm_s, 0.0);
            assert_eq!(p.limit.name(), "stop");
        }
        assert!(out[1001].v_mm_s > 0.0);
        assert_eq!(out.last().unwrap().position[0], 100.0);
    }
}

/// At 25 ms of the first ramp: a = 500, v = 6.25. Acceleration falls in 25 ms, v = 12.5; a quarter of the least change
/// that reaches the plateau takes half its ramps: rest at 25 + 25 + 50 ms.
#[test]
fn feedhold_while_accelerating() {
    let out = straight(&Job::new(0.0, Trapez), &[(25, Event::Hold(Active)), (300, Event::Release)]);
    assert!((out[50].v_mm_s - 12.5).abs() < 1e-9);
    assert!(out[50].a_mm_s2.abs() < 1e-6);
    assert!(out[98].v_mm_s > 0.0);
    assert_eq!(out[100].v_mm_s, 0.0);
}

/// An override knob turned in small steps does not reduce the acceleration: 0.15 s to 100 mm/s in spite of a change
/// every 10 ms, and the same back down.
#[test]
fn turning_the_knob_while_accelerating() {
    let mut events: Vec<_> = (0..=10_u32)
        .map(|i| (u64::from(i) * 10, Event::Override(0.5 + 0.05 * f64::from(i))))
        .collect();
    events.extend(
        (0..=10_u32).map(|i| (500 + u64::from(i) * 10, Event::Override(1.0 - 0.09 * f64::from(i)))),
    );
    let out = straight(&Job::new(0.0, Trapez), &events);
    let reached = out.iter().position(|p| p.v_mm_s > 99.999).unwrap();
    assert!(reached <= 260, "{reached}");
    let down = out.iter().skip(500).find(|p| p.v_mm_s < 10.001).unwrap().k;
    assert!(down <= 720, "{down}");
}

/// Rapid 0 % stops at the end of the feed block before a rapid one, not before.
#[test]
fn rapid_override_zero_waits_in_front_of_the_rapid_block() {
    let job = Job::new(0.0, Trapez);
    let mut blocks = vec![
        job.line(0, &[0.0, 0.0], &[20.0, 0.0], 50.0),
        job.line(1, &[20.0, 0.0], &[60.0, 0.0], 50.0),
    ];
    blocks[1].feed = Feed::Rapid;
    let events = [(5, Event::Rapid(1.0, 0.0)), (2000, Event::Rapid(1.0, 1.0))];
    let out = drive(&job, &[0.0, 0.0], blocks, &events).unwrap();
    assert!(out[1000..=2000].iter().all(|p| p.position[0] == 20.0 && p.v_mm_s == 0.0));
    assert_eq!(out.last().unwrap().position[0], 60.0);
}

/// A circle of 10 mm in chords of 0.05 mm, entered into the queue at 5 % and driven at 200 %: two of its kinks fall into
/// one cycle then, and `v^2 / r <= a` holds as for the circle (100 mm/s; a kink alone would allow 200 mm/s).
#[test]
fn fast_override_over_short_blocks_that_were_read_at_a_slow_one() {
    for kind in [Step, Hsc] {
        let job = Job { window: 1300, ..Job::new(1.0, kind) };
        let at = |k: u32| {
            let (sin, cos) = libm::sincos(0.005 * f64::from(k));
            [10.0 * cos, 10.0 * sin]
        };
        let blocks = (0..1200).map(|k| job.line(u64::from(k), &at(k), &at(k + 1), 80.0)).collect();
        let events = [(0, Event::Override(0.05)), (200, Event::Override(2.0))];
        let out = drive(&job, &at(0), blocks, &events).unwrap();
        let fastest = out.iter().map(|p| p.v_mm_s).fold(0.0, f64::max);
        // up and down again within a chord in any direction: v^2 = 100^2 + sqrt(2) 1000 * 0.05
        assert!((99.0..=100.36).contains(&fastest), "{kind:?}: {fastest}");
        assert_eq!(out.last().unwrap().position[..], at(1200));
    }
}

/// Setting the present value again changes no bit.
#[test]
fn override_of_100_percent_again_changes_nothing() {
    for seed in 0..50 {
        let mut c = Case::new(&mut Random::from_state(seed));
        c.events.clear();
        let plain = c.run().unwrap();
        c.events = (0..50).map(|i| (i * 7, Event::Override(1.0))).collect();
        let again = c.run().unwrap();
        assert_eq!(plain.len(), again.len());
        for (a, b) in plain.iter().zip(&again) {
            assert_eq!(a.position, b.position);
            assert_eq!(
                (a.v_mm_s, a.a_mm_s2, a.s_mm, a.limit),
                (b.v_mm_s, b.a_mm_s2, b.s_mm, b.limit)
            );
        }
    }
}

/// Programs without inputs, with small look-ahead windows in which new blocks require a very low speed.
#[test]
fn random_programs_without_events() {
    let mut failed = Vec::new();
    for case in 100..400 {
        for window in [3, 10] {
            let mut c = Case::new(&mut Random::from_state(case * 7919 + 1));
            c.events.clear();
            c.job.window = window;
            let verdict = c.run().map_err(|e| e.to_string()).and_then(|out| c.check(&out));
            if let Err(why) = verdict {
                failed.push(format!("case {case}, window {window}: {why}"));
            }
        }
    }
    assert!(failed.is_empty(), "{failed:#?}");
}

/// A feedhold at any time of the motion is at rest within the braking time from the feed: 0.15 s, and what is left of
/// the ramp down to zero acceleration.
#[test]
fn feedhold_is_prompt_at_any_time() {
    for kind in [Step, Trapez, Sin2, Hsc] {
        for at in (1..1099_u64).step_by(3) {
            let out = straight(
                &Job::new(0.0, kind),
                &[(at, Event::Hold(Active)), (at + 600, Event::Release)],
            );
            let rest = out.iter().find(|p| p.k > at && p.v_mm_s == 0.0).unwrap().k;
            assert!(rest - at <= 250, "{kind:?} {at}: {rest}");
            let end = out.last().unwrap();
            assert_eq!(end.position[0], 100.0, "{kind:?} {at}");
        }
    }
}

/// A line too short for its feed rate, 100 mm/s over a length on which the closed form of the slope reaches less: while
/// it accelerates, the override changes to values without influence on the speed, and later back. The motion is the
/// same as without any change.
#[test]
fn an_override_that_does_not_bind_changes_nothing() {
    for kind in [Trapez, Hsc] {
        let job = Job::new(0.0, kind);
        let drive = |events: &[(u64, Event)]| {
            let block = job.line(0, &[0.0, 0.0], &[2.0, 0.0], 100.0);
            drive(&job, &[0.0, 0.0], vec![block], events).unwrap()
        };
        let plain = drive(&[]);
        let peak = plain.iter().map(|p| p.v_mm_s).fold(0.0, f64::max);
        assert!(peak < 60.0);
        for k in 1..plain.len() as u64 {
            for ratio in [0.65, 0.95, 1.05, 2.0] {
                let events = [(k, Event::Override(ratio)), (k + 15, Event::Override(1.0))];
                let out = drive(&events);
                assert_eq!(out.len(), plain.len(), "{kind:?} {ratio} at {k}");
                for (a, b) in out.iter().zip(&plain) {
                    let apart = (a.position[0] - b.position[0]).abs();
                    assert!(apart < 1e-6, "{kind:?} {ratio} at {k}: {a:?} {b:?}");
                }
            }
        }
    }
}

/// Feedhold and override on a full circle: radius, speed over the path length and the end stay exact.
#[test]
fn events_on_a_circle() {
    let job = Job::new(0.0, Trapez);
    let (start, end) = ([10.0, 0.0], [10.0 * libm::cos(12.0), 10.0 * libm::sin(12.0)]);
    for k in (10..1300_u64).step_by(37) {
        let blocks = vec![job.block(0, arc(&start, &end, [0.0, 0.0], 12.0), 80.0)];
        let events = [
            (k, Event::Override(0.4)),
            (k + 60, Event::Hold(Own)),
            (k + 400, Event::Release),
            (k + 420, Event::Override(1.2)),
        ];
        let out = drive(&job, &start, blocks, &events).unwrap();
        assert_eq!(out.last().unwrap().position[..], end);
        assert!((out.last().unwrap().s_mm - 120.0).abs() < 1e-9);
        for w in out.windows(2) {
            let r = libm::hypot(w[1].position[0], w[1].position[1]);
            assert!((r - 10.0).abs() < 1e-9);
            let chord = libm::hypot(
                w[1].position[0] - w[0].position[0],
                w[1].position[1] - w[0].position[1],
            );
            let arc = 20.0 * libm::asin(chord / 20.0);
            assert!((arc - (w[1].s_mm - w[0].s_mm)).abs() < 1e-8, "{k} {}", w[1].k);
            // sqrt(a r) = 100 mm/s is the limit of the curvature; a limit is kept to 1e-9 of it
            assert!(w[1].v_mm_s <= 96.0 * (1.0 + 1e-9));
        }
    }
}

/// An emergency stop in the middle of a feedhold continues from the same point of the path.
#[test]
fn emergency_stop_during_a_feedhold() {
    let job = Job::new(0.0, Trapez);
    let cycle = CycleTime::from_us(1000).unwrap();
    let mut planner = Planner::new(cycle, 10, &[0.0, 0.0]);
    for i in 0..10_u32 {
        let x = f64::from(i);
        planner.push(job.line(u64::from(i), &[x, 0.0], &[x + 1.0, 0.0], 50.0));
    }
    planner.finish();
    let mut last = 0.0;
    let mut step = |planner: &Planner, k: usize| {
        let x = planner.setpoint().position[0];
        assert!(x >= last && x - last <= 0.0501, "{k}: {last} {x}");
        last = x;
    };
    for k in 0..180 {
        if k == 120 {
            planner.feedhold(true, Active);
        }
        planner.advance().unwrap();
        step(&planner, k);
    }
    assert!(planner.setpoint().v_mm_s > 0.0);
    planner.brake();
    for k in 180..400 {
        planner.advance_braking();
        step(&planner, k);
    }
    assert!(planner.brake_is_over());
    assert!((planner.setpoint().position[0] - planner.setpoint().s_mm).abs() < 1e-9);
}
