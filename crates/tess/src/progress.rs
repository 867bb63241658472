use std::cell::{Cell, RefCell};
use std::ops::ControlFlow;

use crate::TessError;

/// The caller's callback, told of fractions that never go back, from inside closures too.
pub(crate) struct Progress<'a> {
    callback: RefCell<&'a mut dyn FnMut(f64) -> ControlFlow<()>>,
    /// Where the patch in work begins and how much of the whole it is.
    span: Cell<[f64; 2]>,
    reached: Cell<f64>,
    cancelled: Cell<bool>,
}

impl<'a> Progress<'a> {
    pub fn new(callback: &'a mut dyn FnMut(f64) -> ControlFlow<()>) -> Self {
        Self {
            callback: RefCell::new(callback),
            span: Cell::new([0.0, 1.0]),
            reached: Cell::new(0.0),
            cancelled: Cell::new(false),
        }
    }

    /// The fractions told from here on are of part `index` of `count`.
    pub fn part(&self, index: usize, count: usize) {
        let width = 1.0 / count.max(1) as f64;
        self.span.set([index as f64 * width, width]);
    }

    /// Tells the callback, and fails where it asks to stop.
    pub fn tell(&self, fraction: f64) -> Result<(), TessError> {
        if self.cancelled.get() {
            return Err(TessError::Cancelled { fraction: self.reached.get() });
        }
        let [start, width] = self.span.get();
        let now = (start + width * fraction.clamp(0.0, 1.0)).clamp(self.reached.get(), 1.0);
        self.reached.set(now);
        if (self.callback.borrow_mut())(now).is_break() {
            self.cancelled.set(true);
            return Err(TessError::Cancelled { fraction: now });
        }
        Ok(())
    }
}

/// [`Progress::tell`], for those who know nothing else of it.
pub(crate) type Tell<'a> = dyn Fn(f64) -> Result<(), TessError> + 'a;
