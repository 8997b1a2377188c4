//! A request of the command line, and the job of the library that executes it: files, lists, options.
//!
//! Order of calls: a request, then [`Request::check`], [`Request::job`] or [`Request::open`], each of which reads all
//! files again.
//!
//! ```
//! use kontur::request::Request;
//!
//! let request = Request {
//!     program: "../../programs/square_corner.nc".into(),
//!     settings: vec!["X.getriebe[0].kv=3000".to_owned()],
//!     max_blocks: 1000,
//!     max_time_s: 60.0,
//!     ..Request::default()
//! };
//! assert!(request.check().is_ok_and(|checked| checked.diagnostics.is_empty()));
//! let mut run = request.open().unwrap().run;
//! let Ok(()) = run.to_end(&mut |_: &_| ());
//! assert!(!run.totals().aborted);
//! ```

use crate::args::SimulationArgs;
pub use crate::error::OpenError;
use crate::files::{self, ProgramFiles, STANDARD_INPUT, is_standard};
use crate::lists::Lists;
use crate::project::{self, Place};
use crate::words::{self, Word};
use kontur_interpreter::diag::Diagnostic;
use kontur_interpreter::job::{
    Access, Changes, Checked, External, ForcedGuard, Job, MachineLists, Options, Run, SkipLevels,
    Stop, Value, inputs,
};
use kontur_interpreter::machine::project::Project;
use kontur_interpreter::machine::{Axis, ListFiles, Machine};
use std::path::{Path, PathBuf};

/// Everything a user can specify about a run, except the use of its results.
#[expect(clippy::struct_excessive_bools, reason = "each is a separate switch for the user")]
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Request {
    /// The NC program.
    pub program: PathBuf,
    /// Folder or start-up list of the machine, or a TwinCAT project; `None`: the built-in `xyz`.
    pub machine: Option<PathBuf>,
    /// `AXIS.key=value` or `channel.key=value`, in the order given.
    pub settings: Vec<String>,
    /// Folders of global subroutines, in the order of search.
    pub path: Vec<PathBuf>,
    /// Whether subroutines may be outside the program's folder and `path`.
    pub allow_outside: bool,
    /// Files of real-time inputs.
    pub inputs: Vec<PathBuf>,
    /// Cycle time in microseconds instead of the machine's.
    pub cycle_us: Option<u32>,
    /// Start positions in mm (deg) by axis name.
    pub start: Vec<(String, f64)>,
    /// Active skip levels (`/`, `/1` ... `/9`).
    pub skip: Vec<u8>,
    /// Program time in seconds after which a run is stopped.
    pub max_time_s: f64,
    /// Number of decoded blocks after which a run is stopped.
    pub max_blocks: u64,
    /// Whether keys of a list that are not modelled are refused.
    pub strict: bool,
    /// Whether kinematic transformations are treated as identity.
    pub identity_trafo: bool,
    /// Whether declared durations of M, H, S and T functions are waited for.
    pub techno_times: bool,
    /// External variables by their name after `V.E.`: a number, otherwise a text.
    pub external: Vec<(String, String)>,
    /// Numbers that replace those in the program.
    pub words: Vec<Word>,
    /// Vibration Guard that replaces the one of lists and program.
    pub guard: Option<ForcedGuard>,
    /// Stops it from another thread.
    pub stop: Stop,
}

impl SimulationArgs {
    /// The request for one program.
    pub fn request(&self, program: impl Into<PathBuf>) -> Request {
        Request {
            program: program.into(),
            machine: self.machine.clone(),
            settings: self.set.clone(),
            path: self.path.clone(),
            allow_outside: self.allow_outside,
            inputs: self.input.clone(),
            cycle_us: self.cycle_us,
            start: self.start.clone(),
            skip: self.skip.clone(),
            max_time_s: self.max_time,
            max_blocks: self.max_blocks,
            strict: self.strict,
            identity_trafo: self.identity_trafo,
            techno_times: self.techno_times,
            external: self.external.clone(),
            words: Vec::new(),
            guard: None,
            stop: self.stop.clone(),
        }
    }
}

