//! The proposed choice and its command.

use super::combined;
use super::task::{Answer, Row, Task, command};
use crate::console::Console;
use crate::error::{Error, Exit};
use crate::table::{Cell, Table, number};

impl Task {
    /// The proposal and its numbers.
    pub(super) fn answer(&self, rows: &[Row], console: &mut Console) -> Result<Answer, Error> {
        console.print(&self.proposal(rows))?;
        let mut choices = Table::new(&[
            "mode",
            "freq_hz",
            "damping",
            "given",
            "residual_ratio",
            "contour_err_mm",
            "delay_s",
            "keeps",
        ]);
        for Row { choice, given } in rows {
            choices.push([
                Cell::from(u32::from(choice.settings.mode)),
                Cell::Given(choice.settings.freq_hz),
                Cell::Given(choice.settings.damping),
                Cell::from(u32::from(*given)),
                Cell::Given(choice.worst_ratio),
                Cell::Given(self.corner_error_mm(choice)),
                Cell::Given(choice.delay_cycles * self.cycle.seconds()),
                Cell::from(u32::from(self.keeps(choice))),
            ]);
        }
        let proposed =
            self.proposed(rows).map(|choice| command(&choice.settings, &self.tolerance()));
        Ok(Answer { choices, command: proposed, exit: Exit::Finished })
    }

