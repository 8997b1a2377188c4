//! An engine without a simulation: a square of 1 mm driven three times, with numbers that are easy to judge.
//!
//! Pass 1 slows down in the corners, pass 2 cuts them, pass 3 is not smoothed. A program whose name holds `slow` has
//! half the feed in its last edge, `late` starts two cycles later, `bad` is aborted half way.
//!
//! Settings `X.vib_guard.*` put a real kernel in the place of the two taps, as an axis list would; a program whose name
//! holds `stubborn` goes on with its own.

use kontur::engine::{AxisFacts, Engine, Facts, FileNames, OpenError, Request, Source, Totals};
use kontur_filters::kernel::{Kernel, Tap};
use kontur_filters::time::CycleTime;
use kontur_filters::vib_guard::VibGuardSettings;
use kontur_interpreter::diag::{Condition, Diagnostic, Location, ValueKind};
use kontur_interpreter::record::{AxisRecord, CycleRecord, PathRecord, SpeedLimit};
use std::collections::VecDeque;

const CYCLE_S: f64 = 1e-3;
const ACC: f64 = 4000.0;
const VERTICES: [[f64; 2]; 5] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [0.0, 0.0]];

#[derive(Debug, Default)]
pub(crate) struct Synthetic;

#[derive(Debug)]
struct Square {
    program: std::path::PathBuf,
    facts: Facts,
    rows: VecDeque<CycleRecord>,
    now: CycleRecord,
    messages: Vec<Diagnostic>,
    bad: bool,
    delay_cycles: f64,
}

/// The kernel that the settings ask for; without any: two taps, 12 ms apart, what a guard does to a corner.
fn kernel(settings: &[String]) -> Kernel {
    let value = |key: &str| {
        let wanted = format!("X.vib_guard.{key}=");
        settings.iter().rev().find_map(|s| s.strip_prefix(&wanted)?.parse::<f64>().ok())
    };
    let guard = VibGuardSettings {
        mode: (1..=4).find(|m| value("mode") == Some(f64::from(*m))).unwrap_or(1),
        freq_hz: value("freq").unwrap_or(30.0),
        damping: value("damping").unwrap_or(0.1),
    };
    match value("active") {
        None => Kernel::from_taps([0, 12].map(|delay| Tap { delay, weight: 0.5 })).unwrap(),
        Some(on) if on > 0.0 => guard.kernel(CycleTime::DEFAULT).unwrap(),
        Some(_) => Kernel::identity(),
    }
}

/// Distance from a point to the square's outline, as a vector.
fn deviation(p: [f64; 2]) -> [f64; 2] {
    let mut best = [f64::MAX; 2];
    for w in VERTICES.windows(2) {
        let d = [w[1][0] - w[0][0], w[1][1] - w[0][1]];
        let u = ((p[0] - w[0][0]) * d[0] + (p[1] - w[0][1]) * d[1]).clamp(0.0, 1.0);
        let e = [p[0] - w[0][0] - u * d[0], p[1] - w[0][1] - u * d[1]];
        if e[0] * e[0] + e[1] * e[1] < best[0] * best[0] + best[1] * best[1] {
            best = e;
        }
    }
    best
}

/// Path position and speed per cycle over four edges of 1 mm, `corner` mm/s in the corners.
fn drive(feed: f64, corner: f64, last_feed: f64) -> Vec<(f64, f64)> {
    let (mut s, mut v, mut rows) = (0.0, 0.0_f64, Vec::new());
    while s < 4.0 - 1e-9 && rows.len() < 5000 {
        let edge = libm::floor(s + 1e-9).min(3.0);
        let left = edge + 1.0 - s;
        let exit = if edge < 3.0 { corner } else { 0.0 };
        let feed = if edge < 3.0 { feed } else { last_feed };
        let brake = (exit * exit + 2.0 * ACC * left).max(0.0).sqrt();
        v = (v + ACC * CYCLE_S).min(feed).min(brake).max(0.5);
        s = (s + v * CYCLE_S).min(4.0);
        rows.push((s, v));
    }
    rows.push((4.0, 0.0));
    rows
}

