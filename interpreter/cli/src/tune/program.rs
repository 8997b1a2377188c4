//! The choices evaluated on the user's program: residual vibration, deviation from the contour, machining time.
//!
//! Each choice is forced on the run ([`ForcedGuard`]) in place of the settings of the lists and of MODE, FREQ and
//! DAMPING in the commands of the program; ON, OFF and `AX_DEV` of the program stay. The guard may still be ineffective
//! if the program switches it off or uses other filters, so the delays that occurred are compared with those of the
//! kernels.
//!
//! A program without `AX_DEV` is run once more with each choice that exceeds the bound, with the bound as its
//! tolerance. A choice that stays within the bound anyway is not slowed down by the key.

use super::task::{Answer, Row, Task, command};
use crate::args::TuneArgs;
use crate::console::Console;
use crate::error::{Error, Exit};
use crate::request::{OpenError, Opened, Request};
use crate::run::{Shown, announce_lists, drive};
use crate::table::{Cell, Table, number};
use crate::target::keep_apart;
use kontur_filters::analysis::tuning::Choice;
use kontur_interpreter::diag::Location;
use kontur_interpreter::job::{Facts, ForcedGuard, GuardCommands};
use kontur_interpreter::machine::Machine;
use kontur_interpreter::record::{Asked, Rows};
use kontur_interpreter::summary::{Collector, State, Summary};
use std::path::Path;

/// Tolerance in mm for comparing deviations with a bound, as everywhere.
const SLACK_MM: f64 = 1e-9;
/// Delays that differ by less, in cycles, count as equal.
const SAME_DELAY: f64 = 1e-6;

/// The results of a run with one choice; without a choice the Vibration Guard is off.
struct Outcome {
    choice: Option<Choice>,
    /// `AX_DEV` as set by the program or the run.
    ax_dev: Option<f64>,
    summary: Summary,
    /// Largest deviation of a path axis from the contour in mm (deg). Axes that follow others are no part of it.
    dev_mm: f64,
}

/// Runs the program with every choice and reports the fastest one within both bounds.
pub(super) fn answer(
    task: &Task,
    args: &TuneArgs,
    file: &Path,
    max_dev_mm: f64,
    console: &mut Console,
) -> Result<Answer, Error> {
    let refused = |e: OpenError, console: &mut Console| announce_lists(e, console);
    let request = args.simulation.request(file);
    let job = request.job().map_err(|e| refused(e, console))?;
    let machine = job.machine();
    let own = job.check().guard;
    console.print(&assumed(machine, &own, file, max_dev_mm))?;
    let mut outcomes: Vec<Outcome> = Vec::new();
    let mut try_out = |choice: Option<Choice>, ax_dev_mm: Option<f64>, first: bool| {
        let settings = choice.map(|c| c.settings);
        let guard = Some(ForcedGuard { settings, ax_dev_mm });
        let name = choice.map_or_else(|| "guard off".to_owned(), |c| command(&c.settings, ""));
        let shown = Shown { label: &(name + ": "), errors_only: !first };
        let opened = Request { guard, ..request.clone() }.open();
        let Opened { mut run, reads } = opened.map_err(|e| refused(e, console))?;
        keep_apart(&reads.so_far(), args.output.as_slice())?;
        let mut summary = Collector::new(run.facts());
        let take = None::<(Asked, fn(&Rows<'_>) -> Result<(), Error>)>;
        drive(&mut run, shown, console, Some(&mut summary), take)?;
        // including the subroutines that the run reached
        keep_apart(&reads.so_far(), args.output.as_slice())?;
        let summary = summary.finish(&run.totals());
        let dev_mm = largest_deviation_mm(&summary, run.facts());
        let ax_dev = own.ax_dev.as_ref().map(|(_, value)| *value).or(ax_dev_mm);
        Ok::<_, Error>(Outcome { choice, ax_dev, summary, dev_mm })
    };
    // a program that switches the guard on itself cannot be compared with a run without it
    let off = own.on.is_none().then_some(None);
    for choice in off.into_iter().chain(choices(task).into_iter().map(Some)) {
        outcomes.push(try_out(choice, None, outcomes.is_empty())?);
    }
    if own.ax_dev.is_none() {
        let excess: Vec<Choice> = outcomes
            .iter()
            .filter(|o| o.summary.state == State::Finished && !o.keeps(task, max_dev_mm))
            .filter_map(|o| o.choice.filter(|choice| task.keeps(choice)))
            .collect();
        for choice in excess {
            outcomes.push(try_out(Some(choice), Some(max_dev_mm), false)?);
        }
    }
    check_delays(&outcomes, machine)?;
    console.print(&table(task, &outcomes, max_dev_mm))?;
    let command = chosen(task, &outcomes, max_dev_mm, &own);
    let off = own.off.as_ref().map(|place| line_of(place, file));
    console.print(&verdict(task, command.as_ref(), max_dev_mm, off.as_deref()))?;
    let all_aborted = outcomes.iter().all(|o| o.summary.state == State::Aborted);
    Ok(Answer {
        choices: numbers(task, &outcomes, max_dev_mm),
        command: command.map(|(command, _)| command),
        exit: if all_aborted { Exit::Aborted } else { Exit::Finished },
    })
}

/// Largest deviation of a path axis from the contour in mm (deg). Axes that follow others are no part of it.
fn largest_deviation_mm(summary: &Summary, facts: &Facts) -> f64 {
    let axes = summary.axes.iter().zip(&facts.axes);
    let path_axes = axes.filter(|(_, axis)| !axis.spindle).filter_map(|(axis, _)| axis.max_dev);
    path_axes.fold(0.0, f64::max)
}

/// For each mode the best and the given frequency, and the highest one that keeps the residual within its limit: a
/// higher frequency means a shorter kernel, so nothing in between can be faster.
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

/// Checks that the delay of an axis is that of the kernel plus that of its other filters, which is the same in every
/// run. Otherwise a kernel other than the requested one was in effect.
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
                "axis {}: the Vibration Guard that ran is not the requested one, or none ran: the program filters by other means or switches the guard off",
                axis.name()
            )));
        }
    }
    Ok(())
}

