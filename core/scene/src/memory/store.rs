//! Worlds of earlier runs: what is written to disk of a memory, and how it comes back.
//!
//! A stored world is used once enough of it was drawn in this run, at the same places: then it is the same level in
//! the same coordinates. Its cells come back one by one as their textures, known by content, are there.

use afterglow_gl::frame::{ImageKey, TEXTURE_UNITS, TextureBinding};
use glam::Mat4;
use hashbrown::{HashMap, HashSet};

use super::Memory;
use super::blocks::Heap;
use super::cells::{Cell, Pass};
use super::entries::Entry;
use super::keys::{Positions, fold, triangle_key};
use super::look::{Kind, Look, MAPS, maps, maps_mut};
use super::notice::{SIGHTINGS, whole_content};

/// Triangles of a stored world that must have been drawn in this run before it is used, and their least share.
const LEAST_MET: usize = 32;
const LEAST_SHARE: f32 = 0.02;
/// Cells that stand for a stored world when it is looked for, at most.
const SAMPLED_CELLS: usize = 256;

/// A pass whose images are known by their content alone.
#[derive(Debug, Clone)]
pub struct StoredPass {
    /// Its look names no images, or those of the run that stored it.
    pub pass: Pass,
    /// Content of the image of each unit that has one.
    pub contents: [u64; TEXTURE_UNITS],
    /// Likewise of each map that the program says of the material.
    pub map_contents: [u64; MAPS],
}

/// A cell without numbers of this run.
#[derive(Debug, Clone)]
pub struct StoredCell {
    /// Object to world space.
    pub model: Mat4,
    /// The object that it is of, or 0.
    pub object: u64,
    /// Its colours are baked light.
    pub baked: bool,
    /// Its triangles are only known together.
    pub is_whole: bool,
    /// Of each entry, the side that it was seen from.
    pub sides: Vec<bool>,
    /// The surface and the layers over it.
    pub passes: Vec<StoredPass>,
}

/// What was remembered of a world.
#[derive(Debug, Clone, Default)]
pub struct StoredWorld {
    /// All of it.
    pub cells: Vec<StoredCell>,
}

/// Images of this run by the hash of their content.
pub type ImagesByContent = HashMap<u64, ImageKey>;

impl StoredWorld {
    /// Leaves the last cells out, so that the others have about so many bytes at most.
    pub fn bound(&mut self, most: u64) {
        let mut bytes = 0;
        let mut ranges = HashSet::new();
        let mut fits = |cell: &StoredCell| {
            for StoredPass { pass, .. } in &cell.passes {
                let is_new = ranges.insert(pass.range.id());
                bytes += (size_of::<StoredPass>() + size_of::<Look>()) as u64
                    + if is_new { pass.bytes() } else { 0 };
            }
            bytes += cell.sides.len() as u64;
            bytes <= most
        };
        let kept = self.cells.iter().take_while(|cell| fits(cell)).count();
        self.cells.truncate(kept);
    }
}

impl StoredCell {
    /// How many triangles it has.
    pub fn triangles(&self) -> usize {
        self.passes.first().map_or(0, |pass| pass.pass.index_count as usize / 3)
    }

    /// The keys of its entries at a place; none of what has no area.
    fn keys(&self, place: u32) -> Vec<Option<u64>> {
        let pass = &self.passes[0].pass;
        if self.is_whole {
            return vec![Some(fold(whole_content(pass), u64::from(place)))];
        }
        let positions = Positions::new(&pass.range.words, pass.range.layout);
        let triangles = pass.indices().chunks_exact(3);
        triangles.map(|indices| Some(triangle_key(positions.corners(indices)?, place))).collect()
    }

    /// Its passes with images of this run; none if one of them is not there.
    fn resolved(&self, images: &ImagesByContent) -> Option<Vec<Pass>> {
        let resolve = |stored: &StoredPass| {
            let mut look: Look = *stored.pass.look;
            for (binding, content) in look.bindings.iter_mut().zip(&stored.contents) {
                if let Some(binding) = binding {
                    binding.image = *images.get(content)?;
                }
            }
            for (map, content) in maps_mut(&mut look.said).into_iter().zip(&stored.map_contents) {
                if let Some(map) = map {
                    map.image = *images.get(content)?;
                }
            }
            Some(Pass { look: look.into(), ..stored.pass.clone() })
        };
        self.passes.iter().map(resolve).collect()
    }
}

