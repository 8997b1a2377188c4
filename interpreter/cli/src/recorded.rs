//! Recorded signals from CSV files, as written by measuring systems and TwinCAT Scope.
//!
//! Separators are tab, semicolon or comma; numbers have a point or, unless the comma separates, a decimal comma. There
//! may be any number of header lines above the numbers. In an export of TwinCAT Scope every header line repeats its key
//! before each group of channels (`Name`, `SymbolName`, `SampleTime[ms]`, ..). The column of the key contains the times
//! of the group, so that channels with different sampling times keep their own. These times are in milliseconds or in
//! ticks of 100 ns; `SampleTime[ms]` shows which.
//!
//! Source: TE13xx TC3 Scope View, export in csv.

mod channel;
mod even;

pub(crate) use channel::Channel;
pub(crate) use even::{DropOut, Even};

use crate::error::Error;
use even::{JITTER_RATIO, median};
use kontur_interpreter::source::text::Text;
use std::fs::File;
use std::io::Read as _;
use std::path::Path;

/// Largest file that is read, in bytes: two minutes of many channels at 4 kHz.
const MOST_BYTES: u64 = 1 << 28;
/// Header keys with channel names in their cells, the better one first.
const NAME_KEYS: [&str; 2] = ["SymbolName", "Name"];
/// Header key of the sampling time in ms.
const SAMPLE_TIME: &str = "SampleTime[ms]";
/// Columns of times in tables with one header line, and their unit in s.
const TIME_NAMES: [(&str, f64); 8] = [
    ("t_s", 1.0),
    ("time", 1.0),
    ("t", 1.0),
    ("time_s", 1.0),
    ("t_ms", 1e-3),
    ("time_ms", 1e-3),
    ("t_us", 1e-6),
    ("time_us", 1e-6),
];
/// Units of times in s; both signs for micro, and the bytes that remain of it if the text is not UTF-8.
const TIME_UNITS: [(&str, f64); 10] = [
    ("s", 1.0),
    ("sec", 1.0),
    ("ms", 1e-3),
    ("us", 1e-6),
    ("\u{b5}s", 1e-6),
    ("\u{3bc}s", 1e-6),
    ("\u{fffd}s", 1e-6),
    ("ns", 1e-9),
    ("min", 60.0),
    ("h", 3600.0),
];
/// Units of times in exports of TwinCAT Scope in s: milliseconds, and ticks of file times.
const SCOPE_UNITS: [f64; 2] = [1e-3, 1e-7];

/// Reads every channel of a file.
///
/// # Errors
/// [`Error`] if the file cannot be read or contains no table of numbers.
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

/// Whether a row belongs to the table: it begins with a number, and most of its cells are numbers.
fn numeric(cells: &[&str], separator: char) -> bool {
    let filled: Vec<bool> =
        cells.iter().filter(|c| !c.is_empty()).map(|c| number(c, separator).is_some()).collect();
    let numbers = filled.iter().filter(|n| **n).count();
    filled.first() == Some(&true) && 2 * numbers >= filled.len()
}

/// The separator with which most lines contain numbers.
fn separator(lines: &[&str]) -> char {
    let score = |s: &char| {
        let rows = lines.iter().rev().take(50);
        rows.filter(|l| {
            let cells = cells(l, *s);
            cells.len() > 1 && numeric(&cells, *s)
        })
        .count()
    };
    // a decimal comma looks like a separator, so the others come first
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
    // the header may contain single numbers
    let widest = rows.iter().map(Vec::len).max().unwrap_or(0);
    let table = |row: &Vec<&str>| numeric(row, separator) && (row.len() > 1 || widest == 1);
    let start = rows.iter().position(table).ok_or_else(|| "not a table of numbers".to_owned())?;
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

/// Values of a column with the times of another one. Rows in which one of them is missing are left out, and so are rows
/// that repeat time and value (a slow channel among faster ones). A different value at the same time is refused: the
/// times have too few decimals.
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
                format!("row {}, column {name}: `{text}` is not a number", first_line + i)
            })
        };
        let x = read(text)?;
        if let Some(time) = time {
            let Some(t) = cell(time) else { continue };
            let t = read(t)?;
            if times.last().is_some_and(|last: &f64| (t - last).abs() <= 0.0) {
                if values.last().is_some_and(|last: &f64| (x - last).abs() > 0.0) {
                    return Err(format!(
                        "row {}, column {name}: a second value at the same time {t}; the times have too few decimals",
                        first_line + i
                    ));
                }
                continue;
            }
            times.push(t);
        }
        values.push(x);
    }
    Ok((times, values))
}

/// Reads a table whose header repeats its key before every group of channels.
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
        let (times, values) = column(data, time, i, separator, header.len() + 1, name)?;
        channels.push(scope_channel(name, times, values, step_s)?);
    }
    // a common zero for all channels, the earliest time
    for unit_s in SCOPE_UNITS {
        let of_unit = |c: &&mut (f64, Channel)| (c.0 - unit_s).abs() <= 0.0;
        let begins =
            channels.iter_mut().filter(of_unit).filter_map(|c| c.1.times_s.first().copied());
        let zero = begins.fold(f64::INFINITY, f64::min);
        for (unit_s, channel) in channels.iter_mut().filter(of_unit) {
            channel.times_s.iter_mut().for_each(|t| *t = (*t - zero) * *unit_s);
        }
    }
    let channels: Vec<Channel> = channels.into_iter().map(|c| c.1).collect();
    if channels.is_empty() { Err("no channel".to_owned()) } else { Ok(channels) }
}