    fn proposal(&self, rows: &[Row]) -> String {
        match self.proposed(rows) {
            Some(choice) => format!(
                "\nproposal  {}\n          the smallest contour error among the modes that keep {} %; {}\n{}",
                command(&choice.settings, &self.tolerance()),
                100.0 * self.limit_ratio,
                match self.max_dev_mm {
                    Some(mm) => format!("AX_DEV keeps the axes within {mm} mm of the contour"),
                    None => "add AX_DEV=.. in the same brackets to limit it".to_owned(),
                },
                self.beside(&choice)
            ),
            None if rows.is_empty() => format!(
                "\nproposal  none: at a cycle of {} ms no mode has a kernel for {} to {} Hz\n",
                1e3 * self.cycle.seconds(),
                number(self.band.low_hz, 2),
                number(self.band.high_hz, 2)
            ),
            None => combined::answer(self).unwrap_or_else(|| {
                format!(
                    "\nproposal  none: no mode keeps {} % over {} to {} Hz; use settings per position or a larger --max-residual\n",
                    100.0 * self.limit_ratio,
                    number(self.band.low_hz, 2),
                    number(self.band.high_hz, 2)
                )
            }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::task::median;
    use super::super::vibration::{Estimate, Mode};
    use super::*;
    use kontur_filters::analysis::tuning::VibrationBand;
    use kontur_filters::time::CycleTime;

    fn task(freqs_hz: &[f64]) -> Task {
        Task {
            bands_hz: freqs_hz.iter().map(|f| (*f, *f)).collect(),
            at_hz: median(freqs_hz),
            freqs_hz: freqs_hz.to_vec(),
            others: Vec::new(),
            band: VibrationBand::of(freqs_hz, 0.1).unwrap(),
            limit_ratio: 0.05,
            feed_mm_min: 4000.0,
            max_dev_mm: None,
            cycle: CycleTime::DEFAULT,
        }
    }

    #[test]
    fn medians() {
        for (values, want) in
            [(&[6.9, 6.0, 5.4][..], 6.0), (&[4.0, 1.0, 2.0, 3.0], 2.5), (&[7.0], 7.0)]
        {
            assert!((median(values) - want).abs() < 1e-12, "{values:?}");
        }
    }

    /// Conformance: V018, V019, V020, V021.
    #[test]
    fn the_vendors_example_gives_mode_2() {
        let task = task(&[6.9, 6.0, 5.4]);
        let rows = task.rows();
        assert_eq!(rows.len(), 8);
        assert_eq!(task.proposed(&rows).unwrap().settings.mode, 2);
        let text = task.text(&rows);
        // residuals of FREQ = 6 at 6.9, 6.0 and 5.4 Hz, and the deviation in both conventions
        for row in ["+15.0", "-10.0", "-13.0", "+11.1"] {
            assert!(text.contains(row), "{row}: {text}");
        }
        let residual = |mode: &str| {
            let lines = text.lines().skip_while(|l| !l.contains("f_real 6.9 Hz"));
            let row = lines.filter(|l| l.starts_with(mode)).find(|l| l.contains(" 6 ")).unwrap();
            let numbers = row.split_whitespace().filter_map(|w| w.parse::<f64>().ok());
            let numbers: Vec<f64> = numbers.skip(2).collect();
            [numbers[0], numbers[2]]
        };
        for (mode, want) in
            [("1", [19.3, 13.5]), ("2", [3.7, 1.8]), ("3", [0.7, 0.2]), ("4", [6.6, 4.0])]
        {
            let is = residual(mode);
            assert!(
                (is[0] - want[0]).abs() < 0.06 && (is[1] - want[1]).abs() < 0.06,
                "{mode} {is:?}"
            );
        }
        assert!(task.proposal(&rows).contains("#VIB GUARD ON [MODE=2 FREQ="));
        let bounded = Task { max_dev_mm: Some(0.01), ..task };
        assert!(bounded.proposal(&rows).contains(" DAMPING=0.1 AX_DEV=0.01]\n"));
    }

    /// 4 and 16 Hz: no mode keeps both within 5 %. Guard and band-stop together do; here they are judged by their
    /// steady-state responses, since the product of both magnitudes bounds the residual.
    #[test]
    fn two_far_vibrations_get_a_combined_answer() {
        let task = task(&[4.0, 16.0]);
        let rows = task.rows();
        assert_eq!(task.proposed(&rows), None);
        let text = task.proposal(&rows);
        assert!(
            text.contains("#VIB GUARD ON [MODE=") && text.contains("filter[0].enable 1"),
            "{text}"
        );
        let left: Vec<f64> = text
            .split(" leave ")
            .nth(1)
            .unwrap()
            .split_whitespace()
            .filter_map(|w| w.parse().ok())
            .take(2)
            .collect();
        assert!(left.iter().all(|l| *l <= 5.0), "{text}");
        assert!(!text.contains("none"));
    }

    /// The interval of a measured frequency widens the band that the proposal has to cover.
    #[test]
    fn the_accuracy_of_the_measurement_is_a_margin() {
        let exact = task(&[6.0]);
        let mut blurred = task(&[6.0]);
        blurred.band = VibrationBand::of(&[5.1, 6.9], 0.1).unwrap();
        let [a, b] = [&exact, &blurred].map(|t| t.proposed(&t.rows()).unwrap());
        assert!(b.corner_error_s > a.corner_error_s);
        assert!(
            blurred.keeps(&b)
                && blurred
                    .band
                    .judge(a.settings, blurred.cycle)
                    .is_some_and(|c| !blurred.keeps(&c))
        );
    }

    /// Half of a vibration of the other frequency is far more than 5 % of the strongest one, but not if it is a tenth
    /// as strong.
    #[test]
    fn a_second_vibration_that_remains_is_reported() {
        let other = |peak_ratio| {
            let e = |value| Estimate { value, half_width: 0.0 };
            Mode { freq: e(31.0), damping: e(0.1), peak_ratio }
        };
        let with = |peak_ratio| Task { others: vec![other(peak_ratio)], ..task(&[20.0]) };
        let said = with(0.5).proposal(&with(0.5).rows());
        assert!(said.contains("warning   31.00 Hz, 50 % as strong"), "{said}");
        assert!(said.contains("--freq 20.00,31.00 tunes"), "{said}");
        assert!(!with(0.05).proposal(&with(0.05).rows()).contains("warning"));
        assert!(with(0.5).text(&with(0.5).rows()).contains("other 31 Hz"));
    }

    #[test]
    fn corner_errors_are_those_of_the_document() {
        // 40 Hz at F4000, from the closed forms: 0.204, 0.236, 0.299, 0.204 mm; the grid changes them by 2 %
        let task = task(&[40.0]);
        for (row, want) in task.rows().iter().zip([0.20425, 0.23623, 0.29886, 0.20425]) {
            let is = task.corner_error_mm(&row.choice);
            assert!((is / want - 1.0).abs() < 0.02, "{is} {want}");
        }
    }
}
