//! Images and buffers as the graph sees them: a name, a size, and where they live.

use std::borrow::Cow;

use serde::Serialize;

use crate::{Format, ResourceState};

/// Names a resource of the builder that returned it, and of the graph compiled from that.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct ResourceId(pub(crate) u32);

impl ResourceId {
    /// The position in the order of declaration, from 0.
    pub const fn index(self) -> usize {
        self.0 as usize
    }
}

/// The size of an image.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct ImageDesc {
    /// In pixels.
    pub width: u32,
    /// In pixels.
    pub height: u32,
    /// In pixels; 1 unless the image is three-dimensional.
    pub depth: u32,
    /// Array layers; 6 for a cube map.
    pub layers: u32,
    /// Mip levels, the full-sized one included.
    pub mip_levels: u8,
    /// Samples a pixel.
    pub samples: u8,
    pub format: Format,
}

impl ImageDesc {
    /// A plain two-dimensional image, `size` in pixels as (width, height).
    pub const fn flat(size: (u32, u32), format: Format) -> Self {
        Self { width: size.0, height: size.1, depth: 1, layers: 1, mip_levels: 1, samples: 1, format }
    }

    /// Bytes of all pixels, without padding; none if the size is empty, has more mip levels than
    /// halvings, or exceeds 64 bits.
    pub fn bytes(&self) -> Option<u64> {
        let extent = [self.width, self.height, self.depth];
        let largest = extent.into_iter().max()?;
        let levels = u32::from(self.mip_levels);
        if extent.contains(&0) || levels == 0 || levels > u32::BITS - largest.leading_zeros() {
            return None;
        }
        let per_texel =
            u64::from(self.format.bytes_per_pixel()) * u64::from(self.samples) * u64::from(self.layers);
        let bytes = (0..levels).try_fold(0_u64, |sum, level| {
            let texels = extent.into_iter().try_fold(1_u64, |product, length| {
                product.checked_mul(u64::from((length >> level).max(1)))
            })?;
            sum.checked_add(texels.checked_mul(per_texel)?)
        })?;
        (bytes > 0).then_some(bytes)
    }
}

/// What a resource is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ResourceDesc {
    Image(ImageDesc),
    /// A buffer; also the storage of an acceleration structure.
    Buffer {
        bytes: u64,
    },
}

impl ResourceDesc {
    /// Bytes of payload, without padding; none if the size is empty or impossible.
    pub fn bytes(&self) -> Option<u64> {
        match self {
            Self::Image(image) => image.bytes(),
            Self::Buffer { bytes } => (*bytes > 0).then_some(*bytes),
        }
    }

    pub const fn is_image(&self) -> bool {
        matches!(self, Self::Image(_))
    }
}

impl From<ImageDesc> for ResourceDesc {
    fn from(image: ImageDesc) -> Self {
        Self::Image(image)
    }
}

/// Where a resource lives, and so for how long.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Residence {
    /// Within the frame; memory may be shared with others.
    Transient,
    /// From frame to frame, owned by the graph's executor under a key.
    History,
    /// Outside; the graph only orders accesses to it.
    Imported,
}

/// A declared resource.
#[derive(Clone, Debug)]
pub(crate) struct Resource {
    /// Shown in reports and errors; the key of a history resource.
    pub name: Cow<'static, str>,
    pub desc: ResourceDesc,
    pub residence: Residence,
    /// What was done to it before the frame.
    pub initial: ResourceState,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn image_bytes_count_layers_samples_and_levels() {
        let mut image = ImageDesc::flat((8, 4), Format::Rgba8Unorm);
        assert_eq!(image.bytes(), Some(128));
        image.mip_levels = 4; // 8x4, 4x2, 2x1, 1x1
        assert_eq!(image.bytes(), Some((32 + 8 + 2 + 1) * 4));
        image.layers = 6;
        image.samples = 2;
        assert_eq!(image.bytes(), Some((32 + 8 + 2 + 1) * 4 * 12));
    }

    #[test]
    fn impossible_sizes_have_no_bytes() {
        let image = ImageDesc::flat((8, 4), Format::R8Unorm);
        let huge = u32::MAX;
        for wrong in [
            ImageDesc { width: 0, ..image },
            ImageDesc { layers: 0, ..image },
            ImageDesc { samples: 0, ..image },
            ImageDesc { mip_levels: 0, ..image },
            ImageDesc { mip_levels: 5, ..image },
            ImageDesc { width: huge, height: huge, depth: huge, ..image },
            ImageDesc { width: huge, height: huge, layers: huge, ..image },
        ] {
            assert_eq!(wrong.bytes(), None, "{wrong:?}");
        }
        assert_eq!(ResourceDesc::Buffer { bytes: 0 }.bytes(), None);
    }
}
