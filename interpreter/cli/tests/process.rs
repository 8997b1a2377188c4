//! What only a process has: standard input, and a reader of stdout that goes away.

#![expect(clippy::unwrap_used, reason = "helpers of tests")]

use std::io::{BufRead, BufReader, Write};
use std::process::{Child, Command, Output, Stdio};

const PROGRAM: &str = "G01 X10 F1000\nY5\nM30\n";

fn start(words: &[&str], folder: &std::path::Path) -> Child {
    let mut command = Command::new(env!("CARGO_BIN_EXE_kontur"));
    command.args(words).current_dir(folder);
    let piped = command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    piped.spawn().unwrap()
}

fn with_input(words: &[&str], input: &str, folder: &std::path::Path) -> Output {
    let mut child = start(words, folder);
    child.stdin.take().unwrap().write_all(input.as_bytes()).unwrap();
    child.wait_with_output().unwrap()
}

#[test]
fn a_program_from_standard_input() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("a.nc"), PROGRAM).unwrap();
    let from_file = with_input(&["run", "a.nc", "-o", "-"], "", folder.path());
    let piped = with_input(&["run", "-", "-o", "-"], PROGRAM, folder.path());
    assert_eq!((piped.status.code(), from_file.status.code()), (Some(0), Some(0)));
    assert_eq!(piped.stdout, from_file.stdout);
    assert!(piped.stdout.starts_with(b"t_s,"));
    assert!(String::from_utf8(piped.stderr).unwrap().starts_with("<stdin>  finished"));
    // a fault is named with its place
    let wrong = with_input(&["check", "-"], "G01 X10 F100\nG7\nM30\n", folder.path());
    assert_eq!(wrong.status.code(), Some(1));
    assert!(String::from_utf8(wrong.stderr).unwrap().contains("<stdin>:2:1"));
    assert!(!folder.path().join("-").exists());
}

#[test]
fn a_reader_that_has_seen_enough_ends_the_run_silently() {
    let folder = tempfile::tempdir().unwrap();
    // longer than any pipe
    std::fs::write(folder.path().join("a.nc"), "G01 X400 F600\nX0\nM30\n").unwrap();
    let mut child = start(&["run", "a.nc", "-o", "-", "--summary", "none"], folder.path());
    let mut line = String::new();
    BufReader::new(child.stdout.take().unwrap()).read_line(&mut line).unwrap();
    assert!(line.starts_with("t_s,"));
    let ended = child.wait_with_output().unwrap();
    assert_eq!((ended.status.code(), ended.stderr), (Some(3), Vec::new()));
}
