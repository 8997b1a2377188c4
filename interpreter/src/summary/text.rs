//! The summary in its readable form.

use super::Summary;
use super::ripple::CORNER_DEG;
use crate::diag::Severity;
use crate::record::{Rest, SpeedLimit};
use kontur_motion::deviation::HARDLY_LONGER;
use std::fmt::Write as _;

/// Differences in mm (deg) below this value are not visible in the text.
const LEAST_SHOWN: f64 = 5e-7;

fn many(n: usize, what: &str) -> String {
    format!("{n} {what}{}", if n == 1 { "" } else { "s" })
}

impl Summary {
    /// The readable form.
    pub fn text(&self) -> String {
        let mut out = String::new();
        // writing to a String cannot fail
        let _ = self.write_text(&mut out);
        out
    }

    fn write_text(&self, out: &mut String) -> std::fmt::Result {
        self.write_times(out)?;
        writeln!(out, "  path           {:.4} mm in {} blocks", self.path_length_mm, self.blocks)?;
        if let Some(ripple) = &self.speed_ripple {
            let (low, high) = (ripple.v_min_mm_s, ripple.v_max_mm_s);
            let place = self.place(&ripple.file, ripple.line, None);
            let percent = 100.0 * ripple.ratio;
            writeln!(
                out,
                "  speed ripple   {percent:.2} %: {low:.4} of {high:.4} mm/s at {place} (corners above {CORNER_DEG} deg excluded)"
            )?;
        }
        self.write_contour_error(out)?;
        if self.cycles > 0 {
            self.write_axes(out)?;
        }
        if self.duration_s > 0.0 {
            self.write_limits(out)?;
        }
        self.write_messages(out)
    }

    fn write_times(&self, out: &mut String) -> std::fmt::Result {
        writeln!(out, "{}  {}", self.program, self.state.name())?;
        let cycle_ms = f64::from(self.cycle_us) / 1000.0;
        writeln!(out, "  machine        {}, cycle {cycle_ms} ms", self.machine)?;
        writeln!(out, "  duration       {:.3} s ({} cycles)", self.duration_s, self.cycles)?;
        writeln!(out, "  ideal          {:.3} s (path / feed)", self.ideal_duration_s)?;
        if self.dwell_s > 0.0 {
            writeln!(out, "  dwells         {:.3} s", self.dwell_s)?;
        }
        if self.technology_s > 0.0 {
            let text = "M, H, S and T functions, by their declared durations";
            writeln!(out, "  technology     {:.3} s ({text})", self.technology_s)?;
        }
        if self.held_s > 0.0 {
            writeln!(out, "  held           {:.3} s (feedhold or override 0)", self.held_s)?;
        }
        if self.arrival_s > 0.0 {
            let text = "end of the last motion until the axes were in position";
            writeln!(out, "  arrival        {:.3} s ({text})", self.arrival_s)?;
        }
        for what in &self.not_counted {
            writeln!(out, "  not counted    {what}")?;
        }
        Ok(())
    }

    fn write_contour_error(&self, out: &mut String) -> std::fmt::Result {
        let Some(worst) = &self.max_contour_error else { return Ok(()) };
        if worst.mm > 0.0 {
            let place = self.place(&worst.file, worst.line, worst.block);
            let (mm, time_s) = (worst.mm, worst.time_s);
            writeln!(out, "  contour error  at most {mm:.6} mm at t = {time_s:.6} s, {place}")?;
        } else {
            writeln!(out, "  contour error  none")?;
        }
        // the set points may follow a contour of which they leave out a part; and a component can exceed the
        // shortest vector if it belongs to a slightly longer one
        let deviation = self.axes.iter().filter_map(|axis| axis.max_dev).fold(0.0, f64::max);
        if deviation > worst.mm * (1.0 + HARDLY_LONGER) * (1.0 + HARDLY_LONGER) + LEAST_SHOWN {
            writeln!(
                out,
                "  missed         up to {deviation:.6} mm (deg) of the contour in one axis, see |dev|"
            )?;
        }
        Ok(())
    }

    /// What limited the speed, by its share of the time.
    fn write_limits(&self, out: &mut String) -> std::fmt::Result {
        write!(out, "  speed limited by ")?;
        let mut shares: Vec<(&str, f64)> =
            self.time_by_v_limit_s.iter().map(|(name, s)| (*name, *s)).collect();
        if let Some((_, stop)) =
            shares.iter_mut().find(|(name, _)| *name == SpeedLimit::Stop.name())
        {
            *stop -= self.dwell_s + self.technology_s;
        }
        shares.push((Rest::Dwell.name(), self.dwell_s));
        shares.push((Rest::Technology.name(), self.technology_s));
        shares.retain(|(_, s)| *s > 0.5e-9);
        shares.sort_by(|a, b| b.1.total_cmp(&a.1));
        for (i, (name, seconds)) in shares.iter().enumerate() {
            let comma = if i > 0 { ", " } else { "" };
            write!(out, "{comma}{name} {:.1} %", 100.0 * seconds / self.duration_s)?;
        }
        writeln!(out)
    }

    fn write_messages(&self, out: &mut String) -> std::fmt::Result {
        let count = |severity| self.messages.iter().filter(|m| m.severity == severity).count();
        let (errors, warnings) = (count(Severity::Error), count(Severity::Warning));
        if errors + warnings > 0 || self.messages_omitted > 0 {
            write!(
                out,
                "  messages       {}, {}",
                many(errors, "error"),
                many(warnings, "warning")
            )?;
            if self.messages_omitted > 0 {
                write!(out, " and {} more", self.messages_omitted)?;
            }
            writeln!(out)?;
        }
        Ok(())
    }

    /// `line 4, N40`, and the file if it is not the program.
    fn place(&self, file: &str, line: u32, block: Option<u64>) -> String {
        let block = block.map_or_else(String::new, |n| format!(", N{n}"));
        let of = if file == self.program { String::new() } else { format!(" of {file}") };
        format!("line {line}{block}{of}")
    }

    fn write_axes(&self, out: &mut String) -> std::fmt::Result {
        writeln!(
            out,
            "  {:<6} {:>12} {:>12} {:>14} {:>11} {:>11} {:>11} {:>10}",
            "axis", "|vel| /s", "|acc| /s2", "|jerk| /s3", "|err|", "|dev|", "|lag|", "delay"
        )?;
        for a in &self.axes {
            let delay_ms = a.filter_delay_cycles * f64::from(self.cycle_us) / 1000.0;
            let dev = a.max_dev.map_or_else(|| "-".into(), |dev| format!("{dev:.6}"));
            writeln!(
                out,
                "  {:<6} {:>12.4} {:>12.3} {:>14.1} {:>11.6} {:>11} {:>11.6} {:>7.2} ms",
                format!("{} {}", a.name, a.unit),
                a.max_vel,
                a.max_acc,
                a.max_jerk,
                a.max_err,
                dev,
                a.max_lag,
                delay_ms
            )?;
        }
        for a in &self.axes {
            if let Some(slowest) = &a.slowest_stop {
                let place = self.place(&slowest.file, slowest.line, slowest.block);
                writeln!(
                    out,
                    "  settling {:<5} {}, t2 - t1 at most {:.3} s at t = {:.3} s, {place}",
                    a.name,
                    many(usize::try_from(a.stops).unwrap_or(usize::MAX), "stop"),
                    slowest.settling_s,
                    slowest.time_s
                )?;
            }
        }
        Ok(())
    }
}
