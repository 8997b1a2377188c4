//! Independent axes against the closed forms of the slopes.

#![expect(clippy::float_cmp, reason = "exact values are meant")]

use crate::common::axis;
use kontur_filters::time::CycleTime;
use kontur_kit::{Random, count, seed};
use kontur_motion::block::SlopeKind::{self, Sin2, Step, Trapez};
use kontur_motion::independent::IndependentSpeed::{Feed, Rapid, ShareOfMaximum, Time};
use kontur_motion::independent::{IndependentMove, IndependentSpeed, Steering};
use kontur_motion::realtime::OverrideRatios;

fn go(from: f64, to: f64, speed: IndependentSpeed, kind: SlopeKind) -> IndependentMove {
    let cycle = CycleTime::from_us(1000).unwrap();
    IndependentMove::new(from, to, speed, kind, &axis(0.0), cycle).unwrap()
}

/// 100 mm at 100 mm/s: 1.1 s (STEP), 1.15 s; 1 mm at 4 m/min: 63.2 ms, 116.96 ms.
#[test]
fn durations() {
    for (to, speed, kind, cycles) in [
        (100.0, Feed(100.0), Step, 1100),
        (-100.0, Feed(100.0), Trapez, 1150),
        (100.0, ShareOfMaximum(0.1), Sin2, 1150),
        (1.0, Feed(4000.0 / 60.0), Step, 64),
        (1.0, Feed(4000.0 / 60.0), Trapez, 117),
        // rapid: ramps of 10 ms; 10 mm in 2 (tc + 2 t) with 1000 (tc^2 + 3 t tc + 2 t^2) = 10
        (10.0, Rapid, Trapez, 211),
    ] {
        let m = go(0.0, to, speed, kind);
        assert_eq!(m.cycles(), cycles, "{to} {speed:?} {kind:?}");
        assert_eq!(m.state(cycles).position_mm, to);
        assert_eq!(m.state(0).position_mm, 0.0);
    }
}

#[test]
fn time_is_met_or_as_fast_as_possible() {
    for kind in [Step, Trapez, Sin2] {
        let m = go(5.0, -45.0, Time(2.0), kind);
        assert_eq!(m.cycles(), 2000, "{kind:?}");
        assert!(m.state(1999).v_mm_s < 0.0);
        assert_eq!(m.state(2000).position_mm, -45.0);
        let fastest = go(0.0, 50.0, Feed(1e6), kind).cycles();
        assert_eq!(go(0.0, 50.0, Time(0.001), kind).cycles(), fastest);
    }
}

#[test]
fn nothing_to_do() {
    let mut m = go(3.0, 3.0, Feed(10.0), Trapez);
    m.stop(0).unwrap();
    assert_eq!((m.cycles(), m.state(0).position_mm), (0, 3.0));
}

/// `v^2 / 2a + v t / 2` from the feed.
#[test]
fn stop_from_the_feed() {
    for (kind, distance, cycles) in [(Step, 5.0, 100), (Trapez, 7.5, 150), (Sin2, 7.5, 150)] {
        let mut m = go(0.0, -100.0, Feed(100.0), kind);
        let at = m.state(500).position_mm;
        m.stop(500).unwrap();
        assert_eq!(m.cycles(), 500 + cycles);
        assert!((m.state(10_000).position_mm - (at - distance)).abs() < 1e-9);
    }
}

