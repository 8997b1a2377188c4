//! Links the channel list and the axis lists: `log_achs_nr` = `kopf.achs_nr`.

mod gantry;

use super::Machine;
use super::axis::Axis;
use super::channel::Channel;
use super::external::ExternalVariables;
use super::kind::{AxisKind, kind_of, logical_number};
use super::overrides::OVERRIDE;
use super::parameters::Parameters;
use super::settled::{AxisList, Settled};
use super::table::param::{Place, whole};
use super::table::{ListKind, axis_general, channel as of, with_indices};
use super::tools;
use crate::diag::{Condition, Diagnostic, Location, Severity};
use kontur_filters::time::CycleTime;

/// One axis or spindle of the channel list.
#[derive(Clone, Debug, PartialEq)]
struct Named {
    name: String,
    number: u32,
    spindle: bool,
    feed: bool,
    at: Option<Location>,
}

/// Axes and spindles of the channel list in its order; gantry slaves under the names of their axis lists.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Names {
    named: Vec<Named>,
    slaves: Vec<(u32, String)>,
}

impl Names {
    /// Logical number of a name, without regard to case.
    pub(super) fn number(&self, name: &str) -> Option<u32> {
        let named = self.named.iter().map(|n| (n.number, &n.name));
        let slaves = self.slaves.iter().map(|(number, name)| (*number, name));
        named.chain(slaves).find(|(_, n)| n.eq_ignore_ascii_case(name)).map(|(number, _)| number)
    }

    /// Name of a logical number.
    pub(super) fn name(&self, number: u32) -> Option<&str> {
        let slave = self.slaves.iter().find(|(n, _)| *n == number).map(|(_, name)| name);
        let named = self.named.iter().find(|n| n.number == number).map(|n| &n.name);
        named.or(slave).map(String::as_str)
    }

    /// Every name.
    pub(super) fn all(&self) -> Vec<&str> {
        let slaves = self.slaves.iter().map(|(_, name)| name.as_str());
        self.named.iter().map(|n| n.name.as_str()).chain(slaves).collect()
    }
}

/// Reads names and numbers from the channel list.
pub(super) fn names(settled: &Settled, diagnostics: &mut Vec<Diagnostic>) -> Names {
    let channel = &settled.channel;
    let mut named = group(channel, &AXES, diagnostics);
    named.append(&mut group(channel, &SPINDLES, diagnostics));
    let mut slaves = Vec::new();
    for list in &settled.axes {
        let number = logical_number(&list.parameters);
        let is_slave = list.parameters.get(axis_general::GANTRY_MASTER) != 0;
        if is_slave && !named.iter().any(|n| n.number == number) {
            let name = list.parameters.get(axis_general::NAME);
            slaves.push((number, name.unwrap_or_else(|| format!("axis {number}"))));
        }
    }
    Names { named, slaves }
}

/// Name and number of one entry of an array of names.
struct EntryKeys {
    name: Place,
    number: Place,
}

/// Maximum number of characters in a name. Source: P-CHAN-00006, P-CHAN-00010.
const NAME_MAX: usize = 16;

/// An array of names in the channel list.
struct GroupKeys {
    /// Its key in messages.
    array: &'static str,
    /// Maximum number of entries.
    size: u32,
    spindles: bool,
    count: Place,
    entry: fn(u32) -> EntryKeys,
}

const AXES: GroupKeys = GroupKeys {
    array: "gruppe[0].achse",
    size: 32,
    spindles: false,
    count: of::AXIS_COUNT.place(),
    entry: |i| EntryKeys {
        name: of::AXIS_NAME.and(i).place(),
        number: of::AXIS_NUMBER.and(i).place(),
    },
};

const SPINDLES: GroupKeys = GroupKeys {
    array: "spindel",
    size: 16,
    spindles: true,
    count: of::SPINDLE_COUNT.place(),
    entry: |i| EntryKeys {
        name: of::SPINDLE_NAME.at(i).place(),
        number: of::SPINDLE_NUMBER.at(i).place(),
    },
};

