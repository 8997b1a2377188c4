//! The answers of `kontur explain THING`, from the tables of conditions, parameters and commands: an ID, a parameter, a
//! command, an object or word of the documents.
//!
//! Order of calls: none, the functions are independent.
//!
//! ```
//! use kontur_interpreter::explain::explain;
//!
//! assert!(explain("P-AXIS-00099").unwrap().to_string().contains("getriebe[i].kv"));
//! assert!(explain("#VIB GARD").unwrap_err().contains(&"#VIB GUARD".to_owned()));
//! ```

mod commands;
mod explanation;
mod language;
mod notes;
mod row;
mod variables;
mod words;

pub use explanation::{Explanation, Kind};

use crate::diag::condition;
use crate::diag::{Condition, Id, Named};
use crate::machine::instead_of;
use crate::machine::key::Key;
use crate::machine::table::{
    self, Bound, Correction, Default, DriveType, ListKind, Raw, Row, axis_filters,
};
use crate::machine::value::{self, Value};
use crate::suggest::edit_distance;

/// Explains an ID (`22060`, `P-ERR-70082`, `K-0031`, `K-LIST-LINK`), a parameter (`P-AXIS-00571` or its key), a command
/// (`#VIB GUARD`, `G136`), a system variable (`V.A.ABS.X`), an object or a word.
///
/// # Errors
/// Suggestions (possibly none), if the term is unknown.
pub fn explain(thing: &str) -> Result<Explanation, Vec<String>> {
    let thing = thing.trim();
    message_of(thing)
        .map(message)
        .or_else(|| table::by_id(thing).map(parameter))
        .or_else(|| table::by_id(&with_five_digits(thing)?).map(parameter))
        .or_else(|| key_of(thing).map(parameter))
        .or_else(|| commands::find(thing))
        .or_else(|| variables::find(thing))
        .or_else(|| words::find(thing))
        .ok_or_else(|| probably(thing))
}

/// Everything of one kind in the order of its table: the reference, entry by entry.
///
/// ```
/// use kontur_interpreter::explain::{Kind, all, explain};
///
/// let guard = all(Kind::Command).into_iter().find(|e| e.title == "#VIB GUARD");
/// assert_eq!(guard, explain("#VIB GUARD").ok());
/// ```
pub fn all(kind: Kind) -> Vec<Explanation> {
    match kind {
        Kind::Message => condition::rows().map(message).collect(),
        Kind::Parameter => table::rows().map(parameter).collect(),
        Kind::Command => commands::all().collect(),
        Kind::Variable => variables::all().collect(),
        Kind::Word => words::all().map(words::explained).collect(),
    }
}

fn message_of(thing: &str) -> Option<&'static condition::Row> {
    let upper = thing.to_ascii_uppercase();
    let digits =
        upper.strip_prefix("P-ERR-").or_else(|| upper.strip_prefix("ID ")).unwrap_or(&upper);
    let id = match digits.strip_prefix("K-").map(str::parse) {
        Some(Ok(number)) => Some(Id::Kontur(number)),
        _ => digits.parse().ok().map(Id::Vendor),
    };
    let named = |e: &&condition::Row| Some(e.id) == id || (!e.name.is_empty() && e.name == upper);
    condition::rows().find(named)
}

/// `P-AXIS-00363` for `P-AXIS-363` and `P-AXIS-000363`.
fn with_five_digits(id: &str) -> Option<String> {
    let (list, digits) = id.rsplit_once('-')?;
    let number: u32 = digits.parse().ok()?;
    list.starts_with(['P', 'p']).then(|| format!("{list}-{number:05}"))
}

fn key_of(thing: &str) -> Option<&'static Row> {
    // the table's own spelling of indices, `filter[i].order`, reads as an empty index
    let plain = thing.replace("[i]", "[]").replace("[j]", "[]").replace("[k]", "[]");
    let key = Key::parse(&printed(&plain))?;
    let kinds = [
        ListKind::Axis,
        ListKind::Channel,
        ListKind::StartUp,
        ListKind::Tool,
        ListKind::Zero,
        ListKind::External,
        ListKind::Kontur,
    ];
    kinds.iter().find_map(|kind| table::by_key(*kind, &key.shape))
}

