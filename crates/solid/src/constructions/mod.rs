//! Solids made of patches and curves: translated along a curve, rotated about an axis, twisted.

mod constructed;
mod rotational;
mod transitional;
mod twisted;

pub use constructed::{ConstructedSolid, Construction};
pub use twisted::{Twist, rational_rotation};
