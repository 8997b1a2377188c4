//! Logical numbers and names of axes and spindles: each belongs to one list.

use super::super::kind::logical_number;
use super::super::overrides::OVERRIDE;
use super::super::parameters::Parameters;
use super::super::settled::{AxisList, Settled};
use super::super::table::{axis_general, channel as of, with_indices};
use super::{Named, Names, error, gantry};
use crate::diag::{Condition, Diagnostic};

/// Checks the numbers of the axis lists, the names and numbers of the channel, and the entries of `kontur.lis`.
pub(super) fn check(settled: &Settled, names: &Names, diagnostics: &mut Vec<Diagnostic>) {
    let unnumbered = check_lists(settled, diagnostics);
    // an axis may belong to a list that could not be read or has no number
    let is_explained = unnumbered || diagnostics.iter().any(|d| d.id == Condition::NoList);
    check_names(settled, names, is_explained, diagnostics);
    check_main_spindle(settled, names, diagnostics);
    check_own(settled, names, diagnostics);
    gantry::check(settled, names, diagnostics);
}

/// Numbers that two axis lists have; whether one of them has no number of its own.
fn check_lists(settled: &Settled, diagnostics: &mut Vec<Diagnostic>) -> bool {
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
    unnumbered
}

/// Numbers and names that the channel list gives twice, and numbers without an axis list.
fn check_names(
    settled: &Settled,
    names: &Names,
    is_explained: bool,
    diagnostics: &mut Vec<Diagnostic>,
) {
    for (i, named) in names.named.iter().enumerate() {
        let earlier = &names.named[..i];
        let Named { name, number, .. } = named;
        let mut condition = Condition::ListLink;
        let mut at = &named.at;
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
            at = &named.name_at;
            Some(format!("the name {name} occurs twice in the channel list"))
        } else if !is_explained
            && !settled.axes.iter().any(|l| logical_number(&l.parameters) == *number)
        {
            Some(format!("{name}: axis list with kopf.achs_nr {number} not found"))
        } else {
            None
        };
        if let Some(message) = problem {
            diagnostics.push(error(condition, message, at.clone()).axis(*number, name.as_str()));
        }
    }
}

/// Entries of `kontur.lis` for axes that no list describes.
fn check_own(settled: &Settled, names: &Names, diagnostics: &mut Vec<Diagnostic>) {
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
