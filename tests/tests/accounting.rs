//! Where a run was and where its time went: files of subroutines, dwells, rapid blocks, declared durations of technology functions.

mod sweeps;

use kontur::Exit;
use kontur_tests::command::{Folder, near, set};
use serde_json::Value;

/// No words.
const NONE: [&str; 0] = [];

const PART: &str = "N10 G01 X10 F6000\nN20 L corner.nc\nN30 X0 Y0\nM30\n";
/// Its corner is the point of the largest deviation of the guard from the contour.
const CORNER: &str = "(a corner)\n\nN10 G01 Y10\nN20 X20\nN30 M17\n";

/// Every row, and every place in the summary, names the file that is open there.
#[test]
fn places_in_subroutines_name_their_file() {
    let guarded = format!("#VIB GUARD ON [MODE=1 FREQ=20]\n{PART}");
    let folder = Folder::new(&[("part.nc", &guarded), ("corner.nc", CORNER)]);
    let (part, corner) = (folder.path("part.nc"), folder.path("corner.nc"));
    let summary = folder.summary(&["-o", "@a.csv"]);
    let table = folder.table("a.csv");
    let mut moved: Vec<_> = table.texts("file").into_iter().zip(table.texts("line")).collect();
    moved.dedup();
    for w in [(&*part, "2"), (&corner, "3"), (&corner, "4"), (&part, "4")] {
        assert!(moved.contains(&w), "{w:?}: {moved:?}");
    }
    assert!(!moved.contains(&(&*part, "3")), "line 3 of the program calls and does not move");
    let worst = &summary["max_contour_error"];
    assert_eq!(worst["file"], corner.as_str(), "{worst}");
    let text = folder.call(&["run", "@part.nc"]).out;
    assert!(text.contains(&format!(" of {corner}\n")), "{text}");
    // Parquet and a comparison of the two forms give it too
    let again = folder.call(&["diff", "@a.csv", "@part.nc"]);
    assert_eq!(again.exit, Exit::Finished, "{}{}", again.out, again.err);
}

/// A subroutine that only the run on the machine opens has its name as well.
#[test]
fn a_file_that_the_check_did_not_see() {
    // the check assumes every axis to be at its set position; on the machine they lag by some micrometres
    let text = "G01 X10 F6000\n$IF V.A.ACT_POS.X < 10\nL late.nc\n$ENDIF\nG01 X0\nM30\n";
    let folder = Folder::new(&[("part.nc", text), ("late.nc", "G60 G01 Y5\nM17\n")]);
    let summary = folder.summary(&["-o", "@a.csv"]);
    assert!(folder.read("a.csv").contains("late.nc"));
    let stops = summary["stops"].to_string();
    assert!(stops.contains("late.nc"), "{stops}");
    assert!(!stops.contains("\"file\":\"\""), "{stops}");
}

/// Path / feed, also where curves and splines shorten the path, and wherever a run is stopped.
#[test]
fn the_ideal_time_is_that_of_the_path() {
    let corners = "G01 X10 F600\nY10\nX0\nY0";
    for text in [
        format!("{corners}\nM30\n"),
        format!("#CONTOUR MODE [DIST PRE_DIST=4 POST_DIST=4]\nG261\n{corners}\nG260\nM30\n"),
        format!("#HSC ON [BSPLINE PATH_DEV=0.5]\n{corners}\n#HSC OFF\n{corners}\nM30\n"),
        format!("G02 X5 Y5 R5 F600\n{corners}\nM30\n"),
    ] {
        for limit in ["0.7", "1.234", "2.9", "100"] {
            let folder = Folder::new(&[("part.nc", &text)]);
            let done = folder.call(&["run", "@part.nc", "--summary", "json", "--max-time", limit]);
            let summary: Value = serde_json::from_str(&done.out).unwrap();
            let path_mm = summary["path_length_mm"].as_f64().unwrap();
            near(&summary["ideal_duration_s"], path_mm / 10.0, 1e-6);
        }
    }
}

/// The program waits for the position controllers only after the last motion of any axis or spindle; until then it
/// waits for that motion, which a feedhold can hold.
#[test]
fn arrival_begins_after_the_last_motion() {
    let summary = |text: &str| Folder::new(&[("part.nc", text)]).summary(&NONE);
    let alone = summary("G01 Y10 F600\nM30\n")["arrival_s"].as_f64().unwrap();
    let axis = "Y[INDP_ASYN G90 G01 FEED=600 POS=10]\nG01 X1 F3000\nM30\n";
    near(&summary(axis)["arrival_s"], alone, 2e-3);
    let spindle = "S[M19 POS=90 REV100]\nG01 X1 F600\nM30\n";
    assert!(summary(spindle)["arrival_s"].as_f64().unwrap() < alone + 2e-3);
    let folder = Folder::new(&[("part.nc", axis), ("hold.csv", "t_s,feedhold\n0.3,1\n0.6,0\n")]);
    let held = folder.summary(&["--input", "@hold.csv"]);
    near(&held["arrival_s"], alone, 2e-3);
    // from the hold to the release, without the braking
    near(&held["held_s"], 0.3, 0.05);
}

