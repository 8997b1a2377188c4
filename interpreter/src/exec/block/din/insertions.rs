//! Chamfers and roundings of a block: G301, G302, `#CHR`, `#CHF`, `#RND` with `#FRC`.

use crate::diag::Condition;
use crate::exec::block::collected::{Placed, Words};
use crate::exec::block::groups::{Act, Group};
use crate::exec::block::modal::Modal;
use crate::exec::contour::insertion::{Insertion, Kind};
use crate::exec::fault::{Fault, Outcome};
use crate::exec::geometry::Geometry;
use crate::exec::motion::state::MotionState;
use crate::exec::output::Output;
use crate::exec::report::Report;
use crate::exec::values::number::LARGEST_MM;
use crate::machine::Channel;
use crate::syntax::ast::Span;

/// `#CHR`, `#CHF` and `#RND` in a motion apply to the corner at its end; as separate blocks they lie between two motions.
///
/// Source: TF5200 diagnosis 256490379 (`#ANG=30 #RND=3 Z25`).
pub(super) fn inserts_after(words: &Words<'_>) -> bool {
    let of_corner = |name: &str| matches!(name, "CHR" | "CHF" | "RND");
    // an arc may return to its start, or have an angle instead of its end
    let moves = !words.axes.is_empty()
        || words.centre.iter().any(Option::is_some)
        || words.hashes.iter().any(|(hash, _, _)| &*hash.name == "CANG");
    moves && words.hashes.iter().any(|(hash, _, _)| of_corner(&hash.name))
}

/// A chamfer or rounding that a block requests: kind, size in mm, place.
type Request = (Kind, f64, Span);

/// What is said of a key of the block that requests no insertion, if it has no effect beside these words.
fn without_use(name: &str, words: &Words<'_>, span: Span) -> Option<Box<Fault>> {
    match name {
        "SUPPRESS OFFSETS" if words.axes.is_empty() => {
            // 207072907: not modal, together with the words of a motion
            let text = "#SUPPRESS OFFSETS without an axis word has no effect: it is not modal";
            let fault = Fault::new(Condition::Odd, text, span).warning();
            Some(fault.hint("write it in the block of the motion: #SUPPRESS OFFSETS X10"))
        }
        "PSET"
        | "PRESET"
        | "SUPPRESS OFFSETS"
        | "SCALE"
        | "SCALE ON"
        | "SCALE OFF"
        | "ANG"
        | "CANG"
        | "AKIMA STARTVECTOR"
        | "AKIMA ENDVECTOR"
        | "SET ASPLINE STARTTANG"
        | "SET ASPLINE ZIELTANG" => None,
        "ACHSE" if words.group(Group::Manual).is_some() => None,
        "ACHSE" => {
            let text = "#ACHSE without G200, G201 or G202";
            Some(Fault::new(Condition::AxesWithoutManual, text, span))
        }
        other => Some(Fault::unsupported(format!("#{other}"), span)),
    }
}

impl Modal {
    /// The chamfer or rounding of a block, between the motions before and after it.
    pub(super) fn insertions(
        &mut self,
        words: &Words<'_>,
        geometry: &Geometry,
        motion: &MotionState,
        output: &mut Output<'_>,
    ) {
        let on = insertions_are_on(geometry, &output.machine.channel, words);
        if output.report.keep(on).is_none() {
            return;
        }
        let by_function = self.insertion(words, output.report);
        let (request, feed) = self.insertion_by_command(words, by_function, output.report);
        if let Some((kind, size, at)) = request {
            let feed = feed.map(|(value, at)| {
                motion.feed_from((value, self.unit_mm()), &geometry.coordinates, self, output, at)
            });
            let feed = feed.and_then(|feed| output.report.keep(feed));
            let source = output.report.source;
            let insertion = Insertion { kind, size_mm: size, feed, span: at, source };
            if let Some(fault) = output.contour.insert(insertion) {
                output.report.note(fault);
            }
        } else if let Some((_, at)) = feed {
            let text = "#FRC without chamfer or rounding has no effect";
            output.report.note(Fault::new(Condition::Odd, text, at).warning());
        }
    }

