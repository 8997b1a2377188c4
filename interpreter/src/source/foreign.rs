//! Files that are no NC programs in a supported encoding.

/// Number of bytes that show whether a text is UTF-16.
pub(super) const UTF_16_BYTES: usize = 8;

/// Whether a text begins with ASCII characters of two bytes: NUL ends a block, but not after each of the first characters.
pub(super) fn is_utf_16(text: &[u8]) -> bool {
    let Some(begin) = text.get(..UTF_16_BYTES) else { return false };
    let zero = |first: usize| begin.iter().skip(first).step_by(2).all(|b| *b == 0);
    let other = |first: usize| begin.iter().skip(first).step_by(2).all(|b| *b != 0);
    (zero(0) && other(1)) || (zero(1) && other(0))
}

/// Whether bytes are those of an archive, program or picture rather than of a text: they begin as gzip and zip files do, or more
/// than one in 32 is a control character that no text contains. NUL and ETX end blocks, some tapes begin with others: the first
/// few do not count.
pub(super) fn is_binary(bytes: &[u8]) -> bool {
    if bytes.starts_with(b"\x1F\x8B") || bytes.starts_with(b"PK\x03\x04") {
        return true;
    }
    let strange = |byte: &&u8| matches!(byte, 1..=2 | 4..=8 | 14..=25 | 28..=31);
    bytes.iter().filter(strange).count() > 16 + bytes.len() / 32
}
