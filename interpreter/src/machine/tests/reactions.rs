//! Machines whose numbers do not fit together. Values out of range and without effect are rows of `interpreter/tests/lists`.

use super::*;

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
fn an_unknown_type_of_axis_is_linear() {
    let mut files = Memory::machine();
    files.add("m/lists/y.lis", "kenngr.achs_typ ACHSTYP_ROTATO\n");
    assert_eq!(files.ids(&[]), ["1001138", "K-0070"]);
    let (machine, _) = files.load(&[]).unwrap();
    assert_eq!(machine.axis("X").unwrap().raw("kenngr.achs_typ"), Some(1.0));
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
