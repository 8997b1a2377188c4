//! A cycle does not allocate: the machine's cycles must not wait for an allocator, and long runs must not grow.
//!
//! The counter replaces the allocator of this test binary.

#![expect(clippy::unwrap_used, reason = "helpers of tests")]

use allocation_counter::measure;
use kontur_filters::control::ipc::{
    IpcConfig, IpcFilterConfig, IpcFilterType, IpcMode, IpcStageConfig,
};
use kontur_filters::control::monitor::{ExactStopConfig, LagMonitorConfig, LagMonitorType};
use kontur_filters::control::plant::{ModalConfig, SpeedLoop, TwoMassConfig};
use kontur_filters::control::{
    AxisControl, AxisControlConfig, AxisInputs, Encoder, FeedforwardConfig, FeedforwardMode,
    PlantModel,
};
use kontur_filters::fir::{FirConfig, FirKind};
use kontur_filters::hsc::{HscConfig, HscKind};
use kontur_filters::iir::prototype::Prototype;
use kontur_filters::iir::{AxisFilter, FilterConfig, FilterKind};
use kontur_filters::kernel::Kernel;
use kontur_filters::shaping::Shaping;
use kontur_filters::stage::Stage;
use kontur_filters::time::CycleTime;
use kontur_filters::vib_guard::VibGuardSettings;
use std::sync::Arc;

const MS: CycleTime = CycleTime::DEFAULT;
const CYCLES: u32 = 2000;

/// Back and forth with stops, up to 100 mm/s.
fn set_mm(k: u32) -> f64 {
    let t = f64::from(k % 500) * 1e-3;
    if t < 0.4 { 12.0 * (1.0 - libm::cos(std::f64::consts::TAU * t / 0.4)) } else { 0.0 }
}

#[test]
fn the_counter_counts() {
    let info = measure(|| drop(std::hint::black_box(vec![1_u8; 100])));
    assert_eq!((info.count_total, info.bytes_total), (1, 100));
}

fn standard_filters() -> Vec<AxisFilter> {
    let config = |kind, prototype| FilterConfig {
        kind,
        prototype,
        order: 3,
        share_ratio: 0.37,
        time_constant_us: if kind == FilterKind::TimeDelay { 2300 } else { 10_000 },
        ..FilterConfig::default()
    };
    let all = FilterKind::ALL.into_iter().flat_map(|kind| Prototype::ALL.map(|p| config(kind, p)));
    all.map(|config| AxisFilter::design(&config, MS).0.unwrap()).collect()
}

fn kernels() -> Vec<Kernel> {
    let guard = |mode| VibGuardSettings { mode, freq_hz: 5.0, damping: 0.1 }.kernel(MS).unwrap();
    let fir = |kind| {
        let config = FirConfig { order: 100, share_ratio: 0.37, ..FirConfig::new(kind) };
        config.design(MS).0.unwrap()
    };
    let hsc = |kind| {
        let config =
            HscConfig { kind, order: 0, time_constant_us: 20_000, f_hz: 30.0, share_ratio: 1.0 };
        config.design(MS).0.unwrap()
    };
    let fir_kinds =
        [FirKind::MovingAverage, FirKind::Gauss, FirKind::WindowedSinc, FirKind::TimeDelay];
    let mut all: Vec<Kernel> = (1..=4).map(guard).collect();
    all.extend(fir_kinds.map(fir));
    all.extend([HscKind::Mean, HscKind::NoVib].map(hsc));
    all
}

/// Every kernel followed by every three of the standard filters.
#[test]
fn no_allocation_in_the_shaping_chain() {
    let filters = standard_filters();
    for kernel in kernels() {
        let kernel = Arc::new(kernel);
        for three in filters.chunks(3) {
            let mut shaping = Shaping::new(three.to_vec(), 0.0);
            shaping.set_kernel(Some(Arc::clone(&kernel))).unwrap();
            let info = measure(|| {
                for k in 0..CYCLES {
                    std::hint::black_box(shaping.step(set_mm(k)));
                    std::hint::black_box((shaping.settled(1e-4), shaping.ready_for(None)));
                }
            });
            assert_eq!(info.count_total, 0, "{:?}", shaping.kernel());
        }
    }
}

