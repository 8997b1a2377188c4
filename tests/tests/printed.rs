//! Programs printed on the vendor's public pages, in own words with the numbers of the page, and the behaviour of other programs.
//!
//! Every file of `tests/suite/printed` and of `tests/suite/behaviour` is one test. Its head is that of `suite/faults`, with further kinds
//! of lines; those of `behaviour` have no page, and a comment states what they show:
//!
//! ```text
//! ; run --set X.getriebe[0].kv=1000: exit 0
//! ; page 207810059 selection without a block (G239), example 1
//! ; end X150 Y0                   where the axes are at the end
//! ; passes X30 Y30                the set path leads through this point, to 10 um
//! ; warning K-0100 at 7:1         what is said, in this order and nothing else
//! ```
//!
//! A program that runs is checked as well: `check` reports nothing that the run does not report.
//!
//! `KONTUR_WRITE_LEDGER=1 cargo test -p kontur-tests --test printed` rewrites the table of the folder's README.

use kontur_kit::from_polyline;
use kontur_tests::suite::{Head, Said, call, compare, files, folder, head, ledger, name};
use libtest_mimic::{Arguments, Failed, Trial};
use std::collections::BTreeMap;
use std::ffi::OsString;
use std::fmt::Write as _;
use std::path::Path;

/// Distance in mm or deg within which the set path must pass a point.
const NEAR: f64 = 0.01;

/// Positions at the end are exact to the digits of the trace.
const EXACT: f64 = 1e-6;

/// Set positions of a run by the names of the axes.
type Path_ = BTreeMap<String, Vec<f64>>;

/// `X10 Y-2.5`.
fn point(text: &str) -> Result<Vec<(String, f64)>, Failed> {
    let words = text.split_whitespace().map(|word| {
        let digits = word.find(|c: char| !c.is_ascii_alphabetic()).ok_or("no number")?;
        Ok((word[..digits].to_owned(), word[digits..].parse()?))
    });
    words.collect()
}

fn set_positions(trace: &Path) -> Result<Path_, Failed> {
    let mut reader = csv::Reader::from_path(trace)?;
    let names: Vec<Option<String>> = reader
        .headers()?
        .iter()
        .map(|h| h.split_once("_set_").map(|(axis, _)| axis.to_owned()))
        .collect();
    let mut path = Path_::new();
    for row in reader.records() {
        for (name, cell) in names.iter().zip(row?.iter()) {
            if let Some(name) = name {
                path.entry(name.clone()).or_default().push(cell.parse()?);
            }
        }
    }
    Ok(path)
}

/// The set path in some axes.
fn along(path: &Path_, axes: &[(String, f64)]) -> Result<Vec<Vec<f64>>, Failed> {
    let columns: Vec<&Vec<f64>> = axes
        .iter()
        .map(|(name, _)| path.get(name).ok_or(format!("no axis {name}")))
        .collect::<Result<_, _>>()?;
    let cycles = columns.first().map_or(0, |column| column.len());
    Ok((0..cycles).map(|k| columns.iter().map(|column| column[k]).collect()).collect())
}

/// What `check` reports for a program that runs: it may run, and there is no message that the run does not give as well.
fn agrees((exit, ahead): (u8, Vec<Said>), said: &[Said]) -> Result<(), Failed> {
    let mut said = said.iter();
    match ahead.iter().find(|message| !said.any(|other| other == *message)) {
        Some(message) => Err(format!("only `check` says {message:?}").into()),
        None if exit > 0 => Err(format!("`check` ends with exit code {exit}").into()),
        None => Ok(()),
    }
}

fn program(path: &Path) -> Result<(), Failed> {
    let head = head(&std::fs::read_to_string(path)?)?;
    let (own, home) = (name(path), path.parent().ok_or("no folder")?);
    let place = tempfile::tempdir()?;
    let trace = place.path().join("trace.csv");
    let [output, signals, groups] = ["-o", "--signals", "time,set"].map(OsString::from);
    let more = [output, trace.clone().into(), signals, groups];
    let (exit, said) = call("run", path, &head.options, &more, home)?;
    compare(&own, &head, exit, &said)?;
    if head.what == "check" {
        let (exit, said) = call("check", path, &head.options, &[], home)?;
        return Ok(compare(&own, &head, exit, &said)?);
    }
    let ahead = call("check", path, &head.options, &[], home)?;
    agrees(ahead, &said)?;
    let set = set_positions(&trace)?;
    for line in &head.other {
        match line.split_once(' ') {
            Some(("end", text)) => {
                let wanted = point(text)?;
                let path = along(&set, &wanted)?;
                let last = path.last().ok_or("nothing moved")?;
                if wanted.iter().zip(last).any(|((_, x), found)| (x - found).abs() > EXACT) {
                    return Err(format!("{text} expected at the end, found {last:?}").into());
                }
            }
            Some(("passes", text)) => {
                let wanted = point(text)?;
                let path = along(&set, &wanted)?;
                let at: Vec<f64> = wanted.iter().map(|(_, x)| *x).collect();
                let off = from_polyline(&at, &path).iter().map(|d| d * d).sum::<f64>().sqrt();
                if off > NEAR {
                    return Err(format!("{text} is left by {off:.4}").into());
                }
            }
            Some(("page", _)) => {}
            _ => return Err(format!("`{line}` says nothing that is known").into()),
        }
    }
    Ok(())
}

/// The page of a program.
fn page(head: &Head) -> Result<&str, Failed> {
    let mut pages = head.other.iter().filter_map(|line| line.strip_prefix("page "));
    Ok(pages.next().ok_or("no page")?)
}

/// How a printed program behaves here.
const STATES: [&str; 3] = ["runs", "refused with the printed number", "refused by name"];

/// Index into [`STATES`].
fn state(head: &Head) -> usize {
    let errors: Vec<&Said> = head.messages.iter().filter(|m| m.0 == "error").collect();
    if errors.is_empty() {
        0
    } else if errors.iter().any(|m| !m.1.starts_with("K-")) {
        1
    } else {
        2
    }
}

fn table() -> Result<(), Failed> {
    let mut counts = [0; STATES.len()];
    let mut rows = String::new();
    for path in files(&folder("printed"), "nc") {
        let head = head(&std::fs::read_to_string(&path)?)?;
        let state = state(&head);
        counts[state] += 1;
        let (number, title) =
            page(&head)?.split_once(' ').ok_or("a page has a number and a title")?;
        let _ = writeln!(rows, "| `{}` | {number} | {title} | {} |", name(&path), STATES[state]);
    }
    let all: usize = counts.iter().sum();
    let [runs, printed, refused] = counts;
    let text = format!(
        "\n{all} programs: {runs} run, {printed} are refused with the printed number, {refused} are refused by name.\n\n\
         | file | page | feature | state |\n|---|---|---|---|\n{rows}"
    );
    Ok(ledger(&folder("printed"), &text)?)
}

fn main() {
    let arguments = Arguments::from_args();
    let mut trials = vec![Trial::test("the_table_of_the_folder", table)];
    let programs = ["printed", "behaviour"].map(|set| files(&folder(set), "nc"));
    for path in programs.into_iter().flatten() {
        trials.push(Trial::test(name(&path), move || program(&path)));
    }
    libtest_mimic::run(&arguments, trials).exit();
}
