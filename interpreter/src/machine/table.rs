//! The table of list parameters, the single source of reader, range check, `explain` and documentation.
//!
//! A row reproduces what the vendor's manuals state about one parameter, in the units of the lists (0.1 um, us, 0.1 %);
//! conversion to mm and s happens once, in [`Axis`](super::Axis) and [`Channel`](super::Channel).
//!
//! Order of calls: find the row of a key, then read and check the value with it.
//!
//! ```
//! use kontur_interpreter::machine::table::{ListKind, rows};
//!
//! let kv = rows().find(|row| row.id == "P-AXIS-00099").unwrap();
//! assert_eq!((kv.key, kv.list), ("getriebe[i].kv", ListKind::Axis));
//! ```

pub(super) mod axis_compensation;
pub(super) mod axis_control;
pub(super) mod axis_drive;
pub(super) mod axis_dynamics;
pub(super) mod axis_filters;
pub(super) mod axis_functions;
pub(super) mod axis_general;
pub(super) mod axis_guard;
pub(super) mod channel;
pub(super) mod channel_hsc;
mod indices;
pub(super) mod kontur;
mod lookup;
pub(crate) mod param;
mod row;
pub(super) mod start_up;
pub(super) mod tool;
pub(super) mod zero;

pub use indices::Indices;
pub(crate) use indices::with_indices;
pub use lookup::rows;
pub(crate) use lookup::{by_id, by_key, misspelt, suggestions};
pub use row::{Bound, Correction, Default, ListKind, Raw, Reaction, Row};
