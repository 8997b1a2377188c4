//! Fixed-point formatting of f64 and exact formatting of times.
//!
//! The standard library's `{:.7}` is exact for every f64 and needs 80 ns per number; a trace of a machine has about 30
//! numbers per cycle. Here `value * 10^d` is rounded half away from zero to an integer, exactly: the rounding error of
//! the product only matters if the product is a tie, and then a fused multiply-add gives its sign.
//!
//! The numbers of a column are rounded and divided at their decimal points together ([`NumberTable`]), several per
//! instruction; ties and numbers that are too large are left to [`Cells::push_fixed`]. Each number is then written to
//! its final place, in words of a fixed length whose last bytes the next number overwrites. Digits assembled elsewhere
//! could only be copied after all of them have been stored, which stalls the processor.

mod table;

pub(crate) use table::NumberTable;

/// Three decimal digits of 0..=999 as bytes, the first one in the lowest byte.
static TRIPLES: [u32; 1000] = {
    let mut table = [0; 1000];
    let mut i = 0;
    while i < 1000 {
        let digits = [b'0' + (i / 100) as u8, b'0' + (i / 10 % 10) as u8, b'0' + (i % 10) as u8, 0];
        table[i] = u32::from_le_bytes(digits);
        i += 1;
    }
    table
};

/// `10^d` for the number of decimals in use.
const POWERS: [u64; MOST_DECIMALS + 1] =
    [1, 10, 100, 1_000, 10_000, 100_000, 1_000_000, 10_000_000];

/// Largest number of decimals that is not left to the standard library.
const MOST_DECIMALS: usize = 7;

/// Zero with the largest number of decimals.
const ZERO: [u8; 16] = *b"0.00000000000000";

/// Products below this have room for a tie bit: `2^52`.
const EXACT_BELOW: f64 = 4_503_599_627_370_496.0;

/// A number in decimal notation.
#[derive(Clone, Copy, Debug)]
struct Divided {
    negative: bool,
    whole: u64,
    /// The fraction times `10^7`.
    part: u32,
}

impl Divided {
    /// Writes the number and a comma to the beginning of a cell; returns its length without the comma.
    #[inline]
    fn put(self, cell: &mut Cell, decimals: u8) -> usize {
        let after_point = if decimals > 0 { 1 + usize::from(decimals) } else { 0 };
        let length = if self.whole == 0 && self.part == 0 {
            // an axis at rest, or an unused column
            store(cell, 0, ZERO);
            1 + after_point
        } else {
            cell[0] = b'-';
            let at = put_whole(cell, usize::from(self.negative), self.whole);
            put_part(cell, at, self.part);
            at + after_point
        };
        cell[length] = b',';
        length
    }
}

/// An integer that mostly is the same as in the row before, with its text.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Repeating {
    n: u64,
    text: [u8; 24],
    /// 0 before the first one.
    length: usize,
}

/// Text of a table that grows cell by cell.
#[derive(Clone, Debug, Default)]
pub(crate) struct Cells {
    /// The text, with spare room.
    bytes: Vec<u8>,
    end: usize,
}

/// Room for any number except those of [`Cells::push_slow`]: 20 digits, sign, point, decimals, comma, and one word.
type Cell = [u8; 48];

impl Cells {
    /// An empty text with room for a number of bytes.
    pub(crate) fn with_capacity(bytes: usize) -> Self {
        Self { bytes: vec![0; bytes + size_of::<Cell>()], end: 0 }
    }

    pub(crate) fn as_bytes(&self) -> &[u8] {
        &self.bytes[..self.end]
    }

    /// The text as a vector of bytes.
    pub(crate) fn into_bytes(mut self) -> Vec<u8> {
        self.bytes.truncate(self.end);
        self.bytes
    }

    /// Number of bytes.
    pub(crate) const fn len(&self) -> usize {
        self.end
    }

    /// Removes the text but keeps the memory.
    pub(crate) const fn clear(&mut self) {
        self.end = 0;
    }

