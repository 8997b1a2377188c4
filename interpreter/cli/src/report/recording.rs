//! The data of a run for a picture, in bounded memory: one bucket per stretch of cycles, with the smallest and largest
//! value of every curve, and the contour as a [`Track`]. Short runs have one bucket per cycle.

use super::stops::Stops;
use super::track::{Point, Track};
use kontur_interpreter::job::Facts;
use kontur_interpreter::record::{Asked, CycleRecord, Motion, Quantity, Rows, SpeedLimit};

/// A finished recording of a longer run has at least half this number of buckets.
const MOST_BUCKETS: usize = 4000;

/// Largest number of cycles for which every acceleration of an axis is kept: two minutes at 1 ms.
const MOST_SAMPLES: usize = 1 << 17;
/// The same for all axes together: 17 MB, and twice as much as text of a page.
const MOST_ACCELERATIONS: usize = 1 << 21;

/// More passes than this over one contour are drawn as one.
pub(crate) const MOST_PASSES: usize = 8;

/// Distance in mm within which the set point at the start of a pass counts as reached again.
const CLOSED_MM: f64 = 1e-6;

/// Consecutive cycles.
#[derive(Clone, Debug)]
pub(crate) struct Bucket {
    /// The first cycle.
    pub(crate) k: u64,
    pub(crate) last: u64,
    pub(crate) file: u32,
    pub(crate) line: u32,
    pub(crate) block: Option<u64>,
    pub(crate) pass: usize,
    pub(crate) limit: SpeedLimit,
    /// Smallest and largest value of each curve.
    pub(crate) range: Vec<(f64, f64)>,
}

/// One curve over time.
#[derive(Clone, Debug)]
pub(crate) struct Curve {
    pub(crate) name: String,
    pub(crate) unit: String,
    pub(crate) kind: Kind,
    /// Index into [`Facts::axes`]; `None` for the path.
    pub(crate) axis: Option<usize>,
}

/// Content of a curve; curves of one kind share a plot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    Speed,
    ContourError,
    Deviation,
    Lag,
    Velocity,
    Acceleration,
    /// Set, actual and load position: three curves per axis.
    Set,
    Actual,
    Load,
}

impl Kind {
    /// What it shows of an axis; none for a curve of the path.
    const fn quantity(self) -> Option<Quantity> {
        match self {
            Self::Deviation => Some(Quantity::Dev),
            Self::Lag => Some(Quantity::Lag),
            Self::Velocity => Some(Quantity::Vel),
            Self::Acceleration => Some(Quantity::Acc),
            Self::Set => Some(Quantity::Set),
            Self::Actual => Some(Quantity::Act),
            Self::Load => Some(Quantity::Load),
            Self::Speed | Self::ContourError => None,
        }
    }
}

/// One pass around the contour.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Pass {
    pub(crate) first_line: u32,
    pub(crate) last_line: u32,
    /// Largest contour error in mm.
    pub(crate) error_mm: f64,
}

/// A run, ready to be drawn.
#[derive(Clone, Debug)]
pub(crate) struct Recording {
    pub(crate) facts: Facts,
    pub(crate) curves: Vec<Curve>,
    pub(crate) stops: Stops,
    pub(crate) buckets: Vec<Bucket>,
    /// Axes that span the contour, as indices into [`Facts::axes`].
    pub(crate) plane: Vec<usize>,
    pub(crate) passes: Vec<Pass>,
    /// Cycles per bucket.
    pub(crate) width: u64,
    start: Option<[f64; 3]>,
    moved: bool,
    track: Track,
    /// The point with the largest contour error.
    pub(crate) worst: Option<Point>,
    /// Number of cycles for which [`Self::accelerations`] are kept.
    pub(crate) most_samples: usize,
    /// Commanded acceleration of each axis of [`Facts::axes`], cycle by cycle from the first one on; empty for spindles.
    pub(crate) accelerations: Vec<Vec<f64>>,
}

