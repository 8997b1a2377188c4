//! Columns of numbers as cells of rows: the numbers of a column are rounded together, those of a row are written
//! together.

use super::{Cell, Cells, Divided, EXACT_BELOW, MOST_DECIMALS, POWERS};
use std::ops::Range;

/// `1.5 * 2^52`: added to a number below `2^51` it leaves the rounded integer part in the lowest bits.
const ROUNDER: f64 = 6_755_399_441_055_744.0;

/// Sign bit of a number, stored with its integer part.
const SIGN: u64 = 1 << 63;

/// Marks an integer part that [`NumberTable::take`] has not rounded.
const UNROUNDED: u64 = u64::MAX;

/// The numbers of several rows of a table, each column with its number of decimals.
#[derive(Clone, Debug)]
pub(crate) struct NumberTable {
    columns: Vec<NumberColumn>,
}

/// The numbers of a column.
#[derive(Clone, Debug)]
struct NumberColumn {
    decimals: u8,
    /// `10^decimals`, its inverse, and the remaining factor up to `10^7`.
    power: f64,
    inverse: f64,
    fill: f64,
    values: [f64; NumberTable::ROWS],
    /// For every number its sign and integer part, and its fraction times `10^7`.
    wholes: [u64; NumberTable::ROWS],
    parts: [u64; NumberTable::ROWS],
}

impl NumberTable {
    /// Number of rows that are processed together.
    pub(crate) const ROWS: usize = 16;

    /// For columns with these numbers of decimals.
    pub(crate) fn new(decimals: &[u8]) -> Self {
        let column = |decimals: &u8| {
            // with more decimals than supported the power is NaN, for which nothing is rounded
            let power = POWERS.get(usize::from(*decimals)).map_or(f64::NAN, |power| *power as f64);
            NumberColumn {
                decimals: *decimals,
                power,
                inverse: 1.0 / power,
                fill: POWERS[MOST_DECIMALS] as f64 / power,
                values: [0.0; Self::ROWS],
                wholes: [0; Self::ROWS],
                parts: [0; Self::ROWS],
            }
        };
        Self { columns: decimals.iter().map(column).collect() }
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
        let mut columns = self.columns[columns].iter();
        while let Some(unrounded) =
            out.push_cells(&mut columns, |column, cell| column.put(cell, row))
        {
            out.push_fixed(unrounded.values[row], unrounded.decimals);
            out.push_comma();
        }
    }
}

impl NumberColumn {
    /// Marks numbers that are ties, too large or not finite.
    fn take(&mut self, values: &[f64]) {
        self.values[..values.len()].copy_from_slice(values);
        let Self { power, inverse, fill, .. } = *self;
        let found = self.wholes.iter_mut().zip(&mut self.parts);
        for (value, (whole, part)) in self.values.iter().zip(found) {
            // without branches, so that several numbers are processed at once
            let product = value * power;
            let rounded = (product + ROUNDER) - ROUNDER;
            // NaN fails both comparisons
            let known = (product - rounded).abs() < 0.5 && product.abs() < 0.5 * EXACT_BELOW;
            let magnitude = rounded.abs();
            // one too large if more than half remains; products of whole numbers below 2^53 are exact
            let about = (magnitude * inverse + ROUNDER) - ROUNDER;
            let left = magnitude - about * power;
            let (before, after) =
                if left < 0.0 { (about - 1.0, left + power) } else { (about, left) };
            let sign = rounded.to_bits() & SIGN;
            *whole = if known {
                ((before + ROUNDER).to_bits() - ROUNDER.to_bits()) | sign
            } else {
                UNROUNDED
            };
            *part = u64::from((after * fill + ROUNDER).to_bits() as u32);
        }
    }

    /// Writes a number and a comma to the beginning of a cell; returns their length, or `None` if the number is marked.
    #[inline]
    fn put(&self, cell: &mut Cell, row: usize) -> Option<usize> {
        // for the compiler: the index is in range
        let row = row % NumberTable::ROWS;
        let (whole, part) = (self.wholes[row], self.parts[row] as u32);
        let number = Divided { negative: whole & SIGN != 0, whole: whole & !SIGN, part };
        (whole != UNROUNDED).then(|| number.put(cell, self.decimals) + 1)
    }
}
