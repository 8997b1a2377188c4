//! Feeds, weights, stops, dwells, feedforward, spindles and commands around the motion.

use super::{Sync, clean, run, run_on, said};
use crate::exec::{Event, SpindleMotion};
use kontur_motion::block::{Feed, SlopeKind};

fn feeds(text: &str) -> Vec<Feed> {
    // G137: the program is written for this dialect
    clean(&format!("G137\n{text}\nM30\n")).blocks().iter().map(|b| b.feed).collect()
}

#[test]
fn feed_types() {
    assert_eq!(
        feeds("G01 X1 F600\nX2\nG00 X3"),
        [Feed::PathVelocity(10.0), Feed::PathVelocity(10.0), Feed::Rapid]
    );
    assert_eq!(feeds("G93 F5 G01 X1\nX2"), [Feed::Duration(5.0), Feed::Duration(5.0)]);
    assert_eq!(feeds("M03 S1200 G95 F1.5 X1"), [Feed::PathVelocity(30.0)]);
    assert_eq!(feeds("G194 F50 X1"), [Feed::ShareOfMaximum(0.5)]);
    // each type remembers its F, G93 needs a new one
    assert_eq!(
        feeds("F600 X1\nG93 F2 X2\nG94 X3"),
        [Feed::PathVelocity(10.0), Feed::Duration(2.0), Feed::PathVelocity(10.0)]
    );
    assert_eq!(said("G137 G93 F2 X1\nG93 X2"), ["20008"]);
    // 10 m/s
    assert_eq!(said("G137 G93 F0.001 X10"), ["K-0109"]);
}

#[test]
fn end_feeds() {
    let blocks = clean("G137 G01 X1 F600 E300\nX2 E6000\nX3\nM30\n");
    let ends: Vec<_> = blocks.blocks().iter().map(|b| b.end_velocity_mm_s).collect();
    assert_eq!(ends, [Some(5.0), Some(10.0), None]);
}

/// The words act on the end of the block they are in; G09 in its block only (TF5200 programming manual, last example of
/// G08/G09/G900/G901).
#[test]
fn late_braking() {
    let late = |text: &str| -> Vec<bool> {
        clean(&format!("{text}\nM30\n")).blocks().iter().map(|b| b.late_braking).collect()
    };
    assert_eq!(
        late("G137 G01 G901 X20 F2000\nG09 X40 F1600\nX60 F1200\nG900 X80 F800\nX100 F400"),
        [true, false, true, false, false]
    );
    assert_eq!(
        late("G137 G01 X1 F100\nG09 X2 F50\nG901\nX3 F20\nG09\nX4"),
        [false, false, true, true]
    );
    assert_eq!(run("G137 G900 G901 X1 F100\nM30\n").ids(), ["20977"]);
    // said once
    let hsc = run("G137 G901\n#SLOPE [TYPE=HSC]\nG01 X1 F100\nX2 F50\nX3\nG900 X4\nM30\n");
    assert_eq!(hsc.ids(), ["K-0100"]);
}

#[test]
fn exact_stops() {
    let run = clean("G60 X1 F100\nX2\nG360 X3\nX4\nG359 X5\nM30\n");
    let shape: Vec<_> = run.steps.iter().map(|s| matches!(s, super::Step::Sync { .. })).collect();
    assert_eq!(shape, [false, true, false, false, true, false, true, false, false]);
}

/// In a block that moves nothing G60 is a stop in place, wherever a dwell may be; a full circle moves without axis words.
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
    let circle = clean("X10 F100\nG60 G02 I5\nG01 X20\nM30\n");
    assert_eq!(circle.syncs(), [&Sync::ExactStop { alone: false }]);
    assert!(matches!(circle.steps[2], super::Step::Sync { .. }), "{:?}", circle.steps);
    // both of two contour lines end in a stop
    let lines = clean("G360\n#ANG=30 F100\nX20 Y20 #ANG=60\nG359 X0\nM30\n");
    assert_eq!(lines.syncs(), [&Sync::ExactStop { alone: false }; 2]);
    assert_eq!(super::run("G60 #ANG=30 F100\nX20 Y20 #ANG=60\nM30\n").ids(), ["K-0019"]);
}

