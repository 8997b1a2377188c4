//! Converts decimal numbers to `f64`, correctly rounded.

/// Powers of ten that are exact in `f64` and keep a quotient correctly rounded.
const POWERS: [f64; 16] =
    [1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15];

/// 1 in each byte.
const EACH_BYTE: u64 = 0x0101_0101_0101_0101;

/// Integers up to 2^53 are exact in `f64`.
const EXACT_MAX: u64 = 1 << 53;

/// Number at a position (`digits`, `digits.`, `digits.digits`, `.digits`) and its length.
///
/// `None` if there is no number, or if it has too many digits for the short method to be exact.
pub(super) fn short_decimal(bytes: &[u8], at: usize) -> Option<(f64, usize)> {
    if let Some(found) = word_at(bytes, at).and_then(decimal_in_word) {
        return Some(found);
    }
    let bytes = bytes.get(at..)?;
    let (whole, mut mantissa) = digits(bytes, 0);
    let (mut decimals, mut length) = (0, whole);
    if let Some([b'.', behind @ ..]) = bytes.get(whole..) {
        (decimals, mantissa) = digits(behind, mantissa);
        length += 1 + decimals;
    }
    let count = whole + decimals;
    if count == 0 || count > 17 || decimals >= POWERS.len() || mantissa > EXACT_MAX {
        return None;
    }
    // both operands are exact, so the quotient is the correctly rounded value of the decimal
    Some((mantissa as f64 / POWERS[decimals], length))
}

/// Eight bytes from a position on; zeros follow the end of the text. `None` for a shorter text.
#[inline]
pub(super) fn word_at(bytes: &[u8], at: usize) -> Option<[u8; 8]> {
    let rest = bytes.get(at..)?;
    if let Some(word) = rest.first_chunk() {
        return Some(*word);
    }
    let last = u64::from_le_bytes(*bytes.last_chunk()?);
    Some(last.checked_shr(8 * (8 - rest.len() as u32)).unwrap_or(0).to_le_bytes())
}

/// The same for a number with a point that ends within eight bytes, without a loop over its digits: their number, which
/// cannot be predicted, then costs nothing.
#[inline]
pub(super) fn decimal_in_word(word: [u8; 8]) -> Option<(f64, usize)> {
    let (values, others) = digits_of_word(word);
    let whole = others.trailing_zeros() / 8;
    let behind = others.checked_sub(1).map_or(0, |below| others & below).trailing_zeros() / 8;
    let is_point = word.get(whole as usize) == Some(&b'.');
    // a number that goes up to the end may continue behind it
    let count = behind.checked_sub(1).filter(|count| is_point && behind < 8 && *count > 0)?;
    // without the point, and with zeros before the first digit
    let before_point = values & !(u64::MAX << (8 * whole));
    let behind_point = (values >> 8) & (u64::MAX << (8 * whole));
    let mantissa = number_of_digits(before_point | behind_point, count);
    let decimals = count - whole;
    Some((mantissa as f64 / POWERS[decimals as usize], behind as usize))
}

/// The same for the digits of an integer, without what follows them.
#[inline]
pub(super) fn integer_in_word(word: [u8; 8]) -> Option<(u64, usize)> {
    let (values, others) = digits_of_word(word);
    let count = others.trailing_zeros() / 8;
    // one that goes up to the end may continue behind it
    (1..8).contains(&count).then(|| (number_of_digits(values, count), count as usize))
}

/// The bytes of a word, the first one lowest, as digits, and the highest bit of each that is none.
#[inline]
fn digits_of_word(word: [u8; 8]) -> (u64, u64) {
    let values = u64::from_le_bytes(word) ^ (EACH_BYTE * u64::from(b'0'));
    // the carry of no byte reaches the next one
    let carried = (values & (EACH_BYTE * 0x7F)) + EACH_BYTE * 0x76;
    (values, (values | carried) & (EACH_BYTE * 0x80))
}