    /// Appends bytes.
    #[inline]
    pub(crate) fn push_bytes(&mut self, bytes: &[u8]) {
        if self.bytes.len() - self.end < bytes.len() {
            self.grow(bytes.len());
        }
        self.bytes[self.end..][..bytes.len()].copy_from_slice(bytes);
        self.end += bytes.len();
    }

    /// Appends a comma.
    #[inline]
    pub(crate) fn push_comma(&mut self) {
        self.push_bytes(b",");
    }

    /// Replaces the last byte by the end of a line.
    pub(crate) fn end_line(&mut self) {
        if let Some(last) = self.bytes[..self.end].last_mut() {
            *last = b'\n';
        }
    }

    #[cold]
    fn grow(&mut self, more: usize) {
        self.bytes.resize(2 * self.end + more + size_of::<Cell>(), 0);
    }

    /// Appends what `put` writes into a cell; `put` returns the number of bytes.
    #[inline]
    fn push_cell(&mut self, put: impl FnOnce(&mut Cell) -> usize) {
        loop {
            let room = self.bytes.get_mut(self.end..).and_then(<[u8]>::first_chunk_mut);
            if let Some(cell) = room {
                self.end += put(cell);
                return;
            }
            self.grow(0);
        }
    }

    /// Appends what `put` writes into a cell for each item; stops at the first item for which it writes nothing, and
    /// returns that item.
    #[inline]
    fn push_cells<'a, T>(
        &mut self,
        items: &mut std::slice::Iter<'a, T>,
        put: impl Fn(&T, &mut Cell) -> Option<usize>,
    ) -> Option<&'a T> {
        let room = items.len() * size_of::<Cell>();
        if self.bytes.len() - self.end < room {
            self.grow(room);
        }
        let Self { bytes, end } = self;
        items.find(|item| {
            let cell = bytes.get_mut(*end..).and_then(<[u8]>::first_chunk_mut);
            let length = cell.and_then(|cell| put(item, cell));
            *end += length.unwrap_or_default();
            length.is_none()
        })
    }

    /// Appends `value` with `decimals` digits after the point, rounded half away from zero.
    ///
    /// Zero has no sign. For a value that is not finite the cell is empty, which every reader takes as "not a number"
    /// and which keeps the columns in place.
    pub(crate) fn push_fixed(&mut self, value: f64, decimals: u8) {
        let Some(&power) = POWERS.get(usize::from(decimals)) else {
            return self.push_slow(value, decimals);
        };
        let scale = power as f64;
        let product = value * scale;
        if product.abs() < EXACT_BELOW {
            let rounded = round_product(value, scale, product);
            let magnitude = rounded.unsigned_abs();
            let part = (magnitude % power * (POWERS[MOST_DECIMALS] / power)) as u32;
            let number = Divided { negative: rounded < 0, whole: magnitude / power, part };
            self.push_cell(|cell| number.put(cell, decimals));
        } else {
            self.push_slow(value, decimals);
        }
    }

    /// Values beyond the range of machines, values that are not finite (empty), and more decimals than any column has.
    #[cold]
    fn push_slow(&mut self, value: f64, decimals: u8) {
        if value.is_finite() {
            self.push_bytes(format!("{value:.*}", usize::from(decimals)).as_bytes());
        }
    }

    /// Appends an unsigned integer; `last` belongs to its column.
    #[inline]
    pub(crate) fn push_integer(&mut self, n: u64, last: &mut Repeating) {
        self.push_cell(|cell| {
            if last.length == 0 || last.n != n {
                let length = put_whole(cell, 0, n);
                let text = cell.first_chunk().copied().unwrap_or_default();
                *last = Repeating { n, text, length };
            } else {
                store(cell, 0, last.text);
            }
            last.length
        });
    }

    /// Appends microseconds as seconds with six decimals, exactly.
    #[inline]
    pub(crate) fn push_seconds(&mut self, micros: u64) {
        self.push_cell(|cell| {
            let at = put_whole(cell, 0, micros / 1_000_000);
            put_part(cell, at, (micros % 1_000_000 * 10) as u32);
            at + 7
        });
    }
}

