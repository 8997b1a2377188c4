//! Edge banding (G108): the path stops a set distance after the signal of the probe, calls the M function, and continues.
//!
//! Programs after the examples of the TF5200 programming manual (206219787, 206230027) and of the M and H functions
//! (285989771). The places are known beforehand: a set distance after the point where a line or an arc meets the surface.

use kontur_interpreter::diag::Diagnostic;
use kontur_interpreter::machine::Machine;
use kontur_interpreter::record::CycleRecord;
use kontur_kit::{Random, count, near};
use kontur_tests::{Run, linear_machine, run_with_inputs};

/// The built-in machine with a linear slope of 1000 mm/s2, M97 at the signal, 5 mm after it.
fn banding(more: &[&str]) -> (Machine, Vec<Diagnostic>) {
    let own = [
        "X,Y.kenngr.kasto_achse=1",
        "channel.m_synch[97]=MNE_SNS",
        "channel.kasto_residual_path=50000",
    ];
    linear_machine(&[&own[..], more].concat())
}

fn at(record: &CycleRecord) -> [f64; 2] {
    [record.axes[0].ipo, record.axes[1].ipo]
}

/// Records of a line of the program in which the path rests, except those at its end.
fn rests(run: &Run, line: u32) -> Vec<&CycleRecord> {
    let of_line: Vec<_> = run.of_line(line).collect();
    let end = at(of_line.last().unwrap());
    of_line.into_iter().filter(|r| r.path.v_mm_s == 0.0 && at(r) != end).collect()
}

/// From X0 Y0 to X90 Y90 and on to X150 Y150: the surface at X120 is met at Y120.
const ONE_BLOCK: &str = "N10 G90 G00 X0 Y0\nN20 G108\nN30 G01 X90 Y90 F2000\nN40 M97 G01 X150 Y150 F1200\n\
    N50 G01 X200 Y150 F1200\nN60 M30\n";

#[test]
fn the_path_stops_after_the_surface_and_continues() {
    let program = format!("#SLOPE [TYPE=STEP]\n{ONE_BLOCK}");
    let run = run_with_inputs(banding(&[]), &program, &[(0.0, "X_probe_mm", 120.0)]);
    assert!(run.errors().is_empty() && !run.totals.aborted, "{:?}", run.diagnostics);
    let stop = rests(&run, 5);
    let place = 120.0 + 5.0 / 2.0_f64.sqrt();
    assert!(!stop.is_empty());
    for r in &stop {
        near(at(r)[0], place, 1e-7);
        near(at(r)[1], place, 1e-7);
    }
    // it waits for the position windows
    let last = &stop.last().unwrap().axes;
    near(last[0].act, place, 0.011);
    // the speed of the block up to the braking, whose distance is v2 / 2a
    let (v, a) = (20.0, 1000.0 * 2.0_f64.sqrt());
    let first = stop[0].k as usize;
    let braking = (v / a / run.cycle_s).ceil() as usize;
    let of_line = run.of_line(5).filter(|r| (r.k as usize) < first - braking);
    assert!(of_line.clone().count() > 1000);
    for r in of_line.skip(20) {
        near(r.path.v_mm_s, v, 1e-9);
    }
    // the end of the block is a corner of 45 deg and not a stop
    let end = run.of_line(6).map(|r| r.path.v_mm_s);
    assert!(end.clone().next().unwrap() > 0.0);
    assert_eq!(at(run.records.last().unwrap()), [200.0, 150.0]);
    let functions = run.totals.not_counted.iter().filter(|f| *f == "M97").count();
    assert_eq!(functions, 1);
}

/// The distance counts from the surface, whatever the lag: half the gain doubles the lag and changes no place.
#[test]
fn the_lag_does_not_move_the_stop() {
    let of = |gain: &str| {
        let settings = [gain, "channel.kasto_residual_path=100000"];
        let inputs = [(0.0, "X_probe_mm", 120.0)];
        let run = run_with_inputs(banding(&settings), ONE_BLOCK, &inputs);
        assert!(run.errors().is_empty(), "{:?}", run.diagnostics);
        let before = run.records.iter().rfind(|r| r.axes[0].act < 120.0 && r.line == 4).unwrap();
        (at(rests(&run, 4)[0]), before.axes[0].lag)
    };
    let ([x, _], lag) = of("X,Y.getriebe[0].kv=6000");
    let ([slow_x, _], larger) = of("X,Y.getriebe[0].kv=3000");
    assert!(larger > 1.5 * lag && lag > 0.1, "{lag} {larger}");
    let place = 120.0 + 10.0 / 2.0_f64.sqrt();
    near(x, place, 1e-7);
    near(slow_x, place, 1e-7);
}

