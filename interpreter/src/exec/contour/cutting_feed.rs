//! The feed rate of G95 under G96, which follows the speed of the spindle along a motion.
//!
//! Source: TF5200 turning functions, constant cutting speed at feed rate per revolution (400190603).

use super::feed_course::{PIECES_MAX, STEP};
use crate::exec::step::CuttingSpeed;
use kontur_motion::path::Path;

/// Halvings of an interval of the path: down to rounding.
const HALVINGS: u32 = 60;

/// A feed rate per revolution of a spindle whose speed depends on the position of the face turning axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::exec) struct CuttingFeed {
    /// The speed, with the turning centre on the path.
    pub(in crate::exec) cutting: CuttingSpeed,
    /// mm per revolution, above 0.
    pub(in crate::exec) way_mm: f64,
}

impl CuttingFeed {
    /// Lowest and highest speed of the spindle in rev/min along a line or an arc; `None` for other paths.
    fn speeds(&self, path: &Path) -> Option<(f64, f64)> {
        let (low, high) = path.extent(self.cutting.axis)?;
        let [low, high] = [low, high].map(|x| x - self.cutting.centre_mm);
        let farthest = low.abs().max(high.abs());
        let nearest = if low <= 0.0 && high >= 0.0 { 0.0 } else { low.abs().min(high.abs()) };
        Some((self.cutting.rpm(farthest), self.cutting.rpm(nearest)))
    }

    /// Feed rate in mm/s of a piece of a path on which the speed changes by one step at most: that of the mean speed.
    fn of_piece(&self, path: &Path) -> Option<f64> {
        let (lowest, highest) = self.speeds(path)?;
        let mean = (lowest * highest).sqrt();
        (highest <= lowest * STEP).then_some(self.way_mm * mean / 60.0)
    }

    /// Ends in mm along the path and feed rates in mm/s of the largest pieces on which the speed changes by one step at most;
    /// `None` if the path is neither a line nor an arc, or its speeds need too many pieces.
    pub(in crate::exec) fn pieces(&self, path: &Path) -> Option<Vec<(f64, f64)>> {
        let length = path.length();
        let mut pieces = Vec::new();
        let mut from = 0.0;
        for _ in 0..PIECES_MAX {
            let feed = |to: f64| self.of_piece(&path.section(from, to)?);
            if let Some(feed) = feed(length) {
                pieces.push((length, feed));
                return Some(pieces);
            }
            let (mut low, mut high) = (from, length);
            for _ in 0..HALVINGS {
                let middle = 0.5 * (low + high);
                if feed(middle).is_some() { low = middle } else { high = middle }
            }
            pieces.push((low, feed(low).filter(|_| low > from)?));
            from = low;
        }
        None
    }
}
