//! Colours and dashes. Every series has both: readers who cannot distinguish two colours can distinguish two dashes.

use serde::Serialize;
use serde::ser::Serializer;
use std::fmt::Write as _;

/// A colour for one purpose.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct Tone {
    /// Name of its variable in a page.
    pub(crate) name: &'static str,
    /// On white.
    pub(crate) light: &'static str,
    /// On a dark background.
    pub(crate) dark: &'static str,
}

const fn tone(name: &'static str, light: &'static str, dark: &'static str) -> Tone {
    Tone { name, light, dark }
}

/// Text.
pub(crate) static INK: Tone = tone("ink", "#212529", "#e9ecef");
/// Secondary text, and levels.
pub(crate) static FAINT: Tone = tone("faint", "#5c636a", "#a7adb3");
/// Grid lines.
pub(crate) static GRID: Tone = tone("grid", "#e9ecef", "#2b2f33");
/// Frames.
pub(crate) static FRAME: Tone = tone("frame", "#ced4da", "#495057");
/// Every second line of the program, over time.
pub(crate) static SHADE: Tone = tone("shade", "#f6f8f9", "#24282c");
/// The programmed contour, below everything else.
pub(crate) static PROGRAMMED: Tone = tone("programmed", "#c3cad1", "#4d555c");
/// Background of pictures and cards.
pub(crate) static CARD: Tone = tone("card", "#ffffff", "#1e2124");
/// Background of a page, below the cards.
static GROUND: Tone = tone("ground", "#f1f3f5", "#141618");
/// Frames of cards.
static LINE: Tone = tone("line", "#dee2e6", "#373c41");
/// The chosen line of the program.
static MARK: Tone = tone("mark", "#f783ac80", "#f783ac70");
/// Shares in a table.
static BAR: Tone = tone("bar", "#a5c8f3", "#27507f");
static ERROR: Tone = tone("error", "#c92a2a", "#ff8787");
static WARNING: Tone = tone("warning", "#856900", "#ffd43b");

/// Series: readable as text, and distinguishable for colour-blind eyes and in print by their [dashes](Style).
pub(crate) static SERIES: [Tone; 8] = [
    tone("c0", "#1c6dd0", "#74b0ff"),
    tone("c1", "#c2410c", "#ff9a5c"),
    tone("c2", "#257a34", "#69db7c"),
    tone("c3", "#9c36b5", "#da8fe8"),
    tone("c4", "#0b7285", "#4dd0e1"),
    tone("c5", "#856900", "#ffd43b"),
    tone("c6", "#c2255c", "#faa2c1"),
    tone("c7", "#495057", "#ced4da"),
];

/// Dashes in pixels: drawn, left out, drawn, ...
pub(crate) const DASHES: [&[u8]; 8] =
    [&[], &[7, 3], &[2, 2], &[8, 2, 2, 2], &[12, 3], &[4, 4], &[1, 3], &[10, 2, 4, 2]];

fn others() -> [&'static Tone; 13] {
    [
        &INK,
        &FAINT,
        &GRID,
        &FRAME,
        &SHADE,
        &PROGRAMMED,
        &CARD,
        &GROUND,
        &LINE,
        &MARK,
        &BAR,
        &ERROR,
        &WARNING,
    ]
}

/// The variables of a page, light and dark.
pub(crate) fn variables() -> String {
    let of = |value: fn(&Tone) -> &'static str| {
        others().into_iter().chain(&SERIES).fold(String::new(), |mut all, tone| {
            // writing to a String cannot fail
            let _ = write!(all, " --{}: {};", tone.name, value(tone));
            all
        })
    };
    format!(
        ":root {{{} }}\n@media (prefers-color-scheme: dark) {{\n:root:not([data-theme=\"light\"]) {{{} }}\n}}\n",
        of(|t| t.light),
        of(|t| t.dark)
    )
}

