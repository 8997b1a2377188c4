//! A program as the control reads it.

use super::tree::{
    Expr, Function, Insert, Kind, Motion, Operator, Program, Statement, Subroutine, Way, Word,
};
use std::collections::BTreeMap;
use std::fmt::Write;

/// Name of the main program's file.
pub const MAIN: &str = "part.nc";

/// File and line of every motion.
pub type Places = BTreeMap<usize, (String, u32)>;

/// A file being written.
struct File {
    name: String,
    text: String,
    places: Places,
}

/// Files, and the places of the motions in them.
pub fn written(program: &Program) -> (Vec<(String, String)>, Places) {
    let mut main = File { name: MAIN.to_owned(), text: String::new(), places: Places::new() };
    let mut files = Vec::new();
    let mut places = Places::new();
    for (number, subroutine) in program.subroutines.iter().enumerate() {
        match subroutine.kind {
            Kind::Local | Kind::LocalCycle => {
                main.line(&format!("%L SUB{number}"));
                main.body(subroutine, program);
            }
            Kind::Global | Kind::GlobalCycle => {
                let name = format!("sub{number}.nc");
                let mut file = File { name, text: String::new(), places: Places::new() };
                file.body(subroutine, program);
                places.append(&mut file.places);
                files.push((file.name, file.text));
            }
        }
    }
    main.line("%MAIN\nF30000");
    main.statements(&program.main, program);
    main.line("M30");
    places.append(&mut main.places);
    files.push((main.name, main.text));
    (files, places)
}

const AXES: [char; 3] = ['X', 'Y', 'Z'];

impl File {
    fn line(&mut self, text: &str) {
        self.text.push_str(text);
        self.text.push('\n');
    }

    fn body(&mut self, subroutine: &Subroutine, program: &Program) {
        self.statements(&subroutine.body, program);
        self.line("M17");
    }

    fn statements(&mut self, statements: &[Statement], program: &Program) {
        for statement in statements {
            self.statement(statement, program);
        }
    }

