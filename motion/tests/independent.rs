//! Independent axes against the closed forms of the slopes.

#![expect(
    clippy::unwrap_used,
    clippy::float_cmp,
    reason = "helpers of tests; exact values are meant"
)]

mod common;

use common::axis;
use kontur_filters::time::CycleTime;
use kontur_motion::block::SlopeKind::{self, Sin2, Step, Trapez};
use kontur_motion::independent::IndependentSpeed::{Feed, Rapid, ShareOfMaximum, Time};
use kontur_motion::independent::{IndependentMove, IndependentSpeed};

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
