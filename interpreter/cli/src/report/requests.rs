//! The runs of a report.

use crate::args::ReportArgs;
use crate::combinations::{combinations, put, values};
use crate::error::Error;
use crate::request::Request;

/// Largest number of runs on a page or in a picture: twice the number of colours; a long one takes 25 MB.
const MOST_RUNS: usize = 16;

/// Every program under every combination of `--vary`: the program, the values, and the request.
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
    if all.len() > MOST_RUNS {
        let text = format!(
            "{} runs, at most {MOST_RUNS} can be drawn; use `kontur sweep` to compare more",
            all.len()
        );
        return Err(Error::Usage(text));
    }
    Ok(all)
}