fn square(slow: bool, late: bool, bad: bool, kernel: &Kernel) -> VecDeque<CycleRecord> {
    let last = if slow { 20.0 } else { 60.0 };
    let mut ipo: Vec<([f64; 2], f64, f64, u32, bool)> = Vec::new();
    ipo.extend((0..if late { 3 } else { 1 }).map(|_| ([0.0; 2], 0.0, 0.0, 0, false)));
    for (pass, corner) in [(0_u32, 4.0), (1, 60.0), (2, 15.0)] {
        for (s, v) in drive(60.0, corner, last) {
            let edge = [1.0, 2.0, 3.0].iter().filter(|&&corner| s > corner).count();
            let line = [4, 5, 6, 7][edge] + pass * 5;
            let (a, b, u) = (VERTICES[edge], VERTICES[edge + 1], s - edge as f64);
            let p = [a[0] + u * (b[0] - a[0]), a[1] + u * (b[1] - a[1])];
            ipo.push((p, v, f64::from(pass) * 4.0 + s, line, pass < 2));
        }
        for _ in 0..30.max(kernel.length() + 1) {
            let line = 7 + pass * 5;
            ipo.push(([0.0; 2], 0.0, f64::from(pass + 1) * 4.0, line, pass < 2));
        }
    }
    if bad {
        ipo.truncate(100);
    }
    let mut act = [0.0; 2];
    let mut before = [[0.0; 2]; 2];
    let rows = (0..ipo.len()).map(|k| {
        let (p, v, s, line, guard) = ipo[k];
        let past = |tap: &Tap, i: usize| {
            let before = k.checked_sub(tap.delay as usize).map_or(0.0, |k| ipo[k].0[i]);
            tap.weight * before
        };
        let shaped = |i: usize| kernel.taps().iter().map(|tap| past(tap, i)).sum::<f64>();
        let set = [0, 1].map(|i| if guard { shaped(i) } else { p[i] });
        let dev = deviation(set);
        let axes = [0, 1].map(|i| {
            let vel = (set[i] - before[0][i]) / CYCLE_S;
            let acc = (set[i] - 2.0 * before[0][i] + before[1][i]) / CYCLE_S / CYCLE_S;
            act[i] += 50.0 * CYCLE_S * (set[i] - act[i]);
            AxisRecord {
                ipo: p[i],
                set: set[i],
                vel,
                acc,
                dev: dev[i],
                dev_both_ways: dev[i].abs(),
                reference: set[i],
                act: act[i],
                load: act[i],
                lag: set[i] - act[i],
                ..AxisRecord::default()
            }
        });
        before = [set, before[0]];
        CycleRecord {
            k: k as u64,
            file: 0,
            line,
            block: (line > 0).then_some(u64::from(line) * 10),
            path: PathRecord {
                s_mm: s,
                v_mm_s: v,
                limit: if v >= 60.0 { SpeedLimit::Feed } else { SpeedLimit::Corner },
                ..PathRecord::default()
            },
            contour_err_mm: libm::hypot(dev[0], dev[1]),
            axes: axes.to_vec(),
        }
    });
    rows.collect()
}

impl Engine for Synthetic {
    fn open(&self, request: &Request) -> Result<Box<dyn Source>, OpenError> {
        if let Err(e) = std::fs::metadata(&request.program) {
            return Err(OpenError::Io(request.program.clone(), e));
        }
        let name = request.program.file_name().unwrap().to_string_lossy().into_owned();
        let (slow, late, bad) =
            (name.contains("slow"), name.contains("late"), name.contains("bad"));
        let axis = |name: &str| AxisFacts { name: name.to_owned(), ..AxisFacts::default() };
        let facts = Facts {
            program: name.clone(),
            machine: "xyz".to_owned(),
            cycle_us: 1000,
            axes: vec![axis("X"), axis("Y")],
            files: FileNames::new(vec![name.clone()], false),
        };
        let mut messages = Vec::new();
        if bad {
            let place = Location {
                file: name.as_str().into(),
                line: 6,
                column: 5,
                offset: 61,
                length: 4,
                block: Some(60),
                text: "N60 G777 X0".into(),
            };
            messages.push(
                Diagnostic::new(Condition::GUnknown, "unknown G function").at(place).value(
                    ValueKind::Current,
                    777.0,
                    "-",
                ),
            );
        }
        let stubborn = name.contains("stubborn");
        let kernel = kernel(if stubborn { &[] } else { &request.settings });
        let rows = square(slow, late, bad, &kernel);
        let delay_cycles = kernel.delay_cycles();
        let now = CycleRecord::default();
        let program = request.program.clone();
        Ok(Box::new(Square { program, facts, rows, now, messages, bad, delay_cycles }))
    }

    fn check(
        &self,
        request: &Request,
        report: &mut dyn FnMut(Diagnostic),
    ) -> Result<(), OpenError> {
        let mut source = self.open(request)?;
        source.take_diagnostics().into_iter().for_each(report);
        Ok(())
    }

    fn explain(&self, thing: &str) -> Result<String, Vec<String>> {
        match thing {
            "#VIB GUARD" => Ok("smooths the setpoints".to_owned()),
            _ => kontur_interpreter::explain::explain(thing)
                .map(|found| found.to_string())
                .map_err(|_| vec!["#VIB GUARD".to_owned()]),
        }
    }
}

impl Source for Square {
    fn facts(&self) -> &Facts {
        &self.facts
    }

    fn reads(&self) -> Vec<std::path::PathBuf> {
        vec![self.program.clone()]
    }

    fn next_cycle(&mut self) -> Option<&CycleRecord> {
        self.now = self.rows.pop_front()?;
        Some(&self.now)
    }

    fn take_diagnostics(&mut self) -> Vec<Diagnostic> {
        std::mem::take(&mut self.messages)
    }

    fn totals(&self) -> Totals {
        Totals {
            aborted: self.bad,
            blocks: 12,
            ideal_duration_s: 0.2,
            not_counted: vec!["M3".to_owned()],
            filter_delay_cycles: vec![self.delay_cycles; 2],
            ..Totals::default()
        }
    }
}
