//! Kinks that limit the path speed between two lines, compared with closed forms.

use crate::common::{Job, axis, channel, even};
use kontur_motion::axis::AxisDynamics;
use kontur_motion::block::SlopeKind::{self, Hsc, Trapez};
use kontur_motion::cap::SpeedLimit;
use kontur_motion::planner::Setpoint;

const CYCLE_US: u32 = 100;
const CYCLE_S: f64 = 1e-4;
/// Kinks may use the velocity jump of 1 ms of acceleration.
const KINK_WEIGHT: f64 = 10.0;
/// Acceleration in mm/s2, jerks in mm/s3: X is fast, Z is slow.
const ACC: f64 = 2000.0;
const QUICK: f64 = ACC / 0.01;
const SLOW: f64 = ACC / 0.1;

fn drive(kind: SlopeKind, points: &[[f64; 2]], feeds_mm_s: &[f64]) -> Vec<Setpoint> {
    let of = |ramp: f64| AxisDynamics { feed: even(ACC, ramp), ..axis(KINK_WEIGHT) };
    let job = Job {
        dynamics: channel(vec![of(ACC / QUICK), of(ACC / SLOW)]),
        cycle_us: CYCLE_US,
        ..Job::new(KINK_WEIGHT, kind)
    };
    job.drive(points, feeds_mm_s)
}

/// Along X, then at 45 degrees, where Z limits the jerk.
const POINTS: [[f64; 2]; 3] = [[0.0, 0.0], [8.0, 0.0], [14.0, 6.0]];

/// Speed at the kink: Z jumps by `v / sqrt 2`, X by less.
fn at_kink() -> f64 {
    ACC * 1e-3 * 2.0_f64.sqrt()
}

/// Before the kink, with the jerk of X, the speed is lowest `a^2 / 2j` below the one at the kink and
/// `v t - j t^3 / 3` away from it; there `a` is what the path has at the kink.
#[test]
fn the_lowest_speed_lies_on_the_quicker_side() {
    let out = drive(Hsc, &POINTS, &[200.0]);
    let kink = out.iter().position(|p| p.seq == 1).unwrap();
    let Setpoint { v_mm_s: v, a_mm_s2: a, s_mm: s, .. } = out[kink];
    // the setpoint lies up to a cycle after the kink
    let behind_s = 2.0 * (s - 8.0) / (v + at_kink());
    assert!((0.0..=CYCLE_S).contains(&behind_s), "{behind_s}");
    assert!((v - a * behind_s - at_kink()).abs() < 2e-4, "{v}");
    assert!(a > 100.0, "{a}");
    let near = out[kink - 400..kink + 400].iter();
    let lowest = near.min_by(|p, q| p.v_mm_s.total_cmp(&q.v_mm_s)).unwrap();
    let a = a - SLOW / 2.0_f64.sqrt() * behind_s;
    let t = a / QUICK;
    let (dip, way) = (a * t / 2.0, at_kink() * t - QUICK * t * t * t / 3.0);
    assert!((at_kink() - lowest.v_mm_s - dip).abs() < 0.01 * dip, "{lowest:?}");
    let slip = CYCLE_S * at_kink();
    assert!((8.0 - lowest.s_mm - way).abs() < slip, "{lowest:?}");
}

/// TRAPEZ reaches and leaves the speed of a kink with zero acceleration: the acceleration of an axis never jumps by
/// more than its jerk and the velocity jump require.
#[test]
fn trapez_passes_a_kink_without_acceleration() {
    for points in [POINTS.to_vec(), POINTS.iter().rev().copied().collect()] {
        let out = drive(Trapez, &points, &[200.0]);
        let kink = out.iter().position(|p| p.seq == 1).unwrap();
        let near = &out[kink - 400..kink + 400];
        let lowest = near.iter().map(|p| p.v_mm_s).fold(f64::INFINITY, f64::min);
        assert!((lowest - at_kink()).abs() < 1e-3, "{lowest}");
        let kept = near.iter().filter(|p| (p.v_mm_s - at_kink()).abs() < 1e-3);
        assert!(kept.clone().count() > 0);
        assert!(kept.map(|p| p.a_mm_s2.abs()).fold(0.0, f64::max) < 2.0 * QUICK * CYCLE_S);
    }
}

/// Where both sides are equal nothing is gained: the path is slowest at the kink.
#[test]
fn between_equal_lines_the_lowest_speed_is_at_the_kink() {
    // bends that affect both axes alike
    let points = [[0.0, 0.0], [6.0, 2.0], [12.0, 0.0]];
    for kind in [Hsc, Trapez] {
        let out = drive(kind, &points, &[200.0]);
        let kink = out.iter().position(|p| p.seq == 1).unwrap();
        let near = &out[kink - 400..kink + 400];
        let lowest = near.iter().map(|p| p.v_mm_s).fold(f64::INFINITY, f64::min);
        assert!(out[kink].v_mm_s - lowest < 1e-3, "{kind:?}: {lowest}");
    }
}

/// After a kink that is passed with an acceleration, the time attributed to the feed is that of the distance at the
/// feed rate, except for the ramps at both ends.
#[test]
fn behind_a_kink_the_feed_is_the_reason_for_the_feed() {
    for kind in [Hsc, Trapez] {
        for feed in (5..60).map(f64::from) {
            let way = [[0.0, 0.0], [20.0, 0.0], [20.0, feed]];
            let out = drive(kind, &way, &[200.0, feed]);
            let even = |p: &&Setpoint| {
                p.seq == 1 && (p.v_mm_s - feed).abs() < 1e-5 && p.a_mm_s2.abs() < 1e-3
            };
            let at_feed: Vec<_> = out.iter().filter(even).collect();
            let ramps_s = 2.0 * (ACC / SLOW + feed / ACC);
            assert!(at_feed.len() as f64 > (1.0 - ramps_s) / CYCLE_S, "{feed}: {}", at_feed.len());
            for p in at_feed {
                assert_eq!(p.limit, SpeedLimit::Feed, "{kind:?}, {feed} mm/s: {p:?}");
            }
        }
    }
}
