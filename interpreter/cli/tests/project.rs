//! A TwinCAT project as machine: the built-in machine packed into a project must give the same motion as from its folder.

mod parts;

use crate::kit::Folder;
use kontur::Exit;
use std::fmt::Write as _;
use std::fs;
use std::path::Path;

fn list(name: &str) -> String {
    let xyz = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../programs/machines/xyz");
    fs::read_to_string(xyz.join(name)).unwrap()
}

/// An axis as stored by the engineering tool; its list also contains the defaults.
fn axis(name: &str, list_of: &str, (channel, index): (u32, u32)) -> String {
    // the actual values come after the defaults and replace them
    let own = list(list_of);
    let is_own = |line: &&str| {
        let key = line.split_whitespace().next().unwrap_or("#");
        key.starts_with('#') || !own.lines().any(|l| l.split_whitespace().next() == Some(key))
    };
    let defaults: Vec<String> =
        list("axes.lis").lines().filter(is_own).map(str::to_owned).collect();
    format!(
        "<Axis Id=\"1\">\r\n<ItemName>{name}-Achse</ItemName>\r\n<AxisPara><DefaultChannel>{channel}</DefaultChannel>\r\n\
         <DefaultIndex>{index}</DefaultIndex><DefaultProgName>{name}</DefaultProgName></AxisPara>\r\n\
         <AchsMds><![CDATA[# {name}\r\n{}\r\n{own}Ende\r\nnot read]]></AchsMds></Axis>\r\n",
        defaults.join("\r\n"),
    )
}

fn channel(names: &str) -> String {
    format!(
        "<Channel><ItemName>Channel 1</ItemName><ChnPara><SdaMds><![CDATA[{names}]]></SdaMds>\
         <NullpD><![CDATA[# nothing]]></NullpD><VeD><![CDATA[anzahl_belegt 1]]></VeD><PzvD><![CDATA[pzv 1]]></PzvD></ChnPara></Channel>\n"
    )
}

const TASK: &str = "<Task Priority=\"2\" CycleTime=\"10000\"><Name>CNC-Task GEO</Name></Task>\n\
                    <Task CycleTime=\"200000\"><Name>PlcTask</Name></Task>\n";

fn project(inside: &str) -> String {
    format!(
        "\u{feff}<?xml version=\"1.0\"?>\n<TcSmProject>\n<Project><Motion><CNC>\n{inside}</CNC></Motion></Project>\n</TcSmProject>\n"
    )
}

/// A project with all axes and the channel of the built-in machine.
fn whole() -> String {
    project(&format!("{TASK}{}{}", all_axes(), channel(&list("channel.lis"))))
}

/// Writes the project of a folder.
fn put(folder: &Folder, text: impl AsRef<[u8]>) {
    fs::write(folder.path("machine.tsproj"), text).unwrap();
}

/// A folder with a program and `kontur.lis` of the built-in machine without its cycle.
fn folder() -> Folder {
    let folder = Folder::new();
    let write = |name: &str, text: &str| fs::write(folder.path(name), text).unwrap();
    write("part.nc", "G01 X10 Y5 F6000\nS100 M3\nG00 Z20\nG02 X20 Y5 I5 J0 F3000\nM5\nM30\n");
    let own = list("kontur.lis");
    let own: Vec<&str> = own.lines().filter(|l| !l.contains("cycle_time")).collect();
    write("kontur.lis", &(own.join("\n") + "\n"));
    folder
}

fn all_axes() -> String {
    ["X", "Y", "Z"]
        .iter()
        .zip(0..)
        .map(|(name, i)| axis(name, &format!("{}.lis", name.to_lowercase()), (1, i)))
        .chain([axis("", "s.lis", (1, 3))])
        .collect()
}

