//! glGetTexImage: a level's texels back to the program (specification, 6.1.4).

use std::borrow::Cow;

use afterglow_api::constants::*;

use crate::backend::{Reply, Request};
use crate::frame::{BaseFormat, ImageKey, Region};
use crate::pixel::{
    Extent, GlResult, Luminance, Packing, PixelFormat, PixelLayout, PixelTarget, PixelTransfer, pack_color,
    pack_depth,
};

use super::level::{TEXEL_BYTES, Texels};
use super::object::TextureObject;
use super::specify::{extent_of, level_number};

/// A level to be read, perhaps after the device was asked for it.
#[derive(Debug, Clone)]
pub struct LevelImage {
    /// Size without the border.
    interior: Extent,
    /// Size with the border, as the program gets it.
    extent: Extent,
    base_format: BaseFormat,
    texels: Texels,
    device: Option<(ImageKey, Region)>,
}

impl TextureObject {
    /// A level to be read; an undefined one is empty.
    ///
    /// # Errors
    /// GL_INVALID_VALUE for a level that cannot be.
    pub fn level_image(&mut self, face: usize, level: i32) -> GlResult<LevelImage> {
        let number = level_number(self.target, level)?;
        self.before_change(number);
        let Some(level) = self.level(face, number) else {
            let none = Extent::plane(0, 0);
            let (base_format, texels) = (BaseFormat::Rgba, Texels::Undefined);
            return Ok(LevelImage { interior: none, extent: none, base_format, texels, device: None });
        };
        let on_device = matches!(level.texels, Texels::Device);
        let image = level.held_by.and_then(|key| self.images.get(key)).filter(|_| on_device);
        Ok(LevelImage {
            interior: extent_of(self.target, level.size),
            extent: level.full_extent(self.target),
            base_format: level.format.base,
            texels: level.texels.clone(),
            device: image.map(|image| (image.key, image.region(number, face, [0; 3], level.size))),
        })
    }
}

impl LevelImage {
    /// Size as the program gets it.
    pub fn extent(&self) -> Extent {
        self.extent
    }

    /// What the device must be asked for first, if anything.
    pub fn request(&self) -> Option<Request> {
        self.device.map(|(image, region)| Request::Texels { image, region })
    }

    /// Writes the level to the program's memory. `reply` is the answer to [`request`](Self::request); without a
    /// usable one the texels are zero. Texels of a border, which are not kept, repeat the nearest ones inside.
    ///
    /// # Errors
    /// GL_INVALID_ENUM for a bad format or type; GL_INVALID_OPERATION if depths are asked of colours or the
    /// reverse, or the memory is too short.
    pub fn write(
        &self,
        reply: Option<&Reply>,
        (format, kind): (u32, u32),
        packing: &Packing,
        data: &mut [u8],
    ) -> GlResult<()> {
        let layout = PixelLayout::from_gl(format, kind)?;
        if layout.format.is_index() {
            return Err(GL_INVALID_ENUM);
        }
        if (layout.format == PixelFormat::Depth) != (self.base_format == BaseFormat::Depth) {
            return Err(GL_INVALID_OPERATION);
        }
        let target = PixelTarget::new(data, layout, packing, self.extent)?;
        if self.extent.is_empty() {
            return Ok(());
        }
        let texels = self.with_border(self.texels(reply));
        if self.base_format == BaseFormat::Depth {
            let depths: Vec<f32> =
                texels.as_chunks().0.iter().map(|texel| f32::from_ne_bytes(*texel)).collect();
            return pack_depth(&depths, &PixelTransfer::default(), target);
        }
        pack_color(&self.components(texels), None, Luminance::Red, target)
    }

    fn texels<'a>(&'a self, reply: Option<&'a Reply>) -> Cow<'a, [u8]> {
        let bytes = self.interior.pixels().unwrap_or(0) * TEXEL_BYTES;
        let found = match (&self.texels, reply) {
            (Texels::Memory(texels), _) => Some(Cow::Borrowed(&**texels)),
            (_, Some(Reply::Color(texels))) => Some(Cow::Borrowed(&**texels)),
            (_, Some(Reply::Depth(depths))) => Some(Cow::Borrowed(bytemuck::cast_slice(depths))),
            _ => None,
        };
        found.filter(|texels| texels.len() == bytes).unwrap_or_else(|| vec![0; bytes].into())
    }

    fn with_border<'a>(&self, texels: Cow<'a, [u8]>) -> Cow<'a, [u8]> {
        let (inner, outer) = (self.interior, self.extent);
        if inner == outer || inner.is_empty() {
            return texels;
        }
        let inside =
            |i: usize, inner: usize, outer: usize| i.saturating_sub((outer - inner) / 2).min(inner - 1);
        let mut out = Vec::with_capacity(outer.pixels().unwrap_or(0) * TEXEL_BYTES);
        for (z, y) in (0..outer.depth).flat_map(|z| (0..outer.height).map(move |y| (z, y))) {
            let (z, y) = (inside(z, inner.depth, outer.depth), inside(y, inner.height, outer.height));
            let line = (z * inner.height + y) * inner.width;
            for x in 0..outer.width {
                let texel = (line + inside(x, inner.width, outer.width)) * TEXEL_BYTES;
                out.extend_from_slice(&texels[texel..texel + TEXEL_BYTES]);
            }
        }
        out.into()
    }

    /// Components as table 6.1 has them: luminance and intensity are red alone.
    fn components<'a>(&self, mut texels: Cow<'a, [u8]>) -> Cow<'a, [u8]> {
        let spread = [BaseFormat::Luminance, BaseFormat::LuminanceAlpha, BaseFormat::Intensity];
        if !spread.contains(&self.base_format) {
            return texels;
        }
        for texel in texels.to_mut().as_chunks_mut::<4>().0 {
            let alpha = if self.base_format == BaseFormat::Intensity { 255 } else { texel[3] };
            *texel = [texel[0], 0, 0, alpha];
        }
        texels
    }
}
