//! Improved Position Control from the lists to the additive speed.

use super::*;

/// Of X alone; the limit P-AXIS-00757 is a share of P-AXIS-00212; disabled, the axis is like one without.
/// Conformance: I003, I044, I045, I047.
#[test]
fn limit_and_switch_of_the_additive_speed() {
    let (machine, _) = machine(&split(&stage("")));
    let enabled: Vec<bool> = machine.chains().0.iter().map(|c| c.control.ipc.enable).collect();
    assert_eq!(enabled, [true, false, false, false]);
    // a vibration of the set position to which the stage responds at its limit: 1 % of 500 mm/s
    let swing = |settings: &str| {
        let mut axis = axis(settings);
        let at = |k: u32| 0.5 * libm::sin(std::f64::consts::TAU * 53e-3 * f64::from(k));
        (0..1000).map(|k| axis.step(at(k), 0.0, true)).collect::<Vec<_>>()
    };
    let slow = "X.getriebe[0].dynamik.vb_max=500000 X.getriebe[0].vb_eilgang=500000";
    let limited = swing(&format!("{slow} {}", stage(&format!("{IPC}.v_add_max_fact=10"))));
    let highest = limited.iter().map(|o| o.additive_speed_mm_s.abs()).fold(0.0, f64::max);
    near(highest, 5.0, 0.0);
    let plain = swing(slow);
    let faulty = |out: &[ControlOutput]| out.iter().filter(|o| o.faulty).count();
    assert_eq!(faulty(&limited), faulty(&plain), "nothing is said about the limit");
    let off = swing(&format!("{slow} {}", stage(&format!("{IPC}.enable=0"))));
    assert_eq!(off, plain);
    let none = swing(&format!("{slow} {}", stage(&format!("{IPC}.v_add_max_fact=0"))));
    assert!(none.iter().all(|o| o.additive_speed_mm_s.abs() <= 0.0));
}

/// Additive speed of a bus drive in the format of the drive, and with the sampling interval as time base.
/// Conformance: I022, I023, I050.
#[test]
fn drive_format_of_the_additive_speed() {
    let sercos = "X.kenngr.antr_typ=2 X.antr.v_reso_num=7 X.antr.v_reso_denom=3 \
                  X.antr.sercos.mdt[0].nc_ref=S_0_0037";
    let out = |settings: &str| {
        let mut axis = axis(&stage(settings));
        let at = |k: u32| 0.1 * libm::sin(std::f64::consts::TAU * 53e-3 * f64::from(k));
        let out: Vec<_> = (0..200).map(|k| axis.step(at(k), 0.0, true)).collect();
        assert!(out.iter().any(|o| o.additive_speed_mm_s.abs() > 0.1));
        out
    };
    for o in out(sercos) {
        let um_min = o.additive_speed_mm_s * 1000.0 * 60.0;
        near(o.drive.additive_speed, um_min * 7.0 / 3.0, 1e-9 * um_min.abs());
    }
    // the drive of the CNC's position control: P-AXIS-00129 / 00128 at 1 m/min
    for o in out("X.getriebe[0].multi_gain_z=3000 X.getriebe[0].multi_gain_n=2") {
        let m_min = o.command_mm_s * 0.06;
        near(o.drive.command, m_min * 1500.0, 1e-9 * (m_min * 1500.0).abs());
        near(o.drive.additive_speed, o.additive_speed_mm_s * 0.06 * 1500.0, 1e-9);
    }
    let counts = |cycle_us: u32| {
        let settings = format!("{sercos} X.antr.v_time_base=2 kontur.cycle_time_us={cycle_us}");
        let (machine, _) = machine(&split(&settings));
        let format = machine.chains().0.swap_remove(0).control.command_format;
        format.counts_per_mm_s(machine.cycle.seconds())
    };
    near(counts(2000), 2.0 * counts(1000), 1e-12);
    near(counts(1000), 7.0 / 3.0, 1e-12);
}

/// P-AXIS-00320: a drive that closes the loop itself takes the additive speed through its process data, in their
/// format, or not at all; with the loop in the control it needs no such input. Conformance: I020, I021.
#[test]
fn additive_speed_and_the_place_of_the_loop() {
    let input = "X.antr.sercos.mdt[0].nc_ref=S_0_0037";
    let cnc = "X.antr.operation_mode=CNC_POSITION_CONTROL";
    let swinging = |settings: &str| {
        let mut axis = axis(&stage(settings));
        let at = |k: u32| 0.1 * libm::sin(std::f64::consts::TAU * 53e-3 * f64::from(k));
        let out: Vec<_> = (0..200).map(|k| axis.step(at(k), 0.0, true)).collect();
        out.iter().map(|o| o.additive_speed_mm_s.abs()).fold(0.0, f64::max)
    };
    for drive in [2, 3, 8] {
        let sercos = format!("X.kenngr.antr_typ={drive}");
        let without = format!("{sercos} X.antr.operation_mode=DRIVE_POSITION_CONTROL");
        for settings in [&sercos, &without] {
            assert_eq!(ids(&stage(settings)), ["K-0079", "K-0066"], "{settings}");
            near(swinging(settings), 0.0, 0.0);
        }
        let with_input = format!("{sercos} {input}");
        let in_cnc = format!("{sercos} {cnc}");
        for (settings, told) in [(with_input, &["K-0079"][..]), (in_cnc, &[])] {
            assert_eq!(ids(&stage(&settings)), told, "{settings}");
            assert!(swinging(&settings) > 0.1, "{settings}");
        }
        // without Improved Position Control only the loop itself gives a note
        assert_eq!(ids(&sercos), ["K-0079"]);
    }
    // simulated and analogue drives take speed commands only
    for drive in [1, 4, 6] {
        let settings =
            format!("X.kenngr.antr_typ={drive} X.antr.operation_mode=DRIVE_POSITION_CONTROL");
        assert_eq!(ids(&stage(&settings)), [""; 0], "{settings}");
    }
}
