//! Feedforward, position control and Improved Position Control, from the lists to the behaviour of the axis.

mod feedforward;
mod ipc;

use kontur_filters::control::{AxisControl, AxisInputs, ControlOutput};
use kontur_filters::shaping::Shaping;
use kontur_filters::stage::Stage;
use kontur_filters::time::CycleTime;
use kontur_interpreter::diag::Diagnostic;
use kontur_interpreter::machine::{Machine, Override};
use kontur_kit::near;

const MS: CycleTime = CycleTime::DEFAULT;
const IPC: &str = "X.lr_param.improved_position_control";

/// The built-in machine with settings, and all messages about it.
fn machine(settings: &[String]) -> (Machine, Vec<Diagnostic>) {
    let settings: Vec<Override> = settings.iter().map(|s| Override::parse(s).unwrap()).collect();
    let (machine, mut found) = Machine::builtin(&settings).unwrap();
    found.extend(machine.chains().1);
    (machine, found)
}

fn split(settings: &str) -> Vec<String> {
    settings.split_whitespace().map(str::to_owned).collect()
}

fn ids(settings: &str) -> Vec<String> {
    machine(&split(settings)).1.iter().map(|d| d.id.to_string()).collect()
}

/// Axis X of the machine with settings; the messages are asserted elsewhere.
fn axis(settings: &str) -> AxisControl {
    let (machine, _) = machine(&split(settings));
    AxisControl::new(machine.chains().0.swap_remove(0).control, MS).unwrap()
}

/// Up to 100 mm/s with 1000 mm/s2, then constant; mm in cycle `k`.
fn ramp(k: u32) -> f64 {
    let t = f64::from(k) * 1e-3;
    if t < 0.1 { 500.0 * t * t } else { 5.0 + 100.0 * (t - 0.1) }
}

/// One second of the ramp under G135 (gain 1) or with another gain.
fn drive(settings: &str, gain: f64) -> Vec<ControlOutput> {
    let mut axis = axis(settings);
    (0..1000).map(|k| axis.step(ramp(k), gain, true)).collect()
}

fn last(settings: &str, gain: f64) -> ControlOutput {
    *drive(settings, gain).last().unwrap()
}

/// A working stage of X, and further settings.
fn stage(more: &str) -> String {
    format!(
        "{IPC}.enable=1 {IPC}.v_add_max_fact=100 {IPC}.stage[0].mode=1 {IPC}.stage[0].filter[0].order=1 \
         {IPC}.stage[0].filter[0].fg_f0=53 {IPC}.stage[0].filter[0].q_factor=10 {more}"
    )
}

/// P-AXIS-00395: an axis that is displaced at rest gets no command inside the dead band; at most the window, and not with a loop closed
/// in the drive.
#[test]
fn dead_band_of_the_controller() {
    let ten_um = "X.getriebe[0].pos_control_deadband=100 X.getriebe[0].window=500";
    let command = |settings: &str, offset_mm: f64| {
        let mut axis = axis(settings);
        axis.step(0.0, 0.0, true);
        axis.set_inputs(AxisInputs { encoder_offset_mm: offset_mm, ..AxisInputs::default() });
        axis.step(0.0, 0.0, true).command_mm_s
    };
    // Kv 50/s
    near(command("", 0.005), -0.25, 1e-12);
    near(command(ten_um, 0.005), 0.0, 0.0);
    near(command(ten_um, -0.009), 0.0, 0.0);
    near(command(ten_um, 0.011), -0.55, 1e-12);
    let in_drive = format!("{ten_um} X.kenngr.antr_typ=2");
    near(command(&in_drive, 0.005), -0.25, 1e-12);
    // larger than the window: 110528, and the window becomes the dead band, less than the lag at standstill
    let wide = "X.getriebe[0].pos_control_deadband=1000 X.getriebe[0].window=500";
    assert_eq!(ids(wide), ["110528", "K-0078"]);
    near(command(wide, 0.049), 0.0, 0.0);
    near(command(wide, 0.051), -2.55, 1e-12);
}

