//! Shaping filters and their analysis against reference data, closed forms and the vendor's numbers.

mod analysis;
mod chain;
mod changes;
mod corner;
mod figures;
mod fir;
mod iir;
mod reference;
mod resonance;
mod vib_guard;