/// The content of the image of each binding; 0 where there is none.
fn contents_of<const N: usize>(
    bindings: &[Option<TextureBinding>; N],
    content: impl Fn(ImageKey) -> Option<u64>,
) -> Option<[u64; N]> {
    let mut contents = [0; N];
    for (found, binding) in contents.iter_mut().zip(bindings) {
        if let Some(binding) = binding {
            *found = content(binding.image)?;
        }
    }
    Some(contents)
}

impl Memory {
    /// What is remembered, with textures by content. Cells with textures that are not known are left out.
    pub(super) fn stored(&self, content: impl Fn(ImageKey) -> Option<u64>) -> StoredWorld {
        let cell = |cell: &Cell| {
            let kind = self.kinds.get(cell.kind);
            let passes: Option<Vec<StoredPass>> = cell
                .passes
                .iter()
                .map(|pass| {
                    let contents = contents_of(&pass.look.bindings, &content)?;
                    let map_contents = contents_of(&maps(&pass.look.said), &content)?;
                    Some(StoredPass { pass: pass.clone(), contents, map_contents })
                })
                .collect();
            let sides = cell.entries.iter().map(|entry| self.entries.get(*entry).from_front).collect();
            let (model, object, baked) = (kind.model, kind.object, kind.baked);
            Some(StoredCell { model, object, baked, is_whole: cell.is_whole, sides, passes: passes? })
        };
        StoredWorld { cells: self.cells.iter().flatten().filter_map(cell).collect() }
    }

    /// Whether enough of a stored world was drawn in this run.
    pub(super) fn has_met(&self, world: &StoredWorld) -> bool {
        let (mut met, mut all) = (0, 0);
        for cell in world.cells.iter().step_by(world.cells.len().div_ceil(SAMPLED_CELLS).max(1)) {
            let Some(place) = self.places.find(&cell.model) else {
                all += cell.passes[0].pass.index_count as usize / 3;
                continue;
            };
            let weight = cell.passes[0].pass.index_count as usize / 3 / cell.sides.len().max(1);
            for key in cell.keys(place).into_iter().flatten() {
                all += weight;
                met += if self.entries.is_remembered(key) { weight } else { 0 };
            }
        }
        met >= LEAST_MET && met as f32 >= LEAST_SHARE * all as f32
    }

    /// Takes a stored cell up, but for what is known of it already. Says whether its images were there.
    pub(super) fn adopt(&mut self, stored: &StoredCell, images: &ImagesByContent) -> bool {
        let Some(passes) = stored.resolved(images) else { return false };
        let place = self.places.number(&stored.model);
        let looks = passes.iter().map(|pass| (pass.look.clone(), pass.range.layout)).collect();
        let model = self.places.model(place);
        let StoredCell { object, baked, .. } = *stored;
        let kind = self.kinds.number(Kind { passes: looks, model, place, object, baked });
        let keys = stored.keys(place);
        let mut numbers = Vec::with_capacity(keys.len());
        let mut new = HashSet::new();
        for (key, side) in keys.into_iter().zip(&stored.sides) {
            let key = key.filter(|key| !self.entries.is_remembered(*key));
            let number = key.map(|key| self.entries.number(key));
            if let Some(number) = number {
                let entry: &mut Entry = self.entries.get_mut(number);
                (entry.sightings, entry.from_front) = (SIGHTINGS, *side);
                new.insert(number);
            }
            numbers.push(number.unwrap_or(super::NO_CELL));
        }
        if new.is_empty() {
            return true;
        }
        // Draws that were told apart from these triangles are looked up again.
        self.memos.clear();
        let cell = Cell::new(kind, model, passes, numbers, self.now.saturating_sub(1));
        if stored.is_whole {
            self.contents.insert(whole_content(&cell.passes[0]));
            self.add_whole(cell);
            return true;
        }
        let mut heap = Heap::default();
        heap.piles.entry(kind).or_default().add_cell(&cell, |number| new.contains(&number));
        self.close(heap);
        true
    }
}
