//! Requests of the page and their answers.

use kontur_interpreter::diag::{Diagnostic, Severity};
use kontur_interpreter::explain::explain;
use kontur_interpreter::job::{ForcedGuard, Job, MachineLists, Options, Run, Sink};
use kontur_interpreter::record::columns::{self, Column};
use kontur_interpreter::record::{Asked, Rows};
use kontur_interpreter::source::MemorySources;
use kontur_interpreter::summary::{Collector, Summary};
use serde::{Deserialize, Serialize};
use std::convert::Infallible;

/// Name of the program in messages.
const PROGRAM: &str = "part.nc";
/// Blocks that a program of the page may execute; a fraction of a second.
const MAX_BLOCKS: u64 = 200_000;
/// Program time in s up to which a check looks ahead; a run is stopped by its rows long before.
const MAX_TIME_S: f64 = 3600.0;

/// A program with the settings shown next to it on the page.
#[derive(Deserialize)]
struct Request {
    program: String,
    /// As `--set`.
    #[serde(default)]
    settings: Vec<String>,
    /// `AX_DEV` in mm where the program gives none.
    #[serde(default)]
    ax_dev_mm: Option<f64>,
    /// Groups or names of columns.
    #[serde(default)]
    signals: String,
    /// Rows after which the run is stopped.
    #[serde(default = "rows")]
    max_rows: u32,
}

const fn rows() -> u32 {
    200_000
}

/// A message as an editor shows it.
#[derive(Serialize)]
struct Message {
    id: String,
    severity: Severity,
    text: String,
    hint: Option<String>,
    /// Place in the program, lines and columns from 1; none for what lists and settings are about.
    place: Option<Place>,
    time_s: Option<f64>,
}

#[derive(Serialize)]
struct Place {
    line: u32,
    column: u32,
    length: u32,
}

impl From<&Diagnostic> for Message {
    fn from(said: &Diagnostic) -> Self {
        let place = said.source.as_ref().filter(|at| &*at.file == PROGRAM);
        Self {
            id: said.id.to_string(),
            severity: said.severity,
            text: said.text.clone(),
            hint: said.hint.clone(),
            place: place.map(|at| Place { line: at.line, column: at.column, length: at.length }),
            time_s: said.time_s,
        }
    }
}

#[derive(Serialize)]
struct Checked {
    messages: Vec<Message>,
    refused: bool,
}

#[derive(Serialize)]
struct ColumnFacts {
    name: String,
    unit: String,
    decimals: u8,
}

#[derive(Serialize)]
struct Started {
    refused: bool,
    messages: Vec<Message>,
    cycle_s: f64,
    axes: Vec<String>,
    columns: Vec<ColumnFacts>,
}

#[derive(Serialize)]
struct Finished {
    /// Stopped before the end of the program because the page takes no more rows.
    cut: bool,
    messages: Vec<Message>,
    summary: Option<Summary>,
}

#[derive(Serialize)]
struct Explained {
    found: bool,
    title: String,
    meaning: String,
    facts: Vec<(String, String)>,
    notes: Vec<String>,
    example: Option<String>,
    /// Related things, or what was probably meant.
    related: Vec<String>,
}

/// A request that is invalid.
#[derive(Serialize)]
struct Wrong {
    wrong: String,
}

