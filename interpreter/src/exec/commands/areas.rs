//! `#CONTROL AREA`: workspaces and protection areas.
//!
//! Source: TF5200 programming manual (207565195, 207571851); START for BEGIN in older manuals (tccncprogramming
//! 15557061259); 21286.

use super::keys::arguments;
use super::range::between;
use super::row::{Call, Row};
use crate::diag::Condition;
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::geometry::area::Purpose;
use crate::exec::motion::state::areas::Heading;
use crate::exec::values::number::whole;
use crate::machine::Axis;

/// Highest ID of an area.
///
/// Assumption: IDs range from 1 to 20, because a channel has 20 areas; the documents print no range.
const ID_MAX: f64 = 20.0;

arguments! {
    /// Keys of `#CONTROL AREA BEGIN`.
    struct AreaArguments {
        id: Number "ID" in between(0.0, ID_MAX).whole().or(Condition::AreaId), "", "from 1";
        work: Flag "WORK", "", "the tool stays in the area";
        prot: Flag "PROT", "", "the tool does not touch the area";
        poly: Flag "POLY", "", "a closed contour of lines follows";
        circ: Flag "CIRC", "", "a full circle follows";
        low: Number "MIN_EXCUR", "mm, inch", "lower end in the third axis";
        high: Number "MAX_EXCUR", "mm, inch", "upper end in the third axis";
        height_axis: Word "EXCUR_AX", "", "the third axis, by default that of the plane";
        height_number: Number "EXCUR_AXNR", "", "the same by its logical number";
        _level: Number "MONITOR_LVL", "", "not simulated";
    }
}

arguments! {
    /// Keys of `#CONTROL AREA ON` and `OFF`.
    struct AreaChoice {
        id: Number "ID" in between(1.0, ID_MAX).whole().or(Condition::AreaId), "", "";
        all: Flag "ALL", "", "the bracket may be omitted";
    }
}

/// Row of `#CONTROL AREA BEGIN`.
pub(super) const CONTROL_AREA_BEGIN: Row = Row::run("CONTROL AREA BEGIN", begin)
    .form("#CONTROL AREA BEGIN [ID=.. WORK|PROT POLY|CIRC MIN_EXCUR=.. MAX_EXCUR=..]")
    .meaning("the blocks up to #CONTROL AREA END define the contour of a workspace or protection area, without motion")
    .keys(AreaArguments::KEYS)
    .note("lines in G90 ending at the first point (POLY), or a point and a full circle (CIRC)")
    .example("#CONTROL AREA BEGIN [ID=1 WORK POLY MIN_EXCUR=-50 MAX_EXCUR=50]")
    .related(&["120484", "120477", "K-0147"]);

/// Row of `#CONTROL AREA START`.
pub(super) const CONTROL_AREA_START: Row = Row::run("CONTROL AREA START", begin);

/// Row of `#CONTROL AREA END`.
pub(super) const CONTROL_AREA_END: Row = Row::run("CONTROL AREA END", end).bare();

/// Row of `#CONTROL AREA CLEAR`.
pub(super) const CONTROL_AREA_CLEAR: Row = Row::run("CONTROL AREA CLEAR", clear)
    .form("#CONTROL AREA CLEAR [ID=..], #CONTROL AREA CLEAR ALL")
    .meaning("deletes areas that are not active")
    .keys(AreaChoice::KEYS)
    .example("#CONTROL AREA CLEAR ALL")
    .related(&["120499"]);

/// Row of `#CONTROL AREA`.
pub(super) const CONTROL_AREA: Row = Row::run("CONTROL AREA", switch)
    .form("#CONTROL AREA ON|OFF [ID=..], #CONTROL AREA ON|OFF ALL")
    .meaning("monitors workspaces and protection areas: a motion that violates one aborts the program")
    .keys(AreaChoice::KEYS)
    .note("OFF alone switches off the area switched on last; contouring, #HSC and splines are refused while an area is active")
    .example("#CONTROL AREA ON ALL")
    .related(&["120484", "120742", "K-0147"]);

