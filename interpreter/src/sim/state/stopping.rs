//! Progress of the stop after a fault.

use crate::diag::Condition;
use crate::exec::SourceRef;
use kontur_filters::time::CycleTime;

/// Number of cycles of standstill shown after the stop of a fault.
const CYCLES_AT_REST: u32 = 5;

/// Longest wait in s, after the set positions have stopped, for axes that do not come to rest.
const LONGEST_COASTING_S: f64 = 2.0;

/// Progress of the stop after a fault.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(in crate::sim) struct Stopping {
    pub(in crate::sim) settled_cycles: u32,
    /// Block of the wait that was interrupted.
    pub(in crate::sim) waited_at: Option<SourceRef>,
    pub(in crate::sim) coasting_cycles: u32,
    /// Conditions already reported: an oscillating axis reaches its limits again and again.
    pub(in crate::sim) told: Vec<(usize, Condition)>,
}

impl Stopping {
    /// Whether the axis has not reported this condition since the stop began.
    pub(in crate::sim) fn is_new(&mut self, chain: usize, condition: Condition) -> bool {
        let new = !self.told.contains(&(chain, condition));
        if new {
            self.told.push((chain, condition));
        }
        new
    }

    /// One cycle with the set positions and the axes at rest or not; true at the end of the run.
    pub(in crate::sim) fn is_over(
        &mut self,
        set_rests: bool,
        axes_stand: bool,
        cycle: CycleTime,
    ) -> bool {
        self.coasting_cycles = if set_rests { self.coasting_cycles + 1 } else { 0 };
        let longest = LONGEST_COASTING_S / cycle.seconds();
        let rests = set_rests && (axes_stand || f64::from(self.coasting_cycles) > longest);
        self.settled_cycles = if rests { self.settled_cycles + 1 } else { 0 };
        self.settled_cycles > CYCLES_AT_REST
    }
}
