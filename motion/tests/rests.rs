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
    let cases = [
        Case {
            kind: SlopeKind::Hsc,
            feed_mm_s: 517.0 / 60.0,
            ax_dev_mm: 0.01,
            guards: [(1, 80.0), (4, 30.0)],
            motions: vec![
                Motion::Line([3.0772, 0.8207]),
                Motion::Line([2.6368, 8.6852]),
                Motion::Arc(
                    [3.194_906_582_522_628, 9.003_556_145_234_363],
                    [2.831_380_402_907_233_6, 8.992_466_544_414_718],
                    -4.117_373_902_294_325,
                ),
                Motion::Arc(
                    [4.345_260_265_154_726, 9.149_599_581_684_37],
                    [3.777_099_168_545_849, 9.021_316_305_963_323],
                    3.333_159_668_784_183,
                ),
            ],
        },
        Case {
            kind: SlopeKind::Sin2,
            feed_mm_s: 2284.0 / 60.0,
            ax_dev_mm: 0.01,
            guards: [(3, 80.0), (1, 15.0)],
            motions: vec![
                Motion::Line([0.102, -0.0003]),
                Motion::Line([1.4996, 0.3836]),
                Motion::Arc(
                    [2.235_060_618_983_289, -4.758_906_061_790_845],
                    [2.193_089_027_158_829, -2.141_064_323_900_048],
                    -3.393_635_054_613_586_7,
                ),
            ],
        },
    ];
    for case in cases {
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
