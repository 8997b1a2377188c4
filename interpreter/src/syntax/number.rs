//! Decimal numbers to `f64`, exactly rounded.

/// Powers of ten that `f64` holds exactly and that keep a quotient correctly rounded.
const POWERS: [f64; 16] =
    [1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15];

/// Integers up to 2^53 are exact in `f64`.
const EXACT_MAX: u64 = 1 << 53;

/// Number at the beginning of `bytes` (`digits`, `digits.`, `digits.digits`, `.digits`) and its length.
///
/// `None` if there is no number, or one of so many digits that the short way is not exact.
pub(super) fn short_decimal(bytes: &[u8]) -> Option<(f64, usize)> {
    let mut mantissa = 0_u64;
    let mut i = 0;
    while let Some(digit) = digit(bytes, i) {
        mantissa = mantissa * 10 + digit;
        i += 1;
        if i > 17 {
            return None;
        }
    }
    let mut digits = i;
    let mut decimals = 0;
    if bytes.get(i) == Some(&b'.') {
        i += 1;
        while let Some(digit) = digit(bytes, i) {
            mantissa = mantissa * 10 + digit;
            decimals += 1;
            i += 1;
            if decimals > 15 || digits + decimals > 17 {
                return None;
            }
        }
        digits += decimals;
    }
    if digits == 0 || mantissa > EXACT_MAX {
        return None;
    }
    // Both operands are exact, so the quotient is the correctly rounded value of the decimal.
    Some((mantissa as f64 / POWERS[decimals], i))
}

fn digit(bytes: &[u8], i: usize) -> Option<u64> {
    bytes.get(i).map(|b| b.wrapping_sub(b'0')).filter(|d| *d < 10).map(u64::from)
}

/// Value of a text that the grammar knows to be a number; `None` if it is beyond the range of `f64`.
pub(super) fn decimal(text: &str) -> Option<f64> {
    match short_decimal(text.as_bytes()) {
        Some((value, _)) => Some(value),
        None => text.parse().ok().filter(|v: &f64| v.is_finite()),
    }
}

#[cfg(test)]
mod tests {
    use super::{decimal, short_decimal};
    use proptest::prelude::*;

    #[test]
    fn forms_of_a_number() {
        assert_eq!(short_decimal(b"12.5X"), Some((12.5, 4)));
        assert_eq!(short_decimal(b"5."), Some((5.0, 2)));
        assert_eq!(short_decimal(b".5"), Some((0.5, 2)));
        assert_eq!(short_decimal(b"."), None);
        assert_eq!(short_decimal(b"X"), None);
        assert_eq!(decimal("123456789012345678901234567890"), Some(1.2345678901234568e29));
        assert_eq!(decimal(&"9".repeat(400)), None);
    }

    proptest! {
        /// The standard library rounds correctly: the same bits must come out.
        #[test]
        fn rounds_as_the_standard_library(text in "[0-9]{0,20}\\.[0-9]{1,18}|[0-9]{1,25}\\.?") {
            let expected: f64 = text.parse().unwrap();
            prop_assert_eq!(decimal(&text).unwrap().to_bits(), expected.to_bits());
        }
    }
}
