//! Fixed-point formatting of f64 and exact formatting of times.
//!
//! The standard library's `{:.7}` is exact for every f64 and needs 80 ns per number; a trace of a machine needs 13
//! numbers per cycle. Here `value * 10^d` is rounded half away from zero to an integer, exactly: the product's own
//! rounding error matters only when the product lands on a tie, and then a fused multiply-add gives its sign.

/// Two decimal digits of 0..=99.
const PAIRS: [[u8; 2]; 100] = {
    let mut table = [[b'0'; 2]; 100];
    let mut i = 0;
    while i < 100 {
        table[i] = [b'0' + (i / 10) as u8, b'0' + (i % 10) as u8];
        i += 1;
    }
    table
};

/// `10^d` for the number of decimals in use.
const POWERS: [u64; 8] = [1, 10, 100, 1_000, 10_000, 100_000, 1_000_000, 10_000_000];

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
        // an axis at rest, and a column that is not in use
        out.extend_from_slice(if DECIMALS > 0 { &ZERO[..DECIMALS + 2] } else { &ZERO[..1] });
    } else if product.abs() < EXACT_BELOW {
        push_scaled::<DECIMALS>(out, round_product(value, scale, product));
    } else if value.is_finite() {
        push_slow(out, value, DECIMALS as u8);
    }
}

/// `value * scale` rounded half away from zero, where `product` is their rounded product.
#[expect(clippy::float_cmp, reason = "a tie is an exact bit pattern")]
fn round_product(value: f64, scale: f64, product: f64) -> i64 {
    // truncation is exact, and so is the rest
    let whole = product as i64;
    let rest = (product - whole as f64).abs();
    let away = if rest == 0.5 {
        // the true product may lie on either side of the tie: the sign of the rounding error decides
        let error = value.mul_add(scale, -product);
        error * product.signum() >= 0.0
    } else {
        rest > 0.5
    };
    if away { whole + if product < 0.0 { -1 } else { 1 } } else { whole }
}

/// Room for the digits of a number, which end at [`END`], and as much again after them.
type Digits = [u8; 2 * END];

/// Longest number: 20 digits of an integer, or 16 with sign and point.
const END: usize = 24;

/// Appends the digits from `at` to [`END`]. A copy of fixed length is a few instructions, one of any length a call.
fn push_digits(out: &mut Vec<u8>, text: &Digits, at: usize) {
    let length = out.len() + END - at;
    out.extend_from_slice(&text[at..at + END]);
    out.truncate(length);
}

/// Appends `scaled / 10^DECIMALS`.
fn push_scaled<const DECIMALS: usize>(out: &mut Vec<u8>, scaled: i64) {
    let magnitude = scaled.unsigned_abs();
    let (whole, mut part) = (magnitude / POWERS[DECIMALS], magnitude % POWERS[DECIMALS]);
    let mut text: Digits = [b'0'; 2 * END];
    let mut at = END;
    for _ in 0..DECIMALS / 2 {
        at -= 2;
        text[at..at + 2].copy_from_slice(&PAIRS[(part % 100) as usize]);
        part /= 100;
    }
    if DECIMALS % 2 == 1 {
        at -= 1;
        text[at] = b'0' + part as u8;
    }
    if DECIMALS > 0 {
        at -= 1;
        text[at] = b'.';
    }
    at = put_digits(&mut text, at, whole, 1);
    if scaled < 0 {
        at -= 1;
        text[at] = b'-';
    }
    push_digits(out, &text, at);
}

/// Writes the digits of `n`, at least `width`, so that they end before `at`; gives back where they start.
fn put_digits(text: &mut Digits, mut at: usize, mut n: u64, width: usize) -> usize {
    let end = at;
    while n >= 10 {
        at -= 2;
        text[at..at + 2].copy_from_slice(&PAIRS[(n % 100) as usize]);
        n /= 100;
    }
    if n > 0 {
        at -= 1;
        text[at] = b'0' + n as u8;
    }
    while end - at < width {
        at -= 1;
        text[at] = b'0';
    }
    at
}

/// Values beyond the range of machines, and more decimals than any column has.
fn push_slow(out: &mut Vec<u8>, value: f64, decimals: u8) {
    out.extend_from_slice(format!("{value:.*}", usize::from(decimals)).as_bytes());
}

/// Appends an unsigned integer.
pub(crate) fn push_integer(out: &mut Vec<u8>, n: u64) {
    let mut text: Digits = [b'0'; 2 * END];
    let at = put_digits(&mut text, END, n, 1);
    push_digits(out, &text, at);
}

/// Appends microseconds as seconds with six decimals, exactly.
pub(crate) fn push_seconds(out: &mut Vec<u8>, micros: u64) {
    push_integer(out, micros / 1_000_000);
    let mut text: Digits = [b'0'; 2 * END];
    let at = put_digits(&mut text, END, micros % 1_000_000, 6);
    out.push(b'.');
    push_digits(out, &text, at);
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
