//! The signals of a comparison with a recording: columns of the trace, channels of the recording, and both row by row.

use crate::args::Pairing;
use crate::diff::table::Table;
use crate::error::Error;
use crate::recorded::{self, Channel, DropOut, Even};

/// Longest signals that are compared, in cycles: more than an hour at 1 ms.
pub(super) const MOST_CYCLES: usize = 1 << 22;

/// Cycles between two samples from which on a recording is sampled more coarsely than the trace.
const COARSE: f64 = 1.5;

/// The paired columns of a trace.
pub(super) struct Trace {
    pub(super) times_s: Vec<f64>,
    /// NC lines and the rows with which they begin.
    lines: Vec<(usize, String)>,
    pub(super) columns: Vec<Vec<f64>>,
}

impl Trace {
    pub(super) fn line(&self, row: usize) -> Option<String> {
        let after = self.lines.partition_point(|(begin, _)| *begin <= row);
        self.lines.get(after.checked_sub(1)?).map(|(_, line)| line.clone())
    }
}

/// A channel at the sampling times of its recording, in the units of the trace.
pub(super) struct Recorded {
    pub(super) values: Vec<f64>,
    /// Time of the first sample on the common clock of all channels.
    begin_s: f64,
    step_s: f64,
    pub(super) drop_outs: Vec<DropOut>,
}

impl Recorded {
    /// Time of the last sample.
    pub(super) fn end_s(&self) -> f64 {
        self.begin_s + self.step_s * self.values.len().saturating_sub(1) as f64
    }

    /// Fractional index of a time.
    pub(super) fn place(&self, time_s: f64) -> f64 {
        (time_s - self.begin_s) / self.step_s
    }

    /// Linear interpolation between the samples; `None` outside, and where samples are missing.
    fn at(&self, time_s: f64) -> Option<f64> {
        let near_s = 1e-3 * self.step_s;
        // in the order of time: only the last one that has begun can contain it
        let begun = self.drop_outs.partition_point(|d| d.after_s + near_s < time_s);
        let last = begun.checked_sub(1).map(|i| &self.drop_outs[i]);
        let missing = |d: &DropOut| {
            time_s < d.after_s + self.step_s * (d.samples.len() as f64 + 1.0) - near_s
        };
        if last.is_some_and(missing) { None } else { self.between(time_s) }
    }

    /// Linear interpolation across missing samples.
    pub(super) fn between(&self, time_s: f64) -> Option<f64> {
        let place = self.place(time_s);
        let last = self.values.len().checked_sub(1)?;
        if place < -1e-6 || place > last as f64 + 1e-6 {
            return None;
        }
        let place = place.clamp(0.0, last as f64);
        let (k, part) = (place as usize, place.fract());
        let next = self.values[(k + 1).min(last)];
        Some(self.values[k] + part * (next - self.values[k]))
    }
}

pub(super) fn channels(
    found: &[Channel],
    pairings: &[Pairing],
    rate_hz: Option<f64>,
    file: &str,
) -> Result<Vec<Recorded>, Error> {
    let one = |p: &Pairing| {
        let channel = recorded::find(found, &p.channel).ok_or_else(|| {
            let names: Vec<&str> = found.iter().map(|c| c.name.as_str()).collect();
            format!("{file}: no channel `{}`; it has {}", p.channel, names.join(", "))
        })?;
        let even = channel.even(rate_hz).map_err(|e| format!("{file}: `{}`: {e}", channel.name))?;
        let Even { values, begin_s, step_s, drop_outs } = even;
        let values = values.iter().map(|v| p.factor * v).collect();
        Ok(Recorded { values, begin_s, step_s, drop_outs })
    };
    pairings.iter().map(|p| one(p).map_err(Error::Usage)).collect()
}

