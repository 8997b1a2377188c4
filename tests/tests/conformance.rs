//! The ledger of `tests/conformance`: every testable statement of the vendor's five documents, and the test that proves it.
//!
//! `documents.csv` lists the documents with their prefix and number of rows; the rows of a prefix are numbered without gaps (`A001` to
//! `A120`). A row that is called reproduced or chosen must name a test that exists and that names the row in turn, in its documentation
//! or its body.
//!
//! `KONTUR_WRITE_LEDGER=1 cargo test -p kontur-tests --test all conformance` rewrites `tests/conformance/README.md`.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;
use std::path::{Path, PathBuf};

const STATES: [&str; 3] = ["reproduced", "chosen", "open"];

#[derive(Debug)]
struct Document {
    prefix: String,
    rows: usize,
    file: String,
    title: String,
}

impl Document {
    fn ids(&self) -> Vec<String> {
        (1..=self.rows).map(|n| format!("{}{n:03}", self.prefix)).collect()
    }
}

#[derive(Clone, Debug, Default)]
struct Row {
    id: String,
    statement: String,
    state: String,
    /// Names of test functions, separated by blanks.
    tests: String,
    /// What is missing, or the choice that was made.
    note: String,
}

/// A test function: its file, its documentation and its body.
struct Test {
    file: String,
    text: String,
}

/// Test functions of the workspace by name, some of which occur in several files, and tables of programs by the name of their file.
type Tests = BTreeMap<String, Vec<Test>>;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn ledger(file: &str) -> PathBuf {
    root().join("tests/conformance").join(file)
}

fn records(file: &str) -> Vec<csv::StringRecord> {
    let mut reader = csv::Reader::from_path(ledger(file)).unwrap_or_else(|e| panic!("{file}: {e}"));
    reader.records().map(|record| record.unwrap_or_else(|e| panic!("{file}: {e}"))).collect()
}

fn documents() -> Vec<Document> {
    let document = |r: &csv::StringRecord| Document {
        prefix: r[0].to_owned(),
        rows: r[1].parse().unwrap(),
        file: r[2].to_owned(),
        title: r[3].to_owned(),
    };
    records("documents.csv").iter().map(document).collect()
}

fn rows(document: &Document) -> Vec<Row> {
    let row = |r: &csv::StringRecord| Row {
        id: r[0].to_owned(),
        statement: r[1].to_owned(),
        state: r[2].to_owned(),
        tests: r[3].to_owned(),
        note: r[4].to_owned(),
    };
    records(&format!("{}.csv", document.file)).iter().map(row).collect()
}

/// Every `.rs` file of the workspace members, and the tables of programs.
fn sources() -> Vec<PathBuf> {
    let mut folders: Vec<PathBuf> =
        ["filters", "motion", "interpreter", "tests"].map(|member| root().join(member)).into();
    let mut files = Vec::new();
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|e| e == "rs" || e == "txt") {
                files.push(path);
            }
        }
    }
    files.sort();
    files
}

/// The functions with `#[test]`, with the attributes and documentation above them, down to the closing brace, which in formatted code
/// is in the column of the first line.
fn tests_of(text: &str) -> Vec<(String, String)> {
    let lines: Vec<&str> = text.lines().collect();
    let mut found = Vec::new();
    for (at, line) in lines.iter().enumerate() {
        let Some(rest) = line.trim_start().strip_prefix("fn ") else { continue };
        let name: String = rest.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
        let above = |line: &&&str| {
            let line = line.trim_start();
            line.starts_with("///") || line.starts_with("#[")
        };
        let head = lines[..at].iter().rev().take_while(above).count();
        if !lines[at - head..at].iter().any(|line| line.trim() == "#[test]") {
            continue;
        }
        let indent = &line[..line.len() - line.trim_start().len()];
        let last = format!("{indent}}}");
        let body = lines[at..].iter().take_while(|line| **line != last).count();
        found.push((name, lines[at - head..at + body].join("\n")));
    }
    found
}

fn all_tests() -> Tests {
    let mut tests = Tests::new();
    for path in sources() {
        let file = path.strip_prefix(root()).unwrap().to_string_lossy().replace('\\', "/");
        let text = std::fs::read_to_string(&path).unwrap();
        let name = || path.file_name().unwrap().to_string_lossy().into_owned();
        let found = if file.ends_with(".txt") { vec![(name(), text)] } else { tests_of(&text) };
        for (name, text) in found {
            tests.entry(name).or_default().push(Test { file: file.clone(), text });
        }
    }
    tests
}

fn names_row(text: &str, id: &str) -> bool {
    text.split(|c: char| !c.is_alphanumeric()).any(|word| word == id)
}

/// All mistakes in the rows of a document.
fn faults(document: &Document, rows: &[Row], tests: &Tests) -> Vec<String> {
    let mut faults = Vec::new();
    let known = document.ids();
    let count = |id: &str| rows.iter().filter(|row| row.id == id).count();
    for id in &known {
        match count(id) {
            1 => {}
            0 => faults.push(format!("{id} is missing")),
            n => faults.push(format!("{id} is listed {n} times")),
        }
    }
    for Row { id, statement, state, tests: named, note } in rows {
        if !known.contains(id) {
            faults.push(format!("{id} is no row of {}", document.file));
        }
        if statement.is_empty() {
            faults.push(format!("{id} says nothing"));
        }
        if !STATES.contains(&state.as_str()) {
            faults.push(format!("{id}: `{state}` is no state"));
        }
        if state == "open" {
            if note.is_empty() {
                faults.push(format!("{id} is open and does not say what is missing"));
            }
        } else if named.is_empty() {
            faults.push(format!("{id} is called {state} without a test"));
        }
        for name in named.split_whitespace() {
            match tests.get(name) {
                None => faults.push(format!("{id}: there is no test `{name}`")),
                Some(found) if found.iter().any(|test| names_row(&test.text, id)) => {}
                Some(_) => faults.push(format!("{id}: the test `{name}` does not name the row")),
            }
        }
    }
    faults
}

