//! Parts of a project: channels, lists and names of axes.

use super::*;

/// The number of a channel determines which one is first, not the position of its file or element.
#[test]
fn the_first_channel_is_that_with_the_smallest_number() {
    let folder = folder();
    let expected = expected();
    let of =
        |id: u32, list: &str| channel(list).replace("<Channel>", &format!("<Channel Id=\"{id}\">"));
    let first = list("channel.lis");
    // steps of acceleration instead of ramps: another trace
    let second =
        first.replace("prog_start.slope.profile           1", "prog_start.slope.profile 0");
    assert_ne!(first, second);
    let inside = format!("{TASK}{}{}{}", all_axes(), of(2, &second), of(1, &first));
    put(&folder, project(&inside));
    let (exit, trace, said) = run(&folder, "machine.tsproj");
    assert_eq!((exit, &trace), (Exit::Finished, &expected), "{said}");
    assert!(said.contains("one channel is simulated") && !said.contains("kanal_anzahl"), "{said}");
    // the same with separate files: Aux.xti is first by name
    fs::create_dir_all(folder.path("_Config")).unwrap();
    fs::write(folder.path("_Config/Aux.xti"), item(&channel(&second))).unwrap();
    fs::write(folder.path("_Config/Main.xti"), item(&channel(&first))).unwrap();
    let named = "<Channel File=\"Main.xti\" Id=\"1\"/><Channel File=\"Aux.xti\" Id=\"2\"/>";
    put(&folder, project(&format!("{TASK}{}{named}", all_axes())));
    let (exit, trace, said) = run(&folder, "machine.tsproj");
    assert_eq!((exit, &trace), (Exit::Finished, &expected), "{said}");
}

/// Files that the project does not reference and disabled items are not axes; they are reported.
#[test]
fn what_does_not_belong_to_the_project_is_left_out() {
    let folder = folder();
    let expected = expected();
    let x = axis("X", "x.lis", (1, 0));
    fs::create_dir_all(folder.path("_Config/CNC")).unwrap();
    fs::write(folder.path("_Config/CNC/Axis_0 (old).xti"), item(&x)).unwrap();
    fs::write(folder.path("_Config/CNC/Axis_1.xti"), item(&x)).unwrap();
    let others = all_axes().replace(&x, "");
    let off =
        axis("Q", "x.lis", (1, 5)).replace("<Axis Id=\"1\">", "<Axis Id=\"9\" Disabled=\"true\">");
    let channel = channel(&list("channel.lis"));
    let inside = format!("{TASK}<Axis File=\"Axis_1.xti\" Id=\"1\"/>{others}{off}{channel}");
    put(&folder, project(&inside));
    let (exit, trace, said) = run(&folder, "machine.tsproj");
    assert_eq!((exit, &trace), (Exit::Finished, &expected), "{said}");
    assert!(said.contains("Axis_0 (old).xti (not named by the project)"), "{said}");
    assert!(said.contains("`Q-Achse`") && said.contains("(switched off)"), "{said}");
    // without references all of them are exported items: one number twice, the others different
    fs::remove_file(folder.path("machine.tsproj")).unwrap();
    fs::write(folder.path("_Config/CNC/Rest.xti"), item(&format!("{others}{channel}"))).unwrap();
    let said = refused(&folder, "_Config");
    assert!(said.contains("K-0141") && said.contains("kopf.achs_nr 1"), "{said}");
}

