//! What is known of the texels of images: whether their alpha can be below one, and their mean colour.

use std::sync::Arc;

use crate::alpha::AlphaMap;
use afterglow_gl::frame::{
    BaseFormat, Frame, ImageKey, ImageShape, ImageUpload, Operation, Region, TexelFormat,
};
use glam::{Vec3, Vec4};
use hashbrown::HashMap;
use xxhash_rust::xxh3::{xxh3_64, xxh3_64_with_seed};

/// Texels that a mean colour is taken from, at most.
const MEAN_SAMPLES: usize = 1024;

/// What level 0 of an image holds.
#[derive(Debug, Clone, PartialEq)]
pub struct ImageFacts {
    shape: ImageShape,
    texels: u64,
    clear: u64,
    partial: u64,
    mean: Option<Vec4>,
    content: u64,
    alpha: Option<Arc<AlphaMap>>,
}

impl ImageFacts {
    fn new(shape: ImageShape) -> ImageFacts {
        ImageFacts {
            shape,
            texels: 0,
            clear: 0,
            partial: 0,
            mean: None,
            content: shape_hash(&shape),
            alpha: None,
        }
    }

    /// Whether every texel's alpha is one.
    pub fn is_opaque(&self) -> bool {
        !has_alpha(self.shape.base_format) || (self.clear == 0 && self.partial == 0)
    }

    /// Whether alpha cuts a shape out: hardly any texel lies between clear and opaque.
    pub fn is_cut_out(&self) -> bool {
        self.clear > 0 && self.partial * 4 < self.texels
    }

    /// Where alpha is one, if it is not everywhere and that is known.
    pub fn alpha(&self) -> Option<&AlphaMap> {
        self.alpha.as_deref()
    }

    /// Mean colour of the texels as they are stored (sRGB), weighted by alpha, and mean alpha, if any were seen.
    pub fn mean(&self) -> Option<Vec4> {
        self.mean
    }

    /// Hash of shape and texels of level 0, the same in all runs of a program: what names the image.
    pub fn content(&self) -> u64 {
        self.content
    }

    /// Width, height, depth of level 0, texels, and what the texels mean.
    pub fn shape(&self) -> &ImageShape {
        &self.shape
    }

    fn upload(&mut self, upload: &ImageUpload) {
        let region = &upload.region;
        if region.level != 0 || self.shape.format != TexelFormat::Rgba8 {
            return;
        }
        if covers(&self.shape, region) {
            *self = ImageFacts::new(self.shape);
        }
        self.content = fold_upload(self.content, upload);
        self.texels += upload.texels.len() as u64 / 4;
        if has_alpha(self.shape.base_format) {
            self.count_alpha(&upload.texels);
            let is_whole = covers(&self.shape, region) && self.partial > 0;
            self.alpha = is_whole.then(|| AlphaMap::of(&self.shape, &upload.texels)).flatten().map(Arc::new);
        }
        self.mean = mean_color(&upload.texels).or(self.mean);
    }

    fn count_alpha(&mut self, texels: &[u8]) {
        let (mut below, mut clear) = (0u64, 0u64);
        for texel in texels.chunks_exact(4) {
            below += u64::from(texel[3] < 255);
            clear += u64::from(texel[3] < 26);
        }
        // Texels close to opaque are neither: they come from filters and from careless painting.
        let nearly = texels.chunks_exact(4).filter(|t| (230..255).contains(&t[3])).count() as u64;
        self.clear += clear;
        self.partial += below - clear - nearly;
        let hidden = texels.chunks_exact(4).map(|t| u64::from(255 - t[3])).sum::<u64>();
        let is_seen_through = hidden * 32 > 255 * (texels.len() as u64 / 4);
        if nearly > 0 && is_seen_through && self.clear + self.partial == 0 {
            self.partial += nearly;
        }
    }
}

fn shape_hash(shape: &ImageShape) -> u64 {
    let sides = [shape.width, shape.height, shape.depth, shape.dimension as u32, shape.base_format as u32];
    xxh3_64(bytemuck::bytes_of(&sides))
}

/// The content after an upload of part of it: a name for what was uploaded where, in that order.
fn fold_upload(content: u64, upload: &ImageUpload) -> u64 {
    let Region { layer, offset: [x, y, z], extent: [width, height, depth], .. } = upload.region;
    let place = [layer, x, y, z, width, height, depth];
    xxh3_64_with_seed(&upload.texels, xxh3_64_with_seed(bytemuck::bytes_of(&place), content))
}

fn has_alpha(format: BaseFormat) -> bool {
    matches!(
        format,
        BaseFormat::Alpha | BaseFormat::LuminanceAlpha | BaseFormat::Intensity | BaseFormat::Rgba
    )
}

fn covers(shape: &ImageShape, region: &Region) -> bool {
    region.offset == [0; 3] && region.extent == [shape.width, shape.height, shape.depth]
}

fn mean_color(texels: &[u8]) -> Option<Vec4> {
    let count = texels.len() / 4;
    // Odd, so that samples are not all of one column.
    let step = count.div_ceil(MEAN_SAMPLES).max(1) | 1;
    let (mut sum, mut alpha, mut samples) = (Vec3::ZERO, 0.0, 0.0);
    for texel in texels.chunks_exact(4).step_by(step) {
        let [r, g, b, a] = [texel[0], texel[1], texel[2], texel[3]].map(|byte| f32::from(byte) / 255.0);
        sum += a * Vec3::new(r, g, b);
        alpha += a;
        samples += 1.0;
    }
    (samples > 0.0).then(|| (sum / f32::max(alpha, 1e-6)).extend(alpha / samples))
}

