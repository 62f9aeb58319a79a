//! State on its way to the frame: groups that have changed since they were last written, and are read by what is drawn,
//! become entries of the frame's tables.

use bitflags::bitflags;
use hashbrown::HashMap;

use crate::assemble::PolygonMode;
use crate::context::Context;
use crate::emit::Kind;
use crate::frame::*;
use crate::state::{Cap, TextureUnit};

bitflags! {
    /// Groups of state that have changed since they were last written to the frame.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub struct Dirty: u16 {
        /// What shaders compute.
        const WORDS = 1;
        const VIEWPORT = 2;
        const BINDINGS = 4;
        const TRANSFORM = 8;
        const LIGHTS = 16;
        const MATERIAL = 32;
        const ENVIRONMENT = 64;
        const TEXGEN = 128;
        const TEXTURE_MATRICES = 256;
        const CLIP_PLANES = 512;
        /// Rasterization and what happens to fragments.
        const RASTER = 1024;
        /// What the program says of draws.
        const HINT = 2048;
    }
}

/// What was last written to the frame's tables.
#[derive(Debug)]
pub struct Tables {
    /// Groups that must be written again.
    pub dirty: Dirty,
    /// Attribute slots whose current value has changed since it was written.
    pub changed: [bool; SLOTS],
    /// The entries that hold now.
    pub ids: Ids,
    /// Counts the changes of `ids`.
    pub revision: u64,
    kind: Kind,
    /// Tables that are empty.
    empty: Dirty,
    fixed: FixedState,
    fixed_ids: HashMap<FixedState, u32>,
    /// The id that another one took the place of.
    fixed_before: u32,
    /// What each unit samples.
    sampled: [Option<Sampled>; TEXTURE_UNITS],
}

/// What other state follows from the texture of a unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sampled {
    pub dimension: Dimension,
    pub base_format: BaseFormat,
    /// Level bias of the texture.
    pub lod_bias: f32,
    /// Comparison and depth mode words, if it has depths.
    pub depth_words: Option<(u32, u32)>,
}

/// Entries of the frame's tables, by their indices, as in [`Draw`].
#[derive(Debug, Clone, Copy, Default)]
pub struct Ids {
    pub fixed: u32,
    pub viewport: u32,
    pub bindings: u32,
    pub transform: u32,
    pub lights: u32,
    pub material: u32,
    pub environment: u32,
    pub texgen: u32,
    pub texture_matrices: u32,
    pub clip_planes: u32,
    pub current: u32,
    pub hint: u32,
}

impl Default for Tables {
    fn default() -> Tables {
        Tables {
            dirty: Dirty::all(),
            changed: [true; SLOTS],
            ids: Ids::default(),
            revision: 0,
            kind: Kind::Points,
            empty: Dirty::all(),
            fixed: FixedState::default(),
            fixed_ids: HashMap::new(),
            fixed_before: 0,
            sampled: [None; TEXTURE_UNITS],
        }
    }
}

impl Tables {
    /// All tables are empty again.
    pub fn start_frame(&mut self) {
        (self.dirty, self.empty) = (Dirty::all(), Dirty::all());
        self.changed = [true; SLOTS];
        self.fixed_ids.clear();
    }
}

fn push<T>(table: &mut Vec<T>, value: T) -> u32 {
    table.push(value);
    (table.len() - 1) as u32
}

impl Context {
    /// Writes what has changed, and what this draw needs, to the frame's tables.
    pub(crate) fn validate(&mut self, layout: VertexLayout, kind: Kind) {
        if kind != self.tables.kind {
            self.tables.kind = kind;
            self.tables.dirty |= Dirty::WORDS | Dirty::RASTER;
        }
        if !self.tables.dirty.is_empty() {
            self.write_tables(kind);
        }
        let absent = |slot: usize| layout.format(slot) == Format::Absent;
        let has_changed = |slot: usize| self.tables.changed[slot] && absent(slot);
        if self.tables.changed != [false; SLOTS]
            && ((0..SLOTS).any(has_changed) || self.frame.current.is_empty())
        {
            let block = self.current_attributes();
            self.tables.revision += 1;
            self.tables.ids.current = push(&mut self.frame.current, block);
            self.tables.changed = [false; SLOTS];
        }
    }

    fn write_tables(&mut self, kind: Kind) {
        if self.tables.dirty.contains(Dirty::BINDINGS) {
            self.write_bindings();
            if self.said.has_maps() {
                self.tables.dirty |= Dirty::HINT;
            }
        }
        let dirty = self.tables.dirty;
        if dirty.intersects(Dirty::WORDS | Dirty::RASTER) {
            if dirty.contains(Dirty::WORDS) {
                self.tables.fixed.words = self.state_words(kind);
            }
            if dirty.contains(Dirty::RASTER) {
                self.tables.fixed.raster = self.raster_state(kind);
            }
            self.find_fixed();
        }
        // Blocks that no enabled function reads stay dirty, but every table has at least one entry.
        let written = dirty & (self.read_groups() | self.tables.empty);
        let blocks = written & !(Dirty::BINDINGS | Dirty::WORDS | Dirty::RASTER);
        if !blocks.is_empty() {
            self.tables.revision += 1;
            self.write_blocks(blocks);
        }
        self.tables.dirty = dirty & !written;
        self.tables.empty = Dirty::empty();
    }

