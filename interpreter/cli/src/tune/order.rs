//! The largest order of a filter within a tolerance.

use super::task::Answer;
use crate::console::Console;
use crate::error::{Error, Exit};
use crate::table::{Cell, Table, number};

use kontur_filters::analysis::order::largest_order;
use kontur_filters::fir::{FirConfig, FirKind};
use kontur_filters::time::CycleTime;

/// Prints the largest orders of the mean filter (HSC mean and FIR type 1) and of the bell (FIR type 2).
pub(super) fn answer(
    tolerance_mm: f64,
    feed_mm_min: f64,
    cycle: CycleTime,
    console: &mut Console,
) -> Result<Answer, Error> {
    let cycle_ms = f64::from(cycle.us()) / 1000.0;
    let mut out = format!(
        "asked    contour error at most {tolerance_mm} mm\n\
         assumed  cycle {cycle_ms} ms; 90 degree corner at F{feed_mm_min} without slowing down\n\n"
    );
    let header = ["filter", "order", "contour error", "delay", "command"];
    let mut table = Table::new(&header);
    let mut choices = Table::new(&["filter", "order", "contour_err_mm", "delay_s"]);
    for (name, kind) in
        [("mean (HSC, FIR type 1)", FirKind::MovingAverage), ("Gauss (FIR type 2)", FirKind::Gauss)]
    {
        let config = FirConfig::new(kind);
        let most = largest_order(&config, tolerance_mm, feed_mm_min / 60.0, cycle);
        // an odd order delays by half a cycle, which the delay filter of an unfiltered axis cannot match
        for order in [most.order, most.order - most.order % 2] {
            let (kernel, _) = FirConfig { order, ..config }.design(cycle);
            let Some(kernel) = kernel.filter(|_| order > 0) else { continue };
            let error = kontur_filters::analysis::corner::kernel_error_mm(
                &kernel,
                feed_mm_min / 60.0,
                cycle,
            );
            table.push(vec![
                name.to_owned(),
                order.to_string(),
                format!("{} mm", number(error, 6)),
                format!("{} ms", number(0.5 * f64::from(order) * cycle_ms, 2)),
                format!("#FILTER ON [ORDER={order}]"),
            ]);
            choices.push([
                Cell::Word(name.to_owned()),
                Cell::from(order),
                Cell::Given(error),
                Cell::Given(0.5 * f64::from(order) * cycle.seconds()),
            ]);
            if order % 2 == 0 {
                break;
            }
        }
        if most.order == 0 {
            let none = ["0", "", "", "none: even the first order exceeds it"].map(str::to_owned);
            table.push(std::iter::once(name.to_owned()).chain(none));
        }
    }
    out.push_str(&table.text());
    out.push_str(
        "\n\nThe commands set the order of the filter that an axis list configures: filter_fir.type 1 or 2 (P-AXIS-00586).",
    );
    console.print(&out)?;
    Ok(Answer { choices, command: None, exit: Exit::Finished })
}
