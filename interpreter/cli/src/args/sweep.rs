//! The arguments of `kontur sweep`.

use super::values::span;
use super::{SimulationArgs, Vary};
use kontur_interpreter::job::Facts;
use kontur_interpreter::record::columns::{Column, Content, all};
use std::ops::Range;
use std::path::PathBuf;
use std::str::FromStr;

const EXAMPLES: &str = "\
Every --vary takes a list or a range of values; all combinations are run, on all cores.

Examples:
  a table on stdout: machining time and contour error over mode and frequency of the Vibration Guard
    kontur sweep part.nc --vary '*.vib_guard.mode=1..4' --vary '*.vib_guard.freq=20..60:10' --columns duration_s,contour_err_mm
  the same for a guard set by the program itself, with the same value in the list of X
    kontur sweep part.nc --vary F=20..60:10 --vary 'program.FREQ={F}' --vary 'X.vib_guard.freq={F}'
  the maximum gain at which the axis is stable, with and without Improved Position Control, table and picture
    kontur sweep part.nc -m mill --vary X.getriebe[0].kv=1000..60000:1000 \\
      --vary X.lr_param.improved_position_control.enable=0,1 -o kv.csv -o kv.svg
  residual vibration at 53 Hz between 1 s and 2 s for each weight
    kontur sweep part.nc -m mill --vary X.lr_param.improved_position_control.stage[0].weight_fact_num=1..7 \\
      --amplitude X_tcp_acc_mm_s2@50..56@1..2
  the third of twenty jobs of a batch system; started again it continues after its finished rows
    kontur sweep part.nc --vary X,Y.getriebe[0].kv=1000..60000:10 --shard 3/20 -o part-03.csv";

/// `kontur sweep`.
#[derive(Clone, Debug, clap::Args)]
#[command(after_long_help = EXAMPLES)]
pub struct SweepArgs {
    /// The NC program
    pub program: PathBuf,

    /// What to vary, and its values: `KEY=A..B:STEP`, `KEY=A,B,C`. A list parameter `AXIS.key=..`, of several axes `X,Y.key=..`, of
    /// all path axes `*.key=..`; a number in the program after a word (P1=, V.P.R=, FREQ=) `program.P1=..`, in
    /// line 12 `program[12].FREQ=..`; an external variable that the program reads `V.E.NAME=..`; a name `NAME=..` whose
    /// values other keys use with `KEY={NAME}`. May be given several times
    #[arg(long, value_name = "KEY=VALUES", required = true)]
    pub vary: Vec<Vary>,

    /// Write the rows; `.parquet`, `.svg` (a picture over the first --vary) or, with any other name, CSV [default: CSV on
    /// stdout]. May be given several times
    #[arg(short, long, value_name = "FILE")]
    pub output: Vec<PathBuf>,

    /// Results to show next to the parameters, separated by commas [default: all]
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    pub columns: Vec<String>,

    /// Additional result: the maximum amplitude of a column of the trace between two frequencies in Hz, over the whole run
    /// or between two times in s: `X_tcp_acc_mm_s2@50..56@1..2`. The mean is removed, and, where the lowest frequency has at
    /// least 2.5 waves, the drift
    #[arg(long, value_name = "COLUMN@HZ..HZ[@S..S]")]
    pub amplitude: Vec<Amplitude>,

    /// Run only the I-th of N equal parts of all combinations, e.g. `3/20` as a job of a batch system. The parts, concatenated
    /// in order, form the whole table, with `without_effect` per part; the exit code is 0 even if every run has ended with
    /// an error
    #[arg(long, value_name = "I/N")]
    pub shard: Option<Shard>,

    /// What is simulated
    #[command(flatten)]
    pub simulation: SimulationArgs,
}

/// One of several parts of a sweep.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    /// Number of the part, from 1.
    part: usize,
    parts: usize,
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let numbers = text.split_once('/').and_then(|(part, parts)| {
            Some(Self { part: part.trim().parse().ok()?, parts: parts.trim().parse().ok()? })
        });
        let valid = |shard: &Self| (1..=shard.parts).contains(&shard.part);
        numbers.filter(valid).ok_or_else(|| {
            format!(
                "`{text}`: write PART/PARTS with a part from 1 to the number of parts, e.g. 3/20"
            )
        })
    }
}

impl Shard {
    /// Its share of `count` combinations, by their numbers; the sizes of the parts differ by at most one.
    ///
    /// # Errors
    /// A message, the same for all parts, if some of them would be empty.
    pub fn of(self, count: usize) -> Result<Range<usize>, String> {
        if self.parts > count {
            return Err(format!("--shard: {} parts of {count} combinations", self.parts));
        }
        // a part is at most the number of parts, so the bound is at most the count
        let bound = |part: usize| (count as u128 * part as u128 / self.parts as u128) as usize;
        Ok(bound(self.part - 1)..bound(self.part))
    }
}

/// An amplitude to search for in the spectrum of a signal.
#[derive(Clone, Debug, PartialEq)]
pub struct Amplitude {
    /// As written: the name of the result.
    pub text: String,
    /// Column of the trace.
    pub signal: String,
    /// Frequencies in Hz.
    pub band_hz: (f64, f64),
    /// Times in s; `None`: the whole run.
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
    /// Whether a time in s is inside the window.
    pub(crate) fn holds(&self, t_s: f64) -> bool {
        self.window_s.is_none_or(|(from, to)| (from..to).contains(&t_s))
    }

    /// The column of the trace.
    pub(crate) fn column(&self, facts: &Facts) -> Result<Column, String> {
        let columns = all(facts);
        let found = columns.iter().find(|c| c.name == self.signal && is_number(c)).cloned();
        found.ok_or_else(|| {
            let names: Vec<&str> =
                columns.iter().filter(|c| is_number(c)).map(|c| c.name.as_str()).collect();
            format!(
                "--amplitude: `{}` is not a numeric column; numeric columns are {}",
                self.signal,
                names.join(", ")
            )
        })
    }
}

fn is_number(column: &Column) -> bool {
    matches!(column.content, Content::Path(_) | Content::Axis(..))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// For all numbers: every combination is in exactly one part, parts are in order and of equal size up to one.
    #[test]
    fn shards_are_a_partition() {
        for count in [1, 2, 7, 100, 99_999] {
            for parts in [1, 2, 3, 7, 100, 1001] {
                let all: Result<Vec<Range<usize>>, String> =
                    (1..=parts).map(|part| Shard { part, parts }.of(count)).collect();
                let Ok(all) = all else {
                    assert!(parts > count && Shard { part: parts, parts }.of(count).is_err());
                    continue;
                };
                assert_eq!((all[0].start, all[parts - 1].end), (0, count));
                assert!(all.windows(2).all(|pair| pair[0].end == pair[1].start));
                let sizes: Vec<usize> = all.iter().map(ExactSizeIterator::len).collect();
                let (least, most) = (sizes.iter().min().unwrap(), sizes.iter().max().unwrap());
                assert!(most - least <= 1, "{count} in {parts}");
            }
        }
        assert_eq!("3/20".parse(), Ok(Shard { part: 3, parts: 20 }));
        for wrong in ["", "1", "0/3", "4/3", "1/0", "-1/3", "1/2/3", "a/b"] {
            assert!(wrong.parse::<Shard>().is_err(), "{wrong}");
        }
    }

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
