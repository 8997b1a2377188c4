//! Columns of a run: the records of their cycles, and what is computed only where it is asked for.

use super::*;
use crate::record::columns;

/// Columns equal the records of their cycles bit for bit, on one thread and on two, whichever of them are requested and
/// however the run is divided; values that were not requested are NaN in a record.
#[test]
fn columns_are_the_records_of_their_cycles() {
    struct Columns(Asked, Vec<CycleRecord>, Vec<Vec<Vec<f64>>>);
    impl Sink for Columns {
        type Stop = std::convert::Infallible;
        fn reads(&self) -> Option<Asked> {
            Some(self.0)
        }
        fn rows(&mut self, rows: &Rows<'_>) -> Result<(), Self::Stop> {
            let Self(asked, records, columns) = self;
            let Ok(()) = rows.each(|record| {
                records.push(record.clone());
                Ok::<(), Self::Stop>(())
            });
            columns.resize(rows.axes(), vec![Vec::new(); Quantity::ALL.len()]);
            for (axis, columns) in columns.iter_mut().enumerate() {
                for (quantity, column) in Quantity::ALL.iter().zip(columns) {
                    let values = rows.column(axis, *quantity);
                    assert_eq!(values.len(), if asked.has(*quantity) { rows.len() } else { 0 });
                    column.extend_from_slice(values);
                }
            }
            Ok(())
        }
    }
    let guard = "#VIB GUARD ON [MODE=2 FREQ=20]\n";
    let text = format!(
        "{guard}G135\nG01 X5 F3000 M3 S300\nY5\nX0 Y0\nG60 X3\n#VIB GUARD ON [AX_DEV=0.05]\nY5\nG04 0.2\nX0 Y0\nM30\n"
    );
    let lags = ["X.getriebe[0].slep_ueberw_typ=4", "X.getriebe[0].slep_max=30000"];
    let start = || job(&text, &lags, Options::default()).start().unwrap();
    let wanted = records(&mut start());
    let both = [Quantity::Ipo, Quantity::Set];
    let some = [Quantity::Err, Quantity::Lag, Quantity::Dev, Quantity::Jerk, Quantity::TorqueNm];
    for asked in [Asked::ALL, Asked::of(&both), Asked::of(&both).and(Asked::of(&some))] {
        for cut in [0, 1, 100, u64::MAX] {
            let mut run = start();
            let mut sink = Columns(asked, Vec::new(), Vec::new());
            let thread = |name: &str, work: Work| {
                std::thread::Builder::new().name(name.to_owned()).spawn(work).is_ok()
            };
            let Ok(()) = match cut {
                0 => run.to_end_on_threads(thread, &mut sink),
                u64::MAX => run.to_end(&mut sink),
                _ => (0..3)
                    .try_for_each(|_| run.advance(cut, &mut sink))
                    .and_then(|()| run.to_end(&mut sink)),
            };
            let Columns(_, records, columns) = sink;
            assert_eq!(records.len(), wanted.len());
            for (i, (record, wanted)) in records.iter().zip(&wanted).enumerate() {
                let whole = |r: &CycleRecord| {
                    (r.k, r.file, r.line, r.block, format!("{:?}", r.path), r.contour_err_mm)
                };
                assert_eq!(whole(record), whole(wanted));
                for (a, (axis, wanted)) in record.axes.iter().zip(&wanted.axes).enumerate() {
                    for (q, quantity) in Quantity::ALL.iter().enumerate() {
                        let [value, wanted] =
                            [axis, wanted].map(|axis| quantity.of(axis).to_bits());
                        if asked.has(*quantity) {
                            assert_eq!(value, wanted, "{quantity:?} {a} cycle {i} cut {cut}");
                            assert_eq!(columns[a][q][i].to_bits(), wanted);
                        } else {
                            assert!(f64::from_bits(value).is_nan());
                        }
                    }
                }
            }
        }
    }
}

