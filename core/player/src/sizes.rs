//! Sizes of windows. A trace does not hold them: they are taken from the viewports that were set in them.

use std::collections::HashMap;

/// Largest width and height that a window is taken to have, pixels.
const LARGEST: u32 = 16384;

/// Width and height of each drawable, pixels.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct DrawableSizes {
    known: HashMap<u64, (u32, u32)>,
    others: (u32, u32),
}

impl DrawableSizes {
    /// The same size for all.
    pub fn all(width: u32, height: u32) -> DrawableSizes {
        DrawableSizes { known: HashMap::new(), others: bounded((width, height)) }
    }

    /// Sizes of some drawables, by the traced program's handles, and of all others.
    pub fn new(known: impl IntoIterator<Item = (u64, (u32, u32))>, others: (u32, u32)) -> DrawableSizes {
        let known = known.into_iter().map(|(drawable, size)| (drawable, bounded(size)));
        DrawableSizes { known: known.collect(), others: bounded(others) }
    }

    /// Width and height of a drawable.
    pub fn of(&self, drawable: u64) -> (u32, u32) {
        self.known.get(&drawable).copied().unwrap_or(self.others)
    }
}

fn bounded((width, height): (u32, u32)) -> (u32, u32) {
    (width.clamp(1, LARGEST), height.clamp(1, LARGEST))
}
