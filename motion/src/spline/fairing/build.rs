//! From the points of a run to control points: which points stay control points, and which the spline is fitted to.
//!
//! A point stays a control point ("corner") at both ends of a run, where the path turns by more than noise could cause,
//! and next to an edge whose sagitta exceeds the tolerance: such an edge cannot be bent freely. The points between two
//! of them are a row of their own. Where a long edge follows short ones tangentially, virtual points on it take the
//! place of short edges, in growing steps; if much of it is left, its middle stays straight: the last virtual point
//! becomes a control point, and the ones mirrored there become real.
//!
//! Where axes outside the feed group have a kink of their own, the others do not turn and have no corner there. These axes
//! round it within a share of their tolerance: to follow it closely they would overshoot before and after it, and a corner
//! would interrupt the fit of the main axes.
//!
//! Where the deviation of the fit cannot be certified, the points around stay control points, and the fit is repeated.

use super::super::node::Node;
use super::certificate;
use super::data::{Datum, Kind, coordinate, data, room};
use super::fit;
use super::knots::{Spline, evened};
use super::row::{Row, apart};
use crate::axis::AxisVec;
use std::ops::Range;

/// Smallest number of edges of a row.
const FEWEST: usize = 4;
/// Share of the tolerance that a fit may use next to a corner; the remainder is for rounding the corner.
const AT_CORNERS: f64 = 0.75;
/// Rounds in which only the points near a failure become corners; after that all of the row do.
const ROUNDS: usize = 4;

/// Number of control points before a point that influence the spline after it.
pub(super) const BEHIND: usize = 3;

/// The control points of some points of a run.
#[derive(Debug)]
pub(super) struct Built {
    pub(super) nodes: Vec<Node>,
    data: Vec<Datum>,
    /// Coordinates of the data by axis.
    points: Vec<Vec<f64>>,
}

/// The control points of all points of a row.
pub(super) fn built(row: &Row<'_>) -> Built {
    let mut stays: Vec<bool> = row.vertices.iter().map(|v| v.stays).collect();
    let mut round = 0;
    loop {
        let mut out = Built::new(row, &stays);
        let ranges = out.chains();
        let mut failures = Vec::new();
        for chain in ranges {
            let failed = out.certify(row, chain.clone());
            if failed.is_empty() {
                continue;
            }
            if round >= ROUNDS {
                failures.push(out.nodes[chain.start].place.0..out.nodes[chain.end].place.0 + 1);
            } else {
                let near = |i: usize| i.saturating_sub(1)..(i + 3).min(stays.len());
                failures.extend(failed.into_iter().map(near));
            }
        }
        if failures.is_empty() {
            return out;
        }
        for range in failures {
            stays[range].fill(true);
        }
        round += 1;
    }
}

impl Built {
    fn new(row: &Row<'_>, stays: &[bool]) -> Self {
        let data = data(row, stays);
        let count = row.groups.iter().map(Vec::len).sum();
        let of_axis = |axis: usize| data.iter().map(|d| coordinate(row, d, axis)).collect();
        let points = (0..count).map(of_axis).collect();
        let mut out = Self { nodes: Vec::with_capacity(data.len() + 4), data, points };
        let is_end = |d: &Datum| matches!(d.kind, Kind::Corner | Kind::Middle);
        let ends: Vec<usize> = (0..out.data.len()).filter(|i| is_end(&out.data[*i])).collect();
        let rows: Vec<(usize, usize)> = ends.windows(2).map(|w| (w[0], w[1])).collect();
        let is_fit = |(a, b): (usize, usize)| b - a >= FEWEST;
        for (r, (a, b)) in rows.iter().copied().enumerate() {
            if is_fit((a, b)) {
                let first = out.nodes.len();
                out.fit(row, a, b);
                let middle = |i: usize| out.data[i].kind == Kind::Middle;
                let of_middle = r > 0 && middle(a) && !is_fit(rows[r - 1]);
                if of_middle {
                    out.mirror_before(first);
                }
            } else {
                let after_fit = r > 0 && is_fit(rows[r - 1]);
                if out.data[a].kind != Kind::Middle {
                    out.push_plain(a, b);
                } else if after_fit {
                    out.push(a, false, false);
                    out.mirror_behind();
                }
            }
        }
        if let Some(last) = out.data.len().checked_sub(1) {
            out.push(last, true, false);
        }
        out
    }

