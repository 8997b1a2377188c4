//! Writes `freeform_pocket.nc`: the wall of a freeform pocket, finished in one winding, as a CAM system puts it out.
//!
//! `cargo run --release --example freeform_pocket > programs/freeform_pocket.nc` writes the program of this folder.
//!
//! The wall is `r = 18 + 3 cos(3 phi) + 1.2 sin(5 phi)` mm, narrower by 0.3 mm per millimetre of depth; the tool sinks by
//! 1 mm per turn, eight turns, in chords of about 0.3 mm. The first point is the origin, so that the run is the path
//! alone. Positions have four decimals, the control's increment of 0.1 um.

use std::f64::consts::PI;
use std::io::{BufWriter, Write};

const TURNS: f64 = 8.0;
const CHORD_MM: f64 = 0.3;

fn radius(phi: f64) -> f64 {
    18.0 + 3.0 * libm::cos(3.0 * phi) + 1.2 * libm::sin(5.0 * phi) - 0.3 * phi / (2.0 * PI)
}

fn main() -> std::io::Result<()> {
    let mut out = BufWriter::new(std::io::stdout().lock());
    writeln!(out, "; wall of a freeform pocket in short blocks, written by freeform_pocket.rs")?;
    writeln!(out, "%FREEFORM_POCKET")?;
    writeln!(out, "G71 G90 G17")?;
    writeln!(out, "#SLOPE [TYPE=HSC]")?;
    writeln!(out, "G01 F4800")?;
    let mut phi = 0.0;
    while phi < 2.0 * PI * TURNS {
        // the wall runs at an angle to the circle of its radius
        let slope = (radius(phi + 1e-6) - radius(phi)) / 1e-6;
        phi += CHORD_MM / libm::hypot(radius(phi), slope);
        let (x, y) = (radius(phi) * libm::cos(phi) - radius(0.0), radius(phi) * libm::sin(phi));
        writeln!(out, "X{x:.4} Y{y:.4} Z{:.4}", -phi / (2.0 * PI))?;
    }
    writeln!(out, "M30")?;
    out.flush()
}
