//! Geometry of one block over all axes of the channel, parameterised by path length `s`.
//!
//! `s` is measured over the feed axes; the other axes are slaved and linear in `s`. If no feed axis moves, `s` is
//! measured over all axes that move (Assumption: the documents do not say; all axes are then treated alike).
//!
//! Make the path first, then its block; the planner evaluates positions and derivatives.
//!
//! ```
//! use kontur_motion::axis::AxisVec;
//! use kontur_motion::path::{ArcPath, ArcShape, Path};
//!
//! // a quarter of a circle of 10 mm around the origin
//! let [from, to] = [[10.0, 0.0], [0.0, 10.0]].map(|p| AxisVec::from_slice(&p));
//! let sweep_rad = std::f64::consts::FRAC_PI_2;
//! let shape = ArcShape { plane: [0, 1], centre_mm: [0.0, 0.0], sweep_rad };
//! let path = Path::Arc(ArcPath::new(from, to, shape, &[true, true]).unwrap());
//! assert!((path.length() - 10.0 * sweep_rad).abs() < 1e-12);
//! let mut curvature = [0.0; 2];
//! path.curvature(0.0, &mut curvature);
//! assert!((curvature[0] + 0.1).abs() < 1e-12);
//! ```

mod arc;
mod ball;
mod extremes;
mod line;
pub(crate) mod piece;
mod poly;
mod tilted;

pub use arc::{ArcPath, ArcShape};
pub(crate) use ball::Ball;
pub(crate) use line::Along;
pub use line::LinePath;
pub use piece::{Coefficients, PolyPiece};
pub use poly::PolyPath;
pub use tilted::{Tilt, TiltedArc};

use crate::axis::AxisVec;

/// The contour of one block.
#[derive(Clone, Debug, PartialEq)]
pub enum Path {
    /// Straight line in all axes.
    Line(LinePath),
    /// Arc in a plane of two axes, the others linear in the angle (helix); several turns are possible.
    Arc(ArcPath),
    /// Arc in a plane that is tilted to the axes.
    Tilted(Box<TiltedArc>),
    /// Polynomials in all axes: contouring and splines.
    Curve(Box<PolyPath>),
}

impl Path {
    /// Turns the path into a line between other ends over the same axes; false, and unchanged, if no axis moves along
    /// it.
    pub fn lead(&mut self, start: &[f64], end: &[f64], feed_axes: &[bool]) -> bool {
        match self {
            Self::Line(line) if line.axes() == start.len() => line.lead(start, end, feed_axes),
            _ => {
                let [start, end] = [start, end].map(AxisVec::from_slice);
                let line = LinePath::new(start, end, feed_axes).map(Self::Line);
                line.map(|line| *self = line).is_some()
            }
        }
    }

    /// Length in mm (deg), greater than zero for every path that moves.
    pub fn length(&self) -> f64 {
        match self {
            Self::Line(p) => p.length(),
            Self::Arc(p) => p.length(),
            Self::Tilted(p) => p.arc().length(),
            Self::Curve(p) => p.length(),
        }
    }

    /// Position of every axis at path length `s` (limited to `0..=length`); exact at both ends.
    pub fn position(&self, s: f64, out: &mut [f64]) {
        match self {
            Self::Line(p) => p.position(s, out),
            Self::Arc(p) => p.position(s, out),
            Self::Tilted(p) => p.position(s, out),
            Self::Curve(p) => p.position(s, out),
        }
    }

    /// As [`Self::position`], to 1e-7 of the length, which costs a fifth for curves.
    pub(crate) fn near(&self, s: f64, out: &mut [f64]) {
        match self {
            Self::Curve(p) => p.near(s, out),
            path => path.position(s, out),
        }
    }

    /// First derivative `dq/ds` of every axis.
    pub fn tangent(&self, s: f64, out: &mut [f64]) {
        match self {
            Self::Line(p) => out.copy_from_slice(p.direction()),
            Self::Arc(p) => p.tangent(s, out),
            Self::Tilted(p) => p.tangent(s, out),
            Self::Curve(p) => p.tangent(s, out),
        }
    }

