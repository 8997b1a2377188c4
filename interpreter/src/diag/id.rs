//! ID and severity of a condition.

use serde::Serialize;

/// Identification of a condition.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Id {
    /// A number of the vendor's (`P-ERR-70082` is the same as `70082`), or 1 to 1000 from `#ERROR`.
    Vendor(u32),
    /// A condition of kontur's own, printed `K-0012`.
    Kontur(u16),
}

impl std::fmt::Display for Id {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Vendor(n) => write!(f, "{n}"),
            Self::Kontur(n) => write!(f, "K-{n:04}"),
        }
    }
}

/// Severity of a diagnostic.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Severity {
    /// Informative.
    Note,
    /// The run continues; something was corrected, ignored or is not simulated.
    Warning,
    /// The program (or the list) is refused or aborted.
    Error,
}

impl std::fmt::Display for Severity {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Note => "note",
            Self::Warning => "warning",
            Self::Error => "error",
        })
    }
}
