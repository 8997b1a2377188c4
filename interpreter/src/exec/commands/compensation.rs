//! `#TRC`, `#TANGFEED`: options of tool radius compensation.
//!
//! Source: TF5200 programming manual, programmable additional options of TRC.

use super::keys::arguments;
use super::range::between;
use super::row::{Call, Row};
use crate::diag::{Condition, ValueKind};
use crate::exec::block::choice::Compensation;
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::values::number::LARGEST_MM;
use crate::syntax::ast::{Item, ItemKind, ItemValue, Span};

/// Value of `TANGENTIAL_LIMIT` without a word, in degrees.
const TANGENTIAL_LIMIT_DEG: f64 = 3.0;

/// Largest `STRETCH_FACTOR` (480140427 of the manual of the kernel).
const STRETCH_MAX: f64 = 9.0;

arguments! {
    /// Keys of `#TRC`.
    struct TrcArguments {
        conv_cir_to_lin: Number "CONV_CIR_TO_LIN" in between(0.0, 1.0).whole(), "", "0; 1 is not supported";
        kerf_masking: Number "KERF_MASKING" in between(0.0, 1.0).whole(), "", "0; 1 is not supported";
        reverse: Number "REVERSE" in between(0.0, 1.0).whole(), "", "1: where a contour reverses, G41 and G42 change without a transverse move; default 0";
        ignore_cont_damage: Number "IGNORE_CONT_DAMAGE" in between(0.0, 1.0).whole(), "", "0; 1 is not supported";
        remove_masked_blocks: Number "REMOVE_MASKED_BLOCKS", "", "0; others are not supported";
        ext_angle: Number "EXT_ANGLE_BLOCK_INTERSECTION", "", "0; others are not supported";
        g236_lin: Number "G236_LIN" in between(0.0, 1.0).whole(), "", "0; 1 is not supported";
        tangential_limit: Number "TANGENTIAL_LIMIT" in between(0.1, 3.0), "deg", "3; others are not supported";
        perpendicular: Number "PERPENDICULAR_RADIUS_CHANGE" in between(0.0, 1.0).whole(), "", "1: a new radius is applied perpendicular to the contour; default 0";
        suppress: Number "SUPPRESS_TRC" in between(0.0, 1.0).whole(), "", "1: G41 and G42 do not calculate a parallel path, the tool follows the contour; only between G40 and G41; default 0";
        online: Number "ONLINE", "", "0; others are not supported";
        inverse: Number "INVERSE", "", "0; 1 is not supported";
        split: Flag "SPLIT", "", "not supported";
        split_path: Flag "SPLIT_PATH", "", "not supported";
        gen_circle: Number "GEN_CIR_BLOCK_IN_CORNER" in between(0.0, 1.0).whole(), "", "0; 1 is not supported";
        stretch: Number "STRETCH_FACTOR", "tool radii", "1 to 9, default 1: extension of the lines of G25 at acute outside corners";
        _split_off: Flag "SPLIT_OFF", "", "as without it";
        ax: Word "AX", "", "of SPLIT";
        axnr: Number "AXNR", "", "of SPLIT";
        combined: Flag "COMBINED", "", "of SPLIT";
        pre: Flag "PRE", "", "of SPLIT";
        post: Flag "POST", "", "of SPLIT";
        dist_seg1: Number "DIST_SEG1", "mm", "of SPLIT";
        feed_seg1: Number "FEED_SEG1", "mm/min", "of SPLIT";
        dist_seg2: Number "DIST_SEG2", "mm", "of SPLIT";
        feed_seg2: Number "FEED_SEG2", "mm/min", "of SPLIT";
    }
}

impl TrcArguments {
    /// The first option that is not simulated.
    fn unsupported(&self) -> Option<(&'static str, Span)> {
        let numbers = [
            ("CONV_CIR_TO_LIN", self.conv_cir_to_lin, 0.0),
            ("KERF_MASKING", self.kerf_masking, 0.0),
            ("IGNORE_CONT_DAMAGE", self.ignore_cont_damage, 0.0),
            ("REMOVE_MASKED_BLOCKS", self.remove_masked_blocks, 0.0),
            ("EXT_ANGLE_BLOCK_INTERSECTION", self.ext_angle, 0.0),
            ("G236_LIN", self.g236_lin, 0.0),
            ("TANGENTIAL_LIMIT", self.tangential_limit, TANGENTIAL_LIMIT_DEG),
            ("GEN_CIR_BLOCK_IN_CORNER", self.gen_circle, 0.0),
            ("ONLINE", self.online, 0.0),
            ("INVERSE", self.inverse, 0.0),
        ];
        let changed = numbers.into_iter().find_map(|(name, key, default)| {
            let (x, span) = key?;
            ((x - default).abs() > 0.0).then_some((name, span))
        });
        let of_numbers =
            [self.axnr, self.dist_seg1, self.feed_seg1, self.dist_seg2, self.feed_seg2];
        let split = [self.split, self.split_path, self.combined, self.pre, self.post]
            .into_iter()
            .chain(of_numbers.into_iter().map(|key| key.map(|(_, span)| span)))
            .chain([self.ax.as_ref().map(|(_, span)| *span)])
            .flatten()
            .next();
        changed.or(split.map(|span| ("SPLIT", span)))
    }
}

