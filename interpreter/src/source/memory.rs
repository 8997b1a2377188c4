//! Programs in memory: for tests, the browser, and generated programs.

use super::{OpenError, Source, Sources};
use std::collections::BTreeMap;
use std::io;
use std::sync::Arc;

/// Programs by name. Names may contain folders; `\` and `/` both separate them.
#[derive(Clone, Debug, Default)]
pub struct MemorySources {
    programs: BTreeMap<String, Arc<[u8]>>,
}

impl MemorySources {
    /// No programs.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a program or replaces the one of the same name.
    #[must_use]
    pub fn with(mut self, name: &str, bytes: impl Into<Vec<u8>>) -> Self {
        self.programs.insert(normalize(name), bytes.into().into());
        self
    }
}

impl Sources for MemorySources {
    /// The name is tried in the caller's folder first, then as written.
    fn open(&self, name: &str, caller: Option<&str>) -> Result<Box<dyn Source>, OpenError> {
        let plain = normalize(name);
        let mut searched = Vec::new();
        if let Some((folder, _)) = caller.map(normalize).as_deref().and_then(|c| c.rsplit_once('/'))
        {
            searched.push(normalize(&format!("{folder}/{plain}")));
        }
        searched.push(plain);
        for candidate in &searched {
            if let Some(bytes) = self.programs.get(candidate) {
                let name = Arc::from(candidate.as_str());
                return Ok(Box::new(MemorySource { name, bytes: Arc::clone(bytes) }));
            }
        }
        Err(OpenError { name: name.to_owned(), reason: "no such program".to_owned(), searched })
    }
}

/// `/` as the only separator, `.` and `..` resolved as far as the name alone allows.
fn normalize(name: &str) -> String {
    let mut parts: Vec<&str> = Vec::new();
    for part in name.split(['/', '\\']) {
        match part {
            "." => {}
            ".." if parts.last().is_some_and(|last| *last != "..") => {
                parts.pop();
            }
            _ => parts.push(part),
        }
    }
    parts.join("/")
}

/// One program in memory.
#[derive(Clone, Debug)]
struct MemorySource {
    name: Arc<str>,
    bytes: Arc<[u8]>,
}

impl Source for MemorySource {
    fn name(&self) -> Arc<str> {
        Arc::clone(&self.name)
    }

    fn read_at(&mut self, offset: u64, buffer: &mut [u8]) -> io::Result<usize> {
        let start = usize::try_from(offset).unwrap_or(usize::MAX).min(self.bytes.len());
        let rest = &self.bytes[start..];
        let length = rest.len().min(buffer.len());
        buffer[..length].copy_from_slice(&rest[..length]);
        Ok(length)
    }
}

#[cfg(test)]
mod tests {
    use super::{MemorySources, Sources};

    #[test]
    fn a_called_program_is_searched_beside_its_caller_first() {
        let sources =
            MemorySources::new().with("jobs/main.nc", "").with("jobs/a.nc", "1").with("a.nc", "2");
        let open = |name, caller| sources.open(name, caller).map(|s| s.name().to_string());
        assert_eq!(open("a.nc", Some("jobs/main.nc")).unwrap(), "jobs/a.nc");
        assert_eq!(open(r"..\a.nc", Some("jobs/main.nc")).unwrap(), "a.nc");
        assert_eq!(open("a.nc", None).unwrap(), "a.nc");
        let error = open("b.nc", Some("jobs/main.nc")).unwrap_err();
        assert_eq!(error.searched, ["jobs/b.nc", "b.nc"]);
    }
}
