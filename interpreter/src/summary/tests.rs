//! What a summary makes of single cycles.

use super::Collector;
use crate::job::{Job, MachineLists};
use crate::record::CycleRecord;
use crate::source::MemorySources;

/// Of corners with the same contour error but for its last bits the first one is named, with the largest value of all.
#[test]
fn the_first_of_equal_contour_errors_is_named() {
    let (machine, _) = MachineLists::default().load().unwrap();
    let sources = MemorySources::new().with("part.nc", "M30\n");
    let run = Job::new(machine, sources, "part.nc").start().unwrap();
    let mut collector = Collector::new(run.facts());
    for (k, contour_err_mm) in
        [0.0, 0.1, 0.05, 0.1 + 1e-12, 0.09, 0.1 + 1.5e-12].into_iter().enumerate()
    {
        let record = CycleRecord { k: k as u64, contour_err_mm, ..CycleRecord::default() };
        collector.add_whole(&record, |_| None);
    }
    let most = collector.finish(&run.totals()).max_contour_error.unwrap();
    assert!((most.time_s - 0.001).abs() < 1e-9, "{}", most.time_s);
    assert!((most.mm - (0.1 + 1.5e-12)).abs() < 1e-16, "{}", most.mm);
}
