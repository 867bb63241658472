//! A progress bar on a terminal, for work that takes over a second.

use std::io::IsTerminal;
use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};

/// Work shorter than this shows nothing.
const PATIENCE: Duration = Duration::from_secs(1);
const STEPS: u64 = 1000;

pub struct Progress {
    what: &'static str,
    start: Instant,
    terminal: bool,
    bar: Option<ProgressBar>,
}

impl Progress {
    pub fn new(what: &'static str) -> Self {
        Self { what, start: Instant::now(), terminal: std::io::stderr().is_terminal(), bar: None }
    }

    /// Tells how much is done, 0 to 1.
    pub fn tell(&mut self, fraction: f64) -> ControlFlow<()> {
        if self.terminal && self.start.elapsed() >= PATIENCE {
            let what = self.what;
            let bar = self.bar.get_or_insert_with(|| {
                let bar = ProgressBar::new(STEPS).with_elapsed(PATIENCE).with_message(what);
                match ProgressStyle::with_template("{msg} [{bar:40}] {percent} %, {eta} left") {
                    Ok(style) => bar.with_style(style.progress_chars("=> ")),
                    Err(_) => bar,
                }
            });
            bar.set_position((fraction.clamp(0.0, 1.0) * STEPS as f64) as u64);
        }
        ControlFlow::Continue(())
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}