fn begin(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    call.no_more_words()?;
    let span = call.span();
    let title = call.title();
    let keys = AreaArguments::read(decoder, &title, call.command.groups.first())?;
    let missing = |what: &str| {
        let text = format!("{title}: {what} is missing");
        Fault::new(Condition::AreaWrong, text, span)
    };
    let Some((number, at)) = keys.id else { return Err(missing("ID")) };
    if number == 0.0 {
        let text = format!("{title}: ID=0 is not a valid area");
        return Err(Fault::new(Condition::AreaIdZero, text, at));
    }
    let purpose = match (keys.work, keys.prot) {
        (Some(_), None) => Purpose::Workspace,
        (None, Some(_)) => Purpose::Protection,
        _ => return Err(missing("one of WORK and PROT")),
    };
    let circle = match (keys.poly, keys.circ) {
        (Some(_), None) => false,
        (None, Some(_)) => true,
        _ => return Err(missing("one of POLY and CIRC")),
    };
    let (Some((low, _)), Some((high, at))) = (keys.low, keys.high) else {
        return Err(missing("MIN_EXCUR or MAX_EXCUR"));
    };
    if low >= high {
        let text = format!("{title}: MIN_EXCUR={low} is not below MAX_EXCUR={high}");
        return Err(Fault::new(Condition::AreaWrong, text, at));
    }
    let unit = decoder.modal.unit_mm();
    let height = match (&keys.height_axis, keys.height_number) {
        (Some((name, at)), _) => Some((decoder.names.of_name(name), name.to_string(), *at)),
        (None, Some((number, at))) => {
            let is = |axis: &Axis| whole(number, 0, u32::MAX) == Some(axis.number());
            Some((decoder.machine.axes.iter().position(is), number.to_string(), at))
        }
        (None, None) => None,
    };
    if let Some((None, name, at)) = height {
        let text = format!("the channel has no axis {name}");
        return Err(Fault::new(Condition::AxisNameUnknown, text, at));
    }
    let height_axis = height.and_then(|(axis, ..)| axis);
    decoder.motion.areas.begin(
        Heading {
            number: number as u32,
            purpose,
            circle,
            low_mm: low * unit,
            high_mm: high * unit,
            height_axis,
            span,
        },
        &decoder.modal,
        decoder.geometry.coordinates.target(),
    )
}

fn end(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    call.no_more_words()?;
    decoder.motion.end_area(
        &mut decoder.geometry,
        &decoder.modal,
        &decoder.names,
        &mut decoder.report,
        call.span(),
    )
}

/// ALL, and the ID.
fn chosen(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<(bool, Option<u32>)> {
    let keys = AreaChoice::read(decoder, &call.title(), call.command.groups.first())?;
    let mut all = keys.all.is_some();
    for word in call.rest.iter().chain(&call.command.tail) {
        if !word.is("ALL") || std::mem::replace(&mut all, true) {
            return Err(call.unexpected(word));
        }
    }
    Ok((all, keys.id.map(|(number, _)| number as u32)))
}

/// 120499 for an active area, which stays (diagnosis 264885387).
fn clear(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    let (all, number) = chosen(decoder, call)?;
    if all == number.is_some() {
        let text = "#CONTROL AREA CLEAR needs ALL or an ID";
        return Err(Fault::new(Condition::AreaWrong, text, call.span()));
    }
    for number in decoder.motion.areas.clear(number) {
        let text = format!("control area {number} is active: it is not deleted");
        let fault = Fault::new(Condition::AreaActive, text, call.span());
        decoder.report.note(fault.hint("write #CONTROL AREA OFF before it"));
    }
    Ok(())
}

fn switch(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    let span = call.span();
    let (all, number) = chosen(decoder, call)?;
    match (call.command.on, all, number) {
        (Some(true), true, None) | (Some(true), false, Some(_)) => {
            let tip = decoder.geometry.tip(decoder.geometry.coordinates.target());
            decoder.motion.areas.switch_on(number, &tip, &decoder.names, span)
        }
        (Some(false), true, None) => {
            decoder.motion.areas.switch_all_off();
            Ok(())
        }
        (Some(false), false, _) => {
            decoder.motion.areas.switch_off(number);
            Ok(())
        }
        _ => {
            let text = "#CONTROL AREA needs ON or OFF with ALL or an ID, BEGIN or END";
            Err(Fault::new(Condition::AreaWrong, text, span))
        }
    }
}