/// G04 is a dwell, not a stop; the ideal time includes the rapid blocks: 60 m/min on `xyz`.
#[test]
fn dwells_and_rapids() {
    let text = "N10 G01 X10 F6000\nN20 G04 0.5\nN30 G00 X0 Y5\nN40 #TIME 0.25\nM30\n";
    let folder = Folder::new(&[("part.nc", text)]);
    let summary = folder.summary(&NONE);
    near(&summary["dwell_s"], 0.75, 2e-3);
    near(&summary["ideal_duration_s"], 0.1 + 10.0 / 1000.0, 1e-9);
    let text = folder.call(&["run", "@part.nc"]).out;
    assert!(text.contains("  dwells         0.75"), "{text}");
    let shares = text.lines().find(|l| l.contains("speed limited by")).unwrap();
    let share = |name: &str| -> f64 {
        let behind = shares.split(&format!(" {name} ")).nth(1).unwrap_or("0 %");
        behind.split(" %").next().unwrap().parse().unwrap()
    };
    let duration = summary["duration_s"].as_f64().unwrap();
    assert!((share("dwell") - 75.0 / duration).abs() < 0.2, "{shares}");
    let stop = summary["time_by_v_limit_s"]["stop"].as_f64().unwrap() - 0.75;
    assert!((share("stop") - 100.0 * stop / duration).abs() < 0.2, "{shares}");
    assert!(text.contains("contour error  none"), "{text}");
}

/// The vendor's example of the production time calculation: M07 takes 0.5 s, M08 1.3 s, M03 0.5 s.
const DECLARED: &str = "channel: m_prozess_zeit[7]=500000, m_prozess_zeit[8]=1300000, \
                        spindel[0].m3_prozess_zeit=500000, spindel[0].s_prozess_zeit=200000";

/// Summaries of `part.nc` with settings, without and with `--techno-times`; the trace of the latter is `a.csv`.
fn both(folder: &Folder, settings: &str) -> [Value; 2] {
    let words = set(settings);
    let on = ["--techno-times", "-o", "@a.csv"].map(str::to_owned);
    [folder.summary(&words), folder.summary(&[&words[..], &on].concat())]
}

/// With `--techno-times` the path waits for them, and the duration grows by exactly that time; without it the summary names them.
#[test]
fn declared_durations_are_waited_for() {
    // functions of one block go to the machine together: the longest duration counts; S belongs to M3 of its block
    let text = "M7\nM8\nM3 S600\nM7 M8\nH3\nS700\nT5\nG01 X1 F1000\nM30\n";
    let folder = Folder::new(&[("part.nc", text)]);
    assert!(folder.summary(&NONE)["not_counted"].as_array().unwrap().contains(&"M8".into()));
    let [off, on] =
        both(&folder, &format!("{DECLARED}, h_prozess_zeit[3]=250000, tool.prozess_zeit=750000"));
    near(&on["technology_s"], 0.5 + 1.3 + 0.5 + 1.3 + 0.25 + 0.2 + 0.75, 1e-9);
    near(&off["technology_s"], 0.0, 0.0);
    near(&on["duration_s"], off["duration_s"].as_f64().unwrap() + 4.8, 1e-9);
    assert_eq!(on["not_counted"].as_array().unwrap().len(), 0, "{on}");
    let named = off["not_counted"].to_string();
    for w in [
        "M7 (0.5 s each by P-CHAN-00040)",
        "M3 of S (0.5 s each by P-CHAN-00044)",
        "H3 (0.25 s each by P-CHAN-00026)",
        "tool change (T) (0.75 s each by P-CHAN-00072)",
        "S word of S (0.2 s",
    ] {
        assert!(named.contains(w), "{w}: {named}");
    }
}

/// M00, M01 and M30 take the durations that the list declares (M and H functions 15319587595: 0.8 s of M1).
#[test]
fn durations_of_stops_and_ends() {
    let folder = Folder::new(&[("part.nc", "N10 M1 X100 G01 F6000\nM0\nX0\nG04 0.5\nM30\n")]);
    let waits = "channel: m_synch[0]=0x2, m_synch[1]=0x2, m_synch[30]=0x2";
    let times = "m_prozess_zeit[0]=500000, m_prozess_zeit[1]=800000, m_prozess_zeit[30]=200000";
    let [off, on] = both(&folder, &format!("{waits}, {times}"));
    near(&on["technology_s"], 1.5, 1e-9);
    near(&on["duration_s"], off["duration_s"].as_f64().unwrap() + 1.5, 1e-9);
    let named = off["not_counted"].to_string();
    assert!(named.contains("M1 (0.8 s each by P-CHAN-00040)"), "{named}");
    let stops = ["M01 (until the operator continues)", "M00 (until the operator continues)"];
    assert_eq!(folder.summary(&NONE)["not_counted"], serde_json::json!(stops));
}

