//! B-spline through runs of short linear blocks (`#HSC ON [BSPLINE]`).

/// Parameters of `#HSC [BSPLINE]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SplineSettings {
    /// PATH_DEV in mm.
    pub path_dev_mm: f64,
}
