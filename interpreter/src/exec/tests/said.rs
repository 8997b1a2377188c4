//! Messages that name the actual error where a program is refused for something that looks like another error.

use super::run;

/// ID and text of every message of a program.
fn said(text: &str) -> Vec<String> {
    run(text).diagnostics.iter().map(|d| format!("{}: {}", d.id, d.text)).collect()
}

#[test]
fn a_feed_of_0_is_a_word_that_was_programmed() {
    assert_eq!(said("F1000\nF0 X1\nM30\n"), ["20008: the feed is 0: value of the last F word"]);
    let never = said("G01 X1\nM30\n");
    assert_eq!(never, ["20008: the feed is 0: no F word has been programmed"]);
}

#[test]
fn a_variable_that_is_written_before_its_declaration_is_not_declared() {
    assert_eq!(said("V.L.NEW=1\nM30\n"), ["K-0012: V.L.NEW is not declared"]);
}

#[test]
fn an_exponent_is_an_e_word() {
    let negative = run("F1000\nX1e-05\nM30\n").diagnostics;
    assert!(negative.len() == 1 && negative[0].is_error(), "{negative:?}");
    assert!(negative[0].text.starts_with("E-5 is negative"), "{negative:?}");
    assert!(format!("{negative:?}").contains("cannot have an exponent"), "{negative:?}");
    let joined = said("F1000\nX1e1\nM30\n");
    assert!(joined.len() == 1 && joined[0].contains("cannot have an exponent"), "{joined:?}");
    let apart = said("F1000\nX1 E1\nM30\n");
    assert!(apart.len() == 1 && apart[0].contains("extruder"), "{apart:?}");
}

/// `#RND0.5` is one mistake: the sign between name and value.
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

#[test]
fn levels_count_the_main_program() {
    // L1 calls L2 and so on; the last one makes no call
    let program = |depth: usize| {
        let local = |i: usize| {
            let call = if i < depth { format!("LL S{}\n", i + 1) } else { String::new() };
            format!("%L S{i}\n{call}M17\n")
        };
        let locals: String = (1..=depth).map(local).collect();
        format!("{locals}%MAIN\nLL S1\nM30\n")
    };
    assert!(said(&program(31)).is_empty());
    let refused = said(&program(32));
    assert!(refused[0].contains("more than 31 deep"), "{refused:?}");
}

/// The example of TF5200 error management 558268811, as a warning. Meanings: diagnosis 249247371.
#[test]
fn values_of_an_error_have_the_meanings_that_the_program_states() {
    use crate::diag::ValueKind::{Current, UpperLimit, Wrong};
    let found =
        run("#ERROR [ID455 RC0 MID=7 PV1=5 PV2=4.999 PV3=1 PV4=8 PM1=2 PM2=3 PM3=0 PM4=19]\nM30\n");
    let d = &found.diagnostics[0];
    let kinds: Vec<_> = d.values.iter().map(|value| value.kind).collect();
    assert_eq!((kinds, d.multiple_id), (vec![Current, Wrong, UpperLimit], 7));
}
