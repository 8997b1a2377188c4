//! Helpers shared by the cross-crate tests: programs as text, on the built-in machine or a sample machine.

pub mod command;
pub mod geometry;
mod seeds;
pub mod suite;
pub mod targets;

use kontur_interpreter::diag::{Diagnostic, Id};
use kontur_interpreter::job::{Change, Job, Options, Signal, Totals};
use kontur_interpreter::machine::{ListFiles, Machine, Override};
use kontur_interpreter::record::{CycleRecord, Rest};
use kontur_interpreter::source::MemorySources;
use kontur_kit::Random;
use kontur_kit::rows::settings;
use std::path::{Path, PathBuf};

/// All outputs of a run.
#[derive(Debug)]
pub struct Run {
    /// One record per cycle; empty if the program was refused.
    pub records: Vec<CycleRecord>,
    /// All messages, those of the machine first.
    pub diagnostics: Vec<Diagnostic>,
    /// Totals.
    pub totals: Totals,
    /// Cycle time in s.
    pub cycle_s: f64,
}

impl Run {
    /// Vendor numbers of the messages.
    pub fn ids(&self) -> Vec<u32> {
        let number = |d: &Diagnostic| match d.id {
            Id::Vendor(n) => Some(n),
            Id::Kontur(_) => None,
        };
        self.diagnostics.iter().filter_map(number).collect()
    }

    /// IDs of the messages as printed.
    pub fn said(&self) -> Vec<String> {
        self.diagnostics.iter().map(|d| d.id.to_string()).collect()
    }

    /// IDs of the errors.
    pub fn errors(&self) -> Vec<String> {
        self.diagnostics.iter().filter(|d| d.is_error()).map(|d| d.id.to_string()).collect()
    }

    /// Cycles in which the path rests and waits for something.
    pub fn rested(&self, rest: Rest) -> usize {
        self.records.iter().filter(|r| r.path.rest == Some(rest)).count()
    }

    /// A value of one axis over all cycles.
    pub fn axis(
        &self,
        i: usize,
        f: impl Fn(&kontur_interpreter::record::AxisRecord) -> f64,
    ) -> Vec<f64> {
        self.records.iter().map(|r| f(&r.axes[i])).collect()
    }

    /// Set positions of an axis over all cycles, and their differences per second up to the third.
    pub fn derivatives(&self, axis: usize) -> [Vec<f64>; 4] {
        let rate = |x: &[f64]| -> Vec<f64> {
            x.windows(2).map(|w| (w[1] - w[0]) / self.cycle_s).collect()
        };
        let set = self.axis(axis, |a| a.set);
        let velocity = rate(&set);
        let acceleration = rate(&velocity);
        let jerk = rate(&acceleration);
        [set, velocity, acceleration, jerk]
    }

    /// Whether nothing shapes an axis: set and interpolated position are the same bits in every cycle.
    pub fn is_unshaped(&self, axis: usize) -> bool {
        self.records.iter().all(|r| r.axes[axis].set.to_bits() == r.axes[axis].ipo.to_bits())
    }

    /// The cycles in which a line of the program moves or waits, in their order.
    pub fn of_line(&self, line: u32) -> impl DoubleEndedIterator<Item = &CycleRecord> + Clone {
        self.records.iter().filter(move |r| r.line == line)
    }

    /// Cycles by which `set` of X is later than `ipo` in the middle of the motion of a line along X, at constant speed.
    pub fn delay_cycles(&self, line: u32) -> f64 {
        let of_line: Vec<_> = self.of_line(line).collect();
        assert!(!of_line.is_empty(), "{:?}", self.diagnostics);
        let middle = of_line[of_line.len() / 2];
        assert!(middle.path.a_mm_s2.abs() < 1e-9, "{middle:?}");
        (middle.axes[0].ipo - middle.axes[0].set) / (middle.path.v_mm_s * self.cycle_s)
    }

    /// Speeds of the spindle of the built-in machine in rev/min during a line of the program.
    pub fn spindle_rpm(&self, line: u32) -> Vec<f64> {
        let of_line = self.records.windows(2).filter(|w| w[1].line == line);
        of_line.map(|w| (w[1].axes[3].set - w[0].axes[3].set) / self.cycle_s / 6.0).collect()
    }

    /// Set positions of the first `n` axes.
    pub fn set(&self, n: usize) -> Vec<Vec<f64>> {
        self.records.iter().map(|r| r.axes[..n].iter().map(|a| a.set).collect()).collect()
    }
}

/// Folder of the repository's sample programs.
pub fn programs() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../programs")
}

struct Folder(PathBuf);

impl ListFiles for Folder {
    fn read(&self, path: &str) -> Result<Option<Vec<u8>>, String> {
        Ok(std::fs::read(self.0.join(path)).ok())
    }
}

/// Settings of the lists: one by one (`X.getriebe[0].kv=5000`), or all in a text in the form of the tables
/// (`X.filter[0]: enable=1, order=4; Y.getriebe[0].kv=5000`).
pub trait Settings {
    /// The settings.
    fn overrides(&self) -> Vec<Override>;
}

fn parsed(settings: &[impl AsRef<str>]) -> Vec<Override> {
    settings.iter().map(|setting| Override::parse(setting.as_ref()).unwrap()).collect()
}

impl Settings for &str {
    fn overrides(&self) -> Vec<Override> {
        parsed(&settings(self))
    }
}