/// The number that the lowest `count` (1 to 8) bytes are the digits of, the most significant one first.
#[inline]
fn number_of_digits(bytes: u64, count: u32) -> u64 {
    let mut digits = bytes << (8 * (8 - count));
    // two, four and eight digits at a time
    digits = (digits * 10 + (digits >> 8)) & 0x00FF_00FF_00FF_00FF;
    digits = (digits * 100 + (digits >> 16)) & 0x0000_FFFF_0000_FFFF;
    (digits * 10_000 + (digits >> 32)) & 0xFFFF_FFFF
}

/// The number of digits at the beginning of `bytes`, and the value of `number` with these digits appended; from 20
/// digits on the value is not valid.
#[inline]
pub(super) fn digits(bytes: &[u8], mut number: u64) -> (usize, u64) {
    let mut count = 0;
    for byte in bytes {
        let digit = byte.wrapping_sub(b'0');
        if digit > 9 {
            break;
        }
        number = number.wrapping_mul(10).wrapping_add(u64::from(digit));
        count += 1;
    }
    (count, number)
}

/// Value of a text that is a number by the grammar; `None` if it is outside the range of `f64`.
pub(super) fn decimal(text: &str) -> Option<f64> {
    match short_decimal(text.as_bytes(), 0) {
        Some((value, _)) => Some(value),
        None => text.parse().ok().filter(|v: &f64| v.is_finite()),
    }
}

#[cfg(test)]
mod tests {
    use super::{decimal, integer_in_word, short_decimal, word_at};
    use proptest::prelude::*;

    #[test]
    fn forms_of_a_number() {
        assert_eq!(short_decimal(b"12.5X", 0), Some((12.5, 4)));
        assert_eq!(short_decimal(b"5.", 0), Some((5.0, 2)));
        assert_eq!(short_decimal(b".5", 0), Some((0.5, 2)));
        assert_eq!(short_decimal(b".", 0), None);
        assert_eq!(short_decimal(b"X", 0), None);
        assert_eq!(decimal("123456789012345678901234567890"), Some(1.2345678901234568e29));
        assert_eq!(decimal(&"9".repeat(400)), None);
    }

    proptest! {
        /// Short numbers with anything behind them, which must not matter: that of the text alone.
        #[test]
        fn what_follows_a_number_does_not_change_it(
            (whole, part) in ("[0-9]{0,6}", "[0-9]{0,6}"),
            behind in "[^0-9.]?|[^0-9.][ -~]{0,9}",
        ) {
            let number = format!("{whole}.{part}");
            let expected = number.parse().ok().map(|value: f64| (value.to_bits(), number.len()));
            // at the beginning of a text, and behind other characters
            for before in ["", "X-"] {
                let text = format!("{before}{number}{behind}");
                let found = short_decimal(text.as_bytes(), before.len());
                let found = found.map(|(value, length)| (value.to_bits(), length));
                prop_assert_eq!(found, expected);
            }
        }

        /// Zeros follow the end of a text.
        #[test]
        fn a_word_ends_with_the_text(text in prop::collection::vec(1..=255_u8, 8..20), at in 0..22_usize) {
            let behind = text.iter().copied().chain([0; 8]);
            let expected: Vec<u8> = behind.skip(at).take(8).collect();
            let word = word_at(&text, at);
            prop_assert_eq!(word.map(Vec::from), (at <= text.len()).then_some(expected));
        }

        /// Integers as the standard library reads their digits; one of eight digits or more is left to others.
        #[test]
        fn an_integer_ends_at_its_last_digit(number in "[0-9]{0,9}", behind in "[^0-9][ -~]{8}") {
            let word = format!("{number}{behind}").as_bytes().first_chunk().copied();
            let expected = number.parse().ok().filter(|_| number.len() < 8);
            prop_assert_eq!(word.and_then(integer_in_word), expected.map(|x| (x, number.len())));
        }

        /// The standard library rounds correctly: the result must have the same bits.
        #[test]
        fn rounds_as_the_standard_library(text in "[0-9]{0,20}\\.[0-9]{1,18}|[0-9]{1,25}\\.?") {
            let expected: f64 = text.parse().unwrap();
            prop_assert_eq!(decimal(&text).unwrap().to_bits(), expected.to_bits());
        }
    }
}
