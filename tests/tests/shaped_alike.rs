//! Vibration Guard and FIR filter on axes other than path axes: gantry slaves are filtered like their master, spindles as their lists
//! say.

use kontur_filters::kernel::Kernel;
use kontur_filters::time::CycleTime;
use kontur_filters::vib_guard::VibGuardSettings;
use kontur_interpreter::diag::Condition;
use kontur_kit::{Random, count, seed};
use kontur_tests::{Run, Settings, run, run_on, sample_machine};

/// Axes of the records: X, Y, Z, then the slave of X; the machine has no spindle.
const SLAVE: usize = 3;
/// The spindle of the machine `xyz` after X, Y, Z.
const SPINDLE: usize = 3;

fn on_gantry(settings: impl Settings, lines: &str) -> Run {
    run_on(sample_machine("gantry", settings), &format!("{lines}\nM30\n"))
}

/// The bridge does not rack, whatever shapes the motion of its master and whenever it is switched: same set positions, bit for bit.
#[test]
fn a_gantry_slave_is_shaped_like_its_master() {
    const FIR: &str = "X,Y,Z.filter_fir: type=1, order=40, enable=1";
    const WAYS: &str = "G01 F6000 X20 Y5\nG00 X-3 Z2\nG02 X10 I6.5 J3 F4000";
    for k in 0..count(10) as u64 {
        let mut random = Random::new(seed() + k);
        let (mode, freq) = (random.below(4) + 1, random.log(3.0, 60.0));
        let guard = format!("#VIB GUARD ON [MODE={mode} FREQ={freq:.3}]");
        let listed =
            |axes: &str| format!("{axes}.vib_guard: active=1, mode={mode}, freq={freq:.3}");
        let order = random.below(60) + 2;
        for (settings, lines) in [
            (String::new(), format!("{guard}\n{WAYS}\n#VIB GUARD OFF\n{WAYS}\n{guard}\nG01 X0")),
            (
                String::new(),
                format!("#VIB GUARD ON [MODE={mode} FREQ={freq:.3} AX_DEV=0.05]\n{WAYS}"),
            ),
            (listed("X,Y,Z"), WAYS.to_owned()),
            (listed("X,Y,Z,X2"), WAYS.to_owned()),
            (FIR.to_owned(), WAYS.to_owned()),
            (
                "X,Y,Z.filter_fir.type=1".to_owned(),
                format!("#FILTER ON [ORDER={order}]\n{WAYS}\n#FILTER OFF\n{WAYS}"),
            ),
        ] {
            let run = on_gantry(&settings, &lines);
            let what = format!("seed {}: {settings:?} {lines}", seed() + k);
            assert!(!run.totals.aborted, "{what}: {:?}", run.diagnostics);
            let said: Vec<_> = run.diagnostics.iter().map(|d| d.id).collect();
            assert!(!said.iter().any(|id| *id == Condition::UnequalKernels), "{what}");
            let apart = |a: &kontur_interpreter::record::AxisRecord| (a.set - a.ipo).abs();
            let most = run.records.iter().map(|r| apart(&r.axes[0])).fold(0.0, f64::max);
            assert!(most > 0.01, "{what}: not shaped");
            for r in &run.records {
                let (master, slave) = (&r.axes[0], &r.axes[SLAVE]);
                assert_eq!(master.set.to_bits(), slave.set.to_bits(), "{what}: cycle {}", r.k);
                assert_eq!(master.reference.to_bits(), slave.reference.to_bits(), "{what}");
            }
        }
    }
}

/// Entries of the slave alone are reported: a kernel has no effect, a standard filter racks the bridge.
#[test]
fn filters_of_a_slave_alone_are_reported() {
    let kernel = on_gantry("X2.vib_guard.active=1", "G01 X5 F3000");
    let said: Vec<_> = kernel.diagnostics.iter().map(|d| d.id).collect();
    assert_eq!(said, [Condition::ListNoEffect]);
    assert!(kernel.records.iter().all(|r| r.axes[SLAVE].set.to_bits() == r.axes[0].set.to_bits()));
    for (axes, racks) in [("X,Y,Z", true), ("X2", true), ("X,Y,Z,X2", false)] {
        let low_pass = "enable=1, type=1, order=1, time_constant=20000";
        let run = on_gantry(&format!("{axes}.filter[0]: {low_pass}"), "G01 X5 F3000");
        let told = run.diagnostics.iter().find(|d| d.id == Condition::UnequalKernels);
        assert_eq!(told.is_some(), racks, "{axes:?}");
        assert!(told.is_none_or(|d| d.text.contains("X2")), "{told:?}");
    }
}

