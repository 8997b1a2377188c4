//! Source of the rows of a comparison: a CSV or Parquet file, or a fresh run.

use crate::error::Error;
use crate::trace::batch::{Batch, Numbers};
use crate::trace::csv::Rows;
use crate::trace::fixed::Cells;
use crate::trace::select;
use csv::{ByteRecord, ErrorKind};
use kontur_interpreter::diag::Diagnostic;
use kontur_interpreter::job::{Run, Sink};
use kontur_interpreter::record::columns::Column;
use kontur_interpreter::record::{self, Asked, columns};
use kontur_interpreter::source::text::Text;
use std::collections::VecDeque;
use std::convert::Infallible;
use std::fs::File;
use std::io::{self, Cursor, Read as _};
use std::path::Path;

/// Number of rows of a fresh run that are formatted at a time.
const BATCH: u64 = 256;

/// Rows with a header, read once from top to bottom.
pub(super) struct Table {
    name: String,
    header: Vec<String>,
    row: ByteRecord,
    rows: Origin,
    /// Rows that were read to find their distance in time.
    ahead: VecDeque<ByteRecord>,
    /// One row in so many is returned.
    every: u64,
    /// Rows to be passed over before the next one that is returned.
    skip: u64,
}

enum Origin {
    File(Box<csv::Reader<Text<File>>>),
    #[cfg(feature = "parquet")]
    Parquet(Box<super::parquet::Rows>),
    Run(Box<Fresh>),
}

struct Fresh {
    run: Run,
    columns: Vec<Column>,
    rows: Rows,
    batch: csv::Reader<Cursor<Vec<u8>>>,
}

/// Whether a file is a trace rather than an NC program.
///
/// # Errors
/// [`Error::Io`] if it cannot be read, [`Error::Usage`] for a table of another form.
pub(super) fn is_trace(path: &Path) -> Result<bool, Error> {
    let io = |e| Error::io(path.display().to_string(), e);
    let refused = |text: &str| Err(Error::Usage(format!("{}: {text}", path.display())));
    let is = |end: &str| path.extension().is_some_and(|e| e.eq_ignore_ascii_case(end));
    if !std::fs::metadata(path).map_err(io)?.is_file() {
        // a file that can be read only once is a program, unless its name says otherwise
        return if is("csv") { refused("not a regular file") } else { Ok(false) };
    }
    let start = first_bytes(path)?;
    let text = start.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(&start);
    match text {
        [b'P', b'A', b'R', b'1', ..] if cfg!(feature = "parquet") => Ok(true),
        [b'P', b'A', b'R', b'1', ..] => refused("this kontur was built without Parquet"),
        _ if is("parquet") => refused("not a Parquet file"),
        [b't', b'_', b's', b',' | b'\r' | b'\n', ..] | b"t_s" => Ok(true),
        [b't', b'_', b's', b';' | b'\t', ..] => refused(
            "its columns are not separated by commas; a trace has commas and decimal points; pass a recording as the second file with --map COLUMN=CHANNEL",
        ),
        [0xFF, 0xFE, ..] | [0xFE, 0xFF, ..] => refused("the text is UTF-16; save it as UTF-8"),
        // an empty or foreign table must not be taken for a program without motion
        [b'#', ..] if is("csv") => refused("it starts with a `#` line; a trace starts with `t_s`"),
        _ if is("csv") => refused(
            "not a trace, it does not start with `t_s`; pass a recording as the second file with --map COLUMN=CHANNEL",
        ),
        _ => Ok(false),
    }
}

fn unique(name: &str, header: &[String]) -> Result<(), Error> {
    match (1..header.len()).find(|i| header[..*i].contains(&header[*i])) {
        Some(i) => Err(Error::Usage(format!("{name}: column `{}` occurs twice", header[i]))),
        None => Ok(()),
    }
}

/// The first bytes of a file.
fn first_bytes(path: &Path) -> Result<Vec<u8>, Error> {
    let mut start = Vec::new();
    let read = File::open(path).and_then(|file| file.take(8).read_to_end(&mut start));
    read.map_err(|e| Error::io(path.display().to_string(), e))?;
    Ok(start)
}

/// Error of a table.
fn unreadable(name: &str, e: csv::Error) -> Error {
    let text = match e.kind() {
        ErrorKind::UnequalLengths { pos: Some(at), expected_len, len } => {
            format!("line {}: {len} columns where the header has {expected_len}", at.line())
        }
        ErrorKind::Utf8 { .. } => "the header is not UTF-8".to_owned(),
        _ => return Error::io(name, e.into()),
    };
    Error::io(name, io::Error::new(io::ErrorKind::InvalidData, text))
}

impl Table {
    /// A CSV or Parquet trace.
    ///
    /// # Errors
    /// [`Error::Io`] if it cannot be read, [`Error::Usage`] if it is not a trace.
    pub(super) fn read(path: &Path) -> Result<Self, Error> {
        let name = path.display().to_string();
        #[cfg(feature = "parquet")]
        if first_bytes(path)?.starts_with(b"PAR1") {
            let (header, rows) = super::parquet::Rows::open(path)?;
            unique(&name, &header)?;
            let rows = Origin::Parquet(Box::new(rows));
            return Ok(Self::of(name, header, rows));
        }
        let file = File::open(path).map_err(|e| Error::io(&name, e))?;
        let text = Text::new(file).map_err(|e| Error::io(&name, e))?;
        let mut reader = csv::ReaderBuilder::new().buffer_capacity(1 << 18).from_reader(text);
        let header = reader.headers().map_err(|e| unreadable(&name, e))?;
        let header: Vec<String> = header.iter().map(str::to_owned).collect();
        unique(&name, &header)?;
        let rows = Origin::File(Box::new(reader));
        Ok(Self::of(name, header, rows))
    }

