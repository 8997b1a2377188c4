//! Counts the closed forms of the look-ahead, so that a test can judge its cost without a clock.

use std::cell::Cell;

thread_local! {
    static COUNT: Cell<u64> = const { Cell::new(0) };
}

/// One evaluation.
pub(crate) fn add() {
    COUNT.with(|c| c.set(c.get() + 1));
}

/// Evaluations since the last call.
fn take() -> u64 {
    COUNT.with(|c| c.replace(0))
}

mod tests {
    use super::take;
    use crate::block::{Slope, SlopeKind};
    use crate::example::{Arc, AxisVec, Block, ChannelDynamics, Feed, LinePath, Path};
    use crate::planner::{Next, Planner};
    use kontur_filters::time::CycleTime;

    /// Rows of 50 mm over a wavy surface in steps of 0.2 mm.
    fn point(i: usize) -> AxisVec {
        let (row, column) = (i / 250, i % 250);
        let along = if row % 2 == 0 { column } else { 249 - column } as f64 * 0.2;
        let across = (row % 100) as f64 * 0.3;
        let z = 2.0 * libm::sin(along * 0.3) * libm::cos(across * 0.2);
        AxisVec::from_slice(&[along, across, z])
    }

    /// Stairs of 0.1 um: hundreds of blocks per cycle.
    fn stair(i: usize) -> AxisVec {
        AxisVec::from_slice(&[1e-4 * i.div_ceil(2) as f64, 1e-4 * (i / 2) as f64, 0.0])
    }

    /// Evaluations per block.
    fn cost(count: usize, kind: SlopeKind, point: fn(usize) -> AxisVec) -> f64 {
        let dynamics = Arc::new(ChannelDynamics::new(vec![crate::example::axis(); 3]));
        let mut planner = Planner::new(CycleTime::DEFAULT, 120, &point(0));
        let mut i = 0;
        take();
        loop {
            match planner.advance().unwrap() {
                Next::Setpoint => {}
                Next::Input if i < count => {
                    let line = LinePath::new(point(i), point(i + 1), &[]).unwrap();
                    i += 1;
                    let feed = Feed::PathVelocity(150.0);
                    let block = Block::new(i as u64, Path::Line(line), feed, Arc::clone(&dynamics));
                    let optimised = kind == SlopeKind::Sin2;
                    let slope = Slope { kind, optimised, ..Slope::default() };
                    planner.push(Block { slope, ..block });
                }
                Next::Input => planner.finish(),
                Next::Rest => return take() as f64 / count as f64,
            }
        }
    }

    #[test]
    fn many_short_blocks_cost_the_same_per_block_as_few() {
        for kind in [SlopeKind::Step, SlopeKind::Trapez, SlopeKind::Hsc, SlopeKind::Sin2] {
            let (few, many) = (cost(1_000, kind, point), cost(150_000, kind, point));
            println!("{kind:?}: {few:.2} and {many:.2} evaluations per block");
            assert!(many <= 1.15 * few, "{kind:?}: {many} after {few}");
        }
    }

    #[test]
    fn steps_of_a_tenth_of_a_micrometre_cost_no_more_as_they_get_many() {
        for kind in [SlopeKind::Trapez, SlopeKind::Hsc] {
            let (few, many) = (cost(1_000, kind, stair), cost(4_000, kind, stair));
            println!("{kind:?}: {few:.2} and {many:.2} evaluations per block of 0.1 um");
            assert!(many <= 1.5 * few && many <= 1000.0, "{kind:?}: {many} after {few}");
        }
    }
}
