//! Override and feedhold: closed forms, and properties over random programs with events at random cycles.

#![expect(
    clippy::unwrap_used,
    clippy::float_cmp,
    reason = "helpers of tests; exact values are meant"
)]

mod common;

use common::events::{Event, drive, line};
use common::{Job, axis, channel, deviation};
use kontur_filters::time::CycleTime;
use kontur_kit::{Random, environment};
use kontur_motion::axis::AxisVec;
use kontur_motion::block::SlopeKind::{Hsc, Sin2, Step, Trapez};
use kontur_motion::block::{Feed, SlopeKind};
use kontur_motion::path::{ArcPath, ArcShape, Path};
use kontur_motion::planner::{Planner, Setpoint};
use kontur_motion::profile::Infeasible;
use kontur_motion::realtime::FeedholdBraking;

use FeedholdBraking::{Active, Own};

/// One straight line of 100 mm at 100 mm/s.
fn straight(job: &Job, events: &[(u64, Event)]) -> Vec<Setpoint> {
    drive(job, &[0.0, 0.0], vec![line(job, 0, &[0.0, 0.0], &[100.0, 0.0], 100.0)], events).unwrap()
}

/// `L/v + v/a` (STEP), `+ t` (TRAPEZ and SIN2): 1000 mm/s2, ramps of 50 ms.
#[test]
fn constant_override_on_a_long_line() {
    for (kind, ramp) in [(Step, 0.0), (Trapez, 0.05), (Sin2, 0.05)] {
        for ratio in [0.05, 0.5, 0.9, 1.0, 1.3, 2.0] {
            let out = straight(&Job::new(0.0, kind), &[(0, Event::Override(ratio))]);
            let v = 100.0 * ratio;
            // below 50 mm/s the plateau is not reached and the ramps are shorter
            let leg = if v < 1000.0 * ramp {
                2.0 * ramp * (v / (1000.0 * ramp)).sqrt()
            } else {
                v / 1000.0 + ramp
            };
            let duration = 100.0 / v + leg;
            let cycles = (duration / 1e-3 - 1e-6).ceil() as usize;
            assert_eq!(out.len() - 1, cycles, "{kind:?} {ratio}");
            assert_eq!(out[cycles].position[0], 100.0);
        }
    }
}

