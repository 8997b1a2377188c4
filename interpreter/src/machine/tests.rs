mod reactions;

use super::table::own;
use super::*;
use crate::diag::{Condition, Diagnostic};
use kontur_motion::block::SlopeKind;
use std::collections::BTreeMap;

/// Files in memory.
#[derive(Default)]
struct Memory(BTreeMap<String, String>);

impl Memory {
    /// A machine X, Y (numbers 1, 7) and spindle S (4) in folder `m`.
    fn machine() -> Self {
        let mut files = Self::default();
        files.put(
            "m/hochlauf.lis",
            "kanal_anzahl 1\nzahl_mds 3\nsda_mds[0] lists\\channel.lis\nachs_mds[0] lists/x.lis\n\
             achs_mds[1] lists/y.lis\nachs_mds[2] lists/s.lis\n",
        );
        files.put(
            "m/lists/channel.lis",
            "gruppe[0].achs_anzahl 2\ngruppe[0].achse[0].bezeichnung X\ngruppe[0].achse[0].log_achs_nr 1\n\
             gruppe[0].achse[1].bezeichnung Y\ngruppe[0].achse[1].log_achs_nr 7\n\
             spindel[0].bezeichnung S\nspindel[0].log_achs_nr 4\n",
        );
        // the order of the axis lists carries no meaning
        files.put("m/lists/x.lis", "kopf.achs_nr 7\ngetriebe[0].kv 700\n");
        files.put("m/lists/y.lis", "kopf.achs_nr 1\ngetriebe[0].kv 100\n");
        files.put("m/lists/s.lis", "kopf.achs_nr 4\nkenngr.achs_typ ACHSTYP_SPINDEL\n");
        files
    }

    fn put(&mut self, path: &str, text: &str) {
        self.0.insert(path.to_owned(), text.to_owned());
    }

    fn add(&mut self, path: &str, text: &str) {
        self.0.get_mut(path).unwrap().push_str(text);
    }

    fn load(&self, overrides: &[&str]) -> Result<(Machine, Vec<Diagnostic>), Vec<Diagnostic>> {
        let overrides: Vec<Override> =
            overrides.iter().map(|text| Override::parse(text).unwrap()).collect();
        Machine::load(self, "m/hochlauf.lis", &overrides)
    }

    fn ids(&self, overrides: &[&str]) -> Vec<String> {
        let diagnostics = match self.load(overrides) {
            Ok((_, warnings)) => warnings,
            Err(all) => all,
        };
        diagnostics.iter().map(|d| d.id.to_string()).collect()
    }
}

impl ListFiles for Memory {
    fn read(&self, path: &str) -> Result<Option<Vec<u8>>, String> {
        Ok(self.0.get(path).map(|text| text.clone().into_bytes()))
    }
}

fn close(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-12 * b.abs().max(1.0)
}

