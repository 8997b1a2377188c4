//! NC programs of the ISG / TwinCAT dialect, parameter lists, the channel and its cycle loop.
//!
//! The library opens no file and reads no clock: sources come through a trait, results leave as records.
//!
//! [`job`] runs programs and shows the order of calls; [`machine`] reads lists, [`record`] is what comes out, [`diag`] what is
//! said about it. [`syntax`] and [`source`] serve tools that look at programs without running them, [`explain`] looks things up.
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
