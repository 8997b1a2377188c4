//! The outputs of an axis are finite for any configuration.

use kontur_filters::control::ipc::{
    IpcConfig, IpcFilterConfig, IpcFilterType, IpcMode, IpcStageConfig,
};
use kontur_filters::control::plant::{ModalConfig, PlantModel, SpeedLoop, TwoMassConfig};
use kontur_filters::control::{
    AxisControl, AxisControlConfig, AxisInputs, ControlOutput, Encoder, Fault, FeedforwardConfig,
    FeedforwardMode, Issue, PositionLoop,
};
use kontur_filters::time::CycleTime;
use proptest::prelude::*;

fn finite(o: &ControlOutput) -> bool {
    [
        o.reference_mm,
        o.act_mm,
        o.load_mm,
        o.lag_mm,
        o.command_mm_s,
        o.additive_speed_mm_s,
        o.feedforward.speed_mm_s,
        o.feedforward.additive_speed_mm_s,
        o.feedforward.additive_acc_mm_s2,
        o.tcp_mm,
        o.tcp_acc_mm_s2,
        o.drive.command,
        o.drive.torque,
    ]
    .iter()
    .all(|v| v.is_finite())
}

fn models() -> impl Strategy<Value = PlantModel> {
    let speed_loop =
        SpeedLoop { gain_per_s: 200.0, integral_time_s: Some(0.03), current_time_s: 0.0005 };
    prop_oneof![
        Just(PlantModel::Follow),
        Just(PlantModel::VENDOR_DEFAULT),
        (1e-4..1.0).prop_map(|time_constant_s| PlantModel::FirstOrder { time_constant_s }),
        (0.1..10.0, 5.0..400.0).prop_map(move |(load_to_motor_ratio, resonance_hz)| {
            PlantModel::TwoMass(TwoMassConfig {
                load_to_motor_ratio,
                resonance_hz,
                damping_ratio: 0.01,
                speed_loop,
            })
        }),
        Just(PlantModel::Modal(ModalConfig::rack_and_pinion())),
    ]
}

/// One stage on the motor speed, its band about 53 Hz.
fn indirect(order: u32, weight: f64) -> IpcConfig {
    let filter =
        IpcFilterConfig { kind: IpcFilterType::BandPass, order, frequency_hz: 53.0, quality: 2.0 };
    let stage = IpcStageConfig {
        mode: IpcMode::Indirect,
        weight_num: weight,
        weight_denom: 1.0,
        filters: vec![filter],
        oscillator_damping: 0.05,
    };
    IpcConfig { enable: true, limit_ratio: 2.0, stages: vec![stage], ..IpcConfig::default() }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, ..ProptestConfig::default() })]

    /// Gains far beyond stability, heavy IPC, jumping set positions; with and without the speed limit.
    #[test]
    fn always_finite(
        model in models(),
        kv in 0.1..5000.0,
        weight in 0.1..20.0,
        bits in 0_u16..0x1000,
        limited: bool,
        direct: bool,
        sets in prop::collection::vec(-1e6..1e6, 20),
    ) {
        let mut config = AxisControlConfig::new(500.0, 1e4, 1e6);
        config.position.kv_per_s = kv;
        config.position.v_excess_ratio = if limited { 1.0 } else { 0.0 };
        config.plant.model = model;
        config.encoder = if direct { Encoder::Direct } else { Encoder::Motor };
        config.feedforward.mode = FeedforwardMode::from_bits_truncate(bits);
        config.additive_inputs.velocity = true;
        config.additive_inputs.torque = true;
        config.ipc = indirect(3, weight);
        let (config, _) = config.checked(CycleTime::DEFAULT);
        let mut axis = AxisControl::new(config, CycleTime::DEFAULT).unwrap();
        for set in sets {
            for _ in 0..100 {
                let out = axis.step(set, 1.0, true);
                prop_assert!(finite(&out), "{out:?}");
            }
        }
    }
}

