//! The smallest program or list for each message: ID, severity, line, column, hint and exit code.
//!
//! Every file of `tests/suite/faults` is one test. Its first lines say how it is run and what must be said, in this
//! order and nothing else:
//!
//! ```text
//! ; run --set X.getriebe[0].kv=1000: exit 1      `check` in place of `run`: the syntax check already finds all of it
//! ; error 70082 at 6:1                           severity, ID, line and column of the caret; `at file.nc 6:1` elsewhere
//! ```
//!
//! A file of `lists` takes the place of a list of the machine `xyz`: `# x.lis: exit 0`.
//!
//! `open.csv` tells for every ID of the catalogue that has no file why it has none.
//! `KONTUR_WRITE_LEDGER=1 cargo test -p kontur-tests --test faults` writes the table of the folder's README anew.

use kontur_interpreter::diag::condition::{self, Row};
use kontur_interpreter::diag::{Id, Severity};
use kontur_tests::command::command;
use libtest_mimic::{Arguments, Failed, Trial};
use std::collections::{BTreeMap, BTreeSet};
use std::ffi::OsString;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

/// Every condition, ordered by ID.
fn rows() -> Vec<&'static Row> {
    let mut rows: Vec<&Row> = condition::rows().collect();
    rows.sort_by_key(|row| row.id);
    rows
}

/// A program for lists that only need an axis to be loaded.
const PROGRAM: &str = "N10 G01 X1 F1000\nN20 M30\n";

/// ID of the recommendations for lists.
const ADVICE: &str = "K-0078";

/// One message as a file states it or as the command line says it: severity, ID, place.
type Said = (String, String, String);

/// What the first lines of a file say.
struct Head {
    /// `run` or `check`, or the name of a list.
    what: String,
    options: Vec<String>,
    exit: u8,
    messages: Vec<Said>,
}

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("suite/faults")
}

fn machines() -> PathBuf {
    kontur_tests::programs().join("machines")
}

fn files(folder: &Path, extension: &str) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display()));
    let mut files: Vec<PathBuf> = entries
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|e| e == extension))
        .collect();
    files.sort();
    files
}

fn name(path: &Path) -> String {
    path.file_name().unwrap().to_string_lossy().into_owned()
}

/// The head of a file; programs open comments with `;`, lists with `#`.
fn head(text: &str) -> Result<Head, Failed> {
    let mut lines = text.lines().map_while(|line| {
        line.strip_prefix("; ").or_else(|| line.strip_prefix("# ")).map(str::trim_end)
    });
    let first = lines.next().ok_or("no head")?;
    let (call, exit) = first.rsplit_once(": exit ").ok_or("`: exit` is missing")?;
    let mut words = call.split_whitespace().map(str::to_owned);
    let what = words.next().ok_or("run, check or the name of a list is missing")?;
    let messages = lines.filter_map(|line| {
        let (severity, rest) = line.split_once(' ')?;
        let (id, place) = rest.split_once(' ')?;
        let place = place.strip_prefix("at ").unwrap_or(place);
        ["error", "warning", "note"]
            .contains(&severity)
            .then(|| (severity.to_owned(), id.to_owned(), place.to_owned()))
    });
    Ok(Head { what, options: words.collect(), exit: exit.parse()?, messages: messages.collect() })
}

/// Calls the command line and reads its messages.
fn call(
    verb: &str,
    program: &Path,
    options: &[String],
    home: &Path,
) -> Result<(u8, Vec<Said>), Failed> {
    let mut args: Vec<OsString> = vec![verb.into(), program.into()];
    for option in options {
        // the machines of the repository by their names
        let machine = machines().join(option);
        args.push(if machine.is_dir() { machine.into() } else { option.into() });
    }
    args.extend(["--diagnostics", "json"].map(OsString::from));
    if verb == "run" {
        args.extend(["--summary", "none"].map(OsString::from));
    }
    let output = command(args);
    let mut said = Vec::new();
    // the sentence at the end of a refusal has no ID of its own
    let sentence = "{\"id\":null,\"severity\"";
    let is_message = |line: &&str| line.starts_with('{') && !line.starts_with(sentence);
    for line in output.err.lines().filter(is_message) {
        said.push(message(line, home)?);
    }
    Ok((output.exit as u8, said))
}

fn message(line: &str, home: &Path) -> Result<Said, Failed> {
    let json: serde_json::Value = serde_json::from_str(line)?;
    let severity = json["severity"].as_str().ok_or("severity")?.to_owned();
    let id = match (json["id"].as_u64(), json["kontur_id"].as_str()) {
        (Some(id), None) => id.to_string(),
        (None, Some(id)) => id.to_owned(),
        _ => return Err(format!("no ID: {line}").into()),
    };
    if severity != "note" && json["hint"].as_str().is_none_or(str::is_empty) {
        return Err(format!("{severity} {id} has no hint: {}", json["text"]).into());
    }
    let source = &json["source"];
    let place = match source["file"].as_str() {
        None => "-".to_owned(),
        Some(file) => {
            let (line, column) = (&source["line"], &source["column"]);
            let path = Path::new(file);
            let file = path.strip_prefix(home).unwrap_or(path).display().to_string();
            format!("{file} {line}:{column}")
        }
    };
    Ok((severity, id, place))
}

