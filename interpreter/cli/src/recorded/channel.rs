//! One recorded signal.

/// One recorded signal.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Channel {
    /// Name in the file.
    pub(crate) name: String,
    /// Times in s from the first time of the file; empty without a column of times.
    pub(crate) times_s: Vec<f64>,
    /// Values as written in the file.
    pub(crate) values: Vec<f64>,
}
