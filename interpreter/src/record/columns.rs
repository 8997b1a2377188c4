//! The columns of a trace: groups, names, units, and where the value of each is in a record.
//!
//! Order of calls: start a run, select columns, then read their values from each record.
//!
//! ```
//! use kontur_interpreter::job::{Job, MachineLists};
//! use kontur_interpreter::record::{CycleRecord, columns};
//! use kontur_interpreter::source::MemorySources;
//!
//! let (machine, _) = MachineLists::default().load().unwrap();
//! let sources = MemorySources::new().with("part.nc", "N10 G01 X10 F1000\nN20 M30\n");
//! let mut run = Job::new(machine, sources, "part.nc").start().unwrap();
//! // the columns follow from the axes of the run
//! let column = columns::select("X_set_mm", run.facts()).unwrap().pop().unwrap();
//! assert_eq!((column.name.as_str(), column.unit.as_str()), ("X_set_mm", "mm"));
//! let mut x_mm = Vec::new();
//! let Ok(()) = run.to_end(&mut |record: &CycleRecord| x_mm.extend(column.number(record)));
//! assert_eq!(x_mm.last(), Some(&10.0));
//! ```

use super::facts::{AxisFacts, Facts};
use super::{Asked, Quantity, Rows};
use crate::record::CycleRecord;

/// Groups in the order of the trace; `time` is always present.
pub const GROUPS: [&str; 10] =
    ["time", "path", "ipo", "set", "kin", "err", "ctrl", "drive", "axis", "spindle"];

/// The columns of a trace by default: [`DEFAULT_GROUPS`] without those that only repeat other columns on this machine
/// ([`Column::repeats`]).
pub const DEFAULT_SIGNALS: &str = "default";

/// Groups of a trace by default.
pub const DEFAULT_GROUPS: [&str; 6] = ["time", "path", "ipo", "set", "err", "axis"];

/// Decimals of positions: 0.1 nm, a thousandth of the vendor's increment of 0.1 um.
const POSITION_DECIMALS: u8 = 7;

/// Content of a column.
#[derive(Clone, Copy, Debug)]
pub enum Content {
    /// `k T` in seconds.
    Time,
    /// Line of the file.
    Line,
    /// N number, empty if none.
    Block,
    /// Name of the file.
    File,
    /// Reason for the path speed.
    Limit,
    /// A number of the record as a whole.
    Path(fn(&CycleRecord) -> f64),
    /// A number of one axis.
    Axis(usize, Quantity),
}

impl Content {
    /// The value of a numeric column; zero if the axis is missing in the record.
    #[inline] // for every value of a trace
    pub fn number(self, record: &CycleRecord) -> Option<f64> {
        match self {
            Self::Path(f) => Some(f(record)),
            Self::Axis(i, quantity) => {
                Some(record.axes.get(i).map_or(0.0, |axis| quantity.of(axis)))
            }
            _ => None,
        }
    }

    /// Appends the values of a numeric column in every `decimate`-th of the rows, from the first one on.
    pub fn extend(self, values: &mut Vec<f64>, rows: &Rows<'_>, decimate: usize) {
        match self {
            // without steps the length of the column is known in advance
            Self::Path(f) if decimate == 1 => values.extend(rows.cycles().iter().map(f)),
            Self::Path(f) => values.extend(rows.cycles().iter().step_by(decimate).map(f)),
            Self::Axis(i, quantity) => match rows.column(i, quantity) {
                column if decimate == 1 => values.extend_from_slice(column),
                column => values.extend(column.iter().step_by(decimate)),
            },
            _ => {}
        }
    }

    /// The axis quantities that it needs.
    pub fn asked(self) -> Asked {
        match self {
            Self::Axis(_, quantity) => Asked::of(&[quantity]),
            _ => Asked::NONE,
        }
    }

    /// Whether it is a number with decimals.
    pub const fn is_number(self) -> bool {
        matches!(self, Self::Path(_) | Self::Axis(..))
    }
}

/// One column.
#[derive(Clone, Debug)]
pub struct Column {
    /// Heading, ending with the unit.
    pub name: String,
    /// Source of the value.
    pub content: Content,
    /// Digits after the point.
    pub decimals: u8,
    /// The group it belongs to.
    pub group: &'static str,
    /// Whether it only repeats: the actual position of a load that cannot be elsewhere, the zero of an unused
    /// addition, or the only file of a program.
    pub repeats: bool,
    /// `mm`, `deg/s2`, `Nm`, ...; empty for words, flags, counts and values in the drive's format.
    pub unit: String,
}

