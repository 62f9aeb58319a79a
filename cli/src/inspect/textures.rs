//! The textures of a trace as files, named after what replaces them is named after.

use std::io::{self, Write};
use std::path::Path;

use afterglow_gl::frame::{
    BaseFormat, Dimension, Frame, ImageKey, ImageShape, ImageUpload, Operation, Region, TexelFormat,
};
use afterglow_images::{FileName, Role, write_png};
use afterglow_scene::Recovery;
use serde::Serialize;
use std::collections::{BTreeMap, HashMap};

use crate::failure::Failure;

/// Bytes of a texel.
const TEXEL: usize = 4;
/// Of a texture that keeps changing, no more contents than these are written.
const MOST_CONTENTS: u32 = 8;

/// A texture that was written.
#[derive(Debug, Serialize)]
pub struct TextureRow {
    hash: String,
    width: u32,
    height: u32,
    base_format: String,
    /// The first frame that draws with it.
    frame: u64,
}

impl TextureRow {
    /// Writes a line.
    pub fn write(&self, out: &mut impl Write) -> io::Result<()> {
        let size = format!("{}x{}", self.width, self.height);
        writeln!(out, "{}  {size:>11}  {:<14}  frame {}", self.hash, self.base_format, self.frame)
    }
}

/// Writes each content of each texture once, when it is first drawn with.
pub struct TextureWriter<'a> {
    folder: &'a Path,
    images: HashMap<ImageKey, Canvas>,
    /// By hash.
    rows: BTreeMap<u64, TextureRow>,
}

/// Level 0 of an image.
struct Canvas {
    shape: ImageShape,
    texels: Vec<u8>,
    /// Nothing was drawn into it, which could only be known from a device.
    is_known: bool,
    contents: u32,
}

impl<'a> TextureWriter<'a> {
    /// Makes the folder.
    pub fn new(folder: &'a Path) -> Result<Self, Failure> {
        std::fs::create_dir_all(folder).map_err(|error| Failure::output(folder, error))?;
        Ok(Self { folder, images: HashMap::new(), rows: BTreeMap::new() })
    }

    /// Takes note of a frame's texels.
    pub fn learn(&mut self, frame: &Frame) {
        for operation in &frame.operations {
            match operation {
                Operation::DefineImage { image, shape }
                    if shape.dimension == Dimension::D2 && shape.format == TexelFormat::Rgba8 =>
                {
                    self.images.insert(*image, Canvas::new(*shape));
                }
                Operation::Upload(upload) => {
                    if let Some(canvas) = self.images.get_mut(&upload.image) {
                        canvas.upload(upload);
                    }
                }
                Operation::CopyImage { from, region, to, to_level: 0 } => self.copy(*from, region, *to),
                Operation::CopyToImage(copy) => {
                    if let Some(canvas) = self.images.get_mut(&copy.image) {
                        canvas.is_known = false;
                    }
                }
                _ => {}
            }
        }
    }

    /// Writes what a frame draws with that was not written yet.
    pub fn write(&mut self, index: u64, frame: &Frame, recovery: &Recovery) -> Result<(), Failure> {
        for (_, draw) in frame.draws() {
            let units = &frame.fixed[draw.fixed as usize].words.units;
            let bindings = frame.bindings.get(draw.bindings as usize).copied().unwrap_or_default();
            for (_, binding) in units.iter().zip(bindings).filter(|(unit, _)| unit.target() != 0) {
                let Some(image) = binding.map(|binding| binding.image) else { continue };
                if let Some(facts) = recovery.image(image) {
                    self.write_image(index, image, facts.content())?;
                }
            }
        }
        Ok(())
    }

    /// Forgets what a frame has dropped.
    pub fn forget(&mut self, frame: &Frame) {
        for operation in &frame.operations {
            if let Operation::DropImage(image) = operation {
                self.images.remove(image);
            }
        }
    }

    /// What was written, by hash.
    pub fn finish(self) -> Vec<TextureRow> {
        self.rows.into_values().collect()
    }

    fn write_image(&mut self, index: u64, image: ImageKey, hash: u64) -> Result<(), Failure> {
        let Some(canvas) = self.images.get_mut(&image) else { return Ok(()) };
        if !canvas.is_known || canvas.contents == MOST_CONTENTS || self.rows.contains_key(&hash) {
            return Ok(());
        }
        canvas.contents += 1;
        if canvas.contents == MOST_CONTENTS {
            tracing::warn!("a texture of {:?} keeps changing: no more of it is written", canvas.shape);
        }
        let name = FileName { hash, role: Role::Color };
        let path = self.folder.join(format!("{name}.png"));
        let ImageShape { width, height, base_format, .. } = canvas.shape;
        write_png(&path, [width, height], &canvas.seen())
            .map_err(|error| Failure::output(&path, io::Error::other(error)))?;
        let base_format = format!("{base_format:?}").to_lowercase();
        self.rows
            .insert(hash, TextureRow { hash: name.to_string(), width, height, base_format, frame: index });
        Ok(())
    }

