//! The forms of the times: text, JSON and a table of all lines.

use super::{Help, MOST_EXPENSIVE, Range, Reason, TimeByReason, TimeOfLine, Times};
use kontur_interpreter::source::text::{Text, beginning};
use kontur_interpreter::summary::Summary;
use serde::Serialize;
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::io::{BufRead as _, BufReader};

/// Number of reasons shown per line; one with less than this share of it is left out.
const REASONS_MAX: usize = 3;
const REASON_SHARE_MIN: f64 = 0.05;

impl TimeByReason {
    /// `axis_a of Y (to corner)`.
    fn describe(&self) -> String {
        let mut out = self.reason.name().to_owned();
        if let Some(axis) = &self.axis {
            // writing to a String cannot fail
            let _ = write!(out, " of {axis}");
        }
        if let Some(towards) = self.towards {
            let _ = write!(out, " ({towards})");
        }
        out
    }
}

impl Times {
    /// The readable form: by reason, the ten most expensive lines, the ranges of the axes.
    pub(crate) fn text(&self) -> String {
        let mut out = String::new();
        let _ = self.write_text(&mut out);
        out
    }

    fn write_text(&self, out: &mut String) -> std::fmt::Result {
        writeln!(out, "time by reason, of {:.3} s", self.duration_s)?;
        for r in &self.reasons {
            writeln!(
                out,
                "  {:<28} {:>10.3} s {:>6.1} %",
                r.describe(),
                r.seconds,
                100.0 * r.share
            )?;
        }
        let sources = self.sources();
        writeln!(out, "lines that take the most time")?;
        for line in self.lines.iter().take(MOST_EXPENSIVE) {
            let place = format!("{}:{}", line.file, line.line);
            let source = sources.get(&(line.file.as_str(), line.line)).map_or("", String::as_str);
            writeln!(
                out,
                "  {place:<24} {:>10.3} s {:>6.1} %  {:<6} {}",
                line.seconds,
                100.0 * line.share,
                line.kind,
                line.mainly()
            )?;
            if !source.is_empty() {
                writeln!(out, "      {source}")?;
            }
            if let Some(Help { what, saves_s }) = &line.helps {
                writeln!(out, "      {what} saves {saves_s:.3} s here")?;
            }
        }
        if !self.proposals.is_empty() {
            writeln!(out, "possible savings, one run each")?;
        }
        for p in &self.proposals {
            let (verb, s) =
                if p.saves_s < 0.0 { ("costs", -p.saves_s) } else { ("saves", p.saves_s) };
            writeln!(out, "  {:<40} {verb} {s:>8.3} s  ({})", p.what, p.parameters)?;
        }
        writeln!(out, "axes, minimum and maximum")?;
        for a in &self.axes {
            let pair = |(least, greatest): Range, digits: usize| {
                format!("{least:.digits$} .. {greatest:.digits$}")
            };
            write!(
                out,
                "  {:<6} {} {unit}, {} {unit}/s, {} {unit}/s2",
                a.name,
                pair(a.position, 4),
                pair(a.velocity, 3),
                pair(a.acceleration, 1),
                unit = a.unit
            )?;
            if a.torque_n_m != (0.0, 0.0) {
                write!(out, ", torque feedforward {} Nm", pair(a.torque_n_m, 3))?;
            }
            writeln!(out)?;
        }
        Ok(())
    }

    /// The JSON object of a summary with the times as its last field, `times`.
    pub(crate) fn json_of(&self, summary: &Summary) -> String {
        #[derive(Serialize)]
        struct WithTimes<'a> {
            #[serde(flatten)]
            summary: &'a Summary,
            times: serde_json::Value,
        }
        let object = WithTimes { summary, times: self.json() };
        serde_json::to_string(&object).unwrap_or_default()
    }

    /// The part of the summary: by reason, the ten most expensive lines, the ranges of the axes.
    fn json(&self) -> serde_json::Value {
        serde_json::json!({
            "duration_s": self.duration_s,
            "reasons": self.reasons,
            "most_expensive_lines": self.lines.iter().take(MOST_EXPENSIVE).collect::<Vec<_>>(),
            "axes": self.axes,
            "proposals": self.proposals,
        })
    }

    /// One row per line in the order of files and lines, one column per reason in s.
    ///
    /// # Errors
    /// None when writing to memory.
    pub(crate) fn csv(&self) -> Result<Vec<u8>, csv::Error> {
        let mut table = csv::Writer::from_writer(Vec::new());
        let fixed = ["file", "line", "block", "kind", "total_s", "share"].map(str::to_owned);
        let reasons = Reason::ALL.iter().map(|r| format!("{}_s", r.name()));
        table.write_record(fixed.into_iter().chain(reasons))?;
        let order: Vec<String> = self.files.all();
        let number = |line: &TimeOfLine| order.iter().position(|f| *f == line.file);
        let mut lines: Vec<(_, &TimeOfLine)> =
            self.lines.iter().map(|l| ((number(l), l.line), l)).collect();
        lines.sort_by_key(|(place, _)| *place);
        for (_, line) in lines {
            let block = line.block.map_or_else(String::new, |n| n.to_string());
            let fixed = [
                line.file.clone(),
                line.line.to_string(),
                block,
                line.kind.to_owned(),
                format!("{:.6}", line.seconds),
                format!("{:.6}", line.share),
            ];
            let seconds = Reason::ALL.iter().map(|reason| {
                let of = line.reasons.iter().filter(|r| r.reason == *reason);
                format!("{:.6}", of.fold(0.0, |sum, r| sum + r.seconds))
            });
            table.write_record(fixed.into_iter().chain(seconds))?;
        }
        table.into_inner().map_err(|e| e.into_error().into())
    }

    /// Text of the most expensive lines, for files that can be read again.
    fn sources(&self) -> BTreeMap<(&str, u32), String> {
        let mut wanted: BTreeMap<&str, Vec<u32>> = BTreeMap::new();
        for line in self.lines.iter().take(MOST_EXPENSIVE) {
            wanted.entry(&line.file).or_default().push(line.line);
        }
        let mut found = BTreeMap::new();
        for (name, numbers) in wanted {
            let Ok(file) = crate::files::regular(name.as_ref()) else { continue };
            let Ok(text) = Text::new(file) else { continue };
            let last = numbers.iter().max().copied().unwrap_or_default();
            for (number, text) in (1..=last).zip(BufReader::new(text).split(b'\n')) {
                let Ok(text) = text else { break };
                if numbers.contains(&number) {
                    let text = String::from_utf8_lossy(&text);
                    found.insert((name, number), beginning(text.trim()));
                }
            }
        }
        found
    }
}

impl TimeOfLine {
    /// `feed 60 %, slope (corner) 40 %`.
    fn mainly(&self) -> String {
        let large = |r: &&TimeByReason| r.seconds >= REASON_SHARE_MIN * self.seconds;
        let shown = self.reasons.iter().take(REASONS_MAX).filter(large);
        let shown: Vec<String> = shown
            .map(|r| format!("{} {:.0} %", r.describe(), 100.0 * r.seconds / self.seconds))
            .collect();
        shown.join(", ")
    }
}
