//! Machine time compared with the jerk-limited optimum under the same limits.
//!
//! `data/optimum.csv` is made by `reference/table.py`, by convex programming; it shares no code with the planner.

use crate::common::{Job, axis, channel, even, numbers, points};
use kontur_motion::axis::AxisDynamics;
use kontur_motion::block::SlopeKind::{self, Hsc, Trapez};

/// Cycle of the table in us: short enough that rounding of the time to cycles, and kinks within one cycle, do not
/// matter.
pub(crate) const CYCLE_US: u32 = 100;
/// Kinks may use the velocity jump of 1 ms of acceleration.
const KINK_WEIGHT: f64 = 10.0;

/// A contour of a table of references, and its least time.
pub(crate) struct Row {
    pub(crate) name: String,
    pub(crate) axes: Vec<AxisDynamics>,
    pub(crate) feeds: Vec<f64>,
    /// 0 in a table without this column.
    pub(crate) path_dev_mm: f64,
    pub(crate) points: Vec<Vec<f64>>,
    least_s: f64,
}

impl Row {
    /// Time of so many cycles over the least one.
    pub(crate) fn ratio(&self, cycles: usize) -> f64 {
        cycles as f64 * f64::from(CYCLE_US) * 1e-6 / self.least_s
    }
}

/// The machines of the tables, with a weight of kinks.
fn machine(name: &str, kink_weight: f64) -> Vec<AxisDynamics> {
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

/// Rows of a table, for machines with a weight of kinks.
pub(crate) fn table(text: &str, kink_weight: f64) -> Vec<Row> {
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let rows = reader.records().map(|record| {
        let record = record.unwrap();
        let cells: Vec<&str> = record.iter().collect();
        let [contour, least_s] = [2, 1].map(|behind| cells[cells.len() - behind]);
        Row {
            name: format!("{} {}", cells[0], cells[1]),
            axes: machine(cells[1], kink_weight),
            feeds: numbers(cells[2]),
            path_dev_mm: if cells.len() > 5 { cells[3].parse().unwrap() } else { 0.0 },
            points: points(contour),
            least_s: least_s.parse().unwrap(),
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
    row.ratio(job.drive(&row.points, &row.feeds).len() - 1)
}

/// Median and largest ratio of the random contours, largest of the surfaces, spirals and circles.
#[test]
fn machine_time_is_close_to_the_optimum() {
    let rows = table(include_str!("data/optimum.csv"), KINK_WEIGHT);
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