    fn copy(&mut self, from: ImageKey, region: &Region, to: ImageKey) {
        let Some(texels) = self.images.get(&from).and_then(|canvas| canvas.read(region)) else { return };
        if let Some(canvas) = self.images.get_mut(&to) {
            canvas.fill(region, &texels);
        }
    }
}

impl Canvas {
    fn new(shape: ImageShape) -> Self {
        let texels = vec![0; shape.width as usize * shape.height as usize * TEXEL];
        Self { shape, texels, is_known: true, contents: 0 }
    }

    fn upload(&mut self, upload: &ImageUpload) {
        if upload.region.level == 0 {
            self.fill(&upload.region, &upload.texels);
        }
    }

    /// Replaces a region's texels; none if it is not in the picture.
    fn fill(&mut self, region: &Region, texels: &[u8]) {
        let [width, height, _] = region.extent.map(|side| side as usize);
        let Some(rows) = self.rows(region).filter(|_| texels.len() == width * height * TEXEL) else { return };
        for (row, texels) in rows.zip(texels.chunks_exact((width * TEXEL).max(1))) {
            self.texels[row].copy_from_slice(texels);
        }
    }

    /// A region's texels.
    fn read(&self, region: &Region) -> Option<Vec<u8>> {
        let rows = self.rows(region).filter(|_| region.level == 0)?;
        Some(rows.flat_map(|row| self.texels[row].iter().copied()).collect())
    }

    /// Where a region's rows are, if it lies in the picture.
    fn rows(&self, region: &Region) -> Option<impl Iterator<Item = std::ops::Range<usize>> + use<>> {
        let [x, y, _] = region.offset.map(u64::from);
        let [width, height, _] = region.extent.map(u64::from);
        let pitch = self.shape.width as usize;
        let fits = x + width <= u64::from(self.shape.width) && y + height <= u64::from(self.shape.height);
        fits.then(move || {
            (y as usize..(y + height) as usize).map(move |row| {
                let first = (row * pitch + x as usize) * TEXEL;
                first..first + width as usize * TEXEL
            })
        })
    }

    /// The texels as one sees them: of formats without colour it is white, without alpha it is 255.
    fn seen(&self) -> Vec<u8> {
        let texel = |[r, g, b, a]: [u8; TEXEL]| match self.shape.base_format {
            BaseFormat::Alpha => [255, 255, 255, a],
            BaseFormat::Luminance => [r, r, r, 255],
            BaseFormat::Rgb => [r, g, b, 255],
            BaseFormat::LuminanceAlpha => [r, r, r, a],
            BaseFormat::Intensity => [r; TEXEL],
            BaseFormat::Rgba | BaseFormat::Depth => [r, g, b, a],
        };
        self.texels.as_chunks::<TEXEL>().0.iter().flat_map(|stored| texel(*stored)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn canvas(base_format: BaseFormat) -> Canvas {
        Canvas::new(ImageShape {
            dimension: Dimension::D2,
            width: 2,
            height: 2,
            depth: 1,
            levels: 1,
            format: TexelFormat::Rgba8,
            base_format,
        })
    }

    #[test]
    fn regions_are_filled_row_by_row() {
        let mut canvas = canvas(BaseFormat::Rgba);
        let region = |offset, extent| Region { level: 0, layer: 0, offset, extent };
        canvas.fill(&region([1, 0, 0], [1, 2, 1]), &[1, 1, 1, 1, 2, 2, 2, 2]);
        assert_eq!(canvas.texels, [0, 0, 0, 0, 1, 1, 1, 1, 0, 0, 0, 0, 2, 2, 2, 2]);
        assert_eq!(canvas.read(&region([1, 1, 0], [1, 1, 1])), Some(vec![2; 4]));
        let before = canvas.texels.clone();
        canvas.fill(&region([1, 0, 0], [2, 1, 1]), &[9; 8]);
        canvas.fill(&region([u32::MAX, 0, 0], [1, 1, 1]), &[9; 4]);
        canvas.fill(&region([0, 0, 0], [1, 1, 1]), &[9; 3]);
        assert_eq!(canvas.texels, before);
    }

    #[test]
    fn what_a_format_lacks_is_white_or_opaque() {
        for (base_format, seen) in
            [(BaseFormat::Alpha, [255, 255, 255, 4]), (BaseFormat::Luminance, [1, 1, 1, 255])]
        {
            let mut canvas = canvas(base_format);
            canvas.texels = [[1, 2, 3, 4]; 4].concat();
            assert_eq!(canvas.seen()[..4], seen);
        }
    }
}
