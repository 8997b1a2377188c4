//! Parameters that the code reads, named and typed by their rows: a wrong name or type does not compile.
//!
//! Every room may name a constant in a message; its value is read in `machine` only.

use super::indices::{Indices, with_indices};
use super::raw::Raw;
use super::row::{Default, Row};
use crate::diag::Named;
use std::marker::PhantomData;

/// Rows of one family; `as NAME: KIND` gives a parameter the name and type by which the code reads it.
macro_rules! parameters {
    ($($row:expr $(, as $name:ident: $kind:ident)?;)*) => {
        /// The rows.
        pub(super) const ROWS: &[super::row::Row] = &[$($row),*];
        $($(
            #[doc = concat!("`", stringify!($name), "` of its row.")]
            pub(crate) const $name: super::param::Param<super::param::$kind> =
                super::param::Param::<super::param::$kind>::new(&$row);
        )?)*
    };
}
pub(super) use parameters;

/// A number that always has a value: that of the list or the default of the row. Read in mm (deg), s and ratios.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Number {}

/// A number without default that a list may leave out. Read in mm (deg), s and ratios.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Optional {}

/// A whole number with a default: a count, a selection or bits; 0 if it is not a whole number.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Whole {}

/// On if it is set to a value other than 0.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Switch {}

/// A text or word; `None` if neither list nor row has one.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Text {}

/// A row with the indices of its key.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Place {
    pub(crate) row: &'static Row,
    pub(crate) indices: Indices,
}

impl Named for &Row {
    fn id(self) -> Option<&'static str> {
        Some(self.id).filter(|id| !id.is_empty())
    }
}

impl Named for Place {
    fn id(self) -> Option<&'static str> {
        self.row.id()
    }
}

impl<K> Named for Param<K> {
    fn id(self) -> Option<&'static str> {
        self.place.id()
    }
}

impl std::fmt::Display for Place {
    /// The key with its indices: `getriebe[0].kv`.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&with_indices(self.row.key, self.indices))
    }
}

/// A parameter with the type of its values; the indices of its key are 0 unless given.
#[derive(Debug)]
pub(crate) struct Param<K> {
    place: Place,
    kind: PhantomData<K>,
}

impl<K> Clone for Param<K> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<K> Copy for Param<K> {}

impl<K> From<Param<K>> for Place {
    fn from(param: Param<K>) -> Self {
        param.place
    }
}

impl<K> Param<K> {
    const fn of(row: &'static Row) -> Self {
        Self { place: Place { row, indices: [0; 2] }, kind: PhantomData }
    }

    /// The entry with this first index.
    pub(crate) const fn at(mut self, index: u32) -> Self {
        self.place.indices[0] = index;
        self
    }

    /// The entry with this second index.
    pub(crate) const fn and(mut self, index: u32) -> Self {
        self.place.indices[1] = index;
        self
    }

    /// Row and indices.
    pub(crate) const fn place(self) -> Place {
        self.place
    }
}

impl Param<Number> {
    pub(super) const fn new(row: &'static Row) -> Self {
        assert!(is_number(row) && has_default(row));
        Self::of(row)
    }
}

impl Param<Optional> {
    pub(super) const fn new(row: &'static Row) -> Self {
        assert!(is_number(row));
        Self::of(row)
    }
}

impl Param<Whole> {
    pub(super) const fn new(row: &'static Row) -> Self {
        assert!(is_number(row) && !matches!(row.raw, Raw::Real64));
        Self::of(row)
    }
}

impl Param<Switch> {
    pub(super) const fn new(row: &'static Row) -> Self {
        assert!(is_number(row));
        Self::of(row)
    }
}

impl Param<Text> {
    pub(super) const fn new(row: &'static Row) -> Self {
        assert!(!is_number(row));
        Self::of(row)
    }
}

const fn is_number(row: &Row) -> bool {
    !matches!(row.raw, Raw::Text | Raw::Code | Raw::Word(_))
}

const fn has_default(row: &Row) -> bool {
    matches!(row.default, Default::Number(_) | Default::Of(_))
}

/// Converts a list number that is a whole number of the type UNS32.
pub(crate) fn whole(x: f64) -> Option<u32> {
    (0.0..=f64::from(u32::MAX)).contains(&x).then_some(x as u32)
}