    fn statement(&mut self, statement: &Statement, program: &Program) {
        match statement {
            Statement::Assign(to, value) => self.line(&format!("{}={}", text(to), text(value))),
            Statement::Move(motion) if motion.number % 5 == 0 && !motion.words.is_empty() => {
                self.by_macros(motion);
            }
            Statement::Move(motion) => self.motion("", motion),
            Statement::Compensated(contour) => {
                self.line(&format!("V.G.WZ_AKT.R={}", contour.radius));
                let side = if contour.left { "G41" } else { "G42" };
                let way = match contour.way {
                    Way::Lines => "G139",
                    Way::Perpendicular => "G237",
                    Way::Stays => "G239",
                };
                let on = format!("{side} {} {way}", if contour.by_arcs { "G26" } else { "G25" });
                let perpendicular = contour.way == Way::Perpendicular;
                if perpendicular {
                    self.motion("", &contour.approach);
                } else {
                    self.switched(&on, contour.in_block, &contour.approach);
                }
                for (i, element) in contour.elements.iter().enumerate() {
                    if let Some((_, radius)) = contour.change.filter(|(at, _)| *at == i) {
                        self.line(&format!("V.G.WZ_AKT.R={radius}"));
                    }
                    if perpendicular && i == 0 {
                        self.switched(&on, contour.in_block, element);
                    } else {
                        self.motion("", element);
                    }
                }
                self.switched("G40", contour.in_block, &contour.exit);
            }
            Statement::Spline(motions) => {
                self.line("G151");
                for motion in motions {
                    self.motion("", motion);
                }
                self.line("G150");
            }
            Statement::Corner(kind, size, [first, second]) => {
                self.motion("", first);
                self.line(&match kind {
                    Insert::Chamfer => format!("G301 I{size}"),
                    Insert::ChamferLength => format!("#CHF={size}"),
                    Insert::Rounding => format!("G302 I{size}"),
                });
                self.motion("", second);
            }
            Statement::TwoAngles([a, b], [first, second]) => {
                self.motion(&format!("#ANG={a}"), first);
                self.motion(&format!("#ANG={b}"), second);
            }
            Statement::Suppressed(motion) => self.motion("#SUPPRESS OFFSETS", motion),
            Statement::PositionPreset(words) => self.line(&format!("#PSET{}", words_text(words))),
            Statement::PresetOff => self.line("#PRESET"),
            Statement::ToolData(number, radius, length, offsets) => {
                self.line(&format!("V.G.WZ[{number}].R={radius}\nV.G.WZ[{number}].L={length}"));
                for (axis, offset) in AXES.iter().zip(offsets) {
                    self.line(&format!("V.G.WZ[{number}].V.{axis}={offset}"));
                }
            }
            Statement::Tool(number) => self.line(&format!("D{number}")),
            Statement::Local(name, value) => {
                let kind = if name.starts_with("V.CYC.") { " : REAL64 " } else { "" };
                self.line(&format!("#VAR\n{name}{kind}={}\n#ENDVAR", text(value)));
            }
            Statement::Array(name, values) => {
                let list: Vec<String> = values.iter().map(f64::to_string).collect();
                let (size, list) = (values.len(), list.join(","));
                self.line(&format!("#VAR\n{name}[{size}]=[{list}]\n#ENDVAR"));
            }
            Statement::Plane(g) => self.line(&format!("G{g}")),
            Statement::Absolute(absolute) => self.line(if *absolute { "G90" } else { "G91" }),
            Statement::AbsoluteCentres(on) => self.line(if *on { "G161" } else { "G162" }),
            Statement::Radius(radius) => self.line(&format!("G163={radius}")),
            Statement::Group(group) => self.line(&group_text(*group)),
            Statement::Table(group, axis, value) => {
                self.line(&format!("V.G.NP[{group}].V.{}={}", AXES[*axis], text(value)));
            }
            Statement::Preset(words) => self.line(&format!("G92{}", words_text(words))),
            Statement::Mirror(g) => self.line(&format!("G{g}")),
            Statement::MirrorAxis(axis, on) => {
                self.line(&format!("G351 {}{}", AXES[*axis], if *on { "-1" } else { "1" }));
            }
            Statement::Rotation(true, deg, [a, b]) => {
                self.line(&format!("G17\nG68 R{deg} X{a} Y{b}"));
            }
            Statement::Rotation(false, deg, [a, b]) => {
                self.line(&format!("G17\n#ROTATION ON [ANGLE={deg} CENTER1={a} CENTER2={b}]"));
            }
            Statement::RotationOff(word) => {
                self.line(if *word { "G69" } else { "#ROTATION OFF" });
            }
            Statement::System(values) => self.line(&format!("#CS ON {}", list(values))),
            Statement::StoredSystem(id, values) => {
                self.line(&format!("#CS DEF [{id}]{}\n#CS ON [{id}]", list(values)));
            }
            Statement::Stack(systems, selected) => {
                for (i, values) in systems.iter().enumerate() {
                    self.line(&format!("#CS ADD [SYS{i}N] {}", list(values)));
                }
                self.line(&format!("#CS SELECT [SYS{}N]", selected - 1));
            }
            Statement::StackOff(count, all) => {
                let lines = if *all { vec!["#CS DEL ALL"] } else { vec!["#CS DEL"; *count] };
                lines.into_iter().for_each(|line| self.line(line));
            }
            Statement::SystemOff(all) => self.line(if *all { "#CS OFF ALL" } else { "#CS OFF" }),
            Statement::Machine(body) => {
                self.line("#MCS ON");
                self.statements(body, program);
                self.line("#MCS OFF");
            }
            Statement::Scaled(at_once, factors, body) => {
                let mut words = String::new();
                for (axis, factor) in factors {
                    let _ = write!(words, " {}{factor}", AXES[*axis]);
                }
                self.line(&if *at_once {
                    format!("#SCALE ON{words}")
                } else {
                    format!("#SCALE{words}\n#SCALE ON")
                });
                self.statements(body, program);
                self.line("#SCALE OFF");
            }
            Statement::Break => self.line("$BREAK"),
            Statement::Continue => self.line("$CONTINUE"),
            Statement::Call(number) => match program.subroutines[*number].kind {
                Kind::Local | Kind::LocalCycle => self.line(&format!("LL SUB{number}")),
                Kind::Global | Kind::GlobalCycle => self.line(&format!("L sub{number}.nc")),
            },
            Statement::Cycle(number, values) => {
                let mut parameters = String::new();
                for (i, value) in values.iter().enumerate() {
                    let _ = write!(parameters, " @P{}={}", i + 1, text(value));
                }
                self.line(&match program.subroutines[*number].kind {
                    Kind::LocalCycle => format!("LL CYCLE [NAME=SUB{number}{parameters}]"),
                    _ => format!("L CYCLE [NAME=sub{number}.nc{parameters}]"),
                });
            }
            _ => self.control(statement, program),
        }
    }

