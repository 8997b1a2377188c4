//! `cargo run -p kontur-book -- FOLDER` collects the sources of the book in a folder, for mdBook.
//!
//! Three kinds of pages: those in `pages`, documents that have their own place in the repository ([`shared`]), and the
//! reference, which is generated from the tables ([`mod@reference`]).

#![expect(clippy::print_stderr, reason = "a tool of the build says what went wrong")]

mod markdown;
mod reference;
mod shared;

use std::io;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

fn main() -> ExitCode {
    let Some(folder) = std::env::args_os().nth(1).map(PathBuf::from) else {
        eprintln!("usage: kontur-book FOLDER");
        return ExitCode::from(2);
    };
    match assemble(&folder) {
        Ok(()) => ExitCode::SUCCESS,
        Err(e) => {
            eprintln!("{e}");
            ExitCode::FAILURE
        }
    }
}

/// Writes `book.toml` and `src` into a folder; the previous content of its `src` is removed.
fn assemble(folder: &Path) -> io::Result<()> {
    let own = Path::new(env!("CARGO_MANIFEST_DIR"));
    let root = own.join("../..");
    let src = folder.join("src");
    if src.exists() {
        std::fs::remove_dir_all(&src)?;
    }
    std::fs::create_dir_all(&src)?;
    std::fs::copy(own.join("book.toml"), folder.join("book.toml"))?;
    for entry in std::fs::read_dir(own.join("pages"))? {
        let path = entry?.path();
        let Some(name) = path.file_name() else { continue };
        if path.extension().is_some_and(|e| e == "md") {
            let text = shared::with_files(&root, &std::fs::read_to_string(&path)?)?;
            std::fs::write(src.join(name), text)?;
        } else {
            std::fs::copy(&path, src.join(name))?;
        }
    }
    shared::copy(&root, &src)?;
    for (name, text) in reference::pages() {
        std::fs::write(src.join(name), text)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::assemble;
    use std::collections::BTreeSet;
    use std::path::Path;

    /// Every link leads to a page or picture of the book, every page is in the summary, and all includes are resolved.
    #[test]
    fn links_lead_somewhere() {
        let folder = tempfile::tempdir().unwrap();
        assemble(folder.path()).unwrap();
        let src = folder.path().join("src");
        let summary = std::fs::read_to_string(src.join("SUMMARY.md")).unwrap();
        let mut pages = BTreeSet::new();
        for entry in std::fs::read_dir(&src).unwrap() {
            let path = entry.unwrap().path();
            if path.extension().is_some_and(|e| e == "md") {
                pages.insert(path);
            }
        }
        let anchors = |page: &Path| -> BTreeSet<String> {
            let text = std::fs::read_to_string(page).unwrap();
            let mut fenced = false;
            let lines = text.lines().filter(|line| {
                fenced ^= line.starts_with("```");
                !fenced && line.starts_with('#')
            });
            lines.map(crate::markdown::anchor).collect()
        };
        assert!(pages.len() > 12);
        for page in &pages {
            let name = page.file_name().unwrap().to_str().unwrap();
            assert!(name == "SUMMARY.md" || summary.contains(&format!("({name})")), "{name}");
            let text = std::fs::read_to_string(page).unwrap();
            assert!(!text.contains("{{#"), "{name}");
            for target in crate::markdown::links(&text) {
                if target.contains("://") {
                    continue;
                }
                let (file, anchor) = target.split_once('#').unwrap_or((&target, ""));
                let to = if file.is_empty() { page.clone() } else { src.join(file) };
                assert!(to.exists(), "{name}: {target}");
                assert!(anchor.is_empty() || anchors(&to).contains(anchor), "{name}: {target}");
            }
        }
    }
}
