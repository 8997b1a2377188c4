//! Parameters of splines.

/// Parameters of `#HSC [BSPLINE]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SplineSettings {
    /// `PATH_DEV` in mm, default 0.2: largest deviation from the polygon; 0 = not monitored. On chords `c` of an arc of
    /// radius `r`, values below about `c^2 / (10 r)` cost speed.
    pub path_dev_mm: f64,
    /// `TRACK_DEV` in deg, default 5: largest deviation of the axes outside the feed group; 0 = not monitored.
    pub track_dev_deg: f64,
    /// `AUTO_OFF_PATH`, default off: the spline ends where `PATH_DEV` would be exceeded.
    pub off_at_path_dev: bool,
    /// `AUTO_OFF_TRACK`, default off: the spline ends where `TRACK_DEV` would be exceeded.
    pub off_at_track_dev: bool,
    /// `AUTO_OFF_G00`, default on: rapid blocks are not part of the spline (Assumption: default).
    pub off_at_rapid: bool,
    /// `MAX_PATH_LENGTH` in mm, default 0 = unlimited: longer blocks are not part of the spline.
    pub max_length_mm: f64,
    /// `MAX_ANGLE` in deg, default 180: the spline ends at corners that turn by more.
    pub max_angle_deg: f64,
}

impl SplineSettings {
    /// The limit that a programmed or listed `MAX_ANGLE` in deg sets.
    ///
    /// Assumption: 0, the default of P-CHAN-00125, is no limit, as for the other limits; read literally it would end a
    /// spline at every block.
    pub fn angle_limit_deg(max_angle_deg: f64) -> f64 {
        if max_angle_deg > 0.0 { max_angle_deg.min(180.0) } else { 180.0 }
    }
}

impl Default for SplineSettings {
    fn default() -> Self {
        Self {
            path_dev_mm: 0.2,
            track_dev_deg: 5.0,
            off_at_path_dev: false,
            off_at_track_dev: false,
            off_at_rapid: true,
            max_length_mm: 0.0,
            max_angle_deg: 180.0,
        }
    }
}
