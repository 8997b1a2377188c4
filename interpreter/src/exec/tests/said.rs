//! Messages that name the actual error where a program is refused for something that looks like another error.

use super::run;

/// ID and text of every message of a program.
fn said(text: &str) -> Vec<String> {
    run(text).diagnostics.iter().map(|d| format!("{}: {}", d.id, d.text)).collect()
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

#[test]
fn values_of_a_wrong_mode() {
    let mode = run("#VIB GUARD ON [MODE=5]\nM30\n");
    let values: Vec<_> = mode.diagnostics[0].values.iter().map(|v| v.value.clone()).collect();
    assert_eq!(values, [5.0.into(), 1.0.into(), 4.0.into()]);
}