    /// Pushes a control point at a datum.
    fn push(&mut self, i: usize, is_corner: bool, fitted: bool) {
        let point = self.points.iter().map(|p| p[i]).collect();
        let Datum { vertex, at: knot, .. } = self.data[i];
        self.push_node(knot, point, vertex, is_corner, fitted);
    }

    fn push_node(
        &mut self,
        knot: f64,
        point: AxisVec,
        vertex: usize,
        is_corner: bool,
        fitted: bool,
    ) {
        let number = match self.nodes.last() {
            Some(last) if last.place.0 == vertex => last.place.1 + 1,
            _ => 0,
        };
        let place = (vertex, number);
        self.nodes.push(Node { knot, point, place, is_corner, fitted, off: [0.0; 2] });
    }

    /// The points of a short row stay control points, and its virtual ones are not needed.
    fn push_plain(&mut self, a: usize, b: usize) {
        for i in a..b {
            if matches!(self.data[i].kind, Kind::Corner | Kind::Smooth) {
                self.push(i, true, false);
            }
        }
    }

    /// The control points of a row but the last.
    fn fit(&mut self, row: &Row<'_>, a: usize, b: usize) {
        let at: Vec<f64> = self.data[a..=b].iter().map(|d| d.at).collect();
        let mut knots = at.clone();
        evened(&mut knots);
        let rooms: Vec<[f64; 2]> = (a..=b).map(|i| room(row, &self.data[i])).collect();
        let mut points = vec![Vec::new(); self.points.len()];
        for (group, axes) in row.groups.iter().enumerate() {
            let own: Vec<&[f64]> = axes.iter().map(|axis| &self.points[*axis][a..=b]).collect();
            let room: Vec<f64> = rooms.iter().map(|r| r[group]).collect();
            let at_kink = |d: &Datum| group == 1 && d.at_kink;
            let at_kink: Vec<bool> = self.data[a..=b].iter().map(at_kink).collect();
            let fitted = fit::control_points(&knots, &at, &own, &room, &at_kink);
            for (axis, fitted) in axes.iter().zip(fitted) {
                points[*axis] = fitted;
            }
        }
        for i in a..b {
            let k = i - a;
            let is_corner = self.data[i].kind == Kind::Corner;
            let point = points.iter().map(|p| p[k]).collect();
            self.push_node(knots[k], point, self.data[i].vertex, is_corner, true);
        }
    }

    /// Mirrors the two last control points of a fit behind its end, which is the last one now.
    fn mirror_behind(&mut self) {
        let n = self.nodes.len() - 1;
        for back in 1..=2 {
            let (knot, point) = mirrored(&self.nodes[n], &self.nodes[n - back]);
            self.push_node(knot, point, self.nodes[n].place.0, false, false);
        }
    }

    /// Mirrors the two first control points of a fit before its start.
    fn mirror_before(&mut self, first: usize) {
        let mut fit = self.nodes.split_off(first);
        let vertex = fit[0].place.0;
        for ahead in [2, 1] {
            let (knot, point) = mirrored(&fit[0], &fit[ahead]);
            self.push_node(knot, point, vertex, false, false);
        }
        for node in &mut fit {
            if node.place.0 == vertex {
                node.place.1 = self.nodes.last().map_or(0, |n| n.place.1 + 1);
            }
            self.nodes.push(node.clone());
        }
    }

