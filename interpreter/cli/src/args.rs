//! The command line as clap sees it. Wrong usage ends with exit code 2.

use crate::request::Request;
use clap::{Parser, Subcommand, ValueEnum};
use kontur_interpreter::job::Stop;
use kontur_interpreter::machine::Override;
use kontur_interpreter::record::columns::DEFAULT_SIGNALS;
use std::path::PathBuf;

/// Headless NC kernel simulator for the ISG / TwinCAT 3 CNC dialect.
#[derive(Clone, Debug, Parser)]
#[command(name = "kontur", version, arg_required_else_help = true)]
pub struct Args {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

/// The subcommands.
#[derive(Clone, Debug, Subcommand)]
pub enum Command {
    /// Execute a program: setpoints per axis and cycle, and a summary.
    Run(RunArgs),
    /// Parse and decode programs without moving anything; shows every diagnostic.
    Check(CheckArgs),
    /// Compare two traces, or a trace and a fresh run; exit code 1 if they differ.
    Diff(DiffArgs),
    /// Run programs and write one self-contained page (.html) or picture (.svg).
    Report(ReportArgs),
    /// Frequency response, step response, residual vibration or corner of filters, shapers and axes.
    Response(crate::response::args::ResponseArgs),
    /// Run a program under every combination of parameters, on all cores; one row per run.
    Sweep(crate::sweep::args::SweepArgs),
    /// Propose Vibration Guard settings from measured frequencies or recordings, or the order of a filter.
    Tune(crate::tune::args::TuneArgs),
    /// Explain an error ID, a parameter or a command.
    Explain(ExplainArgs),
}

impl Command {
    /// How its messages are printed.
    pub const fn message_form(&self) -> MessageForm {
        match self {
            Self::Run(a) => a.simulation.diagnostics,
            Self::Check(a) => a.simulation.diagnostics,
            Self::Diff(a) => a.simulation.diagnostics,
            Self::Report(a) => a.simulation.diagnostics,
            Self::Sweep(a) => a.simulation.diagnostics,
            Self::Tune(a) => a.simulation.diagnostics,
            Self::Response(_) | Self::Explain(_) => MessageForm::Text,
        }
    }
}

/// How results are printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum SummaryForm {
    /// Readable text.
    Text,
    /// One JSON object.
    Json,
    /// Nothing.
    None,
}

/// How messages are printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum MessageForm {
    /// Readable text with the source line.
    Text,
    /// One JSON object per line.
    Json,
}

/// How a comparison is printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum OutputForm {
    /// Readable text.
    Text,
    /// One JSON object.
    Json,
    /// `JUnit` XML: a test case for each signal.
    Junit,
    /// Commands of GitHub's workflow log, at the NC lines.
    Github,
}

/// How the result of a check is printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum CheckForm {
    /// Messages on stderr in the form of --diagnostics.
    Text,
    /// One JSON object on stdout.
    Json,
    /// SARIF 2.1.0 on stdout, for code scanning services.
    Sarif,
    /// Commands of GitHub's workflow log on stdout, at the NC lines.
    Github,
}

/// What else makes a check fail.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Deny {
    /// Warnings.
    Warnings,
}

/// Options that decide what is simulated.
#[expect(clippy::struct_excessive_bools, reason = "each is a switch of its own for the user")]
#[derive(Clone, Debug, clap::Args)]
pub struct SimulationArgs {
    /// Machine: a folder with a start-up list, the list itself, or a TwinCAT project (.tsproj, .xti) [default: the built-in xyz]
    #[arg(short, long, value_name = "DIR")]
    pub machine: Option<PathBuf>,

    /// A list parameter in place of the machine's, e.g. `X.getriebe[0].kv=5000`, `X,Y.key=value`, `*.key=value` for every path axis
    /// or `channel.key=value`
    #[arg(long, value_name = "AXIS.KEY=VALUE", value_parser = setting)]
    pub set: Vec<String>,

    /// Folder with global subroutines, searched after the caller's own
    #[arg(long, value_name = "DIR")]
    pub path: Vec<PathBuf>,

    /// Let subroutines lie outside the program's folder and --path
    #[arg(long)]
    pub allow_outside: bool,

    /// Real-time inputs: CSV with the columns `t_s` and signals (`override_percent`, `rapid_override_percent`,
    /// `feedhold`, `X_add_mm`, `X_force_mm_s2`, `X_encoder_offset_mm`); a value holds until the next time stamp. May be
    /// given several times
    #[arg(long, value_name = "FILE")]
    pub input: Vec<PathBuf>,

    /// Cycle time in microseconds in place of the machine's
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pub cycle_us: Option<u32>,

    /// Start positions in mm (deg), e.g. `X10,Y5`
    #[arg(long, value_name = "POSITIONS", value_delimiter = ',', value_parser = position)]
    pub start: Vec<(String, f64)>,

