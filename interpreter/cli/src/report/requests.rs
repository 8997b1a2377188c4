//! What a report runs.

use crate::Error;
use crate::args::ReportArgs;
use crate::combinations::{combinations, put, values};
use crate::request::Request;

/// Every program under every combination of `--vary`: the program, the values, and what is to be run.
pub(super) fn requests(args: &ReportArgs) -> Result<Vec<(String, String, Request)>, Error> {
    let combinations = combinations(&args.vary)?;
    let mut all = Vec::new();
    for program in &args.programs {
        for combination in &combinations {
            let mut request = args.simulation.request(program);
            put(&args.vary, combination, &mut request);
            let names = args.vary.iter().zip(values(&args.vary, combination));
            let values = names.map(|(v, value)| format!("{} = {value}", v.short()));
            let values = values.collect::<Vec<_>>().join(", ");
            all.push((program.display().to_string(), values, request));
        }
    }
    Ok(all)
}
