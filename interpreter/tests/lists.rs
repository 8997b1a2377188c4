//! The tables of `lists`: settings of a machine, and what the reader of the lists makes of them. Their README describes the form.

use kontur_filters::time::CycleTime;
use kontur_interpreter::diag::Diagnostic;
use kontur_interpreter::machine::{Axis, ListFiles, Machine, Override};
use kontur_kit::pieces;
use kontur_kit::rows::{Row, fits, is, rows, settings, wrong};
use std::fmt::Debug;

/// The folder of the sample machines.
struct Samples;

impl ListFiles for Samples {
    fn read(&self, path: &str) -> Result<Option<Vec<u8>>, String> {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../programs/machines/");
        Ok(std::fs::read(format!("{folder}{path}")).ok())
    }
}

/// Reads a sample machine with settings: the machine with its messages, or those for which it is refused.
pub(crate) fn read(
    name: &str,
    set: &[&str],
) -> Result<(Machine, Vec<Diagnostic>), Vec<Diagnostic>> {
    let set: Vec<Override> = set.iter().map(|text| Override::parse(text).unwrap()).collect();
    Machine::load(&Samples, &format!("{name}/hochlauf.lis"), &set)
}

/// What settings lead to: the machine unless it is refused, and the messages.
struct Outcome(Option<Machine>, Vec<Diagnostic>);

fn outcome(row: &Row, more: &str) -> Outcome {
    let all = [&row.settings[..], &settings(more)].concat();
    let all: Vec<&str> = all.iter().map(String::as_str).collect();
    match read(row.machine.as_deref().unwrap_or("xyz"), &all) {
        Ok((machine, mut messages)) => {
            messages.extend(machine.chains().1);
            Outcome(Some(machine), messages)
        }
        Err(messages) => Outcome(None, messages),
    }
}

/// `ID@axis@parameter@severity@place`.
fn message(d: &Diagnostic, written: &[String]) -> String {
    let axis = d.axis.as_ref().map_or("-", |axis| &axis.name);
    let place = match &d.source {
        None => "-",
        Some(at) if written.iter().any(|setting| **setting == *at.text) => "set",
        Some(_) => "list",
    };
    let severity = format!("{:?}", d.severity).to_lowercase();
    format!("{}@{axis}@{}@{severity}@{place}", d.id, d.parameter.unwrap_or("-"))
}

/// All that the lists say of the axes.
fn whole(machine: &Machine) -> String {
    let kernels: Vec<_> =
        machine.all_axes().map(|axis| axis.kernel_preset(machine.cycle)).collect();
    format!("{:?} {kernels:?}", machine.chains().0)
}

/// The values of a structure by their paths, from its text for debugging: `position.kv_per_s` and `50.0`. Unnamed parts have a number,
/// that of `Some` has none; a structure itself has its type as value.
fn values(thing: &dyn Debug) -> Vec<(String, String)> {
    let (mut found, mut around): (Vec<_>, Vec<(String, Option<usize>)>) = (Vec::new(), Vec::new());
    for line in format!("{thing:#?}").lines() {
        let line = line.trim().trim_end_matches(',');
        if line.starts_with(['}', ']', ')']) {
            around.pop();
            continue;
        }
        let (name, value) = match (line.split_once(": "), around.last_mut()) {
            (Some((name, value)), _) => (name.to_owned(), value),
            (None, Some((_, Some(next)))) => (std::mem::replace(next, *next + 1).to_string(), line),
            (None, _) => (String::new(), line),
        };
        let path = around.iter().map(|(name, _)| name).chain([&name]);
        let path: Vec<&str> = path.map(String::as_str).filter(|name| !name.is_empty()).collect();
        let plain = value.trim_end_matches(['{', '[', '(']);
        if plain != "Some" {
            found.push((path.join("."), plain.trim_matches(['"', ' ']).replace(' ', "")));
        }
        if plain.len() < value.len() {
            around.push((name, (plain != "Some").then_some(0)));
        }
    }
    found
}

/// The setup of an axis, or that of the channel.
fn setup(machine: &Machine, name: &str) -> Vec<(String, String)> {
    let Some(axis) = machine.axis(name) else { return values(&machine.channel) };
    let place = machine.all_axes().position(|other| other.name() == name).unwrap();
    let chain = &machine.chains().0[place];
    let parts: [&dyn Debug; 4] =
        [&chain.control, chain, &axis.kernel_preset(machine.cycle), &axis.dynamics()];
    parts.into_iter().flat_map(values).collect()
}

/// What `X,Y:position.kv_per_s=50` states and the setup of these axes does not have; `*` are all axes.
fn other_setup(word: &str, machine: &Machine) -> Option<String> {
    let (names, rest) = word.split_once(':')?;
    let (path, wanted) = rest.split_once('=')?;
    let all = machine.all_axes().map(Axis::name);
    let names: Vec<&str> = if names == "*" { all.collect() } else { names.split(',').collect() };
    let near = |(a, b): (f64, f64)| (a - b).abs() <= 1e-9 * b.abs().max(1e-9);
    let number = |text: &str| text.parse::<f64>().ok();
    names.into_iter().find_map(|name| {
        let setup = setup(machine, name);
        let found = setup.iter().find(|(p, _)| p == path).map(|(_, value)| value);
        let same =
            found.is_some_and(|f| f == wanted || number(f).zip(number(wanted)).is_some_and(near));
        (!same).then(|| format!("{name}:{path} is {found:?}"))
    })
}

