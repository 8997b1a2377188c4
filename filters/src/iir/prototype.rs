//! Analog low-pass prototypes: factors `1 / (1 + a P + b P^2)` with `P = s / (2 pi f)`.
//!
//! All are normalised to -3.01 dB at `P = j`, whatever prototype and order. The vendor calls the band edges the -3 dB
//! points and says that the steepest slope of the step response hardly depends on the order, which is only true of this
//! normalisation.
//!
//! Source: TF5200 axis filters, P-AXIS-00153. Assumption: the -3 dB normalisation of critical damping and Bessel.
//!
//! Order of calls: the factors are the first step of a design; [`transform`](super::transform) makes sections of them.
//!
//! ```
//! use kontur_filters::iir::prototype::Prototype;
//!
//! // at `P = j` every one of them lets half of the power through
//! for prototype in Prototype::ALL {
//!     let power: f64 =
//!         prototype.terms(4).iter().map(|t| (1.0 - t.b).powi(2) + t.a * t.a).product();
//!     assert!((power - 2.0).abs() < 1e-3);
//! }
//! ```

use std::f64::consts::{PI, SQRT_2};

/// One factor of the denominator, `1 + a P + b P^2`; first order if `b` is 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Term {
    /// Coefficient of P.
    pub a: f64,
    /// Coefficient of P squared.
    pub b: f64,
}

/// Shape of the transition between passband and stopband. Source: P-AXIS-00153.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Prototype {
    /// 1: equal real poles, the step response does not overshoot.
    CritDamping,
    /// 2: flattest passband; the step response overshoots, more so with a higher order.
    Butterworth,
    /// 3: flattest group delay; the step response overshoots by less than 1 %.
    Bessel,
}

impl Prototype {
    /// Every prototype, by its number.
    pub const ALL: [Self; 3] = [Self::CritDamping, Self::Butterworth, Self::Bessel];

    /// The factors of the low-pass of `order` 1 to 6; higher orders give order 6.
    pub fn terms(self, order: u32) -> Vec<Term> {
        let order = order.min(6);
        match self {
            Self::CritDamping => critical_damping(order),
            Self::Butterworth => butterworth(order),
            Self::Bessel => table(&BESSEL, order),
        }
    }

    /// The factors of the all-pass of `order` 1 to 6.
    ///
    /// BESSEL: normalised so that the group delay has fallen to 1/sqrt(2) of its low-frequency value at `P = j`, the
    /// textbook design. Assumption: other prototypes use their low-pass factors; the vendor recommends BESSEL.
    pub(crate) fn all_pass_terms(self, order: u32) -> Vec<Term> {
        match self {
            Self::Bessel => table(&BESSEL_ALL_PASS, order.min(6)),
            _ => self.terms(order),
        }
    }
}

/// n equal poles: `alpha = sqrt(2^(1/n) - 1)` brings their product to -3 dB.
fn critical_damping(order: u32) -> Vec<Term> {
    let alpha = libm::sqrt(libm::expm1(std::f64::consts::LN_2 / f64::from(order.max(1))));
    let first = (order % 2 == 1).then_some(Term { a: alpha, b: 0.0 });
    let pairs = (0..order / 2).map(|_| Term { a: 2.0 * alpha, b: alpha * alpha });
    first.into_iter().chain(pairs).collect()
}

/// Poles evenly spread on the unit circle.
fn butterworth(order: u32) -> Vec<Term> {
    let n = f64::from(order);
    let odd = order % 2 == 1;
    let first = odd.then_some(Term { a: 1.0, b: 0.0 });
    let pairs = (1..=order / 2).map(|i| {
        let angle = if odd { f64::from(i) * PI / n } else { f64::from(2 * i - 1) * PI / (2.0 * n) };
        Term { a: if order == 2 { SQRT_2 } else { 2.0 * libm::cos(angle) }, b: 1.0 }
    });
    first.into_iter().chain(pairs).collect()
}

fn table(rows: &[&[(f64, f64)]; 6], order: u32) -> Vec<Term> {
    let Some(row) = (order as usize).checked_sub(1).and_then(|i| rows.get(i)) else {
        return Vec::new();
    };
    row.iter().map(|&(a, b)| Term { a, b }).collect()
}

/// Factors of the reverse Bessel polynomials, scaled to -3 dB at `P = j`; roots found with 40 digits.
const BESSEL: [&[(f64, f64)]; 6] = [
    &[(1.0, 0.0)],
    &[(1.3616541287161306, 0.6180339887498949)],
    &[(0.756043166486987, 0.0), (0.9996292021942245, 0.4771913591204959)],
    &[(1.3396637000153094, 0.4889041513645725), (0.7742539748889064, 0.388990733715243)],
    &[
        (0.6656387999023014, 0.0),
        (1.1401766958285253, 0.412845034991819),
        (0.6215952064218014, 0.32453295810298143),
    ],
    &[
        (1.221734379672154, 0.3887183710638381),
        (0.9686070259812801, 0.3504726815531775),
        (0.5130536555494878, 0.2756407132488253),
    ],
];

