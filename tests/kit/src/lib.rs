//! A kit for all tests: random numbers, a comparison, tables of programs, contours and distances from polylines, times of
//! the fastest motion, and a mass on a spring integrated in small steps. It depends on none of the crates under test.

mod fastest;
mod oscillator;
mod pen;
mod polyline;
mod random;
pub mod rows;

pub use fastest::second_order_time;
pub use oscillator::Oscillator;
pub use pen::Pen;
pub use polyline::{from_polyline, largest};
pub use random::{Random, count, environment, seed};

/// The pieces of a text, separated by ` ¦ ` or ends of lines.
pub fn pieces(text: &str) -> Vec<&str> {
    text.lines().flat_map(|line| line.split(" ¦ ")).collect()
}

/// Asserts that two numbers differ by `tolerance` at most.
///
/// # Panics
/// If they do not.
#[track_caller]
pub fn near(is: f64, want: f64, tolerance: f64) {
    assert!((is - want).abs() <= tolerance, "{is} is not {want} +- {tolerance}");
}
