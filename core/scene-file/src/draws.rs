//! A scene's triangles as draws: one of each object and material, whose vertices outlive the frames.

use std::collections::BTreeMap;
use std::sync::Arc;

use afterglow_gl::frame::{Format, RetainedRange, Slot, VertexLayout};

use crate::check;
use crate::error::Problem;
use crate::scene::{Object, Triangles};

/// Vertices are positions and no more: surfaces are flat.
pub(crate) const LAYOUT: VertexLayout = VertexLayout(0).with(Slot::Position as usize, Format::F3);

/// All triangles of one object that have the same material.
#[derive(Debug)]
pub(crate) struct Part {
    /// None for triangles of no object.
    pub(crate) object: Option<usize>,
    pub(crate) material: usize,
    pub(crate) range: Arc<RetainedRange>,
}

/// Cuts triangles into parts, by object and then by material; within a part they keep their order.
pub(crate) fn parts(triangles: &Triangles, objects: &[Object]) -> Result<Vec<Part>, Problem> {
    let mut owners = vec![None; triangles.corners.len()];
    for (number, object) in objects.iter().enumerate() {
        owners[object.first_triangle..][..object.triangle_count].fill(Some(number));
    }
    let mut members: BTreeMap<(Option<usize>, u32), Vec<u32>> = BTreeMap::new();
    for (triangle, (owner, material)) in (0..).zip(owners.into_iter().zip(&triangles.materials)) {
        members.entry((owner, *material)).or_default().push(triangle);
    }
    check::count("objects and materials", members.len(), check::MOST_DRAWS)?;
    let mut compactor = Compactor::new(triangles);
    let parts = members.into_iter().map(|((object, material), members)| Part {
        object,
        material: material as usize,
        range: Arc::new(compactor.range(&members)),
    });
    Ok(parts.collect())
}

/// Takes the vertices of some triangles out of all.
struct Compactor<'a> {
    triangles: &'a Triangles,
    /// Of each vertex: in which range it was used last, and as what number there.
    used: Vec<(u32, u32)>,
    ranges: u32,
}

impl<'a> Compactor<'a> {
    fn new(triangles: &'a Triangles) -> Self {
        Self { triangles, used: vec![(0, 0); triangles.positions.len()], ranges: 0 }
    }

    fn range(&mut self, members: &[u32]) -> RetainedRange {
        self.ranges += 1;
        let mut words = Vec::new();
        let mut indices = Vec::with_capacity(3 * members.len());
        for corner in members.iter().flat_map(|triangle| self.triangles.corners[*triangle as usize]) {
            let used = &mut self.used[corner as usize];
            if used.0 != self.ranges {
                *used = (self.ranges, (words.len() / LAYOUT.stride()) as u32);
                words.extend(self.triangles.positions[corner as usize].to_array().map(f32::to_bits));
            }
            indices.push(used.1);
        }
        RetainedRange::new(LAYOUT, words, indices)
    }
}
