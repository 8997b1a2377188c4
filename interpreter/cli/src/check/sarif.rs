//! Diagnostics as SARIF 2.1.0, the form that code scanning services read.
//!
//! Source: OASIS standard "Static Analysis Results Interchange Format (SARIF) Version 2.1.0".

use kontur_interpreter::diag::condition::{Row, row};
use kontur_interpreter::diag::{Diagnostic, Id, Location, Severity};
use percent_encoding::{AsciiSet, NON_ALPHANUMERIC, utf8_percent_encode};
use serde_json::{Value, json};

/// Characters that are not encoded in a URI (RFC 3986: unreserved characters, and the separators of a path).
const PATH: &AsciiSet =
    &NON_ALPHANUMERIC.remove(b'-').remove(b'.').remove(b'_').remove(b'~').remove(b'/');

/// The log of one check.
pub(super) fn log(diagnostics: &[Diagnostic]) -> Value {
    let mut ids: Vec<Id> = diagnostics.iter().map(|d| d.id).collect();
    ids.sort_unstable();
    ids.dedup();
    let rules: Vec<Value> = ids.iter().map(|id| rule(*id, row(*id))).collect();
    let results: Vec<Value> = diagnostics.iter().map(|d| result(d, &ids)).collect();
    json!({
        "$schema": "https://json.schemastore.org/sarif-2.1.0.json",
        "version": "2.1.0",
        "runs": [{
            "tool": { "driver": {
                "name": "kontur",
                "semanticVersion": env!("CARGO_PKG_VERSION"),
                "rules": rules,
            } },
            "columnKind": "unicodeCodePoints",
            "results": results,
        }],
    })
}

fn rule(id: Id, row: &Row) -> Value {
    let mut rule = json!({
        "id": id.to_string(),
        "defaultConfiguration": { "level": level(row.severity) },
    });
    // an error that a program raises with #ERROR has no entry in the table
    if !row.meaning.is_empty() {
        rule["shortDescription"] = json!({ "text": row.meaning });
    }
    if !row.cause.is_empty() {
        rule["fullDescription"] = json!({ "text": row.cause });
    }
    if let Some(hint) = row.hint {
        rule["help"] = json!({ "text": hint });
    }
    rule
}

fn result(d: &Diagnostic, ids: &[Id]) -> Value {
    let text = match &d.hint {
        Some(hint) => format!("{}\n{hint}", d.text),
        None => d.text.clone(),
    };
    let mut result = json!({
        "ruleId": d.id.to_string(),
        "ruleIndex": ids.binary_search(&d.id).ok(),
        "level": level(d.severity),
        "message": { "text": text },
    });
    if let Some(place) = &d.source {
        result["locations"] = json!([{ "physicalLocation": physical(place) }]);
    }
    result
}

fn physical(place: &Location) -> Value {
    json!({
        "artifactLocation": { "uri": uri(&place.file) },
        "region": {
            "startLine": place.line.max(1),
            "startColumn": place.column.max(1),
            "endColumn": place.end_column(),
        },
    })
}

/// A relative reference, or a `file` URI for an absolute path of either system.
fn uri(file: &str) -> String {
    let path = file.replace('\\', "/");
    let drive = path.as_bytes().get(1) == Some(&b':');
    let (start, rest) = match path.strip_prefix("./") {
        _ if drive => ("file:///", path.as_str()),
        _ if path.starts_with('/') => ("file://", path.as_str()),
        Some(rest) => ("", rest),
        None => ("", path.as_str()),
    };
    let (letter, rest) = if drive { rest.split_at(2) } else { ("", rest) };
    format!("{start}{letter}{}", utf8_percent_encode(rest, PATH))
}

const fn level(severity: Severity) -> &'static str {
    match severity {
        Severity::Error => "error",
        Severity::Warning => "warning",
        Severity::Note => "note",
    }
}

#[cfg(test)]
mod tests {
    use super::uri;

    /// RFC 3986 and, for drives, RFC 8089 appendix E.2.
    #[test]
    fn paths_become_uris() {
        for (file, expected) in [
            ("part.nc", "part.nc"),
            ("./sub/part 1.nc", "sub/part%201.nc"),
            ("sub\\a#b?.nc", "sub/a%23b%3F.nc"),
            ("Öl.nc", "%C3%96l.nc"),
            ("/srv/nc/a.nc", "file:///srv/nc/a.nc"),
            ("C:\\nc\\a.nc", "file:///C:/nc/a.nc"),
        ] {
            assert_eq!(uri(file), expected);
        }
    }
}
