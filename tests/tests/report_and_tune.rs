//! `kontur report` and `kontur tune` on real runs: the contents of the pages, and the proposal for a program.

use kontur::Exit;
use kontur_kit::Oscillator;
use kontur_tests::command::Folder;
use kontur_tests::{Run, programs, run};
use serde_json::Value;

/// The runs in the page that `kontur report` makes for programs with settings.
fn page(texts: &[&str], settings: &str) -> Vec<Value> {
    whole_page(texts, settings)["runs"].as_array().unwrap().clone()
}

/// All data of such a page.
fn whole_page(texts: &[&str], settings: &str) -> Value {
    let names = ["part0.nc", "part1.nc"];
    let parts: Vec<(&str, &str)> = names.into_iter().zip(texts.iter().copied()).collect();
    let folder = Folder::new(&parts);
    let mut words = vec!["report", "-o", "@report.html"];
    words.extend(&["@part0.nc", "@part1.nc"][..texts.len()]);
    words.extend(settings.split_whitespace().flat_map(|s| ["--set", s]));
    assert_ne!(folder.call(&words).exit, Exit::Usage, "{words:?}");
    let html = folder.read("report.html");
    let data = html.split("type=\"application/json\">").nth(1).unwrap();
    serde_json::from_str(data.split("</script>").next().unwrap()).unwrap()
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect()
}

fn curve(run: &Value, name: &str) -> Vec<f64> {
    let curves = run["curves"].as_array().unwrap();
    numbers(&curves.iter().find(|c| c["name"] == name).unwrap_or_else(|| panic!("{name}"))["low"])
}

/// A load on a spring of 10 Hz: without the guard it keeps swinging, with the guard it is at rest. Conformance: V006.
#[test]
fn the_load_of_a_spring_with_and_without_the_guard() {
    let program = |guard: &str| format!("%P\n{guard}\nG90 G01 X20 F3000\nG04 1\nM30\n");
    let texts = [program(""), program("#VIB GUARD ON [MODE=2 FREQ=10 DAMPING=0.02]")];
    // the 10.26 Hz of two free masses become 10 Hz of the load when the motor, 19 times as heavy, is at rest
    let plant = "model=TWO_MASS mass_motor=95 mass_load=5 f0=10.26 damping=0.02"
        .split(' ')
        .map(|entry| format!("kontur.axis[1].plant.{entry} "))
        .collect::<String>();
    let runs = page(&[&texts[0], &texts[1]], &plant);
    let swing = |run: &Value| {
        let (set, load) = (curve(run, "X set"), curve(run, "X load"));
        let arrived = set.iter().rposition(|x| (x - 20.0).abs() > 1e-6).unwrap();
        let behind = &load[arrived + 50..arrived + 500];
        let high = behind.iter().copied().fold(f64::MIN, f64::max);
        high - behind.iter().copied().fold(f64::MAX, f64::min)
    };
    let (without, with) = (swing(&runs[0]), swing(&runs[1]));
    assert!(without > 0.02 && with < 0.2 * without, "{without} {with}");
}

/// The three passes are drawn on top of each other, each with its largest error. Conformance: V061.
#[test]
fn the_three_passes_of_the_square_are_overlaid() {
    let square = programs().join("square_corner.nc");
    let folder = Folder::new(&[]);
    let drawn = folder.call(&["report", square.to_str().unwrap(), "-o", "@square.svg"]);
    assert_eq!(drawn.exit, Exit::Finished);
    let picture = folder.read("square.svg");
    let errors: Vec<f64> = (1..=3)
        .map(|pass| {
            let label = picture.split(&format!("set, pass {pass}, lines ")).nth(1).unwrap();
            let error = label.split("contour error at most ").nth(1).unwrap();
            error.split(' ').next().unwrap().parse().unwrap()
        })
        .collect();
    // 0.01 mm per axis give 0.0141 mm at most; 3500 mm/s2 in one cycle give 3.5 mm/s at the kinks
    assert!(errors[0] <= 0.0142 && errors[0] > 0.003, "{errors:?}");
    assert!(errors[1] > errors[0] && errors[2] < 1e-9, "{errors:?}");
    // one colour each, in one panel
    let runs = page(&[&std::fs::read_to_string(square).unwrap()], "");
    assert_eq!(runs[0]["passes"], 3);
    let (passes, set) = (numbers(&runs[0]["pass"]), &runs[0]["set"]);
    let (x, y) = (numbers(&set[0]), numbers(&set[1]));
    for pass in 0..3 {
        let of = |v: &[f64]| -> (f64, f64) {
            let of_pass =
                v.iter().zip(&passes).filter(|(_, p)| (**p - f64::from(pass)).abs() < 0.5);
            of_pass.fold((f64::MAX, f64::MIN), |(a, b), (v, _)| (a.min(*v), b.max(*v)))
        };
        for (low, high) in [of(&x), of(&y)] {
            assert!(low.abs() < 1e-3 && (high - 1.0).abs() < 0.3, "{pass}: {low} {high}");
        }
    }
}

