//! `X[COMP ON LEAD]`, `X[COMP OFF CROSS PLANE]`, `X[COMP OFF_ALL]`: compensations of an axis.
//!
//! Compensations are not simulated, so there is no compensation offset to be moved out of an axis: the path only stops.
//!
//! Assumption: it also stops with NO_MOVE, because the channel is initialised then; the page does not state it.
//!
//! Source: TF5200 axis compensation, 308729483.

use crate::diag::Condition;
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::step::Sync;
use crate::syntax::ast::{Item, ItemKind, Span};

const KINDS: [&str; 7] = ["BACKLASH", "CROSS", "PLANE", "LEAD", "TEMP", "FRICT", "CROSSTALK"];

impl Decoder {
    /// The words after COMP: 21220 for an invalid combination.
    pub(super) fn axis_compensation(
        &mut self,
        axis: usize,
        items: &[Item],
        span: Span,
    ) -> Outcome<()> {
        let name = self.names.name(axis).to_owned();
        let wrong = |what: String, span| {
            let text = format!("{name}[COMP]: {what}");
            let hint = "write [COMP ON LEAD], [COMP OFF CROSS TEMP] or [COMP OFF_ALL]";
            Err(Fault::new(Condition::TokenUnknown, text, span).hint(hint))
        };
        let (mut switch, mut kinds) = (None, 0);
        for item in items {
            let ItemKind::Flag(word) = &item.kind else {
                if matches!(item.kind, ItemKind::Missing) {
                    continue;
                }
                return wrong("a value".to_owned(), item.span);
            };
            let switches = ["ON", "OFF", "OFF_ALL"].into_iter().find(|name| word.is(name));
            if switches.is_some() && switch.is_none() {
                switch = switches;
            } else if KINDS.iter().any(|kind| word.is(kind)) {
                kinds += 1;
            } else if !word.is("NO_MOVE") {
                return wrong(format!("unexpected `{}`", word.text), item.span);
            }
        }
        match switch {
            None => return wrong("ON, OFF or OFF_ALL is missing".to_owned(), span),
            Some("OFF_ALL") if kinds > 0 => {
                return wrong("OFF_ALL does not take a compensation".to_owned(), span);
            }
            Some(_) => {}
        }
        let text = "axis compensations are not simulated: only the stop of the path is";
        self.report.note_once("COMP", Fault::new(Condition::Fallback, text, span));
        self.sync(Sync::FlushWait);
        Ok(())
    }
}
