//! Writes `surface_scan.nc`: rows over a wavy surface in straight blocks, as a CAM system puts them out.
//!
//! `cargo run --release --example surface_scan > programs/surface_scan.nc` writes the program of this folder;
//! `... --example surface_scan -- 1000000` a longer one with at least that many blocks (rows further along Y).
//!
//! The surface is `z = 1.5 sin(2 pi x / 30) cos(2 pi y / 40)` mm; rows along X are 60 mm long and 0.5 mm apart, points
//! 0.25 mm apart, joined by half circles of small chords outside the surface, so that the path never has a corner: its
//! curvature alone limits its speed. Positions have four decimals, the control's increment of 0.1 um.

use std::io::{BufWriter, Write};

const LENGTH_MM: f64 = 60.0;
const STEP_MM: f64 = 0.25;
const ROW_MM: f64 = 0.5;
const TURN_CHORDS: u32 = 24;

fn height(x: f64, y: f64) -> f64 {
    let turn = 2.0 * std::f64::consts::PI;
    1.5 * libm::sin(turn * x / 30.0) * libm::cos(turn * y / 40.0)
}

fn main() -> std::io::Result<()> {
    let wanted: u64 = std::env::args().nth(1).and_then(|a| a.parse().ok()).unwrap_or(20_000);
    let mut out = BufWriter::new(std::io::stdout().lock());
    writeln!(out, "; wavy surface in short blocks, written by surface_scan.rs")?;
    writeln!(out, "%SURFACE_SCAN")?;
    writeln!(out, "G71 G90 G17")?;
    writeln!(out, "#SLOPE [TYPE=HSC]")?;
    writeln!(out, "G00 X0 Y0 Z{:.4}", height(0.0, 0.0))?;
    writeln!(out, "G01 F3000")?;
    let points = (LENGTH_MM / STEP_MM) as u32;
    let mut blocks = 0;
    let mut row: u32 = 0;
    while blocks < wanted {
        let y = f64::from(row) * ROW_MM;
        let forward = row.is_multiple_of(2);
        for i in 1..=points {
            let along = f64::from(i) * STEP_MM;
            let x = if forward { along } else { LENGTH_MM - along };
            writeln!(out, "X{x:.4} Y{y:.4} Z{:.4}", height(x, y))?;
            blocks += 1;
        }
        let (centre_x, side) = if forward { (LENGTH_MM, 1.0) } else { (0.0, -1.0) };
        for i in 1..=TURN_CHORDS {
            let angle = std::f64::consts::PI * f64::from(i) / f64::from(TURN_CHORDS);
            let x = centre_x + side * 0.5 * ROW_MM * libm::sin(angle);
            let dy = 0.5 * ROW_MM * (1.0 - libm::cos(angle));
            writeln!(out, "X{x:.4} Y{:.4} Z{:.4}", y + dy, height(x, y + dy))?;
            blocks += 1;
        }
        row += 1;
    }
    writeln!(out, "M30")?;
    out.flush()
}
