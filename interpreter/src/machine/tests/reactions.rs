//! Handling of values that are out of range, inconsistent or without effect.

use super::*;
use kontur_motion::block::SplineSettings;

#[test]
fn numbers_that_do_not_fit_together() {
    let broken = |path: &str, text: &str| {
        let mut files = Memory::machine();
        files.put(path, text);
        files.ids(&[])
    };
    assert_eq!(broken("m/lists/y.lis", "kopf.achs_nr 2\n"), ["K-0031"]);
    assert_eq!(broken("m/lists/y.lis", "kopf.achs_nr 7\n"), ["K-0031", "K-0031"]);
    let channel = "gruppe[0].achse[0].bezeichnung X\ngruppe[0].achse[0].log_achs_nr 1\n\
                   gruppe[0].achse[1].bezeichnung";
    assert_eq!(
        broken("m/lists/channel.lis", &format!("{channel} Y\ngruppe[0].achse[1].log_achs_nr 1\n")),
        ["20423"]
    );
    assert_eq!(
        broken("m/lists/channel.lis", &format!("{channel} x\ngruppe[0].achse[1].log_achs_nr 7\n")),
        ["20424"]
    );
    assert_eq!(
        broken("m/lists/channel.lis", &format!("{channel} M\ngruppe[0].achse[1].log_achs_nr 7\n")),
        ["20425", "K-0075"]
    );
    assert_eq!(broken("m/lists/channel.lis", &format!("{channel} Y\n")), ["K-0031"]);
    // a path axis whose list says spindle
    assert_eq!(
        broken("m/lists/channel.lis", &format!("{channel} Y\ngruppe[0].achse[1].log_achs_nr 4\n")),
        ["21238"]
    );
    let mut files = Memory::machine();
    files.0.remove("m/lists/y.lis");
    assert_eq!(files.ids(&[]), ["K-0153"]);
    // a list without a number
    assert_eq!(broken("m/lists/x.lis", ""), ["K-0031"]);
    let errors = Memory::default().load(&[]).unwrap_err();
    assert_eq!(errors[0].id, Condition::NoList);
    // --path is for subroutines
    assert!(errors[0].hint.as_ref().unwrap().starts_with("-m takes"), "{errors:?}");
}