    /// Second derivative of every axis with respect to `s` in 1/mm.
    pub fn curvature(&self, s: f64, out: &mut [f64]) {
        match self {
            Self::Line(_) => out.fill(0.0),
            Self::Arc(p) => p.curvature(s, out),
            Self::Tilted(p) => p.curvature(s, out),
            Self::Curve(p) => p.curvature(s, out),
        }
    }

    /// Start point.
    pub fn start(&self) -> &AxisVec {
        match self {
            Self::Line(p) => p.start(),
            Self::Arc(p) => p.start(),
            Self::Tilted(p) => p.start(),
            Self::Curve(p) => p.start(),
        }
    }

    /// End point.
    pub fn end(&self) -> &AxisVec {
        match self {
            Self::Line(p) => p.end(),
            Self::Arc(p) => p.end(),
            Self::Tilted(p) => p.end(),
            Self::Curve(p) => p.end(),
        }
    }

    /// Whether the path is a straight line in all axes.
    pub fn is_straight(&self) -> bool {
        matches!(self, Self::Line(_))
    }

    /// The part of a line or an arc between two path lengths, with exactly the same direction and curvature; `None` for
    /// other paths.
    pub fn section(&self, from: f64, to: f64) -> Option<Self> {
        match self {
            Self::Line(p) => Some(Self::Line(p.section(from, to))),
            Self::Arc(p) => Some(Self::Arc(p.section(from, to))),
            Self::Tilted(p) => Some(Self::Tilted(Box::new(p.section(from, to)))),
            Self::Curve(_) => None,
        }
    }

    /// Lowest and highest position of an axis on a line or an arc; `None` for other paths.
    pub fn extent(&self, axis: usize) -> Option<(f64, f64)> {
        let (start, end) = (self.start()[axis], self.end()[axis]);
        let ends = (start.min(end), start.max(end));
        let turning = match self {
            Self::Line(_) => return Some(ends),
            Self::Arc(arc) => {
                let shares = arc.shape().plane.map(|a| if a == axis { 1.0 } else { 0.0 });
                arc.turning_points(shares, 0.0)
            }
            Self::Tilted(tilted) if tilted.tilt().axes.contains(&axis) => {
                let (shares, drift) = tilted.shares(axis);
                tilted.arc().turning_points(shares, drift)
            }
            Self::Tilted(_) => [None; 4],
            Self::Curve(_) => return None,
        };
        let mut at = self.start().clone();
        let (mut low, mut high) = ends;
        for s in turning.into_iter().flatten() {
            self.position(s, &mut at);
            low = low.min(at[axis]);
            high = high.max(at[axis]);
        }
        Some((low, high))
    }

    /// Path length of the point of the path nearest to `point` (Euclidean over all axes), searched over the whole path.
    pub fn nearest(&self, point: &[f64]) -> f64 {
        match self {
            Self::Line(p) => p.nearest(point),
            Self::Arc(p) => p.nearest(point),
            Self::Tilted(p) => p.nearest(point),
            Self::Curve(p) => p.nearest(point),
        }
    }

    /// Vector to `point` from the point of the path nearest to it, and the square of its length.
    #[inline] // mostly for straight blocks, at the call site
    pub(crate) fn vector_to(&self, point: &[f64], out: &mut [f64]) -> f64 {
        match self {
            Self::Line(p) => p.vector_to(point, out),
            _ => self.vector_from_bend(point, out),
        }
    }

    fn vector_from_bend(&self, point: &[f64], out: &mut [f64]) -> f64 {
        match self {
            // without the detour by the path length
            Self::Arc(p) => return p.vector_to(point, out),
            Self::Curve(p) => p.nearest_point(point, out),
            _ => self.position(self.nearest(point), out),
        }
        let mut square = 0.0;
        for (out, p) in out.iter_mut().zip(point) {
            *out = p - *out;
            square += *out * *out;
        }
        square
    }
}