impl Settings for &String {
    fn overrides(&self) -> Vec<Override> {
        self.as_str().overrides()
    }
}

impl<const N: usize> Settings for &[&str; N] {
    fn overrides(&self) -> Vec<Override> {
        parsed(&self[..])
    }
}

impl<S: AsRef<str>> Settings for &[S] {
    fn overrides(&self) -> Vec<Override> {
        parsed(self)
    }
}

impl<S: AsRef<str>> Settings for &Vec<S> {
    fn overrides(&self) -> Vec<Override> {
        parsed(self)
    }
}

/// The built-in machine with settings.
pub fn machine(settings: impl Settings) -> (Machine, Vec<Diagnostic>) {
    Machine::builtin(&settings.overrides()).unwrap()
}

/// The built-in machine with settings, and with 1000 mm/s2 in all stages of the linear slope of the path axes.
pub fn linear_machine(settings: &[&str]) -> (Machine, Vec<Diagnostic>) {
    let stages = "X,Y,Z.getriebe[0].lslope_profil: a_stufe_1=1000, a_stufe_2=1000, a_grenz_stufe_1=1000, \
                  a_grenz_stufe_2=1000";
    let overrides = [stages.overrides(), settings.overrides()].concat();
    Machine::builtin(&overrides).unwrap()
}

/// A machine of `programs/machines` with settings.
pub fn sample_machine(name: &str, settings: impl Settings) -> (Machine, Vec<Diagnostic>) {
    let start_up = format!("machines/{name}/hochlauf.lis");
    Machine::load(&Folder(programs()), &start_up, &settings.overrides()).unwrap()
}

/// A machine of `tests/suite/machines`, some of whose lists are those of the sample machines.
pub fn suite_machine(name: &str, settings: impl Settings) -> (Machine, Vec<Diagnostic>) {
    let start_up = format!("tests/suite/machines/{name}/hochlauf.lis");
    Machine::load(&Folder(programs().join("..")), &start_up, &settings.overrides()).unwrap()
}

/// Runs a program text on the built-in machine.
pub fn run(program: &str, settings: impl Settings) -> Run {
    run_on(machine(settings), program)
}

/// Runs a program text on a machine, unless the check refuses it first, as on the command line.
pub fn run_on(machine: (Machine, Vec<Diagnostic>), program: &str) -> Run {
    run_with_inputs(machine, program, &[])
}

/// Runs a program text under real-time inputs: time in s, name of the signal, value.
pub fn run_with_inputs(
    (machine, warnings): (Machine, Vec<Diagnostic>),
    program: &str,
    inputs: &[(f64, &str, f64)],
) -> Run {
    let signals = Signal::all(&machine);
    let signal = |name: &str| signals.iter().find(|(n, _)| n == name).unwrap().1;
    let changes: Vec<Result<Change, Box<Diagnostic>>> =
        inputs.iter().map(|(t, name, x)| Ok(Change::new(*t, signal(name), *x).unwrap())).collect();
    let cycle_s = machine.cycle.seconds();
    let sources = MemorySources::new().with("part.nc", program.as_bytes().to_vec());
    let options = Options { max_time_s: 1000.0, ..Options::default() };
    let job = Job::new(machine, sources, "part.nc").with_warnings(warnings).with_options(options);
    let mut run = job.start().unwrap().with_inputs(Box::new(changes.into_iter()));
    let mut records = Vec::new();
    let Ok(()) = run.to_end(&mut |record: &CycleRecord| records.push(record.clone()));
    Run { records, diagnostics: run.take_diagnostics(), totals: run.totals(), cycle_s }
}

/// Points that run back and forth along X, offset by a small distance across it.
pub fn there_and_back(random: &mut Random) -> Vec<[f64; 2]> {
    let many = 2 + random.below(5);
    let point = |i| {
        let across = random.log(0.01, 5.0) * random.pick(&[1.0, -1.0]);
        [if i % 2 == 0 { random.between(5.0, 60.0) } else { random.between(-5.0, 5.0) }, across]
    };
    (0..many).map(point).collect()
}

/// Largest difference between successive values.
pub fn largest_step(values: &[f64]) -> f64 {
    values.windows(2).map(|w| (w[1] - w[0]).abs()).fold(0.0, f64::max)
}

/// Envelope of a spring-mass model (`f_hz`, `damping`) after the last change of `u`, driven by `u` held over each cycle.
pub fn residual_mm(u: &[f64], cycle_s: f64, f_hz: f64, damping: f64) -> f64 {
    let w = 2.0 * std::f64::consts::PI * f_hz;
    let wd = w * (1.0 - damping * damping).sqrt();
    let e = libm::exp(-damping * w * cycle_s);
    let (s, c) = (libm::sin(wd * cycle_s), libm::cos(wd * cycle_s));
    let k = damping * w / wd;
    let (mut y, mut v) = (0.0, 0.0);
    let mut envelope = 0.0;
    for n in 1..u.len() {
        // free vibration of the deviation over one cycle, then the base moves
        let next = e * ((c + k * s) * y + s / wd * v);
        v = e * (-s * w * w / wd * y + (c - k * s) * v);
        y = next - (u[n] - u[n - 1]);
        if (u[n] - u[n - 1]).abs() > 1e-12 {
            envelope = libm::hypot(y, (v + damping * w * y) / wd);
        }
    }
    envelope
}