/// Knowledge of all images of a context, learnt from the operations of its frames.
#[derive(Debug, Default)]
pub struct Images {
    facts: HashMap<ImageKey, ImageFacts>,
}

impl Images {
    /// Takes note of the frame's new texels. Images dropped in it stay known, for its draws may use them.
    pub fn learn(&mut self, frame: &Frame) {
        for operation in &frame.operations {
            match operation {
                Operation::DefineImage { image, shape } => {
                    self.facts.insert(*image, ImageFacts::new(*shape));
                }
                Operation::Upload(upload) => {
                    if let Some(facts) = self.facts.get_mut(&upload.image) {
                        facts.upload(upload);
                    }
                }
                Operation::CopyImage { from, to, to_level: 0, .. } => self.copy(*from, *to),
                _ => {}
            }
        }
    }

    fn copy(&mut self, from: ImageKey, to: ImageKey) {
        let Some(source) = self.facts.get(&from).cloned() else { return };
        if let Some(facts) = self.facts.get_mut(&to) {
            *facts = ImageFacts { shape: facts.shape, ..source };
        }
    }

    /// Forgets the images that the frame dropped.
    pub fn forget(&mut self, frame: &Frame) {
        for operation in &frame.operations {
            if let Operation::DropImage(image) = operation {
                self.facts.remove(image);
            }
        }
    }

    /// Images by their content; of several with the same content, the first that was made.
    pub fn by_content(&self) -> HashMap<u64, ImageKey> {
        let mut images: HashMap<u64, ImageKey> = HashMap::new();
        for (&image, facts) in &self.facts {
            let known = images.entry(facts.content).or_insert(image);
            *known = image.min(*known);
        }
        images
    }

    /// What is known of an image.
    pub fn get(&self, image: ImageKey) -> Option<&ImageFacts> {
        self.facts.get(&image)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use afterglow_gl::frame::Dimension;

    fn frame_with(format: BaseFormat, texels: &[[u8; 4]]) -> (Frame, ImageKey) {
        let image = ImageKey::unique();
        let shape = ImageShape {
            dimension: Dimension::D2,
            width: texels.len() as u32,
            height: 1,
            depth: 1,
            levels: 1,
            format: TexelFormat::Rgba8,
            base_format: format,
        };
        let region = Region { level: 0, layer: 0, offset: [0; 3], extent: [texels.len() as u32, 1, 1] };
        let upload = ImageUpload { image, region, texels: texels.as_flattened().into() };
        let operations = vec![Operation::DefineImage { image, shape }, Operation::Upload(upload)];
        (Frame { operations, ..Frame::default() }, image)
    }

    fn facts(format: BaseFormat, texels: &[[u8; 4]]) -> ImageFacts {
        let (frame, image) = frame_with(format, texels);
        let mut images = Images::default();
        images.learn(&frame);
        images.get(image).unwrap().clone()
    }

    #[test]
    fn alpha_is_learnt_from_texels() {
        assert!(facts(BaseFormat::Rgba, &[[9, 9, 9, 255]; 4]).is_opaque());
        assert!(!facts(BaseFormat::Rgba, &[[9, 9, 9, 235]; 4]).is_opaque());
        assert!(facts(BaseFormat::Rgba, &[[9, 9, 9, 252]; 4]).is_opaque());
        assert!(facts(BaseFormat::Rgb, &[[9, 9, 9, 0]; 4]).is_opaque());
    }

    #[test]
    fn cut_outs_are_told_from_gradients() {
        let mut texels = [[0, 0, 0, 255]; 16];
        texels[..6].fill([0; 4]);
        texels[6][3] = 128;
        assert!(facts(BaseFormat::Rgba, &texels).is_cut_out());
        texels[6..12].fill([0, 0, 0, 128]);
        assert!(!facts(BaseFormat::Rgba, &texels).is_cut_out());
    }

    #[test]
    fn the_mean_is_of_the_colours() {
        let found = facts(BaseFormat::Rgb, &[[255, 0, 0, 255], [0, 0, 255, 255]]);
        assert!(found.mean().unwrap().abs_diff_eq(Vec4::new(0.5, 0.0, 0.5, 1.0), 1e-6));
    }

    #[test]
    fn a_new_upload_of_everything_replaces_what_was_known_and_drops_forget() {
        let (mut frame, image) = frame_with(BaseFormat::Rgba, &[[0; 4]; 4]);
        let mut images = Images::default();
        images.learn(&frame);
        assert!(!images.get(image).unwrap().is_opaque());
        let Operation::Upload(upload) = &mut frame.operations[1] else { panic!() };
        upload.texels = [255; 16].into();
        frame.operations.remove(0);
        images.learn(&frame);
        assert!(images.get(image).unwrap().is_opaque());
        images.forget(&Frame { operations: vec![Operation::DropImage(image)], ..Frame::default() });
        assert!(images.get(image).is_none());
    }
}
