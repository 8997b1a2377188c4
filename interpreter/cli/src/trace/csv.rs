//! The CSV writer: one header line, one line per cycle, whole lines only.

use super::batch::{Batch, Head};
use super::fixed::{Cells, NumberTable, Repeating};
use crate::clock::now;
use crate::console::Output;
use crate::target;
use kontur_interpreter::job::{Facts, FileNames};
use kontur_interpreter::record::columns::{Column, Content};
use std::io::{self, Write};
use std::time::{Duration, Instant};

/// Converts rows to lines of CSV.
#[derive(Clone, Debug)]
pub(crate) struct Rows {
    names: Vec<String>,
    stretches: Vec<Stretch>,
    numbers: NumberTable,
    cycle_us: u64,
    files: FileNames,
    last_line: Repeating,
    last_block: Repeating,
    last_limit: Repeating,
}

/// A column that is not a number, and the numeric columns after it: the data read for every row.
#[derive(Clone, Copy, Debug)]
struct Stretch {
    content: Content,
    /// Number of numeric columns up to the next one that is not.
    numbers_to: usize,
}

impl Rows {
    /// Rows with the given columns, the first of which is the time.
    pub(crate) fn new(columns: &[Column], facts: &Facts) -> Self {
        let mut stretches: Vec<Stretch> = Vec::new();
        let mut decimals = Vec::new();
        for column in columns {
            if column.content.is_number() {
                decimals.push(column.decimals);
            } else {
                stretches.push(Stretch { content: column.content, numbers_to: 0 });
            }
            if let Some(last) = stretches.last_mut() {
                last.numbers_to = decimals.len();
            }
        }
        Self {
            names: columns.iter().map(|column| column.name.clone()).collect(),
            stretches,
            numbers: NumberTable::new(&decimals),
            cycle_us: u64::from(facts.cycle_us),
            files: facts.files.clone(),
            last_line: Repeating::default(),
            last_block: Repeating::default(),
            last_limit: Repeating::default(),
        }
    }

    /// Appends the header line.
    pub(crate) fn push_header(&self, out: &mut Cells) {
        for name in &self.names {
            out.push_bytes(quoted(name).as_bytes());
            out.push_comma();
        }
        out.end_line();
    }

    /// Appends the line of each row.
    pub(crate) fn push_rows(&mut self, out: &mut Cells, batch: &Batch) {
        for first in (0..batch.len()).step_by(NumberTable::ROWS) {
            for (row, head) in self.take(batch, first).iter().enumerate() {
                self.push_row(out, row, head);
            }
        }
    }

    /// Takes the numbers of some rows together, from row `first` of a batch on; returns their other values.
    fn take<'a>(&mut self, batch: &'a Batch, first: usize) -> &'a [Head] {
        let rows = first..batch.len().min(first + NumberTable::ROWS);
        self.numbers.take(batch.numbers(), rows.clone());
        &batch.heads()[rows]
    }

    /// Appends the line of one of these rows.
    fn push_row(&mut self, out: &mut Cells, row: usize, head: &Head) {
        let mut from = 0;
        for &Stretch { content, numbers_to } in &self.stretches {
            match content {
                Content::Time => out.push_seconds(head.k.saturating_mul(self.cycle_us)),
                Content::Line => out.push_integer(u64::from(head.line), &mut self.last_line),
                Content::Block => match head.block {
                    Some(n) => out.push_integer(n, &mut self.last_block),
                    None => out.push_comma(),
                },
                Content::File => {
                    out.push_bytes(quoted(&self.files.name(head.file)).as_bytes());
                    out.push_comma();
                }
                Content::Limit => {
                    out.push_name(head.limit as u64, head.limit.name(), &mut self.last_limit);
                }
                // handled as the numbers after a column
                Content::Axis(..) | Content::Path(_) => {}
            }
            self.numbers.push(out, row, from..numbers_to);
            from = numbers_to;
        }
        out.end_line();
    }
}