    /// A motion, with words before those of the axes.
    fn motion(&mut self, words: &str, motion: &Motion) {
        let line = self.text.lines().count() as u32 + 1;
        self.places.insert(motion.number, (self.name.clone(), line));
        self.line(&motion_text(words, motion));
    }

    /// A motion whose axis words are the text of a macro, part of which is another macro.
    fn by_macros(&mut self, motion: &Motion) {
        let number = motion.number;
        let words = words_text(&motion.words);
        let mut parts: Vec<&str> = words.split(' ').filter(|part| !part.is_empty()).collect();
        // blanks around operators divide words too: then the whole is one part
        if parts.len() != motion.words.len() || number.is_multiple_of(2) {
            parts = vec![&words];
        }
        let first = parts.remove(0);
        self.line(&format!("\"PART {number}\"=\"{first}\""));
        self.line(&format!("\"MOTION {number}\"=\"\\\"PART {number}\\\" {}\"", parts.join(" ")));
        let bare = Motion { words: Vec::new(), ..motion.clone() };
        self.motion(&format!("\"MOTION {number}\""), &bare);
    }

    /// Words in a separate block, or in that of a motion.
    fn switched(&mut self, words: &str, in_block: bool, motion: &Motion) {
        if in_block {
            self.motion(words, motion);
        } else {
            self.line(words);
            self.motion("", motion);
        }
    }

    fn control(&mut self, statement: &Statement, program: &Program) {
        match statement {
            Statement::If(branches, otherwise) => {
                for (i, (condition, body)) in branches.iter().enumerate() {
                    let word = if i == 0 { "$IF" } else { "$ELSEIF" };
                    self.line(&format!("{word} {}", text(condition)));
                    self.statements(body, program);
                }
                if let Some(body) = otherwise {
                    self.line("$ELSE");
                    self.statements(body, program);
                }
                self.line("$ENDIF");
            }
            Statement::For(counter, [first, last, step], body) => {
                let (a, b, c) = (text(first), text(last), text(step));
                self.line(&format!("$FOR {counter}={a}, {b}, {c}"));
                self.statements(body, program);
                self.line("$ENDFOR");
            }
            Statement::While(condition, body) => {
                self.line(&format!("$WHILE {}", text(condition)));
                self.statements(body, program);
                self.line("$ENDWHILE");
            }
            Statement::Do(body, condition) => {
                self.line("$DO");
                self.statements(body, program);
                self.line(&format!("$ENDDO {}", text(condition)));
            }
            Statement::Repeat(body, condition) => {
                self.line("$REPEAT");
                self.statements(body, program);
                self.line(&format!("$UNTIL {}", text(condition)));
            }
            Statement::Switch(value, cases, default) => {
                self.line(&format!("$SWITCH {}", text(value)));
                for (case, body, ends) in cases {
                    self.line(&format!("$CASE {}", text(case)));
                    self.statements(body, program);
                    if *ends {
                        self.line("$BREAK");
                    }
                }
                self.line("$DEFAULT");
                self.statements(default, program);
                self.line("$ENDSWITCH");
            }
            Statement::Skip(condition, number, body) => {
                self.line(&format!("$IF {} $GOTO N{number}", text(condition)));
                self.statements(body, program);
                self.line(&format!("N{number}:"));
            }
            Statement::Again(number, body, condition) => {
                self.line(&format!("N{number}:"));
                self.statements(body, program);
                self.line(&format!("$IF {} $GOTO N{number}", text(condition)));
            }
            _ => unreachable!("{statement:?}"),
        }
    }
}

fn list(values: &[f64; 6]) -> String {
    let [x, y, z, a, b, c] = values;
    format!("[{x},{y},{z},{a},{b},{c}]")
}

