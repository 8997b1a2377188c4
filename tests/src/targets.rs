//! Targets of the fuzzer: one function for each way by which a file or a word from outside comes in.
//!
//! Each takes arbitrary bytes and panics if something that must always hold does not: a call returns; the exit code matches the messages;
//! numbers are finite; axes keep their velocity limit. The folder `fuzz` next to this one feeds the targets with coverage-guided input
//! within a time budget, `tests/hostile_input.rs` with bounded random input.

use crate::command::{Output, command};
pub use crate::seeds::{BETWEEN, corpus, dictionary, mutated};
use kontur::Exit;
use kontur::args::Args;
use kontur_interpreter::diag::{Condition, Diagnostic};
use kontur_interpreter::job::{Checked, Job, Options, Run};
use kontur_interpreter::machine::{Axis, AxisKind, ListFiles, Machine, Override};
use kontur_interpreter::record::{AxisRecord, CycleRecord};
use kontur_interpreter::source::MemorySources;
use std::ffi::OsString;
use std::sync::{Arc, LazyLock};

/// A target: its name and its function.
pub type Target = (&'static str, fn(&[u8]));

/// All targets.
pub const TARGETS: [Target; 8] = [
    ("check", check),
    ("run", run),
    ("lists", lists),
    ("inputs", inputs),
    ("recording", recording),
    ("diff", diff),
    ("command_line", command_line),
    ("report", report),
];

/// Program time of a run in s.
const TIME_S: f64 = 2.0;
/// Messages for one program: the limits of the executor, and 10 from its last block.
const MESSAGES_MAX: usize = 2000;

/// The built-in machine, also with filters, and sample machines.
static MACHINES: LazyLock<[Arc<Machine>; 5]> = LazyLock::new(|| {
    let samples = ["vendor_defaults", "xyz_hsc", "two_spindles"];
    let [defaults, hsc, spindles] = samples.map(|name| crate::sample_machine(name, &[]));
    [
        crate::machine(&[]),
        crate::machine("X.filter[0]: enable=1, order=2, fg_f0=30"),
        defaults,
        hsc,
        spindles,
    ]
    .map(|(machine, _)| Arc::new(machine))
});

/// The machine for an input: any of them, always the same for one input.
fn machine_for(data: &[u8]) -> &'static Arc<Machine> {
    let sum: usize = data.iter().map(|byte| usize::from(*byte)).sum();
    &MACHINES[sum % MACHINES.len()]
}

fn options() -> Options {
    Options {
        max_blocks: 20_000,
        max_blocks_at_rest: 10_000,
        max_time_s: TIME_S,
        ..Options::default()
    }
}

/// The program, also under the names that it may call.
fn job(machine: Arc<Machine>, program: &[u8]) -> Job {
    let sources = MemorySources::new().with("main.nc", program).with("sub.nc", program);
    Job::new(machine, sources, "main.nc").with_options(options())
}

fn checked(program: &[u8]) -> Checked {
    let checked = job(Arc::clone(machine_for(program)), program).check();
    let found = &checked.diagnostics;
    assert!(found.len() <= MESSAGES_MAX, "{} messages", found.len());
    for d in found {
        assert!(!d.text.is_empty() && d.id != Condition::Internal, "{d:?}");
        if let Some(place) = &d.source {
            let characters = place.text.chars().count() as u64;
            assert!(place.offset <= program.len() as u64, "{d:?}");
            assert!(place.line > 0 && u64::from(place.column) <= characters + 1, "{d:?}");
        }
    }
    checked
}

/// A program is decoded.
pub fn check(data: &[u8]) {
    checked(data);
}

/// A program runs for two seconds, unless the check refuses it.
pub fn run(data: &[u8]) {
    if checked(data).refuses() {
        return;
    }
    let machine = machine_for(data);
    let cycle_s = machine.cycle.seconds();
    let job = job(Arc::clone(machine), data);
    let mut run = job.start().expect("a machine without plants of its own");
    let mut speeds = Speeds::new(machine);
    let mut cycles = 0_u64;
    let Ok(()) = run.to_end(&mut |record: &CycleRecord| {
        assert_eq!(record.k, cycles, "rows are cycles");
        cycles += 1;
        // braking after a limit has been reached takes time
        assert!(cycles as f64 * cycle_s < TIME_S + 60.0, "the run does not end");
        for (i, axis) in record.axes.iter().enumerate() {
            assert!(is_finite(axis), "axis {i} in cycle {}: {axis:?}", record.k);
        }
        let path = &record.path;
        let values = [path.s_mm, path.v_mm_s, path.a_mm_s2, path.j_mm_s3, record.contour_err_mm];
        assert!(values.iter().all(|v| v.is_finite()), "cycle {}: {path:?}", record.k);
        speeds.keep_limits(record);
    });
    ends_as_it_says(&mut run);
}

