//! Numbers formatted for readers.

/// A number with at most five significant digits, without trailing zeros: `92.222`, `0.00005`, `12000`, `1.2346e-9`.
///
/// The values of a message contain the exact number.
pub fn rounded(x: f64) -> String {
    if !x.is_finite() || x.abs() <= 0.0 {
        return format!("{x}");
    }
    let magnitude = libm::floor(libm::log10(x.abs())) as i32;
    if !(-6..=14).contains(&magnitude) {
        return format!("{x:.4e}");
    }
    let decimals = usize::try_from(4 - magnitude).unwrap_or(0);
    let text = format!("{x:.decimals$}");
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    }
}

#[cfg(test)]
mod tests {
    use super::rounded;

    #[test]
    fn five_digits_and_no_more() {
        for (x, text) in [
            (92.222_268_99, "92.222"),
            (0.000_05, "0.00005"),
            (0.1 + 0.2, "0.3"),
            (12_000.0, "12000"),
            (1_234_567.8, "1234568"),
            (-7.775_894_5, "-7.7759"),
            (0.0, "0"),
            (1.234_56e-9, "1.2346e-9"),
            (9.999_999_9, "10"),
            (f64::INFINITY, "inf"),
        ] {
            assert_eq!(rounded(x), text);
        }
    }
}
