//! `#OVERRIDE`, `X[OVERRIDE ..]` and G166.
//!
//! Source: TF5200 programming manual: the smallest of the moved axes acts, times the override of the path.

/// Programmed overrides, 1.0 = 100 %.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::exec) struct Overrides {
    feed: f64,
    rapid: f64,
    axis_feed: Vec<f64>,
    axis_rapid: Vec<f64>,
}

impl Overrides {
    pub(in crate::exec) fn new(axes: usize) -> Self {
        Self { feed: 1.0, rapid: 1.0, axis_feed: vec![1.0; axes], axis_rapid: vec![1.0; axes] }
    }

    /// Sets the given overrides, of the path or of one axis.
    pub(in crate::exec) fn set(
        &mut self,
        axis: Option<usize>,
        feed: Option<f64>,
        rapid: Option<f64>,
    ) {
        let (f, r) = match axis {
            Some(axis) => (&mut self.axis_feed[axis], &mut self.axis_rapid[axis]),
            None => (&mut self.feed, &mut self.rapid),
        };
        *f = feed.unwrap_or(*f);
        *r = rapid.unwrap_or(*r);
    }

    /// Whether no axis has an override: the ratio is then the same for all axes.
    pub(in crate::exec) fn are_alike(&self) -> bool {
        let mut axes = [&self.axis_feed, &self.axis_rapid].into_iter();
        axes.all(|axes| axes.windows(2).all(|pair| pair[0].to_bits() == pair[1].to_bits()))
    }

    /// Ratio for a block that moves these axes.
    pub(in crate::exec) fn ratio(&self, rapid: bool, moved: impl Iterator<Item = usize>) -> f64 {
        let (path, axes) =
            if rapid { (self.rapid, &self.axis_rapid) } else { (self.feed, &self.axis_feed) };
        let least = moved.map(|axis| axes[axis]).fold(f64::INFINITY, f64::min);
        if least.is_finite() { path * least } else { path }
    }
}