/// How a line is drawn.
#[derive(Clone, Copy, Debug, Serialize)]
pub(crate) struct Style {
    /// In a page the variable of its colour.
    #[serde(rename = "colour", serialize_with = "variable")]
    pub(crate) tone: &'static Tone,
    pub(crate) dash: &'static [u8],
    /// Pixels.
    pub(crate) width: f64,
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde hands over a reference")]
fn variable<S: Serializer>(tone: &&'static Tone, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(&format!("var(--{})", tone.name))
}

impl Style {
    /// Colour and dash of one of several series.
    pub(crate) fn series(i: usize) -> Self {
        // after the eighth, the same colours are combined with other dashes
        let dash = DASHES[(i + i / SERIES.len()) % DASHES.len()];
        Self { tone: &SERIES[i % SERIES.len()], dash, width: 1.8 }
    }

    /// The contour, or another thing to compare with.
    pub(crate) fn programmed() -> Self {
        Self { tone: &PROGRAMMED, dash: &[], width: 5.0 }
    }

    /// Solid, thin and in a colour.
    pub(crate) fn thin(tone: &'static Tone) -> Self {
        Self { tone, dash: &[], width: 1.0 }
    }

    /// The same with another width in pixels.
    pub(crate) const fn wide(self, width: f64) -> Self {
        Self { width, ..self }
    }

    /// The same with other dashes.
    pub(crate) const fn dashed(self, dash: &'static [u8]) -> Self {
        Self { dash, ..self }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn channels(colour: &str) -> [f64; 3] {
        [1, 3, 5].map(|i| f64::from(u8::from_str_radix(&colour[i..i + 2], 16).unwrap()) / 255.0)
    }

    /// Contrast of WCAG 2.2, "contrast ratio" and "relative luminance".
    fn contrast(a: &str, b: &str) -> f64 {
        let luminance = |colour: &str| {
            let linear = channels(colour).map(|v| {
                if v <= 0.040_45 { v / 12.92 } else { libm::pow((v + 0.055) / 1.055, 2.4) }
            });
            0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]
        };
        let (a, b) = (luminance(a), luminance(b));
        (a.max(b) + 0.05) / (a.min(b) + 0.05)
    }

    #[test]
    fn text_and_series_have_a_contrast_of_4_5() {
        assert!((contrast("#000000", "#ffffff") - 21.0).abs() < 1e-9);
        for tone in [&INK, &FAINT, &ERROR, &WARNING].into_iter().chain(&SERIES) {
            for ground in [&CARD, &SHADE] {
                let found = [contrast(tone.light, ground.light), contrast(tone.dark, ground.dark)];
                assert!(
                    found.iter().all(|c| *c >= 4.5),
                    "{} on {}: {found:?}",
                    tone.name,
                    ground.name
                );
            }
        }
        // headline and facts are drawn on the background
        for tone in [&INK, &FAINT] {
            assert!(
                contrast(tone.light, GROUND.light) >= 4.5
                    && contrast(tone.dark, GROUND.dark) >= 4.5
            );
        }
        // a chosen button is text in the colour of cards
        assert!(contrast(CARD.light, INK.light) >= 4.5 && contrast(CARD.dark, INK.dark) >= 4.5);
    }

    /// Series of the same colour, or of colours that a dichromat confuses, have different dashes; in fact all pairs do.
    #[test]
    fn series_differ_in_their_dashes_too() {
        let all: Vec<Style> = (0..SERIES.len()).map(Style::series).collect();
        for (i, a) in all.iter().enumerate() {
            assert!(all[..i].iter().all(|b| a.dash != b.dash && a.tone != b.tone), "{i}");
        }
        let many: Vec<(&str, &[u8])> =
            (0..56).map(Style::series).map(|s| (s.tone.name, s.dash)).collect();
        assert!(many.iter().enumerate().all(|(i, a)| !many[..i].contains(a)));
    }
}