/// The ledger as a page.
fn page(ledger: &[(Document, Vec<Row>)], tests: &Tests) -> String {
    let mut text = String::from(
        "# Conformance\n\n\
         Every testable statement of the vendor's documents, and the test that proves it. *Reproduced*: the test asserts \
         what the\ndocument states. *Chosen*: the document is silent or contradicts itself; the test asserts what kontur \
         does. *Open*: not\nproven, with what is missing.\n\n\
         This page is made from the CSV files next to it; a test compares them. Regenerate it with\n\
         `KONTUR_WRITE_LEDGER=1 cargo test -p kontur-tests --test all conformance`.\n\n\
         | document | rows | reproduced | chosen | open |\n|---|---|---|---|---|\n",
    );
    for (document, rows) in ledger {
        let [reproduced, chosen, open] =
            STATES.map(|state| rows.iter().filter(|row| row.state == state).count());
        let (title, all) = (&document.title, rows.len());
        writeln!(text, "| {title} | {all} | {reproduced} | {chosen} | {open} |").unwrap();
    }
    for (document, rows) in ledger {
        write!(
            text,
            "\n## {}\n\n| row | statement | state | tests | note |\n|---|---|---|---|---|\n",
            document.title
        )
        .unwrap();
        for row in rows {
            let link = |name: &str| {
                let of = tests.get(name).into_iter().flatten();
                let file = of.filter(|test| names_row(&test.text, &row.id)).map(|test| &test.file);
                let files: BTreeSet<_> = file.collect();
                let link = |file| format!("[`{name}`](../../{file})");
                files.into_iter().map(link).collect::<Vec<_>>().join(" ")
            };
            let links: Vec<String> = row.tests.split_whitespace().map(link).collect();
            let cells = [&row.id, &row.statement, &row.state, &links.join(" "), &row.note];
            let cells: Vec<String> = cells.iter().map(|cell| cell.replace('|', "\\|")).collect();
            writeln!(text, "| {} |", cells.join(" | ")).unwrap();
        }
    }
    text
}

fn read() -> Vec<(Document, Vec<Row>)> {
    documents()
        .into_iter()
        .map(|document| (rows(&document), document))
        .map(|(r, d)| (d, r))
        .collect()
}

#[test]
fn every_row_is_there_and_proven_by_the_tests_it_names() {
    let tests = all_tests();
    let faults: Vec<String> =
        read().iter().flat_map(|(document, rows)| faults(document, rows, &tests)).collect();
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn the_page_is_made_from_the_data() {
    let page = page(&read(), &all_tests());
    let path = ledger("README.md");
    if std::env::var_os("KONTUR_WRITE_LEDGER").is_some() {
        std::fs::write(&path, &page).unwrap();
    }
    let written = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(written == page, "README.md of the ledger is out of date: set KONTUR_WRITE_LEDGER=1");
}

/// The rules of the ledger itself.
#[test]
fn what_is_wrong_is_found() {
    let source = "    /// Proves Q001.\n    #[test]\n    fn proof() {\n        let x = 1;\n    }\n\n    fn helper() {\n        // Q002\n    }\n";
    let mut tests = Tests::new();
    for (name, text) in tests_of(source) {
        tests.entry(name).or_default().push(Test { file: "f.rs".to_owned(), text });
    }
    assert_eq!(tests.keys().collect::<Vec<_>>(), ["proof"]);
    let document =
        Document { prefix: "Q".into(), rows: 2, file: "q".into(), title: "Questions".into() };
    let row = |id: &str, state: &str, tests: &str| Row {
        id: id.into(),
        statement: "it is so".into(),
        state: state.into(),
        tests: tests.into(),
        note: "nothing".into(),
    };
    let of = |rows: &[Row]| faults(&document, rows, &tests);
    let (good, open) = (row("Q001", "reproduced", "proof"), row("Q002", "open", ""));
    let none: [&str; 0] = [];
    assert_eq!(of(&[good.clone(), open.clone()]), none);
    assert_eq!(of(std::slice::from_ref(&good)), ["Q002 is missing"]);
    assert_eq!(of(&[good.clone(), good.clone(), open.clone()]), ["Q001 is listed 2 times"]);
    assert_eq!(of(&[row("Q001", "done", "proof"), open.clone()]), ["Q001: `done` is no state"]);
    for (second, fault) in [
        (row("Q002", "reproduced", ""), "Q002 is called reproduced without a test"),
        (row("Q002", "chosen", ""), "Q002 is called chosen without a test"),
        (row("Q002", "chosen", "helper"), "Q002: there is no test `helper`"),
        (row("Q002", "reproduced", "proof"), "Q002: the test `proof` does not name the row"),
        (
            Row { note: String::new(), ..open.clone() },
            "Q002 is open and does not say what is missing",
        ),
        (Row { statement: String::new(), ..open.clone() }, "Q002 says nothing"),
    ] {
        assert_eq!(of(&[good.clone(), second]), [fault]);
    }
    let extra = of(&[good, open, row("Q003", "open", "")]);
    assert_eq!(extra, ["Q003 is no row of q"]);
}
