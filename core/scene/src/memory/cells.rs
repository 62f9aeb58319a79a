//! Cells: remembered triangles of one kind that lie together, in ranges that never change.

use std::sync::Arc;

use afterglow_gl::frame::{RetainedRange, VertexLayout};
use glam::{Mat4, Vec3};
use hashbrown::HashMap;

use super::keys::{Positions, position};
use super::look::{Kind, Look};

/// Triangles of a range and the state that they were drawn with.
#[derive(Debug, Clone)]
pub struct Pass {
    /// Vertices and indices.
    pub range: Arc<RetainedRange>,
    /// First index in the range's own.
    pub first_index: u32,
    /// Number of indices.
    pub index_count: u32,
    /// The state.
    pub look: Arc<Look>,
}

impl Pass {
    /// Its indices.
    pub fn indices(&self) -> &[u32] {
        let first = self.first_index as usize;
        self.range.indices.get(first..first + self.index_count as usize).unwrap_or_default()
    }

    /// Its triangles in world space; none where one is degenerate.
    pub fn triangles(&self, model: Mat4) -> impl Iterator<Item = Option<[Vec3; 3]>> {
        let positions = Positions::new(&self.range.words, self.range.layout);
        self.indices().chunks_exact(3).map(move |indices| {
            let corners = positions.corners(indices)?;
            Some(corners.map(|corner| model.transform_point3(position(corner))))
        })
    }

    /// Bytes of its vertices and indices.
    pub fn bytes(&self) -> u64 {
        4 * (self.range.words.len() + self.range.indices.len()) as u64
    }
}

/// Remembered triangles that lie together.
#[derive(Debug, Clone)]
pub struct Cell {
    /// Number of their kind.
    pub kind: u32,
    /// Number of the block that they are in.
    pub block: u32,
    /// The surface and the layers over it, the same triangles in the same order.
    pub passes: Arc<[Pass]>,
    /// Entries of its triangles, in order; one alone if they are only known together.
    pub entries: Vec<u32>,
    /// Least and greatest corner of its box, world space.
    pub bounds: [Vec3; 2],
    /// The frame in which it was last drawn, and how many of its entries were in that frame.
    pub drawn: (u32, u32),
    /// Bytes of what it keeps.
    pub bytes: u64,
    /// Its triangles are not known one by one, only together: it has one entry.
    pub is_whole: bool,
}

impl Cell {
    /// A cell of these passes.
    pub fn new(kind: u32, model: Mat4, passes: Vec<Pass>, entries: Vec<u32>, drawn: u32) -> Cell {
        let bounds = bounds(&passes, model);
        let bytes = passes.iter().map(Pass::bytes).sum::<u64>() + 64 * entries.len() as u64;
        Cell {
            kind,
            block: 0,
            passes: passes.into(),
            entries,
            bounds,
            drawn: (drawn, 0),
            bytes,
            is_whole: false,
        }
    }

    /// Takes note that one of its entries is drawn.
    #[inline]
    pub fn note(&mut self, frame: u32) {
        if self.drawn.0 != frame {
            self.drawn = (frame, 0);
        }
        self.drawn.1 += 1;
    }

    /// Whether all of it was drawn in a frame.
    pub fn is_drawn(&self, frame: u32) -> bool {
        self.drawn == (frame, self.entries.len() as u32)
    }
}

/// Least and greatest corner of the box of a cell's surface, world space.
pub fn bounds(passes: &[Pass], model: Mat4) -> [Vec3; 2] {
    let mut bounds = [Vec3::INFINITY, Vec3::NEG_INFINITY];
    for corner in passes.iter().take(1).flat_map(|pass| pass.triangles(model)).flatten().flatten() {
        bounds = [bounds[0].min(corner), bounds[1].max(corner)];
    }
    bounds
}

/// Triangles on their way into cells: their vertices, three a triangle.
#[derive(Debug, Default)]
pub struct Pile {
    /// Of each triangle.
    pub entries: Vec<u32>,
    /// Of each pass.
    words: Vec<Vec<u32>>,
}

impl Pile {
    /// Adds a triangle: of each pass, the vertices that its corners are among.
    pub fn add<'a>(&mut self, entry: u32, passes: impl Iterator<Item = (&'a [u32], usize, &'a [u32])>) {
        self.entries.push(entry);
        for (number, (words, stride, indices)) in passes.enumerate() {
            if self.words.len() == number {
                self.words.push(Vec::new());
            }
            for index in indices {
                let start = *index as usize * stride;
                let vertex = words.get(start..start + stride);
                let to = &mut self.words[number];
                match vertex {
                    Some(vertex) => to.extend_from_slice(vertex),
                    // A corner that is not there: a layer's; the surface's were read before.
                    None => to.resize(to.len() + stride, 0),
                }
            }
        }
    }

    /// Adds those triangles of a cell for which `keep` says so.
    pub fn add_cell(&mut self, cell: &Cell, keep: impl Fn(u32) -> bool) {
        for (triangle, &entry) in cell.entries.iter().enumerate().filter(|(_, entry)| keep(**entry)) {
            let parts = cell.passes.iter().map(|pass| {
                let indices = pass.indices().get(3 * triangle..3 * triangle + 3).unwrap_or_default();
                (&*pass.range.words, pass.range.layout.stride(), indices)
            });
            self.add(entry, parts);
        }
    }

    /// The cell of some of its triangles.
    pub fn cell(&self, number: u32, kind: &Kind, triangles: &[u32], drawn: u32) -> Cell {
        let passes = kind.passes.iter().zip(&self.words).map(|((look, layout), words)| Pass {
            range: Arc::new(weld(words, *layout, triangles)),
            first_index: 0,
            index_count: 3 * triangles.len() as u32,
            look: look.clone(),
        });
        let entries = triangles.iter().map(|&triangle| self.entries[triangle as usize]).collect();
        Cell::new(number, kind.model, passes.collect(), entries, drawn)
    }

    /// Centres of its triangles, object space.
    pub fn centres(&self, kind: &Kind) -> impl Iterator<Item = Vec3> {
        let surface = kind.passes.first().zip(self.words.first());
        surface.into_iter().flat_map(|((_, layout), words)| {
            let positions = Positions::new(words, *layout);
            (0..layout.vertices_in(words.len()) as u32 / 3).map(move |triangle| {
                let corners = (0..3).filter_map(|corner| positions.bits(3 * triangle + corner));
                corners.map(position).sum::<Vec3>() / 3.0
            })
        })
    }
}

/// A range of some of the triangles, each vertex stored once.
fn weld(words: &[u32], layout: VertexLayout, triangles: &[u32]) -> RetainedRange {
    let stride = layout.stride();
    let mut known: HashMap<&[u32], u32> = HashMap::new();
    let (mut vertices, mut indices) = (Vec::new(), Vec::with_capacity(3 * triangles.len()));
    for &triangle in triangles {
        for corner in 0..3 {
            let start = (3 * triangle as usize + corner) * stride;
            let Some(vertex) = words.get(start..start + stride) else { continue };
            let next = known.len() as u32;
            indices.push(*known.entry(vertex).or_insert_with(|| {
                vertices.extend_from_slice(vertex);
                next
            }));
        }
    }
    RetainedRange::new(layout, vertices, indices)
}
