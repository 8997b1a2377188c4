//! Curves as CAM systems write them: hundreds of chords under the Vibration Guard and other filters, the filter switched or a
//! dwell between some of them.

use super::measure::Case;
use super::program::{Writer, dynamics, filter, off, reach_of_guard, rounded};
use kontur_kit::Random;
use std::f64::consts::TAU;

/// Points of a curve at about equal distances, four decimals each.
fn curve(r: &mut Random) -> Vec<[f64; 3]> {
    let chord = r.log(0.02, 2.0);
    let radius = r.log(0.5, 50.0);
    let count = 60 + r.below(240);
    let turn = (chord / radius).min(1.0);
    let at = |i: usize| turn * i as f64;
    let circle = |a: f64, radius: f64| [radius * libm::sin(a), radius * (1.0 - libm::cos(a)), 0.0];
    let points: Vec<[f64; 3]> = match r.below(5) {
        0 => (1..=count).map(|i| circle(at(i), radius)).collect(),
        // a spiral
        1 => {
            let pitch = radius * r.between(0.02, 0.3);
            (1..=count).map(|i| circle(at(i), radius + pitch * at(i) / TAU)).collect()
        }
        // a trochoid
        2 => {
            let ahead = radius * r.between(0.05, 0.5);
            let place = |i: usize| {
                let [x, y, _] = circle(at(i), radius);
                [x + ahead * at(i) / TAU, y, 0.1 * libm::sin(at(i) / 3.0)]
            };
            (1..=count).map(place).collect()
        }
        // rows of a wavy surface
        3 => {
            let (row, apart) = (10 + r.below(40), rounded(r.log(0.1, 1.0)));
            let (mut x, mut y, mut forward) = (0.0, 0.0, true);
            let step = |i: usize| {
                if i.is_multiple_of(row) {
                    (y, forward) = (y + apart, !forward);
                } else {
                    x += if forward { chord } else { -chord };
                }
                [x, y, 0.5 * libm::sin(x)]
            };
            (1..=count).map(step).collect()
        }
        // a curve that bends more and less, with a corner now and then
        _ => {
            let (mut p, mut heading, mut bend) = ([0.0; 3], 0.0, 0.0);
            let step = |_| {
                bend = 0.9 * bend + turn * r.between(-0.5, 0.5);
                heading += if r.chance(0.02) { r.between(-3.1, 3.1) } else { bend };
                let l = chord * r.between(0.3, 1.0);
                p = [p[0] + l * libm::cos(heading), p[1] + l * libm::sin(heading), p[2] + l * bend];
                p
            };
            (1..=count).map(step).collect()
        }
    };
    let printed = |c: f64| (c * 1e4).round() / 1e4;
    points.into_iter().map(|p| p.map(printed)).collect()
}

/// The guard at any frequency that machines vibrate with.
fn guard(r: &mut Random, tolerance_mm: f64, cycle_us: u32) -> (String, Vec<String>, usize) {
    let (mode, freq_hz) = (1 + r.below(4), rounded(r.log(10.0, 100.0)));
    let damping = rounded(r.between(0.0, 0.3));
    let command = format!(
        "#VIB GUARD ON [MODE={mode} FREQ={freq_hz} DAMPING={damping} AX_DEV={tolerance_mm}]"
    );
    let reach = reach_of_guard(mode, freq_hz, damping, 1e-6 * f64::from(cycle_us));
    (command, Vec::new(), reach)
}

/// The curve of a seed as a program.
pub(crate) fn case(seed: u64) -> Case {
    let mut r = Random::new(seed);
    let cycle_us = r.pick(&[500, 1000, 2000, 4000]);
    let slope = r.pick(&["TRAPEZ", "SIN2", "HSC"]);
    let tolerance_mm = rounded(r.log(2e-3, 2e-1));
    let (command, mut settings, reach) = if r.chance(0.4) {
        filter(&mut r, tolerance_mm, cycle_us)
    } else {
        guard(&mut r, tolerance_mm, cycle_us)
    };
    settings.push(format!("kontur.cycle_time_us={cycle_us}"));
    settings.extend(dynamics(&mut r));
    let mut w = Writer::new();
    w.put("%P");
    w.put(&format!("G90 G01 F{}", r.log(500.0, 20000.0).round()));
    w.put(&format!("#SLOPE [TYPE={slope}]"));
    w.put(&command);
    let every = 5 + r.below(60);
    if r.chance(0.2) {
        let dwell = format!("G04 {}", rounded(r.log(1e-3, 0.1)));
        w.switch = Some(([dwell.clone(), dwell], every));
    } else if r.chance(0.2) {
        w.switch = Some(([off(&command).to_owned(), command], every));
    }
    for p in curve(&mut r) {
        w.line_to("G01", p);
    }
    w.put("M30");
    w.case(settings, tolerance_mm, reach)
}
