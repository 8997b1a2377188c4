//! Recorded signals out of CSV files as they come from measuring systems and from TwinCAT Scope.
//!
//! Separators are tab, semicolon or comma; numbers have a point or, unless the comma separates, a decimal comma. Above the
//! numbers stand any number of header lines. In an export of TwinCAT Scope every line of the header repeats its
//! key in front of each group of channels (`Name`, `SymbolName`, `SampleTime[ms]`, ..): where the key stands, the group
//! has its column of times, so that channels with different sampling times keep their own. Times are counted in
//! milliseconds or in ticks of 100 ns there; `SampleTime[ms]` shows which.
//!
//! Source: TE13xx TC3 Scope View, export in csv.

use crate::Error;
use kontur_interpreter::source::text::Text;
use std::fs::File;
use std::io::Read as _;
use std::path::Path;

/// Largest file that is read, in bytes: two minutes of many channels at 4 kHz.
const MOST_BYTES: u64 = 1 << 28;
/// Samples of one signal with the missing ones filled in: more than an hour at 4 kHz.
const MOST_SAMPLES: f64 = 16_777_216.0;
/// Steps longer than this many sampling times are drop-outs.
const GAP: f64 = 1.5;
/// Header keys whose cells are names, the better one first.
const NAME_KEYS: [&str; 2] = ["SymbolName", "Name"];
/// Header key of the sampling time in ms.
const SAMPLE_TIME: &str = "SampleTime[ms]";
/// Columns of times in tables with one header line, and their unit in s.
const TIME_NAMES: [(&str, f64); 6] =
    [("t_s", 1.0), ("time", 1.0), ("t", 1.0), ("time_s", 1.0), ("t_ms", 1e-3), ("time_ms", 1e-3)];

/// One recorded signal.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Channel {
    /// Name in the file.
    pub(crate) name: String,
    /// Times in s from the first sample; empty without a column of times.
    pub(crate) times_s: Vec<f64>,
    /// Values as written in the file.
    pub(crate) values: Vec<f64>,
    /// Sampling time in s that the header states.
    pub(crate) step_s: Option<f64>,
}

/// A stretch without samples: when it begins in s, and how many samples are missing.
pub(crate) type DropOut = (f64, usize);

/// A signal in equal steps.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct EvenSamples {
    /// Values; missing ones lie on a line between their neighbours.
    pub(crate) values: Vec<f64>,
    /// Sampling time in s.
    pub(crate) step_s: f64,
    /// Where samples are missing.
    pub(crate) drop_outs: Vec<DropOut>,
}

impl Channel {
    /// The sampling time in s: that of the header, else the median step.
    pub(crate) fn step_s(&self) -> Option<f64> {
        let mut steps: Vec<f64> = self.times_s.windows(2).map(|w| w[1] - w[0]).collect();
        if steps.is_empty() {
            return self.step_s;
        }
        let middle = steps.len() / 2;
        let (_, median, _) = steps.select_nth_unstable_by(middle, f64::total_cmp);
        Some(*median).filter(|s| *s > 0.0)
    }

    /// The values in equal steps, missing samples between their neighbours, and where they are missing; `None` if the times
    /// do not rise, there are none, or the gaps hold more than [`MOST_SAMPLES`].
    pub(crate) fn even(&self) -> Option<EvenSamples> {
        let step = self.step_s()?;
        if self.times_s.is_empty() {
            let values = self.values.clone();
            return Some(EvenSamples { values, step_s: step, drop_outs: Vec::new() });
        }
        let (mut even, mut missing) = (Vec::new(), Vec::new());
        for (i, value) in self.values.iter().enumerate() {
            if let (Some(before), true) = (even.last().copied(), i > 0) {
                let dt = self.times_s[i] - self.times_s[i - 1];
                let count = (dt / step).round();
                if dt <= 0.0 || even.len() as f64 + count > MOST_SAMPLES {
                    return None;
                }
                if dt > GAP * step {
                    missing.push((self.times_s[i - 1], count as usize - 1));
                }
                for k in 1..count as usize {
                    even.push(before + (value - before) * k as f64 / count);
                }
            }
            even.push(*value);
        }
        Some(EvenSamples { values: even, step_s: step, drop_outs: missing })
    }
}