    /// A run with the given columns or, without names, those of a trace by default. Columns that the run does not have
    /// are left out; the comparison reports them.
    ///
    /// # Errors
    /// [`Error::Usage`] if no columns can be selected.
    pub(super) fn run(run: Run, names: Option<&[String]>) -> Result<Self, Error> {
        let facts = run.facts();
        let columns: Vec<Column> = match names {
            Some(names) => {
                let all = columns::all(facts).into_iter();
                all.filter(|c| names.contains(&c.name)).collect()
            }
            None => select(columns::DEFAULT_SIGNALS, facts)?,
        };
        let header = columns.iter().map(|c| c.name.clone()).collect();
        let name = facts.program.clone();
        let rows = Rows::new(&columns, facts);
        let batch = reader(Vec::new());
        // there is no column for the deviation in both directions
        let run = run.without_both_ways();
        let rows = Origin::Run(Box::new(Fresh { run, columns, rows, batch }));
        Ok(Self::of(name, header, rows))
    }

    fn of(name: String, header: Vec<String>, rows: Origin) -> Self {
        Self {
            name,
            header,
            row: ByteRecord::new(),
            rows,
            ahead: VecDeque::new(),
            every: 1,
            skip: 0,
        }
    }

    /// Names of the columns.
    pub(super) fn header(&self) -> &[String] {
        &self.header
    }

    /// The times of the first two rows in s, before any row is taken; `None` if there are none.
    ///
    /// # Errors
    /// As [`Self::next`].
    pub(super) fn first_times(&mut self) -> Result<Option<[f64; 2]>, Error> {
        while self.ahead.len() < 2 && self.read_row()? {
            self.ahead.push_back(self.row.clone());
        }
        let Some(column) = self.header.iter().position(|name| name == "t_s") else {
            return Ok(None);
        };
        let time = |row: usize| {
            let cell = self.ahead.get(row)?.get(column)?;
            std::str::from_utf8(cell).ok()?.parse::<f64>().ok()
        };
        Ok(time(0).zip(time(1)).map(|(first, second)| [first, second]))
    }

    /// Returns only the first one of every so many rows.
    pub(super) fn thin(&mut self, every: u64) {
        self.every = every;
    }

    /// The next row.
    ///
    /// # Errors
    /// [`Error::Io`] if the file cannot be read or is not a table.
    pub(super) fn next(&mut self) -> Result<Option<&ByteRecord>, Error> {
        if !self.take_row()? {
            return Ok(None);
        }
        Ok(Some(&self.row))
    }

    /// Makes the next row that is returned the current one; false at the end.
    fn take_row(&mut self) -> Result<bool, Error> {
        let skipped = std::mem::replace(&mut self.skip, self.every.saturating_sub(1));
        for _ in 0..=skipped {
            if let Some(row) = self.ahead.pop_front() {
                self.row = row;
            } else if !self.read_row()? {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// Reads a row; false at the end.
    fn read_row(&mut self) -> Result<bool, Error> {
        let found = match &mut self.rows {
            Origin::File(reader) => reader.read_byte_record(&mut self.row),
            #[cfg(feature = "parquet")]
            Origin::Parquet(rows) => return rows.read(&mut self.row),
            Origin::Run(fresh) => fresh.read(&mut self.row),
        };
        found.map_err(|e| unreadable(&self.name, e))
    }

    /// Whether this was a run that was refused or has ended with an error.
    pub(super) fn has_failed(&self) -> bool {
        match &self.rows {
            Origin::File(_) => false,
            #[cfg(feature = "parquet")]
            Origin::Parquet(_) => false,
            Origin::Run(fresh) => fresh.run.totals().aborted,
        }
    }

    /// The messages of a fresh run.
    pub(super) fn take_messages(&mut self) -> Vec<Diagnostic> {
        match &mut self.rows {
            Origin::File(_) => Vec::new(),
            #[cfg(feature = "parquet")]
            Origin::Parquet(_) => Vec::new(),
            Origin::Run(fresh) => fresh.run.take_diagnostics(),
        }
    }
}

/// Rows of a fresh run.
struct Gathered {
    numbers: Numbers,
    asked: Asked,
    batch: Batch,
}

impl Sink for Gathered {
    type Stop = Infallible;

    fn reads(&self) -> Option<Asked> {
        Some(self.asked)
    }

    fn rows(&mut self, rows: &record::Rows<'_>) -> Result<(), Infallible> {
        self.batch.extend(&self.numbers, rows, 1);
        Ok(())
    }
}

impl Fresh {
    fn read(&mut self, row: &mut ByteRecord) -> Result<bool, csv::Error> {
        if self.batch.read_byte_record(row)? {
            return Ok(true);
        }
        let Self { run, columns, rows, .. } = self;
        let (numbers, asked) = (Numbers::of(columns), columns::asked(columns));
        let mut gathered = Gathered { numbers, asked, batch: Batch::default() };
        let Ok(()) = run.advance(BATCH, &mut gathered);
        let mut text = Cells::default();
        rows.push_rows(&mut text, &gathered.batch);
        self.batch = reader(text.into_bytes());
        self.batch.read_byte_record(row)
    }
}

fn reader(text: Vec<u8>) -> csv::Reader<Cursor<Vec<u8>>> {
    csv::ReaderBuilder::new().has_headers(false).from_reader(Cursor::new(text))
}
