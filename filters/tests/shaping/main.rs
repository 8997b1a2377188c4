//! Shaping filters and their analysis against reference data, closed forms and the vendor's numbers.

#[cfg(test)]
mod reference;
#[cfg(test)]
mod vib_guard;
