//! Programs made to break an interpreter: each of them ends, and with its diagnostic, on the command line.

use kontur::Exit;
use kontur_tests::command::Folder;

/// Exit code, IDs with line and column, and the output of `run` on stdout.
fn call(verb: &str, text: &str, options: &[&str]) -> (Exit, Vec<String>, String) {
    let folder = Folder::new(&[("part.nc", text)]);
    let output = folder.call(&[&[verb, "@part.nc", "--diagnostics", "json"], options].concat());
    let said = output.err.lines().filter(|l| l.starts_with('{')).filter_map(|line| {
        let json: serde_json::Value = serde_json::from_str(line).unwrap();
        let id = json["id"].as_u64().map(|id| id.to_string());
        // messages of the command itself have no ID
        let id = id.or_else(|| json["kontur_id"].as_str().map(str::to_owned))?;
        Some(format!("{id} {}:{}", json["source"]["line"], json["source"]["column"]))
    });
    let said = said.collect();
    (output.exit, said, output.out)
}

/// The messages of `check` and `run`, which must be the same; both must refuse the program.
fn refused(text: &str, options: &[&str]) -> Vec<String> {
    let (exit, checked, _) = call("check", text, options);
    assert_eq!(exit, Exit::Aborted, "{checked:?}");
    let (exit, run, _) = call("run", text, options);
    assert_eq!((exit, &run), (Exit::Aborted, &checked));
    checked
}

/// A program without an end starts, runs to its limit, and leaves a trace and a summary that are complete up to there.
#[test]
fn limits_stop_a_program_and_do_not_refuse_it() {
    let endless = "F6000\n$WHILE 1\nG01 X10\nX0\n$ENDWHILE\nM30\n";
    for (options, limit) in [(["--max-time", "2.5"], 2.5), (["--max-blocks", "100"], f64::MAX)] {
        let folder = Folder::new(&[("a.nc", endless)]);
        let words = ["run", "@a.nc", "-o", "@a.csv", "--summary", "json"];
        let output = folder.call(&[&words[..], &options].concat());
        assert_eq!(output.exit, Exit::Aborted, "{}", output.err);
        assert_eq!(output.err.matches("error[K-0017]").count(), 1, "{}", output.err);
        let summary: serde_json::Value = serde_json::from_str(&output.out).unwrap();
        assert_eq!(summary["state"], "aborted");
        let rows = folder.read("a.csv").lines().count() - 1;
        assert_eq!(summary["cycles"], rows);
        let duration = summary["duration_s"].as_f64().unwrap();
        assert!(duration > 2.0 && duration <= limit, "{options:?}: {duration}");
        // one of 100 blocks is F, and every pass has $WHILE, two motions of 10 mm and $ENDWHILE
        let path = summary["path_length_mm"].as_f64().unwrap();
        // at 100 mm/s, and not for the blocks that the look-ahead has already taken from the program
        let ideal = summary["ideal_duration_s"].as_f64().unwrap();
        assert!((ideal - path / 100.0).abs() < 1e-3, "{options:?}: {ideal} s for {path} mm");
        let blocks = summary["blocks"].as_f64().unwrap();
        assert!((blocks - 4.0 * path / 20.0).abs() < 6.0, "{options:?}: {blocks} for {path} mm");
        assert!(limit < 3.0 || (480.0..=500.0).contains(&path), "{options:?}: {path}");
        let (exit, said, _) = call("check", endless, &options);
        let is_error = exit == Exit::Aborted;
        assert!(said.len() == 1 && said[0].starts_with("K-0017 "), "{said:?}");
        assert_eq!(is_error, options[0] == "--max-blocks");
    }
    // an error that the check finds before the limit still refuses the program
    refused("F6000\nG7\n$WHILE 1\nG01 X10\nX0\n$ENDWHILE\nM30\n", &["--max-time", "1"]);
    // and one beyond it ends the run where it is met
    let behind = "F6000\nP1=0\n$WHILE P1<9000\nG01 X10\nX0\nP1=P1+1\n$ENDWHILE\nG7\nM30\n";
    let (exit, said, out) = call("run", behind, &["--max-time", "1"]);
    assert_eq!((exit, said.len()), (Exit::Aborted, 1), "{said:?} {out}");
    assert!(said[0].starts_with("K-0017 ") && out.contains("aborted"), "{said:?} {out}");
}

