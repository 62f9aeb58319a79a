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
use crate::state::Cap;

bitflags! {
    /// Groups of state that have changed since they were last written to the frame.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub struct Dirty: u16 {
        const FIXED = 1;
        const VIEWPORT = 2;
        const BINDINGS = 4;
        const TRANSFORM = 8;
        const LIGHTS = 16;
        const MATERIAL = 32;
        const ENVIRONMENT = 64;
        const TEXGEN = 128;
        const TEXTURE_MATRICES = 256;
        const CLIP_PLANES = 512;
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
    pub changed: u16,
    kind: Kind,
    fixed_ids: HashMap<FixedState, u32>,
    ids: Ids,
    /// By the mode of glBegin: where in the frame's indices those of vertices in a row are, and how many.
    patterns: [(u32, u32); MODES],
    /// Dimension and base format of what each unit samples.
    realized: [Option<(Dimension, BaseFormat)>; TEXTURE_UNITS],
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
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
            changed: u16::MAX,
            kind: Kind::Points,
            fixed_ids: HashMap::new(),
            ids: Ids::default(),
            patterns: [(0, 0); MODES],
            realized: [None; TEXTURE_UNITS],
        }
    }
}

impl Emitter {
    /// All tables are empty again.
    pub fn start_frame(&mut self) {
        self.dirty = Dirty::all();
        self.changed = u16::MAX;
        self.fixed_ids.clear();
        self.patterns = [(0, 0); MODES];
    }
}