/// Folder and list are joined by the separator of the system, and `.` and `..` are folders too.
#[test]
fn the_folder_is_found_with_either_separator() {
    for folder in ["m/", "m\\", "./m\\", "C:\\nc\\m\\", "..\\m/", "\\\\?\\C:\\m\\"] {
        let there = |(path, text): (&String, &String)| {
            let name = path.strip_prefix("m/").unwrap();
            // a verbatim path has backslashes only
            let join = if folder.starts_with(r"\\?\") { "\\" } else { "/" };
            let joined = if name == "hochlauf.lis" { "" } else { join };
            let name = name.replace('/', join);
            let folder =
                if joined.is_empty() { folder } else { folder.trim_end_matches(['/', '\\']) };
            (format!("{folder}{joined}{name}"), text.clone())
        };
        let files = Memory(Memory::machine().0.iter().map(there).collect());
        let (machine, warnings) =
            Machine::load(&files, &format!("{folder}hochlauf.lis"), &[]).unwrap();
        assert_eq!((machine.name.as_str(), warnings.len()), ("m", 0), "{folder}");
        assert_eq!(machine.axis("Y").unwrap().raw("getriebe[0].kv"), Some(700.0));
    }
}

#[test]
fn axes_are_tied_by_their_number() {
    let (machine, warnings) = Memory::machine().load(&[]).unwrap();
    assert_eq!(warnings, []);
    assert_eq!(machine.name, "m");
    let names: Vec<(&str, u32)> = machine.all_axes().map(|a| (a.name(), a.number())).collect();
    assert_eq!(names, [("X", 1), ("Y", 7), ("S", 4)]);
    assert_eq!(machine.axis("x").unwrap().raw("getriebe[0].kv"), Some(100.0));
    assert_eq!(machine.axis("Y").unwrap().raw("getriebe[0].kv"), Some(700.0));
    assert_eq!(machine.spindles[0].kind(), AxisKind::Spindle);
    assert_eq!(machine.cycle.us(), 1000);
}

#[test]
fn lists_overwrite_only_what_they_name() {
    let mut files = Memory::machine();
    files.add("m/hochlauf.lis", "default_achs_mds all.lis\n");
    files.put("m/all.lis", "getriebe[0].kv 4000\ngetriebe[0].window 200\n");
    let (machine, _) = files.load(&[]).unwrap();
    let x = machine.axis("X").unwrap();
    // specific list over default list over built-in default
    assert_eq!(x.raw("getriebe[0].kv"), Some(100.0));
    assert_eq!(x.raw("getriebe[0].window"), Some(200.0));
    assert_eq!(x.raw("getriebe[0].dynamik.vb_max"), Some(200000.0));
    assert_eq!(machine.axis("S").unwrap().raw("getriebe[0].kv"), Some(4000.0));
    // a default that follows another one, and those of an array
    assert!(close(x.a_w_max_mm_s2(), 1000.0) && close(x.tr_w_min_s(), 0.01));
    let filter = |k| x.get(table::axis_guard::IPC_TYPE.at(1).and(k));
    assert_eq!((filter(0).as_deref(), filter(1).as_deref()), (Some("BANDPASS"), Some("NO_FILTER")));
}

#[test]
fn an_override_gives_the_bits_of_a_list_value() {
    let mut files = Memory::machine();
    let (set, _) = files
        .load(&[
            "X.getriebe[0].kv=5000",
            "Y.filter[0].fg_f0=21.7",
            "channel.prog_start.feedrate=1e3",
            "kontur.cycle_time_us=2000",
            "kontur.axis[1].plant.ta_us=3000",
            "S.getriebe[0].dynamik.vb_max=0x1000",
        ])
        .unwrap();
    files.add("m/lists/y.lis", "getriebe[0].kv 5000\n");
    files.add("m/lists/x.lis", "filter[0].fg_f0 21.7\n");
    files.add("m/lists/channel.lis", "prog_start.feedrate 1e3\n");
    files.add("m/lists/s.lis", "getriebe[0].dynamik.vb_max 0x1000\n");
    files.put("m/kontur.lis", "kontur.cycle_time_us 2000\nkontur.axis[1].plant.ta_us 3000\n");
    // the listed twin warns about the repeated key; apart from that only the positions differ
    let (listed, _) = files.load(&[]).unwrap();
    assert_eq!(set.cycle, listed.cycle);
    assert_eq!(set.channel.feed.start_mm_s, listed.channel.feed.start_mm_s);
    for (a, b) in set.all_axes().zip(listed.all_axes()) {
        assert_eq!(a.dynamics(), b.dynamics());
        for key in ["getriebe[0].kv", "filter[0].fg_f0", "getriebe[0].dynamik.vb_max"] {
            assert_eq!(a.raw(key).map(f64::to_bits), b.raw(key).map(f64::to_bits));
        }
        assert_eq!(a.get(own::TIME_CONSTANT).to_bits(), b.get(own::TIME_CONSTANT).to_bits());
    }
}

/// An index that is not a logical number, and keys of another drive model, are reported as having no effect; the
/// message gives the position. Keys of the model of the axis are not reported.
#[test]
fn entries_of_kontur_lis_that_nothing_reads() {
    let said = |entries: &str| {
        let mut files = Memory::machine();
        files.put("m/kontur.lis", entries);
        let (machine, loading) = files.load(&[]).unwrap();
        let mut all = loading;
        all.extend(machine.chains().1);
        all.retain(|d| d.id.to_string() == "K-0075");
        all.iter().map(|d| d.source.as_ref().map_or(0, |at| at.line)).collect::<Vec<_>>()
    };
    let pt1 = "kontur.axis[1].plant.model PT1\n";
    assert_eq!(said(&format!("{pt1}kontur.axis[1].plant.ta_us 3000\n")), [0; 0]);
    assert_eq!(said(&format!("{pt1}kontur.axis[9].plant.model PT1\n")), [2]);
    for key in ["kp 300", "f0 20", "mode[0].f0 20", "mass_load 0.3"] {
        assert_eq!(said(&format!("{pt1}kontur.axis[1].plant.{key}\n")), [2], "{key}");
    }
    let two = "kontur.axis[1].plant.model TWO_MASS\n";
    for key in ["kp 300", "f0 20", "mass_load 0.3", "disturbance.amplitude 5"] {
        assert_eq!(said(&format!("{two}kontur.axis[1].plant.{key}\n")), [0; 0], "{key}");
    }
    assert_eq!(said(&format!("{two}kontur.axis[1].plant.ta_us 5000\n")), [2]);
}

/// The rows of `interpreter/tests/lists` state what settings lead to.
#[test]
fn settings_that_cannot_be_one() {
    for text in ["X", "X=1", "X.=1", ".a=1", "X.kv="] {
        assert!(Override::parse(text).is_err(), "{text}");
    }
    // an index beyond its array is no misspelt key
    for text in ["X.filter[7].order=1", "channel.gruppe[1].achs_anzahl=1"] {
        let errors = Memory::machine().load(&[text]).unwrap_err();
        assert_ne!(errors[0].hint.as_deref().map(|hint| hint.contains("did you mean")), Some(true));
    }
}

#[test]
fn the_builtin_machine_loads_without_a_message() {
    let (machine, warnings) = Machine::builtin(&[]).unwrap();
    assert_eq!(warnings, []);
    assert_eq!(machine.name, "xyz");
    let names: Vec<(&str, u32)> = machine.all_axes().map(|a| (a.name(), a.number())).collect();
    assert_eq!(names, [("X", 1), ("Y", 2), ("Z", 3), ("S", 4)]);
    assert_eq!(machine.channel.dynamics.slope, SlopeKind::Trapez);
    let x = machine.axis("X").unwrap();
    assert!(close(x.kv_1_s(), 50.0) && close(x.get(own::TIME_CONSTANT), 0.005));
    assert_eq!(x.get(own::PLANT_MODEL).as_deref(), Some("PT1"));
    // the square-corner program needs a velocity jump at kinks that does not depend on the cycle
    assert!(close(x.dynamics().a_trans_ratio, 1.0));
}

/// Values of the vendor's examples: TF5200 tool data, P-TOOL-00003 to P-TOOL-00008.
#[test]
fn tool_lists() {
    let mut files = Memory::machine();
    files.add("m/hochlauf.lis", "werkz_data[0] lists/tools.lis\n");
    files.put(
        "m/lists/tools.lis",
        "wz[5].laenge 600000 # 60 mm\nwz[5].radius 200000 # 20 mm\nwz[5].gueltig 1\nwz[5].mass_einheit 0\n\
         wz[5].ax_versatz[0] 2050000\nwz[5].ax_versatz[1] -4080000\nwz[5].ax_versatz[31] 0\nwz[5].param[1] 20.5\n\
         wz[0].laenge 5\nwz[8].laenge 10000\nwz[8].mass_einheit 1\nWz[9].radius 45000\nwz[9].gueltig 1\n",
    );
    let (machine, messages) = files.load(&[]).unwrap();
    assert!(messages.is_empty(), "{messages:?}");
    let numbers: Vec<u32> = machine.tools.keys().copied().collect();
    // D0 is not a tool
    assert_eq!(numbers, [5, 8, 9]);
    let five = &machine.tools[&5];
    assert_eq!((five.length_mm, five.radius_mm, five.is_valid), (60.0, 20.0, true));
    assert_eq!(five.offsets_mm, BTreeMap::from([(0, 205.0), (1, -408.0)]));
    assert_eq!(five.parameters, BTreeMap::from([(1, 20.5)]));
    // one inch, and not valid
    assert_eq!((machine.tools[&8].length_mm, machine.tools[&8].is_valid), (25.4, false));
    assert!((machine.tools[&9].radius_mm - 4.5).abs() < 1e-12);
    // the overview prints another key; a setting has the effect of a list entry
    let mut other = Memory::machine();
    other.add("m/hochlauf.lis", "wrkz_data[0] lists/tools.lis\n");
    other.put("m/lists/tools.lis", &files.0["m/lists/tools.lis"]);
    assert_eq!(other.load(&[]).unwrap().0.tools, machine.tools);
    let changed = files.load(&["tool.wz[5].laenge=700000"]).unwrap().0;
    assert!((changed.tools[&5].length_mm - 70.0).abs() < 1e-12);
    // no channel has that many axes
    files.add("m/lists/tools.lis", "wz[5].ax_versatz[30] 1\n");
    assert_eq!(files.ids(&[]), ["K-0075"]);
    files.add("m/lists/tools.lis", "wz[5].mass_einheit 7\nwz[5].schneide 1\n");
    assert_eq!(files.ids(&[]), ["K-0028", "1001119", "K-0070", "K-0075"]);
    let mut missing = Memory::machine();
    missing.add("m/hochlauf.lis", "werkz_data[0] lists/tools.lis\n");
    assert_eq!(missing.ids(&[]), ["K-0153"]);
}

/// TF5200 zero offsets: P-ZERO-00002 to 00004.
#[test]
fn lists_of_zero_offsets() {
    let mut files = Memory::machine();
    files.add("m/hochlauf.lis", "nullp_data[0] lists/zero.lis\n");
    files.put(
        "m/lists/zero.lis",
        "default_index 2\nnp_grp[1].achse[0].versch 100000\nnp_grp[2].achse[1].versch -55000\nnp_grp[2].achse[1].inaktiv 1\n",
    );
    let (machine, messages) = files.load(&[]).unwrap();
    assert!(messages.is_empty(), "{messages:?}");
    assert_eq!(machine.zero_offsets.start_group, 2);
    assert_eq!(machine.zero_offsets.entries, BTreeMap::from([((1, 0), 10.0), ((2, 1), -5.5)]));
    // P-ZERO-00004
    assert_eq!(machine.zero_offsets.excluded, [(2, 1)].into());
    let set = files.load(&["zero.default_index=1"]).unwrap().0;
    assert_eq!(set.zero_offsets.start_group, 1);
    assert_eq!(files.ids(&["zero.default_index=97"]), ["20585"]);
}

/// TF5200 external variables: the older syntax with its keys, P-EXTV-00010, P-EXTV-00013 and 20088.
#[test]
fn lists_of_external_variables() {
    let list = "anzahl_belegt 4\nvar[0].name A (first)\nvar[0].index 0\nvar[0].type SGN16\nvar[0].synchronisation FALSE\n\
        var[0].array_size 10\nvar[1].name P\nvar[1].type POINT\nstruct[0].name POINT\nvar[2].name B\nvar[2].type STRING\n\
        var[3].name A\nvar[4].name C\ninit V.E.A[1] = 2\ninit V.E.B = \"x\"\ninit V.E.A[2] = V.E.A[1]\n";
    for key in ["ve_var[0]", "ext_var[0]"] {
        let mut files = Memory::machine();
        files.add("m/hochlauf.lis", &format!("{key} lists/external.lis\n"));
        files.put("m/lists/external.lis", list);
        let (machine, messages) = files.load(&[]).unwrap();
        let ids: Vec<String> = messages.iter().map(|d| d.id.to_string()).collect();
        // addresses, the variable beyond the count, the structure, the second A
        assert_eq!(ids, ["K-0075", "K-0074", "K-0019", "K-0075"], "{messages:?}");
        let known: Vec<(&str, ExternalKind, u32)> =
            machine.external.variables.iter().map(|v| (&*v.name, v.kind, v.elements)).collect();
        let expected = [("A", ExternalKind::Number("SGN16"), 10), ("B", ExternalKind::Text(20), 0)];
        assert_eq!(known, expected);
        assert_eq!(machine.external.asynchronous(), [String::from("A")].into());
        let init: Vec<&str> = machine.external.init.iter().map(|(text, _)| &**text).collect();
        assert_eq!(init, ["V.E.A[1] = 2", "V.E.B = \"x\"", "V.E.A[2] = V.E.A[1]"]);
        // those after an unknown type do not exist either
        let (machine, messages) = files.load(&["external.var[0].type=INT"]).unwrap();
        assert!(machine.external.variables.is_empty());
        assert!(messages.iter().any(|d| d.id == Condition::ExternalType), "{messages:?}");
    }
}
