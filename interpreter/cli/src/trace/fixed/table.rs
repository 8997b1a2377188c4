//! Columns of numbers as cells of rows: the texts of a column are made together, those of a row are copied together.

use super::{Cells, MOST_DECIMALS, POWERS, Text, fraction, put_whole, round_product, store};
use std::ops::Range;

/// `1.5 * 2^52`: added to a number below `2^51` it leaves the rounded number in the lowest bits.
const ROUNDER: f64 = 6_755_399_441_055_744.0;

/// Integer parts from here on are too long for a [`Text`].
const WHOLE_BELOW: u64 = 100_000;

/// The numbers of several rows of a table, each column with its number of decimals.
#[derive(Clone, Debug)]
pub(crate) struct NumberTable {
    columns: Vec<NumberColumn>,
}

impl NumberTable {
    /// Number of rows that are processed together.
    pub(crate) const ROWS: usize = 32;

    /// For columns with these numbers of decimals.
    pub(crate) fn new(decimals: &[u8]) -> Self {
        Self { columns: decimals.iter().map(|&decimals| NumberColumn::new(decimals)).collect() }
    }

    /// Takes the numbers of some rows, at most [`Self::ROWS`].
    pub(crate) fn take(&mut self, columns: &[Vec<f64>], rows: Range<usize>) {
        for (column, values) in self.columns.iter_mut().zip(columns) {
            column.take(&values[rows.clone()]);
        }
    }

    /// Appends some of the numbers of a row, each with a comma.
    #[inline]
    pub(crate) fn push(&self, out: &mut Cells, row: usize, columns: Range<usize>) {
        // for the compiler: the index is in range
        let row = row % Self::ROWS;
        let mut columns = self.columns[columns].iter();
        while let Some(long) =
            out.push_texts(&mut columns, |column| (column.texts[row], column.lengths[row]))
        {
            out.push_fixed(long.values[row], long.decimals);
            out.push_comma();
        }
    }
}

/// The numbers of a column, as texts.
#[derive(Clone, Debug)]
struct NumberColumn {
    decimals: u8,
    /// `10^decimals`, and the bound of the products for [`WHOLE_BELOW`].
    power: f64,
    product_below: f64,
    digits: Digits,
    near: Near,
    texts: [Text; NumberTable::ROWS],
    /// Length of each text with its comma; 0 for a number that has none, which `values` then holds.
    lengths: [u8; NumberTable::ROWS],
    values: [f64; NumberTable::ROWS],
    /// Bits of the number whose text all rows have.
    uniform: Option<u64>,
}

impl NumberColumn {
    fn new(decimals: u8) -> Self {
        // with more decimals than supported the power is NaN, for which nothing is rounded
        let power = POWERS.get(usize::from(decimals)).map_or(f64::NAN, |power| *power as f64);
        let digits = Digits::new(decimals);
        Self {
            decimals,
            power,
            product_below: power * (WHOLE_BELOW - 1) as f64,
            digits,
            near: Near::around(0, &digits),
            texts: [[0; 16]; NumberTable::ROWS],
            lengths: [0; NumberTable::ROWS],
            values: [0.0; NumberTable::ROWS],
            uniform: None,
        }
    }

    /// Makes the texts of some numbers.
    fn take(&mut self, values: &[f64]) {
        let first = values.first().map(|value| value.to_bits());
        let same = values.iter().all(|value| Some(value.to_bits()) == first);
        if same && self.uniform == first {
            return;
        }
        self.uniform = first.filter(|_| same && values.len() == NumberTable::ROWS);
        let mut rounded = [0; NumberTable::ROWS];
        let mut known = true;
        for (value, rounded) in values.iter().zip(&mut rounded) {
            // without branches, so that several numbers are processed at once
            let product = value * self.power;
            let sum = product + ROUNDER;
            // no tie, and not too large; NaN fails both comparisons
            known &=
                ((product - (sum - ROUNDER)).abs() < 0.5) & (product.abs() < self.product_below);
            *rounded = sum.to_bits().wrapping_sub(ROUNDER.to_bits()).cast_signed();
        }
        if !known {
            return self.take_each(values);
        }
        let count = values.len().min(NumberTable::ROWS);
        let texts = self.texts[..count].iter_mut().zip(&mut self.lengths[..count]);
        for (rounded, (text, length)) in rounded[..count].iter().zip(texts) {
            *length = self.digits.put(&mut self.near, *rounded, text);
        }
    }

