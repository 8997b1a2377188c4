//! The simulation of this workspace behind the commands' questions.

use crate::engine::{AxisFacts, Engine, Facts, FileNames, OpenError, Request, Source, Totals};
use crate::files::{self, Lists, ProgramFiles, STANDARD_INPUT, is_standard};
use crate::inputs;
use kontur_interpreter::diag::{Condition, Diagnostic, Severity};
use kontur_interpreter::exec::{self, Access, External, Options, SkipLevels, Value};
use kontur_interpreter::explain;
use kontur_interpreter::machine::{Axis, AxisKind, Machine, Override, leaves_out};
use kontur_interpreter::record::CycleRecord;
use kontur_interpreter::sim::{Limits, Simulation};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// The simulation of this workspace.
#[derive(Clone, Copy, Debug, Default)]
pub struct Kontur;

/// A machine as a request describes it, with the warnings of its lists, which are read through `lists`.
///
/// # Errors
/// [`OpenError`] if a setting is wrong or the lists are refused.
pub fn machine(request: &Request, lists: &Lists) -> Result<(Machine, Vec<Diagnostic>), OpenError> {
    let mut overrides = Vec::new();
    for setting in &request.settings {
        overrides.push(Override::parse(setting).map_err(|d| OpenError::Lists(vec![*d]))?);
    }
    if let Some(us) = request.cycle_us {
        let text = format!("kontur.cycle_time_us={us}");
        overrides.push(Override::parse(&text).map_err(|d| OpenError::Lists(vec![*d]))?);
    }
    let loaded = match &request.machine {
        None => Machine::builtin(&overrides),
        Some(path) => {
            let start_up = if path.is_dir() { path.join("hochlauf.lis") } else { path.clone() };
            let Some(name) = start_up.to_str() else {
                let e =
                    std::io::Error::other("lists refer to each other by name: it has to be UTF-8");
                return Err(OpenError::Io(path.clone(), e));
            };
            Machine::load(lists, name, &overrides)
        }
    };
    let (machine, mut messages) = loaded.map_err(OpenError::Lists)?;
    messages.extend(given_twice(&request.settings));
    let unknown = |d: &Diagnostic| d.id == Condition::ListKeyUnknown;
    if request.strict && messages.iter().any(unknown) {
        let refused = messages.into_iter().map(|d| {
            if unknown(&d) {
                d.severity(Severity::Error).hint("--strict refuses keys that are not modelled")
            } else {
                d
            }
        });
        return Err(OpenError::Lists(refused.collect()));
    }
    // a filter or a controller that the list describes and that cannot be: the axis would move without it
    let chains = machine.chains().1;
    let left_out = |d: &Diagnostic| request.strict && leaves_out(d);
    if chains.iter().any(|d| d.is_error() || left_out(d)) {
        let refused = |d: Diagnostic| {
            if left_out(&d) {
                d.severity(Severity::Error).hint("--strict refuses parts that cannot be built")
            } else {
                d
            }
        };
        let chains = chains.into_iter().map(refused);
        return Err(OpenError::Lists(messages.into_iter().chain(chains).collect()));
    }
    Ok((machine, messages))
}

/// K-LIST-DUP for settings that a later one replaces.
fn given_twice(settings: &[String]) -> impl Iterator<Item = Diagnostic> {
    let key = |setting: &String| setting.split('=').next().unwrap_or_default().trim().to_owned();
    let keys: Vec<String> = settings.iter().map(key).collect();
    (1..keys.len()).filter_map(move |i| {
        let twice = keys[..i].iter().any(|other| other.eq_ignore_ascii_case(&keys[i]));
        let text = format!("--set {}: given twice, the last one wins", keys[i]);
        twice.then(|| Diagnostic::new(Condition::ListDuplicate, text))
    })
}

/// Folders of subroutines that do not exist would only be missed much later.
fn folders(request: &Request) -> Result<(), OpenError> {
    match request.path.iter().find(|folder| !folder.is_dir()) {
        Some(folder) => {
            Err(OpenError::Usage(format!("--path {}: no such folder", folder.display())))
        }
        None => Ok(()),
    }
}