#[test]
fn dwells() {
    let seconds = |text: &str| match clean(&format!("{text}\nM30\n")).syncs()[..] {
        [Sync::Dwell { seconds }] => *seconds,
        _ => panic!("no dwell"),
    };
    for text in
        ["G04 X2.5", "G04 2.5", "#TIME 2.5", "P1=2.5\nG04 P1", "P1=2.5\n#TIME P1", "S60\nG04 S2.5"]
    {
        assert!((seconds(text) - 2.5).abs() < 1e-12, "{text}");
    }
    let of = |text: &str| run(&format!("{text}\nM30\n"));
    let two = of("G04 X2 Y3");
    assert_eq!(
        (two.ids(), two.syncs()),
        (vec!["20685".to_owned()], vec![&Sync::Dwell { seconds: 2.0 }])
    );
    assert_eq!(of("G04 5000").ids(), ["20752"]);
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
    // blocks without change share one set of limits
    let run = clean("G01 X1 F100\nX2\nM30\n");
    assert!(std::sync::Arc::ptr_eq(&run.blocks()[0].dynamics, &run.blocks()[1].dynamics));
}

#[test]
fn weights_beyond_the_lists_are_capped() {
    let run = run("G131=200\nG01 X1 F100\nM30\n");
    assert_eq!(run.ids(), ["50130"]);
    assert_eq!(run.blocks()[0].dynamics.axes[0].feed.acc_mm_s2, 6000.0);
    let run = super::run("G133=0\nG01 X1 F100\nM30\n");
    assert_eq!(run.ids(), ["50130"]);
    assert_eq!(run.blocks()[0].dynamics.axes[0].feed.ramps_s, [0.005; 4]);
    assert_eq!(super::run("G131=-5\nM30\n").ids(), ["K-0009"]);
}

#[test]
fn an_acceleration_of_nothing_becomes_the_least_one() {
    // 1 mm/s2 is the least that a list can say
    let run = super::run("G130 X0\nG01 X1 F100\nG231=0\nG00 X0\nM30\n");
    assert_eq!(run.ids(), ["120032", "120034", "50130"]);
    let axes = |i: usize| run.blocks()[i].dynamics.axes.clone();
    assert_eq!((axes(0)[0].feed.acc_mm_s2, axes(0)[0].feed.dec_mm_s2), (1.0, 1.0));
    assert_eq!(axes(0)[1].feed.acc_mm_s2, 3500.0);
    assert_eq!((axes(1)[0].rapid.acc_mm_s2, axes(1)[1].rapid.acc_mm_s2), (1.0, 1.0));
    // 3500 * 0.0003 is above 1
    assert!(super::run("G131=0.03\nG01 X1 F100\nM30\n").ids().is_empty());
    assert_eq!(super::run("S[G130=0]\nM30\n").ids(), ["K-0009"]);
}

#[test]
fn slopes() {
    let kinds = |text: &str| -> Vec<_> {
        clean(&format!("F100\n{text}\nM30\n")).blocks().iter().map(|b| b.slope.kind).collect()
    };
    assert_eq!(
        kinds("X1\n#SLOPE [TYPE=STEP]\nX2\n#SLOPE[TYPE SIN2]\nX3\n#SLOPE DEFAULT\nX4"),
        [SlopeKind::Trapez, SlopeKind::Step, SlopeKind::Sin2, SlopeKind::Trapez]
    );
    assert_eq!(
        kinds("#SET SLOPE PROFIL[3]\nX1\n#SET SLOPE PROFIL\nX2"),
        [SlopeKind::Hsc, SlopeKind::Trapez]
    );
    let run = clean("F100\n#SLOPE [TYPE=HSC NO_OPT=0]\nX1\nM30\n");
    assert!(run.blocks()[0].slope.optimised);
}

#[test]
fn feedforward_weights_survive_switching() {
    let run = clean("F100\nG136 X80\nG137\nG135\nX1\nM30\n");
    let last = run.events().into_iter().rev().find_map(|e| match e {
        Event::Feedforward { on, weight_ratios } => Some((*on, weight_ratios.to_vec())),
        _ => None,
    });
    assert_eq!(last, Some((true, vec![0.8, 1.0, 1.0])));
    // one block; no motion
    let run = clean("G135 G136 X80 Y95\nM30\n");
    assert!(run.blocks().is_empty());
    assert_eq!(said("G136"), ["K-0002"]);
    assert_eq!(said("G136 Q5"), ["20200", "K-0002"]);
    for text in ["S[M3 REV1000.5]", "S[M19 POS45.5 REV10]"] {
        assert_eq!(said(text), [""; 0], "{text}");
    }
}

