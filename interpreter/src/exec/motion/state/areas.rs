//! Control areas: the defined ones, an incomplete definition, and those that motions are checked against.
//!
//! Source: TF5200 workspace monitoring (291148299); 120484.

use crate::exec::contour::Guarded;
use crate::exec::geometry::area::{Area, Purpose};
use crate::syntax::ast::Span;
use kontur_motion::axis::AxisVec;
use std::collections::BTreeMap;
use std::sync::Arc;

/// Areas of the program.
#[derive(Debug, Default)]
pub(in crate::exec) struct Areas {
    pub(in crate::exec::motion) defined: BTreeMap<u32, Arc<Area>>,
    /// In order of activation.
    pub(in crate::exec::motion) active: Vec<Arc<Area>>,
    pub(in crate::exec::motion) draft: Option<Box<Draft>>,
    /// State shared by consecutive motions.
    pub(in crate::exec::motion) watch: Option<Arc<Guarded>>,
}

/// Parameters at the start of a definition.
#[derive(Clone, Copy, Debug)]
pub(in crate::exec) struct Heading {
    pub(in crate::exec) number: u32,
    pub(in crate::exec) purpose: Purpose,
    /// CIRC instead of POLY.
    pub(in crate::exec) circle: bool,
    pub(in crate::exec) low_mm: f64,
    pub(in crate::exec) high_mm: f64,
    /// EXCUR_AX, EXCUR_AXNR.
    pub(in crate::exec) height_axis: Option<usize>,
    pub(in crate::exec) span: Span,
}

/// An incomplete definition.
#[derive(Debug)]
pub(in crate::exec::motion) struct Draft {
    pub(in crate::exec::motion) heading: Heading,
    /// Programmed axis positions within the definition.
    pub(in crate::exec::motion) before: AxisVec,
    /// Axes that the blocks name.
    pub(in crate::exec::motion) named: Vec<usize>,
    pub(in crate::exec::motion) points: Vec<AxisVec>,
    /// Plane, centre and radius of the full circle.
    pub(in crate::exec::motion) circle: Option<([usize; 2], [f64; 2], f64)>,
}

impl Areas {
    /// Whether there is neither a definition nor an active area, so that motions need no treatment.
    pub(in crate::exec) fn are_idle(&self) -> bool {
        self.draft.is_none() && self.active.is_empty()
    }

    /// A block between BEGIN and END.
    pub(in crate::exec) fn is_defining(&self) -> bool {
        self.draft.is_some()
    }

    /// A definition that the program has not completed.
    pub(in crate::exec) fn open(&self) -> Option<Span> {
        self.draft.as_ref().map(|draft| draft.heading.span)
    }

    pub(in crate::exec::motion) fn is_active(&self, number: u32) -> bool {
        self.active.iter().any(|area| area.number == number)
    }
}
