//! `#SAVE CONFIG`, `#LOAD CONFIG`, `#CLEAR CONFIG`: axes and axis couplings of the channel, for a program that retracts the
//! tool after a reset.
//!
//! Source: TF5200 programming manual (207542155, 15557055627, 15557057163); 21274, 21275, 21277.

use super::keys::arguments;
use super::row::{Call, Row};
use crate::diag::Condition;
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::program::state::SavedConfiguration;

arguments! {
    /// Keys of `#SAVE CONFIG` and `#LOAD CONFIG`.
    struct ConfigurationArguments {
        axes: Flag "AX", "", "the axes of the channel";
        couplings: Flag "AXLINK", "", "the axis couplings that are switched on";
    }
}

/// Row of `#SAVE CONFIG`.
pub(super) const SAVE_CONFIG: Row = Row::run("SAVE CONFIG", save)
    .form("#SAVE CONFIG [AX AXLINK]")
    .meaning("records that a configuration exists for #LOAD CONFIG")
    .keys(ConfigurationArguments::KEYS)
    .example("#SAVE CONFIG [AX]")
    .related(&["#LOAD CONFIG"]);

/// Row of `#LOAD CONFIG`.
pub(super) const LOAD_CONFIG: Row = Row::run("LOAD CONFIG", load)
    .form("#LOAD CONFIG [AX AXLINK]")
    .meaning(
        "restores axes and couplings: not supported; errors defined by the manual are reported first",
    )
    .keys(ConfigurationArguments::KEYS)
    .note("a run starts without data saved by earlier programs")
    .related(&["#SAVE CONFIG", "21274", "21275", "21277"]);

/// Row of `#CLEAR CONFIG`.
pub(super) const CLEAR_CONFIG: Row = Row::run("CLEAR CONFIG", clear)
    .bare()
    .form("#CLEAR CONFIG")
    .meaning("discards what #SAVE CONFIG has saved")
    .example("#CLEAR CONFIG")
    .related(&["#SAVE CONFIG"]);

fn save(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    call.no_more_words()?;
    let group = call.command.groups.first();
    let keys = ConfigurationArguments::read(decoder, &call.title(), group)?;
    decoder.calls.saved.axes |= keys.axes.is_some();
    decoder.calls.saved.couplings |= keys.couplings.is_some();
    Ok(())
}

fn load(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    call.no_more_words()?;
    let group = call.command.groups.first();
    let keys = ConfigurationArguments::read(decoder, &call.title(), group)?;
    let (title, saved) = (call.title(), decoder.calls.saved);
    if !decoder.motion.couplings.are_off() {
        let text = format!("{title} while an axis coupling is switched on");
        return Err(Fault::new(Condition::LoadWhileCoupled, text, call.span()));
    }
    if let (Some(span), false) = (keys.axes, saved.axes) {
        let text = format!("{title}: no axes have been saved");
        return Err(Fault::new(Condition::NoSavedAxes, text, span));
    }
    if let (Some(span), false) = (keys.couplings, saved.couplings) {
        let text = format!("{title}: no axis couplings have been saved");
        return Err(Fault::new(Condition::NoSavedCouplings, text, span));
    }
    Err(Fault::unsupported(title, call.span()))
}

fn clear(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    call.no_more_words()?;
    decoder.calls.saved = SavedConfiguration::default();
    Ok(())
}
