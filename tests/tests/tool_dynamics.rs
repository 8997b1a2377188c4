//! What a tool permits its spindle: P-TOOL-00012 to 00015, `S[GET_DYNAMIC_DATA]`, `S[DEFAULT_DYNAMIC_DATA]`.
//!
//! D1 has the numbers of TF5200 spindle 287608459: 10 to 500 rev/min and 3000 deg/s2; D2 allows 200 rev/min at most.

use kontur_kit::Random;
use kontur_tests::{Run, run};

const TOOLS: [&str; 14] = [
    "tool.wz[1].gueltig=1",
    "tool.wz[1].log_ax_nr_spdl=4",
    "tool.wz[1].vb_min=60000",
    "tool.wz[1].vb_max=3000000",
    "tool.wz[1].a_max=3000",
    "tool.wz[2].gueltig=1",
    "tool.wz[2].log_ax_nr_spdl=4",
    "tool.wz[2].vb_max=1200000",
    "tool.wz[2].a_max=3000",
    "tool.wz[3].gueltig=1",
    "tool.wz[4].gueltig=1",
    "tool.wz[4].log_ax_nr_spdl=4",
    "tool.wz[4].vb_max=2000000000",
    "tool.wz[4].a_max=1000000000",
];

/// Its speed at the end of a line.
fn last(run: &Run, line: u32) -> f64 {
    *run.spindle_rpm(line).last().unwrap()
}

#[test]
fn the_tool_limits_speed_and_acceleration() {
    let run = run("%P\nD1\nM3 S2000\nG04 2\nS5\nG04 2\nM5\nG04 1\nM30\n", &TOOLS);
    let ids: Vec<_> = run.diagnostics.iter().map(|d| d.id.to_string()).collect();
    assert_eq!(ids, ["K-0131", "K-0131"]);
    assert!((last(&run, 4) - 500.0).abs() < 1e-6, "{}", last(&run, 4));
    assert!((last(&run, 6) - 10.0).abs() < 1e-6, "{}", last(&run, 6));
    assert!(last(&run, 8).abs() < 1e-6);
    let all: Vec<f64> =
        [4, 5, 6, 7, 8].into_iter().flat_map(|line| run.spindle_rpm(line)).collect();
    let most = all.windows(2).map(|v| (v[1] - v[0]).abs() * 6.0 / run.cycle_s).fold(0.0, f64::max);
    assert!(most <= 3000.0 + 1e-3, "{most}");
    assert!(most > 2999.0, "{most}");
}

/// The list alone allows 60000 deg/s2, the weight halves it; the smaller of the two limits applies.
#[test]
fn the_weight_of_the_acceleration_acts_on_the_list_and_not_on_the_tool() {
    for (percent, most) in [(50.0, 3000.0), (2.0, 1200.0)] {
        let run = run(&format!("%P\nD1\nS[G130={percent}]\nM3 S400\nG04 3\nM30\n"), &TOOLS);
        let all = run.spindle_rpm(5);
        let is =
            all.windows(2).map(|v| (v[1] - v[0]).abs() * 6.0 / run.cycle_s).fold(0.0, f64::max);
        assert!((is - most).abs() < most * 1e-3, "{is}, not {most}");
    }
}

#[test]
fn limits_are_taken_at_a_start_from_rest_or_by_command_and_kept() {
    let run = run(
        "%P\nD1\nM3 S400\nG04 2\nD2\nS450\nG04 2\nS[GET_DYNAMIC_DATA]\nG04 2\nM5\nD0\nG04 2\nM3 S400\nG04 2\nM5\n\
         G04 2\nS[DEFAULT_DYNAMIC_DATA]\nM3 S2000\nG04 2\nM30\n",
        &TOOLS,
    );
    for (line, want) in [(4, 400.0), (7, 450.0), (9, 200.0), (14, 200.0), (19, 2000.0)] {
        assert!((last(&run, line) - want).abs() < 1e-6, "line {line}: {}", last(&run, line));
    }
}

/// A tool without a spindle leaves the limits unchanged (P-TOOL-00012 = 0); default data take effect for a turning spindle when it next
/// starts.
#[test]
fn what_changes_nothing_at_once() {
    let run = run(
        "%P\nD3\nM3 S2000\nG04 1\nM5\nG04 1\nD1\nM3 S2000\nG04 2\nS[DEFAULT_DYNAMIC_DATA]\nG04 1\nM5\nG04 2\nM3\nG04 1\nM30\n",
        &TOOLS,
    );
    for (line, want) in [(4, 2000.0), (9, 500.0), (11, 500.0), (15, 2000.0)] {
        assert!((last(&run, line) - want).abs() < 1e-6, "line {line}: {}", last(&run, line));
    }
}

/// Random commands: a tool that permits everything gives the same bits as one without a spindle.
#[test]
fn limits_beyond_those_of_the_list_change_nothing() {
    let mut random = Random::new(20_261_126);
    for _ in 0..40 {
        let mut program = String::new();
        for _ in 0..8 {
            program += &match random.below(7) {
                0 => format!("M3 S{}\n", random.below(13_000)),
                1 => format!("M4 S{}\n", random.below(13_000)),
                2 => "M5\n".to_owned(),
                3 => format!("M19 S200 S.POS{}\n", random.below(360)),
                4 => format!("S[G130={}]\n", 10 + random.below(90)),
                5 => "S[GET_DYNAMIC_DATA]\n".to_owned(),
                _ => format!("G04 {}\n", random.below(20) as f64 / 10.0),
            };
        }
        let angles = |tool: u32| {
            let run = run(&format!("%P\nD{tool}\n{program}M30\n"), &TOOLS);
            run.records.iter().map(|r| r.axes[3].set.to_bits()).collect::<Vec<_>>()
        };
        assert_eq!(angles(4), angles(3), "{program}");
    }
}

/// The minimum speed is for turning: positioning may be slower.
#[test]
fn positioning_has_the_largest_speed_alone() {
    for (s, want) in [(5, 5.0), (2000, 500.0)] {
        let run = run(&format!("%P\nD1\nM19 S{s} M3 S.POS350\nG04 15\nM30\n"), &TOOLS);
        assert_eq!(run.diagnostics, [], "S{s}");
        let most = run.spindle_rpm(4).into_iter().fold(0.0, f64::max);
        let reached = if s == 5 { want } else { most };
        assert!(most <= want + 1e-6 && (most - reached).abs() < 1e-6, "S{s}: {most}");
    }
}
