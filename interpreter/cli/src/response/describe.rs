//! What is wrong with a filter, in words.

use kontur_filters::issue::{FilterIssue, IssueId};

/// An issue as a sentence with the vendor's number, if it has one.
pub(super) fn issue(issue: &FilterIssue) -> String {
    let text = match *issue {
        FilterIssue::TypeNotPermitted { number } => format!("filter type {number} does not exist"),
        FilterIssue::SecondHsc => "an axis has one HSC filter at most".to_owned(),
        FilterIssue::HscNotFirst => "the HSC filter must be filter[0]".to_owned(),
        FilterIssue::HscPrototype => "HSC types and the prototype HSC go together".to_owned(),
        FilterIssue::HscOnSpindle => "spindles have no HSC filter".to_owned(),
        FilterIssue::HscOnInterface => "the additional interface has no HSC filter".to_owned(),
        FilterIssue::TimeConstant { time_constant_us, min_us, max_us } => {
            format!("time constant {time_constant_us} us is outside {min_us} to {max_us} us")
        }
        FilterIssue::OrderTimeBelowCycle { order_time_us, cycle_us } => {
            format!("{order_time_us} us are shorter than the cycle of {cycle_us} us")
        }
        FilterIssue::OrderTooHigh { order, used } => {
            format!("order {order} is too high, {used} is used")
        }
        FilterIssue::OrderCorrected { order, used } => {
            format!("order {order} does not exist here, {used} is used")
        }
        FilterIssue::NoOrder => "neither an order nor a time that gives one".to_owned(),
        FilterIssue::FrequencyTooLow { f_hz, used_hz } => {
            format!("{f_hz} Hz is too low, {used_hz} Hz is used")
        }
        FilterIssue::Frequency { f_hz, min_hz, max_hz } => {
            format!("{f_hz} Hz is outside {min_hz} to {max_hz:.3} Hz")
        }
        FilterIssue::Quality { quality } => format!("quality {quality} is out of range"),
        FilterIssue::Share { share_ratio } => {
            format!("share {} % is outside 0 to 100 %", 100.0 * share_ratio)
        }
        FilterIssue::AllPassNotBessel => {
            "an all-pass has a flat group delay with BESSEL only".to_owned()
        }
        FilterIssue::RemovesConstantPart => {
            "on a position this type acts on the deviation from the switch-on position".to_owned()
        }
    };
    match issue.id() {
        IssueId::Vendor(number) => format!("{number}: {text}"),
        IssueId::Own(_) => text,
    }
}
