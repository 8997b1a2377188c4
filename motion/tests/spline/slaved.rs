//! Kinks and steps of an axis outside the feed group, where the main axes run straight.

use super::*;

const CHORD_MM: f64 = 0.02;

fn machine(kind: kontur_motion::block::SlopeKind) -> Job {
    let mut dynamics = (*channel(vec![axis(1.0); 3])).clone();
    dynamics.feed_axes = vec![true, true, false];
    Job { dynamics: Arc::new(dynamics), window: 400, ..Job::new(1.0, kind) }
}

fn points(angles_deg: impl Iterator<Item = f64>) -> Vec<Vec<f64>> {
    angles_deg.enumerate().map(|(k, c)| vec![CHORD_MM * k as f64, 0.0, c]).collect()
}

/// A step within one block and a change of speed, each between a hundred blocks at constant speed. To follow a step within
/// 0.003 deg took 1.5 times as long as the polygon. Rounded within a `TRACK_DEV` that is large compared with it, both take
/// less, and not more with a larger one; with a small one a step takes at most a twentieth more.
#[test]
fn a_kink_is_rounded() {
    for kind in [Trapez, Hsc] {
        let job = machine(kind);
        for size in [0.1, 0.5, 2.0] {
            let step = points((0..=200).map(|k| if k > 100 { size } else { 0.0 }));
            let turn = points((0..=200).map(|k| 0.05 * size * f64::from((k - 100).max(0))));
            for points in [step, turn] {
                let sharp = job.drive(&points, &[50.0]).len();
                let mut last = usize::MAX;
                for track_dev_deg in [0.5, 2.0, 5.0, 20.0] {
                    let settings = SplineSettings { track_dev_deg, ..SplineSettings::default() };
                    let blocks = splined(&job, settings, &points, 50.0);
                    let round = job.run(&points[0], blocks.into_iter()).len();
                    println!("{kind:?} {size} {track_dev_deg}: {round} of {sharp}");
                    let what = format!("{kind:?} {size} {track_dev_deg}: {round} {last} {sharp}");
                    assert!(round <= sharp + sharp / 20, "{what}");
                    assert!(track_dev_deg < 10.0 * size || round < sharp, "{what}");
                    assert!(round <= last.saturating_add(last / 50), "{what}");
                    last = round;
                }
            }
        }
    }
}

/// Random kinks and steps: the axis stays within `TRACK_DEV` at every place, the main axis on its line.
#[test]
fn the_tolerance_is_kept_at_kinks() {
    let job = machine(Hsc);
    for seed in 0..20 {
        let mut random = Random::from_state(seed);
        let (mut c, mut speed) = (0.0, 0.0);
        let points = points((0..600).map(|_| {
            speed = if random.chance(0.03) { random.between(-0.3, 0.3) } else { speed };
            c += speed + if random.chance(0.01) { random.between(-3.0, 3.0) } else { 0.0 };
            libm::round(1000.0 * c) / 1000.0
        }));
        for track_dev_deg in [0.02, 0.1, 0.5, 5.0] {
            let settings = SplineSettings { track_dev_deg, ..SplineSettings::default() };
            for b in splined(&job, settings, &points, 50.0) {
                for k in 0..=8 {
                    let q = at(&b.path, b.path.length() * f64::from(k) / 8.0);
                    let i = ((q[0] / CHORD_MM).floor() as usize).min(points.len() - 2);
                    let share = q[0] / CHORD_MM - i as f64;
                    let want = points[i][2] + share * (points[i + 1][2] - points[i][2]);
                    let off = (q[2] - want).abs();
                    assert!(off <= track_dev_deg + 1e-9, "{seed} {track_dev_deg}: {off}");
                    assert!(q[1].abs() < 1e-12);
                }
            }
        }
    }
}

/// Angle of the slaved axis at the point of the polygon that is nearest to a point of the main axes.
fn angle_at(points: &[Vec<f64>], q: &[f64]) -> f64 {
    let nearest = points.windows(2).map(|w| {
        let (p, d) = (&w[0], [w[1][0] - w[0][0], w[1][1] - w[0][1]]);
        let along = (q[0] - p[0]) * d[0] + (q[1] - p[1]) * d[1];
        let share = (along / (d[0] * d[0] + d[1] * d[1])).clamp(0.0, 1.0);
        let off = [p[0] + share * d[0] - q[0], p[1] + share * d[1] - q[1]];
        (off[0] * off[0] + off[1] * off[1], p[2] + share * (w[1][2] - p[2]))
    });
    nearest.min_by(|a, b| a.0.total_cmp(&b.0)).map_or(f64::NAN, |best| best.1)
}

/// On arcs in chords of unequal length, where the main axes are fitted as well: a shift along the path adds to the deviation of
/// the slaved axis.
#[test]
fn the_tolerance_is_kept_at_kinks_on_arcs() {
    let job = machine(Hsc);
    let mut worst = 0.0_f64;
    for seed in 0..60 {
        let mut random = Random::from_state(seed);
        let base = [0.01, 0.02, 0.05, 0.1][seed as usize % 4];
        let (mut heading, mut p, mut speed) = (0.0, [0.0, 0.0, 0.0], 0.0);
        let mut points = vec![p.to_vec()];
        for _ in 0..100 {
            let chord = base * random.between(0.4, 1.6);
            heading += 0.5 * chord;
            let (sin, cos) = libm::sincos(heading);
            speed = if random.chance(0.06) { random.between(-20.0, 20.0) } else { speed };
            let step = if random.chance(0.04) { random.between(-3.0, 3.0) } else { 0.0 };
            p = [p[0] + chord * cos, p[1] + chord * sin, p[2] + speed * chord + step];
            points.push(p.iter().map(|x| libm::round(1e4 * x) / 1e4).collect());
        }
        for track_dev_deg in [0.05, 0.3, 2.0] {
            let settings = SplineSettings { track_dev_deg, ..SplineSettings::default() };
            for b in splined(&job, settings, &points, 50.0) {
                for k in 0..=8 {
                    let q = at(&b.path, b.path.length() * f64::from(k) / 8.0);
                    let off = (q[2] - angle_at(&points, &q)).abs();
                    worst = worst.max(off / track_dev_deg);
                }
            }
        }
    }
    println!("at most {worst} times TRACK_DEV");
    // at a corner the nearest point is not quite the one of the same parameter
    assert!(worst <= 1.004, "{worst}");
}
