//! The steps of the program: taken from the executor when the planner needs them, and carried out at rest.

use super::state::{After, Pending, Phase, Simulation, Thread, Underway};
use super::{times, wait};
use crate::exec::{AtCorner, EndReason, Event, SourceRef, Step, Sync};
use crate::record::Motion;
use crate::sim::driver::Driver;
use crate::sim::totals::Programmed;
use crate::sim::wait::{AwaitedMark, Wait};
use kontur_motion::block::{Block, SlopeKind};

fn runs_banding(events: &[Event]) -> bool {
    events.iter().any(|event| matches!(event, Event::Banding(_)))
}

impl Simulation {
    /// Takes the next step of the program.
    pub(super) fn pull(&mut self) {
        if self.smoothing.resume(&mut self.planner) {
            return;
        }
        let step = self.queue.postponed.take().unwrap_or_else(|| self.decoded());
        let blocks = self.program.blocks();
        match step {
            Step::Sync { what, source, events }
                if what.at_corner() == AtCorner::Waits && self.smoothing.wait_here() =>
            {
                let after = After::Sync(what);
                self.queue.at_corner.push_back(Pending { after, source, events, blocks });
            }
            step if self.queue.at_corner.is_empty() => self.take(step),
            Step::Motion { block, source, events }
                if self.smoothing.joins_corner(&block) && !runs_banding(&events) =>
            {
                self.register(&block, source, events);
                if self.smoothing.push_behind_stop(block, &mut self.planner) {
                    self.wait_at_corner();
                }
            }
            other => {
                self.queue.postponed = Some(other);
                self.smoothing.flush_behind_stop(&mut self.planner);
                self.wait_at_corner();
            }
        }
    }

    fn wait_at_corner(&mut self) {
        self.queue.pending = std::mem::take(&mut self.queue.at_corner);
        self.not_contoured();
        self.planner.finish();
    }

    fn decoded(&mut self) -> Step {
        if let Some(feedback) = self.feedback() {
            self.program.tell(feedback);
        }
        self.program.next(&mut self.messages.program, self.planner.spent_blocks())
    }

    fn take(&mut self, step: Step) {
        let blocks = self.program.blocks();
        match step {
            Step::Motion { block, source, events } => self.motion(block, source, events),
            Step::Sync { what, source, events } => {
                let measures = match &what {
                    Sync::Measured { through, stops } => Some((*through, stops.clone())),
                    _ => None,
                };
                let after = After::Sync(what);
                self.queue.pending.push_back(Pending { after, source, events, blocks });
                self.path_stops();
                if let Some((through, stops)) = measures {
                    self.begin_probing(through, &stops);
                }
            }
            Step::End { reason, source, events } => {
                let after = After::End(reason);
                self.queue.pending.push_back(Pending { after, source, events, blocks });
                self.path_stops();
            }
        }
    }

    pub(super) fn motion(&mut self, block: Box<Block>, source: SourceRef, events: Vec<Event>) {
        let bands = runs_banding(&events);
        self.register(&block, source, events);
        self.smoothing.push(block, &mut self.planner);
        if bands {
            self.smoothing.flush(&mut self.planner);
            self.planner.halt_behind();
        }
        self.not_contoured();
    }

    fn register(&mut self, block: &Block, source: SourceRef, events: Vec<Event>) {
        let programmed = Programmed::new(block, self.program.blocks());
        let jerk_limited = block.slope.kind != SlopeKind::Step;
        let (motion, time_s) = (Motion::of(block), times::time_of(block));
        let (seq, target) = (block.seq, block.path.end().clone());
        self.queue.underway.push_back(Underway {
            seq,
            source,
            programmed,
            motion,
            time_s,
            target,
            jerk_limited,
            events,
        });
    }

    /// Announces that the path stops after the last motion.
    pub(super) fn path_stops(&mut self) {
        self.smoothing.flush(&mut self.planner);
        self.not_contoured();
        self.planner.finish();
    }

    /// Handles the rest of the path after everything that was pushed.
    pub(super) fn at_rest(&mut self) {
        if self.planner.halts() {
            self.at_halt();
            return;
        }
        match self.queue.pending.pop_front() {
            Some(pending) => self.wait_for(pending),
            None => self.pull(),
        }
    }

    /// Begins the wait for what follows a motion.
    fn wait_for(&mut self, Pending { after, source, events, blocks }: Pending) {
        self.progress.complete(blocks, &mut self.smoothing.changed);
        self.blocks.waits_at = source;
        let k = self.planner.setpoint().k;
        self.time_ends(k);
        for event in events {
            self.act(event, k);
        }
        self.expect_stops();
        let wait = match after {
            After::Sync(sync) => Wait::for_sync(sync, self.cycle),
            After::End(reason) => Wait::for_end(reason),
        };
        for axis in wait.end_oscillations(&mut self.independent) {
            self.oscillation_ends(axis);
        }
        self.phase = Phase::Waiting(wait);
    }

    /// Expects the axes at the rest position of the path.
    pub(super) fn expect_stops(&mut self) {
        for (i, (chain, driver)) in self.chains.driven().enumerate() {
            if let Driver::Path(p) = driver
                && !self.independent.is_moving(p)
            {
                let way_mm = self.independent.done_mm(p);
                chain.expect_stop(self.planner.setpoint().position[p] + way_mm);
                self.blocks.stops_at[i] = self.blocks.current;
            }
        }
    }

    /// Ends a wait: performs its action and returns to the program.
    pub(super) fn go_on(&mut self) {
        let Phase::Waiting(wait) = std::mem::replace(&mut self.phase, Phase::Running) else {
            return;
        };
        if let Some(AwaitedMark { spindle, deg, full_override }) = wait.mark() {
            self.thread = Some(Thread { full_override, held: false, scaled: false });
            let share = self.spindles.get(spindle).and_then(|s| s.mark_ahead(deg, self.cycle));
            self.planner.begin_within_cycle(share.unwrap_or(0.0));
        }
        match wait.into_action() {
            wait::Action::None => {}
            wait::Action::ThreadEnd => self.thread = None,
            wait::Action::Halted => self.call_at_halt(),
            wait::Action::Resume => self.resume(),
            wait::Action::Shaping(setup) => self.swap_kernels(&setup),
            wait::Action::MachineData => self.machine_data(),
            wait::Action::SetPosition { axis, offset_mm, moves } => {
                self.set_position(axis, offset_mm, moves);
                self.phase = Phase::Waiting(Wait::for_a_cycle());
            }
            wait::Action::End(reason) => {
                self.totals.aborted |= reason == EndReason::Aborted;
                self.phase = Phase::Done;
            }
        }
        if matches!(self.phase, Phase::Running)
            && let Some(next) = self.queue.pending.pop_front()
        {
            self.wait_for(next);
        }
    }
}
