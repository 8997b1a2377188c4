//! Independent axes in runs of programs: timelines independent of the path, joins, errors.

use kontur_interpreter::diag::Diagnostic;
use kontur_interpreter::machine::Machine;
use kontur_kit::near;
use kontur_tests::{Run, largest_step, linear_machine, run, run_on};

/// The linear slope as default.
fn linear(more: &[&str]) -> (Machine, Vec<Diagnostic>) {
    linear_machine(&[&["channel.prog_start.slope.profile=0"][..], more].concat())
}

fn go(program: &str) -> Run {
    let run = run_on(linear(&[]), &format!("%P\n{program}\nM30\n"));
    assert_eq!(run.diagnostics, [], "{program}");
    run
}

fn ipo(run: &Run, axis: usize) -> Vec<f64> {
    run.axis(axis, |a| a.ipo)
}

fn at(run: &Run, axis: usize, time_s: f64) -> f64 {
    ipo(run, axis)[(time_s / run.cycle_s).round() as usize]
}

/// First time at which an axis has been away from and is at a position.
fn arrival_s(run: &Run, axis: usize, target: f64) -> f64 {
    let values = ipo(run, axis);
    let k = (1..values.len())
        .find(|k| (values[*k] - target).abs() < 1e-9 && (values[k - 1] - target).abs() >= 1e-9);
    k.map_or(f64::INFINITY, |k| k as f64 * run.cycle_s)
}

/// With the ramps of the list, 30 ms, and 3500 mm/s2: `100 / 100 + 2 sqrt(100 / j)`, `j = 3500 / 0.03`; full acceleration is not reached.
#[test]
fn slope_of_its_own() {
    let run = go("X[INDP_SYN G90 G01 FEED=6000 POS=100 SLOPE_TYPE=TRAPEZ]");
    let change_s = 2.0 * (100.0 * 0.03 / 3500.0_f64).sqrt();
    let cycles = ((1.0 + change_s) / run.cycle_s).ceil();
    near(arrival_s(&run, 0, 100.0), cycles * run.cycle_s, 1e-9);
    near(at(&run, 0, 0.5), 100.0 * (0.5 - change_s / 2.0), 1e-9);
}

/// The distance that the axis has moved alone is in the coordinates: lines and arcs continue from there.
#[test]
fn coordinates_continue() {
    let run = go(
        "X[INDP_SYN G90 G01 FEED=6000 POS=20]\nG90 G01 X30 Y10 F6000\nX20 Y0\nG02 X40 Y0 I10 J0\nG91 G01 X-5",
    );
    let arc = run.records.iter().filter(|r| r.line == 5);
    let radius = arc.map(|r| libm::hypot(r.axes[0].ipo - 30.0, r.axes[1].ipo));
    assert!(radius.clone().count() > 100 && radius.into_iter().all(|r| (r - 10.0).abs() < 1e-9));
    near(run.records.last().unwrap().axes[0].ipo, 35.0, 1e-9);
    assert!(largest_step(&ipo(&run, 0)) < 0.1 + 1e-9);
}

/// The path does not depend on the motion: its setpoints are the same bit for bit, also through rounded corners.
#[test]
fn the_path_is_the_same() {
    let path =
        "G90 G01 X10 F3000\nG261\n#CONTOUR MODE [DEV PATH_DEV=0.1]\nY10\nX0\nG02 Y0 J-5\nG01 X30\n";
    let plain = run(&format!("%P\n{path}M30\n"), &[]);
    let with = run(&format!("%P\nZ[INDP_ASYN G01 FEED=500 POS=-3]\n{path}M30\n"), &[]);
    let bits = |run: &Run| -> Vec<[u64; 2]> {
        run.records.iter().map(|r| [r.axes[0].ipo.to_bits(), r.axes[1].ipo.to_bits()]).collect()
    };
    let (a, b) = (bits(&plain), bits(&with));
    assert!(a.len() <= b.len() && a.len() > 500);
    assert_eq!(a[..], b[..a.len()]);
    near(with.records.last().unwrap().axes[2].ipo, -3.0, 1e-9);
    let error = |run: &Run| run.records.iter().map(|r| r.contour_err_mm).fold(0.0, f64::max);
    near(error(&with), error(&plain), 1e-9);
}