/// The facts that a word of a row introduces.
fn facts(word: &str, machine: &Machine) -> Vec<String> {
    let chains = machine.chains().0;
    match word {
        "filters" => chains.iter().map(|chain| chain.filters.len().to_string()).collect(),
        "modulo" => machine.all_axes().map(|axis| axis.is_modulo().to_string()).collect(),
        "kernel" => {
            let kernel =
                |axis: &Axis| axis.kernel_preset(machine.cycle).hsc?.design(CycleTime::DEFAULT).0;
            let length = |axis| kernel(axis).map_or("-".into(), |k| k.length().to_string());
            machine.all_axes().map(length).collect()
        }
        _ => vec![match &chains[0].additional {
            None => "off".into(),
            Some(interface) if interface.filter.is_none() => "plain".into(),
            Some(_) => "filter".into(),
        }],
    }
}

/// What a row states and the lists do not fulfil.
fn faults(row: &Row) -> Vec<String> {
    let left = row.program.trim_end_matches("M30\n").trim().replace('\n', " | ");
    let written = [&row.settings[..], &settings(&left)].concat();
    let Outcome(machine, messages) = outcome(row, &left);
    let mut wrong = Vec::new();
    let (expected, texts) = row.words_and_texts();
    let (expected, other) = match expected.split_once("like ") {
        Some((words, settings)) => (words.trim_end_matches("un"), Some(settings)),
        None => (expected, None),
    };
    if let (Some(other), Some(machine)) = (other, &machine) {
        let same = outcome(row, other).0.is_some_and(|other| whole(&other) == whole(machine));
        if same == row.expected.contains("unlike ") {
            wrong.push(format!("{} {other}", if same { "like" } else { "unlike" }));
        }
    }
    let mut lists = vec![("says", Vec::new())];
    for word in expected.split_whitespace() {
        match (word, &machine) {
            ("ok", _) | ("refused", None) => {}
            ("filters" | "kernel" | "additional" | "modulo", _) => lists.push((word, Vec::new())),
            (_, Some(machine)) if word.contains(':') => wrong.extend(other_setup(word, machine)),
            (_, Some(machine)) if word.contains('=') => {
                let (key, value) = word.split_once('=').unwrap_or_default();
                let (axis, key) = key.split_once('.').unwrap_or_default();
                let used = machine.axis(axis).and_then(|axis| axis.raw(key));
                if !used.is_some_and(|used| is(value, &used.to_string())) {
                    wrong.push(format!("{key} is {used:?}"));
                }
            }
            _ => lists.last_mut().unwrap().1.push(word),
        }
    }
    if machine.is_none() && !expected.contains("refused") {
        wrong.push("refused".to_owned());
    }
    for (word, wanted) in lists {
        let found: Vec<String> = match (word, &machine) {
            ("says", _) => messages.iter().map(|d| message(d, &written)).collect(),
            (_, Some(machine)) => facts(word, machine),
            (_, None) => Vec::new(),
        };
        if !fits(&wanted, &found) {
            wrong.push(format!("{word} {}", found.join(" ")));
        }
    }
    let all: Vec<String> = messages.iter().map(|d| format!("{} {:?}", d.text, d.hint)).collect();
    for text in texts.split('"').filter(|text| !text.trim().is_empty()) {
        if !all.iter().any(|message| message.contains(text)) {
            wrong.push(format!("does not say {text}: {all:?}"));
        }
    }
    wrong
}

#[test]
fn settings_do_what_their_rows_say() {
    let wrong = wrong(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/lists"), faults).unwrap();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// A wrong row is found, whatever is wrong in it.
#[test]
fn wrong_rows_are_found() {
    let right = |row: &str| faults(&rows(row)[0]).is_empty();
    let (order, fewer) = ("X.filter[0]: enable=1, order=7", "X.filter[0]: enable=1, order=6");
    assert!(right(&format!(
        "{order} -> 50911@X@P-AXIS-00140@warning@set filters 1 0 0 0 like {fewer}"
    )));
    assert!(right(&format!("{order} -> 50911 \"order\"")));
    let of_axes = "*:position.kv_per_s=50 X,Y:encoder=Motor X:exact_stop.settling_s=0.2";
    assert!(right(&format!("{order} -> 50911 {of_axes} channel:dynamics.slope=Trapez")));
    for wrong in pieces(
        "ok ¦ 50912 ¦ 50911@Y ¦ 50911@X@P-AXIS-00141 ¦ 50911@X@P-AXIS-00140@error ¦ 50911@X@P-AXIS-00140@warning@-
50911 refused ¦ 50911 X.filter[0].order=5 ¦ 50911 filters 0 0 0 0 ¦ 50911 kernel 7 - - - ¦ 50911 additional plain
50911 modulo true false false true ¦ 50911 *:position.kv_per_s=49 ¦ 50911 X:encoder=Direct ¦ 50911 X:never.there=1
50911 channel:dynamics.slope=Step ¦ 50911 like X.filter[0]: enable=1, order=5 ¦ 50911 unlike X.filter[0]: enable=1, order=6
50911 \"never said\"",
    ) {
        assert!(!right(&format!("{order} -> {wrong}")), "{wrong}");
    }
    assert!(
        right("kontur.cycle_time_us=50 -> .. refused") && !right("kontur.cycle_time_us=50 -> ..")
    );
}
