//! `#FILE EXIST`: checks whether a file can be opened.
//!
//! The command only records the name: the executor, which has access to the programs, looks it up after the block. `#FILE
//! RENAME` and `#FILE DELETE` are refused: a simulation does not change files.
//!
//! Source: TF5200 programming manual, 207524491.

use super::keys::arguments;
use super::row::{Call, Row};
use crate::diag::Condition;
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};

arguments! {
    /// Keys of `#FILE EXIST`.
    struct FileArguments {
        path: Word "PATH", "", "name of the file, with or without its folder";
    }
}

/// Row of `#FILE EXIST`.
pub(super) const FILE_EXIST: Row = Row::run("FILE EXIST", exists)
    .form("#FILE EXIST [PATH=\"name\"]")
    .meaning("searches for a file as L searches for subroutines; the result is V.G.FILE_EXIST")
    .keys(FileArguments::KEYS)
    .note("0 for a file not found, with a note naming the folders searched; folders of the control do not exist here")
    .example("#FILE EXIST [PATH=\"offsets.nc\"]")
    .related(&["V.G.FILE_EXIST"]);

fn exists(decoder: &mut Decoder, call: &Call<'_>) -> Outcome<()> {
    call.no_more_words()?;
    let keys = FileArguments::read(decoder, &call.title(), call.command.groups.first())?;
    let Some(wanted) = keys.path.filter(|(name, _)| !name.trim().is_empty()) else {
        let text = "#FILE EXIST needs the name of a file";
        return Err(Fault::new(Condition::TokenUnknown, text, call.span()));
    };
    decoder.calls.searched.wanted = Some(wanted);
    Ok(())
}
