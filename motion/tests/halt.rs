//! Halts at a point that becomes known under way: their position, their time, and the continuation.

#![expect(clippy::float_cmp, reason = "exact values are meant")]

use crate::common::{self, Job};
use kontur_filters::time::CycleTime;
use kontur_kit::Random;
use kontur_motion::block::{Block, SlopeKind};
use kontur_motion::planner::{Next, Planner, Setpoint};

/// Number of cycles of rest at the halt.
const RESTS: usize = 5;

/// A drive with one halt.
struct Driven {
    out: Vec<Setpoint>,
    /// Whether the halt was accepted.
    taken: bool,
    /// Index of the setpoint at the halt.
    halt: Option<usize>,
}

/// Drives blocks; after cycle `k` the path is told to halt `distance_mm` further on in its present block.
fn drive(job: &Job, start: &[f64], blocks: &[Block], k: u64, distance_mm: f64) -> Driven {
    let mut planner = Planner::new(CycleTime::from_us(job.cycle_us).unwrap(), job.window, start);
    let mut blocks = blocks.iter().cloned();
    let mut driven = Driven { out: vec![planner.setpoint().clone()], taken: false, halt: None };
    loop {
        match planner.advance().unwrap() {
            Next::Setpoint => {
                driven.out.push(planner.setpoint().clone());
                let Setpoint { k: now, seq, position, .. } = planner.setpoint().clone();
                if now == k {
                    driven.taken = planner.halt_in(seq, &position, distance_mm);
                }
            }
            Next::Input => match blocks.next() {
                Some(block) => planner.push(block),
                None => planner.finish(),
            },
            Next::Rest if planner.halts() => {
                driven.halt = Some(driven.out.len() - 1);
                for _ in 0..RESTS {
                    planner.hold(kontur_motion::cap::SpeedLimit::Stop);
                    driven.out.push(planner.setpoint().clone());
                }
                planner.resume();
            }
            Next::Rest | Next::Stopped => return driven,
        }
        assert!(driven.out.len() < 100_000, "does not come to an end");
    }
}

/// Cycles of a ride from rest to rest with constant acceleration: to the first one at or after its end.
fn cycles(length_mm: f64, v_mm_s: f64, a_mm_s2: f64) -> usize {
    ((length_mm / v_mm_s + v_mm_s / a_mm_s2) * 1000.0 - 1e-9).ceil() as usize
}

/// Linear slope, 100 mm at 50 mm/s with 1000 mm/s2: braking takes 1.25 mm and 50 ms.
#[test]
fn place_and_time_of_a_halt_on_a_line() {
    let job = Job::new(1.0, SlopeKind::Step);
    let blocks = [job.line(7, &[0.0, 0.0], &[100.0, 0.0], 50.0)];
    let driven = drive(&job, &[0.0, 0.0], &blocks, 425, 10.0);
    assert!(driven.taken);
    let (out, halt) = (&driven.out, driven.halt.unwrap());
    // 25 ms of the first 425 were lost in accelerating
    assert!((out[425].s_mm - 20.0).abs() < 1e-9);
    assert!((out[halt].s_mm - 30.0).abs() < 1e-9 && (out[halt].position[0] - 30.0).abs() < 1e-9);
    assert_eq!(halt, 425 + 175 + 50);
    // no dip before the braking
    assert!(out[100..600].iter().all(|p| (p.v_mm_s - 50.0).abs() < 1e-9));
    assert!(out[halt..=halt + RESTS].iter().all(|p| p.s_mm == out[halt].s_mm));
    assert_eq!(out.len() - 1, halt + RESTS + cycles(70.0, 50.0, 1000.0));
    assert_eq!(out.last().unwrap().position[0], 100.0);
    // the last point at which it can stop, and the path after the block
    assert!(drive(&job, &[0.0, 0.0], &blocks, 425, 1.25 + 1e-6).taken);
    for distance in [0.0, 1.0, 1.25 - 1e-6, 80.1] {
        let driven = drive(&job, &[0.0, 0.0], &blocks, 425, distance);
        assert!(!driven.taken && driven.halt.is_none(), "{distance}");
        assert_eq!(driven.out.len() - 1, cycles(100.0, 50.0, 1000.0), "{distance}");
    }
}