/// Motions of 100 s each in lines 2 to 4: a check names the one in which its time runs out, the last one too.
#[test]
fn a_check_counts_every_motion() {
    let text = "%P\nG01 F60 X100\nX0\nX100\nM30\n";
    for limit_s in [5, 99, 101, 150, 199, 201, 299, 301, 1000] {
        let (exit, said, _) = call("check", text, &["--max-time", &limit_s.to_string()]);
        let line = 2 + limit_s / 100;
        let expected = if limit_s < 300 { vec![format!("K-0017 {line}:1")] } else { Vec::new() };
        assert_eq!((exit, said), (Exit::Finished, expected), "{limit_s}");
    }
    // the run ends with its own error, and the warning of its check is not repeated
    let (exit, said, _) = call("run", text, &["--max-time", "250"]);
    assert_eq!((exit, said), (Exit::Aborted, vec!["K-0017 4:1".to_owned()]));
}

#[test]
fn macros_that_explode() {
    // the text doubles with each step and is cut where blocks end
    let doubling: String =
        (0..15).map(|i| format!("\"M{}\" = \"\\\"M{i}\\\" \\\"M{i}\\\"\"\n", i + 1)).collect();
    let said = refused(&format!("\"M0\" = \"F1\"\n{doubling}\"M15\"\nM30\n"), &[]);
    assert!(said[0].starts_with("20301 17:"), "{said:?}");
}

#[test]
fn deep_brackets() {
    let nested = |n: usize| format!("X{}1{} F1000\nM30\n", "[".repeat(n), "]".repeat(n));
    assert_eq!(refused(&nested(10_000), &[]), ["20301 1:4097"]);
    assert_eq!(refused(&nested(1000), &[]), ["20386 1:66"]);
    for open in
        ["X[", "P1=SIN[", "#VIB GUARD ON [", "L CYCLE [", "G80 [", "S[", "#VAR\nV.P.A[", "("]
    {
        let text = format!("{}\nM30\n", open.repeat(10_000 / open.len()));
        let (_, said, _) = call("check", &text, &[]);
        assert!(said.len() < 25, "{open}: {said:?}");
    }
}

/// An expression as long as a block may be is computed; with more operators, or beyond that length, there is an ID for it.
#[test]
fn long_expressions() {
    let line = |length: usize| {
        let mut line = "X0.1".to_owned();
        while line.len() + 20 <= length - 6 {
            line.push_str("+0.10000000000000000");
        }
        line.push_str(&" ".repeat(length - 6 - line.len()));
        line + " F1000"
    };
    for (length, expected) in [(4000, None), (4096, Some("20301 1:4001"))] {
        let (exit, said, summary) =
            call("run", &format!("{}\nM30\n", line(length)), &["--summary", "json"]);
        assert_eq!(exit, Exit::Finished, "{said:?}");
        let found: Option<&str> = said.first().map(String::as_str);
        assert_eq!((found, said.len()), (expected, usize::from(expected.is_some())));
        let summary: serde_json::Value = serde_json::from_str(&summary).unwrap();
        let tenths = line(length).matches("0.1").count();
        let way = summary["path_length_mm"].as_f64().unwrap();
        assert!((way - tenths as f64 / 10.0).abs() < 1e-9, "{way}, {tenths} tenths");
    }
    assert_eq!(refused(&format!("{}\nM30\n", line(4098)), &[]), ["20301 1:4097"]);
    // for the evaluation a chain of operators is a nesting
    let said = refused(&format!("P1=1{}\nM30\n", "+1".repeat(1990)), &[]);
    assert!(said[0].starts_with("K-0006 1:"), "{said:?}");
}

/// Messages from a loop without motion are not kept until the program moves.
#[test]
fn messages_without_motion_fill_no_memory() {
    let text = "P1=0\n$WHILE P1<30000\n#MSG [\"x\"]\nP1=P1+1\n$ENDWHILE\nM30\n";
    let (exit, said, _) = call("run", text, &[]);
    assert_eq!((exit, said.len()), (Exit::Finished, 10_001), "and one that counts the others");
}
