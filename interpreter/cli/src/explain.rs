//! `kontur explain`: an error ID, a parameter, a command.

use crate::args::ExplainArgs;
use crate::console::Console;
use crate::engine::Engine;
use crate::{Error, Exit, render};
use kontur_interpreter::diag::catalog::{self, Entry};
use kontur_interpreter::diag::{Id, Severity};
use std::fmt::Write as _;

/// Explains the thing that the words name together (`#VIB GUARD` is two words to a shell).
///
/// # Errors
/// [`Error::Usage`] if nobody knows it, with words that resemble it.
pub fn explain(
    args: &ExplainArgs,
    engine: &dyn Engine,
    console: &mut Console,
) -> Result<Exit, Error> {
    let thing = args.thing.join(" ");
    let of_id = parse_id(&thing).and_then(known).map(text);
    let Some(text) = of_id.or_else(|| engine.explain(&thing)) else {
        let similar = engine.similar(&thing);
        let hint = if similar.is_empty() {
            "an error ID (22060), a parameter (P-AXIS-00571 or its key) or a command is expected"
                .to_owned()
        } else {
            format!("did you mean {}?", similar.join(", "))
        };
        return Err(Error::Usage(format!("nothing is known about `{thing}`; {hint}")));
    };
    console.print(&text)?;
    Ok(Exit::Finished)
}

/// `22060`, `P-ERR-22060`, `K-0012`, and the short names `K-UNDEF`.
fn parse_id(text: &str) -> Option<Id> {
    let text = text.trim().to_ascii_uppercase();
    let digits = text.strip_prefix("P-ERR-").unwrap_or(&text);
    if let Ok(n) = digits.parse() {
        return Some(Id::Vendor(n));
    }
    let own = text.strip_prefix("K-")?;
    own.parse().map(Id::Kontur).ok().or_else(|| {
        catalog::ENTRIES.iter().find(|e| e.name.eq_ignore_ascii_case(&text)).map(|e| e.id)
    })
}

fn known(id: Id) -> Option<&'static Entry> {
    catalog::ENTRIES.iter().find(|e| e.id == id)
}

fn text(entry: &Entry) -> String {
    let mut out = String::new();
    let severity = match entry.severity {
        Severity::Note => "note",
        Severity::Warning => "warning",
        Severity::Error => "error",
    };
    let name = if entry.name.is_empty() { String::new() } else { format!(" ({})", entry.name) };
    // writing to a String cannot fail
    let _ = writeln!(out, "{severity} {}{name}: {}", entry.id, entry.meaning);
    if !entry.cause.is_empty() {
        let _ = writeln!(out, "  cause     {}", entry.cause);
    }
    let _ = writeln!(out, "  reaction  {}: {}", entry.reaction, render::reaction(entry.reaction));
    let _ = writeln!(out, "  remedy    {}: {}", entry.remedy, render::remedy(entry.remedy));
    let root = match entry.root {
        1 => "NC program",
        2 => "parameter lists",
        6 => "transfer to the control device",
        11 => "position controller",
        _ => "none",
    };
    let _ = writeln!(out, "  root      {}: {root}", entry.root);
    if matches!(entry.id, Id::Kontur(_)) {
        let _ = writeln!(out, "  A condition of kontur's own; the control has no number for it.");
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ids_in_every_spelling() {
        assert_eq!(parse_id("22060"), Some(Id::Vendor(22060)));
        assert_eq!(parse_id("P-ERR-70082"), Some(Id::Vendor(70082)));
        assert_eq!(parse_id("p-err-70082"), Some(Id::Vendor(70082)));
        assert_eq!(parse_id("K-0012"), Some(Id::Kontur(12)));
        assert_eq!(parse_id("k-undef"), Some(Id::Kontur(12)));
        assert_eq!(parse_id("P-AXIS-00571"), None);
        assert_eq!(parse_id("G136"), None);
    }

    #[test]
    fn every_id_of_the_catalogue_has_a_text() {
        for entry in catalog::ENTRIES {
            let text = text(entry);
            assert!(
                text.contains(&entry.id.to_string()) && !text.contains("unknown class"),
                "{text}"
            );
        }
    }
}
