//! Solids made of patches and curves: translated along a curve, rotated about an axis, twisted.

mod rotational;
mod transitional;
mod twisted;

pub use twisted::{Twist, rational_rotation};
