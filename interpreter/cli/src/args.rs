//! The command line as parsed by clap. Wrong usage ends with exit code 2.
//!
//! The first step of every call: words become arguments, and arguments a [`Request`](crate::request::Request).
//!
//! ```
//! use clap::Parser as _;
//! use kontur::args::{Args, Command};
//!
//! let words = ["kontur", "run", "part.nc", "--set", "X.getriebe[0].kv=3000", "--max-time", "5"];
//! let Command::Run(run) = Args::try_parse_from(words)?.command else { unreachable!() };
//! let request = run.simulation.request(&run.program);
//! assert_eq!((request.settings.len(), request.max_time_s), (1, 5.0));
//! # Ok::<(), clap::Error>(())
//! ```

mod diff;
mod response;
mod simulation;
mod sweep;
mod tune;
pub(crate) mod values;
pub(crate) mod vary;

use clap::{Parser, Subcommand, ValueEnum};
use kontur_interpreter::record::columns::DEFAULT_SIGNALS;
use std::path::PathBuf;
use values::{span, whole};

pub use diff::{DiffArgs, OutputForm, Pairing, Tolerance};
pub use response::ResponseArgs;
pub(crate) use response::{FILTER_TYPES, PROTOTYPES};
pub use simulation::{MessageForm, SimulationArgs};
pub use sweep::{Amplitude, Shard, SweepArgs};
pub use tune::TuneArgs;
pub use vary::Vary;

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
    /// Run a program: setpoints per axis and cycle, and a summary.
    Run(RunArgs),
    /// Parse and decode programs without motion; shows all diagnostics, up to 20 errors.
    Check(CheckArgs),
    /// Compare two traces, or a trace and a fresh run; exit code 1 if they differ, or if the run ends with an error.
    Diff(DiffArgs),
    /// Run programs and write one self-contained page (.html) or picture (.svg).
    Report(ReportArgs),
    /// Show the frequency response, step response, residual vibration or corner of filters, shapers and axes.
    Response(ResponseArgs),
    /// Run a program with every combination of parameters, on all cores; one row per run.
    Sweep(SweepArgs),
    /// Propose Vibration Guard settings from measured frequencies or recordings, or the order of a filter.
    Tune(TuneArgs),
    /// Explain an error ID, a parameter or a command.
    Explain(ExplainArgs),
}

impl Command {
    /// The form in which its messages are printed.
    pub(crate) const fn message_form(&self) -> MessageForm {
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

/// `kontur run`.
#[derive(Clone, Debug, clap::Args)]
pub struct RunArgs {
    /// The NC program; `-` reads it from standard input
    pub program: PathBuf,

    /// Write a trace; `.parquet` or, with any other name, CSV; `-` writes CSV to stdout and the summary to stderr. May be
    /// given several times
    #[arg(short, long, value_name = "FILE")]
    pub output: Vec<PathBuf>,

    /// Columns of the trace: groups or names, separated by commas; `default` is `time,path,ipo,set,err,axis` without columns
    /// that only repeat other columns
    #[arg(long, value_name = "GROUPS|NAMES", default_value = DEFAULT_SIGNALS, requires = "output")]
    pub signals: String,

    /// Write only every N-th cycle
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = whole::<u64>(1, u64::MAX), allow_negative_numbers = true, requires = "output")]
    pub decimate: u64,

    /// Form of the summary on stdout (stderr with `-o -`)
    #[arg(long, value_enum, default_value_t = SummaryForm::Text)]
    pub summary: SummaryForm,

    /// Break down the time by line and by what limited the speed: in the summary, or for every line in a table. Also
    /// evaluates possible savings, with one run for each proposal
    #[arg(long, value_name = "FILE.csv", num_args = 0..=1, require_equals = true, value_parser = table)]
    pub times: Option<Option<PathBuf>>,

    /// What is simulated
    #[command(flatten)]
    pub simulation: SimulationArgs,
}

/// `kontur check`.
#[derive(Clone, Debug, clap::Args)]
pub struct CheckArgs {
    /// The NC programs; a folder means every `.nc` file in it that is not called by another one; `-` reads one from standard input
    #[arg(required = true)]
    pub programs: Vec<PathBuf>,

    /// Form of the result
    #[arg(long, value_enum, default_value_t = CheckForm::Text)]
    pub format: CheckForm,

    /// Exit with code 1 not only for errors but also for these
    #[arg(long, value_enum)]
    pub deny: Option<Deny>,

    /// What is simulated
    #[command(flatten)]
    pub simulation: SimulationArgs,
}

/// `kontur report`.
#[derive(Clone, Debug, clap::Args)]
pub struct ReportArgs {
    /// The NC programs; several programs are overlaid
    #[arg(required = true)]
    pub programs: Vec<PathBuf>,

    /// The page (`.html`), picture (`.svg`) or, with --signals, table (`.csv`) [default: the first program's name with
    /// .html]
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,

    /// Run every program with each of these values of a list parameter, of a number in the program or of an external variable, as in `sweep`. May be given
    /// several times
    #[arg(long, value_name = "KEY=VALUES")]
    pub vary: Vec<Vary>,

    /// Draw these columns of the trace over time instead of contour and speed: names or groups, separated by commas
    #[arg(long, value_name = "GROUPS|NAMES")]
    pub signals: Option<String>,

    /// Also draw the amplitude of each column over these frequencies in Hz, e.g. `2..80`
    #[arg(long, value_name = "HZ..HZ", requires = "signals", value_parser = span)]
    pub spectrum: Option<(f64, f64)>,

    /// Draw only this part of the run, in s, e.g. `0.7..1.9` (end exclusive); every cycle of it is drawn, even in a long run
    #[arg(long, value_name = "S..S", value_parser = span)]
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
