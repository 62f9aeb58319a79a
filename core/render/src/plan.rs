//! A frame's operations, sorted into the steps that the device executes.
//!
//! Operations keep their order, but for copies to images that nothing has used yet: those move to the front, so that
//! drawing is not interrupted.

use std::ops::Range;

use afterglow_gl::frame::{
    BaseFormat, Clear, Frame, ImageCopy, ImageKey, ImageShape, ImageUpload, Operation, Region,
};
use afterglow_gpu::{BindlessTable, GpuError, vk};

use crate::replacements::Arrived;
use crate::sorter::Sorter;
use crate::textures::{TEXEL_BYTES, Texture, Textures, texel_count};
use crate::uploads::{Upload, UploadArena};
use crate::window;

/// One command of a step that fills images.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Transfer {
    /// What follows waits for what came before.
    Wait,
    Upload {
        image: ImageKey,
        region: Region,
        from: Upload,
    },
    Copy {
        from: ImageKey,
        region: Region,
        to: ImageKey,
        to_level: u32,
    },
}

/// A copy from the frame buffer to a texture.
#[derive(Debug, Clone, Copy)]
pub(crate) struct CopyItem {
    pub(crate) image: ImageKey,
    pub(crate) region: Region,
    /// Rows counted from the top. It is resampled where its size is not the region's.
    pub(crate) source: vk::Rect2D,
    /// Pixels of the batch before it.
    pub(crate) first_pixel: usize,
    /// Texels of the batch before it.
    pub(crate) first_texel: usize,
}

/// Copies from the frame buffer to textures with nothing between them.
#[derive(Debug, Default)]
pub(crate) struct CopyBatch {
    pub(crate) items: Vec<CopyItem>,
    /// Of the window.
    pub(crate) pixels: usize,
    pub(crate) texels: usize,
    /// From depth, else from colour.
    pub(crate) from_depth: bool,
}

/// What the device does between two points where it must wait.
#[derive(Debug, Clone)]
pub(crate) enum Step {
    /// Fills images: a part of [`Plan::transfers`].
    Transfers(Range<usize>),
    /// Draws and clears, among these operations.
    Raster(RasterStep),
    /// Copies to textures: a batch of [`Plan::batches`].
    Copy(usize),
    /// glCopyPixels: the operation's pixels are read; the next step draws them.
    ReadPixels(usize),
    /// glAccum or a clear of the accumulation buffer: the operation.
    Accumulate(usize),
}

/// A run of drawing operations.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct RasterStep {
    pub(crate) operations: Range<usize>,
    /// Draws of the frame before them.
    pub(crate) first_draw: usize,
    /// Rectangles of pixels of the frame before them.
    pub(crate) first_pixels: usize,
    /// The view that the operations make up, if they are traced.
    pub(crate) view: Option<usize>,
}

/// All that is to be done for a frame.
#[derive(Debug, Default)]
pub(crate) struct Plan {
    /// In order; the first step fills images, if that is not empty.
    pub(crate) steps: Vec<Step>,
    pub(crate) transfers: Vec<Transfer>,
    /// Images that the frame defines, and whether they must be cleared because not all of it is filled.
    pub(crate) defined: Vec<(ImageKey, bool)>,
    pub(crate) batches: Vec<CopyBatch>,
    pub(crate) dropped: Vec<ImageKey>,
}

impl Plan {
    /// The view whose last operations the step of this number draws, if it is one's.
    pub(crate) fn finished_view(&self, index: usize) -> Option<usize> {
        let view = |step: &Step| match step {
            Step::Raster(step) => step.view,
            _ => None,
        };
        let drawn = view(&self.steps[index])?;
        let goes_on = self.steps[index + 1..].iter().any(|step| view(step) == Some(drawn));
        (!goes_on).then_some(drawn)
    }
}

/// What planning needs of the renderer.
pub(crate) struct Planner<'a> {
    pub(crate) textures: &'a mut Textures,
    pub(crate) table: &'a BindlessTable,
    pub(crate) arena: &'a mut UploadArena,
    pub(crate) size: [u32; 2],
    /// Operations that are views to be traced.
    pub(crate) views: &'a [Range<usize>],
    /// Pictures that replace textures from this frame on.
    pub(crate) arrived: Vec<Arrived>,
    /// Operations that come to the device; later ones are draws for rays alone.
    pub(crate) operations: usize,
}