    /// The same where some numbers are ties, too large or not finite.
    #[cold]
    fn take_each(&mut self, values: &[f64]) {
        self.values[..values.len()].copy_from_slice(values);
        for ((value, text), length) in values.iter().zip(&mut self.texts).zip(&mut self.lengths) {
            let product = value * self.power;
            *length = 0;
            if product.abs() < self.product_below {
                let rounded = round_product(*value, self.power, product);
                *length = self.digits.put(&mut self.near, rounded, text);
            }
        }
    }
}

/// How a column writes its numbers, which are given in units of the last decimal.
#[derive(Clone, Copy, Debug)]
struct Digits {
    power: u64,
    /// The remaining factor up to `10^7`.
    fill: u32,
    /// Difference between the byte after the last decimal and a comma.
    comma: u64,
}

impl Digits {
    fn new(decimals: u8) -> Self {
        let decimals = usize::from(decimals).min(MOST_DECIMALS);
        // zeros follow the last decimal up to the seventh, then a byte 0
        let after = if decimals == MOST_DECIMALS { 0 } else { b'0' };
        Self {
            power: POWERS[decimals],
            fill: (POWERS[MOST_DECIMALS] / POWERS[decimals]) as u32,
            comma: u64::from(b',' ^ after) << (8 * decimals),
        }
    }

    /// Writes a number below [`WHOLE_BELOW`] and a comma; returns their length.
    #[inline]
    fn put(&self, near: &mut Near, n: i64, text: &mut Text) -> u8 {
        let part = near.part(n).unwrap_or_else(|| {
            *near = Near::around(n, self);
            near.part(n).unwrap_or_default()
        });
        let end = fraction(part * self.fill) ^ self.comma;
        store(text, 0, near.text);
        // for the compiler: within the text
        store(text, usize::from(near.before % 8), end.to_le_bytes());
        near.length
    }
}

/// The numbers with the same sign and integer part, which a column mostly keeps from one row to the next.
#[derive(Clone, Copy, Debug)]
struct Near {
    /// 0, or -1 for negative numbers, which are inverted bit by bit.
    flip: i64,
    /// The (inverted) number with the fraction 0.
    base: i64,
    /// The fractions: `first` and the next ones, without 0 after `-0`.
    first: u64,
    count: u64,
    /// Sign, integer part and point.
    text: [u8; 8],
    /// Length of this text, at most 7, and of a whole number with its comma.
    before: u8,
    length: u8,
}

impl Near {
    /// The numbers around `n`.
    #[inline(never)]
    fn around(n: i64, digits: &Digits) -> Self {
        let (power, flip) = (digits.power, n >> 63);
        let whole = n.unsigned_abs() / power;
        let mut cell = [0; 48];
        cell[0] = b'-';
        let at = put_whole(&mut cell, usize::from(flip != 0), whole);
        cell[at] = b'.';
        let decimals = power.ilog10() as u8;
        let before = at as u8 + u8::from(decimals > 0);
        let first = u64::from(flip != 0 && whole == 0);
        Self {
            flip,
            // -n = !n + 1
            base: (whole * power).cast_signed() + flip,
            first,
            count: power - first,
            text: cell.first_chunk().copied().unwrap_or_default(),
            before,
            length: before + decimals + 1,
        }
    }

    /// The fraction of a number that belongs to these.
    #[inline]
    fn part(&self, n: i64) -> Option<u32> {
        let part = (n ^ self.flip).wrapping_sub(self.base).cast_unsigned();
        (part.wrapping_sub(self.first) < self.count).then_some(part as u32)
    }
}
