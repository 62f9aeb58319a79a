//! Which images take the place of a program's textures.
//!
//! A texture is known by the hash of its content, which scene recovery has of every image. The first time that a hash is
//! drawn with, the folder is asked for it; what arrives becomes an image like any other, uploaded at the beginning of a
//! frame. Textures without a picture, or whose pictures are still to come, are drawn as they are.

use std::collections::HashMap;
use std::collections::hash_map::Entry;

use afterglow_gl::frame::{BaseFormat, Dimension, Frame, ImageKey, TexelFormat};
use afterglow_gpu::{Gpu, vk};
use afterglow_images::{Abilities, Arrival, Channels, FileName, Folder, Picture, Role};
use afterglow_scene::Recovery;

use crate::pathtrace::ImageOptions;

/// Bytes of pictures on the device, at most.
const MOST_BYTES: u64 = 2 << 30;
/// Bytes of pictures that arrive in a frame which waits for none, unless a single one is larger.
const MOST_BYTES_A_FRAME: u64 = 64 << 20;
/// Textures without pictures are forgotten when they were not drawn for so many frames.
const IDLE_FRAMES: u64 = 600;

/// A picture that is to become an image.
#[derive(Debug)]
pub(crate) struct Arrived {
    pub(crate) key: ImageKey,
    pub(crate) picture: Picture,
    /// How what is stored becomes a texel.
    pub(crate) swizzle: [vk::ComponentSwizzle; 4],
}

/// What takes the place of a texture in one role.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Replacement {
    pub(crate) key: ImageKey,
    pub(crate) channels: Channels,
    bytes: u64,
}

/// What is known of a texture's content.
#[derive(Debug)]
struct Known {
    base_format: BaseFormat,
    /// By [`Role`].
    images: [Option<Replacement>; Role::ALL.len()],
    /// The last frame that drew with it.
    used: u64,
}

/// All replacements of a renderer.
pub(crate) struct Replacements {
    folder: Folder,
    waits: bool,
    /// By the hash of what they replace.
    known: HashMap<u64, Known>,
    /// Hashes of images, and the last frame that drew with them.
    hashes: HashMap<ImageKey, (u64, u64)>,
    arrived: Vec<Arrived>,
    dropped: Vec<ImageKey>,
    bytes: u64,
    is_full: bool,
    frame: u64,
}

impl Replacements {
    /// None if the folder cannot be looked after, of which a log line tells.
    pub(crate) fn open(gpu: &Gpu, options: &ImageOptions) -> Option<Self> {
        let abilities = Abilities { compressed: gpu.features().texture_compression_bc };
        let folder = Folder::open(options.folder.clone(), abilities);
        let folder = folder.map_err(|error| tracing::warn!("no images are replaced: {error}")).ok()?;
        Some(Self {
            folder,
            waits: options.waits,
            known: HashMap::new(),
            hashes: HashMap::new(),
            arrived: Vec::new(),
            dropped: Vec::new(),
            bytes: 0,
            is_full: false,
            frame: 0,
        })
    }

    /// What replaces an image in this role.
    pub(crate) fn get(&self, image: ImageKey, role: Role) -> Option<&Replacement> {
        let (hash, _) = self.hashes.get(&image)?;
        self.known.get(hash)?.images[role as usize].as_ref()
    }

    /// Hashes of what was drawn with.
    #[cfg(test)]
    pub(crate) fn hashes(&self) -> impl Iterator<Item = u64> {
        self.hashes.values().map(|(hash, _)| *hash)
    }

    /// All images that were made or are to be made.
    pub(crate) fn images(&self) -> impl Iterator<Item = ImageKey> {
        let made = self.known.values().flat_map(|known| known.images.iter().flatten());
        made.map(|made| made.key).chain(self.dropped.iter().copied())
    }

