//! Calls of the command line that are rows of `commands.txt`, whose head describes their form.

use crate::kit::{CORNER, Folder};
use kontur::Exit;
use std::collections::BTreeSet;
use std::ffi::OsString;

/// Words of a row, separated by blanks; `'..'` encloses one with blanks.
fn words(row: &str) -> Vec<&str> {
    let mut parts = row.split('\'').enumerate();
    let mut words = Vec::new();
    for (i, part) in parts.by_ref() {
        if i % 2 == 1 { words.push(part) } else { words.extend(part.split_whitespace()) }
    }
    words
}

/// Names of the files in a folder.
fn files(folder: &Folder) -> BTreeSet<OsString> {
    std::fs::read_dir(folder.path("")).unwrap().map(|entry| entry.unwrap().file_name()).collect()
}

/// What is wrong with the answer to a row.
fn mistakes(folder: &Folder, row: &str) -> Option<String> {
    let (call, expected) = row.split_once(" -> ").unwrap_or_else(|| panic!("{row}: no arrow"));
    let before = files(folder);
    let (exit, out, err) = folder.call(&words(call));
    let mut parts = expected.split('"');
    let mut place = parts.next().unwrap_or_default().trim();
    let code = place.split(' ').next().unwrap_or_default();
    let mut wrong = exit as u8 != code.parse::<u8>().unwrap();
    wrong |= exit == Exit::Usage && files(folder) != before;
    place = place.strip_prefix(code).unwrap_or_default().trim();
    while let Some(part) = parts.next() {
        let part = &part.replace('\'', "\"")[..];
        wrong |= match place {
            "" if code == "0" => !out.contains(part),
            "" | "err" => !err.contains(part),
            "out" => !out.contains(part),
            "once" => err.matches(part).count() != 1,
            "no" => out.contains(part) || err.contains(part),
            place => panic!("{row}: {place}"),
        };
        place = parts.next().unwrap_or_default().trim();
    }
    wrong.then(|| format!("{row}\n  ends with {exit:?}\n{out}\n{err}\n"))
}

#[test]
fn commands_answer_as_their_rows_say() {
    let mut wrong = Vec::new();
    for paragraph in include_str!("commands.txt").split("\n\n") {
        let folder = Folder::new();
        for row in paragraph.lines().filter(|row| !row.starts_with('#')) {
            match row.strip_prefix("file ").and_then(|file| file.split_once(':')) {
                Some((name, text)) => {
                    let text = text.trim().replace(" | ", "\n");
                    let path = folder.path(name);
                    std::fs::create_dir_all(path.parent().unwrap()).unwrap();
                    std::fs::write(path, text).unwrap();
                }
                None => wrong.extend(mistakes(&folder, row)),
            }
        }
        // no call writes into a file that it has read
        assert_eq!(folder.read("corner.nc"), CORNER, "{paragraph}");
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
