//! A plan in the making: which step an operation joins.

use afterglow_gl::frame::{Frame, ImageKey, Region};
use afterglow_gpu::vk;
use hashbrown::{HashMap, HashSet};

use crate::overlaps::Overlaps;
use crate::plan::{CopyBatch, CopyItem, Plan, RasterStep, Step, Transfer};
use crate::textures::{Textures, texel_count};

/// Texels, and pixels, that one batch of copies to textures moves at most, unless a single one is larger.
const MOST_BATCH_TEXELS: usize = 2 << 20;

#[derive(Default)]
pub(crate) struct Sorter {
    plan: Plan,
    /// Transfers that move to the front.
    early: Vec<Transfer>,
    early_overlaps: Overlaps,
    /// What the last step has touched, if it copies to images.
    overlaps: Overlaps,
    /// Where the last batch copies each region to.
    batch: HashMap<(ImageKey, Region), usize>,
    /// Images that an operation which keeps its place has used.
    used: HashSet<ImageKey>,
    seen_bindings: Vec<bool>,
    /// Levels and layers that are filled at the front.
    filled: HashSet<(ImageKey, u32, u32)>,
    draws: usize,
    pixels: usize,
    /// The next drawing operation begins a step of its own, unless the last one has drawn nothing.
    is_split: bool,
    /// The view that operations belong to.
    view: Option<usize>,
}

impl Sorter {
    /// Remembers that a draw uses these textures.
    pub(crate) fn note_bindings(&mut self, frame: &Frame, bindings: u32) {
        let index = bindings as usize;
        self.seen_bindings.resize(frame.bindings.len(), false);
        let Some(seen) = self.seen_bindings.get_mut(index) else {
            return;
        };
        if !std::mem::replace(seen, true) {
            let bound = frame.bindings[index].iter().flatten();
            self.used.extend(bound.map(|binding| binding.image));
        }
    }

    /// Whether an operation that keeps its place has used the image.
    pub(crate) fn is_used(&self, image: ImageKey) -> bool {
        self.used.contains(&image)
    }

    pub(crate) fn define(&mut self, image: ImageKey) {
        self.plan.defined.push((image, true));
    }

    pub(crate) fn drop_image(&mut self, image: ImageKey) {
        self.plan.dropped.push(image);
    }

    /// Remembers that a level and layer are filled at the front.
    pub(crate) fn fill(&mut self, image: ImageKey, region: &Region) {
        self.filled.insert((image, region.level, region.layer));
    }

    pub(crate) fn draw(&mut self, operation: usize) {
        self.raster(operation);
        self.draws += 1;
    }

    pub(crate) fn pixels(&mut self, operation: usize) {
        self.raster(operation);
        self.pixels += 1;
    }

    /// Adds an operation to the last step, if that draws, or else to a new one.
    pub(crate) fn raster(&mut self, operation: usize) {
        let is_split = std::mem::take(&mut self.is_split);
        let (first_draw, first_pixels) = (self.draws, self.pixels);
        if let Some(Step::Raster(step)) = self.plan.steps.last_mut() {
            let is_idle = (step.first_draw, step.first_pixels) == (first_draw, first_pixels);
            if (!is_split || is_idle) && step.view == self.view {
                step.operations.end = operation + 1;
                return;
            }
        }
        self.plan.steps.push(Step::Raster(RasterStep {
            operations: operation..operation + 1,
            first_draw,
            first_pixels,
            view: self.view,
        }));
    }

    /// Operations belong to a view from here, or to none.
    pub(crate) fn enter(&mut self, view: Option<usize>) {
        self.view = view;
    }

    pub(crate) fn split(&mut self) {
        self.is_split = true;
    }

    pub(crate) fn push(&mut self, step: Step) {
        self.plan.steps.push(step);
    }

    /// Adds a transfer, at the front if it is early.
    pub(crate) fn transfer(&mut self, is_early: bool, transfer: Transfer) {
        if is_early {
            if self.early_overlaps.add(&transfer) {
                self.early.push(Transfer::Wait);
            }
            self.early.push(transfer);
            return;
        }
        let transfers = &mut self.plan.transfers;
        if !matches!(self.plan.steps.last(), Some(Step::Transfers(_))) {
            self.overlaps.clear();
            let start = transfers.len();
            self.plan.steps.push(Step::Transfers(start..start));
        }
        if self.overlaps.add(&transfer) {
            transfers.push(Transfer::Wait);
        }
        transfers.push(transfer);
        if let Some(Step::Transfers(range)) = self.plan.steps.last_mut() {
            range.end = transfers.len();
        }
    }

