//! Files that cannot be opened, or whose text is not NC code.

use crate::diag::Diagnostic;
use crate::source::{BLOCK_LENGTH_MAX, BlockReader, OpenError, Position};
use crate::syntax::Parser;
use crate::syntax::ast::Body;
use std::io;
use std::sync::Arc;

/// The reason for which a file could not be opened.
#[derive(Debug)]
pub(in crate::exec) enum FileError {
    Open(OpenError),
    Read(io::Error),
    /// Most of its text is not NC code; contains the name of the file.
    Foreign(Arc<str>),
}

impl FileError {
    /// Text and hint of K-0013 for a file that the program calls `name`.
    ///
    /// `local`: the local subroutine that the call may mean.
    pub(super) fn text(self, name: &str, local: Option<&str>) -> (String, String) {
        match self {
            Self::Open(e) => {
                let searched = format!("searched: {}", e.searched.join(", "));
                let hint = if let Some(local) = local {
                    format!("LL {local} calls the local subroutine %L {local}; {searched}")
                } else if is_vendor_cycle(&e.name) {
                    format!(
                        "a cycle of the vendor's library, not included in kontur: copy it from the control; {searched}"
                    )
                } else {
                    searched
                };
                (format!("{}: {}", e.name, e.reason), hint)
            }
            Self::Read(e) => (
                format!("{name}: {e}"),
                "save the program as a text file in UTF-8 or Latin-1".to_owned(),
            ),
            Self::Foreign(file) => {
                let hint = format!("run `check {file}` to see the errors in its lines");
                (format!("{name}: most of its lines are not NC blocks"), hint)
            }
        }
    }
}

/// Whether the name is like `SysDrill1.ecy`: cycles of the drilling, milling and measuring libraries.
fn is_vendor_cycle(name: &str) -> bool {
    let file = name.rsplit(['/', '\\']).next().unwrap_or(name);
    let head = file.get(..3).is_some_and(|head| head.eq_ignore_ascii_case("sys"));
    let tail = file.rsplit_once('.').is_some_and(|(_, tail)| tail.eq_ignore_ascii_case("ecy"));
    head && tail
}

/// Number of blocks by which a called file is judged.
const JUDGED_MAX: u32 = 64;

/// Whether most blocks at the beginning of a file are not NC blocks: its text is then not quoted in messages.
pub(super) fn is_foreign(
    reader: &mut BlockReader,
    name: &Arc<str>,
    parser: &Parser,
) -> io::Result<bool> {
    reader.seek(Position::START);
    let (mut judged, mut wrong, mut comment) = (0, 0, false);
    let mut found = Vec::new();
    let is_wrong = |found: &mut Vec<Diagnostic>| found.drain(..).any(|d| d.is_error());
    while judged < JUDGED_MAX {
        let Some(raw) = reader.next_block()? else { break };
        // a line that is too long is not judged
        if raw.text.trim_ascii().is_empty() || raw.characters > BLOCK_LENGTH_MAX {
            continue;
        }
        let block = parser.block(&raw, name, &mut found);
        let mut fails = is_wrong(&mut found);
        if let Body::Command(command) = &block.body {
            comment = (comment || command.is("COMMENT BEGIN")) && !command.is("COMMENT END");
        }
        if fails && !comment {
            parser.declaration(&raw, name, &mut found);
            fails = is_wrong(&mut found);
        }
        judged += 1;
        wrong += u32::from(fails && !comment);
    }
    Ok(2 * wrong > judged)
}
