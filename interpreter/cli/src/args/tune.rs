//! The arguments of `kontur tune`.

use super::SimulationArgs;
use super::values::{above_zero, feed, span};
use clap::ArgGroup;
use std::path::PathBuf;

const EXAMPLES: &str = "\
Examples:
  mode and frequency for a machine whose natural frequency varies over its workspace
    kontur tune --freq 6.9,6.0,5.4 --damping 0.1
  the same from acceleration recordings at three positions
    kontur tune --recording low.csv --recording middle.csv --recording high.csv --column a --rate 2000
  the cost of each choice in your own program
    kontur tune --freq 6.9,6.0,5.4 --program part.nc --max-dev 0.01 -m machines/mill
  the maximum order of an HSC or FIR filter for 0.1 mm at F2000
    kontur tune --order-for 0.1 --feed F2000";

/// `kontur tune`.
#[derive(Clone, Debug, clap::Args)]
#[command(
    after_long_help = EXAMPLES,
    group(ArgGroup::new("from").args(["freq", "recording", "order_for"]).required(true)),
)]
pub struct TuneArgs {
    /// Natural frequencies in Hz measured at several positions of the machine
    #[arg(long, value_name = "HZ,..", value_delimiter = ',', value_parser = above_zero, allow_negative_numbers = true)]
    pub freq: Vec<f64>,

    /// Acceleration recording of a decaying vibration, one per position: CSV with comma, semicolon or tab, any header, or
    /// a CSV export of TwinCAT Scope. Modes whose peak is below 15 % of the highest one are not listed
    #[arg(long, value_name = "FILE")]
    pub recording: Vec<PathBuf>,

    /// Column of the recordings with the acceleration [default: the last one]
    #[arg(long, value_name = "NAME", requires = "recording", conflicts_with_all = ["freq", "order_for"])]
    pub column: Option<String>,

    /// Samples per second of the recordings [default: from their column `t_s`, `time` or `t` in seconds]
    #[arg(long, value_name = "HZ", requires = "recording", conflicts_with_all = ["freq", "order_for"], value_parser = above_zero, allow_negative_numbers = true)]
    pub rate: Option<f64>,

    /// Evaluate only these frequencies of the recordings
    #[arg(long, value_name = "HZ..HZ", requires = "recording", conflicts_with_all = ["freq", "order_for"], value_parser = span)]
    pub range: Option<(f64, f64)>,

    /// Evaluate only this part of the recordings, in seconds from their first sample
    #[arg(long, value_name = "S..S", requires = "recording", conflicts_with_all = ["freq", "order_for"], value_parser = span)]
    pub window: Option<(f64, f64)>,

    /// Draw the recordings, their spectra and the vibrations found (.svg)
    #[arg(short, long, value_name = "FILE", requires = "recording", conflicts_with_all = ["freq", "order_for"], value_parser = picture)]
    pub output: Option<PathBuf>,

    /// Damping ratio of the vibration [default: that of the recordings, otherwise 0.1]
    #[arg(long, value_name = "RATIO", value_parser = damping, allow_negative_numbers = true)]
    pub damping: Option<f64>,

    /// Also evaluate the modes at this frequency [default: the median of the measured ones]
    #[arg(long, value_name = "HZ", value_parser = above_zero, allow_negative_numbers = true)]
    pub at: Option<f64>,

    /// Maximum acceptable residual vibration in percent
    #[arg(long, value_name = "PERCENT", default_value = "5", value_parser = above_zero, allow_negative_numbers = true)]
    pub max_residual: f64,

    /// Feed in mm/min at which a 90 degree corner is evaluated
    #[arg(long, value_name = "FEED", default_value = "F1000", value_parser = feed, allow_negative_numbers = true)]
    pub feed: f64,

    /// Find the maximum order of a mean or Gauss filter whose contour error at a corner stays within this, in mm
    #[arg(long, value_name = "MM", value_parser = above_zero, allow_negative_numbers = true, conflicts_with_all = ["program", "damping", "at", "max_residual"])]
    pub order_for: Option<f64>,

    /// Run this NC program with each choice: deviation from the contour and machining time
    #[arg(long, value_name = "FILE", requires = "max_dev")]
    pub program: Option<PathBuf>,

    /// Maximum deviation of an axis from the contour, in mm (deg): AX_DEV of the proposed command, limit in --program; not of axes that follow others
    #[arg(long, value_name = "MM", conflicts_with = "order_for", value_parser = above_zero, allow_negative_numbers = true)]
    pub max_dev: Option<f64>,

    /// Machine and cycle; what else is simulated in --program
    #[command(flatten)]
    pub simulation: SimulationArgs,
}

fn damping(text: &str) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(v) if (0.0..=0.99).contains(&v) => Ok(v),
        _ => Err("a damping ratio from 0 to 0.99 is expected".to_owned()),
    }
}

fn picture(text: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(text);
    let svg = path.extension().is_some_and(|e| e.eq_ignore_ascii_case("svg"));
    if svg { Ok(path) } else { Err("a picture is an .svg file".to_owned()) }
}