#[test]
fn spindles_turn() {
    let run = clean("M3 S1000\nS[M4 REV500]\nM19\nS[G135 G136=80]\nM5\nM30\n");
    let motions: Vec<_> = run
        .events()
        .into_iter()
        .filter_map(|e| match e {
            Event::Spindle { motion, .. } => Some(*motion),
            _ => None,
        })
        .collect();
    assert_eq!(motions[0], SpindleMotion::Clockwise { rpm: 1000.0 });
    assert!(motions.contains(&SpindleMotion::CounterClockwise { rpm: 500.0 }));
    assert_eq!(motions.last(), Some(&SpindleMotion::Stop));
    assert!(run.events().iter().any(|e| matches!(e, Event::SpindleFeedforward { on: true, weight_ratio, .. } if (weight_ratio - 0.8).abs() < 1e-12)));
}

#[test]
fn functions_before_and_behind_the_motion() {
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

#[test]
fn overrides() {
    let run = clean(
        "F100\n#OVERRIDE [FEED_FACT=50 RAPID_FACT=20]\nX1\nG00 X2\nX[OVERRIDE FEED_FACT=50]\nG01 X3\nY1\nG166 X4\nM30\n",
    );
    let ratios: Vec<_> = run.blocks().iter().map(|b| b.feed_ratio).collect();
    assert_eq!(ratios, [0.5, 0.2, 0.25, 0.5, 1.0]);
}

/// P-CHAN-00001 = 1: the weights act on the acceleration alone, from the start of the program on, until `#SLOPE`.
#[test]
fn selective_weights_from_the_start() {
    let text = "G131=50\nG01 X1 F100\n#SLOPE [TYPE=TRAPEZ]\nX2\nM30\n";
    let run = run_on(&["channel.prog_start.slope.acceleration=1"], text);
    let limits = |i: usize| {
        let feed = run.blocks()[i].dynamics.axes[0].feed;
        (feed.acc_mm_s2, feed.dec_mm_s2)
    };
    assert_eq!((limits(0), limits(1)), ((1750.0, 3500.0), (1750.0, 1750.0)));
}

#[test]
fn vector_limits() {
    let run = clean(
        "F100\n#VECTOR LIMIT ON [VEL=12000 ACC=1800000]\nX1\n#VECTOR LIMIT OFF [VEL]\nX2\n#VECTOR LIMIT OFF\nX3\nM30\n",
    );
    let limits: Vec<_> = run
        .blocks()
        .iter()
        .map(|b| (b.dynamics.vector.vel_mm_s, b.dynamics.vector.acc_mm_s2))
        .collect();
    assert_eq!(limits, [(Some(200.0), Some(500.0)), (None, Some(500.0)), (None, None)]);
}

/// P-CHAN-00351: 1800000 mm/min2 are 500 mm/s2, 216000 mm/min3 are 1 mm/s3; JERK and TRANS_ACC are not among its keys. G70
/// turns VEL into inch/min.
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
fn vector_limits_of_feed_or_rapid_blocks_alone() {
    let run = clean(
        "F100\n#VECTOR LIMIT ON [VEL=600 FEED]\n#VECTOR LIMIT ON [VEL=1200 ACC=180000 RAPID]\nX1\nG00 X2\n#VECTOR LIMIT OFF [VEL RAPID]\nX3\n#VECTOR LIMIT OFF [FEED]\nG01 X4\n#VECTOR LIMIT ON [VEL=60 FEED RAPID]\nX5\nG00 X6\nM30\n",
    );
    let limits: Vec<_> = run
        .blocks()
        .iter()
        .map(|b| (b.dynamics.vector.vel_mm_s, b.dynamics.vector.acc_mm_s2))
        .collect();
    let expected = [
        (Some(10.0), None),
        (Some(20.0), Some(50.0)),
        (None, Some(50.0)),
        (None, None),
        (Some(1.0), None),
        (Some(1.0), Some(50.0)),
    ];
    assert_eq!(limits, expected);
}

#[test]
fn software_limits_of_the_program() {
    let run = run("G98 X-5 Y-3\nG99 X5\nX5 Y-3 F100\nY-4\nM30\n");
    assert_eq!(super::places(&run.diagnostics), ["21897 4:1"]);
    let run = super::run("G99 X5\n#MSG [\"%f %f\", V.A.+SWE.X, V.A.+SWE_MDS.X]\nX6 F100\nM30\n");
    assert_eq!(run.messages(), ["5.000000 500.000000"]);
    assert_eq!(run.ids(), ["21897"]);
    assert_eq!(super::run("G98\nM30\n").ids(), ["20003"]);
}

#[test]
fn messages_to_the_diagnosis_receiver() {
    let with = |value: &str| {
        let text = "#MSG [\"a\"]\n#MSG PLC [\"b\"]\nM30\n";
        let setting = format!("channel.configuration.decoder.msg_to_default={value}");
        run_on(&[&setting], text)
    };
    assert_eq!(with("STANDARD").messages(), ["a", "b"]);
    let run = with("DISABLED");
    assert_eq!((run.messages(), run.diagnostics.len()), (vec!["b"], 0));
    let run = with("WARNING");
    assert_eq!((run.messages(), run.ids()), (vec!["b"], vec!["22194".to_owned()]));
    assert!(!run.diagnostics[0].is_error());
    assert_eq!(with("ERROR").ids(), ["22195"]);
}

#[test]
fn flushes_and_waits() {
    let run = clean(
        "F100\nX1\n#FLUSH\n#FLUSH CONTINUE\n#FLUSH WAIT\n#CHANNEL INIT [CMDPOS]\n#WAIT FOR 1\nM30\n",
    );
    assert_eq!(run.syncs(), [&Sync::Stop, &Sync::FlushWait, &Sync::FlushWait, &Sync::FlushWait]);
}

#[test]
fn messages_and_errors_of_the_program() {
    let run = clean(
        "P1=2\n#MSG [\"run %d, F = %f, %s\", P1, 1.5, \"x\"]\n#MSG SAVE EXCLUSIVE [\"saved\"]\nM30\n",
    );
    assert_eq!(run.messages(), ["run 2, F = 1.500000, x", "saved"]);
    assert_eq!(said("#ERROR [ID455 RC2 PV1=5]"), ["455"]);
}

#[test]
fn machine_data() {
    let run = clean(
        "F100\nX1\n#MACHINE DATA [AX=X AXPARAM=\"getriebe[0].slope_profil.a_beschl 1000\"]\nX2\nM30\n",
    );
    assert_eq!(run.blocks()[1].dynamics.axes[0].feed.acc_mm_s2, 1000.0);
    assert!(matches!(run.syncs()[..], [Sync::MachineData { axis: 1, .. }]));
}

#[test]
fn chamfers_and_roundings() {
    let ends = |text: &str| clean(&format!("F100\n{text}\nM30\n")).ends();
    assert_eq!(ends("X10\nG301 I2\nY10"), [[8.0, 0.0, 0.0], [10.0, 2.0, 0.0], [10.0, 10.0, 0.0]]);
    let round = ends("X10\nG302 I2\nY10");
    super::assert_near(&round[0], &[8.0, 0.0, 0.0]);
    super::assert_near(&round[1], &[10.0, 2.0, 0.0]);
    // the size is kept; #CHF is the length of the chamfer
    assert_eq!(ends("X10\nG301 I2\nY10\nG301\nX20").len(), 5);
    let chf = ends("X10\n#CHF=2\nY10");
    super::assert_near(&chf[0], &[10.0 - 2.0_f64.sqrt(), 0.0, 0.0]);
    assert_eq!(ends("X10\nG302 I2\nX20").len(), 2);
    let id = |text: &str| said(&format!("F100\n{text}"));
    assert_eq!(id("X10\nG301 I20\nY10"), ["K-0009"]);
    // a rounding between a line and an arc touches both
    let run = clean("F100\nX10\nG302 I1\nG03 X20 Y10 I0 J10\nM30\n");
    assert_eq!(run.blocks().len(), 2);
}

#[test]
fn contouring_settings_reach_the_blocks() {
    use kontur_motion::block::ContourMode;
    let modes = |text: &str| -> Vec<_> {
        let run = clean(&format!("G137 F100\n{text}\n#CONTOUR MODE OFF\nM30\n"));
        run.blocks().iter().map(|b| b.contour.map(|c| c.mode)).collect()
    };
    let dev = |path_dev_mm| Some(ContourMode::Dev { path_dev_mm });
    assert_eq!(modes("X1\nG61 X2\nX3"), [None, dev(1.0), None]);
    assert_eq!(modes("#CONTOUR MODE ON [DEV PATH_DEV=0.08]\nX1\nG260\nX2"), [dev(0.08), None]);
    // neither ON nor OFF: parameters only
    assert_eq!(modes("#CONTOUR MODE [DEV, PATH_DEV=5]\nX1\nG261\nX2"), [None, dev(5.0)]);
    let dist = Some(ContourMode::Dist { pre_mm: 2.0, post_mm: 1.0 });
    assert_eq!(modes("#CONTOUR MODE ON [DIST PRE_DIST 2]\nX1"), [dist]);
    // an exact stop has nothing to round
    assert_eq!(modes("G261\nG60 X1\nX2"), [None, dev(1.0)]);
    let run = clean(
        "F100\n#CONTOUR MODE [CONST_VEL=1 REMAIN_PART=20 RELEVANT_PATH=0.5]\nG261 X1\nG260\nM30\n",
    );
    let settings = run.blocks()[0].contour.unwrap();
    assert!(settings.constant_velocity);
    super::assert_near(&[settings.remain_ratio, settings.relevant_path_mm], &[0.2, 0.5]);
    assert_eq!(said("#CONTOUR MODE ON"), ["120206"]);
    assert_eq!(said("#CONTOUR MODE [AUTO_VEL]"), ["K-0019"]);
}

#[test]
fn splines_through_short_blocks() {
    let run = clean(
        "F100\n#HSC [BSPLINE PATH_DEV 0.2 TRACK_DEV 0.2 MAX_ANGLE 179]\nX1\n#HSC ON\nX2\n#HSC OFF\nX3\nM30\n",
    );
    let splines: Vec<_> = run.blocks().iter().map(|b| b.spline.map(|s| s.path_dev_mm)).collect();
    assert_eq!(splines, [None, Some(0.2), None]);
    let run = clean("F100\n#HSC ON [OPMODE=1 CONTERROR=0.05]\nX1\n#HSC OFF\nX2\nM30\n");
    assert!(run.blocks()[0].contour.is_some() && run.blocks()[1].contour.is_none());
}

/// The vendor's programs: TF5200 programming manual, user-specific functions of spindles; diagnosis 20765, 20766.
#[test]
fn functions_of_axes_and_spindles() {
    let called = |run: &super::Run| -> Vec<String> {
        run.events()
            .into_iter()
            .filter_map(|e| match e {
                Event::MFunction { number, .. } => Some(format!("M{number}")),
                Event::HFunction { number, .. } => Some(format!("H{number}")),
                _ => None,
            })
            .collect()
    };
    let run = super::run("N10 S[M3 REV300 M10 M11]\nM5\nM30\n");
    assert_eq!((run.ids(), called(&run)), (vec![], vec!["M10".to_owned(), "M11".to_owned()]));
    assert_eq!(run.events().iter().filter(|e| format!("{e:?}").contains("rpm: 300.0")).count(), 1);
    let run = super::run("N10 G00 X10 M10 X[M10] S[M10] Y[H5 M12]\nM30\n");
    let wanted = ["M10", "M10", "M10", "H5", "M12"].map(str::to_owned).to_vec();
    assert_eq!((run.ids(), called(&run), run.end[0]), (vec![], wanted, 10.0));
    for (text, id) in [("S[M30]", "21867"), ("X[M30]", "K-0019")] {
        assert_eq!(said(text), [id], "{text}");
    }
}

/// Signals to all stay, those to the own channel are used up, values go with them; what nobody sends is not waited for.
#[test]
fn signals_of_the_own_channel() {
    let served = clean(
        "#SIGNAL [ID=4711 P[0]=10.5 P[3]=1+1]\n#WAIT [ID=4711 P[0]=V.P.A P[3]=P8]\n#WAIT [ID4711 P[0]=P9]\n\
         #SIGNAL [ID=5 COUNT=2 CH=1]\n#WAIT SYN [ID=5 CH=1]\n#WAIT [ID=5 CH1 AHEAD]\n\
         #SIGNAL [ID=6 CH=2]\nG01 X[V.P.A] Y[P8] Z[P9] F100\nM30\n",
    );
    assert_eq!(served.end[..3], [10.5, 2.0, 10.5]);
    for (text, id) in [
        ("#SIGNAL [ID=1 CH=1]\n#WAIT [ID=1 CH=1]\n#WAIT [ID=1 CH=1]", "K-0018"),
        ("#SIGNAL [ID=1]\n#SIGNAL REMOVE [ID=1]\n#WAIT [ID=1]", "K-0018"),
        ("#SIGNAL [ID=1 CH=1]\n#WAIT [ID=1]", "K-0018"),
        ("#WAIT [ID=1 CH=2]", "K-0018"),
        ("#SIGNAL [ID=1 P[12]=1]", "21220"),
        ("#SIGNAL [CH=1]", "21220"),
        ("$FOR P1=1,2000,1\n#SIGNAL [ID=P1]\n$ENDFOR", "K-0009"),
    ] {
        let run = run(&format!("{text}\nM30\n"));
        assert_eq!(run.ids().first().map(String::as_str), Some(id), "{text}");
    }
}

/// `#CHANNEL INIT [ACTPOS AX=X AX=Y]`, F of independent axes, V.G.WZR.
#[test]
fn older_spellings() {
    clean("X10 F1000\n#CHANNEL INIT [ACTPOS AX=X AX=Y]\n#CHANNEL INIT [CMDPOS AX=X]\nM30\n");
    assert_eq!(super::run("#CHANNEL INIT [ACTPOS AX=Q]\nM30\n").ids(), ["20797"]);
    clean("X10 F1000\n#CHANNEL INIT [ACTPOS AXNR=1 AXNR=2]\nM30\n");
    assert_eq!(super::run("#CHANNEL INIT [ACTPOS AXNR=77]\nM30\n").ids(), ["20797"]);
    let run = clean("Z[INDP_ASYN G01 G90 POS20 F0.5 SLOPE_PROFIL 0]\n#WAIT INDP [Z]\nM30\n");
    assert_eq!(run.end[2], 20.0);
    let run = clean("V.G.WZR=5\nG01 X[V.G.WZ_AKT.R] Y[V.G.WZR] F100\nM30\n");
    assert_eq!(run.end[..2], [5.0, 5.0]);
    assert_eq!(super::run("V.G.WZR=5 D1\nM30\n").ids()[0], "20738");
}

/// The manual's numbers for ORD (operations for character strings, 206023179).
#[test]
fn the_value_of_a_character() {
    let run = clean(
        "P1=ORD[\"Hello world!\", 1]\nP2=ORD[\"Hello world!\", 7]\nP3=ORD[\"Hello\"]\nG01 X[P1] Y[P2] Z[P3] F100\nM30\n",
    );
    assert_eq!(run.end[..3], [72.0, 119.0, 72.0]);
    assert_eq!(super::run("P1=ORD[\"abc\", 4]\nM30\n").ids(), ["K-0009"]);
    assert_eq!(super::run("P1=ORD[\"\"]\nM30\n").ids(), ["K-0009"]);
}

/// A limit is expected: a command that switches none on would look as if the limits of the list acted.
#[test]
fn a_vector_limit_needs_a_limit() {
    for command in ["#VECTOR LIMIT ON", "#VECTOR LIMIT ON [FEED]"] {
        assert_eq!(run(&format!("{command}\nG01 X1 F100\nM30\n")).ids(), ["21220"], "{command}");
    }
}

/// The number of oscillations begins with 1, and the message says where it ends.
#[test]
fn a_number_of_oscillations() {
    let text = "X[OSC ON 1ST_POS=-10 2ND_POS=10 FREQ=1 NBR_OSC=0]\nM30\n";
    let said = super::shown(&run(text).diagnostics);
    assert_eq!(said, ["21237 NBR_OSC=0, allowed are the whole numbers 1 to 4294967295"]);
}
