//! The entries `filter[0..2]` of an axis list: which of them are standard filters, which one is the HSC filter.
//!
//! Source: TF5200 axis filters; P-AXIS-00319, 00140, 00153, 00204.
//!
//! Order of calls: the entries of the list, [`Cascade::design`], then the [`shaping`](crate::shaping) chain of the axis
//! from its filters.
//!
//! ```
//! use kontur_filters::cascade::{Cascade, FilterEntry, ListedPrototype, ListedType};
//! use kontur_filters::hsc::HscKind;
//! use kontur_filters::iir::FilterKind;
//! use kontur_filters::time::CycleTime;
//!
//! let hsc = FilterEntry {
//!     prototype: ListedPrototype::Hsc,
//!     listed_type: Some(ListedType::Hsc(HscKind::Mean)),
//!     ..FilterEntry::default()
//! };
//! let low_pass = FilterEntry {
//!     enable: true,
//!     listed_type: Some(ListedType::Standard(FilterKind::LowPass)),
//!     order: 2,
//!     f_hz: 30.0,
//!     ..FilterEntry::default()
//! };
//! let cascade = Cascade::design(&[hsc, low_pass], false, CycleTime::DEFAULT);
//! assert!(cascade.hsc.is_some() && cascade.filters.len() == 1 && cascade.issues.is_empty());
//! // the HSC filter has to be the first one of its axis: 110501, at the entry 1
//! let wrong = Cascade::design(&[low_pass, hsc], false, CycleTime::DEFAULT);
//! assert_eq!(wrong.issues[0].0, 1);
//! ```

use crate::hsc::{HscConfig, HscKind};
use crate::iir::prototype::Prototype;
use crate::iir::{AxisFilter, FilterConfig, FilterKind};
use crate::issue::FilterIssue;
use crate::time::CycleTime;

/// `filter[i].type`. Source: P-AXIS-00204.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ListedType {
    /// A type of the standard filters.
    Standard(FilterKind),
    /// A type of the HSC filters.
    Hsc(HscKind),
}

impl ListedType {
    /// The type of a number of the list.
    ///
    /// # Errors
    ///
    /// 110239 for the reserved numbers 7 and 9 and for those outside 1 to 12.
    pub const fn from_number(number: u32) -> Result<Self, FilterIssue> {
        Ok(match number {
            1 => Self::Standard(FilterKind::LowPass),
            2 => Self::Standard(FilterKind::HighPass),
            3 => Self::Standard(FilterKind::BandPass),
            4 => Self::Standard(FilterKind::BandStop),
            5 => Self::Standard(FilterKind::AllPass),
            6 => Self::Standard(FilterKind::Pt1),
            8 => Self::Hsc(HscKind::Mean),
            10 => Self::Standard(FilterKind::Pt2),
            11 => Self::Standard(FilterKind::TimeDelay),
            12 => Self::Hsc(HscKind::NoVib),
            _ => return Err(FilterIssue::TypeNotPermitted { number }),
        })
    }
}

/// `filter[i].prototype`. Source: P-AXIS-00153.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ListedPrototype {
    /// 1 to 3: standard filters.
    Standard(Prototype),
    /// 5: HSC filters.
    Hsc,
}

impl ListedPrototype {
    /// The prototype of a number of the list; `None` for 4, which is not assigned, and outside 1 to 5.
    pub const fn from_number(number: u32) -> Option<Self> {
        Some(match number {
            1 => Self::Standard(Prototype::CritDamping),
            2 => Self::Standard(Prototype::Butterworth),
            3 => Self::Standard(Prototype::Bessel),
            5 => Self::Hsc,
            _ => return None,
        })
    }
}

/// One entry `filter[i]` of an axis list.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilterEntry {
    /// Whether a standard filter is on, default off; ignored for HSC (P-AXIS-00319).
    pub enable: bool,
    /// Type; by default low-pass, or mean with the prototype HSC (P-AXIS-00204).
    pub listed_type: Option<ListedType>,
    /// Prototype (P-AXIS-00153).
    pub prototype: ListedPrototype,
    /// See [`FilterConfig::order`] and [`HscConfig::order`] (P-AXIS-00140).
    pub order: u32,
    /// See [`FilterConfig::f_hz`] and [`HscConfig::f_hz`] (P-AXIS-00067).
    pub f_hz: f64,
    /// See [`FilterConfig::q`] (P-AXIS-00080).
    pub q: f64,
    /// See [`FilterConfig::share_ratio`] (P-AXIS-00164).
    pub share_ratio: f64,
    /// See [`FilterConfig::time_constant_us`] and [`HscConfig::time_constant_us`] (P-AXIS-00357).
    pub time_constant_us: u32,
}