#[test]
fn divergence_is_reported_once_and_held() {
    let mut config = AxisControlConfig::new(500.0, 1e4, 1e6);
    config.position.kv_per_s = 2500.0;
    config.position.v_excess_ratio = 0.0;
    config.plant.model = PlantModel::FirstOrder { time_constant_s: 0.005 };
    let mut axis = AxisControl::new(config, CycleTime::DEFAULT).unwrap();
    let mut raised = Vec::new();
    let step = |_| {
        let out = axis.step(1.0, 0.0, false);
        raised.extend(axis.faults().iter().copied());
        out
    };
    let out: Vec<_> = (0..5000).map(step).collect();
    assert_eq!(raised.iter().filter(|f| matches!(f, Fault::Unstable { .. })).count(), 1);
    assert!(out.iter().all(finite));
    assert_eq!(out[4998].act_mm, out[4999].act_mm, "held");
}

#[test]
fn not_a_number_stands_still() {
    let mut axis =
        AxisControl::new(AxisControlConfig::new(1e4, 1e9, 1e12), CycleTime::DEFAULT).unwrap();
    axis.start(3.0);
    for set in [f64::NAN, f64::INFINITY, -1e300] {
        let out = axis.step(set, 1.0, true);
        assert_eq!((out.reference_mm, out.act_mm), (3.0, 3.0));
    }
}

/// Reaction class 5: the axis stays where it is, although the set position and its feedforward continue at 100 mm/s.
#[test]
fn halt_keeps_the_axis_where_it_is() {
    let mut config = AxisControlConfig::new(500.0, 1e4, 1e6);
    config.position.kv_per_s = 20.0;
    config.plant.model = PlantModel::FirstOrder { time_constant_s: 0.005 };
    config.feedforward.mode = FeedforwardMode::VEL;
    let mut axis = AxisControl::new(config, CycleTime::DEFAULT).unwrap();
    axis.start(0.0);
    let drive = |axis: &mut AxisControl, from: u32, to: u32| {
        let steps = (from..to).map(|k| axis.step(0.1 * f64::from(k), 1.0, true));
        steps.last().unwrap()
    };
    let before = drive(&mut axis, 1, 500);
    axis.halt();
    let after = drive(&mut axis, 500, 1500);
    assert!((after.reference_mm - before.act_mm).abs() < 0.15, "not farther than a cycle's way");
    assert!((after.act_mm - after.reference_mm).abs() < 1e-6, "the loop stays closed");
    assert_eq!(after.feedforward.speed_mm_s, 0.0);
}

/// With the position loop in the drive, the speed of the IPC needs an additive interface.
#[test]
fn ipc_in_the_drive_needs_an_interface() {
    for (closed_in, velocity, runs) in [
        (PositionLoop::Drive, false, false),
        (PositionLoop::Drive, true, true),
        (PositionLoop::Cnc, false, true),
    ] {
        let mut config = AxisControlConfig::new(500.0, 1e4, 1e6);
        config.position.closed_in = closed_in;
        config.additive_inputs.velocity = velocity;
        config.ipc = indirect(1, 0.5);
        let (config, issues) = config.checked(CycleTime::DEFAULT);
        assert_eq!((config.ipc.enable, issues.contains(&Issue::IpcNoInput)), (runs, !runs));
    }
}

/// After another start an axis repeats itself bit for bit.
#[test]
fn start_forgets_everything() {
    let mut config = AxisControlConfig::new(500.0, 1e4, 1e6);
    config.plant.model = PlantModel::Modal(ModalConfig::rack_and_pinion());
    config.feedforward = FeedforwardConfig {
        mode: FeedforwardMode::VEL | FeedforwardMode::ACC,
        ..FeedforwardConfig::default()
    };
    config.additive_inputs.velocity = true;
    config.ipc = indirect(1, 0.5);
    let mut axis = AxisControl::new(config, CycleTime::DEFAULT).unwrap();
    let mut run = || {
        axis.start(7.0);
        (0..500_u32)
            .map(|k| axis.step(7.0 + 0.01 * f64::from(k % 130), 0.9, true))
            .collect::<Vec<_>>()
    };
    let first = run();
    assert_eq!(first, run());
    assert_eq!(first[0].act_mm, 7.0);
}

