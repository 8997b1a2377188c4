//! Every command of the book: blocks marked `sh` run here, in a copy of the sample programs; blocks marked `sh ci` need tools
//! that only `.ci/run` installs, so these must be present there.

#![cfg(unix)]
use std::path::{Path, PathBuf};
use std::process::Command;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// A block of commands: its page, the info string of the fence, its lines.
struct Block {
    page: String,
    info: String,
    text: String,
}

fn blocks() -> Vec<Block> {
    let mut found = Vec::new();
    for entry in std::fs::read_dir(root().join("interpreter/book/pages")).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|e| e != "md") {
            continue;
        }
        let page = path.file_name().unwrap().to_str().unwrap().to_owned();
        let text = std::fs::read_to_string(&path).unwrap();
        for part in text.split("```").skip(1).step_by(2) {
            let (info, text) = part.split_once('\n').unwrap();
            found.push(Block { page: page.clone(), info: info.to_owned(), text: text.to_owned() });
        }
    }
    found
}

fn copy(from: &Path, to: &Path) {
    std::fs::create_dir_all(to).unwrap();
    for entry in std::fs::read_dir(from).unwrap() {
        let path = entry.unwrap().path();
        let target = to.join(path.file_name().unwrap());
        if path.is_dir() {
            copy(&path, &target);
        } else {
            std::fs::copy(&path, &target).unwrap();
        }
    }
}

#[test]
fn commands_run() {
    let folder = tempfile::tempdir().unwrap();
    copy(&root().join("programs"), &folder.path().join("programs"));
    let binary = Path::new(env!("CARGO_BIN_EXE_kontur")).parent().unwrap();
    let paths = std::env::var_os("PATH").unwrap();
    let paths = std::env::join_paths(
        std::iter::once(binary.to_owned()).chain(std::env::split_paths(&paths)),
    );
    let paths = paths.unwrap();
    let mut run = 0;
    for block in blocks().into_iter().filter(|b| b.info == "sh") {
        let out = Command::new("sh")
            .args(["-eu", "-c", &block.text])
            .env("PATH", &paths)
            .current_dir(folder.path())
            .output()
            .unwrap();
        let said = String::from_utf8_lossy(&out.stderr);
        assert!(out.status.success(), "{}:\n{}\n{said}", block.page, block.text);
        run += block.text.lines().count();
    }
    assert!(run >= 6, "{run} commands found");
}

#[test]
fn commands_that_need_further_tools_are_in_ci() {
    let ci = std::fs::read_to_string(root().join(".ci/run")).unwrap();
    for block in blocks().into_iter().filter(|b| b.info == "sh ci") {
        for line in block.text.lines().filter(|line| !line.trim().is_empty()) {
            assert!(ci.contains(line), "{}: `{line}` is not run by .ci/run", block.page);
        }
    }
}

/// A command must not be skipped because of a fence with another name.
#[test]
fn fences_are_known() {
    for block in blocks() {
        let known = ["sh", "sh ci", "text", "json", "nc", "rust,ignore"].contains(&&*block.info);
        assert!(known, "{}: fence `{}`", block.page, block.info);
        let command = block.text.lines().any(|line| line.starts_with("kontur "));
        assert!(!command || block.info == "sh", "{}: a command in `{}`", block.page, block.info);
    }
}
