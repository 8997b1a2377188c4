//! Runs a program on the built-in machine and prints the set positions of X, Y and Z in every cycle as CSV:
//! `cargo run -p kontur-interpreter --example set_points programs/square_corner.nc`.

#![expect(clippy::print_stdout, reason = "the table goes to stdout")]

use kontur_interpreter::diag::render;
use kontur_interpreter::job::{Job, MachineLists, Run, Sink};
use kontur_interpreter::record::{Asked, Quantity, Rows};
use kontur_interpreter::source::MemorySources;
use std::error::Error;
use std::io::{self, BufWriter, Write};

const PROGRAM: &str = "N10 G01 X10 Y5 F6000\nN20 G02 X20 I5\nN30 M30\n";

/// Writes a row per cycle; stops the run when its output is closed.
struct Table<W>(W);

impl<W: Write> Sink for Table<W> {
    type Stop = io::Error;

    fn reads(&self) -> Option<Asked> {
        Some(Asked::of(&[Quantity::Set]))
    }

    fn rows(&mut self, rows: &Rows<'_>) -> io::Result<()> {
        for (i, cycle) in rows.cycles().iter().enumerate() {
            write!(self.0, "{},{}", cycle.k, cycle.line)?;
            for axis in 0..3 {
                write!(self.0, ",{:.7}", rows.column(axis, Quantity::Set)[i])?;
            }
            writeln!(self.0)?;
        }
        Ok(())
    }

    fn pause(&mut self, run: &mut Run) -> io::Result<()> {
        io::stderr().write_all(render::all(&run.take_diagnostics()).as_bytes())
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let program = match std::env::args_os().nth(1) {
        Some(path) => std::fs::read(path)?,
        None => PROGRAM.into(),
    };
    let (machine, warnings) = MachineLists::default().load().map_err(|said| render::all(&said))?;
    let job = Job::new(machine, MemorySources::new().with("part.nc", program), "part.nc");
    let mut run = job.with_warnings(warnings).start().map_err(|said| render::all(&said))?;
    println!("k,line,X_set_mm,Y_set_mm,Z_set_mm");
    run.to_end(&mut Table(BufWriter::new(io::stdout().lock())))?;
    Ok(())
}