/// A filter delays the axis; that is not a deviation from the contour of the path, and joins wait until it has settled.
#[test]
fn filtered() {
    let delay = [
        "X.filter[0].enable=1",
        "X.filter[0].order=1",
        "X.filter[0].type=TIME_DELAY",
        "X.filter[0].time_constant=5000",
    ];
    let program =
        "%P\nX[INDP_ASYN G90 G01 FEED=600 POS=20]\nG90 G01 Y50 F6000\n#WAIT INDP ALL\nY0\nM30\n";
    let run = run_on(linear(&delay), program);
    let set = run.axis(0, |a| a.set);
    assert!(ipo(&run, 0).iter().zip(&set[5..]).all(|(a, b)| a.to_bits() == b.to_bits()));
    assert!(run.records.iter().all(|r| r.contour_err_mm <= 1e-12));
    near(arrival_s(&run, 0, 20.0), 2.01, 1e-9);
    near(arrival_s(&run, 1, 0.0), 2.015 + 0.6, 1e-9);
}

/// An error of another axis stops an independent axis on its own path, within its limits.
#[test]
fn stopped_by_an_error() {
    let settings = ["Y.getriebe[0].slep_ueberw_typ=4", "Y.getriebe[0].slep_max=1000"];
    let program = "%P\nG90 G01 Y100 F6000 X[INDP_ASYN G01 FEED=6000 POS=200]\nM30\n";
    let run = run_on(linear(&settings), program);
    assert_eq!(run.ids(), [70020]);
    let x = ipo(&run, 0);
    assert!(x.last().unwrap() < &100.0);
    let n = x.len();
    assert!((x[n - 1] - x[n - 2]).abs() <= 0.0, "at rest");
    assert!(x.windows(3).all(|w| (w[2] - 2.0 * w[1] + w[0]).abs() <= 1000.0 * 1e-6 * 1.001));
}

/// An axis oscillates between -10 and 10 while the path continues; it always ends at the second position, and the path does not wait for
/// it before OSC OFF.
#[test]
fn an_axis_oscillates_beside_the_path() {
    let program = "%P\n#SLOPE [TYPE=STEP]\nN10 G90 G01 X10 F6000\nN20 Y[OSC ON 1ST_POS=-10 2ND_POS=10 FEED=6000]\n\
        N30 X110 F6000\nN40 Y[OSC OFF]\nN50 Y0\nM30\n";
    let run = kontur_tests::run(program, &[]);
    assert!(run.diagnostics.iter().all(|d| !d.is_error()), "{:?}", run.diagnostics);
    let y = run.axis(1, |a| a.ipo);
    let (low, high) = y.iter().fold((0.0_f64, 0.0_f64), |(l, h), y| (l.min(*y), h.max(*y)));
    assert!(low.to_bits() == (-10.0_f64).to_bits() && high.to_bits() == 10.0_f64.to_bits());
    // a stroke of 20 mm at 100 mm/s takes 0.2 s and the ramps: at least two oscillations in the second of N30
    let highs =
        y.windows(2).filter(|w| w[0] < 10.0 && w[1].to_bits() == 10.0_f64.to_bits()).count();
    assert!((2..=4).contains(&highs), "{highs}");
    // the path of N30 is the same as in a program without the oscillation
    let alone = kontur_tests::run(
        &program
            .replace("N20 Y[OSC ON 1ST_POS=-10 2ND_POS=10 FEED=6000]", "N20 #FLUSH")
            .replace("N40 Y[OSC OFF]", ""),
        &[],
    );
    let of_line = |run: &kontur_tests::Run| -> Vec<u64> {
        run.records
            .iter()
            .filter(|r| r.line == 5 && r.path.v_mm_s > 0.0)
            .map(|r| r.axes[0].ipo.to_bits())
            .collect()
    };
    assert_eq!(of_line(&run), of_line(&alone));
    // N50 begins at the second position
    let first = run.records.iter().find(|r| r.line == 7).unwrap();
    assert!(first.axes[1].ipo <= 10.0 && first.axes[1].ipo > 9.0, "{}", first.axes[1].ipo);
    assert!(y.last().unwrap().abs() < 1e-9);
}