/// Set and actual position, the window, and t1, t2, t3 of an exact stop, compared with the trace. Conformance: P022.
#[test]
fn the_course_of_an_exact_stop() {
    let text = "%P\nG90 G60 G01 X50 F6000\nG60 X60\nM30\n";
    let settings = "X.getriebe[0].kv=2000 X.vorsteuer.vorsteuerung=NONE X.getriebe[0].window=500 \
                    X.getriebe[0].position_settling_time=400000";
    let runs = page(&[text], settings);
    let page = &runs[0];
    let trace: Run = run(text, &settings.split_whitespace().collect::<Vec<_>>());
    let (set, act) = (trace.axis(0, |a| a.set), trace.axis(0, |a| a.act));
    assert_eq!(curve(page, "X set").len(), set.len());
    for (shown, is) in [("X set", &set), ("X actual", &act)] {
        let shown = curve(page, shown);
        let worst = shown.iter().zip(is).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(worst < 1e-7, "{worst}");
    }
    let stops = page["stops"].as_array().unwrap();
    assert_eq!(stops.len(), 2, "{stops:?}");
    // after the second stop the program ends before the axis is in its window
    for (stop, target) in stops.iter().zip([50.0_f64]) {
        let t1 = set.iter().position(|x| x.to_bits() == target.to_bits()).unwrap();
        let t2 = (t1..).find(|&k| (act[k] - target).abs() <= 0.05).unwrap();
        assert_eq!(stop[0], "X");
        assert_eq!(
            numbers(&Value::from(stop.as_array().unwrap()[1..].to_vec())),
            [target, 0.05, t1 as f64, t2 as f64, (t1 + 400) as f64]
        );
        // ln(lag / window) over the slow pole of kv = 20/s with a drive of 5 ms
        let pole_1_s = (1.0 - (1.0_f64 - 4.0 * 20.0 * 0.005).sqrt()) / (2.0 * 0.005);
        let lag = act[t1] - target;
        let closed = libm::log(lag.abs() / 0.05) / pole_1_s;
        assert!((1e-3 * (t2 - t1) as f64 / closed - 1.0).abs() < 0.03, "{t1} {t2} {closed}");
    }
}

/// Time and largest deviation that `kontur run` gives for a program.
fn driven(text: &str) -> (f64, f64) {
    let run = run(text, &[]);
    assert!(!run.totals.aborted, "{:?}", run.diagnostics);
    let dev =
        run.records.iter().flat_map(|r| &r.axes[..3]).map(|a| a.dev.abs()).fold(0.0, f64::max);
    ((run.records.len() - 1) as f64 * run.cycle_s, dev)
}

/// The choice for a real program: pasted into it, it gives the time and keeps the deviation stated in the table.
#[test]
fn a_choice_for_a_program_does_what_it_says() {
    let blocks = "G90 G01 F3000\nX4\nY4\nX1 Y2\nX0 Y0\nM30\n";
    let folder = Folder::new(&[("part.nc", &format!("%PART\n{blocks}"))]);
    let tune = ["tune", "--freq", "38,42", "--program", "@part.nc", "--max-dev"];
    let output = folder.call(&[&tune[..], &["0.01"]].concat());
    let (exit, text) = (output.exit, output.out);
    assert_eq!(exit, Exit::Finished, "{text}");
    let line = text.lines().find_map(|l| l.strip_prefix("choice    ")).unwrap();
    assert!(line.starts_with("#VIB GUARD ON [MODE=") && line.ends_with(" AX_DEV=0.01]"), "{line}");
    let promised: f64 = {
        let end = text.lines().last().unwrap();
        end.trim_end_matches(" s").rsplit(' ').next().unwrap().parse().unwrap()
    };
    let (time_s, dev) = driven(&format!("%PART\n{line}\n{blocks}"));
    assert!((time_s - promised).abs() < 5e-4, "{time_s} {promised}\n{text}");
    assert!(dev <= 0.01 + 1e-9 && dev > 0.003, "{dev}");
    // without the tolerance the corners exceed the bound, which is why the choice contains it
    let (_, free) = driven(&format!("%PART\n{}\n{blocks}", line.replace(" AX_DEV=0.01", "")));
    assert!(free > 0.01, "{free}");
    // the table: every mode, with and without AX_DEV
    let rows: Vec<&str> =
        text.lines().skip_while(|l| !l.contains("machining time")).skip(1).collect();
    for mode in ["1 ", "2 ", "3 ", "4 "] {
        assert!(rows.iter().any(|r| r.starts_with(mode)), "{mode}: {text}");
    }
    assert!(rows.iter().any(|r| r.contains(" 0.01 ") && r.ends_with("yes")), "{text}");
    // a bound that is never exceeded costs nothing, and is in the line all the same
    let text = folder.call(&[&tune[..], &["5"]].concat()).out;
    assert!(text.contains(" AX_DEV=5]\n"), "{text}");
}

