//! Counts evaluations of the closed forms of the look-ahead and set points of plans under examination, so that a test can
//! judge their cost without a clock.

use std::cell::Cell;

thread_local! {
    static COUNT: Cell<u64> = const { Cell::new(0) };
}

/// Counts one evaluation.
pub(crate) fn add() {
    COUNT.with(|c| c.set(c.get() + 1));
}

/// Evaluations since the last call.
pub(crate) fn take() -> u64 {
    COUNT.with(|c| c.replace(0))
}

mod tests {
    use super::take;
    use crate::axis::{AxisDynamics, AxisVec, FeedSlope, FeedholdSlope, RapidSlope, StepSlope};
    use crate::block::{Block, ChannelDynamics, Feed, Slope, SlopeKind, Tolerance};
    use crate::path::{ArcPath, ArcShape, LinePath, Path};
    use crate::planner::{Next, Planner};
    use crate::tolerance::Kernels;
    use kontur_filters::time::CycleTime;
    use kontur_filters::vib_guard::VibGuardSettings;
    use kontur_kit::Random;
    use std::sync::Arc;

    /// Lines and arcs with filters that differ, searched for a plan within the tolerance: set points computed per cycle of
    /// the motion.
    fn searched(r: &mut Random) -> f64 {
        let cycle = CycleTime::from_us(500).unwrap();
        let kernels = (0..3).map(|_| {
            let (mode, freq_hz) = (r.pick(&[1, 2, 3, 4]), r.log(10.0, 80.0));
            let guard = VibGuardSettings { mode, freq_hz, damping: 0.0 };
            Some(Arc::new(guard.kernel(cycle).unwrap()))
        });
        let mut planner = Planner::new(cycle, 120, &[0.0; 3]);
        planner.set_kernels(Kernels::new(kernels.collect()), 0);
        let (dynamics, tolerance_mm) = (dynamics(), r.log(0.005, 0.05));
        let mut from = AxisVec::zeros(3);
        for seq in 0..4 {
            let mut to: AxisVec = from.iter().map(|p| p + r.between(-8.0, 8.0)).collect();
            let path = if r.ratio() < 0.5 {
                Path::Line(LinePath::new(from, to.clone(), &[]).unwrap())
            } else {
                to[2] = from[2];
                let sweep_rad = r.between(0.5, 2.0);
                let aside = 0.5 / libm::tan(0.5 * sweep_rad);
                let [dx, dy] = [to[0] - from[0], to[1] - from[1]];
                let centre_mm = [from[0] + 0.5 * dx - aside * dy, from[1] + 0.5 * dy + aside * dx];
                let shape = ArcShape { plane: [0, 1], centre_mm, sweep_rad };
                Path::Arc(ArcPath::new(from, to.clone(), shape, &[true; 3]).unwrap())
            };
            from = to;
            let feed = Feed::PathVelocity(100.0);
            let block = Block::new(seq, path, feed, Arc::clone(&dynamics));
            let tolerance = Tolerance { ax_dev_mm: Some(tolerance_mm), acc_fact: 1.0 };
            let slope = Slope { kind: SlopeKind::Trapez, ..Slope::default() };
            planner.push(Block { slope, tolerance, ..block });
        }
        planner.finish();
        take();
        while planner.advance().unwrap() == Next::Setpoint {}
        assert!(planner.take_unkept().is_empty());
        take() as f64 / planner.setpoint().k as f64
    }

    #[test]
    fn a_search_measures_the_whole_plan_a_few_times() {
        let mut random = Random::new(5);
        let costs: Vec<f64> = (0..20).map(|_| searched(&mut random)).collect();
        let worst = costs.iter().copied().fold(0.0, f64::max);
        let mean = costs.iter().sum::<f64>() / costs.len() as f64;
        assert!(mean <= 8.0 && worst <= 30.0, "{mean} {worst}");
    }

    fn dynamics() -> Arc<ChannelDynamics> {
        let step = StepSlope { acc_mm_s2: [4000.0; 2], dec_mm_s2: [4000.0; 2], change_mm_s: 100.0 };
        let axis = AxisDynamics {
            v_max_mm_s: 1000.0,
            v_rapid_mm_s: 1000.0,
            a_max_mm_s2: 6000.0,
            a_emergency_mm_s2: 6000.0,
            tr_geom_s: 0.01,
            feed: FeedSlope { acc_mm_s2: 4000.0, dec_mm_s2: 4000.0, ramps_s: [0.02; 4] },
            rapid: RapidSlope { acc_mm_s2: 5000.0, ramp_s: 0.02 },
            feedhold: FeedholdSlope { step_dec_mm_s2: 5000.0, dec_mm_s2: 5000.0, ramp_s: 0.02 },
            step_feed: step,
            step_rapid: step,
            a_trans_ratio: 1.0,
            r_trans_ratio: 1.0,
            j_trans_kink_mm_s3: 0.0,
            j_trans_tangential_mm_s3: 0.0,
        };
        Arc::new(ChannelDynamics::new(vec![axis; 3]))
    }

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
        let dynamics = dynamics();
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
                Next::Rest | Next::Stopped => return take() as f64 / count as f64,
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
