//! The arguments of `kontur response`.

use super::values::{Numbers, feed, setting, whole};
use clap::ArgGroup;
use kontur_filters::iir::FilterKind;
use kontur_filters::iir::prototype::Prototype;
use std::path::PathBuf;

const EXAMPLES: &str = "\
Each list of values produces one curve per value, and each repetition of an option adds curves; all of them share one picture.

Examples:
  three prototypes of a low-pass, frequency response on stdout
    kontur response --filter LOWPASS --prototype CRIT_DAMPING,BESSEL,BUTTERWORTH --order 4 --f0 15
  their step responses as a picture
    kontur response --filter LOWPASS --prototype CRIT_DAMPING,BESSEL,BUTTERWORTH --order 4 --f0 15 --step -o step.svg
  residual vibration when the frequency is wrong, for two dampings of the machine
    kontur response --guard MODE=2,FREQ=40 --residual --damping 0.05,0.1 -o residual.svg
  the Vibration Guard modes at a corner
    kontur response --guard MODE=1,FREQ=10 --guard MODE=2,FREQ=10 --corner F4000 -o corner.svg
  contour error over the order of the mean filter
    kontur response --hsc-mean 2..200:2 --corner F1000
  all filters that the lists of a machine set for an axis, table and picture
    kontur response --axis X -m machines/mill -o x.csv -o x.svg";

/// Names of P-AXIS-00204.
pub(crate) const FILTER_TYPES: [(&str, FilterKind); 8] = [
    ("LOWPASS", FilterKind::LowPass),
    ("HIGHPASS", FilterKind::HighPass),
    ("BANDPASS", FilterKind::BandPass),
    ("BANDSTOP", FilterKind::BandStop),
    ("ALLPASS", FilterKind::AllPass),
    ("PT1", FilterKind::Pt1),
    ("PT2", FilterKind::Pt2),
    ("TIME_DELAY", FilterKind::TimeDelay),
];

/// Names of P-AXIS-00153.
pub(crate) const PROTOTYPES: [(&str, Prototype); 3] = [
    ("CRIT_DAMPING", Prototype::CritDamping),
    ("BUTTERWORTH", Prototype::Butterworth),
    ("BESSEL", Prototype::Bessel),
];

/// `kontur response`.
#[derive(Clone, Debug, clap::Args)]
#[command(
    after_long_help = EXAMPLES,
    group(ArgGroup::new("view").args(["step", "residual", "corner"])),
    group(ArgGroup::new("what").args(["filter", "guard", "fir", "hsc_mean", "hsc_novib", "axis"]).multiple(true).required(true)),
)]
pub struct ResponseArgs {
    /// Standard filters: LOWPASS, HIGHPASS, BANDPASS, BANDSTOP, ALLPASS, PT1, PT2, TIME_DELAY
    #[arg(long, value_name = "TYPE", value_delimiter = ',', value_parser = filter_type)]
    pub filter: Vec<String>,

    /// Prototypes of --filter: CRIT_DAMPING, BUTTERWORTH, BESSEL
    #[arg(long, value_name = "NAME", value_delimiter = ',', default_value = "CRIT_DAMPING", value_parser = prototype, requires = "filter")]
    pub prototype: Vec<String>,

    /// Orders of --filter: `4`, `1,2,3`, `1..6` (P-AXIS-00140)
    #[arg(long, value_name = "N", default_value = "2", requires = "filter")]
    pub order: Numbers,

    /// Characteristic frequencies of --filter in Hz (P-AXIS-00067)
    #[arg(long, value_name = "HZ", default_value = "30", requires = "filter")]
    pub f0: Numbers,

    /// Qualities of BANDPASS and BANDSTOP (P-AXIS-00080)
    #[arg(long, value_name = "Q", default_value = "1", requires = "filter")]
    pub q: Numbers,

    /// Time constants of PT1, PT2 and TIME_DELAY in microseconds (P-AXIS-00357)
    #[arg(long, value_name = "US", default_value = "10000", requires = "filter")]
    pub time: Numbers,

    /// Shares of the signal that pass through --filter, in percent (P-AXIS-00164)
    #[arg(long, value_name = "PERCENT", default_value = "100", requires = "filter")]
    pub share: Numbers,

