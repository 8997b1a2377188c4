//! Machine-readable output: SARIF, workflow commands, `JUnit`, and the recipes for build servers.

use crate::kit::Folder;
use kontur::Exit;
use serde_json::Value;

#[test]
fn sarif_names_rule_place_and_level() {
    let f = Folder::new();
    let (exit, out, err) = f.call(&["check", "@bad.nc", "@corner.nc", "--format", "sarif"]);
    assert_eq!((exit, err.as_str()), (Exit::Aborted, ""));
    let log: Value = serde_json::from_str(&out).unwrap();
    assert_eq!(log["version"], "2.1.0");
    let run = &log["runs"][0];
    let result = &run["results"][0];
    assert_eq!((&result["ruleId"], &result["level"]), (&"20131".into(), &"error".into()));
    let rule = &run["tool"]["driver"]["rules"][result["ruleIndex"].as_u64().unwrap() as usize];
    assert_eq!(rule["id"], result["ruleId"]);
    let place = &result["locations"][0]["physicalLocation"];
    assert!(place["artifactLocation"]["uri"].as_str().unwrap().ends_with("/bad.nc"));
    let region = serde_json::json!({ "startLine": 6, "startColumn": 5, "endColumn": 9 });
    assert_eq!(place["region"], region);
    // a check without findings is a log without results
    let (exit, out, _) = f.call(&["check", "@corner.nc", "--format", "sarif"]);
    let log: Value = serde_json::from_str(&out).unwrap();
    assert_eq!((exit, &log["runs"][0]["results"]), (Exit::Finished, &Value::Array(Vec::new())));
}

#[test]
fn workflow_commands_name_the_line() {
    let f = Folder::new();
    let (exit, out, _) = f.call(&["check", "@bad.nc", "--format", "github"]);
    assert_eq!(exit, Exit::Aborted);
    let line = out.lines().next().unwrap();
    assert!(
        line.starts_with("::error file=")
            && line.contains("bad.nc,line=6,col=5,endColumn=9,title=20131::"),
        "{out}"
    );
    f.call(&["run", "@corner.nc", "-o", "@corner.csv"]);
    let (exit, out, _) = f.call(&["diff", "@corner.csv", "@slow.nc", "--format", "github"]);
    assert_eq!(exit, Exit::Aborted);
    let line =
        out.lines().find(|l| l.contains("title=X_set_mm")).unwrap_or_else(|| panic!("{out}"));
    assert!(line.starts_with("::error file=") && line.contains("slow.nc,line="), "{line}");
    assert!(out.lines().all(|l| l.starts_with("::error ")), "{out}");
    assert_eq!(f.call(&["diff", "@corner.csv", "@corner.nc", "--format", "github"]).1, "");
}

/// As many test cases as columns, plus two for the whole; those that fail are the columns that the JSON output names.
#[test]
fn junit_has_a_case_for_each_signal() {
    let f = Folder::new();
    f.call(&["run", "@corner.nc", "-o", "@corner.csv"]);
    let (exit, xml, _) = f.call(&["diff", "@corner.csv", "@slow.nc", "--format", "junit"]);
    assert_eq!(exit, Exit::Aborted);
    let (_, json, _) = f.call(&["diff", "@corner.csv", "@slow.nc", "--format", "json"]);
    let result = &serde_json::from_str::<Value>(&json).unwrap()["result"];
    let columns = f.read("corner.csv").lines().next().unwrap().split(',').count();
    let failed = result["columns"].as_array().unwrap().len() + 1; // the number of rows
    let report = quick_junit::Report::deserialize_from_str(&xml).unwrap();
    let suite = &report.test_suites[0];
    assert_eq!((suite.tests, suite.failures), (columns + 2, failed), "{xml}");
    // only the attributes defined for it in Jenkins' junit-10.xsd
    let whole = xml.split("<testsuites ").nth(1).unwrap().split('>').next().unwrap();
    let names: Vec<&str> =
        whole.split('"').step_by(2).map(|s| s.trim_matches([' ', '='])).collect();
    let known = ["name", "time", "tests", "failures", "errors", ""];
    assert!(names.iter().all(|name| known.contains(name)), "{whole}");
    let (exit, xml, _) = f.call(&["diff", "@corner.csv", "@corner.nc", "--format", "junit"]);
    let report = quick_junit::Report::deserialize_from_str(&xml).unwrap();
    let suite = &report.test_suites[0];
    assert_eq!((exit, suite.tests, suite.failures), (Exit::Finished, columns + 2, 0));
}

