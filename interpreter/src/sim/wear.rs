//! Online tool compensation: the wear of a grinding wheel as additional positions of the axes.
//!
//! Source: TF5200 online tool compensation (213655947, 213664139, 213718539).
//!
//! Assumptions, where the documents are silent: the way counts from `#OTC ON` or the selection of the wheel on, with
//! RADIUS only the way along the contour of G41 or G42; a change of the wear, or of the direction at a corner, is followed with the acceleration
//! limit of the axis (P-AXIS-00008) times ACC_WEIGHT; the offset enters where additional positions do, after the
//! filters.

use crate::exec::{WearSetting, WornPart};
use kontur_motion::axis::AxisVec;
use smallvec::SmallVec;

/// The offset of one axis on its way to its target.
#[derive(Clone, Copy, Debug, Default)]
struct Follower {
    x_mm: f64,
    v_mm_s: f64,
}

impl Follower {
    /// One cycle of `t` s towards a target, with an acceleration of at most `a` mm/s2.
    fn step(&mut self, target_mm: f64, a: f64, t: f64) {
        let way = target_mm - self.x_mm;
        let change = a * t;
        let arrival = way / t;
        if way.abs() <= change * t && (arrival - self.v_mm_s).abs() <= change {
            (self.x_mm, self.v_mm_s) = (target_mm, arrival);
            return;
        }
        // the speed from which braking in whole cycles takes exactly this way
        let speed = (0.25 * change * change + 2.0 * a * way.abs()).sqrt() - 0.5 * change;
        let wanted = speed.copysign(way);
        self.v_mm_s += (wanted - self.v_mm_s).clamp(-change, change);
        self.x_mm += self.v_mm_s * t;
    }
}

/// State of online tool compensation.
#[derive(Clone, Debug, Default)]
pub(super) struct Wear {
    setting: Option<WearSetting>,
    /// ACC_WEIGHT, which stays in effect while the offset returns to 0.
    acceleration_ratio: f64,
    /// Axes of the plane, and whether the tool is to the left of the contour.
    engaged: Option<([usize; 2], bool)>,
    /// Direction of the contour in the plane.
    along: Option<[f64; 2]>,
    /// Wear in mm by the way of this wheel, each part with the constant that was valid on it.
    worn_mm: f64,
    /// External wear.
    outside_mm: f64,
    followers: SmallVec<[Follower; 4]>,
}

impl Wear {
    /// `#OTC ON`, or `None` for OFF.
    pub(super) fn set(&mut self, setting: Option<WearSetting>, axes: usize) {
        let wheel = |setting: Option<WearSetting>| setting.map(|s| s.wheel);
        if wheel(setting) != wheel(self.setting) {
            self.worn_mm = 0.0;
        }
        self.setting = setting;
        self.acceleration_ratio = setting.map_or(self.acceleration_ratio, |s| s.acceleration_ratio);
        self.followers.resize(axes, Follower::default());
    }

    /// Notes that the tool has reached the contour, changed sides, or left it.
    pub(super) fn engage(&mut self, engaged: Option<([usize; 2], bool)>) {
        self.engaged = engaged;
    }

    /// Sets the external wear; true if it exceeds what the tool permits.
    pub(super) fn take_outside(&mut self, wear_mm: f64) -> bool {
        self.outside_mm = wear_mm;
        self.setting.is_some_and(|s| s.from_outside && wear_mm.abs() > s.most_mm)
    }

    /// Whether `#OTC` has never been on.
    pub(super) fn is_unused(&self) -> bool {
        self.followers.is_empty()
    }

    /// Offset of a path axis in mm.
    pub(super) fn offset_mm(&self, axis: usize) -> f64 {
        self.followers.get(axis).map_or(0.0, |f| f.x_mm)
    }

    /// One cycle of `t` s: from `before` to `now` on a way of `ds` mm; `a` is the acceleration limit of an axis.
    pub(super) fn step(
        &mut self,
        (before, now): (&AxisVec, &AxisVec),
        ds: f64,
        a: impl Fn(usize) -> f64,
        t: f64,
    ) {
        if let Some(([x, y], _)) = self.engaged {
            let d = [now[x] - before[x], now[y] - before[y]];
            let length = libm::hypot(d[0], d[1]);
            if length > 0.0 {
                self.along = Some([d[0] / length, d[1] / length]);
            }
        } else {
            self.along = None;
        }
        let mut targets: SmallVec<[f64; 4]> = SmallVec::from_elem(0.0, self.followers.len());
        if let Some(setting) = self.setting {
            if self.engaged.is_some() || setting.part != WornPart::Radius {
                self.worn_mm += setting.ratio * ds;
            }
            let outside = self.outside_mm.clamp(-setting.most_mm, setting.most_mm);
            let wear_mm = self.worn_mm + outside;
            match (setting.part, self.engaged, self.along) {
                (WornPart::Length { axis, sign }, _, _) => targets[axis] = -sign * wear_mm,
                // the wheel approaches the contour, which is on its right if the wheel is to the left of the contour
                (WornPart::Radius, Some(([x, y], left)), Some([u, v])) => {
                    let to_contour = if left { [v, -u] } else { [-v, u] };
                    (targets[x], targets[y]) = (wear_mm * to_contour[0], wear_mm * to_contour[1]);
                }
                (WornPart::Radius, _, _) => {}
            }
        }
        for (i, (follower, target)) in self.followers.iter_mut().zip(targets).enumerate() {
            follower.step(target, a(i) * self.acceleration_ratio, t);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Follower;
    use kontur_kit::Random;

    #[test]
    fn a_follower_arrives_within_its_acceleration_and_stays() {
        let (t, a) = (0.001, 800.0);
        let mut random = Random::new(1);
        for _ in 0..200 {
            let mut f = Follower::default();
            let mut target = 0.0;
            for k in 0..600 {
                if k % 97 == 0 && k < 300 {
                    target = random.between(-0.5, 0.5);
                }
                let before = f;
                f.step(target, a, t);
                assert!((f.v_mm_s - before.v_mm_s).abs() <= a * t * (1.0 + 1e-9));
                assert!((f.x_mm - before.x_mm - f.v_mm_s * t).abs() < 1e-12);
            }
            assert_eq!((f.x_mm.to_bits(), f.v_mm_s.abs().to_bits()), (target.to_bits(), 0));
        }
    }
}