/// FREQ=0.5: an oscillation takes two seconds, or 2.25 s with rests of 0.25 s at the second position; NBR_OSC counts them.
#[test]
fn a_frequency_of_oscillation() {
    let of = |keys: &str| {
        let program = format!(
            "%P\n#SLOPE [TYPE=STEP]\nN20 Y[OSC ON 1ST_POS=0 2ND_POS=20 {keys}]\nG04 10\nM30\n"
        );
        let run = kontur_tests::run(&program, &[]);
        assert!(run.diagnostics.iter().all(|d| !d.is_error()), "{:?}", run.diagnostics);
        let y = run.axis(1, |a| a.ipo);
        let reached = |(i, w): (usize, &[f64])| {
            (w[0] < 20.0 && w[1].to_bits() == 20.0_f64.to_bits()).then_some(i)
        };
        (y.windows(2).enumerate().filter_map(reached).collect::<Vec<usize>>(), *y.last().unwrap())
    };
    let (times, end) = of("FREQ=0.5");
    assert!(times.windows(2).all(|w| w[1] - w[0] == 2000), "{times:?}");
    assert!((end - 20.0).abs() < 1e-9);
    let (times, _) = of("TIME=2 2ND_DELT=0.25");
    assert!(times.windows(2).all(|w| w[1] - w[0] == 2250), "{times:?}");
    let (times, end) = of("FREQ=1 NBR_OSC=3");
    assert_eq!((times.len(), end.to_bits()), (3, 20.0_f64.to_bits()));
}

/// ZERO_POS and EXCUR give the same positions as 1ST_POS and 2ND_POS; INCL_OFFSETS reads them in the coordinates of the program.
#[test]
fn middle_and_offsets_of_an_oscillation() {
    let of = |before: &str, keys: &str| {
        let program = format!(
            "%P\n#SLOPE [TYPE=STEP]\n{before}\nN20 Y[OSC ON {keys} FEED=6000 NBR_OSC=2]\nG04 2\nM30\n"
        );
        let run = kontur_tests::run(&program, &[]);
        assert!(run.diagnostics.iter().all(|d| !d.is_error()), "{:?}", run.diagnostics);
        run.axis(1, |a| a.ipo)
    };
    let wanted = of("", "1ST_POS=2 2ND_POS=12");
    assert_eq!(of("", "ZERO_POS=7 EXCUR=5"), wanted);
    assert_eq!(of("G92 Y-3", "ZERO_POS=7 EXCUR=5"), wanted);
    let offset = of("", "1ST_POS=-1 2ND_POS=9");
    assert_eq!(of("G92 Y-3", "ZERO_POS=7 EXCUR=5 INCL_OFFSETS"), offset.clone());
    assert_eq!(of("G92 Y-3", "1ST_POS=2 2ND_POS=12 INCL_OFFSETS"), offset);
}

/// An axis that was independent belongs to the path again: under the Vibration Guard it deviates at its corners as much as the same axis
/// in a program without that motion.
#[test]
fn afterwards_the_deviation_counts_again() {
    let guard = "#VIB GUARD ON [MODE=2 FREQ=20 AX_DEV=0.05]\nG01 F8000\n";
    let path = "Y10\nX20\nY20\nX0\n";
    let largest = |program: &str| {
        let run = run(&format!("%P\n{guard}{program}{path}M30\n"), &[]);
        run.records.iter().map(|r| r.axes[0].dev.abs()).fold(0.0, f64::max)
    };
    let with =
        largest("X[INDP_SYN G01 FEED=3000 POS=0.0]\nX[INDP_SYN G91 G01 FEED=3000 POS=5]\nG90 X0\n");
    let without = largest("X5\nX0\n");
    assert!(without > 0.03 && (with - without).abs() < 1e-6, "{with} instead of {without}");
}

/// Position monitoring of an independent axis begins where its own motion ends, while the path is still moving. What it reports is in
/// `arrival.txt`.
#[test]
fn the_stop_of_an_independent_axis_is_monitored() {
    let program = "%P\nZ[INDP_ASYN G90 G01 FEED=6000 POS=10]\nG01 X200 F6000\nM30\n";
    let run = run(program, "Z.getriebe[0].position_settling_time=100000");
    assert!(run.errors().is_empty());
    let (count, slowest) = run.totals.stops.axes[&2];
    // 10 mm at 100 mm/s; the lag of a second order decays in 44 ms, long before the end of the path
    assert!(count == 1 && slowest.source.line == 2 && slowest.settling_s > 0.02);
    assert!((slowest.k as f64) * run.cycle_s < 0.5);
}
