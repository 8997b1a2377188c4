//! Spindles: changes of the speed with their ramps, limits of tools that permit everything.

use kontur_kit::{Random, largest};
use kontur_tests::run;

/// Ramp times in us (up, down, of speeding up and of braking), acceleration and deceleration 60000 deg/s2.
fn ramps([up, on, down, off]: [u32; 4]) -> String {
    format!(
        "S.getriebe[0].dynamik: tr_min=100, tr_w_min=100; S.getriebe[0].slope_profil: tr_beschl_zu={up}, \
         tr_beschl_ab={on}, tr_brems_zu={down}, tr_brems_ab={off}"
    )
}

/// Time in s and distance in deg while the spindle changes its speed in some lines, and the largest acceleration and jerk.
fn change(text: &str, us: [u32; 4], line: u32) -> [f64; 4] {
    let mut run = run(&format!("%P\n{text}\nM30\n"), &ramps(us));
    assert_eq!(run.diagnostics, []);
    run.records.retain(|r| r.line == line);
    let [set, v, a, jerk] = run.derivatives(3);
    let last = v[v.len() - 1];
    let changing = v.iter().take_while(|v| (*v - last).abs() > 1e-6).count();
    [changing as f64 * run.cycle_s, set[changing] - set[0], largest(&a), largest(&jerk)]
}

/// The ramp time is added to v / a (P-AXIS-00195 to 00198): the mean of both ramps where they differ. With equal ramps the mean speed is
/// half of the change.
#[test]
fn the_ramp_times_of_a_spindle_act() {
    let (v, a) = (6000.0, 60_000.0);
    let up = "M3 S1000\nG04 0.5";
    let down = "M3 S1000\nG04 0.5\nM5\nG04 0.5";
    for (text, line, us, ramp_s) in [
        (up, 3, [50_000; 4], 0.05),
        (up, 3, [20_000, 60_000, 5000, 5000], 0.04),
        (up, 3, [500, 999, 50_000, 50_000], 0.0),
        (down, 5, [5000, 5000, 20_000, 60_000], 0.04),
        (down, 5, [50_000, 50_000, 500, 999], 0.0),
    ] {
        let [time, way, acc, jerk] = change(text, us, line);
        assert!((time - (v / a + ramp_s)).abs() < 2.5e-3, "{us:?}: {time} s");
        if us.iter().all(|t| *t == us[0]) {
            assert!((way - v * (v / a + ramp_s) / 2.0).abs() < 2.5e-3 * v, "{way} deg");
        }
        assert!(acc <= a * (1.0 + 1e-6) && acc > 0.95 * a, "{us:?}: {acc}");
        let steep = us
            .iter()
            .filter(|t| **t >= 1000)
            .min()
            .map_or(f64::INFINITY, |t| a / f64::from(*t) * 1e6);
        assert!(ramp_s <= 0.0 || jerk <= steep * (1.0 + 1e-6), "{us:?}: {jerk}");
    }
}

/// From M3 to M4 through standstill, each part with its own ramps; a speed commanded while another change is under way keeps the jerk,
/// and positioning has the ramps too.
#[test]
fn changes_of_speed_in_a_row_keep_the_jerk() {
    let jerk_max = 60_000.0 / 0.05;
    for (text, line, end) in [
        ("M3 S1000\nG04 0.5\nM4 S1000\nG04 0.8", 5, -6000.0),
        ("M3 S1000\nG04 0.04\nM3 S300\nG04 0.5", 5, 1800.0),
        ("M3 S1000\nG04 0.12\nM3 S900\nG04 0.5", 5, 5400.0),
        ("M3 S1000\nG04 0.06\nM5\nG04 0.5", 5, 0.0),
        ("M19 S1000 S.POS180\nG04 0.5", 3, 0.0),
    ] {
        let run = run(&format!("%P\n{text}\nM30\n"), &ramps([50_000; 4]));
        assert_eq!(run.diagnostics, [], "{text}");
        let [_, v, a, jerk] = run.derivatives(3);
        assert!(largest(&a) <= 60_000.0 * (1.0 + 1e-6), "{text}: {}", largest(&a));
        assert!(largest(&jerk) <= jerk_max * (1.0 + 1e-6), "{text}");
        let last = run.records.iter().rposition(|r| r.line == line).unwrap();
        assert!((v[last - 1] - end).abs() < 1e-6, "{text}: {}", v[last - 1]);
    }
}

/// Random commands: a tool that permits everything gives the same bits as one without a spindle.
#[test]
fn limits_beyond_those_of_the_list_change_nothing() {
    let mut random = Random::new(20_261_126);
    let tools = "tool.wz[3].gueltig=1; \
                 tool.wz[4]: gueltig=1, log_ax_nr_spdl=4, vb_max=2000000000, a_max=1000000000";
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
            let run = run(&format!("%P\nD{tool}\n{program}M30\n"), tools);
            run.records.iter().map(|r| r.axes[3].set.to_bits()).collect::<Vec<_>>()
        };
        assert_eq!(angles(4), angles(3), "{program}");
    }
}
