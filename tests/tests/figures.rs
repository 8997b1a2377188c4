//! The commands of `interpreter/cli/docs/figures.md` draw the figures of the documents.

use kontur::Exit;
use kontur_tests::command::run_line;
use std::path::Path;

/// Every command of the list as written. What the curves show is proven where they are computed: in `filters`, `motion` and the control.
#[test]
fn every_command_of_the_list_runs() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let list = std::fs::read_to_string(root.join("interpreter/cli/docs/figures.md")).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let commands: Vec<&str> =
        list.split('`').skip(1).step_by(2).filter(|part| part.starts_with("kontur ")).collect();
    assert!(commands.len() >= 24, "{commands:?}");
    for command in commands {
        let outcome = run_line(command, folder.path());
        assert_eq!(outcome.exit, Exit::Finished, "{command}: {}", outcome.err);
        if let Some((_, rest)) = command.split_once(" -o ") {
            let file = rest.split_whitespace().next().unwrap();
            let written = std::fs::metadata(folder.path().join(file)).unwrap();
            assert!(written.len() > 1000, "{command}");
        }
    }
}