/// Exit code, trace and messages of the program on a machine.
fn run(folder: &Folder, machine: &str) -> (Exit, String, String) {
    let machine = format!("@{machine}");
    let words = ["run", "@part.nc", "-m", &machine, "-o", "@out.csv", "--summary", "none"];
    let (exit, _, said) = folder.call(&words);
    let trace = if exit == Exit::Finished { folder.read("out.csv") } else { String::new() };
    (exit, trace, said)
}

/// Trace and messages of a run that finishes.
fn finishes(folder: &Folder, machine: &str) -> (String, String) {
    let (exit, trace, said) = run(folder, machine);
    assert_eq!(exit, Exit::Finished, "{said}");
    (trace, said)
}

/// Messages of a machine that is refused.
fn refused(folder: &Folder, machine: &str) -> String {
    let (exit, _, said) = run(folder, machine);
    assert_eq!(exit, Exit::Usage, "{said}");
    said
}

fn expected() -> String {
    let folder = folder();
    let xyz = folder.path("xyz");
    fs::create_dir(&xyz).unwrap();
    for name in ["hochlauf", "channel", "axes", "x", "y", "z", "s", "kontur"] {
        let name = format!("{name}.lis");
        fs::write(xyz.join(&name), list(&name)).unwrap();
    }
    let (trace, said) = finishes(&folder, "xyz");
    assert_eq!(said, "");
    trace
}

/// The item of an axis or channel in a separate file.
fn item(inside: &str) -> String {
    format!("<TcSmItem>{inside}</TcSmItem>")
}

#[test]
fn a_project_moves_as_its_lists_do() {
    let folder = folder();
    put(&folder, whole());
    let expected = expected();
    // by name, and as the only project of its folder
    for machine in ["machine.tsproj", "."] {
        let (trace, said) = finishes(&folder, machine);
        assert_eq!(trace, expected);
        assert!(
            said.contains("K-0140") && said.contains("cycle 1000 us of the GEO task"),
            "{said}"
        );
        assert!(said.contains("X (1), Y (2), Z (3)") && said.contains("not read: PzvD"), "{said}");
        assert!(said.contains("and the spindles S (4)"), "{said}");
    }
}

#[test]
fn parts_in_files_of_their_own_and_exported_items_too() {
    let expected = expected();
    let folder = folder();
    let parts = folder.path("_Config/CNC/Axes");
    fs::create_dir_all(&parts).unwrap();
    for (name, i) in ["X", "Y", "Z"].iter().zip(0..) {
        let text = item(&axis(name, &format!("{}.lis", name.to_lowercase()), (1, i)));
        fs::write(parts.join(format!("Axis {}.xti", i + 9)), text).unwrap();
    }
    fs::write(parts.join("Axis 12.xti"), item(&axis("", "s.lis", (1, 3)))).unwrap();
    fs::write(parts.join("../Channel.xti"), item(&channel(&list("channel.lis")))).unwrap();
    put(&folder, project(TASK));
    let (trace, _) = finishes(&folder, "machine.tsproj");
    assert_eq!(trace, expected);

    // only the items, exported into a folder; without the project the cycle is unknown
    fs::remove_file(folder.path("machine.tsproj")).unwrap();
    let (trace, said) = finishes(&folder, "_Config");
    assert!(said.contains("no GEO task with a cycle"), "{said}");
    assert!(said.contains("warning[K-0140]") && said.contains("1000 us is assumed"), "{said}");
    // kontur.lis is not in that folder: different drives, the same setpoints
    let column = |text: &str, name: &str| -> Vec<String> {
        let at = text.lines().next().unwrap().split(',').position(|c| c == name).unwrap();
        text.lines().map(|l| l.split(',').nth(at).unwrap_or_default().to_owned()).collect()
    };
    let head = |text: &str, name: &str| column(text, name)[..200].to_vec();
    assert_eq!(head(&trace, "X_set_mm"), head(&expected, "X_set_mm"));
}

