//! Files that are not what they seem: programs, subroutines, traces and lists, on the command line.

use kontur::Exit;
use kontur_tests::command::Folder;
use std::fs;

/// The beginning of the block is blanks or a comment, and the motion begins beyond the limit.
#[test]
fn a_first_block_that_is_too_long_does_not_vanish() {
    for begin in [" ".repeat(4100), format!("({})", "x".repeat(4100)), ";".repeat(4100)] {
        let f = Folder::new(&[])
            .with("a.nc", format!("{begin}X1\nM30\n"))
            .with("sub.nc", format!("{begin}X1\n"))
            .with("b.nc", "L sub.nc\nM30\n");
        for program in ["@a.nc", "@b.nc"] {
            for verb in ["check", "run"] {
                let said = f.call(&[verb, program]);
                assert_eq!(said.exit, Exit::Aborted, "{}", said.err);
                assert!(said.err.contains("error[20301]"), "{}", said.err);
            }
        }
    }
}

#[test]
fn messages_quote_the_beginning_of_a_word() {
    let long = format!("L CYCLE [NAME={}]\nM30\n", "y".repeat(3000));
    let said = Folder::new(&[]).with("a.nc", format!("#{}\n{long}", "X".repeat(3000)));
    let said = said.call(&["check", "@a.nc", "--diagnostics", "json"]).err;
    for line in said.lines() {
        let json: serde_json::Value = serde_json::from_str(line).unwrap();
        let text = json["text"].as_str().or(json["message"].as_str()).unwrap();
        assert!(text.chars().count() < 3200, "{text}");
    }
}

/// By absolute names and by links; relative names are rows of the command line.
#[test]
fn subroutines_stay_in_the_folder_of_the_program() {
    let f = Folder::new(&[])
        .with("out.nc", "G01 X1 F6000\n")
        .with("jobs/link.nc", "L linked.nc\nM30\n");
    let absolute = format!("L \"{}\"\nM30\n", f.path("out.nc"));
    let f = f.with("jobs/absolute.nc", absolute);
    let mut leaving = vec!["@jobs/absolute.nc"];
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink(f.path("out.nc"), f.path("jobs/linked.nc")).unwrap();
        leaving.push("@jobs/link.nc");
    }
    for program in leaving {
        let said = f.call(&["check", program]);
        assert_eq!(said.exit, Exit::Aborted, "{program}");
        assert!(
            said.err.contains("K-0013") && said.err.contains("--allow-outside"),
            "{}",
            said.err
        );
        let said = f.call(&["check", program, "--allow-outside"]);
        assert_eq!(said.exit, Exit::Finished, "{program}: {}", said.err);
    }
}

#[test]
fn tables_of_another_form_are_refused_in_plain_words() {
    let trace = "t_s,line,X_set_mm\n0,1,0.5\n0.001,1,0.5\n";
    let utf16: Vec<u8> =
        trace.encode_utf16().fold(vec![0xFF, 0xFE], |v, c| [v, c.to_le_bytes().to_vec()].concat());
    let f = Folder::new(&[])
        .with("a.csv", trace)
        .with("bom.csv", format!("\u{feff}{trace}"))
        .with("semicolon.csv", trace.replace(',', ";").replace('.', ","))
        .with("comment.csv", format!("# a trace\n{trace}"))
        .with("utf16.csv", utf16)
        .with("twice.csv", trace.replace("line", "X_set_mm"))
        .with("ragged.csv", format!("{trace}0.002,1\n"))
        .with("latin.csv", b"t_s,line,\xFC\n0,1,2\n")
        .with("empty.parquet", "")
        .with("endless.csv", format!("t_s,{}", "1".repeat(1 << 20)))
        .with("zeros.csv", b"t_s,line\n0\0,1\n");
    assert_eq!(f.call(&["diff", "@a.csv", "@bom.csv"]).exit, Exit::Finished);
    for (name, exit, reason) in [
        ("@semicolon.csv", Exit::Usage, "not separated by commas"),
        ("@comment.csv", Exit::Usage, "`#` line"),
        ("@utf16.csv", Exit::Usage, "UTF-16"),
        ("@twice.csv", Exit::Usage, "`X_set_mm` occurs twice"),
        ("@ragged.csv", Exit::Io, "line 4: 2 columns where the header has 3"),
        ("@latin.csv", Exit::Io, "the header is not UTF-8"),
        ("@empty.parquet", Exit::Usage, "not a Parquet file"),
        ("@endless.csv", Exit::Io, "longer than 65536 bytes"),
        ("@zeros.csv", Exit::Io, "code 0"),
    ] {
        for words in [["diff", "@a.csv", name], ["diff", name, "@a.csv"]] {
            let said = f.call(&words);
            assert_eq!(said.exit, exit, "{name}: {}", said.err);
            assert!(said.err.contains(reason), "{name}: {}", said.err);
            assert!(!said.err.contains("Some(") && !said.err.contains("{ "), "{}", said.err);
        }
    }
    for name in ["@semicolon.csv", "@utf16.csv", "@endless.csv", "@ragged.csv"] {
        let said = f.call(&["tune", "--recording", name]);
        assert!(said.exit == Exit::Usage || said.exit == Exit::Io, "{name}");
        assert!(!said.err.contains("Some(") && !said.err.contains("{ "), "{}", said.err);
    }
    let said = f.call(&["run", "@a.csv", "--input", "@endless.csv"]);
    assert!(said.err.contains("longer than 65536 bytes"), "{}", said.err);
}

