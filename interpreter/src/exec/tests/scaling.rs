//! `#SCALE` has the same effect as a program in which the coordinates are written larger or smaller.

use super::{clean, points};
use kontur_kit::Random;

#[track_caller]
fn assert_alike(a: &str, b: &str) {
    let (p, q) = (points(a), points(b));
    assert_eq!(p.len(), q.len(), "{a}\n{b}");
    for (p, q) in p.iter().zip(&q) {
        let near = p.iter().zip(q).all(|(p, q)| (p - q).abs() < 1e-9);
        assert!(near, "{p:?} is not {q:?}:\n{a}\n{b}");
    }
}

/// A non-zero multiple of a quarter: twice and half of it are written exactly.
fn quarter(random: &mut Random) -> f64 {
    let steps = 1.0 + random.below(80) as f64;
    if random.below(2) == 0 { steps / 4.0 } else { -steps / 4.0 }
}

/// A random block; `[x, y, z]` are the factors by which its coordinates are written larger.
fn block(random: &mut Random, arcs: bool, [x, y, z]: [f64; 3]) -> String {
    let (a, b, c) = (quarter(random), quarter(random), quarter(random));
    let (ax, by, cz) = (a * x, b * y, c * z);
    let radius = libm::hypot(a, b).ceil() * x;
    match random.below(if arcs { 12 } else { 7 }) {
        0 => format!("G90 G01 X{ax}\n"),
        1 => format!("G90 G00 Y{by} Z{cz}\n"),
        2 => format!("G91 G01 X{ax} Y{by} Z{cz}\n"),
        3 => format!("G92 X{a} Y{b}\nG90 G01 X{ax} Y{by}\n"),
        4 => format!("G54 G90 G01 X{ax} Y{by}\nG53 X{ax}\n"),
        5 => format!("#CS OFF ALL\n#CS ON [{a}, {b}, {c}, 0, 0, 30]\nG90 G01 X{ax} Y{by} Z{cz}\n"),
        6 => format!("#CS OFF ALL\nG90 G01 Y{by} X{ax} Z{cz}\n"),
        7 => format!("G91 G02 X{} Y{} I{ax} J{by}\n", 2.0 * ax, 2.0 * by),
        8 => format!("G91 G03 X{ax} Y{by} R{radius}\n"),
        9 => format!("G91 G03 X{ax} Y{by} R{radius} Z{cz}\n"),
        10 => format!("G91 G02 X{} I{ax} K{} Z{cz}\n", 2.0 * ax, cz.abs() / 2.0),
        _ => format!("G90 G01 X0 Y0\nG161 G02 X{} I{ax} J{by} Y{}\nG162\n", 2.0 * ax, 2.0 * by),
    }
}

fn blocks(random: &mut Random, arcs: bool, factors: [f64; 3]) -> String {
    (0..12).map(|_| block(random, arcs, factors)).collect()
}

const HEAD: &str = "V.G.NP[1].V.X=3 V.G.NP[1].V.Y=-4\nF1000 G01 X0 Y0 Z0\n";

#[test]
fn scaled_programs_are_programs_written_larger() {
    for seed in 1..200 {
        let k = [2.0, 0.5, 4.0][seed as usize % 3];
        let plain = blocks(&mut Random::new(seed), true, [1.0; 3]);
        let larger = blocks(&mut Random::new(seed), true, [k; 3]);
        let scaled = format!("{HEAD}#SCALE ON X{k} Y{k} Z{k}\n{plain}M30\n");
        assert_alike(&scaled, &format!("{HEAD}{larger}M30\n"));
    }
}

#[test]
fn straight_motions_take_the_factor_of_each_axis() {
    for seed in 1..100 {
        let plain = blocks(&mut Random::new(seed), false, [1.0; 3]);
        let larger = blocks(&mut Random::new(seed), false, [2.0, 0.5, 1.0]);
        let scaled = format!("{HEAD}#SCALE X2 Y0.5\n#SCALE ON\n{plain}M30\n");
        assert_alike(&scaled, &format!("{HEAD}{larger}M30\n"));
    }
}

/// Factors are kept while scaling is off, and switching moves nothing.
#[test]
fn factors_outlive_scaling() {
    assert_alike(
        "F1000 G01 X1\n#SCALE X2\nX5\n#SCALE ON\nX6\n#SCALE OFF\nX7\n#SCALE ON Y3\nX8 Y1\nM30\n",
        "F1000 G01 X1\nX5\nX12\nX7\nX16 Y3\nM30\n",
    );
    // feed rates, the tool radius and offsets are not scaled
    assert_alike(
        "V.G.WZ_AKT.R=2\nF1000\n#SCALE ON X2 Y2\nG01 G41 X5 Y5\nX20\nY15\nG40 X0 Y20\nM30\n",
        "V.G.WZ_AKT.R=2\nF1000\nG01 G41 X10 Y10\nX40\nY30\nG40 X0 Y40\nM30\n",
    );
    let feeds = |text: &str| clean(text).blocks().iter().map(|b| b.feed).collect::<Vec<_>>();
    assert_eq!(feeds("#SCALE ON X2\nG01 F500 X1\nM30\n"), feeds("G01 F500 X2\nM30\n"));
    // in inch, in subroutines, from variables
    assert_alike(
        "%L SUB\nG91 X1\nM17\n%MAIN\nP1=3\n#SCALE ON XP1 Y[1+2]\nG01 F100\nLL SUB\nG90 G70 X2 Y1\nM30\n",
        "G01 F100 X3\nG70 X6 Y3\nM30\n",
    );
}

/// Positioning axes, with the factor of their targets.
#[test]
fn independent_axes_are_scaled() {
    let targets = |text: &str| {
        let run = clean(text);
        let found: Vec<f64> = run
            .events()
            .into_iter()
            .filter_map(|e| match e {
                super::Event::Independent { motion, .. } => Some(motion.to_mm),
                _ => None,
            })
            .collect();
        found
    };
    let bracket = |to: f64| format!("Z[INDP_SYN G90 G01 FEED=500 POS={to}]\n");
    let scaled = format!("#SCALE ON Z2\nG01 F500 X1\n{}M30\n", bracket(7.0));
    assert_eq!(targets(&scaled), targets(&format!("G01 F500 X1\n{}M30\n", bracket(14.0))));
}