/// A run before its first cycle.
#[derive(Debug)]
pub struct Opened {
    /// The run.
    pub run: Run,
    /// The files that it reads.
    pub reads: Reads,
}

/// Files that a run reads: lists, inputs and programs.
#[derive(Clone, Debug)]
pub struct Reads {
    others: Vec<PathBuf>,
    programs: ProgramFiles,
}

impl Reads {
    /// Every file that was read so far. Code that depends on the moving machine may call subroutines that the preceding
    /// check has not reached.
    pub(crate) fn so_far(&self) -> Vec<PathBuf> {
        self.others.iter().cloned().chain(self.programs.opened()).collect()
    }
}

/// A job with its sources.
struct Prepared {
    job: Job,
    sources: ProgramFiles,
    lists: Vec<PathBuf>,
    changes: Changes,
}

impl Request {
    /// The machine, with the warnings of its lists, which are read through `lists`.
    ///
    /// # Errors
    /// [`OpenError`] if a setting is wrong or the lists are refused.
    pub fn machine(&self, lists: &Lists) -> Result<(Machine, Vec<Diagnostic>), OpenError> {
        let (settings, cycle_us, strict) = (&self.settings, self.cycle_us, self.strict);
        let given = MachineLists { files: None, settings, cycle_us, strict };
        let load = |files: Option<(&dyn ListFiles, &str)>| {
            MachineLists { files, ..given }.load().map_err(OpenError::Lists)
        };
        match self.machine.as_deref().map(Place::of).transpose()? {
            None => load(None),
            Some(Place::StartUp(path)) => load(Some((lists, utf8(&path)?))),
            Some(Place::Project { name, paths }) => {
                paths.iter().try_for_each(|path| utf8(path).map(|_| ()))?;
                let parts = project::parts(paths, lists)?;
                let project = Project::read(lists, utf8(&name)?, &parts, given.sets_cycle())
                    .map_err(OpenError::Lists)?;
                let said = |more| project.said().iter().cloned().chain(more).collect();
                match load(Some((&project, project.start_up()))) {
                    Ok((machine, warnings)) => Ok((machine, said(warnings))),
                    Err(OpenError::Lists(errors)) => Err(OpenError::Lists(said(errors))),
                    Err(other) => Err(other),
                }
            }
        }
    }

    fn prepare(&self) -> Result<Prepared, OpenError> {
        readable(&self.program)?;
        folders(self)?;
        let lists = Lists::default();
        let (machine, warnings) = self.machine(&lists)?;
        let options = options(self, &machine)?;
        let changes = changes(&self.inputs, &machine)?;
        let sources = ProgramFiles::new(&self.program, self.path.clone(), self.allow_outside);
        let sources = self.with_words(sources)?;
        let program = if is_standard(&self.program) {
            STANDARD_INPUT.to_owned()
        } else {
            self.program.display().to_string()
        };
        let job = Job::new(machine, sources.clone(), program)
            .with_warnings(warnings)
            .with_options(options);
        Ok(Prepared { job, sources, lists: lists.read_so_far(), changes })
    }

    /// The files with numbers of the program replaced.
    fn with_words(&self, sources: ProgramFiles) -> Result<ProgramFiles, OpenError> {
        if self.words.is_empty() {
            return Ok(sources);
        }
        let text = sources.text().map_err(|e| OpenError::Io(self.program.clone(), e))?;
        let text = words::put(&text, &self.words);
        let text =
            text.map_err(|e| OpenError::Usage(format!("--vary: {}: {e}", self.program.display())))?;
        Ok(sources.with_text(text))
    }

    /// The job itself, without its inputs.
    ///
    /// # Errors
    /// [`OpenError`] if options, lists or files are wrong.
    pub fn job(&self) -> Result<Job, OpenError> {
        Ok(self.prepare()?.job)
    }