/// Conformance: F055, F065, F082, F087, F088, V063, V065, V067.
#[test]
fn documented_reactions_to_values_out_of_range() {
    // TF5200 diagnosis, plausibility of axis parameters: line of the list, ID, value used
    let cases = [
        ("antr.simu.totzeit 6", "110040", "antr.simu.totzeit", 5.0),
        ("getriebe[0].dynamik.vb_max 0", "110079", "getriebe[0].dynamik.vb_max", 200000.0),
        ("getriebe[0].wegaufn 0", "110086", "getriebe[0].wegaufn", 1.0),
        ("getriebe[0].wegaufz 0", "110386", "getriebe[0].wegaufz", 1.0),
        ("kenngr.max_vb_override 0", "110111", "kenngr.max_vb_override", 1.0),
        ("getriebe[0].kv 0", "110150", "getriebe[0].kv", 1000.0),
        ("vorsteuer.vs_a_nenner 0", "110381", "vorsteuer.vs_a_nenner", 1.0),
        ("vorsteuer.vs_v_nenner 0", "110123", "vorsteuer.vs_v_nenner", 1.0),
        ("vorsteuer.jerk_fact_denom 0", "110473", "vorsteuer.jerk_fact_denom", 100.0),
        ("getriebe[0].gear_fact_denom 0", "110579", "getriebe[0].gear_fact_denom", 1.0),
        ("getriebe[0].gear_fact_num 0", "K-0070", "getriebe[0].gear_fact_num", 1.0),
        ("antr.torque_scale_denom 0", "110465", "antr.torque_scale_denom", 0.0),
        ("getriebe[0].dynamik.tr_w_min 5000", "110406", "getriebe[0].dynamik.tr_w_min", 10000.0),
        (
            "getriebe[0].pos_control_deadband 501",
            "110528",
            "getriebe[0].pos_control_deadband",
            500.0,
        ),
        ("vorsteuer.velocity_delay_time 6000", "70349", "vorsteuer.velocity_delay_time", 0.0),
        (
            "vorsteuer.acceleration_delay_time 6000",
            "70348",
            "vorsteuer.acceleration_delay_time",
            0.0,
        ),
        ("vorsteuer.jerk_delay_time 6000", "70348", "vorsteuer.jerk_delay_time", 0.0),
        ("antr.simu.daempfung_z 10", "80044", "antr.simu.daempfung_z", 9.99),
        ("vib_guard.mode 5", "K-0034", "vib_guard.mode", 1.0),
        ("vib_guard.freq 0.5", "K-0034", "vib_guard.freq", 30.0),
        ("vib_guard.damping 1.1", "K-0034", "vib_guard.damping", 0.1),
        ("getriebe[0].slope_type 4", "60226", "getriebe[0].slope_type", 0.0),
        (
            "getriebe[0].slope_profil.a_beschl 1001",
            "K-0070",
            "getriebe[0].slope_profil.a_beschl",
            1000.0,
        ),
        (
            "getriebe[0].slope_profil.tr_grenz 9999",
            "K-0070",
            "getriebe[0].slope_profil.tr_grenz",
            10000.0,
        ),
    ];
    for (line, id, key, used) in cases {
        let mut files = Memory::machine();
        files.put("m/lists/y.lis", &format!("kopf.achs_nr 1\n{line}\n"));
        let (machine, mut warnings) = files.load(&[]).unwrap();
        // a corrected value may still differ from the recommended one
        warnings.retain(|d| d.id != Condition::ListAdvice);
        let found: Vec<String> = warnings.iter().map(|d| d.id.to_string()).collect();
        assert_eq!(found, [id], "{line}");
        assert_eq!(warnings[0].severity, Severity::Warning, "{line}");
        assert_eq!(warnings[0].axis.as_ref().unwrap().name, "X", "{line}");
        let at = warnings[0].source.as_ref().unwrap();
        assert_eq!((&*at.file, &*at.text), ("m/lists/y.lis", line));
        assert!(close(machine.axis("X").unwrap().raw(key).unwrap(), used), "{line}");
    }
}

/// Conformance: A108, F075, F076.
#[test]
fn values_with_a_meaning_of_their_own_are_no_faults() {
    let mut files = Memory::machine();
    files.add(
        "m/lists/y.lis",
        "getriebe[0].dynamik.a_emergency 0\ngetriebe[0].dynamik.tr_w_min 0\nvorsteuer.vs_a_faktor 0\n\
         vorsteuer.vs_v_faktor 0\ngetriebe[0].dynamik.a_trans_weight 0\nvorsteuer.velocity_delay_time 5999\n\
         getriebe[0].lslope_profil.d_stufe_1 0\nlr_param.add_interface.filter[0].order 2\n",
    );
    assert_eq!(files.ids(&[]), [""; 0]);
}

#[test]
fn some_values_refuse_the_machine() {
    for (path, line, id) in [
        ("m/lists/x.lis", "antr.feed_const_denom 0\n", "110472"),
        ("m/lists/channel.lis", "prog_start.slope.ramp_time 5\n", "120178"),
    ] {
        let mut files = Memory::machine();
        files.add(path, line);
        assert!(files.load(&[]).is_err());
        assert_eq!(files.ids(&[]), [id]);
    }
    let mut files = Memory::machine();
    files.put("m/kontur.lis", "kontur.cycle_time_us 50\n");
    assert!(files.load(&[]).is_err());
}

