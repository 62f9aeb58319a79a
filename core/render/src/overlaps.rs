//! Which parts of images a run of copies has touched.

use afterglow_gl::frame::{ImageKey, Region};
use hashbrown::HashMap;

use crate::plan::Transfer;

/// Regions of one level that are told apart; beyond that, everything overlaps.
const MOST_REGIONS: usize = 64;

/// Regions touched since the last wait.
#[derive(Debug, Default)]
pub(crate) struct Overlaps {
    /// By image, level, layer.
    regions: HashMap<(ImageKey, u32, u32), Vec<Region>>,
}

impl Overlaps {
    pub(crate) fn clear(&mut self) {
        self.regions.clear();
    }

    /// Adds what a transfer touches. Says whether it must wait for the others; then it is the only one left.
    pub(crate) fn add(&mut self, transfer: &Transfer) -> bool {
        let touched = match *transfer {
            Transfer::Wait => return false,
            Transfer::Upload { image, region, .. } => [Some((image, region)), None],
            Transfer::Copy { from, region, to, to_level } => {
                let target = Region { level: to_level, ..region };
                [Some((from, region)), Some((to, target))]
            }
        };
        let touched = touched.iter().flatten();
        let waits = touched.clone().any(|(image, region)| self.overlaps(*image, region));
        if waits {
            self.clear();
        }
        for (image, region) in touched {
            self.insert(*image, region);
        }
        waits
    }

    /// Whether a region shares texels with one that was touched.
    pub(crate) fn overlaps(&self, image: ImageKey, region: &Region) -> bool {
        let others = self.regions.get(&(image, region.level, region.layer));
        others.is_some_and(|others| {
            others.len() >= MOST_REGIONS || others.iter().any(|other| intersect(region, other))
        })
    }

    pub(crate) fn insert(&mut self, image: ImageKey, region: &Region) {
        let key = (image, region.level, region.layer);
        self.regions.entry(key).or_default().push(*region);
    }
}

fn intersect(a: &Region, b: &Region) -> bool {
    (0..3).all(|axis| {
        // Regions lie within images, whose sides fit 32 bits.
        a.offset[axis] < b.offset[axis] + b.extent[axis] && b.offset[axis] < a.offset[axis] + a.extent[axis]
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::uploads::Upload;
    use afterglow_gpu::vk;

    fn region(x: u32, width: u32) -> Region {
        Region { level: 0, layer: 0, offset: [x, 0, 0], extent: [width, 1, 1] }
    }

    fn upload(image: ImageKey, region: Region) -> Transfer {
        let from = Upload { buffer: vk::Buffer::null(), offset: 0, address: 0 };
        Transfer::Upload { image, region, from }
    }

    #[test]
    fn only_shared_texels_must_wait() {
        let mut overlaps = Overlaps::default();
        let (a, b) = (ImageKey::unique(), ImageKey::unique());
        assert!(!overlaps.add(&upload(a, region(0, 4))));
        assert!(!overlaps.add(&upload(a, region(4, 4))));
        assert!(!overlaps.add(&upload(b, region(0, 4))));
        let copy = Transfer::Copy { from: a, region: region(0, 1), to: b, to_level: 1 };
        assert!(overlaps.add(&copy));
        assert!(!overlaps.add(&upload(a, region(4, 4))), "what came before the wait is forgotten");
        assert!(overlaps.add(&upload(a, region(0, 1))), "what is read must not be overwritten");
    }
}
