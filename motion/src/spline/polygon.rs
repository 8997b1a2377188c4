//! The control polygon around an edge: control points, knots, and the spline in Bezier form.

use super::edge::Edge;
use super::stage::Span;
use crate::axis::AxisVec;
use crate::path::PolyPiece;
use crate::path::piece::divided;
use smallvec::SmallVec;
use std::collections::VecDeque;

/// Largest number of subdivisions of the legs at a corner. Each reduces the deviation by at least a third, where less
/// than a tenth of it has to remain.
const DEEPEST: usize = 32;

/// A control point with its knot.
#[derive(Clone, Debug)]
struct Node {
    point: AxisVec,
    /// Position on the polygon: the knot, except for control points that a subdivision puts on an edge.
    at: f64,
    knot: f64,
    /// The largest reach of the spline at a corner that is still at its programmed point; otherwise `None`.
    reach: Option<f64>,
}

/// The first polynomial of a fit next to a corner, seen from the corner. The control points that the corner adds are
/// knots inserted into the fit, which leaves it unchanged.
struct FitEnd {
    bezier: [AxisVec; 4],
    /// The first two knot intervals.
    intervals: [f64; 2],
}

impl FitEnd {
    /// The fit that starts with an edge, if a corner there has its own control points.
    fn at_start(run: &VecDeque<Edge>, edge: usize) -> Option<Self> {
        let of = |i: usize| run.get(i).filter(|edge| edge.fitted);
        let edges = [of(edge)?, of(edge + 1)?, of(edge + 2)?];
        edges[0].corner.e?;
        let points = edges.map(|edge| edge.block.path.start());
        Some(Self::new(points, edges.map(|edge| edge.interval)))
    }

    /// The fit that ends with an edge.
    fn at_end(run: &VecDeque<Edge>, edge: usize) -> Option<Self> {
        let of = |i: usize| run.get(i).filter(|edge| edge.fitted);
        run.get(edge + 1)?.corner.e?;
        let edges = [of(edge)?, of(edge.checked_sub(1)?)?, of(edge.checked_sub(2)?)?];
        let points =
            [edges[0].block.path.end(), edges[0].block.path.start(), edges[1].block.path.start()];
        Some(Self::new(points, edges.map(|edge| edge.interval)))
    }

    fn new([p, q, r]: [&AxisVec; 3], [h, k, l]: [f64; 3]) -> Self {
        let b1 = between(p, q, h / (2.0 * h + k));
        let b2 = between(p, q, 2.0 * h / (2.0 * h + k));
        let b3 = between(&b2, &between(q, r, h / (h + k + l)), h / (h + k));
        Self { bezier: [p.clone(), b1, b2, b3], intervals: [h, k] }
    }

    /// The blossom: the control point with these three knots.
    fn blossom(&self, knots: [f64; 3]) -> AxisVec {
        let mut points = self.bezier.to_vec();
        for knot in knots {
            points = points
                .windows(2)
                .map(|p| between(&p[0], &p[1], knot / self.intervals[0]))
                .collect();
        }
        points.swap_remove(0)
    }

    /// The control point at `e`.
    fn near(&self, e: f64) -> AxisVec {
        self.blossom([0.0, e, 2.0 * e])
    }

    /// The control point at `2 e`.
    fn far(&self, e: f64) -> AxisVec {
        self.blossom([e, 2.0 * e, self.intervals[0]])
    }

    /// The control point at the next knot of the fit.
    fn next(&self, e: f64) -> AxisVec {
        let [h, k] = self.intervals;
        self.blossom([2.0 * e, h, h + k])
    }
}

/// The control point at the start of an edge, if a corner at the other end of one of its legs changes it.
fn inserted(run: &VecDeque<Edge>, edge: usize) -> Option<AxisVec> {
    let before = edge
        .checked_sub(1)
        .and_then(|before| Some(FitEnd::at_start(run, before)?.next(run[before].corner.e?)));
    before.or_else(|| Some(FitEnd::at_end(run, edge)?.next(run.get(edge + 1)?.corner.e?)))
}

/// Control points around an edge.
#[derive(Debug)]
pub(super) struct ControlPolygon {
    nodes: SmallVec<[Node; 24]>,
    /// Indices of the control points at the start and the end of the edge.
    pub(super) first: usize,
    pub(super) last: usize,
}

