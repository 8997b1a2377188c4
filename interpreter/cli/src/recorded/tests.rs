use super::*;

fn values(text: &str) -> Vec<(String, Vec<f64>, Vec<f64>)> {
    parse(text).unwrap().into_iter().map(|c| (c.name, c.times_s, c.values)).collect()
}

#[test]
fn separators_and_decimal_commas() {
    let want = vec![("a".to_owned(), vec![0.0, 0.5, 1.0], vec![1.5, -2.0, 3.0])];
    for text in [
        "t_s,a\n0,1.5\n0.5,-2\n1,3\n",
        "t_s;a\n0;1,5\n0,5;-2\n1;3\n",
        "t_s\ta\r\n0\t1,5\r\n0,5\t-2,0\r\n1\t3\r\n",
        "Measured on Monday\n\nTime [ms];a\n0;1,5\n500;-2\n1000;3\n",
        "\u{feff}time;a\n[ms];[g]\n0;1,5\n500;-2\n1000;3\nEOF\n",
    ] {
        assert_eq!(values(text), want, "{text}");
    }
    assert!(parse("a,b\nx,y\n").is_err());
    let two = values("a;b\n1;2\n3;4\n5;6\n");
    assert_eq!(two[1], ("b".to_owned(), Vec::new(), vec![2.0, 4.0, 6.0]));
}

/// The layout of TwinCAT Scope: keys before every group, two sampling times, repeated slow samples, ticks.
#[test]
fn scope_export() {
    let text = "Name\tScope01\nFile\tx.svdx\nStarttime of export\t132500000000000000\tMonday\n\n\
                Name\tAct\tCmd\tName\tSlow\n\
                SampleTime[ms]\t1\t1\tSampleTime[ms]\t2\n\
                Data-Type\tREAL64\tREAL64\tData-Type\tREAL64\n\
                SymbolName\tMAIN.fAct\tMAIN.fCmd\tSymbolName\tMAIN.fSlow\n\n\
                0\t0,5\t1\t0\t7\n1\t0,25\t2\t0\t7\n2\t0,125\t3\t2\t8\n3\t0\t4\t2\t8\nEOF\n";
    let found = parse(text).unwrap();
    let names: Vec<_> = found.iter().map(|c| c.name.as_str()).collect();
    assert_eq!(names, ["MAIN.fAct", "MAIN.fCmd", "MAIN.fSlow"]);
    assert_eq!(found[0].values, [0.5, 0.25, 0.125, 0.0]);
    assert_eq!(found[2].values, [7.0, 8.0]);
    assert!((found[2].times_s[1] - 0.002).abs() < 1e-12);
    assert_eq!(find(&found, "fslow").unwrap().name, "MAIN.fSlow");
    let ticks = text
        .replace("\n0\t0,5", "\n132500000000000000\t0,5")
        .replace("\n1\t0,25", "\n132500000000010000\t0,25")
        .replace("\n2\t0,125", "\n132500000000020000\t0,125")
        .replace("\n3\t0\t4", "\n132500000000030000\t0\t4");
    let ticks = parse(&ticks).unwrap();
    assert!((ticks[0].times_s[3] - 0.003).abs() < 1e-9, "{:?}", ticks[0].times_s);
}

/// A recording of one second in any unit begins at 0 and ends at 1 s; a unit that is not one of time is reported.
#[test]
fn units_of_time() {
    for (title, last) in [
        ("Time [us]", "1000000"),
        ("Time (\u{b5}s)", "1000000"),
        ("time [\u{3bc}s]", "1000000"),
        ("time[\u{fffd}s]", "1000000"),
        ("t_us", "1e6"),
        ("Time [ns]", "1e9"),
        ("time [ ms ]", "1000"),
        ("t_ms", "1000"),
        ("time [s]", "1"),
        ("time [h]", "0.0002777777777777778"),
        ("time (min)", "0.016666666666666666"),
    ] {
        let times = &values(&format!("{title};a [g]\n0;1\n{last};2\n"))[0].1;
        assert!((times[1] - 1.0).abs() < 1e-12, "{title}: {times:?}");
    }
    let below = values("time;a\nus;g\n0;1\n1000000;2\n");
    assert_eq!((below[0].0.as_str(), below[0].1[1].to_bits()), ("a", 1.0_f64.to_bits()));
    let unknown = parse("time [days];a\n0;1\n1;2\n").unwrap_err();
    assert!(unknown.contains("`days`") && unknown.contains("ms, us"), "{unknown}");
}

/// A repeated time with its value is a slow channel among faster ones; with a different value it has lost its decimals.
#[test]
fn repeated_times() {
    let slow = values("t_s,a,b\n0,1,5\n0,1,5\n0.1,2,6\n0.1,2,6\n");
    assert_eq!(slow[0].2, [1.0, 2.0]);
    let coarse = parse("t_s,a\n0.000,1\n0.000,2\n0.001,3\n0.001,4\n").unwrap_err();
    assert!(coarse.contains("row 3") && coarse.contains("decimals"), "{coarse}");
}

fn scope(sample_ms: [&str; 2], rows: &str) -> String {
    let [a, b] = sample_ms;
    format!(
        "Name\tA\tB\tName\tC\nSampleTime[ms]\t{a}\t{b}\tSampleTime[ms]\t{a}\n\
         SymbolName\tM.A\tM.B\tSymbolName\tM.C\n\n{rows}"
    )
}

/// The times of all channels start at the first time of the file, whichever group has it.
#[test]
fn one_clock_for_all_channels() {
    let rows = "0\t1\t1\t40\t9\n1\t2\t2\t41\t8\n2\t3\t3\t42\t7\n";
    let found = parse(&scope(["1", "1"], rows)).unwrap();
    assert_eq!(found[0].times_s, [0.0, 1e-3, 2e-3]);
    assert!((found[2].times_s[0] - 0.040).abs() < 1e-12);
    let late = values("t_s,a,b\n0.5,1,\n0.6,2,\n0.7,3,9\n0.8,4,8\n");
    assert!((late[1].1[0] - 0.2).abs() < 1e-12 && late[0].1[0].abs() <= 0.0, "{late:?}");
}

/// The sampling time of the header has to match the times; that of a slow channel with repeated samples does.
#[test]
fn sampling_times_of_the_header() {
    let rows = "0\t1\t5\t0\t9\n1\t2\t5\t1\t8\n2\t3\t6\t2\t7\n3\t3\t6\t3\t7\n";
    let found = parse(&scope(["1", "2"], rows)).unwrap();
    assert_eq!((found[1].values.as_slice(), found[1].times_s.len()), (&[5.0, 6.0][..], 2));
    assert!((found[1].times_s[1] - 0.002).abs() < 1e-12);
    for (a, b) in [("10", "1"), ("1", "3"), ("1", "0.1")] {
        let wrong = parse(&scope([a, b], rows)).unwrap_err();
        assert!(wrong.contains("SampleTime[ms]"), "{a} {b}: {wrong}");
    }
}
