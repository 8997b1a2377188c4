//! The texts that a run reads.

use super::*;
use crate::source::{OpenError, Source};
use std::io;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Sources that count how often a text is read from its beginning.
struct Counted(MemorySources, Arc<AtomicUsize>);

struct CountedSource(Box<dyn Source>, Arc<AtomicUsize>);

impl Sources for Counted {
    fn open(&self, name: &str, caller: Option<&str>) -> Result<Box<dyn Source>, OpenError> {
        Ok(Box::new(CountedSource(self.0.open(name, caller)?, Arc::clone(&self.1))))
    }
}

impl Source for CountedSource {
    fn name(&self) -> Arc<str> {
        self.0.name()
    }

    fn read_at(&mut self, offset: u64, buffer: &mut [u8]) -> io::Result<usize> {
        self.1.fetch_add(usize::from(offset == 0), Ordering::Relaxed);
        self.0.read_at(offset, buffer)
    }
}

/// A long text is read three times: for its structure, by the check and by the run, which takes the structure from the
/// check and reports the faults in it once.
#[test]
fn a_run_takes_the_structure_from_its_check() {
    let remarks =
        "(a remark that makes the program longer than any window of a reader)\n".repeat(3000);
    let text =
        format!("%MAIN\n{remarks}N10 G01 X1 F1000\nLL SUB\nN20 M30\n%L SUB\nN30 Y2\nN40 M29\n");
    let (machine, _) = MachineLists::default().load().unwrap();
    let reads = Arc::new(AtomicUsize::new(0));
    let sources = Counted(MemorySources::new().with("main.nc", text), Arc::clone(&reads));
    let mut run = Job::new(machine, sources, "main.nc").start().unwrap();
    let last = records(&mut run).pop().unwrap();
    assert_eq!((last.axes[0].set, last.axes[1].set), (1.0, 2.0));
    let behind = run.take_diagnostics();
    let behind = behind.iter().filter(|d| d.text.contains("after the main program")).count();
    assert_eq!((behind, reads.load(Ordering::Relaxed)), (1, 3));
}
