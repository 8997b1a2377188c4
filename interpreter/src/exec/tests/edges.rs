//! Ends of ranges: the last value that is still one thing, and the first that is another.

use super::{clean, run};
use crate::diag::Condition;
use crate::exec::Event;

fn end(text: &str) -> Vec<f64> {
    clean(&format!("F100 G01\n{text}\nM30\n")).end
}

fn id(condition: Condition) -> [String; 1] {
    [condition.id().to_string()]
}

#[test]
fn a_condition_is_true_from_a_half_on() {
    assert_eq!(end("$IF 0.5\nX1\n$ENDIF"), [1.0, 0.0, 0.0]);
    assert_eq!(end("$IF 0.499\nX1\n$ENDIF\nY1"), [0.0, 1.0, 0.0]);
}

/// A whole number may be off by less than 0.001, as in `$SWITCH`.
#[test]
fn calculated_indices_are_nearly_whole() {
    assert_eq!(end("P[1.0005]=7\nX P1"), [7.0, 0.0, 0.0]);
    assert_eq!(run("P[1.002]=7\nM30\n").ids(), id(Condition::ParameterNumber));
}

/// 16 bits up to 0xFFFF, 32 bits beyond; negative numbers are signed.
#[test]
fn bits_are_inverted_up_to_the_last_one() {
    assert_eq!(end("X[1+INV[65535]] Y[INV[65536]-4294901758]"), [1.0, 1.0, 0.0]);
    assert_eq!(end("X[1+INV[4294967295]] Y[INV[-2147483648]-2147483646]"), [1.0, 1.0, 0.0]);
    assert_eq!(run("P1=INV[4294967296]\nM30\n").ids(), id(Condition::Range));
    assert_eq!(run("P1=INV[-2147483649]\nM30\n").ids(), id(Condition::Range));
}

#[test]
fn a_function_of_four_arguments_needs_all_of_them() {
    let three = run("P1=REPLACE[\"ab\",\"b\",\"c\"]\nM30\n");
    assert_eq!(three.ids(), id(Condition::TooFewArguments));
}

/// No chamfer fits where the path reverses; M functions of the motion after a chamfer are carried out once, at it.
#[test]
fn chamfers_at_a_reversal_and_beside_functions() {
    let reversal = run("F100 G01 X10\nG301 I2\nX0\nM30\n");
    assert_eq!(reversal.ids(), id(Condition::Range));
    let run = clean("F100 G01 X10\nG301 I2\nY10 M8\nM30\n");
    let functions = run.events().into_iter().filter(|e| matches!(e, Event::MFunction { .. }));
    assert_eq!(functions.count(), 1);
}

/// The centre that is not given is the present position without the rotation before: (10, 10). (10, 20) is 10 mm beside
/// it in Y, which a quarter turn makes -X.
#[test]
fn a_second_rotation_turns_about_the_present_position() {
    let at = end("X10\nG68 R90\nX20\nG68 R90\nX10 Y20");
    assert!(at.iter().zip([0.0, 10.0, 0.0]).all(|(a, b)| (a - b).abs() < 1e-9), "{at:?}");
}
