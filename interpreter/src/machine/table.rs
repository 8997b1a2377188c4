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

pub(crate) mod axis_compensation;
pub(crate) mod axis_control;
pub(crate) mod axis_drive;
pub(crate) mod axis_dynamics;
pub(crate) mod axis_filters;
pub(crate) mod axis_functions;
pub(crate) mod axis_general;
pub(crate) mod axis_guard;
pub(crate) mod channel;
pub(crate) mod channel_hsc;
pub(crate) mod external;
mod indices;
mod lookup;
pub(crate) mod own;
pub(crate) mod param;
mod raw;
mod row;
pub(crate) mod start_up;
pub(crate) mod tool;
pub(crate) mod zero;

pub use indices::Indices;
pub(crate) use indices::with_indices;
pub use lookup::rows;
pub(crate) use lookup::{axis_key, by_id, by_key, misspelt, suggestions};
pub use raw::{Bound, Raw};
pub use row::{Correction, Default, DriveType, ListKind, OutOfRange, Row};