#[test]
fn rules_over_several_parameters() {
    let check = |text: &str| {
        let mut files = Memory::machine();
        files.add("m/lists/y.lis", text);
        let (machine, warnings) = files.load(&[]).unwrap();
        let ids: Vec<String> = warnings.iter().map(|d| d.id.to_string()).collect();
        (machine.axis("X").unwrap().clone(), ids)
    };
    let (x, ids) =
        check("vorsteuer.vorsteuerung VEL | ACC | JERK\nvorsteuer.feedforward_without_delay 1\n");
    assert_eq!((x.raw("vorsteuer.vorsteuerung"), ids), (Some(1.0), vec!["110624".to_owned()]));
    let (x, ids) = check("kenngr.swe_neg 100\nkenngr.swe_pos 100\n");
    assert_eq!(ids, ["110110", "110110"]);
    assert_eq!(x.software_limits_mm(), Some((-10000.0, 10000.0)));
    // an axis of no type is linear, and its axis list says so (P-AXIS-00018)
    let (x, ids) = check("kenngr.achs_typ 3\n");
    assert!(ids.len() == 1 && x.is_linear(), "{ids:?}");
    let (x, ids) = check("kenngr.achs_typ ACHSTYP_ROTATO\n");
    assert_eq!(ids, ["1001138", "K-0070"]);
    assert_eq!(x.raw("kenngr.achs_typ"), Some(1.0));
    // the sampling time of the simulated drive is given and differs from the cycle
    let (_, ids) = check("antr.simu.zeitkonstante_z 1\nantr.simu.zeitkonstante_n 100\n");
    assert_eq!(ids, ["K-0032"]);
    let (_, ids) = check("antr.simu.zeitkonstante_z 1\nantr.simu.zeitkonstante_n 1000\n");
    assert_eq!(ids, [""; 0]);
    // gear stages beyond the first are stored, not checked
    let (x, ids) = check("getriebe[1].slope_profil.a_beschl 9000\n");
    assert_eq!((x.raw("getriebe[1].slope_profil.a_beschl"), ids), (Some(9000.0), Vec::new()));
    // one velocity weight 0: both become 1
    let (x, ids) =
        check("vorsteuer.feedforward_v_add_num 7\nvorsteuer.feedforward_v_add_denom 0\n");
    assert_eq!(ids, ["110123"]);
    assert_eq!(x.raw("vorsteuer.feedforward_v_add_num"), Some(1.0));
    // a limit below the defaults: the defaults follow it, with notes
    let (x, ids) = check("getriebe[0].dynamik.a_max 500\n");
    assert!(ids.iter().all(|id| id == "K-0070") && !ids.is_empty());
    let d = x.dynamics();
    assert!(
        d.feed.acc_mm_s2 <= 500.0
            && d.rapid.acc_mm_s2 <= 500.0
            && d.step_feed.acc_mm_s2[1] <= 500.0
    );
}

/// Conformance: F023.
#[test]
fn what_has_no_effect_is_said() {
    let mut files = Memory::machine();
    files.add("m/lists/channel.lis", "prog_start.g_gruppe[21].nr 135\n");
    assert_eq!(files.ids(&[]), ["K-0075"]);
    for key in ["ext_wzv_vorhanden", "multi_path_configuration", "block_filter_tolerance"] {
        let mut files = Memory::machine();
        files.add("m/lists/channel.lis", &format!("{key} 1\n"));
        assert_eq!(files.ids(&[]), ["K-0075"], "{key}");
    }
    let axis = [
        ("kenngr.delay_filter_only_position 1", 1),
        ("kenngr.feedhold_deceleration_mode FEEDHOLD_DECELERATION", 1),
        ("kenngr.feedhold_deceleration_mode DEFAULT_DECELERATION", 0),
    ];
    for (line, messages) in axis {
        let mut files = Memory::machine();
        files.add("m/lists/x.lis", &format!("{line}\n"));
        assert_eq!(files.ids(&[]), vec!["K-0075"; messages], "{line}");
    }
    let mut files = Memory::machine();
    files.add("m/hochlauf.lis", "pfad[0].prg[0] ../subs\n");
    assert_eq!(files.ids(&[]), ["K-0075"]);
    let mut files = Memory::machine();
    files.add("m/hochlauf.lis", "sda_mds[1] more.lis\n");
    files.put(
        "m/hochlauf.lis",
        &files.0["m/hochlauf.lis"].replace("kanal_anzahl 1", "kanal_anzahl 2"),
    );
    let (_, warnings) = files.load(&[]).unwrap();
    assert_eq!(warnings.iter().map(|d| d.id).collect::<Vec<_>>(), [Condition::Unsupported]);
    let mut files = Memory::machine();
    files.add("m/hochlauf.lis", "listen BINAER\n");
    assert!(files.load(&[]).is_err());
}

