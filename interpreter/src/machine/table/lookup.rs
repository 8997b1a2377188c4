//! Finding rows: by key, by ID, and the nearest ones to a misspelt key.

use super::{
    ListKind, Row, axis_compensation, axis_control, axis_drive, axis_dynamics, axis_filters,
    axis_functions, axis_general, axis_guard, channel, channel_hsc, external, own, start_up, tool,
    with_indices, zero,
};
use crate::suggest::edit_distance;
use std::collections::HashMap;
use std::sync::LazyLock;

/// Families of the table, in the order of the documentation.
const FAMILIES: &[&[Row]] = &[
    start_up::ROWS,
    channel::ROWS,
    channel_hsc::ROWS,
    axis_general::ROWS,
    axis_dynamics::ROWS,
    axis_control::ROWS,
    axis_drive::ROWS,
    axis_filters::ROWS,
    axis_guard::ROWS,
    axis_compensation::ROWS,
    axis_functions::ROWS,
    tool::ROWS,
    zero::ROWS,
    external::ROWS,
    own::ROWS,
];

/// Other spellings of a key that mean the same parameter, with `[]` for every index.
///
/// Source: the channel manual's older edition (`syn_chk.fehler_*`); the overview of the start-up
/// manual (`wrkz_data`); its pages 1238935151133070859 and 829047947 (`interpolator.parameter`); the older
/// syntax of external variables (3070356591133215627); TF5200 Improved Position Control: builds with one
/// filter per stage write `filter.`, newer ones `filter[k].`.
const ALIASES: &[(&str, &str)] = &[
    ("suppress_pos_lag_error", "kenngr.suppress_pos_lag_error"),
    ("lr_param.suppress_pos_lag_error", "kenngr.suppress_pos_lag_error"),
    ("getriebe[].suppress_pos_lag_error", "kenngr.suppress_pos_lag_error"),
    ("wrkz_data[]", "werkz_data[i]"),
    ("anzahl_belegt", "number_used_variables"),
    ("var[].index", "var[i].byte_offset"),
    ("var[].array_size", "var[i].array_elements"),
    (
        "configuration.channel[].interpolator.parameter",
        "configuration.channel[i].interpolator.number_blocks_lah",
    ),
    ("configuration.interpolator.parameter", "configuration.interpolator.number_blocks_lah"),
    ("syn_chk.fehler_gesamt", "syn_chk.errors_total"),
    ("syn_chk.fehler_pro_zeile", "syn_chk.errors_per_block"),
    (
        "lr_param.improved_position_control.stage[].filter.order",
        "lr_param.improved_position_control.stage[i].filter[k].order",
    ),
    (
        "lr_param.improved_position_control.stage[].filter.fg_f0",
        "lr_param.improved_position_control.stage[i].filter[k].fg_f0",
    ),
    (
        "lr_param.improved_position_control.stage[].filter.q_factor",
        "lr_param.improved_position_control.stage[i].filter[k].q_factor",
    ),
    (
        "lr_param.improved_position_control.stage[].filter.damping",
        "lr_param.improved_position_control.stage[i].filter[k].damping",
    ),
    (
        "lr_param.improved_position_control.stage[].filter.type",
        "lr_param.improved_position_control.stage[i].filter[k].type",
    ),
];

/// Every row of the table.
pub fn rows() -> impl Iterator<Item = &'static Row> {
    FAMILIES.iter().flat_map(|family| family.iter())
}

/// Rows by their IDs, which are in upper case.
static BY_ID: LazyLock<HashMap<&'static str, &'static Row>> =
    LazyLock::new(|| rows().filter(|r| !r.id.is_empty()).map(|r| (r.id, r)).collect());

/// Rows of all lists by the shapes of their keys.
static BY_SHAPE: LazyLock<HashMap<String, Vec<&'static Row>>> = LazyLock::new(|| {
    let mut shapes: HashMap<String, Vec<&'static Row>> = HashMap::new();
    for row in rows().filter(|r| !r.key.is_empty()) {
        shapes.entry(plain(row.key)).or_default().push(row);
    }
    shapes
});

/// The row with an ID in either case.
pub(crate) fn by_id(id: &str) -> Option<&'static Row> {
    BY_ID.get(id).or_else(|| BY_ID.get(id.to_ascii_uppercase().as_str())).copied()
}

/// The key of an axis parameter from its ID and first index, 0 if absent: `P-AXIS-00209.1`.
pub(crate) fn axis_key(id: &str) -> Option<String> {
    let (id, index) = id.split_once('.').unwrap_or((id, "0"));
    let row = by_id(id).filter(|row| row.list == ListKind::Axis && !row.key.is_empty())?;
    Some(with_indices(row.key, [index.parse().ok()?, 0]))
}

/// The row of a key in a list; `shape` is the key in either case with `[]` for every index.
pub(crate) fn by_key(list: ListKind, shape: &str) -> Option<&'static Row> {
    let shape = match ALIASES.iter().find(|(from, _)| *from == shape) {
        Some((_, key)) => plain(key),
        None => shape.to_ascii_lowercase(),
    };
    BY_SHAPE.get(&shape)?.iter().find(|r| r.list == list).copied()
}