/// Reads every channel of a file.
///
/// # Errors
/// [`Error`] if the file cannot be read or holds no table of numbers.
pub(crate) fn read(path: &Path) -> Result<Vec<Channel>, Error> {
    let name = path.display().to_string();
    let io = |e| Error::io(name.clone(), e);
    let text = File::open(path).and_then(Text::new).map_err(io)?;
    let mut bytes = Vec::new();
    text.take(MOST_BYTES + 1).read_to_end(&mut bytes).map_err(io)?;
    if bytes.len() as u64 > MOST_BYTES {
        return Err(Error::Usage(format!("{name}: larger than {} MiB", MOST_BYTES >> 20)));
    }
    let text = String::from_utf8_lossy(&bytes);
    parse(&text).map_err(|e| Error::Usage(format!("{name}: {e}")))
}

/// A number with a decimal point, or with a comma where that is not the separator.
fn number(cell: &str, separator: char) -> Option<f64> {
    let cell = cell.trim().trim_matches('"');
    let value = match cell.parse::<f64>() {
        Err(_) if separator != ',' => cell.replacen(',', ".", 1).parse::<f64>().ok(),
        other => other.ok(),
    };
    value.filter(|v| v.is_finite())
}

fn cells(line: &str, separator: char) -> Vec<&str> {
    line.split(separator).map(|c| c.trim().trim_matches('"')).collect()
}

/// A row of the table: it begins with a number, and most of what it holds are numbers.
fn numeric(cells: &[&str], separator: char) -> bool {
    let filled: Vec<bool> =
        cells.iter().filter(|c| !c.is_empty()).map(|c| number(c, separator).is_some()).collect();
    let numbers = filled.iter().filter(|n| **n).count();
    filled.first() == Some(&true) && 2 * numbers >= filled.len()
}

/// The separator that makes the most of the lines with numbers.
fn separator(lines: &[&str]) -> char {
    let score = |s: &char| {
        let rows = lines.iter().rev().take(50);
        rows.filter(|l| {
            let cells = cells(l, *s);
            cells.len() > 1 && numeric(&cells, *s)
        })
        .count()
    };
    // a decimal comma looks like a separator: the others come first
    ['\t', ';', ',']
        .into_iter()
        .reduce(|a, b| if score(&b) > score(&a) { b } else { a })
        .unwrap_or(',')
}

fn parse(text: &str) -> Result<Vec<Channel>, String> {
    let text = text.trim_start_matches('\u{feff}');
    let lines: Vec<&str> =
        text.lines().filter(|l| !l.trim().is_empty() && l.trim() != "EOF").collect();
    let separator = separator(&lines);
    let rows: Vec<Vec<&str>> = lines.iter().map(|l| cells(l, separator)).collect();
    // the header may hold single numbers
    let widest = rows.iter().map(Vec::len).max().unwrap_or(0);
    let table = |row: &Vec<&str>| numeric(row, separator) && (row.len() > 1 || widest == 1);
    let start = rows.iter().position(table).ok_or_else(|| "no table of numbers".to_owned())?;
    let (header, data) = rows.split_at(start);
    let columns = data.iter().map(Vec::len).max().unwrap_or(0);
    let names = NAME_KEYS.iter().find_map(|key| {
        let keyed = |row: &&Vec<&str>| {
            row.first() == Some(key) && row.len() > 1 && row.len() + 1 >= columns
        };
        header.iter().rfind(keyed).map(|row| (*key, row))
    });
    match names {
        Some((key, names)) => scope(key, names, header, data, separator),
        None => plain(header, data, separator, columns),
    }
}

/// Values of a column, with the times of another one; rows in which one of them is missing are left out, and rows that
/// only repeat a time.
fn column(
    data: &[Vec<&str>],
    time: Option<usize>,
    value: usize,
    separator: char,
    first_line: usize,
    name: &str,
) -> Result<(Vec<f64>, Vec<f64>), String> {
    let (mut times, mut values) = (Vec::new(), Vec::new());
    for (i, row) in data.iter().enumerate() {
        let cell = |c: usize| row.get(c).copied().filter(|c| !c.is_empty());
        let Some(text) = cell(value) else { continue };
        let read = |text: &str| {
            number(text, separator).ok_or_else(|| {
                format!("row {}, column {name}: `{text}` is no number", first_line + i)
            })
        };
        let x = read(text)?;
        if let Some(time) = time {
            let Some(t) = cell(time) else { continue };
            let t = read(t)?;
            if times.last().is_some_and(|last: &f64| (t - last).abs() <= 0.0) {
                continue;
            }
            times.push(t);
        }
        values.push(x);
    }
    Ok((times, values))
}

