//! The arguments of `kontur sweep`.

use crate::args::SimulationArgs;
use crate::vary::Vary;
use kontur_interpreter::job::Facts;
use kontur_interpreter::record::columns::{Column, Content, all};
use std::path::PathBuf;
use std::str::FromStr;

const EXAMPLES: &str = "\
Every --vary takes a list or a range of values; all combinations are run, over all cores.

Examples:
  a table on stdout: machining time and contour error over mode and frequency of the Vibration Guard
    kontur sweep part.nc --vary '*.vib_guard.mode=1..4' --vary '*.vib_guard.freq=20..60:10' --columns duration_s,contour_err_mm
  the largest gain at which the axis is stable, with and without Improved Position Control, table and picture
    kontur sweep part.nc -m mill --vary X.getriebe[0].kv=1000..60000:1000 \\
      --vary X.lr_param.improved_position_control.enable=0,1 -o kv.csv -o kv.svg
  what a weight leaves of the vibration at 53 Hz between 1 s and 2 s
    kontur sweep part.nc -m mill --vary X.lr_param.improved_position_control.stage[0].weight_fact_num=1..7 \\
      --amplitude X_tcp_acc_mm_s2@50..56@1..2";

/// `kontur sweep`.
#[derive(Clone, Debug, clap::Args)]
#[command(after_long_help = EXAMPLES)]
pub struct SweepArgs {
    /// The NC program
    pub program: PathBuf,

    /// A list parameter and its values: `KEY=A..B:STEP`, `KEY=A,B,C`; of several axes `X,Y.key=..`, of all path axes
    /// `*.key=..`; an external variable that the program reads `V.E.NAME=..`. May be given several times
    #[arg(long, value_name = "KEY=VALUES", required = true)]
    pub vary: Vec<Vary>,

    /// Write the rows; `.parquet`, `.svg` (a picture over the first --vary) or, with any other name, CSV [default: CSV on
    /// stdout]. May be given several times
    #[arg(short, long, value_name = "FILE")]
    pub output: Vec<PathBuf>,

    /// Results to show beside the parameters, separated by commas [default: all]
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    pub columns: Vec<String>,

    /// One more result: the largest amplitude of a column of the trace between two frequencies in Hz, over the whole run
    /// or between two times in s: `X_tcp_acc_mm_s2@50..56@1..2`
    #[arg(long, value_name = "COLUMN@HZ..HZ[@S..S]")]
    pub amplitude: Vec<Amplitude>,

    /// What is simulated
    #[command(flatten)]
    pub simulation: SimulationArgs,
}

/// What is looked for in the spectrum of a signal.
#[derive(Clone, Debug, PartialEq)]
pub struct Amplitude {
    /// As it was written: the name of the result.
    pub text: String,
    /// Column of the trace.
    pub signal: String,
    /// Frequencies in Hz.
    pub band_hz: (f64, f64),
    /// Times in s; none: the whole run.
    pub window_s: Option<(f64, f64)>,
}

impl FromStr for Amplitude {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let mut parts = text.split('@').map(str::trim);
        let (signal, band) = (parts.next().unwrap_or_default(), parts.next().unwrap_or_default());
        let window_s = parts.next().map(span).transpose()?;
        if signal.is_empty() || band.is_empty() || parts.next().is_some() {
            return Err(format!(
                "`{text}`: X_tcp_acc_mm_s2@50..56 or X_tcp_acc_mm_s2@50..56@1..2 expected"
            ));
        }
        Ok(Self {
            text: text.to_owned(),
            signal: signal.to_owned(),
            band_hz: span(band)?,
            window_s,
        })
    }
}

impl Amplitude {
    /// The time belongs to the window.
    pub(super) fn holds(&self, t_s: f64) -> bool {
        self.window_s.is_none_or(|(from, to)| (from..to).contains(&t_s))
    }

    /// The column of the trace.
    pub(super) fn column(&self, facts: &Facts) -> Result<Column, String> {
        let columns = all(facts);
        let found = columns.iter().find(|c| c.name == self.signal && is_number(c)).cloned();
        found.ok_or_else(|| {
            let names: Vec<&str> =
                columns.iter().filter(|c| is_number(c)).map(|c| c.name.as_str()).collect();
            format!(
                "--amplitude: `{}` is no column with numbers; they are {}",
                self.signal,
                names.join(", ")
            )
        })
    }
}

fn is_number(column: &Column) -> bool {
    matches!(column.content, Content::Path(_) | Content::Axis(..))
}

/// Two numbers from 0 on in rising order: `50..56`.
///
/// # Errors
/// Any other text.
pub(crate) fn span(text: &str) -> Result<(f64, f64), String> {
    let parsed = text.split_once("..").and_then(|(low, high)| {
        Some((low.trim().parse::<f64>().ok()?, high.trim().parse::<f64>().ok()?))
    });
    match parsed {
        Some((low, high)) if low >= 0.0 && high > low && high.is_finite() => Ok((low, high)),
        _ => Err(format!("`{text}`: two numbers in rising order are expected, e.g. 50..56")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn amplitudes_have_a_band_and_perhaps_a_window() {
        let a: Amplitude = "X_lag_mm@50..56@0.7..1.9".parse().unwrap();
        assert_eq!((a.signal.as_str(), a.band_hz), ("X_lag_mm", (50.0, 56.0)));
        assert!(!a.holds(0.6999) && a.holds(0.7) && a.holds(1.8999) && !a.holds(1.9));
        let whole: Amplitude = "X_lag_mm@0..5".parse().unwrap();
        assert!(whole.holds(0.0) && whole.holds(1e6));
        for wrong in ["X_lag_mm", "X_lag_mm@50", "@1..2", "X@2..1", "X@1..2@3", "X@1..2@3..4@5..6"]
        {
            assert!(wrong.parse::<Amplitude>().is_err(), "{wrong}");
        }
    }
}
