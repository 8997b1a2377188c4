//! Rules of the grammar in terms the user knows: the possible continuations at a position.

use crate::syntax::grammar::Rule;

pub(super) const VALUE: &str = "a value";
pub(super) const EQUALS: &str = "`=`";
pub(super) const BRACKET: &str = "`[`";
pub(super) const LEVEL: &str = "MAIN or JUMPS";
pub(super) const WORD: &str = "a word";
pub(super) const COMMA: &str = "`,`";
pub(super) const OPERATOR: &str = "an operator";
pub(super) const END: &str = "the end of the block";

/// The possible continuations, most likely first, without repetition.
pub(super) fn expected(rules: &[Rule]) -> Vec<&'static str> {
    let mut words: Vec<(u8, &'static str)> =
        rules.iter().filter_map(|rule| user_word(*rule)).collect();
    words.sort_unstable();
    words.dedup();
    let mut words: Vec<&'static str> = words.into_iter().map(|(_, word)| word).collect();
    // a value may begin with a bracket or a parameter, and an index may follow almost everywhere: not worth mentioning
    let value = words.contains(&VALUE);
    let many = words.len() > 1;
    words.retain(|word| !(value && *word == WORD || many && *word == BRACKET));
    words.truncate(4);
    words
}

/// A rule of the grammar in terms the user knows.
fn user_word(rule: Rule) -> Option<(u8, &'static str)> {
    Some(match rule {
        Rule::expression
        | Rule::decimal
        | Rule::sign
        | Rule::constant
        | Rule::function
        | Rule::bracketed
        | Rule::function_name
        | Rule::signed_number
        | Rule::value
        | Rule::chain
        | Rule::value_name => (0, VALUE),
        Rule::digits | Rule::code_number | Rule::code_digits => (1, "a number"),
        Rule::equals | Rule::compound => (2, EQUALS),
        Rule::comma => (3, COMMA),
        Rule::close => (4, "`]`"),
        Rule::open | Rule::group | Rule::cycle_group | Rule::index | Rule::word_bracket => {
            (5, BRACKET)
        }
        Rule::key
        | Rule::parameter_key
        | Rule::ordinal
        | Rule::flag
        | Rule::directed
        | Rule::item
        | Rule::pair
        | Rule::bare_pair
        | Rule::item_value => (6, "a key"),
        Rule::operator => (7, OPERATOR),
        Rule::return_main | Rule::return_jumps | Rule::return_key => (5, LEVEL),
        Rule::target | Rule::label_name => (8, "a label"),
        Rule::file_name | Rule::program_call => (8, "a program name"),
        Rule::type_name => (8, "a type"),
        Rule::command_word => (8, "a command word"),
        Rule::place
        | Rule::parameter
        | Rule::variable
        | Rule::assignment
        | Rule::hash_name
        | Rule::hash_word
        | Rule::g_word
        | Rule::m_word
        | Rule::letter
        | Rule::letter_word => (10, WORD),
        Rule::EOI => (11, END),
        _ => return None,
    })
}
