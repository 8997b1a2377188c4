//! The program's own `#VIB GUARD` commands: what they say, and copies without what is to be chosen, with a tolerance.

use crate::Error;
use std::fs::File;
use std::io::{BufRead, BufReader, BufWriter, Write};
use std::path::{Path, PathBuf};

/// What the program says about the Vibration Guard; lines count from 1.
#[derive(Debug, Default, PartialEq)]
pub(super) struct Commands {
    /// First line that names what is to be chosen.
    pub(super) outvoting: Option<usize>,
    /// First line that switches the guard on.
    pub(super) on: Option<usize>,
    /// First line that switches the guard off.
    pub(super) off: Option<usize>,
    /// Line and value of the first `AX_DEV`.
    pub(super) tolerance: Option<(usize, String)>,
    /// Line of the head (`%NAME`) of the main program, 0 without one: local subroutines stand in front of it.
    head: usize,
}

/// A copy of a program, deleted when it goes out of scope.
#[derive(Debug)]
pub(super) struct Copy {
    /// The copy, under the name of the original.
    pub(super) program: PathBuf,
    _folder: tempfile::TempDir,
}

/// Words of a command that a choice replaces.
const CHOSEN: [&str; 3] = ["MODE", "FREQ", "DAMPING"];
/// Words of a command that stay.
const KEPT: [&str; 2] = ["AX_DEV", "ACC_FACT"];

impl Commands {
    /// Reads the commands of a program file line by line; those of subroutines show in the delays.
    pub(super) fn of(file: &Path) -> Result<Self, Error> {
        let mut commands = Self::default();
        lines(file, |number, line| {
            commands.read(number, &String::from_utf8_lossy(line));
            Ok(())
        })?;
        Ok(commands)
    }

    fn read(&mut self, number: usize, line: &str) {
        let start = line.trim_start().to_ascii_uppercase();
        let subroutine = start.starts_with("%L ") || start.starts_with("%L\t");
        if start.starts_with('%') && !subroutine {
            self.head = number;
        }
        let Some(command) = Command::find(line) else { return };
        let mut words = command.words();
        let once = |place: &mut Option<usize>, found: bool| {
            if found && place.is_none() {
                *place = Some(number);
            }
        };
        once(&mut self.on, words.clone().any(|word| word == "ON"));
        once(&mut self.off, words.clone().any(|word| word == "OFF"));
        once(&mut self.outvoting, words.clone().any(|word| CHOSEN.contains(&word.as_str())));
        if self.tolerance.is_none() && words.any(|word| word == "AX_DEV") {
            self.tolerance = words.next().map(|value| (number, value));
        }
    }
}

/// Copies a program without MODE, FREQ and DAMPING in its `#VIB GUARD` commands, with `ax_dev_mm` in each of them that
/// switches on. A program that never does so gets a command of its own in front of its first block; without it the line
/// numbers stay.
///
/// # Errors
/// [`Error::Usage`] for a command with expressions in its brackets, [`Error::Io`] if the copy cannot be written.
pub(super) fn copy(file: &Path, own: &Commands, ax_dev_mm: Option<f64>) -> Result<Copy, Error> {
    let io = |e| Error::io("temporary copy of the program", e);
    let folder = tempfile::tempdir().map_err(io)?;
    let program = folder.path().join(file.file_name().unwrap_or(file.as_os_str()));
    let mut copy = BufWriter::new(File::create(&program).map_err(io)?);
    let added = ax_dev_mm.filter(|_| own.on.is_none());
    let switch_on = added.map(|x| format!("#VIB GUARD ON [AX_DEV={x}]\n")).unwrap_or_default();
    if own.head == 0 {
        copy.write_all(switch_on.as_bytes()).map_err(io)?;
    }
    lines(file, |number, line| {
        let text = String::from_utf8_lossy(line);
        let edited = match Command::find(&text) {
            None => None,
            Some(command) => command.edited(&text, ax_dev_mm).map_err(|()| {
                Error::Usage(format!(
                    "{}, line {number}: `{}` computes its values; leave ON and AX_DEV there and take out the rest",
                    file.display(),
                    text.trim()
                ))
            })?,
        };
        copy.write_all(edited.as_deref().map_or(line, str::as_bytes)).map_err(io)?;
        let behind = if number == own.head { switch_on.as_bytes() } else { &[] };
        copy.write_all(behind).map_err(io)
    })?;
    copy.flush().map_err(io)?;
    Ok(Copy { program, _folder: folder })
}

