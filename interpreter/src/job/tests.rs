mod selected;
mod structure;

use super::*;
use crate::record::{Asked, CycleRecord, Quantity, Rows};
use crate::source::MemorySources;
use kontur_filters::vib_guard::VibGuardSettings;

fn job(text: &str, settings: &[&str], options: Options) -> Job {
    let settings: Vec<String> = settings.iter().map(ToString::to_string).collect();
    let lists = MachineLists { settings: &settings, ..MachineLists::default() };
    let (machine, warnings) = lists.load().unwrap();
    let sources = MemorySources::new().with("main.nc", text);
    Job::new(machine, sources, "main.nc").with_warnings(warnings).with_options(options)
}

/// A run under real-time inputs, if there are any.
fn start(text: &str, settings: &[&str], inputs: Option<&'static str>) -> Run {
    let job = job(text, settings, Options::default());
    let files: Vec<_> = inputs.iter().map(|text| ("a.csv", || Ok(text.as_bytes()))).collect();
    job.start().unwrap().with_inputs(inputs::open(&files, job.machine()).unwrap())
}

fn records(run: &mut Run) -> Vec<CycleRecord> {
    let mut records = Vec::new();
    let Ok(()) = run.to_end(&mut |r: &CycleRecord| records.push(r.clone()));
    records
}

fn forced(settings: Option<VibGuardSettings>, ax_dev_mm: Option<f64>) -> Options {
    Options { guard: Some(ForcedGuard { settings, ax_dev_mm }), ..Options::default() }
}

/// A job and its run can be sent to another thread.
#[test]
fn jobs_and_runs_are_sent() {
    const fn sent<T: Send>() {}
    sent::<Job>();
    sent::<Run>();
}

/// A sink receives every cycle once, in order, with pauses in between, and can stop the run.
#[test]
fn one_loop_however_it_is_cut() {
    struct Stops {
        cycles: Vec<u64>,
        pauses: Vec<u64>,
        at: u64,
    }
    impl Sink for Stops {
        type Stop = u64;
        fn takes(&self, cycles: &[CycleRecord]) -> usize {
            let at = cycles.iter().position(|cycle| cycle.k == self.at);
            at.map_or(cycles.len(), |at| at + 1)
        }
        fn rows(&mut self, rows: &Rows<'_>) -> Result<(), u64> {
            self.cycles.extend(rows.cycles().iter().map(|cycle| cycle.k));
            if self.cycles.last() == Some(&self.at) { Err(self.at) } else { Ok(()) }
        }
        fn pause(&mut self, run: &mut Run) -> Result<(), u64> {
            self.pauses.push(run.record().k);
            Ok(())
        }
    }
    let start = || job("G01 X10 F100\nM30\n", &[], Options::default()).start().unwrap();
    let all = records(&mut start());
    assert!(all.len() as u64 > 3 * Run::STRETCH);
    let mut run = start();
    let mut sink = Stops { cycles: Vec::new(), pauses: Vec::new(), at: 1500 };
    assert_eq!(run.to_end(&mut sink), Err(1500));
    assert_eq!(sink.pauses, [Run::STRETCH - 1, 1500]);
    let mut few = Vec::new();
    let Ok(()) = run.advance(7, &mut |r: &CycleRecord| few.push(r.clone()));
    assert_eq!(few, all[1501..1508]);
    assert_eq!(run.to_end(&mut sink), Ok(()));
    let seen = (0..=1500).chain(1508..all.len() as u64);
    assert!(sink.cycles.into_iter().eq(seen) && run.is_over());
    assert_eq!(run.totals(), {
        let mut whole = start();
        records(&mut whole);
        whole.totals()
    });
}

