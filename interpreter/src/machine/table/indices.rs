//! Indices of the keys of arrays.

/// Indices of a key from left to right, 0 where it has fewer than two.
pub type Indices = [u32; 2];

/// A key of the table with its indices inserted: `filter[i].order`, `[2, 0]` gives `filter[2].order`.
pub(crate) fn with_indices(key: &str, indices: Indices) -> String {
    let mut text = String::with_capacity(key.len());
    let mut indices = indices.into_iter();
    let mut chars = key.chars();
    while let Some(c) = chars.next() {
        text.push(c);
        if c == '[' {
            chars.next();
            text.push_str(&indices.next().unwrap_or_default().to_string());
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn indices_go_back_into_the_key() {
        assert_eq!(
            with_indices("gruppe[i].achse[j].bezeichnung", [0, 7]),
            "gruppe[0].achse[7].bezeichnung"
        );
        assert_eq!(with_indices("mass_einh", [0, 0]), "mass_einh");
    }
}