/// A table whose header repeats its key in front of every group of channels.
fn scope(
    key: &str,
    names: &[&str],
    header: &[Vec<&str>],
    data: &[Vec<&str>],
    separator: char,
) -> Result<Vec<Channel>, String> {
    let step_row = header.iter().rfind(|row| row.first() == Some(&SAMPLE_TIME));
    let mut channels = Vec::new();
    let mut time = None;
    for (i, name) in names.iter().enumerate() {
        if *name == key {
            time = Some(i);
            continue;
        }
        if name.is_empty() {
            continue;
        }
        let step_s = step_row.and_then(|row| number(row.get(i)?, separator)).map(|ms| ms * 1e-3);
        let (mut times, values) = column(data, time, i, separator, header.len() + 1, name)?;
        let channel = Channel {
            name: (*name).to_owned(),
            times_s: times.clone(),
            values: Vec::new(),
            step_s: None,
        };
        // milliseconds, ticks of 100 ns or plain numbers of samples: the header knows how long a step is
        let unit_s = match (step_s, channel.step_s()) {
            (Some(step_s), Some(step)) => step_s / step,
            _ => 1e-3,
        };
        let first = times.first().copied().unwrap_or(0.0);
        for t in &mut times {
            *t = (*t - first) * unit_s;
        }
        channels.push(Channel { name: channel.name, times_s: times, values, step_s });
    }
    if channels.is_empty() { Err("no channel".to_owned()) } else { Ok(channels) }
}

/// A table with column names in the last header line that is wide enough, units in another or in the names.
fn plain(
    header: &[Vec<&str>],
    data: &[Vec<&str>],
    separator: char,
    columns: usize,
) -> Result<Vec<Channel>, String> {
    let unit = |c: &str| {
        c.starts_with('[') || ["s", "ms", "mm", "m", "m/s2", "mm/s2", "g", "V"].contains(&c)
    };
    let words =
        |row: &&Vec<&str>| row.len() >= columns && !row.iter().all(|c| c.is_empty() || unit(c));
    let numbered: Vec<String> = (1..=columns).map(|i| format!("column {i}")).collect();
    let names: Vec<String> = match header.iter().rfind(words) {
        Some(row) => row.iter().map(|c| (*c).to_owned()).collect(),
        None => numbered,
    };
    // `time [s]`, `Time (ms)` or a unit in the line below
    let units: Vec<&str> = header.last().filter(|row| !words(row)).cloned().unwrap_or_default();
    let time = names.iter().enumerate().find_map(|(i, name)| {
        let lower = name.to_ascii_lowercase();
        let base = lower.split(['[', '(']).next().unwrap_or_default().trim().to_owned();
        let written =
            lower.split_once(['[', '(']).map(|(_, u)| u.trim_end_matches([']', ')']).to_owned());
        let below = units.get(i).map(|u| u.trim_matches(['[', ']', '(', ')']).to_owned());
        let (_, seconds) = TIME_NAMES.iter().find(|(n, _)| *n == base)?;
        let unit = written.or(below).filter(|u| !u.is_empty());
        Some((i, unit.map_or(*seconds, |u| if u == "ms" { 1e-3 } else { 1.0 })))
    });
    let mut channels = Vec::new();
    for (i, name) in names.iter().enumerate().take(columns) {
        if time.is_some_and(|(t, _)| t == i) {
            continue;
        }
        // a column of words (the line, what limits) is no signal
        let word = |row: &&Vec<&str>| {
            row.get(i).is_some_and(|c| !c.is_empty() && number(c, separator).is_none())
        };
        if data.first().is_some_and(|row| word(&row)) {
            continue;
        }
        let (mut times, values) =
            column(data, time.map(|t| t.0), i, separator, header.len() + 1, name)?;
        let first = times.first().copied().unwrap_or(0.0);
        for t in &mut times {
            *t = (*t - first) * time.map_or(1.0, |t| t.1);
        }
        channels.push(Channel { name: name.clone(), times_s: times, values, step_s: None });
    }
    if channels.is_empty() {
        Err("no column of numbers beside the times".to_owned())
    } else {
        Ok(channels)
    }
}