/// A part that the project references but that was not copied is reported by a warning; a missing terminal or disabled axis is
/// not.
#[test]
fn a_missing_part_is_named() {
    let folder = folder();
    let parts = folder.path("_Config/CNC");
    fs::create_dir_all(&parts).unwrap();
    let axes =
        ["X", "Y", "Z"].map(|name| axis(name, &format!("{}.lis", name.to_lowercase()), (1, 0)));
    for (i, (text, place)) in axes.iter().zip(0..).enumerate() {
        let index = format!("<DefaultIndex>{place}</DefaultIndex>");
        let text = item(&text.replace("<DefaultIndex>0</DefaultIndex>", &index));
        fs::write(parts.join(format!("Axis_{}.xti", i + 1)), text).unwrap();
    }
    let named =
        [1, 2, 3].map(|i| format!("<Axis File=\"CNC\\AXIS_{i}.xti\" Id=\"{i}\"/>")).concat();
    let others = "<Axis File=\"Off.xti\" Disabled=\"1\"/><Box File=\"Terminal 1.xti\"/>";
    let inside = format!(
        "{TASK}{named}{others}{}{}",
        axis("", "s.lis", (1, 3)),
        channel(&list("channel.lis"))
    );
    put(&folder, project(&inside));
    let (exit, trace, said) = run(&folder, "machine.tsproj");
    assert_eq!((exit, trace), (Exit::Finished, expected()), "{said}");
    assert!(!said.contains("not found"), "{said}");
    fs::remove_file(parts.join("Axis_2.xti")).unwrap();
    let (_, _, said) = folder.call(&["check", "@part.nc", "-m", "@machine.tsproj"]);
    assert!(said.contains("warning[K-0140]"), "{said}");
    assert!(said.contains("not found: CNC\\AXIS_2.xti;"), "{said}");
    fs::remove_file(parts.join("Axis_1.xti")).unwrap();
    fs::remove_file(parts.join("Axis_3.xti")).unwrap();
    let (_, _, said) = folder.call(&["check", "@part.nc", "-m", "@machine.tsproj"]);
    assert!(
        said.contains("not found: CNC\\AXIS_1.xti, CNC\\AXIS_2.xti, CNC\\AXIS_3.xti"),
        "{said}"
    );
}

/// Names of lists in different case, as in copies from Windows: the same machine, with a note for each.
#[test]
fn names_of_lists_in_other_capital_letters() {
    let expected = expected();
    let folder = folder();
    let machine = folder.path("copy");
    fs::create_dir(&machine).unwrap();
    for (name, copy) in [
        ("hochlauf.lis", "Hochlauf.lis"),
        ("channel.lis", "Channel.LIS"),
        ("axes.lis", "axes.lis"),
        ("x.lis", "X.LIS"),
        ("y.lis", "y.lis"),
        ("z.lis", "z.lis"),
        ("s.lis", "s.lis"),
        ("kontur.lis", "KONTUR.lis"),
    ] {
        fs::write(machine.join(copy), list(name)).unwrap();
    }
    let (exit, trace, said) = run(&folder, "copy");
    assert_eq!((exit, trace), (Exit::Finished, expected), "{said}");
    for note in ["channel.lis is Channel.LIS", "x.lis is X.LIS", "kontur.lis is KONTUR.lis"] {
        assert!(said.contains("note[K-0109]") && said.contains(note), "{note}: {said}");
    }
    assert!(!said.contains("y.lis is"), "{said}");
    // none at all is none
    fs::remove_file(machine.join("X.LIS")).unwrap();
    let (exit, _, said) = run(&folder, "copy");
    assert!(exit == Exit::Usage && said.contains("x.lis` cannot be read"), "{said}");
}

/// Names and positions of the axes: none at all, and empty positions.
#[test]
fn names_and_places_of_the_axes() {
    let folder = folder();
    let nameless = all_axes()
        .replace("<DefaultProgName>", "<Other>")
        .replace("</DefaultProgName>", "</Other>");
    let inside = format!("{TASK}{nameless}{}", channel("prog_start.slope.profile 1"));
    put(&folder, project(&inside));
    let said = refused(&folder, "machine.tsproj");
    assert!(said.contains("K-0141") && said.contains("does not name an axis"), "{said}");
    let gap =
        all_axes().replace("<DefaultIndex>2</DefaultIndex>", "<DefaultIndex>4</DefaultIndex>");
    let inside = format!("{TASK}{gap}{}", channel(&list("channel.lis")));
    put(&folder, project(&inside));
    let (_, said) = finishes(&folder, "machine.tsproj");
    assert!(said.contains("DefaultIndex: X 0, Y 1, Z 4"), "{said}");
    // another encoding
    put(&folder, b"<P>\xb5</P>");
    let said = refused(&folder, "machine.tsproj");
    assert!(said.contains("K-0141") && said.contains("UTF-8"), "{said}");
}
