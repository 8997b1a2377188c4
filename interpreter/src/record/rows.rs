//! Consecutive cycles as columns: computed by a run and read by its sink.
//!
//! Values of a cycle as a whole are stored row by row, values of an axis column by column, and only in the requested
//! columns: an axis writes a column from one end to the other, and a reader gets it as a slice. A single cycle is a
//! view of its row ([`Rows::read`]).

use super::quantity::{Asked, Quantity};
use super::{AxisRecord, CycleRecord};
use std::ops::Range;

/// Room for consecutive cycles.
#[derive(Debug, Default)]
pub(crate) struct RowBuffer {
    asked: Asked,
    /// Number of axes.
    axes: usize,
    /// Values that do not belong to an axis; their `axes` are empty.
    cycles: Vec<CycleRecord>,
    /// Axis by axis, quantity by quantity, row by row.
    values: Vec<f64>,
}

/// Distance between the beginnings of two columns. Not a power of two, because columns that are written together would
/// otherwise compete for the same cache sets.
const STRIDE: usize = RowBuffer::ROOM + 8;

impl RowBuffer {
    /// Most cycles.
    pub(crate) const ROOM: usize = 256;

    /// Removes all cycles and selects the columns for the next ones; interpolated setpoint and set position are always
    /// present.
    pub(crate) fn clear(&mut self, axes: usize, asked: Asked) {
        self.cycles.clear();
        (self.axes, self.asked) = (axes, asked.and(Asked::of(&[Quantity::Ipo, Quantity::Set])));
        let values = axes * Quantity::COUNT * STRIDE;
        if self.values.len() != values {
            self.values = vec![0.0; values];
        }
    }

    /// Number of cycles that are complete.
    pub(crate) fn len(&self) -> usize {
        self.cycles.len()
    }

    /// The columns of an axis from the next cycle on.
    pub(crate) fn axis_mut(&mut self, axis: usize) -> AxisColumns<'_> {
        let values = &mut self.values[axis * Quantity::COUNT * STRIDE..];
        let values = &mut values[..Quantity::COUNT * STRIDE];
        AxisColumns { asked: self.asked, values, from: self.cycles.len() }
    }

    /// Values of an axis in the next cycles.
    pub(crate) fn next(&self, axis: usize, quantity: Quantity, cycles: usize) -> &[f64] {
        let row = self.cycles.len();
        &self.values[(axis * Quantity::COUNT + quantity as usize) * STRIDE + row..][..cycles]
    }

    /// The same, for writing.
    pub(crate) fn next_mut(
        &mut self,
        axis: usize,
        quantity: Quantity,
        cycles: usize,
    ) -> &mut [f64] {
        let row = self.cycles.len();
        &mut self.values[(axis * Quantity::COUNT + quantity as usize) * STRIDE + row..][..cycles]
    }

    /// Completes the next cycle with the values of a record that do not belong to its axes.
    pub(crate) fn push(&mut self, record: &CycleRecord) {
        self.cycles.push(CycleRecord { axes: Vec::new(), ..*record });
    }

    /// A cycle, for writing measured results.
    pub(crate) fn cycle_mut(&mut self, row: usize) -> &mut CycleRecord {
        &mut self.cycles[row]
    }

    /// Value of an axis in a cycle, for writing measured results.
    pub(crate) fn value_mut(&mut self, axis: usize, quantity: Quantity, row: usize) -> &mut f64 {
        &mut self.values[(axis * Quantity::COUNT + quantity as usize) * STRIDE + row]
    }

    /// The quantities that have columns.
    pub(crate) const fn asked(&self) -> Asked {
        self.asked
    }

    /// Some of the cycles.
    pub(crate) fn part(&self, rows: Range<usize>) -> Rows<'_> {
        Rows { buffer: self, rows }
    }
}

/// The columns of one axis from the next cycle on.
pub(crate) struct AxisColumns<'a> {
    asked: Asked,
    values: &'a mut [f64],
    from: usize,
}