/// Nothing writes to a pipe in a folder: a subroutine, a list or an input that is one would wait forever.
#[test]
#[cfg(unix)]
fn pipes_are_no_subroutines_lists_or_inputs() {
    let f = Folder::new(&[]).with("a.nc", "L pipe.nc\nM30\n").with("b.nc", "M30\n");
    for name in ["pipe.nc", "pipe.lis", "pipe.csv"] {
        let made = std::process::Command::new("mkfifo").arg(f.path(name)).status().unwrap();
        assert!(made.success());
    }
    let cases: [(&[&str], Exit); 4] = [
        (&["check", "@a.nc"], Exit::Aborted),
        (&["run", "@a.nc"], Exit::Aborted),
        (&["run", "@b.nc", "-m", "@pipe.lis"], Exit::Usage),
        (&["run", "@b.nc", "--input", "@pipe.csv"], Exit::Io),
    ];
    for (words, exit) in cases {
        let said = f.call(words);
        assert_eq!(said.exit, exit, "{words:?}: {}", said.err);
        assert!(said.err.contains("not a regular file"), "{words:?}: {}", said.err);
    }
}

/// Cells and names of columns come from the file: they must not move the cursor or fill the screen.
#[test]
fn cells_are_quoted_on_one_line_and_shortened() {
    let f = Folder::new(&[])
        .with("a.csv", "t_s,X_set_mm\n0,1\n")
        .with("b.csv", format!("t_s,\"X_set_mm\n\u{1b}[31m{}\"\n0,1\n", "y".repeat(50_000)))
        .with("c.csv", format!("t_s,X_set_mm\n0,\"\n\u{1b}[2J{}\"\n", "z".repeat(50_000)));
    for name in ["@b.csv", "@c.csv"] {
        let said = f.call(&["diff", "@a.csv", name]);
        assert_eq!(said.exit, Exit::Aborted, "{}", said.err);
        assert!(said.out.contains("\u{FFFD}\u{FFFD}["), "{}", said.out);
        assert!(!said.out.contains('\u{1b}') && said.out.len() < 1000, "{}", said.out);
    }
    let twice = f.with("d.csv", format!("t_s,{0},{0}\n", "y\u{1b}".repeat(9_000)));
    let said = twice.call(&["diff", "@a.csv", "@d.csv"]);
    assert!(said.err.contains("occurs twice") && !said.err.contains('\u{1b}'), "{}", said.err);
    assert!(said.err.len() < 300, "{}", said.err);
}

