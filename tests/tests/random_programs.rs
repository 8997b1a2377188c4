//! Damaged programs: the sample programs and the programs of `suite/faults` with tokens deleted, doubled, swapped and replaced, and with
//! changed numbers. In every case the parser and a whole run end without a panic and with finite numbers, and a program that is refused
//! or aborted says why.
//!
//! `COUNT` raises the number of programs, `SEED` selects others.

use kontur_interpreter::diag::{Condition, Diagnostic, Location};
use kontur_interpreter::job::{Job, Options};
use kontur_interpreter::machine::{Machine, Override};
use kontur_interpreter::record::{AxisRecord, CycleRecord};
use kontur_interpreter::source::MemorySources;
use kontur_kit::{Random, count, seed};
use kontur_tests::{programs, sample_machine};
use std::path::Path;
use std::sync::Arc;

/// Number of programs by default.
const COUNT: usize = 150;

/// Longest sample, in bytes, that is worth damaging.
const LONGEST: usize = 6000;

/// Limit of the cycles of a run: 2 s of program time.
const TIME_S: f64 = 2.0;

/// Programs that run, and programs that are refused.
struct Corpus {
    good: Vec<Vec<String>>,
    bad: Vec<Vec<String>>,
}

impl Corpus {
    /// Three out of four are good.
    fn pick<'a>(&'a self, random: &mut Random) -> &'a [String] {
        let list = if random.below(4) == 0 { &self.bad } else { &self.good };
        &list[random.below(list.len())]
    }
}

fn texts(folder: &Path) -> Vec<String> {
    let mut files: Vec<_> =
        std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.sort();
    let programs = files.iter().filter(|f| f.extension().is_some_and(|e| e == "nc"));
    let texts = programs.map(|f| String::from_utf8_lossy(&std::fs::read(f).unwrap()).into_owned());
    texts.filter(|text| text.len() < LONGEST).collect()
}

/// Samples, lines that combine rare functions, and the smallest programs for the messages.
fn corpus() -> Corpus {
    let suite = Path::new(env!("CARGO_MANIFEST_DIR")).join("suite/faults");
    let mut bad = texts(&suite);
    bad.extend(texts(&programs().join("fail")));
    assert!(bad.len() > 100);
    let mut good = texts(&programs());
    good.extend(
        [
            include_str!("../../interpreter/tests/data/squares.nc"),
            "V.G.WZ[1].R=2\nD1 G41 G01 X10 F6000\nX30 Y5\nG03 X30 Y25 J10\nX10\nG40 X0 Y0\nM30\n",
            "#CONTOUR MODE [DIST PRE_DIST=1 POST_DIST=2]\nG261 F6000\nX10\nY10\nG02 X20 Y0 I5\nG260\nM30\n",
            "#HSC ON [BSPLINE PATH_DEV=0.05]\nG01 F6000\nX1 Y0.1\nX2 Y0.3\nX3 Y0\nX4 Y0.2\n#HSC OFF\nM30\n",
            "#SLOPE [TYPE=HSC NO_OPT=0]\n#VIB GUARD ON [MODE=3 FREQ=40 AX_DEV=0.01]\nG01 X10 F6000\nY10\nX0 Y0\nM30\n",
            "G93 F0.5 X10\nG95 S1000 M3 F0.1 X0\nG194 F50 Y10\nG94 F3000 Y0 E500\nM30\n",
            "S[M3 REV1000]\nG04 S5\nS[POS=45 M19]\nX5 F2000 G135 G136 X80\nG137\nM30\n",
            "#CS ON [1,2,3,0,0,30]\nG01 X5 F2000\n#ROTATION ON [ANGLE=20]\nG02 X10 I2.5\n#CS OFF ALL\nM30\n",
            "X5 F2000\nG301 I1\nY5\nG302 I0.5 X0\nG91 G60 X-1 Z2\nG18 G03 Z-2 K-1\nM30\n",
        ]
        .map(str::to_owned),
    );
    let split = |texts: &[String]| texts.iter().map(|text| tokens(text)).collect();
    Corpus { good: split(&good), bad: split(&bad) }
}

