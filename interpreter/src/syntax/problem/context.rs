//! Kind of content of a block, and the block without what may come before it.

use crate::syntax::grammar::HASH_WORDS;

/// Kind of content of a block, judged by its first character.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::syntax) enum Context {
    Words,
    Command,
    Control,
}

impl Context {
    pub(in crate::syntax) fn of(masked: &str) -> Self {
        let content = content(masked);
        if content.starts_with('$') && !starts_with(content, "$GOTO") {
            Self::Control
        } else if let Some(name) = content.strip_prefix('#') {
            let name = name.trim_start();
            let length = name.bytes().take_while(u8::is_ascii_alphanumeric).count();
            let among_words = HASH_WORDS.iter().any(|w| w.eq_ignore_ascii_case(&name[..length]));
            if among_words { Self::Words } else { Self::Command }
        } else {
            Self::Words
        }
    }
}

/// Block without skip mark, number and label.
pub(super) fn content(masked: &str) -> &str {
    let mut rest = masked.trim_start();
    if let Some(behind) = rest.strip_prefix('/') {
        rest = behind.trim_start_matches(|c: char| c.is_ascii_digit()).trim_start();
    }
    if let Some(behind) = rest.strip_prefix(['N', 'n']) {
        rest = behind.trim_start_matches(|c: char| c.is_ascii_digit());
        rest = rest.strip_prefix(':').unwrap_or(rest).trim_start();
    }
    rest
}

pub(super) fn starts_with(text: &str, keyword: &str) -> bool {
    text.get(..keyword.len()).is_some_and(|head| head.eq_ignore_ascii_case(keyword))
        && !text[keyword.len()..].starts_with(|c: char| c.is_ascii_alphanumeric() || c == '_')
}
