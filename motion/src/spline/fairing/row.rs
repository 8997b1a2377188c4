//! The points of a run that the spline is fitted to.

use super::super::edge::is_feed;
use crate::axis::AxisVec;
use crate::block::{Block, SplineSettings};

/// Share of the tolerance that may be used to remove noise, or to pass over points that are close together.
const SHARE: f64 = 0.3;
/// Largest distance in mm (deg) used for that: rounding to a ten-thousandth of an inch in three axes is 2.2 um.
const MOST: f64 = 3e-3;
/// Tolerances that are used where none is programmed: the defaults of `PATH_DEV` and `TRACK_DEV`.
const UNMONITORED: [f64; 2] = [0.2, 5.0];
/// Change of direction at a corner in rad, in addition to the effect of noise of [`GRAIN_MM`] at three points; and on an
/// arc, where points next to each other turn in the same direction: an arc in coarse chords is not a row of corners.
const CORNER_RAD: f64 = 0.35;
const ARC_RAD: f64 = 0.7;
/// Shortest chord in mm of such an arc: a fit through shorter ones, as at a chamfer, bends more than the corners.
const ARC_MM: f64 = 0.3;
const GRAIN_MM: f64 = 1e-3;
/// Second derivatives of neighbours in the same direction, as a share of the one at a point, below which the point is not
/// part of a curve.
const ALONE: f64 = 0.5;

/// Share of the tolerance that rounding a kink of axes outside the feed group may use at a point; between the points it is
/// more.
const AT_KINKS: f64 = 0.5;

/// Axes of the feed group, and the others.
pub(super) type Groups = [Vec<usize>; 2];

/// The groups of the axes of a block.
pub(super) fn groups(block: &Block) -> Groups {
    let axes = 0..block.path.start().len();
    let (feed, others) = axes.partition(|i| is_feed(block, *i));
    [feed, others]
}

/// Distance of two points over some axes.
pub(super) fn apart(p: &[f64], q: &[f64], axes: &[usize]) -> f64 {
    axes.iter().map(|i| (q[*i] - p[*i]) * (q[*i] - p[*i])).sum::<f64>().sqrt()
}

/// The tolerances of both groups.
fn tolerances(settings: &SplineSettings) -> [f64; 2] {
    let [path, track] = UNMONITORED;
    let or = |dev: f64, default: f64| if dev > 0.0 { dev } else { default };
    [or(settings.path_dev_mm, path), or(settings.track_dev_deg, track)]
}

/// Largest distance of a point from the curve for both groups, and of a point that is passed over from the one before.
pub(super) fn rooms(settings: &SplineSettings) -> [f64; 2] {
    tolerances(settings).map(|dev| MOST.min(SHARE * dev))
}

/// The settings with the smaller tolerances of two.
pub(super) fn tighter(a: SplineSettings, b: &SplineSettings) -> SplineSettings {
    let of = |x: f64, y: f64| if x > 0.0 && (x < y || y <= 0.0) { x } else { y };
    SplineSettings {
        path_dev_mm: of(a.path_dev_mm, b.path_dev_mm),
        track_dev_deg: of(a.track_dev_deg, b.track_dev_deg),
        ..*b
    }
}

/// An edge between two kept points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Chord {
    pub(super) settings: SplineSettings,
    /// How far the programmed path between its ends is from it, in either group.
    pub(super) off: [f64; 2],
}

impl Chord {
    /// What the spline may deviate from the edge in either group.
    pub(super) fn left(&self) -> [f64; 2] {
        let dev = tolerances(&self.settings);
        [dev[0] - self.off[0], dev[1] - self.off[1]]
    }

    /// What a fit may deviate at equal parameters: the axes outside the feed group also follow a shift of the others along
    /// the path ([`Row::room`]).
    pub(super) fn left_to_fit(&self) -> [f64; 2] {
        let [path, track] = self.left();
        [path, track - rooms(&self.settings)[1]]
    }
}

/// A kept point.
#[derive(Debug)]
pub(super) struct Vertex {
    pub(super) point: AxisVec,
    /// Position on the polygon in mm.
    pub(super) at: f64,
    /// The edge that ends here; of no meaning at the first point of a run.
    pub(super) chord: Chord,
    /// Whether the point itself has to be a control point.
    pub(super) stays: bool,
}

