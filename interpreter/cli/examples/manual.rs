//! Writes completions for shells and man pages into a folder: `cargo run -p kontur --example manual -- FOLDER`.
//!
//! They come from the definitions of the command line, so that they say what `--help` says.

use clap::{CommandFactory as _, ValueEnum as _};
use clap_complete::Shell;
use kontur::args::Args;
use std::io;
use std::path::PathBuf;

fn main() -> io::Result<()> {
    let folder = std::env::args_os().nth(1).map(PathBuf::from);
    let folder = folder.ok_or_else(|| io::Error::other("usage: manual FOLDER"))?;
    let completions = folder.join("completions");
    let pages = folder.join("man");
    std::fs::create_dir_all(&completions)?;
    std::fs::create_dir_all(&pages)?;
    for shell in Shell::value_variants() {
        clap_complete::generate_to(*shell, &mut Args::command(), "kontur", &completions)?;
    }
    clap_mangen::generate_to(Args::command(), &pages)
}
