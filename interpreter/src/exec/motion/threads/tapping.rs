//! Tapping: G63, G331 and G332, whose spindle turns in step with the path.

use crate::diag::Condition;
use crate::exec::block::choice::PathMode;
use crate::exec::decoder::Decoder;
use crate::exec::fault::{Fault, Outcome};
use crate::exec::motion::spindles::Turning;
use crate::exec::motion::state::MotionState;
use crate::exec::output::output;
use crate::exec::report::Subject;
use crate::exec::shaping::ShapingState;
use crate::exec::step::{Event, SpindleState, Sync};
use crate::machine::{Axis, Machine};
use crate::syntax::ast::Span;
use kontur_filters::kernel::Kernel;
use kontur_motion::block::Feed;
use kontur_motion::path::Path;
use std::sync::Arc;

/// Highest speed in rev/min.
const SPEED_MAX: f64 = 1e6;

impl MotionState {
    /// The delays in ms by the filters of an axis and of the main spindle; the axis is the one that travels
    /// farthest of those whose filters are not those of the spindle.
    fn shaped_apart(
        &self,
        path: &Path,
        machine: &Machine,
        shaping: &ShapingState,
    ) -> Option<(usize, [f64; 2])> {
        let spindle = self.spindles[0].index?;
        let (cycle, turning) = (machine.cycle, &machine.spindles[spindle]);
        let of_spindle = shaping.setup.spindles.get(spindle)?.kernel.as_deref();
        let ms = |kernel: Option<&Kernel>, axis: &Axis| {
            let cycles = kernel.map_or(0.0, Kernel::delay_cycles);
            (cycles + axis.standard_filter_delay_cycles(cycle)) * f64::from(cycle.us()) / 1e3
        };
        let apart = moving(path).filter_map(|i| {
            let kernel = shaping.setup.axes[i].kernel.as_deref();
            let delays_ms = [ms(kernel, &machine.axes[i]), ms(of_spindle, turning)];
            let apart = kernel != of_spindle || (delays_ms[0] - delays_ms[1]).abs() > 1e-6;
            apart.then_some((i, delays_ms))
        });
        let way = |i: usize| (path.end()[i] - path.start()[i]).abs();
        apart.max_by(|(a, _), (b, _)| way(*a).total_cmp(&way(*b)))
    }

    /// Differences that keep an axis and its spindle from being at the same point of the thread: filters, following error.
    fn apart_from_spindle(
        &self,
        path: &Path,
        feed_mm_s: f64,
        rpm: f64,
        machine: &Machine,
        shaping: &ShapingState,
    ) -> Option<String> {
        let main = &self.spindles[0];
        let turning = &machine.spindles[main.index?];
        let other = turning.name();
        if let Some((i, [own, of_other])) = self.shaped_apart(path, machine, shaping) {
            let name = machine.axes[i].name();
            return Some(format!(
                "tapping while {name} is shaped with a delay of {own:.3} ms, spindle {other} with {of_other:.3} ms: they are not synchronous in the thread"
            ));
        }
        let spindle_lag_s = turning.lag_s(6.0 * rpm, main.feedforward, main.weight_ratio);
        let feedforward = &self.feedforward;
        moving(path).find_map(|i| {
            let axis = &machine.axes[i];
            let speed_mm_s = feed_mm_s * (path.end()[i] - path.start()[i]) / path.length();
            let lag_s = axis.lag_s(speed_mm_s, feedforward.on, feedforward.weight_ratios[i]);
            ((lag_s - spindle_lag_s).abs() > 1e-6).then(|| {
                format!(
                    "tapping while {} lags its set position by {:.3} ms, spindle {other} by {:.3} ms (gain kv, feedforward): they are not synchronous in the thread",
                    axis.name(),
                    1e3 * lag_s,
                    1e3 * spindle_lag_s
                )
            })
        })
    }

    /// Delays by which a thread of G33 begins at another angle than the programmed one.
    pub(super) fn begins_elsewhere(
        &self,
        path: &Path,
        rpm: f64,
        machine: &Machine,
        shaping: &ShapingState,
    ) -> Option<String> {
        let (i, [own, of_other]) = self.shaped_apart(path, machine, shaping)?;
        let deg = 6e-3 * (own - of_other) * rpm.abs();
        (deg.abs() > 1e-6).then(|| {
            format!(
                "{} is shaped with a delay of {own:.3} ms, spindle {} with {of_other:.3} ms: the thread begins {deg:.1} deg after its start angle; other passes need the same filters and speed",
                machine.axes[i].name(),
                machine.spindles[self.spindles[0].index.unwrap_or(0)].name()
            )
        })
    }
}

/// The axes that a path moves.
fn moving(path: &Path) -> impl Iterator<Item = usize> + '_ {
    let ends = path.start().iter().zip(path.end().iter());
    ends.enumerate().filter(|(_, (from, to))| (*to - *from).abs() > 0.0).map(|(i, _)| i)
}

