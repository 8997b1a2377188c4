//! Skipped blocks, loops without motion, and bytes of every kind.

use super::skipping;

#[test]
fn skipped_blocks() {
    let text = "F100\n/X1\n/2 Y1\n/10 N5 Z1\nM30\n";
    assert_eq!(skipping(text, &[]).end, [1.0, 1.0, 1.0]);
    assert_eq!(skipping(text, &[1]).end, [0.0, 1.0, 1.0]);
    assert_eq!(skipping(text, &[2, 10]).end, [1.0, 0.0, 0.0]);
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

#[test]
fn line_ends_and_bytes_of_every_kind() {
    super::assert_end("X1 F100\rY2\r\nZ3", [1.0, 2.0, 3.0]);
    let bytes = b"\xEF\xBB\xBFX1 F100 (gr\xF6\xDFe)\nM30\n".to_vec();
    let sources = crate::source::MemorySources::new().with("main.nc", bytes);
    let run = super::run_with(sources, super::machine(&[]), super::Options::default());
    assert_eq!((run.ids().len(), run.end[0]), (0, 1.0));
}
