//! What rooms output while a block is executed.

use super::contour::Contour;
use super::report::Report;
use crate::machine::Machine;

/// The events and the messages of a block, beside the lists of the machine, on which both depend.
#[derive(Debug)]
pub(super) struct Output<'a> {
    pub(super) machine: &'a Machine,
    pub(super) contour: &'a mut Contour,
    pub(super) report: &'a mut Report,
}

/// The [`Output`] of a decoder, whose other rooms stay accessible: a function would borrow all of them.
macro_rules! output {
    ($decoder:ident) => {
        &mut $crate::exec::output::Output {
            machine: &$decoder.machine,
            contour: &mut $decoder.contour,
            report: &mut $decoder.report,
        }
    };
}
pub(super) use output;
