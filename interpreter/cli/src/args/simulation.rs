//! Options that every command with a simulation has.

use super::values::{after_external, setting, whole};
use clap::ValueEnum;
use kontur_interpreter::job::Stop;
use std::path::PathBuf;

/// How messages are printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum MessageForm {
    /// Readable text with the source line.
    Text,
    /// One JSON object per line.
    Json,
}

/// Options that decide what is simulated.
#[expect(clippy::struct_excessive_bools, reason = "each is a separate switch for the user")]
#[derive(Clone, Debug, clap::Args)]
pub struct SimulationArgs {
    /// Machine: a folder with a start-up list, the list itself, or a TwinCAT project (.tsproj, .xti) [default: the built-in xyz]
    #[arg(short, long, value_name = "DIR")]
    pub machine: Option<PathBuf>,

    /// Override a list parameter of the machine, e.g. `X.getriebe[0].kv=5000`, `X,Y.key=value`, `*.key=value` for every path axis
    /// or `channel.key=value`
    #[arg(long, value_name = "AXIS.KEY=VALUE", value_parser = setting)]
    pub set: Vec<String>,

    /// Folder with global subroutines, searched after the caller's own
    #[arg(long, value_name = "DIR")]
    pub path: Vec<PathBuf>,

    /// Allow subroutines outside the program's folder and --path
    #[arg(long)]
    pub allow_outside: bool,

    /// Real-time inputs: CSV with the columns `t_s` and signals (`override_percent`, `rapid_override_percent`,
    /// `feedhold`, `probe`, `wear_mm`, `X_probe_mm`, `X_add_mm`, `X_force_mm_s2`, `X_encoder_offset_mm`); a value applies until the next
    /// time stamp. May be given several times
    #[arg(long, value_name = "FILE")]
    pub input: Vec<PathBuf>,

    /// Cycle time in microseconds [default: that of the machine]
    #[arg(long, value_name = "N", value_parser = whole::<u32>(100, 20_000), allow_negative_numbers = true)]
    pub cycle_us: Option<u32>,

    /// Start positions in mm (deg), e.g. `X10,Y5`
    #[arg(long, value_name = "POSITIONS", value_delimiter = ',', value_parser = position)]
    pub start: Vec<(String, f64)>,

    /// Active skip levels, e.g. `1,3`
    #[arg(long, value_name = "LEVELS", value_delimiter = ',', value_parser = skip_level)]
    pub skip: Vec<u8>,

    /// Stop after this program time in seconds
    #[arg(long, value_name = "S", default_value = "86400", value_parser = positive, allow_negative_numbers = true)]
    pub max_time: f64,

    /// Stop after this number of executed blocks
    #[arg(long, value_name = "N", default_value_t = 100_000_000, value_parser = whole::<u64>(1, u64::MAX), allow_negative_numbers = true)]
    pub max_blocks: u64,

    /// Refuse list keys that are not modelled
    #[arg(long)]
    pub strict: bool,

    /// Treat kinematic transformations (#TRAFO, #RTCP, #KIN ID) as the identity, with a warning
    #[arg(long)]
    pub identity_trafo: bool,

    /// Wait for M, H, S and T functions for the times declared in the channel list (P-CHAN-00026, 00040, 00042 to 00048, 00072, 00080);
    /// without this option they take no time and are named in the summary
    #[arg(long)]
    pub techno_times: bool,

    /// Value of an external variable at program start, e.g. `Speed=1200` for V.E.Speed
    #[arg(long, value_name = "NAME=VALUE", value_parser = external)]
    pub external: Vec<(String, String)>,

    /// Form of the messages on stderr
    #[arg(long, value_enum, default_value_t = MessageForm::Text)]
    pub diagnostics: MessageForm,

    /// Ends check and run from another thread; that of Ctrl-C on the command line
    #[arg(skip = crate::interrupt::stop())]
    pub stop: Stop,
}

impl SimulationArgs {
    /// An option that is given and decides what is simulated, for commands that may have nothing to simulate.
    pub(crate) fn given(&self) -> Option<&'static str> {
        let given = [
            (self.machine.is_some(), "--machine"),
            (!self.set.is_empty(), "--set"),
            (!self.path.is_empty(), "--path"),
            (!self.input.is_empty(), "--input"),
            (self.cycle_us.is_some(), "--cycle-us"),
            (!self.start.is_empty(), "--start"),
            (!self.skip.is_empty(), "--skip"),
            (!self.external.is_empty(), "--external"),
            (self.allow_outside, "--allow-outside"),
            (self.strict, "--strict"),
            (self.identity_trafo, "--identity-trafo"),
            (self.techno_times, "--techno-times"),
        ];
        given.into_iter().find_map(|(given, name)| given.then_some(name))
    }
}

/// `NAME=VALUE`, the name with or without the `V.E.` of the program.
fn external(text: &str) -> Result<(String, String), String> {
    let expected = || "NAME=VALUE is expected".to_owned();
    let (name, value) = text.split_once('=').ok_or_else(expected)?;
    let name = name.trim();
    let name = after_external(name).unwrap_or(name);
    if name.is_empty() { Err(expected()) } else { Ok((name.to_owned(), value.to_owned())) }
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

/// A skip level.
fn skip_level(text: &str) -> Result<u8, String> {
    let level = text.trim().parse().ok().filter(|level| (1..=10).contains(level));
    level
        .ok_or_else(|| format!("`{text}`: levels from 1 to 10 separated by commas expected, 1,2,3"))
}

/// A finite number above zero.
fn positive(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(v) if v.is_finite() && v > 0.0 => Ok(v),
        _ => Err("a number above 0 is expected".to_owned()),
    }
}
