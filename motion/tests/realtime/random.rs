//! Random programs under random events.

use super::*;

pub(super) struct Case {
    pub(super) job: Job,
    pub(super) points: Vec<[f64; 2]>,
    pub(super) feeds: Vec<Option<f64>>,
    pub(super) events: Vec<(u64, Event)>,
    /// G901.
    pub(super) late: bool,
}

impl Case {
    pub(super) fn new(r: &mut Random) -> Self {
        let kind = r.pick(&[Step, Trapez, Trapez, Sin2, Hsc]);
        let mut axes = vec![axis(r.pick(&[0.0, 0.3, 1.0])); 2];
        for a in &mut axes {
            a.v_max_mm_s = 60.0 + 200.0 * r.ratio();
            a.v_rapid_mm_s = a.v_max_mm_s;
            let acc = 500.0 + 1500.0 * r.ratio();
            a.feed.acc_mm_s2 = acc;
            a.feed.dec_mm_s2 = acc * (0.5 + r.ratio());
            a.feed.ramps_s = [0; 4].map(|_| 0.01 + 0.08 * r.ratio());
            a.rapid.acc_mm_s2 = 2000.0;
            a.a_max_mm_s2 = 4000.0;
        }
        let job = Job {
            dynamics: channel(axes),
            cycle_us: r.pick(&[500, 1000, 2000]),
            window: r.pick(&[3, 10, 120]),
            ..Job::new(0.0, kind)
        };
        let scale = r.pick(&[0.05, 0.5, 5.0, 30.0]);
        let bend = r.pick(&[0.02, 0.3, 3.0]);
        let mut points = vec![[0.0; 2]];
        let mut heading = 6.3 * r.ratio();
        for i in 0..(3 + (r.ratio() * if scale < 1.0 { 150.0 } else { 15.0 }) as usize) {
            heading += bend * (r.ratio() - 0.5);
            let length = scale * (0.1 + r.ratio());
            let p = points[i];
            points.push([p[0] + length * libm::cos(heading), p[1] + length * libm::sin(heading)]);
        }
        let feed = 5.0 + 150.0 * r.ratio();
        let varied = r.ratio() < 0.4;
        let feeds = (1..points.len())
            .map(|_| match r.ratio() {
                x if varied && x < 0.1 => None,
                x if varied && x < 0.4 => Some(feed * (0.1 + r.ratio())),
                _ => Some(feed),
            })
            .collect();
        let mut events = Vec::new();
        let mut k = 0;
        for _ in 0..(r.ratio() * 12.0) as usize {
            k += (libm::exp(r.ratio() * 7.0)) as u64;
            let event = match r.ratio() {
                x if x < 0.3 => Event::Hold(r.pick(&[Active, Own])),
                x if x < 0.5 => Event::Release,
                x if x < 0.55 => Event::Override(0.0),
                x if x < 0.65 => Event::Rapid(2.0 * r.ratio(), 2.0 * r.ratio()),
                x if x < 0.8 => Event::Override(r.pick(&[0.3, 0.5, 1.0, 1.5])),
                _ => Event::Override(2.0 * r.ratio()),
            };
            events.push((k, event));
        }
        events.push((k + 500, Event::Override(0.7 + r.ratio())));
        events.push((k + 500, Event::Release));
        Self { job, points, feeds, events, late: false }
    }

    pub(super) fn run(&self) -> Result<Vec<Setpoint>, Infeasible> {
        let block = |(i, w): (usize, &[[f64; 2]])| {
            let mut b = self.job.line(i as u64, &w[0], &w[1], self.feeds[i].unwrap_or(1.0));
            if self.feeds[i].is_none() {
                b.feed = Feed::Rapid;
            }
            b.late_braking = self.late;
            b
        };
        let blocks = self.points.windows(2).enumerate().map(block).collect();
        drive(&self.job, &self.points[0], blocks, &self.events)
    }