impl Column {
    /// Whether it shows a value that a run without measurement
    /// ([`Run::without_deviation`](crate::job::Run::without_deviation)) leaves out.
    pub fn shows_deviation(&self) -> bool {
        self.group == "err"
    }

    /// The value of a numeric column; zero if the axis is missing in the record.
    pub fn number(&self, record: &CycleRecord) -> Option<f64> {
        self.content.number(record)
    }
}

/// The unit of an axis quantity as written after its name, and its decimals.
#[derive(Clone, Copy)]
enum Unit {
    Length,
    Speed,
    Acceleration,
    Jerk,
    Drive,
    Torque,
    Time,
    /// 0 or 1.
    Flag,
}

impl Unit {
    fn suffix(self, base: &str) -> String {
        match self {
            Self::Length => format!("_{base}"),
            Self::Speed => format!("_{base}_s"),
            Self::Acceleration => format!("_{base}_s2"),
            Self::Jerk => format!("_{base}_s3"),
            Self::Drive => "_drive".to_owned(),
            Self::Torque => "_nm".to_owned(),
            Self::Time => "_s".to_owned(),
            Self::Flag => String::new(),
        }
    }

    fn name(self, base: &str) -> String {
        match self {
            Self::Length => base.to_owned(),
            Self::Speed => format!("{base}/s"),
            Self::Acceleration => format!("{base}/s2"),
            Self::Jerk => format!("{base}/s3"),
            Self::Torque => "Nm".to_owned(),
            Self::Time => "s".to_owned(),
            Self::Drive | Self::Flag => String::new(),
        }
    }

    const fn decimals(self) -> u8 {
        match self {
            Self::Length => POSITION_DECIMALS,
            Self::Speed | Self::Torque | Self::Time => 6,
            Self::Acceleration | Self::Drive => 4,
            Self::Jerk => 2,
            Self::Flag => 0,
        }
    }
}

/// A quantity of an axis as a column: group, word, unit.
type Shown = (&'static str, &'static str, Unit, Quantity);

/// Every quantity of an axis, in the order of the trace.
const QUANTITIES: [Shown; 25] = [
    ("ipo", "ipo", Unit::Length, Quantity::Ipo),
    ("set", "set", Unit::Length, Quantity::Set),
    ("kin", "vel", Unit::Speed, Quantity::Vel),
    ("kin", "acc", Unit::Acceleration, Quantity::Acc),
    ("kin", "jerk", Unit::Jerk, Quantity::Jerk),
    ("err", "err", Unit::Length, Quantity::Err),
    ("err", "dev", Unit::Length, Quantity::Dev),
    ("ctrl", "ff", Unit::Speed, Quantity::Ff),
    ("ctrl", "cmd", Unit::Speed, Quantity::Cmd),
    ("ctrl", "vadd", Unit::Speed, Quantity::Vadd),
    ("ctrl", "vadd_limited", Unit::Flag, Quantity::VaddLimited),
    ("drive", "cmd", Unit::Drive, Quantity::CmdDrive),
    ("drive", "vff", Unit::Drive, Quantity::VffDrive),
    ("drive", "vadd", Unit::Drive, Quantity::VaddDrive),
    ("drive", "torque", Unit::Drive, Quantity::TorqueDrive),
    ("drive", "torque", Unit::Torque, Quantity::TorqueNm),
    ("axis", "ref", Unit::Length, Quantity::Reference),
    ("axis", "act", Unit::Length, Quantity::Act),
    ("axis", "load", Unit::Length, Quantity::Load),
    ("axis", "lag", Unit::Length, Quantity::Lag),
    ("axis", "add", Unit::Length, Quantity::Add),
    ("ctrl", "lag_limit", Unit::Length, Quantity::LagLimit),
    ("axis", "settling", Unit::Time, Quantity::Settling),
    ("axis", "tcp", Unit::Length, Quantity::Tcp),
    ("axis", "tcp_acc", Unit::Acceleration, Quantity::TcpAcc),
];

