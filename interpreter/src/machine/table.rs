//! The one table of list parameters: reader, range check, `explain` and documentation come from its rows.
//!
//! A row states what the vendor's manuals state about one parameter, in the units of the lists (0.1 um, us, 0.1 %);
//! conversion to mm and s happens once, in [`Axis`](super::Axis) and [`Channel`](super::Channel).

mod axis_control;
mod axis_drive;
mod axis_dynamics;
mod axis_filters;
mod axis_general;
mod axis_guard;
mod channel;
mod kontur;
mod lookup;
mod row;
mod start_up;

pub(crate) use lookup::edit_distance;
pub use lookup::{by_id, by_key, misspelt, rows, suggestions};
pub use row::{Bound, Correction, Default, ListKind, Raw, Reaction, Row};
