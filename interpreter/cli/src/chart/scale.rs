//! Scales of a view and the round numbers along them: first the range of the data, then its [`ticks`].
//!
//! ```
//! use kontur::chart::scale::ticks;
//!
//! let beside: Vec<String> = ticks((0.0, 0.5), 2.0).into_iter().map(|(_, text)| text).collect();
//! assert_eq!(beside, ["0", "0.5"]);
//! ```

use serde::Serialize;
use std::borrow::Cow;

/// Powers of ten in the steps of a scale.
const POWERS: std::ops::RangeInclusive<i32> = -12..=12;
/// Maximum number of labels of a scale.
const MOST_TICKS: usize = 200;
/// Steps narrower than this share of the wanted one are accepted, so that rounding has no effect.
const ALMOST: f64 = 1.0 - 1e-6;

/// Distance of two round numbers.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Step {
    /// 1, 2 or 5 times a power of ten.
    pub size: f64,
    /// Decimals that its multiples need.
    pub decimals: usize,
}

/// Every step of a scale, in increasing order. A page receives them as data.
pub fn steps() -> Vec<Step> {
    let of = |power: i32| {
        [1.0, 2.0, 5.0].map(|factor| Step {
            // divided for negative powers: 0.2, not 0.2000000000000001
            size: if power < 0 {
                factor / libm::pow(10.0, f64::from(-power))
            } else {
                factor * libm::pow(10.0, f64::from(power))
            },
            decimals: usize::try_from(-power).unwrap_or(0),
        })
    };
    POWERS.flat_map(of).collect()
}

/// Round numbers inside a range for the labels of a scale, about `wanted` of them but at least two.
pub fn ticks((low, high): (f64, f64), wanted: f64) -> Vec<(f64, String)> {
    let span = high - low;
    if !(span > 0.0 && span.is_finite()) {
        return Vec::new();
    }
    let mut wanted = wanted.max(2.0);
    loop {
        let rough = span / wanted * ALMOST;
        let steps = steps();
        let Some(Step { size, decimals }) = steps.into_iter().find(|s| s.size >= rough) else {
            return Vec::new();
        };
        let first = libm::ceil(low / size - 1e-9);
        let values = (0_u32..).map(|i| (first + f64::from(i)) * size).take(MOST_TICKS);
        let found: Vec<(f64, String)> = values
            .take_while(|v| *v <= high + 1e-9 * size)
            .map(|v| (v, text(v, decimals)))
            .collect();
        if found.len() > 1 || wanted > 16.0 {
            return found;
        }
        wanted *= 2.0;
    }
}

/// A number on a scale: with more than five decimals as multiple of a power of ten, for which there is room.
fn text(v: f64, decimals: usize) -> String {
    let text = if decimals <= 5 {
        format!("{v:.decimals$}")
    } else {
        let digits = format!("{:.0}", v * libm::pow(10.0, decimals as f64));
        let short = digits.trim_end_matches('0');
        match decimals.checked_sub(digits.len() - short.len()) {
            Some(exponent @ 1..) if short.ends_with(|c: char| c.is_ascii_digit()) => {
                format!("{short}e-{exponent}")
            }
            _ => format!("{digits}e-{decimals}"),
        }
    };
    if text.starts_with("0e")
        || text.starts_with("-0e")
        || text.trim_start_matches(['-', '0', '.']).is_empty()
    {
        "0".to_owned()
    } else {
        text.replace('-', "\u{2212}")
    }
}

/// One direction of a view.
#[derive(Clone, Debug, Default, Serialize)]
pub(crate) struct Scale {
    /// Name and unit.
    pub(crate) label: Cow<'static, str>,
    pub(crate) range: (f64, f64),
    pub(crate) logarithmic: bool,
    /// Names of the positions 0, 1, 2, ... of a direction that is not a quantity, with nothing in between.
    pub(crate) categories: Vec<String>,
}

impl Scale {
    /// A linear scale.
    pub(crate) fn linear(label: impl Into<Cow<'static, str>>, range: (f64, f64)) -> Self {
        Self { label: label.into(), range, ..Self::default() }
    }

    /// A logarithmic scale; both ends are above 0.
    pub(crate) fn logarithmic(label: impl Into<Cow<'static, str>>, range: (f64, f64)) -> Self {
        Self { logarithmic: true, ..Self::linear(label, range) }
    }

    /// Named positions side by side.
    pub(crate) fn categories(label: impl Into<Cow<'static, str>>, names: Vec<String>) -> Self {
        let range = (-0.5, names.len() as f64 - 0.5);
        Self { categories: names, ..Self::linear(label, range) }
    }

    /// The drawn coordinate of a value.
    pub(crate) fn drawn(&self, value: f64) -> f64 {
        if self.logarithmic { libm::log10(value) } else { value }
    }

    pub(crate) fn drawn_range(&self) -> (f64, f64) {
        (self.drawn(self.range.0), self.drawn(self.range.1))
    }

    /// Positions of grid lines with their numbers or names, about `wanted` of them, in drawn coordinates.
    pub(crate) fn places(&self, drawn: (f64, f64), wanted: f64) -> Vec<(f64, String)> {
        if !self.categories.is_empty() {
            return (0_u32..).map(f64::from).zip(self.categories.iter().cloned()).collect();
        }
        if !self.logarithmic {
            return ticks(drawn, wanted);
        }
        let (low, high) = self.range;
        if high < 10.0 * low {
            let found = ticks((low, high), wanted);
            return found.into_iter().map(|(v, text)| (libm::log10(v), text)).collect();
        }
        decades(low, high)
    }
}

