//! Polynomials over a wedge: triangle × interval.

mod bounds;
mod de_casteljau;
mod degree;
mod face;
mod net;
mod power;
mod product;
mod restriction;

pub use net::WedgeNet;
pub use power::wedge_from_power;