/// From 100 to 50 mm/s at 500 ms. STEP: 0.1 s up (5 mm), 0.4 s at 100 (40 mm), 0.05 s down (3.75 mm), 50 mm/s over
/// what is left but 1.25 mm, 0.05 s to rest: 50 mm, 1 s. TRAPEZ: 0.15 s (7.5 mm), 0.35 s (35 mm), down 0.1 s
/// (7.5 mm), to rest 0.1 s (2.5 mm), left 47.5 mm, 0.95 s.
#[test]
fn lower_override_in_the_middle() {
    for (kind, duration) in
        [(Step, 0.1 + 0.4 + 0.05 + 1.0 + 0.05), (Trapez, 0.5 + 0.1 + 0.95 + 0.1)]
    {
        let out = straight(&Job::new(0.0, kind), &[(500, Event::Override(0.5))]);
        assert_eq!(out.len() - 1, ((duration / 1e-3_f64) - 1e-6).ceil() as usize, "{kind:?}");
        assert_eq!(out.last().unwrap().position[0], 100.0);
        assert!((out[500].v_mm_s - 100.0).abs() < 1e-9);
        assert!(out[501].v_mm_s < 100.0);
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

/// A knob turned in small steps does not hold the acceleration down: 0.15 s to 100 mm/s, in spite of a change every
/// 10 ms; and back down as fast.
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

#[test]
fn override_zero_is_a_standstill() {
    let out = straight(
        &Job::new(0.0, Trapez),
        &[(500, Event::Override(0.0)), (1000, Event::Override(1.0))],
    );
    assert!(out[650..=1000].iter().all(|p| p.v_mm_s == 0.0 && p.limit.name() == "feed"));
    assert_eq!(out.last().unwrap().position[0], 100.0);
}

/// Rapid 0 % stops at the end of the feed block before a rapid one, not before.
#[test]
fn rapid_override_zero_waits_in_front_of_the_rapid_block() {
    let job = Job::new(0.0, Trapez);
    let mut blocks = vec![
        line(&job, 0, &[0.0, 0.0], &[20.0, 0.0], 50.0),
        line(&job, 1, &[20.0, 0.0], &[60.0, 0.0], 50.0),
    ];
    blocks[1].feed = Feed::Rapid;
    let events = [(5, Event::Rapid(1.0, 0.0)), (2000, Event::Rapid(1.0, 1.0))];
    let out = drive(&job, &[0.0, 0.0], blocks, &events).unwrap();
    assert!(out[1000..=2000].iter().all(|p| p.position[0] == 20.0 && p.v_mm_s == 0.0));
    assert_eq!(out.last().unwrap().position[0], 60.0);
}

struct Case {
    job: Job,
    points: Vec<[f64; 2]>,
    feeds: Vec<Option<f64>>,
    events: Vec<(u64, Event)>,
    /// G901.
    late: bool,
}

impl Case {
    fn new(r: &mut Random) -> Self {
        let kind = r.pick(&[Step, Trapez, Trapez, Sin2, Hsc]);
        let mut axes = vec![axis(r.pick(&[0.0, 0.3, 1.0])); 2];
        for a in &mut axes {
            a.v_max_mm_s = 60.0 + 200.0 * r.ratio();
            a.v_rapid_mm_s = a.v_max_mm_s;
            let acc = 500.0 + 1500.0 * r.ratio();
            a.feed.acc_mm_s2 = acc;
            a.feed.dec_mm_s2 = acc * (0.5 + r.ratio());
            a.feed.ramps_s = [0; 4].map(|_| 0.01 + 0.08 * r.ratio());
            a.rapid.acc_mm_s2 = 2000.0;
            a.a_max_mm_s2 = 4000.0;
        }
        let job = Job {
            dynamics: channel(axes),
            cycle_us: r.pick(&[500, 1000, 2000]),
            window: r.pick(&[3, 10, 120]),
            ..Job::new(0.0, kind)
        };
        let scale = r.pick(&[0.05, 0.5, 5.0, 30.0]);
        let bend = r.pick(&[0.02, 0.3, 3.0]);
        let mut points = vec![[0.0; 2]];
        let mut heading = 6.3 * r.ratio();
        for i in 0..(3 + (r.ratio() * if scale < 1.0 { 150.0 } else { 15.0 }) as usize) {
            heading += bend * (r.ratio() - 0.5);
            let length = scale * (0.1 + r.ratio());
            let p = points[i];
            points.push([p[0] + length * libm::cos(heading), p[1] + length * libm::sin(heading)]);
        }
        let feed = 5.0 + 150.0 * r.ratio();
        let varied = r.ratio() < 0.4;
        let feeds = (1..points.len())
            .map(|_| match r.ratio() {
                x if varied && x < 0.1 => None,
                x if varied && x < 0.4 => Some(feed * (0.1 + r.ratio())),
                _ => Some(feed),
            })
            .collect();
        let mut events = Vec::new();
        let mut k = 0;
        for _ in 0..(r.ratio() * 12.0) as usize {
            k += (libm::exp(r.ratio() * 7.0)) as u64;
            let event = match r.ratio() {
                x if x < 0.3 => Event::Hold(r.pick(&[Active, Own])),
                x if x < 0.5 => Event::Release,
                x if x < 0.55 => Event::Override(0.0),
                x if x < 0.65 => Event::Rapid(2.0 * r.ratio(), 2.0 * r.ratio()),
                x if x < 0.8 => Event::Override(r.pick(&[0.3, 0.5, 1.0, 1.5])),
                _ => Event::Override(2.0 * r.ratio()),
            };
            events.push((k, event));
        }
        events.push((k + 500, Event::Override(0.7 + r.ratio())));
        events.push((k + 500, Event::Release));
        Self { job, points, feeds, events, late: false }
    }

    fn run(&self) -> Result<Vec<Setpoint>, Infeasible> {
        let block = |(i, w): (usize, &[[f64; 2]])| {
            let mut b = line(&self.job, i as u64, &w[0], &w[1], self.feeds[i].unwrap_or(1.0));
            if self.feeds[i].is_none() {
                b.feed = Feed::Rapid;
            }
            b.late_braking = self.late;
            b
        };
        let blocks = self.points.windows(2).enumerate().map(block).collect();
        drive(&self.job, &self.points[0], blocks, &self.events)
    }

    fn check(&self, out: &[Setpoint]) -> Result<(), String> {
        let t = f64::from(self.job.cycle_us) * 1e-6;
        let kind: SlopeKind = self.job.slope.kind;
        let points: Vec<&[f64]> = self.points.iter().map(|p| &p[..]).collect();
        let end = out.last().unwrap();
        let target = self.points.last().unwrap();
        if end.position[..] != target[..] || end.v_mm_s != 0.0 || end.a_mm_s2 != 0.0 {
            return Err(format!("ends at {:?}, not {target:?}", end.position));
        }
        let axes = &self.job.dynamics.axes;
        // highest path acceleration and jerk of any direction and block
        let (mut a_most, mut j_most): (f64, f64) = (0.0, 0.0);
        let limits = |seq: u64, i: usize| -> (f64, f64) {
            let x = &axes[i];
            let own = Event::Hold(Own);
            let feedhold = self.events.iter().any(|e| e.1 == own);
            let (mut a, mut j) = if kind == Step {
                let s = if self.feeds[seq as usize].is_some() { x.step_feed } else { x.step_rapid };
                (s.acc_mm_s2[0].max(s.dec_mm_s2[0]), f64::INFINITY)
            } else if self.feeds[seq as usize].is_some() {
                let f = x.feed;
                let longest = f.ramps_s.iter().copied().fold(0.0, f64::max);
                let j = |k: usize| {
                    let acc = if k < 2 { f.acc_mm_s2 } else { f.dec_mm_s2 };
                    acc / if kind == Hsc { longest } else { f.ramps_s[k] }
                };
                (f.acc_mm_s2.max(f.dec_mm_s2), (0..4).map(j).fold(0.0, f64::max))
            } else {
                (x.rapid.acc_mm_s2, x.rapid.acc_mm_s2 / x.rapid.ramp_s)
            };
            if feedhold {
                let h = x.feedhold;
                a = a.max(if kind == Step { h.step_dec_mm_s2 } else { h.dec_mm_s2 });
                j = j.max(h.dec_mm_s2 / h.ramp_s);
            }
            (a, if kind == Sin2 { j * std::f64::consts::FRAC_PI_2 } else { j })
        };
        for seq in 0..self.feeds.len() as u64 {
            for i in 0..2 {
                let (a, j) = limits(seq, i);
                a_most = a_most.max(a * 2.0_f64.sqrt());
                j_most = j_most.max(j * 2.0_f64.sqrt());
            }
        }
        let slack = 1.0 + 1e-6;
        for (k, p) in out.iter().enumerate() {
            if p.v_mm_s < 0.0 {
                return Err(format!("{k}: v {}", p.v_mm_s));
            }
            let off = deviation(&p.position, &points);
            if off > 1e-9 {
                return Err(format!("{k}: {off} off the contour"));
            }
            let (from, to) = (self.points[p.seq as usize], self.points[p.seq as usize + 1]);
            let length = libm::hypot(to[0] - from[0], to[1] - from[1]);
            for i in 0..2 {
                let u = ((to[i] - from[i]) / length).abs();
                let (a, j) = limits(p.seq, i);
                if p.v_mm_s * u > axes[i].v_max_mm_s * slack {
                    return Err(format!("{k}: axis {i} velocity {}", p.v_mm_s * u));
                }
                // at the very beginning of a STEP slope the block before counts
                if p.a_mm_s2.abs() * u > a * slack {
                    return Err(format!("{k}: axis {i} acceleration {} of {a}", p.a_mm_s2 * u));
                }
                if p.j_mm_s3.abs() * u > j * slack {
                    return Err(format!("{k}: axis {i} jerk {} of {j}", p.j_mm_s3 * u));
                }
            }
            let Some(q) = k.checked_sub(1).map(|k| &out[k]) else { continue };
            let ds = p.s_mm - q.s_mm;
            if ds < 0.0
                || (ds - 0.5 * (p.v_mm_s + q.v_mm_s) * t).abs() > 0.25 * a_most * t * t * slack
            {
                return Err(format!("{k}: step of {ds} at {}", p.v_mm_s));
            }
            if (p.v_mm_s - q.v_mm_s).abs() > a_most * t * slack {
                return Err(format!("{k}: velocity jumps from {} to {}", q.v_mm_s, p.v_mm_s));
            }
            if kind != Step && (p.a_mm_s2 - q.a_mm_s2).abs() > j_most * t * slack {
                return Err(format!("{k}: acceleration jumps from {} to {}", q.a_mm_s2, p.a_mm_s2));
            }
        }
        // what a kink may put on an axis in one cycle, and the acceleration on both sides of it
        for (k, w) in out.windows(3).enumerate() {
            for i in 0..2 {
                let second =
                    (w[2].position[i] - 2.0 * w[1].position[i] + w[0].position[i]) / (t * t);
                let own = |s: &Setpoint| limits(s.seq, i).0;
                let most = own(&w[0]).max(own(&w[1])).max(own(&w[2]));
                if second.abs() > 2.0 * most * slack {
                    return Err(format!("{k}: axis {i} second difference {second} of {most}"));
                }
            }
        }
        // feedhold and override 0 come to rest and stay
        let mut held: Option<u64> = None;
        let stopped_by = |k: u64, until: u64| {
            let longest = 1.5; // s, from 260 mm/s at 250 mm/s2 with ramps of 90 ms
            let rest = k + (longest / t) as u64;
            out.iter().filter(|p| p.k > rest && p.k <= until).all(|p| p.v_mm_s == 0.0)
        };
        for (k, event) in &self.events {
            match event {
                Event::Hold(_) => held = held.or(Some(*k)),
                Event::Release => {
                    if let Some(from) = held.take()
                        && !stopped_by(from, *k)
                    {
                        return Err(format!("feedhold of {from} moves at {k}"));
                    }
                }
                _ => {}
            }
        }
        Ok(())
    }
}

#[test]
fn random_programs_with_random_events() {
    let (count, seed) = (environment("COUNT", 150), environment("SEED", 0));
    let mut failed = 0;
    for case in seed..seed + count {
        let mut c = Case::new(&mut Random::from_state(case * 7919 + 1));
        c.late = case % 2 == 1;
        if let Err(why) = c.run().map_err(|e| e.to_string()).and_then(|out| c.check(&out)) {
            failed += 1;
            println!(
                "case {case}, G901 {}: {why}; {:?} window {} {} us, events {:?}, feeds {:?}, {} points",
                c.late,
                c.job.slope.kind,
                c.job.window,
                c.job.cycle_us,
                c.events,
                &c.feeds[..c.feeds.len().min(5)],
                c.points.len()
            );
        }
    }
    assert_eq!(failed, 0);
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
        let blocks =
            (0..1200).map(|k| line(&job, u64::from(k), &at(k), &at(k + 1), 80.0)).collect();
        let events = [(0, Event::Override(0.05)), (200, Event::Override(2.0))];
        let out = drive(&job, &at(0), blocks, &events).unwrap();
        let fastest = out.iter().map(|p| p.v_mm_s).fold(0.0, f64::max);
        // up and down again within a chord in any direction: v^2 = 100^2 + sqrt(2) 1000 * 0.05
        assert!((99.0..=100.36).contains(&fastest), "{kind:?}: {fastest}");
        assert_eq!(out.last().unwrap().position[..], at(1200));
    }
}

/// Setting what is set already changes no bit.
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

/// Programs left alone, with small look-ahead windows in which new blocks ask for a crawl.
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

/// Feedhold and override on a full circle: radius, speed over the path length and the end stay exact.
#[test]
fn events_on_a_circle() {
    let job = Job::new(0.0, Trapez);
    let shape = ArcShape { plane: [0, 1], centre_mm: [0.0, 0.0], sweep_rad: 12.0 };
    let (start, end) = ([10.0, 0.0], [10.0 * libm::cos(12.0), 10.0 * libm::sin(12.0)]);
    let at = |p: &[f64]| AxisVec::from_slice(p);
    for k in (10..1300_u64).step_by(37) {
        let arc = ArcPath::new(at(&start), at(&end), shape, &[]).unwrap();
        let blocks = vec![job.block(0, Path::Arc(arc), 80.0)];
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
            // sqrt(a r) = 100 mm/s is the limit of the curvature
            assert!(w[1].v_mm_s <= 96.0 + 1e-9);
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
        planner.push(line(&job, u64::from(i), &[x, 0.0], &[x + 1.0, 0.0], 50.0));
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
