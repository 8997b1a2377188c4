//! Set position of a spindle: turning, positioning, following the path.

mod turning;

use crate::exec::{Approach, CuttingSpeed, SpindleMotion};
use crate::machine::SpindleLimits;
use kontur_filters::time::CycleTime;
use kontur_motion::axis::{AxisDynamics, FeedSlope};
use kontur_motion::profile::Profile;
use turning::Turning;

/// Positioning after M19: the profile, its start, and the cycles since.
#[derive(Clone, Debug)]
struct Positioning {
    profile: Profile,
    from_deg: f64,
    /// 1, or -1 for a motion counter-clockwise.
    sense: f64,
    cycles: u64,
    arrived: bool,
}

/// One spindle.
#[derive(Clone, Debug)]
pub(super) struct Spindle {
    slope: FeedSlope,
    /// Weight of the acceleration (G130).
    acc_ratio: f64,
    v_max_deg_s: f64,
    /// Deviation from its speed, relative to it, within which it counts as having reached it (P-AXIS-00217).
    band: f64,
    /// Limits of its tool.
    tool: Option<SpindleLimits>,
    position_deg: f64,
    turning: Turning,
    wanted: SpindleMotion,
    positioning: Option<Positioning>,
    /// Target of a positioning that has just begun.
    target_deg: Option<f64>,
    /// Tapping.
    following: Option<Following>,
    /// G96.
    cutting: Option<CuttingSpeed>,
}

/// A spindle that follows the way of a path axis.
#[derive(Clone, Copy, Debug)]
struct Following {
    axis: usize,
    deg_per_mm: f64,
    from_mm: f64,
    from_deg: f64,
}

impl Spindle {
    pub(super) fn new(dynamics: &AxisDynamics) -> Self {
        Self {
            slope: dynamics.feed,
            acc_ratio: 1.0,
            v_max_deg_s: dynamics.v_max_mm_s,
            band: 0.0,
            tool: None,
            position_deg: 0.0,
            turning: Turning::default(),
            wanted: SpindleMotion::Stop,
            positioning: None,
            target_deg: None,
            following: None,
            cutting: None,
        }
    }

    /// Counts as having reached its speed within this deviation, relative to it.
    pub(super) fn within(self, band: f64) -> Self {
        Self { band, ..self }
    }

    /// Replaces the limits of its list (G112).
    pub(super) fn set_dynamics(&mut self, dynamics: &AxisDynamics) {
        (self.slope, self.v_max_deg_s) = (dynamics.feed, dynamics.v_max_mm_s);
    }

    /// Follows the way of a path axis from the present position on, or comes to rest again.
    pub(super) fn follow(&mut self, way: Option<(usize, f64)>, position: &[f64]) {
        self.following = way.map(|(axis, deg_per_mm)| Following {
            axis,
            deg_per_mm,
            from_mm: position.get(axis).copied().unwrap_or(0.0),
            from_deg: self.position_deg,
        });
        self.wanted = SpindleMotion::Stop;
        self.positioning = None;
        self.turning = Turning::default();
    }

    /// Keeps a cutting speed from now on, or the present speed.
    pub(super) fn keep_cutting_speed(&mut self, cutting: Option<CuttingSpeed>) {
        self.cutting = cutting;
    }

    /// G96: the speed at this position of the path axes.
    pub(super) fn cut(&mut self, position: &[f64]) {
        let Some(cutting) = self.cutting else { return };
        let x_mm = cutting.held_mm.or(position.get(cutting.axis).copied()).unwrap_or(0.0);
        let radius_mm = x_mm - cutting.centre_mm;
        if let SpindleMotion::Clockwise { rpm } | SpindleMotion::CounterClockwise { rpm } =
            &mut self.wanted
        {
            *rpm = cutting.rpm(radius_mm);
        }
    }

    /// The share of a cycle until the spindle, at its commanded speed, passes an angle, if that is before the next
    /// cycle.
    pub(super) fn mark_ahead(&self, deg: f64, cycle: CycleTime) -> Option<f64> {
        let way = self.turning.speed_deg_s() * cycle.seconds();
        if !self.is_as_told() || way.abs() <= 0.0 {
            return None;
        }
        let ahead = ((deg - self.position_deg) * way.signum()).rem_euclid(360.0) / way.abs();
        (ahead < 1.0).then_some(ahead)
    }

    /// Starts a new motion; a turning spindle continues from its present speed.
    pub(super) fn command(&mut self, motion: SpindleMotion) {
        self.wanted = motion;
        if let SpindleMotion::Position { approach: approach @ Approach::Free, .. } =
            &mut self.wanted
        {
            *approach = match self.turning.speed_deg_s() {
                v if v > 0.0 => Approach::Clockwise,
                v if v < 0.0 => Approach::CounterClockwise,
                _ => Approach::Free,
            };
        }
        self.positioning = None;
    }

