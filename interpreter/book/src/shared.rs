//! Documents of the repository that are pages of the book as well: they have one source, and their links are adapted.

use std::io;
use std::path::Path;

/// A document from the root of the repository, and the page it becomes.
const DOCUMENTS: &[(&str, &str)] = &[
    ("programs/lessons/README.md", "lessons.md"),
    ("ARCHITECTURE.md", "architecture.md"),
    ("CONTRIBUTING.md", "contributing.md"),
    ("interpreter/docs/language.md", "language.md"),
    ("interpreter/docs/running.md", "running.md"),
    ("interpreter/docs/performance.md", "performance.md"),
    ("interpreter/docs/trace.md", "trace.md"),
    ("interpreter/cli/docs/figures.md", "figures.md"),
    ("interpreter/docs/ci.md", "ci.md"),
    ("interpreter/python/README.md", "python.md"),
    ("CHANGELOG.md", "changelog.md"),
];

/// Copies documents, and their pictures.
pub(crate) fn copy(root: &Path, src: &Path) -> io::Result<()> {
    for (document, page) in DOCUMENTS {
        let text = std::fs::read_to_string(root.join(document))?;
        let folder = document.rsplit_once('/').map_or("", |(folder, _)| folder);
        let text = linked(&text, folder, &mut |picture| {
            let to = src.join(picture.rsplit('/').next().unwrap_or(picture));
            std::fs::copy(root.join(picture), to).map(drop)
        })?;
        std::fs::write(src.join(page), text)?;
    }
    Ok(())
}

/// A document with its links as the book needs them: to the page of another document, to the copy of a picture, and the
/// path in the repository instead of anything else.
fn linked(
    text: &str,
    folder: &str,
    picture: &mut dyn FnMut(&str) -> io::Result<()>,
) -> io::Result<String> {
    let mut out = String::new();
    let mut rest = text;
    while let Some((before, after)) = rest.split_once("](") {
        let Some((target, behind)) = after.split_once(')') else { break };
        // a link begins at the bracket opened last; code such as `axis[i](..)` has none
        let Some((front, words)) = before.rsplit_once('[') else { break };
        let (file, anchor) = target.split_once('#').unwrap_or((target, ""));
        let path = from_root(folder, file);
        let page = DOCUMENTS.iter().find(|(document, _)| *document == path);
        let drawn = Path::new(&path).extension().is_some_and(|e| e == "svg");
        if drawn {
            picture(&path)?;
        }
        let anchor = if anchor.is_empty() { String::new() } else { format!("#{anchor}") };
        let link = match page {
            _ if file.is_empty() || file.contains("://") => Some(target.to_owned()),
            Some((_, page)) => Some(format!("{page}{anchor}")),
            None if drawn => path.rsplit('/').next().map(str::to_owned),
            None => None,
        };
        let written = match link {
            Some(link) => format!("{front}[{words}]({link})"),
            None => format!("{front}{words} (`{path}`)"),
        };
        out.push_str(&written);
        rest = behind;
    }
    out.push_str(rest);
    Ok(out)
}

/// A path from the root of the repository.
fn from_root(folder: &str, file: &str) -> String {
    let mut parts: Vec<&str> = folder.split('/').filter(|part| !part.is_empty()).collect();
    for part in file.split('/') {
        match part {
            ".." => drop(parts.pop()),
            part => parts.push(part),
        }
    }
    parts.join("/")
}

/// A page with the files in place of the lines that name them: `{{#include PATH}}`, from the root of the repository.
pub(crate) fn with_files(root: &Path, page: &str) -> io::Result<String> {
    let mut out = String::new();
    for line in page.lines() {
        match line.strip_prefix("{{#include ").and_then(|rest| rest.strip_suffix("}}")) {
            Some(path) => {
                let text = std::fs::read_to_string(root.join(path))
                    .map_err(|e| io::Error::new(e.kind(), format!("{path}: {e}")))?;
                out.push_str(text.trim_end());
            }
            None => out.push_str(line),
        }
        out.push('\n');
    }
    Ok(out)
}

#[cfg(test)]
mod tests {
    use super::linked;

    #[test]
    fn links_are_turned_round() {
        let mut pictures = Vec::new();
        let text = "see [a](#x), [b](../machines/xyz), ![c](pictures/c.svg), [d](../../ARCHITECTURE.md#y), [e](https://e.org)";
        let turned = linked(text, "programs/lessons", &mut |p| {
            pictures.push(p.to_owned());
            Ok(())
        });
        assert_eq!(
            turned.unwrap(),
            "see [a](#x), b (`programs/machines/xyz`), ![c](c.svg), [d](architecture.md#y), [e](https://e.org)"
        );
        assert_eq!(pictures, ["programs/lessons/pictures/c.svg"]);
    }
}