/// Limits of the machine and options of the run.
fn assumed(machine: &Machine, own: &GuardCommands, file: &Path, max_dev_mm: f64) -> String {
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
        "assumed   every choice on all path axes, instead of the lists (vib_guard.active, mode, freq, damping)"
            .to_owned(),
    );
    let line = |place: &Location| line_of(place, file);
    lines.push(match &own.ax_dev {
        Some((place, value)) => {
            let line = line(place);
            format!("          the program's own AX_DEV={value} ({line}) with each choice")
        }
        None => format!(
            "          no AX_DEV in the program: choices that exceed {max_dev_mm} mm are run again with \
             #VIB GUARD ON [AX_DEV={max_dev_mm}]"
        ),
    });
    if let (Some(_), Some(place)) = (&own.ax_dev, &own.on_without_ax_dev) {
        lines.push(format!(
            "          {} switches the guard on without AX_DEV: there is no tolerance from there on",
            line(place)
        ));
    }
    if let Some(line) = own.settings.as_ref().map(line) {
        lines.push(format!(
            "          MODE, FREQ and DAMPING of the program's own commands ({line}) are replaced by each choice"
        ));
    }
    if let Some(line) = own.off.as_ref().map(line) {
        lines.push(format!(
            "          {line} switches the guard off: vibration is not damped from there on"
        ));
    }
    lines.join("\n") + "\n\n"
}

/// A line of the program or of a file that it calls.
fn line_of(place: &Location, file: &Path) -> String {
    if *place.file == *file.display().to_string() {
        format!("line {}", place.line)
    } else {
        format!("line {} of {}", place.line, place.file)
    }
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
        "max dev",
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
            outcome.ax_dev.map(|mm| mm.to_string()).unwrap_or_default(),
            residual,
            format!("{} mm", number(outcome.dev_mm, 6)),
            format!("{} mm", number(error, 6)),
            if finished { time } else { "aborted".to_owned() },
            keeps.to_owned(),
        ]);
    }
    table.text()
}

/// The fastest outcome within both bounds; of equally fast ones the one with the smallest residual.
fn fastest<'a>(task: &Task, outcomes: &'a [Outcome], max_dev_mm: f64) -> Option<&'a Outcome> {
    let left = |o: &Outcome| o.choice.map_or(1.0, |choice| choice.worst_ratio);
    outcomes.iter().filter(|o| o.keeps(task, max_dev_mm)).reduce(|a, b| {
        let faster = b.summary.cycles < a.summary.cycles;
        let equal = b.summary.cycles == a.summary.cycles && left(b) < left(a);
        if faster || equal { b } else { a }
    })
}

/// The command of the fastest choice within both bounds, and the duration of its run in s.
fn chosen(
    task: &Task,
    outcomes: &[Outcome],
    max_dev_mm: f64,
    own: &GuardCommands,
) -> Option<(String, f64)> {
    let outcome = fastest(task, outcomes, max_dev_mm)?;
    let own = own.ax_dev.as_ref().map(|(_, value)| *value);
    let tolerance = format!(" AX_DEV={}", own.unwrap_or(max_dev_mm));
    let command = command(&outcome.choice?.settings, &tolerance);
    Some((command, outcome.summary.duration_s))
}

/// `off`: where the program switches the guard off.
fn verdict(
    task: &Task,
    chosen: Option<&(String, f64)>,
    max_dev_mm: f64,
    off: Option<&str>,
) -> String {
    let percent = 100.0 * task.limit_ratio;
    match chosen {
        None => format!("\nchoice    none keeps both {percent} % and {max_dev_mm} mm\n"),
        Some((command, duration_s)) => {
            let seconds = number(*duration_s, 3);
            let only = off.map(|line| {
                format!(
                    "          up to {line}: after it, vibration was not damped and these figures do not apply\n"
                )
            });
            format!(
                "\nchoice    {command}\n          the fastest that keeps {percent} % and {max_dev_mm} mm: {seconds} s\n{}",
                only.unwrap_or_default()
            )
        }
    }
}

/// One row per run; mode 0 is the Vibration Guard off.
fn numbers(task: &Task, outcomes: &[Outcome], max_dev_mm: f64) -> Table {
    let mut choices = Table::new(&[
        "mode",
        "freq_hz",
        "damping",
        "ax_dev_mm",
        "residual_ratio",
        "dev_mm",
        "contour_err_mm",
        "duration_s",
        "state",
        "keeps",
    ]);
    for outcome in outcomes {
        let of = |value: fn(&Choice) -> f64| outcome.choice.as_ref().map_or(f64::NAN, value);
        choices.push([
            Cell::from(outcome.choice.map_or(0, |c| u32::from(c.settings.mode))),
            Cell::Given(of(|c| c.settings.freq_hz)),
            Cell::Given(of(|c| c.settings.damping)),
            Cell::Given(outcome.ax_dev.unwrap_or(f64::NAN)),
            Cell::Given(outcome.choice.map_or(1.0, |c| c.worst_ratio)),
            Cell::Given(outcome.dev_mm),
            Cell::Given(outcome.summary.max_contour_error.as_ref().map_or(f64::NAN, |e| e.mm)),
            Cell::Given(outcome.summary.duration_s),
            Cell::Word(outcome.summary.state.name().to_owned()),
            Cell::from(u32::from(outcome.keeps(task, max_dev_mm))),
        ]);
    }
    choices
}