fn improved(mode: IpcMode) -> IpcConfig {
    let kinds = [IpcFilterType::BandPass, IpcFilterType::AllPass];
    let filters =
        kinds.map(|kind| IpcFilterConfig { kind, order: 2, frequency_hz: 53.0, quality: 3.0 });
    let stage = |frequency_hz: f64| IpcStageConfig {
        mode,
        weight_num: 0.2,
        weight_denom: 1.0,
        filters: filters.map(|f| IpcFilterConfig { frequency_hz, ..f }).to_vec(),
        oscillator_damping: 0.1,
    };
    IpcConfig {
        enable: true,
        limit_ratio: 0.5,
        stages: [11.0, 53.0, 120.0].map(stage).to_vec(),
        ..IpcConfig::default()
    }
}

/// Every plant with every mode of Improved Position Control, all of feedforward and all monitors.
#[test]
fn no_allocation_in_the_control_chain() {
    let speed_loop =
        SpeedLoop { gain_per_s: 200.0, integral_time_s: Some(0.03), current_time_s: 0.0005 };
    let two_mass = TwoMassConfig {
        load_to_motor_ratio: 3.0,
        resonance_hz: 40.0,
        damping_ratio: 0.05,
        speed_loop,
    };
    let plants = [
        PlantModel::Follow,
        PlantModel::VENDOR_DEFAULT,
        PlantModel::FirstOrder { time_constant_s: 0.005 },
        PlantModel::TwoMass(two_mass),
        PlantModel::Modal(ModalConfig::rack_and_pinion()),
    ];
    let additive = FeedforwardMode::ADD_VEL | FeedforwardMode::ADD_ACC | FeedforwardMode::ADD_JERK;
    let conventional = FeedforwardMode::VEL | FeedforwardMode::ACC | FeedforwardMode::JERK;
    let monitors =
        [LagMonitorType::Standard, LagMonitorType::Linear, LagMonitorType::VelocityIndependent];
    let modes = [IpcMode::Direct, IpcMode::Indirect, IpcMode::SetPoint];
    for plant in plants {
        for ((mode, kind), feedforward) in
            modes.into_iter().zip(monitors).zip([additive, conventional, FeedforwardMode::VEL])
        {
            let mut config = AxisControlConfig::new(500.0, 1e4, 1e6);
            config.plant.model = plant.clone();
            config.encoder = if mode == IpcMode::Direct { Encoder::Direct } else { Encoder::Motor };
            config.feedforward = FeedforwardConfig {
                mode: feedforward,
                velocity_delay_s: 0.0015,
                acceleration_delay_s: 0.0025,
                ..FeedforwardConfig::default()
            };
            config.additive_inputs.velocity = true;
            config.additive_inputs.torque = true;
            config.ipc = improved(mode);
            config.lag = LagMonitorConfig { kind, lag_max_mm: 0.1, ..config.lag };
            config.exact_stop = ExactStopConfig { window_mm: 0.001, ..config.exact_stop };
            let (config, _) = config.checked(MS);
            let mut axis = AxisControl::new(config, MS).unwrap();
            axis.start(0.0);
            let info = measure(|| {
                for k in 0..CYCLES {
                    if k % 500 == 400 {
                        axis.expect_stop(0.0);
                    }
                    let force_mm_s2 = if k % 100 < 50 { 300.0 } else { 0.0 };
                    axis.set_inputs(AxisInputs { force_mm_s2, ..AxisInputs::default() });
                    let out = axis.step(set_mm(k), 0.9, true);
                    std::hint::black_box((out, axis.distance_mm()));
                    std::hint::black_box(axis.faults().iter().count());
                }
            });
            assert_eq!(info.count_total, 0, "{plant:?} {mode:?}");
        }
    }
}
