//! `kontur explain`: an error ID, a parameter, a command.
//!
//! Order of calls: none, the functions are independent.
//!
//! ```
//! let text = kontur::explain::text("P-AXIS-00099")?;
//! assert!(text.contains("getriebe[i].kv"));
//! assert!(kontur::explain::text("P-AXIS-99999").is_err());
//! # Ok::<(), kontur::Error>(())
//! ```

use crate::args::ExplainArgs;
use crate::console::Console;
use crate::{Error, Exit};

/// Explains every word or, if none of them is known by itself, the term formed by all of them: `#VIB GUARD` is two
/// words in a shell.
///
/// # Errors
/// [`Error::Usage`] if one is unknown, with similar words.
pub fn explain(args: &ExplainArgs, console: &mut Console) -> Result<Exit, Error> {
    let term = args.thing.join(" ");
    let is_command = term.starts_with(['#', '$']);
    let pages: Vec<_> = args.thing.iter().map(|word| text(word)).collect();
    if is_command || pages.iter().all(Result::is_err) {
        console.print(&text(&term)?)?;
        return Ok(Exit::Finished);
    }
    let pages = pages.into_iter().collect::<Result<Vec<_>, _>>()?;
    console.print(&pages.join("\n"))?;
    Ok(Exit::Finished)
}

/// The explanation of a term.
///
/// # Errors
/// As [`explain`].
pub fn text(thing: &str) -> Result<String, Error> {
    match kontur_interpreter::explain::explain(thing) {
        Ok(known) => Ok(known.to_string()),
        Err(similar) => {
            let hint = if similar.is_empty() {
                "an error ID (22060), a parameter (P-AXIS-00571 or its key) or a command is expected"
                    .to_owned()
            } else {
                format!("did you mean {}?", similar.join(", "))
            };
            Err(Error::Usage(format!("`{thing}` is not known; {hint}")))
        }
    }
}
