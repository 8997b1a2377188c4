//! Machines whose numbers do not fit together. Values out of range and without effect are rows of `interpreter/tests/lists`.

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
    let mut files = Memory::machine();
    files.0.remove("m/lists/y.lis");
    assert_eq!(files.ids(&[]), ["K-0153"]);
    // a list without a number; files of the suite have the other mistakes
    assert_eq!(broken("m/lists/x.lis", ""), ["K-0031"]);
    let errors = Memory::default().load(&[]).unwrap_err();
    assert_eq!(errors[0].id, Condition::NoList);
    // --path is for subroutines
    assert!(errors[0].hint.as_ref().unwrap().starts_with("-m takes"), "{errors:?}");
}

#[test]
fn types_and_limits_that_others_follow() {
    let check = |text: &str| {
        let mut files = Memory::machine();
        files.add("m/lists/y.lis", text);
        let (machine, warnings) = files.load(&[]).unwrap();
        let ids: Vec<String> = warnings.iter().map(|d| d.id.to_string()).collect();
        (machine.axis("X").unwrap().clone(), ids)
    };
    // an axis of no type is linear, and its axis list says so (P-AXIS-00018)
    let (x, ids) = check("kenngr.achs_typ 3\n");
    assert!(ids.len() == 1 && x.is_linear(), "{ids:?}");
    let (x, ids) = check("kenngr.achs_typ ACHSTYP_ROTATO\n");
    assert_eq!(ids, ["1001138", "K-0070"]);
    assert_eq!(x.raw("kenngr.achs_typ"), Some(1.0));
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
