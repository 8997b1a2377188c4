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
use crate::error::{Error, Exit};

/// Explains the term formed by the words (`#VIB GUARD` and `L CYCLE` are two words in a shell) or, if there is no such
/// term, every word.
///
/// # Errors
/// [`Error::Usage`] if it, or one of the words, is unknown, with similar words.
pub fn explain(args: &ExplainArgs, console: &mut Console) -> Result<Exit, Error> {
    let term = args.thing.join(" ");
    let whole = text(&term);
    let pages: Vec<_> = args.thing.iter().map(|word| text(word)).collect();
    let is_term = term.starts_with(['#', '$'])
        || pages.iter().all(Result::is_err)
        || whole.as_ref().is_ok_and(|page| is_title(page, &term));
    let page =
        if is_term { whole? } else { pages.into_iter().collect::<Result<Vec<_>, _>>()?.join("\n") };
    console.print(&page)?;
    Ok(Exit::Finished)
}

/// Whether the first line of a page, a list of names, contains a term: the page of `G1` answers `G1 X10`, too.
fn is_title(page: &str, term: &str) -> bool {
    let names = page.lines().next().unwrap_or_default().split(", ");
    names.into_iter().any(|name| name.eq_ignore_ascii_case(term))
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
