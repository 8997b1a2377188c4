//! A simulation before its first cycle: every axis at rest where the program starts.

use super::chain::AxisChain;
use super::chains::Chains;
use super::driver::Driver;
use super::fault;
use super::independent::IndependentAxes;
use super::inputs::Inputs;
use super::messages::Messages;
use super::program::Program;
use super::smoothing::Smoothing;
use super::spindle::Spindle;
use super::state::{Batch, BlockRefs, Phase, Queue, Simulation, TimeLimit, Times};
use super::totals::{Progress, Totals};
use super::wear::Wear;
use crate::diag::Diagnostic;
use crate::exec::{Options, Structures};
use crate::machine::{Axis, Machine};
use crate::record::{CycleRecord, Motion};
use crate::source::Sources;
use kontur_filters::control::axis_control::AxisInputs;
use kontur_motion::planner::Planner;
use std::sync::Arc;

impl Simulation {
    /// A program on a machine, before its first cycle; `structures`: what its check has found.
    ///
    /// # Errors
    /// The diagnostics, if the plant of an axis is not physical or a program cannot be opened.
    pub(crate) fn new(
        machine: Arc<Machine>,
        sources: Arc<dyn Sources>,
        program: &str,
        options: Options,
        structures: Structures,
    ) -> Result<Self, Vec<Diagnostic>> {
        let cycle = machine.cycle;
        let (setups, diagnostics) = machine.chains();
        let (limit, stop) = (TimeLimit::new(options.max_time_s, cycle), options.stop.flag());
        let on = Arc::clone(&machine);
        let (program, start, found) = Program::new(sources, program, on, options, structures);
        let n = machine.axes.len();
        let chains = Chains::new(&start, setups, &machine)?;
        let window = machine.channel.look_ahead_blocks as usize;
        let spindles = at_rest(&machine.spindles);
        let records = chains.all.iter().map(AxisChain::at_start).collect();
        let mut planner = Planner::new(cycle, window, &start[..n]);
        planner.stop_with(stop);
        let mut simulation = Self {
            smoothing: Smoothing::new(cycle),
            planner,
            targets: vec![0.0; chains.len()],
            batch: Batch::default(),
            totals: Totals {
                filter_delay_cycles: vec![0.0; chains.len()],
                // gantry slaves come last
                followers: (n + spindles.len()..chains.len()).collect(),
                ..Totals::default()
            },
            motion: Motion::None,
            is_held: false,
            blocks: BlockRefs::none(chains.len()),
            inputs: Inputs::none(chains.len()),
            independent: IndependentAxes::new(n),
            chains,
            spindle_deg: vec![0.0; spindles.len()],
            spindles,
            jerk_limited: false,
            queue: Queue::default(),
            phase: Phase::Start,
            record: CycleRecord { axes: records, ..CycleRecord::default() },
            path_position: start[..n].iter().copied().collect(),
            thread: None,
            limit,
            times: Times::default(),
            probing: None,
            told: None,
            banding: None,
            wear: Wear::default(),
            messages: Messages { own: diagnostics, program: found, ..Messages::default() },
            progress: Progress::default(),
            machine,
            cycle,
            program,
        };
        simulation.set_up();
        Ok(simulation)
    }

    /// What the lists apply before the first block.
    fn set_up(&mut self) {
        let mode = self.machine.channel.overrides.mode;
        self.planner.set_override_mode(mode);
        self.feedforward(false, &vec![1.0; self.path_axes()]);
        for spindle in 0..self.spindles.len() {
            self.chains.spindle_feedforward(spindle, false, 1.0);
        }
        let setup = self.program.shaping().clone();
        for i in 0..self.chains.len() {
            if matches!(self.chains.drivers[i], Driver::Spindle(_)) {
                self.set_kernel(i, &setup);
            }
        }
        self.swap_kernels(&setup);
        self.planner.report_changes(true);
    }
}

/// Reasons why axes of a machine cannot be simulated: plants that are not physical, or cannot be discretised.
pub(crate) fn impossible_axes(machine: &Machine) -> Vec<Diagnostic> {
    let chains = machine.chains().0.into_iter().enumerate();
    let error = |(i, setup)| {
        let chain = AxisChain::new(setup, 0.0, AxisInputs::default(), machine.cycle);
        chain.err().map(|e| fault::plant(&e, machine, i))
    };
    chains.filter_map(error).collect()
}

/// The spindles of a machine before their first cycle.
fn at_rest(spindles: &[Axis]) -> Vec<Spindle> {
    spindles.iter().map(|a| Spindle::new(&a.dynamics()).within(a.speed_band())).collect()
}
