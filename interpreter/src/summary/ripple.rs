//! Ripple of the path speed: how far the speed dips where the path continues without a corner.
//!
//! A corner and a lower F word slow the path down by design. What matters on a surface are the dips in between: at the
//! small kinks of a polygon, at block boundaries, where a tolerance or the look-ahead reduces the speed.

use crate::job::{Facts, FileNames};
use crate::record::{CycleRecord, SpeedLimit};
use serde::Serialize;

/// Speeds closer together than this share of the larger one count as equal: the rounding of the profiles is below it.
const SAME: f64 = 1e-9;

/// A path that turns by more than this angle in degrees during a dip has a corner there.
///
/// Assumption: between the kinks of usual polygons (below 15 degrees) and the corners of a drawing (45 degrees and
/// more).
pub(super) const CORNER_DEG: f64 = 30.0;

/// More than the rotation of any axis in a cycle.
const HALF_TURN_DEG: f64 = 180.0;

/// Steps in mm (deg) that are too short to have a direction.
const NO_STEP_MM: f64 = 1e-9;

/// The deepest dip of the path speed without a corner.
///
/// A dip is between two local maxima of the speed: those next to it, and those around it and the smaller dips beside
/// it. Excluded are rests, dips during which the path turns by more than 30 degrees, and dips down to the programmed
/// feed rate.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SpeedRipple {
    /// `(v_max - v_min) / v_max`, 0 to 1.
    pub ratio: f64,
    /// Lower one of the local maxima of the path velocity next to the dip in mm/s.
    pub v_max_mm_s: f64,
    /// Lowest path velocity in the dip in mm/s.
    pub v_min_mm_s: f64,
    /// Program time of the dip in seconds.
    pub time_s: f64,
    /// File at the dip.
    pub file: String,
    /// Line of that file.
    pub line: u32,
}

/// A local extreme of the speed, possibly a plateau.
#[derive(Clone, Copy, Debug, Default)]
struct Extreme {
    v: f64,
    k: u64,
    file: u32,
    line: u32,
    /// Whether the programmed feed rate is reached.
    fed: bool,
    /// Angle in radians by which the path had turned at the first and at the last cycle of the extreme.
    turned: [f64; 2],
}

/// Collects the ripple, cycle by cycle.
#[derive(Clone, Debug)]
pub(super) struct Collector {
    /// Axes of the path, and whether they are rotary.
    axes: Vec<(usize, bool)>,
    /// Position of these axes in the last cycle, empty before the first one.
    position: Vec<f64>,
    /// The last step, and the direction of the last one that has a direction; empty before it.
    step: Vec<f64>,
    direction: Vec<f64>,
    turned: f64,
    /// Extremes since the last rest that are not part of a complete dip yet, minima and maxima alternating.
    open: Vec<Extreme>,
    /// The last two extremes.
    last: [Extreme; 2],
    /// The extreme that the speed is at or approaches, and whether it rises.
    at: Extreme,
    rising: bool,
    worst: Option<SpeedRipple>,
    files: FileNames,
}

impl Collector {
    pub(super) fn new(facts: &Facts) -> Self {
        let path = facts.axes.iter().enumerate().filter(|(_, axis)| !axis.spindle);
        Self {
            axes: path.map(|(i, axis)| (i, axis.rotary)).collect(),
            position: Vec::new(),
            step: Vec::new(),
            direction: Vec::new(),
            turned: 0.0,
            open: vec![Extreme::default()],
            last: [Extreme::default(); 2],
            at: Extreme::default(),
            rising: true,
            worst: None,
            files: facts.files.clone(),
        }
    }

    /// Adds a cycle; `ipo`: interpolated setpoints of the axes.
    pub(super) fn add(
        &mut self,
        record: &CycleRecord,
        ipo: impl Fn(usize) -> Option<f64>,
        cycle_us: u32,
    ) {
        self.turn(ipo);
        let v = record.path.v_mm_s;
        if v <= 0.0 {
            self.rest(cycle_us);
            return;
        }
        let now = Extreme {
            v,
            k: record.k,
            file: record.file,
            line: record.line,
            fed: matches!(record.path.limit, SpeedLimit::Feed | SpeedLimit::Stop),
            turned: [self.turned; 2],
        };
        let slack = SAME * v.max(self.at.v);
        let onwards = if self.rising { v - self.at.v } else { self.at.v - v };
        if onwards > slack {
            self.at = now;
        } else if onwards >= -slack {
            self.at.turned[1] = self.turned;
            self.at.fed |= now.fed;
        } else {
            self.pass(cycle_us);
            self.at = now;
            self.rising = !self.rising;
        }
    }

