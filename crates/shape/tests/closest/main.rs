//! Closest points: against brute force, on shapes and queries made to be difficult.
#![allow(clippy::unwrap_used)] // helpers of tests

mod brute;
mod cases;
mod degenerate;
mod minima;
mod random;
mod triangles;
