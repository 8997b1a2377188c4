//! Demands of the tolerance (`AX_DEV`) on a block, kept with the block when it is planned again.

/// Demands on one block and on the boundary before it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Asked {
    /// Velocity cap at the boundary in mm/s.
    pub(crate) cap: f64,
    /// Full stop at the boundary with this many cycles of dwell.
    pub(crate) stop: Option<u32>,
    /// Velocity cap of the block in mm/s.
    pub(crate) feed: f64,
    /// Share of its acceleration that the block may use.
    pub(crate) acceleration: f64,
}

impl Default for Asked {
    /// No demands.
    fn default() -> Self {
        Self { cap: f64::INFINITY, stop: None, feed: f64::INFINITY, acceleration: 1.0 }
    }
}