/// The channel of a name: as written, then without regard to case, then as the end of a name with dots.
pub(crate) fn find<'a>(channels: &'a [Channel], name: &str) -> Option<&'a Channel> {
    let same = |c: &&Channel| c.name == name;
    let alike = |c: &&Channel| c.name.eq_ignore_ascii_case(name);
    let ends = |c: &&Channel| {
        c.name.rsplit('.').next().is_some_and(|last| last.eq_ignore_ascii_case(name))
    };
    channels
        .iter()
        .find(same)
        .or_else(|| channels.iter().find(alike))
        .or_else(|| channels.iter().find(ends))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn values(text: &str) -> Vec<(String, Vec<f64>, Vec<f64>)> {
        parse(text).unwrap().into_iter().map(|c| (c.name, c.times_s, c.values)).collect()
    }

    #[test]
    fn separators_and_decimal_commas() {
        let want = vec![("a".to_owned(), vec![0.0, 0.5, 1.0], vec![1.5, -2.0, 3.0])];
        for text in [
            "t_s,a\n0,1.5\n0.5,-2\n1,3\n",
            "t_s;a\n0;1,5\n0,5;-2\n1;3\n",
            "t_s\ta\r\n0\t1,5\r\n0,5\t-2,0\r\n1\t3\r\n",
            "Measured on Monday\n\nTime [ms];a\n0;1,5\n500;-2\n1000;3\n",
            "\u{feff}time;a\n[ms];[g]\n0;1,5\n500;-2\n1000;3\nEOF\n",
        ] {
            assert_eq!(values(text), want, "{text}");
        }
        assert!(parse("a,b\nx,y\n").is_err());
        let two = values("a;b\n1;2\n3;4\n5;6\n");
        assert_eq!(two[1], ("b".to_owned(), Vec::new(), vec![2.0, 4.0, 6.0]));
    }

    /// The layout of TwinCAT Scope: keys in front of every group, two sampling times, repeated slow samples, ticks.
    #[test]
    fn scope_export() {
        let text = "Name\tScope01\nFile\tx.svdx\nStarttime of export\t132500000000000000\tMonday\n\n\
                    Name\tAct\tCmd\tName\tSlow\n\
                    SampleTime[ms]\t1\t1\tSampleTime[ms]\t2\n\
                    Data-Type\tREAL64\tREAL64\tData-Type\tREAL64\n\
                    SymbolName\tMAIN.fAct\tMAIN.fCmd\tSymbolName\tMAIN.fSlow\n\n\
                    0\t0,5\t1\t0\t7\n1\t0,25\t2\t0\t7\n2\t0,125\t3\t2\t8\n3\t0\t4\t2\t8\nEOF\n";
        let found = parse(text).unwrap();
        let names: Vec<_> = found.iter().map(|c| c.name.as_str()).collect();
        assert_eq!(names, ["MAIN.fAct", "MAIN.fCmd", "MAIN.fSlow"]);
        assert_eq!(found[0].values, [0.5, 0.25, 0.125, 0.0]);
        assert_eq!(found[2].values, [7.0, 8.0]);
        assert!((found[2].times_s[1] - 0.002).abs() < 1e-12);
        assert_eq!(find(&found, "fslow").unwrap().name, "MAIN.fSlow");
        let ticks = text
            .replace("\n0\t0,5", "\n132500000000000000\t0,5")
            .replace("\n1\t0,25", "\n132500000000010000\t0,25")
            .replace("\n2\t0,125", "\n132500000000020000\t0,125")
            .replace("\n3\t0\t4", "\n132500000000030000\t0\t4");
        let ticks = parse(&ticks).unwrap();
        assert!((ticks[0].times_s[3] - 0.003).abs() < 1e-9, "{:?}", ticks[0].times_s);
    }

    #[test]
    fn drop_outs_are_named_and_bridged() {
        let channel = &parse("t_s,a\n0,0\n0.001,1\n0.004,4\n0.005,5\n").unwrap()[0];
        let even = channel.even().unwrap();
        assert!((even.step_s - 0.001).abs() < 1e-12);
        assert_eq!(even.drop_outs, [(0.001, 2)]);
        for (i, x) in even.values.iter().enumerate() {
            assert!((x - i as f64).abs() < 1e-9);
        }
    }

    /// Gaps are filled up to a bound: a short file cannot ask for the memory of days of samples.
    #[test]
    fn gaps_of_hours_are_not_filled() {
        let even = |hours: u32| {
            let row = |h: u32| format!("{0},1\n{0}.001,1\n{0}.002,1\n", 3600 * h);
            let rows: Vec<String> = (0..hours).map(row).collect();
            parse(&format!("t_s,a\n{}", rows.concat())).unwrap()[0].even()
        };
        assert!(even(4).is_some());
        assert!(even(30).is_none());
    }
}
