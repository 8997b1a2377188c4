//! Override and feedhold under `AX_DEV`: the plan after a change keeps the tolerance.

use crate::common::events::{Event, drive};
use crate::common::{Job, arc, deviation, filtered};
use kontur_filters::kernel::{Kernel, Tap};
use kontur_motion::block::SlopeKind::{Hsc, Sin2, Step, Trapez};
use kontur_motion::block::Tolerance;
use kontur_motion::realtime::FeedholdBraking::{Active, Own};

/// `AX_DEV` on a square with events at any time: the plan after a change keeps the tolerance.
#[test]
fn tolerance_with_events() {
    const SQUARE: [&[f64]; 5] = [&[0.0, 0.0], &[8.0, 0.0], &[8.0, 8.0], &[0.0, 8.0], &[0.0, 0.0]];
    let mut worst: f64 = 0.0;
    for kind in [Trapez, Sin2, Hsc, Step] {
        for at in (1..700_u64).step_by(23) {
            for event in [Event::Override(0.3), Event::Override(1.7), Event::Hold(Active)] {
                let job = Job::new(1.0, kind).guarded(2, 40.0, 0.1, Some(0.01));
                let block = |(i, w): (usize, &[&[f64]])| job.line(i as u64, w[0], w[1], 60.0);
                let blocks = SQUARE.windows(2).enumerate().map(block).collect();
                let events =
                    [(at, event), (at + 300, Event::Release), (at + 350, Event::Override(1.0))];
                let out = drive(&job, &[0.0, 0.0], blocks, &events).unwrap();
                assert_eq!(out.last().unwrap().position[..], [0.0, 0.0]);
                let dev = filtered(&out, &job.kernels)
                    .iter()
                    .map(|p| deviation(p, &SQUARE))
                    .fold(0.0, f64::max);
                worst = worst.max(dev);
                println!("{kind:?} {at} {event:?}: {dev}");
            }
        }
    }
    assert!(worst <= 0.01, "{worst}");
}

/// Largest component of the shortest vector from the slot of [`tolerance_with_events_on_arcs`] to a point.
fn off_the_slot(p: &[f64]) -> f64 {
    let (x, y) = (p[0], p[1]);
    let foot = |x: f64, y: f64| [x.clamp(0.0, 8.0), y];
    let along = y.clamp(0.0, 6.0);
    let mut feet = vec![foot(x, 0.0), foot(x, 6.0), [0.0, along]];
    // semicircle to the right of (8, 3)
    if x > 8.0 {
        let r = libm::hypot(x - 8.0, y - 3.0);
        feet.push([8.0 + 3.0 * (x - 8.0) / r, 3.0 + 3.0 * (y - 3.0) / r]);
    }
    let size = |q: &[f64; 2]| libm::hypot(x - q[0], y - q[1]);
    let nearest = feet.iter().min_by(|a, b| size(a).total_cmp(&size(b))).unwrap();
    (x - nearest[0]).abs().max((y - nearest[1]).abs())
}

/// `AX_DEV` on a slot of lines, a semicircle and two corners, each piece cut into several blocks: the remainder of an
/// arc that is split by a change of speed has the same curvature as the whole and no further corner.
#[test]
fn tolerance_with_events_on_arcs() {
    const TOLERANCE: f64 = 0.01;
    let mut worst: f64 = 0.0;
    for kind in [Trapez, Sin2, Hsc, Step] {
        for at in (5..1100_u64).step_by(91) {
            for event in [Event::Override(0.3), Event::Override(1.7), Event::Hold(Active)] {
                let job = Job::new(1.0, kind).guarded(2, 40.0, 0.1, Some(TOLERANCE));
                let angle = |k: u32| std::f64::consts::FRAC_PI_6 * (f64::from(k) - 3.0);
                let on_arc = |a: f64| [8.0 + 3.0 * libm::cos(a), 3.0 + 3.0 * libm::sin(a)];
                let mut blocks = vec![
                    job.line(0, &[0.0, 0.0], &[5.0, 0.0], 60.0),
                    job.line(1, &[5.0, 0.0], &on_arc(angle(0)), 60.0),
                ];
                for k in [0_u32, 2, 3] {
                    let (from, to) = (angle(k), angle([2, 3, 3, 6][k as usize]));
                    let arc = arc(&on_arc(from), &on_arc(to), [8.0, 3.0], to - from);
                    blocks.push(job.block(blocks.len() as u64, arc, 60.0));
                }
                blocks.push(job.line(5, &on_arc(angle(6)), &[0.0, 6.0], 60.0));
                blocks.push(job.line(6, &[0.0, 6.0], &[0.0, 0.0], 60.0));
                let events =
                    [(at, event), (at + 250, Event::Release), (at + 290, Event::Override(1.0))];
                let out = drive(&job, &[0.0, 0.0], blocks, &events).unwrap();
                assert_eq!(out.last().unwrap().position[..], [0.0, 0.0]);
                for (k, p) in filtered(&out, &job.kernels).iter().enumerate() {
                    let off = off_the_slot(p);
                    worst = worst.max(off);
                    assert!(off <= TOLERANCE, "{kind:?} {at} {event:?} cycle {k}: {off}");
                }
            }
        }
    }
    assert!(worst > 0.9 * TOLERANCE, "the tolerance is not used: {worst}");
}

/// X is filtered by two taps 20 cycles apart, Y is delayed by 8 cycles. On a straight line the set point is offset by
/// the speed times the difference of the two delays (2 cycles). 8 cycles after a sudden stop, however, the offset is
/// three times as large, because Y has arrived and half of X is still 12 to 20 cycles late. The feedhold is twice as
/// hard as the planned braking, so it has to brake more gently, and every tolerance must be kept.
#[test]
fn a_feedhold_brakes_gently_where_filters_pull_the_axes_apart() {
    let tap = |delay: u32, weight: f64| Tap { delay, weight };
    let kernels = vec![Kernel::from_taps([tap(0, 0.5), tap(20, 0.5)]).unwrap(), Kernel::delay(8)];
    let tolerance_mm = 0.05;
    let tolerance = Tolerance { ax_dev_mm: Some(tolerance_mm), ..Tolerance::default() };
    let job = Job { tolerance, kernels, ..Job::new(0.0, Step) };
    for hold in (400_u64..420).step_by(3) {
        let block = job.line(0, &[0.0, 0.0], &[60.0, 80.0], 100.0);
        let events = [(hold, Event::Hold(Own)), (hold + 700, Event::Release)];
        let out = drive(&job, &[0.0, 0.0], vec![block], &events).unwrap();
        let rests = out.windows(2).filter(|w| w[0].s_mm > 1.0 && w[1].s_mm < 99.0);
        assert!(rests.filter(|w| w[1].s_mm - w[0].s_mm <= 0.0).count() > 500, "{hold}");
        for set in filtered(&out, &job.kernels) {
            // 3-4-5 triangle: the distance from the line, and the larger of its components
            let aside = (0.8 * set[0] - 0.6 * set[1]).abs() * 0.8;
            assert!(aside <= tolerance_mm + 1e-9, "{hold}: {aside}");
        }
    }
}