impl AxisColumns<'_> {
    /// No columns.
    pub(crate) const fn none() -> AxisColumns<'static> {
        AxisColumns { asked: Asked::NONE, values: &mut [], from: 0 }
    }

    /// Whether somebody reads one of these.
    pub(crate) const fn has_any(&self, quantities: Asked) -> bool {
        self.asked.has_any(quantities)
    }

    /// A column, if it was requested.
    pub(crate) fn of(&mut self, quantity: Quantity) -> Option<&mut [f64]> {
        if !self.asked.has(quantity) {
            return None;
        }
        Some(&mut self.values[quantity as usize * STRIDE + self.from..])
    }

    /// Columns of several quantities in order, if one of them was requested.
    pub(crate) fn together<const N: usize>(
        &mut self,
        quantities: [Quantity; N],
        rows: usize,
    ) -> Option<[&mut [f64]; N]> {
        if !self.has_any(Asked::of(&quantities)) {
            return None;
        }
        let from = self.from;
        let mut columns = [const { None }; Quantity::COUNT];
        for (column, values) in columns.iter_mut().zip(self.values.chunks_exact_mut(STRIDE)) {
            *column = values.get_mut(from..from + rows);
        }
        let found = quantities.map(|quantity| columns[quantity as usize].take());
        found.iter().all(Option::is_some).then(|| found.map(Option::unwrap_or_default))
    }

    /// Skips this number of cycles.
    pub(crate) fn skip(&mut self, rows: usize) {
        self.from += rows;
    }

    /// Fills the next cycles with a record.
    pub(crate) fn fill(&mut self, record: &AxisRecord, rows: usize) {
        for quantity in self.asked.each() {
            let first = quantity as usize * STRIDE + self.from;
            self.values[first..first + rows].fill(quantity.of(record));
        }
    }
}

/// Consecutive cycles of a run.
#[derive(Clone, Debug)]
pub struct Rows<'a> {
    buffer: &'a RowBuffer,
    rows: Range<usize>,
}

impl<'a> Rows<'a> {
    /// The values of each cycle that do not belong to an axis: records without axes.
    pub fn cycles(&self) -> &'a [CycleRecord] {
        &self.buffer.cycles[self.rows.clone()]
    }

    /// Number of cycles.
    pub fn len(&self) -> usize {
        self.rows.len()
    }

    /// Whether there are no cycles.
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// Those of a span of time: from the first to the last one whose count is in it.
    #[must_use]
    pub fn during(&self, is_in_it: impl Fn(u64) -> bool) -> Self {
        let inside = |cycle: &CycleRecord| is_in_it(cycle.k);
        let first = self.cycles().iter().position(inside).unwrap_or(self.len());
        let last = self.cycles().iter().rposition(inside).map_or(first, |last| last + 1);
        Self { buffer: self.buffer, rows: self.rows.start + first..self.rows.start + last }
    }

    /// Those from the first one on whose count is a multiple of `n`, of which every `n`-th is another multiple.
    #[must_use]
    pub fn from_multiple_of(&self, n: u64) -> Self {
        let shown = |cycle: &CycleRecord| cycle.k.is_multiple_of(n);
        let first = self.cycles().iter().position(shown).unwrap_or(self.len());
        Self { buffer: self.buffer, rows: self.rows.start + first..self.rows.end }
    }

    /// Number of axes.
    pub const fn axes(&self) -> usize {
        self.buffer.axes
    }

    /// A quantity of an axis, cycle by cycle; empty if there is no such axis, or if it was not requested.
    pub fn column(&self, axis: usize, quantity: Quantity) -> &'a [f64] {
        let RowBuffer { asked, axes, values, .. } = self.buffer;
        if axis >= *axes || !asked.has(quantity) {
            return &[];
        }
        &values[(axis * Quantity::COUNT + quantity as usize) * STRIDE..][self.rows.clone()]
    }

    /// Reads a single cycle; values that were not requested are NaN.
    pub fn read(&self, i: usize, record: &mut CycleRecord) {
        let row = self.rows.start + i;
        let RowBuffer { asked, axes: count, cycles, values } = self.buffer;
        let mut axes = std::mem::take(&mut record.axes);
        axes.resize(*count, AxisRecord::default());
        for (axis, values) in axes.iter_mut().zip(values.chunks(Quantity::COUNT * STRIDE)) {
            for quantity in Quantity::ALL {
                let known = asked.has(*quantity);
                let value =
                    if known { values[*quantity as usize * STRIDE + row] } else { f64::NAN };
                *quantity.of_mut(axis) = value;
            }
        }
        *record = CycleRecord { axes, ..cycles[row] };
    }

    /// Reads the cycles one by one.
    ///
    /// # Errors
    /// The first error of `take`.
    pub fn each<E>(&self, mut take: impl FnMut(&CycleRecord) -> Result<(), E>) -> Result<(), E> {
        let mut record = CycleRecord::default();
        (0..self.rows.len()).try_for_each(|i| {
            self.read(i, &mut record);
            take(&record)
        })
    }
}