/// A drive with a dead time of three cycles beside one without, with a feedforward gain of next to nothing: with a time delay of three
/// cycles in the other axis a diagonal is as straight as with equal axes. Conformance: A066.
#[test]
fn a_time_delay_equalises_dead_times() {
    let gap = |settings: &str| {
        let equal = "X.getriebe[0].kv=10 Y.getriebe[0].kv=10";
        let (machine, _) = machine(&split(&format!("{equal} {settings}")));
        let chains = machine.chains().0;
        let mut axes: Vec<(Shaping, AxisControl)> = chains
            .into_iter()
            .take(2)
            .map(|c| (Shaping::new(c.filters, 0.0), AxisControl::new(c.control, MS).unwrap()))
            .collect();
        let mut worst: f64 = 0.0;
        for k in 0..400 {
            let mut act = [0.0; 2];
            for (act, (shaping, control)) in act.iter_mut().zip(&mut axes) {
                *act = control.step(shaping.step(ramp(k)), 1.0, true).act_mm;
            }
            worst = worst.max((act[0] - act[1]).abs() / std::f64::consts::SQRT_2);
        }
        worst
    };
    let late = "Y.antr.simu.totzeit=3";
    let delay = "X.filter[0].enable=1 X.filter[0].type=TIME_DELAY X.filter[0].order=1 X.filter[0].time_constant=3000";
    assert!(gap("") <= 0.0);
    // three cycles at 100 mm/s, measured across the diagonal
    near(gap(late), 0.3 / std::f64::consts::SQRT_2, 0.03);
    assert!(
        gap(&format!("{late} {delay}")) < 0.25 * gap(late),
        "{}",
        gap(&format!("{late} {delay}"))
    );
}

/// PROFIdrive: conventional feedforward acts at the controller, additive feedforward at the drive. Conformance: F019.
#[test]
fn both_inputs_of_a_profidrive() {
    let out = |names: &str| {
        let input = "X.antr.sercos.mdt[0].nc_ref=S_0_0037";
        let settings = format!("X.kenngr.antr_typ=3 X.vorsteuer.vorsteuerung={names} {input}");
        assert_eq!(ids(&settings), ["K-0079"]);
        last(&settings, 1.0)
    };
    let (conventional, additive) = (out("VEL"), out("ADD_VEL"));
    near(conventional.feedforward.speed_mm_s, 100.0, 1e-6);
    near(conventional.feedforward.additive_speed_mm_s, 0.0, 0.0);
    near(conventional.command_mm_s, 100.0, 1e-3);
    near(additive.feedforward.speed_mm_s, 0.0, 0.0);
    near(additive.feedforward.additive_speed_mm_s, 100.0, 1e-6);
    near(additive.command_mm_s, 0.0, 1e-3);
    // whole counts: half a count of v_reso (1000 * 60 / 36 per mm/s) over Kv
    near(additive.lag_mm, 0.0, 0.5 / (1000.0 * 60.0 / 36.0) / 10.0);
}

/// The position that the controller reads goes in steps of the measuring system: `R = incr_per_rev i / f` of the manual's example, or
/// P-AXIS-00234/00233, or P-AXIS-00422/00423 of a direct one; P-AXIS-00405 drops bits. Conformance: F060.
#[test]
fn steps_of_the_measuring_system() {
    let manual = "X.getriebe[0].incr_per_rev=1048576 X.getriebe[0].gear_fact_num=3 X.antr.feed_const_num=50000";
    for (settings, increments_per_100_nm) in [
        (manual.to_owned(), 62.914_56),
        (format!("{manual} X.antr.encoder_coarsening_factor=10"), 62.914_56 / 1024.0),
        ("X.getriebe[0].wegaufz=1 X.getriebe[0].wegaufn=200".to_owned(), 0.005),
        (
            "X.lr_hw[1].encoder_resolution_num=1 X.lr_hw[1].encoder_resolution_denom=50".to_owned(),
            0.02,
        ),
    ] {
        let step_mm = 1e-4 / increments_per_100_nm;
        let out = drive(&settings, 1.0);
        let mut steps = 0;
        for o in &out {
            let read = if settings.contains("lr_hw") { o.load_mm } else { o.act_mm };
            near((read / step_mm - (read / step_mm).round()).abs(), 0.0, 1e-6);
            steps += u32::from((read - out[0].act_mm).abs() > 0.0);
        }
        assert!(steps > 900, "{settings}: {steps}");
        // with coarse steps every one of them occurs: the smallest distance between two readings is one step
        let mut readings: Vec<f64> = out
            .iter()
            .map(|o| if settings.contains("lr_hw") { o.load_mm } else { o.act_mm })
            .collect();
        readings.sort_by(f64::total_cmp);
        let distances = readings.windows(2).map(|w| w[1] - w[0]).filter(|d| *d > 1e-12);
        if increments_per_100_nm < 0.1 {
            near(distances.fold(f64::INFINITY, f64::min), step_mm, 1e-9);
        }
    }
    // without any entry for the measuring system there are no steps: the result is the same to the last digit as with one so fine that a
    // reading is rounded by less than a picometre
    let fine = drive("X.getriebe[0].wegaufz=1000000000", 1.0);
    for (k, o) in drive("", 1.0).iter().enumerate() {
        near(o.act_mm, fine[k].act_mm, 1e-11);
    }
}