/// 1 to 9 times the powers of ten; numbers at 1, 2 and 5, over many decades at 1 only.
fn decades(low: f64, high: f64) -> Vec<(f64, String)> {
    let wide = high > 1e4 * low;
    let mut found = Vec::new();
    for step in steps() {
        let leading = step.size / libm::pow(10.0, libm::floor(libm::log10(step.size) + 1e-9));
        // the lines between 1, 2 and 5 have no number
        let until = if leading < 1.5 {
            2
        } else if leading < 3.0 {
            5
        } else {
            10
        };
        let from = leading.round() as u32;
        for n in from..until {
            let value = step.size * f64::from(n) / f64::from(from);
            let named = n == from && (n == 1 || !wide);
            if value >= low * (1.0 - 1e-9) && value <= high * (1.0 + 1e-9) {
                let text = if named { format!("{}", step.size) } else { String::new() };
                found.push((libm::log10(value), text));
            }
        }
    }
    found
}

/// A quantity with its unit: the label of a scale.
pub(crate) fn label(name: &str, unit: &str) -> String {
    if unit.is_empty() { name.to_owned() } else { format!("{name} in {unit}") }
}

/// The label of the scale of a column of a trace or a table: its name and the unit that the name ends with.
pub(crate) fn of_column(column: &str) -> String {
    const UNITS: [(&str, &str); 11] = [
        ("_mm_s3", "mm/s\u{b3}"),
        ("_mm_s2", "mm/s\u{b2}"),
        ("_mm_s", "mm/s"),
        ("_mm", "mm"),
        ("_deg_s3", "deg/s\u{b3}"),
        ("_deg_s2", "deg/s\u{b2}"),
        ("_deg_s", "deg/s"),
        ("_deg", "deg"),
        ("_nm", "N m"),
        ("_hz", "Hz"),
        ("_s", "s"),
    ];
    // the column of an amplitude is followed by its band
    let (name, _) = column.split_once('@').unwrap_or((column, ""));
    let found = UNITS.iter().find_map(|(end, unit)| Some((name.strip_suffix(end)?, unit)));
    found.map_or_else(|| name.to_owned(), |(short, unit)| label(&short.replace('_', " "), unit))
}

/// A range around all values with a margin, not smaller than `least`.
pub(crate) fn around(values: impl Iterator<Item = f64>, least: f64) -> (f64, f64) {
    let (low, high) = values
        .filter(|v| v.is_finite())
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)));
    if low > high {
        return (-least, least);
    }
    let air = (0.06 * (high - low)).max(0.5 * (least - (high - low)));
    (low - air, high + air)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_inside() {
        let texts =
            |range, wanted| ticks(range, wanted).into_iter().map(|t| t.1).collect::<Vec<_>>();
        assert_eq!(texts((0.0, 1.0), 5.0), ["0", "0.2", "0.4", "0.6", "0.8", "1.0"]);
        assert_eq!(texts((-0.013, 0.021), 4.0), ["\u{2212}0.01", "0", "0.01", "0.02"]);
        assert_eq!(texts((-5e-7, 5e-7), 2.0), ["\u{2212}5e\u{2212}7", "0", "5e\u{2212}7"]);
        assert_eq!(texts((0.0, 2e-6), 2.0), ["0", "1e\u{2212}6", "2e\u{2212}6"]);
        assert_eq!(text(-1e-9, 7), "0");
        assert_eq!(text(10.0, 6), "10000000e\u{2212}6");
        assert_eq!(text(1e-6, 7), "1e\u{2212}6");
        // a single number does not make a scale
        assert_eq!(texts((0.1, 0.9), 2.0), ["0.2", "0.4", "0.6", "0.8"]);
        assert!(ticks((1.0, 1.0), 4.0).is_empty());
        assert!(ticks((0.0, f64::NAN), 4.0).is_empty());
    }

    #[test]
    fn ranges_have_air_and_a_least_size() {
        assert_eq!(around([1.0, 2.0].into_iter(), 0.1), (0.94, 2.06));
        assert_eq!(around([1.0, f64::NAN, 1.0].into_iter(), 2.0), (0.0, 2.0));
        assert_eq!(around(std::iter::empty(), 1.0), (-1.0, 1.0));
    }

    #[test]
    fn columns_have_names_and_units() {
        for (column, text) in [
            ("duration_s", "duration in s"),
            ("X_tcp_acc_mm_s2@50..56@0.7..1.9", "X tcp acc in mm/s\u{b2}"),
            ("contour_err_mm", "contour err in mm"),
            ("cycles", "cycles"),
        ] {
            assert_eq!(of_column(column), text);
        }
    }

    #[test]
    fn decades_have_nine_lines_and_numbers_at_1_2_and_5() {
        let all = Scale::logarithmic("Hz", (0.1, 100.0)).places((-1.0, 2.0), 9.0);
        assert_eq!(all.len(), 28);
        let named: Vec<&str> =
            all.iter().map(|(_, text)| text.as_str()).filter(|t| !t.is_empty()).collect();
        assert_eq!(named, ["0.1", "0.2", "0.5", "1", "2", "5", "10", "20", "50", "100"]);
        assert!(all.windows(2).all(|w| w[0].0 < w[1].0));
    }
}
