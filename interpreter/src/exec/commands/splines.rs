//! `#SPLINE`, `#AKIMA`: Akima splines.
//!
//! Source: TF5200 programming manual, Akima splines.

use super::keys::arguments;
use super::row::{Call, Row};
use crate::diag::{Condition, ValueKind};
use crate::exec::block::collected::Words;
use crate::exec::contour::akima::Akima;
use crate::exec::contour::akima::Transition;
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::report::Report;
use crate::exec::values::number::{LARGEST_MM, whole};
use crate::syntax::ast::{ItemKind, ItemValue, Span};

/// Row of `#SPLINE`.
pub(super) const SPLINE: Row = Row::run("SPLINE", spline).bare()
    .form("#SPLINE ON|OFF")
    .meaning("a curve through the points of the following linear blocks, as G151 and G150")
    .note("the curve begins at the last point before the command; arcs interrupt it tangentially; stops, G00 and tool radius compensation are not allowed; no other words in its block (20450): the vertex of #SPLINE ON X40 Y20 (207209611) belongs in the next block, or after G151")
    .example("#SPLINE ON")
    .related(&["#AKIMA TRANS", "#SPLINE TYPE"]);

/// Row of `#SET SPLINE`.
pub(super) const SET_SPLINE: Row = Row::run("SET SPLINE", spline)
    .bare()
    .form("#SET SPLINE ON|OFF")
    .meaning("older form of #SPLINE")
    .example("#SET SPLINE ON")
    .related(&["#SPLINE"]);

fn spline(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    call.no_more_words()?;
    let Some(on) = call.command.on else {
        let text = "#SPLINE needs ON or OFF";
        return Err(Fault::new(Condition::TokenUnknown, text, call.span()));
    };
    let unused = decoder.contour.akima.select(on, call.span());
    decoder.report.extend(unused);
    Ok(())
}

/// Row of `#SPLINE TYPE`.
pub(super) const SPLINE_TYPE: Row = Row::run("SPLINE TYPE", spline_type)
    .form("#SPLINE TYPE AKIMA")
    .meaning("kind of the splines of #SPLINE ON and G151; B-splines are those of #HSC")
    .example("#SPLINE TYPE AKIMA")
    .related(&["#SPLINE", "#HSC"]);

/// Row of `#SET SPLINETYPE`.
pub(super) const SET_SPLINETYPE: Row = Row::run("SET SPLINETYPE", spline_type)
    .form("#SET SPLINETYPE AKIMA")
    .meaning("older form of #SPLINE TYPE")
    .example("#SET SPLINETYPE AKIMA")
    .related(&["#SPLINE TYPE"]);

fn spline_type(_: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    match call.rest {
        [word] if word.is("AKIMA") => Ok(()),
        [word] if word.is("BSPLINE") => {
            Err(Fault::unsupported(format!("{} BSPLINE", call.title()), call.span()))
        }
        [word, ..] => Err(call.unexpected(word)),
        [] => {
            let text = format!("{} needs AKIMA or BSPLINE", call.title());
            Err(Fault::new(Condition::TokenUnknown, text, call.span()))
        }
    }
}

arguments! {
    /// Keys of `#AKIMA TRANS`.
    struct TransitionArguments {
        start: Word "START", "", "AUTO, TANGENTIAL or USER; default AUTO";
        end: Word "END", "", "AUTO, TANGENTIAL or USER; default AUTO";
    }
}

/// Row of `#AKIMA TRANS`.
pub(super) const AKIMA_TRANS: Row = Row::run("AKIMA TRANS", transitions)
    .form("#AKIMA TRANS [START=AUTO|TANGENTIAL|USER END=..]")
    .meaning("end tangents of splines: computed from their points, taken from the motions before and after, or given by #AKIMA STARTVECTOR and ENDVECTOR")
    .keys(TransitionArguments::KEYS)
    .example("#AKIMA TRANS [START=TANGENTIAL END=AUTO]")
    .related(&["#SPLINE"]);

fn transitions(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    call.no_more_words()?;
    let group = call.command.groups.first();
    let keys = TransitionArguments::read(decoder, &call.title(), group)?;
    let start = transition(keys.start)?;
    let end = transition(keys.end)?;
    let akima = &mut decoder.contour.akima;
    (akima.start.transition, akima.end.transition) = (start, end);
    Ok(())
}

