//! Override and feedhold under `AX_DEV`: the plan after a change keeps the tolerance.

use crate::common::events::{Event, drive, line};
use crate::common::{Job, deviation, filtered};
use kontur_filters::kernel::{Kernel, Tap};
use kontur_filters::time::CycleTime;
use kontur_filters::vib_guard::VibGuardSettings;
use kontur_motion::axis::AxisVec;
use kontur_motion::block::SlopeKind::{Hsc, Sin2, Step, Trapez};
use kontur_motion::block::Tolerance;
use kontur_motion::path::{ArcPath, ArcShape, Path};
use kontur_motion::planner::{Next, Planner};
use kontur_motion::realtime::FeedholdBraking::{Active, Own};
use kontur_motion::tolerance::Kernels;
use std::sync::Arc;

/// `AX_DEV` on a square with events at any time: the plan after a change keeps the tolerance.
#[test]
fn tolerance_with_events() {
    const SQUARE: [&[f64]; 5] = [&[0.0, 0.0], &[8.0, 0.0], &[8.0, 8.0], &[0.0, 8.0], &[0.0, 0.0]];
    let mut worst: f64 = 0.0;
    for kind in [Trapez, Sin2, Hsc, Step] {
        for at in (1..700_u64).step_by(23) {
            for event in [Event::Override(0.3), Event::Override(1.7), Event::Hold(Active)] {
                let mut job = Job::new(1.0, kind);
                let cycle = CycleTime::from_us(job.cycle_us).unwrap();
                let guard = VibGuardSettings { mode: 2, freq_hz: 40.0, damping: 0.1 };
                job.kernel = Some(guard.kernel(cycle).unwrap());
                job.tolerance = Tolerance { ax_dev_mm: Some(0.01), acc_fact: 1.0 };
                let block = |(i, w): (usize, &[&[f64]])| line(&job, i as u64, w[0], w[1], 60.0);
                let blocks = SQUARE.windows(2).enumerate().map(block).collect();
                let events =
                    [(at, event), (at + 300, Event::Release), (at + 350, Event::Override(1.0))];
                let out = drive(&job, &[0.0, 0.0], blocks, &events).unwrap();
                assert_eq!(out.last().unwrap().position[..], [0.0, 0.0]);
                let dev = filtered(&out, job.kernel.as_ref().unwrap())
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
                let mut job = Job::new(1.0, kind);
                let cycle = CycleTime::from_us(job.cycle_us).unwrap();
                let guard = VibGuardSettings { mode: 2, freq_hz: 40.0, damping: 0.1 };
                job.kernel = Some(guard.kernel(cycle).unwrap());
                job.tolerance = Tolerance { ax_dev_mm: Some(TOLERANCE), acc_fact: 1.0 };
                let angle = |k: u32| std::f64::consts::FRAC_PI_6 * (f64::from(k) - 3.0);
                let on_arc = |a: f64| {
                    AxisVec::from_slice(&[8.0 + 3.0 * libm::cos(a), 3.0 + 3.0 * libm::sin(a)])
                };
                let mut blocks = vec![
                    line(&job, 0, &[0.0, 0.0], &[5.0, 0.0], 60.0),
                    line(&job, 1, &[5.0, 0.0], &on_arc(angle(0)), 60.0),
                ];
                for k in [0_u32, 2, 3] {
                    let (from, to) = (angle(k), angle([2, 3, 3, 6][k as usize]));
                    let shape =
                        ArcShape { plane: [0, 1], centre_mm: [8.0, 3.0], sweep_rad: to - from };
                    let arc = ArcPath::new(on_arc(from), on_arc(to), shape, &[]).unwrap();
                    blocks.push(job.block(blocks.len() as u64, Path::Arc(arc), 60.0));
                }
                blocks.push(line(&job, 5, &on_arc(angle(6)), &[0.0, 6.0], 60.0));
                blocks.push(line(&job, 6, &[0.0, 6.0], &[0.0, 0.0], 60.0));
                let events =
                    [(at, event), (at + 250, Event::Release), (at + 290, Event::Override(1.0))];
                let out = drive(&job, &[0.0, 0.0], blocks, &events).unwrap();
                assert_eq!(out.last().unwrap().position[..], [0.0, 0.0]);
                for (k, p) in filtered(&out, job.kernel.as_ref().unwrap()).iter().enumerate() {
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
    let job = Job::new(0.0, Step);
    let tap = |delay: u32, weight: f64| Tap { delay, weight };
    let kernels = [Kernel::from_taps([tap(0, 0.5), tap(20, 0.5)]).unwrap(), Kernel::delay(8)];
    let tolerance_mm = 0.05;
    for hold in (400_u64..420).step_by(3) {
        let mut planner = Planner::new(CycleTime::from_us(1000).unwrap(), job.window, &[0.0, 0.0]);
        planner.set_kernels(
            Kernels::new(kernels.iter().map(|k| Some(Arc::new(k.clone()))).collect()),
            20,
        );
        let mut block = line(&job, 0, &[0.0, 0.0], &[60.0, 80.0], 100.0);
        block.tolerance = Tolerance { ax_dev_mm: Some(tolerance_mm), ..Tolerance::default() };
        planner.push(block);
        planner.finish();
        let mut out = vec![planner.setpoint().clone()];
        while planner.advance().unwrap() == Next::Setpoint {
            out.push(planner.setpoint().clone());
            match planner.setpoint().k {
                k if k == hold => planner.feedhold(true, Own),
                k if k == hold + 700 => planner.feedhold(false, Own),
                _ => {}
            }
        }
        assert_eq!(planner.take_unkept(), []);
        let rests = out.windows(2).filter(|w| w[0].s_mm > 1.0 && w[1].s_mm < 99.0);
        assert!(rests.filter(|w| w[1].s_mm - w[0].s_mm <= 0.0).count() > 500, "{hold}");
        let set: Vec<[f64; 2]> = {
            let [x, y] = [0, 1].map(|i| filtered(&out, &kernels[i]).into_iter().map(move |p| p[i]));
            x.zip(y).map(|(x, y)| [x, y]).collect()
        };
        for [x, y] in set {
            // 3-4-5 triangle: the distance from the line, and the larger of its components
            let aside = (0.8 * x - 0.6 * y).abs() * 0.8;
            assert!(aside <= tolerance_mm + 1e-9, "{hold}: {aside}");
        }
    }
}
