//! Real-time inputs: a move under an override of 50 % from 0.1 s on, held from 0.2 s to 0.5 s;
//! `cargo run -p kontur-interpreter --example inputs` prints path speed over time.

#![expect(clippy::print_stdout, reason = "the table goes to stdout")]

use kontur_interpreter::diag::render;
use kontur_interpreter::job::{Change, Job, MachineLists, Signal};
use kontur_interpreter::record::CycleRecord;
use kontur_interpreter::source::MemorySources;

fn main() -> Result<(), String> {
    let (machine, _) = MachineLists::default().load().map_err(|said| render::all(&said))?;
    let sources = MemorySources::new().with("move.nc", "N10 G01 X50 F6000\nN20 M30\n");
    let changes = [
        Change::new(0.1, Signal::Override, 50.0)?,
        Change::new(0.2, Signal::Feedhold, 1.0)?,
        Change::new(0.5, Signal::Feedhold, 0.0)?,
    ];
    let run = Job::new(machine, sources, "move.nc").start().map_err(|said| render::all(&said))?;
    let mut run = run.with_inputs(Box::new(changes.into_iter().map(Ok)));
    let cycle_s = run.facts().cycle_s();
    println!("t_s,v_mm_s");
    let Ok(()) = run.to_end(&mut |record: &CycleRecord| {
        println!("{:.3},{:.3}", record.k as f64 * cycle_s, record.path.v_mm_s);
    });
    Ok(())
}