    /// Names the fixed state. Programs often switch something on and off again: then it is the one before last.
    fn find_fixed(&mut self) {
        let (tables, table) = (&mut self.tables, &mut self.frame.fixed);
        let is_at = |id: u32| table.get(id as usize) == Some(&tables.fixed);
        if is_at(tables.ids.fixed) {
            return;
        }
        let id = if is_at(tables.fixed_before) {
            tables.fixed_before
        } else {
            *tables.fixed_ids.entry(tables.fixed).or_insert_with(|| push(table, tables.fixed))
        };
        tables.revision += 1;
        tables.fixed_before = std::mem::replace(&mut tables.ids.fixed, id);
    }

    /// Groups that an enabled function reads.
    fn read_groups(&self) -> Dirty {
        let mut read = Dirty::all() & !(Dirty::LIGHTS | Dirty::MATERIAL | Dirty::TEXGEN | Dirty::CLIP_PLANES);
        let generates = |unit: &TextureUnit| unit.gen_enabled != 0;
        read.set(Dirty::LIGHTS | Dirty::MATERIAL, self.state.caps.has(Cap::Lighting));
        read.set(Dirty::TEXGEN, self.state.texture.units.iter().any(generates));
        read.set(Dirty::CLIP_PLANES, self.state.transform.clip_enabled != 0);
        read
    }

    /// Writes the blocks of these groups.
    fn write_blocks(&mut self, groups: Dirty) {
        if groups.contains(Dirty::VIEWPORT) {
            let block = self.viewport_block();
            self.tables.ids.viewport = push(&mut self.frame.viewports, block);
        }
        if groups.contains(Dirty::TRANSFORM) {
            let block = self.transform_block();
            self.tables.ids.transform = push(&mut self.frame.transforms, block);
        }
        if groups.contains(Dirty::ENVIRONMENT) {
            let block = self.environment_block();
            self.tables.ids.environment = push(&mut self.frame.environments, block);
        }
        if groups.contains(Dirty::LIGHTS) {
            let block = self.lights_block();
            self.tables.ids.lights = push(&mut self.frame.lights, block);
        }
        if groups.contains(Dirty::MATERIAL) {
            self.tables.ids.material = push(&mut self.frame.materials, self.state.lighting.material);
        }
        if groups.contains(Dirty::TEXGEN) {
            let units = std::array::from_fn(|i| self.state.texture.units[i].gen_planes);
            self.tables.ids.texgen = push(&mut self.frame.texgens, TexGen { units });
        }
        if groups.contains(Dirty::TEXTURE_MATRICES) {
            let units = std::array::from_fn(|i| Matrix {
                columns: self.matrices.texture[i].top().to_cols_array_2d(),
            });
            self.tables.ids.texture_matrices =
                push(&mut self.frame.texture_matrices, TextureMatrices { units });
        }
        if groups.contains(Dirty::CLIP_PLANES) {
            let plane =
                |i: usize| Plane { coefficients: self.state.transform.clip_planes[i].map(|v| v as f32) };
            let planes = std::array::from_fn(plane);
            self.tables.ids.clip_planes = push(&mut self.frame.clip_planes, ClipPlanes { planes });
        }
        if groups.contains(Dirty::HINT) {
            self.tables.ids.hint = self.write_hint();
        }
    }

    /// Makes sure that the enabled textures have images, and writes what the units sample.
    fn write_bindings(&mut self) {
        let mut bindings: Bindings = [None; TEXTURE_UNITS];
        let mut sampled = [None; TEXTURE_UNITS];
        for unit in 0..TEXTURE_UNITS {
            if let Some(texture) = self.textures.enabled(&self.state.texture.units[unit], unit) {
                let mut texture = texture.lock();
                if let Some(image) = texture.realize(&mut self.frame.operations) {
                    sampled[unit] = Some(Sampled {
                        dimension: image.shape.dimension,
                        base_format: image.base_format,
                        lod_bias: texture.lod_bias(),
                        depth_words: texture.depth_words(),
                    });
                    bindings[unit] = Some(TextureBinding { image: image.image, sampler: texture.sampler() });
                }
            }
        }
        if sampled != self.tables.sampled {
            self.tables.sampled = sampled;
            self.tables.dirty |= Dirty::WORDS | Dirty::ENVIRONMENT;
        }
        if self.frame.bindings.last() != Some(&bindings) {
            self.tables.revision += 1;
            push(&mut self.frame.bindings, bindings);
        }
        self.tables.ids.bindings = self.frame.bindings.len() as u32 - 1;
    }

    /// State of a rectangle of pixels: as for points, without lighting.
    pub(crate) fn validate_pixels(&mut self) -> (u32, u32, u32, u32, u32) {
        self.validate(VertexLayout::default(), Kind::Polygons(PolygonMode::Fill));
        let ids = self.tables.ids;
        (ids.fixed, ids.viewport, ids.bindings, ids.environment, ids.current)
    }

    /// What a unit samples, if anything.
    pub(crate) fn sampled(&self, unit: usize) -> Option<Sampled> {
        self.tables.sampled[unit]
    }
}
