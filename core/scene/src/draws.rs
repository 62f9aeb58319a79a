//! Facts on each draw, from its state alone: what it can be part of before anything is known of the scene.

use afterglow_gl::frame::{Compare, Draw, FixedState, Frame, Topology, Transform};
use glam::{DMat4, DVec3};
use hashbrown::HashMap;

use crate::content::retained_hash;
use crate::geometry::{ContentCache, sample_positions};
use crate::images::Images;
use crate::matrix::{self, Perspective};
use crate::opacity::{Mixing, mixing};
use crate::shapes::Piece;
use crate::views::{Place, Views};

/// How a draw meets the depth buffer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DepthUse {
    /// Neither tests nor writes.
    Off,
    /// Writes whatever is there.
    Fill,
    /// Tests, does not write.
    Test,
    /// Tests for equality.
    Equal,
    /// Tests and writes.
    TestWrite,
}

/// A distinct pair of matrices of the frame.
#[derive(Debug, Clone)]
pub struct TransformFacts {
    /// MODELVIEW in f64.
    pub modelview: DMat4,
    /// Hash of MODELVIEW's bits.
    pub modelview_hash: u64,
    /// Hash of PROJECTION's bits.
    pub projection_hash: u64,
    /// The projection, unless orthographic.
    pub perspective: Option<Perspective>,
    /// Object to eye space: MODELVIEW, and what of the view is in PROJECTION.
    pub eye: DMat4,
    /// MODELVIEW makes things flat.
    pub flattening: bool,
    /// MODELVIEW holds sound numbers.
    pub sound: bool,
}

/// What a draw's state says of it.
#[derive(Debug, Clone)]
pub struct DrawFacts<'a> {
    /// Index of the operation.
    pub operation: u32,
    /// The draw.
    pub draw: &'a Draw,
    /// What it was cut into, if it may be solid.
    pub piece: Option<&'a Piece>,
    /// Hash of all that its vertices and indices hold, where that is known.
    pub content: Option<u64>,
    /// View and depth layer.
    pub place: Place,
    /// Triangles; 0 for points and lines.
    pub triangles: u32,
    /// Use of the depth buffer.
    pub depth: DepthUse,
    /// What blending amounts to.
    pub mixing: Mixing,
    /// Writes any of red, green, blue.
    pub writes_color: bool,
    /// A clip plane or the stencil lets only part of it be seen.
    pub masked: bool,
    /// Near and far of glDepthRange.
    pub depth_range: [f32; 2],
    /// Index into the table of [`TransformFacts`].
    pub transform: usize,
}

impl DrawFacts<'_> {
    /// Whether the draw could be a surface of a world: opaque triangles in perspective that test and
    /// write depth.
    pub fn is_solid(&self, transforms: &[TransformFacts]) -> bool {
        self.triangles > 0
            && self.writes_color
            && self.depth == DepthUse::TestWrite
            && matches!(self.mixing, Mixing::Opaque | Mixing::CutOut)
            && transforms[self.transform].perspective.is_some()
            && !transforms[self.transform].flattening
            && transforms[self.transform].sound
    }

    /// Positions spread over the draw, in eye space.
    pub fn eye_samples(
        &self,
        frame: &Frame,
        transforms: &[TransformFacts],
        count: usize,
    ) -> impl Iterator<Item = DVec3> {
        let eye = transforms[self.transform].eye;
        sample_positions(frame, self.draw, count)
            .map(move |p| eye.project_point3(p.as_dvec3()))
            .filter(|p| p.is_finite())
    }
}

/// Whether a draw's state lets it be a surface of a world, as far as that is known before anything else.
pub fn may_be_solid(frame: &Frame, draw: &Draw) -> bool {
    let raster = &frame.fixed[draw.fixed as usize].raster;
    let projection = &frame.transforms[draw.transform as usize].projection;
    let is_perspective = projection.iter().take(3).any(|column| column[3] != 0.0);
    depth_use(raster.depth) == DepthUse::TestWrite && raster.color_mask & 7 != 0 && is_perspective
}

/// Facts on all distinct transforms of a frame, in the order of its table.
pub fn transforms(frame: &Frame) -> Vec<TransformFacts> {
    let mut perspectives: HashMap<u64, Option<Perspective>> = HashMap::new();
    let mut facts: Vec<TransformFacts> = Vec::with_capacity(frame.transforms.len());
    for (i, transform) in frame.transforms.iter().enumerate() {
        // Programs set the same matrix again and again.
        let again = i > 0 && bytemuck::bytes_of(&frame.transforms[i - 1]) == bytemuck::bytes_of(transform);
        let new = match facts.last() {
            Some(last) if again => last.clone(),
            _ => transform_facts(transform, &mut perspectives),
        };
        facts.push(new);
    }
    facts
}

fn transform_facts(
    transform: &Transform,
    perspectives: &mut HashMap<u64, Option<Perspective>>,
) -> TransformFacts {
    let hash = |columns| xxhash_rust::xxh3::xxh3_64(bytemuck::bytes_of(&matrix::bits(columns)));
    let modelview = matrix::from_columns(&transform.modelview);
    let projection_hash = hash(&transform.projection);
    let perspective = *perspectives
        .entry(projection_hash)
        .or_insert_with(|| matrix::factor_perspective(matrix::from_columns(&transform.projection)));
    TransformFacts {
        modelview,
        modelview_hash: hash(&transform.modelview),
        projection_hash,
        perspective,
        eye: perspective.map_or(modelview, |p| p.view * modelview),
        flattening: matrix::is_flattening(modelview),
        sound: matrix::is_sound(modelview),
    }
}

/// Facts on all draws of a frame.
pub fn draws<'a>(
    frame: &'a Frame,
    views: &Views,
    pieces: &'a [Option<Piece>],
    images: &Images,
    cache: &mut ContentCache,
) -> Vec<DrawFacts<'a>> {
    cache.next_frame();
    let placed = frame.draws().zip(&views.places).zip(pieces);
    let facts = placed.map(|(((operation, draw), &place), piece)| {
        let piece = piece.as_ref();
        let content = piece.map(|piece| piece.bytes).or_else(|| retained_hash(frame, draw));
        let FixedState { words, raster } = &frame.fixed[draw.fixed as usize];
        let is_triangles = draw.topology == Topology::Triangles;
        DrawFacts {
            operation: operation as u32,
            draw,
            piece,
            content,
            place,
            triangles: if is_triangles { draw.index_count / 3 } else { 0 },
            depth: depth_use(raster.depth),
            mixing: mixing(frame, draw, content, images, cache),
            writes_color: raster.color_mask & 7 != 0,
            masked: words.global.clip_planes() != 0 || raster.stencil.is_some(),
            depth_range: frame.viewports[draw.viewport as usize].depth_range,
            transform: draw.transform as usize,
        }
    });
    facts.collect()
}

fn depth_use(depth: Option<afterglow_gl::frame::Depth>) -> DepthUse {
    match depth {
        None => DepthUse::Off,
        Some(d) => match (d.compare, d.write) {
            (Compare::Always, false) => DepthUse::Off,
            (Compare::Always, true) => DepthUse::Fill,
            (Compare::Equal, _) => DepthUse::Equal,
            (_, false) => DepthUse::Test,
            (_, true) => DepthUse::TestWrite,
        },
    }
}