/// A cell as CSV requires it: quoted only if necessary.
fn quoted(cell: &str) -> String {
    if cell.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", cell.replace('"', "\"\""))
    } else {
        cell.to_owned()
    }
}

/// The beginning of every trace.
const START: &[u8] = b"t_s,";

/// Destination of the lines.
#[derive(Debug)]
pub(crate) enum Target {
    /// A file.
    File(target::Target),
    /// Stdout.
    Standard(Output),
}

impl Target {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match self {
            Self::File(target) => target.file()?.write(bytes),
            Self::Standard(out) => out.write(bytes),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        match self {
            // the run has begun: the file gets its name
            Self::File(target) => target.show_over(START),
            Self::Standard(out) => out.flush(),
        }
    }

    fn finish(&mut self) -> io::Result<()> {
        match self {
            Self::File(target) => target.show(),
            Self::Standard(_) => Ok(()),
        }
    }

    /// Removes an incomplete line. Pipes and devices cannot be cut; there the line stays, and the error is reported.
    fn cut(&mut self, length: u64) {
        if let Self::File(target) = self
            && let Ok(file) = target.file()
        {
            let _ = file.set_len(length);
        }
    }
}

/// A trace file that contains whole lines only at every moment between two writes.
#[derive(Debug)]
pub(crate) struct CsvWriter {
    rows: Rows,
    target: Target,
    buffer: Cells,
    /// Number of bytes handed over.
    written: u64,
    /// Number of rows in the buffer.
    waiting: u64,
    /// Time at which lines were last handed over.
    flushed: Instant,
    /// Whether lines are missing.
    failed: bool,
}

impl CsvWriter {
    /// Size of the pieces in which lines are handed to the system.
    const PIECE: usize = 256 * 1024;
    /// Longest time between two pieces, which bounds the loss after a kill.
    const PERIOD: Duration = Duration::from_millis(900);
    /// Number of rows between two checks of the clock.
    const LOOK_EVERY: u64 = 16;

    /// Starts a trace with its header.
    pub(crate) fn new(target: Target, rows: Rows) -> Self {
        let mut buffer = Cells::with_capacity(Self::PIECE + 4096);
        rows.push_header(&mut buffer);
        Self { rows, target, buffer, written: 0, waiting: 0, flushed: now(), failed: false }
    }

    /// Adds rows.
    ///
    /// # Errors
    /// The system's, e.g. for a full disk; the file then ends with a whole line.
    pub(crate) fn write(&mut self, batch: &Batch) -> io::Result<()> {
        for first in (0..batch.len()).step_by(NumberTable::ROWS) {
            for (row, head) in self.rows.take(batch, first).iter().enumerate() {
                self.rows.push_row(&mut self.buffer, row, head);
                self.waiting += 1;
                let late = self.waiting.is_multiple_of(Self::LOOK_EVERY)
                    && self.flushed.elapsed() >= Self::PERIOD;
                if self.buffer.len() >= Self::PIECE || late {
                    self.flush()?;
                }
            }
        }
        Ok(())
    }

    /// Hands every line to the system; a header without rows is kept back.
    ///
    /// # Errors
    /// As [`CsvWriter::write`].
    pub(crate) fn flush(&mut self) -> io::Result<()> {
        self.flushed = now();
        if std::mem::take(&mut self.waiting) == 0 {
            return Ok(());
        }
        let mut done = 0;
        let lines = self.buffer.as_bytes();
        let result = loop {
            match self.target.write(&lines[done..]) {
                _ if done == lines.len() => break self.target.flush(),
                Ok(0) => break Err(io::ErrorKind::WriteZero.into()),
                Ok(n) => done += n,
                Err(e) if e.kind() == io::ErrorKind::Interrupted => {}
                Err(e) => break Err(e),
            }
        };
        self.failed |= result.is_err();
        if result.is_err() {
            let whole = lines[..done].iter().rposition(|&b| b == b'\n').map_or(0, |i| i + 1);
            self.target.cut(self.written + whole as u64);
        }
        self.written += done as u64;
        self.buffer.clear();
        result
    }

