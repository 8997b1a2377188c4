//! The choices judged on the user's own program: residual vibration, deviation from the contour, machining time.
//!
//! A choice is put over the axis lists (`vib_guard.*` of every path axis), as if the machine's lists said so. A program
//! command has priority over the lists key by key: a bare `#VIB GUARD ON` or one with `AX_DEV` alone runs with the
//! choice and with its own tolerance, but a command that names MODE, FREQ or DAMPING itself would outvote it. Those words
//! are what is to be chosen: the runs take a copy of the program without them. Because a subroutine may hide such a
//! command too, the delays that really acted are compared with those of the kernels.
//!
//! A program without `AX_DEV` is run once more with each choice that leaves the bound: with the bound as its tolerance.
//! A choice that keeps the bound anyway is not slowed down by the key.

use super::args::TuneArgs;
use super::own::{Commands, copy};
use super::{Choice, Row, Task, command};
use crate::console::Console;
use crate::engine::{Engine, Request};
use crate::files::Lists;
use crate::summary::{Collector, State, Summary};
use crate::table::{Table, number};
use crate::{Error, Exit, run, simulator};
use kontur_interpreter::machine::Machine;
use std::path::{Path, PathBuf};

/// Deviations are kept to this in mm, as everywhere.
const SLACK_MM: f64 = 1e-9;
/// Cycles between two looks at the clock and at new messages.
const LOOK_EVERY: u64 = 1024;
/// Delays that differ by less are the same, in cycles.
const SAME_DELAY: f64 = 1e-6;

/// What a run with one choice was like; no choice: the Vibration Guard off.
struct Outcome {
    choice: Option<Choice>,
    /// `AX_DEV` as the program that was run has it.
    ax_dev: Option<String>,
    summary: Summary,
    /// Largest deviation of a path axis from the contour in mm (deg).
    dev_mm: f64,
}

/// Runs the program with every choice and names the fastest that keeps both bounds.
pub(super) fn answer(
    task: &Task,
    args: &TuneArgs,
    file: &Path,
    max_dev_mm: f64,
    engine: &mut dyn Engine,
    console: &mut Console,
) -> Result<Exit, Error> {
    let own = Commands::of(file)?;
    let request = args.simulation.request(file);
    // copies live until the last run
    let plain = own.outvoting.map(|_| copy(file, &own, None)).transpose()?;
    let instead = |copy: &super::own::Copy| {
        let mut request = request.clone();
        request.program.clone_from(&copy.program);
        // what is not beside the copy is beside the original
        request.path.extend(beside(file));
        request
    };
    let first = plain.as_ref().map_or_else(|| request.clone(), &instead);
    let loaded = simulator::machine(&request, &Lists::default());
    let (machine, _) =
        loaded.map_err(|e| run::announce_lists(e, args.simulation.diagnostics, console))?;
    console.print(&assumed(&machine, &own, max_dev_mm))?;
    let mut outcomes = Vec::new();
    // a program that switches the guard on itself has no run without it to compare with
    let off = own.on.is_none().then_some(None);
    let tolerance = own.tolerance.as_ref().map(|(_, value)| value.clone());
    for choice in off.into_iter().chain(choices(task).into_iter().map(Some)) {
        let request = with(&first, &machine, choice.as_ref());
        let ax_dev = tolerance.clone();
        let outcome = drive(&request, choice, ax_dev, engine, args, console, outcomes.is_empty())?;
        outcomes.push(outcome);
    }
    if own.tolerance.is_none() {
        let bounded = copy(file, &own, Some(max_dev_mm))?;
        let second = instead(&bounded);
        let excess: Vec<Choice> = outcomes
            .iter()
            .filter(|o| o.summary.state == State::Finished && !o.keeps(task, max_dev_mm))
            .filter_map(|o| o.choice.filter(|choice| task.keeps(choice)))
            .collect();
        for choice in excess {
            let request = with(&second, &machine, Some(&choice));
            let ax_dev = Some(max_dev_mm.to_string());
            outcomes.push(drive(&request, Some(choice), ax_dev, engine, args, console, false)?);
        }
    }
    check_delays(&outcomes, &machine)?;
    console.print(&table(task, &outcomes, max_dev_mm))?;
    console.print(&verdict(task, &outcomes, max_dev_mm, &own))?;
    let all_aborted = outcomes.iter().all(|o| o.summary.state == State::Aborted);
    Ok(if all_aborted { Exit::Aborted } else { Exit::Finished })
}

/// The folder of a file; that of a bare name is the present one.
fn beside(file: &Path) -> Option<PathBuf> {
    let folder = file.parent()?;
    Some(if folder.as_os_str().is_empty() { PathBuf::from(".") } else { folder.to_path_buf() })
}