impl Planner<'_> {
    /// Makes the frame's images, stages its texels, and sorts its operations.
    pub(crate) fn plan(mut self, frame: &Frame) -> Result<Plan, GpuError> {
        let mut sorter = Sorter::default();
        for arrived in std::mem::take(&mut self.arrived) {
            self.picture(&mut sorter, &arrived)?;
        }
        for (index, operation) in frame.operations.iter().enumerate().take(self.operations) {
            sorter.enter(self.views.iter().position(|view| view.contains(&index)));
            self.operation(&mut sorter, frame, index, operation)?;
        }
        Ok(sorter.finish(self.textures))
    }

    fn operation(
        &mut self,
        sorter: &mut Sorter,
        frame: &Frame,
        index: usize,
        operation: &Operation,
    ) -> Result<(), GpuError> {
        match operation {
            Operation::Draw(draw) => {
                sorter.note_bindings(frame, draw.bindings);
                sorter.draw(index);
            }
            Operation::Pixels(pixels) => {
                sorter.note_bindings(frame, pixels.bindings);
                sorter.pixels(index);
            }
            Operation::BeginQuery(_) | Operation::EndQuery(_) => sorter.raster(index),
            Operation::Clear(clear) => {
                if is_whole_clear(clear, self.size) {
                    sorter.split();
                }
                sorter.raster(index);
            }
            Operation::CopyPixels(_) => {
                sorter.push(Step::ReadPixels(index));
                sorter.pixels(index);
            }
            Operation::DefineImage { image, shape } => self.define(sorter, *image, shape)?,
            Operation::Upload(upload) => self.upload(sorter, upload)?,
            Operation::CopyToImage(copy) => self.copy_to_image(sorter, copy),
            Operation::CopyImage { from, region, to, to_level } => {
                self.copy_image(sorter, *from, *region, *to, *to_level)
            }
            Operation::DropImage(image) => sorter.drop_image(*image),
            Operation::ClearAccumulation(_) | Operation::Accumulate(..) => {
                sorter.push(Step::Accumulate(index));
            }
        }
        Ok(())
    }

    fn define(&mut self, sorter: &mut Sorter, image: ImageKey, shape: &ImageShape) -> Result<(), GpuError> {
        if self.textures.define(self.table, image, shape)? {
            sorter.define(image);
        }
        Ok(())
    }

    /// Makes the image of a picture, and stages its texels.
    fn picture(&mut self, sorter: &mut Sorter, arrived: &Arrived) -> Result<(), GpuError> {
        let Arrived { key, picture, swizzle } = arrived;
        if !self.textures.define_picture(self.table, *key, picture, *swizzle)? {
            return Ok(());
        }
        sorter.define(*key);
        for (level, texels) in (0..).zip(&picture.levels) {
            let extent = [picture.width, picture.height].map(|side| (side >> level).max(1));
            let extent = [extent[0], extent[1], 1];
            let region = Region { level, layer: 0, offset: [0; 3], extent };
            sorter.fill(*key, &region);
            let from = self.arena.push(texels)?;
            sorter.transfer(true, Transfer::Upload { image: *key, region, from });
        }
        Ok(())
    }

    fn upload(&mut self, sorter: &mut Sorter, upload: &ImageUpload) -> Result<(), GpuError> {
        let Some(texture) = self.textures.get(upload.image) else {
            return Ok(());
        };
        let (image, region) = (upload.image, upload.region);
        if !texture.holds(&region) || upload.texels.len() != texel_count(&region) * TEXEL_BYTES {
            tracing::warn!(?region, "an upload does not fit its image");
            return Ok(());
        }
        let is_early = !sorter.is_used(image);
        if is_early && texture.is_whole(&region) {
            sorter.fill(image, &region);
        }
        let from = self.arena.push(&upload.texels)?;
        let transfer = Transfer::Upload { image, region, from };
        sorter.transfer(is_early, transfer);
        Ok(())
    }

    fn copy_image(
        &mut self,
        sorter: &mut Sorter,
        from: ImageKey,
        region: Region,
        to: ImageKey,
        to_level: u32,
    ) {
        let target_region = Region { level: to_level, ..region };
        let fits = |image, region| {
            let texture = self.textures.get(image);
            texture.is_some_and(|texture: &Texture| texture.holds(region))
        };
        if from == to || !fits(from, &region) || !fits(to, &target_region) {
            tracing::warn!(?region, to_level, "a copy does not fit its images");
            return;
        }
        let is_early = !sorter.is_used(from) && !sorter.is_used(to);
        let transfer = Transfer::Copy { from, region, to, to_level };
        sorter.transfer(is_early, transfer);
    }

    fn copy_to_image(&mut self, sorter: &mut Sorter, copy: &ImageCopy) {
        let Some(texture) = self.textures.get(copy.image) else {
            return;
        };
        let Some((region, source)) = window::clip_copy(copy, self.size) else {
            return;
        };
        if !texture.holds(&region) {
            tracing::warn!(?region, "a copy from the window does not fit its image");
            return;
        }
        let from_depth = copy.base_format == BaseFormat::Depth;
        sorter.copy(copy.image, region, source, from_depth);
    }
}

/// Whether a clear replaces all colours, so that nothing drawn before it shows.
fn is_whole_clear(clear: &Clear, size: [u32; 2]) -> bool {
    clear.color.is_some() && clear.color_mask == 0xf && window::covers(clear.scissor.as_ref(), size)
}
