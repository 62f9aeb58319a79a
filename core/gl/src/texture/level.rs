//! One level of a texture.

use std::sync::Arc;

use crate::frame::ImageKey;
use crate::pixel::{Extent, GlResult, allocate};

use super::internal_format::InternalFormat;
use super::target::TextureTarget;

/// Where a level's texels are.
#[derive(Debug, Clone)]
pub enum Texels {
    /// The program gave none: they are zero.
    Undefined,
    /// Here, rows tightly one after another.
    Memory(Arc<[u8]>),
    /// Only in the image that holds the level.
    Device,
}

/// A level that was specified.
#[derive(Debug)]
pub struct Level {
    /// Texels in each direction without the border.
    pub size: [u32; 3],
    /// Width of the border; its texels are not kept.
    pub border: u32,
    /// What it was asked to be.
    pub format: InternalFormat,
    /// The texels.
    pub texels: Texels,
    /// The compressed image that the texels were decoded from, with its format.
    pub compressed: Option<(u32, Arc<[u8]>)>,
    /// The image that has the texels as they are now.
    pub held_by: Option<ImageKey>,
}

/// Bytes of a texel, in both storages.
pub const TEXEL_BYTES: usize = 4;

impl Level {
    /// A level without texels.
    pub fn new(size: [u32; 3], border: u32, format: InternalFormat) -> Level {
        Level { size, border, format, texels: Texels::Undefined, compressed: None, held_by: None }
    }

    /// There are no texels.
    pub fn is_empty(&self) -> bool {
        self.size.contains(&0)
    }

    /// Bytes of all texels.
    pub fn bytes(&self) -> usize {
        self.size.iter().map(|n| *n as usize).product::<usize>() * TEXEL_BYTES
    }

    /// Size with the border, as the program has it.
    pub fn full_extent(&self, target: TextureTarget) -> Extent {
        let side = |i: usize| (self.size[i] + 2 * self.border_in(target, i)) as usize;
        match target {
            TextureTarget::D3 => Extent::volume(side(0), side(1), side(2)),
            _ => Extent::plane(side(0), side(1)),
        }
    }

    /// Width of the border in direction `i`.
    pub fn border_in(&self, target: TextureTarget, i: usize) -> u32 {
        if i < target.dimensions() { self.border } else { 0 }
    }

    /// The region is the whole level.
    pub fn is_covered_by(&self, offset: [u32; 3], extent: [u32; 3]) -> bool {
        offset == [0; 3] && extent == self.size
    }

    /// Replaces the texels of a region by `texels`, which lie tightly. Texels on the device are left to the
    /// caller.
    pub fn write(&mut self, offset: [u32; 3], extent: [u32; 3], texels: &Arc<[u8]>) -> GlResult<()> {
        self.compressed = None;
        let covered = self.is_covered_by(offset, extent);
        match &mut self.texels {
            Texels::Device => {}
            _ if covered => self.texels = Texels::Memory(texels.clone()),
            Texels::Memory(memory) => blit(Arc::make_mut(memory), self.size, offset, extent, texels),
            Texels::Undefined => {
                let mut memory = allocate(self.bytes())?;
                blit(Arc::make_mut(&mut memory), self.size, offset, extent, texels);
                self.texels = Texels::Memory(memory);
            }
        }
        Ok(())
    }
}

/// Copies a tight box of texels into an image of `size`.
fn blit(image: &mut [u8], size: [u32; 3], offset: [u32; 3], extent: [u32; 3], texels: &[u8]) {
    let [width, height, _] = size.map(|n| n as usize);
    let [x, y, z] = offset.map(|n| n as usize);
    let [columns, rows, _] = extent.map(|n| n as usize);
    let row_bytes = columns * TEXEL_BYTES;
    for (i, row) in texels.chunks_exact(row_bytes.max(1)).enumerate() {
        let (slice, line) = (z + i / rows, y + i % rows);
        let start = ((slice * height + line) * width + x) * TEXEL_BYTES;
        image[start..start + row_bytes].copy_from_slice(row);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use afterglow_api::constants::GL_RGBA;

    fn level(size: [u32; 3]) -> Level {
        Level::new(size, 0, InternalFormat::from_gl(GL_RGBA).unwrap())
    }

    fn bytes(level: &Level) -> Vec<u8> {
        match &level.texels {
            Texels::Memory(memory) => memory.as_chunks::<4>().0.iter().map(|texel| texel[0]).collect(),
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn regions_are_written() {
        let mut level = level([3, 2, 2]);
        let texels: Arc<[u8]> = [1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3, 4, 4, 4, 4].into();
        level.write([1, 1, 0], [2, 1, 2], &texels).unwrap();
        assert_eq!(bytes(&level), [0, 0, 0, 0, 1, 2, 0, 0, 0, 0, 3, 4]);
        level.write([0, 0, 1], [1, 2, 1], &texels[..8].into()).unwrap();
        assert_eq!(bytes(&level), [0, 0, 0, 0, 1, 2, 1, 0, 0, 2, 3, 4]);
    }

    #[test]
    fn whole_levels_are_shared() {
        let mut level = level([2, 1, 1]);
        let texels: Arc<[u8]> = [9; 8].into();
        level.write([0; 3], [2, 1, 1], &texels).unwrap();
        assert!(matches!(&level.texels, Texels::Memory(memory) if Arc::ptr_eq(memory, &texels)));
        // Whoever holds the old texels keeps them.
        level.write([0; 3], [1, 1, 1], &[5; 4].into()).unwrap();
        assert_eq!((bytes(&level), texels[0]), (vec![5, 9], 9));
    }
}
