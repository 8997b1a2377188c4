//! `#OTC`: wear of a grinding wheel during the motion.
//!
//! Source: TF5200 online tool compensation, programming (213655947).

use super::keys::arguments;
use super::range::{at_least, between};
use super::row::{Call, Row};
use crate::diag::Condition;
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::geometry::tools::WEAR_UNIT;
use crate::exec::motion::state::wear::WearSource;
use crate::exec::step::Event;
use crate::syntax::ast::Span;

arguments! {
    /// Keys of `#OTC`.
    struct WearArguments {
        radius: Flag "RADIUS", "", "wear of the radius, towards the contour of G41 and G42";
        length: Flag "LENGTH", "", "wear of the length (default)";
        tool_dir: Flag "TOOL_DIR", "", "not supported";
        surface: Flag "SURF_NORM_DIR", "", "not supported";
        disc: Flag "DISC", "", "external wear: the input wear_mm";
        cont: Flag "CONT", "", "wear by the distance travelled";
        auto: Flag "AUTO", "", "both (default)";
        wear_const: Number "WEAR_CONST" in at_least(0.0), "0.1 um/m", "wear per distance; default: value of the tool (P-TOOL-00030)";
        wear_const_tool: Flag "WEAR_CONST_TOOL", "", "restores the value of the tool";
        acc_weight: Number "ACC_WEIGHT" in between(1.0, 100.0), "%", "acceleration used to follow a change of the wear; default 100";
    }
}

/// Row of `#OTC`.
pub(super) const OTC: Row = Row::run("OTC", wear)
    .form("#OTC ON|OFF [RADIUS|LENGTH DISC|CONT|AUTO WEAR_CONST=.. ACC_WEIGHT=..]")
    .meaning("online compensation of grinding wheel wear; the bracket alone sets the initial values for ON")
    .keys(WearArguments::KEYS)
    .note("the wear appears in X_add_mm of the axes, not in the contour; wear_mm of --input replaces that of the PLC")
    .example("#OTC ON [RADIUS DISC]")
    .related(&["21391", "P-TOOL-00030", "P-TOOL-00031"]);

fn wear(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    call.no_more_words()?;
    let keys = WearArguments::read(decoder, &call.title(), call.command.groups.first())?;
    let other = [("TOOL_DIR", keys.tool_dir), ("SURF_NORM_DIR", keys.surface)];
    if let Some((name, span)) = other.into_iter().find_map(|(name, key)| Some((name, key?))) {
        return Err(Fault::unsupported(format!("#OTC [{name}]"), span));
    }
    one_of(&[("RADIUS", keys.radius), ("LENGTH", keys.length)])?;
    one_of(&[("DISC", keys.disc), ("CONT", keys.cont), ("AUTO", keys.auto)])?;
    one_of(&[
        ("WEAR_CONST", keys.wear_const.map(|(_, span)| span)),
        ("WEAR_CONST_TOOL", keys.wear_const_tool),
    ])?;
    let mut setting = decoder.motion.wear;
    let refused = match (call.command.on, setting.on) {
        (Some(false), false) => Some((Condition::WearNotOn, "OFF without ON")),
        (Some(true), true) => Some((Condition::WearOnTwice, "ON while it is on")),
        (None, true) => Some((Condition::WearSetWhileOn, "settings while it is on")),
        _ => None,
    };
    if let Some((condition, what)) = refused {
        return Err(Fault::new(condition, format!("#OTC: {what}"), call.span()));
    }
    if keys.radius.or(keys.length).is_some() {
        setting.radius = keys.radius.is_some();
    }
    setting.source = match (keys.disc, keys.cont, keys.auto) {
        (Some(_), _, _) => WearSource::Outside,
        (_, Some(_), _) => WearSource::Way,
        (_, _, Some(_)) => WearSource::Both,
        (None, None, None) => setting.source,
    };
    match keys.wear_const {
        Some((constant, _)) => setting.ratio = Some(constant * WEAR_UNIT),
        None if keys.wear_const_tool.is_some() => setting.ratio = None,
        None => {}
    }
    if let Some((percent, _)) = keys.acc_weight {
        setting.acceleration_ratio = percent / 100.0;
    }
    match call.command.on {
        Some(on) => setting.on = on,
        None if call.command.groups.is_empty() => {
            let text = "#OTC needs ON, OFF or its settings";
            return Err(Fault::new(Condition::TokenUnknown, text, call.span()));
        }
        None => {}
    }
    let ends = decoder.motion.wear.on && !setting.on;
    decoder.motion.wear = setting;
    if ends {
        decoder.contour.event(Event::Wear(None));
    }
    // after an error the function counts as on, so that OFF does not cause a second error
    decoder.motion.apply_wear(&decoder.geometry, &decoder.modal, &mut decoder.contour, call.span())
}

/// Two exclusive words.
fn one_of(words: &[(&str, Option<Span>)]) -> Outcome<()> {
    let mut written = words.iter().filter_map(|(name, span)| Some((name, (*span)?)));
    match (written.next(), written.next()) {
        (Some((first, a)), Some((second, b))) => {
            let text = format!("#OTC: {first} and {second} cannot be combined");
            let at = if a.start > b.start { a } else { b };
            Err(Fault::new(Condition::TokenUnknown, text, at))
        }
        _ => Ok(()),
    }
}
