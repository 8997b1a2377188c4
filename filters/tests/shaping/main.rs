//! Shaping filters and their analysis against reference data, closed forms and the vendor's numbers.

#[cfg(test)]
mod analysis;
#[cfg(test)]
mod chain;
#[cfg(test)]
mod changes;
#[cfg(test)]
mod corner;
#[cfg(test)]
mod figures;
#[cfg(test)]
mod fir;
#[cfg(test)]
mod iir;
#[cfg(test)]
mod reference;
#[cfg(test)]
mod resonance;
#[cfg(test)]
mod vib_guard;