/// The path requests the blocks after a halt once it has left it, and passes the end of the block without a stop.
#[test]
fn a_halt_behind_what_was_pushed() {
    let job = Job::new(1.0, SlopeKind::Step);
    let cycle = CycleTime::from_us(1000).unwrap();
    let mut planner = Planner::new(cycle, 10, &[0.0, 0.0]);
    planner.push(job.line(1, &[0.0, 0.0], &[30.0, 0.0], 50.0));
    planner.halt_behind();
    while planner.setpoint().k < 225 {
        assert_eq!(planner.advance().unwrap(), Next::Setpoint);
    }
    let here = planner.setpoint().position.clone();
    assert!(planner.halt_in(1, &here, 5.0));
    while planner.advance().unwrap() == Next::Setpoint {}
    assert!(planner.halts() && (planner.setpoint().s_mm - here[0] - 5.0).abs() < 1e-9);
    planner.resume();
    assert_eq!(planner.advance().unwrap(), Next::Input);
    planner.push(job.line(2, &[30.0, 0.0], &[60.0, 0.0], 50.0));
    planner.finish();
    let mut slowest = f64::INFINITY;
    while planner.advance().unwrap() == Next::Setpoint {
        let Setpoint { s_mm, v_mm_s, .. } = planner.setpoint();
        if (20.0..50.0).contains(s_mm) {
            slowest = slowest.min(*v_mm_s);
        }
    }
    assert!((slowest - 50.0).abs() < 1e-9 && planner.setpoint().position[0] == 60.0);
}

/// Random polylines with every slope: an accepted halt is exactly at the requested point, on the contour and within the
/// limits; a refused one changes nothing.
#[test]
fn halts_of_random_programs() {
    let mut r = Random::new(20);
    let (mut taken, mut refused) = (0, 0);
    for case in 0..400 {
        let kinds = [SlopeKind::Step, SlopeKind::Trapez, SlopeKind::Sin2, SlopeKind::Hsc];
        let mut job = Job::new(1.0, kinds[case % 4]);
        job.window = r.pick(&[2, 10]);
        let mut points = vec![vec![0.0, 0.0]];
        for _ in 0..=r.below(15) {
            let last = points.last().unwrap().clone();
            points.push(vec![last[0] + r.between(-30.0, 30.0), last[1] + r.between(0.5, 30.0)]);
        }
        let feeds: Vec<f64> = (1..points.len()).map(|_| r.between(5.0, 300.0)).collect();
        let blocks: Vec<Block> = (1..points.len())
            .map(|i| job.line(i as u64, &points[i - 1], &points[i], feeds[i - 1]))
            .collect();
        let plain = drive(&job, &points[0], &blocks, u64::MAX, 0.0).out;
        let k = 1 + (r.between(0.0, 0.98) * (plain.len() - 2) as f64) as usize;
        let here = &plain[k];
        let distance = r.between(0.0, 20.0);
        let driven = drive(&job, &points[0], &blocks, k as u64, distance);
        let out = &driven.out;
        assert_eq!(out.last().unwrap().position, plain.last().unwrap().position, "{case}");
        let left: f64 = {
            let end = &points[here.seq as usize];
            libm::hypot(end[0] - here.position[0], end[1] - here.position[1])
        };
        if !driven.taken {
            refused += 1;
            assert!(driven.halt.is_none() && out.len() == plain.len(), "{case}");
            assert!(out.iter().zip(&plain).all(|(a, b)| a.s_mm == b.s_mm), "{case}");
            // four times the braking distance with constant acceleration is enough for every slope
            let surely = here.v_mm_s * here.v_mm_s / 2000.0 * 4.0 + here.v_mm_s * 0.3;
            assert!(distance < surely || distance > left - 1e-9, "{case}: {distance} of {left}");
            continue;
        }
        taken += 1;
        assert!(distance <= left + 1e-8, "{case}");
        let at = &out[driven.halt.unwrap()];
        assert!((at.s_mm - here.s_mm - distance).abs() < 1e-8, "{case}: {}", at.s_mm);
        assert_eq!((at.v_mm_s, at.seq), (0.0, here.seq), "{case}");
        let corners: Vec<&[f64]> = points.iter().map(Vec::as_slice).collect();
        for pair in out.windows(2) {
            let (a, b) = (&pair[0], &pair[1]);
            assert!(b.s_mm >= a.s_mm - 1e-12, "{case}: back at {}", b.k);
            assert!(b.v_mm_s <= feeds[b.seq as usize - 1] * (1.0 + 1e-9), "{case}");
            assert!(b.a_mm_s2.abs() <= 1000.0 * 2.0_f64.sqrt() + 1e-6, "{case}");
            assert!(common::deviation(&b.position, &corners) < 1e-9, "{case}");
        }
    }
    assert!(taken > 100 && refused > 50, "{taken} taken, {refused} refused");
}
