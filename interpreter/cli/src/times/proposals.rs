//! Proposals: the program is run again with one group of parameters improved by a tenth, and the times are compared
//! line by line.

use super::{Collector, Help, Reason, Times};
use crate::files;
use crate::interrupt::Running;
use crate::lists::Lists;
use crate::request::Request;
use kontur_interpreter::job::{Run, Sink};
use kontur_interpreter::machine::{Axis, Lever, Machine};
use kontur_interpreter::record::{Asked, Rows};
use rayon::prelude::*;
use serde::Serialize;
use std::collections::HashMap;

/// A reason with less than this share of the duration does not justify a run.
const WORTHWHILE: f64 = 0.01;

/// Name of a change of a group of parameters by a tenth, and the factor.
const fn tenth(lever: Lever) -> (&'static str, f64) {
    match lever {
        Lever::Speed => ("velocity +10 %", 1.1),
        Lever::Acceleration => ("accelerations +10 %", 1.1),
        Lever::Ramps => ("ramp times -10 %", 0.9),
        Lever::GeometricRamp => ("geometric ramp times -10 %", 0.9),
    }
}

/// A change of the lists and its saving.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct Proposal {
    /// `accelerations +10 % of Y`.
    pub what: String,
    /// The parameters.
    pub parameters: String,
    /// The settings as for `--set`.
    pub settings: Vec<String>,
    /// Time in s by which the run becomes shorter; negative: longer.
    pub saves_s: f64,
}

/// Tries the changes suggested by the reasons, with one run each, and sorts them by saving. Each line gets the proposal
/// with the largest saving for it.
///
/// Nothing is tried for a program or lists that cannot be read again (standard input, a pipe).
pub(crate) fn try_out(times: &mut Times, request: &Request) {
    if files::is_standard(&request.program) || files::regular(&request.program).is_err() {
        return;
    }
    let Ok((machine, _)) = request.machine(&Lists::default()) else { return };
    let wanted = wanted(times, &machine);
    let _running = Running::start();
    let tried: Vec<(Proposal, Times)> =
        wanted.into_par_iter().filter_map(|proposal| run(proposal, request)).collect();
    for (proposal, with) in tried {
        let saves_s = times.duration_s - with.duration_s;
        let proposal = Proposal { saves_s, ..proposal };
        let seconds: HashMap<_, _> =
            with.lines.iter().map(|l| ((&l.file, l.line), l.seconds)).collect();
        for line in &mut times.lines {
            let there = seconds.get(&(&line.file, line.line));
            let saves_s = there.map_or(0.0, |there| line.seconds - there);
            if saves_s > line.helps.as_ref().map_or(0.0, |best| best.saves_s) {
                line.helps = Some(Help { what: proposal.what.clone(), saves_s });
            }
        }
        times.proposals.push(proposal);
    }
    times.proposals.sort_by(|a, b| b.saves_s.total_cmp(&a.saves_s));
}

/// The changes suggested by the reasons, for the axes and spindles they mention or for all path axes.
fn wanted(times: &Times, machine: &Machine) -> Vec<Proposal> {
    let axes = &machine.axes[..];
    let share = |reason: Reason, axis: Option<&str>| -> f64 {
        let of = times.reasons.iter().filter(|r| r.reason == reason);
        of.filter(|r| axis.is_none() || r.axis.as_deref() == axis).map(|r| r.share).sum()
    };
    let mut found = Vec::new();
    for (reason, lever) in [(Reason::AxisV, Lever::Speed), (Reason::AxisA, Lever::Acceleration)] {
        let named = axes.iter().chain(&machine.spindles);
        for axis in named.filter(|a| share(reason, Some(a.name())) >= WORTHWHILE) {
            found.extend(proposal(lever, std::slice::from_ref(axis), axis.name()));
        }
    }
    let contour = [Reason::Corner, Reason::Curve, Reason::AxDev];
    let slope = share(Reason::Slope, None) >= WORTHWHILE;
    let contour = contour.iter().any(|reason| share(*reason, None) >= WORTHWHILE);
    if slope {
        found.extend(proposal(Lever::Ramps, axes, "all axes"));
    }
    // a ramp within the same time builds up more of it, too
    if slope || contour {
        found.extend(proposal(Lever::Acceleration, axes, "all axes"));
    }
    if contour {
        found.extend(proposal(Lever::GeometricRamp, axes, "all axes"));
    }
    found
}

fn proposal(lever: Lever, axes: &[Axis], whose: &str) -> Option<Proposal> {
    let (what, factor) = tenth(lever);
    let settings: Vec<_> = axes.iter().flat_map(|axis| lever.settings(axis, factor)).collect();
    (!settings.is_empty()).then(|| Proposal {
        what: format!("{what} of {whose}"),
        parameters: lever.ids(),
        settings,
        saves_s: 0.0,
    })
}

/// Collects times until it is interrupted.
struct Watch(Collector);

impl Sink for Watch {
    type Stop = ();

    fn reads(&self) -> Option<Asked> {
        Some(Collector::asked())
    }

    fn rows(&mut self, rows: &Rows<'_>) -> Result<(), ()> {
        self.0.add(rows);
        Ok(())
    }

    fn pause(&mut self, run: &mut Run) -> Result<(), ()> {
        drop(run.take_diagnostics());
        if Running::is_interrupted() { Err(()) } else { Ok(()) }
    }
}

/// `None` if the lists do not permit these settings, or the run does not finish with them.
fn run(proposal: Proposal, request: &Request) -> Option<(Proposal, Times)> {
    let mut request = request.clone();
    request.settings.extend(proposal.settings.iter().cloned());
    let mut run = request.open().ok()?.run;
    let mut watch = Watch(Collector::new(run.facts()));
    let ended = run.to_end(&mut watch).is_ok() && !run.totals().aborted;
    ended.then(|| (proposal, watch.0.finish()))
}