/// Words and numbers, runs of blanks, single characters.
fn tokens(text: &str) -> Vec<String> {
    let class = |c: char| match c {
        _ if c.is_ascii_digit() || c == '.' => 1,
        _ if c.is_alphabetic() || c == '_' => 2,
        ' ' => 3,
        _ => 0,
    };
    let mut tokens: Vec<String> = Vec::new();
    let mut last = 0;
    for c in text.chars() {
        match tokens.last_mut() {
            Some(token) if class(c) != 0 && class(c) == last => token.push(c),
            _ => tokens.push(c.to_string()),
        }
        last = class(c);
    }
    tokens
}

const NUMBERS: &[&str] = &[
    "0",
    "1",
    "-1",
    "0.0001",
    "1e9",
    "2147483648",
    "-0",
    "0.5",
    "90",
    "100",
    "360",
    "1000000",
    "4294967296",
    "0.00000000000001",
    "99999999999999999999",
    ".",
    "65536",
    "3",
    "10",
];

fn number(random: &mut Random, token: &str) -> String {
    let value: f64 = token.parse().unwrap_or(1.0);
    match random.below(6) {
        0 => NUMBERS[random.below(NUMBERS.len())].to_owned(),
        1 => format!("-{token}"),
        2 => format!("{}", value * 10.0),
        3 => format!("{}", value * 1e-4),
        4 => format!("{}", value + 1.0),
        _ => format!("{token}{token}"),
    }
}

fn is_number(token: &str) -> bool {
    token.starts_with(|c: char| c.is_ascii_digit())
}

/// One program of the corpus, damaged.
fn damaged(random: &mut Random, corpus: &Corpus) -> String {
    let mut program = corpus.pick(random).to_vec();
    for _ in 0..=random.below(4) {
        if program.is_empty() {
            break;
        }
        let at = random.below(program.len());
        match random.below(9) {
            0 => {
                program.remove(at);
            }
            1 => {
                let token = program[at].clone();
                program.insert(at, token);
            }
            2 => {
                let other = random.below(program.len());
                program.swap(at, other);
            }
            3..=5 => {
                let numbers: Vec<usize> =
                    (0..program.len()).filter(|i| is_number(&program[*i])).collect();
                if !numbers.is_empty() {
                    let at = random.pick(&numbers);
                    program[at] = number(random, &program[at]);
                }
            }
            6 => {
                let donor = corpus.pick(random);
                program[at] = donor[random.below(donor.len())].clone();
            }
            7 => {
                // some lines of another program
                let donor = corpus.pick(random).concat();
                let lines: Vec<&str> = donor.lines().collect();
                let first = random.below(lines.len());
                let some = lines[first..].iter().take(1 + random.below(4));
                let some: String = some.map(|line| format!("\n{line}\n")).collect();
                program.insert(at, some);
            }
            _ => program.truncate(at),
        }
    }
    program.concat()
}

/// A place that a reader can find: inside the text, with lines counted from 1.
fn check_place(at: &Location, text: &str) {
    if &*at.file != "part.nc" {
        return;
    }
    assert!(at.line >= 1 && at.column >= 1, "{at:?}");
    assert!(at.offset <= text.len() as u64, "{at:?}");
    assert!(at.column as usize <= at.text.chars().count() + 1, "{at:?}");
}

fn check_said(found: &[Diagnostic], text: &str) {
    for diagnostic in found {
        assert!(diagnostic.id != Condition::Internal, "internal error: {diagnostic:?}");
        assert!(!diagnostic.text.is_empty());
        if let Some(at) = &diagnostic.source {
            check_place(at, text);
        }
    }
}