    /// Accumulates the angle by which the path turns: of the linear axes, or of the rotary ones if no others move.
    fn turn(&mut self, ipo: impl Fn(usize) -> Option<f64>) {
        let here = self.axes.iter().filter_map(|(i, _)| ipo(*i));
        if self.position.is_empty() {
            self.position.extend(here);
            return;
        }
        self.step.clear();
        let mut squares = [0.0; 2];
        for ((here, before), (_, rotary)) in here.zip(&mut self.position).zip(&self.axes) {
            let mut step = here - std::mem::replace(before, here);
            if *rotary && step.abs() > HALF_TURN_DEG {
                // a modulo axis wraps around
                step -= 2.0 * HALF_TURN_DEG.copysign(step);
            }
            squares[usize::from(*rotary)] += step * step;
            self.step.push(step);
        }
        let of_rotary = squares[0] < NO_STEP_MM * NO_STEP_MM;
        let length = squares[usize::from(of_rotary)].sqrt();
        if length < NO_STEP_MM {
            return;
        }
        for (step, (_, rotary)) in self.step.iter_mut().zip(&self.axes) {
            if *rotary != of_rotary {
                *step = 0.0;
            }
        }
        if self.direction.is_empty() {
            self.direction.extend(self.step.iter().map(|x| x / length));
            return;
        }
        let mut chord = 0.0;
        for (step, last) in self.step.iter().zip(&mut self.direction) {
            let along = step / length;
            chord += (along - *last) * (along - *last);
            *last = along;
        }
        self.turned += 2.0 * libm::asin((0.5 * f64::sqrt(chord)).min(1.0));
    }

    /// Adds the extreme that the speed leaves. A dip is measured from the maxima next to it, and again from the ones
    /// around it each time smaller dips beside it are removed: those maxima may be higher, but a corner further away.
    fn pass(&mut self, cycle_us: u32) {
        let [a, b] = self.last;
        self.last = [b, self.at];
        if self.rising {
            let maximum = self.at;
            self.judge(&b, [&a, &maximum], cycle_us);
        }
        self.open.push(self.at);
        self.close(cycle_us);
    }

    /// Removes every dip between two extremes that are at least as far apart as the dip is deep; a larger dip around it
    /// stays.
    fn close(&mut self, cycle_us: u32) {
        while let [.., a, b, c, d] = self.open[..] {
            let inner = (b.v - c.v).abs();
            if inner > (a.v - b.v).abs() || inner > (c.v - d.v).abs() {
                return;
            }
            self.open.truncate(self.open.len() - 3);
            self.open.push(d);
            let (dip, sides) = if b.v > c.v { (c, [b, d]) } else { (b, [a, c]) };
            self.judge(&dip, [&sides[0], &sides[1]], cycle_us);
        }
    }

    /// Keeps a dip between two maxima if it is the deepest one.
    fn judge(&mut self, dip: &Extreme, sides: [&Extreme; 2], cycle_us: u32) {
        let turn = sides[1].turned[0] - sides[0].turned[1];
        let v_max_mm_s = sides[0].v.min(sides[1].v);
        let ratio = (v_max_mm_s - dip.v) / v_max_mm_s;
        let deeper = self.worst.as_ref().is_none_or(|worst| ratio > worst.ratio);
        if dip.v > 0.0 && !dip.fed && turn.to_degrees() <= CORNER_DEG && ratio > 0.0 && deeper {
            self.worst = Some(SpeedRipple {
                ratio,
                v_max_mm_s,
                v_min_mm_s: dip.v,
                time_s: dip.k as f64 * f64::from(cycle_us) / 1e6,
                file: self.files.name(dip.file),
                line: dip.line,
            });
        }
    }

    fn rest(&mut self, cycle_us: u32) {
        self.pass(cycle_us);
        if self.rising {
            self.open.push(Extreme::default());
            self.close(cycle_us);
        }
        self.open.truncate(1);
        self.last = [Extreme::default(); 2];
        self.at = Extreme::default();
        self.rising = true;
    }

