//! Keys of list entries: dotted names with indices, `getriebe[0].dynamik.vb_max`.
//!
//! Order of calls: parse the key of a line, then look it up by its shape in the parameter [table].
//!
//! ```
//! use kontur_interpreter::machine::key::Key;
//!
//! let key = Key::parse("Getriebe[0].dynamik.vb_max").unwrap();
//! assert_eq!((key.shape.as_str(), &key.indices[..]), ("getriebe[].dynamik.vb_max", &[0][..]));
//! assert!(Key::parse("getriebe[0.kv").is_none());
//! ```

use super::table::{self, Indices, ListKind, Row};

/// A key as written, divided into its parts.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Key {
    /// In lower case, `[]` for every index.
    pub shape: String,
    /// Indices from left to right.
    pub indices: Vec<u32>,
    /// Whether at least one index was left empty (`getriebe[].kv`) and reads as 0.
    pub empty_index: bool,
}

impl Key {
    /// Parses a key; `None` if the text is not one.
    pub fn parse(text: &str) -> Option<Self> {
        let mut key = Self {
            shape: String::with_capacity(text.len()),
            indices: Vec::new(),
            empty_index: false,
        };
        for segment in text.split('.') {
            let (name, index) = match segment.split_once('[') {
                Some((name, rest)) => (name, Some(rest.strip_suffix(']')?)),
                None => (segment, None),
            };
            if name.is_empty()
                || !name.chars().all(|c| c.is_ascii_alphanumeric() || "_-".contains(c))
            {
                return None;
            }
            if !key.shape.is_empty() {
                key.shape.push('.');
            }
            key.shape.push_str(&name.to_ascii_lowercase());
            if let Some(digits) = index {
                if digits.is_empty() {
                    key.empty_index = true;
                    key.indices.push(0);
                } else if digits.bytes().all(|b| b.is_ascii_digit()) {
                    key.indices.push(digits.parse().ok()?);
                } else {
                    return None;
                }
                key.shape.push_str("[]");
            }
        }
        Some(key)
    }

    /// The row of the key in a list and its indices; `None` for an unknown key or an index beyond the array.
    pub(crate) fn resolve(&self, list: ListKind) -> Option<(&'static Row, Indices)> {
        let row = table::by_key(list, &self.shape)?;
        let indices = self.two_indices();
        beyond(row.key, indices).is_none().then_some((row, indices))
    }

    /// Its indices, 0 for missing ones.
    fn two_indices(&self) -> Indices {
        let mut indices = [0; 2];
        for (slot, index) in indices.iter_mut().zip(&self.indices) {
            *slot = *index;
        }
        indices
    }

    /// Description of a known key with an index outside its array: `index 4 of getriebe is outside 0 to 3`.
    pub(crate) fn beyond(&self, list: ListKind) -> Option<String> {
        let row = table::by_key(list, &self.shape)?;
        let (array, index, size) = beyond(row.key, self.two_indices())?;
        Some(match size {
            1 => format!("index {index} of {array} does not exist, only index 0"),
            _ => format!("index {index} of {array} is outside 0 to {}", size - 1),
        })
    }
}

/// Sizes of arrays by the part of the key before the index; arrays that are not listed are not limited.
///
/// Source: the manuals of the lists. Assumption: four gear stages and two measuring systems; the documents do not state
/// these numbers.
const SIZES: &[(&str, u32)] = &[
    ("getriebe", 4),
    ("filter", 3),
    ("lr_param.add_interface.filter", 1),
    ("lr_param.improved_position_control.stage", 3),
    ("lr_param.improved_position_control.stage[i].filter", 2),
    ("lr_hw", 2),
    ("error_filter", 4),
    ("achs_mds", 32),
    ("sda_mds", 12),
    ("gruppe", 1),
    ("gruppe[i].achse", 32),
    ("spindel", 16),
    ("synchro_data.koppel_gruppe", 1),
    ("synchro_data.koppel_gruppe[i].paar", 15),
    ("prog_start.g_gruppe", 38),
    ("prog_start.m_gruppe", 2),
    ("configuration.channel", 12),
];

/// The first array of a key with an index outside its size: its name, the index, its size.
fn beyond(key: &str, indices: Indices) -> Option<(&str, u32, u32)> {
    let brackets = key.char_indices().filter(|(_, c)| *c == '[').map(|(at, _)| at);
    brackets.zip(indices).find_map(|(at, index)| {
        let (_, size) = SIZES.iter().find(|(array, _)| *array == &key[..at])?;
        (index >= *size).then_some((&key[..at], index, *size))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_come_apart() {
        let key = Key::parse("Gruppe[0].achse[12].Log_achs_nr").unwrap();
        assert_eq!(key.shape, "gruppe[].achse[].log_achs_nr");
        assert_eq!(key.indices, [0, 12]);
        assert!(!key.empty_index);
        assert!(Key::parse("getriebe[].kv").unwrap().empty_index);
        for bad in
            ["", ".", "a..b", "a[", "a[1", "a[x].b", "a[1]b", "a[-1]", "(x)", "a[99999999999]"]
        {
            assert_eq!(Key::parse(bad), None, "{bad}");
        }
    }

    #[test]
    fn keys_find_their_row_without_regard_to_case() {
        let find = |text: &str| Key::parse(text).unwrap().resolve(ListKind::Axis);
        let (row, indices) = find("Lr_param.add_interface.Filter[0].ORDER").unwrap();
        assert_eq!((row.id, indices), ("P-AXIS-00736", [0, 0]));
        // sizes of arrays
        assert!(find("filter[2].order").is_some());
        assert!(find("filter[3].order").is_none());
        assert!(find("lr_param.add_interface.filter[1].order").is_none());
        assert!(find("getriebe[3].kv").is_some());
        assert!(find("getriebe[4].kv").is_none());
        // both spellings of the band-pass of a stage
        let stage = |k| find(&format!("lr_param.improved_position_control.stage[1].{k}")).unwrap();
        assert_eq!(stage("filter.order"), stage("filter[0].order"));
        assert_eq!(stage("filter[1].order").1, [1, 1]);
    }
}
