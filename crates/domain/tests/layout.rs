//! What `casteljau_domain::layout` promises, checked by means of its own.
#![allow(clippy::unwrap_used)]

#[path = "layout/brute.rs"]
mod brute;
#[path = "layout/goldens.rs"]
mod goldens;
#[path = "layout/invariance.rs"]
mod invariance;
#[path = "layout/validity.rs"]
mod validity;
