//! A planner that its host stops from another thread in the middle of a search.

use crate::common::{Job, arc, machine};
use kontur_filters::time::CycleTime;
use kontur_kit::Random;
use kontur_motion::block::{Block, SlopeKind};
use kontur_motion::planner::{Next, Planner};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::Duration;

/// Positions up to the stop, or the end of the blocks.
fn drive(job: &Job, blocks: &[Block], stop: &Arc<AtomicBool>) -> (Vec<[u64; 2]>, Next) {
    let cycle = CycleTime::from_us(job.cycle_us).unwrap();
    let mut planner = Planner::new(cycle, job.window, &[0.0, 0.0]);
    planner.stop_with(Arc::clone(stop));
    planner.set_kernels(job.kernels(2), 0);
    let mut blocks = blocks.iter().cloned();
    let mut out = Vec::new();
    loop {
        match planner.advance().unwrap() {
            Next::Setpoint => {
                let at = &planner.setpoint().position;
                out.push([at[0].to_bits(), at[1].to_bits()]);
            }
            Next::Input => match blocks.next() {
                Some(block) => planner.push(block),
                None => planner.finish(),
            },
            end => return (out, end),
        }
    }
}

/// The output up to the stop is that of an undisturbed run, whatever the search was doing.
#[test]
fn a_stopped_planner_outputs_nothing_of_an_unfinished_search() {
    let mut random = Random::new(5);
    let mut job = Job::new(1.2, SlopeKind::Trapez).guarded(2, 8.0, 0.1, Some(0.001));
    job.dynamics = machine(2, 1.2, 3000.0, 0.02);
    let mut at = [0.0, 0.0];
    let mut blocks = Vec::new();
    for seq in 0..150 {
        let to = [at[0] + random.between(0.02, 0.4), at[1] + random.between(-0.3, 0.3)];
        blocks.push(job.line(seq, &at, &to, 80.0));
        at = to;
    }
    let whole = drive(&job, &blocks, &Arc::default());
    assert_eq!(whole.1, Next::Rest);
    for ms in [0, 1, 3, 10, 30, 100, 300] {
        let stop = Arc::new(AtomicBool::new(ms == 0));
        let set = Arc::clone(&stop);
        let other = thread::spawn(move || {
            thread::sleep(Duration::from_millis(ms));
            set.store(true, Ordering::Relaxed);
        });
        let (out, end) = drive(&job, &blocks, &stop);
        other.join().unwrap();
        assert_eq!(out[..], whole.0[..out.len()], "after {ms} ms");
        if ms == 0 {
            assert_eq!((out.len(), end), (0, Next::Stopped));
        }
    }
}

/// One block that is examined for minutes: 3e7 cycles on an arc.
#[test]
fn a_stop_ends_a_long_examination() {
    let job = Job::new(1.2, SlopeKind::Trapez).guarded(2, 8.0, 0.1, Some(1e-9));
    let path = arc(&[10.0, 0.0], &[-10.0, 0.0], [0.0, 0.0], std::f64::consts::PI);
    let blocks = [job.block(1, path, 1e-3)];
    let stop = Arc::new(AtomicBool::new(false));
    let set = Arc::clone(&stop);
    let other = thread::spawn(move || {
        thread::sleep(Duration::from_millis(50));
        set.store(true, Ordering::Relaxed);
    });
    let (out, end) = drive(&job, &blocks, &stop);
    other.join().unwrap();
    assert_eq!((out.len(), end), (0, Next::Stopped));
}