#[test]
fn counts_limit_what_is_used() {
    let mut files = Memory::machine();
    files.add("m/hochlauf.lis", "achs_mds[3] lists/more.lis\n");
    assert_eq!(files.ids(&[]), ["K-0074"]);
    let mut files = Memory::machine();
    files.add("m/lists/channel.lis", "gruppe[0].achse[2].bezeichnung Z\n");
    assert_eq!(files.ids(&[]), ["K-0074"]);
}

/// Pairs of the coupling group of the channel list, by an independent rule: a pair is kept if both numbers are not 0
/// and differ, its slave has no master yet, and no axis is both (20438, 20440 to 20442).
#[test]
fn default_couplings_keep_the_pairs_that_fit() {
    let pair = |i: u32, master: u32, slave: u32| {
        format!(
            "synchro_data.koppel_gruppe[0].paar[{i}].log_achs_nr_master {master}\n\
             synchro_data.koppel_gruppe[0].paar[{i}].log_achs_nr_slave {slave}\n"
        )
    };
    for seed in 0..81_u32 {
        let digits: Vec<u32> = (0..4).map(|k| seed / 3_u32.pow(k) % 3).collect();
        let written = [(digits[0], digits[1]), (digits[2], digits[3])];
        let mut files = Memory::machine();
        files.add(
            "m/lists/channel.lis",
            &(pair(0, written[0].0, written[0].1) + &pair(1, written[1].0, written[1].1)),
        );
        let (machine, warnings) = files.load(&[]).unwrap();
        let fits = |(master, slave): (u32, u32)| master * slave != 0 && master != slave;
        let first = fits(written[0]).then_some(written[0]);
        let second = Some(written[1]).filter(|pair| fits(*pair)).filter(|(master, slave)| {
            first.is_none_or(|(m, s)| s != *slave && s != *master && m != *slave)
        });
        let kept: Vec<(u32, u32)> = first.into_iter().chain(second).collect();
        let found: Vec<(u32, u32)> =
            machine.channel.default_couplings.iter().map(|p| (p.master, p.slave)).collect();
        assert_eq!(found, kept, "{written:?}");
        let absent = written.iter().filter(|pair| **pair == (0, 0)).count();
        assert_eq!(warnings.len(), 2 - kept.len() - absent, "{written:?} {warnings:?}");
    }
}

/// Page 149304587: F is in mm/min with 100 and in m/min with 0.1; -1 is 100 without a message, and no other value is a unit.
#[test]
fn the_feed_has_one_of_two_units() {
    for (value, mm_min, said) in [
        ("100", 1.0, &[][..]),
        ("1.000000e-001", 1000.0, &[]),
        ("-1", 1.0, &[]),
        ("0", 1.0, &["K-0070"]),
        ("-2", 1.0, &["K-0070"]),
        ("0.05", 1.0, &["K-0070"]),
        ("10", 1.0, &["K-0070"]),
        ("99.9", 1.0, &["K-0070"]),
        ("1000", 1.0, &["K-0070"]),
    ] {
        let setting = format!("channel.prog_start.feedrate_factor={value}");
        let (machine, messages) = Machine::builtin(&[Override::parse(&setting).unwrap()]).unwrap();
        let ids: Vec<String> = messages.iter().map(|d| d.id.to_string()).collect();
        assert_eq!(ids, said, "{value}");
        assert!((machine.channel.feed.unit_mm_min - mm_min).abs() < 1e-9, "{value}");
    }
}

