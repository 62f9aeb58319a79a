//! From a texture to an image on the device: operations for what has changed since the last draw.

use std::sync::Arc;

use crate::frame::{BaseFormat, ImageKey, ImageShape, ImageUpload, Operation, Sampler};

use super::complete::LevelRange;
use super::images::OwnedImage;
use super::level::{Level, TEXEL_BYTES, Texels};
use super::object::TextureObject;

/// What a draw samples.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Realized {
    /// The image.
    pub image: ImageKey,
    /// Its shape; it may have more levels than are sampled.
    pub shape: ImageShape,
    /// What its texels mean.
    pub base_format: BaseFormat,
    /// Levels that are sampled.
    pub levels: usize,
}

/// Zeros are uploaded in pieces of at most so many bytes, which share their memory.
const ZERO_BYTES: usize = 1 << 20;

impl TextureObject {
    /// The image to sample, with all operations that it takes to bring it up to date; `None` if the texture is
    /// incomplete, which turns its unit off. Nothing but a comparison if nothing has changed.
    pub fn realize(&mut self, out: &mut Vec<Operation>) -> Option<Realized> {
        if self.dirty {
            self.dirty = false;
            if self.parameters.mipmaps() {
                self.settle_mipmaps();
            }
            self.realized = self.complete().and_then(|range| self.bring_up_to_date(range, out));
        }
        self.realized
    }

    /// How the texture is sampled; to be asked after [`realize`](Self::realize).
    pub fn sampler(&self) -> Sampler {
        let levels = self.realized.map_or(1, |realized| realized.levels);
        let depth = self.base_format() == Some(BaseFormat::Depth);
        self.parameters.sampler(self.target, levels, self.uses_mipmaps(), depth)
    }

    fn bring_up_to_date(&mut self, range: LevelRange, out: &mut Vec<Operation>) -> Option<Realized> {
        let main = self.main_image(range, out)?;
        for level in range.base..range.base + range.count {
            for face in 0..self.faces.len() {
                self.bring(face, level, main, out);
            }
        }
        self.collect_images(out);
        let (image, shape) = (main.key, main.shape);
        Some(Realized { image, shape, base_format: shape.base_format, levels: range.count })
    }

    fn main_image(&mut self, range: LevelRange, out: &mut Vec<Operation>) -> Option<OwnedImage> {
        let base = self.level(0, range.base)?;
        let shape = self.shape(base, range.count);
        Some(self.images.set_main(shape, range.base, out))
    }

    /// Puts a level's texels into an image that fits.
    fn bring(&mut self, face: usize, number: usize, to: OwnedImage, out: &mut Vec<Operation>) {
        let Some(level) = self.faces[face].get_mut(number).and_then(Option::as_mut) else { return };
        let from = level.held_by.replace(to.key);
        if from == Some(to.key) {
            return;
        }
        let region = to.region(number, face, [0; 3], level.size);
        match &level.texels {
            Texels::Memory(texels) => {
                out.push(Operation::Upload(ImageUpload { image: to.key, region, texels: texels.clone() }));
            }
            Texels::Undefined => upload_zeros(level, to, number, face, out),
            Texels::Device => {
                let Some(from) = from.and_then(|key| self.images.get(key)) else { return };
                let source = from.region(number, face, [0; 3], level.size);
                let (from, to_level) = (from.key, region.level);
                out.push(Operation::CopyImage { from, region: source, to: to.key, to_level });
            }
        }
    }

    /// Drops images that neither draws nor levels need any more.
    pub(super) fn collect_images(&mut self, out: &mut Vec<Operation>) {
        if self.images.len() <= 1 {
            return;
        }
        let needed = |key: ImageKey| {
            let mut levels = self.faces.iter().flatten().flatten();
            levels.any(|level| matches!(level.texels, Texels::Device) && level.held_by == Some(key))
        };
        self.images.collect(needed, out);
        for level in self.faces.iter_mut().flatten().flatten() {
            level.held_by = level.held_by.filter(|key| self.images.get(*key).is_some());
        }
    }

    /// An image that has a level's texels and can be copied to; the level's own texels are put there unless
    /// they will be overwritten altogether.
    pub(super) fn place_on_device(
        &mut self,
        face: usize,
        number: usize,
        overwritten: bool,
        out: &mut Vec<Operation>,
    ) -> Option<OwnedImage> {
        let level = self.level(face, number)?;
        if let Some(image) = level.held_by.and_then(|key| self.images.get(key)) {
            return Some(*image);
        }
        let (size, base_format) = (level.size, level.format.base);
        if let Some(range) = self.complete() {
            self.main_image(range, out);
        }
        let home = self.images.home(number, size, base_format);
        let image = match home {
            Some(image) => image,
            None => {
                let shape = self.shape(self.level(face, number)?, 1);
                self.images.define(shape, number, out)
            }
        };
        if overwritten {
            self.level_mut(face, number)?.held_by = Some(image.key);
        } else {
            self.bring(face, number, image, out);
        }
        Some(image)
    }
}

/// Uploads zeros for a whole level, some rows at a time.
fn upload_zeros(level: &Level, to: OwnedImage, number: usize, face: usize, out: &mut Vec<Operation>) {
    let [width, height, depth] = level.size;
    let row_bytes = width as usize * TEXEL_BYTES;
    let rows = ((ZERO_BYTES / row_bytes.max(1)).max(1) as u32).min(height);
    let zeros: Arc<[u8]> = std::iter::repeat_n(0, row_bytes * rows as usize).collect();
    for z in 0..depth {
        for y in (0..height).step_by(rows.max(1) as usize) {
            let piece = rows.min(height - y);
            let texels =
                if piece == rows { zeros.clone() } else { zeros[..row_bytes * piece as usize].into() };
            let region = to.region(number, face, [0, y, z], [width, piece, 1]);
            out.push(Operation::Upload(ImageUpload { image: to.key, region, texels }));
        }
    }
}
