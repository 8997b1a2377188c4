//! Gantry couplings of the lists: which axes may be master and slave, and what the slave takes over.
//!
//! Source: TF5200 gantry operation, master axis (285690635) and slave axis (285697291); diagnosis 253230731, 260115595,
//! 260298379, 263000971.

use super::super::kind::{logical_number, mode};
use super::super::parameters::Parameters;
use super::super::settled::Settled;
use super::super::table::axis_general::{GANTRY_MASTER, KIND, MODE};
use super::super::table::param::Place;
use super::super::value::Value;
use super::{Names, error};
use crate::diag::{Condition, Diagnostic, Severity};

/// 21020 and 110342 for axes of the channel with a master, K-0031 for slaves without one, and the warnings about
/// parameters in which both sides of a coupling have to agree.
pub(super) fn check(settled: &Settled, names: &Names, diagnostics: &mut Vec<Diagnostic>) {
    let list = |number: u32| {
        let lists = settled.axes.iter().map(|list| &list.parameters);
        lists.into_iter().find(|p| logical_number(p) == number)
    };
    let at = |list: &Parameters, place: Place| list.set_by(place).and_then(|s| s.at.clone());
    for named in &names.named {
        let Some(axis) = list(named.number) else { continue };
        let (bits, master) = (axis.get(MODE), axis.get(GANTRY_MASTER));
        let name = &named.name;
        let (condition, message) = if master != 0 && bits & mode::GANTRY_MASTER != 0 {
            let text = format!("{name} is a gantry master and is itself a slave of {master}");
            (Condition::GantryMasterOfMaster, text)
        } else if master != 0 || bits & mode::GANTRY_SLAVE != 0 {
            let text = format!("{name} is a gantry slave and also an axis of the channel");
            (Condition::GantrySlaveInChannel, text)
        } else {
            continue;
        };
        let place = if master != 0 { GANTRY_MASTER.place() } else { MODE.place() };
        diagnostics.push(error(condition, message, at(axis, place)).axis(named.number, &**name));
    }
    for (number, name) in &names.slaves {
        let Some(slave) = list(*number) else { continue };
        let number_of_master = slave.get(GANTRY_MASTER);
        let known = names.named.iter().find(|n| n.number == number_of_master);
        let Some((known, master)) = known.zip(list(number_of_master)) else {
            let message = format!(
                "{name}: the gantry master {number_of_master} is not an axis of the channel"
            );
            diagnostics
                .push(error(Condition::ListLink, message, None).axis(*number, name.as_str()));
            continue;
        };
        let mut about = |condition, message: String, at| {
            let diagnostic = error(condition, message, at).severity(Severity::Warning);
            diagnostics.push(diagnostic.axis(*number, name.as_str()));
        };
        if master.get(MODE) & mode::GANTRY_MASTER == 0 {
            let message = format!("{} has the gantry slave {name}", known.name);
            about(Condition::GantryMasterUnmarked, message, at(master, MODE.place()));
        }
        if is_modulo(slave) != is_modulo(master) || slave.get(KIND) != master.get(KIND) {
            let message = format!("{name} counts like its gantry master {}", known.name);
            about(Condition::GantryModulo, message, at(slave, MODE.place()));
        }
    }
}

fn is_modulo(axis: &Parameters) -> bool {
    axis.get(MODE) & mode::MODULO != 0
}

/// Gives a slave the kind and mode of its master.
pub(super) fn take_over(slave: &mut Parameters, master: &Parameters) {
    for param in [KIND, MODE] {
        let Place { row, indices } = param.place();
        let at = slave.set_by(param).and_then(|s| s.at.clone());
        slave.set(row, indices, Value::Number(f64::from(master.get(param))), at);
    }
}
