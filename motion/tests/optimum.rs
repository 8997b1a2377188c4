//! Machine time compared with the jerk-limited optimum under the same limits.
//!
//! `data/optimum.csv` is made by `reference/table.py`, by convex programming; it shares no code with the planner.

use crate::common::{Job, axis, channel, even};
use kontur_motion::axis::AxisDynamics;
use kontur_motion::block::SlopeKind::{self, Hsc, Trapez};

/// Cycle of the table in us: short enough that rounding of the time to cycles, and kinks within one cycle, do not
/// matter.
pub(crate) const CYCLE_US: u32 = 100;
/// Kinks may use the velocity jump of 1 ms of acceleration.
const KINK_WEIGHT: f64 = 10.0;

struct Row {
    name: String,
    axes: Vec<AxisDynamics>,
    feeds: Vec<f64>,
    points: Vec<Vec<f64>>,
    least_s: f64,
}

/// The machines of the tables, with a weight of kinks.
pub(crate) fn machine(name: &str, kink_weight: f64) -> Vec<AxisDynamics> {
    let of = |acc: f64, ramp: f64, v_max_mm_s: f64| AxisDynamics {
        v_max_mm_s,
        feed: even(acc, ramp),
        ..axis(kink_weight)
    };
    match name {
        "even" => vec![of(1000.0, 0.05, 1000.0); 3],
        _ => vec![of(4000.0, 0.02, 1000.0), of(3000.0, 0.03, 1000.0), of(800.0, 0.08, 300.0)],
    }
}

pub(crate) fn numbers(text: &str) -> Vec<f64> {
    text.split(' ').map(|n| n.parse().unwrap()).collect()
}

fn table() -> Vec<Row> {
    let text = include_str!("data/optimum.csv");
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let rows = reader.records().map(|record| {
        let record = record.unwrap();
        Row {
            name: format!("{} {}", &record[0], &record[1]),
            axes: machine(&record[1], KINK_WEIGHT),
            feeds: numbers(&record[2]),
            points: record[3].split(';').map(numbers).collect(),
            least_s: record[4].parse().unwrap(),
        }
    });
    rows.collect()
}

/// Machine time over the least one.
fn ratio(row: &Row, kind: SlopeKind) -> f64 {
    let job = Job {
        dynamics: channel(row.axes.clone()),
        cycle_us: CYCLE_US,
        ..Job::new(KINK_WEIGHT, kind)
    };
    let out = job.drive(&row.points, &row.feeds);
    (out.len() - 1) as f64 * f64::from(CYCLE_US) * 1e-6 / row.least_s
}

/// Median and largest ratio of the random contours, largest of the surfaces, spirals and circles.
#[test]
fn machine_time_is_close_to_the_optimum() {
    let rows = table();
    // TRAPEZ arrives at every limiting kink with zero acceleration, the optimum does not
    for (kind, most_random) in [(Hsc, 1.05), (Trapez, 1.06)] {
        let (mut random, mut regular) = (Vec::new(), 0.0_f64);
        for row in &rows {
            let ratio = ratio(row, kind);
            // the table is exact to 0.2 % of a short move
            assert!(ratio > 0.997, "{} {kind:?}: {ratio} of the optimum", row.name);
            println!("{kind:?} {ratio:.4} {}", row.name);
            if row.name.contains(" F") {
                assert!(ratio <= 1.02, "{} {kind:?}: {ratio} times the optimum", row.name);
                regular = regular.max(ratio);
            } else {
                let name = &row.name;
                assert!(ratio <= most_random, "{name} {kind:?}: {ratio} times the optimum");
                random.push(ratio);
            }
        }
        random.sort_by(f64::total_cmp);
        let (median, most) = (random[random.len() / 2], random[random.len() - 1]);
        println!("{kind:?}: median {median:.4}, at most {most:.4}, regular {regular:.4}");
        assert!(median <= 1.01, "{kind:?}: {median}");
    }
}