    /// The insertion of `#CHR`, `#CHF` or `#RND`, otherwise that of a G function, and the feed of `#FRC`. Commands without effect
    /// beside the words of the block are noted.
    fn insertion_by_command(
        &self,
        words: &Words<'_>,
        by_function: Option<Request>,
        report: &mut Report,
    ) -> (Option<Request>, Option<Placed>) {
        let mut request = by_function;
        let mut feed = None;
        for (hash, value, span) in &words.hashes {
            let kind = match &*hash.name {
                "FRC" => {
                    feed = value.filter(|v| *v > 0.0).map(|v| (v, *span));
                    if feed.is_none() {
                        let text = "#FRC requires a feed greater than 0";
                        report.note(Fault::new(Condition::Range, text, *span));
                    }
                    continue;
                }
                "CHR" => Kind::Chamfer,
                "CHF" => Kind::ChamferLength,
                "RND" => Kind::Rounding,
                other => {
                    if let Some(fault) = without_use(other, words, *span) {
                        report.note(fault);
                    }
                    continue;
                }
            };
            match value.map(|v| v * self.unit_mm()) {
                Some(size) if size > 0.0 => {
                    if request.replace((kind, size, *span)).is_some() {
                        let text = "two insertions in one block, the last one is used";
                        let condition = Condition::InsertionsWithoutMotion;
                        report.note(Fault::new(condition, text, *span).warning());
                    }
                }
                size => {
                    let text = format!("#{} {}", hash.name, no_size(size));
                    report.note(Fault::new(Condition::Range, text, *span));
                }
            }
        }
        (request, feed)
    }

    /// The insertion of G301 or G302; its size is modal.
    fn insertion(&mut self, words: &Words<'_>, report: &mut Report) -> Option<Request> {
        let mut request = None;
        for g in &words.g {
            let kind = match g.row.act {
                Act::Chamfer => Kind::Chamfer,
                Act::Rounding => Kind::Rounding,
                _ => continue,
            };
            let written = words.centre[0].map(|(i, span)| (i * self.unit_mm(), span));
            if let Some((size, _)) = written {
                self.insertion_mm = Some(size);
            }
            match self.insertion_mm {
                Some(size) if size > LARGEST_MM => {
                    let text = format!("G{}: {size} mm is outside the data format", g.row.number);
                    report.note(Fault::new(Condition::InsertionTooLarge, text, g.span));
                }
                Some(size) if size > 0.0 => request = Some((kind, size, g.span)),
                size => {
                    let text = format!("G{} {}", g.row.number, no_size(size));
                    report.note(Fault::new(Condition::InsertionWithoutSize, text, g.span));
                }
            }
        }
        request
    }
}

/// What is wrong with the size in mm of a chamfer or rounding.
fn no_size(size: Option<f64>) -> String {
    size.map_or("without a size".to_owned(), |mm| {
        format!("with the size {mm} mm: it must be above 0")
    })
}

/// P-CHAN-00273 = 1: omitted values are errors (256603531, 255785355). With `#SCALE` they are refused: its page shows only
/// in pictures whether their sizes are scaled.
fn insertions_are_on(geometry: &Geometry, channel: &Channel, words: &Words<'_>) -> Outcome<()> {
    if !channel.language.no_chamfers && !geometry.scale.is_on() {
        return Ok(());
    }
    let names = ["ANG", "CHR", "CHF", "RND"];
    let by_g = words.group(Group::Insertion).map(|g| (Condition::InsertionsOff, g.span));
    let by_hash = || {
        let found = words.hashes.iter().find(|(hash, _, _)| names.contains(&&*hash.name));
        found.map(|(_, _, span)| (Condition::ContourLinesOff, *span))
    };
    match by_g.or_else(by_hash) {
        None => Ok(()),
        Some((condition, span)) if channel.language.no_chamfers => {
            let text = "chamfers and roundings are switched off (P-CHAN-00273)";
            Err(Fault::new(condition, text, span))
        }
        Some((_, span)) => {
            Err(Fault::unsupported("a chamfer, a rounding or #ANG with #SCALE", span))
        }
    }
}