    /// Asks for what replaces a frame's textures, and takes what has come. Says whether that changes anything.
    pub(crate) fn begin_frame(&mut self, frame: &Frame, recovery: &Recovery) -> bool {
        self.frame += 1;
        let units = frame.bindings.iter().flatten().flatten().map(|binding| binding.image);
        let maps = frame.hints.iter().flat_map(|hint| {
            let said = hint.material;
            [said.normal_map, said.metallic_roughness_map, said.emission_map].into_iter().flatten()
        });
        let mut asked = 0;
        for image in units.chain(maps.map(|map| map.image)) {
            asked += u32::from(self.note(image, recovery));
        }
        self.receive(asked);
        if self.frame.is_multiple_of(IDLE_FRAMES) {
            self.forget_idle();
        }
        !self.arrived.is_empty() || !self.dropped.is_empty()
    }

    /// Pictures that are to become images before anything is drawn.
    pub(crate) fn take_arrived(&mut self) -> Vec<Arrived> {
        std::mem::take(&mut self.arrived)
    }

    /// Images that nothing names any more.
    pub(crate) fn take_dropped(&mut self) -> Vec<ImageKey> {
        std::mem::take(&mut self.dropped)
    }

    /// Forgets images that the program has dropped.
    pub(crate) fn end_frame(&mut self, dropped: &[ImageKey]) {
        for image in dropped {
            self.hashes.remove(image);
        }
    }

    /// Takes note of an image that is drawn with. Says whether the folder was asked for it.
    fn note(&mut self, image: ImageKey, recovery: &Recovery) -> bool {
        let noted = self.hashes.get(&image);
        if noted.is_some_and(|(_, frame)| *frame == self.frame) {
            return false;
        }
        // What a frame drops is not known to recovery when it is drawn; it is what it was.
        let facts = recovery.image(image).filter(|facts| {
            let shape = facts.shape();
            shape.dimension == Dimension::D2 && shape.format == TexelFormat::Rgba8
        });
        let Some(hash) = facts.map(|facts| facts.content()).or(noted.map(|(hash, _)| *hash)) else {
            return false;
        };
        self.hashes.insert(image, (hash, self.frame));
        match self.known.entry(hash) {
            Entry::Occupied(known) => {
                known.into_mut().used = self.frame;
                false
            }
            Entry::Vacant(unknown) => {
                let base_format = facts.map_or(BaseFormat::Rgba, |facts| facts.shape().base_format);
                unknown.insert(Known { base_format, images: [None; Role::ALL.len()], used: self.frame });
                self.folder.ask(hash);
                true
            }
        }
    }

    /// Takes what has arrived; where frames wait, all that so many requests bring.
    fn receive(&mut self, mut asked: u32) {
        let before = self.bytes;
        loop {
            let arrival = match self.waits && asked > 0 {
                true => self.folder.wait(),
                false => self.folder.arrival(),
            };
            match arrival {
                None => return,
                Some(Arrival::All { .. }) => asked = asked.saturating_sub(1),
                Some(Arrival::Picture { name, picture }) => self.take(name, picture),
            }
            if !self.waits && self.bytes.saturating_sub(before) > MOST_BYTES_A_FRAME {
                return;
            }
        }
    }

    /// Takes a picture in place of what there was.
    fn take(&mut self, FileName { hash, role }: FileName, picture: Option<Picture>) {
        let Some(known) = self.known.get_mut(&hash) else { return };
        let base_format = known.base_format;
        if let Some(old) = known.images[role as usize].take() {
            self.drop_image(&old);
        }
        let Some(picture) = picture.filter(|picture| self.makes_room(picture.bytes())) else { return };
        let (key, channels, bytes) = (ImageKey::unique(), picture.channels, picture.bytes());
        self.bytes += bytes;
        if let Some(known) = self.known.get_mut(&hash) {
            known.images[role as usize] = Some(Replacement { key, channels, bytes });
        }
        self.arrived.push(Arrived { key, picture, swizzle: swizzle(role, channels, base_format) });
    }

    fn drop_image(&mut self, old: &Replacement) {
        self.bytes -= old.bytes;
        self.arrived.retain(|arrived| arrived.key != old.key);
        self.dropped.push(old.key);
    }

