//! Writes the start data of a fuzzer: the first corpus of every target to `tests/fuzz/corpus/TARGET`, and the words that the
//! readers know to `tests/fuzz/words.dict`.

use kontur_tests::targets::{TARGETS, corpus, dictionary};
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
    let words: String = dictionary().iter().map(|word| format!("\"{word}\"\n")).collect();
    fs::write(Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz/words.dict"), words)
}