/// The key of a printed variant: misprints of the documents, and keys printed without their beginning.
fn printed(key: &str) -> String {
    const WORDS: [(&str, &str); 3] =
        [("jerk_fact_nom", "jerk_fact_num"), ("v_time_bae", "v_time_base"), ("stages[", "stage[")];
    const FRONTS: [(&str, &str); 5] = [
        ("jerk_fact_", "vorsteuer."),
        ("v_time_base", "antr."),
        ("stage[", "lr_param.improved_position_control."),
        ("filter.order", "lr_param.improved_position_control.stage[]."),
        ("filter.", "lr_param.improved_position_control.stage[]."),
    ];
    let mut key = WORDS.iter().fold(key.to_owned(), |key, (from, to)| key.replace(from, to));
    if let Some((_, front)) = FRONTS.iter().find(|(start, _)| key.starts_with(start)) {
        key.insert_str(0, front);
    }
    // newer builds number the filters of a stage
    if key.contains("improved_position_control") {
        key.replace("].filter.", "].filter[].")
    } else {
        key
    }
}

/// What the drives of a parameter in the manual mean here.
fn drives_here(row: &Row) -> &'static str {
    match row.drives {
        _ if instead_of(row.id).is_some() => "",
        [DriveType::Profidrive] if !row.key.is_empty() => "; here only with antr_typ 3",
        [DriveType::Profidrive] => "",
        _ if row.needs_simu() => "; here only with the plant SIMU (kontur.axis[i].plant.model)",
        _ => "; here for every simulated drive",
    }
}

fn probably(thing: &str) -> Vec<String> {
    let shape = Key::parse(thing).map_or_else(|| thing.to_ascii_lowercase(), |key| key.shape);
    let mut found: Vec<String> =
        table::suggestions(None, &shape).into_iter().map(str::to_owned).collect();
    let wanted = thing.to_ascii_uppercase();
    // of a short word, two letters would be half
    let most = if wanted.len() < 6 { 1 } else { 2 };
    let near = |name: &String| edit_distance(&name.to_ascii_uppercase(), &wanted, most).is_some();
    found.extend(commands::names().chain(words::names().map(str::to_owned)).filter(near));
    found.truncate(5);
    found
}

fn parameter(row: &'static Row) -> Explanation {
    let title = [row.id, row.key].into_iter().filter(|s| !s.is_empty()).collect::<Vec<_>>();
    let mut facts = Vec::new();
    facts.push(("list", list_name(row.list).to_owned()));
    if row.key.is_empty() {
        facts.push(("key", "not read here: cannot be set in a list".to_owned()));
    } else {
        // the tables print STRING where a number is accepted too
        let printed = [
            axis_filters::PROTOTYPE,
            axis_filters::ADDITIONAL_PROTOTYPE,
            axis_filters::ADDITIONAL_TYPE,
        ]
        .iter()
        .any(|param| param.id() == row.id());
        let name = if printed { "STRING (numbers accepted)" } else { row.raw.name() };
        facts.push(("type", name.to_owned()));
        facts.push(("range", range(row)));
        facts.push(("default", default(row)));
        facts.push(("unit", unit(row)));
    }
    if let Raw::Names(names) | Raw::Flags(names) = row.raw {
        let form = |(name, n): &(&str, u32)| match row.raw {
            Raw::Flags(_) => format!("{name} {n:#x}"),
            _ => format!("{name} {n}"),
        };
        facts.push(("names", names.iter().map(form).collect::<Vec<_>>().join(", ")));
    }
    if !row.axes.is_empty() {
        let axes: Vec<String> = row.axes.chars().map(String::from).collect();
        facts.push(("axes", format!("{} (T linear, R rotary, S spindle)", axes.join(", "))));
    }
    if !row.drives.is_empty() {
        let names: Vec<&str> = row.drives.iter().map(|drive| drive.name()).collect();
        facts.push(("drives", format!("{}{}", names.join(", "), drives_here(row))));
    }
    if let Some(reaction) = reaction(row) {
        facts.push(("reaction", reaction));
    }
    if let Some(instead) = instead_of(row.id) {
        facts.push(("simulated", format!("no (K-0075 where a list changes it): {instead}")));
    }
    facts.push(("source", row.source.to_owned()));
    Explanation {
        kind: Kind::Parameter,
        title: title.join("  "),
        meaning: row.meaning.to_owned(),
        facts,
        notes: notes::of(row.id),
        example: example(row),
        related: notes::related(row.id),
    }
}

