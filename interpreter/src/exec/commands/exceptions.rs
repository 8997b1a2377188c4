//! Commands that flush the channel, which tool radius compensation does not permit.
//!
//! Source: exception list of commands with active TRC (524821515); 20651 (252112267), 90050 (261738891).

use super::row::Call;
use crate::diag::Condition;
use crate::exec::block::choice::Compensation;
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};

/// Commands of the list that have no check of their own between G41 or G42 and G40.
const UNCHECKED: &[&str] =
    &["CAX", "CLEAR CONFIG", "CYL", "FACE", "SET AX LINK", "TRACK CS", "TRAFO"];

/// Further commands of the list that do not flush the channel here.
const OTHERS: &[&str] = &[
    "AX DEF",
    "AX LINK",
    "CS",
    "CS MODE",
    "LOAD CONFIG",
    "MCS",
    "MCS TO WCS",
    "PTP",
    "WCS TO MCS",
];

/// 20651 while compensation is active, 90050 between G40 and the motion that ends it.
pub(super) fn fits_compensation(decoder: &Decoder, call: &Call<'_>) -> Outcome<()> {
    let unchecked = UNCHECKED.contains(&call.name);
    if unchecked && decoder.modal.compensation != Compensation::Off {
        let text = format!("{} while tool radius compensation is active", call.title());
        return Err(Fault::new(Condition::FlushWithCompensation, text, call.span()));
    }
    if (unchecked || OTHERS.contains(&call.name)) && decoder.contour.awaits_departure() {
        let text = format!("{} before the motion that ends tool radius compensation", call.title());
        return Err(Fault::new(Condition::FlushAfterCompensation, text, call.span()));
    }
    Ok(())
}
