//! Where a programmed point is: coordinates, frames, planes, arcs and angles.
//!
//! Owns offsets, coordinate systems and tool data; pure geometry otherwise, it touches no other room.

pub(super) mod angle;
pub(super) mod arc;
pub(super) mod coordinates;
pub(super) mod frame;
pub(super) mod modulo;
pub(super) mod planar;
pub(super) mod tools;