fn list_name(list: ListKind) -> &'static str {
    match list {
        ListKind::StartUp => "start-up list (hochlauf.lis)",
        ListKind::Channel => "channel list",
        ListKind::Axis => "axis list",
        ListKind::Tool => "tool list",
        ListKind::Zero => "zero offset list",
        ListKind::External => "list of external variables",
        ListKind::Kontur => "kontur.lis",
    }
}

fn range(row: &Row) -> String {
    let end = |bound: Bound, name: &str| match bound {
        Bound::None => name.to_owned(),
        bound => bound.to_string(),
    };
    let words = match row.raw {
        Raw::Word(words) => return words.join(", "),
        Raw::Boolean => return "0 or 1".to_owned(),
        Raw::Text => return "any text".to_owned(),
        Raw::Code => return "a block of an NC program, to the end of the line".to_owned(),
        Raw::Flags(_) => return "names joined by |, or their sum".to_owned(),
        Raw::Names(_) if row.low == Bound::None && row.high == Bound::None => {
            return "the names, or their numbers".to_owned();
        }
        _ => format!(
            "{} .. {}",
            end(row.low, "minimum of the type"),
            end(row.high, "maximum of the type")
        ),
    };
    match row.special {
        Some(special) => format!("{words}, or {special}"),
        None => words,
    }
}

fn default(row: &Row) -> String {
    if row.id() == axis_filters::TYPE.id() {
        return "LOWPASS 1 with the prototypes 1 to 3, HSC_MEAN 8 with the prototype HSC"
            .to_owned();
    }
    match row.default {
        Default::None => "none".to_owned(),
        Default::Number(x) => value::write(row.raw, &Value::Number(x)),
        Default::Text(text) => text.to_owned(),
        Default::Of(id) => format!("as {id}"),
        Default::PerIndex(texts) => texts.join(", then "),
    }
}

fn unit(row: &Row) -> String {
    if row.unit == row.unit_rotary {
        row.unit.to_owned()
    } else {
        format!("{} (rotary axes and spindles {})", row.unit, row.unit_rotary)
    }
}

fn reaction(row: &Row) -> Option<String> {
    if row.at_setup {
        return Some(
            "checked when the function is set up, together with its other parameters".to_owned(),
        );
    }
    let side = |bound: Bound, name: &str, reaction: table::OutOfRange| {
        // a negative number is not a value of an unsigned type (K-0073)
        let unsigned = matches!(row.raw, Raw::Uns08 | Raw::Uns16 | Raw::Uns32);
        let never =
            name == "below" && unsigned && matches!(bound, Bound::At(least) if least <= 0.0);
        if bound == Bound::None || never {
            return None;
        }
        let what = match reaction.correction {
            Correction::Default => "the default is used".to_owned(),
            Correction::Limit => "limited".to_owned(),
            Correction::Value(x) => format!("{x} is used"),
            Correction::Keep => "the function is off".to_owned(),
            Correction::Refuse => "the machine is refused".to_owned(),
        };
        Some(format!("{name}: {}, {what}", reaction.condition.id()))
    };
    let sides = [side(row.low, "below", row.below), side(row.high, "above", row.above)];
    let sides: Vec<String> = sides.into_iter().flatten().collect();
    (!sides.is_empty()).then(|| sides.join("; "))
}