/// The same polynomials, scaled to a group delay of 1/sqrt(2) of its low-frequency value at `P = j`.
const BESSEL_ALL_PASS: [&[(f64, f64)]; 6] = [
    &[(0.6435942529055827, 0.0)],
    &[(1.6277624266890355, 0.8832035059135259)],
    &[(1.141458389062979, 0.0), (1.5092195649341554, 1.0877261129905027)],
    &[(2.3369619600852604, 1.4877687486975736), (1.3506390348111285, 1.1837253898114774)],
    &[
        (1.2974245058313417, 0.0),
        (2.222366223788124, 1.568462000652053),
        (1.2115772903221777, 1.2329507917027944),
    ],
    &[
        (2.6116729688172024, 1.7763112405322027),
        (2.070568553404028, 1.601541398824531),
        (1.096742783084333, 1.2595846601029117),
    ],
];

#[cfg(test)]
mod tests {
    use super::*;
    use Prototype::{Bessel, Butterworth, CritDamping};

    fn close(is: f64, want: f64, tolerance: f64) {
        assert!((is - want).abs() <= tolerance, "{is} is not {want}");
    }

    /// Square of the magnitude of the denominator at `P = j w`.
    fn denominator_squared(terms: &[Term], w: f64) -> f64 {
        let square = |x: f64| x * x;
        terms.iter().map(|t| square(1.0 - t.b * w * w) + square(t.a * w)).product()
    }

    /// Group delay of the low-pass at `P = j w`; the all-pass has twice as much.
    fn delay(terms: &[Term], w: f64) -> f64 {
        let one = |t: &Term| {
            let w2 = w * w;
            t.a * (1.0 + t.b * w2) / (1.0 + (t.a * t.a - 2.0 * t.b) * w2 + t.b * t.b * w2 * w2)
        };
        terms.iter().map(one).sum()
    }

    /// Coefficients of the product of all factors, ascending.
    fn polynomial(terms: &[Term]) -> Vec<f64> {
        let mut product = vec![1.0];
        for term in terms {
            let mut next = vec![0.0; product.len() + 2];
            for (i, c) in product.iter().enumerate() {
                next[i] += c;
                next[i + 1] += c * term.a;
                next[i + 2] += c * term.b;
            }
            product = next;
        }
        product
    }

    #[test]
    fn three_decibels_at_the_corner() {
        for prototype in [CritDamping, Butterworth, Bessel] {
            for order in 1..=6 {
                close(denominator_squared(&prototype.terms(order), 1.0), 2.0, 3e-15);
            }
        }
    }

    /// The reverse Bessel polynomial has the coefficients `(2n-k)! / (2^(n-k) k! (n-k)!)`; P scaled by c multiplies the
    /// k-th one by `c^k`.
    #[test]
    fn bessel_factors_make_bessel_polynomials() {
        let factorial = |n: u32| (1..=n).map(f64::from).product::<f64>();
        let power = |x: f64, n: u32| (0..n).map(|_| x).product::<f64>();
        for order in 1..=6 {
            let c = |k: u32| {
                factorial(2 * order - k)
                    / (power(2.0, order - k) * factorial(k) * factorial(order - k))
            };
            for terms in [Bessel.terms(order), Bessel.all_pass_terms(order)] {
                let is = polynomial(&terms);
                let scale = is[1] * c(0) / c(1);
                for k in 0..=order {
                    let want = c(k) / c(0) * power(scale, k);
                    close(is[k as usize] / want, 1.0, 1e-14);
                }
            }
        }
    }

    #[test]
    fn the_bessel_all_pass_is_normalised_by_its_delay() {
        let printed = [0.2049, 0.5181, 0.8437, 1.1738, 1.5060, 1.8395];
        for (order, t0_times_f) in (1..=6).zip(printed) {
            let terms = Bessel.all_pass_terms(order);
            close(delay(&terms, 1.0) / delay(&terms, 0.0), std::f64::consts::FRAC_1_SQRT_2, 1e-14);
            close(2.0 * delay(&terms, 0.0) / (2.0 * PI), t0_times_f, 5e-5);
        }
    }

    /// The tables of the filter textbooks, four digits.
    #[test]
    fn printed_coefficients() {
        type Row = (Prototype, u32, &'static [(f64, f64)]);
        let printed: [Row; 8] = [
            (Bessel, 2, &[(1.3617, 0.6180)]),
            (Bessel, 5, &[(0.6656, 0.0), (1.1402, 0.4128), (0.6216, 0.3245)]),
            (Bessel, 6, &[(1.2217, 0.3887), (0.9686, 0.3505), (0.5131, 0.2756)]),
            (CritDamping, 3, &[(0.5098, 0.0), (1.0197, 0.2599)]),
            (CritDamping, 4, &[(0.8700, 0.1892), (0.8700, 0.1892)]),
            (CritDamping, 6, &[(0.6999, 0.1225), (0.6999, 0.1225), (0.6999, 0.1225)]),
            (Butterworth, 4, &[(1.8478, 1.0), (0.7654, 1.0)]),
            (Butterworth, 5, &[(1.0, 0.0), (1.6180, 1.0), (0.6180, 1.0)]),
        ];
        for (prototype, order, want) in printed {
            let terms = prototype.terms(order);
            assert_eq!(terms.len(), want.len());
            for (term, &(a, b)) in terms.iter().zip(want) {
                close(term.a, a, 5.1e-5);
                close(term.b, b, 5.1e-5);
            }
        }
    }
}