fn json(answer: &impl Serialize) -> String {
    serde_json::to_string(answer).unwrap_or_else(|e| format!(r#"{{"wrong":"{e}"}}"#))
}

fn wrong(e: &dyn std::fmt::Display) -> String {
    json(&Wrong { wrong: e.to_string() })
}

fn messages<'a>(said: impl IntoIterator<Item = &'a Diagnostic>) -> Vec<Message> {
    // an editor with more of them is of no use
    said.into_iter().take(500).map(Message::from).collect()
}

impl Request {
    fn job(&self) -> Result<Job, Vec<Diagnostic>> {
        let lists = MachineLists { settings: &self.settings, ..MachineLists::default() };
        let (machine, warnings) = lists.load()?;
        let sources = MemorySources::new().with(PROGRAM, self.program.as_bytes());
        let guard = |ax_dev_mm| ForcedGuard { settings: None, ax_dev_mm: Some(ax_dev_mm) };
        let options = Options {
            max_blocks: MAX_BLOCKS,
            max_blocks_at_rest: MAX_BLOCKS,
            max_time_s: MAX_TIME_S,
            guard: self.ax_dev_mm.map(guard),
            ..Options::default()
        };
        Ok(Job::new(machine, sources, PROGRAM).with_warnings(warnings).with_options(options))
    }
}

/// A run under way with what the page gets of it.
#[derive(Debug)]
struct UnderWay {
    run: Run,
    shown: Shown,
    messages: Vec<Diagnostic>,
    max_rows: usize,
}

/// What the page shows of it.
#[derive(Debug)]
struct Shown {
    columns: Vec<Column>,
    /// Numbers of each column, and the line of every row.
    values: Vec<Vec<f64>>,
    lines: Vec<f64>,
    collector: Option<Collector>,
}

impl Sink for Shown {
    type Stop = Infallible;

    fn reads(&self) -> Option<Asked> {
        Some(columns::asked(&self.columns).and(Collector::asked()))
    }

    fn rows(&mut self, rows: &Rows<'_>) -> Result<(), Infallible> {
        self.lines.extend(rows.cycles().iter().map(|cycle| f64::from(cycle.line)));
        for (column, values) in self.columns.iter().zip(&mut self.values) {
            column.content.extend(values, rows, 1);
        }
        if let Some(collector) = &mut self.collector {
            collector.add(rows);
        }
        Ok(())
    }
}

/// Answers requests; holds at most one run.
#[derive(Debug, Default)]
pub struct Session {
    under_way: Option<UnderWay>,
}

impl Session {
    /// Every message about a program, without moving anything.
    pub fn check(&self, request: &str) -> String {
        let request: Request = match serde_json::from_str(request) {
            Ok(request) => request,
            Err(e) => return wrong(&e),
        };
        match request.job() {
            Ok(job) => {
                let checked = job.check();
                let refused = checked.refuses();
                json(&Checked { messages: messages(&checked.diagnostics), refused })
            }
            Err(said) => json(&Checked { messages: messages(&said), refused: true }),
        }
    }

    /// What `kontur explain` says about a thing, or about its longest known prefix.
    pub fn explain(&self, thing: &str) -> String {
        let explained = match explain(thing) {
            Ok(e) => Explained {
                found: true,
                title: e.title,
                meaning: e.meaning,
                facts: e.facts.into_iter().map(|(name, fact)| (name.to_owned(), fact)).collect(),
                notes: e.notes,
                example: e.example,
                related: e.related,
            },
            Err(near) => Explained {
                found: false,
                title: thing.to_owned(),
                meaning: String::new(),
                facts: Vec::new(),
                notes: Vec::new(),
                example: None,
                related: near,
            },
        };
        json(&explained)
    }

    /// Starts a run instead of the one before.
    pub fn start(&mut self, request: &str) -> String {
        self.under_way = None;
        let request: Request = match serde_json::from_str(request) {
            Ok(request) => request,
            Err(e) => return wrong(&e),
        };
        let refused = |said: &[Diagnostic]| {
            json(&Started {
                refused: true,
                messages: messages(said),
                cycle_s: 0.0,
                axes: Vec::new(),
                columns: Vec::new(),
            })
        };
        let mut run = match request.job().and_then(|job| job.start()) {
            Ok(run) => run,
            Err(said) => return refused(&said),
        };
        if run.is_over() {
            return refused(&run.take_diagnostics());
        }
        let columns = match columns::select(&request.signals, run.facts()) {
            Ok(columns) => columns,
            Err(e) => return wrong(&e),
        };
        // what is a number and is not known without the run
        let numbers = |c: &Column| c.number(run.record()).is_some();
        let columns: Vec<Column> = columns.into_iter().filter(numbers).collect();
        let answer = json(&Started {
            refused: false,
            messages: Vec::new(),
            cycle_s: run.facts().cycle_s(),
            axes: run.facts().axes.iter().map(|axis| axis.name.clone()).collect(),
            columns: columns
                .iter()
                .map(|c| ColumnFacts {
                    name: c.name.clone(),
                    unit: c.unit.clone(),
                    decimals: c.decimals,
                })
                .collect(),
        });
        let shown = Shown {
            values: vec![Vec::new(); columns.len()],
            lines: Vec::new(),
            collector: Some(Collector::new(run.facts())),
            columns,
        };
        let max_rows = usize::try_from(request.max_rows).unwrap_or(usize::MAX);
        self.under_way = Some(UnderWay { run, shown, messages: Vec::new(), max_rows });
        answer
    }

    /// Computes up to so many cycles; true while there are more.
    pub fn advance(&mut self, cycles: u32) -> bool {
        let Some(UnderWay { run, shown, messages, max_rows }) = &mut self.under_way else {
            return false;
        };
        let room = max_rows.saturating_sub(shown.lines.len());
        let cycles = u64::from(cycles).min(u64::try_from(room).unwrap_or(u64::MAX));
        let Ok(()) = run.advance(cycles, shown);
        // a program may say the same in every pass of a loop
        let said = run.take_diagnostics();
        let known = messages.len();
        messages.extend(said.into_iter().take(1000_usize.saturating_sub(known)));
        !run.is_over() && shown.lines.len() < *max_rows
    }

    /// Summary and messages of the run, to its end or to where it was left.
    pub fn finish(&mut self) -> String {
        let Some(UnderWay { run, shown, messages: said, .. }) = &mut self.under_way else {
            return wrong(&"no run is active");
        };
        let cut = !run.is_over();
        let summary = shown.collector.take().map(|collector| collector.finish(&run.totals()));
        json(&Finished { cut, messages: messages(&*said), summary })
    }

    /// Values of a column of the run in the order of the request; after them the line of every row. Empty for others.
    pub fn column(&self, i: usize) -> &[f64] {
        let Some(UnderWay { shown: Shown { values, lines, .. }, .. }) = &self.under_way else {
            return &[];
        };
        if i == values.len() { lines } else { values.get(i).map_or(&[], Vec::as_slice) }
    }
}
