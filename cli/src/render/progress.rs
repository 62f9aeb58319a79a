//! A bar that says how far rendering has come, on a terminal only.

use indicatif::{ProgressBar, ProgressStyle};

/// Steps that the bar is divided in.
const STEPS: f64 = 1000.0;

/// The bar.
pub struct Progress(ProgressBar);

impl Progress {
    /// An empty one.
    pub fn new() -> Progress {
        let style = ProgressStyle::with_template("{bar:40} {percent}%  {elapsed}  {eta} left");
        let style = style.unwrap_or_else(|_| ProgressStyle::default_bar());
        Progress(ProgressBar::new(STEPS as u64).with_style(style))
    }

    /// Shows that a share of all is done.
    pub fn show(&self, share: f64) {
        self.0.set_position((share.clamp(0.0, 1.0) * STEPS) as u64);
    }

    /// Takes it away.
    pub fn finish(&self) {
        self.0.finish_and_clear();
    }
}
