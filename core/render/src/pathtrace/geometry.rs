//! Triangles of draws as a builder takes them: three corners each, and a hash of them all.

use std::ops::Range;

use afterglow_gl::frame::{Draw, Format, Frame, Slot, VertexSource};
use hashbrown::HashMap;
use xxhash_rust::xxh3::xxh3_64;

use super::anchors::Reach;

/// Frames after which what was learned of a retained range is forgotten, unless it was drawn.
const IDLE_FRAMES: u64 = 120;

/// A draw's triangles.
#[derive(Debug, Clone)]
pub(crate) struct Triangles {
    /// Of the corners' positions, in order.
    pub(crate) hash: u64,
    pub(crate) count: u32,
    /// Corners in [`GeometryReader::corners`]; empty if the triangles are known from an earlier frame.
    pub(crate) corners: Range<usize>,
    pub(crate) reach: Reach,
}

/// What was learned of a retained range.
struct Known {
    hash: u64,
    reach: Reach,
    /// The frame in which it was last drawn.
    drawn: u64,
}

/// A part of a retained range: its id, first index, number of indices.
type RetainedPart = (u64, u32, u32);

/// Reads positions out of vertices.
#[derive(Default)]
pub(crate) struct GeometryReader {
    /// Corners of this frame's triangles.
    pub(crate) corners: Vec<[f32; 3]>,
    /// What never changes.
    known: HashMap<RetainedPart, Known>,
    frame: u64,
}

impl GeometryReader {
    pub(crate) fn begin_frame(&mut self) {
        self.frame += 1;
        self.corners.clear();
        let frame = self.frame;
        self.known.retain(|_, known| known.drawn + IDLE_FRAMES > frame);
    }

    /// The triangles of a draw, whose vertices and indices lie within the frame's.
    pub(crate) fn read(&mut self, frame: &Frame, draw: &Draw) -> Triangles {
        let count = draw.index_count / 3;
        let part = retained_part(frame, draw);
        if let Some(known) = part.and_then(|part| self.known.get_mut(&part)) {
            known.drawn = self.frame;
            return Triangles { hash: known.hash, count, corners: 0..0, reach: known.reach };
        }
        let corners = self.corners(frame, draw);
        let hash = xxh3_64(bytemuck::cast_slice(&self.corners[corners.clone()]));
        let reach = Reach::of(&self.corners[corners.clone()]);
        if let Some(part) = part {
            self.known.insert(part, Known { hash, reach, drawn: self.frame });
        }
        Triangles { hash, count, corners, reach }
    }

    /// Reads the corners of triangles that were not needed before.
    pub(crate) fn corners(&mut self, frame: &Frame, draw: &Draw) -> Range<usize> {
        let start = self.corners.len();
        let (words, indices) = frame.geometry(draw);
        let reader = PositionReader::new(words, draw);
        let whole = indices.len() / 3 * 3;
        self.corners.extend(indices[..whole].iter().map(|&index| reader.position(index)));
        start..self.corners.len()
    }
}

fn retained_part(frame: &Frame, draw: &Draw) -> Option<RetainedPart> {
    match draw.source {
        VertexSource::Arena { .. } => None,
        VertexSource::Retained { range, first_index } => {
            let range = frame.retained.get(range as usize)?;
            Some((range.id(), first_index, draw.index_count))
        }
    }
}

/// Positions of a draw's vertices.
pub(super) struct PositionReader<'a> {
    words: &'a [u32],
    stride: usize,
    components: usize,
}

impl<'a> PositionReader<'a> {
    pub(super) fn new(words: &'a [u32], draw: &Draw) -> Self {
        let components = match draw.layout.format(Slot::Position as usize) {
            Format::F1 => 1,
            Format::F2 => 2,
            Format::F3 => 3,
            Format::F4 => 4,
            Format::Absent | Format::Unorm8x4 => 0,
        };
        Self { words, stride: draw.layout.stride(), components }
    }

    /// A point at infinity, or one that is not there, is not a number: it makes no triangle.
    pub(super) fn position(&self, index: u32) -> [f32; 3] {
        let start = (index as usize).saturating_mul(self.stride);
        let end = start.saturating_add(self.components);
        let Some(words) = self.words.get(start..end) else {
            return [f32::NAN; 3];
        };
        let mut position = [0.0, 0.0, 0.0, 1.0];
        for (component, word) in position.iter_mut().zip(words) {
            *component = f32::from_bits(*word);
        }
        let [x, y, z, w] = position;
        match w {
            1.0 => [x, y, z],
            0.0 => [f32::NAN; 3],
            w => [x / w, y / w, z / w],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{FrameBuilder, RED};
    use afterglow_gl::frame::{Topology, VertexLayout};

    fn first_draw(frame: &Frame) -> Draw {
        *frame.draws().next().unwrap().1
    }

    #[test]
    fn colours_do_not_change_what_a_triangle_is() {
        let mut reader = GeometryReader::default();
        let mut hash = |z: f32, color| {
            let mut builder = FrameBuilder::new(8, 8);
            builder.fill(z, color);
            let triangles = reader.read(&builder.frame, &first_draw(&builder.frame));
            assert_eq!((triangles.count, triangles.corners.len()), (2, 6));
            triangles.hash
        };
        let first = hash(0.5, RED);
        assert_eq!(hash(0.5, [7; 4]), first);
        assert_ne!(hash(0.25, RED), first);
    }

    #[test]
    fn positions_are_divided_and_lost_ones_are_no_numbers() {
        let layout = VertexLayout::default().with(Slot::Position as usize, Format::F4);
        let vertices = [[2.0, 4.0, 6.0, 2.0], [1.0, 0.0, 0.0, 0.0], [1.0, 2.0, 3.0, 1.0_f32]];
        let words = vertices.concat().into_iter().map(f32::to_bits).collect::<Vec<_>>();
        let mut builder = FrameBuilder::new(8, 8);
        builder.draw(layout, Topology::Triangles, &words, &[0, 1, 99]);
        let mut reader = GeometryReader::default();
        reader.read(&builder.frame, &first_draw(&builder.frame));
        assert_eq!(reader.corners[0], [1.0, 2.0, 3.0]);
        assert!(reader.corners[1][0].is_nan() && reader.corners[2][0].is_nan());
    }
}
