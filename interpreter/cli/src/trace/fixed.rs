//! Fixed-point formatting of f64 and exact formatting of times.
//!
//! The standard library's `{:.7}` is exact for every f64 and needs 80 ns per number; a trace of a machine needs 13
//! numbers per cycle. Here `value * 10^d` is rounded half away from zero to an integer, exactly: the product's own
//! rounding error matters only when the product lands on a tie, and then a fused multiply-add gives its sign. Digits are
//! made eight at a time in one register and go from there to their place.

/// `10^d` for the number of decimals in use, and for eight digits.
const POWERS: [u64; 9] = [1, 10, 100, 1_000, 10_000, 100_000, 1_000_000, 10_000_000, 100_000_000];

/// Zero with the largest number of decimals.
const ZERO: &[u8] = b"0.0000000";

/// Products below this have room for a tie bit: `2^52`.
const EXACT_BELOW: f64 = 4_503_599_627_370_496.0;

/// Appends `value` with `decimals` (at most 7) digits after the point, rounded half away from zero.
///
/// Zero has no sign. A value that is not finite leaves nothing: an empty cell reads as "not a number" everywhere and
/// keeps the columns in place.
pub(crate) fn push_fixed(out: &mut Vec<u8>, value: f64, decimals: u8) {
    // with the number of decimals known, divisions become multiplications and loops straight lines
    match decimals {
        0 => push::<0>(out, value),
        1 => push::<1>(out, value),
        2 => push::<2>(out, value),
        3 => push::<3>(out, value),
        4 => push::<4>(out, value),
        5 => push::<5>(out, value),
        6 => push::<6>(out, value),
        7 => push::<7>(out, value),
        _ => push_slow(out, value, decimals),
    }
}

fn push<const DECIMALS: usize>(out: &mut Vec<u8>, value: f64) {
    let scale = POWERS[DECIMALS] as f64;
    let product = value * scale;
    if product == 0.0 {
        // what stands, and what is not in use
        out.extend_from_slice(if DECIMALS > 0 { &ZERO[..DECIMALS + 2] } else { &ZERO[..1] });
    } else if product.abs() < EXACT_BELOW {
        if product < 0.0 {
            let digits = round_product(-value, scale, -product);
            // what is rounded away leaves no sign
            if digits > 0 {
                out.push(b'-');
            }
            push_scaled::<DECIMALS>(out, digits);
        } else {
            push_scaled::<DECIMALS>(out, round_product(value, scale, product));
        }
    } else if value.is_finite() {
        push_slow(out, value, DECIMALS as u8);
    }
}

/// `value * scale` rounded half away from zero, where `product`, which is positive, is their rounded product.
#[expect(clippy::float_cmp, reason = "a tie is an exact bit pattern")]
fn round_product(value: f64, scale: f64, product: f64) -> u64 {
    // from here on the last bit of a number counts ones
    let sum = product + EXACT_BELOW;
    let nearest = sum.to_bits() - EXACT_BELOW.to_bits();
    // exact, as both lie close together
    let rest = product - (sum - EXACT_BELOW);
    if rest.abs() != 0.5 {
        return nearest;
    }
    // the true product may lie on either side of the tie: the sign of the rounding error decides
    let away = value.mul_add(scale, -product) >= 0.0;
    product as u64 + u64::from(away)
}

/// Appends `scaled / 10^DECIMALS`.
fn push_scaled<const DECIMALS: usize>(out: &mut Vec<u8>, scaled: u64) {
    push_integer(out, scaled / POWERS[DECIMALS]);
    push_part::<DECIMALS>(out, scaled % POWERS[DECIMALS]);
}

/// Appends point and digits of `part / 10^DECIMALS`, less than one.
fn push_part<const DECIMALS: usize>(out: &mut Vec<u8>, part: u64) {
    if DECIMALS > 0 {
        let digits = as_text(digits(part * POWERS[8 - DECIMALS]));
        let length = out.len() + 1 + DECIMALS;
        out.extend_from_slice(&(u64::from(b'.') | digits << 8).to_le_bytes());
        out.truncate(length);
    }
}

/// The eight digits of a number below 10^8, the first one in the lowest byte.
#[inline]
fn digits(n: u64) -> u64 {
    // parts of four digits, of two, of one: each division is a product that is exact for so many digits
    let fours = n / 10_000;
    let fours = fours | (n - 10_000 * fours) << 32;
    let twos = ((fours * 10_486) >> 20) & 0x0000_007f_0000_007f;
    let twos = twos | (fours - 100 * twos) << 16;
    let ones = ((twos * 103) >> 10) & 0x000f_000f_000f_000f;
    ones | (twos - 10 * ones) << 8
}

/// Digits as characters.
#[inline]
fn as_text(digits: u64) -> u64 {
    digits | u64::from_le_bytes([b'0'; 8])
}

/// Values beyond the range of machines, and more decimals than any column has.
fn push_slow(out: &mut Vec<u8>, value: f64, decimals: u8) {
    out.extend_from_slice(format!("{value:.*}", usize::from(decimals)).as_bytes());
}

