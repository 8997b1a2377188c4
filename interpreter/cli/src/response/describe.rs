//! Errors of a filter as text.

use kontur_filters::issue::FilterIssue;
use kontur_interpreter::diag::Id;
use kontur_interpreter::machine::filter_condition;

/// An issue as a sentence with the vendor's number, if it has one.
pub(super) fn issue(issue: &FilterIssue) -> String {
    match filter_condition(issue).id() {
        id @ Id::Vendor(_) => format!("{id}: {issue}"),
        Id::Kontur(_) => issue.to_string(),
    }
}