impl Default for FilterEntry {
    fn default() -> Self {
        let FilterConfig { prototype, order, f_hz, q, share_ratio, time_constant_us, .. } =
            FilterConfig::default();
        Self {
            enable: false,
            listed_type: None,
            prototype: ListedPrototype::Standard(prototype),
            order,
            f_hz,
            q,
            share_ratio,
            time_constant_us,
        }
    }
}

/// The result of the entries of an axis.
#[derive(Clone, Debug)]
pub struct Cascade {
    /// The standard filters that are on, in list order.
    pub filters: Vec<AxisFilter>,
    /// The HSC filter that `#FILTER ON [HSC]` switches on.
    pub hsc: Option<HscConfig>,
    /// The issues, each with the index of its entry.
    pub issues: Vec<(usize, FilterIssue)>,
}

impl Cascade {
    /// Sorts and designs the entries of an axis; a spindle has no HSC filter.
    pub fn design(entries: &[FilterEntry], spindle: bool, cycle: CycleTime) -> Self {
        let mut cascade = Self { filters: Vec::new(), hsc: None, issues: Vec::new() };
        let mut hsc_seen = false;
        for (index, entry) in entries.iter().enumerate() {
            match (entry.prototype, entry.listed_type) {
                (ListedPrototype::Hsc, listed) => {
                    let kind = match listed {
                        None => Ok(HscKind::Mean),
                        Some(ListedType::Hsc(kind)) => Ok(kind),
                        Some(ListedType::Standard(_)) => Err(FilterIssue::HscPrototype),
                    };
                    match kind.and_then(|kind| permitted(kind, hsc_seen, index, spindle)) {
                        Ok(kind) => cascade.hsc = Some(entry.hsc(kind)),
                        Err(issue) => cascade.issues.push((index, issue)),
                    }
                    hsc_seen = true;
                }
                (ListedPrototype::Standard(_), Some(ListedType::Hsc(_))) => {
                    cascade.issues.push((index, FilterIssue::HscPrototype));
                }
                (ListedPrototype::Standard(prototype), listed) if entry.enable => {
                    let kind = match listed {
                        Some(ListedType::Standard(kind)) => kind,
                        _ => FilterKind::LowPass,
                    };
                    let (filter, issues) =
                        AxisFilter::design(&entry.standard(kind, prototype), cycle);
                    cascade.filters.extend(filter);
                    cascade.issues.extend(issues.into_iter().map(|issue| (index, issue)));
                }
                _ => {}
            }
        }
        cascade
    }
}

/// Whether an axis may have the HSC filter `kind` here.
fn permitted(
    kind: HscKind,
    hsc_seen: bool,
    index: usize,
    spindle: bool,
) -> Result<HscKind, FilterIssue> {
    if spindle {
        Err(FilterIssue::HscOnSpindle)
    } else if hsc_seen {
        Err(FilterIssue::SecondHsc)
    } else if index > 0 {
        Err(FilterIssue::HscNotFirst)
    } else {
        Ok(kind)
    }
}

impl FilterEntry {
    /// The filter of the additional interface of an axis, `None` if it is off, and its issues.
    ///
    /// For PT1 and PT2 the order is only a switch: the default 2 is not a mistake in a list that sets nothing but the
    /// type. Source: P-AXIS-00735 to P-AXIS-00742.
    pub fn additional(&self, cycle: CycleTime) -> (Option<AxisFilter>, Vec<FilterIssue>) {
        if !self.enable {
            return (None, Vec::new());
        }
        let (ListedPrototype::Standard(prototype), Some(ListedType::Standard(kind))) =
            (self.prototype, self.listed_type)
        else {
            return (None, vec![FilterIssue::HscOnInterface]);
        };
        let order = match kind {
            FilterKind::Pt1 => self.order.min(1),
            FilterKind::Pt2 => 2 * self.order.min(1),
            _ => self.order,
        };
        AxisFilter::design(&FilterConfig { order, ..self.standard(kind, prototype) }, cycle)
    }

    fn hsc(&self, kind: HscKind) -> HscConfig {
        let Self { order, time_constant_us, f_hz, share_ratio, .. } = *self;
        HscConfig { kind, order, time_constant_us, f_hz, share_ratio }
    }

    fn standard(&self, kind: FilterKind, prototype: Prototype) -> FilterConfig {
        let Self { order, f_hz, q, share_ratio, time_constant_us, .. } = *self;
        FilterConfig { kind, prototype, order, f_hz, q, share_ratio, time_constant_us }
    }
}
