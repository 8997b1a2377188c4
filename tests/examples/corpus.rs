//! Writes the first corpus of every fuzz target to `tests/fuzz/corpus/TARGET`.

use kontur_tests::targets::{TARGETS, corpus};
use std::fs;
use std::path::Path;

fn main() -> std::io::Result<()> {
    for (name, _) in TARGETS {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz/corpus").join(name);
        fs::create_dir_all(&folder)?;
        for (i, input) in corpus(name).iter().enumerate() {
            fs::write(folder.join(format!("{i:04}")), input)?;
        }
    }
    Ok(())
}