/// A run on several threads gives the same bits and messages: with a tolerance from some block on, replanned by an
/// override, with messages in many blocks, ended by an error, by a fault of an axis or by a permanent standstill, and
/// where threads cannot be started. The same holds where the program reads the machine: positions, timers during
/// motions, measured values, and changed machine data.
#[test]
fn other_threads_change_nothing() {
    let guard = "#VIB GUARD ON [MODE=2 FREQ=20]\n";
    let square = "G01 X5 F3000\nY5\nX0 Y0\n";
    let talk = "$FOR P1 = 1, 400, 1\n#MSG [\"%d\", P1]\nX[P1 * 0.01]\n$ENDFOR\n";
    let tolerance =
        format!("{guard}{square}#VIB GUARD ON [AX_DEV=0.05]\n{square}G04 0.3\n{square}M30\n");
    let feedholds = "t_s,override_percent,feedhold\n0.05,40,\n0.3,90,1\n0.5,,0\n2,100,1\n";
    // many more steps than wait to be taken, each depending on positions or on a timer
    let asks = "$FOR P1 = 1, 40, 1\nX[V.A.ACT_POS.X + 0.1]\n$ENDFOR\n";
    let times = "$FOR P1 = 1, 900, 1\n#TIMER START SYN [ID=1]\nX[P1 * 0.02]\n#TIMER READ SYN [ID=1]\nY[V.G.TIMER[1] / 1000]\n#TIMER READ [ID=2]\nZ[V.G.TIMER[2] / 5000]\n$ENDFOR\n";
    let kv = "#MACHINE DATA [AX=X AXPARAM=\"getriebe[0].kv 3000\"]\n";
    let many = "$FOR P1 = 1, 3000, 1\nX[P1 * 0.01] Y[SIN[P1]]\n$ENDFOR\n";
    let measured = "G100 X10 Y20\nG01 X[V.A.MESS.X] Y0\n$IF V.A.MERF.X\nZ1\n$ENDIF\n";
    let lags = ["X.getriebe[0].slep_ueberw_typ=4", "X.getriebe[0].slep_max=30000"];
    let probes = ["X.kenngr.messachse=1", "Y.kenngr.messachse=1"];
    let programs: [(String, &[&str], Option<&str>); 12] = [
        (format!("{guard}{square}M30\n"), &[], None),
        (tolerance, &[], Some(feedholds)),
        (format!("{guard}#SLOPE [TYPE=HSC]\nG01 F6000\n{talk}M30\n"), &[], None),
        (
            format!("{guard}{square}G00 X1e6\n$IF V.A.ACT_POS.X > 1\nP1=1/0\n$ENDIF\nM30\n"),
            &[],
            None,
        ),
        ("G01 F1000\nX0\nM30\n".to_owned(), &[], None),
        ("G99\nM30\n".to_owned(), &[], None),
        (format!("G01 F6000\n{asks}#GET ACTPOS [P2=X]\nX[P2 + 1]\nM30\n"), &[], None),
        (format!("#TIMER START [ID=2]\nG01 F6000\n{times}M30\n"), &[], Some(feedholds)),
        (format!("G01 F6000\n{square}{kv}{square}M30\n"), &[], None),
        (format!("G01 F6000\n{many}G00 X300\n{many}M30\n"), &lags, None),
        (
            format!("#MEAS [TYPE=1]\nG01 F6000\n{measured}M30\n"),
            &probes,
            Some("t_s,X_probe_mm\n0,5\n"),
        ),
        (format!("G01 F6000\n{many}P1=1/V.A.ACT_POS.Z\n{many}M30\n"), &[], None),
    ];
    for (text, settings, inputs) in &programs {
        let start = || start(text, settings, *inputs);
        let outcome = |mut run: Run, how: &dyn Fn(&mut Run, &mut Vec<CycleRecord>)| {
            let mut records = Vec::new();
            how(&mut run, &mut records);
            let said = run.take_diagnostics();
            (records, said, run.totals(), run.record().clone(), run.is_over())
        };
        let alone = outcome(start(), &|run, records| {
            let Ok(()) = run.to_end(&mut |r: &CycleRecord| records.push(r.clone()));
        });
        for can_start in [&["program", "deviation"][..], &["program"], &["deviation"], &[]] {
            let thread = |name: &str, work: Work| {
                let spawn = || std::thread::Builder::new().name(name.to_owned()).spawn(work);
                can_start.contains(&name) && spawn().is_ok()
            };
            let together = outcome(start(), &|run, records| {
                let mut sink = |r: &CycleRecord| records.push(r.clone());
                let Ok(()) = run.advance(3, &mut sink);
                let Ok(()) = run.to_end_on_threads(thread, &mut sink);
            });
            assert!(alone == together, "{text}");
        }
    }
}

/// The program's thread ends when its run does, however that ends: a sink that stops, a run that is dropped while its
/// program waits for an answer, a program that is over long before the machine.
#[test]
fn the_programs_thread_ends_with_the_run() {
    struct Stops(u64);
    impl Sink for Stops {
        type Stop = ();
        fn rows(&mut self, rows: &Rows<'_>) -> Result<(), ()> {
            self.0 = self.0.saturating_sub(rows.len() as u64);
            if self.0 == 0 { Err(()) } else { Ok(()) }
        }
    }
    let many = "$FOR P1 = 1, 3000, 1\nX[P1 * 0.01]\n$ENDFOR\n";
    let asks = "$FOR P1 = 1, 3000, 1\nX[V.A.ACT_POS.X + 0.1]\n$ENDFOR\n";
    for text in [format!("{many}M30\n"), format!("{asks}M30\n"), "X100\nM30\n".to_owned()] {
        let mut threads = Vec::new();
        let mut run = job(&format!("G01 F600\n{text}"), &[], Options::default()).start().unwrap();
        let start = |_: &str, work: Work| {
            threads.push(std::thread::spawn(work));
            true
        };
        assert_eq!(run.to_end_on_threads(start, &mut Stops(100)), Err(()), "{text}");
        assert!(run.is_over());
        drop(run);
        assert_eq!(threads.len(), 2);
        for thread in threads {
            thread.join().unwrap();
        }
    }
}

