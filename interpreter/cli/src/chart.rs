//! The drawing primitives of `report`, `response`, `sweep` and `tune`: views with their scales, colours and dashes.
//!
//! A [`view::View`] describes axes with name, unit and range, lines with their styles, levels, and marks. Pictures draw
//! it as SVG. The page of `report` receives the same description as JSON, with the tick steps and the colours, and
//! redraws it when it is zoomed.
//!
//! Other crates use the scales only: [`scale`] has the order of calls.
//!
//! ```
//! use kontur::chart::scale::{steps, ticks};
//!
//! // a page draws with these steps, a picture with these numbers
//! assert!(steps().iter().any(|step| step.size == 0.5 && step.decimals == 1));
//! assert_eq!(ticks((0.0, 1.0), 2.0).len(), 3);
//! ```

pub(crate) mod plot;
pub mod scale;
pub(crate) mod style;
pub(crate) mod svg;
pub(crate) mod view;
