//! Chains of the axes: the values of the lists arrive in mm and s, and every correction is reported.

mod listings;

use kontur_filters::control::monitor::LagMonitorType;
use kontur_filters::control::plant::ModalConfig;
use kontur_filters::control::scaling::{SpeedFormat, TorqueFormat};
use kontur_filters::control::{AxisControlConfig, Encoder, FeedforwardMode, IpcMode, PlantModel};
use kontur_interpreter::diag::{Diagnostic, Severity};
use kontur_interpreter::machine::{ChainSetup, ListFiles, Machine, Override};

/// The sample machines, with text appended to one of the lists.
#[derive(Default)]
struct Disk(&'static str, String);

impl ListFiles for Disk {
    fn read(&self, path: &str) -> Result<Option<Vec<u8>>, String> {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../programs/machines/");
        let Ok(mut bytes) = std::fs::read(format!("{folder}{path}")) else { return Ok(None) };
        if path == self.0 {
            bytes.extend_from_slice(self.1.as_bytes());
        }
        Ok(Some(bytes))
    }
}

/// A machine with its messages, or those for which it is refused.
type Read = Result<(Machine, Vec<Diagnostic>), Vec<Diagnostic>>;

fn read_with(name: &str, set: &[&str], added: &Disk) -> Read {
    let set: Vec<Override> = set.iter().map(|text| Override::parse(text).unwrap()).collect();
    Machine::load(added, &format!("{name}/hochlauf.lis"), &set)
}

/// Reads a sample machine with settings.
pub(crate) fn read(name: &str, set: &[&str]) -> Read {
    read_with(name, set, &Disk::default())
}

fn load(name: &str, set: &[&str], added: &Disk) -> (Machine, Vec<Diagnostic>) {
    read_with(name, set, added).unwrap()
}

/// A sample machine, and the messages about its lists.
pub(crate) fn sample(name: &str) -> (Machine, Vec<Diagnostic>) {
    load(name, &[], &Disk::default())
}

fn machine(name: &str, set: &[&str]) -> Machine {
    load(name, set, &Disk::default()).0
}

/// Chains of a machine and the messages about them, apart from the note on loops that are closed in the drive.
fn told(machine: &Machine) -> (Vec<ChainSetup>, Vec<Diagnostic>) {
    let (chains, mut diagnostics) = machine.chains();
    diagnostics.retain(|d| d.id.to_string() != "K-0079");
    (chains, diagnostics)
}

/// Chains of a sample machine that gives rise to no message.
fn silent(name: &str, set: &[&str]) -> Vec<ChainSetup> {
    let (chains, diagnostics) = told(&machine(name, set));
    assert_eq!(diagnostics, [], "{name}");
    chains
}

fn near(a: f64, b: f64) {
    assert!((a - b).abs() <= 1e-9 * b.abs().max(1e-9), "{a} is not {b}");
}

fn ids(diagnostics: &[Diagnostic]) -> Vec<String> {
    diagnostics.iter().map(|d| d.id.to_string()).collect()
}

/// Except the speed monitors: 1000 mm/s, 6000 mm/s2, 5 ms, kv 50/s, window 10 um within 0.2 s, drive 5 ms.
fn is_xyz_axis(chain: &ChainSetup) {
    let c = &chain.control;
    near(c.position.kv_per_s, 50.0);
    assert_eq!(c.position.dynamic_kv, None);
    near(c.position.v_max_mm_s, 1000.0);
    near(c.setpoint.a_max_mm_s2, 6000.0);
    near(c.setpoint.j_max_mm_s3, 6000.0 / 0.005);
    near(c.exact_stop.window_mm, 0.01);
    near(c.exact_stop.settling_s.unwrap(), 0.2);
    near(chain.filter_window_mm, 0.4e-4);
    assert_eq!(c.feedforward.mode, FeedforwardMode::VEL);
    near(c.feedforward.global_ratio, 1.0);
    assert_eq!(c.encoder, Encoder::Motor);
    assert_eq!(c.lag.kind, LagMonitorType::Off);
    assert!(!c.ipc.enable && chain.filters.is_empty());
    let PlantModel::FirstOrder { time_constant_s } = c.plant.model else { panic!("PT1") };
    near(time_constant_s, 0.005);
    assert_eq!(c.delay_cycles, 5, "feedforward delays the whole channel");
}

#[test]
fn xyz() {
    let chains = silent("xyz", &[]);
    assert_eq!(chains.len(), 4);
    chains[..3].iter().for_each(is_xyz_axis);
    chains[..3].iter().for_each(|chain| near(chain.control.position.v_excess_ratio, 1.0));
    near(chains[3].control.position.v_max_mm_s, 72_000.0);
    near(chains[3].control.exact_stop.window_mm, 0.5);
    assert_eq!(chains[3].control.delay_cycles, 5);
    // no axis with feedforward: no delay; one axis with it: all of them wait
    let none = ["X", "Y", "Z", "S"].map(|axis| format!("{axis}.vorsteuer.vorsteuerung=NONE"));
    let none: Vec<&str> = none.iter().map(String::as_str).collect();
    assert!(silent("xyz", &none).iter().all(|chain| chain.control.delay_cycles == 0));
    assert!(silent("xyz", &none[1..]).iter().all(|chain| chain.control.delay_cycles == 5));
}

/// Conformance: I048, P020.
#[test]
fn vendor_defaults() {
    for chain in silent("vendor_defaults", &[]) {
        let c = &chain.control;
        let t = &c.setpoint;
        for (is, listed) in [
            (c.position.kv_per_s, 10.0),
            (c.position.v_max_mm_s, 200.0),
            (t.a_max_mm_s2, 1000.0),
            (t.j_max_mm_s3, 1e5),
            (t.velocity.warn_ratio, 0.05),
            (t.velocity.error_ratio, 0.09),
            (t.acceleration.warn_ratio, 0.5),
            (t.acceleration.error_ratio, 1.0),
            (t.jerk.warn_ratio, 0.0),
            (t.jerk.error_ratio, 0.0),
            (c.exact_stop.window_mm, 0.05),
            (c.lag.dynamics, 1000.0),
            (c.lag.lag_max_mm, 10.0),
            (c.lag.lag_min_mm, 2.0),
            (c.feedforward.jerk_ratio, 0.01),
            (c.feedforward.acceleration_quotient, 1.0),
            (c.command_format.counts_per_mm_s(1e-3) * 100.0, 12_000.0),
        ] {
            near(is, listed);
        }
        // -1 leaves the time to P-AXIS-00151
        near(c.exact_stop.settling_s.unwrap(), 1.0);
        assert_eq!(c.position.dynamic_kv, None);
        assert_eq!(c.lag.delay_cycles, 4, "the list names it");
        assert_eq!(c.plant.model, PlantModel::VENDOR_DEFAULT);
        assert_eq!(c.plant.dead_time_cycles, 0);
        assert!(c.feedforward.mode.is_empty());
        assert_eq!((c.delay_cycles, c.feedforward.shift_cycles), (0, 0), "no PROFIdrive");
        assert_eq!(c.command_format, SpeedFormat::Gain(2000.0));
        assert_eq!(c.torque, TorqueFormat::default());
    }
}

/// Conformance: I006.
#[test]
fn rack_and_pinion() {
    let c = &silent("rack_and_pinion", &[])[0].control;
    assert_eq!(c.plant.model, PlantModel::Modal(ModalConfig::rack_and_pinion()));
    let force = c.plant.disturbance.unwrap();
    near(force.amplitude_mm_s2, 56.9);
    near(force.frequency_hz, 53.0);
    near(force.full_speed_mm_s, 272.7);
    assert_eq!(c.encoder, Encoder::Direct);
    near(c.position.kv_per_s, 30.0);
    assert!(c.feedforward.default_active);
    let ipc = &c.ipc;
    assert!(ipc.enable && !ipc.gantry_slave);
    near(ipc.limit_ratio, 0.1);
    assert_eq!(ipc.delay_cycles, 1);
    let modes: Vec<IpcMode> = ipc.stages.iter().map(|s| s.mode).collect();
    assert_eq!(modes, [IpcMode::Direct, IpcMode::Indirect, IpcMode::NotActive]);
    for (i, weight, frequency, quality) in [(0, 2.0, 53.0, 10.0), (1, 0.4, 11.0, 3.0)] {
        let stage = &ipc.stages[i];
        near(stage.weight(), weight);
        assert_eq!((stage.filters.len(), stage.filters[0].order), (1, 1));
        near(stage.filters[0].frequency_hz, frequency);
        near(stage.filters[0].quality, quality);
    }
    near(ipc.stages[1].oscillator_damping, 0.2);
}

#[test]
fn both_spellings_of_a_stage() {
    let stage = "X.lr_param.improved_position_control.stage[1]";
    let set = ["filter[0].fg_f0=12", "osc_damping=0.3", "filter[1].type=ALLPASS"];
    let more = ["filter[1].order=2", "filter[1].fg_f0=13"];
    let set: Vec<String> = set.iter().chain(&more).map(|s| format!("{stage}.{s}")).collect();
    let set: Vec<&str> = set.iter().map(String::as_str).collect();
    let (chains, said) = told(&machine("rack_and_pinion", &set));
    // the list has the older key of the damping
    assert_eq!(ids(&said), ["K-0075"]);
    let stage = &chains[0].control.ipc.stages[1];
    near(stage.filters[0].frequency_hz, 12.0);
    near(stage.oscillator_damping, 0.3);
    assert_eq!((stage.filters.len(), stage.filters[1].order), (2, 2));
}

#[test]
fn spindles_come_after_the_path_axes() {
    let chains = silent("two_spindles", &[]);
    assert_eq!(chains.len(), 5);
    chains[..3].iter().for_each(is_xyz_axis);
    near(chains[3].control.position.v_max_mm_s, 72_000.0);
    near(chains[4].control.position.v_max_mm_s, 36_000.0);
    near(chains[4].control.setpoint.a_max_mm_s2, 40_000.0);
}

/// Conformance: I004, I026.
#[test]
fn a_gantry_slave_is_the_last_chain_and_damps_as_its_master() {
    let chains = silent("gantry", &[]);
    assert_eq!(chains.len(), 4);
    chains.iter().for_each(is_xyz_axis);
    let master = stage_of_x();
    let mut set: Vec<&str> = master.split_whitespace().collect();
    let chains = silent("gantry", &set);
    assert!(chains[0].control.ipc.enable && !chains[1].control.ipc.enable);
    assert_eq!(chains[3].control.ipc, chains[0].control.ipc);
    set.push("X2.lr_param.improved_position_control.enable=1");
    let (_, found) = machine("gantry", &set).chains();
    assert_eq!(ids(&found), ["70600"]);
    assert_eq!(found[0].axis.as_ref().unwrap().name, "X2");
}

fn stage_of_x() -> String {
    let ipc = "X.lr_param.improved_position_control";
    format!(
        "{ipc}.enable=1 {ipc}.v_add_max_fact=100 {ipc}.stage[0].mode=1 {ipc}.stage[0].filter.order=1 \
         {ipc}.stage[0].filter.fg_f0=20 {ipc}.stage[0].filter.q_factor=2"
    )
}

#[test]
fn settings_of_the_controller() {
    let chains = silent(
        "xyz",
        &[
            "X.getriebe[0].slep_ueberw_typ=4",
            "X.getriebe[0].slep_time_const=2000",
            "X.getriebe[0].pos_lag_mon_error_delay_time=3000",
            "X.getriebe[0].position_settling_time=0",
            "X.getriebe[0].dyn_kv.dyn_kv_active=1",
            "X.getriebe[0].dyn_kv.kv1=2000",
            "X.getriebe[0].dyn_kv.kv2=7000",
            "X.getriebe[0].dyn_kv.v1=10000",
            "X.getriebe[0].dyn_kv.v2=110000",
            "X.lr_hw[1].encoder_resolution_num=1",
            "X.antr.simu.totzeit=3",
            "X.vorsteuer.vs_a_faktor=5000",
            "X.vorsteuer.vs_v_faktor=9",
            "X.vorsteuer.vs_v_nenner=10",
            "Y.kenngr.antr_typ=3",
            "Z.kenngr.antr_typ=2",
            "Z.antr.v_time_base=1",
            "kontur.axis[3].plant.model=SIMU",
            "Z.antr.simu.ist_gleich_soll=1",
            "S.getriebe[0].gear_fact_num=3",
            "S.getriebe[0].load=0.01",
        ],
    );
    let x = &chains[0].control;
    assert_eq!(x.lag.kind, LagMonitorType::VelocityIndependent);
    near(x.lag.shift_s, 0.002);
    near(x.lag.tolerance_s, 0.003);
    assert_eq!(x.lag.delay_cycles, 0, "simulated drive");
    assert_eq!(x.exact_stop.settling_s, None);
    near(x.position.gain_at(60.0), 45.0);
    assert_eq!(x.encoder, Encoder::Direct);
    assert_eq!(x.plant.dead_time_cycles, 3);
    near(x.feedforward.acceleration_quotient, 5000.0);
    near(x.feedforward.global_ratio, 0.9);
    // PROFIdrive: three cycles of offset, and the whole channel waits for them
    let y = &chains[1].control;
    assert_eq!((y.feedforward.shift_cycles, y.lag.delay_cycles), (3, 4));
    assert!(chains.iter().all(|chain| chain.control.delay_cycles == 8));
    // 1 count for 36 um in a second
    let z = &chains[2].control;
    near(z.command_format.counts_per_mm_s(1e-3), 1000.0 / 36.0);
    assert_eq!(z.plant.model, PlantModel::Follow);
    // a rotary axis: M = J alpha, the motor turns three times as fast
    near(chains[3].control.torque.torque(180.0), 0.01 * 3.0 * std::f64::consts::PI);
}

#[test]
fn presets_of_the_kernel_slot() {
    let machine = machine(
        "xyz",
        &[
            "X.vib_guard.active=1",
            "X.vib_guard.mode=3",
            "X.vib_guard.freq=21.5",
            "X.vib_guard.damping=0.05",
            "Y.filter_fir.type=2",
            "Y.filter_fir.order=20",
            "Y.filter_fir.quality=0.5",
            "Y.filter_fir.share=80",
            "Z.filter[0].prototype=HSC",
            "Z.filter[0].order=10",
        ],
    );
    let preset = |name: &str| machine.axis(name).unwrap().kernel_preset(machine.cycle);
    let x = preset("X");
    assert!(x.vib_guard.active && x.fir.is_none() && x.hsc.is_none());
    assert_eq!(x.vib_guard.settings.mode, 3);
    near(x.vib_guard.settings.freq_hz, 21.5);
    near(x.vib_guard.settings.damping, 0.05);
    let fir = preset("Y").fir.unwrap();
    assert!(!fir.enable);
    assert_eq!(fir.config.order, 20);
    near(fir.config.quality, 0.5);
    near(fir.config.share_ratio, 0.8);
    assert_eq!(preset("Z").hsc.unwrap().order, 10);
}

#[test]
fn standard_filters_in_their_order() {
    let filter = ["enable=1", "type=BANDSTOP", "order=2", "fg_f0=21.5", "guete=3"];
    let delay = ["enable=1", "type=TIME_DELAY", "order=1", "time_constant=2500"];
    let filter = filter.iter().map(|s| format!("X.filter[0].{s}"));
    let set: Vec<String> = filter.chain(delay.iter().map(|s| format!("X.filter[2].{s}"))).collect();
    let chains = silent("xyz", &set.iter().map(String::as_str).collect::<Vec<_>>());
    let delays: Vec<f64> =
        chains[0].filters.iter().map(kontur_filters::stage::Stage::delay_cycles).collect();
    assert_eq!(delays.len(), 2);
    near(delays[1], 2.5);
}