/// A stop at any time: continuous, inside the limits of the axis, never beyond the target.
#[test]
fn stop_at_any_time() {
    for kind in [Step, Trapez, Sin2] {
        for (to, feed) in [(100.0, 100.0), (1.0, 60.0), (20.0, 30.0)] {
            let plain = go(0.0, to, Feed(feed), kind);
            for at in 0..plain.cycles() + 2 {
                let mut m = plain.clone();
                m.stop(at).unwrap();
                assert!(m.cycles() <= plain.cycles().max(at + 250));
                for k in 0..=m.cycles() + 2 {
                    let (a, b) = (m.state(k), m.state(k + 1));
                    if k <= at {
                        assert!((a.position_mm - plain.state(k).position_mm).abs() <= 1e-14 * to);
                    }
                    assert!(
                        a.v_mm_s >= 0.0 && a.v_mm_s <= feed * (1.0 + 1e-6),
                        "{kind:?} {at} {k}"
                    );
                    assert!(a.a_mm_s2.abs() <= 1000.0 * (1.0 + 1e-6));
                    let step = b.position_mm - a.position_mm;
                    assert!(step >= -1e-12 && b.position_mm <= to + 1e-9);
                    assert!((step - 0.5e-3 * (a.v_mm_s + b.v_mm_s)).abs() <= 0.25e-3 * 1.001);
                    if kind != Step {
                        // 20000 mm/s3, SIN2 pi/2 times as much
                        assert!((b.a_mm_s2 - a.a_mm_s2).abs() <= 31.416, "{kind:?} {at} {k}");
                    }
                }
            }
        }
    }
}

/// Override and feedhold at random times: continuous, inside the limits of the axis, at the target in the end, and never beyond it.
/// A hold brings it to rest within its braking from full speed; a release lets it continue.
#[test]
fn steered_at_random_times() {
    let mut r = Random::from_state(20 + seed());
    for n in 0..count(300) {
        let kind = r.pick(&[Step, Trapez, Sin2]);
        let (to, feed) = (r.between(-200.0, 200.0), r.log(15.0, 200.0));
        let mut m = go(0.0, to, Feed(feed), kind);
        let ratios = [0.0, 0.2, 0.5, 1.0, 1.5];
        let mut steering = Steering::default();
        let (mut before, mut held) = (m.state(0), 0);
        for k in 0..40_000 {
            if r.chance(0.003) {
                let ratios = OverrideRatios { feed: r.pick(&ratios), rapid: 1.0 };
                steering = Steering { ratios, held: r.chance(0.3), ..steering };
                held = 0;
            }
            if k > 20_000 {
                steering = Steering::default();
            }
            m.steer(k, steering);
            let (now, what) = (m.state(k), format!("{n} {kind:?} {k}"));
            assert!(now.v_mm_s * to.signum() >= -1e-9, "{what}: {now:?}");
            assert!(now.v_mm_s.abs() <= 1.5 * feed * (1.0 + 1e-6), "{what}: {now:?}");
            assert!(now.a_mm_s2.abs() <= 1000.0 * (1.0 + 1e-6), "{what}: {now:?}");
            assert!((to - now.position_mm) * to.signum() >= -1e-9, "{what}: {now:?}");
            if k > 0 {
                // a jerk of 20000 mm/s3, pi/2 times as much with SIN2
                let step = now.position_mm - before.position_mm;
                assert!((step - 0.5e-3 * (now.v_mm_s + before.v_mm_s)).abs() <= 0.5e-3, "{what}");
                let jump = (now.a_mm_s2 - before.a_mm_s2).abs();
                assert!(kind == Step || jump <= 31.5, "{what}: {before:?} {now:?}");
            }
            held += 1;
            let holds = steering.held || steering.ratios.feed <= 0.0;
            if holds && held > 1000 {
                assert_eq!(now.v_mm_s, 0.0, "{what}: {steering:?}");
            }
            before = now;
        }
        assert_eq!(before.position_mm, to, "{n} {kind:?}");
    }
}

/// A stop while an override is lowered ends at rest, and not at the target.
#[test]
fn stopped_while_it_slows_down() {
    for kind in [Step, Trapez, Sin2] {
        let mut m = go(0.0, 200.0, Feed(100.0), kind);
        let half = OverrideRatios { feed: 0.5, rapid: 1.0 };
        for k in 800..=820 {
            m.steer(k, Steering { ratios: half, ..Steering::default() });
        }
        assert!(m.state(820).a_mm_s2 < 0.0, "{kind:?}");
        let at = m.state(820).position_mm;
        for k in 820..1100 {
            m.stop(k).unwrap();
        }
        // at most the braking from 100 mm/s and a ramp of the acceleration
        let end = m.state(5000);
        assert!(end.position_mm < at + 15.0 && end.v_mm_s == 0.0, "{kind:?}: {end:?}");
    }
}
