//! The sample machines of `programs/machines`.

use crate::lists::read;
use kontur_interpreter::diag::Diagnostic;
use kontur_interpreter::machine::table::{self, Default, ListKind};
use kontur_interpreter::machine::value::Value;
use kontur_interpreter::machine::{AxisKind, Machine};
use std::path::PathBuf;

fn sample(name: &str) -> (Machine, Vec<Diagnostic>) {
    read(name, &[]).unwrap()
}

fn folder() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../programs/machines")
}

#[test]
fn all_load_without_a_message_that_the_vendor_does_not_demand() {
    let mut names: Vec<String> = std::fs::read_dir(folder())
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    for name in ["gantry", "rack_and_pinion", "two_spindles", "vendor_defaults", "xyz"] {
        assert!(names.iter().any(|n| n == name), "{name}");
    }
    for name in names {
        let (machine, messages) = sample(&name);
        assert_eq!(machine.name, name);
        let ids: Vec<String> = messages.iter().map(|d| d.id.to_string()).collect();
        let demanded: &[&str] = match name.as_str() {
            // the printed sampling time of the simulated drive is 10 ms
            "vendor_defaults" => &["K-0032", "K-0032", "K-0032"],
            // a column that keeps ringing longer than the recommended settling time
            "rack_and_pinion" => &["K-0078"],
            _ => &[],
        };
        assert_eq!(ids, demanded, "{name}: {messages:?}");
    }
}

#[test]
fn vendor_defaults_lists_every_printed_default() {
    let (machine, _) = sample("vendor_defaults");
    let x = machine.axis("X").unwrap();
    let mut listed = 0;
    for row in table::rows().filter(|r| r.list == ListKind::Axis && !r.key.is_empty()) {
        let default = match row.default {
            Default::Number(number) => Value::Number(number),
            Default::Text(text) => Value::Text(text.to_owned()),
            Default::PerIndex(texts) => Value::Text(texts[0].to_owned()),
            Default::None | Default::Of(_) => continue,
        };
        let key = row.key.replace("[i]", "[0]").replace("[j]", "[0]").replace("[k]", "[0]");
        let setting = x.parameters().setting(&key);
        assert_eq!(setting.map(|s| &s.value), Some(&default), "{key}");
        listed += 1;
    }
    assert!(listed > 140, "{listed}");
}

#[test]
fn the_builtin_machine_is_the_one_on_disk() {
    let (builtin, _) = Machine::builtin(&[]).unwrap();
    assert_eq!(builtin, sample("xyz").0);
}

#[test]
fn spindles_and_gantry_slaves_are_found() {
    let (machine, _) = sample("two_spindles");
    let spindles: Vec<(&str, u32)> =
        machine.spindles.iter().map(|a| (a.name(), a.number())).collect();
    assert_eq!(spindles, [("S", 4), ("S2", 5)]);
    assert!(machine.spindles.iter().all(|a| a.kind() == AxisKind::Spindle && a.is_modulo()));
    let (machine, _) = sample("gantry");
    let slave = machine.axis("X2").unwrap();
    assert_eq!((slave.number(), slave.gantry_master()), (4, Some(1)));
    assert_eq!(slave.dynamics(), machine.axis("X").unwrap().dynamics());
    assert_eq!(machine.axes.len(), 3);
}

#[test]
fn shared_lists_are_the_same_in_every_folder() {
    let text = |path: &str| std::fs::read_to_string(folder().join(path)).unwrap();
    for (name, lists) in [
        ("two_spindles", &["axes.lis", "x.lis", "y.lis", "z.lis", "s.lis"][..]),
        // its x.lis marks the master
        ("gantry", &["axes.lis", "y.lis", "z.lis"][..]),
    ] {
        for list in lists {
            assert_eq!(
                text(&format!("{name}/{list}")),
                text(&format!("xyz/{list}")),
                "{name}/{list}"
            );
        }
    }
}