/// A run whose program is lost with its thread ends with a message.
#[test]
fn a_lost_thread_is_reported() {
    let mut run = job("G01 X10 F600\nM30\n", &[], Options::default()).start().unwrap();
    let start = |name: &str, work: Work| {
        if name == "program" {
            // as if it had panicked
            drop(work);
        }
        name == "program"
    };
    let Ok(()) = run.to_end_on_threads(start, &mut |_: &CycleRecord| ());
    let said = run.take_diagnostics();
    assert!(run.totals().aborted && said.iter().any(Diagnostic::is_error), "{said:?}");
}

/// A run whose cycles are not read is at the same state at each pause, raises the same messages and ends alike: under
/// inputs, with faults of the axes among cycles in a row, with a tolerance from some block on, and divided into any
/// number of cycles.
#[test]
fn cycles_that_nobody_reads_are_driven_alike() {
    struct Pauses {
        reads: bool,
        records: Vec<CycleRecord>,
        said: Vec<Diagnostic>,
    }
    impl Sink for Pauses {
        type Stop = std::convert::Infallible;
        fn reads(&self) -> Option<Asked> {
            self.reads.then_some(Asked::ALL)
        }
        fn rows(&mut self, _: &Rows<'_>) -> Result<(), Self::Stop> {
            assert!(self.reads);
            Ok(())
        }
    }
    let guard = "#VIB GUARD ON [MODE=2 FREQ=20]\n";
    let square = "G01 X5 F3000\nY5\nX0 Y0\n";
    let talk = "$FOR P1 = 1, 200, 1\n#MSG [\"%d\", P1]\nX[P1 * 0.01] M3 S500\n$ENDFOR\n";
    let programs: [(String, &[&str], Option<&str>); 6] = [
        (format!("{guard}G135\n{square}{square}M30\n"), &[], None),
        (
            format!("{guard}{square}#VIB GUARD ON [AX_DEV=0.05]\n{square}G04 0.3\n{square}M30\n"),
            &[],
            None,
        ),
        (format!("{guard}G01 F6000 G261\n{talk}G60 X0\nM19 S.POS 30\nM30\n"), &[], None),
        // lags and accelerations above the permitted values
        (
            format!("{square}G00 X300 Y-200\nX0\nM30\n"),
            &[
                "X.getriebe[0].slep_ueberw_typ=4",
                "X.getriebe[0].slep_max=30000",
                "Y.kenngr.dyn_monitoring_a_warn=1",
            ],
            None,
        ),
        (
            format!("{guard}{square}G01 X400 F9000\nY100\nM30\n"),
            &[],
            Some(
                "t_s,override_percent,feedhold,Y_force_mm_s2\n0.05,40,,\n0.3,90,1,500\n0.5,,0,\n2,100,1,\n2.5,,0,0\n",
            ),
        ),
        ("G01 X50 F1000\nP1=1/0\nM30\n".to_owned(), &[], None),
    ];
    for (text, settings, inputs) in &programs {
        let drive = |reads: bool, stretch: u64| {
            let mut run = start(text, settings, *inputs).without_deviation();
            let mut sink = Pauses { reads, records: Vec::new(), said: Vec::new() };
            while !run.is_over() {
                let Ok(()) = run.advance(stretch, &mut sink);
                sink.records.push(run.record().clone());
                sink.said.extend(run.take_diagnostics());
            }
            (format!("{:?}", sink.records), sink.said, run.totals())
        };
        for stretch in [1, 7, 300, Run::STRETCH] {
            assert!(drive(true, stretch) == drive(false, stretch), "{text} {stretch}");
        }
    }
}

/// A check that is stopped from elsewhere returns at once even if the program has no end; a stopped run has no more
/// cycles.
#[test]
fn a_stop_ends_check_and_run() {
    let stop = Stop::default();
    let options = Options { stop: stop.clone(), ..Options::default() };
    let endless = job("$WHILE 1\nX1 F1000\nX0\n$ENDWHILE\nM30\n", &[], options.clone());
    let check = std::thread::spawn(move || endless.check());
    let mut run = job("G01 X50 F60\nM30\n", &[], options).start().unwrap();
    let mut cycles = 0;
    let Ok(()) = run.advance(500, &mut |_: &CycleRecord| cycles += 1);
    assert!(!run.totals().aborted);
    stop.set();
    check.join().unwrap();
    let Ok(()) = run.to_end(&mut |_: &CycleRecord| cycles += 1);
    assert_eq!(cycles, 500);
    assert!(run.is_over() && run.totals().aborted);
}

