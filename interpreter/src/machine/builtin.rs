//! The machine that is used without `-m`: the lists of `programs/machines/xyz`, compiled in.

use super::Machine;
use super::lists::ListFiles;
use super::overrides::Override;
use crate::diag::Diagnostic;

/// Lists compiled in, by path.
#[derive(Clone, Copy, Debug)]
struct Builtin;

const FILES: &[(&str, &str)] = &[
    ("xyz/hochlauf.lis", include_str!("../../machines/xyz/hochlauf.lis")),
    ("xyz/channel.lis", include_str!("../../machines/xyz/channel.lis")),
    ("xyz/axes.lis", include_str!("../../machines/xyz/axes.lis")),
    ("xyz/x.lis", include_str!("../../machines/xyz/x.lis")),
    ("xyz/y.lis", include_str!("../../machines/xyz/y.lis")),
    ("xyz/z.lis", include_str!("../../machines/xyz/z.lis")),
    ("xyz/s.lis", include_str!("../../machines/xyz/s.lis")),
    ("xyz/kontur.lis", include_str!("../../machines/xyz/kontur.lis")),
];

impl ListFiles for Builtin {
    fn read(&self, path: &str) -> Result<Option<Vec<u8>>, String> {
        Ok(FILES.iter().find(|(name, _)| *name == path).map(|(_, text)| text.as_bytes().to_vec()))
    }
}

impl Machine {
    /// The built-in machine `xyz` with overrides: X, Y, Z and a spindle S, cycle 1 ms.
    ///
    /// # Errors
    /// The diagnostics of overrides that match no parameter or make the machine impossible to run; see
    /// [`Machine::load`].
    pub fn builtin(overrides: &[Override]) -> Result<(Self, Vec<Diagnostic>), Vec<Diagnostic>> {
        Self::load(&Builtin, "xyz/hochlauf.lis", overrides)
    }
}
