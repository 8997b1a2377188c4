//! The excesses of a plan that even speeds have answered, and where these cost more than the excesses do.
//!
//! Even speeds are demanded for a whole window. Far from the excesses the plan need not be slower than the one that
//! exceeded the tolerance: there the even speeds cost time for nothing, which another search could save. So they do next
//! to a small excess. An excess of many tolerances requires about the even speed in any search.

use super::violation::Violation;
use crate::timeline::Entry;
use kontur_filters::time::CycleTime;

/// Mean excess in tolerances from which on the even speeds next to the excesses count as necessary.
const LARGE: f64 = 4.0;

/// A plan that exceeded the tolerance.
#[derive(Clone, Debug)]
pub(super) struct Answered {
    /// Cycles of its excesses, at most one of each direction per half kernel.
    cycles: Vec<u64>,
    /// Sum of these excesses in tolerances.
    excess: f64,
    /// Times in cycles at which it enters its blocks, and at which it ends.
    entered: Vec<f64>,
}

impl Answered {
    /// A plan with its excesses.
    pub(super) fn new<'v>(
        excesses: impl Iterator<Item = &'v Exceeded>,
        plan: &[Entry],
        cycle: CycleTime,
    ) -> Self {
        let (mut cycles, mut excess) = (Vec::new(), 0.0);
        for e in excesses {
            cycles.push(e.cycle);
            excess += e.tolerances;
        }
        Self { cycles, excess, entered: entered(plan, cycle) }
    }

    /// Number of excesses.
    pub(super) fn count(&self) -> usize {
        self.cycles.len()
    }

    /// Number of cycles that a plan, given by the times at which it enters its blocks, has lost against this one for
    /// nothing: where the excesses are large, on those blocks of which no cycle lies within `beside` (before, behind) of
    /// an excess; otherwise on all. Infinite if the plan has other blocks.
    pub(super) fn lost(&self, entered: &[f64], beside: (f64, f64)) -> f64 {
        if entered.len() != self.entered.len() {
            return f64::INFINITY;
        }
        let large = self.excess >= LARGE * self.cycles.len() as f64;
        let blocks = self.entered.windows(2).zip(entered.windows(2));
        let lost = blocks.map(|(was, now)| {
            let near = |k: &u64| {
                let k = *k as f64;
                was[0] <= k + beside.1 && k - beside.0 <= was[1]
            };
            if !large || !self.cycles.iter().any(near) {
                (now[1] - now[0]) - (was[1] - was[0])
            } else {
                0.0
            }
        });
        lost.sum()
    }
}

/// A place where a plan exceeds the tolerance.
#[derive(Clone, Copy, Debug)]
pub(super) struct Exceeded {
    pub(super) cycle: u64,
    /// Whether a point of the contour is missed there.
    pub(super) missed: bool,
    /// The excess in tolerances.
    tolerances: f64,
}

impl Exceeded {
    pub(super) fn of(v: &Violation) -> Self {
        let tolerances = v.excess() / v.tolerance_mm;
        Self { cycle: v.cycle, missed: v.missed.is_some(), tolerances }
    }
}

/// Times in cycles at which a plan enters its blocks, and at which it ends.
pub(crate) fn entered(plan: &[Entry], cycle: CycleTime) -> Vec<f64> {
    let blocks = plan.iter().flat_map(|e| e.entries(cycle)).map(|(cycles, ..)| cycles);
    blocks.chain(plan.last().map(|e| e.end.cycles(cycle))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use kontur_kit::near;

    /// Four blocks of 100 cycles each, which take 110, 130, 150 and 120 cycles in the other plan.
    #[test]
    fn only_next_to_large_excesses_is_lost_time_necessary() {
        let entered = vec![0.0, 100.0, 200.0, 300.0, 400.0];
        let slower = [0.0, 110.0, 240.0, 390.0, 510.0];
        let lost = |excess: f64, beside: (f64, f64)| {
            let answered = Answered { cycles: vec![150], excess, entered: entered.clone() };
            answered.lost(&slower, beside)
        };
        let all = 10.0 + 30.0 + 50.0 + 20.0;
        near(lost(0.5, (20.0, 20.0)), all, 1e-9);
        near(lost(5.0, (20.0, 20.0)), all - 30.0, 1e-9);
        near(lost(5.0, (60.0, 20.0)), all - 10.0 - 30.0, 1e-9);
        near(lost(5.0, (20.0, 60.0)), all - 30.0 - 50.0, 1e-9);
        let parts = Answered { cycles: vec![150], excess: 5.0, entered: entered[1..].to_vec() };
        assert!(parts.lost(&slower, (20.0, 20.0)).is_infinite());
    }
}
