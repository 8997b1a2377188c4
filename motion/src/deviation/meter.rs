//! Measures what is output, apart from the planner.

use super::gauge::{Gauge, loosest};
use crate::axis::AxisVec;
use crate::contour::{Contour, Passed};
use crate::tolerance::Unkept;

/// What has changed in a planner that the deviation of its output depends on, see [`Meter::take`].
#[derive(Clone, Debug)]
pub struct Change(pub(crate) What);

#[derive(Clone, Debug)]
pub(crate) enum What {
    /// The contour is another one.
    Contour(Contour),
    /// A block is put after the others.
    Enters(Passed),
    /// So many blocks lie out of reach.
    Leave(usize),
    /// Other filters, at rest at a position in a cycle.
    Kernels { reach_cycles: u32, differ: bool, at: Option<(u64, AxisVec)> },
    /// Least tolerance of any block so far in mm.
    Tolerance(f64),
    /// It has been reported that a plan does not keep the tolerance.
    Told,
}

/// The deviation of what a planner puts out and filters change, cycle by cycle, in both directions that `AX_DEV` bounds.
///
/// It follows the planner by its changes ([`crate::planner::Planner::take_changes`]) and may lag behind it, on another thread.
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
    /// Least tolerance of any block so far in mm, if one has any.
    least_tolerance_mm: Option<f64>,
    /// The set path between two set points, and what of the contour it misses, do not matter as long as no block has one.
    set_points_only: bool,
    excess: Excess,
}

/// What is known of an excess in what is output.
#[derive(Clone, Copy, Debug, Default)]
enum Excess {
    /// No cycle exceeded the tolerance of its blocks.
    #[default]
    None,
    /// One did, and this has not been taken yet.
    Found(Unkept),
    /// It has been reported, or that a plan does not keep the tolerance; later ones are not looked for.
    Told,
}

/// Share and mm by which the output may exceed a tolerance before it is reported: what a trace rounds away.
const ALLOWANCE: f64 = 1.001;
const ALLOWANCE_MM: f64 = 1e-6;

impl Meter {
    /// Measures nothing but the set points until a block has a tolerance: half of the work.
    pub fn set_points_only(&mut self) {
        self.set_points_only = true;
    }

    /// Takes a change of the planner, in their order.
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
                self.gauge = Gauge::new(reach_cycles, differ);
                // the line to the next set point starts here
                if let Some((k, position)) = at {
                    self.gauge.unfiltered(&self.contour, k, &position, self.wanted_mm());
                }
            }
            What::Tolerance(mm) => self.least_tolerance_mm = Some(mm),
            What::Told => self.excess = Excess::Told,
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

    /// Components of the shortest vector from the contour within reach of the filters to the set point of cycle `k`, whose
    /// interpolated point is `path`; returns its length in mm.
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

    /// Compares what is output with the loosest tolerance of the blocks that the filters hold.
    fn judge(&mut self, k: u64) {
        let most = self.gauge.found().iter().fold(0.0, |m: f64, c| m.max(c.abs()));
        let looked_for = matches!(self.excess, Excess::None);
        if !looked_for || most <= self.least_mm() {
            return;
        }
        let Some((tolerance_mm, seq)) = loosest(&self.contour, k, u64::from(self.reach_cycles))
        else {
            return;
        };
        if most > ALLOWANCE * tolerance_mm + ALLOWANCE_MM {
            self.excess = Excess::Found(Unkept { seq, deviation_mm: most, tolerance_mm });
        }
    }

    /// The first excess that was measured in what is output although the plan had kept the tolerance; each run has one at
    /// most.
    pub fn take_exceeded(&mut self) -> Option<Unkept> {
        let Excess::Found(unkept) = self.excess else { return None };
        self.excess = Excess::Told;
        Some(unkept)
    }

    /// Largest components in mm of what the set path leaves the contour by in this cycle, and of what it has missed of the
    /// contour that the filters have just let go: the two directions that `AX_DEV` bounds. `None` if only the set point was
    /// measured.
    pub fn excursion(&self) -> Option<&[f64]> {
        self.wanted_mm().map(|_| self.gauge.found())
    }
}
