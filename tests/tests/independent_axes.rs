//! Independent axes in runs of programs: timelines independent of the path, joins, errors.

use kontur_tests::run;

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
        run.of_line(5).filter(|r| r.path.v_mm_s > 0.0).map(|r| r.axes[0].ipo.to_bits()).collect()
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
