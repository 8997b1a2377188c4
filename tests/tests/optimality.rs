//! How close whole programs come to the shortest possible time.
//!
//! The bound is computed here from the points of the program alone: time-optimal path following of second order on the same polygon, with
//! the same axis limits and transition speeds but without a jerk limit, by a backward and a forward pass over a fine grid. It shares
//! nothing with the planner. `--nocapture` prints the table of the documentation.

use kontur_interpreter::job::{Job, Options};
use kontur_interpreter::record::CycleRecord;
use kontur_interpreter::source::MemorySources;
use kontur_kit::second_order_time;
use kontur_tests::{programs, sample_machine};

type Point = [f64; 3];

/// `programs/machines/xyz`: all three axes alike. Cycle in s; mm/s; mm/s2 while feeding; weight 1 at kinks.
const CYCLE_S: f64 = 1e-3;
const AXIS_MM_S: f64 = 1000.0;
const AXIS_MM_S2: f64 = 3500.0;

/// Ramp times of that machine, and the shortest ones that still are ramps, in us.
const RAMPS_US: [u32; 2] = [30_000, 1_000];

/// Feed in mm/s and the points of a program of straight blocks that starts in the origin.
fn geometry(program: &str) -> (f64, Vec<Point>) {
    let (mut at, mut feed) = ([0.0; 3], 0.0);
    let mut points = vec![at];
    for line in program.lines() {
        let before = at;
        for word in line.split(';').next().unwrap().split_whitespace() {
            let Some((letter, Ok(number))) = word.split_at_checked(1).map(|(l, n)| (l, n.parse()))
            else {
                continue;
            };
            match letter {
                "X" => at[0] = number,
                "Y" => at[1] = number,
                "Z" => at[2] = number,
                "F" => feed = number / 60.0,
                _ => {}
            }
        }
        if at != before {
            points.push(at);
        }
    }
    (feed, points)
}

/// A straight block.
struct Chord {
    direction: Point,
    length_mm: f64,
}

impl Chord {
    fn all(points: &[Point]) -> Vec<Self> {
        let chord = |w: &[Point]| {
            let d: Point = std::array::from_fn(|i| w[1][i] - w[0][i]);
            let length_mm = d.iter().map(|c| c * c).sum::<f64>().sqrt();
            Self { direction: d.map(|c| c / length_mm), length_mm }
        };
        points.windows(2).map(chord).collect()
    }

    /// A limit of every axis converted to a limit of the path.
    fn along(&self, axis_limit: f64) -> f64 {
        axis_limit / self.direction.iter().fold(0.0, |most: f64, c| most.max(c.abs()))
    }

    /// Largest change of the share of an axis in the path speed at the transition to another block.
    fn turn(&self, other: &Self) -> f64 {
        let change = |i: usize| (other.direction[i] - self.direction[i]).abs();
        (0..3).map(change).fold(0.0, f64::max)
    }
}

/// Minimum time in s without a jerk limit.
fn bound(points: &[Point], feed_mm_s: f64) -> f64 {
    let chords = Chord::all(points);
    // squared speed limits at the grid points; acceleration and step between them
    let (mut squares, mut acc, mut steps) = (vec![0.0], Vec::new(), Vec::new());
    let mut ends = Vec::new();
    for (k, chord) in chords.iter().enumerate() {
        let v = feed_mm_s.min(chord.along(AXIS_MM_S));
        let cells = (chord.length_mm / 0.01).ceil().max(40.0);
        let step = chord.length_mm / cells;
        for _ in 0..cells as usize {
            squares.push(v * v);
            acc.push(chord.along(AXIS_MM_S2));
            steps.push(step);
        }
        // at a kink the axis velocities jump, with an acceleration that lasts one cycle
        let kink = chords.get(k + 1).map_or(0.0, |next| AXIS_MM_S2 * CYCLE_S / chord.turn(next));
        let end = squares.len() - 1;
        ends.push(end);
        squares[end] = squares[end].min(kink * kink);
        if let Some(next) = chords.get(k + 1) {
            squares[end] = squares[end].min(next.along(AXIS_MM_S) * next.along(AXIS_MM_S));
        }
    }
    // several kinks that lie in one cycle count together
    for first in 0..chords.len() {
        let mut between = 0.0;
        for last in first + 2..chords.len() {
            between += chords[last - 1].length_mm;
            if between > feed_mm_s * CYCLE_S {
                break;
            }
            let turn = chords[first].turn(&chords[last]);
            let v = (between / CYCLE_S).max(AXIS_MM_S2 * CYCLE_S / turn);
            for kink in [ends[first], ends[last - 1]] {
                squares[kink] = squares[kink].min(v * v);
            }
        }
    }
    second_order_time(&mut squares, &acc, &steps)
}