    /// The ripple; `None` if the speed never dipped.
    pub(super) fn finish(mut self, cycle_us: u32) -> Option<SpeedRipple> {
        self.rest(cycle_us);
        self.worst
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::job::AxisFacts;
    use crate::record::{AxisRecord, PathRecord};

    fn turning(speeds: &[f64], kinks: &[(usize, f64)], fed: &[usize]) -> Option<SpeedRipple> {
        of_axes([false; 2], speeds, kinks, fed)
    }

    /// Ripple of two axes that move at these speeds, next to one at rest; the path turns by an angle in degrees in the
    /// given cycles.
    fn of_axes(
        rotary: [bool; 2],
        speeds: &[f64],
        kinks: &[(usize, f64)],
        fed: &[usize],
    ) -> Option<SpeedRipple> {
        let axis = |rotary| AxisFacts { rotary, ..AxisFacts::default() };
        let axes = [rotary[0], rotary[1], false].map(axis).to_vec();
        let facts = Facts { axes, ..Facts::default() };
        let mut collector = Collector::new(&facts);
        let (mut at, mut heading) = ([0.0, 0.0], 0.0_f64);
        for (k, v) in speeds.iter().enumerate() {
            heading += kinks.iter().filter(|kink| kink.0 == k).map(|kink| kink.1).sum::<f64>();
            let (sin, cos) = libm::sincos(heading.to_radians());
            at = [at[0] + v * 1e-3 * cos, at[1] + v * 1e-3 * sin];
            let limit = if fed.contains(&k) { SpeedLimit::Feed } else { SpeedLimit::Corner };
            let path = PathRecord { v_mm_s: *v, limit, ..PathRecord::default() };
            let turn = |i: usize| if rotary[i] { at[i].rem_euclid(360.0) } else { at[i] };
            let axes = [turn(0), turn(1), 7.0]
                .map(|ipo| AxisRecord { ipo, ..AxisRecord::default() })
                .to_vec();
            let (k, line) = (k as u64, k as u32);
            let record = CycleRecord { k, line, path, axes, ..CycleRecord::default() };
            collector.add(&record, |axis| record.axes.get(axis).map(|axis| axis.ipo), 1000);
        }
        collector.finish(1000)
    }

    fn ratio(speeds: &[f64], kinks: &[(usize, f64)], fed: &[usize]) -> Option<f64> {
        turning(speeds, kinks, fed).map(|r| r.ratio)
    }

    #[test]
    fn start_and_stop_are_no_ripple() {
        assert_eq!(ratio(&[0.0, 0.0], &[], &[]), None);
        assert_eq!(ratio(&[0.0, 5.0, 10.0, 10.0, 5.0, 0.0, 0.0, 4.0, 2.0], &[], &[]), None);
    }

    #[test]
    fn the_deepest_dip_between_two_maxima() {
        let speeds = [0.0, 5.0, 10.0, 9.0, 10.0, 4.0, 0.0, 8.0, 6.0, 3.0, 6.0, 5.0, 7.0, 0.0];
        let want = SpeedRipple {
            ratio: 4.0 / 7.0,
            v_max_mm_s: 7.0,
            v_min_mm_s: 3.0,
            time_s: 0.009,
            file: String::new(),
            line: 9,
        };
        assert_eq!(turning(&speeds, &[], &[]), Some(want));
        // still moving at the end
        assert_eq!(ratio(&[0.0, 8.0, 6.0, 8.0], &[], &[]), Some(0.25));
    }

    #[test]
    fn a_small_dip_does_not_hide_the_one_around_it() {
        assert_eq!(ratio(&[0.0, 10.0, 5.0, 5.5, 4.0, 10.0, 0.0], &[], &[]), Some(0.6));
        assert_eq!(ratio(&[0.0, 10.0, 4.0, 5.5, 5.0, 10.0, 0.0], &[], &[]), Some(0.6));
    }

    #[test]
    fn corners_are_no_ripple_and_kinks_are() {
        // a square with lower speed at its corners and a small dip at a joint of a side
        let speeds = [0.0, 10.0, 10.0, 1.0, 10.0, 9.0, 10.0, 1.0, 10.0, 10.0, 0.0];
        assert_eq!(ratio(&speeds, &[(3, 90.0), (7, 90.0)], &[]), Some(0.1));
        // a polygon: three kinks of 20 degrees, whose sum is more than a corner
        let speeds = [0.0, 10.0, 8.0, 10.0, 10.0, 8.0, 10.0, 10.0, 8.0, 10.0, 0.0];
        assert_eq!(ratio(&speeds, &[(2, 20.0), (5, 20.0), (8, 20.0)], &[]), Some(0.2));
        // a curve at constant speed before the dip does not make it a corner
        let speeds = [0.0, 10.0, 10.0, 10.0, 10.0, 8.0, 10.0, 0.0];
        assert_eq!(ratio(&speeds, &[(2, 25.0), (3, 25.0), (5, 5.0)], &[]), Some(0.2));
        // around a corner in small steps
        let speeds = [0.0, 10.0, 8.0, 6.0, 6.0, 8.0, 10.0, 0.0];
        assert_eq!(ratio(&speeds, &[(2, 25.0), (3, 25.0), (5, 25.0)], &[]), None);
    }

    /// Beside smaller dips, the larger one is between maxima with a corner between them; its own neighbours are not.
    #[test]
    fn the_maxima_next_to_a_dip_count_as_well() {
        let speeds = [0.0, 20.0, 11.0, 15.0, 4.0, 16.0, 12.0, 20.0, 0.0];
        let kinks = [(2, 14.0), (4, 14.0), (6, 14.0)];
        assert_eq!(ratio(&speeds, &kinks, &[]), Some(11.0 / 15.0));
    }

    /// Turning back is a corner, starting a new turn is not.
    #[test]
    fn rotary_axes_turn_too() {
        let ratio = |speeds: &[f64], kinks: &[(usize, f64)]| {
            of_axes([true; 2], speeds, kinks, &[]).map(|r| r.ratio)
        };
        let speeds = [0.0, 10.0, 1.0, 10.0, 10.0, 9.0, 10.0, 0.0];
        assert_eq!(ratio(&speeds, &[(2, 180.0)]), Some(0.1));
        let fast = speeds.map(|v| 1e4 * v);
        assert_eq!(ratio(&fast, &[]), Some(0.9));
    }

    #[test]
    fn a_lower_feed_is_no_ripple() {
        let speeds = [0.0, 10.0, 5.0, 5.0, 5.0, 10.0, 0.0];
        assert_eq!(ratio(&speeds, &[], &[3]), None);
        assert_eq!(ratio(&speeds, &[], &[1]), Some(0.5));
    }
}