pub(super) fn read(table: &mut Table, pairings: &[Pairing]) -> Result<Trace, Error> {
    let header = table.header().to_vec();
    let find = |name: &str| header.iter().position(|h| h == name);
    let time = find("t_s").ok_or_else(|| Error::Usage("the trace has no column t_s".to_owned()))?;
    let line = find("line");
    let mut places = Vec::new();
    for p in pairings {
        places.push(find(&p.column).ok_or_else(|| {
            Error::Usage(format!(
                "the trace has no column `{}`; it has {}",
                p.column,
                header.join(", ")
            ))
        })?);
    }
    let mut trace =
        Trace { times_s: Vec::new(), lines: Vec::new(), columns: vec![Vec::new(); places.len()] };
    while let Some(row) = table.next()? {
        let text =
            |i: usize| std::str::from_utf8(row.get(i).unwrap_or_default()).unwrap_or_default();
        let number = |i: usize| text(i).trim().parse::<f64>().unwrap_or(f64::NAN);
        trace.times_s.push(number(time));
        if let Some(line) = line.map(text)
            && trace.lines.last().is_none_or(|(_, last)| last != line)
        {
            trace.lines.push((trace.times_s.len() - 1, line.to_owned()));
        }
        for (column, place) in trace.columns.iter_mut().zip(&places) {
            column.push(number(*place));
        }
        if trace.times_s.len() > MOST_CYCLES {
            break;
        }
    }
    for (p, column) in pairings.iter().zip(&trace.columns) {
        if !column.iter().any(|x| x.is_finite()) {
            return Err(Error::Usage(format!("the column `{}` has no numbers", p.column)));
        }
    }
    Ok(trace)
}

/// Statistics over the rows that both signals cover.
pub(super) struct Statistics {
    pub(super) rows: usize,
    /// Mean of recording - trace.
    pub(super) mean: f64,
    /// Root mean square around that.
    pub(super) rms: f64,
}

/// The signals row by row: row of the trace and both values. A recording that is sampled more coarsely than the rows is
/// compared at its samples, since its value in between is unknown.
pub(super) fn rows<'a>(
    times_s: &'a [f64],
    a: &'a [f64],
    recorded: &'a Recorded,
    shift_s: f64,
) -> impl Iterator<Item = (usize, f64, f64)> + 'a {
    let (begin_s, end_s) = (times_s[0], times_s[times_s.len() - 1]);
    let cycle_s = (end_s - begin_s) / (times_s.len() - 1) as f64;
    let is_coarse = recorded.step_s > COARSE * cycle_s;
    let of_rows = times_s
        .iter()
        .zip(a)
        .enumerate()
        .filter_map(move |(row, (t, a))| Some((row, *a, recorded.at(t - begin_s + shift_s)?)));
    let of_samples = (0..recorded.values.len()).filter_map(move |i| {
        let time_s = recorded.begin_s + recorded.step_s * i as f64;
        let b = recorded.at(time_s)?;
        let (row, a) = sampled(times_s, a, time_s - shift_s + begin_s)?;
        Some((row, a, b))
    });
    let of_rows = (!is_coarse).then_some(of_rows).into_iter().flatten();
    let all = of_rows.chain(is_coarse.then_some(of_samples).into_iter().flatten());
    all.filter(|(_, a, b)| a.is_finite() && b.is_finite())
}

/// Nearest row to a time, and the value of the trace at that time.
fn sampled(times_s: &[f64], a: &[f64], time_s: f64) -> Option<(usize, f64)> {
    let next = times_s.partition_point(|t| *t <= time_s).clamp(1, times_s.len() - 1);
    let (before_s, after_s) = (times_s[next - 1], times_s[next]);
    let part = (time_s - before_s) / (after_s - before_s);
    let value = a[next - 1] + part.clamp(0.0, 1.0) * (a[next] - a[next - 1]);
    let inside = (-1e-6..=1.0 + 1e-6).contains(&part);
    inside.then(|| (if part > 0.5 { next } else { next - 1 }, value))
}

pub(super) fn statistics(
    times_s: &[f64],
    a: &[f64],
    recorded: &Recorded,
    shift_s: f64,
) -> Statistics {
    let (mut count, mut sum, mut squares) = (0_usize, 0.0, 0.0);
    for (_, a, b) in rows(times_s, a, recorded, shift_s) {
        count += 1;
        sum += b - a;
        squares += (b - a) * (b - a);
    }
    let n = count.max(1) as f64;
    let mean = sum / n;
    Statistics { rows: count, mean, rms: libm::sqrt((squares / n - mean * mean).max(0.0)) }
}
