//! Measures the deviation of the output, separately from the planner.

use super::Unkept;
use super::gauge::{Gauge, loosest};
use crate::axis::AxisVec;
use crate::contour::{Contour, Passed};

/// A change in a planner that affects the deviation of its output, see [`Meter::take`].
#[derive(Clone, Debug)]
pub struct Change(pub(crate) What);

#[derive(Clone, Debug)]
pub(crate) enum What {
    /// The contour is replaced.
    Contour(Contour),
    /// A block is appended.
    Enters(Passed),
    /// This number of blocks is out of reach.
    Leave(usize),
    /// The filters are replaced, at rest at a position in a cycle.
    Kernels { reach_cycles: u32, differ: bool, at: Option<(u64, AxisVec)> },
    /// Least tolerance of any block so far in mm.
    Tolerance(f64),
    /// A plan that does not keep the tolerance has been reported.
    Told,
}

/// The deviation of the output of a planner after the filters, cycle by cycle, in both directions that `AX_DEV` bounds.
///
/// It follows the planner by the changes of the latter ([`crate::planner::Planner::take_changes`]) and may do so later,
/// on another thread.
///
/// Order of calls: in each cycle [`Self::take`] for the changes up to it, then [`Self::filtered`] or [`Self::unfiltered`].
///
/// ```
/// # mod doc { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/axis.rs")); }
/// # use doc::*;
/// # use kontur_filters::time::CycleTime;
/// use kontur_motion::deviation::Meter;
/// use kontur_motion::planner::{Next, Planner};
///
/// let mut planner = Planner::new(CycleTime::from_us(1000).unwrap(), 10, &[0.0, 0.0]);
/// planner.report_changes(true);
/// planner.push(block(1, [0.0, 0.0], [5.0, 0.0], 50.0));
/// planner.finish();
/// let (mut meter, mut aside) = (Meter::default(), [0.0; 2]);
/// while planner.advance().unwrap() == Next::Setpoint {
///     planner.take_changes().for_each(|change| meter.take(change));
///     let at = planner.setpoint();
///     // something moves the second axis 0.1 mm off the contour
///     let set = [at.position[0], 0.1];
///     assert_eq!(meter.filtered(at.k, &set, &at.position, &mut aside), 0.1);
///     assert_eq!(aside, [0.0, 0.1]);
/// }
/// ```
#[derive(Clone, Debug, Default)]
pub struct Meter {
    contour: Contour,
    gauge: Gauge,
    reach_cycles: u32,
    /// Least tolerance of any block so far in mm, if any block has one.
    least_tolerance_mm: Option<f64>,
    /// Whether only set points are measured, without the path between them and the contour it misses, until a block has
    /// a tolerance.
    set_points_only: bool,
    excess: Excess,
}

/// State of the search for an excess in the output.
///
/// A corner is exceeded in many cycles: while the set path leaves the contour beside it, and again when the points of the
/// contour around it leave the filters.
#[derive(Clone, Copy, Debug, Default)]
enum Excess {
    /// No cycle has exceeded the tolerance of its blocks.
    #[default]
    None,
    /// A corner is exceeded, so far by most in cycle `worst`, the last time in cycle `last`.
    Growing { most: Unkept, worst: u64, last: u64 },
    /// The largest excess of this corner is known; it has not been taken yet.
    Found(Unkept),
    /// An excess, or a plan that does not keep the tolerance, has been reported; later ones are not searched for.
    Told,
}

/// Factor and mm by which the output may exceed a tolerance before it is reported: the rounding of a trace.
const ALLOWANCE: f64 = 1.001;
const ALLOWANCE_MM: f64 = 1e-6;

impl Meter {
    /// Measures only the set points until a block has a tolerance, which halves the work.
    pub fn set_points_only(&mut self) {
        self.set_points_only = true;
    }

    /// Applies a change of the planner; changes have to come in their order.
    pub fn take(&mut self, Change(what): Change) {
        match what {
            What::Contour(contour) => {
                self.contour = contour;
                self.gauge.look_anew();
            }
            What::Enters(passed) => self.contour.append(passed),
            What::Leave(count) => self.contour.forget(count),
            What::Kernels { reach_cycles, differ, at } => {
                self.reach_cycles = reach_cycles;
                self.gauge = self.gauge.with(reach_cycles, differ);
                // the line to the next set point starts here
                if let Some((k, position)) = at {
                    self.gauge.unfiltered(&self.contour, k, &position, self.wanted_mm());
                }
            }
            What::Tolerance(mm) => self.least_tolerance_mm = Some(mm),
            What::Told => {
                if let Excess::None = self.excess {
                    self.excess = Excess::Told;
                }
            }
        }
    }