    /// Decodes the program without moving anything.
    ///
    /// # Errors
    /// [`OpenError`] if options, lists or files are wrong.
    pub fn check(&self) -> Result<Checked, OpenError> {
        Ok(self.job()?.check())
    }

    /// Opens the program. A refused program is opened as well: it has diagnostics, no cycles, and is aborted.
    ///
    /// # Errors
    /// [`OpenError`] if options, lists or files are wrong.
    pub fn open(&self) -> Result<Opened, OpenError> {
        let Prepared { job, sources, lists, changes } = self.prepare()?;
        let run = job.start().map_err(OpenError::Lists)?.with_inputs(changes);
        let others = lists.into_iter().chain(self.inputs.clone()).collect();
        Ok(Opened { run, reads: Reads { others, programs: sources } })
    }
}

/// The name of a list.
fn utf8(path: &Path) -> Result<&str, OpenError> {
    let reason = "lists refer to each other by name: the name must be UTF-8";
    path.to_str().ok_or_else(|| OpenError::Io(path.to_owned(), std::io::Error::other(reason)))
}

/// Checks that the folders of subroutines exist; otherwise the error would appear much later.
fn folders(request: &Request) -> Result<(), OpenError> {
    match request.path.iter().find(|folder| !folder.is_dir()) {
        Some(folder) => {
            Err(OpenError::Usage(format!("--path {}: no such folder", folder.display())))
        }
        None => Ok(()),
    }
}

/// A number with its exponent where its digits would fill the line.
fn short(x: f64) -> String {
    if x.abs() < 1e9 { x.to_string() } else { format!("{x:e}") }
}

fn options(request: &Request, machine: &Machine) -> Result<Options, OpenError> {
    for (i, (name, mm)) in request.start.iter().enumerate() {
        if request.start[..i].iter().any(|(other, _)| other.eq_ignore_ascii_case(name)) {
            return Err(OpenError::Usage(format!("--start: axis `{name}` twice")));
        }
        let axis = machine.axes.iter().position(|a| a.name().eq_ignore_ascii_case(name));
        if let Some((low, high)) = axis.and_then(|axis| machine.limits_without(axis, *mm)) {
            return Err(OpenError::Usage(format!(
                "--start: {name}{} is outside the limits of the axis, {low} to {high} (P-AXIS-00177, P-AXIS-00178)",
                short(*mm)
            )));
        }
        if axis.is_none() {
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
        guard: request.guard,
        stop: request.stop.clone(),
        ..Options::default()
    })
}

/// A number, TRUE and FALSE as in the language, or a text.
fn external((name, value): &(String, String)) -> (String, External) {
    let written = value.trim();
    let value = match written.parse::<f64>() {
        Ok(x) if x.is_finite() => Value::Number(x),
        _ if written.eq_ignore_ascii_case("TRUE") => Value::Number(1.0),
        _ if written.eq_ignore_ascii_case("FALSE") => Value::Number(0.0),
        _ => Value::Text(value.as_str().into()),
    };
    (name.clone(), External { value, access: Access::ReadWrite })
}

/// Real-time inputs of all files in the order of time.
fn changes(paths: &[PathBuf], machine: &Machine) -> Result<Changes, OpenError> {
    let names: Vec<String> = paths.iter().map(|path| path.display().to_string()).collect();
    // a pipe could not be read twice
    let files: Vec<_> =
        names.iter().zip(paths).map(|(name, path)| (&**name, || files::regular(path))).collect();
    inputs::open(&files, machine).map_err(|problem| match problem {
        inputs::Problem::Wrong(diagnostic) => OpenError::Inputs(vec![*diagnostic]),
        inputs::Problem::Io(name, e) => OpenError::Io(name.into(), e),
    })
}

/// Checks that a program is readable, so that the command fails before it decodes anything.
fn readable(program: &Path) -> Result<(), OpenError> {
    let name = if is_standard(program) { Path::new("standard input") } else { program };
    files::readable(program).map_err(|e| OpenError::Io(name.to_path_buf(), e))
}