impl Decoder {
    pub(super) fn tap(&mut self, path: Path, full_override: bool, span: Span) -> Outcome<()> {
        let rpm = self.motion.threads.tapping_rpm.unwrap_or(self.motion.spindles[0].rpm);
        if rpm.abs() > SPEED_MAX {
            let text = format!("spindle speed {rpm} is outside 0 to {SPEED_MAX} rev/min");
            return Err(Fault::new(Condition::Range, text, span));
        }
        if rpm.abs() <= 0.0 {
            let text = "tapping with the spindle speed 0";
            return Err(Fault::new(Condition::SpindleSpeedZero, text, span));
        }
        let (coupling, feed_mm_s) = self.tapping(&path, rpm, span)?;
        let Some(spindle) = self.motion.spindles[0].index else { return Ok(()) };
        // the spindle must follow and so limits the path
        let limits = self.machine.spindles[spindle].dynamics();
        let mut dynamics = (*self.motion.dynamics(&self.machine, &self.modal, false)).clone();
        let ratio = self.motion.spindles[0].acceleration_ratio / coupling.deg_per_path_mm;
        let least = |a: Option<f64>, b: f64| Some(a.map_or(b, |a| a.min(b)));
        let slope = &limits.feed;
        let vector = &mut dynamics.vector;
        vector.vel_mm_s = least(vector.vel_mm_s, limits.v_max_mm_s / coupling.deg_per_path_mm);
        vector.acc_mm_s2 = least(vector.acc_mm_s2, slope.acc_mm_s2 * ratio);
        vector.dec_mm_s2 = least(vector.dec_mm_s2, slope.dec_mm_s2 * ratio);
        let block = self.thread_block(path, feed_mm_s, Arc::new(dynamics), full_override);
        let plane = self.geometry.in_plane(&self.modal, &self.motion, span)?;
        if self.report.failed() && !self.checking {
            return Ok(());
        }
        if let Some(text) = self.motion.apart_from_spindle(
            &block.path,
            feed_mm_s,
            rpm,
            &self.machine,
            &self.shaping,
        ) {
            self.report.note_once(Subject::Only, Fault::new(Condition::UnequalKernels, text, span));
        }
        // the tool is not driven into its thread in a curve
        self.contour.continue_along(&block.path);
        if self.contour.loses_corner(&Sync::Halt) {
            self.sync(Sync::Halt);
        }
        self.sync(Sync::Spindle { spindle, state: SpindleState::Rest });
        let Coupling { axis, deg_per_mm, .. } = coupling;
        self.contour.event(Event::SpindleFollows { spindle, way: Some((axis, deg_per_mm)) });
        self.send(block, plane, None, span);
        self.contour.event(Event::SpindleFollows { spindle, way: None });
        self.motion.spindles[0].turning = Turning::Stopped;
        self.motion.spindles[0].runs = false;
        self.sync(Sync::Stop);
        Ok(())
    }

    /// The coupling of the spindle to the path, and the path velocity.
    fn tapping(&mut self, path: &Path, rpm: f64, span: Span) -> Outcome<(Coupling, f64)> {
        let way = |axis: usize| path.end()[axis] - path.start()[axis];
        let longest =
            (0..path.start().len()).max_by(|a, b| way(*a).abs().total_cmp(&way(*b).abs()));
        let longest = longest.unwrap_or(0);
        let (deg_per_path_mm, sense, feed_mm_s) = if self.modal.path == PathMode::Tapping {
            let Feed::PathVelocity(feed_mm_s) = self.motion.feed_of(
                path,
                &self.geometry.coordinates,
                &self.modal,
                output!(self),
                span,
            )?
            else {
                return Err(Fault::unsupported("tapping without G94", span));
            };
            (rpm.abs() * 6.0 / feed_mm_s, rpm.signum(), feed_mm_s)
        } else {
            let (axis, pitch_mm) =
                self.motion.threads.pitch(&self.geometry.coordinates, &self.names, path, span)?;
            let per_path_mm = 360.0 * way(axis).abs() / (pitch_mm.abs() * path.length());
            let back = if self.modal.path == PathMode::TapBack { -1.0 } else { 1.0 };
            (per_path_mm, pitch_mm.signum() * back, rpm.abs() * 6.0 / per_path_mm)
        };
        let deg_per_mm = sense * deg_per_path_mm * path.length() / way(longest);
        Ok((Coupling { axis: longest, deg_per_mm, deg_per_path_mm }, feed_mm_s))
    }
}

/// Coupling of the spindle to a straight path.
struct Coupling {
    /// The longest main axis, along which the distance is measured.
    axis: usize,
    /// Degrees per mm along this axis, signed by the sense of rotation.
    deg_per_mm: f64,
    /// Degrees per mm of path, unsigned.
    deg_per_path_mm: f64,
}