/// Number of letters of a last name from which on two of them may be wrong: in a shorter one that gives a different
/// word (`lose` and `load`).
const LONG_NAME: usize = 6;

/// Keys that differ from `shape` by at most two letters, best first; by at most one if their last names are short.
pub(crate) fn misspelt(list: Option<ListKind>, shape: &str) -> Vec<&'static str> {
    let wanted = shape.to_ascii_lowercase();
    let differs = |key: &'static str| {
        let plain = plain(key);
        let (own, other) = (last_name(&plain), last_name(&wanted));
        let most = if own == other || own.len().min(other.len()) >= LONG_NAME { 2 } else { 1 };
        Some((edit_distance(&plain, &wanted, most)?, key))
    };
    let mut near: Vec<(usize, &'static str)> = keys(list).filter_map(differs).collect();
    near.sort_by_key(|(distance, _)| *distance);
    near.into_iter().map(|(_, key)| key).collect()
}

/// Keys that were probably meant, best first, at most three: misspelt ones, otherwise those whose last name is the same
/// (`getriebe[i].kv` for `kv`).
pub(crate) fn suggestions(list: Option<ListKind>, shape: &str) -> Vec<&'static str> {
    let wanted = shape.to_ascii_lowercase();
    let mut found = misspelt(list, shape);
    if found.is_empty() && !wanted.is_empty() {
        found = keys(list).filter(|key| last_name(&plain(key)) == last_name(&wanted)).collect();
    }
    found.truncate(3);
    found
}

/// The part of a key after its last dot.
fn last_name(key: &str) -> &str {
    key.rsplit('.').next().unwrap_or_default()
}

fn keys(list: Option<ListKind>) -> impl Iterator<Item = &'static str> {
    rows().filter(move |r| list.is_none_or(|l| l == r.list) && !r.key.is_empty()).map(|r| r.key)
}

/// A key of the table in lower case with `[]` for every index.
fn plain(key: &str) -> String {
    key.to_ascii_lowercase().replace("[i]", "[]").replace("[j]", "[]").replace("[k]", "[]")
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn keys_and_ids_are_unique() {
        let mut keys = BTreeSet::new();
        let mut ids = BTreeSet::new();
        for r in rows() {
            assert!(r.key.is_empty() || keys.insert((r.list, plain(r.key))), "key {}", r.key);
            assert!(r.id.is_empty() || ids.insert(r.id), "id {}", r.id);
            assert_eq!(r.id, r.id.to_ascii_uppercase());
            assert!(!r.key.is_empty() || !r.id.is_empty());
            assert!(!r.meaning.is_empty() && !r.source.is_empty(), "{}{}", r.id, r.key);
        }
    }

    #[test]
    fn aliases_lead_to_rows() {
        for (from, to) in ALIASES {
            let row = rows().find(|r| r.key == *to).unwrap();
            assert_eq!(by_key(row.list, from), Some(row), "{from} -> {to}");
        }
    }

    /// Every row is found by its ID and by its key, in any case, but only in its own list.
    #[test]
    fn rows_are_found() {
        for row in rows() {
            if !row.id.is_empty() {
                assert_eq!(by_id(row.id), Some(row));
                assert_eq!(by_id(&row.id.to_ascii_lowercase()), Some(row));
            }
            if !row.key.is_empty() {
                let shape = plain(row.key);
                assert_eq!(by_key(row.list, &shape), Some(row));
                assert_eq!(by_key(row.list, &shape.to_ascii_uppercase()), Some(row));
            }
        }
        assert_eq!(by_id("P-AXIS-99999"), None);
        assert_eq!(by_key(ListKind::Axis, "getriebe[i].kv"), None);
    }

    #[test]
    fn printed_variants_get_the_right_suggestion() {
        // Variants printed in the manuals in addition to the right spelling.
        for (printed, meant) in [
            ("vorsteuer.jerk_fact_nom", "vorsteuer.jerk_fact_num"),
            (
                "lr_param.improved_position_control.stages[].mode",
                "lr_param.improved_position_control.stage[i].mode",
            ),
            ("antr.v_time_bae", "antr.v_time_base"),
            ("kv", "getriebe[i].kv"),
        ] {
            assert_eq!(by_key(ListKind::Axis, printed), None);
            assert_eq!(suggestions(Some(ListKind::Axis), printed).first(), Some(&meant));
        }
    }

    /// Two wrong letters of a short name make a different word, so nothing is suggested.
    #[test]
    fn other_words_are_not_proposed() {
        assert_eq!(misspelt(Some(ListKind::Axis), "getriebe[].losee"), ["getriebe[i].lose"]);
        for other in ["getriebe[].lope", "getriebe[].nix", "getriebe[].live"] {
            let found = misspelt(Some(ListKind::Axis), other);
            assert!(!found.contains(&"getriebe[i].load"), "{other}: {found:?}");
        }
    }
}
