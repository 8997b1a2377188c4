//! Programs that state the expected result in their first lines, as in `tests/suite`.

use crate::command::command;
use std::ffi::OsString;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

/// One message, as a file states it or as the command line prints it: severity, ID, place.
pub type Said = (String, String, String);

/// Contents of the first lines of a file.
#[derive(Debug)]
pub struct Head {
    /// `run` or `check`, or the name of a list.
    pub what: String,
    /// Words of the command line after the program.
    pub options: Vec<String>,
    /// Exit code.
    pub exit: u8,
    /// Messages, in order.
    pub messages: Vec<Said>,
    /// The lines that are not messages.
    pub other: Vec<String>,
}

/// ID of the recommendations for lists.
const ADVICE: &str = "K-0078";

/// A folder of `tests/suite`.
pub fn folder(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("suite").join(name)
}

/// The sample machines.
pub fn machines() -> PathBuf {
    crate::programs().join("machines")
}

/// Files of a folder with the given extension, sorted.
pub fn files(folder: &Path, extension: &str) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display()));
    let mut files: Vec<PathBuf> = entries
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|e| e == extension))
        .collect();
    files.sort();
    files
}

/// Last part of a path.
pub fn name(path: &Path) -> String {
    path.file_name().unwrap().to_string_lossy().into_owned()
}

/// The head of a file; programs open comments with `;`, lists with `#`.
///
/// # Errors
/// If the first line lacks something, with what it lacks.
pub fn head(text: &str) -> Result<Head, String> {
    let mut lines = text.lines().map_while(|line| {
        line.strip_prefix("; ").or_else(|| line.strip_prefix("# ")).map(str::trim_end)
    });
    let first = lines.next().ok_or("no head")?;
    let (call, exit) = first.rsplit_once(": exit ").ok_or("`: exit` is missing")?;
    let mut words = call.split_whitespace().map(str::to_owned);
    let what = words.next().ok_or("run, check or the name of a list is missing")?;
    let exit = exit.parse().map_err(|_| format!("{exit} is no exit code"))?;
    let mut head =
        Head { what, options: words.collect(), exit, messages: Vec::new(), other: Vec::new() };
    for line in lines {
        let mut words = line.splitn(3, ' ');
        match (words.next(), words.next(), words.next()) {
            (Some(severity @ ("error" | "warning" | "note")), Some(id), Some(place)) => {
                let place = place.strip_prefix("at ").unwrap_or(place);
                head.messages.push((severity.to_owned(), id.to_owned(), place.to_owned()));
            }
            _ => head.other.push(line.to_owned()),
        }
    }
    Ok(head)
}

/// Calls the command line with the words of `more` and reads its messages; machines of the repository are given by name.
///
/// # Errors
/// If a message has no ID or, unless it is a note, no hint.
pub fn call(
    verb: &str,
    program: &Path,
    options: &[String],
    more: &[OsString],
    home: &Path,
) -> Result<(u8, Vec<Said>), String> {
    let mut args: Vec<OsString> = vec![verb.into(), program.into()];
    for option in options {
        // a machine, or the file for `--input`
        let places = [machines().join(option), folder("inputs").join(option)];
        let file = places.into_iter().find(|path| path.exists());
        args.push(file.map_or_else(|| option.into(), Into::into));
    }
    args.extend(more.iter().cloned());
    args.extend(["--diagnostics", "json"].map(OsString::from));
    if verb == "run" {
        args.extend(["--summary", "none"].map(OsString::from));
    }
    let output = command(args);
    let mut said = Vec::new();
    // the closing sentence of a refusal has no ID
    let sentence = "{\"id\":null,\"severity\"";
    let is_message = |line: &&str| line.starts_with('{') && !line.starts_with(sentence);
    for line in output.err.lines().filter(is_message) {
        said.push(message(line, home)?);
    }
    Ok((output.exit as u8, said))
}

fn message(line: &str, home: &Path) -> Result<Said, String> {
    let json: serde_json::Value = serde_json::from_str(line).map_err(|e| e.to_string())?;
    let severity = json["severity"].as_str().ok_or("severity")?.to_owned();
    let id = match (json["id"].as_u64(), json["kontur_id"].as_str()) {
        (Some(id), None) => id.to_string(),
        (None, Some(id)) => id.to_owned(),
        _ => return Err(format!("no ID: {line}")),
    };
    if severity != "note" && json["hint"].as_str().is_none_or(str::is_empty) {
        return Err(format!("{severity} {id} has no hint: {}", json["text"]));
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

/// Compares the messages with the head of the file called `own`.
///
/// # Errors
/// If they differ, with the difference.
pub fn compare(own: &str, head: &Head, exit: u8, said: &[Said]) -> Result<(), String> {
    let shown = |said: &[Said]| -> String {
        let mut text = String::new();
        for (severity, id, place) in said {
            let place = place.strip_prefix(own).unwrap_or(place).trim_start();
            let _ = writeln!(text, "  {severity} {id} at {place}");
        }
        text
    };
    // recommendations for lists count only in the tests of the recommendations themselves
    let expects_advice = head.messages.iter().any(|m| m.1 == ADVICE);
    let said: Vec<Said> =
        said.iter().filter(|m| expects_advice || m.1 != ADVICE).cloned().collect();
    let (wanted, found) = (shown(&head.messages), shown(&said));
    if wanted != found {
        return Err(format!("expected\n{wanted}said\n{found}"));
    }
    if exit != head.exit {
        return Err(format!("exit {exit}, {} expected", head.exit));
    }
    Ok(())
}

/// Writes a table after the marker in the README of a folder if `KONTUR_WRITE_LEDGER` is set, else compares.
///
/// # Errors
/// If the README is out of date or cannot be read.
pub fn ledger(folder: &Path, table: &str) -> Result<(), String> {
    let path = folder.join("README.md");
    let old = std::fs::read_to_string(&path).map_err(|e| e.to_string())?;
    let marker = "<!-- written by the test -->\n";
    let (above, _) = old.split_once(marker).ok_or("README.md has no marker")?;
    let new = format!("{above}{marker}{table}");
    if std::env::var_os("KONTUR_WRITE_LEDGER").is_some() {
        std::fs::write(&path, new).map_err(|e| e.to_string())
    } else if new == old {
        Ok(())
    } else {
        Err("README.md is out of date: run with KONTUR_WRITE_LEDGER=1".into())
    }
}
