//! Chains of the axes: the values that the lists state arrive in mm and s, and every correction is reported.

#![expect(clippy::unwrap_used, clippy::panic, reason = "helpers of tests")]

mod advice;

use kontur_filters::control::monitor::LagMonitorType;
use kontur_filters::control::plant::ModalConfig;
use kontur_filters::control::scaling::{SpeedFormat, TorqueFormat};
use kontur_filters::control::{AxisControlConfig, Encoder, FeedforwardMode, IpcMode, PlantModel};
use kontur_interpreter::diag::{Diagnostic, Severity};
use kontur_interpreter::machine::{ChainSetup, ListFiles, Machine, Override};

/// The sample machines, with text added to one list.
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

fn load(name: &str, set: &[&str], added: &Disk) -> (Machine, Vec<Diagnostic>) {
    let set: Vec<Override> = set.iter().map(|text| Override::parse(text).unwrap()).collect();
    Machine::load(added, &format!("{name}/hochlauf.lis"), &set).unwrap()
}

fn machine(name: &str, set: &[&str]) -> Machine {
    load(name, set, &Disk("", String::new())).0
}

/// Chains of a machine and what is said about them, apart from the note on loops that are closed in the drive.
fn told(machine: &Machine) -> (Vec<ChainSetup>, Vec<Diagnostic>) {
    let (chains, mut diagnostics) = machine.chains();
    diagnostics.retain(|d| d.id.to_string() != "K-0079");
    (chains, diagnostics)
}

/// Chains of a sample machine that has nothing to say about itself.
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

/// 1000 mm/s, 6000 mm/s2, 5 ms, kv 50/s, window 10 um within 0.2 s, drive 5 ms.
fn is_xyz_axis(chain: &ChainSetup) {
    let c = &chain.control;
    near(c.position.kv_per_s, 50.0);
    assert_eq!(c.position.dynamic_kv, None);
    near(c.position.v_max_mm_s, 1000.0);
    near(c.position.v_excess_ratio, 1.0);
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
    near(chains[3].control.position.v_max_mm_s, 72_000.0);
    near(chains[3].control.exact_stop.window_mm, 0.5);
    assert_eq!(chains[3].control.delay_cycles, 5);
    // no axis with feedforward: no delay; one of them: all wait
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
    let stage = &silent("rack_and_pinion", &set)[0].control.ipc.stages[1];
    near(stage.filters[0].frequency_hz, 12.0);
    near(stage.oscillator_damping, 0.3);
    assert_eq!((stage.filters.len(), stage.filters[1].order), (2, 2));
}