    fn least_mm(&self) -> f64 {
        self.least_tolerance_mm.unwrap_or(f64::INFINITY)
    }

    /// The least tolerance, if both directions are measured.
    fn wanted_mm(&self) -> Option<f64> {
        let wanted = !self.set_points_only || self.least_tolerance_mm.is_some();
        wanted.then(|| self.least_mm())
    }

    /// Sets `out` to the components of the shortest vector to the set point of cycle `k` from the contour within reach
    /// of the filters; returns its length in mm. `path` is the interpolated point of the cycle.
    pub fn filtered(&mut self, k: u64, set: &[f64], path: &[f64], out: &mut [f64]) -> f64 {
        self.gauge.step(&self.contour, k, (set, path), self.wanted_mm());
        debug_assert_eq!(
            self.gauge.shortest().map(|(length_mm, _)| length_mm),
            self.contour
                .nearest(set, k as f64 - f64::from(self.reach_cycles), k as f64, out)
                .map(|nearest| nearest.distance),
            "blocks left out are not the nearest"
        );
        self.judge(k);
        if let Some((length_mm, vector)) = self.gauge.shortest() {
            out.copy_from_slice(vector);
            length_mm
        } else {
            out.fill(0.0);
            0.0
        }
    }

    /// Replaces [`Self::filtered`] in a cycle whose set point is the interpolated one.
    pub fn unfiltered(&mut self, k: u64, point: &[f64]) {
        self.gauge.unfiltered(&self.contour, k, point, self.wanted_mm());
        self.judge(k);
    }

    /// Compares the output with the loosest tolerance of the blocks that the filters hold.
    fn judge(&mut self, k: u64) {
        if self.least_tolerance_mm.is_none() {
            return;
        }
        let reach = u64::from(self.reach_cycles);
        let growing = match self.excess {
            Excess::None => None,
            Excess::Growing { most, last, .. } if k > last + reach + 2 => {
                self.excess = Excess::Found(most);
                return;
            }
            Excess::Growing { most, worst, .. } => Some((most, worst)),
            Excess::Found(_) | Excess::Told => return,
        };
        let largest = self.gauge.found().iter().fold(0.0, |m: f64, c| m.max(c.abs()));
        if largest <= self.least_mm() {
            return;
        }
        let Some((tolerance_mm, seq)) = loosest(&self.contour, k, reach) else { return };
        if largest > ALLOWANCE * tolerance_mm + ALLOWANCE_MM {
            let here = Unkept { seq, deviation_mm: largest, tolerance_mm };
            let over = |u: &Unkept| u.deviation_mm - u.tolerance_mm;
            let before = growing.filter(|(most, _)| over(most) >= over(&here));
            let (most, worst) = before.unwrap_or((here, k));
            self.excess = Excess::Growing { most, worst, last: k };
        }
    }

    /// The cycle of the largest excess of a corner whose remainder may exceed the tolerance by more.
    pub fn exceeds_most_at(&self) -> Option<u64> {
        let Excess::Growing { worst, .. } = self.excess else { return None };
        Some(worst)
    }

    /// Ends the output: nothing more can be exceeded.
    pub fn end(&mut self) {
        if let Excess::Growing { most, .. } = self.excess {
            self.excess = Excess::Found(most);
        }
    }

    /// The largest excess of the first corner that exceeds the tolerance in the output of a plan that keeps it, once this
    /// corner has left the filters or the output has ended; at most one per run.
    pub fn take_exceeded(&mut self) -> Option<Unkept> {
        let Excess::Found(unkept) = self.excess else { return None };
        self.excess = Excess::Told;
        Some(unkept)
    }

    /// Largest components in mm of the two directions that `AX_DEV` bounds: how far the set path leaves the contour in
    /// this cycle, and by how much it has missed the part of the contour that has just left the filters. `None` if only
    /// the set point was measured.
    pub fn excursion(&self) -> Option<&[f64]> {
        self.wanted_mm().map(|_| self.gauge.found())
    }
}