    /// G130: weights the acceleration of motions and changes of speed that begin from now on.
    pub(super) fn weigh_acceleration(&mut self, ratio: f64) {
        self.acc_ratio = ratio;
    }

    /// Sets the limits of the tool for motions and changes of speed that begin from now on.
    pub(super) fn limit(&mut self, tool: Option<SpindleLimits>) {
        self.tool = tool;
    }

    /// Maximum speed of the spindle or of its tool in deg/s.
    fn most_deg_s(&self) -> f64 {
        self.tool.map_or(self.v_max_deg_s, |tool| self.v_max_deg_s.min(tool.max_deg_s))
    }

    /// Accelerations and ramp times before the weight, such that the weighted acceleration does not exceed that of the
    /// tool.
    fn limited_slope(&self) -> FeedSlope {
        let Some(tool) = self.tool else { return self.slope };
        let most = tool.acc_deg_s2 / self.acc_ratio;
        let FeedSlope { acc_mm_s2, dec_mm_s2, .. } = self.slope;
        FeedSlope { acc_mm_s2: acc_mm_s2.min(most), dec_mm_s2: dec_mm_s2.min(most), ..self.slope }
    }

    /// Whether it follows the way of a path axis (tapping).
    pub(super) fn follows(&self) -> bool {
        self.following.is_some()
    }

    /// Whether it is positioned at a commanded angle.
    pub(super) fn positions(&self) -> bool {
        matches!(self.wanted, SpindleMotion::Position { .. })
    }

    /// Whether the set position is still moving to an angle.
    pub(super) fn approaches(&self) -> bool {
        self.positions() && self.positioning.as_ref().is_none_or(|p| !p.arrived)
    }

    /// Whether it turns at its commanded speed or rests, including at a commanded position.
    pub(super) fn is_as_told(&self) -> bool {
        if self.positions() {
            return !self.approaches();
        }
        let speed = self.turning.speed_deg_s();
        self.turning.is_steady() && speed.to_bits() == self.target_deg_s().to_bits()
    }

    /// Whether its actual speed in deg/s is within the deviation of its list (axis parameters 117211787), it rests, or it is
    /// at a commanded position.
    ///
    /// Assumption: the whole set speed counts as well. An encoder with coarse steps may never show a speed within the
    /// deviation; the actual speed follows by the lag of the position control.
    pub(super) fn has_reached(&self, actual_deg_s: f64) -> bool {
        let target = self.target_deg_s();
        let is_near = (actual_deg_s - target).abs() <= self.band * target.abs();
        self.is_as_told() || (is_near && !self.positions() && target != 0.0)
    }

    /// Whether neither the path nor an angle determines its position.
    pub(super) fn turns_freely(&self) -> bool {
        self.following.is_none() && self.cutting.is_none() && !self.positions()
    }

    /// Whether the set position is at rest.
    pub(super) fn rests(&self) -> bool {
        self.turning.speed_deg_s().abs() <= 0.0 && !self.approaches()
    }

    /// Target of the positioning that began in the last cycle, returned once.
    pub(super) fn take_target(&mut self) -> Option<f64> {
        self.target_deg.take()
    }

    fn target_deg_s(&self) -> f64 {
        let speed = match self.wanted {
            SpindleMotion::Clockwise { rpm } => rpm * 6.0,
            SpindleMotion::CounterClockwise { rpm } => -rpm * 6.0,
            SpindleMotion::Stop | SpindleMotion::Position { .. } => 0.0,
        };
        let most = self.most_deg_s();
        // + 0.0: M4 with the speed 0 is no negative zero
        let speed = speed.clamp(-most, most) + 0.0;
        match self.tool {
            Some(tool) if speed != 0.0 => speed.abs().max(tool.min_deg_s.min(most)).copysign(speed),
            _ => speed,
        }
    }