/// Row of `#TRC`.
pub(super) const TRC: Row = Row::run("TRC", options)
    .form("#TRC [key=value ..]")
    .meaning(
        "options of tool radius compensation; for most of them only the value at program start is supported",
    )
    .keys(TrcArguments::KEYS)
    .example("#TRC [KERF_MASKING=0]")
    .related(&["G41"]);

fn options(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    call.no_more_words()?;
    let group = call.command.groups.first();
    if group.is_none_or(|g| g.items.is_empty()) {
        let text = "#TRC requires its options in brackets";
        return Err(Fault::new(Condition::TokenUnknown, text, call.span()));
    }
    let keys = TrcArguments::read(decoder, &call.title(), group)?;
    if let Some((name, span)) = keys.unsupported() {
        return Err(Fault::unsupported(format!("#TRC [{name}]"), span));
    }
    if let Some((reverse, _)) = keys.reverse {
        decoder.modal.commanded.turns_back = reverse > 0.0;
    }
    if let Some((perpendicular, _)) = keys.perpendicular {
        decoder.modal.commanded.perpendicular_change = perpendicular > 0.0;
    }
    if let Some((suppress, span)) = keys.suppress {
        if decoder.modal.compensation != Compensation::Off {
            let what = "#TRC [SUPPRESS_TRC] between G41 or G42 and G40";
            return Err(Fault::unsupported(what, span));
        }
        decoder.modal.commanded.compensation_suppressed = suppress > 0.0;
    }
    if let Some((factor, span)) = keys.stretch {
        decoder.modal.commanded.corner_stretch = factor;
        if !(1.0..=STRETCH_MAX).contains(&factor) {
            let text = format!("#TRC [STRETCH_FACTOR={factor}], allowed: 1 to 9; 1 is used");
            let fault = Fault::new(Condition::StretchFactor, text, span);
            decoder.report.note(fault.with(|d| d.value(ValueKind::Wrong, factor, "-")));
            decoder.modal.commanded.corner_stretch = 1.0;
        }
    }
    Ok(())
}

arguments! {
    /// Keys of `#TANGFEED`.
    struct TangfeedArguments {
        rmin: Number "RMIN", "mm (G70: inch)", "arcs of a smaller radius keep F at the tool's centre; default 0";
    }
}

/// Row of `#TANGFEED`.
pub(super) const TANGFEED: Row = Row::run("TANGFEED", tangential_feed)
    .form("#TANGFEED [RMIN=..]")
    .meaning("smallest radius of the arcs on which F acts at the tool's point of contact (G11)")
    .keys(TangfeedArguments::KEYS)
    .example("#TANGFEED [RMIN=3]")
    .related(&["G11"]);

fn tangential_feed(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    call.no_more_words()?;
    let keys = TangfeedArguments::read(decoder, &call.title(), call.command.groups.first())?;
    if let Some((radius, at)) = keys.rmin {
        set_least_radius(decoder, call, radius, at)?;
    }
    Ok(())
}

/// The smallest radius of the tangential feed rate; 20963 below 0, 20962 outside the data format.
fn set_least_radius(
    decoder: &mut Decoder,
    call: &Call<'_>,
    radius: f64,
    span: Span,
) -> Outcome<()> {
    let radius_mm = radius * decoder.modal.unit_mm();
    let (condition, what) = match radius_mm {
        r if r < 0.0 => (Condition::TangentialRadiusNegative, "is negative"),
        r if r > LARGEST_MM => (Condition::TangentialRadius, "is outside the data format"),
        _ => {
            decoder.modal.commanded.engagement_radius_mm = radius_mm;
            return Ok(());
        }
    };
    let text = format!("{}: the minimum radius {radius} {what}", call.title());
    Err(Fault::new(condition, text, span))
}

/// Row of `#SET TANGFEED RMIN`.
pub(super) const SET_TANGFEED: Row = Row::run("SET TANGFEED RMIN", set_tangential_feed)
    .form("#SET TANGFEED RMIN [radius]")
    .meaning("older form of #TANGFEED")
    .example("#SET TANGFEED RMIN [3]")
    .related(&["#TANGFEED"]);

fn set_tangential_feed(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    call.no_more_words()?;
    let items = call.command.groups.first().map_or(&[][..], |group| &group.items);
    let value = match items {
        [] => 0.0,
        [Item { kind: ItemKind::Value(ItemValue::Expr(expr)), .. }] => decoder.number(expr)?,
        _ => {
            let text = "#SET TANGFEED RMIN: one radius is expected";
            return Err(Fault::new(Condition::TokenUnknown, text, call.span()));
        }
    };
    set_least_radius(decoder, call, value, call.span())
}