/// Larger than what is read at once: the change is found while the program is read.
#[test]
fn a_program_that_changes_while_it_runs_ends_as_an_error() {
    use kontur::request::Request;
    use kontur_interpreter::record::CycleRecord;
    let f = Folder::new(&[]);
    let line = "G01 X1 F6000\nX0\n".repeat(20_000);
    for text in ["G01 X9 F600\nM30\n".to_owned(), format!("{line}M30\n")] {
        for change in [None, Some(String::new()), Some(text.replace("X1", "X2") + "\n")] {
            let f = f.path("a.nc");
            fs::write(&f, &text).unwrap();
            let request = Request {
                program: f.clone().into(),
                max_time_s: 5.0,
                max_blocks: 1_000_000,
                ..Request::default()
            };
            let mut run = request.open().unwrap().run;
            let Ok(()) = run.advance(1, &mut |_: &CycleRecord| {});
            if let Some(change) = &change {
                fs::write(&f, change).unwrap();
            }
            let Ok(()) = run.to_end(&mut |_: &CycleRecord| {});
            let said = run.take_diagnostics();
            let told = said.iter().filter(|d| d.text.contains("changed while it was read"));
            assert_eq!(told.count(), usize::from(change.is_some()), "{said:?}");
            let totals = run.totals();
            assert_eq!(totals.input_failed, change.is_some());
        }
    }
}

/// A checkout with Windows line ends, in its code page, with its separators in the names of programs: the same trace, to the last byte,
/// and the same lines in messages.
#[test]
fn a_checkout_of_windows_moves_the_same() {
    let root = kontur_tests::programs();
    let names = ["square_corner.nc", "parametric_pocket.nc", "lessons/6_lag.nc"];
    let windows = |bytes: &[u8], comment: &str| -> Vec<u8> {
        // a comment of the editor, which does not shift any line of the program
        let mut all = bytes.strip_suffix(b"\n").unwrap_or(bytes).to_vec();
        all.extend_from_slice(comment.as_bytes());
        all.extend_from_slice(b"\n");
        let mut converted = Vec::new();
        for byte in all {
            match byte {
                b'\n' => converted.extend_from_slice(b"\r\n"),
                b'?' => converted.push(0xE4),
                _ => converted.push(byte),
            }
        }
        converted
    };
    let mut f = Folder::new(&[]);
    for entry in fs::read_dir(root.join("machines/xyz")).unwrap() {
        let path = entry.unwrap().path();
        let (name, bytes) = (path.file_name().unwrap().to_str().unwrap(), fs::read(&path).unwrap());
        f = f.with(&format!("lf/xyz/{name}"), &bytes);
        f = f.with(&format!("crlf/xyz/{name}"), windows(&bytes, "\n# ge?ndert"));
    }
    for (name, n) in names.iter().zip(0..) {
        let bytes = fs::read(root.join(name)).unwrap();
        f = f.with(&format!("lf/{n}.nc"), &bytes);
        f = f.with(&format!("crlf/{n}.nc"), windows(&bytes, "\n(ge?ndert)"));
    }
    let text = b"%MAIN\nG01 X1 F1000\nL sub\\part.nc\nX0\nM30\n";
    f = f.with("lf/3.nc", text).with("crlf/3.nc", windows(text, ""));
    f = f.with("lf/sub/part.nc", "Y1\nM17\n").with("crlf/sub/part.nc", "Y1 (\u{e4})\r\nM17\r\n");
    for n in 0..4 {
        let trace = |kind: &str| {
            let (program, machine) = (format!("@{kind}/{n}.nc"), format!("@{kind}/xyz"));
            let output = format!("@{kind}/{n}.csv");
            let said = f.call(&["run", &program, "-m", &machine, "-o", &output]);
            assert_eq!(said.exit, Exit::Finished, "{}", said.err);
            f.read(&output[1..]).replace("crlf/", "lf/")
        };
        let (lf, crlf) = (trace("lf"), trace("crlf"));
        let same = lf.lines().zip(crlf.lines()).position(|(a, b)| a != b);
        assert!(lf == crlf, "program {n}: first difference in row {same:?}");
    }
    // the same place in a message
    let wrong = "G01 X1 F100\n(x)\nQQ 7\nM30\n";
    let f = f.with("lf/w.nc", wrong).with("crlf/w.nc", windows(wrong.as_bytes(), ""));
    let place = |kind: &str| {
        let said = f.call(&["check", &format!("@{kind}/w.nc"), "--diagnostics", "json"]);
        let first: serde_json::Value =
            serde_json::from_str(said.err.lines().next().unwrap()).unwrap();
        [&first["source"]["line"], &first["source"]["column"], &first["source"]["end_column"]]
            .map(|v| v.as_u64().unwrap())
    };
    assert_eq!((place("lf"), place("lf")[0]), (place("crlf"), 3));
}