/// A list that changes a parameter which the control acts on says so by name; the default, and a value that kontur has by
/// itself, say nothing. Defaults: the vendor's pages, see the rows.
#[test]
fn what_is_not_simulated_is_named() {
    let rows = [
        ("x", "kenngr.coll_check_ax_nr", "0", "7"),
        ("x", "kenngr.gantry_offset", "0", "-100"),
        ("x", "lr_param.mod_komp", "0", "1"),
        ("x", "getriebe[0].modulo_calculation", "-1", "1"),
        ("s", "getriebe[0].modulo_calculation", "1", "0"),
        ("x", "kenngr.mess_neg_flanke", "0", "1"),
        ("x", "kenngr.mess_offset", "0", "10000"),
        ("x", "kenngr.measure.edge", "POS", "NEG"),
        ("s", "antr.velocity_position_control_on", "2000000000", "1000"),
        ("s", "kenngr.vb_prozent_dyn_dz", "0", "50"),
        ("s", "getriebe[0].vb_regelgrenze", "200000", "60000000"),
        ("s", "kenngr.swe_check", "-1", "1"),
        ("channel", "rund_mass_einh", "0", "1"),
        ("channel", "soft_limit_tolerance", "0", "1"),
        ("channel", "hsc.bspline.limit_corner_dist", "200", "100"),
        ("channel", "hsc.gen.linear_segmentation", "0", "1"),
        ("channel", "hsc.gen.circular_param", "50", "100"),
        ("channel", "hsc.gen.on_delay_output_one_block", "0", "1"),
        ("channel", "hsc.gen.max_track_ratio", "1.0e+002", "50"),
        ("channel", "implicit_contour_masking", "0", "1"),
        ("channel", "configuration.interpolator.blocks_per_call", "200", "50"),
        (
            "channel",
            "configuration.interpolator.function",
            "FCT_IPO_DEFAULT | FCT_SYNC",
            "FCT_IPO_DEFAULT | FCT_LOOK_AHEAD_OPT",
        ),
        ("channel", "tapping.use_actual_position", "0", "1"),
        ("channel", "thread_cutting.use_actual_speed", "0", "1"),
    ];
    for (list, key, default, changed) in rows {
        for (value, ids) in [(default, &[][..]), (changed, &["K-0075"][..])] {
            let mut files = Memory::machine();
            let modulo = if list == "s" { "kenngr.achs_mode 4\n" } else { "" };
            files.add(&format!("m/lists/{list}.lis"), &format!("{modulo}{key} {value}\n"));
            let (_, said) = files.load(&[]).unwrap();
            let said_ids: Vec<String> = said.iter().map(|d| d.id.to_string()).collect();
            assert_eq!(said_ids, ids, "{key} {value}");
            assert!(said.iter().all(|d| d.text.starts_with(key)), "{said:?}");
        }
    }
}

/// One message for all entries of an array: pages of kinematics and dynamic weighting list dozens of them.
#[test]
fn an_array_without_effect_is_named_once() {
    let mut files = Memory::machine();
    files.add("m/lists/x.lis", "lr_hw[0].vz_stellgr 1\nlr_hw[1].vz_stellgr 1\n");
    assert_eq!(files.ids(&[]), ["K-0075"]);
}