impl Recording {
    /// An empty recording.
    pub(crate) fn new(facts: &Facts) -> Self {
        let path_axes: Vec<usize> =
            (0..facts.axes.len()).filter(|&i| !facts.axes[i].spindle).collect();
        let curve = |name: &str, unit: &str, kind, axis| Curve {
            name: name.to_owned(),
            unit: unit.to_owned(),
            kind,
            axis,
        };
        let mut curves = vec![
            curve("path speed", "mm/s", Kind::Speed, None),
            curve("contour error", "mm", Kind::ContourError, None),
        ];
        for (kind, end) in [
            (Kind::Deviation, ""),
            (Kind::Lag, ""),
            (Kind::Velocity, "/s"),
            (Kind::Acceleration, "/s²"),
        ] {
            for &i in &path_axes {
                let a = &facts.axes[i];
                curves.push(curve(&a.name, &format!("{}{end}", a.unit()), kind, Some(i)));
            }
        }
        for &i in &path_axes {
            let a = &facts.axes[i];
            for (kind, what) in [(Kind::Set, "set"), (Kind::Actual, "actual"), (Kind::Load, "load")]
            {
                curves.push(curve(&format!("{} {what}", a.name), a.unit(), kind, Some(i)));
            }
        }
        Self {
            facts: facts.clone(),
            stops: Stops::new(facts),
            curves,
            buckets: Vec::new(),
            plane: path_axes.into_iter().filter(|&i| !facts.axes[i].rotary).take(3).collect(),
            passes: Vec::new(),
            width: 1,
            start: None,
            moved: false,
            track: Track::default(),
            worst: None,
            most_samples: MOST_SAMPLES.min(MOST_ACCELERATIONS / facts.axes.len().max(1)),
            accelerations: vec![Vec::new(); facts.axes.len()],
        }
    }

    /// Completes the recording and drops curves without information: the load of a stiff axis, which is where its motor is, and the
    /// deviation of an axis that follows another one, which is not measured.
    pub(crate) fn finish(&mut self) {
        for i in (0..self.curves.len()).rev() {
            if self.is_empty(i) || self.repeats_the_motor(i) {
                self.curves.remove(i);
                for bucket in &mut self.buckets {
                    bucket.range.remove(i);
                }
            }
        }
    }

    /// Whether a curve has no values.
    fn is_empty(&self, curve: usize) -> bool {
        !self.buckets.is_empty() && self.buckets.iter().all(|b| b.range[curve].0.is_nan())
    }

    fn repeats_the_motor(&self, curve: usize) -> bool {
        let Curve { kind, axis, .. } = self.curves[curve];
        let actual = |c: &Curve| c.kind == Kind::Actual && c.axis == axis;
        kind == Kind::Load
            && self.curves.iter().position(actual).is_some_and(|beside| {
                self.buckets.iter().all(|b| b.range[curve] == b.range[beside])
            })
    }

    /// Number of cycles that were added.
    pub(crate) fn cycles(&self) -> u64 {
        let ends = self.buckets.first().zip(self.buckets.last());
        ends.map_or(0, |(first, last)| last.last - first.k + 1)
    }

    /// Seconds of a cycle count.
    pub(crate) fn seconds(&self, k: u64) -> f64 {
        k as f64 * f64::from(self.facts.cycle_us) / 1e6
    }

    /// Every point of the contour that is kept, in order.
    pub(crate) fn points(&self) -> impl Iterator<Item = &Point> {
        self.track.points()
    }

    /// Bound in mm of the distance of every point of the contour from the lines between the points that are kept.
    pub(crate) fn within_mm(&self) -> f64 {
        self.track.within_mm()
    }

    /// What it reads of the axes.
    pub(crate) fn asked() -> Asked {
        use Quantity::{Acc, Act, Dev, Ipo, Lag, Load, Set, Target, Vel};
        Asked::of(&[Ipo, Set, Act, Load, Target, Dev, Lag, Vel, Acc])
    }

    /// Adds cycles with the columns of [`Self::asked`].
    pub(crate) fn add(&mut self, rows: &Rows<'_>) {
        for (i, cycle) in rows.cycles().iter().enumerate() {
            self.add_cycle(cycle, |axis, quantity| rows.column(axis, quantity)[i]);
        }
    }

    /// Adds a cycle, with the quantities of an axis.
    fn add_cycle(&mut self, record: &CycleRecord, of: impl Fn(usize, Quantity) -> f64) {
        let point = self.point(record, &of);
        self.track.add(point);
        if self.worst.is_none_or(|worst| point.error > worst.error) {
            self.worst = Some(point);
        }
        self.stops.add(record, &self.facts.axes, &of);
        for (i, samples) in self.accelerations.iter_mut().enumerate() {
            if samples.len() < self.most_samples && !self.facts.axes[i].spindle {
                samples.push(of(i, Quantity::Acc));
            }
        }
        let value = |c: &Curve| match (c.kind.quantity(), c.axis) {
            (Some(quantity), Some(axis)) => of(axis, quantity),
            _ if c.kind == Kind::Speed => record.path.v_mm_s,
            _ => record.contour_err_mm,
        };
        let range: Vec<(f64, f64)> = self.curves.iter().map(|c| (value(c), value(c))).collect();
        let bucket = Bucket {
            k: record.k,
            last: record.k,
            file: record.file,
            line: record.line,
            block: record.block,
            pass: point.pass,
            limit: record.path.limit,
            range,
        };
        match self.buckets.last_mut() {
            Some(last) if last.k / self.width == record.k / self.width => last.merge(bucket),
            _ => self.buckets.push(bucket),
        }
        if self.buckets.len() >= MOST_BUCKETS {
            self.halve();
        }
    }