impl ControlPolygon {
    pub(super) fn around(run: &VecDeque<Edge>, edge: usize, span: &Span) -> Self {
        let mut out = Self { nodes: SmallVec::new(), first: 0, last: 0 };
        let (mut at, mut knot) = (0.0, 0.0);
        for i in span.edges.clone() {
            let Edge { length, interval, corner, block, .. } = &run[i];
            out.last = if i == edge + 1 { out.nodes.len() } else { out.last };
            out.first = if i == edge { out.nodes.len() } else { out.first };
            let reach = corner.e.is_none().then_some(corner.reach);
            let point = inserted(run, i).unwrap_or_else(|| block.path.start().clone());
            out.nodes.push(Node { point, at, knot, reach });
            let behind = run.get(i + 1).and_then(|next| next.corner.e);
            let (start, end) = (FitEnd::at_start(run, i), FitEnd::at_end(run, i));
            if let Some(e) = corner.e {
                let fit = start.as_ref();
                out.push_on(run, i, (at, knot), e, fit.map(|fit| fit.near(e)));
                out.push_on(run, i, (at, knot), 2.0 * e, fit.map(|fit| fit.far(e)));
            }
            if let Some(e) = behind {
                let fit = end.as_ref();
                out.push_on(run, i, (at, knot), interval - 2.0 * e, fit.map(|fit| fit.far(e)));
                out.push_on(run, i, (at, knot), interval - e, fit.map(|fit| fit.near(e)));
            }
            at += length;
            knot += interval;
        }
        if let Some(last) = run.get(span.edges.end.wrapping_sub(1)) {
            out.last = if span.edges.end == edge + 1 { out.nodes.len() } else { out.last };
            let point = last.block.path.end().clone();
            out.nodes.push(Node { point, at, knot, reach: None });
        }
        if span.to_end {
            out.mirror_end();
        }
        if span.from_start {
            out.mirror_start();
        }
        for _ in 0..DEEPEST {
            if !out.subdivide() {
                break;
            }
        }
        out
    }

    /// Pushes a control point next to a corner, at a knot within a leg: that of the fit, or else on the leg.
    fn push_on(
        &mut self,
        run: &VecDeque<Edge>,
        edge: usize,
        (at, knot): (f64, f64),
        offset: f64,
        on_fit: Option<AxisVec>,
    ) {
        let Edge { block, length, interval, .. } = &run[edge];
        let along = offset * length / interval;
        let point = on_fit.unwrap_or_else(|| {
            let mut p = block.path.start().clone();
            block.path.position(along, &mut p);
            p
        });
        self.nodes.push(Node { point, at: at + along, knot: knot + offset, reach: None });
    }

    /// Mirrors two control points at the end, which makes it an exact end without curvature.
    fn mirror_end(&mut self) {
        let n = self.nodes.len() - 1;
        for back in 1..=2 {
            let mirrored = self.mirrored(n, n.saturating_sub(back));
            self.nodes.push(mirrored);
        }
    }

    fn mirror_start(&mut self) {
        for back in 1..=2 {
            // each insertion moves the start by one
            let start = back - 1;
            let mirrored = self.mirrored(start, start + back);
            self.nodes.insert(0, mirrored);
            self.first += 1;
            self.last += 1;
        }
    }

    fn mirrored(&self, center: usize, node: usize) -> Node {
        let (c, n) = (&self.nodes[center], &self.nodes[node]);
        let (at, knot) = (2.0 * c.at - n.at, 2.0 * c.knot - n.knot);
        let point = c.point.iter().zip(n.point.iter()).map(|(c, p)| 2.0 * c - p).collect();
        Node { point, at, knot, reach: None }
    }

    fn knot(&self, j: usize) -> f64 {
        self.nodes[j].knot
    }

    /// Ratio at which the third knot `t` divides the leg after control point `j`, between the knots at its ends.
    fn ratio(&self, j: usize, t: f64) -> f64 {
        let (before, behind) = (self.knot(j - 1), self.knot(j + 2));
        (t - before) / (behind - before)
    }

    /// Point on the leg after control point `j` with the knots at its ends and the third knot `t`.
    fn on_leg(&self, j: usize, t: f64) -> AxisVec {
        between(&self.nodes[j].point, &self.nodes[j + 1].point, self.ratio(j, t))
    }

    /// The control point for the knots `a`, `j` and `b`; with all three equal it is the point of the spline.
    fn control(&self, j: usize, a: f64, b: f64) -> AxisVec {
        let (before, behind) = (self.knot(j - 1), self.knot(j + 1));
        let ratio = (a - before) / (behind - before);
        between(&self.on_leg(j - 1, b), &self.on_leg(j, b), ratio)
    }

    /// Point of the spline at knot `j`.
    pub(super) fn joint(&self, j: usize) -> AxisVec {
        self.control(j, self.knot(j), self.knot(j))
    }

    /// The polynomials of the edge for each of its parts; the ends of all but the last are shares of its knot interval.
    pub(super) fn stretches(&self, ends: impl Iterator<Item = f64>) -> Vec<Vec<PolyPiece>> {
        let (from, to) = (self.knot(self.first), self.knot(self.last));
        let mut joint = self.joint(self.first);
        let pieces = (self.first..self.last).map(|j| {
            let start = std::mem::replace(&mut joint, self.joint(j + 1));
            self.piece(j, &start, &joint)
        });
        let mut j = self.first;
        let ends = ends.map(|share| {
            let end = from + share * (to - from);
            while j + 1 < self.last && end > self.knot(j + 1) {
                j += 1;
            }
            let (before, behind) = (self.knot(j), self.knot(j + 1));
            (j - self.first, (end - before) / (behind - before))
        });
        divided(pieces, ends)
    }