    /// Active skip levels, e.g. `1,3`
    #[arg(long, value_name = "LEVELS", value_delimiter = ',', value_parser = clap::value_parser!(u8).range(1..=10))]
    pub skip: Vec<u8>,

    /// Stop after this program time in seconds
    #[arg(long, value_name = "S", default_value = "86400", value_parser = positive)]
    pub max_time: f64,

    /// Stop after this number of executed blocks
    #[arg(long, value_name = "N", default_value_t = 100_000_000, value_parser = clap::value_parser!(u64).range(1..))]
    pub max_blocks: u64,

    /// Refuse list keys that are not modelled
    #[arg(long)]
    pub strict: bool,

    /// Take kinematic transformations (#TRAFO, #RTCP, #KIN ID) as identity, with a warning
    #[arg(long)]
    pub identity_trafo: bool,

    /// Wait for M, H and S functions as long as the channel list declares (P-CHAN-00026, 00040, 00042 to 00048, 00080); without
    /// it they take no time and the summary names them
    #[arg(long)]
    pub techno_times: bool,

    /// Value of an external variable at program start, e.g. `Speed=1200` for V.E.Speed
    #[arg(long, value_name = "NAME=VALUE", value_parser = external)]
    pub external: Vec<(String, String)>,

    /// Form of the messages on stderr
    #[arg(long, value_enum, default_value_t = MessageForm::Text)]
    pub diagnostics: MessageForm,

    /// Ends check and run from another thread; nothing on the command line
    #[arg(skip)]
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
            guard: None,
            stop: self.stop.clone(),
        }
    }
}

/// `kontur run`.
#[derive(Clone, Debug, clap::Args)]
pub struct RunArgs {
    /// The NC program; `-` reads it from standard input
    pub program: PathBuf,

    /// Write a trace; `.parquet` or, with any other name, CSV; `-` writes CSV to stdout and the summary to stderr. May be
    /// given several times
    #[arg(short, long, value_name = "FILE")]
    pub output: Vec<PathBuf>,

    /// Columns of the trace: groups or names, separated by commas
    #[arg(long, value_name = "GROUPS|NAMES", default_value = DEFAULT_SIGNALS, requires = "output")]
    pub signals: String,

    /// Write every N-th cycle only
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u64).range(1..), requires = "output")]
    pub decimate: u64,

    /// Form of the summary on stdout (stderr with `-o -`)
    #[arg(long, value_enum, default_value_t = SummaryForm::Text)]
    pub summary: SummaryForm,

    /// Account for the time by line and by what held the speed down: in the summary, or every line in a table. What would help is tried
    /// out, with a run for each proposal
    #[arg(long, value_name = "FILE.csv", num_args = 0..=1, require_equals = true, value_parser = table)]
    pub times: Option<Option<PathBuf>>,

    /// What is simulated
    #[command(flatten)]
    pub simulation: SimulationArgs,
}

/// `kontur check`.
#[derive(Clone, Debug, clap::Args)]
pub struct CheckArgs {
    /// The NC programs; a folder stands for every `.nc` file below it, `-` reads one from standard input
    #[arg(required = true)]
    pub programs: Vec<PathBuf>,

    /// Form of the result
    #[arg(long, value_enum, default_value_t = CheckForm::Text)]
    pub format: CheckForm,

    /// Exit code 1 for these as well as for errors
    #[arg(long, value_enum)]
    pub deny: Option<Deny>,

    /// What is simulated
    #[command(flatten)]
    pub simulation: SimulationArgs,
}

/// `kontur diff`.
#[derive(Clone, Debug, clap::Args)]
pub struct DiffArgs {
    /// A CSV or Parquet trace, or an NC program to run now
    pub a: PathBuf,

    /// A CSV or Parquet trace, or an NC program to run now; with --map a recording
    pub b: PathBuf,

    /// B is a recording of a machine (CSV with comma, semicolon or tab, any header, or an export of TwinCAT Scope): the column
    /// of A that a channel recorded, with a factor for unit and sign, e.g. `X_act_mm=MAIN.fActX` or `X_act_mm=-1000*Axis1.Pos`.
    /// The shift in time is found; positions count as equal up to 0.1 um at least
    #[arg(long, value_name = "COLUMN=CHANNEL")]
    pub map: Vec<crate::diff::Pairing>,

    /// Tolerances by unit
    #[command(flatten)]
    pub tolerance: crate::diff::Tolerance,

    /// Form of the result on stdout
    #[arg(long, value_enum, default_value_t = OutputForm::Text)]
    pub format: OutputForm,

    /// How a program among the two is run
    #[command(flatten)]
    pub simulation: SimulationArgs,
}

/// `kontur report`.
#[derive(Clone, Debug, clap::Args)]
pub struct ReportArgs {
    /// The NC programs; several overlay
    #[arg(required = true)]
    pub programs: Vec<PathBuf>,

    /// The page (`.html`), picture (`.svg`) or, with --signals, table (`.csv`) [default: the first program's name with
    /// .html]
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,