/// Columns that a trace leaves out by default repeat others in every cycle; where they would not, they are present.
#[test]
fn columns_that_repeat_others_do_so_in_every_cycle() {
    let two_masses = "kontur.axis[1].plant.model=TWO_MASS";
    // inputs may disturb any encoder
    let loads = "X_load_mm Y_load_mm Z_load_mm";
    let added = "X_load_mm X_add_mm Y_load_mm Z_load_mm";
    let cases: [(&[&str], &str, &str); 6] = [
        (&[], "", ""),
        (&[two_masses], "", "X_load_mm"),
        (&["X.antr.feed_const_num=2"], "", "X_load_mm"),
        (&["X.lr_param.add_interface.enable=1"], "", "X_add_mm"),
        (&["X.lr_param.add_interface.enable=1"], "t_s,X_add_mm\n0.05,0.1\n", added),
        (&[], "t_s,X_encoder_offset_mm\n0.05,0.1\n", loads),
    ];
    for (settings, inputs, expected) in cases {
        let inputs = Some(inputs).filter(|text| !text.is_empty());
        let mut run = start("G01 X10 F6000\nX0 Y3\nM30\n", settings, inputs);
        let all = columns::all(run.facts());
        let default = columns::select("default", run.facts()).unwrap();
        let records = records(&mut run);
        let differs = |name: &str, other: &str| {
            let [this, other] = [name, other].map(|n| all.iter().find(|c| c.name == n));
            let value = |c: Option<&columns::Column>, r| c.and_then(|c| c.number(r)).unwrap_or(0.0);
            records.iter().any(|r| value(this, r).to_bits() != value(other, r).to_bits())
        };
        for axis in ["X", "Y", "Z"] {
            let pairs = [("load", format!("{axis}_act_mm")), ("add", String::new())];
            for (word, other) in pairs {
                let name = format!("{axis}_{word}_mm");
                let shown = default.iter().any(|c| c.name == name);
                assert!(shown || !differs(&name, &other), "{name} {settings:?} {inputs:?}");
                let expected = expected.split(' ').any(|d| d == name);
                assert_eq!(shown, expected, "{name} {settings:?} {inputs:?}");
            }
        }
    }
}

/// Values that are left out are NaN, all others stay; where a block requires a tolerance nothing is left out.
#[test]
fn the_deviation_is_left_out_until_a_block_demands_a_tolerance() {
    let text = "#VIB GUARD ON [MODE=2 FREQ=20]\nG01 X5 F3000\nY5\nX0 Y0\n#VIB GUARD OFF\n\
                #VIB GUARD ON [MODE=2 FREQ=20 AX_DEV=0.05]\nX5\nY5\nX0 Y0\nM30\n";
    let start = || job(text, &[], Options::default()).start().unwrap();
    let whole = records(&mut start());
    let short = records(&mut start().without_deviation());
    assert_eq!(short.len(), whole.len());
    let measured = |r: &CycleRecord| {
        let of_axes = r.axes[..3].iter().flat_map(|a| [a.dev, a.dev_both_ways]);
        of_axes.chain([r.contour_err_mm]).collect::<Vec<f64>>()
    };
    let (mut left_out, mut largest) = (0, 0.0_f64);
    for (mut short, whole) in short.into_iter().zip(whole) {
        let found = measured(&short);
        if found.iter().all(|x| x.is_nan()) {
            assert!(whole.line < 7, "line {}", whole.line);
            left_out += 1;
        } else {
            assert_eq!(found, measured(&whole), "cycle {}", whole.k);
            largest = largest.max(whole.contour_err_mm);
        }
        for (short, whole) in short.axes.iter_mut().zip(&whole.axes) {
            (short.dev, short.dev_both_ways) = (whole.dev, whole.dev_both_ways);
        }
        short.contour_err_mm = whole.contour_err_mm;
        assert_eq!(short, whole);
    }
    assert!(left_out > 100 && largest > 0.01, "{left_out} {largest}");
}

/// Without the deviation in both directions the set points are still measured, and from the first block with a
/// tolerance on both are.
#[test]
fn the_set_points_are_measured_alone_until_a_block_demands_a_tolerance() {
    let text = "#VIB GUARD ON [MODE=2 FREQ=20]\nG01 X5 F3000\nY5\nG03 X0 Y0 I-2.5 J-2.5\n#VIB GUARD OFF\n\
                #VIB GUARD ON [MODE=2 FREQ=20 AX_DEV=0.05]\nG01 X5\nY5\nX0 Y0\nM30\n";
    let start = || job(text, &[], Options::default()).start().unwrap();
    let whole = records(&mut start());
    let mut left_out = 0;
    for (mut short, whole) in records(&mut start().without_both_ways()).into_iter().zip(whole) {
        if short.axes.iter().any(|a| a.dev_both_ways.is_nan()) {
            assert!(whole.line < 7, "line {}", whole.line);
            for (short, whole) in short.axes.iter_mut().zip(&whole.axes) {
                short.dev_both_ways = whole.dev_both_ways;
            }
            left_out += 1;
        }
        assert_eq!(short, whole);
    }
    assert!(left_out > 100, "{left_out}");
}