fn options(request: &Request, machine: &Machine) -> Result<Options, OpenError> {
    for (i, (name, _)) in request.start.iter().enumerate() {
        if request.start[..i].iter().any(|(other, _)| other.eq_ignore_ascii_case(name)) {
            return Err(OpenError::Usage(format!("--start: axis `{name}` twice")));
        }
        if !machine.axes.iter().any(|a| a.name().eq_ignore_ascii_case(name)) {
            let known: Vec<&str> = machine.axes.iter().map(Axis::name).collect();
            let known = known.join(", ");
            return Err(OpenError::Usage(format!(
                "--start: no axis `{name}`; the axes are {known}"
            )));
        }
    }
    for (i, (name, _)) in request.external.iter().enumerate() {
        if request.external[..i].iter().any(|(other, _)| other.eq_ignore_ascii_case(name)) {
            return Err(OpenError::Usage(format!("--external: `{name}` twice")));
        }
    }
    let skip = request.skip.iter().fold(SkipLevels::NONE, |levels, level| levels.with(*level));
    Ok(Options {
        start: request.start.clone(),
        skip,
        max_blocks: request.max_blocks,
        max_time_s: request.max_time_s,
        identity_trafo: request.identity_trafo,
        techno_times: request.techno_times,
        external: request.external.iter().map(external).collect(),
        ..Options::default()
    })
}

fn external((name, value): &(String, String)) -> (String, External) {
    let value = match value.trim().parse::<f64>() {
        Ok(x) if x.is_finite() => Value::Number(x),
        _ => Value::Text(value.as_str().into()),
    };
    (name.clone(), External { value, access: Access::ReadWrite })
}

fn sources(request: &Request) -> ProgramFiles {
    ProgramFiles::new(&request.program, request.path.clone(), request.allow_outside)
}

/// A program that must be readable, or the command fails before it decodes anything.
fn readable(program: &Path) -> Result<(), OpenError> {
    let name = if is_standard(program) { Path::new("standard input") } else { program };
    files::readable(program).map_err(|e| OpenError::Io(name.to_path_buf(), e))
}

/// `several_files`: the check ahead has opened more than the program.
fn facts(
    request: &Request,
    machine: &Machine,
    simulation: &Simulation,
    several_files: bool,
) -> Facts {
    let (chains, _) = machine.chains();
    let stop = |i: usize| chains.get(i).map(|chain| chain.control.exact_stop).unwrap_or_default();
    let axes = machine.all_axes().enumerate().map(|(i, axis)| AxisFacts {
        name: axis.name().to_owned(),
        rotary: axis.kind() != AxisKind::Linear,
        spindle: axis.kind() == AxisKind::Spindle,
        modal: simulation.has_tool_point(i),
        v_max: axis.dynamics().v_max_mm_s,
        a_max: axis.dynamics().a_max_mm_s2,
        window: stop(i).window_mm,
        settling_s: stop(i).settling_s,
    });
    Facts {
        program: if is_standard(&request.program) {
            STANDARD_INPUT.to_owned()
        } else {
            request.program.display().to_string()
        },
        machine: machine.name.clone(),
        cycle_us: machine.cycle.us(),
        axes: axes.collect(),
        files: FileNames::new(
            simulation.files().iter().map(ToString::to_string).collect(),
            several_files,
        ),
    }
}

/// A program that runs, or that was refused before its first cycle.
struct Run {
    facts: Facts,
    /// Names of the files in the facts.
    files_known: usize,
    simulation: Simulation,
    sources: ProgramFiles,
    /// Lists and inputs.
    others: Vec<PathBuf>,
    messages: Vec<Diagnostic>,
    refused: bool,
    ended: bool,
    changed: bool,
}