    fn point(&mut self, record: &CycleRecord, of: impl Fn(usize, Quantity) -> f64) -> Point {
        let in_plane = |quantity| {
            let mut at = [0.0; 3];
            for (slot, &axis) in at.iter_mut().zip(&self.plane) {
                *slot = of(axis, quantity);
            }
            at
        };
        let [ipo, set, act] = [Quantity::Ipo, Quantity::Set, Quantity::Act].map(in_plane);
        let is_straight = matches!(record.path.motion, Motion::Line | Motion::Rapid);
        let target = is_straight.then(|| in_plane(Quantity::Target));
        let near = |p: [f64; 3]| (0..3).all(|i| (p[i] - ipo[i]).abs() < CLOSED_MM);
        // a new pass begins when the path, after a trip, leaves a stop where that trip began
        let start = *self.start.get_or_insert(ipo);
        let at_start = near(start);
        let rests = record.path.v_mm_s.abs() < 1e-9;
        if self.moved && at_start && rests {
            self.moved = false;
        } else if !self.moved && !at_start {
            self.moved = true;
            self.passes.push(Pass { first_line: record.line, ..Pass::default() });
        }
        let pass = self.passes.len().saturating_sub(1);
        if let Some(pass) = self.passes.last_mut() {
            if self.moved {
                pass.last_line = record.line;
            }
            pass.error_mm = pass.error_mm.max(record.contour_err_mm);
        }
        if self.passes.len() > MOST_PASSES {
            self.one_pass();
        }
        let pass = pass.min(self.passes.len().saturating_sub(1));
        let (k, line, error) = (record.k, record.line, record.contour_err_mm);
        Point { k, line, pass, target, error, ipo, set, act }
    }

    /// Treats all passes as one from here on, as there are too many to distinguish.
    fn one_pass(&mut self) {
        let first = self.passes.first().copied().unwrap_or_default();
        let last = self.passes.last().copied().unwrap_or_default();
        let error_mm = self.passes.iter().fold(0.0, |m: f64, p| m.max(p.error_mm));
        self.passes =
            vec![Pass { first_line: first.first_line, last_line: last.last_line, error_mm }];
        for bucket in &mut self.buckets {
            bucket.pass = 0;
        }
        self.track.one_pass();
        // a start to which the path never returns
        self.start = Some([f64::INFINITY; 3]);
        self.moved = true;
    }

    fn halve(&mut self) {
        self.width *= 2;
        let width = self.width;
        let mut merged: Vec<Bucket> = Vec::with_capacity(MOST_BUCKETS);
        for bucket in self.buckets.drain(..) {
            match merged.last_mut() {
                Some(last) if last.k / width == bucket.k / width => last.merge(bucket),
                _ => merged.push(bucket),
            }
        }
        self.buckets = merged;
    }
}

impl Bucket {
    fn merge(&mut self, other: Self) {
        self.last = other.last;
        for (a, b) in self.range.iter_mut().zip(other.range) {
            *a = (a.0.min(b.0), a.1.max(b.1));
        }
    }
}

/// The programmed path in a plane: a straight block extends to its end, whatever happens to its corner; other blocks
/// are the interpolated points. The last block ends with the run.
pub(crate) fn programmed(points: &[Point], [x, y]: [usize; 2]) -> Vec<[f64; 2]> {
    let flat = |p: [f64; 3]| [p[x], p[y]];
    let mut path: Vec<[f64; 2]> = points.first().map(|p| flat(p.ipo)).into_iter().collect();
    let mut blocks = points.chunk_by(|a, b| a.target == b.target && a.line == b.line).peekable();
    while let Some(block) = blocks.next() {
        let Some(last) = block.last() else { continue };
        match last.target {
            Some(end) => path.push(flat(if blocks.peek().is_some() { end } else { last.ipo })),
            None => path.extend(block.iter().map(|p| flat(p.ipo))),
        }
    }
    path
}

#[cfg(test)]
mod tests;
