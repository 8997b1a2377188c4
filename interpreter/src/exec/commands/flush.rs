//! `#FLUSH` and the conditions under which the channel may be emptied.
//!
//! Source: TF5200 programming manual.

use super::row::{Call, Row};
use crate::exec::decoder::Decoder;
use crate::exec::fault::Outcome;
use crate::exec::step::Sync;
use crate::syntax::ast::Span;

/// Row of `#FLUSH`.
pub(super) const FLUSH: Row = Row::run("FLUSH", flush)
    .bare()
    .form("#FLUSH, #FLUSH CONTINUE, #FLUSH WAIT")
    .meaning("stops at the end of the preceding block; with CONTINUE only if no further blocks are known, and the corner is not contoured")
    .example("#FLUSH WAIT");

/// 120102: a B-spline ends only at its own commands.
pub(super) fn may_flush(decoder: &Decoder, call: &Call<'_>) -> Outcome<()> {
    decoder.contour.may_flush(&call.title(), call.span())
}

/// Neither in a B-spline nor between the two blocks of a contour line.
fn may_flush_here(decoder: &Decoder, what: &str, span: Span) -> Outcome<()> {
    decoder.contour.may_flush(what, span)?;
    decoder.motion.contour_line.may_flush(what, span)
}

impl Decoder {
    /// The implicit `#FLUSH WAIT` of a word.
    pub(in crate::exec) fn flush_before(&mut self, what: &str, span: Span) -> Outcome<()> {
        may_flush_here(self, what, span)?;
        self.sync(Sync::FlushWait);
        Ok(())
    }
}

/// `#FLUSH`, `#FLUSH CONTINUE`, `#FLUSH WAIT`.
fn flush(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    may_flush_here(decoder, &call.title(), call.span())?;
    match call.rest {
        [] => decoder.sync(Sync::Stop),
        [word] if word.is("WAIT") => decoder.sync(Sync::FlushWait),
        // no stop while further blocks are available; the corner is not contoured (207042443)
        [word] if word.is("CONTINUE") => decoder.contour.keep_corner(),
        [first, word, ..] if first.is("WAIT") || first.is("CONTINUE") => {
            return Err(call.unexpected(word));
        }
        [word, ..] => return Err(call.unexpected(word)),
    }
    Ok(())
}