    pub(super) fn check(&self, out: &[Setpoint]) -> Result<(), String> {
        let t = f64::from(self.job.cycle_us) * 1e-6;
        let kind: SlopeKind = self.job.slope.kind;
        let end = out.last().unwrap();
        let target = self.points.last().unwrap();
        if end.position[..] != target[..] || end.v_mm_s != 0.0 || end.a_mm_s2 != 0.0 {
            return Err(format!("ends at {:?}, not {target:?}", end.position));
        }
        let axes = &self.job.dynamics.axes;
        // highest path acceleration and jerk of any direction and block
        let (mut a_most, mut j_most): (f64, f64) = (0.0, 0.0);
        let limits = |seq: u64, i: usize| -> (f64, f64) {
            let x = &axes[i];
            let own = Event::Hold(Own);
            let feedhold = self.events.iter().any(|e| e.1 == own);
            let (mut a, mut j) = if kind == Step {
                let s = if self.feeds[seq as usize].is_some() { x.step_feed } else { x.step_rapid };
                (s.acc_mm_s2[0].max(s.dec_mm_s2[0]), f64::INFINITY)
            } else if self.feeds[seq as usize].is_some() {
                let f = x.feed;
                let longest = f.ramps_s.iter().copied().fold(0.0, f64::max);
                let j = |k: usize| {
                    let acc = if k < 2 { f.acc_mm_s2 } else { f.dec_mm_s2 };
                    acc / if kind == Hsc { longest } else { f.ramps_s[k] }
                };
                (f.acc_mm_s2.max(f.dec_mm_s2), (0..4).map(j).fold(0.0, f64::max))
            } else {
                (x.rapid.acc_mm_s2, x.rapid.acc_mm_s2 / x.rapid.ramp_s)
            };
            if feedhold {
                let h = x.feedhold;
                a = a.max(if kind == Step { h.step_dec_mm_s2 } else { h.dec_mm_s2 });
                j = j.max(h.dec_mm_s2 / h.ramp_s);
            }
            (a, if kind == Sin2 { j * std::f64::consts::FRAC_PI_2 } else { j })
        };
        for seq in 0..self.feeds.len() as u64 {
            for i in 0..2 {
                let (a, j) = limits(seq, i);
                a_most = a_most.max(a * 2.0_f64.sqrt());
                j_most = j_most.max(j * 2.0_f64.sqrt());
            }
        }
        let slack = 1.0 + 1e-6;
        for (k, p) in out.iter().enumerate() {
            if p.v_mm_s < 0.0 {
                return Err(format!("{k}: v {}", p.v_mm_s));
            }
            let off = deviation(&p.position, &self.points);
            if off > 1e-9 {
                return Err(format!("{k}: {off} off the contour"));
            }
            let (from, to) = (self.points[p.seq as usize], self.points[p.seq as usize + 1]);
            let length = libm::hypot(to[0] - from[0], to[1] - from[1]);
            for i in 0..2 {
                let u = ((to[i] - from[i]) / length).abs();
                let (a, j) = limits(p.seq, i);
                if p.v_mm_s * u > axes[i].v_max_mm_s * slack {
                    return Err(format!("{k}: axis {i} velocity {}", p.v_mm_s * u));
                }
                // at the very beginning of a STEP slope the previous block counts
                if p.a_mm_s2.abs() * u > a * slack {
                    return Err(format!("{k}: axis {i} acceleration {} of {a}", p.a_mm_s2 * u));
                }
                if p.j_mm_s3.abs() * u > j * slack {
                    return Err(format!("{k}: axis {i} jerk {} of {j}", p.j_mm_s3 * u));
                }
            }
            let Some(q) = k.checked_sub(1).map(|k| &out[k]) else { continue };
            let ds = p.s_mm - q.s_mm;
            if ds < 0.0
                || (ds - 0.5 * (p.v_mm_s + q.v_mm_s) * t).abs() > 0.25 * a_most * t * t * slack
            {
                return Err(format!("{k}: step of {ds} at {}", p.v_mm_s));
            }
            if (p.v_mm_s - q.v_mm_s).abs() > a_most * t * slack {
                return Err(format!("{k}: velocity jumps from {} to {}", q.v_mm_s, p.v_mm_s));
            }
            if kind != Step && (p.a_mm_s2 - q.a_mm_s2).abs() > j_most * t * slack {
                return Err(format!("{k}: acceleration jumps from {} to {}", q.a_mm_s2, p.a_mm_s2));
            }
        }
        // the jump of an axis at a kink in one cycle, and the acceleration on both sides of it
        for (k, w) in out.windows(3).enumerate() {
            for i in 0..2 {
                let second =
                    (w[2].position[i] - 2.0 * w[1].position[i] + w[0].position[i]) / (t * t);
                let own = |s: &Setpoint| limits(s.seq, i).0;
                let most = own(&w[0]).max(own(&w[1])).max(own(&w[2]));
                if second.abs() > 2.0 * most * slack {
                    return Err(format!("{k}: axis {i} second difference {second} of {most}"));
                }
            }
        }
        // feedhold and override 0 come to rest and stay
        let mut held: Option<u64> = None;
        let stopped_by = |k: u64, until: u64| {
            let longest = 1.5; // s, from 260 mm/s at 250 mm/s2 with ramps of 90 ms
            let rest = k + (longest / t) as u64;
            out.iter().filter(|p| p.k > rest && p.k <= until).all(|p| p.v_mm_s == 0.0)
        };
        for (k, event) in &self.events {
            match event {
                Event::Hold(_) => held = held.or(Some(*k)),
                Event::Release => {
                    if let Some(from) = held.take()
                        && !stopped_by(from, *k)
                    {
                        return Err(format!("feedhold of {from} moves at {k}"));
                    }
                }
                _ => {}
            }
        }
        Ok(())
    }
}

#[test]
fn random_programs_with_random_events() {
    let (count, seed) = (environment("COUNT", 150), environment("SEED", 0));
    let mut failed = 0;
    for case in seed..seed + count {
        let mut c = Case::new(&mut Random::from_state(case * 7919 + 1));
        c.late = case % 2 == 1;
        if let Err(why) = c.run().map_err(|e| e.to_string()).and_then(|out| c.check(&out)) {
            failed += 1;
            println!(
                "case {case}, G901 {}: {why}; {:?} window {} {} us, events {:?}, feeds {:?}, {} points",
                c.late,
                c.job.slope.kind,
                c.job.window,
                c.job.cycle_us,
                c.events,
                &c.feeds[..c.feeds.len().min(5)],
                c.points.len()
            );
        }
    }
    assert_eq!(failed, 0);
}
