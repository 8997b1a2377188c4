//! `#JOG`, `#MANUAL LIMITS`: manual mode is refused, after what the manual calls mistakes has been reported.
//!
//! Source: TF5200 diagnosis, 20485 (251737995), 20486 (251742347), 20491 (251759755), 20493 (251764107).

use super::row::{Call, Row};
use crate::diag::{Condition, ValueKind};
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::syntax::ast::{ItemKind, ItemValue};

/// Row of `#JOG`.
pub(super) const JOG: Row = Row::run("JOG", jog);

/// Row of `#MANUAL LIMITS`.
pub(super) const MANUAL_LIMITS: Row = Row::run("MANUAL LIMITS", manual_limits);

/// `#JOG CONT [AX=X FEED1=..]`, `#JOG INCR [AX=X DIST1=.. FEED1=..]`.
fn jog(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    let increments = call.rest.iter().any(|word| word.is("INCR"));
    let of_feed = if increments { Condition::JogFeed } else { Condition::JogFeedContinuous };
    for (key, condition) in [("DIST", Condition::JogStep), ("FEED", of_feed)] {
        signs(decoder, call, key, condition, |value| value >= 0.0)?;
    }
    Err(Fault::unsupported(call.title(), call.span()))
}

/// `#MANUAL LIMITS [AX=X NEGATIVE=.. POSITIVE=..]`.
fn manual_limits(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    signs(decoder, call, "NEGATIVE", Condition::ManualLimit, |value| value <= 0.0)?;
    Err(Fault::unsupported(call.title(), call.span()))
}

/// Every value of a key, which may have a number at its end, has the right sign.
fn signs(
    decoder: &Decoder,
    call: &Call<'_>,
    name: &str,
    condition: Condition,
    is_right: fn(f64) -> bool,
) -> Outcome<()> {
    for item in call.command.groups.iter().flat_map(|group| &group.items) {
        let ItemKind::Pair { key, value: ItemValue::Expr(expr) } = &item.kind else { continue };
        let stem = key.text.trim_end_matches(|c: char| c.is_ascii_digit());
        if !stem.eq_ignore_ascii_case(name) {
            continue;
        }
        let value = decoder.number(expr)?;
        if !is_right(value) {
            let text = format!("{}: {}={value} has the wrong sign", call.title(), key.text);
            return Err(Fault::new(condition, text, item.span)
                .with(|d| d.value(ValueKind::Wrong, value, "-")));
        }
    }
    Ok(())
}
