//! Small differences between consecutive items of a text, packed into a few bytes each.

use integer_encoding::VarInt;

/// Items per group: a reader starts at the beginning of a group and reads on from there.
pub(super) const GROUP: usize = 16;

/// A sequence of numbers; small ones take one byte.
#[derive(Clone, Debug, Default)]
pub(super) struct Bytes(Vec<u8>);

impl Bytes {
    /// Position of the next number.
    pub(super) fn end(&self) -> usize {
        self.0.len()
    }

    pub(super) fn push(&mut self, number: impl VarInt) {
        let mut room = [0; 10];
        let length = number.encode_var(&mut room);
        self.0.extend_from_slice(&room[..length]);
    }

    /// Reads from a position on.
    pub(super) fn from(&self, place: usize) -> Numbers<'_> {
        Numbers(self.0.get(place..).unwrap_or_default())
    }
}

/// See [`Bytes::from`].
pub(super) struct Numbers<'a>(&'a [u8]);

impl Numbers<'_> {
    /// The next number, zero after the last one.
    pub(super) fn next<N: VarInt + Default>(&mut self) -> N {
        let Some((number, length)) = N::decode_var(self.0) else { return N::default() };
        self.0 = &self.0[length..];
        number
    }
}
