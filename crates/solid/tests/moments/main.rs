//! Volume and moments: exact cases, closed forms, laws, and an exact referee.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // helpers of tests

mod closed_forms;
mod laws;
#[path = "../certificate/referee/mod.rs"]
mod referee;
#[path = "../certificate/support.rs"]
mod support;
mod truth;