const SHAPED: &str =
    "%P\n#VIB GUARD ON [MODE=1 FREQ=25 DAMPING=0.05]\nG90 G01 X20 F9000\nX5 Y3\nM30\n";

/// The spectrum of the commanded acceleration compared with its defining sum, and the mark of the guard.
#[test]
fn the_spectrum_of_a_page_is_that_of_the_accelerations() {
    let page = whole_page(&[SHAPED], "");
    let views = page["chart"]["views"].as_array().unwrap();
    let view = &views.iter().find(|v| v["kind"] == "spectrum").unwrap()["view"];
    assert_eq!(view["marks"], serde_json::json!([{ "at": 25.0, "name": "guard X Y Z 25 Hz" }]));
    assert_eq!(view["x"]["label"], "frequency in Hz");
    let trace: Run = run(SHAPED, &[]);
    for (axis, line) in view["lines"].as_array().unwrap().iter().enumerate() {
        let a = trace.axis(axis, |a| a.acc);
        let n = a.len() as f64;
        let hann: Vec<f64> = (0..a.len())
            .map(|i| libm::pow(libm::sin(std::f64::consts::PI * (i as f64 + 0.5) / n), 2.0))
            .collect();
        let mean = a.iter().zip(&hann).map(|(a, w)| a * w).sum::<f64>() / (0.5 * n);
        let points = line["points"]["given"]["points"].as_array().unwrap();
        assert!(points.len() > 50, "{}", points.len());
        for point in points.iter().step_by(points.len() / 40) {
            let [f, shown] = [0, 1].map(|i| point[i].as_f64().unwrap());
            let (mut re, mut im) = (0.0, 0.0);
            for (k, (a, w)) in a.iter().zip(&hann).enumerate() {
                let angle = std::f64::consts::TAU * f * 1e-3 * k as f64;
                re += (a - mean) * w * libm::cos(angle);
                im += (a - mean) * w * libm::sin(angle);
            }
            let amplitude = libm::hypot(re, im) / (0.25 * n);
            assert!(
                (amplitude - shown).abs() < 1e-6 * amplitude.max(1.0),
                "{f} Hz: {amplitude} {shown}"
            );
        }
    }
}

/// The residual vibration of a mass on a spring, as given in the picture, compared with its differential equation in small steps; without
/// the guard, whose frequency is then arbitrary, much more remains.
#[test]
fn what_a_spring_is_left_with() {
    let folder = Folder::new(&[("a.nc", SHAPED)]);
    assert_eq!(folder.call(&["report", "@a.nc", "-o", "@a.svg"]).exit, Exit::Finished);
    let picture = folder.read("a.svg");
    let title =
        picture.split("Mass on a spring of 25 Hz, damping 0.05; left at the end: ").nth(1).unwrap();
    let said = title.split('<').next().unwrap();
    let left = |text: &str, axis: usize| -> f64 {
        let (mut spring, mut left) = (Oscillator::new(25.0, 0.05), 0.0);
        for a in run(text, &[]).axis(axis, |a| a.acc) {
            spring.advance(a, 1e-3, 20);
            if a.abs() >= 0.0005 {
                left = spring.amplitude();
            }
        }
        left
    };
    assert_eq!(said, format!("X {:.5} mm, Y {:.5} mm", left(SHAPED, 0), left(SHAPED, 1)));
    let unshaped = SHAPED.replace("#VIB GUARD ON [MODE=1 FREQ=25 DAMPING=0.05]", "");
    assert!(
        left(&unshaped, 1) > 3.0 * left(SHAPED, 1),
        "{} {}",
        left(&unshaped, 1),
        left(SHAPED, 1)
    );
}