/// Mode by mode the best and the given frequency, and the highest one that keeps the residual: a higher frequency is a
/// shorter kernel, so nothing between can be faster.
fn choices(task: &Task) -> Vec<Choice> {
    let mut choices: Vec<Choice> = Vec::new();
    for mode in 1..=4 {
        let fastest = task.band.fastest(mode, task.limit_ratio, task.cycle);
        for choice in task.of_mode(mode).map(|Row { choice, .. }| choice).chain(fastest) {
            if !choices.iter().any(|c| c.settings == choice.settings) {
                choices.push(choice);
            }
        }
    }
    choices
}

/// The request with the choice over the lists of every path axis.
fn with(request: &Request, machine: &Machine, choice: Option<&Choice>) -> Request {
    let mut request = request.clone();
    for axis in &machine.axes {
        let mut set = |key: &str, value: String| {
            request.settings.push(format!("{}.vib_guard.{key}={value}", axis.name()));
        };
        set("active", u8::from(choice.is_some()).to_string());
        if let Some(Choice { settings, .. }) = choice {
            set("mode", settings.mode.to_string());
            set("freq", settings.freq_hz.to_string());
            set("damping", settings.damping.to_string());
        }
    }
    request
}

/// One run; the first one prints every message, the others their errors only.
fn drive(
    request: &Request,
    choice: Option<Choice>,
    ax_dev: Option<String>,
    engine: &mut dyn Engine,
    args: &TuneArgs,
    console: &mut Console,
    first: bool,
) -> Result<Outcome, Error> {
    let form = args.simulation.diagnostics;
    let mut source = engine.open(request).map_err(|e| run::announce_lists(e, form, console))?;
    let mut summary = Collector::new(source.facts());
    let mut progress = console.progress();
    let name = choice.map_or_else(|| "guard off".to_owned(), |c| command(&c.settings, ""));
    let mut more = true;
    while more {
        more = match source.next_cycle() {
            Some(record) => {
                summary.add(record);
                true
            }
            None => false,
        };
        if !more || summary.cycles().is_multiple_of(LOOK_EVERY) {
            progress.show(|| format!("{name}: cycle {}", summary.cycles()));
            for message in source.take_diagnostics() {
                summary.message(&message);
                if first || message.is_error() {
                    progress.suspend(|| run::announce(&message, form, console));
                }
            }
        }
    }
    let path_axes: Vec<bool> = source.facts().axes.iter().map(|a| !a.spindle).collect();
    let summary = summary.finish(&source.totals());
    let dev_mm = summary
        .axes
        .iter()
        .zip(path_axes)
        .filter(|(_, path)| *path)
        .map(|(axis, _)| axis.max_dev)
        .fold(0.0, f64::max);
    Ok(Outcome { choice, ax_dev, summary, dev_mm })
}

/// The delay of an axis is that of the kernel plus what else filters it, the same in every run. If it is not, another
/// kernel ran than the one asked for.
fn check_delays(outcomes: &[Outcome], machine: &Machine) -> Result<(), Error> {
    for (i, axis) in machine.axes.iter().enumerate() {
        let finished = outcomes.iter().filter(|o| o.summary.state == State::Finished);
        let rest = |o: &Outcome| {
            let delay = o.summary.axes.get(i)?.filter_delay_cycles;
            Some(delay - o.choice?.delay_cycles)
        };
        let rests: Vec<f64> = finished.filter_map(rest).collect();
        if rests.windows(2).any(|pair| (pair[0] - pair[1]).abs() > SAME_DELAY) {
            return Err(Error::Usage(format!(
                "axis {}: another Vibration Guard ran than the one asked for; a subroutine of the program sets MODE, \
                 FREQ or DAMPING itself, or no guard acts on the axis",
                axis.name()
            )));
        }
    }
    Ok(())
}

/// Limits of the machine and how the program is run.
fn assumed(machine: &Machine, own: &Commands, max_dev_mm: f64) -> String {
    let cycle_ms = f64::from(machine.cycle.us()) / 1000.0;
    let mut lines = vec![format!("\nmachine   {}, cycle {cycle_ms} ms", machine.name)];
    for axis in &machine.axes {
        let d = axis.dynamics();
        lines.push(format!(
            "  {:<8}v_max {} mm/s, a_max {} mm/s2, feed {} / {} mm/s2, ramps {} ms, kink {} %",
            axis.name(),
            d.v_max_mm_s,
            d.a_max_mm_s2,
            d.feed.acc_mm_s2,
            d.feed.dec_mm_s2,
            number(1000.0 * d.feed.ramps_s.iter().copied().fold(0.0, f64::max), 1),
            100.0 * d.a_trans_ratio,
        ));
    }
    lines.push(
        "assumed   every choice in the lists of all path axes (vib_guard.active, mode, freq, damping)"
            .to_owned(),
    );
    lines.push(match &own.tolerance {
        Some((line, value)) => {
            format!("          the program's own AX_DEV={value} (line {line}) with each of them")
        }
        None => format!(
            "          no AX_DEV in the program: what leaves {max_dev_mm} mm runs again with \
             #VIB GUARD ON [AX_DEV={max_dev_mm}]"
        ),
    });
    if let Some(line) = own.outvoting {
        lines.push(format!(
            "          MODE, FREQ and DAMPING of the program's own commands (line {line}) give way to each of them"
        ));
    }
    if let Some(line) = own.off {
        lines.push(format!(
            "          line {line} switches the guard off: from there on nothing is damped"
        ));
    }
    lines.join("\n") + "\n\n"
}