/// A line for a list, with the default or a value of the range.
fn example(row: &Row) -> Option<String> {
    if row.key.is_empty() {
        return None;
    }
    // the logical number of an axis is never 0
    let first = u32::from(row.key.starts_with("kontur.axis[i]"));
    let key = table::with_indices(row.key, [first, 0]);
    let value = match (notes::example(row.id), row.raw) {
        (Some(value), _) => value.to_owned(),
        (None, Raw::Word(words)) => words.first().copied().unwrap_or_default().to_owned(),
        (None, Raw::Text) => "NAME".to_owned(),
        (None, Raw::Code) => "G01 X10 F1000".to_owned(),
        (None, Raw::Boolean) => "1".to_owned(),
        (None, _) => match (row.default, row.low) {
            (Default::Number(x), _) | (_, Bound::At(x)) => value::write(row.raw, &Value::Number(x)),
            _ => "1".to_owned(),
        },
    };
    Some(format!("{key}   {value}"))
}

fn message(entry: &'static condition::Row) -> Explanation {
    let title = if entry.name.is_empty() {
        entry.id.to_string()
    } else {
        format!("{}  {}", entry.id, entry.name)
    };
    let mut facts = vec![
        ("severity", format!("{:?}", entry.severity).to_lowercase()),
        ("reaction", format!("class {}: {}", entry.reaction.class(), entry.reaction.text())),
        ("remedy", format!("class {}: {}", entry.remedy, entry.remedy_text())),
    ];
    if !entry.cause.is_empty() {
        facts.insert(0, ("cause", entry.cause.to_owned()));
    }
    let documented = matches!(entry.id, Id::Vendor(_));
    facts.push((
        "source",
        if documented {
            "TF5200 diagnosis and the function manuals"
        } else {
            "kontur's own number"
        }
        .to_owned(),
    ));
    let mut related: Vec<String> = table::rows()
        .filter(|r| !r.id.is_empty() && !r.at_setup)
        .filter(|r| {
            (entry.id == r.below.condition && r.low != Bound::None)
                || (entry.id == r.above.condition && r.high != Bound::None)
        })
        .map(|r| r.id.to_owned())
        .collect();
    // the reaction of every parameter without a documented ID
    if entry.id == Condition::ListRange {
        related.clear();
    }
    related.extend(
        named_parameters(entry).into_iter().filter(|id| !related.contains(id)).collect::<Vec<_>>(),
    );
    Explanation {
        kind: Kind::Message,
        title,
        meaning: entry.meaning.to_owned(),
        facts,
        notes: Some(entry.note).filter(|n| !n.is_empty()).map(str::to_owned).into_iter().collect(),
        example: None,
        related,
    }
}

/// Parameters that a row of the catalogue mentions by their five digits.
fn named_parameters(entry: &condition::Row) -> Vec<String> {
    let mut found: Vec<String> = Vec::new();
    for text in [entry.meaning, entry.cause] {
        // `P-TOOL-00013 to 00014`: a number without a list is of the one before it
        let mut list = "AXIS";
        for (start, _) in text.match_indices("00") {
            let digits =
                text.get(start..start + 5).filter(|d| d.bytes().all(|b| b.is_ascii_digit()));
            let alone = !text[..start].ends_with(|c: char| c.is_ascii_digit());
            let Some(digits) = digits.filter(|_| alone) else { continue };
            let named = text[..start].strip_suffix('-').and_then(|t| t.rsplit_once("P-"));
            list = named.map_or(list, |(_, list)| list);
            let id = format!("P-{list}-{digits}");
            if table::by_id(&id).is_some() && !found.contains(&id) {
                found.push(id);
            }
        }
    }
    found
}

#[cfg(test)]
mod tests;