/// A refused program has the diagnostics of the check, no cycles, and is aborted; the warnings of the lists come first.
#[test]
fn a_refused_program_does_not_move() {
    let settings = ["X.getriebe[0].kv=3000", "X.getriebe[0].kv=2000"];
    let job = job("X1 F100\nG7\nM30\n", &settings, Options::default());
    let mut run = job.start().unwrap();
    assert_eq!(records(&mut run), []);
    assert!(run.totals().aborted && run.is_over());
    let said = run.take_diagnostics();
    assert_eq!(said, job.check().diagnostics);
    assert_eq!(said[0].id, Condition::ListDuplicate);
    assert!(said.iter().any(Diagnostic::is_error));
}

/// A forced guard acts like the guard of the lists under a program that does not command one.
#[test]
fn a_forced_guard_takes_the_place_of_lists_and_words() {
    let settings = VibGuardSettings { mode: 2, freq_hz: 38.0, damping: 0.05 };
    let square = |on: &str| format!("{on}\nG01 X1 F4000\nY1\nX0\n#VIB GUARD OFF\nY0\nM30\n");
    let listed: Vec<String> = ["X", "Y", "Z"]
        .iter()
        .flat_map(|a| {
            ["active=1", "mode=2", "freq=38", "damping=0.05"].map(|s| format!("{a}.vib_guard.{s}"))
        })
        .collect();
    let listed: Vec<&str> = listed.iter().map(String::as_str).collect();
    let run = |text: &str, settings: &[&str], options| {
        let mut run = job(text, settings, options).start().unwrap();
        let all = records(&mut run);
        assert!(!run.totals().aborted, "{:?}", run.take_diagnostics());
        all
    };
    let none = Options::default;
    for (program, same) in [
        ("", ""),
        ("#VIB GUARD ON", "#VIB GUARD ON"),
        ("#VIB GUARD ON [MODE=4 FREQ=20 DAMPING=0.2]", "#VIB GUARD ON"),
        (
            "P1=3\n#VIB GUARD ON [MODE=P1 FREQ=[P1*10] AX_DEV=0.02]",
            "P1=3\n#VIB GUARD ON [AX_DEV=0.02]",
        ),
    ] {
        let is = run(&square(program), &[], forced(Some(settings), None));
        assert!(is == run(&square(same), &listed, none()), "{program}");
        let tolerant = run(&square(program), &[], forced(Some(settings), Some(0.03)));
        let same = if same.contains("AX_DEV") { same } else { "#VIB GUARD ON [AX_DEV=0.03]" };
        assert!(tolerant == run(&square(same), &listed, none()), "{program} within 0.03 mm");
    }
    // off, whatever the lists say
    let plain = "G01 X1 F4000\nY1\nM30\n";
    assert!(run(plain, &listed, forced(None, None)) == run(plain, &[], none()));
    assert!(run(plain, &listed, none()) != run(plain, &[], none()));
}

/// Settings without a kernel refuse the run, which would otherwise run without the requested guard.
#[test]
fn a_forced_guard_that_cannot_be_is_an_error() {
    for (mode, freq_hz, id) in [(5, 40.0, Condition::GuardMode), (2, 0.1, Condition::GuardRange)] {
        let settings = VibGuardSettings { mode, freq_hz, ..VibGuardSettings::default() };
        let mut run = job("X1 F100\nM30\n", &[], forced(Some(settings), None)).start().unwrap();
        assert_eq!(records(&mut run), []);
        let said = run.take_diagnostics();
        assert!(said.iter().any(|d| d.is_error() && d.id == id), "{said:?}");
    }
}

/// First commands of each kind in the order of execution, with their positions; commands that are not reached are
/// absent.
#[test]
fn a_check_tells_what_the_program_says_about_the_guard() {
    let guard = |text: &str| job(text, &[], Options::default()).check().guard;
    assert_eq!(
        guard("N10 G1 X1 F100 (#VIB GUARD ON [MODE=2])\n; #VIB GUARD ON\nM30\n"),
        GuardCommands::default()
    );
    let text = "%L SUB\n#VIB GUARD [FREQ=[10*4]]\nM17\n%MAIN\n$IF 0\n#VIB GUARD OFF\n$ENDIF\n\
                N1 #vib guard on[AX_DEV 0.01 ,ACC_FACT=2]\nX1 F100\nLL SUB\n#VIB GUARD ON [AX_DEV=0.5]\nM30\n";
    let said = guard(text);
    let line = |place: &Option<crate::diag::Location>| place.as_ref().map(|p| p.line);
    assert_eq!((line(&said.on), line(&said.off), line(&said.settings)), (Some(8), None, Some(2)));
    assert_eq!(said.ax_dev.map(|(place, value)| (place.line, value)), Some((8, 0.01)));
}