    /// The control points between two corners, for every two corners with a fit between them.
    pub(super) fn chains(&self) -> Vec<Range<usize>> {
        let is_corner = |i: &usize| self.nodes[*i].is_corner;
        let corners: Vec<usize> = (0..self.nodes.len()).filter(is_corner).collect();
        let pairs = corners.windows(2).map(|w| w[0]..w[1]);
        pairs.filter(|c| self.nodes[c.clone()].iter().any(|n| n.fitted)).collect()
    }

    /// Lets the last control points of the previous window, the one at `cut` for point `first`, blend into these; `None`
    /// if they do not match or the deviation is too large.
    pub(super) fn blended(
        mut self,
        row: &Row<'_>,
        before: &[Node],
        (cut, first): (usize, usize),
        seam: usize,
    ) -> Option<(Vec<Node>, usize)> {
        let here = self.nodes.iter().position(|n| n.place == (first, 0))?;
        let start = here.checked_sub(BEHIND)?;
        let old = before.get(cut.checked_sub(BEHIND)?..)?;
        let count = (BEHIND + seam).min(old.len());
        let own = self.nodes.get_mut(start..start + count)?;
        let matches = |(a, b): (&Node, &Node)| {
            a.place == b.place && a.is_corner == b.is_corner && a.fitted == b.fitted
        };
        if !own.iter().zip(old).all(|(a, b)| matches((a, b))) {
            return None;
        }
        for (i, (node, old)) in own.iter_mut().zip(old).enumerate() {
            let share = (i.saturating_sub(BEHIND) as f64 / seam as f64).min(1.0);
            let share = share * share * (3.0 - 2.0 * share);
            let between = |old: f64, new: f64| old + share * (new - old);
            node.knot = between(old.knot, node.knot);
            node.point =
                old.point.iter().zip(node.point.iter()).map(|(a, b)| between(*a, *b)).collect();
        }
        for chain in self.chains() {
            let changed = chain.start < start + count && chain.end >= start;
            if changed && !self.certify(row, chain).is_empty() {
                return None;
            }
        }
        Some((self.nodes, here))
    }

    /// Checks the deviation of the spline between two corners and enters it there; returns the points before edges over
    /// which it is too large.
    pub(super) fn certify(&mut self, row: &Row<'_>, chain: Range<usize>) -> Vec<usize> {
        let mut failed = Vec::new();
        let mut ends = [[0.0_f64; 2]; 2];
        let mut from = chain.start;
        while from < chain.end {
            let fitted = self.nodes[from].fitted;
            let legs = self.nodes[from..chain.end].iter().take_while(|n| n.fitted == fitted);
            let to = from + legs.count();
            let own = if fitted {
                self.certify_fit(row, from, to, &mut failed)
            } else {
                let own =
                    self.off_middle(row, from.max(chain.start + 1) - 1, (to + 1).min(chain.end));
                let vertex = self.nodes[from].place.0;
                let left = row.chord(vertex).left();
                let kept = own[0] <= left[0] && own[1] <= left[1];
                failed.extend((!kept).then_some(vertex));
                [own; 2]
            };
            ends[0] = if from == chain.start { own[0] } else { ends[0] };
            ends[1] = own[1];
            from = to;
        }
        for w in self.nodes[chain.start..=chain.end].windows(2) {
            let length = apart(&w[0].point, &w[1].point, &row.groups[0]);
            if !certificate::is_in_order(length, w[1].knot - w[0].knot) {
                failed.push(w[0].place.0);
            }
        }
        for (node, own) in [chain.start, chain.end].into_iter().zip(ends) {
            let vertex = self.nodes[node].place.0;
            let beside = if node == chain.start { vertex } else { vertex - 1 };
            let left = row.chord(beside).left();
            if (0..2).any(|k| own[k] > AT_CORNERS * left[k]) {
                failed.push(beside);
            }
            let off = &mut self.nodes[node].off;
            *off = [off[0].max(own[0]), off[1].max(own[1])];
        }
        failed
    }