/// Every column that a run of this machine can have, in the order of the trace.
pub fn all(facts: &Facts) -> Vec<Column> {
    let number = |unit: Unit, name: &str, group, value| Column {
        decimals: unit.decimals(),
        unit: unit.name("mm"),
        ..plain(name, group, Content::Path(value))
    };
    let time = Column { decimals: 6, unit: "s".to_owned(), ..plain("t_s", "time", Content::Time) };
    let file = Column { repeats: !facts.files.several(), ..plain("file", "time", Content::File) };
    let mut columns = vec![
        time,
        plain("line", "time", Content::Line),
        plain("block", "time", Content::Block),
        file,
    ];
    columns.push(number(Unit::Length, "s_mm", "path", |r| r.path.s_mm));
    columns.push(number(Unit::Speed, "v_mm_s", "path", |r| r.path.v_mm_s));
    columns.push(number(Unit::Acceleration, "a_mm_s2", "path", |r| r.path.a_mm_s2));
    columns.push(number(Unit::Jerk, "j_mm_s3", "path", |r| r.path.j_mm_s3));
    columns.push(plain("v_limit", "path", Content::Limit));
    for group in ["ipo", "set", "kin", "err", "ctrl", "drive", "axis"] {
        for (i, axis) in facts.axes.iter().enumerate().filter(|(_, a)| !a.spindle) {
            columns.extend(quantities(i, axis, |g| g == group));
        }
        if group == "err" {
            columns.push(number(Unit::Length, "contour_err_mm", "err", |r| r.contour_err_mm));
        }
    }
    for (i, axis) in facts.axes.iter().enumerate().filter(|(_, a)| a.spindle) {
        let of_spindle = quantities(i, axis, |g| g != "err");
        columns.extend(of_spindle.map(|c| Column { group: "spindle", ..c }));
    }
    columns
}

fn plain(name: &str, group: &'static str, content: Content) -> Column {
    Column {
        name: name.to_owned(),
        content,
        decimals: 0,
        group,
        repeats: false,
        unit: String::new(),
    }
}

fn quantities<'a>(
    index: usize,
    axis: &'a AxisFacts,
    wanted: impl Fn(&str) -> bool + 'a,
) -> impl Iterator<Item = Column> + 'a {
    QUANTITIES
        .iter()
        .filter(move |q| wanted(q.0) && (axis.apart.tool_point || !q.1.starts_with("tcp")))
        .map(move |&(group, word, unit, quantity)| Column {
            name: format!("{}_{word}{}", axis.name, unit.suffix(axis.unit())),
            content: Content::Axis(index, quantity),
            decimals: unit.decimals(),
            group,
            repeats: match word {
                "load" => !axis.apart.load,
                "add" => !axis.apart.additional,
                _ => false,
            },
            unit: unit.name(axis.unit()),
        })
}

/// The axis quantities that the columns need.
pub fn asked(columns: &[Column]) -> Asked {
    columns.iter().fold(Asked::NONE, |asked, column| asked.and(column.content.asked()))
}