    /// Completes the file, which then has its name unless there are no rows or lines are missing.
    ///
    /// # Errors
    /// As [`CsvWriter::write`].
    pub(crate) fn finish(&mut self) -> io::Result<()> {
        self.flush()?;
        if self.written == 0 || self.failed { Ok(()) } else { self.target.finish() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trace::batch::Numbers;
    use crate::trace::columns;
    use kontur_interpreter::job::AxisFacts;
    use kontur_interpreter::record::{AxisRecord, CycleRecord, PathRecord, SpeedLimit};

    fn facts(files: &[&str]) -> Facts {
        Facts {
            cycle_us: 500,
            axes: vec![AxisFacts { name: "X".to_owned(), ..AxisFacts::default() }],
            files: FileNames::new(files.iter().map(|&f| f.to_owned()).collect(), false),
            ..Facts::default()
        }
    }

    fn record(k: u64) -> CycleRecord {
        CycleRecord {
            k,
            line: 6,
            block: (k > 0).then_some(50),
            file: 1,
            path: PathRecord {
                v_mm_s: 66.6666666,
                limit: SpeedLimit::AxDev,
                ..PathRecord::default()
            },
            axes: vec![AxisRecord { ipo: -0.5, ..AxisRecord::default() }],
            ..CycleRecord::default()
        }
    }

    fn batch(signals: &str, facts: &Facts, cycles: impl IntoIterator<Item = u64>) -> (Rows, Batch) {
        let columns = columns::select(signals, facts).unwrap();
        let mut batch = Batch::default();
        let numbers = Numbers::of(&columns);
        cycles.into_iter().for_each(|k| batch.push(&numbers, &record(k)));
        (Rows::new(&columns, facts), batch)
    }

    #[test]
    fn rows_read_as_plain_csv() {
        let facts = facts(&["a.nc", "sub, \"old\".nc"]);
        let (mut rows, batch) = batch("v_mm_s,v_limit,ipo", &facts, [0, 3]);
        let mut out = Cells::default();
        rows.push_header(&mut out);
        rows.push_rows(&mut out, &batch);
        assert_eq!(
            std::str::from_utf8(out.as_bytes()).unwrap(),
            "t_s,line,block,file,v_mm_s,v_limit,X_ipo_mm\n\
             0.000000,6,,\"sub, \"\"old\"\".nc\",66.666667,ax_dev,-0.5000000\n\
             0.001500,6,50,\"sub, \"\"old\"\".nc\",66.666667,ax_dev,-0.5000000\n"
        );
    }

    #[test]
    fn long_traces_arrive_complete() {
        let facts = facts(&["a.nc"]);
        let (rows, batch) = batch(columns::DEFAULT_SIGNALS, &facts, 0..20_000);
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.csv");
        let mut writer = CsvWriter::new(Target::File(target::Target::create(&path).unwrap()), rows);
        writer.write(&batch).unwrap();
        let before = std::fs::read(&path).unwrap();
        assert!(!before.is_empty() && before.ends_with(b"\n"), "pieces end with a line");
        writer.finish().unwrap();
        let text = std::fs::read_to_string(&path).unwrap();
        assert_eq!(text.lines().count(), 20_001);
        assert!(text.lines().last().unwrap().starts_with("9.999500,6,50,"));
    }

    #[test]
    #[cfg(target_os = "linux")]
    fn a_full_disk_is_an_error() {
        let facts = facts(&["a.nc"]);
        let (rows, batch) = batch("ipo", &facts, [0]);
        let full = target::Target::create("/dev/full".as_ref()).unwrap();
        let mut writer = CsvWriter::new(Target::File(full), rows);
        writer.write(&batch).unwrap();
        assert_eq!(writer.flush().unwrap_err().kind(), io::ErrorKind::StorageFull);
    }
}
