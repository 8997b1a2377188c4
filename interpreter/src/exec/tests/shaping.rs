//! `#VIB GUARD` and `#FILTER`: what persists, and the orders of filters.

use super::{Run, Sync, clean, run, run_on};
use crate::exec::step::{AxisShaping, ShapingSettings};

fn on(text: &str, settings: &[&str]) -> Run {
    run_on(settings, &format!("{text}\nM30\n"))
}

fn setups(run: &Run) -> Vec<&AxisShaping> {
    run.syncs()
        .into_iter()
        .filter_map(|s| match s {
            Sync::Shaping(setup) => Some(&setup.axes[0]),
            _ => None,
        })
        .collect()
}

fn guard(setup: &AxisShaping) -> (u8, f64, f64) {
    match setup.settings {
        ShapingSettings::VibGuard(g) => (g.mode, g.freq_hz, g.damping),
        other => panic!("{other:?}"),
    }
}

#[test]
fn keys_persist_but_the_tolerance_does_not() {
    let run = clean(
        "F100\n#VIB GUARD ON [MODE=2 FREQ=40 AX_DEV=0.01]\nX1\n#VIB GUARD ON\nX2\n#VIB GUARD OFF\nX3\n#VIB GUARD ON\nX4\nM30\n",
    );
    let tolerances: Vec<_> = run.blocks().iter().map(|b| b.tolerance.ax_dev_mm).collect();
    assert_eq!(tolerances, [Some(0.01), None, None, None]);
    let setups = setups(&run);
    // ON without a bracket changes no kernel and needs no stop
    assert_eq!(setups.len(), 3);
    assert_eq!((guard(setups[0]), guard(setups[2])), ((2, 40.0, 0.1), (2, 40.0, 0.1)));
    assert!(setups[1].kernel.is_none());
}

/// The values of the program stay for its next command; those of the lists act until then (TF5250, axis exchange commands).
#[test]
fn keys_outlast_an_axis_exchange() {
    let off = "G90 F100\n#VIB GUARD ON [MODE=2 FREQ=20 AX_DEV=0.02]\nX1\n#PUT AX [Z]\nX2\n#VIB GUARD ON\nX3";
    let run = on(off, &[]);
    let setups_off = setups(&run);
    assert_eq!(setups_off.len(), 3);
    assert!(setups_off[1].kernel.is_none());
    assert_eq!(guard(setups_off[2]), (2, 20.0, 0.1));
    let tolerances: Vec<_> = run.blocks().iter().map(|b| b.tolerance.ax_dev_mm).collect();
    assert_eq!(tolerances, [Some(0.02), None, None]);
    let listed = ["X,Y,Z.vib_guard.active=1", "X,Y,Z.vib_guard.mode=3", "X,Y,Z.vib_guard.freq=50"];
    let run = on("G90 F100\n#VIB GUARD [FREQ=20]\nX1\n#PUT AX [Z]\nX2\n#VIB GUARD\nX3", &listed);
    let frequencies: Vec<_> = setups(&run).iter().map(|setup| guard(setup)).collect();
    assert_eq!(frequencies, [(3, 20.0, 0.1), (3, 50.0, 0.1), (3, 20.0, 0.1)]);
    let told = |run: &Run| run.diagnostics.iter().any(|d| d.id.to_string() == "K-0102");
    assert!(told(&run));
    // AX_DEV alone is dropped as well: the lists have none
    let run = on("G90 F100\n#VIB GUARD [AX_DEV=0.01]\nX1\n#PUT AX [Z]\nX2", &listed);
    let tolerances: Vec<_> = run.blocks().iter().map(|b| b.tolerance.ax_dev_mm).collect();
    assert_eq!(tolerances, [Some(0.01), None]);
    assert!(told(&run));
    // a FIR filter is none of the guard
    let fir = ["X,Y,Z.filter_fir.type=1"];
    let run = on("G90 F100\n#FILTER ON [ORDER=20 AX_DEV=0.01]\nX1\n#PUT AX [Z]\nX2", &fir);
    let tolerances: Vec<_> = run.blocks().iter().map(|b| b.tolerance.ax_dev_mm).collect();
    assert_eq!(tolerances, [Some(0.01), Some(0.01)]);
    assert!(!told(&run));
}

#[test]
fn values_out_of_range() {
    let id = |text: &str| run(&format!("#VIB GUARD ON [{text}]\nM30\n"));
    let mode = id("MODE=5");
    let values: Vec<_> = mode.diagnostics[0].values.iter().map(|v| v.value.clone()).collect();
    assert_eq!(values, [5.0.into(), 1.0.into(), 4.0.into()]);
}

#[test]
fn filters_need_a_type_in_the_list() {
    let fir = ["X,Y,Z.filter_fir.type=1"];
    let run =
        on("F100\n#FILTER ON [ORDER=20 AX_DEV=0.01]\nX1\n#FILTER ON [ORDER_TIME=40000]\nX2", &fir);
    let lengths: Vec<_> =
        setups(&run).iter().map(|s| s.kernel.as_ref().unwrap().length()).collect();
    assert_eq!(lengths, [20, 40]);
    let tolerances: Vec<_> = run.blocks().iter().map(|b| b.tolerance.ax_dev_mm).collect();
    assert_eq!(tolerances, [Some(0.01), None]);
}
