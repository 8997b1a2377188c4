//! `#CORNER PARAM`: reduction of the feed rate before corners (G13).
//!
//! Source: TF5200 programming manual, parameterising corner deceleration (206444555, 15556729995).

use super::keys::arguments;
use super::range::above_zero;
use super::row::{Call, Row};
use crate::diag::Condition;
use crate::exec::contour::{Corner, CornerFeed};
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::values::number::whole;
use crate::syntax::ast::{ItemKind, ItemValue};

arguments! {
    /// Keys of `#CORNER PARAM`.
    struct CornerArguments {
        dist: Number "DIST" in above_zero(), "mm (G70: inch)", "distance before the end of the motion over which the feed decreases";
        unit: Word "UNIT", "", "of FEED: FWORD as the F word, PERCENT of it";
        feed: Number "FEED" in above_zero(), "", "feed at the corner";
    }
}

/// Row of `#CORNER PARAM`.
pub(super) const CORNER_PARAM: Row = Row::run("CORNER PARAM", corner)
    .form("#CORNER PARAM [DIST=.. UNIT=FWORD|PERCENT FEED=..]")
    .meaning("G13: over the last DIST of every motion the feed decreases linearly along the path, to FEED at its end")
    .note("only with the slope STEP; with the others G13 has no effect")
    .keys(CornerArguments::KEYS)
    .example("#CORNER PARAM [DIST=10 UNIT=PERCENT FEED=50]")
    .related(&["G13", "#SLOPE", "20795"]);

fn corner(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    call.no_more_words()?;
    let group = call.command.groups.first();
    let keys = CornerArguments::read(decoder, &call.title(), group)?;
    let (Some((dist, _)), Some((unit, at)), Some((feed, _))) = (keys.dist, keys.unit, keys.feed)
    else {
        let text = "#CORNER PARAM needs DIST, UNIT and FEED";
        return Err(Fault::new(Condition::TokenUnknown, text, call.span()));
    };
    let percent = match &*unit.to_ascii_uppercase() {
        "PERCENT" => true,
        "FWORD" => false,
        _ => {
            let text = format!("#CORNER PARAM: unknown unit `{unit}`");
            let hint = "write FWORD or PERCENT for UNIT";
            return Err(Fault::new(Condition::TokenUnknown, text, at).hint(hint));
        }
    };
    set(decoder, dist, percent, feed);
    Ok(())
}

/// Row of `#SET CORNER PARAM`.
pub(super) const SET_CORNER_PARAM: Row = Row::run("SET CORNER PARAM", set_corner)
    .form("#SET CORNER PARAM [distance, unit, feed]")
    .meaning("older form of #CORNER PARAM; the unit is 0 (as the F word) or 1 (percent of it)")
    .example("#SET CORNER PARAM [10, 1, 50]")
    .related(&["#CORNER PARAM"]);

fn set_corner(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    call.no_more_words()?;
    let items = call.command.groups.first().map_or(&[][..], |group| &group.items);
    let mut values = Vec::with_capacity(items.len());
    for item in items {
        if let ItemKind::Value(ItemValue::Expr(expr)) = &item.kind {
            values.push(decoder.number(expr)?);
        }
    }
    let [dist, unit, feed] = values[..] else {
        let text = "#SET CORNER PARAM has three values: distance, unit and feed";
        return Err(Fault::new(Condition::TokenUnknown, text, call.span()));
    };
    let Some(unit) = whole(unit, 0, 1).filter(|_| dist > 0.0 && feed > 0.0) else {
        let text = format!("#SET CORNER PARAM [{dist}, {unit}, {feed}]");
        let hint = "write a distance and a feed greater than 0, and the unit 0 or 1";
        return Err(Fault::new(Condition::Range, text, call.span()).hint(hint));
    };
    set(decoder, dist, unit == 1, feed);
    Ok(())
}

fn set(decoder: &mut Decoder, dist: f64, percent: bool, feed: f64) {
    let feed = if percent {
        CornerFeed::Ratio(feed / 100.0)
    } else {
        CornerFeed::MmS(feed * decoder.modal.feed_unit_mm_s(&decoder.machine.channel))
    };
    let dist_mm = dist * decoder.modal.unit_mm();
    decoder.motion.corner = Some(Corner { dist_mm, feed });
}
