//! Feedforward from the lists to the speed command.

use super::*;

/// Additive variant: nothing at the controller, both parts after the global weight. Conformance: F015, F016.
#[test]
fn additive_feedforward() {
    let inputs = "kontur.axis[1].additive.velocity=1 kontur.axis[1].additive.torque=1";
    let settings = |more: &str| format!("X.vorsteuer.vorsteuerung=0x303 {inputs} {more}");
    let whole = drive(&settings(""), 1.0);
    let half = drive(&settings("X.vorsteuer.vs_v_nenner=2"), 1.0);
    for (whole, half) in whole.iter().zip(&half) {
        let (whole, half) = (whole.feedforward, half.feedforward);
        assert_eq!(whole.speed_mm_s.to_bits(), 0);
        near(half.additive_speed_mm_s, 0.5 * whole.additive_speed_mm_s, 1e-9);
        near(half.additive_acc_mm_s2, 0.5 * whole.additive_acc_mm_s2, 1e-9);
    }
    near(whole[999].feedforward.additive_speed_mm_s, 100.0, 1e-6);
    near(whole[50].feedforward.additive_acc_mm_s2, 1000.0, 1e-6);
}

/// Feedforward delays the position path by five cycles, whether it is used or not. Conformance: F043.
#[test]
fn the_buffer_of_feedforward() {
    for gain in [0.0, 1.0] {
        let (with, without) = (
            drive("X.vorsteuer.vorsteuerung=VEL", gain),
            drive(
                "X.vorsteuer.vorsteuerung=NONE Y.vorsteuer.vorsteuerung=NONE \
                 Z.vorsteuer.vorsteuerung=NONE S.vorsteuer.vorsteuerung=NONE",
                gain,
            ),
        );
        for k in 5..1000 {
            assert_eq!(with[k].reference_mm.to_bits(), without[k - 5].reference_mm.to_bits());
        }
    }
}

/// PROFIdrive takes the feedforward before its setpoint is formed (P-AXIS-00165). Conformance: F018, F070.
#[test]
fn shift_of_profidrive() {
    let begins = |settings: &str| {
        let out = drive(settings, 1.0);
        let fed = out.iter().position(|o| o.feedforward.speed_mm_s > 50.0).unwrap();
        let moved = out.iter().position(|o| o.reference_mm > ramp(50)).unwrap();
        moved - fed
    };
    let profidrive = |shift: u32| format!("X.kenngr.antr_typ=3 X.vorsteuer.shift_time={shift}");
    let of_0 = begins(&profidrive(0));
    assert_eq!(begins(&profidrive(2)), of_0 + 2);
    assert_eq!(begins("X.kenngr.antr_typ=3"), of_0 + 3, "the default");
    assert_eq!(begins("X.vorsteuer.shift_time=2"), of_0, "no PROFIdrive");
    assert_eq!(ids(&profidrive(5)), ["K-0070", "K-0079"]);
}

/// Scalings out of range leave no torque (110465, K-0062), or one that is finite. Conformance: F079, F080, F086.
#[test]
fn torque_without_a_scaling() {
    let torque = "X.vorsteuer.vorsteuerung=ADD_ACC kontur.axis[1].additive.torque=1";
    for (key, is_output) in
        [("torque_scale_denom", false), ("torque_scale_num", true), ("acc_reference_value", false)]
    {
        let used = drive(&format!("{torque} X.antr.{key}=0"), 1.0)[50].drive;
        assert!(used.torque.is_finite() && used.torque_n_m.is_finite(), "{key}");
        assert_eq!(used.torque != 0.0, is_output, "{key}");
    }
}