/// Compares what was said with the head of the file called `own`.
fn compare(own: &str, head: &Head, exit: u8, said: &[Said]) -> Result<(), Failed> {
    let shown = |said: &[Said]| -> String {
        let mut text = String::new();
        for (severity, id, place) in said {
            let place = place.strip_prefix(own).unwrap_or(place).trim_start();
            let _ = writeln!(text, "  {severity} {id} at {place}");
        }
        text
    };
    // recommendations for lists are noise beside everything but themselves
    let expects_advice = head.messages.iter().any(|m| m.1 == ADVICE);
    let said: Vec<Said> =
        said.iter().filter(|m| expects_advice || m.1 != ADVICE).cloned().collect();
    let (wanted, found) = (shown(&head.messages), shown(&said));
    if wanted != found {
        return Err(format!("expected\n{wanted}said\n{found}").into());
    }
    if exit != head.exit {
        return Err(format!("exit {exit}, {} expected", head.exit).into());
    }
    Ok(())
}

fn program(path: &Path) -> Result<(), Failed> {
    // damaged encodings are part of the tests
    let head = head(&String::from_utf8_lossy(&std::fs::read(path)?))?;
    let own = name(path);
    let (exit, said) = call("run", path, &head.options, &folder())?;
    compare(&own, &head, exit, &said)?;
    if head.what == "check" {
        let (exit, said) = call("check", path, &head.options, &folder())?;
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
    let (exit, said) = call("run", &program, &options, home.path())?;
    compare(&head.what, &head, exit, &said)
}

/// Files by the IDs that their heads name.
fn named() -> Result<BTreeMap<String, BTreeSet<String>>, Failed> {
    let mut named: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    let folder = folder();
    for path in files(&folder, "nc").into_iter().chain(files(&folder.join("lists"), "lis")) {
        let head = head(&String::from_utf8_lossy(&std::fs::read(&path)?))
            .map_err(|e| format!("{}: {e:?}", path.display()))?;
        let file = path.strip_prefix(&folder)?.display().to_string();
        for (_, id, _) in head.messages {
            named.entry(id).or_default().insert(file.clone());
        }
    }
    Ok(named)
}

/// IDs without a file and the reasons.
fn open() -> Result<BTreeMap<String, String>, Failed> {
    let mut reader = csv::Reader::from_path(folder().join("open.csv"))?;
    let records = reader.records().map(|r| r.map(|r| (r[0].to_owned(), r[1].to_owned())));
    Ok(records.collect::<Result<_, _>>()?)
}

/// Every ID of the catalogue has a file or a reason, and the README tells which.
fn complete() -> Result<(), Failed> {
    let (named, open) = (named()?, open()?);
    let known: BTreeSet<String> = rows().iter().map(|e| e.id.to_string()).collect();
    for id in named.keys().chain(open.keys()) {
        let of_the_program = id.parse().is_ok_and(|n: u32| (1..=1000).contains(&n));
        if !known.contains(id) && !of_the_program {
            return Err(format!("{id} is not in the catalogue").into());
        }
    }
    let mut wrong = Vec::new();
    for id in &known {
        match (named.contains_key(id), open.contains_key(id)) {
            (false, false) => wrong.push(format!("{id} has neither a file nor a reason")),
            (true, true) => wrong.push(format!("{id} has a file and a reason to have none")),
            _ => {}
        }
    }
    if !wrong.is_empty() {
        return Err(wrong.join("\n").into());
    }
    let path = folder().join("README.md");
    let old = std::fs::read_to_string(&path)?;
    let marker = "<!-- written by the test -->\n";
    let (above, _) = old.split_once(marker).ok_or("README.md has no marker")?;
    let new = format!("{above}{marker}{}", table(&named, &open));
    if std::env::var_os("KONTUR_WRITE_LEDGER").is_some() {
        std::fs::write(&path, new)?;
    } else if new != old {
        return Err("README.md is out of date: run with KONTUR_WRITE_LEDGER=1".into());
    }
    Ok(())
}

fn table(named: &BTreeMap<String, BTreeSet<String>>, open: &BTreeMap<String, String>) -> String {
    let of = |e: &&&Row| named.contains_key(&e.id.to_string());
    let covered = rows().iter().filter(of).count();
    let mut text = format!(
        "\n{} IDs, {covered} with a file.\n\n| ID | severity | meaning | files, or why there is none |\n|---|---|---|---|\n",
        rows().len()
    );
    for entry in rows() {
        let id = entry.id.to_string();
        let severity = match entry.severity {
            Severity::Error => "error",
            Severity::Warning => "warning",
            Severity::Note => "note",
        };
        let shown = match entry.id {
            Id::Vendor(_) => id.clone(),
            Id::Kontur(_) => format!("{id} {}", entry.name),
        };
        let last = match (named.get(&id), open.get(&id)) {
            (Some(files), _) => {
                let first = files.iter().take(3).map(|f| format!("`{f}`")).collect::<Vec<_>>();
                let more = files.len().saturating_sub(3);
                let more = if more > 0 { format!(" and {more} more") } else { String::new() };
                format!("{}{more}", first.join(" "))
            }
            (None, Some(reason)) => format!("none: {reason}"),
            (None, None) => String::new(),
        };
        let meaning = entry.meaning.replace('|', "\\|");
        let _ = writeln!(text, "| {shown} | {severity} | {meaning} | {last} |");
    }
    text
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