/// Appends an unsigned integer.
#[inline]
pub(crate) fn push_integer(out: &mut Vec<u8>, n: u64) {
    if n < 10 {
        out.push(b'0' + n as u8);
    } else if n < POWERS[8] {
        let digits = digits(n);
        let leading = digits.trailing_zeros() / 8;
        let length = out.len() + 8 - leading as usize;
        out.extend_from_slice(&(as_text(digits) >> (8 * leading)).to_le_bytes());
        out.truncate(length);
    } else {
        push_integer(out, n / POWERS[8]);
        out.extend_from_slice(&as_text(digits(n % POWERS[8])).to_le_bytes());
    }
}

/// Appends microseconds as seconds with six decimals, exactly.
pub(crate) fn push_seconds(out: &mut Vec<u8>, micros: u64) {
    push_scaled::<6>(out, micros);
}

#[cfg(test)]
mod tests {
    use super::*;
    use kontur_kit::Random;

    fn fixed(value: f64, decimals: u8) -> String {
        let mut out = Vec::new();
        push_fixed(&mut out, value, decimals);
        String::from_utf8(out).unwrap()
    }

    /// Schoolbook: the exact decimal expansion of the f64 (never more than 1074 digits), rounded half away by hand.
    fn reference(value: f64, decimals: usize) -> String {
        let exact = format!("{:.1100}", value.abs());
        let (whole, part) = exact.split_once('.').unwrap();
        let mut digits: Vec<u8> = format!("{whole}{}", &part[..decimals]).into_bytes();
        if part.as_bytes()[decimals] >= b'5' {
            let mut i = digits.len();
            loop {
                if i == 0 {
                    digits.insert(0, b'1');
                    break;
                }
                i -= 1;
                if digits[i] < b'9' {
                    digits[i] += 1;
                    break;
                }
                digits[i] = b'0';
            }
        }
        let zero = digits.iter().all(|&d| d == b'0');
        let mut text = String::from_utf8(digits).unwrap();
        if decimals > 0 {
            text.insert(text.len() - decimals, '.');
        }
        if value < 0.0 && !zero { format!("-{text}") } else { text }
    }

    #[test]
    fn equals_the_exact_expansion() {
        let mut random = Random::new(1);
        for i in 0..4000 {
            let bits = random.bits();
            // plain mantissas, halves of the last digit and their neighbours, and fractions that tie exactly
            let unit = (bits >> 11) as f64 / (1u64 << 53) as f64;
            let tie = ((bits >> 40) as f64 + 0.5) / 1e7;
            let value = match i % 6 {
                0 => unit * 1000.0,
                1 => unit * 1e-6,
                2 => tie,
                3 => tie.next_up(),
                4 => tie.next_down(),
                _ => (bits >> 44) as f64 / 256.0,
            };
            for decimals in [0, 2, 4, 6, 7] {
                for v in [value, -value] {
                    assert_eq!(
                        fixed(v, decimals),
                        reference(v, usize::from(decimals)),
                        "{v:e} {decimals}"
                    );
                }
            }
        }
    }

    /// Every pair of digits in every place, beside the formatting of the standard library.
    #[test]
    fn digits_are_those_of_the_standard_library() {
        for n in 0..10_000 {
            for n in [n, 10_000 * n, 10_000 * n + n, 10_000 * n + 9_999 - n] {
                assert_eq!(as_text(digits(n)).to_le_bytes(), *format!("{n:08}").as_bytes());
            }
        }
        for n in (0..64).flat_map(|bits| [(1_u64 << bits) - 1, 1 << bits, u64::MAX >> bits]) {
            let mut out = Vec::new();
            push_integer(&mut out, n);
            assert_eq!(String::from_utf8(out).unwrap(), n.to_string());
        }
    }

    #[test]
    fn edges() {
        assert_eq!(fixed(0.0, 7), "0.0000000");
        assert_eq!(fixed(-0.0, 7), "0.0000000");
        assert_eq!(fixed(-4.9e-8, 7), "0.0000000");
        assert_eq!(fixed(-5.1e-8, 7), "-0.0000001");
        // 1/256 = 0.00390625 is a true tie
        assert_eq!(fixed(0.003_906_25, 7), "0.0039063");
        assert_eq!(fixed(-0.003_906_25, 7), "-0.0039063");
        assert_eq!(fixed(0.999_999_99, 7), "1.0000000");
        assert_eq!(fixed(1e8, 7), "100000000.0000000");
        assert_eq!(fixed(-1e12, 7), "-1000000000000.0000000");
        assert_eq!(fixed(f64::MAX, 2), format!("{:.2}", f64::MAX));
        assert_eq!(fixed(f64::NAN, 7), "");
        assert_eq!(fixed(f64::INFINITY, 7), "");
        assert_eq!(fixed(123_456.789, 0), "123457");
        assert_eq!(fixed(f64::from_bits(1), 7), "0.0000000");
    }

    #[test]
    fn times_and_integers_are_exact() {
        let mut out = Vec::new();
        push_seconds(&mut out, 0);
        out.push(b' ');
        push_seconds(&mut out, 1_834_000);
        out.push(b' ');
        push_seconds(&mut out, 10_000_000_000_062);
        out.push(b' ');
        push_integer(&mut out, 0);
        out.push(b' ');
        push_integer(&mut out, u64::MAX);
        assert_eq!(
            String::from_utf8(out).unwrap(),
            "0.000000 1.834000 10000000.000062 0 18446744073709551615"
        );
    }
}