    /// Run every program with each of these values of a list parameter or external variable, as in `sweep`. May be given
    /// several times
    #[arg(long, value_name = "KEY=VALUES")]
    pub vary: Vec<crate::vary::Vary>,

    /// Draw these columns of the trace over time in place of contour and speed: names or groups, separated by commas
    #[arg(long, value_name = "GROUPS|NAMES")]
    pub signals: Option<String>,

    /// Draw the amplitude of each of them over these frequencies in Hz as well, e.g. `2..80`
    #[arg(long, value_name = "HZ..HZ", requires = "signals", value_parser = crate::sweep::args::span)]
    pub spectrum: Option<(f64, f64)>,

    /// Part of the run in s that is drawn, e.g. `0.7..1.9`: of a long run every cycle of it
    #[arg(long, value_name = "S..S", value_parser = crate::sweep::args::span)]
    pub window: Option<(f64, f64)>,

    /// What is simulated
    #[command(flatten)]
    pub simulation: SimulationArgs,
}

/// `kontur explain`.
#[derive(Clone, Debug, clap::Args)]
pub struct ExplainArgs {
    /// An error ID (22060, P-ERR-70082, K-0012), a parameter (P-AXIS-00571 or its key) or a command
    #[arg(required = true)]
    pub thing: Vec<String>,
}

/// The name of a table.
fn table(text: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(text);
    let is_csv = path.extension().is_some_and(|e| e.eq_ignore_ascii_case("csv"));
    if is_csv { Ok(path) } else { Err("the table of all lines is a .csv file".to_owned()) }
}

/// The form only; what the words name is the machine's business.
pub(crate) fn setting(text: &str) -> Result<String, String> {
    match Override::parse(text) {
        Ok(_) => Ok(text.to_owned()),
        Err(d) => Err(d.hint.unwrap_or(d.text)),
    }
}

/// `NAME=VALUE`.
fn external(text: &str) -> Result<(String, String), String> {
    match text.split_once('=') {
        Some((name, value)) if !name.trim().is_empty() => {
            Ok((name.trim().to_owned(), value.to_owned()))
        }
        _ => Err("NAME=VALUE is expected".to_owned()),
    }
}

/// `X10`, `X=10`, `X1=10`: an axis name that ends in a digit needs the equals sign.
fn position(text: &str) -> Result<(String, f64), String> {
    let text = text.trim();
    let (name, number) = match text.split_once('=') {
        Some((name, number)) => (name, number),
        None => text.split_at(text.find(|c: char| !c.is_ascii_alphabetic()).unwrap_or(text.len())),
    };
    let value: f64 =
        number.trim().parse().map_err(|_| format!("`{text}`: X10 or X=10 expected"))?;
    if name.trim().is_empty() || !value.is_finite() {
        return Err(format!("`{text}`: X10 or X=10 expected"));
    }
    Ok((name.trim().to_owned(), value))
}

/// A finite number above zero.
fn positive(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(v) if v.is_finite() && v > 0.0 => Ok(v),
        _ => Err("a number above 0 is expected".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(words: &str) -> Result<Args, clap::Error> {
        Args::try_parse_from(std::iter::once("kontur").chain(words.split_whitespace()))
    }

    #[test]
    fn definitions_are_consistent() {
        use clap::CommandFactory as _;
        Args::command().debug_assert();
    }

    #[test]
    fn run_takes_settings_and_start() {
        let args = parse(
            "run part.nc -o a.csv -o b.parquet --set X.getriebe[0].kv=5000 --start X10,Y-5.5,A1=3 \
             --skip 1,3 --cycle-us 500 --summary json --diagnostics json",
        )
        .unwrap();
        let Command::Run(run) = args.command else { panic!("run expected") };
        let request = run.simulation.request(&run.program);
        assert_eq!(run.output.len(), 2);
        assert_eq!(request.settings, ["X.getriebe[0].kv=5000"]);
        let start = [("X".to_owned(), 10.0), ("Y".to_owned(), -5.5), ("A1".to_owned(), 3.0)];
        assert_eq!(request.start, start);
        assert_eq!(request.skip, [1, 3]);
        assert_eq!(request.cycle_us, Some(500));
    }

    #[test]
    fn wrong_usage_is_refused() {
        for words in [
            "run",
            "run a b",
            "run a --set Xkv=1",
            "run a --set X.kv",
            "run a --set X.=1",
            "run a --start 10",
            "run a --start Xnan",
            "run a --cycle-us 0",
            "run a --decimate 0",
            "run a --max-time -1",
            "run a --max-time inf",
            "run a --skip 11",
            "run a --signals ipo",
            "run a --decimate 2",
            "response --hsc-mean 5 --order 3",
            "tune --order-for 0.1 --max-residual 3",
            "diff a",
            "frobnicate",
        ] {
            assert_eq!(parse(words).unwrap_err().exit_code(), 2, "{words}");
        }
    }
}