    /// Set position of the next cycle in deg, counted over all turns; `position`: that of the path axes.
    pub(super) fn step(&mut self, position: &[f64], cycle: CycleTime) -> f64 {
        if let Some(Following { axis, deg_per_mm, from_mm, from_deg }) = self.following {
            let way_mm = position.get(axis).map_or(0.0, |x| x - from_mm);
            let next = from_deg + deg_per_mm * way_mm;
            self.turning = Turning::at((next - self.position_deg) / cycle.seconds());
            self.position_deg = next;
            return next;
        }
        if let SpindleMotion::Position { deg, rpm, approach } = self.wanted
            && (self.positioning.is_some() || self.turning.speed_deg_s().abs() <= 0.0)
        {
            self.approach(deg, rpm, approach, cycle);
            return self.position_deg;
        }
        let target = self.target_deg_s();
        let slope = self.limited_slope();
        let limits = || turning::limits(slope, self.acc_ratio, cycle);
        let most = slope.acc_mm_s2.min(slope.dec_mm_s2) * self.acc_ratio;
        let follows = self.cutting.is_some() && self.turning.is_steady();
        let change = (target - self.turning.speed_deg_s()).abs();
        // Assumption: under G96 a spindle at its speed follows the radius without ramps; the changes of the radius are
        // those of the path
        self.position_deg += if follows && change <= most * cycle.seconds() {
            self.turning.set_speed(target, cycle)
        } else {
            self.turning.step(target, limits, cycle)
        };
        self.position_deg
    }

    /// Appends the set positions of the next cycles of a spindle that [turns freely](Self::turns_freely).
    pub(super) fn turn(&mut self, cycles: usize, cycle: CycleTime, column: &mut Vec<f64>) {
        let end = column.len() + cycles;
        while column.len() < end {
            let deg = self.step(&[], cycle);
            // at rest another step adds 0, which changes nothing but the sign of a zero, once
            let left = if self.is_as_told() && self.rests() { end - column.len() } else { 1 };
            column.extend(std::iter::repeat_n(deg, left));
        }
    }

    /// One cycle of the motion from rest to an angle.
    ///
    /// Source: TF5200 spindle, positioning: in the programmed direction, otherwise in that of the previous rotation,
    /// from rest the shorter way. Assumption: half a turn is clockwise.
    fn approach(&mut self, deg: f64, rpm: Option<f64>, approach: Approach, cycle: CycleTime) {
        if self.positioning.is_none() {
            let clockwise = (deg - self.position_deg).rem_euclid(360.0);
            let back = (self.position_deg - deg).rem_euclid(360.0);
            let (sense, way) = match approach {
                Approach::CounterClockwise => (-1.0, back),
                Approach::Free if back < clockwise => (-1.0, back),
                Approach::Clockwise | Approach::Free => (1.0, clockwise),
            };
            let most = self.most_deg_s();
            let speed = rpm.map_or(most, |rpm| (rpm * 6.0).min(most));
            let limits = turning::limits(self.limited_slope(), self.acc_ratio, cycle);
            let profile = limits.plan(0.0, 0.0, speed, way);
            self.positioning = profile.ok().map(|profile| Positioning {
                profile,
                from_deg: self.position_deg,
                sense,
                cycles: 0,
                arrived: false,
            });
            self.target_deg = Some(self.position_deg + sense * way);
        }
        if let Some(p) = &mut self.positioning {
            p.cycles += 1;
            let time_s = cycle.time_of(p.cycles);
            let state = p.profile.at(time_s);
            p.arrived = time_s >= p.profile.duration();
            self.position_deg = p.from_deg + p.sense * state.s_mm;
            self.turning = Turning::at(if p.arrived { 0.0 } else { p.sense * state.v_mm_s });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Spindle, SpindleMotion};
    use crate::job::MachineLists;
    use kontur_filters::time::CycleTime;

    /// Cycles in a row give the angles of single cycles bit for bit, at rest, on the way to a speed, at it, on a reversal
    /// and until the spindle rests again; also from the angle -0.
    #[test]
    fn cycles_in_a_row_are_single_cycles() {
        let (machine, _) = MachineLists::default().load().unwrap();
        let mut single = Spindle::new(&machine.spindles[0].dynamics());
        single.position_deg = -0.0;
        let mut in_a_row = single.clone();
        let commands = [
            SpindleMotion::Stop,
            SpindleMotion::Clockwise { rpm: 600.0 },
            SpindleMotion::CounterClockwise { rpm: 300.0 },
            SpindleMotion::CounterClockwise { rpm: 0.0 },
            SpindleMotion::Stop,
        ];
        let cycle = CycleTime::DEFAULT;
        let mut seen = Vec::new();
        for command in commands {
            single.command(command);
            in_a_row.command(command);
            for count in [1, 8, 255, 255, 4000] {
                let mut column = Vec::new();
                in_a_row.turn(count, cycle, &mut column);
                let alone = (0..count).map(|_| single.step(&[], cycle).to_bits());
                assert!(column.iter().map(|deg| deg.to_bits()).eq(alone), "{command:?} {count}");
            }
            seen.push(single.rests());
        }
        assert_eq!(seen, [true, false, false, true, true]);
    }
}
