//! Vertices become [`Draw`]s. A primitive that meets the same state as the one before extends its draw.

use std::sync::Arc;

use afterglow_api::constants::*;

use crate::assemble::{self, PolygonMode};
use crate::context::Context;
use crate::frame::*;
use crate::limits;
use crate::pixels::RenderMode;
use crate::state::Cap;

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

/// What draws of a frame share.
#[derive(Debug, Default)]
pub struct Emitter {
    /// The draw that primitives of the same state continue.
    open: Option<OpenDraw>,
    /// By the mode of glBegin: where in the frame's indices those of vertices in a row are, and how many.
    patterns: [(u32, u32); MODES],
}

/// A draw that was pushed last, if nothing came in between: all that a primitive must meet to continue it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct OpenDraw {
    layout: VertexLayout,
    topology: Topology,
    /// The state that it met, by [`Tables::revision`](crate::tables::Tables::revision).
    revision: u64,
    /// Lengths of the frame's lists behind it.
    operations: usize,
    words: usize,
    indices: usize,
}

impl Emitter {
    /// There are no draws yet.
    pub fn start_frame(&mut self) {
        *self = Emitter::default();
    }
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
        let count = layout.vertices_in(words.len());
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
        let count = layout.vertices_in(words.len());
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
    pub(crate) fn emit_retained(&mut self, range: Arc<RetainedRange>, kind: Kind) {
        if range.indices.is_empty() || !self.prepare(range.layout, kind, range.vertex_count()) {
            return;
        }
        let (layout, index_count) = (range.layout, range.indices.len() as u32);
        if self.frame.retained.last().is_none_or(|last| last.id() != range.id()) {
            self.frame.retained.push(range);
        }
        let index = self.frame.retained.len() as u32 - 1;
        self.push_draw(VertexSource::Retained { range: index, first_index: 0 }, layout, kind, index_count);
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

    /// What must be the same for a primitive to continue a draw that ends here.
    fn meets(&self, layout: VertexLayout, kind: Kind) -> OpenDraw {
        OpenDraw {
            layout,
            topology: kind.topology(),
            revision: self.tables.revision,
            operations: self.frame.operations.len(),
            words: self.frame.words.len(),
            indices: self.frame.indices.len(),
        }
    }

    /// Appends vertices; the number of those that the open draw has, if they continue it.
    fn extend_vertices(&mut self, layout: VertexLayout, kind: Kind, words: &[u32]) -> Option<u32> {
        let is_continued = self.emitter.open == Some(self.meets(layout, kind));
        self.frame.words.extend_from_slice(words);
        match self.frame.operations.last() {
            Some(Operation::Draw(Draw { source: VertexSource::Arena { vertices, .. }, .. }))
                if is_continued =>
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
                self.frame.seams.push(first_index as u32);
            }
        } else if added > 0 {
            let first_word = (self.frame.words.len() - count * layout.stride()) as u32;
            let source =
                VertexSource::Arena { first_word, vertices: count as u32, first_index: first_index as u32 };
            self.push_draw(source, layout, kind, added);
        } else {
            return;
        }
        self.emitter.open = Some(self.meets(layout, kind));
    }

    fn push_draw(&mut self, source: VertexSource, layout: VertexLayout, kind: Kind, index_count: u32) {
        let ids = self.tables.ids;
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
}
