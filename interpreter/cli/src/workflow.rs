//! Messages as commands of GitHub's workflow log, which shows them at the lines they refer to.
//!
//! Source: GitHub documentation, "Workflow commands for GitHub Actions" (`error`, `warning`, `notice`; percent sign and line
//! end escaped, in properties colon and comma, too).

use kontur_interpreter::diag::render::printable;
use kontur_interpreter::diag::{Diagnostic, Severity};

/// The position at which a command is shown.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place<'a> {
    /// The file as given; backslashes become slashes.
    pub(crate) file: &'a str,
    /// Line, from 1.
    pub(crate) line: u32,
    /// First column and the one after the last, from 1.
    pub(crate) columns: Option<(u32, u32)>,
}

/// The command of a diagnostic.
pub(crate) fn command(d: &Diagnostic) -> String {
    let place = d.source.as_ref().map(|at| Place {
        file: &at.file,
        line: at.line,
        columns: Some((at.column, at.end_column())),
    });
    let axis = d.axis.as_ref().map(|axis| format!("axis {} ({})", axis.number, axis.name));
    let lines: Vec<String> =
        [Some(d.text.clone()), axis, d.hint.clone()].into_iter().flatten().collect();
    raise(d.severity, place, &d.id.to_string(), &lines.join("\n"))
}

/// A command with a title and a text.
pub(crate) fn raise(
    severity: Severity,
    place: Option<Place<'_>>,
    title: &str,
    text: &str,
) -> String {
    let name = match severity {
        Severity::Error => "error",
        Severity::Warning => "warning",
        Severity::Note => "notice",
    };
    let mut properties = Vec::new();
    if let Some(at) = place {
        properties.push(format!("file={}", property(&at.file.replace('\\', "/"))));
        properties.push(format!("line={}", at.line));
        if let Some((first, behind)) = at.columns {
            properties.push(format!("col={first},endColumn={behind}"));
        }
    }
    properties.push(format!("title={}", property(title)));
    format!("::{name} {}::{}", properties.join(","), data(text))
}

fn data(text: &str) -> String {
    printable(text).replace('%', "%25").replace('\n', "%0A")
}

fn property(text: &str) -> String {
    data(text).replace(':', "%3A").replace(',', "%2C")
}

#[cfg(test)]
mod tests {
    use super::{Place, raise};
    use kontur_interpreter::diag::Severity;

    #[test]
    fn separators_of_the_command_are_escaped() {
        let place = Place { file: "sub\\a,b:c.nc", line: 7, columns: Some((3, 5)) };
        let line = raise(Severity::Warning, Some(place), "K-0001", "100 %\nhint: a, b");
        let expected = "::warning file=sub/a%2Cb%3Ac.nc,line=7,col=3,endColumn=5,title=K-0001::100 %25%0Ahint: a, b";
        assert_eq!(line, expected);
        assert_eq!(raise(Severity::Note, None, "t", "x"), "::notice title=t::x");
    }
}