impl Outcome {
    fn keeps(&self, task: &Task, max_dev_mm: f64) -> bool {
        self.summary.state == State::Finished
            && self.choice.is_some_and(|choice| task.keeps(&choice))
            && self.dev_mm <= max_dev_mm + SLACK_MM
    }
}

fn table(task: &Task, outcomes: &[Outcome], max_dev_mm: f64) -> String {
    let mut table = Table::new(&[
        "mode",
        "f_set Hz",
        "AX_DEV",
        "worst residual",
        "largest dev",
        "contour error",
        "machining time",
        "keeps both",
    ]);
    for outcome in outcomes {
        let (mode, freq, residual) = outcome.choice.map_or_else(
            || ("off".to_owned(), String::new(), "100 %".to_owned()),
            |c| {
                let residual = format!("{} %", number(100.0 * c.worst_ratio, 2));
                (c.settings.mode.to_string(), c.settings.freq_hz.to_string(), residual)
            },
        );
        let error = outcome.summary.max_contour_error.as_ref().map_or(0.0, |e| e.mm);
        let finished = outcome.summary.state == State::Finished;
        let time = format!("{} s", number(outcome.summary.duration_s, 3));
        let keeps = if outcome.keeps(task, max_dev_mm) { "yes" } else { "no" };
        table.push(vec![
            mode,
            freq,
            outcome.ax_dev.clone().unwrap_or_default(),
            residual,
            format!("{} mm", number(outcome.dev_mm, 6)),
            format!("{} mm", number(error, 6)),
            if finished { time } else { "aborted".to_owned() },
            keeps.to_owned(),
        ]);
    }
    table.text()
}

/// The fastest outcome that keeps both bounds; of equally fast ones the one that leaves least.
fn fastest<'a>(task: &Task, outcomes: &'a [Outcome], max_dev_mm: f64) -> Option<&'a Outcome> {
    let left = |o: &Outcome| o.choice.map_or(1.0, |choice| choice.worst_ratio);
    outcomes.iter().filter(|o| o.keeps(task, max_dev_mm)).reduce(|a, b| {
        let faster = b.summary.cycles < a.summary.cycles;
        let equal = b.summary.cycles == a.summary.cycles && left(b) < left(a);
        if faster || equal { b } else { a }
    })
}

fn verdict(task: &Task, outcomes: &[Outcome], max_dev_mm: f64, own: &Commands) -> String {
    let found = fastest(task, outcomes, max_dev_mm);
    let Some((outcome, choice)) = found.and_then(|o| Some((o, o.choice?))) else {
        return format!(
            "\nchoice    none keeps both {} % and {max_dev_mm} mm\n",
            100.0 * task.limit_ratio
        );
    };
    let own = own.tolerance.as_ref().map(|(_, value)| value.clone());
    let tolerance = format!(" AX_DEV={}", own.unwrap_or_else(|| max_dev_mm.to_string()));
    format!(
        "\nchoice    {}\n          the fastest that keeps {} % and {max_dev_mm} mm: {} s\n",
        command(&choice.settings, &tolerance),
        100.0 * task.limit_ratio,
        number(outcome.summary.duration_s, 3)
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_choice_stands_over_the_lists_of_every_path_axis() {
        let (machine, _) = Machine::builtin(&[]).unwrap();
        let own = Request { settings: vec!["X.vib_guard.mode=3".to_owned()], ..Request::default() };
        let off = with(&own, &machine, None);
        assert_eq!(off.settings[1..], ["X", "Y", "Z"].map(|a| format!("{a}.vib_guard.active=0")));
        let band = kontur_filters::analysis::tuning::VibrationBand::of(&[40.0], 0.1).unwrap();
        let choice = band.best(2, machine.cycle).unwrap();
        let on = with(&own, &machine, Some(&choice)).settings;
        assert_eq!(on.len(), 13);
        assert_eq!(
            on[1..5],
            ["active=1", "mode=2", "freq=40", "damping=0.1"].map(|s| format!("X.vib_guard.{s}"))
        );
        // later settings win, and the machine accepts them
        let settings: Vec<_> =
            on.iter().map(|s| kontur_interpreter::machine::Override::parse(s).unwrap()).collect();
        let (machine, _) = Machine::builtin(&settings).unwrap();
        let preset = machine.axes[0].kernel_preset(machine.cycle);
        assert!(preset.vib_guard.active);
        assert_eq!(preset.vib_guard.settings, choice.settings);
    }
}