/// `sum h_k x[n-k]` over the cycles, with the first position for all times before them.
fn convolved(x: &[f64], kernel: &Kernel) -> Vec<f64> {
    let past = |n: usize, delay: u32| x[n.saturating_sub(delay as usize)];
    (0..x.len()).map(|n| kernel.taps().iter().map(|t| t.weight * past(n, t.delay)).sum()).collect()
}

/// A guard in the list of a spindle acts on its ramps and on its motion to an angle, also under commands that concern the path axes.
#[test]
fn spindles_are_shaped_by_their_lists() {
    let settings = VibGuardSettings { mode: 1, freq_hz: 10.0, damping: 0.0 };
    let text = "M3 S1000\nG04 0.5\n#VIB GUARD ON [MODE=3 FREQ=20]\nG01 X5 F3000\n#VIB GUARD OFF\n\
                M5\nG04 1\nS[M19 POS=90 REV=100]\nM30\n";
    let shaped = run(text, "S.vib_guard: active=1, mode=1, freq=10, damping=0");
    assert_eq!(shaped.diagnostics, []);
    let (ipo, set) = (shaped.axis(SPINDLE, |a| a.ipo), shaped.axis(SPINDLE, |a| a.set));
    let kernel = settings.kernel(CycleTime::DEFAULT).unwrap();
    for ((set, want), ipo) in set.iter().zip(convolved(&ipo, &kernel)).zip(&ipo) {
        assert!((set - want).abs() < 1e-8, "{set} {want}, before the guard {ipo}");
    }
    assert!(ipo.iter().zip(&set).any(|(ipo, set)| (ipo - set).abs() > 100.0));
    assert!((set.last().unwrap().rem_euclid(360.0) - 90.0).abs() < 1e-9);
    // without an entry in its list it is not shaped
    let plain = run(text, &[]);
    let apart =
        |r: &kontur_interpreter::record::CycleRecord| r.axes[SPINDLE].set - r.axes[SPINDLE].ipo;
    assert!(plain.records.iter().all(|r| apart(r).abs() <= 0.0));
    let fir = run("M3 S1000\nG04 0.5\nM30\n", "S.filter_fir: type=1, order=100, enable=1");
    // at constant speed it is late by the mean delay, 50 cycles
    let last = fir.records.last().unwrap();
    let behind = last.axes[SPINDLE].ipo - last.axes[SPINDLE].set;
    assert!((behind - 6000.0 * 0.050).abs() < 1e-6, "{behind}");
}

/// A guard of a list that cannot be built is off, and the machine runs without it.
#[test]
fn a_listed_guard_that_cannot_be_built_is_off() {
    let run = run("G01 X5 F3000\nM30\n", "X,Y,Z.vib_guard: active=1, damping=1");
    let said = run.diagnostics.iter().filter(|d| d.id == Condition::GuardNotRealisable);
    assert_eq!(said.filter(|d| !d.is_error()).count(), 3, "{:?}", run.diagnostics);
    assert!(!run.totals.aborted);
    assert!(run.records.iter().all(|r| r.axes[0].set.to_bits() == r.axes[0].ipo.to_bits()));
}

/// Entries that make a bridge rack, or that are not monitored in the slave, are reported in notes; equal entries are not.
#[test]
fn differences_of_a_gantry_slave_are_noted() {
    let notes = |settings: &[&str]| {
        let (_, found) = sample_machine("gantry", settings);
        let said = found.iter().filter(|d| d.id == Condition::ListAdvice);
        said.map(|d| d.text.clone()).collect::<Vec<_>>()
    };
    assert_eq!(notes(&[]), [""; 0]);
    let one = notes(&["X2.vorsteuer.vorsteuerung=NONE"]);
    assert!(one.len() == 1 && one[0].contains("feedforward"), "{one:?}");
    assert_eq!(notes(&["*.vorsteuer.vorsteuerung=NONE"]), [""; 0]);
    let limit = notes(&["X2.kenngr.swe_pos=100000"]);
    assert!(limit.len() == 1 && limit[0].contains("not monitored"), "{limit:?}");
}