/// Writes a point and the seven digits of `part / 10^7`. The word is assembled in a register: bytes stored one by one
/// could not be read back as a word before all of them are stored.
#[inline]
fn put_part(cell: &mut Cell, at: usize, part: u32) {
    let (first, rest) = (part / 1_000_000, part % 1_000_000);
    let begin = u32::from(b'.') | (u32::from(b'0') + first) << 8;
    let middle = u64::from(TRIPLES[(rest / 1000) as usize]) << 16;
    let end = u64::from(TRIPLES[(rest % 1000) as usize]) << 40;
    store(cell, at, (u64::from(begin) | middle | end).to_le_bytes());
}

/// Writes a word, but nothing beyond the end of the cell, which numbers do not reach.
#[inline]
fn store<const N: usize>(cell: &mut Cell, at: usize, word: [u8; N]) {
    if let Some(place) = cell.get_mut(at..).and_then(<[u8]>::first_chunk_mut) {
        *place = word;
    }
}

/// Writes the digits of `n`, and returns the position after them.
#[inline]
fn put_whole(cell: &mut Cell, at: usize, n: u64) -> usize {
    if n < 1000 { put_short(cell, at, n) } else { put_long(cell, at, n) }
}

/// The same for up to three digits.
#[inline]
fn put_short(cell: &mut Cell, at: usize, n: u64) -> usize {
    let length = 1 + usize::from(n >= 10) + usize::from(n >= 100);
    let digits = TRIPLES[n as usize] >> (8 * (3 - length));
    store(cell, at, digits.to_le_bytes());
    at + length
}

/// The same for more than three digits.
fn put_long(cell: &mut Cell, at: usize, n: u64) -> usize {
    let (before, last) = (n / 1000, n % 1000);
    let at = if before < 1000 { put_short(cell, at, before) } else { put_long(cell, at, before) };
    store(cell, at, TRIPLES[last as usize].to_le_bytes());
    at + 3
}

/// `value * scale` rounded half away from zero, where `product` is their rounded product.
#[inline]
#[expect(clippy::float_cmp, reason = "a tie is an exact bit pattern")]
fn round_product(value: f64, scale: f64, product: f64) -> i64 {
    // truncation is exact, and so is the remainder
    let whole = product as i64;
    let rest = (product - whole as f64).abs();
    let outwards = if product < 0.0 { -1 } else { 1 };
    let away = if rest == 0.5 {
        // the true product may lie on either side of the tie: the sign of the rounding error decides
        let error = value.mul_add(scale, -product);
        error * product.signum() >= 0.0
    } else {
        rest > 0.5
    };
    // without a branch, which could not be predicted
    whole + outwards * i64::from(away)
}

#[cfg(test)]
mod tests {
    use super::*;
    use kontur_kit::Random;

    /// Formatted alone, and as a number of a table.
    fn fixed(value: f64, decimals: u8) -> String {
        let (mut out, mut row) = (Cells::default(), Cells::default());
        out.push_fixed(value, decimals);
        let mut numbers = NumberTable::new(&[2, decimals]);
        numbers.take(&[vec![0.5, 0.7], vec![0.5, value]], 0..2);
        numbers.push(&mut row, 1, 1..2);
        let text = String::from_utf8(out.as_bytes().to_vec()).unwrap();
        assert_eq!(row.as_bytes(), format!("{text},").as_bytes());
        text
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
        let mut out = Cells::default();
        for micros in [0, 1_834_000, 10_000_000_000_062] {
            out.push_seconds(micros);
            out.push_comma();
        }
        let mut last = Repeating::default();
        for n in [0, 7, 7, 10, 999, 1000, 20_034, u64::MAX, u64::MAX, 0] {
            out.push_integer(n, &mut last);
            out.push_comma();
        }
        assert_eq!(
            std::str::from_utf8(out.as_bytes()).unwrap(),
            "0.000000,1.834000,10000000.000062,\
             0,7,7,10,999,1000,20034,18446744073709551615,18446744073709551615,0,"
        );
    }
}
