//! The main spindle: `#MAIN SPINDLE`.
//!
//! Source: TF5200 programming manual, changing the main spindle; P-CHAN-00051, P-CHAN-00053.

use super::row::{Call, Row};
use crate::diag::Condition;
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::motion::spindles::listed_main;
use crate::exec::values::number::whole;
use crate::machine::Axis;
use crate::syntax::ast::{ItemKind, ItemValue, Span};

/// Row of `#MAIN SPINDLE`.
pub(super) const MAIN_SPINDLE: Row = Row::run("MAIN SPINDLE", main_spindle).several().values()
    .form("#MAIN SPINDLE [name|logical number]   #MAIN SPINDLE")
    .meaning("makes another spindle of the channel the main spindle, addressed by S and M3 to M19")
    .note("without a bracket: the spindle of P-CHAN-00051; speeds and rotation of every spindle stay as they are; not in tapping or under G96")
    .example("#MAIN SPINDLE [S2]")
    .related(&["M03", "P-CHAN-00051", "P-CHAN-00053"]);

fn main_spindle(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    call.no_more_words()?;
    let wrong = |text: &str, span: Span| Fault::new(Condition::TokenUnknown, text, span);
    match (&call.command.groups[..], &call.command.arguments[..]) {
        ([], []) => {
            let index = listed_main(&decoder.motion.spindles, &decoder.machine);
            change(decoder, index, call.span())
        }
        ([group], []) => {
            let [item] = &group.items[..] else {
                return Err(wrong("#MAIN SPINDLE needs one spindle", group.span));
            };
            let index = match &item.kind {
                ItemKind::Flag(name) => {
                    let mut spindles = decoder.motion.spindles.iter();
                    spindles.position(|s| s.name.eq_ignore_ascii_case(&name.text))
                }
                ItemKind::Value(ItemValue::Expr(expr)) => {
                    let number = whole(decoder.number(expr)?, 1, u32::from(u16::MAX));
                    let number =
                        |i: usize| decoder.machine.spindles.get(i).map(Axis::number) == number;
                    decoder.motion.spindles.iter().position(|s| s.index.is_some_and(number))
                }
                _ => {
                    return Err(wrong(
                        "#MAIN SPINDLE: a name or a logical number is expected",
                        item.span,
                    ));
                }
            };
            let Some(index) = index else {
                let names: Vec<&str> =
                    decoder.motion.spindles.iter().map(|s| s.name.as_str()).collect();
                let hint = format!("spindles of the channel: {}", names.join(", "));
                let text = "#MAIN SPINDLE: the channel has no such spindle";
                return Err(Fault::new(Condition::MainSpindleUnknown, text, item.span).hint(hint));
            };
            change(decoder, index, item.span)
        }
        _ => Err(wrong("#MAIN SPINDLE needs one spindle in brackets, or nothing", call.span())),
    }
}

/// Makes a spindle the main one, which is the first in the list.
fn change(decoder: &mut Decoder, index: usize, span: Span) -> Outcome<()> {
    if index != 0 {
        decoder.motion.keeps_main_spindle(&decoder.modal, span)?;
        decoder.motion.spindles.swap(0, index);
    }
    Ok(())
}
