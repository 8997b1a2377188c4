//! Output files of commands: refused and aborted runs, kills, and outputs that are also inputs.

#![cfg(unix)]
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::Duration;

fn kontur(folder: &Path, words: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_kontur"));
    command.args(words).current_dir(folder);
    command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::piped());
    command
}

fn run(folder: &Path, words: &[&str]) -> Output {
    kontur(folder, words).output().unwrap()
}

/// Names in a folder that begin with `start`, sorted.
fn names(folder: &Path, start: &str) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).unwrap().map(|e| e.unwrap().path());
    let is = |p: &PathBuf| p.file_name().unwrap().to_string_lossy().starts_with(start);
    let mut names: Vec<PathBuf> = entries.filter(is).collect();
    names.sort();
    names
}

/// Takes longer than any test: 4000 s of program time.
const LONG: &str = "G01 X400 F6\nM30\n";

/// Calls `sub.nc` if the motion has taken time, which the preceding check cannot know.
const LATE: &str = "#TIMER START SYN [ID=1]\nG01 X2 F6000\n#TIMER READ SYN [ID=1]\n\
                    $IF V.G.TIMER[1] > 0\nL sub.nc\n$ENDIF\nM30\n";

/// A recording of a decaying vibration of 30 Hz.
fn ringing() -> String {
    let sample = |k: u32| {
        let t = f64::from(k) * 1e-3;
        let a = libm::exp(-6.0 * t) * libm::sin(std::f64::consts::TAU * 30.0 * t);
        format!("{t:.3},{a:.9}\n")
    };
    "t_s,a\n".to_owned() + &(0..1000).map(sample).collect::<String>()
}

/// Waits until a condition holds.
fn until(mut condition: impl FnMut() -> bool) {
    while !condition() {
        std::thread::sleep(Duration::from_millis(5));
    }
}

fn signal(child: &Child, name: &str) {
    let status = Command::new("kill").args([name, &child.id().to_string()]).status();
    assert!(status.unwrap().success());
}

