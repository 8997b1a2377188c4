//! The size of a group of rows, and the errors of writing one.

use ::parquet::errors::ParquetError;
use std::io;

/// Number of rows of a group.
pub(super) const ROWS_PER_GROUP: usize = 65_536;

/// The error of the file that an error of the format contains.
pub(super) fn to_io(e: ParquetError) -> io::Error {
    match e {
        ParquetError::External(inner) => match inner.downcast::<io::Error>() {
            Ok(e) => *e,
            Err(other) => io::Error::other(other),
        },
        other => io::Error::other(other),
    }
}