    /// Vibration Guard: `MODE=2,FREQ=40,DAMPING=0.1`; missing keys have the defaults 1, 30, 0.1
    #[arg(long, value_name = "KEY=VALUE,..")]
    pub guard: Vec<String>,

    /// FIR filter: MEAN, GAUSS, SINC or DELAY with ORDER or ORDER_TIME, SHARE, FCUT, QUALITY: `GAUSS,ORDER=40,QUALITY=0.5`
    #[arg(long, value_name = "TYPE,KEY=VALUE,..")]
    pub fir: Vec<String>,

    /// HSC mean filters by their order: `20`, `2..200:2`
    #[arg(long, value_name = "ORDER")]
    pub hsc_mean: Option<Numbers>,

    /// HSC NoVib filters by the first natural frequency in Hz
    #[arg(long, value_name = "HZ")]
    pub hsc_novib: Option<Numbers>,

    /// Axes of the machine: their filters, and the FIR filter or Vibration Guard switched on in their lists
    #[arg(long, value_name = "NAME", value_delimiter = ',')]
    pub axis: Vec<String>,

    /// Step response instead of frequency response
    #[arg(long)]
    pub step: bool,

    /// Residual vibration over the real natural frequency instead of frequency response; shapers only
    #[arg(long)]
    pub residual: bool,

    /// Contour at a 90 degree corner at this feed in mm/min (`F1000`) instead of frequency response
    #[arg(long, value_name = "FEED", value_parser = feed, allow_negative_numbers = true)]
    pub corner: Option<f64>,

    /// Damping of the vibration for --residual [default: that of the guard, 0.1 for other shapers]
    #[arg(long, value_name = "RATIO", requires = "residual")]
    pub damping: Option<Numbers>,

    /// Frequencies in Hz, `1..200` [default: 0.5 Hz to half the sampling frequency; --residual: around the set frequency]
    #[arg(long, value_name = "HZ..HZ", value_parser = range, conflicts_with_all = ["step", "corner"])]
    pub range: Option<(f64, f64)>,

    /// Write a table (`.csv`) or a picture (`.svg`) [default: the table on stdout]. May be given several times
    #[arg(short, long, value_name = "FILE")]
    pub output: Vec<PathBuf>,

    /// Machine of --axis: a folder with a start-up list, the list itself, or a TwinCAT project [default: the built-in xyz]
    #[arg(short, long, value_name = "DIR", requires = "axis")]
    pub machine: Option<PathBuf>,

    /// Override a list parameter of the machine, e.g. `X.vib_guard.active=1`
    #[arg(long, value_name = "AXIS.KEY=VALUE", value_parser = setting, requires = "axis")]
    pub set: Vec<String>,

    /// Cycle time in microseconds [default: that of the machine, 1000 without --axis]
    #[arg(long, value_name = "N", value_parser = whole::<u32>(100, 20_000), allow_negative_numbers = true)]
    pub cycle_us: Option<u32>,
}

fn range(text: &str) -> Result<(f64, f64), String> {
    let parsed = text.split_once("..").and_then(|(low, high)| {
        Some((low.trim().parse::<f64>().ok()?, high.trim().parse::<f64>().ok()?))
    });
    match parsed {
        Some((low, high)) if low > 0.0 && high > low && high.is_finite() => Ok((low, high)),
        _ => Err("two frequencies above 0 in ascending order are expected, e.g. 1..200".to_owned()),
    }
}

/// One of the names, whatever its case.
fn one_of(text: &str, names: &[&str]) -> Result<String, String> {
    let found = names.iter().find(|name| name.eq_ignore_ascii_case(text.trim()));
    found.map(|name| (*name).to_owned()).ok_or_else(|| format!("one of {}", names.join(", ")))
}

fn filter_type(text: &str) -> Result<String, String> {
    one_of(text, &FILTER_TYPES.map(|(name, _)| name))
}

fn prototype(text: &str) -> Result<String, String> {
    one_of(text, &PROTOTYPES.map(|(name, _)| name))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn feeds_and_frequency_ranges() {
        assert_eq!((feed("F1000"), feed("2000")), (Ok(1000.0), Ok(2000.0)));
        assert!(feed("F0").is_err() && feed("fast").is_err());
        assert_eq!(range("1..200"), Ok((1.0, 200.0)));
        for wrong in ["1", "0..5", "5..1", "1..inf", "a..b"] {
            assert!(range(wrong).is_err(), "{wrong}");
        }
    }
}