/// Whether all quantities of an axis are numbers.
fn is_finite(a: &AxisRecord) -> bool {
    let path = [a.ipo, a.set, a.vel, a.acc, a.jerk, a.err, a.dev, a.add];
    let control = [a.reference, a.act, a.load, a.lag, a.ff, a.cmd, a.vadd, a.tcp, a.tcp_acc];
    let drive = [a.cmd_drive, a.vff_drive, a.vadd_drive, a.torque_drive, a.torque_n_m];
    path.iter().chain(&control).chain(&drive).all(|x| x.is_finite())
}

/// Compares the interpolated positions of one cycle with those of the next.
struct Speeds {
    /// Limit, and the length of a revolution for an axis that may wrap around.
    axes: Vec<(f64, Option<f64>)>,
    cycle_s: f64,
    before: Vec<f64>,
}

impl Speeds {
    fn new(machine: &Machine) -> Self {
        let turn = |a: &Axis| (a.kind() != AxisKind::Linear).then_some(360.0);
        let axes = machine.axes.iter().map(|a| (a.dynamics().v_max_mm_s, turn(a)));
        Self { axes: axes.collect(), cycle_s: machine.cycle.seconds(), before: Vec::new() }
    }

    /// No axis exceeds its velocity limit.
    fn keep_limits(&mut self, record: &CycleRecord) {
        let now: Vec<f64> = record.axes.iter().take(self.axes.len()).map(|a| a.ipo).collect();
        for (i, (from, to)) in self.before.iter().zip(&now).enumerate() {
            let (v_max, turn) = self.axes[i];
            let way = turn
                .map_or(to - from, |turn| (to - from + turn / 2.0).rem_euclid(turn) - turn / 2.0);
            let v = way.abs() / self.cycle_s;
            assert!(v <= v_max * (1.0 + 1e-6) + 1e-6, "axis {i} at {v} mm/s, cycle {}", record.k);
        }
        self.before = now;
    }
}

/// A run is aborted if and only if it reports an error.
fn ends_as_it_says(run: &mut Run) {
    let (aborted, said) = (run.totals().aborted, run.take_diagnostics());
    assert_eq!(aborted, said.iter().any(Diagnostic::is_error), "{said:?}");
}

/// The parts of an input.
fn parts(data: &[u8]) -> Vec<&[u8]> {
    let mut parts = Vec::new();
    let mut rest = data;
    while let Some(at) = rest.windows(BETWEEN.len()).position(|w| w == BETWEEN) {
        parts.push(&rest[..at]);
        rest = &rest[at + BETWEEN.len()..];
    }
    parts.push(rest);
    parts
}

struct InMemory<'a>(Vec<&'a [u8]>);

impl ListFiles for InMemory<'_> {
    fn read(&self, path: &str) -> Result<Option<Vec<u8>>, String> {
        let name = path.rsplit('/').next().unwrap_or(path);
        let i =
            ["hochlauf.lis", "channel.lis", "x.lis", "kontur.lis"].iter().position(|n| *n == name);
        Ok(i.and_then(|i| self.0.get(i)).map(|bytes| bytes.to_vec()))
    }
}

/// Lists of a machine, which is built and then moved.
pub fn lists(data: &[u8]) {
    let files = InMemory(parts(data));
    let Ok((machine, said)) = Machine::load(&files, "m/hochlauf.lis", &[]) else { return };
    let (_, chains) = machine.chains();
    if said.iter().chain(&chains).any(Diagnostic::is_error) {
        return;
    }
    let axis = machine.axes.first().map_or("X", |a| a.name()).to_owned();
    let program = format!("G01 {axis}=0.5 F600\nG00 {axis}=0\nM30\n");
    let cycles = (TIME_S / machine.cycle.seconds()) as u64;
    if cycles > 100_000 {
        // a cycle of microseconds would only make the run long
        return;
    }
    let mut speeds = Speeds::new(&machine);
    let Ok(mut run) = job(Arc::new(machine), program.as_bytes()).start() else { return };
    let Ok(()) = run.to_end(&mut |record: &CycleRecord| {
        for (i, axis) in record.axes.iter().enumerate() {
            let values = [axis.ipo, axis.set];
            assert!(
                values.iter().all(|v| v.is_finite()),
                "axis {i} in cycle {}: {axis:?}",
                record.k
            );
        }
        speeds.keep_limits(record);
    });
    ends_as_it_says(&mut run);
}