/// Hands every line with its end to `take`.
fn lines(
    file: &Path,
    mut take: impl FnMut(usize, &[u8]) -> Result<(), Error>,
) -> Result<(), Error> {
    let io = |e| Error::io(file.display().to_string(), e);
    let mut reader = BufReader::new(File::open(file).map_err(io)?);
    let mut line = Vec::new();
    for number in 1.. {
        line.clear();
        if reader.read_until(b'\n', &mut line).map_err(io)? == 0 {
            break;
        }
        take(number, &line)?;
    }
    Ok(())
}

/// A `#VIB GUARD` command: where it stands in its line, and its upper-case text after the name.
#[derive(Debug)]
struct Command {
    from: usize,
    to: usize,
    rest: String,
}

impl Command {
    fn find(line: &str) -> Option<Self> {
        let code = without_comments(line);
        let from = code.find('#')?;
        let to = code.trim_end().len();
        let text = code[from + 1..to].to_ascii_uppercase();
        let rest = text.trim_start().strip_prefix("VIB")?.trim_start().strip_prefix("GUARD")?;
        let named = rest.chars().next().is_none_or(|c| c.is_whitespace() || c == '[');
        named.then(|| Self { from, to, rest: rest.to_owned() })
    }

    fn words(&self) -> impl Iterator<Item = String> + Clone {
        let between = |c: char| c.is_whitespace() || "[],=".contains(c);
        let words: Vec<String> =
            self.rest.split(between).filter(|w| !w.is_empty()).map(str::to_owned).collect();
        words.into_iter()
    }

    /// The line without the words that are to be chosen, and with a tolerance if it switches on; none if nothing
    /// changes.
    fn edited(&self, line: &str, ax_dev_mm: Option<f64>) -> Result<Option<String>, ()> {
        let ax_dev_mm = ax_dev_mm.filter(|_| self.words().any(|word| word == "ON"));
        let chosen = self.words().any(|word| CHOSEN.contains(&word.as_str()));
        if !chosen && ax_dev_mm.is_none() {
            return Ok(None);
        }
        let mut kept: Vec<String> = ax_dev_mm.map(|x| format!("AX_DEV={x}")).into_iter().collect();
        let mut switch = "";
        let mut words = self.words();
        while let Some(word) = words.next() {
            match word.as_str() {
                "ON" => switch = " ON",
                "OFF" => switch = " OFF",
                key if CHOSEN.contains(&key) || KEPT.contains(&key) => {
                    let value = words.next().ok_or(())?;
                    // an expression may hold the same words; only plain numbers are understood
                    let _: f64 = value.parse().map_err(|_| ())?;
                    if KEPT.contains(&key) {
                        kept.push(format!("{key}={value}"));
                    }
                }
                _ => return Err(()),
            }
        }
        let command = match (switch, kept.is_empty()) {
            // nothing is left to say
            ("", true) => String::new(),
            (_, true) => format!("#VIB GUARD{switch}"),
            (_, false) => format!("#VIB GUARD{switch} [{}]", kept.join(" ")),
        };
        Ok(Some(format!("{}{command}{}", &line[..self.from], &line[self.to..])))
    }
}

/// A line with blanks in place of `( .. )` and of what follows `;`, byte by byte where it was.
fn without_comments(line: &str) -> String {
    let mut code = String::new();
    let (mut depth, mut rest) = (0_u32, false);
    for c in line.chars() {
        rest |= c == ';' && depth == 0;
        depth += u32::from(c == '(' && !rest);
        if depth > 0 || rest {
            code.extend(std::iter::repeat_n(' ', c.len_utf8()));
        } else {
            code.push(c);
        }
        depth -= u32::from(c == ')' && depth > 0 && !rest);
    }
    code
}

