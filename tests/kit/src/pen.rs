//! A pen that draws contours in a plane.

/// Place and direction of the pen.
#[derive(Clone, Copy, Debug, Default)]
pub struct Pen {
    /// Where it is.
    pub at: [f64; 2],
    /// Direction in rad, counter-clockwise from the first axis.
    pub heading: f64,
}

impl Pen {
    /// Moves ahead; returns where it is then.
    pub fn go(&mut self, length: f64) -> [f64; 2] {
        let (sin, cos) = libm::sincos(self.heading);
        self.at = [self.at[0] + length * cos, self.at[1] + length * sin];
        self.at
    }

    /// Moves along an arc that turns by an angle in rad, to the left if it is positive; returns its centre.
    pub fn turn(&mut self, radius: f64, sweep: f64) -> [f64; 2] {
        let side = radius.copysign(sweep);
        let (sin, cos) = libm::sincos(self.heading);
        let centre = [self.at[0] - side * sin, self.at[1] + side * cos];
        self.heading += sweep;
        let (sin, cos) = libm::sincos(self.heading);
        self.at = [centre[0] + side * sin, centre[1] - side * cos];
        centre
    }
}
