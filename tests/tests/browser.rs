//! The page of `kontur report` in a headless browser: its script runs without errors and without requests, the plots are drawn, and the
//! tip gives the values under the pointer.
//!
//! `KONTUR_BROWSER` names the browser; without it Chromium is searched for. If there is none, nothing is tested, and the test says so.

use kontur::Exit;
use kontur::chart::scale::ticks;
use kontur_filters::analysis::spring::SpringMass;
use kontur_filters::time::CycleTime;
use kontur_tests::command::command;
use kontur_tests::{programs, run};
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Inspects the page from inside: its contents are written as JSON to a separate element.
const PROBE: &str = r#"<script>
const errors = [];
window.addEventListener("error", e => errors.push(String(e.message)));
</script>"#;

const REPORT: &str = r##"<script>
const drawn = canvas => {
  const c = canvas.getContext("2d");
  if (!canvas.width || !canvas.height) return 0;
  const pixels = c.getImageData(0, 0, canvas.width, canvas.height).data, seen = new Set();
  for (let i = 0; i < pixels.length; i += 4) if (pixels[i + 3] > 200) seen.add(pixels[i] << 16 | pixels[i + 1] << 8 | pixels[i + 2]);
  return seen.size;
};
const shown = [...document.querySelectorAll("canvas")].filter(c => c.style.display !== "none");
const colours = shown.map(drawn);
const event = (name, target, x, y, more) => target.dispatchEvent(new PointerEvent(name, { clientX: x, clientY: y, bubbles: true, ...more }));
const box = contour.getBoundingClientRect();
// on the way along the upper edge of the square
const [x, y] = toScreen(wide, 5, 10);
event("pointermove", contour, box.left + x, box.top + y);
const tipText = byId("tip").hidden ? "" : byId("tip").textContent;
const swatches = [...document.querySelectorAll(".key")].map(k => ({
  name: k.textContent, dash: k.querySelector("line").getAttribute("stroke-dasharray"), colour: k.querySelector("line").getAttribute("stroke"),
  width: k.querySelector("line").getAttribute("stroke-width"), card: k.parentElement.querySelector("button") ? k.parentElement.querySelector("button").textContent : "contour",
}));
const before = wide.scale;
const label = contour.getAttribute("aria-label"), shownKeys = [...document.querySelectorAll(".key")];
// keys: a step over time, a legend, a turn in space
const press = (target, key) => target.dispatchEvent(new KeyboardEvent("keydown", { key, bubbles: true, cancelable: true }));
view.at = 0.05;
press(plots[0].canvas, "ArrowRight");
const stepped = view.at;
press(shownKeys[0], "Enter");
const hiddenByKey = view.hidden.size;
press(shownKeys[0], "Enter");
// a click on a line of the text highlights its samples: as many coloured bands on the speed as pixels of the mark
const rowOf = line => document.querySelectorAll("#program div")[line - 1];
const marked = () => {
  const [r, g, b] = /rgba?\((\d+), (\d+), (\d+)/.exec((() => { const e = make("i"); e.style.color = "var(--mark)"; document.body.append(e); return getComputedStyle(e).color; })()).slice(1).map(Number);
  const canvas = plots[0].canvas, pixels = canvas.getContext("2d").getImageData(0, Math.round(canvas.height / 3), canvas.width, 1).data;
  // the mark on the background of the card: red stays high while green and blue fall
  let n = 0;
  for (let i = 0; i < pixels.length; i += 4) n += pixels[i] - pixels[i + 1] > 40 && pixels[i + 3] > 0;
  return n / canvas.width;
};
const dark = marked();
rowOf(4).click();
drawAll();
const lit = marked(), chosen = rowOf(4).classList.contains("chosen"), chosenLine = view.line;
rowOf(4).click();
drawAll();
const unlit = marked();
// the text follows the pointer
view.at = 0.05;
drawAll();
const followed = document.querySelector("#program div.at span"), follows = followed && followed.textContent;
// in space, coloured by the limiting reason
const buttons = [...document.querySelectorAll("#planes button")];
buttons[3].click();
[...document.querySelectorAll("#paints button")][2].click();
drawAll();
const inSpace = drawn(contour), limits = [...document.querySelectorAll("#legend .note .key")].map(k => k.textContent);
const turned = [...view.turn];
press(contour, "ArrowLeft");
const turns = view.turn[0] !== turned[0];
buttons[0].click();
// round numbers of any range, and the spring with another frequency
const ranges = [];
for (let i = 0, seed = 1; i < 400; i++) {
  const next = () => (seed = (seed * 48271) % 2147483647) / 2147483647;
  const low = (next() - 0.5) * 10 ** Math.floor(12 * next() - 6), high = low + next() * 10 ** Math.floor(12 * next() - 6), wanted = 2 + 10 * next();
  ranges.push([low, high, wanted, ticks(low, high, wanted).map(t => t[1])]);
}
const spring = plots.find(p => p.kind === "spring"), fields = [...spring.card.querySelectorAll("input")], springs = [];
for (const values of [[], ["37", "0.05"], ["", "", "61", "0.3"]]) {
  values.forEach((v, i) => { if (v && fields[i]) { fields[i].value = v; fields[i].dispatchEvent(new Event("input")); } });
  springs.push(spring.lines.map(l => ({ axis: l.axis, ...modelOf(l), most: responseOf(l).most, left: responseOf(l).left, said: spring.card.textContent })));
}
// everything that can be clicked can be reached by keys
const keyless = [...document.querySelectorAll("canvas, .key, #program, tr[data-line]")].filter(e => e.tabIndex < 0 && !e.closest("#legend .note")).length;
const shares = [...document.querySelectorAll("#times table")].map(t => [...t.rows].slice(1).map(row => Number(row.cells[2].textContent)).reduce((a, b) => a + b, 0));
// two fingers that spread to three times their distance, on the contour and over time
const touch = (target, name, pointerId, x, y) => {
  const at = target.getBoundingClientRect();
  target.dispatchEvent(new PointerEvent(name, { pointerId, pointerType: "touch", clientX: at.left + x, clientY: at.top + y, bubbles: true }));
};
// fingers without a pointer cannot be captured
Element.prototype.setPointerCapture = () => {};
const pinch = target => {
  touch(target, "pointerdown", 11, 170, 100);
  touch(target, "pointerdown", 12, 230, 100);
  for (let i = 1; i <= 6; i++) {
    touch(target, "pointermove", 11, 170 - 10 * i, 100);
    touch(target, "pointermove", 12, 230 + 10 * i, 100);
  }
};
const lift = target => [11, 12].forEach(id => touch(target, "pointerup", id, 0, 0));
const scaleBefore = wide.scale, fixed = toData(wide, 200, 100), timeBefore = [...view.time];
pinch(contour);
const pinched = [wide.scale / scaleBefore, ...toScreen(wide, ...fixed)];
touch(contour, "pointerup", 12, 290, 100);
// one finger pans
touch(contour, "pointermove", 11, 150, 130);
const panned = toScreen(wide, ...fixed);
lift(contour);
touch(contour, "pointermove", 11, 300, 300);
const lifted = toScreen(wide, ...fixed);
showAll(wide);
pinch(plots[0].canvas);
const pinchedTime = (timeBefore[1] - timeBefore[0]) / (view.time[1] - view.time[0]);
lift(plots[0].canvas);
wholePlot(plots[0]);
contour.dispatchEvent(new WheelEvent("wheel", { deltaY: -500, clientX: box.left + x, clientY: box.top + y, cancelable: true }));
const probe = document.createElement("pre");
probe.id = "probe";
probe.textContent = JSON.stringify({
  errors, colours, tip: tipText, swatches, zoomed: wide.scale > before, label, stepped, hiddenByKey, dark, lit, unlit, chosen, chosenLine,
  ranges, springs, keyless, pinched, panned, lifted, pinchedTime, follows, inSpace, limits, turns, shares, span: [begin, end], cycles: runs.map(r => r.summary.cycles), buckets: runs.map(r => r.k.length),
  requests: performance.getEntriesByType("resource").length, points: runs.map(r => r.pk.length), within: runs.map(r => r.within),
});
document.body.append(probe);
</script>"##;

fn browser() -> Option<PathBuf> {
    if let Some(named) = std::env::var_os("KONTUR_BROWSER") {
        return Some(named.into());
    }
    let folders = std::env::var_os("PATH")?;
    let names = ["chromium", "chromium-browser", "google-chrome", "chrome"];
    let all = std::env::split_paths(&folders).flat_map(|f| names.map(|name| f.join(name)));
    all.into_iter().find(|p| p.is_file())
}

/// Writes the page of some programs into a folder.
fn write_page(folder: &Path, programs: &[&str], options: &[&str]) -> String {
    let path = |name: &str| folder.join(name).to_str().unwrap().to_owned();
    let mut words = vec!["report".to_owned()];
    for (i, text) in programs.iter().enumerate() {
        let name = path(&format!("{}.nc", ["a", "b", "c", "d"][i]));
        std::fs::write(&name, text).unwrap();
        words.push(name);
    }
    words.extend(["-o".to_owned(), path("page.html")]);
    words.extend(options.iter().map(|word| (*word).to_owned()));
    let done = command(&words);
    assert_eq!(done.exit, Exit::Finished, "{}", done.err);
    path("page.html")
}

/// Number of sheets of paper for the page of some programs.
fn printed(browser: &Path, programs: &[&str]) -> usize {
    let folder = tempfile::tempdir().unwrap();
    let page = write_page(folder.path(), programs, &[]);
    let [profile, paper] = ["profile", "page.pdf"].map(|name| folder.path().join(name));
    let out = Command::new(browser)
        .args(["--headless", "--no-sandbox", "--disable-gpu", "--no-pdf-header-footer"])
        .arg(format!("--user-data-dir={}", profile.display()))
        .arg(format!("--print-to-pdf={}", paper.display()))
        .arg(format!("file://{page}"))
        .output()
        .unwrap();
    let paper = std::fs::read(paper)
        .unwrap_or_else(|e| panic!("{e}: {}", String::from_utf8_lossy(&out.stderr)));
    let text = String::from_utf8_lossy(&paper);
    // the objects of pages, not that of their tree
    text.split("/Type /Page").skip(1).filter(|behind| !behind.starts_with('s')).count()
}

/// What the probe finds on the page of some programs.
fn look(browser: &Path, programs: &[&str], options: &[&str]) -> Value {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    write_page(folder.path(), programs, options);
    let page = std::fs::read_to_string(path("page.html")).unwrap();
    let page = page.replacen("<body>", &format!("<body>{PROBE}"), 1);
    let page = page.replacen("</body>", &format!("{REPORT}</body>"), 1);
    std::fs::write(path("probed.html"), page).unwrap();
    let out = Command::new(browser)
        .args(["--headless", "--no-sandbox", "--disable-gpu", "--window-size=1400,1200"])
        .args(["--host-resolver-rules=MAP * ~NOTFOUND", "--dump-dom"])
        .arg(format!("--user-data-dir={}", path("profile")))
        .arg(format!("file://{}", path("probed.html")))
        .output()
        .unwrap();
    let dom = String::from_utf8_lossy(&out.stdout);
    let probe = dom.split("<pre id=\"probe\">").nth(1).and_then(|s| s.split("</pre>").next());
    let probe = probe
        .unwrap_or_else(|| panic!("the script ended: {}", String::from_utf8_lossy(&out.stderr)));
    let text = probe.replace("&lt;", "<").replace("&gt;", ">").replace("&amp;", "&");
    serde_json::from_str(&text).unwrap()
}

const SQUARE: &str = "#VIB GUARD ON [MODE=1 FREQ=20]\nG01 X10 F6000\nY10\nX0\nY0\nM30\n";

/// The slave of a gantry has no deviation from the contour.
#[test]
fn a_page_with_an_axis_that_follows() {
    let Some(browser) = browser() else {
        println!("no browser found: nothing tested");
        return;
    };
    let machine = programs().join("machines/gantry");
    let page = look(&browser, &[SQUARE], &["-m", machine.to_str().unwrap()]);
    assert_eq!(page["errors"], serde_json::json!([]));
    let drawn = |card: &str| {
        let curves = page["swatches"].as_array().unwrap().iter();
        curves.filter(|c| c["card"] == card).filter_map(|c| c["name"].as_str()).collect::<Vec<_>>()
    };
    assert_eq!(drawn("Lag"), ["X", "Y", "Z", "X2"]);
    assert_eq!(drawn("Deviation from the contour by axis"), ["X", "Y", "Z"]);
    // a coupling begins behind the square
    let coupled = SQUARE.replace(
        "M30",
        "#SET AX [X,1,0][Y,2,1][C,3,3]\n#SET AX LINK [1, C=X]\n#ENABLE AX LINK [1]\nG01 X5\nM30",
    );
    let page = look(&browser, &[&coupled], &[]);
    assert_eq!(page["errors"], serde_json::json!([]));
}

#[test]
fn the_page_draws_and_answers() {
    let Some(browser) = browser() else {
        println!("no browser found: nothing tested");
        return;
    };
    let one = look(&browser, &[SQUARE], &[]);
    assert_eq!(one["errors"], serde_json::json!([]), "{one}");
    assert_eq!(one["requests"], 0, "{one}");
    let colours = one["colours"].as_array().unwrap();
    assert!(colours.len() >= 4 && colours.iter().all(|n| n.as_u64().unwrap() > 3), "{colours:?}");
    // line 4 goes back along Y = 10; the shaped set point is on its way there
    let tip = one["tip"].as_str().unwrap();
    assert!(tip.contains("line 4") && tip.contains("Y  set 10.0000"), "{tip}");
    assert_eq!(one["zoomed"], true);
    // without a pointer: one step over time is a cycle, a legend hides its curve, an arrow rotates the view in space
    assert!((one["stepped"].as_f64().unwrap() - 0.051).abs() < 1e-9, "{one}");
    assert_eq!((&one["hiddenByKey"], &one["turns"]), (&1.into(), &true.into()));
    assert!(one["label"].as_str().unwrap().contains("contour error at most"), "{one}");
    // the chosen line takes about a quarter of the time, and nothing is highlighted before and after
    let lit = one["lit"].as_f64().unwrap();
    assert!(lit > 0.1 && lit < 0.4, "{one}");
    assert_eq!((&one["dark"], &one["unlit"], &one["chosen"]), (&0.into(), &0.into(), &true.into()));
    assert_eq!(one["follows"], "2");
    assert!(
        one["inSpace"].as_u64().unwrap() > 3 && one["limits"].as_array().unwrap().len() > 1,
        "{one}"
    );
    // the same round numbers as in a picture
    for range in one["ranges"].as_array().unwrap() {
        let [low, high, wanted] = [0, 1, 2].map(|i| range[i].as_f64().unwrap());
        let picture: Vec<String> =
            ticks((low, high), wanted).into_iter().map(|(_, text)| text).collect();
        assert_eq!(range[3], serde_json::json!(picture), "{low} {high} {wanted}");
    }
    // the spring of the page against that of the library: with the setting of the guard first, then with each axis as it is selected
    let trace = run(SQUARE, &[]);
    let guard = (20.0, 0.1);
    let chosen = [[guard; 2], [(37.0, 0.05), guard], [(37.0, 0.05), (61.0, 0.3)]];
    for (spring, models) in one["springs"].as_array().unwrap().iter().zip(chosen) {
        for line in spring.as_array().unwrap() {
            let axis = usize::try_from(line["axis"].as_u64().unwrap()).unwrap();
            let (hz, damping) = models[axis];
            let mut model = SpringMass::new(hz, damping, CycleTime::DEFAULT).unwrap();
            let (mut most, mut left): (f64, f64) = (0.0, 0.0);
            for a in trace.axis(axis, |a| a.acc) {
                most = most.max(model.step(a).abs());
                if a.abs() >= 0.0005 {
                    left = model.amplitude();
                }
            }
            let near = |key: &str, to: f64| (line[key].as_f64().unwrap() - to).abs() < 1e-6;
            assert!(
                near("hz", hz) && near("most", most) && near("left", left),
                "{line} {most} {left}"
            );
            assert!(line["said"].as_str().unwrap().contains(&format!("{left:.5} mm")), "{line}");
        }
    }
    assert_eq!(one["keyless"], 0);
    // fingers that spread to three times their distance: so does the scale, about the point between them; one finger pans, none does not
    let near = |value: &Value, to: f64| (value.as_f64().unwrap() - to).abs() < 1e-6;
    for (i, to) in [3.0, 200.0, 100.0].into_iter().enumerate() {
        assert!(near(&one["pinched"][i], to), "{one}");
    }
    for moved in ["panned", "lifted"] {
        assert!(near(&one[moved][0], 240.0) && near(&one[moved][1], 130.0), "{one}");
    }
    assert!(near(&one["pinchedTime"], 3.0), "{one}");
    // all reasons together make up the time
    assert!((one["shares"][0].as_f64().unwrap() - 100.0).abs() < 0.5, "{one}");
}

/// With several runs the colour stands for the run and the dash for the axis, in every plot and its legend; actual values are thin.
#[test]
fn parts_and_several_runs() {
    let Some(browser) = browser() else {
        println!("no browser found: nothing tested");
        return;
    };
    // only the requested part is drawn, cycle by cycle
    let part = look(&browser, &[SQUARE], &["--window", "0.05..0.1"]);
    assert_eq!(part["errors"], serde_json::json!([]), "{part}");
    assert_eq!(part["span"], serde_json::json!([0.05, 0.1]));
    assert_eq!(part["buckets"], serde_json::json!([51]));
    let two = look(&browser, &[SQUARE, &SQUARE.replace("FREQ=20", "FREQ=40")], &[]);
    assert_eq!(two["errors"], serde_json::json!([]), "{two}");
    let swatches = two["swatches"].as_array().unwrap();
    let of = |card: &str, end: &str| -> Vec<(String, String, f64)> {
        let here = swatches.iter().filter(|s| s["card"] == card);
        let named = here.filter(|s| s["name"].as_str().unwrap().ends_with(end));
        let text = |s: &Value, key: &str| s[key].as_str().unwrap().to_owned();
        named
            .map(|s| (text(s, "colour"), text(s, "dash"), text(s, "width").parse().unwrap()))
            .collect()
    };
    for (card, end) in [("Lag", ""), ("Position", " set"), ("Position", " actual")] {
        let [x, y, z] = ["X", "Y", "Z"].map(|axis| of(card, &format!(" {axis}{end}")));
        assert_eq!((x.len(), y.len(), z.len()), (2, 2, 2), "{card}");
        assert!(
            x[0].0 != x[1].0 && x[0].0 == y[0].0 && y[0].0 == z[0].0,
            "colours: {x:?} {y:?} {z:?}"
        );
        assert!(
            x[0].1 == x[1].1 && x[0].1 != y[0].1 && y[0].1 != z[0].1 && x[0].1 != z[0].1,
            "{x:?} {y:?} {z:?}"
        );
    }
    assert!(of("Position", " X set")[0].2 > 1.5 * of("Position", " X actual")[0].2);
}

/// Where a plot has a bucket of several cycles, its values are not those of its first cycle: the tip names both ends.
#[test]
fn the_tip_names_the_span_of_a_bucket() {
    let Some(browser) = browser() else {
        println!("no browser found: nothing tested");
        return;
    };
    // 1 mm/s through the point that is looked at
    let page = look(&browser, &["N10 G00 Y10\nN20 G01 X10 F60\nN30 G00 Y0\nN40 M30\n"], &[]);
    let tip = page["tip"].as_str().unwrap();
    let numbers: Vec<f64> = tip.split_whitespace().filter_map(|word| word.parse().ok()).collect();
    assert!(tip.starts_with("t = ") && tip.contains("positions at the midpoint"), "{tip}");
    let [from, to] = [numbers[0], numbers[1]];
    let cycles = page["cycles"][0].as_f64().unwrap() / page["buckets"][0].as_f64().unwrap();
    assert!(
        cycles > 2.0 && ((to - from) * 1000.0 - (cycles - 1.0).round()).abs() < 1.5,
        "{tip} {cycles}"
    );
    let set = tip.split("X  set ").nth(1).unwrap().split_whitespace().next().unwrap();
    assert!((set.parse::<f64>().unwrap() - 5.0).abs() < 0.05, "{tip}");
}

/// One run or four runs fit on one sheet of paper.
#[test]
fn a_page_prints_on_one_sheet() {
    let Some(browser) = browser() else {
        println!("no browser found: nothing tested");
        return;
    };
    let other = |hz: u32| SQUARE.replace("FREQ=20", &format!("FREQ={hz}"));
    assert_eq!(printed(&browser, &[SQUARE]), 1);
    assert_eq!(printed(&browser, &[SQUARE, &other(40)]), 1);
    assert_eq!(printed(&browser, &[SQUARE, &other(40), &other(30), &other(25)]), 1);
}

/// A page for a million cycles opens: the amount of data in it is bounded, and it draws like any other.
#[test]
fn a_long_run_is_a_page_that_opens() {
    let Some(browser) = browser() else {
        println!("no browser found: nothing tested");
        return;
    };
    let long = look(&browser, &[&SQUARE.replace("F6000", "F2.4")], &[]);
    assert_eq!(long["errors"], serde_json::json!([]), "{long}");
    // up to the last of its cycles of 1 ms
    let [end, cycles] = [&long["span"][1], &long["cycles"][0]].map(|v| v.as_f64().unwrap());
    assert!(cycles > 999_000.0 && (end - (cycles - 1.0) * 1e-3).abs() < 1e-9, "{long}");
    let buckets = long["buckets"][0].as_u64().unwrap();
    assert!(buckets > 1000 && buckets < 20_000, "{buckets}");
    let colours = long["colours"].as_array().unwrap();
    assert!(colours.len() >= 4 && colours.iter().all(|n| n.as_u64().unwrap() > 3), "{colours:?}");
}
