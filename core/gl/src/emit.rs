//! From state to draws: what has changed since the last draw is written to the frame's tables, and
//! vertices become [`Draw`]s. A primitive that meets the same state as the one before extends it.

use afterglow_api::constants::*;
use bitflags::bitflags;
use hashbrown::HashMap;

use crate::assemble::{self, PolygonMode};
use crate::context::Context;
use crate::frame::*;
use crate::limits;
use crate::pixels::RenderMode;
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
    }
}

/// What a primitive is when it reaches rasterization.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Points.
    Points,
    /// Lines.
    Lines,
    /// Polygons, drawn in a mode.
    Polygons(PolygonMode),
}

impl Kind {
    /// The kind of primitives that `mode` draws.
    pub fn of(mode: u32, polygon_mode: PolygonMode) -> Kind {
        match mode {
            GL_POINTS => Kind::Points,
            GL_LINES | GL_LINE_LOOP | GL_LINE_STRIP => Kind::Lines,
            _ => Kind::Polygons(polygon_mode),
        }
    }

    /// What its indices connect.
    pub fn topology(self) -> Topology {
        match self {
            Kind::Points | Kind::Polygons(PolygonMode::Point) => Topology::Points,
            Kind::Lines | Kind::Polygons(PolygonMode::Line) => Topology::Lines,
            Kind::Polygons(PolygonMode::Fill) => Topology::Triangles,
        }
    }
}

/// Modes of glBegin.
const MODES: usize = GL_POLYGON as usize + 1;

/// What was last written to the frame's tables.
#[derive(Debug)]
pub struct Emitter {
    /// Groups that must be written again.
    pub dirty: Dirty,
    /// Attribute slots whose current value has changed since it was written.
    pub changed: [bool; SLOTS],
    kind: Kind,
    /// Tables that are empty.
    empty: Dirty,
    fixed: FixedState,
    fixed_ids: HashMap<FixedState, u32>,
    /// The id that another one took the place of.
    fixed_before: u32,
    ids: Ids,
    /// The draw that primitives of the same state continue.
    open: OpenDraw,
    /// By the mode of glBegin: where in the frame's indices those of vertices in a row are, and how many.
    patterns: [(u32, u32); MODES],
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

/// A draw that was pushed last, if nothing came in between: all that a primitive must meet to continue it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct OpenDraw {
    layout: VertexLayout,
    topology: Topology,
    /// Lengths of the frame's tables behind it.
    operations: usize,
    words: usize,
    indices: usize,
}

impl OpenDraw {
    const NONE: OpenDraw =
        OpenDraw { layout: VertexLayout(0), topology: Topology::Points, operations: 0, words: 0, indices: 0 };
}

#[derive(Debug, Clone, Copy, Default)]
struct Ids {
    fixed: u32,
    viewport: u32,
    bindings: u32,
    transform: u32,
    lights: u32,
    material: u32,
    environment: u32,
    texgen: u32,
    texture_matrices: u32,
    clip_planes: u32,
    current: u32,
}

impl Default for Emitter {
    fn default() -> Emitter {
        Emitter {
            dirty: Dirty::all(),
            changed: [true; SLOTS],
            kind: Kind::Points,
            empty: Dirty::all(),
            fixed: FixedState::default(),
            fixed_ids: HashMap::new(),
            fixed_before: 0,
            ids: Ids::default(),
            open: OpenDraw::NONE,
            patterns: [(0, 0); MODES],
            sampled: [None; TEXTURE_UNITS],
        }
    }
}

impl Emitter {
    /// All tables are empty again.
    pub fn start_frame(&mut self) {
        (self.dirty, self.empty) = (Dirty::all(), Dirty::all());
        self.changed = [true; SLOTS];
        self.fixed_ids.clear();
        self.open = OpenDraw::NONE;
        self.patterns = [(0, 0); MODES];
    }
}

fn push<T>(table: &mut Vec<T>, value: T) -> u32 {
    table.push(value);
    (table.len() - 1) as u32
}

/// Number of vertices in `words`. Frames have no more words than fit: dividing 32 bits takes half of the time of 64.
fn vertex_count(words: &[u32], layout: VertexLayout) -> usize {
    let words = u32::try_from(words.len()).unwrap_or(0);
    words.checked_div(layout.stride() as u32).unwrap_or(0) as usize
}