#[test]
fn a_command_that_fails_leaves_every_file_as_it_was() {
    let folder = tempfile::tempdir().unwrap();
    let f = folder.path();
    let machine = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../programs/machines/xyz");
    fs::create_dir(f.join("m")).unwrap();
    for list in fs::read_dir(machine).unwrap() {
        let list = list.unwrap().path();
        fs::copy(&list, f.join("m").join(list.file_name().unwrap())).unwrap();
    }
    let texts = [
        ("a.nc", "L sub.nc\nM30\n"),
        ("sub.nc", "G01 X1 F6000\n"),
        ("bad.nc", "G01 X1 F6000\nG7\nM30\n"),
        ("in.csv", "t_s,override_percent\n0,100\n"),
        ("rec.csv", &ringing()),
        // only the moving axes show that it is called
        ("late.nc", LATE),
        ("table.csv.rows", "G01 X1 F6000\nM30\n"),
        ("old.csv", "old"),
        ("old.parquet", "old"),
        ("old.html", "old"),
        ("old.svg", "old"),
    ];
    for (name, text) in texts {
        fs::write(f.join(name), text).unwrap();
    }
    for (name, link) in
        [("a.nc", "1"), ("sub.nc", "2"), ("m/x.lis", "3"), ("in.csv", "4"), ("old.csv", "5")]
    {
        fs::hard_link(f.join(name), f.join(link)).unwrap();
    }
    for (name, link) in [
        ("m/x.lis", "x.csv"),
        ("m/x.lis", "x.svg"),
        ("rec.csv", "rec.svg"),
        ("sub.nc", "sub.svg"),
        ("sub.nc", "sub.html"),
        ("sub.nc", "sub.csv"),
    ] {
        std::os::unix::fs::symlink(name, f.join(link)).unwrap();
    }
    let run_a = ["run", "a.nc", "-m", "m", "--input", "in.csv", "-o"];
    let with = |more: &[&'static str]| [&run_a[..], more].concat();
    let vary = ["--vary", "X.getriebe[0].kv=1000,2000", "-o"];
    let tune = ["tune", "--recording", "rec.csv", "--max-dev", "0.01", "--program"];
    let cases: Vec<(Vec<&str>, i32)> = vec![
        (vec!["run", "bad.nc", "-o", "old.csv", "-o", "old.parquet"], 1),
        (vec!["report", "bad.nc", "-o", "old.html"], 1),
        (vec!["report", "bad.nc", "-o", "old.svg", "--signals", "ipo"], 1),
        (with(&["old.csv", "-o", "no/such/folder.csv"]), 3),
        (with(&["old.csv", "-o", "no/such/folder.parquet"]), 3),
        (with(&["old.csv", "-o", "m"]), 3),
        (with(&["old.csv", "-o", "./old.csv"]), 2),
        (with(&["old.csv", "-o", "5"]), 2),
        (with(&["new.csv", "-o", "./new.csv"]), 2),
        (with(&["a.nc"]), 2),
        (with(&["sub.nc"]), 2),
        (with(&["in.csv"]), 2),
        (with(&["m/x.lis"]), 2),
        (with(&["1"]), 2),
        (with(&["2"]), 2),
        (with(&["3"]), 2),
        (with(&["4"]), 2),
        ([&["sweep", "a.nc", "-m", "m"], &vary[..], &["sub.nc"]].concat(), 2),
        ([&["sweep", "a.nc", "-m", "m"], &vary[..], &["old.csv", "-o", "no/such.svg"]].concat(), 3),
        ([&["sweep", "a.nc"], &vary[..], &["old.csv", "--columns", "nothing"]].concat(), 2),
        (vec!["response", "-m", "m", "--axis", "X", "-o", "x.csv"], 2),
        (vec!["tune", "-m", "m", "--freq", "40", "-o", "x.svg"], 2),
        (vec!["tune", "--recording", "rec.csv", "-o", "rec.svg"], 2),
        ([&tune[..], &["a.nc", "-o", "sub.svg"]].concat(), 2),
        ([&tune[..], &["late.nc", "-o", "sub.svg"]].concat(), 2),
        (vec!["run", "late.nc", "-o", "old.csv", "-o", "sub.nc"], 2),
        (vec!["run", "late.nc", "-o", "2"], 2),
        (vec!["run", "late.nc", "--times=sub.csv"], 2),
        (with(&["old.csv", "--times=no/such.csv"]), 3),
        (vec!["report", "late.nc", "-o", "sub.html"], 2),
        (vec!["report", "late.nc", "-o", "sub.svg"], 2),
        (vec!["report", "late.nc", "--signals", "ipo", "-o", "sub.csv"], 2),
        ([&["sweep", "late.nc"], &vary[..], &["sub.csv"]].concat(), 2),
        ([&["sweep", "table.csv.rows"], &vary[..], &["table.csv"]].concat(), 2),
        ([&["sweep", "a.nc"], &vary[..], &["table.csv"]].concat(), 3),
        (vec!["response", "--guard", "FREQ=40", "-o", "old.csv", "-o", "no/such.svg"], 3),
    ];
    for (words, exit) in cases {
        let said = run(f, &words);
        let err = String::from_utf8_lossy(&said.stderr);
        assert_eq!(said.status.code(), Some(exit), "{words:?}: {err}");
        for (name, text) in texts {
            assert_eq!(fs::read_to_string(f.join(name)).unwrap(), text, "{words:?}: {name}");
        }
        assert!(!err.contains(".part"), "{words:?}: {err}");
        assert!(fs::read_to_string(f.join("m/x.lis")).unwrap().contains("kopf."), "{words:?}");
        let left = [names(f, "new"), names(f, ".")].concat();
        assert!(left.is_empty(), "{words:?}: {left:?}");
        let _ = fs::remove_file(f.join("old.csv.rows"));
        let _ = fs::remove_file(f.join("sub.csv.rows"));
    }
    // and a successful run replaces this file only
    assert_eq!(run(f, &with(&["old.csv", "-o", "old.parquet"])).status.code(), Some(0));
    assert!(fs::read_to_string(f.join("old.csv")).unwrap().starts_with("t_s,"));
    assert!(fs::read(f.join("old.parquet")).unwrap().starts_with(b"PAR1"));
    assert_eq!(fs::read_to_string(f.join("5")).unwrap(), "old", "a hard link keeps what it had");
}

/// Rows of a CSV trace; every line is complete, and time increases by one cycle per line.
fn csv_rows(path: &Path) -> u64 {
    let text = fs::read_to_string(path).unwrap();
    assert!(text.ends_with('\n'));
    let columns = text.lines().next().unwrap().split(',').count();
    for (k, line) in (0_u64..).zip(text.lines().skip(1)) {
        assert_eq!(line.split(',').count(), columns);
        let expected = format!("{}.{:06}", k / 1000, k % 1000 * 1000);
        assert!(line.starts_with(&expected), "{k}: {line}");
    }
    text.lines().count() as u64 - 1
}

#[test]
fn a_signal_ends_a_run_with_whole_files() {
    for (name, exit) in [("-INT", Some(1)), ("-TERM", Some(1)), ("-KILL", None)] {
        let folder = tempfile::tempdir().unwrap();
        let f = folder.path();
        fs::write(f.join("a.nc"), LONG).unwrap();
        let words = ["run", "a.nc", "-o", "a.csv", "-o", "a.parquet", "--signals", "ipo"];
        let mut child = kontur(f, &words).spawn().unwrap();
        // two groups of rows
        until(|| names(f, ".a.parquet.").iter().any(|p| p.join("000002.parquet").exists()));
        signal(&child, name);
        assert_eq!(child.wait().unwrap().code(), exit, "{name}");
        let parquet = f.join("a.parquet");
        if exit.is_some() {
            let rows = csv_rows(&f.join("a.csv"));
            assert!(rows > 100_000, "{name}: {rows}");
            assert!(names(f, ".").is_empty(), "{name}");
            assert_eq!(parquet_rows(&[parquet]), rows);
        } else {
            assert!(!parquet.exists());
            assert_eq!(names(f, ".").len(), 1, "the parts, and no file that is empty");
            // data being written at the time of the kill are under another name
            let parts = names(f, ".a.parquet.").into_iter().find(|p| p.is_dir()).unwrap();
            let parts = names(&parts, "").into_iter();
            let whole: Vec<PathBuf> =
                parts.filter(|p| p.extension().is_some_and(|e| e == "parquet")).collect();
            assert_eq!(parquet_rows(&whole), 65_536 * whole.len() as u64);
        }
    }
}

/// A supervisor signals a process and its group: the second signal must not cost what the first one saves.
#[test]
fn two_signals_at_once_are_one() {
    let folder = tempfile::tempdir().unwrap();
    let f = folder.path();
    fs::write(f.join("a.nc"), LONG).unwrap();
    let mut child = kontur(f, &["run", "a.nc", "-o", "a.csv", "--signals", "ipo"]).spawn().unwrap();
    until(|| fs::metadata(f.join("a.csv")).is_ok_and(|m| m.len() > 100_000));
    // two kinds, because two of one kind may be delivered as one
    let id = child.id();
    let both = format!("kill -INT {id}; kill -TERM {id}");
    assert!(Command::new("sh").args(["-c", &both]).status().unwrap().success());
    assert_eq!(child.wait().unwrap().code(), Some(1));
    assert!(csv_rows(&f.join("a.csv")) > 0);
}

/// Rows of consecutive Parquet files; time increases by one cycle per row.
#[cfg(feature = "parquet")]
fn parquet_rows(paths: &[PathBuf]) -> u64 {
    use parquet::file::reader::{FileReader, SerializedFileReader};
    use parquet::record::RowAccessor;
    let mut k = 0;
    for path in paths {
        let reader = SerializedFileReader::new(fs::File::open(path).unwrap()).unwrap();
        for row in reader.get_row_iter(None).unwrap() {
            let t = row.unwrap().get_double(0).unwrap();
            assert!((t - k as f64 * 1e-3).abs() < 1e-9, "row {k} at {t}");
            k += 1;
        }
    }
    k
}

/// A kill at any moment leaves complete lines, except for the last one if it occurs during a write.
#[test]
fn a_kill_at_any_moment_leaves_a_trace() {
    for wait_ms in [20, 150, 333, 700, 1300] {
        let folder = tempfile::tempdir().unwrap();
        let f = folder.path();
        fs::write(f.join("a.nc"), LONG).unwrap();
        let mut child = kontur(f, &["run", "a.nc", "-o", "a.csv"]).spawn().unwrap();
        std::thread::sleep(Duration::from_millis(wait_ms));
        child.kill().unwrap();
        child.wait().unwrap();
        let trace = f.join("a.csv");
        if trace.exists() {
            let text = fs::read(&trace).unwrap();
            let whole = text.iter().rposition(|b| *b == b'\n').unwrap() + 1;
            fs::write(&trace, &text[..whole]).unwrap();
            assert!(csv_rows(&trace) > 0);
        }
    }
}

#[test]
fn a_killed_sweep_continues_where_it_stopped() {
    let folder = tempfile::tempdir().unwrap();
    let f = folder.path();
    fs::write(f.join("a.nc"), "G01 X20 F600\nM30\n").unwrap();
    let words = ["sweep", "a.nc", "--vary", "X.getriebe[0].kv=1000..30000:1000", "-o"];
    let sweep = |name: &'static str| [&words[..], &[name]].concat();
    assert!(run(f, &sweep("whole.csv")).status.success());
    let mut child = kontur(f, &sweep("a.csv")).spawn().unwrap();
    let rows = || fs::read_to_string(f.join("a.csv.rows")).map_or(0, |t| t.lines().count());
    until(|| rows() > 3);
    child.kill().unwrap();
    child.wait().unwrap();
    assert!(!f.join("a.csv").exists() && rows() > 3);
    assert!(names(f, ".").is_empty(), "no empty file is left");
    let done = run(f, &sweep("a.csv"));
    assert!(done.status.success());
    let said = String::from_utf8(done.stderr).unwrap();
    assert!(
        said.contains("continues where it was stopped") && said.contains("of 30 runs"),
        "{said}"
    );
    assert_eq!(fs::read(f.join("a.csv")).unwrap(), fs::read(f.join("whole.csv")).unwrap());
    assert!(!f.join("a.csv.rows").exists());
}

/// Also for a trace so short that this is noticed only at its end.
#[test]
fn a_reader_that_goes_away_does_not_end_the_other_output() {
    let folder = tempfile::tempdir().unwrap();
    let f = folder.path();
    // 0.4, 4 and 40 mm at 10 mm/s
    for (way, rows) in [("0.4", 40), ("4", 400), ("40", 4000)] {
        fs::write(f.join("a.nc"), format!("G01 X{way} F600\nM30\n")).unwrap();
        let words = ["run", "a.nc", "-o", "k.csv", "-o", "-", "--summary", "none"];
        let mut command = kontur(f, &words);
        let mut child = command.stdout(Stdio::piped()).spawn().unwrap();
        drop(child.stdout.take());
        assert_eq!(child.wait().unwrap().code(), Some(0), "{way}");
        assert!(csv_rows(&f.join("k.csv")) > rows);
    }
}

/// All other commands: the exit code is documented, incomplete output has neither its final name nor remains under a temporary
/// one.
#[test]
fn a_signal_ends_every_command_and_leaves_no_half_file() {
    let sweep = ["sweep", "a.nc", "--vary", "X.getriebe[0].kv=1000..9000:10", "-o", "s.csv"];
    let commands: [(&[&str], i32); 5] = [
        (&["report", "a.nc", "-o", "a.html"], 1),
        // a window far ahead: if it had more cycles than a plot accepts, the command would exit with 2 before the signal
        // arrives
        (&["report", "a.nc", "-o", "a.svg", "--signals", "ipo", "--window", "3900..3901"], 1),
        (&sweep, 1),
        (&["diff", "a.nc", "a.nc"], 130),
        (&["check", "wait.nc"], 130),
    ];
    for (words, exit) in commands {
        for name in ["-INT", "-TERM"] {
            let folder = tempfile::tempdir().unwrap();
            let f = folder.path();
            fs::write(f.join("a.nc"), LONG).unwrap();
            // nothing writes to it
            assert!(Command::new("mkfifo").arg(f.join("wait.nc")).status().unwrap().success());
            let mut child = kontur(f, words).spawn().unwrap();
            std::thread::sleep(Duration::from_millis(400));
            signal(&child, name);
            assert_eq!(child.wait().unwrap().code(), Some(exit), "{words:?} {name}");
            let mut left = names(f, "");
            left.retain(|p| !["a.nc", "wait.nc", "s.csv.rows"].iter().any(|n| p.ends_with(n)));
            assert!(left.is_empty(), "{words:?} {name}: {left:?}");
        }
    }
}

/// A limit of the file size has the effect of a full disk: a write fails after the previous one succeeded.
#[test]
fn a_full_disk_leaves_whole_rows() {
    // units of 512 bytes; one row group fits, the complete table does not
    for (name, room) in [("a.csv", 3000), ("a.parquet", 400), ("s.csv", 8)] {
        let folder = tempfile::tempdir().unwrap();
        let f = folder.path();
        fs::write(f.join("a.nc"), "G01 X400 F60\nM30\n").unwrap();
        fs::write(f.join("s.nc"), "G01 X1 F6000\nM30\n").unwrap();
        let run = format!("run a.nc --signals time,ipo,err -o {name}");
        let sweep = format!("sweep s.nc --vary X.getriebe[0].kv=1000..9000:100 -o {name}");
        let words = if name == "s.csv" { sweep } else { run };
        let limit = format!("trap '' XFSZ; ulimit -f {room}; exec \"$0\" {words}");
        let mut command = Command::new("sh");
        command.args(["-c", &limit, env!("CARGO_BIN_EXE_kontur")]).current_dir(f);
        let said = command.output().unwrap();
        let err = String::from_utf8_lossy(&said.stderr);
        assert_eq!(said.status.code(), Some(3), "{name}: {err}");
        match name {
            "a.csv" => assert!(csv_rows(&f.join(name)) > 10_000),
            "a.parquet" => {
                assert!(err.contains("the rows up to there are in"), "{err}");
                let parts = names(f, ".a.parquet.").into_iter().find(|p| p.is_dir()).unwrap();
                let mut whole = names(&parts, "");
                whole.retain(|p| p.extension().is_some_and(|e| e == "parquet"));
                assert!(parquet_rows(&whole) > 65_536 && !f.join(name).exists());
            }
            _ => {
                let rows = fs::read_to_string(f.join("s.csv.rows")).unwrap();
                assert!(rows.lines().count() > 1, "{err}");
            }
        }
    }
}