fn group_text(group: u32) -> String {
    if group <= 6 { format!("G{}", 53 + group) } else { format!("G159={group}") }
}

fn words_text(words: &[Word]) -> String {
    let mut line = String::new();
    for (i, word) in words.iter().enumerate() {
        let (axis, value) = (AXES[word.axis], text(&word.value));
        // the forms of a word in turn
        let _ = match i % 3 {
            0 => write!(line, " {axis}{value}"),
            1 => write!(line, " {axis}[{value}]"),
            _ => write!(line, " {axis}={value}"),
        };
    }
    line
}

fn motion_text(words: &str, motion: &Motion) -> String {
    let mut line = format!("N{} {words}", motion.number);
    if let Some(plane) = motion.plane {
        let _ = write!(line, " G{plane}");
    }
    if let Some(absolute) = motion.absolute {
        line.push_str(if absolute { " G90" } else { " G91" });
    }
    if let Some(group) = motion.group {
        let _ = write!(line, " {}", group_text(group));
    }
    if let Some(path) = motion.path {
        let _ = write!(line, " G{path:02}");
    }
    if let Some(deg) = motion.angle {
        let _ = write!(line, " #ANG={deg}");
    }
    line.push_str(&words_text(&motion.words));
    for (letter, value) in &motion.centre {
        let _ = write!(line, " {letter}{value}");
    }
    if let Some(radius) = motion.radius {
        let _ = write!(line, " R{radius}");
    }
    line
}

/// Precedence of an operator by the table of the manual: 10 binds most strongly. Functions of two values bind like atoms.
fn level(operator: Operator) -> u32 {
    match operator {
        Operator::Or => 1,
        Operator::And => 3,
        Operator::Less | Operator::Greater | Operator::AtMost | Operator::Equal => 4,
        Operator::Add | Operator::Subtract => 8,
        Operator::Times | Operator::Divide | Operator::Mod => 9,
        Operator::Power => 10,
        Operator::Min | Operator::Max | Operator::Angle => 12,
    }
}

fn level_of(expr: &Expr) -> u32 {
    match expr {
        Expr::Both(operator, _, _) => level(*operator),
        Expr::Of(Function::Minus, _) => 11,
        _ => 12,
    }
}

/// As text, with brackets where the precedence demands them and nowhere else.
pub fn text(expr: &Expr) -> String {
    match expr {
        Expr::Number(x) => format!("{x}"),
        Expr::Name(name) => name.clone(),
        Expr::Element(name, index) => format!("{name}[{}]", text(index)),
        Expr::Indirect(number) => format!("PP{number}"),
        Expr::Of(Function::Minus, inner) => format!("-{}", bracketed(inner, 12)),
        Expr::Of(function, inner) => {
            let name = match function {
                Function::Sin => "SIN",
                Function::Cos => "COS",
                Function::Abs => "ABS",
                Function::Sqrt => "SQRT",
                Function::Int => "INT",
                Function::Round => "ROUND",
                Function::Floor | Function::Minus => "FLOOR",
            };
            format!("{name}[{}]", text(inner))
        }
        Expr::Both(operator, a, b) => {
            let sign = match operator {
                Operator::Add => "+",
                Operator::Subtract => "-",
                Operator::Times => "*",
                Operator::Divide => "/",
                Operator::Mod => " MOD ",
                Operator::Power => "**",
                Operator::Less => "<",
                Operator::Greater => " > ",
                Operator::AtMost => "<=",
                Operator::Equal => "==",
                Operator::And => " && ",
                Operator::Or => " OR ",
                Operator::Min => return format!("MIN[{}, {}]", text(a), text(b)),
                Operator::Max => return format!("MAX[{},{}]", text(a), text(b)),
                Operator::Angle => return format!("ATAN2[{}, {}]", text(a), text(b)),
            };
            let level = level(*operator);
            // comparisons are not chained
            let left = if level == 4 { level + 1 } else { level };
            format!("{}{sign}{}", bracketed(a, left), bracketed(b, level + 1))
        }
    }
}

fn bracketed(expr: &Expr, at_least: u32) -> String {
    if level_of(expr) >= at_least { text(expr) } else { format!("[{}]", text(expr)) }
}
