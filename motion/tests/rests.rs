//! Compares plans with `AX_DEV` with plans that always keep it: one that dwells at every corner until the filters have
//! settled, and that of a lower feed rate.

use crate::common::{Job, arc, line};
use crate::spline::fast;
use kontur_filters::time::CycleTime;
use kontur_filters::vib_guard::VibGuardSettings;
use kontur_kit::Random;
use kontur_motion::block::{Block, Slope, SlopeKind, Tolerance};

/// A line to a point, or an arc with its centre and swept angle in rad.
#[derive(Clone, Copy)]
enum Motion {
    Line([f64; 2]),
    Arc([f64; 2], [f64; 2], f64),
}

struct Case {
    kind: SlopeKind,
    feed_mm_s: f64,
    ax_dev_mm: f64,
    /// Mode and frequency in Hz of the guard of each axis.
    guards: [(u8, f64); 2],
    motions: Vec<Motion>,
}

impl Case {
    /// Cycles of the contour; with rests, every block is planned alone and followed by a dwell as long as the filters.
    fn cycles(&self, rests: bool) -> usize {
        let guard = |(mode, freq_hz)| VibGuardSettings { mode, freq_hz, damping: 0.1 };
        let kernel = |guard: VibGuardSettings| guard.kernel(CycleTime::DEFAULT).unwrap();
        let kernels = self.guards.map(|settings| kernel(guard(settings))).to_vec();
        let length = kernels.iter().map(|k| k.length() as usize).max().unwrap();
        let job = Job {
            slope: Slope { kind: self.kind, ..Slope::default() },
            tolerance: Tolerance { ax_dev_mm: Some(self.ax_dev_mm), acc_fact: 1.0 },
            kernels,
            ..fast(2)
        };
        let mut at = [0.0; 2];
        let block = |(motion, seq): (&Motion, u64)| {
            let (Motion::Line(end) | Motion::Arc(end, ..)) = motion;
            let from = std::mem::replace(&mut at, *end);
            let path = match *motion {
                Motion::Line(_) => line(&from, end),
                Motion::Arc(_, centre_mm, sweep_rad) => arc(&from, end, centre_mm, sweep_rad),
            };
            job.block(seq, path, self.feed_mm_s)
        };
        let blocks: Vec<Block> = self.motions.iter().zip(1..).map(block).collect();
        let cycles =
            |blocks: &[Block]| job.run(blocks[0].path.start(), blocks.iter().cloned()).len() - 1;
        if rests {
            blocks.chunks(1).map(cycles).sum::<usize>() + (blocks.len() - 1) * length
        } else {
            cycles(&blocks)
        }
    }
}

/// Two lines and two arcs, and two short lines before an arc: filters that differ between the axes slowed whole blocks
/// to a crawl because of events at their ends (60788 cycles instead of 3726 with rests).
#[test]
fn filters_that_differ() {
    use Motion::{Arc, Line};
    #[rustfmt::skip]
    let cases = [
        (SlopeKind::Hsc, 517.0, [(1, 80.0), (4, 30.0)], vec![
            Line([3.0772, 0.8207]),
            Line([2.6368, 8.6852]),
            Arc([3.194906582522628, 9.003556145234363], [2.8313804029072336, 8.992466544414718], -4.117373902294325),
            Arc([4.345260265154726, 9.14959958168437], [3.777099168545849, 9.021316305963323], 3.333159668784183),
        ]),
        (SlopeKind::Sin2, 2284.0, [(3, 80.0), (1, 15.0)], vec![
            Line([0.102, -0.0003]),
            Line([1.4996, 0.3836]),
            Arc([2.235060618983289, -4.758906061790845], [2.193089027158829, -2.141064323900048], -3.3936350546135867),
        ]),
    ];
    for (kind, feed, guards, motions) in cases {
        let case = Case { kind, feed_mm_s: feed / 60.0, ax_dev_mm: 0.01, guards, motions };
        let [plain, rests] = [false, true].map(|rests| case.cycles(rests));
        assert!(plain as f64 <= 1.02 * rests as f64, "{plain} cycles, with rests {rests}");
    }
}

/// Up to four lines and arcs in random directions.
fn motions(r: &mut Random) -> Vec<Motion> {
    let mut at = [0.0_f64; 2];
    let motion = |_| {
        let (sin, cos) = libm::sincos(r.between(0.0, std::f64::consts::TAU));
        let from = at;
        if r.ratio() < 0.6 {
            let length = r.log(1.0, 20.0);
            at = [from[0] + length * cos, from[1] + length * sin];
            return Motion::Line(at);
        }
        let (radius, sweep) = (r.log(0.5, 6.0), r.between(-5.0, 5.0));
        let centre = [from[0] + radius * cos, from[1] + radius * sin];
        let (turn_sin, turn_cos) = libm::sincos(sweep);
        let arm = [-radius * cos, -radius * sin];
        at = [
            centre[0] + arm[0] * turn_cos - arm[1] * turn_sin,
            centre[1] + arm[0] * turn_sin + arm[1] * turn_cos,
        ];
        Motion::Arc(at, centre, sweep)
    };
    (0..4).map(motion).collect()
}

/// With filters that differ, the plan of a lower feed rate keeps the tolerance at any higher one: two lines took 0.56 s
/// at F6000 and 0.35 s at F4800.
#[test]
fn a_higher_feed_is_not_slower() {
    for n in 0..25 {
        let mut r = Random::new(n);
        let mut case = Case {
            kind: r.pick(&[SlopeKind::Hsc, SlopeKind::Trapez, SlopeKind::Sin2]),
            feed_mm_s: 0.0,
            ax_dev_mm: r.log(0.02, 0.2),
            guards: std::array::from_fn(|_| (r.pick(&[1, 2, 3, 4]), r.log(20.0, 60.0))),
            motions: motions(&mut r),
        };
        let mut least = usize::MAX;
        for feed_mm_s in [20.0, 40.0, 60.0, 80.0, 120.0, 200.0] {
            case.feed_mm_s = feed_mm_s;
            let cycles = case.cycles(false);
            assert!(
                cycles as f64 <= 1.05 * least as f64 + 2.0,
                "{n}: {feed_mm_s} mm/s takes {cycles} cycles, a lower feed {least}"
            );
            least = least.min(cycles);
        }
    }
}
