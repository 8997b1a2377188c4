//! Rides compared with their limits, and with the whole of what they are made of.

use super::*;
use kontur_kit::Random;
use std::f64::consts::FRAC_PI_2;

/// Blocks with slowly varying limits, with noise, dips and blocks of other lengths.
fn cells(seed: u64, ramp: f64, shape: RampShape) -> Vec<Cell> {
    let mut r = Random::from_state(seed);
    let (waves, depth, noise) = (0.1 + r.ratio(), 60.0 * r.ratio(), 0.2 * r.ratio());
    let mut end = 0.0;
    (0..150)
        .map(|i| {
            end += if r.ratio() < 0.05 { 5.0 * r.ratio() + 0.01 } else { 0.2 };
            let smooth = 80.0 + depth * libm::sin(waves * end);
            let cap = smooth * (1.0 - noise * r.ratio());
            let ramps = [ramp, ramp, ramp, ramp];
            let acc = 3000.0 + 1000.0 * libm::sin(0.3 * end);
            let cap = if i == 149 { f64::INFINITY } else { cap };
            Cell { end, v: 150.0, cap, rates: Rates { shape, acc, dec: acc, ramps } }
        })
        .collect()
}

/// Limits that grow from block to block are touched exactly, each with a few ramps followed to their end.
#[test]
fn a_rise_touches_growing_limits_in_few_steps() {
    let cells: Vec<Cell> = (0..100_i32)
        .map(|i| {
            let (acc, ramps) = (3000.0 + f64::from(i % 7), [0.02; 4]);
            let (end, v) = (0.3 * f64::from(i + 1), 80.0 + 0.1 * f64::from(i));
            let rates = Rates { shape: RampShape::Trapez, acc, dec: acc, ramps };
            Cell { end, v, cap: f64::INFINITY, rates }
        })
        .collect();
    crate::closed_forms::take();
    let rise = climb(&own(&cells), 80.0, 0.0).unwrap();
    let per_block = crate::closed_forms::take() as f64 / cells.len() as f64;
    for cell in &cells {
        let inside = rise.iter().filter(|p| p.s > cell.end - 0.3 - 1e-9 && p.s < cell.end - 1e-9);
        let peak = inside.map(Phase::peak).fold(0.0, f64::max);
        assert!((peak / cell.v - 1.0).abs() <= 2.0 * SLACK, "{peak} {cell:?}");
    }
    assert!(per_block <= 15.0, "{per_block}");
}

/// Blocks at one feed rate, as in a contour of chords, whose acceleration changes from one to the next.
fn chords(seed: u64) -> Vec<Cell> {
    let mut r = Random::from_state(seed);
    let (waves, depth) = (r.ratio(), 2000.0 * r.ratio());
    let mut end = 0.0;
    (0..200)
        .map(|_| {
            end += 0.2 + 0.2 * r.ratio();
            let acc = 3000.0 + depth * libm::sin(waves * end);
            let rates = Rates { shape: RampShape::Trapez, acc, dec: acc, ramps: [0.02; 4] };
            Cell { end, v: 80.0, cap: f64::INFINITY, rates }
        })
        .collect()
}

/// Leaving out what nobody needs of rise and fall changes no bit, and saves much of both along a feed rate.
#[test]
fn a_ride_is_that_of_the_whole_rise_and_the_whole_fall() {
    let whole = |cells: &[Cell], start: (f64, f64), v1: f64| {
        let length = cells[cells.len() - 1].end;
        let cells = &joined(own(cells), Some((start.0, v1)))[..];
        let rise = climb(cells, start.0, start.1)?;
        let fall = turned(&climb(&mirror(cells), v1, 0.0)?, length);
        let known = &Known::whole();
        let speed = Meet { cells, rise: &rise, fall: &fall, v1, known }.speed()?;
        Some(Profile::over(speed, length))
    };
    let (mut found, mut short, mut long) = (0, 0, 0);
    for seed in 0..120 {
        let mut r = Random::from_state(seed);
        let at_feed = seed % 2 == 0;
        let cells = if at_feed { chords(seed) } else { cells(seed, 0.02, RampShape::Trapez) };
        let (v0, v1) = if r.chance(0.5) { (79.9, 0.0) } else { (0.0, 80.0 * r.ratio()) };
        let a0 = if v0 > 0.0 { 200.0 * (r.ratio() - 0.8) } else { 0.0 };
        crate::closed_forms::take();
        let ride = ride(&cells, (v0, a0), v1);
        let counted = crate::closed_forms::take();
        assert!(ride == whole(&cells, (v0, a0), v1), "{seed}");
        found += i32::from(ride.is_some());
        if at_feed && v0 > 0.0 {
            short += counted;
            long += crate::closed_forms::take();
        }
    }
    assert!(found > 80, "{found} of 120");
    assert!(4 * short < 3 * long, "{short} {long}");
}

/// Every phase is continuous and keeps velocity, acceleration and jerk of the blocks it lies in.
#[test]
fn a_ride_keeps_every_limit() {
    let mut found = 0;
    for seed in 0..60 {
        for (ramp, shape, peak) in [
            (0.02, RampShape::Trapez, 1.0),
            (0.005, RampShape::Trapez, 1.0),
            (0.02, RampShape::Sin2, FRAC_PI_2),
        ] {
            let cells = cells(seed, ramp, shape);
            let Some(profile) = ride(&cells, (0.0, 0.0), 0.0) else { continue };
            found += 1;
            let length = cells[cells.len() - 1].end;
            let n = 10_000;
            let dt = profile.duration() / f64::from(n);
            let mut before = profile.at(0.0);
            assert!(before.v_mm_s.abs() < 1e-12);
            for k in 1..=n {
                let now = profile.at(dt * f64::from(k));
                let i = cells.partition_point(|c| c.end < now.s_mm).min(cells.len() - 1);
                let near = &cells[i.saturating_sub(1)..(i + 2).min(cells.len())];
                let most = |f: &dyn Fn(&Cell) -> f64| near.iter().map(f).fold(0.0, f64::max);
                let acc = most(&|c| c.rates.acc);
                let jerk = peak * most(&|c| c.rates.acc / ramp);
                assert!(now.v_mm_s <= 150.0 * (1.0 + 1e-8), "{seed}: {now:?}");
                assert!(now.a_mm_s2.abs() <= acc * 1.01, "{seed}: {now:?} {acc}");
                assert!(now.j_mm_s3.abs() <= jerk * (1.0 + 1e-6), "{seed}: {now:?} {jerk}");
                let da = (now.a_mm_s2 - before.a_mm_s2).abs();
                assert!(da <= jerk * dt * 1.01 + 1e-3, "{seed}: jump {before:?} {now:?}");
                let dv = now.v_mm_s - before.v_mm_s;
                let mean = 0.5 * (now.a_mm_s2 + before.a_mm_s2);
                assert!((dv - mean * dt).abs() <= jerk * dt * dt + 2e-4, "{seed}: {now:?}");
                before = now;
            }
            assert!((before.s_mm - length).abs() < 1e-9 && before.v_mm_s.abs() < 1e-6);
            for cell in &cells {
                let v = profile.at(profile.time_at(cell.end)).v_mm_s;
                assert!(v <= cell.cap * (1.0 + 2e-6), "{seed}: {v} {cell:?}");
            }
        }
    }
    assert!(found > 140, "{found} of 180");
}
