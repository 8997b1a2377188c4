//! Even speeds at the kinks ahead, as demands before any trial.

use super::demands::Demands;
use super::even::{ALIKE, Evenly, aim, fastest};
use super::kernels::Kernels;
use super::marks::STRAIGHT;
use crate::contour::Contour;
use crate::queue::Queued;
use kontur_filters::time::CycleTime;
use std::sync::Arc;

/// Rounds that refine a guess.
const ROUNDS: u32 = 8;

/// A kink of the contour ahead.
struct Kink {
    /// Boundary of the window; `s`: path length there.
    boundary: usize,
    s: f64,
    /// Length of the change of direction.
    turn: f64,
    /// Whether the path turns back by more than 90 deg.
    acute: bool,
    tolerance_mm: f64,
    /// Highest speed in mm/s of the two adjacent blocks.
    feed: f64,
}

/// The kinks of a window, with what a filter makes of them.
struct Ahead<'a> {
    evenly: Evenly<'a>,
    window: &'a [Arc<Queued>],
    kinks: Vec<Kink>,
    /// First moment of the filter in s (`M1`).
    m1: f64,
    /// Largest distance in s of what the filter holds from its mean.
    side: f64,
}

impl Ahead<'_> {
    /// Part in mm of a kink in the deviation at kink `i`: the mean path beyond a kink falls with the distance from it, below a
    /// straight line to the end of the filter.
    fn part(&self, kink: &Kink, i: usize, speed: f64) -> f64 {
        kink.turn * self.m1 * (speed - (kink.s - self.kinks[i].s).abs() / self.side)
    }

    /// The parts, at a speed in mm/s, of the kinks around kink `i`.
    fn parts(&self, i: usize, speed: f64) -> impl Iterator<Item = f64> {
        let part = move |kink: &Kink| self.part(kink, i, speed);
        let behind = self.kinks[i..].iter().map(part).take_while(|p| *p > 0.0);
        let ahead = self.kinks[..i].iter().rev().map(part);
        behind.chain(ahead.take_while(|p| *p > 0.0))
    }

    /// Even speed in mm/s around kink `i`, at most its feed.
    fn speed(&self, i: usize) -> f64 {
        let kink = &self.kinks[i];
        let aim = aim(kink.tolerance_mm);
        let mut guess = kink.feed.min(aim / (self.m1 * kink.turn));
        for _ in 0..ROUNDS {
            let sum: f64 = self.parts(i, guess).sum();
            if sum <= aim {
                break;
            }
            guess *= (aim / sum).max(0.5);
        }
        if guess >= kink.feed {
            return kink.feed;
        }
        let point = self.window[kink.boundary].block.path.start();
        fastest(guess, 1e-3 * guess, kink.feed, |speed| {
            self.evenly.stays(kink.s, speed, aim)
                && (!kink.acute || self.evenly.misses(point, kink.s, speed) <= aim)
        })
    }
}

/// Whether the filters are equal and without overshoot: the speeds at kinks are then known before any trial.
pub(super) fn foresees(kernels: &Kernels) -> bool {
    kernels.any() && !kernels.unequal && !kernels.overshoot
}

/// Demands even speeds at the kinks of a window that begins at path length `start`, and between kinks within reach of
/// each other; false if this changes nothing. Kinks too close to the end of the window are examined again when more
/// blocks are known.
pub(super) fn foresee(
    demands: &mut Demands,
    window: &[Arc<Queued>],
    past: &Contour,
    start: f64,
    (kernels, cycle): (&Kernels, CycleTime),
) -> bool {
    let Some(kernel) = kernels.longest().filter(|_| foresees(kernels)) else { return false };
    let (contour, end) = continued(past, window, start);
    let between = (f64::NEG_INFINITY, f64::INFINITY);
    let evenly = Evenly { contour: &contour, kernels, cycle, between };
    let [m1, reach] =
        [kernel.m1_cycles(), f64::from(kernel.length())].map(|cycles| cycles * cycle.seconds());
    let delay = kernel.delay_cycles() * cycle.seconds();
    let side = delay.max(reach - delay);
    let ahead = Ahead { evenly, window, kinks: kinks(window, start), m1, side };
    let first = ahead.kinks.partition_point(|k| k.boundary < demands.foreseen).saturating_sub(1);
    demands.foreseen = window.len();
    let mut before: Option<(&Kink, f64)> = None;
    let mut changes = false;
    for (i, kink) in ahead.kinks.iter().enumerate().skip(first) {
        let even = ahead.speed(i);
        if kink.s + even * reach > end {
            demands.foreseen = demands.foreseen.min(kink.boundary);
        }
        let largest = ahead.parts(i, even).fold(0.0, f64::max);
        if even >= kink.feed || ahead.part(kink, i, even) < ALIKE * largest {
            continue;
        }
        let cap = &mut demands.cap[kink.boundary];
        changes |= even < *cap;
        *cap = cap.min(even);
        if let Some((other, speed)) = before {
            let speed = speed.max(even);
            if kink.s - other.s <= speed * reach {
                for feed in &mut demands.feed[other.boundary..kink.boundary] {
                    *feed = feed.min(speed);
                }
            }
        }
        before = Some((kink, even));
    }
    changes
}

/// A contour continued by a window that begins at path length `start`, and the path length at its end.
fn continued(past: &Contour, window: &[Arc<Queued>], start: f64) -> (Contour, f64) {
    let (mut contour, mut end) = (past.clone(), start);
    for queued in window {
        contour.enter(f64::INFINITY, end, Arc::clone(queued));
        end += queued.length;
    }
    (contour, end)
}

/// The kinks of a window that begins at path length `start`.
fn kinks(window: &[Arc<Queued>], start: f64) -> Vec<Kink> {
    let mut s = start;
    let mut out = Vec::new();
    for (b, pair) in window.windows(2).enumerate() {
        let [from, to] = [&pair[0], &pair[1]];
        s += from.length;
        let tolerances = [from, to].map(|q| q.block.tolerance.ax_dev_mm.unwrap_or(f64::INFINITY));
        let tolerance_mm = tolerances[0].min(tolerances[1]);
        let (out_of, into) = (&from.ends.tangent_out, &to.ends.tangent_in);
        let turns = out_of.iter().zip(into.iter()).map(|(a, b)| (b - a) * (b - a));
        let turn = turns.sum::<f64>().sqrt();
        // the remainder of a block continues without a kink
        if turn <= STRAIGHT || to.offset > 0.0 || tolerance_mm.is_infinite() {
            continue;
        }
        let acute = out_of.iter().zip(into.iter()).map(|(a, b)| a * b).sum::<f64>() < 0.0;
        let feed = from.velocity.v_mm_s.max(to.velocity.v_mm_s);
        out.push(Kink { boundary: b + 1, s, turn, acute, tolerance_mm, feed });
    }
    out
}
