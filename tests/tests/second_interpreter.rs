//! A second interpreter, for a part of the language, compared with the first one on random programs.
//!
//! A random program is a tree. It is written as text, which kontur runs, and executed on the tree by a model that shares no code with
//! kontur. In every cycle the interpolated position must be that of the model at the same path length and in the same block; the end
//! points and the lengths of the whole path must agree.
//!
//! `COUNT` raises the number of programs, `SEED` selects others.

mod changes;
mod contours;
mod expressions;
mod map;
mod model;
mod motions;
mod offset;
mod path;
mod random;
mod scaling;
mod spline;
mod text;
mod tree;

use kontur_interpreter::job::{Job, Options};
use kontur_interpreter::record::CycleRecord;
use kontur_interpreter::source::MemorySources;
use kontur_kit::{Random, count, seed};
use kontur_tests::machine;
use model::Model;
use std::sync::Arc;

/// Number of programs by default.
const COUNT: usize = 150;

/// Longer programs show nothing more.
const MOTIONS_MAX: usize = 150;

/// Tolerance of positions and path lengths in mm.
const NEAR: f64 = 1e-6;

/// Axes with a range that reaches everywhere, and room for the texts of macros: these programs are about neither.
const SETTINGS: &[&str] = &[
    "X,Y,Z.kenngr.swe_neg=-100000000",
    "X,Y,Z.kenngr.swe_pos=100000000",
    "channel.configuration.decoder.macro_nc_code_len=1024",
];

#[test]
fn random_programs_mean_the_same() {
    let machine = Arc::new(machine(SETTINGS).0);
    let (mut pieces, mut compared) = (0, 0);
    let count = count(COUNT) as u64;
    for i in 0..count {
        let mut random = Random::new(seed().wrapping_mul(1_000_003).wrapping_add(i));
        let program = random::program(&mut random);
        let mut model = Model::new(&program);
        let end = model.run();
        if model.driven.pieces.len() > MOTIONS_MAX {
            continue;
        }
        pieces += model.driven.pieces.len();
        compared += 1;
        let (files, places) = text::written(&program);
        let listing = || {
            let numbered = |text: &str| -> String {
                text.lines().enumerate().map(|(i, l)| format!("{:4} {l}\n", i + 1)).collect()
            };
            let all: String = files
                .iter()
                .map(|(name, text)| format!("--- {name}\n{}", numbered(text)))
                .collect();
            format!("{all}SEED={} program {i}", seed())
        };
        let mut sources = MemorySources::new();
        for (name, text) in &files {
            sources = sources.with(name, text.as_bytes().to_vec());
        }
        let options = Options { max_time_s: 10_000.0, ..Options::default() };
        let mut run = Job::new(Arc::clone(&machine), sources, text::MAIN)
            .with_options(options)
            .start()
            .unwrap();
        let names = run.facts().files.clone();
        let mut wrong = None;
        let mut last = None;
        let Ok(()) = run.to_end(&mut |record: &CycleRecord| {
            let at: [f64; 3] = std::array::from_fn(|axis| record.axes[axis].ipo);
            last = Some((at, record.path.s_mm));
            let Some((piece, way)) = model.driven.find(record.path.s_mm) else { return };
            let share = if piece.length > 0.0 { (way / piece.length).min(1.0) } else { 1.0 };
            let expected = piece.at(share);
            let off = (0..3).map(|axis| (at[axis] - expected[axis]).abs()).fold(0.0, f64::max);
            let inside = way > NEAR && way < piece.length - NEAR;
            let place = (names.name(record.file), record.line);
            let elsewhere = inside && places[&piece.number] != place;
            if wrong.is_none() && (off > NEAR || elsewhere) {
                wrong = Some(format!(
                    "s {}: at {at:?} in {place:?}, expected {expected:?} in N{} {:?}",
                    record.path.s_mm, piece.number, places[&piece.number],
                ));
            }
        });
        let said: Vec<String> = run
            .take_diagnostics()
            .into_iter()
            .filter(|d| d.is_error())
            .map(|d| format!("{} {} {:?}", d.id, d.text, d.source.map(|s| (s.file, s.line))))
            .collect();
        if model.narrow {
            let refuses =
                |said: &String| said.contains("too tight") || said.contains("too large for");
            let refused = said.first().is_some_and(refuses);
            assert!(refused, "{}\n{said:#?}", listing());
            continue;
        }
        assert!(said.is_empty(), "{}\n{said:#?}", listing());
        assert!(wrong.is_none(), "{}\n{}", listing(), wrong.unwrap_or_default());
        let (at, length) = last.unwrap_or_default();
        let off = (0..3).map(|axis| (at[axis] - end[axis]).abs()).fold(0.0, f64::max);
        let longer = (length - model.driven.length).abs();
        assert!(
            off < NEAR && longer < NEAR,
            "{}\nends at {at:?} after {length}, expected {end:?} after {}",
            listing(),
            model.driven.length
        );
    }
    eprintln!("{compared} of {count} programs, {pieces} motions");
    assert!(compared * 4 > count * 3, "{compared} of {count}");
}