/// A recording of a machine gives the same formats.
#[test]
fn a_recording_has_a_verdict_too() {
    let f = Folder::new();
    f.call(&["run", "@corner.nc", "-o", "@rec.csv", "--signals", "X_set_mm,Y_set_mm"]);
    let words =
        ["diff", "@corner.nc", "@rec.csv", "--map", "X_set_mm=X_set_mm", "--format", "junit"];
    let (exit, xml, err) = f.call(&words);
    assert_eq!(exit, Exit::Finished, "{xml}{err}");
    let report = quick_junit::Report::deserialize_from_str(&xml).unwrap();
    assert_eq!((report.test_suites[0].tests, report.test_suites[0].failures), (1, 0));
    // without times the sampling rate must be given
    std::fs::write(f.path("rec.csv"), f.read("rec.csv").replace("t_s,", "Zeit,")).unwrap();
    assert_eq!(f.call(&words).0, Exit::Usage);
    assert_eq!(f.call(&[&words[..], &["--rate", "1000"]].concat()).0, Exit::Finished);
    assert_eq!(f.call(&[&words[..], &["--rate", "900"]].concat()).0, Exit::Aborted);
    std::fs::write(f.path("rec.csv"), f.read("rec.csv").replace("Zeit,", "t_s,")).unwrap();
    let (exit, out, _) = f.line("diff @slow.nc @rec.csv --map Y_set_mm=Y_set_mm --format github");
    assert_eq!(exit, Exit::Aborted);
    assert!(out.starts_with("::error file=") && out.contains("slow.nc,line="), "{out}");
}

/// The scripts of the recipes, with the binary in the search path: they succeed, and fail when a program has an error or its
/// setpoints have changed.
#[test]
#[cfg(unix)]
fn the_recipes_for_build_servers_work() {
    use std::path::Path;
    use std::process::{Command, Stdio};

    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let binary = Path::new(env!("CARGO_BIN_EXE_kontur")).parent().unwrap();
    let path = format!("{}:{}", binary.display(), std::env::var("PATH").unwrap());
    for (name, key) in [("github.yml", "        run: "), ("gitlab.yml", "    - ")] {
        let recipe = std::fs::read_to_string(here.join("../docs/ci").join(name)).unwrap();
        let scripts = scripts(&recipe, key);
        assert_eq!(scripts.len(), 3, "{scripts:?}");
        // the package of this name in the registry is another project
        assert!(scripts[0].starts_with("cargo install --locked --git "), "{scripts:?}");
        let f = Folder::new();
        for folder in ["nc", "expected", "machine"] {
            std::fs::create_dir(f.path(folder)).unwrap();
        }
        for list in std::fs::read_dir(here.join("../../programs/machines/xyz")).unwrap() {
            let list = list.unwrap().path();
            std::fs::copy(&list, f.path("machine").join(list.file_name().unwrap())).unwrap();
        }
        let run = || -> bool {
            let uses = |script: &&String| !script.starts_with("cargo install");
            scripts.iter().filter(uses).all(|script| {
                let mut shell = Command::new("sh");
                shell.args(["-e", "-c", script]).current_dir(f.path(".")).env("PATH", &path);
                shell.stdout(Stdio::null()).stderr(Stdio::null()).status().unwrap().success()
            })
        };
        let part = "N10 G01 X10 F3000\nN20 Y5\nN30 M30\n";
        std::fs::write(f.path("nc/part.nc"), part).unwrap();
        f.call(&["run", "@nc/part.nc", "-m", "@machine", "-o", "@expected/part.csv"]);
        assert!(run(), "{name}: nothing has changed");
        std::fs::write(f.path("nc/part.nc"), part.replace("F3000", "F2900")).unwrap();
        assert!(!run(), "{name}: another feed");
        std::fs::write(f.path("nc/part.nc"), part).unwrap();
        std::fs::write(f.path("nc/other.nc"), "#VIB GUARD ON (MODE=2)\nM30\n").unwrap();
        assert!(!run(), "{name}: a warning");
    }
}

/// The value of a key of a recipe: the rest of the line, or the block below it.
#[cfg(unix)]
fn scripts(recipe: &str, key: &str) -> Vec<String> {
    let mut found: Vec<String> = Vec::new();
    let mut is_block = false;
    for line in recipe.lines() {
        if let Some(script) = line.strip_prefix(key) {
            is_block = script == "|";
            found.push(if is_block { String::new() } else { script.to_owned() });
        } else if is_block && line.starts_with(&" ".repeat(key.len() - key.trim_start().len() + 2))
        {
            found.last_mut().unwrap().extend([line.trim(), "\n"]);
        } else {
            is_block = false;
        }
    }
    found
}
