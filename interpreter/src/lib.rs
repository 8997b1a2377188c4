//! NC programs of the ISG / TwinCAT dialect, parameter lists, the channel and its cycle loop.
//!
//! The library itself does not open files or read a clock: sources come through a trait, results are records.
//!
//! [`job`] runs programs and shows the order of calls; [`machine`] reads lists, [`record`] contains the results,
//! [`diag`] the messages. [`syntax`] and [`source`] serve tools that examine programs without running them, [`explain`]
//! is for look-ups.
//!
//! ```
//! use kontur_interpreter::job::{Job, MachineLists};
//! use kontur_interpreter::source::MemorySources;
//!
//! let (machine, _) = MachineLists::default().load().unwrap();
//! let sources = MemorySources::new().with("part.nc", "N10 G01 X10\nN20 M30\n");
//! // a feed is missing: vendor ID 20008, reported before anything moves
//! let checked = Job::new(machine, sources, "part.nc").check();
//! assert!(checked.refuses());
//! assert_eq!(checked.diagnostics[0].id.to_string(), "20008");
//! ```

pub mod diag;
mod exec;
pub mod explain;
pub mod job;
pub mod machine;
pub mod record;
mod sim;
pub mod source;
mod suggest;
pub mod summary;
pub mod syntax;
