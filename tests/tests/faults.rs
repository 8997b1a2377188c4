//! The smallest program or list for each message: ID, severity, line, column, hint and exit code.
//!
//! Every file of `tests/suite/faults` is one test. Its first lines state how it is run and which messages must appear, in this order and
//! no others:
//!
//! ```text
//! ; run --set X.getriebe[0].kv=1000: exit 1      `check` instead of `run`: the syntax check already finds all of it
//! ; error 70082 at 6:1                           severity, ID, line and column of the caret; `at file.nc 6:1` elsewhere
//! ```
//!
//! A file of `lists` takes the place of a list of the machine `xyz`: `# x.lis: exit 0`.
//!
//! `open.csv` gives the reason for every ID of the catalogue without a program or list.

use kontur_interpreter::diag::condition;
use kontur_tests::suite::{self, call, compare, files, head, machines, name};
use libtest_mimic::{Arguments, Failed, Trial};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// A program for lists that only need an axis to be loaded.
const PROGRAM: &str = "N10 G01 X1 F1000\nN20 M30\n";

fn folder() -> PathBuf {
    suite::folder("faults")
}

fn program(path: &Path) -> Result<(), Failed> {
    // damaged encodings are part of the tests
    let head = head(&String::from_utf8_lossy(&std::fs::read(path)?))?;
    let positions = |line: &&String| line.starts_with("end ") || line.starts_with("passes ");
    if let Some(line) = head.other.iter().find(positions) {
        return Err(format!("`{line}` is looked at in suite/printed and suite/behaviour").into());
    }
    let own = name(path);
    let (exit, said) = call("run", path, &head.options, &[], &folder())?;
    compare(&own, &head, exit, &said)?;
    if head.what == "check" {
        let (exit, said) = call("check", path, &head.options, &[], &folder())?;
        compare(&own, &head, exit, &said)?;
    }
    Ok(())
}

fn list(path: &Path) -> Result<(), Failed> {
    let text = std::fs::read_to_string(path)?;
    let head = head(&text)?;
    let home = tempfile::tempdir()?;
    for list in files(&machines().join("xyz"), "lis") {
        std::fs::copy(&list, home.path().join(name(&list)))?;
    }
    std::fs::write(home.path().join(&head.what), &text)?;
    let program = home.path().join("part.nc");
    std::fs::write(&program, PROGRAM)?;
    let mut options = head.options.clone();
    options.extend(["-m".to_owned(), home.path().display().to_string()]);
    let (exit, said) = call("run", &program, &options, &[], home.path())?;
    Ok(compare(&head.what, &head, exit, &said)?)
}

/// The IDs in the heads of programs and lists. What the vendor's page of an ID prints is a program of `printed` alone.
fn named() -> Result<BTreeSet<String>, Failed> {
    let folder = folder();
    let lists = files(&folder.join("lists"), "lis");
    let printed = files(&suite::folder("printed"), "nc");
    let mut named = BTreeSet::new();
    for path in files(&folder, "nc").into_iter().chain(lists).chain(printed) {
        let head = head(&String::from_utf8_lossy(&std::fs::read(&path)?))
            .map_err(|e| format!("{}: {e}", path.display()))?;
        named.extend(head.messages.into_iter().map(|(_, id, _)| id));
    }
    Ok(named)
}

/// IDs without a file and the reasons.
fn open() -> Result<BTreeMap<String, String>, Failed> {
    let mut reader = csv::Reader::from_path(folder().join("open.csv"))?;
    let records = reader.records().map(|r| r.map(|r| (r[0].to_owned(), r[1].to_owned())));
    Ok(records.collect::<Result<_, _>>()?)
}

/// Every ID of the catalogue has either a file or a reason for having none.
fn complete() -> Result<(), Failed> {
    let (named, open) = (named()?, open()?);
    let known: BTreeSet<String> = condition::rows().map(|row| row.id.to_string()).collect();
    for id in named.iter().chain(open.keys()) {
        let of_the_program = id.parse().is_ok_and(|n: u32| (1..=1000).contains(&n));
        if !known.contains(id) && !of_the_program {
            return Err(format!("{id} is not in the catalogue").into());
        }
    }
    let mut wrong = Vec::new();
    for id in &known {
        match (named.contains(id), open.contains_key(id)) {
            (false, false) => wrong.push(format!("{id} has neither a file nor a reason")),
            (true, true) => wrong.push(format!("{id} has a file and a reason to have none")),
            _ => {}
        }
    }
    if !wrong.is_empty() {
        return Err(wrong.join("\n").into());
    }
    Ok(())
}

fn main() {
    let arguments = Arguments::from_args();
    let folder = folder();
    let mut trials = vec![Trial::test("every_id_of_the_catalogue", complete)];
    for path in files(&folder, "nc") {
        trials.push(Trial::test(name(&path), move || program(&path)));
    }
    for path in files(&folder.join("lists"), "lis") {
        trials.push(Trial::test(format!("lists/{}", name(&path)), move || list(&path)));
    }
    libtest_mimic::run(&arguments, trials).exit();
}
