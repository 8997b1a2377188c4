//! Blocks on which overrides and feedholds act.

use super::Job;
use kontur_filters::time::CycleTime;
use kontur_motion::block::Block;
use kontur_motion::planner::{Next, Planner, Setpoint};
use kontur_motion::profile::Infeasible;
use kontur_motion::realtime::{FeedholdBraking, OverrideMode, OverrideRatios};

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Event {
    Override(f64),
    Rapid(f64, f64),
    Hold(FeedholdBraking),
    Release,
}

/// Drives blocks; every event takes effect after the cycle of its number.
pub(crate) fn drive(
    job: &Job,
    start: &[f64],
    blocks: Vec<Block>,
    events: &[(u64, Event)],
) -> Result<Vec<Setpoint>, Infeasible> {
    let cycle = CycleTime::from_us(job.cycle_us).unwrap();
    let mut planner = Planner::new(cycle, job.window, start);
    planner.set_override_mode(OverrideMode::OfReached);
    planner.set_kernels(job.kernels(start.len()), 0);
    let mut blocks = blocks.into_iter();
    let mut events = events.iter().peekable();
    let mut out = vec![planner.setpoint().clone()];
    loop {
        while let Some((_, event)) = events.next_if(|e| e.0 <= planner.setpoint().k) {
            match *event {
                Event::Override(r) => planner.set_override(OverrideRatios { feed: r, rapid: r }),
                Event::Rapid(feed, rapid) => planner.set_override(OverrideRatios { feed, rapid }),
                Event::Hold(braking) => planner.feedhold(true, braking),
                Event::Release => planner.feedhold(false, FeedholdBraking::Active),
            }
        }
        match planner.advance()? {
            Next::Setpoint => out.push(planner.setpoint().clone()),
            Next::Input => match blocks.next() {
                Some(b) => planner.push(b),
                None => planner.finish(),
            },
            Next::Rest | Next::Stopped => break,
        }
        assert!(out.len() < 1_000_000, "does not come to an end");
    }
    assert!(planner.take_unkept().is_empty());
    Ok(out)
}
