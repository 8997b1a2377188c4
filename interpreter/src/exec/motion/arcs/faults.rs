//! What is wrong with a programmed arc, and what is made of it.

use crate::diag::{Condition, ValueKind, rounded};
use crate::exec::fault::Fault;
use crate::exec::geometry::arc::{self, Arc, ArcError};
use crate::exec::report::{Report, Subject};
use crate::machine::ArcCentre;
use crate::machine::table::channel as of;
use crate::syntax::ast::Span;
use std::f64::consts::TAU;

/// Difference in mm per turn from which a helix counts as one of another pitch: the resolution of a position.
const PITCH_RESOLUTION_MM: f64 = 1e-4;

/// What a helix makes of a pitch with which it does not arrive at its end point, or whose sign says nothing.
pub(super) fn other_pitch(sweep_rad: f64, height_mm: f64, pitch_mm: f64) -> Option<String> {
    let actual_mm = (height_mm * TAU / sweep_rad).abs();
    if (actual_mm - pitch_mm.abs()).abs() > PITCH_RESOLUTION_MM {
        Some(format!(
            "the helix does not reach its end point with a pitch of {} mm: it is driven with {} mm per turn",
            rounded(pitch_mm.abs()),
            rounded(actual_mm)
        ))
    } else {
        (pitch_mm < 0.0).then(|| {
            "the sign of the pitch has no meaning: G02 and G03 and the end point give the direction of the helix".to_owned()
        })
    }
}

/// K-0109 at the G function of the path where G165 moves a centre that G164 would refuse.
pub(super) fn note_moved_centre(
    arc: &Arc,
    [s, e]: [[f64; 2]; 2],
    centre: [f64; 2],
    limits: &ArcCentre,
    report: &mut Report,
    g: Span,
) {
    if let Err(ArcError::RadiiDiffer { start, end, .. }) = arc::radii_agree(s, e, centre, limits) {
        let text = format!(
            "the radii at start and end differ by {:.6} mm: the centre is moved by {:.6} mm (G165)",
            (start - end).abs(),
            libm::hypot(arc.shift[0], arc.shift[1])
        );
        let fault = Fault::new(Condition::Odd, text, g);
        report.note_once(Subject::G(165), fault.hint("G164 refuses such arcs"));
    }
}

/// The condition for an arc that cannot be constructed.
pub(super) fn arc_fault(error: ArcError, span: Span) -> Box<Fault> {
    match error {
        ArcError::RadiusZero => {
            Fault::new(Condition::ArcRadiusZero, "the radius of the arc is 0", span)
                .hint("check whether I, J or K is missing")
        }
        ArcError::FullCircleWithRadius => {
            let text = "a full circle cannot be programmed with R";
            Fault::new(Condition::FullCircleWithRadius, text, span).hint("use I, J, K")
        }
        ArcError::RadiusTooSmall { radius, half_chord } => {
            let text = format!(
                "radius {} is smaller than half the chord, {half_chord:.6} mm",
                radius.abs()
            );
            Fault::new(Condition::RadiusTooSmall, text, span)
        }
        ArcError::CentreTooFar { shift, limit } => {
            let text = format!(
                "start point, end point and centre do not match: the centre would have to move by {shift:.6} mm, maximum: {limit:.6} mm"
            );
            Fault::new(Condition::ArcCentre, text, span)
                .with(|d| d.parameter(of::CENTRE_SHIFT))
                .hint("check G161 (I, J, K absolute) and G162 (relative to the start point)")
        }
        ArcError::RadiiDiffer { start, end, limit } => {
            let text = format!(
                "the radii at start and end differ by {:.6} mm, maximum: {limit:.6} mm",
                (start - end).abs()
            );
            Fault::new(Condition::ArcRadiiDiffer, text, span).with(|d| {
                d.value(ValueKind::Current, (start - end).abs() * 1e4, "0.1um")
                    .value(ValueKind::Limit, limit * 1e4, "0.1um")
                    .value(ValueKind::StartValue, start * 1e4, "0.1um")
                    .value(ValueKind::TargetValue, end * 1e4, "0.1um")
                    .parameter(of::RADIUS_DIFFERENCE)
            })
        }
    }
}
