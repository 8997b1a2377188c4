//! Arc or helix in a coordinate system that is rotated in space.
//!
//! The arc is an [`ArcPath`] in the coordinates of that system. Three axes of the machine are mapped to it by a
//! rotation, the others are the same in both.

use super::arc::ArcPath;
use crate::axis::AxisVec;

/// Rotation (or reflection) and shift of three axes: `q = m p + t`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tilt {
    /// Channel indices of the three axes.
    pub axes: [usize; 3],
    /// Orthogonal matrix.
    pub m: [[f64; 3]; 3],
    /// Origin of the system in mm.
    pub t_mm: [f64; 3],
}

impl Tilt {
    /// Machine position of a position in the system.
    pub fn position(&self, local: &AxisVec) -> AxisVec {
        let mut out = local.clone();
        self.turn(&mut out);
        for (axis, t) in self.axes.into_iter().zip(self.t_mm) {
            out[axis] += t;
        }
        out
    }

    /// Position in the system of a machine position.
    pub fn local(&self, machine: &[f64]) -> AxisVec {
        let mut out = AxisVec::from_slice(machine);
        let d: [f64; 3] = std::array::from_fn(|i| machine[self.axes[i]] - self.t_mm[i]);
        for (j, axis) in self.axes.into_iter().enumerate() {
            out[axis] = self.m[0][j] * d[0] + self.m[1][j] * d[1] + self.m[2][j] * d[2];
        }
        out
    }

    /// Rotates a direction of the system into one of the machine, in place.
    fn turn(&self, v: &mut [f64]) {
        let d = self.axes.map(|axis| v[axis]);
        for (row, axis) in self.m.iter().zip(self.axes) {
            v[axis] = row[0] * d[0] + row[1] * d[1] + row[2] * d[2];
        }
    }
}

/// An arc in a rotated coordinate system.
#[derive(Clone, Debug, PartialEq)]
pub struct TiltedArc {
    arc: ArcPath,
    tilt: Tilt,
    start: AxisVec,
    end: AxisVec,
}

impl TiltedArc {
    /// An arc of the system, with its ends as machine positions; these must be the images of the ends of the arc.
    pub fn new(arc: ArcPath, tilt: Tilt, start: AxisVec, end: AxisVec) -> Self {
        Self { arc, tilt, start, end }
    }

    /// The arc in the coordinates of the system.
    pub fn arc(&self) -> &ArcPath {
        &self.arc
    }

    /// The system.
    pub fn tilt(&self) -> &Tilt {
        &self.tilt
    }

    pub(super) fn start(&self) -> &AxisVec {
        &self.start
    }

    pub(super) fn end(&self) -> &AxisVec {
        &self.end
    }

    pub(super) fn position(&self, s: f64, out: &mut [f64]) {
        if s <= 0.0 {
            out.copy_from_slice(&self.start);
        } else if s >= self.arc.length() {
            out.copy_from_slice(&self.end);
        } else {
            self.arc.position(s, out);
            self.tilt.turn(out);
            for (axis, t) in self.tilt.axes.into_iter().zip(self.tilt.t_mm) {
                out[axis] += t;
            }
        }
    }

    pub(super) fn tangent(&self, s: f64, out: &mut [f64]) {
        self.arc.tangent(s, out);
        self.tilt.turn(out);
    }

    pub(super) fn curvature(&self, s: f64, out: &mut [f64]) {
        self.arc.curvature(s, out);
        self.tilt.turn(out);
    }

    pub(super) fn section(&self, from: f64, to: f64) -> Self {
        let (mut start, mut end) = (self.start.clone(), self.end.clone());
        self.position(from, &mut start);
        self.position(to, &mut end);
        Self { arc: self.arc.section(from, to), tilt: self.tilt, start, end }
    }

    pub(super) fn nearest(&self, point: &[f64]) -> f64 {
        self.arc.nearest(&self.tilt.local(point))
    }

    /// Components of a machine axis along the first and second direction of the plane, and its movement per s along the
    /// normal.
    pub(crate) fn shares(&self, axis: usize) -> ([f64; 2], f64) {
        let mut v = AxisVec::zeros(self.start.len());
        let mut image = |fill: &dyn Fn(&mut AxisVec)| {
            v.fill(0.0);
            fill(&mut v);
            self.tilt.turn(&mut v);
            v[axis]
        };
        let circle = self.arc.shape().plane.map(|i| image(&|v| v[i] = 1.0));
        (circle, image(&|v| self.arc.tangent_outside_plane(v)))
    }
}
