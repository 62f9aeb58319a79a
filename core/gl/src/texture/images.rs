//! The images that a texture has on the device. One, the main image, is what draws sample; others hold levels
//! that exist only on the device and have no place in the main image yet.

use crate::frame::{BaseFormat, ImageKey, ImageShape, Operation, Region};

/// Size of a level that is `steps` above one of size `size` (specification, 3.8.8: halves, rounded down).
pub fn mip_size(size: [u32; 3], steps: usize) -> [u32; 3] {
    size.map(|n| (n >> steps).max(1))
}

/// An image on the device.
#[derive(Debug, Clone, Copy)]
pub struct OwnedImage {
    /// Its name.
    pub key: ImageKey,
    /// Its shape.
    pub shape: ImageShape,
    /// Level of the texture that is level 0 of the image.
    pub base: usize,
}

impl OwnedImage {
    /// Which of the image's levels is level `level` of the texture.
    pub fn level(&self, level: usize) -> Option<u32> {
        let relative = level.checked_sub(self.base)?;
        u32::try_from(relative).ok().filter(|relative| *relative < self.shape.levels)
    }

    /// The image has a place for a level of that size and format.
    pub fn fits(&self, level: usize, size: [u32; 3], base_format: BaseFormat) -> bool {
        let whole = [self.shape.width, self.shape.height, self.shape.depth];
        self.shape.base_format == base_format
            && self.level(level).is_some_and(|relative| mip_size(whole, relative as usize) == size)
    }

    /// A box of texels of level `level` of the texture.
    pub fn region(&self, level: usize, face: usize, offset: [u32; 3], extent: [u32; 3]) -> Region {
        Region { level: self.level(level).unwrap_or(0), layer: face as u32, offset, extent }
    }
}

/// All images of a texture.
#[derive(Debug, Default)]
pub struct Images {
    owned: Vec<OwnedImage>,
    main: Option<ImageKey>,
}

impl Images {
    /// The image of that name.
    pub fn get(&self, key: ImageKey) -> Option<&OwnedImage> {
        self.owned.iter().find(|image| image.key == key)
    }

    /// An image with a place for a level of that size and format, the main image if it has one.
    pub fn home(&self, level: usize, size: [u32; 3], base_format: BaseFormat) -> Option<OwnedImage> {
        let fits = |image: &&OwnedImage| image.fits(level, size, base_format);
        let main = self.main.and_then(|key| self.get(key)).filter(fits);
        main.or_else(|| self.owned.iter().find(fits)).copied()
    }

    /// Makes the main image one of that shape (or more levels), new if there is none such.
    pub fn set_main(&mut self, shape: ImageShape, base: usize, out: &mut Vec<Operation>) -> OwnedImage {
        let fits = |image: &&OwnedImage| {
            let enough = ImageShape { levels: image.shape.levels.max(shape.levels), ..shape };
            image.base == base && image.shape == enough
        };
        let main = self.main.and_then(|key| self.get(key)).filter(fits);
        let found = main.or_else(|| self.owned.iter().find(fits)).copied();
        let image = found.unwrap_or_else(|| self.define(shape, base, out));
        self.main = Some(image.key);
        image
    }

    /// A new image.
    pub fn define(&mut self, shape: ImageShape, base: usize, out: &mut Vec<Operation>) -> OwnedImage {
        let image = OwnedImage { key: ImageKey::unique(), shape, base };
        self.owned.push(image);
        out.push(Operation::DefineImage { image: image.key, shape });
        image
    }

    /// Drops all images but the main one and those that `needed` names.
    pub fn collect(&mut self, needed: impl Fn(ImageKey) -> bool, out: &mut Vec<Operation>) {
        let main = self.main;
        self.owned.retain(|image| {
            let keep = Some(image.key) == main || needed(image.key);
            if !keep {
                out.push(Operation::DropImage(image.key));
            }
            keep
        });
    }

    /// Drops all images.
    pub fn drop_all(&mut self, out: &mut Vec<Operation>) {
        self.main = None;
        self.collect(|_| false, out);
    }

    /// How many images there are.
    pub fn len(&self) -> usize {
        self.owned.len()
    }
}
