//! `#TURN`: settings of turning functions.
//!
//! Source: TF5200 programming manual, settings for turning functions.

use super::keys::arguments;
use super::range::between;
use super::row::{Call, Row};
use crate::diag::Condition;
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::values::number::is_true;

arguments! {
    /// Keys of `#TURN`.
    struct TurnArguments {
        _rot_feed_cpl: Number "ROT_FEED_CPL" in between(0.0, 1.0).whole(), "", "G95 with coupled axes: not available here, no effect";
        _time_in_rev_cpl: Number "TIME_IN_REV_CPL" in between(0.0, 1.0).whole(), "", "G04 S with coupled axes: not available here, no effect";
        tapping_act_pos: Number "TAPPING_ACT_POS" in between(0.0, 1.0).whole(), "", "1 (path follows the actual spindle position in tapping) is not supported (P-CHAN-00761)";
        _tapping_n_cycles: Number "TAPPING_N_CYCLES" in between(0.0, 20.0).whole(), "", "filter of TAPPING_ACT_POS=1";
        thread_cut_act_speed: Number "THREAD_CUT_ACT_SPEED" in between(0.0, 1.0).whole(), "", "1 (G33 follows the actual spindle speed) is not supported (P-CHAN-00834)";
        _thread_cut_n_cycles: Number "THREAD_CUT_N_CYCLES" in between(0.0, 20.0).whole(), "", "filter of THREAD_CUT_ACT_SPEED=1";
        thread_cut_ignore_ov: Number "THREAD_CUT_IGNORE_OV" in between(0.0, 1.0).whole(), "", "1: the override does not act on G33 (P-CHAN-00836)";
        thread_chain: Number "THREAD_CHAIN" in between(0.0, 1.0).whole(), "", "1: consecutive blocks of G33 are one thread without a stop (P-CHAN-00837)";
    }
}

/// Row of `#TURN`.
pub(super) const TURN: Row = Row::run("TURN", turn)
    .form("#TURN [THREAD_CUT_IGNORE_OV=0|1 THREAD_CHAIN=0|1]")
    .meaning("how G33 threads respond to the override, and whether consecutive ones are joined")
    .keys(TurnArguments::KEYS)
    .example("#TURN [THREAD_CHAIN=1]")
    .related(&["G33", "K-0132", "P-CHAN-00836", "P-CHAN-00837"]);

/// `#TURN [..]`: an omitted key keeps its value.
fn turn(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    call.no_more_words()?;
    let group = call.command.groups.first();
    if group.is_none_or(|g| g.items.is_empty()) {
        let text = "#TURN needs its settings in brackets";
        return Err(Fault::new(Condition::TokenUnknown, text, call.span()));
    }
    let keys = TurnArguments::read(decoder, &call.title(), group)?;
    let simulated = [
        ("TAPPING_ACT_POS", keys.tapping_act_pos),
        ("THREAD_CUT_ACT_SPEED", keys.thread_cut_act_speed),
    ];
    for (name, key) in simulated {
        if let Some((x, span)) = key
            && is_true(x)
        {
            return Err(Fault::unsupported(format!("#TURN [{name}=1]"), span));
        }
    }
    // a thread in progress is completed with its previous settings
    decoder.end_thread();
    let modes = &mut decoder.motion.threads.turning;
    if let Some((x, _)) = keys.thread_cut_ignore_ov {
        modes.ignore_override = is_true(x);
    }
    if let Some((x, _)) = keys.thread_chain {
        modes.chain = is_true(x);
    }
    Ok(())
}