/// Time in s from the first to the last motion of the path, on the machine `xyz`.
fn machine_time(program: &str, ramp_us: u32) -> f64 {
    // the lower limits of the ramp times first
    let axis = "X,Y,Z.getriebe[0]";
    let ramps = ["beschl_zu", "beschl_ab", "brems_zu", "brems_ab"];
    let ramps = ramps.map(|ramp| format!("tr_{ramp}={ramp_us}")).join(", ");
    let settings =
        format!("{axis}.dynamik: tr_min=1000, tr_w_min=1000; {axis}.slope_profil: {ramps}");
    let (machine, found) = sample_machine("xyz", &settings);
    assert!(found.is_empty(), "{found:?}");
    let sources = MemorySources::new().with("part.nc", program.as_bytes().to_vec());
    let options = Options { max_time_s: 1000.0, ..Options::default() };
    let mut run = Job::new(machine, sources, "part.nc").with_options(options).start().unwrap();
    let (mut first, mut last, mut s) = (0, 0, 0.0);
    let Ok(()) = run.to_end(&mut |record: &CycleRecord| {
        if record.path.s_mm > s {
            if s == 0.0 {
                first = record.k - 1;
            }
            (last, s) = (record.k, record.path.s_mm);
        }
    });
    let found = run.take_diagnostics();
    assert!(found.is_empty(), "{found:?}");
    let wanted: f64 = Chord::all(&geometry(program).1).iter().map(|c| c.length_mm).sum();
    assert!((s - wanted).abs() < 1e-6 * wanted, "{s} mm of {wanted} mm");
    (last - first) as f64 * CYCLE_S
}

#[test]
fn whole_programs_are_close_to_the_bound() {
    println!("| program | slope | ramps | bound | time | more |\n|---|---|---|---|---|---|");
    let mut missed = Vec::new();
    for name in ["surface_scan", "freeform_pocket", "spiral_face"] {
        let hsc = std::fs::read_to_string(programs().join(format!("{name}.nc"))).unwrap();
        let [trapez, sin2] =
            ["TRAPEZ", "SIN2"].map(|kind| hsc.replace("[TYPE=HSC]", &format!("[TYPE={kind}]")));
        assert!(hsc != trapez && hsc != sin2);
        let (feed, points) = geometry(&hsc);
        let least = bound(&points, feed);
        for (slope, program, ramp_us, allowed) in [
            ("HSC", &hsc, RAMPS_US[0], 0.05),
            ("HSC", &hsc, RAMPS_US[1], 0.02),
            ("TRAPEZ", &trapez, RAMPS_US[0], 0.1),
            ("SIN2", &sin2, RAMPS_US[1], 0.02),
        ] {
            let time = machine_time(program, ramp_us);
            let more = time / least - 1.0;
            let line = format!(
                "| `{name}.nc` | {slope} | {} ms | {least:.3} s | {time:.3} s | {:.2} % |",
                ramp_us / 1000,
                100.0 * more
            );
            println!("{line}");
            // the last cycle of a run is rarely a whole one
            assert!(time >= least - 1e-9, "the bound is one: {line}");
            if time > (1.0 + allowed) * least + CYCLE_S {
                missed.push(line);
            }
        }
    }
    assert!(missed.is_empty(), "{missed:#?}");
}

/// Cost of the jerk limit alone: from rest to the feed and back, a trapezoidal profile takes `L/v + v/a`; ramps of `t` keep the mean
/// speed of both changes and make each of them longer by `t`, half of which is made up by the distance that they cover.
#[test]
fn one_block_takes_one_ramp_time_longer_than_the_bound() {
    let (length, v) = (100.0, 50.0 * 2.0);
    for ramp_us in [30_000, 10_000] {
        let ramp_s = f64::from(ramp_us) * 1e-6;
        let program = "G71 G90\n#SLOPE [TYPE=HSC]\nG01 X100 F6000\nM30\n";
        let least = bound(&geometry(program).1, v);
        // the grid is exact where the acceleration is constant, except for the cells with both
        let closed = length / v + v / AXIS_MM_S2;
        assert!((least - closed).abs() < 1e-3 * closed, "{least} {closed}");
        // v / a = 28.6 ms is less than the ramp of 30 ms: then the peak stays below the limit
        let change = if v / AXIS_MM_S2 < ramp_s {
            2.0 * (v * ramp_s / AXIS_MM_S2).sqrt()
        } else {
            v / AXIS_MM_S2 + ramp_s
        };
        let want = length / v + change;
        let time = machine_time(program, ramp_us);
        assert!(time >= want - 1e-9 && time < want + CYCLE_S + 1e-9, "{time} s, {want} s expected");
    }
}