    /// Adds a copy from the window to a texture.
    pub(crate) fn copy(&mut self, image: ImageKey, region: Region, source: vk::Rect2D, from_depth: bool) {
        self.used.insert(image);
        let (pixels, texels) = (pixel_count(source), texel_count(&region));
        if !self.joins_batch(pixels.max(texels), from_depth) {
            self.begin_batch(from_depth);
        }
        // Of copies to the same texels, with nothing drawn between them, only the last one shows.
        let same = self.batch.get(&(image, region)).copied();
        if let (Some(same), Some(batch)) = (same, self.plan.batches.last_mut()) {
            let item = &mut batch.items[same];
            if item.source.extent != source.extent {
                item.first_pixel = batch.pixels;
                batch.pixels += pixels;
            }
            item.source = source;
            return;
        }
        if self.overlaps.overlaps(image, &region) {
            self.begin_batch(from_depth);
        }
        self.overlaps.insert(image, &region);
        let Some(batch) = self.plan.batches.last_mut() else {
            return;
        };
        self.batch.insert((image, region), batch.items.len());
        batch.items.push(CopyItem {
            image,
            region,
            source,
            first_pixel: batch.pixels,
            first_texel: batch.texels,
        });
        batch.pixels += pixels;
        batch.texels += texels;
    }

    fn joins_batch(&self, texels: usize, from_depth: bool) -> bool {
        let (Some(Step::Copy(_)), Some(batch)) = (self.plan.steps.last(), self.plan.batches.last()) else {
            return false;
        };
        batch.from_depth == from_depth && batch.pixels.max(batch.texels) + texels <= MOST_BATCH_TEXELS
    }

    fn begin_batch(&mut self, from_depth: bool) {
        self.plan.steps.push(Step::Copy(self.plan.batches.len()));
        self.plan.batches.push(CopyBatch { from_depth, ..CopyBatch::default() });
        self.overlaps.clear();
        self.batch.clear();
    }

    /// The plan, with the early transfers as its first step.
    pub(crate) fn finish(self, textures: &Textures) -> Plan {
        let Self { mut plan, early, filled, .. } = self;
        for (image, clear) in &mut plan.defined {
            *clear = textures.get(*image).is_none_or(|texture| {
                let is_filled = |level, layer| filled.contains(&(*image, level, layer));
                let mut levels = 0..texture.shape.levels;
                !levels.all(|level| (0..texture.image.layers()).all(|layer| is_filled(level, layer)))
            });
        }
        for step in &mut plan.steps {
            if let Step::Transfers(range) = step {
                *range = range.start + early.len()..range.end + early.len();
            }
        }
        plan.steps.insert(0, Step::Transfers(0..early.len()));
        plan.transfers.splice(0..0, early);
        plan
    }
}

fn pixel_count(rect: vk::Rect2D) -> usize {
    rect.extent.width as usize * rect.extent.height as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    fn region(x: u32) -> Region {
        Region { level: 0, layer: 0, offset: [x, 0, 0], extent: [4, 4, 1] }
    }

    fn source(x: i32) -> vk::Rect2D {
        vk::Rect2D { offset: vk::Offset2D { x, y: 0 }, extent: vk::Extent2D { width: 4, height: 4 } }
    }

    #[test]
    fn draws_run_together_until_a_clear_hides_them() {
        let mut sorter = Sorter::default();
        sorter.split();
        sorter.raster(0);
        sorter.split();
        sorter.raster(1);
        sorter.draw(3);
        sorter.raster(4);
        sorter.split();
        sorter.raster(5);
        sorter.pixels(6);
        let ranges: Vec<_> = sorter.plan.steps.iter().filter_map(raster_step).collect();
        assert_eq!(ranges[0].operations, 0..5);
        assert_eq!(ranges[1].operations, 5..7);
        assert_eq!((ranges[1].first_draw, ranges[1].first_pixels), (1, 0));
        assert_eq!(ranges.len(), 2);
    }

    fn raster_step(step: &Step) -> Option<&RasterStep> {
        match step {
            Step::Raster(step) => Some(step),
            _ => None,
        }
    }

    #[test]
    fn repeated_copies_are_one_and_overlapping_ones_are_ordered() {
        let mut sorter = Sorter::default();
        let image = ImageKey::unique();
        sorter.copy(image, region(0), source(0), false);
        sorter.copy(image, region(4), source(1), false);
        sorter.copy(image, region(0), source(2), false);
        assert_eq!(sorter.plan.batches.len(), 1);
        assert_eq!(sorter.plan.batches[0].items[0].source, source(2));
        assert_eq!(sorter.plan.batches[0].texels, 32);
        sorter.copy(image, region(2), source(3), false);
        assert_eq!(sorter.plan.batches.len(), 2);
        sorter.draw(0);
        sorter.copy(image, region(2), source(3), false);
        assert_eq!(sorter.plan.batches.len(), 3);
        assert!(sorter.is_used(image));
    }

    #[test]
    fn a_repeated_copy_may_have_another_size() {
        let mut sorter = Sorter::default();
        let image = ImageKey::unique();
        let mut large = source(0);
        large.extent.width = 8;
        sorter.copy(image, region(0), source(0), false);
        sorter.copy(image, region(4), source(0), false);
        sorter.copy(image, region(0), large, false);
        let batch = &sorter.plan.batches[0];
        assert_eq!((batch.pixels, batch.texels), (16 + 16 + 32, 32));
        let places = batch.items.iter().map(|item| (item.first_pixel, item.first_texel));
        assert_eq!(places.collect::<Vec<_>>(), [(32, 0), (16, 16)]);
    }
}