/// Points of a run with what their classification needs.
pub(super) struct Row<'a> {
    pub(super) vertices: &'a [Vertex],
    pub(super) groups: &'a Groups,
}

impl Row<'_> {
    /// Length of the edge after point `i`.
    pub(super) fn length(&self, i: usize) -> f64 {
        self.vertices[i + 1].at - self.vertices[i].at
    }

    pub(super) fn chord(&self, i: usize) -> &Chord {
        &self.vertices[i + 1].chord
    }

    /// Whether the path turns at a point by more than noise could cause.
    pub(super) fn is_corner(&self, i: usize) -> bool {
        let [p, q, r] = [i - 1, i, i + 1].map(|k| &self.vertices[k].point);
        let (h, k) = (self.length(i - 1), self.length(i));
        let (mut jump2, mut sum2) = (0.0, 0.0);
        for axis in &self.groups[0] {
            let (u, w) = ((q[*axis] - p[*axis]) / h, (r[*axis] - q[*axis]) / k);
            jump2 += (w - u) * (w - u);
            sum2 += (w + u) * (w + u);
        }
        let angle = 2.0 * libm::atan2(f64::sqrt(jump2), f64::sqrt(sum2));
        let angle = angle - 2.0 * GRAIN_MM * (h.recip() + k.recip());
        angle > CORNER_RAD && (angle > ARC_RAD || h.min(k) < ARC_MM || self.turns_alone(i))
    }

    /// Whether the path turns at a point, but not at the next one on either side as on an arc.
    fn turns_alone(&self, i: usize) -> bool {
        let bend = |n: usize, axis: usize| {
            let inside = n > 0 && n + 1 < self.vertices.len();
            if inside { self.bend(n, axis)[0] } else { 0.0 }
        };
        let with = |n: usize| {
            let product = |axis: &usize| bend(i, *axis) * bend(n, *axis);
            self.groups[0].iter().map(product).sum::<f64>()
        };
        with(i - 1).max(with(i + 1)) < ALONE * with(i)
    }

    /// Whether an axis outside the feed group changes its speed along the path at a point alone, by more than a curve so
    /// close to the points could do smoothly.
    pub(super) fn is_kink(&self, i: usize) -> bool {
        let (h, k) = (self.length(i - 1), self.length(i));
        let room = self.room(i - 1, false)[1].min(self.room(i, false)[1]);
        // the deviation of a control point at the kink, for a change of speed by 1
        let reach = h * k / (3.0 * (h + k));
        self.groups[1].iter().any(|axis| {
            let [own, noise] = self.bend(i, *axis);
            let beside = |n: usize| {
                let inside = n > 0 && n + 1 < self.vertices.len();
                let [bend, noise] = if inside { self.bend(n, *axis) } else { [0.0; 2] };
                bend * own.signum() + noise
            };
            let (own, to_jump) = (own.abs() - noise, 0.5 * (h + k));
            own * to_jump * reach > room && beside(i - 1).max(beside(i + 1)) < ALONE * own
        })
    }

    /// Second derivative of an axis at a point from its neighbours, and what noise may change it by.
    fn bend(&self, i: usize, axis: usize) -> [f64; 2] {
        let [p, q, r] = [i - 1, i, i + 1].map(|k| self.vertices[k].point[axis]);
        let (h, k) = (self.length(i - 1), self.length(i));
        let of = 2.0 / (h + k);
        [of * ((r - q) / k - (q - p) / h), of * 2.0 * GRAIN_MM * (h.recip() + k.recip())]
    }

    /// Largest distance of points of the edge after point `i` from the curve; `at_kink`: the axes outside the feed group
    /// round a kink there.
    pub(super) fn room(&self, i: usize, at_kink: bool) -> [f64; 2] {
        let settings = &self.chord(i).settings;
        let [path, track] = rooms(settings);
        // along the path the other axes follow the feed group
        let (p, q) = (&self.vertices[i].point, &self.vertices[i + 1].point);
        let fastest = self.groups[1].iter().map(|k| (q[*k] - p[*k]).abs()).fold(0.0, f64::max);
        let follows = settings.track_dev_deg > 0.0 && fastest > 0.0;
        let follow = if follows { track * self.length(i) / fastest } else { path };
        // a shift along the path adds to what they deviate themselves
        let track = if at_kink { track.max(AT_KINKS * self.chord(i).left()[1]) } else { track };
        [path.min(follow), track]
    }
}
