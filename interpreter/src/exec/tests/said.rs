//! Texts that name what is wrong, where a program is refused for something that looks like something else.

use super::run;

/// ID and text of every message of a program.
fn said(text: &str) -> Vec<String> {
    run(text).diagnostics.iter().map(|d| format!("{}: {}", d.id, d.text)).collect()
}

#[test]
fn a_size_needs_an_equals_sign() {
    for word in ["#CHR0.5", "#CHF1", "#RND0.5", "#FRC500 #RND=1"] {
        let said = said(&format!("F1000\nX5\nX10 Y0 {word}\nY10\nM30\n"));
        assert!(said.len() == 1 && said[0].contains("without `=`"), "{word}: {said:?}");
        let alone = run(&format!("F1000\nX5\n{word}\nY10\nM30\n")).diagnostics;
        let (name, size) = word.split_once(' ').map_or(word, |(first, _)| first).split_at(4);
        let hint = format!("write {name}={size}");
        assert!(format!("{:?}", alone[0]).contains(&hint), "{alone:?}");
    }
}