impl Run {
    /// A program that was changed while it ran, also behind what was read of it, is another one than the trace shows.
    fn look_for_changes(&mut self) {
        if std::mem::replace(&mut self.ended, true) {
            return;
        }
        if let Some((path, e)) = self.sources.changed() {
            let text = format!("{}: {e}", path.display());
            self.messages.extend(self.simulation.take_diagnostics());
            // the reader may have met it already
            if self.messages.iter().all(|d| d.text != text) {
                let hint = "the trace does not belong to the program as it is now: run it again";
                self.messages.push(Diagnostic::new(Condition::NoFile, text).hint(hint));
            }
            self.changed = true;
        }
    }
}

impl Source for Run {
    fn facts(&self) -> &Facts {
        &self.facts
    }

    fn reads(&self) -> Vec<PathBuf> {
        self.others.iter().cloned().chain(self.sources.opened()).collect()
    }

    fn next_cycle(&mut self) -> Option<&CycleRecord> {
        if self.refused {
            return None;
        }
        if self.simulation.next_cycle().is_none() {
            self.look_for_changes();
            return None;
        }
        let files = self.simulation.files();
        if files.len() > self.files_known {
            self.facts.files.update(files.iter().map(|f| &**f));
            self.files_known = files.len();
        }
        Some(self.simulation.record())
    }

    fn take_diagnostics(&mut self) -> Vec<Diagnostic> {
        let mut found = std::mem::take(&mut self.messages);
        // of a refused program the check has said everything
        if !self.refused {
            found.extend(self.simulation.take_diagnostics());
        }
        found
    }

    fn totals(&self) -> Totals {
        let totals = self.simulation.totals();
        let aborted = self.refused || self.changed || totals.aborted;
        Totals { aborted, input_failed: self.changed || totals.input_failed, ..totals }
    }
}

impl Engine for Kontur {
    fn open(&self, request: &Request) -> Result<Box<dyn Source>, OpenError> {
        readable(&request.program)?;
        folders(request)?;
        let lists = Lists::default();
        let (machine, mut messages) = machine(request, &lists)?;
        let options = options(request, &machine)?;
        let machine = Arc::new(machine);
        let program = request.program.display().to_string();
        let limits = Limits { max_time_s: request.max_time_s };
        let sources = sources(request);
        let open = |options: Options| {
            Simulation::new(
                Arc::clone(&machine),
                Box::new(sources.clone()),
                &program,
                options,
                &limits,
            )
        };
        // what a check can see refuses the program before its first cycle
        let found =
            exec::check(Box::new(sources.clone()), &program, Arc::clone(&machine), options.clone());
        // a limit stops a run where it is met: it does not refuse the program
        let refused = found.iter().any(|d| d.is_error() && d.id != exec::LIMIT);
        if refused {
            messages.extend(machine.chains().1);
        }
        // parts that do not run are looked at by the check alone
        let unreached = |d: &Diagnostic| d.id == exec::UNREACHED;
        messages.extend(found.into_iter().filter(|d| refused || unreached(d)));
        let several_files = sources.opened().len() > 1;
        let changes = inputs::open(&request.inputs, &machine)?;
        let simulation = open(options).map_err(OpenError::Lists)?.with_inputs(changes);
        let facts = facts(request, &machine, &simulation, several_files);
        let others = lists.read_so_far().into_iter().chain(request.inputs.clone()).collect();
        let run = Run {
            files_known: facts.files.all().len(),
            facts,
            simulation,
            sources,
            others,
            messages,
            refused,
            ended: false,
            changed: false,
        };
        Ok(Box::new(run))
    }

    fn check(
        &self,
        request: &Request,
        report: &mut dyn FnMut(Diagnostic),
    ) -> Result<(), OpenError> {
        readable(&request.program)?;
        folders(request)?;
        let (machine, messages) = machine(request, &Lists::default())?;
        messages.into_iter().chain(machine.chains().1).for_each(&mut *report);
        let options = options(request, &machine)?;
        // a mistake in the inputs comes back here
        drop(inputs::open(&request.inputs, &machine)?);
        let program = request.program.display().to_string();
        let found = exec::check(Box::new(sources(request)), &program, Arc::new(machine), options);
        found.into_iter().for_each(report);
        Ok(())
    }

    fn explain(&self, thing: &str) -> Result<String, Vec<String>> {
        explain::explain(thing).map(|e| e.to_string())
    }
}