#[test]
fn spindles_stand_behind_the_path_axes() {
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

/// The axis X of `xyz` on a SERCOS drive with lines of the feedforward manual in its list.
fn with_listing(listing: &str) -> (AxisControlConfig, Vec<Diagnostic>, Vec<Diagnostic>) {
    let added = Disk("xyz/x.lis", format!("\nkenngr.antr_typ 2\n{listing}"));
    let (machine, loading) = load("xyz", &[], &added);
    let (chains, found) = told(&machine);
    (chains[0].control.clone(), loading, found)
}

const VELOCITY_INPUT: &str = "antr.sercos.at[0].ident_nr 37\nantr.sercos.mdt[0].ident_len 4\n\
                              antr.sercos.mdt[0].nc_ref S_0_0037\n";

/// TF5200 feedforward control 4.1: 10 mm per revolution, drive unit 1e-4 rpm; without and with a gear of 3.
/// Conformance: F049, F050, F051, F052, F053, F056.
#[test]
fn velocity_listing_of_the_manual() {
    let listing = |path| {
        format!(
            "vorsteuer.vorsteuerung 0x101 #0x001: Activation velocity feedforward\n\
             vorsteuer.velocity_delay_time 150 # Delay velocity feedforward\n\
             antr.v_time_base 0 #Timebase per minute\nantr.v_reso_num 10000 #Output value to drive\n\
             antr.v_reso_denom {path} #Resulting axis velocity in um/ v_time_base\n"
        )
    };
    for (path, counts) in [("10000", 6_000_000.0), ("3333", 18_001_800.0)] {
        let (c, loading, found) = with_listing(&(listing(path) + VELOCITY_INPUT));
        assert_eq!((loading, found), (vec![], vec![]));
        assert_eq!(c.feedforward.mode, FeedforwardMode::ADD_VEL);
        near(c.feedforward.velocity_delay_s, 150e-6);
        let drive = c.feedforward_format.counts_per_mm_s(1e-3) * 100.0;
        assert!((drive - counts).abs() < 0.5, "{drive}");
    }
    // without the value in the telegram that part is off
    let (c, _, found) = with_listing(&listing("3333"));
    assert_eq!(ids(&found), ["70350"]);
    assert!(c.feedforward.mode.is_empty());
}

/// TF5200 feedforward control 4.2: 5 mm per revolution, gear of 3, 0.48 kg cm2, 0.45 N m, factor 500, weight 12/10.
/// Conformance: F057, F058, F059, F061, F063, F064, F066, F067.
#[test]
fn torque_listing_of_the_manual() {
    let listing = "vorsteuer.vorsteuerung 0x202 #0x002: Activation acceleration feedforward\n\
                   antr.feed_const_num 50000 #feedconstant 5mm per revolution\nantr.feed_const_denom 1\n\
                   getriebe[0].incr_per_rev 1048576 #2**20 increments per motor revolution\n\
                   getriebe[0].gear_fact_num 3\ngetriebe[0].gear_fact_denom 1\n\
                   antr.acc_reference_value 0.45 #stall torque in Nm\nantr.torque_scale_num 500\n\
                   antr.torque_scale_denom 1\nvorsteuer.acceleration_delay_time 150\n\
                   vorsteuer.vs_a_faktor 12\nvorsteuer.vs_a_nenner 10\n";
    let load = |load: &str| format!("{listing}getriebe[0].load {load}\n");
    let telegram = "antr.sercos.mdt[0].nc_ref S_0_0080\n";
    let (c, loading, found) = with_listing(&(load("4.8e-5") + telegram));
    assert_eq!((loading, found), (vec![], vec![]));
    assert_eq!(c.feedforward.mode, FeedforwardMode::ADD_ACC);
    near(c.feedforward.acceleration_delay_s, 150e-6);
    let torque = c.torque.torque(1000.0);
    assert!((torque - 0.18096).abs() < 5e-6, "{torque}");
    let counts = c.torque.counts(torque);
    assert!((counts - 201.06).abs() < 5e-3, "{counts}");
    let weighted = counts * c.feedforward.acceleration_quotient;
    assert!((weighted - 241.27).abs() < 5e-3, "{weighted}");
    // the printed load means kg cm2
    let (_, _, found) = with_listing(&(load("0.48") + telegram));
    assert_eq!(ids(&found), ["K-0024"]);
    assert_eq!(found[0].parameter, Some("P-AXIS-00391"));
    // the listing repeats S_0_0037 and is accepted
    let (c, _, found) = with_listing(&(load("4.8e-5") + VELOCITY_INPUT));
    assert_eq!(ids(&found), ["70351"]);
    assert_eq!(found[0].severity, Severity::Note);
    assert_eq!(c.feedforward.mode, FeedforwardMode::ADD_ACC);
    let (c, _, found) = with_listing(&load("4.8e-5"));
    assert_eq!(ids(&found), ["70351"]);
    assert_eq!(found[0].severity, Severity::Warning);
    assert!(c.feedforward.mode.is_empty());
    // its last page writes the gear ratio with the keys of older builds
    let old = "getriebe[].incr_per_rev 1048576\ngetriebe[].wegaufz 3 #gearbox ratio\n\
               getriebe[].wegaufn 1\nantr.feed_const_num 50000\nantr.feed_const_denom 1 #\n";
    let (_, loading, found) = with_listing(old);
    assert_eq!(ids(&loading), ["K-0029"; 3]);
    assert_eq!(ids(&found), ["K-0064"]);
    assert_eq!(found[0].parameter, Some("P-AXIS-00234"));
}

/// Settings of `xyz` and the one message that they give while loading or converting, once, with its parameter.
/// Conformance: F062, F080, F082, F086, F088.
#[test]
#[rustfmt::skip]
fn corrections_name_axis_parameter_and_place() {
    let stage = stage_of_x();
    let ipc = "X.lr_param.improved_position_control";
    let torque = "X.vorsteuer.vorsteuerung=ADD_ACC kontur.axis[1].additive.torque=1";
    let filter = "X.filter[0].enable=1 X.filter[0].order=2";
    let s = str::to_owned;
    let cases = [
        ("70348", "P-AXIS-00390", s("X.vorsteuer.acceleration_delay_time=6000")),
        ("70348", "P-AXIS-00547", s("X.vorsteuer.jerk_delay_time=6000")),
        ("70349", "P-AXIS-00389", s("X.vorsteuer.velocity_delay_time=6000")),
        ("110465", "P-AXIS-00326", format!("{torque} X.antr.torque_scale_denom=0")),
        ("110473", "P-AXIS-00338", s("X.vorsteuer.jerk_fact_denom=0")),
        ("110579", "P-AXIS-00512", s("X.getriebe[0].gear_fact_denom=0")),
        ("110624", "P-AXIS-00223", s("X.vorsteuer.vorsteuerung=3 X.vorsteuer.feedforward_without_delay=1")),
        ("80044", "P-AXIS-00051", s("X.antr.simu.daempfung_z=10")),
        ("110040", "P-AXIS-00194", s("X.antr.simu.totzeit=6")),
        ("50663", "P-AXIS-00357", format!("{filter} X.filter[0].type=11")),
        ("60311", "P-AXIS-00357", s("S.filter[1].enable=1 S.filter[1].order=1 S.filter[1].type=11")),
        ("110239", "P-AXIS-00204", s("X.filter[0].type=7")),
        ("110239", "P-AXIS-00204", s("X.filter[1].type=HSC_GAUSS")),
        ("110500", "P-AXIS-00153", s("X.filter[0].prototype=HSC X.filter[1].prototype=HSC")),
        ("110501", "P-AXIS-00153", s("X.filter[1].prototype=HSC")),
        ("110361", "P-AXIS-00067", format!("{filter} X.filter[0].fg_f0=0")),
        ("50911", "P-AXIS-00140", s("X.filter[2].enable=1 X.filter[2].order=7")),
        ("K-0033", "P-AXIS-00080", format!("{filter} X.filter[0].type=BANDSTOP X.filter[0].guete=11")),
        ("K-0033", "P-AXIS-00164", format!("{filter} X.filter[0].share_percent=101")),
        ("K-0036", "P-AXIS-00140", s("X.filter[0].enable=1 X.filter[0].order=1 X.filter[0].type=PT2")),
        ("K-0037", "P-AXIS-00153", format!("{filter} X.filter[0].type=ALLPASS")),
        ("K-0038", "P-AXIS-00204", format!("{filter} X.filter[0].type=HIGHPASS")),
        ("K-0039", "P-AXIS-00153", s("X.filter[0].prototype=HSC X.filter[0].type=LOWPASS")),
        ("K-0040", "P-AXIS-00153", s("S.filter[0].prototype=HSC")),
        ("50989", "P-AXIS-00587", s("X.filter_fir.type=1 X.filter_fir.enable=1")),
        ("50910", "P-AXIS-00591", s("X.filter_fir.type=1 X.filter_fir.enable=1 X.filter_fir.order_time=999")),
        ("50820", "P-AXIS-00589", s("X.vib_guard.active=1 X.vib_guard.freq=600")),
        ("K-0023", "P-AXIS-00223", s("X.vorsteuer.vorsteuerung=0x100")),
        ("70350", "P-AXIS-00223", s("X.vorsteuer.vorsteuerung=ADD_VEL")),
        ("70351", "P-AXIS-00223", s("X.vorsteuer.vorsteuerung=ADD_ACC")),
        ("K-0062", "P-AXIS-00392", format!("{torque} X.antr.acc_reference_value=0")),
        ("K-0065", "P-AXIS-00092", s("X.getriebe[0].incr_per_rev=4096")),
        ("70603", "P-AXIS-00754", format!("{stage} {ipc}.stage[0].weight_fact_num=0")),
        ("70604", "P-AXIS-00755", format!("{stage} {ipc}.stage[0].weight_fact_denom=0")),
        ("K-0025", "P-AXIS-00750", format!("{stage} {ipc}.stage[0].filter[0].order=4")),
        ("K-0025", "P-AXIS-00751", format!("{stage} {ipc}.stage[0].filter[0].fg_f0=500.5")),
        ("K-0025", "P-AXIS-00756", format!("{stage} {ipc}.stage[0].mode=2 {ipc}.stage[0].filter.damping=1")),
        ("K-0026", "P-AXIS-00757", format!("{stage} {ipc}.v_add_max_fact=0")),
        ("K-0027", "P-AXIS-00754", format!("{stage} {ipc}.stage[0].weight_fact_num=8")),
    ];
    // what was not written has no place: the default that does not fit
    let unwritten = ["K-0037", "50989", "50663", "60311"];
    for (id, parameter, settings) in cases {
        let settings: Vec<&str> = settings.split_whitespace().collect();
        let (machine, mut found) = load("xyz", &settings, &Disk("", String::new()));
        found.extend(machine.chains().1);
        assert_eq!(ids(&found), [id], "{settings:?}: {found:?}");
        let found = &found[0];
        assert_eq!(found.parameter, Some(parameter), "{found:?}");
        assert_eq!(found.axis.as_ref().unwrap().name, settings[0][..1], "{found:?}");
        match &found.source {
            Some(at) => assert!(settings.contains(&&*at.text), "{settings:?}: {at:?}"),
            None => assert!(unwritten.contains(&id), "{found:?}"),
        }
    }
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