#[test]
fn prototypes_are_numbered_and_dialogs_name_the_axes() {
    let folder = folder();
    // every list has number 1, the channel has other names: like a configuration that was never activated
    let axes = all_axes();
    let mut same = String::new();
    for line in axes.split("\r\n") {
        let line = if line.starts_with("kopf.achs_nr") { "kopf.achs_nr 1" } else { line };
        // lists of this repository end their lines with LF only
        for part in line.split('\n') {
            let part = if part.starts_with("kopf.achs_nr") { "kopf.achs_nr 1" } else { part };
            writeln!(same, "{part}").unwrap();
        }
    }
    let other = list("channel.lis").replace("bezeichnung     X", "bezeichnung     X1");
    let inside = format!("{TASK}{same}{}", channel(&other));
    put(&folder, project(&inside));
    let (trace, said) = finishes(&folder, "machine.tsproj");
    assert!(said.contains("numbered in their order"), "{said}");
    assert!(
        said.contains("the list of the channel says X1 (1), Y (2), Z (3): the dialogs count"),
        "{said}"
    );
    assert_eq!(trace, expected());
}

#[test]
fn mistakes_are_named_at_their_line_of_the_project() {
    let folder = folder();
    let wrong = whole().replacen(
        "getriebe[0].kv                         5000",
        "getriebe[0].kv                         fast",
        1,
    );
    let line = wrong.lines().position(|l| l.contains("                         fast")).unwrap() + 1;
    put(&folder, wrong);
    let (_, _, said) = run(&folder, "machine.tsproj");
    assert!(
        said.contains("1001138") && said.contains(&format!("machine.tsproj#X-Achse:{line}:")),
        "{line}: {said}"
    );

    put(&folder, whole().replacen("</Axis>", "", 1));
    let said = refused(&folder, "machine.tsproj");
    assert!(said.contains("K-0141") && said.contains("no XML"), "{said}");

    put(&folder, project(TASK));
    let said = refused(&folder, "machine.tsproj");
    assert!(
        said.contains("K-0141") && said.contains("not contain the axis list (AchsMds)"),
        "{said}"
    );

    fs::write(folder.path("other.tsproj"), whole()).unwrap();
    let said = refused(&folder, ".");
    assert!(said.contains("several projects"), "{said}");
}

/// A project is an input like a list: outputs must not replace it; its path may be written in any form.
#[test]
fn a_project_is_not_overwritten() {
    let folder = folder();
    let whole = whole();
    put(&folder, &whole);
    fs::hard_link(folder.path("machine.tsproj"), folder.path("trace.csv")).unwrap();
    let words = ["run", "@part.nc", "-m", "@machine.tsproj", "-o", "@trace.csv"];
    let (exit, _, said) = folder.call(&words);
    assert_eq!(exit, Exit::Usage, "{said}");
    assert_eq!(folder.read("machine.tsproj"), whole);

    let machine = folder.path("").display().to_string() + "//machine.tsproj";
    let (exit, _, said) =
        folder.call(&["run", "@part.nc", "-m", &machine, "-o", "@out.csv", "--summary", "none"]);
    assert_eq!(exit, Exit::Finished, "{said}");
    assert_eq!(folder.read("out.csv"), expected());
}

#[test]
fn hostile_xml_ends_in_a_message() {
    let folder = folder();
    let deep = format!("{}{}", "<a>".repeat(200_000), "</a>".repeat(200_000));
    let laughs = "<!DOCTYPE l [<!ENTITY a \"ha\"><!ENTITY b \"&a;&a;\">]><l>&b;</l>".to_owned();
    let many = format!("<P>{}</P>", "<SdaMds>x 1</SdaMds>".repeat(5_000));
    let axes = format!("<P>{}</P>", "<AchsMds>kopf.achs_nr 1</AchsMds>".repeat(40));
    for text in [deep, laughs, many, axes, String::new()] {
        put(&folder, text);
        let said = refused(&folder, "machine.tsproj");
        assert!(said.contains("K-0141"), "{said}");
    }
}

