//! Kinematic transformations: `#TRAFO`, `#RTCP`, `#KIN ID`, `#PTP`, `#ORI MODE`, `#CYL`, `#FACE`, `#TLC`.
//!
//! Source: TF5200 programming manual; 20671, 20875, 21514.

use super::flush::may_flush;
use super::frames;
use super::refused::numbers_of;
use super::row::Call;
use crate::diag::Condition;
use crate::exec::block::choice::Compensation;
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::syntax::ast::ItemKind;

/// `#CYL`, `#FACE`, `#TLC`: refused, after their other errors have been reported.
pub(super) fn kinematic(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    if call.command.on == Some(false) {
        return Ok(());
    }
    if call.name == "TLC" && decoder.modal.compensation != Compensation::Off {
        let text = "#TLC ON while tool radius compensation is active";
        return Err(Fault::new(Condition::LengthWithCompensation, text, call.span()));
    }
    if call.name != "TLC" {
        rotary_surface(decoder, call)?;
    }
    Err(super::refused::refused(decoder, call))
}

/// Errors defined by the manual for `#CYL [Z, C, X60]` and `#FACE [X, C]`: in the axes of the surface, and in the radius of the
/// cylinder given as a word of the third axis.
fn rotary_surface(decoder: &Decoder, call: &Call<'_>) -> Outcome<()> {
    let mut named = Vec::new();
    for item in call.command.groups.iter().flat_map(|group| &group.items) {
        let ItemKind::Flag(word) = &item.kind else { continue };
        let (name, radius) = match word.split_number() {
            Some((name, number)) if decoder.names.of_name(&word.text).is_none() => {
                (name, Some(number))
            }
            _ => (&*word.text, None),
        };
        let Some(axis) = decoder.names.of_name(name) else {
            let text = format!("{}: unknown axis {}", call.title(), word.text);
            let fault = Fault::new(Condition::CommandAxisUnknown, text, word.span);
            return Err(fault.hint(decoder.names.hint()));
        };
        match radius {
            Some(radius) if radius <= 0.0 => {
                let text = format!("{}: the radius {radius} is not valid", call.title());
                return Err(Fault::new(Condition::CylinderRadius, text, word.span));
            }
            Some(_) => {}
            None => named.push(axis),
        }
    }
    let surface = named.get(..2).unwrap_or_default();
    let rotating = surface.iter().filter(|axis| decoder.machine.axes[**axis].is_c_axis()).count();
    let (condition, what) = match (surface.len(), rotating) {
        (2, 0) => (Condition::NoCAxis, "neither axis is a C axis"),
        (2, 2) if call.name == "FACE" => (Condition::TwoCAxes, "both axes are C axes"),
        _ => return Ok(()),
    };
    let text = format!("{}: {what} (kenngr.achs_mode 0x200)", call.title());
    Err(Fault::new(condition, text, call.span()))
}

/// `#TRAFO [OFF]`, `#TRAFO [NONE]` (1133705483).
fn is_off_in_brackets(call: &Call<'_>) -> bool {
    let [group] = &call.command.groups[..] else { return false };
    let [item] = &group.items[..] else { return false };
    matches!(&item.kind, ItemKind::Flag(word) if word.is("OFF") || word.is("NONE"))
        && call.name == "TRAFO"
}

/// `#TRAFO`, `#RTCP`, `#KIN ID`, `#PTP`, `#ORI MODE`: kinematics.
pub(super) fn transformation(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    let off = call.command.on == Some(false) || is_off_in_brackets(call);
    if call.name == "KIN ID" && decoder.geometry.transformation_on {
        let text = "#KIN ID under an active kinematic transformation";
        return Err(Fault::new(Condition::KinematicsWhileActive, text, call.span()));
    }
    if call.name == "TRAFO" {
        may_flush(decoder, call)?;
    }
    if call.name == "PTP" && decoder.modal.compensation != Compensation::Off {
        let text = "#PTP while tool radius compensation is active";
        return Err(Fault::new(Condition::DirectWithCompensation, text, call.span()));
    }
    if call.name == "TRAFO" && decoder.geometry.direct_on && !off {
        let text = "#TRAFO ON while #PTP is active";
        return Err(Fault::new(Condition::TransformationInDirect, text, call.span()));
    }
    if call.name == "ORI MODE" {
        orientation_has_direction(decoder, call)?;
    }
    if call.name == "PTP" {
        decoder.geometry.direct_on = !off;
    }
    if ["TRAFO", "RTCP"].contains(&call.name) {
        if !off {
            frames::no_independent_axis(decoder, call)?;
        }
        decoder.geometry.transformation_on = !off;
    }
    if off {
        return Ok(());
    }
    if decoder.identity_trafo {
        let text =
            format!("{} is treated as the identity: the axes move as programmed", call.title());
        decoder.report.note_once(call.name, Fault::new(Condition::Fallback, text, call.span()));
        return Ok(());
    }
    let hint = "use --identity-trafo to treat transformations as the identity";
    Err(Fault::unsupported(call.title(), call.span()).hint(hint))
}

/// 21514 if the components of the vector are all 0 (255001995).
fn orientation_has_direction(decoder: &Decoder, call: &Call<'_>) -> Outcome<()> {
    let components = numbers_of(decoder, call, ["U", "V", "W"]);
    if components.len() < 3 || components.iter().any(|c| *c != 0.0) {
        return Ok(());
    }
    let text = "#ORI MODE: the vector U, V, W is 0";
    Err(Fault::new(Condition::OrientationZero, text, call.span()))
}
