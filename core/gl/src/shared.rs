//! Names that contexts of a share group have in common.

use std::sync::Arc;

use hashbrown::HashMap;
use parking_lot::Mutex;

use crate::buffers::Buffer;
use crate::lists::List;
use crate::texture::TextureObject;

/// A texture that contexts share.
pub type SharedTexture = Arc<Mutex<TextureObject>>;
/// A buffer that contexts share.
pub type SharedBuffer = Arc<Buffer>;

/// All shared names.
#[derive(Default)]
pub struct Names {
    /// Display lists; a reserved name has an empty one.
    pub lists: HashMap<u32, Arc<List>>,
    /// Textures; `None` for names that glGenTextures gave out and nobody has bound.
    pub textures: HashMap<u32, Option<SharedTexture>>,
    /// Buffers, likewise.
    pub buffers: HashMap<u32, Option<SharedBuffer>>,
    /// The device that the textures' images are on.
    device: u64,
    last_list: u32,
    last_texture: u32,
    last_buffer: u32,
}

/// Handle of a share group.
pub type SharedNames = Arc<Mutex<Names>>;

impl Names {
    /// The first of `range` names in a row that are lists from now on; 0 if there are not so many.
    pub fn reserve_lists(&mut self, range: u32) -> u32 {
        if range == 0 {
            return 0;
        }
        let mut first = self.last_list.wrapping_add(1).max(1);
        while let Some(used) = (first..first.saturating_add(range)).rev().find(|n| self.lists.contains_key(n))
        {
            first = used + 1;
        }
        let Some(last) = first.checked_add(range - 1) else { return 0 };
        (first..=last).for_each(|name| drop(self.lists.insert(name, Arc::default())));
        self.last_list = last;
        first
    }

    /// `n` texture names that were not in use.
    pub fn generate_textures(&mut self, n: usize) -> Vec<u32> {
        generate(&mut self.textures, &mut self.last_texture, n)
    }

    /// Textures that are to leave their images, which were on another device.
    pub fn move_to(&mut self, device: u64) -> Vec<SharedTexture> {
        match std::mem::replace(&mut self.device, device) == device {
            true => Vec::new(),
            false => self.textures.values().flatten().cloned().collect(),
        }
    }

    /// `n` buffer names that were not in use.
    pub fn generate_buffers(&mut self, n: usize) -> Vec<u32> {
        generate(&mut self.buffers, &mut self.last_buffer, n)
    }
}

fn generate<T>(table: &mut HashMap<u32, Option<T>>, last: &mut u32, n: usize) -> Vec<u32> {
    let mut fresh = || {
        loop {
            *last = last.wrapping_add(1).max(1);
            if !table.contains_key(last) {
                table.insert(*last, None);
                return *last;
            }
        }
    };
    (0..n).map(|_| fresh()).collect()
}
