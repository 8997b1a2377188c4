//! SHA-256 of the results of programs on the built-in machine, to compare bits between computers:
//! `cargo run -p kontur-release -- [--signals NAMES] [--set KEY=VALUE]... PROGRAM...` prints one line per program.
//!
//! The canonical form of columns is, for each of them, its name in UTF-8, a zero byte, and its values as little-endian f64.

#![expect(clippy::print_stdout, reason = "the hashes go to stdout")]

use kontur_interpreter::diag::render;
use kontur_interpreter::job::{Job, MachineLists};
use kontur_interpreter::record::CycleRecord;
use kontur_interpreter::record::columns::{GROUPS, select};
use kontur_interpreter::source::MemorySources;
use sha2::{Digest, Sha256};
use std::error::Error;
use std::fmt::Write as _;

fn hash(program: &str, signals: &str, settings: &[String]) -> Result<String, Box<dyn Error>> {
    let lists = MachineLists { settings, ..MachineLists::default() };
    let (machine, _) = lists.load().map_err(|said| render::all(&said))?;
    let sources = MemorySources::new().with("part.nc", std::fs::read(program)?);
    let job = Job::new(machine, sources, "part.nc");
    let mut run = job.start().map_err(|said| render::all(&said))?;
    if run.is_over() {
        return Err(render::all(&run.take_diagnostics()).into());
    }
    let mut columns = select(signals, run.facts())?;
    columns.retain(|column| column.number(run.record()).is_some());
    let mut values = vec![Vec::new(); columns.len()];
    let Ok(()) = run.to_end(&mut |record: &CycleRecord| {
        for (column, values) in columns.iter().zip(&mut values) {
            values.extend(column.number(record).map(f64::to_le_bytes));
        }
    });
    let mut hasher = Sha256::new();
    for (column, values) in columns.iter().zip(&values) {
        hasher.update(&column.name);
        hasher.update([0]);
        for value in values {
            hasher.update(value);
        }
    }
    let mut text = String::new();
    for byte in hasher.finalize() {
        write!(text, "{byte:02x}")?;
    }
    Ok(text)
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut signals = GROUPS.join(",");
    let mut settings = Vec::new();
    let mut words = std::env::args().skip(1);
    while let Some(word) = words.next() {
        match word.as_str() {
            "--signals" => signals = words.next().ok_or("--signals needs names")?,
            "--set" => settings.push(words.next().ok_or("--set needs KEY=VALUE")?),
            program => println!("{}  {program}", hash(program, &signals, &settings)?),
        }
    }
    Ok(())
}