#[cfg(test)]
mod tests {
    use super::*;

    fn commands(text: &str) -> Commands {
        let mut commands = Commands::default();
        for (line, number) in text.lines().zip(1..) {
            commands.read(number, line);
        }
        commands
    }

    #[test]
    fn commands_of_a_program() {
        assert_eq!(commands("N10 G1 X1\nN20 M30"), Commands::default());
        let own = commands("N10 #vib guard on [AX_DEV = 0.01]\nN20 #VIB GUARD OFF");
        assert_eq!((own.on, own.off, own.outvoting), (Some(1), Some(2), None));
        assert_eq!(own.tolerance, Some((1, "0.01".to_owned())));
        for line in [
            "#VIB GUARD ON[MODE=2 FREQ=40]",
            "N1 #VIB GUARD [DAMPING 0.1]",
            "#VIB  GUARD [FREQ=6 ,MODE=2]",
        ] {
            assert_eq!(commands(line).outvoting, Some(1), "{line}");
        }
        for line in [
            "(#VIB GUARD ON [MODE=2])",
            "; #VIB GUARD [MODE=2]",
            "#FILTER ON [ORDER=2]",
            "#VIB GUARD ON (MODE=2)",
        ] {
            assert_eq!(commands(line).outvoting, None, "{line}");
        }
    }

    #[test]
    fn the_copy_keeps_everything_else() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("part.nc");
        let edits = [
            ("N30 #VIB GUARD ON [MODE=2 FREQ=40 AX_DEV=0.01]", "N30 #VIB GUARD ON [AX_DEV=0.01]"),
            ("N80 #VIB GUARD ON", "N80 #VIB GUARD ON"),
            ("#vib guard on[mode 3, freq=6] (\u{e4} remark)", "#VIB GUARD ON (\u{e4} remark)"),
            ("N5 #VIB GUARD [FREQ=6 MODE=2]", "N5 "),
            ("N6 #VIB GUARD [ACC_FACT=2 , DAMPING = 0.2]", "N6 #VIB GUARD [ACC_FACT=2]"),
            ("N7 G1 X1 (#VIB GUARD ON [MODE=1])", "N7 G1 X1 (#VIB GUARD ON [MODE=1])"),
        ];
        let join = |lines: Vec<&str>| lines.join("\r\n");
        std::fs::write(&path, join(edits.iter().map(|e| e.0).collect())).unwrap();
        let copied = |ax_dev_mm| copy(&path, &Commands::of(&path).unwrap(), ax_dev_mm);
        let copy = copied(None).unwrap();
        assert_eq!(copy.program.file_name(), path.file_name());
        let text = std::fs::read_to_string(&copy.program).unwrap();
        assert_eq!(text, join(edits.iter().map(|e| e.1).collect()));
        let kept = copy.program.clone();
        drop(copy);
        assert!(!kept.exists());
        std::fs::write(&path, "#VIB GUARD ON [MODE=2 FREQ=[V.P.F*2]]\n").unwrap();
        assert!(copied(None).unwrap_err().to_string().contains("line 1"));
    }

    /// In the commands that switch on, else in front of the first block of the main program.
    #[test]
    fn the_copy_gets_a_tolerance() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("part.nc");
        let on = "#VIB GUARD ON [AX_DEV=0.02]";
        for (text, want) in [
            ("N1 G1 X1\nM30\n", format!("{on}\nN1 G1 X1\nM30\n")),
            ("%L SUB\nG1 X1\nM17\n%MAIN\nLL SUB\n", {
                format!("%L SUB\nG1 X1\nM17\n%MAIN\n{on}\nLL SUB\n")
            }),
            ("%P\n#VIB GUARD ON [MODE=2]\nX1\n#VIB GUARD OFF\n", {
                format!("%P\n{on}\nX1\n#VIB GUARD OFF\n")
            }),
        ] {
            std::fs::write(&path, text).unwrap();
            let copy = copy(&path, &Commands::of(&path).unwrap(), Some(0.02)).unwrap();
            assert_eq!(std::fs::read_to_string(&copy.program).unwrap(), want);
        }
    }
}