/// One array of names. The count in the list applies; Assumption: without a count all named entries are used.
fn group(channel: &Parameters, group: &GroupKeys, diagnostics: &mut Vec<Diagnostic>) -> Vec<Named> {
    let GroupKeys { array, size, spindles, .. } = *group;
    let (count, entry) = (group.count, group.entry);
    let name_at = |i: u32| channel.set_by(entry(i).name);
    let number_at = |i: u32| channel.set_by(entry(i).number);
    let given = (0..size).filter(|i| name_at(*i).is_some()).map(|i| i + 1).max().unwrap_or(0);
    let wanted = match channel.set_by(count) {
        Some(_) => channel.listed(count).and_then(whole).unwrap_or_default(),
        None => given,
    };
    if given > wanted {
        let message =
            format!("{array}[{}]: {count} is {wanted}, further entries are ignored", given - 1);
        diagnostics.push(error(
            Condition::ListCount,
            message,
            name_at(given - 1).and_then(|s| s.at.clone()),
        ));
    }
    let mut found = Vec::new();
    for i in 0..wanted.min(size) {
        let Some(name) = name_at(i) else {
            let message = format!("{array}[{i}] has no name (bezeichnung), {count} is {wanted}");
            let at = channel.set_by(count).and_then(|s| s.at.clone());
            diagnostics.push(error(Condition::ListLink, message, at));
            continue;
        };
        let text = name.value.text().unwrap_or_default();
        let Some(number) = number_at(i) else {
            let message = format!("{array}[{i}]: axis {text} has no logical number (log_achs_nr)");
            diagnostics.push(error(Condition::ListLink, message, name.at.clone()));
            continue;
        };
        let value = number.value.number().and_then(whole).unwrap_or_default();
        let at = number.at.clone().or_else(|| name.at.clone());
        let name = usable_name(text, value, spindles, name.at.as_ref(), diagnostics);
        let feed = !spindles && channel.get(of::FEED_AXIS.and(i));
        found.push(Named { name, number: value, spindle: spindles, feed, at });
    }
    found
}

/// Names of path axes begin with A B C U V W X Y Z Q, names of spindles with S; then letters, digits and `_`.
///
/// A wrong first letter, and an axis name that is too long, are replaced as in the control: 20425, 20971 (251585675,
/// 253130635). For other wrong characters the documents give neither a number nor a replacement.
fn usable_name(
    name: &str,
    number: u32,
    spindle: bool,
    at: Option<&Location>,
    diagnostics: &mut Vec<Diagnostic>,
) -> String {
    let letters = if spindle { "S" } else { "ABCUVWXYZQ" };
    let first = name.chars().next().map(|c| c.to_ascii_uppercase());
    let begins = first.is_some_and(|c| letters.contains(c));
    let is_long = name.len() > NAME_MAX;
    if begins && !is_long && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_') {
        return name.to_owned();
    }
    let what = if spindle { "a spindle" } else { "an axis" };
    let message = format!(
        "`{name}` cannot be the name of {what}: a name must begin with one of {letters}, followed by at most {} letters, digits and _",
        NAME_MAX - 1
    );
    let replaced = match (begins, is_long) {
        (false, _) | (_, true) if !spindle => (Condition::PathAxisName, format!("X{number}")),
        (false, false) if spindle => (Condition::SpindleName, "S".to_owned()),
        _ => {
            diagnostics.push(error(Condition::ListLink, message, at.cloned()));
            return name.to_owned();
        }
    };
    let (condition, used) = replaced;
    let diagnostic = error(condition, format!("{message}; {used} is used"), at.cloned());
    diagnostics.push(diagnostic.axis(number, &*used));
    used
}

fn error(condition: Condition, message: String, at: Option<Location>) -> Diagnostic {
    let mut diagnostic = Diagnostic::new(condition, message);
    diagnostic.source = at;
    diagnostic
}

