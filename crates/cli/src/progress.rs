//! A sign of life on a terminal, for work that takes over a second: a bar, or a spinner where no end is known.

use std::io::IsTerminal;
use std::ops::ControlFlow;
use std::sync::mpsc;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};

/// Work shorter than this shows nothing.
const PATIENCE: Duration = Duration::from_secs(1);
const STEPS: u64 = 1000;

/// Runs `work`, whose end cannot be foretold, and shows a spinner beside `what` meanwhile.
pub fn waiting<T>(what: &'static str, work: impl FnOnce() -> T) -> T {
    if !std::io::stderr().is_terminal() {
        return work();
    }
    let (done, is_done) = mpsc::channel::<()>();
    std::thread::scope(|scope| {
        scope.spawn(move || {
            if is_done.recv_timeout(PATIENCE).is_err_and(|e| e == mpsc::RecvTimeoutError::Timeout) {
                let spinner = ProgressBar::new_spinner().with_message(what).with_elapsed(PATIENCE);
                spinner.enable_steady_tick(Duration::from_millis(100));
                // Ends when `done` is dropped.
                let _ = is_done.recv();
                spinner.finish_and_clear();
            }
        });
        // Dropped when `work` is over, even by a panic, so that the scope can end.
        let _done = done;
        work()
    })
}

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