impl Context {
    /// The mode that polygons are drawn in. Where front and back differ, that of the side which is not culled.
    pub(crate) fn effective_polygon_mode(&self) -> PolygonMode {
        let polygon = &self.state.polygon;
        let front_culled = self.state.caps.has(Cap::CullFace) && polygon.cull_face == GL_FRONT;
        match polygon.mode[usize::from(front_culled)] {
            GL_LINE => PolygonMode::Line,
            GL_POINT => PolygonMode::Point,
            _ => PolygonMode::Fill,
        }
    }

    /// Draws vertices that were sent as `mode`.
    pub(crate) fn emit_primitive(
        &mut self,
        mode: u32,
        layout: VertexLayout,
        words: &[u32],
        edges: Option<&[bool]>,
    ) {
        let count = vertex_count(words, layout);
        let kind = Kind::of(mode, self.effective_polygon_mode());
        if !self.prepare(layout, kind, count) {
            return;
        }
        let first_index = self.frame.indices.len();
        let continued = self.extend_vertices(layout, kind, words);
        let base = continued.unwrap_or(0);
        match kind {
            Kind::Polygons(polygon_mode @ (PolygonMode::Line | PolygonMode::Point)) => {
                let flag = |i: usize| edges.is_none_or(|e| e.get(i).copied().unwrap_or(true));
                let out = &mut self.frame.indices;
                assemble::assemble_unfilled(mode, count, polygon_mode, |i| base + i as u32, flag, out);
            }
            _ => assemble::assemble(mode, count, |i| base + i as u32, &mut self.frame.indices),
        }
        self.finish_draw(first_index, layout, kind, count, continued);
    }

    /// Draws many vertices that `fill` appends to the frame's words, one after the other, sent as `mode`. `false`: such
    /// vertices must go another way.
    pub(crate) fn emit_in_order(
        &mut self,
        mode: u32,
        layout: VertexLayout,
        count: usize,
        fill: impl FnOnce(&Self, &mut Vec<u32>),
    ) -> bool {
        let kind = Kind::of(mode, self.effective_polygon_mode());
        let Some(index_count) = assemble::index_count(mode, count) else { return false };
        if matches!(kind, Kind::Polygons(PolygonMode::Line | PolygonMode::Point)) {
            return false;
        }
        if index_count == 0 || !self.prepare(layout, kind, count) {
            return true;
        }
        let mut words = std::mem::take(&mut self.frame.words);
        let first_word = words.len() as u32;
        fill(self, &mut words);
        self.frame.words = words;
        let (mut first_index, known) = self.emitter.patterns[mode as usize];
        if (known as usize) < index_count {
            first_index = self.frame.indices.len() as u32;
            assemble::assemble(mode, count, |i| i as u32, &mut self.frame.indices);
            self.emitter.patterns[mode as usize] = (first_index, index_count as u32);
        }
        let source = VertexSource::Arena { first_word, vertices: count as u32, first_index };
        self.push_draw(source, layout, kind, index_count as u32);
        true
    }

    /// Draws vertices with indices that are assembled already, as a list or an array draw has them.
    pub(crate) fn emit_indexed(&mut self, layout: VertexLayout, kind: Kind, words: &[u32], indices: &[u32]) {
        let count = vertex_count(words, layout);
        if !self.prepare(layout, kind, count) {
            return;
        }
        let first_index = self.frame.indices.len();
        let continued = self.extend_vertices(layout, kind, words);
        let base = continued.unwrap_or(0);
        self.frame.indices.extend(indices.iter().map(|i| i + base));
        self.finish_draw(first_index, layout, kind, count, continued);
    }

    /// Draws a range that outlives the frame.
    pub(crate) fn emit_retained(&mut self, range: &std::sync::Arc<RetainedRange>, kind: Kind) {
        if range.indices.is_empty() || !self.prepare(range.layout, kind, range.vertex_count()) {
            return;
        }
        let index = match self.frame.retained.last() {
            Some(last) if last.id() == range.id() => self.frame.retained.len() as u32 - 1,
            _ => push(&mut self.frame.retained, range.clone()),
        };
        let source = VertexSource::Retained { range: index, first_index: 0 };
        self.push_draw(source, range.layout, kind, range.indices.len() as u32);
    }