/// Builds the machine; `None` if numbers or names are inconsistent (K-0031).
pub(super) fn machine(
    name: &str,
    cycle: CycleTime,
    settled: Settled,
    names: &Names,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<Machine> {
    let before = diagnostics.len();
    check_numbers(&settled, names, diagnostics);
    if diagnostics.iter().skip(before).any(Diagnostic::is_error) {
        return None;
    }
    let Settled { start_up, channel, axes: lists, own, tools, zero, external } = settled;
    let mut lists: Vec<Option<Parameters>> =
        lists.into_iter().map(|l| Some(l.parameters)).collect();
    let mut take = |number: u32| -> Option<Parameters> {
        lists.iter_mut().find(|l| l.as_ref().is_some_and(|p| logical_number(p) == number))?.take()
    };
    let mut axes = Vec::new();
    let mut spindles = Vec::new();
    let mut marked = Vec::new();
    for named in &names.named {
        let parameters = take(named.number)?;
        let kind = kind(&parameters, named, diagnostics);
        let axis = Axis::new(named.name.clone(), kind, parameters, own_of(&own, named.number));
        if named.spindle {
            spindles.push(axis);
        } else {
            marked.push(named.feed);
            axes.push(axis);
        }
    }
    let mut gantry_slaves = Vec::new();
    for (number, name) in &names.slaves {
        let mut parameters = take(*number)?;
        let master = parameters.get(axis_general::GANTRY_MASTER);
        if let Some(master) = axes.iter().find(|a| a.number() == master) {
            gantry::take_over(&mut parameters, master.parameters());
        }
        let kind = kind_of(&parameters);
        gantry_slaves.push(Axis::new(name.clone(), kind, parameters, own_of(&own, *number)));
    }
    let left: Vec<String> = lists.iter().flatten().map(called).collect();
    // an error in the names may be the reason why a list has none
    if !left.is_empty() && !diagnostics.iter().any(Diagnostic::is_error) {
        let message =
            format!("axis lists not named by a channel, not simulated: {}", left.join(", "));
        let hint = "name them in the channel list (gruppe[0].achse[i]); a gantry slave requires its master \
                    (kenngr.gantry_ax_nr)";
        let note = Diagnostic::new(Condition::ListNoEffect, message).severity(Severity::Note);
        diagnostics.push(note.hint(hint));
    }
    let channel = Channel::new(channel, start_up, marked);
    let tools = tools::tools(&tools, axes.len(), diagnostics);
    let zero_offsets = tools::zero_offsets(&zero, axes.len(), diagnostics);
    Some(Machine {
        name: name.to_owned(),
        cycle,
        axes,
        spindles,
        gantry_slaves,
        channel,
        tools,
        zero_offsets,
        external: ExternalVariables::new(&external, diagnostics),
    })
}

/// Number and name of an axis list.
fn called(list: &Parameters) -> String {
    let number = logical_number(list);
    list.get(axis_general::NAME).map_or(number.to_string(), |name| format!("{number} ({name})"))
}

/// The entries of `kontur.lis` that concern one axis.
fn own_of(own: &Parameters, number: u32) -> Parameters {
    let mut part = Parameters::new(ListKind::Kontur);
    let of_axis = |key: &str, index: u32| key.starts_with("kontur.axis[i]") && index == number;
    for (indices, setting) in own.settings().filter(|(i, s)| of_axis(s.row.key, i[0])) {
        part.set(setting.row, indices, setting.value.clone(), setting.at.clone());
    }
    part
}

/// The channel list determines what is a spindle; 21238, 110304 if the axis list disagrees.
fn kind(parameters: &Parameters, named: &Named, diagnostics: &mut Vec<Diagnostic>) -> AxisKind {
    let kind = kind_of(parameters);
    if (kind == AxisKind::Spindle) != named.spindle {
        let (condition, is, list) = if named.spindle {
            (Condition::SpindleWithoutType, "a spindle", "no spindle")
        } else {
            (Condition::PathAxisIsSpindle, "a path axis", "a spindle")
        };
        let message = format!(
            "{} is {is} in the channel list and {list} in its axis list (kenngr.achs_typ)",
            named.name
        );
        let at = parameters.set_by(axis_general::KIND).and_then(|s| s.at.clone());
        diagnostics.push(
            error(condition, message, at.or_else(|| named.at.clone()))
                .axis(named.number, &*named.name),
        );
    }
    kind
}

fn check_numbers(settled: &Settled, names: &Names, diagnostics: &mut Vec<Diagnostic>) {
    let number_at = |p: &Parameters| p.set_by(axis_general::NUMBER).and_then(|s| s.at.clone());
    let mut unnumbered = false;
    for (i, list) in settled.axes.iter().enumerate() {
        let number = logical_number(&list.parameters);
        let earlier = &settled.axes[..i];
        if let Some(first) = earlier.iter().find(|l| logical_number(&l.parameters) == number) {
            let message =
                format!("{}: axis number {number} is already used by {}", list.file, first.file);
            let at = number_at(&list.parameters);
            let mut diagnostic = error(Condition::ListLink, message, at);
            let is_unnumbered = |l: &&AxisList| l.parameters.set_by(axis_general::NUMBER).is_none();
            if let Some(list) = [first, list].into_iter().find(is_unnumbered) {
                unnumbered = true;
                let hint =
                    format!("{} has no kopf.achs_nr, which is {number} by default", list.file);
                diagnostic = diagnostic.hint(hint);
            }
            diagnostics.push(diagnostic.parameter(axis_general::NUMBER));
        }
    }
    // an axis may belong to a list that could not be read or has no number
    let is_explained = unnumbered || diagnostics.iter().any(|d| d.id == Condition::NoList);
    for (i, named) in names.named.iter().enumerate() {
        let earlier = &names.named[..i];
        let Named { name, number, .. } = named;
        let mut condition = Condition::ListLink;
        let problem = if *number == 0 {
            Some(format!("{name}: logical axis number 0 is not allowed"))
        } else if let Some(first) = earlier.iter().find(|n| n.number == *number) {
            condition = match (first.spindle, named.spindle) {
                (false, false) => Condition::PathAxisNumberTwice,
                (true, true) => Condition::SpindleNumberTwice,
                _ => Condition::SpindleIsPathAxis,
            };
            Some(format!("{name}: logical axis number {number} is already used by {}", first.name))
        } else if earlier.iter().any(|n| n.name.eq_ignore_ascii_case(name)) {
            condition = if named.spindle {
                Condition::SpindleNameTwice
            } else {
                Condition::PathAxisNameTwice
            };
            Some(format!("the name {name} occurs twice in the channel list"))
        } else if !is_explained
            && !settled.axes.iter().any(|l| logical_number(&l.parameters) == *number)
        {
            Some(format!("{name}: axis list with kopf.achs_nr {number} not found"))
        } else {
            None
        };
        if let Some(message) = problem {
            diagnostics
                .push(error(condition, message, named.at.clone()).axis(*number, name.as_str()));
        }
    }
    check_main_spindle(settled, names, diagnostics);
    for (indices, setting) in settled.own.settings() {
        // a list may describe more axes than the channel has
        let is_set = setting.at.as_ref().is_some_and(|at| &*at.file == OVERRIDE);
        let number = indices[0];
        if !setting.row.key.starts_with("kontur.axis[i]") || names.name(number).is_some() {
            continue;
        }
        let key = with_indices(setting.row.key, indices);
        let hint = "the index is the logical number of the axis (kopf.achs_nr)";
        if is_set {
            let message = format!("{key}: no axis of the channel has the logical number {number}");
            diagnostics.push(error(Condition::Setting, message, setting.at.clone()).hint(hint));
        } else if !settled.axes.iter().any(|l| logical_number(&l.parameters) == number) {
            let message = format!("{key}: no axis list has the logical number {number}, no effect");
            let about = Diagnostic::new(Condition::ListNoEffect, message).hint(hint);
            diagnostics.push(match &setting.at {
                Some(at) => about.at(at.clone()),
                None => about,
            });
        }
    }
    gantry::check(settled, names, diagnostics);
}

/// 21045: the main spindle must not have the name of another one; K-0031: it must be a spindle of the channel; 20971:
/// its name must begin with S.
///
/// Source: P-CHAN-00051, P-CHAN-00053 (TF5200 channel parameters).
fn check_main_spindle(settled: &Settled, names: &Names, diagnostics: &mut Vec<Diagnostic>) {
    let (channel, number, name) = (&settled.channel, of::MAIN_SPINDLE, of::MAIN_SPINDLE_NAME);
    let at = |place| channel.set_by(place).and_then(|s| s.at.clone());
    let mut spindles = names.named.iter().filter(|n| n.spindle);
    let listed = Some(channel.get(number)).filter(|n| *n != 0);
    if let Some(unknown) = listed.filter(|n| !spindles.clone().any(|s| s.number == *n)) {
        let message = format!(
            "main_spindle_ax_nr: no spindle of the channel has the logical number {unknown}"
        );
        let hint = "write a number given in spindel[i].log_achs_nr";
        diagnostics.push(error(Condition::ListLink, message, at(number.place())).hint(hint));
        return;
    }
    let named = channel.set_by(name);
    // a list that states neither uses the first spindle with its own name
    if named.is_none() && listed.is_none() {
        return;
    }
    let text = channel.get(name).unwrap_or_default();
    let source = at(name.place()).or_else(|| at(number.place()));
    if !text.to_ascii_uppercase().starts_with('S') {
        let message = format!("main_spindle_name: {text} does not begin with S");
        diagnostics.push(error(Condition::SpindleName, message, source));
        return;
    }
    let main = listed.or_else(|| spindles.clone().next().map(|n| n.number));
    let other = |n: &&Named| Some(n.number) != main && n.name.eq_ignore_ascii_case(&text);
    if let Some(other) = spindles.find(other) {
        let message = format!("main_spindle_name: {text} is the name of another spindle");
        let hint = "without main_spindle_name the name is S";
        let diagnostic = error(Condition::MainSpindleName, message, source);
        diagnostics.push(diagnostic.axis(other.number, &*other.name).hint(hint));
    }
}