    /// The polynomial between the points of the spline at knot `j` and the next one.
    fn piece(&self, j: usize, b0: &AxisVec, b3: &AxisVec) -> PolyPiece {
        let (b1, b2) = (self.on_leg(j, self.knot(j)), self.on_leg(j, self.knot(j + 1)));
        (0..b0.len())
            .map(|i| {
                let (p, q, r, s) = (b0[i], b1[i], b2[i], b3[i]);
                let second = (p - q) - (q - r);
                [p, 3.0 * (q - p), 3.0 * second, (s - p) - 3.0 * (r - q), 0.0, 0.0]
            })
            .collect()
    }

    /// Reach of the spline at a corner that is a control point: its deviation for a change of direction by 1.
    fn reach(&self, j: usize) -> f64 {
        let node = |k: usize| (self.nodes[k].at, self.nodes[k].knot);
        reach([j - 2, j - 1, j, j + 1, j + 2].map(node))
    }

    /// The reach after subdivision of both legs.
    fn reach_subdivided(&self, j: usize) -> f64 {
        let node = |k: usize| (self.nodes[k].at, self.nodes[k].knot);
        let middle = |k: usize| {
            let t = self.middle(k);
            let ((a, _), (b, _)) = (node(k), node(k + 1));
            (a + self.ratio(k, t) * (b - a), t)
        };
        reach([node(j - 1), middle(j - 1), node(j), middle(j), node(j + 1)])
    }

    fn middle(&self, j: usize) -> f64 {
        0.5 * (self.knot(j) + self.knot(j + 1))
    }

    /// Adds a knot in the middle of both legs of every corner with too large a reach. This alone leaves the spline
    /// unchanged, with the new control points on the edges and the corners pulled in; then the corners move back
    /// towards the programmed points, as far as the tolerance requires. False if there are no such corners.
    fn subdivide(&mut self) -> bool {
        let n = self.nodes.len();
        let inside = |j: usize| j >= 2 && j + 2 < n;
        let reaches_far =
            |j: usize| inside(j) && self.nodes[j].reach.is_some_and(|reach| self.reach(j) > reach);
        let far: SmallVec<[bool; 32]> = (0..n).map(reaches_far).collect();
        if !far.contains(&true) {
            return false;
        }
        let splits = |j: usize| j + 1 < n && (far[j] || far[j + 1]);
        let (mut first, mut last) = (self.first, self.last);
        let mut nodes = SmallVec::new();
        for j in 0..n {
            let mut node = self.nodes[j].clone();
            let (before, behind) = (j > 0 && splits(j - 1), splits(j));
            // the outermost control points have no influence on the edge
            if inside(j) {
                let a = if before { self.middle(j - 1) } else { self.knot(j - 1) };
                let b = if behind { self.middle(j) } else { self.knot(j + 1) };
                let drawn_in = self.control(j, a, b);
                if let Some(reach) = node.reach.filter(|_| far[j]) {
                    let (now, then) = (self.reach(j), self.reach_subdivided(j));
                    if then < reach {
                        let back = (now - reach) / (now - then);
                        node.point = between(&drawn_in, &node.point, back);
                        node.reach = None;
                    }
                } else {
                    // judged once: changes at its neighbours leave the spline here unchanged
                    (node.point, node.reach) = (drawn_in, None);
                }
            }
            first = if j == self.first { nodes.len() } else { first };
            last = if j == self.last { nodes.len() } else { last };
            let at = node.at;
            nodes.push(node);
            if behind {
                let knot = self.middle(j);
                let at = at + self.ratio(j, knot) * (self.nodes[j + 1].at - at);
                nodes.push(Node { point: self.on_leg(j, knot), at, knot, reach: None });
            }
        }
        *self = Self { nodes, first, last };
        true
    }
}

fn between(p: &AxisVec, q: &AxisVec, ratio: f64) -> AxisVec {
    p.iter().zip(q.iter()).map(|(p, q)| p + ratio * (q - p)).collect()
}

/// Reach at the middle one of five control points given by position and knot.
///
/// With `g h k l` between the knots, the Bezier points before and after the corner are at the distances
/// `h k / (g + h + k)` and `h k / (h + k + l)` from it (on legs as long as `h` and `k`), and the spline divides their
/// connection as `h : k`. Its distance from the first edge is therefore `beta sin(theta)`, from the second one
/// `alpha sin(theta)`, where `alpha = h k^2 / ((h + k) (g + h + k))` and `beta = h^2 k / ((h + k) (h + k + l))`, and
/// its distance from the corner is at most the larger of the two times the change of direction. With equal edges that
/// is a sixth of an edge.
fn reach([a, b, c, d, e]: [(f64, f64); 5]) -> f64 {
    let (h, k) = (c.1 - b.1, d.1 - c.1);
    let alpha = (c.0 - b.0) * k * k / (d.1 - a.1);
    let beta = (d.0 - c.0) * h * h / (e.1 - b.1);
    alpha.max(beta) / (h + k)
}