#[test]
fn rest_is_bit_exact() {
    let mut config = AxisControlConfig::new(500.0, 1e4, 1e6);
    config.plant.model = PlantModel::Modal(ModalConfig::rack_and_pinion());
    let mut axis = AxisControl::new(config, CycleTime::DEFAULT).unwrap();
    axis.start(123.456_789);
    for _ in 0..1000 {
        let out = axis.step(123.456_789, 1.0, true);
        assert_eq!([out.act_mm, out.load_mm, out.tcp_mm, out.reference_mm], [123.456_789; 4]);
        assert!(!out.faulty);
    }
}

/// A constant force on the load bends the coupling by F/c; whichever encoder closes the loop ends at the reference.
#[test]
fn encoder_of_the_position_loop() {
    let (ratio, resonance_hz, force) = (3.0, 40.0, 500.0);
    let speed_loop =
        SpeedLoop { gain_per_s: 20.0, integral_time_s: Some(0.1), current_time_s: 0.0005 };
    let coupling =
        TwoMassConfig { load_to_motor_ratio: ratio, resonance_hz, damping_ratio: 0.05, speed_loop };
    // c = w2 mu for a whole mass of 1
    let w = std::f64::consts::TAU * resonance_hz;
    let bend_mm = force / (w * w * ratio / ((1.0 + ratio) * (1.0 + ratio)));
    for (encoder, motor_mm, load_mm) in
        [(Encoder::Motor, 1.0, 1.0 + bend_mm), (Encoder::Direct, 1.0 - bend_mm, 1.0)]
    {
        let mut config = AxisControlConfig::new(500.0, 1e4, 1e6);
        config.plant.model = PlantModel::TwoMass(coupling);
        config.encoder = encoder;
        config.position.kv_per_s = 3.0;
        let mut axis = AxisControl::new(config, CycleTime::DEFAULT).unwrap();
        axis.start(1.0);
        axis.set_inputs(AxisInputs { force_mm_s2: force, ..AxisInputs::default() });
        let out = (0..20_000).map(|_| axis.step(1.0, 0.0, false)).last().unwrap();
        assert!((out.act_mm - motor_mm).abs() < 1e-6, "{encoder:?} {} {motor_mm}", out.act_mm);
        assert!((out.load_mm - load_mm).abs() < 1e-6, "{encoder:?} {} {load_mm}", out.load_mm);
        // the following error is that of the encoder that is at the reference
        assert!(out.lag_mm.abs() < 1e-6, "{encoder:?} {}", out.lag_mm);
    }
}

/// The load is at the measured position unless mechanics or encoder increments make a difference.
#[test]
fn what_shows_the_load_twice() {
    let twice = |model: PlantModel, increment_mm: f64| {
        let mut config =
            AxisControlConfig { increment_mm, ..AxisControlConfig::new(500.0, 1e4, 1e6) };
        config.plant.model = model;
        let axis = AxisControl::new(config, CycleTime::DEFAULT).unwrap();
        let at_rest = axis.is_at_rest(0.0);
        (axis.shows_load_twice(), at_rest)
    };
    let rigid = PlantModel::FirstOrder { time_constant_s: 0.005 };
    assert_eq!(twice(rigid.clone(), 0.0), (true, true));
    assert_eq!(twice(rigid, 1e-4), (false, true));
    let speed_loop = SpeedLoop { gain_per_s: 20.0, integral_time_s: None, current_time_s: 0.0005 };
    let spring = TwoMassConfig {
        load_to_motor_ratio: 3.0,
        resonance_hz: 40.0,
        damping_ratio: 0.05,
        speed_loop,
    };
    assert_eq!(twice(PlantModel::TwoMass(spring), 0.0), (false, true));
    // its modes move motor and load alike: only its tool point differs
    assert_eq!(twice(PlantModel::Modal(ModalConfig::rack_and_pinion()), 0.0), (true, true));
}