/// The cycle of the GEO task is added to a `kontur.lis` with an end mark, is overridden by a key in upper or lower case, and is
/// not truncated.
#[test]
fn the_cycle_of_the_task() {
    let folder = folder();
    let own = fs::read_to_string(folder.path("kontur.lis")).unwrap();
    let inside = |units: &str| {
        let task = TASK.replace("10000", units);
        project(&format!("{task}{}{}", all_axes(), channel(&list("channel.lis"))))
    };
    // time of the second cycle
    let step = |trace: &str| {
        let row = trace.lines().nth(2).unwrap();
        row.split(',').next().unwrap().parse::<f64>().unwrap()
    };
    for (units, own, want_s, words) in [
        ("20000", format!("{own}\nEnde\n"), 0.002, "cycle 2000 us of the GEO task"),
        ("20000", format!("{own}\nKONTUR.Cycle_Time_us 500\n"), 0.0005, "replaced by that of"),
        ("3333", own.clone(), 0.001, "333.3 us of the GEO task is not a whole number"),
    ] {
        fs::write(folder.path("kontur.lis"), own).unwrap();
        put(&folder, inside(units));
        let (trace, said) = finishes(&folder, "machine.tsproj");
        assert!((step(&trace) - want_s).abs() < 1e-9, "{units}: {}", step(&trace));
        assert!(said.contains(words) && !said.contains("kontur.lis:"), "{said}");
    }
}

/// A run that uses an unspecified cycle warns; with a specified cycle it does not.
#[test]
fn a_cycle_that_is_assumed_is_a_warning() {
    let folder = folder();
    let own = fs::read_to_string(folder.path("kontur.lis")).unwrap();
    let with = |task: &str| {
        let inside = format!("{task}{}{}", all_axes(), channel(&list("channel.lis")));
        put(&folder, project(&inside));
    };
    let said = |more: &[&str]| {
        let words = ["check", "@part.nc", "-m", "@machine.tsproj", "--deny", "warnings"];
        let (exit, _, said) = folder.call(&[&words, more].concat());
        (exit == Exit::Finished, said)
    };
    for task in [TASK.replace("10000", "12345"), TASK.replace("GEO", "XYZ")] {
        with(&task);
        let (passed, text) = said(&[]);
        assert!(!passed && text.contains("warning[K-0140]"), "{text}");
        assert!(text.contains("1000 us is assumed"), "{text}");
        for more in [&["--cycle-us", "1000"][..], &["--set", "Kontur.cycle_time_us=2000"]] {
            let (passed, text) = said(more);
            assert!(passed && !text.contains("assumed"), "{text}");
        }
        // from a list with the line ends of an old Mac, and in capital letters
        fs::write(
            folder.path("KONTUR.LIS"),
            format!("{own}kontur.cycle_time_us 2000\nEnde\n").replace('\n', "\r"),
        )
        .unwrap();
        fs::remove_file(folder.path("kontur.lis")).unwrap();
        let (passed, text) = said(&[]);
        assert!(passed && !text.contains("assumed"), "{text}");
        fs::remove_file(folder.path("KONTUR.LIS")).unwrap();
        fs::write(folder.path("kontur.lis"), &own).unwrap();
    }
    with(TASK);
    let (passed, text) = said(&[]);
    assert!(passed && !text.contains("assumed"), "{text}");
}

/// The folder of a solution with its project in a subfolder.
#[test]
fn a_solution_has_its_project_below() {
    let folder = folder();
    fs::create_dir_all(folder.path("solution/Project")).unwrap();
    fs::write(folder.path("solution/Project/machine.tsproj"), whole()).unwrap();
    fs::copy(folder.path("kontur.lis"), folder.path("solution/Project/kontur.lis")).unwrap();
    let (exit, trace, said) = run(&folder, "solution");
    assert_eq!((exit, trace), (Exit::Finished, expected()), "{said}");
}
