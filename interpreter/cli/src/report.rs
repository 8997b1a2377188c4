//! stub
use crate::args::ReportArgs;
use crate::console::Console;
use crate::engine::Engine;
use crate::{Error, Exit};
/// x
pub fn report(_: &ReportArgs, _: &mut dyn Engine, _: &mut Console) -> Result<Exit, Error> {
    Ok(Exit::Finished)
}
