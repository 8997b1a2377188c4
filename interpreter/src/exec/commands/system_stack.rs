//! Named coordinate systems, stacked on each other: `#CS ADD`, `#CS SELECT`, `#CS SET`, `#CS DEL`.
//!
//! Source: TF5200 programming manual 1037259147 (ADD), 1037628043 (SELECT), 1048407819 (SET), 1048405643 (DEL); 21599. Systems of
//! `#CS ON` and of a stack are not active together: the pages do not define their order.

use super::frames;
use super::row::{Call, Row};
use crate::diag::Condition;
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::geometry::coordinates::SYSTEMS_MAX;
use crate::syntax::ast::{Group, Ident, Item, ItemKind, Span};

/// Maximum length of the name of a system.
const NAME_MAX: usize = 8;

/// Reserved names.
const RESERVED: [&str; 3] = ["ACS", "IMCS", "MCS"];

/// Row of `#CS ADD`.
pub(super) const ADD: Row = Row::run("CS ADD", add)
    .several()
    .form("#CS ADD [name][x,y,z,a,b,c]")
    .meaning("puts a coordinate system with a name on the stack; #CS SELECT makes it active")
    .note("at most five systems; names have up to eight characters, are case-sensitive, and are not ACS, IMCS or MCS")
    .example("#CS ADD [WCS][15,20,0,0,0,0]")
    .related(&["#CS SELECT", "#CS SET", "#CS DEL"]);

/// Row of `#CS SELECT`.
pub(super) const SELECT: Row = Row::run("CS SELECT", select)
    .form("#CS SELECT [name]")
    .meaning(
        "program coordinates refer to this system, which is based on those below it in the stack",
    )
    .example("#CS SELECT [WCS]")
    .related(&["#CS ADD"]);

/// Row of `#CS SET`.
pub(super) const SET: Row = Row::run("CS SET", set)
    .several()
    .form("#CS SET [name][x,y,z,a,b,c]")
    .meaning("moves a system of the stack; the axes stay where they are")
    .example("#CS SET [WCS][20,10,0,0,0,10]")
    .related(&["#CS ADD"]);

/// Row of `#CS DEL`.
pub(super) const DELETE: Row = Row::run("CS DEL", delete)
    .bare()
    .form("#CS DEL [ALL]")
    .meaning("deletes the top system of the stack, or all; those below it stay active")
    .example("#CS DEL ALL")
    .related(&["#CS ADD"]);

/// The name in a bracket.
fn name(group: &Group) -> Outcome<&Ident> {
    let [Item { kind: ItemKind::Flag(name), .. }] = &group.items[..] else {
        let text = "the name of a coordinate system is expected";
        return Err(Fault::new(Condition::CoordinateSystemSyntax, text, group.span));
    };
    Ok(name)
}

/// Index of a name in the stack.
fn place(decoder: &Decoder, name: &Ident) -> Outcome<usize> {
    let mut names = decoder.geometry.coordinates.stack().names();
    names.position(|known| known == &*name.text).ok_or_else(|| {
        let names: Vec<&str> = decoder.geometry.coordinates.stack().names().collect();
        let hint = if names.is_empty() {
            "write #CS ADD [name][x,y,z,a,b,c] before it".to_owned()
        } else {
            format!("the stack has {}", names.join(", "))
        };
        let text = format!("coordinate system {} is not defined", name.text);
        Fault::new(Condition::SystemNameUnknown, text, name.span).hint(hint)
    })
}

/// Checks that the active systems may change.
fn changes(decoder: &Decoder, call: &Call<'_>) -> Outcome<()> {
    frames::no_compensation(decoder, call)?;
    let coordinates = &decoder.geometry.coordinates;
    if coordinates.is_machine() {
        let what = format!("{} between #MCS ON and #MCS OFF", call.title());
        return Err(Fault::unsupported(what, call.span()));
    }
    if coordinates.systems() != coordinates.stack().active() {
        let what = format!("{} while a system of #CS ON is active", call.title());
        return Err(Fault::unsupported(what, call.span()));
    }
    Ok(())
}

fn wrong_form(text: &str, span: Span) -> Box<Fault> {
    Fault::new(Condition::CoordinateSystemSyntax, text, span)
}

/// Checks that there are neither ON and OFF nor other words.
fn plain(call: &Call<'_>) -> Outcome<()> {
    if call.command.on.is_some() {
        return Err(wrong_form("neither ON nor OFF is allowed here", call.span()));
    }
    call.no_more_words()
}

fn add(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    plain(call)?;
    let [first, values] = &call.command.groups[..] else {
        return Err(wrong_form("#CS ADD needs [name][x,y,z,a,b,c]", call.span()));
    };
    let name = name(first)?;
    if name.text.len() > NAME_MAX || RESERVED.iter().any(|reserved| name.is(reserved)) {
        let text = format!("{} cannot be the name of a coordinate system", name.text);
        return Err(wrong_form(&text, name.span)
            .hint("use up to eight characters, but not ACS, IMCS or MCS"));
    }
    if decoder.geometry.coordinates.stack().names().any(|known| known == &*name.text) {
        let text = format!("the stack already has a coordinate system {}", name.text);
        return Err(Fault::new(Condition::SystemNameInUse, text, name.span));
    }
    let frame = frames::system(decoder, values)?;
    frames::turns_alike(decoder, call, &frame)?;
    if !decoder.geometry.coordinates.stack_add(&name.text, frame) {
        let text = format!("more than {SYSTEMS_MAX} coordinate systems in the stack");
        return Err(Fault::new(Condition::SystemsTooMany, text, call.span()));
    }
    Ok(())
}

fn select(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    plain(call)?;
    let [group] = &call.command.groups[..] else {
        return Err(wrong_form("#CS SELECT needs [name]", call.span()));
    };
    let place = place(decoder, name(group)?)?;
    changes(decoder, call)?;
    frames::no_modulo_axes(decoder, call)?;
    frames::no_independent_axis(decoder, call)?;
    decoder.geometry.coordinates.stack_select(place + 1);
    Ok(())
}

fn set(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    plain(call)?;
    let [first, values] = &call.command.groups[..] else {
        return Err(wrong_form("#CS SET needs [name][x,y,z,a,b,c]", call.span()));
    };
    let place = place(decoder, name(first)?)?;
    let frame = frames::system(decoder, values)?;
    frames::turns_alike(decoder, call, &frame)?;
    if place < decoder.geometry.coordinates.stack().active() {
        changes(decoder, call)?;
    }
    decoder.geometry.coordinates.stack_set(place, frame);
    Ok(())
}

fn delete(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    let all = match call.rest {
        [] => false,
        [word] if word.is("ALL") => true,
        [word, ..] => return Err(call.unexpected(word)),
    };
    if call.command.on.is_some() {
        return Err(wrong_form("neither ON nor OFF is allowed here", call.span()));
    }
    if decoder.geometry.coordinates.stack().active() > 0 {
        changes(decoder, call)?;
    }
    if !decoder.geometry.coordinates.stack_delete(all) && !all {
        let text = "#CS DEL: the stack is empty";
        return Err(Fault::new(Condition::NoCoordinateSystem, text, call.span())
            .hint("write #CS ADD [name][x,y,z,a,b,c] before it"));
    }
    Ok(())
}
