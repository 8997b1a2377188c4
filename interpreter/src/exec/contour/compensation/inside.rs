//! G238: a closed contour with approach and departure at one of its inside corners.
//!
//! The approach depends on the complete contour: its blocks are held until G40.
//!
//! Source: TF5200 programming manual, selecting inside corner of TRC, restrictions of inside corner selection; 90123 (261891211), 90127.

use super::active::{Active, Watched};
use super::corner::{above, inner_corner};
use super::element::{Element, emit_between, moving_side};
use super::ends::line;
use super::failure::{Fallible, too_tight};
use crate::diag::Condition;
use crate::exec::contour::bottleneck::{Cut, Watch};
use crate::exec::contour::item::{Item, vanished};
use crate::exec::contour::motion::Motion;
use crate::exec::fault::Fault;
use crate::exec::geometry::planar::Side;
use crate::exec::geometry::point::{Point, cross, dot, norm, sub};
use crate::syntax::ast::Span;

/// Maximum number of blocks of a contour. Assumption: the vendor prints no number.
const BLOCKS_MAX: usize = 10_000;

/// Largest distance in mm between the ends of a closed contour.
const CLOSED_MM: f64 = 1e-6;

/// A closed contour that is still incomplete.
#[derive(Debug)]
pub(super) struct Closed {
    /// The line of the approach.
    approach: Box<Motion>,
    distance: f64,
    items: Vec<Item>,
}

impl Closed {
    pub(super) fn new(approach: Box<Motion>, distance: f64) -> Self {
        Self { approach, distance, items: Vec::new() }
    }

    /// A motion of the contour; returned if it is the departure.
    pub(super) fn gather(&mut self, motion: Box<Motion>) -> Fallible<Option<Box<Motion>>> {
        if motion.tilt != self.approach.tilt {
            let what = "a change of the coordinate system during tool radius compensation";
            return Err(Fault::unsupported(what, motion.span));
        }
        let span = motion.span;
        // G40 takes effect with the next motion in the plane
        let stays = match motion.compensation {
            Some(c) if c.distance_mm.to_bits() == self.distance.to_bits() => true,
            Some(c) if c.distance_mm.abs().to_bits() != self.distance.abs().to_bits() => {
                let text = "the tool radius changes within the contour of G238";
                return Err(Fault::new(Condition::InsideCornerRadius, text, span));
            }
            Some(_) => {
                let text = "the tool side changes within the contour of G238";
                return Err(Fault::new(Condition::Compensation, text, span));
            }
            None => moving_side(&motion, self.approach.plane)?.is_none(),
        };
        if !stays {
            return Ok(Some(motion));
        }
        self.hold(Item::Motion(motion), span)?;
        Ok(None)
    }

    pub(super) fn hold(&mut self, item: Item, span: Span) -> Fallible<()> {
        if self.items.len() >= BLOCKS_MAX {
            let text = format!("a contour of G238 has more than {BLOCKS_MAX} blocks");
            return Err(Fault::new(Condition::Compensation, text, span));
        }
        self.items.push(item);
        Ok(())
    }

    /// The complete contour: the corner of the departure, and the first bottleneck.
    pub(super) fn close(self, out: &mut Vec<Item>) -> Fallible<(Point, Option<Cut>)> {
        let Self { mut approach, distance, items } = self;
        let plane = approach.plane;
        let at = corner(&approach, distance, &items)?;
        let from = approach.block.path.start();
        let from = [from[plane[0]], from[plane[1]]];
        let tilt = approach.tilt.clone();
        if let Some(path) = line(&approach, plane, from, at) {
            approach.block.path = path;
            out.push(Item::Motion(approach));
        } else {
            vanished(approach.events, out);
        }
        let mut active: Option<Active> = None;
        let (mut before, mut found) = (Vec::new(), None);
        for item in items {
            let motion = match item {
                Item::Motion(motion) => motion,
                rest @ (Item::Rest(_) | Item::Events(_)) => {
                    match &mut active {
                        Some(active) => active.hold(rest, Span::default())?,
                        None => before.push(rest),
                    }
                    continue;
                }
            };
            match (active.take(), moving_side(&motion, plane)?) {
                (Some(last), Some(side)) => {
                    active = Some(last.join(motion, side, out, &mut found)?);
                }
                (Some(mut last), None) => {
                    let span = motion.span;
                    last.hold(Item::Motion(motion), span)?;
                    active = Some(last);
                }
                (None, Some(side)) => {
                    emit_between(std::mem::take(&mut before), at, plane, out);
                    active = Some(Active {
                        distance,
                        perpendicular: false,
                        plane,
                        tilt: tilt.clone(),
                        last: Element::parallel(motion, side, at),
                        between: Vec::new(),
                        watch: Watch::default(),
                    });
                }
                (None, None) => before.push(Item::Motion(motion)),
            }
        }
        if let Some(mut active) = active {
            let mut watched = Watched::new(&mut active, out);
            let Active { last, between, .. } = active;
            last.emit(at, plane, distance, out)?;
            watched.compare(out, &mut found);
            emit_between(between, at, plane, out);
        }
        Ok((at, found))
    }
}

/// The intersection of the parallels of the last and the first element.
fn corner(approach: &Motion, distance: f64, items: &[Item]) -> Fallible<Point> {
    let refused = |text: &str| {
        Fault::new(Condition::Compensation, text, approach.span).in_block(approach.source)
    };
    let mut sides = Vec::new();
    for item in items {
        if let Item::Motion(motion) = item
            && let Some(side) = moving_side(motion, approach.plane)?
        {
            sides.push((side, motion));
        }
    }
    let [(first, _), between @ .., (last, _)] = &sides[..] else {
        return Err(refused("a contour of G238 must have at least two blocks"));
    };
    if !matches!(first, Side::Line { .. }) {
        return Err(refused("the contour of G238 does not begin with a line"));
    }
    let corner = first.start_point();
    if norm(sub(last.end_point(), corner)) > CLOSED_MM {
        return Err(refused("the contour of G238 is not closed"));
    }
    let (u, w) = (last.tangent(true), first.tangent(false));
    let turn = cross(u, w);
    if turn.abs() < 1e-9 && dot(u, w) > 0.0 {
        return Ok(above(corner, w, distance));
    }
    if turn * distance <= 0.0 {
        return Err(refused("the contour of G238 does not begin at an inside corner"));
    }
    let at = inner_corner(last, first, corner, distance)
        .ok_or_else(|| too_tight(Condition::Compensation, approach))?;
    // 261891211: the tool keeps the distance of its radius from every element of the contour
    let apart = |side: &Side| side.distance(at);
    match between.iter().find(|(side, _)| apart(side) < distance.abs() - CLOSED_MM) {
        Some((side, motion)) => {
            let text = format!(
                "the tool of radius {} mm is {:.4} mm away from a block of the contour where it enters it",
                distance.abs(),
                apart(side)
            );
            Err(Fault::new(Condition::InsideCornerTooNear, text, motion.span)
                .in_block(motion.source))
        }
        None => Ok(at),
    }
}