fn push<T>(table: &mut Vec<T>, value: T) -> u32 {
    table.push(value);
    (table.len() - 1) as u32
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
        let count = words.len().checked_div(layout.stride()).unwrap_or(0);
        let kind = Kind::of(mode, self.effective_polygon_mode());
        if !self.prepare(layout, kind, count) {
            return;
        }
        let base = self.extend_vertices(layout, kind, words);
        let first_index = self.frame.indices.len();
        match kind {
            Kind::Polygons(polygon_mode @ (PolygonMode::Line | PolygonMode::Point)) => {
                let flag = |i: usize| edges.is_none_or(|e| e.get(i).copied().unwrap_or(true));
                let out = &mut self.frame.indices;
                assemble::assemble_unfilled(mode, count, polygon_mode, |i| base + i as u32, flag, out);
            }
            _ => assemble::assemble(mode, count, |i| base + i as u32, &mut self.frame.indices),
        }
        self.finish_draw(first_index, layout, kind, count);
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
        let count = words.len().checked_div(layout.stride()).unwrap_or(0);
        if !self.prepare(layout, kind, count) {
            return;
        }
        let base = self.extend_vertices(layout, kind, words);
        let first_index = self.frame.indices.len();
        self.frame.indices.extend(indices.iter().map(|i| i + base));
        self.finish_draw(first_index, layout, kind, count);
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

    /// Appends vertices, to the last draw's if they continue it; the index of the first.
    fn extend_vertices(&mut self, layout: VertexLayout, kind: Kind, words: &[u32]) -> u32 {
        let end = self.frame.words.len() as u32;
        self.frame.words.extend_from_slice(words);
        match self.continued_draw(layout, kind, end, self.frame.indices.len()) {
            Some(VertexSource::Arena { vertices, .. }) => *vertices,
            _ => 0,
        }
    }

    /// The vertices of the last draw, if it meets the same state and ends where the frame's words and indices did.
    fn continued_draw(
        &mut self,
        layout: VertexLayout,
        kind: Kind,
        end: u32,
        indices_end: usize,
    ) -> Option<&mut VertexSource> {
        let ids = self.emitter.ids;
        let Some(Operation::Draw(draw)) = self.frame.operations.last_mut() else { return None };
        let same = draw.layout == layout && draw.topology == kind.topology() && Ids::of(draw) == ids;
        match draw.source {
            VertexSource::Arena { first_word, vertices, first_index }
                if same
                    && first_word + vertices * layout.stride() as u32 == end
                    && (first_index + draw.index_count) as usize == indices_end =>
            {
                Some(&mut draw.source)
            }
            _ => None,
        }
    }

    fn finish_draw(&mut self, first_index: usize, layout: VertexLayout, kind: Kind, count: usize) {
        let added = (self.frame.indices.len() - first_index) as u32;
        let first_word = (self.frame.words.len() - count * layout.stride()) as u32;
        if let Some(VertexSource::Arena { vertices, .. }) =
            self.continued_draw(layout, kind, first_word, first_index)
        {
            *vertices += count as u32;
            if let Some(Operation::Draw(draw)) = self.frame.operations.last_mut() {
                draw.index_count += added;
            }
            return;
        }
        if added > 0 {
            let source =
                VertexSource::Arena { first_word, vertices: count as u32, first_index: first_index as u32 };
            self.push_draw(source, layout, kind, added);
        }
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
        let mut dirty = self.emitter.dirty;
        if dirty.contains(Dirty::BINDINGS) {
            self.write_bindings();
            dirty |= self.emitter.dirty & Dirty::FIXED;
        }
        if dirty.contains(Dirty::FIXED) || kind != self.emitter.kind {
            self.emitter.kind = kind;
            let fixed = self.fixed_state(kind);
            let table = &mut self.frame.fixed;
            self.emitter.ids.fixed =
                *self.emitter.fixed_ids.entry(fixed).or_insert_with(|| push(table, fixed));
        }
        let absent = (0..SLOTS).filter(|&s| layout.format(s) == Format::Absent).fold(0, |m, s| m | 1 << s);
        if self.emitter.changed & absent != 0 || self.frame.current.is_empty() {
            let block = self.current_attributes();
            self.emitter.ids.current = push(&mut self.frame.current, block);
            self.emitter.changed = 0;
        }
        self.emitter.dirty = Dirty::empty();
        if !dirty.is_empty() {
            self.write_blocks(dirty);
        }
    }

    /// Writes the blocks of `dirty`. Blocks that no enabled function reads stay dirty, but every table
    /// has at least one entry.
    fn write_blocks(&mut self, dirty: Dirty) {
        let lighting = self.state.caps.has(Cap::Lighting);
        let frame = &mut self.frame;
        let mut needs = |group: Dirty, used: bool, empty: bool| {
            let write = dirty.contains(group) && (used || empty);
            if dirty.contains(group) && !write {
                self.emitter.dirty |= group;
            }
            write
        };
        let viewport = needs(Dirty::VIEWPORT, true, false);
        let transform = needs(Dirty::TRANSFORM, true, false);
        let environment = needs(Dirty::ENVIRONMENT, true, false);
        let lights = needs(Dirty::LIGHTS, lighting, frame.lights.is_empty());
        let material = needs(Dirty::MATERIAL, lighting, frame.materials.is_empty());
        let units = &self.state.texture.units;
        let texgen = needs(Dirty::TEXGEN, units.iter().any(|u| u.gen_enabled != 0), frame.texgens.is_empty());
        let matrices = needs(Dirty::TEXTURE_MATRICES, true, false);
        let clip = self.state.transform.clip_enabled != 0;
        let clip = needs(Dirty::CLIP_PLANES, clip, frame.clip_planes.is_empty());
        if viewport {
            let block = self.viewport_block();
            self.emitter.ids.viewport = push(&mut self.frame.viewports, block);
        }
        if transform {
            let block = self.transform_block();
            self.emitter.ids.transform = push(&mut self.frame.transforms, block);
        }
        if environment {
            let block = self.environment_block();
            self.emitter.ids.environment = push(&mut self.frame.environments, block);
        }
        if lights {
            let block = self.lights_block();
            self.emitter.ids.lights = push(&mut self.frame.lights, block);
        }
        if material {
            self.emitter.ids.material = push(&mut self.frame.materials, self.state.lighting.material);
        }
        if texgen {
            let units = std::array::from_fn(|i| self.state.texture.units[i].gen_planes);
            self.emitter.ids.texgen = push(&mut self.frame.texgens, TexGen { units });
        }
        if matrices {
            let units = std::array::from_fn(|i| Matrix {
                columns: self.matrices.texture[i].top().to_cols_array_2d(),
            });
            self.emitter.ids.texture_matrices =
                push(&mut self.frame.texture_matrices, TextureMatrices { units });
        }
        if clip {
            let plane =
                |i: usize| Plane { coefficients: self.state.transform.clip_planes[i].map(|v| v as f32) };
            let planes = std::array::from_fn(plane);
            self.emitter.ids.clip_planes = push(&mut self.frame.clip_planes, ClipPlanes { planes });
        }
    }

    /// Makes sure that the enabled textures have images, and writes what the units sample.
    fn write_bindings(&mut self) {
        let mut bindings: Bindings = [None; TEXTURE_UNITS];
        let mut realized = [None; TEXTURE_UNITS];
        for unit in 0..TEXTURE_UNITS {
            if let Some(texture) = self.textures.enabled(&self.state.texture.units[unit], unit) {
                let mut texture = texture.lock();
                if let Some(image) = texture.realize(&mut self.frame.operations) {
                    realized[unit] = Some((image.shape.dimension, image.base_format));
                    bindings[unit] = Some(TextureBinding { image: image.image, sampler: texture.sampler() });
                }
            }
        }
        if realized != self.emitter.realized {
            self.emitter.realized = realized;
            self.emitter.dirty |= Dirty::FIXED;
        }
        // Compare modes live in the texture and are part of what is computed.
        self.emitter.dirty |= Dirty::FIXED;
        if self.frame.bindings.last() != Some(&bindings) {
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

    /// What each unit samples, if anything.
    pub(crate) fn realized(&self, unit: usize) -> Option<(Dimension, BaseFormat)> {
        self.emitter.realized[unit]
    }
}

impl Ids {
    fn of(draw: &Draw) -> Ids {
        Ids {
            fixed: draw.fixed,
            viewport: draw.viewport,
            bindings: draw.bindings,
            transform: draw.transform,
            lights: draw.lights,
            material: draw.material,
            environment: draw.environment,
            texgen: draw.texgen,
            texture_matrices: draw.texture_matrices,
            clip_planes: draw.clip_planes,
            current: draw.current,
        }
    }
}