/// A channel of TwinCAT Scope with its times as in the file, and their unit in s: milliseconds, or ticks of file times
/// if the steps are that large. `step_s` is the sampling time of the header.
///
/// A slow channel may share the times of a fast one; its samples are then repeated until the next one, and the first of
/// each counts. Any other value in the header contradicts the times.
///
/// Source: TE13xx TC3 Scope View, export to csv.
fn scope_channel(
    name: &str,
    times: Vec<f64>,
    values: Vec<f64>,
    step_s: Option<f64>,
) -> Result<(f64, Channel), String> {
    let of = |times_s, values| Channel { name: name.to_owned(), times_s, values };
    let steps: Vec<f64> = times.windows(2).map(|w| w[1] - w[0]).collect();
    let positive = |s: &f64| *s > 0.0;
    let listed = step_s.filter(positive);
    let (Some(step), Some(step_s)) = (median(&steps).filter(positive), listed) else {
        return Ok((SCOPE_UNITS[0], of(times, values)));
    };
    let away = |unit_s: &f64| libm::fabs(libm::log(step * unit_s / step_s));
    let nearer = |a: f64, b: f64| if away(&b) < away(&a) { b } else { a };
    let unit_s = SCOPE_UNITS.into_iter().reduce(nearer).unwrap_or(SCOPE_UNITS[0]);
    let repeats = step_s / (step * unit_s);
    let same = (repeats - 1.0).abs() <= JITTER_RATIO;
    let each = repeats.round() as usize;
    let held = |block: &[f64]| block.iter().all(|x| x.to_bits() == block[0].to_bits());
    if same {
        return Ok((unit_s, of(times, values)));
    }
    if (repeats - repeats.round()).abs() <= JITTER_RATIO
        && each > 1
        && values.chunks(each).all(held)
    {
        let thin = |all: &[f64]| all.iter().copied().step_by(each).collect();
        return Ok((unit_s, of(thin(&times), thin(&values))));
    }
    Err(format!(
        "column {name}: its header states {SAMPLE_TIME} {}, its times increase by {} ms",
        1e3 * step_s,
        1e3 * step * unit_s
    ))
}

/// The column of the times and its unit in s: by its name, and by the unit in the name or in `units`, the line below.
fn time_column(names: &[String], units: &[&str]) -> Result<Option<(usize, f64)>, String> {
    let column = names.iter().enumerate().find_map(|(i, name)| {
        let lower = name.to_ascii_lowercase();
        let base = lower.split(['[', '(']).next().unwrap_or_default().trim().to_owned();
        let written =
            lower.split_once(['[', '(']).map(|(_, u)| u.trim_end_matches([']', ')']).to_owned());
        let below = units.get(i).map(|u| u.trim_matches(['[', ']', '(', ')']).to_owned());
        let (_, seconds) = TIME_NAMES.iter().find(|(n, _)| *n == base)?;
        let unit = written.or(below).map(|u| u.trim().to_owned()).filter(|u| !u.is_empty());
        let Some(unit) = unit else { return Some(Ok((i, *seconds))) };
        let known = TIME_UNITS.iter().find(|(u, _)| *u == unit).map(|(_, seconds)| (i, *seconds));
        Some(known.ok_or_else(|| {
            format!("column {name}: `{unit}` is not a unit of time; use s, ms, us, ns, min or h")
        }))
    });
    column.transpose()
}

/// Reads a table with column names in the last header line that is wide enough, and units in another line or in the
/// names.
fn plain(
    header: &[Vec<&str>],
    data: &[Vec<&str>],
    separator: char,
    columns: usize,
) -> Result<Vec<Channel>, String> {
    let unit = |c: &str| {
        let time = || TIME_UNITS.iter().any(|(unit, _)| *unit == c);
        c.starts_with('[') || ["mm", "m", "m/s2", "mm/s2", "g", "V"].contains(&c) || time()
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
    let time = time_column(&names, &units)?;
    let mut channels = Vec::new();
    for (i, name) in names.iter().enumerate().take(columns) {
        if time.is_some_and(|(t, _)| t == i) {
            continue;
        }
        // a column of words (the line, the speed reason) is not a signal
        let word = |row: &&Vec<&str>| {
            row.get(i).is_some_and(|c| !c.is_empty() && number(c, separator).is_none())
        };
        if data.first().is_some_and(|row| word(&row)) {
            continue;
        }
        let (times, values) =
            column(data, time.map(|t| t.0), i, separator, header.len() + 1, name)?;
        channels.push(Channel { name: name.clone(), times_s: times, values });
    }
    // a common zero for all channels, the earliest time
    let begins = channels.iter().filter_map(|c| c.times_s.first().copied());
    let zero = begins.fold(f64::INFINITY, f64::min);
    for channel in &mut channels {
        channel.times_s.iter_mut().for_each(|t| *t = (*t - zero) * time.map_or(1.0, |t| t.1));
    }
    if channels.is_empty() {
        Err("no numeric column besides the times".to_owned())
    } else {
        Ok(channels)
    }
}

/// The channel of a name: as written, otherwise ignoring case, otherwise as the end of a dotted name.
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
mod tests;
