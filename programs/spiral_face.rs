//! Writes `spiral_face.nc`: a face milled in one spiral from the middle outwards, as a CAM system puts it out.
//!
//! `cargo run --release --example spiral_face > programs/spiral_face.nc` writes the program of this folder.
//!
//! The radius grows by 1.2 mm per turn from 3 mm to 25 mm; chords deviate from the spiral by 1 um, so they grow with the
//! radius from 0.15 mm to 0.45 mm. Inside, the kinks between them limit the speed of the path, outside the feed. The
//! first point is the origin, so that the run is the path alone. Positions have four decimals, the control's increment
//! of 0.1 um.

use std::f64::consts::PI;
use std::io::{BufWriter, Write};

const FIRST_RADIUS_MM: f64 = 3.0;
const LAST_RADIUS_MM: f64 = 25.0;
const STEP_MM: f64 = 1.2;
const CHORD_ERROR_MM: f64 = 0.001;

fn radius(phi: f64) -> f64 {
    FIRST_RADIUS_MM + STEP_MM * phi / (2.0 * PI)
}

fn main() -> std::io::Result<()> {
    let mut out = BufWriter::new(std::io::stdout().lock());
    writeln!(out, "; face milled in a spiral, written by spiral_face.rs")?;
    writeln!(out, "%SPIRAL_FACE")?;
    writeln!(out, "G71 G90 G17")?;
    writeln!(out, "#SLOPE [TYPE=HSC]")?;
    writeln!(out, "G01 F9000")?;
    let mut phi = 0.0;
    loop {
        // a chord of angle p deviates by r p^2 / 8
        phi += (8.0 * CHORD_ERROR_MM / radius(phi)).sqrt();
        let (x, y) = (radius(phi) * libm::cos(phi) - radius(0.0), radius(phi) * libm::sin(phi));
        writeln!(out, "X{x:.4} Y{y:.4}")?;
        if radius(phi) >= LAST_RADIUS_MM {
            break;
        }
    }
    writeln!(out, "M30")?;
    out.flush()
}
