//! Blocks per second through the parser and through the decoder: short straight blocks, as a CAM system writes them.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use kontur_interpreter::job::Job;
use kontur_interpreter::machine::Machine;
use kontur_interpreter::source::{MemorySources, RawBlock};
use kontur_interpreter::syntax::Parser;
use std::fmt::Write;
use std::hint::black_box;
use std::sync::Arc;

const BLOCKS: u32 = 20_000;

/// Rows of a wavy surface.
fn program() -> String {
    let mut text = String::from("%WAVES\nG71 G90\nG01 F3000 X0 Y0 Z0\n");
    for i in 0..BLOCKS {
        let (row, column) = (i / 250, i % 250);
        let along = f64::from(if row % 2 == 0 { column } else { 249 - column }) * 0.2;
        let across = f64::from(row) * 0.3;
        let z = 2.0 * libm::sin(along * 0.3) * libm::cos(across * 0.2);
        // writing into a string cannot fail
        let _ = writeln!(text, "N{i} X{along:.4} Y{across:.4} Z{z:.4}");
    }
    text + "M30\n"
}

fn parse(c: &mut Criterion) {
    let parser = Parser::new([]);
    let file = Arc::from("waves.nc");
    let mut group = c.benchmark_group("parse");
    group.throughput(Throughput::Elements(1));
    // the last one has the same words and goes through the grammar
    let lines =
        [("plain", "N10 X12.6000 Y0.3000 Z-1.2345"), ("grammar", "N10 X=12.6 Y=0.3 Z=-1.2")];
    for (name, line) in lines {
        let raw = RawBlock::from_line(line);
        let mut diagnostics = Vec::new();
        group.bench_function(name, |b| {
            b.iter(|| parser.block(black_box(&raw), &file, &mut diagnostics));
        });
    }
    group.finish();
}

/// Nested brackets: the time per character is the same at any length and depth.
fn brackets(c: &mut Criterion) {
    let parser = Parser::new([]);
    let file = Arc::from("brackets.nc");
    let mut group = c.benchmark_group("brackets");
    for depth in [8, 32] {
        for length in [512, 4096] {
            // lists that are never closed, brackets that are not lists, and indices
            for (name, level) in [("open", "[A "), ("closed", "[1-"), ("index", "V.P.A.5[")] {
                let unit = match name {
                    "open" => level.repeat(depth),
                    _ => level.repeat(depth) + "1" + &"]".repeat(depth) + ",",
                };
                let mut text = format!("#FOO [{}", unit.repeat(length / unit.len() + 1));
                text.truncate(length);
                let raw = RawBlock::from_line(&text);
                let mut diagnostics = Vec::new();
                group.throughput(Throughput::Bytes(length as u64));
                group.bench_function(format!("{name}/{depth} deep/{length}"), |b| {
                    b.iter(|| {
                        diagnostics.clear();
                        parser.block(black_box(&raw), &file, &mut diagnostics)
                    });
                });
            }
        }
    }
    group.finish();
}

fn decode(c: &mut Criterion) {
    let sources = MemorySources::new().with("waves.nc", program());
    let Ok((machine, _)) = Machine::builtin(&[]) else { return };
    let job = Job::new(machine, sources, "waves.nc");
    let mut group = c.benchmark_group("decode");
    group.throughput(Throughput::Elements(u64::from(BLOCKS)));
    group.sample_size(10);
    group.bench_function("check", |b| b.iter(|| job.check()));
    group.finish();
}

criterion_group!(benches, parse, brackets, decode);
criterion_main!(benches);