    /// Gives up pictures that were not drawn for longest, until so many bytes fit. Says whether they do.
    fn makes_room(&mut self, bytes: u64) -> bool {
        while self.bytes + bytes > MOST_BYTES {
            let idle = self
                .known
                .iter()
                .filter(|(_, known)| known.used < self.frame && known.images.iter().any(Option::is_some));
            let Some(hash) = idle.min_by_key(|(hash, known)| (known.used, **hash)).map(|(hash, _)| *hash)
            else {
                if !std::mem::replace(&mut self.is_full, true) {
                    tracing::warn!("more than {} MiB of images: the rest is left out", MOST_BYTES >> 20);
                }
                return false;
            };
            self.forget(hash);
        }
        true
    }

    /// Forgets what there is no picture for, and what is not drawn any more. The folder is asked anew if it ever is.
    fn forget_idle(&mut self) {
        let is_idle =
            |known: &Known| known.images.iter().all(Option::is_none) && known.used + IDLE_FRAMES < self.frame;
        let idle: Vec<u64> =
            self.known.iter().filter(|(_, known)| is_idle(known)).map(|(hash, _)| *hash).collect();
        idle.into_iter().for_each(|hash| self.forget(hash));
    }

    fn forget(&mut self, hash: u64) {
        self.folder.forget(hash);
        let Some(known) = self.known.remove(&hash) else { return };
        known.images.iter().flatten().for_each(|old| self.drop_image(old));
    }
}

/// How what a picture stores becomes a texel that replaces one of this base format: alpha that the program's texture
/// does not have is 1, colour 0. Without alpha of their own, pictures are opaque, rough and no metal.
fn swizzle(role: Role, channels: Channels, base_format: BaseFormat) -> [vk::ComponentSwizzle; 4] {
    use vk::ComponentSwizzle as Swizzle;
    const RGB: [Swizzle; 3] = [Swizzle::R, Swizzle::G, Swizzle::B];
    let stored = match channels {
        Channels::Grey => [Swizzle::R; 3],
        Channels::Two => [Swizzle::R, Swizzle::G, Swizzle::ZERO],
        Channels::Rgb | Channels::Rgba => RGB,
    };
    let has_alpha = channels == Channels::Rgba;
    let [r, g, b] = match (role, base_format) {
        (Role::Color, BaseFormat::Alpha) => [Swizzle::ZERO; 3],
        _ => stored,
    };
    let alpha = match (role, base_format) {
        (Role::Color, BaseFormat::Luminance | BaseFormat::Rgb) => Swizzle::ONE,
        (Role::Color, BaseFormat::Alpha | BaseFormat::Intensity) if !has_alpha => Swizzle::R,
        (Role::Normal, _) if !has_alpha => Swizzle::ZERO,
        _ if !has_alpha => Swizzle::ONE,
        _ => Swizzle::A,
    };
    [r, g, b, alpha]
}

#[cfg(test)]
mod tests {
    use super::*;
    use vk::ComponentSwizzle as Swizzle;

    #[test]
    fn what_a_picture_lacks_is_chosen_by_what_it_is_for() {
        let alpha = |role, channels, base_format| swizzle(role, channels, base_format)[3];
        assert_eq!(alpha(Role::Color, Channels::Rgb, BaseFormat::Rgba), Swizzle::ONE);
        assert_eq!(alpha(Role::Color, Channels::Rgba, BaseFormat::Rgba), Swizzle::A);
        assert_eq!(alpha(Role::Color, Channels::Rgba, BaseFormat::Rgb), Swizzle::ONE);
        assert_eq!(alpha(Role::Color, Channels::Grey, BaseFormat::Intensity), Swizzle::R);
        assert_eq!(alpha(Role::Normal, Channels::Two, BaseFormat::Rgb), Swizzle::ZERO);
        assert_eq!(alpha(Role::Emission, Channels::Rgb, BaseFormat::Rgb), Swizzle::ONE);
        assert_eq!(alpha(Role::Emission, Channels::Rgba, BaseFormat::Rgb), Swizzle::A);
        assert_eq!(swizzle(Role::Color, Channels::Grey, BaseFormat::Luminance)[2], Swizzle::R);
    }
}
