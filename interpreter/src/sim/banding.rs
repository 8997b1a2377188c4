//! Edge banding: a motion stops once after the signal of the probe, and continues.
//!
//! Until then the planner requests nothing beyond the motion, so that the path would rest at its end; after the stop it
//! passes the end like any other.

use super::state::{Banding, Phase, Simulation};
use super::wait::Wait;
use crate::diag::{Condition, Diagnostic};
use crate::exec::{BandingRun, Event};

impl Simulation {
    /// Registers the start of the motion.
    pub(super) fn begin_banding(&mut self, run: BandingRun) {
        let (seq, source) = (self.planner.setpoint().seq, self.blocks.current);
        let before_mm = self.actual_mm();
        self.banding = Some(Banding { run, seq, source, before_mm, signalled: false });
        if self.inputs.probe {
            let text = "the probe is actuated before the edge banding motion begins";
            self.banding_fails(Condition::ProbeActuated, text);
        }
    }

    /// Checks for the signal after a cycle; if it is present, the path ends at its stop from the next cycle on.
    pub(super) fn watch_banding(&mut self) {
        let waits = self.banding.as_ref().is_some_and(|banding| !banding.signalled);
        if !waits || !matches!(self.phase, Phase::Running | Phase::Waiting(_)) {
            return;
        }
        let now_mm = self.actual_mm();
        let Some(banding) = &mut self.banding else { return };
        let signal = banding.latched(&self.inputs, &now_mm);
        banding.before_mm = now_mm;
        let Some(mut place) = signal else { return };
        banding.signalled = true;
        let (seq, way_mm) = (banding.seq, banding.run.way_mm);
        let k = self.planner.setpoint().k;
        for (p, x) in place.iter_mut().enumerate() {
            *x -= self.independent.way_mm(p, k);
        }
        if !self.planner.halt_in(seq, &place, way_mm) {
            let text =
                "the block is too short or the path too fast for the distance after the signal";
            self.banding_fails(Condition::BandingPath, text);
        }
    }

    /// Handles the rest of the path at its stop, or at the end of the motion.
    pub(super) fn at_halt(&mut self) {
        self.expect_stops();
        self.phase = Phase::Waiting(Wait::for_halt());
    }

    /// Calls the function once the axes are in their windows; the path waits for it.
    pub(super) fn call_at_halt(&mut self) {
        let Some(Banding { run, signalled, source, .. }) = self.banding else { return };
        if !signalled {
            let text = "the probe has not signalled during the edge banding motion";
            self.banding_fails(Condition::NoProbeSignal, text);
            return;
        }
        let BandingRun { number, value, seconds, .. } = run;
        self.act(Event::MFunction { number, value }, self.planner.setpoint().k);
        self.blocks.waits_at = source;
        self.phase = Phase::Waiting(Wait::before_resuming(seconds, self.cycle));
    }

    /// Lets the path continue.
    pub(super) fn resume(&mut self) {
        self.banding = None;
        self.planner.resume();
    }

    fn banding_fails(&mut self, condition: Condition, text: &str) {
        let k = self.planner.setpoint().k;
        let mut d = Diagnostic::new(condition, text);
        (d.cycle, d.time_s) = (Some(k), Some(self.cycle.time_of(k)));
        d.source = self.banding.as_ref().and_then(|b| self.program.locate(b.source));
        self.messages.own.push(d);
        self.stop(Vec::new());
    }
}
