//! Polynomials over a wedge: triangle × interval.

mod de_casteljau;
mod net;

pub use net::WedgeNet;
