//! `kontur diff`: two traces, or a trace and a fresh run, row by row.
//!
//! Positions may differ by 1e-6 mm, a hundredth of the vendor's increment of 0.1 um; a speed by that divided by 1 ms,
//! and so on for every further derivative. Neither trace is ever held in memory.
//!
//! With `--map` B is a recording of a machine ([`recording`]).

mod compare;
mod delay;
#[cfg(feature = "parquet")]
mod parquet;
mod recording;
mod table;
mod text;
mod verdict;

use crate::args::{DiffArgs, OutputForm};
use crate::console::Console;
use crate::{Error, Exit};
use compare::Comparison;
pub(crate) use recording::Pairing;
use serde::Serialize;
use std::path::Path;
use table::Table;
use text::text;
use verdict::Verdict;

/// Largest differences that count as equal, by unit.
#[derive(Clone, Copy, Debug, PartialEq, clap::Args)]
pub struct Tolerance {
    /// Positions in mm or deg
    #[arg(long = "tol-mm", value_name = "MM", default_value = "1e-6", value_parser = tolerance)]
    pub mm: f64,
    /// Speeds in mm/s or deg/s
    #[arg(long = "tol-mm-s", value_name = "MM/S", default_value = "1e-3", value_parser = tolerance)]
    pub mm_s: f64,
    /// Accelerations in mm/s2 or deg/s2
    #[arg(long = "tol-mm-s2", value_name = "MM/S2", default_value = "1", value_parser = tolerance)]
    pub mm_s2: f64,
    /// Jerks in mm/s3 or deg/s3
    #[arg(long = "tol-mm-s3", value_name = "MM/S3", default_value = "1000", value_parser = tolerance)]
    pub mm_s3: f64,
    /// Everything else: drive counts, Nm
    #[arg(long = "tol-other", value_name = "X", default_value = "1e-3", value_parser = tolerance)]
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
    fn of(&self, column: &str) -> Option<f64> {
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

/// Compares; exit code 0 if equal, 1 if different.
///
/// # Errors
/// [`Error`] if a trace cannot be read or a program cannot be run.
pub(crate) fn diff(args: &DiffArgs, console: &mut Console) -> Result<Exit, Error> {
    let is_a = table::is_trace(&args.a)?;
    let mut open = |path: &Path, trace: bool, like: Option<&[String]>| {
        if trace {
            return Table::read(path);
        }
        let opened = args.simulation.request(path).open();
        let opened = opened.map_err(|e| crate::run::announce_lists(e, console))?;
        Table::run(opened.run, like)
    };
    let names = [args.a.display().to_string(), args.b.display().to_string()];
    if !args.map.is_empty() {
        let mut a = open(&args.a, is_a, Some(&recording::columns(&args.map)))?;
        let outcome = recording::compare(&mut a, &args.b, &args.map, args.tolerance)?;
        for message in a.take_messages() {
            console.announce(&message);
        }
        let program = (!is_a).then_some(args.a.as_path());
        let verdict = || recording::verdict(&outcome, program);
        let words = || recording::text(&names, &outcome);
        let done = Done { names: &names, outcome: &outcome, equal: outcome.equal };
        return done.report(args.format, words, verdict, console);
    }
    // a fresh run gives the columns of the trace that it is compared with
    let is_b = table::is_trace(&args.b)?;
    let (mut a, mut b) = if is_a || !is_b {
        let a = open(&args.a, is_a, None)?;
        let b = open(&args.b, is_b, Some(a.header()))?;
        (a, b)
    } else {
        let b = open(&args.b, is_b, None)?;
        (open(&args.a, is_a, Some(b.header()))?, b)
    };
    let mut progress = console.progress();
    let mut comparison = Comparison::new(a.header(), b.header(), args.tolerance);
    while comparison.next(a.next()?, b.next()?) {
        if comparison.rows().is_multiple_of(4096) {
            progress.show(|| format!("{} rows", comparison.rows()));
        }
    }
    drop(progress);
    for message in a.take_messages().iter().chain(&b.take_messages()) {
        console.announce(message);
    }
    let outcome = comparison.finish();
    let program = [(is_a, &args.a), (is_b, &args.b)].into_iter().find(|(trace, _)| !trace);
    let verdict = || verdict::of(&outcome, program.map(|(_, path)| path.as_path()));
    let done = Done { names: &names, outcome: &outcome, equal: outcome.equal };
    done.report(args.format, || text(&names, &outcome), verdict, console)
}

/// A comparison that has ended.
struct Done<'a, O> {
    names: &'a [String; 2],
    outcome: &'a O,
    equal: bool,
}

impl<O: Serialize> Done<'_, O> {
    fn report(
        &self,
        format: OutputForm,
        text: impl FnOnce() -> String,
        verdict: impl FnOnce() -> Verdict,
        console: &mut Console,
    ) -> Result<Exit, Error> {
        let [a, b] = self.names;
        let printed = match format {
            OutputForm::Text => text(),
            OutputForm::Json => {
                serde_json::json!({ "a": a, "b": b, "result": self.outcome }).to_string()
            }
            OutputForm::Junit => verdict().junit(self.names),
            OutputForm::Github => verdict().github(self.names),
        };
        console.print(&printed)?;
        Ok(if self.equal { Exit::Finished } else { Exit::Aborted })
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
