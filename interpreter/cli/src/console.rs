//! Output: results to stdout, messages to stderr, a progress bar to stderr if it is a terminal.
//!
//! A command uses one console, and ends with [`Console::finish`].
//!
//! ```
//! use kontur::console::Console;
//! use kontur::{Error, Exit};
//!
//! let mut console = Console::new(std::io::sink(), std::io::sink());
//! console.print("a result\n")?;
//! let done = Err(Error::Usage("no such option".to_owned()));
//! assert_eq!(console.finish(done), Exit::Usage);
//! # Ok::<(), Error>(())
//! ```

use crate::args::MessageForm;
use crate::error::{Error, Exit};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use kontur_interpreter::diag::render::{self, printable};
use kontur_interpreter::diag::{Diagnostic, Severity, shortened};
use std::io::{IsTerminal, Write};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// Stdout and stderr of one command; tests put buffers in their place.
pub struct Console {
    out: Output,
    err: Box<dyn Write>,
    terminal: bool,
    colours: bool,
    form: MessageForm,
}

impl std::fmt::Debug for Console {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Console").field("terminal", &self.terminal).finish_non_exhaustive()
    }
}

impl Console {
    /// The stdout and stderr of the process; with progress if stderr is a terminal, and with colours unless `NO_COLOR`
    /// is set.
    pub(crate) fn of_process() -> Self {
        let terminal = std::io::stderr().is_terminal();
        let unwanted = std::env::var_os("NO_COLOR").is_some_and(|value| !value.is_empty());
        Self {
            out: Output(Arc::new(Mutex::new(std::io::stdout()))),
            err: Box::new(std::io::stderr()),
            terminal,
            colours: terminal && !unwanted,
            form: MessageForm::Text,
        }
    }

    /// Any two writers that are not terminals.
    pub fn new(out: impl Write + Send + 'static, err: impl Write + 'static) -> Self {
        Self {
            out: Output(Arc::new(Mutex::new(out))),
            err: Box::new(err),
            terminal: false,
            colours: false,
            form: MessageForm::Text,
        }
    }

    /// Stdout, for a trace.
    pub fn output(&self) -> Output {
        self.out.clone()
    }

    /// Sets the form of all messages from now on.
    pub const fn speak(&mut self, form: MessageForm) {
        self.form = form;
    }

    /// Prints a message to stderr.
    pub(crate) fn announce(&mut self, message: &Diagnostic) {
        let text = match self.form {
            MessageForm::Text => render::text(message, self.colours),
            MessageForm::Json => render::json(message),
        };
        self.error_text(&text);
    }

    /// Prints a message that is not a diagnostic of a program or a list, in the same form.
    pub fn say(&mut self, severity: Severity, text: &str) {
        let text = printable(&shortened(text.to_owned()));
        let line = match self.form {
            MessageForm::Text => format!("{severity}: {text}"),
            MessageForm::Json => {
                serde_json::json!({ "id": null, "severity": severity, "text": text }).to_string()
            }
        };
        self.error_text(&line);
    }

    /// Writes a result, with a line end if it has none. If the pipe is closed, output ends silently.
    ///
    /// # Errors
    /// [`Error::Io`] if stdout cannot be written.
    pub fn print(&mut self, text: &str) -> Result<(), Error> {
        let end = if text.ends_with('\n') || text.is_empty() { "" } else { "\n" };
        match write!(self.out, "{text}{end}").and_then(|()| self.out.flush()) {
            Err(e) if e.kind() == std::io::ErrorKind::BrokenPipe => Ok(()),
            other => other.map_err(|e| Error::io("stdout", e)),
        }
    }

    /// Writes a message to stderr, with a line end if it has none.
    pub(crate) fn error_text(&mut self, text: &str) {
        let end = if text.ends_with('\n') || text.is_empty() { "" } else { "\n" };
        // there is no way to report a failure of stderr
        let _ = write!(self.err, "{text}{end}").and_then(|()| self.err.flush());
    }

    /// Turns the result of a command into its exit code and prints its error.
    pub fn finish(&mut self, done: Result<Exit, Error>) -> Exit {
        match done {
            Ok(exit) => exit,
            // the reader of the pipe needs no more
            Err(e @ Error::ClosedPipe) => e.exit(),
            Err(e) => {
                self.say(Severity::Error, &e.to_string());
                e.exit()
            }
        }
    }

    /// A progress display, which shows nothing during the first second or without a terminal.
    pub fn progress(&self) -> Progress {
        let bar = ProgressBar::with_draw_target(None, ProgressDrawTarget::hidden());
        if let Ok(style) = ProgressStyle::with_template("{spinner} {elapsed} {msg}") {
            bar.set_style(style);
        }
        Progress { bar, wanted: self.terminal, shown: false }
    }
}

/// A handle on stdout; a trace is written by a separate thread.
#[derive(Clone)]
pub struct Output(Arc<Mutex<dyn Write + Send>>);

impl Output {
    fn lock(&self) -> MutexGuard<'_, dyn Write + Send + 'static> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl std::fmt::Debug for Output {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("Output")
    }
}

impl Write for Output {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.lock().write(bytes)
    }

    fn flush(&mut self) -> std::io::Result<()> {
        self.lock().flush()
    }
}

/// The progress display of a long run on a terminal.
#[derive(Debug)]
pub struct Progress {
    bar: ProgressBar,
    wanted: bool,
    shown: bool,
}

impl Progress {
    /// Work that is shorter than this is not displayed.
    const QUIET: Duration = Duration::from_secs(1);

    /// Shows the progress; the text is only made if it is displayed.
    pub fn show(&mut self, text: impl FnOnce() -> String) {
        if !self.wanted || (!self.shown && self.bar.elapsed() < Self::QUIET) {
            return;
        }
        if !self.shown {
            self.shown = true;
            self.bar.set_draw_target(ProgressDrawTarget::stderr());
        }
        self.bar.set_message(text());
        self.bar.tick();
    }

    /// Shows how many of all runs are done, and the time for the remaining ones if they take as long as those done
    /// since the beginning of this work (`now`).
    pub(crate) fn show_rest(&mut self, done: usize, all: usize, now: usize) {
        let left = rest(self.bar.elapsed(), now, all.saturating_sub(done));
        self.show(|| format!("{done} of {all} runs, {left} left"));
    }

    /// Hides the display while something else is printed on the terminal.
    pub(crate) fn suspend<R>(&self, f: impl FnOnce() -> R) -> R {
        if self.shown { self.bar.suspend(f) } else { f() }
    }
}

/// Remaining time in words, from the share of work done and the time it took.
fn rest(elapsed: Duration, done: usize, left: usize) -> String {
    let seconds = elapsed.as_secs_f64() * left as f64 / done.max(1) as f64;
    let whole = libm::ceil(seconds) as u64;
    match whole {
        0..120 => format!("{whole} s"),
        120..7200 => format!("{} min", whole.div_ceil(60)),
        _ => format!("{} h", whole.div_ceil(3600)),
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}

#[cfg(test)]
mod tests {
    use super::rest;
    use std::time::Duration;

    #[test]
    fn the_time_left_is_that_of_the_runs_before() {
        let rest = |seconds, done, left| rest(Duration::from_secs(seconds), done, left);
        assert_eq!(rest(10, 5, 20), "40 s");
        assert_eq!(rest(100, 1, 2), "4 min");
        assert_eq!(rest(3600, 1, 3), "3 h");
        assert_eq!(rest(10, 5, 0), "0 s");
    }
}