fn check_record(axis: &AxisRecord) {
    let values = [
        axis.ipo,
        axis.set,
        axis.vel,
        axis.acc,
        axis.jerk,
        axis.err,
        axis.dev,
        axis.ff,
        axis.cmd,
        axis.vadd,
        axis.reference,
        axis.act,
        axis.load,
        axis.lag,
        axis.add,
        axis.tcp,
        axis.tcp_acc,
        axis.cmd_drive,
        axis.vff_drive,
        axis.vadd_drive,
        axis.torque_drive,
        axis.torque_n_m,
    ];
    assert!(values.iter().all(|x| x.is_finite()), "{axis:?}");
}

/// Check and run of one program; true if it moved.
fn exercise(text: &str, machine: &Arc<Machine>) -> bool {
    let cycle = "N10 G91 X@P1\nN20 M17\n";
    let sources = MemorySources::new()
        .with("part.nc", text.as_bytes().to_vec())
        .with("called/cycle.nc", cycle.as_bytes().to_vec());
    let options = Options {
        max_blocks: 3000,
        max_blocks_at_rest: 1000,
        max_time_s: TIME_S,
        ..Options::default()
    };
    let job = Job::new(Arc::clone(machine), sources, "part.nc").with_options(options);
    check_said(&job.check().diagnostics, text);
    let mut run = job.start().unwrap();
    let mut cycles = 0_u64;
    let Ok(()) = run.to_end(&mut |record: &CycleRecord| {
        record.axes.iter().for_each(check_record);
        assert!(record.contour_err_mm.is_finite());
        let path = record.path;
        assert!([path.s_mm, path.v_mm_s, path.a_mm_s2, path.j_mm_s3].iter().all(|x| x.is_finite()));
        assert_eq!(record.k, cycles);
        cycles += 1;
        assert!(cycles as f64 * machine.cycle.seconds() < TIME_S + 20.0, "the run does not end");
    });
    let said = run.take_diagnostics();
    check_said(&said, text);
    if run.totals().aborted {
        assert!(said.iter().any(Diagnostic::is_error), "aborted without an error: {said:?}");
    }
    cycles > 1
}

#[test]
fn damaged_programs_end() {
    let (count, seed) = (count(COUNT) as u64, seed());
    let corpus = corpus();
    let filters = "X.filter[0].enable=1 X.filter[0].order=2 X.filter[0].fg_f0=30";
    let filters: Vec<&str> = filters.split(' ').collect();
    let machines = [
        sample_machine("xyz", &[]),
        sample_machine("xyz", &filters),
        sample_machine("vendor_defaults", &[]),
        sample_machine("xyz_hsc", &[]),
        sample_machine("two_spindles", &[]),
    ]
    .map(|(machine, _)| Arc::new(machine));
    let mut moved = 0;
    for i in 0..count {
        let mut random = Random::new(seed.wrapping_mul(1_000_003).wrapping_add(i));
        let text = damaged(&mut random, &corpus);
        let machine = &machines[random.below(machines.len())];
        let outcome = std::panic::catch_unwind(|| exercise(&text, machine));
        match outcome {
            Ok(runs) => moved += u64::from(runs),
            Err(panic) => {
                eprintln!("SEED={seed}, program {i} on {}:\n{text}", machine.name);
                std::panic::resume_unwind(panic);
            }
        }
    }
    // damaging leaves enough programs that run
    assert!(moved > count / 8, "{moved} of {count}");
}

/// Settings of the command line are also texts written by the user.
#[test]
fn damaged_settings_are_refused_or_taken() {
    let mut random = Random::new(seed());
    let good = [
        "X.getriebe[0].kv=5000",
        "channel.prog_start.slope.profile=1",
        "kontur.cycle_time_us=1000",
    ];
    for _ in 0..count(COUNT) {
        let mut tokens = tokens(good[random.below(good.len())]);
        let at = random.below(tokens.len());
        match random.below(3) {
            0 => drop(tokens.remove(at)),
            1 => tokens[at] = random.pick(NUMBERS).to_owned(),
            _ => tokens.insert(at, random.pick(&["[", "]", ".", "=", "-", "kv"]).to_owned()),
        }
        let text = tokens.concat();
        if let Ok(setting) = Override::parse(&text) {
            let _ = Machine::builtin(&[setting]);
        }
    }
}