    /// Brings the frame's tables up to date; whether there is anything to draw.
    fn prepare(&mut self, layout: VertexLayout, kind: Kind, vertices: usize) -> bool {
        if vertices == 0 || self.mode != RenderMode::Render {
            return false;
        }
        if vertices > limits::DRAW_VERTICES {
            self.record_error(GL_OUT_OF_MEMORY);
            return false;
        }
        if self.frame.words.len() > limits::FRAME_WORDS {
            self.hand_over(crate::backend::End::Continued);
        }
        self.validate(layout, kind);
        true
    }

    /// Appends vertices; the number of those that the open draw has, if they continue it.
    fn extend_vertices(&mut self, layout: VertexLayout, kind: Kind, words: &[u32]) -> Option<u32> {
        let frame = &mut self.frame;
        let met = OpenDraw {
            layout,
            topology: kind.topology(),
            operations: frame.operations.len(),
            words: frame.words.len(),
            indices: frame.indices.len(),
        };
        frame.words.extend_from_slice(words);
        match frame.operations.last() {
            Some(Operation::Draw(Draw { source: VertexSource::Arena { vertices, .. }, .. }))
                if met == self.emitter.open =>
            {
                Some(*vertices)
            }
            _ => None,
        }
    }

    /// Draws the indices from `first_index` on, or lets the open draw go on to `count` more vertices.
    fn finish_draw(
        &mut self,
        first_index: usize,
        layout: VertexLayout,
        kind: Kind,
        count: usize,
        continued: Option<u32>,
    ) {
        let added = (self.frame.indices.len() - first_index) as u32;
        if continued.is_some() {
            if let Some(Operation::Draw(draw)) = self.frame.operations.last_mut()
                && let VertexSource::Arena { vertices, .. } = &mut draw.source
            {
                *vertices += count as u32;
                draw.index_count += added;
            }
        } else if added > 0 {
            let first_word = (self.frame.words.len() - count * layout.stride()) as u32;
            let source =
                VertexSource::Arena { first_word, vertices: count as u32, first_index: first_index as u32 };
            self.push_draw(source, layout, kind, added);
        } else {
            return;
        }
        self.emitter.open = OpenDraw {
            layout,
            topology: kind.topology(),
            operations: self.frame.operations.len(),
            words: self.frame.words.len(),
            indices: self.frame.indices.len(),
        };
    }

    fn push_draw(&mut self, source: VertexSource, layout: VertexLayout, kind: Kind, index_count: u32) {
        let ids = self.emitter.ids;
        self.frame.operations.push(Operation::Draw(Draw {
            source,
            layout,
            topology: kind.topology(),
            index_count,
            fixed: ids.fixed,
            viewport: ids.viewport,
            bindings: ids.bindings,
            transform: ids.transform,
            lights: ids.lights,
            material: ids.material,
            environment: ids.environment,
            texgen: ids.texgen,
            texture_matrices: ids.texture_matrices,
            clip_planes: ids.clip_planes,
            current: ids.current,
        }));
    }

    /// Writes what has changed, and what this draw needs, to the frame's tables.
    fn validate(&mut self, layout: VertexLayout, kind: Kind) {
        if kind != self.emitter.kind {
            self.emitter.kind = kind;
            self.emitter.dirty |= Dirty::WORDS | Dirty::RASTER;
        }
        if !self.emitter.dirty.is_empty() {
            self.write_tables(kind);
        }
        let absent = |slot: usize| layout.format(slot) == Format::Absent;
        let has_changed = |slot: usize| self.emitter.changed[slot] && absent(slot);
        if self.emitter.changed != [false; SLOTS]
            && ((0..SLOTS).any(has_changed) || self.frame.current.is_empty())
        {
            let block = self.current_attributes();
            self.emitter.open = OpenDraw::NONE;
            self.emitter.ids.current = push(&mut self.frame.current, block);
            self.emitter.changed = [false; SLOTS];
        }
    }

