//! Fixed-point formatting of f64 and exact formatting of times.
//!
//! The standard library's `{:.7}` is exact for every f64 and needs 80 ns per number; a trace of a machine has about 30
//! numbers per cycle. Here `value * 10^d` is rounded half away from zero to an integer, exactly: the rounding error of
//! the product only matters if the product is a tie, and then a fused multiply-add gives its sign.
//!
//! The numbers of a column are rounded together ([`NumberTable`]), several per instruction, and written as texts of a
//! fixed length, from which the lines are assembled. A number mostly has the sign and integer part of the row before,
//! so only its fraction is converted. Ties and numbers that are too large are left to [`Cells::push_fixed`].
//!
//! Bytes of a text that have just been stored in pieces could only be copied after all of them have reached the cache,
//! which stalls the processor; so the texts of many rows are made before the first line is assembled.

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
    /// Writes the number to the beginning of a cell; returns its length.
    #[inline]
    fn put(self, cell: &mut Cell, decimals: u8) -> usize {
        cell[0] = b'-';
        // zero has no sign
        let signed = self.negative && (self.whole != 0 || self.part != 0);
        let at = put_whole(cell, usize::from(signed), self.whole);
        put_part(cell, at, self.part);
        at + if decimals > 0 { 1 + usize::from(decimals) } else { 0 }
    }
}

/// A cell that mostly is the same as in the row before, with its text.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Repeating {
    key: u64,
    text: [u8; 24],
    /// With the comma; 0 before the first one.
    length: usize,
}

/// Text of a table that grows cell by cell.
#[derive(Clone, Debug, Default)]
pub(crate) struct Cells {
    /// The text, with spare room.
    bytes: Vec<u8>,
    end: usize,
}

/// A short number with its comma, and spare bytes.
type Text = [u8; 16];

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

    /// Appends the text of each item, given with its length; stops at the first item whose length is 0, and returns that
    /// item.
    #[inline]
    fn push_texts<'a, T>(
        &mut self,
        items: &mut std::slice::Iter<'a, T>,
        text_of: impl Fn(&T) -> (Text, u8),
    ) -> Option<&'a T> {
        let room = (items.len() + 1) * size_of::<Text>();
        if self.bytes.len() - self.end < room {
            self.grow(room);
        }
        let all = self.bytes.len();
        let mut rest = &mut self.bytes[self.end..];
        let found = items.find(|item| {
            let (text, length) = text_of(item);
            if let Some(place) = rest.first_chunk_mut() {
                *place = text;
                // for the compiler: not longer than the text
                let used = usize::from(length) % size_of::<Text>();
                rest = &mut std::mem::take(&mut rest)[used..];
            }
            length == 0
        });
        self.end = all - rest.len();
        found
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

    /// Appends an unsigned integer and a comma; `last` belongs to its column.
    #[inline]
    pub(crate) fn push_integer(&mut self, n: u64, last: &mut Repeating) {
        self.push_repeating(n, last, |cell| put_whole(cell, 0, n));
    }

    /// Appends the name with the number `key`, of at most 23 bytes, and a comma; `last` belongs to its column.
    #[inline]
    pub(crate) fn push_name(&mut self, key: u64, name: &str, last: &mut Repeating) {
        self.push_repeating(key, last, |cell| {
            cell[..name.len()].copy_from_slice(name.as_bytes());
            name.len()
        });
    }

    /// Appends what `put` writes for a key, and a comma; `put` returns the number of bytes.
    #[inline]
    fn push_repeating(
        &mut self,
        key: u64,
        last: &mut Repeating,
        put: impl FnOnce(&mut Cell) -> usize,
    ) {
        self.push_cell(|cell| {
            if last.length == 0 || last.key != key {
                let length = put(cell);
                cell[length] = b',';
                let text = cell.first_chunk().copied().unwrap_or_default();
                *last = Repeating { key, text, length: length + 1 };
            } else {
                store(cell, 0, last.text);
            }
            last.length
        });
    }

    /// Appends microseconds as seconds with six decimals, exactly, and a comma.
    #[inline]
    pub(crate) fn push_seconds(&mut self, micros: u64) {
        self.push_cell(|cell| {
            let at = put_whole(cell, 0, micros / 1_000_000);
            put_part(cell, at, (micros % 1_000_000 * 10) as u32);
            cell[at + 7] = b',';
            at + 8
        });
    }
}

/// Writes a point and the seven digits of `part / 10^7`.
#[inline]
fn put_part(cell: &mut Cell, at: usize, part: u32) {
    store(cell, at, (u64::from(b'.') | fraction(part) << 8).to_le_bytes());
}

/// The seven digits of `part / 10^7`, the first one in the lowest byte; the highest byte is 0.
#[inline]
fn fraction(part: u32) -> u64 {
    let (first, rest) = (part / 1_000_000, part % 1_000_000);
    let begin = u64::from(b'0') + u64::from(first);
    let middle = u64::from(TRIPLES[(rest / 1000) as usize]) << 8;
    let end = u64::from(TRIPLES[(rest % 1000) as usize]) << 32;
    begin | middle | end
}

/// Writes a word, but nothing beyond the end of a cell or text, which numbers do not reach.
#[inline]
fn store<const N: usize>(text: &mut [u8], at: usize, word: [u8; N]) {
    if let Some(place) = text.get_mut(at..).and_then(<[u8]>::first_chunk_mut) {
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
mod tests;