/// P-AXIS-00557 decides for rotary axes whatever the axis mode is (117205643); P-AXIS-00705 switches the software limits off
/// (117316107).
#[test]
fn modulo_calculation_and_software_limits_by_their_switches() {
    for (mode, calculation, is_modulo) in
        [(1, -1, false), (4, -1, true), (1, 1, true), (4, 0, false), (4, 1, true), (1, 0, false)]
    {
        let mut files = Memory::machine();
        let entries = format!(
            "kenngr.achs_typ ACHSTYP_ROTATOR\nkenngr.achs_mode {mode}\ngetriebe[0].modulo_calculation {calculation}\n"
        );
        files.add("m/lists/x.lis", &entries);
        let (machine, said) = files.load(&[]).unwrap();
        let axis = machine.axis("Y").unwrap();
        assert_eq!(axis.is_modulo(), is_modulo, "{entries}");
        assert_eq!(axis.software_limits_mm().is_none(), is_modulo, "{entries}");
        assert_eq!(said, [], "{entries}");
    }
    for (check, limited) in [(-1, true), (0, false), (1, true)] {
        let mut files = Memory::machine();
        files.add("m/lists/x.lis", &format!("kenngr.swe_check {check}\n"));
        let (machine, said) = files.load(&[]).unwrap();
        assert_eq!(machine.axis("Y").unwrap().software_limits_mm().is_some(), limited, "{check}");
        assert_eq!(said, [], "{check}");
    }
}

/// Sizes of the look-ahead: TF5200 channel parameters 828925963 (30, 120, 190), 829047947 (the number with CUSTOM only).
#[test]
fn look_ahead_of_the_channel_list() {
    let blocks = |start_up: &str, channel: &str| {
        let mut files = Memory::machine();
        files.add("m/hochlauf.lis", start_up);
        files.add("m/lists/channel.lis", channel);
        let (machine, said) = files.load(&[]).unwrap();
        assert_eq!(said, [], "{start_up} {channel}");
        machine.channel.look_ahead_blocks
    };
    let start_up = "configuration.channel[0].interpolator.function";
    let channel = "configuration.interpolator";
    let function = format!("{channel}.function");
    assert_eq!(blocks("", ""), 120);
    for (name, size) in [("LOW", 30), ("STANDARD", 120), ("HIGH", 190)] {
        assert_eq!(blocks(&format!("{start_up} FCT_LOOK_AHEAD_{name}\n"), ""), size);
        let listed = format!("{function} FCT_IPO_DEFAULT | FCT_LOOK_AHEAD_{name}\n");
        assert_eq!(blocks(&format!("{start_up} FCT_LOOK_AHEAD_LOW\n"), &listed), size);
    }
    let number = format!("{channel}.number_blocks_lah 500\n");
    assert_eq!(blocks("", &number), 120);
    assert_eq!(blocks("", &format!("{number}{function} FCT_LOOK_AHEAD_CUSTOM\n")), 500);
    let older = format!("{channel}.parameter 95\n{function} FCT_LOOK_AHEAD_CUSTOM\n");
    assert_eq!(blocks("", &older), 95);
}

/// P-CHAN-00122 to 00130 in the units of their pages: 0.1 um and 0.0001 deg.
#[test]
fn splines_begin_with_the_settings_of_the_list() {
    let spline = |entries: &str| {
        let mut files = Memory::machine();
        files.add("m/lists/channel.lis", entries);
        let (machine, said) = files.load(&[]).unwrap();
        assert_eq!(said, [], "{entries}");
        machine.channel.spline
    };
    // the page prints 0 for G00
    let default = SplineSettings { off_at_rapid: false, ..SplineSettings::default() };
    assert_eq!(spline(""), default);
    let listed = spline(
        "hsc.bspline.path_deviation 500\nhsc.bspline.track_deviation 1.0e+004\nhsc.bspline.max_path_length 30000\n\
         hsc.bspline.max_angle 450000\nhsc.bspline.auto_off_g00 0\nhsc.bspline.auto_off_path 1\nhsc.bspline.auto_off_track 1\n",
    );
    let expected = SplineSettings {
        path_dev_mm: 0.05,
        track_dev_deg: 1.0,
        off_at_path_dev: true,
        off_at_track_dev: true,
        off_at_rapid: false,
        max_length_mm: 3.0,
        max_angle_deg: 45.0,
    };
    assert_eq!(listed, expected);
}