    fn write_tables(&mut self, kind: Kind) {
        if self.emitter.dirty.contains(Dirty::BINDINGS) {
            self.write_bindings();
        }
        let dirty = self.emitter.dirty;
        if dirty.intersects(Dirty::WORDS | Dirty::RASTER) {
            if dirty.contains(Dirty::WORDS) {
                self.emitter.fixed.words = self.state_words(kind);
            }
            if dirty.contains(Dirty::RASTER) {
                self.emitter.fixed.raster = self.raster_state(kind);
            }
            self.find_fixed();
        }
        // Blocks that no enabled function reads stay dirty, but every table has at least one entry.
        let written = dirty & (self.read_groups() | self.emitter.empty);
        let blocks = written & !(Dirty::BINDINGS | Dirty::WORDS | Dirty::RASTER);
        if !blocks.is_empty() {
            self.emitter.open = OpenDraw::NONE;
            self.write_blocks(blocks);
        }
        self.emitter.dirty = dirty & !written;
        self.emitter.empty = Dirty::empty();
    }

    /// Names the fixed state. Programs often switch something on and off again: then it is the one before last.
    fn find_fixed(&mut self) {
        let (emitter, table) = (&mut self.emitter, &mut self.frame.fixed);
        let is_at = |id: u32| table.get(id as usize) == Some(&emitter.fixed);
        if is_at(emitter.ids.fixed) {
            return;
        }
        let id = if is_at(emitter.fixed_before) {
            emitter.fixed_before
        } else {
            *emitter.fixed_ids.entry(emitter.fixed).or_insert_with(|| push(table, emitter.fixed))
        };
        emitter.open = OpenDraw::NONE;
        emitter.fixed_before = std::mem::replace(&mut emitter.ids.fixed, id);
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
            self.emitter.ids.viewport = push(&mut self.frame.viewports, block);
        }
        if groups.contains(Dirty::TRANSFORM) {
            let block = self.transform_block();
            self.emitter.ids.transform = push(&mut self.frame.transforms, block);
        }
        if groups.contains(Dirty::ENVIRONMENT) {
            let block = self.environment_block();
            self.emitter.ids.environment = push(&mut self.frame.environments, block);
        }
        if groups.contains(Dirty::LIGHTS) {
            let block = self.lights_block();
            self.emitter.ids.lights = push(&mut self.frame.lights, block);
        }
        if groups.contains(Dirty::MATERIAL) {
            self.emitter.ids.material = push(&mut self.frame.materials, self.state.lighting.material);
        }
        if groups.contains(Dirty::TEXGEN) {
            let units = std::array::from_fn(|i| self.state.texture.units[i].gen_planes);
            self.emitter.ids.texgen = push(&mut self.frame.texgens, TexGen { units });
        }
        if groups.contains(Dirty::TEXTURE_MATRICES) {
            let units = std::array::from_fn(|i| Matrix {
                columns: self.matrices.texture[i].top().to_cols_array_2d(),
            });
            self.emitter.ids.texture_matrices =
                push(&mut self.frame.texture_matrices, TextureMatrices { units });
        }
        if groups.contains(Dirty::CLIP_PLANES) {
            let plane =
                |i: usize| Plane { coefficients: self.state.transform.clip_planes[i].map(|v| v as f32) };
            let planes = std::array::from_fn(plane);
            self.emitter.ids.clip_planes = push(&mut self.frame.clip_planes, ClipPlanes { planes });
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
        if sampled != self.emitter.sampled {
            self.emitter.sampled = sampled;
            self.emitter.dirty |= Dirty::WORDS | Dirty::ENVIRONMENT;
        }
        if self.frame.bindings.last() != Some(&bindings) {
            self.emitter.open = OpenDraw::NONE;
            push(&mut self.frame.bindings, bindings);
        }
        self.emitter.ids.bindings = self.frame.bindings.len() as u32 - 1;
    }

    /// State of a rectangle of pixels: as for points, without lighting.
    pub(crate) fn validate_pixels(&mut self) -> (u32, u32, u32, u32, u32) {
        self.validate(VertexLayout::default(), Kind::Polygons(PolygonMode::Fill));
        let ids = self.emitter.ids;
        (ids.fixed, ids.viewport, ids.bindings, ids.environment, ids.current)
    }

    /// What a unit samples, if anything.
    pub(crate) fn sampled(&self, unit: usize) -> Option<Sampled> {
        self.emitter.sampled[unit]
    }
}
