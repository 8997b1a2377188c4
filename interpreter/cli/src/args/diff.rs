//! The arguments of `kontur diff`.

use super::SimulationArgs;
use super::values::above_zero;
use clap::ValueEnum;
use std::path::PathBuf;
use std::str::FromStr;

/// `kontur diff`.
#[derive(Clone, Debug, clap::Args)]
pub struct DiffArgs {
    /// A CSV or Parquet trace, or an NC program to run now
    pub a: PathBuf,

    /// A CSV or Parquet trace, or an NC program to run now; with --map a recording
    pub b: PathBuf,

    /// B is a recording of a machine (CSV with comma, semicolon or tab, any header, or an export of TwinCAT Scope): the column
    /// of A that a channel recorded, with a factor for unit and sign, e.g. `X_act_mm=MAIN.fActX` or `X_act_mm=-1000*Axis1.Pos`.
    /// The shift in time is determined automatically; positions within 0.1 um are always treated as equal
    #[arg(long, value_name = "COLUMN=CHANNEL")]
    pub map: Vec<Pairing>,

    /// Samples per second of the recording [default: from its column `t_s`, `time` or `t` in seconds]
    #[arg(long, value_name = "HZ", requires = "map", value_parser = above_zero, allow_negative_numbers = true)]
    pub rate: Option<f64>,

    /// Tolerances by unit
    #[command(flatten)]
    pub tolerance: Tolerance,

    /// Form of the result on stdout
    #[arg(long, value_enum, default_value_t = OutputForm::Text)]
    pub format: OutputForm,

    /// Options for running an NC program given as A or B
    #[command(flatten)]
    pub simulation: SimulationArgs,
}

/// How a comparison is printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum OutputForm {
    /// Readable text.
    Text,
    /// One JSON object.
    Json,
    /// JUnit XML: a test case for each signal.
    Junit,
    /// Commands of GitHub's workflow log, at the NC lines.
    Github,
}

/// Largest differences that count as equal, by unit.
#[derive(Clone, Copy, Debug, PartialEq, clap::Args)]
pub struct Tolerance {
    /// Positions in mm or deg
    #[arg(long = "tol-mm", value_name = "MM", default_value = "1e-6", value_parser = tolerance, allow_negative_numbers = true)]
    pub mm: f64,
    /// Speeds in mm/s or deg/s
    #[arg(long = "tol-mm-s", value_name = "MM/S", default_value = "1e-3", value_parser = tolerance, allow_negative_numbers = true)]
    pub mm_s: f64,
    /// Accelerations in mm/s2 or deg/s2
    #[arg(long = "tol-mm-s2", value_name = "MM/S2", default_value = "1", value_parser = tolerance, allow_negative_numbers = true)]
    pub mm_s2: f64,
    /// Jerks in mm/s3 or deg/s3
    #[arg(long = "tol-mm-s3", value_name = "MM/S3", default_value = "1000", value_parser = tolerance, allow_negative_numbers = true)]
    pub mm_s3: f64,
    /// Everything else: drive counts, Nm
    #[arg(long = "tol-other", value_name = "X", default_value = "1e-3", value_parser = tolerance, allow_negative_numbers = true)]
    pub other: f64,
}

fn tolerance(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(v) if v >= 0.0 => Ok(v),
        _ => Err("a number, 0 or more, is expected".to_owned()),
    }
}

impl Tolerance {
    /// How cells of a column are compared; none: as text.
    pub(crate) fn of(&self, column: &str) -> Option<f64> {
        let ends = |end: &str| ["mm", "deg"].iter().any(|u| column.ends_with(&format!("{u}{end}")));
        match column {
            "t_s" => Some(0.0),
            "line" | "block" | "file" | "v_limit" => None,
            _ if ends("_s3") => Some(self.mm_s3),
            _ if ends("_s2") => Some(self.mm_s2),
            _ if ends("_s") => Some(self.mm_s),
            _ if ends("") => Some(self.mm),
            _ => Some(self.other),
        }
    }
}

/// A column of the trace and the channel that recorded it: `X_act_mm=MAIN.fAct`, `X_act_mm=-1000*Axis1.Pos`.
#[derive(Clone, Debug, PartialEq)]
pub struct Pairing {
    pub(crate) column: String,
    pub(crate) channel: String,
    pub(crate) factor: f64,
}

impl FromStr for Pairing {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let form = || "COLUMN=CHANNEL or COLUMN=FACTOR*CHANNEL is expected".to_owned();
        let (column, right) = text.split_once('=').ok_or_else(form)?;
        let (factor, channel) = match right.split_once('*') {
            Some((factor, channel)) => (factor.trim().parse::<f64>().map_err(|_| form())?, channel),
            None => match right.trim().strip_prefix('-') {
                Some(channel) => (-1.0, channel),
                None => (1.0, right),
            },
        };
        let (column, channel) = (column.trim().to_owned(), channel.trim().to_owned());
        if column.is_empty() || channel.is_empty() || !factor.is_finite() || factor.abs() <= 0.0 {
            return Err(form());
        }
        Ok(Self { column, channel, factor })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_come_from_the_name() {
        let t = Tolerance { mm: 1.0, mm_s: 2.0, mm_s2: 3.0, mm_s3: 4.0, other: 5.0 };
        for (column, expected) in [
            ("X_set_mm", Some(1.0)),
            ("C_lag_deg", Some(1.0)),
            ("s_mm", Some(1.0)),
            ("v_mm_s", Some(2.0)),
            ("C_vel_deg_s", Some(2.0)),
            ("X_tcp_acc_mm_s2", Some(3.0)),
            ("j_mm_s3", Some(4.0)),
            ("X_torque_nm", Some(5.0)),
            ("X_cmd_drive", Some(5.0)),
            ("t_s", Some(0.0)),
            ("line", None),
            ("v_limit", None),
        ] {
            assert_eq!(t.of(column), expected, "{column}");
        }
    }
}
