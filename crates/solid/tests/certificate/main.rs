//! The sign of det J, certified: exact cases, an exact referee, and solids whose sign is known.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // helpers of tests

mod degenerate;
mod goldens;
mod random;
mod referee;
mod rotational;
mod support;
