//! The text of a list in a project.

use crate::machine::lists;
use crate::machine::parameters::Parameters;
use crate::machine::table::ListKind;

/// The text of a list and its position.
#[derive(Clone, Debug, Default)]
pub(super) struct ListText {
    /// File that contains it.
    pub(super) file: String,
    /// Name of its item.
    pub(super) name: String,
    /// Its lines.
    pub(super) text: String,
    /// Number of lines of the file before it.
    pub(super) before: usize,
}

impl ListText {
    /// A list in a separate file, with any end of line.
    pub(super) fn of(text: &str) -> Self {
        let text = text.replace("\r\n", "\n").replace('\r', "\n");
        Self { text, ..Self::default() }
    }

    /// The text after enough empty lines to give its lines their numbers in the file.
    pub(super) fn placed(&self) -> String {
        format!("{}{}", "\n".repeat(self.before), self.text)
    }

    /// Inserts an entry after the last line that is read: before the end mark if there is one.
    pub(super) fn enter(&mut self, entry: &str) {
        let lines: Vec<&str> = self.text.split('\n').collect();
        let end = lines.iter().position(|line| is_end(line)).unwrap_or(lines.len());
        let (read, rest) = lines.split_at(end);
        let lines: Vec<&str> = read.iter().chain([&entry]).chain(rest).copied().collect();
        self.text = lines.join("\n");
    }

    /// Removes the lines of these keys and appends entries to the list.
    ///
    /// A key that ends in `[` matches the whole array, any other one only itself.
    pub(super) fn replace(&mut self, keys: &[&str], entries: &str) {
        let is_one = |line: &str| {
            let word = line.split_whitespace().next().unwrap_or_default();
            keys.iter().any(|key| {
                word.get(..key.len()).is_some_and(|start| start.eq_ignore_ascii_case(key))
                    && (key.ends_with('[') || word.len() == key.len())
            })
        };
        let kept = self.text.split('\n').take_while(|line| !is_end(line));
        let lines: Vec<&str> = kept.map(|line| if is_one(line) { "" } else { line }).collect();
        self.text = format!("{}\n{entries}", lines.join("\n"));
    }
}

/// The end mark of a list.
fn is_end(line: &str) -> bool {
    ["ende", "end"].iter().any(|end| line.trim().eq_ignore_ascii_case(end))
}

/// The parameters of texts, without messages: the lists are read again as files.
pub(super) fn parameters(kind: ListKind, texts: &[&ListText]) -> Parameters {
    let mut all = Parameters::new(kind);
    for text in texts {
        all.apply(&lists::read(kind, "", text.text.as_bytes(), &mut Vec::new()));
    }
    all
}
