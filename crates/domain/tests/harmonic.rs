//! What harmonic coordinates promise.
//!
//! The whole takes about a minute on one core. With `CASTELJAU_LONG=1` in the environment the certificate is checked at
//! a million boundary points of every shape instead of a hundred thousand of all together, and thousands of random
//! polygons are tried instead of 300: `CASTELJAU_LONG=1 cargo test -p casteljau-domain --test harmonic -- --nocapture`.
#![allow(clippy::unwrap_used, clippy::needless_range_loop)]

mod support;

#[path = "harmonic/certificate.rs"]
mod certificate;
#[path = "harmonic/goldens.rs"]
mod goldens;
#[path = "harmonic/invariance.rs"]
mod invariance;
#[path = "harmonic/laws.rs"]
mod laws;
#[path = "harmonic/random.rs"]
mod random;
#[path = "harmonic/shapes.rs"]
mod shapes;
#[path = "harmonic/sides.rs"]
mod sides;
#[path = "harmonic/truth.rs"]
mod truth;
