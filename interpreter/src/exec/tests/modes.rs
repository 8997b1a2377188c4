//! Feed rates, weights, stops, dwells, feedforward, spindles and other commands related to motion.

use super::{Sync, clean, run_on};
use crate::exec::Event;

/// In a block without motion G60 is a stop in place, wherever a dwell is allowed; a full circle moves without axis words.
#[test]
fn exact_stops_without_motion() {
    let tool = "V.G.WZ_AKT.R=1\nG41 X0 Y0 F100\n";
    for (before, after) in [
        ("G00 X1", "G01 F100\nX2"),
        ("G261\nX1 F100", "Y1"),
        ("G360\nX1 F100", "Y1"),
        (&format!("{tool}X9"), "Y9\nX20\nG40 X30"),
        ("X1 F100", "G301 I0.1\nY1\nX3"),
    ] {
        for alone in ["G60", "G60 G92 X0", "G60 S100", "G60 M8"] {
            let dwell = alone.replace("G60", "G04 0\n");
            let [stop, dwell] =
                [alone, &dwell].map(|it| super::run(&format!("{before}\n{it}\n{after}\nM30\n")));
            let without = dwell.ids();
            assert!(stop.ids().iter().filter(|id| *id != "20003").eq(&without), "{before} {alone}");
            assert_eq!(stop.ids().len(), without.len() + 1, "{before} {alone}");
            assert_eq!(stop.syncs(), dwell.syncs(), "{before} {alone}");
        }
    }
}

#[test]
fn weights_refer_to_the_lists() {
    let run = clean(
        "G01 X1 F100\nG131=50 G133 200 X2\nG131 = 50 X3\nG130 Y80\nX4\nG231=25 G233=200 G129=10\nG00 X5\nM30\n",
    );
    let d = |i: usize| run.blocks()[i].dynamics.axes.clone();
    assert_eq!((d(0)[0].feed.acc_mm_s2, d(0)[0].feed.ramps_s[0]), (3500.0, 0.03));
    assert_eq!((d(1)[0].feed.acc_mm_s2, d(1)[0].feed.ramps_s[3]), (1750.0, 0.06));
    assert_eq!(d(2)[0].feed.acc_mm_s2, 1750.0);
    assert_eq!((d(3)[0].feed.acc_mm_s2, d(3)[1].feed.acc_mm_s2), (1750.0, 2800.0));
    assert_eq!(
        (d(4)[0].rapid.acc_mm_s2, d(4)[0].rapid.ramp_s, d(4)[0].v_rapid_mm_s),
        (1000.0, 0.06, 100.0)
    );
    // blocks without a change share one set of limits
    let run = clean("G01 X1 F100\nX2\nM30\n");
    assert!(std::sync::Arc::ptr_eq(&run.blocks()[0].dynamics, &run.blocks()[1].dynamics));
}

#[test]
fn an_acceleration_of_nothing_becomes_the_least_one() {
    // 1 mm/s2 is the lowest value of a list
    let run = super::run("G130 X0\nG01 X1 F100\nG231=0\nG00 X0\nM30\n");
    let axes = |i: usize| run.blocks()[i].dynamics.axes.clone();
    assert_eq!((axes(0)[0].feed.acc_mm_s2, axes(0)[0].feed.dec_mm_s2), (1.0, 1.0));
    assert_eq!(axes(0)[1].feed.acc_mm_s2, 3500.0);
    assert_eq!((axes(1)[0].rapid.acc_mm_s2, axes(1)[1].rapid.acc_mm_s2), (1.0, 1.0));
}

#[test]
fn functions_before_and_after_the_motion() {
    let run = clean("X1 F100 M200=800 H5\nM00\nM1\nT5\nM30\n");
    assert_eq!(
        run.syncs(),
        [&Sync::ProgramStop { optional: false }, &Sync::ProgramStop { optional: true }]
    );
    let super::Step::Motion { events, .. } = &run.steps[0] else { panic!() };
    assert_eq!(
        events[..],
        [
            Event::MFunction { number: 200, value: Some(800.0) },
            Event::Uncounted { function: "M200".to_owned() },
            Event::HFunction { number: 5, value: None },
            Event::Uncounted { function: "H5".to_owned() },
        ]
    );
}

/// P-CHAN-00351: 1800000 mm/min2 are 500 mm/s2, 216000 mm/min3 are 1 mm/s3; JERK and TRANS_ACC are not among its keys. With G70
/// VEL is in inch/min.
#[test]
fn units_of_vector_limits() {
    let text = "F100\nG70\n#VECTOR LIMIT ON [VEL=60 ACC=1800000 DEC=3600 RADIAL_ACC=72000 RADIAL_JERK=216000 \
                JERK=3000 TRANS_ACC=40]\nG71 X1\nM30\n";
    for (unit, t) in [("MM_M2", 60.0), ("MM_S2", 1.0)] {
        let run = run_on(&[&format!("channel.vector.acc_dec_unit={unit}")], text);
        let blocks = run.blocks();
        let v = &blocks[0].dynamics.vector;
        let found = [v.vel_mm_s, v.acc_mm_s2, v.dec_mm_s2, v.radial_acc_mm_s2, v.radial_jerk_mm_s3];
        let per = |x: f64, order: usize| x / [1.0, t, t * t, t * t * t][order];
        let expected = [25.4, per(1800000.0, 2), per(3600.0, 2), per(72000.0, 2), per(216000.0, 3)];
        for (found, expected) in found.into_iter().zip(expected) {
            assert!((found.unwrap() - expected).abs() <= 1e-9 * expected, "{unit}: {v:?}");
        }
        assert_eq!((v.jerk_mm_s3, v.trans_acc_mm_s2), (Some(3000.0), Some(40.0)));
        let doubted: &[&str] = if t > 1.0 { &["K-0139"] } else { &[] };
        assert_eq!(run.ids(), doubted);
    }
}

#[test]
fn contouring_settings_reach_the_blocks() {
    let run = clean(
        "F100\n#CONTOUR MODE [CONST_VEL=1 REMAIN_PART=20 RELEVANT_PATH=0.5]\nG261 X1\nG260\nM30\n",
    );
    let settings = run.blocks()[0].contour.unwrap();
    assert!(settings.constant_velocity);
    super::assert_near(&[settings.remain_ratio, settings.relevant_path_mm], &[0.2, 0.5]);
}