/// Where the path waits for M25 depends on its kind of synchronisation; N40 takes 0.75 s at its feed, so with MVS_SNS nothing is
/// left of 0.5 s and 0.45 s of 1.2 s. Source: TF5200 M and H functions 285997195, 286004619.
#[test]
fn kinds_of_synchronisation() {
    let text = "N20 G00 X25\nN30 X50\nN40 G01 F2000 X75 M25\nN50 X100\nM30\n";
    let folder = Folder::new(&[("part.nc", text)]);
    for (kind, us, wait_s, at) in [
        ("NO_SYNCH", 500_000, 0.0, ""),
        ("MOS", 500_000, 0.0, ""),
        ("MVS_SVS", 500_000, 0.5, "50.0000000"),
        ("MVS_SNS", 500_000, 0.0, ""),
        ("MVS_SNS", 1_200_000, 0.45, "75.0000000"),
        ("MNS_SNS", 500_000, 0.5, "75.0000000"),
    ] {
        let settings = format!("channel: m_synch[25]={kind}, m_prozess_zeit[25]={us}");
        let [off, summary] = both(&folder, &settings);
        near(&summary["technology_s"], wait_s, 1e-9);
        // without the option, the functions for which the control would wait are named
        let named = off["not_counted"].as_array().unwrap().len();
        assert_eq!(named, usize::from(!kind.ends_with("NO_SYNCH") && !kind.ends_with("MOS")));
        let table = folder.table("a.csv");
        let rows = table.numbers("v_mm_s").into_iter().zip(table.texts("X_ipo_mm"));
        let stood: Vec<&str> = rows.filter(|(v, _)| *v == 0.0).map(|(_, x)| x).collect();
        let rests = |at: &&str| stood.iter().filter(|x| *x == at).count() > 100;
        let rest = ["50.0000000", "75.0000000"].into_iter().find(rests).unwrap_or_default();
        assert_eq!(rest, at, "{kind} {us}");
    }
}

/// A function with a duration stops the path where it acts: M07 before its block, M05 after it. Its cycles belong to its block.
#[test]
fn functions_that_take_time_stop_the_path() {
    let text = "G01 X10 F6000\nX20 M7\nX30\nX40 M5\nX50\nM30\n";
    let folder = Folder::new(&[("part.nc", text)]);
    let [_, summary] = both(&folder, &format!("{DECLARED}, spindel[0].m5_prozess_zeit=250000"));
    near(&summary["technology_s"], 0.75, 1e-9);
    let table = folder.table("a.csv");
    let (lines, x, v) = (table.texts("line"), table.texts("X_ipo_mm"), table.numbers("v_mm_s"));
    let resting = |at: &str, of: &str| {
        (0..v.len()).filter(|k| v[*k] == 0.0 && x[*k] == at && lines[*k] == of).count()
    };
    assert_eq!(resting("10.0000000", "2"), 500);
    assert_eq!(resting("40.0000000", "4"), 251, "250, and the one in which it stops");
    let slowest = |at: f64| {
        let rows = table.numbers("X_ipo_mm").into_iter().zip(&v);
        rows.filter(|(x, _)| (x - at).abs() < 1.0).fold(f64::INFINITY, |low, (_, v)| low.min(*v))
    };
    assert!(slowest(20.0) > 99.0 && slowest(30.0) > 99.0);
}

/// With JSON messages every line of stderr is an object, for mistakes in files, lists and settings too.
#[test]
fn every_message_is_json_if_asked_for() {
    let folder =
        Folder::new(&[("part.nc", "G01 X1 F100\nFOO\nM30\n"), ("ok.nc", "G01 X1 F100\nM30\n")]);
    let vary = ["--vary", "*.vib_guard.freq=20,40", "--columns", "duration_s"];
    let cases: [Vec<&str>; 6] = [
        vec!["check", "@none.nc", "@part.nc"],
        vec!["run", "@part.nc"],
        vec!["run", "@ok.nc", "--set", "X.foo=1"],
        vec!["run", "@ok.nc", "--set", "X.getriebe[0].kv=a"],
        vec!["run", "@ok.nc", "-o", "/nowhere/a.csv"],
        [&["sweep", "@ok.nc"][..], &vary].concat(),
    ];
    for case in cases {
        let done = folder.call(&[&case[..], &["--diagnostics", "json"]].concat());
        assert!(!done.err.is_empty(), "{case:?}");
        for line in done.err.lines() {
            let object: Value =
                serde_json::from_str(line).unwrap_or_else(|e| panic!("{e}: {line}"));
            let severity = object["severity"].as_str().unwrap();
            assert!(["error", "warning", "note"].contains(&severity), "{line}");
            assert!(object["text"].as_str().is_some_and(|t| !t.is_empty()), "{line}");
        }
    }
}