/// Calls the command line on files of its own; words that begin with `@` name these files.
fn call(files: &[(&str, &[u8])], words: &[&str]) -> Output {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for (name, bytes) in files {
        std::fs::write(folder.path().join(name), bytes).expect("a temporary file");
    }
    let word = |w: &&str| match w.strip_prefix('@') {
        Some(name) => folder.path().join(name).into_os_string(),
        None => OsString::from(*w),
    };
    let said = command(words.iter().map(word));
    assert!(!said.err.contains("panicked"), "{}", said.err);
    let told = said.err.lines().any(|line| line.starts_with("error"));
    let is_finished = said.exit == Exit::Finished;
    assert!(!(is_finished && told), "{words:?} finishes with an error: {}", said.err);
    assert!(is_finished || told || !said.out.is_empty(), "{words:?} says nothing");
    let names = std::fs::read_dir(folder.path()).expect("the folder").flatten();
    let left = names.map(|e| e.file_name()).find(|n| n.to_string_lossy().starts_with('.'));
    assert_eq!(left, None, "{words:?} leaves a temporary file");
    said
}

const LIMITS: [&str; 4] = ["--max-time", "2", "--max-blocks", "20000"];

/// Real-time inputs of a run.
pub fn inputs(data: &[u8]) {
    let program = b"#VIB GUARD ON [MODE=2 FREQ=40]\nG01 X5 Y3 F3000\nG04 0.1\nX0\nM30\n";
    let words = [&["run", "@a.nc", "--input", "@in.csv", "-o", "@a.csv"], &LIMITS[..]].concat();
    let files = [("a.nc", &program[..]), ("in.csv", data)];
    let folder = call(&files, &words);
    assert!(!folder.out.contains("NaN") && !folder.out.contains("inf "), "{}", folder.out);
}

/// A recording of a vibration.
pub fn recording(data: &[u8]) {
    let said = call(&[("r.csv", data)], &["tune", "--recording", "@r.csv"]);
    assert!(said.exit != Exit::Aborted && !said.out.contains("NaN"), "{}", said.out);
}

/// Two traces are compared, in both directions.
pub fn diff(data: &[u8]) {
    let parts = parts(data);
    let (a, b) = (parts[0], parts.get(1).copied().unwrap_or_default());
    let files = [("a.csv", a), ("b.csv", b)];
    let there = call(&files, &["diff", "@a.csv", "@b.csv"]).exit;
    let back = call(&files, &["diff", "@b.csv", "@a.csv"]).exit;
    // if neither table can be read, the first one decides on the exit
    let is_read = |exit| exit == Exit::Finished || exit == Exit::Aborted;
    assert!(there == back || !is_read(there) && !is_read(back), "{there:?} {back:?}");
    // what can be read is equal to itself
    if is_read(there) {
        assert_eq!(call(&files, &["diff", "@a.csv", "@a.csv"]).exit, Exit::Finished);
    }
}

/// The words of a command line, one per line, are parsed, and settings of lists are taken or refused; nothing is executed.
pub fn command_line(data: &[u8]) {
    use clap::Parser as _;
    let text = String::from_utf8_lossy(data);
    let words = std::iter::once("kontur").chain(text.lines());
    for setting in text.lines().filter_map(|line| Override::parse(line).ok()) {
        let _ = Machine::builtin(&[setting]);
    }
    match Args::try_parse_from(words) {
        Ok(args) => drop(format!("{args:?}")),
        Err(e) => drop(e.to_string()),
    }
}

/// A program is turned into a picture and a page.
pub fn report(data: &[u8]) {
    for output in ["@a.svg", "@a.html"] {
        let words = [&["report", "@a.nc", "-o", output], &LIMITS[..]].concat();
        call(&[("a.nc", data)], &words);
    }
}
