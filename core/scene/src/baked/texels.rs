//! Texels of images that may be lightmaps, as long as the images last.

use std::sync::Arc;

use afterglow_gl::frame::{
    Dimension, Frame, ImageKey, ImageShape, ImageUpload, Operation, Region, TexelFormat,
};
use glam::{Vec2, Vec3};
use hashbrown::HashMap;

/// Longest side of an image that is kept.
const MOST_SIDE: u32 = 1024;
/// Bytes of all images, at most; what comes later is not kept.
const MOST_BYTES: usize = 96 << 20;

/// Level 0 of an image of two dimensions.
#[derive(Debug, Clone, PartialEq)]
pub struct Image {
    /// Texels in a row.
    pub width: u32,
    /// Rows, from t = 0 upward.
    pub height: u32,
    /// RGBA; empty before anything is uploaded.
    texels: Arc<[u8]>,
}

impl Image {
    /// An image of these texels, RGBA.
    #[cfg(test)]
    pub fn new(width: u32, height: u32, texels: &[u8]) -> Image {
        Image { width, height, texels: texels.into() }
    }

    /// RGB, 0 to 1 as stored; clamped at the edges.
    fn texel(&self, x: i64, y: i64) -> Vec3 {
        let clamped = |v: i64, size: u32| v.clamp(0, i64::from(size) - 1) as usize;
        let at = 4 * (clamped(y, self.height) * self.width as usize + clamped(x, self.width));
        let bytes = self.texels.get(at..at + 3).unwrap_or(&[0; 3]);
        Vec3::new(bytes[0].into(), bytes[1].into(), bytes[2].into()) / 255.0
    }

    /// The colour at texture coordinates, bilinear, 0 to 1 as stored.
    pub fn sample(&self, at: Vec2) -> Vec3 {
        let size = Vec2::new(self.width as f32, self.height as f32);
        let place = (at * size - 0.5).clamp(Vec2::NEG_ONE, size);
        let (low, share) = (place.floor(), place - place.floor());
        let (x, y) = (low.x as i64, low.y as i64);
        let row = |y: i64| self.texel(x, y).lerp(self.texel(x + 1, y), share.x);
        row(y).lerp(row(y + 1), share.y)
    }

    /// How much neighbouring texels differ, relative to how bright they are: the median over a grid of places, since
    /// lightmaps are seldom smooth across the seams between their pieces.
    pub fn roughness(&self) -> f32 {
        const PLACES: u32 = 48;
        let mut steps: Vec<f32> = Vec::new();
        for i in 0..PLACES * PLACES {
            let along = |n: u32, size: u32| i64::from((2 * n + 1) * size / (2 * PLACES));
            let (x, y) = (along(i % PLACES, self.width), along(i / PLACES, self.height));
            let [here, right, above] = [self.texel(x, y), self.texel(x + 1, y), self.texel(x, y + 1)];
            let bright = (here + right + above).element_sum() / 3.0;
            if bright > 0.02 {
                let step = (right - here).abs() + (above - here).abs();
                steps.push(step.element_sum() / bright);
            }
        }
        steps.sort_unstable_by(f32::total_cmp);
        steps.get(steps.len() / 2).copied().unwrap_or(f32::INFINITY)
    }
}

/// Texels of a context's images.
#[derive(Debug, Default)]
pub struct Texels {
    images: HashMap<ImageKey, Image>,
    bytes: usize,
}

impl Texels {
    /// Takes note of a frame's new texels.
    pub fn learn(&mut self, frame: &Frame) {
        for operation in &frame.operations {
            match operation {
                Operation::DefineImage { image, shape } if may_hold_light(shape) => {
                    let empty = Image { width: shape.width, height: shape.height, texels: Arc::new([]) };
                    self.remove(*image);
                    self.images.insert(*image, empty);
                }
                Operation::Upload(upload) => self.upload(upload),
                Operation::CopyImage { from, to, to_level: 0, .. } => self.copy(*from, *to),
                _ => {}
            }
        }
    }

    /// Forgets the images that a frame dropped.
    pub fn forget(&mut self, frame: &Frame) {
        for operation in &frame.operations {
            if let Operation::DropImage(image) = operation {
                self.remove(*image);
            }
        }
    }

    /// An image all of whose texels came from the program.
    pub fn get(&self, image: ImageKey) -> Option<&Image> {
        self.images.get(&image).filter(|image| !image.texels.is_empty())
    }

    fn remove(&mut self, image: ImageKey) {
        if let Some(image) = self.images.remove(&image) {
            self.bytes -= image.texels.len();
        }
    }

    fn upload(&mut self, upload: &ImageUpload) {
        let Some(image) = self.images.get_mut(&upload.image) else { return };
        let Region { level, layer, offset, extent } = upload.region;
        let size = 4 * image.width as usize * image.height as usize;
        if level != 0 || layer != 0 || self.bytes + size > MOST_BYTES + image.texels.len() {
            return;
        }
        self.bytes += size - image.texels.len();
        if offset == [0; 3] && extent == [image.width, image.height, 1] && upload.texels.len() == size {
            image.texels = upload.texels.clone();
            return;
        }
        if image.texels.is_empty() {
            image.texels = vec![0; size].into();
        }
        write_part(image, offset, extent, &upload.texels);
    }

    fn copy(&mut self, from: ImageKey, to: ImageKey) {
        let Some(source) = self.images.get(&from).cloned() else { return };
        if let Some(image) = self.images.get_mut(&to)
            && (image.width, image.height) == (source.width, source.height)
        {
            self.bytes = self.bytes + source.texels.len() - image.texels.len();
            *image = source;
        }
    }
}

fn may_hold_light(shape: &ImageShape) -> bool {
    shape.dimension == Dimension::D2
        && shape.format == TexelFormat::Rgba8
        && shape.width.max(shape.height) <= MOST_SIDE
        && shape.width.min(shape.height) > 0
}

fn write_part(image: &mut Image, offset: [u32; 3], extent: [u32; 3], texels: &[u8]) {
    let row = 4 * extent[0] as usize;
    if row == 0 {
        return;
    }
    let target = Arc::make_mut(&mut image.texels);
    for (y, source) in (offset[1] as usize..).zip(texels.chunks_exact(row)).take(extent[1] as usize) {
        let start = 4 * (y * image.width as usize + offset[0] as usize);
        if let Some(place) = target.get_mut(start..start + row) {
            place.copy_from_slice(source);
        }
    }
}