/// Row of `#SET ASPLINE MODE`.
pub(super) const SET_ASPLINE_MODE: Row = Row::run("SET ASPLINE MODE", transitions_by_number)
    .form("#SET ASPLINE MODE [start, end]")
    .meaning("older form of #AKIMA TRANS: 1 AUTO, 2 TANGENTIAL, 3 USER")
    .example("#SET ASPLINE MODE [2, 2]")
    .related(&["#AKIMA TRANS"]);

fn transitions_by_number(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    call.no_more_words()?;
    let items = call.command.groups.first().map_or(&[][..], |group| &group.items);
    let mut found = [Transition::Auto; 2];
    if items.len() > found.len() {
        let text = "#SET ASPLINE MODE has two numbers: start and end";
        return Err(Fault::new(Condition::TokenUnknown, text, call.span()));
    }
    for (transition, item) in found.iter_mut().zip(items) {
        let value = match &item.kind {
            ItemKind::Missing => continue,
            ItemKind::Value(ItemValue::Expr(expr)) => decoder.number(expr)?,
            _ => {
                let text = "#SET ASPLINE MODE: a number is expected";
                return Err(Fault::new(Condition::TokenUnknown, text, item.span));
            }
        };
        *transition = match whole(value, 1, 3) {
            Some(1) => Transition::Auto,
            Some(2) => Transition::Tangential,
            Some(3) => Transition::User,
            _ => {
                let text = format!("#SET ASPLINE MODE: transition {value} does not exist");
                return Err(Fault::new(Condition::SplineTransition, text, item.span)
                    .with(|d| d.value(ValueKind::Current, value, "-"))
                    .hint("write 1 (automatic), 2 (tangential) or 3 (by #AKIMA STARTVECTOR or ENDVECTOR)"));
            }
        };
    }
    let akima = &mut decoder.contour.akima;
    [akima.start.transition, akima.end.transition] = found;
    Ok(())
}

/// An omitted transition is AUTO.
fn transition(written: Option<(Box<str>, Span)>) -> Outcome<Transition> {
    let Some((name, span)) = written else { return Ok(Transition::Auto) };
    let known = [
        ("AUTO", Transition::Auto),
        ("TANGENTIAL", Transition::Tangential),
        ("USER", Transition::User),
    ];
    let found = known.into_iter().find(|(word, _)| name.eq_ignore_ascii_case(word));
    found.map(|(_, transition)| transition).ok_or_else(|| {
        let text = format!("#AKIMA TRANS: unknown transition `{name}`");
        Fault::new(Condition::TokenUnknown, text, span).hint("use AUTO, TANGENTIAL or USER")
    })
}

impl Akima {
    /// `#AKIMA STARTVECTOR X1 Y1`, `#AKIMA ENDVECTOR` and their older names: returns whether the axis words of the block belong
    /// to one of them.
    pub(in crate::exec) fn spline_vectors(
        &mut self,
        words: &Words<'_>,
        report: &mut Report,
    ) -> bool {
        let named =
            |names: [&str; 2]| words.hashes.iter().any(|(hash, _, _)| names.contains(&&*hash.name));
        let start = named(["AKIMA STARTVECTOR", "SET ASPLINE STARTTANG"]);
        let end = named(["AKIMA ENDVECTOR", "SET ASPLINE ZIELTANG"]);
        let vector: Vec<(usize, f64)> =
            words.axes.iter().map(|(axis, value, _)| (*axis, *value)).collect();
        let large = words.axes.iter().find(|(_, value, _)| value.abs() > LARGEST_MM);
        if let (true, Some((_, value, at))) = (start || end, large) {
            let text = format!("the component {value} of a tangent is outside the data format");
            report.note(Fault::new(Condition::SplineParameter, text, *at).with(|d| {
                d.value(ValueKind::Wrong, *value, "-")
                    .value(ValueKind::LowerLimit, -LARGEST_MM, "-")
                    .value(ValueKind::UpperLimit, LARGEST_MM, "-")
            }));
        }
        if (start || end) && vector.iter().all(|(_, value)| *value == 0.0) {
            let named = words.hashes.first().map_or_else(Span::default, |(_, _, span)| *span);
            let at = words.axes.first().map_or(named, |(_, _, span)| *span);
            let (condition, which) = if end {
                (Condition::SplineEndTangent, "target")
            } else {
                (Condition::Range, "start")
            };
            let text = format!("the {which} tangent of a spline does not have a direction");
            report.note(Fault::new(condition, text, at));
        }
        if start {
            self.start.set_vector(vector.clone());
        }
        if end {
            self.end.set_vector(vector);
        }
        start || end
    }
}
