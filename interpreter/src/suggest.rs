//! "Did you mean": the known name nearest to an unknown one.

/// The candidate with the smallest difference from `name`, at most a third of it; case is ignored.
pub(crate) fn nearest<'a>(
    name: &str,
    candidates: impl IntoIterator<Item = &'a str>,
) -> Option<&'a str> {
    let limit = (name.chars().count() / 3).max(1);
    let mut best: Option<(usize, &str)> = None;
    for candidate in candidates {
        let apart =
            edit_distance(&name.to_ascii_uppercase(), &candidate.to_ascii_uppercase(), limit);
        if let Some(d) = apart.filter(|d| best.is_none_or(|(b, _)| d < &b)) {
            best = Some((d, candidate));
        }
    }
    best.map(|(_, candidate)| candidate)
}

/// Hint of a diagnostic.
pub(crate) fn hint<'a>(
    name: &str,
    candidates: impl IntoIterator<Item = &'a str>,
) -> Option<String> {
    nearest(name, candidates).map(|near| format!("did you mean `{near}`?"))
}

/// Number of letters to insert, delete or replace (Levenshtein), `None` above `limit`.
pub(crate) fn edit_distance(a: &str, b: &str, limit: usize) -> Option<usize> {
    let lengths = [a, b].map(|text| text.chars().count());
    // texts may have any length
    let may = lengths[0].abs_diff(lengths[1]) <= limit;
    may.then(|| strsim::levenshtein(a, b)).filter(|distance| *distance <= limit)
}

#[cfg(test)]
mod tests {
    use super::nearest;

    #[test]
    fn typing_errors_are_found_and_strangers_are_not() {
        let names = ["CONTOUR MODE", "VIB GUARD", "FILTER"];
        assert_eq!(nearest("FITLER", names), Some("FILTER"));
        assert_eq!(nearest("vib gard", names), Some("VIB GUARD"));
        assert_eq!(nearest("SLOPE", names), None);
    }
}
