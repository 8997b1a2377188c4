//! NC programs of the ISG / TwinCAT dialect, parameter lists, the channel and its cycle loop.
//!
//! The library opens no file and reads no clock: sources come through a trait, results leave as records.

pub mod diag;
pub mod exec;
pub mod explain;
pub mod job;
pub mod machine;
pub mod record;
pub mod sim;
pub mod source;
pub mod syntax;