    /// Checks a fit between two control points; returns its deviation next to either.
    fn certify_fit(
        &self,
        row: &Row<'_>,
        from: usize,
        to: usize,
        failed: &mut Vec<usize>,
    ) -> [[f64; 2]; 2] {
        let nodes = &self.nodes[from..=to];
        // both ends of a fit are data
        let datum = |node: usize| self.data.partition_point(|d| d.at < self.nodes[node].knot);
        let (first, last) = (datum(from), datum(to));
        let at: Vec<f64> = self.data[first..=last].iter().map(|d| d.at).collect();
        let knots: Vec<f64> = nodes.iter().map(|n| n.knot).collect();
        let mut ends = [[0.0; 2]; 2];
        for (group, axes) in row.groups.iter().enumerate().filter(|(_, axes)| !axes.is_empty()) {
            let own = |axis: &usize| nodes.iter().map(|n| n.point[*axis]).collect();
            let spline = Spline::new(&knots, &axes.iter().map(own).collect::<Vec<Vec<f64>>>());
            let points: Vec<&[f64]> =
                axes.iter().map(|axis| &self.points[*axis][first..=last]).collect();
            let bounds = certificate::bounds(&spline, &at, &points);
            for (datum, bound) in self.data[first..].iter().zip(&bounds) {
                // also fails where the bound is not a number
                let kept = *bound <= row.chord(datum.vertex).left_to_fit()[group];
                failed.extend((!kept).then_some(datum.vertex));
            }
            ends[0][group] = near_corner(&at, &bounds, &spline, axes.len(), false);
            ends[1][group] = near_corner(&at, &bounds, &spline, axes.len(), true);
        }
        ends
    }

    /// How far the control points around a straight middle are from its edge: the spline is between them. Their positions
    /// along the edge differ from the knots, which changes nothing but the speed of the parameter.
    fn off_middle(&self, row: &Row<'_>, from: usize, to: usize) -> [f64; 2] {
        let i = self.nodes[from + 1].place.0;
        let [p, q] = [i, i + 1].map(|k| &row.vertices[k].point);
        let length = row.length(i);
        let mut most = [0.0_f64; 2];
        for node in &self.nodes[from..=to] {
            let feed = row.groups[0].iter();
            let along = feed.map(|k| (node.point[*k] - p[*k]) * (q[*k] - p[*k])).sum::<f64>();
            let share = along / (length * length);
            for (most, axes) in most.iter_mut().zip(row.groups) {
                let off = |k: &usize| node.point[*k] - p[*k] - share * (q[*k] - p[*k]);
                *most = most.max(axes.iter().map(|k| off(k) * off(k)).sum::<f64>().sqrt());
            }
        }
        most
    }
}

/// How far the legs of the control points that a rounded corner adds are from the polygon: the spline over the first
/// half of an interval, and what separates its tangent from it within the first quarter.
fn near_corner(at: &[f64], bounds: &[f64], spline: &Spline, axes: usize, at_end: bool) -> f64 {
    let n = spline.len();
    let (corner, next) = if at_end { (n, n - 1) } else { (0, 1) };
    let (from, to) = (spline.knot(corner), spline.knot(next));
    let half = 0.5 * (from + to);
    let near = |i: &usize| if at_end { at[i + 1] > half } else { at[*i] < half };
    let bound = (0..bounds.len()).filter(near).map(|i| bounds[i]).fold(0.0, f64::max);
    let bend = (0..axes).map(|axis| spline.second(axis, next)).map(|c| c * c).sum::<f64>().sqrt();
    let interval = to - from;
    // F''' e^3 / 6 with e of a quarter of the interval
    bound + bend * interval * interval / 384.0
}

fn mirrored(center: &Node, node: &Node) -> (f64, AxisVec) {
    let knot = 2.0 * center.knot - node.knot;
    let point = center.point.iter().zip(node.point.iter()).map(|(c, p)| 2.0 * c - p).collect();
    (knot, point)
}
