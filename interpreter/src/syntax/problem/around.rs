//! Properties of the text before and after the position of an error.

/// Whether the text begins with `[NAME]`.
pub(super) fn is_label(rest: &str) -> bool {
    let name = rest.strip_prefix('[').and_then(|rest| rest.split_once(']')).map_or("", |(n, _)| n);
    name.trim_ascii().starts_with(|c: char| c.is_ascii_alphabetic())
        && name.trim_ascii().bytes().all(|b| b.is_ascii_alphanumeric() || b == b'_')
}

/// Whether the outermost open bracket belongs to G80 to G89 or G800 to G899.
pub(super) fn in_cycle_list(before: &str) -> bool {
    let head = before_bracket(before);
    let digits = head.trim_end_matches(|c: char| c.is_ascii_digit());
    let number = head[digits.len()..].trim_start_matches('0');
    digits.ends_with(['G', 'g']) && number.starts_with('8') && matches!(number.len(), 2 | 3)
}

/// Whether the outermost open bracket contains the values of a variable: `V.P.A[3]=[`.
pub(super) fn in_values(before: &str) -> bool {
    before_bracket(before).trim_ascii_end().strip_suffix('=').is_some_and(ends_in_place)
}

/// Whether the outermost open bracket belongs to `L CYCLE` or `L SEQUENCE`.
pub(super) fn in_cycle_call(before: &str) -> bool {
    let before = before_bracket(before).trim_ascii_end();
    let word = before.rsplit([' ', '\t']).next().unwrap_or_default();
    ["CYCLE", "LCYCLE", "LLCYCLE", "SEQUENCE"].iter().any(|name| word.eq_ignore_ascii_case(name))
}

/// The text before the outermost open bracket.
pub(super) fn before_bracket(before: &str) -> &str {
    let mut open = Vec::new();
    for (i, byte) in before.bytes().enumerate() {
        match byte {
            b'[' => open.push(i),
            b']' => {
                open.pop();
            }
            _ => {}
        }
    }
    open.first().map_or("", |first| before[..*first].trim_ascii_end())
}

/// Whether `before` ends in a parameter or variable that begins a word.
pub(super) fn ends_in_place(before: &str) -> bool {
    match last_word(before).as_bytes() {
        [b'V' | b'v', b'.', ..] | [b'@', ..] => true,
        [b'P' | b'p', next, ..] => next.is_ascii_digit() || matches!(next, b'[' | b'P' | b'p'),
        _ => false,
    }
}

/// The word at the end of `before`.
pub(super) fn last_word(before: &str) -> &str {
    before.trim_ascii_end().rsplit([' ', '\t']).next().unwrap_or_default()
}

/// Whether `before` ends in a radius with a negative index, `R-1`.
pub(super) fn ends_in_negative_radius(before: &str) -> bool {
    let index = last_word(before).strip_prefix(['R', 'r']).and_then(|rest| rest.strip_prefix('-'));
    index.is_some_and(|digits| !digits.is_empty() && digits.bytes().all(|b| b.is_ascii_digit()))
}

/// Length of the text to be marked: a run of letters and digits, or one character.
pub(super) fn token(rest: &str) -> usize {
    let run = rest.bytes().take_while(|b| b.is_ascii_alphanumeric() || *b == b'_').count();
    if run > 0 { run } else { rest.chars().next().map_or(0, char::len_utf8) }
}