/// With a duration in the list the path waits that long.
#[test]
fn the_time_of_the_function() {
    let of = |duration: &str| {
        let settings = [duration];
        let inputs = [(0.0, "X_probe_mm", 120.0)];
        run_with_inputs(banding(&settings), ONE_BLOCK, &inputs)
    };
    let run = of("channel.m_prozess_zeit[97]=300000");
    // without --techno-times it is named, and nothing waits for it
    assert!(run.totals.not_counted.iter().any(|f| f.starts_with("M97 (0.3 s each")));
    assert_eq!(run.records.len(), of("channel.m_prozess_zeit[97]=0").records.len());
}

/// Random lines with every slope and guard: the stop is where it must be, or the program reports why there is none.
#[test]
fn random_lines() {
    let mut r = Random::new(108);
    let mut stopped = 0;
    for case in 0..count(40) {
        let slope = r.pick(&["STEP", "TRAPEZ", "SIN2", "HSC"]);
        let guard = r.pick(&[
            "",
            "",
            "#VIB GUARD ON [MODE=2 FREQ=40]\n",
            "#VIB GUARD ON [MODE=2 FREQ=40 AX_DEV=0.01]\n",
        ]);
        let end = [r.between(40.0, 120.0), r.between(-50.0, 50.0)];
        let (feed, way) = (r.between(300.0, 9000.0).round(), r.between(0.0, 40.0));
        let surface = r.between(10.0, 35.0);
        let program = format!(
            "#SLOPE [TYPE={slope}]\n{guard}G90 G00 X0 Y0\nV.G.RW = {way:.3}\nG108\nG01 X{:.3} Y{:.3} F{feed} M97\nG01 X0 Y60\nM30\n",
            end[0], end[1]
        );
        let line = if guard.is_empty() { 5 } else { 6 };
        // the override changes on the way, also between the signal and the stop, and there is a feedhold
        let mut times = [0.0; 4].map(|_| r.between(0.0, 2.0));
        times.sort_by(f64::total_cmp);
        let ratios = [r.between(30.0, 120.0), r.between(30.0, 120.0)];
        let inputs = [
            (0.0, "X_probe_mm", surface),
            (times[0], "override_percent", ratios[0]),
            (times[1], "override_percent", ratios[1]),
            (times[2], "feedhold", 1.0),
            (times[3], "feedhold", 0.0),
        ];
        let run = run_with_inputs(banding(&[]), &program, &inputs);
        if run.totals.aborted {
            assert_eq!(run.errors(), ["50655"], "{case}: {:?}", run.diagnostics);
            continue;
        }
        stopped += 1;
        assert_eq!(at(run.records.last().unwrap()), [0.0, 60.0], "{case}");
        let length = libm::hypot(end[0], end[1]);
        let written = |x: f64| (x * 1000.0).round() / 1000.0;
        let along = surface * libm::hypot(written(end[0]), written(end[1])) / written(end[0])
            + written(way);
        // where the filters of the guard delay both axes equally the measured point lies on the line
        let of_line = run.of_line(line);
        let stop = of_line.filter(|r| r.path.v_mm_s == 0.0).any(|r| {
            let [x, y] = at(r);
            (libm::hypot(x, y) - along).abs() < 1e-6
        });
        assert!(stop, "{case}: {program}");
        assert!(along < length + 1e-3, "{case}");
        for w in run.records.windows(2) {
            let step = (w[1].path.v_mm_s - w[0].path.v_mm_s).abs();
            assert!(step < 8.0, "{case}: {slope} {step} at {} line {}", w[0].k, w[0].line);
        }
    }
    assert!(stopped > count(40) / 4, "{stopped}");
}
