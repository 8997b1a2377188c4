//! Expressions, parameters, variables and control blocks.

use super::{clean, skipping};

#[test]
fn skipped_blocks() {
    let text = "F100\n/X1\n/2 Y1\n/10 N5 Z1\nM30\n";
    assert_eq!(skipping(text, &[]).end, [1.0, 1.0, 1.0]);
    assert_eq!(skipping(text, &[1]).end, [0.0, 1.0, 1.0]);
    assert_eq!(skipping(text, &[2, 10]).end, [1.0, 0.0, 0.0]);
}

/// A jump back does not parse again: the second million passes cost as much as with `$WHILE`, and have the same result.
#[test]
fn jumps_back_are_loops() {
    let body = "P1=P1+1\n$IF P1 MOD 3 == 0\nP2=P2+1\n$ENDIF\n";
    let end = "X P2/1000 F100\nM30\n";
    let by_while = clean(&format!("P1=0 P2=0\n$WHILE P1<100000\n{body}$ENDWHILE\n{end}"));
    let by_goto = clean(&format!("P1=0 P2=0\nN10:\n{body}$IF P1<100000 $GOTO N10\n{end}"));
    assert_eq!(by_goto.end, by_while.end);
}

/// Stops in place and dwells below half a cycle take no time, so a loop of them counts as a loop without motion.
#[test]
fn a_loop_of_stops_is_stopped() {
    use super::{Options, machine, run_with};
    use crate::source::MemorySources;
    for block in [
        "G60",
        "G04 0.0004",
        "#TIME 0",
        "#FLUSH WAIT",
        "#CHANNEL INIT [CMDPOS]",
        "M0",
        "#VIB GUARD OFF",
    ] {
        let options = Options { max_blocks: 20_000, max_blocks_at_rest: 500, ..Options::default() };
        let text = format!("$WHILE 1\n{block}\n$ENDWHILE\nM30\n");
        let run = run_with(MemorySources::new().with("main.nc", text), machine(&[]), options);
        assert_eq!(run.ids().last().map(String::as_str), Some("K-0017"), "{block}");
        assert!(run.steps.len() < 1100, "{block}: {}", run.steps.len());
    }
}

/// Functions and messages are output a thousand at a time, and a loop of them counts as a loop without motion.
#[test]
fn events_without_motion_are_handed_over_and_the_loop_is_stopped() {
    use super::{Options, machine, run_with};
    use crate::exec::step::Step;
    use crate::source::MemorySources;
    for block in ["M8", "#MSG [\"x\"]"] {
        let options = Options { max_blocks_at_rest: 50_000, ..Options::default() };
        let text = format!("$WHILE 1\n{block}\n$ENDWHILE\nM30\n");
        let run = run_with(MemorySources::new().with("main.nc", text), machine(&[]), options);
        assert_eq!(run.ids(), ["K-0017"], "{block}");
        let events = |step: &Step| match step {
            Step::Motion { events, .. } | Step::Sync { events, .. } | Step::End { events, .. } => {
                events.len()
            }
        };
        assert!(run.steps.len() > 10, "{block}");
        assert!(run.steps.iter().all(|step| events(step) <= 1000), "{block}");
    }
}

/// Commands under their older names (5252766831026775947, 15427960971).
#[test]
fn older_commands() {
    let speed = |text: &str| {
        let run = super::clean(&format!("{text}\nG01 X100 F60000\nM30\n"));
        let dynamics = run.blocks()[0].dynamics.clone();
        (dynamics.vector.vel_mm_s, dynamics.vector.acc_mm_s2)
    };
    for (old, new) in [
        ("#VECTORVEL [5000] ON", "#VECTOR LIMIT ON [VEL=5000]"),
        ("#VECTORVEL ON", "#VECTOR LIMIT ON [VEL]"),
        ("#VECTORACC ON[2700000]", "#VECTOR LIMIT ON [ACC=2700000]"),
        (
            "#VECTORVEL ON [50]\n#VECTORACC ON [2700000]\n#VECTORVEL OFF",
            "#VECTOR LIMIT ON [ACC=2700000]",
        ),
    ] {
        assert_eq!(speed(old), speed(new), "{old}");
        assert_ne!(speed(old), speed(""), "{old}");
    }
}

#[test]
fn line_ends_and_bytes_of_every_kind() {
    super::assert_end("X1 F100\rY2\r\nZ3", [1.0, 2.0, 3.0]);
    let bytes = b"\xEF\xBB\xBFX1 F100 (gr\xF6\xDFe)\nM30\n".to_vec();
    let sources = crate::source::MemorySources::new().with("main.nc", bytes);
    let run = super::run_with(sources, super::machine(&[]), super::Options::default());
    assert_eq!((run.ids().len(), run.end[0]), (0, 1.0));
}

/// A value of the list that the next ON will use is not overridden by a guard that is off.
#[test]
fn machine_data_says_only_what_never_acts() {
    let said = |text: &str| super::run(text).ids().contains(&"K-0075".to_owned());
    let change = |key: &str| format!("#MACHINE DATA [AX=X AXPARAM=\"{key}\"]\nX1 F100\nM30\n");
    let with = |guard: &str, key: &str| said(&format!("{guard}\n{}", change(key)));
    assert!(with("#VIB GUARD ON [FREQ=33]", "vib_guard.freq 45"));
    assert!(with("#VIB GUARD OFF", "vib_guard.active 1"));
    assert!(!with("#VIB GUARD OFF", "vib_guard.freq 45"));
    assert!(!with("#VIB GUARD ON [MODE=2]", "vib_guard.freq 45"));
    assert!(!with("", "vib_guard.freq 45"));
}
