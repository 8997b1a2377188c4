//! What the modes of the Vibration Guard cost a program, whatever it says itself: largest deviation from the contour and
//! duration, `cargo run --release -p kontur-interpreter --example force_guard`.

#![expect(clippy::print_stdout, reason = "the table goes to stdout")]

use kontur_filters::vib_guard::VibGuardSettings;
use kontur_interpreter::diag::render;
use kontur_interpreter::job::{ForcedGuard, Job, MachineLists, Options};
use kontur_interpreter::record::CycleRecord;
use kontur_interpreter::source::MemorySources;

const SQUARE: &str = "N10 G01 F4000\nN20 X10\nN30 Y10\nN40 X0\nN50 Y0\nN60 M30\n";

fn main() -> Result<(), String> {
    let (machine, _) = MachineLists::default().load().map_err(|said| render::all(&said))?;
    let job = Job::new(machine, MemorySources::new().with("square.nc", SQUARE), "square.nc");
    println!("mode,ax_dev_mm,deviation_mm,duration_s");
    for mode in 1..=4 {
        for ax_dev_mm in [None, Some(0.01)] {
            let settings = VibGuardSettings { mode, freq_hz: 40.0, damping: 0.1 };
            let guard = Some(ForcedGuard { settings: Some(settings), ax_dev_mm });
            let job = job.clone().with_options(Options { guard, ..Options::default() });
            let mut run = job.start().map_err(|said| render::all(&said))?;
            let mut deviation_mm = 0.0_f64;
            let Ok(()) = run.to_end(&mut |record: &CycleRecord| {
                let axes = record.axes.iter().map(|axis| axis.dev_both_ways);
                deviation_mm = axes.fold(deviation_mm, f64::max);
            });
            let duration_s = run.record().k as f64 * run.facts().cycle_s();
            let bound = ax_dev_mm.unwrap_or_default();
            println!("{mode},{bound},{deviation_mm:.6},{duration_s:.3}");
        }
    }
    Ok(())
}
