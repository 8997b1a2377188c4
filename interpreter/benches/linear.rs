//! Programs whose time once grew faster than their length: per block, pass or subroutine it must be the same at a tenth of the size.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use kontur_interpreter::job::Job;
use kontur_interpreter::machine::Machine;
use kontur_interpreter::record::CycleRecord;
use kontur_interpreter::source::MemorySources;
use std::fmt::Write;
use std::hint::black_box;

/// The text of a program with the given number of pieces.
type Program = fn(u32) -> String;

/// A jump back from `$IF`: its target is looked up and its blocks are parsed once, whatever the number of passes.
fn goto(passes: u32) -> String {
    format!("P1=0\nN10: P1=P1+1\n$IF P1 < {passes}\n$GOTO N10\n$ENDIF\nM30\n")
}

/// Subroutines before the main program, of which the first and the last are called.
fn subroutines(count: u32) -> String {
    let mut text = String::new();
    for i in 0..count {
        // writing into a string cannot fail
        let _ = write!(text, "%L S{i}\nX1\nM17\n");
    }
    let last = count - 1;
    text + &format!("%MAIN\nG01 F1000 X1\nLL S0\nLL S{last}\nM30\n")
}

/// Steps of 0.1 um: no block is as long as a cycle at any speed, and every block ends at a corner.
fn stairs(blocks: u32) -> String {
    let mut text = String::from("#SLOPE [TYPE=HSC]\nG01 F1000\n");
    for i in 1..=blocks {
        let (x, y) = (f64::from(i / 2) * 1e-4, f64::from(i % 4 / 2) * 1e-4);
        let _ = writeln!(text, "X{x:.4} Y{y:.4}");
    }
    text + "M30\n"
}

/// Corners that are rounded symmetrically, under a guard with a tolerance: the nearest point of each curve is searched for.
fn rounded(squares: u32) -> String {
    let mut text = String::from(
        "#VIB GUARD ON [MODE=1 FREQ=20 AX_DEV=0.01]\n#CONTOUR MODE [POS]\nG01 G261 F4000\n",
    );
    for _ in 0..squares {
        text.push_str("X10\nY10\nX0\nY0\n");
    }
    text + "G260\nM30\n"
}

/// Runs a program to its end; returns the number of cycles.
fn run(text: &str) -> u64 {
    let sources = MemorySources::new().with("part.nc", text);
    let Ok((machine, _)) = Machine::builtin(&[]) else { return 0 };
    let Ok(mut run) = Job::new(machine, sources, "part.nc").start() else { return 0 };
    let mut cycles = 0;
    let Ok(()) = run.to_end(&mut |record: &CycleRecord| {
        black_box(record);
        cycles += 1;
    });
    cycles
}

fn linear(c: &mut Criterion) {
    let mut group = c.benchmark_group("linear");
    group.sample_size(10);
    let programs: [(&str, Program, u32); 4] = [
        ("passes of $GOTO", goto, 1_000_000),
        ("subroutines %L", subroutines, 100_000),
        ("stairs of 0.1 um with HSC", stairs, 4_000),
        ("squares of #CONTOUR MODE [POS] with AX_DEV", rounded, 10),
    ];
    for (name, program, most) in programs {
        for count in [most / 10, most] {
            let text = program(count);
            group.throughput(Throughput::Elements(u64::from(count)));
            group.bench_with_input(BenchmarkId::new(name, count), &text, |b, text| {
                b.iter(|| run(text));
            });
        }
    }
    group.finish();
}

criterion_group!(benches, linear);
criterion_main!(benches);