/// The columns selected by `signals`: groups, column names and [`DEFAULT_SIGNALS`], separated by commas, in the order
/// of the trace. A group has all its columns.
///
/// # Errors
/// An unknown word: the message lists the choices.
pub fn select(signals: &str, facts: &Facts) -> Result<Vec<Column>, String> {
    let all = all(facts);
    let words: Vec<&str> = signals.split(',').map(str::trim).filter(|w| !w.is_empty()).collect();
    for word in &words {
        let known = *word == DEFAULT_SIGNALS || GROUPS.contains(word);
        if !known && !all.iter().any(|c| c.name == *word) {
            let names: Vec<&str> = all.iter().map(|c| c.name.as_str()).collect();
            return Err(format!(
                "`{word}` is neither a group nor a column\n  groups: {DEFAULT_SIGNALS}, {}\n  columns: {}",
                GROUPS.join(", "),
                names.join(", ")
            ));
        }
    }
    let by_default = |c: &Column| DEFAULT_GROUPS.contains(&c.group) && !c.repeats;
    let asked = |c: &Column, word: &str| {
        word == c.name
            || word == c.group && c.group != "time"
            || word == DEFAULT_SIGNALS && by_default(c)
    };
    let always = |c: &Column| c.group == "time" && !c.repeats;
    let wanted = |c: &Column| always(c) || words.iter().any(|word| asked(c, word));
    Ok(all.into_iter().filter(wanted).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::job::{Apart, FileNames};

    fn facts() -> Facts {
        let axis = |name: &str, rotary, spindle| AxisFacts {
            name: name.to_owned(),
            rotary,
            spindle,
            ..AxisFacts::default()
        };
        Facts {
            axes: vec![axis("X", false, false), axis("C", true, false), axis("S", true, true)],
            files: FileNames::new(vec!["part.nc".to_owned()], false),
            ..Facts::default()
        }
    }

    fn names(signals: &str) -> Vec<String> {
        select(signals, &facts()).unwrap().into_iter().map(|c| c.name).collect()
    }

    #[test]
    fn default_groups_in_trace_order() {
        assert_eq!(
            names(DEFAULT_SIGNALS).join(","),
            "t_s,line,block,s_mm,v_mm_s,a_mm_s2,j_mm_s3,v_limit,X_ipo_mm,C_ipo_deg,X_set_mm,C_set_deg,\
             X_err_mm,X_dev_mm,C_err_deg,C_dev_deg,contour_err_mm,X_ref_mm,X_act_mm,X_lag_mm,X_settling_s,\
             C_ref_deg,C_act_deg,C_lag_deg,C_settling_s"
        );
    }

    /// A column that repeats another one is present where it differs, and where it is requested.
    #[test]
    fn repeating_columns_are_there_when_asked_for() {
        let of = |signals: &str, load, additional| {
            let mut facts = facts();
            facts.axes[0].apart = Apart { load, additional, ..Apart::default() };
            let names = select(signals, &facts).unwrap().into_iter().map(|c| c.name);
            names
                .filter(|n| n.contains("_load_") || n.contains("_add_"))
                .collect::<Vec<_>>()
                .join(",")
        };
        assert_eq!(of("default", false, false), "");
        assert_eq!(of("default", true, false), "X_load_mm");
        assert_eq!(of("default,kin", false, true), "X_add_mm");
        assert_eq!(of("default,X_load_mm", false, false), "X_load_mm");
        assert_eq!(of("axis", false, false), "X_load_mm,X_add_mm,C_load_deg,C_add_deg");
    }

    #[test]
    fn groups_and_names_mix_and_time_is_always_there() {
        assert_eq!(names("X_lag_mm").join(","), "t_s,line,block,X_lag_mm");
        // the only file of a program, by name
        assert_eq!(names("file,X_lag_mm").join(","), "t_s,line,block,file,X_lag_mm");
        assert_eq!(names("time,X_lag_mm").join(","), "t_s,line,block,X_lag_mm");
        assert_eq!(
            names("kin , X_torque_nm,X_cmd_drive").join(","),
            "t_s,line,block,X_vel_mm_s,X_acc_mm_s2,X_jerk_mm_s3,C_vel_deg_s,C_acc_deg_s2,C_jerk_deg_s3,\
             X_cmd_drive,X_torque_nm"
        );
        assert!(names("spindle").contains(&"S_vel_deg_s".to_owned()));
        assert!(!names("kin").contains(&"S_vel_deg_s".to_owned()));
    }

    #[test]
    fn unknown_word_names_the_choices() {
        let message = select("ipo,X_foo_mm", &facts()).unwrap_err();
        assert!(message.contains("`X_foo_mm`") && message.contains("spindle"), "{message}");
        assert!(message.contains("C_ipo_deg"), "{message}");
        let modal = select("X_tcp_mm", &facts());
        assert!(modal.is_err(), "only modal plants have a tool point");
    }

    /// The unit is the end of the name, written as it is spoken.
    #[test]
    fn units_are_those_of_the_names() {
        for column in all(&facts()) {
            let ending = column.unit.replace('/', "_").to_lowercase();
            assert!(column.name.ends_with(&ending), "{} in {}", column.name, column.unit);
            let drive = column.name.ends_with("_drive") || column.name.ends_with("_vadd_limited");
            let number =
                matches!(column.content, Content::Time | Content::Path(_) | Content::Axis(..));
            assert_eq!(column.unit.is_empty(), drive || !number, "{}", column.name);
        }
    }

    #[test]
    fn names_are_unique() {
        let mut names: Vec<String> = all(&facts()).into_iter().map(|c| c.name).collect();
        let n = names.len();
        names.sort();
        names.dedup();
        assert_eq!(names.len(), n);
    }
}
